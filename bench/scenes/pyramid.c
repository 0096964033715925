// One flat pyramid of n rows of cubes: one large island, the solver's scene. Geometry of Box3D's benchmark
// large_pyramid.
#include "../scene.h"

void bench_build_pyramid(bench_scene *scene, int32_t n)
{
    bench_shape cube = bench_make_box(0.5f, 0.5f, 0.5f);
    cube.density = 100.0f;
    int32_t box = bench_add_shape(scene, cube);
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(400.0f, 1.0f, 400.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = i; j < n; j++) bench_add_dynamic(scene, box, 0.5 * (i + 1) + (j - i) - 0.5 * n, i + 0.5, 0.0);
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 200;
}
