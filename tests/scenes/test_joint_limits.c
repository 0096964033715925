// Limits, softness and caps of joints: each parameter alone decides an outcome that mechanics predicts.
#include "scenes/joint_scene.h"

// A block about its own centre, without gravity: its inertia alone moves
typedef struct gyre {
    scene s;
    fe_body anchor, block;
    double moment[3]; // about x, y, z
    double mass;
} gyre;

static gyre begin_gyre(void **state)
{
    gyre g = {.s = scene_begin(state)};
    set_gravity(&g.s, v3(0, 0, 0));
    g.anchor = add_anchor(&g.s, v3(0, 0, 0));
    g.block = add_plain(&g.s, box(0.2, 0.25, 0.15), v3(0, 0, 0));
    for (int k = 0; k < 3; ++k) g.moment[k] = moment_of(&g.s, g.block, k, 0);
    g.mass = mass_of(&g.s, g.block);
    return g;
}

static fe_joint hinge_of(gyre *g, fe_hinge_joint_def d)
{
    fe_joint joint;
    d.body_a = g->anchor, d.body_b = g->block; // about x
    MUST(fe_hinge_joint_create(g->s.world, &d, &joint));
    return joint;
}

static fe_joint ball_of(gyre *g, fe_ball_joint_def d)
{
    fe_joint joint;
    d.body_a = g->anchor, d.body_b = g->block;
    MUST(fe_ball_joint_create(g->s.world, &d, &joint));
    return joint;
}

static fe_joint configurable_of(gyre *g, fe_configurable_joint_def d)
{
    fe_joint joint;
    d.body_a = g->anchor, d.body_b = g->block;
    MUST(fe_configurable_joint_create(g->s.world, &d, &joint));
    return joint;
}

static double square(double a) { return a * a; }
static double stiffness_of(double hertz) { return square(2 * PI * hertz); } // for a mass of 1

// ---- cone and twist ------------------------------------------------------------------------------------------------

// swing times twist
static fe_quat rotation_of(double twist, double y, double z)
{
    double swing = sqrt(y * y + z * z), k = swing > 0 ? sin(swing / 2) / swing : 0, sy = k * y, sz = k * z,
           sw = cos(swing / 2);
    double tx = sin(twist / 2), tw = cos(twist / 2);
    return (fe_quat){(float)(sw * tx), (float)(sy * tw + sz * tx), (float)(sz * tw - sy * tx), (float)(sw * tw)};
}

// pushed outwards in 16 directions, with the twist pushed against its end at 170 degrees, both ways
static void cone_and_twist_hold_together_from_every_side(void **state)
{
    const double a = 60 * DEGREES, b = 20 * DEGREES, end = 170 * DEGREES;
    for (int side = -1; side <= 1; side += 2)
        for (int k = 0; k < 16; ++k) {
            gyre g = begin_gyre(state);
            double azimuth = k * PI / 8;
            fe_ball_joint_def d = ball_def();
            fe_transform start = {{0, 0, 0}, compose(g.s.turn, rotation_of(side * 165 * DEGREES, 0, 0))};
            MUST(fe_body_set_transform(g.s.world, g.block, &start));
            d.cone_enabled = 1, d.cone_y = (float)a, d.cone_z = (float)b;
            d.limit_enabled = 1, d.lower = -(float)end, d.upper = (float)end;
            d.motor_velocity = fe_make_vec3((float)side, 2 * (float)cos(azimuth), 2 * (float)sin(azimuth));
            d.motor_max = 5;
            fe_joint joint = ball_of(&g, d);
            for (int i = 0; i < 180; ++i) {
                run(&g.s, 1);
                fe_joint_state at = state_of(&g.s, joint);
                double y = (double)at.swing_y, z = (double)at.swing_z, out = sqrt(square(y / a) + square(z / b));
                FE_WITHIN(out > 1 ? sqrt(y * y + z * z) * (1 - 1 / out) : 0, 0, 2 * DEGREES);
                FE_WITHIN(side * (double)at.angle, 100 * DEGREES, end + 1 * DEGREES);
                FE_NEAR((double)at.angular_error,
                        fmax(out > 1 ? sqrt(y * y + z * z) * (1 - 1 / out) : 0, fmax(side * (double)at.angle - end, 0)),
                        1e-4);
            }
            fe_joint_state at = state_of(&g.s, joint);
            FE_NEAR(sqrt(square((double)at.swing_y / a) + square((double)at.swing_z / b)), 1,
                    0.05); // it got there, and rests on the ellipse
            scene_end(&g.s);
        }
}

