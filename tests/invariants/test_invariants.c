// What must hold in any scene, at every step: 60 random ones of every kind of body, and flights of free bodies.
//
// A scene is made from its number alone. It is run with 1 and with 8 workers side by side, and looked at after each
// step.
#include "scenes/mechanics.h"

#include <stdlib.h>

enum { SCENES = SLOW_BUILD ? 12 : 60, STEPS = SLOW_BUILD ? 60 : 180, MOST_BODIES = 60, MOST_TOUCHING = 48 };

#define REACH 0.85 // m, of a box of half (0.48, 0.48, 0.48), the largest any_form makes of 1.2 m

typedef struct arena {
    scene s;
    fe_body bodies[MOST_BODIES];
    double speeds[MOST_BODIES]; // of the fastest point, in the last steps, m/s
    int count, dynamic;         // the dynamic ones come first
    vec planes[4];              // normals; planes go through the origin
    int plane_count;
} arena;

static fe_world *create_world(int workers, int substeps, vec gravity)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers;
    def.substeps = substeps;
    def.gravity = narrow(gravity);
    MUST(fe_world_create(&def, &world));
    return world;
}

static fe_material any_material(dice *d, int lively)
{
    fe_material m = friction(uniform(d, 0, 1));
    m.dynamic_friction = m.static_friction * (float)uniform(d, 0.5, 1);
    if (lively && pick(d, 3) == 0) m.restitution = (float)uniform(d, 0, 1);
    if (pick(d, 4) == 0) m.rolling_resistance = (float)uniform(d, 0, 0.2);
    if (pick(d, 4) == 0) m.spinning_resistance = (float)uniform(d, 0, 0.02);
    return m;
}

// a pit of tilted planes: a ground and up to three walls
static void add_planes(arena *a, dice *d)
{
    double tilt = uniform(d, 0, 20) * DEGREES, heading = uniform(d, 0, 2 * PI);
    a->planes[0] = v3(sin(tilt) * cos(heading), cos(tilt), sin(tilt) * sin(heading));
    a->plane_count = 1 + pick(d, 4);
    for (int i = 1; i < a->plane_count; ++i) {
        double side = heading + i * 2 * PI / 3;
        a->planes[i] = v3(0.9 * cos(side), sqrt(1 - 0.81), 0.9 * sin(side));
    }
    for (int i = 0; i < a->plane_count; ++i) add_plane(&a->s, a->planes[i], i ? -3 : 0, any_material(d, 1));
}

static void add_bodies(arena *a, dice *d, int dynamic, int kinematic)
{
    for (int i = 0; i < dynamic + kinematic; ++i) {
        int moves = i < dynamic;
        fe_geometry form = any_form(d, uniform(d, 0.4, 1.2));
        // apart from each other: overlaps at birth would give energy
        vec at = v3(1.4 * (i % 3 - 1), 2 + 1.4 * (i / 9), 1.4 * (i / 3 % 3 - 1));
        fe_body body = add_body(&a->s, moves ? FE_BODY_DYNAMIC : FE_BODY_KINEMATIC, form, at, any_rotation(d),
                                any_material(d, 1), (float)uniform(d, 200, 4000));
        set_velocity(&a->s, body, times(moves ? 3 : 0.5, somewhere(d, 1)), times(moves ? 5 : 1, somewhere(d, 1)));
        if (moves && pick(d, 6) == 0)
            MUST(fe_body_set_locks(a->s.world, body, (uint32_t)pick(d, 8), (uint32_t)pick(d, 8)));
        if (moves && pick(d, 3) == 0) MUST(fe_body_set_sleep_allowed(a->s.world, body, 1));
        if (moves && pick(d, 5) == 0)
            MUST(fe_body_set_damping(a->s.world, body, (float)uniform(d, 0, 1), (float)uniform(d, 0, 1)));
        if (moves && pick(d, 8) == 0) MUST(fe_body_set_gravity_scale(a->s.world, body, (float)uniform(d, 0.2, 1)));
        a->bodies[a->count++] = body;
        a->dynamic += moves;
    }
}

