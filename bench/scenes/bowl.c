// n boxes, spheres and capsules poured into a walled pit: every kind of pair, and contacts that come and go.
#include "../random.h"
#include "../scene.h"

static const uint64_t SEED = 0x9e3779b97f4a7c15u;

enum {
    COLUMNS = 9,               // of a layer, along x and along z
    LAYER = COLUMNS * COLUMNS, // bodies of a layer
};

void bench_build_bowl(bench_scene *scene, int32_t n)
{
    const double pitch = 1.2, jitter = 0.3, layer_height = 1.5; // m
    bench_shape forms[3] = {bench_make_box(0.4f, 0.3f, 0.5f), bench_make_sphere(0.45f), bench_make_capsule(0.3f, 0.3f)};
    int32_t shapes[3];
    for (int32_t i = 0; i < 3; i++) {
        forms[i].friction = 0.4f;
        shapes[i] = bench_add_shape(scene, forms[i]);
    }
    bench_add_pit(scene, 11.0f);
    uint64_t state = SEED;
    for (int32_t b = 0; b < n; b++) {
        int32_t layer = b / LAYER, c = b % LAYER;
        double x = pitch * (c % COLUMNS - COLUMNS / 2) + jitter * (bench_random(&state) - 0.5);
        double z = pitch * (c / COLUMNS - COLUMNS / 2) + jitter * (bench_random(&state) - 0.5);
        bench_add_dynamic(scene, shapes[b % 3], x, 1.0 + layer_height * layer, z);
    }
    scene->warm_up_steps = 240;
    scene->timed_steps = 240;
}
