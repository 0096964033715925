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
    FE_RIM_POINTS = 16,                      // of a disc
    FE_DISC_VERTICES = FE_CLIP_VERTICES + FE_RIM_POINTS, // of a disc and a face: each edge crosses it twice at most
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

// How the points of a disc stand on its rim
enum {
    FE_RIM_LEANS, // at equal angles; the disc leans so that one of them is the lowest
    FE_RIM_LIES,  // at equal angles; the disc is level
    FE_RIM_AIMED, // the first two stand 3 degrees on either side of where the load leans
};
// Cosine and sine of their angles from the first; [1] of an aimed rim. Each has one across from it
extern const float fe__rim_points[2][FE_RIM_POINTS][2];

// A disc about (0, 0), and its height over the other face or that of the other over it, which is
// height + slope_u u + slope_v v. `low`: of the points at its rim, which begin at +u and turn left, the lowest.
typedef struct fe__disc {
    float radius, height, slope_u, slope_v;
    int32_t low, pattern;
} fe__disc;

// Gives what a convex polygon that turns right, or a segment, has in common with a disc, both reaching `slack` beyond
// their rims: the vertices on the disc, where edges cross its rim, and points of the rim over the polygon. A disc that
// lies wholly over the polygon gives all of them, or, where none is above the margin, four, of which one is the lowest.
int32_t fe__clip_disc(const fe__disc *disc, const fe__clip_vertex *polygon, int32_t count, float slack, float margin,
                      fe__clip_vertex out[FE_DISC_VERTICES]);

// m, a few overlaps of a body at rest: a vertex that is higher than the deepest by no more may carry too
#define FE__CLEAR 0.001f

// How far a face may lean, m, and still be held by the points that are chosen by the load: some overlaps of a body at
// rest, when all of its weight is on one side, or 1.1 degrees of what rocks that way. `half`: of the face's width
static inline float fe__most_lean(float half) { return fe__maxf(FE__CLEAR, 0.02f * half); }

// The last choice stays while it holds the foot: so neither rounding nor a turn of the face changes the points.
typedef struct fe__choice {
    const uint32_t *ids;
    int32_t count, left_out; // count 0: none, or it is not known
} fe__choice;

// The foot is where the load on a polygon presses, in its plane. Which way is out counts from amid the vertices, or
// from the origin where these come by and by: the choice of some of them must not depend on the others.
typedef struct fe__foot {
    int32_t is_known;
    float u, v;
    int32_t from_origin, is_aimed; // is_aimed: it chooses, wherever it is
    fe__choice last;               // the ids are those of the vertices
} fe__foot;

// Four hold the foot up to this share of the way from their middle to their edge; where they do not, it chooses, and
// then until it is back at that share. One that leans over less is held by any four.
#define FE__FOOT_MOST 0.8f
#define FE__FOOT_BACK 0.5f
#define FE__FOOT_LEAST 0.25f

// A choice of some of a face's points leaves out
enum {
    FE_LEFT_NONE, // nothing that touches
    FE_LEFT_SOME,
    FE_LEFT_SIDES, // some, but not where the load leans: the first two are the edge there
    FE_LEFT_REST,  // the same of a rim whose points are aimed: they follow the load, not the body
};

// Leaves at most four: those of the last choice, or the deepest, the farthest from it, and those that span most area on
// either side. Of these, what is clear of the face gives way to what lies below. Where the foot is known and they
// hardly hold it, the two of the edge that it leans over, and the farthest behind on either side. Of vertices that are
// equal within `tie` (m) the first, so that rounding errors do not choose. Where some of the others may touch too,
// *left_out becomes FE_LEFT_*. `foot` may be NULL, with left_out: then nobody asks.
int32_t fe__reduce_to_four(fe__clip_vertex *vertices, int32_t count, float tie, const fe__foot *foot,
                           int32_t *left_out);

// Lowers the heights of cores' vertices by the radii around them, and leaves at most four of those below the margin.
int32_t fe__keep_near(fe__clip_vertex *vertices, int32_t count, float radii, float margin, float tie,
                      const fe__foot *foot, int32_t *left_out);

#endif
