// lock.c - see lock.h.
#include "core/lock.h"

#if FE_HAS_THREADS
void fe__lock_init(fe__lock *lock) { pthread_mutex_init(&lock->mutex, NULL); }
void fe__lock_free(fe__lock *lock) { pthread_mutex_destroy(&lock->mutex); }
void fe__lock_take(fe__lock *lock) { pthread_mutex_lock(&lock->mutex); }
void fe__lock_give(fe__lock *lock) { pthread_mutex_unlock(&lock->mutex); }
#else
void fe__lock_init(fe__lock *lock) { lock->unused = 0; }
void fe__lock_free(fe__lock *lock) { (void)lock; }
void fe__lock_take(fe__lock *lock) { (void)lock; }
void fe__lock_give(fe__lock *lock) { (void)lock; }
#endif
