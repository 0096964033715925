// The narrow phase: every pair of forms against the distance and depth of their cores in double, and the laws of manifolds.
#include "fe_test.h"

#include "collision/collide.h"
#include "collision/epa.h"
#include "collision/gjk.h"

#include "collision_cases.h"

enum { POSES = 20000 };
#define MARGIN 0.02f
// Forms of up to 1 m half width lie up to 4 m apart: float rounds by 2.4e-7 there, and some ten roundings add up.
#define ROUNDING 3e-6
// Of two answers as deep as each other within this the steadier is given (kernels.h); the box kernel chooses twice, face of A before face
// of B before edge.
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
    fe__cores cores = {a, b, f.position, f.x, f.y, f.z};
    fe__gjk g;
    fe__gjk_distance(&cores, 1e30, &g);
    double radii = (double)a->radius + (double)b->radius;
    if (!g.overlap) return (truth){g.distance - radii, g.distance, fe__dscale(1.0 / g.distance, fe__dsub(g.on_b, g.on_a))};
    fe__penetration p = fe__epa_depth(&cores, &g);
    return (truth){-p.depth - radii, -p.depth, p.normal};
}

// A pose at which B is about to touch A or overlaps it by up to `depth`: in one case of three turned as A or by a quarter, but for a
// milliradian.
static fe__relative near_pose(const fe__form *a, const fe__form *b, double depth)
{
    fe_quat rotation = random_rotation();
    fe_dvec3 n = random_direction();
    if (uniform(0.0, 3.0) < 1.0) {
        fe_dvec3 quarter = uniform(0.0, 1.0) < 0.5 ? (fe_dvec3){1.0, 0.0, 0.0} : (fe_dvec3){0.0, 0.0, 1.0};
        rotation = uniform(0.0, 1.0) < 0.5 ? fe__identity() : turn_about(quarter, HALF_PI);
        rotation = fe__normalized(fe__product(turn_about(random_direction(), uniform(0.0, 1e-3)), rotation));
        n = (fe_dvec3){0.0, 0.0, 0.0};
        *(uniform(0.0, 1.0) < 0.3 ? &n.x : uniform(0.0, 1.0) < 0.5 ? &n.y : &n.z) = 1.0;
    }
    fe__relative r = relative(random_vector(0.5), rotation);
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
    if (a->type != FE_GEOMETRY_PLANE) {
        truth t = true_contact(a, b, r);
        printf("  truth: separation %.9g core distance %.9g normal %.9g %.9g %.9g\n", t.separation, t.distance, t.normal.x, t.normal.y,
               t.normal.z);
    }
    printf("  found: normal %.9g %.9g %.9g axis %d\n", (double)m->normal.x, (double)m->normal.y, (double)m->normal.z, m->axis);
    for (int32_t i = 0; i < m->count; ++i) {
        const fe__manifold_point *p = &m->points[i];
        printf("  point %.9g %.9g %.9g separation %.9g id %x\n", (double)p->point.x, (double)p->point.y, (double)p->point.z,
               (double)p->separation, p->id);
    }
    print_error("%s\n", failure);
    failure = NULL;
    fail();
}

