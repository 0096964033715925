// What a world takes of its host's memory: a body of a moving heap, bodies that were born in one point.
#include "counting_allocator.h"
#include "determinism/golden.h"

static const double DT = 1.0 / 60.0;

static fe_world *world_of(counting *c, int32_t simd, int32_t workers)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_allocator allocator = counting_allocator(c);
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    def.simd = simd;
    def.worker_count = workers;
    fe_result result = fe_world_create(&def, &world);
    FE_TRUE(result == FE_OK || result == FE_ERROR_UNSUPPORTED);
    return world;
}

static void add(play *p, part a)
{
    fe_body body;
    fe_shape shape;
    PLAY(p, fe_body_create(p->world, &a.body, &body));
    PLAY(p, fe_shape_create(p->world, body, &a.shape, &a.geometry, &shape));
}

static void step(play *p) { FE_TRUE(fe_world_step(p->world, (float)DT) == FE_OK); }

static fe_counters counters_of(const fe_world *world)
{
    fe_counters c = {.struct_size = sizeof c};
    FE_TRUE(fe_world_get_counters(world, &c) == FE_OK);
    return c;
}

// ---- a moving heap -------------------------------------------------------------------------------------------------
static part wall(double x, double z)
{
    part w = part_box(x != 0 ? 0.5f : 9.0f, 40.0f, z != 0 ? 0.5f : 9.0f, x, 40.0, z);
    w.body.type = FE_BODY_STATIC;
    return w;
}

static void pour(play *p, int32_t count)
{
    enum { SIDE = 10 };
    const double pitch = 0.9, half = 5.0;
    add(p, part_plane(0.0f, 1.0f, 0.0f));
    add(p, wall(half + 0.5, 0)), add(p, wall(-half - 0.5, 0)), add(p, wall(0, half + 0.5)),
        add(p, wall(0, -half - 0.5));
    for (int32_t i = 0; i < count; ++i) {
        float r = play_between(p, 0.12f, 0.4f);
        double x = pitch * (i % SIDE - 4.5) + play_between(p, -0.05f, 0.05f),
               z = pitch * (i / SIDE % SIDE - 4.5) + play_between(p, -0.05f, 0.05f),
               y = 0.6 + pitch * (i / SIDE / SIDE);
        add(p, i % 3 == 0   ? part_box(r, 0.8f * r, 1.1f * r, x, y, z)
               : i % 3 == 1 ? part_sphere(r, x, y, z)
                            : part_capsule(0.7f * r, 0.7f * r, x, y, z));
    }
}

// A body has seven to eight neighbours within the reach of its box, of 450 bytes each, and touches three of them, of
// 480 bytes in a row; with its own 700, its lines of 200 and an eighth of room that is 6.5 KB. Empty lanes and contacts
// that may begin take up to half as much in the fall. None of it hangs on the width of the rows
static void a_body_of_a_moving_heap_takes_some_kilobytes_on_every_set(void **state)
{
    enum { COUNT = 1200, STEPS = 110, MOST = 10000 };
    (void)state;
    for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
        counting memory = {0};
        fe_world *world = world_of(&memory, simd, 1);
        if (!world) continue;
        play p;
        play_begin(&p, world);
        pour(&p, COUNT);
        int64_t most = 0;
        for (int32_t i = 0; i < STEPS; ++i) {
            step(&p);
            if (counters_of(world).bytes > most) most = counters_of(world).bytes;
        }
        fe_counters c = counters_of(world);
        FE_TRUE(c.contacts > 2 * COUNT && c.contacts_left_out == 0); // it is a heap
        FE_WITHIN((double)most / COUNT, 0, MOST);
        assert_int_equal(p.errors, 0);
        fe_world_destroy(world);
        assert_int_equal(memory.blocks, 0);
    }
}

// ---- born in one point ---------------------------------------------------------------------------------------------
static uint64_t burst(int32_t simd, int32_t workers, int64_t *out_most)
{
    enum { COUNT = 1000, STEPS = 6, NEIGHBOURS = 48 };
    counting memory = {0};
    fe_world *world = world_of(&memory, simd, workers);
    if (!world) return 0;
    play p;
    play_begin(&p, world);
    for (int32_t i = 0; i < COUNT; ++i)
        add(&p, i % 2 ? part_sphere(0.2f, 0, 5, 0) : part_box(0.2f, 0.2f, 0.2f, 0, 5, 0));
    for (int32_t i = 0; i < STEPS; ++i) {
        step(&p);
        if (i > 0) continue;
        // each keeps its own choice, and of those that chose it a few more
        fe_counters c = counters_of(world);
        FE_WITHIN(c.contacts, COUNT * NEIGHBOURS / 2, COUNT * NEIGHBOURS);
        assert_int_equal(c.contacts + c.contacts_left_out, COUNT * (COUNT - 1) / 2);
    }
    *out_most = counters_of(world).bytes;
    uint64_t hash = play_hash(&p);
    assert_int_equal(p.errors, 0);
    fe_world_destroy(world);
    assert_int_equal(memory.blocks, 0);
    return hash;
}

static void a_thousand_bodies_in_a_point_take_64_megabytes_at_most(void **state)
{
    (void)state;
    uint64_t first = 0;
    for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
        int64_t most = 0;
        uint64_t hash = burst(simd, 1 + simd % 3, &most);
        if (!hash) continue;
        if (!first) first = hash;
        if (hash != first) fail_msg("set %d: other bits", (int)simd);
        FE_WITHIN((double)most, 0, 64e6);
    }
}

// What many lie on is no crowd: they have few neighbours each
static void what_a_body_carries_is_never_left_out(void **state)
{
    enum { SIDE = 12 };
    (void)state;
    counting memory = {0};
    play p;
    play_begin(&p, world_of(&memory, FE_SIMD_AUTO, 1));
    add(&p, part_plane(0.0f, 1.0f, 0.0f));
    for (int32_t tray = 0; tray < 2; ++tray) // two of them, one on the other
        add(&p, part_box(4.0f, 0.1f, 4.0f, 0, 0.1 + 0.2 * tray, 0));
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        add(&p, part_box(0.25f, 0.25f, 0.25f, 0.6 * (i % SIDE - 5.5), 0.65, 0.6 * (i / SIDE - 5.5)));
    for (int32_t i = 0; i < 30; ++i) step(&p);
    assert_int_equal(counters_of(p.world).contacts, SIDE * SIDE + 2);
    assert_int_equal(counters_of(p.world).contacts_left_out, 0);
    fe_world_destroy(p.world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_of_a_moving_heap_takes_some_kilobytes_on_every_set),
        cmocka_unit_test(a_thousand_bodies_in_a_point_take_64_megabytes_at_most),
        cmocka_unit_test(what_a_body_carries_is_never_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
