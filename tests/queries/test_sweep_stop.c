// How far before a body a sweep stops: at most 1 micrometre (0.1 mm between two boxes), never in it.
//
//     build/tests/queries/test_sweep_stop 100000      that many cases a pair of forms, and the table of docs/QUERIES.md
//
// Shapes of 1 cm to 1 km, ways of 1 mm to 10 km, at the world's origin and 1e6 m off it. The judge is exact.h, in long
// double.
#include "api/api_test.h"
#include "queries/dice.h"
#include "queries/exact.h"

#include <stdio.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { CASES = 300 };
#else
enum { CASES = 3000 };
#endif

static int32_t cases = CASES;

typedef struct bench {
    fe_world *world;
    fe_body body;
    fe_shape shape;
    dice dice;
} bench;

static fe_geometry geometry_of(bench *b, int32_t type)
{
    fe_geometry g;
    float sizes[3];
    for (int k = 0; k < 3; ++k) sizes[k] = (float)spread(&b->dice, 0.01, 1000);
    if (type == FE_GEOMETRY_SPHERE) fe_geometry_sphere(&g, sizes[0]);
    if (type == FE_GEOMETRY_CAPSULE) fe_geometry_capsule(&g, sizes[0], sizes[1]);
    if (type == FE_GEOMETRY_BOX) fe_geometry_box(&g, sizes[0], sizes[1], sizes[2]);
    fe_dvec3 n = direction(&b->dice);
    if (type == FE_GEOMETRY_PLANE) fe_geometry_plane(&g, (float)n.x, (float)n.y, (float)n.z, sizes[0]);
    return g;
}

static fe_dvec3 along(fe_dvec3 p, double s, fe_dvec3 d)
{
    return fe_make_dvec3(p.x + s * d.x, p.y + s * d.y, p.z + s * d.z);
}

typedef struct tally {
    int32_t hits;
    double least, most, normal; // m, m, sine of the largest error
} tally;

// A way that meets the body somewhere in the middle: aimed from afar first, then taken from a start nearer by.
static void one_case(bench *b, int32_t moving, int32_t standing, tally *t)
{
    double middle = uniform(&b->dice, 0, 1) < 0.5 ? 0 : 1e6;
    fe_geometry still = geometry_of(b, standing), mover = geometry_of(b, moving);
    fe_transform pose = {fe_make_dvec3(middle + uniform(&b->dice, -10, 10), -middle + uniform(&b->dice, -10, 10),
                                       uniform(&b->dice, -10, 10)),
                         random_rotation(&b->dice)};
    fe_transform start = {pose.position, random_rotation(&b->dice)};
    OK(fe_shape_set_geometry(b->world, b->shape, &still));
    OK(fe_body_set_transform(b->world, b->body, &pose));
    OK(fe_body_get_transform(b->world, b->body, &pose)); // its rotation brought to length 1, in floats
    solid of_still = make_solid(&still, v_of(pose.position), pose.rotation),
          of_mover = make_solid(&mover, v_of(start.position), start.rotation);
    double reach = (double)of_mover.reach + (standing == FE_GEOMETRY_PLANE ? 1000 : (double)of_still.reach);
    fe_dvec3 way = direction(&b->dice), far;
    start.position =
        along(along(pose.position, uniform(&b->dice, 0, 0.7) * reach, direction(&b->dice)), -3 * reach, way);
    far = along(fe_make_dvec3(0, 0, 0), 6 * reach, way);
    fe_hit hit;
    if (fe_world_sweep(b->world, &mover, &start, &far, NULL, &hit) != 1 || hit.flags & FE_HIT_STARTED_INSIDE) return;
    double length = spread(&b->dice, 1e-3, 1e4);
    start.position =
        along(along(start.position, hit.fraction * 6 * reach, way), -length * uniform(&b->dice, 0, 1), way);
    fe_dvec3 translation = along(fe_make_dvec3(0, 0, 0), length, way);
    if (fe_world_sweep(b->world, &mover, &start, &translation, NULL, &hit) != 1 || hit.flags & FE_HIT_STARTED_INSIDE)
        return;
    of_mover = make_solid(&mover, v_of(start.position), start.rotation);
    vec shift = v_scale(hit.fraction, v_of(translation));
    nearness n = nearest(&of_mover, shift, &of_still);
    double gap = (double)(n.distance - of_mover.radius - of_still.radius);
    vec away = standing == FE_GEOMETRY_PLANE ? of_still.normal : v_sub(n.on_mover, n.on_still);
    double error = (double)(v_length(v_cross(away, v_off(hit.normal))) / v_length(away));
    t->hits += 1;
    t->least = fmin(t->least, gap), t->most = fmax(t->most, gap), t->normal = fmax(t->normal, error);
}

