// hash.c - the fingerprint of a world: poses, velocities, contacts, joints, events. It knows nothing of rows, lanes,
// slots or lists.
#include "world/hash.h"

#include "core/bytes.h"
#include "world/contact.h"
#include "world/joint.h"
#include "world/joint_creation.h"

#include <string.h>

// ---- world ----------------------------------------------------------------------------------------------------------

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

// The serial of the whole shape, as if there were no parts, then the part's number. A patch's number is above both.
static void hash_serial(fe__hash *h, uint64_t serial)
{
    uint64_t patch = serial >> FE__PATCH_SHIFT << FE__PATCH_SHIFT;
    int32_t part = fe__part_of_serial(serial);
    fe__hash_u64(h, (serial - patch) >> FE__PART_BITS | patch);
    if (part >= 0) fe__hash_i32(h, part);
}

// Contacts have no order of their own: their fingerprints are summed.
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

static void hash_events(fe__hash *h, const fe_world *w)
{
    fe__hash_i32(h, w->pair_event_count);
    for (int32_t i = 0; i < w->pair_event_count; ++i) {
        const fe__pair_event_record *r = w->pair_events + i;
        hash_serial(h, r->serial_a);
        hash_serial(h, r->serial_b);
        fe__hash_i32(h, r->kind << 1 | r->is_trigger);
    }
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

static void hash_impulses(fe__hash *h, const fe_world *w, int32_t joint)
{
    const fe__joint *j = w->joints.joints + joint;
    const fe__joint_frame *f = w->joints.frames + joint;
    hash_floats(h, j->impulse, 3);
    hash_floats(h, f->impulse, 3);
    hash_floats(h, w->joints.reactions[joint].force, 3);
    hash_floats(h, w->joints.reactions[joint].torque, 3);
    if (!f->axes) return;
    const fe__joint_axes *axes = w->joints.axes + f->axes;
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

uint64_t fe__hash_of_impulses(const fe_world *w, int32_t joint)
{
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, w->joints.frames[joint].serial);
    hash_impulses(&h, w, joint);
    return fe__hash_end(&h);
}

// Settings, as they were given, and impulses
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

uint64_t fe__hash_of_events(const fe_world *w)
{
    fe__hash h = fe__hash_begin();
    hash_events(&h, w);
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
    hash_events(&h, w);
    // a world without joints hashes as if there were no such thing
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) hash_joint(&h, w, joint);
    for (int32_t i = 0; i < w->joint_event_count; ++i) {
        const fe__joint_event_record *r = w->joint_events + i;
        fe__hash_u64(&h, r->serial);
        fe__hash_vec3(&h, r->event.force);
        fe__hash_vec3(&h, r->event.torque);
    }
    return fe__hash_end(&h);
}

// ---- settings of joints ---------------------------------------------------------------------------------------------
// The order of these words is that of the first definitions of joints. It is kept apart from the structs of the API, so
// that a field more there changes no fingerprint of a world that does not use it.

enum { MOST_WORDS = 100 };

// 32-bit words, in the order in which they are put
typedef struct words {
    uint32_t word[MOST_WORDS];
    int32_t count;
} words;

static void put(words *w, uint32_t word) { w->word[w->count++] = word; }
static void put_int(words *w, int32_t value) { put(w, (uint32_t)value); }
static void put_float(words *w, float value) { put(w, fe__float_bits(value)); }
static void put_zeros(words *w, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) put(w, 0);
}
static void put_vec3(words *w, fe_vec3 a) { put_float(w, a.x), put_float(w, a.y), put_float(w, a.z); }
static void put_quat(words *w, fe_quat q)
{
    put_float(w, q.x), put_float(w, q.y), put_float(w, q.z), put_float(w, q.w);
}

