// approach.h - the approach of two forms: two cores, one of which moves in the frame of the other.
//
// The sweeps (sweep.c, sweep_field.c, turning.c) fill it, approach.c finds distances and stops. Every form but planes,
// hulls and forms with a rim is a core - a point, a segment along y, a box - swelled by its radius. The form whose core
// has more dimensions gives the frame, whichever of the two moves: so there are six kinds of pairs. A point is a box of
// no size, a segment is a box with only a height: the test that separates boxes serves all.
#ifndef FE_COLLISION_CAST_APPROACH_H
#define FE_COLLISION_CAST_APPROACH_H
#include "collision/form/ground.h"

// ---- mover ----------------------------------------------------------------------------------------------------------
// A sweep stops a form so far before the other, m.
#define FE_SWEEP_GAP 1e-7
// Forms touch when they overlap by no more than this, or are no farther apart, m. It is a hundredth of the gap, and
// more than rounding makes of an exact touch.
#define FE_SWEEP_TOUCH 1e-9

// The three columns of a rotation: the images of the axes.
typedef struct fe__axes {
    fe_dvec3 x, y, z;
} fe__axes;

fe__axes fe__axes_of(fe_quat q); // q may have any length.
static inline fe_dvec3 fe__turn(const fe__axes *m, fe_dvec3 a)
{
    return fe__dadd(fe__dadd(fe__dscale(a.x, m->x), fe__dscale(a.y, m->y)), fe__dscale(a.z, m->z));
}
static inline fe_dvec3 fe__turn_back(const fe__axes *m, fe_dvec3 a)
{
    return (fe_dvec3){fe__ddot(m->x, a), fe__ddot(m->y, a), fe__ddot(m->z, a)};
}

// The moving form (anything bounded) in the frame of the standing one.
typedef struct fe__mover {
    const fe__form *form;
    fe__axes axes;
    fe_dvec3 position, translation; // m
    fe_dvec3 turn; // rad: on the way the axes turn about this vector by its length, about the position; 0: not at all
} fe__mover;

typedef struct fe__sweep_hit {
    double t;         // share of the translation
    fe_dvec3 normal;  // unit, out of the standing form; if inside, the shortest way out
    fe_dvec3 point;   // point of the standing form's surface that is met; if inside, the mover's position
    double depth;     // length of the way out if inside, m
    int32_t inside;   // The forms overlap at the start.
    int32_t triangle; // number of a heightfield's or a mesh's triangle, or of a hull's face; -1: other forms
    int32_t index;    // index of the triangle in ground.h
} fe__sweep_hit;

// ---- approach -------------------------------------------------------------------------------------------------------
typedef enum fe__core_kind {
    FE_CORE_POINT,
    FE_CORE_SEGMENT,
    FE_CORE_BOX,
    FE_CORE_TRIANGLE,
    FE_CORE_CURVED
} fe__core_kind;

typedef struct fe__approach {
    int32_t frame_kind, other_kind;          // fe__core_kind, frame_kind >= other_kind but for a triangle
    const fe__form *frame_form, *other_form; // NULL for a triangle
    double frame_half[3], other_half[3];     // half widths of the cores along their own axes, m
    fe__axes axes;                           // axes of the other core, in the frame
    fe_dvec3 position, translation;          // position and motion of the other core relative to the frame, m
    fe_dvec3 vertex[3], normal;              // a triangle as the frame's core; the normal has length 1
    double radius;                           // sum of both radii: the cores touch at this distance, m
    double gap;                              // fe__stop_gap, m
    double touch;                            // fe__touch_of, m
} fe__approach;

// Nearest points of the cores, with the other one's centre at `position`.
typedef struct fe__core_gap {
    double distance; // 0: they overlap
    fe_dvec3 on_frame;
    fe_dvec3 away; // from on_frame to the other core's nearest point
    // Curved cores have these, too.
    double size;     // size of their difference, m: the distance is precise to a share of it
    double apart_by; // how far a plane holds the cores apart, m, if GJK met one
} fe__core_gap;
// The other core is a point or a segment.
void fe__core_gap_of(const fe__approach *a, fe_dvec3 position, fe__core_gap *gap);
// One of the cores is curved.
void fe__curved_gap_of(const fe__approach *a, fe_dvec3 position, fe__core_gap *gap);
// The frame's core is a triangle, the other one a point or a segment.
void fe__triangle_gap_of(const fe__approach *a, fe_dvec3 position, fe__core_gap *gap);
fe_dvec3 fe__nearest_on_triangle(const fe_dvec3 vertex[3], fe_dvec3 normal, fe_dvec3 point);
// Nearest points p + u a, |u| <= half, and q + w b, 0 <= w <= length, of two segments; a and b are unit.
void fe__nearest_on_segments(fe_dvec3 p, fe_dvec3 a, double half, fe_dvec3 q, fe_dvec3 b, double length, double *u,
                             double *w);

