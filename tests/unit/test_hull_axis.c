// The axis of least overlap of two hulls, against the definition: of all directions n the greatest of
// min over B of n . x - max over A of n . x.
#include "collision/manifold/hull_hull.h"
#include "fe_test.h"

#include <float.h>
#include "support/hull_clouds.h"
#include "support/hull_make.h"

enum { PAIRS = 2000, DIRECTIONS = 300 };

// n in A's frame, in double
static double apart_along(const fe__hull *a, const fe__hull *b, const fe__relative *r, fe_dvec3 n)
{
    fe_dvec3 in_b = {fe__ddot(fe__widen(r->rotation.x), n), fe__ddot(fe__widen(r->rotation.y), n),
                     fe__ddot(fe__widen(r->rotation.z), n)};
    fe_dvec3 most = fe__widen(fe__hull_vertex(a, fe__hull_support(a, n))),
             least = fe__widen(fe__hull_vertex(b, fe__hull_support(b, fe__dscale(-1.0, in_b))));
    return fe__ddot(in_b, least) + fe__ddot(n, fe__widen(r->position)) - fe__ddot(n, most);
}

static int32_t make_round(uint64_t *random, made_hull *made)
{
    float points[40][3];
    int32_t count = 4 + cloud_int(random, 37);
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 v = cloud_int(random, 2) ? cloud_direction(random) : cloud_on_box(random);
        points[i][0] = (float)v.x, points[i][1] = (float)v.y, points[i][2] = (float)v.z;
    }
    return make_hull(&points[0][0], count, 64, 0.0, made) && made->hull.inner_radius > 0.05f;
}

static fe__relative some_pose(uint64_t *random, double reach)
{
    fe_dvec3 axis = cloud_vector(random), at = fe__dscale(reach, cloud_vector(random));
    fe_quat q = fe__normalized((fe_quat){(float)axis.x, (float)axis.y, (float)axis.z, (float)cloud_unit(random)});
    return (fe__relative){fe__narrow(at), fe__matrix(q)};
}

static fe__hull_axis best_axis(const fe__hull *a, const fe__hull *b, const fe__relative *r)
{
    fe__hull_axis best = fe__hull_axis_of_faces_a(a, b, r), face_b = fe__hull_axis_of_faces_b(a, b, r),
                  edges = fe__hull_axis_of_edges(a, b, r, -FLT_MAX, 0, 0);
    if (face_b.separation > best.separation) best = face_b;
    return edges.separation > best.separation ? edges : best;
}

// Floats of lengths up to 4 m, a product of three sums: 4e-6 m. Edges that are left out as parallel are 0.005 rad from
// a face's normal at most, over 2 m: 0.01 m deep at most where the overlap is so; here 1 mm is given
static void no_direction_separates_more(void **state)
{
    (void)state;
    const double rounding = 4e-6, left_out = 1e-3;
    int32_t kinds[3] = {0, 0, 0};
    uint64_t random = 17;
    for (int32_t i = 0; i < PAIRS;) {
        made_hull a = {0}, b = {0};
        if (make_round(&random, &a) && make_round(&random, &b)) {
            fe__relative r = some_pose(&random, 1.5);
            fe__hull_axis axis = best_axis(&a.hull, &b.hull, &r);
            double along = apart_along(&a.hull, &b.hull, &r, fe__widen(axis.normal));
            FE_NEAR(fe__dot(axis.normal, axis.normal), 1.0, 1e-5);
            FE_NEAR(along, axis.separation, rounding);
            kinds[axis.kind] += 1;
            for (int32_t k = 0; k < DIRECTIONS && axis.separation < 0.0f; ++k) {
                fe_dvec3 near = fe__dadd(fe__widen(axis.normal), fe__dscale(0.1, cloud_vector(&random)));
                fe_dvec3 n = k % 2 ? cloud_direction(&random) : fe__dscale(1.0 / sqrt(fe__ddot(near, near)), near);
                FE_TRUE(apart_along(&a.hull, &b.hull, &r, n) <= (double)axis.separation + rounding + left_out);
            }
            i += 1;
        }
        free_hull(&a), free_hull(&b);
    }
    FE_TRUE(kinds[0] > PAIRS / 20 && kinds[1] > PAIRS / 20 && kinds[2] > PAIRS / 20);
}

// Edges may be left out that separate by no more than is known: what is more than that is found all the same, bit by
// bit, by whichever vertices it is asked for.
static void edges_that_separate_more_are_found(void **state)
{
    (void)state;
    int32_t found = 0;
    uint64_t random = 23;
    for (int32_t i = 0; i < PAIRS; ++i) {
        made_hull a = {0}, b = {0};
        if (make_round(&random, &a) && make_round(&random, &b)) {
            fe__relative r = some_pose(&random, 1.5);
            fe__hull_axis face_a = fe__hull_axis_of_faces_a(&a.hull, &b.hull, &r),
                          face_b = fe__hull_axis_of_faces_b(&a.hull, &b.hull, &r),
                          all = fe__hull_axis_of_edges(&a.hull, &b.hull, &r, -FLT_MAX, 0, 0);
            float least = fe__maxf(face_a.separation, face_b.separation);
            int32_t vertex_a = i % 2 ? face_b.a : i % a.hull.vertex_count,
                    vertex_b = i % 2 ? face_a.b : i % b.hull.vertex_count;
            fe__hull_axis some = fe__hull_axis_of_edges(&a.hull, &b.hull, &r, least, vertex_a, vertex_b);
            FE_TRUE(some.separation <= all.separation);
            if (all.separation > least) {
                FE_TRUE(some.separation == all.separation && some.a == all.a && some.b == all.b);
                found += 1;
            }
        }
        free_hull(&a), free_hull(&b);
    }
    FE_TRUE(found > PAIRS / 20);
}

// Of all faces of A, each against all vertices of B: the first of those that separate most
static int32_t first_best_face(const fe__hull *a, const fe__hull *b, const fe__relative *r, float *out_separation)
{
    int32_t best = 0;
    *out_separation = -FLT_MAX;
    for (int32_t f = 0; f < a->face_count; ++f) {
        fe_vec3 n = fe__hull_normal(a, f), in_b = fe__mul_transposed(&r->rotation, n);
        float least = FLT_MAX;
        for (int32_t v = 0; v < b->vertex_count; ++v) least = fe__minf(fe__dot(in_b, fe__hull_vertex(b, v)), least);
        float separation = least + (fe__dot(n, r->position) - a->distances[f]);
        if (separation > *out_separation) *out_separation = separation, best = f;
    }
    return best;
}

// Faces may be left out that a vertex shows to be no better: the same sums of floats decide, so that the answer is that
// of all faces bit by bit, near and 1000 m off, where the sums are rough.
static void faces_left_out_change_no_bit(void **state)
{
    (void)state;
    uint64_t random = 29;
    for (int32_t i = 0; i < PAIRS; ++i) {
        made_hull a = {0}, b = {0};
        if (make_round(&random, &a) && make_round(&random, &b)) {
            fe__relative r = some_pose(&random, i % 4 ? 1.5 : 1000.0);
            float separation;
            int32_t face = first_best_face(&a.hull, &b.hull, &r, &separation);
            fe__hull_axis found = fe__hull_axis_of_faces_a(&a.hull, &b.hull, &r);
            FE_TRUE(found.separation == separation && found.a == face);
        }
        free_hull(&a), free_hull(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_direction_separates_more),
                                       cmocka_unit_test(edges_that_separate_more_are_found),
                                       cmocka_unit_test(faces_left_out_change_no_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
