// body_creation.c - the life of bodies: creation, pose, type, locks, enabling, destruction.
//
// Called by the API layer with checked arguments, between steps. A body's pose is its origin and rotation as they were
// set; the step moves the centre of mass and derives the origin from it. Mass is in mass.c, velocities and forces in
// fe_body.c, shapes in fe_shape.c.
#include "world/body_creation.h"

#include "world/asset_users.h"
#include "world/filter.h"
#include "world/joint_creation.h"
#include "world/mass.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/body.h"
#include "world/proxies.h"
#include "world/shape.h"
#include "world/sleep.h"

#include <string.h>

static void append_to_order(fe_world *world, int32_t index)
{
    fe__body *body = &world->bodies[index];
    body->order_next = -1;
    body->order_previous = world->last_body;
    if (world->last_body >= 0)
        world->bodies[world->last_body].order_next = index;
    else
        world->first_body = index;
    world->last_body = index;
    world->body_count += 1;
    world->static_count += body->type == FE_BODY_STATIC;
    world->kinematic_count += body->type == FE_BODY_KINEMATIC;
}

static void remove_from_order(fe_world *world, int32_t index)
{
    const fe__body *body = &world->bodies[index];
    if (body->order_previous >= 0)
        world->bodies[body->order_previous].order_next = body->order_next;
    else
        world->first_body = body->order_next;
    if (body->order_next >= 0)
        world->bodies[body->order_next].order_previous = body->order_previous;
    else
        world->last_body = body->order_previous;
    world->body_count -= 1;
    world->static_count -= body->type == FE_BODY_STATIC;
    world->kinematic_count -= body->type == FE_BODY_KINEMATIC;
}

static void set_pose(fe_world *world, fe__body *body, const fe_transform *transform)
{
    fe_quat q = fe__unit_rotation(transform->rotation);
    body->rotation[0] = q.x, body->rotation[1] = q.y, body->rotation[2] = q.z, body->rotation[3] = q.w;
    body->origin[0] = transform->position.x, body->origin[1] = transform->position.y,
    body->origin[2] = transform->position.z;
    fe__body_place_centre(body);
    fe__odometer_place(world->odometers + (body - world->bodies), body->centre);
}

static void set_lock_bits(fe_world *world, fe__body *body, uint32_t linear, uint32_t angular)
{
    body->lock_bits = (float)(linear | angular << 3);
    body->locked = (linear | angular) != 0;
    fe__body_stop_locked(world, body);
}

int32_t fe__body_create(fe_world *world, const fe_body_def *def)
{
    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->body_ids));
    fe__body *body = &world->bodies[index];
    uint32_t listed = body->flags & FE__BODY_DISTURBED; // the list names the slot, whichever body has it
    memset(body, 0, sizeof *body);
    world->drifts[index] = (fe__drift){{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}; // equal states have equal bytes
    body->type = def->type;
    body->flags = listed;
    if (def->enabled) body->flags |= FE__BODY_ENABLED;
    if (def->bullet) body->flags |= FE__BODY_BULLET;
    if (def->sleep_allowed) body->flags |= FE__BODY_SLEEP_ALLOWED;
    body->serial = world->next_serial++;
    body->user_data = def->user_data;
    body->line = body->awake_index = body->island = -1;
    body->first_contact = body->first_shape = body->last_shape = -1;
    body->gravity_scale = def->gravity_scale;
    body->sleep_threshold = def->sleep_threshold;
    body->linear_damping = def->linear_damping;
    body->angular_damping = def->angular_damping;
    set_pose(world, body, &def->transform);
    if (body->type != FE_BODY_STATIC && def->awake) { // sleeping and moving exclude each other
        fe_vec3 v = def->linear_velocity, w = def->angular_velocity;
        body->velocity[0] = v.x, body->velocity[1] = v.y, body->velocity[2] = v.z;
        body->spin[0] = w.x, body->spin[1] = w.y, body->spin[2] = w.z;
    }
    set_lock_bits(world, body, def->linear_locks, def->angular_locks);
    append_to_order(world, index);
    world->has_bullets |= def->bullet;
    fe__body_update_mass(world, index);
    if (def->enabled && def->awake && def->type != FE_BODY_STATIC) {
        fe__body_awaken_alone(world, index);
        body->flags |= FE__BODY_SEEN_AWAKE; // created awake: no event
    }
    return index;
}

// Ends what a body has with others. The neighbours wake before the pairs go, because they are found through the pairs.
static void part_from_neighbours(fe_world *world, int32_t body)
{
    fe__wake_neighbours(world, body);
    fe__body_drop_pairs(world, body);
    fe__body_unlink_joints(world, body);
}

