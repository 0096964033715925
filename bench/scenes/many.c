// n x n flat pyramids of 55 cubes: many islands of middling size. Geometry of Box3D's benchmark many_pyramids.
#include "../scene.h"

enum { ROWS = 10 };

static void add_pyramid(bench_scene *scene, int32_t box, double centre, double z)
{
    for (int32_t i = 0; i < ROWS; i++) {
        for (int32_t j = i; j < ROWS; j++)
            bench_add_dynamic(scene, box, 0.5 * (i + 1) + (j - i) + centre - 0.5, i + 0.5, z);
    }
}

void bench_build_many(bench_scene *scene, int32_t n)
{
    bench_shape cube = bench_make_box(0.5f, 0.5f, 0.5f);
    cube.density = 100.0f;
    int32_t box = bench_add_shape(scene, cube);
    double extent = 5.5 * n; // half the ground's side: a pyramid and the gap beside it take ROWS + 1 metres
    bench_add_static(scene, bench_add_shape(scene, bench_make_box((float)extent, 1.0f, (float)extent)), 0.0, -1.0, 0.0);
    for (int32_t r = 0; r < n; r++) {
        double z = -extent + 1.0 + 2.0 * r * (extent - 1.0) / (n - 1);
        for (int32_t c = 0; c < n; c++) add_pyramid(scene, box, -extent + (ROWS + 1.0) * c + 1.0, z);
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 100;
}
