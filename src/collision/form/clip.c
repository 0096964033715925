// clip.c - cutting a face by another, and choosing four of the vertices.
//
// Input: two faces in the plane of one of them, from box_box.c and convex.c, which turn the vertices into contact
// points. The rectangle's cut works on the four edges of the incident face side by side (Liang and Barsky, 1984)
// without a branch; the general one is Sutherland and Hodgman's (1974). What has a rim is cut by the circle itself.
#define FE_W 4
#include "collision/form/clip.h"

#include "core/simd.h"

#include <float.h>
#include <string.h>

// ---- four lanes ----------------------------------------------------------------------------------------------------
static inline wide absolute(wide a) { return (wide)((wide_int)a & 0x7fffffff); }
static inline wide_int choose_int(wide_int m, wide_int yes, wide_int no) { return (m & yes) | (~m & no); }
static inline uint32_t bits(wide_int m)
{
#if FE_X86
    return (uint32_t)_mm_movemask_ps((__m128)m);
#else
    return (uint32_t)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

typedef struct lanes {
    wide u, v, height;
} lanes;

static inline lanes at(const fe__parallelogram *p, wide i, wide j)
{
    return (lanes){p->centre.x + i * p->x.x + j * p->y.x, p->centre.y + i * p->x.y + j * p->y.y,
                   p->centre.z + i * p->x.z + j * p->y.z};
}

// ---- the four edges -------------------------------------------------------------------------------------------------
// Edge k runs from corner k to corner k + 1, around the parallelogram; so do the corners of the rectangle.
static const wide corner_i = {-1.0f, 1.0f, 1.0f, -1.0f}, corner_j = {-1.0f, -1.0f, 1.0f, 1.0f};
static const wide step_i = {2.0f, 0.0f, -2.0f, 0.0f}, step_j = {0.0f, 2.0f, 0.0f, -2.0f};

typedef struct cut_edges {
    lanes start, end;
    wide_int has_start, has_end; // the end is given only where the next edge does not give it as its start
    wide_int side_start,
        side_end; // the rectangle's side that cuts there: 0 +u, 1 +v, 2 -u, 3 -v; -1 a start that nothing cut
} cut_edges;

// What of start + t step, 0 <= t <= 1, lies in the rectangle: inside |u| <= h for t between (-h - u) / du and (h - u) /
// du, whichever comes first. An edge parallel to a side has du = 0, which becomes so small that it is inside always or
// never.
static inline cut_edges cut_by_rectangle(const fe__parallelogram *p, float half_u, float half_v)
{
    const wide zero = {0.0f, 0.0f, 0.0f, 0.0f}, one = {1.0f, 1.0f, 1.0f, 1.0f}, tiny = {1e-12f, 1e-12f, 1e-12f, 1e-12f};
    lanes s = at(p, corner_i, corner_j);
    lanes d = {step_i * p->x.x + step_j * p->y.x, step_i * p->x.y + step_j * p->y.y, step_i * p->x.z + step_j * p->y.z};
    wide inverse_u = one / w_choose(absolute(d.u) < tiny, tiny, d.u),
         inverse_v = one / w_choose(absolute(d.v) < tiny, tiny, d.v);
    wide au = (-half_u - s.u) * inverse_u, bu = (half_u - s.u) * inverse_u, av = (-half_v - s.v) * inverse_v,
         bv = (half_v - s.v) * inverse_v;
    wide enter_u = w_min(au, bu), leave_u = w_max(au, bu), enter_v = w_min(av, bv), leave_v = w_max(av, bv);
    wide t0 = w_max(w_max(enter_u, enter_v), zero), t1 = w_min(w_min(leave_u, leave_v), one);
    wide_int towards_u = inverse_u > zero, towards_v = inverse_v > zero, alive = t0 <= t1, whole_start = t0 <= zero;

    cut_edges cut;
    cut.start = (lanes){s.u + t0 * d.u, s.v + t0 * d.v, s.height + t0 * d.height};
    cut.end = (lanes){s.u + t1 * d.u, s.v + t1 * d.v, s.height + t1 * d.height};
    cut.has_start = alive;
    wide_int given = alive & whole_start;
    cut.has_end = alive & ((t1 < one) | ~__builtin_shufflevector(given, given, 1, 2, 3, 0));
    wide_int in = choose_int(enter_u >= enter_v, towards_u & 2, (towards_v & 2) + 1);
    cut.side_start = choose_int(whole_start, (wide_int){-1, -1, -1, -1}, in);
    cut.side_end = choose_int(leave_u <= leave_v, ~towards_u & 2, (~towards_v & 2) + 1);
    return cut;
}

// The rectangle's corners that lie in the parallelogram, at its height: corner = centre + i x + j y solved for i and j.
// Only half the slack, so that an edge that has just left the rectangle and a corner that has just left the
// parallelogram never both lose a point: a point given twice does no harm, one lost tilts a stack.
static inline lanes corners_inside(const fe__parallelogram *p, float half_u, float half_v, float slack,
                                   wide_int *inside)
{
    float inverse = 1.0f / (p->x.x * p->y.y - p->x.y * p->y.x);
    wide u = corner_i * half_u, v = corner_j * half_v, du = u - p->centre.x, dv = v - p->centre.y;
    wide i = (du * p->y.y - dv * p->y.x) * inverse, j = (p->x.x * dv - p->x.y * du) * inverse;
    float size = 0.5f * slack * fe__absf(inverse);
    float slack_i = size * (fe__absf(p->y.x) + fe__absf(p->y.y)),
          slack_j = size * (fe__absf(p->x.x) + fe__absf(p->x.y));
    *inside = (absolute(i) < w_set(1.0f - slack_i)) & (absolute(j) < w_set(1.0f - slack_j));
    return (lanes){u, v, p->centre.z + i * p->x.z + j * p->y.z};
}

static inline void store(const lanes *from, float *u, float *v, float *height)
{
    memcpy(u, &from->u, sizeof from->u);
    memcpy(v, &from->v, sizeof from->v);
    memcpy(height, &from->height, sizeof from->height);
}

int32_t fe__clip_rectangle(const fe__parallelogram *incident, float half_u, float half_v, float slack, float margin,
                           fe__clip_vertex out[12])
{
    cut_edges cut = cut_by_rectangle(incident, half_u + slack, half_v + slack);
    wide_int inside;
    lanes corner = corners_inside(incident, half_u, half_v, slack, &inside);
    wide near = w_set(margin);
    uint32_t left = bits(cut.has_start & (cut.start.height <= near)) |
                    bits(cut.has_end & (cut.end.height <= near)) << 4 | bits(inside & (corner.height <= near)) << 8;

    float u[12], v[12], height[12];
    int32_t side[8];
    store(&cut.start, u, v, height);
    store(&cut.end, u + 4, v + 4, height + 4);
    store(&corner, u + 8, v + 8, height + 8);
    memcpy(side, &cut.side_start, sizeof cut.side_start);
    memcpy(side + 4, &cut.side_end, sizeof cut.side_end);

    int32_t count = 0;
    for (; left != 0; left &= left - 1) {
        int32_t k = __builtin_ctz(left), edge = k & 3;
        uint32_t id;
        if (k >= 8)
            id = fe__clip_id(FE_CLIP_SIDE + edge, FE_CLIP_SIDE + edge);
        else if (k >= 4)
            id = fe__clip_id(edge, FE_CLIP_SIDE + side[k]);
        else
            id = fe__clip_id(side[k] < 0 ? (edge + 3) & 3 : FE_CLIP_SIDE + side[k], edge);
        out[count++] = (fe__clip_vertex){u[k], v[k], height[k], id};
    }
    return count;
}

// ---- any polygon ---------------------------------------------------------------------------------------------------
// The part of a polygon, or of an open line of one or two vertices, on the left of the line through p along (du, dv),
// by name `side`.
typedef struct cutter {
    float u, v, du, dv; // the direction has length 1
    float slack;
    int32_t side;
} cutter;

static float inside_by(const cutter *c, const fe__clip_vertex *p)
{
    return c->du * (p->v - c->v) - c->dv * (p->u - c->u) + c->slack;
}

static fe__clip_vertex crossing(const fe__clip_vertex *p, const fe__clip_vertex *q, float at_p, float at_q,
                                int32_t side)
{
    float t = at_p / (at_p - at_q);
    int32_t edge = (int32_t)(p->id & 0xff); // the one from p to q
    uint32_t id = at_p > at_q ? fe__clip_id(edge, FE_CLIP_SIDE + side) : fe__clip_id(FE_CLIP_SIDE + side, edge);
    return (fe__clip_vertex){p->u + t * (q->u - p->u), p->v + t * (q->v - p->v),
                             p->height + t * (q->height - p->height), id};
}

// Of each vertex how far it is inside. 1: all of them are
static int32_t measure(const cutter *c, const fe__clip_vertex *in, int32_t count, float *out_inside)
{
    int32_t all = 1;
    for (int32_t i = 0; i < count; ++i) {
        out_inside[i] = inside_by(c, &in[i]);
        all &= out_inside[i] >= 0.0f;
    }
    return all;
}

static int32_t cut_polygon(const cutter *c, const fe__clip_vertex *in, const float *inside, int32_t count,
                           int32_t closed, fe__clip_vertex *out)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; ++i) {
        if (closed || i > 0) {
            int32_t previous = i > 0 ? i - 1 : count - 1;
            if ((inside[previous] < 0.0f) != (inside[i] < 0.0f))
                out[left++] = crossing(&in[previous], &in[i], inside[previous], inside[i], c->side);
        }
        if (inside[i] >= 0.0f) out[left++] = in[i];
    }
    return left;
}

