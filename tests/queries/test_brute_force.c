// Rays, sweeps of every moving form, overlaps and closest points at meshes of a thousand triangles, hulls, cylinders
// and cones: what the library answers against every triangle, every face, every form asked one by one in long double.
//
//     build/tests/queries/test_brute_force 100000     that many of each kind, sweeps that many of each moving form
//     build/tests/queries/test_brute_force 100000 sweeps_of_cones   these alone
//
// Forms of 2 cm to 2 m, in any pose, at the world's origin and 1e6 m off it; meshes under scales and mirrored, too. The
// judge is judge.h. A case that fails is printed.
#include "queries/judge.h"

#include <stdio.h>

#if defined(FE_SANITIZED)
enum { CASES = 200, SWEEPS = 100 };
#else
enum { CASES = 3000, SWEEPS = 300 };
#endif
enum { STANDS = 5, PER_STAND = 20, ROWS = 20, COLUMNS = 25, TRIANGLES = 2 * ROWS * COLUMNS, HULL_POINTS = 12 };

static int32_t cases = CASES, sweeps = SWEEPS; // of each moving form

typedef struct bench {
    fe_world *world;
    fe_store *store;
    fe_shape shape;
    fe_body body;
    dice dice;
    solid_form form; // that stands, unless it is a mesh
    fe_geometry geometry;
    fe_asset mesh;
    int32_t is_sheet;
    fe_transform pose;
    double reach, extent, bend; // m; of a hull's faces below their planes
    standing judge;
} bench;

// A query, as the library and as the judge see it
typedef struct query {
    uint64_t dice; // before it was drawn
    const solid_form *mover;
    fe_transform start;
    fe_dvec3 way;
    vec from, along; // relative to what stands
} query;

static void print_form(const char *name, const fe_geometry *g, const solid_form *f, const fe_transform *t)
{
    print_error("%s: type %d, radius %a, half height %a, half %a %a %a, scale %a %a %a\n", name, (int)g->type,
                (double)g->radius, (double)g->half_height, (double)g->half_extents.x, (double)g->half_extents.y,
                (double)g->half_extents.z, (double)g->scale.x, (double)g->scale.y, (double)g->scale.z);
    print_error("    at %a %a %a, rotation %a %a %a %a\n", t->position.x, t->position.y, t->position.z,
                (double)t->rotation.x, (double)t->rotation.y, (double)t->rotation.z, (double)t->rotation.w);
    for (int32_t i = 0; f && i < f->count; ++i)
        print_error("    %a %a %a\n", (double)f->points[i][0], (double)f->points[i][1], (double)f->points[i][2]);
}

static void must(int holds, const char *law, const bench *b, const query *q, double value, int32_t triangle)
{
    if (holds) return;
    print_error("broken: %s: %.17g, triangle %d, dice 0x%llx\n", law, value, (int)triangle,
                (unsigned long long)q->dice);
    print_form("stands", &b->geometry, b->judge.form, &b->pose);
    print_form("moves", &q->mover->geometry, q->mover, &q->start);
    print_error("    by %a %a %a\n", q->way.x, q->way.y, q->way.z);
    for (int32_t k = 0; triangle >= 0 && triangle < b->judge.triangle_count && k < 3; ++k) {
        vec v = b->judge.triangles[triangle].vertex[k];
        print_error("    corner %.17Lg %.17Lg %.17Lg from there\n", v.x, v.y, v.z);
    }
    fail();
}

// ---- what stands ---------------------------------------------------------------------------------------------------
typedef struct soup {
    float vertices[3 * TRIANGLES][3];
    uint32_t corners[TRIANGLES][3];
    int32_t count; // of vertices
} soup;

// Anywhere, through each other
static void scatter(dice *d, soup *m)
{
    double size = spread(d, 0.03, 0.5);
    m->count = 3 * TRIANGLES;
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        fe_dvec3 at = random_vector(d, 1);
        for (int32_t k = 0; k < 3; ++k) {
            fe_dvec3 r = random_vector(d, size);
            float *v = m->vertices[3 * i + k];
            v[0] = (float)(at.x + r.x), v[1] = (float)(at.y + r.y), v[2] = (float)(at.z + r.z);
            m->corners[i][k] = (uint32_t)(3 * i + k);
        }
    }
}

