// Numbers that decay end at zero: what the solver keeps from step to step, and from substep to substep, is never
// denormal, and what it flushes is 0 or no less than its bounds (solver/solver.h). Arithmetic on denormals gives the
// right bits a hundred times as slowly, so only a count shows them.
#include "scenes/joint_scene.h"

#include "solver/contact/skip_test.h"
#include "world/world.h"

#include <float.h>
#include <stddef.h>

// those that are not 0 and below `least`
static int32_t below(float least, const float *numbers, size_t count)
{
    int32_t sum = 0;
    for (size_t i = 0; i < count; ++i) sum += numbers[i] != 0.0f && fabsf(numbers[i]) < least;
    return sum;
}

static int32_t denormals_in(const float *numbers, size_t count) { return below(FLT_MIN, numbers, count); }

#define BELOW(least, array) below(least, array, sizeof(array) / sizeof(float))
#define IN(array) BELOW(FLT_MIN, array)

static int32_t in_bodies(const fe_world *w)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < w->awake_body_count; ++i) {
        const fe__body *body = w->bodies + w->awake_bodies[i];
        sum += BELOW(FE__LEAST_SPEED, body->velocity) + BELOW(FE__LEAST_SPEED, body->spin) +
               BELOW(FE__LEAST_SPEED, body->rotation);
    }
    return sum;
}

static int32_t in_lines(const fe__solver *s)
{
    const size_t lines = (size_t)s->line_count * FE__LINE;
    int32_t sum = denormals_in((const float *)s->velocity, lines) + denormals_in((const float *)s->motion, lines) +
                  denormals_in((const float *)s->start, lines) + denormals_in((const float *)s->inertia, lines);
    for (int32_t i = 0; i < s->line_count; ++i) sum += BELOW(FE__LEAST_LEAN, s->axes[i].rotation);
    return sum;
}

static int32_t in_contacts(const fe_world *w)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        const fe__contact *m = w->contacts + fe__pair_of(w->awake_pairs[i]);
        const fe__points *q = w->points + m->points;
        sum += BELOW(FE__LEAST_LEAN, m->normal) + IN(q->normal_impulse) + IN(q->friction_impulse) +
               IN(q->total_impulse) + below(FE__LEAST_TWIST, &q->twist_impulse, 1);
    }
    return sum;
}

static int32_t in_axes(const fe__joint_axes *axes)
{
    const fe__joint_rotation *r = &axes->rotation;
    int32_t sum = IN(r->impulse) + IN(r->motor_impulse) + IN(r->torque);
    for (int i = 0; i < FE__AXES; ++i) {
        const fe__joint_axis *x = axes->axis + i;
        sum += denormals_in(&x->impulse.drive, sizeof x->impulse / sizeof(float)) + denormals_in(&x->state.x, 2);
    }
    return sum;
}

// Sweeps and trees leave their impulses in the same records.
static int32_t in_joints(const fe_world *w)
{
    const fe__joints *all = &w->joints;
    int32_t sum = 0;
    for (int32_t i = 0; i < w->awake_joint_count; ++i) {
        int32_t joint = w->awake_joints[i];
        sum += IN(all->joints[joint].impulse) + IN(all->frames[joint].impulse) + IN(all->reactions[joint].force) +
               IN(all->reactions[joint].torque);
        if (all->frames[joint].axes) sum += in_axes(all->axes + all->frames[joint].axes);
    }
    return sum;
}

static void count_over(scene *s, int steps)
{
    for (int i = 0; i < steps; ++i) {
        run(s, 1);
        const fe_world *w = s->world;
        int32_t bodies = in_bodies(w), lines = in_lines(&w->solver), contacts = in_contacts(w), joints = in_joints(w);
        if (bodies + lines + contacts + joints > 0)
            fail_msg("step %d: too small: %d in bodies, %d in lines, %d in contacts, %d in joints", i, (int)bodies,
                     (int)lines, (int)contacts, (int)joints);
    }
}

// ---- scenes whose residual speeds decay ----------------------------------------------------------------------------

