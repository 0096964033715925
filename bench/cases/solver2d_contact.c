// Solver2D's samples of friction, overlap, crowding and toppling (E. Catto, Solver2D, 2024,
// samples/sample_contact.cpp). See solver2d_stack.c.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

// ---- friction ramp: five boxes of falling friction on three ramps --------------------------------------------------

enum { RAMP_BOXES = 5, RAMP_PARTS = 6 };
static const double RAMP =
    0.25; // rad: tan = 0.2553; pairs of sqrt(0.2 x own) = 0.387, 0.316, 0.265, 0.141, 0: the first three hold

static void add_part(bench_scene *s, double half_x, double half_y, double x, double y, double angle)
{
    const int32_t body = bench_add_static(s, bench_box(s, half_x, half_y, 2.0, 1.0, 0.2), x, y, 0.0);
    bench_turn_z(&s->bodies[body], angle);
}

static void build_friction_ramp(bench_scene *s)
{
    static const double friction[RAMP_BOXES] = {0.75, 0.5, 0.35, 0.1, 0.0};
    bench_add_ground(s, 40.0, 0.2);
    add_part(s, 13.0, 0.25, -4.0, 22.0, -RAMP);
    add_part(s, 0.25, 1.0, 10.5, 19.0, 0.0);
    add_part(s, 13.0, 0.25, 4.0, 14.0, RAMP);
    add_part(s, 0.25, 1.0, -10.5, 11.0, 0.0);
    add_part(s, 13.0, 0.25, -4.0, 6.0, -RAMP);
    for (int32_t i = 0; i < RAMP_BOXES; i++)
        bench_add_dynamic(s, bench_box(s, 0.5, 0.5, 0.5, 25.0, friction[i]), -15.0 + 4.0 * i, 28.0, 0.0);
}

// The third box's friction exceeds the slope's by 3.6 % only: whether it stops in time after its fall is not certain.
// The clean law is the next case.
static void judge_friction_ramp(bench_trial *t)
{
    double fastest = 0.0, lowest_held = HUGE_VAL, highest_gone = -HUGE_VAL;
    for (int32_t i = 0; i < RAMP_BOXES; i++) {
        const bench_pose *p = &t->poses[RAMP_PARTS + i];
        const double above_ramp =
            p->position[1] - 22.0 + tan(RAMP) * (p->position[0] + 4.0); // of the first ramp's middle line
        if (i < 2) {
            fastest = fmax(fastest, bench_speed(t, RAMP_PARTS + i));
            lowest_held = fmin(lowest_held, above_ramp);
        } else if (i > 2) {
            highest_gone = fmax(highest_gone, p->position[1]);
        }
    }
    bench_expect(t, "the two rough boxes: largest speed, m/s", fastest, 0.0, 0.01);
    bench_expect(t, "and height above the first ramp, m", lowest_held, 0.25, 2.0);
    bench_expect(t, "the two smooth ones: largest height, m", highest_gone, 0.0, 17.0);
}

// The clean law: boxes laid flush on a slope of 0.25 rad. Heavier friction holds to the slop; less slides with g (sin -
// mu cos).
static void build_friction_slope(bench_scene *s)
{
    static const double friction[RAMP_BOXES] = {0.75, 0.5, 0.35, 0.1, 0.0};
    const int32_t slope = bench_add_static(s, bench_box(s, 60.0, 1.0, 4.0, 1.0, 0.2), -sin(RAMP), -cos(RAMP), 0.0);
    bench_turn_z(&s->bodies[slope], -RAMP);
    for (int32_t i = 0; i < RAMP_BOXES; i++) {
        const double along = -44.0 + 3.0 * i; // m up the slope
        const double x = along * cos(RAMP) + 0.5 * sin(RAMP), y = -along * sin(RAMP) + 0.5 * cos(RAMP);
        const int32_t body = bench_add_dynamic(s, bench_box(s, 0.5, 0.5, 0.5, 25.0, friction[i]), x, y, 0.0);
        bench_turn_z(&s->bodies[body], -RAMP);
    }
}

static double way(const bench_trial *t, int32_t body)
{
    const double *p = t->poses[body].position, *start = t->scene.bodies[body].start.position;
    return hypot(p[0] - start[0], p[1] - start[1]);
}