static void make_sheet(dice *d, soup *m)
{
    const double cell = 0.1;
    m->count = (ROWS + 1) * (COLUMNS + 1);
    for (int32_t i = 0; i < m->count; ++i) {
        fe_dvec3 r = random_vector(d, 0.3 * cell);
        float *v = m->vertices[i];
        v[0] = (float)(cell * (i % (COLUMNS + 1) - 0.5 * COLUMNS) + r.x), v[1] = (float)r.y;
        v[2] = (float)(cell * (i / (COLUMNS + 1) - 0.5 * ROWS) + r.z);
    }
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        uint32_t a = i / 2 / COLUMNS * (COLUMNS + 1) + i / 2 % COLUMNS, c = a + COLUMNS + 2;
        m->corners[i][0] = a;
        m->corners[i][1] = i % 2 ? c : a + COLUMNS + 1;
        m->corners[i][2] = i % 2 ? a + 1 : c;
    }
}

static void stand_mesh(bench *b, fe_quat rotation)
{
    static soup m;
    static solid triangles[TRIANGLES];
    standing *s = &b->judge;
    if (b->is_sheet)
        make_sheet(&b->dice, &m);
    else
        scatter(&b->dice, &m);
    s->form = NULL, s->rotation = rotation, s->triangle_count = TRIANGLES, s->triangles = triangles;
    s->is_two_sided = chance(&b->dice, 0.5);
    const fe_vec3 scale = b->geometry.scale;
    int32_t is_mirror = scale.x * scale.y * scale.z < 0;
    b->reach = 0;
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        vec v[3];
        for (int32_t k = 0; k < 3; ++k) {
            const float *p = m.vertices[m.corners[i][is_mirror && k ? 3 - k : k]];
            v[k] = v_turn(rotation, (vec){(real)scale.x * p[0], (real)scale.y * p[1], (real)scale.z * p[2]});
            b->reach = fmax(b->reach, (double)v_length(v[k]));
        }
        triangles[i] = make_triangle_solid(v[0], v[1], v[2]);
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = m.vertices[0], def.vertex_count = m.count;
    def.indices = m.corners, def.triangle_count = TRIANGLES;
    def.flags = s->is_two_sided ? FE_MESH_TWO_SIDED : 0;
    OK(fe_mesh_create(b->store, &def, &b->mesh));
    b->geometry.asset = b->mesh;
}

// How far corners of a face lie below its plane, at the most
static double bend_of(const bench *b)
{
    enum { FACES = 2 * HULL_POINTS, CORNERS = 6 * HULL_POINTS };
    fe_hull_face faces[FACES];
    int32_t corners[CORNERS], count = fe_hull_get_faces(b->store, b->form.asset, faces, sizeof *faces, FACES);
    FE_WITHIN(fe_hull_get_corners(b->store, b->form.asset, corners, 0, CORNERS), 12, CORNERS);
    double most = 0;
    for (int32_t f = 0; f < count; ++f) {
        for (int32_t k = 0; faces[f].count > 3 && k < faces[f].count; ++k) {
            const float *p = b->form.points[corners[faces[f].first + k]];
            fe_vec3 n = faces[f].normal;
            most = fmax(most, (double)faces[f].distance - (double)n.x * (double)p[0] - (double)n.y * (double)p[1] -
                                  (double)n.z * (double)p[2]);
        }
    }
    return most;
}

static void take_away(bench *b)
{
    if (b->mesh) OK(fe_asset_destroy(b->store, b->mesh));
    b->mesh = 0;
    free_form(b->store, &b->form);
}