int32_t fe__clip_polygon(const fe__clip_vertex *reference, int32_t reference_count, fe__clip_vertex *incident,
                         int32_t count, float slack)
{
    fe__clip_vertex other[FE_CLIP_VERTICES], *in = incident, *out = other;
    float inside[FE_CLIP_VERTICES];
    int32_t closed = count > 2;
    for (int32_t i = 0; i < reference_count && count > 0; ++i) {
        const fe__clip_vertex *p = &reference[i], *q = &reference[(i + 1) % reference_count];
        float du = q->u - p->u, dv = q->v - p->v, inverse = 1.0f / sqrtf(du * du + dv * dv);
        cutter c = {p->u, p->v, inverse * du, inverse * dv, slack, i};
        if (measure(&c, in, count, inside)) continue;
        count = cut_polygon(&c, in, inside, count, closed, out);
        fe__clip_vertex *swap = in;
        in = out, out = swap;
    }
    if (in != incident) memcpy(incident, in, sizeof(fe__clip_vertex) * (size_t)count);
    return count;
}

// ---- a disc --------------------------------------------------------------------------------------------------------
#define C1 0.92387953f // cosines of 22.5, 45 and 67.5 degrees
#define C2 0.70710678f
#define C3 0.38268343f
static const float rim_cos[FE_RIM_POINTS] = {1, C1, C2, C3, 0, -C3, -C2, -C1, -1, -C1, -C2, -C3, 0, C3, C2, C1};

