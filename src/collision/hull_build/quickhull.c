// quickhull.c - points are added to the surface, the farthest first. See surface.h.
#include "collision/hull_build/surface.h"

// A point that is less high, in steps of the grid, counts as inside: rounding to the grid moved it farther.
static const double least_height = 0.25;

// ---- triangles -----------------------------------------------------------------------------------------------------
int32_t fe__surface_new_triangle(fe__hull_surface *s, int32_t a, int32_t b, int32_t c)
{
    int32_t i = s->free_count ? s->free_triangles[--s->free_count] : s->triangle_end++;
    fe__surface_triangle *t = &s->triangles[i];
    *t = (fe__surface_triangle){.farthest = -1, .first_point = -1, .corner = {a, b, c}, .alive = 1};
    fe__grid_plane_through(fe__vertex_on_grid(s, a), fe__vertex_on_grid(s, b), fe__vertex_on_grid(s, c), &t->plane);
    for (int32_t k = 0; k < 3; ++k) s->degree[t->corner[k]] += 1;
    return i;
}

void fe__surface_join(fe__hull_surface *s, int32_t edge, int32_t twin)
{
    s->triangles[edge / 3].twin[edge % 3] = twin;
    s->triangles[twin / 3].twin[twin % 3] = edge;
}

// A vertex without triangles is inside: its place is free again.
static void free_triangle(fe__hull_surface *s, int32_t i)
{
    fe__surface_triangle *t = &s->triangles[i];
    t->alive = 0;
    s->free_triangles[s->free_count++] = i;
    for (int32_t k = 0; k < 3; ++k) {
        int32_t vertex = t->corner[k];
        s->degree[vertex] -= 1;
        if (s->degree[vertex]) continue;
        s->point[vertex] = -1;
        s->vertex_count -= 1;
    }
}

// ---- points outside ------------------------------------------------------------------------------------------------
// Of points of one height that farther from the middle is the farthest, see simplex.c.
static int32_t is_farther(const fe__cloud *cloud, int32_t a, int32_t b)
{
    return fe__ddot(cloud->grid[a], cloud->grid[a]) > fe__ddot(cloud->grid[b], cloud->grid[b]);
}

static void wait_at(fe__hull_surface *s, int32_t triangle, int32_t point, double height)
{
    fe__surface_triangle *t = &s->triangles[triangle];
    s->next_point[point] = t->first_point;
    t->first_point = point;
    if (t->farthest >= 0 && height < t->farthest_height) return;
    if (t->farthest >= 0 && height == t->farthest_height && !is_farther(s->cloud, point, t->farthest)) return;
    t->farthest = point;
    t->farthest_height = height;
}

void fe__surface_choose_among(fe__hull_surface *s, const int32_t *triangles, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        const fe__grid_plane *plane = &s->triangles[triangles[i]].plane;
        s->faces[i] = (fe__surface_face){plane->unit, plane->offset};
    }
}

void fe__surface_give(fe__hull_surface *s, int32_t point, const int32_t *triangles, int32_t count)
{
    fe_dvec3 p = s->cloud->grid[point];
    double best = least_height;
    int32_t at = -1;
    for (int32_t i = 0; i < count; ++i) {
        double height = fe__ddot(s->faces[i].unit, p) - s->faces[i].offset;
        if (height <= best) continue;
        best = height;
        at = i;
    }
    if (at >= 0) wait_at(s, triangles[at], point, best);
}

// ---- adding a point ------------------------------------------------------------------------------------------------
// All that the point sees is connected: from one such triangle over the edges to the next. `seen` is the stack as well.
static void find_seen(fe__hull_surface *s, int32_t first, fe_dvec3 p)
{
    s->seen_count = 0;
    s->seen[s->seen_count++] = first;
    s->triangles[first].seen = 1;
    for (int32_t i = 0; i < s->seen_count; ++i) {
        for (int32_t k = 0; k < 3; ++k) {
            int32_t next = s->triangles[s->seen[i]].twin[k] / 3;
            if (s->triangles[next].seen || fe__grid_side(&s->triangles[next].plane, p) <= 0) continue;
            s->triangles[next].seen = 1;
            s->seen[s->seen_count++] = next;
        }
    }
}

