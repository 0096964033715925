// mesh_ray.c - see mesh_ray.h.
//
// Triangles: Woop, Benthin and Wald, Watertight Ray/Triangle Intersection (JCGT 2013). Space is sheared so that the ray
// runs along an axis. A vertex then has a place in the plane, which depends on the vertex and the ray alone; whether
// the ray passes left of an edge is the sign of one difference of two products. That is rounded the same for both
// triangles of the edge, with opposite signs; being monotonic, it is 0 or has the sign of the exact difference, and 0
// counts for both. So no ray passes between them. Where it meets an edge or a vertex, its distance is taken from that
// alone: the triangles there agree on it, and the lowest number wins.
//
// Boxes are tested in float, and widened by more than its roundings: a box is never missed when a triangle in it is
// hit. The start is moved along the ray to just before the mesh, for boxes and triangles alike: coordinates near it
// lose nothing to a far start. All is done in the scaled frame: the products of floats that scale are exact in double.
#include "collision/cast/mesh_ray.h"

#include "core/lanes.h"

enum { STACK = FE__MESH_DEPTH * (FE__MESH_WIDTH - 1) + FE__MESH_WIDTH };

// A translation that moves less than this moves by nothing, m
#define STILL 1e-200
// A slope is taken for no less: over the length of any mesh, 2e5 m, it moves a ray by less than any box is widened
#define LEAST_SLOPE 1e-30
// Of distances along the ray: four roundings of floats, twice
#define WIDENING 0x1p-21f

typedef struct caster {
    const fe__mesh *mesh;
    double origin[3], inverse[3]; // near the mesh; of the way
    int32_t kx, ky, kz;           // kz: the longest axis of the way; the others so that the frame is right-handed
    double shear_x, shear_y, scale_z;
    double moved, per_s; // t = (moved + s) per_s
    double limit;        // of s, the nearest hit so far
    float last;          // of boxes: no less
    int32_t slot, number, is_back;
    double weights[3];
} caster;

// ---- triangles -----------------------------------------------------------------------------------------------------
typedef struct sheared {
    double x, y, z;
} sheared;

static inline sheared shear(const caster *c, const float *v)
{
    const double *s = c->mesh->scale;
    double z = s[c->kz] * (double)v[c->kz] - c->origin[c->kz];
    return (sheared){s[c->kx] * (double)v[c->kx] - c->origin[c->kx] - c->shear_x * z,
                     s[c->ky] * (double)v[c->ky] - c->origin[c->ky] - c->shear_y * z, c->scale_z * z};
}

// No less than x, as a float
static float float_above(double x) { return (float)(x * (1.0 + 0x1p-22)); }

// How far along the ray an edge is that it meets, from the edge alone, so that both its triangles say the same
static double reach_edge(sheared a, sheared b)
{
    if (a.x > b.x || (a.x == b.x && (a.y > b.y || (a.y == b.y && a.z > b.z)))) {
        sheared kept = a;
        a = b, b = kept;
    }
    double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    double part = square > 0.0 ? -(a.x * x + a.y * y) / square : 0.0;
    return a.z + fe__clampd(part, 0.0, 1.0) * (b.z - a.z);
}

// u v w: of the corners. Exact when all are equally far
static double reach_triangle(sheared a, sheared b, sheared c, double u, double v, double w)
{
    if (u == 0.0) return v == 0.0 ? c.z : w == 0.0 ? b.z : reach_edge(b, c);
    if (v == 0.0) return w == 0.0 ? a.z : reach_edge(c, a);
    if (w == 0.0) return reach_edge(a, b);
    return a.z + (v * (b.z - a.z) + w * (c.z - a.z)) / (u + v + w);
}