static void set_up(bench *b, int32_t stand)
{
    static const int32_t types[STANDS] = {FE_GEOMETRY_MESH, FE_GEOMETRY_MESH, FE_GEOMETRY_HULL, FE_GEOMETRY_CYLINDER,
                                          FE_GEOMETRY_CONE};
    dice *d = &b->dice;
    double middle = chance(d, 0.5) ? 0 : 1e6;
    take_away(b);
    b->pose = (fe_transform){fe_make_dvec3(middle, -middle, uniform(d, -10, 10)), random_rotation(d)};
    OK(fe_body_set_transform(b->world, b->body, &b->pose));
    OK(fe_body_get_transform(b->world, b->body, &b->pose)); // its rotation brought to length 1, in floats
    b->bend = b->extent = 0;
    if (types[stand] == FE_GEOMETRY_MESH) {
        fe_geometry_mesh(&b->geometry, 0), fe_geometry_set_scale(&b->geometry, 1, 1, 1);
        double sizes[3];
        for (int32_t k = 0; k < 3; ++k) sizes[k] = spread(d, 0.2, 5) * (chance(d, 0.5) ? 1 : -1);
        if (chance(d, 0.7)) fe_geometry_set_scale(&b->geometry, (float)sizes[0], (float)sizes[1], (float)sizes[2]);
        b->is_sheet = stand;
        stand_mesh(b, b->pose.rotation);
    } else {
        make_form(b->store, d, types[stand], 0.02, 2, HULL_POINTS, &b->form);
        b->geometry = b->form.geometry, b->reach = b->form.reach;
        stand_form(&b->judge, &b->form, b->pose.rotation);
    }
    if (b->form.asset) b->bend = bend_of(b), b->extent = 2 * b->reach;
    OK(fe_shape_set_geometry(b->world, b->shape, &b->geometry));
}

static bench begin(uint64_t seed)
{
    bench b = {.world = new_world(), .dice = {UINT64_C(0x9e3779b97f4a7c15) + seed}};
    OK(fe_world_get_store(b.world, &b.store));
    b.body = new_body(b.world, FE_BODY_STATIC, 0, 0, 0);
    b.shape = add_box(b.world, b.body, 1);
    return b;
}

static void end(bench *b) { OK(fe_world_destroy(b->world)); }

// ---- what is asked -------------------------------------------------------------------------------------------------
static fe_dvec3 along(fe_dvec3 p, double s, fe_dvec3 d)
{
    return fe_make_dvec3(p.x + s * d.x, p.y + s * d.y, p.z + s * d.z);
}

// A way past a point that is `near` at the most off the body, or ends there
static query draw(bench *b, const solid_form *mover, double near)
{
    dice *d = &b->dice;
    query q = {.dice = d->state, .mover = mover};
    fe_dvec3 way = direction(d), aim = along(b->pose.position, near * cbrt(uniform(d, 0, 1)), direction(d));
    if (chance(d, 0.1)) way = fe_make_dvec3(0, way.y < 0 ? -1 : 1, 0);
    double length = spread(d, 0.05, 20) * (b->reach + near);
    q.start = (fe_transform){along(aim, -length * uniform(d, 0, 1), way), random_rotation(d)};
    q.way = along(fe_make_dvec3(0, 0, 0), length, way);
    q.from = v_sub(v_of(q.start.position), v_of(b->pose.position)), q.along = v_of(q.way);
    return q;
}

static vec at(const query *q, real t) { return v_add(q->from, v_scale(t, q->along)); }

// Rounding of floats in a hull's planes, 2e-7 of its extent, and what its faces bend, on both sides of an edge
static double bound_of(const bench *b, double otherwise)
{
    return b->form.asset ? 2e-7 * b->extent + 2 * b->bend : otherwise;
}

// ---- rays ----------------------------------------------------------------------------------------------------------
static void check_ray_at_mesh(const bench *b, const query *q, int32_t met, const fe_hit *hit)
{
    const real margin = 1e-9L;
    const standing *s = &b->judge;
    real stop = met ? (real)hit->fraction : 1;
    for (int32_t i = 0; i < s->triangle_count; ++i) {
        solid t = seen_from(s, i, q->from);
        int there = ray_meets_triangle(q->from, q->along, &t, stop, margin);
        must(there <= 0, "no triangle is passed before", b, q, (double)stop, i);
    }
    if (!met) return;
    must(hit->triangle >= 0 && hit->triangle < TRIANGLES, "a ray tells its triangle", b, q, hit->fraction,
         hit->triangle);
    solid t = seen_from(s, hit->triangle, q->from);
    vec p = at(q, stop);
    real height = v_dot(t.normal, v_sub(p, t.vertex[0])), off = distance_to_triangle(s, hit->triangle, p);
    must(fabsl(height) <= margin && off <= margin, "a ray ends on its triangle", b, q, (double)off, hit->triangle);
    real sine = v_length(v_cross(t.normal, v_off(hit->normal)));
    must(sine < 1e-6L && v_dot(t.normal, v_off(hit->normal)) > 0, "the normal is the triangle's", b, q, (double)sine,
         hit->triangle);
    must(v_dot(t.normal, q->along) <= 0, "a normal is against the way", b, q, hit->fraction, hit->triangle);
}

