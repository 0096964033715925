// Laws of joints on random scenes: no joint adds energy; momentum and angular momentum are kept in free flight;
// ragdolls come together again.
#include "../../examples/machines.h"
#include "scenes/joint_scene.h"

enum { MOST_BODIES = 12 };

typedef struct crowd {
    scene s;
    fe_body bodies[MOST_BODIES];
    fe_joint joints[MOST_BODIES];
    int count, joint_count;
} crowd;

static fe_joint join_somehow(scene *s, dice *d, fe_body a, fe_body b, vec point, int limited)
{
    vec axis = somewhere(d, 1);
    fe_ball_joint_def ball = ball_def();
    fe_hinge_joint_def hinge = hinge_def();
    fe_configurable_joint_def six = configurable_def();
    fe_distance_joint_def rope = distance_def();
    int kind = pick(d, 6);
    axis.x += 2;
    if (limited) {
        ball.cone_enabled = pick(d, 2), ball.limit_enabled = pick(d, 2);
        ball.cone_y = (float)uniform(d, 0.2, 2), ball.cone_z = (float)uniform(d, 0.2, 2),
        ball.lower = -(float)uniform(d, 0, 2), ball.upper = (float)uniform(d, 0, 2);
        hinge.limit_enabled = 1, hinge.lower = -(float)uniform(d, 0, 2), hinge.upper = (float)uniform(d, 0, 3.14);
    }
    for (int k = 0; k < 6; ++k) {
        six.axes[k].motion = k < FE_DOF_ANGULAR_X ? pick(d, 2)
                             : limited            ? pick(d, 3)
                                                  : 2 * pick(d, 2); // what slides away for ever is no machine
        six.axes[k].lower = -(float)uniform(d, 0, 0.5), six.axes[k].upper = (float)uniform(d, 0, 0.5);
    }
    rope.lower = 0, rope.upper = 1e-3f + (float)length(minus(position(s, a), position(s, b)));
    if (kind == 0) return add_ball(s, ball, a, b, point, axis);
    if (kind == 1) return add_hinge(s, hinge, a, b, point, axis);
    if (kind == 2) return add_fixed(s, fixed_def(), a, b, point);
    if (kind == 3) return add_configurable(s, six, a, b, point, axis);
    if (kind == 4) return add_distance(s, rope, a, b, position(s, a), position(s, b));
    return add_rod(s, a, b, point, position(s, b));
}

// A tree of bodies; nothing touches
static crowd make_crowd(dice *d, int limited, int anchored)
{
    crowd c = {.s = scene_begin(NULL), .count = 3 + pick(d, MOST_BODIES - 4)};
    if (!anchored) set_gravity(&c.s, v3(0, 0, 0));
    for (int i = 0; i < c.count; ++i) {
        vec at = v3(uniform(d, -0.3, 0.3), -0.5 * i, uniform(d, -0.3, 0.3));
        c.bodies[i] = add_dynamic(&c.s, any_form(d, uniform(d, 0.7, 1)), at, any_rotation(d), friction(0), WATER);
        MUST(fe_body_set_filter(c.s.world, c.bodies[i], 2, 0, 0));
        set_velocity(&c.s, c.bodies[i], somewhere(d, 2), somewhere(d, 3));
        fe_body parent = i ? c.bodies[i - 1 - pick(d, i < 2 ? 1 : 2)] : add_anchor(&c.s, at);
        vec middle = times(0.5, plus(at, position(&c.s, parent)));
        if (!i && !anchored) continue;
        c.joints[c.joint_count++] =
            join_somehow(&c.s, d, parent, c.bodies[i], plus(middle, somewhere(d, 0.1)), limited);
    }
    return c;
}

