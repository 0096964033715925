// overlap.c - see cast.h.
//
// While the tree is walked, the caller's array holds indices of shapes; at the end they become their bodies' handles.
#include "query/cast.h"

#include "query/top_k.h"

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

// What may be near the probe where it starts
static void walk_box(const fe__scene *scene, const fe__tree_way *way, fe__tree_visit visit, void *context)
{
    fe__bounds bounds = {fe__dsub(way->origin, way->half), fe__dadd(way->origin, way->half)};
    fe__tree_query(scene->static_tree, &bounds, visit, context);
    fe__tree_query(scene->moving_tree, &bounds, visit, context);
}

static void walk(search *s, fe__tree_visit visit)
{
    const fe__scene *scene = s->scene;
    for (int32_t i = 0; i < scene->plane_count; ++i) {
        if (!visit(s, scene->planes[i])) return;
    }
    walk_box(scene, &s->probe->way, visit, s);
}

// Ends at the first that touches. What lies in the other tree then is passed over.
static int32_t visit_first(void *context, int32_t index)
{
    search *s = context;
    if (s->shape < 0 && touches(s, &s->scene->shapes[index])) s->shape = index;
    return s->shape < 0;
}

// A body of several shapes is reported once, by the one that the walk meets first of those that overlap: this one?
static int32_t is_first_of_body(const search *s, int32_t index)
{
    const fe__shape *shape = &s->scene->shapes[index];
    if (fe__is_only_shape(shape)) return 1;
    search of_body = {.scene = s->scene, .probe = s->probe, .body = shape->body, .shape = -1};
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

typedef struct part_search {
    const fe__scene *scene;
    const fe__probe *probe;
    int32_t whole, part; // of it, the one found, or -1
    fe_hit hit;
} part_search;

static int32_t visit_first_part(void *context, int32_t index)
{
    part_search *s = context;
    if (s->part < 0 && s->scene->shapes[index].parent == s->whole &&
        fe__cast_inside(s->scene, s->probe, index, &s->hit))
        s->part = index;
    return s->part < 0;
}

static int32_t visit_deepest_part(void *context, int32_t index)
{
    part_search *s = context;
    const fe__shape *shapes = s->scene->shapes;
    fe_hit hit;
    if (shapes[index].parent != s->whole || !fe__cast_inside(s->scene, s->probe, index, &hit)) return 1;
    int32_t is_first = s->part < 0 || shapes[index].serial < shapes[s->part].serial;
    if (s->part < 0 || hit.depth > s->hit.depth || (hit.depth == s->hit.depth && is_first))
        s->part = index, s->hit = hit;
    return 1;
}

// A compound is reported once, when the walk meets the first of its parts that are overlapped, and by the part that is
// overlapped deepest. 0: not now
static int32_t meet_part(const search *s, int32_t index, fe_hit *out)
{
    part_search p = {.scene = s->scene, .probe = s->probe, .whole = s->scene->shapes[index].parent, .part = -1};
    walk_box(s->scene, &s->probe->way, visit_first_part, &p);
    if (p.part != index) return 0;
    walk_box(s->scene, &s->probe->way, visit_deepest_part, &p);
    *out = p.hit;
    return 1;
}

static int32_t visit_shapes(void *context, int32_t index)
{
    search *s = context;
    const fe__shape *shape = &s->scene->shapes[index];
    fe_hit hit;
    if (!fe__scene_counts(s->scene, shape)) return 1;
    if (!(shape->parent < 0 ? fe__cast_inside(s->scene, s->probe, index, &hit) : meet_part(s, index, &hit))) return 1;
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

typedef struct first_in_box {
    const bounds_search *search;
    int32_t whole, part; // of it, the first met, or -1
} first_in_box;

static int32_t visit_first_in_box(void *context, int32_t index)
{
    first_in_box *f = context;
    const fe__shape *shape = &f->search->scene->shapes[index];
    if (f->part < 0 && shape->parent == f->whole && bounds_meet(shape, f->search->box)) f->part = index;
    return f->part < 0;
}

// A compound is reported once, by the part that the walk meets first of those that meet the box: this one?
static int32_t is_first_in_box(const bounds_search *s, int32_t index)
{
    int32_t whole = s->scene->shapes[index].parent;
    if (whole < 0) return 1;
    first_in_box first = {s, whole, -1};
    fe__tree_query(s->scene->static_tree, s->box, visit_first_in_box, &first);
    fe__tree_query(s->scene->moving_tree, s->box, visit_first_in_box, &first);
    return first.part == index;
}

static int32_t visit_bounds(void *context, int32_t index)
{
    bounds_search *s = context;
    const fe__shape *shape = &s->scene->shapes[index];
    uint64_t record = (uint64_t)index;
    if (!fe__scene_counts(s->scene, shape)) return 1;
    int32_t meets = fe__form_is_unbounded(&shape->form) ? fe__plane_meets_box(&shape->form, &shape->pose, s->box, 0.0)
                                                        : bounds_meet(shape, s->box);
    if (meets && is_first_in_box(s, index)) fe__keep_add(&s->keep, &record);
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
    for (int32_t i = 0; i < s.keep.kept; ++i) out_shapes[i] = fe__scene_handle(scene, (int32_t)out_shapes[i]);
    return (int32_t)s.keep.found;
}
