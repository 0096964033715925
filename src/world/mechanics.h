// mechanics.h - energy, momentum and bounds of a world, summed over its bodies in the order of creation.
#ifndef FE_WORLD_MECHANICS_H
#define FE_WORLD_MECHANICS_H
#include "world/world.h"

// J. Potential: of positions half a substep back, the discrete flight's (fe_world_get_energy)
void fe__world_energy(const fe_world *world, double *out_kinetic, double *out_potential);
// N s, and N m s about a point
void fe__world_momentum(const fe_world *world, fe_dvec3 about, fe_dvec3 *out_linear, fe_dvec3 *out_angular);
// Of all shapes of a body, or of all bodies (-1), but planes. 0: there are none
int32_t fe__body_bounds(const fe_world *world, int32_t body, fe__bounds *out_bounds);
fe__bounds fe__whole_bounds(const fe_world *world, int32_t shape); // of a shape that is no plane

#endif