static arena build_arena(int number, int workers)
{
    dice d = {(uint64_t)(number * 7919 + 13)};
    static const int substeps[] = {8, 4, 8, 12};
    arena a = {.s = {NULL, UNTURNED, substeps[number % 4], STEP / substeps[number % 4]}};
    a.s.world = create_world(workers, a.s.substeps, v3(0, -G, 0));
    add_planes(&a, &d);
    for (int i = pick(&d, 4); i > 0; --i)
        add_static(&a.s, any_form(&d, 1.5), v3(uniform(&d, -2, 2), 0, uniform(&d, -2, 2)), any_rotation(&d),
                   any_material(&d, 1));
    add_bodies(&a, &d, 12 + pick(&d, 30), number % 3 ? 0 : 1 + pick(&d, 3));
    return a;
}

// ---- laws ----------------------------------------------------------------------------------------------------------

static void everything_is_finite_and_unit(const arena *a)
{
    for (int i = 0; i < a->count; ++i) {
        fe_transform t = body_transform(a->s.world, a->bodies[i]);
        fe_vec3 v = body_linear_velocity(a->s.world, a->bodies[i]), w = body_angular_velocity(a->s.world, a->bodies[i]);
        FE_WITHIN(length(t.position), 0, 1e4);
        FE_WITHIN(length(widen(v)), 0, 1e3);
        FE_WITHIN(length(widen(w)), 0, 1e4);
        double x = t.rotation.x, y = t.rotation.y, z = t.rotation.z, q = t.rotation.w;
        FE_NEAR(x * x + y * y + z * z + q * q, 1, 4e-7); // four rounded components
    }
}

// Contacts are found before they touch, so what enters a plane does so within a soft contact: by P1 of the load on a
// point, at most the weight of all bodies, whose effective mass is m / 7 at least (a corner of a flat box: 1 + 3 + 3).
// Contacts are found once per step: a corner that swings down only after another one was stopped has a step to itself.
// Its speed is remembered for a third of a second, while the overlap is pushed out.
static void nobody_is_in_a_plane(arena *a)
{
    double weight = 0;
    for (int i = 0; i < a->dynamic; ++i) weight += mass_of(&a->s, a->bodies[i]) * G;
    for (int i = 0; i < a->dynamic; ++i) {
        double speed = length(velocity(&a->s, a->bodies[i])) + length(spin(&a->s, a->bodies[i])) * REACH;
        a->speeds[i] = fmax(speed, a->speeds[i] * 0.95);
        double deepest = sink(weight, mass_of(&a->s, a->bodies[i]) / 7, 1) + LINEAR_SLOP + a->speeds[i] * STEP;
        fe_contact contacts[MOST_TOUCHING];
        int32_t count = fe_body_get_contacts(a->s.world, a->bodies[i], contacts, sizeof *contacts, MOST_TOUCHING);
        FE_WITHIN(count, 0, MOST_TOUCHING);
        for (int32_t k = 0; k < count; ++k) {
            fe_geometry form = {.struct_size = sizeof form};
            MUST(fe_shape_get_geometry(a->s.world, contacts[k].shape_a, &form)); // planes were created first
            for (int32_t p = 0; p < contacts[k].point_count && form.type == FE_GEOMETRY_PLANE; ++p)
                FE_WITHIN(contacts[k].points[p].separation, -deepest, 1);
        }
        vec at = position(&a->s, a->bodies[i]);
        for (int n = 0; n < a->plane_count; ++n) FE_WITHIN(dot(a->planes[n], at) + (n ? 3 : 0), -deepest, 1e4);
    }
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    MUST(fe_world_hash(world, words));
    return (uint64_t)words[1] << 32 | words[0];
}

static void random_scenes_hold_the_laws_at_every_step(void **state)
{
    (void)state;
    for (int number = 0; number < SCENES; ++number) {
        arena one = build_arena(number, 1), eight = build_arena(number, 8);
        for (int step = 0; step < STEPS; ++step) {
            run(&one.s, 1);
            run(&eight.s, 1);
            if (hash_of(one.s.world) != hash_of(eight.s.world)) print_error("scene %d, step %d\n", number, step);
            FE_TRUE(hash_of(one.s.world) == hash_of(eight.s.world));
            everything_is_finite_and_unit(&one);
            nobody_is_in_a_plane(&one);
        }
        scene_end(&one.s);
        scene_end(&eight.s);
    }
}

