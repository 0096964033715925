// Free flight, forces, damping and axis locks against exact answers: the discrete ones of  v += h a; x += h v  (P3), h
// the substep.
//
// Velocities are floats: tolerances are the rounding of that many additions (see scene.h).
#include "scene.h"

static setup one_substep = {{0, 0, 0, 1}, 1};

// ---- free flight ---------------------------------------------------------------------------------------------------

// y = g t (t + h) / 2 after 1 s, 10 mm more than g t^2 / 2 at 8 substeps; v = g t
static void free_fall_takes_the_discrete_way(void **state)
{
    scene s = scene_begin(state);
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 60);
    double t = 60 * STEP, error = rounding(60 * s.substeps), way = discrete_way(G, t, s.h);
    FE_NEAR(-position(&s, ball).y, way, way * error);
    FE_NEAR(-velocity(&s, ball).y, G * t, G * t * error);
    FE_NEAR(hypot(position(&s, ball).x, position(&s, ball).z), 0, way * error);
    scene_end(&s);
}

static void a_projectile_keeps_its_horizontal_velocity(void **state)
{
    scene s = scene_begin(state);
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, ball, v3(6, 8, -3), v3(0, 0, 0));
    run(&s, 90);
    double t = 90 * STEP, error = length(v3(6, 8, -3)) * t * rounding(90 * s.substeps);
    vec p = position(&s, ball);
    FE_NEAR(p.x, 6 * t, error);
    FE_NEAR(p.y, 8 * t - discrete_way(G, t, s.h), error);
    FE_NEAR(p.z, -3 * t, error);
    scene_end(&s);
}

static double energy_per_mass(const scene *s, fe_body body)
{
    vec v = velocity(s, body);
    return dot(v, v) / 2 + G * position(s, body).y;
}

// E(t) - E(0) = -m g^2 h t / 2: less in every single step
static void free_flight_only_loses_the_energy_of_the_discrete_scheme(void **state)
{
    scene s = scene_begin(state);
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, ball, v3(6, 8, -3), v3(0, 0, 0));
    double first = energy_per_mass(&s, ball), before = first, now = first;
    for (int i = 0; i < 90; ++i, before = now) {
        run(&s, 1);
        now = energy_per_mass(&s, ball);
        FE_TRUE(now < before);
    }
    FE_NEAR(now - first, -G * G * s.h * 90 * STEP / 2, 2 * first * rounding(90 * s.substeps));
    scene_end(&s);
}

// ---- forces and damping --------------------------------------------------------------------------------------------

// v = F t / m, and not one bit more once the calls end
static void a_force_acts_in_all_substeps_of_the_next_step_only(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body ball = add_dynamic(&s, sphere(0.25), v3(0, 0, 0), UNTURNED, friction(0.6), 500);
    double mass = 500 * 4.0 / 3 * PI * pow(0.25, 3);
    for (int i = 0; i < 60; ++i) {
        add_force(&s, ball, v3(10, 0, 0));
        run(&s, 1);
    }
    vec v = velocity(&s, ball);
    FE_NEAR(v.x, 10 * 60 * STEP / mass, v.x * rounding(60 * s.substeps));
    run(&s, 10);
    FE_TRUE(length(minus(velocity(&s, ball), v)) == 0);
    scene_end(&s);
}

// w = M t / I about each principal axis of a box
static void a_torque_spins_a_box_by_its_principal_moment(void **state)
{
    const double half[3] = {1, 0.5, 0.25}, mass = WATER * 8 * 1 * 0.5 * 0.25;
    for (int k = 0; k < 3; ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        fe_body block = add_dynamic(&s, box(half[0], half[1], half[2]), v3(1, 2, 3), UNTURNED, friction(0.6), WATER);
        double u = half[(k + 1) % 3], v = half[(k + 2) % 3], inertia = mass / 3 * (u * u + v * v);
        vec axis = v3(k == 0, k == 1, k == 2);
        for (int i = 0; i < 120; ++i) {
            add_torque(&s, block, times(500, axis));
            run(&s, 1);
        }
        double w = 500 * 120 * STEP / inertia;
        FE_NEAR(dot(spin(&s, block), axis), w, w * rounding(120 * s.substeps));
        FE_NEAR(length(minus(spin(&s, block), times(w, axis))), 0, w * rounding(120 * s.substeps));
        FE_NEAR(length(minus(position(&s, block), v3(1, 2, 3))), 0, 1e-15);
        scene_end(&s);
    }
}

