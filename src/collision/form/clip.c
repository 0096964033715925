// clip.c - cuts a face by another one, and chooses four of the vertices.
//
// box_box.c and convex.c give two faces in the plane of one of them and turn the vertices into contact points. The cut
// by a rectangle works on the four edges of the incident face side by side, without a branch (Liang and Barsky, 1984);
// the general cut is Sutherland and Hodgman's (1974). A disc cuts by its circle itself.
#define FE_W 4
#include "collision/form/clip.h"

#include "core/simd.h"

#include <float.h>
#include <string.h>

// ---- a parallelogram by a rectangle --------------------------------------------------------------------------------
static inline wide absolute(wide a) { return (wide)((wide_int)a & 0x7fffffff); }
static inline wide_int choose_int(wide_int mask, wide_int yes, wide_int no) { return (mask & yes) | (~mask & no); }
static inline uint32_t bits(wide_int mask)
{
#if FE_X86
    return (uint32_t)_mm_movemask_ps((__m128)mask);
#else
    return (uint32_t)((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
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

// Edge k runs from corner k to corner k + 1, around the parallelogram; so do the corners of the rectangle.
static const wide corner_i = {-1.0f, 1.0f, 1.0f, -1.0f}, corner_j = {-1.0f, -1.0f, 1.0f, 1.0f};
static const wide step_i = {2.0f, 0.0f, -2.0f, 0.0f}, step_j = {0.0f, 2.0f, 0.0f, -2.0f};

typedef struct cut_edges {
    lanes start, end;
    wide_int has_start, has_end; // The end is given only if the next edge does not give it as its start.
    // The rectangle's side that cuts there: 0 +u, 1 +v, 2 -u, 3 -v; -1: nothing cuts the start.
    wide_int side_start, side_end;
} cut_edges;

// The part of start + t step, 0 <= t <= 1, that lies in the rectangle. It is inside |u| <= h for t between
// (-h - u) / du and (h - u) / du, in either order. The du = 0 of an edge parallel to a side is replaced by one so small
// that the edge is inside for all t or for none.
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
// They have only half the slack, so that an edge that has just left the rectangle and a corner that has just left the
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

// ---- any polygon by a convex one -----------------------------------------------------------------------------------
// Keeps the vertices with inside >= 0 and adds the crossings of the edges with the line of side number `side`. A
// polygon is closed, a segment or a point is not.
static int32_t cut_polygon(const fe__clip_vertex *in, const float *inside, int32_t count, int32_t closed, int32_t side,
                           fe__clip_vertex *out)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; ++i) {
        int32_t previous = i > 0 ? i - 1 : count - 1;
        if ((closed || i > 0) && (inside[previous] < 0.0f) != (inside[i] < 0.0f)) {
            const fe__clip_vertex *p = &in[previous], *q = &in[i];
            float t = inside[previous] / (inside[previous] - inside[i]);
            int32_t edge = (int32_t)(p->id & 0xff); // the edge from p to q
            uint32_t id = inside[previous] > inside[i] ? fe__clip_id(edge, FE_CLIP_SIDE + side)
                                                       : fe__clip_id(FE_CLIP_SIDE + side, edge);
            out[left++] = (fe__clip_vertex){p->u + t * (q->u - p->u), p->v + t * (q->v - p->v),
                                            p->height + t * (q->height - p->height), id};
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
    for (int32_t side = 0; side < reference_count && count > 0; ++side) {
        const fe__clip_vertex *p = &reference[side], *q = &reference[(side + 1) % reference_count];
        float du = q->u - p->u, dv = q->v - p->v, inverse = 1.0f / sqrtf(du * du + dv * dv);
        du *= inverse, dv *= inverse;
        int32_t all_inside = 1;
        for (int32_t i = 0; i < count; ++i) {
            inside[i] = du * (in[i].v - p->v) - dv * (in[i].u - p->u) + slack;
            all_inside &= inside[i] >= 0.0f;
        }
        if (all_inside) continue;
        count = cut_polygon(in, inside, count, closed, side, out);
        fe__clip_vertex *swap = in;
        in = out, out = swap;
    }
    if (in != incident) memcpy(incident, in, sizeof(fe__clip_vertex) * (size_t)count);
    return count;
}

// ---- a polygon by a disc -------------------------------------------------------------------------------------------
// The points where the edge from p to q enters the disc and where it leaves: |p + t d|^2 = r^2. p_out and q_out are
// the squares of the ends' distances from the disc's centre, less r^2: above 0 outside.
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
    const float *at = fe__rim_points[disc->pattern == FE_RIM_AIMED][i];
    float u = disc->radius * at[0], v = disc->radius * at[1];
    int32_t name = FE_CLIP_SIDE + i + (disc->pattern == FE_RIM_AIMED ? FE_RIM_POINTS : 0);
    return (fe__clip_vertex){u, v, disc->height + disc->slope_u * u + disc->slope_v * v, fe__clip_id(name, name)};
}

// The line of a polygon's edge: its unit normal points out of the polygon, its distance counts from the disc's centre.
typedef struct edge_line {
    float u, v, distance;
} edge_line;

// Returns the least distance of the edges from the disc's centre, below 0 if that is outside.
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

// A disc wholly over the polygon: all of its points or, if none is above the margin, four that hold it.
static int32_t whole_rim(const fe__disc *disc, float margin, fe__clip_vertex *out)
{
    // An aimed rim is held by the two points in front, and those 127 degrees from them.
    static const int32_t aimed[4] = {0, 1, 6, 11};
    float lean = sqrtf(disc->slope_u * disc->slope_u + disc->slope_v * disc->slope_v);
    int32_t few = disc->height + disc->radius * lean <= margin, count = few ? 4 : FE_RIM_POINTS;
    for (int32_t i = 0; i < count; ++i) {
        int32_t from_low = (disc->low + i * (FE_RIM_POINTS / count)) % FE_RIM_POINTS;
        out[i] = rim_point(disc, few && disc->pattern == FE_RIM_AIMED ? aimed[i] : from_low);
    }
    return count;
}

int32_t fe__clip_disc(const fe__disc *disc, const fe__clip_vertex *polygon, int32_t count, float slack, float margin,
                      fe__clip_vertex out[FE_DISC_VERTICES])
{
    edge_line line[FE_FACE_VERTICES];
    if (count > 2 && find_lines(polygon, count, line) >= disc->radius - slack) return whole_rim(disc, margin, out);
    float widened = disc->radius + slack, square = widened * widened, outside[FE_FACE_VERTICES];
    int32_t left = 0, sides = count > 2 ? count : count - 1, some_outside = 0;
    for (int32_t i = 0; i < count; ++i) {
        outside[i] = polygon[i].u * polygon[i].u + polygon[i].v * polygon[i].v - square;
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
        int32_t k = 0;
        while (k < count && !(line[k].u * p.u + line[k].v * p.v > line[k].distance + slack)) ++k;
        if (k == count) out[left++] = p; // no edge has it outside
    }
    return left;
}

// ---- the four that the load leans over -----------------------------------------------------------------------------
static float apart(const fe__clip_vertex *p, const fe__clip_vertex *q)
{
    float du = p->u - q->u, dv = p->v - q->v;
    return sqrtf(du * du + dv * dv);
}

static int32_t is_among(const fe__clip_vertex *p, int32_t i, const int32_t *chosen, int32_t count, float tie)
{
    for (int32_t k = 0; k < count; ++k) {
        if (apart(&p[i], &p[chosen[k]]) <= tie) return 1;
    }
    return 0;
}

// The way in which the load leans: from the middle (u, v) of the low vertices along (du, dv) to the foot.
typedef struct lean_way {
    float u, v, du, dv, square; // square: of the length of (du, dv)
} lean_way;

// How far p is along the way and how far to its left, both times the way's length.
static float ahead_of(const lean_way *way, const fe__clip_vertex *p)
{
    return way->du * (p->u - way->u) + way->dv * (p->v - way->v);
}
static float left_of(const lean_way *way, const fe__clip_vertex *p)
{
    return way->du * (p->v - way->v) - way->dv * (p->u - way->u);
}

// How far along the way the line from a vertex on its left to one on its right crosses it, times its length.
static float crossing_of(const lean_way *way, const fe__clip_vertex *a, const fe__clip_vertex *b)
{
    float left = left_of(way, a), right = -left_of(way, b), width = left + right;
    if (!(width > 0.0f)) return fe__minf(ahead_of(way, a), ahead_of(way, b));
    return (right * ahead_of(way, a) + left * ahead_of(way, b)) / width;
}

// The vertex up to `level` on the left, or on the right, whose line with `other` crosses the way farthest out; of
// several on one line the one farthest aside. Without `other` it is the vertex farthest out. -1: that side has none
static int32_t farthest_out(const lean_way *way, const fe__clip_vertex *p, int32_t count, float level, int32_t is_left,
                            const fe__clip_vertex *other, float tie)
{
    int32_t best = -1;
    float most = 0.0f, aside = 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        float left = left_of(way, &p[i]);
        if (p[i].height > level || (left >= 0.0f) != is_left) continue;
        float out = !other    ? ahead_of(way, &p[i])
                    : is_left ? crossing_of(way, &p[i], other)
                              : crossing_of(way, other, &p[i]);
        int32_t is_wider = fe__absf(left) > aside + tie && out > most - tie;
        if (best < 0 || out > most + tie || is_wider) most = out, aside = fe__absf(left), best = i;
    }
    return best;
}

// Finds the edge of the low vertices' convex hull that the way crosses: from the tangents on either side to their
// common one (Preparata and Hong, 1977). Returns the foot's share of the way to that edge, 0: there is no edge
static float find_front(const lean_way *way, const fe__clip_vertex *p, int32_t count, float level, float tie,
                        int32_t front[2])
{
    front[0] = front[1] = -1;
    float equal = tie * sqrtf(way->square);
    int32_t a = farthest_out(way, p, count, level, 1, NULL, equal);
    int32_t b = farthest_out(way, p, count, level, 0, NULL, equal);
    if (a < 0 || b < 0) return 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        int32_t left = farthest_out(way, p, count, level, 1, &p[b], equal);
        int32_t right = farthest_out(way, p, count, level, 0, &p[left], equal);
        if (left == a && right == b) break;
        a = left, b = right;
    }
    float crossing = crossing_of(way, &p[a], &p[b]);
    front[0] = a, front[1] = b;
    return crossing > 0.0f ? way->square / crossing : 0.0f;
}

