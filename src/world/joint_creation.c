// joint_creation.c - the life of joints: creation, change, places in lists and in the constraint graph, destruction.
//
// Called by the API layer with checked definitions, between steps, and by the life of bodies. A joint is linked while
// it is enabled, its bodies are, and one of them is dynamic.
#include "world/joint_creation.h"

#include "world/joint.h"
#include "world/body.h"
#include "world/world.h"
#include "world/joint_parts.h"
#include "world/contact_creation.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <assert.h>
#include <string.h>

void fe__joints_init(fe_world *world)
{
    fe__id_pool_init(&world->joint_ids, FE_KIND_JOINT, world->number);
    fe__record_pool_init(&world->joint_axes, sizeof(fe__joint_axes));
    for (int32_t type = 1; type < FE__JOINT_TYPES; ++type)
        fe__record_pool_init(&world->joint_settings[type], fe__joint_def_size(type) - FE__JOINT_FRONT);
}

// ---- constraint graph -----------------------------------------------------------------------------------------------

int32_t fe__joint_acts(const fe_world *world, int32_t joint)
{
    const fe__joint_record *r = world->joint_records + joint;
    const fe__body *a = world->bodies + r->body[0], *b = world->bodies + r->body[1];
    return r->flags & FE__JOINT_ENABLED && a->flags & b->flags & FE__BODY_ENABLED &&
           (a->type == FE_BODY_DYNAMIC || b->type == FE_BODY_DYNAMIC);
}

// Links a joint if it acts. One that does not bears nothing.
static void link(fe_world *world, int32_t joint)
{
    if (!fe__joint_acts(world, joint)) {
        fe__joint_forget_impulses(&world->joints, joint);
        return;
    }
    fe__joint_link(&world->joints, world->bodies, joint);
    world->clusters.is_stale = 1;
    world->solver.graph_changed = 1;
}

static void unlink(fe_world *world, int32_t joint)
{
    if (world->joints.joints[joint].colour < 0) return;
    fe__joint_unlink(&world->joints, world->bodies, joint);
    world->solver.graph_changed = 1;
}

void fe__body_unlink_joints(fe_world *world, int32_t body)
{
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body))
        unlink(world, joint);
}

void fe__body_link_joints(fe_world *world, int32_t body)
{
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body))
        link(world, joint);
}

// Ends the pairs that may no longer be (parted: 1), or has the next step find those that may be again.
static void refilter(fe_world *world, const fe__joint_record *r, int32_t parted)
{
    if (!parted) {
        for (int32_t i = world->bodies[r->body[0]].first_shape; i >= 0; i = world->shapes[i].next)
            fe__shape_mark_moved(world, i);
        return;
    }
    int32_t fewer = world->bodies[r->body[0]].contact_count <= world->bodies[r->body[1]].contact_count ? 0 : 1;
    fe__body_refilter(world, r->body[fewer]);
}

static void wake_bodies(fe_world *world, const int32_t *bodies)
{
    for (int k = 0; k < 2; ++k)
        if (world->bodies[bodies[k]].flags & FE__BODY_ENABLED) fe__wake(world, bodies[k]);
}

// ---- the solver's half of a joint -----------------------------------------------------------------------------------

static void set_vec(float *out, fe_vec3 a) { out[0] = a.x, out[1] = a.y, out[2] = a.z; }
static void set_quat(float *out, fe_quat q) { out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w; }
// A twist counts its turns from the middle of its range.
static void wind(fe_world *world, int32_t joint)
{
    const fe__joint_frame *f = world->joints.frames + joint;
    if (!(f->parts >> FE__PART_TWIST & 1)) return;
    fe__joint_axis *axis = world->joints.axes[f->axes].axis + FE__AXIS_TWIST;
    fe__joint_pose pose;
    fe__joint_pose_of(&world->joints, world->bodies, joint, &pose);
    axis->state.x = axis->limit.high < FE__UNLIMITED
                        ? fe__joint_wind(pose.twist, 0.5f * (axis->limit.low + axis->limit.high))
                        : pose.twist;
}

