// Runs: every task once, all back before the run is, from several threads at once, and no core burnt in between.
#include "fe_test.h"

#include "core/clock.h"
#include "core/fp_state.h"
#include "core/os_thread.h"
#include "core/threads.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

enum { MOST_TASKS = 64, HANG_LIMIT = 100 }; // HANG_LIMIT: s, after which a run that never ends ends the program

// What a run's tasks write, each its own element, without atomics: the run's return makes it visible.
typedef struct tally {
    int32_t times[MOST_TASKS];
    int64_t sum;
} tally;

static void mark(void *argument, int32_t index) { ((tally *)argument)->times[index] += 1; }

static void assert_marked(const tally *t, int32_t count, int32_t times)
{
    for (int32_t i = 0; i < MOST_TASKS; ++i) assert_int_equal(t->times[i], i < count ? times : 0);
}

static fe_pool *crowded_pool(int32_t worker_count)
{
    fe_pool *pool = fe__pool_create(worker_count);
    assert_non_null(pool);
    fe__pool_assume_cores(pool, FE_MAX_WORKERS); // all its threads take part, however few cores there are
    return pool;
}

static void every_task_runs_once(void **state)
{
    (void)state;
    const int32_t workers[] = {1, 2, 3, 8, 64};
    for (size_t w = 0; w < sizeof workers / sizeof *workers; ++w) {
        fe_pool *pool = crowded_pool(workers[w]);
        assert_int_equal(fe__pool_worker_count(pool), workers[w]);
        for (int32_t count = 0; count <= MOST_TASKS; ++count) {
            tally t = {0};
            for (int i = 0; i < 5; ++i) fe__pool_run(pool, mark, &t, count);
            assert_marked(&t, count, 5);
        }
        fe__pool_destroy(pool);
    }
}

static void a_pool_has_1_to_64_workers(void **state)
{
    (void)state;
    assert_null(fe__pool_create(0));
    assert_null(fe__pool_create(-1));
    assert_null(fe__pool_create(FE_MAX_WORKERS + 1));
}

static void pools_come_and_go(void **state)
{
    (void)state;
    for (int i = 0; i < 100; ++i) {
        fe_pool *pool = crowded_pool(1 + i % 8);
        tally t = {0};
        if (i % 2) fe__pool_run(pool, mark, &t, 8);
        fe__pool_destroy(pool);
        assert_marked(&t, i % 2 ? 8 : 0, 1);
    }
}

static void worlds_are_counted_in_and_out(void **state)
{
    (void)state;
    fe_pool *pool = fe__pool_create(1);
    int32_t users = -1;
    assert_int_equal(fe__pool_retain(pool), FE_OK);
    assert_int_equal(fe__pool_retain(pool), FE_OK);
    assert_int_equal(fe__pool_try_destroy(pool, &users), FE_ERROR_STATE);
    assert_int_equal(users, 2);
    fe__pool_release(pool);
    assert_int_equal(fe__pool_try_destroy(pool, &users), FE_ERROR_STATE);
    assert_int_equal(users, 1);
    fe__pool_release(pool);
    assert_true(fe__pool_lives(pool));
    assert_int_equal(fe__pool_try_destroy(pool, &users), FE_OK);
    assert_false(fe__pool_lives(pool));
    assert_int_equal(fe__pool_try_destroy(pool, &users), FE_ERROR_STALE);
    assert_int_equal(fe__pool_retain(pool), FE_ERROR_STALE);
}

// ---- several callers -----------------------------------------------------------------------------------------------

typedef struct caller {
    fe_pool *pool;
    int32_t runs, most_tasks;
    int64_t wrong;
} caller;

static void *call_runs(void *argument)
{
    caller *c = argument;
    for (int32_t i = 0; i < c->runs; ++i) {
        tally t = {0};
        int32_t count = 1 + i % c->most_tasks;
        int in_step = i / 32 % 2;
        if (in_step) fe__pool_begin(c->pool);
        fe__pool_run(c->pool, mark, &t, count);
        if (in_step) fe__pool_end(c->pool);
        for (int32_t k = 0; k < MOST_TASKS; ++k) c->wrong += t.times[k] != (k < count);
        if (i % 501 == 500) usleep(300); // long enough for every worker to fall asleep
    }
    return NULL;
}

static void run_callers(fe_pool *pool, int32_t caller_count, int32_t runs, int32_t most_tasks)
{
    pthread_t threads[64];
    caller callers[64];
    for (int32_t i = 0; i < caller_count; ++i) {
        callers[i] = (caller){pool, runs, most_tasks, 0};
        assert_int_equal(pthread_create(&threads[i], NULL, call_runs, &callers[i]), 0);
    }
    for (int32_t i = 0; i < caller_count; ++i) {
        pthread_join(threads[i], NULL);
        assert_int_equal(callers[i].wrong, 0);
    }
}

static void four_worlds_share_a_pool(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(8);
    run_callers(pool, 4, 5000, 12);
    fe__pool_destroy(pool);
}