// The vertex farthest along a direction, given by cosine and sine of its angle left of the way. It is the lowest one if
// the face is tilted that way by `tilt`, which is more than the face leans.
static int32_t farthest_along(const lean_way *way, const fe__clip_vertex *p, int32_t count, const float direction[2],
                              float tie)
{
    const float tilt = 0.05f;
    int32_t best = 0;
    float most = -FLT_MAX, per_length = 1.0f / sqrtf(way->square);
    for (int32_t i = 0; i < count; ++i) {
        float along = per_length * (direction[0] * ahead_of(way, &p[i]) + direction[1] * left_of(way, &p[i]));
        along -= p[i].height / tilt;
        if (along > most + tie) most = along, best = i;
    }
    return best;
}

// If the way passes the front near one of its ends, the edge beyond that end bears as soon as the load shifts by
// little. Its other end is chosen too, or the points would change from side to side, and each would come in sunk.
// Returns the number of vertices chosen, 2 or 3.
static int32_t turn_corner(const lean_way *way, const fe__clip_vertex *p, int32_t count, float level, float tie,
                           int32_t four[4])
{
    const float near_end = 0.25f, beyond = 0.05f; // shares of the front's length
    float left = left_of(way, &p[four[0]]), right = -left_of(way, &p[four[1]]), width = left + right;
    int32_t end = left < right ? 0 : 1, next[2];
    if (!(fe__minf(left, right) < near_end * width)) return 2;
    const fe__clip_vertex *a = p + four[end], *b = p + four[1 - end];
    lean_way past_end = {.u = way->u, .v = way->v};
    past_end.du = a->u + beyond * (a->u - b->u) - way->u, past_end.dv = a->v + beyond * (a->v - b->v) - way->v;
    past_end.square = past_end.du * past_end.du + past_end.dv * past_end.dv;
    find_front(&past_end, p, count, level, tie, next);
    if (next[1 - end] != four[end] || is_among(p, next[end], four, 2, tie)) return 2;
    four[2] = next[end];
    return 3;
}

