// n boxes, spheres and capsules slide down a slope of 30 degrees against a wall at its foot.
#include "../random.h"
#include "../scene.h"

#include <math.h>

enum { ACROSS = 16, FORMS = 3 };

void bench_build_landslide(bench_scene *scene, int32_t n)
{
    const double slope = BENCH_PI / 6.0, pitch = 0.8, jitter = 0.1; // rad, m, m
    bench_shape forms[FORMS] = {bench_make_box(0.3f, 0.2f, 0.25f), bench_make_sphere(0.28f),
                                bench_make_capsule(0.2f, 0.18f)};
    int32_t form[FORMS];
    for (int k = 0; k < FORMS; k++) forms[k].friction = 0.3f, form[k] = bench_add_shape(scene, forms[k]);
    bench_shape ramp = bench_make_box(60.0f, 1.0f, 10.0f);
    ramp.friction = 0.3f;
    int32_t tilted = bench_add_static(scene, bench_add_shape(scene, ramp), 0.0, 0.0, 0.0);
    bench_turn_z(scene->bodies + tilted, slope);
    const double foot[2] = {-20.0, -20.0 * tan(slope)}; // the wall stands here
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(1.0f, 20.0f, 10.0f)), foot[0], foot[1], 0.0);
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (int32_t i = 0; i < n; i++) {
        // up the slope from the wall, and one layer over another
        const int32_t row = i / ACROSS % 25, layer = i / ACROSS / 25;
        const double along = 6.0 + pitch * row + jitter * bench_random(&state),
                     over = 1.5 + pitch * layer + jitter * bench_random(&state);
        const double x = foot[0] + along * cos(slope) - over * sin(slope),
                     y = foot[1] + along * sin(slope) + over * cos(slope);
        bench_add_dynamic(scene, form[i % FORMS], x, y, pitch * (i % ACROSS - 0.5 * (ACROSS - 1)));
    }
    scene->warm_up_steps = 30;
    scene->timed_steps = 240;
}