static void judge_friction_slope(bench_trial *t)
{
    static const char *const ways[2] = {"way at friction 0.141 / a t (t + h) / 2",
                                        "way without friction / a t (t + h) / 2"};
    static const double friction[2] = {0.1, 0.0};
    const double h = (double)t->scene.dt / t->substeps, time = t->time;
    bench_expect_stray(t, "way of those that hold, m", fmax(way(t, 1), fmax(way(t, 2), way(t, 3))), BENCH_LINEAR_SLOP);
    for (int32_t i = 0; i < 2; i++) {
        const double a = GRAVITY * (sin(RAMP) - sqrt(0.2 * friction[i]) * cos(RAMP));
        bench_expect_own(t, ways[i], way(t, 4 + i) / (a * time * (time + h) / 2.0), 0.99, 1.01);
    }
}

// ---- overlap recovery: a pyramid pushed together by a quarter ------------------------------------------------------

enum { OVERLAP_ROWS = 4, OVERLAP_BOXES = 10 };

static void build_overlap_recovery(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6);
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t i = 0; i < OVERLAP_ROWS; i++) {
        for (int32_t j = i; j < OVERLAP_ROWS; j++)
            bench_add_dynamic(s, box, 0.375 * (i - 4) + 0.75 * (j - i), 0.5 + 0.75 * i, 0.0);
    }
}

// note 0: deepest overlap after 2 s
static void watch_overlap_recovery(bench_trial *t)
{
    if (t->step == bench_step_at(t, 2.0) && t->time > 1.9) t->notes[0] = bench_deepest(t);
}

static void judge_overlap_recovery(bench_trial *t)
{
    double fastest = 0.0, highest = 0.0;
    for (int32_t i = 1; i <= OVERLAP_BOXES; i++) {
        fastest = fmax(fastest, t->tracks[i].speed);
        highest = fmax(highest, t->tracks[i].highest);
    }
    const double load = 4.0 * GRAVITY / bench_contact_stiffness(t, 0); // four boxes above the lowest interface, at most
    bench_expect(t, "deepest overlap after 2 s, m", t->notes[0], 0.0, load + 2.0 * BENCH_LINEAR_SLOP);
    bench_expect(t, "largest speed, m/s (push-out 3)", fastest, 0.0, 3.0 + GRAVITY * 0.5);
    bench_expect(t, "highest centre, m", highest, 0.0, 4.5);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

// ---- rush: 400 balls pulled to a point -----------------------------------------------------------------------------

enum { RUSHING = 400 };

static void build_rush(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.5, 100.0, 0.2);
    double distance = 5.0, angle = 0.0;
    bench_add_static(s, ball, 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < RUSHING; i++) {
        const int32_t body = bench_add_dynamic(s, ball, distance * cos(angle), distance * sin(angle), 0.0);
        s->bodies[body].gravity_scale = 0.0f;
        s->bodies[body].linear_locks = 4, s->bodies[body].angular_locks = 3;
        angle += 0.2;
        distance += 0.05;
    }
    s->gravity[1] = 0.0;
}

static void act_rush(bench_trial *t)
{
    for (int32_t i = 1; i <= RUSHING; i++) {
        const double *p = t->poses[i].position, distance = hypot(p[0], p[1]);
        if (distance < 0.1) continue;
        const double force[3] = {-1000.0 * p[0] / distance, -1000.0 * p[1] / distance, 0.0};
        bench_trial_push(t, i, force);
    }
}

static void judge_rush(bench_trial *t)
{
    double squares = 0.0, sum = 0.0;
    for (int32_t i = 1; i <= RUSHING; i++) {
        const double *p = t->poses[i].position;
        squares += p[0] * p[0] + p[1] * p[1];
        sum += bench_speed(t, i) * bench_speed(t, i);
    }
    // 401 discs cover 315 m2: packed as densely as discs can be, a disc of 10.5 m; loosely (0.77, what friction can
    // hold up), one of 11.4 m. The squared distances of an even disc have the mean R2 / 2.
    bench_expect(t, "radius of the crowd, m", sqrt(2.0 * squares / RUSHING), 10.0, 11.5);
    bench_expect(t, "speed of the balls (rms), m/s", sqrt(sum / RUSHING), 0.0, 0.2);
    // At the centre discs press each other with F = pressure x diameter / sqrt 3, 6.8 kN, on average. Forces in a
    // jammed crowd are spread like exp(-1.5 F / mean) (Mueth, Jaeger, Nagel 1998): of 1200 contacts the largest bears
    // some ln(1200) / 1.5 = 4.7 times that.
    const double mass = t->masses[1], mean = 6800.0 / (0.5 * mass * bench_contact_stiffness(t, 0));
    bench_expect(t, BENCH_DEEPEST, bench_deepest(t), 0.0, 4.7 * mean + BENCH_LINEAR_SLOP);
}

