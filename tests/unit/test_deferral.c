// Near misses wait only while their bodies cannot have met: the odometers bound every way, also round their end, and
// what is moved by hand is looked at in the next step.
#include "api/api_test.h"

#include "step/narrowphase.h"
#include "solver/contact/skip_test.h"

#include <math.h>

static uint64_t noise = 1;

// in -1..1
static float any(void)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (float)(int32_t)(noise >> 32) * 0x1p-31f;
}

static fe_vec3 any_vector(float most) { return fe__scale(most, fe__vec3(any(), any(), any())); }

// Two bodies, and how their pair was found
typedef struct couple {
    fe__body body[2];
    fe__odometer odometer[2];
    fe_quat found[2];
    fe__contact contact;
} couple;

static void set_velocity(couple *c, int i, fe_vec3 velocity, float spin)
{
    fe__odometer *o = c->odometer + i;
    o->velocity[0] = velocity.x, o->velocity[1] = velocity.y, o->velocity[2] = velocity.z;
    o->spin = spin;
}

static fe_dvec3 centre(const couple *c, int i)
{
    return (fe_dvec3){c->body[i].centre[0], c->body[i].centre[1], c->body[i].centre[2]};
}

static void put(couple *c, int i, fe_dvec3 place)
{
    c->body[i].centre[0] = place.x, c->body[i].centre[1] = place.y, c->body[i].centre[2] = place.z;
    fe__odometer_place(c->odometer + i, c->body[i].centre);
}

static void turn_to(couple *c, int i, fe_quat q)
{
    c->body[i].rotation[0] = q.x, c->body[i].rotation[1] = q.y, c->body[i].rotation[2] = q.z,
    c->body[i].rotation[3] = q.w;
}

static fe_quat rotation(const couple *c, int i)
{
    const float *q = c->body[i].rotation;
    return (fe_quat){q[0], q[1], q[2], q[3]};
}

// by up to so many m and half radians, as a step moves a body
static void move(couple *c, int i, float most, float most_turn)
{
    fe_vec3 turn = any_vector(most_turn);
    fe_quat q = fe__normalized((fe_quat){turn.x, turn.y, turn.z, 1.0f});
    put(c, i, fe__dadd(centre(c, i), fe__widen(any_vector(most))));
    turn_to(c, i, fe__normalized(fe__product(q, rotation(c, i))));
    fe__odometer_turn(c->odometer + i, fe__length(fe__vec3(q.x, q.y, q.z)));
}

// Bodies near `place`, a gap with or without a direction
static void find(couple *c, fe_dvec3 place, int32_t has_direction, float gap)
{
    fe__contact *m = &c->contact;
    *m = (fe__contact){.body_a = 0, .body_b = 1, .longest_arm = 1.0f + any()};
    m->surface.tolerance = gap, m->surface.radius_a = 0.9f * m->longest_arm,
    m->surface.radius_b = 0.3f * m->longest_arm;
    fe_vec3 n = fe__vec3(any(), any(), 1.5f);
    if (has_direction) fe__copy3(m->normal, fe__scale(1.0f / fe__length(n), n));
    for (int i = 0; i < 2; ++i) {
        put(c, i, fe__dadd(place, fe__widen(any_vector(2.0f))));
        turn_to(c, i, fe__normalized((fe_quat){any(), any(), any(), 2.0f}));
        c->found[i] = rotation(c, i);
        set_velocity(c, i, fe__vec3(0.0f, 0.0f, 0.0f), 0.0f);
    }
    fe__copy3(m->found_span, fe__narrow(fe__dsub(centre(c, 0), centre(c, 1))));
}