// a free twist does not turn the ellipse: Y stays Y of frame A
static void the_ellipse_does_not_turn_with_the_twist(void **state)
{
    for (int twist = -170; twist <= 170; twist += 85)
        for (int along_z = 0; along_z < 2; ++along_z) {
            gyre g = begin_gyre(state);
            fe_transform start = {{0, 0, 0}, compose(g.s.turn, rotation_of(twist * DEGREES, 0, 0))};
            MUST(fe_body_set_transform(g.s.world, g.block, &start));
            fe_mass_data cube = mass_data_of(&g.s, g.block);
            cube.inertia = fe_make_vec3(1, 1, 1); // turned about Y it turns about nothing else
            MUST(fe_body_set_mass_data(g.s.world, g.block, &cube));
            fe_ball_joint_def d = ball_def();
            d.cone_enabled = 1, d.cone_y = 1.0f, d.cone_z = 0.3f;
            d.motor_velocity = fe_make_vec3(0, along_z ? 0 : 1, along_z ? 1 : 0), d.motor_max = 5;
            fe_joint joint = ball_of(&g, d);
            run(&g.s, 120);
            fe_joint_state at = state_of(&g.s, joint);
            FE_NEAR(along_z ? at.swing_z : at.swing_y, along_z ? 0.3 : 1.0, 1 * DEGREES);
            FE_NEAR(along_z ? at.swing_y : at.swing_z, 0, 1 * DEGREES);
            FE_NEAR(at.angle, twist * DEGREES, 1 * DEGREES); // a swing along an axis twists nothing
            scene_end(&g.s);
        }
}

// Ranges that end at half a turn, on one side or on both, hold from either side against a motor and a spring that press
// on
static void ends_at_half_a_turn_hold_against_motors_and_springs(void **state)
{
    enum { BY_HINGE, BY_BALL, ABOUT_X, ABOUT_Y, ABOUT_Z, WAYS };
    for (int by = BY_HINGE; by < WAYS; ++by)
        for (int k = 0; k < 4; ++k) {
            gyre g = begin_gyre(state);
            double side = k % 2 ? 1 : -1, load = 20, most = 0;
            float other = k / 2 ? (float)PI : 0.5f, low = side < 0 ? -(float)PI : -other,
                  high = side > 0 ? (float)PI : other;
            int about = by <= BY_BALL ? 0 : by - ABOUT_X;
            fe_joint joint = 0;
            fe_hinge_joint_def hinge = hinge_def();
            fe_ball_joint_def ball = ball_def();
            fe_configurable_joint_def six = configurable_def();
            fe_joint_axis *axis = &six.axes[FE_DOF_ANGULAR_X + about];
            hinge.limit_enabled = ball.limit_enabled = 1, hinge.lower = ball.lower = low,
            hinge.upper = ball.upper = high;
            hinge.motor_speed = (float)(4 * side), hinge.motor_max = ball.motor_max = (float)load,
            ball.motor_velocity.x = (float)(4 * side);
            hinge.spring_hertz = ball.spring_hertz = 1, hinge.target = (float)(side * PI),
            ball.target = rotation_of(side * PI, 0, 0);
            axis->motion = FE_MOTION_LIMITED, axis->lower = low, axis->upper = high;
            axis->spring = FE_SPRING_HERTZ, axis->spring_hertz = axis->spring_damping_ratio = 1,
            axis->target = (float)(side * PI);
            axis->motor_speed = (float)(4 * side), axis->motor_max = (float)load;
            if (by == BY_HINGE) joint = hinge_of(&g, hinge);
            if (by == BY_BALL) joint = ball_of(&g, ball);
            if (by >= ABOUT_X) joint = configurable_of(&g, six);
            for (int i = 0; i < 240; ++i) {
                run(&g.s, 1);
                fe_joint_state at = state_of(&g.s, joint);
                const double x[3] = {(double)at.angle, (double)at.swing_y, (double)at.swing_z};
                most = fmax(most, side * x[about]);
            }
            FE_WITHIN(most, PI - 1 * DEGREES, PI + 1 * DEGREES); // it got there, and never went through
            FE_NEAR(length(spin(&g.s, g.block)), 0, 1e-3);
            FE_NEAR(state_of(&g.s, joint).angular_error, joint_give(&g.s, load, g.moment[about]),
                    0.1 * joint_give(&g.s, load, g.moment[about]));
            scene_end(&g.s);
        }
}