// ---- heightfields --------------------------------------------------------------------------------------------------

enum { SAMPLES = 6, TRIANGLES = 2 * (SAMPLES - 1) * (SAMPLES - 1) };

// Of the hulls of all triangles; away points from the nearest.
static nearness nearest_triangle(const solid *mover, vec shift, const solid *triangles)
{
    nearness best = {INFINITY, {0, 0, 0}, {0, 0, 0}};
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        vec d = v_sub(v_add(mover->centre, shift), triangles[i].centre);
        if (v_length(d) - mover->reach - triangles[i].reach > 0.01L) continue;
        nearness n = nearest(mover, shift, &triangles[i]);
        if (n.distance < best.distance) best = n;
    }
    return best;
}

// From above, steeply: what comes from below or the rim from aside is judged elsewhere.
static void one_field_case(bench *b, int32_t moving, tally *t)
{
    float heights[SAMPLES * SAMPLES], cell = (float)spread(&b->dice, 0.05, 200);
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = (float)uniform(&b->dice, -0.2, 0.2) * cell;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.cell_x = def.cell_z = cell, def.heights = heights;
    double middle = uniform(&b->dice, 0, 1) < 0.5 ? 0 : 1e6;
    fe_transform pose = {fe_make_dvec3(middle, -middle, 1),
                         {(float)uniform(&b->dice, -0.1, 0.1), 0, (float)uniform(&b->dice, -0.1, 0.1), 1}};
    fe_asset asset;
    fe_geometry g, mover = geometry_of(b, moving);
    OK(fe_heightfield_create(world_store(b->world), &def, &asset));
    fe_geometry_heightfield(&g, asset);
    OK(fe_shape_set_geometry(b->world, b->shape, &g));
    OK(fe_asset_destroy(world_store(b->world), asset));
    OK(fe_body_set_transform(b->world, b->body, &pose));
    OK(fe_body_get_transform(b->world, b->body, &pose));
    solid triangles[TRIANGLES];
    for (int32_t i = 0; i < TRIANGLES; ++i)
        triangles[i] = make_field_solid(&def, i / 2 / (SAMPLES - 1), i / 2 % (SAMPLES - 1), i % 2, v_of(pose.position),
                                        pose.rotation);
    fe_transform start = {pose.position, random_rotation(&b->dice)};
    solid of_mover = make_solid(&mover, v_of(start.position), start.rotation);
    double reach = (double)of_mover.reach + 4 * (double)cell;
    fe_dvec3 way = direction(&b->dice), goal = pose.position;
    way.y = -2 - fabs(way.y); // at most 27 degrees off the vertical, the ground at most 45: never from below
    double size = sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
    way = fe_make_dvec3(way.x / size, way.y / size, way.z / size);
    goal.x += uniform(&b->dice, 1, SAMPLES - 2) * (double)cell,
        goal.z += uniform(&b->dice, 1, SAMPLES - 2) * (double)cell;
    start.position = along(goal, -3 * reach, way);
    fe_dvec3 far = along(fe_make_dvec3(0, 0, 0), 6 * reach, way);
    fe_hit hit;
    if (fe_world_sweep(b->world, &mover, &start, &far, NULL, &hit) != 1 || hit.flags & FE_HIT_STARTED_INSIDE) return;
    double length = spread(&b->dice, 1e-3, 1e4);
    start.position =
        along(along(start.position, hit.fraction * 6 * reach, way), -length * uniform(&b->dice, 0, 1), way);
    fe_dvec3 translation = along(fe_make_dvec3(0, 0, 0), length, way);
    if (fe_world_sweep(b->world, &mover, &start, &translation, NULL, &hit) != 1 || hit.flags & FE_HIT_STARTED_INSIDE)
        return;
    of_mover = make_solid(&mover, v_of(start.position), start.rotation);
    vec shift = v_scale(hit.fraction, v_of(translation));
    nearness n = nearest_triangle(&of_mover, shift, triangles),
             of_hit = nearest(&of_mover, shift, &triangles[hit.triangle]);
    vec away = v_sub(of_hit.on_mover, of_hit.on_still); // two triangles may be as near
    double gap = (double)(n.distance - of_mover.radius),
           error = (double)(v_length(v_cross(away, v_off(hit.normal))) / v_length(away));
    t->hits += 1;
    t->least = fmin(t->least, gap), t->most = fmax(t->most, gap), t->normal = fmax(t->normal, error);
}

