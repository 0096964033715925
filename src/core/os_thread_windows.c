// os_thread_windows.c - see os_thread.h. Windows 8 and later: WaitOnAddress sleeps on a word.
#include "core/os_thread.h"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <process.h>

enum { STACK_SIZE = 1024 * 1024 }; // bytes of a thread, whatever the program's own header asks for

// ---- life ----------------------------------------------------------------------------------------------------------

static unsigned __stdcall begin(void *argument)
{
    fe__os_thread *thread = argument;
    thread->work(thread->argument);
    return 0;
}

int fe__os_thread_start(fe__os_thread *thread, void (*work)(void *argument), void *argument)
{
    thread->work = work;
    thread->argument = argument;
    thread->handle = (HANDLE)_beginthreadex(NULL, STACK_SIZE, begin, thread, STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    return thread->handle != NULL;
}

void fe__os_thread_join(fe__os_thread *thread)
{
    WaitForSingleObject(thread->handle, INFINITE);
    CloseHandle(thread->handle);
}

void fe__os_yield(void) { SwitchToThread(); }

int32_t fe__os_core_count(void)
{
    DWORD_PTR ours = 0, all = 0; // a host may keep the process off some
    GetProcessAffinityMask(GetCurrentProcess(), &ours, &all);
    int32_t count = __builtin_popcountll(ours);
    // 0: the process runs in several groups of 64
    if (count == 0) count = (int32_t)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    return count < 1 ? 1 : count;
}

int32_t fe__os_thread_limit(void) { return INT32_MAX; }

// ---- sleep ---------------------------------------------------------------------------------------------------------

void fe__sleep_place_init(fe__sleep_place *place) { (void)place; }
void fe__sleep_place_free(fe__sleep_place *place) { (void)place; }

void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value)
{
    (void)place;
    WaitOnAddress((volatile VOID *)word, &value, sizeof value, INFINITE);
}

void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count)
{
    (void)place;
    for (int32_t i = 0; i < count; ++i) WakeByAddressSingle((PVOID)word);
}

// ---- a thread's end ------------------------------------------------------------------------------------------------
// Storage of fibers, because Windows calls back at its end; a thread that makes no fibers is one. A fiber may end
// before its thread does, which would go on using what `ended` gives away: a thread that first reads inside a fiber
// never gives it back. There is no fork.

static DWORD slot = FLS_OUT_OF_INDEXES;
static INIT_ONCE once = INIT_ONCE_STATIC_INIT;
static _Atomic(const fe__end_calls *) end_calls; // the same each time

static VOID WINAPI call_ended(PVOID argument)
{
    if (argument) atomic_load(&end_calls)->ended(argument);
}

static BOOL CALLBACK prepare(PINIT_ONCE first, PVOID parameter, PVOID *context)
{
    (void)first, (void)parameter, (void)context;
    slot = FlsAlloc(call_ended);
    return TRUE;
}

void fe__os_at_thread_end(const fe__end_calls *calls, void *argument)
{
    atomic_store(&end_calls, calls);
    InitOnceExecuteOnce(&once, prepare, NULL, NULL);
    if (slot != FLS_OUT_OF_INDEXES && !IsThreadAFiber()) FlsSetValue(slot, argument);
}

void fe__os_forget_thread_ends(void)
{
    if (slot != FLS_OUT_OF_INDEXES) FlsFree(slot);
    slot = FLS_OUT_OF_INDEXES;
}
#endif
