// speed.c - see speed.h.
#include "world/speed.h"

// Locked components are exactly +0, so that the solver's masks never meet a velocity they would have to keep.
void fe__body_stop_locked(fe_world *world, fe__body *body)
{
    uint32_t bits = (uint32_t)body->lock_bits;
    for (uint32_t k = 0; k < 3; ++k) {
        if (bits >> k & 1) body->velocity[k] = 0.0f;
        if (bits >> (k + 3) & 1) body->spin[k] = 0.0f;
    }
    fe__body_note_speed(world, body);
}