// Gravity, contacts, friction and damping only ever take energy. A soft contact stores what it gives under its load: m
// g times the sink of P1, a millimetre for what lies here, and may give it back; a body that a heavy one pins to the
// ground in its fall stores more, some parts in a thousand of the kinetic energy; in one heap of forty more.
static void closed_scenes_gain_no_energy(void **state)
{
    (void)state;
    shortfall gain = {"energy gained by closed scenes", 0};
    for (int number = 0; number < SCENES; ++number) {
        dice d = {(uint64_t)(number * 104729 + 1)};
        arena a = {.s = {NULL, UNTURNED, 8, STEP / 8}};
        a.s.world = create_world(1, 8, v3(0, -G, 0));
        add_planes(&a, &d);
        int count = 8 + pick(&d, 16);
        double weight = 0;
        for (int i = 0; i < count; ++i) {
            vec at = v3(1.4 * (i % 3 - 1), 2 + 1.4 * (i / 9), 1.4 * (i / 3 % 3 - 1));
            fe_geometry form = any_form(&d, uniform(&d, 0.6, 1.2));
            a.bodies[a.count++] = add_dynamic(&a.s, form, at, any_rotation(&d), any_material(&d, 0), WATER);
            set_velocity(&a.s, a.bodies[i], somewhere(&d, 3), somewhere(&d, 3));
            weight += mass_of(&a.s, a.bodies[i]) * G;
        }
        double lowest = totals_of(&a.s, a.bodies, a.count).energy, stored = weight * 0.001;
        for (int step = 0; step < STEPS; ++step) {
            run(&a.s, 1);
            totals now = totals_of(&a.s, a.bodies, a.count);
            measure(&gain, now.energy - lowest - stored, 0.005 * now.kinetic, 0.1 * now.kinetic);
            lowest = fmin(lowest, now.energy);
        }
        scene_end(&a.s);
    }
    report_shortfall(&gain);
}

// Nothing touches: momentum and angular momentum stay to the rounding of floats, energy within the promise of the
// gyroscopic step.
static void free_flight_keeps_momentum_and_angular_momentum(void **state)
{
    (void)state;
    for (int number = 0; number < SCENES; ++number) {
        dice d = {(uint64_t)(number * 31 + 5)};
        scene s = {create_world(1, number % 2 ? 8 : 4, v3(0, 0, 0)), UNTURNED, number % 2 ? 8 : 4,
                   STEP / (number % 2 ? 8 : 4)};
        fe_body bodies[8];
        for (int i = 0; i < 8; ++i) {
            bodies[i] = add_dynamic(&s, any_form(&d, 1), v3(100.0 * i, 0, 0), any_rotation(&d), friction(0.5),
                                    (float)uniform(&d, 100, 5000));
            vec w = somewhere(&d, 10);
            set_velocity(&s, bodies[i], somewhere(&d, 10), w);
        }
        vec first[8], velocities[8];
        double energies[8];
        for (int i = 0; i < 8; ++i) {
            fe_mass_data mass = mass_data_of(&s, bodies[i]);
            first[i] = own_angular_momentum(&s, bodies[i], &mass), velocities[i] = velocity(&s, bodies[i]);
            energies[i] = dot(first[i], spin(&s, bodies[i]));
        }
        for (int step = 1; step <= STEPS; ++step) {
            run(&s, 1);
            for (int i = 0; i < 8; ++i) {
                fe_mass_data mass = mass_data_of(&s, bodies[i]);
                vec now = own_angular_momentum(&s, bodies[i], &mass);
                // Size within 0.5 %. A substep turns the spin, then the body: they are half a substep's turn apart. And
                // the direction drifts with the angle by which a substep lags, (w h)^3 / 12: 1 % in V50 (5 rad/s, 10 s,
                // 4 substeps, where the lag sums to 0.18 %).
                double turn = length(spin(&s, bodies[i])) * s.h, lag = step * s.substeps * turn * turn * turn / 12;
                FE_NEAR(length(now), length(first[i]), 0.005 * length(first[i]));
                FE_WITHIN(between(now, first[i]), 0, 0.5 * turn + lag * 0.01 / 0.0018);
                FE_WITHIN(dot(now, spin(&s, bodies[i])), 0, energies[i] * (1 + ENERGY_GAIN));
                FE_NEAR(length(minus(velocity(&s, bodies[i]), velocities[i])), 0, 0); // nothing acts on it
            }
        }
        scene_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_hold_the_laws_at_every_step),
        cmocka_unit_test(closed_scenes_gain_no_energy),
        cmocka_unit_test(free_flight_keeps_momentum_and_angular_momentum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
