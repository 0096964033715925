// shadow.h - what the sun sees: one map of depths, along the sun's rays.
#ifndef PICTURE_SHADOW_H
#define PICTURE_SHADOW_H
#include "raster.h"
#include "triangles.h"

typedef struct shadow {
    layer map;
    vec sun, across, along; ///< unit: towards the sun, and the map's axes. All in the camera's space
    vec centre;             ///< of the map
    double texels;          ///< a metre
} shadow;

/// @param size  texels of a side
int32_t shadow_make(const picture_view *view, const camera *camera, const triangle *triangles, int32_t count,
                    int32_t size, shadow *out);
void shadow_free(shadow *s);

/// How much of the sun reaches a point of a face, 0..1.
double shadow_light(const shadow *s, vec point, vec normal);

#endif
