// test_loader.c - a thread loads and unloads heightfields while worlds that share the store step on others.
//
// For ThreadSanitizer above all: a step takes no lock, and what the loader writes is nothing that a step reads. What
// the worlds compute must not show that there was a loader.
#include "api/api_test.h"
#include "core/memory.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { STEPS = 60 };
#else
enum { STEPS = 240 };
#endif
enum { WORLDS = 2, SIDE = 17, SAMPLES = SIDE * SIDE, ROUND = 6 };

static void fill(float *heights, int32_t seed)
{
    for (int32_t i = 0; i < SAMPLES; ++i) heights[i] = 0.1f * (float)((i * 7 + seed) % 11);
}

static fe_asset load(fe_store *store, int32_t seed)
{
    float heights[SAMPLES];
    fill(heights, seed);
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = SIDE, d.heights = heights;
    fe_asset asset = 0;
    return fe_heightfield_create(store, &d, &asset) == FE_OK ? asset : 0;
}

// ---- the loader ----------------------------------------------------------------------------------------------------

typedef struct loader {
    fe_store *store;
    fe_asset used; // by the worlds
    _Atomic int32_t stop, rounds;
    int32_t errors, refused, edits; // cmocka's failures belong to the main thread
} loader;

// Heights as they are: when no world steps the edit is done, and changes nothing but who is awake.
static void try_an_edit(loader *l)
{
    float heights[SAMPLES];
    l->errors += fe_heightfield_get_heights(l->store, l->used, 0, 0, SIDE, SIDE, heights) != FE_OK;
    heights[0] = 20.0f; // where nobody is; refused, unless all worlds are idle
    fe_result result = fe_heightfield_set_heights(l->store, l->used, 0, 0, 1, 1, heights);
    l->edits += result == FE_OK;
    l->refused += result == FE_ERROR_STEPPING || result == FE_ERROR_BUSY;
    l->errors += result != FE_OK && result != FE_ERROR_STEPPING && result != FE_ERROR_BUSY;
}

static void *work(void *argument)
{
    loader *l = argument;
    fe_asset assets[ROUND];
    while (!atomic_load(&l->stop)) {
        for (int32_t i = 0; i < ROUND; ++i) {
            assets[i] = load(l->store, 3 * i);
            l->errors += assets[i] == 0 || !fe_asset_is_valid(l->store, assets[i]);
        }
        int64_t bytes = 0;
        l->errors += fe_store_get_bytes(l->store, &bytes) != FE_OK || bytes < (int64_t)ROUND * SAMPLES * 4;
        for (int32_t i = 0; i < ROUND; ++i) {
            float got[SAMPLES], expected[SAMPLES];
            fill(expected, 3 * i);
            l->errors += fe_heightfield_get_heights(l->store, assets[i], 0, 0, SIDE, SIDE, got) != FE_OK;
            l->errors += memcmp(got, expected, sizeof got) != 0;
            l->errors += fe_asset_destroy(l->store, assets[i]) != FE_OK || fe_asset_is_valid(l->store, assets[i]);
        }
        if (l->used) try_an_edit(l);
        atomic_fetch_add(&l->rounds, 1);
    }
    return NULL;
}

// ---- the worlds ----------------------------------------------------------------------------------------------------

static fe_body add_terrain(fe_world *world, fe_asset asset, double x)
{
    fe_geometry g;
    fe_geometry_heightfield(&g, asset);
    fe_body body = new_body(world, FE_BODY_STATIC, x, 0, 0);
    add_shape(world, body, &g);
    return body;
}

static fe_world *new_world_on(fe_store *store, fe_asset asset, int32_t workers)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store;
    def.worker_count = workers;
    fe_world *world = NULL;
    OK(fe_world_create(&def, &world));
    add_terrain(world, asset, 0.0);
    for (int32_t i = 0; i < 40; ++i) new_box(world, 2.0 + 1.5 * (i % 8), 2.0 + 1.2 * (i / 8), 3.0 + 1.3 * (i % 7));
    return world;
}

// Terrain that comes and goes beside it, through the handle that this thread loaded and lets go of at once
static void stream(fe_world *world, fe_store *store, int32_t step_number, fe_body *tile)
{
    if (step_number % 10 == 3) {
        fe_asset asset = load(store, step_number);
        FE_TRUE(asset != 0);
        *tile = add_terrain(world, asset, 100.0);
        OK(fe_asset_destroy(store, asset));
    }
    if (step_number % 10 == 8) OK(fe_body_destroy(world, *tile));
}

static void run(fe_store *store, fe_asset asset, uint64_t *out_hashes)
{
    fe_world *worlds[WORLDS];
    fe_body tiles[WORLDS] = {0};
    for (int32_t w = 0; w < WORLDS; ++w) worlds[w] = new_world_on(store, asset, 1 + w);
    for (int32_t i = 0; i < STEPS; ++i) {
        for (int32_t w = 0; w < WORLDS; ++w) {
            fe_result result;
            do result = fe_world_step(worlds[w], 1.0f / 60.0f);
            while (result == FE_ERROR_BUSY); // the loader is about to edit
            OK(result);
            stream(worlds[w], store, i, tiles + w);
        }
    }
    for (int32_t w = 0; w < WORLDS; ++w) {
        out_hashes[w] = hash_of(worlds[w]);
        OK(fe_world_destroy(worlds[w]));
    }
}

