// raycast.c - see raycast.h.
//
// The trees offer the shapes whose boxes the segment meets; each is tested exactly, in double, in its own frame, where the distance from
// the world's origin costs nothing. What is nearer wins; at equal fractions the body created first, then its shape created first. So
// neither the form of the trees nor the order of the tests shows in the answer.
#include "query/raycast.h"

typedef struct cast {
    const fe__scene *scene;
    const fe_query_filter *filter;
    fe_dvec3 origin, translation;
    int32_t shape; // nearest so far, -1: none
    fe__ray_hit hit;
} cast;

static int32_t is_excluded(const cast *c, int32_t body)
{
    fe_body handle = fe__id_pool_handle(c->scene->body_ids, body);
    for (int32_t i = 0; i < c->filter->excluded_count; ++i) {
        if (c->filter->excluded[i] == handle) return 1;
    }
    return 0;
}

static int32_t counts(const cast *c, const fe__shape *shape)
{
    if (!(shape->layer & c->filter->mask)) return 0;
    if (shape->flags & FE__SHAPE_TRIGGER && !(c->filter->flags & FE_QUERY_TRIGGERS)) return 0;
    return c->filter->excluded_count == 0 || !is_excluded(c, shape->body);
}

static int32_t created_before(const fe__shape *a, const fe__shape *b)
{
    return a->body == b->body ? a->serial < b->serial : a->body_serial < b->body_serial;
}

static double visit(void *context, int32_t index, double limit)
{
    cast *c = context;
    const fe__shape *shape = &c->scene->shapes[index];
    if (!counts(c, shape)) return limit;
    fe_quat q = shape->pose.rotation;
    fe_dvec3 origin = fe__drotate_back(q, fe__dsub(c->origin, shape->pose.position)), translation = fe__drotate_back(q, c->translation);
    fe__ray_hit hit;
    if (!fe__form_ray(&shape->form, origin, translation, limit, &hit)) return limit;
    if (c->shape >= 0 && hit.t == c->hit.t && !created_before(shape, &c->scene->shapes[c->shape])) return limit;
    c->shape = index;
    c->hit = hit;
    return hit.t;
}

// Turned into the world a grazing normal may lean along the ray by a rounding; that part is taken off.
static fe_vec3 world_normal(const cast *c, const fe__shape *shape)
{
    fe_dvec3 normal = fe__drotate(shape->pose.rotation, c->hit.normal);
    double along = fe__ddot(normal, c->translation), square = fe__ddot(c->translation, c->translation);
    if (along > 0.0 && square > 0.0) normal = fe__dsub(normal, fe__dscale(along / square, c->translation));
    return fe__narrow(normal);
}

static void describe(const cast *c, fe_hit *out_hit)
{
    const fe__shape *shape = &c->scene->shapes[c->shape];
    *out_hit = (fe_hit){.body = fe__id_pool_handle(c->scene->body_ids, shape->body),
                        .shape = fe__id_pool_handle(c->scene->shape_ids, c->shape),
                        .point = fe__dadd(c->origin, fe__dscale(c->hit.t, c->translation)),
                        .fraction = c->hit.t,
                        .normal = world_normal(c, shape),
                        .triangle = -1,
                        .depth = (float)c->hit.depth,
                        .flags = c->hit.inside ? FE_HIT_STARTED_INSIDE : 0u};
}

int32_t fe__raycast(const fe__scene *scene, const fe_dvec3 *origin, const fe_dvec3 *translation, const fe_query_filter *filter,
                    fe_hit *out_hit)
{
    cast c = {.scene = scene, .filter = filter, .origin = *origin, .translation = *translation, .shape = -1};
    double limit = 1.0;
    for (int32_t i = 0; i < scene->plane_count; ++i) limit = visit(&c, scene->planes[i], limit);
    limit = fe__tree_ray(scene->static_tree, *origin, *translation, limit, visit, &c);
    (void)fe__tree_ray(scene->moving_tree, *origin, *translation, limit, visit, &c);
    if (c.shape < 0) return 0;
    describe(&c, out_hit);
    return 1;
}