static void place_anchors(fe_world *world, int32_t joint)
{
    const fe__joint_record *r = world->joint_records + joint;
    fe__joint *j = world->joints.joints + joint;
    set_vec(j->arm_a, fe__sub(r->frame[0].position, fe__quad_vector(world->bodies[r->body[0]].local_centre)));
    set_vec(j->arm_b, fe__sub(r->frame[1].position, fe__quad_vector(world->bodies[r->body[1]].local_centre)));
}

void fe__body_place_anchors(fe_world *world, int32_t body)
{
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body))
        place_anchors(world, joint);
}

void fe__body_wind_joints(fe_world *world, int32_t body)
{
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body))
        wind(world, joint);
}

void fe__body_forget_joints(fe_world *world, int32_t body)
{
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body)) {
        const fe__joint_frame *f = world->joints.frames + joint;
        fe__joint_forget_impulses(&world->joints, joint);
        // the last step may have left no numbers
        for (int32_t k = 0; f->axes && k < FE__AXES; ++k) world->joints.axes[f->axes].axis[k].state.x = 0.0f;
        wind(world, joint);
    }
}

// Impulses and states of an axis go on if the part that has them stays.
static void fill_axes(fe_world *world, int32_t joint, const fe__joint_plan *plan)
{
    fe__joint_frame *f = world->joints.frames + joint;
    if (!fe__joint_needs_axes(plan)) {
        if (f->axes) fe__record_pool_return(&world->joint_axes, f->axes);
        f->axes = 0;
        return;
    }
    if (!f->axes) f->axes = fe__record_pool_take(&world->joint_axes);
    fe__joint_axes *axes = world->joints.axes + f->axes, old = *axes;
    *axes = plan->axes;
    for (int32_t k = 0; k < FE__AXES; ++k) {
        if (fe__joint_part_at(f->parts, k) != fe__joint_part_at(plan->parts, k)) continue;
        axes->axis[k].impulse = old.axis[k].impulse;
        axes->axis[k].state = old.axis[k].state;
    }
    if (!(f->parts & plan->parts & 1u << FE__PART_ROTATION)) return;
    memcpy(axes->rotation.impulse, old.rotation.impulse, sizeof old.rotation.impulse);
    memcpy(axes->rotation.motor_impulse, old.rotation.motor_impulse, sizeof old.rotation.motor_impulse);
    memcpy(axes->rotation.torque, old.rotation.torque, sizeof old.rotation.torque);
}

void fe__joint_fill(fe_world *world, int32_t joint, const fe__joint_plan *plan)
{
    fe__joint_record *r = world->joint_records + joint;
    fe__joint *j = world->joints.joints + joint;
    fe__joint_frame *f = world->joints.frames + joint;
    fill_axes(world, joint, plan);
    f->parts = (uint16_t)plan->parts;
    f->locked = (uint16_t)plan->locked;
    r->shift = plan->shift;
    set_quat(f->frame_a, fe__product(r->frame[0].rotation, fe__joint_shift(r->shift)));
    set_quat(f->frame_b, fe__product(r->frame[1].rotation, fe__joint_shift(r->shift)));
    j->hertz = plan->hertz, j->damping_ratio = plan->damping_ratio;
    place_anchors(world, joint);
    wind(world, joint);
}

// ---- creation, change, destruction ----------------------------------------------------------------------------------

static fe_result reserve_axes(fe_world *world, int32_t extra)
{
    fe_result result = fe__record_pool_reserve(&world->joint_axes, &world->memory, extra);
    world->joints.axes = (fe__joint_axes *)(void *)world->joint_axes.records;
    return result;
}

