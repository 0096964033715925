// record.h - the end of a call that changed its world: it is noted, where somebody records.
//
// Calls that fail never come here. Whether anybody records costs a test of one field.
#ifndef FE_API_RECORD_H
#define FE_API_RECORD_H
#include "api/check.h"
#include "record/keyframe.h"
#include "record/ops.h"
#include "record/step.h"

// FE_RECORD(body_set_awake, body, awake): the name without fe_, the arguments without the world
#define FE_RECORD(call, ...)                                                                               \
    do {                                                                                                   \
        if (__builtin_expect(world->recorder != NULL, 0)) fe__record_##call(world->recorder, __VA_ARGS__); \
    } while (0)

#endif
