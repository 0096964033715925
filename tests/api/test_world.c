// The API of worlds: definitions, settings, the step and who may call during one, memory that runs out.
#include "api/api_test.h"
#include "core/memory.h"

#include <fenv.h>
#include <stdlib.h>

// ---- creation ------------------------------------------------------------------------------------------------------

static void defaults_are_those_of_the_header(void **state)
{
    (void)state;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    assert_true(def.worker_count == 1 && def.substeps == 8 && def.simd == FE_SIMD_AUTO);
    FE_NEAR(def.gravity.y, -9.81f, 0);
    fe_world_def_init(NULL, sizeof def);
    fe_world *world = new_world();
    int32_t substeps;
    fe_vec3 gravity;
    uint64_t data = 9;
    OK(fe_world_get_substeps(world, &substeps));
    OK(fe_world_get_gravity(world, &gravity));
    OK(fe_world_get_user_data(world, &data));
    assert_int_equal(substeps, 8);
    FE_NEAR(gravity.y, -9.81f, 0);
    assert_true(data == 0);
    OK(fe_world_destroy(world));
}

static void *allocate(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    return fe__aligned_allocate((size_t)size, (size_t)alignment);
}

static void give_back(void *user, void *memory, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(memory);
}

static void run_here(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    for (int32_t i = count - 1; i >= 0; --i) task(argument, i);
}

static void a_bad_definition_is_refused(void **state)
{
    (void)state;
    fe_world_def good, bad;
    fe_world *world = NULL;
    fe_world_def_init(&good, sizeof good);
    fe_allocator allocator = {.struct_size = sizeof allocator, .allocate = allocate, .release = give_back},
                 lame = allocator;
    fe_task_system tasks = {.struct_size = sizeof tasks, .worker_count = 2, .run = run_here}, idle = tasks;
#define REFUSED_WITH(change)                                         \
    bad = good;                                                      \
    change;                                                          \
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_create(&bad, &world)); \
    assert_null(world)
    REFUSED_WITH(bad.worker_count = 0);
    REFUSED_WITH(bad.worker_count = 65);
    REFUSED_WITH(bad.gravity.x = NOT_A_NUMBER);
    REFUSED_WITH(bad.substeps = 0);
    REFUSED_WITH(bad.substeps = 65);
    REFUSED_WITH(bad.simd = 17);
    REFUSED_WITH(bad.simd = -1);
    REFUSED_WITH(bad.struct_size = 1);
    lame.release = NULL;
    REFUSED_WITH(bad.allocator = &lame);
    lame = allocator, lame.allocate = NULL;
    REFUSED_WITH(bad.allocator = &lame);
    lame = allocator, lame.struct_size = 0;
    REFUSED_WITH(bad.allocator = &lame);
    lame = allocator, lame.reserved = 1;
    REFUSED_WITH(bad.allocator = &lame);
    idle.run = NULL;
    REFUSED_WITH(bad.tasks = &idle);
    idle = tasks, idle.worker_count = 0;
    REFUSED_WITH(bad.tasks = &idle);
#undef REFUSED_WITH
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_create(&good, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_destroy(NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_step(NULL, 0));
#if defined(__x86_64__)
    good.simd = FE_SIMD_NEON;
    REFUSES(NULL, FE_ERROR_UNSUPPORTED, fe_world_create(&good, &world));
#endif
}

static void an_older_definition_gets_the_defaults(void **state)
{
    (void)state;
    fe_world_def def;
    memset(&def, 0xFF, sizeof def);
    fe_world_def_init(&def, offsetof(fe_world_def, substeps));
    def.gravity.y = -1;
    fe_world *world;
    OK(fe_world_create(&def, &world));
    int32_t substeps;
    fe_vec3 gravity;
    OK(fe_world_get_substeps(world, &substeps));
    OK(fe_world_get_gravity(world, &gravity));
    assert_int_equal(substeps, 8);
    FE_NEAR(gravity.y, -1, 0);
    OK(fe_world_destroy(world));
}

// ---- settings ------------------------------------------------------------------------------------------------------

