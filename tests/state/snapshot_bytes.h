// snapshot_bytes.h - the bytes of a snapshot in tests: saved, and with right sums after a change.
#ifndef FE_TEST_SNAPSHOT_BYTES_H
#define FE_TEST_SNAPSHOT_BYTES_H
#include "core/bytes.h"
#include "fe_test.h"

#include <stdlib.h>
#include <string.h>

enum { HEADER = 48, SECTION = 24, AT_NUMBER = 20, AT_SIZE = 24, AT_SUM = 32, AT_SECTIONS = 40, ROWS = 8 };

typedef struct bytes {
    unsigned char *data;
    int64_t size;
} bytes;

static inline bytes save(const fe_world *world)
{
    bytes b = {NULL, fe_world_save(world, NULL, NULL, 0)};
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, NULL, b.data, b.size) == b.size);
    return b;
}

// With the contents of its assets. No data where one of them is gone: the last user of a destroyed one takes it along
static inline bytes save_with_assets(const fe_world *world)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_ASSETS;
    bytes b = {NULL, fe_world_save(world, &options, NULL, 0)};
    if (b.size < 0) return b;
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, &options, b.data, b.size) == b.size);
    return b;
}

// ---- right sums, by code of its own ---------------------------------------------------------------------------------
static inline uint64_t take(const unsigned char *at, int32_t size)
{
    uint64_t x = 0;
    for (int32_t k = size - 1; k >= 0; --k) x = x << 8 | at[k];
    return x;
}

static inline void put(unsigned char *at, uint64_t x)
{
    for (int32_t k = 0; k < 8; ++k) at[k] = (unsigned char)(x >> 8 * k);
}

static inline uint64_t sum_of(const unsigned char *at, uint64_t size)
{
    uint64_t lanes[8] = {0};
    for (uint64_t i = 0; i < size / 8; ++i) {
        lanes[i % 8] = (lanes[i % 8] ^ take(at + 8 * i, 8)) * UINT64_C(0x9E3779B97F4A7C15);
        lanes[i % 8] ^= lanes[i % 8] >> 32;
    }
    fe__hash sum = fe__hash_begin();
    for (int k = 0; k < 8; ++k) fe__hash_u64(&sum, lanes[k]);
    fe__hash_u64(&sum, size);
    return fe__hash_end(&sum);
}

static inline uint64_t join(uint64_t sum, uint64_t other) { return (sum ^ other) * UINT64_C(0x9E3779B97F4A7C15) + 1; }

static inline void mend(bytes b)
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

// ---- changes of bytes -----------------------------------------------------------------------------------------------
static inline void put_u32(unsigned char *at, uint32_t x)
{
    for (int32_t k = 0; k < 4; ++k) at[k] = (unsigned char)(x >> 8 * k);
}

// Where it begins, by its place among them
static inline int64_t section_at(bytes b, int32_t section)
{
    int64_t at = HEADER;
    for (; section > 0; --section) at += SECTION + (int64_t)take(b.data + at + 8, 8);
    return at;
}

static inline uint32_t draw(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

// Of a section a number of 1, 2, 4 or 8 bytes becomes another: any, one nearby, one of another place, a corner of its
// type
static inline void alter(bytes b, uint32_t *seed)
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

#endif
