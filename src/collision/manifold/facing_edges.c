// facing_edges.c - two hulls that touch along edges which run side by side, as the boards of an A-frame do.
//
// Part of hull_hull.c and box_box.c. Of such edges the separating axes know nothing: their cross product is noise, and
// while they overlap some face always says less depth. The normal between them is that of a rounded corner instead. In
// the plane across the edges, all places of B against A that overlap are a polygon (the Minkowski difference of the
// sections), and edges side by side are one of its corners: between the normals first and last of its two sides, which
// are those that the cones of normals of both edges have in common. The corner is thought to be farther in by R along
// both, and n is the direction from there to where B is, if it lies between first and last. So n turns from one face's
// normal to the other's, and where it leaves them, a face meets an edge or a face and is right.
//
// All is in the plane across A's edge, z the coordinate along it. B's edge is askew by a few degrees at most:
// d(z) = dB + slope z, the vector from A's edge to B's.
#define FE_W 4
#include "collision/manifold/facing_edges.h"

#include "collision/manifold/pair_kernels.h"
#include "core/simd.h"

#include <math.h>
#include <string.h>

// R is k times r, the depth along the best axis, so that the inner corner is apart and n . d no deeper than
// k / cos(h) - (k - 1) times r, h half the angle between first and last. As one edge shifts along the other hull, n
// turns and pushes it further that way; friction holds it while n turns by less. So n shall turn slowly: k is SLOWEST,
// or what makes n . d deeper than r by DEEPER times r, and 2 or more. r is at least half a millimetre, about which the
// edges may pass each other by, and at most the solver's slop, m; and shares of the smallest inner radius. Deeper hulls
// leave by a face.
#define SLOWEST 8.0f
#define DEEPER 0.83f
#define CORE_LEAST_SHARE 0.25f
#define CORE_MOST 0.005f
#define CORE_MOST_SHARE 0.5f
// 2 cos^2 h for h of 60 degrees: a blunter corner of the polygon, between two sharp wedges, is rounded no farther in
#define BLUNTEST 0.5f
// Edges of a hull that may touch so. An axis has few, but for the rim of a face of many sides
#define EDGES_MOST 32

typedef struct edge {
    fe_vec3 middle, along; // A's frame; along: to the second end, half its length
    fe_vec3 first, last;   // the ends of the cone of normals from A to B; it turns about `along`
} edge;

// across A's edge: first, and at a right angle to it
typedef struct flat {
    float x, y;
} flat;

static float cross(flat a, flat b) { return a.x * b.y - a.y * b.x; }
static float dot(flat a, flat b) { return a.x * b.x + a.y * b.y; }

static flat unit(flat a)
{
    float k = 1.0f / sqrtf(dot(a, a));
    return (flat){k * a.x, k * a.y};
}

// ---- the edges that may touch --------------------------------------------------------------------------------------
typedef struct lanes {
    wide x, y, z;
} lanes;

static inline lanes lanes_at(const fe__hull_lanes *from, int32_t i)
{
    lanes to;
    memcpy(&to.x, from->x + i, sizeof to.x);
    memcpy(&to.y, from->y + i, sizeof to.y);
    memcpy(&to.z, from->z + i, sizeof to.z);
    return to;
}
static inline wide wide_dot(const lanes *a, const lanes *b) { return a->x * b->x + a->y * b->y + a->z * b->z; }
static inline lanes wide_cross(const lanes *a, const lanes *b)
{
    return (lanes){a->y * b->z - a->z * b->y, a->z * b->x - a->x * b->z, a->x * b->y - a->y * b->x};
}

static inline lanes scaled(lanes a, fe_vec3 scale) { return (lanes){a.x * scale.x, a.y * scale.y, a.z * scale.z}; }

