// One layer of n bodies at rest on a square grid, boxes and spheres by turns: what a scene costs where nothing happens.
#include "../scene.h"

void bench_build_rest(bench_scene *scene, int32_t n)
{
    const double pitch = 1.5; // m
    int32_t forms[2] = {bench_add_shape(scene, bench_make_box(0.5f, 0.5f, 0.5f)),
                        bench_add_shape(scene, bench_make_sphere(0.5f))};
    int32_t ground = bench_add_shape(scene, bench_make_box(500.0f, 1.0f, 500.0f));
    int32_t side = 1;
    while ((int64_t)side * side < n) side++;

    bench_add_static(scene, ground, 0.0, -1.0, 0.0);
    double corner = -0.5 * pitch * (side - 1);
    for (int32_t i = 0; i < n; i++)
        bench_add_dynamic(scene, forms[i % 2], corner + pitch * (i % side), 0.5, corner + pitch * (i / side));
    scene->warm_up_steps = 60;
    scene->timed_steps = 180;
}
