// The API of queries: what each call answers, and every error it documents. What they find is judged in tests/queries.
#include "api_test.h"

typedef struct asked {
    fe_world *world;
    fe_body ground, box, gone;
    fe_shape ground_shape, box_shape;
    fe_geometry ball, point, plane;
    fe_transform at, far; // at the box, where nothing is
    fe_dvec3 above, down;
} asked;

// A half space below 0, a box of 1 m from 0 to 1 on it, 9 m below `above`.
static asked new_asked(void)
{
    asked a = {.world = new_world()};
    a.gone = new_box(a.world, 50, 0, 0);
    OK(fe_body_destroy(a.world, a.gone));
    a.ground = new_ground(a.world);
    a.box = new_body(a.world, FE_BODY_DYNAMIC, 0, 0.5, 0);
    a.box_shape = add_box(a.world, a.box, 0.5f);
    assert_int_equal(fe_body_get_shapes(a.world, a.ground, &a.ground_shape, 1), 1);
    fe_geometry_sphere(&a.ball, 0.25f);
    fe_geometry_sphere(&a.point, 0);
    fe_geometry_plane(&a.plane, 0, 1, 0, 0);
    a.at = fe_make_transform(0, 0.5, 0), a.far = fe_make_transform(0, 100, 0);
    a.above = fe_make_dvec3(0, 10, 0), a.down = fe_make_dvec3(0, -20, 0);
    return a;
}

// ---- answers -------------------------------------------------------------------------------------------------------

static void rays_answer(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_hit hits[3];
    fe_dvec3 up = {0, 20, 0};
    HIT(fe_world_raycast_any(a.world, &a.above, &a.down, NULL));
    assert_int_equal(fe_world_raycast_any(a.world, &a.above, &up, NULL), 0);
    assert_int_equal(fe_world_raycast_all(a.world, &a.above, &a.down, NULL, hits, sizeof *hits, 3), 2);
    assert_true(hits[0].body == a.box && hits[1].body == a.ground && hits[0].shape == a.box_shape);
    FE_NEAR(hits[0].fraction, 0.45, 1e-15), FE_NEAR(hits[1].fraction, 0.5, 1e-15);
    assert_int_equal(fe_world_raycast_all(a.world, &a.above, &a.down, NULL, NULL, 0, 0), 2);
    assert_int_equal(fe_world_raycast_all(a.world, &a.above, &up, NULL, hits, sizeof *hits, 3), 0);
    HIT(fe_shape_raycast(a.world, a.ground_shape, &a.above, &a.down, hits));
    assert_true(hits[0].body == a.ground && hits[0].shape == a.ground_shape);
    assert_int_equal(fe_shape_raycast(a.world, a.box_shape, &a.above, &up, hits), 0);
    HIT(fe_body_raycast(a.world, a.box, &a.above, &a.down, hits));
    assert_true(hits[0].shape == a.box_shape);
    assert_int_equal(fe_body_raycast(a.world, a.box, &a.above, &up, hits), 0);
    OK(fe_world_destroy(a.world));
}

// Wider records than the library's, with the host's own data behind, stay what they are there.
static void hits_are_written_with_a_stride(void **state)
{
    (void)state;
    asked a = new_asked();
    struct {
        fe_hit hit;
        uint32_t mine;
    } wide[2] = {{.mine = 7}, {.mine = 8}};
    assert_int_equal(fe_world_raycast_all(a.world, &a.above, &a.down, NULL, &wide[0].hit, sizeof wide[0], 2), 2);
    assert_true(wide[0].hit.body == a.box && wide[1].hit.body == a.ground && wide[0].mine == 7 && wide[1].mine == 8);
    unsigned char packed[2 * (sizeof(fe_hit) + 4) + 4]; // no double is aligned
    assert_int_equal(fe_world_raycast_all(a.world, &a.above, &a.down, NULL, (fe_hit *)(void *)(packed + 4),
                                          sizeof(fe_hit) + 4, 2),
                     2);
    assert_memory_equal(packed + 4, &wide[0].hit, sizeof(fe_hit));
    assert_memory_equal(packed + 8 + sizeof(fe_hit), &wide[1].hit, sizeof(fe_hit));
    OK(fe_world_destroy(a.world));
}

