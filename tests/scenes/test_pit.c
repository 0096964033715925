// A pit that is filled with mixed bodies comes to rest: one that is wedged and wobbles on the spot keeps nobody awake.
#include "fe_test.h"
#include "support/play.h"

static const double PITCH = 0.9; // m, between bodies when they are poured

// Marsaglia's xorshift. Of a few dozen heaps one has a capsule that is wedged askew between the ground and a stone: its
// free end swings through the reach of contacts, so that it turns by 4 mrad every third step, and back
static uint64_t random_bits = UINT64_C(11) * 2654435761 + 1;
static double between(double low, double high)
{
    random_bits ^= random_bits << 13, random_bits ^= random_bits >> 7, random_bits ^= random_bits << 17;
    return low + (high - low) * ((double)(random_bits >> 11) / 9007199254740992.0);
}

static void add(play *p, part a)
{
    a.shape.material.rolling_resistance = 0.1f;
    a.shape.material.spinning_resistance = 0.01f;
    fe_body body;
    fe_shape shape;
    PLAY(p, fe_body_create(p->world, &a.body, &body));
    PLAY(p, fe_shape_create(p->world, body, &a.shape, &a.geometry, &shape));
}

static void add_wall(play *p, float half_x, float half_z, double x, double z)
{
    const float half_height = 60.0f;
    part wall = part_box(half_x, half_height, half_z, x, (double)half_height, z);
    wall.body.type = FE_BODY_STATIC;
    add(p, wall);
}

static void dig(play *p, double half)
{
    const float thick = 0.5f, along = (float)half + 1.0f;
    const double away = half + (double)thick;
    add(p, part_plane(0.0f, 1.0f, 0.0f));
    add_wall(p, thick, along, -away, 0.0), add_wall(p, thick, along, away, 0.0);
    add_wall(p, along, thick, 0.0, -away), add_wall(p, along, thick, 0.0, away);
}

static void pour(play *p, int32_t count, int32_t side)
{
    for (int32_t i = 0; i < count; ++i) {
        float r = (float)between(0.12, 0.4);
        double x = PITCH * (i % side - 0.5 * (side - 1)) + between(-0.05, 0.05),
               z = PITCH * (i / side % side - 0.5 * (side - 1)) + between(-0.05, 0.05),
               y = 0.6 + PITCH * (i / side / side);
        add(p, i % 3 == 0   ? part_box(r, 0.8f * r, 1.1f * r, x, y, z)
               : i % 3 == 1 ? part_sphere(r, x, y, z)
                            : part_capsule(0.7f * r, 0.7f * r, x, y, z));
    }
}

// All bodies have rolling and spinning resistance, so that nothing moves for ever
static void a_pit_of_mixed_bodies_sleeps_within_twenty_seconds(void **state)
{
    enum { COUNT = 2000, SIDE = 12, STEPS = 20 * 60 };
    (void)state;
    fe_world *world = NULL;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    play p;
    play_begin(&p, world);
    dig(&p, 0.45 * SIDE + 0.2);
    pour(&p, COUNT, SIDE);
    fe_counters c = {.struct_size = sizeof c, .awake_bodies = COUNT};
    int32_t steps = 0;
    for (; steps < STEPS && c.awake_bodies > 0; ++steps) {
        FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
        FE_TRUE(fe_world_get_counters(world, &c) == FE_OK);
    }
    assert_int_equal(c.awake_bodies, 0);
    assert_int_equal(p.errors, 0);
    fe_world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pit_of_mixed_bodies_sleeps_within_twenty_seconds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
