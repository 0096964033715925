// Random scenes of everything at once: heightfield, boxes, a lift, triggers, bodies of all forms with locks, joints of
// all types with limits, springs, motors and breaking. Nothing becomes NaN or is lost, no energy comes from nowhere,
// one worker and eight compute the same.
//
//   test_mixed_scenes [count [first]]    so many scenes, 600 steps each; a part of them without arguments
//
// A scene is made from its number alone, with one draw at a time: C does not say which argument of a call comes first.
// By turns: with springs and motors; without, so that energy never rises; with a lift, whose work nobody counts.
#include "scenes/joint_scene.h"
#include "scenes/terrain.h"

#include <stdlib.h>

enum { CELLS = 20, MOST_BODIES = 64, COLUMNS = 5 };
#if SLOW_BUILD
enum { USUAL = 3, STEPS = 150 };
#else
enum { USUAL = 12, STEPS = 600 };
#endif

#define RIM 10.0  // m from the middle of the basin to its border
#define DEEP -1.5 // m, below the lowest ground, which is at -0.5, by more than any body reaches

static int first_scene, scene_count = USUAL;

typedef struct arena {
    scene s;
    fe_body bodies[MOST_BODIES];
    fe_joint joints[MOST_BODIES];
    int count, joint_count;
    double power;  // the most that motors give, W
    double weight; // N, of all bodies
    double lowest; // J, with what is held in joints, so far
    int has_lift, has_drives;
    fe_body lift;
} arena;

// A basin with hills whose border nobody climbs: to 40 m
static double basin(double x, double z)
{
    double r = (x * x + z * z) / (RIM * RIM);
    return 0.25 * sin(1.1 * x) + 0.25 * cos(0.9 * z) + 20.0 * r * r;
}

static fe_material any_material(dice *d)
{
    fe_material m = friction(uniform(d, 0.1, 1));
    if (pick(d, 4) == 0) m.restitution = (float)uniform(d, 0, 0.8);
    if (pick(d, 3) == 0) m.rolling_resistance = (float)uniform(d, 0, 0.2);
    if (pick(d, 3) == 0) m.spinning_resistance = (float)uniform(d, 0, 0.02);
    return m;
}

static void add_surroundings(arena *a, dice *d)
{
    const double cell = 2 * RIM / CELLS;
    add_field(&a->s, CELLS, cell, -RIM, -RIM, basin, friction(uniform(d, 0.3, 1)));
    for (int i = pick(d, 4); i > 0; --i) {
        fe_geometry form = any_form(d, 2);
        double x = uniform(d, -4, 4), y = uniform(d, 0, 1), z = uniform(d, -4, 4);
        fe_quat rotation = any_rotation(d);
        add_static(&a->s, form, v3(x, y, z), rotation, any_material(d));
    }
    fe_shape trigger;
    fe_body place = add_static(&a->s, box(2, 1, 2), v3(0, 1, 0), any_rotation(d), friction(0.5));
    MUST(fe_body_get_shapes(a->s.world, place, &trigger, 1));
    MUST(fe_shape_set_trigger(a->s.world, trigger, 1));
    if (!a->has_lift) return;
    a->lift = add_body(&a->s, FE_BODY_KINEMATIC, box(1.5, 0.2, 1.5), v3(0, 1, 0), UNTURNED, friction(0.8), WATER);
}

static fe_body add_any(arena *a, dice *d, vec at)
{
    double size = uniform(d, 0.6, 1), density = uniform(d, 300, 3000);
    fe_geometry form = any_form(d, size);
    fe_quat rotation = any_rotation(d);
    return add_dynamic(&a->s, form, at, rotation, any_material(d), (float)density);
}

static void add_bodies(arena *a, dice *d)
{
    const int count = 20 + pick(d, MOST_BODIES - 20);
    for (int i = 0; i < count; ++i) {
        // apart from each other and above ground and statics: overlaps at birth would give energy
        vec at = v3(1.4 * (i % COLUMNS - 2), 4 + 1.4 * (i / (COLUMNS * COLUMNS)), 1.4 * (i / COLUMNS % COLUMNS - 2));
        fe_body body = add_any(a, d, at);
        vec velocity = somewhere(d, 2);
        set_velocity(&a->s, body, velocity, somewhere(d, 3));
        if (pick(d, 8) == 0) {
            uint32_t linear = (uint32_t)pick(d, 8) & 5u, angular = (uint32_t)pick(d, 8);
            MUST(fe_body_set_locks(a->s.world, body, linear, angular));
        }
        if (pick(d, 2) == 0) MUST(fe_body_set_sleep_allowed(a->s.world, body, 1));
        float damping = pick(d, 5) == 0 ? (float)uniform(d, 0, 1) : 0;
        if (damping > 0) MUST(fe_body_set_damping(a->s.world, body, damping, (float)uniform(d, 0, 1)));
        if (pick(d, 10) == 0) MUST(fe_body_set_bullet(a->s.world, body, 1));
        a->weight += mass_of(&a->s, body) * G;
        a->bodies[a->count++] = body;
    }
}

