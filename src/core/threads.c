// threads.c - see threads.h. The system's threads (os_thread.h) and C11 atomics.
//
// A run takes one of the pool's slots, says how many tasks it has, and raises its bit in `open`. Whoever sees the bit,
// the caller first of all, claims tasks by counting `unclaimed` down, and counts `unfinished` down when one has
// returned; at 0 the caller takes its slot back. A slot's task and argument are read only by who has claimed one of its
// tasks, and until that task is finished the slot cannot change hands: so a worker that comes late to a slot that was
// given away meanwhile claims a task of the new run, or nothing, and either is right. No run allocates. When all slots
// are taken, or from inside a task, the caller does its run alone.
#include "core/threads.h"

#include "core/clock.h"
#include "core/fp_state.h"
#include "core/memory.h"
#include "core/os_thread.h"
#include "core/registry.h"

enum {
    SLOTS = 32,           // bits of fe_pool.open
    PAUSES_PER_LOOK = 16, // spins between two looks at the clock
    WAKE_AT_ONCE =
        2, // sleepers; each of them wakes two more while there is work, so that the caller does not pay for all
};

// Waking a sleeping thread takes some 50 us: spinning for less than that costs little more than it can save. During a
// step the next run is near.
static const double spin_time = 20e-6;       // s
static const double spin_time_step = 200e-6; // s

typedef struct run_slot {
    _Alignas(FE_CACHE_LINE) _Atomic int32_t unclaimed;
    int32_t count;
    fe_task task;
    void *argument;
    _Alignas(FE_CACHE_LINE) _Atomic uint32_t unfinished; // what the caller sleeps on
    _Atomic int32_t caller_sleeps;
} run_slot;

// Each line holds what is written together; spinning workers watch the first.
struct fe_pool {
    _Alignas(FE_CACHE_LINE) _Atomic uint32_t open; // bit s: slot s has unclaimed tasks
    _Atomic int32_t stopping;
    _Atomic int32_t steps;                            // now under way
    _Alignas(FE_CACHE_LINE) _Atomic uint32_t taken;   // bit s: slot s belongs to a caller
    _Alignas(FE_CACHE_LINE) _Atomic int32_t spinning; // workers
    _Atomic int32_t sleeping; // workers that nobody has called; a call takes them off before they are awake
    _Atomic int32_t numbers;  // of threads, given away
    _Atomic uint32_t calls;   // calls not yet taken by a sleeper, what they sleep on
    run_slot slots[SLOTS];

    fe__memory memory;
    int32_t worker_count;
    int32_t thread_count; // worker_count - 1, or as many as the system has
    int32_t started;      // of these; fewer only while the pool is created
    _Atomic int32_t core_count;
    fe__entry entry; // in the registry, which counts the worlds
    fe__os_thread threads[FE_MAX_WORKERS - 1];
    fe__sleep_place place; // of workers and callers
};

static _Thread_local int inside_task;
static _Thread_local int32_t thread_number;
static fe__registry pools = {FE_MUTEX_INITIAL, NULL};

// ---- pausing, yielding -----------------------------------------------------------------------------------

void fe__pause(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("isb" : : : "memory"); // "yield" is a no-op on most cores, this takes about as long as x86's pause
#endif
}

void fe__yield(void) { fe__os_yield(); }

// ---- spinning ------------------------------------------------------------------------------------------------------

typedef struct spinner {
    int32_t turns;
    double start; // s, of the first look at the clock
} spinner;

// More threads want to run than there are cores: who spins keeps from work who has some.
static int is_crowded(fe_pool *pool)
{
    int32_t awake = pool->thread_count - atomic_load_explicit(&pool->sleeping, memory_order_relaxed);
    return awake + 1 > atomic_load_explicit(&pool->core_count, memory_order_relaxed);
}

// One turn. 0: it has lasted long enough, sleep.
static int spin(fe_pool *pool, spinner *spinner)
{
    fe__pause();
    spinner->turns += 1;
    if (spinner->turns % PAUSES_PER_LOOK != 0) return 1;
    if (is_crowded(pool)) return 0;
    double now = fe__clock();
    if (spinner->turns == PAUSES_PER_LOOK) spinner->start = now;
    int32_t steps = atomic_load_explicit(&pool->steps, memory_order_relaxed);
    return now - spinner->start < (steps > 0 ? spin_time_step : spin_time);
}

// ---- tasks ---------------------------------------------------------------------------------------------------------

