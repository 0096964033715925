// sleep.h - who wakes whom, and who falls asleep together.
#ifndef FE_WORLD_SLEEP_H
#define FE_WORLD_SLEEP_H
#include "world/world.h"

// Nothing is awake, and nothing waits to be looked at or told: a step moves on its own numbers only
int32_t fe__world_rests(const fe_world *world);
void fe__world_wake_all(fe_world *world);
void fe__world_set_gravity(fe_world *world, fe_vec3 gravity); // another one sets everything in motion
void fe__wake(fe_world *world,
              int32_t body); // it and all that touches it, through dynamic bodies; nothing on static ones
void fe__wake_neighbours(fe_world *world, int32_t body); // all that touches it, not the body
void fe__body_disturb(fe_world *world, int32_t body); // wakes it and what touches it; of a static body what touches it
fe_result fe__put_to_sleep(fe_world *world, int32_t body); // the body's island; FE_ERROR_STATE when part of it may not
void fe__body_awaken_alone(fe_world *world, int32_t body); // into the awake lists, its pairs too
void fe__body_retire(fe_world *world, int32_t body);       // out of the awake lists
void fe__body_fall_asleep(fe_world *world, int32_t body);  // stops and retires it

#endif