static void a_swing_over_half_a_turn_stays_sane(void **state)
{
    dice d = {11};
    for (int k = 0; k < 20; ++k) {
        gyre g = begin_gyre(state);
        fe_ball_joint_def ball = ball_def();
        ball.limit_enabled = k % 2, ball.lower = -1, ball.upper = 1;
        ball.cone_enabled = k / 2 % 2, ball.cone_y = 3.1f, ball.cone_z = 3.1f;
        ball.frame_a.rotation = any_rotation(&d);
        ball.frame_b.rotation = ball.frame_a.rotation;
        ball_of(&g, ball);
        set_velocity(&g.s, g.block, v3(0, 0, 0), somewhere(&d, 10));
        double before = totals_of(&g.s, &g.block, 1).energy;
        for (int i = 0; i < 300; ++i) {
            run(&g.s, 1);
            double now = totals_of(&g.s, &g.block, 1).energy;
            FE_WITHIN(now, 0, before * (1 + ENERGY_GAIN));
        }
        scene_end(&g.s);
    }
}

// ---- targets beyond limits -----------------------------------------------------------------------------------------

static void a_target_beyond_a_limit_counts_as_the_limit(void **state)
{
    gyre g = begin_gyre(state);
    fe_hinge_joint_def hinge = hinge_def();
    hinge.limit_enabled = 1, hinge.lower = -0.5f, hinge.upper = 0.25f, hinge.spring_hertz = 3, hinge.target = 2;
    fe_joint joint = hinge_of(&g, hinge);
    run(&g.s, 240);
    FE_NEAR(state_of(&g.s, joint).angle, 0.25, 1e-4);
    FE_NEAR(length(torque_of(&g.s, joint)), 0, 0.01); // nobody presses: a spring to 2 rad would press with 600 N m
    hinge.target = -2;
    MUST(fe_hinge_joint_set(g.s.world, joint, &hinge));
    run(&g.s, 240);
    FE_NEAR(state_of(&g.s, joint).angle, -0.5, 1e-4);
    scene_end(&g.s);

    g = begin_gyre(state);
    fe_ball_joint_def ball = ball_def();
    ball.cone_enabled = ball.limit_enabled = 1, ball.cone_y = 0.5f, ball.cone_z = 0.25f, ball.lower = -0.1f,
    ball.upper = 0.2f;
    ball.spring_hertz = 3, ball.target = rotation_of(1, 1, 1);
    joint = ball_of(&g, ball);
    run(&g.s, 300);
    fe_joint_state at = state_of(&g.s, joint);
    FE_NEAR(at.angle, 0.2, 1e-3);
    FE_NEAR(sqrt(square((double)at.swing_y / 0.5) + square((double)at.swing_z / 0.25)), 1, 0.01);
    FE_NEAR(length(torque_of(&g.s, joint)), 0, 0.01 * g.moment[0] * stiffness_of(3));
    scene_end(&g.s);

    g = begin_gyre(state);
    fe_configurable_joint_def slide = slider_def();
    slide.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_LIMITED, slide.axes[FE_DOF_LINEAR_X].lower = -0.1f,
    slide.axes[FE_DOF_LINEAR_X].upper = 0.3f;
    slide.axes[FE_DOF_LINEAR_X].spring = FE_SPRING_HERTZ, slide.axes[FE_DOF_LINEAR_X].spring_hertz = 3,
    slide.axes[FE_DOF_LINEAR_X].spring_damping_ratio = 1;
    slide.axes[FE_DOF_LINEAR_X].target = 5;
    joint = configurable_of(&g, slide);
    run(&g.s, 240);
    FE_NEAR(state_of(&g.s, joint).translation.x, 0.3, 1e-4);
    scene_end(&g.s);
}

// ---- softness of what is held, and of limits -----------------------------------------------------------------------

