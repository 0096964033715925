// mesh_ray.simd.c - rays and moving boxes against a mesh; see mesh_ray.h.
#include "collision/cast/mesh_ray.h"

#include "core/fours.h"
#include "core/simd.h"

// Triangles: Woop, Benthin and Wald, Watertight Ray/Triangle Intersection (JCGT 2013). Space is sheared so that the ray
// runs along an axis. A vertex then has a place in the plane, which depends on the vertex and the ray alone; whether
// the ray passes left of an edge is the sign of one difference of two products. The difference is rounded the same for
// both triangles of the edge, with opposite signs; rounding is monotonic, so that it is 0 or has the sign of the exact
// difference, and 0 counts for both. So no ray passes between them. If the ray meets an edge or a vertex, its distance
// is computed from that alone: the triangles there agree on it, and the lowest number wins. The four triangles of a
// leaf are asked side by side, in double; one that is met is then computed by itself.
//
// Boxes are tested in float, and widened by more than the rounding of floats: a box is never missed if a triangle in it
// is hit. The start is moved along the ray to just before the mesh, for boxes and triangles alike, so that coordinates
// near the mesh lose nothing to a far start. All is done in the scaled frame: the product of a float and the scale is
// exact in double.

// The triangles of one leaf wait on the stack, too.
enum { STACK = FE__MESH_DEPTH * (FE__MESH_WIDTH - 1) + FE__MESH_WIDTH + FE__MESH_LEAF };
#define TRIANGLE 0x40000000u // bit of a child that is a triangle: the rest is its slot
_Static_assert(FE__MESH_TRIANGLES <= TRIANGLE, "slots leave the bit free");

// Smaller slopes count as this one: over the length of any mesh, 2e5 m, it moves a ray by less than any box is widened.
#define LEAST_SLOPE 1e-30
// Boxes are widened by this share of the distances along the ray: one and a half times five roundings of floats.
#define WIDENING 0x1p-21f

// x y z; the fourth number means nothing.
typedef union axes {
    _Alignas(32) double at[4];
    fe__four all;
} axes;
typedef union floats {
    _Alignas(16) float at[4];
    fe__quad all;
} floats;

typedef struct caster {
    axes origin;       // start of the ray, moved near to the mesh, m
    axes inverse;      // 1 / way
    axes scale;        // the mesh's scale
    axes reach;        // half the moving box, in s
    floats unit, half; // 1 m of the mesh, and `reach`, in s
    const fe__mesh *mesh;
    int32_t near_row[3], far_row[3]; // offsets, in a node, of the sides that are met first, and of the others, bytes
    int32_t kx, ky, kz;              // kz: the longest axis of the way; the others so that the frame is right-handed
    int64_t meets_front, meets_back; // -1: triangles that turn left around the ray count, those that turn right
    double shear_x, shear_y, scale_z;
    double moved, per_s; // t = (moved + s) per_s
    double limit;        // s of the nearest hit so far, or the limit
    float last;          // the same for boxes, no less
    // The nearest hit of a ray.
    int32_t slot, number, is_back;
    double weights[3];
    // The visitor of a box.
    fe__mesh_visit visit;
    void *context;
} caster;

// ---- one triangle --------------------------------------------------------------------------------------------------
typedef struct sheared {
    double x, y, z;
} sheared;

static inline sheared shear(const caster *c, const float *v)
{
    const double *s = c->scale.at, *o = c->origin.at;
    double z = s[c->kz] * (double)v[c->kz] - o[c->kz];
    return (sheared){s[c->kx] * (double)v[c->kx] - o[c->kx] - c->shear_x * z,
                     s[c->ky] * (double)v[c->ky] - o[c->ky] - c->shear_y * z, c->scale_z * z};
}

// A float that is no less than x.
static float float_above(double x) { return (float)(x * (1.0 + 0x1p-22)); }

// The distance along the ray to an edge that it meets. It depends on the edge alone, so that both triangles give the
// same.
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

