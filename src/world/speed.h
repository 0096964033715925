// speed.h - how fast a body may be: what the narrow phase and continuous collision ask of each.
#ifndef FE_WORLD_SPEED_H
#define FE_WORLD_SPEED_H
#include "world/world.h"

#include <string.h>

static inline float fe__swiftness_of(const fe__body *body)
{
    return body->thickness > 0.0f ? body->speed / body->thickness : 0.0f;
}

static inline void fe__note_swiftness(fe_world *world, float swiftness)
{
    int32_t bits, most = atomic_load_explicit(&world->swiftest, memory_order_relaxed);
    memcpy(&bits, &swiftness, sizeof bits);
    while (bits > most && !atomic_compare_exchange_weak_explicit(&world->swiftest, &most, bits, memory_order_relaxed,
                                                                 memory_order_relaxed)) {}
}

// After each change of size
static inline void fe__body_note_swiftness(fe_world *world, const fe__body *body)
{
    fe__note_swiftness(world, fe__swiftness_of(body));
}

// What the narrow phase asks: how fast the fastest point may be. o: the body's
static inline void fe__note_speed(fe__body *body, fe__odometer *o)
{
    const float *v = body->velocity, *w = body->spin;
    float spin = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    body->speed = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + spin * body->reach;
    memcpy(o->velocity, v, sizeof o->velocity);
    o->spin = spin;
}

// After each change of velocity; on any thread
static inline void fe__body_note_speed(fe_world *world, fe__body *body)
{
    fe__note_speed(body, world->odometers + (body - world->bodies));
    fe__body_note_swiftness(world, body);
}

void fe__body_stop_locked(fe_world *world, fe__body *body); // zeros the locked components of its velocities

#endif
