// test_hostile.c - bytes that nobody saved: cut, flipped, random numbers under right sums. They are refused, and
// nothing changed; or the world lives: it steps, it is saved, and what is read of it is a number.
#include "fe_test.h"
#include "support/play.h"

#include <stdlib.h>
#include <string.h>

enum { HEADER = 48, SECTION = 24, AT_NUMBER = 20, AT_SIZE = 24, AT_SUM = 32, AT_SECTIONS = 40, NUMBER = 7 };

typedef struct bytes {
    unsigned char *data;
    int64_t size;
} bytes;

static bytes save(const fe_world *world)
{
    bytes b = {NULL, fe_world_save(world, NULL, NULL, 0)};
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, NULL, b.data, b.size) == b.size);
    return b;
}

// With the contents of its assets, where it may be: the last user of a destroyed one takes it along
static bytes save_whole(const fe_world *world)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_ASSETS;
    bytes b = {NULL, fe_world_save(world, &options, NULL, 0)};
    if (b.size < 0) return save(world);
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, &options, b.data, b.size) == b.size);
    return b;
}

static fe_world *new_world(void)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.number = NUMBER;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

// ---- right sums, by code of its own ---------------------------------------------------------------------------------
static uint64_t take(const unsigned char *at, int32_t size)
{
    uint64_t x = 0;
    for (int32_t k = size - 1; k >= 0; --k) x = x << 8 | at[k];
    return x;
}

static void put(unsigned char *at, uint64_t x)
{
    for (int32_t k = 0; k < 8; ++k) at[k] = (unsigned char)(x >> 8 * k);
}

static uint64_t sum_of(const unsigned char *at, uint64_t size)
{
    fe__hash lanes[4], sum = fe__hash_begin();
    for (int k = 0; k < 4; ++k) lanes[k] = fe__hash_begin();
    for (uint64_t i = 0; i < size / 8; ++i) fe__hash_u64(lanes + i % 4, take(at + 8 * i, 8));
    for (int k = 0; k < 4; ++k) fe__hash_u64(&sum, fe__hash_end(lanes + k));
    return fe__hash_end(&sum);
}

static uint64_t join(uint64_t sum, uint64_t other) { return (sum ^ other) * UINT64_C(0x9E3779B97F4A7C15) + 1; }

static void mend(bytes b)
{
    uint64_t sum = 0;
    for (int64_t at = HEADER; at + SECTION <= b.size;) {
        uint64_t size = take(b.data + at + 8, 8);
        if (size > (uint64_t)(b.size - at - SECTION)) return;
        put(b.data + at + 16, sum_of(b.data + at + SECTION, size));
        sum = join(sum, take(b.data + at + 16, 8));
        at += SECTION + (int64_t)size;
    }
    fe__hash hash = fe__hash_begin();
    fe__hash_u64(&hash, take(b.data, 8));
    fe__hash_u64(&hash, take(b.data + 8, 8));
    fe__hash_u64(&hash, take(b.data + 16, 4));
    fe__hash_u64(&hash, take(b.data + 24, 8));
    fe__hash_u64(&hash, take(b.data + AT_SECTIONS, 8));
    put(b.data + AT_SUM, join(sum, fe__hash_end(&hash)));
}

// ---- the scene: each form, joints, trees, sleep, events, what is free and what is ignored ---------------------------
static fe_world *make_scene(const script *s, int32_t steps)
{
    static play p;
    fe_world *world = new_world();
    play_begin(&p, world);
    play_until(&p, s, steps);
    return world;
}

static void read_all(const fe_world *world)
{
    uint32_t words[2];
    fe_contact contacts[64];
    fe_pair_event pairs[64];
    fe_body bodies[64];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    (void)fe_world_get_pair_events(world, pairs, sizeof *pairs, 64);
    int32_t count = fe_world_get_bodies(world, bodies, 64);
    for (int32_t i = 0; i < (count < 64 ? count : 64); ++i) {
        fe_transform transform;
        FE_TRUE(fe_body_get_transform(world, bodies[i], &transform) == FE_OK);
        (void)fe_body_get_contacts(world, bodies[i], contacts, sizeof *contacts, 64);
    }
}

