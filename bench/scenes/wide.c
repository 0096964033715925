// A square pyramid of n levels of 2 m cubes, each on up to four: one island with many contacts a body.
#include "../scene.h"

void bench_build_wide(bench_scene *scene, int32_t n)
{
    bench_shape cube = bench_make_box(1.0f, 1.0f, 1.0f);
    bench_shape ground = bench_make_box(50.0f, 1.0f, 50.0f);
    cube.friction = ground.friction = 0.5f;
    int32_t box = bench_add_shape(scene, cube);
    bench_add_static(scene, bench_add_shape(scene, ground), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) {
        // Every second level is shifted by half a cube, so it is one row shorter at one end only: hence the integer
        // divisions.
        int32_t first = i / 2, end = n - (i + 1) / 2, shift = i % 2;
        for (int32_t j = first; j < end; j++) {
            for (int32_t k = first; k < end; k++)
                bench_add_dynamic(scene, box, -n + 2 * j + shift, 1.0 + 2.0 * i, -n + 2 * k + shift);
        }
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 200;
}