void fe__body_destroy(fe_world *world, int32_t index)
{
    part_from_neighbours(world, index);
    fe__body_drop_joints(world, index);
    fe__body *body = &world->bodies[index];
    if (body->awake_index >= 0) fe__body_retire(world, index);
    // pairs and places in the awake lists are gone, so that nothing is left to disturb: the shapes only have to leave
    // the trees
    for (int32_t shape = body->first_shape; shape >= 0; shape = world->shapes[shape].next) {
        fe__shape_leave(world, shape);
        fe__shape_forget(world, shape);
    }
    // the slot's next body must not inherit the list of ignored bodies
    fe__body_ignore_none(world, index);
    remove_from_order(world, index);
    fe__id_pool_release(&world->body_ids, index);
}

// Takes a body out of the awake lists, and its shapes out of the trees.
static void leave_world(fe_world *world, int32_t index)
{
    fe__body *body = &world->bodies[index];
    part_from_neighbours(world, index);
    if (body->awake_index >= 0) fe__body_retire(world, index);
    for (int32_t shape = body->first_shape; shape >= 0; shape = world->shapes[shape].next)
        fe__shape_leave(world, shape);
    for (int k = 0; k < 3; ++k) body->force[k] = body->torque[k] = 0.0f;
}

static void enter_world(fe_world *world, int32_t index)
{
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0; shape = world->shapes[shape].next)
        fe__shape_enter(world, shape);
    fe__body_link_joints(world, index);
    fe__body_disturb(world, index);
}

// The pairs end (with their exits) and are found anew in the next step: what a pair may be depends on the types.
fe_result fe__body_set_type(fe_world *world, int32_t index, int32_t type)
{
    fe__body *body = &world->bodies[index];
    if (body->type == type) return FE_OK;
    if (!fe__reserve_proxies(world, type, body->shape_count)) return FE_ERROR_MEMORY;

    leave_world(world, index);
    world->static_count += (type == FE_BODY_STATIC) - (body->type == FE_BODY_STATIC);
    world->kinematic_count += (type == FE_BODY_KINEMATIC) - (body->type == FE_BODY_KINEMATIC);
    body->type = type;
    body->sleep_timer = 0.0f;
    if (type == FE_BODY_STATIC) {
        for (int k = 0; k < 3; ++k) body->velocity[k] = body->spin[k] = 0.0f;
        fe__body_note_speed(world, body);
    }
    if (type != FE_BODY_DYNAMIC) body->flags &= ~(uint32_t)FE__BODY_MASS_GIVEN;
    fe__body_update_mass(world, index);
    if (!(body->flags & FE__BODY_ENABLED)) return FE_OK;
    enter_world(world, index);
    return FE_OK;
}

fe_result fe__body_set_enabled(fe_world *world, int32_t index, int32_t enabled)
{
    fe__body *body = &world->bodies[index];
    if (enabled == ((body->flags & FE__BODY_ENABLED) != 0)) return FE_OK;
    if (!enabled) {
        leave_world(world, index);
        body->flags &= ~(uint32_t)FE__BODY_ENABLED;
        fe__body_link_joints(world, index); // none of them acts now
        return FE_OK;
    }
    if (!fe__reserve_proxies(world, body->type, body->shape_count)) return FE_ERROR_MEMORY;
    body->flags |= FE__BODY_ENABLED;
    fe__body_note_swiftness(world, body); // no step looked at it meanwhile
    body->sleep_timer = 0.0f;
    enter_world(world, index);
    return FE_OK;
}

// Pairs stay: the narrow phase sees how far the body went, and those that came apart end in the next step with their
// exits.
void fe__body_set_transform(fe_world *world, int32_t index, const fe_transform *transform)
{
    fe__body *body = &world->bodies[index];
    fe__body_disturb(world, index);
    set_pose(world, body, transform);
    fe__body_end_deferrals(world, index);
    fe__body_place(world, index);
    fe__body_wind_joints(world, index);
    for (int32_t shape = body->first_shape; shape >= 0; shape = world->shapes[shape].next)
        fe__shape_touch(world, shape);
    if (body->type != FE_BODY_STATIC) return;
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, index))
        fe__pair_look_once(world, pair);
}

void fe__body_set_locks(fe_world *world, int32_t index, uint32_t linear, uint32_t angular)
{
    fe__body_disturb(world, index);
    fe__body_unlink_joints(world, index);
    set_lock_bits(world, &world->bodies[index], linear, angular);
    fe__body_update_mass(world, index);
    fe__body_link_joints(world, index);
    // locked bodies' contacts go to rows of another kind
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0; shape = world->shapes[shape].next)
        if (world->shapes[shape].parent < 0) fe__shape_material_changed(world, shape); // also for its parts
}