// The square of a vertex's distance from the rim's centre, less that of the rim: above 0 outside
static float outside_by(const fe__clip_vertex *p, float square) { return p->u * p->u + p->v * p->v - square; }

// Where the edge from p to q enters the disc and where it leaves: |p + t d|^2 = r^2
static int32_t cross_rim(const fe__clip_vertex *p, const fe__clip_vertex *q, float p_out, float q_out, int32_t edge,
                         fe__clip_vertex *out)
{
    fe__clip_vertex d = {q->u - p->u, q->v - p->v, q->height - p->height, 0};
    float along = -(p->u * d.u + p->v * d.v), square = d.u * d.u + d.v * d.v, root = along * along - square * p_out;
    if (p_out > 0.0f && q_out > 0.0f && !(root > 0.0f && along > 0.0f && along < square)) return 0;
    root = sqrtf(fe__maxf(root, 0.0f));
    int32_t count = 0;
    if (p_out > 0.0f) {
        float t = fe__clampf((along - root) / square, 0.0f, 1.0f);
        out[count++] = (fe__clip_vertex){p->u + t * d.u, p->v + t * d.v, p->height + t * d.height,
                                         fe__clip_id(FE_CLIP_SIDE, edge)};
    }
    if (q_out > 0.0f) {
        float t = fe__clampf((along + root) / square, 0.0f, 1.0f);
        out[count++] = (fe__clip_vertex){p->u + t * d.u, p->v + t * d.v, p->height + t * d.height,
                                         fe__clip_id(edge, FE_CLIP_SIDE)};
    }
    return count;
}

