// Heightfields: their triangles, the walk over those near a box, the ray. The reference looks at every triangle of a
// small field.
#include "fe_test.h"

#include "collision/cast/cast_kinds.h"
#include "collision/form/gjk.h"
#include "collision/form/heightfield.h"
#include "collision_cases.h"

#include <float.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { CASES = 2000 };
#else
enum { CASES = 20000 };
#endif
enum { ROWS = 9, COLUMNS = 7, CELLS = (ROWS - 1) * (COLUMNS - 1), TRIANGLES = 2 * CELLS };

typedef struct field {
    fe__heightfield record;
    float heights[ROWS * COLUMNS];
    uint8_t cells[CELLS];
} field;

// steep, with a hole in every eighth cell or so
static void random_field(field *f)
{
    f->record =
        (fe__heightfield){.rows = ROWS, .columns = COLUMNS, .cell_x = uniform(0.2, 3.0), .cell_z = uniform(0.2, 3.0)};
    f->record.heights = f->heights, f->record.cells = uniform(0.0, 1.0) < 0.5 ? f->cells : NULL;
    f->record.low = FLT_MAX, f->record.high = -FLT_MAX;
    double size = uniform(0.0, 1.0) < 0.2 ? 0.0 : 2.0;
    for (int32_t i = 0; i < ROWS * COLUMNS; ++i) {
        f->heights[i] = (float)uniform(-size, size);
        f->record.low = fe__minf(f->record.low, f->heights[i]),
        f->record.high = fe__maxf(f->record.high, f->heights[i]);
    }
    for (int32_t i = 0; i < CELLS; ++i) f->cells[i] = uniform(0.0, 1.0) < 0.125 ? FE__CELL_HOLE : 0;
}

static int32_t is_hole(const field *f, int32_t triangle)
{
    return f->record.cells && f->cells[triangle / 2] == FE__CELL_HOLE;
}

static fe_dvec3 point_near(const field *f, double beyond)
{
    double x = uniform(-beyond, (COLUMNS - 1) * f->record.cell_x + beyond);
    double y = uniform(-2.0 - beyond, 2.0 + beyond);
    double z = uniform(-beyond, (ROWS - 1) * f->record.cell_z + beyond);
    return (fe_dvec3){x, y, z};
}

// The two triangles of each cell share the diagonal, look up, and cover the cell.
static void triangles_tile_the_grid(void **state)
{
    (void)state;
    field f;
    random_field(&f);
    fe_dvec3 none = {0.0, 0.0, 0.0};
    double area = 0.0;
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        fe__form t = fe__heightfield_triangle(&f.record, i, none);
        FE_TRUE(t.type == FE__FORM_TRIANGLE && t.radius == 0.0f);
        fe_dvec3 n = fe__dcross(fe__dsub(fe__widen(t.vertex[1]), fe__widen(t.vertex[0])),
                                fe__dsub(fe__widen(t.vertex[2]), fe__widen(t.vertex[0])));
        FE_TRUE(n.y > 0.0);
        area += 0.5 * n.y;
        n = fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n);
        fe_dvec3 normal = fe__heightfield_normal(&f.record, i);
        FE_NEAR(fe__ddot(n, normal), 1.0, 1e-6);
        fe__form other = fe__heightfield_triangle(&f.record, i ^ 1, none);
        FE_TRUE(fe__length(fe__sub(t.vertex[0], other.vertex[0])) == 0.0f);
        FE_TRUE(fe__length(fe__sub(t.vertex[i & 1 ? 1 : 2], other.vertex[i & 1 ? 2 : 1])) == 0.0f);
    }
    FE_NEAR(area, (ROWS - 1) * f.record.cell_z * (COLUMNS - 1) * f.record.cell_x, 1e-5 * area);
}

