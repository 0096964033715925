// delta.h - a snapshot as what differs from another one, its base.
//
//   header    0  magic (8 bytes) | major, minor (2 each) | the world's number (4)
//            16  size of the base (8) | its sum (8) | size of the snapshot (8) | size of what follows (8) | sum (8)
//   runs      words of 4 bytes of the snapshot, in their order. Of each run four numbers, of 7 bits a byte, the lowest
//             first: 2 same + more | changed | if more: skipped | added. Then the changed words and those added, as
//             such numbers. Padded with zeros to a multiple of 8
//
// A run leaves out the skipped words of the base, takes the same ones from it, then the changed ones, each as its
// exclusive or with the base's, then the added ones as they are. No word of the base is read twice, and each that is
// added takes a byte: so no snapshot is larger than its base and four times its difference.
#ifndef FE_SNAPSHOT_DELTA_H
#define FE_SNAPSHOT_DELTA_H
#include "snapshot/read.h"

enum { FE__DELTA_MAJOR = 1, FE__DELTA_HEADER = 56 };

// Room in which the difference of a snapshot of so many bytes is made: four bytes become five at most
static inline int64_t fe__delta_room(int64_t size)
{
    enum { SHARE = 4 };
    return FE__DELTA_HEADER + size + fe__padded(size / SHARE);
}

// In the room, whose last bytes are the snapshot. Of the base the outline was read. Returns the size; 0: it does not
// fit, and the snapshot is lost
int64_t fe__delta_write(unsigned char *room, int64_t size, const fe__snapshot *base);

// ---- back ----------------------------------------------------------------------------------------------------------
int32_t fe__is_delta(const void *bytes, int64_t size);
// The size of the snapshot. 0: refused, as the bytes are not whole, or of another base
int64_t fe__delta_open(fe__snapshot *refusal, const void *bytes, int64_t size, const void *base, int64_t base_size);
// Of an open one, out: of that size. 0: refused
int32_t fe__delta_apply(fe__snapshot *refusal, const void *bytes, int64_t size, const void *base, int64_t base_size,
                        unsigned char *out, int64_t out_size);

#endif
