// Bounces with friction: what slides into a surface loses mu (1 + e) |vn| of its slip, or all of it.
#include "scenes/mechanics.h"

// A body that touches the ground with its lowest points, its slip along x
typedef struct blow {
    fe_geometry form;
    double rest; // height of the centre at the touch, m
    fe_quat rotation;
    int rolls; // about z: what the ground does not hold flat
} blow;

#define FALL 5.0 // |vn|, m/s

static blow ball(void) { return (blow){sphere(0.5), 0.5, UNTURNED, 1}; }
static blow flat_box(void) { return (blow){box(0.5, 0.25, 0.4), 0.25, UNTURNED, 0}; }
static blow cube(void) { return (blow){box(0.5, 0.5, 0.5), 0.5, UNTURNED, 0}; }
static blow lying_capsule(void) { return (blow){capsule(0.4, 0.2), 0.2, turned(v3(0, 0, 1), 90 * DEGREES), 0}; }
static blow rolling_capsule(void) { return (blow){capsule(0.4, 0.2), 0.2, turned(v3(1, 0, 0), 90 * DEGREES), 1}; }

typedef struct outcome {
    vec v, w;
    double lightness; // m times what a unit of tangential impulse changes the slip by
} outcome;

// Without gravity; `phase`: part of a step by which the touch comes later
static outcome collide(void **state, const blow *b, double e, double mu, double slip, double phase)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    add_ground(&s, bouncy(mu, e));
    fe_body body =
        add_dynamic(&s, b->form, v3(0, b->rest + (8 + phase) * FALL * STEP, 0), b->rotation, bouncy(mu, e), WATER);
    set_velocity(&s, body, v3(slip, -FALL, 0), v3(0, 0, 0));
    double mass = mass_of(&s, body), moment = (double)mass_data_of(&s, body).inertia.x; // capsules' about their axis: y
    if (b->form.type == FE_GEOMETRY_CAPSULE) moment = (double)mass_data_of(&s, body).inertia.y;
    double lightness = b->rolls ? 1 + mass * b->rest * b->rest / moment : 1;
    run(&s, 20);
    outcome o = {velocity(&s, body), spin(&s, body), lightness};
    scene_end(&s);
    return o;
}

enum { PHASES = 64 };

// Within 2 %, whatever part of a substep is left at the touch: multiples of the golden section fill it evenly
static void loses_what_friction_takes(void **state, blow b, double slip, const double *restitutions, int count)
{
    static const double frictions[] = {0.1, 0.2, 0.4};
    for (int i = 0; i < 3 * count; ++i) {
        double mu = frictions[i % 3], e = restitutions[i / 3];
        for (int k = 0; k < PHASES; ++k) {
            outcome o = collide(state, &b, e, mu, slip, 0.618 * k - floor(0.618 * k));
            double lost = fmin(mu * (1 + e) * FALL, slip / o.lightness);
            FE_NEAR(slip - o.v.x, lost, 0.02 * lost);
            FE_NEAR(o.v.y, e * FALL, 0.02 * FALL);
            FE_NEAR(o.v.z, 0, 1e-3);
            if (!b.rolls) FE_NEAR(0.5 * length(o.w), 0, 0.02 * FALL); // of its ends
            if (b.rolls) FE_NEAR(-o.w.z * b.rest, (o.lightness - 1) * lost, 0.02 * (o.lightness - 1) * lost);
        }
    }
}

static const double all[] = {0, 0.1, 0.5, 1};

