// Who meets whom: groups, the pair filter, one-way shapes, and how materials mix.
#include "api_test.h"

// ---- groups --------------------------------------------------------------------------------------------------------

static fe_body sphere_at(fe_world *world, double y, uint32_t layer, uint32_t mask, int32_t group)
{
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, y, 0);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.layer = layer, def.mask = mask, def.group = group;
    fe_geometry geometry;
    fe_geometry_sphere(&geometry, 0.5f);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, &geometry, &shape));
    return body;
}

// Two spheres that overlap: with a contact when they may meet
static int32_t touch(uint32_t layer_a, uint32_t mask_a, int32_t group_a, uint32_t layer_b, uint32_t mask_b,
                     int32_t group_b)
{
    fe_world *world = new_world();
    fe_body a = sphere_at(world, 0, layer_a, mask_a, group_a);
    (void)sphere_at(world, 0.9, layer_b, mask_b, group_b);
    OK(fe_world_step(world, 0.0f));
    int32_t count = fe_body_get_contacts(world, a, NULL, 0, 0);
    OK(fe_world_destroy(world));
    return count;
}

// Every combination of groups and of layers that meet or do not: one group of both decides, above 0 yes, below 0 no;
// layers decide otherwise.
static void a_group_of_both_decides_and_layers_otherwise(void **state)
{
    (void)state;
    static const int32_t groups[] = {-2, -1, 0, 1, 2};
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 5; ++k)
            for (uint32_t masks = 0; masks < 4; ++masks) {
                uint32_t mask_a = masks & 1 ? 2u : 0u, mask_b = masks & 2 ? 1u : 0u;
                int32_t layers = mask_a != 0 && mask_b != 0, same = groups[i] == groups[k] && groups[i] != 0;
                assert_int_equal(touch(1, mask_a, groups[i], 2, mask_b, groups[k]), same ? groups[i] > 0 : layers);
            }
}

static void a_filter_is_read_as_it_was_set(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0), empty = new_body(world, FE_BODY_DYNAMIC, 9, 0, 0);
    uint32_t layer, mask;
    int32_t group;
    OK(fe_body_set_filter(world, body, 4, 5, -7));
    OK(fe_body_get_filter(world, body, &layer, &mask, &group));
    assert_true(layer == 4 && mask == 5 && group == -7);
    fe_shape second = add_sphere(world, body, 0.2f);
    REFUSES(world, FE_ERROR_STATE, fe_body_get_filter(world, body, &layer, &mask, &group));
    OK(fe_shape_set_filter(world, second, 4, 5, -7));
    OK(fe_body_get_filter(world, body, &layer, &mask, &group));
    OK(fe_shape_get_filter(world, second, &layer, &mask, &group));
    assert_true(layer == 4 && mask == 5 && group == -7);
    REFUSES(world, FE_ERROR_STATE, fe_body_get_filter(world, empty, &layer, &mask, &group));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_filter(world, empty, 1, 1, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_filter(world, second, 3, 5, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_filter(world, body, NULL, &mask, &group));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_filter(world, body, &layer, &mask, NULL));
    OK(fe_world_destroy(world));
}

static void ignored_pairs_are_read(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body a = new_box(world, 0, 0, 0), b = new_box(world, 5, 0, 0);
    int32_t ignored = 7;
    OK(fe_world_get_ignored(world, a, b, &ignored));
    assert_int_equal(ignored, 0);
    OK(fe_world_ignore_collision(world, b, a, 1));
    OK(fe_world_get_ignored(world, a, b, &ignored));
    assert_int_equal(ignored, 1);
    OK(fe_world_ignore_collision(world, a, b, 0));
    OK(fe_world_get_ignored(world, a, b, &ignored));
    assert_int_equal(ignored, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_ignored(world, a, a, &ignored));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_ignored(world, a, b, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_world_get_ignored(world, a, 0, &ignored));
    OK(fe_world_destroy(world));
}

// ---- the pair filter -----------------------------------------------------------------------------------------------

typedef struct judge {
    fe_world *world;
    uint64_t denies; // shape user data
    int32_t calls, stepping;
    uint64_t order;
} judge;