// The overlap of two cores as boxes: returns how far the other must move out, and gives the unit axis along which. A
// result below -touch says that they are apart, but not how far.
double fe__core_depth(const fe__approach *a, fe_dvec3 *way_out);

typedef struct fe__approach_hit {
    double t;
    fe_dvec3 normal; // unit, from the frame's core to the other
    fe_dvec3 point;  // on the frame's core
} fe__approach_hit;
// Two boxes, or a box and a triangle, apart at the start. 1: they meet, and the stop is at t <= limit.
int32_t fe__boxes_sweep(const fe__approach *a, double limit, fe__approach_hit *hit);
// Returns a point of the frame's form at which the two touch at the start, across the normal.
fe_dvec3 fe__boxes_touching_point(const fe__approach *a, fe_dvec3 normal);

// ---- hulls and forms with a rim ------------------------------------------------------------------------------------
static inline int32_t fe__is_curved_pair(const fe__approach *a)
{
    return a->frame_kind == FE_CORE_CURVED || a->other_kind == FE_CORE_CURVED;
}
// The depth of cores that overlap. Gives the unit way out for the other, and of `gap` only the point on the frame.
double fe__curved_depth(const fe__approach *a, fe_dvec3 *way_out, fe__core_gap *gap);
// Returns a lower bound of the distance of any two cores, whatever rounding made of the nearest points; 0: they
// overlap.
double fe__sure_gap_of(const fe__approach *a, fe_dvec3 position, fe__core_gap *gap);
// How far the planes across `n` (unit, from the frame to the other) hold the cores apart; below 0: they do not
double fe__separation_of(const fe__approach *a, fe_dvec3 position, fe_dvec3 n);
// `start` is the gap at the start.
int32_t fe__curved_sweep(const fe__approach *a, const fe__core_gap *start, double limit, fe__approach_hit *hit);
// The cores are apart up to t = `from`. -1: they are too near there to tell
int32_t fe__curved_sweep_from(const fe__approach *a, double from, double limit, fe__approach_hit *hit);

// The other core's position at t.
static inline fe_dvec3 fe__approach_at(const fe__approach *a, double t)
{
    return fe__dadd(a->position, fe__dscale(t, a->translation));
}

// ---- any pair (sweep.c) --------------------------------------------------------------------------------------------
typedef struct fe__core_overlap {
    double depth; // below 0: apart
    fe_dvec3 way_out;
    fe__core_gap gap; // the gap of round cores that are apart
} fe__core_overlap;

double fe__stop_gap(const fe__mover *mover); // A sweep stops so far before the other form, m.
double fe__touch_of(const fe__mover *mover); // Forms that overlap or are apart by no more touch, m.
fe__core_overlap fe__approach_overlap(const fe__approach *a);
static inline int32_t fe__is_inside(const fe__approach *a, const fe__core_overlap *overlap)
{
    return overlap->depth > a->touch;
}
// Returns a point of the frame's core at which the two cores touch.
fe_dvec3 fe__touching_point(const fe__approach *a, const fe__core_overlap *touch);
// The two are not inside each other at the start (fe__is_inside). 1: they meet, and the stop is at t <= limit.
int32_t fe__approach_sweep(const fe__approach *a, const fe__core_overlap *overlap, double limit, fe__approach_hit *hit);
int32_t fe__core_kind_of(const fe__form *form);
void fe__core_half(const fe__form *form, double half[3]);

// ---- half spaces (sweep.c) -----------------------------------------------------------------------------------------
// The height of the mover's lowest point over the plane at the start, m.
double fe__height_over_plane(const fe__form *plane, const fe__mover *mover);
// The plane's point under the mover's lowest one, or under the middle of several; `unit` is the plane's normal.
fe_dvec3 fe__point_of_plane(const fe__form *plane, fe_dvec3 unit, const fe__mover *mover);

#endif
