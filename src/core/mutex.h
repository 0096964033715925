// mutex.h - a mutex: for what threads share outside of steps, and hold for long enough to sleep on.
//
// Where there are no threads it is nothing. Not recursive.
#ifndef FE_CORE_MUTEX_H
#define FE_CORE_MUTEX_H

#if defined(_WIN32)
#define FE_HAS_THREADS 1
#define FE_MUTEX_INITIAL \
    {                    \
        0                \
    }
#elif defined(__wasm_atomics__) && !defined(_REENTRANT)
// WebAssembly with shared memory and a C library without threads
#define FE_HAS_THREADS 1
#define FE_HOST_THREADS 1
#include <stdatomic.h>
#include <stdint.h>
#define FE_MUTEX_INITIAL \
    {                    \
        0                \
    }
#elif !defined(__wasm__) || defined(_REENTRANT)
#define FE_HAS_THREADS 1
#include <pthread.h>
#define FE_MUTEX_INITIAL          \
    {                             \
        PTHREAD_MUTEX_INITIALIZER \
    }
#else
#define FE_HAS_THREADS 0
#define FE_MUTEX_INITIAL \
    {                    \
        0                \
    }
#endif

typedef struct fe__mutex {
#if defined(_WIN32)
    void *handle; // an SRWLOCK, whose header would bring its macros everywhere
#elif defined(FE_HOST_THREADS)
    _Atomic uint32_t locked; // 0 or 1
#elif FE_HAS_THREADS
    pthread_mutex_t handle;
#else
    int unused;
#endif
} fe__mutex;

void fe__mutex_init(fe__mutex *mutex);
void fe__mutex_free(fe__mutex *mutex);
void fe__mutex_lock(fe__mutex *mutex);
void fe__mutex_unlock(fe__mutex *mutex);

#endif
