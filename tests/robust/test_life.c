// test_life.c - bodies come, change and go in every order: memory stays flat, handles never alias, nothing is left
// behind.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

#include <math.h>

#ifdef FE_SANITIZED
enum { SPAWNS = 10000, ONE_BY_ONE = 3000 };
#else
enum { SPAWNS = 100000, ONE_BY_ONE = 20000 };
#endif

// What each test has: a world whose memory is counted
typedef struct life {
    play p; // first: a test's state is its play
    counting memory;
} life;

static int open_world(void **state)
{
    static life l;
    l.memory = (counting){0};
    play_begin(&l.p, counting_world(&l.memory));
    *state = &l;
    return 0;
}

// whatever happened, all memory comes back
static int close_world(void **state)
{
    life *l = *state;
    assert_int_equal(l->p.errors, 0);
    FE_TRUE(fe_world_destroy(l->p.world) == FE_OK);
    assert_int_equal(l->memory.blocks, 0);
    assert_int_equal(l->memory.bytes, 0);
    assert_int_equal(l->memory.wrong, 0);
    return 0;
}

static void step(play *p, int32_t steps)
{
    for (int32_t i = 0; i < steps; ++i) PLAY(p, fe_world_step(p->world, p->dt));
}

static int32_t counted(const fe_world *world, int32_t *out_shapes, int32_t *out_pairs)
{
    fe_counters c = {.struct_size = sizeof c};
    FE_TRUE(fe_world_get_counters(world, &c) == FE_OK);
    *out_shapes = c.shapes;
    *out_pairs = c.pairs;
    return c.bodies;
}

static void nothing_is_left(const fe_world *world)
{
    int32_t shapes, pairs;
    assert_int_equal(counted(world, &shapes, &pairs), 0);
    assert_int_equal(shapes, 0);
    assert_int_equal(pairs, 0);
}

// Every pose and velocity is a number. Positions may be far, but not infinite
static void all_is_finite(const fe_world *world, const fe_body *bodies, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_transform t = body_transform(world, bodies[i]);
        fe_vec3 v = body_linear_velocity(world, bodies[i]), w = body_angular_velocity(world, bodies[i]);
        const double all[10] = {t.position.x, t.position.y, t.position.z, (double)v.x, (double)v.y,
                                (double)v.z,  (double)w.x,  (double)w.y,  (double)w.z, (double)t.rotation.w};
        for (int k = 0; k < 10; ++k) FE_WITHIN(all[k], -1e12, 1e12);
    }
}

// ---- coming and going ----------------------------------------------------------------------------------------------

// 64 bodies at a time in a heap on the ground, the oldest replaced: slots, pairs, tree nodes and events go round
static void memory_stays_flat_over_many_spawns(void **state)
{
    play *p = *state;
    enum { ALIVE = 64, SPAWNS_PER_STEP = 16, ROUND = SPAWNS / 4 };
    part ground = part_plane(0.0f, 1.0f, 0.0f);
    play_add(p, &ground);
    for (int32_t i = 0; i < ALIVE; ++i) {
        part a = part_sphere(0.25f, 0.3 * (i % 4), 0.3 + 0.3 * (i / 16), 0.3 * (i / 4 % 4));
        play_add(p, &a);
    }
    const counting *memory = &((life *)*state)->memory;
    int64_t calls = 0;
    for (int32_t n = 0; n < SPAWNS; ++n) {
        int32_t i = 1 + n % ALIVE;
        fe_body old = p->actors[i];
        play_remove(p, i);
        part a = n % 2 ? part_sphere(0.25f, 0.3 * (i % 4), 0.3 + 0.3 * (i / 16), 0.3 * (i / 4 % 4))
                       : part_box(0.2f, 0.1f, 0.3f, 0.3 * (i % 4), 0.3 + 0.3 * (i / 16), 0.3 * (i / 4 % 4));
        play_put(p, i, &a);
        if (fe_body_is_valid(p->world, old)) fail_msg("body %llx lives after its destruction", old);
        if (n % SPAWNS_PER_STEP == 0) step(p, 1);
        if (n == ROUND) calls = memory->calls;
    }
    // the first quarter has seen every state that the rest comes back to; a few arrays may still meet a fuller moment
    FE_WITHIN(memory->calls - calls, 0, 8);
}

