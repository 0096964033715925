// round.c - surfaces of revolution about the y axis: balls, capsules, cylinders, cones.
//
// A profile of points (radius, y), from the bottom to the top, turns around the axis. Between two of its points lies a
// band; where one is on the axis, the band is a fan.
#include "collision/surface/kinds.h"

enum { PROFILE = 2 * FE__ARC_STEPS + 2 };

typedef struct profile {
    int32_t count;
    double radius[PROFILE], y[PROFILE];
    int32_t rings[2]; // points whose circle is an edge
} profile;

static void add(profile *p, double radius, double y)
{
    p->radius[p->count] = radius, p->y[p->count] = y;
    ++p->count;
}

// Two half circles around the ends of the axis; of a sphere the two ends, and the two circles there, are one
static profile ball_profile(const fe__drawn *s)
{
    profile p = {.count = 0};
    const fe__circle *c = s->circle;
    double r = (double)s->form->radius, h = (double)s->form->half_height;
    for (int32_t i = c->steps; i >= 0; --i) add(&p, r * c->arc_cosine[i], -r * c->arc_sine[i] - h);
    p.rings[0] = p.rings[1] = c->steps;
    if (h > 0.0) p.rings[1] = c->steps + 1;
    for (int32_t i = h > 0.0 ? 0 : 1; i <= c->steps; ++i) add(&p, r * c->arc_cosine[i], r * c->arc_sine[i] + h);
    return p;
}

static profile cylinder_profile(const fe__drawn *s)
{
    double r = (double)s->form->half.x, h = (double)s->form->half.y;
    return (profile){4, {0.0, r, r, 0.0}, {-h, -h, h, h}, {1, 2}};
}

static profile cone_profile(const fe__drawn *s)
{
    double r = (double)s->form->half.x, h = (double)s->form->half.y;
    return (profile){3, {0.0, r, 0.0}, {-h, -h, h}, {1, 1}};
}

static fe_vec3 point_of(const fe__drawn *s, const profile *p, int32_t i, double cosine, double sine)
{
    return fe__surface_point(s, (fe_dvec3){p->radius[i] * cosine, p->y[i], p->radius[i] * sine});
}

// A quarter turn from x is z, which is clockwise about y: outside, upwards comes before onwards
static void draw_band(const fe__drawn *s, const profile *p, int32_t i, fe__pen *pen)
{
    const fe__circle *c = s->circle;
    int32_t below = p->radius[i] > 0.0, above = p->radius[i + 1] > 0.0;
    fe_vec3 a = point_of(s, p, i, 1.0, 0.0), b = point_of(s, p, i + 1, 1.0, 0.0);
    for (int32_t k = 1; k <= c->segments; ++k) {
        fe_vec3 next_a = below ? point_of(s, p, i, c->cosine[k], c->sine[k]) : a;
        fe_vec3 next_b = above ? point_of(s, p, i + 1, c->cosine[k], c->sine[k]) : b;
        if (above) fe__pen_triangle(pen, a, b, next_b);
        if (below) fe__pen_triangle(pen, a, next_b, next_a);
        a = next_a, b = next_b;
    }
}

static profile profile_of(const fe__drawn *s)
{
    switch (s->form->type) {
    case FE__FORM_CYLINDER:
        return cylinder_profile(s);
    case FE__FORM_CONE:
        return cone_profile(s);
    default:
        return ball_profile(s);
    }
}

void fe__draw_round(const fe__drawn *s, fe__pen *pen)
{
    const profile p = profile_of(s);
    // both ends are on the axis: all bands but two have two triangles a segment
    if (fe__pen_skips(pen, 3 * (int64_t)s->circle->segments * (2 * (p.count - 1) - 2))) return;
    for (int32_t i = 0; i + 1 < p.count; ++i) draw_band(s, &p, i, pen);
}

// The circles, and the profile on four sides
void fe__draw_round_lines(const fe__drawn *s, fe__pen *pen)
{
    static const double cosine[4] = {1.0, 0.0, -1.0, 0.0}, sine[4] = {0.0, 1.0, 0.0, -1.0};
    const fe__circle *c = s->circle;
    const profile p = profile_of(s);
    int32_t rings = p.rings[1] == p.rings[0] ? 1 : 2;
    if (fe__pen_skips(pen, 2 * ((int64_t)c->segments * rings + 4 * (p.count - 1)))) return;
    for (int32_t ring = 0; ring < rings; ++ring)
        for (int32_t k = 0; k < c->segments; ++k)
            fe__pen_line(pen, point_of(s, &p, p.rings[ring], c->cosine[k], c->sine[k]),
                         point_of(s, &p, p.rings[ring], c->cosine[k + 1], c->sine[k + 1]));
    for (int32_t side = 0; side < 4; ++side)
        for (int32_t i = 0; i + 1 < p.count; ++i)
            fe__pen_line(pen, point_of(s, &p, i, cosine[side], sine[side]),
                         point_of(s, &p, i + 1, cosine[side], sine[side]));
}
