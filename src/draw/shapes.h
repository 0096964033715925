// shapes.h - the walk over what is drawn: bodies in the order of creation, and the shapes of each.
#ifndef FE_DRAW_SHAPES_H
#define FE_DRAW_SHAPES_H
#include "draw/drawing.h"

// The shapes that a drawing shows, one after another:
//
//   fe__shape_walk walk = fe__shapes_begin(drawing);
//   while (fe__shapes_next(drawing, &walk)) ... walk.shape ...
typedef struct fe__shape_walk {
    int32_t next_body, next_shape;
    uint32_t body_colour;
    // of the shape at hand
    int32_t body, shape;
    uint32_t rgba;
    int32_t is_cut; // 0: it lies in the drawing's box
} fe__shape_walk;

fe__shape_walk fe__shapes_begin(const fe__drawing *drawing);
int32_t fe__shapes_next(fe__drawing *drawing, fe__shape_walk *walk); // 0: no more
fe__drawn fe__shape_surface(const fe__drawing *drawing, const fe__shape_walk *walk);

void fe__draw_shapes(fe__drawing *drawing, fe__pen *pen, void draw(const fe__drawn *surface, fe__pen *pen));

// As many as there are; the first `capacity` of them are written, `size` bytes each
int32_t fe__draw_instances(fe__drawing *drawing, void *out, uint32_t stride, uint32_t size, int32_t capacity);

static inline int32_t fe__is_drawn(const fe__drawing *d, int32_t body) { return d->only < 0 || d->only == body; }
static inline int32_t fe__is_in_box(const fe__drawing *d, fe_dvec3 p)
{
    const fe__bounds *b = &d->box;
    if (!d->has_box) return 1;
    return p.x >= b->low.x && p.x <= b->high.x && p.y >= b->low.y && p.y <= b->high.y && p.z >= b->low.z &&
           p.z <= b->high.z;
}
static inline fe_vec3 fe__in_drawing(const fe__drawing *d, fe_dvec3 p) { return fe__narrow(fe__dsub(p, d->origin)); }

#endif
