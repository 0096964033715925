// Scenes with joints that engines are compared by: S20 to S23, S25, S26, B25 to B30, B32, chains of 1000:1, linkages.
// Bounds by P2 (joint_give).
#include "scenes/joint_scene.h"

#define SOURCE_G 10.0 // m/s2, of the sources

static scene begin_source(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, -SOURCE_G, 0));
    return s;
}

static void set_joint_hertz(scene *s, float hertz)
{
    fe_world_tuning t = {.struct_size = sizeof t};
    MUST(fe_world_get_tuning(s->world, &t));
    t.joint_hertz = hertz;
    MUST(fe_world_set_tuning(s->world, &t));
}

static void set_damping(scene *s, fe_body body, double damping)
{
    MUST(fe_body_set_damping(s->world, body, (float)damping, (float)damping));
}
static fe_quat lying(void) { return turned(v3(0, 0, 1), -PI / 2); } // a capsule along x

static double speed_square(const scene *s, const fe_body *bodies, int count)
{
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += dot(velocity(s, bodies[i]), velocity(s, bodies[i]));
    return sum;
}

// ---- chains --------------------------------------------------------------------------------------------------------

enum { MOST_LINKS = 48 };
typedef struct chain {
    fe_body anchor, links[MOST_LINKS + 1];
    fe_joint joints[MOST_LINKS + 1];
    int count; // of links; links[count] is the ball at the end, if there is one
} chain;

// `count` capsules of half length `half` in a row along x from `from`
static chain add_chain(scene *s, vec from, int count, double half, double radius, double density,
                       double friction_torque)
{
    chain c = {.anchor = add_anchor(s, from), .count = count};
    fe_ball_joint_def d = ball_def();
    d.motor_max = (float)friction_torque;
    for (int i = 0; i < count; ++i) {
        vec end = plus(from, v3(2 * half * i, 0, 0));
        c.links[i] =
            add_dynamic(s, capsule(half, radius), plus(end, v3(half, 0, 0)), lying(), friction(0.6), (float)density);
        touch_nothing(s, c.links[i]);
        c.joints[i] = add_ball(s, d, i ? c.links[i - 1] : c.anchor, c.links[i], end, v3(1, 0, 0));
    }
    return c;
}

static void add_end(scene *s, chain *c, vec from, double half, double radius, double density)
{
    vec end = plus(from, v3(2 * half * c->count, 0, 0));
    c->links[c->count] =
        add_dynamic(s, sphere(radius), plus(end, v3(radius, 0, 0)), UNTURNED, friction(0.6), (float)density);
    touch_nothing(s, c->links[c->count]);
    c->joints[c->count] = add_ball(s, ball_def(), c->links[c->count - 1], c->links[c->count], end, v3(1, 0, 0));
}

static double sum_of_gaps(const scene *s, const chain *c)
{
    double sum = 0;
    for (int i = 0; i <= c->count; ++i) sum += gap_of(s, c->joints[i]);
    return sum;
}

// S22, B25: a ball of 585 times a link's mass swings down on 32 links. Tension reaches 3 M g on the first swing, by
// which joints that give would stretch 3.3 times as far as predictor P2 says of the load at rest, 8.6 m; later the ball
// falls slack into its chain and jerks it taut. The chain is a tree: all of it together stays within the slop of one
// joint.
static void a_ball_on_a_chain_does_not_stretch_it(void **state)
{
    scene s = begin_source(state);
    chain c = add_chain(&s, v3(0, 0, 0), 32, 0.5, 0.125, 1000, 10);
    add_end(&s, &c, v3(0, 0, 0), 0.5, 2, 1000);
    double link = mass_of(&s, c.links[0]), ball = mass_of(&s, c.links[32]);
    FE_NEAR(ball / link, 585, 6);
    double start = totals_of(&s, c.links, 33).energy;
    const int steps = SLOW_BUILD ? 150 : 1800;
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        FE_WITHIN(sum_of_gaps(&s, &c), 0, LINEAR_SLOP);
        FE_WITHIN(totals_of(&s, c.links, 33).energy, -1e12, start + 1e-5 * ball * SOURCE_G * 32);
        FE_TRUE(dot(position(&s, c.links[32]), position(&s, c.links[32])) < 1e4); // no NaN
    }
    scene_end(&s);
}

