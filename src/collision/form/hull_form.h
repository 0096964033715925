// hull_form.h - the form of a shape that has a hull.
#ifndef FE_COLLISION_FORM_HULL_FORM_H
#define FE_COLLISION_FORM_HULL_FORM_H
#include "collision/form/hull.h"
#include "collision/form/support.h"
#include "core/memory.h"

// `index`: of its asset
fe__form fe__hull_form(const fe__hull *hull, int32_t index);
fe_vec3 fe__hull_form_centre(const fe__form *form); // of mass, form's frame
// A point in the middle of any form of its own: a hull's frame may lie anywhere
static inline fe_vec3 fe__form_middle(const fe__form *form)
{
    return fe__form_is_hull(form) ? fe__hull_form_centre(form) : fe__vec3(0.0f, 0.0f, 0.0f);
}

fe_dvec3 fe__hull_form_vertex(const fe__form *form, int32_t vertex); // form's frame
// As fe__form_face, when the vertex is known that lies farthest along the direction
void fe__hull_form_face_at(const fe__form *form, int32_t vertex, fe_vec3 direction, fe__face *face);

// A box that holds the bounds of a form, of a hull wider by some roundings: made sooner
fe__bounds fe__hull_form_rough_bounds(const fe__form *form, const fe__pose *pose);
static inline fe__bounds fe__form_rough_bounds(const fe__form *form, const fe__pose *pose)
{
    return fe__form_is_hull(form) ? fe__hull_form_rough_bounds(form, pose) : fe__form_bounds(form, pose);
}

// In the hull's frame, out->foot too, which is given. Of a face with more corners than FE_FACE_VERTICES some are left
// out, never the farthest along `deepest`, or, while the face lies, the edge over which the load leans.
void fe__hull_polygon(const fe__hull *hull, int32_t face, fe_vec3 deepest, fe__face *out);

// of a point of the form, in the hull's frame
static inline fe_dvec3 fe__in_hull(const fe__form *form, fe_dvec3 point)
{
    return fe__dscale(1.0 / (double)form->scale, fe__dsub(point, fe__widen(form->offset)));
}
static inline fe_dvec3 fe__from_hull(const fe__form *form, fe_dvec3 point)
{
    return fe__dadd(fe__widen(form->offset), fe__dscale((double)form->scale, point));
}

// Asks memory for a form's hull, then, when that is there, for its vertices and planes, and for what says which of them
// are next to each other: of a large hull, whose arrays one look does not read to their ends, a part of each
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
