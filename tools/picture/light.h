// light.h - what colour a point of a face has: sun, sky and haze. Colours are linear light, 0..1, until the end.
#ifndef PICTURE_LIGHT_H
#define PICTURE_LIGHT_H
#include "shadow.h"

typedef struct light {
    const shadow *shadow;
    vec up, target; ///< in the camera's space
    double radius;
} light;

enum { LIGHT_STEPS = 8192 };
typedef struct light_bytes {
    uint8_t bytes[LIGHT_STEPS + 1]; ///< of linear light
} light_bytes;

typedef struct lit {
    vec colour;
    double haze; ///< 0: none, 1: nothing else is seen
    int half;    ///< at the edge of a shadow
} lit;

/// @param down  0 at the upper edge of the picture, 1 at the lower
vec light_background(double down);
/// The colour of a triangle, with the shade of its body.
vec light_own(const triangle *t);
/// @param ray   through the point, its z is 1
/// @param down  as above: what haze hides has the background's colour
lit light_triangle(const light *l, const triangle *t, vec ray, double down);
/// The square root is the gamma, 2 for 2.2.
vec light_of_bytes(uint32_t rgba);
/// And back, by a table.
void light_make_bytes(light_bytes *out);

static inline uint8_t light_to_byte(const light_bytes *of, double linear)
{
    return of->bytes[(int32_t)(LIGHT_STEPS * clamp(linear, 0.0, 1.0) + 0.5)];
}

#endif