static void perform(fe_task task, void *argument, int32_t index)
{
    int outer = inside_task;
    fe__fp_state state = fe__fp_enter();
    inside_task = 1;
    task(argument, index);
    inside_task = outer;
    fe__fp_leave(state);
}

static void perform_all(fe_task task, void *argument, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) perform(task, argument, i);
}

// How many tasks were unclaimed before; 0: none is left.
static int32_t claim(run_slot *slot)
{
    int32_t left = atomic_load_explicit(&slot->unclaimed, memory_order_relaxed);
    while (left > 0) {
        if (atomic_compare_exchange_weak_explicit(&slot->unclaimed, &left, left - 1, memory_order_acq_rel,
                                                  memory_order_relaxed))
            return left;
    }
    return 0;
}

static void finish(fe_pool *pool, run_slot *slot)
{
    // The caller says that it sleeps before it looks at the count a last time, we count before we look whether it does:
    // one of us notices. It may have gone on, and the slot be another's, by the time we look: then somebody is woken in
    // vain.
    if (atomic_fetch_sub(&slot->unfinished, 1) == 1 && atomic_load(&slot->caller_sleeps))
        fe__os_wake(&pool->place, &slot->unfinished, 1);
}

static void close_slot(fe_pool *pool, int32_t s)
{
    uint32_t bit = 1u << s;
    if (atomic_load_explicit(&pool->open, memory_order_relaxed) & bit) atomic_fetch_and(&pool->open, ~bit);
}

static void work_on(fe_pool *pool, int32_t s)
{
    run_slot *slot = &pool->slots[s];
    for (int32_t left = claim(slot); left > 0; left = claim(slot)) {
        if (left == 1) close_slot(pool, s);
        perform(slot->task, slot->argument, slot->count - left);
        finish(pool, slot);
    }
}

// ---- calling sleepers ----------------------------------------------------------------------------------------------

// Wakes helpers for so many tasks, as far as spinning workers and the caller do not suffice and cores are free.
static void call_helpers(fe_pool *pool, int32_t tasks)
{
    int32_t sleeping = atomic_load(&pool->sleeping), count;
    int32_t core_count = atomic_load_explicit(&pool->core_count, memory_order_relaxed);
    do {
        int32_t awake = pool->thread_count - sleeping;
        int32_t wanted = tasks - atomic_load(&pool->spinning);
        int32_t cores = core_count - 1 - awake;
        count = wanted < cores ? wanted : cores;
        count = count < WAKE_AT_ONCE ? count : WAKE_AT_ONCE;
        count = count < sleeping ? count : sleeping;
        if (count <= 0) return;
    } while (!atomic_compare_exchange_weak(&pool->sleeping, &sleeping, sleeping - count));
    atomic_fetch_add(&pool->calls, (uint32_t)count);
    fe__os_wake(&pool->place, &pool->calls, count);
}

// ---- workers -------------------------------------------------------------------------------------------------------

static int has_news(fe_pool *pool) { return atomic_load(&pool->open) != 0 || atomic_load(&pool->stopping) != 0; }

// Off the list of sleepers, unless somebody has called just now: that call is ours to take.
static int withdraw(fe_pool *pool)
{
    int32_t sleeping = atomic_load(&pool->sleeping);
    while (sleeping > 0) {
        if (atomic_compare_exchange_weak(&pool->sleeping, &sleeping, sleeping - 1)) return 1;
    }
    return 0;
}

static void sleep_until_called(fe_pool *pool)
{
    // first on the list, then a last look: a run that is opened after the look finds us on the list
    atomic_fetch_add(&pool->sleeping, 1);
    if (has_news(pool) && withdraw(pool)) return;
    for (;;) {
        uint32_t calls = atomic_load(&pool->calls);
        while (calls > 0) {
            if (atomic_compare_exchange_weak(&pool->calls, &calls, calls - 1)) return;
        }
        fe__os_sleep_while(&pool->place, &pool->calls, 0);
    }
}

// The open slot after `last`, in a circle: workers spread over the runs of several callers.
static int32_t next_slot(uint32_t open, int32_t last)
{
    uint32_t later = last + 1 < SLOTS ? open & (~0u << (last + 1)) : 0;
    return __builtin_ctz(later ? later : open);
}

static void wait_for_work(fe_pool *pool)
{
    spinner spinner = {0};
    int spins = 1;
    atomic_fetch_add(&pool->spinning, 1);
    while (spins && !has_news(pool)) spins = spin(pool, &spinner);
    atomic_fetch_sub(&pool->spinning, 1);
    if (!spins) sleep_until_called(pool);
}

