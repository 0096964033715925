// Errors of the C module: Lua errors that begin with the position of the caller's line, not of the package's own.
#ifndef FE_BINDINGS_LUA_ERRORS_H
#define FE_BINDINGS_LUA_ERRORS_H

#include "feather.h"

#include <lauxlib.h>
#include <lua.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// In the registry: what the chunk names of the package's own Lua files begin with, see hide_lines.
#define HIDDEN_LINES "feather.hidden_lines"

/// hide_lines(prefix): lines of chunks whose names begin so are the package's own.
static int hide_lines(lua_State *L)
{
    luaL_checkstring(L, 1);
    lua_settop(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, HIDDEN_LINES);
    return 0;
}

/// Pushes "file:line: " of the innermost line that is not the package's own, or "".
static void push_position(lua_State *L)
{
    lua_getfield(L, LUA_REGISTRYINDEX, HIDDEN_LINES);
    const char *hidden = lua_tostring(L, -1);
    lua_Debug frame;
    for (int level = 1; lua_getstack(L, level, &frame); ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline <= 0 || (hidden && strncmp(frame.source, hidden, strlen(hidden)) == 0)) continue;
        lua_pushfstring(L, "%s:%d: ", frame.short_src, frame.currentline);
        lua_remove(L, -2);
        return;
    }
    lua_pop(L, 1);
    lua_pushstring(L, "");
}

/// Raises an error; formats are those of lua_pushfstring.
static int fail(lua_State *L, const char *format, ...)
{
    va_list arguments;
    luaL_checkstack(L, 4, "feather");
    push_position(L);
    va_start(arguments, format);
    lua_pushvfstring(L, format, arguments);
    va_end(arguments);
    lua_concat(L, 2);
    return lua_error(L);
}

/// Raises the library's last error. It is copied first: what Lua allocates may run a finalizer, whose call may be
/// refused.
static int raise_last(lua_State *L)
{
    char sentence[512]; // more than the library keeps
    snprintf(sentence, sizeof sentence, "%s", fe_last_error());
    return fail(L, "%s", sentence);
}

#endif
