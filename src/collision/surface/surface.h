// surface.h - what a form looks like: its surface as triangles, its edges as lines.
//
// src/draw calls this for each shape. A kind of form has a file here that draws it, and its line in surface.c.
// Triangles turn left seen from outside. Vertices are computed in double and rounded once, relative to the origin of
// the drawing: a world draws as well a thousand kilometres off.
#ifndef FE_COLLISION_SURFACE_SURFACE_H
#define FE_COLLISION_SURFACE_SURFACE_H
#include "collision/form/ground.h"
#include "core/math.h"

#include <string.h>

// ---- pen ------------------------------------------------------------------------------------------------------------
// Where a drawing's vertices go: the caller's array, of which there may be none.
//
// Every vertex counts; those that the array has room for are written. So one walk both counts and draws.

typedef struct fe__pen {
    unsigned char *out;      // the caller's, at any alignment
    uint32_t stride, size;   // bytes from one vertex to the next, and of it
    int64_t count, capacity; // vertices: so far, and as many as are written
    uint32_t rgba;           // of what comes next
    fe_handle owner;         // likewise
} fe__pen;

// Is the array full? Then `vertices` are only counted, and nobody need know where they are
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
        memcpy(out, &vertex, sizeof vertex); // of a size that the compiler knows: a few moves
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

// The 12 edges of an axis-aligned box
void fe__pen_box(fe__pen *pen, fe_vec3 low, fe_vec3 high);

// ---- surface --------------------------------------------------------------------------------------------------------

enum {
    FE__LEAST_SEGMENTS = 3,
    FE__SEGMENTS = 128,              // of a circle, at most
    FE__ARC_STEPS = FE__SEGMENTS / 4 // of a quarter of it
};
// How far a plane is drawn, m from the point of it that is nearest to the origin of the drawing
#define FE__PLANE_REACH 100.0

// Points of the unit circle, and of a quarter of it for profiles: the same for all round forms of a drawing
typedef struct fe__circle {
    int32_t segments, steps;
    double cosine[FE__SEGMENTS + 1], sine[FE__SEGMENTS + 1];           // the last is the first
    double arc_cosine[FE__ARC_STEPS + 1], arc_sine[FE__ARC_STEPS + 1]; // from 0 to a right angle
} fe__circle;
void fe__circle_make(fe__circle *circle, int32_t segments);

// A form that is drawn, and how
typedef struct fe__drawn {
    const fe__form *form;
    fe__pose pose;
    fe__ground ground; // of a field; else nothing
    const fe__circle *circle;
    fe_dvec3 origin;       // of the drawing, m, world space
    const fe__bounds *box; // of what is to be drawn, m, world space
    int32_t is_cut;        // 0: the form lies in the box
    // from the form's frame to the drawing: at + x p.x + y p.y + z p.z
    fe_dvec3 at, x, y, z;
} fe__drawn;

// Fills the last four, once form, pose and origin are there
void fe__surface_place(fe__drawn *s);
void fe__surface_triangles(const fe__drawn *s, fe__pen *pen);
void fe__surface_lines(const fe__drawn *s, fe__pen *pen);

// A unit form turned and stretched to this one. half_extents: see fe_draw_instance; an asset's are 1 each
typedef struct fe__stance {
    fe_vec3 position; // in the drawing, m
    fe_quat rotation;
    fe_vec3 half_extents;
} fe__stance;
fe_vec3 fe__surface_half_extents(const fe__form *form);
// Of a plane, of which there is a piece; 0: nothing of it is in the box
int32_t fe__plane_stance(const fe__drawn *s, fe__stance *out_stance);

static inline fe_vec3 fe__surface_point(const fe__drawn *s, fe_dvec3 p)
{
    return fe__vec3((float)(s->at.x + (s->x.x * p.x + s->y.x * p.y + s->z.x * p.z)),
                    (float)(s->at.y + (s->x.y * p.x + s->y.y * p.y + s->z.y * p.z)),
                    (float)(s->at.z + (s->x.z * p.x + s->y.z * p.y + s->z.z * p.z)));
}

#endif
