// anchor.c - see anchor.h.
#include "world/anchor.h"

#include "world/pose.h"

#include <float.h>
#include <string.h>

int32_t fe__anchor_create(fe_world *world, fe_dvec3 origin)
{
    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->body_ids));
    fe__id_pool_hide(&world->body_ids, index);
    fe__anchor_open(world, index, origin);
    return index;
}

void fe__anchor_open(fe_world *world, int32_t index, fe_dvec3 origin)
{
    fe__body *body = &world->bodies[index];
    uint32_t listed = body->flags & FE__BODY_DISTURBED; // the list names the slot, whoever has it
    memset(body, 0, sizeof *body);
    body->type = FE_BODY_STATIC;
    body->flags = FE__BODY_ENABLED | FE__BODY_ANCHOR | listed;
    body->rotation[3] = body->inertia_axes[3] = 1.0f;
    body->thickness = FLT_MAX;
    body->line = body->awake_index = body->island = -1;
    body->first_contact = body->first_shape = body->last_shape = -1;
    body->order_next = body->order_previous = -1;
    fe__anchor_move(world, index, origin);
}

void fe__anchor_move(fe_world *world, int32_t index, fe_dvec3 origin)
{
    fe__body *body = &world->bodies[index];
    body->origin[0] = origin.x, body->origin[1] = origin.y, body->origin[2] = origin.z;
    fe__body_place_centre(body);
}

void fe__anchor_destroy(fe_world *world, int32_t index)
{
    fe__id_pool_show(&world->body_ids, index);
    fe__id_pool_release(&world->body_ids, index);
}
