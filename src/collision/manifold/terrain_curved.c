// terrain_curved.c - a cylinder, a cone or a hull on a triangle of a heightfield.
//
// Its disc, the line on its side, or the hull's face, over the triangle gives points along the triangle's normal. Near
// a convex side the nearest or deepest points of both (GJK, EPA) give one along the line between them, or the disc's
// part over the side, where the surface allows it. A form whose lowest point lies well inside the triangle is not
// looked at so.
#include "collision/form/clip.h"
#include "collision/form/gjk.h"
#include "collision/form/hull.h"
#include "collision/form/form.h"
#include "collision/manifold/pair_kernels.h"
#include "collision/manifold/terrain_kernels.h"

typedef struct contest {
    fe__gathering *g;
    const fe__tile *tile;
    const fe__form *form;
    const fe__mat3 *rotation;
    float tie;
} contest;

static fe_dvec3 in_common(const contest *c, fe_dvec3 p)
{
    const fe__mat3 *r = c->rotation;
    return fe__dadd(fe__dadd(fe__dscale(p.x, fe__widen(r->x)), fe__dscale(p.y, fe__widen(r->y))),
                    fe__dscale(p.z, fe__widen(r->z)));
}

// The form's point farthest along a direction, as GJK finds it
static fe_dvec3 farthest(const contest *c, fe_vec3 direction)
{
    return in_common(c, fe__form_support(c->form, fe__widen(fe__mul_transposed(c->rotation, direction))));
}

// A form's lowest point on the triangle
typedef struct low_point {
    fe_dvec3 at;
    int32_t vertex; // of a hull
    float height;   // m
} low_point;

static float height_of(const contest *c, fe_dvec3 p)
{
    return fe__dot(c->tile->normal, fe__sub(fe__narrow(p), c->tile->form.vertex[0]));
}

static low_point find_lowest(const contest *c)
{
    fe_vec3 down = fe__neg(c->tile->normal);
    low_point low = {.vertex = -1};
    if (fe__form_is_hull(c->form)) {
        low.vertex = fe__hull_support(c->form->hull, fe__widen(fe__mul_transposed(c->rotation, down)));
        low.at = in_common(c, fe__hull_form_vertex(c->form, low.vertex));
    } else
        low.at = farthest(c, down);
    low.height = height_of(c, low.at);
    return low;
}

// Does one of a hull's planes part it from the triangle by more than is asked for? Then it has no point of it: what is
// cut reaches beyond a side by a tenth of a tie, beyond a corner farther, but not by so much.
static int32_t is_beside_hull(const contest *c)
{
    const float beyond = 2.0f, rounding = 1e-5f; // ties; of the triangle's size
    const fe__form *form = c->form;
    float per_scale = 1.0f / form->scale, gap = c->g->margin + beyond * c->tie + rounding * c->tile->size;
    fe_vec3 corner[3];
    for (int32_t k = 0; k < 3; ++k) {
        fe_vec3 p = fe__mul_transposed(c->rotation, c->tile->form.vertex[k]);
        corner[k] = fe__scale(per_scale, fe__sub(p, form->offset));
    }
    return fe__hull_is_beside(form->hull, corner, per_scale * gap);
}

// A surface has no inside, see fe__tile_feels: the form's highest point tells how deep all of it is
static int32_t is_felt(const contest *c)
{
    fe_vec3 n = c->tile->normal;
    return fe__dot(n, c->tile->form.vertex[0]) <= 0.0f || height_of(c, farthest(c, n)) >= -c->g->felt;
}

// Is the form's lowest point p over the triangle, at least as far from its sides as it is deep? With e >= d >= 0 these
// two, a direction m at an angle t from the normal, up to 90 degrees, has a separation of -d cos t - e sin t at most,
// which is no more than the normal's, -d; and what is apart is nearest there. Beyond a side that is not convex the
// surface rises: what lies there touches the next triangle first, and no direction of that side is allowed.
static int32_t lies_inside(const contest *c, uint32_t convex, fe_dvec3 p, float low)
{
    const fe__tile *tile = c->tile;
    float depth = fe__maxf(-low, 0.0f);
    for (int32_t k = 0; k < 3; ++k) {
        if (!(convex >> k & 1)) continue;
        fe_vec3 v = tile->form.vertex[k], side = fe__sub(tile->form.vertex[(k + 1) % 3], v);
        float inwards = fe__dot(fe__cross(tile->normal, side), fe__sub(fe__narrow(p), v)); // times the side's length
        if (!(inwards > 0.0f && inwards * inwards >= depth * depth * fe__dot(side, side))) return 0;
    }
    return 1;
}

// The face that looks at the triangle, cut by it
typedef struct face_cut {
    fe__face face;
    fe__cut cut;
    fe__cut_piece piece;
} face_cut;

// The load is asked for where the face has more corners than are given: on a rim, and on few hulls.
static void find_face(const contest *c, int32_t lowest_vertex, fe__face *face)
{
    fe_vec3 n = c->tile->normal, foot;
    if (fe__form_is_hull(c->form)) {
        fe__tile_body_face(c->form, c->rotation, fe__neg(n), lowest_vertex, NULL, face);
        if (c->form->hull->faces[face->id].count <= FE_FACE_VERTICES) return;
    }
    int32_t has_foot = fe__find_foot(fe__gathering_load(c->g), c->tile->form.vertex[0], n, &foot);
    fe__tile_body_face(c->form, c->rotation, fe__neg(n), lowest_vertex, has_foot ? &foot : NULL, face);
}

