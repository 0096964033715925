// joint_scene.h - what the scenes with joints share: joints made in the frame of the scene, and what they should read.
#ifndef JOINT_SCENE_H
#define JOINT_SCENE_H

#include "scenes/mechanics.h"

// ---- bodies --------------------------------------------------------------------------------------------------------

// a static body without a shape: a place to hold on to
static inline fe_body add_anchor(scene *s, vec at)
{
    fe_body_def def;
    fe_body body;
    fe_body_def_init(&def, sizeof def);
    def.type = FE_BODY_STATIC;
    def.transform.position = to_world(s, at);
    def.transform.rotation = s->turn;
    MUST(fe_body_create(s->world, &def, &body));
    return body;
}

static inline fe_body add_plain(scene *s, fe_geometry form, vec at)
{
    return add_dynamic(s, form, at, UNTURNED, friction(0.6), WATER);
}

static inline void touch_nothing(scene *s, fe_body body) { MUST(fe_body_set_filter(s->world, body, 2, 0, 0)); }

// ---- joints, points and axes in the scene's frame ------------------------------------------------------------------

// ball_def(): the defaults, and so for each type
#define DEFAULTS(type)                                   \
    static inline fe_##type##_joint_def type##_def(void) \
    {                                                    \
        fe_##type##_joint_def d;                         \
        fe_##type##_joint_def_init(&d, sizeof d);        \
        return d;                                        \
    }
DEFAULTS(distance)
DEFAULTS(ball)
DEFAULTS(hinge)
DEFAULTS(fixed)
DEFAULTS(configurable)
#undef DEFAULTS

// add_ball(s, d, a, b, point, axis), and so for each type with an axis
#define ADDS(type)                                                                                                  \
    static inline fe_joint add_##type(scene *s, fe_##type##_joint_def d, fe_body a, fe_body b, vec point, vec axis) \
    {                                                                                                               \
        fe_joint joint;                                                                                             \
        fe_vec3 x = narrow(to_world(s, axis));                                                                      \
        vec p = to_world(s, point);                                                                                 \
        MUST(fe_##type##_joint_def_at(s->world, &d, a, b, &p, &x));                                                 \
        MUST(fe_##type##_joint_create(s->world, &d, &joint));                                                       \
        return joint;                                                                                               \
    }
ADDS(ball)
ADDS(hinge)
ADDS(configurable)
#undef ADDS

static inline fe_joint add_fixed(scene *s, fe_fixed_joint_def d, fe_body a, fe_body b, vec point)
{
    fe_joint joint;
    vec p = to_world(s, point);
    MUST(fe_fixed_joint_def_at(s->world, &d, a, b, &p));
    MUST(fe_fixed_joint_create(s->world, &d, &joint));
    return joint;
}

// between two points, as long as they are apart
static inline fe_joint add_rod(scene *s, fe_body a, fe_body b, vec from, vec to)
{
    fe_distance_joint_def d = distance_def();
    fe_joint joint;
    vec p = to_world(s, from), q = to_world(s, to);
    MUST(fe_distance_joint_def_at(s->world, &d, a, b, &p, &q));
    MUST(fe_distance_joint_create(s->world, &d, &joint));
    return joint;
}

// A rope that never gets taut. Its limit is the sweep's, and a light set of joints with it: see FE__TREE_SHORT
static inline void add_slack_rope(scene *s, fe_body a, fe_body b)
{
    fe_distance_joint_def rope = distance_def();
    fe_joint joint;
    vec p = to_world(s, position(s, a)), q = to_world(s, position(s, b));
    MUST(fe_rope_joint_def_at(s->world, &rope, a, b, &p, &q, 100));
    MUST(fe_distance_joint_create(s->world, &rope, &joint));
}

// between two points; the lengths are those of `d`
static inline fe_joint add_distance(scene *s, fe_distance_joint_def d, fe_body a, fe_body b, vec from, vec to)
{
    fe_joint joint;
    fe_distance_joint_def at = distance_def();
    vec p = to_world(s, from), q = to_world(s, to);
    MUST(fe_distance_joint_def_at(s->world, &at, a, b, &p, &q));
    d.body_a = at.body_a, d.body_b = at.body_b, d.frame_a = at.frame_a, d.frame_b = at.frame_b;
    MUST(fe_distance_joint_create(s->world, &d, &joint));
    return joint;
}

// a slider's definition: free along X
static inline fe_configurable_joint_def slider_def(void)
{
    fe_configurable_joint_def d = configurable_def();
    d.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_FREE;
    return d;
}

// ---- reading -------------------------------------------------------------------------------------------------------

static inline fe_joint_state state_of(const scene *s, fe_joint joint)
{
    fe_joint_state state = {.struct_size = sizeof state};
    MUST(fe_joint_get_state(s->world, joint, &state));
    return state;
}

static inline double gap_of(const scene *s, fe_joint joint) { return (double)state_of(s, joint).linear_error; }

static inline vec force_of(const scene *s, fe_joint joint)
{
    fe_vec3 force, torque;
    MUST(fe_joint_get_reaction(s->world, joint, &force, &torque));
    return from_world(s, widen(force));
}

static inline vec torque_of(const scene *s, fe_joint joint)
{
    fe_vec3 force, torque;
    MUST(fe_joint_get_reaction(s->world, joint, &force, &torque));
    return from_world(s, widen(torque));
}

static inline double worst_gap(const scene *s, const fe_joint *joints, int count)
{
    double worst = 0;
    for (int i = 0; i < count; ++i) worst = fmax(worst, gap_of(s, joints[i]));
    return worst;
}

// P2: a soft joint gives by load / (effective mass w^2), w = 2 pi min(60 Hz, 0.225 of the substep rate); m or rad
static inline double joint_give(const scene *s, double load, double effective_mass)
{
    double w = 2 * PI * fmin(60, 0.225 / s->h);
    return load / (effective_mass * w * w);
}

// Moment of inertia about a point `arm` from the centre, about the body's axis `local`
static inline double moment_of(const scene *s, fe_body body, int axis, double arm)
{
    fe_mass_data m = mass_data_of(s, body);
    const float moments[3] = {m.inertia.x, m.inertia.y, m.inertia.z};
    return (double)moments[axis] + (double)m.mass * arm * arm;
}

// A joint of each kind that trees may have, between two bodies
typedef enum link_kind { LINK_BALLS, LINK_HINGES, LINK_FIXTURES, LINK_RODS, LINK_SLIDERS, LINK_KINDS } link_kind;

static inline fe_joint link_bodies(scene *s, link_kind kind, fe_body a, fe_body b, vec at)
{
    switch (kind) {
    case LINK_BALLS:
        return add_ball(s, ball_def(), a, b, at, v3(0, -1, 0));
    case LINK_HINGES:
        return add_hinge(s, hinge_def(), a, b, at, v3(0, 0, 1));
    case LINK_FIXTURES:
        return add_fixed(s, fixed_def(), a, b, at);
    case LINK_RODS:
        return add_rod(s, a, b, plus(at, v3(0, 0.05, 0)), plus(at, v3(0, -0.05, 0)));
    default:
        return add_configurable(s, slider_def(), a, b, at, v3(0, 0, 1));
    }
}

#endif
