// scene.h - what a query sees of a world, and which of it counts.
//
// Filled by the API for each call. Queries read it and write their answer, nothing else: any number of threads may ask
// at once. A shape in a tree or in the list of planes belongs to an enabled body.
#ifndef FE_QUERY_SCENE_H
#define FE_QUERY_SCENE_H
#include "broadphase/tree.h"
#include "collision/form/heightfield.h"
#include "collision/form/form.h"
#include "core/id_pool.h"
#include "store/store.h"

typedef struct fe__scene {
    const fe__shape *shapes;
    const fe_store *store;            // of the assets that shapes have
    const fe__mesh_casts *mesh_casts; // of the world's SIMD set
    const fe__tree *static_tree, *moving_tree;
    const int32_t *planes;
    int32_t plane_count;
    const fe__id_pool *body_ids, *shape_ids;
    const fe_query_filter *filter; // whole: mask, flags, excluded
} fe__scene;

enum { FE_ANY_BODY = -1 };

// Does the shape count for the filter?
static inline int32_t fe__scene_counts(const fe__scene *scene, const fe__shape *shape)
{
    const fe_query_filter *filter = scene->filter;
    if (!(shape->layer & filter->mask)) return 0;
    if (shape->flags & FE__SHAPE_TRIGGER && !(filter->flags & FE_QUERY_TRIGGERS)) return 0;
    if (filter->excluded_count == 0) return 1;
    fe_body handle = fe__id_pool_handle(scene->body_ids, shape->body);
    for (int32_t i = 0; i < filter->excluded_count; ++i) {
        if (filter->excluded[i] == handle) return 0;
    }
    return 1;
}

// What the caller knows: of a part, its compound
static inline fe_shape fe__scene_handle(const fe__scene *scene, int32_t shape)
{
    return fe__id_pool_handle(scene->shape_ids, fe__whole_shape(scene->shapes, shape));
}

// Of a shape that is a field
static inline fe__ground fe__scene_ground(const fe__scene *scene, const fe__shape *shape)
{
    fe__ground ground = fe__store_ground(scene->store, &shape->form);
    ground.casts = scene->mesh_casts;
    return ground;
}
// fe_material.user_id of a shape there; `index`: of a triangle of a field (collision/form/ground.h), -1: none
static inline uint64_t fe__scene_material(const fe__scene *scene, const fe__shape *shape, int32_t index)
{
    return fe__material_of_index(scene->store, shape, index)->user_id;
}
// fe_hit.barycentric of a point of the world
static inline void fe__scene_weights(const fe__scene *scene, const fe__shape *shape, int32_t index, fe_dvec3 point,
                                     float *out_weights)
{
    out_weights[0] = out_weights[1] = 0.0f;
    if (!fe__form_is_field(&shape->form) || index < 0) return;
    fe_dvec3 local = fe__drotate_back(shape->pose.rotation, fe__dsub(point, shape->pose.position));
    fe__ground surface = fe__scene_ground(scene, shape);
    fe__ground_weights(&surface, index, local, out_weights);
}

// Does the normal, world space, look out of the back of a two-sided triangle?
static inline int32_t fe__scene_is_back(const fe__scene *scene, const fe__shape *shape, int32_t index, fe_vec3 normal)
{
    if (!fe__form_is_field(&shape->form) || index < 0) return 0;
    fe__ground surface = fe__scene_ground(scene, shape);
    if (!fe__ground_is_two_sided(&surface)) return 0;
    fe_dvec3 front = fe__drotate(shape->pose.rotation, fe__ground_normal(&surface, index));
    return fe__ddot(front, fe__widen(normal)) < 0.0;
}

// The order of all answers: by the body's creation, then by the shape's.
static inline int32_t fe__created_before(const fe__shape *a, const fe__shape *b)
{
    return a->body == b->body ? a->serial < b->serial : a->body_serial < b->body_serial;
}
static inline int32_t fe__is_only_shape(const fe__shape *shape) { return shape->next < 0 && shape->previous < 0; }

#endif
