// recorded.c - see recorded.h.
#include "support/recorded.h"

#include <stdio.h>
#include <stdlib.h>

static void must(int ok, const char *what)
{
    if (ok) return;
    fprintf(stderr, "%s: %s\n", what, fe_last_error());
    abort();
}

fe_recorder *recorded_begin(fe_world *world, uint32_t flags, int32_t keyframe_steps)
{
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.flags = flags, def.keyframe_steps = keyframe_steps, def.buffer_bytes = INT64_C(1) << 30;
    fe_recorder *recorder;
    must(fe_recorder_create(world, &def, &recorder) == FE_OK, "no recorder");
    return recorder;
}

void recorded_read(recorded *r, fe_recorder *recorder)
{
    int64_t waits = 0, size = 0;
    must(fe_recorder_read(recorder, NULL, 0, &waits) >= 0, "nothing to read");
    if (r->size + waits > r->capacity) {
        r->capacity = 2 * (r->size + waits);
        r->bytes = realloc(r->bytes, (size_t)r->capacity);
        must(r->bytes != NULL, "no memory");
    }
    if (waits == 0) return;
    must(fe_recorder_read(recorder, r->bytes + r->size, waits, &size) == FE_OK && size == waits, "it is not read");
    r->size += size;
}

void recorded_free(recorded *r)
{
    free(r->bytes);
    *r = (recorded){0};
}

static fe_player *open_player(int32_t workers, int32_t simd)
{
    fe_player_def def;
    fe_player *player;
    fe_player_def_init(&def, sizeof def);
    def.worker_count = workers, def.simd = simd;
    fe_result result = fe_player_create(&def, &player);
    if (result == FE_ERROR_UNSUPPORTED) {
        def.simd = FE_SIMD_AUTO;
        result = fe_player_create(&def, &player);
    }
    must(result == FE_OK, "no player");
    return player;
}

static fe_result play_on(played *p)
{
    while ((p->result = fe_player_step(p->player)) == FE_OK) p->steps += 1;
    return p->result;
}

played recorded_play(const unsigned char *bytes, int64_t size, int32_t workers, int32_t simd, int64_t piece)
{
    played p = {.player = open_player(workers, simd), .result = FE_END};
    for (int64_t at = 0; at < size && p.result == FE_END;) {
        int64_t some = piece && piece < size - at ? piece : size - at;
        fe_result fed = fe_player_feed(p.player, bytes + at, some);
        play_on(&p);
        if (fed != FE_OK && p.result == FE_END) p.result = fed;
        at += some;
    }
    return p;
}

uint64_t recorded_hash(const fe_player *player)
{
    const fe_world *world;
    uint32_t words[2] = {0, 0};
    must(fe_player_get_world(player, &world) == FE_OK && fe_world_hash(world, words) == FE_OK, "no hash");
    return words[0] | (uint64_t)words[1] << 32;
}