// The distance along the ray to a triangle, by the weights u v w of its corners. It is exact if all corners are equally
// far.
static double reach_triangle(sheared a, sheared b, sheared c, double u, double v, double w)
{
    if (u == 0.0) return v == 0.0 ? c.z : w == 0.0 ? b.z : reach_edge(b, c);
    if (v == 0.0) return w == 0.0 ? a.z : reach_edge(c, a);
    if (w == 0.0) return reach_edge(a, b);
    return a.z + (v * (b.z - a.z) + w * (c.z - a.z)) / (u + v + w);
}

// The ray passes through the triangle, from a side that counts.
static void meet_triangle(caster *c, int32_t slot)
{
    const fe__mesh *m = c->mesh;
    sheared a = shear(c, fe__mesh_vertex(m, slot, 0)), b = shear(c, fe__mesh_vertex(m, slot, 1)),
            d = shear(c, fe__mesh_vertex(m, slot, 2));
    double u = d.x * b.y - d.y * b.x, v = a.x * d.y - a.y * d.x, w = b.x * a.y - b.y * a.x;
    double sum = u + v + w;
    if (sum == 0.0) return; // The ray meets the triangle edge-on.
    double s = reach_triangle(a, b, d, u, v, w);
    if (!(s >= 0.0 && s <= c->limit)) return;
    int32_t number = fe__mesh_number(m, slot);
    if (s == c->limit && c->slot >= 0 && number > c->number) return;
    c->limit = s, c->last = float_above(s);
    c->slot = slot, c->number = number, c->is_back = (sum < 0.0) != m->is_mirrored;
    c->weights[0] = u / sum, c->weights[1] = v / sum, c->weights[2] = w / sum;
}

// ---- the four of a leaf --------------------------------------------------------------------------------------------
typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));

// Corner k of all four triangles: rows of x, y and z.
typedef struct rows {
    fe__quad row[3];
} rows;
static inline rows corners_of(const fe__mesh *m, const fe__mesh_leaf *leaf, int32_t k)
{
    const float *vertices = m->vertices + 3 * (size_t)leaf->first_vertex;
    fe__quad p[FE__MESH_LEAF];
    for (int32_t i = 0; i < FE__MESH_LEAF; ++i) p[i] = *(const loose_quad *)(vertices + 3 * (size_t)leaf->corner[i][k]);
    fe__quad xy = __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5), zw = __builtin_shufflevector(p[0], p[1], 2, 6, 3, 7),
             XY = __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5), ZW = __builtin_shufflevector(p[2], p[3], 2, 6, 3, 7);
    return (rows){{__builtin_shufflevector(xy, XY, 0, 1, 4, 5), __builtin_shufflevector(xy, XY, 2, 3, 6, 7),
                   __builtin_shufflevector(zw, ZW, 0, 1, 4, 5)}};
}

// Bit i: slot i of the leaf is a triangle.
static inline uint32_t slots_of(const fe__mesh *m, uint32_t leaf)
{
    return (1u << fe__mini(m->triangle_count - FE__MESH_LEAF * (int32_t)leaf, FE__MESH_LEAF)) - 1;
}

// shear() for corner k of all four triangles, without z.
typedef struct places {
    fe__four x, y;
} places;
static inline places shear_corners(const caster *c, const fe__mesh_leaf *leaf, int32_t k)
{
    rows v = corners_of(c->mesh, leaf, k);
    const double *s = c->scale.at, *o = c->origin.at;
    fe__four z = s[c->kz] * fe__four_of(v.row[c->kz]) - o[c->kz];
    return (places){s[c->kx] * fe__four_of(v.row[c->kx]) - o[c->kx] - c->shear_x * z,
                    s[c->ky] * fe__four_of(v.row[c->ky]) - o[c->ky] - c->shear_y * z};
}

