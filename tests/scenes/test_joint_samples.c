// Samples of Box2D v3 with joints that are springs (E. Catto, 2024): a cantilever (B34), a ring (B35), light between
// heavy and a windmill (B36), a box on each joint's spring (B30), a scissor lift (B33).
#include "scenes/joint_scene.h"

static fe_quat lying(void) { return turned(v3(0, 0, 1), -PI / 2); } // a capsule along x

// ---- cantilever ----------------------------------------------------------------------------------------------------

enum { BARS = 8 };

// How far the tip of eight bars of 1 m, fixed end to end by `hertz`, hangs below its wall
static double tip_of_cantilever(void **state, float hertz, double *out_expected)
{
    scene s = scene_begin(state);
    fe_body last = add_anchor(&s, v3(0, 0, 0));
    fe_fixed_joint_def d = fixed_def();
    d.angular_hertz = hertz, d.angular_damping_ratio = 0.5f;
    for (int i = 0; i < BARS; ++i) {
        fe_body bar = add_dynamic(&s, capsule(0.5, 0.125), v3(i + 0.5, 0, 0), lying(), friction(0.6), 20);
        touch_nothing(&s, bar);
        MUST(fe_body_set_damping(s.world, bar, 0.2f, 0.2f));
        add_fixed(&s, d, last, bar, v3(i, 0, 0));
        last = bar;
    }
    run(&s, 900);
    // joint j bears the moment of what is beyond it, m g n^2 / 2 with n = 8 - j, on the inertia of one bar or of two in
    // series; the tip moves by n times its angle
    double m = mass_of(&s, last), moment = moment_of(&s, last, 0, 0), w = 2 * PI * (double)hertz, sum = 0;
    for (int n = 1; n <= BARS; ++n) sum += m * G * n * n * n / 2 / (n == BARS ? moment : moment / 2);
    *out_expected = sum / (w * w);
    vec tip = plus(position(&s, last), times(0.5, axis_of(&s, last, v3(0, 1, 0))));
    scene_end(&s);
    return -tip.y;
}

static void a_cantilever_bends_by_its_load_over_its_hertz_squared(void **state)
{
    double expected[4], sag[4];
    const float hertz[4] = {20, 40, 60, 80};
    for (int i = 0; i < 4; ++i) sag[i] = tip_of_cantilever(state, hertz[i], &expected[i]);
    for (int i = 1; i < 4; ++i) FE_WITHIN(sag[i], 0, sag[i - 1]);
    // small angles; the gaps of the points and the sums along the chain are left out
    for (int i = 2; i < 4; ++i) FE_NEAR(sag[i], expected[i], 0.25 * expected[i]);
}

// ---- ring ----------------------------------------------------------------------------------------------------------

enum { SIDES = 7 };

static void measure_ring(const scene *s, const fe_body *sides, double *out_around, double *out_area)
{
    *out_around = *out_area = 0;
    for (int i = 0; i < SIDES; ++i) {
        vec a = position(s, sides[i]), b = position(s, sides[(i + 1) % SIDES]);
        *out_around += length(minus(b, a));
        *out_area += 0.5 * (a.x * b.y - a.y * b.x);
    }
}

