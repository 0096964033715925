/// @file feather.h
/// Feather: 3D rigid-body physics with a C99 interface.
///
/// A **world** holds everything. Inside it, bodies, shapes and joints are named by **handles**: integers with a generation, so that the
/// handle of something destroyed, or a number made up, is an error and never a crash. A body has a pose, a mass and velocities; its shapes
/// give it form, material and filters. `fe_world_step` moves the world on; then events and poses are read as arrays. Nothing calls back.
///
/// **Units and frames.** Metres, kilograms, seconds, radians. Right-handed axes, no built-in up. Quaternions are x, y, z, w. World
/// positions are double, everything else float. A contact's normal points from its body A to its body B.
///
/// **Results.** What can fail returns an `fe_result`: FE_OK is 0, positive values inform, negative values are errors and have changed
/// nothing. Every function that takes them checks these, and the notes at each function name only what is special to it:
///   - a NULL pointer that is not documented as optional, NaN or infinity, a value out of its range: FE_ERROR_ARGUMENT
///   - a handle of something destroyed, or of nothing: FE_ERROR_STALE;  a shape's handle where a body's is asked: FE_ERROR_KIND
///   - any call but `_is_valid` while this world steps on another thread: FE_ERROR_STEPPING
///   - no memory: FE_ERROR_MEMORY
/// `fe_last_error` tells the last failure of the calling thread in a sentence. Values come out through `out_` pointers, which are written
/// on success only.
///
/// **Ranges.** Beyond what a function says: positions within 1e9 m, translations of queries 1e10 m, local positions 1e6 m; speeds, spins
/// and gravity 1e6; forces, torques and impulses 1e15 a call (what is summed for a step accelerates by at most 1e9 m/s2); densities 1e7
/// kg/m3; masses 1e-9..1e18 kg, moments of inertia 1e-18..1e30 kg m2; other values 1e6. Switches (int32_t enabled, trigger...) are 0 or 1.
///
/// **Arrays.** `int32_t fe_x_get_many(world, out, stride, capacity)` returns how many there are, or a negative fe_result; it writes the
/// first `capacity` of them, `stride` bytes apart (0: packed; a shorter stride than the record's size, at least 8, gives its front only).
/// NULL, 0, 0 asks for the number only.
///
/// **Growth.** A definition begins with `struct_size` and is filled with its defaults by its `_init(&def, sizeof def)` (NULL does nothing);
/// a shorter one of an older client and a longer one with a zero tail are accepted. What is read into such a struct needs its
/// `struct_size` set before. fe_vec3, fe_quat, fe_dvec3, fe_transform and fe_material never change.
///
/// **Threads.** Different worlds are independent. Within one world: functions that take a `const fe_world *` only read, and any number of
/// threads may call them at once while none writes; all others write and need the world to themselves.
///
/// **Determinism.** The same calls in the same order give the same bits, handles and events: on every machine, with every number of workers
/// and every SIMD width. `fe_world_hash` compares two runs.
#ifndef FEATHER_H
#define FEATHER_H

#include <stdint.h>

#define FE_VERSION_MAJOR 1
#define FE_VERSION_MINOR 0
#define FE_VERSION_PATCH 0

#ifdef SWIG
#define FE_API
#elif defined(_WIN32) && defined(FE_SHARED)
#ifdef FE_BUILD
#define FE_API __declspec(dllexport)
#else
#define FE_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define FE_API __attribute__((visibility("default")))
#else
#define FE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- basics -------------------------------------------------------------------------------------------------------------------

/// Names something inside a world. 0 is nothing; every other value is below 2^53, so that it survives a double.
typedef unsigned long long fe_handle;
typedef fe_handle fe_body;
typedef fe_handle fe_shape;
typedef fe_handle fe_joint;
typedef fe_handle fe_asset; ///< what shapes share: a heightfield

typedef struct fe_world fe_world; ///< everything that can touch each other
typedef struct fe_pool fe_pool;   ///< worker threads that several worlds may share

typedef struct fe_vec3 {
    float x, y, z;
} fe_vec3;

/// A world position, m, or a translation of a query.
typedef struct fe_dvec3 {
    double x, y, z;
} fe_dvec3;

/// A rotation. Read as q/|q|: any length but zero will do.
typedef struct fe_quat {
    float x, y, z, w;
} fe_quat;

typedef struct fe_transform {
    fe_dvec3 position; ///< m
    fe_quat rotation;
} fe_transform;

typedef enum fe_result {
    FE_OK = 0,
    FE_MISS = 1,               ///< a query that found nothing
    FE_ERROR_ARGUMENT = -1,    ///< NULL, NaN, infinity, out of range
    FE_ERROR_STALE = -2,       ///< the handle of something destroyed, or of nothing
    FE_ERROR_KIND = -3,        ///< a shape's handle where a body's is asked
    FE_ERROR_STEPPING = -4,    ///< the world is in a step
    FE_ERROR_MEMORY = -5,      ///< the allocator gave nothing
    FE_ERROR_LIMIT = -6,       ///< more than a world or a handle can hold
    FE_ERROR_UNSUPPORTED = -7, ///< this CPU or this kind of body cannot
    FE_ERROR_STATE = -8,       ///< not now: the pool still has worlds, the body is not kinematic...
    FE_RESULT_FORCE32 = 0x7fffffff
} fe_result;

/// The library's version: major << 16 | minor << 8 | patch. Compare with FE_VERSION_MAJOR... to find a mismatch of header and binary.
FE_API uint32_t fe_version(void);
/// The last failure of the calling thread: function, argument, value, legal range. Valid until that thread's next failure; success does
/// not clear it. Never NULL.
FE_API const char *fe_last_error(void);
/// "FE_ERROR_STALE" for FE_ERROR_STALE, and so on; "unknown" for what is no result.
FE_API const char *fe_result_name(int32_t result);

// ---- pools --------------------------------------------------------------------------------------------------------------------

/// Starts a pool of workers that worlds can share (fe_world_def.pool). The thread that steps a world works too, so that a pool of n workers
/// starts n - 1 threads; they sleep while nothing steps.
/// @param worker_count  1..64
FE_API fe_result fe_pool_create(int32_t worker_count, fe_pool **out_pool);
/// Ends the threads. FE_ERROR_STATE while a world uses the pool.
FE_API fe_result fe_pool_destroy(fe_pool *pool);

// ---- worlds -------------------------------------------------------------------------------------------------------------------

typedef enum fe_simd {
    FE_SIMD_AUTO = 0,  ///< the widest that this CPU has (the environment variable FE_SIMD = plain, sse2, avx2, avx512, neon overrides)
    FE_SIMD_PLAIN = 1, ///< C without intrinsics
    FE_SIMD_SSE2 = 2,
    FE_SIMD_AVX2 = 3,
    FE_SIMD_AVX512 = 4,
    FE_SIMD_NEON = 5,
    FE_SIMD_FORCE32 = 0x7fffffff
} fe_simd;

/// The host's allocator. Both are called from the thread that uses the world, never by workers.
typedef struct fe_allocator {
    uint32_t struct_size;
    uint32_t reserved; ///< 0
    /// `size` bytes aligned to `alignment` (a power of two, at most 64), or NULL
    void *(*allocate)(void *user, uint64_t size, uint64_t alignment);
    void (*release)(void *user, void *memory, uint64_t size);
    void *user;
} fe_allocator;

typedef void (*fe_task)(void *argument, int32_t index);

/// The host's job system, instead of a pool. `run` calls task(argument, i) once for each i in [0, count), on any threads, in any order, and
/// returns when all have returned. A task never waits for one that has not started, so one thread is enough.
typedef struct fe_task_system {
    uint32_t struct_size;
    int32_t worker_count; ///< 1..64: the largest count it is asked for
    void (*run)(void *user, fe_task task, void *argument, int32_t count);
    void *user;
} fe_task_system;

typedef struct fe_world_def {
    uint32_t struct_size;
    int32_t worker_count;          ///< 1..64 workers of its own, 1: none; ignored with a pool or a task system. Default 1
    fe_vec3 gravity;               ///< m/s2. Default 0, -9.81, 0
    int32_t substeps;              ///< 1..64. Default 8
    int32_t simd;                  ///< fe_simd. Default FE_SIMD_AUTO
    fe_pool *pool;                 ///< or NULL
    const fe_allocator *allocator; ///< copied; NULL: malloc
    const fe_task_system *tasks;   ///< copied; NULL: the pool or the world's own workers
    fe_handle user_data;
} fe_world_def;

