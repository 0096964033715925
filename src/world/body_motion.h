// body_motion.h - velocities, forces and impulses given between steps.
#ifndef FE_WORLD_BODY_MOTION_H
#define FE_WORLD_BODY_MOTION_H
#include "world/world.h"

// Sets velocities; NULL: as it is. Locked components stay 0; wakes the body unless both are 0. Not for static bodies.
void fe__body_set_velocity(fe_world *world, int32_t body, const fe_vec3 *linear, const fe_vec3 *angular);
// 1: an enabled dynamic body. On others forces and impulses do nothing, which is no error.
static inline int32_t fe__body_feels_forces(const fe__body *body)
{
    return body->type == FE_BODY_DYNAMIC && body->flags & FE__BODY_ENABLED;
}
// Adds to force and torque. Sums are clamped (far above anything physical), so that no number of calls makes an
// infinity.
void fe__body_add_force(fe_world *world, int32_t body, fe_vec3 force, fe_vec3 torque);
// Inertia about the centre of mass, kg m2, world axes
void fe__body_world_inertia(const fe__body *body, double inertia[3][3]);
// The change of the angular velocity by an impulse about the centre: the exact inverse of the inertia over the free
// axes.
fe_vec3 fe__body_spin_change(const fe__body *body, fe_vec3 angular_impulse);
// The angular velocity that rotates `from` into `to` by the shorter way in `seconds`.
fe_vec3 fe__spin_between(fe_quat from, fe_quat to, double seconds);

#endif
