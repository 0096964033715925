// quickhull.c - points are added to the surface, the farthest first. See hull_surface.h.
#include "collision/hull_build/hull_surface.h"
#include "core/lanes.h"

// ---- quickhull ------------------------------------------------------------------------------------------------------

// A point that is less high, in steps of the grid, counts as inside: rounding to the grid moved it farther.
static const double least_height = 0.25;

// ---- triangles -----------------------------------------------------------------------------------------------------
int32_t fe__surface_new_triangle(fe__hull_surface *s, int32_t a, int32_t b, int32_t c)
{
    int32_t i = s->free_count ? s->free_triangles[--s->free_count] : s->triangle_end++;
    fe__surface_triangle *t = &s->triangles[i];
    t->farthest = t->first_point = -1;
    t->corner[0] = a, t->corner[1] = b, t->corner[2] = c;
    t->alive = 1, t->seen = 0;
    s->height[i] = 0.0;
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
    s->height[i] = 0.0;
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
// Of points of one height that farther from the middle is the farthest, see quickhull.c.
static int32_t is_farther(const fe__cloud *cloud, int32_t a, int32_t b)
{
    return fe__ddot(cloud->grid[a], cloud->grid[a]) > fe__ddot(cloud->grid[b], cloud->grid[b]);
}

static void wait_at(fe__hull_surface *s, int32_t triangle, int32_t point, double height)
{
    fe__surface_triangle *t = &s->triangles[triangle];
    s->next_point[point] = t->first_point;
    t->first_point = point;
    if (height < s->height[triangle]) return;
    if (height == s->height[triangle] && !is_farther(s->cloud, point, t->farthest)) return;
    t->farthest = point;
    s->height[triangle] = height;
}

void fe__surface_choose_among(fe__hull_surface *s, const int32_t *triangles, int32_t count)
{
    fe__surface_planes *planes = &s->planes;
    for (int32_t i = 0; i < count; ++i) {
        const fe__grid_plane *plane = &s->triangles[triangles[i]].plane;
        planes->x[i] = plane->unit.x, planes->y[i] = plane->unit.y, planes->z[i] = plane->unit.z;
        planes->offset[i] = plane->offset;
    }
    if (count % 2 == 0) return;
    planes->x[count] = planes->y[count] = planes->z[count] = 0.0;
    planes->offset[count] = (double)INFINITY; // nothing is above it
}

// Which plane is above is a guess as good as any: nothing branches on it.
void fe__surface_give(fe__hull_surface *s, int32_t point, const int32_t *triangles, int32_t count)
{
    const fe__doubles *px = (const fe__doubles *)s->planes.x, *py = (const fe__doubles *)s->planes.y,
                      *pz = (const fe__doubles *)s->planes.z, *offset = (const fe__doubles *)s->planes.offset;
    fe_dvec3 p = s->cloud->grid[point];
    const fe__doubles x = {p.x, p.x}, y = {p.y, p.y}, z = {p.z, p.z};
    fe__doubles best = {least_height, least_height};
    fe__doubles_int at = {-1, -1}, number = {0, 1};
    for (int32_t i = 0; i < (count + 1) / 2; ++i, number += 2) {
        fe__doubles height = px[i] * x + py[i] * y + pz[i] * z - offset[i];
        fe__doubles_int is_higher = height > best;
        best = fe__doubles_max(height, best);
        at = (is_higher & number) | (~is_higher & at);
    }
    int32_t second = best[1] > best[0] || (best[1] == best[0] && at[1] < at[0]);
    int64_t highest = second ? at[1] : at[0];
    if (highest >= 0) wait_at(s, triangles[highest], point, second ? best[1] : best[0]);
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
    double most = 0.0;
    for (int32_t i = 0; i < s->triangle_end; ++i)
        if (s->height[i] > most) most = s->height[i], best = i;
    return best;
}

// The points that wait, taken from their triangles: those of a triangle follow each other, the last triangle's first.
static int32_t take_waiting(fe__hull_surface *s, int32_t *counts)
{
    int32_t waiting = -1;
    for (int32_t i = 0; i < s->triangle_end; ++i) {
        fe__surface_triangle *t = &s->triangles[i];
        counts[i] = 0;
        if (!t->alive) continue;
        for (int32_t p = t->first_point, next; p >= 0; p = next) {
            next = s->next_point[p];
            s->next_point[p] = waiting;
            waiting = p;
            counts[i] += 1;
        }
        t->first_point = t->farthest = -1;
        s->height[i] = 0.0;
    }
    return waiting;
}

typedef struct look {
    int32_t met[FE__SURFACE_TRIANGLES]; // by which look
    int32_t number;                     // of this look, from 1 on
} look;

// Gives a point to the triangle of the whole surface that it is highest above, of equals to the first. What it sees is
// connected, from a triangle `from` that it sees: so the others need not be asked. Heights are rounded by far less than
// least_height: what is so far below is not seen.
static void give_to_highest(fe__hull_surface *s, int32_t point, int32_t from, look *l)
{
    fe_dvec3 p = s->cloud->grid[point];
    double most = least_height;
    int32_t best = -1, count = 0;
    l->met[from] = ++l->number;
    s->seen[count++] = from;
    for (int32_t i = 0; i < count; ++i) {
        const fe__surface_triangle *t = &s->triangles[s->seen[i]];
        double height = fe__grid_height(&t->plane, p);
        if (height < -least_height) continue;
        if (height > most || (height == most && s->seen[i] < best)) most = height, best = s->seen[i];
        for (int32_t k = 0; k < 3; ++k) {
            int32_t next = t->twin[k] / 3;
            if (l->met[next] != l->number) s->seen[count++] = next;
            l->met[next] = l->number;
        }
    }
    if (best >= 0) wait_at(s, best, point, most);
}

// All points that wait are given again, among all triangles: until now each chose in the fan that hid its triangle.
static void look_at_all(fe__hull_surface *s)
{
    int32_t counts[FE__SURFACE_TRIANGLES], waiting = take_waiting(s, counts);
    look l = {.number = 0};
    for (int32_t i = s->triangle_end - 1; i >= 0; --i) {
        for (int32_t next; counts[i] > 0; counts[i] -= 1, waiting = next) {
            next = s->next_point[waiting];
            give_to_highest(s, waiting, i, &l);
        }
    }
}

void fe__surface_grow(fe__hull_surface *s)
{
    for (int32_t looked = 0;;) {
        int32_t highest = highest_triangle(s);
        double height = highest < 0 ? 0.0 : s->height[highest];
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

// ---- simplex --------------------------------------------------------------------------------------------------------
// The tetrahedron that a hull grows from: two points far apart, the one farthest from their line, the one
// farthest from their plane.
//
// Of points that are equally far the one farthest from the cloud's middle is taken: of points in a plane or on a line
// that is a corner, so that grids get no vertex which another hides later.

typedef struct farthest {
    int32_t point;
    double distance, from_middle; // squares, or what grows with the distance
} farthest;

static void consider(farthest *best, const fe__cloud *cloud, int32_t point, double distance)
{
    if (best->point >= 0 && distance < best->distance) return;
    double from_middle = fe__ddot(cloud->grid[point], cloud->grid[point]);
    if (best->point >= 0 && distance == best->distance && from_middle <= best->from_middle) return;
    *best = (farthest){point, distance, from_middle};
}

static double along(fe_dvec3 p, int32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// The ends along the axis on which the cloud is longest
static void find_ends(const fe__cloud *cloud, int32_t end[2])
{
    fe_dvec3 sides = fe__dsub(cloud->high, cloud->low);
    int32_t axis = sides.x == cloud->extent ? 0 : sides.y == cloud->extent ? 1 : 2;
    farthest low = {-1, 0.0, 0.0}, high = {-1, 0.0, 0.0};
    for (int32_t i = 0; i < cloud->count; ++i) {
        double x = along(cloud->grid[i], axis);
        consider(&low, cloud, i, -x);
        consider(&high, cloud, i, x);
    }
    end[0] = low.point, end[1] = high.point;
}

// Squared distance from a line, times the squared length of `way`
static farthest farthest_from_line(const fe__cloud *cloud, fe_dvec3 start, fe_dvec3 way)
{
    farthest best = {-1, 0.0, 0.0};
    for (int32_t i = 0; i < cloud->count; ++i) {
        fe_dvec3 n = fe__dcross(way, fe__dsub(cloud->grid[i], start));
        consider(&best, cloud, i, fe__ddot(n, n));
    }
    return best;
}

static farthest farthest_from_plane(const fe__cloud *cloud, const fe__grid_plane *plane)
{
    farthest best = {-1, 0.0, 0.0};
    for (int32_t i = 0; i < cloud->count; ++i)
        consider(&best, cloud, i, fe__absd(fe__grid_rise(plane, cloud->grid[i])));
    return best;
}

// Four points of which the last is below the plane of the first three
static int32_t find_corners(const fe__cloud *cloud, double least, int32_t corner[4], double *out_thickness,
                            fe_dvec3 *out_normal)
{
    find_ends(cloud, corner);
    fe_dvec3 a = cloud->grid[corner[0]], way = fe__dsub(cloud->grid[corner[1]], a);
    farthest third = farthest_from_line(cloud, a, way);
    // All are within a distance of the line, or the plane: twice that bounds the thickness
    *out_thickness = 2.0 * sqrt(third.distance / fe__ddot(way, way)) * cloud->step;
    *out_normal = (fe_dvec3){0.0, 0.0, 0.0};
    if (*out_thickness < least) return 0;

    fe__grid_plane plane;
    fe__grid_plane_through(a, cloud->grid[corner[1]], cloud->grid[third.point], &plane);
    farthest fourth = farthest_from_plane(cloud, &plane);
    *out_thickness = 2.0 * fourth.distance * plane.per_length * cloud->step;
    *out_normal = plane.normal;
    if (*out_thickness < least) return 0;

    int32_t above = fe__grid_side(&plane, cloud->grid[fourth.point]) > 0;
    corner[2] = above ? corner[1] : third.point;
    corner[1] = above ? third.point : corner[1];
    corner[3] = fourth.point;
    return 1;
}

static void make_tetrahedron(fe__hull_surface *s)
{
    static const int32_t corners[4][3] = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
    for (int32_t i = 0; i < 4; ++i) fe__surface_new_triangle(s, corners[i][0], corners[i][1], corners[i][2]);
    for (int32_t e = 0; e < 12; ++e) {
        for (int32_t f = e + 1; f < 12; ++f)
            if (fe__edge_start(s, e) == fe__edge_end(s, f) && fe__edge_end(s, e) == fe__edge_start(s, f))
                fe__surface_join(s, e, f);
    }
}

int32_t fe__surface_begin(fe__hull_surface *s, double least_thickness, double *out_thickness, fe_dvec3 *out_normal)
{
    static const int32_t all[4] = {0, 1, 2, 3};
    for (int32_t i = 0; i < FE__SURFACE_VERTICES; ++i) s->point[i] = -1, s->degree[i] = 0;
    if (!find_corners(s->cloud, least_thickness, s->point, out_thickness, out_normal)) return 0;
    s->vertex_count = 4;
    make_tetrahedron(s);
    fe__surface_choose_among(s, all, 4);
    for (int32_t i = s->cloud->count - 1; i >= 0; --i) fe__surface_give(s, i, all, 4);
    return 1;
}
