// hull.h - a convex hull as the narrow phase reads it: half-edges, planes, vertices, and the Gauss map edge by edge.
//
// collision/hull_build makes it, a store owns it, and nothing changes it. One block of memory holds all arrays, without
// pointers inside: the same points make the same bytes on every machine.
#ifndef FE_COLLISION_FORM_HULL_H
#define FE_COLLISION_FORM_HULL_H
#include "collision/form/form.h"
#include "core/memory.h"

// ---- hull -----------------------------------------------------------------------------------------------------------
// Frame. Vertices, planes and edges are relative to `origin`, a point of the asset's frame. It is 0 on each axis unless
// the hull lies farther than twice its extent from 0 there: floats then hold it as exactly as its points, and
// origin + vertex is the caller's point, bit for bit.
//
// Invariants, for every hull:
//   - 4..255 vertices, V - E + F = 2; a vertex has at least two edges, a face at least three.
//   - Vertices are some of the caller's points, in their order.
//   - No vertex is above a plane: n . v <= distance, the product taken in double. Each plane touches a vertex.
//   - A face's vertices lie at most `flatness` below its plane, a quarter of the tolerance. They turn left around its
//     normal; one that turns right lies inside of the line past it by no more than that.
//   - Half-edges come in pairs: i and i ^ 1 are one, and edge k has 2 k and 2 k + 1. The even one of a pair starts at
//     the vertex with the lower number. next goes around the left face. A vertex's `spoke` is one half-edge that starts
//     there; edge[h ^ 1].next is the one after it, clockwise seen from outside.
//   - The Gauss map: an edge's arc runs from the normal of its left face to that of its right one, and turns about the
//     edge's vector: (normal_left x normal_right) . vector > 0.
//
// Lanes. Vectors that loops read side by side stand as one array per coordinate, with a multiple of 16 floats, aligned
// to 64 bytes. Lanes past the count repeat the first: they never win against it, and a comparison that prefers the
// lowest index never names one.

enum {
    FE__HULL_VERTICES = 255,                    // A hull has at most so many vertices.
    FE__HULL_FACES = 2 * FE__HULL_VERTICES - 4, // Euler's formula bounds the faces by this number.
    FE__HULL_EDGES = 3 * FE__HULL_VERTICES - 6, // Euler's formula bounds the edges by this number.
    FE__HULL_CORNERS = 2 * FE__HULL_EDGES,      // Each half-edge is a corner of one face.
    FE__HULL_DIRECTIONS = 32,                   // Hulls with more are not worth asking direction by direction.
    FE__HULL_LANES = 16                         // The widest SIMD set has so many lanes.
};

// A half-edge.
typedef struct fe__hull_edge {
    uint16_t next;  // the next half-edge around the left face
    uint16_t face;  // the face on its left
    uint8_t origin; // the vertex at its beginning
    uint8_t reserved[3];
} fe__hull_edge;
_Static_assert(sizeof(fe__hull_edge) == 8, "a half-edge is 8 bytes");

typedef struct fe__hull_face {
    uint16_t first; // place of its first corner in `corners`
    uint16_t count; // number of its corners, >= 3
    uint16_t edge;  // the half-edge from its first corner to its second
    uint16_t reserved;
} fe__hull_face;
_Static_assert(sizeof(fe__hull_face) == 8, "a face is 8 bytes");

typedef struct fe__hull_lanes {
    const float *x, *y, *z;
} fe__hull_lanes;

// Mass properties at a density of 1 kg/m3, in the asset's frame.
typedef struct fe__hull_mass {
    double volume, area; // m3, m2
    fe_dvec3 centre;     // centre of mass relative to the hull's origin, m
    fe_vec3 inertia;     // principal moments about the centre, kg m2
    fe_quat axes;        // turns the principal axes into the asset's
} fe__hull_mass;

