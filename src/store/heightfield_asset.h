// heightfield_asset.h - heightfields in a store.
#ifndef FE_STORE_HEIGHTFIELD_ASSET_H
#define FE_STORE_HEIGHTFIELD_ASSET_H
#include "store/store.h"

// A copy of what a checked definition holds. The store's lock is free while samples are copied. FE_ERROR_MEMORY,
// FE_ERROR_LIMIT: nothing changed.
fe_result fe__heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_handle);

// The arrays of a heightfield that is being made: its rows and columns are set. 0: no memory; the asset has what there
// was.
int32_t fe__heightfield_allocate(fe_store *store, fe__asset *asset, int32_t has_cells);

// A rectangle of samples. Under the lock; to write them, every world that uses the asset was entered.
typedef struct fe__samples {
    int32_t row, column, rows, columns;
} fe__samples;
void fe__heightfield_write(fe__heightfield *field, const fe__samples *part, const float *heights);
void fe__heightfield_read(const fe__heightfield *field, const fe__samples *part, float *heights);
// What new samples change, in the field's frame: a cell beyond them on each side, at any height.
fe__bounds fe__samples_bounds(const fe__heightfield *field, const fe__samples *part);

#endif
