// Numbers that decay end at zero: what the solver keeps from step to step, and from substep to substep, is never
// denormal. Arithmetic on denormals gives the right bits a hundred times as slowly, so only a count shows them.
#include "scenes/mechanics.h"

#include "world/deferral.h"
#include "world/world.h"

#include <stddef.h>

static int32_t denormals_in(const float *numbers, size_t count)
{
    int32_t sum = 0;
    for (size_t i = 0; i < count; ++i) sum += fpclassify(numbers[i]) == FP_SUBNORMAL;
    return sum;
}

#define IN(array) denormals_in(array, sizeof(array) / sizeof(float))

static int32_t in_bodies(const fe_world *w)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < w->awake_body_count; ++i) {
        const fe__body *body = w->bodies + w->awake_bodies[i];
        sum += IN(body->velocity) + IN(body->spin) + IN(body->rotation);
    }
    return sum;
}

static int32_t in_lines(const fe__solver *s)
{
    const size_t lines = (size_t)s->line_count * FE__LINE;
    return denormals_in((const float *)s->velocity, lines) + denormals_in((const float *)s->motion, lines) +
           denormals_in((const float *)s->inertia, lines) + denormals_in((const float *)s->axes, lines);
}

static int32_t in_contacts(const fe_world *w)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        const fe__contact *m = w->contacts + fe__pair_of(w->awake_pairs[i]);
        sum +=
            IN(m->normal_impulse) + IN(m->friction_impulse) + IN(m->total_impulse) + denormals_in(&m->twist_impulse, 1);
    }
    return sum;
}

static void count_over(scene *s, int steps)
{
    for (int i = 0; i < steps; ++i) {
        run(s, 1);
        int32_t bodies = in_bodies(s->world), lines = in_lines(&s->world->solver), contacts = in_contacts(s->world);
        if (bodies + lines + contacts > 0)
            fail_msg("step %d: denormals: %d in bodies, %d in lines, %d in contacts", i, (int)bodies, (int)lines,
                     (int)contacts);
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
        TEST(a_denormal_velocity_ends_with_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
