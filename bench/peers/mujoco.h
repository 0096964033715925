/// @file mujoco.h
/// MuJoCo, for the measure of many small worlds alone: trees of boxes, spheres and capsules. With FE_BENCH_MUJOCO.
#ifndef BENCH_MUJOCO_H
#define BENCH_MUJOCO_H

#include "peer.h"

/// `like`: a world of the same scene, whose model is shared; NULL: the first. NULL: it has said why on stderr.
bench_world *bench_mujoco_create(const bench_scene *scene, const bench_world *like);
void bench_mujoco_destroy(bench_world *world, int owns_model);
/// The scene's step, in as many of the engine's as it takes.
void bench_mujoco_step(bench_world *world);
void bench_mujoco_reset(bench_world *world);
void bench_mujoco_place(const bench_world *world, int32_t body, double *out_position); ///< m

#endif
