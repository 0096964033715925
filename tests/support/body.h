// body.h - what tests read of a body or a joint, as a value. A stale handle ends the program.
#ifndef FE_TESTS_BODY_H
#define FE_TESTS_BODY_H
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

static inline void body_must(fe_result result)
{
    if (result == FE_OK) return;
    fprintf(stderr, "%s\n", fe_last_error());
    abort();
}

static inline fe_transform body_transform(const fe_world *world, fe_body body)
{
    fe_transform t;
    body_must(fe_body_get_transform(world, body, &t));
    return t;
}

static inline fe_vec3 body_linear_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 v;
    body_must(fe_body_get_linear_velocity(world, body, &v));
    return v;
}

static inline fe_vec3 body_angular_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 w;
    body_must(fe_body_get_angular_velocity(world, body, &w));
    return w;
}

#endif
