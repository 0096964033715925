// What a world takes of its host's memory: a body of a moving heap, bodies that were born in one point.
#include "counting_allocator.h"
#include "determinism/golden.h"
#include "robust/round_forms.h"

static const double DT = 1.0 / 60.0;
// Of worlds whose bodies are born in one point: arguments of the program
#ifdef FE_SANITIZED
static int32_t burst_draws = 3;
#else
static int32_t burst_draws = 12;
#endif
static uint32_t burst_seed = 1;

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
enum { FORMS = 7, THOUSAND = 1000, KEPT = 24 }; // KEPT: see src/step/find_pairs.c

// What is born there: all of one form, or each of any
typedef struct burst {
    int32_t count, steps, form, simd, workers; // form FORMS: any
    float size, rolling, restitution;
    uint32_t events;
    uint32_t seed;
} burst;

static float part_of(uint32_t *draw, float low, float high)
{
    *draw = *draw * 1664525u + 1013904223u;
    return low + (high - low) * (float)(*draw >> 8) / (float)(1 << 24);
}

static fe_asset make_hull(fe_world *world, float size, uint32_t *draw)
{
    float points[3 * 40];
    fe_hull_def def;
    fe_asset hull;
    for (int32_t i = 0; i < 120; ++i) points[i] = part_of(draw, -size, size);
    fe_hull_def_init(&def, sizeof def);
    def.points = points, def.point_count = 40;
    FE_TRUE(fe_hull_create(world_store(world), &def, &hull) == FE_OK);
    return hull;
}

static fe_asset make_compound(fe_world *world, float size)
{
    fe_compound_part parts[4];
    fe_asset compound;
    for (int32_t i = 0; i < 4; ++i) {
        fe_compound_part_init(parts + i, sizeof *parts);
        fe_geometry_box(&parts[i].geometry, 0.4f * size, 0.4f * size, 0.4f * size);
        parts[i].frame.position.x = 0.2f * size * (float)i;
    }
    FE_TRUE(fe_compound_create(world_store(world), parts, sizeof *parts, 4, &compound) == FE_OK);
    return compound;
}

static fe_geometry geometry_of(int32_t form, float r, fe_asset hull, fe_asset compound)
{
    fe_geometry g;
    if (form < ROUND_FORMS) return round_form(form, r);
    fe_geometry_box(&g, r, r, r);
    if (form == ROUND_FORMS) fe_geometry_hull(&g, hull);
    if (form == ROUND_FORMS + 1) fe_geometry_compound(&g, compound);
    return g;
}

// bytes of the world when it held most; its hash
static int64_t burst_bytes(const burst *b, uint64_t *out_hash, fe_counters *out_first)
{
    counting memory = {0};
    fe_world *world = world_of(&memory, b->simd, b->workers);
    if (!world) return 0;
    uint32_t draw = b->seed;
    int64_t most = 0;
    play p;
    play_begin(&p, world);
    fe_asset hull = make_hull(world, b->size, &draw), compound = make_compound(world, b->size);
    for (int32_t i = 0; i < b->count; ++i) {
        part a = part_sphere(1.0f, 0, 5, 0);
        a.geometry = geometry_of(b->form < FORMS ? b->form : i % FORMS, b->size, hull, compound);
        a.shape.material.rolling_resistance = b->rolling, a.shape.material.restitution = b->restitution;
        a.shape.events = b->events;
        add(&p, a);
    }
    for (int32_t i = 0; i < b->steps; ++i) {
        step(&p);
        if (i == 0 && out_first) *out_first = counters_of(world);
        if (counters_of(world).bytes > most) most = counters_of(world).bytes;
    }
    *out_hash = play_hash(&p);
    assert_int_equal(p.errors, 0);
    fe_world_destroy(world);
    assert_int_equal(memory.blocks, 0);
    return most;
}

// Each keeps its own choice, and of those that chose it a few more
static void a_crowd_keeps_the_deepest_and_counts_the_others(void **state)
{
    (void)state;
    uint64_t first = 0, hash;
    for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
        const burst b = {.count = THOUSAND, .steps = 6, .form = 0, .simd = simd, .workers = 1 + simd % 3, .size = 0.2f};
        fe_counters c;
        if (!burst_bytes(&b, &hash, &c)) continue;
        FE_WITHIN(c.contacts, THOUSAND * KEPT / 2, THOUSAND * KEPT);
        assert_int_equal(c.contacts + c.contacts_left_out, THOUSAND * (THOUSAND - 1) / 2);
        if (!first) first = hash;
        if (hash != first) fail_msg("set %d: other bits", (int)simd);
    }
}

