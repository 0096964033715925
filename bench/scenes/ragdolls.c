// n people of fourteen capsules, dropped on a heightfield: the ragdolls of examples/machines.h (Box3D's human) as data
// for every engine. A joint's zero is the person standing, and its cone and range lie about that: not all engines know
// two frames.
#include "../../examples/machines.h"
#include "../scene.h"

#include <math.h>

#define PITCH 2.0    // m, between people
#define CELL 0.5f    // m, of the terrain
#define HEIGHT 4.5   // m, of the feet: hills end at 3.2
#define PLANE 0.5    // m, of the feet over flat ground
#define FRICTION 5.0 // N m, of joints

static fe_vec3 minus(fe_vec3 a, fe_vec3 b) { return fe_make_vec3(a.x - b.x, a.y - b.y, a.z - b.z); }

static int32_t add_shape(bench_scene *scene, const ragdoll_bone *bone)
{
    fe_vec3 along = minus(bone->end_b, bone->end_a);
    bench_shape capsule =
        bench_make_capsule(0.5f * sqrtf(along.x * along.x + along.y * along.y + along.z * along.z), bone->radius);
    capsule.rolling = 0.2f;
    return bench_add_shape(scene, capsule);
}

// The body is the capsule, not the bone: its origin lies in the middle
static int32_t add_bone(bench_scene *scene, const ragdoll_bone *bone, int32_t shape, const double *at)
{
    fe_vec3 along = minus(bone->end_b, bone->end_a);
    fe_vec3 half = {0.5f * (bone->end_a.x + bone->end_b.x), 0.5f * (bone->end_a.y + bone->end_b.y),
                    0.5f * (bone->end_a.z + bone->end_b.z)};
    fe_vec3 middle = machine_rotate(bone->rotation, half);
    fe_quat q = machine_multiply(bone->rotation, machine_turn_y_to(along));
    double length = sqrt((double)(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w));
    int32_t body =
        bench_add_dynamic(scene, shape, at[0] + (double)(bone->position.x + middle.x),
                          at[1] + (double)(bone->position.y + middle.y), at[2] + (double)(bone->position.z + middle.z));
    const float rotation[4] = {q.x, q.y, q.z, q.w};
    for (int k = 0; k < 4; k++) scene->bodies[body].start.rotation[k] = (double)rotation[k] / length;
    return body;
}

static void add_joint(bench_scene *scene, const ragdoll_bone *bone, int32_t parent, int32_t child, const double *at)
{
    const double degree = BENCH_PI / 180.0;
    fe_vec3 point = machine_rotate(bone->rotation, bone->point);
    int32_t index =
        bench_add_joint(scene, parent, child, at[0] + (double)(bone->position.x + point.x),
                        at[1] + (double)(bone->position.y + point.y), at[2] + (double)(bone->position.z + point.z));
    bench_joint *joint = &scene->joints[index];
    fe_vec3 axis = machine_rotate(machine_multiply(bone->rotation, bone->frame_b),
                                  fe_make_vec3(0, 0, 1)); // the table's are about Z
    double length = sqrt((double)(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z));
    joint->axis[0] = (double)axis.x / length, joint->axis[1] = (double)axis.y / length,
    joint->axis[2] = (double)axis.z / length;
    joint->kind = bone->joint == RAGDOLL_HINGE ? BENCH_HINGE : BENCH_BALL;
    joint->has_limits = 1;
    joint->limits[0] = (double)bone->low * degree, joint->limits[1] = (double)bone->high * degree;
    joint->cone = (double)bone->swing * degree;
    joint->motor_max = FRICTION * (double)bone->friction;
}

// at: of the feet
static void add_person(bench_scene *scene, const int32_t *shapes, const double *at, int32_t group)
{
    const int32_t first = scene->body_count;
    for (int32_t i = 0; i < RAGDOLL_BONES; i++) {
        const ragdoll_bone *bone = &ragdoll_bones[i];
        const int32_t body = add_bone(scene, bone, shapes[i], at); // may move the array
        scene->bodies[body].group = group;
        if (bone->parent >= 0) add_joint(scene, bone, first + bone->parent, first + i, at);
    }
}

void bench_build_people(bench_scene *scene, int32_t n)
{
    int32_t shapes[RAGDOLL_BONES];
    const float half = 20.0f + (float)(PITCH * n);
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(half, 1.0f, 20.0f)), 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < RAGDOLL_BONES; i++) shapes[i] = add_shape(scene, &ragdoll_bones[i]);
    for (int32_t i = 0; i < n; i++) add_person(scene, shapes, (double[]){PITCH * i, PLANE, 0.0}, i + 1);
    scene->warm_up_steps = 20;
    scene->timed_steps = 80;
}

void bench_build_ragdolls(bench_scene *scene, int32_t n)
{
    const int32_t columns = (int32_t)ceil(sqrt((double)n));
    const int32_t side = (int32_t)(PITCH * (columns + 4) / (double)CELL) + 1;
    int32_t shapes[RAGDOLL_BONES];
    bench_add_static(scene, bench_add_shape(scene, bench_make_terrain(side, CELL)), 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < RAGDOLL_BONES; i++) shapes[i] = add_shape(scene, &ragdoll_bones[i]);
    for (int32_t person = 0; person < n; person++) {
        const double x = PITCH * (person % columns - 0.5 * columns), z = PITCH * (person / columns - 0.5 * columns);
        add_person(scene, shapes, (double[]){x, HEIGHT, z}, person + 1);
    }
    scene->warm_up_steps = 60; // they land
    scene->timed_steps = 200;
}
