// os_thread.h - what Feather asks of the operating system's threads: to start and to be joined, to sleep on a word, to
// say when they end, and how many cores they may have.
//
// One file for each kind of system: os_thread_posix.c, os_thread_windows.c, os_thread_wasm.c for a WebAssembly module
// whose host gives it threads, and os_thread_none.c where there are none.
#ifndef FE_CORE_OS_THREAD_H
#define FE_CORE_OS_THREAD_H
#include "core/mutex.h"

#include <stdatomic.h>
#include <stdint.h>

// Stays where it is from its start to its join.
typedef struct fe__os_thread {
#if FE_HAS_THREADS && !defined(_WIN32) && !defined(FE_HOST_THREADS)
    pthread_t handle;
#else
    void *handle;
#endif
    void (*work)(void *argument);
    void *argument;
} fe__os_thread;

// Linux, Windows and WebAssembly sleep on a word by its address. Elsewhere one condition stands for all words of a
// place.
#if FE_HAS_THREADS && !defined(__linux__) && !defined(_WIN32) && !defined(FE_HOST_THREADS)
#define FE_SLEEPS_BY_CONDITION 1
#else
#define FE_SLEEPS_BY_CONDITION 0
#endif

// Where threads sleep and are woken; not to be copied while in use.
typedef struct fe__sleep_place {
#if FE_SLEEPS_BY_CONDITION
    pthread_mutex_t mutex;
    pthread_cond_t changed;
#else
    int unused;
#endif
} fe__sleep_place;

// Signals sent to the process are the host's: their handlers do not run on such a thread. Faults and what is sent to
// the thread itself reach it. 0: there is no thread to be had.
int fe__os_thread_start(fe__os_thread *thread, void (*work)(void *argument), void *argument);
void fe__os_thread_join(fe__os_thread *thread);
void fe__os_yield(void);
// That this process may use, at least 1
int32_t fe__os_core_count(void);
// So many threads can be started now, as far as the system tells
int32_t fe__os_thread_limit(void);

void fe__sleep_place_init(fe__sleep_place *place);
void fe__sleep_place_free(fe__sleep_place *place);
// Returns when the word may have changed from `value`, at once if it has.
void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value);
// Wakes at least so many of those who sleep on the word, after it has changed.
void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count);

typedef struct fe__end_calls {
    void (*ended)(void *argument);
    void (*forked)(void);
} fe__end_calls;
// `ended` is called with `argument` when this thread ends, `forked` in a child process that a fork makes. The calls are
// the same each time: the library has one use for it.
void fe__os_at_thread_end(const fe__end_calls *calls, void *argument);
// No thread calls `ended` from now on: the library goes.
void fe__os_forget_thread_ends(void);

#endif
