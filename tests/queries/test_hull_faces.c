// Which face of a hull a query met: one on which the point lies, and the one that a ray there meets.
#include "api/api_test.h"
#include "queries/dice.h"

enum { POINTS = 40, CASES = 4000, FACES = 2 * POINTS };

typedef struct bench {
    fe_world *world;
    fe_hull_face faces[FACES];
    int32_t face_count;
    dice dice;
} bench;

static fe_dvec3 sum(fe_dvec3 a, double s, fe_dvec3 b)
{
    return fe_make_dvec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static double product(fe_dvec3 a, fe_vec3 b) { return a.x * (double)b.x + a.y * (double)b.y + a.z * (double)b.z; }

// Unturned, so that the faces' planes are those of the world
static void make_rock(bench *b)
{
    float points[POINTS][3];
    for (int32_t i = 0; i < POINTS; ++i) {
        fe_dvec3 p = direction(&b->dice);
        points[i][0] = (float)p.x, points[i][1] = 2 * (float)p.y, points[i][2] = (float)p.z;
    }
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = &points[0][0], def.point_count = POINTS;
    fe_asset asset;
    fe_store *store = world_store(b->world);
    OK(fe_hull_create(store, &def, &asset));
    b->face_count = fe_hull_get_faces(store, asset, b->faces, sizeof *b->faces, FACES);
    FE_WITHIN(b->face_count, 4, FACES);
    fe_geometry g;
    fe_geometry_hull(&g, asset);
    add_shape(b->world, new_body(b->world, FE_BODY_STATIC, 0, 0, 0), &g);
}

static fe_geometry mover_of(int32_t kind)
{
    fe_geometry g;
    if (kind == 0) fe_geometry_sphere(&g, 0.3f);
    if (kind == 1) fe_geometry_capsule(&g, 0.5f, 0.1f);
    if (kind == 2) fe_geometry_box(&g, 0.5f, 0.2f, 0.1f);
    if (kind == 3) fe_geometry_cylinder(&g, 0.4f, 0.3f);
    if (kind == 4) fe_geometry_cone(&g, 0.4f, 0.3f);
    return g;
}

// The planes are floats: 1e-6 of a hull of 2 m.
static void check_face(const bench *b, int32_t face, fe_dvec3 point, fe_vec3 normal)
{
    const double rounding = 1e-5;
    FE_WITHIN(face, 0, b->face_count - 1);
    const fe_hull_face *f = &b->faces[face];
    FE_NEAR(product(point, f->normal), (double)f->distance, rounding);
    fe_dvec3 n = fe_make_dvec3((double)normal.x, (double)normal.y, (double)normal.z);
    for (int32_t i = 0; i < b->face_count; ++i) {
        int32_t is_there = product(point, b->faces[i].normal) > (double)b->faces[i].distance - 1e-9;
        if (is_there) FE_TRUE(product(n, b->faces[i].normal) <= product(n, f->normal));
    }
}

// On an edge a ray may meet either face.
static int32_t is_on_one_face(const bench *b, fe_dvec3 point)
{
    const double apart = 1e-4; // m
    int32_t count = 0;
    for (int32_t i = 0; i < b->face_count; ++i)
        count += product(point, b->faces[i].normal) > (double)b->faces[i].distance - apart;
    return count == 1;
}

static void a_sweep_tells_the_face_that_it_met(void **state)
{
    (void)state;
    bench b = {.world = new_world(), .dice = {88172645463325252}};
    make_rock(&b);
    int32_t flat = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        fe_geometry mover = mover_of(i % 5);
        fe_dvec3 way = direction(&b.dice), aside = direction(&b.dice), far = sum(fe_make_dvec3(0, 0, 0), 20, way);
        fe_transform start = {sum(sum(fe_make_dvec3(0, 0, 0), -10, way), 0.5, aside), random_rotation(&b.dice)};
        fe_hit hit, there;
        if (fe_world_sweep(b.world, &mover, &start, &far, NULL, &hit) != 1) continue;
        check_face(&b, hit.triangle, hit.point, hit.normal);
        if (!is_on_one_face(&b, hit.point)) continue;
        fe_dvec3 up = {(double)hit.normal.x, (double)hit.normal.y, (double)hit.normal.z};
        fe_dvec3 from = sum(hit.point, 0.1, up), down = sum(fe_make_dvec3(0, 0, 0), -0.2, up);
        HIT(fe_world_raycast(b.world, &from, &down, NULL, &there));
        assert_int_equal(there.triangle, hit.triangle);
        flat += 1;
    }
    FE_WITHIN(flat, 50, CASES);
    OK(fe_world_destroy(b.world));
}

static void an_overlap_tells_the_face_of_its_way_out(void **state)
{
    (void)state;
    bench b = {.world = new_world(), .dice = {12345}};
    make_rock(&b);
    int32_t found = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        fe_geometry mover = mover_of(i % 5);
        fe_transform at = {sum(fe_make_dvec3(0, 0, 0), 1.1, direction(&b.dice)), random_rotation(&b.dice)};
        fe_overlap overlap;
        if (fe_world_overlap_shapes(b.world, &mover, &at, NULL, &overlap, sizeof overlap, 1) != 1) continue;
        const fe_hull_face *f = &b.faces[overlap.triangle];
        fe_vec3 n = overlap.direction;
        fe_dvec3 out = fe_make_dvec3((double)n.x, (double)n.y, (double)n.z);
        FE_WITHIN(overlap.triangle, 0, b.face_count - 1);
        for (int32_t k = 0; k < b.face_count; ++k)
            FE_TRUE(product(out, b.faces[k].normal) <= product(out, f->normal) + 1e-6);
        found += 1;
    }
    FE_WITHIN(found, CASES / 4, CASES);
    OK(fe_world_destroy(b.world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sweep_tells_the_face_that_it_met),
        cmocka_unit_test(an_overlap_tells_the_face_of_its_way_out),
    };
    return cmocka_run_group_tests_name("hull_faces", tests, NULL, NULL);
}
