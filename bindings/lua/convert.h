// What Lua values become on their way into the library and back, for Lua 5.1 to 5.4. Worlds and pools are userdata that own them; arrays on
// the way in are userdata too, so that the collector frees them whatever fails.
#ifndef FE_BINDINGS_LUA_CONVERT_H
#define FE_BINDINGS_LUA_CONVERT_H

#include "feather.h"

#include <lauxlib.h>
#include <limits.h>
#include <lua.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Both begin like SWIG's own userdata (type, own, pointer), so that SWIG sees by the type that they are no definition.
typedef struct world_box {
    const void *type;
    int own;
    fe_world *world; ///< NULL: closed
} world_box;

typedef struct pool_box {
    const void *type;
    int own;
    fe_pool *pool; ///< NULL: closed
} pool_box;

/// How many records the arrays of a call have.
typedef struct call_state {
    int32_t count;
} call_state;

static const char world_type[] = "feather.world";
static const char pool_type[] = "feather.pool";

static int raise_last(lua_State *L) { return luaL_error(L, "%s", fe_last_error()); }

static int ends_with(const char *text, const char *end)
{
    size_t a = strlen(text), b = strlen(end);
    return a >= b && strcmp(text + a - b, end) == 0;
}

// ---- worlds and pools -----------------------------------------------------------------------------------------------------------

static int collect_world(lua_State *L)
{
    world_box *box = luaL_checkudata(L, 1, world_type);
    if (box->world && fe_world_destroy(box->world) == FE_OK) box->world = NULL;
    return 0;
}

static int collect_pool(lua_State *L)
{
    pool_box *box = luaL_checkudata(L, 1, pool_type);
    if (box->pool && fe_pool_destroy(box->pool) == FE_OK) box->pool = NULL;
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
}

static size_t raw_length(lua_State *L, int index)
{
#if LUA_VERSION_NUM >= 502
    return lua_rawlen(L, index);
#else
    return lua_objlen(L, index);
#endif
}

/// The object of a type at an index, or NULL for nil. SWIG's own would take the first bytes of any userdata for its own, a file's too.
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

/// A new world, on top of the stack, keeps the pool that its definition, at 1, keeps: a pool whose finalizer comes first is refused its
/// end, its threads outlive the state, and the library is unloaded under them.
static void keep_pool(lua_State *L)
{
    if (lua_type(L, 1) != LUA_TUSERDATA) return;
#if LUA_VERSION_NUM >= 502
    lua_getuservalue(L, 1);
    lua_setuservalue(L, -2);
#else
    lua_getfenv(L, 1);
    lua_setfenv(L, -2);
#endif
}

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

static void push_world(lua_State *L, fe_world *world)
{
    world_box *box = lua_newuserdata(L, sizeof *box);
    *box = (world_box){SWIGTYPE_p_fe_world, 0, world};
    luaL_getmetatable(L, world_type);
    lua_setmetatable(L, -2);
}

static void push_pool(lua_State *L, fe_pool *pool)
{
    pool_box *box = lua_newuserdata(L, sizeof *box);
    *box = (pool_box){SWIGTYPE_p_fe_pool, 0, pool};
    luaL_getmetatable(L, pool_type);
    lua_setmetatable(L, -2);
}

static fe_world *world_in(lua_State *L, const world_box *box)
{
    if (!box->world) luaL_error(L, "feather: the world is destroyed");
    return box->world;
}

static fe_world *world_of(lua_State *L, int index) { return world_in(L, luaL_checkudata(L, index, world_type)); }

static fe_pool *pool_of(lua_State *L, int index)
{
    if (lua_isnoneornil(L, index)) return NULL;
    pool_box *box = luaL_checkudata(L, index, pool_type);
    if (!box->pool) luaL_error(L, "feather: the pool is destroyed");
    return box->pool;
}

// ---- numbers --------------------------------------------------------------------------------------------------------------------

static double to_number(lua_State *L, int index, const char *what)
{
    if (lua_type(L, index) != LUA_TNUMBER) luaL_error(L, "feather: %s: a number is needed, not a %s", what, luaL_typename(L, index));
    return (double)lua_tonumber(L, index);
}

static long long to_integer(lua_State *L, int index, long long low, long long high, const char *what)
{
    double number = to_number(L, index, what);
    if (!(number >= (double)low && number <= (double)high) || number != (double)(long long)number)
        luaL_error(L, "feather: %s: %f is no integer of its range", what, number);
    return (long long)number;
}

static void push_integer(lua_State *L, long long value)
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