static void join_by_hinge(arena *a, dice *d, fe_body one, fe_body two, vec point)
{
    fe_hinge_joint_def h = hinge_def();
    h.limit_enabled = pick(d, 2), h.lower = -(float)uniform(d, 0, 2), h.upper = (float)uniform(d, 0, 2);
    if (a->has_drives && pick(d, 2)) h.motor_speed = (float)uniform(d, -5, 5), h.motor_max = (float)uniform(d, 1, 100);
    a->power += fabs((double)h.motor_speed) * (double)h.motor_max;
    a->joints[a->joint_count++] = add_hinge(&a->s, h, one, two, point, somewhere(d, 1));
}

static void join_by_six_axes(arena *a, dice *d, fe_body one, fe_body two, vec point)
{
    fe_configurable_joint_def six = configurable_def();
    for (int k = 0; k < 6; ++k) {
        fe_joint_axis *axis = &six.axes[k];
        axis->motion = pick(d, 2) ? FE_MOTION_LOCKED : FE_MOTION_LIMITED;
        axis->lower = -(float)uniform(d, 0, 0.5), axis->upper = (float)uniform(d, 0, 0.5);
        if (axis->motion == FE_MOTION_LOCKED || !a->has_drives || pick(d, 2)) continue;
        axis->spring = FE_SPRING_HERTZ, axis->spring_hertz = (float)uniform(d, 1, 10),
        axis->spring_damping_ratio = (float)uniform(d, 0.1, 1);
    }
    a->joints[a->joint_count++] = add_configurable(&a->s, six, one, two, point, somewhere(d, 1));
}

static void join_somehow(arena *a, dice *d, fe_body one, fe_body two)
{
    vec p = position(&a->s, one), q = position(&a->s, two), middle = times(0.5, plus(p, q));
    fe_ball_joint_def ball = ball_def();
    fe_fixed_joint_def fixed = fixed_def();
    fe_distance_joint_def spring = distance_def();
    switch (pick(d, 5)) {
    case 0:
        ball.cone_enabled = pick(d, 2), ball.cone_y = (float)uniform(d, 0.2, 1.5),
        ball.cone_z = (float)uniform(d, 0.2, 1.5);
        ball.motor_max = (float)uniform(d, 0, 5); // a friction
        a->joints[a->joint_count++] = add_ball(&a->s, ball, one, two, middle, somewhere(d, 1));
        break;
    case 1:
        join_by_hinge(a, d, one, two, middle);
        break;
    case 2:
        fixed.break_force = pick(d, 2) ? (float)uniform(d, 1e3, 1e5) : 0.0f;
        a->joints[a->joint_count++] = add_fixed(&a->s, fixed, one, two, middle);
        break;
    case 3:
        spring.lower = 0.3f, spring.upper = 3, spring.target = (float)length(minus(p, q));
        spring.spring_hertz = a->has_drives ? (float)uniform(d, 1, 10) : 0.0f,
        spring.spring_damping_ratio = (float)uniform(d, 0.1, 1);
        a->joints[a->joint_count++] = add_distance(&a->s, spring, one, two, p, q);
        break;
    default:
        join_by_six_axes(a, d, one, two, middle);
    }
}

static arena build_arena(int number, int workers)
{
    static const int substeps[] = {8, 4, 8, 12};
    dice d = {(uint64_t)number * 6364136223u + 99};
    arena a = {.has_lift = number % 3 == 2, .has_drives = number % 3 != 1};
    fe_world_def def;
    a.s = (scene){NULL, UNTURNED, substeps[number % 4], STEP / substeps[number % 4]};
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers, def.substeps = a.s.substeps, def.gravity = fe_make_vec3(0, -(float)G, 0);
    MUST(fe_world_create(&def, &a.s.world));
    add_surroundings(&a, &d);
    add_bodies(&a, &d);
    // neighbours of a row, once each: no body meets the far end of its own chain
    const int every = 1 + pick(&d, 6);
    for (int k = 0; k + 1 < a.count; ++k)
        if (k % COLUMNS != COLUMNS - 1 && pick(&d, every) == 0) join_somehow(&a, &d, a.bodies[k], a.bodies[k + 1]);
    return a;
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    MUST(fe_world_hash(world, words));
    return (uint64_t)words[1] << 32 | words[0];
}

