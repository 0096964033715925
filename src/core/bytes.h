// bytes.h - numbers to bytes and back: little-endian, at any alignment, the same on every machine.
//
// What is read was counted before: who reads knows that so many bytes are there.
#ifndef FE_CORE_BYTES_H
#define FE_CORE_BYTES_H
#include "feather.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

// ---- bytes ----------------------------------------------------------------------------------------------------------

typedef union fe__float_word {
    float value;
    uint32_t bits;
} fe__float_word;

// Numbers lie in memory as they are written: copies of many at once
#define FE_IS_LITTLE_ENDIAN (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)

// ---- writing -------------------------------------------------------------------------------------------------------
static inline unsigned char *fe__put_u8(unsigned char *at, uint8_t x)
{
    *at = x;
    return at + 1;
}
static inline unsigned char *fe__put_u16(unsigned char *at, uint16_t x)
{
    at[0] = (unsigned char)x, at[1] = (unsigned char)(x >> 8);
    return at + 2;
}
static inline unsigned char *fe__put_u32(unsigned char *at, uint32_t x)
{
    at[0] = (unsigned char)x, at[1] = (unsigned char)(x >> 8);
    at[2] = (unsigned char)(x >> 16), at[3] = (unsigned char)(x >> 24);
    return at + 4;
}
static inline unsigned char *fe__put_u64(unsigned char *at, uint64_t x)
{
    return fe__put_u32(fe__put_u32(at, (uint32_t)x), (uint32_t)(x >> 32));
}
static inline unsigned char *fe__put_i32(unsigned char *at, int32_t x) { return fe__put_u32(at, (uint32_t)x); }
static inline unsigned char *fe__put_float(unsigned char *at, float x)
{
    return fe__put_u32(at, (fe__float_word){.value = x}.bits);
}
static inline unsigned char *fe__put_vec3(unsigned char *at, fe_vec3 v)
{
    return fe__put_float(fe__put_float(fe__put_float(at, v.x), v.y), v.z);
}
static inline unsigned char *fe__put_bytes(unsigned char *at, const uint8_t *bytes, int64_t count)
{
    if (count) memcpy(at, bytes, (size_t)count);
    return at + count;
}

// ---- reading: moves *at on ---------------------------------------------------------------------------------------
static inline uint8_t fe__take_u8(const unsigned char **at) { return *(*at)++; }
static inline uint16_t fe__take_u16(const unsigned char **at)
{
    const unsigned char *b = *at;
    *at += 2;
    return (uint16_t)(b[0] | b[1] << 8);
}
static inline uint32_t fe__take_u32(const unsigned char **at)
{
    const unsigned char *b = *at;
    *at += 4;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}
static inline uint64_t fe__take_u64(const unsigned char **at)
{
    uint64_t low = fe__take_u32(at);
    return low | (uint64_t)fe__take_u32(at) << 32;
}
static inline int32_t fe__take_i32(const unsigned char **at) { return (int32_t)fe__take_u32(at); }
// Bit by bit, a NaN too: it is checked before it is computed with
static inline float fe__take_float(const unsigned char **at)
{
    return (fe__float_word){.bits = fe__take_u32(at)}.value;
}
static inline fe_vec3 fe__take_vec3(const unsigned char **at)
{
    fe_vec3 v;
    v.x = fe__take_float(at), v.y = fe__take_float(at), v.z = fe__take_float(at);
    return v;
}
static inline void fe__take_bytes(const unsigned char **at, uint8_t *out, int64_t count)
{
    if (count) memcpy(out, *at, (size_t)count);
    *at += count;
}

// ---- ranges ---------------------------------------------------------------------------------------------------------
// The largest and least numbers that the library takes, from callers and from bytes.
//
// Squares and products of them stay far inside a float, so that no argument can make an infinity.

