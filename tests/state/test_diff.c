// test_diff.c - snapshots as differences to another one: what they make, how small they are, what is refused.
#include "api/api_test.h"
#include "robust/counting_allocator.h"
#include "state/snapshot_bytes.h"
#include "support/play.h"

enum { NUMBER = 7, DIFF_HEADER = 56, AT_WHOLE_SIZE = 32, DIFF_SUM = 48 };

static fe_store *store; // of all worlds: assets go by their keys

static int open_store(void **state)
{
    (void)state;
    fe_store_def def;
    fe_store_def_init(&def, sizeof def);
    def.number = NUMBER;
    return fe_store_create(&def, &store) == FE_OK ? 0 : -1;
}

static int close_store(void **state) { return (void)state, fe_store_destroy(store) == FE_OK ? 0 : -1; }

static fe_world_def definition(void)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.number = NUMBER, def.store = store;
    return def;
}

static fe_world *make_world(void)
{
    fe_world_def def = definition();
    fe_world *world;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

// As far as the script has come after so many steps
static fe_world *played(play *p, const script *s, int32_t steps)
{
    fe_world *world = make_world();
    play_begin(p, world);
    play_until(p, s, steps);
    return world;
}

static fe_save_options against(bytes base)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_DIFF, options.base = base.data, options.base_size = base.size;
    return options;
}

// As long as it is, so that a sanitizer sees a byte too far
static bytes save_diff(const fe_world *world, bytes base)
{
    fe_save_options options = against(base);
    int64_t room = fe_world_save(world, &options, NULL, 0);
    FE_TRUE(room > 0);
    unsigned char *out = malloc((size_t)room);
    bytes b = {NULL, fe_world_save(world, &options, out, room)};
    FE_TRUE(b.size > 0 && b.size <= room);
    b.data = malloc((size_t)b.size);
    memcpy(b.data, out, (size_t)b.size);
    free(out);
    return b;
}

static fe_result restore(fe_world *world, bytes b, bytes base)
{
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.base = base.data, options.base_size = base.size;
    return fe_world_restore(world, &options, b.data, b.size);
}

static void mend_diff(bytes b)
{
    uint64_t runs = (uint64_t)(b.size - DIFF_HEADER);
    put(b.data + DIFF_SUM, join(sum_of(b.data, DIFF_SUM), sum_of(b.data + DIFF_HEADER, runs)));
}

static void expect_same(bytes a, bytes b) { FE_TRUE(a.size == b.size && memcmp(a.data, b.data, (size_t)a.size) == 0); }

// ---- what comes of it ----------------------------------------------------------------------------------------------
// Through a whole script, so that bodies, joints and pairs come and go: each time against the one before
static void differences_make_the_worlds_they_were_saved_of(const script *s, int32_t hop)
{
    static play p;
    fe_world *world = played(&p, s, 1), *twin = make_world();
    bytes base = save(world);
    for (int32_t step = 1 + hop; step <= s->steps; step += hop) {
        play_until(&p, s, step);
        bytes whole = save(world), diff = save_diff(world, base);
        if (restore(twin, diff, base) != FE_OK) fail_msg("%s, step %d: %s", s->name, (int)step, fe_last_error());
        bytes again = save(twin);
        expect_same(whole, again);
        FE_TRUE(diff.size <= DIFF_HEADER + whole.size);
        free(base.data), free(diff.data), free(again.data);
        base = whole;
    }
    free(base.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(twin) == FE_OK);
}