FE_API void fe_world_def_init(fe_world_def *desc, uint32_t struct_size);
/// @param desc  NULL: the defaults
/// @return FE_ERROR_UNSUPPORTED when this CPU lacks the SIMD set asked for
FE_API fe_result fe_world_create(const fe_world_def *desc, fe_world **out_world);
/// Destroys the world and all in it; the pointer is dead afterwards. NULL is FE_ERROR_ARGUMENT.
FE_API fe_result fe_world_destroy(fe_world *world);
/// Moves the world on by dt seconds.
///
/// FE_ERROR_MEMORY leaves the world as it was before the call, and it can be stepped again. It takes less than 32 KB of the caller's stack.
/// @param dt  0..1 s; 0 updates contacts and events and moves nothing
FE_API fe_result fe_world_step(fe_world *world, float dt);

/// m/s2. A change wakes all dynamic bodies.
FE_API fe_result fe_world_set_gravity(fe_world *world, const fe_vec3 *gravity);
FE_API fe_result fe_world_get_gravity(const fe_world *world, fe_vec3 *out_gravity);
/// @param substeps  1..64
FE_API fe_result fe_world_set_substeps(fe_world *world, int32_t substeps);
FE_API fe_result fe_world_get_substeps(const fe_world *world, int32_t *out_substeps);
FE_API fe_result fe_world_get_user_data(const fe_world *world, fe_handle *out_user_data);

/// How the solver behaves. Each value may change between steps.
typedef struct fe_world_tuning {
    uint32_t struct_size;
    float contact_hertz; ///< stiffness of contacts, 1/s, > 0; twice that against static bodies; at most an eighth of the substep rate. 30
    float contact_damping_ratio; ///< >= 0; 1 is critical, higher pushes out more gently. 10
    float contact_push_speed;    ///< overlap is pushed out no faster, m/s, >= 0. 3
    float joint_hertz;           ///< stiffness of joints, 1/s, > 0; at most 0.225 of the substep rate. 60
    float joint_damping_ratio;   ///< >= 0. 2
    float restitution_threshold; ///< slower impacts do not bounce, m/s, >= 0. 1
    float hit_event_threshold;   ///< slower impacts make no hit event, m/s, >= 0. 1
    float sleep_time;            ///< how long a body must be slow before it may sleep, s, >= 0. 0.5
    float speculative_distance;  ///< contacts are made up to this gap, m, 0.001..0.1. 0.02
    float max_linear_speed;      ///< m/s, > 0. 4000
} fe_world_tuning;

FE_API void fe_world_tuning_init(fe_world_tuning *tuning, uint32_t struct_size);
/// Takes effect with the next step; wakes nobody.
FE_API fe_result fe_world_set_tuning(fe_world *world, const fe_world_tuning *tuning);
/// @param out_tuning  its struct_size must be set
FE_API fe_result fe_world_get_tuning(const fe_world *world, fe_world_tuning *out_tuning);

/// While ignored, two bodies never collide, whatever their layers. Takes effect at the next step.
FE_API fe_result fe_world_ignore_collision(fe_world *world, fe_body a, fe_body b, int32_t ignore);
/// Rebalances the trees that serve the queries. Never needed for right answers; worth a call after a level is loaded.
FE_API fe_result fe_world_sync_queries(fe_world *world);

/// Where the last step's time went, ms of the stepping thread's clock.
typedef struct fe_profile {
    uint32_t struct_size;
    float step;       ///< all of it
    float pairs;      ///< tree queries, new pairs
    float collide;    ///< narrow phase, recycling
    float islands;    ///< islands, colours, batches
    float solve;      ///< all substeps
    float continuous; ///< bodies too fast for their size
    float finalize;   ///< poses, bounds, trees
    float events;
    float sleep;
} fe_profile;

/// @param out_profile  its struct_size must be set
FE_API fe_result fe_world_get_profile(const fe_world *world, fe_profile *out_profile);

typedef struct fe_counters {
    uint32_t struct_size;
    int32_t bodies, shapes, joints;
    int32_t awake_bodies;
    int32_t pairs;      ///< pairs of shapes whose bounds meet
    int32_t contacts;   ///< of these, touching, triggers not counted
    int32_t recycled;   ///< contacts that kept their manifold in the last step
    int32_t islands;    ///< awake
    int32_t colours;    ///< of the largest island
    int32_t rows;       ///< of W contacts each, or of 4 where a colour has no more
    int32_t rows_whole; ///< of these, in islands that one worker solved whole
    int32_t lanes;      ///< contacts in all rows
    int32_t simd;       ///< fe_simd in use
    int32_t simd_width; ///< W, floats side by side
    int32_t workers;
    int64_t bytes;       ///< allocated now
    int64_t allocations; ///< since the world was created
    int32_t trees;       ///< awake sets of joints without a loop that were solved exactly, at once: under a heavy load, or struck
} fe_counters;

/// @param out_counters  its struct_size must be set
FE_API fe_result fe_world_get_counters(const fe_world *world, fe_counters *out_counters);
/// 64 bits over poses, velocities, contacts and events, low word first. Equal for equal runs, whatever the workers, the SIMD set, the
/// compiler.
/// @param out_words  2 words
FE_API fe_result fe_world_hash(const fe_world *world, uint32_t *out_words);
/// All bodies, in the order of creation.
FE_API int32_t fe_world_get_bodies(const fe_world *world, fe_body *out_bodies, int32_t capacity);

// ---- bodies -------------------------------------------------------------------------------------------------------------------

typedef enum fe_body_type {
    FE_BODY_STATIC = 0,    ///< never moves by itself
    FE_BODY_KINEMATIC = 1, ///< moves by its velocities, which nothing else changes
    FE_BODY_DYNAMIC = 2,   ///< moves by forces and contacts
    FE_BODY_TYPE_FORCE32 = 0x7fffffff
} fe_body_type;

typedef enum fe_axis {
    FE_AXIS_NONE = 0,
    FE_AXIS_X = 1,
    FE_AXIS_Y = 2,
    FE_AXIS_Z = 4,
    FE_AXIS_ALL = 7,
    FE_AXIS_FORCE32 = 0x7fffffff
} fe_axis;

typedef struct fe_body_def {
    uint32_t struct_size;
    int32_t type;             ///< fe_body_type. Default FE_BODY_DYNAMIC
    fe_transform transform;   ///< of the body's origin
    fe_vec3 linear_velocity;  ///< of the centre of mass, m/s
    fe_vec3 angular_velocity; ///< rad/s, world axes
    float linear_damping;     ///< 1/s, >= 0: v /= 1 + h c in each substep. Default 0
    float angular_damping;    ///< 1/s, >= 0. Default 0
    float gravity_scale;      ///< Default 1
    float sleep_threshold;    ///< may sleep when its fastest point is slower, m/s, >= 0. Default 0.05
    uint32_t linear_locks;    ///< FE_AXIS_X | ...: world axes along which it cannot move
    uint32_t angular_locks;   ///< world axes around which it cannot turn
    int32_t awake;            ///< 0: starts asleep, at rest. Default 1
    int32_t sleep_allowed;    ///< Default 1
    int32_t enabled;          ///< 0: neither moves, nor collides, nor is seen by queries. Default 1
    int32_t bullet;           ///< 1: stopped by moving bodies too when it is fast. Default 0
    fe_handle user_data;
} fe_body_def;

FE_API void fe_body_def_init(fe_body_def *desc, uint32_t struct_size);
/// A dynamic body without shapes, or with shapes that weigh less than 1e-9 kg, has 1 kg and the inertia of a sphere of 1 m until it gets a
/// shape or a mass.
/// @param desc  NULL: the defaults
FE_API fe_result fe_body_create(fe_world *world, const fe_body_def *desc, fe_body *out_body);
/// All or none. @param stride  bytes from one def to the next, 0: packed
FE_API fe_result fe_body_create_many(fe_world *world, const fe_body_def *descs, uint32_t stride, int32_t count, fe_body *out_bodies);
/// Destroys its shapes and joints too; pairs that touched send their exit with the next step's events.
FE_API fe_result fe_body_destroy(fe_world *world, fe_body body);
/// All or none: one stale handle, or one given twice, and none is destroyed.
FE_API fe_result fe_body_destroy_many(fe_world *world, const fe_body *bodies, int32_t count);
/// 1 for a living body of this world, 0 for anything else.
FE_API int32_t fe_body_is_valid(const fe_world *world, fe_body body);

