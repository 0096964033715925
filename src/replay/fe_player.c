// fe_player.c - the API of players.
#include "api/check.h"
#include "replay/player.h"
#include "snapshot/format.h"
#include "world/shape.h"

#include <string.h>

static fe_player_def default_player(void)
{
    return (fe_player_def){.struct_size = sizeof(fe_player_def), .worker_count = 1};
}

void fe_player_def_init(fe_player_def *def, uint32_t struct_size)
{
    fe_player_def defaults = default_player();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

FE_DEFINE_EMPTY_INIT(fe_player_info_init, fe_player_info, info)
FE_DEFINE_EMPTY_INIT(fe_divergence_init, fe_divergence, divergence)

static fe_result read_def(const char *function, const fe_player_def *def, fe_player_def *full, fe_allocator *allocator)
{
    *full = default_player();
    *allocator = (fe_allocator){.struct_size = sizeof *allocator};
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_INT(full->worker_count, 1, FE_MAX_WORKERS);
    FE_CHECK_INT(full->simd, FE_SIMD_AUTO, FE_SIMD_NEON);
    FE_CHECK_INT(full->reserved, 0, 0);
    return full->allocator ? fe__read_allocator(function, full->allocator, allocator) : FE_OK;
}

// Pool, store and SIMD set are judged now, not when there is something to play
static fe_result try_world(const fe_player_def *full)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.simd = full->simd, def.pool = full->pool, def.store = full->store, def.allocator = full->allocator;
    fe_result result = fe_world_create(&def, &world);
    return result == FE_OK ? fe_world_destroy(world) : result;
}

fe_result fe_player_create(const fe_player_def *def, fe_player **out_player)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(out_player);
    fe_player_def full;
    fe_allocator allocator;
    FE_TRY(read_def(function, def, &full, &allocator));
    if (full.allocator) full.allocator = &allocator;
    FE_TRY(try_world(&full));
    fe__memory memory;
    fe__memory_init(&memory, full.allocator);
    fe_player *p = fe__allocate(&memory, sizeof *p);
    if (!p) return fe__report(function, FE_ERROR_MEMORY);
    p->memory = memory;
    p->def = full;
    p->allocator = allocator;
    if (full.allocator) p->def.allocator = &p->allocator;
    p->file.memory = p->in.memory = &p->memory;
    *out_player = p;
    return FE_OK;
}

// Whoever else has the world reads it: what is written goes by the recording
static void take_back(fe_player *player)
{
    if (player->world) fe__owner_take_back(&player->world->owner);
}
static void show(fe_player *player)
{
    if (player->world) fe__owner_show(&player->world->owner);
}

fe_result fe_player_destroy(fe_player *player)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    take_back(player);
    fe__player_close_world(player);
    fe__file_free(&player->file);
    fe__in_free(&player->in);
    FE_FREE(&player->memory, player->assets, player->asset_capacity);
    fe__memory memory = player->memory;
    fe__release(&memory, player, sizeof *player);
    return FE_OK;
}

fe_result fe_player_feed(fe_player *player, const void *bytes, int64_t size)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_INT(size, 0, INT64_MAX);
    if (size > 0) FE_CHECK_POINTER(bytes);
    fe_result result = fe__file_feed(&player->file, bytes, size);
    if (result == FE_OK || result == FE_ERROR_MEMORY) return fe__report(function, result);
    return fe__fail(function, result, "%s", player->file.sentence);
}

fe_result fe_player_step(fe_player *player)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    take_back(player);
    fe_result result = fe__player_step(function, player);
    show(player);
    return result;
}

fe_result fe_player_seek(fe_player *player, int64_t step)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_INT(step, 0, INT64_MAX);
    take_back(player);
    fe_result result = fe__player_seek(function, player, step);
    show(player);
    return result;
}

static fe_result check_world(const char *function, const fe_player *player)
{
    if (player->world && player->is_open) return FE_OK;
    return fe__fail(function, FE_ERROR_STATE, "the player has no world: step it or seek first");
}

fe_result fe_player_get_world(const fe_player *player, const fe_world **out_world)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_POINTER(out_world);
    FE_TRY(check_world(function, player));
    *out_world = player->world;
    return FE_OK;
}

fe_result fe_player_release(fe_player *player, fe_world **out_world)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_POINTER(out_world);
    FE_TRY(check_world(function, player));
    fe_world *world = player->world;
    if (world->pair_filter) world->pair_filter = fe__accept_pair, world->pair_filter_user = NULL;
    fe__owner_take_back(&world->owner);
    player->world = NULL;
    player->asset_count = 0; // they are its store's
    *out_world = world;
    return FE_OK;
}

fe_result fe_player_get_info(const fe_player *player, fe_player_info *out_info)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_STRUCT_SIZE(out_info);
    const fe__file *f = &player->file;
    fe_player_info info = {.struct_size = sizeof info,
                           .library = f->library,
                           .flags = f->flags,
                           .foreign = f->library != 0 && f->results != FE__RESULTS,
                           .step = player->step,
                           .calls = player->calls,
                           .bytes = f->bytes,
                           .keyframes = f->keyframes,
                           .notes = f->notes,
                           .has_diverged = player->has_diverged};
    for (int32_t i = f->chunk_count; i-- > 0;)
        if (f->chunks[i].type == FE__CHUNK_KEYFRAME) info.first_step = f->chunks[i].step;
    if (f->chunk_count) info.last_step = f->chunks[f->chunk_count - 1].step;
    fe__write_struct(out_info, &info, sizeof info);
    return FE_OK;
}

int32_t fe_player_get_notes(const fe_player *player, fe_note *out_notes, uint32_t stride, int32_t capacity)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_ARRAY(out_notes, capacity);
    FE_CHECK_RECORD_STRIDE(stride, 2 * (uint32_t)sizeof(uint64_t), capacity);
    int32_t count = 0;
    for (int32_t i = 0; i < player->file.chunk_count; ++i) {
        const fe__fed_chunk *c = player->file.chunks + i;
        if (c->type != FE__CHUNK_NOTE) continue;
        const unsigned char *at = c->content;
        fe_note note = {.step = c->step, .about = fe__take_u64(&at)};
        note.text = (const char *)at;
        if (count < capacity)
            memcpy(fe__at(out_notes, stride, count), &note, stride < sizeof note ? stride : sizeof note);
        ++count;
    }
    return count;
}

fe_result fe_player_get_divergence(const fe_player *player, fe_divergence *out_divergence)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(player);
    FE_CHECK_STRUCT_SIZE(out_divergence);
    if (!player->has_diverged) return fe__fail(function, FE_ERROR_STATE, "the replay has not diverged");
    fe__write_struct(out_divergence, &player->divergence, sizeof player->divergence);
    return FE_OK;
}
