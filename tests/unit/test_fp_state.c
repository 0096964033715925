// Whatever the host has done to the floating-point state, Feather computes in its own, on every thread, and hands the
// host's back.
#include "fe_test.h"

#include "core/fp_state.h"
#include "core/threads.h"

#include <fenv.h>
#include <float.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
enum { FLUSH_RESULTS = 0x8000, FLUSH_INPUTS = 0x0040, ROUND_UP = 0x4000, OVERFLOW_TRAP = 0x0400 };
static uint64_t state_now(void) { return _mm_getcsr(); }
static void set_state(uint64_t state) { _mm_setcsr((unsigned)state); }
static uint64_t hostile_state(void)
{
    return (_mm_getcsr() | FLUSH_RESULTS | FLUSH_INPUTS | ROUND_UP) & ~(unsigned)OVERFLOW_TRAP;
}
#elif defined(__aarch64__)
enum { FLUSH = 1 << 24, ROUND_UP = 1 << 22 };
static uint64_t state_now(void)
{
    uint64_t state;
    __asm__ volatile("mrs %0, fpcr" : "=r"(state) : : "memory");
    return state;
}
static void set_state(uint64_t state) { __asm__ volatile("msr fpcr, %0" : : "r"(state) : "memory"); }
static uint64_t hostile_state(void) { return FLUSH | ROUND_UP; }
#else
static uint64_t state_now(void) { return 0; }
static void set_state(uint64_t state) { (void)state; }
static uint64_t hostile_state(void) { return 0; }
#endif

static volatile float least_normal = FLT_MIN, half = 0.5f, one = 1.0f, third = 3.0f, most = FLT_MAX;

// Each check fails in one hostile mode: flushed results, flushed inputs, directed rounding, traps (which would end the
// program).
static int computes_as_ieee_says(void)
{
    volatile float denormal = least_normal * half;
    if (denormal == 0.0f) return 0;
    if (denormal / half != least_normal) return 0;
    volatile float up = one / third, down = -one / third;
    if (up != -down || (double)up < 0.3333333 || (double)up > 0.33333335) return 0;
    volatile float tie = one + FLT_EPSILON * half; // to even: 1
    if (tie != one) return 0;
    volatile float infinite = most * third;
    return infinite > most;
}

static void the_hosts_state_is_replaced_and_restored(void **state)
{
    (void)state;
    uint64_t before = state_now(), hostile = hostile_state();
    set_state(hostile);
    fe__fp_state saved = fe__fp_enter();
    int right = computes_as_ieee_says();
    fe__fp_leave(saved);
    uint64_t after = state_now();
    set_state(before);
    FE_TRUE(right);
    assert_int_equal(after, hostile);
}

static void entering_twice_leaves_as_found(void **state)
{
    (void)state;
    uint64_t before = state_now(), hostile = hostile_state();
    set_state(hostile);
    fe__fp_state outer = fe__fp_enter();
    fe__fp_state inner = fe__fp_enter();
    fe__fp_leave(inner);
    int right = computes_as_ieee_says();
    fe__fp_leave(outer);
    uint64_t after = state_now();
    set_state(before);
    FE_TRUE(right);
    assert_int_equal(after, hostile);
}

typedef struct findings {
    _Atomic int32_t right, wrong;
} findings;

static void check(void *argument, int32_t index)
{
    (void)index;
    findings *f = argument;
    atomic_fetch_add(computes_as_ieee_says() ? &f->right : &f->wrong, 1);
}

// Threads inherit the state of the one that starts them: here a hostile one.
static void every_worker_computes_in_the_same_state(void **state)
{
    (void)state;
    uint64_t before = state_now(), hostile = hostile_state();
    findings f = {0};
    set_state(hostile);
    fe_pool *pool = fe__pool_create(4);
    for (int i = 0; i < 200; ++i) fe__pool_run(pool, check, &f, 8);
    uint64_t after = state_now();
    fe__pool_destroy(pool);
    set_state(before);
    assert_int_equal(f.right, 200 * 8);
    assert_int_equal(f.wrong, 0);
#if defined(__x86_64__)
    const uint64_t raised = 0x3F; // the host's own work between the calls may raise flags
#else
    const uint64_t raised = 0;
#endif
    assert_int_equal(after & ~raised, hostile & ~raised);
}

static void hostile_run(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    uint64_t before = state_now();
    for (int32_t i = count - 1; i >= 0; --i) {
        set_state(hostile_state());
        task(argument, i);
    }
    set_state(before);
}

static void tasks_of_a_hosts_system_compute_in_the_same_state(void **state)
{
    (void)state;
    findings f = {0};
    fe__workers workers = {.count = 4,
                           .tasks = {.struct_size = sizeof workers.tasks, .worker_count = 4, .run = hostile_run}};
    fe__run(&workers, check, &f, 4);
    assert_int_equal(f.right, 4);
    assert_int_equal(f.wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hosts_state_is_replaced_and_restored),
        cmocka_unit_test(entering_twice_leaves_as_found),
        cmocka_unit_test(every_worker_computes_in_the_same_state),
        cmocka_unit_test(tasks_of_a_hosts_system_compute_in_the_same_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