static void work(void *argument)
{
    fe_pool *pool = argument;
    int32_t last = SLOTS - 1;
    thread_number = atomic_fetch_add(&pool->numbers, 1) + 1;
    while (!atomic_load(&pool->stopping)) {
        uint32_t open = atomic_load_explicit(&pool->open, memory_order_acquire);
        if (open == 0) {
            wait_for_work(pool);
            continue;
        }
        last = next_slot(open, last);
        call_helpers(pool, atomic_load_explicit(&pool->slots[last].unclaimed, memory_order_relaxed) - 1);
        work_on(pool, last);
    }
}

// ---- runs ----------------------------------------------------------------------------------------------------------

// -1: all are taken
static int32_t take_slot(fe_pool *pool)
{
    uint32_t taken = atomic_load_explicit(&pool->taken, memory_order_relaxed);
    while (taken != ~0u) {
        int32_t s = __builtin_ctz(~taken);
        if (atomic_compare_exchange_weak_explicit(&pool->taken, &taken, taken | 1u << s, memory_order_acquire,
                                                  memory_order_relaxed))
            return s;
    }
    return -1;
}

static void await_finish(fe_pool *pool, run_slot *slot)
{
    spinner spinner = {0};
    while (atomic_load_explicit(&slot->unfinished, memory_order_acquire) > 0) {
        if (spin(pool, &spinner)) continue;
        atomic_store(&slot->caller_sleeps, 1);
        for (uint32_t left = atomic_load(&slot->unfinished); left > 0; left = atomic_load(&slot->unfinished)) {
            fe__os_sleep_while(&pool->place, &slot->unfinished, left);
        }
        atomic_store_explicit(&slot->caller_sleeps, 0, memory_order_relaxed);
    }
}

void fe__pool_run(fe_pool *pool, fe_task task, void *argument, int32_t count)
{
    if (count <= 0) return;
    int alone = count == 1 || inside_task || pool->thread_count == 0;
    int32_t s = alone ? -1 : take_slot(pool);
    if (s < 0) {
        perform_all(task, argument, count);
        return;
    }
    run_slot *slot = &pool->slots[s];
    slot->task = task;
    slot->argument = argument;
    slot->count = count;
    atomic_store_explicit(&slot->unfinished, (uint32_t)count, memory_order_relaxed);
    atomic_store_explicit(&slot->unclaimed, count, memory_order_release);
    atomic_fetch_or(&pool->open, 1u << s);
    call_helpers(pool, count - 1);

    work_on(pool, s);
    close_slot(pool, s); // a worker that came before the bit was up may have claimed the last task
    await_finish(pool, slot);
    atomic_fetch_and_explicit(&pool->taken, ~(1u << s), memory_order_release);
}

void fe__pool_begin(fe_pool *pool)
{
    if (pool) atomic_fetch_add(&pool->steps, 1);
}

void fe__pool_end(fe_pool *pool)
{
    if (pool) atomic_fetch_sub(&pool->steps, 1);
}

// ---- a pool's life -------------------------------------------------------------------------------------------------

static void join_threads(fe_pool *pool)
{
    atomic_store(&pool->stopping, 1);
    atomic_fetch_add(&pool->calls, (uint32_t)pool->thread_count);
    fe__os_wake(&pool->place, &pool->calls, pool->thread_count);
    for (int32_t i = 0; i < pool->started; ++i) fe__os_thread_join(&pool->threads[i]);
    fe__sleep_place_free(&pool->place);
}

static int start_threads(fe_pool *pool)
{
    int32_t limit = fe__os_thread_limit();
    pool->thread_count = pool->worker_count - 1 < limit ? pool->worker_count - 1 : limit;
    atomic_store(&pool->core_count, fe__os_core_count());
    fe__sleep_place_init(&pool->place);
    while (pool->started < pool->thread_count) {
        if (!fe__os_thread_start(&pool->threads[pool->started], work, pool)) break;
        pool->started += 1;
    }
    return pool->started == pool->thread_count;
}

fe_pool *fe__pool_create(int32_t worker_count)
{
    if (worker_count < 1 || worker_count > FE_MAX_WORKERS) return NULL;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe_pool *pool = fe__allocate(&memory, sizeof *pool);
    if (!pool) return NULL;
    pool->memory = memory;
    pool->worker_count = worker_count;
    fe__registry_add(&pools, &pool->entry);
    if (start_threads(pool)) return pool;
    fe__pool_destroy(pool);
    return NULL;
}

