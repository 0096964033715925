// png.c - picture_png: a PNG of few colours (palette.c), deflated with the fixed codes of RFC 1951. Rows have no
// filter: what they have in common with the row above is a match like any other.
#include "palette.h"
#include "picture.h"

#include <stdlib.h>
#include <string.h>

enum { WINDOW = 32768, LEAST_MATCH = 3, MOST_MATCH = 258, CHAIN = 48, HASH_BITS = 15 };

typedef struct bytes {
    uint8_t *data;
    size_t count, room;
    uint32_t bits; // not yet a byte
    int32_t bit_count;
} bytes;

static void put(bytes *b, uint32_t byte)
{
    if (b->count < b->room) b->data[b->count] = (uint8_t)byte;
    ++b->count;
}

static void put_number(bytes *b, uint32_t number)
{
    for (int shift = 24; shift >= 0; shift -= 8) put(b, number >> shift & 255);
}

// Least bit first
static void put_bits(bytes *b, uint32_t value, int32_t count)
{
    b->bits |= value << b->bit_count, b->bit_count += count;
    for (; b->bit_count >= 8; b->bit_count -= 8, b->bits >>= 8) put(b, b->bits & 255);
}

// ---- deflate -------------------------------------------------------------------------------------------------------
static void put_code(bytes *b, uint32_t code, int32_t count) // codes come with their greatest bit first
{
    uint32_t turned = 0;
    for (int32_t i = 0; i < count; ++i) turned |= (code >> i & 1) << (count - 1 - i);
    put_bits(b, turned, count);
}

static void put_symbol(bytes *b, uint32_t symbol)
{
    if (symbol < 144)
        put_code(b, 0x30 + symbol, 8);
    else if (symbol < 256)
        put_code(b, 0x190 + symbol - 144, 9);
    else if (symbol < 280)
        put_code(b, symbol - 256, 7);
    else
        put_code(b, 0xc0 + symbol - 280, 8);
}

// Symbols for ranges that double after every `each`: what is left of value goes into extra bits
static uint32_t range_of(uint32_t value, uint32_t each, int32_t *extra, uint32_t *rest)
{
    uint32_t symbol = 0, base = 0, width = 1, in_width = 2 * each;
    for (*extra = 0; value - base >= in_width * width;) {
        base += in_width * width, symbol += in_width;
        in_width = each, width *= 2, ++*extra;
    }
    *rest = (value - base) % width;
    return symbol + (value - base) / width;
}

static void put_match(bytes *b, uint32_t length, uint32_t distance)
{
    int32_t extra;
    uint32_t rest;
    uint32_t symbol = range_of(length - LEAST_MATCH, 4, &extra, &rest);
    if (length == MOST_MATCH) symbol = 28, extra = 0, rest = 0;
    put_symbol(b, 257 + symbol);
    put_bits(b, rest, extra);
    symbol = range_of(distance - 1, 2, &extra, &rest);
    put_code(b, symbol, 5);
    put_bits(b, rest, extra);
}

typedef struct matcher {
    const uint8_t *data;
    int32_t count;
    int32_t heads[1 << HASH_BITS], *before; // the last place of each hash, the place before each place; -1: none
} matcher;

static int32_t *head_at(matcher *m, int32_t at)
{
    const uint8_t *p = m->data + at;
    uint32_t key = (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
    return m->heads + (key * UINT32_C(0x9e3779b1) >> (32 - HASH_BITS));
}

static void remember(matcher *m, int32_t at)
{
    if (at + LEAST_MATCH > m->count) return;
    int32_t *head = head_at(m, at);
    m->before[at] = *head, *head = at;
}

// @return its length, 0: none
static int32_t longest_match(matcher *m, int32_t at, int32_t *out_distance)
{
    int32_t best = LEAST_MATCH - 1, most = m->count - at < MOST_MATCH ? m->count - at : MOST_MATCH;
    if (most < LEAST_MATCH) return 0;
    int32_t from = *head_at(m, at);
    for (int32_t i = 0; i < CHAIN && from >= 0 && at - from <= WINDOW && best < most; ++i, from = m->before[from]) {
        const uint8_t *a = m->data + from, *b = m->data + at;
        if (a[best] != b[best]) continue;
        int32_t same = 0;
        while (same < most && a[same] == b[same]) ++same;
        if (same > best) best = same, *out_distance = at - from;
    }
    return best < LEAST_MATCH ? 0 : best;
}

// A match waits for one place: the next may have a longer one
static void deflate(bytes *b, matcher *m)
{
    put_bits(b, 1, 1), put_bits(b, 1, 2); // the last block, fixed codes
    for (int32_t at = 0; at < m->count;) {
        int32_t distance = 0, next_distance = 0, length = longest_match(m, at, &distance);
        remember(m, at);
        if (length && length < 32 && at + 1 < m->count && longest_match(m, at + 1, &next_distance) > length) length = 0;
        if (!length) {
            put_symbol(b, m->data[at++]);
            continue;
        }
        put_match(b, (uint32_t)length, (uint32_t)distance);
        for (int32_t i = 1; i < length; ++i) remember(m, at + i);
        at += length;
    }
    put_symbol(b, 256);
    put_bits(b, 0, 7); // the last byte's rest
}

// ---- the file ------------------------------------------------------------------------------------------------------
static uint32_t adler(const uint8_t *data, int32_t count)
{
    uint32_t a = 1, b = 0;
    for (int32_t i = 0; i < count; ++i) a = (a + data[i]) % 65521, b = (b + a) % 65521;
    return b << 16 | a;
}

static uint32_t crc(const uint8_t *data, size_t count)
{
    uint32_t table[256], sum = 0xffffffff;
    for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int k = 0; k < 8; ++k) table[i] = table[i] & 1 ? 0xedb88320 ^ table[i] >> 1 : table[i] >> 1;
    }
    for (size_t i = 0; i < count; ++i) sum = table[(sum ^ data[i]) & 255] ^ sum >> 8;
    return ~sum;
}