typedef struct fe__hull {
    int32_t vertex_count, face_count, edge_count;
    int32_t direction_count; // number of edges that are not parallel; 0: there are too many, and none is kept
    fe_vec3 origin;          // origin of the hull's frame in the asset's, m
    fe_vec3 low, high;       // bounds of the vertices
    float thickness;         // least width between a face and the vertex farthest below it, m
    float inner_radius;      // radius of the largest ball about the centre of mass, m
    float extent;            // longest side of the bounds of all points, m
    float tolerance;         // the builder's tolerance, m
    float error;             // how far the farthest point left out lies above a plane, m, >= 0
    float flatness;          // m, see the invariants
    fe__hull_mass mass;

    // All arrays lie in `block`.
    fe__hull_lanes vertices;    // [vertex_count]
    fe__hull_lanes normals;     // [face_count], unit
    const float *distances;     // [face_count], distances of the planes
    fe__hull_lanes tails;       // [edge_count], first vertex of the edge
    fe__hull_lanes vectors;     // [edge_count], from the first to the second vertex
    fe__hull_lanes left, right; // [edge_count], normals of the faces
    fe__hull_lanes directions;  // [direction_count], unit
    const fe__hull_edge *edges; // [2 x edge_count]
    const fe__hull_face *faces; // [face_count]
    const uint16_t *spokes;     // [vertex_count]
    const uint8_t *corners;     // [2 x edge_count], the vertices of all faces
    void *block;
    int64_t size; // size of the block, bytes
} fe__hull;

static inline int32_t fe__hull_padded(int32_t count)
{
    return (count + FE__HULL_LANES - 1) / FE__HULL_LANES * FE__HULL_LANES;
}
static inline fe_vec3 fe__hull_lane(const fe__hull_lanes *lanes, int32_t i)
{
    return (fe_vec3){lanes->x[i], lanes->y[i], lanes->z[i]};
}
static inline fe_vec3 fe__hull_vertex(const fe__hull *hull, int32_t i) { return fe__hull_lane(&hull->vertices, i); }
static inline fe_vec3 fe__hull_normal(const fe__hull *hull, int32_t i) { return fe__hull_lane(&hull->normals, i); }

// The face's normal with a length of 1 in double; the stored one has the rounding of floats.
static inline fe_dvec3 fe__hull_unit_normal(const fe__hull *hull, int32_t i)
{
    fe_dvec3 n = fe__widen(fe__hull_normal(hull, i));
    return fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n);
}

// The vertices farthest along a direction and farthest against it.
typedef struct fe__hull_ends {
    int32_t along, against;
} fe__hull_ends;

// An edge lies along a face if it leans no more than this, the sine of 5 degrees.
#define FE__LIES_ALONG 0.0872f

// ---- in the hull's frame -------------------------------------------------------------------------------------------
// The vertex farthest along the direction; of equally far ones the one with the lowest number.
int32_t fe__hull_support(const fe__hull *hull, fe_dvec3 direction);
fe__hull_ends fe__hull_ends_along(const fe__hull *hull, fe_dvec3 direction);
// The face that looks most along the direction; of equal ones the one with the lowest number.
int32_t fe__hull_facing(const fe__hull *hull, fe_dvec3 direction);
// Bounding radius: the largest distance from `centre` to a point of the hull, m.
float fe__hull_reach(const fe__hull *hull, fe_vec3 centre);
// The bounds in the world of a hull whose frame has this pose.
fe__bounds fe__hull_bounds(const fe__hull *hull, const fe__pose *pose);
// The same in floats, wider by their rounding. They serve to ask whether the hull has left another box.
fe__bounds fe__hull_rough_bounds(const fe__hull *hull, const fe__pose *pose);
// Rough bounds of the turned hull, relative to its origin.
void fe__hull_span(const fe__hull *hull, const fe__mat3 *rotation, fe_vec3 *low, fe_vec3 *high);
// A box that moves and does not turn, with a ball around each of its points.
typedef struct fe__hull_passer {
    fe_dvec3 origin, translation; // motion of the box's middle, m
    fe_dvec3 half[3];             // axes times half widths, m
    double radius;
} fe__hull_passer;
// Tests the box against the hull's planes in floats. 1: the box stays outside until t = limit. 0: it may meet the hull,
// but not before t = *out_from, when it is still outside; if *out_from is 0, it may be inside from the beginning.
int32_t fe__hull_is_passed(const fe__hull *hull, const fe__hull_passer *passer, double limit, double *out_from);
// Do all three corners lie beyond one of the hull's planes, by more than `gap`, m?
int32_t fe__hull_is_beside(const fe__hull *hull, const fe_vec3 corner[3], float gap);
// Casts a ray as fe__form_ray does; hit->triangle is the face.
int32_t fe__hull_ray(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__ray_hit *hit);

