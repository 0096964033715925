// pen.h - where a drawing's vertices go: the caller's array, of which there may be none.
//
// Every vertex counts; those that the array has room for are written. So one walk both counts and draws.
#ifndef FE_COLLISION_SURFACE_PEN_H
#define FE_COLLISION_SURFACE_PEN_H
#include "core/math.h"

#include <string.h>

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

#endif
