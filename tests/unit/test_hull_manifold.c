// Points of a hull and a hull, box, ball or capsule: the deepest is among them, they are as deep as the overlap is, and
// their names differ.
#include "collision/form/gjk.h"
#include "collision/form/hull.h"
#include "collision/manifold/collide.h"
#include "collision/manifold/hull_hull.h"
#include "fe_test.h"
#include "support/hull_clouds.h"
#include "support/hull_make.h"

#include <math.h>

enum { PAIRS = 3000 };
static const float margin = 0.02f;

static int32_t make_rock(uint64_t *random, made_hull *made)
{
    float points[40][3];
    int32_t count = 4 + cloud_int(random, 37);
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 v = cloud_direction(random);
        points[i][0] = (float)v.x, points[i][1] = (float)v.y, points[i][2] = (float)v.z;
    }
    return make_hull(&points[0][0], count, 64, 0.0, made) && made->hull.inner_radius > 0.1f;
}

// Distance of the two, below 0 their depth, m
static double apart(const fe__form *a, const fe__form *b, const fe__relative *r)
{
    fe__cores cores = {
        a,   b, fe__widen(r->position), fe__widen(r->rotation.x), fe__widen(r->rotation.y), fe__widen(r->rotation.z),
        NULL};
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)INFINITY, &gjk);
    double radii = (double)a->radius + (double)b->radius;
    return (gjk.overlap ? -fe__epa_depth(&cores, &gjk).depth : gjk.distance) - radii;
}

static double deepest_of(const fe__manifold *m)
{
    double deepest = INFINITY;
    for (int32_t i = 0; i < m->count; ++i) deepest = fmin(deepest, (double)m->points[i].separation);
    return deepest;
}

// B along a direction, until both are as far apart as is wanted
static fe__relative near_pose(uint64_t *random, const fe__form *a, const fe__form *b, double wanted)
{
    fe_dvec3 axis = cloud_vector(random), way = cloud_direction(random);
    fe_quat q = fe__normalized((fe_quat){(float)axis.x, (float)axis.y, (float)axis.z, (float)cloud_unit(random)});
    double low = 0.0, high = 6.0;
    fe__relative r = {{0.0f, 0.0f, 0.0f}, fe__matrix(q)};
    for (int32_t i = 0; i < 40; ++i) {
        double middle = 0.5 * (low + high);
        r.position = fe__narrow(fe__dscale(middle, way));
        if (apart(a, b, &r) < wanted)
            low = middle;
        else
            high = middle;
    }
    return r;
}

static void the_deepest_point_is_among_them(void **state)
{
    (void)state;
    const double rounding = 1e-5, tie = 0.0005, parallel = 2e-3; // see hull_hull.c: left out, of edges 2 m long
    uint64_t random = 31;
    int32_t missed = 0;
    for (int32_t i = 0; i < PAIRS;) {
        made_hull a = {0}, b = {0};
        if (make_rock(&random, &a) && make_rock(&random, &b)) {
            fe__form first = fe__hull_form(&a.hull, 0), second = fe__hull_form(&b.hull, 1),
                     box = {.type = FE__FORM_BOX, .half = {0.3f, 0.6f, 0.9f}},
                     ball = {.type = FE__FORM_SPHERE, .radius = 0.4f},
                     pill = {.type = FE__FORM_CAPSULE, .radius = 0.3f, .half_height = 0.5f};
            const fe__form *others[] = {&second, &box, &ball, &pill, &second}, *other = others[i % 5];
            double wanted = 0.02 * cloud_unit(&random);
            fe__relative r = near_pose(&random, &first, other, wanted);
            double truth = apart(&first, other, &r);
            fe__manifold m = {.axis = -1};
            fe__collide(&first, other, &r, margin, &m);
            if (truth < (double)margin - rounding) {
                FE_WITHIN(m.count, 1, 4);
                double found = deepest_of(&m);
                FE_NEAR(fe__dot(m.normal, m.normal), 1.0, rounding);
                FE_TRUE(found >= truth - (truth < 0 ? tie + parallel : 2 * tie) - rounding);
                missed += found > truth + 2 * tie;
                for (int32_t p = 0; p < m.count; ++p)
                    for (int32_t q = 0; q < p; ++q) FE_TRUE(m.points[p].id != m.points[q].id);
            }
            ++i;
        }
        free_hull(&a), free_hull(&b);
    }
    FE_NEAR(missed, 0, 0);
}

static void a_face_has_the_farthest_vertex(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int32_t i = 0; i < PAIRS; ++i) {
        made_hull a = {0};
        if (make_rock(&random, &a)) {
            fe__form form = fe__hull_form(&a.hull, 0);
            fe_dvec3 direction = cloud_direction(&random), far = fe__form_support(&form, direction);
            fe__face face;
            fe__form_face(&form, fe__narrow(direction), &face);
            double most = -INFINITY;
            for (int32_t k = 0; k < face.count; ++k) most = fmax(most, fe__ddot(direction, fe__widen(face.vertex[k])));
            FE_NEAR(most, fe__ddot(direction, far), 1e-6);
        }
        free_hull(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_deepest_point_is_among_them),
                                       cmocka_unit_test(a_face_has_the_farthest_vertex)};
    return cmocka_run_group_tests_name("hull manifolds", tests, NULL, NULL);
}
