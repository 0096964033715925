// A cloth of n x n spheres on ball joints, hanging from its first row; nothing collides. Geometry of Box3D's benchmark
// joint_grid.
#include "../scene.h"

void bench_build_joints(bench_scene *scene, int32_t n)
{
    int32_t sphere = bench_add_shape(scene, bench_make_sphere(0.4f));
    for (int32_t k = 0; k < n; k++) {
        for (int32_t i = 0; i < n; i++) {
            int32_t body =
                i == 0 ? bench_add_static(scene, sphere, k, -i, 0.0) : bench_add_dynamic(scene, sphere, k, -i, 0.0);
            scene->bodies[body].collides = 0;
            if (i > 0) bench_add_joint(scene, body - 1, body, k, 0.5 - i, 0.0);
            if (i > 0 && k > 0) bench_add_joint(scene, body - n, body, k - 0.5, -i, 0.0);
        }
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 100;
}