// What gaps and angles hold as springs is energy that comes back: on the masses of both ends, w = 2 pi 60 Hz. Bounded
// from above by the heavier body's mass and inertia, because a joint on the bodies' whole is never stiffer than on one
// of them
static double stored_in(const crowd *c)
{
    double w = 2 * PI * 60, sum = 0;
    for (int i = 0; i < c->joint_count; ++i) {
        fe_joint_state at = state_of(&c->s, c->joints[i]);
        fe_body a, b;
        MUST(fe_joint_get_bodies(c->s.world, c->joints[i], &a, &b));
        double mass = 0, moment = 0;
        for (int k = 0; k < 2; ++k) {
            fe_mass_data x = mass_data_of(&c->s, k ? b : a);
            mass = fmax(mass, (double)x.mass);
            moment = fmax(moment, fmax((double)x.inertia.x, fmax((double)x.inertia.y, (double)x.inertia.z)));
        }
        sum += 0.5 * w * w *
               (mass * (double)(at.linear_error * at.linear_error) +
                moment * (double)(at.angular_error * at.angular_error));
    }
    return sum;
}

// ---- energy --------------------------------------------------------------------------------------------------------

#if SLOW_BUILD
enum { SCENES = 6, STEPS = 120, THROWS = 2, DROPS = 2 };
#else
enum { SCENES = 60, STEPS = 300, THROWS = 200, DROPS = 40 };
#endif

static void no_joint_adds_energy(void **state)
{
    (void)state;
    for (int limited = 0; limited < 2; ++limited)
        for (uint64_t seed = 1; seed <= SCENES / 2; ++seed) {
            dice d = {seed * 77 + (uint64_t)limited};
            crowd c = make_crowd(&d, limited, 1);
            double mass = 0;
            for (int i = 0; i < c.count; ++i) mass += mass_of(&c.s, c.bodies[i]);
            // the first substeps give the bodies velocities that fit their joints
            totals start = totals_of(&c.s, c.bodies, c.count);
            for (int i = 0; i < STEPS; ++i) {
                run(&c.s, 1);
                totals now = totals_of(&c.s, c.bodies, c.count);
                double share =
                    0.5 * c.s.h * G * sqrt(2 * now.kinetic * mass); // of the scheme, exact in free flight only
                FE_WITHIN(now.energy, -1e12, start.energy + share + 1e-5 * start.kinetic);
                FE_WITHIN(stored_in(&c), 0, 1e12);
            }
            scene_end(&c.s);
        }
}

// Bodies of 1 : 100 that are all locked in the same axes, whatever these are: they come to poses from which hardly any
// way leads on. What they lose there may be lost; what gaps hold comes back
static void bodies_locked_alike_gain_no_energy(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; ++seed) {
        dice d = {seed * 7919};
        crowd c = make_crowd(&d, 0, 0);
        const uint32_t linear = (uint32_t)pick(&d, 8), angular = (uint32_t)pick(&d, 8);
        double least = 1e30;
        for (int i = 0; i < c.count; ++i) {
            MUST(fe_body_set_mass(c.s.world, c.bodies[i],
                                  (float)(mass_of(&c.s, c.bodies[i]) * pow(100, uniform(&d, 0, 1)))));
            MUST(fe_body_set_locks(c.s.world, c.bodies[i], linear, angular));
        }
        for (int i = 0; i < STEPS; ++i) {
            const double before = totals_of(&c.s, c.bodies, c.count).kinetic;
            least = fmin(least, before + stored_in(&c));
            run(&c.s, 1);
            FE_WITHIN(totals_of(&c.s, c.bodies, c.count).kinetic, 0, 1.005 * least + 1e-6);
        }
        scene_end(&c.s);
    }
}

// ---- impacts -------------------------------------------------------------------------------------------------------
static fe_joint join_with_limits(scene *s, dice *d, fe_body a, fe_body b, vec point)
{
    const int kind = pick(d, 3);
    fe_ball_joint_def ball = ball_def();
    fe_hinge_joint_def hinge = hinge_def();
    ball.cone_enabled = ball.limit_enabled = hinge.limit_enabled = 1;
    ball.cone_y = ball.cone_z = (float)uniform(d, 0.1, 1.5), ball.lower = -0.3f, ball.upper = 0.3f;
    hinge.lower = -(float)uniform(d, 0, 1), hinge.upper = (float)uniform(d, 0, 1);
    const vec axis = plus(v3(2, 0, 0), somewhere(d, 1));
    if (kind == 0) return add_ball(s, ball, a, b, point, axis);
    return kind == 1 ? add_hinge(s, hinge, a, b, point, axis) : add_fixed(s, fixed_def(), a, b, point);
}