static void handles_of_the_dead_are_stale_for_every_call(void **state)
{
    play *p = *state;
    part ball = part_sphere(0.5f, 0.0, 1.0, 0.0);
    int32_t actor = play_add(p, &ball);
    fe_body body = p->actors[actor], listed;
    fe_shape shape = p->shapes[actor];
    fe_vec3 v = {1.0f, 2.0f, 3.0f};
    fe_transform t = fe_make_transform(0.0, 0.0, 0.0);
    play_remove(p, actor);
    // the same slot is taken again: the old handles must not mean the new body
    actor = play_add(p, &ball);
    assert_int_not_equal(p->actors[actor], body);
    uint64_t hash = play_hash(p);
    assert_int_equal(fe_body_is_valid(p->world, body), 0);
    assert_int_equal(fe_shape_is_valid(p->world, shape), 0);
    assert_int_equal(fe_body_destroy(p->world, body), FE_ERROR_STALE);
    assert_int_equal(fe_body_set_transform(p->world, body, &t), FE_ERROR_STALE);
    assert_int_equal(fe_body_get_transform(p->world, body, &t), FE_ERROR_STALE);
    assert_int_equal(fe_body_set_linear_velocity(p->world, body, &v), FE_ERROR_STALE);
    assert_int_equal(fe_body_add_impulse(p->world, body, &v), FE_ERROR_STALE);
    assert_int_equal(fe_body_set_type(p->world, body, FE_BODY_STATIC), FE_ERROR_STALE);
    assert_int_equal(fe_body_get_shapes(p->world, body, NULL, 0), FE_ERROR_STALE);
    assert_int_equal(fe_body_get_contacts(p->world, body, NULL, 0, 0), FE_ERROR_STALE);
    assert_int_equal(fe_shape_create(p->world, body, &ball.shape, &ball.geometry, &shape), FE_ERROR_STALE);
    assert_int_equal(fe_shape_set_density(p->world, shape, 1.0f), FE_ERROR_STALE);
    assert_int_equal(fe_shape_destroy(p->world, shape), FE_ERROR_STALE);
    assert_int_equal(fe_world_set_transforms(p->world, &body, &t, 0, 1), FE_ERROR_STALE);
    assert_int_equal(fe_world_ignore_collision(p->world, p->actors[actor], body, 1), FE_ERROR_STALE);
    FE_TRUE(hash == play_hash(p));
    assert_int_equal(fe_world_get_bodies(p->world, &listed, 1), 1);
    FE_TRUE(listed == p->actors[actor]);
}

// A generation a life: a slot gives no handle twice, over more lives than 16 bits count
static void a_slot_never_gives_a_handle_twice(void **state)
{
    play *p = *state;
    enum { LIVES = 70000 };
    fe_body first = 0, last = 0;
    for (int32_t i = 0; i < LIVES; ++i) {
        fe_body body;
        PLAY(p, fe_body_create(p->world, NULL, &body));
        if (i == 0) first = body;
        FE_TRUE(i == 0 || body > last); // the generation lies above the slot's bits
        FE_TRUE(body < UINT64_C(1) << 53);
        last = body;
        PLAY(p, fe_body_destroy(p->world, body));
    }
    assert_int_equal(fe_body_is_valid(p->world, first), 0);
    nothing_is_left(p->world);
}

static void a_world_without_bodies_steps(void **state)
{
    play *p = *state;
    step(p, 10);
    p->dt = 0.0f;
    step(p, 10);
    fe_body body;
    for (int32_t i = 0; i < 10; ++i) {
        PLAY(p, fe_body_create(p->world, NULL, &body)); // without shapes
        step(p, 3);
        PLAY(p, fe_body_destroy(p->world, body));
        step(p, 1);
    }
    assert_int_equal(fe_world_get_pair_events(p->world, NULL, 0, 0), 0);
    nothing_is_left(p->world);
}

