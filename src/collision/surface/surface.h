// surface.h - the surface of a form as triangles, and its edges as lines.
//
// src/draw calls it for each shape. A kind of form has its functions in surface.c, and its line in the table there.
// Triangles turn left seen from outside. Vertices are computed in double and rounded once, relative to the origin of
// the drawing: a world draws as well a thousand kilometres off.
#ifndef FE_COLLISION_SURFACE_SURFACE_H
#define FE_COLLISION_SURFACE_SURFACE_H
#include "collision/form/ground.h"
#include "core/math.h"

#include <string.h>

// ---- pen ------------------------------------------------------------------------------------------------------------
// The pen writes vertices into the caller's array, whose capacity may be 0. Every vertex counts; those that fit are
// written. So one walk both counts and draws.
typedef struct fe__pen {
    unsigned char *out;      // the caller's array, at any alignment
    uint32_t stride, size;   // bytes from one vertex to the next, and size of a vertex
    int64_t count, capacity; // vertices so far, and vertices that fit
    uint32_t rgba;           // colour of the next vertices
    fe_handle owner;         // owner of the next vertices
} fe__pen;

// 1: the array is full; then the vertices are counted here and need not be computed.
static inline int32_t fe__pen_skips(fe__pen *pen, int64_t vertices)
{
    if (pen->count < pen->capacity) return 0;
    pen->count += vertices;
    return 1;
}

static inline void fe__pen_vertex(fe__pen *pen, fe_vec3 at)
{
    int64_t i = pen->count++;
    if (i >= pen->capacity) return;
    fe_draw_vertex vertex = {at.x, at.y, at.z, pen->rgba, pen->owner};
    unsigned char *out = pen->out + (size_t)pen->stride * (size_t)i;
    if (pen->size == sizeof vertex)
        memcpy(out, &vertex, sizeof vertex); // The compiler knows this size and makes a few moves of it.
    else
        memcpy(out, &vertex, pen->size);
}

static inline void fe__pen_line(fe__pen *pen, fe_vec3 from, fe_vec3 to)
{
    fe__pen_vertex(pen, from);
    fe__pen_vertex(pen, to);
}

static inline void fe__pen_triangle(fe__pen *pen, fe_vec3 a, fe_vec3 b, fe_vec3 c)
{
    fe__pen_vertex(pen, a);
    fe__pen_vertex(pen, b);
    fe__pen_vertex(pen, c);
}

// Draws the 12 edges of an axis-aligned box.
void fe__pen_box(fe__pen *pen, fe_vec3 low, fe_vec3 high);

// ---- surface --------------------------------------------------------------------------------------------------------
enum {
    FE__LEAST_SEGMENTS = 3,
    FE__SEGMENTS = 128,              // A circle has at most so many segments,
    FE__ARC_STEPS = FE__SEGMENTS / 4 // a quarter circle at most so many.
};
// A plane is drawn so far from its point nearest to the origin of the drawing, m.
#define FE__PLANE_REACH 100.0

// Points of the unit circle, and of a quarter of it for profiles. All round forms of a drawing share them.
typedef struct fe__circle {
    int32_t segments, steps;
    double cosine[FE__SEGMENTS + 1], sine[FE__SEGMENTS + 1];           // the last point is the first
    double arc_cosine[FE__ARC_STEPS + 1], arc_sine[FE__ARC_STEPS + 1]; // from 0 to a right angle
} fe__circle;
void fe__circle_make(fe__circle *circle, int32_t segments);

// A form in a drawing.
typedef struct fe__drawn {
    const fe__form *form;
    fe__pose pose;
    fe__ground ground; // the heightfield or mesh of the form; other forms leave it empty
    const fe__circle *circle;
    fe_dvec3 origin;       // origin of the drawing, m, world space
    const fe__bounds *box; // the part of the world that is drawn, m, world space
    int32_t is_cut;        // 0: the form lies in the box
    // A point p of the form's frame is drawn at  at + x p.x + y p.y + z p.z.
    fe_dvec3 at, x, y, z;
} fe__drawn;

// Fills at, x, y, z from form, pose and origin.
void fe__surface_place(fe__drawn *s);
void fe__surface_triangles(const fe__drawn *s, fe__pen *pen);
void fe__surface_lines(const fe__drawn *s, fe__pen *pen);

// A unit form is turned and stretched to the drawn one. half_extents are those of fe_draw_instance; a form with an
// asset has 1 each.
typedef struct fe__stance {
    fe_vec3 position; // in the drawing, m
    fe_quat rotation;
    fe_vec3 half_extents;
} fe__stance;
fe_vec3 fe__surface_half_extents(const fe__form *form);
// The stance of the piece of a plane that is drawn; 0: nothing of the plane is in the box
int32_t fe__plane_stance(const fe__drawn *s, fe__stance *out_stance);

static inline fe_vec3 fe__surface_point(const fe__drawn *s, fe_dvec3 p)
{
    return fe__vec3((float)(s->at.x + (s->x.x * p.x + s->y.x * p.y + s->z.x * p.z)),
                    (float)(s->at.y + (s->x.y * p.x + s->y.y * p.y + s->z.y * p.z)),
                    (float)(s->at.z + (s->x.z * p.x + s->y.z * p.y + s->z.z * p.z)));
}

#endif
