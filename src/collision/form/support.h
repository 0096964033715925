// support.h - what the general convex path knows of a form: the core's farthest point in a direction, and the face that
// looks that way.
//
// With both a form is complete for GJK, EPA and the manifold. The swelling radius stays outside: it is added to the
// distance of the cores.
#ifndef FE_COLLISION_FORM_SUPPORT_H
#define FE_COLLISION_FORM_SUPPORT_H
#include "collision/form/clip.h"
#include "collision/form/form.h"

#include <stddef.h>

// The point of the core farthest along `direction` (any length), form's frame. Of equally far points always the same.
static inline fe_dvec3 fe__form_support(const fe__form *form, fe_dvec3 direction)
{
    return fe__traits_of(form)->support(form, direction);
}

// A face of the core: polygon (turning left around the normal), segment or point, form's frame.
typedef struct fe__face {
    int32_t count;  // > 2 polygon, 2 segment, 1 point
    fe_vec3 normal; // unit; of a polygon only
    fe_vec3 vertex[FE_FACE_VERTICES];
    uint32_t id;     // of the face within the form
    float rim;       // a disc's radius, of whose rim the vertices are some points; else 0
    int32_t low;     // of a disc: the vertex farthest along the direction asked for, or 0 where that is across the disc
    int32_t pattern; // of a disc: FE_RIM_*
    const fe_vec3 *foot; // given: where the load on the face presses, form's frame; NULL: nobody knows
} fe__face;

// Of more corners than a face gives, those over which the load leans are among them
static inline void fe__form_face_under(const fe__form *form, fe_vec3 direction, const fe_vec3 *foot, fe__face *face)
{
    face->rim = 0.0f, face->pattern = FE_RIM_LEANS;
    face->foot = foot;
    fe__traits_of(form)->face(form, direction, face);
}

static inline void fe__form_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    fe__form_face_under(form, direction, NULL, face);
}

#endif