// Up and down, 1 m within 2 s
static void move_lift(arena *a, int step)
{
    if (a->has_lift) set_velocity(&a->s, a->lift, v3(0, step / 60 % 2 ? -0.5 : 0.5, 0), v3(0, 0, 0));
}

static void nobody_is_lost(const arena *a)
{
    for (int i = 0; i < a->count; ++i) {
        fe_transform t = body_transform(a->s.world, a->bodies[i]);
        double x = t.rotation.x, y = t.rotation.y, z = t.rotation.z, w = t.rotation.w;
        FE_WITHIN(t.position.x, -RIM, RIM);
        FE_WITHIN(t.position.z, -RIM, RIM);
        FE_WITHIN(t.position.y, DEEP, 40);
        FE_NEAR(x * x + y * y + z * z + w * w, 1, 4e-7); // four rounded components
        FE_WITHIN(length(widen(body_angular_velocity(a->s.world, a->bodies[i]))), 0, 1e3);
    }
}

// What the gaps of the joints hold as springs of 60 Hz on the masses of both ends, at most: on the heavier body's
static double held_in_joints(const arena *a)
{
    double w = 2 * PI * 60, sum = 0;
    for (int i = 0; i < a->joint_count; ++i) {
        fe_body ends[2];
        double mass = 0, moment = 0;
        if (!fe_joint_is_valid(a->s.world, a->joints[i])) continue; // it broke
        fe_joint_state at = state_of(&a->s, a->joints[i]);
        MUST(fe_joint_get_bodies(a->s.world, a->joints[i], ends, ends + 1));
        for (int k = 0; k < 2; ++k) {
            fe_mass_data data = mass_data_of(&a->s, ends[k]);
            mass = fmax(mass, (double)data.mass);
            moment = fmax(moment, fmax((double)data.inertia.x, fmax((double)data.inertia.y, (double)data.inertia.z)));
        }
        sum += 0.5 * w * w *
               (mass * (double)(at.linear_error * at.linear_error) +
                moment * (double)(at.angular_error * at.angular_error));
    }
    return sum;
}

// What the motors gave so far is all that may come in. What soft contacts hold under their load, a millimetre of it,
// goes in and out; a body that a heavy one pins to the ground in its fall gives back some parts in a thousand of the
// fall. Where other forces than gravity act, the scheme's energy is off by h/2 g.v.
static void no_energy_came_in(arena *a, const totals *start, int step)
{
    totals now = totals_of(&a->s, a->bodies, a->count);
    const double scheme = 0.5 * a->s.h * sqrt(2 * now.kinetic * a->weight * G);
    const double allowed = 0.001 * a->weight + 0.005 * now.kinetic + scheme;
    if (step == 1) a->lowest = start->energy;
    FE_WITHIN(now.energy, -1e30, (a->has_drives ? start->energy + a->power * step * STEP : a->lowest) + allowed);
    a->lowest = fmin(a->lowest, now.energy + held_in_joints(a));
}

static void play(int number)
{
    arena one = build_arena(number, 1), eight = build_arena(number, 8);
    totals start = totals_of(&one.s, one.bodies, one.count);
    for (int step = 1; step <= STEPS; ++step) {
        move_lift(&one, step);
        move_lift(&eight, step);
        run(&one.s, 1);
        run(&eight.s, 1);
        FE_TRUE(hash_of(one.s.world) == hash_of(eight.s.world));
        nobody_is_lost(&one);
        if (!one.has_lift) no_energy_came_in(&one, &start, step);
    }
    scene_end(&one.s);
    scene_end(&eight.s);
}

// Heavy bodies that are locked in different ways hold a light one between them, in poses in which hardly any way leads
// on
static void linkages_of_locked_bodies_do_not_fly_apart(void **state)
{
    enum { LOCKED_LINKAGE = 165 };
    (void)state;
    play(LOCKED_LINKAGE);
}

static void mixed_scenes_hold_the_laws_at_every_step(void **state)
{
    (void)state;
    for (int number = first_scene; number < first_scene + scene_count; ++number) {
        if (scene_count != USUAL) print_message("scene %d\n", number);
        play(number);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(linkages_of_locked_bodies_do_not_fly_apart),
                                       cmocka_unit_test(mixed_scenes_hold_the_laws_at_every_step)};
    if (argc > 1) scene_count = atoi(argv[1]);
    if (argc > 2) first_scene = atoi(argv[2]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