// Chooses the edge in front of the load and two vertices behind. Returns their number, 0: the load does not lean. A
// face that rocks another way, or a body that stands on no face, leaves nothing out.
static int32_t choose_by_foot(const fe__clip_vertex *p, int32_t count, float low, float level, float tie,
                              const fe__foot *foot, int32_t four[4], int32_t *left_out)
{
    float u = 0.0f, v = 0.0f;
    int32_t low_count = 0, front[2];
    for (int32_t i = 0; i < count; ++i)
        if (p[i].height <= level) u += p[i].u, v += p[i].v, ++low_count;
    if (low_count < 3) return 0;
    float share = foot->from_origin ? 0.0f : 1.0f / (float)low_count;
    lean_way way = {.u = share * u, .v = share * v};
    way.du = foot->u - way.u, way.dv = foot->v - way.v, way.square = way.du * way.du + way.dv * way.dv;

    float out = find_front(&way, p, count, level, tie, front);
    if (!(out > FE__FOOT_LEAST)) return 0;
    float high = fe__maxf(p[front[0]].height, p[front[1]].height);
    if (high > low + fe__most_lean(sqrtf(way.square) / out)) {
        *left_out = FE_LEFT_NONE;
        return 0;
    }
    *left_out = FE_LEFT_SIDES;
    four[0] = front[0], four[1] = front[1];
    int32_t chosen = turn_corner(&way, p, count, level, tie, four), has_corner = chosen == 3;
    // The directions 120 degrees to either side of the way: with the front they keep half of a disc's radius on every
    // side of its middle. If the front is the longest chord, the vertex farthest behind it is taken.
    static const float behind[3][2] = {{-0.5f, 0.8660254f}, {-0.5f, -0.8660254f}, {-1.0f, 0.0f}};
    for (int32_t k = has_corner ? 2 : 0; k < 3 && chosen < 4; ++k) {
        int32_t i = farthest_along(&way, p, count, behind[k], tie);
        if (!is_among(p, i, four, chosen, tie)) four[chosen++] = i;
    }
    // A vertex deeper than the edge in front carries too: it takes the place of the higher one behind. The other one
    // behind stays, or a body that rocks would fall back onto nothing.
    if (!has_corner && chosen == 4 && !(fe__minf(p[four[0]].height, p[four[1]].height) <= low + tie)) {
        int32_t deepest = 0;
        for (int32_t i = 1; i < count; ++i)
            if (p[i].height < p[deepest].height) deepest = i;
        if (!is_among(p, deepest, four, chosen, tie)) four[p[four[2]].height > p[four[3]].height ? 2 : 3] = deepest;
    }
    return chosen;
}

