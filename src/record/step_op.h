// step_op.h - what is told of a step, so that a replay knows at once when it goes another way.
//
//   number (1) | bits of what follows (1) | dt (4), unless that of the step before | the hash of awake bodies (8) |
//   awake bodies, pairs, contacts, as differences (varints) | the deep hash (8), every 64th step |
//   answers of the pair filter: how many (varint), a bit each |
//   traces, with FE_RECORD_FINE: how many (varint); difference of slots (varint), bytes (16) of each
//
// A hash is a sum over bodies: in whatever order they are listed.
#ifndef FE_RECORD_STEP_OP_H
#define FE_RECORD_STEP_OP_H
#include "world/world.h"

enum { FE__STEP_HAS_DT = 1, FE__STEP_IS_DEEP = 2, FE__STEP_HAS_ANSWERS = 4, FE__STEP_HAS_TRACES = 8 };
enum { FE__STEPS_BETWEEN_DEEP = 64 };

// A byte for each number of a body, in this order
enum {
    FE__TRACE_POSITION = 0,
    FE__TRACE_ROTATION = 3,
    FE__TRACE_VELOCITY = 7,
    FE__TRACE_SPIN = 10,
    FE__TRACE_FORCES = 13,   // pending force and torque
    FE__TRACE_SLEEP = 14,    // timer, flags
    FE__TRACE_CONTACTS = 15, // of its contacts: points and impulses
    FE__TRACE = 16
};

uint64_t fe__awake_hash(const fe_world *world); // poses and velocities
// What the step left besides: contacts and joints of who is awake, forces, timers, events
uint64_t fe__deep_hash(const fe_world *world);
void fe__trace_of(const fe_world *world, int32_t body, uint8_t *out_trace);

#endif
