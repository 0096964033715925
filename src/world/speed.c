// speed.c - see speed.h.
#include "world/speed.h"

#include <string.h>

void fe__body_note_swiftness(fe_world *world, const fe__body *body)
{
    float swiftness = body->thickness > 0.0f ? body->speed / body->thickness : 0.0f;
    int32_t bits, most = atomic_load_explicit(&world->swiftest, memory_order_relaxed);
    memcpy(&bits, &swiftness, sizeof bits);
    while (bits > most && !atomic_compare_exchange_weak_explicit(&world->swiftest, &most, bits, memory_order_relaxed,
                                                                 memory_order_relaxed)) {}
}

// What the narrow phase asks: how fast the fastest point may be
void fe__body_note_speed(fe_world *world, fe__body *body)
{
    const float *v = body->velocity, *w = body->spin;
    float spin = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    body->speed = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + spin * body->reach;
    fe__odometer *o = world->odometers + (body - world->bodies);
    for (int k = 0; k < 3; ++k) o->velocity[k] = v[k];
    o->spin = spin;
    fe__body_note_swiftness(world, body);
}

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