static void ball_that_slides_loses_mu_of_its_bounce(void **state)
{
    loses_what_friction_takes(state, ball(), 20, all, 4);
}
static void ball_that_sticks_rolls_on(void **state) { loses_what_friction_takes(state, ball(), 0.5, all, 4); }
static void flat_box_that_slides_loses_mu_of_its_bounce(void **state)
{
    loses_what_friction_takes(state, flat_box(), 20, all, 4);
}
static void flat_box_that_lands_sticks(void **state) { loses_what_friction_takes(state, flat_box(), 0.5, all, 4); }
static void cube_that_slides_loses_mu_of_its_bounce(void **state)
{
    loses_what_friction_takes(state, cube(), 20, all, 4);
}
static void cube_that_lands_sticks(void **state) { loses_what_friction_takes(state, cube(), 0.5, all, 1); }
static void lying_capsule_that_slides_loses_mu_of_its_bounce(void **state)
{
    loses_what_friction_takes(state, lying_capsule(), 20, all, 4);
}
static void lying_capsule_that_lands_sticks(void **state)
{
    loses_what_friction_takes(state, lying_capsule(), 0.5, all, 4);
}
static void rolling_capsule_that_slides_loses_mu_of_its_bounce(void **state)
{
    loses_what_friction_takes(state, rolling_capsule(), 20, all, 4);
}
static void rolling_capsule_that_sticks_rolls_on(void **state)
{
    loses_what_friction_takes(state, rolling_capsule(), 0.5, all, 4);
}

// A ball that spins about z meets one of its mass, at rest, head on. Each gets half of what a wall would give:
// (1 + e) m vn / 2 along the line of centres and mu times that across it, which slows one's spin and gives it to the
// other: w = 5/2 J / (m r).
static void struck_ball_gets_the_throw_of_a_spin(void **state)
{
    const double radius = 0.5, spun = 20, mu = 0.2;
    static const double restitutions[] = {0, 0.5, 1};
    for (int i = 0; i < 3 * PHASES; ++i) {
        double e = restitutions[i % 3], across = mu * (1 + e) / 2 * FALL;
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        double gap = (4 + 0.618 * i - floor(0.618 * i)) * FALL * STEP;
        fe_body striker = add_dynamic(&s, sphere(radius), v3(-2 * radius - gap, 0, 0), UNTURNED, bouncy(mu, e), WATER);
        fe_body target = add_dynamic(&s, sphere(radius), v3(0, 0, 0), UNTURNED, bouncy(mu, e), WATER);
        set_velocity(&s, striker, v3(FALL, 0, 0), v3(0, 0, spun));
        run(&s, 12);
        vec u = velocity(&s, striker), v = velocity(&s, target);
        FE_NEAR(v.x, (1 + e) / 2 * FALL, 0.02 * FALL);
        FE_NEAR(v.y, across, 0.02 * across);
        FE_NEAR(spin(&s, target).z, -2.5 * across / radius, 0.02 * 2.5 * across / radius);
        FE_NEAR(spin(&s, striker).z, spun - 2.5 * across / radius, 0.02 * 2.5 * across / radius);
        FE_NEAR(u.x + v.x, FALL, MOMENTUM_DRIFT * FALL);
        FE_NEAR(u.y + v.y, 0, MOMENTUM_DRIFT * FALL);
        scene_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(ball_that_slides_loses_mu_of_its_bounce),
        WITH_4_SUBSTEPS(ball_that_slides_loses_mu_of_its_bounce),
        TEST_WITH(ball_that_slides_loses_mu_of_its_bounce, ", askew", askew),
        TEST(ball_that_sticks_rolls_on),
        TEST(flat_box_that_slides_loses_mu_of_its_bounce),
        WITH_4_SUBSTEPS(flat_box_that_slides_loses_mu_of_its_bounce),
        TEST(flat_box_that_lands_sticks),
        TEST(cube_that_slides_loses_mu_of_its_bounce),
        WITH_4_SUBSTEPS(cube_that_slides_loses_mu_of_its_bounce),
        TEST(cube_that_lands_sticks),
        TEST(lying_capsule_that_slides_loses_mu_of_its_bounce),
        WITH_4_SUBSTEPS(lying_capsule_that_slides_loses_mu_of_its_bounce),
        TEST(lying_capsule_that_lands_sticks),
        TEST(rolling_capsule_that_slides_loses_mu_of_its_bounce),
        WITH_4_SUBSTEPS(rolling_capsule_that_slides_loses_mu_of_its_bounce),
        TEST(rolling_capsule_that_sticks_rolls_on),
        TEST(struck_ball_gets_the_throw_of_a_spin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
