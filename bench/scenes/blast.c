// n cubes and spheres burst from the middle of a closed room and bounce off its walls and each other.
#include "../random.h"
#include "../scene.h"

#include <math.h>

void bench_build_blast(bench_scene *scene, int32_t n)
{
    const int32_t side = (int32_t)ceil(cbrt((double)n));
    const double pitch = 0.7, room = pitch * side; // m: and half the width of the room
    bench_shape cube = bench_make_box(0.25f, 0.25f, 0.25f), sphere = bench_make_sphere(0.3f),
                plate = bench_make_box((float)room + 2.0f, 1.0f, (float)room + 2.0f);
    cube.restitution = sphere.restitution = plate.restitution = 0.6f;
    cube.friction = sphere.friction = plate.friction = 0.4f;
    const int32_t forms[2] = {bench_add_shape(scene, cube), bench_add_shape(scene, sphere)};
    bench_shape end = plate, flank = plate;
    end.half[0] = 1.0f, end.half[1] = (float)room + 2.0f;
    flank.half[2] = 1.0f, flank.half[1] = (float)room + 2.0f;
    const int32_t walls[3] = {bench_add_shape(scene, end), bench_add_shape(scene, plate),
                              bench_add_shape(scene, flank)};
    for (int k = 0; k < 6; k++) {
        double at[3] = {0.0, 0.0, 0.0};
        at[k / 2] = (k % 2 != 0 ? 1.0 : -1.0) * (room + 1.0);
        bench_add_static(scene, walls[k / 2], at[0], at[1], at[2]);
    }
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (int32_t i = 0; i < n; i++) {
        const double middle = 0.5 * (side - 1);
        double at[3] = {pitch * (i % side - middle), pitch * (i / side % side - middle),
                        pitch * (i / side / side - middle)};
        const int32_t added = bench_add_dynamic(scene, forms[i % 2], at[0], at[1], at[2]);
        for (int k = 0; k < 3; k++) {
            scene->bodies[added].linear_velocity[k] = (float)(2.0 * at[k] + bench_random(&state));
            scene->bodies[added].angular_velocity[k] = (float)bench_random(&state);
        }
    }
    scene->warm_up_steps = 1;
    scene->timed_steps = 240;
}