static void sweeps_answer(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_hit hits[3];
    fe_transform start = fe_make_transform(0, 10, 0);
    fe_dvec3 up = {0, 20, 0}, none = {0, 0, 0};
    HIT(fe_world_sweep(a.world, &a.ball, &start, &a.down, NULL, hits));
    assert_true(hits[0].body == a.box && hits[0].flags == 0);
    FE_WITHIN(10 - 20 * hits[0].fraction, 1.25, 1.25 + 1e-6);
    FE_NEAR(hits[0].point.y, 1, 1e-6), FE_NEAR(hits[0].normal.y, 1, 1e-7);
    HIT(fe_world_sweep_any(a.world, &a.ball, &start, &a.down, NULL));
    assert_int_equal(fe_world_sweep(a.world, &a.ball, &start, &up, NULL, hits), 0);
    assert_int_equal(fe_world_sweep_any(a.world, &a.ball, &start, &up, NULL), 0);
    assert_int_equal(fe_world_sweep_all(a.world, &a.ball, &start, &a.down, NULL, hits, sizeof *hits, 3), 2);
    assert_true(hits[0].body == a.box && hits[1].body == a.ground);
    HIT(fe_world_sweep(a.world, &a.ball, &a.at, &up, NULL, hits));
    assert_true(hits[0].flags == FE_HIT_STARTED_INSIDE && hits[0].fraction == 0.0 && hits[0].normal.y == -1.0f);
    FE_NEAR(hits[0].depth, 0.75, 1e-7);
    HIT(fe_world_sweep(a.world, &a.ball, &a.at, &none, NULL, hits));
    OK(fe_world_destroy(a.world));
}

static void overlaps_answer(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_body bodies[3] = {0};
    fe_geometry large;
    fe_geometry_box(&large, 1, 1, 1);
    assert_int_equal(fe_world_overlap(a.world, &large, &a.at, NULL, bodies, 3), 2);
    assert_true(bodies[0] == a.ground && bodies[1] == a.box && bodies[2] == 0);
    assert_int_equal(fe_world_overlap(a.world, &large, &a.at, NULL, bodies + 2, 1), 2);
    assert_true(bodies[2] == a.ground);
    assert_int_equal(fe_world_overlap(a.world, &a.ball, &a.at, NULL, NULL, 0), 1);
    assert_int_equal(fe_world_overlap(a.world, &a.point, &a.at, NULL, NULL, 0), 1);
    assert_int_equal(fe_world_overlap(a.world, &a.ball, &a.far, NULL, bodies, 3), 0);
    HIT(fe_world_overlap_any(a.world, &a.ball, &a.at, NULL));
    assert_int_equal(fe_world_overlap_any(a.world, &a.ball, &a.far, NULL), 0);
    OK(fe_world_destroy(a.world));
}

static void closest_points_answer(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_closest c;
    fe_dvec3 beside = {2, 1.5, 0}, inside = {0.25, 0.5, 0};
    HIT(fe_world_closest_point(a.world, &beside, 10, NULL, &c));
    assert_true(c.body == a.ground && c.shape == a.ground_shape && c.triangle == -1);
    FE_NEAR(c.distance, 1.5, 1e-15), FE_NEAR(c.normal.y, 1, 0), FE_NEAR(c.point.x, 2, 0), FE_NEAR(c.point.y, 0, 1e-15);
    assert_int_equal(fe_world_closest_point(a.world, &beside, 1.25, NULL, &c), 0);
    HIT(fe_world_closest_point(a.world, &beside, 1.5, NULL, &c)); // just so far counts
    HIT(fe_world_closest_point(a.world, &inside, 0, NULL, &c));
    assert_true(c.body == a.box);
    FE_NEAR(c.distance, -0.25, 1e-15), FE_NEAR(c.normal.x, 1, 0), FE_NEAR(c.point.x, 0.5, 1e-15);
    HIT(fe_shape_closest_point(a.world, a.box_shape, &beside, &c));
    FE_NEAR(c.distance, sqrt(1.5 * 1.5 + 0.5 * 0.5), 1e-15);
    HIT(fe_body_closest_point(a.world, a.box, &beside, &c));
    assert_true(c.shape == a.box_shape);
    fe_body empty = new_body(a.world, FE_BODY_STATIC, 0, 0, 0);
    assert_int_equal(fe_body_closest_point(a.world, empty, &beside, &c), 0);
    OK(fe_world_destroy(a.world));
}

