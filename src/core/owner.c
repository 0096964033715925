// owner.c - the slots of the threads that read. See owner.h.
#include "core/owner.h"

#include "core/memory.h"
#include "core/os_thread.h"

// Slots are made once and never freed while the library is loaded: who looks at all of them needs no lock. A thread
// that ends gives its slot to the next one.
static _Atomic(fe__reader *) readers;
static _Thread_local fe__reader *own;

int fe__owner_be_alone(fe__owner *owner, fe__occupation as)
{
    atomic_store_explicit(&owner->occupation, (uint32_t)as, memory_order_seq_cst);
    for (fe__reader *r = atomic_load_explicit(&readers, memory_order_seq_cst); r; r = r->next) {
        for (int32_t i = 0; i < FE__READER_DEPTH; ++i) {
            if (atomic_load_explicit(&r->inside[i], memory_order_seq_cst) != owner) continue;
            atomic_store_explicit(&owner->occupation, FE__WRITER, memory_order_release);
            return 0;
        }
    }
    return 1;
}

static fe__reader *take_free(void)
{
    for (fe__reader *r = atomic_load_explicit(&readers, memory_order_acquire); r; r = r->next) {
        int32_t taken = 0;
        if (atomic_compare_exchange_strong_explicit(&r->taken, &taken, 1, memory_order_acquire, memory_order_relaxed))
            return r;
    }
    return NULL;
}

enum { CACHE_LINE = 64, SLOT_SIZE = sizeof(fe__reader) };

static fe__reader *make(void)
{
    fe__reader *r = fe__aligned_allocate(SLOT_SIZE, CACHE_LINE);
    if (!r) return NULL;
    *r = (fe__reader){.taken = 1, .next = atomic_load_explicit(&readers, memory_order_relaxed)};
    while (!atomic_compare_exchange_weak_explicit(&readers, &r->next, r, memory_order_seq_cst, memory_order_relaxed)) {}
    return r;
}

static void give_back(void *slot)
{
    fe__reader *r = slot;
    atomic_store_explicit(&r->taken, 0, memory_order_release);
}

// Of the threads that were inside, only the one that forked lives on in the child.
static void forget_others(void)
{
    for (fe__reader *r = atomic_load_explicit(&readers, memory_order_relaxed); r; r = r->next) {
        if (r == own) continue;
        for (int32_t i = 0; i < FE__READER_DEPTH; ++i) atomic_store_explicit(&r->inside[i], NULL, memory_order_relaxed);
        r->depth = 0;
        atomic_store_explicit(&r->taken, 0, memory_order_relaxed);
    }
}

#if !defined(__wasm__) // a module is never unloaded
// No thread that outlives the library calls into memory that is gone.
__attribute__((destructor)) static void end(void)
{
    fe__os_forget_thread_ends();
    for (fe__reader *r = atomic_exchange_explicit(&readers, NULL, memory_order_acquire), *next; r; r = next) {
        next = r->next;
        fe__aligned_free(r);
    }
    own = NULL;
}
#endif

static fe__reader *first_of_thread(void)
{
    static const fe__end_calls calls = {give_back, forget_others};
    fe__reader *r = take_free();
    if (!r) r = make();
    if (!r) return NULL;
    fe__os_at_thread_end(&calls, r);
    own = r;
    return r;
}

fe__reader *fe__reader_of_thread(void) { return own ? own : first_of_thread(); }
