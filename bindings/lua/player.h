// Players in Lua: a userdata that owns a player, and its calls, which SWIG leaves to this file. The world of a player
// is a userdata as other worlds are; each keeps the other, and what closes the player ends it.
#ifndef FE_BINDINGS_LUA_PLAYER_H
#define FE_BINDINGS_LUA_PLAYER_H

#include "feather.h"
#include "lua/boxes.h"
#include "lua/values.h"

#include <lauxlib.h>
#include <lua.h>

typedef struct player_box {
    const void *type;
    int own;
    fe_player *player; ///< NULL: closed
    world_box *view;   ///< its world, once somebody asked for it, until it is released
} player_box;

static const char player_type[] = "feather.player";

static fe_result end_player(player_box *box)
{
    fe_result result = fe_player_destroy(box->player);
    if (result != FE_OK) return result;
    box->player = NULL;
    if (box->view) box->view->world = NULL;
    box->view = NULL;
    return FE_OK;
}

static int collect_player(lua_State *L)
{
    player_box *box = luaL_checkudata(L, 1, player_type);
    if (box->player) (void)end_player(box);
    return 0;
}

static player_box *to_player(lua_State *L, int index)
{
    player_box *box = box_at(L, index, player_type, "player");
    if (!box->player) fail(L, "feather: the player is closed");
    return box;
}

/// player_create(workers, simd, pool or nil, store or nil)
static int player_create(lua_State *L)
{
    fe_player_def def;
    fe_player_def_init(&def, (uint32_t)sizeof def);
    lua_settop(L, 4);
    def.worker_count = (int32_t)to_integer(L, 1, INT32_MIN, INT32_MAX, "worker_count");
    def.simd = (int32_t)to_integer(L, 2, INT32_MIN, INT32_MAX, "simd");
    def.pool = to_pool(L, 3);
    def.store = to_store(L, 4);
    player_box *box = lua_newuserdata(L, sizeof *box);
    *box = (player_box){.type = SWIGTYPE_p_fe_state}; // any that is no definition
    luaL_getmetatable(L, player_type);
    lua_setmetatable(L, -2);
    if (fe_player_create(&def, &box->player) != FE_OK) return raise_last(L);
    lua_pushvalue(L, 3), keep_as(L, 5, "pool"), lua_pop(L, 1);
    lua_pushvalue(L, 4), keep_as(L, 5, "store"), lua_pop(L, 1);
    return 1;
}

static int player_destroy(lua_State *L)
{
    if (end_player(to_player(L, 1)) != FE_OK) return raise_last(L);
    return 0;
}

/// player_feed(player, string)
static int player_feed(lua_State *L)
{
    const player_box *box = to_player(L, 1);
    size_t size = 0;
    if (lua_type(L, 2) != LUA_TSTRING) fail(L, "feather: bytes: a string is needed, not a %s", luaL_typename(L, 2));
    const char *bytes = lua_tolstring(L, 2, &size);
    if (fe_player_feed(box->player, bytes, (int64_t)size) != FE_OK) return raise_last(L);
    return 0;
}

static int push_is_there(lua_State *L, fe_result result)
{
    if (result < 0) return raise_last(L);
    lua_pushboolean(L, result != FE_END);
    return 1;
}

/// player_step(player): false at the end
static int player_step(lua_State *L) { return push_is_there(L, fe_player_step(to_player(L, 1)->player)); }

/// player_seek(player, step): false: it is not there yet
static int player_seek(lua_State *L)
{
    const player_box *box = to_player(L, 1);
    int64_t step = to_integer(L, 2, -(1LL << 53), 1LL << 53, "step");
    return push_is_there(L, fe_player_seek(box->player, step));
}

