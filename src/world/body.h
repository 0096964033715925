// body.h - the records of bodies: memory, pose, speed. The record itself is solver_body.h.
#ifndef FE_WORLD_BODY_H
#define FE_WORLD_BODY_H
#include "world/world.h"

#include <string.h>

fe_result fe__reserve_bodies(fe_world *world, int32_t extra); // the `extra` creations that follow cannot fail

// ---- pose -----------------------------------------------------------------------------------------------------------

static inline fe_quat fe__rotation_of(const fe__body *b) { return fe__quat_of(b->rotation); }
static inline fe_dvec3 fe__centre_of(const fe__body *b) { return (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}; }
static inline fe_dvec3 fe__origin_of(const fe__body *b) { return (fe_dvec3){b->origin[0], b->origin[1], b->origin[2]}; }

fe_quat fe__unit_rotation(fe_quat q);               // q unchanged when its length is 1 already, else q/|q|
void fe__body_place_centre(fe__body *body);         // centre from origin, rotation and local centre
void fe__body_place(fe_world *world, int32_t body); // shapes' poses from the body's
void fe__shape_place(fe_world *world, int32_t shape);
// The pose of a body at the end of a step of dt seconds without contacts, and a shape of it then
void fe__advance(const fe_world *world, const fe__body *body, float dt, fe_dvec3 *centre, fe_quat *rotation);
fe__pose fe__shape_pose_at(const fe__body *body, const fe__shape *shape, fe_dvec3 centre, fe_quat rotation);

// ---- speed ----------------------------------------------------------------------------------------------------------
// The narrow phase and continuous collision ask how fast a body may be.

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

// Called after each change of size.
static inline void fe__body_note_swiftness(fe_world *world, const fe__body *body)
{
    fe__note_swiftness(world, fe__swiftness_of(body));
}

// Computes how fast the body's fastest point may be. `o`: the body's odometer
static inline void fe__note_speed(fe__body *body, fe__odometer *o)
{
    const float *v = body->velocity, *w = body->spin;
    float spin = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    body->speed = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + spin * body->reach;
    memcpy(o->velocity, v, sizeof o->velocity);
    o->spin = spin;
}

// Called after each change of velocity, on any thread.
static inline void fe__body_note_speed(fe_world *world, fe__body *body)
{
    fe__note_speed(body, world->odometers + (body - world->bodies));
    fe__body_note_swiftness(world, body);
}

void fe__body_stop_locked(fe_world *world, fe__body *body); // zeros the locked components of its velocities

#endif
