// terrain_curved.c - a cylinder, a cone or a hull on a triangle of a heightfield.
//
// Its disc, the line on its side, or the hull's face, over the triangle gives points along the triangle's normal. Near
// a convex side the nearest or deepest points of both (GJK, EPA) give one along the line between them, or the disc's
// part over the side, where the surface allows it.
#include "collision/form/clip.h"
#include "collision/form/epa.h"
#include "collision/form/support.h"
#include "collision/manifold/kernels.h"
#include "collision/manifold/terrain_kernels.h"

typedef struct contest {
    fe__gathering *g;
    const fe__tile *tile;
    const fe__form *form;
    const fe__mat3 *rotation;
    float tie;
} contest;

// Height over the triangle's plane of the form's lowest, or highest, point
static float height_of(const contest *c, fe_vec3 direction)
{
    fe_vec3 p = fe__narrow(fe__form_support(c->form, fe__widen(fe__mul_transposed(c->rotation, direction))));
    return fe__dot(c->tile->normal, fe__sub(fe__mul(c->rotation, p), c->tile->form.vertex[0]));
}

static void touch_face(const contest *c)
{
    fe__face face;
    fe__tile_body_face(c->form, c->rotation, fe__neg(c->tile->normal), &face);
    fe__cut cut = {.reference = c->tile->form.vertex,
                   .incident = face.vertex,
                   .reference_count = 3,
                   .incident_count = face.count,
                   .out = c->tile->normal,
                   .normal = c->tile->normal,
                   .body_id = face.id + 1,
                   .tie = c->tie};
    fe__tile_cut_faces(c->g, c->tile, &cut);
}

// 0: apart
static int32_t find_nearest(const contest *c, fe__touch *found)
{
    fe__cores cores = {.a = &c->tile->form,
                       .b = c->form,
                       .axis_x = fe__widen(c->rotation->x),
                       .axis_y = fe__widen(c->rotation->y),
                       .axis_z = fe__widen(c->rotation->z)};
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)c->g->margin, &gjk);
    if (gjk.distance > (double)c->g->margin) return 0;
    if (gjk.overlap) {
        fe__penetration p = fe__epa_depth(&cores, &gjk);
        *found = (fe__touch){fe__narrow(p.normal), (float)-p.depth, fe__narrow(p.on_a), fe__narrow(p.on_b), 1};
    } else {
        fe_dvec3 normal = fe__dscale(1.0 / gjk.distance, fe__dsub(gjk.on_b, gjk.on_a));
        *found = (fe__touch){fe__narrow(normal), (float)gjk.distance, fe__narrow(gjk.on_a), fe__narrow(gjk.on_b), 0};
    }
    return 1;
}

// The disc lies on the side, or the nearest points are all.
static void touch_side(const contest *c, const fe__touch *found)
{
    fe__face face;
    fe__tile_body_face(c->form, c->rotation, fe__neg(found->normal), &face);
    fe_vec3 out = face.count > 2 ? fe__mul(c->rotation, face.normal) : found->normal;
    if (face.count > 2 && -fe__dot(out, found->normal) > FE_FACE_COS) {
        fe__cut cut = {.reference = face.vertex,
                       .incident = c->tile->form.vertex,
                       .reference_count = face.count,
                       .incident_count = 3,
                       .out = out,
                       .normal = fe__neg(out),
                       .tie = c->tie};
        fe__tile_cut_faces(c->g, c->tile, &cut);
        return;
    }
    enum { NEAREST_ID = 0xff };
    fe__gather(c->g, c->tile, found->normal, fe__scale(0.5f, fe__add(found->on_a, found->on_b)), found->separation,
               fe__tile_id(c->tile, NEAREST_ID));
}

void fe__keep_side_ends(fe__raw_patch *patch, float tie)
{
    enum { LINE = 1 << 16 }; // as touch_face names it: face 0, the vertices of a segment
    int32_t from = -1, to = -1;
    for (int32_t i = 0; i < patch->count; ++i) {
        if (patch->points[i].id == (LINE | fe__clip_id(1, 0))) from = i;
        if (patch->points[i].id == (LINE | fe__clip_id(0, 1))) to = i;
    }
    if (from >= 0 && to >= 0) fe__keep_line_ends(patch, from, to, tie);
}

void fe__tile_touch_curved(fe__gathering *g, const fe__tile *tile, const fe__form *form, const fe__mat3 *rotation)
{
    contest c = {g, tile, form, rotation, fe__tie(fe__form_thickness(form))};
    fe_vec3 n = tile->normal;
    float low = height_of(&c, fe__neg(n));
    if (low > g->margin || !fe__tile_feels(g, tile, height_of(&c, n))) return;
    int32_t convex = 0;
    for (int32_t k = 0; k < 3; ++k) convex |= fe__tile_is_convex(g->terrain, tile, k);
    fe__touch found;
    if (convex && !find_nearest(&c, &found)) return;
    if (convex && found.separation > low + c.tie && fe__dot(found.normal, n) <= FE_FACE_COS &&
        fe__dot(found.normal, n) >= 0.0f && fe__tile_allows(g->terrain, tile, found.normal))
        touch_side(&c, &found);
    else
        touch_face(&c);
}
