// query.h - what the files of the query API share: reading filters and geometries, the scene.
#ifndef FE_API_QUERY_H
#define FE_API_QUERY_H
#include "api/check.h"
#include "query/cast.h"

enum { FE_LEAST_RECORD = 8 }; // bytes of a record that a caller may ask for

// `copy` is whole afterwards. NULL: the defaults.
fe_result fe__read_filter(const char *function, const fe_query_filter *filter, fe_query_filter *copy);
// Of a query: sphere, capsule or box, and a sphere may have no radius.
fe_result fe__read_moving_form(const char *function, const fe_geometry *geometry, fe__form *out_form);
fe__scene fe__scene_of(const fe_world *world, const fe_query_filter *whole_filter);

#endif
