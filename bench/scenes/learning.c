// Small scenes as learning has them, a few bodies each, for many worlds: a leg that hops in a plane, a hand that pushes
// boxes.
#include "../scene.h"

enum { LINKS = 4, PUSHED = 9, IN_A_ROW = 3 };

// From the torso down: half the length of the capsule's axis and its radius, m
static const struct {
    float half_height, radius;
} LINK[LINKS] = {{0.2f, 0.05f}, {0.225f, 0.05f}, {0.25f, 0.04f}, {0.195f, 0.06f}};

static void keep_in_plane(bench_body *body)
{
    body->linear_locks = 4;  // z
    body->angular_locks = 3; // x and y
}

static bench_joint *join(bench_scene *scene, int32_t a, int32_t b, double x, double y, double z)
{
    const int32_t index = bench_add_joint(scene, a, b, x, y, z); // may move the array
    return &scene->joints[index];
}

static void add_hopper(bench_scene *scene, const int32_t *shapes, double x, int32_t group)
{
    const double speed[LINKS] = {0.0, -1.5, 2.0, -2.5}, most = 60.0; // rad/s of the joint above, N m
    double y = 1.7;
    int32_t above = -1;
    for (int32_t i = 0; i < LINKS; i++) {
        const double half = (double)LINK[i].half_height;
        const int32_t body = bench_add_dynamic(scene, shapes[i], x, y - half, 0.0);
        keep_in_plane(&scene->bodies[body]);
        scene->bodies[body].group = group;
        if (above >= 0) {
            bench_joint *joint = join(scene, above, body, x, y, 0.0);
            joint->kind = BENCH_HINGE;
            joint->axis[0] = joint->axis[1] = 0.0, joint->axis[2] = 1.0;
            joint->has_limits = 1, joint->limits[0] = -0.8, joint->limits[1] = 0.8;
            joint->motor_speed = speed[i], joint->motor_max = most;
        }
        y -= 2.0 * half;
        above = body;
    }
}

void bench_build_hoppers(bench_scene *scene, int32_t n)
{
    int32_t shapes[LINKS];
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(20.0f + 3.0f * (float)n, 1.0f, 20.0f)), 0.0, -1.0,
                     0.0);
    for (int32_t i = 0; i < LINKS; i++)
        shapes[i] = bench_add_shape(scene, bench_make_capsule(LINK[i].half_height, LINK[i].radius));
    for (int32_t i = 0; i < n; i++) add_hopper(scene, shapes, 3.0 * i, i + 1);
    scene->warm_up_steps = 20;
    scene->timed_steps = 80;
}

// The hand is on a rail along x, which a motor drives
static void add_pusher(bench_scene *scene, int32_t ground, int32_t hand, int32_t box, double z)
{
    const double pitch = 0.45; // m
    const int32_t body = bench_add_dynamic(scene, hand, -1.2, 0.21, z);
    bench_joint *rail = join(scene, ground, body, -1.2, 0.21, z);
    rail->kind = BENCH_SLIDER;
    rail->axis[0] = 1.0, rail->axis[1] = rail->axis[2] = 0.0;
    rail->motor_speed = 0.5, rail->motor_max = 2000.0; // m/s, N
    for (int32_t i = 0; i < PUSHED; i++)
        bench_add_dynamic(scene, box, pitch * (i / IN_A_ROW) - 0.6, 0.2, z + pitch * (i % IN_A_ROW - 1));
}

void bench_build_pushers(bench_scene *scene, int32_t n)
{
    const int32_t hand = bench_add_shape(scene, bench_make_box(0.1f, 0.2f, 0.7f));
    const int32_t box = bench_add_shape(scene, bench_make_box(0.2f, 0.2f, 0.2f));
    const float half = 20.0f + 3.0f * (float)n;
    const int32_t ground =
        bench_add_static(scene, bench_add_shape(scene, bench_make_box(20.0f, 1.0f, half)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < n; i++) add_pusher(scene, ground, hand, box, 3.0 * i);
    scene->warm_up_steps = 20;
    scene->timed_steps = 80;
}
