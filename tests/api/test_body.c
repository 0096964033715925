// The API of bodies: life, pose, type, locks, sleep, switches; each documented error.
#include "api/api_test.h"

// ---- life ----------------------------------------------------------------------------------------------------------

static void defaults_are_those_of_the_header(void **state)
{
    (void)state;
    fe_body_def def;
    memset(&def, 0xAB, sizeof def);
    fe_body_def_init(&def, sizeof def);
    assert_int_equal(def.struct_size, sizeof def);
    assert_int_equal(def.type, FE_BODY_DYNAMIC);
    FE_NEAR(def.transform.rotation.w, 1, 0);
    FE_NEAR(def.gravity_scale, 1, 0);
    FE_NEAR(def.sleep_threshold, 0.05f, 0);
    assert_true(def.awake == 1 && def.sleep_allowed == 1 && def.enabled == 1 && def.bullet == 0);
    FE_NEAR(def.linear_damping + def.angular_damping, 0, 0);
    fe_body_def_init(NULL, sizeof def); // does nothing
}

static void what_a_definition_says_is_read_back(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = FE_BODY_KINEMATIC;
    def.transform.position = fe_make_dvec3(1.1, -2.2, 3.3);
    def.linear_velocity = fe_make_vec3(1, 2, 3);
    def.angular_velocity = fe_make_vec3(4, 5, 6);
    def.linear_damping = 0.25f, def.angular_damping = 0.5f, def.gravity_scale = -2, def.sleep_threshold = 0.125f;
    def.sleep_allowed = 0, def.bullet = 1, def.user_data = 0xFFFFFFFFFFFFFFFFull;
    fe_body body;
    OK(fe_body_create(world, &def, &body));
    assert_true(body < 1ull << 53);

    int32_t type, allowed, bullet, enabled;
    float linear, angular, scale, threshold;
    uint64_t data;
    OK(fe_body_get_type(world, body, &type));
    OK(fe_body_get_damping(world, body, &linear, &angular));
    OK(fe_body_get_gravity_scale(world, body, &scale));
    OK(fe_body_get_sleep_threshold(world, body, &threshold));
    OK(fe_body_get_sleep_allowed(world, body, &allowed));
    OK(fe_body_get_bullet(world, body, &bullet));
    OK(fe_body_get_enabled(world, body, &enabled));
    OK(fe_body_get_user_data(world, body, &data));
    assert_int_equal(type, FE_BODY_KINEMATIC);
    FE_NEAR(linear, 0.25, 0), FE_NEAR(angular, 0.5, 0), FE_NEAR(scale, -2, 0), FE_NEAR(threshold, 0.125, 0);
    assert_true(allowed == 0 && bullet == 1 && enabled == 1 && data == 0xFFFFFFFFFFFFFFFFull);
    FE_NEAR(body_transform(world, body).position.y, -2.2, 0);
    FE_NEAR(body_linear_velocity(world, body).z, 3, 0);
    FE_NEAR(body_angular_velocity(world, body).x, 4, 0);
    OK(fe_world_destroy(world));
}

static void a_bad_definition_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body_def good, bad;
    fe_body body;
    fe_body_def_init(&good, sizeof good);
#define REFUSED_WITH(change)                                                   \
    do {                                                                       \
        bad = good;                                                            \
        change;                                                                \
        body = 99;                                                             \
        REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create(world, &bad, &body)); \
        assert_true(body == 0);                                                \
        assert_int_equal(fe_world_get_bodies(world, NULL, 0), 0);              \
    } while (0)
    REFUSED_WITH(bad.type = 3);
    REFUSED_WITH(bad.type = -1);
    REFUSED_WITH(bad.transform.position.x = (double)NOT_A_NUMBER);
    REFUSED_WITH(bad.transform.position.y = (double)INFINITE);
    REFUSED_WITH(bad.transform.position.z = 1e300);
    REFUSED_WITH(bad.transform.rotation.w = 0);
    REFUSED_WITH(bad.transform.rotation.x = NOT_A_NUMBER);
    REFUSED_WITH(bad.linear_velocity.x = INFINITE);
    REFUSED_WITH(bad.angular_velocity.z = NOT_A_NUMBER);
    REFUSED_WITH(bad.linear_damping = -1);
    REFUSED_WITH(bad.angular_damping = NOT_A_NUMBER);
    REFUSED_WITH(bad.gravity_scale = INFINITE);
    REFUSED_WITH(bad.sleep_threshold = -0.1f);
    REFUSED_WITH(bad.linear_locks = 8);
    REFUSED_WITH(bad.angular_locks = 0xFFFFFFFF);
    REFUSED_WITH(bad.awake = 2);
    REFUSED_WITH(bad.sleep_allowed = -1);
    REFUSED_WITH(bad.enabled = 7);
    REFUSED_WITH(bad.bullet = 2);
    REFUSED_WITH(bad.struct_size = 0);
    REFUSED_WITH(bad.struct_size = 3);
    REFUSED_WITH(bad.struct_size = 1u << 30);
