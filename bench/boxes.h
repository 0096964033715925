/// @file boxes.h
/// The two worlds in which snapshots, histories and recordings are timed: one that is awake, one that sleeps.
#ifndef BENCH_BOXES_H
#define BENCH_BOXES_H

#include "feather.h"

/// A body of that fe_body_type with one shape.
void bench_add_body(fe_world *world, int32_t type, double x, double y, double z, const fe_geometry *form);
/// Boxes of 1 m in layers of 8 x 8 that fell onto each other, 400 steps ago; sleep is off. One worker. NULL: an error.
fe_world *bench_create_pile(int32_t boxes);
/// Boxes of 1 m side by side on the ground, asleep. One worker. NULL: an error.
fe_world *bench_create_rest(int32_t boxes);

#endif