// hung, not swung: it stays where it was put
static void a_load_of_a_thousand_links_hangs_still_on_its_chain(void **state)
{
    enum { LINKS = 10 };
    scene s = scene_begin(state);
    fe_body above = add_anchor(&s, v3(0, 0, 0)), load = 0;
    fe_joint joints[LINKS + 1];
    for (int i = 0; i <= LINKS; ++i) {
        fe_body below = add_plain(&s, i < LINKS ? capsule(0.1, 0.05) : box(0.5, 0.5, 0.5),
                                  v3(0, i < LINKS ? -0.15 - 0.3 * i : -0.3 * i - 0.5, 0));
        MUST(fe_body_set_mass(s.world, below, i < LINKS ? 1 : 1000));
        joints[i] = add_ball(&s, ball_def(), above, below, v3(0, -0.3 * i, 0), v3(0, -1, 0));
        above = load = below;
    }
    const int steps = SLOW_BUILD ? 300 : 1200;
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        vec p = position(&s, load);
        FE_WITHIN(worst_gap(&s, joints, LINKS + 1), 0, 1e-6);
        FE_NEAR(p.x, 0, 1e-6), FE_NEAR(p.y, -0.3 * LINKS - 0.5, 1e-5), FE_NEAR(p.z, 0, 1e-6);
        FE_WITHIN(length(velocity(&s, load)), 0, 1e-4);
    }
    scene_end(&s);
}

// S20: 40 links of 60 g, 50 km from the origin
static void a_chain_hangs_far_from_the_origin_as_near_it(void **state)
{
    scene s = begin_source(state);
    vec from = v3(40000, -35000, 0);
    chain c = add_chain(&s, from, 40, 0.1, 0.025, 20, 0);
    for (int i = 0; i < 40; ++i) set_damping(&s, c.links[i], 1); // ten times the source's: it hangs sooner
    for (int i = 0; i < 900; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, c.joints, 40), 0, LINEAR_SLOP);
    }
    vec last = minus(position(&s, c.links[39]), from);
    FE_NEAR(last.y, -8 + 0.1, 1e-3);
    FE_WITHIN(sqrt(speed_square(&s, c.links, 40)), 0, 2);
    scene_end(&s);
}

// S26: each of 40 joints starts a metre open
static void a_chain_made_open_closes_without_a_bang(void **state)
{
    enum { BALLS = 40 };
    scene s = begin_source(state);
    fe_body anchor = add_anchor(&s, v3(0, 39.5, 0)), balls[BALLS];
    fe_joint joints[BALLS];
    for (int i = 0; i < BALLS; ++i) {
        fe_ball_joint_def d = ball_def();
        balls[i] = add_plain(&s, sphere(0.2), v3(0, 38 - 2 * i, 0));
        touch_nothing(&s, balls[i]);
        d.body_a = i ? balls[i - 1] : anchor, d.body_b = balls[i];
        d.frame_a.position = narrow(v3(0, i ? -0.5 : 0, 0)), d.frame_b.position = narrow(v3(0, 0.5, 0));
        MUST(fe_ball_joint_create(s.world, &d, &joints[i]));
        FE_NEAR(gap_of(&s, joints[i]), 1, 1e-5);
    }
    double m = mass_of(&s, balls[0]), give = joint_give(&s, BALLS * m * SOURCE_G, m / 2), lowest = 0;
    // what the springs hold, 1/2 m_eff w^2 a joint, is far more than gravity's share: the push must not become speed
    double w = 2 * PI * 60, stored = BALLS * 0.5 * (m / 2) * w * w;
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        totals now = totals_of(&s, balls, BALLS);
        FE_WITHIN(now.kinetic, 0, stored);
        lowest = fmin(lowest, position(&s, balls[BALLS - 1]).y);
    }
    FE_WITHIN(worst_gap(&s, joints, BALLS), 0, give + LINEAR_SLOP);
    FE_NEAR(position(&s, balls[BALLS - 1]).y, 0 - BALLS * give / 2, 0.5);
    FE_WITHIN(sqrt(speed_square(&s, balls, BALLS)), 0, 10);
    scene_end(&s);
}

