// hash.c - the fingerprint of a world: poses, velocities, contacts, joints, events. It knows nothing of rows, lanes,
// slots or lists.
#include "world/hash.h"

#include "core/hash.h"
#include "world/joints.h"
#include "world/pair_list.h"
#include "world/points.h"

static void hash_floats(fe__hash *h, const float *a, int count)
{
    for (int i = 0; i < count; ++i) fe__hash_float(h, a[i]);
}

static void hash_body(fe__hash *h, const fe__body *b)
{
    fe__hash_u64(h, b->serial);
    fe__hash_u32(h, (uint32_t)b->type | (b->flags & FE__BODY_ENABLED) << 8 | (uint32_t)(b->awake_index >= 0) << 16);
    for (int k = 0; k < 3; ++k) fe__hash_double(h, b->origin[k]);
    hash_floats(h, b->rotation, 4);
    hash_floats(h, b->velocity, 3);
    hash_floats(h, b->spin, 3);
    hash_floats(h, b->force, 3);
    hash_floats(h, b->torque, 3);
    fe__hash_float(h, b->sleep_timer);
}

// As if there were no parts, and then the part's number. The number of a patch is above (points.h)
static void hash_serial(fe__hash *h, uint64_t serial)
{
    uint64_t patch = serial >> FE__PATCH_SHIFT << FE__PATCH_SHIFT;
    int32_t part = fe__part_of_serial(serial);
    fe__hash_u64(h, (serial - patch) >> FE__PART_BITS | patch);
    if (part >= 0) fe__hash_i32(h, part);
}

// contacts have no order of their own: their fingerprints are summed
uint64_t fe__hash_of_contact(const fe_world *w, int32_t pair)
{
    const fe__contact *m = w->contacts + pair;
    const fe__points *q = fe__points_of(w, m);
    const fe__extra *e = fe__extra_of(w, m);
    const float none[3] = {0.0f, 0.0f, 0.0f};
    fe__hash h = fe__hash_begin();
    hash_serial(&h, fe__pair_serial(w, pair, 0));
    hash_serial(&h, fe__pair_serial(w, pair, 1));
    hash_floats(&h, m->normal, 3);
    fe__hash_float(&h, m->point_count);
    hash_floats(&h, q->separation, (int)m->point_count);
    hash_floats(&h, q->normal_impulse, FE__POINTS);
    hash_floats(&h, q->friction_impulse, 3);
    fe__hash_float(&h, q->twist_impulse);
    hash_floats(&h, q->total_impulse, FE__POINTS);
    hash_floats(&h, e ? e->rolling_impulse : none, 3);
    return fe__hash_end(&h);
}

static void hash_pair_events(fe__hash *h, const fe__pair_event_record *r, int32_t count)
{
    fe__hash_i32(h, count);
    for (int32_t i = 0; i < count; ++i) {
        hash_serial(h, r[i].serial_a);
        hash_serial(h, r[i].serial_b);
        fe__hash_i32(h, r[i].kind << 1 | r[i].is_trigger);
    }
}

static void hash_other_events(fe__hash *h, const fe_world *w)
{
    fe__hash_i32(h, w->body_event_count);
    for (int32_t i = 0; i < w->body_event_count; ++i) {
        fe__hash_u64(h, w->body_events[i].serial);
        fe__hash_i32(h, w->body_events[i].event.kind);
    }
    fe__hash_i32(h, w->hit_event_count);
    for (int32_t i = 0; i < w->hit_event_count; ++i) {
        const fe__hit_event_record *r = w->hit_events + i;
        hash_serial(h, r->serial_a);
        hash_serial(h, r->serial_b);
        fe__hash_dvec3(h, r->event.point);
        fe__hash_vec3(h, r->event.normal);
        fe__hash_floats2(h, r->event.speed, r->event.impulse);
    }
}

static void hash_axes(fe__hash *h, const fe__joint_axes *axes)
{
    for (int k = 0; k < FE__AXES; ++k) {
        const fe__joint_axis *axis = axes->axis + k;
        fe__hash_float(h, axis->impulse.drive), fe__hash_float(h, axis->impulse.motor);
        fe__hash_float(h, axis->impulse.low), fe__hash_float(h, axis->impulse.high);
        fe__hash_float(h, axis->state.x), fe__hash_float(h, axis->state.force);
    }
    hash_floats(h, axes->rotation.impulse, 3);
    hash_floats(h, axes->rotation.motor_impulse, 3);
    hash_floats(h, axes->rotation.torque, 3);
}

static void hash_impulses(fe__hash *h, const fe_world *w, int32_t joint)
{
    const fe__joint *j = w->joints.joints + joint;
    const fe__joint_frame *f = w->joints.frames + joint;
    hash_floats(h, j->impulse, 3);
    hash_floats(h, f->impulse, 3);
    hash_floats(h, w->joints.reactions[joint].force, 3);
    hash_floats(h, w->joints.reactions[joint].torque, 3);
    if (f->axes) hash_axes(h, w->joints.axes + f->axes);
}

uint64_t fe__hash_of_impulses(const fe_world *w, int32_t joint)
{
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, w->joints.frames[joint].serial);
    hash_impulses(&h, w, joint);
    return fe__hash_end(&h);
}

// settings, as they were set, and impulses
static void hash_joint(fe__hash *h, const fe_world *w, int32_t joint)
{
    const fe__joint_record *r = w->joint_records + joint;
    fe__joint_any def;
    fe__joint_describe(w, joint, &def);
    fe__hash_u64(h, w->joints.frames[joint].serial);
    fe__hash_u64(h, w->bodies[r->body[0]].serial);
    fe__hash_u64(h, w->bodies[r->body[1]].serial);
    fe__hash_i32(h, r->type);
    fe__hash_joint_settings(h, r->type, &def);
    hash_impulses(h, w, joint);
}

// Nothing where there are none
static void hash_joints(fe__hash *h, const fe_world *w)
{
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) hash_joint(h, w, joint);
    for (int32_t i = 0; i < w->joint_event_count; ++i) {
        const fe__joint_event_record *r = w->joint_events + i;
        fe__hash_u64(h, r->serial);
        fe__hash_vec3(h, r->event.force);
        fe__hash_vec3(h, r->event.torque);
    }
}

uint64_t fe__hash_of_events(const fe_world *w)
{
    fe__hash h = fe__hash_begin();
    hash_pair_events(&h, w->pair_events, w->pair_event_count);
    hash_other_events(&h, w);
    return fe__hash_end(&h);
}

uint64_t fe__world_hash(const fe_world *w)
{
    fe__hash h = fe__hash_begin();
    uint64_t contacts = 0;
    fe__hash_i32(&h, w->body_count);
    for (int32_t i = w->first_body; i >= 0; i = w->bodies[i].order_next) {
        hash_body(&h, w->bodies + i);
        for (int32_t pair = w->bodies[i].first_contact; pair >= 0; pair = fe__next_pair(w, pair, i))
            if (w->pairs[pair].body_a == i && w->pairs[pair].flags & FE__PAIR_LINKED)
                contacts += fe__hash_of_contact(w, pair);
    }
    fe__hash_u64(&h, contacts);
    hash_pair_events(&h, w->pair_events, w->pair_event_count);
    hash_other_events(&h, w);
    hash_joints(&h, w);
    return fe__hash_end(&h);
}
