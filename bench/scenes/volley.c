// n boxes and spheres in two clouds fly at each other, at 20 m/s, over no ground: all contacts are new.
#include "../random.h"
#include "../scene.h"

enum { COLUMNS = 8, SHEET = COLUMNS * COLUMNS }; // of a cloud: bodies along x and along y, and of both

void bench_build_volley(bench_scene *scene, int32_t n)
{
    const double pitch = 1.3, jitter = 0.2, distance = 12.0; // m
    bench_shape cube = bench_make_box(0.4f, 0.4f, 0.4f), sphere = bench_make_sphere(0.45f);
    cube.friction = sphere.friction = 0.4f;
    const int32_t forms[2] = {bench_add_shape(scene, cube), bench_add_shape(scene, sphere)};
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (int32_t i = 0; i < n; i++) {
        const int32_t side = i % 2 != 0 ? 1 : -1, j = i / 2;
        double x = side * (distance + pitch * (j % COLUMNS));
        double y = pitch * (j / COLUMNS % COLUMNS - 0.5 * (COLUMNS - 1)) + jitter * bench_random(&state);
        double z = pitch * (j / SHEET - 0.5 * n / (2 * SHEET)) + jitter * bench_random(&state);
        int32_t added = bench_add_dynamic(scene, forms[i / 2 % 2], x, y, z); // which may move the array
        bench_body *body = scene->bodies + added;
        body->linear_velocity[0] = -10.0f * (float)side;
        for (int k = 0; k < 3; k++) body->angular_velocity[k] = (float)bench_random(&state);
    }
    scene->warm_up_steps = 30;
    scene->timed_steps = 150;
}