static size_t begin_chunk(bytes *b, const char *name)
{
    size_t start = b->count;
    put_number(b, 0);
    for (int i = 0; i < 4; ++i) put(b, (uint8_t)name[i]);
    return start;
}

// Length before the name, sum over name and data
static void end_chunk(bytes *b, size_t start)
{
    size_t end = b->count;
    if (end + 4 > b->room) return;
    b->count = start;
    put_number(b, (uint32_t)(end - start - 8));
    b->count = end;
    put_number(b, crc(b->data + start + 4, end - start - 4));
}

static void write_file(bytes *b, const palette *colours, int32_t width, int32_t height, matcher *m)
{
    static const uint8_t sign[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    for (int i = 0; i < 8; ++i) put(b, sign[i]);
    size_t start = begin_chunk(b, "IHDR");
    put_number(b, (uint32_t)width), put_number(b, (uint32_t)height);
    put(b, 8), put(b, 3), put(b, 0), put(b, 0), put(b, 0); // 8 bits, a palette
    end_chunk(b, start);
    start = begin_chunk(b, "PLTE");
    for (int32_t i = 0; i < 3 * colours->count; ++i) put(b, colours->rgb[i]);
    end_chunk(b, start);
    start = begin_chunk(b, "IDAT");
    put(b, 0x78), put(b, 0xda);
    deflate(b, m);
    put_number(b, adler(m->data, m->count));
    end_chunk(b, start);
    end_chunk(b, begin_chunk(b, "IEND"));
}

uint8_t *picture_png(const uint8_t *rgb, int32_t width, int32_t height, size_t *out_size)
{
    const int32_t pixels = width * height, count = pixels + height;
    // a byte takes 9 bits at most
    bytes b = {.room = (size_t)count + (size_t)count / 8 + 2048};
    uint8_t *indices = malloc((size_t)pixels), *rows = malloc((size_t)count);
    matcher *m = malloc(sizeof *m);
    palette colours;
    b.data = malloc(b.room);
    int done = b.data && indices && rows && m && palette_make(rgb, pixels, &colours, indices);
    if (done) {
        *m = (matcher){.data = rows, .count = count, .before = malloc((size_t)count * sizeof *m->before)};
        memset(m->heads, 0xff, sizeof m->heads);
        for (int32_t y = 0; y < height; ++y) {
            rows[(int64_t)y * (width + 1)] = 0; // no filter
            memcpy(rows + (int64_t)y * (width + 1) + 1, indices + (int64_t)y * width, (size_t)width);
        }
        done = m->before != NULL;
        if (done) write_file(&b, &colours, width, height, m);
        free(m->before);
    }
    free(indices), free(rows), free(m);
    if (!done) free(b.data), b.data = NULL;
    *out_size = b.count;
    return b.data;
}

uint8_t *picture_take(const fe_world *world, const picture_view *view, int32_t width, int32_t height, size_t *out_size)
{
    uint8_t *rgb = NULL, *png = NULL;
    if (width <= PICTURE_MOST && height <= PICTURE_MOST && width > 0 && height > 0)
        rgb = malloc(3 * (size_t)width * (size_t)height);
    if (rgb && picture_render(world, view, width, height, rgb) == FE_OK)
        png = picture_png(rgb, width, height, out_size);
    free(rgb);
    return png;
}