// What hangs by a joint of `hertz` sinks by g / w^2. Highly damped it creeps there as C x' = -K x, by w / (2 zeta) a
// second
static void locks_give_by_their_hertz_and_come_back_by_their_damping(void **state)
{
    for (int type = 0; type < 4; ++type)
        for (int slow = 0; slow < 2; ++slow) {
            scene s = scene_begin(state);
            fe_body anchor = add_anchor(&s, v3(0, 1, 0)), weight = add_plain(&s, box(0.2, 0.2, 0.2), v3(0, 0, 0));
            float hertz = 5, ratio = slow ? 20 : 5;
            fe_joint joint = 0;
            fe_ball_joint_def ball = ball_def();
            fe_hinge_joint_def hinge = hinge_def();
            fe_configurable_joint_def six = configurable_def();
            fe_distance_joint_def rod = distance_def();
            ball.hertz = hinge.hertz = six.hertz = rod.hertz = hertz;
            ball.damping_ratio = hinge.damping_ratio = six.damping_ratio = rod.damping_ratio = ratio;
            if (type == 0) joint = add_distance(&s, rod, anchor, weight, v3(0, 1, 0), v3(0, 0, 0));
            if (type == 1) joint = add_ball(&s, ball, anchor, weight, v3(0, 0, 0), v3(0, 1, 0));
            if (type == 2) joint = add_hinge(&s, hinge, anchor, weight, v3(0, 0, 0), v3(0, 1, 0));
            if (type == 3) joint = add_configurable(&s, six, anchor, weight, v3(0, 0, 0), v3(0, 1, 0));
            double give = G / stiffness_of((double)hertz), rate = 2 * PI * (double)hertz / (2 * (double)ratio),
                   seconds = 1 / rate;
            int steps = (int)(seconds / STEP + 0.5);
            run(&s, steps);
            FE_NEAR(gap_of(&s, joint), give * (1 - exp(-rate * steps * STEP)), 0.1 * give);
            run(&s, 20 * steps);
            FE_NEAR(gap_of(&s, joint), give, 0.02 * give);
            scene_end(&s);
        }
}

// little damped they swing
static void soft_joints_swing(void **state)
{
    for (int k = 0; k < 4; ++k) {
        int bouncy = k % 2, is_ball = k / 2;
        scene s = scene_begin(state);
        fe_body anchor = add_anchor(&s, v3(0, 1, 0)), weight = add_plain(&s, box(0.2, 0.2, 0.2), v3(0, 0, 0));
        fe_fixed_joint_def d = fixed_def();
        d.hertz = 5, d.damping_ratio = bouncy ? 0.1f : 1.5f;
        fe_ball_joint_def ball = ball_def();
        ball.hertz = d.hertz, ball.damping_ratio = d.damping_ratio;
        fe_joint joint = is_ball ? add_ball(&s, ball, anchor, weight, v3(0, 0, 0), v3(0, 1, 0))
                                 : add_fixed(&s, d, anchor, weight, v3(0, 0, 0));
        double give = G / stiffness_of(5), most = 0;
        for (int i = 0; i < 600; ++i) {
            run(&s, 1);
            most = fmax(most, -(double)position(&s, weight).y);
        }
        FE_NEAR(-position(&s, weight).y, give, 0.02 * give);
        FE_NEAR(gap_of(&s, joint), give, 0.02 * give);
        // a sudden load on a spring of damping 0.1 overshoots by exp(-pi 0.1 / sqrt(1 - 0.01)) = 0.73, with the damping
        // of the scheme, pi f h, 0.66
        if (bouncy)
            FE_WITHIN(most, 1.55 * give, 1.75 * give);
        else
            FE_WITHIN(most, 0.98 * give, 1.02 * give);
        scene_end(&s);
    }
}

static void hertz_of_a_fixed_joints_rotation_are_its_own(void **state)
{
    for (int k = 0; k < 2; ++k) {
        gyre g = begin_gyre(state);
        fe_fixed_joint_def d = fixed_def();
        d.angular_hertz = k ? 4.0f : 2.0f;
        fe_joint joint = add_fixed(&g.s, d, g.anchor, g.block, v3(0, 0, 0));
        double torque = 10, give = torque / (g.moment[0] * stiffness_of((double)d.angular_hertz));
        for (int i = 0; i < 300; ++i) {
            add_torque(&g.s, g.block, v3(torque, 0, 0));
            run(&g.s, 1);
        }
        FE_NEAR(state_of(&g.s, joint).angle, give, 0.03 * give);
        scene_end(&g.s);
    }
}

