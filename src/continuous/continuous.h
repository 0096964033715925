// continuous.h - the stage between solver and finalize: bodies that outran their thickness end at what they met.
#ifndef FE_CONTINUOUS_CONTINUOUS_H
#define FE_CONTINUOUS_CONTINUOUS_H
#include "world/world_memory.h"

void fe__stop_fast_bodies(fe__step *step);

// Sweeps one body against static and kinematic ones, and ends its motion at what it meets. On any thread: writes the
// body's lines in the solver. 1: it was stopped; a body with joints is FE__BODY_HELD then
int32_t fe__stop_body(const fe__step *step, int32_t body);

#endif
