/// @file scene.h
/// A scene is data: shapes, bodies, joints and settings, defined once and built by every engine's adapter (peers/) from
/// the same numbers. The families in scenes/ fill it; the runner, the adapters and tests read it. Metres, kilograms,
/// seconds, radians; y is up.
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include "solid.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BENCH_PI 3.14159265358979323846

typedef enum bench_form {
    BENCH_BOX,     ///< half
    BENCH_SPHERE,  ///< radius
    BENCH_CAPSULE, ///< half_height of the axis, along local y, and radius
    BENCH_TERRAIN, ///< side x side samples, `cell` m apart, of bench_terrain_height, about the body's position; static,
                   ///< for queries
    BENCH_HULL,    ///< solid
    BENCH_CYLINDER, ///< half_height along local y, and radius
    BENCH_MESH,     ///< bench_hills of `side` cells; static
    BENCH_COMPOUND  ///< part_count boxes `parts`
} bench_form;

/// A box of a compound, not turned.
typedef struct bench_part {
    double at[3]; ///< its middle, m, from the body's centre of mass
    float half[3];
} bench_part;

typedef enum bench_relief {
    BENCH_HILLS, ///< of some metres
    BENCH_WAVES  ///< 0.5 sin sin, in z of 10 samples' length, in x of 5: Box3D's wave height field
} bench_relief;

/// A form with its material. Bodies share shapes by their index.
typedef struct bench_shape {
    bench_form form;
    float half[3];      ///< of a box, m
    float radius;       ///< of a sphere, a capsule or a cylinder, m
    float half_height;  ///< of a capsule, without its caps, or a cylinder, m
    int32_t side;       ///< of a terrain: samples, of a mesh: cells
    int32_t relief;     ///< of a terrain, bench_relief
    float cell;         ///< of a terrain, m
    float density;      ///< kg/m3
    float friction;     ///< static = dynamic; engines mix two by sqrt(a b)
    float restitution;  ///< 0..1
    float rolling;      ///< resistance to rolling: torque over radius and normal force
    bench_solid *solid; ///< of a hull; the scene frees it
    bench_part *parts;  ///< of a compound; likewise
    int32_t part_count;
} bench_shape;

/// Indexed triangles, counterclockwise seen from outside.
typedef struct bench_mesh {
    float *vertices;  ///< x y z each, m
    int32_t *indices; ///< three a triangle
    int32_t vertex_count, triangle_count;
} bench_mesh;

/// What stands still, for the measure of overlaps.
typedef enum bench_ground {
    BENCH_GROUND_NONE,  ///< not measured
    BENCH_GROUND_FLOOR, ///< the plane y = 0
    BENCH_GROUND_PIT,   ///< bench_add_pit
    BENCH_GROUND_MESH   ///< bench_hills of BENCH_HILLS_CELLS
} bench_ground;

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
    int32_t group;             ///< bodies of one group, if it is not 0, do not touch each other
    int32_t linear_locks;      ///< bits: 1 x, 2 y, 4 z of the world
    int32_t angular_locks;     ///< likewise, turns about the axes
    float gravity_scale;
    float linear_damping, angular_damping; ///< 1/s
} bench_body;

typedef enum bench_joint_kind {
    BENCH_BALL,    ///< the point stays together; `limits` bound the twist about `axis`, `cone` the swing of `axis`
    BENCH_HINGE,   ///< the point and the axis; `limits` bound the angle
    BENCH_SLIDER,  ///< moves along the axis and does not turn; `limits` bound the way, m
    BENCH_FIXED,   ///< moves not at all
    BENCH_DISTANCE ///< `anchor` of A and `anchor_b` of B keep their distance
} bench_joint_kind;

/// Zero is "none" for all but kind, bodies and anchor; the pose at the start is the zero of angles and ways.
typedef struct bench_joint {
    bench_joint_kind kind;
    int32_t body_a, body_b; ///< indices into bench_scene.bodies
    double anchor[3];       ///< at the start, m, world space
    double anchor_b[3];     ///< of B, where it is not `anchor` (is_open), m
    int32_t is_open;        ///< 1: the points do not meet at the start
    double axis[3];         ///< unit, world space
    int32_t has_limits;
    double limits[2];       ///< rad or m
    double cone;            ///< largest swing, rad
    double motor_speed;     ///< rad/s or m/s
    double motor_max;       ///< largest, N m or N; with speed 0 it is a friction
    double hertz, damping;  ///< of a spring towards the zero: frequency, damping ratio
    double stiffness_hertz; ///< of the joint itself, 0: the engine's own
} bench_joint;

