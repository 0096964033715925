// builder.h - the work room of one hull: what the steps of build.h hand on.
#ifndef FE_COLLISION_HULL_BUILD_BUILDER_H
#define FE_COLLISION_HULL_BUILD_BUILDER_H
#include "collision/hull_build/facets.h"

typedef struct fe__hull_builder {
    fe__cloud cloud;
    fe__hull_surface surface;
    fe__facets facets;
    double tolerance, thickness; // m
    int32_t vertex_count, direction_count;
    int32_t number[FE__SURFACE_VERTICES];     // in the hull, of a vertex of the surface; -1: none
    int32_t vertex[FE__SURFACE_VERTICES];     // the reverse
    uint16_t half[3 * FE__SURFACE_TRIANGLES]; // half-edge of a corner of the facets
    fe_dvec3 direction[FE__HULL_DIRECTIONS];
    uint16_t edge_end; // half-edges so far
} fe__hull_builder;

#endif