static const struct {
    const char *name;
    int32_t type;
} kinds[] = {{"sphere", FE_GEOMETRY_SPHERE},
             {"capsule", FE_GEOMETRY_CAPSULE},
             {"box", FE_GEOMETRY_BOX},
             {"plane", FE_GEOMETRY_PLANE},
             {"field", FE_GEOMETRY_HEIGHTFIELD}};
enum { MOVING_KINDS = 3, KINDS = 5 };

static tally tally_of(int32_t mover, int32_t still)
{
    const int32_t moving = kinds[mover].type, standing = kinds[still].type;
    bench b = {.world = new_world(), .dice = {UINT64_C(0x9e3779b97f4a7c15) + (uint32_t)(mover * 8 + still)}};
    b.body = new_body(b.world, FE_BODY_STATIC, 0, 0, 0);
    b.shape = add_box(b.world, b.body, 1);
    tally t = {0, INFINITY, -INFINITY, 0};
    for (int32_t i = 0; i < cases; ++i) {
        if (standing == FE_GEOMETRY_HEIGHTFIELD)
            one_field_case(&b, moving, &t);
        else
            one_case(&b, moving, standing, &t);
    }
    OK(fe_world_destroy(b.world));
    printf("| %-7s | %-7s | %6d | %9.4f | %9.4f | %7.1e |\n", kinds[mover].name, kinds[still].name, (int)t.hits,
           1e6 * t.least, 1e6 * t.most, t.normal);
    return t;
}

// The narrowing of the normal to floats takes 1e-7 of it.
static void a_sweep_stops_before_the_body(void **state)
{
    (void)state;
    printf("| moving  | stands  | hits   | least, um | most, um  | normal  |\n|---|---|---|---|---|---|\n");
    for (int32_t mover = 0; mover < MOVING_KINDS; ++mover) {
        for (int32_t still = 0; still < KINDS; ++still) {
            double bound = kinds[mover].type == FE_GEOMETRY_BOX && kinds[still].type == FE_GEOMETRY_BOX ? 1e-4 : 1e-6;
            tally t = tally_of(mover, still);
            FE_WITHIN(t.hits, cases / 4, cases);
            FE_WITHIN(t.least, 0, bound);
            FE_WITHIN(t.most, 0, bound);
            FE_WITHIN(t.normal, 0, 1e-5);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1) cases = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_sweep_stops_before_the_body)};
    return cmocka_run_group_tests_name("sweep_stop", tests, NULL, NULL);
}
