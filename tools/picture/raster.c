// raster.c - see raster.h. Corners are rounded to 1/256 of a sample; from there on all is exact.
#include "raster.h"

// An edge: inside is where k - dy x >= 0, with k that changes by dx from row to row. Units are those of RASTER_ONE.
typedef struct edge {
    int64_t k, step, dy;
} edge;

static int64_t floor_divide(int64_t a, int64_t b) // b > 0
{
    int64_t q = a / b;
    return q - (a % b < 0);
}

// E(x, y) = (bx - ax) (y - ay) - (by - ay) (x - ax), at centres x = 256 i + 128, y = 256 j + 128. A sample on an edge
// belongs to the triangle whose upper or left edge it is.
static edge make_edge(const int64_t a[2], const int64_t b[2], int64_t first_row)
{
    int64_t dx = b[0] - a[0], dy = b[1] - a[1], half = RASTER_ONE / 2;
    int owns = dy < 0 || (dy == 0 && dx > 0);
    edge e = {dx * (RASTER_ONE * first_row + half - a[1]) - dy * (half - a[0]) - !owns, dx * RASTER_ONE,
              dy * RASTER_ONE};
    return e;
}

// Narrows [begin, end) to where the edge's inside is
static void cut(const edge *e, int64_t *begin, int64_t *end)
{
    if (e->dy > 0) {
        int64_t last = floor_divide(e->k, e->dy);
        if (last + 1 < *end) *end = last + 1;
    } else if (e->dy < 0) {
        int64_t first = -floor_divide(e->k, -e->dy);
        if (first > *begin) *begin = first;
    } else if (e->k < 0) {
        *end = *begin;
    }
}

// 0: too far out
static int round_corners(const raster_point corners[3], int64_t out[3][2])
{
    for (int i = 0; i < 3; ++i) {
        double x = corners[i].x * RASTER_ONE, y = corners[i].y * RASTER_ONE;
        if (!(x > -RASTER_REACH && x < RASTER_REACH && y > -RASTER_REACH && y < RASTER_REACH)) return 0;
        out[i][0] = (int64_t)(x + 0.5 + RASTER_REACH) - RASTER_REACH; // rounds down below 0 too
        out[i][1] = (int64_t)(y + 0.5 + RASTER_REACH) - RASTER_REACH;
    }
    return 1;
}

void raster_triangle(const raster_point corners[3], raster_area area, raster_row *tell, void *user)
{
    int64_t p[3][2];
    if (!round_corners(corners, p)) return;
    int64_t twice = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    if (twice == 0) return;
    const int64_t *b = twice > 0 ? p[1] : p[2], *c = twice > 0 ? p[2] : p[1];
    int64_t low = p[0][1], high = p[0][1], left = p[0][0], right = p[0][0];
    for (int i = 1; i < 3; ++i) {
        low = p[i][1] < low ? p[i][1] : low, high = p[i][1] > high ? p[i][1] : high;
        left = p[i][0] < left ? p[i][0] : left, right = p[i][0] > right ? p[i][0] : right;
    }
    const int64_t half = RASTER_ONE / 2;
    int64_t first = floor_divide(low - half, RASTER_ONE), last = floor_divide(high - half, RASTER_ONE);
    int64_t leftmost = floor_divide(left - half, RASTER_ONE), rightmost = floor_divide(right - half, RASTER_ONE) + 1;
    first = first < area.top ? area.top : first, last = last >= area.end ? area.end - 1 : last;
    leftmost = leftmost < 0 ? 0 : leftmost, rightmost = rightmost > area.width ? area.width : rightmost;
    edge edges[3] = {make_edge(p[0], b, first), make_edge(b, c, first), make_edge(c, p[0], first)};
    for (int64_t row = first; row <= last; ++row) {
        int64_t begin = leftmost, end = rightmost;
        for (int i = 0; i < 3; ++i) cut(edges + i, &begin, &end), edges[i].k += edges[i].step;
        if (begin < end) tell(user, (int32_t)row, (int32_t)begin, (int32_t)end);
    }
}

// ---- layers --------------------------------------------------------------------------------------------------------
typedef struct brush {
    layer *to;
    const layer_plane *depth;
    int32_t owner;
} brush;

// Without a branch, so that compilers compute several samples at once
static inline void keep_nearest(const brush *b, int32_t row, int32_t begin, int32_t end, int with_owner)
{
    const layer_plane *p = b->depth;
    const int64_t at = area_at(&b->to->area, begin, row);
    const int32_t count = end - begin, number = b->owner;
    const float start = (float)(p->a * (begin + 0.5) + p->b * (row + 0.5) + p->c), step = (float)p->a;
    const float least = (float)p->least, most = (float)p->most;
    float *near = b->to->near + at;
    int32_t *owner = with_owner ? b->to->owner + at : 0;
    for (int32_t i = 0; i < count; ++i) {
        float depth = start + step * (float)i;
        depth = depth < least ? least : depth;
        depth = depth > most ? most : depth;
        if (with_owner) owner[i] = depth > near[i] ? number : owner[i];
        near[i] = depth > near[i] ? depth : near[i];
    }
}

static void keep_depth(void *user, int32_t row, int32_t begin, int32_t end) { keep_nearest(user, row, begin, end, 0); }

static void keep_depth_and_owner(void *user, int32_t row, int32_t begin, int32_t end)
{
    keep_nearest(user, row, begin, end, 1);
}

void layer_draw(layer *to, const raster_point corners[3], const layer_plane *depth, int32_t owner)
{
    brush b = {to, depth, owner};
    raster_triangle(corners, to->area, to->owner ? keep_depth_and_owner : keep_depth, &b);
}
