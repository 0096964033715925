// history.h - the last frames of a world, in memory: to go back to one of them at once.
//
// A frame holds what the tables of world/world_memory.h name, as it lies in memory: nothing is packed, and nothing
// needs to be checked when it returns. What follows from the state is found anew by the next step, as after a snapshot.
// Frames between which nothing changed share what they hold. The assets that a frame's shapes have live as long as the
// frame; of those that can be edited it has the heights or materials, in one copy for all frames between two edits.
#ifndef FE_SNAPSHOT_HISTORY_H
#define FE_SNAPSHOT_HISTORY_H
#include "core/registry.h"
#include "world/world_memory.h"

// ---- history --------------------------------------------------------------------------------------------------------

// What can be edited of an asset, as it was
typedef struct fe__edition {
    int32_t users;  // frames' records
    int64_t number; // fe__asset.edition
    int64_t size;   // bytes, from `content` on
    _Alignas(16) unsigned char content[];
} fe__edition;

typedef struct fe__held_asset {
    int32_t record, owner; // in the store: what shapes have, and its parent, which is edited
    fe__edition *edition;  // NULL: nothing of it can be
} fe__held_asset;

// A state. One block of memory, with what the pointers lead to behind it
typedef struct fe__held {
    struct fe__held *next; // of the spare ones
    int64_t size, bytes;   // of the block, and what is used of it
    int32_t users;         // frames; 0: spare
    int32_t rests;         // fe__world_rests
    int32_t burdened;      // fe__solver.burdened
    int32_t asset_count;
    fe__held_asset *assets;
    int32_t *edited;        // room for as many
    unsigned char *members; // fe__state_members, one behind the other
    unsigned char *arrays[FE__ARRAYS];
    int64_t used[FE__ARRAYS]; // bytes
} fe__held;

typedef struct fe__frame {
    int64_t number;
    int64_t step_number; // these three are not the state's: they go on while a world rests
    float last_h, last_dt;
    fe__held *held;
} fe__frame;

struct fe_history {
    fe__entry entry; // in the registry
    fe_world *world;
    struct fe_history *next; // of the world's
    fe__frame *frames;       // a ring
    int32_t first, count, limit;
    int64_t most_bytes; // 0: no bound
    fe__held *spare;    // blocks for the frames to come
    uint64_t entries;   // fe__owner.entries when the world was the last frame's
};

// The world was entered for writing by the caller, alone for destroy and restore.
fe_result fe__history_create(fe_world *world, int32_t frames, int64_t most_bytes, fe_history **out_history);
void fe__history_destroy(fe_history *history);
void fe__histories_end(fe_world *world); // of a world that ends
// FE_ERROR_MEMORY, FE_ERROR_LIMIT (more than most_bytes): nothing changed
fe_result fe__history_keep(fe_history *history, int64_t number);
// FE_ERROR_STALE: there is no such frame. FE_ERROR_MEMORY; FE_ERROR_STEPPING, FE_ERROR_BUSY: another world uses an
// asset that was edited since. Nothing changed then
fe_result fe__history_restore(fe_history *history, int64_t number);

// From any thread: NULL, when there is no such history
fe_world *fe__world_of_history(const fe_history *history);
static inline const fe__frame *fe__history_frame(const fe_history *history, int32_t i) // from the oldest
{
    return history->frames + (history->first + i) % history->limit;
}
int64_t fe__history_bytes(const fe_history *history, int32_t i); // of a frame, without what the one before has, too

// ---- held -----------------------------------------------------------------------------------------------------------
// A state of a world as it lies in memory: taken, and given back.

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