static void a_ring_of_springs_keeps_its_size_when_it_falls(void **state)
{
    scene s = scene_begin(state);
    fe_body sides[SIDES];
    const double radius = 2, half = PI * radius / SIDES;
    double around, area, around_now, area_now;
    add_ground(&s, friction(0.6));
    for (int i = 0; i < SIDES; ++i) {
        double angle = 2 * PI * i / SIDES;
        vec at = v3(radius * cos(angle), 10 + radius * sin(angle), 0);
        sides[i] = add_dynamic(&s, capsule(half, 0.5), at, turned(v3(0, 0, 1), angle), friction(0.6), WATER);
        MUST(fe_body_set_locks(s.world, sides[i], FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
        MUST(fe_body_set_filter(s.world, sides[i], 2, 1, 0)); // the ground only
    }
    fe_fixed_joint_def d = fixed_def();
    d.angular_hertz = 5, d.angular_damping_ratio = 0;
    for (int i = 0; i < SIDES; ++i)
        add_fixed(&s, d, sides[i], sides[(i + 1) % SIDES],
                  times(0.5, plus(position(&s, sides[i]), position(&s, sides[(i + 1) % SIDES]))));
    measure_ring(&s, sides, &around, &area);
    double start = totals_of(&s, sides, SIDES).energy, deep = totals_of(&s, sides, SIDES).kinetic;
    for (int i = 0; i < 900; ++i) {
        run(&s, 1);
        deep = fmax(deep, totals_of(&s, sides, SIDES).kinetic);
        FE_WITHIN(totals_of(&s, sides, SIDES).energy, -1e9, start * (1 + ENERGY_GAIN));
    }
    measure_ring(&s, sides, &around_now, &area_now);
    FE_NEAR(around_now, around, 0.1 * around);
    FE_NEAR(area_now, area, 0.1 * area);
    scene_end(&s);
}

// ---- light between heavy -------------------------------------------------------------------------------------------

static void a_light_ball_on_springs_between_heavy_ones_adds_no_energy(void **state)
{
    for (int light = 0; light < 2; ++light) {
        scene s = scene_begin(state);
        const double radius = light ? 0.1 : 0.5; // 8000:1 and 64:1
        fe_body left = add_plain(&s, sphere(2), v3(-3, 2, 0)), right = add_plain(&s, sphere(2), v3(3, 2, 0)),
                middle = add_plain(&s, sphere(radius), v3(0, 2, 0)), all[3] = {left, right, middle};
        add_ground(&s, friction(0.6));
        fe_configurable_joint_def d = slider_def();
        d.axes[FE_DOF_LINEAR_X].spring = FE_SPRING_HERTZ, d.axes[FE_DOF_LINEAR_X].spring_hertz = 10,
        d.axes[FE_DOF_LINEAR_X].spring_damping_ratio = 2;
        fe_joint joints[2] = {add_configurable(&s, d, left, middle, v3(0, 2, 0), v3(1, 0, 0)),
                              add_configurable(&s, d, middle, right, v3(0, 2, 0), v3(1, 0, 0))};
        set_velocity(&s, left, v3(1, 0, 0), v3(0, 0, 0));
        double start = totals_of(&s, all, 3).energy;
        for (int i = 0; i < 600; ++i) {
            run(&s, 1);
            totals now = totals_of(&s, all, 3);
            FE_WITHIN(now.energy, -1e12, start * (1 + ENERGY_GAIN));
        }
        // a chain of 8000:1 gives way, but it flies nowhere: the springs bring all to one speed
        FE_WITHIN(worst_gap(&s, joints, 2), 0, 2);
        FE_WITHIN(length(velocity(&s, middle)), 0, 2);
        scene_end(&s);
    }
}

static void a_windmill_of_soft_blades_turns_and_stays_whole(void **state)
{
    scene s = scene_begin(state);
    fe_body tower = add_anchor(&s, v3(0, 5, 0)), hub = add_plain(&s, box(0.3, 0.3, 0.3), v3(0, 5, 0));
    fe_hinge_joint_def axle = hinge_def();
    fe_joint blades[4];
    axle.motor_speed = 2, axle.motor_max = 1e5f;
    fe_joint hinge = add_hinge(&s, axle, tower, hub, v3(0, 5, 0), v3(0, 0, 1));
    touch_nothing(&s, hub);
    fe_fixed_joint_def d = fixed_def();
    d.hertz = d.angular_hertz = 30, d.damping_ratio = d.angular_damping_ratio = 1;
    for (int i = 0; i < 4; ++i) {
        vec out = v3(i == 0 ? 1 : i == 2 ? -1 : 0, i == 1 ? 1 : i == 3 ? -1 : 0, 0);
        fe_body blade = add_plain(&s, i % 2 ? box(0.1, 1, 0.1) : box(1, 0.1, 0.1), plus(v3(0, 5, 0), times(1.3, out)));
        touch_nothing(&s, blade);
        blades[i] = add_fixed(&s, d, hub, blade, plus(v3(0, 5, 0), times(0.3, out)));
    }
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, blades, 4), 0, 0.05);
        for (int k = 0; k < 4; ++k) FE_WITHIN(state_of(&s, blades[k]).angular_error, 0, 30 * DEGREES);
    }
    FE_NEAR(state_of(&s, hinge).angular_velocity.x, 2, 0.1);
    scene_end(&s);
}

