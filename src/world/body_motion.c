// body_motion.c - velocities, forces and impulses given between steps.
//
// Called by the API layer. The next step's solver reads the results: forces act during all of that step, which clears
// them.
#include "world/body_motion.h"

#include "core/math.h"
#include "world/body.h"
#include "world/proxies.h"
#include "world/sleep.h"

void fe__body_set_velocity(fe_world *world, int32_t index, const fe_vec3 *linear, const fe_vec3 *angular)
{
    fe__body *body = &world->bodies[index];
    if (linear) body->velocity[0] = linear->x, body->velocity[1] = linear->y, body->velocity[2] = linear->z;
    if (angular) body->spin[0] = angular->x, body->spin[1] = angular->y, body->spin[2] = angular->z;
    for (int k = 0; k < 3 && angular; ++k) body->relaxed[k] = 0.0f;
    fe__body_stop_locked(world, body);
    int32_t moves = 0;
    for (int k = 0; k < 3; ++k) moves |= body->velocity[k] != 0.0f || body->spin[k] != 0.0f;
    if (moves) fe__body_disturb(world, index);
    fe__body_stretch_boxes(world, index);
}

void fe__body_add_force(fe_world *world, int32_t index, fe_vec3 force, fe_vec3 torque)
{
    const float most = 1e9f; // m/s2, rad/s2: the velocity after a step of 1 s can still be squared in a float
    fe__body *body = &world->bodies[index];
    float f[3] = {force.x, force.y, force.z}, t[3] = {torque.x, torque.y, torque.z};
    int32_t any = 0;
    for (int k = 0; k < 3; ++k) any |= f[k] != 0.0f || t[k] != 0.0f;
    if (!any) return;
    fe__body_disturb(world, index);
    float most_force = most * body->mass;
    float most_torque = most * fe__minf(fe__minf(body->inertia[0], body->inertia[1]), body->inertia[2]);
    for (int k = 0; k < 3; ++k) {
        body->force[k] = fe__clampf(body->force[k] + f[k], -most_force, most_force);
        body->torque[k] = fe__clampf(body->torque[k] + t[k], -most_torque, most_torque);
    }
}

// I = R diag(principal) R^T in world axes, in double
void fe__body_world_inertia(const fe__body *body, double inertia[3][3])
{
    fe_quat rotation = fe__rotation_of(body), axes = fe__quat_of(body->inertia_axes);
    double column[3][3];
    for (int k = 0; k < 3; ++k) {
        fe_dvec3 unit = {k == 0, k == 1, k == 2}, a = fe__drotate(rotation, fe__drotate(axes, unit));
        column[k][0] = a.x, column[k][1] = a.y, column[k][2] = a.z;
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            inertia[i][j] = 0.0;
            for (int k = 0; k < 3; ++k) inertia[i][j] += (double)body->inertia[k] * column[k][i] * column[k][j];
        }
    }
}

// Solves I w = L by Cramer's rule. A locked axis keeps its w at 0: its row and column become those of the unit matrix
// (scaled like the rest), its L 0; the inertia over the free axes is left.
fe_vec3 fe__body_spin_change(const fe__body *body, fe_vec3 angular_impulse)
{
    double m[3][3], l[3] = {(double)angular_impulse.x, (double)angular_impulse.y, (double)angular_impulse.z};
    fe__body_world_inertia(body, m);
    double size = fe__maxd(fe__maxd(m[0][0], m[1][1]), m[2][2]);
    uint32_t locks = (uint32_t)body->lock_bits >> 3;
    for (int k = 0; k < 3; ++k) {
        if (!(locks >> k & 1)) continue;
        for (int j = 0; j < 3; ++j) m[k][j] = m[j][k] = 0.0;
        m[k][k] = size;
        l[k] = 0.0;
    }
    fe_dvec3 a = {m[0][0], m[1][0], m[2][0]}, b = {m[0][1], m[1][1], m[2][1]}, c = {m[0][2], m[1][2], m[2][2]},
             right = {l[0], l[1], l[2]};
    double determinant = fe__ddot(a, fe__dcross(b, c));
    return (fe_vec3){(float)(fe__ddot(right, fe__dcross(b, c)) / determinant),
                     (float)(fe__ddot(a, fe__dcross(right, c)) / determinant),
                     (float)(fe__ddot(a, fe__dcross(b, right)) / determinant)};
}

// The rotation is to * from^-1 = (u sin(angle / 2), cos(angle / 2)). q and -q are the same rotation; the one with a
// cosine >= 0 is the shorter way.
fe_vec3 fe__spin_between(fe_quat from, fe_quat to, double seconds)
{
    double fx = -(double)from.x, fy = -(double)from.y, fz = -(double)from.z, fw = (double)from.w;
    double x = (double)to.w * fx + (double)to.x * fw + (double)to.y * fz - (double)to.z * fy;
    double y = (double)to.w * fy - (double)to.x * fz + (double)to.y * fw + (double)to.z * fx;
    double z = (double)to.w * fz + (double)to.x * fy - (double)to.y * fx + (double)to.z * fw;
    double w = (double)to.w * fw - (double)to.x * fx - (double)to.y * fy - (double)to.z * fz;
    double sine = sqrt(x * x + y * y + z * z);
    if (sine == 0.0) return (fe_vec3){0.0f, 0.0f, 0.0f};
    double angle = 2.0 * fe__atan2(sine, fe__absd(w)), rate = (w < 0.0 ? -angle : angle) / (sine * seconds);
    return (fe_vec3){(float)(rate * x), (float)(rate * y), (float)(rate * z)};
}