static inline void meet_leaf(caster *c, uint32_t index)
{
    const fe__mesh_leaf *leaf = c->mesh->leaves + index;
    places a = shear_corners(c, leaf, 0), b = shear_corners(c, leaf, 1), d = shear_corners(c, leaf, 2);
    fe__four u = d.x * b.y - d.y * b.x, v = a.x * d.y - a.y * d.x, w = b.x * a.y - b.y * a.x;
    const fe__four zero = fe__four_set(0.0);
    fe__four_int met = ((u >= zero) & (v >= zero) & (w >= zero) & c->meets_front) |
                       ((u <= zero) & (v <= zero) & (w <= zero) & c->meets_back);
    for (uint32_t hits = fe__four_signs(met) & slots_of(c->mesh, index); hits; hits &= hits - 1)
        meet_triangle(c, FE__MESH_LEAF * (int32_t)index + __builtin_ctz(hits));
}

// Bit i: the moving box meets the bounds of slot i, from near[i] on.
static inline uint32_t meet_bounds(const caster *c, uint32_t index, float *near)
{
    const fe__mesh_leaf *leaf = c->mesh->leaves + index;
    rows a = corners_of(c->mesh, leaf, 0), b = corners_of(c->mesh, leaf, 1), d = corners_of(c->mesh, leaf, 2);
    fe__four enter = fe__four_set(0.0), leave = fe__four_set((double)c->last);
    for (int32_t k = 0; k < 3; ++k) {
        fe__quad low = fe__quad_min(fe__quad_min(a.row[k], b.row[k]), d.row[k]),
                 high = fe__quad_max(fe__quad_max(a.row[k], b.row[k]), d.row[k]);
        fe__four s = (c->scale.at[k] * fe__four_of(low) - c->origin.at[k]) * c->inverse.at[k],
                 t = (c->scale.at[k] * fe__four_of(high) - c->origin.at[k]) * c->inverse.at[k];
        enter = fe__four_max(enter, fe__four_min(s, t) - c->reach.at[k]);
        leave = fe__four_min(leave, fe__four_max(s, t) + c->reach.at[k]);
    }
    *(fe__quad *)near = fe__four_narrow(enter * (1.0 - 0x1p-22)); // The float is no later.
    return fe__four_signs(enter <= leave) & slots_of(c->mesh, index);
}

// ---- nodes ---------------------------------------------------------------------------------------------------------
// Bit i: the ray, or the box that moves along it, meets the box of child i, from near[i] on. A step is 2^exponent, made
// from the bits of a float; the fourth means nothing.
//
//   s = ((scale (origin + step byte) - o) -+ half) inverse = base + (step unit) byte -+ half |inverse|
static inline uint32_t meet_boxes(const caster *c, const fe__mesh_node *node, float *near)
{
    fe__quad base = fe__four_narrow((c->scale.all * fe__four_of(*(const loose_quad *)node->origin) - c->origin.all) *
                                    c->inverse.all);
    const fe__quad_int exponents = {node->exponent[0], node->exponent[1], node->exponent[2], 0};
    floats step = {.all = c->unit.all * (fe__quad)((exponents + 127) << 23)}, first, last;
    fe__quad wider = WIDENING * (fe__quad_abs(base) + 255.0f * fe__quad_abs(step.all) + c->half.all) + c->half.all;
    first.all = base - wider, last.all = base + wider;
    fe__eight enter = fe__eight_set(0.0f), leave = fe__eight_set(c->last);
    for (int32_t k = 0; k < 3; ++k) {
        const uint8_t *close = (const uint8_t *)node + c->near_row[k], *far = (const uint8_t *)node + c->far_row[k];
        fe__eight steps = fe__eight_spread(step.at + k);
        enter = fe__eight_max(enter, fe__eight_add(fe__eight_spread(first.at + k),
                                                   fe__eight_mul(fe__eight_of_bytes(close), steps)));
        leave = fe__eight_min(leave, fe__eight_add(fe__eight_spread(last.at + k),
                                                   fe__eight_mul(fe__eight_of_bytes(far), steps)));
    }
    fe__eight_store(near, enter);
    return fe__eight_at_most(enter, leave) & ((1u << node->count) - 1);
}

