// cast.c - see cast.h.
//
// The trees offer the shapes whose boxes the probe meets; each is tested exactly, in double, in its own frame, where
// the distance from the world's origin costs nothing. What is nearer wins; at equal fractions the body created first,
// then its shape created first. So neither the form of the trees nor the order of the tests shows in the answer.
#include "query/cast.h"

#include "collision/cast/mesh_ray.h"
#include "collision/cast/cast_kinds.h"
#include "collision/cast/sweep.h"
#include "collision/cast/turning.h"
#include "query/top_k.h"

#include <string.h>

// ---- the probe ------------------------------------------------------------------------------------------------------
// In this file what was just written is not copied as a whole: compilers copy 16 bytes at once, and the processor,
// which has them in two pieces on their way to memory, waits. A ray had five such waits, a fifth of its time.
static void set(fe_dvec3 *to, const fe_dvec3 *from) { to->x = from->x, to->y = from->y, to->z = from->z; }

// Zeroing it whole would cost a twentieth of a ray.
void fe__probe_ray(fe__probe *probe, const fe_dvec3 *origin, const fe_dvec3 *translation)
{
    probe->form = fe__point_form();
    set(&probe->way.origin, origin);
    set(&probe->way.translation, translation);
    probe->way.half = (fe_dvec3){0.0, 0.0, 0.0};
}

// The box around a hull is as wide on both sides of its origin, wherever that is.
fe__probe fe__probe_form(const fe__form *form, const fe_transform *from, fe_dvec3 translation)
{
    fe__pose turned = {{0.0, 0.0, 0.0}, from->rotation};
    fe__bounds b = fe__form_bounds(form, &turned);
    fe_dvec3 half = {fe__maxd(b.high.x, -b.low.x), fe__maxd(b.high.y, -b.low.y), fe__maxd(b.high.z, -b.low.z)};
    return (fe__probe){.form = *form, .way = {from->position, translation, half}, .axes = fe__axes_of(from->rotation)};
}

// No point of it leaves the box that it starts in by more than its arc across an axis, nor the ball of its reach.
fe__probe fe__probe_turning(const fe__form *form, const fe_transform *from, fe_dvec3 translation, fe_vec3 turn)
{
    fe__probe probe = fe__probe_form(form, from, translation);
    fe_dvec3 w = fe__widen(turn);
    if (!fe__form_shows_turn(form, &probe.axes, w)) return probe;
    const double rounding = 1.000001; // a reach is a float
    double angle = sqrt(fe__ddot(w, w)), ball = rounding * (double)fe__form_reach(form, fe__vec3(0.0f, 0.0f, 0.0f));
    fe_dvec3 axis = fe__dscale(1.0 / angle, w), *half = &probe.way.half;
    double arc = angle * fe__reach_across(form, fe__turn_back(&probe.axes, axis));
    half->x = fe__mind(half->x + arc * sqrt(fe__maxd(1.0 - axis.x * axis.x, 0.0)), ball);
    half->y = fe__mind(half->y + arc * sqrt(fe__maxd(1.0 - axis.y * axis.y, 0.0)), ball);
    half->z = fe__mind(half->z + arc * sqrt(fe__maxd(1.0 - axis.z * axis.z, 0.0)), ball);
    probe.turn = w;
    return probe;
}

static int32_t is_ray(const fe__probe *probe) { return fe__form_is_point(&probe->form); }

// ---- one shape ------------------------------------------------------------------------------------------------------
// A hit in the frame of the shape. What is first in the end is turned into the world, not what is only tested.
typedef struct found {
    fe__ray_hit hit;
    fe_dvec3 point; // of a form that moves
} found;

// A ball, or what stands as it was made, needs no turning for a ray: its frame has the world's axes.
static int32_t is_turned(const fe__shape *shape)
{
    fe_quat q = shape->pose.rotation;
    return !fe__form_is_ball(&shape->form) &&
           fe__absf(q.x) + fe__absf(q.y) + fe__absf(q.z) > 0.0f; // one branch, not three
}