/// player_get_world(player): the same userdata until it is released
static int player_get_world(lua_State *L)
{
    player_box *box = to_player(L, 1);
    const fe_world *world = NULL;
    lua_settop(L, 1);
    if (fe_player_get_world(box->player, &world) != FE_OK) return raise_last(L);
    if (box->view) {
        push_kept(L, 1);
        lua_getfield(L, -1, "view");
        return 1;
    }
    world_box *view = lua_newuserdata(L, sizeof *view);
    *view = (world_box){.type = SWIGTYPE_p_fe_world, .player = box};
    luaL_getmetatable(L, world_type);
    lua_setmetatable(L, -2);
    lua_pushvalue(L, 1), keep_as(L, 2, "player"), lua_pop(L, 1);
    keep_as(L, 1, "view");
    view->world = (fe_world *)world; // the library refuses all that writes
    box->view = view;
    return 1;
}

/// player_release(player): the userdata of its world, which owns it from here on
static int player_release(lua_State *L)
{
    fe_world *world = NULL;
    player_get_world(L);
    player_box *box = to_player(L, 1);
    if (fe_player_release(box->player, &world) != FE_OK) return raise_last(L);
    box->view->player = NULL;
    box->view = NULL;
    lua_pushnil(L), keep_as(L, 1, "view"), lua_pop(L, 1);
    return 1;
}

// ---- what it tells --------------------------------------------------------------------------------------------------

static void set_integer(lua_State *L, const char *name, long long value)
{
    push_integer(L, value);
    lua_setfield(L, -2, name);
}

static void set_boolean(lua_State *L, const char *name, int value)
{
    lua_pushboolean(L, value);
    lua_setfield(L, -2, name);
}

static void set_text(lua_State *L, const char *name, const char *value)
{
    lua_pushstring(L, value);
    lua_setfield(L, -2, name);
}

/// player_get_info(player): a table
static int player_get_info(lua_State *L)
{
    const player_box *box = to_player(L, 1);
    fe_player_info info;
    fe_player_info_init(&info, (uint32_t)sizeof info);
    if (fe_player_get_info(box->player, &info) != FE_OK) return raise_last(L);
    lua_createtable(L, 0, 11);
    set_integer(L, "library", info.library), set_integer(L, "flags", info.flags);
    set_boolean(L, "foreign", info.foreign), set_boolean(L, "hasDiverged", info.has_diverged);
    set_integer(L, "firstStep", (long long)info.first_step), set_integer(L, "lastStep", (long long)info.last_step);
    set_integer(L, "step", (long long)info.step), set_integer(L, "calls", (long long)info.calls);
    set_integer(L, "bytes", (long long)info.bytes);
    set_integer(L, "keyframes", info.keyframes), set_integer(L, "notes", info.notes);
    return 1;
}

/// player_get_notes(player): a table of tables
static int player_get_notes(lua_State *L)
{
    const player_box *box = to_player(L, 1);
    int32_t count = fe_player_get_notes(box->player, NULL, (uint32_t)sizeof(fe_note), 0);
    if (count < 0) return raise_last(L);
    fe_note *notes = lua_newuserdata(L, (size_t)(count + 1) * sizeof *notes);
    if (fe_player_get_notes(box->player, notes, (uint32_t)sizeof *notes, count) < 0) return raise_last(L);
    lua_createtable(L, count, 0);
    for (int32_t i = 0; i < count; ++i) {
        lua_createtable(L, 0, 3);
        set_integer(L, "step", (long long)notes[i].step), set_integer(L, "about", (long long)notes[i].about);
        set_text(L, "text", notes[i].text);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

/// player_get_divergence(player): a table
static int player_get_divergence(lua_State *L)
{
    const player_box *box = to_player(L, 1);
    fe_divergence found;
    fe_divergence_init(&found, (uint32_t)sizeof found);
    if (fe_player_get_divergence(box->player, &found) != FE_OK) return raise_last(L);
    lua_createtable(L, 0, 6);
    set_integer(L, "type", found.type), set_integer(L, "step", (long long)found.step);
    set_integer(L, "body", (long long)found.body), set_integer(L, "component", found.component);
    set_text(L, "field", found.field), set_text(L, "text", found.text);
    return 1;
}

#endif
