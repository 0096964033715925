// body_room.h - room for the records of bodies.
#ifndef FE_WORLD_BODY_ROOM_H
#define FE_WORLD_BODY_ROOM_H
#include "world/world.h"

fe_result fe__reserve_bodies(fe_world *world, int32_t extra); // the `extra` creations that follow cannot fail

#endif
