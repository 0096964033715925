// overlap.c - see overlap.h.
//
// While the tree is walked, the caller's array holds indices of shapes; at the end they become their bodies' handles.
#include "query/overlap.h"

#include "query/keep.h"

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
    fe__bounds bounds = {fe__dsub(s->probe->way.origin, s->probe->way.half), fe__dadd(s->probe->way.origin, s->probe->way.half)};
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