#undef REFUSED_WITH
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create(world, &good, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_body_create(NULL, &good, &body));
    OK(fe_body_create(world, NULL, &body)); // the defaults
    OK(fe_world_destroy(world));
}

static void older_and_newer_definitions_are_accepted(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body;
    // an older client knows the front up to the velocities: gravity scale and the rest take the defaults, whatever lies
    // behind
    fe_body_def def;
    memset(&def, 0xFF, sizeof def);
    fe_body_def_init(&def, offsetof(fe_body_def, linear_damping));
    assert_int_equal(def.struct_size, offsetof(fe_body_def, linear_damping));
    assert_int_equal(def.user_data, 0xFFFFFFFFFFFFFFFFull); // not written: the older struct ends before it
    def.linear_velocity.x = 3;
    OK(fe_body_create(world, &def, &body));
    float scale = 0;
    OK(fe_body_get_gravity_scale(world, body, &scale));
    FE_NEAR(scale, 1, 0);
    FE_NEAR(body_linear_velocity(world, body).x, 3, 0);

    // a newer client's tail must be zero
    struct {
        fe_body_def def;
        uint64_t news[4];
    } newer;
    memset(&newer, 0xFF, sizeof newer);
    fe_body_def_init(&newer.def, sizeof newer);
    assert_true(newer.news[0] == 0 && newer.news[3] == 0);
    OK(fe_body_create(world, &newer.def, &body));
    newer.news[2] = 1;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create(world, &newer.def, &body));
    SAYS("this version knows");
    OK(fe_world_destroy(world));
}

static void many_are_created_all_or_none(void **state)
{
    (void)state;
    enum { COUNT = 5 };
    fe_world *world = new_world_of(7);
    struct {
        fe_body_def def;
        double mine;
    } defs[COUNT];
    fe_body bodies[COUNT], listed[COUNT];
    for (int i = 0; i < COUNT; ++i) {
        fe_body_def_init(&defs[i].def, sizeof defs[i].def);
        defs[i].def.transform.position.x = i;
        defs[i].mine = -1;
    }
    defs[3].def.gravity_scale = NOT_A_NUMBER;
    memset(bodies, 0xFF, sizeof bodies);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create_many(world, &defs[0].def, sizeof defs[0], COUNT, bodies));
    for (int i = 0; i < COUNT; ++i) assert_true(bodies[i] == 0);
    assert_int_equal(fe_world_get_bodies(world, NULL, 0), 0);

    defs[3].def.gravity_scale = 1;
    OK(fe_body_create_many(world, &defs[0].def, sizeof defs[0], COUNT, bodies));
    assert_int_equal(fe_world_get_bodies(world, listed, COUNT), COUNT);
    for (int i = 0; i < COUNT; ++i) {
        assert_true(listed[i] == bodies[i]);
        FE_NEAR(body_transform(world, bodies[i]).position.x, i, 0);
    }
    REFUSES(world, FE_ERROR_ARGUMENT,
            fe_body_create_many(world, &defs[0].def, 8, COUNT, bodies)); // a stride below a definition
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create_many(world, NULL, sizeof *defs, 1, bodies));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create_many(world, &defs[0].def, sizeof *defs, -1, bodies));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create_many(world, &defs[0].def, sizeof *defs, 1, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_create_many(world, &defs[0].def, 0, 1, bodies)); // a definition may grow
    OK(fe_body_create_many(world, NULL, 0, 0, NULL));

    // one after the other gives the same handles as all at once
    fe_world *other = new_world_of(7);
    for (int i = 0; i < COUNT; ++i) {
        fe_body body;
        OK(fe_body_create(other, &defs[i].def, &body));
        FE_TRUE(hash_of(other) != 0);
    }
    fe_body others[COUNT];
    OK(fe_body_create_many(other, &defs[0].def, sizeof defs[0], COUNT, others));
    OK(fe_body_create_many(world, &defs[0].def, sizeof defs[0], COUNT, bodies));
    assert_memory_equal(bodies, others, sizeof bodies);
    assert_true(hash_of(world) == hash_of(other));
    OK(fe_world_destroy(other));
    OK(fe_world_destroy(world));
}

