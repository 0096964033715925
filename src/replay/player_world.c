// player_world.c - see player_world.h.
#include "replay/player_world.h"

#include "core/bytes.h"
#include "store/asset_key.h"

// ---- assets --------------------------------------------------------------------------------------------------------
static fe__replay_asset *find(const fe_player *p, fe_asset recorded)
{
    for (int32_t i = 0; i < p->asset_count; ++i)
        if (p->assets[i].recorded == recorded) return p->assets + i;
    return NULL;
}

fe_asset fe__player_asset(const fe_player *p, fe_asset recorded)
{
    const fe__replay_asset *a = find(p, recorded);
    return a ? a->own : 0;
}

static int32_t is_of(const fe_player *p, fe_asset own, const uint64_t *key)
{
    fe_asset_key now;
    return fe_asset_get_key(p->world->store, own, &now) == FE_OK && now.words[0] == key[0] && now.words[1] == key[1];
}

static fe_result load(const char *function, fe_player *p, const unsigned char *bytes, int64_t size, const uint64_t *key,
                      fe_asset *out_asset)
{
    fe_store *store = p->world->store;
    FE_TRY(fe_asset_load(store, bytes, size, out_asset));
    if (is_of(p, *out_asset, key)) return FE_OK;
    fe_asset_destroy(store, *out_asset);
    return fe__fail(function, FE_ERROR_DATA, "an asset in the recording is not what its key says");
}

// A copy: replayed edits are none of the host's business
static fe_result copy_of_known(const char *function, fe_player *p, const uint64_t *key, fe_asset *out_asset)
{
    fe_store *store = p->world->store;
    fe__store_lock(store);
    int32_t index = fe__store_find_key(store, (fe__asset_key){{key[0], key[1]}}, 0);
    fe_asset known = index >= 0 ? fe__store_asset(store, index)->handle : 0;
    fe__store_unlock(store);
    int64_t size = known ? fe_asset_save(store, known, NULL, 0) : -1;
    if (size < 0)
        return fe__fail(function, FE_ERROR_STATE, "the asset with the key %016llx %016llx is nowhere",
                        (unsigned long long)key[0], (unsigned long long)key[1]);
    unsigned char *bytes = fe__allocate_scratch(&p->memory, (size_t)size);
    if (!bytes) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = fe_asset_save(store, known, bytes, size) == size ? load(function, p, bytes, size, key, out_asset)
                                                                        : FE_ERROR_STATE;
    fe__release(&p->memory, bytes, (size_t)size);
    return result;
}

fe_result fe__player_name(const char *function, fe_player *p, fe_asset recorded, const uint64_t *key)
{
    fe__replay_asset *a = find(p, recorded);
    if (a && is_of(p, a->own, key)) return FE_OK;
    if (!FE_RESERVE(&p->memory, p->assets, p->asset_capacity, p->asset_count + 1))
        return fe__report(function, FE_ERROR_MEMORY);
    int64_t size;
    const unsigned char *bytes = fe__file_find_asset(&p->file, key, &size);
    fe_asset made;
    FE_TRY(bytes ? load(function, p, bytes, size, key, &made) : copy_of_known(function, p, key, &made));
    a = find(p, recorded);
    if (a)
        fe_asset_destroy(p->world->store, a->own);
    else
        a = p->assets + p->asset_count++;
    *a = (fe__replay_asset){recorded, made};
    return FE_OK;
}

// ---- the filter ----------------------------------------------------------------------------------------------------
int32_t fe__player_answer(void *user, const fe_filter_pair *pair)
{
    (void)pair;
    fe_player *p = user;
    int64_t i = p->answered++;
    return i >= p->answer_count || (p->answers[i / 8] >> i % 8 & 1);
}

// ---- the world -----------------------------------------------------------------------------------------------------
static fe_result open_world(fe_player *p)
{
    if (p->world) return FE_OK;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = p->def.worker_count;
    def.simd = p->def.simd;
    def.pool = p->def.pool;
    def.store = p->def.store;
    def.allocator = p->def.allocator;
    return fe_world_create(&def, &p->world);
}

void fe__player_close_world(fe_player *p)
{
    if (!p->world) return;
    for (int32_t i = 0; i < p->asset_count; ++i) fe_asset_destroy(p->world->store, p->assets[i].own);
    p->asset_count = 0;
    fe_world_destroy(p->world);
    p->world = NULL;
}

typedef struct named {
    fe_asset_key *keys;
    fe_asset *assets;
    int32_t count;
    size_t size;
} named;

static fe_result name_assets(const char *function, fe_player *p, const unsigned char *at, named *n)
{
    for (int32_t i = 0; i < n->count; ++i) {
        fe_asset recorded = fe__take_u64(&at);
        n->keys[i].words[0] = fe__take_u64(&at);
        n->keys[i].words[1] = fe__take_u64(&at);
        FE_TRY(fe__player_name(function, p, recorded, n->keys[i].words));
        n->assets[i] = fe__player_asset(p, recorded);
    }
    return FE_OK;
}