static void check_ray_at_form(const bench *b, const query *q, int32_t met, const fe_hit *hit)
{
    const standing *s = &b->judge;
    double bound = bound_of(b, 1e-9);
    real t, start = signed_distance(s, q->from), least = least_on_ray(s, q->from, q->along, &t);
    if (fabsl(start) <= bound) return;
    if (start < 0 || (met && hit->flags & FE_HIT_STARTED_INSIDE)) {
        must(start < 0 && met && hit->flags == FE_HIT_STARTED_INSIDE, "a ray starts inside", b, q, (double)start, -1);
        return;
    }
    if (!met) {
        must(least >= -bound, "no ray slips through", b, q, (double)least, -1);
        return;
    }
    must(least <= bound, "what is met is there", b, q, (double)least, -1);
    vec p = at(q, hit->fraction);
    real off = signed_distance(s, p), step = 0.1L * b->reach;
    must(fabsl(off) <= bound, "a ray ends on the surface", b, q, (double)off, -1);
    if (least < -2 * bound) must(hit->fraction <= t, "a ray ends where it enters", b, q, hit->fraction, -1);
    // a step along an outward normal of a convex form leads as far away
    real away = signed_distance(s, v_add(p, v_scale(step, v_off(hit->normal))));
    must(fabsl(away - step) <= bound + 1e-6L * step, "the normal is the surface's", b, q, (double)(away - step), -1);
}

static void rays(void **state)
{
    (void)state;
    const solid_form point = {.geometry = {.type = FE_GEOMETRY_SPHERE}};
    bench b = begin(1);
    int32_t hits = 0;
    for (int32_t i = 0; i < cases; ++i) {
        if (i % PER_STAND == 0) set_up(&b, i / PER_STAND % STANDS);
        query q = draw(&b, &point, 0.6 * b.reach);
        fe_hit hit;
        int32_t met = fe_world_raycast(b.world, &q.start.position, &q.way, NULL, &hit);
        FE_WITHIN(met, 0, 1);
        hits += met;
        if (b.judge.triangle_count)
            check_ray_at_mesh(&b, &q, met, &hit);
        else
            check_ray_at_form(&b, &q, met, &hit);
    }
    FE_WITHIN(hits, cases / 5, cases - cases / 10);
    printf("%d rays, %d hits\n", (int)cases, (int)hits);
    end(&b);
}

// ---- overlaps ------------------------------------------------------------------------------------------------------
// 1 surely, -1 not, 0 perhaps: what touches, or overlaps by less than a ten-thousandth of its size
static int overlaps(const bench *b, const moving *m)
{
    moving small = shrunk_form(m);
    real t;
    vec away;
    if (!b->judge.triangle_count) {
        if (comes_near(&small, &b->judge.convex, 0, &t, &away) > 0) return 1;
        return comes_near(m, &b->judge.convex, 0, &t, &away) < 0 ? -1 : 0;
    }
    int most = -1;
    for (int32_t i = 0; i < b->judge.triangle_count && most < 1; ++i) {
        const solid *triangle = &b->judge.triangles[i];
        if (passes_triangle(m, 0, triangle)) continue;
        convex still = convex_of_triangle(triangle);
        if (comes_near(&small, &still, 0, &t, &away) > 0) return 1;
        if (comes_near(m, &still, 0, &t, &away) >= 0) most = 0;
    }
    return most;
}

static const int32_t movers[] = {FE_GEOMETRY_SPHERE,   FE_GEOMETRY_CAPSULE, FE_GEOMETRY_BOX,
                                 FE_GEOMETRY_CYLINDER, FE_GEOMETRY_CONE,    FE_GEOMETRY_HULL};
enum { MOVERS = sizeof movers / sizeof *movers };