static inline void meet_triangle(caster *c, int32_t slot)
{
    const fe__mesh *m = c->mesh;
    sheared a = shear(c, fe__mesh_vertex(m, slot, 0)), b = shear(c, fe__mesh_vertex(m, slot, 1)),
            d = shear(c, fe__mesh_vertex(m, slot, 2));
    double u = d.x * b.y - d.y * b.x, v = a.x * d.y - a.y * d.x, w = b.x * a.y - b.y * a.x;
    int32_t is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0), is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
    if (m->is_mirrored) {
        int32_t kept = is_front;
        is_front = is_back, is_back = kept;
    }
    if (!is_front && !(is_back && m->is_two_sided)) return;
    double sum = u + v + w;
    if (sum == 0.0) return; // edge-on
    double s = reach_triangle(a, b, d, u, v, w);
    if (!(s >= 0.0 && s <= c->limit)) return;
    int32_t number = fe__mesh_number(m, slot);
    if (s == c->limit && c->slot >= 0 && number > c->number) return;
    c->limit = s, c->last = float_above(s);
    c->slot = slot, c->number = number, c->is_back = !is_front;
    c->weights[0] = u / sum, c->weights[1] = v / sum, c->weights[2] = w / sum;
}

static void meet_leaf(caster *c, uint32_t leaf)
{
    int32_t first = FE__MESH_LEAF * (int32_t)leaf, end = fe__mini(first + FE__MESH_LEAF, c->mesh->triangle_count);
    for (int32_t slot = first; slot < end; ++slot) meet_triangle(c, slot);
}

// ---- nodes ---------------------------------------------------------------------------------------------------------
typedef uint8_t bytes4 __attribute__((vector_size(4), may_alias, aligned(1)));

static inline fe__lanes lanes_of(const uint8_t *bytes)
{
    return (fe__lanes){__builtin_convertvector(*(const bytes4 *)bytes, fe__quad),
                       __builtin_convertvector(*(const bytes4 *)(bytes + 4), fe__quad)};
}

// Bit i: the ray meets the box of child i, from `near` on
static inline uint32_t meet_boxes(const caster *c, const fe__mesh_node *node, float *near)
{
    fe__lanes enter = fe__lanes_set(0.0f), leave = fe__lanes_set(c->last);
    for (int32_t k = 0; k < 3; ++k) {
        double scale = c->mesh->scale[k];
        float base = (float)((scale * (double)node->origin[k] - c->origin[k]) * c->inverse[k]);
        float step = (float)(fe__mesh_step(node, k) * scale * c->inverse[k]);
        float widening = WIDENING * (fe__absf(base) + 255.0f * fe__absf(step));
        const uint8_t *close = step > 0.0f ? node->low[k] : node->high[k];
        const uint8_t *far = step > 0.0f ? node->high[k] : node->low[k];
        fe__lanes steps = fe__lanes_set(step);
        enter =
            fe__lanes_max(enter, fe__lanes_add(fe__lanes_set(base - widening), fe__lanes_mul(lanes_of(close), steps)));
        leave =
            fe__lanes_min(leave, fe__lanes_add(fe__lanes_set(base + widening), fe__lanes_mul(lanes_of(far), steps)));
    }
    fe__lanes_store(near, enter);
    return fe__lanes_at_most(enter, leave) & ((1u << node->count) - 1);
}

// What waits: where the ray enters it, whose bits are in the order of floats as it is not negative, and the child
typedef uint64_t entry;
static entry entry_of(float near, uint32_t child)
{
    union {
        float value;
        uint32_t bits;
    } t = {near + 0.0f}; // -0 is 0
    return (entry)t.bits << 32 | child;
}
static float near_of(entry e)
{
    union {
        uint32_t bits;
        float value;
    } t = {(uint32_t)(e >> 32)};
    return t.value;
}

// Children that are met, the nearest on top
static int32_t push(entry *stack, int32_t top, uint32_t hits, const float *near, uint32_t first)
{
    int32_t base = top;
    for (; hits; hits &= hits - 1) {
        uint32_t lane = (uint32_t)__builtin_ctz(hits);
        entry e = entry_of(near[lane], first + lane);
        int32_t place = top++;
        for (; place > base && stack[place - 1] < e; --place) stack[place] = stack[place - 1];
        stack[place] = e;
    }
    return top;
}

static void walk(caster *c)
{
    _Alignas(16) float near[FE__MESH_WIDTH];
    entry stack[STACK];
    int32_t top = 1;
    stack[0] = 0; // the root
    while (top > 0) {
        entry next = stack[--top];
        if (near_of(next) > c->last) continue;
        uint32_t child = (uint32_t)next;
        if (child & FE__MESH_LEAVES) {
            meet_leaf(c, child & ~FE__MESH_LEAVES);
            continue;
        }
        const fe__mesh_node *node = c->mesh->nodes + child;
        top = push(stack, top, meet_boxes(c, node, near), near, node->first);
    }
}

