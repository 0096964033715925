// raycast.h - the first shape on a segment.
//
// Called by the API's query functions with checked arguments, on any number of threads at once: it reads the scene and writes its answer,
// nothing else.
#ifndef FE_QUERY_RAYCAST_H
#define FE_QUERY_RAYCAST_H
#include "broadphase/tree.h"
#include "collision/shape.h"
#include "core/id_pool.h"

// What a query sees of a world. A shape in a tree or in the list of planes belongs to an enabled body.
typedef struct fe__scene {
    const fe__shape *shapes;
    const fe__tree *static_tree, *moving_tree;
    const int32_t *planes;
    int32_t plane_count;
    const fe__id_pool *body_ids, *shape_ids;
} fe__scene;

// 1 and the hit, or 0. The filter is whole: mask, flags, excluded.
int32_t fe__raycast(const fe__scene *scene, const fe_dvec3 *origin, const fe_dvec3 *translation, const fe_query_filter *filter,
                    fe_hit *out_hit);

#endif