static int32_t decide(void *user, const fe_filter_pair *pair)
{
    judge *j = user;
    fe_transform t = fe_make_transform(0, 0, 0);
    j->calls += 1;
    j->order = 31 * j->order + 7 * pair->shape_user_data_a + pair->shape_user_data_b;
    j->stepping += fe_body_set_transform(j->world, pair->body_a, &t) == FE_ERROR_STEPPING &&
                   fe_body_get_transform(j->world, pair->body_a, &t) == FE_ERROR_STEPPING;
    return pair->shape_user_data_a != j->denies && pair->shape_user_data_b != j->denies;
}

static fe_body judged_box(fe_world *world, double y, uint64_t name)
{
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, y, 0);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.pair_filter = 1;
    def.user_data = name;
    fe_geometry geometry;
    fe_geometry_box(&geometry, 0.5f, 0.5f, 0.5f);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, &geometry, &shape));
    return body;
}

static double height(const fe_world *world, fe_body body)
{
    fe_transform t;
    OK(fe_body_get_transform(world, body, &t));
    return t.position.y;
}

// One box is let through the ground, the other stands on it. Each pair is asked for once while its bounds meet.
static void the_pair_filter_judges_each_new_pair_once(void **state)
{
    (void)state;
    fe_world *world = new_world();
    judge j = {.world = world, .denies = 2};
    OK(fe_world_set_pair_filter(world, decide, &j));
    new_ground(world);
    fe_body stands = judged_box(world, 0.5, 1), falls = judged_box(world, 3, 2);
    for (int i = 0; i < 60; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    assert_int_equal(
        j.calls,
        3); // box 1 and ground, box 2 and box 1, box 2 and ground: each once, although they meet for many steps
    for (int i = 0; i < 30; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    assert_int_equal(j.calls, 3);
    assert_int_equal(j.stepping, 3);
    assert_true(fabs(height(world, stands) - 0.5) < 0.005);
    assert_true(height(world, falls) < -3.0); // 1.5 s of free fall: 11 m
    OK(fe_world_destroy(world));
}

// What was refused is judged anew when a filter of either is set; without a filter of the world all meet.
static void a_refusal_ends_with_the_filter(void **state)
{
    (void)state;
    fe_world *world = new_world();
    judge j = {.world = world, .denies = 1};
    OK(fe_world_set_pair_filter(world, decide, &j));
    fe_body a = judged_box(world, 0, 1), b = judged_box(world, 0.9, 2);
    fe_shape shape;
    assert_int_equal(fe_body_get_shapes(world, b, &shape, 1), 1);
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, a, NULL, 0, 0), 0);
    j.denies = 99;
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, a, NULL, 0, 0), 0);
    OK(fe_shape_set_filter(world, shape, 2, UINT32_MAX, 0));
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, a, NULL, 0, 0), 1);
    assert_int_equal(j.calls, 2);
    int32_t enabled = 0;
    OK(fe_shape_get_pair_filter(world, shape, &enabled));
    assert_int_equal(enabled, 1);
    OK(fe_shape_set_pair_filter(world, shape, 0));
    OK(fe_shape_get_pair_filter(world, shape, &enabled));
    assert_int_equal(enabled, 0);
    OK(fe_world_set_pair_filter(world, NULL, NULL));
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, a, NULL, 0, 0), 1);
    OK(fe_shape_set_pair_filter(world, shape, 1));
    j.denies = 1;
    OK(fe_world_set_pair_filter(world, decide, &j)); // it judges new pairs: this one goes on
    OK(fe_world_step(world, 0.0f));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_pair_filter(world, shape, 2));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_pair_filter(world, shape, NULL));
    fe_body c = judged_box(world, -0.9, 1);
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, c, NULL, 0, 0), 0);
    OK(fe_world_set_pair_filter(world, NULL, NULL)); // what it refused is new again
    OK(fe_world_step(world, 0.0f));
    assert_int_equal(fe_body_get_contacts(world, c, NULL, 0, 0), 1);
    assert_int_equal(fe_world_set_pair_filter(NULL, decide, &j), FE_ERROR_ARGUMENT);
    OK(fe_world_destroy(world));
}

// ---- one-way shapes ------------------------------------------------------------------------------------------------