// Shot at a wall of 4 cm: a branching chain, bodies of up to 1 : 3 in size and 1 : 100 in density, joints with limits
// halfway between their bodies, so that light links have long arms
static crowd make_lash(dice *d)
{
    crowd c = {.s = scene_begin(NULL), .count = 3 + pick(d, MOST_BODIES - 2)};
    const double size = uniform(d, 0.1, 0.4);
    const vec along = v3(uniform(d, 20, 200), uniform(d, -5, 5), uniform(d, -3, 3));
    set_gravity(&c.s, v3(0, 0, 0));
    add_static(&c.s, box(0.02, 20, 20), v3(2 * size * c.count + 1, 0, 0), UNTURNED, friction(0.6));
    for (int i = 0; i < c.count; ++i) {
        vec at = v3(2 * size * i, uniform(d, -0.1, 0.1), 0);
        fe_geometry form = any_form(d, size * uniform(d, 0.3, 1));
        const double weight = uniform(d, 0.3, 3.2);
        c.bodies[i] = add_dynamic(&c.s, form, at, any_rotation(d), friction(0.6), (float)(WATER * weight * weight));
        set_velocity(&c.s, c.bodies[i], along, somewhere(d, 3));
        if (!i) continue;
        fe_body parent = c.bodies[pick(d, 3) ? i - 1 : pick(d, i)];
        vec middle = times(0.5, plus(at, position(&c.s, parent)));
        c.joints[c.joint_count++] = join_with_limits(&c.s, d, parent, c.bodies[i], middle);
    }
    return c;
}

// Known limit: one group in eighty gains. What warm starts gave a light link between two heavy ones has to be taken
// back from a tree that has turned on by radians; 44 of the 200 gained while trees that turn fast kept them, 15 of them
// while no motion was too fast for a substep
static void heavy_chains_gain_no_energy_at_a_wall(void **state)
{
    (void)state;
    enum { GROUPS = SLOW_BUILD ? 20 : 200, MAY_GAIN = 2 };
    int gained = 0;
    for (uint64_t k = 0; k < GROUPS; ++k) {
        dice d = {k * 104729};
        crowd c = make_lash(&d);
        const double start = totals_of(&c.s, c.bodies, c.count).kinetic;
        double most = 0;
        for (int i = 0; i < 60; ++i) {
            run(&c.s, 1);
            most = fmax(most, totals_of(&c.s, c.bodies, c.count).kinetic);
        }
        gained += most > 1.1 * start;
        scene_end(&c.s);
    }
    FE_WITHIN(gained, 0, MAY_GAIN);
}

// Three boxes on two ball joints in free space; the last, a tenth of their size, turns about its joint by radians in a
// substep. What no substep can follow is lost, its momentum is not
static void what_turns_too_fast_keeps_its_momentum(void **state)
{
    (void)state;
    enum { LINKS = 3, ALLOWED_ROUNDINGS = 64 };
    const double rounding = ALLOWED_ROUNDINGS * 6e-8, arm = 0.1;
    for (double rate = 500; rate < 5000; rate *= 2) {
        scene s = scene_begin(NULL);
        set_gravity(&s, v3(0, 0, 0));
        fe_body b[LINKS];
        for (int i = 0; i < LINKS; ++i) {
            const int last = i == LINKS - 1;
            const double half = last ? 0.05 : 0.5;
            b[i] = add_dynamic(&s, box(half, half, half), v3(last ? 1.5 + arm : i, 0, 0), UNTURNED, friction(0), WATER);
            MUST(fe_body_set_filter(s.world, b[i], 2, 0, 0));
            set_velocity(&s, b[i], v3(1, last ? rate * arm : 0, 3), v3(0, 0, last ? rate : 0));
            if (i) add_ball(&s, ball_def(), b[i - 1], b[i], v3(i - 0.5, 0, 0), v3(1, 0, 0));
        }
        totals first = totals_of(&s, b, LINKS);
        for (int i = 0; i < 10; ++i) {
            run(&s, 1);
            totals now = totals_of(&s, b, LINKS);
            FE_WITHIN(length(minus(now.momentum, first.momentum)), 0, rounding * first.momenta);
            FE_WITHIN(now.kinetic, 0, (1 + rounding) * first.kinetic);
        }
        scene_end(&s);
    }
}

