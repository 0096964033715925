// os_thread_none.c - see os_thread.h. WebAssembly without threads: all runs on the caller.
#include "core/os_thread.h"

#if !FE_HAS_THREADS
int fe__os_thread_start(fe__os_thread *thread, void (*work)(void *argument), void *argument)
{
    (void)thread, (void)work, (void)argument;
    return 0;
}

void fe__os_thread_join(fe__os_thread *thread) { (void)thread; }
void fe__os_yield(void) {}
int32_t fe__os_core_count(void) { return 1; }
int32_t fe__os_thread_limit(void) { return 0; }

void fe__sleep_place_init(fe__sleep_place *place) { (void)place; }
void fe__sleep_place_free(fe__sleep_place *place) { (void)place; }

void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value)
{
    (void)place, (void)word, (void)value;
}

void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count)
{
    (void)place, (void)word, (void)count;
}

void fe__os_at_thread_end(const fe__end_calls *calls, void *argument) { (void)calls, (void)argument; }
void fe__os_forget_thread_ends(void) {}
#endif
