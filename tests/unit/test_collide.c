// The narrow phase: every pair of forms against the distance and depth of their cores in double, and the laws of
// manifolds.
#include "fe_test.h"

#include "collision/manifold/collide.h"
#include "collision/manifold/pair_kernels.h"
#include "collision/form/gjk.h"

#include "collision_cases.h"

enum { POSES = 20000 };
#define MARGIN 0.02f
// Forms of up to 1 m half width lie up to 4 m apart: float rounds by 2.4e-7 there, and some ten roundings add up.
#define ROUNDING 3e-6
// Of two answers as deep as each other within this the steadier is given (pair_kernels.h); the box kernel chooses
// twice, face of A before face of B before edge.
#define TIE 0.0005
#define FACE_DEGREES 5.0
#define HALF_PI 1.57079632679489662

typedef struct truth {
    double separation; // of the surfaces
    double distance;   // of the cores
    fe_dvec3 normal;
} truth;

static truth true_contact(const fe__form *a, const fe__form *b, const fe__relative *r)
{
    frame f = frame_of(r);
    fe__cores cores = {a, b, f.position, f.x, f.y, f.z, NULL};
    fe__gjk g;
    fe__gjk_distance(&cores, 1e30, &g);
    double radii = (double)a->radius + (double)b->radius;
    if (!g.overlap)
        return (truth){g.distance - radii, g.distance, fe__dscale(1.0 / g.distance, fe__dsub(g.on_b, g.on_a))};
    fe__penetration p = fe__epa_depth(&cores, &g);
    return (truth){-p.depth - radii, -p.depth, p.normal};
}

// A pose at which B is about to touch A or overlaps it by up to `depth`: in one case of three turned as A or by a
// quarter, but for a milliradian.
static fe__relative near_pose(const fe__form *a, const fe__form *b, double depth)
{
    fe_quat rotation = random_rotation();
    fe_dvec3 n = random_direction();
    if (uniform(0.0, 3.0) < 1.0) {
        fe_dvec3 quarter = uniform(0.0, 1.0) < 0.5 ? (fe_dvec3){1.0, 0.0, 0.0} : (fe_dvec3){0.0, 0.0, 1.0};
        rotation = uniform(0.0, 1.0) < 0.5 ? fe__identity() : turn_about(quarter, HALF_PI);
        fe_dvec3 axis = random_direction();
        rotation = fe__normalized(fe__product(turn_about(axis, uniform(0.0, 1e-3)), rotation));
        n = (fe_dvec3){0.0, 0.0, 0.0};
        *(uniform(0.0, 1.0) < 0.3 ? &n.x : uniform(0.0, 1.0) < 0.5 ? &n.y : &n.z) = 1.0;
    }
    fe_vec3 aside = random_vector(0.5);
    fe__relative r = relative(aside, rotation);
    frame f = frame_of(&r);
    double move = uniform(-depth, 1.5 * (double)MARGIN) - gap_along(a, b, &f, n);
    r.position = fe__add(r.position, fe__narrow(fe__dscale(move, n)));
    return r;
}

static fe__manifold collide(const fe__form *a, const fe__form *b, const fe__relative *r, int32_t general)
{
    fe__manifold m = {.axis = -1};
    if (general)
        fe__collide_convex(a, b, r, MARGIN, &m);
    else
        fe__collide(a, b, r, MARGIN, &m);
    return m;
}

static const char *failure; // what a law found, for the case to be printed once

static void law(int32_t holds, const char *text)
{
    if (!holds && failure == NULL) failure = text;
}
#define LAW(condition) law((condition) ? 1 : 0, #condition)

