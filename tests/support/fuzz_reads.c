// fuzz_reads.c - what takes a world as it is, and may change nothing of it: drawings, copies, states, frames, measures.
// See fuzz.c, which compares its snapshots.
#include "support/fuzz_state.h"

#include <stdlib.h>

int32_t fuzz_draw(fuzz *f)
{
    fe_draw_options o;
    fuzz_span a;
    fe_draw_options_init(&o, sizeof o);
    const uint8_t which = fuzz_byte(f) % 4;
    o.parts = fuzz_byte(f) | (uint32_t)fuzz_byte(f) % 16 << 8;
    if (fuzz_byte(f) % 4 == 0) o.lower = fuzz_dvec3(f), o.upper = fuzz_dvec3(f);
    const void *options = or_null(f, &o);
    fuzz_array(f, which == 3 ? sizeof(fe_draw_instance) : sizeof(fe_draw_vertex), &a);
    switch (which) {
    case 0:
        return fe_world_draw_lines(f->world, options, a.data, a.stride, a.count);
    case 1:
        return fe_world_draw_triangles(f->world, options, a.data, a.stride, a.count);
    case 2:
        return fe_world_draw_points(f->world, options, a.data, a.stride, a.count);
    default:
        return fe_world_draw_instances(f->world, options, a.data, a.stride, a.count);
    }
}

static void check_copy(fuzz *f, fe_world *copy, const char *what)
{
    uint32_t own[2], its[2];
    if (fe_world_hash(f->world, own) != FE_OK || fe_world_hash(copy, its) != FE_OK || own[0] != its[0] ||
        own[1] != its[1])
        fuzz_fail(f, what);
    if (fe_world_destroy(copy) != FE_OK) fuzz_fail(f, "a copy cannot be destroyed");
}

int32_t fuzz_clone(fuzz *f)
{
    fe_world *clone;
    if (fe_world_clone(f->world, NULL, &clone) != FE_OK) fuzz_fail(f, "no clone");
    check_copy(f, clone, "a clone is another world");
    return FE_OK;
}

// With all that it needs, in bytes, and out of them where no asset is. The pair filter is the host's
int32_t fuzz_load(fuzz *f)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_ASSETS;
    int64_t size = fe_world_save(f->world, &options, NULL, 0);
    unsigned char *bytes = malloc((size_t)(size > 0 ? size : 1));
    if (!bytes || size <= 0 || fe_world_save(f->world, &options, bytes, size) != size) fuzz_fail(f, "no snapshot");
    fe_world *loaded;
    fe_result result = fe_world_load(NULL, NULL, bytes, size, &loaded);
    if (result == FE_OK) check_copy(f, loaded, "a loaded world is another one");
    if (result != FE_OK && result != FE_ERROR_STATE) fuzz_fail(f, "its own snapshot is refused");
    free(bytes);
    return FE_OK;
}

int32_t fuzz_hold(fuzz *f)
{
    fe_state *state;
    if (fe_state_create(f->world, NULL, &state) != FE_OK) fuzz_fail(f, "no state");
    return fe_state_destroy(state);
}

int32_t fuzz_keep(fuzz *f)
{
    fe_history *history;
    fe_history_def def;
    fe_history_def_init(&def, sizeof def);
    def.frames = 2;
    fe_result result = fe_history_create(f->world, or_null(f, &def), &history);
    if (result != FE_OK) return result;
    for (int64_t frame = 0; frame < 3 && result == FE_OK; ++frame) result = fe_history_keep(history, frame);
    if (result == FE_OK && fe_history_restore(history, 2) != FE_OK) fuzz_fail(f, "the last frame is gone");
    if (fe_history_destroy(history) != FE_OK) fuzz_fail(f, "a history cannot be destroyed");
    return result;
}
