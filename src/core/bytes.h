// bytes.h - numbers to bytes and back: little-endian, at any alignment, the same on every machine.
//
// What is read was counted before: who reads knows that so many bytes are there.
#ifndef FE_CORE_BYTES_H
#define FE_CORE_BYTES_H
#include "feather.h"

#include <stdint.h>
#include <string.h>

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

#endif