static void many_are_destroyed_all_or_none(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bodies[3];
    for (int i = 0; i < 3; ++i) bodies[i] = new_box(world, 3.0 * i, 5, 0);
    fe_body twice[3] = {bodies[0], bodies[1], bodies[0]},
            stale[3] = {bodies[0], bodies[1], bodies[2] + NEXT_GENERATION};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_destroy_many(world, twice, 3));
    REFUSES(world, FE_ERROR_STALE, fe_body_destroy_many(world, stale, 3));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_destroy_many(world, NULL, 3));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_destroy_many(world, bodies, -3));
    assert_int_equal(fe_world_get_bodies(world, NULL, 0), 3);
    OK(fe_body_destroy_many(world, NULL, 0));
    OK(fe_body_destroy_many(world, bodies, 3)); // the refused calls left no mark
    assert_int_equal(fe_world_get_bodies(world, NULL, 0), 0);
    OK(fe_world_destroy(world));
}

static void a_handle_dies_with_its_body(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_shape shape = add_box(world, body, 1);
    fe_transform out;
    assert_int_equal(fe_body_is_valid(world, body), 1);
    OK(fe_body_destroy(world, body));
    assert_int_equal(fe_body_is_valid(world, body), 0);
    assert_int_equal(fe_shape_is_valid(world, shape), 0);
    REFUSES(world, FE_ERROR_STALE, fe_body_get_transform(world, body, &out));
    SAYS("was destroyed (slot 0 is at generation 2, the handle has 1)");
    REFUSES(world, FE_ERROR_STALE, fe_body_destroy(world, body));

    // the slot lives on under another handle
    fe_body next = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    assert_true(next != body && (next & HANDLE_SLOT) == (body & HANDLE_SLOT));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_transform(world, body, &out));
    OK(fe_body_get_transform(world, next, &out));
    OK(fe_world_destroy(world));
}

static void forged_handles_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_shape shape = add_box(world, body, 1);
    float mass;
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, 0, &mass));
    SAYS("the handle of nothing");
    REFUSES(world, FE_ERROR_KIND, fe_body_get_mass(world, shape, &mass));
    SAYS("is a shape, not a body");
    REFUSES(world, FE_ERROR_KIND, fe_shape_get_density(world, body, &mass));
    SAYS("is a body, not a shape");
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, body + 1, &mass));                   // a slot that never was
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, body + 5 * NEXT_GENERATION, &mass)); // a generation to come
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, body | 1ull << 53, &mass));          // beyond 2^53
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, 0xFFFFFFFFFFFFFFFFull, &mass));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_mass(world, 1, &mass)); // no kind
    assert_int_equal(fe_body_is_valid(world, shape), 0);
    assert_int_equal(fe_body_is_valid(world, 0), 0);
    assert_int_equal(fe_body_is_valid(NULL, body), 0);
    OK(fe_world_destroy(world));
}