static void settings_are_read_back_and_refuse_nonsense(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_vec3 moon = {0, -1.62f, 0}, bad = {0, NOT_A_NUMBER, 0}, got;
    int32_t substeps;
    OK(fe_world_set_gravity(world, &moon));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_gravity(world, &bad));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_gravity(world, NULL));
    OK(fe_world_get_gravity(world, &got));
    FE_NEAR(got.y, -1.62f, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_gravity(world, NULL));
    OK(fe_world_set_substeps(world, 64));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_substeps(world, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_substeps(world, 65));
    OK(fe_world_get_substeps(world, &substeps));
    assert_int_equal(substeps, 64);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_substeps(world, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_user_data(world, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_hash(world, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_profile(world, NULL));
    fe_profile profile = {.struct_size = 5};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_profile(world, &profile));
    OK(fe_world_optimize(world));
    OK(fe_world_destroy(world));
}

static void tuning_is_read_back_and_refuses_nonsense(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_world_tuning good, bad, got = {.struct_size = sizeof got};
    fe_world_tuning_init(&good, sizeof good);
    FE_NEAR(good.contact_hertz, 30, 0), FE_NEAR(good.contact_damping_ratio, 10, 0),
        FE_NEAR(good.contact_push_speed, 3, 0);
    FE_NEAR(good.joint_hertz, 60, 0), FE_NEAR(good.joint_damping_ratio, 2, 0),
        FE_NEAR(good.restitution_threshold, 1, 0);
    FE_NEAR(good.hit_event_threshold, 1, 0), FE_NEAR(good.sleep_time, 0.5, 0),
        FE_NEAR(good.speculative_distance, 0.02f, 0);
    FE_NEAR(good.max_linear_speed, 4000, 0);
#define REFUSED_WITH(change) \
    bad = good;              \
    change;                  \
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_tuning(world, &bad))
    REFUSED_WITH(bad.contact_hertz = 0);
    REFUSED_WITH(bad.contact_damping_ratio = -1);
    REFUSED_WITH(bad.contact_push_speed = NOT_A_NUMBER);
    REFUSED_WITH(bad.joint_hertz = INFINITE);
    REFUSED_WITH(bad.joint_damping_ratio = -1);
    REFUSED_WITH(bad.restitution_threshold = -1);
    REFUSED_WITH(bad.hit_event_threshold = -1);
    REFUSED_WITH(bad.sleep_time = -1);
    REFUSED_WITH(bad.speculative_distance = 0);
    REFUSED_WITH(bad.speculative_distance = 0.2f);
    REFUSED_WITH(bad.max_linear_speed = 0);
#undef REFUSED_WITH
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_tuning(world, NULL));
    good.sleep_time = 2, good.max_linear_speed = 100;
    OK(fe_world_set_tuning(world, &good));
    OK(fe_world_get_tuning(world, &got));
    assert_memory_equal(&good, &got, sizeof got);
    // an older client sets what it knows; the rest stays as it is, not as it was at first
    fe_world_tuning older;
    fe_world_tuning_init(&older, offsetof(fe_world_tuning, sleep_time));
    older.contact_hertz = 20;
    OK(fe_world_set_tuning(world, &older));
    OK(fe_world_get_tuning(world, &got));
    FE_NEAR(got.contact_hertz, 20, 0), FE_NEAR(got.sleep_time, 2, 0), FE_NEAR(got.max_linear_speed, 100, 0);
    OK(fe_world_destroy(world));
}

// Contacts are made up to the speculative distance: a box 80 mm above the ground, made while it was 20 mm, has one when
// it becomes 100 mm.
static void a_longer_speculative_distance_finds_what_is_there(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_vec3 none = {0, 0, 0};
    OK(fe_world_set_gravity(world, &none));
    fe_body slab = new_body(world, FE_BODY_STATIC, 0, 0, 0), box = new_body(world, FE_BODY_DYNAMIC, 0, 0.28, 0);
    add_box(world, slab, 0.1f);
    add_box(world, box, 0.1f);
    step(world, 2);
    assert_int_equal(fe_body_get_contacts(world, box, NULL, 0, 0), 0);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.speculative_distance = 0.1f;
    OK(fe_world_set_tuning(world, &tuning));
    step(world, 1);
    assert_int_equal(fe_body_get_contacts(world, box, NULL, 0, 0), 1);
    OK(fe_world_destroy(world));
}

