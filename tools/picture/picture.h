// picture.h - pictures of worlds without a GPU: what one is taken with, and its bytes as a PNG.
//
// It stands on the public draw calls alone, as any program can. The same world gives the same bytes on every machine:
// nothing is computed but by integers, + - * / and sqrt in double and float, and each of those is exactly rounded.
#ifndef PICTURE_H
#define PICTURE_H
#include "feather.h"

#include <stddef.h>

/// Where a picture is taken from. y is up.
typedef struct picture_view {
    fe_dvec3 eye, target; ///< m; not one above the other
    double focal;         ///< distance of the image over its width: 1 sees 53 degrees across
    double radius;        ///< m, of what matters around the target: its shadows are drawn, haze begins beyond it
    fe_vec3 sun;          ///< where light comes from, any length but zero
    uint32_t parts;       ///< fe_draw_flags: of lines those of joints, limits, contacts and so on
    float scale;          ///< of lines, see fe_draw_options
} picture_view;

enum { PICTURE_LEAST = 16, PICTURE_MOST = 4096 }; // pixels of a side

/// Where all that may move is seen, as near as it fits; of a world without such bodies, all that stands. Bodies that
/// fell far off are left out. Sets the eye, the target and the radius of a view whose focal distance is set.
/// @param toward_eye  from the target, any length but zero, not upright
int32_t picture_fit(const fe_world *world, fe_vec3 toward_eye, int32_t width, int32_t height, picture_view *out);

/// Draws a world as red, green and blue, a byte each, row by row.
/// @param out_rgb  3 width height bytes
/// @return FE_OK; FE_ERROR_ARGUMENT for a size out of range, FE_ERROR_MEMORY, or what the draw calls say
int32_t picture_render(const fe_world *world, const picture_view *view, int32_t width, int32_t height,
                       uint8_t *out_rgb);

/// Both at once: the bytes of a PNG, to be freed; NULL where one fails.
uint8_t *picture_take(const fe_world *world, const picture_view *view, int32_t width, int32_t height, size_t *out_size);

/// A PNG of at most 144 colours.
/// @param out_size  bytes
/// @return to be freed; NULL without memory
uint8_t *picture_png(const uint8_t *rgb, int32_t width, int32_t height, size_t *out_size);

#endif