static void slots_are_reused_in_a_fixed_order(void **state)
{
    (void)state;
    fe_world *worlds[2] = {new_world_of(7), new_world_of(7)};
    uint64_t sums[2] = {0, 0};
    for (int w = 0; w < 2; ++w) {
        fe_body bodies[16];
        uint32_t random = 12345;
        for (int i = 0; i < 16; ++i) bodies[i] = new_body(worlds[w], FE_BODY_DYNAMIC, i, 0, 0);
        for (int i = 0; i < 1000; ++i) {
            random = random * 1664525u + 1013904223u;
            int k = (int)(random >> 28);
            OK(fe_body_destroy(worlds[w], bodies[k]));
            bodies[k] = new_body(worlds[w], FE_BODY_DYNAMIC, i, 0, 0);
            sums[w] = sums[w] * 31 + bodies[k];
        }
    }
    assert_true(sums[0] == sums[1]);
    OK(fe_world_destroy(worlds[0]));
    OK(fe_world_destroy(worlds[1]));
}

static void lives_come_and_go_in_flat_memory(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_counters counters = {.struct_size = sizeof counters};
    int64_t settled = 0;
    for (int i = 0; i < 20000; ++i) {
        fe_body body = new_box(world, i % 100, i % 7, 0);
        OK(fe_body_destroy(world, body));
        if (i != 100) continue;
        OK(fe_world_get_counters(world, &counters));
        settled = counters.bytes;
    }
    OK(fe_world_get_counters(world, &counters));
    assert_int_equal(counters.bytes, settled);
    assert_int_equal(counters.bodies, 0);
    assert_int_equal(counters.shapes, 0);
    OK(fe_world_destroy(world));
}

static void bodies_are_listed_in_the_order_of_creation(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body a = new_body(world, FE_BODY_STATIC, 0, 0, 0), b = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0),
            c = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    OK(fe_body_destroy(world, b));
    fe_body d = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0); // takes the slot of b
    fe_body out[4] = {0, 0, 0, 77};
    assert_int_equal(fe_world_get_bodies(world, out, 2), 3);
    assert_true(out[0] == a && out[1] == c && out[2] == 0);
    assert_int_equal(fe_world_get_bodies(world, out, 4), 3);
    assert_true(out[2] == d && out[3] == 77);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_bodies(world, NULL, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_bodies(world, out, -1));
    OK(fe_world_destroy(world));
}

// ---- pose ----------------------------------------------------------------------------------------------------------

static void a_pose_comes_back_bit_for_bit(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_transform set = {{1.0 / 3, -1e6 - 1.0 / 7, 1e-20}, {0.18257418f, 0.36514837f, 0.5477226f, 0.73029674f}}, got;
    OK(fe_body_set_transform(world, body, &set));
    OK(fe_body_get_transform(world, body, &got));
    assert_memory_equal(&set, &got, sizeof set);
    OK(fe_world_destroy(world));
}

static void a_rotation_of_any_length_is_normalised_once(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    const fe_quat lengths[] = {
        {1, 2, 3, 4}, {0, 0, 1e-40f, 1e-40f}, {3e38f, -3e38f, 1, 0}, {0, 0, 0, -2}, {1e-3f, 0, 0, 0.99f}};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
        fe_transform t = fe_make_transform(0, 0, 0), once, twice;
        t.rotation = lengths[i];
        OK(fe_body_set_transform(world, body, &t));
        OK(fe_body_get_transform(world, body, &once));
        double x = (double)lengths[i].x, y = (double)lengths[i].y, z = (double)lengths[i].z, w = (double)lengths[i].w;
        double length = sqrt(x * x + y * y + z * z + w * w);
        FE_NEAR(once.rotation.x, x / length, 1e-7);
        FE_NEAR(once.rotation.y, y / length, 1e-7);
        FE_NEAR(once.rotation.z, z / length, 1e-7);
        FE_NEAR(once.rotation.w, w / length, 1e-7);
        OK(fe_body_set_transform(world, body, &once));
        OK(fe_body_get_transform(world, body, &twice));
        assert_memory_equal(&once, &twice, sizeof once);
    }
    OK(fe_world_destroy(world));
}