// pressed onto a soft end: gives by load / (I w^2), and creeps there
static void limits_give_by_their_hertz_and_come_back_by_their_damping(void **state)
{
    for (int where = 0; where < 4; ++where)
        for (int slow = 0; slow < 2; ++slow) {
            gyre g = begin_gyre(state);
            float hertz = 4, ratio = slow ? 20 : 5;
            double load = 20, x = 0, inertia = g.moment[0];
            fe_hinge_joint_def hinge = hinge_def();
            fe_ball_joint_def ball = ball_def();
            fe_configurable_joint_def slide = slider_def();
            fe_joint joint = 0;
            hinge.limit_enabled = 1, hinge.lower = -0.01f, hinge.upper = 0, hinge.limit_hertz = hertz,
            hinge.limit_damping_ratio = ratio;
            ball.limit_enabled = 1, ball.lower = -0.01f, ball.upper = 0;
            ball.limit_hertz = hertz, ball.limit_damping_ratio = ratio;
            slide.axes[0].motion = FE_MOTION_LIMITED, slide.axes[0].lower = -0.01f, slide.axes[0].upper = 0;
            slide.axes[0].limit_hertz = hertz, slide.axes[0].limit_damping_ratio = ratio;
            if (where == 0) joint = hinge_of(&g, hinge);
            if (where == 1) joint = ball_of(&g, ball);
            if (where == 2) joint = configurable_of(&g, slide), inertia = g.mass;
            if (where == 3) { // the cone, from its border on
                fe_transform start = {{0, 0, 0}, compose(g.s.turn, rotation_of(0, 0.5, 0))};
                MUST(fe_body_set_transform(g.s.world, g.block, &start));
                ball.limit_enabled = 0, ball.cone_enabled = 1, ball.cone_y = ball.cone_z = 0.5f;
                joint = ball_of(&g, ball), inertia = g.moment[1];
            }
            double give = load / (inertia * stiffness_of((double)hertz)),
                   rate = 2 * PI * (double)hertz / (2 * (double)ratio);
            int steps = (int)(1 / (rate * STEP) + 0.5);
            for (int i = 0; i < 20 * steps; ++i) {
                vec push = where == 3 ? v3(0, load, 0) : v3(load, 0, 0);
                if (where == 2)
                    add_force(&g.s, g.block, push);
                else
                    add_torque(&g.s, g.block, push);
                run(&g.s, 1);
                fe_joint_state at = state_of(&g.s, joint);
                x = where == 2 ? (double)at.translation.x : where == 3 ? (double)at.swing_y - 0.5 : (double)at.angle;
                if (i + 1 == steps) FE_NEAR(x, give * (1 - exp(-rate * steps * STEP)), 0.1 * give);
            }
            FE_NEAR(x, give, 0.02 * give);
            scene_end(&g.s);
        }
}

// ---- caps ----------------------------------------------------------------------------------------------------------

