// drawing.c - see drawing.h.
#include "draw/drawing.h"

#include "core/ranges.h"

void fe__drawing_begin(fe__drawing *d, int32_t segments)
{
    const double most = FE_MAX_POSITION;
    const fe__bounds *b = &d->box;
    d->has_box = b->low.x > -most || b->low.y > -most || b->low.z > -most || b->high.x < most || b->high.y < most ||
                 b->high.z < most;
    fe__circle_make(&d->circle, segments);
    memset(d->hue_of, 0, sizeof d->hue_of);
}
