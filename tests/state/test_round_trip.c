// test_round_trip.c - random scenes, saved at random moments, restored in place and loaded anew: both go on as the
// saved world did, under the same random calls. After each step all three have the same bytes, which hold their events
// and the handles to come, too.
//
//   test_round_trip [moments]    20; 1000 before a release
#include "api/api_test.h"
#include "state/snapshot_bytes.h"
#include "snapshot/format.h"
#include "support/fuzz_state.h"

enum { SCENES = 100, STEPS = 600, STREAM = 1 << 15, NUMBER = 3, LEAST_MOMENTS = 20 };

typedef struct scene {
    fuzz f;
    uint8_t stream[STREAM];
    fe_store *store;
    uint32_t seed;
} scene;

// ---- worlds --------------------------------------------------------------------------------------------------------
static fe_world_def definition(const scene *s, int32_t workers, int32_t simd)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = s->store, def.number = NUMBER, def.worker_count = workers, def.simd = simd;
    return def;
}

// Something to fall on, and to sleep on
static void add_slab(fe_world *world)
{
    fe_geometry box;
    fe_geometry_box(&box, 30.0f, 1.0f, 30.0f);
    add_shape(world, new_body(world, FE_BODY_STATIC, 0.0, -3.0, 0.0), &box);
}

// ---- calls ---------------------------------------------------------------------------------------------------------
// Assets are the store's, not the world's: none is destroyed, and after a moment none is made or edited. What makes one
// destroys one, where there is no room for more. A filter is the host's
static int32_t is_allowed(const fuzz *f, const char *name, int32_t after)
{
    const int32_t room = sizeof f->assets / sizeof *f->assets;
    if (!strcmp(name, "no memory") || !strcmp(name, "fe_world_set_pair_filter") || !strcmp(name, "fe_asset_destroy"))
        return 0;
    if (!strcmp(name, "fe_heightfield_create")) return !after && f->asset_count < room;
    return !after || strcmp(name, "fe_heightfield_set_heights");
}

static void call_some(fuzz *f, int32_t count, int32_t after)
{
    for (int32_t i = 0; i < count; ++i) {
        const fuzz_call *c = fuzz_calls + fuzz_byte(f) % fuzz_call_count;
        f->call_name = c->name, f->steps = 0, f->call_count += 1;
        if (is_allowed(f, c->name, after)) (void)c->run(f);
    }
}

// A stream of its own for each moment
static void refill(scene *s)
{
    for (int32_t i = 0; i < STREAM; ++i) s->stream[i] = (uint8_t)draw(&s->seed);
    s->f.bytes = s->stream, s->f.size = STREAM, s->f.at = 0;
}

// ---- a course: a call now and then, and the snapshot after each step ------------------------------------------------
typedef struct course {
    bytes after[STEPS];
} course;

// A tree that was much larger once has more room than a snapshot tells, and than one that was restored: which shows in
// bytes, not in results
static void forget_room(bytes b)
{
    enum { AT_ROOM = 4, TREES = 2 };
    int64_t at = section_at(b, FE__TABLE_TREES);
    for (int32_t i = 0; i < TREES; ++i)
        memset(b.data + at + SECTION + ROWS + i * fe__tables[FE__TABLE_TREES].row_size + AT_ROOM, 0, sizeof(int32_t));
    mend(b);
}

static int32_t are_same(bytes a, bytes b) { return a.size == b.size && memcmp(a.data, b.data, (size_t)a.size) == 0; }

static void expect_same(const char *how, uint32_t seed, int32_t step, bytes a, bytes b)
{
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    if (are_same(a, b)) return;
    forget_room(a), forget_room(b);
    if (are_same(a, b)) return;
    int32_t found = fe_snapshot_compare(a.data, a.size, b.data, b.size, &d);
    fail_msg("seed %u, %s, after step %d: %d: %s %llx %llx: %s[%d] is %s and %s", seed, how, (int)step, (int)found,
             d.kind, (unsigned long long)d.handle, (unsigned long long)d.other, d.field, (int)d.element, d.a, d.b);
}

static void next_step(fuzz *f)
{
    call_some(f, fuzz_byte(f) % 8 == 0, 1);
    FE_TRUE(fe_world_step(f->world, 1.0f / 60.0f) == FE_OK);
}

static void run(fuzz *f, course *c)
{
    for (int32_t i = 0; i < STEPS; ++i) {
        next_step(f);
        c->after[i] = save(f->world);
    }
}

