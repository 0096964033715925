// Distances of placed forms against closed forms, and the time of impact against a walk along the whole motion.
#include "fe_test.h"

#include "collision/cast/cast_kinds.h"
#include "collision/cast/toi.h"

#if defined(FE_SANITIZED)
enum { CASES = 300, SAMPLES = 100 };
#else
enum { CASES = 3000, SAMPLES = 300 };
#endif

static uint64_t state_of_dice = 1;
static double uniform(double low, double high)
{
    state_of_dice = state_of_dice * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(state_of_dice >> 11) * 0x1p-53;
}

static fe_dvec3 somewhere(double half)
{
    double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return (fe_dvec3){x, y, z};
}

static fe_quat any_rotation(void)
{
    fe_dvec3 a = somewhere(1);
    return fe__normalized((fe_quat){(float)a.x, (float)a.y, (float)a.z, (float)uniform(-1, 1)});
}

// a turn by less than half a circle
static fe_quat any_turn(double most)
{
    fe_dvec3 a = somewhere(most);
    return fe__normalized((fe_quat){(float)a.x, (float)a.y, (float)a.z, 1.0f});
}

// sphere, capsule, box, plane, triangle of about `size` m
static fe__form any_form(int kind, double size)
{
    fe__form form = {.type = FE__FORM_SPHERE};
    float a = (float)(size * uniform(0.2, 1)), b = (float)(size * uniform(0.2, 1)), c = (float)(size * uniform(0.2, 1));
    if (kind < 2) form.radius = a;
    if (kind == 1) form.type = FE__FORM_CAPSULE, form.half_height = b;
    if (kind == 2) form.type = FE__FORM_BOX, form.half = fe__vec3(a, b, c);
    if (kind == 3) form.type = FE__FORM_PLANE, form.normal = fe__vec3(0.6f, 0.8f, 0.0f), form.distance = a;
    if (kind == 4) {
        form.type = FE__FORM_TRIANGLE;
        for (int i = 0; i < 3; ++i) form.vertex[i] = fe__narrow(somewhere(size));
    }
    return form;
}

// A ball's distance to a form is that of its centre, less its radius. Sizes from 1 cm to 1 km; bound: 1e-9 of what is
// there, and the rounding of a plane's normal (a float's length) over the distance to it.
static void a_balls_gap_is_that_of_its_centre(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        double size = 0.01 * (double)(1 << i % 17);
        fe__form ball = any_form(0, size), other = any_form(1 + i % 3, size);
        fe__pose a = {somewhere(3 * size), any_rotation()}, b = {somewhere(3 * size), any_rotation()};
        fe__nearest near = fe__form_nearest(&other, fe__drotate_back(b.rotation, fe__dsub(a.position, b.position)));
        if (near.distance + (double)other.radius < 1e-6 * size) continue; // the cores overlap
        fe__gap gap, back;
        fe__form_gap(&ball, &a, &other, &b, &gap);
        fe__form_gap(&other, &b, &ball, &a, &back);
        double bound = other.type == FE__FORM_PLANE ? 1e-6 * size : 1e-9 * size;
        FE_NEAR(gap.distance, near.distance - (double)ball.radius, bound);
        FE_NEAR(back.distance, gap.distance, bound);
        FE_NEAR(fe__ddot(gap.normal, gap.normal), 1, 1e-9);
        FE_NEAR(fe__ddot(gap.normal, back.normal), -1, 1e-9);
        FE_NEAR(fe__ddot(gap.normal, fe__drotate(b.rotation, near.normal)), -1, 1e-6);
    }
}

// The gap is how far one form may go along the normal until they touch, and B's nearest point lies there.
static void a_gap_closes_along_its_normal(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        fe__form a = any_form(i % 3, 1), b = any_form(i / 3 % 5, 1);
        fe__pose at_a = {somewhere(3), any_rotation()}, at_b = {somewhere(3), any_rotation()};
        fe__gap gap, less;
        fe__form_gap(&a, &at_a, &b, &at_b, &gap);
        if (gap.overlap || gap.distance < 0.01) continue;
        at_a.position = fe__dadd(at_a.position, fe__dscale(gap.distance - 0.005, gap.normal));
        fe__form_gap(&a, &at_a, &b, &at_b, &less);
        FE_NEAR(less.distance, 0.005, b.type == FE__FORM_PLANE ? 1e-6 : 1e-9);
    }
}