static void a_bad_pose_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 1, 2, 3);
    fe_transform t = fe_make_transform(0, (double)NOT_A_NUMBER, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_transform(world, body, &t));
    SAYS("transform.y is NaN, must be -1e+09..1e+09");
    t = fe_make_transform(0, 0, 0), t.rotation.w = 0;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_transform(world, body, &t));
    SAYS("must be finite and not zero");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_transform(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_transform(world, body, NULL));
    fe_dvec3 centre = {7, 7, 7};
    REFUSES(world, FE_ERROR_STALE, fe_body_get_centre(world, body + NEXT_GENERATION, &centre));
    FE_NEAR(centre.x + centre.y + centre.z, 21, 0); // outputs are untouched on an error
    OK(fe_world_destroy(world));
}

// ---- type ----------------------------------------------------------------------------------------------------------

static void a_body_changes_its_type(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 10, 0);
    fe_vec3 v = {1, 2, 3};
    float mass;
    OK(fe_body_set_linear_velocity(world, body, &v));
    OK(fe_body_set_type(world, body, FE_BODY_KINEMATIC));
    OK(fe_body_get_mass(world, body, &mass));
    FE_NEAR(mass, 0, 0);
    FE_NEAR(body_linear_velocity(world, body).y, 2, 0); // goes on as it went
    assert_int_equal(is_awake(world, body), 1);
    OK(fe_body_set_type(world, body, FE_BODY_STATIC));
    FE_NEAR(body_linear_velocity(world, body).y, 0, 0);
    assert_int_equal(is_awake(world, body), 0);
    step(world, 2);
    FE_NEAR(body_transform(world, body).position.y, 10, 0);
    OK(fe_body_set_type(world, body, FE_BODY_DYNAMIC));
    OK(fe_body_get_mass(world, body, &mass));
    FE_NEAR(mass, 1000, 0); // a cube of 1 m3
    assert_int_equal(is_awake(world, body), 1);
    step(world, 10);
    FE_TRUE(body_transform(world, body).position.y < 10);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_type(world, body, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_type(world, body, NULL));
    OK(fe_world_destroy(world));
}

static void a_plane_is_static_only(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body ground = new_ground(world), box = new_box(world, 0, 1, 0);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, ground, FE_BODY_DYNAMIC));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, ground, FE_BODY_KINEMATIC));
    OK(fe_body_set_type(world, ground, FE_BODY_STATIC));
    fe_geometry plane;
    fe_shape shape = 5;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, box, NULL, &plane, &shape));
    assert_true(shape == 0);
    assert_int_equal(fe_body_get_shapes(world, box, &shape, 1), 1);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_geometry(world, shape, &plane));
    OK(fe_world_destroy(world));
}

// ---- sleep, switches -----------------------------------------------------------------------------------------------

static void a_body_starts_asleep_and_wakes_when_told(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.awake = 0;
    def.transform.position.y = 10;
    def.linear_velocity.x = 5; // a sleeper is at rest
    fe_body body;
    OK(fe_body_create(world, &def, &body));
    add_box(world, body, 0.5f); // does not wake it
    step(world, 10);
    assert_int_equal(is_awake(world, body), 0);
    FE_NEAR(body_transform(world, body).position.y, 10, 0);
    FE_NEAR(body_linear_velocity(world, body).x, 0, 0);
    fe_vec3 zero = {0, 0, 0}, up = {0, 1, 0};
    OK(fe_body_set_linear_velocity(world, body, &zero));
    OK(fe_body_add_force(world, body, &zero));
    OK(fe_body_add_impulse(world, body, &zero));
    assert_int_equal(is_awake(world, body), 0);
    OK(fe_body_add_force(world, body, &up));
    assert_int_equal(is_awake(world, body), 1);
    OK(fe_body_set_awake(world, body, 0));
    assert_int_equal(is_awake(world, body), 0);
    OK(fe_body_set_awake(world, body, 1));
    assert_int_equal(is_awake(world, body), 1);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_awake(world, body, 2));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_awake(world, body, NULL));
    OK(fe_world_destroy(world));
}

static void a_static_body_is_never_awake(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body ground = new_ground(world);
    OK(fe_body_set_awake(world, ground, 1));
    assert_int_equal(is_awake(world, ground), 0);
    OK(fe_body_set_awake(world, ground, 0));
    OK(fe_world_destroy(world));
}

