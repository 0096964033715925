// colours.h - every colour of a drawing, in one table.
//
// Hues are of Okabe and Ito (Color universal design, 2008) and of Tol (Colour schemes, 2021): people who confuse red
// and green tell them apart.
#ifndef FE_DRAW_COLOURS_H
#define FE_DRAW_COLOURS_H
#include "draw/drawing.h"

#define FE__RGB(red, green, blue) \
    ((uint32_t)(red) | (uint32_t)(green) << 8 | (uint32_t)(blue) << 16 | (uint32_t)255 << 24)

typedef enum fe__colour {
    FE__COLOUR_STATIC,
    FE__COLOUR_KINEMATIC,
    FE__COLOUR_AWAKE, // where islands have no hues
    FE__COLOUR_ASLEEP,
    FE__COLOUR_ANCHOR, // from joints to bodies
    FE__COLOUR_GAP,    // between two points that should be one
    FE__COLOUR_X,
    FE__COLOUR_Y,
    FE__COLOUR_Z,
    FE__COLOUR_FORCE,
    FE__COLOUR_BOUNDS,
    FE__COLOUR_TREE,
    FE__COLOUR_CENTRE,
    FE__NAMED_COLOURS
} fe__colour;
enum { FE__HUES = 8, FE__LOADS = 6, FE__USES = 5 };

extern const uint32_t fe__colours[FE__NAMED_COLOURS];

uint32_t fe__body_colour(fe__drawing *drawing, int32_t body);
uint32_t fe__shape_colour(uint32_t body_colour, const fe__shape *shape);
// Of a force that is `load` times the weight of the lighter body
uint32_t fe__load_colour(double load);
// Of a range that is used: 0 in the middle, 1 at an end, more beyond
uint32_t fe__use_colour(double use);

#endif
