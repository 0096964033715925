// fe_test.h - what every test includes: cmocka, and comparisons of floating-point values that a NaN cannot pass.
//
// A failed comparison prints the expression, its value and what was allowed. Bounds come from physics or from constants
// of the library, never from what the code printed.
#ifndef FE_TEST_H
#define FE_TEST_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static inline void fe_test_within(double value, double low, double high, const char *text, const char *file, int line)
{
    if (value >= low && value <= high) return; // a NaN is neither
    print_error("%s = %.17g is not in [%.17g, %.17g]\n", text, value, low, high);
    _fail(file, line);
}

static inline void fe_test_near(double value, double expected, double tolerance, const char *text, const char *file,
                                int line)
{
    double error = value - expected;
    if (error >= -tolerance && error <= tolerance) return;
    print_error("%s = %.17g is not %.17g +- %.3g (off by %.3g)\n", text, value, expected, tolerance, error);
    _fail(file, line);
}

static inline void fe_test_true(int holds, const char *text, const char *file, int line)
{
    if (holds) return;
    print_error("%s does not hold\n", text);
    _fail(file, line);
}

#define FE_NEAR(value, expected, tolerance) \
    fe_test_near((double)(value), (double)(expected), (double)(tolerance), #value, __FILE__, __LINE__)
#define FE_WITHIN(value, low, high) \
    fe_test_within((double)(value), (double)(low), (double)(high), #value, __FILE__, __LINE__)
#define FE_TRUE(condition) fe_test_true((condition) ? 1 : 0, #condition, __FILE__, __LINE__)

#endif
