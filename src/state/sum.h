// sum.h - the checksum of a section: against accidents, at nearly the speed of memory.
#ifndef FE_STATE_SUM_H
#define FE_STATE_SUM_H
#include <stdint.h>

enum { FE__SUM_LANES = 8, FE__SUM_LINE = 64 }; // words side by side; bytes of them

// Of bytes that come piece by piece
typedef struct fe__sum {
    uint64_t lanes[FE__SUM_LANES];
    int64_t size; // bytes so far
} fe__sum;

void fe__sum_lines(fe__sum *sum, const unsigned char *bytes, int64_t size);   // a multiple of a line
uint64_t fe__sum_end(fe__sum *sum, const unsigned char *bytes, int64_t size); // the last ones, a multiple of 8

// Of bytes, a multiple of 8
static inline uint64_t fe__sum_of(const unsigned char *bytes, int64_t size)
{
    fe__sum sum = {{0}, 0};
    return fe__sum_end(&sum, bytes, size);
}

#endif
