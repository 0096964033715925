// fe_query.c - the API of queries by the thousand: one check of world and filter, and the world's workers when asked
// for.
#include "api/check.h"
#include "api/fe_store.h"
#include "core/fp_state.h"
#include "query/cast.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// ---- query ----------------------------------------------------------------------------------------------------------
// The functions of the query API share these: they read filters and geometries, and fill the scene.

enum { FE_LEAST_RECORD = 8 }; // bytes of a record that a caller may ask for

// `copy` is whole afterwards. NULL: the defaults.
fe_result fe__read_filter(const char *function, const fe_query_filter *filter, fe_query_filter *copy);
// A query moves any form with an inside but the half space; a sphere may have no radius. A hull is kept alive until
// fe__let_go_of_form, because another thread may destroy it.
typedef struct fe__moving_form {
    fe__form form;
    fe_store *store; // The form's hull belongs to this store. NULL: it has no hull
} fe__moving_form;
fe_result fe__read_moving_form(const char *function, const fe_world *world, const fe_geometry *geometry,
                               fe__moving_form *out_moving);
void fe__let_go_of_form(const fe__moving_form *moving);
// A form until the end of the block, whose name is `moving`.form
#define FE_READ_MOVING_FORM(world, geometry)                                 \
    fe__moving_form moving FE_CLEANUP(fe__let_go_of_form) = {.store = NULL}; \
    FE_TRY(fe__read_moving_form(function, world, geometry, &moving))
fe__scene fe__scene_of(const fe_world *world, const fe_query_filter *whole_filter);

// A query from its checked arguments to its hits. The scene points to the filter: it is not copied.
typedef struct fe__query {
    fe_query_filter filter; // whole
    fe__scene scene;
    fe__fp_state fp;
} fe__query;
static inline void fe__open_query(const fe_world *world, fe__query *query)
{
    query->fp = fe__fp_enter();
    query->scene = fe__scene_of(world, &query->filter);
}
// `filter` is the last argument that is checked
static inline fe_result fe__begin_query(const char *function, const fe_world *world, const fe_query_filter *filter,
                                        fe__query *query)
{
    FE_TRY(fe__read_filter(function, filter, &query->filter));
    fe__open_query(world, query);
    return FE_OK;
}
static inline void fe__end_query(const fe__query *query) { fe__fp_leave(query->fp); }

// ---- query many -----------------------------------------------------------------------------------------------------

enum {
    BLOCK = 32,      // queries that a worker claims at once: some 10 us
    LEAST_RAY = 48,  // bytes: origin and translation
    LEAST_PATH = 64, // bytes: start and translation
};

// Every argument is checked before the first answer is written.
typedef struct batch {
    fe__scene scene;
    const fe__form *form; // NULL: rays
    const void *ways;     // fe_ray or fe_path
    uint32_t way_stride;
    fe_hit *out_hits;
    uint32_t stride;
    _Atomic int32_t hits;
} batch;

// A stride may put them where no double is aligned.
static fe_ray ray_at(const void *rays, uint32_t stride, int32_t i)
{
    fe_ray ray = {.reserved = {0}};
    memcpy(&ray, fe__at_const(rays, stride, i), stride < sizeof ray ? stride : sizeof ray);
    return ray;
}

static fe_path path_at(const void *paths, uint32_t stride, int32_t i)
{
    fe_path path = {.reserved = {0}};
    memcpy(&path, fe__at_const(paths, stride, i), stride < sizeof path ? stride : sizeof path);
    return path;
}

static void set_probe(const batch *b, int32_t i, fe__probe *probe)
{
    if (!b->form) {
        fe_ray ray = ray_at(b->ways, b->way_stride, i);
        fe__probe_ray(probe, &ray.origin, &ray.translation);
        return;
    }
    fe_path path = path_at(b->ways, b->way_stride, i);
    *probe = fe__probe_turning(b->form, &path.start, path.translation, path.turn);
}

static void answer(void *argument, int32_t first, int32_t end, int32_t worker)
{
    (void)worker;
    batch *b = argument;
    int32_t hits = 0;
    for (int32_t i = first; i < end; ++i) {
        fe__probe probe;
        set_probe(b, i, &probe);
        fe_hit hit;
        if (fe__cast_closest(&b->scene, &probe, &hit))
            hits += 1;
        else
            hit = (fe_hit){.point = fe__dadd(probe.way.origin, probe.way.translation),
                           .fraction = 1.0,
                           .part = -1,
                           .triangle = -1};
        memcpy(fe__at(b->out_hits, b->stride, i), &hit, b->stride < sizeof hit ? b->stride : sizeof hit);
    }
    atomic_fetch_add_explicit(&b->hits, hits, memory_order_relaxed);
}

