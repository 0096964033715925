// query_many.c - the API of queries by the thousand: one check of world and filter, and the world's workers when asked
// for.
#include "api/query.h"
#include "core/fp_state.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

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

enum { NAME_SIZE = 48 }; // of "paths[2147483647].start.position"

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