// ---- hull form ------------------------------------------------------------------------------------------------------
// The form of a shape with a hull: the hull scaled and shifted.

// `index` is the index of the hull's asset.
fe__form fe__hull_form(const fe__hull *hull, int32_t index);
fe_vec3 fe__hull_form_centre(const fe__form *form); // centre of mass, form's frame
// A point inside any form: the origin but for a hull, whose frame may lie anywhere.
static inline fe_vec3 fe__form_middle(const fe__form *form)
{
    return fe__form_is_hull(form) ? fe__hull_form_centre(form) : fe__vec3(0.0f, 0.0f, 0.0f);
}

fe_dvec3 fe__hull_form_vertex(const fe__form *form, int32_t vertex); // form's frame
// fe__form_face, if the vertex farthest along the direction is known.
void fe__hull_form_face_at(const fe__form *form, int32_t vertex, fe_vec3 direction, fe__face *face);

// A box that holds the bounds of the form. It takes less time for a hull than its bounds, and is wider by some
// rounding.
fe__bounds fe__hull_form_rough_bounds(const fe__form *form, const fe__pose *pose);
static inline fe__bounds fe__form_rough_bounds(const fe__form *form, const fe__pose *pose)
{
    return fe__form_is_hull(form) ? fe__hull_form_rough_bounds(form, pose) : fe__form_bounds(form, pose);
}

// The face as a polygon in the hull's frame; out->foot is input, in the same frame. If the face has more corners than
// FE_FACE_VERTICES, some are left out, but never the farthest along `deepest` or, while the face lies, the edge over
// which the load leans.
void fe__hull_polygon(const fe__hull *hull, int32_t face, fe_vec3 deepest, fe__face *out);

// A point from the form's frame to the hull's, and back.
static inline fe_dvec3 fe__in_hull(const fe__form *form, fe_dvec3 point)
{
    return fe__dscale(1.0 / (double)form->scale, fe__dsub(point, fe__widen(form->offset)));
}
static inline fe_dvec3 fe__from_hull(const fe__form *form, fe_dvec3 point)
{
    return fe__dadd(fe__widen(form->offset), fe__dscale((double)form->scale, point));
}

// Fetches a form's hull into the cache and, when that is there, the vertices, or the planes and half-edges. Only a part
// of a large hull's arrays is fetched, because the kernels do not read them to their ends.
FE_FETCHES fe__hull_form_fetch(const fe__form *form)
{
    if (fe__form_is_hull(form)) fe__fetch(form->hull, sizeof *form->hull);
}
FE_FETCHES fe__fetch_between(const void *from, const void *to)
{
    const ptrdiff_t most = 2048; // bytes
    ptrdiff_t size = (const char *)to - (const char *)from;
    fe__fetch(from, (unsigned)(size < most ? size : most));
}
FE_FETCHES fe__hull_form_fetch_vertices(const fe__form *form)
{
    if (fe__form_is_hull(form)) fe__fetch_between(form->hull->vertices.x, form->hull->normals.x);
}
FE_FETCHES fe__hull_form_fetch_faces(const fe__form *form)
{
    if (!fe__form_is_hull(form)) return;
    const fe__hull *h = form->hull;
    fe__fetch_between(h->normals.x, h->tails.x);
    fe__fetch_between(h->edges, (const char *)h->block + h->size);
}

#endif
