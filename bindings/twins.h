// Parts of what a function of feather.h reads or writes, for languages where the whole would cost a second tuple or
// table. They are compiled into the bindings' flat modules and are no part of the ABI. Errors are those of the function
// they call.
#ifndef FE_BINDINGS_TWINS_H
#define FE_BINDINGS_TWINS_H

#include "feather.h"

static inline fe_result fe_body_get_position(const fe_world *world, fe_body body, fe_dvec3 *out_position)
{
    fe_transform transform;
    fe_result result = fe_body_get_transform(world, body, &transform);
    if (result == FE_OK) *out_position = transform.position;
    return result;
}

static inline fe_result fe_body_get_rotation(const fe_world *world, fe_body body, fe_quat *out_rotation)
{
    fe_transform transform;
    fe_result result = fe_body_get_transform(world, body, &transform);
    if (result == FE_OK) *out_rotation = transform.rotation;
    return result;
}

/// Moves the body there at once and keeps its rotation.
static inline fe_result fe_body_set_position(fe_world *world, fe_body body, const fe_dvec3 *position)
{
    fe_transform transform;
    fe_result result = fe_body_get_transform(world, body, &transform);
    if (result != FE_OK) return result;
    if (position) transform.position = *position;
    return fe_body_set_transform(world, body, position ? &transform : 0);
}

/// Rotates the body at once about its origin.
static inline fe_result fe_body_set_rotation(fe_world *world, fe_body body, const fe_quat *rotation)
{
    fe_transform transform;
    fe_result result = fe_body_get_transform(world, body, &transform);
    if (result != FE_OK) return result;
    if (rotation) transform.rotation = *rotation;
    return fe_body_set_transform(world, body, rotation ? &transform : 0);
}

#endif
