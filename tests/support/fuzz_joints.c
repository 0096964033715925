// fuzz_joints.c - the API of joints with arguments from the stream. See fuzz.c.
#include "support/fuzz_state.h"

#include <math.h>
#include <string.h>

enum { KINDS = 5, AXES = 6 };

typedef union long_joint_def {
    fe_joint_def common;
    fe_distance_def distance;
    fe_ball_def ball;
    fe_hinge_def hinge;
    fe_fixed_def fixed;
    fe_configurable_def configurable;
    unsigned char bytes[sizeof(fe_configurable_def) + FUZZ_TAIL];
} long_joint_def;

static const uint32_t sizes[KINDS] = {sizeof(fe_distance_def), sizeof(fe_ball_def), sizeof(fe_hinge_def), sizeof(fe_fixed_def),
                                      sizeof(fe_configurable_def)};

static fe_result create(fuzz *f, int32_t kind, const long_joint_def *d, fe_joint *out)
{
    switch (kind) {
    case 0:
        return fe_distance_create(f->world, &d->distance, out);
    case 1:
        return fe_ball_create(f->world, &d->ball, out);
    case 2:
        return fe_hinge_create(f->world, &d->hinge, out);
    case 3:
        return fe_fixed_create(f->world, &d->fixed, out);
    default:
        return fe_configurable_create(f->world, &d->configurable, out);
    }
}

static fe_result set(fuzz *f, int32_t kind, fe_joint joint, const long_joint_def *d)
{
    switch (kind) {
    case 0:
        return fe_distance_set(f->world, joint, &d->distance);
    case 1:
        return fe_ball_set(f->world, joint, &d->ball);
    case 2:
        return fe_hinge_set(f->world, joint, &d->hinge);
    case 3:
        return fe_fixed_set(f->world, joint, &d->fixed);
    default:
        return fe_configurable_set(f->world, joint, &d->configurable);
    }
}

static fe_result get(fuzz *f, int32_t kind, fe_joint joint, long_joint_def *d)
{
    switch (kind) {
    case 0:
        return fe_distance_get(f->world, joint, &d->distance);
    case 1:
        return fe_ball_get(f->world, joint, &d->ball);
    case 2:
        return fe_hinge_get(f->world, joint, &d->hinge);
    case 3:
        return fe_fixed_get(f->world, joint, &d->fixed);
    default:
        return fe_configurable_get(f->world, joint, &d->configurable);
    }
}

static void init(int32_t kind, long_joint_def *d)
{
    memset(d, 0, sizeof *d);
    if (kind == 0) fe_distance_def_init(&d->distance, sizes[kind]);
    if (kind == 1) fe_ball_def_init(&d->ball, sizes[kind]);
    if (kind == 2) fe_hinge_def_init(&d->hinge, sizes[kind]);
    if (kind == 3) fe_fixed_def_init(&d->fixed, sizes[kind]);
    if (kind == 4) fe_configurable_def_init(&d->configurable, sizes[kind]);
}

// What a game could set, so that every part of a joint is at work in some stream
static void set_sensible(fuzz *f, int32_t kind, long_joint_def *d)
{
    uint8_t which = fuzz_byte(f);
    float size = (float)(fuzz_byte(f) % 32) / 32.0f;
    if (kind == 0)
        d->distance.min_length = 0.5f * size, d->distance.max_length = 0.1f + size, d->distance.spring_hertz = which & 1 ? 2.0f : 0.0f;
    if (kind == 0) d->distance.motor_force = which & 2 ? 50.0f : 0.0f, d->distance.motor_speed = size;
    if (kind == 1)
        d->ball.swing_limited = which & 1, d->ball.twist_limited = which >> 1 & 1, d->ball.cone_y = 0.1f + size, d->ball.cone_z = 0.4f;
    if (kind == 1) d->ball.min_twist = -size, d->ball.drive_hertz = which & 4 ? 3.0f : 0.0f, d->ball.motor_torque = which & 8 ? 5.0f : 0.0f;
    if (kind == 2) d->hinge.limited = which & 1, d->hinge.min_angle = -size, d->hinge.max_angle = which & 16 ? 3.1415927f : 0.5f * size;
    if (kind == 2)
        d->hinge.spring_hertz = which & 2 ? 2.0f : 0.0f, d->hinge.motor_torque = which & 4 ? 20.0f : 0.0f,
        d->hinge.motor_speed = 4.0f * size;
    if (kind == 3) d->fixed.angular_hertz = which & 1 ? 4.0f : 0.0f;
    for (int32_t k = 0; kind == 4 && k < AXES; ++k) {
        fe_joint_axis *axis = d->configurable.axes + k;
        uint8_t way = fuzz_byte(f);
        axis->mode = way % 3, axis->low = -size, axis->high = 0.5f * size;
        axis->drive = way / 3 % 3, axis->stiffness = 5.0f, axis->damping = 1.0f, axis->target = size - 0.5f;
        if (way & 64) axis->motor_force = 10.0f, axis->motor_speed = 1.0f;
    }
}

