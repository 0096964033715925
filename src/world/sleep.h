// sleep.h - waking and falling asleep.
#ifndef FE_WORLD_SLEEP_H
#define FE_WORLD_SLEEP_H
#include "world/world.h"

// 1: nothing is awake, and nothing waits to be looked at or reported. A step would change no more than its own numbers
int32_t fe__world_rests(const fe_world *world);
void fe__world_wake_all(fe_world *world);
void fe__world_set_gravity(fe_world *world, fe_vec3 gravity); // wakes all bodies if it changes

// Wakes a body and all that touches it, through dynamic bodies; does nothing to static ones.
void fe__wake(fe_world *world, int32_t body);
void fe__wake_neighbours(fe_world *world, int32_t body); // wakes all that touches it, not the body
void fe__body_disturb(fe_world *world, int32_t body);    // fe__wake, for a static body fe__wake_neighbours

// Puts the body's island to sleep. FE_ERROR_STATE: part of it may not sleep
fe_result fe__put_to_sleep(fe_world *world, int32_t body);
void fe__body_fall_asleep(fe_world *world, int32_t body);  // stops and retires the body alone
void fe__body_awaken_alone(fe_world *world, int32_t body); // into the awake lists, with its pairs and joints
void fe__body_retire(fe_world *world, int32_t body);       // out of the awake lists

#endif
