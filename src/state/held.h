// held.h - a state of a world as it lies in memory: taken, and given back.
#ifndef FE_STATE_HELD_H
#define FE_STATE_HELD_H
#include "state/history.h"

int64_t fe__held_size(const fe_world *world); // bytes of a block for its state
// Into a block of that size. Editions are those of `before` where they still hold, or from `memory`. 0: there is none
// for them. memory NULL: none are taken, as nothing is edited until the state returns
int32_t fe__held_fill(fe__held *held, const fe_world *world, fe__memory *memory, const fe__held *before);
void fe__held_forget_assets(fe__held *held, fe_store *store, fe__memory *memory);
int64_t fe__held_bytes(const fe__held *held, const fe__held *before); // without the editions that `before` has
// Is it the world's state, of which nobody wrote anything since? A world that moves is never asked
int32_t fe__held_is_state(const fe__held *held, const fe_world *world);
// The world's state is the held one, of it or of another world of the store, but for the numbers of the step; with
// every capacity, on which it depends what the world does without memory. See fe__history_restore
fe_result fe__held_return(const fe__held *held, fe_world *world);

#endif
