// query.c - the API of queries. They only read: any number of threads may ask while none writes.
#include "api/check.h"
#include "query/raycast.h"

static fe_query_filter default_filter(void) { return (fe_query_filter){.struct_size = sizeof(fe_query_filter), .mask = UINT32_MAX}; }

void fe_query_filter_init(fe_query_filter *filter, uint32_t struct_size)
{
    fe_query_filter defaults = default_filter();
    fe__init_struct(filter, &defaults, sizeof defaults, struct_size);
}

static fe_result read_filter(const char *function, const fe_query_filter *filter, fe_query_filter *copy)
{
    *copy = default_filter();
    if (!filter) return FE_OK;
    FE_READ_STRUCT(filter, copy);
    FE_CHECK_BITS(copy->flags, FE_QUERY_TRIGGERS);
    FE_CHECK_ARRAY(copy->excluded, copy->excluded_count);
    return FE_OK;
}

static fe__scene scene_of(const fe_world *world)
{
    return (fe__scene){.shapes = world->shapes,
                       .static_tree = &world->static_tree,
                       .moving_tree = &world->moving_tree,
                       .planes = world->planes,
                       .plane_count = world->plane_count,
                       .body_ids = &world->body_ids,
                       .shape_ids = &world->shape_ids};
}

fe_result fe_world_raycast(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation, const fe_query_filter *filter,
                           fe_hit *out_hit)
{
    FE_BEGIN(world);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(translation, FE_MAX_TRANSLATION);
    FE_CHECK_POINTER(out_hit);
    fe_query_filter whole;
    FE_TRY(read_filter(function, filter, &whole));
    fe__fp_state fp = fe__fp_enter();
    fe__scene scene = scene_of(world);
    int32_t hit = fe__raycast(&scene, origin, translation, &whole, out_hit);
    fe__fp_leave(fp);
    return hit ? FE_OK : FE_MISS;
}