// One shape or body asked by name answers though it is disabled, a trigger, or on no layer that anybody asks for.
static void what_is_named_answers_always(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_hit hit;
    fe_closest c;
    OK(fe_shape_set_trigger(a.world, a.box_shape, 1));
    OK(fe_body_set_enabled(a.world, a.box, 0));
    HIT(fe_shape_raycast(a.world, a.box_shape, &a.above, &a.down, &hit));
    HIT(fe_body_raycast(a.world, a.box, &a.above, &a.down, &hit));
    HIT(fe_shape_closest_point(a.world, a.box_shape, &a.above, &c));
    HIT(fe_world_raycast(a.world, &a.above, &a.down, NULL, &hit));
    assert_true(hit.body == a.ground);
    OK(fe_world_destroy(a.world));
}

enum { MANY = 500 };

static void many_at_once_answer_as_one_by_one(void **state)
{
    (void)state;
    asked a = new_asked();
    for (int i = 0; i < 20; ++i) new_box(a.world, i % 5 - 2.0, i / 5 + 2.0, 0.3 * i);
    static fe_ray rays[MANY];
    static fe_path paths[MANY];
    static fe_hit one[MANY], many[MANY], spread[MANY];
    for (int i = 0; i < MANY; ++i) {
        rays[i] = (fe_ray){{0.01 * i - 2.5, 10, 0.02 * i - 2}, {0.3, -12 + 0.05 * (i % 100), 0.1}, {0}};
        paths[i] =
            (fe_path){fe_make_transform(rays[i].origin.x, 10, rays[i].origin.z), rays[i].translation, {0, 0, 0}, {0}};
    }
    for (int kind = 0; kind < 2; ++kind) {
        int32_t hits = 0;
        for (int i = 0; i < MANY; ++i) {
            int32_t result =
                kind ? fe_world_sweep(a.world, &a.ball, &paths[i].start, &paths[i].translation, NULL, &one[i])
                     : fe_world_raycast(a.world, &rays[i].origin, &rays[i].translation, NULL, &one[i]);
            hits += result;
            if (result == 1) continue;
            fe_dvec3 end = {rays[i].origin.x + rays[i].translation.x, 10 + rays[i].translation.y,
                            rays[i].origin.z + rays[i].translation.z};
            one[i] = (fe_hit){.point = end, .fraction = 1, .part = -1, .triangle = -1};
        }
        FE_WITHIN(hits, 1, MANY - 1);
        for (int32_t s = 0; s < 2; ++s) {
            fe_hit *out = s ? spread : many;
            int32_t found =
                kind ? fe_world_sweep_many(a.world, &a.ball, paths, sizeof(fe_path), MANY, NULL, s, out, sizeof(fe_hit))
                     : fe_world_raycast_many(a.world, rays, sizeof(fe_ray), MANY, NULL, s, out, sizeof(fe_hit));
            assert_int_equal(found, hits);
            assert_memory_equal(out, one, sizeof one);
        }
    }
    fe_body bodies[MANY]; // the front of each hit
    FE_TRUE(fe_world_sweep_many(a.world, &a.ball, paths, sizeof *paths, MANY, NULL, 0, (fe_hit *)(void *)bodies,
                                sizeof *bodies) > 0);
    for (int i = 0; i < MANY; ++i) assert_true(bodies[i] == one[i].body);
    assert_int_equal(fe_world_raycast_many(a.world, NULL, 0, 0, NULL, 1, NULL, 0), 0);
    assert_int_equal(fe_world_sweep_many(a.world, &a.ball, NULL, 0, 0, NULL, 1, NULL, 0), 0);
    OK(fe_world_destroy(a.world));
}

// ---- errors --------------------------------------------------------------------------------------------------------