// A definition that mostly means something, with a word of rubbish now and then
static void fill(fuzz *f, int32_t kind, long_joint_def *d)
{
    init(kind, d);
    d->common.frame_a.position.y = 0.5f, d->common.frame_b.position.y = -0.5f;
    uint8_t kind_of_rubbish = fuzz_byte(f);
    set_sensible(f, kind, d);
    if (kind_of_rubbish & 1) d->common.hertz = fuzz_size(f), d->common.damping_ratio = fuzz_size(f);
    if (kind_of_rubbish & 2) d->common.frame_a.rotation = fuzz_quat(f), d->common.frame_b.position = fuzz_vec3(f);
    if ((kind_of_rubbish & 12) == 12) d->common.break_force = 1000.0f * fuzz_size(f), d->common.break_torque = 100.0f * fuzz_size(f);
    if (kind_of_rubbish & 16) d->common.collide_connected = fuzz_byte(f) % 3;
    if (kind_of_rubbish > 200) {
        float value = fuzz_float(f);
        int32_t number = fuzz_byte(f) - 4;
        size_t place = sizeof(fe_joint_def) / 4 + fuzz_byte(f) % ((sizes[kind] - sizeof(fe_joint_def)) / 4);
        memcpy(d->bytes + 4 * place, kind_of_rubbish % 2 ? (const void *)&value : (const void *)&number, 4);
    }
}

static fe_joint some_joint(fuzz *f) { return fuzz_handle(f, f->joints, f->bodies); }

int32_t fuzz_create_joint(fuzz *f)
{
    int32_t kind = fuzz_byte(f) % KINDS;
    long_joint_def d;
    fe_joint joint = 0;
    fill(f, kind, &d);
    d.common.body_a = fuzz_body(f), d.common.body_b = fuzz_body(f);
    d.common.struct_size = fuzz_struct_size(f, sizes[kind]);
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    fe_result result = create(f, kind, &d, &joint);
    if (result != FE_OK) return result;
    f->joints[f->joint_count++ % FUZZ_HANDLES] = joint;
    fe__hash_u64(&f->told, joint);
    return result;
}

// two bodies as they lie, held at the first one's place
int32_t fuzz_join(fuzz *f)
{
    int32_t kind = fuzz_byte(f) % KINDS;
    fe_body a = fuzz_body(f), b = fuzz_body(f);
    fe_dvec3 point = {0.0, 0.0, 0.0};
    fe_vec3 axis = {1.0f, 0.5f, -0.25f};
    fe_joint joint = 0;
    long_joint_def d;
    init(kind, &d);
    set_sensible(f, kind, &d);
    if (fuzz_byte(f) % 8 == 1) axis = fuzz_vec3(f), point = fuzz_dvec3(f);
    if (fe_body_is_valid(f->world, a)) point = fe_body_transform(f->world, a).position;
    fe_result result;
    if (kind == 0) result = fe_rope_def_at(f->world, &d.distance, a, b, &point, &point, fuzz_size(f));
    if (kind == 1) result = fe_ball_def_at(f->world, &d.ball, a, b, &point, &axis);
    if (kind == 2) result = fe_hinge_def_at(f->world, &d.hinge, a, b, &point, &axis);
    if (kind == 3) result = fe_fixed_def_at(f->world, &d.fixed, a, b, &point);
    if (kind == 4) result = fe_configurable_def_at(f->world, &d.configurable, a, b, &point, &axis);
    if (result != FE_OK) return result;
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    result = create(f, kind, &d, &joint);
    if (result == FE_OK) f->joints[f->joint_count++ % FUZZ_HANDLES] = joint;
    return result;
}

int32_t fuzz_set_joint(fuzz *f)
{
    fe_joint joint = some_joint(f);
    int32_t type = 0, kind = fuzz_byte(f) % KINDS;
    if (fe_joint_get_type(f->world, joint, &type) == FE_OK && fuzz_byte(f) % 8) kind = type - 1;
    long_joint_def d;
    fill(f, kind, &d);
    d.common.struct_size = fuzz_struct_size(f, sizes[kind]);
    return set(f, kind, joint, &d);
}

int32_t fuzz_set_joint_front(fuzz *f)
{
    fe_joint joint = some_joint(f);
    long_joint_def d;
    fill(f, 3, &d);
    if (fuzz_byte(f) % 2) return fe_joint_set_enabled(f->world, joint, fuzz_byte(f) % 3);
    d.common.enabled = fuzz_byte(f) % 3;
    d.common.struct_size = sizeof d.common;
    return fe_joint_set(f->world, joint, &d.common);
}

