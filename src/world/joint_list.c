// joint_list.c - see joint_list.h.
#include "world/joint_list.h"

// ---- of a body -----------------------------------------------------------------------------------------------------
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

// ---- who is awake --------------------------------------------------------------------------------------------------
// ---- of the awake --------------------------------------------------------------------------------------------------
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
// ---- who is joined -------------------------------------------------------------------------------------------------
int32_t fe__bodies_joined(const fe_world *world, int32_t a, int32_t b)
{
    int32_t from = world->bodies[a].joint_total <= world->bodies[b].joint_total ? a : b, to = from == a ? b : a;
    for (int32_t joint = world->bodies[from].first_joint; joint; joint = fe__next_joint(world, joint, from))
        if (fe__joint_other(world, joint, from) == to && fe__joint_parts_bodies(world->joint_records + joint)) return 1;
    return 0;
}