// Does it wait on? All SIMD sets say the same, whatever is in the other lanes: pairs that do not wait here, at every
// second place, with lanes left over or none
static int32_t waits(const fe__deferral *wait, const fe__odometer *odometers, float dt)
{
    enum { MOST = 35 };
    static fe__deferral all[MOST];
    int32_t answer = -1;
    for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
        const fe__kernels *kernels = fe__kernels_of(simd);
        for (int32_t count = kernels ? 1 : MOST + 1; count <= MOST; count += 1 + count / 2) {
            int32_t places[MOST], kept = 0, others = count / 2;
            for (int32_t i = 0; i < count; ++i) {
                all[i] = *wait;
                if (i % 2) all[i].gap = -1.0f;
                places[i] = i;
            }
            int32_t due = kernels->keep_due(all, odometers, places, count, dt);
            for (int32_t i = 0; i < due; ++i) {
                kept += places[i] % 2;
                FE_TRUE(i == 0 || places[i] > places[i - 1]);
            }
            assert_int_equal(kept, others);
            FE_TRUE(due == others || due == count);
            FE_TRUE(answer < 0 || answer == (due == others));
            answer = due == others;
        }
    }
    return answer;
}

static fe_dvec3 shift_of(const couple *c)
{
    return fe__dadd(fe__dsub(centre(c, 1), centre(c, 0)), fe__widen(fe__quad_vector(c->contact.found_span)));
}

// |R^T n - n| of the turn since the pair was found
static double turned_normal(const couple *c, int i, fe_vec3 n)
{
    fe_quat turn = fe__product(rotation(c, i), fe__conjugate(c->found[i]));
    return (double)fe__length(fe__sub(fe__rotate_back(turn, n), n));
}