// v = v0 / (1 + h c)^n: 0.13548 v0 after 4 s at c = 0.5, where the exponential has 0.13534 v0. Factor and product are
// both rounded.
static void damping_follows_its_discrete_law(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_damping(s.world, ball, 0.5f, 0.25f));
    set_velocity(&s, ball, v3(3, -1, 2), v3(1, 4, -2));
    run(&s, 240);
    int n = 240 * s.substeps;
    double left = pow(1 + s.h * 0.5, -n), spin_left = pow(1 + s.h * 0.25, -n);
    FE_NEAR(length(minus(velocity(&s, ball), times(left, v3(3, -1, 2)))), 0, left * 4 * rounding(2 * n));
    FE_NEAR(length(minus(spin(&s, ball), times(spin_left, v3(1, 4, -2)))), 0, spin_left * 5 * rounding(2 * n));
    scene_end(&s);
}

// Above the limit a velocity is cut to it and keeps its direction; below, and for the spin, nothing happens.
static void the_speed_limit_cuts_and_keeps_the_direction(void **state)
{
    const vec fast = v3(300, -900, 400), slow = v3(29, 0, 40), w = v3(0, 70, 0);
    scene s = scene_begin(state);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.max_linear_speed = 50;
    MUST(fe_world_set_tuning(s.world, &tuning));
    set_gravity(&s, v3(0, 0, 0));
    fe_body a = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    fe_body b = add_dynamic(&s, sphere(0.5), v3(0, 0, 9), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, a, fast, w), set_velocity(&s, b, slow, w);
    run(&s, 1);
    double error = 50 * rounding(s.substeps);
    FE_NEAR(length(minus(velocity(&s, a), times(50 / length(fast), fast))), 0, error);
    FE_NEAR(length(position(&s, a)), 50 * STEP, error * STEP);
    FE_NEAR(length(minus(velocity(&s, b), slow)), 0, error);
    FE_NEAR(length(minus(spin(&s, a), w)), 0, 70 * rounding(s.substeps));
    scene_end(&s);
}

// ---- locks ---------------------------------------------------------------------------------------------------------

enum { LINEAR_BITS = 7, ALL_LOCKS = 64 };