static void cut_face(const contest *c, int32_t lowest_vertex, face_cut *f)
{
    find_face(c, lowest_vertex, &f->face);
    c->g->rims |= f->face.rim > 0.0f ? 1 << f->face.pattern : 0;
    f->cut = (fe__cut){.reference = c->tile->form.vertex,
                       .incident = f->face.vertex,
                       .reference_count = 3,
                       .incident_count = f->face.count,
                       .out = c->tile->normal,
                       .normal = c->tile->normal,
                       .body_id = f->face.id + 1,
                       .tie = c->tie};
    fe__tile_cut_piece(c->tile, &f->cut, &f->piece);
}

// Where a hull's lowest point lies over one side, that and the triangle are all but the answer. A thin triangle, or one
// that is small from there, would be a sliver to begin with, and what has a rim would make one.
static int32_t begins_with_triangle(const contest *c, fe_dvec3 lowest)
{
    const float thin = 0.01f, far = 1e3f; // height of the triangle, distance of the point, in its longest side
    const fe_vec3 *v = c->tile->form.vertex;
    fe_vec3 n = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0])), away = fe__sub(fe__narrow(lowest), v[0]);
    float square = c->tile->size * c->tile->size;
    return fe__form_is_hull(c->form) && fe__dot(n, n) > thin * thin * square * square &&
           fe__dot(away, away) < far * far * square;
}

static void find_distance(const contest *c, const fe__cores *cores, fe_dvec3 lowest, fe__gjk *gjk)
{
    if (!begins_with_triangle(c, lowest)) {
        fe__gjk_distance(cores, (double)c->g->margin, gjk);
        return;
    }
    gjk->count = 3;
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 corner = fe__widen(c->tile->form.vertex[k]);
        gjk->vertex[k] = (fe__vertex){fe__dsub(corner, lowest), corner};
    }
    fe__gjk_distance_from(cores, (double)c->g->margin, gjk);
}

// 0: apart
static int32_t find_nearest(const contest *c, const low_point *low, fe__core_touch *found)
{
    const fe_vec3 *v = c->tile->form.vertex;
    const fe_dvec3 corners[3] = {fe__widen(v[0]), fe__widen(v[1]), fe__widen(v[2])};
    fe__cores cores = {.b = c->form,
                       .axis_x = fe__widen(c->rotation->x),
                       .axis_y = fe__widen(c->rotation->y),
                       .axis_z = fe__widen(c->rotation->z),
                       .corners = corners};
    fe__gjk gjk;
    find_distance(c, &cores, low->at, &gjk);
    if (gjk.distance > (double)c->g->margin) return 0;
    if (gjk.overlap && low->height + c->tie >= 0.0f) { // no direction parts them by a tie more than the face's
        *found = (fe__core_touch){.normal = c->tile->normal, .separation = low->height};
    } else if (gjk.overlap) {
        fe__penetration p = fe__epa_depth(&cores, &gjk);
        *found = (fe__core_touch){fe__narrow(p.normal), (float)-p.depth, fe__narrow(p.on_a), fe__narrow(p.on_b), 1, -1};
    } else {
        fe_dvec3 normal = fe__dscale(1.0 / gjk.distance, fe__dsub(gjk.on_b, gjk.on_a));
        *found = (fe__core_touch){
            fe__narrow(normal), (float)gjk.distance, fe__narrow(gjk.on_a), fe__narrow(gjk.on_b), 0, -1};
    }
    return 1;
}

// The disc lies on the side, or the nearest points are all.
static void touch_side(const contest *c, const fe__core_touch *found)
{
    fe__face face;
    fe__tile_body_face(c->form, c->rotation, fe__neg(found->normal), -1, NULL, &face);
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
    low_point low = find_lowest(&c);
    if (low.height > g->margin || !is_felt(&c)) return;
    uint32_t convex = 0; // a bit for each side
    for (int32_t k = 0; k < 3; ++k) convex |= fe__tile_is_convex(g->terrain, tile, k) ? 1u << k : 0u;
    int32_t is_inside = lies_inside(&c, convex, low.at, low.height);
    if (!is_inside && fe__form_is_hull(form) && is_beside_hull(&c)) return;
    face_cut f;
    cut_face(&c, low.vertex, &f);
    if (!is_inside && !fe__tile_settles(&f.cut, &f.piece, low.height)) {
        fe__core_touch found;
        if (!find_nearest(&c, &low, &found)) return;
        const float level = 1e-3f; // sine: along the face both ways are out of the surface
        float up = fe__dot(found.normal, n);
        if (found.separation > low.height + c.tie && up <= FE_FACE_COS && up >= -level &&
            fe__tile_feels_along(g, tile, found.normal, &found.on_a, found.separation)) {
            touch_side(&c, &found);
            return;
        }
    }
    fe__tile_gather_piece(g, tile, &f.cut, &f.piece);
}