static burst any_burst(uint32_t *draw)
{
    const int32_t workers[] = {1, 2, 3, 8, 16, 32};
    return (burst){.count = THOUSAND,
                   .steps = 3,
                   .form = (int32_t)part_of(draw, 0.0f, (float)FORMS + 0.99f),
                   .workers = workers[(int32_t)part_of(draw, 0.0f, 5.99f)],
                   .size = part_of(draw, 0.05f, 2.0f),
                   .rolling = part_of(draw, -0.1f, 0.1f) > 0.0f ? 0.1f : 0.0f,
                   .restitution = part_of(draw, -0.1f, 0.1f) > 0.0f ? 0.5f : 0.0f,
                   .events = (uint32_t)part_of(draw, 0.0f, 7.99f),
                   .seed = *draw};
}

// Of any form, size and material, with up to 32 workers
static void a_thousand_bodies_in_a_point_take_64_megabytes_at_most(void **state)
{
    (void)state;
    uint32_t draw = burst_seed;
    uint64_t hash;
    print_message("%d draws, seed %u\n", (int)burst_draws, (unsigned)burst_seed);
    for (int32_t i = 0; i < burst_draws; ++i) {
        burst b = any_burst(&draw);
        int64_t most = burst_bytes(&b, &hash, NULL);
        if (most > 64000000)
            fail_msg("draw %d: form %d, %d workers, size %g: %lld bytes", (int)i, (int)b.form, (int)b.workers,
                     (double)b.size, (long long)most);
    }
}

// Each keeps as many however many there are: as many bytes a body, but for what an array may round up, an eighth, and
// the parts of compounds that are found before some are left out
static void what_is_born_in_a_point_takes_memory_in_proportion(void **state)
{
    (void)state;
    uint64_t hash;
    for (int32_t form = 0; form <= FORMS; form += FORMS) {
        burst b = {.count = THOUSAND, .steps = 3, .form = form, .workers = 1, .size = 0.3f, .rolling = 0.1f};
        double each = (double)burst_bytes(&b, &hash, NULL) / THOUSAND;
        b.count = 6 * THOUSAND;
        FE_WITHIN((double)burst_bytes(&b, &hash, NULL) / b.count, 0.0, 1.25 * each);
    }
}

// Its records take 128 + 64 + 64 bytes and its points 168; the set of pairs, candidates, lists and what is sorted some
// 150 more, and events up to 150. An array may have an eighth of room. A row of a contact would take 2 KB
static void a_pair_with_a_trigger_takes_no_row(void **state)
{
    enum { TRIGGERS = 200, BALLS = 200, PAIR_BYTES = 1000 };
    (void)state;
    counting memory = {0};
    play p;
    play_begin(&p, world_of(&memory, FE_SIMD_AUTO, 1));
    for (int32_t i = 0; i < TRIGGERS; ++i) {
        part a = part_static_box(1.0f, 1.0f, 1.0f, 0, 5, 0);
        a.shape.trigger = 1, a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY;
        add(&p, a);
    }
    step(&p);
    for (int32_t i = 0; i < BALLS; ++i) add(&p, part_sphere(0.05f, 0.15 * (i % 10) - 0.7, 5.0, 0.08 * (i / 10) - 0.8));
    int64_t before = counters_of(p.world).bytes;
    for (int32_t i = 0; i < 3; ++i) step(&p);
    assert_in_range(counters_of(p.world).pairs, TRIGGERS * BALLS, TRIGGERS * BALLS * 11 / 10);
    FE_WITHIN((double)(counters_of(p.world).bytes - before) / (TRIGGERS * BALLS), 0, PAIR_BYTES);
    fe_world_destroy(p.world);
    assert_int_equal(memory.blocks, 0);
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

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_of_a_moving_heap_takes_some_kilobytes_on_every_set),
        cmocka_unit_test(a_crowd_keeps_the_deepest_and_counts_the_others),
        cmocka_unit_test(a_thousand_bodies_in_a_point_take_64_megabytes_at_most),
        cmocka_unit_test(what_is_born_in_a_point_takes_memory_in_proportion),
        cmocka_unit_test(a_pair_with_a_trigger_takes_no_row),
        cmocka_unit_test(what_a_body_carries_is_never_left_out),
    };
    if (argc > 1) burst_draws = atoi(argv[1]);
    if (argc > 2) burst_seed = (uint32_t)strtoul(argv[2], NULL, 10);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
