// owner.h - who is inside a world now: one writer, or any number of readers.
//
// A writer takes one word of the world by a compare-exchange and gives it back by a store. A reader never touches that
// word, so that readers on many cores share no cache line that is written: each thread has a slot of its own, in which
// it names what it reads, and then looks at the word. Who must be alone (a step, a destruction, a call that makes or
// removes records) takes the word and then looks at the slots of all threads. Both sides write first and look
// afterwards, in one total order (Dekker's algorithm, with sequentially consistent operations): at least one notices
// the other.
//
// A writer that moves no record does not look at the slots: a reader that was inside before it may see old and new
// values.
#ifndef FE_CORE_OWNER_H
#define FE_CORE_OWNER_H
#include "feather.h"

#include <stdatomic.h>
#include <stddef.h>

typedef enum fe__occupation {
    FE__NOBODY = 0,
    FE__SHOWN = 1, // a player's, between its calls: readers may enter, writers may not
    FE__WRITER = 2,
    FE__STEP = 3, // a step, or what else refuses readers by FE_ERROR_STEPPING
    FE__CLOSING = 4
} fe__occupation;

typedef struct fe__owner {
    _Atomic uint32_t occupation; // fe__occupation
    uint64_t entries;            // writers so far: whoever finds the same number knows that nobody wrote meanwhile
} fe__owner;

enum { FE__READER_DEPTH = 6 }; // a host's task that runs inside a query may query another world, and so on

// What a thread reads now, innermost last. Written by its thread alone; on a cache line of its own.
typedef struct fe__reader {
    _Atomic(const fe__owner *) inside[FE__READER_DEPTH];
    int32_t depth;
    _Atomic int32_t taken; // 1: a living thread has it
    struct fe__reader *next;
} fe__reader;

// 1: the caller is the writer now. 0: somebody else is inside.
static inline int fe__owner_enter(fe__owner *owner)
{
    uint32_t nobody = FE__NOBODY;
    if (!atomic_compare_exchange_strong_explicit(&owner->occupation, &nobody, FE__WRITER, memory_order_seq_cst,
                                                 memory_order_relaxed))
        return 0;
    ++owner->entries;
    return 1;
}
static inline void fe__owner_leave(fe__owner *owner)
{
    atomic_store_explicit(&owner->occupation, FE__NOBODY, memory_order_release);
}

// By whom it belongs to: others may read it, and no more.
static inline void fe__owner_show(fe__owner *owner)
{
    atomic_store_explicit(&owner->occupation, FE__SHOWN, memory_order_release);
}
static inline void fe__owner_take_back(fe__owner *owner) { fe__owner_leave(owner); }

// From writer to step or closing, when no reader is inside. 0: one is, and the caller is still the writer.
int fe__owner_be_alone(fe__owner *owner, fe__occupation as);

// The slot of this thread; NULL: no memory for one.
fe__reader *fe__reader_of_thread(void);

// The slot when nobody writes, NULL otherwise.
static inline fe__reader *fe__reader_enter(const fe__owner *owner)
{
    fe__reader *reader = fe__reader_of_thread();
    if (!reader || reader->depth == FE__READER_DEPTH) return NULL;
    atomic_store_explicit(&reader->inside[reader->depth], owner, memory_order_seq_cst);
    if (atomic_load_explicit(&owner->occupation, memory_order_seq_cst) > FE__SHOWN) {
        atomic_store_explicit(&reader->inside[reader->depth], NULL, memory_order_release);
        return NULL;
    }
    ++reader->depth;
    return reader;
}
static inline void fe__reader_leave(fe__reader *reader)
{
    atomic_store_explicit(&reader->inside[--reader->depth], NULL, memory_order_release);
}

#endif