// A constant push against a spring: below the cap it rests at push / stiffness, above it runs away with what the cap
// leaves
static void a_spring_pushes_up_to_its_cap(void **state)
{
    for (int where = 0; where < 5; ++where)
        for (int enough = 0; enough < 2; ++enough) {
            gyre g = begin_gyre(state);
            double load = 10, inertia = g.moment[0], seconds = 1.0, x = 0;
            float cap = enough ? 15 : 6;
            fe_hinge_joint_def hinge = hinge_def();
            fe_ball_joint_def ball = ball_def();
            fe_configurable_joint_def slide = slider_def(), six = configurable_def();
            fe_distance_joint_def rope = distance_def();
            fe_joint joint = 0;
            hinge.spring_hertz = 2, hinge.spring_max = cap;
            ball.spring_hertz = 2, ball.spring_max = cap;
            slide.axes[0].spring = FE_SPRING_HERTZ, slide.axes[0].spring_hertz = 2,
            slide.axes[0].spring_damping_ratio = 1, slide.axes[0].spring_max = cap;
            rope.lower = 0, rope.upper = 100, rope.target = 2, rope.spring_hertz = 2, rope.spring_max = cap;
            for (int k = 3; k < 6; ++k) six.axes[k] = slide.axes[0];
            if (where == 0) joint = hinge_of(&g, hinge);
            if (where == 1) joint = ball_of(&g, ball);
            if (where == 2) joint = configurable_of(&g, slide), inertia = g.mass;
            if (where == 3) joint = configurable_of(&g, six);
            if (where == 4)
                joint = add_distance(&g.s, rope, g.anchor, g.block, v3(-2, 0, 0), v3(0, 0, 0)), inertia = g.mass;
            int is_linear = where == 2 || where == 4, steps = enough ? 300 : 60;
            for (int i = 0; i < steps; ++i) {
                if (is_linear)
                    add_force(&g.s, g.block, v3(load, 0, 0));
                else
                    add_torque(&g.s, g.block, v3(load, 0, 0));
                run(&g.s, 1);
            }
            fe_joint_state at = state_of(&g.s, joint);
            x = where == 2 ? (double)at.translation.x : where == 4 ? (double)at.length - 2 : (double)at.angle;
            double give = load / (inertia * stiffness_of(2));
            if (enough) {
                FE_NEAR(x, give, 0.02 * give);
            } else {
                // once beyond cap / stiffness it accelerates by (load - cap) / inertia; before, by more
                double v = is_linear ? length(velocity(&g.s, g.block)) : length(spin(&g.s, g.block));
                FE_WITHIN(v, (load - (double)cap) * seconds / inertia, load * seconds / inertia);
                FE_NEAR(length(is_linear ? force_of(&g.s, joint) : torque_of(&g.s, joint)), (double)cap,
                        0.01 * (double)cap);
            }
            scene_end(&g.s);
        }
}

// A motor of speed 0 is friction: it holds what is below its cap and brakes what is above
static void a_motor_holds_up_to_its_cap_and_runs_at_its_speed(void **state)
{
    for (int where = 0; where < 4; ++where)
        for (int enough = 0; enough < 2; ++enough) {
            gyre g = begin_gyre(state);
            float cap = enough ? 60 : 6, speed = enough ? 1.5f : 0; // the heaviest, 60 kg, has its speed after 2 s
            double load = 10, inertia = g.moment[0];
            fe_hinge_joint_def hinge = hinge_def();
            fe_ball_joint_def ball = ball_def();
            fe_configurable_joint_def slide = slider_def();
            fe_distance_joint_def rope = distance_def();
            fe_joint joint = 0;
            hinge.motor_speed = speed, hinge.motor_max = cap;
            ball.motor_velocity.x = speed, ball.motor_max = cap;
            slide.axes[0].motor_speed = speed, slide.axes[0].motor_max = cap;
            rope.lower = 0, rope.upper = 100, rope.motor_speed = speed, rope.motor_max = cap;
            if (where == 0) joint = hinge_of(&g, hinge);
            if (where == 1) joint = ball_of(&g, ball);
            if (where == 2) joint = configurable_of(&g, slide), inertia = g.mass;
            if (where == 3)
                joint = add_distance(&g.s, rope, g.anchor, g.block, v3(-2, 0, 0), v3(0, 0, 0)), inertia = g.mass;
            int is_linear = where >= 2, steps = enough ? 600 : 60;
            for (int i = 0; i < steps; ++i) {
                if (is_linear)
                    add_force(&g.s, g.block, v3(-load, 0, 0));
                else
                    add_torque(&g.s, g.block, v3(-load, 0, 0));
                run(&g.s, 1);
            }
            double v = is_linear ? velocity(&g.s, g.block).x : spin(&g.s, g.block).x;
            if (enough)
                FE_NEAR(v, (double)speed, 0.005 * (double)speed);
            else
                FE_NEAR(v, -(load - (double)cap) / inertia, 0.01 * load / inertia);
            fe_vec3 force, torque;
            MUST(fe_joint_get_reaction(g.s.world, joint, &force, &torque));
            FE_NEAR(is_linear ? force_of(&g.s, joint).x : torque_of(&g.s, joint).x, enough ? load : (double)cap,
                    0.01 * load);
            scene_end(&g.s);
        }
}

