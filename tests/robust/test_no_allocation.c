// test_no_allocation.c - a settled scene's step allocates nothing; a growing one allocates O(log n) times.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

#ifdef FE_SANITIZED
enum { POURED = 200, QUIET_STEPS = 100, MOST_BODIES = 2000 };
#else
enum { POURED = 1500, QUIET_STEPS = 1000, MOST_BODIES = 20000 };
#endif
// a heap packs for some seconds, and has more near pairs than ever when it has
enum { COLUMNS = 9, LAYER = COLUMNS * COLUMNS, SETTLING_STEPS = 900, LONGEST_FALL = 600 };

// The scene bowl-1500 of the bench: a walled pit, and boxes, spheres and capsules poured into it in layers
static void build_bowl(play *p)
{
    part floor = part_static_box(20.0f, 1.0f, 20.0f, 0.0, -1.0, 0.0);
    play_add(p, &floor);
    for (int32_t side = -1; side <= 1; side += 2) {
        part wall_x = part_static_box(1.0f, 11.0f, 8.0f, 7.0 * side, 10.0, 0.0),
             wall_z = part_static_box(8.0f, 11.0f, 1.0f, 0.0, 10.0, 7.0 * side);
        play_add(p, &wall_x);
        play_add(p, &wall_z);
    }
}

static void pour(play *p, fe_body *out_bodies)
{
    for (int32_t b = 0; b < POURED; ++b) {
        int32_t layer = b / LAYER, c = b % LAYER;
        double x = 1.2 * (c % COLUMNS - COLUMNS / 2) + (double)play_between(p, -0.15f, 0.15f);
        double z = 1.2 * (c / COLUMNS - COLUMNS / 2) + (double)play_between(p, -0.15f, 0.15f);
        double y = 1.0 + 1.5 * layer;
        part a = b % 3 == 0   ? part_box(0.4f, 0.3f, 0.5f, x, y, z)
                 : b % 3 == 1 ? part_sphere(0.45f, x, y, z)
                              : part_capsule(0.3f, 0.3f, x, y, z);
        a.shape.material.static_friction = a.shape.material.dynamic_friction = 0.4f;
        fe_shape shape;
        PLAY(p, fe_body_create(p->world, &a.body, out_bodies + b));
        PLAY(p, fe_shape_create(p->world, out_bodies[b], &a.shape, &a.geometry, &shape));
    }
}

// What falls asleep gives its rows back: no allocation is asked of the steps of a heap that rests awake.
static void stay_awake(fe_world *world)
{
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    FE_TRUE(fe_world_get_tuning(world, &tuning) == FE_OK);
    tuning.sleep_enabled = 0;
    FE_TRUE(fe_world_set_tuning(world, &tuning) == FE_OK);
}

static void a_settled_bowl_steps_without_allocating(void **state)
{
    (void)state;
    static fe_body bodies[POURED];
    counting memory = {0};
    play p;
    play_begin(&p, counting_world(&memory));
    stay_awake(p.world);
    build_bowl(&p);
    pour(&p, bodies);
    int32_t step = 0, landed = 0;
    for (; step < LONGEST_FALL && landed < POURED; ++step) {
        FE_TRUE(fe_world_step(p.world, p.dt) == FE_OK);
        while (landed < POURED && fe_body_get_contacts(p.world, bodies[landed], NULL, 0, 0) > 0)
            ++landed; // the last layer lands last
    }
    assert_int_equal(landed, POURED);
    for (int32_t i = 0; i < SETTLING_STEPS; ++i) FE_TRUE(fe_world_step(p.world, p.dt) == FE_OK);
    int64_t calls = memory.calls;
    for (int32_t i = 0; i < QUIET_STEPS; ++i) {
        FE_TRUE(fe_world_step(p.world, p.dt) == FE_OK);
        if (memory.calls != calls)
            fail_msg("%d allocations in step %d after the bowl has settled", (int)(memory.calls - calls), (int)i);
    }
    assert_int_equal(p.errors, 0);
    fe_world_destroy(p.world);
    assert_int_equal(memory.blocks, 0);
    assert_int_equal(memory.wrong, 0);
}

// Arrays double up to 1024 records and then grow by an eighth, which is six times a doubling: going from 16 to n
// records asks so many times an array; a step reserves some 50 arrays at most
static void a_growing_world_allocates_as_its_logarithm(void **state)
{
    (void)state;
    enum { ARRAYS = 64 };
    counting memory = {0};
    play p;
    play_begin(&p, counting_world(&memory));
    part ground = part_plane(0.0f, 1.0f, 0.0f);
    play_add(&p, &ground);
    int64_t growths = 1;
    for (int32_t n = 16; n < MOST_BODIES; n *= 2) growths += n < 1024 ? 1 : 6;
    for (int32_t i = 0; i < MOST_BODIES; ++i) {
        fe_body body;
        fe_shape shape;
        part a = part_sphere(0.4f, 1.0 * (i % 150), 0.5, 1.0 * (i / 150));
        PLAY(&p, fe_body_create(p.world, &a.body, &body));
        PLAY(&p, fe_shape_create(p.world, body, &a.shape, &a.geometry, &shape));
        if (i % (MOST_BODIES / 50) == 0) FE_TRUE(fe_world_step(p.world, p.dt) == FE_OK);
    }
    FE_WITHIN(memory.calls, 1, ARRAYS * growths);
    fe_world_destroy(p.world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_settled_bowl_steps_without_allocating),
        cmocka_unit_test(a_growing_world_allocates_as_its_logarithm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
