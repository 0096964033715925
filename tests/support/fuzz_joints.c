// fuzz_joints.c - the API of joints with arguments from the stream. See fuzz.c.
#include "support/any_joint.h"
#include "support/fuzz_state.h"

#include <math.h>
#include <string.h>

enum { AXES = 6 };

typedef union long_joint_def {
    any_def def;
    unsigned char bytes[sizeof(any_def) + FUZZ_TAIL];
} long_joint_def;

static void init(int32_t kind, long_joint_def *d)
{
    memset(d, 0, sizeof *d);
    any_init(kind, &d->def);
}

// What a game could set, so that every part of a joint is at work in some stream
static void set_sensible(fuzz *f, int32_t kind, any_def *d)
{
    uint8_t which = fuzz_byte(f);
    float size = (float)(fuzz_byte(f) % 32) / 32.0f;
    if (kind == ANY_DISTANCE)
        d->distance.lower = 0.5f * size, d->distance.upper = 0.1f + size,
        d->distance.spring_hertz = which & 1 ? 2.0f : 0.0f;
    if (kind == ANY_DISTANCE) d->distance.motor_max = which & 2 ? 50.0f : 0.0f, d->distance.motor_speed = size;
    if (kind == ANY_BALL)
        d->ball.cone_enabled = which & 1, d->ball.limit_enabled = which >> 1 & 1, d->ball.cone_y = 0.1f + size,
        d->ball.cone_z = 0.4f;
    if (kind == ANY_BALL)
        d->ball.lower = -size, d->ball.spring_hertz = which & 4 ? 3.0f : 0.0f,
        d->ball.motor_max = which & 8 ? 5.0f : 0.0f;
    if (kind == ANY_HINGE)
        d->hinge.limit_enabled = which & 1, d->hinge.lower = -size,
        d->hinge.upper = which & 16 ? 3.1415927f : 0.5f * size;
    if (kind == ANY_HINGE)
        d->hinge.spring_hertz = which & 2 ? 2.0f : 0.0f, d->hinge.motor_max = which & 4 ? 20.0f : 0.0f,
        d->hinge.motor_speed = 4.0f * size;
    if (kind == ANY_FIXED) d->fixed.angular_hertz = which & 1 ? 4.0f : 0.0f;
    for (int32_t k = 0; kind == ANY_CONFIGURABLE && k < AXES; ++k) {
        fe_joint_axis *axis = d->configurable.axes + k;
        uint8_t way = fuzz_byte(f);
        axis->motion = way % 3, axis->lower = -size, axis->upper = 0.5f * size;
        axis->spring = way / 3 % 3, axis->spring_hertz = axis->spring_stiffness = 5.0f,
        axis->spring_damping_ratio = axis->spring_damping = 1.0f, axis->target = size - 0.5f;
        if (way & 64) axis->motor_max = 10.0f, axis->motor_speed = 1.0f;
    }
}

// A definition that mostly means something, with a word of rubbish now and then
static void fill(fuzz *f, int32_t kind, long_joint_def *d)
{
    init(kind, d);
    d->def.common.frame_a.position.y = 0.5f, d->def.common.frame_b.position.y = -0.5f;
    uint8_t kind_of_rubbish = fuzz_byte(f);
    set_sensible(f, kind, &d->def);
    if (kind_of_rubbish & 1) d->def.common.hertz = fuzz_size(f), d->def.common.damping_ratio = fuzz_size(f);
    if (kind_of_rubbish & 2)
        d->def.common.frame_a.rotation = fuzz_quat(f), d->def.common.frame_b.position = fuzz_vec3(f);
    if ((kind_of_rubbish & 12) == 12)
        d->def.common.break_force = 1000.0f * fuzz_size(f), d->def.common.break_torque = 100.0f * fuzz_size(f);
    if (kind_of_rubbish & 16) d->def.common.collide_connected = fuzz_byte(f) % 3;
    if (kind_of_rubbish > 200) {
        float value = fuzz_float(f);
        int32_t number = fuzz_byte(f) - 4;
        size_t place = sizeof(fe_joint_def) / 4 + fuzz_byte(f) % ((any_sizes[kind] - sizeof(fe_joint_def)) / 4);
        memcpy(d->bytes + 4 * place, kind_of_rubbish % 2 ? (const void *)&value : (const void *)&number, 4);
    }
}

static fe_joint some_joint(fuzz *f) { return fuzz_handle(f, f->joints, f->bodies); }

int32_t fuzz_create_joint(fuzz *f)
{
    int32_t kind = fuzz_byte(f) % ANY_KINDS;
    long_joint_def d;
    fe_joint joint = 0;
    fill(f, kind, &d);
    d.def.common.body_a = fuzz_body(f), d.def.common.body_b = fuzz_body(f);
    d.def.common.struct_size = fuzz_struct_size(f, any_sizes[kind]);
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    fe_result result = any_create(kind, f->world, &d.def, &joint);
    if (result != FE_OK) return result;
    f->joints[f->joint_count++ % FUZZ_HANDLES] = joint;
    fe__hash_u64(&f->told, joint);
    return result;
}