/// Its touching pairs send their exit and are found anew; it and what it touched wake. Forces not yet applied are dropped, so are the
/// velocities of what becomes static, and a mass that was set once the body is not dynamic.
/// @param type  fe_body_type
/// @return FE_ERROR_UNSUPPORTED when a body with a plane or a heightfield is to be other than static
FE_API fe_result fe_body_set_type(fe_world *world, fe_body body, int32_t type);
FE_API fe_result fe_body_get_type(const fe_world *world, fe_body body, int32_t *out_type);
/// Puts the body there at once, through whatever is between, and wakes it and what it touched.
FE_API fe_result fe_body_set_transform(fe_world *world, fe_body body, const fe_transform *transform);
FE_API fe_result fe_body_get_transform(const fe_world *world, fe_body body, fe_transform *out_transform);
/// Centre of mass, m, world space.
FE_API fe_result fe_body_get_centre(const fe_world *world, fe_body body, fe_dvec3 *out_centre);
/// Of the centre of mass, m/s. Setting a velocity wakes the body; what is locked stays 0. FE_ERROR_STATE on a static body.
FE_API fe_result fe_body_set_linear_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity);
FE_API fe_result fe_body_get_linear_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity);
/// rad/s, world axes; else as the linear one.
FE_API fe_result fe_body_set_angular_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity);
FE_API fe_result fe_body_get_angular_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity);
/// Of the material point now at `point`, m/s.
FE_API fe_result fe_body_get_point_velocity(const fe_world *world, fe_body body, const fe_dvec3 *point, fe_vec3 *out_velocity);
/// Gives a kinematic body the velocities that bring it to `target` in `seconds`. FE_ERROR_STATE on other types.
/// @param seconds  > 0
FE_API fe_result fe_body_set_target(fe_world *world, fe_body body, const fe_transform *target, float seconds);

/// Force at the centre of mass, N, world axes, during all of the next step only. Wakes the body; on a body that is disabled or not dynamic,
/// nothing.
FE_API fe_result fe_body_add_force(fe_world *world, fe_body body, const fe_vec3 *force);
/// Force at a point of the world, N; its torque is the one of that point now.
FE_API fe_result fe_body_add_force_at(fe_world *world, fe_body body, const fe_vec3 *force, const fe_dvec3 *point);
/// N m, world axes, during all of the next step only.
FE_API fe_result fe_body_add_torque(fe_world *world, fe_body body, const fe_vec3 *torque);
/// Changes the velocity at once by impulse / mass. N s.
FE_API fe_result fe_body_add_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse);
/// At a point of the world, m: changes the spin too.
FE_API fe_result fe_body_add_impulse_at(fe_world *world, fe_body body, const fe_vec3 *impulse, const fe_dvec3 *point);
/// N m s.
FE_API fe_result fe_body_add_angular_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse);

typedef struct fe_mass_data {
    uint32_t struct_size;
    float mass;               ///< kg, > 0
    fe_vec3 centre;           ///< of mass, m, body space
    fe_vec3 inertia;          ///< principal moments about the centre of mass, kg m2, > 0, none above the sum of the other two
    fe_quat inertia_rotation; ///< principal axes in body space
} fe_mass_data;

/// Overrides what the shapes give, until fe_body_reset_mass or a change of type. FE_ERROR_STATE on a body that is not dynamic.
FE_API fe_result fe_body_set_mass_data(fe_world *world, fe_body body, const fe_mass_data *data);
/// What the solver uses. @param out_data  its struct_size must be set
FE_API fe_result fe_body_get_mass_data(const fe_world *world, fe_body body, fe_mass_data *out_data);
/// Sets the mass, kg, > 0, and scales the inertia with it; overrides until fe_body_reset_mass.
FE_API fe_result fe_body_set_mass(fe_world *world, fe_body body, float mass);
/// kg; 0 for a body that is not dynamic.
FE_API fe_result fe_body_get_mass(const fe_world *world, fe_body body, float *out_mass);
/// Mass and inertia from the shapes and their densities again.
FE_API fe_result fe_body_reset_mass(fe_world *world, fe_body body);

/// World axes along and around which the body cannot move: its coordinates there stay bit for bit, and the solver knows. FE_AXIS_*.
FE_API fe_result fe_body_set_locks(fe_world *world, fe_body body, uint32_t linear_axes, uint32_t angular_axes);
FE_API fe_result fe_body_get_locks(const fe_world *world, fe_body body, uint32_t *out_linear_axes, uint32_t *out_angular_axes);
/// 1/s, >= 0.
FE_API fe_result fe_body_set_damping(fe_world *world, fe_body body, float linear, float angular);
FE_API fe_result fe_body_get_damping(const fe_world *world, fe_body body, float *out_linear, float *out_angular);
/// How many times the world's gravity acts on it; below 0 it rises. A change wakes it.
FE_API fe_result fe_body_set_gravity_scale(fe_world *world, fe_body body, float scale);
FE_API fe_result fe_body_get_gravity_scale(const fe_world *world, fe_body body, float *out_scale);
/// Waking a body wakes all it touches, through other dynamic bodies. Putting it to sleep stops it and all those (FE_ERROR_STATE when one of
/// them may not sleep: then nothing changes).
FE_API fe_result fe_body_set_awake(fe_world *world, fe_body body, int32_t awake);
/// 1 awake, 0 asleep; static bodies are never awake.
FE_API fe_result fe_body_get_awake(const fe_world *world, fe_body body, int32_t *out_awake);
/// 0 wakes the body and keeps awake all it touches.
FE_API fe_result fe_body_set_sleep_allowed(fe_world *world, fe_body body, int32_t allowed);
FE_API fe_result fe_body_get_sleep_allowed(const fe_world *world, fe_body body, int32_t *out_allowed);
/// m/s, >= 0.
FE_API fe_result fe_body_set_sleep_threshold(fe_world *world, fe_body body, float speed);
FE_API fe_result fe_body_get_sleep_threshold(const fe_world *world, fe_body body, float *out_speed);
/// A disabled body keeps its place but neither moves, nor collides, nor is seen by queries. Its touching pairs send their exit.
FE_API fe_result fe_body_set_enabled(fe_world *world, fe_body body, int32_t enabled);
FE_API fe_result fe_body_get_enabled(const fe_world *world, fe_body body, int32_t *out_enabled);
/// See fe_body_def.
FE_API fe_result fe_body_set_bullet(fe_world *world, fe_body body, int32_t bullet);
FE_API fe_result fe_body_get_bullet(const fe_world *world, fe_body body, int32_t *out_bullet);
FE_API fe_result fe_body_set_user_data(fe_world *world, fe_body body, fe_handle user_data);
FE_API fe_result fe_body_get_user_data(const fe_world *world, fe_body body, fe_handle *out_user_data);
/// Layer and mask of all its shapes (see fe_shape_def). FE_ERROR_STATE when it has none.
FE_API fe_result fe_body_set_filter(fe_world *world, fe_body body, uint32_t layer, uint32_t mask);
/// Its shapes in the order of creation.
FE_API int32_t fe_body_get_shapes(const fe_world *world, fe_body body, fe_shape *out_shapes, int32_t capacity);

// ---- shapes -------------------------------------------------------------------------------------------------------------------

typedef enum fe_geometry_type {
    FE_GEOMETRY_SPHERE = 0,      ///< radius
    FE_GEOMETRY_CAPSULE = 1,     ///< half_height of the axis, along local Y, and radius
    FE_GEOMETRY_BOX = 2,         ///< half_extents
    FE_GEOMETRY_PLANE = 3,       ///< the half space normal . p <= distance; static bodies only
    FE_GEOMETRY_HEIGHTFIELD = 4, ///< asset: a grid of heights; static bodies only
    FE_GEOMETRY_TYPE_FORCE32 = 0x7fffffff
} fe_geometry_type;

/// The form of a shape, in the shape's frame, m. Every length lies in [0.001, 100000].
typedef struct fe_geometry {
    uint32_t struct_size;
    int32_t type; ///< fe_geometry_type
    float radius;
    float half_height;
    fe_vec3 half_extents;
    fe_vec3 normal; ///< any length but zero
    float distance;
    fe_asset asset; ///< of a heightfield
} fe_geometry;

/// Fills a geometry; what is out of range is found where the geometry is used. NULL does nothing.
FE_API void fe_geometry_sphere(fe_geometry *out_geometry, float radius);
FE_API void fe_geometry_capsule(fe_geometry *out_geometry, float half_height, float radius);
FE_API void fe_geometry_box(fe_geometry *out_geometry, float half_x, float half_y, float half_z);
FE_API void fe_geometry_plane(fe_geometry *out_geometry, float normal_x, float normal_y, float normal_z, float distance);
FE_API void fe_geometry_heightfield(fe_geometry *out_geometry, fe_asset heightfield);