static const fe_dvec3 bad_vectors[] = {{(double)NAN, 0, 0}, {0, (double)INFINITY, 0}, {0, 0, 1e11}};
enum { BAD = sizeof bad_vectors / sizeof *bad_vectors };

static void bad_rays_are_refused(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_world *w = a.world;
    fe_hit h[2];
    fe_query_filter bad;
    fe_query_filter_init(&bad, sizeof bad);
    bad.flags = 128;
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(NULL, &a.above, &a.down, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(w, NULL, &a.down, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(w, &a.above, NULL, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(w, &a.above, &a.down, &bad));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(NULL, &a.above, &a.down, NULL, h, sizeof *h, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, NULL, &a.down, NULL, h, sizeof *h, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, NULL, NULL, h, sizeof *h, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &a.down, &bad, h, sizeof *h, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &a.down, NULL, NULL, sizeof(fe_hit), 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &a.down, NULL, h, sizeof *h, -1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &a.down, NULL, h, 68, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &a.down, NULL, h, 74, 2));
    for (int i = 0; i < BAD; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(w, &bad_vectors[i], &a.down, NULL));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_any(w, &a.above, &bad_vectors[i], NULL));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &bad_vectors[i], &a.down, NULL, h, sizeof *h, 2));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_all(w, &a.above, &bad_vectors[i], NULL, h, sizeof *h, 2));
    }
    OK(fe_world_destroy(w));
}