static inline int32_t meet_ray(const fe__scene *scene, const fe__probe *probe, const fe__shape *shape, double limit,
                               found *f)
{
    fe_quat q = shape->pose.rotation;
    fe_dvec3 origin = fe__dsub(probe->way.origin, shape->pose.position);
    fe_dvec3 way;
    set(&way, &probe->way.translation);
    if (is_turned(shape)) {
        fe_dvec3 turned = fe__drotate_back(q, origin), turned_way = fe__drotate_back(q, way);
        set(&origin, &turned);
        set(&way, &turned_way);
    }
    if (fe__form_is_field(&shape->form)) {
        fe__ground surface = fe__scene_ground(scene, shape);
        return fe__ground_ray(&surface, origin, way, limit, &f->hit);
    }
    return fe__form_ray_at(&shape->form, &origin, &way, limit, &f->hit);
}

static fe__mover mover_of(const fe__probe *probe, const fe__shape *shape, const fe__axes *m)
{
    const fe__axes *a = &probe->axes;
    return (fe__mover){.form = &probe->form,
                       .axes = {fe__turn_back(m, a->x), fe__turn_back(m, a->y), fe__turn_back(m, a->z)},
                       .position = fe__turn_back(m, fe__dsub(probe->way.origin, shape->pose.position)),
                       .translation = fe__turn_back(m, probe->way.translation),
                       .turn = fe__turn_back(m, probe->turn)};
}

static int32_t is_turning(const fe__probe *probe) { return !is_ray(probe) && fe__ddot(probe->turn, probe->turn) > 0.0; }

static int32_t meet_form(const fe__scene *scene, const fe__probe *probe, const fe__shape *shape, double limit, found *f)
{
    fe__axes m = fe__axes_of(shape->pose.rotation);
    fe__mover mover = mover_of(probe, shape, &m);
    fe__sweep_hit hit;
    int32_t met;
    if (fe__form_is_field(&shape->form)) {
        fe__ground surface = fe__scene_ground(scene, shape);
        met = is_turning(probe) ? fe__ground_turn(&surface, &mover, limit, &hit)
                                : fe__ground_sweep(&surface, &mover, limit, &hit);
    } else {
        met = is_turning(probe) ? fe__form_turn(&shape->form, &mover, limit, &hit)
                                : fe__form_sweep(&shape->form, &mover, limit, &hit);
    }
    if (!met) return 0;
    *f = (found){{hit.t, hit.normal, hit.depth, hit.inside, hit.triangle, hit.index}, hit.point};
    return 1;
}

int32_t fe__probe_overlaps(const fe__scene *scene, const fe__probe *probe, const fe__shape *shape)
{
    if (is_ray(probe)) {
        fe__probe still;
        fe__probe_ray(&still, &probe->way.origin, &(fe_dvec3){0.0, 0.0, 0.0});
        found f;
        return meet_ray(scene, &still, shape, 0.0, &f);
    }
    fe__axes m = fe__axes_of(shape->pose.rotation);
    fe__mover mover = mover_of(probe, shape, &m);
    if (fe__form_is_field(&shape->form)) {
        fe__ground surface = fe__scene_ground(scene, shape);
        return fe__ground_overlap(&surface, &mover);
    }
    return fe__form_overlap(&shape->form, &mover);
}

static int32_t meet(const fe__scene *scene, const fe__probe *probe, const fe__shape *shape, double limit, found *f)
{
    return is_ray(probe) ? meet_ray(scene, probe, shape, limit, f) : meet_form(scene, probe, shape, limit, f);
}

// ---- reports -------------------------------------------------------------------------------------------------------
// As a float a grazing normal may lean along the way by a rounding: it is turned back until it does not.
static fe_vec3 against_way(fe_dvec3 normal, fe_dvec3 way)
{
    const double rounding = 1e-7; // more than a float's rounding
    double square = fe__ddot(way, way);
    fe_vec3 n = fe__narrow(normal);
    if (!(square > 0.0)) return n;
    fe_dvec3 unit = fe__dscale(1.0 / sqrt(square), way);
    for (int32_t i = 0; i < 4 && fe__ddot(fe__widen(n), unit) > 0.0; ++i) {
        normal = fe__dsub(normal, fe__dscale(fe__ddot(normal, unit) + rounding, unit));
        n = fe__narrow(normal);
    }
    return n;
}

