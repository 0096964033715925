// Bodies in more contacts than there are colours: a raft under a crowd. Each of its contacts has a row to itself, a
// thin one, and those beyond the colours have no order but that of creation: whatever runs them, on rows of whatever
// width, the result has the same bits.
#include "determinism/golden.h"

// the large one has more contacts than an island that one worker solves whole may have
#ifdef FE_SANITIZED
enum { SMALL_CROWD = 130, LARGE_CROWD = 1100, STEPS = 10, MOST_RUNS = 2 };
#else
enum { SMALL_CROWD = 130, LARGE_CROWD = 1100, STEPS = 40, MOST_RUNS = 4 };
#endif

static void add(play *p, const part *a)
{
    fe_body body;
    fe_shape shape;
    PLAY(p, fe_body_create(p->world, &a->body, &body));
    PLAY(p, fe_shape_create(p->world, body, &a->shape, &a->geometry, &shape));
}

static void add_raft(play *p, int32_t riders)
{
    const float pitch = 0.6f;
    int32_t side = 1;
    while (side * side < riders) ++side;
    part raft = part_box(0.5f * pitch * (float)side, 0.2f, 0.5f * pitch * (float)side, 0.0, 0.4, 0.0);
    raft.body.transform.rotation.z = 0.01f; // comes down on an edge
    add(p, &raft);
    for (int32_t i = 0; i < riders; ++i) {
        double px = (double)pitch * (i % side - 0.5 * (side - 1)), pz = (double)pitch * (i / side - 0.5 * (side - 1));
        part rider = i % 3 == 0   ? part_sphere(0.25f, px, 0.86, pz)
                     : i % 3 == 1 ? part_box(0.2f, 0.25f, 0.2f, px, 0.86, pz)
                                  : part_capsule(0.1f, 0.2f, px, 0.86, pz);
        rider.body.angular_velocity.y = play_between(p, -1.0f, 1.0f);
        if (i % 7 == 0) rider.shape.material.restitution = 0.5f;
        if (i % 11 == 0) rider.shape.material.rolling_resistance = 0.05f;
        add(p, &rider);
    }
}

static uint64_t run_crowd(int32_t riders, int32_t simd, int32_t workers)
{
    fe_world *world = new_world(simd, workers);
    play p;
    if (!world) return 0;
    play_begin(&p, world);
    part ground = part_plane(0.0f, 1.0f, 0.0f);
    add(&p, &ground);
    add_raft(&p, riders);
    for (int32_t i = 0; i < STEPS; ++i) FE_TRUE(fe_world_step(world, p.dt) == FE_OK);
    fe_counters counters = {.struct_size = sizeof counters};
    FE_TRUE(fe_world_get_counters(world, &counters) == FE_OK);
    FE_WITHIN(counters.contacts, riders / 2, 2 * riders); // they are aboard
    assert_int_equal(counters.contacts_left_out, 0);
    uint64_t hash = play_hash(&p);
    assert_int_equal(p.errors, 0);
    fe_world_destroy(world);
    return hash;
}

static void a_crowd_has_the_same_bits_on_every_set_and_number_of_workers(void **state)
{
    static const int32_t workers[] = {1, 8, 2, 3}, crowds[] = {SMALL_CROWD, LARGE_CROWD};
    (void)state;
    for (int32_t k = 0; k < 2; ++k) {
        uint64_t first = run_crowd(crowds[k], FE_SIMD_PLAIN, 1);
        for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
            for (int32_t i = 0; i < MOST_RUNS; ++i) {
                uint64_t hash = run_crowd(crowds[k], simd, workers[i]);
                if (hash && hash != first)
                    fail_msg("%d riders, set %d, %d workers: other bits", (int)crowds[k], (int)simd, (int)workers[i]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_crowd_has_the_same_bits_on_every_set_and_number_of_workers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
