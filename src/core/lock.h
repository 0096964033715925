// lock.h - a mutex: for what threads share outside of steps, and hold for long enough to sleep on.
//
// Where there are no threads it is nothing. Not recursive.
#ifndef FE_CORE_LOCK_H
#define FE_CORE_LOCK_H

#if !defined(__wasm__) || defined(_REENTRANT)
#define FE_HAS_THREADS 1
#include <pthread.h>
#define FE_LOCK_INITIAL           \
    {                             \
        PTHREAD_MUTEX_INITIALIZER \
    }
#else
#define FE_HAS_THREADS 0
#define FE_LOCK_INITIAL \
    {                   \
        0               \
    }
#endif

typedef struct fe__lock {
#if FE_HAS_THREADS
    pthread_mutex_t mutex;
#else
    int unused;
#endif
} fe__lock;

void fe__lock_init(fe__lock *lock);
void fe__lock_free(fe__lock *lock);
void fe__lock_take(fe__lock *lock);
void fe__lock_give(fe__lock *lock);

#endif