// Cubes of 1 m and 1 t slide out on each other by up to 6 m, pulled for 2 s: arms of six times their size, between
// which FIXED and SLIDE fight. Let go, they have no more than the kinetic energy of that moment and what the springs
// hold: gaps, angles, and the limits that bore the pull
static void sliders_on_long_arms_gain_no_energy(void **state)
{
    (void)state;
    enum { MOST_SLIDERS = 6, PULLED = 120, LET_GO = SLOW_BUILD ? 120 : 480 };
    static const float hertz[] = {30, 60, 80, 100, 120, 1000};
    const double mass = 1000;
    for (size_t k = 0; k < sizeof hertz / sizeof *hertz; ++k)
        for (int count = 2; count <= MOST_SLIDERS; count += 4) {
            crowd c = {.s = scene_begin(NULL), .count = count, .joint_count = count};
            set_gravity(&c.s, v3(0, 0, 0));
            fe_body last = add_anchor(&c.s, v3(0, 0, 0));
            for (int i = 0; i < count; ++i) {
                c.bodies[i] =
                    add_dynamic(&c.s, box(0.5, 0.5, 0.5), v3(0, 0.6 + 1.2 * i, 0), UNTURNED, friction(0), mass);
                MUST(fe_body_set_filter(c.s.world, c.bodies[i], 2, 0, 0));
                fe_configurable_joint_def d = slider_def();
                d.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_LIMITED, d.axes[FE_DOF_LINEAR_X].lower = -6,
                d.axes[FE_DOF_LINEAR_X].upper = 6;
                d.hertz = hertz[k];
                c.joints[i] = add_configurable(&c.s, d, last, c.bodies[i], v3(0, 1.2 * i, 0), v3(1, 0, 0));
                last = c.bodies[i];
            }
            const fe_vec3 pull = {1e5f, 5e4f, 5e4f};
            double stiffer = fmin(hertz[k], 120) / 60, w = 2 * PI * 30,
                   most = 0; // than stored_in believes; no limit is softer than 30 Hz
            stiffer *= stiffer;
            for (int i = 0; i < PULLED + LET_GO; ++i) {
                if (i < PULLED) MUST(fe_body_add_force(c.s.world, c.bodies[count - 1], &pull));
                run(&c.s, 1);
                double kinetic = totals_of(&c.s, c.bodies, count).kinetic;
                if (i == PULLED - 1)
                    most = kinetic + stiffer * stored_in(&c) + count * (double)(pull.x * pull.x) / (2 * mass * w * w);
                if (i >= PULLED) FE_WITHIN(kinetic, 0, most);
            }
            scene_end(&c.s);
        }
}

// ---- momentum ------------------------------------------------------------------------------------------------------

