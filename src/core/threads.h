// threads.h - workers: a pool of persistent threads, or the host's task system, behind one call.
//
// fe__run is the only way to other threads: it calls task(argument, i) once for each i in [0, count) and returns when
// all have returned. A task never waits for one that has not started, so that any number of real threads, down to one,
// finishes; tasks share work through atomic counters of their own. A run from inside a task is done by that task's
// thread alone. The pool's threads spin for a few microseconds after a run, longer between fe__pool_begin and
// fe__pool_end, then sleep; several worlds may run at once on one pool: each caller works too, and whoever is free
// helps.
#ifndef FE_CORE_THREADS_H
#define FE_CORE_THREADS_H
#include "feather.h"

#include <stdatomic.h>
#include <stdint.h>

enum { FE_MAX_WORKERS = 64, FE_CACHE_LINE = 64 };

// fe_pool is the pool; worlds count themselves in and out
fe_pool *fe__pool_create(int32_t worker_count); // NULL when memory or threads are not to be had
void fe__pool_destroy(fe_pool *pool);           // no world may use it
// FE_OK: destroyed. FE_ERROR_STALE: it was gone; FE_ERROR_STATE: so many worlds use it.
fe_result fe__pool_try_destroy(fe_pool *pool, int32_t *out_users);
int32_t fe__pool_lives(const fe_pool *pool);
int32_t fe__pool_worker_count(const fe_pool *pool);
fe_result fe__pool_retain(fe_pool *pool); // FE_ERROR_STALE: it is gone
void fe__pool_release(fe_pool *pool);
void fe__pool_run(fe_pool *pool, fe_task task, void *argument, int32_t count);
// Around a step: more runs follow soon, so that idle workers spin for longer before they sleep. NULL is fine; pairs may
// nest and overlap.
void fe__pool_begin(fe_pool *pool);
void fe__pool_end(fe_pool *pool);
// As if the machine had that many cores; no more threads than cores are ever called to work. For tests.
void fe__pool_assume_cores(fe_pool *pool, int32_t core_count);

// what a world runs on
typedef struct fe__workers {
    int32_t count;        // 1: inline, no thread
    fe_pool *pool;        // or NULL
    fe_pool *own_pool;    // the same, where nobody else has it
    fe_task_system tasks; // run == NULL: the pool
} fe__workers;
// The host's task system, or a shared pool, or else so many workers of its own. FE_ERROR_MEMORY; FE_ERROR_STALE: the
// pool is gone. Whatever comes of it, they are dismissed.
fe_result fe__workers_hire(fe__workers *workers, const fe_task_system *tasks, fe_pool *pool, int32_t count);
void fe__workers_dismiss(fe__workers *workers);
void fe__run(const fe__workers *workers, fe_task task, void *argument, int32_t count);

// Of the calling thread among those of its pool, from 1; 0: a caller, or a thread of the host.
int32_t fe__thread_number(void);

// Blocks of [0, count) in shares of the workers (memory.h): each call gets a disjoint range [first, end). Runs inline
// when one block holds it all.
typedef void (*fe__range_task)(void *argument, int32_t first, int32_t end, int32_t worker);
void fe__parallel_for(const fe__workers *workers, int32_t count, int32_t block, fe__range_task task, void *argument);

void fe__pause(void); // inside a spin
void fe__yield(void); // after a long spin

#endif
