// drawing.h - what a call draws, and how.
#ifndef FE_DRAW_DRAWING_H
#define FE_DRAW_DRAWING_H
#include "collision/surface/surface.h"
#include "world/world.h"

enum {
    FE__DRAWN_ISLANDS = 16384, // that have a hue of their oldest body; of any further ones each body has its own
    FE__DRAW_ALL = 2 * FE_DRAW_TREES - 1
};

// What is drawn, and how: of a call
typedef struct fe__drawing {
    const fe_world *world;
    uint32_t parts; // fe_draw_flags
    fe_dvec3 origin;
    fe__bounds box;
    int32_t has_box; // 0: the box holds every place there is
    int32_t only;    // body, -1: all
    float scale;     // m
    fe__circle circle;
    uint8_t hue_of[FE__DRAWN_ISLANDS]; // by island: 1 + hue; 0: not met yet
} fe__drawing;

// `drawing` has its world, parts, origin, box, only and scale
void fe__drawing_begin(fe__drawing *drawing, int32_t segments);

#endif