// ---- the four that span most ---------------------------------------------------------------------------------------
// The bounding box of the vertices; the height of its upper corner is not set.
typedef struct bounds {
    fe__clip_vertex low, high;
} bounds;

// The deepest vertex, the one farthest from it, and those that span most area on either side of the line through both.
// Of several that are as deep as the deepest, the one farthest from the middle counts: one amid an edge must not stand
// for a corner.
static int32_t choose_widest(const fe__clip_vertex *p, int32_t count, const bounds *box, float tie, int32_t four[4])
{
    fe__clip_vertex middle = {0.5f * (box->low.u + box->high.u), 0.5f * (box->low.v + box->high.v), box->low.height, 0};
    float farthest = -1.0f;
    int32_t first = 0;
    for (int32_t i = 0; i < count; ++i) {
        float distance = apart(&p[i], &middle);
        if (p[i].height <= box->low.height + tie && distance > farthest + tie) farthest = distance, first = i;
    }
    int32_t second = first, left = first, right = first;
    farthest = 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        float distance = apart(&p[i], &p[first]);
        if (distance > farthest + tie) farthest = distance, second = i;
    }
    float du = p[second].u - p[first].u, dv = p[second].v - p[first].v, step = tie * sqrtf(du * du + dv * dv),
          most = step, least = -step;
    for (int32_t i = 0; i < count; ++i) {
        float area = du * (p[i].v - p[first].v) - dv * (p[i].u - p[first].u);
        if (area > most) most = area + step, left = i;
        if (area < least) least = area - step, right = i;
    }
    int32_t chosen = 1;
    four[0] = first;
    if (second != first) four[chosen++] = second;
    if (left != first) four[chosen++] = left;
    if (right != first) four[chosen++] = right;
    return chosen;
}

// A vertex that spans most may lie clear of the face and carry nothing: it gives way to a vertex below. Otherwise, of
// two that carry side by side, the choice alternates, and the load swings between them.
static void keep_what_carries(const fe__clip_vertex *p, int32_t count, float tie, int32_t *chosen, int32_t chosen_count)
{
    float level = fe__maxf(p[chosen[0]].height + tie, 0.0f);
    for (int32_t i = 0; i < count; ++i) {
        if (p[i].height > level || is_among(p, i, chosen, chosen_count, tie)) continue;
        int32_t highest = 0;
        for (int32_t k = 1; k < chosen_count; ++k) {
            if (p[chosen[k]].height > p[chosen[highest]].height) highest = k;
        }
        if (p[chosen[highest]].height <= level + FE__CLEAR) return;
        chosen[highest] = i;
    }
}

