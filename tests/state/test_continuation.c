// test_continuation.c - a script played in one world, and played again in worlds that are made anew from bytes on the
// way, or become what they were, with other workers and SIMD sets: after each step the same hash and the same events,
// and the same bytes, to the last.
#include "fe_test.h"
#include "support/play.h"

#include <stdlib.h>
#include <string.h>

enum { NUMBER = 7, HOP = 7, MOST_STEPS = 1024 }; // HOP: steps from one exchange to the next, odd

typedef struct bytes {
    unsigned char *data;
    int64_t size;
} bytes;

static bytes save(const fe_world *world)
{
    bytes b;
    b.size = fe_world_save(world, NULL, NULL, 0);
    FE_TRUE(b.size > 0);
    b.data = malloc((size_t)b.size);
    FE_TRUE(fe_world_save(world, NULL, b.data, b.size) == b.size);
    return b;
}

// Of the section at a place: its number, see src/snapshot/format.h
static uint32_t word_at(bytes b, int64_t at)
{
    uint32_t word = 0;
    for (int k = 3; k >= 0; --k) word = word << 8 | b.data[at + k];
    return word;
}

// The header's sum is that of the sections, and a section's stands before it
static void expect_same(const char *script, int32_t step, bytes a, bytes b)
{
    enum { HEADER = 48, SECTION = 24 };
    for (int64_t at = HEADER; at < a.size && at < b.size;) {
        int64_t size = word_at(a, at + 8), same = 0;
        while (same < size && a.data[at + SECTION + same] == b.data[at + SECTION + same]) ++same;
        if (word_at(b, at + 8) != size || same < size)
            fail_msg("%s, step %d: byte %lld of section %u differs (%u, %u rows)", script, (int)step, (long long)same,
                     (unsigned)word_at(a, at), (unsigned)word_at(a, at + SECTION), (unsigned)word_at(b, at + SECTION));
        at += SECTION + size;
    }
    FE_TRUE(a.size == b.size && memcmp(a.data, b.data, (size_t)a.size) == 0);
}

static fe_world_def definition(fe_store *store, int32_t workers, int32_t simd)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store, def.number = NUMBER, def.worker_count = workers, def.simd = simd;
    return def;
}

static fe_store *new_store(void)
{
    fe_store_def def;
    fe_store *store;
    fe_store_def_init(&def, sizeof def);
    def.number = NUMBER;
    FE_TRUE(fe_store_create(&def, &store) == FE_OK);
    return store;
}

// The next set that this CPU has
static fe_world *load(fe_store *store, bytes from, int32_t turn)
{
    static const int32_t workers[] = {2, 1, 8, 3}, sets[] = {FE_SIMD_PLAIN, FE_SIMD_AUTO, FE_SIMD_SSE2, FE_SIMD_AVX2};
    fe_world_def def = definition(store, workers[turn % 4], sets[turn / 2 % 4]);
    fe_world *world;
    fe_result result = fe_world_load(&def, NULL, from.data, from.size, &world);
    if (result == FE_ERROR_UNSUPPORTED) {
        def.simd = FE_SIMD_AUTO;
        result = fe_world_load(&def, NULL, from.data, from.size, &world);
    }
    if (result != FE_OK) fail_msg("%s", fe_last_error());
    return world;
}

typedef struct course {
    uint64_t hash[MOST_STEPS], told[MOST_STEPS];
    bytes last;
} course;

static void note(course *c, const play *p) { c->hash[p->step] = play_hash(p), c->told[p->step] = play_told(p); }

static int32_t steps_of(const script *s) { return s->steps < MOST_STEPS - 1 ? s->steps : MOST_STEPS - 1; }

static void play_alone(const script *s, course *c)
{
    static play p;
    fe_store *store = new_store();
    fe_world_def def = definition(store, 1, FE_SIMD_AUTO);
    fe_world *world;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    play_begin(&p, world);
    for (int32_t step = 1; step <= steps_of(s); ++step) {
        play_until(&p, s, step);
        note(c, &p);
    }
    c->last = save(world);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_store_destroy(store) == FE_OK);
}

// In place, after a few steps too many; or anew
static void exchange(const script *s, play *p, fe_store *store, int32_t turn)
{
    bytes before = save(p->world);
    if (fe_snapshot_check(before.data, before.size, NULL) != FE_OK) fail_msg("%s", fe_last_error());
    if (turn % 2) {
        for (int32_t i = 0; i < 3; ++i) FE_TRUE(fe_world_step(p->world, p->dt) == FE_OK);
        if (fe_world_restore(p->world, NULL, before.data, before.size) != FE_OK) fail_msg("%s", fe_last_error());
    } else {
        fe_world *world = load(store, before, turn);
        FE_TRUE(fe_world_destroy(p->world) == FE_OK);
        p->world = world;
    }
    bytes after = save(p->world);
    expect_same(s->name, p->step, before, after);
    free(before.data);
    free(after.data);
}

static void play_with_exchanges(const script *s, const course *c, int32_t first)
{
    static play p;
    fe_store *store = new_store();
    fe_world_def def = definition(store, 3, FE_SIMD_AUTO);
    fe_world *world;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    play_begin(&p, world);
    for (int32_t step = 1; step <= steps_of(s); ++step) {
        play_until(&p, s, step);
        if (play_hash(&p) != c->hash[step] || play_told(&p) != c->told[step])
            fail_msg("%s goes another way in step %d", s->name, step);
        if (step % HOP == first) exchange(s, &p, store, step / HOP);
    }
    bytes last = save(p.world);
    expect_same(s->name, p.step, c->last, last);
    free(last.data);
    FE_TRUE(fe_world_destroy(p.world) == FE_OK && fe_store_destroy(store) == FE_OK);
}

static void goes_on_bit_for_bit(const script *s)
{
    static course c;
    play_alone(s, &c);
    play_with_exchanges(s, &c, 0);
    free(c.last.data);
}

#define CASE(name) \
    static void name##_goes_on_bit_for_bit(void **state) { (void)state, goes_on_bit_for_bit(&script_##name); }
CASE(brief)
CASE(crowd)
CASE(mixed)
CASE(terrain)
CASE(fast)
CASE(joints)
CASE(spawn)
CASE(solids)
CASE(meshes)
CASE(cooked)
CASE(scales)
CASE(turns)
CASE(compounds)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brief_goes_on_bit_for_bit),     cmocka_unit_test(crowd_goes_on_bit_for_bit),
        cmocka_unit_test(mixed_goes_on_bit_for_bit),     cmocka_unit_test(terrain_goes_on_bit_for_bit),
        cmocka_unit_test(fast_goes_on_bit_for_bit),      cmocka_unit_test(joints_goes_on_bit_for_bit),
        cmocka_unit_test(spawn_goes_on_bit_for_bit),     cmocka_unit_test(solids_goes_on_bit_for_bit),
        cmocka_unit_test(meshes_goes_on_bit_for_bit),    cmocka_unit_test(cooked_goes_on_bit_for_bit),
        cmocka_unit_test(scales_goes_on_bit_for_bit),    cmocka_unit_test(turns_goes_on_bit_for_bit),
        cmocka_unit_test(compounds_goes_on_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
