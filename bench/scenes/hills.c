// Hills of triangles: cells of 1 m about the world's middle, two triangles each, with waves of two lengths and a rough
// surface. What rocks and mixedmesh fall on; mesh-n holds the hills alone, hullcloud-n floating hulls: for queries.
#include "../memory.h"
#include "../random.h"
#include "../scene.h"
#include "../vec.h"

#include <math.h>
#include <stdlib.h>

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