#define FE_MAX_POSITION 1e9     // m, each coordinate: a double resolves 0.1 um there
#define FE_MAX_TRANSLATION 1e10 // m, of a query
#define FE_MAX_TURN 64.0f       // rad, of a query: ten turns. What a sweep costs grows with them
#define FE_MAX_LOCAL 1e6f       // m, in a body's frame
#define FE_MAX_SPEED 1e6f       // m/s, rad/s, m/s2
#define FE_MOST_SPEED 1e7f      // m/s, rad/s: a body that a step leaves faster has overflowed
#define FE_MAX_FORCE 1e15f      // N, N m, N s, N m s
#define FE_MAX_VALUE 1e6f       // dampings, hertz, ratios, frictions...
#define FE_LEAST_VALUE 1e-6f    // of what must be above 0
#define FE_MAX_DENSITY 1e7f     // kg/m3
#define FE_LEAST_MASS 1e-9f     // kg
#define FE_MAX_MASS 1e18f
#define FE_LEAST_INERTIA 1e-18f // kg m2
#define FE_MAX_INERTIA 1e30f
#define FE_LEAST_LENGTH 1e-3f // m, of a form
#define FE_MAX_LENGTH 1e5f
#define FE_LEAST_SCALE 1e-3f // of an asset, its magnitude along an axis
#define FE_MAX_SCALE 1e3f
#define FE_MAX_DT 1.0f // s
// s. A float's last digit of a speed of 16 m/s, over so short a time, is 0.1 m/s2, a hundredth of gravity: what
// impulses over shorter times would tell of forces is rounding
#define FE_LEAST_DT 1e-5f

// ---- hash -----------------------------------------------------------------------------------------------------------
// A 64-bit fingerprint of a sequence of numbers, for fe_world_hash and for comparing two runs.
//
// It works on values, not on memory: the same words give the same hash on any machine. Floats enter as their bits, so
// that -0.0 and +0.0 differ: two runs that differ in a sign of zero are not the same run. Not for secrets, and not for
// hash tables in need of a cheap step.
//
// Each word w turns the state s into   s = (s ^ w) K,  s ^= s >> 32.   Both steps are one to one in s and in w, so that
// two sequences of the same length that differ in one word never collide; others do with probability 2^-64. K is odd
// with well spread bits: 2^64 / golden ratio.

#define FE_HASH_FACTOR UINT64_C(0x9E3779B97F4A7C15)

typedef struct fe__hash {
    uint64_t state;
    uint64_t word_count;
} fe__hash;

static inline fe__hash fe__hash_begin(void) { return (fe__hash){0, 0}; }
static inline void fe__hash_u64(fe__hash *hash, uint64_t word)
{
    uint64_t state = (hash->state ^ word) * FE_HASH_FACTOR;
    hash->state = state ^ state >> 32;
    hash->word_count += 1;
}
static inline void fe__hash_u32(fe__hash *hash, uint32_t word) { fe__hash_u64(hash, word); }
static inline void fe__hash_i32(fe__hash *hash, int32_t word) { fe__hash_u64(hash, (uint32_t)word); }
static inline uint32_t fe__float_bits(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline uint64_t fe__double_bits(double a)
{
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline void fe__hash_float(fe__hash *hash, float a) { fe__hash_u64(hash, fe__float_bits(a)); }
static inline void fe__hash_double(fe__hash *hash, double a) { fe__hash_u64(hash, fe__double_bits(a)); }
// two floats a word: half the multiplications
static inline void fe__hash_floats2(fe__hash *hash, float a, float b)
{
    fe__hash_u64(hash, fe__float_bits(a) | (uint64_t)fe__float_bits(b) << 32);
}
static inline void fe__hash_vec3(fe__hash *hash, fe_vec3 a)
{
    fe__hash_floats2(hash, a.x, a.y);
    fe__hash_float(hash, a.z);
}
static inline void fe__hash_dvec3(fe__hash *hash, fe_dvec3 a)
{
    fe__hash_double(hash, a.x);
    fe__hash_double(hash, a.y);
    fe__hash_double(hash, a.z);
}
// Arrays of words: the same as feeding pairs (low word first) or single words; an odd last 32-bit word goes alone. The
// length goes in first.
void fe__hash_u32_array(fe__hash *hash, const uint32_t *words, size_t count);
void fe__hash_u64_array(fe__hash *hash, const uint64_t *words, size_t count);
// A struct of `size` bytes whose fields are 32-bit words, as pairs like an array: the same whatever the order of a
// word's bytes. `size` goes in first.
void fe__hash_struct(fe__hash *hash, const void *words, size_t size);
// The fingerprint of all that was fed; more may be fed afterwards.
uint64_t fe__hash_end(const fe__hash *hash);

#endif
