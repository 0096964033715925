// os_thread_wasm.c - see os_thread.h. WebAssembly starts no threads: its host does, before the first pool asks for one.
//
// Each of the host's threads has an instance of the module on the same memory. It takes a seat (thread_seat), sets the
// stack and the thread's own storage that the seat names, and calls thread_arrive, then thread_serve, which does not
// return: it sleeps on the seat until a thread is started there, does its work, and sleeps again. So all of a thread's
// life is here, and the host is asked for nothing while a world steps.
#include "core/os_thread.h"

#if defined(FE_HOST_THREADS)
#include "core/memory.h"

#include <stddef.h>

enum {
    STACK_SIZE = 256 * 1024, // bytes; as the first thread's, see WASM_LINK
    STACK_ALIGNMENT = 16,
    MAX_SEATS = 63, // the workers that a pool can have, but for the caller
};

typedef enum seat_state {
    SEAT_EMPTY,  // its thread has not come
    SEAT_FREE,   // its thread sleeps here
    SEAT_TAKEN,  // a thread is being started here
    SEAT_CALLED, // its thread works, or is about to
    SEAT_DONE,   // it has worked, and nobody has joined it
} seat_state;

// The host reads the first two words.
typedef struct seat {
    uint32_t stack_top; // addresses
    uint32_t storage;
    _Atomic uint32_t state; // seat_state
    fe__os_thread *thread;
} seat;

static seat seats[MAX_SEATS];
static _Atomic int32_t seat_count;
static _Atomic int32_t core_count = 1;
// 0: a page's own thread, which may not sleep: it spins
static _Thread_local int32_t may_sleep;

#define EXPORTED(name) __attribute__((export_name(name)))

// ---- for the host --------------------------------------------------------------------------------------------------

// Called once, by the thread that will use the module.
EXPORTED("thread_begin") void fe__host_begin(int32_t cores, int32_t sleeps)
{
    atomic_store(&core_count, cores < 1 ? 1 : cores);
    may_sleep = sleeps;
}

// The address of a seat for one more thread, by the thread that uses the module; 0: there is none to be had.
EXPORTED("thread_seat") seat *fe__host_seat(void)
{
    int32_t count = atomic_load(&seat_count);
    if (count == MAX_SEATS) return NULL;
    size_t alignment = __builtin_wasm_tls_align(), storage_size = __builtin_wasm_tls_size();
    if (alignment < STACK_ALIGNMENT) alignment = STACK_ALIGNMENT;
    char *stack = fe__aligned_allocate(STACK_SIZE, STACK_ALIGNMENT);
    char *storage = stack ? fe__aligned_allocate(storage_size + alignment, alignment) : NULL;
    if (!storage) {
        fe__aligned_free(stack);
        return NULL;
    }
    seats[count].stack_top = (uint32_t)(uintptr_t)(stack + STACK_SIZE);
    seats[count].storage = (uint32_t)(uintptr_t)storage;
    atomic_store(&seat_count, count + 1);
    return &seats[count];
}

// Both by the thread of the seat, with its stack and its storage. From the first one on threads can be started there.
EXPORTED("thread_arrive") void fe__host_arrive(seat *own)
{
    may_sleep = 1;
    atomic_store(&own->state, SEAT_FREE);
}

EXPORTED("thread_serve") _Noreturn void fe__host_serve(seat *own)
{
    for (;;) {
        uint32_t state = atomic_load(&own->state);
        if (state != SEAT_CALLED) {
            fe__os_sleep_while(NULL, &own->state, state);
            continue;
        }
        own->thread->work(own->thread->argument);
        atomic_store(&own->state, SEAT_DONE);
        fe__os_wake(NULL, &own->state, 1);
    }
}

// ---- life ----------------------------------------------------------------------------------------------------------

int fe__os_thread_start(fe__os_thread *thread, void (*work)(void *argument), void *argument)
{
    int32_t count = atomic_load(&seat_count);
    for (int32_t i = 0; i < count; ++i) {
        uint32_t expected = SEAT_FREE;
        if (!atomic_compare_exchange_strong(&seats[i].state, &expected, SEAT_TAKEN)) continue;
        *thread = (fe__os_thread){.handle = &seats[i], .work = work, .argument = argument};
        seats[i].thread = thread;
        atomic_store(&seats[i].state, SEAT_CALLED);
        fe__os_wake(NULL, &seats[i].state, 1);
        return 1;
    }
    return 0;
}

void fe__os_thread_join(fe__os_thread *thread)
{
    seat *taken = thread->handle;
    while (atomic_load(&taken->state) != SEAT_DONE) fe__os_sleep_while(NULL, &taken->state, SEAT_CALLED);
    atomic_store(&taken->state, SEAT_FREE);
}

void fe__os_yield(void) {}
int32_t fe__os_core_count(void) { return atomic_load(&core_count); }

int32_t fe__os_thread_limit(void)
{
    int32_t count = atomic_load(&seat_count), limit = 0;
    for (int32_t i = 0; i < count; ++i) limit += atomic_load(&seats[i].state) == SEAT_FREE;
    return limit;
}

// ---- sleep ---------------------------------------------------------------------------------------------------------

void fe__sleep_place_init(fe__sleep_place *place) { (void)place; }
void fe__sleep_place_free(fe__sleep_place *place) { (void)place; }

void fe__os_sleep_while(fe__sleep_place *place, _Atomic uint32_t *word, uint32_t value)
{
    (void)place;
    if (may_sleep) __builtin_wasm_memory_atomic_wait32((int *)(void *)word, (int)value, -1);
}

void fe__os_wake(fe__sleep_place *place, _Atomic uint32_t *word, int32_t count)
{
    (void)place;
    __builtin_wasm_memory_atomic_notify((int *)(void *)word, (unsigned)count);
}

// ---- a thread's end: only the host's, and nobody hears of it --------------------------------------------------------

void fe__os_at_thread_end(const fe__end_calls *calls, void *argument) { (void)calls, (void)argument; }
void fe__os_forget_thread_ends(void) {}
#endif