static fe__clip_vertex rim_point(const fe__disc *disc, int32_t i)
{
    float u = disc->radius * rim_cos[i], v = disc->radius * rim_cos[(i + 12) % FE_RIM_POINTS];
    return (fe__clip_vertex){u, v, disc->height + disc->slope_u * u + disc->slope_v * v,
                             fe__clip_id(FE_CLIP_SIDE + i, FE_CLIP_SIDE + i)};
}

// The line of a polygon's edge: its unit normal points out of the polygon, its distance counts from the rim's centre.
typedef struct edge_line {
    float u, v, distance;
} edge_line;

// The least distance of the edges
static float find_lines(const fe__clip_vertex *polygon, int32_t count, edge_line *line)
{
    float least = FLT_MAX;
    for (int32_t i = 0; i < count; ++i) {
        const fe__clip_vertex *p = polygon + i, *q = polygon + (i + 1 < count ? i + 1 : 0);
        float du = q->u - p->u, dv = q->v - p->v, length = sqrtf(du * du + dv * dv);
        float inverse = length > 0.0f ? 1.0f / length : 0.0f;
        line[i] = (edge_line){-inverse * dv, inverse * du, inverse * (p->v * du - p->u * dv)};
        if (length > 0.0f) least = fe__minf(least, line[i].distance);
    }
    return least;
}

static int32_t is_over(const fe__clip_vertex *p, const edge_line *line, int32_t count, float slack)
{
    for (int32_t i = 0; i < count; ++i)
        if (line[i].u * p->u + line[i].v * p->v > line[i].distance + slack) return 0;
    return 1;
}

static int32_t whole_rim(const fe__disc *disc, float margin, fe__clip_vertex *out)
{
    float lean = sqrtf(disc->slope_u * disc->slope_u + disc->slope_v * disc->slope_v);
    int32_t count = disc->height + disc->radius * lean <= margin ? 4 : FE_RIM_POINTS;
    for (int32_t i = 0; i < count; ++i)
        out[i] = rim_point(disc, (disc->low + i * (FE_RIM_POINTS / count)) % FE_RIM_POINTS);
    return count;
}

int32_t fe__clip_disc(const fe__disc *disc, const fe__clip_vertex *polygon, int32_t count, float slack, float margin,
                      fe__clip_vertex out[FE_DISC_VERTICES])
{
    edge_line line[FE_FACE_VERTICES];
    if (count > 2 && find_lines(polygon, count, line) >= disc->radius - slack) return whole_rim(disc, margin, out);
    float reach = disc->radius + slack, square = reach * reach, outside[FE_FACE_VERTICES];
    int32_t left = 0, sides = count > 2 ? count : count - 1, some_outside = 0;
    for (int32_t i = 0; i < count; ++i) {
        outside[i] = outside_by(&polygon[i], square);
        some_outside |= outside[i] > 0.0f;
    }
    if (!some_outside) {
        memcpy(out, polygon, sizeof *polygon * (size_t)count);
        return count;
    }
    for (int32_t i = 0; i < count; ++i) {
        int32_t next = i + 1 < count ? i + 1 : 0;
        if (!(outside[i] > 0.0f)) out[left++] = polygon[i];
        if (i < sides && (outside[i] > 0.0f || outside[next] > 0.0f))
            left += cross_rim(&polygon[i], &polygon[next], outside[i], outside[next], i, out + left);
    }
    for (int32_t i = 0; i < FE_RIM_POINTS && count > 2; ++i) {
        fe__clip_vertex p = rim_point(disc, i);
        if (is_over(&p, line, count, slack)) out[left++] = p;
    }
    return left;
}