// Bodies and user data are left out: the one are slots, the other is the host's.
static void put_common(words *w, const fe_joint_def *d)
{
    enum { BODIES_AND_USER_DATA = 6 };
    put(w, 0); // the number of bytes, written last
    put_int(w, d->enabled);
    put_zeros(w, BODIES_AND_USER_DATA);
    put_vec3(w, d->frame_a.position), put_quat(w, d->frame_a.rotation);
    put_vec3(w, d->frame_b.position), put_quat(w, d->frame_b.rotation);
    put_int(w, d->collide_connected);
    put_float(w, d->hertz), put_float(w, d->damping_ratio);
    put_float(w, d->break_force), put_float(w, d->break_torque);
    put_zeros(w, 1);
}

// A spring by stiffness puts its own pair in the place of hertz and damping ratio.
static void put_axis(words *w, const fe_joint_axis *a)
{
    int32_t physical = a->spring == FE_SPRING_STIFFNESS;
    put_int(w, a->motion), put_float(w, a->lower), put_float(w, a->upper);
    put_float(w, a->limit_hertz), put_float(w, a->limit_damping_ratio);
    put_int(w, a->spring), put_float(w, a->target);
    put_float(w, physical ? a->spring_stiffness : a->spring_hertz);
    put_float(w, physical ? a->spring_damping : a->spring_damping_ratio);
    put_float(w, a->spring_max), put_float(w, a->motor_speed), put_float(w, a->motor_max);
}

static void put_settings(words *w, int32_t type, const fe__joint_any *def)
{
    const fe_distance_joint_def *distance = &def->distance;
    const fe_ball_joint_def *ball = &def->ball;
    const fe_hinge_joint_def *hinge = &def->hinge;
    switch (type) {
    case FE_JOINT_DISTANCE:
        put_float(w, distance->lower), put_float(w, distance->upper), put_float(w, distance->target);
        put_float(w, distance->spring_hertz), put_float(w, distance->spring_damping_ratio);
        put_float(w, distance->spring_max), put_float(w, distance->motor_speed), put_float(w, distance->motor_max);
        return;
    case FE_JOINT_BALL:
        put_int(w, ball->cone_enabled), put_float(w, ball->cone_y), put_float(w, ball->cone_z);
        put_int(w, ball->limit_enabled), put_float(w, ball->lower), put_float(w, ball->upper);
        put_float(w, ball->limit_hertz), put_float(w, ball->limit_damping_ratio);
        put_float(w, ball->spring_hertz), put_float(w, ball->spring_damping_ratio), put_float(w, ball->spring_max);
        put_quat(w, ball->target);
        put_vec3(w, ball->motor_velocity), put_float(w, ball->motor_max);
        put_zeros(w, 1);
        return;
    case FE_JOINT_HINGE:
        put_int(w, hinge->limit_enabled), put_float(w, hinge->lower), put_float(w, hinge->upper);
        put_float(w, hinge->limit_hertz), put_float(w, hinge->limit_damping_ratio);
        put_float(w, hinge->spring_hertz), put_float(w, hinge->spring_damping_ratio), put_float(w, hinge->spring_max);
        put_float(w, hinge->target), put_float(w, hinge->motor_speed), put_float(w, hinge->motor_max);
        put_zeros(w, 1);
        return;
    case FE_JOINT_FIXED:
        put_float(w, def->fixed.angular_hertz), put_float(w, def->fixed.angular_damping_ratio);
        return;
    default:
        for (int k = 0; k < 6; ++k) put_axis(w, &def->configurable.axes[k]);
        return;
    }
}

void fe__hash_joint_settings(fe__hash *h, int32_t type, const fe__joint_any *def)
{
    words w = {.count = 0};
    put_common(&w, &def->common);
    put_settings(&w, type, def);
    w.word[0] = (uint32_t)((size_t)w.count * sizeof *w.word);
    fe__hash_struct(h, w.word, w.word[0]);
    if (type == FE_JOINT_DISTANCE && !def->distance.limit_enabled) fe__hash_i32(h, 0);
    if (!def->common.body_a || !def->common.body_b) fe__hash_dvec3(h, def->common.world_origin);
}