static double component(vec a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

// A box above the ground, pushed into the corner of two walls, twisted, and hit by a ball. Where it turns about one
// axis only, it starts turned about that one.
static fe_body add_locked_box(scene *s, uint32_t linear, uint32_t angular)
{
    uint32_t free_axes = ~angular & FE_AXIS_ALL;
    int about_one = free_axes && !(free_axes & (free_axes - 1));
    vec axis = about_one ? v3(free_axes == FE_AXIS_X, free_axes == FE_AXIS_Y, free_axes == FE_AXIS_Z) : v3(1, -2, 1.5);
    fe_body block = add_dynamic(s, box(0.5, 0.3, 0.4), v3(0.25, 1.5, -0.125), turned(axis, 0.4), friction(0.6), WATER);
    MUST(fe_body_set_locks(s->world, block, linear, angular));
    return block;
}

static void check_locks(const scene *s, fe_body block, uint32_t linear, uint32_t angular, fe_transform first)
{
    fe_transform now = body_transform(s->world, block);
    vec w = spin(s, block), v = velocity(s, block);
    uint32_t turns = ~angular & FE_AXIS_ALL;
    for (int k = 0; k < 3; ++k) {
        if (linear >> k & 1)
            FE_TRUE(component(now.position, k) == component(first.position, k) && component(v, k) == 0);
        if (angular >> k & 1) FE_TRUE(component(w, k) == 0);
    }
    const float *q = &now.rotation.x, *q0 = &first.rotation.x;
    if (!turns)
        for (int k = 0; k < 4; ++k) FE_TRUE(q[k] == q0[k]);
    if (turns == FE_AXIS_X) FE_TRUE(q[1] == 0 && q[2] == 0);
    if (turns == FE_AXIS_Y) FE_TRUE(q[0] == 0 && q[2] == 0);
    if (turns == FE_AXIS_Z) FE_TRUE(q[0] == 0 && q[1] == 0);
}

static void run_locked(uint32_t linear, uint32_t angular)
{
    scene s = scene_begin(NULL);
    add_ground(&s, friction(0.3));
    add_plane(&s, v3(-1, 0, 0), -3, friction(0.3));
    add_plane(&s, v3(0, 0, -1), -3, friction(0.3));
    fe_body block = add_locked_box(&s, linear, angular);
    fe_body ball = add_dynamic(&s, sphere(0.3), v3(0.3, 4, 0.1), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, ball, v3(0.5, -5, -0.5), v3(0, 0, 0));
    fe_transform first = body_transform(s.world, block);
    vec farthest = v3(0, 0, 0), fastest = v3(0, 0, 0);
    for (int i = 0; i < 600; ++i) {
        add_force(&s, block, v3(9000, 50, 7000));
        add_torque(&s, block, v3(2000, -1500, 1800));
        run(&s, 1);
        check_locks(&s, block, linear, angular, first);
        vec d = minus(position(&s, block), first.position), w = spin(&s, block);
        farthest = v3(fmax(farthest.x, fabs(d.x)), fmax(farthest.y, fabs(d.y)), fmax(farthest.z, fabs(d.z)));
        fastest = v3(fmax(fastest.x, fabs(w.x)), fmax(fastest.y, fabs(w.y)), fmax(fastest.z, fabs(w.z)));
    }
    for (int k = 0; k < 3; ++k) {
        if (!(linear >> k & 1)) FE_TRUE(component(farthest, k) > LINEAR_SLOP);
        if (!(angular >> k & 1)) FE_TRUE(component(fastest, k) > 0.01);
    }
    scene_end(&s);
}

static void locked_coordinates_stay_bit_for_bit_and_free_ones_move(void **state)
{
    (void)state;
    for (uint32_t locks = 1; locks < ALL_LOCKS; ++locks) run_locked(locks & LINEAR_BITS, locks >> 3);
}

// Locked along the ground's normal, a body rests on its lock and the ground has nothing to carry: no friction, also
// where rounding tilts the normal
static void the_ground_does_not_hold_what_cannot_move_into_it(void **state)
{
    const double tilts[] = {0, 1e-7, -1e-7};
    for (int i = 0; i < 3; ++i) {
        scene s = scene_begin(state);
        add_plane(&s, v3(tilts[i], 1, 0), 0, friction(0.6));
        fe_body block = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(0, 0.499, 0), UNTURNED, friction(0.6), WATER);
        MUST(fe_body_set_locks(s.world, block, FE_AXIS_Y, FE_AXIS_ALL));
        for (int k = 0; k < 60; ++k) {
            add_force(&s, block, v3(3000, 0, 1000));
            run(&s, 1);
        }
        double t = 60 * STEP / 1000;
        FE_NEAR(velocity(&s, block).x, 3000 * t, 3000 * t * rounding(60 * s.substeps));
        FE_NEAR(velocity(&s, block).z, 1000 * t, 3000 * t * rounding(60 * s.substeps));
        scene_end(&s);
    }
}

// Same bits as a body that never had a lock, and beside a locked body that it does not touch
static void locks_taken_off_leave_no_trace(void **state)
{
    fe_transform end[2];
    for (int i = 0; i < 2; ++i) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.3));
        fe_body block = add_locked_box(&s, 0, 0);
        if (i) {
            MUST(fe_body_set_locks(s.world, block, FE_AXIS_X, FE_AXIS_ALL));
            MUST(fe_body_set_locks(s.world, block, 0, 0));
            fe_body other = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(50, 0.4, 0), UNTURNED, friction(0.6), WATER);
            MUST(fe_body_set_locks(s.world, other, FE_AXIS_Z, FE_AXIS_X));
        }
        for (int k = 0; k < 120; ++k) {
            add_torque(&s, block, v3(2000, -1500, 1800));
            run(&s, 1);
        }
        end[i] = body_transform(s.world, block);
        scene_end(&s);
    }
    const float *p = &end[0].rotation.x, *q = &end[1].rotation.x;
    FE_TRUE(length(minus(end[0].position, end[1].position)) == 0);
    for (int k = 0; k < 4; ++k) FE_TRUE(p[k] == q[k]);
}