static void each_axis_of_a_configurable_joint_has_its_own_drive_and_motor(void **state)
{
    for (int k = 0; k < 6; ++k)
        for (int by_motor = 0; by_motor < 2; ++by_motor) {
            gyre g = begin_gyre(state);
            fe_configurable_joint_def six = configurable_def();
            for (int i = 0; i < 6; ++i) six.axes[i].motion = FE_MOTION_FREE;
            fe_joint_axis *axis = &six.axes[k];
            if (by_motor)
                axis->motor_speed = 0.25f, axis->motor_max = 1e4f;
            else
                axis->spring = FE_SPRING_HERTZ, axis->spring_hertz = 3, axis->spring_damping_ratio = 1,
                axis->target = 0.5f;
            fe_joint joint = configurable_of(&g, six);
            run(&g.s, 240);
            fe_joint_state at = state_of(&g.s, joint);
            const double x[6] = {(double)at.translation.x, (double)at.translation.y, (double)at.translation.z,
                                 (double)at.angle,         (double)at.swing_y,       (double)at.swing_z};
            for (int i = 0; i < 6; ++i) FE_NEAR(x[i], i == k ? (by_motor ? 0.25 * 4 : 0.5) : 0, 0.01);
            scene_end(&g.s);
        }
}

static void a_motor_moves_to_a_pose_and_holds_it_within_its_caps(void **state)
{
    scene s = scene_begin(state);
    fe_body base = add_anchor(&s, v3(0, 0, 0)), tool = add_plain(&s, box(0.2, 0.1, 0.1), v3(1, 0, 0));
    fe_configurable_joint_def d = configurable_def();
    fe_joint joint;
    double weight = mass_of(&s, tool) * G;
    MUST(fe_motor_joint_def_at(s.world, &d, base, tool, 4, 1, (float)(3 * weight), 100));
    d.axes[FE_DOF_LINEAR_X].target = 0.5f, d.axes[FE_DOF_LINEAR_Z].target = -0.25f;
    d.axes[FE_DOF_ANGULAR_X].target = 1.5f, d.axes[FE_DOF_ANGULAR_Y].target = 1.0f;
    MUST(fe_configurable_joint_create(s.world, &d, &joint));
    run(&s, 300);
    fe_joint_state at = state_of(&s, joint);
    FE_NEAR(at.translation.x, 0.5, 1e-3), FE_NEAR(at.translation.z, -0.25, 1e-3);
    FE_NEAR(at.translation.y, -G / stiffness_of(4), 0.02 * G / stiffness_of(4)); // sags as a spring does
    FE_NEAR(at.angle, 1.5, 1e-3), FE_NEAR(at.swing_y, 1.0, 1e-3), FE_NEAR(at.swing_z, 0, 1e-3);
    FE_NEAR(force_of(&s, joint).y, weight, 0.01 * weight);
    scene_end(&s);
}

// ---- locked bodies -------------------------------------------------------------------------------------------------

// the axes that are free move to their limits, those that are locked stay; limits of locked ones do no harm
static void limits_hold_bodies_with_locked_axes(void **state)
{
    for (uint32_t axis = 0; axis < 3; ++axis) {
        gyre g = begin_gyre(state);
        MUST(fe_body_set_locks(g.s.world, g.block, FE_AXIS_ALL, FE_AXIS_ALL & ~(1u << axis)));
        fe_ball_joint_def d = ball_def();
        d.cone_enabled = d.limit_enabled = 1, d.cone_y = 0.5f, d.cone_z = 0.25f, d.lower = -0.125f, d.upper = 0.75f;
        fe_joint joint = ball_of(&g, d);
        double torque[3] = {0, 0, 0};
        torque[axis] = 10;
        for (int i = 0; i < 240; ++i) {
            add_torque(&g.s, g.block, v3(torque[0], torque[1], torque[2]));
            run(&g.s, 1);
        }
        fe_joint_state at = state_of(&g.s, joint);
        const double x[3] = {(double)at.angle, (double)at.swing_y, (double)at.swing_z}, stop[3] = {0.75, 0.5, 0.25};
        for (uint32_t k = 0; k < 3; ++k)
            FE_NEAR(x[k], k == axis ? stop[k] + joint_give(&g.s, 10, g.moment[k]) : 0, 1e-4);
        scene_end(&g.s);
    }
}

