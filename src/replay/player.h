// player.h - a world that does what a recording says: its place in the file, and how it went.
#ifndef FE_REPLAY_PLAYER_H
#define FE_REPLAY_PLAYER_H
#include "api/check.h"
#include "record/recorder.h"
#include "replay/file.h"
#include "replay/op_in.h"

enum { FE__PLAYER_TEXT = 256 };

struct fe_player {
    fe__memory memory;
    fe__file file;
    fe_player_def def;        // what its worlds are made by
    fe_allocator allocator;   // of it
    fe_world *world;          // NULL: none yet, or it was handed over
    fe__op_in in;             // `at`, `end`: of the call that comes next
    fe__replay_asset *assets; // of recorded handles, in the world's store
    int32_t asset_count, asset_capacity;

    // the place: this chunk, that byte of its content, so many idle steps of a run that are still to be made
    int32_t chunk;
    int64_t offset, idle;
    int64_t step;
    int64_t calls;
    fe__last_step last; // that was played in this chunk

    // answers of the pair filter in the step that comes next
    const unsigned char *answers; // a bit each
    int64_t answer_count, answered;

    int32_t is_open; // it has begun at a keyframe
    int32_t has_diverged;
    fe_divergence divergence;
    char text[FE__PLAYER_TEXT];
};

#endif
