// Machines on light wheels: what stands on a body of a tree of joints is borne by a contact of that body alone, which
// is to push the mass of the whole. Wheels of their own mass would give by (load on one) / (mass of one w^2), P1.
#include "scenes/joint_scene.h"

#include <string.h>

enum { MOST_WHEELS = 8 };

typedef struct machine {
    fe_body wheels[MOST_WHEELS];
    int count;
    double radius;
} machine;

static void set_mass(scene *s, fe_body body, double mass) { MUST(fe_body_set_mass(s->world, body, (float)mass)); }

static void add_wheel(scene *s, machine *m, fe_body chassis, vec at, double mass)
{
    fe_material rolling = friction(0.6);
    rolling.rolling_resistance = 0.02f;
    fe_body wheel = add_dynamic(s, sphere(m->radius), at, UNTURNED, rolling, WATER);
    set_mass(s, wheel, mass);
    add_hinge(s, hinge_def(), chassis, wheel, at, v3(0, 0, 1));
    m->wheels[m->count++] = wheel;
}

// a chassis over the ends of its wheels' axles, of half so long and half so wide
static fe_body add_chassis(scene *s, vec at, double x, double z, double mass)
{
    fe_body chassis = add_plain(s, box(x + 0.2, 0.25, z - 0.1), at);
    set_mass(s, chassis, mass);
    return chassis;
}

static double deepest(const scene *s, const machine *m)
{
    double most = -1;
    for (int i = 0; i < m->count; ++i) most = fmax(most, m->radius - position(s, m->wheels[i]).y);
    return most;
}

static double energy_of(const scene *s)
{
    fe_energy energy;
    fe_energy_init(&energy, sizeof energy);
    MUST(fe_world_get_energy(s->world, &energy));
    return energy.kinetic + energy.potential;
}