static void free_pool(fe_pool *pool)
{
    join_threads(pool);
    fe__memory memory = pool->memory;
    fe__release(&memory, pool, sizeof *pool);
}

void fe__pool_destroy(fe_pool *pool)
{
    fe__registry_remove(&pools, &pool->entry);
    free_pool(pool);
}

fe_result fe__pool_try_destroy(fe_pool *pool, int32_t *out_users)
{
    fe_result result = fe__registry_withdraw(&pools, &pool->entry, out_users);
    if (result == FE_OK) free_pool(pool);
    return result;
}

int32_t fe__thread_number(void) { return thread_number; }
int32_t fe__pool_worker_count(const fe_pool *pool) { return pool->worker_count; }
int32_t fe__pool_lives(const fe_pool *pool) { return fe__registry_has(&pools, &pool->entry); }
fe_result fe__pool_retain(fe_pool *pool) { return fe__registry_retain(&pools, &pool->entry); }
void fe__pool_release(fe_pool *pool) { fe__registry_release(&pools, &pool->entry); }
void fe__pool_assume_cores(fe_pool *pool, int32_t core_count) { atomic_store(&pool->core_count, core_count); }

// ---- what a world runs on ------------------------------------------------------------------------------------------

fe_result fe__workers_hire(fe__workers *workers, const fe_task_system *tasks, fe_pool *pool, int32_t count)
{
    *workers = (fe__workers){.count = 1};
    if (tasks) {
        workers->tasks = *tasks;
        workers->count = tasks->worker_count;
        return FE_OK;
    }
    if (!pool && count > 1) {
        pool = workers->own_pool = fe__pool_create(count);
        if (!pool) return FE_ERROR_MEMORY;
    }
    if (!pool) return FE_OK;
    fe_result retained = fe__pool_retain(pool);
    if (retained != FE_OK) return retained;
    workers->pool = pool;
    workers->count = fe__pool_worker_count(pool);
    return FE_OK;
}

void fe__workers_dismiss(fe__workers *workers)
{
    if (workers->pool) fe__pool_release(workers->pool);
    if (workers->own_pool) fe__pool_destroy(workers->own_pool);
    workers->pool = workers->own_pool = NULL;
}

typedef struct host_run {
    fe_task task;
    void *argument;
} host_run;

static void perform_for_host(void *argument, int32_t index)
{
    const host_run *run = argument;
    perform(run->task, run->argument, index);
}

void fe__run(const fe__workers *workers, fe_task task, void *argument, int32_t count)
{
    int alone = count <= 1 || workers->count == 1 || inside_task;
    if (!alone && workers->tasks.run) {
        host_run run = {task, argument};
        workers->tasks.run(workers->tasks.user, perform_for_host, &run, count);
    } else if (!alone && workers->pool) {
        fe__pool_run(workers->pool, task, argument, count);
    } else {
        perform_all(task, argument, count);
    }
}

typedef struct range_run {
    fe__range_task task;
    void *argument;
    int32_t count, block, block_count;
    fe__shares shares;
} range_run;

static void claim_blocks(void *argument, int32_t index)
{
    enum { ONLY_PASS = 1 };
    range_run *run = argument;
    fe__claims claims = fe__claims_of(fe__shares_join(&run->shares));
    (void)index;
    for (;;) {
        int32_t block = fe__shares_claim(&run->shares, &claims, FE__ALL_SHARES, ONLY_PASS, run->block_count);
        if (block < 0) return;
        int32_t first = block * run->block;
        int32_t rest = run->count - first;
        run->task(run->argument, first, first + (rest < run->block ? rest : run->block), claims.worker);
    }
}

void fe__parallel_for(const fe__workers *workers, int32_t count, int32_t block, fe__range_task task, void *argument)
{
    if (count <= 0) return;
    if (count <= block || workers->count == 1 || inside_task) {
        task(argument, 0, count, 0);
        return;
    }
    int32_t block_count = count / block + (count % block != 0);
    int32_t called = workers->count < block_count ? workers->count : block_count;
    range_run run; // 4 KB that are not to be cleared
    run.task = task;
    run.argument = argument;
    run.count = count;
    run.block = block;
    run.block_count = block_count;
    fe__shares_begin(&run.shares, called);
    fe__run(workers, claim_blocks, &run, called);
}
