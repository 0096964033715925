// mutex.c - see mutex.h.
#include "core/mutex.h"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

_Static_assert(sizeof(SRWLOCK) == sizeof(fe__mutex), "what the header declares is an SRWLOCK");

static PSRWLOCK lock_of(fe__mutex *mutex) { return (PSRWLOCK)(void *)&mutex->handle; }

void fe__mutex_init(fe__mutex *mutex) { InitializeSRWLock(lock_of(mutex)); }
void fe__mutex_free(fe__mutex *mutex) { (void)mutex; }
void fe__mutex_lock(fe__mutex *mutex) { AcquireSRWLockExclusive(lock_of(mutex)); }
void fe__mutex_unlock(fe__mutex *mutex) { ReleaseSRWLockExclusive(lock_of(mutex)); }
#elif defined(FE_HOST_THREADS)
#include "core/os_thread.h"

void fe__mutex_init(fe__mutex *mutex) { atomic_init(&mutex->locked, 0); }
void fe__mutex_free(fe__mutex *mutex) { (void)mutex; }

void fe__mutex_lock(fe__mutex *mutex)
{
    while (atomic_exchange_explicit(&mutex->locked, 1, memory_order_acquire))
        fe__os_sleep_while(NULL, &mutex->locked, 1);
}

void fe__mutex_unlock(fe__mutex *mutex)
{
    atomic_store_explicit(&mutex->locked, 0, memory_order_release);
    fe__os_wake(NULL, &mutex->locked, 1);
}
#elif FE_HAS_THREADS
void fe__mutex_init(fe__mutex *mutex) { pthread_mutex_init(&mutex->handle, NULL); }
void fe__mutex_free(fe__mutex *mutex) { pthread_mutex_destroy(&mutex->handle); }
void fe__mutex_lock(fe__mutex *mutex) { pthread_mutex_lock(&mutex->handle); }
void fe__mutex_unlock(fe__mutex *mutex) { pthread_mutex_unlock(&mutex->handle); }
#else
void fe__mutex_init(fe__mutex *mutex) { mutex->unused = 0; }
void fe__mutex_free(fe__mutex *mutex) { (void)mutex; }
void fe__mutex_lock(fe__mutex *mutex) { (void)mutex; }
void fe__mutex_unlock(fe__mutex *mutex) { (void)mutex; }
#endif
