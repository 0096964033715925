// joint.c - see joint.h.
#include "world/joint.h"

#include "core/bytes.h"
#include "world/body.h"
#include "world/contact.h"

#include <float.h>
#include <string.h>

// ---- lists ----------------------------------------------------------------------------------------------------------

static fe__link *link_of(fe_world *world, int32_t joint, int32_t body)
{
    fe__joint_record *r = world->joint_records + joint;
    return &r->links[fe__joint_side(r, body)];
}

void fe__joint_add_to_body(fe_world *world, int32_t joint, int32_t index)
{
    fe__body *body = world->bodies + index;
    *link_of(world, joint, index) = (fe__link){0, body->last_joint};
    if (body->last_joint)
        link_of(world, body->last_joint, index)->next = joint;
    else
        body->first_joint = joint;
    body->last_joint = joint;
    ++body->joint_total;
}

void fe__joint_remove_from_body(fe_world *world, int32_t joint, int32_t index)
{
    fe__body *body = world->bodies + index;
    fe__link link = *link_of(world, joint, index);
    if (link.previous)
        link_of(world, link.previous, index)->next = link.next;
    else
        body->first_joint = link.next;
    if (link.next)
        link_of(world, link.next, index)->previous = link.previous;
    else
        body->last_joint = link.previous;
    --body->joint_total;
}

void fe__joint_append_to_order(fe_world *world, int32_t joint)
{
    fe__joint_record *r = world->joint_records + joint;
    r->order_next = 0;
    r->order_previous = world->last_joint;
    if (world->last_joint)
        world->joint_records[world->last_joint].order_next = joint;
    else
        world->first_joint = joint;
    world->last_joint = joint;
    ++world->joint_count;
}

void fe__joint_remove_from_order(fe_world *world, int32_t joint)
{
    const fe__joint_record *r = world->joint_records + joint;
    if (r->order_previous)
        world->joint_records[r->order_previous].order_next = r->order_next;
    else
        world->first_joint = r->order_next;
    if (r->order_next)
        world->joint_records[r->order_next].order_previous = r->order_previous;
    else
        world->last_joint = r->order_previous;
    --world->joint_count;
}

static int32_t is_awake_dynamic(const fe_world *world, int32_t body)
{
    return world->bodies[body].type == FE_BODY_DYNAMIC && world->bodies[body].awake_index >= 0;
}

void fe__joint_awaken(fe_world *world, int32_t joint)
{
    fe__joint_record *r = world->joint_records + joint;
    if (r->awake_index >= 0 || (!is_awake_dynamic(world, r->body[0]) && !is_awake_dynamic(world, r->body[1]))) return;
    r->awake_index = world->awake_joint_count;
    world->awake_joints[world->awake_joint_count++] = joint;
}

void fe__joint_leave_awake(fe_world *world, int32_t joint)
{
    fe__joint_record *r = world->joint_records + joint;
    int32_t last = world->awake_joints[--world->awake_joint_count];
    world->awake_joints[r->awake_index] = last;
    world->joint_records[last].awake_index = r->awake_index;
    r->awake_index = -1;
}

void fe__joint_retire(fe_world *world, int32_t joint)
{
    const fe__joint_record *r = world->joint_records + joint;
    if (r->awake_index < 0 || is_awake_dynamic(world, r->body[0]) || is_awake_dynamic(world, r->body[1])) return;
    fe__joint_leave_awake(world, joint);
}

int32_t fe__bodies_joined(const fe_world *world, int32_t a, int32_t b)
{
    int32_t from = world->bodies[a].joint_total <= world->bodies[b].joint_total ? a : b, to = from == a ? b : a;
    for (int32_t joint = world->bodies[from].first_joint; joint; joint = fe__next_joint(world, joint, from))
        if (fe__joint_other(world, joint, from) == to && fe__joint_parts_bodies(world->joint_records + joint)) return 1;
    return 0;
}

// ---- anchor ---------------------------------------------------------------------------------------------------------

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
    uint32_t listed = body->flags & FE__BODY_DISTURBED; // the list names the slot, whichever body has it
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

// ---- drives ---------------------------------------------------------------------------------------------------------

float *fe__joint_motor_speed(fe__joint_any *def, int32_t type, int32_t dof)
{
    switch (type) {
    case FE_JOINT_DISTANCE:
        return dof == FE_DOF_LINEAR_X ? &def->distance.motor_speed : NULL;
    case FE_JOINT_BALL: {
        float *velocity[3] = {&def->ball.motor_velocity.x, &def->ball.motor_velocity.y, &def->ball.motor_velocity.z};
        return dof >= FE_DOF_ANGULAR_X ? velocity[dof - FE_DOF_ANGULAR_X] : NULL;
    }
    case FE_JOINT_HINGE:
        return dof == FE_DOF_ANGULAR_X ? &def->hinge.motor_speed : NULL;
    case FE_JOINT_CONFIGURABLE:
        return &def->configurable.axes[dof].motor_speed;
    default:
        return NULL;
    }
}

float *fe__joint_target(fe__joint_any *def, int32_t type, int32_t dof)
{
    switch (type) {
    case FE_JOINT_DISTANCE:
        return dof == FE_DOF_LINEAR_X ? &def->distance.target : NULL;
    case FE_JOINT_HINGE:
        return dof == FE_DOF_ANGULAR_X ? &def->hinge.target : NULL;
    case FE_JOINT_CONFIGURABLE:
        return &def->configurable.axes[dof].target;
    default:
        return NULL;
    }
}

void fe__joint_target_range(int32_t type, int32_t dof, float *out_least, float *out_most)
{
    *out_most = dof < FE_DOF_ANGULAR_X ? FE_MAX_LOCAL : FE_PI;
    *out_least = type == FE_JOINT_DISTANCE ? 0.0f : -*out_most;
}

int32_t fe__joint_free_dof(const fe__joint_any *def, int32_t type)
{
    if (type == FE_JOINT_DISTANCE) return FE_DOF_LINEAR_X;
    if (type == FE_JOINT_HINGE) return FE_DOF_ANGULAR_X;
    if (type != FE_JOINT_CONFIGURABLE) return -1;
    for (int32_t dof = FE_DOF_LINEAR_X; dof <= FE_DOF_ANGULAR_Z; ++dof)
        if (def->configurable.axes[dof].motion != FE_MOTION_LOCKED) return dof;
    return -1;
}
