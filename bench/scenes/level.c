// n static boxes scattered over a plain, 4 m2 for each: what queries and life cost in a large level.
#include "../random.h"
#include "../scene.h"

#include <math.h>

void bench_build_level(bench_scene *scene, int32_t n)
{
    enum { FORMS = 16 };
    const double half = sqrt((double)n); // m
    int32_t forms[FORMS];
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (int32_t i = 0; i < FORMS; i++) {
        float x = (float)(0.2 + 0.8 * bench_random(&state)), y = (float)(0.2 + 1.8 * bench_random(&state));
        forms[i] = bench_add_shape(scene, bench_make_box(x, y, (float)(0.2 + 0.8 * bench_random(&state))));
    }
    for (int32_t i = 0; i < n; i++) {
        double x = half * (2.0 * bench_random(&state) - 1.0), z = half * (2.0 * bench_random(&state) - 1.0),
               y = 8.0 * bench_random(&state);
        int32_t body = bench_add_static(scene, forms[i % FORMS], x, y, z);
        double angle = BENCH_PI * bench_random(&state);
        scene->bodies[body].start.rotation[1] = sin(0.5 * angle),
        scene->bodies[body].start.rotation[3] = cos(0.5 * angle);
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 1;
    scene->query_half = half;
}