// a whole scene goes at once, in three orders, and comes again: the second life is the first one again
static void all_bodies_can_be_removed_and_come_back(void **state)
{
    play *p = *state;
    for (int32_t order = 0; order < 3; ++order) {
        static fe_body bodies[400];
        fe_world *world = p->world;
        play_begin(p, world);
        play_until(p, &script_mixed, 70);
        int32_t count = fe_world_get_bodies(p->world, bodies, 400), exits = 0;
        assert_int_equal(count, p->actor_count);
        if (order == 0)
            PLAY(p, fe_body_destroy_many(p->world, bodies, count));
        else
            for (int32_t i = 0; i < count; ++i)
                PLAY(p, fe_body_destroy(p->world, bodies[order == 1 ? count - 1 - i : (i * 11) % count]));
        nothing_is_left(p->world);
        step(p, 1);
        fe_pair_event events[4];
        exits = fe_world_get_pair_events(p->world, events, sizeof *events, 4);
        assert_in_range(exits, 10, 10000); // the exits of what touched
        assert_int_equal(events[0].kind, FE_EVENT_EXIT);
        assert_int_equal(fe_body_is_valid(p->world, events[0].body_b), 0);
        step(p, 1);
        assert_int_equal(fe_world_get_pair_events(p->world, NULL, 0, 0), 0);
    }
}

static void thousands_can_be_created_one_by_one(void **state)
{
    play *p = *state;
    static fe_body bodies[ONE_BY_ONE];
    part ground = part_plane(0.0f, 1.0f, 0.0f);
    play_add(p, &ground);
    // in rows, as levels are built: the worst order for a tree that is only inserted into
    for (int32_t i = 0; i < ONE_BY_ONE; ++i) {
        part a = part_sphere(0.4f, 1.0 * i, 0.4, 0.0);
        a.body.awake = 0;
        fe_shape shape;
        PLAY(p, fe_body_create(p->world, &a.body, bodies + i));
        PLAY(p, fe_shape_create(p->world, bodies[i], &a.shape, &a.geometry, &shape));
    }
    step(p, 3);
    fe_dvec3 origin = {ONE_BY_ONE - 1.0, 10.0, 0.0}, down = {0.0, -20.0, 0.0};
    fe_hit hit;
    assert_int_equal(fe_world_raycast(p->world, &origin, &down, NULL, &hit), 1);
    FE_TRUE(hit.body == bodies[ONE_BY_ONE - 1]);
    assert_int_equal(fe_world_get_body_events(p->world, NULL, 0, 0), 0); // all slept on
    PLAY(p, fe_body_destroy_many(p->world, bodies, ONE_BY_ONE));
    step(p, 1);
}

// ---- changes -------------------------------------------------------------------------------------------------------

enum { TWINS = 9 }; // pairs of bodies, actors 1 + 2 k and 2 + 2 k

static double apart(const play *p, int32_t k)
{
    fe_dvec3 a = body_transform(p->world, p->actors[1 + 2 * k]).position,
             b = body_transform(p->world, p->actors[2 + 2 * k]).position;
    return sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y) + (b.z - a.z) * (b.z - a.z));
}

// m, of a body in what it touches
static double deepest(const play *p, int32_t actor)
{
    fe_contact contacts[8];
    int32_t count = fe_body_get_contacts(p->world, p->actors[actor], contacts, sizeof *contacts, 8);
    double most = 0.0;
    assert_in_range(count, 1, 8);
    for (int32_t i = 0; i < count; ++i)
        for (int32_t k = 0; k < contacts[i].point_count; ++k)
            most = fmax(most, -(double)contacts[i].points[k].separation);
    return most;
}

// Pushed out no faster than contact_push_speed, 3 m/s, and never stuck or thrown
static void a_body_born_inside_another_gets_out(void **state)
{
    play *p = *state;
    part ground = part_static_box(20.0f, 1.0f, 20.0f, 0.0, -1.0, 0.0);
    play_add(p, &ground);
    for (int32_t k = 0; k < TWINS; ++k) {
        double x = 3.0 * (k - 4);
        part a = part_box(0.5f, 0.5f, 0.5f, x, 0.5, 0.0);
        part b = k % 3 == 0   ? part_box(0.5f, 0.5f, 0.5f, x, 0.5, 0.0)
                 : k % 3 == 1 ? part_sphere(0.3f, x, 0.5, 0.0)
                              : part_capsule(0.2f, 0.2f, x + 0.1, 0.6, 0.1);
        play_add(p, &a);
        play_add(p, &b);
    }
    double before[TWINS];
    for (int32_t k = 0; k < TWINS; ++k) before[k] = apart(p, k);
    for (int32_t i = 0; i < 240; ++i) {
        step(p, 1);
        all_is_finite(p->world, p->actors, p->actor_count);
        for (int32_t k = 0; k < TWINS && i == 0; ++k)
            FE_WITHIN(apart(p, k) - before[k], 0.5 * 3.0 * (double)p->dt, 1.01 * 3.0 * (double)p->dt);
        for (int32_t k = 1; k < p->actor_count; ++k) {
            fe_dvec3 at = body_transform(p->world, p->actors[k]).position;
            FE_WITHIN(at.y, 0.1, 2.0); // one on the other, thrown up at 3 m/s: 1.5 m and 0.46 m
        }
    }
    // A metre closes at 3 m/s to a third, then by 9 a second, w / (2 zeta + h w) of the contacts' spring; what stands
    // sleeps after half a second
    for (int32_t k = 1; k < p->actor_count; ++k) FE_WITHIN(deepest(p, k), 0.0, 0.05);
}

