// overlap.c - see overlap.h.
//
// While the tree is walked, the caller's array holds indices of shapes; at the end they become their bodies' handles.
#include "query/overlap.h"

#include "query/keep.h"

#include <stddef.h>
#include <string.h>

typedef struct search {
    const fe__scene *scene;
    const fe__probe *probe;
    int32_t body;  // only shapes of this body, or FE_ANY_BODY
    int32_t shape; // found, -1: none
    fe__keep keep;
} search;

static int32_t touches(const search *s, const fe__shape *shape)
{
    return (s->body == FE_ANY_BODY || shape->body == s->body) && fe__scene_counts(s->scene, shape) &&
           fe__probe_overlaps(s->scene, s->probe, shape);
}

static void walk(search *s, fe__tree_visit visit)
{
    const fe__scene *scene = s->scene;
    for (int32_t i = 0; i < scene->plane_count; ++i) {
        if (!visit(s, scene->planes[i])) return;
    }
    fe__bounds bounds = {fe__dsub(s->probe->way.origin, s->probe->way.half),
                         fe__dadd(s->probe->way.origin, s->probe->way.half)};
    fe__tree_query(scene->static_tree, &bounds, visit, s);
    fe__tree_query(scene->moving_tree, &bounds, visit, s);
}

// Goes on until the shape created first is found.
static int32_t visit_first(void *context, int32_t index)
{
    search *s = context;
    const fe__shape *shape = &s->scene->shapes[index];
    if (s->shape >= 0 && !fe__created_before(shape, &s->scene->shapes[s->shape])) return 1;
    if (touches(s, shape)) s->shape = index;
    return 1;
}

// A body of several shapes is reported once, by the first of them that overlaps: this one?
static int32_t is_first_of_body(const search *s, int32_t index)
{
    const fe__shape *shape = &s->scene->shapes[index];
    if (fe__is_only_shape(shape)) return 1;
    search of_body = {.scene = s->scene, .probe = s->probe, .body = shape->body, .shape = index};
    walk(&of_body, visit_first);
    return of_body.shape == index;
}

static int32_t visit_all(void *context, int32_t index)
{
    search *s = context;
    uint64_t record = (uint64_t)index;
    if (touches(s, &s->scene->shapes[index]) && is_first_of_body(s, index)) fe__keep_add(&s->keep, &record);
    return 1;
}

static int32_t visit_any(void *context, int32_t index)
{
    search *s = context;
    if (!touches(s, &s->scene->shapes[index])) return 1;
    s->shape = index;
    return 0;
}

static int32_t body_before(const void *context, const void *a, const void *b)
{
    const fe__scene *scene = context;
    uint64_t of_a, of_b;
    memcpy(&of_a, a, sizeof of_a);
    memcpy(&of_b, b, sizeof of_b);
    return scene->shapes[of_a].body_serial < scene->shapes[of_b].body_serial;
}

int32_t fe__overlap(const fe__scene *scene, const fe__probe *probe, fe_body *out_bodies, int32_t capacity)
{
    search s = {.scene = scene,
                .probe = probe,
                .body = FE_ANY_BODY,
                .shape = -1,
                .keep = {.records = out_bodies,
                         .stride = sizeof(fe_body),
                         .size = sizeof(fe_body),
                         .capacity = capacity,
                         .before = body_before,
                         .context = scene}};
    walk(&s, visit_all);
    fe__keep_sort(&s.keep);
    for (int32_t i = 0; i < s.keep.kept; ++i) {
        out_bodies[i] = fe__id_pool_handle(scene->body_ids, scene->shapes[out_bodies[i]].body);
    }
    return (int32_t)s.keep.found;
}

int32_t fe__overlap_any(const fe__scene *scene, const fe__probe *probe)
{
    search s = {.scene = scene, .probe = probe, .body = FE_ANY_BODY, .shape = -1};
    walk(&s, visit_any);
    return s.shape >= 0;
}

// ---- shapes --------------------------------------------------------------------------------------------------------

