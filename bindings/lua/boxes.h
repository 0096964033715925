// Worlds, pools and stores in Lua: userdata that own what they point to, and that keep alive what it uses.
#ifndef FE_BINDINGS_LUA_BOXES_H
#define FE_BINDINGS_LUA_BOXES_H

#include "feather.h"
#include "lua/errors.h"

#include <lauxlib.h>
#include <lua.h>

// All begin like SWIG's own userdata (type, own, pointer): SWIG sees by the type that they are no definition.
typedef struct world_box {
    const void *type;
    int own;
    fe_world *world;     ///< NULL: destroyed
    lua_State *stepping; ///< the Lua thread that is inside world_step, else NULL
    int filter;          ///< index of the pair filter in that thread's stack, see pair_filter.h
    void *player;        ///< the player_box that the world belongs to, see player.h; NULL: it belongs to this
} world_box;

typedef struct pool_box {
    const void *type;
    int own;
    fe_pool *pool; ///< NULL: destroyed
} pool_box;

typedef struct store_box {
    const void *type;
    int own;
    fe_store *store;        ///< NULL: destroyed
    const world_box *owner; ///< the world that the store was asked from: it lives at most as long; NULL: it owns itself
} store_box;

typedef struct history_box {
    const void *type;
    int own;
    fe_history *history;    ///< NULL: destroyed
    const world_box *owner; ///< its world, with which it ends
} history_box;

typedef struct recorder_box {
    const void *type;
    int own;
    fe_recorder *recorder; ///< NULL: closed. It outlives its world
} recorder_box;

typedef struct state_box {
    const void *type;
    int own;
    fe_state *state; ///< NULL: closed. It outlives its world
} state_box;

static const char state_type[] = "feather.state";
static const char recorder_type[] = "feather.recorder";
static const char history_type[] = "feather.history";
static const char world_type[] = "feather.world";
static const char pool_type[] = "feather.pool";
static const char store_type[] = "feather.store";

// ---- finalizers -----------------------------------------------------------------------------------------------------

static int collect_world(lua_State *L)
{
    world_box *box = luaL_checkudata(L, 1, world_type);
    if (box->world && !box->player && fe_world_destroy(box->world) == FE_OK) box->world = NULL;
    return 0;
}

static int collect_pool(lua_State *L)
{
    pool_box *box = luaL_checkudata(L, 1, pool_type);
    if (box->pool && fe_pool_destroy(box->pool) == FE_OK) box->pool = NULL;
    return 0;
}

static int collect_store(lua_State *L)
{
    store_box *box = luaL_checkudata(L, 1, store_type);
    if (!box->owner && box->store && fe_store_destroy(box->store) == FE_OK) box->store = NULL;
    return 0;
}

// Its world is still there as memory: it was made before, and the history keeps it
static int collect_history(lua_State *L)
{
    history_box *box = luaL_checkudata(L, 1, history_type);
    if (box->history && box->owner->world) (void)fe_history_destroy(box->history);
    box->history = NULL;
    return 0;
}

// In a step of its world, which the pair filter may be in, it is refused, and ends with the world
static int collect_recorder(lua_State *L)
{
    recorder_box *box = luaL_checkudata(L, 1, recorder_type);
    if (box->recorder) (void)fe_recorder_destroy(box->recorder);
    box->recorder = NULL;
    return 0;
}

static int collect_state(lua_State *L)
{
    state_box *box = luaL_checkudata(L, 1, state_type);
    if (box->state) (void)fe_state_destroy(box->state);
    box->state = NULL;
    return 0;
}

static void add_type(lua_State *L, const char *name, lua_CFunction collect)
{
    luaL_newmetatable(L, name);
    lua_pushcfunction(L, collect);
    lua_setfield(L, -2, "__gc");
    lua_pushstring(L, "feather"); // hides the metatable, and with it __gc
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
}

static void add_types(lua_State *L)
{
    add_type(L, world_type, collect_world);
    add_type(L, pool_type, collect_pool);
    add_type(L, store_type, collect_store);
    add_type(L, history_type, collect_history);
    add_type(L, recorder_type, collect_recorder);
    add_type(L, state_type, collect_state);
}

// ---- what an object keeps alive -------------------------------------------------------------------------------------

/// Pushes the table that belongs to a userdata and dies with it: what stands in it lives as long.
static void push_kept(lua_State *L, int object)
{
    lua_pushvalue(L, object);
#if LUA_VERSION_NUM >= 502
    lua_getuservalue(L, -1);
    int is_own = lua_istable(L, -1);
#else // every userdata has a table at first: the one of this module
    lua_getfenv(L, -1);
    int is_own = !lua_rawequal(L, -1, LUA_ENVIRONINDEX);
#endif
    if (!is_own) {
        lua_createtable(L, 1, 1);
        lua_insert(L, -2);
        lua_rawseti(L, -2, 1); // what keep_alive put there
        lua_pushvalue(L, -1);
#if LUA_VERSION_NUM >= 502
        lua_setuservalue(L, -3);
#else
        lua_setfenv(L, -3);
#endif
    }
    lua_remove(L, -2);
}

/// `object` keeps the value on top of the stack, which stays there, under a name.
static void keep_as(lua_State *L, int object, const char *name)
{
    push_kept(L, object);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, name);
    lua_pop(L, 1);
}

/// A part that is read from an object, on top of the stack, keeps the object at an index alive.
static void keep_alive(lua_State *L, int object)
{
    if (lua_type(L, object) != LUA_TUSERDATA || lua_type(L, -1) != LUA_TUSERDATA) return;
#if LUA_VERSION_NUM >= 503
    lua_pushvalue(L, object);
    lua_setuservalue(L, -2);
#else // a table only
    lua_createtable(L, 1, 0);
    lua_pushvalue(L, object);
    lua_rawseti(L, -2, 1);
#if LUA_VERSION_NUM == 502
    lua_setuservalue(L, -2);
#else
    lua_setfenv(L, -2);
#endif
#endif
}