static void another_gravity_wakes_everything(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body box = new_box(world, 0, 0.5, 0);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 0);
    fe_vec3 same, other = {0, 9.81f, 0};
    OK(fe_world_get_gravity(world, &same));
    OK(fe_world_set_gravity(world, &same));
    assert_int_equal(is_awake(world, box), 0);
    OK(fe_world_set_gravity(world, &other));
    assert_int_equal(is_awake(world, box), 1);
    step(world, 60);
    FE_TRUE(body_transform(world, box).position.y > 4); // it falls upwards: half g t^2 = 4.9 m
    OK(fe_world_destroy(world));
}

static void counters_count(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    for (int i = 0; i < 3; ++i) new_box(world, 2.0 * i, 0.5, 0);
    step(world, 2);
    fe_counters c = {.struct_size = sizeof c};
    OK(fe_world_get_counters(world, &c));
    assert_int_equal(c.struct_size, sizeof c);
    assert_int_equal(c.bodies, 4);
    assert_int_equal(c.shapes, 4);
    assert_int_equal(c.awake_bodies, 3);
    assert_int_equal(c.contacts, 3);
    assert_int_equal(c.islands, 3);
    FE_TRUE(c.simd != FE_SIMD_AUTO && c.simd_width >= 1 && c.workers == 1 && c.bytes > 0 && c.allocations > 0);
    // an older client's counters end earlier
    fe_counters old;
    memset(&old, 0x77, sizeof old);
    old.struct_size = offsetof(fe_counters, awake_bodies);
    OK(fe_world_get_counters(world, &old));
    assert_true(old.bodies == 4 && old.shapes == 4 && old.awake_bodies == 0x77777777);
    fe_profile profile = {.struct_size = sizeof profile};
    OK(fe_world_get_profile(world, &profile));
    const float stages[] = {profile.pairs,      profile.collide,  profile.islands, profile.solve,
                            profile.continuous, profile.finalize, profile.events,  profile.sleep};
    double sum = 0;
    for (int i = 0; i < 8; ++i) sum += (double)stages[i];
    for (int i = 0; i < 8; ++i) FE_WITHIN(stages[i], 0, sum);
    FE_TRUE(profile.collide > 0 && profile.solve > 0);
    FE_WITHIN(sum, 0, (double)profile.step * (1 + 1e-5));
    OK(fe_world_destroy(world));
}

// ---- two worlds ----------------------------------------------------------------------------------------------------

static void worlds_know_nothing_of_each_other(void **state)
{
    (void)state;
    fe_world *alone = new_world(), *a = new_world(), *b = new_world();
    fe_world *worlds[3] = {alone, a, b};
    for (int w = 0; w < 3; ++w) {
        new_ground(worlds[w]);
        for (int i = 0; i < 4; ++i) new_box(worlds[w], 0, 0.5 + i, 0.01 * i);
    }
    new_box(b, 0, 20, 0);
    step(alone, 30);
    for (int i = 0; i < 30; ++i) step(a, 1), step(b, 1);
    FE_TRUE(hash_of(alone) == hash_of(a));
    FE_TRUE(hash_of(alone) != hash_of(b));
    for (int w = 0; w < 3; ++w) OK(fe_world_destroy(worlds[w]));
}

static void an_ignored_pair_passes_through(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body ground = new_ground(world), box = new_box(world, 0, 0.5, 0), other = new_box(world, 3, 0.5, 0);
    step(world, 5);
    OK(fe_world_ignore_collision(world, box, ground, 1));
    OK(fe_world_ignore_collision(world, ground, box, 1)); // once more changes nothing
    step(world, 30);
    FE_TRUE(body_transform(world, box).position.y < -0.5);
    FE_NEAR(body_transform(world, other).position.y, 0.5, 0.01);
    fe_transform up = fe_make_transform(0, 0.5, 0);
    fe_vec3 rest = {0, 0, 0};
    OK(fe_body_set_transform(world, box, &up));
    OK(fe_body_set_linear_velocity(world, box, &rest));
    OK(fe_world_ignore_collision(world, ground, box, 0));
    step(world, 30);
    FE_NEAR(body_transform(world, box).position.y, 0.5, 0.01);
    // the next body in the slot collides with all
    OK(fe_world_ignore_collision(world, ground, box, 1));
    OK(fe_body_destroy(world, box));
    fe_body next = new_box(world, 0, 0.5, 0);
    assert_int_equal(next & HANDLE_SLOT, box & HANDLE_SLOT);
    step(world, 30);
    FE_NEAR(body_transform(world, next).position.y, 0.5, 0.01);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_ignore_collision(world, next, next, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_ignore_collision(world, next, ground, 2));
    REFUSES(world, FE_ERROR_STALE, fe_world_ignore_collision(world, box, ground, 1));
    REFUSES(world, FE_ERROR_STALE, fe_world_ignore_collision(world, ground, box, 1));
    OK(fe_world_destroy(world));
}