// Sets a bit for each of the four edges from i on that lies across n but for 5 degrees, and whose cone of normals holds
// n.
static uint32_t edges_across(const fe__scaled_hull *of, int32_t i, const lanes *n)
{
    const fe__hull *hull = of->hull;
    lanes along = scaled(lanes_at(&hull->vectors, i), of->scale), left = lanes_at(&hull->left, i),
          right = lanes_at(&hull->right, i), turn = wide_cross(n, &along);
    wide rise = wide_dot(&along, n), most = FE__LIES_ALONG * FE__LIES_ALONG * wide_dot(&along, &along),
         past_left = wide_dot(&turn, &left), past_right = wide_dot(&turn, &right);
    // left x n . along >= 0 and n x right . along >= 0, but for as much
    wide_int in = ((past_left > 0.0f) | (past_left * past_left < most)) &
                  ((past_right < 0.0f) | (past_right * past_right < most)) & (rise * rise < most);
    int32_t rest = hull->edge_count - i;
    return w_bits(in) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

static int32_t find_edges(const fe__scaled_hull *of, fe_vec3 n, int16_t *out)
{
    const fe__hull *hull = of->hull;
    lanes normal = {w_set(n.x), w_set(n.y), w_set(n.z)};
    int32_t count = 0;
    for (int32_t i = 0; i < hull->edge_count; i += FE_W)
        for (uint32_t left = edges_across(of, i, &normal); left && count < EDGES_MOST; left &= left - 1)
            out[count++] = (int16_t)(i + __builtin_ctz(left));
    return count;
}

static fe_vec3 times(fe_vec3 a, fe_vec3 b) { return fe__vec3(a.x * b.x, a.y * b.y, a.z * b.z); }

static edge edge_of_a(const fe__scaled_hull *of, int32_t i)
{
    const fe__hull *hull = of->hull;
    fe_vec3 half = fe__scale(0.5f, times(of->scale, fe__hull_lane(&hull->vectors, i)));
    return (edge){fe__add(times(of->scale, fe__hull_lane(&hull->tails, i)), half), half, fe__hull_lane(&hull->left, i),
                  fe__hull_lane(&hull->right, i)};
}

// with its normals turned round, so that both cones are of normals from A to B, and running as A's edge does
static edge edge_of_b(edge e, const fe__relative *b_in_a, fe_vec3 along_a)
{
    const fe__mat3 *r = &b_in_a->rotation;
    e.middle = fe__add(b_in_a->position, fe__mul(r, e.middle)), e.along = fe__mul(r, e.along);
    fe_vec3 left = fe__neg(fe__mul(r, e.first)), right = fe__neg(fe__mul(r, e.last));
    if (fe__dot(e.along, along_a) >= 0.0f) return (edge){e.middle, e.along, left, right};
    return (edge){e.middle, fe__neg(e.along), right, left};
}

// ---- the plane across them -----------------------------------------------------------------------------------------
typedef struct facing {
    fe_vec3 origin;   // A's edge at z = 0
    fe_vec3 x, y, z;  // unit
    flat first, last; // unit
    float half;       // of A's edge, m
    float inwards;    // R by r, along the sum of first and last
    float depths;     // n . d by r, at most
} facing;

static flat across(const facing *f, fe_vec3 v) { return (flat){fe__dot(f->x, v), fe__dot(f->y, v)}; }

// Does the cone from `low` to `high`, less than half a turn, hold a?
static int32_t holds(flat low, flat high, flat a) { return cross(low, a) >= 0.0f && cross(a, high) >= 0.0f; }

static void round_off(facing *f)
{
    float twice = fe__maxf(1.0f + dot(f->first, f->last), BLUNTEST), // 2 cos^2 h
        longer = sqrtf(2.0f / twice), k = fe__clampf(DEEPER / (longer - 1.0f), 2.0f, SLOWEST);
    f->inwards = k / twice, f->depths = k * longer - (k - 1.0f);
}

// Finds what the cones have in common; 0: they have nothing.
static int32_t look_across(const edge *a, const edge *b, facing *f)
{
    f->half = fe__length(a->along), f->origin = a->middle;
    f->z = fe__scale(1.0f / f->half, a->along), f->x = a->first, f->y = fe__cross(f->z, f->x);
    flat first_a = {1.0f, 0.0f}, last_a = across(f, a->last), first_b = unit(across(f, b->first)),
         last_b = unit(across(f, b->last));
    int32_t b_begins = holds(first_a, last_a, first_b), b_ends = holds(first_a, last_a, last_b);
    if (!b_begins && !holds(first_b, last_b, first_a)) return 0;
    if (!b_ends && !holds(first_b, last_b, last_a)) return 0;
    f->first = b_begins ? first_b : first_a, f->last = b_ends ? last_b : last_a;
    round_off(f);
    return 1;
}

// a vector across A's edge that is linear in z
typedef struct line {
    flat at_0, slope;
} line;

static flat at(const line *d, float z) { return (flat){d->at_0.x + d->slope.x * z, d->at_0.y + d->slope.y * z}; }

typedef struct stretch {
    float low, high; // z
} stretch;

// from A's edge to B's, and where they run side by side
static line between(const facing *f, const edge *b, stretch *out)
{
    fe_vec3 d = fe__sub(b->middle, f->origin);
    float half = fe__dot(f->z, b->along), z = fe__dot(f->z, d);
    flat middle = across(f, d), end = across(f, b->along), slope = {end.x / half, end.y / half};
    *out = (stretch){fe__maxf(z - half, -f->half), fe__minf(z + half, f->half)};
    return (line){{middle.x - slope.x * z, middle.y - slope.y * z}, slope};
}

// from the corner that is farther in by R
static line from_inside(const facing *f, line d, float r)
{
    float k = r * f->inwards;
    d.at_0.x += k * (f->first.x + f->last.x);
    d.at_0.y += k * (f->first.y + f->last.y);
    return d;
}

// z where the line is nearest to 0
static float nearest_on(const line *d, stretch s)
{
    float square = dot(d->slope, d->slope);
    const float no_slope = 1e-12f; // a micrometre in a metre: any z is as near
    if (square < no_slope) return 0.5f * (s.low + s.high);
    return fe__clampf(-dot(d->at_0, d->slope) / square, s.low, s.high);
}

// Cuts off where the line looks away from a; 0 if it does at z.
static int32_t keep_side(const line *d, flat a, float z, stretch *s)
{
    float at_0 = dot(d->at_0, a), slope = dot(d->slope, a);
    if (at_0 + slope * z <= 0.0f) return 0;
    if (at_0 + slope * s->low < 0.0f) s->low = -at_0 / slope;
    if (at_0 + slope * s->high < 0.0f) s->high = -at_0 / slope;
    return 1;
}

// Cuts the stretch to where the line is between first and last; 0 if it is not at z.
static int32_t keep_between(const facing *f, const line *inside, float z, stretch *s)
{
    return keep_side(inside, (flat){-f->first.y, f->first.x}, z, s) &&
           keep_side(inside, (flat){f->last.y, -f->last.x}, z, s);
}

static void add_point(const facing *f, const line *d, flat n, float z, float margin, uint32_t id,
                      fe__manifold *manifold)
{
    flat way = at(d, z);
    float separation = dot(n, way);
    if (separation > margin) return;
    fe_vec3 point = fe__add_scaled(f->origin, z, f->z);
    point = fe__add_scaled(fe__add_scaled(point, 0.5f * way.x, f->x), 0.5f * way.y, f->y);
    fe__add_point(manifold, point, separation, id);
}

// ---- the points ----------------------------------------------------------------------------------------------------
typedef struct core {
    float r, least; // m
} core;

static core core_of(const fe__scaled_hull *a, const fe__scaled_hull *b, float separation)
{
    float smallest = fe__minf(a->inner_radius, b->inner_radius),
          least = fe__minf(FE__FACING_DEPTH, CORE_LEAST_SHARE * smallest);
    return (core){fe__clampf(-separation, least, fe__minf(CORE_MOST, CORE_MOST_SHARE * smallest)), least};
}

static int32_t touch(const edge *a, const edge *b, const core *c, float separation, float margin, uint32_t id,
                     fe__manifold *manifold)
{
    facing f;
    stretch s;
    if (!look_across(a, b, &f)) return 0;
    line d = between(&f, b, &s), inside = from_inside(&f, d, c->r);
    if (s.low >= s.high) return 0;
    float z = nearest_on(&inside, s);
    if (!keep_between(&f, &inside, z, &s)) return 0;
    flat n = unit(at(&inside, z));
    if (dot(n, at(&d, z)) < f.depths * fe__minf(separation, 0.0f) - (f.depths - 1.0f) * c->least) return 0;
    const uint32_t high_end = 1u << 30;
    add_point(&f, &d, n, s.low, margin, id, manifold);
    add_point(&f, &d, n, s.high, margin, id | high_end, manifold);
    manifold->normal = fe__add_scaled(fe__scale(n.x, f.x), n.y, f.y);
    return manifold->count > 0;
}

// Do they run side by side but for 5 degrees, and near enough to each other to touch?
static int32_t run_beside(const edge *a, const edge *b, float reach)
{
    float aa = fe__dot(a->along, a->along), bb = fe__dot(b->along, b->along), ab = fe__dot(a->along, b->along);
    if (ab * ab <= FE_FACE_COS * FE_FACE_COS * aa * bb) return 0;
    fe_vec3 d = fe__sub(b->middle, a->middle);
    float along = fe__dot(d, a->along), most = reach + FE__LIES_ALONG * sqrtf(bb);
    return fe__dot(d, d) * aa - along * along <= most * most * aa;
}

int32_t fe__touch_facing_edges(const fe__scaled_hull *a, const fe__scaled_hull *b, const fe__relative *b_in_a,
                               const fe__least_overlap *least, float margin, fe__manifold *manifold, int32_t *name)
{
    int16_t of_a[EDGES_MOST], of_b[EDGES_MOST];
    int32_t count_b = find_edges(b, fe__neg(fe__mul_transposed(&b_in_a->rotation, least->normal)), of_b),
            count_a = count_b > 0 ? find_edges(a, least->normal, of_a) : 0;
    core c = core_of(a, b, least->separation);
    float reach = FE__FACING_REACH * fe__maxf(fe__absf(least->separation), FE__FACING_DEPTH);
    for (int32_t i = 0; i < count_a; ++i) {
        edge own = edge_of_a(a, of_a[i]);
        for (int32_t j = 0; j < count_b; ++j) {
            edge other = edge_of_b(edge_of_a(b, of_b[j]), b_in_a, own.along);
            if (!run_beside(&own, &other, reach)) continue;
            *name = of_a[i] << 10 | of_b[j];
            if (!touch(&own, &other, &c, least->separation, margin, 1u << 31 | (uint32_t)*name, manifold)) continue;
            manifold->round = 1;
            return 1;
        }
    }
    return 0;
}