static int32_t answer_all(const fe_world *world, batch *b, int32_t count, int32_t spread)
{
    fe__fp_state fp = fe__fp_enter();
    if (spread)
        fe__parallel_for(&world->workers, count, BLOCK, answer, b);
    else
        answer(b, 0, count, 0);
    fe__fp_leave(fp);
    return atomic_load_explicit(&b->hits, memory_order_relaxed);
}

enum { NAME_SIZE = 48 }; // The longest name is "paths[2147483647].start.position".

static fe_result check_part(const char *function, const char *format, int32_t i, const fe_dvec3 *v, double most)
{
    if (fe__is_dvec3_within(v, most)) return FE_OK;
    char name[NAME_SIZE];
    snprintf(name, sizeof name, format, i);
    return fe__check_dvec3(function, name, v, most);
}

static fe_result check_ray(const char *function, const fe_ray *ray, int32_t i)
{
    FE_TRY(check_part(function, "rays[%" PRId32 "].origin", i, &ray->origin, FE_MAX_POSITION));
    FE_CHECK_RESERVED(ray->reserved);
    return check_part(function, "rays[%" PRId32 "].translation", i, &ray->translation, FE_MAX_TRANSLATION);
}

static fe_result check_path(const char *function, const fe_path *path, int32_t i)
{
    FE_TRY(check_part(function, "paths[%" PRId32 "].start.position", i, &path->start.position, FE_MAX_POSITION));
    FE_TRY(fe__check_quat(function, "start.rotation", &path->start.rotation));
    FE_TRY(fe__check_vec3(function, "turn", &path->turn, FE_MAX_TURN));
    FE_CHECK_RESERVED(path->reserved);
    return check_part(function, "paths[%" PRId32 "].translation", i, &path->translation, FE_MAX_TRANSLATION);
}

int32_t fe_world_raycast_many(const fe_world *world, const fe_ray *rays, uint32_t ray_stride, int32_t count,
                              const fe_query_filter *filter, int32_t spread, fe_hit *out_hits, uint32_t stride)
{
    FE_READ(world);
    FE_CHECK_ARRAY(rays, count);
    FE_CHECK_RECORD_STRIDE(ray_stride, LEAST_RAY, count);
    FE_CHECK_BOOL(spread);
    FE_CHECK_ARRAY(out_hits, count);
    FE_CHECK_RECORD_STRIDE(stride, FE_LEAST_RECORD, count);
    fe_query_filter whole;
    FE_TRY(fe__read_filter(function, filter, &whole));
    for (int32_t i = 0; i < count; ++i) {
        fe_ray ray = ray_at(rays, ray_stride, i);
        FE_TRY(check_ray(function, &ray, i));
    }
    batch b = {.scene = fe__scene_of(world, &whole),
               .ways = rays,
               .way_stride = ray_stride,
               .out_hits = out_hits,
               .stride = stride};
    return answer_all(world, &b, count, spread);
}

int32_t fe_world_sweep_many(const fe_world *world, const fe_geometry *geometry, const fe_path *paths,
                            uint32_t path_stride, int32_t count, const fe_query_filter *filter, int32_t spread,
                            fe_hit *out_hits, uint32_t stride)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_ARRAY(paths, count);
    FE_CHECK_RECORD_STRIDE(path_stride, LEAST_PATH, count);
    FE_CHECK_BOOL(spread);
    FE_CHECK_ARRAY(out_hits, count);
    FE_CHECK_RECORD_STRIDE(stride, FE_LEAST_RECORD, count);
    fe_query_filter whole;
    FE_TRY(fe__read_filter(function, filter, &whole));
    for (int32_t i = 0; i < count; ++i) {
        fe_path path = path_at(paths, path_stride, i);
        FE_TRY(check_path(function, &path, i));
    }
    batch b = {.scene = fe__scene_of(world, &whole),
               .form = &moving.form,
               .ways = paths,
               .way_stride = path_stride,
               .out_hits = out_hits,
               .stride = stride};
    return answer_all(world, &b, count, spread);
}