/// Two materials mix: friction sqrt(a b), the other three max(a, b).
typedef struct fe_material {
    float static_friction;     ///< while the contact sticks, >= 0. Default 0.6
    float dynamic_friction;    ///< when it slides, >= 0. Default 0.5
    float restitution;         ///< 0..1. Default 0
    float rolling_resistance;  ///< no unit, >= 0: torque cap = it x radius x normal force. Default 0
    float spinning_resistance; ///< m, >= 0: torque cap about the normal = it x normal force. Default 0
} fe_material;

typedef enum fe_shape_events {
    FE_EVENTS_NONE = 0,
    FE_EVENTS_TOUCH = 1, ///< enter and exit
    FE_EVENTS_STAY = 2,  ///< every step while it lasts
    FE_EVENTS_HIT = 4,   ///< impacts above fe_world_tuning.hit_event_threshold
    FE_SHAPE_EVENTS_FORCE32 = 0x7fffffff
} fe_shape_events;

typedef struct fe_shape_def {
    uint32_t struct_size;
    float density;          ///< kg/m3, >= 0; a trigger weighs too. Default 1000
    fe_vec3 local_position; ///< in the body's frame, m
    fe_quat local_rotation;
    fe_material material;
    uint32_t layer;           ///< exactly one bit. Default 1
    uint32_t mask;            ///< the layers it collides with; 0: seen by queries only. Default all
    int32_t trigger;          ///< 1: reports what it touches (dynamic and kinematic bodies, asleep or awake) and pushes nothing. Default 0
    uint32_t events;          ///< fe_shape_events; a pair has what either shape asks for. Default FE_EVENTS_TOUCH
    fe_vec3 surface_velocity; ///< of a conveyor belt, m/s, shape frame; only its part along the contact acts
    fe_handle user_data;
} fe_shape_def;

FE_API void fe_shape_def_init(fe_shape_def *desc, uint32_t struct_size);
/// Two shapes collide when each one's layer is in the other's mask. Mass and inertia of the body follow; it is not woken.
/// @param desc  NULL: the defaults
/// @return FE_ERROR_UNSUPPORTED for a plane or a heightfield on a body that is not static
FE_API fe_result fe_shape_create(fe_world *world, fe_body body, const fe_shape_def *desc, const fe_geometry *geometry, fe_shape *out_shape);
/// Its touching pairs send their exit. Mass and inertia of the body follow, unless they were set; the body and what it touched wake.
FE_API fe_result fe_shape_destroy(fe_world *world, fe_shape shape);
/// 1 for a living shape of this world, 0 for anything else.
FE_API int32_t fe_shape_is_valid(const fe_world *world, fe_shape shape);
FE_API fe_result fe_shape_get_body(const fe_world *world, fe_shape shape, fe_body *out_body);
/// Another form in the same place; what fe_shape_destroy says of pairs, mass and waking holds here and for the local pose.
/// @return FE_ERROR_UNSUPPORTED for a plane or a heightfield on a body that is not static
FE_API fe_result fe_shape_set_geometry(fe_world *world, fe_shape shape, const fe_geometry *geometry);
/// @param out_geometry  its struct_size must be set
FE_API fe_result fe_shape_get_geometry(const fe_world *world, fe_shape shape, fe_geometry *out_geometry);
/// m, in the body's frame.
FE_API fe_result fe_shape_set_local_pose(fe_world *world, fe_shape shape, const fe_vec3 *position, const fe_quat *rotation);
FE_API fe_result fe_shape_get_local_pose(const fe_world *world, fe_shape shape, fe_vec3 *out_position, fe_quat *out_rotation);
/// kg/m3, >= 0. Mass and inertia of the body follow, unless they were set. A change wakes it.
FE_API fe_result fe_shape_set_density(fe_world *world, fe_shape shape, float density);
FE_API fe_result fe_shape_get_density(const fe_world *world, fe_shape shape, float *out_density);
/// Takes effect at the next step, also where it touches already; wakes it and what it touches. A heightfield's cells with materials of
/// their own keep them.
FE_API fe_result fe_shape_set_material(fe_world *world, fe_shape shape, const fe_material *material);
FE_API fe_result fe_shape_get_material(const fe_world *world, fe_shape shape, fe_material *out_material);
/// Takes effect at the next step. @param layer  exactly one bit
FE_API fe_result fe_shape_set_filter(fe_world *world, fe_shape shape, uint32_t layer, uint32_t mask);
FE_API fe_result fe_shape_get_filter(const fe_world *world, fe_shape shape, uint32_t *out_layer, uint32_t *out_mask);
/// A change ends its touching pairs, with their exit, and wakes the body.
FE_API fe_result fe_shape_set_trigger(fe_world *world, fe_shape shape, int32_t trigger);
FE_API fe_result fe_shape_get_trigger(const fe_world *world, fe_shape shape, int32_t *out_trigger);
/// fe_shape_events, from the next step on.
FE_API fe_result fe_shape_set_events(fe_world *world, fe_shape shape, uint32_t events);
FE_API fe_result fe_shape_get_events(const fe_world *world, fe_shape shape, uint32_t *out_events);
/// m/s, shape frame, see fe_shape_def; wakes what lies on it.
FE_API fe_result fe_shape_set_surface_velocity(fe_world *world, fe_shape shape, const fe_vec3 *velocity);
FE_API fe_result fe_shape_get_surface_velocity(const fe_world *world, fe_shape shape, fe_vec3 *out_velocity);
FE_API fe_result fe_shape_set_user_data(fe_world *world, fe_shape shape, fe_handle user_data);
FE_API fe_result fe_shape_get_user_data(const fe_world *world, fe_shape shape, fe_handle *out_user_data);

// ---- joints -------------------------------------------------------------------------------------------------------------------
//
// A joint ties body B to body A: each has a frame on it, in body space, and the joint compares the two. With p, q the position and rotation
// of a body, f and r those of its frame in it:
//
//   d = (qA rA)^-1 (pB + qB fB - pA - qA fA)      translation, m, along the axes of frame A
//   q = (qA rA)^-1 (qB rB) = swing twist          rotation; the twist is about X, and comes first
//   twist = 2 atan2(q.x, q.w);   swing: rotation vector (0, swing_y, swing_z), rad, at most pi long
//
// All limits, targets, speeds and readings are these numbers, the angle of a hinge is the twist. q and -q are one rotation, the one with
// q.w >= 0 counts; a twist with a range is followed beyond pi, so that a range that ends at pi holds there. Targets beyond a limit count as
// the limit.
//
// **Frames.** `fe_hinge_def_at` and its like make them from a point (and an axis) of the world, so that the present pose is the zero; or
// set both frames by hand.
//
// **Stiffness.** Springs, limits and what a joint holds are springs and dampers given by hertz, 1/s, and damping ratio (1: critical), on
// the masses that move, so that they do not depend on them. Hertz of 0 mean no spring where one is optional, and as stiff as the world
// allows (fe_world_tuning.joint_hertz, joint_damping_ratio; without swing) for a limit and for what is held. All are limited to 0.225 of
// the substep rate; limits and what is held swing less and less from half of that on.
//
// **Heavy loads.** What is held as stiff as the world allows gives under a load of many times the bodies' own masses. Where such joints
// close no loop (chains, cranes, arms, telescopes, with one hold on the rest of the world at most) and no body has locks, or all those of a
// plane (its normal, turns about the others) or of all turns, they are solved exactly instead, all at once: nothing gives, whatever hangs on
// them. This begins at a load of 32 effective masses on a joint (a chain of 16 equal links), of 4 on one that holds rotations; lighter ones
// are solved so in steps in which a blow or a pinch would open a joint by more than 4 mm. What is found farther apart than that was put
// there: it comes together softly. fe_counters.trees tells how many there were. Limits, springs and contacts of such bodies stay what they are.
//
// **Springs and motors** push no harder than their cap, N or N m. A motor reaches for its speed; with speed 0 it is friction. A cap of 0
// switches it off.
//
// A joint acts while it and both bodies are enabled and at least one of them is dynamic. Changing one wakes its bodies.

/// A frame in body space. Never changes.
typedef struct fe_frame {
    fe_vec3 position; ///< m
    fe_quat rotation;
} fe_frame;

typedef enum fe_joint_type {
    FE_JOINT_DISTANCE = 1,     ///< two points keep a distance or a range of it
    FE_JOINT_BALL = 2,         ///< two points stay together
    FE_JOINT_HINGE = 3,        ///< two points and their axes X stay together
    FE_JOINT_FIXED = 4,        ///< nothing moves
    FE_JOINT_CONFIGURABLE = 5, ///< each of three translations and three rotations as you say
    FE_JOINT_TYPE_FORCE32 = 0x7fffffff
} fe_joint_type;