// It is destroyed at last, body by body
static void live(fe_world *world)
{
    enum { STEPS = 10 };
    for (int32_t i = 0; i < STEPS; ++i) {
        FE_TRUE(fe_world_step(world, i == 4 ? 0.0f : 1.0f / 60.0f) == FE_OK);
        read_all(world);
    }
    bytes again = save(world);
    FE_TRUE(fe_snapshot_check(again.data, again.size, NULL) == FE_OK || fe_last_error() != NULL);
    free(again.data);
    fe_body bodies[256];
    for (int32_t count = fe_world_get_bodies(world, bodies, 256); count > 0;
         count = fe_world_get_bodies(world, bodies, 256))
        for (int32_t i = 0; i < (count < 256 ? count : 256); ++i)
            if (fe_body_is_valid(world, bodies[i])) FE_TRUE(fe_body_destroy(world, bodies[i]) == FE_OK);
    FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
}

// ---- laws -----------------------------------------------------------------------------------------------------------
static void bytes_that_are_cut_are_refused_and_change_nothing(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_brief, 40);
    bytes whole = save(world);
    for (int64_t size = 0; size < whole.size; ++size) {
        unsigned char *cut = malloc((size_t)size + 1); // so that a sanitizer sees a byte too far
        memcpy(cut, whole.data, (size_t)size);
        fe_result result = fe_world_restore(world, NULL, cut, size);
        free(cut);
        if (result != FE_ERROR_DATA) fail_msg("cut at %lld: %d", (long long)size, (int)result);
    }
    bytes after = save(world);
    FE_TRUE(after.size == whole.size && memcmp(after.data, whole.data, (size_t)whole.size) == 0);
    free(whole.data);
    free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static fe_result restore_with_bit(fe_world *world, bytes b, int64_t byte, int32_t bit)
{
    b.data[byte] ^= (unsigned char)(1 << bit);
    fe_result result = fe_world_restore(world, NULL, b.data, b.size);
    b.data[byte] ^= (unsigned char)(1 << bit);
    return result;
}