static void a_destroyed_body_is_ignored_by_nobody(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    fe_world *world = new_world();
    fe_body bodies[COUNT];
    for (int i = 0; i < COUNT; ++i) bodies[i] = new_box(world, 0.9 * i, 0, 0);
    for (int i = 0; i < COUNT; ++i) {
        for (int k = 0; k < i; ++k) OK(fe_world_ignore_collision(world, bodies[i], bodies[k], 1));
    }
    step(world, 1);
    fe_counters c = {.struct_size = sizeof c};
    OK(fe_world_get_counters(world, &c));
    assert_int_equal(c.pairs, 0);
    for (int i = 0; i < COUNT; i += 2) {
        OK(fe_body_destroy(world, bodies[i]));
        bodies[i] = new_box(world, 0.9 * i, 0, 0);
    }
    step(world, 1);
    OK(fe_world_get_counters(world, &c));
    assert_int_equal(c.contacts, COUNT - 1); // each new one overlaps both of its neighbours
    OK(fe_world_destroy(world));
}

// ---- the step ------------------------------------------------------------------------------------------------------

static void a_bad_time_step_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_box(world, 0, 1, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_step(world, -0.01f));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_step(world, 1.01f));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_step(world, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_step(world, INFINITE));
    OK(fe_world_step(world, 0));
    OK(fe_world_step(world, 1));
    OK(fe_world_destroy(world));
}

// A task system that calls back into the world while it steps, as a host by mistake would.
typedef struct intruder {
    fe_world *world;
    fe_body body;
    int32_t calls;
} intruder;

static void intrude(void *user, fe_task task, void *argument, int32_t count)
{
    intruder *in = user;
    for (int32_t i = 0; i < count; ++i) task(argument, i);
    if (!in->world || in->calls++ > 0) return;
    fe_world *world = in->world;
    fe_body body = 1;
    fe_vec3 v = {0, 0, 0};
    fe_transform t = fe_make_transform(0, 0, 0);
    fe_dvec3 from = {0, 0, 0};
    fe_hit hit;
    check_refusal(fe_world_step(world, 0.01f), FE_ERROR_STEPPING, "fe_world_step(", __FILE__, __LINE__);
    check_refusal(fe_world_destroy(world), FE_ERROR_STEPPING, "fe_world_destroy(", __FILE__, __LINE__);
    check_refusal(fe_body_create(world, NULL, &body), FE_ERROR_STEPPING, "fe_body_create(", __FILE__, __LINE__);
    assert_true(body == 0);
    check_refusal(fe_body_destroy(world, in->body), FE_ERROR_STEPPING, "fe_body_destroy(", __FILE__, __LINE__);
    check_refusal(fe_body_set_transform(world, in->body, &t), FE_ERROR_STEPPING, "fe_body_set_transform(", __FILE__,
                  __LINE__);
    check_refusal(fe_body_add_force(world, in->body, &v), FE_ERROR_STEPPING, "fe_body_add_force(", __FILE__, __LINE__);
    check_refusal(fe_world_raycast(world, &from, &from, NULL, &hit), FE_ERROR_STEPPING, "fe_world_raycast(", __FILE__,
                  __LINE__);
    check_refusal(fe_world_get_pair_events(world, NULL, 0, 0), FE_ERROR_STEPPING, "fe_world_get_pair_events(", __FILE__,
                  __LINE__);
    assert_int_equal(fe_body_is_valid(world, in->body), 1); // only looks at the handle
}

static void calls_during_a_step_are_refused(void **state)
{
    (void)state;
    intruder in = {0};
    fe_task_system tasks = {.struct_size = sizeof tasks, .worker_count = 4, .run = intrude, .user = &in};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.tasks = &tasks;
    fe_world *world, *plain = new_world();
    OK(fe_world_create(&def, &world));
    for (int i = 0; i < 300; ++i) in.body = new_box(world, 2.0 * i, 5, 0), new_box(plain, 2.0 * i, 5, 0);
    in.world = world;
    step(world, 3);
    step(plain, 3);
    FE_TRUE(in.calls > 0);
    FE_TRUE(hash_of(world) == hash_of(plain));
    OK(fe_world_destroy(world));
    OK(fe_world_destroy(plain));
}

