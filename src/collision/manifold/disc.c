// disc.c - the cap of a cylinder or the base of a cone, and a face: what they have in common, cut by the circle itself.
//
// Called by convex.c with the faces of two forms that look at each other. All is reckoned in the plane of the disc,
// onto which the other's vertices are brought along the reference's normal, so that the disc keeps being round.
#include "collision/form/clip.h"
#include "collision/form/form.h"
#include "collision/manifold/pair_kernels.h"

#include <float.h>

// u leads to the first of the face's points at the rim, n out of the form
typedef struct disc_frame {
    fe_vec3 centre, u, v, n;
} disc_frame;

static disc_frame frame_of(const fe__face *disc)
{
    fe_vec3 half = fe__scale(0.5f, fe__sub(disc->vertex[0], disc->vertex[FE_RIM_POINTS / 2]));
    fe_vec3 u = fe__scale(1.0f / disc->rim, half);
    return (disc_frame){fe__sub(disc->vertex[0], half), u, fe__cross(disc->normal, u), disc->normal};
}

// Brings the other's vertices onto the disc along n, unit, which is the normal of one of them: their heights are how
// far they were brought.
static void project(const disc_frame *f, const fe__face *other, fe_vec3 n, fe__clip_vertex *out)
{
    float per_length = 1.0f / fe__dot(n, f->n);
    for (int32_t i = 0; i < other->count; ++i) {
        fe_vec3 d = fe__sub(other->vertex[i], f->centre);
        float height = per_length * fe__dot(d, f->n);
        fe_vec3 p = fe__add_scaled(d, -height, n);
        uint32_t id = fe__clip_id(i > 0 ? i - 1 : other->count - 1, i);
        out[i] = (fe__clip_vertex){fe__dot(p, f->u), fe__dot(p, f->v), height, id};
    }
}

// The other's plane over that of the disc, along n: the h with ((c + u U + v V + h n) - p) . m = 0, m its normal
static fe__disc disc_over(const disc_frame *f, const fe__face *disc, const fe__face *other, fe_vec3 n)
{
    fe__disc d = {.radius = disc->rim, .low = disc->low, .pattern = disc->pattern};
    if (other->count < 3) return d;
    fe_vec3 m = fe__scale(-1.0f / fe__dot(n, other->normal), other->normal);
    d.height = fe__dot(fe__sub(f->centre, other->vertex[0]), m);
    d.slope_u = fe__dot(f->u, m), d.slope_v = fe__dot(f->v, m);
    return d;
}

static float lowest(const fe__clip_vertex *vertex, int32_t count)
{
    float low = FLT_MAX;
    for (int32_t i = 0; i < count; ++i) low = fe__minf(low, vertex[i].height);
    return low;
}

// Of the incident face, all of it
static float lowest_of_all(const fe__disc *disc, int32_t is_incident, const fe__clip_vertex *vertex, int32_t count)
{
    if (!is_incident) return lowest(vertex, count);
    return disc->height - disc->radius * sqrtf(disc->slope_u * disc->slope_u + disc->slope_v * disc->slope_v);
}

enum { NO_RIM = -1 };

// How the points stand on the rim that has some among the vertices
static int32_t pattern_of(const fe__face *disc, const fe__face *other, const fe__clip_vertex *vertex, int32_t count)
{
    if (other->rim > 0.0f && other->rim < disc->rim) return other->pattern;
    for (int32_t i = 0; i < count; ++i)
        if ((vertex[i].id & 0xff) >= FE_CLIP_SIDE && vertex[i].id >> 8 >= FE_CLIP_SIDE) return disc->pattern;
    return NO_RIM;
}

// Does all that two faces have in common lie below? Then what hangs over the rim is only deeper as far as it leans, and
// the rim alone would hold what the rest bears.
static int32_t is_sunk(const fe__clip_vertex *vertices, int32_t count, float radii)
{
    for (int32_t i = 0; i < count; ++i)
        if (vertices[i].height > radii) return 0;
    return count > 1;
}

// Where the cores overlap, what hangs over the reference's rim has to come out too.
int32_t fe__cut_disc(const fe__face *reference, const fe__face *incident, float radii, int32_t flip,
                     const fe__core_touch *found, float tie, float margin, fe__manifold *manifold)
{
    int32_t is_incident = !(reference->rim > 0.0f && !(incident->rim > reference->rim)); // the disc is
    const fe__face *disc = is_incident ? incident : reference, *other = is_incident ? reference : incident;
    disc_frame frame = frame_of(disc);
    // from the disc to the other
    fe_vec3 n = is_incident ? fe__neg(reference->normal) : reference->normal;
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_DISC_VERTICES];
    project(&frame, other, n, side);
    fe__disc d = disc_over(&frame, disc, other, n);
    float rounding = 1e-6f * (disc->rim + fe__length(fe__sub(other->vertex[0], frame.centre)));
    float least = found->separation - tie - rounding, most = found->separation + tie + rounding;
    int32_t count = fe__clip_disc(&d, side, other->count, 0.1f * tie + rounding, margin + radii, vertex);
    if (found->overlap && lowest_of_all(&d, is_incident, side, other->count) - radii < least &&
        !is_sunk(vertex, count, radii))
        return 0;
    float deepest = lowest(vertex, count) - radii;
    if (deepest < least || deepest > fe__minf(most, margin)) return 0;
    fe__foot foot = {.is_known = 0};
    int32_t pattern = pattern_of(disc, other, vertex, count), is_whole = count == 4 && disc->pattern == FE_RIM_AIMED;
    if (count > 4 && pattern != FE_RIM_LEANS) {
        const fe__load load = fe__tell_load(manifold->load);
        foot = fe__foot_in_plane(&load, frame.centre, frame.u, frame.v, frame.n);
    }
    foot.is_aimed = pattern == FE_RIM_AIMED; // its points are new each time
    // whichever is the reference: a wide disc that leans gives way to the other, and its points stay what they are
    uint32_t of_a = (flip ? incident : reference)->id & 0x7f, of_b = (flip ? reference : incident)->id & 0xff;
    uint32_t faces = of_a << 24 | of_b << 16, last[4];
    if (foot.is_aimed)
        foot.last.count = 0;
    else
        fe__names_of_vertices(&foot.last, ~(uint32_t)0xffff, faces, last);
    int32_t near = fe__keep_near(vertex, count, radii, margin, 0.1f * tie, &foot, &manifold->left_out);
    if (pattern == FE_RIM_LEANS || near < 3)
        manifold->left_out = FE_LEFT_NONE;
    else if (is_whole || (pattern == FE_RIM_AIMED && manifold->left_out == FE_LEFT_SIDES))
        manifold->left_out = FE_LEFT_REST;
    else if (count == 4 && pattern == FE_RIM_LIES)
        manifold->left_out = FE_LEFT_SOME;
    manifold->normal = flip ? fe__neg(reference->normal) : reference->normal;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__add_scaled(fe__add_scaled(frame.centre, vertex[i].u, frame.u), vertex[i].v, frame.v);
        fe__add_point(manifold, fe__add_scaled(p, 0.5f * vertex[i].height, n), vertex[i].height, faces | vertex[i].id);
    }
    return near;
}