// ---- double domino -------------------------------------------------------------------------------------------------

enum { DOMINOES = 15 };

static void add_dominoes(bench_scene *s, double half_depth, double density, double pitch)
{
    const int32_t domino = bench_box(s, 0.125, 0.5, half_depth, density, 0.6);
    bench_add_ground(s, 100.0, 0.6);
    for (int32_t i = 0; i < DOMINOES; i++) bench_add_dynamic(s, domino, -7.5 + pitch * i, 0.5, 0.0);
}

static void build_double_domino(bench_scene *s) { add_dominoes(s, 0.5, 1.0, 1.0); }

static void build_domino_row(bench_scene *s) { add_dominoes(s, 0.25, 4.0, 1.01); }

static void act_double_domino(bench_trial *t)
{
    const double impulse[3] = {0.2, 0.0, 0.0}, point[3] = {-7.5, 1.0, 0.0};
    if (t->step == 0) bench_trial_hit(t, 1, impulse, point);
}

// note i: when domino i had fallen half way, s
static void watch_double_domino(bench_trial *t)
{
    for (int32_t i = 1; i <= DOMINOES; i++) {
        if (t->notes[i] == 0.0 && bench_tilt(t, i) > 0.25 * BENCH_PI) t->notes[i] = t->time;
    }
}

static void judge_double_domino(bench_trial *t)
{
    int32_t fallen = 0, ordered = 1;
    for (int32_t i = 1; i <= DOMINOES; i++) {
        fallen += t->notes[i] > 0.0;
        if (i > 1 && t->notes[i] < t->notes[i - 1]) ordered = 0;
    }
    // a chain of smooth dominoes that do not bounce runs at 4.69 m/s = 1.48 sqrt(g h) in the end; friction slows it to
    // a steady speed of its own
    const double pitch = t->scene.bodies[2].start.position[0] - t->scene.bodies[1].start.position[0];
    const double early = 4.0 * pitch / (t->notes[9] - t->notes[5]), late = 5.0 * pitch / (t->notes[14] - t->notes[9]);
    bench_expect(t, "dominoes fallen", fallen, DOMINOES, DOMINOES);
    bench_expect(t, "in their order", ordered, 1, 1);
    bench_expect(t, "speed of the front, m/s", late, 0.0, 1.05 * 4.69);
    bench_expect(t, "late speed / early speed", late / early, 0.9, 1.15);
    bench_expect(t, "largest rise of the energy, J", bench_rise(t->energy, 1, t->step), 0.0, 1e-3 * t->energy[1]);
}

// ---- confined: more balls than fit ---------------------------------------------------------------------------------

enum { CROWD_SIDE = 25, WALLS = 4 };

static void add_wall(bench_scene *s, double half_height, double x, double y, double angle)
{
    const int32_t wall = bench_add_static(s, bench_capsule(s, half_height, 0.5, 1.0, 0.6), x, y, 0.0);
    bench_turn_z(&s->bodies[wall], angle);
}

static void build_confined(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.5, 1.0, 0.6);
    add_wall(s, 10.5, 0.0, 0.0, 0.5 * BENCH_PI);
    add_wall(s, 10.25, -10.5, 10.25, 0.0);
    add_wall(s, 10.25, 10.5, 10.25, 0.0);
    add_wall(s, 10.5, 0.0, 20.5, 0.5 * BENCH_PI);
    for (int32_t i = 0; i < CROWD_SIDE * CROWD_SIDE; i++) {
        const int32_t body =
            bench_add_dynamic(s, ball, -8.75 + 0.72 * (i % CROWD_SIDE), 1.5 + 0.72 * (i / CROWD_SIDE), 0.0);
        s->bodies[body].linear_locks = 4, s->bodies[body].angular_locks = 3;
    }
    s->gravity[1] = 0.0;
}