static void assert_laws(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m)
{
    if (failure == NULL) return;
    print_case(a, b, r);
    if (a->type != FE__FORM_PLANE) {
        truth t = true_contact(a, b, r);
        printf("  truth: separation %.9g core distance %.9g normal %.9g %.9g %.9g\n", t.separation, t.distance,
               t.normal.x, t.normal.y, t.normal.z);
    }
    printf("  found: normal %.9g %.9g %.9g axis %d\n", (double)m->normal.x, (double)m->normal.y, (double)m->normal.z,
           m->axis);
    for (int32_t i = 0; i < m->count; ++i) {
        const fe__manifold_point *p = &m->points[i];
        printf("  point %.9g %.9g %.9g separation %.9g id %x\n", (double)p->point.x, (double)p->point.y,
               (double)p->point.z, (double)p->separation, p->id);
    }
    print_error("%s\n", failure);
    failure = NULL;
    fail();
}

// What every manifold obeys: a unit normal, without points one that parts the forms as far as it says; points with
// names of their own, none beyond the margin, each midway between two points of the surfaces, which are a radius out
// from the cores along the normal.
static void check_manifold(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m,
                           double tolerance)
{
    frame f = frame_of(r);
    fe_dvec3 n = fe__widen(m->normal);
    fe__form core_a = *a, core_b = *b;
    core_a.radius = core_b.radius = 0.0f;
    LAW(m->count >= 0 && m->count <= FE_MAX_POINTS);
    if (m->count == 0) {
        LAW(fe__ddot(n, n) == 0.0 || fe__absd(fe__ddot(n, n) - 1.0) <= 2e-6);
        LAW(fe__ddot(n, n) == 0.0 || gap_along(a, b, &f, n) >= (double)m->axis_separation - tolerance);
        return;
    }
    LAW(fe__absd(fe__ddot(n, n) - 1.0) <= 2e-6);
    for (int32_t i = 0; i < m->count; ++i) {
        double half = 0.5 * (double)m->points[i].separation;
        fe_dvec3 p = fe__widen(m->points[i].point);
        LAW(m->points[i].separation <= MARGIN);
        LAW(fe__absd(surface_distance(&core_a, fe__dsub(p, fe__dscale(half + (double)a->radius, n)))) <= tolerance);
        LAW(fe__absd(surface_distance(&core_b, into_b(&f, fe__dadd(p, fe__dscale(half + (double)b->radius, n))))) <=
            tolerance);
        for (int32_t k = 0; k < i; ++k) LAW(m->points[i].id != m->points[k].id);
    }
}

// A sphere has one answer: exact separation and normal.
static void check_exact(const truth *t, const fe__manifold *m)
{
    LAW((m->count == 1) == (t->separation <= (double)MARGIN) || fe__absd(t->separation - (double)MARGIN) <= ROUNDING);
    if (m->count == 0) return;
    LAW(fe__absd((double)deepest(m) - t->separation) <= ROUNDING);
    // the direction of a core `distance` away whose ends are rounded
    if (fe__absd(t->distance) > 1e-3)
        LAW(degrees_between(fe__widen(m->normal), t->normal) <= 60.0 * ROUNDING / fe__absd(t->distance));
}

static void pair_with_one_point(int32_t type_a, int32_t type_b)
{
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(type_a), b = random_form(type_b);
        fe__relative r = near_pose(&a, &b, 0.5);
        truth t = true_contact(&a, &b, &r);
        for (int32_t general = 0; general < 2; ++general) {
            fe__manifold m = collide(&a, &b, &r, general);
            check_exact(&t, &m);
            check_manifold(&a, &b, &r, &m, ROUNDING);
            assert_laws(&a, &b, &r, &m);
        }
    }
}

static void sphere_and_sphere_are_exact(void **state)
{
    (void)state;
    pair_with_one_point(FE__FORM_SPHERE, FE__FORM_SPHERE);
}

static void capsule_and_sphere_are_exact(void **state)
{
    (void)state;
    pair_with_one_point(FE__FORM_CAPSULE, FE__FORM_SPHERE);
}

static void box_and_sphere_are_exact(void **state)
{
    (void)state;
    pair_with_one_point(FE__FORM_BOX, FE__FORM_SPHERE);
}