#define CASE(name, hop)                                                      \
    static void differences_make_the_world_of_##name(void **state)           \
    {                                                                        \
        (void)state;                                                         \
        differences_make_the_worlds_they_were_saved_of(&script_##name, hop); \
    }
CASE(brief, 1)
CASE(mixed, 17)
CASE(terrain, 23)
CASE(joints, 23)
CASE(compounds, 23)

// Against a world of another kind, or an empty one, and from it
static void any_snapshot_is_a_base(void **state)
{
    (void)state;
    static play p;
    fe_world *empty = make_world(), *full = played(&p, &script_brief, 60), *other = played(&p, &script_mixed, 20);
    fe_world *worlds[] = {empty, full, other};
    bytes wholes[] = {save(empty), save(full), save(other)};
    for (int from = 0; from < 3; ++from)
        for (int to = 0; to < 3; ++to) {
            fe_world *twin = NULL;
            bytes diff = save_diff(worlds[to], wholes[from]);
            fe_restore_options options;
            fe_restore_options_init(&options, sizeof options);
            options.base = wholes[from].data, options.base_size = wholes[from].size;
            fe_world_def def = definition();
            FE_TRUE(fe_world_load(&def, &options, diff.data, diff.size, &twin) == FE_OK);
            bytes again = save(twin);
            expect_same(wholes[to], again);
            free(again.data), free(diff.data);
            FE_TRUE(fe_world_destroy(twin) == FE_OK);
        }
    for (int i = 0; i < 3; ++i) {
        free(wholes[i].data);
        FE_TRUE(fe_world_destroy(worlds[i]) == FE_OK);
    }
}

// The header, a run from the first to the last word, and where nothing changed no word at all
static void what_did_not_change_costs_nothing(void **state)
{
    (void)state;
    static play p;
    fe_world *world = played(&p, &script_brief, 60);
    bytes base = save(world), diff = save_diff(world, base);
    FE_TRUE(diff.size <= DIFF_HEADER + 8);
    FE_TRUE(restore(world, diff, base) == FE_OK);
    free(base.data), free(diff.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// ---- arguments -----------------------------------------------------------------------------------------------------
static void saving_a_difference_checks_its_base(void **state)
{
    (void)state;
    fe_world *world = make_world();
    bytes base = save(world), diff = save_diff(world, base);
    unsigned char room[8] = {0};
    fe_save_options options = against(base);
    int64_t most = fe_world_save(world, &options, NULL, 0);
    FE_TRUE(most >= base.size && most <= base.size + base.size / 4 + 64);
    FE_TRUE(fe_world_save(world, &options, room, sizeof room) == most && room[0] == 0);
    options.base = NULL;
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_ARGUMENT);
    options = against(base), options.base_size = -1;
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_ARGUMENT);
    options = against(base), options.struct_size = 8; // of a caller that knows no base
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_ARGUMENT);
    options = against((bytes){base.data, base.size - 8});
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_DATA);
    options = against(diff);
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_DATA);
    options = against((bytes){base.data, 0});
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_DATA);
    for (int64_t at = 0; at + 8 <= base.size; at += 8) { // its structure is looked at, its numbers are not
        uint64_t held = take(base.data + at, 8);
        put(base.data + at, UINT64_MAX - (uint64_t)at);
        options = against(base);
        unsigned char *out = malloc((size_t)most);
        int64_t size = fe_world_save(world, &options, out, most);
        FE_TRUE(size > 0 || size == FE_ERROR_DATA || size == FE_ERROR_VERSION);
        free(out);
        put(base.data + at, held);
    }
    free(base.data), free(diff.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static bytes with_other_gravity(bytes of)
{
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    FE_TRUE(fe_world_restore(world, NULL, of.data, of.size) == FE_OK);
    FE_TRUE(fe_world_set_gravity(world, &(fe_vec3){0, -1, 0}) == FE_OK);
    bytes made = save(world);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
    return made;
}

static void a_difference_needs_its_own_base(void **state)
{
    (void)state;
    static play p;
    fe_world *world = played(&p, &script_brief, 30);
    bytes base = save(world);
    play_until(&p, &script_brief, 31);
    bytes other = save(world), diff = save_diff(world, base), none = {NULL, 0}, after, alike;
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    FE_TRUE(fe_world_restore(world, NULL, diff.data, diff.size) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, none) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, other) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, diff) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, (bytes){base.data, base.size - 8}) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, (bytes){base.data, 4}) == FE_ERROR_DATA);
    FE_TRUE(restore(world, diff, (bytes){base.data, -1}) == FE_ERROR_ARGUMENT);
    alike = with_other_gravity(base);
    FE_TRUE(alike.size == base.size && restore(world, diff, alike) == FE_ERROR_DATA);
    FE_TRUE(strstr(fe_last_error(), "to another base") != NULL);
    free(alike.data);
    FE_TRUE(fe_snapshot_check(diff.data, diff.size, NULL) == FE_ERROR_DATA);
    FE_TRUE(fe_snapshot_get_assets(diff.data, diff.size, NULL, 0, 0) == FE_ERROR_DATA);
    FE_TRUE(fe_snapshot_compare(diff.data, diff.size, base.data, base.size, NULL) == FE_ERROR_DATA);
    after = save(world);
    expect_same(other, after);
    FE_TRUE(restore(world, other, base) == FE_OK); // a whole one needs none
    free(base.data), free(other.data), free(diff.data), free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// A base of which a byte was altered has the sum of the right one in its header. What comes of it is refused by its own
