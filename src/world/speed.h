// speed.h - how fast a body may be: what the narrow phase and continuous collision ask of each.
#ifndef FE_WORLD_SPEED_H
#define FE_WORLD_SPEED_H
#include "world/world.h"

void fe__body_note_speed(fe_world *world, fe__body *body);           // after each change of velocity; on any thread
void fe__body_note_swiftness(fe_world *world, const fe__body *body); // after each change of size
void fe__body_stop_locked(fe_world *world, fe__body *body);          // zeros the locked components of its velocities

#endif
