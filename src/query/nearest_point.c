// nearest_point.c - see cast.h.
//
// Branch and bound in the trees: boxes farther than the nearest shape so far are passed over. Inside several shapes the
// deepest counts as the nearest, and every box that holds the point is looked into.
#include "query/cast.h"

#include "collision/cast/cast_kinds.h"

typedef struct search {
    const fe__scene *scene;
    fe_dvec3 point;
    int32_t shape;     // nearest so far, -1: none
    fe__nearest found; // in the frame of the shape
} search;

static int32_t nearest_on(const fe__scene *scene, const fe__shape *shape, fe_dvec3 point, double limit,
                          fe__nearest *nearest)
{
    fe_dvec3 p = fe__drotate_back(shape->pose.rotation, fe__dsub(point, shape->pose.position));
    if (fe__form_is_field(&shape->form)) {
        fe__ground surface = fe__scene_ground(scene, shape);
        return fe__ground_nearest(&surface, p, limit, nearest);
    }
    *nearest = fe__form_nearest(&shape->form, p);
    return nearest->distance <= limit;
}

static fe_closest closest_of(const fe__scene *scene, int32_t index, const fe__nearest *found)
{
    const fe__shape *shape = &scene->shapes[index];
    fe_quat q = shape->pose.rotation;
    fe_closest closest = {.body = fe__id_pool_handle(scene->body_ids, shape->body),
                          .shape = fe__scene_handle(scene, index),
                          .point = fe__dadd(shape->pose.position, fe__drotate(q, found->point)),
                          .distance = found->distance,
                          .material = fe__scene_material(scene, shape, found->index),
                          .normal = fe__narrow(fe__drotate(q, found->normal)),
                          .part = fe__part_of_serial(shape->serial),
                          .triangle = found->triangle};
    fe__scene_weights(scene, shape, found->index, closest.point, closest.barycentric);
    return closest;
}

static double visit(void *context, int32_t index, double limit)
{
    search *s = context;
    const fe__shape *shape = &s->scene->shapes[index];
    if (!fe__scene_counts(s->scene, shape)) return limit;
    fe__nearest n;
    if (!nearest_on(s->scene, shape, s->point, limit, &n)) return limit;
    if (s->shape >= 0) {
        if (n.distance > s->found.distance) return limit;
        if (n.distance == s->found.distance && !fe__created_before(shape, &s->scene->shapes[s->shape])) return limit;
    }
    s->shape = index;
    s->found = n;
    return fe__maxd(n.distance, 0.0);
}

static int32_t report(const search *s, fe_closest *out_closest)
{
    if (s->shape < 0) return 0;
    *out_closest = closest_of(s->scene, s->shape, &s->found);
    return 1;
}

int32_t fe__closest(const fe__scene *scene, fe_dvec3 point, double most, fe_closest *out_closest)
{
    search s = {.scene = scene, .point = point, .shape = -1};
    double limit = most;
    for (int32_t i = 0; i < scene->plane_count; ++i) limit = visit(&s, scene->planes[i], limit);
    limit = fe__tree_nearest(scene->static_tree, point, limit, visit, &s);
    (void)fe__tree_nearest(scene->moving_tree, point, limit, visit, &s);
    return report(&s, out_closest);
}

int32_t fe__closest_on_shapes(const fe__scene *scene, fe_dvec3 point, int32_t first, int32_t end,
                              fe_closest *out_closest)
{
    search s = {.scene = scene, .point = point, .shape = -1};
    double limit = (double)INFINITY;
    for (int32_t i = first; i != end; i = scene->shapes[i].next)
        if (!fe__form_is_of_parts(&scene->shapes[i].form)) limit = visit(&s, i, limit);
    return report(&s, out_closest);
}
