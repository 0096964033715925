// clip.h - cuts a face by another face and chooses the four vertices that become contact points.
//
// Box against box (four edges side by side) and the general convex path (any polygon) call it. Both work in the plane
// of the reference face: u and v lie in it, height is measured over it and is below 0 inside. The face that is cut is
// the incident one. The names are those of polygon clipping in 2D engines: reference, incident, slack, feature id.
#ifndef FE_COLLISION_FORM_CLIP_H
#define FE_COLLISION_FORM_CLIP_H
#include "core/math.h"

// The id holds the edges before and after the vertex. Edges of the incident face count from 0, sides of the reference
// face from FE_CLIP_SIDE, so that a vertex keeps its id as long as the two faces meet.
typedef struct fe__clip_vertex {
    float u, v, height;
    uint32_t id;
} fe__clip_vertex;

enum {
    FE_CLIP_SIDE = 16,
    FE_FACE_VERTICES = 16, // The general path cuts faces of at most so many vertices.
    // Each side of a convex polygon adds at most one vertex to what it cuts.
    FE_CLIP_VERTICES = 2 * FE_FACE_VERTICES,
    FE_RIM_POINTS = 16, // A disc is touched at so many points of its rim.
    // A face's edge crosses the rim of a disc at most twice.
    FE_DISC_VERTICES = FE_CLIP_VERTICES + FE_RIM_POINTS,
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

// The patterns in which the points of a disc stand on its rim.
enum {
    FE_RIM_LEANS, // The points stand at equal angles; the disc leans so that one of them is the lowest.
    FE_RIM_LIES,  // The points stand at equal angles; the disc is level.
    FE_RIM_AIMED, // The first two points stand 3 degrees on either side of the way in which the load leans.
};
// Cosine and sine of the points' angles from the first one; row [1] is for an aimed rim. Each point has one across from
// it.
extern const float fe__rim_points[2][FE_RIM_POINTS][2];

// A disc about (0, 0). Its height over the other face, or that of the other face over it, is
// height + slope_u u + slope_v v. `low` is the number of its lowest rim point; they begin at +u and turn left.
typedef struct fe__disc {
    float radius, height, slope_u, slope_v;
    int32_t low, pattern; // pattern: FE_RIM_*
} fe__disc;

// Gives what a convex polygon that turns right, or a segment, has in common with a disc, both reaching `slack` beyond
// their rims: the vertices on the disc, the crossings of edges with its rim, and points of the rim over the polygon. A
// disc that lies wholly over the polygon gives all of its points or, if none of them is above the margin, four, of
// which one is the lowest.
int32_t fe__clip_disc(const fe__disc *disc, const fe__clip_vertex *polygon, int32_t count, float slack, float margin,
                      fe__clip_vertex out[FE_DISC_VERTICES]);

// Metres, a few overlaps of a body at rest: a vertex that is higher than the deepest by no more may carry too.
#define FE__CLEAR 0.001f

// How far a face may lean, m, and still be held by points that are chosen by the load: some overlaps of a body at rest,
// when all of its weight is on one side, or 1.1 degrees of a body that rocks that way. `half` is half the face's width.
static inline float fe__most_lean(float half) { return fe__maxf(FE__CLEAR, 0.02f * half); }

// The last choice stays while it holds the foot, so that neither rounding nor a turn of the face changes the points.
typedef struct fe__choice {
    const uint32_t *ids;
    int32_t count, left_out; // count 0: there was no choice, or it is not known
} fe__choice;

// The foot is the centre of pressure: the point in the polygon's plane where the load on it presses. Which way is out
// is measured from the middle of the vertices; from the origin if the vertices come in portions, because the choice
// among one portion must not depend on the others.
typedef struct fe__foot {
    int32_t is_known;
    float u, v;
    int32_t from_origin;
    int32_t is_aimed; // The foot chooses the points wherever it is.
    fe__choice last;  // The ids are those of the vertices.
} fe__foot;

// Any four points hold the foot up to FE__FOOT_MOST of the way from their middle to their edge. Beyond that the foot
// chooses the points, until it is back at FE__FOOT_BACK. A load that leans over less than FE__FOOT_LEAST of the way is
// held by any four.
#define FE__FOOT_MOST 0.8f
#define FE__FOOT_BACK 0.5f
#define FE__FOOT_LEAST 0.25f

// A choice of some of a face's points leaves out ...
enum {
    FE_LEFT_NONE,  // nothing that touches
    FE_LEFT_SOME,  // some that touch
    FE_LEFT_SIDES, // some, but not on the side to which the load leans: the first two chosen are the edge there
    FE_LEFT_REST,  // the same as SIDES for a rim whose points are aimed: they follow the load, not the body
};

// Leaves at most four vertices: those of the last choice, or the deepest, the farthest from it, and those that span
// most area on either side. Of these, one that is clear of the face gives way to one that lies below. If the foot is
// known and they hardly hold it, it takes the two of the edge that it leans over, and the farthest behind on either
// side. Of vertices that are equal within `tie` (m) the first counts, so that rounding errors do not choose. *left_out
// becomes FE_LEFT_*, by whether some of the others may touch too. `foot` may be NULL together with left_out.
int32_t fe__reduce_to_four(fe__clip_vertex *vertices, int32_t count, float tie, const fe__foot *foot,
                           int32_t *left_out);

// Lowers the heights of cores' vertices by the radii around them, and leaves at most four of those below the margin.
int32_t fe__keep_near(fe__clip_vertex *vertices, int32_t count, float radii, float margin, float tie,
                      const fe__foot *foot, int32_t *left_out);

#endif