// Every triangle whose bounds meet the box is handed out, once, in order; none that is a hole.
static void walk_hands_out_what_meets_the_box(void **state)
{
    (void)state;
    for (int32_t c = 0; c < CASES / 20; ++c) {
        field f;
        random_field(&f);
        fe_dvec3 centre = point_near(&f, 3.0), half = {uniform(0.0, 2.0), uniform(0.0, 2.0), uniform(0.0, 2.0)};
        fe__bounds box = {fe__dsub(centre, half), fe__dadd(centre, half)};
        fe__triangle_walk walk = fe__heightfield_walk(&f.record, &box, centre);
        fe__form triangle;
        fe__pose pose = {centre, fe__identity()};
        int32_t last = -1, seen[TRIANGLES] = {0};
        for (int32_t i; (i = fe__next_triangle(&walk, &triangle)) >= 0; last = i) {
            FE_TRUE(i > last && i < TRIANGLES && !is_hole(&f, i));
            fe__form same = fe__heightfield_triangle(&f.record, i, centre);
            for (int32_t k = 0; k < 3; ++k) FE_TRUE(fe__length(fe__sub(same.vertex[k], triangle.vertex[k])) == 0.0f);
            seen[i] = 1;
        }
        for (int32_t i = 0; i < TRIANGLES; ++i) {
            fe__form t = fe__heightfield_triangle(&f.record, i, centre);
            fe__bounds b = fe__form_bounds(&t, &pose);
            int32_t apart = b.low.x > box.high.x || b.high.x < box.low.x || b.low.y > box.high.y ||
                            b.high.y < box.low.y || b.low.z > box.high.z || b.high.z < box.low.z;
            FE_TRUE(seen[i] || apart || is_hole(&f, i));
        }
    }
}

static int32_t nearest_triangle(const field *f, fe_dvec3 origin, fe_dvec3 way, fe__ray_hit *best)
{
    fe_dvec3 base = fe__dadd(origin, fe__dscale(0.5, way)); // floats near the ray
    int32_t found = 0;
    best->t = 1.0;
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        fe__form t = fe__heightfield_triangle(&f->record, i, base);
        fe__ray_hit hit;
        if (is_hole(f, i) || !fe__form_ray(&t, fe__dsub(origin, base), way, best->t, &hit)) continue;
        *best = hit, best->triangle = i, found = 1;
    }
    return found;
}

// The vertices of the reference's triangles are floats, a few 1e-7 m off. Where they disagree on hit or miss, the ray
// passes an edge within that.
static void rays_meet_the_nearest_triangle(void **state)
{
    (void)state;
    int32_t hits = 0, doubtful = 0;
    for (int32_t c = 0; c < CASES; ++c) {
        field f;
        random_field(&f);
        fe_dvec3 origin = point_near(&f, 4.0), target = point_near(&f, 0.0),
                 way = fe__dscale(1.5, fe__dsub(target, origin));
        if (c % 8 == 0) way.x = 0.0;
        if (c % 8 == 1) way.z = 0.0;
        if (c % 8 == 2) way.x = way.z = 0.0;
        if (c % 8 == 3) origin = target;
        fe__ray_hit hit, expected;
        int32_t found = fe__heightfield_ray(&f.record, origin, way, 1.0, &hit),
                should = nearest_triangle(&f, origin, way, &expected);
        double length = sqrt(fe__ddot(way, way));
        if (found != should || (found && fe__absd(hit.t - expected.t) * length > 1e-4)) {
            ++doubtful;
            continue;
        }
        if (!found) continue;
        ++hits;
        FE_TRUE(!hit.inside && hit.depth == 0.0 && fe__ddot(hit.normal, way) <= 0.0);
        if (hit.triangle == expected.triangle) FE_NEAR(fe__ddot(hit.normal, expected.normal), 1.0, 1e-5);
    }
    FE_TRUE(hits > CASES / 4);
    FE_WITHIN(doubtful, 0, CASES / 1000);
}

// Straight down on samples, edges and diagonals, or slanting to a millimetre below them: nothing slips through where
// there is no hole.
static void no_ray_slips_through_an_edge(void **state)
{
    (void)state;
    for (int32_t c = 0; c < CASES; ++c) {
        field f;
        random_field(&f);
        f.record.cells = NULL;
        double column = (double)(int32_t)uniform(0.0, COLUMNS), row = (double)(int32_t)uniform(0.0, ROWS),
               along = uniform(0.0, 1.0);
        if (c & 1) column = fe__mind(column + along, COLUMNS - 1);
        if (c & 2) row = fe__mind(row + along, ROWS - 1);
        fe_dvec3 above = {column * f.record.cell_x, 50.0, row * f.record.cell_z}, origin = point_near(&f, 0.0);
        fe__ray_hit hit;
        FE_TRUE(fe__heightfield_ray(&f.record, above, (fe_dvec3){0.0, -100.0, 0.0}, 1.0, &hit));
        fe_dvec3 below = {above.x, 50.0 - 100.0 * hit.t - 1e-3, above.z};
        origin.y = 50.0;
        if (c & 4) origin.x = below.x;
        if (c & 8) origin.z = below.z;
        FE_TRUE(fe__heightfield_ray(&f.record, origin, fe__dsub(below, origin), 1.0, &hit));
    }
}

