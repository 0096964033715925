// sum.h - the checksum of a section: against accidents, at nearly the speed of memory.
#ifndef FE_STATE_SUM_H
#define FE_STATE_SUM_H
#include <stdint.h>

// Of bytes, a multiple of 8
uint64_t fe__sum_of(const unsigned char *bytes, int64_t size);

#endif