/// All definitions of joints begin with the fields of this one, which is what fe_joint_get and fe_joint_set read and write on joints of any
/// type.
typedef struct fe_joint_def {
    uint32_t struct_size;
    int32_t enabled;        ///< 0: as if it were not there. Default 1
    fe_body body_a, body_b; ///< two different ones; 0 in a _set: as they are
    fe_handle user_data;
    fe_frame frame_a, frame_b; ///< in body space. Default: the bodies' own
    int32_t collide_connected; ///< 1: its two bodies may touch. Default 0: they never do
    float hertz;               ///< stiffness of what is held, 1/s, >= 0; 0: rigid. Default 0
    float damping_ratio;       ///< of what is held, >= 0; counts when hertz > 0. Default 1
    float break_force;         ///< it breaks when its reaction exceeds this, N, >= 0; 0: never. Default 0
    float break_torque;        ///< N m, >= 0; 0: never. Default 0
    int32_t reserved;          ///< 0
} fe_joint_def;

/// Two points keep their distance: within [min_length, max_length] (equal: a rod; from 0: a rope), a spring pulls it to `length`, a motor
/// changes it. Only the positions of the frames count. (The first fields are those of fe_joint_def, here and below.)
typedef struct fe_distance_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    fe_handle user_data;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of both ends of the range
    float break_force, break_torque;
    int32_t reserved;

    float min_length;           ///< m, >= 0, at most max_length. Default 1
    float max_length;           ///< m, >= 0.001. Default 1
    float length;               ///< the spring's, m, >= 0. Default 1
    float spring_hertz;         ///< 1/s, >= 0; 0: no spring. Default 0
    float spring_damping_ratio; ///< >= 0. Default 1
    float spring_force;         ///< cap of the spring, N, >= 0. Default 1e15
    float motor_speed;          ///< at which the motor makes it longer, m/s. Default 0
    float motor_force;          ///< cap, N, >= 0; with speed 0 a friction; 0: no motor. Default 0
} fe_distance_def;

/// Two points stay together. The swing of axis X may be bound by an elliptic cone, the twist about it by a range; a drive turns B to a
/// rotation.
typedef struct fe_ball_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    fe_handle user_data;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the points
    float break_force, break_torque;
    int32_t reserved;

    int32_t swing_limited;      ///< 1: (swing_y / cone_y)^2 + (swing_z / cone_z)^2 <= 1. Default 0
    float cone_y, cone_z;       ///< rad, 0.01..pi. Default pi
    int32_t twist_limited;      ///< 1: min_twist <= twist <= max_twist. Default 0
    float min_twist, max_twist; ///< rad, -pi..pi. Default -pi, pi
    float limit_hertz;          ///< of cone and range, 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio;  ///< Default 1
    float drive_hertz;          ///< of the spring that turns B to `target`, 1/s, >= 0; 0: none. Default 0
    float drive_damping_ratio;  ///< Default 1
    float drive_torque;         ///< its cap, N m, >= 0. Default 1e15
    fe_quat target;             ///< q to reach
    fe_vec3 motor_velocity;     ///< of B against A, rad/s, frame A. Default 0
    float motor_torque;         ///< cap, N m, >= 0; with velocity 0 a friction; 0: no motor. Default 0
    int32_t reserved_end;       ///< 0
} fe_ball_def;

/// Two points and their axes X stay together: a door, an elbow, an axle. The angle is the twist.
typedef struct fe_hinge_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    fe_handle user_data;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of points and axes
    float break_force, break_torque;
    int32_t reserved;

    int32_t limited;            ///< 1: min_angle <= angle <= max_angle. Default 0
    float min_angle, max_angle; ///< rad, -pi..pi. Default -pi, pi
    float limit_hertz;          ///< 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio;  ///< Default 1
    float spring_hertz;         ///< of the spring that turns it to `target`, 1/s, >= 0; 0: none. Default 0
    float spring_damping_ratio; ///< Default 1
    float spring_torque;        ///< its cap, N m, >= 0. Default 1e15
    float target;               ///< rad, -pi..pi. Default 0
    float motor_speed;          ///< rad/s. Default 0
    float motor_torque;         ///< cap, N m, >= 0; with speed 0 a friction; 0: no motor. Default 0
    int32_t reserved_end;       ///< 0
} fe_hinge_def;

/// The frames stay one.
typedef struct fe_fixed_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    fe_handle user_data;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the points
    float break_force, break_torque;
    int32_t reserved;

    float angular_hertz;         ///< of the rotation, 1/s, >= 0; 0: rigid. Default 0
    float angular_damping_ratio; ///< Default 1
} fe_fixed_def;

typedef enum fe_motion {
    FE_MOTION_LOCKED = 0,  ///< stays 0
    FE_MOTION_LIMITED = 1, ///< within min..max
    FE_MOTION_FREE = 2,
    FE_MOTION_FORCE32 = 0x7fffffff
} fe_motion;

typedef enum fe_drive {
    FE_DRIVE_NONE = 0,
    FE_DRIVE_HERTZ = 1,     ///< `stiffness` in hertz, 1/s, `damping` as a ratio
    FE_DRIVE_STIFFNESS = 2, ///< `stiffness` in N/m or N m/rad, `damping` in N s/m or N m s/rad
    FE_DRIVE_FORCE32 = 0x7fffffff
} fe_drive;

/// One axis of a configurable joint. Never changes.
typedef struct fe_joint_axis {
    int32_t mode;              ///< fe_motion. Default FE_MOTION_LOCKED
    float low, high;           ///< range, m or rad (-pi..pi), low <= high. Default 0
    float limit_hertz;         ///< of the range, 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio; ///< >= 0. Default 1
    int32_t drive;             ///< fe_drive: a spring towards `target`. Default FE_DRIVE_NONE. A locked axis has neither drive nor motor
    float target;              ///< m or rad. Default 0
    float stiffness, damping;  ///< see fe_drive, >= 0. Default 0, 0
    float drive_force;         ///< cap of the drive, N or N m, >= 0. Default 1e15
    float motor_speed;         ///< m/s or rad/s. Default 0
    float motor_force;         ///< cap, N or N m, >= 0; with speed 0 a friction; 0: no motor. Default 0
} fe_joint_axis;

typedef enum fe_joint_coordinate {
    FE_ALONG_X = 0, ///< translation
    FE_ALONG_Y = 1,
    FE_ALONG_Z = 2,
    FE_ABOUT_X = 3, ///< twist
    FE_ABOUT_Y = 4, ///< swing_y
    FE_ABOUT_Z = 5, ///< swing_z
    FE_JOINT_COORDINATE_FORCE32 = 0x7fffffff
} fe_joint_coordinate;

/// Six axes, each locked, limited or free, with drives: sliders, wheels, motors and whatever else. Rotations of which one or two are
/// locked: the one left over turns without end; of the two left over those about Y and Z end at 170 degrees, at 137 where the twist is
/// locked, as a cardan joint does.
typedef struct fe_configurable_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    fe_handle user_data;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the locked axes
    float break_force, break_torque;
    int32_t reserved;

    fe_joint_axis axes[6]; ///< by fe_joint_coordinate. Default: all locked
} fe_configurable_def;

FE_API void fe_distance_def_init(fe_distance_def *desc, uint32_t struct_size);
FE_API void fe_ball_def_init(fe_ball_def *desc, uint32_t struct_size);
FE_API void fe_hinge_def_init(fe_hinge_def *desc, uint32_t struct_size);
FE_API void fe_fixed_def_init(fe_fixed_def *desc, uint32_t struct_size);
FE_API void fe_configurable_def_init(fe_configurable_def *desc, uint32_t struct_size);

/// These set bodies and frames of a definition that is initialised already, so that the present pose is the zero; nothing else of it
/// changes. A rod between two points as far apart as they are now: sets the lengths too.
/// @param point_a, point_b  m, world space
FE_API fe_result fe_distance_def_at(const fe_world *world, fe_distance_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point_a,
                                    const fe_dvec3 *point_b);
/// @param point  m, world space
/// @param axis   X of both frames, world space, any length but zero: what swings and twists, along a limb for example
FE_API fe_result fe_ball_def_at(const fe_world *world, fe_ball_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point,
                                const fe_vec3 *axis);
/// @param axis  of the hinge, world space, any length but zero; B turns against A counterclockwise about it
FE_API fe_result fe_hinge_def_at(const fe_world *world, fe_hinge_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point,
                                 const fe_vec3 *axis);