// sums, unless the difference leaves that byte out: then the saved state comes of it
static void an_altered_base_gives_the_saved_state_or_none(void **state)
{
    (void)state;
    enum { EVERY = 61 };
    static play p;
    fe_world *world = played(&p, &script_brief, 30);
    bytes base = save(world);
    play_until(&p, &script_brief, 31);
    bytes saved = save(world), diff = save_diff(world, base);
    int32_t refused = 0;
    for (int64_t at = HEADER; at < base.size; at += EVERY) {
        base.data[at] ^= 1;
        fe_result result = restore(world, diff, base);
        base.data[at] ^= 1;
        FE_TRUE(result == FE_ERROR_DATA || result == FE_OK);
        refused += result == FE_ERROR_DATA;
        bytes after = save(world);
        expect_same(saved, after);
        free(after.data);
    }
    FE_TRUE(refused > 0);
    free(base.data), free(saved.data), free(diff.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// The same state in a world with another number has the same sum: it is a base as good, and the number is the saved one
static void the_number_is_that_of_the_saved_world(void **state)
{
    (void)state;
    enum { OTHER = 9, RECEIVER = 3 };
    static play p;
    fe_world_def def = definition();
    fe_world *world = played(&p, &script_brief, 30), *other, *receiver;
    def.number = OTHER;
    FE_TRUE(fe_world_create(&def, &other) == FE_OK);
    def.number = RECEIVER;
    FE_TRUE(fe_world_create(&def, &receiver) == FE_OK);
    bytes base = save(world), twin;
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.new_number = 1;
    FE_TRUE(fe_world_restore(other, &options, base.data, base.size) == FE_OK);
    twin = save(other);
    play_until(&p, &script_brief, 31);
    bytes whole = save(world), diff = save_diff(world, base);
    FE_TRUE(restore(receiver, diff, twin) == FE_OK);
    bytes after = save(receiver);
    expect_same(whole, after);
    free(base.data), free(twin.data), free(whole.data), free(diff.data), free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(other) == FE_OK);
    FE_TRUE(fe_world_destroy(receiver) == FE_OK);
}

// Bodies that took the slots of others, more of them than one looks ahead: what they cost is their own rows
static void what_was_replaced_costs_its_own_bytes(void **state)
{
    (void)state;
    enum { BODIES = 1000, REPLACED = 100, MOST = 2 }; // MOST: times a body's share of the whole
    fe_body bodies[BODIES];
    fe_world *world = make_world();
    for (int32_t i = 0; i < BODIES; ++i) bodies[i] = new_body(world, FE_BODY_DYNAMIC, i, 0.0, 0.0);
    bytes base = save(world);
    for (int32_t i = 0; i < REPLACED; ++i) FE_TRUE(fe_body_destroy(world, bodies[BODIES / 2 + i]) == FE_OK);
    for (int32_t i = 0; i < REPLACED; ++i) (void)new_body(world, FE_BODY_DYNAMIC, -i, 0.0, 0.0);
    bytes whole = save(world), diff = save_diff(world, base);
    FE_TRUE(diff.size < MOST * REPLACED * (whole.size / BODIES));
    free(base.data), free(whole.data), free(diff.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// ---- bytes from anywhere -------------------------------------------------------------------------------------------
typedef struct scene {
    fe_world *world;
    bytes base, whole, diff;
} scene;

static scene make_scene(void)
{
    static play p;
    scene s = {.world = played(&p, &script_brief, 40)};
    s.base = save(s.world);
    play_until(&p, &script_brief, 42);
    s.whole = save(s.world), s.diff = save_diff(s.world, s.base);
    return s;
}

static void end_scene(scene *s)
{
    bytes after = save(s->world);
    expect_same(s->whole, after);
    free(after.data), free(s->base.data), free(s->whole.data), free(s->diff.data);
    FE_TRUE(fe_world_destroy(s->world) == FE_OK);
}

static void a_difference_that_is_cut_is_refused(void **state)
{
    (void)state;
    scene s = make_scene();
    for (int64_t size = 0; size < s.diff.size; ++size) {
        bytes cut = {malloc((size_t)size + 1), size};
        memcpy(cut.data, s.diff.data, (size_t)size);
        if (restore(s.world, cut, s.base) != FE_ERROR_DATA) fail_msg("cut at %lld", (long long)size);
        free(cut.data);
    }
    end_scene(&s);
}

static void each_byte_of_a_difference_counts(void **state)
{
    (void)state;
    scene s = make_scene();
    for (int64_t at = 0; at < s.diff.size; ++at) {
        s.diff.data[at] ^= (unsigned char)(1 << at % 8);
        fe_result result = restore(s.world, s.diff, s.base);
        if (result != FE_ERROR_DATA && result != FE_ERROR_VERSION)
            fail_msg("byte %lld: %d", (long long)at, (int)result);
        s.diff.data[at] ^= (unsigned char)(1 << at % 8);
    }
    end_scene(&s);
}

// Sums that are right, runs that are not. What is made is read as any bytes are, whose own sums then differ
static void runs_that_lie_are_refused(void **state)
{
    (void)state;
    enum { ROUNDS = 20000 };
    scene s = make_scene();
    bytes held = {malloc((size_t)s.diff.size), s.diff.size};
    memcpy(held.data, s.diff.data, (size_t)held.size);
    uint32_t seed = 1;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        int32_t changes = 1 + (int32_t)(draw(&seed) % 3), changed = 0;
        for (int32_t k = 0; k < changes; ++k) {
            int64_t at = DIFF_HEADER + (int64_t)draw(&seed) % (held.size - DIFF_HEADER);
            s.diff.data[at] = (unsigned char)(draw(&seed) % 4 ? draw(&seed) : 0xff);
            changed |= s.diff.data[at] != held.data[at];
        }
        mend_diff(s.diff);
        fe_result result = restore(s.world, s.diff, s.base);
        if (result != FE_ERROR_DATA && (changed || result != FE_OK)) fail_msg("round %d: %d", (int)i, (int)result);
        memcpy(s.diff.data, held.data, (size_t)held.size);
    }
    free(held.data);
    end_scene(&s);
}

// No memory is asked for what cannot come of so few bytes: with the sum of the truth, a size of 2^40 would be believed
static void a_size_that_cannot_be_is_refused(void **state)
{
    (void)state;
    static const uint64_t sizes[] = {0, 8, 47, 49, UINT64_C(1) << 40, UINT64_MAX - 7, UINT64_MAX};
    scene s = make_scene();
    uint64_t size = take(s.diff.data + AT_WHOLE_SIZE, 8);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        put(s.diff.data + AT_WHOLE_SIZE, sizes[i]);
        mend_diff(s.diff);
        FE_TRUE(restore(s.world, s.diff, s.base) == FE_ERROR_DATA);
        FE_TRUE(strstr(fe_last_error(), "bytes come of no such difference"));
    }
    put(s.diff.data + AT_WHOLE_SIZE, size - 8); // possible, but not what the runs make
    mend_diff(s.diff);
    FE_TRUE(restore(s.world, s.diff, s.base) == FE_ERROR_DATA);
    FE_TRUE(strstr(fe_last_error(), "runs of the difference"));
    end_scene(&s);
}

// ---- memory --------------------------------------------------------------------------------------------------------
// In place and anew: the snapshot that it makes is one block more, which is given back
static void each_allocation_may_fail_and_nothing_changes(void **state)
{
    (void)state;
    scene s = make_scene();
    counting c = {.fail_count = 1};
    fe_allocator allocator = counting_allocator(&c);
    fe_world_def def = definition();
    fe_world *world = NULL;
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.base = s.base.data, options.base_size = s.base.size;
    def.allocator = &allocator;
    fe_result result = FE_ERROR_MEMORY;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        result = fe_world_load(&def, &options, s.diff.data, s.diff.size, &world);
        FE_TRUE(result == FE_OK || (result == FE_ERROR_MEMORY && c.blocks == 0 && !world));
    }
    FE_TRUE(c.failures > 10);
    c.fail_from = 0;
    FE_TRUE(fe_world_restore(world, NULL, s.base.data, s.base.size) == FE_OK);
    result = FE_ERROR_MEMORY;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        result = restore(world, s.diff, s.base);
        bytes after = save(world);
        FE_TRUE(result == FE_OK || result == FE_ERROR_MEMORY);
        expect_same(result == FE_OK ? s.whole : s.base, after);
        free(after.data);
    }
    c.fail_from = 0;
    FE_TRUE(fe_world_destroy(world) == FE_OK && c.blocks == 0 && c.bytes == 0 && c.wrong == 0);
    end_scene(&s);
}