// ---- the ray -------------------------------------------------------------------------------------------------------
// The power of two that brings x to 2..4: of any x that is no denormal it is a normal number
static double scale_for(double x)
{
    union {
        double value;
        uint64_t bits;
    } a = {x};
    a.bits = (uint64_t)(2047 - (int32_t)(a.bits >> 52 & 2047)) << 52;
    return a.value;
}

// Where the way comes into the bounds, widened by more than the move is rounded; 0: it does not, or it begins there
static int32_t clip(const caster *c, const double way[3], double *enter)
{
    const fe__mesh *m = c->mesh;
    const float low[3] = {m->low.x, m->low.y, m->low.z}, high[3] = {m->high.x, m->high.y, m->high.z};
    double leave = (double)INFINITY;
    *enter = 0.0;
    for (int32_t k = 0; k < 3; ++k) {
        double o = c->origin[k];
        double spare = 1e-3 + 0.01 * ((double)high[k] - (double)low[k]) + 1e-12 * fe__absd(o);
        double a = (double)low[k] - spare - o, b = (double)high[k] + spare - o;
        if (way[k] == 0.0) {
            if (a > 0.0 || b < 0.0) return 0;
            continue;
        }
        double s = a / way[k], t = b / way[k];
        *enter = fe__maxd(*enter, fe__mind(s, t));
        leave = fe__mind(leave, fe__maxd(s, t));
    }
    return *enter <= leave && *enter < (double)INFINITY;
}

static void choose_axes(caster *c, const double way[3])
{
    double x = fe__absd(way[0]), y = fe__absd(way[1]), z = fe__absd(way[2]);
    c->kz = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    c->kx = (c->kz + 1) % 3, c->ky = (c->kz + 2) % 3;
    if (way[c->kz] < 0.0) {
        int32_t kept = c->kx;
        c->kx = c->ky, c->ky = kept;
    }
    c->shear_x = way[c->kx] / way[c->kz], c->shear_y = way[c->ky] / way[c->kz], c->scale_z = 1.0 / way[c->kz];
    for (int32_t k = 0; k < 3; ++k)
        c->inverse[k] = 1.0 / (fe__absd(way[k]) > LEAST_SLOPE ? way[k] : __builtin_copysign(LEAST_SLOPE, way[k]));
}

// 0: the ray passes by the mesh
static int32_t prepare(caster *c, fe_dvec3 origin, fe_dvec3 translation, double limit)
{
    double longest = fe__maxd(fe__maxd(fe__absd(translation.x), fe__absd(translation.y)), fe__absd(translation.z));
    if (!(longest > STILL)) return 0;
    double scale = scale_for(longest);
    const double way[3] = {scale * translation.x, scale * translation.y, scale * translation.z};
    c->origin[0] = origin.x, c->origin[1] = origin.y, c->origin[2] = origin.z;
    c->per_s = scale;
    if (!clip(c, way, &c->moved)) return 0;
    c->limit = limit / scale - c->moved;
    if (!(c->limit >= 0.0)) return 0;
    c->limit = fe__mind(c->limit, 1e30); // any mesh ends before
    c->last = float_above(c->limit);
    for (int32_t k = 0; k < 3; ++k) c->origin[k] += c->moved * way[k];
    choose_axes(c, way);
    c->slot = -1;
    return 1;
}

static void report(const caster *c, double limit, fe__mesh_hit *out)
{
    fe_dvec3 v[3];
    fe__mesh_corners(c->mesh, c->slot, v);
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    double k = (c->is_back ? -1.0 : 1.0) / sqrt(fe__ddot(n, n));
    *out = (fe__mesh_hit){.hit = {.t = fe__mind((c->moved + c->limit) * c->per_s, limit),
                                  .normal = fe__dscale(k, n),
                                  .triangle = c->number},
                          .slot = c->slot,
                          .is_back = c->is_back,
                          .weights = {c->weights[0], c->weights[1], c->weights[2]}};
}

int32_t fe__mesh_ray(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__mesh_hit *hit)
{
    caster c;
    c.mesh = mesh;
    if (!prepare(&c, origin, translation, limit)) return 0;
    walk(&c);
    if (c.slot < 0) return 0;
    report(&c, limit, hit);
    return 1;
}