// A ton in the plane on two wheels of 1.6 kg, from 2 m, under 22 m/s2
static void a_cart_falls_on_light_wheels(void **state)
{
    static const setup finer = {{0, 0, 0, 1}, 12};
    const void *how = &finer;
    (void)state;
    scene s = scene_begin((void **)(uintptr_t)&how);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.contact_hertz = 240, tuning.contact_damping_ratio = 10, tuning.contact_push_speed = 0.5f;
    tuning.joint_hertz = 240;
    MUST(fe_world_set_tuning(s.world, &tuning));
    set_gravity(&s, v3(0, -22, 0));
    add_ground(&s, friction(0.6));
    machine m = {.radius = 0.1};
    fe_body chassis = add_chassis(&s, v3(0, 2.25, 0), 0.8, 0.6, 1000);
    for (int i = 0; i < 2; ++i) add_wheel(&s, &m, chassis, v3(i ? 0.9 : -0.9, 1.85, 0), 1.57);
    MUST(fe_body_set_locks(s.world, chassis, FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
    for (int i = 0; i < 2; ++i) MUST(fe_body_set_locks(s.world, m.wheels[i], FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
    double most = -1;
    for (int i = 0; i < 300; ++i) {
        run(&s, 1);
        most = fmax(most, deepest(&s, &m));
        if (i >= 120) FE_WITHIN(length(velocity(&s, chassis)), 0, 0.01);
    }
    FE_WITHIN(most, 0, 0.01);
    FE_WITHIN(deepest(&s, &m), 0, 0.001);
    scene_end(&s);
}

// From 0.8 m. Nothing bounces: overlap that the contacts push out again is all that may give energy, a hundredth of
// what there was to lose.
static void falls_on_three_wheels(void **state, double ratio)
{
    const double mass = 1000, at_rest = mass * G * 0.8;
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    machine m = {.radius = 0.2};
    fe_body chassis = add_chassis(&s, v3(0, 1.4, 0), 1, 0.6, mass);
    add_wheel(&s, &m, chassis, v3(1, 1, 0), mass / ratio);
    for (int i = 0; i < 2; ++i) add_wheel(&s, &m, chassis, v3(-1, 1, i ? 0.6 : -0.6), mass / ratio);
    double most = -1, least = energy_of(&s);
    for (int i = 0; i < 180; ++i) {
        run(&s, 1);
        most = fmax(most, deepest(&s, &m));
        FE_WITHIN(energy_of(&s) - least, -2 * at_rest, 0.01 * at_rest);
        least = fmin(least, energy_of(&s));
    }
    FE_WITHIN(most, 0, LINEAR_SLOP);
    FE_WITHIN(deepest(&s, &m), 0, sink(mass * G / 3, mass / ratio, 1) / 10);
    scene_end(&s);
}

static void a_ton_falls_on_three_wheels_of_5_kg(void **state) { falls_on_three_wheels(state, 200); }
static void a_ton_falls_on_three_wheels_of_half_a_kilogram(void **state) { falls_on_three_wheels(state, 2000); }

static void add_waggon(scene *s, machine *m, fe_body chassis, double x, double wheel)
{
    for (int i = 0; i < 4; ++i)
        add_wheel(s, m, chassis, v3(x + (i & 1 ? 1 : -1), m->radius, i & 2 ? 0.7 : -0.7), wheel);
}

// Eight tons on wheels of 20 kg pull 0.4 tons on wheels of 5 kg, at 10 m/s without a motor
static void a_tractor_pulls_a_light_trailer(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    machine m = {.radius = 0.3};
    fe_body tractor = add_chassis(&s, v3(0, 0.7, 0), 1.3, 0.7, 8000),
            trailer = add_chassis(&s, v3(-4, 0.7, 0), 1.3, 0.7, 400);
    add_waggon(&s, &m, tractor, 0, 20);
    add_waggon(&s, &m, trailer, -4, 5);
    fe_joint bar = add_ball(&s, ball_def(), tractor, trailer, v3(-2, 0.7, 0), v3(1, 0, 0));
    set_velocity(&s, tractor, v3(10, 0, 0), v3(0, 0, 0)), set_velocity(&s, trailer, v3(10, 0, 0), v3(0, 0, 0));
    for (int i = 0; i < m.count; ++i) set_velocity(&s, m.wheels[i], v3(10, 0, 0), v3(0, 0, -10 / m.radius));
    double before = energy_of(&s);
    for (int i = 0; i < 180; ++i) {
        run(&s, 1);
        FE_WITHIN(energy_of(&s), 0, before + 1e-4 * before);
        before = energy_of(&s);
        FE_WITHIN(deepest(&s, &m), 0, sink(8000 * G / 4, 20, 1) / 5); // settles
        FE_WITHIN(gap_of(&s, bar), 0, 0.001);
        FE_NEAR(position(&s, tractor).z, 0, 0.01);
    }
    FE_WITHIN(deepest(&s, &m), 0, sink(8000 * G / 4, 20, 1) / 10);
    // rolling resistance slows it by 0.02 r g / r
    FE_NEAR(velocity(&s, tractor).x, 10 - 0.02 * G * 180 * STEP, 0.1);
    scene_end(&s);
}

// What lies on the chassis touches the tree, too
static void a_waggon_bears_its_own_mass(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    machine m = {.radius = 0.3};
    fe_body chassis = add_chassis(&s, v3(0, 0.7, 0), 1, 0.7, 1000),
            load = add_plain(&s, box(0.5, 0.5, 0.5), v3(0, 1.45, 0));
    set_mass(&s, load, 1000);
    add_waggon(&s, &m, chassis, 0, 5);
    run(&s, 240);
    FE_WITHIN(deepest(&s, &m), 0, sink(2000 * G / 4, 5, 1) / 3);
    FE_WITHIN(1.45 - position(&s, load).y, 0, LINEAR_SLOP);
    FE_WITHIN(length(velocity(&s, load)), 0, 0.01);
    scene_end(&s);
}

// Parts that all lie on the ground, of which one is heavy: it is not to become light for the others. Half of its mass
// counts where others do with the mass of the tree.
static void a_heavy_part_stands_on_its_own(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body bar[8];
    for (int i = 0; i < 8; ++i) {
        bar[i] = add_plain(&s, box(0.25, 0.1, 0.1), v3(0.5 * i, 0.3, 0));
        set_mass(&s, bar[i], i == 3 ? 1000 : 1);
        if (i) add_fixed(&s, fixed_def(), bar[i - 1], bar[i], v3(0.5 * i - 0.25, 0.3, 0));
    }
    for (int i = 0; i < 180; ++i) {
        run(&s, 1);
        FE_WITHIN(0.1 - position(&s, bar[3]).y, -1, 4 * sink(1000 * G, 1000, 1));
    }
    scene_end(&s);
}

// Waggons of one form are solved side by side, as many as the set of kernels has lanes. What they lend is their own
// affair: some are in the air, some bear a load, their wheels differ.
static void fill_with_waggons(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 19; ++i) {
        const double x = 4.0 * (i % 5), z = 4.0 * (i / 5), up = 0.1 * (i % 4);
        machine m = {.radius = 0.3};
        fe_body chassis = add_chassis(s, v3(x, 0.7 + up, z), 1, 0.7, 1000);
        for (int k = 0; k < 4 - (i % 6 == 0); ++k)
            add_wheel(s, &m, chassis, v3(x + (k & 1 ? 1 : -1), m.radius + up, z + (k & 2 ? 0.7 : -0.7)), 1 + i % 3);
        if (i % 3 == 0) add_plain(s, box(0.3, 0.3, 0.3), v3(x, 1.3 + up, z));
    }
}

static void neighbours_do_not_show_in_what_is_lent(void **state)
{
    static const int32_t sets[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON};
    uint32_t first[2] = {0, 0}, hash[2];
    (void)state;
    for (int i = 0; i < 5; ++i) {
        scene s = {NULL, UNTURNED, 8, STEP / 8};
        fe_world_def def;
        fe_world_def_init(&def, sizeof def);
        def.substeps = 8, def.simd = sets[i], def.worker_count = i % 2 ? 3 : 1;
        if (fe_world_create(&def, &s.world) < 0) continue; // a set that this machine lacks
        set_gravity(&s, v3(0, -G, 0));
        fill_with_waggons(&s);
        run(&s, SLOW_BUILD ? 40 : 120);
        MUST(fe_world_hash(s.world, hash));
        if (i == 0) memcpy(first, hash, sizeof first);
        FE_TRUE(hash[0] == first[0] && hash[1] == first[1]);
        scene_end(&s);
    }
}

// ---- trees that hang ------------------------------------------------------------------------------------------------

// A ball of m is pinned at its centre, d inside the ground, and joined to a block of 432 m that stands there. What the
// world holds has no mass that its tree could lend. The ball's soft contact comes to rest, from below, at the force
// m w^2 d (P1), of which the ball's weight is borne. The pin bears the rest and no more: friction there is none. It
// gives a little, so 2 %.
static void pinned_in_the_ground(void **state, int32_t kind, double speed)
{
    const double radius = 0.2, d = 0.001, mass = 1;
    scene s = scene_begin(state);
    add_ground(&s, friction(0));
    vec at = v3(0, radius - d, 0);
    fe_body pin = add_anchor(&s, at), ball = add_dynamic(&s, sphere(radius), at, UNTURNED, friction(0), WATER),
            block = add_dynamic(&s, box(0.3, 0.15, 0.3), v3(0, 0.15, 1.5), UNTURNED, friction(0), WATER);
    MUST(fe_body_set_type(s.world, pin, kind));
    set_mass(&s, ball, mass), set_mass(&s, block, 432 * mass);
    if (kind == FE_BODY_KINEMATIC) set_velocity(&s, pin, v3(speed, 0, 0), v3(0, 0, 0));
    set_velocity(&s, ball, v3(speed, 0, 0), v3(0, 0, 0)), set_velocity(&s, block, v3(speed, 0, 0), v3(0, 0, 0));
    fe_joint joint = add_ball(&s, ball_def(), pin, ball, at, v3(0, 0, 1));
    add_hinge(&s, hinge_def(), ball, block, v3(0, at.y, 0.7), v3(1, 0, 0));
    const double force = mass * d * (2 * PI * 60) * (2 * PI * 60);
    for (int i = 0; i < 60; ++i) {
        run(&s, 1);
        FE_WITHIN(length(force_of(&s, joint)), 0, force);
    }
    FE_NEAR(force_of(&s, joint).y, -(force - mass * G), 0.02 * force);
    scene_end(&s);
}

static void a_pin_bears_the_force_of_a_contact(void **state)
{
    pinned_in_the_ground(state, FE_BODY_STATIC, 0);
    pinned_in_the_ground(state, FE_BODY_KINEMATIC, 0);
    pinned_in_the_ground(state, FE_BODY_KINEMATIC, 30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cart_falls_on_light_wheels),
        EVERY_WAY_UP(a_ton_falls_on_three_wheels_of_5_kg),
        WITH_4_SUBSTEPS(a_ton_falls_on_three_wheels_of_5_kg),
        TEST(a_ton_falls_on_three_wheels_of_half_a_kilogram),
        WITH_4_SUBSTEPS(a_ton_falls_on_three_wheels_of_half_a_kilogram),
        TEST(a_tractor_pulls_a_light_trailer),
        WITH_4_SUBSTEPS(a_tractor_pulls_a_light_trailer),
        TEST(a_waggon_bears_its_own_mass),
        cmocka_unit_test(neighbours_do_not_show_in_what_is_lent),
        EVERY_WAY_UP(a_pin_bears_the_force_of_a_contact),
        WITH_4_SUBSTEPS(a_pin_bears_the_force_of_a_contact),
        TEST(a_heavy_part_stands_on_its_own),
        WITH_4_SUBSTEPS(a_heavy_part_stands_on_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
