// os_thread_posix.c - see os_thread.h. Posix threads; sleeping is a futex on Linux, a condition variable elsewhere.
#if defined(__linux__)
#define _GNU_SOURCE // sched_getaffinity
#endif
#include "core/os_thread.h"

#if FE_HAS_THREADS && !defined(_WIN32) && !defined(FE_HOST_THREADS)
#include <sched.h>
#include <signal.h>
#include <unistd.h>
#if defined(__linux__)
#include <linux/futex.h>
#include <sys/syscall.h>
#endif

enum { STACK_SIZE = 1024 * 1024 }; // bytes of a thread: libraries' own sizes differ by a factor of 60

// ---- life ----------------------------------------------------------------------------------------------------------

static void *begin(void *argument)
{
    fe__os_thread *thread = argument;
    thread->work(thread->argument);
    return NULL;
}

// What users, terminals, timers and children send to a process: the host's own threads handle it. The rest must reach
// any thread: faults, or the kernel ends the process without a word of its handlers; and what runtimes send to a single
// thread to stop it, since a callback makes a worker one of theirs (Boehm's collector SIGPWR and SIGXCPU, .NET and Mono
// real-time signals, Java SIGUSR2).
static void fill_with_signals_of_the_process(sigset_t *set)
{
    static const int numbers[] = {SIGHUP,   SIGINT,  SIGQUIT, SIGTERM, SIGALRM, SIGVTALRM, SIGCHLD,
                                  SIGWINCH, SIGTSTP, SIGTTIN, SIGTTOU, SIGCONT, SIGIO,     SIGURG};
    sigemptyset(set);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) sigaddset(set, numbers[i]);
}

int fe__os_thread_start(fe__os_thread *thread, void (*work)(void *argument), void *argument)
{
    pthread_attr_t attributes;
    sigset_t blocked, before;
    thread->work = work;
    thread->argument = argument;
    if (pthread_attr_init(&attributes) != 0) return 0;
    pthread_attr_setstacksize(&attributes, STACK_SIZE);
    fill_with_signals_of_the_process(&blocked);
    pthread_sigmask(SIG_BLOCK, &blocked, &before);
    int started = pthread_create(&thread->handle, &attributes, begin, thread) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    return started;
}

void fe__os_thread_join(fe__os_thread *thread) { pthread_join(thread->handle, NULL); }

void fe__os_yield(void) { sched_yield(); }

int32_t fe__os_core_count(void)
{
#if defined(__linux__)
    cpu_set_t set; // a host may keep the process off some
    if (sched_getaffinity(0, sizeof set, &set) == 0) return (int32_t)CPU_COUNT(&set);
#endif
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : (int32_t)count;
}

int32_t fe__os_thread_limit(void) { return INT32_MAX; }

// ---- sleep ---------------------------------------------------------------------------------------------------------

#if FE_SLEEPS_BY_CONDITION
void fe__sleep_place_init(fe__sleep_place *place)
{
    pthread_mutex_init(&place->mutex, NULL);
    pthread_cond_init(&place->changed, NULL);
}

void fe__sleep_place_free(fe__sleep_place *place)
{
    pthread_cond_destroy(&place->changed);
    pthread_mutex_destroy(&place->mutex);
}

void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value)
{
    pthread_mutex_lock(&place->mutex);
    if (atomic_load(word) == value) pthread_cond_wait(&place->changed, &place->mutex);
    pthread_mutex_unlock(&place->mutex);
}

// one condition for all words: who was not meant sleeps on
void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count)
{
    (void)word, (void)count;
    pthread_mutex_lock(&place->mutex);
    pthread_cond_broadcast(&place->changed);
    pthread_mutex_unlock(&place->mutex);
}
#else
void fe__sleep_place_init(fe__sleep_place *place) { (void)place; }
void fe__sleep_place_free(fe__sleep_place *place) { (void)place; }

void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value)
{
    (void)place;
    syscall(SYS_futex, word, FUTEX_WAIT_PRIVATE, value, NULL, NULL, 0);
}

void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count)
{
    (void)place;
    syscall(SYS_futex, word, FUTEX_WAKE_PRIVATE, count, NULL, NULL, 0);
}
#endif

// ---- a thread's end ------------------------------------------------------------------------------------------------

static pthread_key_t key;
static int has_key;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static _Atomic(const fe__end_calls *) end_calls; // the same each time

static void prepare(void)
{
    const fe__end_calls *calls = atomic_load(&end_calls);
    has_key = pthread_key_create(&key, calls->ended) == 0;
    (void)pthread_atfork(NULL, NULL, calls->forked);
}

void fe__os_at_thread_end(const fe__end_calls *calls, void *argument)
{
    atomic_store(&end_calls, calls);
    (void)pthread_once(&once, prepare);
    if (has_key) (void)pthread_setspecific(key, argument);
}

void fe__os_forget_thread_ends(void)
{
    if (has_key) (void)pthread_key_delete(key);
    has_key = 0;
}
#endif