static fe_shape new_platform(fe_world *world, int32_t one_way)
{
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 2, 0);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.one_way = one_way;
    fe_geometry geometry;
    fe_geometry_box(&geometry, 3, 0.1f, 3);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, &geometry, &shape));
    return shape;
}

// Thrown up at 9 m/s from y = 0.5 a body would reach 0.5 + 81 / (2 g) = 4.6 m: it passes a one-way floor from below and
// stands on it afterwards; an ordinary one holds it down.
static void a_one_way_floor_lets_pass_from_below(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; ++kind)
        for (int one_way = 0; one_way < 2; ++one_way) {
            fe_world *world = new_world();
            new_ground(world);
            new_platform(world, one_way);
            fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0.5, 0);
            if (kind)
                add_sphere(world, body, 0.3f);
            else
                add_box(world, body, 0.3f);
            OK(fe_body_set_linear_velocity(world, body, &(fe_vec3){0, 9, 0}));
            double highest = 0;
            for (int i = 0; i < 180; ++i) {
                OK(fe_world_step(world, 1.0f / 60.0f));
                highest = fmax(highest, height(world, body));
            }
            if (one_way) {
                assert_true(fabs(highest - 4.6) < 0.1); // the discrete flight is g h v / 2 lower
                assert_true(fabs(height(world, body) - 2.4) < 0.005);
            } else {
                assert_true(highest < 1.7);
                assert_true(fabs(height(world, body) - 0.3) < 0.005);
            }
            OK(fe_world_destroy(world));
        }
}

// Fast enough to pass both faces within a step: 100 m/s are 1.7 m
static void continuous_collision_knows_one_way_floors(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_platform(world, 1);
    fe_body up = new_body(world, FE_BODY_DYNAMIC, -1, 0, 0), down = new_body(world, FE_BODY_DYNAMIC, 1, 6, 0);
    add_sphere(world, up, 0.1f), add_sphere(world, down, 0.1f);
    OK(fe_body_set_linear_velocity(world, up, &(fe_vec3){0, 100, 0}));
    OK(fe_body_set_linear_velocity(world, down, &(fe_vec3){0, -100, 0}));
    for (int i = 0; i < 6; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    assert_true(height(world, up) > 9.0);
    assert_true(height(world, down) > 2.1);
    OK(fe_world_destroy(world));
}

static void one_way_is_read_as_it_was_set(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_shape shape = new_platform(world, 0), plane;
    fe_body ground = new_ground(world);
    assert_int_equal(fe_body_get_shapes(world, ground, &plane, 1), 1);
    int32_t enabled = 5;
    fe_vec3 direction;
    OK(fe_shape_get_one_way(world, shape, &enabled, &direction));
    assert_true(enabled == 0 && direction.x == 0 && direction.y == 1 && direction.z == 0);
    OK(fe_shape_set_one_way(world, shape, 1, &(fe_vec3){0, 0, -2}));
    OK(fe_shape_set_one_way(world, shape, 1, NULL));
    OK(fe_shape_get_one_way(world, shape, &enabled, &direction));
    assert_true(enabled == 1 && direction.z == -2);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_one_way(world, shape, 1, &(fe_vec3){0, 0, 0}));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_one_way(world, shape, 2, NULL));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_one_way(world, plane, 1, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_one_way(world, shape, NULL, &direction));
    OK(fe_world_destroy(world));
}

// ---- materials -----------------------------------------------------------------------------------------------------

static fe_material material(float friction, float restitution, int32_t combine)
{
    fe_material m;
    fe_material_init(&m);
    m.static_friction = m.dynamic_friction = friction;
    m.restitution = restitution;
    m.friction_combine = m.restitution_combine = combine;
    return m;
}

