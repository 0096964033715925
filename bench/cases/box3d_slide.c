// Samples of Box3D that slide, roll and bounce, as data (E. Catto, Box3D, 2025, samples), each with its answer in
// closed form.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

static double way(const bench_trial *t, int32_t body)
{
    const double *p = t->poses[body].position, *start = t->scene.bodies[body].start.position;
    return sqrt((p[0] - start[0]) * (p[0] - start[0]) + (p[1] - start[1]) * (p[1] - start[1]) +
                (p[2] - start[2]) * (p[2] - start[2]));
}

// ---- inclined plane: 40 degrees, five frictions --------------------------------------------------------------------

enum { ON_PLANE = 5 };
static const double STEEP = 40.0 * BENCH_PI / 180.0;

// A slab turned about x: its upper side falls towards +z.
static void add_slope(bench_scene *s, double half_x, double half_z, double angle, double friction)
{
    const int32_t body =
        bench_add_static(s, bench_box(s, half_x, 1.0, half_z, 1.0, friction), 0.0, -cos(angle), -sin(angle));
    bench_turn(&s->bodies[body], 1.0, 0.0, 0.0, angle);
}

// A body on the slope's upper side, `along` metres down it, its centre `above` metres over it
static int32_t add_on_slope(bench_scene *s, int32_t shape, double x, double along, double above, double angle)
{
    const int32_t body = bench_add_dynamic(s, shape, x, above * cos(angle) - along * sin(angle),
                                           above * sin(angle) + along * cos(angle));
    bench_turn(&s->bodies[body], 1.0, 0.0, 0.0, angle);
    return body;
}

static void build_inclined_plane(bench_scene *s)
{
    add_slope(s, 20.0, 60.0, STEEP, 1.0);
    for (int32_t i = 0; i < ON_PLANE; i++) {
        const int32_t box = bench_box(s, 1.0, 1.0, 1.0, 1000.0, 0.04 * (i + 1) * (i + 1));
        add_on_slope(s, box, -10.0 + 5.0 * i, -50.0, 1.0, STEEP);
    }
}

static void judge_inclined_plane(bench_trial *t)
{
    static const char *const ways[ON_PLANE] = {"friction 0.2: way / a t2/2", "friction 0.4: way / a t2/2",
                                               "friction 0.6: way / a t2/2", "friction 0.8: way / a t2/2", ""};
    const double h = t->substeps > 0 ? (double)t->scene.dt / t->substeps : (double)t->scene.dt;
    for (int32_t i = 0; i < 4; i++) {
        const double a = GRAVITY * (sin(STEEP) - 0.2 * (i + 1) * cos(STEEP));
        bench_expect(t, ways[i], way(t, 1 + i) / (0.5 * a * t->time * (t->time + h)), 0.98, 1.02);
    }
    bench_expect_stray(t, "friction 1: way, m (tan 40 = 0.84)", way(t, ON_PLANE), BENCH_LINEAR_SLOP);
}

// ---- rolling resistance --------------------------------------------------------------------------------------------

enum { ROLLERS = 5 };
static const double GENTLE = 10.0 * BENCH_PI / 180.0;

static void build_rolling_resistance(bench_scene *s)
{
    add_slope(s, 32.0, 60.0, GENTLE, 0.6);
    for (int32_t i = 0; i < ROLLERS; i++) {
        const int32_t ball = bench_sphere(s, 1.0, 1000.0, 0.6);
        s->shapes[ball].rolling = (float)(0.05 * i);
        add_on_slope(s, ball, -25.0 + 5.0 * i, -50.0, 1.0, GENTLE);
    }
}

static void judge_rolling_resistance(bench_trial *t)
{
    static const char *const ways[ROLLERS] = {"resistance 0: way / a t2/2", "resistance 0.05", "resistance 0.1",
                                              "resistance 0.15", ""};
    const double h = t->substeps > 0 ? (double)t->scene.dt / t->substeps : (double)t->scene.dt;
    for (int32_t i = 0; i < ROLLERS - 1; i++) {
        const double a = 5.0 / 7.0 * GRAVITY * (sin(GENTLE) - 0.05 * i * cos(GENTLE));
        bench_expect(t, ways[i], way(t, 1 + i) / (0.5 * a * t->time * (t->time + h)), 0.98, 1.02);
    }
    bench_expect_stray(t, "resistance 0.2: way, m (tan 10 = 0.176)", way(t, ROLLERS), BENCH_LINEAR_SLOP);
}

// ---- isotropic friction --------------------------------------------------------------------------------------------

enum { DIRECTIONS = 32 };
static const double DEPARTURE = 25.0; // m/s

static void build_isotropic_friction(bench_scene *s)
{
    const int32_t box = bench_box(s, 1.0, 1.0, 1.0, 1000.0, 0.6);
    bench_add_ground(s, 100.0, 0.6);
    for (int32_t i = 0; i < DIRECTIONS; i++) {
        const double angle = i * BENCH_PI / 16.0;
        const double c = (double)(float)cos(angle),
                     d = (double)(float)sin(angle); // in floats, in which every libm agrees
        const int32_t body = bench_add_dynamic(s, box, 15.0 * c, 1.0, 15.0 * d);
        bench_turn(&s->bodies[body], 0.0, 1.0, 0.0, -angle);
        s->bodies[body].linear_velocity[0] = (float)(DEPARTURE * c),
        s->bodies[body].linear_velocity[2] = (float)(DEPARTURE * d);
    }
}