static fe_result reserve(fe_world *world, int32_t type, int32_t with_axes)
{
    fe__memory *memory = &world->memory;
    fe_result ids = fe__id_pool_reserve(&world->joint_ids, memory, 1);
    if (ids != FE_OK) return ids;
    int64_t limit = 1 + (int64_t)world->joint_ids.slot_count + (world->joint_ids.free_count ? 0 : 1);
    int32_t is_done = FE_RESERVE(memory, world->joints.joints, world->joint_capacity[0], limit) &&
                      FE_RESERVE(memory, world->joints.frames, world->joint_capacity[1], limit) &&
                      FE_RESERVE(memory, world->joints.reactions, world->joint_capacity[2], limit) &&
                      FE_RESERVE(memory, world->joint_records, world->joint_capacity[3], limit) &&
                      FE_RESERVE(memory, world->awake_joints, world->awake_joint_capacity, limit);
    if (!is_done) return FE_ERROR_MEMORY;
    fe_result settings = fe__record_pool_reserve(&world->joint_settings[type], memory, 1);
    if (settings != FE_OK) return settings;
    return with_axes ? reserve_axes(world, 1) : FE_OK;
}

static int32_t is_breakable(const fe__joint_record *r) { return r->break_force > 0.0f || r->break_torque > 0.0f; }

static void set_record(fe_world *world, int32_t joint, const fe__joint_any *def)
{
    fe__joint_record *r = world->joint_records + joint;
    const fe_joint_def *d = &def->common;
    world->breakable_count -= is_breakable(r);
    r->flags = (d->enabled ? FE__JOINT_ENABLED : 0u) | (d->collide_connected ? FE__JOINT_COLLIDES : 0u);
    r->frame[0] = (fe_frame){d->frame_a.position, fe__unit_rotation(d->frame_a.rotation)};
    r->frame[1] = (fe_frame){d->frame_b.position, fe__unit_rotation(d->frame_b.rotation)};
    r->hertz = d->hertz, r->damping_ratio = d->damping_ratio;
    r->break_force = d->break_force, r->break_torque = d->break_torque;
    r->user_data = d->user_data;
    r->world_origin = d->world_origin;
    for (int k = 0; k < 2; ++k)
        if (fe__is_anchor(world, r->body[k])) fe__anchor_move(world, r->body[k], d->world_origin);
    world->breakable_count += is_breakable(r);
    const fe__record_pool *pool = &world->joint_settings[r->type];
    memcpy(fe__record(pool, r->settings), (const unsigned char *)def + FE__JOINT_FRONT, (size_t)pool->size);
}

fe_result fe__joint_create(fe_world *world, int32_t type, const fe__joint_any *def, const int32_t *ends,
                           int32_t *out_joint)
{
    fe__joint_plan plan;
    fe__joint_make_plan(type, def, &plan);
    fe_result reserved = reserve(world, type, fe__joint_needs_axes(&plan));
    if (reserved == FE_OK && (ends[0] < 0 || ends[1] < 0)) reserved = fe__reserve_bodies(world, 1);
    if (reserved != FE_OK) return reserved;
    const fe_dvec3 origin = def->common.world_origin;
    const int32_t bodies[2] = {ends[0] < 0 ? fe__anchor_create(world, origin) : ends[0],
                               ends[1] < 0 ? fe__anchor_create(world, origin) : ends[1]};

    int32_t joint = 1 + fe__id_slot_of(fe__id_pool_allocate(&world->joint_ids));
    fe__joint_record *r = world->joint_records + joint;
    memset(r, 0, sizeof *r);
    memset(world->joints.joints + joint, 0, sizeof *world->joints.joints);
    memset(world->joints.frames + joint, 0, sizeof *world->joints.frames);
    memset(world->joints.reactions + joint, 0, sizeof *world->joints.reactions);
    r->type = type;
    r->body[0] = bodies[0], r->body[1] = bodies[1];
    r->awake_index = -1;
    r->settings = fe__record_pool_take(&world->joint_settings[type]);
    world->joints.joints[joint].body_a = bodies[0], world->joints.joints[joint].body_b = bodies[1];
    world->joints.joints[joint].colour = -1;
    world->joints.frames[joint].serial = world->next_serial++;
    set_record(world, joint, def);
    fe__joint_add_to_body(world, joint, bodies[0]);
    fe__joint_add_to_body(world, joint, bodies[1]);
    fe__joint_append_to_order(world, joint);
    fe__joint_fill(world, joint, &plan);
    link(world, joint);
    wake_bodies(world, bodies);
    fe__joint_awaken(world, joint);
    if (fe__joint_parts_bodies(r)) refilter(world, r, 1);
    *out_joint = joint;
    return FE_OK;
}