static int32_t overlap_before(const void *context, const void *a, const void *b)
{
    const fe__scene *scene = context;
    fe_overlap of_a, of_b; // records may be unaligned, and shorter
    memcpy(&of_a, a, offsetof(fe_overlap, material));
    memcpy(&of_b, b, offsetof(fe_overlap, material));
    return fe__created_before(&scene->shapes[fe__id_slot_of(of_a.shape)], &scene->shapes[fe__id_slot_of(of_b.shape)]);
}

static int32_t visit_shapes(void *context, int32_t index)
{
    search *s = context;
    fe_hit hit;
    if (!fe__scene_counts(s->scene, &s->scene->shapes[index]) || !fe__cast_inside(s->scene, s->probe, index, &hit))
        return 1;
    fe_overlap overlap = {.body = hit.body,
                          .shape = hit.shape,
                          .material = hit.material,
                          .direction = hit.normal,
                          .depth = hit.depth,
                          .part = hit.part,
                          .triangle = hit.triangle};
    fe__keep_add(&s->keep, &overlap);
    return 1;
}

int32_t fe__overlap_shapes(const fe__scene *scene, const fe__probe *probe, fe_overlap *out_overlaps, uint32_t stride,
                           int32_t capacity)
{
    search s = {.scene = scene,
                .probe = probe,
                .body = FE_ANY_BODY,
                .shape = -1,
                .keep = {.records = out_overlaps,
                         .stride = stride,
                         .size = stride < sizeof *out_overlaps ? stride : sizeof *out_overlaps,
                         .capacity = capacity,
                         .before = overlap_before,
                         .context = scene}};
    walk(&s, visit_shapes);
    fe__keep_sort(&s.keep);
    return (int32_t)s.keep.found;
}

// ---- bounds --------------------------------------------------------------------------------------------------------

typedef struct bounds_search {
    const fe__scene *scene;
    const fe__bounds *box;
    fe__keep keep;
} bounds_search;

static int32_t shape_before(const void *context, const void *a, const void *b)
{
    const fe__scene *scene = context;
    uint64_t of_a, of_b;
    memcpy(&of_a, a, sizeof of_a);
    memcpy(&of_b, b, sizeof of_b);
    return fe__created_before(&scene->shapes[of_a], &scene->shapes[of_b]);
}

static int32_t bounds_meet(const fe__shape *shape, const fe__bounds *box)
{
    fe__bounds b = fe__form_bounds(&shape->form, &shape->pose);
    return b.low.x <= box->high.x && b.high.x >= box->low.x && b.low.y <= box->high.y && b.high.y >= box->low.y &&
           b.low.z <= box->high.z && b.high.z >= box->low.z;
}

static int32_t visit_bounds(void *context, int32_t index)
{
    bounds_search *s = context;
    const fe__shape *shape = &s->scene->shapes[index];
    uint64_t record = (uint64_t)index;
    if (!fe__scene_counts(s->scene, shape)) return 1;
    int32_t meets = fe__form_is_unbounded(&shape->form) ? fe__plane_meets_box(&shape->form, &shape->pose, s->box, 0.0)
                                                        : bounds_meet(shape, s->box);
    if (meets) fe__keep_add(&s->keep, &record);
    return 1;
}

int32_t fe__overlap_bounds(const fe__scene *scene, const fe__bounds *box, fe_shape *out_shapes, int32_t capacity)
{
    bounds_search s = {.scene = scene,
                       .box = box,
                       .keep = {.records = out_shapes,
                                .stride = sizeof(fe_shape),
                                .size = sizeof(fe_shape),
                                .capacity = capacity,
                                .before = shape_before,
                                .context = scene}};
    for (int32_t i = 0; i < scene->plane_count; ++i) (void)visit_bounds(&s, scene->planes[i]);
    fe__tree_query(scene->static_tree, box, visit_bounds, &s);
    fe__tree_query(scene->moving_tree, box, visit_bounds, &s);
    fe__keep_sort(&s.keep);
    for (int32_t i = 0; i < s.keep.kept; ++i)
        out_shapes[i] = fe__id_pool_handle(scene->shape_ids, (int32_t)out_shapes[i]);
    return (int32_t)s.keep.found;
}