static void what_changes_a_sleeper_wakes_it(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 10, 0);
    fe_shape shape;
    assert_int_equal(fe_body_get_shapes(world, body, &shape, 1), 1);
    fe_transform there = fe_make_transform(0, 20, 0);
    fe_vec3 v = {1, 0, 0}, gravity = {0, -1, 0};
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 1);
    fe_material slippery = {0};
#define WAKES(call)                            \
    do {                                       \
        OK(fe_body_set_awake(world, body, 0)); \
        OK(call);                              \
        FE_TRUE(is_awake(world, body));        \
    } while (0)
    WAKES(fe_body_set_transform(world, body, &there));
    WAKES(fe_body_set_linear_velocity(world, body, &v));
    WAKES(fe_body_set_angular_velocity(world, body, &v));
    WAKES(fe_body_add_force(world, body, &v));
    WAKES(fe_body_add_torque(world, body, &v));
    WAKES(fe_body_add_impulse(world, body, &v));
    WAKES(fe_body_add_angular_impulse(world, body, &v));
    WAKES(fe_body_set_mass(world, body, 5));
    WAKES(fe_body_reset_mass(world, body));
    WAKES(fe_body_set_locks(world, body, 1, 0));
    WAKES(fe_body_set_gravity_scale(world, body, 2));
    WAKES(fe_body_set_type(world, body, FE_BODY_KINEMATIC));
    WAKES(fe_body_set_type(world, body, FE_BODY_DYNAMIC));
    WAKES(fe_shape_set_geometry(world, shape, &sphere));
    WAKES(fe_shape_set_density(world, shape, 5));
    WAKES(fe_shape_set_material(world, shape, &slippery));
    WAKES(fe_shape_set_filter(world, shape, 2, 2, 0));
    WAKES(fe_shape_set_trigger(world, shape, 1));
    WAKES(fe_body_set_sleep_allowed(world, body, 0));
    OK(fe_body_set_sleep_allowed(world, body, 1));
    WAKES(fe_world_set_gravity(world, &gravity));
#undef WAKES
    OK(fe_world_destroy(world));
}

static void a_disabled_body_is_out_of_the_world(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body body = new_box(world, 0, 10, 0);
    fe_dvec3 from = {0, 20, 0}, down = {0, -30, 0};
    fe_hit hit;
    HIT(fe_world_raycast(world, &from, &down, NULL, &hit));
    assert_true(hit.body == body);
    OK(fe_body_set_enabled(world, body, 0));
    HIT(fe_world_raycast(world, &from, &down, NULL, &hit));
    assert_true(hit.body != body);
    fe_vec3 push = {1e6f, 0, 0};
    OK(fe_body_add_force(world, body, &push));
    OK(fe_body_set_awake(world, body, 1));
    step(world, 5);
    FE_NEAR(body_transform(world, body).position.y, 10, 0);
    assert_int_equal(is_awake(world, body), 0);
    OK(fe_body_set_enabled(world, body, 1));
    HIT(fe_world_raycast(world, &from, &down, NULL, &hit));
    assert_true(hit.body == body);
    step(world, 5);
    FE_TRUE(body_transform(world, body).position.y < 10);
    FE_NEAR(body_transform(world, body).position.x, 0, 0); // the force was not kept
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_enabled(world, body, 3));
    OK(fe_world_destroy(world));
}