static void types_and_shapes_change_between_steps(void **state)
{
    play *p = *state;
    part ground = part_static_box(20.0f, 1.0f, 20.0f, 0.0, -1.0, 0.0);
    play_add(p, &ground);
    for (int32_t i = 0; i < 12; ++i) {
        part a = part_box(0.4f, 0.3f, 0.35f, 0.2 * (i % 2), 0.3 + 0.6 * i, 0.0);
        a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT;
        play_add(p, &a);
    }
    for (int32_t i = 0; i < 200; ++i) {
        int32_t k = 1 + (i * 5) % 12;
        part other = i % 2 ? part_sphere(0.35f, 0.0, 0.0, 0.0) : part_capsule(0.2f, 0.25f, 0.0, 0.0, 0.0);
        PLAY(p, fe_body_set_type(p->world, p->actors[k], i % 3));
        if (i % 4 == 1) PLAY(p, fe_shape_set_geometry(p->world, p->shapes[k], &other.geometry));
        if (i % 7 == 2) PLAY(p, fe_shape_set_trigger(p->world, p->shapes[k], i % 2));
        if (i % 5 == 3) PLAY(p, fe_body_set_enabled(p->world, p->actors[k], i % 3 == 0));
        step(p, 1);
        all_is_finite(p->world, p->actors, p->actor_count);
    }
}

static int32_t awake(const fe_world *world, fe_body body)
{
    int32_t is_awake = -1;
    FE_TRUE(fe_body_get_awake(world, body, &is_awake) == FE_OK);
    return is_awake;
}

// Slower than every sleep threshold, but moving: its load is carried along, and sleeps when it stops
static void what_rests_on_a_moving_platform_stays_awake(void **state)
{
    play *p = *state;
    part platform = part_box(2.0f, 0.1f, 2.0f, 0.0, 0.0, 0.0), load = part_box(0.3f, 0.3f, 0.3f, 0.0, 0.4, 0.0);
    platform.body.type = FE_BODY_KINEMATIC;
    platform.body.linear_velocity.x = 0.02f; // m/s
    int32_t below = play_add(p, &platform), above = play_add(p, &load);
    step(p, 240);
    assert_int_equal(awake(p->world, p->actors[above]), 1);
    assert_int_equal(fe_body_set_awake(p->world, p->actors[above], 0), FE_ERROR_STATE);
    double offset =
        body_transform(p->world, p->actors[above]).position.x - body_transform(p->world, p->actors[below]).position.x;
    FE_NEAR(offset, 0.0, 0.002); // it slips until its speed is that of the platform: v^2 / (2 mu g), far below
    const fe_vec3 still = {0.0f, 0.0f, 0.0f};
    PLAY(p, fe_body_set_linear_velocity(p->world, p->actors[below], &still));
    step(p, 60);
    assert_int_equal(awake(p->world, p->actors[above]), 0);
    assert_int_equal(awake(p->world, p->actors[below]), 0);
    const fe_vec3 up = {0.0f, 0.01f, 0.0f};
    PLAY(p, fe_body_set_linear_velocity(p->world, p->actors[below], &up));
    assert_int_equal(awake(p->world, p->actors[above]), 1);
}

static void without_a_sleep_time_only_slow_bodies_sleep(void **state)
{
    play *p = *state;
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_time = 0.0f;
    PLAY(p, fe_world_set_tuning(p->world, &tuning));
    part falling = part_sphere(0.5f, 0.0, 10.0, 0.0), floating = part_sphere(0.5f, 3.0, 10.0, 0.0);
    floating.body.gravity_scale = 0.0f;
    int32_t a = play_add(p, &falling), b = play_add(p, &floating);
    step(p, 1);
    assert_int_equal(awake(p->world, p->actors[a]), 1);
    assert_int_equal(awake(p->world, p->actors[b]), 0);
    step(p, 30);
    assert_int_equal(awake(p->world, p->actors[a]), 1);
}