// A box, a sphere and a capsule come to rest on houses, axis by axis on their own.
static void what_comes_to_rest_has_none(void **state)
{
    scene s = scene_begin(state);
    for (int i = 0; i < 36; ++i) {
        vec at = v3(2.0 * (i % 6), 0, 2.0 * (i / 6)), above = plus(at, v3(0.1 * (i % 5), 1.0 + 0.03 * i, 0));
        const fe_geometry forms[3] = {box(0.4, 0.3, 0.5), sphere(0.45), capsule(0.3, 0.3)};
        add_static(&s, box(0.5, 0.2, 0.5), at, UNTURNED, friction(0.6));
        add_dynamic(&s, forms[i % 3], above, UNTURNED, friction(0.4), WATER);
    }
    add_ground(&s, friction(0.6));
    count_over(&s, 300);
    scene_end(&s);
}

// Cubes 1 cm apart fall straight onto each other.
static void a_grid_has_none(void **state)
{
    enum { SIDE = 4 };
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    for (int i = 0; i < SIDE * SIDE * SIDE; ++i) {
        vec at = v3(1.01 * (i % SIDE), 0.51 + 1.01 * (i / (SIDE * SIDE)), 1.01 * (i / SIDE % SIDE));
        add_dynamic(&s, box(0.5, 0.5, 0.5), at, UNTURNED, friction(0.6), WATER);
    }
    count_over(&s, 180);
    scene_end(&s);
}

// A ball of many times the mass of a brick makes the substeps finer: h is a millisecond.
static void a_wall_that_is_hit_has_none(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    for (int i = 0; i < 60; ++i) {
        double shift = i / 10 % 2 ? 0.252 : 0;
        add_dynamic(&s, box(0.25, 0.125, 0.125), v3(0.504 * (i % 10) + shift, 0.129 + 0.254 * (i / 10), 0), UNTURNED,
                    friction(0.6), 2 * WATER);
    }
    fe_body ball = add_dynamic(&s, sphere(0.4), v3(2.2, 1.0, 1.5), UNTURNED, friction(0.6), 4 * WATER);
    set_velocity(&s, ball, v3(0, 0, -12), v3(0, 0, 0));
    count_over(&s, 200);
    scene_end(&s);
}

// Boxes and spheres fall onto each other, from places and in poses of no order.
static void a_pile_has_none(void **state)
{
    scene s = scene_begin(state);
    dice d = {7};
    add_ground(&s, friction(0.6));
    for (int i = 0; i < 40; ++i) {
        vec at = plus(v3(0, 1 + 0.5 * i, 0), somewhere(&d, 0.7));
        add_dynamic(&s, i % 2 ? box(0.3, 0.2, 0.25) : sphere(0.25), at, any_rotation(&d), friction(0.5), WATER);
    }
    count_over(&s, 300);
    scene_end(&s);
}

// It comes to rest by friction: the speed of what slides ends, the friction stays.
static void what_slides_has_none(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    for (int i = 0; i < 4; ++i) {
        fe_body body = add_dynamic(&s, i < 2 ? box(0.4, 0.3, 0.5) : sphere(0.3), v3(0, 0.3, 3.0 * i), UNTURNED,
                                   friction(0.1 + 0.1 * i), WATER);
        set_velocity(&s, body, i % 2 ? v3(3, 0, 0) : v3(2, 0, 1), v3(0, i, 0));
    }
    count_over(&s, 300);
    scene_end(&s);
}

// Resistances end a roll, and a spin on the spot.
static void what_rolls_and_spins_has_none(void **state)
{
    scene s = scene_begin(state);
    const fe_material resisting = SURFACE(0.6f, 0.6f, 0, 0.05f, 0.05f);
    add_ground(&s, resisting);
    for (int i = 0; i < 6; ++i) {
        fe_geometry form = i % 2 ? sphere(0.3) : capsule(0.2, 0.3);
        fe_body body = add_dynamic(&s, form, v3(0, i % 2 ? 0.3 : 0.5, 2.0 * i), UNTURNED, resisting, WATER);
        set_velocity(&s, body, i < 4 ? v3(2, 0, 0.3 * i) : v3(0, 0, 0), v3(0, 5.0 * i, 0));
    }
    count_over(&s, 400);
    scene_end(&s);
}