static void settings_refuse_what_is_out_of_range(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 10, 0);
    float f;
    int32_t i;
    uint64_t h;
    uint32_t u;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_damping(world, body, -1, 0));
    SAYS("linear is -1, must be 0..");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_damping(world, body, 0, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_damping(world, body, NULL, &f));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_damping(world, body, &f, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_gravity_scale(world, body, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_gravity_scale(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_sleep_threshold(world, body, -1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_sleep_threshold(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_sleep_allowed(world, body, 5));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_sleep_allowed(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_bullet(world, body, -5));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_bullet(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_enabled(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_user_data(world, body, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_locks(world, body, 8, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_locks(world, body, 0, 9));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_locks(world, body, NULL, &u));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_locks(world, body, &u, NULL));
    fe_body stale = body + NEXT_GENERATION;
    REFUSES(world, FE_ERROR_STALE, fe_body_set_damping(world, stale, 0, 0));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_bullet(world, stale, &i));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_user_data(world, stale, &h));
    REFUSES(world, FE_ERROR_STALE, fe_body_set_user_data(world, stale, 1));
    REFUSES(world, FE_ERROR_STALE, fe_body_set_enabled(world, stale, 1));
    REFUSES(world, FE_ERROR_STALE, fe_body_set_awake(world, stale, 1));
    REFUSES(world, FE_ERROR_STALE, fe_body_set_type(world, stale, 1));
    OK(fe_body_set_user_data(world, body, 42));
    OK(fe_body_get_user_data(world, body, &h));
    assert_true(h == 42);
    OK(fe_body_set_bullet(world, body, 1));
    OK(fe_body_get_bullet(world, body, &i));
    assert_int_equal(i, 1);
    OK(fe_world_destroy(world));
}

// ---- shapes of a body ----------------------------------------------------------------------------------------------

static void shapes_are_listed_in_the_order_of_creation(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_shape a = add_box(world, body, 1), b = add_sphere(world, body, 1), c = add_box(world, body, 2), out[3];
    OK(fe_shape_destroy(world, b));
    fe_shape d = add_sphere(world, body, 1);
    assert_int_equal(fe_body_get_shapes(world, body, NULL, 0), 3);
    assert_int_equal(fe_body_get_shapes(world, body, out, 3), 3);
    assert_true(out[0] == a && out[1] == c && out[2] == d);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_shapes(world, body, NULL, 3));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_shapes(world, body + NEXT_GENERATION, out, 3));
    OK(fe_world_destroy(world));
}

static void a_filter_on_a_body_is_one_on_its_shapes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    REFUSES(world, FE_ERROR_STATE, fe_body_set_filter(world, body, 1, 1, 0));
    fe_shape shapes[2] = {add_box(world, body, 1), add_sphere(world, body, 1)};
    OK(fe_body_set_filter(world, body, 1u << 31, 6, -7));
    for (int i = 0; i < 2; ++i) {
        uint32_t layer = 0, mask = 0;
        int32_t group = 0;
        OK(fe_shape_get_filter(world, shapes[i], &layer, &mask, &group));
        assert_true(layer == 1u << 31 && mask == 6 && group == -7);
    }
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_filter(world, body, 0, 1, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_filter(world, body, 3, 1, 0));
    SAYS("layer is 0x3, must be exactly one bit");
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_header),
        cmocka_unit_test(what_a_definition_says_is_read_back),
        cmocka_unit_test(a_bad_definition_is_refused),
        cmocka_unit_test(older_and_newer_definitions_are_accepted),
        cmocka_unit_test(many_are_created_all_or_none),
        cmocka_unit_test(many_are_destroyed_all_or_none),
        cmocka_unit_test(a_handle_dies_with_its_body),
        cmocka_unit_test(forged_handles_are_refused),
        cmocka_unit_test(slots_are_reused_in_a_fixed_order),
        cmocka_unit_test(lives_come_and_go_in_flat_memory),
        cmocka_unit_test(bodies_are_listed_in_the_order_of_creation),
        cmocka_unit_test(a_pose_comes_back_bit_for_bit),
        cmocka_unit_test(a_rotation_of_any_length_is_normalised_once),
        cmocka_unit_test(a_bad_pose_is_refused),
        cmocka_unit_test(a_body_changes_its_type),
        cmocka_unit_test(a_plane_is_static_only),
        cmocka_unit_test(a_body_starts_asleep_and_wakes_when_told),
        cmocka_unit_test(a_static_body_is_never_awake),
        cmocka_unit_test(what_changes_a_sleeper_wakes_it),
        cmocka_unit_test(a_disabled_body_is_out_of_the_world),
        cmocka_unit_test(settings_refuse_what_is_out_of_range),
        cmocka_unit_test(shapes_are_listed_in_the_order_of_creation),
        cmocka_unit_test(a_filter_on_a_body_is_one_on_its_shapes),
    };
    return cmocka_run_group_tests_name("body", tests, NULL, NULL);
}
