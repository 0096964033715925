/// @file peer.h
/// What an engine must offer to be measured: build a scene, step it, tell poses, contacts and rays. One adapter per
/// engine fills a bench_engine; the runner knows engines through it alone. An adapter without its package compiles to
/// nothing.
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include "../scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bench_world bench_world; ///< an engine's world; each adapter has its own struct

typedef struct bench_ray {
    double origin[3];      ///< m
    double translation[3]; ///< m
} bench_ray;

/// A form that moves along a segment or, for overlaps, stands at its start.
typedef struct bench_probe {
    bench_shape shape;
    double rotation[4]; ///< quaternion x y z w
    bench_ray way;      ///< of its centre
} bench_probe;

typedef struct bench_motion {
    double linear[3];  ///< of the centre, m/s
    double angular[3]; ///< rad/s
} bench_motion;

/// By the engine's own narrow phase, at the bodies' present poses.
typedef struct bench_contacts {
    int32_t pairs;  ///< with at least one point; engines differ in how early they make one
    int32_t points; ///< of all pairs
    double deepest; ///< largest overlap, m, 0: none
    double held;    ///< that the overlaps hold as Feather's contact springs, J; only Feather tells
} bench_contacts;

/// How a step was organised. Only Feather tells.
typedef struct bench_counters {
    int32_t islands, colours;
    int32_t rows;       ///< of several contacts side by side
    double whole_share; ///< 0..1 of the rows, in islands that one worker solved whole
    double fill;        ///< 0..1 of the rows' lanes that hold a contact
    int32_t contacts, recycled;
    int64_t bytes;
} bench_counters;

enum { BENCH_MAX_PHASES = 16 };

typedef struct bench_engine {
    const char *name;
    const char *settings; ///< iterations and the like, as tables print them
    int32_t planar_only;  ///< 1: knows scenes in the plane alone
    int32_t has_workers;  ///< 1: takes workers and substeps; 0: always one thread, its own iterations
    double body_steps;    ///< dynamic bodies times steps that a case may take, 0: any number; a longer one is not run
    /// The scene outlives the world. NULL when the engine cannot; it has said why on stderr.
    bench_world *(*create)(const bench_scene *scene, int32_t workers, int32_t substeps);
    void (*destroy)(bench_world *world);
    /// 0 on success; else the adapter has said why on stderr.
    int32_t (*step)(bench_world *world, float dt);
    int32_t (*count_bodies)(bench_world *world);
    double (*read_mass)(bench_world *world); ///< kg, of all dynamic bodies, by the engine's own bookkeeping
    /// One pose per body of the scene, in its order.
    void (*read_poses)(bench_world *world, bench_pose *out_poses);
    void (*read_motions)(bench_world *world, bench_motion *out_motions);      ///< likewise; zeros for static bodies
    void (*add_force)(bench_world *world, int32_t body, const double *force); ///< at the centre, N, in the next step
    void (*add_impulse)(bench_world *world, int32_t body, const double *impulse,
                        const double *point);                       ///< N s, m, world space
    void (*set_gravity)(bench_world *world, const double *gravity); ///< m/s2, from the next step on
    void (*take_away)(bench_world *world,
                      int32_t body); ///< out of play: no contacts, no joints; its pose is of no interest any more
    void (*bring_back)(bench_world *world, int32_t body,
                       const bench_pose *pose); ///< what was taken away is in play there again, at rest
    /// May touch the engine's contact caches: the last call on a world before its destruction.
    void (*measure_contacts)(bench_world *world, bench_contacts *out_contacts);
    /// 1 on a hit.
    int32_t (*raycast)(bench_world *world, const bench_ray *ray, double *out_fraction);
    /// Optional: names of the phases of a step, NULL after the last, and their ms in the last step.
    const char *const *phase_names;
    void (*read_phases)(bench_world *world, double *out_ms);
    void (*read_counters)(bench_world *world, bench_counters *out_counters);              ///< optional
    uint64_t (*read_hash)(bench_world *world);                                            ///< optional
    int32_t (*sweep)(bench_world *world, const bench_probe *probe, double *out_fraction); ///< optional; 1 on a hit
    int32_t (*overlap)(bench_world *world, const bench_probe *probe); ///< optional: how many bodies it overlaps
    void (*fall_asleep)(bench_world *world);                          ///< optional: all bodies
    /// Optional: builds a mesh, or a hull of points x y z, and lets it go. The processor's ms, without letting go; the
    /// bytes of memory that it holds, with what it needs of the user's arrays.
    double (*build_mesh)(const bench_mesh *mesh, int64_t *out_bytes);
    double (*build_hull)(const float *points, int32_t count, int64_t *out_bytes);
} bench_engine;

extern const bench_engine bench_feather;
struct fe_world *bench_feather_world(bench_world *world); ///< of Feather's adapter
extern const bench_engine bench_bullet;                   ///< with FE_BENCH_BULLET
extern const bench_engine bench_ode;                      ///< with FE_BENCH_ODE
extern const bench_engine bench_box2d;                    ///< with FE_BENCH_BOX2D; planar scenes only

/// An engine that the program knows by name; `engine` is NULL when it was built without.
typedef struct bench_engine_entry {
    const char *name;
    const bench_engine *engine;
    const char *package; ///< what to install to get it
} bench_engine_entry;

extern const bench_engine_entry bench_engines[];
extern const int32_t bench_engine_count;

#ifdef __cplusplus
}
#endif
#endif