// S25: a cloth of n x n balls below a static row
static void a_cloth_hangs_by_the_predicted_gaps(void **state)
{
    enum { N = 16 };
    static fe_body balls[N][N];
    scene s = begin_source(state);
    for (int k = 0; k < N; ++k)
        for (int i = 0; i < N; ++i) {
            balls[i][k] = add_body(&s, i ? FE_BODY_DYNAMIC : FE_BODY_STATIC, sphere(0.4), v3(k, -i, 0), UNTURNED,
                                   friction(0), WATER);
            touch_nothing(&s, balls[i][k]);
            if (i) set_damping(&s, balls[i][k], 1);
            if (i) add_ball(&s, ball_def(), balls[i - 1][k], balls[i][k], v3(k, 0.5 - i, 0), v3(0, 1, 0));
            if (i && k) add_ball(&s, ball_def(), balls[i][k - 1], balls[i][k], v3(k - 0.5, -i, 0), v3(1, 0, 0));
        }
    run(&s, SLOW_BUILD ? 200 : 900);
    double m = mass_of(&s, balls[1][0]), sunk = joint_give(&s, (N - 1) * m * SOURCE_G, m);
    for (int k = 1; k < N - 1; ++k) sunk += joint_give(&s, k * m * SOURCE_G, m / 2);
    for (int k = 0; k < N; ++k) {
        vec p = position(&s, balls[N - 1][k]);
        FE_NEAR(p.y, -(N - 1) - sunk, (SLOW_BUILD ? 0.5 : 0.05) * sunk);
        FE_NEAR(p.z, 0, 0); // nothing pushes out of the plane
    }
    scene_end(&s);
}

// ---- bridges -------------------------------------------------------------------------------------------------------

// S21, B26: planks between two ends without slack, held stiffly. sag^2 = 3/8 L sum(gaps)
static void check_bridge(void **state, int planks, double length_of_plank, double half_height, double half_depth,
                         int balls)
{
    enum { MOST = 160 };
    static fe_body bodies[MOST];
    static fe_joint joints[2 * MOST + 2];
    scene s = begin_source(state);
    fe_body left = add_anchor(&s, v3(0, 0, 0)), right = add_anchor(&s, v3(planks * length_of_plank, 0, 0));
    int count = 0;
    MUST(fe_world_set_substeps(s.world, 16));
    s.h = STEP / 16;
    set_joint_hertz(&s, 240);
    for (int i = 0; i < planks; ++i) {
        vec at = v3((i + 0.5) * length_of_plank, 0, 0);
        bodies[i] = add_dynamic(&s, box(length_of_plank / 2, half_height, half_depth), at, UNTURNED, friction(0.6), 20);
        touch_nothing(&s, bodies[i]);
        set_damping(&s, bodies[i], 0.5);
    }
    for (int i = 0; i <= planks; ++i) {
        fe_body a = i ? bodies[i - 1] : left, b = i < planks ? bodies[i] : right;
        vec at = v3(i * length_of_plank, 0, 0);
        if (!balls) joints[count++] = add_hinge(&s, hinge_def(), a, b, at, v3(0, 0, 1));
        for (int k = 0; k < balls; ++k)
            joints[count++] = add_ball(&s, ball_def(), a, b, plus(at, v3(0, 0, k ? 0.4 : -0.4)), v3(1, 0, 0));
    }
    double early = 0, late = 0, sag = 0, span = planks * length_of_plank;
    const int steps = SLOW_BUILD ? 120 : 900;
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        if (i < steps / 2) early += speed_square(&s, bodies, planks);
        if (i >= steps / 2) late += speed_square(&s, bodies, planks);
    }
    for (int i = 0; i < planks; ++i) sag = fmax(sag, -position(&s, bodies[i]).y);
    FE_WITHIN(worst_gap(&s, joints, count), 0, 2 * LINEAR_SLOP);
    if (!SLOW_BUILD) { // a slow build stops while it still swings
        FE_WITHIN(sag, 0, sqrt(3.0 / 8 * span * (planks + 1) * LINEAR_SLOP));
        FE_WITHIN(late, 0, 0.25 * early); // rms speed halves
    }
    scene_end(&s);
}

static void a_bridge_of_hinges_sags_no_more_than_its_gaps(void **state) { check_bridge(state, 160, 1, 0.125, 0.5, 0); }
static void a_bridge_of_balls_sags_no_more_than_its_gaps(void **state)
{
    check_bridge(state, 150, 0.25, 0.125, 0.5, 2);
}

// ---- a door that is hit (B27) --------------------------------------------------------------------------------------