/// @param point  of both frames, m, world space; their rotations are such that the present pose is the zero
FE_API fe_result fe_fixed_def_at(const fe_world *world, fe_fixed_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point);
/// @param axis  X of both frames, world space, any length but zero
FE_API fe_result fe_configurable_def_at(const fe_world *world, fe_configurable_def *desc, fe_body body_a, fe_body body_b,
                                        const fe_dvec3 *point, const fe_vec3 *axis);

/// These make a whole definition, defaults and all, ready for fe_distance_create or fe_configurable_create or for changes before. Only
/// struct_size of the given one counts. A rope: the points come no farther from each other than `max_length`.
FE_API fe_result fe_rope_def_at(const fe_world *world, fe_distance_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point_a,
                                const fe_dvec3 *point_b, float max_length);
/// B slides along an axis and does not turn. Its range, spring and motor: axes[FE_ALONG_X].
FE_API fe_result fe_slider_def_at(const fe_world *world, fe_configurable_def *desc, fe_body body_a, fe_body body_b, const fe_dvec3 *point,
                                  const fe_vec3 *axis);
/// A wheel B on a chassis A: rolls freely about the axle. axes[FE_ABOUT_X] is its motor and brake; axes[FE_ABOUT_Z] steers about `up`:
/// locked, set a range and a drive to steer by its target; axes[FE_ALONG_Z] is the suspension along `up`, within +-travel: a spring on
/// which that corner of the chassis, as heavy as it is now, swings at `hertz` with `damping_ratio` while the wheel stands; the car rests
/// some g / (2 pi hertz)^2 lower. On a chassis that is not dynamic the wheel swings so.
/// @param axle  of the wheel, world space; with it and `up` horizontal and upwards, positive spin rolls towards axle x up
FE_API fe_result fe_wheel_def_at(const fe_world *world, fe_configurable_def *desc, fe_body chassis, fe_body wheel, const fe_dvec3 *point,
                                 const fe_vec3 *axle, const fe_vec3 *up, float hertz, float damping_ratio, float travel);
/// Pulls and turns B towards a pose relative to A (the targets of all six axes, at first where it is), with no more than a force, N, and a
/// torque, N m.
FE_API fe_result fe_motor_def_at(const fe_world *world, fe_configurable_def *desc, fe_body body_a, fe_body body_b, float hertz,
                                 float damping_ratio, float max_force, float max_torque);

/// Each makes a joint from its definition. @return FE_ERROR_ARGUMENT also when both ends are one body
FE_API fe_result fe_distance_create(fe_world *world, const fe_distance_def *desc, fe_joint *out_joint);
FE_API fe_result fe_ball_create(fe_world *world, const fe_ball_def *desc, fe_joint *out_joint);
FE_API fe_result fe_hinge_create(fe_world *world, const fe_hinge_def *desc, fe_joint *out_joint);
FE_API fe_result fe_fixed_create(fe_world *world, const fe_fixed_def *desc, fe_joint *out_joint);
FE_API fe_result fe_configurable_create(fe_world *world, const fe_configurable_def *desc, fe_joint *out_joint);
/// Each changes all of a joint of its type but the bodies, and keeps what an older client's shorter definition does not know.
/// @return FE_ERROR_STATE for a joint of another type
FE_API fe_result fe_distance_set(fe_world *world, fe_joint joint, const fe_distance_def *desc);
FE_API fe_result fe_ball_set(fe_world *world, fe_joint joint, const fe_ball_def *desc);
FE_API fe_result fe_hinge_set(fe_world *world, fe_joint joint, const fe_hinge_def *desc);
FE_API fe_result fe_fixed_set(fe_world *world, fe_joint joint, const fe_fixed_def *desc);
FE_API fe_result fe_configurable_set(fe_world *world, fe_joint joint, const fe_configurable_def *desc);
/// Each reads what was set. @param out_desc  its struct_size must be set
/// @return FE_ERROR_STATE for a joint of another type
FE_API fe_result fe_distance_get(const fe_world *world, fe_joint joint, fe_distance_def *out_desc);
FE_API fe_result fe_ball_get(const fe_world *world, fe_joint joint, fe_ball_def *out_desc);
FE_API fe_result fe_hinge_get(const fe_world *world, fe_joint joint, fe_hinge_def *out_desc);
FE_API fe_result fe_fixed_get(const fe_world *world, fe_joint joint, fe_fixed_def *out_desc);
FE_API fe_result fe_configurable_get(const fe_world *world, fe_joint joint, fe_configurable_def *out_desc);

/// Its bodies wake. They may collide again from the next step on.
FE_API fe_result fe_joint_destroy(fe_world *world, fe_joint joint);
/// 1 for a living joint of this world, 0 for anything else.
FE_API int32_t fe_joint_is_valid(const fe_world *world, fe_joint joint);
/// fe_joint_type
FE_API fe_result fe_joint_get_type(const fe_world *world, fe_joint joint, int32_t *out_type);
FE_API fe_result fe_joint_get_bodies(const fe_world *world, fe_joint joint, fe_body *out_body_a, fe_body *out_body_b);
/// What all types have: see fe_joint_def. Sets all of it but the bodies.
FE_API fe_result fe_joint_set(fe_world *world, fe_joint joint, const fe_joint_def *desc);
/// @param out_desc  its struct_size must be set
FE_API fe_result fe_joint_get(const fe_world *world, fe_joint joint, fe_joint_def *out_desc);
/// A disabled joint holds nothing, and its bodies may collide. A change wakes them.
FE_API fe_result fe_joint_set_enabled(fe_world *world, fe_joint joint, int32_t enabled);
FE_API fe_result fe_joint_get_enabled(const fe_world *world, fe_joint joint, int32_t *out_enabled);
FE_API fe_result fe_joint_set_user_data(fe_world *world, fe_joint joint, fe_handle user_data);
FE_API fe_result fe_joint_get_user_data(const fe_world *world, fe_joint joint, fe_handle *out_user_data);
/// Where its frames are, world space.
FE_API fe_result fe_joint_get_frames(const fe_world *world, fe_joint joint, fe_transform *out_frame_a, fe_transform *out_frame_b);

/// How a joint stands now. What its limits and drives act on.
typedef struct fe_joint_state {
    uint32_t struct_size;
    float angle;              ///< the twist; of a hinge the angle, rad
    float swing_y, swing_z;   ///< rad
    fe_vec3 angular_velocity; ///< of B against A, rad/s, axes of frame A
    fe_vec3 translation;      ///< of frame B's point in frame A, m
    fe_vec3 linear_velocity;  ///< its rate of change, m/s
    float length;             ///< between the two points, m
    float speed;              ///< its rate of change, m/s
    float linear_error;       ///< how far the points are from where they should be held, or beyond a range, m
    float angular_error;      ///< likewise, rad
} fe_joint_state;

/// @param out_state  its struct_size must be set
FE_API fe_result fe_joint_get_state(const fe_world *world, fe_joint joint, fe_joint_state *out_state);
/// What the joint did to B in the last step, on average: force at frame B's point, N, and torque about it, N m, world axes. A feels the
/// opposite at the same point.
FE_API fe_result fe_joint_get_reaction(const fe_world *world, fe_joint joint, fe_vec3 *out_force, fe_vec3 *out_torque);
/// All joints, in the order of creation.
FE_API int32_t fe_world_get_joints(const fe_world *world, fe_joint *out_joints, int32_t capacity);
/// Those of a body, in the order of creation.
FE_API int32_t fe_body_get_joints(const fe_world *world, fe_body body, fe_joint *out_joints, int32_t capacity);

// ---- heightfields -------------------------------------------------------------------------------------------------------------

/// A grid of heights: terrain. In the shape's frame, sample (row, column) stands at x = column * cell_x, z = row * cell_z, its height along
/// y. The cell between samples (row, column) and (row + 1, column + 1), cell row * (columns - 1) + column of the arrays below, is cut by
/// the diagonal between these two into triangle 2 * cell (its z side) and 2 * cell + 1 (its x side): the numbers that hits and contacts
/// tell.
///
/// Only the upper side counts: rays from below pass. Edges between triangles are felt only where the surface is convex, also across the
/// border of two heightfields that meet; the rims of holes and of the whole carry like any edge. What is pressed into the ground comes up
/// again unless its centre is deeper than its farthest point is from it.
typedef struct fe_heightfield_def {
    uint32_t struct_size;
    int32_t rows;                  ///< of samples, along z, 2..32768; rows * columns <= 2^28
    int32_t columns;               ///< of samples, along x, 2..32768
    float cell_x;                  ///< from column to column, m, 0.001..100000; all columns within 1e6 m
    float cell_z;                  ///< from row to row
    const float *heights;          ///< rows x columns, row by row, m, within +-1e6. All arrays are copied
    const uint8_t *holes;          ///< a cell each: 1 is a hole, 0 is none; NULL: no holes
    const uint8_t *cell_materials; ///< a cell each: index into `materials`; NULL: every cell has the shape's material
    const fe_material *materials;  ///< take the place of the shape's material
    uint32_t material_stride;      ///< bytes from one to the next, 0: packed
    int32_t material_count;        ///< 0..255
} fe_heightfield_def;

