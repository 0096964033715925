// n boxes, spheres and capsules in the air (fall) or tumbling over each other on open ground (awake): the lines by
// which smaller engines are told.
#include "../random.h"
#include "../scene.h"

static const uint64_t SEED = 0x9e3779b97f4a7c15u;

// Columns of layers; jitter lets what falls onto each other roll off.
static void add_mixed(bench_scene *scene, int32_t n, int32_t side, double pitch, double lowest, double jitter)
{
    const int32_t shapes[3] = {bench_add_shape(scene, bench_make_box(0.4f, 0.3f, 0.5f)),
                               bench_add_shape(scene, bench_make_sphere(0.45f)),
                               bench_add_shape(scene, bench_make_capsule(0.3f, 0.3f))};
    uint64_t state = SEED;
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(200.0f, 1.0f, 200.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) {
        const int32_t column = i % side, row = i / side % side, layer = i / (side * side);
        const double x = pitch * (column - 0.5 * side) + jitter * (bench_random(&state) - 0.5);
        const double z = pitch * (row - 0.5 * side) + jitter * (bench_random(&state) - 0.5);
        bench_add_dynamic(scene, shapes[i % 3], x, lowest + pitch * layer, z);
    }
}

void bench_build_fall(bench_scene *scene, int32_t n)
{
    add_mixed(scene, n, 10, 1.5, 60.0, 0.0);
    scene->warm_up_steps = 10;
    scene->timed_steps = 150; // 2.7 s: 35 m
}

void bench_build_awake(bench_scene *scene, int32_t n)
{
    add_mixed(scene, n, 20, 1.2, 1.0, 0.3);
    scene->warm_up_steps = 120;
    scene->timed_steps = 200;
}