static double at(lua_State *L, int table, int i, const char *what)
{
    lua_rawgeti(L, table, i);
    if (lua_type(L, -1) != LUA_TNUMBER) luaL_error(L, "feather: %s: item %d is no number", what, i);
    double value = (double)lua_tonumber(L, -1);
    lua_pop(L, 1);
    return value;
}

static void check_table(lua_State *L, int index, const char *what)
{
    if (!lua_istable(L, index)) luaL_error(L, "feather: %s: a table is needed, not a %s", what, luaL_typename(L, index));
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
    value->position.x = at(L, t, first, what), value->position.y = at(L, t, first + 1, what), value->position.z = at(L, t, first + 2, what);
    quat_at(L, t, first + 3, &value->rotation, what);
}

/// {x, y, z, qx, qy, qz, qw}
static void to_transform(lua_State *L, int t, fe_transform *value, const char *what)
{
    check_table(L, t, what);
    transform_at(L, t, 1, value, what);
}

/// In the order of fe_material's fields.
static void to_material(lua_State *L, int t, fe_material *m, const char *what)
{
    check_table(L, t, what);
    m->static_friction = (float)at(L, t, 1, what), m->dynamic_friction = (float)at(L, t, 2, what),
    m->restitution = (float)at(L, t, 3, what);
    m->rolling_resistance = (float)at(L, t, 4, what), m->spinning_resistance = (float)at(L, t, 5, what);
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
    lua_pushnumber(L, (double)q->x), lua_pushnumber(L, (double)q->y), lua_pushnumber(L, (double)q->z), lua_pushnumber(L, (double)q->w);
    return 4;
}

static int push_transform(lua_State *L, const fe_transform *t) { return push_dvec3(L, &t->position) + push_quat(L, &t->rotation); }

static int push_material(lua_State *L, const fe_material *m)
{
    lua_pushnumber(L, (double)m->static_friction), lua_pushnumber(L, (double)m->dynamic_friction),
        lua_pushnumber(L, (double)m->restitution);
    lua_pushnumber(L, (double)m->rolling_resistance), lua_pushnumber(L, (double)m->spinning_resistance);
    return 5;
}

// ---- arrays that go in ----------------------------------------------------------------------------------------------------------

static void *new_array(lua_State *L, int32_t count, size_t record)
{
    luaL_checkstack(L, 8, "feather");
    return lua_newuserdata(L, (size_t)(count > 0 ? count : 0) * record + 64);
}

static float *new_heights(lua_State *L, int32_t rows, int32_t columns)
{
    int64_t count = rows > 0 && columns > 0 ? (int64_t)rows * columns : 0;
    if (count > 1 << 28) luaL_error(L, "feather: more than 2^28 heights");
    return new_array(L, (int32_t)count, sizeof(float));
}

static int length_of(lua_State *L, int index, const char *what)
{
    check_table(L, index, what);
    size_t length = raw_length(L, index);
    if (length > 1 << 28) luaL_error(L, "feather: %s: too long", what);
    return (int)length;
}

/// How many records of `width` numbers a table has, which must be as many as other tables of the call have.
static int records_in(lua_State *L, int index, int width, call_state *call, const char *what)
{
    int length = length_of(L, index, what);
    if (length % width) luaL_error(L, "feather: %s: %d numbers are not whole records of %d", what, length, width);
    if (call->count && call->count != length / width)
        luaL_error(L, "feather: %s: %d records where the other table has %d", what, length / width, (int)call->count);
    call->count = length / width;
    return length / width;
}

static fe_handle *to_handles(lua_State *L, int index, call_state *call, const char *what)
{
    int count = records_in(L, index, 1, call, what);
    fe_handle *handles = new_array(L, count, sizeof *handles);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        handles[i] = (fe_handle)to_integer(L, -1, 0, 1LL << 53, what);
        lua_pop(L, 1);
    }
    return handles;
}

static float *to_floats(lua_State *L, int index, int width, call_state *call, const char *what)
{
    int count = records_in(L, index, width, call, what) * width;
    float *floats = new_array(L, count, sizeof *floats);
    for (int i = 0; i < count; ++i) floats[i] = (float)at(L, index, i + 1, what);
    return floats;
}

static fe_transform *to_transforms(lua_State *L, int index, call_state *call, const char *what)
{
    int count = records_in(L, index, 7, call, what);
    fe_transform *transforms = new_array(L, count, sizeof *transforms);
    for (int i = 0; i < count; ++i) transform_at(L, index, 7 * i + 1, &transforms[i], what);
    return transforms;
}

