// any_joint.h - the five types of joints as one: a definition of any of them, and its calls by kind, which is
// fe_joint_type - 1.
#ifndef FE_TESTS_ANY_JOINT_H
#define FE_TESTS_ANY_JOINT_H
#include "feather.h"
#include "support/values.h"

#include <stddef.h>

enum { ANY_DISTANCE, ANY_BALL, ANY_HINGE, ANY_FIXED, ANY_CONFIGURABLE, ANY_KINDS };

typedef union any_def {
    fe_joint_def common;
    fe_distance_joint_def distance;
    fe_ball_joint_def ball;
    fe_hinge_joint_def hinge;
    fe_fixed_joint_def fixed;
    fe_configurable_joint_def configurable;
} any_def;

static const uint32_t any_sizes[ANY_KINDS] = {sizeof(fe_distance_joint_def), sizeof(fe_ball_joint_def),
                                              sizeof(fe_hinge_joint_def), sizeof(fe_fixed_joint_def),
                                              sizeof(fe_configurable_joint_def)};

static inline void any_init(int32_t kind, any_def *d)
{
    if (kind == ANY_DISTANCE) fe_distance_joint_def_init(&d->distance, any_sizes[kind]);
    if (kind == ANY_BALL) fe_ball_joint_def_init(&d->ball, any_sizes[kind]);
    if (kind == ANY_HINGE) fe_hinge_joint_def_init(&d->hinge, any_sizes[kind]);
    if (kind == ANY_FIXED) fe_fixed_joint_def_init(&d->fixed, any_sizes[kind]);
    if (kind == ANY_CONFIGURABLE) fe_configurable_joint_def_init(&d->configurable, any_sizes[kind]);
}

// d may be NULL: the library refuses it
static inline fe_result any_create(int32_t kind, fe_world *world, const any_def *d, fe_joint *out)
{
    switch (kind) {
    case ANY_DISTANCE:
        return fe_distance_joint_create(world, d ? &d->distance : NULL, out);
    case ANY_BALL:
        return fe_ball_joint_create(world, d ? &d->ball : NULL, out);
    case ANY_HINGE:
        return fe_hinge_joint_create(world, d ? &d->hinge : NULL, out);
    case ANY_FIXED:
        return fe_fixed_joint_create(world, d ? &d->fixed : NULL, out);
    default:
        return fe_configurable_joint_create(world, d ? &d->configurable : NULL, out);
    }
}

static inline fe_result any_set(int32_t kind, fe_world *world, fe_joint joint, const any_def *d)
{
    switch (kind) {
    case ANY_DISTANCE:
        return fe_distance_joint_set(world, joint, d ? &d->distance : NULL);
    case ANY_BALL:
        return fe_ball_joint_set(world, joint, d ? &d->ball : NULL);
    case ANY_HINGE:
        return fe_hinge_joint_set(world, joint, d ? &d->hinge : NULL);
    case ANY_FIXED:
        return fe_fixed_joint_set(world, joint, d ? &d->fixed : NULL);
    default:
        return fe_configurable_joint_set(world, joint, d ? &d->configurable : NULL);
    }
}

static inline fe_result any_get(int32_t kind, const fe_world *world, fe_joint joint, any_def *d)
{
    switch (kind) {
    case ANY_DISTANCE:
        return fe_distance_joint_get(world, joint, d ? &d->distance : NULL);
    case ANY_BALL:
        return fe_ball_joint_get(world, joint, d ? &d->ball : NULL);
    case ANY_HINGE:
        return fe_hinge_joint_get(world, joint, d ? &d->hinge : NULL);
    case ANY_FIXED:
        return fe_fixed_joint_get(world, joint, d ? &d->fixed : NULL);
    default:
        return fe_configurable_joint_get(world, joint, d ? &d->configurable : NULL);
    }
}

#endif