// more runs at once than the pool has places for: the rest is done by their callers
static void any_number_of_worlds_share_a_pool(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(4);
    run_callers(pool, 48, 300, 6);
    fe__pool_destroy(pool);
}

static void sixteen_workers_work_on_the_cores_there_are(void **state)
{
    (void)state;
    fe_pool *pool = fe__pool_create(16);
    run_callers(pool, 2, 3000, 16);
    fe__pool_destroy(pool);
}

// ---- runs inside runs ----------------------------------------------------------------------------------------------

typedef struct nest {
    fe_pool *pool;
    _Atomic int32_t inner, strangers;
} nest;

typedef struct nested_call {
    nest *nest;
    pthread_t thread;
} nested_call;

static void inner_task(void *argument, int32_t index)
{
    nested_call *call = argument;
    (void)index;
    atomic_fetch_add(&call->nest->inner, 1);
    if (!pthread_equal(call->thread, pthread_self())) atomic_fetch_add(&call->nest->strangers, 1);
}

static void outer_task(void *argument, int32_t index)
{
    (void)index;
    nested_call call = {argument, pthread_self()};
    fe__pool_run(call.nest->pool, inner_task, &call, 5);
}

static void a_run_inside_a_task_stays_on_its_thread(void **state)
{
    (void)state;
    nest n = {.pool = crowded_pool(4)};
    for (int i = 0; i < 500; ++i) fe__pool_run(n.pool, outer_task, &n, 8);
    assert_int_equal(n.inner, 500 * 8 * 5);
    assert_int_equal(n.strangers, 0);
    fe__pool_destroy(n.pool);
}

// ---- parallel_for --------------------------------------------------------------------------------------------------

enum { RANGE = 10007 }; // a prime: no block size divides it

typedef struct range_tally {
    int32_t block, worker_count;
    int32_t times[RANGE];
    int32_t per_worker[FE_MAX_WORKERS]; // each worker's own: two with one number would race
    _Atomic int32_t wrong, calls;
} range_tally;

static void mark_range(void *argument, int32_t first, int32_t end, int32_t worker)
{
    range_tally *t = argument;
    int right = first >= 0 && first < end && end <= RANGE && worker >= 0 && worker < t->worker_count;
    right = right && (t->calls == 0 || end - first <= t->block);
    if (!right) {
        atomic_fetch_add(&t->wrong, 1);
        return;
    }
    for (int32_t i = first; i < end; ++i) t->times[i] += 1;
    t->per_worker[worker] += end - first;
    atomic_fetch_add(&t->calls, 1);
}

static void assert_range_covered(const fe__workers *workers, int32_t block)
{
    static range_tally t;
    t = (range_tally){.block = block, .worker_count = workers->count};
    fe__parallel_for(workers, RANGE, block, mark_range, &t);
    int32_t sum = 0;
    for (int32_t i = 0; i < RANGE; ++i) assert_int_equal(t.times[i], 1);
    for (int32_t i = 0; i < FE_MAX_WORKERS; ++i) sum += t.per_worker[i];
    assert_int_equal(sum, RANGE);
    assert_int_equal(t.wrong, 0);
    if (workers->count == 1 || block >= RANGE) assert_int_equal(t.calls, 1);
}

static void run_backwards(void *user, fe_task task, void *argument, int32_t count)
{
    *(int32_t *)user += 1;
    for (int32_t i = count - 1; i >= 0; --i) task(argument, i);
}

static void blocks_cover_the_range_once(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(8);
    int32_t host_runs = 0;
    const fe__workers of_pool = {.count = 8, .pool = pool}, alone = {.count = 1, .pool = pool}, none = {.count = 8};
    const fe__workers of_host = {.count = 8, .tasks = {.worker_count = 8, .run = run_backwards, .user = &host_runs}};
    const int32_t blocks[] = {1, 2, 64, 1000, RANGE - 1, RANGE, RANGE + 1, INT32_MAX};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) {
        assert_range_covered(&of_pool, blocks[b]);
        assert_range_covered(&alone, blocks[b]);
        assert_range_covered(&none, blocks[b]);
        assert_range_covered(&of_host, blocks[b]);
    }
    assert_int_equal(host_runs, 5); // the blocks that do not hold it all
    fe__pool_destroy(pool);
}

static void count_range(void *argument, int32_t first, int32_t end, int32_t worker)
{
    (void)worker;
    atomic_fetch_add((_Atomic int64_t *)argument, (int64_t)end - first);
}

static void the_largest_range_does_not_overflow(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(4);
    const fe__workers workers = {.count = 4, .pool = pool};
    const int32_t blocks[] = {1 << 20, (1 << 30) - 1, 1 << 30, INT32_MAX - 1};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) {
        _Atomic int64_t total = 0;
        fe__parallel_for(&workers, INT32_MAX, blocks[b], count_range, (void *)&total);
        assert_int_equal(total, INT32_MAX);
    }
    _Atomic int64_t nothing = 0;
    fe__parallel_for(&workers, 0, 10, count_range, (void *)&nothing);
    assert_int_equal(nothing, 0);
    fe__pool_destroy(pool);
}

