// flat.h - a box or a hull that stands somewhere: what goes on where another surface ends.
#ifndef FE_COLLISION_FORM_FLAT_H
#define FE_COLLISION_FORM_FLAT_H
#include "collision/form/form.h"

// p in its form's frame is  axes p + centre  in the common one
typedef struct fe__solid {
    const fe__form *form;
    fe_vec3 centre;
    fe__mat3 axes;
} fe__solid;

static inline int32_t fe__form_is_solid(const fe__form *form)
{
    return fe__form_has_flat_faces(form) || fe__form_is_hull(form);
}

// Faces that lie closer than this are flush, m
#define FE__FLUSH 0.001f

// Faces of one direction, but for 1.8 degrees, are level when they lie closer than this at a place, m: what slides from
// one to the other does not feel the step
#define FE__LEVEL 0.001f
#define FE__LEVEL_COS 0.9995f

int32_t fe__solid_face_count(const fe__solid *solid);
fe_vec3 fe__solid_normal(const fe__solid *solid, int32_t face); // unit
float fe__solid_height(const fe__solid *solid, int32_t face);   // of its plane over the common origin, m
fe_vec3 fe__solid_middle(const fe__solid *solid);               // a point within any form, in the common frame
// Of the faces from number `face` on the first that p lies over by at least `least`, m; -1: none. p is in the frame of
// the solid's form
int32_t fe__solid_face_below(const fe__solid *solid, int32_t face, fe_vec3 p, float least);

// Does it hold q, or lie flush with it, and go on from there along the unit m?
int32_t fe__solid_goes_on(const fe__solid *solid, fe_vec3 q, fe_vec3 m);
// Has it a face with the normal f that is level with p, and that p lies over or under?
int32_t fe__solid_is_level_at(const fe__solid *solid, fe_vec3 p, fe_vec3 f);
// The point of the solid next to q, of which it may be off by roundings or by a lean of the normal.
fe_vec3 fe__solid_draw_in(const fe__solid *solid, fe_vec3 q);
// q raised along the unit m towards what of the solid is farthest along m, by at most `most`, m
fe_vec3 fe__solid_raise(const fe__solid *solid, fe_vec3 q, fe_vec3 m, float most);
// A point of the face whose normal m is, a little farther from the face's rim than q; q when m is no face's normal.
// The rim itself lies in every inner corner.
fe_vec3 fe__solid_off_rim(const fe__solid *solid, fe_vec3 q, fe_vec3 m);

#endif
