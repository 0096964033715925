// Arrays: flat tables of numbers. Those on the way in become userdata, so that the collector frees them whatever fails.
#ifndef FE_BINDINGS_LUA_ARRAYS_H
#define FE_BINDINGS_LUA_ARRAYS_H

#include "feather.h"
#include "lua/values.h"

#include <lauxlib.h>
#include <lua.h>

/// How many records the arrays of a call have.
typedef struct call_state {
    int32_t count;
    int is_counted; ///< a table came already, it may have been empty
} call_state;

// ---- arrays that go in ----------------------------------------------------------------------------------------------

static void *new_array(lua_State *L, int32_t count, size_t record)
{
    luaL_checkstack(L, 8, "feather");
    return lua_newuserdata(L, (size_t)(count > 0 ? count : 0) * record + 64);
}

static float *new_heights(lua_State *L, int32_t rows, int32_t columns)
{
    int64_t count = rows > 0 && columns > 0 ? (int64_t)rows * columns : 0;
    if (count > 1 << 28) fail(L, "feather: more than 2^28 heights");
    return new_array(L, (int32_t)count, sizeof(float));
}

static int length_of(lua_State *L, int index, const char *what)
{
    check_table(L, index, what);
    size_t length = raw_length(L, index);
    if (length > 1 << 28) fail(L, "feather: %s: too long", what);
    return (int)length;
}

/// How many records of `width` numbers a table has, which must be as many as other tables of the call have.
static int records_in(lua_State *L, int index, int width, call_state *call, const char *what)
{
    int length = length_of(L, index, what);
    if (length % width) fail(L, "feather: %s: %d numbers are not whole records of %d", what, length, width);
    if (call->is_counted && call->count != length / width)
        fail(L, "feather: %s: %d records where the other table has %d", what, length / width, (int)call->count);
    call->count = length / width, call->is_counted = 1;
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
        rays[i] = (fe_ray){0};
        rays[i].origin = (fe_dvec3){at(L, index, n + 1, what), at(L, index, n + 2, what), at(L, index, n + 3, what)};
        rays[i].translation =
            (fe_dvec3){at(L, index, n + 4, what), at(L, index, n + 5, what), at(L, index, n + 6, what)};
    }
    return rays;
}

static fe_path *to_paths(lua_State *L, int index, call_state *call, const char *what)
{
    int count = records_in(L, index, 10, call, what);
    fe_path *paths = new_array(L, count, sizeof *paths);
    for (int i = 0; i < count; ++i) {
        int n = 10 * i;
        paths[i] = (fe_path){0};
        transform_at(L, index, n + 1, &paths[i].start, what);
        paths[i].translation =
            (fe_dvec3){at(L, index, n + 8, what), at(L, index, n + 9, what), at(L, index, n + 10, what)};
    }
    return paths;
}