// Two-point answers may trade a tie of separation and, on faces, a few degrees, for steadiness.
static void check_near(const truth *t, const fe__manifold *m, double degrees, double ties)
{
    double allowed = ties * TIE + ROUNDING;
    if (t->separation <= (double)MARGIN - allowed) LAW(m->count > 0);
    if (t->separation > (double)MARGIN + allowed) LAW(m->count == 0);
    if (m->count == 0) return;
    LAW(fe__absd((double)deepest(m) - t->separation) <= allowed);
    if (t->distance > 1e-3)
        LAW(degrees_between(fe__widen(m->normal), t->normal) <= degrees + 60.0 * ROUNDING / t->distance);
}

// Cores that overlap may have several ways out that are as short: what the normal must do is to lead out within a tie
// of the shortest.
static void check_way_out(const fe__form *a, const fe__form *b, const fe__relative *r, const truth *t,
                          const fe__manifold *m, double ties)
{
    if (t->distance > 0.0 || m->count == 0) return;
    frame f = frame_of(r);
    LAW(gap_along(a, b, &f, fe__widen(m->normal)) >= t->separation - ties * TIE - ROUNDING);
}

static float highest(const fe__manifold *m)
{
    float high = -INFINITY;
    for (int32_t i = 0; i < m->count; ++i) high = fe__maxf(high, m->points[i].separation);
    return high;
}

static void pair_with_many_points(int32_t type_a, int32_t type_b, double degrees, double ties)
{
    for (int32_t i = 0; i < 2 * POSES; ++i) {
        fe__form a = random_form(type_a), b = random_form(type_b);
        // every second time below the radius, so that cores do not meet
        fe__relative r = near_pose(&a, &b, i & 1 ? 0.5 : 0.5 * (double)b.radius + 0.02);
        truth t = true_contact(&a, &b, &r);
        for (int32_t general = 0; general < 2; ++general) {
            fe__manifold m = collide(&a, &b, &r, general);
            check_near(&t, &m, degrees, ties);
            check_way_out(&a, &b, &r, &t, &m, ties);
            // two points of an edge or a core and a core d away may lie aside by half of sqrt(2 n.d tie): there |d|
            // exceeds n . d by a tie
            double d = (double)(a.radius + b.radius) + (double)highest(&m),
                   aside = b.radius > 0.0f ? 0.5 * sqrt(2.0 * fe__maxd(d, 0.0) * TIE) : 0.0;
            // and where the cores are askew, by up to 11.5 degrees of d
            if (b.radius > 0.0f && m.axis > 0)
                aside = fe__maxd(aside, 0.5 * sin(11.5 * HALF_PI / 90.0) * fe__maxd(d, 0.0));
            check_manifold(&a, &b, &r, &m, ties * TIE + aside + ROUNDING);
            assert_laws(&a, &b, &r, &m);
        }
    }
}

static void capsule_and_capsule_are_exact_within_a_tie(void **state)
{
    (void)state;
    pair_with_many_points(FE__FORM_CAPSULE, FE__FORM_CAPSULE, 0.0, 1.0);
}

static void box_and_capsule_are_exact_within_a_tie(void **state)
{
    (void)state;
    pair_with_many_points(FE__FORM_BOX, FE__FORM_CAPSULE, FACE_DEGREES, 1.0);
}

// ---- box against box -----------------------------------------------------------------------------------------------
// Overlapping boxes: the exhaustive test of 15 axes on corners gives the depth; the kernel may prefer a face twice by a
// tie; edges side by side are less than 1.83 times as deep (facing_edges.c). Boxes apart have points exactly when their
// distance is within the margin, and none is nearer than the gap along the best axis.
static void check_boxes(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m)
{
    frame f = frame_of(r);
    double gap = brute_gap(a, b, &f), allowed = 2.0 * TIE + ROUNDING;
    if (gap <= 0.0) {
        LAW(m->count > 0);
        LAW((double)deepest(m) - gap <= allowed);
        LAW((double)deepest(m) >= (m->round ? 1.83 : 1.0) * gap - allowed);
        if (m->count == 0) return;
        // by as much along the normal as the deepest point says, and they are apart
        f.position = fe__dadd(f.position, fe__dscale(2.0 * allowed - (double)deepest(m), fe__widen(m->normal)));
        LAW(brute_gap(a, b, &f) >= -ROUNDING);
        return;
    }
    truth t = true_contact(a, b, r);
    LAW((m->count > 0) == (t.separation <= (double)MARGIN) || fe__absd(t.separation - (double)MARGIN) <= allowed);
    if (m->count > 0) LAW((double)deepest(m) >= gap - allowed);
}