// ---- the host's floating-point state -------------------------------------------------------------------------------

// Everything that computes, as one script. Its own arithmetic is exact, so that the mode can only show in the
// library's.
static uint64_t play_script(void)
{
    fe_world *world = new_world();
    new_ground(world);
    fe_body boxes[6];
    for (int i = 0; i < 6; ++i) boxes[i] = new_box(world, 0.25 * i, 0.5 + 1.0625 * i, 0.125 * i);
    fe_transform t = {{1.0 / 3, 9, 1.0 / 7}, {0.1f, 0.2f, 0.3f, 0.9f}};
    fe_vec3 push = {1.0f / 3, 700, -1.0f / 7};
    fe_dvec3 point = {0.3, 1.1, 0.2}, down = {0.01, -20, 0.02};
    OK(fe_body_set_transform(world, boxes[5], &t));
    add_sphere(world, boxes[4], 0.7f);
    OK(fe_body_set_mass(world, boxes[3], 333.3f));
    OK(fe_body_set_type(world, boxes[2], FE_BODY_KINEMATIC));
    OK(fe_body_set_target(world, boxes[2], &t, 0.7f));
    for (int i = 0; i < 20; ++i) {
        OK(fe_body_add_force_at(world, boxes[1], &push, &point));
        OK(fe_body_add_impulse_at(world, boxes[0], &push, &point));
        OK(fe_body_add_angular_impulse(world, boxes[5], &push));
        step(world, 1);
    }
    fe_hit hit;
    fe_vec3 velocity;
    uint64_t bits;
    uint32_t more;
    HIT(fe_world_raycast(world, &t.position, &down, NULL, &hit));
    OK(fe_body_get_point_velocity(world, boxes[1], &point, &velocity));
    memcpy(&bits, &hit.point.x, sizeof bits);
    memcpy(&more, &velocity.x, sizeof more);
    bits ^= hash_of(world) ^ more;
    OK(fe_world_destroy(world));
    return bits;
}

static void the_host_s_rounding_does_not_show(void **state)
{
    (void)state;
    const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    uint64_t got[4];
    int left[4];
    for (int i = 0; i < 4; ++i) {
        fesetround(modes[i]);
        got[i] = play_script();
        left[i] = fegetround();
    }
    fesetround(FE_TONEAREST);
    for (int i = 0; i < 4; ++i) {
        assert_true(got[i] == got[0]);
        assert_int_equal(left[i], modes[i]); // the host gets its mode back
    }
}

// ---- memory --------------------------------------------------------------------------------------------------------

typedef struct miser {
    int64_t live;
    int32_t left; // allocations until it refuses, -1: never
} miser;

static void *allocate_while_it_lasts(void *user, uint64_t size, uint64_t alignment)
{
    miser *m = user;
    if (m->left == 0) return NULL;
    if (m->left > 0) m->left -= 1;
    m->live += (int64_t)size;
    return allocate(NULL, size, alignment);
}

static void count_release(void *user, void *memory, uint64_t size)
{
    ((miser *)user)->live -= (int64_t)size;
    free(memory);
}

static fe_world *world_of(miser *m, fe_result *out_result)
{
    fe_allocator allocator = {.struct_size = sizeof allocator,
                              .allocate = allocate_while_it_lasts,
                              .release = count_release,
                              .user = m};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    fe_world *world = NULL;
    *out_result = fe_world_create(&def, &world);
    return world;
}

