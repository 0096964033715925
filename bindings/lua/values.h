// Numbers, vectors and materials: Lua values on their way into the library, and values on their way out.
#ifndef FE_BINDINGS_LUA_VALUES_H
#define FE_BINDINGS_LUA_VALUES_H

#include "feather.h"
#include "lua/errors.h"

#include <lauxlib.h>
#include <lua.h>
#include <stdio.h>
#include <string.h>

/// Has the name of a function or a field this end?
static int ends_with(const char *name, const char *end)
{
    size_t length = strlen(name), tail = strlen(end);
    return length >= tail && strcmp(name + length - tail, end) == 0;
}

// ---- numbers --------------------------------------------------------------------------------------------------------

static size_t raw_length(lua_State *L, int index)
{
#if LUA_VERSION_NUM >= 502
    return lua_rawlen(L, index);
#else
    return lua_objlen(L, index);
#endif
}

static double to_number(lua_State *L, int index, const char *what)
{
    if (lua_type(L, index) != LUA_TNUMBER)
        fail(L, "feather: %s: a number is needed, not a %s", what, luaL_typename(L, index));
    return (double)lua_tonumber(L, index);
}

static long long to_integer(lua_State *L, int index, long long low, long long high, const char *what)
{
    double number = to_number(L, index, what);
    if (!(number >= (double)low && number <= (double)high) || number != (double)(long long)number)
        fail(L, "feather: %s: %f is no integer of its range", what, number);
    return (long long)number;
}

/// A string without zeros in it
static const char *to_text(lua_State *L, int index, const char *what)
{
    size_t size;
    if (lua_type(L, index) != LUA_TSTRING)
        fail(L, "feather: %s: a string is needed, not a %s", what, luaL_typename(L, index));
    const char *text = lua_tolstring(L, index, &size);
    if (strlen(text) != size) fail(L, "feather: %s: it has a zero in it", what);
    return text;
}

static void push_integer(lua_State *L, long long value)
{
#if LUA_VERSION_NUM >= 503
    lua_pushinteger(L, (lua_Integer)value);
#else
    lua_pushnumber(L, (lua_Number)value);
#endif
}

/// 64 bits. Lua 5.3 and later hold them as integers in two's complement, Lua 5.1 as doubles up to 2^53.
static uint64_t to_u64(lua_State *L, int index, const char *what)
{
#if LUA_VERSION_NUM >= 503
    if (lua_isinteger(L, index)) return (uint64_t)lua_tointeger(L, index);
#endif
    return (uint64_t)to_integer(L, index, 0, 1LL << 53, what);
}

static void push_u64(lua_State *L, uint64_t value)
{
#if LUA_VERSION_NUM >= 503
    lua_pushinteger(L, (lua_Integer)value);
#else
    lua_pushnumber(L, (lua_Number)value);
#endif
}

/// The hash as 16 hexadecimal digits, as every language prints it.
static void push_words(lua_State *L, const uint32_t *words)
{
    char text[20];
    snprintf(text, sizeof text, "%08x%08x", (unsigned)words[1], (unsigned)words[0]);
    lua_pushstring(L, text);
}

/// The key of an asset as 32 hexadecimal digits, in the order in which errors tell it.
static void push_key(lua_State *L, const fe_asset_key *key)
{
    char text[40];
    snprintf(text, sizeof text, "%016llx%016llx", (unsigned long long)key->words[0], (unsigned long long)key->words[1]);
    lua_pushstring(L, text);
}

static double at(lua_State *L, int table, int i, const char *what)
{
    lua_rawgeti(L, table, i);
    if (lua_type(L, -1) != LUA_TNUMBER) fail(L, "feather: %s: item %d is no number", what, i);
    double value = (double)lua_tonumber(L, -1);
    lua_pop(L, 1);
    return value;
}

static void check_table(lua_State *L, int index, const char *what)
{
    if (!lua_istable(L, index)) fail(L, "feather: %s: a table is needed, not a %s", what, luaL_typename(L, index));
}

static void to_vec3(lua_State *L, int t, fe_vec3 *v, const char *what)
{
    check_table(L, t, what);
    v->x = (float)at(L, t, 1, what), v->y = (float)at(L, t, 2, what), v->z = (float)at(L, t, 3, what);
}

static void to_dvec3(lua_State *L, int t, fe_dvec3 *v, const char *what)
{
    check_table(L, t, what);
    v->x = at(L, t, 1, what), v->y = at(L, t, 2, what), v->z = at(L, t, 3, what);
}

static void quat_at(lua_State *L, int t, int first, fe_quat *q, const char *what)
{
    q->x = (float)at(L, t, first, what), q->y = (float)at(L, t, first + 1, what);
    q->z = (float)at(L, t, first + 2, what), q->w = (float)at(L, t, first + 3, what);
}

static void to_quat(lua_State *L, int t, fe_quat *q, const char *what)
{
    check_table(L, t, what);
    quat_at(L, t, 1, q, what);
}