static void joints_keep_momentum_and_angular_momentum(void **state)
{
    (void)state;
    shortfall turned = {"angular momentum of joined bodies that fly", 0};
    for (uint64_t seed = 1; seed <= SCENES / 2; ++seed) {
        dice d = {seed * 1001};
        crowd c = make_crowd(&d, seed % 2, 0);
        totals start = totals_of(&c.s, c.bodies, c.count), now = start;
        for (int i = 0; i < STEPS; ++i) run(&c.s, 1);
        now = totals_of(&c.s, c.bodies, c.count);
        FE_WITHIN(length(minus(now.momentum, start.momentum)), 0, rounding(STEPS * c.s.substeps) * start.momenta);
        // V50: what the gyroscopic torque of free bodies may cost, 0.5 % in 10 s
        double most = 0.005 * STEPS * STEP / 10 * start.angular_all;
        measure(&turned, length(minus(now.angular, start.angular)), most, 2 * most);
        FE_WITHIN(now.kinetic, 0, start.kinetic * (1 + ENERGY_GAIN));
        scene_end(&c.s);
    }
    report_shortfall(&turned);
}

// ---- ragdolls ------------------------------------------------------------------------------------------------------
enum { LONGEST_THROW = 600 }; // steps: it flies for up to 2 s, and has 5 s from the last fall (S23)

static double bones_energy(const scene *s, const ragdoll *r) { return totals_of(s, r->bones, RAGDOLL_BONES).energy; }

// S23: a ragdoll at rest for the half second that a body needs to fall asleep is whole: gaps within the linear slop,
// angles within 3 degrees. Returns the largest error of an angle, rad.
static double check_gaps(const scene *s, const ragdoll *r)
{
    double most = 0;
    for (int i = 1; i < RAGDOLL_BONES; ++i) {
        fe_joint_state at_rest = state_of(s, r->joints[i]);
        FE_WITHIN((double)at_rest.linear_error, 0, LINEAR_SLOP);
        most = fmax(most, (double)at_rest.angular_error);
    }
    return most;
}

static int sleeps(const scene *s, const ragdoll *r)
{
    int32_t awake;
    MUST(fe_body_get_awake(s->world, r->bones[RAGDOLL_PELVIS], &awake));
    return !awake;
}

// Thrown at 30 m/s into the corner of three walls. It may be thrown back up by several metres. One in a hundred comes
// to lie on an arm that has nowhere to go: it bends a limit by 3 to 4 degrees, or contacts and limits quarrel for it by
// some mm/s, and it stays awake.
static void ragdolls_thrown_into_a_corner_come_together_again(void **state)
{
    enum { MOST_JAMMED = THROWS / 100 };
    (void)state;
    int jammed = 0;
    for (uint64_t k = 0; k < THROWS; ++k) {
        dice d = {k + 3};
        scene s = scene_begin(NULL);
        ragdoll r;
        add_plane(&s, v3(0, 1, 0), 0, friction(0.6));
        add_plane(&s, v3(1, 0, 0), 0, friction(0.6));
        add_plane(&s, v3(0, 0, 1), 0, friction(0.6));
        fe_transform at = {v3(4, 2, 4), any_rotation(&d)};
        double norm = sqrt((double)(at.rotation.x * at.rotation.x + at.rotation.y * at.rotation.y +
                                    at.rotation.z * at.rotation.z + at.rotation.w * at.rotation.w));
        at.rotation = (fe_quat){(float)(at.rotation.x / norm), (float)(at.rotation.y / norm),
                                (float)(at.rotation.z / norm), (float)(at.rotation.w / norm)};
        MUST(ragdoll_build(s.world, at, 5, &r));
        vec way = v3(-uniform(&d, 0.5, 1), -uniform(&d, 0, 0.6), -uniform(&d, 0.5, 1));
        for (int i = 0; i < RAGDOLL_BONES; ++i) set_velocity(&s, r.bones[i], times(30 / length(way), way), v3(0, 0, 0));
        double start = bones_energy(&s, &r), most = start;
        int asleep = 0;
        for (int i = 0; i < LONGEST_THROW && !asleep; ++i) {
            run(&s, 1);
            most = fmax(most, bones_energy(&s, &r));
            for (int b = 0; b < RAGDOLL_BONES; ++b) FE_WITHIN(length(velocity(&s, r.bones[b])), 0, 120); // no NaN
            asleep = sleeps(&s, &r);
        }
        FE_WITHIN(most, -1e9, start * (1 + ENERGY_GAIN));
        double bent = asleep ? check_gaps(&s, &r) : 0;
        FE_WITHIN(bent, 0, 5 * DEGREES);
        jammed += !asleep || bent > 3 * DEGREES;
        scene_end(&s);
    }
    shortfall unrest = {"thrown ragdolls that lie jammed, bent or awake, and one more", 0};
    measure(&unrest, 1 + jammed, 1, 1 + MOST_JAMMED);
    report_shortfall(&unrest);
}