// A sphere without rotation slides over the ground for 0.5 s: it loses mu g t. Restitution e returns e v.
static double loss_on_ground(fe_material a, fe_material b)
{
    fe_world *world = new_world();
    fe_body ground = new_ground(world), box = new_body(world, FE_BODY_DYNAMIC, 0, 0.5, 0);
    fe_shape floor, shape = add_box(world, box, 0.5f);
    assert_int_equal(fe_body_get_shapes(world, ground, &floor, 1), 1);
    OK(fe_shape_set_material(world, floor, &a));
    OK(fe_shape_set_material(world, shape, &b));
    OK(fe_body_set_locks(world, box, 0, FE_AXIS_ALL));
    for (int i = 0; i < 30; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    OK(fe_body_set_linear_velocity(world, box, &(fe_vec3){8, 0, 0}));
    for (int i = 0; i < 30; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    fe_vec3 v;
    OK(fe_body_get_linear_velocity(world, box, &v));
    OK(fe_world_destroy(world));
    return (8.0 - (double)v.x) / (9.81 * 0.5);
}

// The pair uses the higher mode of the two
static void friction_mixes_by_the_higher_mode(void **state)
{
    (void)state;
    const double a = 0.2, b = 0.8;
    const double expected[] = {sqrt(a * b), 0.5 * (a + b), a, a * b, b};
    for (int32_t i = 0; i < 5; ++i)
        for (int32_t k = 0; k < 5; ++k) {
            double mu = loss_on_ground(material((float)a, 0, i), material((float)b, 0, k));
            assert_true(fabs(mu - expected[i > k ? i : k]) < 0.01);
        }
}

static double bounce(fe_material a, fe_material b)
{
    fe_world *world = new_world();
    fe_body ground = new_ground(world), ball = new_body(world, FE_BODY_DYNAMIC, 0, 1.5, 0);
    fe_shape floor, shape = add_sphere(world, ball, 0.5f);
    assert_int_equal(fe_body_get_shapes(world, ground, &floor, 1), 1);
    OK(fe_shape_set_material(world, floor, &a));
    OK(fe_shape_set_material(world, shape, &b));
    double top = 0;
    int32_t rises = 0;
    for (int i = 0; i < 90; ++i) {
        OK(fe_world_step(world, 1.0f / 60.0f));
        fe_vec3 v;
        OK(fe_body_get_linear_velocity(world, ball, &v));
        rises |= v.y > 0;
        if (rises) top = fmax(top, height(world, ball) - 0.5);
    }
    OK(fe_world_destroy(world));
    return sqrt(top); // of 1 m: e
}

static void restitution_mixes_by_the_higher_mode(void **state)
{
    (void)state;
    const double a = 0.5, b = 0.8;
    const double expected[] = {b, 0.5 * (a + b), a, a * b, b};
    for (int32_t i = 0; i < 5; ++i)
        assert_true(fabs(bounce(material(0.5f, (float)a, i), material(0.5f, (float)b, FE_COMBINE_DEFAULT)) -
                         expected[i]) < 0.02);
}

static void bad_materials_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_shape shape = add_box(world, new_body(world, FE_BODY_DYNAMIC, 0, 0, 0), 0.5f);
    fe_material m = material(0.5f, 0, FE_COMBINE_MAXIMUM + 1);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_material(world, shape, &m));
    SAYS("friction_combine is 5, must be 0..4");
    m = material(0.5f, 0, 0);
    m.reserved[2] = 1;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_material(world, shape, &m));
    m.reserved[2] = 0, m.user_id = UINT64_MAX;
    OK(fe_shape_set_material(world, shape, &m));
    fe_material read;
    OK(fe_shape_get_material(world, shape, &read));
    assert_memory_equal(&read, &m, sizeof m);
    fe_hit hit;
    HIT(fe_world_raycast(world, &(fe_dvec3){0, 9, 0}, &(fe_dvec3){0, -20, 0}, NULL, &hit));
    FE_TRUE(hit.material == UINT64_MAX && hit.part == -1 && hit.triangle == -1);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_group_of_both_decides_and_layers_otherwise),
        cmocka_unit_test(a_filter_is_read_as_it_was_set),
        cmocka_unit_test(ignored_pairs_are_read),
        cmocka_unit_test(the_pair_filter_judges_each_new_pair_once),
        cmocka_unit_test(a_refusal_ends_with_the_filter),
        cmocka_unit_test(a_one_way_floor_lets_pass_from_below),
        cmocka_unit_test(continuous_collision_knows_one_way_floors),
        cmocka_unit_test(one_way_is_read_as_it_was_set),
        cmocka_unit_test(friction_mixes_by_the_higher_mode),
        cmocka_unit_test(restitution_mixes_by_the_higher_mode),
        cmocka_unit_test(bad_materials_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
