// Cutting a face by another and keeping four points: two independent ways give one area, and four points keep most of
// it.
#include "fe_test.h"

#include "collision/form/clip.h"

#include "collision_cases.h"

#include <stdlib.h>
#include <string.h>

enum { CASES = 20000 };
#define SLACK 1e-5f

static fe_dvec3 middle;

static int by_angle(const void *a, const void *b)
{
    const fe__clip_vertex *p = a, *q = b;
    double x = atan2((double)p->v - middle.y, (double)p->u - middle.x),
           y = atan2((double)q->v - middle.y, (double)q->u - middle.x);
    return x < y ? -1 : x > y;
}

// Area of the vertices of a convex polygon, in any order; they are sorted.
static double area_of(fe__clip_vertex *p, int32_t count)
{
    middle = (fe_dvec3){0.0, 0.0, 0.0};
    for (int32_t i = 0; i < count; ++i) middle.x += (double)p[i].u / count, middle.y += (double)p[i].v / count;
    qsort(p, (size_t)count, sizeof p[0], by_angle);
    double twice = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        const fe__clip_vertex *q = &p[(i + 1) % count];
        twice += (double)p[i].u * (double)q->v - (double)p[i].v * (double)q->u;
    }
    return 0.5 * twice;
}

typedef struct faces {
    float half_u, half_v;
    fe__parallelogram incident;
    fe__clip_vertex rectangle[4], polygon[FE_CLIP_VERTICES];
} faces;

static faces random_faces(void)
{
    faces f;
    f.half_u = (float)uniform(0.1, 1.0), f.half_v = (float)uniform(0.1, 1.0);
    fe_vec3 centre = random_vector(0.7);
    double angle = uniform(-3.0, 3.0), x = uniform(0.1, 1.0), y = uniform(0.1, 1.0), skew = uniform(0.8, 1.0),
           rise = uniform(-0.05, 0.05);
    f.incident.centre = centre;
    f.incident.x = fe__vec3((float)(x * cos(angle)), (float)(x * sin(angle)), (float)(x * rise));
    f.incident.y = fe__vec3((float)(-y * sin(angle)), (float)(y * skew * cos(angle)), (float)(-y * rise));
    for (int32_t i = 0; i < 4; ++i) {
        float si = i == 1 || i == 2 ? 1.0f : -1.0f, sj = i >= 2 ? 1.0f : -1.0f;
        fe_vec3 p = fe__add_scaled(fe__add_scaled(f.incident.centre, si, f.incident.x), sj, f.incident.y);
        f.rectangle[i] = (fe__clip_vertex){si * f.half_u, sj * f.half_v, 0.0f, 0};
        f.polygon[i] = (fe__clip_vertex){p.x, p.y, p.z, fe__clip_id((i + 3) & 3, i)};
    }
    return f;
}

// Four edges side by side, and one vertex after the other, cut the same area out of the same faces. Both are widened by
// the slack or less: along 12 m of rims at most.
static void both_cuts_leave_the_same_area(void **state)
{
    (void)state;
    int32_t meeting = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        faces f = random_faces();
        fe__clip_vertex lanes[12];
        int32_t n = fe__clip_rectangle(&f.incident, f.half_u, f.half_v, SLACK, 1e30f, lanes);
        int32_t m = fe__clip_polygon(f.rectangle, 4, f.polygon, 4, SLACK);
        double a = n > 2 ? area_of(lanes, n) : 0.0, b = m > 2 ? area_of(f.polygon, m) : 0.0;
        FE_NEAR(a, b, 12.0 * (double)SLACK);
        meeting += a > 0.0;
        for (int32_t k = 0; k < n; ++k) {
            // on the incident face's plane: height is linear in u and v
            double det =
                (double)f.incident.x.x * (double)f.incident.y.y - (double)f.incident.x.y * (double)f.incident.y.x;
            double du = (double)(lanes[k].u - f.incident.centre.x), dv = (double)(lanes[k].v - f.incident.centre.y);
            double s = (du * (double)f.incident.y.y - dv * (double)f.incident.y.x) / det,
                   t = (dv * (double)f.incident.x.x - du * (double)f.incident.x.y) / det;
            FE_NEAR(lanes[k].height,
                    (double)f.incident.centre.z + s * (double)f.incident.x.z + t * (double)f.incident.y.z, 2e-6);
            FE_WITHIN(fe__absf(lanes[k].u), 0.0, f.half_u + 2.0f * SLACK);
            FE_WITHIN(fe__absf(lanes[k].v), 0.0, f.half_v + 2.0f * SLACK);
            for (int32_t j = 0; j < k; ++j) FE_TRUE(lanes[k].id != lanes[j].id);
        }
    }
    FE_TRUE(meeting > CASES / 4);
}