// S23: dropped from a metre and a half; at rest and asleep within 5 s. Tilted by some degrees: one that lands upright
// may stand on its feet for as long as it likes before it falls over
static void a_ragdoll_comes_to_rest(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= DROPS; ++seed) {
        dice d = {seed};
        scene s = scene_begin(NULL);
        ragdoll r;
        int asleep = 0;
        add_ground(&s, friction(0.6));
        fe_transform at = fe_make_transform(0, 1.5, 0);
        double angle = uniform(&d, 4, 12) * DEGREES, azimuth = uniform(&d, -PI, PI);
        at.rotation = turned(v3(cos(azimuth), 0, sin(azimuth)), angle);
        MUST(ragdoll_build(s.world, at, 5, &r));
        for (int i = 0; i < 300 && !asleep; ++i) {
            run(&s, 1);
            asleep = sleeps(&s, &r);
        }
        assert_true(asleep);
        FE_WITHIN(check_gaps(&s, &r), 0, 3 * DEGREES);
        scene_end(&s);
    }
}

// S24 in small: ragdolls fall through turning paddles
static void ragdolls_under_paddles_stay_in_one_piece(void **state)
{
    (void)state;
    enum { PEOPLE = SLOW_BUILD ? 2 : 8 };
    scene s = scene_begin(NULL);
    ragdoll people[PEOPLE];
    add_ground(&s, friction(0.6));
    fe_body post = add_anchor(&s, v3(0, 3, 0));
    for (int i = 0; i < 2; ++i) {
        fe_body paddle = add_dynamic(&s, box(2, 0.2, 1), v3(0, 2.5 + 3 * i, 0), UNTURNED, friction(0.1), 50);
        fe_hinge_joint_def d = hinge_def();
        d.motor_speed = i ? -5 : 5, d.motor_max = 200;
        add_hinge(&s, d, post, paddle, v3(0, 2.5 + 3 * i, 0), v3(0, 0, 1));
    }
    for (int i = 0; i < 4; ++i)
        add_plane(&s, v3(i == 0 ? 1 : i == 1 ? -1 : 0, 0, i == 2 ? 1 : i == 3 ? -1 : 0), -3, friction(0.2));
    int born = 0;
    for (int i = 0; i < (SLOW_BUILD ? 120 : 480); ++i) {
        if (i % 40 == 0 && born < PEOPLE)
            MUST(ragdoll_build(s.world, fe_make_transform(born % 2 ? 1.5 : -1.5, 8, 0.3 * (born % 3 - 1)), 5,
                               &people[born])),
                ++born;
        run(&s, 1);
        for (int p = 0; p < born; ++p)
            for (int k = 1; k < RAGDOLL_BONES; ++k) FE_WITHIN(gap_of(&s, people[p].joints[k]), 0, LINEAR_SLOP);
    }
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_joint_adds_energy),
        cmocka_unit_test(bodies_locked_alike_gain_no_energy),
        cmocka_unit_test(heavy_chains_gain_no_energy_at_a_wall),
        cmocka_unit_test(what_turns_too_fast_keeps_its_momentum),
        cmocka_unit_test(sliders_on_long_arms_gain_no_energy),
        cmocka_unit_test(joints_keep_momentum_and_angular_momentum),
        cmocka_unit_test(ragdolls_thrown_into_a_corner_come_together_again),
        cmocka_unit_test(a_ragdoll_comes_to_rest),
        cmocka_unit_test(ragdolls_under_paddles_stay_in_one_piece),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