// ---- query ----------------------------------------------------------------------------------------------------------
// The API of queries. They only read: any number of threads may ask while none writes.

// ---- arguments -----------------------------------------------------------------------------------------------------
static fe_query_filter default_filter(void)
{
    return (fe_query_filter){.struct_size = sizeof(fe_query_filter), .mask = UINT32_MAX};
}

void fe_query_filter_init(fe_query_filter *filter, uint32_t struct_size)
{
    fe_query_filter defaults = default_filter();
    fe__init_struct(filter, &defaults, sizeof defaults, struct_size);
}

fe_result fe__read_filter(const char *function, const fe_query_filter *filter, fe_query_filter *copy)
{
    // field by field: a copy would read what was just written in other pieces, and wait for it
    copy->struct_size = sizeof *copy, copy->mask = UINT32_MAX, copy->flags = 0, copy->excluded_count = 0,
    copy->excluded = NULL;
    if (!filter) return FE_OK;
    FE_READ_STRUCT(filter, copy);
    FE_CHECK_BITS(copy->flags, FE_QUERY_TRIGGERS);
    FE_CHECK_ARRAY(copy->excluded, copy->excluded_count);
    return FE_OK;
}

#define FE_CHECK_LENGTH(value) FE_CHECK_FLOAT(value, FE_LEAST_LENGTH, FE_MAX_LENGTH)

void fe__let_go_of_form(const fe__moving_form *moving)
{
    if (moving->store) fe__let_go_of_asset(moving->store, &moving->form);
}

fe_result fe__read_moving_form(const char *function, const fe_world *world, const fe_geometry *geometry,
                               fe__moving_form *out_moving)
{
    fe_geometry whole = {.struct_size = sizeof whole};
    FE_READ_STRUCT(geometry, &whole);
    geometry = &whole;
    FE_CHECK_RESERVED(geometry->reserved);
    FE_CHECK_RESERVED(geometry->reserved_end);
    fe__form *form = &out_moving->form;
    *form = (fe__form){.type = fe__form_of_geometry(geometry->type)};
    FE_TRY(fe__check_has_scale(function, geometry));
    switch (geometry->type) {
    case FE_GEOMETRY_SPHERE:
        if (geometry->radius != 0.0f) FE_CHECK_LENGTH(geometry->radius);
        form->radius = geometry->radius;
        return FE_OK;
    case FE_GEOMETRY_CAPSULE:
        FE_CHECK_LENGTH(geometry->half_height);
        FE_CHECK_LENGTH(geometry->radius);
        form->half_height = geometry->half_height;
        form->radius = geometry->radius;
        return FE_OK;
    case FE_GEOMETRY_CYLINDER:
    case FE_GEOMETRY_CONE:
        FE_CHECK_LENGTH(geometry->half_height);
        FE_CHECK_LENGTH(geometry->radius);
        form->half = fe__vec3(geometry->radius, geometry->half_height, geometry->radius);
        return FE_OK;
    case FE_GEOMETRY_BOX:
        FE_CHECK_LENGTH(geometry->half_extents.x);
        FE_CHECK_LENGTH(geometry->half_extents.y);
        FE_CHECK_LENGTH(geometry->half_extents.z);
        form->half = geometry->half_extents;
        return FE_OK;
    case FE_GEOMETRY_HULL:
        FE_TRY(fe__read_asset_form(function, world->store, geometry, FE__ASSET_HULL, form));
        out_moving->store = world->store;
        return FE_OK;
    default:
        return fe__fail(function, FE_ERROR_UNSUPPORTED,
                        "type is %d, must be that of a sphere, a capsule, a box, a cylinder, a cone or a hull",
                        geometry->type);
    }
}

fe__scene fe__scene_of(const fe_world *world, const fe_query_filter *whole_filter)
{
    return (fe__scene){.shapes = world->shapes,
                       .store = world->store,
                       .mesh_casts = world->mesh_casts,
                       .static_tree = &world->static_tree,
                       .moving_tree = &world->moving_tree,
                       .planes = world->planes,
                       .plane_count = world->plane_count,
                       .body_ids = &world->body_ids,
                       .shape_ids = &world->shape_ids,
                       .filter = whole_filter};
}