static void box_and_box_are_exact_within_two_ties(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 2 * POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(FE__FORM_BOX);
        fe__relative r = near_pose(&a, &b, i & 1 ? 0.5 : 0.02);
        for (int32_t general = 0; general < 2; ++general) {
            fe__manifold m = collide(&a, &b, &r, general);
            check_boxes(&a, &b, &r, &m);
            // edges within two ties of the best axis need not cross: their nearest ends are further apart than the
            // depth
            check_manifold(&a, &b, &r, &m, 5.0 * TIE);
            assert_laws(&a, &b, &r, &m);
        }
    }
}

// A mirror changes no depth, and neither does who is called A.
static void mirrored_and_swapped_boxes_are_as_deep(void **state)
{
    (void)state;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(FE__FORM_BOX);
        fe__relative r = near_pose(&a, &b, 0.1), mirrored = r, swapped;
        mirrored.position.x = -r.position.x; // x -> -x on both sides of R
        mirrored.rotation.x = fe__vec3(r.rotation.x.x, -r.rotation.x.y, -r.rotation.x.z);
        mirrored.rotation.y.x = -r.rotation.y.x, mirrored.rotation.z.x = -r.rotation.z.x;
        swapped.position = fe__neg(fe__mul_transposed(&r.rotation, r.position));
        swapped.rotation = (fe__mat3){{r.rotation.x.x, r.rotation.y.x, r.rotation.z.x},
                                      {r.rotation.x.y, r.rotation.y.y, r.rotation.z.y},
                                      {r.rotation.x.z, r.rotation.y.z, r.rotation.z.z}};
        frame f = frame_of(&r);
        if (brute_gap(&a, &b, &f) > 0.0) continue; // apart, two answers may show different near misses
        fe__manifold m = collide(&a, &b, &r, 0), n = collide(&a, &b, &mirrored, 0), o = collide(&b, &a, &swapped, 0);
        LAW((double)fe__absf(deepest(&m) - deepest(&n)) <=
            0.1 * TIE + ROUNDING); // of more than four, points within that are one as good as another
        LAW((double)fe__absf(deepest(&m) - deepest(&o)) <= 2.0 * TIE + ROUNDING);
        if (m.axis == n.axis)
            LAW(fe__absf(m.normal.x + n.normal.x) <= 1e-5f && fe__absf(m.normal.y - n.normal.y) <= 1e-5f);
        assert_laws(&a, &b, &r, &m);
    }
}

// Cubes stacked by hand: jitter of 0.1 mrad and 0.1 mm. Always the face, and four points at the corners within the
// jitter.
static void a_face_on_a_face_has_its_four_corners(void **state)
{
    (void)state;
    const fe__form a = box(0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < POSES; ++i) {
        fe_dvec3 axis = random_direction();
        fe_vec3 jitter = random_vector(1e-4);
        fe__relative r = relative(jitter, turn_about(axis, uniform(0.0, 1e-4)));
        r.position.y += 0.9995f;
        fe__manifold m = collide(&a, &a, &r, 0);
        FE_TRUE(m.count == 4);
        FE_TRUE(m.normal.x == 0.0f && m.normal.y == 1.0f && m.normal.z == 0.0f);
        for (int32_t k = 0; k < 4; ++k) {
            const fe__manifold_point *p = &m.points[k];
            FE_NEAR(fe__absf(p->point.x), 0.5, 3e-4);
            FE_NEAR(fe__absf(p->point.z), 0.5, 3e-4);
            FE_NEAR(p->separation, -0.0005, 3e-4); // 0.1 mm, and 0.1 mrad times the arm of 0.7 m
            int32_t opposite = 0, other;
            for (other = 0; other < 4; ++other)
                opposite += m.points[other].point.x * p->point.x < 0.0f && m.points[other].point.z * p->point.z < 0.0f;
            FE_TRUE(opposite == 1);
        }
        FE_TRUE(m.axis == 1);
    }
}

