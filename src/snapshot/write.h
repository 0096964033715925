// write.h - a world as bytes. Nothing is allocated, nothing of the world changes.
#ifndef FE_SNAPSHOT_WRITE_H
#define FE_SNAPSHOT_WRITE_H
#include "snapshot/format.h"

// Under the store's lock. with_assets: the contents of assets, too
int64_t fe__snapshot_size(const fe_world *world, int32_t with_assets);
void fe__snapshot_write(const fe_world *world, int32_t with_assets, unsigned char *out); // of that size

#endif
