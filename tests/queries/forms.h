// forms.h - random convex forms for the tests of queries, and what the judge of separation.h makes of them.
#ifndef FE_QUERIES_FORMS_H
#define FE_QUERIES_FORMS_H
#include "api/api_test.h"
#include "queries/dice.h"
#include "queries/separation.h"

typedef struct solid_form {
    fe_geometry geometry;
    fe_asset asset; // 0: none
    float points[MOST_POINTS][3];
    int32_t count; // of a hull's vertices
    double reach;  // m, of its farthest point from the origin
} solid_form;

static inline void make_hull_form(fe_store *store, dice *d, double least, double most, int32_t count, solid_form *f)
{
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = f->points[0], def.point_count = count;
    fe_result made = FE_ERROR_DEGENERATE;
    while (made == FE_ERROR_DEGENERATE) { // too thin
        double size = spread(d, least, most), sizes[3] = {size, size * spread(d, 0.1, 1), size * spread(d, 0.1, 1)};
        for (int32_t i = 0; i < 3 * count; ++i) f->points[i / 3][i % 3] = (float)(sizes[i % 3] * uniform(d, -1, 1));
        made = fe_hull_create(store, &def, &f->asset);
    }
    OK(made);
    fe_geometry_hull(&f->geometry, f->asset);
    f->count = fe_hull_get_vertices(store, f->asset, (fe_vec3 *)f->points, 0, MOST_POINTS);
    FE_WITHIN(f->count, 4, MOST_POINTS);
}

// Of `least` to `most` m; a hull is that of so many points.
static inline void make_form(fe_store *store, dice *d, int32_t type, double least, double most, int32_t points,
                             solid_form *f)
{
    memset(f, 0, sizeof *f);
    fe_geometry *g = &f->geometry;
    float x = (float)spread(d, least, most), y = (float)spread(d, least, most), z = (float)spread(d, least, most);
    if (type == FE_GEOMETRY_SPHERE) fe_geometry_sphere(g, x);
    if (type == FE_GEOMETRY_CAPSULE) fe_geometry_capsule(g, x, y);
    if (type == FE_GEOMETRY_BOX) fe_geometry_box(g, x, y, z);
    if (type == FE_GEOMETRY_CYLINDER) fe_geometry_cylinder(g, x, y);
    if (type == FE_GEOMETRY_CONE) fe_geometry_cone(g, x, y);
    if (type == FE_GEOMETRY_HULL) make_hull_form(store, d, least, most, points, f);
    fe_vec3 h = g->half_extents;
    f->reach = sqrt((double)(h.x * h.x + h.y * h.y + h.z * h.z)) + (double)g->radius + (double)g->half_height;
    for (int32_t i = 0; i < f->count; ++i) {
        const float *p = f->points[i];
        f->reach = fmax(f->reach, sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])));
    }
}

static inline void free_form(fe_store *store, solid_form *f)
{
    if (f->asset) OK(fe_asset_destroy(store, f->asset));
    f->asset = 0;
}

static inline convex convex_of_form(const solid_form *f, vec centre, fe_quat q)
{
    return convex_of(&f->geometry, (const float(*)[3])f->points, f->count, centre, q);
}

// What swells the core that convex_of_form gives
static inline double radius_of(const solid_form *f)
{
    return f->geometry.type <= FE_GEOMETRY_CAPSULE ? (double)f->geometry.radius : 0;
}

#endif
