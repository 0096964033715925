// hull_asset.h - convex hulls in a store.
#ifndef FE_STORE_HULL_ASSET_H
#define FE_STORE_HULL_ASSET_H
#include "collision/hull_build/build.h"
#include "store/store.h"

// The hull of checked points. The store's lock is free while it is built. FE_ERROR_DEGENERATE: they are too thin, as
// out_refusal tells; FE_ERROR_MEMORY, FE_ERROR_LIMIT. Then nothing changed.
fe_result fe__hull_create(fe_store *store, const fe__hull_points *points, fe__hull_refusal *out_refusal,
                          fe_asset *out_handle);

#endif