// the one rotation that is left turns round and round, whichever it is
static void a_single_free_rotation_is_a_hinge_about_its_axis(void **state)
{
    for (int k = 0; k < 3; ++k)
        for (int limited = 0; limited < 2; ++limited) {
            gyre g = begin_gyre(state);
            fe_configurable_joint_def d = configurable_def();
            fe_joint_axis *axis = &d.axes[FE_DOF_ANGULAR_X + k];
            axis->motion = limited ? FE_MOTION_LIMITED : FE_MOTION_FREE, axis->lower = -1, axis->upper = (float)PI;
            d.axes[FE_DOF_LINEAR_X + k].motion = FE_MOTION_LIMITED, d.axes[FE_DOF_LINEAR_X + k].lower = -0.5f,
                                     d.axes[FE_DOF_LINEAR_X + k].upper = 0.5f;
            fe_joint joint = configurable_of(&g, d);
            vec along = v3(k == 0, k == 1, k == 2);
            set_velocity(&g.s, g.block, times(0.25, along), times(5, along));
            double before = totals_of(&g.s, &g.block, 1).energy;
            for (int i = 0; i < 60; ++i) {
                run(&g.s, 1);
                FE_WITHIN(totals_of(&g.s, &g.block, 1).energy, 0, before * (1 + ENERGY_GAIN));
                FE_WITHIN(state_of(&g.s, joint).angular_error, 0, 1 * DEGREES);
            }
            fe_joint_state at = state_of(&g.s, joint);
            const double moved[3] = {(double)at.translation.x, (double)at.translation.y, (double)at.translation.z},
                         turned_by[3] = {(double)at.angle, (double)at.swing_y, (double)at.swing_z};
            for (int i = 0; i < 3; ++i) FE_NEAR(moved[i], i == k ? 0.25 : 0, 1e-4);
            for (int i = 0; i < 3; ++i) FE_NEAR(turned_by[i], i != k ? 0 : limited ? PI : 5 - 2 * PI, 0.005);
            scene_end(&g.s);
        }
}

// two left over: they bump against the ends of what their angles can tell, and gain nothing by it
static void a_cardan_joint_gains_no_energy(void **state)
{
    for (uint32_t locked = 0; locked < 3; ++locked)
        for (uint64_t seed = 1; seed <= 8; ++seed) {
            gyre g = begin_gyre(state);
            dice d = {seed};
            fe_configurable_joint_def six = configurable_def();
            for (uint32_t k = 0; k < 3; ++k)
                if (k != locked) six.axes[FE_DOF_ANGULAR_X + k].motion = FE_MOTION_FREE;
            configurable_of(&g, six);
            set_velocity(&g.s, g.block, v3(0, 0, 0), somewhere(&d, 8));
            run(&g.s, 1); // the spin about the locked axis is gone
            double before = totals_of(&g.s, &g.block, 1).energy;
            for (int i = 0; i < 300; ++i) {
                run(&g.s, 1);
                FE_WITHIN(totals_of(&g.s, &g.block, 1).energy, 0, before * 1.01);
            }
            scene_end(&g.s);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(cone_and_twist_hold_together_from_every_side),
        TEST(the_ellipse_does_not_turn_with_the_twist),
        TEST(ends_at_half_a_turn_hold_against_motors_and_springs),
        TEST(a_swing_over_half_a_turn_stays_sane),
        TEST(a_target_beyond_a_limit_counts_as_the_limit),
        EVERY_WAY_UP(locks_give_by_their_hertz_and_come_back_by_their_damping),
        EVERY_WAY_UP(soft_joints_swing),
        TEST(hertz_of_a_fixed_joints_rotation_are_its_own),
        TEST(limits_give_by_their_hertz_and_come_back_by_their_damping),
        TEST(a_spring_pushes_up_to_its_cap),
        TEST(a_motor_holds_up_to_its_cap_and_runs_at_its_speed),
        TEST(each_axis_of_a_configurable_joint_has_its_own_drive_and_motor),
        EVERY_WAY_UP(a_motor_moves_to_a_pose_and_holds_it_within_its_caps),
        TEST(limits_hold_bodies_with_locked_axes),
        TEST(a_single_free_rotation_is_a_hinge_about_its_axis),
        TEST(a_cardan_joint_gains_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