// ---- a box on the springs of each joint (B30) ----------------------------------------------------------------------

// Half a period after it was let go, 0.25 beyond where it rests, it is as far on the other side, less what the damping
// took
static void a_box_on_a_slider_swings_in_its_range_and_stops_at_its_motor(void **state)
{
    scene s = scene_begin(state);
    fe_body anchor = add_anchor(&s, v3(0, 5.5, 0)),
            heavy = add_dynamic(&s, box(0.5, 1.5, 0.25), v3(0, 4, 0), UNTURNED, friction(0), 100);
    fe_configurable_joint_def d = slider_def();
    fe_joint_axis *along = &d.axes[FE_DOF_LINEAR_X];
    along->motion = FE_MOTION_LIMITED, along->lower = -1, along->upper = 1;
    along->spring = FE_SPRING_HERTZ, along->spring_hertz = 2, along->spring_damping_ratio = 0.1f;
    fe_joint joint = add_configurable(&s, d, anchor, heavy, v3(0, 4, 0), v3(1, 0, 0)); // at its centre: no arm
    set_velocity(&s, heavy, v3(5, 0, 0), v3(0, 0, 0));                                 // 5 / (2 pi 2) = 0.4 m
    double most = 0, least = 0;
    for (int i = 0; i < 30; ++i) { // 0.5 s
        run(&s, 1);
        most = fmax(most, (double)state_of(&s, joint).translation.x),
        least = fmin(least, (double)state_of(&s, joint).translation.x);
    }
    double w = 4 * PI, quarter = 5 / w * exp(-0.1 * PI / 2), three = 5 / w * exp(-0.1 * 3 * PI / 2);
    FE_NEAR(most, quarter, 0.05 * quarter);
    FE_NEAR(least, -three, 0.05 * quarter);
    set_velocity(&s, heavy, v3(50, 0, 0), v3(0, 0, 0)); // 4 m without the end at 1
    for (int i = 0; i < 60; ++i) {
        run(&s, 1);
        FE_WITHIN(state_of(&s, joint).translation.x, -1.1, 1.1); // 50 m/s is a tenth of a metre in a substep
    }
    scene_end(&s);
}

// ---- a scissor lift (B33) ------------------------------------------------------------------------------------------

enum { STAGES = 3, HINGES = 3 * STAGES };
#define REACH 2.5    // m, half of a bar
#define CROSSED 0.15 // rad, a bar's slope at first

typedef struct lift {
    fe_body platform;
    fe_joint hinges[HINGES], foot, rail;
    int hinge_count;
} lift;

static void join_bars(scene *s, lift *l, fe_body a, fe_body b, vec at)
{
    fe_hinge_joint_def d = hinge_def();
    d.hertz = 240, d.damping_ratio = 20;
    l->hinges[l->hinge_count++] = add_hinge(s, d, a, b, at, v3(0, 0, 1));
}

// slides along x and turns about z
static fe_joint join_foot(scene *s, fe_body on, fe_body bar, vec at, float speed, float force)
{
    fe_configurable_joint_def d = slider_def();
    d.hertz = 240, d.damping_ratio = 20;
    d.axes[FE_DOF_ANGULAR_Z].motion = FE_MOTION_FREE;
    d.axes[FE_DOF_LINEAR_X].motor_speed = speed, d.axes[FE_DOF_LINEAR_X].motor_max = force;
    return add_configurable(s, d, on, bar, at, v3(1, 0, 0));
}

