// parallel_lines.c - two lines along each other: the side of a cone or a cylinder, the core of a capsule.
//
// Called by convex.c for what no face lies along. A contact there at the nearest points alone runs from end to end of
// such lines with the least turn, and what lies so rocks for ever. The ends of the stretch that the two have in common
// hold them. Across its line a side is round: with the offset e of the lines there, the radii r, and n . d between the
// lines, the surfaces are  n . d + e^2 / (2 (rA + rB))  apart, to second order.
#include "collision/form/form.h"
#include "collision/manifold/pair_kernels.h"

// A line of a form's surface, in A's frame
typedef struct line {
    fe_vec3 start, way; // from one end to the other
    float radius[2];    // across it, at either end: a cone's vanishes at its tip
} line;

static line line_of(const fe__form *form, const fe__face *side, fe_vec3 direction)
{
    float roundness = fe__form_roundness(form);
    line l = {.start = fe__add_scaled(side->vertex[0], form->radius, direction),
              .way = fe__sub(side->vertex[1], side->vertex[0]),
              .radius = {roundness, roundness}};
    if (form->type == FE__FORM_CONE) { // from the rim along the side's normal to the axis: r / cos a, tan a = r / 2h
        float r = form->half.x, h = 2.0f * form->half.y;
        l.radius[0] = r * sqrtf(r * r + h * h) / h, l.radius[1] = 0.0f;
    }
    return l;
}

// The stretch that two lines have in common: numbers of B's are linear in the share s of the way along A's.
typedef struct stretch {
    float from, to;     // of s
    float start, scale; // of B's line: t = (s - start) scale
    float aside, slope; // e = aside + slope s, along n x way
    fe_vec3 across;     // unit
} stretch;

// Keeps the part of the stretch where  at + rate s >= 0
static void keep(stretch *part, float at, float rate)
{
    if (rate > 0.0f)
        part->from = fe__maxf(part->from, -at / rate);
    else if (rate < 0.0f)
        part->to = fe__minf(part->to, -at / rate);
    else if (at < 0.0f)
        part->to = part->from;
}

static float radius_at(const line *l, float share) { return l->radius[0] + share * (l->radius[1] - l->radius[0]); }

// 0: they do not run along each other. Beyond 10 degrees about either side the normal is another.
static int32_t find_stretch(const line *a, const line *b, fe_vec3 n, stretch *part)
{
    const float most_askew = 0.75f, aside = 0.176f; // cos^2 30 degrees; tan 10 degrees
    float aa = fe__dot(a->way, a->way), bb = fe__dot(b->way, b->way), ab = fe__dot(a->way, b->way);
    if (!(ab * ab > most_askew * aa * bb)) return 0;
    fe_vec3 between = fe__sub(b->start, a->start), across = fe__cross(n, a->way);
    float length = fe__length(across), start = fe__dot(a->way, between) / aa, end = start + ab / aa;
    if (!(length > 0.0f)) return 0;
    across = fe__scale(1.0f / length, across);
    *part = (stretch){.from = fe__clampf(fe__minf(start, end), 0.0f, 1.0f),
                      .to = fe__clampf(fe__maxf(start, end), 0.0f, 1.0f),
                      .start = start,
                      .scale = aa / ab,
                      .across = across};
    part->slope = fe__dot(across, b->way) * part->scale;
    part->aside = fe__dot(across, between) - part->slope * start;
    float radius = a->radius[0] + radius_at(b, -start * part->scale),
          growth = a->radius[1] - a->radius[0] + part->scale * (b->radius[1] - b->radius[0]);
    keep(part, aside * radius - part->aside, aside * growth - part->slope);
    keep(part, aside * radius + part->aside, aside * growth + part->slope);
    return 1;
}

static void add_end(const line *a, const line *b, const stretch *part, float s, fe_vec3 n, float margin, uint32_t id,
                    fe__manifold *manifold)
{
    float t = (s - part->start) * part->scale, e = part->aside + part->slope * s, ra = radius_at(a, s),
          radii = ra + radius_at(b, t);
    fe_vec3 on_a = fe__add_scaled(a->start, s, a->way), on_b = fe__add_scaled(b->start, t, b->way);
    float share = radii > 0.0f ? 1.0f / radii : 0.0f,
          separation = fe__dot(n, fe__sub(on_b, on_a)) + 0.5f * e * e * share;
    if (separation > margin) return;
    fe_vec3 point = fe__add_scaled(on_a, e * ra * share, part->across);
    fe__add_point(manifold, fe__add_scaled(point, 0.5f * separation, n), separation, id);
}

int32_t fe__lay_lines(const fe__form *a, const fe__form *b, const fe__face *face_a, const fe__face *face_b,
                      const fe__core_touch *found, fe_vec3 nearest, float tie, float margin, fe__manifold *manifold)
{
    enum { START = 1, END = 2, NEAREST = 0 };
    const float short_stretch = 0.01f; // of the line: two points nearer than that hold no better than one
    fe_vec3 n = found->normal;
    line la = line_of(a, face_a, n), lb = line_of(b, face_b, fe__neg(n));
    stretch part;
    if (!find_stretch(&la, &lb, n, &part) || !(part.to - part.from > short_stretch)) return 0;
    add_end(&la, &lb, &part, part.from, n, margin, START, manifold);
    add_end(&la, &lb, &part, part.to, n, margin, END, manifold);
    float deepest = INFINITY;
    for (int32_t i = 0; i < manifold->count; ++i) deepest = fe__minf(deepest, manifold->points[i].separation);
    if (deepest > found->separation + tie) fe__add_point(manifold, nearest, found->separation, NEAREST);
    manifold->normal = n;
    return manifold->count;
}
