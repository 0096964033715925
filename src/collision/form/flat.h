// flat.h - a box or a hull at a pose: questions that decide whether a surface goes on beyond an edge.
//
// The narrow phase (step/narrowphase.c) and the kernels of manifold/ ask them at internal edges, where two shapes or a
// shape and a ground meet flush or nearly so. flat.c has the traits of box, plane and triangle, too.
#ifndef FE_COLLISION_FORM_FLAT_H
#define FE_COLLISION_FORM_FLAT_H
#include "collision/form/form.h"

// The point p of the form's frame is  axes p + centre  in the frame that both surfaces share, the common frame.
typedef struct fe__solid {
    const fe__form *form;
    fe_vec3 centre;
    fe__mat3 axes;
} fe__solid;

static inline int32_t fe__form_is_solid(const fe__form *form)
{
    return fe__form_has_flat_faces(form) || fe__form_is_hull(form);
}

// Faces that lie closer than this are flush, m.
#define FE__FLUSH 0.001f

// Faces of one direction, but for 1.8 degrees, are level when they lie closer than this at a place, m: a body that
// slides from one to the other does not feel the step.
#define FE__LEVEL 0.001f
#define FE__LEVEL_COS 0.9995f

int32_t fe__solid_face_count(const fe__solid *solid);
fe_vec3 fe__solid_normal(const fe__solid *solid, int32_t face); // unit, common frame
// Height of the face's plane over the origin of the common frame, m.
float fe__solid_height(const fe__solid *solid, int32_t face);
// A point inside the form, in the common frame.
fe_vec3 fe__solid_middle(const fe__solid *solid);
// The first face, from number `face` on, over which p lies by at least `least`, m; -1: none. p is in the frame of the
// solid's form.
int32_t fe__solid_face_below(const fe__solid *solid, int32_t face, fe_vec3 p, float least);

// Does the solid hold q, or lie flush with it, and go on from there along the unit vector m?
int32_t fe__solid_goes_on(const fe__solid *solid, fe_vec3 q, fe_vec3 m);
// Does the solid have a face with the normal f that is level with p, and that p lies over or under?
int32_t fe__solid_is_level_at(const fe__solid *solid, fe_vec3 p, fe_vec3 f);
// The point of the solid next to q. q may be outside by rounding, or because the contact normal leans.
fe_vec3 fe__solid_draw_in(const fe__solid *solid, fe_vec3 q);
// q raised along the unit vector m to the height of the solid's farthest point along m, by at most `most`, m.
fe_vec3 fe__solid_raise(const fe__solid *solid, fe_vec3 q, fe_vec3 m, float most);
// A point of the face with the normal m, a little farther from the face's rim than q; q itself if no face has that
// normal. The rim itself lies in every inner corner.
fe_vec3 fe__solid_off_rim(const fe__solid *solid, fe_vec3 q, fe_vec3 m);

#endif