static int64_t told_bytes(const fe_world *world)
{
    fe_counters counters = {.struct_size = sizeof counters};
    FE_TRUE(fe_world_get_counters(world, &counters) == FE_OK);
    return counters.bytes;
}

// A world that never stepped has no scratch yet: a restore opens it, and may find no memory for it
static void a_restore_that_fails_tells_the_memory_there_is(void **state)
{
    (void)state;
    scene s = make_scene();
    counting c = {.fail_count = 1};
    fe_allocator allocator = counting_allocator(&c);
    fe_world_def def = definition();
    def.allocator = &allocator;
    fe_result result = FE_ERROR_MEMORY;
    for (int32_t fail_from = 1; result != FE_OK; ++fail_from) {
        fe_world *world;
        c.fail_from = 0;
        FE_TRUE(fe_world_create(&def, &world) == FE_OK);
        int64_t besides = c.bytes - told_bytes(world); // what the world does not count
        c.calls = 0, c.fail_from = fail_from;
        result = fe_world_restore(world, NULL, s.whole.data, s.whole.size);
        assert_int_equal(c.bytes - told_bytes(world), besides);
        FE_TRUE(fe_world_destroy(world) == FE_OK);
    }
    end_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(differences_make_the_world_of_brief),
        cmocka_unit_test(differences_make_the_world_of_mixed),
        cmocka_unit_test(differences_make_the_world_of_terrain),
        cmocka_unit_test(differences_make_the_world_of_joints),
        cmocka_unit_test(differences_make_the_world_of_compounds),
        cmocka_unit_test(any_snapshot_is_a_base),
        cmocka_unit_test(what_did_not_change_costs_nothing),
        cmocka_unit_test(saving_a_difference_checks_its_base),
        cmocka_unit_test(a_difference_needs_its_own_base),
        cmocka_unit_test(an_altered_base_gives_the_saved_state_or_none),
        cmocka_unit_test(the_number_is_that_of_the_saved_world),
        cmocka_unit_test(what_was_replaced_costs_its_own_bytes),
        cmocka_unit_test(a_difference_that_is_cut_is_refused),
        cmocka_unit_test(each_byte_of_a_difference_counts),
        cmocka_unit_test(runs_that_lie_are_refused),
        cmocka_unit_test(a_size_that_cannot_be_is_refused),
        cmocka_unit_test(each_allocation_may_fail_and_nothing_changes),
        cmocka_unit_test(a_restore_that_fails_tells_the_memory_there_is),
    };
    return cmocka_run_group_tests(tests, open_store, close_store);
}