// what makes whole definitions, and the joint of it
int32_t fuzz_make_joint(fuzz *f)
{
    fe_body a = fuzz_body(f), b = fuzz_body(f);
    fe_dvec3 point = {0.0, 0.0, 0.0}, other = fuzz_dvec3(f);
    fe_vec3 axis = {0.0f, 0.0f, 1.0f}, up = {0.25f, 1.0f, 0.0f};
    float hertz = fuzz_size(f), ratio = fuzz_size(f), size = fuzz_size(f);
    fe_joint joint = 0;
    fe_result result;
    long_joint_def d;
    init(4, &d);
    uint8_t which = fuzz_byte(f);
    if (which & 4) axis = fuzz_vec3(f), up = fuzz_vec3(f);
    if (fe_body_is_valid(f->world, a)) point = fe_body_transform(f->world, a).position;
    switch (which % 4) {
    case 0:
        result = fe_slider_def_at(f->world, &d.configurable, a, b, &point, &axis);
        break;
    case 1:
        result = fe_wheel_def_at(f->world, &d.configurable, a, b, &point, &axis, &up, hertz, ratio, size);
        break;
    case 2:
        result = fe_motor_def_at(f->world, &d.configurable, a, b, hertz, ratio, 100.0f * size, 10.0f * size);
        break;
    default:
        init(0, &d);
        result = fe_distance_def_at(f->world, &d.distance, a, b, &point, &other);
        break;
    }
    if (result != FE_OK) return result;
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    result = create(f, which % 4 == 3 ? 0 : 4, &d, &joint);
    if (result == FE_OK) f->joints[f->joint_count++ % FUZZ_HANDLES] = joint;
    return result;
}

int32_t fuzz_name_joint(fuzz *f) { return fe_joint_set_user_data(f->world, some_joint(f), fuzz_word(f)); }

int32_t fuzz_destroy_joint(fuzz *f) { return fe_joint_destroy(f->world, some_joint(f)); }

static void check(const fuzz *f, const float *numbers, int32_t count, const char *what)
{
    for (int32_t i = 0; i < count; ++i)
        if (!isfinite(numbers[i]) && !f->is_wild) fuzz_fail(f, what);
}

int32_t fuzz_read_joint(fuzz *f)
{
    fe_joint joint = some_joint(f);
    fe_joint_state s = {.struct_size = sizeof s};
    fe_vec3 force, torque;
    fe_transform a, b;
    fe_body body_a, body_b;
    int32_t type;
    long_joint_def d;
    fe_result result = fe_joint_get_state(f->world, joint, &s);
    if (result != FE_OK) return result;
    if (fe_joint_get_type(f->world, joint, &type) || fe_joint_get_reaction(f->world, joint, &force, &torque) ||
        fe_joint_get_frames(f->world, joint, &a, &b) || fe_joint_get_bodies(f->world, joint, &body_a, &body_b))
        fuzz_fail(f, "a living joint cannot be read");
    if (!fe_body_is_valid(f->world, body_a) || !fe_body_is_valid(f->world, body_b)) fuzz_fail(f, "a joint holds a dead body");
    fe_joint_def front = {.struct_size = sizeof front};
    fe_handle data = 0;
    int32_t enabled = 0;
    if (fe_joint_get(f->world, joint, &front) || fe_joint_get_enabled(f->world, joint, &enabled) ||
        fe_joint_get_user_data(f->world, joint, &data) || enabled != front.enabled || data != front.user_data)
        fuzz_fail(f, "a joint tells two things of itself");
    init(type - 1, &d);
    if (get(f, type - 1, joint, &d) != FE_OK) fuzz_fail(f, "a joint's definition cannot be read");
    check(f, &s.angle, (int32_t)((sizeof s - sizeof s.struct_size) / sizeof(float)), "state of a joint");
    check(f, &force.x, 3, "force of a joint");
    check(f, &torque.x, 3, "torque of a joint");
    fe__hash_vec3(&f->told, s.translation);
    fe__hash_vec3(&f->told, force);
    return FE_OK;
}

int32_t fuzz_list_joints(fuzz *f)
{
    fe_joint joints[64];
    int32_t capacity = fuzz_byte(f) % 66 - 1;
    if (capacity > 64) capacity = 64;
    fuzz_span a;
    switch (fuzz_byte(f) % 3) {
    case 0:
        return fe_world_get_joints(f->world, joints, capacity);
    case 1:
        return fe_body_get_joints(f->world, fuzz_body(f), joints, capacity);
    default:
        fuzz_array(f, sizeof(fe_joint_event), &a);
        return fe_world_get_joint_events(f->world, a.data, a.stride, a.count);
    }
}