// ---- time ----------------------------------------------------------------------------------------------------------

// Tasks that are in the same run and both running may wait for each other, as a solver's barriers do; here with as many
// threads as tasks, each of which must come although all were asleep.
typedef struct meeting {
    _Atomic int32_t present;
    int32_t expected;
} meeting;

static void meet(void *argument, int32_t index)
{
    meeting *m = argument;
    (void)index;
    atomic_fetch_add(&m->present, 1);
    while (atomic_load(&m->present) < m->expected) fe__yield();
}

static void all_sleepers_come_when_there_is_work_for_all(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(8);
    for (int i = 0; i < 20; ++i) {
        meeting m = {.expected = 8};
        usleep(2000);
        fe__pool_run(pool, meet, &m, 8);
        assert_int_equal(m.present, 8);
    }
    fe__pool_destroy(pool);
}

// s, of all threads of the process
static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// 7 idle threads would use 7 times 0.2 s, or all of the cores there are; asleep they use nothing. Bound: a tenth of one
// core. Where other programs hold the cores, the spinning after the run ends late: one quiet window of 20 is enough.
static void an_idle_pool_burns_no_core(void **state)
{
    (void)state;
    fe_pool *pool = crowded_pool(8);
    tally t = {0};
    fe__pool_run(pool, mark, &t, 8);
    double least = INFINITY;
    for (int window = 0; window < 20 && least > 0.02; ++window) {
        double before = processor_time();
        usleep(200000);
        least = fmin(least, processor_time() - before);
    }
    FE_WITHIN(least, 0.0, 0.02);
    fe__pool_destroy(pool);
}

static void the_clock_never_goes_back(void **state)
{
    (void)state;
    double last = fe__clock(), start = last;
    for (int i = 0; i < 10000; ++i) {
        double now = fe__clock();
        assert_true(now >= last);
        last = now;
    }
    usleep(20000); // Windows may wake a sleeper a tick early, 15.6 ms
    FE_WITHIN(fe__clock() - start, 0.004, 60.0);
}

// ---- signals -------------------------------------------------------------------------------------------------------
#if !defined(_WIN32) // has none

typedef struct mask_seen {
    sigset_t blocked;
    int failed;
} mask_seen;

static void see_mask(void *argument)
{
    mask_seen *seen = argument;
    seen->failed = pthread_sigmask(SIG_BLOCK, NULL, &seen->blocked);
}

// A blocked fault ends the process without a word of its handlers; a blocked signal to the thread keeps a collector
// waiting for ever, once a callback has made the thread one of its own.
static void threads_block_what_is_sent_to_the_process_and_no_more(void **state)
{
    (void)state;
    const int of_the_process[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGCHLD, SIGWINCH, SIGCONT};
    const int of_the_thread[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGXCPU, SIGUSR1, SIGUSR2};
    mask_seen seen;
    fe__os_thread thread;
    assert_true(fe__os_thread_start(&thread, see_mask, &seen));
    fe__os_thread_join(&thread);
    assert_int_equal(seen.failed, 0);
    for (size_t i = 0; i < sizeof of_the_process / sizeof *of_the_process; ++i)
        assert_true(sigismember(&seen.blocked, of_the_process[i]));
    for (size_t i = 0; i < sizeof of_the_thread / sizeof *of_the_thread; ++i)
        assert_false(sigismember(&seen.blocked, of_the_thread[i]));
#if defined(__linux__)
    assert_false(sigismember(&seen.blocked, SIGPWR));
    for (int s = SIGRTMIN; s <= SIGRTMAX; ++s) assert_false(sigismember(&seen.blocked, s));
#endif
}
#endif

int main(void)
{
#if !defined(_WIN32)
    alarm(HANG_LIMIT);
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_task_runs_once),
        cmocka_unit_test(a_pool_has_1_to_64_workers),
        cmocka_unit_test(pools_come_and_go),
        cmocka_unit_test(worlds_are_counted_in_and_out),
        cmocka_unit_test(four_worlds_share_a_pool),
        cmocka_unit_test(any_number_of_worlds_share_a_pool),
        cmocka_unit_test(sixteen_workers_work_on_the_cores_there_are),
        cmocka_unit_test(a_run_inside_a_task_stays_on_its_thread),
        cmocka_unit_test(blocks_cover_the_range_once),
        cmocka_unit_test(the_largest_range_does_not_overflow),
        cmocka_unit_test(all_sleepers_come_when_there_is_work_for_all),
        cmocka_unit_test(an_idle_pool_burns_no_core),
        cmocka_unit_test(the_clock_never_goes_back),
#if !defined(_WIN32)
        cmocka_unit_test(threads_block_what_is_sent_to_the_process_and_no_more),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
