// The table of cases, and what they share (cases.h).
#include "cases.h"

#include <math.h>

static const struct group {
    const bench_case *cases;
    const int32_t *count;
} groups[] = {
    {bench_solver2d_stack, &bench_solver2d_stack_count}, {bench_solver2d_contact, &bench_solver2d_contact_count},
    {bench_solver2d_far, &bench_solver2d_far_count},     {bench_solver2d_joint, &bench_solver2d_joint_count},
    {bench_box3d_stack, &bench_box3d_stack_count},       {bench_box3d_slide, &bench_box3d_slide_count},
    {bench_box3d_world, &bench_box3d_world_count},       {bench_others, &bench_others_count},
    {bench_box3d_more, &bench_box3d_more_count},         {bench_box3d_motion, &bench_box3d_motion_count},
    {bench_box3d_joint, &bench_box3d_joint_count},
};
static const size_t group_count = sizeof groups / sizeof groups[0];

int32_t bench_case_count(void)
{
    int32_t sum = 0;
    for (size_t g = 0; g < group_count; g++) sum += *groups[g].count;
    return sum;
}

const bench_case *bench_case_at(int32_t index)
{
    size_t g = 0;
    while (index >= *groups[g].count) index -= *groups[g++].count;
    return &groups[g].cases[index];
}

static int32_t add_solid(bench_scene *s, bench_shape shape, double density, double friction)
{
    shape.density = (float)density, shape.friction = (float)friction;
    return bench_add_shape(s, shape);
}

int32_t bench_box(bench_scene *s, double half_x, double half_y, double half_z, double density, double friction)
{
    return add_solid(s, bench_make_box((float)half_x, (float)half_y, (float)half_z), density, friction);
}

int32_t bench_sphere(bench_scene *s, double radius, double density, double friction)
{
    return add_solid(s, bench_make_sphere((float)radius), density, friction);
}

int32_t bench_capsule(bench_scene *s, double half_height, double radius, double density, double friction)
{
    return add_solid(s, bench_make_capsule((float)half_height, (float)radius), density, friction);
}

int32_t bench_add_ground(bench_scene *s, double half_x, double friction)
{
    return bench_add_static(s, bench_box(s, half_x, 1.0, half_x, 1.0, friction), 0.0, -1.0, 0.0);
}

int32_t bench_add_anchor(bench_scene *s, double x, double y)
{
    const int32_t body = bench_add_static(s, bench_box(s, 0.1, 0.1, 0.1, 1.0, 0.6), x, y, 0.0);
    s->bodies[body].collides = 0;
    return body;
}

void bench_turn(bench_body *body, double x, double y, double z, double angle)
{
    const double axis[3] = {x, y, z}, length = sqrt(x * x + y * y + z * z);
    for (int k = 0; k < 3; k++) body->start.rotation[k] = sin(0.5 * angle) * axis[k] / length;
    body->start.rotation[3] = cos(0.5 * angle);
}

bench_joint *bench_add_ball(bench_scene *s, int32_t body_a, int32_t body_b, double x, double y, double z)
{
    const int32_t joint = bench_add_joint(s, body_a, body_b, x, y, z); // may move the array
    return &s->joints[joint];
}

bench_joint *bench_add_hinge_z(bench_scene *s, int32_t body_a, int32_t body_b, double x, double y)
{
    bench_joint *joint = bench_add_ball(s, body_a, body_b, x, y, 0.0);
    joint->kind = BENCH_HINGE;
    joint->axis[2] = 1.0;
    return joint;
}
