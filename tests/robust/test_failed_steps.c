// test_failed_steps.c - a step that finds no memory leaves the world as it was, to the last byte of its snapshot.
//
// Scripts of every kind are played, and now and then the world is looked at, after the calls that come before a step. A
// clone of it that starts with no more memory than its state takes makes that step, in which the first allocation
// fails, the second, the third, until none does. After each failure the clone's snapshot is compared with that before
// the step, and loaded; the step that follows must lead where it leads a world that never lacked memory. The first
// argument is the number of draws, the second the seed.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "state/snapshot_bytes.h"
#include "support/play.h"

#include <stdio.h>

#if defined(FE_SANITIZED)
enum { DRAWS = 15 };
#else
enum { DRAWS = 300 };
#endif

static int32_t draws = DRAWS;
static uint32_t seed = 1;

static uint32_t pick(uint32_t count) { return draw(&seed) % count; }

// A script is played once, and looked at so often
static const struct {
    const script *script;
    int32_t share, steps;
} scripts[] = {{&script_brief, 5, 200},    {&script_mixed, 3, 200}, {&script_terrain, 2, 150}, {&script_fast, 3, 150},
               {&script_joints, 3, 200},   {&script_spawn, 3, 150}, {&script_solids, 2, 150},  {&script_meshes, 2, 150},
               {&script_scales, 2, 150},   {&script_turns, 2, 150}, {&script_cooked, 1, 100},  {&script_crowd, 2, 60},
               {&script_compounds, 2, 100}};
enum { SCRIPTS = sizeof scripts / sizeof *scripts };

static struct {
    int64_t failures, changed, refused, strayed;
} told;

static fe_world *clone_of(const fe_world *world, counting *memory, int32_t workers)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    fe_allocator allocator = counting_allocator(memory);
    def.allocator = &allocator;
    def.worker_count = workers;
    fe_world *clone = NULL;
    FE_TRUE(fe_world_clone(world, &def, &clone) == FE_OK);
    return clone;
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    return (uint64_t)words[1] << 32 | words[0];
}

static void tell_difference(const bytes *before, const bytes *after, const char *where)
{
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    int32_t found = fe_snapshot_compare(before->data, before->size, after->data, after->size, &d);
    if (found > 0)
        print_error("%s: %s 0x%llx %s[%d] %s -> %s\n", where, d.kind, d.handle, d.field, d.element, d.a, d.b);
    if (found == 0) print_error("%s: bytes of the same numbers\n", where);
    if (found < 0) print_error("%s: %s\n", where, fe_last_error());
}

static void look_at_failed(const fe_world *world, const bytes *before, const char *where)
{
    bytes after = save(world);
    told.failures += 1;
    if (after.size != before->size || memcmp(after.data, before->data, (size_t)after.size) != 0) {
        if (told.changed++ < 3) tell_difference(before, &after, where);
    }
    if (fe_snapshot_check(after.data, after.size, NULL) != FE_OK && told.refused++ < 3)
        print_error("%s: %s\n", where, fe_last_error());
    free(after.data);
}