static void transform_at(lua_State *L, int t, int first, fe_transform *value, const char *what)
{
    value->position.x = at(L, t, first, what), value->position.y = at(L, t, first + 1, what),
    value->position.z = at(L, t, first + 2, what);
    quat_at(L, t, first + 3, &value->rotation, what);
}

/// {x, y, z, qx, qy, qz, qw}
static void to_transform(lua_State *L, int t, fe_transform *value, const char *what)
{
    check_table(L, t, what);
    transform_at(L, t, 1, value, what);
}

/// {x, y, z, qx, qy, qz, qw}
static void to_frame(lua_State *L, int t, fe_frame *value, const char *what)
{
    to_vec3(L, t, &value->position, what);
    quat_at(L, t, 4, &value->rotation, what);
}

/// {lower x, y, z, upper x, y, z}
static void to_bounds(lua_State *L, int t, fe_bounds *value, const char *what)
{
    to_dvec3(L, t, &value->lower, what);
    value->upper.x = at(L, t, 4, what), value->upper.y = at(L, t, 5, what), value->upper.z = at(L, t, 6, what);
}

/// 8 numbers, in the order of fe_material's fields.
static void to_material(lua_State *L, int t, fe_material *m, const char *what)
{
    check_table(L, t, what);
    fe_material_init(m);
    m->static_friction = (float)at(L, t, 1, what), m->dynamic_friction = (float)at(L, t, 2, what);
    m->restitution = (float)at(L, t, 3, what);
    m->rolling_resistance = (float)at(L, t, 4, what), m->spinning_resistance = (float)at(L, t, 5, what);
    lua_rawgeti(L, t, 6), lua_rawgeti(L, t, 7), lua_rawgeti(L, t, 8);
    int top = lua_gettop(L);
    m->friction_combine = (int32_t)to_integer(L, top - 2, INT32_MIN, INT32_MAX, what);
    m->restitution_combine = (int32_t)to_integer(L, top - 1, INT32_MIN, INT32_MAX, what);
    m->user_id = to_u64(L, top, what);
    lua_pop(L, 3);
}

static int push_dvec3(lua_State *L, const fe_dvec3 *v)
{
    lua_pushnumber(L, v->x), lua_pushnumber(L, v->y), lua_pushnumber(L, v->z);
    return 3;
}

static int push_vec3(lua_State *L, const fe_vec3 *v)
{
    lua_pushnumber(L, (double)v->x), lua_pushnumber(L, (double)v->y), lua_pushnumber(L, (double)v->z);
    return 3;
}

static int push_quat(lua_State *L, const fe_quat *q)
{
    lua_pushnumber(L, (double)q->x), lua_pushnumber(L, (double)q->y);
    lua_pushnumber(L, (double)q->z), lua_pushnumber(L, (double)q->w);
    return 4;
}

static int push_transform(lua_State *L, const fe_transform *t)
{
    return push_dvec3(L, &t->position) + push_quat(L, &t->rotation);
}

static int push_frame(lua_State *L, const fe_frame *f)
{
    return push_vec3(L, &f->position) + push_quat(L, &f->rotation);
}

static int push_bounds(lua_State *L, const fe_bounds *b) { return push_dvec3(L, &b->lower) + push_dvec3(L, &b->upper); }

static int push_material(lua_State *L, const fe_material *m)
{
    lua_pushnumber(L, (lua_Number)m->static_friction), lua_pushnumber(L, (lua_Number)m->dynamic_friction);
    lua_pushnumber(L, (lua_Number)m->restitution);
    lua_pushnumber(L, (lua_Number)m->rolling_resistance), lua_pushnumber(L, (lua_Number)m->spinning_resistance);
    push_integer(L, m->friction_combine), push_integer(L, m->restitution_combine);
    push_u64(L, m->user_id);
    return 8;
}

static int push_nil(lua_State *L)
{
    lua_pushnil(L);
    return 1;
}

/// A hit as values, in the order of fe_hit's fields.
static int push_hit(lua_State *L, const fe_hit *h)
{
    luaL_checkstack(L, 20, "feather");
    push_integer(L, (long long)h->body), push_integer(L, (long long)h->shape);
    push_dvec3(L, &h->point), lua_pushnumber(L, h->fraction);
    push_u64(L, h->material);
    push_vec3(L, &h->normal), lua_pushnumber(L, (lua_Number)h->depth);
    push_integer(L, h->part), push_integer(L, h->triangle);
    lua_pushnumber(L, (lua_Number)h->barycentric[0]), lua_pushnumber(L, (lua_Number)h->barycentric[1]);
    push_integer(L, h->flags);
    return 16;
}

/// Likewise of fe_closest.
static int push_closest(lua_State *L, const fe_closest *c)
{
    luaL_checkstack(L, 20, "feather");
    push_integer(L, (long long)c->body), push_integer(L, (long long)c->shape);
    push_dvec3(L, &c->point), lua_pushnumber(L, c->distance);
    push_u64(L, c->material);
    push_vec3(L, &c->normal);
    push_integer(L, c->part), push_integer(L, c->triangle);
    lua_pushnumber(L, (lua_Number)c->barycentric[0]), lua_pushnumber(L, (lua_Number)c->barycentric[1]);
    return 14;
}

#endif
