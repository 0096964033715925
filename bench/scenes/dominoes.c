// n dominoes in rows of 50; the first of each row is pushed, and the wave runs.
#include "../scene.h"

enum { LENGTH = 50 }; // of a row

void bench_build_dominoes(bench_scene *scene, int32_t n)
{
    const double pitch = 0.35, apart = 0.8; // m: along a row, and from row to row
    const float push = 1.5f;                // rad/s, about the lower edge: enough to tip
    bench_shape form = bench_make_box(0.05f, 0.5f, 0.25f);
    form.friction = 0.4f;
    const int32_t rows = (n + LENGTH - 1) / LENGTH, domino = bench_add_shape(scene, form);
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(100.0f, 1.0f, 100.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) {
        const int32_t row = i / LENGTH, place = i % LENGTH;
        const int32_t added = bench_add_dynamic(scene, domino, pitch * (place - 0.5 * (LENGTH - 1)), 0.5,
                                                apart * (row - 0.5 * (rows - 1)));
        if (place > 0) continue;
        bench_body *first = scene->bodies + added;
        first->angular_velocity[2] = -push;
        first->linear_velocity[0] = 0.5f * push;
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 300;
}