FE_API void fe_heightfield_def_init(fe_heightfield_def *desc, uint32_t struct_size);
/// Belongs to this world; any number of shapes may share it (fe_geometry_heightfield).
FE_API fe_result fe_heightfield_create(fe_world *world, const fe_heightfield_def *desc, fe_asset *out_asset);
/// Changes the samples of a rectangle. Bodies near it wake, and touch the new surface in the next step.
/// @param row, column    its first sample
/// @param rows, columns  its size, >= 1
/// @param heights        rows x columns, row by row, m
FE_API fe_result fe_heightfield_set_heights(fe_world *world, fe_asset asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                            const float *heights);
/// @param out_heights  rows x columns, row by row, m
FE_API fe_result fe_heightfield_get_heights(const fe_world *world, fe_asset asset, int32_t row, int32_t column, int32_t rows,
                                            int32_t columns, float *out_heights);
/// The handle dies at once, its heights live until the last shape that has them is gone.
FE_API fe_result fe_asset_destroy(fe_world *world, fe_asset asset);
/// 1 for a living asset of this world, 0 for anything else.
FE_API int32_t fe_asset_is_valid(const fe_world *world, fe_asset asset);

// ---- queries ------------------------------------------------------------------------------------------------------------------

typedef enum fe_query_flags {
    FE_QUERY_DEFAULT = 0,
    FE_QUERY_TRIGGERS = 1, ///< triggers count too
    FE_QUERY_FLAGS_FORCE32 = 0x7fffffff
} fe_query_flags;

/// Who counts. NULL for every layer, without triggers.
typedef struct fe_query_filter {
    uint32_t struct_size;
    uint32_t mask;  ///< layers that count
    uint32_t flags; ///< fe_query_flags
    int32_t excluded_count;
    const fe_body *excluded; ///< bodies that do not count; stale ones are ignored
} fe_query_filter;

FE_API void fe_query_filter_init(fe_query_filter *filter, uint32_t struct_size);

typedef enum fe_hit_flags {
    FE_HIT_STARTED_INSIDE = 1, ///< overlaps at the start: fraction 0
    FE_HIT_FLAGS_FORCE32 = 0x7fffffff
} fe_hit_flags;

typedef struct fe_hit {
    fe_body body;
    fe_shape shape;
    fe_dvec3 point;   ///< on the body's surface, m, world space; started inside: where the ray or the moving form's centre started
    double fraction;  ///< 0..1 of the translation
    fe_vec3 normal;   ///< unit, out of the body; started inside: against the translation, or the shortest way out when that is zero
    int32_t triangle; ///< of a heightfield, else -1
    float depth;      ///< started inside: length of the shortest way out, m, else 0
    uint32_t flags;   ///< fe_hit_flags
} fe_hit;

/// A segment of fe_world_raycast_many.
typedef struct fe_ray {
    fe_dvec3 origin;      ///< m, world space
    fe_dvec3 translation; ///< to the end, m
} fe_ray;

/// A way of fe_world_sweep_many.
typedef struct fe_path {
    fe_transform start;
    fe_dvec3 translation; ///< m
} fe_path;

/// The first body on a segment.
///
/// Exact on every shape. At equal fractions what the ray starts in comes first, then the body created first, whatever the number of
/// workers.
/// @param origin       start, m, world space
/// @param translation  from the start to the end, m; zero asks whether the start is inside a shape
/// @param filter       who counts; NULL: every layer, no triggers
/// @param out_hit      written only when FE_OK is returned
/// @return FE_OK on a hit, FE_MISS
FE_API fe_result fe_world_raycast(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation, const fe_query_filter *filter,
                                  fe_hit *out_hit);
/// Is anything on the segment? Faster than the first: it stops at whatever it finds.
/// @return FE_OK on a hit, FE_MISS
FE_API fe_result fe_world_raycast_any(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                      const fe_query_filter *filter);
/// Every body on a segment, each once, at its first hit, ordered by fraction, then by creation.
/// @param stride  at least 72: the hits are ordered where they lie
/// @return how many bodies are hit; when they are more than `capacity` the nearest are written
FE_API int32_t fe_world_raycast_all(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                    const fe_query_filter *filter, fe_hit *out_hits, uint32_t stride, int32_t capacity);
/// fe_world_raycast for many segments with one filter. The answers do not depend on `spread`.
/// @param ray_stride  bytes from one ray to the next, 0: packed
/// @param spread      1: over the workers of the world, 0: on the calling thread
/// @param out_hits    one a ray, `stride` bytes apart (0: packed); of a miss body and shape are 0, the fraction is 1, the point is the end
/// @return how many hit
FE_API int32_t fe_world_raycast_many(const fe_world *world, const fe_ray *rays, uint32_t ray_stride, int32_t count,
                                     const fe_query_filter *filter, int32_t spread, fe_hit *out_hits, uint32_t stride);

/// What a sphere, capsule or box that moves without turning touches first.
///
/// It stops at most 1 micrometre before the body (0.1 mm: a box before a box), never in it. What overlaps at the start is a hit at fraction
/// 0, flagged FE_HIT_STARTED_INSIDE; so is, without the flag, what it starts to touch, but what it leaves or slides along is no hit. From
/// below, heightfields are passed. At equal fractions what overlaps comes first, then the body created first.
/// @param geometry     sphere, capsule or box; a sphere of radius 0 sweeps as a ray
/// @param start        pose of the geometry at the start
/// @param translation  m; zero asks what overlaps
/// @param filter       who counts; NULL: every layer, no triggers
/// @param out_hit      written only when FE_OK is returned
/// @return FE_OK on a hit, FE_MISS; FE_ERROR_UNSUPPORTED for other geometries
FE_API fe_result fe_world_sweep(const fe_world *world, const fe_geometry *geometry, const fe_transform *start, const fe_dvec3 *translation,
                                const fe_query_filter *filter, fe_hit *out_hit);
/// Does it touch anything? Faster than the first: it stops at whatever it finds.
FE_API fe_result fe_world_sweep_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                    const fe_dvec3 *translation, const fe_query_filter *filter);
/// Every body that it touches on its way, as if the others were not there; see fe_world_raycast_all.
FE_API int32_t fe_world_sweep_all(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                  const fe_dvec3 *translation, const fe_query_filter *filter, fe_hit *out_hits, uint32_t stride,
                                  int32_t capacity);
/// fe_world_sweep of one geometry along many paths; see fe_world_raycast_many. Of a miss the point is the end of the centre's way.
FE_API int32_t fe_world_sweep_many(const fe_world *world, const fe_geometry *geometry, const fe_path *paths, uint32_t path_stride,
                                   int32_t count, const fe_query_filter *filter, int32_t spread, fe_hit *out_hits, uint32_t stride);

/// The bodies that a sphere, capsule or box overlaps, in the order of creation: exactly those that a sweep from there would start inside
/// of.
/// @param geometry  as for fe_world_sweep; a sphere of radius 0 is a point
/// @param at        pose of the geometry
/// @return how many there are; when they are more than `capacity` those created first are written
FE_API int32_t fe_world_overlap(const fe_world *world, const fe_geometry *geometry, const fe_transform *at, const fe_query_filter *filter,
                                fe_body *out_bodies, int32_t capacity);
/// @return FE_OK when it overlaps anything, FE_MISS
FE_API fe_result fe_world_overlap_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                                      const fe_query_filter *filter);

typedef struct fe_closest {
    fe_body body;
    fe_shape shape;
    fe_dvec3 point;   ///< of the shape's surface, m, world space
    double distance;  ///< to the surface, m; below 0 inside
    fe_vec3 normal;   ///< unit, out of the body
    int32_t triangle; ///< of a heightfield, else -1
} fe_closest;