// A child that waits: the s at which the ray enters it in the high bits, its number in the low ones. The bits of floats
// that are not negative are in the order of the floats.
typedef uint64_t entry;
static inline entry entry_of(float near, uint32_t child)
{
    union {
        float value;
        uint32_t bits;
    } t = {near + 0.0f}; // -0 becomes 0.
    return (entry)t.bits << 32 | child;
}

// Pushes the children that are met, the nearest on top.
static inline int32_t push(entry *stack, int32_t top, uint32_t hits, const float *near, uint32_t first)
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

typedef enum question { RAY, BOX } question;
static void set_limit(caster *c, double limit);

static inline __attribute__((always_inline)) void walk(question q, caster *c)
{
    _Alignas(32) float near[FE__MESH_WIDTH];
    entry stack[STACK];
    int32_t top = 1;
    stack[0] = 0; // the root
    while (top > 0) {
        entry next = stack[--top];
        if (next > entry_of(c->last, UINT32_MAX)) continue;
        uint32_t child = (uint32_t)next;
        if (child & FE__MESH_LEAVES) {
            uint32_t leaf = child & ~FE__MESH_LEAVES;
            if (q == RAY)
                meet_leaf(c, leaf);
            else
                top = push(stack, top, meet_bounds(c, leaf, near), near, TRIANGLE | FE__MESH_LEAF * leaf);
            continue;
        }
        if (q == BOX && child & TRIANGLE) {
            set_limit(c, c->visit(c->context, (int32_t)(child & ~TRIANGLE)));
            continue;
        }
        const fe__mesh_node *node = c->mesh->nodes + child;
        top = push(stack, top, meet_boxes(c, node, near), near, node->first);
    }
}