static void judge_confined(bench_trial *t)
{
    const double count = CROWD_SIDE * CROWD_SIDE;
    double out = -HUGE_VAL, sum = 0.0;
    for (int32_t i = WALLS; i < t->scene.body_count; i++) {
        const double *p = t->poses[i].position;
        out = fmax(out, fmax(fabs(p[0]) - 10.5, fmax(p[1] - 20.5, -p[1])));
        sum += bench_speed(t, i) * bench_speed(t, i);
    }
    bench_expect(t, "farthest centre beyond the walls' middle, m", out, -10.0, 0.0);
    bench_expect(t, "speed of the balls (rms), m/s", sqrt(sum / count), 0.0, 0.5);
    bench_expect(t, BENCH_DEEPEST, bench_deepest(t), 0.0, 0.5);
}

// ---- card house (after PEEL) ---------------------------------------------------------------------------------------

static void add_card(bench_scene *s, int32_t card, double x, double y, double degrees)
{
    const int32_t body = bench_add_dynamic(s, card, x, y, 0.0);
    bench_turn_z(&s->bodies[body], degrees * BENCH_PI / 180.0);
}

static void build_card_house(bench_scene *s)
{
    const int32_t card = bench_box(s, 0.001, 0.2, 0.1, 1.0, 0.7);
    double first = 0.0, y = 0.18;
    bench_add_static(s, bench_box(s, 40.0, 2.0, 40.0, 1.0, 0.7), 0.0, -2.0, 0.0);
    for (int32_t level = 5; level > 0; level--, y += 0.37, first += 0.175) {
        double x = first;
        for (int32_t i = 0; i < level; i++) {
            if (i != level - 1) add_card(s, card, x + 0.25, y + 0.185, 90.0);
            add_card(s, card, x, y, -25.0);
            x += 0.175;
            add_card(s, card, x, y, 25.0);
            x += 0.175;
        }
    }
}

static void judge_card_house(bench_trial *t)
{
    double way_of_any = 0.0;
    for (int32_t i = 1; i < t->scene.body_count; i++) way_of_any = fmax(way_of_any, way(t, i));
    bench_expect_stray(t, "largest way of a card, m", way_of_any, 0.05);
    bench_expect(t, BENCH_TILT, bench_largest_tilt(t), 0.0, 5.0 * BENCH_PI / 180.0);
}

const bench_case bench_solver2d_contact[] = {
    {"friction-ramp", "Solver2D", "boxes of falling friction on three ramps", 10.0, 1, build_friction_ramp, NULL, NULL,
     judge_friction_ramp, BENCH_CALM},
    {"friction-slope", "derived", "the same boxes laid on one slope", 4.0, 1, build_friction_slope, NULL, NULL,
     judge_friction_slope, BENCH_CALM},
    {"overlap-recovery", "Solver2D", "a pyramid pushed together by a quarter", 5.0, 1, build_overlap_recovery, NULL,
     watch_overlap_recovery, judge_overlap_recovery, BENCH_CALM},
    {"rush", "Solver2D", "400 balls pulled to a point", 10.0, 1, build_rush, act_rush, NULL, judge_rush,
     BENCH_CHAOTIC_LONG},
    {"double-domino", "Solver2D", "15 dominoes", 10.0, 1, build_double_domino, act_double_domino, watch_double_domino,
     judge_double_domino, BENCH_CHAOTIC},
    {"domino-row", "Box3D", "15 dominoes, narrower and farther apart", 10.0, 0, build_domino_row, act_double_domino,
     watch_double_domino, judge_double_domino, BENCH_CHAOTIC},
    {"confined", "Solver2D", "625 balls where 450 fit", 20.0, 1, build_confined, NULL, NULL, judge_confined,
     BENCH_CALM},
    {"card-house", "Solver2D, PEEL", "40 cards of 2 mm", 10.0, 1, build_card_house, NULL, NULL, judge_card_house,
     BENCH_CHAOTIC},
};
const int32_t bench_solver2d_contact_count =
    (int32_t)(sizeof bench_solver2d_contact / sizeof bench_solver2d_contact[0]);
