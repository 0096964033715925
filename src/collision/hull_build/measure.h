// measure.h - what a hull weighs, and how far points that were left out lie outside.
#ifndef FE_COLLISION_HULL_BUILD_MEASURE_H
#define FE_COLLISION_HULL_BUILD_MEASURE_H
#include "collision/hull_build/builder.h"

void fe__hull_weigh(fe__hull *hull); // mass, inner radius
void fe__hull_measure_error(const fe__hull_builder *builder, fe__hull *hull);
#endif