// Where all carry: the deepest point stays, within the tie, and so does at least half of the area (of a regular octagon
// four corners keep 0.71).
static void four_points_keep_the_deepest_and_most_of_the_area(void **state)
{
    (void)state;
    const float tie = 1e-4f;
    for (int32_t i = 0; i < CASES; ++i) {
        faces f = random_faces();
        f.incident.centre.z -= 2.0f;
        fe__clip_vertex all[12], four[12];
        int32_t n = fe__clip_rectangle(&f.incident, f.half_u, f.half_v, SLACK, 1e30f, all);
        if (n < 4) continue;
        memcpy(four, all, sizeof all);
        int32_t m = fe__reduce_to_four(four, n, tie, NULL, NULL);
        FE_WITHIN(m, 2, 4);
        float low = INFINITY, kept = INFINITY;
        for (int32_t k = 0; k < n; ++k) low = fe__minf(low, all[k].height);
        for (int32_t k = 0; k < m; ++k) kept = fe__minf(kept, four[k].height);
        FE_WITHIN(kept, low, low + tie);
        FE_WITHIN(area_of(four, m), 0.5 * area_of(all, n) - 12.0 * (double)tie, INFINITY);
    }
}

// Two vertices below the face side by side and four far off, clear of it: both are kept, whichever of them is deeper by
// a little.
static void what_carries_is_kept(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 100; ++i) {
        float first = (float)uniform(-0.002, -0.0005), second = (float)uniform(-0.002, -0.0005);
        fe__clip_vertex p[6] = {{-0.2f, -0.1f, first, 1},  {-0.2f, 0.1f, 0.005f, 2}, {-0.17f, -0.12f, second, 3},
                                {0.2f, -0.15f, 0.004f, 4}, {0.2f, 0.1f, 0.008f, 5},  {0.0f, 0.2f, 0.006f, 6}};
        int32_t count = fe__reduce_to_four(p, 6, 5e-5f, NULL, NULL), carry = 0;
        FE_TRUE(count == 4);
        for (int32_t k = 0; k < count; ++k) carry += p[k].height < 0.0f;
        FE_TRUE(carry == 2);
    }
}

// A line of two vertices keeps its part between the sides, a point stays when it is inside.
static void lines_and_points_are_cut_too(void **state)
{
    (void)state;
    const fe__clip_vertex square[4] = {{-1.0f, -1.0f, 0.0f, 0},
                                       {1.0f, -1.0f, 0.0f, 0},
                                       {1.0f, 1.0f, 0.0f, 0},
                                       {-1.0f, 1.0f, 0.0f, 0}};
    fe__clip_vertex line[FE_CLIP_VERTICES] = {{-2.0f, 0.5f, 0.0f, fe__clip_id(1, 0)},
                                              {2.0f, 0.5f, 4.0f, fe__clip_id(0, 1)}};
    FE_TRUE(fe__clip_polygon(square, 4, line, 2, 0.0f) == 2);
    FE_NEAR(fe__minf(line[0].u, line[1].u), -1.0, 1e-6);
    FE_NEAR(fe__maxf(line[0].u, line[1].u), 1.0, 1e-6);
    FE_NEAR(fe__minf(line[0].height, line[1].height), 1.0, 1e-6);
    FE_NEAR(fe__maxf(line[0].height, line[1].height), 3.0, 1e-6);
    fe__clip_vertex beside[FE_CLIP_VERTICES] = {{-2.0f, 1.5f, 0.0f, 0}, {2.0f, 1.5f, 0.0f, 0}};
    FE_TRUE(fe__clip_polygon(square, 4, beside, 2, 0.0f) == 0);
    fe__clip_vertex in[FE_CLIP_VERTICES] = {{0.5f, 0.5f, 0.0f, 0}}, out[FE_CLIP_VERTICES] = {{0.5f, 1.5f, 0.0f, 0}};
    FE_TRUE(fe__clip_polygon(square, 4, in, 1, 0.0f) == 1);
    FE_TRUE(fe__clip_polygon(square, 4, out, 1, 0.0f) == 0);
}