// Far away and back, into the ground, onto another: poses are exactly where they were put before the next step
static void teleports_between_steps(void **state)
{
    play *p = *state;
    part ground = part_static_box(20.0f, 1.0f, 20.0f, 0.0, -1.0, 0.0);
    play_add(p, &ground);
    for (int32_t i = 0; i < 8; ++i) {
        part a = part_box(0.3f, 0.3f, 0.3f, 1.0 * i, 0.3, 0.0);
        play_add(p, &a);
    }
    const fe_dvec3 places[4] = {{1e6, 1e6, -1e6}, {0.0, 0.3, 0.0}, {3.0, -0.9, 0.1}, {-1e9, 0.0, 1e9}};
    for (int32_t i = 0; i < 120; ++i) {
        fe_transform there = fe_make_transform(places[i % 4].x, places[i % 4].y, places[i % 4].z);
        PLAY(p, fe_body_set_transform(p->world, p->actors[1 + i % 8], &there));
        fe_dvec3 now = body_transform(p->world, p->actors[1 + i % 8]).position;
        FE_TRUE(now.x == there.position.x && now.y == there.position.y && now.z == there.position.z);
        step(p, 1);
        all_is_finite(p->world, p->actors, p->actor_count);
    }
}

// What entered has left: pairs in the order of their events, while bodies are destroyed, disabled and filtered as the
// events are read
static void events_balance_when_bodies_go_in_the_event_loop(void **state)
{
    play *p = *state;
    enum { MOST = 4096 };
    static fe_pair_event events[MOST];
    int64_t enters = 0, exits = 0;
    play_until(p, &script_mixed, 1);
    for (int32_t i = 0; i < 200; ++i) {
        int32_t count = fe_world_get_pair_events(p->world, events, sizeof *events, MOST);
        assert_in_range(count, 0, MOST);
        for (int32_t k = 0; k < count; ++k) {
            enters += events[k].kind == FE_EVENT_ENTER;
            exits += events[k].kind == FE_EVENT_EXIT;
            if ((i + k) % 11 == 3 && fe_body_is_valid(p->world, events[k].body_b))
                PLAY(p, fe_body_destroy(p->world, events[k].body_b));
            if ((i + k) % 13 == 5 && fe_body_is_valid(p->world, events[k].body_b))
                PLAY(p, fe_body_set_enabled(p->world, events[k].body_b, 0));
        }
        step(p, 1);
    }
    static fe_body bodies[400];
    int32_t count = fe_world_get_bodies(p->world, bodies, 400), last;
    assert_in_range(count, 1, 300);
    last = fe_world_get_pair_events(p->world, events, sizeof *events, MOST);
    for (int32_t k = 0; k < last; ++k)
        enters += events[k].kind == FE_EVENT_ENTER, exits += events[k].kind == FE_EVENT_EXIT;
    PLAY(p, fe_body_destroy_many(p->world, bodies, count));
    step(p, 1);
    last = fe_world_get_pair_events(p->world, events, sizeof *events, MOST);
    for (int32_t k = 0; k < last; ++k)
        enters += events[k].kind == FE_EVENT_ENTER, exits += events[k].kind == FE_EVENT_EXIT;
    assert_in_range(enters, 100, 1000000);
    assert_int_equal(enters, exits);
}

#define IN_A_WORLD(test) cmocka_unit_test_setup_teardown(test, open_world, close_world)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_A_WORLD(memory_stays_flat_over_many_spawns),
        IN_A_WORLD(handles_of_the_dead_are_stale_for_every_call),
        IN_A_WORLD(a_slot_never_gives_a_handle_twice),
        IN_A_WORLD(a_world_without_bodies_steps),
        IN_A_WORLD(all_bodies_can_be_removed_and_come_back),
        IN_A_WORLD(thousands_can_be_created_one_by_one),
        IN_A_WORLD(a_body_born_inside_another_gets_out),
        IN_A_WORLD(types_and_shapes_change_between_steps),
        IN_A_WORLD(what_rests_on_a_moving_platform_stays_awake),
        IN_A_WORLD(without_a_sleep_time_only_slow_bodies_sleep),
        IN_A_WORLD(teleports_between_steps),
        IN_A_WORLD(events_balance_when_bodies_go_in_the_event_loop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