// What every manifold obeys: a unit normal, points with names of their own, none beyond the margin, each midway between two points of the
// surfaces, which are a radius out from the cores along the normal.
static void check_manifold(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m, double tolerance)
{
    frame f = frame_of(r);
    fe_dvec3 n = fe__widen(m->normal);
    fe__form core_a = *a, core_b = *b;
    core_a.radius = core_b.radius = 0.0f;
    LAW(m->count >= 0 && m->count <= FE_MAX_POINTS);
    if (m->count == 0) {
        LAW(fe__ddot(n, n) == 0.0);
        return;
    }
    LAW(fe__absd(fe__ddot(n, n) - 1.0) <= 2e-6);
    for (int32_t i = 0; i < m->count; ++i) {
        double half = 0.5 * (double)m->points[i].separation;
        fe_dvec3 p = fe__widen(m->points[i].point);
        LAW(m->points[i].separation <= MARGIN);
        LAW(fe__absd(surface_distance(&core_a, fe__dsub(p, fe__dscale(half + (double)a->radius, n)))) <= tolerance);
        LAW(fe__absd(surface_distance(&core_b, into_b(&f, fe__dadd(p, fe__dscale(half + (double)b->radius, n))))) <= tolerance);
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
    if (fe__absd(t->distance) > 1e-3) LAW(degrees_between(fe__widen(m->normal), t->normal) <= 60.0 * ROUNDING / fe__absd(t->distance));
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
    pair_with_one_point(FE_GEOMETRY_SPHERE, FE_GEOMETRY_SPHERE);
}

static void capsule_and_sphere_are_exact(void **state)
{
    (void)state;
    pair_with_one_point(FE_GEOMETRY_CAPSULE, FE_GEOMETRY_SPHERE);
}

static void box_and_sphere_are_exact(void **state)
{
    (void)state;
    pair_with_one_point(FE_GEOMETRY_BOX, FE_GEOMETRY_SPHERE);
}

// Two-point answers may trade a tie of separation and, on faces, a few degrees, for steadiness.
static void check_near(const truth *t, const fe__manifold *m, double degrees, double ties)
{
    double allowed = ties * TIE + ROUNDING;
    if (t->separation <= (double)MARGIN - allowed) LAW(m->count > 0);
    if (t->separation > (double)MARGIN + allowed) LAW(m->count == 0);
    if (m->count == 0) return;
    LAW(fe__absd((double)deepest(m) - t->separation) <= allowed);
    if (t->distance > 1e-3) LAW(degrees_between(fe__widen(m->normal), t->normal) <= degrees + 60.0 * ROUNDING / t->distance);
}

// Cores that overlap may have several ways out that are as short: what the normal must do is to lead out within a tie of the shortest.
static void check_way_out(const fe__form *a, const fe__form *b, const fe__relative *r, const truth *t, const fe__manifold *m, double ties)
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
            // two points of an edge or a core and a core d away may lie aside by half of sqrt(2 n.d tie): there |d| exceeds n . d by a tie
            double d = (double)(a.radius + b.radius) + (double)highest(&m),
                   aside = b.radius > 0.0f ? 0.5 * sqrt(2.0 * fe__maxd(d, 0.0) * TIE) : 0.0;
            check_manifold(&a, &b, &r, &m, ties * TIE + aside + ROUNDING);
            assert_laws(&a, &b, &r, &m);
        }
    }
}

static void capsule_and_capsule_are_exact_within_a_tie(void **state)
{
    (void)state;
    pair_with_many_points(FE_GEOMETRY_CAPSULE, FE_GEOMETRY_CAPSULE, 0.0, 1.0);
}

static void box_and_capsule_are_exact_within_a_tie(void **state)
{
    (void)state;
    pair_with_many_points(FE_GEOMETRY_BOX, FE_GEOMETRY_CAPSULE, FACE_DEGREES, 1.0);
}

// ---- box against box ------------------------------------------------------------------------------------------------------------
// Overlapping boxes: the exhaustive test of 15 axes on corners gives the depth; the kernel may prefer a face twice by a tie. Boxes apart
// have points exactly when their distance is within the margin, and none is nearer than the gap along the best axis.
static void check_boxes(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m)
{
    frame f = frame_of(r);
    double gap = brute_gap(a, b, &f), allowed = 2.0 * TIE + ROUNDING;
    if (gap <= 0.0) {
        LAW(m->count > 0);
        LAW(fe__absd((double)deepest(m) - gap) <= allowed);
        if (m->count > 0) LAW(gap_along(a, b, &f, fe__widen(m->normal)) >= gap - allowed);
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
        fe__form a = random_form(FE_GEOMETRY_BOX), b = random_form(FE_GEOMETRY_BOX);
        fe__relative r = near_pose(&a, &b, i & 1 ? 0.5 : 0.02);
        for (int32_t general = 0; general < 2; ++general) {
            fe__manifold m = collide(&a, &b, &r, general);
            check_boxes(&a, &b, &r, &m);
            // edges within two ties of the best axis need not cross: their nearest ends are further apart than the depth
            check_manifold(&a, &b, &r, &m, 5.0 * TIE);
            assert_laws(&a, &b, &r, &m);
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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
