// compare.h - where two worlds first differ, told from their snapshots alone: neither is restored, no asset is needed.
//
// What the bytes hold is taken row by row, by the one table of fields. Rows of two snapshots belong together when they
// are of one serial, or for pairs of two shapes' serials: slots may differ. First come values: the world's settings,
// then bodies, shapes, joints and pairs, each kind in the order of creation, then lists. Where things lie (slots,
// links, who follows whom) comes behind all values: it differs for many once something is missing. Trees are left out.
#ifndef FE_SNAPSHOT_COMPARE_H
#define FE_SNAPSHOT_COMPARE_H
#include "core/memory.h"
#include "snapshot/read.h"

// 1: out_difference says where, but for its struct_size. 0: nowhere. FE_ERROR_MEMORY
int32_t fe__snapshot_compare(const fe__snapshot *a, const fe__snapshot *b, fe__memory *memory,
                             fe_difference *out_difference);

#endif