// ---- the ray -------------------------------------------------------------------------------------------------------
// Finds the s at which the way comes into the bounds, widened by more than the rounding of the move. 0: it does not
// come into them
static int32_t clip(const caster *c, const double way[3], const double half[3], double *enter)
{
    const fe__mesh *m = c->mesh;
    const float low[3] = {m->low.x, m->low.y, m->low.z}, high[3] = {m->high.x, m->high.y, m->high.z};
    double leave = (double)INFINITY;
    *enter = 0.0;
    for (int32_t k = 0; k < 3; ++k) {
        double o = c->origin.at[k];
        double spare = 1e-3 + 0.01 * ((double)high[k] - (double)low[k]) + 1e-12 * fe__absd(o) + half[k];
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

static inline void choose_axes(caster *c, const double way[3])
{
    double x = fe__absd(way[0]), y = fe__absd(way[1]), z = fe__absd(way[2]);
    c->kz = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    c->kx = (c->kz + 1) % 3, c->ky = (c->kz + 2) % 3;
    if (way[c->kz] < 0.0) {
        int32_t kept = c->kx;
        c->kx = c->ky, c->ky = kept;
    }
    c->shear_x = way[c->kx] / way[c->kz], c->shear_y = way[c->ky] / way[c->kz], c->scale_z = 1.0 / way[c->kz];
}

static inline void choose_sides(caster *c, const double way[3], const double half[3])
{
    const fe__mesh *m = c->mesh;
    for (int32_t k = 0; k < 3; ++k) {
        c->scale.at[k] = m->scale[k];
        c->inverse.at[k] = 1.0 / (fe__absd(way[k]) > LEAST_SLOPE ? way[k] : __builtin_copysign(LEAST_SLOPE, way[k]));
        c->unit.at[k] = (float)(c->scale.at[k] * c->inverse.at[k]);
        int32_t low = (int32_t)offsetof(fe__mesh_node, low) + FE__MESH_WIDTH * k,
                high = (int32_t)offsetof(fe__mesh_node, high) + FE__MESH_WIDTH * k;
        c->near_row[k] = c->unit.at[k] > 0.0f ? low : high, c->far_row[k] = c->unit.at[k] > 0.0f ? high : low;
        c->reach.at[k] = half[k] * fe__absd(c->inverse.at[k]);
        c->half.at[k] = float_above(c->reach.at[k]);
    }
    c->scale.at[3] = c->origin.at[3] = c->inverse.at[3] = 0.0, c->unit.at[3] = c->half.at[3] = 0.0f;
    c->meets_front = -(int64_t)(!m->is_mirrored || m->is_two_sided);
    c->meets_back = -(int64_t)(m->is_mirrored || m->is_two_sided);
}

// Prepares a ray, or a box of those half widths that moves along it. 0: it passes by the mesh
static inline int32_t prepare(caster *c, fe_dvec3 origin, fe_dvec3 translation, const double half[3], double limit)
{
    double longest = fe__maxd(fe__maxd(fe__absd(translation.x), fe__absd(translation.y)), fe__absd(translation.z));
    if (!(longest > FE__MESH_STILL)) return 0;
    // The power of two that brings the longest component to 2..4. It is a normal number if that component is one.
    union {
        double value;
        uint64_t bits;
    } power = {longest};
    power.bits = (uint64_t)(2047 - (int32_t)(power.bits >> 52 & 2047)) << 52;
    double scale = power.value;
    const double way[3] = {scale * translation.x, scale * translation.y, scale * translation.z};
    c->origin.at[0] = origin.x, c->origin.at[1] = origin.y, c->origin.at[2] = origin.z;
    c->per_s = scale;
    if (!clip(c, way, half, &c->moved)) return 0;
    c->limit = limit / scale - c->moved;
    if (!(c->limit >= 0.0)) return 0;
    c->limit = fe__mind(c->limit, 1e30); // Any mesh ends before that.
    c->last = float_above(c->limit);
    for (int32_t k = 0; k < 3; ++k) c->origin.at[k] += c->moved * way[k];
    choose_axes(c, way);
    choose_sides(c, way, half);
    return 1;
}

static int32_t ray(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__mesh_hit *out)
{
    caster c;
    c.mesh = mesh, c.slot = -1;
    if (!prepare(&c, origin, translation, (const double[3]){0.0, 0.0, 0.0}, limit)) return 0;
    walk(RAY, &c);
    if (c.slot < 0) return 0;
    fe_dvec3 v[3];
    fe__mesh_corners(mesh, c.slot, v);
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    double k = (c.is_back ? -1.0 : 1.0) / sqrt(fe__ddot(n, n));
    out->hit.t = fe__mind((c.moved + c.limit) * c.per_s, limit), out->hit.normal = fe__dscale(k, n);
    out->hit.depth = 0.0, out->hit.inside = 0, out->hit.triangle = c.number, out->hit.index = c.slot;
    out->is_back = c.is_back;
    for (int32_t i = 0; i < 3; ++i) out->weights[i] = c.weights[i];
    return 1;
}

// ---- boxes ---------------------------------------------------------------------------------------------------------
// The new limit is no less than the end of the way: s is known to some roundings of the way that was moved.
static void set_limit(caster *c, double limit)
{
    double s = limit / c->per_s - c->moved;
    c->last = float_above(fe__mind(fe__maxd(s, 0.0) + 1e-15 * c->moved, 1e30));
}

static void sweep(const fe__mesh *mesh, const fe__mesh_way *way, double limit, fe__mesh_visit visit, void *context)
{
    caster c;
    c.mesh = mesh, c.visit = visit, c.context = context;
    if (!prepare(&c, way->origin, way->translation, (const double[3]){way->half.x, way->half.y, way->half.z}, limit))
        return;
    set_limit(&c, limit);
    walk(BOX, &c);
}

const fe__mesh_casts FE_NAME(fe__mesh_casts) = {ray, sweep};
