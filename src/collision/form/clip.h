// clip.h - the polygon in which two faces meet, and its four points.
//
// Used by box against box (four edges side by side) and by the general convex path (any polygon). Both work in the
// plane of the reference face: u, v along it, height over it, below 0 inside. The incident face is what is cut.
#ifndef FE_COLLISION_FORM_CLIP_H
#define FE_COLLISION_FORM_CLIP_H
#include "core/math.h"

// id: the edges before and after the vertex. Edges of the incident face count from 0, sides of the reference face from
// FE_CLIP_SIDE: the name of a vertex lives as long as the two meet.
typedef struct fe__clip_vertex {
    float u, v, height;
    uint32_t id;
} fe__clip_vertex;

enum {
    FE_CLIP_SIDE = 16,
    FE_FACE_VERTICES = 16,                   // of the faces that the general path cuts, at most
    FE_CLIP_VERTICES = 2 * FE_FACE_VERTICES, // of their common polygon: each side of a convex one adds at most one
};

static inline uint32_t fe__clip_id(int32_t before, int32_t after) { return (uint32_t)before << 8 | (uint32_t)after; }

// A parallelogram centre + i x + j y, |i|, |j| <= 1; (x, y, z) of each vector are u, v, height.
typedef struct fe__parallelogram {
    fe_vec3 centre, x, y;
} fe__parallelogram;

// Cuts the parallelogram by the rectangle |u| <= half_u, |v| <= half_v, widened by `slack`. Gives the vertices below
// `margin`, among them the rectangle's corners over or under the parallelogram, 12 at most.
int32_t fe__clip_rectangle(const fe__parallelogram *incident, float half_u, float half_v, float slack, float margin,
                           fe__clip_vertex out[12]);

// Cuts a polygon, a segment or a point (count > 2, 2, 1; at most FE_FACE_VERTICES) by a convex polygon that turns left,
// widened by `slack` (Sutherland and Hodgman, 1974). `incident` must hold FE_CLIP_VERTICES and is overwritten. Returns
// the count left.
int32_t fe__clip_polygon(const fe__clip_vertex *reference, int32_t reference_count, fe__clip_vertex *incident,
                         int32_t count, float slack);

// Leaves at most four: the deepest, the farthest from it, and those that span most area on either side; of these, what
// is clear of the face gives way to what lies below. Of vertices that are equal within `tie` (m) the first, so that
// rounding errors do not choose.
int32_t fe__reduce_to_four(fe__clip_vertex *vertices, int32_t count, float tie);

#endif
