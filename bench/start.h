/// @file start.h
/// The same start for all: every engine must hold the scene's bodies, mass and poses, or what is compared are different
/// things.
#ifndef BENCH_START_H
#define BENCH_START_H

#include "peers/peer.h"

/// 0, or -1 when a world just created is not the scene's (it has said why on stderr).
int bench_check_start(const bench_engine *engine, bench_world *world, const bench_scene *scene);

#endif
