// values.h - what tests read of a world, as values, and constants of structs that grow. A stale handle ends the
// program.
#ifndef FE_TESTS_VALUES_H
#define FE_TESTS_VALUES_H
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

// A constant fe_material; what it does not name is 0, which is the default
#define SURFACE(stick, slide, bounce, roll, spin)                                         \
    {                                                                                     \
        .static_friction = (stick), .dynamic_friction = (slide), .restitution = (bounce), \
        .rolling_resistance = (roll), .spinning_resistance = (spin)                       \
    }

// A handle is kind, world, generation and slot + 1, in 3, 12, 17 and 21 bits
#define HANDLE_SLOT ((UINT64_C(1) << 21) - 1)
#define NEXT_GENERATION (UINT64_C(1) << 21)

static inline void value_must(fe_result result)
{
    if (result == FE_OK) return;
    fprintf(stderr, "%s\n", fe_last_error());
    abort();
}

static inline fe_transform body_transform(const fe_world *world, fe_body body)
{
    fe_transform t;
    value_must(fe_body_get_transform(world, body, &t));
    return t;
}

static inline fe_vec3 body_linear_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 v;
    value_must(fe_body_get_linear_velocity(world, body, &v));
    return v;
}

static inline fe_vec3 body_angular_velocity(const fe_world *world, fe_body body)
{
    fe_vec3 w;
    value_must(fe_body_get_angular_velocity(world, body, &w));
    return w;
}

static inline fe_store *world_store(const fe_world *world)
{
    fe_store *store;
    value_must(fe_world_get_store(world, &store));
    return store;
}

#endif