// ---- compounds -----------------------------------------------------------------------------------------------------
// Of the keyframe's assets, the one with the content of a part's, whose handle may be dead
static fe_asset same_content(const fe_player *p, const named *n, fe_asset asset)
{
    const fe_store *store = p->world->store;
    fe__store_lock(store);
    fe__asset_key key = fe__asset_key_of(store, fe__id_slot_of(asset));
    fe__store_unlock(store);
    for (int32_t i = 0; i < n->count; ++i)
        if (n->keys[i].words[0] == key.words[0] && n->keys[i].words[1] == key.words[1]) return n->assets[i];
    return asset;
}

// 1: a part has another asset now
static int32_t take_parts(const fe_player *p, const named *n, fe_asset compound, fe_compound_part *parts, int32_t count)
{
    int32_t changed = 0;
    for (int32_t i = 0; i < count; ++i) {
        parts[i].struct_size = sizeof *parts;
        fe_compound_get_part(p->world->store, compound, i, parts + i);
        fe_asset *asset = &parts[i].geometry.asset, same = *asset ? same_content(p, n, *asset) : 0;
        changed |= same != *asset;
        *asset = same;
    }
    return changed;
}

// A compound that was loaded has parts of its own; in the keyframe others share them
static fe_result share_parts(const char *function, fe_player *p, const named *n, fe_asset *compound)
{
    fe_store *store = p->world->store;
    fe_compound_info info;
    fe_compound_info_init(&info, sizeof info);
    if (fe_asset_get_type(store, *compound) != FE_GEOMETRY_COMPOUND) return FE_OK;
    FE_TRY(fe_compound_get_info(store, *compound, &info));
    size_t size = (size_t)info.part_count * sizeof(fe_compound_part);
    fe_compound_part *parts = fe__allocate(&p->memory, size);
    if (!parts) return fe__report(function, FE_ERROR_MEMORY);
    fe_asset made = 0;
    fe_result result = FE_OK;
    if (take_parts(p, n, *compound, parts, info.part_count))
        result = fe_compound_create(store, parts, sizeof *parts, info.part_count, &made);
    fe__release(&p->memory, parts, size);
    if (made) {
        fe_asset_destroy(store, *compound);
        *compound = made;
    }
    return result;
}

static fe_result share_all_parts(const char *function, fe_player *p, const unsigned char *at, named *n)
{
    for (int32_t i = 0; i < n->count; ++i, at += FE__ASSET_ENTRY) {
        const unsigned char *handle = at;
        fe__replay_asset *a = find(p, fe__take_u64(&handle));
        FE_TRY(share_parts(function, p, n, &a->own));
        n->assets[i] = a->own;
    }
    return FE_OK;
}

static fe_result restore_with(const char *function, fe_player *p, const fe__fed_chunk *keyframe, named *n)
{
    int64_t front = FE__KEYFRAME_FRONT + (int64_t)FE__ASSET_ENTRY * n->count;
    const unsigned char *has_filter = keyframe->content + 4;
    FE_TRY(name_assets(function, p, keyframe->content + FE__KEYFRAME_FRONT, n));
    FE_TRY(share_all_parts(function, p, keyframe->content + FE__KEYFRAME_FRONT, n));
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.asset_count = n->count, options.keys = n->keys, options.assets = n->assets;
    p->world->pair_filter = fe__player_answer, p->world->pair_filter_user = p;
    fe_result result = fe_world_restore(p->world, &options, keyframe->content + front, keyframe->size - front);
    if (result >= 0 && !fe__take_u32(&has_filter)) p->world->pair_filter = NULL;
    return result < 0 ? result : FE_OK; // of other results: the player says so
}

fe_result fe__player_restore(const char *function, fe_player *p, const fe__fed_chunk *keyframe)
{
    const unsigned char *at = keyframe->content;
    int64_t count = fe__take_u32(&at);
    if (count > (keyframe->size - FE__KEYFRAME_FRONT) / FE__ASSET_ENTRY)
        return fe__fail(function, FE_ERROR_DATA, "a keyframe has fewer assets than it says");
    FE_TRY(open_world(p));
    named n = {.count = (int32_t)count};
    n.size = (size_t)(count + 1) * (sizeof *n.keys + sizeof *n.assets);
    n.keys = fe__allocate(&p->memory, n.size);
    if (!n.keys) return fe__report(function, FE_ERROR_MEMORY);
    n.assets = (fe_asset *)(void *)(n.keys + count + 1);
    fe_result result = restore_with(function, p, keyframe, &n);
    fe__release(&p->memory, n.keys, n.size);
    return result;
}