static void overlaps_of_every_form(void **state)
{
    (void)state;
    bench b = begin(2);
    int32_t found = 0, unsure = 0;
    for (int32_t i = 0; i < cases; ++i) {
        if (i % PER_STAND == 0) set_up(&b, i / PER_STAND % STANDS);
        solid_form mover;
        make_form(b.store, &b.dice, movers[i % MOVERS], 0.02, 2, HULL_POINTS, &mover);
        query q = draw(&b, &mover, 0);
        q.start.position =
            along(b.pose.position, uniform(&b.dice, 0, 0.8) * (b.reach + mover.reach), direction(&b.dice));
        moving m =
            moving_form(&mover, v_sub(v_of(q.start.position), v_of(b.pose.position)), q.start.rotation, (vec){0, 0, 0});
        int32_t there = fe_world_overlap_any(b.world, &mover.geometry, &q.start, NULL);
        int judged = overlaps(&b, &m);
        must(judged == 0 || there == (judged > 0), "an overlap is one", &b, &q, there, -1);
        found += there, unsure += judged == 0;
        free_form(b.store, &mover);
    }
    FE_WITHIN(found, cases / 20, cases - cases / 10);
    FE_WITHIN(unsure, 0, cases / 100);
    printf("%d overlaps asked, %d found, %d of %d too near to tell\n", (int)cases, (int)found, (int)unsure, (int)cases);
    end(&b);
}

// ---- sweeps --------------------------------------------------------------------------------------------------------
static int meets(const bench *b, const moving *m, int32_t triangle, real stop)
{
    real t;
    vec away;
    if (b->judge.triangle_count) return meets_triangle(m, &b->judge, triangle, stop);
    return comes_near(m, &b->judge.convex, stop, &t, &away);
}

static separation at_stop(const bench *b, const moving *m, int32_t triangle, real stop)
{
    convex still = b->judge.convex;
    if (b->judge.triangle_count) still = convex_of_triangle(&b->judge.triangles[triangle]);
    return separation_of(&m->convex, v_scale(stop, m->way), &still, TOUCH);
}

// Of the sheet's border, or one of those that have no neighbours
static int is_on_rim(const bench *b, int32_t triangle)
{
    int32_t row = triangle / 2 / COLUMNS, column = triangle / 2 % COLUMNS;
    return !b->is_sheet || row == 0 || row == ROWS - 1 || column == 0 || column == COLUMNS - 1;
}

static double check_sweep(const bench *b, const query *q, int32_t met, const fe_hit *hit)
{
    const double most = 1e-6;
    moving m = moving_form(q->mover, q->from, q->start.rotation, q->along), still = m;
    still.way = (vec){0, 0, 0};
    int inside = overlaps(b, &still), starts_inside = met && hit->flags & FE_HIT_STARTED_INSIDE;
    must(inside == 0 || starts_inside == (inside > 0), "an overlap at the start is told", b, q, inside, -1);
    if (starts_inside || inside >= 0) return 0;
    int32_t parts = b->judge.triangle_count ? b->judge.triangle_count : 1;
    moving judged = met ? m : shrunk_form(&m);
    real stop = met ? (real)hit->fraction : 1;
    for (int32_t i = 0; i < parts; ++i)
        must(meets(b, &judged, i, stop) <= 0, met ? "nothing is met before the stop" : "what is met is told", b, q,
             (double)stop, i);
    if (!met) return 0;
    int32_t triangle = b->judge.triangle_count ? hit->triangle : -1;
    must(b->judge.triangle_count == 0 || (triangle >= 0 && triangle < parts), "a sweep tells its triangle", b, q,
         hit->fraction, triangle);
    separation s = at_stop(b, &m, triangle, stop);
    double gap = (double)(s.most - m.radius);
    must(gap <= most + 2 * (double)TOUCH, "a sweep stops before what it meets", b, q, gap, triangle);
    if (triangle >= 0 && !b->judge.is_two_sided) {
        const solid *met_there = &b->judge.triangles[triangle];
        real up = v_dot(s.away, met_there->normal) / v_length(s.away);
        must(up > -0.01L || is_on_rim(b, triangle), "inner sides are passed from behind", b, q, (double)up, triangle);
        must(up > -0.01L || highest_over(&m, stop, met_there) > 0, "from behind it passes", b, q, (double)up, triangle);
    }
    real sine = v_length(v_cross(s.away, v_off(hit->normal))) / v_length(s.away);
    must(sine <= 0.02L, "the normal is that of the stop", b, q, (double)sine, triangle);
    return gap;
}

