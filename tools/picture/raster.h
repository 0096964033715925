// raster.h - which samples a triangle covers, in integers, and layers of samples that keep what is nearest.
#ifndef PICTURE_RASTER_H
#define PICTURE_RASTER_H
#include "vec.h"

#include <stdint.h>

enum { RASTER_ONE = 256 };       // units of a sample
enum { RASTER_REACH = 1 << 29 }; // units: no corner is farther out
enum { LAYER_NOTHING = -1 };

/// Samples [begin, end) of a row are covered.
typedef void raster_row(void *user, int32_t row, int32_t begin, int32_t end);

/// A corner, in samples: x to the right, y downwards. The centre of the first sample is at 0.5, 0.5.
typedef struct raster_point {
    double x, y;
} raster_point;

/// Samples that count: columns [0, width) of the rows [top, end).
typedef struct raster_area {
    int32_t width, top, end;
} raster_area;

/// Tells every sample whose centre the triangle covers, whichever way it is wound. Two triangles that share an edge
/// share no sample and leave none out.
void raster_triangle(const raster_point corners[3], raster_area area, raster_row *tell, void *user);

/// A depth and a number for each sample of an area.
typedef struct layer {
    raster_area area;
    float *near;    ///< greater is nearer, 0 is farthest
    int32_t *owner; ///< what is there, LAYER_NOTHING: nothing; or NULL: nobody asks
} layer;

/// A plane of depths over the samples: at = a x + b y + c, kept within the least and the greatest of the corners
typedef struct layer_plane {
    double a, b, c, least, most;
} layer_plane;

void layer_draw(layer *to, const raster_point corners[3], const layer_plane *depth, int32_t owner);

static inline int64_t area_at(const raster_area *area, int32_t x, int32_t y)
{
    return (int64_t)(y - area->top) * area->width + x;
}

static inline double plane_at(const layer_plane *p, double x, double y)
{
    return clamp(p->a * x + p->b * y + p->c, p->least, p->most);
}

#endif