/// The point of all surfaces that is closest to a point. Inside of a body its distance is below 0; the smallest wins, then the body created
/// first. A heightfield has no inside; from below it is not seen.
/// @param max_distance  farther ones are not looked for, m, >= 0
/// @param out_closest   written only when FE_OK is returned
/// @return FE_OK, FE_MISS when there is none
FE_API fe_result fe_world_closest_point(const fe_world *world, const fe_dvec3 *point, double max_distance, const fe_query_filter *filter,
                                        fe_closest *out_closest);

/// fe_world_raycast against one shape or one body only, whatever its layers, a trigger or not, enabled or not.
FE_API fe_result fe_shape_raycast(const fe_world *world, fe_shape shape, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                  fe_hit *out_hit);
FE_API fe_result fe_body_raycast(const fe_world *world, fe_body body, const fe_dvec3 *origin, const fe_dvec3 *translation, fe_hit *out_hit);
/// The closest point of one shape or body, however far. FE_MISS for a body without shapes, and from below a heightfield.
FE_API fe_result fe_shape_closest_point(const fe_world *world, fe_shape shape, const fe_dvec3 *point, fe_closest *out_closest);
FE_API fe_result fe_body_closest_point(const fe_world *world, fe_body body, const fe_dvec3 *point, fe_closest *out_closest);

// ---- after the step: events, contacts, bulk reads ---------------------------------------------------------------------------------

typedef enum fe_event_kind {
    FE_ENTER = 1,
    FE_STAY = 2,
    FE_EXIT = 3,
    FE_SLEEP = 4,
    FE_WAKE = 5,
    FE_BREAK = 6,
    FE_EVENT_KIND_FORCE32 = 0x7fffffff
} fe_event_kind;

/// Two shapes began, went on, or ceased to touch: a point had an impulse, or a gap of 0 or less, during the step. A is the body created
/// first. After the exit caused by a destruction, the handles of what was destroyed are stale.
typedef struct fe_pair_event {
    fe_body body_a, body_b;
    fe_shape shape_a, shape_b;
    int32_t kind;       ///< FE_ENTER, FE_STAY, FE_EXIT
    int32_t is_trigger; ///< 1 when either is a trigger
} fe_pair_event;

/// Events of the last step, ordered by the creation of A, then B.
FE_API int32_t fe_world_get_pair_events(const fe_world *world, fe_pair_event *out_events, uint32_t stride, int32_t capacity);

typedef struct fe_body_event {
    fe_body body;
    int32_t kind; ///< FE_SLEEP, FE_WAKE
    int32_t reserved;
} fe_body_event;

/// Who fell asleep and who woke, in the last step and by calls before it, in the order of creation.
FE_API int32_t fe_world_get_body_events(const fe_world *world, fe_body_event *out_events, uint32_t stride, int32_t capacity);

typedef struct fe_hit_event {
    fe_body body_a, body_b;
    fe_shape shape_a, shape_b;
    fe_dvec3 point; ///< m, world space
    fe_vec3 normal; ///< from A to B
    float speed;    ///< of approach, m/s
    float impulse;  ///< of the step, along the normal, N s
    int32_t reserved;
} fe_hit_event;

/// Impacts of the last step on shapes that ask for FE_EVENTS_HIT, faster than fe_world_tuning.hit_event_threshold.
FE_API int32_t fe_world_get_hit_events(const fe_world *world, fe_hit_event *out_events, uint32_t stride, int32_t capacity);

/// A joint's reaction exceeded its break_force or break_torque in the last step: it is gone, its handle stale.
typedef struct fe_joint_event {
    fe_joint joint;
    fe_body body_a, body_b;
    fe_handle user_data; ///< of the joint
    int32_t kind;        ///< FE_BREAK
    int32_t type;        ///< fe_joint_type
    fe_vec3 force;       ///< reaction that broke it, see fe_joint_get_reaction
    fe_vec3 torque;
} fe_joint_event;

/// Events of the last step, in the order of the joints' creation.
FE_API int32_t fe_world_get_joint_events(const fe_world *world, fe_joint_event *out_events, uint32_t stride, int32_t capacity);

typedef struct fe_contact_point {
    fe_dvec3 point;       ///< between the surfaces, m, world space
    float separation;     ///< m, negative when they overlap
    float normal_impulse; ///< of the last step's end, per substep, N s
    float total_impulse;  ///< along the normal, over the whole last step, bounces included, N s
    uint32_t id;          ///< of the features that meet; stays while they do
} fe_contact_point;

/// A pair of shapes has one; with a heightfield one for each direction in which it is touched.
typedef struct fe_contact {
    fe_body body_a, body_b;
    fe_shape shape_a, shape_b;
    fe_vec3 normal;      ///< unit, from A to B
    int32_t point_count; ///< 1..4
    fe_contact_point points[4];
    fe_vec3 friction_impulse; ///< on B, of the last substep, N s
    float twist_impulse;      ///< on B, about the normal, N m s
    int32_t triangle;         ///< of a heightfield, under the deepest point, else -1
    int32_t reserved;         ///< 0
} fe_contact;

/// The contacts of a body: pairs with at least one point within the speculative distance. Triggers have none.
FE_API int32_t fe_body_get_contacts(const fe_world *world, fe_body body, fe_contact *out_contacts, uint32_t stride, int32_t capacity);
FE_API int32_t fe_shape_get_contacts(const fe_world *world, fe_shape shape, fe_contact *out_contacts, uint32_t stride, int32_t capacity);

/// The bodies that the last step moved, in the order of creation, and where they are now.
/// @param out_transforms  or NULL; `stride` bytes apart (0: packed)
FE_API int32_t fe_world_get_moved(const fe_world *world, fe_body *out_bodies, fe_transform *out_transforms, uint32_t stride,
                                  int32_t capacity);
/// All or none. @param stride  bytes from one transform to the next, 0: packed
FE_API fe_result fe_world_get_transforms(const fe_world *world, const fe_body *bodies, fe_transform *out_transforms, uint32_t stride,
                                         int32_t count);
/// fe_body_set_transform for many, all or none.
FE_API fe_result fe_world_set_transforms(fe_world *world, const fe_body *bodies, const fe_transform *transforms, uint32_t stride,
                                         int32_t count);
/// Position relative to `origin`, m, and rotation, 7 floats a body: x y z, x y z w. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_transforms_f32(const fe_world *world, const fe_body *bodies, const fe_dvec3 *origin, float *out_floats,
                                             uint32_t stride, int32_t count);
/// Linear, then angular velocity, m/s, rad/s, 6 floats a body; setting: FE_ERROR_STATE on a static body. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_velocities(const fe_world *world, const fe_body *bodies, float *out_floats, uint32_t stride, int32_t count);
FE_API fe_result fe_world_set_velocities(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride, int32_t count);
/// Force at the centre, N, then torque, N m, 6 floats a body, during the next step. @param stride  bytes, 0: packed
FE_API fe_result fe_world_add_forces(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride, int32_t count);

#ifdef __cplusplus
}
#endif

// ---- sugar for C and C++, no part of the ABI ---------------------------------------------------------------------------------------
#ifndef SWIG

static inline fe_vec3 fe_make_vec3(float x, float y, float z)
{
    fe_vec3 a;
    a.x = x, a.y = y, a.z = z;
    return a;
}

static inline fe_dvec3 fe_make_dvec3(double x, double y, double z)
{
    fe_dvec3 a;
    a.x = x, a.y = y, a.z = z;
    return a;
}

/// No rotation, at a position.
static inline fe_transform fe_make_transform(double x, double y, double z)
{
    fe_transform t;
    t.position = fe_make_dvec3(x, y, z);
    t.rotation.x = t.rotation.y = t.rotation.z = 0.0f, t.rotation.w = 1.0f;
    return t;
}

/// Where a body is; the origin when the handle is stale.
static inline fe_transform fe_body_transform(const fe_world *world, fe_body body)
{
    fe_transform t = fe_make_transform(0, 0, 0);
    (void)fe_body_get_transform(world, body, &t);
    return t;
}

static inline fe_vec3 fe_body_linear_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 v = fe_make_vec3(0, 0, 0);
    (void)fe_body_get_linear_velocity(world, body, &v);
    return v;
}

static inline fe_vec3 fe_body_angular_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 w = fe_make_vec3(0, 0, 0);
    (void)fe_body_get_angular_velocity(world, body, &w);
    return w;
}

/// Of a hinge or a twist, rad; 0 when the handle is stale.
static inline float fe_joint_angle(const fe_world *world, fe_joint joint)
{
    fe_joint_state state;
    state.struct_size = sizeof(state);
    return fe_joint_get_state(world, joint, &state) == FE_OK ? state.angle : 0.0f;
}

#endif
#endif