fe_result fe__joint_change(fe_world *world, int32_t joint, const fe__joint_any *def)
{
    fe__joint_record *r = world->joint_records + joint;
    fe__joint_plan plan;
    fe__joint_make_plan(r->type, def, &plan);
    if (fe__joint_needs_axes(&plan) && !world->joints.frames[joint].axes) {
        fe_result reserved = reserve_axes(world, 1);
        if (reserved != FE_OK) return reserved;
    }
    int32_t parted = fe__joint_parts_bodies(r);
    wake_bodies(world, r->body); // before, and after: it may act only then
    unlink(world, joint);
    set_record(world, joint, def);
    fe__joint_fill(world, joint, &plan);
    link(world, joint);
    wake_bodies(world, r->body);
    if (parted != fe__joint_parts_bodies(r)) refilter(world, r, !parted);
    return FE_OK;
}

void fe__joint_remove(fe_world *world, int32_t joint)
{
    fe__joint_record *r = world->joint_records + joint;
    unlink(world, joint);
    if (r->awake_index >= 0) fe__joint_leave_awake(world, joint);
    fe__joint_remove_from_body(world, joint, r->body[0]);
    fe__joint_remove_from_body(world, joint, r->body[1]);
    fe__joint_remove_from_order(world, joint);
    world->breakable_count -= is_breakable(r);
    if (fe__joint_parts_bodies(r)) refilter(world, r, 0);
    fe__record_pool_return(&world->joint_settings[r->type], r->settings);
    if (world->joints.frames[joint].axes) fe__record_pool_return(&world->joint_axes, world->joints.frames[joint].axes);
    world->joints.frames[joint].axes = 0;
    for (int k = 0; k < 2; ++k)
        if (fe__is_anchor(world, r->body[k])) fe__anchor_destroy(world, r->body[k]);
    r->type = 0;
    fe__id_pool_release(&world->joint_ids, joint - 1);
}

void fe__joint_destroy(fe_world *world, int32_t joint)
{
    wake_bodies(world, world->joint_records[joint].body);
    fe__joint_remove(world, joint);
}

void fe__body_drop_joints(fe_world *world, int32_t body)
{
    while (world->bodies[body].first_joint) fe__joint_destroy(world, world->bodies[body].first_joint);
}

void fe__joint_describe(const fe_world *world, int32_t joint, fe__joint_any *out_def)
{
    const fe__joint_record *r = world->joint_records + joint;
    out_def->common = (fe_joint_def){.struct_size = (uint32_t)fe__joint_def_size(r->type),
                                     .enabled = (r->flags & FE__JOINT_ENABLED) != 0,
                                     .body_a = fe__joint_end_handle(world, joint, 0),
                                     .body_b = fe__joint_end_handle(world, joint, 1),
                                     .user_data = r->user_data,
                                     .world_origin = r->world_origin,
                                     .frame_a = r->frame[0],
                                     .frame_b = r->frame[1],
                                     .collide_connected = (r->flags & FE__JOINT_COLLIDES) != 0,
                                     .hertz = r->hertz,
                                     .damping_ratio = r->damping_ratio,
                                     .break_force = r->break_force,
                                     .break_torque = r->break_torque};
    const fe__record_pool *pool = &world->joint_settings[r->type];
    memcpy((unsigned char *)out_def + FE__JOINT_FRONT, fe__record(pool, r->settings), (size_t)pool->size);
}