static void sweep(int32_t kind)
{
    bench b = begin(3 + (uint64_t)kind);
    int32_t hits = 0;
    double most = 0;
    for (int32_t i = 0; i < sweeps; ++i) {
        if (i % PER_STAND == 0) set_up(&b, i / PER_STAND % STANDS);
        solid_form mover;
        make_form(b.store, &b.dice, movers[kind], 0.02, 2, HULL_POINTS, &mover);
        query q = draw(&b, &mover, 0.6 * (b.reach + mover.reach));
        fe_hit hit;
        int32_t met = fe_world_sweep(b.world, &mover.geometry, &q.start, &q.way, NULL, &hit);
        FE_WITHIN(met, 0, 1);
        hits += met;
        most = fmax(most, check_sweep(&b, &q, met, &hit));
        free_form(b.store, &mover);
    }
    FE_WITHIN(hits, sweeps / 4, sweeps);
    printf("%d sweeps, %d hits, stops within %.4f um\n", (int)sweeps, (int)hits, 1e6 * most);
    end(&b);
}

static void sweeps_of_spheres(void **state) { (void)state, sweep(0); }
static void sweeps_of_capsules(void **state) { (void)state, sweep(1); }
static void sweeps_of_boxes(void **state) { (void)state, sweep(2); }
static void sweeps_of_cylinders(void **state) { (void)state, sweep(3); }
static void sweeps_of_cones(void **state) { (void)state, sweep(4); }
static void sweeps_of_hulls(void **state) { (void)state, sweep(5); }

// ---- closest points ------------------------------------------------------------------------------------------------
static void check_closest(const bench *b, const query *q, const fe_closest *c)
{
    const standing *s = &b->judge;
    double bound = bound_of(b, 1e-9);
    vec on = v_sub(v_of(c->point), v_of(b->pose.position));
    real distance = INFINITY, off, rounding = 2e-9L; // of a point in doubles 1e6 m away
    if (s->triangle_count) {
        must(c->triangle >= 0 && c->triangle < TRIANGLES, "a point tells its triangle", b, q, c->distance, c->triangle);
        for (int32_t i = 0; i < s->triangle_count; ++i) distance = fminl(distance, distance_to_triangle(s, i, q->from));
        off = distance_to_triangle(s, c->triangle, on);
        real there = distance_to_triangle(s, c->triangle, q->from);
        must(fabsl(there - distance) <= bound, "no triangle is nearer", b, q, (double)(there - distance), c->triangle);
    } else {
        distance = signed_distance(s, q->from), off = signed_distance(s, on);
    }
    must(fabsl(c->distance - distance) <= bound, "the distance is the least", b, q, (double)(c->distance - distance),
         c->triangle);
    must(fabsl(off) <= bound + rounding, "the point is on the surface", b, q, (double)off, c->triangle);
    real to = v_length(v_sub(q->from, on)) - fabsl(distance);
    must(fabsl(to) <= 2 * bound + rounding, "the point is that far away", b, q, (double)to, c->triangle);
}

static void closest_points(void **state)
{
    (void)state;
    const solid_form point = {.geometry = {.type = FE_GEOMETRY_SPHERE}};
    bench b = begin(9);
    for (int32_t i = 0; i < cases; ++i) {
        if (i % PER_STAND == 0) set_up(&b, i / PER_STAND % STANDS);
        query q = draw(&b, &point, 1.5 * b.reach);
        fe_closest c;
        HIT(fe_world_closest_point(b.world, &q.start.position, 1e9, NULL, &c));
        check_closest(&b, &q, &c);
    }
    printf("%d closest points\n", (int)cases);
    end(&b);
}

int main(int argc, char **argv)
{
    if (argc > 1) cases = sweeps = atoi(argv[1]);
    if (argc > 2) cmocka_set_test_filter(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays),
        cmocka_unit_test(overlaps_of_every_form),
        cmocka_unit_test(sweeps_of_spheres),
        cmocka_unit_test(sweeps_of_capsules),
        cmocka_unit_test(sweeps_of_boxes),
        cmocka_unit_test(sweeps_of_cylinders),
        cmocka_unit_test(sweeps_of_cones),
        cmocka_unit_test(sweeps_of_hulls),
        cmocka_unit_test(closest_points),
    };
    return cmocka_run_group_tests_name("brute_force", tests, NULL, NULL);
}