// Do the low ones among the chosen vertices hold the foot? Two of them are an edge if all others lie on one side of
// their line. The foot must lie on that side of each edge, by its share of the distance of their middle.
static int32_t hold(const fe__clip_vertex *p, const int32_t *chosen, int32_t count, float level, const fe__foot *foot)
{
    const fe__clip_vertex *low[4];
    int32_t n = 0;
    for (int32_t i = 0; i < count; ++i)
        if (p[chosen[i]].height <= level) low[n++] = p + chosen[i];
    if (n < 3) return 0;
    float share = (1.0f - (foot->last.left_out < FE_LEFT_SIDES ? FE__FOOT_MOST : FE__FOOT_BACK)) / (float)n;
    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = i + 1; j < n; ++j) {
            float du = low[j]->u - low[i]->u, dv = low[j]->v - low[i]->v, right = 0.0f, left = 0.0f;
            for (int32_t k = 0; k < n; ++k) {
                if (k == i || k == j) continue;
                float off = du * (low[k]->v - low[i]->v) - dv * (low[k]->u - low[i]->u);
                right += fe__minf(off, 0.0f), left += fe__maxf(off, 0.0f);
            }
            float off = du * (foot->v - low[i]->v) - dv * (foot->u - low[i]->u);
            if (!(right < 0.0f) && off < share * left) return 0;
            if (!(left > 0.0f) && off > share * right) return 0;
        }
    return 1;
}

// ---- the choice ----------------------------------------------------------------------------------------------------
// Takes the last choice if it was of the widest four. 0: some are gone, or clear of the face, or do not hold the foot
static int32_t choose_again(const fe__clip_vertex *p, int32_t count, const bounds *box, float level, float tie,
                            const fe__foot *foot, int32_t four[4])
{
    const fe__choice *last = &foot->last;
    float carries = fe__maxf(box->low.height + tie, 0.0f) + FE__CLEAR;
    int32_t found = 0;
    if (last->left_out >= FE_LEFT_SIDES) return 0;
    for (int32_t k = 0; k < last->count; ++k)
        for (int32_t i = 0; i < count; ++i) {
            if (p[i].id != last->ids[k]) continue;
            if (p[i].height > carries) return 0;
            four[found++] = i;
            break;
        }
    if (found < 3 || found < last->count) return 0;
    return !foot->is_known || hold(p, four, found, level, foot) ? found : 0;
}

int32_t fe__reduce_to_four(fe__clip_vertex *p, int32_t count, float tie, const fe__foot *foot, int32_t *left_out)
{
    if (count <= 4) return count;
    bounds box = {p[0], p[0]};
    for (int32_t i = 1; i < count; ++i) {
        box.low.u = fe__minf(box.low.u, p[i].u), box.high.u = fe__maxf(box.high.u, p[i].u);
        box.low.v = fe__minf(box.low.v, p[i].v), box.high.v = fe__maxf(box.high.v, p[i].v);
        box.low.height = fe__minf(box.low.height, p[i].height);
    }
    float low = fe__maxf(box.low.height, 0.0f),
          level = low + fe__most_lean(fe__maxf(box.high.u - box.low.u, box.high.v - box.low.v));
    int32_t four[4], chosen = 0, low_count = 0;
    if (foot) {
        for (int32_t i = 0; i < count; ++i) low_count += p[i].height <= level;
        *left_out = low_count > 4 ? FE_LEFT_SOME : FE_LEFT_NONE;
        if (low_count > 4) chosen = choose_again(p, count, &box, level, tie, foot, four);
    }
    if (!chosen) {
        chosen = choose_widest(p, count, &box, tie, four);
        keep_what_carries(p, count, tie, four, chosen);
        if (low_count > 4 && foot->is_known && (foot->is_aimed || !hold(p, four, chosen, level, foot))) {
            int32_t by_foot[4], n = choose_by_foot(p, count, low, level, tie, foot, by_foot, left_out);
            if (n) memcpy(four, by_foot, sizeof four), chosen = n;
        }
    }
    fe__clip_vertex kept[4];
    for (int32_t i = 0; i < chosen; ++i) kept[i] = p[four[i]];
    memcpy(p, kept, sizeof(fe__clip_vertex) * (size_t)chosen);
    return chosen;
}

int32_t fe__keep_near(fe__clip_vertex *p, int32_t count, float radii, float margin, float tie, const fe__foot *foot,
                      int32_t *left_out)
{
    int32_t near = 0;
    for (int32_t i = 0; i < count; ++i) {
        p[i].height -= radii;
        if (p[i].height <= margin) p[near++] = p[i];
    }
    return fe__reduce_to_four(p, near, tie, foot, left_out);
}
