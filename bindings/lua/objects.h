// SWIG's own objects: definitions and results. What they are is checked strictly, and nothing reaches into them unseen.
// Included behind SWIG's runtime, whose checks it replaces.
#ifndef FE_BINDINGS_LUA_OBJECTS_H
#define FE_BINDINGS_LUA_OBJECTS_H

#include "lua/values.h"

#include <lauxlib.h>
#include <lua.h>

/// The object of a type at an index, or NULL for nil. SWIG's own would take the first bytes of any userdata for its
/// own, a file's too.
static int object_of(lua_State *L, int index, void **out, const swig_type_info *type)
{
    *out = NULL;
    if (lua_isnil(L, index)) return SWIG_OK;
    if (lua_type(L, index) != LUA_TUSERDATA || raw_length(L, index) < sizeof(swig_lua_userdata)) return SWIG_ERROR;
    const swig_lua_userdata *object = lua_touserdata(L, index);
    if (object->type != type) return SWIG_ERROR;
    *out = object->ptr;
    return SWIG_OK;
}
#undef SWIG_ConvertPtr
#undef SWIG_isptrtype
#define SWIG_ConvertPtr(L, index, out, type, flags) object_of(L, index, out, type)
#define SWIG_isptrtype(L, index) (lua_type(L, index) == LUA_TUSERDATA || lua_isnil(L, index))
#define SWIG_Lua_typename(L, index) luaL_typename(L, index)

/// Takes away what would reach into userdata unchecked: SWIG's helpers, the metatables of the objects, and their ==.
static void hide_helpers(lua_State *L, const swig_module_info *module)
{
    lua_pushnil(L), lua_setfield(L, -2, "swig_type");
    lua_pushnil(L), lua_setfield(L, -2, "swig_equals");
    for (size_t i = 0; i < module->size; ++i) {
        const swig_lua_class *class = module->types[i]->clientdata;
        if (!class) continue;
        SWIG_Lua_get_class_metatable(L, class->fqname);
        if (lua_istable(L, -1)) {
            lua_pushstring(L, "feather");
            lua_setfield(L, -2, "__metatable");
            lua_pushnil(L), lua_setfield(L, -2, "__eq");
        }
        lua_pop(L, 1);
    }
}

#endif