// A small box on a large one, pushed about by micrometres: neither names nor their order change.
static void names_last_while_the_same_features_meet(void **state)
{
    (void)state;
    const fe__form ground = box(5.0f, 0.5f, 5.0f), small = box(0.3f, 0.2f, 0.1f);
    for (int32_t place = 0; place < 100; ++place) {
        fe_quat turn = turn_about((fe_dvec3){0.0, 1.0, 0.0}, uniform(-3.0, 3.0));
        fe_vec3 position = random_vector(4.0);
        position.y = 0.699f;
        fe__manifold first = {.axis = -1}, m;
        for (int32_t i = 0; i < 100; ++i) {
            fe_vec3 jitter = random_vector(1e-5);
            fe_dvec3 axis = random_direction();
            fe__relative r = relative(fe__add(position, jitter),
                                      fe__normalized(fe__product(turn_about(axis, uniform(0.0, 1e-5)), turn)));
            m = first;
            fe__collide(&ground, &small, &r, MARGIN, &m);
            FE_TRUE(m.count == 4);
            if (i == 0) first = m;
            for (int32_t k = 0; k < 4; ++k) FE_TRUE(m.points[k].id == first.points[k].id);
        }
    }
}

// The depth of a pair that moves by d changes by no more than d: no answer jumps by more than the ties it may trade.
static void depth_is_continuous(void **state)
{
    (void)state;
    const int32_t pairs[4][2] = {{FE__FORM_BOX, FE__FORM_BOX},
                                 {FE__FORM_BOX, FE__FORM_CAPSULE},
                                 {FE__FORM_CAPSULE, FE__FORM_CAPSULE},
                                 {FE__FORM_BOX, FE__FORM_SPHERE}};
    for (int32_t path = 0; path < 800; ++path) {
        fe__form a = random_form(pairs[path & 3][0]), b = random_form(pairs[path & 3][1]);
        fe__relative r = near_pose(&a, &b, 0.05);
        fe_dvec3 axis = random_direction();
        fe_vec3 velocity = random_vector(1.0);
        fe__manifold m = {.axis = -1};
        float before = 0.0f;
        const double step = 0.0005;
        for (int32_t i = 0; i < 100; ++i) {
            fe__mat3 turn = fe__matrix(turn_about(axis, step));
            r.position = fe__add_scaled(r.position, (float)step, velocity);
            r.rotation =
                (fe__mat3){fe__mul(&turn, r.rotation.x), fe__mul(&turn, r.rotation.y), fe__mul(&turn, r.rotation.z)};
            int32_t had = m.count;
            fe__collide(&a, &b, &r, MARGIN, &m);
            float now = deepest(&m);
            double moved = step * (sqrt(3.0) + (double)fe__form_reach(&b, fe__vec3(0.0f, 0.0f, 0.0f)));
            // a kept face may be as deep as ten ties before another axis is looked for
            if (had > 0 && m.count > 0 && (before < 0.0f || now < 0.0f))
                LAW((double)fe__absf(now - before) <= moved + 12.0 * TIE + ROUNDING);
            assert_laws(&a, &b, &r, &m);
            before = now;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_and_sphere_are_exact),
        cmocka_unit_test(capsule_and_sphere_are_exact),
        cmocka_unit_test(box_and_sphere_are_exact),
        cmocka_unit_test(capsule_and_capsule_are_exact_within_a_tie),
        cmocka_unit_test(box_and_capsule_are_exact_within_a_tie),
        cmocka_unit_test(box_and_box_are_exact_within_two_ties),
        cmocka_unit_test(mirrored_and_swapped_boxes_are_as_deep),
        cmocka_unit_test(a_face_on_a_face_has_its_four_corners),
        cmocka_unit_test(names_last_while_the_same_features_meet),
        cmocka_unit_test(depth_is_continuous),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