// ---- what a ray meets ----------------------------------------------------------------------------------------------
int32_t fe_world_raycast(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                         const fe_query_filter *filter, fe_hit *out_hit)
{
    FE_READ(world);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_hit);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe;
    fe__probe_ray(&probe, origin, translation);
    int32_t hit = fe__cast_closest(&query.scene, &probe, out_hit);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_raycast_any(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                             const fe_query_filter *filter)
{
    FE_READ(world);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe;
    fe__probe_ray(&probe, origin, translation);
    int32_t hit = fe__cast_any(&query.scene, &probe);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_raycast_all(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                             const fe_query_filter *filter, fe_hit *out_hits, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_ARRAY(out_hits, capacity);
    FE_CHECK_RECORD_STRIDE(stride, FE_SORTED_HIT, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe;
    fe__probe_ray(&probe, origin, translation);
    int32_t count = fe__cast_all(&query.scene, &probe, out_hits, stride, capacity);
    fe__end_query(&query);
    return count;
}

// ---- what a moving form meets --------------------------------------------------------------------------------------
int32_t fe_world_sweep(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                       const fe_dvec3 *translation, const fe_query_filter *filter, fe_hit *out_hit)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_hit);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, start, *translation);
    int32_t hit = fe__cast_closest(&query.scene, &probe, out_hit);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_sweep_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                           const fe_dvec3 *translation, const fe_query_filter *filter)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, start, *translation);
    int32_t hit = fe__cast_any(&query.scene, &probe);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_sweep_all(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                           const fe_dvec3 *translation, const fe_query_filter *filter, fe_hit *out_hits,
                           uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_ARRAY(out_hits, capacity);
    FE_CHECK_RECORD_STRIDE(stride, FE_SORTED_HIT, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, start, *translation);
    int32_t count = fe__cast_all(&query.scene, &probe, out_hits, stride, capacity);
    fe__end_query(&query);
    return count;
}

// ---- what a form meets that turns ----------------------------------------------------------------------------------
int32_t fe_world_sweep_turning(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                               const fe_dvec3 *translation, const fe_vec3 *turn, const fe_query_filter *filter,
                               fe_hit *out_hit)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_VEC3(turn, FE_MAX_TURN);
    FE_CHECK_POINTER(out_hit);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_turning(&moving.form, start, *translation, *turn);
    int32_t hit = fe__cast_closest(&query.scene, &probe, out_hit);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_sweep_turning_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                   const fe_dvec3 *translation, const fe_vec3 *turn, const fe_query_filter *filter)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_VEC3(turn, FE_MAX_TURN);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_turning(&moving.form, start, *translation, *turn);
    int32_t hit = fe__cast_any(&query.scene, &probe);
    fe__end_query(&query);
    return hit;
}

int32_t fe_world_sweep_turning_all(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                   const fe_dvec3 *translation, const fe_vec3 *turn, const fe_query_filter *filter,
                                   fe_hit *out_hits, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(start);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_VEC3(turn, FE_MAX_TURN);
    FE_CHECK_ARRAY(out_hits, capacity);
    FE_CHECK_RECORD_STRIDE(stride, FE_SORTED_HIT, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_turning(&moving.form, start, *translation, *turn);
    int32_t count = fe__cast_all(&query.scene, &probe, out_hits, stride, capacity);
    fe__end_query(&query);
    return count;
}

// ---- what a form overlaps ------------------------------------------------------------------------------------------
static const fe_dvec3 nowhere = {0.0, 0.0, 0.0};

int32_t fe_world_overlap(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                         const fe_query_filter *filter, fe_body *out_bodies, int32_t capacity)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(at);
    FE_CHECK_ARRAY(out_bodies, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, at, nowhere);
    int32_t count = fe__overlap(&query.scene, &probe, out_bodies, capacity);
    fe__end_query(&query);
    return count;
}

int32_t fe_world_overlap_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                             const fe_query_filter *filter)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(at);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, at, nowhere);
    int32_t overlaps = fe__overlap_any(&query.scene, &probe);
    fe__end_query(&query);
    return overlaps;
}

enum { LEAST_SORTED_OVERLAP = 16 }; // bytes: body and shape

