// A form that turns on its way: where it stops, and that nothing is missed before.
//
//     build/tests/queries/test_turning 100000      that many random cases a pair of forms
//
// The judge shares nothing with the library: a form is a test of membership and some points of its surface, in double.
// Before the stop no point of one may lie in the other, at any of the sampled times. At the stop the two are apart, by
// the plane across the reported normal; and they are near, for the reported point is on the standing form, and the gap
// away along the normal the moving one begins.
#include "api/api_test.h"
#include "queries/dice.h"

#include <stdio.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { CASES = 100 };
#else
enum { CASES = 200 };
#endif
enum { MOST_POINTS = 96, CORNERS = 12, SAMPLES = 64 };

static int32_t cases = CASES;
static dice rolled = {UINT64_C(0x9e3779b97f4a7c15)};

typedef fe_dvec3 vec;
static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec sub(vec a, vec b) { return (vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static vec scaled(double s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double length(vec a) { return sqrt(dot(a, a)); }
static vec wide(fe_vec3 a) { return (vec){a.x, a.y, a.z}; }

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
        vec p = scaled(r, direction(&rolled));
        if (g->type == FE_GEOMETRY_CAPSULE) p.y += p.y > 0 ? h : -h;
        add_point(s, p);
    }
    for (int32_t i = 0; i < s->points; ++i) s->reach = fmax(s->reach, length(s->point[i]));
}

static float size(void) { return (float)spread(&rolled, 0.05, 10); }

static void make_hull(solid *s, fe_world *world)
{
    fe_vec3 points[CORNERS];
    float x = size(), y = size(), z = size(), shift = (float)uniform(&rolled, -1, 1);
    for (int i = 0; i < CORNERS; ++i)
        points[i] = (fe_vec3){x * ((float)uniform(&rolled, -1, 1) + shift), y * (float)uniform(&rolled, -1, 1),
                              z * (float)uniform(&rolled, -1, 1)};
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
    vec n = direction(&rolled);
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

static fe_path random_path(double reach, vec about_here)
{
    fe_path p = {.start = {add(about_here, scaled(uniform(&rolled, 0, 3) * reach, direction(&rolled))),
                           random_rotation(&rolled)}};
    if (one_of(&rolled, 4)) p.translation = scaled(spread(&rolled, 0.1, 4) * reach, direction(&rolled));
    vec w = scaled(one_of(&rolled, 4) ? uniform(&rolled, 0, 7) : 6.2831853, direction(&rolled));
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
    FE_WITHIN(apart, -float_rounding, gap + float_rounding);
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
    fe_transform pose = {{uniform(&rolled, -10, 10), uniform(&rolled, -10, 10), uniform(&rolled, -10, 10)},
                         random_rotation(&rolled)};
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
            FE_WITHIN(hits, cases / 20, cases);
            OK(fe_world_destroy(world));
        }
    }
}

// ---- triangles -----------------------------------------------------------------------------------------------------
// Inside the mover by points of the triangle, a 36th of its sides apart
static double inside_triangle(const solid *mover, const frame *at, const vec v[3])
{
    enum { PARTS = 8 };
    double least = INFINITY;
    for (int i = 0; i <= PARTS; ++i)
        for (int k = 0; i + k <= PARTS; ++k) {
            vec p =
                add(v[0], add(scaled((double)i / PARTS, sub(v[1], v[0])), scaled((double)k / PARTS, sub(v[2], v[0]))));
            least = fmin(least, outside(mover, to_local(at, p)));
        }
    return least;
}

enum { TRIANGLES = 24 };