// Each call, when it has no memory, changes nothing; repeated with memory it does what it would have done. `left`
// counts how far the allocator goes.
static fe_result build(fe_world *world, miser *m, int32_t left, int32_t *out_failures)
{
    fe_body_def defs[40];
    fe_body bodies[40], body;
    for (int i = 0; i < 40; ++i) {
        fe_body_def_init(&defs[i], sizeof defs[i]);
        defs[i].transform.position = fe_make_dvec3(0.9 * i, 0.45, 0);
    }
#define RETRIED(call)                                                     \
    do {                                                                  \
        uint64_t before = hash_of(world);                                 \
        m->left = left;                                                   \
        fe_result first = (call);                                         \
        m->left = -1;                                                     \
        if (first == FE_OK) break;                                        \
        check_refusal(first, FE_ERROR_MEMORY, #call, __FILE__, __LINE__); \
        FE_TRUE(hash_of(world) == before);                                \
        *out_failures += 1;                                               \
        OK(call);                                                         \
    } while (0)
    fe_geometry plane, box;
    fe_shape shape;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    fe_geometry_box(&box, 0.5f, 0.5f, 0.5f);
    defs[0].type = FE_BODY_STATIC;
    RETRIED(fe_body_create(world, &defs[0], &body));
    RETRIED(fe_shape_create(world, body, NULL, &plane, &shape));
    RETRIED(fe_body_create_many(world, &defs[1], sizeof *defs, 39, bodies));
    for (int i = 0; i < 39; ++i) RETRIED(fe_shape_create(world, bodies[i], NULL, &box, &shape));
    RETRIED(fe_world_ignore_collision(world, bodies[0], bodies[1], 1));
    RETRIED(fe_body_set_type(world, bodies[2], FE_BODY_STATIC));
    RETRIED(fe_body_set_enabled(world, bodies[3], 0));
    RETRIED(fe_body_set_enabled(world, bodies[3], 1));
    RETRIED(fe_shape_set_geometry(world, shape, &box));
    for (int i = 0; i < 3; ++i) RETRIED(fe_world_step(world, 1.0f / 60));
    RETRIED(fe_world_optimize(world));
#undef RETRIED
    return FE_OK;
}

static void without_memory_nothing_changes(void **state)
{
    (void)state;
    miser reference_miser = {0, -1};
    fe_result result;
    int32_t none = 0, failures = 0, last;
    fe_world *reference = world_of(&reference_miser, &result);
    OK(result);
    build(reference, &reference_miser, -1, &none);
    assert_int_equal(none, 0);
    uint64_t expected = hash_of(reference);
    OK(fe_world_destroy(reference));
    assert_int_equal(reference_miser.live, 0);
    for (int32_t left = 0;; ++left) {
        miser m = {0, -1};
        fe_world *world = world_of(&m, &result);
        OK(result);
        last = failures;
        build(world, &m, left, &failures);
        FE_TRUE(hash_of(world) == expected);
        OK(fe_world_destroy(world));
        assert_int_equal(m.live, 0);
        if (failures == last) break; // no call of the scene allocates more often than this
    }
    FE_TRUE(failures > 20);
}

static void a_world_that_cannot_be_made_leaves_nothing(void **state)
{
    (void)state;
    for (int32_t left = 0; left < 100; ++left) {
        miser m = {0, left};
        fe_result result;
        fe_world *world = world_of(&m, &result);
        if (result == FE_OK) {
            OK(fe_world_destroy(world));
            assert_int_equal(m.live, 0);
            assert_true(left > 0);
            return;
        }
        assert_int_equal(result, FE_ERROR_MEMORY);
        assert_null(world);
        assert_int_equal(m.live, 0);
    }
    fail();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_header),
        cmocka_unit_test(a_bad_definition_is_refused),
        cmocka_unit_test(an_older_definition_gets_the_defaults),
        cmocka_unit_test(settings_are_read_back_and_refuse_nonsense),
        cmocka_unit_test(tuning_is_read_back_and_refuses_nonsense),
        cmocka_unit_test(a_longer_speculative_distance_finds_what_is_there),
        cmocka_unit_test(another_gravity_wakes_everything),
        cmocka_unit_test(counters_count),
        cmocka_unit_test(worlds_know_nothing_of_each_other),
        cmocka_unit_test(an_ignored_pair_passes_through),
        cmocka_unit_test(a_destroyed_body_is_ignored_by_nobody),
        cmocka_unit_test(a_bad_time_step_is_refused),
        cmocka_unit_test(calls_during_a_step_are_refused),
        cmocka_unit_test(the_host_s_rounding_does_not_show),
        cmocka_unit_test(without_memory_nothing_changes),
        cmocka_unit_test(a_world_that_cannot_be_made_leaves_nothing),
    };
    return cmocka_run_group_tests_name("world", tests, NULL, NULL);
}