static void report(const fe__scene *scene, const fe__probe *probe, int32_t index, const found *f, fe_hit *out)
{
    const fe__shape *shape = &scene->shapes[index];
    const fe__ray_hit *hit = &f->hit;
    fe_dvec3 way = probe->way.translation, normal = hit->normal, point;
    double square = fe__ddot(way, way);
    if (!is_ray(probe) || is_turned(shape)) normal = fe__drotate(shape->pose.rotation, normal);
    if (hit->inside && square > 0.0) normal = fe__dscale(-1.0 / sqrt(square), way);
    if (hit->inside || is_ray(probe))
        point = fe__dadd(probe->way.origin, fe__dscale(hit->t, way));
    else
        point = fe__dadd(shape->pose.position, fe__drotate(shape->pose.rotation, f->point));
    out->body = fe__id_pool_handle(scene->body_ids, shape->body);
    out->shape = fe__scene_handle(scene, index);
    set(&out->point, &point);
    out->fraction = hit->t;
    out->normal = is_turning(probe) ? fe__narrow(normal) : against_way(normal, way);
    out->depth = (float)hit->depth;
    out->flags = hit->inside ? FE_HIT_STARTED_INSIDE : 0u;
    if (!hit->inside && fe__scene_is_back(scene, shape, hit->index, out->normal)) out->flags = FE_HIT_BACK;
    out->material = fe__scene_material(scene, shape, hit->index);
    out->part = fe__part_of_serial(shape->serial);
    out->triangle = hit->triangle;
    fe__scene_weights(scene, shape, hit->index, point, out->barycentric);
    memset(out->reserved, 0, sizeof out->reserved);
}

int32_t fe__cast_inside(const fe__scene *scene, const fe__probe *probe, int32_t shape, fe_hit *out_hit)
{
    found f;
    if (!meet(scene, probe, &scene->shapes[shape], 0.0, &f) || !f.hit.inside) return 0;
    report(scene, probe, shape, &f, out_hit);
    return 1;
}

// ---- the nearest ---------------------------------------------------------------------------------------------------
typedef struct cast {
    const fe__scene *scene;
    const fe__probe *probe;
    int32_t body;  // only shapes of this body, or FE_ANY_BODY
    int32_t shape; // nearest so far, -1: none
    int32_t which; // of the two is its: the next is found in the other
    found finds[2];
} cast;

// At equal fractions.
static int32_t comes_before(const found *a, const fe__shape *of_a, const found *b, const fe__shape *of_b)
{
    return a->hit.inside != b->hit.inside ? a->hit.inside : fe__created_before(of_a, of_b);
}

static double visit_nearest(void *context, int32_t index, double limit)
{
    cast *c = context;
    const fe__shape *shape = &c->scene->shapes[index];
    if (c->body != FE_ANY_BODY && shape->body != c->body) return limit;
    if (!fe__scene_counts(c->scene, shape)) return limit;
    found *f = &c->finds[1 - c->which];
    const found *best = &c->finds[c->which];
    if (!meet(c->scene, c->probe, shape, limit, f)) return limit;
    if (c->shape >= 0 && f->hit.t == best->hit.t && !comes_before(f, shape, best, &c->scene->shapes[c->shape]))
        return limit;
    c->shape = index;
    c->which = 1 - c->which;
    return f->hit.t;
}

// Planes first: they are few, and shorten the way.
static void walk(const fe__scene *scene, const fe__probe *probe, double limit, fe__tree_ray_visit visit, void *context)
{
    for (int32_t i = 0; i < scene->plane_count && limit >= 0.0; ++i) limit = visit(context, scene->planes[i], limit);
    const fe__tree *trees[] = {scene->static_tree, scene->moving_tree};
    (void)fe__tree_sweep(trees, 2, &probe->way, limit, visit, context);
}

static int32_t report_nearest(const cast *c, fe_hit *out_hit)
{
    if (c->shape < 0) return 0;
    report(c->scene, c->probe, c->shape, &c->finds[c->which], out_hit);
    return 1;
}

