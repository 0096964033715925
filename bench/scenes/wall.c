// n brick walls with joints of 4 mm, each hit by a ball of 68 times the mass of a brick.
#include "../scene.h"

enum { ROWS = 10, COLUMNS = 20 };

static void add_wall(bench_scene *scene, int32_t brick, double z)
{
    const double joint = 0.004, length = 0.5 + joint, height = 0.25 + joint; // m
    for (int32_t r = 0; r < ROWS; r++) {
        const double shift = r % 2 != 0 ? 0.5 * length : 0.0;
        for (int32_t c = 0; c < COLUMNS; c++)
            bench_add_dynamic(scene, brick, length * (c - 0.5 * (COLUMNS - 1)) + shift, 0.125 + joint + height * r, z);
    }
}

void bench_build_wall(bench_scene *scene, int32_t n)
{
    bench_shape form = bench_make_box(0.25f, 0.125f, 0.125f), heavy = bench_make_sphere(0.4f);
    form.density = 2000.0f, heavy.density = 4000.0f;
    int32_t brick = bench_add_shape(scene, form), ball = bench_add_shape(scene, heavy);
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(100.0f, 1.0f, 100.0f)), 0.0, -1.0, 0.0);
    for (int32_t w = 0; w < n; w++) {
        double z = 4.0 * (w - 0.5 * n);
        add_wall(scene, brick, z);
        int32_t thrown = bench_add_dynamic(scene, ball, 0.3 * w, 1.2, z + 1.5);
        scene->bodies[thrown].linear_velocity[2] = -12.0f;
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 240;
}
