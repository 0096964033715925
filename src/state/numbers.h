// numbers.h - numbers of one kind to bytes and back, and whether they are within their range: for the straight code
// that tables.c makes of its lists. All arguments but addresses are constants there.
#ifndef FE_STATE_NUMBERS_H
#define FE_STATE_NUMBERS_H
#include "core/bytes.h"
#include "core/id_pool.h"
#include "state/field.h"

#define FE__STRAIGHT static inline __attribute__((always_inline))

FE__STRAIGHT void fe__swap_numbers(unsigned char *out, const unsigned char *in, size_t size, fe__field_kind kind)
{
    const size_t width = fe__kind_size((int32_t)kind);
    for (size_t at = 0; at < size; at += width)
        for (size_t k = 0; k < width; ++k) out[at + k] = in[at + width - 1 - k];
}

FE__STRAIGHT unsigned char *fe__put_numbers(unsigned char *out, const void *in, size_t size, fe__field_kind kind)
{
    const fe_handle world = (fe_handle)FE_ID_LAST_NUMBER << FE_ID_NUMBER_SHIFT;
    if (kind == FE__NAME) {
        for (size_t at = 0; at < size; at += sizeof world) {
            fe_handle handle;
            memcpy(&handle, (const unsigned char *)in + at, sizeof handle);
            fe__put_u64(out + at, handle & ~world);
        }
    } else if (FE_IS_LITTLE_ENDIAN)
        memcpy(out, in, size);
    else
        fe__swap_numbers(out, in, size, kind);
    return out + size;
}

FE__STRAIGHT const unsigned char *fe__take_numbers(const unsigned char *in, void *out, size_t size, fe__field_kind kind,
                                                   fe_handle number)
{
    if (kind == FE__NAME) {
        for (size_t at = 0; at < size; at += sizeof number) {
            const unsigned char *from = in + at;
            fe_handle handle = fe__take_u64(&from);
            if (handle) handle |= number;
            memcpy((unsigned char *)out + at, &handle, sizeof handle);
        }
    } else if (FE_IS_LITTLE_ENDIAN)
        memcpy(out, in, size);
    else
        fe__swap_numbers(out, in, size, kind);
    return in + size;
}

// ---- ranges: the highest bit of what is returned tells a doubt ------------------------------------------------------
enum { FE__EXPONENT = 0x7f800000, FE__EXPONENT_STEP = 0x00800000, FE__MAGNITUDE = 0x7fffffff };

// A whole number from 0 to `high`
FE__STRAIGHT uint32_t fe__doubt_whole(uint32_t bits, float high)
{
    const fe__float_word x = {.bits = bits};
    float held = x.value >= 0.0f && x.value <= high ? x.value : 0.5f;
    return (uint32_t)((float)(int32_t)held != held) << 31;
}

FE__STRAIGHT uint32_t fe__doubt_float(uint32_t bits, fe__range_number range)
{
    const fe__float_word high = {.value = (float)fe__ranges[range].high};
    switch (range) {
    case FE__RANGE_FINITE:
        return (bits & FE__EXPONENT) + FE__EXPONENT_STEP;
    case FE__RANGE_UNIT:
    case FE__RANGE_SPEED:
    case FE__RANGE_PLACE:
        return high.bits - (bits & FE__MAGNITUDE);
    case FE__RANGE_LOCKS:
    case FE__RANGE_COUNT:
        return fe__doubt_whole(bits, high.value);
    default: // from 0 on: of positive floats the bits rise with the value
        return bits | (high.bits - bits);
    }
}

FE__STRAIGHT uint32_t fe__doubt_int(int32_t x, fe__range_number range)
{
    return ((uint32_t)x - (uint32_t)(int32_t)fe__ranges[range].low) |
           ((uint32_t)(int32_t)fe__ranges[range].high - (uint32_t)x);
}

FE__STRAIGHT uint32_t fe__doubt_number(const unsigned char *in, fe__field_kind kind, fe__range_number range)
{
    switch (kind) {
    case FE__U8:
        return fe__doubt_int(fe__take_u8(&in), range);
    case FE__U16:
        return fe__doubt_int(fe__take_u16(&in), range);
    case FE__I16:
        return fe__doubt_int((int16_t)fe__take_u16(&in), range);
    case FE__I32:
        return fe__doubt_int(fe__take_i32(&in), range);
    case FE__F32:
        return fe__doubt_float(fe__take_u32(&in), range);
    case FE__F64:
        return (uint32_t)(((fe__take_u64(&in) >> 32) & 0x7ff00000u) + 0x00100000u);
    default:
        return 1u << 31;
    }
}

FE__STRAIGHT uint32_t fe__doubt_numbers(const unsigned char *in, size_t size, fe__field_kind kind,
                                        fe__range_number range)
{
    uint32_t doubts = 0;
    if (range == FE__RANGE_ANY || range == FE__RANGE_GROWING) return 0;
    for (size_t at = 0; at < size; at += fe__kind_size((int32_t)kind)) doubts |= fe__doubt_number(in + at, kind, range);
    return doubts;
}

#endif