static void begin(loader *l, pthread_t *thread)
{
    assert_int_equal(pthread_create(thread, NULL, work, l), 0);
    while (!atomic_load(&l->rounds)) {} // it is at work before the first step
}

static void end(loader *l, pthread_t thread)
{
    atomic_store(&l->stop, 1);
    pthread_join(thread, NULL);
    assert_int_equal(l->errors, 0);
    FE_TRUE(atomic_load(&l->rounds) > 0);
}

static void worlds_step_beside_a_loader_as_without_one(void **state)
{
    (void)state;
    fe_store *store = NULL;
    OK(fe_store_create(NULL, &store));
    fe_asset asset = load(store, 5);
    uint64_t alone[WORLDS], beside[WORLDS];
    run(store, asset, alone);
    FE_TRUE(alone[0] == alone[1]);

    loader l = {.store = store};
    pthread_t thread;
    begin(&l, &thread);
    run(store, asset, beside);
    end(&l, thread);
    for (int32_t w = 0; w < WORLDS; ++w) FE_TRUE(beside[w] == alone[w]);
    OK(fe_store_destroy(store));
}

// Each world on a thread of its own, and a loader that also tries to edit what they stand on.
typedef struct stepper {
    fe_world *world;
    int32_t errors, waits;
} stepper;

static void *keep_stepping(void *argument)
{
    stepper *s = argument;
    for (int32_t i = 0; i < STEPS; ++i) {
        fe_result result;
        do {
            result = fe_world_step(s->world, 1.0f / 60.0f);
            s->waits += result == FE_ERROR_BUSY;
        } while (result == FE_ERROR_BUSY);
        s->errors += result != FE_OK;
    }
    return NULL;
}

static void edits_come_between_steps_or_not_at_all(void **state)
{
    (void)state;
    fe_store *store = NULL;
    OK(fe_store_create(NULL, &store));
    fe_asset asset = load(store, 5);
    stepper steppers[WORLDS] = {{0}};
    pthread_t threads[WORLDS], thread;
    for (int32_t w = 0; w < WORLDS; ++w) steppers[w].world = new_world_on(store, asset, 1);
    loader l = {.store = store, .used = asset};
    begin(&l, &thread);
    for (int32_t w = 0; w < WORLDS; ++w)
        assert_int_equal(pthread_create(threads + w, NULL, keep_stepping, steppers + w), 0);
    for (int32_t w = 0; w < WORLDS; ++w) pthread_join(threads[w], NULL);
    end(&l, thread);
    for (int32_t w = 0; w < WORLDS; ++w) assert_int_equal(steppers[w].errors, 0);
    FE_TRUE(l.edits > 0 && l.edits + l.refused == atomic_load(&l.rounds));
    for (int32_t w = 0; w < WORLDS; ++w) OK(fe_world_destroy(steppers[w].world));
    OK(fe_store_destroy(store));
}

// A host's allocator that is not made for threads: a world and its own store never call it at the same time.
typedef struct unguarded {
    int64_t blocks; // plain: ThreadSanitizer sees two calls at once
    _Atomic int32_t inside;
    int32_t clashes;
} unguarded;

static void *allocate(void *user, uint64_t size, uint64_t alignment)
{
    unguarded *u = user;
    u->clashes += atomic_fetch_add(&u->inside, 1) != 0;
    sched_yield(); // time for another thread to come in
    void *block = fe__aligned_allocate((size_t)size, (size_t)alignment);
    u->blocks += block != NULL;
    atomic_fetch_sub(&u->inside, 1);
    return block;
}

static void release(void *user, void *block, uint64_t size)
{
    (void)size;
    unguarded *u = user;
    u->clashes += atomic_fetch_add(&u->inside, 1) != 0;
    fe__aligned_free(block);
    u->blocks -= 1;
    atomic_fetch_sub(&u->inside, 1);
}

static void a_world_and_its_own_store_take_turns_at_the_allocator(void **state)
{
    (void)state;
    unguarded u = {0};
    fe_allocator allocator = {.struct_size = sizeof allocator, .allocate = allocate, .release = release, .user = &u};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    fe_world *world = NULL;
    OK(fe_world_create(&def, &world));
    loader l = {0};
    OK(fe_world_get_store(world, &l.store));
    pthread_t thread;
    begin(&l, &thread);
    for (int32_t i = 0; i < 20 * STEPS; ++i) {
        if (i < 100) new_box(world, 2.0 * (i % 50), 1.0 + 2.0 * (i / 50), 0.0); // the world's arrays grow
        OK(fe_world_optimize(world));                                           // scratch memory each time
    }
    end(&l, thread);
    fe_counters c;
    fe_counters_init(&c, sizeof c);
    OK(fe_world_get_counters(world, &c));
    FE_WITHIN(c.bytes, 0, 500000); // 5 KB a body: trees that are built anew do not grow
    OK(fe_world_destroy(world));
    FE_TRUE(u.blocks == 0 && u.clashes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worlds_step_beside_a_loader_as_without_one),
        cmocka_unit_test(edits_come_between_steps_or_not_at_all),
        cmocka_unit_test(a_world_and_its_own_store_take_turns_at_the_allocator),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
