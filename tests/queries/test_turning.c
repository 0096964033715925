// A form that turns on its way: where it stops, and that nothing is missed before.
//
//     build/tests/queries/test_turning 100000      that many random cases a pair of forms
//
// The judge shares nothing with the library: a form is a test of membership and some points of its surface, in double.
// Before the stop no point of one may lie in the other, at any of the sampled times. At the stop the two are apart, by
// the plane across the reported normal; and they are near, for the reported point is on the standing form, and the gap
// away along the normal the moving one begins.
#include "api/api_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { CASES = 20 };
#else
enum { CASES = 200 };
#endif
enum { MOST_POINTS = 96, CORNERS = 12, SAMPLES = 64 };

static int32_t cases = CASES;
static uint64_t random_state = UINT64_C(0x9e3779b97f4a7c15);

static double uniform(double low, double high)
{
    random_state ^= random_state << 13, random_state ^= random_state >> 7, random_state ^= random_state << 17;
    return low + (high - low) * (double)(random_state >> 11) * 0x1p-53;
}
static double spread(double low, double high) { return low * pow(high / low, uniform(0, 1)); }
static int32_t pick(int32_t count) { return (int32_t)uniform(0, (double)count); }

typedef fe_dvec3 vec;
static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec sub(vec a, vec b) { return (vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static vec scaled(double s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double length(vec a) { return sqrt(dot(a, a)); }
static vec wide(fe_vec3 a) { return (vec){a.x, a.y, a.z}; }
static vec direction(void)
{
    for (;;) {
        vec v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        double l = length(v);
        if (l > 0.1 && l < 1) return scaled(1 / l, v);
    }
}

// ---- poses in double -----------------------------------------------------------------------------------------------
typedef struct frame {
    vec at, x, y, z;
} frame;

static vec rotated(fe_quat q, vec a)
{
    vec u = {q.x, q.y, q.z}, t = cross(u, a);
    double w = q.w, k = 2 / (dot(u, u) + w * w);
    return add(add(a, scaled(k * w, t)), scaled(k, cross(u, t)));
}
static frame frame_of(const fe_transform *t)
{
    return (frame){t->position, rotated(t->rotation, (vec){1, 0, 0}), rotated(t->rotation, (vec){0, 1, 0}),
                   rotated(t->rotation, (vec){0, 0, 1})};
}
static vec about(vec turn, double s, vec a)
{
    double angle = length(turn);
    if (angle == 0) return a;
    vec k = scaled(1 / angle, turn);
    double c = cos(s * angle);
    return add(add(scaled(c, a), scaled(sin(s * angle), cross(k, a))), scaled((1 - c) * dot(k, a), k));
}
static frame frame_at(const fe_path *p, double s)
{
    frame f = frame_of(&p->start);
    vec w = wide(p->turn);
    return (frame){add(f.at, scaled(s, p->translation)), about(w, s, f.x), about(w, s, f.y), about(w, s, f.z)};
}
static vec to_world(const frame *f, vec a)
{
    return add(f->at, add(scaled(a.x, f->x), add(scaled(a.y, f->y), scaled(a.z, f->z))));
}
static vec to_local(const frame *f, vec a)
{
    vec d = sub(a, f->at);
    return (vec){dot(f->x, d), dot(f->y, d), dot(f->z, d)};
}

// ---- forms ---------------------------------------------------------------------------------------------------------
typedef struct solid {
    fe_geometry g;
    int32_t planes; // of a hull: its faces
    vec normal[64];
    double offset[64];
    int32_t points;
    vec point[MOST_POINTS];
    double reach;
} solid;

// How far outside, at least; below 0: inside by so much in some measure
static double outside(const solid *s, vec p)
{
    const fe_geometry *g = &s->g;
    double r = (double)g->radius, h = (double)g->half_height, out = sqrt(p.x * p.x + p.z * p.z);
    switch (g->type) {
    case FE_GEOMETRY_SPHERE:
        return length(p) - r;
    case FE_GEOMETRY_CAPSULE: {
        double y = p.y > h ? p.y - h : p.y < -h ? p.y + h : 0;
        return sqrt(out * out + y * y) - r;
    }
    case FE_GEOMETRY_BOX:
        return fmax(fmax(fabs(p.x) - (double)g->half_extents.x, fabs(p.y) - (double)g->half_extents.y),
                    fabs(p.z) - (double)g->half_extents.z);
    case FE_GEOMETRY_CYLINDER:
        return fmax(out - r, fabs(p.y) - h);
    case FE_GEOMETRY_CONE: {
        double l = sqrt(r * r + 4 * h * h);
        return fmax((2 * h * out + r * (p.y - h)) / l, -h - p.y);
    }
    case FE_GEOMETRY_PLANE:
        return dot(wide(g->normal), p) / length(wide(g->normal)) - (double)g->distance;
    default: {
        double most = -INFINITY;
        for (int32_t i = 0; i < s->planes; ++i) most = fmax(most, dot(s->normal[i], p) - s->offset[i]);
        return most;
    }
    }
}

// The largest part along the unit n of a point of it, world
static double farthest(const solid *s, const frame *f, vec n)
{
    const fe_geometry *g = &s->g;
    vec d = {dot(f->x, n), dot(f->y, n), dot(f->z, n)};
    double r = (double)g->radius, h = (double)g->half_height, out = sqrt(d.x * d.x + d.z * d.z), most = -INFINITY;
    switch (g->type) {
    case FE_GEOMETRY_SPHERE:
        return dot(f->at, n) + r;
    case FE_GEOMETRY_CAPSULE:
        return dot(f->at, n) + r + h * fabs(d.y);
    case FE_GEOMETRY_CYLINDER:
        return dot(f->at, n) + r * out + h * fabs(d.y);
    case FE_GEOMETRY_CONE:
        return dot(f->at, n) + fmax(h * d.y, r * out - h * d.y);
    case FE_GEOMETRY_PLANE:
        return dot(f->at, n) + (double)g->distance;
    default:
        for (int32_t i = 0; i < s->points; ++i) most = fmax(most, dot(s->point[i], d));
        return dot(f->at, n) + most;
    }
}

static void add_point(solid *s, vec p)
{
    if (s->points < MOST_POINTS) s->point[s->points++] = p;
}
static void add_edge(solid *s, vec a, vec b)
{
    for (int i = 1; i < 4; ++i) add_point(s, add(scaled(0.25 * i, a), scaled(1 - 0.25 * i, b)));
}

static void add_points(solid *s)
{
    const fe_geometry *g = &s->g;
    double r = (double)g->radius, h = (double)g->half_height;
    if (g->type == FE_GEOMETRY_BOX) {
        vec e = wide(g->half_extents), c[8];
        for (int i = 0; i < 8; ++i)
            add_point(s, c[i] = (vec){i & 1 ? e.x : -e.x, i & 2 ? e.y : -e.y, i & 4 ? e.z : -e.z});
        for (int i = 0; i < 8; ++i)
            for (int k = 1; k < 8; k *= 2)
                if (!(i & k)) add_edge(s, c[i], c[i | k]);
    }
    for (int i = 0; i < 16 && (g->type == FE_GEOMETRY_CYLINDER || g->type == FE_GEOMETRY_CONE); ++i) {
        double f = 6.2831853 * i / 16, x = r * cos(f), z = r * sin(f), top = g->type == FE_GEOMETRY_CONE ? 0 : 1;
        vec low = {x, -h, z}, high = {top * x, h, top * z};
        add_point(s, low), add_point(s, high);
        if (i % 4 == 0) add_edge(s, low, high);
    }
    for (int i = 0; i < 32 && (g->type == FE_GEOMETRY_SPHERE || g->type == FE_GEOMETRY_CAPSULE); ++i) {
        vec p = scaled(r, direction());
        if (g->type == FE_GEOMETRY_CAPSULE) p.y += p.y > 0 ? h : -h;
        add_point(s, p);
    }
    for (int32_t i = 0; i < s->points; ++i) s->reach = fmax(s->reach, length(s->point[i]));
}

static float size(void) { return (float)spread(0.05, 10); }

static void make_hull(solid *s, fe_world *world)
{
    fe_vec3 points[CORNERS];
    float x = size(), y = size(), z = size(), shift = (float)uniform(-1, 1);
    for (int i = 0; i < CORNERS; ++i)
        points[i] =
            (fe_vec3){x * ((float)uniform(-1, 1) + shift), y * (float)uniform(-1, 1), z * (float)uniform(-1, 1)};
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = &points[0].x, def.point_count = CORNERS;
    fe_asset hull;
    OK(fe_hull_create(world_store(world), &def, &hull));
    fe_geometry_hull(&s->g, hull);
    // the hull's planes and points: all triples of the points that hold the others
    for (int i = 0; i < CORNERS; ++i) add_point(s, wide(points[i]));
    for (int i = 0; i < CORNERS; ++i) {
        for (int j = i + 1; j < CORNERS; ++j)
            for (int k = j + 1; k < CORNERS; ++k) {
                vec n = cross(sub(wide(points[j]), wide(points[i])), sub(wide(points[k]), wide(points[i])));
                double l = length(n), low = 0, high = 0;
                if (!(l > 0)) continue;
                n = scaled(1 / l, n);
                for (int m = 0; m < CORNERS; ++m) {
                    double d = dot(n, sub(wide(points[m]), wide(points[i])));
                    if (m != i && m != j && m != k) low = fmin(low, d), high = fmax(high, d);
                }
                if (low < 0 && high > 0) continue;
                add_edge(s, wide(points[i]), wide(points[j])), add_edge(s, wide(points[j]), wide(points[k]));
                if (high > 0) n = scaled(-1, n);
                s->normal[s->planes] = n, s->offset[s->planes++] = dot(n, wide(points[i]));
            }
    }
}

static solid make_solid(fe_world *world, int32_t type)
{
    solid s = {.points = 0};
    vec n = direction();
    switch (type) {
    case FE_GEOMETRY_SPHERE:
        fe_geometry_sphere(&s.g, size());
        break;
    case FE_GEOMETRY_CAPSULE:
        fe_geometry_capsule(&s.g, size(), size());
        break;
    case FE_GEOMETRY_BOX:
        fe_geometry_box(&s.g, size(), size(), size());
        break;
    case FE_GEOMETRY_CYLINDER:
        fe_geometry_cylinder(&s.g, size(), size());
        break;
    case FE_GEOMETRY_CONE:
        fe_geometry_cone(&s.g, size(), size());
        break;
    case FE_GEOMETRY_PLANE:
        fe_geometry_plane(&s.g, (float)n.x, (float)n.y, (float)n.z, 0);
        break;
    default:
        make_hull(&s, world);
    }
    add_points(&s);
    return s;
}

static void let_go(fe_world *world, const solid *s)
{
    if (s->g.type == FE_GEOMETRY_HULL) OK(fe_asset_destroy(world_store(world), s->g.asset));
}

// ---- the judge -----------------------------------------------------------------------------------------------------
// Least of what points of one are outside of the other
static double clearance(const solid *a, const frame *at_a, const solid *b, const frame *at_b)
{
    double least = INFINITY;
    for (int32_t i = 0; i < a->points; ++i)
        least = fmin(least, outside(b, to_local(at_b, to_world(at_a, a->point[i]))));
    for (int32_t i = 0; i < b->points; ++i)
        least = fmin(least, outside(a, to_local(at_a, to_world(at_b, b->point[i]))));
    return least;
}

// The sweeps' gap and the turn's, and a tenth more: a stop within that is one. A hull's points are floats in its frame.
static double gap_of(const solid *mover) { return 1.1 * (1e-7 + 2.4e-7 * mover->reach) + 1e-8 * (1 + mover->reach); }

static fe_quat rotation(void)
{
    if (uniform(0, 1) < 0.2) return (fe_quat){0, 0, 0, 1};
    return (fe_quat){(float)uniform(-1, 1), (float)uniform(-1, 1), (float)uniform(-1, 1), (float)uniform(0.1, 1)};
}

static fe_path random_path(double reach, vec about_here)
{
    fe_path p = {.start = {add(about_here, scaled(uniform(0, 3) * reach, direction())), rotation()}};
    if (pick(4)) p.translation = scaled(spread(0.1, 4) * reach, direction());
    vec w = scaled(pick(4) ? uniform(0, 7) : 6.2831853, direction());
    p.turn = (fe_vec3){(float)w.x, (float)w.y, (float)w.z};
    return p;
}

// Points are known to some hundred-thousandths of the forms: of two that touch along a line, or a face, any will do
static void check_stop(const solid *mover, const fe_path *path, const solid *still, const frame *at, const fe_hit *hit)
{
    frame f = frame_at(path, hit->fraction);
    double gap = gap_of(mover), rounding = 3e-5 * (1 + fmax(mover->reach, still->reach));
    vec n = wide(hit->normal), there = add(hit->point, scaled(gap, n));
    FE_WITHIN(length(n), 1 - 1e-6, 1 + 1e-6);
    n = scaled(1 / length(n), n);
    // the normal is rounded to floats, and with it how far the forms' edges are along it
    double apart = -farthest(mover, &f, scaled(-1, n)) - farthest(still, at, n),
           float_rounding = 1e-7 * (1 + mover->reach + fmin(still->reach, 100));
    FE_WITHIN(apart, -float_rounding, gap);
    FE_WITHIN(outside(still, to_local(at, hit->point)), -rounding, rounding);
    FE_WITHIN(outside(mover, to_local(&f, there)), -INFINITY, rounding);
}

static int32_t sweep(fe_world *world, const fe_geometry *g, const fe_path *path, fe_hit *hit)
{
    return fe_world_sweep_many(world, g, path, sizeof *path, 1, NULL, 0, hit, sizeof *hit);
}

static const int32_t kinds[] = {FE_GEOMETRY_SPHERE, FE_GEOMETRY_CAPSULE, FE_GEOMETRY_BOX,  FE_GEOMETRY_CYLINDER,
                                FE_GEOMETRY_CONE,   FE_GEOMETRY_HULL,    FE_GEOMETRY_PLANE};
enum { MOVING_KINDS = 6, KINDS = 7 };

static int32_t one_case(fe_world *world, fe_body body, fe_shape shape, int32_t moving, int32_t standing)
{
    solid mover = make_solid(world, moving), still = make_solid(world, standing);
    fe_transform pose = {{uniform(-10, 10), uniform(-10, 10), uniform(-10, 10)}, rotation()};
    OK(fe_shape_set_geometry(world, shape, &still.g));
    OK(fe_body_set_transform(world, body, &pose));
    OK(fe_body_get_transform(world, body, &pose));
    frame at = frame_of(&pose);
    fe_path path = random_path(mover.reach + still.reach, pose.position);
    fe_hit hit;
    int32_t met = sweep(world, &mover.g, &path, &hit);
    FE_WITHIN(met, 0, 1);
    if (!(met && hit.flags & FE_HIT_STARTED_INSIDE)) {
        for (int32_t i = 0; i <= SAMPLES; ++i) {
            double s = hit.fraction * i / SAMPLES;
            frame f = frame_at(&path, s);
            double c = clearance(&mover, &f, &still, &at);
            FE_WITHIN(c, -1e-9, INFINITY); // the judge's rounding, and that of a hull's faces
        }
        if (met) check_stop(&mover, &path, &still, &at, &hit);
    }
    let_go(world, &mover), let_go(world, &still);
    return met;
}

static void nothing_is_met_before_the_stop(void **state)
{
    (void)state;
    for (int32_t mover = 0; mover < MOVING_KINDS; ++mover) {
        for (int32_t still = 0; still < KINDS; ++still) {
            fe_world *world = new_world();
            fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
            fe_shape shape = add_box(world, body, 1);
            int32_t hits = 0;
            for (int32_t i = 0; i < cases; ++i) hits += one_case(world, body, shape, kinds[mover], kinds[still]);
            FE_WITHIN(hits, cases / 8, cases);
            OK(fe_world_destroy(world));
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1) cases = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_met_before_the_stop)};
    return cmocka_run_group_tests_name("turning", tests, NULL, NULL);
}