static fe_ray *to_rays(lua_State *L, int index, call_state *call, const char *what)
{
    int count = records_in(L, index, 6, call, what);
    fe_ray *rays = new_array(L, count, sizeof *rays);
    for (int i = 0; i < count; ++i) {
        int n = 6 * i;
        rays[i].origin = (fe_dvec3){at(L, index, n + 1, what), at(L, index, n + 2, what), at(L, index, n + 3, what)};
        rays[i].translation = (fe_dvec3){at(L, index, n + 4, what), at(L, index, n + 5, what), at(L, index, n + 6, what)};
    }
    return rays;
}

static fe_path *to_paths(lua_State *L, int index, call_state *call, const char *what)
{
    int count = records_in(L, index, 10, call, what);
    fe_path *paths = new_array(L, count, sizeof *paths);
    for (int i = 0; i < count; ++i) {
        int n = 10 * i;
        transform_at(L, index, n + 1, &paths[i].start, what);
        paths[i].translation = (fe_dvec3){at(L, index, n + 8, what), at(L, index, n + 9, what), at(L, index, n + 10, what)};
    }
    return paths;
}

static void heights_fit(lua_State *L, int32_t have, int32_t rows, int32_t columns)
{
    if (rows > 0 && columns > 0 && (int64_t)rows * columns > have)
        luaL_error(L, "feather: heights: %d where %d x %d are needed", (int)have, (int)rows, (int)columns);
}

/// Reads field `name` of the table at `index` onto the stack.
static int field(lua_State *L, int index, const char *name)
{
    lua_getfield(L, index, name);
    return lua_gettop(L);
}

/// {mask = ..., flags = ..., excluded = {bodies}}, each optional; nil is no filter.
static fe_query_filter *to_filter(lua_State *L, int index, fe_query_filter *filter)
{
    if (lua_isnoneornil(L, index)) return NULL;
    check_table(L, index, "filter");
    fe_query_filter_init(filter, (uint32_t)sizeof *filter);
    int mask = field(L, index, "mask"), flags = field(L, index, "flags"), excluded = field(L, index, "excluded");
    if (!lua_isnil(L, mask)) filter->mask = (uint32_t)to_integer(L, mask, 0, UINT32_MAX, "mask");
    if (!lua_isnil(L, flags)) filter->flags = (uint32_t)to_integer(L, flags, 0, UINT32_MAX, "flags");
    if (!lua_isnil(L, excluded)) {
        call_state call = {0};
        filter->excluded = to_handles(L, excluded, &call, "excluded");
        filter->excluded_count = call.count;
    }
    return filter;
}

static const uint8_t *to_cells(lua_State *L, int index, int cells, const char *what)
{
    if (lua_isnil(L, index)) return NULL;
    if (length_of(L, index, what) != cells) luaL_error(L, "feather: %s: %d numbers are needed", what, cells);
    uint8_t *bytes = new_array(L, cells, 1);
    for (int i = 0; i < cells; ++i) {
        lua_rawgeti(L, index, i + 1);
        bytes[i] = (uint8_t)to_integer(L, -1, 0, UINT8_MAX, what);
        lua_pop(L, 1);
    }
    return bytes;
}

static void to_materials(lua_State *L, int index, fe_heightfield_def *def)
{
    if (lua_isnil(L, index)) return;
    int count = length_of(L, index, "materials");
    if (count > 255) luaL_error(L, "feather: materials: at most 255");
    fe_material *materials = new_array(L, count, sizeof *materials);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        to_material(L, lua_gettop(L), &materials[i], "materials");
        lua_pop(L, 1);
    }
    def->materials = materials;
    def->material_count = count;
}

/// {rows=, columns=, cell_x=, cell_z=, heights={...}, holes=, cell_materials=, materials={{...}}}; the last three are optional.
static void to_heightfield(lua_State *L, int index, fe_heightfield_def *def)
{
    enum { MOST = 32768 };
    check_table(L, index, "heightfield");
    fe_heightfield_def_init(def, (uint32_t)sizeof *def);
    def->rows = (int32_t)to_integer(L, field(L, index, "rows"), 2, MOST, "rows");
    def->columns = (int32_t)to_integer(L, field(L, index, "columns"), 2, MOST, "columns");
    def->cell_x = (float)to_number(L, field(L, index, "cell_x"), "cell_x");
    def->cell_z = (float)to_number(L, field(L, index, "cell_z"), "cell_z");
    call_state call = {0};
    def->heights = to_floats(L, field(L, index, "heights"), 1, &call, "heights");
    heights_fit(L, call.count, def->rows, def->columns);
    int cells = (def->rows - 1) * (def->columns - 1);
    def->holes = to_cells(L, field(L, index, "holes"), cells, "holes");
    def->cell_materials = to_cells(L, field(L, index, "cell_materials"), cells, "cell_materials");
    to_materials(L, field(L, index, "materials"), def);
}