static void a_slammed_door_stays_in_its_hinges(void **state)
{
    scene s = begin_source(state);
    set_joint_hertz(&s, 120);
    fe_body frame = add_anchor(&s, v3(0, 0, 0)),
            leaf = add_dynamic(&s, box(0.75, 1.5, 0.1), v3(0, 1.5, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_gravity_scale(s.world, leaf, 2));
    fe_joint hinges[2];
    for (int i = 0; i < 2; ++i) {
        fe_hinge_joint_def d = hinge_def();
        d.limit_enabled = 1, d.lower = -(float)(PI / 2), d.upper = (float)(PI / 2), d.spring_hertz = 1,
        d.spring_damping_ratio = 0.5f;
        hinges[i] = add_hinge(&s, d, frame, leaf, v3(-0.75, 3 * i, 0), v3(0, 1, 0));
    }
    fe_vec3 impulse = narrow(to_world(&s, v3(0, 0, 50000)));
    vec edge = to_world(&s, v3(0.75, 1.5, 0));
    MUST(fe_body_add_impulse_at(s.world, leaf, &impulse, &edge));
    double open = 0, beyond = 0;
    for (int i = 0; i < 60; ++i) {
        run(&s, 1);
        open = fmax(open, worst_gap(&s, hinges, 2));
        beyond = fmax(beyond, fabs((double)state_of(&s, hinges[0]).angle) - PI / 2);
    }
    FE_WITHIN(open, 0, 0.05);
    FE_WITHIN(beyond, -PI, 10 * DEGREES);
    FE_WITHIN(worst_gap(&s, hinges, 2), 0, LINEAR_SLOP);
    scene_end(&s);
}

// ---- single joints under load (B28 to B30, B32) --------------------------------------------------------------------

static void a_chain_of_rods_falls_and_keeps_its_lengths(void **state)
{
    enum { RODS = 20 };
    scene s = begin_source(state);
    fe_body before = add_anchor(&s, v3(0, 20, 0)), balls[RODS];
    fe_joint rods[RODS];
    for (int i = 0; i < RODS; ++i) {
        balls[i] = add_dynamic(&s, sphere(0.25), v3(i + 1, 20, 0), UNTURNED, friction(0.6), 20);
        touch_nothing(&s, balls[i]);
        rods[i] = add_rod(&s, before, balls[i], v3(i, 20, 0), v3(i + 1, 20, 0));
        before = balls[i];
    }
    double m = mass_of(&s, balls[0]), start = totals_of(&s, balls, RODS).energy;
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        for (int k = 0; k < RODS && i < 240; ++k)
            FE_NEAR(state_of(&s, rods[k]).length, 1, 4 * LINEAR_SLOP); // its end whips
        FE_WITHIN(totals_of(&s, balls, RODS).energy, -1e9, start + 1e-5 * RODS * m * SOURCE_G * RODS);
    }
    scene_end(&s);
}

static void limits_of_a_heavy_box_hold_against_strong_motors(void **state)
{
    const double cone = 30 * DEGREES, twist = 35 * DEGREES;
    for (int k = 0; k < 8; ++k) {
        scene s = begin_source(state);
        fe_body anchor = add_anchor(&s, v3(0, 5.5, 0)),
                body = add_dynamic(&s, box(0.5, 1.5, 0.25), v3(0, 4, 0), UNTURNED, friction(0.6), 100);
        fe_ball_joint_def d = ball_def();
        d.cone_enabled = d.limit_enabled = 1, d.cone_y = d.cone_z = (float)cone, d.lower = -(float)twist,
        d.upper = (float)twist;
        d.spring_hertz = 2, d.spring_damping_ratio = 0.7f;
        d.motor_velocity = narrow(v3(k % 2 ? 3 : -3, 5 * cos(k * PI / 4), 5 * sin(k * PI / 4))), d.motor_max = 1e4f;
        fe_joint joint = add_ball(&s, d, anchor, body, v3(0, 5.5, 0), v3(0, -1, 0));
        for (int i = 0; i < 240; ++i) {
            run(&s, 1);
            FE_WITHIN(state_of(&s, joint).angular_error, 0, 3 * DEGREES);
        }
        scene_end(&s);
    }
    for (int k = -1; k <= 1; k += 2) {
        scene s = begin_source(state);
        fe_body anchor = add_anchor(&s, v3(0, 5.5, 0)),
                body = add_dynamic(&s, box(0.5, 1.5, 0.25), v3(0, 4, 0), UNTURNED, friction(0.6), 100);
        fe_hinge_joint_def d = hinge_def();
        d.limit_enabled = 1, d.lower = -(float)twist, d.upper = (float)twist, d.spring_hertz = 0.5f,
        d.motor_speed = (float)(5 * k), d.motor_max = 5000;
        fe_joint joint = add_hinge(&s, d, anchor, body, v3(0, 5.5, 0), v3(0, 0, 1));
        for (int i = 0; i < 240; ++i) {
            run(&s, 1);
            FE_WITHIN(k * (double)state_of(&s, joint).angle, -twist, twist + 3 * DEGREES);
        }
        FE_WITHIN(k * (double)state_of(&s, joint).angle, twist - 1 * DEGREES, twist + 3 * DEGREES);
        scene_end(&s);
    }
}

