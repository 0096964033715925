/// @file scene.h
/// A scene is data: shapes, bodies, joints and settings, defined once and built by every engine's adapter (peers/) from the same numbers.
/// The families in scenes/ fill it; the runner, the adapters and tests read it. Metres, kilograms, seconds, radians; y is up.
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum bench_form {
    BENCH_BOX,    ///< half
    BENCH_SPHERE, ///< radius
    BENCH_CAPSULE ///< half_height of the axis, along local y, and radius
} bench_form;

/// A form with its material. Bodies share shapes by their index.
typedef struct bench_shape {
    bench_form form;
    float half[3];     ///< of a box, m
    float radius;      ///< of a sphere or a capsule, m
    float half_height; ///< of a capsule, without its caps, m
    float density;     ///< kg/m3
    float friction;    ///< static = dynamic; engines mix two by sqrt(a b)
    float restitution; ///< 0..1
} bench_shape;

typedef struct bench_pose {
    double position[3]; ///< of the body's centre, m
    double rotation[4]; ///< quaternion x y z w
} bench_pose;

typedef struct bench_body {
    bench_pose start;
    float linear_velocity[3];  ///< m/s
    float angular_velocity[3]; ///< rad/s
    int32_t shape;             ///< index into bench_scene.shapes
    int32_t dynamic;           ///< 0: static
    int32_t collides;          ///< 0: touches nothing
} bench_body;

/// Holds the point `anchor` of both bodies together.
typedef struct bench_joint {
    int32_t body_a, body_b; ///< indices into bench_scene.bodies
    double anchor[3];       ///< at the start, m, world space
} bench_joint;

typedef struct bench_scene {
    char name[64];
    double gravity[3]; ///< m/s2
    float dt;          ///< s
    int32_t warm_up_steps;
    int32_t timed_steps;
    bench_shape *shapes;
    bench_body *bodies;
    bench_joint *joints;
    int32_t shape_count, shape_capacity;
    int32_t body_count, body_capacity;
    int32_t joint_count, joint_capacity;
} bench_scene;

/// Scenes of one kind and any size n: "pyramid-100" is the family "pyramid" with n = 100.
typedef struct bench_family {
    const char *name;
    const char *about;
    int32_t smallest, largest; ///< legal n
    int32_t usual;             ///< n of the speed table
    int32_t is_default;        ///< 1: part of a run that names no scenes
    void (*build)(bench_scene *scene, int32_t n);
} bench_family;

extern const bench_family bench_families[];
extern const int32_t bench_family_count;

/// Builds the scene called "family-n" or "family" (its usual n). 0 on success, -1 when there is no such scene.
int bench_scene_build(const char *name, bench_scene *out_scene);
void bench_scene_destroy(bench_scene *scene);

/// Shapes of density 1000, friction 0.6, restitution 0.
bench_shape bench_make_box(float half_x, float half_y, float half_z);
bench_shape bench_make_sphere(float radius);
bench_shape bench_make_capsule(float half_height, float radius);
/// m3
double bench_shape_volume(const bench_shape *shape);
/// kg, of all dynamic bodies.
double bench_scene_mass(const bench_scene *scene);

/// Each returns the index of what was added, and ends the program when there is no memory.
int32_t bench_add_shape(bench_scene *scene, bench_shape shape);
int32_t bench_add_static(bench_scene *scene, int32_t shape, double x, double y, double z);
int32_t bench_add_dynamic(bench_scene *scene, int32_t shape, double x, double y, double z);
int32_t bench_add_joint(bench_scene *scene, int32_t body_a, int32_t body_b, double x, double y, double z);

void bench_build_rest(bench_scene *scene, int32_t n);
void bench_build_pyramid(bench_scene *scene, int32_t n);
void bench_build_many(bench_scene *scene, int32_t n);
void bench_build_wide(bench_scene *scene, int32_t n);
void bench_build_joints(bench_scene *scene, int32_t n);
void bench_build_bowl(bench_scene *scene, int32_t n);

#ifdef __cplusplus
}
#endif
#endif
