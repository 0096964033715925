// recorder.h - a recording while it grows: chunks that wait to be read, and what the next ones are written with.
//
// The thread that uses the world writes, any thread reads: the lock is held for each call that is noted and for each
// read, never in a step. Memory is asked for by the writer alone. When there is none, or no room, the recording ends;
// the calls of the world go on as if nobody had recorded.
//
// With FE_RECORD_LAST chunks are not given away: keyframes and what follows them go, oldest first, as room is needed,
// and with them the contents of assets that nothing names any more.
#ifndef FE_RECORD_RECORDER_H
#define FE_RECORD_RECORDER_H
#include "core/mutex.h"
#include "record/format.h"
#include "store/asset_key.h"
#include "world/world.h"

// A piece of the file, with its header
typedef struct fe__chunk {
    struct fe__chunk *next;
    int64_t size;     // bytes, with header and padding
    int64_t capacity; // bytes
    uint32_t type;    // 0: the header of the file
    _Alignas(8) unsigned char bytes[];
} fe__chunk;

typedef struct fe__known_asset {
    fe_asset handle;
    fe__asset_key key;
} fe__known_asset;

typedef struct fe__known_content {
    fe__asset_key key;
    int64_t named; // step of the last keyframe or call that names it
} fe__known_content;

// What steps are told as differences from; zeros where a chunk begins
typedef struct fe__last_step {
    float dt;
    int32_t awake, pairs, linked;
} fe__last_step;

struct fe_recorder {
    fe__memory memory;
    fe__mutex lock;  // for all that follows but `world`, answers, assets
    fe_world *world; // NULL: its recording has ended
    fe_result end;   // why: FE_END with its world or its recorder's end, or an error
    uint32_t flags;  // fe_record_flags
    int32_t keyframe_steps;
    int64_t capacity; // bytes that may wait

    fe__chunk *first, *last; // to be read
    fe__chunk *spent;        // read: the writer gives them back or takes them again
    int64_t waiting;         // bytes from first to last, and of `open`
    fe__chunk *open;         // of calls, which grows; NULL: none
    unsigned char *at;       // where its next call comes
    int64_t open_since;      // step
    double open_time;        // s of steps in it
    fe__last_step before;
    int64_t step; // steps in all, from the world's step number on
    int64_t idle; // of these, the last ones, that nobody has written yet

    int32_t busy_steps;     // since the last keyframe, in which something happened
    int64_t since_keyframe; // bytes
    int32_t has_called;     // since then, there was a call beside steps
    int32_t keyframes;      // among the chunks
    int32_t has_gap;        // with FE_RECORD_LAST: a call did not fit, all waits for a keyframe

    // of the step that runs
    fe_pair_filter filter;
    void *filter_user;
    unsigned char *answers; // a byte each
    int32_t answer_count, answer_capacity;

    fe__known_asset *assets; // that calls name
    int32_t asset_count, asset_capacity;
    fe__known_content *contents; // that are in the file, in the order in which they were last named
    int32_t content_count, content_capacity;
};

#endif