static void telescopes_pulled_hard_come_back(void **state)
{
    enum { CUBES = 6 };
    for (int pull = 0; pull < 2; ++pull) {
        scene s = begin_source(state);
        set_gravity(&s, v3(0, 0, 0)); // drawn out it would be a beam of 36 m
        MUST(fe_world_set_substeps(s.world, 16));
        set_joint_hertz(&s, 240);
        fe_body below = add_anchor(&s, v3(0, 0, 0)), cubes[CUBES];
        fe_joint joints[CUBES];
        for (int i = 0; i < CUBES; ++i) {
            fe_configurable_joint_def d = slider_def();
            d.axes[0].motion = FE_MOTION_LIMITED, d.axes[0].lower = -6, d.axes[0].upper = 6;
            cubes[i] = add_plain(&s, box(0.5, 0.5, 0.5), v3(0, 0.6 + 1.2 * i, 0));
            touch_nothing(&s, cubes[i]);
            joints[i] = add_configurable(&s, d, below, cubes[i], v3(0, 1.2 * i, 0), v3(1, 0, 0));
            below = cubes[i];
        }
        for (int i = 0; i < 1500; ++i) {
            if (i < 120) add_force(&s, cubes[CUBES - 1], v3(pull ? 1e6 : 1e5, 2e4, pull ? 2e5 : 1e4));
            run(&s, 1);
            for (int k = 0; k < CUBES; ++k) FE_WITHIN(length(velocity(&s, cubes[k])), 0, 1000); // no NaN
        }
        for (int k = 0; k < CUBES; ++k) {
            vec off = widen(state_of(&s, joints[k]).translation);
            FE_WITHIN(sqrt(off.y * off.y + off.z * off.z), 0, LINEAR_SLOP);
            FE_WITHIN(off.x, -6 - LINEAR_SLOP, 6 + LINEAR_SLOP);
        }
        scene_end(&s);
    }
}

// ---- linkages (IFToMM A02, A04) ------------------------------------------------------------------------------------

static fe_body add_link(scene *s, vec from, vec to)
{
    vec along = minus(to, from), middle = times(0.5, plus(from, to));
    vec side = fabs(along.y) > 0.9 * length(along) ? v3(0, 0, 1) : cross(v3(0, 1, 0), along);
    fe_body body = add_dynamic(s, box(0.05, 0.5 * length(along), 0.05), middle,
                               turned(side, between(v3(0, 1, 0), along)), friction(0), 100);
    touch_nothing(s, body);
    return body;
}

// Two squares of rods in the plane, side by side: flat they may go either way. Without gravity's help they stay
// together
static void a_double_four_bar_passes_its_flat_position(void **state)
{
    scene s = scene_begin(state);
    fe_body ground = add_anchor(&s, v3(0, 0, 0)), up[3], bars[2], all[5];
    fe_joint joints[8];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        up[i] = add_link(&s, v3(i, 0, 0), v3(i, 1, 0));
        joints[count++] = add_hinge(&s, hinge_def(), ground, up[i], v3(i, 0, 0), v3(0, 0, 1));
    }
    for (int i = 0; i < 2; ++i) {
        bars[i] = add_link(&s, v3(i, 1, 0), v3(i + 1, 1, 0));
        joints[count++] = add_hinge(&s, hinge_def(), up[i], bars[i], v3(i, 1, 0), v3(0, 0, 1));
        joints[count++] = add_hinge(&s, hinge_def(), bars[i], up[i + 1], v3(i + 1, 1, 0), v3(0, 0, 1));
    }
    for (int i = 0; i < 3; ++i) set_velocity(&s, up[i], v3(0.5, 0, 0), v3(0, 0, -1)), all[i] = up[i];
    for (int i = 0; i < 2; ++i) set_velocity(&s, bars[i], v3(1, 0, 0), v3(0, 0, 0)), all[3 + i] = bars[i];
    totals start = totals_of(&s, all, 5);
    double depth = 5 * mass_of(&s, up[0]) * G, kinetic = 0;
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, joints, count), 0, LINEAR_SLOP);
        totals now = totals_of(&s, all, 5);
        FE_WITHIN(now.energy, start.energy - 0.05 * depth, start.energy + 1e-5 * depth);
        kinetic = fmax(kinetic, now.kinetic);
    }
    FE_WITHIN(kinetic, 0.5 * depth, 2 * depth); // it came round: through the lowest position
    scene_end(&s);
}

