// fe_geometry.h - the form that a public geometry says, and back: of shapes, and of the parts of compounds.
#ifndef FE_API_FE_GEOMETRY_H
#define FE_API_FE_GEOMETRY_H
#include "api/check.h"

// On FE_OK the form's asset is kept alive until fe__let_go_of_asset.
fe_result fe__read_geometry(const char *function, fe_store *store, const fe_geometry *geometry, fe__form *out_form);
fe_geometry fe__geometry_of(const fe_store *store, const fe__form *form);

#endif
