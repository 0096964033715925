// Near misses wait only while their bodies cannot have met: the odometers bound every way, also round their end, and
// what is moved by hand is looked at in the next step.
#include "api/api_test.h"

#include "world/deferral.h"

#include <math.h>

static uint64_t noise = 1;

// in -1..1
static float any(void)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (float)(int32_t)(noise >> 32) * 0x1p-31f;
}

typedef struct place {
    fe_dvec3 centre;
    fe_quat rotation;
} place;

// by up to so many m and half radians, as a step moves a body
static void move(place *at, fe__odometer *o, float most, float most_turn)
{
    fe_vec3 shift = fe__scale(most, fe__vec3(any(), any(), any())),
            turn = fe__scale(most_turn, fe__vec3(any(), any(), any()));
    fe_quat q = fe__normalized((fe_quat){turn.x, turn.y, turn.z, 1.0f});
    at->centre = fe__dadd(at->centre, fe__widen(shift));
    at->rotation = fe__normalized(fe__product(q, at->rotation));
    fe__odometer_advance(o, fe__length(shift), fe__length(fe__vec3(q.x, q.y, q.z)));
}

static double sine_square(fe_quat from, fe_quat to)
{
    fe_quat turn = fe__product(to, fe__conjugate(from));
    return (double)(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
}

// the measure of recycle.simd.c
static double moved(const place *from, const place *to, float reach)
{
    fe_dvec3 shift = fe__dsub(fe__dsub(to[1].centre, to[0].centre), fe__dsub(from[1].centre, from[0].centre));
    double turned = sine_square(from[0].rotation, to[0].rotation) + sine_square(from[1].rotation, to[1].rotation);
    return sqrt(3.0 * (fe__ddot(shift, shift) + 4.0 * (double)(reach * reach) * turned));
}

static void what_waits_has_not_moved_too_far(void **state)
{
    (void)state;
    int32_t waited = 0, ended = 0;
    fe__odometer o[2] = {{UINT32_MAX - 1000, UINT32_MAX - 3, 0.0f}, {0x7ffffffe, 0x80000001, 0.0f}};
    for (int32_t i = 0; i < 2000; ++i) {
        float slack = 0.05f + 0.04f * any(), reach = 1.0f + any(), dt = 1.0f / 60.0f, most = 0.002f * (1.0f + any());
        place start[2] = {{{0.0, 0.0, 0.0}, fe__identity()}, {{3.0, 1.0, -2.0}, fe__identity()}},
              now[2] = {start[0], start[1]};
        fe__deferral wait;
        o[0].speed = 0.0f, o[1].speed = 0.0f;
        fe__defer(&wait, o, 0, 1, slack, reach);
        for (int32_t step = 0; step < 100; ++step) {
            move(now, o, most, most), move(now + 1, o + 1, most, i % 2 ? most : 0.0f);
            o[0].speed = any() + 1.0f, o[1].speed = any() + 1.0f;
            double way = moved(start, now, reach) + (double)(dt * (o[0].speed + o[1].speed));
            if (!fe__stays_deferred(&wait, o, dt)) {
                ++ended;
                break;
            }
            ++waited;
            FE_WITHIN(way, 0.0, (double)slack);
        }
    }
    FE_TRUE(waited > 2000 && ended > 1000); // both were seen
}

// so fast a body is not thought to stand still
static void a_way_beyond_the_odometer_ends_it(void **state)
{
    (void)state;
    fe__odometer o[2] = {{0}};
    fe__deferral wait;
    fe__defer(&wait, o, 0, 1, 1e9f, 1.0f);
    FE_TRUE(fe__stays_deferred(&wait, o, 1.0f / 60.0f));
    fe__odometer_advance(o, 1e30f, 1.0f);
    fe__odometer_advance(o + 1, INFINITY, 1.0f);
    FE_TRUE(!fe__stays_deferred(&wait, o, 1.0f / 60.0f));
}

static void what_makes_no_sense_does_not_wait(void **state)
{
    (void)state;
    const float bad[] = {NAN, -INFINITY, -1.0f, 0.0f};
    fe__odometer o[2] = {{0}};
    fe__deferral wait;
    for (int i = 0; i < 4; ++i) {
        fe__defer(&wait, o, 0, 1, bad[i], 1.0f);
        FE_TRUE(!fe__stays_deferred(&wait, o, 1.0f / 60.0f));
    }
    fe__defer(&wait, o, 0, 1, 1.0f, INFINITY);
    FE_TRUE(!fe__stays_deferred(&wait, o, 1.0f / 60.0f));
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_waits_has_not_moved_too_far),
        cmocka_unit_test(a_way_beyond_the_odometer_ends_it),
        cmocka_unit_test(what_makes_no_sense_does_not_wait),
        cmocka_unit_test(what_is_placed_is_looked_at),
    };
    return cmocka_run_group_tests_name("wait", tests, NULL, NULL);
}