int32_t fe__cast_closest(const fe__scene *scene, const fe__probe *probe, fe_hit *out_hit)
{
    cast c; // `finds` mean something once `shape` does
    c.scene = scene, c.probe = probe, c.body = FE_ANY_BODY, c.shape = -1, c.which = 0;
    walk(scene, probe, 1.0, visit_nearest, &c);
    return report_nearest(&c, out_hit);
}

int32_t fe__cast_shapes(const fe__scene *scene, const fe__probe *probe, int32_t first, int32_t end, fe_hit *out_hit)
{
    cast c = {.scene = scene, .probe = probe, .body = FE_ANY_BODY, .shape = -1};
    double limit = 1.0;
    for (int32_t i = first; i != end; i = scene->shapes[i].next)
        if (!fe__form_is_of_parts(&scene->shapes[i].form)) limit = visit_nearest(&c, i, limit);
    return report_nearest(&c, out_hit);
}

// ---- any -----------------------------------------------------------------------------------------------------------
static double visit_any(void *context, int32_t index, double limit)
{
    const double stop = -1.0;
    double next = visit_nearest(context, index, limit);
    const cast *c = context;
    return c->shape >= 0 ? stop : next;
}

int32_t fe__cast_any(const fe__scene *scene, const fe__probe *probe)
{
    cast c; // `finds` mean something once `shape` does
    c.scene = scene, c.probe = probe, c.body = FE_ANY_BODY, c.shape = -1, c.which = 0;
    walk(scene, probe, 1.0, visit_any, &c);
    return c.shape >= 0;
}

// ---- all -----------------------------------------------------------------------------------------------------------
typedef struct collection {
    const fe__scene *scene;
    const fe__probe *probe;
    fe__keep keep;
} collection;

// A body of several shapes is reported once, when the walk meets the first of them, and by that of its hits which comes
// first. 0: not now
static int32_t meet_body(const collection *c, int32_t index, fe_hit *out_hit)
{
    int32_t body = c->scene->shapes[index].body;
    cast first = {.scene = c->scene, .probe = c->probe, .body = body, .shape = -1};
    walk(c->scene, c->probe, 1.0, visit_any, &first);
    if (first.shape != index) return 0;
    cast nearest = {.scene = c->scene, .probe = c->probe, .body = body, .shape = -1};
    walk(c->scene, c->probe, 1.0, visit_nearest, &nearest);
    return report_nearest(&nearest, out_hit);
}

static double visit_all(void *context, int32_t index, double limit)
{
    collection *c = context;
    const fe__shape *shape = &c->scene->shapes[index];
    found f;
    if (!fe__scene_counts(c->scene, shape) || !meet(c->scene, c->probe, shape, limit, &f)) return limit;
    fe_hit hit;
    if (fe__is_only_shape(shape))
        report(c->scene, c->probe, index, &f, &hit);
    else if (!meet_body(c, index, &hit))
        return limit;
    fe__keep_add(&c->keep, &hit);
    return limit;
}

static int32_t hit_before(const void *context, const void *a, const void *b)
{
    const fe__scene *scene = context;
    fe_hit h, k; // records may be unaligned, and end after their flags
    memcpy(&h, a, FE_SORTED_HIT);
    memcpy(&k, b, FE_SORTED_HIT);
    if (h.fraction != k.fraction) return h.fraction < k.fraction;
    if (h.flags != k.flags) return h.flags > k.flags;
    return fe__created_before(&scene->shapes[fe__id_slot_of(h.shape)], &scene->shapes[fe__id_slot_of(k.shape)]);
}

int32_t fe__cast_all(const fe__scene *scene, const fe__probe *probe, fe_hit *out_hits, uint32_t stride,
                     int32_t capacity)
{
    collection c = {.scene = scene,
                    .probe = probe,
                    .keep = {.records = out_hits,
                             .stride = stride,
                             .size = stride < sizeof(fe_hit) ? stride : sizeof(fe_hit),
                             .capacity = capacity,
                             .before = hit_before,
                             .context = scene}};
    walk(scene, probe, 1.0, visit_all, &c);
    fe__keep_sort(&c.keep);
    return (int32_t)c.keep.found;
}
