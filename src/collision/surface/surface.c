// surface.c - see surface.h.
#include "collision/surface/surface.h"

#include "core/trig.h"

void fe__circle_make(fe__circle *c, int32_t segments)
{
    const double whole = 6.283185307179586, quarter = 0.25 * whole;
    c->segments = segments, c->steps = fe__maxi(1, segments / 4);
    for (int32_t i = 0; i < segments; ++i) fe__sincos(whole * (double)i / (double)segments, c->sine + i, c->cosine + i);
    c->sine[segments] = c->sine[0], c->cosine[segments] = c->cosine[0];
    for (int32_t i = 0; i <= c->steps; ++i)
        fe__sincos(quarter * (double)i / (double)c->steps, c->arc_sine + i, c->arc_cosine + i);
    c->arc_cosine[c->steps] = 0.0; // poles are points
}

void fe__surface_place(fe__drawn *s)
{
    s->at = fe__dsub(s->pose.position, s->origin);
    s->x = fe__drotate(s->pose.rotation, (fe_dvec3){1.0, 0.0, 0.0});
    s->y = fe__drotate(s->pose.rotation, (fe_dvec3){0.0, 1.0, 0.0});
    s->z = fe__drotate(s->pose.rotation, (fe_dvec3){0.0, 0.0, 1.0});
}

void fe__pen_box(fe__pen *pen, fe_vec3 low, fe_vec3 high)
{
    enum { EDGES = 12 };
    if (fe__pen_skips(pen, 2 * EDGES)) return;
    const float x[2] = {low.x, high.x}, y[2] = {low.y, high.y}, z[2] = {low.z, high.z};
    for (int32_t i = 0; i < 4; ++i) {
        int32_t a = i & 1, b = i >> 1;
        fe__pen_line(pen, fe__vec3(x[0], y[a], z[b]), fe__vec3(x[1], y[a], z[b]));
        fe__pen_line(pen, fe__vec3(x[a], y[0], z[b]), fe__vec3(x[a], y[1], z[b]));
        fe__pen_line(pen, fe__vec3(x[a], y[b], z[0]), fe__vec3(x[a], y[b], z[1]));
    }
}