// Only the top side: a ray from below goes on, and one that starts below hits nothing on its way out.
static void rays_from_below_miss(void **state)
{
    (void)state;
    for (int32_t c = 0; c < CASES / 10; ++c) {
        field f;
        random_field(&f);
        fe_dvec3 origin = point_near(&f, 0.0);
        origin.y = -3.0;
        fe__ray_hit hit;
        FE_TRUE(!fe__heightfield_ray(&f.record, origin, (fe_dvec3){0.0, 6.0, 0.0}, 1.0, &hit));
        FE_TRUE(!fe__heightfield_ray(&f.record, origin, (fe_dvec3){0.0, 0.0, 0.0}, 1.0, &hit));
    }
}

// Any finite ray gives an answer without NaN.
static void extreme_rays_are_answered(void **state)
{
    (void)state;
    field f;
    random_field(&f);
    f.record.cells = NULL;
    const double sizes[] = {0.0, 5e-324, 1e-300, 1e-10, 1.0, 1e7, 1e150, 1e300, DBL_MAX};
    enum { SIZES = sizeof sizes / sizeof *sizes };
    for (int32_t i = 0; i < SIZES * SIZES * SIZES * SIZES; ++i) {
        fe_dvec3 origin = {sizes[i % SIZES], sizes[i / SIZES % SIZES], 1.0};
        fe_dvec3 way = {-sizes[i / SIZES / SIZES % SIZES], -sizes[i / SIZES / SIZES / SIZES], 0.0};
        fe__ray_hit hit;
        if (!fe__heightfield_ray(&f.record, origin, way, 1.0, &hit)) continue;
        FE_WITHIN(hit.t, 0.0, 1.0);
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, 1e-12);
    }
    fe__ray_hit hit;
    fe_dvec3 high = {0.5, 1e6, 0.5};
    FE_TRUE(fe__heightfield_ray(&f.record, high, (fe_dvec3){0.0, -2e6, 0.0}, 1.0, &hit));
}

// Distance of a point to a triangle by its seven regions, in double
static double distance_to(const fe__form *t, fe_dvec3 p)
{
    fe_dvec3 v[3] = {fe__widen(t->vertex[0]), fe__widen(t->vertex[1]), fe__widen(t->vertex[2])};
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    double least = DBL_MAX;
    int32_t inside = 1;
    for (int32_t i = 0; i < 3; ++i) {
        fe_dvec3 e = fe__dsub(v[(i + 1) % 3], v[i]), d = fe__dsub(p, v[i]);
        inside &= fe__ddot(n, fe__dcross(e, d)) >= 0.0;
        double s = fe__maxd(fe__mind(fe__ddot(d, e) / fe__ddot(e, e), 1.0), 0.0);
        fe_dvec3 away = fe__dsub(d, fe__dscale(s, e));
        least = fe__mind(least, sqrt(fe__ddot(away, away)));
    }
    return inside ? fe__absd(fe__ddot(n, fe__dsub(p, v[0]))) / sqrt(fe__ddot(n, n)) : least;
}

// The general convex path takes a triangle as it takes any other form.
static void convex_path_knows_triangles(void **state)
{
    (void)state;
    for (int32_t c = 0; c < CASES / 4; ++c) {
        field f;
        random_field(&f);
        fe__form t = fe__heightfield_triangle(&f.record, c % TRIANGLES, (fe_dvec3){0.0, 0.0, 0.0}), ball = sphere(0.5f);
        fe__relative at = {fe__narrow(point_near(&f, 0.0)), fe__matrix(fe__identity())};
        double distance = distance_to(&t, fe__widen(at.position));
        if (distance < 0.01) continue; // cores overlap: a face decides
        fe__manifold m = {.axis = -1};
        fe__collide_convex(&t, &ball, &at, 10.0f, &m);
        FE_TRUE(m.count == (distance - 0.5 <= 10.0));
        if (m.count) FE_NEAR(m.points[0].separation, distance - 0.5, 1e-5);
        fe__form crate = box(0.5f, 0.5f, 0.5f);
        fe__manifold four = {.axis = -1};
        fe__collide_convex(&t, &crate, &at, 10.0f, &four);
        FE_WITHIN(four.count, 0, 4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_tile_the_grid),        cmocka_unit_test(walk_hands_out_what_meets_the_box),
        cmocka_unit_test(rays_meet_the_nearest_triangle), cmocka_unit_test(no_ray_slips_through_an_edge),
        cmocka_unit_test(rays_from_below_miss),           cmocka_unit_test(extreme_rays_are_answered),
        cmocka_unit_test(convex_path_knows_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