static double sine_square(const couple *c, int i)
{
    fe_quat turn = fe__product(rotation(c, i), fe__conjugate(c->found[i]));
    return (double)(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
}

// What is left of the gap when the next step is over, by the measure of recycle.simd.c
static double left_over(const couple *c, int32_t has_direction, float dt)
{
    const fe__contact *m = &c->contact;
    const fe__odometer *a = c->odometer, *b = c->odometer + 1;
    fe_vec3 n = fe__quad_vector(m->normal), v = fe__sub(fe__quad_vector(a->velocity), fe__quad_vector(b->velocity));
    fe_dvec3 shift = shift_of(c);
    double arm = (double)m->longest_arm, spins = arm * (double)(a->spin + b->spin);
    if (has_direction) {
        spins = (double)m->surface.radius_a * (double)a->spin + (double)m->surface.radius_b * (double)b->spin;
        double turns =
            (double)m->surface.radius_a * turned_normal(c, 0, n) + (double)m->surface.radius_b * turned_normal(c, 1, n);
        return (double)m->surface.tolerance + fe__ddot(fe__widen(n), shift) - turns -
               (double)dt * (fe__maxd((double)fe__dot(n, v), 0.0) + spins);
    }
    double moved = sqrt(3.0 * (fe__ddot(shift, shift) + 4.0 * arm * arm * (sine_square(c, 0) + sine_square(c, 1))));
    return (double)m->surface.tolerance - moved - (double)dt * ((double)fe__length(v) + spins);
}

static void follow(couple *c, int32_t has_direction, int32_t *waited, int32_t *ended)
{
    const float dt = 1.0f / 60.0f, most = 0.002f * (1.0f + any());
    fe__deferral wait;
    fe__defer(&wait, c->odometer, c->body, &c->contact, c->contact.surface.tolerance);
    for (int32_t step = 0; step < 200; ++step) {
        for (int i = 0; i < 2; ++i) {
            move(c, i, most, i || step % 2 ? most : 0.0f);
            set_velocity(c, i, any_vector(0.5f), 0.1f * (1.0f + any()));
        }
        if (!waits(&wait, c->odometer, dt)) {
            *ended += 1;
            return;
        }
        *waited += 1;
        fe_dvec3 shift = shift_of(c);
        FE_TRUE(left_over(c, has_direction, dt) > 0.0);
        FE_TRUE(sqrt(fe__ddot(shift, shift)) < (double)fe__most_away(&c->contact));
        // looked at on the way, as the recycling does: by what is left then
        if (step % 5 == 4) {
            set_velocity(c, 0, fe__vec3(0.0f, 0.0f, 0.0f), 0.0f), set_velocity(c, 1, fe__vec3(0.0f, 0.0f, 0.0f), 0.0f);
            fe__defer(&wait, c->odometer, c->body, &c->contact, (float)left_over(c, has_direction, dt));
        }
    }
}

static void what_waits_cannot_have_met(void **state)
{
    (void)state;
    // the odometers pass their end at 1024 m, one turn of 2^32 ticks
    const fe_dvec3 places[] = {{0.0, 0.0, 0.0}, {1024.0, -1024.0, 512.0}, {-1e6, 3e5, 7.0}};
    int32_t waited = 0, ended = 0;
    static couple c;
    c.odometer[0].turned = UINT32_MAX - 3, c.odometer[1].turned = 0x7ffffffe;
    for (int32_t i = 0; i < 3000; ++i) {
        find(&c, places[i % 3], i % 2, 0.05f + 0.04f * any());
        follow(&c, i % 2, &waited, &ended);
    }
    FE_TRUE(waited > 10000 && ended > 1000); // both were seen
}

// Bodies that move together, or apart, wait on; without a direction those that move apart do not, for long
static void what_moves_together_waits(void **state)
{
    (void)state;
    const float dt = 1.0f / 60.0f, gap = 0.05f;
    static couple c;
    fe__deferral wait;
    find(&c, (fe_dvec3){0.0, 0.0, 0.0}, 1, gap);
    fe__defer(&wait, c.odometer, c.body, &c.contact, gap);
    fe_dvec3 on = {10.0, 20.0, -30.0}, off = fe__dscale(0.2, fe__widen(fe__quad_vector(c.contact.normal)));
    for (int i = 0; i < 2; ++i) {
        set_velocity(&c, i, fe__vec3(100.0f, 0.0f, 0.0f), 0.0f);
        put(&c, i, fe__dadd(centre(&c, i), on));
    }
    FE_TRUE(waits(&wait, c.odometer, dt));
    put(&c, 1, fe__dadd(centre(&c, 1), off));
    FE_TRUE(waits(&wait, c.odometer, dt) == (0.2f < fe__most_away(&c.contact)));
    put(&c, 1, fe__dadd(centre(&c, 1), fe__dscale(10.0, off)));
    FE_TRUE(!waits(&wait, c.odometer, dt));
}

static void what_makes_no_sense_does_not_wait(void **state)
{
    (void)state;
    const float bad[] = {NAN, -INFINITY, -1.0f, 0.0f};
    static couple c;
    fe__deferral wait;
    for (int i = 0; i < 8; ++i) {
        find(&c, (fe_dvec3){0.0, 0.0, 0.0}, i % 2, 1.0f);
        fe__defer(&wait, c.odometer, c.body, &c.contact, bad[i / 2]);
        FE_TRUE(!waits(&wait, c.odometer, 1.0f / 60.0f));
        fe__defer(&wait, c.odometer, c.body, &c.contact, 1.0f);
        FE_TRUE(waits(&wait, c.odometer, 1.0f / 60.0f));
        set_velocity(&c, 1, fe__vec3(NAN, 0.0f, 0.0f), 0.0f);
        FE_TRUE(!waits(&wait, c.odometer, 1.0f / 60.0f));
        set_velocity(&c, 1, fe__vec3(0.0f, 0.0f, 0.0f), INFINITY);
        FE_TRUE(!waits(&wait, c.odometer, 1.0f / 60.0f));
        c.contact.longest_arm = c.contact.surface.radius_a = INFINITY;
        fe__defer(&wait, c.odometer, c.body, &c.contact, 1.0f);
        FE_TRUE(!waits(&wait, c.odometer, 1.0f / 60.0f));
    }
}

// Balls side by side, of which one leaps by a whole turn of the odometers in a step and is stopped there: only the
// other stays where it was, and what it meets next is seen
static void who_leaps_all_the_way_round_ends_the_wait(void **state)
{
    (void)state;
    const float speed = 4000.0f, dt = 0.256f; // 1024 m in a step: 2^32 ticks
    fe_world *world = new_world();
    OK(fe_world_set_gravity(world, &(fe_vec3){0, 0, 0}));
    fe_body bodies[2] = {new_body(world, FE_BODY_DYNAMIC, 0, 0, 0), new_body(world, FE_BODY_DYNAMIC, 0, 1.04, 0)};
    for (int i = 0; i < 2; ++i) add_sphere(world, bodies[i], 0.5f);
    step(world, 3);
    const fe_world *w = world;
    assert_int_equal(w->pair_count, 1);
    FE_TRUE(w->awake_pairs[0] < 0); // it waits
    fe_vec3 leap = {speed, 0.0f, 0.0f}, stop = {0.0f, 0.0f, 0.0f};
    OK(fe_body_set_linear_velocity(world, bodies[0], &leap));
    OK(fe_world_step(world, dt));
    OK(fe_body_set_linear_velocity(world, bodies[0], &stop));
    step(world, 2);
    assert_int_equal(w->pair_count, 0);
    fe_world_destroy(world);
}

// Balls 4 cm apart: neighbours without points. Moved to touch, whichever it is, they are told of in the next step.
static void what_is_placed_is_looked_at(void **state)
{
    (void)state;
    for (int32_t type = FE_BODY_STATIC; type <= FE_BODY_DYNAMIC; ++type)
        for (int32_t mover = 0; mover < 2; ++mover) {
            fe_world *world = new_world();
            OK(fe_world_set_gravity(world, &(fe_vec3){0, 0, 0}));
            fe_body bodies[2] = {new_body(world, type, 0, 0, 0), new_body(world, FE_BODY_DYNAMIC, 1.04, 0, 0)};
            for (int i = 0; i < 2; ++i) add_sphere(world, bodies[i], 0.5f);
            step(world, 5);
            assert_int_equal(fe_world_get_pair_events(world, NULL, 0, 0), 0);
            fe_transform there = {.position = {mover ? 0.99 : 0.05, 0, 0}, .rotation = {0, 0, 0, 1}};
            OK(fe_body_set_transform(world, bodies[mover], &there));
            step(world, 1);
            assert_int_equal(fe_world_get_pair_events(world, NULL, 0, 0), 1);
            fe_world_destroy(world);
        }
}

// A board of 4 m turns about its centre towards a ball beside its end: no centre moves, the board's reach is all that
// closes the gap. It was made so long, or grew to it beside the ball
static void what_turns_is_looked_at(void **state)
{
    (void)state;
    for (int32_t grows = 0; grows < 2; ++grows) {
        fe_world *world = new_world();
        OK(fe_world_set_gravity(world, &(fe_vec3){0, 0, 0}));
        fe_body board = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0), ball = new_body(world, FE_BODY_STATIC, 1.7, 0.5, 0);
        fe_geometry of_board, at_first;
        fe_geometry_box(&of_board, 2.0f, 0.1f, 0.1f);
        fe_geometry_box(&at_first, grows ? 0.2f : 2.0f, 0.45f, 0.1f);
        fe_shape shape = add_shape(world, board, grows ? &at_first : &of_board);
        add_sphere(world, ball, 0.2f);
        step(world, 3);
        OK(fe_shape_set_geometry(world, shape, &of_board));
        step(world, 3);
        OK(fe_body_set_angular_velocity(world, board, &(fe_vec3){0.0f, 0.0f, 0.5f}));
        int32_t met = 0;
        for (int32_t i = 0; i < 60; ++i) {
            step(world, 1);
            met |= fe_world_get_pair_events(world, NULL, 0, 0) > 0;
        }
        FE_TRUE(met);
        fe_world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_waits_cannot_have_met),
        cmocka_unit_test(what_moves_together_waits),
        cmocka_unit_test(what_makes_no_sense_does_not_wait),
        cmocka_unit_test(who_leaps_all_the_way_round_ends_the_wait),
        cmocka_unit_test(what_is_placed_is_looked_at),
        cmocka_unit_test(what_turns_is_looked_at),
    };
    return cmocka_run_group_tests_name("wait", tests, NULL, NULL);
}