static fe__mobile any_mobile(const fe__form *form, double offset, double way, double turn)
{
    fe__motion m = {somewhere(offset), any_rotation(), somewhere(way), any_turn(turn)};
    return (fe__mobile){form, somewhere(0.5), any_rotation(), m};
}

static double gap_at(const fe__mobile *a, const fe__mobile *b, double s)
{
    fe__gap gap;
    fe__pose at_a = fe__mobile_at(a, s), at_b = fe__mobile_at(b, s);
    fe__form_gap(a->form, &at_a, b->form, &at_b, &gap);
    return gap.overlap ? -1 : gap.distance;
}

// Poses are turned in floats: a millionth of the arms. Up to the impact the gap is never less than half of what counts
// as a touch.
#define ROUNDING 2e-6

static void judge(const fe__mobile *a, const fe__mobile *b, int *met)
{
    fe__impact impact;
    fe__meeting meeting = fe__time_of_impact(a, b, 1.0, &impact);
    double end = meeting == FE_MEET_NEVER ? 1.0 : impact.s, begin = gap_at(a, b, 0.0);
    ++met[meeting];
    if (meeting == FE_MEET_NOW) FE_WITHIN(begin, -1e30, 0);
    if (meeting == FE_MEET_NOW) return;
    FE_WITHIN(begin, 0, 1e30);
    for (int i = 0; i <= SAMPLES; ++i)
        FE_WITHIN(gap_at(a, b, end * i / SAMPLES), begin < FE_TOUCH ? 0 : 0.25 * FE_TOUCH - ROUNDING, 1e30);
    if (meeting == FE_MEET_LATER) FE_WITHIN(gap_at(a, b, end), 0, FE_TOUCH + ROUNDING);
    if (meeting == FE_MEET_LATER) FE_WITHIN(impact.s, 0, 1);
}

// Every kind against every kind, both moving and turning: the first touch is found, within a tenth of a millimetre, and
// none that is none.
static void the_time_of_impact_is_the_first_touch(void **state)
{
    int met[3] = {0};
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        fe__form a = any_form(i % 3, 1), b = any_form(i / 3 % 5, 1);
        fe__mobile first = any_mobile(&a, 4, 6, 0.8),
                   second = any_mobile(&b, 4, 6, b.type >= FE__FORM_PLANE ? 0.0 : 0.8);
        if (b.type == FE__FORM_PLANE) second.motion.translation = (fe_dvec3){0, 0, 0};
        judge(&first, &second, met);
        judge(&second, &first, met);
    }
    for (int k = 0; k < 3; ++k) FE_WITHIN(met[k], CASES / 20, 2 * CASES);
}

// A stick that turns above a plate without touching it by a millimetre is no impact.
static void a_near_miss_is_none(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        fe__form stick = {.type = FE__FORM_CAPSULE, .half_height = 1.0f, .radius = 0.05f};
        fe__form plate = {.type = FE__FORM_BOX, .half = {10.0f, 0.1f, 10.0f}};
        fe__motion turning = {{0, 1.051 + 0.1, 0}, any_rotation(), {uniform(-5, 5), 0, uniform(-5, 5)}, any_turn(2)};
        fe__motion still = {{0, 0, 0}, fe__identity(), {0, 0, 0}, fe__identity()};
        fe__mobile a = {&stick, {0, 0, 0}, fe__identity(), turning}, b = {&plate, {0, 0, 0}, fe__identity(), still};
        fe__impact impact;
        FE_TRUE(fe__time_of_impact(&a, &b, 1.0, &impact) == FE_MEET_NEVER);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_balls_gap_is_that_of_its_centre),
        cmocka_unit_test(a_gap_closes_along_its_normal),
        cmocka_unit_test(the_time_of_impact_is_the_first_touch),
        cmocka_unit_test(a_near_miss_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
