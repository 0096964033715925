// A cube of n x n x n cubes, 1 cm apart, falls together: one island whose contacts all begin at once.
#include "../scene.h"

void bench_build_grid(bench_scene *scene, int32_t n)
{
    const double pitch = 1.01, lowest = 0.51, middle = 0.5 * (n - 1); // m, m, cubes
    int32_t cube = bench_add_shape(scene, bench_make_box(0.5f, 0.5f, 0.5f));
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(100.0f, 1.0f, 100.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n * n * n; i++) {
        bench_add_dynamic(scene, cube, pitch * (i % n - middle), lowest + pitch * (i / (n * n)),
                          pitch * (i / n % n - middle));
    }
    scene->warm_up_steps = 60;
    scene->timed_steps = 180;
}