static int32_t one_mesh_case(fe_world *world, fe_body body, fe_shape shape, int32_t moving)
{
    solid mover = make_solid(world, moving);
    float vertices[3 * TRIANGLES][3];
    uint32_t indices[3 * TRIANGLES];
    double extent = spread(&rolled, 0.1, 20);
    for (int i = 0; i < 3 * TRIANGLES; ++i) {
        indices[i] = (uint32_t)i;
        for (int k = 0; k < 3; ++k)
            vertices[i][k] = (float)(uniform(&rolled, -0.3, 0.3) * extent) +
                             (i % 3 ? vertices[i - i % 3][k] : (float)(extent * uniform(&rolled, -1, 1)));
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = &vertices[0][0], def.indices = indices, def.vertex_count = 3 * TRIANGLES,
    def.triangle_count = TRIANGLES;
    def.flags = FE_MESH_TWO_SIDED;
    fe_asset mesh;
    fe_geometry g;
    OK(fe_mesh_create(world_store(world), &def, &mesh));
    fe_geometry_mesh(&g, mesh);
    OK(fe_shape_set_geometry(world, shape, &g));
    OK(fe_asset_destroy(world_store(world), mesh));
    fe_transform pose = {{uniform(&rolled, -10, 10), uniform(&rolled, -10, 10), uniform(&rolled, -10, 10)},
                         random_rotation(&rolled)};
    OK(fe_body_set_transform(world, body, &pose));
    OK(fe_body_get_transform(world, body, &pose));
    frame at = frame_of(&pose);
    fe_path path = random_path(mover.reach + extent, pose.position);
    fe_hit hit;
    int32_t met = sweep(world, &mover.g, &path, &hit);
    FE_WITHIN(met, 0, 1);
    if (!(met && hit.flags & FE_HIT_STARTED_INSIDE)) {
        vec v[TRIANGLES][3];
        for (int i = 0; i < 3 * TRIANGLES; ++i)
            v[i / 3][i % 3] =
                to_world(&at, (vec){(double)vertices[i][0], (double)vertices[i][1], (double)vertices[i][2]});
        for (int32_t i = 0; i <= SAMPLES; ++i) {
            frame f = frame_at(&path, hit.fraction * i / SAMPLES);
            for (int k = 0; k < TRIANGLES; ++k) FE_WITHIN(inside_triangle(&mover, &f, v[k]), -1e-9, INFINITY);
        }
        if (met) {
            solid thin = {.g = {.type = FE_GEOMETRY_HULL}, .points = 3, .planes = 1};
            vec *w = v[hit.triangle], n = cross(sub(w[1], w[0]), sub(w[2], w[0]));
            for (int k = 0; k < 3; ++k)
                thin.point[k] = to_local(&at, w[k]), thin.reach = fmax(thin.reach, length(thin.point[k]));
            frame still = {{0, 0, 0}, at.x, at.y, at.z};
            thin.normal[0] = to_local(&still, scaled(1 / length(n), n)),
            thin.offset[0] = dot(thin.normal[0], thin.point[0]);
            check_stop(&mover, &path, &thin, &at, &hit);
        }
    }
    let_go(world, &mover);
    return met;
}

static void no_triangle_is_missed(void **state)
{
    (void)state;
    for (int32_t mover = 0; mover < MOVING_KINDS; ++mover) {
        fe_world *world = new_world();
        fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
        fe_shape shape = add_box(world, body, 1);
        int32_t hits = 0;
        for (int32_t i = 0; i < cases; ++i) hits += one_mesh_case(world, body, shape, kinds[mover]);
        FE_WITHIN(hits, cases / 20, cases);
        OK(fe_world_destroy(world));
    }
}

// ---- by formula ----------------------------------------------------------------------------------------------------
static const fe_transform origin = {{0, 0, 0}, {0, 0, 0, 1}};
static const fe_dvec3 nowhere = {0, 0, 0};
#define FULL_TURN 6.2831853f

static fe_body stand(fe_world *world, const fe_geometry *g, double x, double y, double z)
{
    fe_body body = new_body(world, FE_BODY_STATIC, x, y, z);
    add_shape(world, body, g);
    return body;
}

// From its origin at the end of one arm: 0.5 to 2 m along x, 0.1 m wide
static fe_geometry arm(fe_world *world)
{
    float points[8][3];
    for (int i = 0; i < 8; ++i)
        points[i][0] = i & 1 ? 2.0f : 0.5f, points[i][1] = i & 2 ? 0.05f : -0.05f,
        points[i][2] = i & 4 ? 0.05f : -0.05f;
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = &points[0][0], def.point_count = 8;
    fe_asset hull;
    OK(fe_hull_create(world_store(world), &def, &hull));
    fe_geometry g;
    fe_geometry_hull(&g, hull);
    return g;
}

// The corner at (1, 0.05), R = (1 + 0.05^2)^(1/2) out at the angle f0, comes to the height 0.5: sin(f + f0) = 0.5 / R.
// It stops a gap g before: earlier by g / (R cos) rad.
static void a_rod_turns_into_a_wall(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry wall, rod;
    fe_geometry_box(&wall, 5, 0.5f, 5), fe_geometry_box(&rod, 1, 0.05f, 0.05f);
    fe_body body = stand(world, &wall, 0, 1, 0);
    fe_vec3 turn = {0, 0, 0.25f * FULL_TURN};
    double f0 = atan(0.05), radius = sqrt(1 + 0.05 * 0.05), angle = asin(0.5 / radius) - f0;
    fe_hit hit;
    HIT(fe_world_sweep_turning(world, &rod, &origin, &nowhere, &turn, NULL, &hit));
    FE_TRUE(hit.body == body && hit.flags == 0);
    FE_WITHIN(angle - hit.fraction * (double)turn.z, 0, 1e-6);
    FE_WITHIN(hit.normal.y, -1 - 1e-6, -1 + 1e-6);
    FE_WITHIN(hit.point.x, radius * cos(angle + f0) - 1e-5, radius * cos(angle + f0) + 1e-5);
    FE_WITHIN(hit.point.y, 0.5 - 1e-6, 0.5 + 1e-6);
    fe_vec3 less = {0, 0, (float)angle - 1e-5f}; // ends a hair before
    assert_int_equal(fe_world_sweep_turning(world, &rod, &origin, &nowhere, &less, NULL, &hit), 0);
    OK(fe_world_destroy(world));
}

// About the normal of what it slides on nothing comes nearer, however near it is; a tilt brings a corner down.
static void a_box_slides_while_it_turns(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry ground, box;
    fe_geometry_plane(&ground, 0, 1, 0, 0), fe_geometry_box(&box, 0.5f, 0.5f, 0.5f);
    stand(world, &ground, 0, 0, 0);
    fe_transform start = {{0, 2, 0}, {0, 0, 0, 1}};
    fe_dvec3 down = {0, -5, 0}, along = {10, 0, 0};
    fe_hit hit;
    HIT(fe_world_sweep(world, &box, &start, &down, NULL, &hit));
    start.position.y -= 5 * hit.fraction;
    const fe_vec3 upright = {0, FULL_TURN, 0}, tilted = {0.001f, FULL_TURN, 0};
    assert_int_equal(fe_world_sweep_turning(world, &box, &start, &along, &upright, NULL, &hit), 0);
    HIT(fe_world_sweep_turning(world, &box, &start, &along, &tilted, NULL, &hit));
    OK(fe_world_destroy(world));
}

// A post of 1 mm at the angle f and 1.5 m out meets the arm's side, 0.05 m off its middle: sin(f - f') 1.5 = 0.051.
static void a_full_turn_misses_no_thin_post(void **state)
{
    (void)state;
    for (int i = 0; i < 100; ++i) {
        fe_world *world = new_world();
        fe_geometry post, moving = arm(world);
        fe_geometry_cylinder(&post, 1, 0.001f);
        double f = 0.2 + (6.2 - 0.2) * i / 99;
        stand(world, &post, 1.5 * cos(f), 0, -1.5 * sin(f));
        fe_vec3 turn = {0, FULL_TURN, 0};
        fe_hit hit;
        HIT(fe_world_sweep_turning(world, &moving, &origin, &nowhere, &turn, NULL, &hit));
        FE_WITHIN(f - asin(0.051 / 1.5) - hit.fraction * (double)turn.y, 0, 2e-6);
        FE_WITHIN(hit.triangle, -1, -1);
        OK(fe_world_destroy(world));
    }
}

static void what_shows_no_turn_sweeps_as_without(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry ground, g[4];
    fe_geometry_plane(&ground, 0, 1, 0, 0);
    stand(world, &ground, 0, 0, 0);
    fe_geometry_sphere(&g[0], 1), fe_geometry_cylinder(&g[1], 0.5f, 1), fe_geometry_cone(&g[2], 0.5f, 1),
        fe_geometry_box(&g[3], 1, 1, 1);
    const fe_transform start = {{0, 3, 0}, {0.5f, 0.5f, 0.5f, 0.5f}}; // y goes to z
    const fe_dvec3 way = {10, -5, 0};
    const fe_vec3 rolling = {0, 0, -10}, none = {0, 0, 0};
    for (int i = 0; i < 4; ++i) {
        fe_hit plain, turned;
        HIT(fe_world_sweep(world, &g[i], &start, &way, NULL, &plain));
        HIT(fe_world_sweep_turning(world, &g[i], &start, &way, i < 3 ? &rolling : &none, NULL, &turned));
        assert_memory_equal(&plain, &turned, sizeof plain);
    }
    // a wheel rolls where it stands: no touch
    fe_transform on_ground = {{0, 1 + 1e-7, 0}, start.rotation};
    const fe_dvec3 along = {10, 0, 0};
    assert_int_equal(fe_world_sweep_turning(world, &g[1], &on_ground, &along, &rolling, NULL, &(fe_hit){0}), 0);
    OK(fe_world_destroy(world));
}

// An arm comes up through a floor that has an upper side alone, and does not feel it; going round the other way it
// comes down on it after 330 degrees, less what its half width takes: atan(0.05 / 0.5) at its inner end, the floor
// begins at 1.
static void triangles_are_passed_from_below(void **state)
{
    (void)state;
    float vertices[4][3] = {{0.4f, 0, -1}, {0.4f, 0, 1}, {3, 0, 1}, {3, 0, -1}};
    uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    for (int two_sided = 0; two_sided < 2; ++two_sided) {
        fe_world *world = new_world();
        fe_mesh_def def;
        fe_mesh_def_init(&def, sizeof def);
        def.vertices = &vertices[0][0], def.indices = indices, def.vertex_count = 4, def.triangle_count = 2;
        def.flags = two_sided ? FE_MESH_TWO_SIDED : 0;
        fe_asset mesh;
        fe_geometry floor, moving = arm(world);
        OK(fe_mesh_create(world_store(world), &def, &mesh));
        fe_geometry_mesh(&floor, mesh);
        stand(world, &floor, 0, 0, 0);
        const double sine = 0.5, half = 0.5235987755982988; // 30 degrees down
        fe_transform start = origin;
        start.rotation = (fe_quat){0, 0, -(float)sin(0.5 * asin(sine)), (float)cos(0.5 * asin(sine))};
        const fe_vec3 up = {0, 0, 2 * FULL_TURN}, down = {0, 0, -FULL_TURN};
        fe_hit hit;
        const double inner = atan(0.05 / 0.5);
        assert_int_equal(fe_world_sweep_turning(world, &moving, &start, &nowhere, &up, NULL, &hit), two_sided);
        if (two_sided) FE_WITHIN(half - inner - hit.fraction * (double)up.z, -1e-6, 2e-6);
        HIT(fe_world_sweep_turning(world, &moving, &start, &nowhere, &down, NULL, &hit));
        FE_WITHIN((double)FULL_TURN - half - inner + hit.fraction * (double)down.z, -1e-6, 3e-6);
        OK(fe_world_destroy(world));
    }
}

// One triangle on both sides of the axis: up through it on the right, down on it on the left.
static void a_triangle_that_was_passed_stops_the_way_back(void **state)
{
    (void)state;
    float vertices[3][3] = {{-30, 0, -30}, {0, 0, 30}, {30, 0, -30}};
    uint32_t indices[3] = {0, 1, 2};
    fe_world *world = new_world();
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = &vertices[0][0], def.indices = indices, def.vertex_count = 3, def.triangle_count = 1;
    fe_asset mesh;
    fe_geometry floor, moving = arm(world);
    OK(fe_mesh_create(world_store(world), &def, &mesh));
    fe_geometry_mesh(&floor, mesh);
    stand(world, &floor, 0, 0, 0);
    fe_transform start = origin;
    start.rotation = (fe_quat){0, 0, -0.25881905f, 0.9659258f}; // 30 degrees down
    const fe_vec3 up = {0, 0, FULL_TURN};
    fe_hit hit;
    HIT(fe_world_sweep_turning(world, &moving, &start, &nowhere, &up, NULL, &hit));
    FE_WITHIN((double)FULL_TURN * 210 / 360 - atan(0.05 / 0.5) - hit.fraction * (double)up.z, -1e-6, 3e-6);
    OK(fe_world_destroy(world));
}

// ---- the calls agree -----------------------------------------------------------------------------------------------
enum { BODIES = 60, PATHS = 300 };

static void all_any_first_and_many_agree(void **state)
{
    (void)state;
    fe_world *world = new_world();
    for (int i = 0; i < BODIES; ++i) {
        solid s = make_solid(world, kinds[one_of(&rolled, KINDS - 1)]);
        stand(world, &s.g, uniform(&rolled, -30, 30), uniform(&rolled, -30, 30), uniform(&rolled, -30, 30));
    }
    fe_geometry rod;
    fe_geometry_box(&rod, 3, 0.1f, 0.2f);
    static fe_path paths[PATHS];
    static fe_hit many[PATHS], spread_out[PATHS];
    for (int i = 0; i < PATHS; ++i) paths[i] = random_path(10, (vec){0, 0, 0});
    int32_t count = fe_world_sweep_many(world, &rod, paths, sizeof *paths, PATHS, NULL, 0, many, sizeof *many),
            hits = 0;
    assert_int_equal(fe_world_sweep_many(world, &rod, paths, sizeof *paths, PATHS, NULL, 1, spread_out,
                                         sizeof *spread_out),
                     count);
    assert_memory_equal(many, spread_out, sizeof many);
    for (int i = 0; i < PATHS; ++i) {
        const fe_path *p = &paths[i];
        fe_hit first, all[BODIES];
        int32_t met = fe_world_sweep_turning(world, &rod, &p->start, &p->translation, &p->turn, NULL, &first),
                found = fe_world_sweep_turning_all(world, &rod, &p->start, &p->translation, &p->turn, NULL, all,
                                                   sizeof *all, BODIES);
        assert_int_equal(fe_world_sweep_turning_any(world, &rod, &p->start, &p->translation, &p->turn, NULL), met);
        assert_int_equal(met, found > 0);
        hits += met;
        if (met) assert_memory_equal(&first, &many[i], sizeof first);
        if (met) assert_memory_equal(&first, &all[0], sizeof first);
        if (!met) FE_TRUE(many[i].body == 0 && many[i].fraction == 1);
        for (int k = 1; k < found; ++k)
            FE_TRUE(all[k - 1].fraction <= all[k].fraction && all[k - 1].body != all[k].body);
    }
    assert_int_equal(hits, count);
    FE_WITHIN(hits, PATHS / 8, PATHS - 1);
    OK(fe_world_destroy(world));
}

static void an_overlap_at_the_start_is_told_as_without_a_turn(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry box;
    fe_geometry_box(&box, 1, 1, 1);
    stand(world, &box, 0, 0, 0);
    fe_transform start = {{1.5, 0, 0}, {0, 0, 0, 1}};
    const fe_dvec3 ways[2] = {{0, 0, 0}, {3, 0, 0}};
    const fe_vec3 turn = {1, 2, 3};
    for (int i = 0; i < 2; ++i) {
        fe_hit plain, turned;
        HIT(fe_world_sweep(world, &box, &start, &ways[i], NULL, &plain));
        HIT(fe_world_sweep_turning(world, &box, &start, &ways[i], &turn, NULL, &turned));
        assert_memory_equal(&plain, &turned, sizeof plain);
        FE_TRUE(turned.flags == FE_HIT_STARTED_INSIDE);
    }
    OK(fe_world_destroy(world));
}

// ---- errors --------------------------------------------------------------------------------------------------------
static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    fe_world *w = new_world();
    fe_geometry box, plane;
    fe_geometry_box(&box, 1, 1, 1), fe_geometry_plane(&plane, 0, 1, 0, 0);
    stand(w, &box, 0, 0, -5);
    const fe_dvec3 way = {0, 0, -5}, wild = {0, (double)NAN, 0};
    const fe_vec3 turn = {0, 1, 0}, wrong[3] = {{0, 64.1f, 0}, {NOT_A_NUMBER, 0, 0}, {0, 0, -INFINITE}};
    const fe_transform askew = {{0, 0, 0}, {0, 0, 0, 0}};
    fe_hit h;
    for (int i = 0; i < 3; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &origin, &way, &wrong[i], NULL, &h));
        SAYS("turn");
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning_any(w, &box, &origin, &way, &wrong[i], NULL));
        REFUSES(w, FE_ERROR_ARGUMENT,
                fe_world_sweep_turning_all(w, &box, &origin, &way, &wrong[i], NULL, &h, sizeof h, 1));
        fe_path path = {origin, way, wrong[i], {0}};
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_many(w, &box, &path, sizeof path, 1, NULL, 0, &h, sizeof h));
        SAYS("turn");
        HIT(fe_world_sweep_many(w, &box, &path, 64, 1, NULL, 0, &h, sizeof h)); // its turn is not read
    }
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &origin, &way, NULL, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &origin, &wild, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &origin, NULL, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &askew, &way, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, NULL, &way, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, NULL, &origin, &way, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning(w, &box, &origin, &way, &turn, NULL, NULL));
    REFUSES(w, FE_ERROR_UNSUPPORTED, fe_world_sweep_turning(w, &plane, &origin, &way, &turn, NULL, &h));
    REFUSES(w, FE_ERROR_UNSUPPORTED, fe_world_sweep_turning_any(w, &plane, &origin, &way, &turn, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning_any(w, &box, &origin, &way, NULL, NULL));
    REFUSES(w, FE_ERROR_UNSUPPORTED,
            fe_world_sweep_turning_all(w, &plane, &origin, &way, &turn, NULL, &h, sizeof h, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning_all(w, &box, &origin, &way, &turn, NULL, NULL, sizeof h, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_turning_all(w, &box, &origin, &way, &turn, NULL, &h, 91, 1));
    fe_path path = {.start = origin, .translation = way, .turn = turn, .reserved = {0, 0, 0, 0, 1}};
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_many(w, &box, &path, sizeof path, 1, NULL, 0, &h, sizeof h));
    OK(fe_world_destroy(w));
}

int main(int argc, char **argv)
{
    if (argc > 1) cases = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod_turns_into_a_wall),
        cmocka_unit_test(a_box_slides_while_it_turns),
        cmocka_unit_test(a_full_turn_misses_no_thin_post),
        cmocka_unit_test(what_shows_no_turn_sweeps_as_without),
        cmocka_unit_test(triangles_are_passed_from_below),
        cmocka_unit_test(a_triangle_that_was_passed_stops_the_way_back),
        cmocka_unit_test(all_any_first_and_many_agree),
        cmocka_unit_test(an_overlap_at_the_start_is_told_as_without_a_turn),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(nothing_is_met_before_the_stop),
        cmocka_unit_test(no_triangle_is_missed),
    };
    return cmocka_run_group_tests_name("turning", tests, NULL, NULL);
}
