// The pair filter of a world: a Lua function that fe_world_step calls on the thread that steps. No error may pass
// through the library: the first one is kept, the pair may collide, and world_step raises it when the step is done.
#ifndef FE_BINDINGS_LUA_PAIR_FILTER_H
#define FE_BINDINGS_LUA_PAIR_FILTER_H

#include "lua/boxes.h"
#include "lua/values.h"

#include <stdbool.h>

// Where they lie in the stack of world_step, from world_box.filter on.
enum { FILTER, FIRST_ERROR, HAS_FAILED };

/// Calls the user's function, upvalue 1, and insists on a boolean.
static int call_filter(lua_State *L)
{
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 1);
    if (!lua_isboolean(L, -1))
        return fail(L, "feather: the pair filter returned a %s, not true or false", luaL_typename(L, -1));
    return 1;
}

/// An fe_pair_filter. Nothing before lua_pcall allocates: nothing but it can fail.
static int32_t judge(void *user, const fe_filter_pair *pair)
{
    const world_box *box = user;
    lua_State *L = box->stepping;
    lua_pushvalue(L, box->filter + FILTER);
    push_integer(L, (long long)pair->body_a), push_integer(L, (long long)pair->body_b);
    push_integer(L, (long long)pair->shape_a), push_integer(L, (long long)pair->shape_b);
    push_u64(L, pair->body_user_data_a), push_u64(L, pair->body_user_data_b);
    push_u64(L, pair->shape_user_data_a), push_u64(L, pair->shape_user_data_b);
    bool failed = lua_pcall(L, 8, 1, 0) != 0;
    int32_t may_collide = failed || lua_toboolean(L, -1);
    if (failed && !lua_toboolean(L, box->filter + HAS_FAILED)) {
        lua_pushboolean(L, 1);
        lua_replace(L, box->filter + HAS_FAILED);
        lua_replace(L, box->filter + FIRST_ERROR);
    } else {
        lua_pop(L, 1);
    }
    return may_collide;
}

/// fe_world_step, with room for the filter. A step inside a step is refused: what it changes is put back.
static fe_result step(lua_State *L, fe_world *world, float dt)
{
    world_box *box = lua_touserdata(L, 1);
    const world_box outer = *box;
    int slots = lua_gettop(L) + 1;
    luaL_checkstack(L, LUA_MINSTACK, "feather");
    push_kept(L, 1);
    lua_getfield(L, -1, "filter");
    lua_replace(L, slots + FILTER);
    lua_pushnil(L), lua_pushboolean(L, 0);
    box->stepping = L, box->filter = slots;
    fe_result result = fe_world_step(world, dt);
    box->stepping = outer.stepping, box->filter = outer.filter;
    if (lua_toboolean(L, slots + HAS_FAILED)) {
        lua_pushvalue(L, slots + FIRST_ERROR);
        lua_error(L);
    }
    lua_settop(L, slots - 1);
    return result;
}

/// NULL for nil.
static fe_pair_filter to_pair_filter(lua_State *L, int index)
{
    if (lua_isnoneornil(L, index)) return NULL;
    if (!lua_isfunction(L, index)) fail(L, "feather: filter: a function is needed, not a %s", luaL_typename(L, index));
    return judge;
}

/// The world at 1 keeps the function at 2.
static void keep_pair_filter(lua_State *L)
{
    if (lua_isnoneornil(L, 2)) {
        lua_pushnil(L);
    } else {
        lua_pushvalue(L, 2);
        lua_pushcclosure(L, call_filter, 1);
    }
    keep_as(L, 1, "filter");
    lua_pop(L, 1);
}

#endif
