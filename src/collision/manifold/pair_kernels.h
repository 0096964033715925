// pair_kernels.h - what the kernels of the pairs share: their signature, their tolerances, and points on segments side
// by side.
//
// Every kernel receives a manifold without points and adds those closer than `margin`. Its source is named in each
// kernel's file.
#ifndef FE_COLLISION_MANIFOLD_PAIR_KERNELS_H
#define FE_COLLISION_MANIFOLD_PAIR_KERNELS_H
#include "collision/manifold/manifold.h"

typedef void fe__kernel(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                        fe__manifold *manifold);

// The general convex path: GJK on the cores, EPA when the cores overlap, faces clipped. Any pair but plane against
// plane.
fe__kernel fe__collide_convex;

fe__kernel fe__collide_sphere_sphere;
fe__kernel fe__collide_capsule_sphere;
fe__kernel fe__collide_capsule_capsule;
fe__kernel fe__collide_box_sphere;
fe__kernel fe__collide_box_capsule;
fe__kernel fe__collide_box_box;
fe__kernel fe__collide_plane_sphere;
fe__kernel fe__collide_plane_capsule;
fe__kernel fe__collide_plane_box;
fe__kernel fe__collide_plane_curved;
fe__kernel fe__collide_plane_hull;
fe__kernel fe__collide_hulls; // a box is one too

// Two answers whose depths differ by less than this are equally right, and the steadier one (more points, the same face
// as before) is given: a tenth of the solver's slop of 5 mm, or 2 % of the smallest width of a small shape, m.
static inline float fe__tie(float width) { return fe__minf(0.0005f, 0.02f * width); }

// cos 5 degrees: a normal this near to a face's is taken for the face's, so that a form lying on it has all its points
#define FE_FACE_COS 0.9962f

// d / length, by division: along an axis the result is exactly 1. Where there is no length there is no direction, and
// symmetry leaves the normal open: x.
static inline fe_vec3 fe__direction(fe_vec3 d, float length)
{
    const float no_length = 1e-15f; // m: its square is still a normal float
    return length > no_length ? fe__vec3(d.x / length, d.y / length, d.z / length) : fe__vec3(1.0f, 0.0f, 0.0f);
}

// should no point be added, the forms are `separation` apart along the unit normal from A to B
static inline void fe__stay_apart(fe__manifold *manifold, float separation, fe_vec3 normal)
{
    manifold->axis_separation = separation;
    manifold->normal = normal;
}

static inline void fe__add_point(fe__manifold *manifold, fe_vec3 point, float separation, uint32_t id)
{
    manifold->points[manifold->count++] = (fe__manifold_point){point, separation, id};
}

// A core from centre - half to centre + half, swelled by a radius; A's frame.
typedef struct fe__segment {
    fe_vec3 centre, half;
    float radius;
} fe__segment;

// What GJK or EPA found, in A's frame.
typedef struct fe__core_touch {
    fe_vec3 normal;     // from A to B
    float separation;   // of the surfaces
    fe_vec3 on_a, on_b; // of the cores
    int32_t overlap;    // of the cores
    int32_t axis;       // of a pair with a rim: the name of the direction, -1: it has none
} fe__core_touch;

// Of a pair with a rim: takes one of the directions that such a pair touches along for the normal, when it is the same
// within a tie, so that what lies still has a normal without the noise of a search, and names it (curved_axis.c). 1: it
// is that of a face.
struct fe__cores;
int32_t fe__sharpen(const struct fe__cores *cores, fe__core_touch *found);
// The direction of that name at the poses of now. `last`: the normal when it was found, A's frame. 0: there is none. Of
// a face, points are not looked for.
int32_t fe__look_again(const struct fe__cores *cores, int32_t axis, fe_vec3 last, fe__core_touch *found);
int32_t fe__axis_is_of_face(int32_t axis);

// Two faces that look at each other, of which one is a disc or both are, one cut by the other (disc.c). `flip`: the
// reference, whose normal is the contact's, is B's. Gives the points below the margin, when the deepest of them says
// the same within a tie as was found; else nothing. Returns their number.
struct fe__face;
int32_t fe__cut_disc(const struct fe__face *reference, const struct fe__face *incident, float radii, int32_t flip,
                     const fe__core_touch *found, float tie, float margin, fe__manifold *manifold);

// Two segments whose nearest points are `separation` apart along `normal` (from a to b), `nearest` midway between the
// surfaces there: gives the two ends of the stretch along which they run side by side, if that says the same as the
// nearest points do; a few degrees askew these and the nearest point; else nothing. Returns the number of points added,
// with ids 1, 2 and 0; the normal is set with them.
int32_t fe__lay_segments(const fe__segment *a, const fe__segment *b, fe_vec3 normal, fe_vec3 nearest, float separation,
                         float margin, fe__manifold *manifold);

// Two faces that are lines (parallel_lines.c): gives the ends of the stretch along which a side or a core of either
// runs with the other's, with ids 1 and 2, and where these are not as deep as the nearest point, that, with id 0. 0:
// they do not.
int32_t fe__lay_lines(const fe__form *a, const fe__form *b, const struct fe__face *face_a,
                      const struct fe__face *face_b, const fe__core_touch *found, fe_vec3 nearest, float tie,
                      float margin, fe__manifold *manifold);

#endif
