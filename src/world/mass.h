// mass.h - mass, centre and inertia of bodies: from their shapes and densities, or as given.
#ifndef FE_WORLD_MASS_H
#define FE_WORLD_MASS_H
#include "world/world.h"

void fe__body_update_mass(fe_world *world, int32_t body); // from the shapes, unless it was given; the reach in any case
void fe__body_gain_shape(fe_world *world, int32_t body, int32_t shape); // after the shape came
// Called after a shape went, or got another form or frame. The sizes of a static body with many shapes, which only a
// step reads, are computed at the step's beginning by fe__settle_sizes.
void fe__body_sizes_changed(fe_world *world, int32_t body);
void fe__body_densities_changed(fe_world *world, int32_t body);
void fe__settle_sizes(fe_world *world);
void fe__body_set_mass(fe_world *world, int32_t body, const fe_mass_data *data); // as given, until reset
// The mass data that the body would have with this mass, kg, distributed as it is
fe_mass_data fe__body_scaled_mass(const fe_world *world, int32_t body, float mass);
void fe__body_mass_data(const fe_world *world, int32_t body, fe_mass_data *out_data);

// ---- mechanics ------------------------------------------------------------------------------------------------------
// Energy, momentum and bounds of a world, summed over its bodies in the order of creation.

// Energies, J. The potential is taken half a substep back, on the discrete flight's parabola (fe_world_get_energy).
void fe__world_energy(const fe_world *world, double *out_kinetic, double *out_potential);
// Momentum, N s, and angular momentum about a point, N m s
void fe__world_momentum(const fe_world *world, fe_dvec3 about, fe_dvec3 *out_linear, fe_dvec3 *out_angular);
// Bounds of all shapes of a body, or of all bodies (-1), but planes. 0: there are none
int32_t fe__body_bounds(const fe_world *world, int32_t body, fe__bounds *out_bounds);
fe__bounds fe__whole_bounds(const fe_world *world, int32_t shape); // the shape is no plane

#endif
