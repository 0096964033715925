// fe_store.h - geometries with an asset: the form that shapes and queries get, and the scale.
#ifndef FE_API_FE_STORE_H
#define FE_API_FE_STORE_H
#include "api/check.h"

// ---- asset form -----------------------------------------------------------------------------------------------------

// A scale that counts is refused of a form that has none.
fe_result fe__check_has_scale(const char *function, const fe_geometry *geometry);
// The form of a geometry with an asset of `kind`, fe__asset_kind. On FE_OK the record that it has is kept alive until
// fe__let_go_of_asset: another thread may destroy the asset.
fe_result fe__read_asset_form(const char *function, fe_store *store, const fe_geometry *geometry, int32_t kind,
                              fe__form *out_form);
void fe__let_go_of_asset(fe_store *store, const fe__form *form); // of any form
// Of a form with an asset; 0, 0, 0 of any other
fe_vec3 fe__scale_of(const fe_store *store, const fe__form *form);

// ---- store ----------------------------------------------------------------------------------------------------------
// The API functions of stores open with these macros.

#define FE_BEGIN_STORE(store)        \
    const char *function = __func__; \
    FE_CHECK_POINTER(store)

#endif
