// history.h - the last frames of a world, in memory: to go back to one of them at once.
//
// A frame holds what the tables of world/arrays.h name, as it lies in memory: nothing is packed, and nothing needs to
// be checked when it returns. What follows from the state is found anew by the next step, as after a snapshot. Frames
// between which nothing changed share what they hold. The assets that a frame's shapes have live as long as the frame;
// of those that can be edited it has the heights or materials, in one copy for all frames between two edits.
#ifndef FE_STATE_HISTORY_H
#define FE_STATE_HISTORY_H
#include "core/registry.h"
#include "world/arrays.h"

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

#endif