static void run_again(const char *how, uint32_t seed, fuzz *f, const course *c)
{
    for (int32_t i = 0; i < STEPS; ++i) {
        next_step(f);
        bytes b = save(f->world);
        expect_same(how, seed, i, c->after[i], b);
        free(b.data);
    }
}

static void expect_same_handles(const fuzz *a, const fuzz *b)
{
    FE_TRUE(memcmp(a->bodies, b->bodies, sizeof a->bodies) == 0);
    FE_TRUE(memcmp(a->shapes, b->shapes, sizeof a->shapes) == 0);
    FE_TRUE(memcmp(a->joints, b->joints, sizeof a->joints) == 0);
}

static fe_world *load(const scene *s, bytes from, int32_t turn)
{
    static const int32_t workers[] = {2, 1, 7}, sets[] = {FE_SIMD_PLAIN, FE_SIMD_AUTO};
    fe_world_def def = definition(s, workers[turn % 3], sets[turn % 2]);
    fe_world *world;
    if (fe_world_load(&def, NULL, from.data, from.size, &world) != FE_OK)
        fail_msg("seed %u: %s", s->seed, fe_last_error());
    return world;
}

static void forget_snapshots(fuzz *f)
{
    free(f->before.bytes);
    free(f->after.bytes);
}

// ---- one moment ----------------------------------------------------------------------------------------------------
static void go_on_three_times(scene *s, int32_t turn)
{
    static fuzz then, anew;
    static course first;
    uint32_t seed = s->seed;
    bytes moment = save(s->f.world), again;
    then = anew = s->f;
    const fuzz_snapshot none = {0}; // each keeps its own
    then.before = then.after = anew.before = anew.after = none;
    run(&s->f, &first);
    anew.world = load(s, moment, turn);
    again = save(anew.world);
    expect_same("loaded", seed, -1, moment, again);
    free(again.data);
    run_again("loaded", seed, &anew, &first);
    expect_same_handles(&s->f, &anew);
    FE_TRUE(fe_world_destroy(anew.world) == FE_OK);
    if (fe_world_restore(then.world, NULL, moment.data, moment.size) != FE_OK)
        fail_msg("seed %u: %s", seed, fe_last_error());
    again = save(then.world);
    expect_same("restored", seed, -1, moment, again);
    free(again.data);
    run_again("restored", seed, &then, &first);
    expect_same_handles(&s->f, &then);
    forget_snapshots(&then), forget_snapshots(&anew);
    free(moment.data);
    for (int32_t i = 0; i < STEPS; ++i) free(first.after[i].data);
}

static void play_scene(uint32_t seed, int32_t moments)
{
    static scene s;
    fe_store_def store;
    memset(&s, 0, sizeof s);
    fe_store_def_init(&store, sizeof store);
    store.number = NUMBER;
    FE_TRUE(fe_store_create(&store, &s.store) == FE_OK);
    fe_world_def def = definition(&s, 1, FE_SIMD_AUTO);
    FE_TRUE(fe_world_create(&def, &s.f.world) == FE_OK);
    add_slab(s.f.world);
    s.seed = seed;
    for (int32_t i = 0; i < moments; ++i) {
        refill(&s);
        call_some(&s.f, 20 + (int32_t)(draw(&s.seed) % 100), 0);
        go_on_three_times(&s, i);
    }
    forget_snapshots(&s.f);
    FE_TRUE(fe_world_destroy(s.f.world) == FE_OK && fe_store_destroy(s.store) == FE_OK);
}

static int32_t moment_count = LEAST_MOMENTS;

static void worlds_go_on_from_random_moments(void **state)
{
    (void)state;
    for (int32_t done = 0, i = 0; done < moment_count; ++i) {
        int32_t scenes_left = SCENES - i % SCENES, left = moment_count - done;
        int32_t moments = (left + scenes_left - 1) / scenes_left;
        play_scene(1 + (uint32_t)i, moments);
        done += moments;
    }
}

// A body that bore much, fell asleep, and woke again
static void a_burden_ends_in_sleep(void **state)
{
    (void)state;
    play_scene(21, 2);
}

int main(int argc, char **argv)
{
    if (argc > 1) moment_count = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_burden_ends_in_sleep),
                                       cmocka_unit_test(worlds_go_on_from_random_moments)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
