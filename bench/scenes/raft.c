// n boxes on one plate that they press to the ground: a body with more contacts than there are colours.
#include "../scene.h"

void bench_build_raft(bench_scene *scene, int32_t n)
{
    const double pitch = 1.5; // m
    int32_t side = 1;
    while ((int64_t)side * side < n) side++;
    float half = (float)(0.5 * pitch * side);
    int32_t box = bench_add_shape(scene, bench_make_box(0.5f, 0.5f, 0.5f));
    int32_t plate = bench_add_shape(scene, bench_make_box(half, 0.5f, half));
    int32_t ground = bench_add_shape(scene, bench_make_box(500.0f, 1.0f, 500.0f));

    bench_add_static(scene, ground, 0.0, -1.0, 0.0);
    bench_add_dynamic(scene, plate, 0.0, 0.5, 0.0);
    double corner = -0.5 * pitch * (side - 1);
    for (int32_t i = 0; i < n; i++)
        bench_add_dynamic(scene, box, corner + pitch * (i % side), 1.5, corner + pitch * (i / side));
    scene->warm_up_steps = 60;
    scene->timed_steps = 60;
}