// ---- arrays that come out: flat tables, the fields of a record one after the other -------------------------------------------------

static int32_t array_length(int32_t result, int32_t count) { return result > 0 && !count ? result : count; }

static void put(lua_State *L, int *n, double value)
{
    lua_pushnumber(L, (lua_Number)value);
    lua_rawseti(L, -2, ++*n);
}

static void put_integer(lua_State *L, int *n, long long value)
{
    push_integer(L, value);
    lua_rawseti(L, -2, ++*n);
}

static void put_vec3(lua_State *L, int *n, const fe_vec3 *v) { put(L, n, (double)v->x), put(L, n, (double)v->y), put(L, n, (double)v->z); }

static void put_dvec3(lua_State *L, int *n, const fe_dvec3 *v) { put(L, n, v->x), put(L, n, v->y), put(L, n, v->z); }

static void put_pair(lua_State *L, int *n, fe_body a, fe_body b, fe_shape shape_a, fe_shape shape_b)
{
    put_integer(L, n, (long long)a), put_integer(L, n, (long long)b);
    put_integer(L, n, (long long)shape_a), put_integer(L, n, (long long)shape_b);
}

#define PUSH_ALL(NAME, TYPE, WIDTH, PUT)                            \
    static void NAME(lua_State *L, const TYPE *all, int32_t count)  \
    {                                                               \
        int n = 0;                                                  \
        lua_createtable(L, all &&count > 0 ? (WIDTH)*count : 0, 0); \
        for (int32_t i = 0; all && i < count; ++i) {                \
            const TYPE *e = &all[i];                                \
            PUT;                                                    \
        }                                                           \
    }
// one scalar after the other, in the order of the struct's fields
PUSH_ALL(push_handles, fe_handle, 1, put_integer(L, &n, (long long)*e))
PUSH_ALL(push_floats, float, 1, put(L, &n, (double)*e))
PUSH_ALL(push_transforms, fe_transform, 7,
         (put_dvec3(L, &n, &e->position), put(L, &n, (double)e->rotation.x), put(L, &n, (double)e->rotation.y),
          put(L, &n, (double)e->rotation.z), put(L, &n, (double)e->rotation.w)))
PUSH_ALL(push_hits, fe_hit, 12,
         (put_integer(L, &n, (long long)e->body), put_integer(L, &n, (long long)e->shape), put_dvec3(L, &n, &e->point),
          put(L, &n, e->fraction), put_vec3(L, &n, &e->normal), put_integer(L, &n, e->triangle), put(L, &n, (double)e->depth),
          put_integer(L, &n, e->flags)))
PUSH_ALL(push_pair_events, fe_pair_event, 6,
         (put_pair(L, &n, e->body_a, e->body_b, e->shape_a, e->shape_b), put_integer(L, &n, e->kind), put_integer(L, &n, e->is_trigger)))
PUSH_ALL(push_body_events, fe_body_event, 3, (put_integer(L, &n, (long long)e->body), put_integer(L, &n, e->kind), put_integer(L, &n, 0)))
PUSH_ALL(push_hit_events, fe_hit_event, 13,
         (put_pair(L, &n, e->body_a, e->body_b, e->shape_a, e->shape_b), put_dvec3(L, &n, &e->point), put_vec3(L, &n, &e->normal),
          put(L, &n, (double)e->speed), put(L, &n, (double)e->impulse), put_integer(L, &n, 0)))
PUSH_ALL(push_joint_events, fe_joint_event, 12,
         (put_pair(L, &n, e->joint, e->body_a, e->body_b, e->user_data), put_integer(L, &n, e->kind), put_integer(L, &n, e->type),
          put_vec3(L, &n, &e->force), put_vec3(L, &n, &e->torque)))

static void put_contact(lua_State *L, int *n, const fe_contact *e)
{
    put_pair(L, n, e->body_a, e->body_b, e->shape_a, e->shape_b);
    put_vec3(L, n, &e->normal);
    put_integer(L, n, e->point_count);
    for (int i = 0; i < 4; ++i) {
        const fe_contact_point *p = &e->points[i];
        put_dvec3(L, n, &p->point), put(L, n, (double)p->separation), put(L, n, (double)p->normal_impulse);
        put(L, n, (double)p->total_impulse), put_integer(L, n, p->id);
    }
    put_vec3(L, n, &e->friction_impulse);
    put(L, n, (double)e->twist_impulse), put_integer(L, n, e->triangle), put_integer(L, n, 0);
}
PUSH_ALL(push_contacts, fe_contact, 42, put_contact(L, &n, e))
#undef PUSH_ALL

#endif