// A triangle from each edge of the rim to the new vertex. None is flat: the line of an edge of the rim lies in a plane
// that the point is above.
static void make_fan(fe__hull_surface *s, int32_t vertex)
{
    s->fan_count = 0;
    for (int32_t i = 0; i < s->seen_count; ++i) {
        for (int32_t k = 0; k < 3; ++k) {
            int32_t edge = 3 * s->seen[i] + k, twin = fe__edge_twin(s, edge);
            if (s->triangles[twin / 3].seen) continue;
            int32_t from = fe__edge_start(s, edge), to = fe__edge_end(s, edge);
            int32_t triangle = fe__surface_new_triangle(s, from, to, vertex);
            fe__surface_join(s, 3 * triangle, twin);
            s->fan[s->fan_count++] = triangle;
            s->fan_from[from] = triangle;
        }
    }
    for (int32_t i = 0; i < s->fan_count; ++i) {
        int32_t next = s->fan_from[s->triangles[s->fan[i]].corner[1]];
        fe__surface_join(s, 3 * s->fan[i] + 1, 3 * next + 2);
    }
}

static void give_again(fe__hull_surface *s, int32_t triangle, int32_t but)
{
    for (int32_t i = s->triangles[triangle].first_point, next; i >= 0; i = next) {
        next = s->next_point[i];
        if (i != but) fe__surface_give(s, i, s->fan, s->fan_count);
    }
}

static int32_t free_vertex(const fe__hull_surface *s)
{
    int32_t vertex = 0;
    while (s->point[vertex] >= 0) ++vertex;
    return vertex;
}

static void add_farthest(fe__hull_surface *s, int32_t triangle)
{
    int32_t point = s->triangles[triangle].farthest, vertex = free_vertex(s);
    s->point[vertex] = point;
    s->vertex_count += 1;
    find_seen(s, triangle, s->cloud->grid[point]);
    make_fan(s, vertex);
    fe__surface_choose_among(s, s->fan, s->fan_count);
    for (int32_t i = 0; i < s->seen_count; ++i) give_again(s, s->seen[i], point);
    for (int32_t i = 0; i < s->seen_count; ++i) free_triangle(s, s->seen[i]);
}

// ---- the whole -----------------------------------------------------------------------------------------------------
static int32_t highest_triangle(const fe__hull_surface *s)
{
    int32_t best = -1;
    for (int32_t i = 0; i < s->triangle_end; ++i) {
        const fe__surface_triangle *t = &s->triangles[i];
        if (!t->alive || t->farthest < 0) continue;
        if (best < 0 || t->farthest_height > s->triangles[best].farthest_height) best = i;
    }
    return best;
}

// Gives all points that wait to the triangle of the whole surface that they are highest above.
static void look_at_all(fe__hull_surface *s)
{
    int32_t living = 0, waiting = -1, all[FE__SURFACE_TRIANGLES];
    for (int32_t i = 0; i < s->triangle_end; ++i) {
        fe__surface_triangle *t = &s->triangles[i];
        if (!t->alive) continue;
        all[living++] = i;
        for (int32_t p = t->first_point, next; p >= 0; p = next) {
            next = s->next_point[p];
            s->next_point[p] = waiting;
            waiting = p;
        }
        t->first_point = t->farthest = -1;
        t->farthest_height = 0.0;
    }
    fe__surface_choose_among(s, all, living);
    for (int32_t p = waiting, next; p >= 0; p = next) {
        next = s->next_point[p];
        fe__surface_give(s, p, all, living);
    }
}

void fe__surface_grow(fe__hull_surface *s)
{
    for (int32_t looked = 0;;) {
        int32_t highest = highest_triangle(s);
        double height = highest < 0 ? 0.0 : s->triangles[highest].farthest_height;
        int32_t is_done = highest < 0 || height <= s->tolerance || s->vertex_count >= s->most_vertices;
        s->error = height;
        if (is_done && looked) return;
        if (is_done)
            look_at_all(s);
        else
            add_farthest(s, highest);
        looked = is_done;
    }
}