static void bad_sweeps_and_overlaps_are_refused(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_world *w = a.world;
    fe_hit h[2];
    fe_body b[2];
    fe_geometry small, nan, garbage = a.ball, flat;
    fe_geometry_sphere(&small, 0.0001f), fe_geometry_capsule(&nan, 1, NOT_A_NUMBER), fe_geometry_box(&flat, 1, 0, 1);
    garbage.type = 77;
    fe_transform tilted = a.at, lost = a.at;
    tilted.rotation.w = 0, lost.position.x = (double)INFINITY;
    const fe_geometry *refused[] = {NULL, &small, &nan, &flat};
    for (int i = 0; i < 4; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(w, refused[i], &a.at, &a.down, NULL, h));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_any(w, refused[i], &a.at, &a.down, NULL));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, refused[i], &a.at, &a.down, NULL, h, sizeof *h, 2));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap(w, refused[i], &a.at, NULL, b, 2));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap_any(w, refused[i], &a.at, NULL));
    }
    REFUSES(w, FE_ERROR_UNSUPPORTED, fe_world_sweep(w, &a.plane, &a.at, &a.down, NULL, h));
    REFUSES(w, FE_ERROR_UNSUPPORTED, fe_world_overlap(w, &garbage, &a.at, NULL, b, 2));
    const fe_transform *poses[] = {NULL, &tilted, &lost};
    for (int i = 0; i < 3; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(w, &a.ball, poses[i], &a.down, NULL, h));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_any(w, &a.ball, poses[i], &a.down, NULL));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, &a.ball, poses[i], &a.down, NULL, h, sizeof *h, 2));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap(w, &a.ball, poses[i], NULL, b, 2));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap_any(w, &a.ball, poses[i], NULL));
    }
    for (int i = 0; i < BAD; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(w, &a.ball, &a.at, &bad_vectors[i], NULL, h));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_any(w, &a.ball, &a.at, &bad_vectors[i], NULL));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, &a.ball, &a.at, &bad_vectors[i], NULL, h, sizeof *h, 2));
    }
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(NULL, &a.ball, &a.at, &a.down, NULL, h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(w, &a.ball, &a.at, NULL, NULL, h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep(w, &a.ball, &a.at, &a.down, NULL, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_any(w, &a.ball, &a.at, NULL, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, &a.ball, &a.at, NULL, NULL, h, sizeof *h, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, &a.ball, &a.at, &a.down, NULL, NULL, sizeof(fe_hit), 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_all(w, &a.ball, &a.at, &a.down, NULL, h, 8, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap(w, &a.ball, &a.at, NULL, NULL, 2));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_overlap(w, &a.ball, &a.at, NULL, b, -2));
    OK(fe_world_destroy(w));
}

static void bad_batches_are_refused(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_world *w = a.world;
    fe_hit h[2], untouched[2];
    memset(h, 0x55, sizeof h), memcpy(untouched, h, sizeof h);
    fe_ray rays[2] = {{a.above, a.down, {0}}, {a.above, {0, (double)NAN, 0}, {0}}};
    fe_path paths[2] = {{a.far, a.down, {0, 0, 0}, {0}}, {a.far, {0, 0, (double)INFINITY}, {0, 0, 0}, {0}}};
    REFUSES(w, FE_ERROR_ARGUMENT,
            fe_world_raycast_many(w, rays, sizeof(fe_ray), 2, NULL, 0, h, sizeof(fe_hit))); // the second
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, rays, 44, 1, NULL, 0, h, sizeof *h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, rays, sizeof(fe_ray), 1, NULL, 2, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, rays, sizeof *rays, 1, NULL, 0, h, 4));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, rays, sizeof(fe_ray), 1, NULL, 0, NULL, sizeof *h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, NULL, sizeof *rays, 1, NULL, 0, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_raycast_many(w, rays, sizeof(fe_ray), -1, NULL, 0, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT,
            fe_world_sweep_many(w, &a.ball, paths, sizeof(fe_path), 2, NULL, 1, h, sizeof(fe_hit))); // the second
    REFUSES(w, FE_ERROR_UNSUPPORTED,
            fe_world_sweep_many(w, &a.plane, paths, sizeof(fe_path), 1, NULL, 1, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_many(w, &a.ball, paths, 60, 1, NULL, 1, h, sizeof *h));
    REFUSES(w, FE_ERROR_ARGUMENT,
            fe_world_sweep_many(w, &a.ball, paths, sizeof(fe_path), 1, NULL, -1, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_many(w, &a.ball, NULL, sizeof *paths, 1, NULL, 1, h, sizeof(fe_hit)));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_sweep_many(w, &a.ball, paths, sizeof(fe_path), 1, NULL, 1, NULL, sizeof *h));
    paths[1] = paths[0], paths[1].start.rotation.w = 0;
    REFUSES(w, FE_ERROR_ARGUMENT,
            fe_world_sweep_many(w, &a.ball, paths, sizeof(fe_path), 2, NULL, 1, h, sizeof(fe_hit)));
    assert_memory_equal(h, untouched, sizeof h);
    OK(fe_world_destroy(w));
}

static void bad_points_and_handles_are_refused(void **state)
{
    (void)state;
    asked a = new_asked();
    fe_world *w = a.world;
    fe_hit h;
    fe_closest c;
    for (int i = 0; i < BAD; ++i) {
        REFUSES(w, FE_ERROR_ARGUMENT, fe_world_closest_point(w, &bad_vectors[i], 1, NULL, &c));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_shape_closest_point(w, a.box_shape, &bad_vectors[i], &c));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_body_closest_point(w, a.box, &bad_vectors[i], &c));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_shape_raycast(w, a.box_shape, &a.above, &bad_vectors[i], &h));
        REFUSES(w, FE_ERROR_ARGUMENT, fe_body_raycast(w, a.box, &bad_vectors[i], &a.down, &h));
    }
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_closest_point(w, NULL, 1, NULL, &c));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_closest_point(w, &a.above, -1, NULL, &c));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_closest_point(w, &a.above, (double)NAN, NULL, &c));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_closest_point(w, &a.above, 1, NULL, NULL));
    REFUSES(w, FE_ERROR_STALE, fe_body_raycast(w, a.gone, &a.above, &a.down, &h));
    REFUSES(w, FE_ERROR_KIND, fe_body_raycast(w, a.box_shape, &a.above, &a.down, &h));
    REFUSES(w, FE_ERROR_STALE, fe_shape_raycast(w, 0, &a.above, &a.down, &h));
    REFUSES(w, FE_ERROR_KIND, fe_shape_raycast(w, a.box, &a.above, &a.down, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_shape_raycast(w, a.box_shape, NULL, &a.down, &h));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_body_raycast(w, a.box, &a.above, &a.down, NULL));
    REFUSES(w, FE_ERROR_STALE, fe_body_closest_point(w, a.gone, &a.above, &c));
    REFUSES(w, FE_ERROR_KIND, fe_body_closest_point(w, a.box_shape, &a.above, &c));
    REFUSES(w, FE_ERROR_STALE, fe_shape_closest_point(w, 12345, &a.above, &c));
    REFUSES(w, FE_ERROR_KIND, fe_shape_closest_point(w, a.box, &a.above, &c));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_shape_closest_point(w, a.box_shape, NULL, &c));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_body_closest_point(w, a.box, &a.above, NULL));
    OK(fe_world_destroy(w));
}