static void judge_isotropic_friction(bench_trial *t)
{
    double least = HUGE_VAL, most = 0.0;
    for (int32_t i = 1; i <= DIRECTIONS; i++) least = fmin(least, way(t, i)), most = fmax(most, way(t, i));
    const double exact = DEPARTURE * DEPARTURE / (2.0 * 0.6 * GRAVITY);
    bench_expect(t, "mean stopping way / exact", 0.5 * (least + most) / exact, 0.99, 1.01);
    bench_expect(t, "spread over 32 directions", (most - least) / exact, 0.0, 0.01);
}

// ---- slide and twist: a box that spins on a slope it does not slide down -------------------------------------------

static const double TWIST_SLOPE = 20.0 * BENCH_PI / 180.0;
static const double TWIST_SPIN = 25.0; // rad/s about the slope's normal

static void build_slide_twist(bench_scene *s)
{
    add_slope(s, 30.0, 30.0, TWIST_SLOPE, 0.6);
    const int32_t box = add_on_slope(s, bench_box(s, 1.0, 0.5, 1.0, 1000.0, 0.3), 0.0, -20.0, 0.5, TWIST_SLOPE);
    s->bodies[box].angular_velocity[1] = (float)(TWIST_SPIN * cos(TWIST_SLOPE));
    s->bodies[box].angular_velocity[2] = (float)(TWIST_SPIN * sin(TWIST_SLOPE));
}

// note 0: when it stopped to spin, s
static void watch_slide_twist(bench_trial *t)
{
    const double *w = t->motions[1].angular;
    if (t->notes[0] == 0.0 && sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) < 0.1) t->notes[0] = t->time;
}

// Friction at one centre with levers (4 corners at sqrt 2 m) brakes the spin by mu g cos R m / I, I = m (1 + 1) / 3,
// and still holds the box. The spin moves the load to one side of the box, where it is no matter; a friction at each
// corner lets the box slide while it spins.
static void judge_slide_twist(bench_trial *t)
{
    const double mu = sqrt(0.6 * 0.3), brake = mu * GRAVITY * cos(TWIST_SLOPE) * sqrt(2.0) / (2.0 / 3.0);
    bench_expect_own(t, "time until the spin ends / exact", t->notes[0] / (TWIST_SPIN / brake), 0.95, 1.05);
    bench_expect_own(t, "way down the slope, m", way(t, 1), 0.0, 0.1);
}

// ---- restitution row -----------------------------------------------------------------------------------------------

enum { BOUNCERS = 40 };
static const double DROP = 39.5; // m, of the lowest point

static void build_restitution_row(bench_scene *s)
{
    bench_add_ground(s, 50.0, 0.6);
    for (int32_t i = 0; i < BOUNCERS; i++) {
        const int32_t ball = bench_sphere(s, 0.5, 1000.0, 0.6);
        s->shapes[ball].restitution = (float)(i / 39.0);
        bench_add_dynamic(s, ball, -39.0 + 2.0 * i, 40.0, 0.0);
    }
}

// All land at once: what follows is the rebound.
static void watch_restitution_row(bench_trial *t)
{
    if (t->notes[0] == 0.0 && t->poses[BOUNCERS].position[1] < 1.0) {
        t->notes[0] = 1.0;
    } else if (t->notes[0] == 1.0 && t->motions[BOUNCERS].linear[1] > 0.0) {
        t->notes[0] = 2.0;
        bench_trial_forget(t);
    }
}

static void judge_restitution_row(bench_trial *t)
{
    const double h = t->substeps > 0 ? (double)t->scene.dt / t->substeps : (double)t->scene.dt,
                 speed = sqrt(2.0 * GRAVITY * DROP);
    double above = -HUGE_VAL, below = -HUGE_VAL;
    for (int32_t i = 0; i < BOUNCERS; i++) {
        const double e = i / 39.0, exact = e * e * DROP, reached = t->tracks[1 + i].highest - 0.5;
        if (e * speed < 1.0) continue; // under the threshold
        above = fmax(above, reached - exact);
        below = fmax(below, exact - reached - h * speed); // a flight may miss its top by h v between two steps
    }
    bench_expect(t, "rebound above e2 h, m", above, -1.0, 0.001 * DROP);
    bench_expect(t, "rebound below it, share of h", below / DROP, -1.0, 0.02);
}

const bench_case bench_box3d_slide[] = {
    {"inclined-plane", "Box3D", "five frictions at 40 degrees", 3.0, 0, build_inclined_plane, NULL, NULL,
     judge_inclined_plane, BENCH_CALM},
    {"rolling-resistance", "Box3D", "five resistances at 10 degrees", 6.0, 0, build_rolling_resistance, NULL, NULL,
     judge_rolling_resistance, BENCH_CALM},
    {"isotropic-friction", "Box3D", "32 boxes slide apart", 8.0, 0, build_isotropic_friction, NULL, NULL,
     judge_isotropic_friction, BENCH_CALM},
    {"slide-twist", "Box3D", "a box spins on a slope", 5.0, 0, build_slide_twist, NULL, watch_slide_twist,
     judge_slide_twist, BENCH_CALM},
    {"restitution-row", "Box3D", "40 balls of restitution 0 to 1", 5.6, 0, build_restitution_row, NULL,
     watch_restitution_row, judge_restitution_row, BENCH_CALM},
};
const int32_t bench_box3d_slide_count = (int32_t)(sizeof bench_box3d_slide / sizeof bench_box3d_slide[0]);
