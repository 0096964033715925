// op_write.h - arguments as bytes: numbers word by word, so that a struct is the same on every machine.
#ifndef FE_RECORDING_OP_WRITE_H
#define FE_RECORDING_OP_WRITE_H
#include "core/bytes.h"

// So many words of so many bytes; 0, 0 ends
typedef struct fe__words {
    uint8_t bytes, count;
} fe__words;

enum { FE__OP_STRUCT = 5 }; // bytes that a struct takes beside itself, at most

static const fe__words fe__handle_words[] = {{8, 1}, {0, 0}};
static const fe__words fe__six_floats[] = {{4, 6}, {0, 0}};
static const fe__words fe__one_float[] = {{4, 1}, {0, 0}};

// Words of a struct, as many as there are in `size` bytes, to little-endian ones or back
static inline void fe__move_words(unsigned char *to, const unsigned char *from, int64_t size, const fe__words *words)
{
    if (FE_IS_LITTLE_ENDIAN) {
        if (size) memcpy(to, from, (size_t)size);
        return;
    }
    for (int64_t at = 0; words->bytes; ++words)
        for (int32_t i = 0; i < words->count; ++i, at += words->bytes) {
            if (at + words->bytes > size) return;
            for (int32_t k = 0; k < words->bytes; ++k) to[at + k] = from[at + words->bytes - 1 - k];
        }
}

static inline unsigned char *fe__put_plain(unsigned char *at, const void *given, size_t size, const fe__words *words)
{
    at = fe__put_u8(at, given != NULL);
    if (!given) return at;
    fe__move_words(at, given, (int64_t)size, words);
    return at + size;
}

static inline uint32_t fe__given_size(const void *given, size_t size)
{
    uint32_t own;
    memcpy(&own, given, sizeof own);
    return own < size ? own : (uint32_t)size;
}

// With a struct_size: as much of it as both sides know
static inline unsigned char *fe__put_sized_record(unsigned char *at, const void *given, size_t size,
                                                  const fe__words *words)
{
    uint32_t own = fe__given_size(given, size);
    fe__move_words(at, given, own, words);
    fe__put_u32(at, own);
    return at + own;
}
static inline unsigned char *fe__put_sized(unsigned char *at, const void *given, size_t size, const fe__words *words)
{
    at = fe__put_u8(at, given != NULL);
    return given ? fe__put_sized_record(at, given, size, words) : at;
}

// Records of a caller, `stride` bytes apart, 0: packed
static inline unsigned char *fe__put_array(unsigned char *at, const void *given, uint32_t stride, int32_t count,
                                           size_t size, const fe__words *words)
{
    const unsigned char *from = given;
    for (int32_t i = 0; i < count; ++i, at += size, from += stride ? stride : size)
        fe__move_words(at, from, (int64_t)size, words);
    return at;
}
static inline unsigned char *fe__put_sized_array(unsigned char *at, const void *given, uint32_t stride, int32_t count,
                                                 size_t size, const fe__words *words)
{
    const unsigned char *from = given;
    for (int32_t i = 0; i < count; ++i, from += stride) at = fe__put_sized_record(at, from, size, words);
    return at;
}

// Small numbers are short: seven bits a byte, the lowest first
static inline unsigned char *fe__put_varint(unsigned char *at, uint64_t x)
{
    for (; x > 0x7f; x >>= 7) *at++ = (unsigned char)(x | 0x80);
    *at++ = (unsigned char)x;
    return at;
}
static inline unsigned char *fe__put_signed(unsigned char *at, int64_t x)
{
    return fe__put_varint(at, (uint64_t)x << 1 ^ (uint64_t)(x >> 63));
}
enum { FE__VARINT = 10 }; // bytes at most

#endif
