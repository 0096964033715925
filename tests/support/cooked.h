// cooked.h - assets to save, bytes to break, and what an asset that was accepted must bear.
#ifndef FE_TESTS_COOKED_H
#define FE_TESTS_COOKED_H
#include "feather.h"

#include <stdint.h>

enum { COOKED_SEEDS = 8 }; // small assets of each kind, with all that they may hold
fe_asset cooked_seed(fe_store *store, int32_t which);

// Stamps header and hash on bytes that anybody has changed: only what they hold may be wrong then. In place, size >= 40
// and a multiple of 8
void cooked_stamp(unsigned char *bytes, int64_t size);

// A world with the asset, once as it is and once scaled: bodies fall on it, or it falls; rays, sweeps, overlaps and
// nearest points. Every pose and hit stays finite, or the program ends. Returns the world's hash
uint64_t cooked_use(fe_store *store, fe_asset asset, int32_t steps);

#endif
