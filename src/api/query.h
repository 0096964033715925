// query.h - what the files of the query API share: reading filters and geometries, the scene.
#ifndef FE_API_QUERY_H
#define FE_API_QUERY_H
#include "api/check.h"
#include "core/fp_state.h"
#include "query/cast.h"

enum { FE_LEAST_RECORD = 8 }; // bytes of a record that a caller may ask for

// `copy` is whole afterwards. NULL: the defaults.
fe_result fe__read_filter(const char *function, const fe_query_filter *filter, fe_query_filter *copy);
// What a query moves: any form with an inside but the half space, and a sphere may have no radius. A hull is kept alive
// until fe__let_go_of_form: another thread may destroy it.
typedef struct fe__moving_form {
    fe__form form;
    fe_store *store; // that has the form's hull; NULL: it has none
} fe__moving_form;
fe_result fe__read_moving_form(const char *function, const fe_world *world, const fe_geometry *geometry,
                               fe__moving_form *out_moving);
void fe__let_go_of_form(const fe__moving_form *moving);
// A form until the end of the block, whose name is `moving`.form
#define FE_READ_MOVING_FORM(world, geometry)                                 \
    fe__moving_form moving FE_CLEANUP(fe__let_go_of_form) = {.store = NULL}; \
    FE_TRY(fe__read_moving_form(function, world, geometry, &moving))
fe__scene fe__scene_of(const fe_world *world, const fe_query_filter *whole_filter);

// A query from its checked arguments to its hits. The scene points to the filter: it is not copied.
typedef struct fe__query {
    fe_query_filter filter; // whole
    fe__scene scene;
    fe__fp_state fp;
} fe__query;
static inline void fe__open_query(const fe_world *world, fe__query *query)
{
    query->fp = fe__fp_enter();
    query->scene = fe__scene_of(world, &query->filter);
}
// `filter` is the last argument that is checked
static inline fe_result fe__begin_query(const char *function, const fe_world *world, const fe_query_filter *filter,
                                        fe__query *query)
{
    FE_TRY(fe__read_filter(function, filter, &query->filter));
    fe__open_query(world, query);
    return FE_OK;
}
static inline void fe__end_query(const fe__query *query) { fe__fp_leave(query->fp); }

#endif