// The number of the world is in no sum: worlds differ in it alone.
static void each_bit_of_the_headers_counts(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_brief, 40);
    bytes b = save(world);
    for (int32_t i = 0; i < 8 * HEADER; ++i) {
        if (i / 8 >= AT_NUMBER && i / 8 < AT_NUMBER + 4) continue;
        if (restore_with_bit(world, b, i / 8, i % 8) >= 0) fail_msg("bit %d of the header tells nothing", (int)i);
    }
    for (int64_t at = HEADER; at < b.size; at += SECTION + (int64_t)take(b.data + at + 8, 8))
        for (int32_t i = 0; i < 8 * SECTION; ++i)
            if (restore_with_bit(world, b, at + i / 8, i % 8) >= 0)
                fail_msg("bit %d of the section at %lld tells nothing", (int)i, (long long)at);
    free(b.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// A later minor version may write sections that this one does not know, behind those that it does
static fe_result restore_with_unknown_section(fe_world *world, bytes b, uint32_t flags)
{
    enum { UNKNOWN = 4999, CONTENT = 16, MAY_SKIP_SHIFT = 16 };
    bytes more = {calloc(1, (size_t)b.size + SECTION + CONTENT), b.size + SECTION + CONTENT};
    memcpy(more.data, b.data, (size_t)b.size);
    unsigned char *section = more.data + b.size;
    put(section, (uint64_t)UNKNOWN | (uint64_t)(1 | flags << MAY_SKIP_SHIFT) << 32);
    put(section + 8, CONTENT);
    put(section + SECTION, UINT64_C(0x123456789abcdef0));
    put(more.data + AT_SIZE, (uint64_t)more.size);
    put(more.data + AT_SECTIONS, take(b.data + AT_SECTIONS, 8) + 1);
    mend(more);
    fe_result result = fe_world_restore(world, NULL, more.data, more.size);
    free(more.data);
    return result;
}

static void only_what_says_so_is_skipped(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_brief, 40);
    bytes before = save(world);
    assert_int_equal(restore_with_unknown_section(world, before, 0), FE_ERROR_DATA);
    FE_TRUE(strstr(fe_last_error(), "section 4999 is unknown") != NULL);
    assert_int_equal(restore_with_unknown_section(world, before, 1), FE_OK);
    bytes after = save(world);
    FE_TRUE(after.size == before.size && memcmp(after.data, before.data, (size_t)after.size) == 0);
    free(before.data);
    free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static uint32_t draw(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

// Of a section a number of 1, 2, 4 or 8 bytes becomes another: any, one nearby, one of another place, a corner of its
// type
static void alter(bytes b, uint32_t *seed)
{
    static const uint64_t corners[] = {0,          1,          UINT64_MAX, 0x7fffffff, 0x80000000,
                                       0x7f800000, 0x7fc00000, 0xff800000, 0x7f7fffff, 0x00000001};
    int64_t sections = 0, at = HEADER, skip;
    while (at < b.size) ++sections, at += SECTION + (int64_t)take(b.data + at + 8, 8);
    for (at = HEADER, skip = draw(seed) % sections; skip > 0; --skip) at += SECTION + (int64_t)take(b.data + at + 8, 8);
    int64_t size = (int64_t)take(b.data + at + 8, 8), width = 4;
    if (size <= 8) return;
    int64_t place = draw(seed) % 16 == 0 ? 0 : 8 + draw(seed) % ((size - 8) / 4) * 4;
    if (place + width > size) return;
    unsigned char *to = b.data + at + SECTION + place;
    uint64_t x = take(to, 4);
    switch (draw(seed) % 5) {
    case 0:
        x = draw(seed) ^ draw(seed) << 16;
        break;
    case 1:
        x += draw(seed) % 5 - 2;
        break;
    case 2:
        x = take(b.data + at + SECTION + 8 + draw(seed) % ((size - 8) / 4) * 4, 4);
        break;
    case 3:
        x ^= UINT64_C(1) << draw(seed) % 32;
        break;
    default:
        x = corners[draw(seed) % (sizeof corners / sizeof *corners)];
    }
    for (int k = 0; k < 4; ++k) to[k] = (unsigned char)(x >> 8 * k);
}

static void random_numbers_are_refused_or_live_in(const script *s, int32_t steps, int32_t rounds)
{
    fe_world *world = make_scene(s, steps);
    bytes whole = save(world), back = save_whole(world), b = {malloc((size_t)whole.size), whole.size};
    int32_t accepted = 0;
    uint32_t seed = 12345u + (uint32_t)steps;
    const char *tells = getenv("FE_STATE_TELL");
    for (int32_t i = 0; i < rounds; ++i) {
        memcpy(b.data, whole.data, (size_t)whole.size);
        for (uint32_t changes = 1 + draw(&seed) % 3; changes > 0; --changes) alter(b, &seed);
        mend(b);
        if (tells) printf("%s %d\n", s->name, (int)i), fflush(stdout);
        fe_result result = fe_world_restore(world, NULL, b.data, b.size);
        if (result >= 0) ++accepted, live(world);
        if (fe_world_restore(world, NULL, back.data, back.size) != FE_OK) fail_msg("%s", fe_last_error());
    }
    free(back.data);
    FE_TRUE(accepted > 0 && accepted < rounds);
    free(b.data);
    free(whole.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static int32_t rounds(void)
{
    const char *long_run = getenv("FE_STATE_ROUNDS");
    return long_run ? atoi(long_run) : 150;
}

#define CASE(name, steps)                                                       \
    static void name##_under_random_numbers(void **state)                       \
    {                                                                           \
        (void)state;                                                            \
        random_numbers_are_refused_or_live_in(&script_##name, steps, rounds()); \
    }
CASE(brief, 60)
CASE(crowd, 45)
CASE(terrain, 60)
CASE(joints, 40)
CASE(solids, 60)
CASE(meshes, 60)
CASE(scales, 90)
CASE(compounds, 67)
CASE(fast, 30)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_that_are_cut_are_refused_and_change_nothing),
        cmocka_unit_test(each_bit_of_the_headers_counts),
        cmocka_unit_test(only_what_says_so_is_skipped),
        cmocka_unit_test(brief_under_random_numbers),
        cmocka_unit_test(crowd_under_random_numbers),
        cmocka_unit_test(terrain_under_random_numbers),
        cmocka_unit_test(joints_under_random_numbers),
        cmocka_unit_test(solids_under_random_numbers),
        cmocka_unit_test(meshes_under_random_numbers),
        cmocka_unit_test(scales_under_random_numbers),
        cmocka_unit_test(compounds_under_random_numbers),
        cmocka_unit_test(fast_under_random_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
