// load_line.h - the line along which a resting body bears on the body below it, and its foot on a plane.
//
// The narrow phase computes it (step/load.c). If a face has more corners than a manifold has points, the kernels keep
// the corners that the load leans over: a body tips over the edge of its face, not over an edge of the points that are
// kept.
#ifndef FE_COLLISION_FORM_LOAD_LINE_H
#define FE_COLLISION_FORM_LOAD_LINE_H
#include "collision/form/clip.h"

// The line passes through `at` along `along`, of any length; (0, 0, 0): no load is known
typedef struct fe__load {
    fe_vec3 at, along;
    fe__choice last; // ids of the manifold's points
} fe__load;

// A kernel asks for the load only when there are points to choose from: the line takes a hundred operations, and mostly
// nothing is to be chosen.
typedef struct fe__load_asked {
    fe__load (*tell)(const struct fe__load_asked *asked);
} fe__load_asked;

static inline fe__load fe__tell_load(const fe__load_asked *asked)
{
    return asked ? asked->tell(asked) : (fe__load){.last = {.count = 0}};
}

// Finds the point where the line meets the plane through `origin` with the unit normal n. 0: it does so nowhere near,
// or no load is known
static inline int32_t fe__find_foot(const fe__load *load, fe_vec3 origin, fe_vec3 n, fe_vec3 *foot)
{
    const float steepest = 0.1f; // cosine of the load's angle with the normal
    float down = fe__dot(load->along, n);
    if (!(down * down > steepest * steepest * fe__dot(load->along, load->along))) return 0;
    *foot = fe__add_scaled(load->at, fe__dot(n, fe__sub(origin, load->at)) / down, load->along);
    return 1;
}

// The same in the plane's frame; u and v are unit vectors.
static inline fe__foot fe__foot_in_plane(const fe__load *load, fe_vec3 origin, fe_vec3 u, fe_vec3 v, fe_vec3 n)
{
    fe_vec3 foot;
    if (!fe__find_foot(load, origin, n, &foot)) return (fe__foot){.is_known = 0};
    fe_vec3 away = fe__sub(foot, origin);
    return (fe__foot){.is_known = 1, .u = fe__dot(u, away), .v = fe__dot(v, away), .last = load->last};
}

// Some bits of an id name the two faces, the others name a vertex within them. If the last choice was made of these
// faces, its ids become the names of the vertices; a choice of other faces is dropped.
static inline void fe__names_of_vertices(fe__choice *last, uint32_t of_faces, uint32_t faces, uint32_t names[4])
{
    for (int32_t i = 0; i < last->count; ++i) {
        if ((last->ids[i] & of_faces) != faces) {
            last->count = 0;
            return;
        }
        names[i] = last->ids[i] & ~of_faces;
    }
    last->ids = names;
}

// The load in a frame with its origin at `origin` and these axes.
static inline fe__load fe__load_in_frame(const fe__load *load, fe_vec3 origin, const fe__mat3 *axes)
{
    return (fe__load){fe__mul_transposed(axes, fe__sub(load->at, origin)), fe__mul_transposed(axes, load->along),
                      load->last};
}

#endif