// Bricard's linkage: five rods and the ground, six hinges at right angles, one freedom too many by counting
static void bricards_linkage_moves_as_one(void **state)
{
    static const double corners[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {1, -1, -1}, {0, -1, -1}, {0, -1, 0}};
    scene s = scene_begin(state);
    MUST(fe_world_set_substeps(s.world, 16)); // thin rods: at 60 Hz they would turn by 5 degrees in their hinges
    s.h = STEP / 16;
    set_joint_hertz(&s, 240);
    fe_body ground = add_anchor(&s, v3(0, 0, 0)), rods[6];
    fe_joint joints[6];
    rods[5] = ground; // from corner 5 to corner 0
    for (int i = 0; i < 5; ++i) {
        vec from = v3(corners[i][0], corners[i][1], corners[i][2]),
            to = v3(corners[i + 1][0], corners[i + 1][1], corners[i + 1][2]);
        rods[i] = add_link(&s, from, to);
    }
    for (int i = 0; i < 6; ++i) { // each hinge across the two rods it joins
        vec at = v3(corners[i][0], corners[i][1], corners[i][2]),
            next = v3(corners[(i + 1) % 6][0], corners[(i + 1) % 6][1], corners[(i + 1) % 6][2]),
            last = v3(corners[(i + 5) % 6][0], corners[(i + 5) % 6][1], corners[(i + 5) % 6][2]);
        joints[i] = add_hinge(&s, hinge_def(), rods[(i + 5) % 6], rods[i], at, cross(minus(next, at), minus(at, last)));
    }
    totals start = totals_of(&s, rods, 5);
    double depth = 5 * mass_of(&s, rods[0]) * G, kinetic = 0;
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, joints, 6), 0, LINEAR_SLOP);
        for (int k = 0; k < 6; ++k) FE_WITHIN(state_of(&s, joints[k]).angular_error, 0, 1 * DEGREES);
        totals now = totals_of(&s, rods, 5);
        // the scheme's share h g v / 2 of the energy is exact in free flight only
        double share = 0.5 * s.h * G * sqrt(2 * now.kinetic * 5 * mass_of(&s, rods[0]));
        FE_WITHIN(now.energy, start.energy - 0.05 * depth, start.energy + share + 1e-5 * depth);
        kinetic = fmax(kinetic, now.kinetic);
    }
    FE_WITHIN(kinetic, 0.1 * depth, 2 * depth); // over-constrained, but it moves
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_ball_on_a_chain_does_not_stretch_it),
        WITH_4_SUBSTEPS(a_ball_on_a_chain_does_not_stretch_it),
        TEST(a_load_of_a_thousand_links_hangs_still_on_its_chain),
        TEST(a_chain_hangs_far_from_the_origin_as_near_it),
        TEST(a_chain_made_open_closes_without_a_bang),
        TEST(a_cloth_hangs_by_the_predicted_gaps),
        TEST(a_bridge_of_hinges_sags_no_more_than_its_gaps),
        TEST(a_bridge_of_balls_sags_no_more_than_its_gaps),
        TEST(a_slammed_door_stays_in_its_hinges),
        WITH_4_SUBSTEPS(a_slammed_door_stays_in_its_hinges),
        TEST(a_chain_of_rods_falls_and_keeps_its_lengths),
        TEST(limits_of_a_heavy_box_hold_against_strong_motors),
        TEST(telescopes_pulled_hard_come_back),
        EVERY_WAY_UP(a_double_four_bar_passes_its_flat_position),
        TEST(bricards_linkage_moves_as_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
