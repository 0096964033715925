/// @file cases.h
/// What the cases share: grounds, forms, and their table's entries.
#ifndef BENCH_CASES_CASES_H
#define BENCH_CASES_CASES_H

#include "../trial.h"

/// A static box half (half_x, 1, half_x) with its top at y = 0.
int32_t bench_add_ground(bench_scene *scene, double half_x, double friction);
/// A static body that touches nothing, for joints to hold on to.
int32_t bench_add_anchor(bench_scene *scene, double x, double y);
/// Shapes with density and friction; the index.
int32_t bench_box(bench_scene *scene, double half_x, double half_y, double half_z, double density, double friction);
int32_t bench_sphere(bench_scene *scene, double radius, double density, double friction);
int32_t bench_capsule(bench_scene *scene, double half_height, double radius, double density, double friction);
/// Turns a body about an axis, rad.
void bench_turn(bench_body *body, double x, double y, double z, double angle);
/// A ball joint, to be changed before the next one is added.
bench_joint *bench_add_ball(bench_scene *scene, int32_t body_a, int32_t body_b, double x, double y, double z);
/// A hinge about z; in the plane every engine's revolute joint.
bench_joint *bench_add_hinge_z(bench_scene *scene, int32_t body_a, int32_t body_b, double x, double y);

/// Names of the measures that several cases share.
#define BENCH_DRIFT "largest drift, m"
#define BENCH_TILT "largest tilt, rad"
#define BENCH_SPEED "largest speed at the end, m/s"
#define BENCH_GAP "largest joint gap, m"
#define BENCH_DEEPEST "deepest overlap, m"

extern const bench_case bench_solver2d_stack[], bench_solver2d_contact[], bench_solver2d_far[], bench_solver2d_joint[];
extern const int32_t bench_solver2d_stack_count, bench_solver2d_contact_count, bench_solver2d_far_count,
    bench_solver2d_joint_count;
extern const bench_case bench_box3d_stack[], bench_box3d_slide[], bench_box3d_motion[], bench_box3d_joint[];
extern const int32_t bench_box3d_stack_count, bench_box3d_slide_count, bench_box3d_motion_count,
    bench_box3d_joint_count;

extern const bench_case bench_box3d_world[], bench_box3d_more[], bench_others[];
extern const int32_t bench_box3d_world_count, bench_box3d_more_count, bench_others_count;

#endif