// two bodies as they lie, held at the first one's place
int32_t fuzz_join(fuzz *f)
{
    int32_t kind = fuzz_byte(f) % ANY_KINDS;
    fe_body a = fuzz_body(f), b = fuzz_body(f);
    fe_dvec3 point = {0.0, 0.0, 0.0};
    fe_vec3 axis = {1.0f, 0.5f, -0.25f};
    fe_joint joint = 0;
    long_joint_def d;
    init(kind, &d);
    set_sensible(f, kind, &d.def);
    if (fuzz_byte(f) % 8 == 1) axis = fuzz_vec3(f), point = fuzz_dvec3(f);
    if (fe_body_is_valid(f->world, a)) point = body_transform(f->world, a).position;
    fe_result result;
    if (kind == ANY_DISTANCE)
        result = fe_rope_joint_def_at(f->world, &d.def.distance, a, b, &point, &point, fuzz_size(f));
    if (kind == ANY_BALL) result = fe_ball_joint_def_at(f->world, &d.def.ball, a, b, &point, &axis);
    if (kind == ANY_HINGE) result = fe_hinge_joint_def_at(f->world, &d.def.hinge, a, b, &point, &axis);
    if (kind == ANY_FIXED) result = fe_fixed_joint_def_at(f->world, &d.def.fixed, a, b, &point);
    if (kind == ANY_CONFIGURABLE)
        result = fe_configurable_joint_def_at(f->world, &d.def.configurable, a, b, &point, &axis);
    if (result != FE_OK) return result;
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    result = any_create(kind, f->world, &d.def, &joint);
    if (result == FE_OK) f->joints[f->joint_count++ % FUZZ_HANDLES] = joint;
    return result;
}

int32_t fuzz_set_joint(fuzz *f)
{
    fe_joint joint = some_joint(f);
    int32_t type = 0, kind = fuzz_byte(f) % ANY_KINDS;
    if (fe_joint_get_type(f->world, joint, &type) == FE_OK && fuzz_byte(f) % 8) kind = type - 1;
    long_joint_def d;
    fill(f, kind, &d);
    d.def.common.struct_size = fuzz_struct_size(f, any_sizes[kind]);
    return any_set(kind, f->world, joint, &d.def);
}

int32_t fuzz_set_joint_front(fuzz *f)
{
    fe_joint joint = some_joint(f);
    long_joint_def d;
    fill(f, ANY_FIXED, &d);
    if (fuzz_byte(f) % 2) return fe_joint_set_enabled(f->world, joint, fuzz_byte(f) % 3);
    d.def.common.enabled = fuzz_byte(f) % 3;
    d.def.common.struct_size = sizeof d.def.common;
    return fe_joint_set(f->world, joint, &d.def.common);
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
    init(ANY_CONFIGURABLE, &d);
    uint8_t which = fuzz_byte(f);
    if (which & 4) axis = fuzz_vec3(f), up = fuzz_vec3(f);
    if (fe_body_is_valid(f->world, a)) point = body_transform(f->world, a).position;
    switch (which % 4) {
    case 0:
        result = fe_slider_joint_def_at(f->world, &d.def.configurable, a, b, &point, &axis);
        break;
    case 1:
        result = fe_wheel_joint_def_at(f->world, &d.def.configurable, a, b, &point, &axis, &up, hertz, ratio, size);
        break;
    case 2:
        result = fe_motor_joint_def_at(f->world, &d.def.configurable, a, b, hertz, ratio, 100.0f * size, 10.0f * size);
        break;
    default:
        init(ANY_DISTANCE, &d);
        result = fe_distance_joint_def_at(f->world, &d.def.distance, a, b, &point, &other);
        break;
    }
    if (result != FE_OK) return result;
    fe_joint oldest = f->joints[f->joint_count % FUZZ_HANDLES];
    if (fe_joint_is_valid(f->world, oldest)) return fe_joint_destroy(f->world, oldest);
    result = any_create(which % 4 == 3 ? ANY_DISTANCE : ANY_CONFIGURABLE, f->world, &d.def, &joint);
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
    if ((body_a && !fe_body_is_valid(f->world, body_a)) || (body_b && !fe_body_is_valid(f->world, body_b)) ||
        body_a == body_b)
        fuzz_fail(f, "a joint holds a dead body");
    fe_joint_def front = {.struct_size = sizeof front};
    uint64_t data = 0;
    int32_t enabled = 0;
    if (fe_joint_get(f->world, joint, &front) || fe_joint_get_enabled(f->world, joint, &enabled) ||
        fe_joint_get_user_data(f->world, joint, &data) || enabled != front.enabled || data != front.user_data)
        fuzz_fail(f, "a joint tells two things of itself");
    init(type - 1, &d);
    if (any_get(type - 1, f->world, joint, &d.def) != FE_OK) fuzz_fail(f, "a joint's definition cannot be read");
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

// ---- many at once ---------------------------------------------------------------------------------------------------
int32_t fuzz_read_joints(fuzz *f)
{
    fuzz_span a;
    fe_joint joints[40];
    const uint8_t which = fuzz_byte(f) % 2;
    fuzz_array(f, which ? 24 : 8, &a);
    for (int32_t i = 0; i < (int32_t)(sizeof joints / sizeof *joints); ++i)
        joints[i] = i < 3 ? some_joint(f) : f->joints[i % FUZZ_HANDLES];
    if (which) return fe_world_get_joint_reactions(f->world, joints, a.data, a.stride, a.count);
    return fe_world_get_joint_coordinates(f->world, joints, a.data, a.stride, a.count);
}

int32_t fuzz_write_joints(fuzz *f)
{
    fuzz_span a;
    fe_joint joints[40];
    const uint8_t which = fuzz_byte(f) % 3;
    fuzz_fill_room(f);
    fuzz_array(f, sizeof(float), &a);
    for (int32_t i = 0; i < (int32_t)(sizeof joints / sizeof *joints); ++i)
        joints[i] = i < 3 ? some_joint(f) : f->joints[i % FUZZ_HANDLES];
    if (which == 0) return fe_world_set_joint_targets(f->world, joints, a.data, a.stride, a.count);
    if (which == 1) return fe_world_set_joint_motor_speeds(f->world, joints, a.data, a.stride, a.count);
    return fe_world_add_joint_forces(f->world, joints, a.data, a.stride, a.count);
}
