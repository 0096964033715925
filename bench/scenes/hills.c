// Hills of triangles: cells of 1 m about the world's middle, two triangles each, with waves of two lengths and a rough
// surface. What rocks and mixedmesh fall on; mesh-n holds the hills alone, hullcloud-n floating hulls: for queries.
#include "../memory.h"
#include "../random.h"
#include "../scene.h"
#include "../vec.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// m, between -0.1 and 0.1: a hash of the vertex
static double roughness(int32_t row, int32_t column)
{
    uint32_t k = (uint32_t)row * 73856093u ^ (uint32_t)column * 19349663u;
    k ^= k >> 13;
    k *= 0x5bd1e995u;
    k ^= k >> 15;
    return 0.2 * ((k & 0xffffu) / 65535.0 - 0.5);
}

static double height_at(int32_t cells, int32_t row, int32_t column)
{
    const double x = column - 0.5 * cells, z = row - 0.5 * cells;
    return 2.0 * sin(0.13 * x) * cos(0.11 * z) + 0.6 * sin(0.53 * x + 0.7) * sin(0.47 * z) + roughness(row, column);
}

int bench_hills_height(double x, double z, double *out_height, double *out_normal)
{
    const int32_t cells = BENCH_HILLS_CELLS;
    double u = x + 0.5 * cells, v = z + 0.5 * cells;
    if (!(u >= 0.0 && v >= 0.0 && u < cells && v < cells)) return 0;
    const int32_t column = (int32_t)u, row = (int32_t)v;
    const double a = height_at(cells, row, column), b = height_at(cells, row, column + 1),
                 d = height_at(cells, row + 1, column), e = height_at(cells, row + 1, column + 1);
    u -= column, v -= row;
    const double slope_x = v > u ? e - d : b - a, slope_z = v > u ? d - a : e - b;
    const double length = sqrt(slope_x * slope_x + slope_z * slope_z + 1.0);
    *out_height = a + slope_x * u + slope_z * v;
    out_normal[0] = -slope_x / length, out_normal[1] = 1.0 / length, out_normal[2] = -slope_z / length;
    return 1;
}

// ---- distances -----------------------------------------------------------------------------------------------------
static double distance_to_side(const double *p, const double *a, const double *b)
{
    double side[3], from[3];
    bench_minus(b, a, side);
    bench_minus(p, a, from);
    const double t = fmin(fmax(bench_dot(from, side) / bench_dot(side, side), 0.0), 1.0);
    for (int k = 0; k < 3; k++) from[k] -= t * side[k];
    return bench_length(from);
}

// To its plane where the foot is inside of all sides, else to the nearest side
static double distance_to_triangle(const double *p, double corners[3][3])
{
    double ab[3], ac[3], normal[3], least = DBL_MAX;
    bench_minus(corners[1], corners[0], ab);
    bench_minus(corners[2], corners[0], ac);
    bench_cross(ab, ac, normal);
    int32_t inside = 1;
    for (int k = 0; k < 3; k++) {
        const double *a = corners[k], *b = corners[(k + 1) % 3];
        double side[3], from[3], inwards[3];
        bench_minus(b, a, side);
        bench_minus(p, a, from);
        bench_cross(normal, side, inwards);
        if (bench_dot(inwards, from) < 0.0) inside = 0;
        least = fmin(least, distance_to_side(p, a, b));
    }
    double from[3];
    bench_minus(p, corners[0], from);
    return inside ? fabs(bench_dot(normal, from)) / bench_length(normal) : least;
}

static void place_corner(int32_t row, int32_t column, double *out)
{
    out[0] = column - 0.5 * BENCH_HILLS_CELLS, out[2] = row - 0.5 * BENCH_HILLS_CELLS;
    out[1] = height_at(BENCH_HILLS_CELLS, row, column);
}

double bench_hills_distance(const double *p)
{
    const int32_t column = (int32_t)floor(p[0] + 0.5 * BENCH_HILLS_CELLS),
                  row = (int32_t)floor(p[2] + 0.5 * BENCH_HILLS_CELLS), last = BENCH_HILLS_CELLS - 1;
    double least = DBL_MAX;
    for (int32_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r <= last; r++) {
        for (int32_t c = column > 0 ? column - 1 : 0; c <= column + 1 && c <= last; c++) {
            double low[3][3], high[3][3];
            place_corner(r, c, low[0]), place_corner(r + 1, c, low[1]), place_corner(r + 1, c + 1, low[2]);
            memcpy(high[0], low[0], sizeof high[0]), memcpy(high[1], low[2], sizeof high[1]);
            place_corner(r, c + 1, high[2]);
            least = fmin(least, fmin(distance_to_triangle(p, low), distance_to_triangle(p, high)));
        }
    }
    return least;
}

// ---- the mesh ------------------------------------------------------------------------------------------------------
bench_mesh bench_hills(int32_t cells)
{
    const int32_t side = cells + 1;
    bench_mesh mesh = {.vertex_count = side * side, .triangle_count = 2 * cells * cells};
    mesh.vertices = bench_allocate((size_t)mesh.vertex_count, 3 * sizeof *mesh.vertices);
    mesh.indices = bench_allocate((size_t)mesh.triangle_count, 3 * sizeof *mesh.indices);
    float *v = mesh.vertices;
    int32_t *i = mesh.indices;
    for (int32_t row = 0; row < side; row++) {
        for (int32_t column = 0; column < side; column++, v += 3)
            v[0] = (float)(column - 0.5 * cells), v[1] = (float)height_at(cells, row, column),
            v[2] = (float)(row - 0.5 * cells);
    }
    for (int32_t row = 0; row < cells; row++) {
        for (int32_t column = 0; column < cells; column++, i += 6) {
            const int32_t a = row * side + column, d = a + side;
            i[0] = a, i[1] = d, i[2] = d + 1;
            i[3] = a, i[4] = d + 1, i[5] = a + 1;
        }
    }
    return mesh;
}

void bench_mesh_free(bench_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
}

void bench_build_mesh(bench_scene *scene, int32_t n)
{
    bench_add_static(scene, bench_add_shape(scene, bench_make_mesh(n)), 0.0, 0.0, 0.0);
    scene->warm_up_steps = 1;
    scene->timed_steps = 1;
    scene->query_radius = 0.3f;
}

void bench_build_hullcloud(bench_scene *scene, int32_t n)
{
    uint64_t state = BENCH_SEED;
    for (int32_t b = 0; b < n; b++) {
        const double x = 40.0 * bench_random(&state) - 20.0, y = 30.0 * bench_random(&state),
                     z = 40.0 * bench_random(&state) - 20.0;
        double rotation[4];
        bench_draw_rotation(&state, rotation);
        bench_shape rock = bench_draw_rock(&state, 8, 32);
        const int32_t body = bench_add_static(scene, bench_add_shape(scene, rock), x, y, z);
        for (int k = 0; k < 4; k++) scene->bodies[body].start.rotation[k] = rotation[k];
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 1;
    scene->query_radius = 0.3f;
}