static void damp(scene *s, fe_body body) { MUST(fe_body_set_damping(s->world, body, 2, 2)); }

// Chains of a tree, and rings, which have none: their swings are damped away. One of each hangs straight.
static void chains_that_come_to_rest_have_none(void **state)
{
    enum { LINKS = 8 };
    scene s = scene_begin(state);
    for (int chain = 0; chain < 4; ++chain) {
        const int straight = chain % 2, ring = chain / 2;
        const vec step = straight ? v3(0, -0.5, 0) : v3(0.5, 0, 0), start = v3(0, 10, 3.0 * chain);
        fe_body before = add_anchor(&s, start);
        for (int i = 0; i < LINKS; ++i) {
            fe_body link =
                add_dynamic(&s, box(0.1, 0.15, 0.2), plus(start, times(i + 0.5, step)), UNTURNED, friction(0.6), WATER);
            touch_nothing(&s, link), damp(&s, link);
            add_ball(&s, ball_def(), before, link, plus(start, times(i, step)), v3(0, 1, 0));
            before = link;
        }
        vec end = plus(start, times(LINKS, step));
        if (ring) add_ball(&s, ball_def(), add_anchor(&s, end), before, end, v3(0, 1, 0));
    }
    count_over(&s, 600);
    scene_end(&s);
}

// Pendulums on hinges, a slide, a rod and a spring, with friction in their joints.
static void pendulums_have_none(void **state)
{
    scene s = scene_begin(state);
    for (int i = 0; i < 5; ++i) {
        vec at = v3(0, 5, 2.0 * i), low = plus(at, i % 2 ? v3(0, -1, 0) : v3(1, 0, 0));
        fe_body anchor = add_anchor(&s, at), bob = add_plain(&s, box(0.2, 0.3, 0.1), low);
        fe_hinge_joint_def hinge = hinge_def();
        fe_distance_joint_def spring = distance_def();
        hinge.spring_hertz = 1, hinge.motor_max = 1;
        spring.limit_enabled = 0, spring.spring_hertz = 2, spring.motor_max = 1;
        touch_nothing(&s, bob), damp(&s, bob);
        if (i < 2) add_hinge(&s, hinge, anchor, bob, at, v3(0, 0, 1));
        if (i == 2) add_configurable(&s, slider_def(), anchor, bob, at, v3(0, 1, 0));
        if (i == 3) add_rod(&s, anchor, bob, at, low);
        if (i == 4) add_distance(&s, spring, anchor, bob, at, low);
    }
    count_over(&s, 600);
    scene_end(&s);
}

// What the host sets is none of the solver's: it ends with the first step.
static void a_denormal_velocity_ends_with_the_step(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body body = add_dynamic(&s, box(0.4, 0.3, 0.5), v3(0, 3, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, body, v3(1e-40, 0, 1e-39), v3(1e-41, 1e-40, 0));
    count_over(&s, 2);
    FE_NEAR(velocity(&s, body).x, 0, 0);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(what_comes_to_rest_has_none),
        WITH_4_SUBSTEPS(what_comes_to_rest_has_none),
        EVERY_WAY_UP(a_grid_has_none),
        WITH_4_SUBSTEPS(a_grid_has_none),
        WITH_4_SUBSTEPS(a_wall_that_is_hit_has_none),
        EVERY_WAY_UP(a_pile_has_none),
        EVERY_WAY_UP(what_slides_has_none),
        EVERY_WAY_UP(what_rolls_and_spins_has_none),
        EVERY_WAY_UP(chains_that_come_to_rest_have_none),
        EVERY_WAY_UP(pendulums_have_none),
        TEST(a_denormal_velocity_ends_with_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
