// Batches in Lua: a userdata that owns a batch, and its calls, which SWIG leaves to this file. Numbers come and go as
// flat tables: for each world, for each item, a row. What fails in some worlds is a count and a table of results.
#ifndef FE_BINDINGS_LUA_BATCH_H
#define FE_BINDINGS_LUA_BATCH_H

#include "feather.h"
#include "lua/arrays.h"
#include "lua/boxes.h"

#include <lauxlib.h>
#include <lua.h>

typedef struct batch_box {
    const void *type;
    int own;
    fe_batch *batch; ///< NULL: closed
    int32_t count;   ///< of its worlds
} batch_box;

static const char batch_type[] = "feather.batch";

static int collect_batch(lua_State *L)
{
    batch_box *box = luaL_checkudata(L, 1, batch_type);
    if (box->batch) (void)fe_batch_destroy(box->batch);
    box->batch = NULL;
    return 0;
}

static batch_box *to_batch(lua_State *L, int index)
{
    batch_box *box = box_at(L, index, batch_type, "batch");
    if (!box->batch) fail(L, "feather: the batch is closed");
    return box;
}

/// A template's pair filter would ask its function outside of a step of the template.
static int take_filters(const batch_box *box)
{
    fe_result result = FE_OK;
    for (int32_t i = 0; i < box->count && result == FE_OK; ++i) {
        fe_world *world = NULL;
        result = fe_batch_get_world(box->batch, i, &world);
        if (result == FE_OK) result = fe_world_set_pair_filter(world, NULL, NULL);
    }
    return result == FE_OK;
}

/// batch_create(world, count, workers, block, simd, pool or nil)
static int batch_create(lua_State *L)
{
    fe_batch_def def;
    fe_world *world = to_world(L, 1);
    fe_batch_def_init(&def, (uint32_t)sizeof def);
    def.world_count = (int32_t)to_integer(L, 2, INT32_MIN, INT32_MAX, "world_count");
    def.worker_count = (int32_t)to_integer(L, 3, INT32_MIN, INT32_MAX, "worker_count");
    def.block = (int32_t)to_integer(L, 4, INT32_MIN, INT32_MAX, "block");
    def.simd = (int32_t)to_integer(L, 5, INT32_MIN, INT32_MAX, "simd");
    def.pool = to_pool(L, 6);
    lua_settop(L, 6);
    batch_box *box = lua_newuserdata(L, sizeof *box);
    *box = (batch_box){.type = SWIGTYPE_p_fe_state, .count = def.world_count}; // any that is no definition
    luaL_getmetatable(L, batch_type);
    lua_setmetatable(L, -2);
    if (fe_batch_create(world, &def, &box->batch) != FE_OK || !take_filters(box)) return raise_last(L);
    lua_pushvalue(L, 6);
    keep_as(L, 7, "pool");
    lua_pop(L, 1);
    return 1;
}

static int batch_destroy(lua_State *L)
{
    batch_box *box = to_batch(L, 1);
    if (fe_batch_destroy(box->batch) != FE_OK) return raise_last(L);
    box->batch = NULL;
    return 0;
}

// ---- arguments ------------------------------------------------------------------------------------------------------

/// A boolean a world; nil: all
static const uint8_t *to_mask(lua_State *L, int index, int32_t worlds)
{
    if (lua_isnoneornil(L, index)) return NULL;
    int count = length_of(L, index, "mask");
    if (count != worlds) fail(L, "feather: mask: %d switches are needed, not %d", (int)worlds, count);
    uint8_t *mask = new_array(L, count, sizeof *mask);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        mask[i] = (uint8_t)lua_toboolean(L, -1);
        lua_pop(L, 1);
    }
    return mask;
}

/// A state a world, nil: the template's; nil: for all
static const fe_state *const *to_states(lua_State *L, int index, int32_t worlds)
{
    if (lua_isnoneornil(L, index)) return NULL;
    check_table(L, index, "states");
    const fe_state **states = new_array(L, worlds, sizeof *states);
    for (int32_t i = 0; i < worlds; ++i) {
        lua_rawgeti(L, index, i + 1);
        states[i] = lua_toboolean(L, -1) ? to_state(L, lua_gettop(L)) : NULL;
        lua_pop(L, 1);
    }
    return states;
}