// Crossed bars on crossed bars: left ends stand on one hinge, right ends on a foot that a motor draws inwards
static void build_lift(scene *s, float speed, lift *l)
{
    const double x = REACH * cos(CROSSED), y = REACH * sin(CROSSED), bottom = 0.2;
    fe_body ground = add_anchor(s, v3(0, 0, 0)), left = ground, right = ground;
    for (int i = 0; i < STAGES; ++i) {
        double middle = bottom + (2 * i + 1) * y;
        fe_body rising = add_dynamic(s, capsule(REACH, 0.15), v3(0, middle, 0), turned(v3(0, 0, 1), CROSSED - PI / 2),
                                     friction(0.6), 1);
        fe_body falling = add_dynamic(s, capsule(REACH, 0.15), v3(0, middle, 0), turned(v3(0, 0, 1), -CROSSED - PI / 2),
                                      friction(0.6), 1);
        touch_nothing(s, rising), touch_nothing(s, falling);
        join_bars(s, l, rising, falling, v3(0, middle, 0));
        join_bars(s, l, left, rising, v3(-x, middle - y, 0));
        if (i == 0)
            l->foot = join_foot(s, ground, falling, v3(x, middle - y, 0), speed, 2000);
        else
            join_bars(s, l, right, falling, v3(x, middle - y, 0));
        left = falling, right = rising; // whose upper ends are at the left and at the right
    }
    double top = bottom + 2 * STAGES * y;
    l->platform = add_dynamic(s, box(3, 0.2, 0.5), v3(0, top + 0.2, 0), UNTURNED, friction(0.6), 1);
    touch_nothing(s, l->platform);
    join_bars(s, l, l->platform, left, v3(-x, top, 0));
    l->rail = join_foot(s, l->platform, right, v3(x, top, 0), 0, 0);
}

// Each stage is 2 sqrt(REACH^2 - (w/2)^2) high, w the distance of the feet: drawn in at 0.25 m/s, it tells the
// platform's height, once its leap at the start (the flat bars lift it 20 times as fast as the foot goes) has died
// away. A gap along a bar, two a level, lowers its stage by the gap times the slope's cotangent.
static void a_scissor_lift_rises_as_its_feet_close_and_stays_level(void **state)
{
    scene s = scene_begin(state);
    lift l = {0};
    build_lift(&s, -0.25f, &l);
    for (int i = 0; i < 480; ++i) {
        run(&s, 1);
        double half = REACH * cos(CROSSED) + 0.5 * (double)state_of(&s, l.foot).translation.x,
               rise = sqrt(REACH * REACH - half * half);
        double gap = fmax(worst_gap(&s, l.hinges, HINGES), fmax(gap_of(&s, l.foot), gap_of(&s, l.rail)));
        FE_WITHIN(gap, 0, 0.05);
        FE_WITHIN(tilt(&s, l.platform), 0, 2 * DEGREES);
        if (i >= 300)
            FE_NEAR(position(&s, l.platform).y, 0.4 + 2 * STAGES * rise, LINEAR_SLOP + 4 * STAGES * gap * half / rise);
        FE_NEAR(position(&s, l.platform).z, 0, 0.05);
    }
    FE_NEAR(state_of(&s, l.foot).translation.x, -0.25 * 480 / 60, 0.05);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_cantilever_bends_by_its_load_over_its_hertz_squared),
        TEST(a_ring_of_springs_keeps_its_size_when_it_falls),
        TEST(a_light_ball_on_springs_between_heavy_ones_adds_no_energy),
        TEST(a_windmill_of_soft_blades_turns_and_stays_whole),
        TEST(a_box_on_a_slider_swings_in_its_range_and_stops_at_its_motor),
        TEST(a_scissor_lift_rises_as_its_feet_close_and_stays_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