// ---- making them ----------------------------------------------------------------------------------------------------

/// A new world keeps what its definition keeps: its pool and its store. A pool whose finalizer comes first is refused
/// its end; its threads outlive the state, and the library is unloaded under them.
static void push_world(lua_State *L, fe_world *world, int definition)
{
    world_box *box = lua_newuserdata(L, sizeof *box);
    *box = (world_box){.type = SWIGTYPE_p_fe_world, .world = world};
    luaL_getmetatable(L, world_type);
    lua_setmetatable(L, -2);
    (void)fe_world_set_pair_filter(world, NULL, NULL); // a clone's would ask the function of its source
    if (lua_type(L, definition) != LUA_TUSERDATA) return;
    int made = lua_gettop(L);
    push_kept(L, definition);
    keep_as(L, made, "definition");
    lua_pop(L, 1);
}

static void push_pool(lua_State *L, fe_pool *pool)
{
    pool_box *box = lua_newuserdata(L, sizeof *box);
    *box = (pool_box){.type = SWIGTYPE_p_fe_pool, .pool = pool};
    luaL_getmetatable(L, pool_type);
    lua_setmetatable(L, -2);
}

/// @param owner  index of the world that the store was asked from, 0: the store is new
static void push_store(lua_State *L, fe_store *store, int owner)
{
    store_box *box = lua_newuserdata(L, sizeof *box);
    *box = (store_box){.type = SWIGTYPE_p_fe_store, .store = store, .owner = owner ? lua_touserdata(L, owner) : NULL};
    luaL_getmetatable(L, store_type);
    lua_setmetatable(L, -2);
    if (owner) keep_alive(L, owner);
}

/// Of the world at index 1
static void push_history(lua_State *L, fe_history *history)
{
    history_box *box = lua_newuserdata(L, sizeof *box);
    *box = (history_box){.type = SWIGTYPE_p_fe_history, .history = history, .owner = lua_touserdata(L, 1)};
    luaL_getmetatable(L, history_type);
    lua_setmetatable(L, -2);
    keep_alive(L, 1);
}

static void push_recorder(lua_State *L, fe_recorder *recorder)
{
    recorder_box *box = lua_newuserdata(L, sizeof *box);
    *box = (recorder_box){.type = SWIGTYPE_p_fe_recorder, .recorder = recorder};
    luaL_getmetatable(L, recorder_type);
    lua_setmetatable(L, -2);
}

static void push_state(lua_State *L, fe_state *state)
{
    state_box *box = lua_newuserdata(L, sizeof *box);
    *box = (state_box){.type = SWIGTYPE_p_fe_state, .state = state};
    luaL_getmetatable(L, state_type);
    lua_setmetatable(L, -2);
}

// ---- reading them ---------------------------------------------------------------------------------------------------

/// `check_` and `to_`: the second is asked again when all arguments are converted, since a table's __index may destroy.
static fe_world *check_world(lua_State *L, const world_box *box)
{
    if (!box->world) fail(L, "feather: the world is destroyed");
    return box->world;
}

static void *box_at(lua_State *L, int index, const char *type, const char *what)
{
    void *box = lua_touserdata(L, index);
    if (box && lua_getmetatable(L, index)) {
        luaL_getmetatable(L, type);
        int equal = lua_rawequal(L, -1, -2);
        lua_pop(L, 2);
        if (equal) return box;
    }
    fail(L, "feather: a %s is needed, not a %s", what, luaL_typename(L, index));
    return NULL;
}

static fe_world *to_world(lua_State *L, int index) { return check_world(L, box_at(L, index, world_type, "world")); }

static fe_pool *to_pool(lua_State *L, int index)
{
    if (lua_isnoneornil(L, index)) return NULL;
    const pool_box *box = box_at(L, index, pool_type, "pool");
    if (!box->pool) fail(L, "feather: the pool is destroyed");
    return box->pool;
}

static fe_store *to_store(lua_State *L, int index)
{
    if (lua_isnoneornil(L, index)) return NULL;
    const store_box *box = box_at(L, index, store_type, "store");
    if (!box->store || (box->owner && !box->owner->world)) fail(L, "feather: the store is destroyed");
    return box->store;
}

static fe_history *to_history(lua_State *L, int index)
{
    const history_box *box = box_at(L, index, history_type, "history");
    if (!box->history || !box->owner->world) fail(L, "feather: the history is destroyed");
    return box->history;
}

static fe_recorder *to_recorder(lua_State *L, int index)
{
    const recorder_box *box = box_at(L, index, recorder_type, "recorder");
    if (!box->recorder) fail(L, "feather: the recorder is closed");
    return box->recorder;
}

static fe_state *to_state(lua_State *L, int index)
{
    const state_box *box = box_at(L, index, state_type, "state");
    if (!box->state) fail(L, "feather: the state is closed");
    return box->state;
}

/// recorder_read(recorder): a string of what waits
static int recorder_read(lua_State *L)
{
    fe_recorder *recorder = to_recorder(L, 1);
    int64_t waiting, size = 0;
    if (fe_recorder_read(recorder, NULL, 0, &waiting) < 0) return raise_last(L);
    void *bytes = lua_newuserdata(L, waiting > 0 ? (size_t)waiting : 1);
    if (waiting > 0 && fe_recorder_read(recorder, bytes, waiting, &size) < 0) return raise_last(L);
    lua_pushlstring(L, bytes, (size_t)size);
    return 1;
}

#endif
