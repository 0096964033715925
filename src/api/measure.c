// measure.c - the API of what a world amounts to: energy, momentum, bounds, the stiffness in use.
#include "api/check.h"
#include "core/fp_state.h"
#include "step/step.h"
#include "world/mechanics.h"
#include "world/proxies.h"

// ---- energy and momentum -------------------------------------------------------------------------------------------

FE_DEFINE_EMPTY_INIT(fe_energy_init, fe_energy, energy)

fe_result fe_world_get_energy(const fe_world *world, fe_energy *out_energy)
{
    FE_READ(world);
    FE_CHECK_STRUCT_SIZE(out_energy);
    fe_energy energy = {.struct_size = sizeof energy};
    fe__fp_state fp = fe__fp_enter();
    fe__world_energy(world, &energy.kinetic, &energy.potential);
    fe__fp_leave(fp);
    fe__write_struct(out_energy, &energy, sizeof energy);
    return FE_OK;
}

fe_result fe_world_get_momentum(const fe_world *world, const fe_dvec3 *about, fe_dvec3 *out_linear,
                                fe_dvec3 *out_angular)
{
    FE_READ(world);
    FE_CHECK_DVEC3(about, FE_MAX_POSITION);
    FE_CHECK_POINTER(out_linear);
    FE_CHECK_POINTER(out_angular);
    fe__fp_state fp = fe__fp_enter();
    fe__world_momentum(world, *about, out_linear, out_angular);
    fe__fp_leave(fp);
    return FE_OK;
}

// ---- stiffness -----------------------------------------------------------------------------------------------------

fe_result fe_world_get_hertz(const fe_world *world, float dt, float *out_contact_hertz, float *out_joint_hertz)
{
    FE_READ(world);
    FE_CHECK_FLOAT(dt, 0.0f, FE_MAX_DT);
    FE_CHECK_POINTER(out_contact_hertz);
    FE_CHECK_POINTER(out_joint_hertz);
    *out_contact_hertz = world->tuning.contact_hertz;
    *out_joint_hertz = world->tuning.joint_hertz;
    if (fe__counted_dt(dt) == 0.0f) return FE_OK;
    fe__fp_state fp = fe__fp_enter();
    float rate = 1.0f / (dt / (float)world->substeps);
    *out_contact_hertz = fe__minf(*out_contact_hertz, FE__MOST_CONTACT_HERTZ * rate);
    *out_joint_hertz = fe__minf(*out_joint_hertz, FE__MOST_JOINT_HERTZ * rate);
    fe__fp_leave(fp);
    return FE_OK;
}

// ---- bounds --------------------------------------------------------------------------------------------------------

static fe_bounds public_bounds(const fe__bounds *b) { return (fe_bounds){b->low, b->high}; }

fe_result fe_world_get_bounds(const fe_world *world, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_bounds);
    fe__bounds bounds;
    fe__fp_state fp = fe__fp_enter();
    int32_t found = fe__body_bounds(world, -1, &bounds);
    fe__fp_leave(fp);
    if (!found) return fe__fail(function, FE_ERROR_STATE, "the world has no shapes, or planes only");
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}

fe_result fe_body_get_bounds(const fe_world *world, fe_body body, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_bounds);
    if (world->bodies[index].shape_count == 0)
        return fe__fail(function, FE_ERROR_STATE, "body 0x%llx has no shapes", body);
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0; shape = world->shapes[shape].next) {
        if (!fe__form_is_unbounded(&world->shapes[shape].form)) continue;
        return fe__fail(function, FE_ERROR_UNSUPPORTED, "body 0x%llx has a plane, which has no bounds", body);
    }
    fe__bounds bounds;
    fe__fp_state fp = fe__fp_enter();
    (void)fe__body_bounds(world, index, &bounds);
    fe__fp_leave(fp);
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}

fe_result fe_shape_get_bounds(const fe_world *world, fe_shape shape, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_bounds);
    if (fe__form_is_unbounded(&world->shapes[index].form)) {
        return fe__fail(function, FE_ERROR_UNSUPPORTED, "shape 0x%llx is a plane, which has no bounds", shape);
    }
    fe__fp_state fp = fe__fp_enter();
    fe__bounds bounds = fe__whole_bounds(world, index);
    fe__fp_leave(fp);
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}