// A convex polygon that turns right about a random place, its heights on one plane
static int32_t random_polygon(fe__clip_vertex *p, const fe__disc *plane)
{
    int32_t count = 3 + (int32_t)uniform(0.0, 13.0);
    double size = exp(uniform(-3.0, 1.5)), u = uniform(-1.5, 1.5), v = uniform(-1.5, 1.5), first = uniform(0.0, 6.28);
    for (int32_t i = 0; i < count; ++i) {
        double angle = first - 2.0 * 3.14159265 * i / count;
        float x = (float)(u + size * cos(angle)), y = (float)(v + size * sin(angle));
        p[i] = (fe__clip_vertex){x, y, plane->height + plane->slope_u * x + plane->slope_v * y,
                                 fe__clip_id(i > 0 ? i - 1 : count - 1, i)};
    }
    return count;
}

// By how much a point is out of the polygon or the disc, whichever is more
static double out_of_both(double u, double v, const fe__disc *disc, const fe__clip_vertex *p, int32_t count)
{
    double most = sqrt(u * u + v * v) - (double)disc->radius;
    for (int32_t i = 0; i < count; ++i) {
        const fe__clip_vertex *a = &p[i], *b = &p[(i + 1) % count];
        double du = (double)b->u - (double)a->u, dv = (double)b->v - (double)a->v;
        double beyond = (du * (v - (double)a->v) - dv * (u - (double)a->u)) / sqrt(du * du + dv * dv);
        most = fmax(most, beyond);
    }
    return most;
}

// What is cut lies in both, on the polygon's plane, and reaches as far as both do, but for what a rim reaches out
// between two of its points: 1 - cos of half the angle between them, of its radius. Those of an aimed rim are up to
// (180 - 6) / 7 = 24.9 degrees apart. A disc that lies wholly over the polygon leaves four points, up to 90 degrees
// apart, of an aimed rim 124.3.
static void a_disc_cuts_what_both_have(void **state)
{
    (void)state;
    const double degree = 3.14159265 / 180.0, half[2][2] = {{11.25 * degree, 45.0 * degree}, // of all, of four
                                                            {12.43 * degree, 62.15 * degree}};
    int32_t whole[2] = {0, 0};
    for (int32_t k = 0; k < CASES / 10; ++k) {
        int32_t aimed = k & 1, low = aimed ? 0 : 3, name = FE_CLIP_SIDE + (aimed ? FE_RIM_POINTS : low);
        fe__disc disc = {.radius = 1.0f,
                         .height = 0.1f,
                         .slope_u = (float)uniform(-0.01, 0.01),
                         .slope_v = (float)uniform(-0.01, 0.01),
                         .low = low,
                         .pattern = aimed ? FE_RIM_AIMED : FE_RIM_LIES};
        fe__clip_vertex polygon[FE_FACE_VERTICES], cut[FE_DISC_VERTICES];
        int32_t count = random_polygon(polygon, &disc), left = fe__clip_disc(&disc, polygon, count, SLACK, 1.0f, cut);
        FE_TRUE(left <= FE_DISC_VERTICES);
        for (int32_t i = 0; i < left; ++i) {
            FE_TRUE(out_of_both((double)cut[i].u, (double)cut[i].v, &disc, polygon, count) < 3e-5);
            float height = disc.height + disc.slope_u * cut[i].u + disc.slope_v * cut[i].v;
            FE_NEAR((double)cut[i].height, (double)height, 1e-5);
        }
        whole[aimed] += left == 4 && cut[0].id == fe__clip_id(name, name);
        double reach = cos(half[aimed][left == 4]), angle = uniform(0.0, 6.28), du = cos(angle), dv = sin(angle),
               most = -9.0;
        for (int32_t i = 0; i < left; ++i) most = fmax(most, du * (double)cut[i].u + dv * (double)cut[i].v);
        for (int32_t i = 0; i < 100; ++i) {
            double u = uniform(-1.0, 1.0), v = uniform(-1.0, 1.0), along = du * u + dv * v;
            if (out_of_both(u, v, &disc, polygon, count) < 0.0) FE_TRUE(along <= most + 1.0 - reach + 1e-5);
        }
    }
    FE_TRUE(whole[0] > 5 && whole[1] > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_cuts_leave_the_same_area),
        cmocka_unit_test(four_points_keep_the_deepest_and_most_of_the_area),
        cmocka_unit_test(what_carries_is_kept),
        cmocka_unit_test(lines_and_points_are_cut_too),
        cmocka_unit_test(a_disc_cuts_what_both_have),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
