// The handles of another world are refused: by every function that takes one, with FE_ERROR_STALE, and nothing changes.
// 64 worlds have the same history, hence handles that differ in their numbers alone.
#include "fe_test.h"
#include "support/values.h"

#include <stdio.h>
#include <string.h>

enum { WORLDS = 64 };

typedef struct handles {
    fe_body body, other;
    fe_shape shape;
    fe_joint joint;
} handles;

// ---- what the calls are given beside handles -----------------------------------------------------------------------
static _Alignas(16) unsigned char room[4096];
static const fe_vec3 axis = {1.0f, 0.0f, 0.0f}, up = {0.0f, 1.0f, 0.0f};
static const fe_dvec3 point = {0.0, 1.0, 0.0};
static const fe_transform pose = {{0.0, 2.0, 0.0}, {0.0f, 0.0f, 0.0f, 1.0f}};
static const fe_frame frame = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 1.0f}};
static const fe_material surface = SURFACE(0.5f, 0.5f, 0.0f, 0.0f, 0.0f);
static fe_geometry ball;

static fe_ball_joint_def *ready_fe_ball_joint_def(void)
{
    static fe_ball_joint_def s;
    fe_ball_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_configurable_joint_def *ready_fe_configurable_joint_def(void)
{
    static fe_configurable_joint_def s;
    fe_configurable_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_distance_joint_def *ready_fe_distance_joint_def(void)
{
    static fe_distance_joint_def s;
    fe_distance_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_fixed_joint_def *ready_fe_fixed_joint_def(void)
{
    static fe_fixed_joint_def s;
    fe_fixed_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_hinge_joint_def *ready_fe_hinge_joint_def(void)
{
    static fe_hinge_joint_def s;
    fe_hinge_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_joint_def *ready_fe_joint_def(void)
{
    static fe_joint_def s;
    fe_joint_def_init(&s, sizeof s);
    return &s;
}

static fe_joint_state *ready_fe_joint_state(void)
{
    static fe_joint_state s;
    fe_joint_state_init(&s, sizeof s);
    return &s;
}

static fe_mass_data *ready_fe_mass_data(void)
{
    static fe_mass_data s;
    fe_mass_data_init(&s, sizeof s);
    return &s;
}

// ---- every function that takes a handle of a world, once for each handle that it takes -----------------------------
static int32_t call_0(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_ignore_collision(w, h->body, own->other, 1);
}
static int32_t call_1(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_ignore_collision(w, own->body, h->other, 1);
}
static int32_t call_2(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_ignored(w, h->body, own->other, (void *)room);
}
static int32_t call_3(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_ignored(w, own->body, h->other, (void *)room);
}
static int32_t call_4(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_destroy(w, h->body);
}
static int32_t call_5(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_destroy_many(w, &h->body, 1);
}
static int32_t call_6(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_is_valid(w, h->body);
}
static int32_t call_7(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_type(w, h->body, FE_BODY_DYNAMIC);
}
static int32_t call_8(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_type(w, h->body, (void *)room);
}
static int32_t call_9(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_transform(w, h->body, &pose);
}
static int32_t call_10(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_transform(w, h->body, (void *)room);
}
static int32_t call_11(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_centre(w, h->body, (void *)room);
}
static int32_t call_12(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_linear_velocity(w, h->body, &axis);
}
static int32_t call_13(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_linear_velocity(w, h->body, (void *)room);
}
static int32_t call_14(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_angular_velocity(w, h->body, &axis);
}
static int32_t call_15(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_angular_velocity(w, h->body, (void *)room);
}
static int32_t call_16(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_point_velocity(w, h->body, &point, (void *)room);
}
static int32_t call_17(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_target(w, h->body, &pose, 1);
}
static int32_t call_18(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_force(w, h->body, &axis);
}
static int32_t call_19(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_force_at(w, h->body, &axis, &point);
}
static int32_t call_20(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_torque(w, h->body, &axis);
}
static int32_t call_21(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_impulse(w, h->body, &axis);
}
static int32_t call_22(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_impulse_at(w, h->body, &axis, &point);
}
static int32_t call_23(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_add_angular_impulse(w, h->body, &axis);
}
static int32_t call_24(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_mass_data(w, h->body, ready_fe_mass_data());
}
static int32_t call_25(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_mass_data(w, h->body, ready_fe_mass_data());
}
static int32_t call_26(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_mass(w, h->body, 1);
}
static int32_t call_27(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_mass(w, h->body, (void *)room);
}
static int32_t call_28(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_reset_mass(w, h->body);
}
static int32_t call_29(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_locks(w, h->body, 1, 1);
}
static int32_t call_30(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_locks(w, h->body, (void *)room, (void *)room);
}
static int32_t call_31(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_damping(w, h->body, 1, 1);
}
static int32_t call_32(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_damping(w, h->body, (void *)room, (void *)room);
}
static int32_t call_33(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_gravity_scale(w, h->body, 1);
}
static int32_t call_34(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_gravity_scale(w, h->body, (void *)room);
}
static int32_t call_35(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_awake(w, h->body, 1);
}
static int32_t call_36(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_awake(w, h->body, (void *)room);
}
static int32_t call_37(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_sleep_allowed(w, h->body, 1);
}
static int32_t call_38(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_sleep_allowed(w, h->body, (void *)room);
}
static int32_t call_39(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_sleep_threshold(w, h->body, 1);
}
static int32_t call_40(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_sleep_threshold(w, h->body, (void *)room);
}
static int32_t call_41(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_enabled(w, h->body, 1);
}
static int32_t call_42(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_enabled(w, h->body, (void *)room);
}
static int32_t call_43(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_bullet(w, h->body, 1);
}
static int32_t call_44(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_bullet(w, h->body, (void *)room);
}
static int32_t call_45(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_user_data(w, h->body, 1);
}
static int32_t call_46(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_user_data(w, h->body, (void *)room);
}
static int32_t call_47(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_set_filter(w, h->body, 1u, 1, 1);
}
static int32_t call_48(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_filter(w, h->body, (void *)room, (void *)room, (void *)room);
}
static int32_t call_49(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_shapes(w, h->body, NULL, 0);
}
static int32_t call_50(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_bounds(w, h->body, (void *)room);
}
static int32_t call_51(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_create(w, h->body, NULL, &ball, (void *)room);
}
static int32_t call_52(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_destroy(w, h->shape);
}
static int32_t call_53(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_is_valid(w, h->shape);
}
static int32_t call_54(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_body(w, h->shape, (void *)room);
}
static int32_t call_55(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_geometry(w, h->shape, &ball);
}
static int32_t call_56(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_geometry(w, h->shape, &ball);
}
static int32_t call_57(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_frame(w, h->shape, &frame);
}
static int32_t call_58(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_frame(w, h->shape, (void *)room);
}
static int32_t call_59(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_density(w, h->shape, 1);
}
static int32_t call_60(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_density(w, h->shape, (void *)room);
}
static int32_t call_61(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_material(w, h->shape, &surface);
}
static int32_t call_62(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_material(w, h->shape, (void *)room);
}
static int32_t call_63(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_filter(w, h->shape, 1u, 1, 1);
}
static int32_t call_64(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_filter(w, h->shape, (void *)room, (void *)room, (void *)room);
}
static int32_t call_65(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_pair_filter(w, h->shape, 1);
}
static int32_t call_66(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_pair_filter(w, h->shape, (void *)room);
}
static int32_t call_67(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_one_way(w, h->shape, 1, &axis);
}
static int32_t call_68(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_one_way(w, h->shape, (void *)room, (void *)room);
}
static int32_t call_69(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_trigger(w, h->shape, 1);
}
static int32_t call_70(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_trigger(w, h->shape, (void *)room);
}
static int32_t call_71(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_events(w, h->shape, 1);
}
static int32_t call_72(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_events(w, h->shape, (void *)room);
}
static int32_t call_73(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_surface_velocity(w, h->shape, &axis);
}
static int32_t call_74(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_surface_velocity(w, h->shape, (void *)room);
}
static int32_t call_75(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_set_user_data(w, h->shape, 1);
}
static int32_t call_76(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_user_data(w, h->shape, (void *)room);
}
static int32_t call_77(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_bounds(w, h->shape, (void *)room);
}
static int32_t call_78(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_overlaps(w, h->shape, NULL, 0);
}
static int32_t call_79(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_distance_joint_def_at(w, ready_fe_distance_joint_def(), h->body, own->other, &point, &point);
}
static int32_t call_80(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_distance_joint_def_at(w, ready_fe_distance_joint_def(), own->body, h->other, &point, &point);
}
static int32_t call_81(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_ball_joint_def_at(w, ready_fe_ball_joint_def(), h->body, own->other, &point, &axis);
}
static int32_t call_82(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_ball_joint_def_at(w, ready_fe_ball_joint_def(), own->body, h->other, &point, &axis);
}
static int32_t call_83(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_hinge_joint_def_at(w, ready_fe_hinge_joint_def(), h->body, own->other, &point, &axis);
}
static int32_t call_84(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_hinge_joint_def_at(w, ready_fe_hinge_joint_def(), own->body, h->other, &point, &axis);
}
static int32_t call_85(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_fixed_joint_def_at(w, ready_fe_fixed_joint_def(), h->body, own->other, &point);
}
static int32_t call_86(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_fixed_joint_def_at(w, ready_fe_fixed_joint_def(), own->body, h->other, &point);
}
static int32_t call_87(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_configurable_joint_def_at(w, ready_fe_configurable_joint_def(), h->body, own->other, &point,
                                                 &axis);
}
static int32_t call_88(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_configurable_joint_def_at(w, ready_fe_configurable_joint_def(), own->body, h->other, &point,
                                                 &axis);
}
static int32_t call_89(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_rope_joint_def_at(w, ready_fe_distance_joint_def(), h->body, own->other, &point, &point, 1);
}
static int32_t call_90(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_rope_joint_def_at(w, ready_fe_distance_joint_def(), own->body, h->other, &point, &point, 1);
}
static int32_t call_91(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_slider_joint_def_at(w, ready_fe_configurable_joint_def(), h->body, own->other, &point, &axis);
}
static int32_t call_92(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_slider_joint_def_at(w, ready_fe_configurable_joint_def(), own->body, h->other, &point, &axis);
}
static int32_t call_93(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_wheel_joint_def_at(w, ready_fe_configurable_joint_def(), h->body, own->other, &point, &axis, &up,
                                          1, 1, 1);
}
static int32_t call_94(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_wheel_joint_def_at(w, ready_fe_configurable_joint_def(), own->body, h->other, &point, &axis, &up,
                                          1, 1, 1);
}
static int32_t call_95(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_motor_joint_def_at(w, ready_fe_configurable_joint_def(), h->body, own->other, 1, 1, 1, 1);
}
static int32_t call_96(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_motor_joint_def_at(w, ready_fe_configurable_joint_def(), own->body, h->other, 1, 1, 1, 1);
}
static int32_t call_97(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_distance_joint_set(w, h->joint, ready_fe_distance_joint_def());
}
static int32_t call_98(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_ball_joint_set(w, h->joint, ready_fe_ball_joint_def());
}
static int32_t call_99(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_hinge_joint_set(w, h->joint, ready_fe_hinge_joint_def());
}
static int32_t call_100(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_fixed_joint_set(w, h->joint, ready_fe_fixed_joint_def());
}
static int32_t call_101(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_configurable_joint_set(w, h->joint, ready_fe_configurable_joint_def());
}
static int32_t call_102(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_distance_joint_get(w, h->joint, ready_fe_distance_joint_def());
}
static int32_t call_103(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_ball_joint_get(w, h->joint, ready_fe_ball_joint_def());
}
static int32_t call_104(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_hinge_joint_get(w, h->joint, ready_fe_hinge_joint_def());
}
static int32_t call_105(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_fixed_joint_get(w, h->joint, ready_fe_fixed_joint_def());
}
static int32_t call_106(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_configurable_joint_get(w, h->joint, ready_fe_configurable_joint_def());
}
static int32_t call_107(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_destroy(w, h->joint);
}
static int32_t call_108(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_is_valid(w, h->joint);
}
static int32_t call_109(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_type(w, h->joint, (void *)room);
}
static int32_t call_110(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_bodies(w, h->joint, (void *)room, (void *)room);
}
static int32_t call_111(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_set(w, h->joint, ready_fe_joint_def());
}
static int32_t call_112(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get(w, h->joint, ready_fe_joint_def());
}
static int32_t call_113(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_set_enabled(w, h->joint, 1);
}
static int32_t call_114(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_enabled(w, h->joint, (void *)room);
}
static int32_t call_115(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_set_motor_speed(w, h->joint, FE_DOF_ANGULAR_X, 1);
}
static int32_t call_116(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_set_target(w, h->joint, FE_DOF_ANGULAR_X, 1);
}
static int32_t call_117(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_ball_joint_set_target(w, h->joint, &pose.rotation);
}
static int32_t call_118(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_set_user_data(w, h->joint, 1);
}
static int32_t call_119(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_user_data(w, h->joint, (void *)room);
}
static int32_t call_120(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_frames(w, h->joint, (void *)room, (void *)room);
}
static int32_t call_121(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_state(w, h->joint, ready_fe_joint_state());
}
static int32_t call_122(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_joint_get_reaction(w, h->joint, (void *)room, (void *)room);
}
static int32_t call_123(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_joints(w, h->body, NULL, 0);
}
static int32_t call_124(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_raycast(w, h->shape, &point, &point, (void *)room);
}
static int32_t call_125(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_raycast(w, h->body, &point, &point, (void *)room);
}
static int32_t call_126(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_closest_point(w, h->shape, &point, (void *)room);
}
static int32_t call_127(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_closest_point(w, h->body, &point, (void *)room);
}
static int32_t call_128(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_body_get_contacts(w, h->body, NULL, 0, 0);
}
static int32_t call_129(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_shape_get_contacts(w, h->shape, NULL, 0, 0);
}
static int32_t call_130(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_transforms(w, &h->body, (void *)room, 0, 1);
}
static int32_t call_131(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_set_transforms(w, &h->body, &pose, 0, 1);
}
static int32_t call_132(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_transforms_f32(w, &h->body, &point, (void *)room, 0, 1);
}
static int32_t call_133(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_velocities(w, &h->body, (void *)room, 0, 1);
}
static int32_t call_134(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_set_velocities(w, &h->body, (void *)room, 0, 1);
}
static int32_t call_135(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_add_forces(w, &h->body, (void *)room, 0, 1);
}
static int32_t call_136(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_joint_coordinates(w, &h->joint, (void *)room, 0, 1);
}
static int32_t call_137(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_get_joint_reactions(w, &h->joint, (void *)room, 0, 1);
}
static int32_t call_138(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_set_joint_targets(w, &h->joint, (void *)room, 0, 1);
}
static int32_t call_139(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_set_joint_motor_speeds(w, &h->joint, (void *)room, 0, 1);
}
static int32_t call_140(fe_world *w, const handles *own, const handles *h)
{
    (void)own;
    return (int32_t)fe_world_add_joint_forces(w, &h->joint, (void *)room, 0, 1);
}

typedef struct call {
    const char *name;
    int32_t (*run)(fe_world *w, const handles *own, const handles *h);
} call;
static const call calls[] = {
    {"fe_world_ignore_collision", call_0},
    {"fe_world_ignore_collision", call_1},
    {"fe_world_get_ignored", call_2},
    {"fe_world_get_ignored", call_3},
    {"fe_body_destroy", call_4},
    {"fe_body_destroy_many", call_5},
    {"fe_body_is_valid", call_6},
    {"fe_body_set_type", call_7},
    {"fe_body_get_type", call_8},
    {"fe_body_set_transform", call_9},
    {"fe_body_get_transform", call_10},
    {"fe_body_get_centre", call_11},
    {"fe_body_set_linear_velocity", call_12},
    {"fe_body_get_linear_velocity", call_13},
    {"fe_body_set_angular_velocity", call_14},
    {"fe_body_get_angular_velocity", call_15},
    {"fe_body_get_point_velocity", call_16},
    {"fe_body_set_target", call_17},
    {"fe_body_add_force", call_18},
    {"fe_body_add_force_at", call_19},
    {"fe_body_add_torque", call_20},
    {"fe_body_add_impulse", call_21},
    {"fe_body_add_impulse_at", call_22},
    {"fe_body_add_angular_impulse", call_23},
    {"fe_body_set_mass_data", call_24},
    {"fe_body_get_mass_data", call_25},
    {"fe_body_set_mass", call_26},
    {"fe_body_get_mass", call_27},
    {"fe_body_reset_mass", call_28},
    {"fe_body_set_locks", call_29},
    {"fe_body_get_locks", call_30},
    {"fe_body_set_damping", call_31},
    {"fe_body_get_damping", call_32},
    {"fe_body_set_gravity_scale", call_33},
    {"fe_body_get_gravity_scale", call_34},
    {"fe_body_set_awake", call_35},
    {"fe_body_get_awake", call_36},
    {"fe_body_set_sleep_allowed", call_37},
    {"fe_body_get_sleep_allowed", call_38},
    {"fe_body_set_sleep_threshold", call_39},
    {"fe_body_get_sleep_threshold", call_40},
    {"fe_body_set_enabled", call_41},
    {"fe_body_get_enabled", call_42},
    {"fe_body_set_bullet", call_43},
    {"fe_body_get_bullet", call_44},
    {"fe_body_set_user_data", call_45},
    {"fe_body_get_user_data", call_46},
    {"fe_body_set_filter", call_47},
    {"fe_body_get_filter", call_48},
    {"fe_body_get_shapes", call_49},
    {"fe_body_get_bounds", call_50},
    {"fe_shape_create", call_51},
    {"fe_shape_destroy", call_52},
    {"fe_shape_is_valid", call_53},
    {"fe_shape_get_body", call_54},
    {"fe_shape_set_geometry", call_55},
    {"fe_shape_get_geometry", call_56},
    {"fe_shape_set_frame", call_57},
    {"fe_shape_get_frame", call_58},
    {"fe_shape_set_density", call_59},
    {"fe_shape_get_density", call_60},
    {"fe_shape_set_material", call_61},
    {"fe_shape_get_material", call_62},
    {"fe_shape_set_filter", call_63},
    {"fe_shape_get_filter", call_64},
    {"fe_shape_set_pair_filter", call_65},
    {"fe_shape_get_pair_filter", call_66},
    {"fe_shape_set_one_way", call_67},
    {"fe_shape_get_one_way", call_68},
    {"fe_shape_set_trigger", call_69},
    {"fe_shape_get_trigger", call_70},
    {"fe_shape_set_events", call_71},
    {"fe_shape_get_events", call_72},
    {"fe_shape_set_surface_velocity", call_73},
    {"fe_shape_get_surface_velocity", call_74},
    {"fe_shape_set_user_data", call_75},
    {"fe_shape_get_user_data", call_76},
    {"fe_shape_get_bounds", call_77},
    {"fe_shape_get_overlaps", call_78},
    {"fe_distance_joint_def_at", call_79},
    {"fe_distance_joint_def_at", call_80},
    {"fe_ball_joint_def_at", call_81},
    {"fe_ball_joint_def_at", call_82},
    {"fe_hinge_joint_def_at", call_83},
    {"fe_hinge_joint_def_at", call_84},
    {"fe_fixed_joint_def_at", call_85},
    {"fe_fixed_joint_def_at", call_86},
    {"fe_configurable_joint_def_at", call_87},
    {"fe_configurable_joint_def_at", call_88},
    {"fe_rope_joint_def_at", call_89},
    {"fe_rope_joint_def_at", call_90},
    {"fe_slider_joint_def_at", call_91},
    {"fe_slider_joint_def_at", call_92},
    {"fe_wheel_joint_def_at", call_93},
    {"fe_wheel_joint_def_at", call_94},
    {"fe_motor_joint_def_at", call_95},
    {"fe_motor_joint_def_at", call_96},
    {"fe_distance_joint_set", call_97},
    {"fe_ball_joint_set", call_98},
    {"fe_hinge_joint_set", call_99},
    {"fe_fixed_joint_set", call_100},
    {"fe_configurable_joint_set", call_101},
    {"fe_distance_joint_get", call_102},
    {"fe_ball_joint_get", call_103},
    {"fe_hinge_joint_get", call_104},
    {"fe_fixed_joint_get", call_105},
    {"fe_configurable_joint_get", call_106},
    {"fe_joint_destroy", call_107},
    {"fe_joint_is_valid", call_108},
    {"fe_joint_get_type", call_109},
    {"fe_joint_get_bodies", call_110},
    {"fe_joint_set", call_111},
    {"fe_joint_get", call_112},
    {"fe_joint_set_enabled", call_113},
    {"fe_joint_get_enabled", call_114},
    {"fe_joint_set_motor_speed", call_115},
    {"fe_joint_set_target", call_116},
    {"fe_ball_joint_set_target", call_117},
    {"fe_joint_set_user_data", call_118},
    {"fe_joint_get_user_data", call_119},
    {"fe_joint_get_frames", call_120},
    {"fe_joint_get_state", call_121},
    {"fe_joint_get_reaction", call_122},
    {"fe_body_get_joints", call_123},
    {"fe_shape_raycast", call_124},
    {"fe_body_raycast", call_125},
    {"fe_shape_closest_point", call_126},
    {"fe_body_closest_point", call_127},
    {"fe_body_get_contacts", call_128},
    {"fe_shape_get_contacts", call_129},
    {"fe_world_get_transforms", call_130},
    {"fe_world_set_transforms", call_131},
    {"fe_world_get_transforms_f32", call_132},
    {"fe_world_get_velocities", call_133},
    {"fe_world_set_velocities", call_134},
    {"fe_world_add_forces", call_135},
    {"fe_world_get_joint_coordinates", call_136},
    {"fe_world_get_joint_reactions", call_137},
    {"fe_world_set_joint_targets", call_138},
    {"fe_world_set_joint_motor_speeds", call_139},
    {"fe_world_add_joint_forces", call_140},
};
enum { CALLS = sizeof calls / sizeof *calls };

// ---- the worlds ----------------------------------------------------------------------------------------------------
static fe_world *worlds[WORLDS];
static handles of[WORLDS];

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    assert_int_equal(fe_world_hash(world, words), FE_OK);
    return (uint64_t)words[1] << 32 | words[0];
}

static void make_world(int32_t i)
{
    handles *h = &of[i];
    fe_hinge_joint_def hinge;
    assert_int_equal(fe_world_create(NULL, &worlds[i]), FE_OK);
    assert_int_equal(fe_body_create(worlds[i], NULL, &h->body), FE_OK);
    assert_int_equal(fe_body_create(worlds[i], NULL, &h->other), FE_OK);
    assert_int_equal(fe_shape_create(worlds[i], h->body, NULL, &ball, &h->shape), FE_OK);
    fe_hinge_joint_def_init(&hinge, sizeof hinge);
    hinge.body_a = h->body, hinge.body_b = h->other;
    assert_int_equal(fe_hinge_joint_create(worlds[i], &hinge, &h->joint), FE_OK);
    assert_int_equal(fe_world_step(worlds[i], 1.0f / 60.0f), FE_OK);
}

static void every_call_refuses_the_handles_of_63_other_worlds(void **state)
{
    (void)state;
    fe_geometry_sphere(&ball, 0.5f);
    for (int32_t i = 0; i < WORLDS; ++i) make_world(i);
    for (int32_t i = 0; i < WORLDS; ++i) {
        const uint64_t before = hash_of(worlds[i]);
        assert_true(before == hash_of(worlds[0])); // numbers are no part of the hash
        for (int32_t k = 0; k < WORLDS; ++k) {
            if (k == i) continue;
            for (int32_t c = 0; c < CALLS; ++c) {
                const int32_t result = calls[c].run(worlds[i], &of[i], &of[k]);
                const size_t length = strlen(calls[c].name);
                const int32_t asks = length > 9 && strcmp(calls[c].name + length - 9, "_is_valid") == 0;
                if (result != (asks ? 0 : FE_ERROR_STALE))
                    fail_msg("call %d, %s, gave %s: %s", (int)c, calls[c].name, fe_result_name(result),
                             fe_last_error());
            }
        }
        assert_true(hash_of(worlds[i]) == before);
    }
    for (int32_t i = 0; i < WORLDS; ++i) assert_int_equal(fe_world_destroy(worlds[i]), FE_OK);
}

// ---- is any forgotten? ---------------------------------------------------------------------------------------------

// Takes a handle by value, or a const array of them
static int32_t takes_a_handle(const char *declaration)
{
    static const char *const marks[] = {"fe_body body",     "fe_body a",       "fe_body b",      "fe_body chassis",
                                        "fe_body wheel",    "fe_shape shape",  "fe_joint joint", "const fe_body *",
                                        "const fe_shape *", "const fe_joint *"};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; ++i)
        if (strstr(declaration, marks[i])) return 1;
    return 0;
}

static void the_table_holds_every_such_function_of_the_header(void **state)
{
    (void)state;
    FILE *file = fopen("include/feather.h", "r");
    char line[256], declaration[1024];
    int32_t inside = 0, found = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, "FE_API ", 7) == 0) inside = 1, declaration[0] = 0;
        if (!inside) continue;
        strcat(declaration, line);
        if (!strchr(line, ';')) continue;
        inside = 0;
        char *end = strchr(declaration, '('), *name = end;
        if (!takes_a_handle(end)) continue;
        *end = 0;
        while (name[-1] != ' ' && name[-1] != '*') --name;
        int32_t known = 0;
        for (int32_t c = 0; c < CALLS; ++c) known |= strcmp(calls[c].name, name) == 0;
        if (!known) fail_msg("%s takes a handle and is not in the table", name);
        ++found;
    }
    fclose(file);
    assert_in_range(found, 100, 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_call_refuses_the_handles_of_63_other_worlds),
                                       cmocka_unit_test(the_table_holds_every_such_function_of_the_header)};
    return cmocka_run_group_tests_name("foreign handles", tests, NULL, NULL);
}