// The step of length dt, of which every allocation fails once
static void fail_each_allocation(const fe_world *world, float dt, const char *where)
{
    int32_t workers = 1 + (int32_t)pick(3);
    counting memory = {0};
    fe_world *peer = clone_of(world, &memory, workers);
    FE_TRUE(fe_world_step(peer, dt) == FE_OK);
    uint64_t hash = hash_of(peer);
    fe_world_destroy(peer);
    fe_result result = FE_ERROR_MEMORY;
    for (int64_t k = 1; result == FE_ERROR_MEMORY; ++k) {
        memory = (counting){0};
        fe_world *clone = clone_of(world, &memory, workers);
        bytes before = save(clone);
        memory.fail_from = memory.calls + k, memory.fail_count = 1;
        result = fe_world_step(clone, dt);
        memory.fail_count = 0;
        if (result == FE_ERROR_MEMORY) {
            look_at_failed(clone, &before, where);
            FE_TRUE(fe_world_step(clone, dt) == FE_OK);
        }
        if (hash_of(clone) != hash && told.strayed++ < 3) print_error("%s: it goes on otherwise\n", where);
        free(before.data);
        fe_world_destroy(clone);
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
    FE_TRUE(result == FE_OK);
}

// The same of a batch of three, which share what a step needs: each world is stepped, or as it was
static void fail_each_of_a_batch(const fe_world *world, float dt, const char *where)
{
    enum { WORLDS = 3 };
    counting memory = {0};
    fe_batch_def def;
    fe_batch_def_init(&def, sizeof def);
    fe_allocator allocator = counting_allocator(&memory);
    def.allocator = &allocator;
    def.world_count = WORLDS;
    fe_world *peer = clone_of(world, &memory, 1);
    bytes before = save(peer);
    FE_TRUE(fe_world_step(peer, dt) == FE_OK);
    uint64_t hash = hash_of(peer);
    fe_world_destroy(peer);
    int32_t failed = 1, results[WORLDS];
    for (int64_t k = 1; memory.failures || k == 1; ++k) {
        memory = (counting){0};
        fe_batch *batch = NULL;
        FE_TRUE(fe_batch_create(world, &def, &batch) == FE_OK);
        memory.fail_from = memory.calls + k, memory.fail_count = 1;
        failed = fe_batch_step(batch, dt, 1, NULL, results);
        memory.fail_count = 0;
        FE_TRUE(failed >= 0);
        for (int32_t i = 0; i < WORLDS; ++i) {
            fe_world *w = NULL;
            FE_TRUE(fe_batch_get_world(batch, i, &w) == FE_OK);
            if (results[i] == FE_ERROR_MEMORY) {
                look_at_failed(w, &before, where);
                FE_TRUE(fe_world_step(w, dt) == FE_OK);
            }
            if (hash_of(w) != hash && told.strayed++ < 3) print_error("%s: a batch goes on otherwise\n", where);
        }
        FE_TRUE(fe_batch_destroy(batch) == FE_OK);
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
    free(before.data);
}

// A world that is loaded has no capacity beyond its state
static fe_world *load_again(const fe_world *world)
{
    bytes b = save_with_assets(world);
    fe_world *loaded = NULL;
    if (b.size > 0) FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, &loaded) == FE_OK);
    free(b.data);
    return loaded;
}

// Of a script whose calls before a step were made twice, some are refused
static int32_t pass_over(play *p, fe_result result)
{
    (void)p, (void)result;
    return 0;
}

static void look(const play *p, const script *s)
{
    static const float rates[] = {30.0f, 60.0f, 120.0f};
    char where[64];
    snprintf(where, sizeof where, "%s, step %d", s->name, (int)p->step);
    fe_world *loaded = pick(2) ? load_again(p->world) : NULL;
    fe_world *world = loaded ? loaded : p->world;
    if (loaded) FE_TRUE(fe_world_set_substeps(loaded, pick(2) ? 4 : 8) == FE_OK);
    (pick(8) ? fail_each_allocation : fail_each_of_a_batch)(world, 1.0f / rates[pick(3)], where);
    if (loaded) fe_world_destroy(loaded);
}

static void play_script(const script *s, int32_t steps, int32_t looks)
{
    play p;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    fe_world *world = NULL;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    play_begin(&p, world);
    p.after = pass_over;
    if (steps > s->steps) steps = s->steps;
    for (int32_t step = 0; step < steps && looks > 0; ++step) {
        play_until(&p, s, step);
        int32_t now = (int32_t)pick((uint32_t)(steps - step)) < looks;
        if (!now) continue;
        s->act(&p); // the calls that come before a step
        look(&p, s);
        --looks;
    }
    fe_world_destroy(p.world);
}

static void a_failed_step_leaves_every_byte(void **state)
{
    (void)state;
    int32_t shares = 0, done = 0;
    for (int32_t i = 0; i < SCRIPTS; ++i) shares += scripts[i].share;
    for (int32_t i = 0, share = 0; i < SCRIPTS; ++i) {
        share += scripts[i].share;
        int32_t until = (int32_t)((int64_t)draws * share / shares);
        while (done < until) {
            int32_t looks = until - done < scripts[i].steps / 2 ? until - done : scripts[i].steps / 2;
            play_script(scripts[i].script, scripts[i].steps, looks);
            done += looks;
        }
    }
    print_message("%d draws, %lld failed steps: %lld changed bytes, %lld cannot be loaded, %lld went on otherwise\n",
                  (int)draws, (long long)told.failures, (long long)told.changed, (long long)told.refused,
                  (long long)told.strayed);
    FE_TRUE(told.failures > 4 * (int64_t)draws);
    assert_int_equal(told.changed, 0);
    assert_int_equal(told.refused, 0);
    assert_int_equal(told.strayed, 0);
}

int main(int argc, char **argv)
{
    if (argc > 1) draws = atoi(argv[1]);
    if (argc > 2) seed = (uint32_t)strtoul(argv[2], NULL, 0);
    print_message("seed %u\n", (unsigned)seed);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_failed_step_leaves_every_byte)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
