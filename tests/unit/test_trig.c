// Sine, cosine and arc tangent: as exact as promised, symmetric, and the same bits everywhere.
#include "fe_test.h"

#include "core/bytes.h"
#include "core/math.h"

#include <float.h>
#include <math.h>

// The reference is the library's long double, which has 11 bits more at least (on the machines where it is not a
// double).
#define PI_L 3.141592653589793238462643383279502884L

static uint64_t noise = 1;

static double uniform(double low, double high)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(noise >> 11) * 0x1p-53;
}

// |value - reference| in units of the last place of the reference
static double units_off(double value, long double reference)
{
    int exponent;
    (void)frexpl(reference, &exponent);
    return (double)(fabsl((long double)value - reference) / ldexpl(1.0L, exponent - DBL_MANT_DIG));
}

static double sine(double x)
{
    double s, c;
    fe__sincos(x, &s, &c);
    return s;
}

static double cosine(double x)
{
    double s, c;
    fe__sincos(x, &s, &c);
    return c;
}

static void assert_sine_and_cosine(double x)
{
    FE_WITHIN(units_off(sine(x), sinl((long double)x)), 0.0, 1.0);
    FE_WITHIN(units_off(cosine(x), cosl((long double)x)), 0.0, 1.0);
}

static void sine_and_cosine_are_off_by_one_unit_at_most(void **state)
{
    (void)state;
    for (int i = 0; i < 100000; ++i) {
        assert_sine_and_cosine(uniform(-1e5, 1e5));
        assert_sine_and_cosine(uniform(-4.0, 4.0));
        assert_sine_and_cosine(exp(uniform(-40.0, 11.0)));
    }
}

// Next to a multiple of pi/2 the result is what the reduction leaves of 53 bits: only an exact one has a digit right.
static void the_reduction_is_exact_up_to_1e5(void **state)
{
    (void)state;
    for (int n = -63000; n <= 63000; n += 7) {
        if (n == 0) continue;
        assert_sine_and_cosine((double)(PI_L / 2 * n));
    }
}

static void sine_is_odd_and_cosine_even_to_the_bit(void **state)
{
    (void)state;
    for (int i = 0; i < 10000; ++i) {
        double x = uniform(0.0, 1000.0), s = sine(x), c = cosine(x);
        assert_true(sine(-x) == -s && cosine(-x) == c);
        FE_NEAR(s * s + c * c, 1.0, 4.0 * DBL_EPSILON);
    }
    assert_true(sine(0.0) == 0.0 && cosine(0.0) == 1.0);
}

static void angles_without_meaning_have_a_sine_all_the_same(void **state)
{
    (void)state;
    const double huge[] = {1.1e9, 1e300, INFINITY};
    for (int i = 0; i < 3; ++i) {
        assert_true(sine(huge[i]) == 0.0 && cosine(huge[i]) == 1.0);
        assert_true(sine(-huge[i]) == 0.0 && cosine(-huge[i]) == 1.0);
    }
    for (int i = 0; i < 1000; ++i) { // up to the limit: a unit in the last place of the angle
        double x = uniform(1e5, 1073741824.0);
        FE_NEAR(sine(x), sinl((long double)x), x * DBL_EPSILON);
    }
    FE_TRUE(isnan(sine(NAN)) && isnan(cosine(NAN)));
}

static void the_arc_tangent_is_off_by_two_units_at_most(void **state)
{
    (void)state;
    for (int i = 0; i < 100000; ++i) {
        double y = uniform(-1.0, 1.0), x = uniform(-1.0, 1.0), scale = exp(uniform(-40.0, 40.0));
        FE_WITHIN(units_off(fe__atan2(y, x), atan2l((long double)y, (long double)x)), 0.0, 2.0);
        FE_WITHIN(units_off(fe__atan2(y * scale, x), atan2l((long double)(y * scale), (long double)x)), 0.0, 2.0);
    }
}

static void the_arc_tangent_knows_its_axes(void **state)
{
    (void)state;
    const double pi = (double)PI_L;
    assert_true(fe__atan2(0.0, 0.0) == 0.0 && fe__atan2(-0.0, -0.0) == 0.0);
    assert_true(fe__atan2(0.0, 3.0) == 0.0 && fe__atan2(0.0, -3.0) == pi && fe__atan2(-0.0, -3.0) == pi);
    assert_true(fe__atan2(2.0, 0.0) == pi / 2 && fe__atan2(-2.0, 0.0) == -pi / 2);
    assert_true(fe__atan2(1.0, 1.0) == pi / 4 && fe__atan2(-1.0, 1.0) == -pi / 4);
    FE_NEAR(fe__atan2(1.0, -1.0), 3 * pi / 4, 2.0 * DBL_EPSILON);
    assert_true(fe__atan2(DBL_TRUE_MIN, 1.0) == DBL_TRUE_MIN);
    FE_TRUE(isnan(fe__atan2(NAN, 1.0)) && isnan(fe__atan2(1.0, NAN)) && isnan(fe__atan2(NAN, 0.0)) &&
            isnan(fe__atan2(0.0, NAN)));
}

static void float_versions_round_the_double_ones(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; ++i) {
        float x = (float)uniform(-1.0, 1.0), s, c;
        fe__sincosf(x, &s, &c);
        assert_true(s == (float)sine((double)x) && c == (float)cosine((double)x));
        assert_true(fe__atan2f(x, 0.5f) == (float)fe__atan2((double)x, 0.5));
    }
}

// The fingerprint of 40,000 results, found with gcc on x86-64. No other compiler, level or machine may have another.
static void every_machine_computes_the_same_bits(void **state)
{
    (void)state;
    fe__hash hash = fe__hash_begin();
    noise = 20;
    for (int i = 0; i < 10000; ++i) {
        double x = uniform(-1e5, 1e5), y = uniform(-10.0, 10.0), unit = uniform(-1.0, 1.0);
        fe__hash_double(&hash, sine(x));
        fe__hash_double(&hash, cosine(x));
        fe__hash_double(&hash, sine(y));
        fe__hash_double(&hash, fe__atan2(y, unit));
    }
    assert_true(fe__hash_end(&hash) == UINT64_C(0x9E4056A26A5E231B));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sine_and_cosine_are_off_by_one_unit_at_most),
        cmocka_unit_test(the_reduction_is_exact_up_to_1e5),
        cmocka_unit_test(sine_is_odd_and_cosine_even_to_the_bit),
        cmocka_unit_test(angles_without_meaning_have_a_sine_all_the_same),
        cmocka_unit_test(the_arc_tangent_is_off_by_two_units_at_most),
        cmocka_unit_test(the_arc_tangent_knows_its_axes),
        cmocka_unit_test(float_versions_round_the_double_ones),
        cmocka_unit_test(every_machine_computes_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