static void heights_fit(lua_State *L, int32_t have, int32_t rows, int32_t columns)
{
    if (rows > 0 && columns > 0 && (int64_t)rows * columns > have)
        fail(L, "feather: heights: %d where %d x %d are needed", (int)have, (int)rows, (int)columns);
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

// ---- arrays that come out -------------------------------------------------------------------------------------------
//
// The scalars of a record one after the other, in the order of the struct's fields, without the reserved ones.

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

static void put_u64(lua_State *L, int *n, uint64_t value)
{
    push_u64(L, value);
    lua_rawseti(L, -2, ++*n);
}

static void put_vec3(lua_State *L, int *n, const fe_vec3 *v)
{
    put(L, n, (double)v->x), put(L, n, (double)v->y), put(L, n, (double)v->z);
}

static void put_dvec3(lua_State *L, int *n, const fe_dvec3 *v) { put(L, n, v->x), put(L, n, v->y), put(L, n, v->z); }

static void put_handles(lua_State *L, int *n, fe_handle a, fe_handle b)
{
    put_integer(L, n, (long long)a), put_integer(L, n, (long long)b);
}

static void put_places(lua_State *L, int *n, int32_t part_a, int32_t part_b, int32_t triangle_a, int32_t triangle_b)
{
    put_integer(L, n, part_a), put_integer(L, n, part_b), put_integer(L, n, triangle_a), put_integer(L, n, triangle_b);
}

static void put_transform(lua_State *L, int *n, const fe_transform *e)
{
    put_dvec3(L, n, &e->position);
    put(L, n, (double)e->rotation.x), put(L, n, (double)e->rotation.y), put(L, n, (double)e->rotation.z);
    put(L, n, (double)e->rotation.w);
}

static void put_hit(lua_State *L, int *n, const fe_hit *e)
{
    put_handles(L, n, e->body, e->shape), put_dvec3(L, n, &e->point), put(L, n, e->fraction);
    put_u64(L, n, e->material);
    put_vec3(L, n, &e->normal), put(L, n, (double)e->depth);
    put_integer(L, n, e->part), put_integer(L, n, e->triangle);
    put(L, n, (double)e->barycentric[0]), put(L, n, (double)e->barycentric[1]);
    put_integer(L, n, e->flags);
}

static void put_overlap(lua_State *L, int *n, const fe_overlap *e)
{
    put_handles(L, n, e->body, e->shape), put_u64(L, n, e->material);
    put_vec3(L, n, &e->direction), put(L, n, (double)e->depth);
    put_integer(L, n, e->part), put_integer(L, n, e->triangle);
}

static void put_frame(lua_State *L, int *n, const fe_history_frame *f)
{
    put_integer(L, n, (long long)f->frame), put_integer(L, n, (long long)f->bytes);
}

static void put_pair_event(lua_State *L, int *n, const fe_pair_event *e)
{
    put_handles(L, n, e->body_a, e->body_b), put_handles(L, n, e->shape_a, e->shape_b);
    put_integer(L, n, e->kind), put_integer(L, n, e->is_trigger);
    put_places(L, n, e->part_a, e->part_b, e->triangle_a, e->triangle_b);
}

static void put_body_event(lua_State *L, int *n, const fe_body_event *e)
{
    put_integer(L, n, (long long)e->body), put_integer(L, n, e->kind);
}

static void put_hit_event(lua_State *L, int *n, const fe_hit_event *e)
{
    put_handles(L, n, e->body_a, e->body_b), put_handles(L, n, e->shape_a, e->shape_b);
    put_u64(L, n, e->material_a), put_u64(L, n, e->material_b);
    put_dvec3(L, n, &e->point), put_vec3(L, n, &e->normal), put(L, n, (double)e->speed), put(L, n, (double)e->impulse);
    put_places(L, n, e->part_a, e->part_b, e->triangle_a, e->triangle_b);
}

static void put_joint_event(lua_State *L, int *n, const fe_joint_event *e)
{
    put_integer(L, n, (long long)e->joint), put_handles(L, n, e->body_a, e->body_b), put_u64(L, n, e->user_data);
    put_integer(L, n, e->kind), put_integer(L, n, e->type);
    put_vec3(L, n, &e->force), put_vec3(L, n, &e->torque);
}

static void put_contact(lua_State *L, int *n, const fe_contact *e)
{
    put_handles(L, n, e->body_a, e->body_b), put_handles(L, n, e->shape_a, e->shape_b);
    put_u64(L, n, e->material_a), put_u64(L, n, e->material_b);
    put_vec3(L, n, &e->normal), put_integer(L, n, e->point_count);
    for (int i = 0; i < 4; ++i) {
        const fe_contact_point *p = &e->points[i];
        put_dvec3(L, n, &p->point), put(L, n, (double)p->separation), put(L, n, (double)p->normal_impulse);
        put(L, n, (double)p->total_impulse), put_integer(L, n, p->id);
    }
    put_vec3(L, n, &e->friction_impulse), put(L, n, (double)e->twist_impulse);
    put_places(L, n, e->part_a, e->part_b, e->triangle_a, e->triangle_b);
}

static void put_draw_vertex(lua_State *L, int *n, const fe_draw_vertex *e)
{
    put(L, n, (double)e->x), put(L, n, (double)e->y), put(L, n, (double)e->z);
    put_integer(L, n, e->rgba), put_integer(L, n, (long long)e->owner);
}

static void put_draw_instance(lua_State *L, int *n, const fe_draw_instance *e)
{
    put_integer(L, n, e->type), put_integer(L, n, e->rgba);
    put_handles(L, n, e->shape, e->body), put_integer(L, n, (long long)e->asset);
    put_vec3(L, n, &e->position);
    put(L, n, (double)e->rotation.x), put(L, n, (double)e->rotation.y), put(L, n, (double)e->rotation.z);
    put(L, n, (double)e->rotation.w);
    put_vec3(L, n, &e->half_extents), put_integer(L, n, e->part);
}

#define PUSH_ALL(NAME, TYPE, WIDTH, PUT)                           \
    static void NAME(lua_State *L, const TYPE *all, int32_t count) \
    {                                                              \
        int n = 0;                                                 \
        int32_t length = all && count > 0 ? count : 0;             \
        lua_createtable(L, WIDTH *length, 0);                      \
        for (int32_t i = 0; i < length; ++i) PUT(L, &n, &all[i]);  \
    }
static void put_handle(lua_State *L, int *n, const fe_handle *e) { put_integer(L, n, (long long)*e); }
static void put_float(lua_State *L, int *n, const float *e) { put(L, n, (double)*e); }
static void put_index(lua_State *L, int *n, const int32_t *e) { put_integer(L, n, *e); }
static void put_face(lua_State *L, int *n, const fe_hull_face *e)
{
    put_integer(L, n, e->first), put_integer(L, n, e->count), put_vec3(L, n, &e->normal);
    put(L, n, (double)e->distance);
}
static void put_key(lua_State *L, int *n, const fe_asset_key *e)
{
    push_key(L, e);
    lua_rawseti(L, -2, ++*n);
}
PUSH_ALL(push_keys, fe_asset_key, 1, put_key)
PUSH_ALL(push_vertices, fe_vec3, 3, put_vec3)
PUSH_ALL(push_faces, fe_hull_face, 6, put_face)
PUSH_ALL(push_corners, int32_t, 1, put_index)
PUSH_ALL(push_frames, fe_history_frame, 2, put_frame)
PUSH_ALL(push_handles, fe_handle, 1, put_handle)
PUSH_ALL(push_floats, float, 1, put_float)
PUSH_ALL(push_transforms, fe_transform, 7, put_transform)
PUSH_ALL(push_hits, fe_hit, 16, put_hit)
PUSH_ALL(push_overlaps, fe_overlap, 9, put_overlap)
PUSH_ALL(push_pair_events, fe_pair_event, 10, put_pair_event)
PUSH_ALL(push_body_events, fe_body_event, 2, put_body_event)
PUSH_ALL(push_hit_events, fe_hit_event, 18, put_hit_event)
PUSH_ALL(push_joint_events, fe_joint_event, 12, put_joint_event)
PUSH_ALL(push_contacts, fe_contact, 46, put_contact)
PUSH_ALL(push_draw_vertices, fe_draw_vertex, 5, put_draw_vertex)
PUSH_ALL(push_draw_instances, fe_draw_instance, 16, put_draw_instance)
#undef PUSH_ALL

#endif
