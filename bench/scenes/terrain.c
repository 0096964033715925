// A heightfield of n x n samples, 0.5 m apart, with hills of some metres: what queries cost on terrain.
#include "../scene.h"

#include <math.h>

float bench_terrain_height(const bench_shape *terrain, int32_t row, int32_t column)
{
    const double x = column, z = row;
    if (terrain->relief == BENCH_WAVES) return (float)(0.5 * sin(0.2 * BENCH_PI * z) * sin(0.4 * BENCH_PI * x));
    return (float)(2.5 * sin(0.021 * x) * cos(0.017 * z) + 0.6 * sin(0.13 * x + 0.11 * z) +
                   0.1 * sin(1.1 * x) * sin(0.9 * z));
}

void bench_build_terrain(bench_scene *scene, int32_t n)
{
    const float cell = 0.5f; // m
    bench_add_static(scene, bench_add_shape(scene, bench_make_terrain(n, cell)), 0.0, 0.0, 0.0);
    scene->warm_up_steps = 1;
    scene->timed_steps = 1;
    scene->query_half = 0.4 * (double)cell * n;
}
