// joint_hash.c - the settings of a joint as words, for the fingerprint of a world.
//
// The order of these words is that of the first definitions of joints. It is kept apart from the structs of the API, so
// that a field more there changes no fingerprint of a world that does not use it.
#include "world/hash.h"

#include <string.h>

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

// Neither bodies nor user data: these are slots, and what is the host's
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

static void put_distance(words *w, const fe_distance_joint_def *d)
{
    put_float(w, d->lower), put_float(w, d->upper), put_float(w, d->target);
    put_float(w, d->spring_hertz), put_float(w, d->spring_damping_ratio), put_float(w, d->spring_max);
    put_float(w, d->motor_speed), put_float(w, d->motor_max);
}

static void put_ball(words *w, const fe_ball_joint_def *d)
{
    put_int(w, d->cone_enabled), put_float(w, d->cone_y), put_float(w, d->cone_z);
    put_int(w, d->limit_enabled), put_float(w, d->lower), put_float(w, d->upper);
    put_float(w, d->limit_hertz), put_float(w, d->limit_damping_ratio);
    put_float(w, d->spring_hertz), put_float(w, d->spring_damping_ratio), put_float(w, d->spring_max);
    put_quat(w, d->target);
    put_vec3(w, d->motor_velocity), put_float(w, d->motor_max);
    put_zeros(w, 1);
}

static void put_hinge(words *w, const fe_hinge_joint_def *d)
{
    put_int(w, d->limit_enabled), put_float(w, d->lower), put_float(w, d->upper);
    put_float(w, d->limit_hertz), put_float(w, d->limit_damping_ratio);
    put_float(w, d->spring_hertz), put_float(w, d->spring_damping_ratio), put_float(w, d->spring_max);
    put_float(w, d->target), put_float(w, d->motor_speed), put_float(w, d->motor_max);
    put_zeros(w, 1);
}

// A spring by stiffness puts its own pair in the place of hertz and damping ratio
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
    switch (type) {
    case FE_JOINT_DISTANCE:
        put_distance(w, &def->distance);
        return;
    case FE_JOINT_BALL:
        put_ball(w, &def->ball);
        return;
    case FE_JOINT_HINGE:
        put_hinge(w, &def->hinge);
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