// A rod of 12 kg, 0.2 x 0.2 x 2 m, at 45 degrees to its axle has 2.06 kg m2 about it; 1 / (I^-1)yy would be 0.32
static void a_body_on_an_axle_has_its_exact_inertia(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body rod = add_dynamic(&s, box(1, 0.1, 0.1), v3(0, 0, 0), turned(v3(0, 0, 1), PI / 4), friction(0.6), 150);
    MUST(fe_body_set_locks(s.world, rod, 0, FE_AXIS_X | FE_AXIS_Z));
    for (int i = 0; i < 60; ++i) {
        add_torque(&s, rod, v3(0, 2.06, 0));
        run(&s, 1);
    }
    FE_NEAR(spin(&s, rod).y, 60 * STEP, rounding(60 * s.substeps));
    scene_end(&s);
}

// world inertia R diag(I) R^T of that rod
static void world_inertia(const scene *s, fe_body rod, double out[3][3])
{
    const double principal[3] = {0.08, 4.04, 4.04};
    vec axis[3] = {axis_of(s, rod, v3(1, 0, 0)), axis_of(s, rod, v3(0, 1, 0)), axis_of(s, rod, v3(0, 0, 1))};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            out[i][j] = 0;
            for (int k = 0; k < 3; ++k) out[i][j] += principal[k] * component(axis[k], i) * component(axis[k], j);
        }
}

// With one axis locked, the two free ones u, v obey  (I_uu I_uv; I_uv I_vv) w' = M. Inertia is that of the step's
// beginning: one step is exact.
static void two_free_axes_turn_by_the_inertia_between_them(void **state)
{
    for (int locked = 0; locked < 3; ++locked) {
        scene s = scene_begin(state);
        int u = (locked + 1) % 3, v = (locked + 2) % 3;
        double inertia[3][3], t[3] = {0.5, -0.3, 0.4};
        set_gravity(&s, v3(0, 0, 0));
        fe_body rod = add_dynamic(&s, box(1, 0.1, 0.1), v3(0, 0, 0), turned(v3(1, 2, -1.5), 1.1), friction(0.6), 150);
        MUST(fe_body_set_locks(s.world, rod, 0, 1u << locked));
        world_inertia(&s, rod, inertia);
        add_torque(&s, rod, v3(t[0], t[1], t[2]));
        run(&s, 1);
        double det = inertia[u][u] * inertia[v][v] - inertia[u][v] * inertia[u][v];
        double wu = STEP * (inertia[v][v] * t[u] - inertia[u][v] * t[v]) / det,
               wv = STEP * (inertia[u][u] * t[v] - inertia[u][v] * t[u]) / det;
        double error =
            hypot(wu, wv) * rounding(s.substeps) * inertia[u][u] * inertia[v][v] / det; // the difference cancels digits
        FE_NEAR(component(spin(&s, rod), u), wu, error);
        FE_NEAR(component(spin(&s, rod), v), wv, error);
        FE_TRUE(component(spin(&s, rod), locked) == 0);
        scene_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(free_fall_takes_the_discrete_way),
        WITH_4_SUBSTEPS(free_fall_takes_the_discrete_way),
        EVERY_WAY_UP(a_projectile_keeps_its_horizontal_velocity),
        WITH_4_SUBSTEPS(a_projectile_keeps_its_horizontal_velocity),
        EVERY_WAY_UP(free_flight_only_loses_the_energy_of_the_discrete_scheme),
        WITH_4_SUBSTEPS(free_flight_only_loses_the_energy_of_the_discrete_scheme),
        TEST_WITH(free_flight_only_loses_the_energy_of_the_discrete_scheme, ", 1 substep", one_substep),
        EVERY_WAY_UP(a_force_acts_in_all_substeps_of_the_next_step_only),
        EVERY_WAY_UP(a_torque_spins_a_box_by_its_principal_moment),
        TEST(damping_follows_its_discrete_law),
        WITH_4_SUBSTEPS(damping_follows_its_discrete_law),
        EVERY_WAY_UP(the_speed_limit_cuts_and_keeps_the_direction),
        TEST(locked_coordinates_stay_bit_for_bit_and_free_ones_move),
        TEST(the_ground_does_not_hold_what_cannot_move_into_it),
        TEST(locks_taken_off_leave_no_trace),
        TEST(a_body_on_an_axle_has_its_exact_inertia),
        TEST(two_free_axes_turn_by_the_inertia_between_them),
    };
    return cmocka_run_group_tests_name("integration", tests, NULL, NULL);
}
