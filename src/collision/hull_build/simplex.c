// simplex.c - the tetrahedron that a hull grows from: two points far apart, the one farthest from their line, the one
// farthest from their plane.
//
// Of points that are equally far the one farthest from the cloud's middle is taken: of points in a plane or on a line
// that is a corner, so that grids get no vertex which another hides later.
#include "collision/hull_build/surface.h"

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