// ---- four of many --------------------------------------------------------------------------------------------------
static float apart(const fe__clip_vertex *p, const fe__clip_vertex *q)
{
    float du = p->u - q->u, dv = p->v - q->v;
    return sqrtf(du * du + dv * dv);
}

// Of those as deep as the deepest the one farthest from the middle: a vertex amid an edge must not stand for a corner.
static int32_t deepest(const fe__clip_vertex *p, int32_t count, float tie)
{
    fe__clip_vertex low = p[0], high = p[0];
    for (int32_t i = 1; i < count; ++i) {
        low.u = fe__minf(low.u, p[i].u), high.u = fe__maxf(high.u, p[i].u);
        low.v = fe__minf(low.v, p[i].v), high.v = fe__maxf(high.v, p[i].v);
        low.height = fe__minf(low.height, p[i].height);
    }
    fe__clip_vertex middle = {0.5f * (low.u + high.u), 0.5f * (low.v + high.v), low.height, 0};
    int32_t k = 0;
    float best = -1.0f;
    for (int32_t i = 0; i < count; ++i) {
        float distance = apart(&p[i], &middle);
        if (p[i].height <= low.height + tie && distance > best + tie) best = distance, k = i;
    }
    return k;
}

static int32_t farthest(const fe__clip_vertex *p, int32_t count, int32_t from, float tie)
{
    int32_t k = from;
    float best = 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        float distance = apart(&p[i], &p[from]);
        if (distance > best + tie) best = distance, k = i;
    }
    return k;
}

static int32_t is_among(const fe__clip_vertex *p, int32_t i, const int32_t *chosen, int32_t count, float tie)
{
    for (int32_t k = 0; k < count; ++k) {
        if (apart(&p[i], &p[chosen[k]]) <= tie) return 1;
    }
    return 0;
}

// What spans most may lie clear of the face and carry nothing: it gives way to a vertex below. Else of two that carry,
// side by side, now one is chosen and now the other, and the load swings between them.
static void keep_what_carries(const fe__clip_vertex *p, int32_t count, float tie, int32_t *chosen, int32_t chosen_count)
{
    const float clear = 0.001f; // m, a few overlaps of a body at rest
    float level = fe__maxf(p[chosen[0]].height + tie, 0.0f);
    for (int32_t i = 0; i < count; ++i) {
        if (p[i].height > level || is_among(p, i, chosen, chosen_count, tie)) continue;
        int32_t highest = 0;
        for (int32_t k = 1; k < chosen_count; ++k) {
            if (p[chosen[k]].height > p[chosen[highest]].height) highest = k;
        }
        if (p[chosen[highest]].height <= level + clear) return;
        chosen[highest] = i;
    }
}

int32_t fe__reduce_to_four(fe__clip_vertex *p, int32_t count, float tie)
{
    if (count <= 4) return count;
    int32_t first = deepest(p, count, tie), second = farthest(p, count, first, tie), left = first, right = first;
    float du = p[second].u - p[first].u, dv = p[second].v - p[first].v, step = tie * sqrtf(du * du + dv * dv),
          most = step, least = -step;
    for (int32_t i = 0; i < count; ++i) {
        float area = du * (p[i].v - p[first].v) - dv * (p[i].u - p[first].u);
        if (area > most) most = area + step, left = i;
        if (area < least) least = area - step, right = i;
    }
    int32_t four[4] = {first}, chosen = 1;
    if (second != first) four[chosen++] = second;
    if (left != first) four[chosen++] = left;
    if (right != first) four[chosen++] = right;
    keep_what_carries(p, count, tie, four, chosen);
    fe__clip_vertex kept[4];
    for (int32_t i = 0; i < chosen; ++i) kept[i] = p[four[i]];
    memcpy(p, kept, sizeof(fe__clip_vertex) * (size_t)chosen);
    return chosen;
}

int32_t fe__keep_near(fe__clip_vertex *p, int32_t count, float radii, float margin, float tie)
{
    int32_t near = 0;
    for (int32_t i = 0; i < count; ++i) {
        p[i].height -= radii;
        if (p[i].height <= margin) p[near++] = p[i];
    }
    return fe__reduce_to_four(p, near, tie);
}