typedef struct bench_scene {
    char name[64];
    double gravity[3];     ///< m/s2
    int32_t always_bounce; ///< 1: the slowest impact bounces; 0: below 1 m/s none does
    float dt;              ///< s
    int32_t warm_up_steps;
    int32_t timed_steps;
    double query_half;  ///< queries start within so many m of the middle, in x and z; 0: where the bodies of the speed
                        ///< scenes are
    float query_radius; ///< of the spheres that are swept, m
    bench_ground ground;
    int32_t planar; ///< 1: all happens in the plane z = 0, see bench_make_planar
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
bench_shape bench_make_terrain(int32_t side, float cell);
/// m, of the sample in a row (along z) and a column (along x)
float bench_terrain_height(const bench_shape *terrain, int32_t row, int32_t column);
bench_shape bench_make_cylinder(float half_height, float radius);
bench_shape bench_make_mesh(int32_t cells);
bench_shape bench_make_hull(bench_solid *solid);                        ///< it belongs to the shape
bench_shape bench_make_compound(bench_part *parts, int32_t part_count); ///< likewise
/// About the centre of mass at 1 kg/m3, of a hull or a compound: entries xx yy zz xy yz zx, kg m2
void bench_shape_inertia(const bench_shape *shape, double *out);
/// A scene laid out in the plane z = 0 becomes the twin of a two-dimensional one: bodies are locked to the plane; boxes
/// get the depth 1 m; spheres and capsules get the mass of a disc or a stadium of depth 1 m and the same density (a
/// sphere's inertia stays 2/5 m r2 where a disc has 1/2).
void bench_make_planar(bench_scene *scene);
/// m2, of the outline in the plane z = 0
double bench_shape_area(const bench_shape *shape);
/// m3
double bench_shape_volume(const bench_shape *shape);
/// kg, of all dynamic bodies.
double bench_scene_mass(const bench_scene *scene);

/// Each returns the index of what was added, and ends the program when there is no memory.
int32_t bench_add_shape(bench_scene *scene, bench_shape shape);
int32_t bench_add_static(bench_scene *scene, int32_t shape, double x, double y, double z);
int32_t bench_add_dynamic(bench_scene *scene, int32_t shape, double x, double y, double z);
int32_t bench_add_joint(bench_scene *scene, int32_t body_a, int32_t body_b, double x, double y,
                        double z); ///< a ball joint
/// Turns a body about the world's z axis, rad.
void bench_turn_z(bench_body *body, double angle);

/// A ground and the four walls of a pit of 12 x 12 m about the middle; the walls have friction 0.3.
/// @param half_height  of a wall, m; it begins 1 m below the ground's top
void bench_add_pit(bench_scene *scene, float half_height);

enum { BENCH_HILLS_CELLS = 256 }; ///< a side, of the scenes' ground
/// Hills of cells x cells squares of 1 m, two triangles each, about the middle.
bench_mesh bench_hills(int32_t cells);
void bench_mesh_free(bench_mesh *mesh);
/// Of the hills of BENCH_HILLS_CELLS: height and unit normal. 0 beyond their rim.
int bench_hills_height(double x, double z, double *out_height, double *out_normal);
/// From a point to the nearest of their triangles, m: exact where that is less than a cell away.
double bench_hills_distance(const double *point);

/// Uniform over all rotations, a quaternion x y z w.
void bench_draw_rotation(uint64_t *state, double *out);
/// The hull of least to most points, 32 at most, that lie on an ellipsoid of half axes from 0.35 to 0.6 m or up to 15 %
/// inside of it.
bench_shape bench_draw_rock(uint64_t *state, int32_t least, int32_t most);

void bench_build_hulls(bench_scene *scene, int32_t n);
void bench_build_hullpyramid(bench_scene *scene, int32_t n);
void bench_build_rocks(bench_scene *scene, int32_t n);
void bench_build_mixedmesh(bench_scene *scene, int32_t n);
void bench_build_cylinders(bench_scene *scene, int32_t n);
void bench_build_compounds(bench_scene *scene, int32_t n);
void bench_build_mesh(bench_scene *scene, int32_t n);
void bench_build_hullcloud(bench_scene *scene, int32_t n);
void bench_build_rest(bench_scene *scene, int32_t n);
void bench_build_pyramid(bench_scene *scene, int32_t n);
void bench_build_many(bench_scene *scene, int32_t n);
void bench_build_wide(bench_scene *scene, int32_t n);
void bench_build_raft(bench_scene *scene, int32_t n);
void bench_build_joints(bench_scene *scene, int32_t n);
void bench_build_bowl(bench_scene *scene, int32_t n);
void bench_build_fall(bench_scene *scene, int32_t n);
void bench_build_awake(bench_scene *scene, int32_t n);
void bench_build_level(bench_scene *scene, int32_t n);
void bench_build_terrain(bench_scene *scene, int32_t n);
void bench_build_ragdolls(bench_scene *scene, int32_t n);
void bench_build_people(bench_scene *scene, int32_t n);
void bench_build_hoppers(bench_scene *scene, int32_t n);
void bench_build_pushers(bench_scene *scene, int32_t n);
void bench_build_pile(bench_scene *scene, int32_t n);
void bench_build_debris(bench_scene *scene, int32_t n);
void bench_build_balls(bench_scene *scene, int32_t n);
void bench_build_capsulespit(bench_scene *scene, int32_t n);
void bench_build_grid(bench_scene *scene, int32_t n);
void bench_build_wall(bench_scene *scene, int32_t n);
void bench_build_dominoes(bench_scene *scene, int32_t n);
void bench_build_landslide(bench_scene *scene, int32_t n);
void bench_build_blast(bench_scene *scene, int32_t n);
void bench_build_town(bench_scene *scene, int32_t n);
void bench_build_volley(bench_scene *scene, int32_t n);
void bench_build_chains(bench_scene *scene, int32_t n);

#ifdef __cplusplus
}
#endif
#endif