/// (..., field, items or nil, numbers of a row)
static int32_t to_array(lua_State *L, const batch_box *box, int index, fe_array *out)
{
    call_state call = {0};
    fe_array_init(out, (uint32_t)sizeof *out);
    out->field = (int32_t)to_integer(L, index, 0, INT32_MAX, "field");
    int64_t row = to_integer(L, index + 2, 1, 16, "row");
    out->items = lua_isnil(L, index + 1) ? NULL : to_handles(L, index + 1, &call, "items");
    out->item_count = out->items ? call.count : 1;
    int64_t numbers = row * out->item_count * box->count;
    if (numbers > INT32_MAX / 4) fail(L, "feather: items: too many numbers");
    out->bytes = 4 * numbers;
    return (int32_t)numbers;
}

static int push_outcome(lua_State *L, int32_t failed, const int32_t *results, int32_t worlds)
{
    if (failed < 0) return raise_last(L);
    push_integer(L, failed);
    if (failed == 0) return 1;
    lua_createtable(L, worlds, 0);
    for (int32_t i = 0, n = 0; i < worlds; ++i) put_integer(L, &n, results[i]);
    return 2;
}

// ---- calls ----------------------------------------------------------------------------------------------------------

/// batch_step(batch, dt, steps, mask): how many failed, and then a table of results
static int batch_step(lua_State *L)
{
    const batch_box *box = to_batch(L, 1);
    lua_settop(L, 4);
    float dt = (float)to_number(L, 2, "dt");
    int32_t steps = (int32_t)to_integer(L, 3, INT32_MIN, INT32_MAX, "steps");
    const uint8_t *mask = to_mask(L, 4, box->count);
    int32_t *results = new_array(L, box->count, sizeof *results);
    return push_outcome(L, fe_batch_step(box->batch, dt, steps, mask, results), results, box->count);
}

/// batch_reset(batch, mask, states)
static int batch_reset(lua_State *L)
{
    const batch_box *box = to_batch(L, 1);
    lua_settop(L, 3);
    const uint8_t *mask = to_mask(L, 2, box->count);
    const fe_state *const *states = to_states(L, 3, box->count);
    int32_t *results = new_array(L, box->count, sizeof *results);
    return push_outcome(L, fe_batch_reset(box->batch, mask, states, results), results, box->count);
}

/// batch_read(batch, field, items, row): the numbers, how many worlds failed, and then a table of results
static int batch_read(lua_State *L)
{
    const batch_box *box = to_batch(L, 1);
    fe_array array;
    lua_settop(L, 4);
    int32_t numbers = to_array(L, box, 2, &array);
    array.data = new_array(L, numbers, sizeof(float));
    int32_t *results = new_array(L, box->count, sizeof *results);
    int32_t failed = fe_batch_read(box->batch, &array, results);
    if (failed < 0) return raise_last(L);
    push_floats(L, array.data, numbers);
    return 1 + push_outcome(L, failed, results, box->count);
}

/// batch_write(batch, field, items, row, numbers, mask)
static int batch_write(lua_State *L)
{
    const batch_box *box = to_batch(L, 1);
    fe_array array;
    call_state call = {0};
    lua_settop(L, 6);
    int32_t numbers = to_array(L, box, 2, &array);
    array.data = to_floats(L, 5, 1, &call, "numbers");
    if (call.count != numbers) fail(L, "feather: numbers: %d are needed, not %d", (int)numbers, (int)call.count);
    const uint8_t *mask = to_mask(L, 6, box->count);
    int32_t *results = new_array(L, box->count, sizeof *results);
    return push_outcome(L, fe_batch_write(box->batch, &array, mask, results), results, box->count);
}

/// batch_hash(batch): a table of texts, as world_hash
static int batch_hash(lua_State *L)
{
    const batch_box *box = to_batch(L, 1);
    uint32_t *words = new_array(L, 2 * box->count, sizeof *words);
    if (fe_batch_hash(box->batch, words) != FE_OK) return raise_last(L);
    lua_createtable(L, box->count, 0);
    for (int32_t i = 0; i < box->count; ++i) {
        push_words(L, words + 2 * i);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

#endif
