// gauge.h - the range of a joint as a scale with a needle, in frame A.
#ifndef FE_DRAW_GAUGE_H
#define FE_DRAW_GAUGE_H
#include "draw/drawing.h"

typedef struct fe__gauge {
    const fe__drawing *drawing;
    fe__pen *pen;
    fe_transform frame; // A's, world space
    fe_dvec3 point;     // of frame B, world space
    const fe_joint_state *state;
} fe__gauge;

// All ranges of a joint of a type (fe_joint_type)
void fe__draw_gauges(const fe__gauge *gauge, int32_t type, const fe__joint_any *def);

#endif
