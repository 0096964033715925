// body_room.c - see body_room.h.
#include "world/body_room.h"

fe_result fe__reserve_bodies(fe_world *world, int32_t extra)
{
    fe_result ids = fe__id_pool_reserve(&world->body_ids, &world->memory, extra);
    if (ids != FE_OK) return ids;
    int64_t opened = world->body_ids.slot_count, fresh = fe__maxi(0, extra - world->body_ids.free_count);
    if (!FE_RESERVE(&world->memory, world->bodies, world->body_capacity, opened + fresh) ||
        !FE_RESERVE(&world->memory, world->odometers, world->odometer_capacity, opened + fresh) ||
        !FE_RESERVE(&world->memory, world->drifts, world->drift_capacity, opened + fresh))
        return FE_ERROR_MEMORY;
    int64_t alive = (int64_t)world->body_count + extra;
    int32_t room = FE_RESERVE(&world->memory, world->awake_bodies, world->awake_body_capacity, alive) &&
                   FE_RESERVE(&world->memory, world->disturbed, world->disturbed_capacity, world->body_capacity);
    return room ? FE_OK : FE_ERROR_MEMORY;
}