int32_t fe_world_overlap_shapes(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                                const fe_query_filter *filter, fe_overlap *out_overlaps, uint32_t stride,
                                int32_t capacity)
{
    FE_READ(world);
    FE_READ_MOVING_FORM(world, geometry);
    FE_CHECK_TRANSFORM(at);
    FE_CHECK_ARRAY(out_overlaps, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_SORTED_OVERLAP, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__probe probe = fe__probe_form(&moving.form, at, nowhere);
    int32_t count = fe__overlap_shapes(&query.scene, &probe, out_overlaps, stride, capacity);
    fe__end_query(&query);
    return count;
}

int32_t fe_world_overlap_bounds(const fe_world *world, const fe_bounds *bounds, const fe_query_filter *filter,
                                fe_shape *out_shapes, int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_POINTER(bounds);
    FE_CHECK_DVEC3(&bounds->lower, FE_MAX_TRANSLATION);
    FE_CHECK_DVEC3(&bounds->upper, FE_MAX_TRANSLATION);
    if (bounds->lower.x > bounds->upper.x || bounds->lower.y > bounds->upper.y || bounds->lower.z > bounds->upper.z) {
        return fe__fail(function, FE_ERROR_ARGUMENT, "lower of bounds is above upper along an axis");
    }
    FE_CHECK_ARRAY(out_shapes, capacity);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    fe__bounds box = {bounds->lower, bounds->upper};
    int32_t count = fe__overlap_bounds(&query.scene, &box, out_shapes, capacity);
    fe__end_query(&query);
    return count;
}

// ---- what is near --------------------------------------------------------------------------------------------------
int32_t fe_world_closest_point(const fe_world *world, const fe_dvec3 *point, double max_distance,
                               const fe_query_filter *filter, fe_closest *out_closest)
{
    FE_READ(world);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_FLOAT(max_distance, 0.0, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_closest);
    fe__query query;
    FE_TRY(fe__begin_query(function, world, filter, &query));
    int32_t found = fe__closest(&query.scene, *point, max_distance, out_closest);
    fe__end_query(&query);
    return found;
}

// ---- one body, one shape --------------------------------------------------------------------------------------------
// The first record in the body's list that is not the shape's, nor that of a part of it
static int32_t end_of_shape(const fe_world *world, int32_t shape)
{
    int32_t last = shape;
    for (int32_t i = shape; i >= 0; i = fe__next_of_whole(world, shape, i)) last = i;
    return world->shapes[last].next;
}

// From shape `first` to before `end` in a body's list.
static int32_t raycast_shapes(const fe_world *world, int32_t first, int32_t end, const fe_dvec3 *origin,
                              const fe_dvec3 *translation, fe_hit *out_hit)
{
    fe__query query;
    query.filter = default_filter();
    query.filter.flags = FE_QUERY_TRIGGERS;
    fe__open_query(world, &query);
    fe__probe probe;
    fe__probe_ray(&probe, origin, translation);
    int32_t hit = fe__cast_shapes(&query.scene, &probe, first, end, out_hit);
    fe__end_query(&query);
    return hit;
}

static int32_t closest_of_shapes(const fe_world *world, int32_t first, int32_t end, const fe_dvec3 *point,
                                 fe_closest *out_closest)
{
    fe__query query;
    query.filter = default_filter();
    query.filter.flags = FE_QUERY_TRIGGERS;
    fe__open_query(world, &query);
    int32_t found = fe__closest_on_shapes(&query.scene, *point, first, end, out_closest);
    fe__end_query(&query);
    return found;
}

int32_t fe_shape_raycast(const fe_world *world, fe_shape shape, const fe_dvec3 *origin, const fe_dvec3 *translation,
                         fe_hit *out_hit)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_hit);
    return raycast_shapes(world, index, end_of_shape(world, index), origin, translation, out_hit);
}

int32_t fe_body_raycast(const fe_world *world, fe_body body, const fe_dvec3 *origin, const fe_dvec3 *translation,
                        fe_hit *out_hit)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_hit);
    return raycast_shapes(world, world->bodies[index].first_shape, -1, origin, translation, out_hit);
}

int32_t fe_shape_closest_point(const fe_world *world, fe_shape shape, const fe_dvec3 *point, fe_closest *out_closest)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_POINTER(out_closest);
    return closest_of_shapes(world, index, end_of_shape(world, index), point, out_closest);
}

int32_t fe_body_closest_point(const fe_world *world, fe_body body, const fe_dvec3 *point, fe_closest *out_closest)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_POINTER(out_closest);
    return closest_of_shapes(world, world->bodies[index].first_shape, -1, point, out_closest);
}