// A host that asks from within a step: every query says so.
static asked *stepping;
static int32_t intrusions;

static void intrude(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    for (int32_t i = 0; i < count; ++i) task(argument, i);
    if (!stepping || intrusions++ > 0) return;
    const asked *a = stepping;
    fe_hit h;
    fe_closest c;
    fe_body b;
    fe_ray ray = {a->above, a->down, {0}};
    fe_path path = {a->at, a->down, {0, 0, 0}, {0}};
    const int32_t results[] = {
        fe_world_raycast(a->world, &a->above, &a->down, NULL, &h),
        fe_world_raycast_any(a->world, &a->above, &a->down, NULL),
        fe_world_raycast_all(a->world, &a->above, &a->down, NULL, &h, sizeof h, 1),
        fe_world_raycast_many(a->world, &ray, sizeof(fe_ray), 1, NULL, 1, &h, sizeof(fe_hit)),
        fe_world_sweep(a->world, &a->ball, &a->at, &a->down, NULL, &h),
        fe_world_sweep_any(a->world, &a->ball, &a->at, &a->down, NULL),
        fe_world_sweep_all(a->world, &a->ball, &a->at, &a->down, NULL, &h, sizeof h, 1),
        fe_world_sweep_many(a->world, &a->ball, &path, sizeof(fe_path), 1, NULL, 1, &h, sizeof(fe_hit)),
        fe_world_overlap(a->world, &a->ball, &a->at, NULL, &b, 1),
        fe_world_overlap_any(a->world, &a->ball, &a->at, NULL),
        fe_world_closest_point(a->world, &a->above, 1, NULL, &c),
        fe_shape_raycast(a->world, a->box_shape, &a->above, &a->down, &h),
        fe_body_raycast(a->world, a->box, &a->above, &a->down, &h),
        fe_shape_closest_point(a->world, a->box_shape, &a->above, &c),
        fe_body_closest_point(a->world, a->box, &a->above, &c),
    };
    for (size_t i = 0; i < sizeof results / sizeof *results; ++i) assert_int_equal(results[i], FE_ERROR_STEPPING);
}

static void queries_during_a_step_are_refused(void **state)
{
    (void)state;
    fe_task_system tasks = {.struct_size = sizeof tasks, .worker_count = 4, .run = intrude};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.tasks = &tasks;
    asked a = new_asked();
    OK(fe_world_destroy(a.world));
    OK(fe_world_create(&def, &a.world));
    for (int i = 0; i < 300; ++i) a.box = new_box(a.world, 2.0 * i, 5, 0);
    assert_int_equal(fe_body_get_shapes(a.world, a.box, &a.box_shape, 1), 1);
    stepping = &a;
    step(a.world, 3);
    FE_TRUE(intrusions > 0);
    stepping = NULL;
    OK(fe_world_destroy(a.world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_answer),
        cmocka_unit_test(hits_are_written_with_a_stride),
        cmocka_unit_test(sweeps_answer),
        cmocka_unit_test(overlaps_answer),
        cmocka_unit_test(closest_points_answer),
        cmocka_unit_test(what_is_named_answers_always),
        cmocka_unit_test(many_at_once_answer_as_one_by_one),
        cmocka_unit_test(bad_rays_are_refused),
        cmocka_unit_test(bad_sweeps_and_overlaps_are_refused),
        cmocka_unit_test(bad_batches_are_refused),
        cmocka_unit_test(bad_points_and_handles_are_refused),
        cmocka_unit_test(queries_during_a_step_are_refused),
    };
    return cmocka_run_group_tests_name("query", tests, NULL, NULL);
}
