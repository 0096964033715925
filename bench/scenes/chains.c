// n chains of spheres on ball joints, held at one end and let go from the horizontal; they hit each other and the
// ground.
#include "../scene.h"

enum { LINKS = 30 };

void bench_build_chains(bench_scene *scene, int32_t n)
{
    const double height = 8.0, pitch = 0.3, apart = 0.35; // m
    int32_t link = bench_add_shape(scene, bench_make_sphere(0.12f));
    int32_t hook = bench_add_shape(scene, bench_make_sphere(0.1f));
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(100.0f, 1.0f, 100.0f)), 0.0, -1.0, 0.0);
    for (int32_t k = 0; k < n; k++) {
        double z = apart * (k - 0.5 * n);
        int32_t last = bench_add_static(scene, hook, 0.0, height, z);
        for (int32_t i = 0; i < LINKS; i++) {
            int32_t body = bench_add_dynamic(scene, link, pitch * (i + 1), height, z);
            bench_add_joint(scene, last, body, pitch * (i + 0.5), height, z);
            last = body;
        }
    }
    scene->warm_up_steps = 30;
    scene->timed_steps = 240;
}
