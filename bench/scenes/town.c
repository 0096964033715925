// n boxes, spheres and capsules fall among static boxes of unequal height: many islands of one body.
#include "../random.h"
#include "../scene.h"

enum { SIDE = 160 }; // static boxes along x and along z, 1 m apart

static void add_houses(bench_scene *scene, uint64_t *state)
{
    for (int32_t i = 0; i < SIDE; i++) {
        for (int32_t j = 0; j < SIDE; j++) {
            const double first = bench_random(state), half = 0.2 + 2.0 * first * bench_random(state);
            int32_t house = bench_add_shape(scene, bench_make_box(0.5f, (float)half, 0.5f));
            bench_add_static(scene, house, i - SIDE / 2, half - 2.0, j - SIDE / 2);
        }
    }
}

void bench_build_town(bench_scene *scene, int32_t n)
{
    const double pitch = 2.0, lowest = 4.0, range = 3.0; // m
    bench_shape forms[3] = {bench_make_box(0.4f, 0.3f, 0.5f), bench_make_sphere(0.45f), bench_make_capsule(0.3f, 0.3f)};
    int32_t shapes[3], side = 1;
    for (int32_t i = 0; i < 3; i++) {
        forms[i].friction = 0.4f;
        shapes[i] = bench_add_shape(scene, forms[i]);
    }
    uint64_t state = 0x9e3779b97f4a7c15u;
    add_houses(scene, &state);
    while ((int64_t)side * side < n) side++;
    for (int32_t i = 0; i < n; i++) {
        bench_add_dynamic(scene, shapes[i % 3], pitch * (i % side - 0.5 * side), lowest + range * bench_random(&state),
                          pitch * (i / side - 0.5 * side));
    }
    scene->warm_up_steps = 60;
    scene->timed_steps = 240;
}
