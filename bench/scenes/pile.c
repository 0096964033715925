// n boxes and spheres by turns, in columns of layers, fall onto each other on open ground: the heap falls apart.
#include "../random.h"
#include "../scene.h"

void bench_build_pile(bench_scene *scene, int32_t n)
{
    enum { COLUMNS = 8, LAYER = COLUMNS * COLUMNS };
    const double pitch = 1.1, jitter = 0.2, layer_height = 1.2; // m
    const int32_t forms[2] = {bench_add_shape(scene, bench_make_box(0.5f, 0.5f, 0.5f)),
                              bench_add_shape(scene, bench_make_sphere(0.5f))};
    uint64_t state = 0x9e3779b97f4a7c15u;
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(200.0f, 1.0f, 200.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) {
        int32_t layer = i / LAYER, c = i % LAYER;
        double x = pitch * (c % COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        double z = pitch * (c / COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        bench_add_dynamic(scene, forms[i % 2], x, 1.0 + layer_height * layer, z);
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 300;
}
