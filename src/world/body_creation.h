// body_creation.h - the life of bodies.
//
// Calls that cannot fail return void; the others FE_OK or the reason, with nothing changed.
#ifndef FE_WORLD_BODY_CREATION_H
#define FE_WORLD_BODY_CREATION_H
#include "world/body.h"

int32_t fe__body_create(fe_world *world, const fe_body_def *def); // index; room was reserved
void fe__body_destroy(fe_world *world, int32_t body);
fe_result fe__body_set_type(fe_world *world, int32_t body, int32_t type);
fe_result fe__body_set_enabled(fe_world *world, int32_t body, int32_t enabled);
void fe__body_set_transform(fe_world *world, int32_t body, const fe_transform *transform); // wakes
void fe__body_set_locks(fe_world *world, int32_t body, uint32_t linear, uint32_t angular);

#endif
