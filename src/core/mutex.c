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
