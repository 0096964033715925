// player.h - a world that does what a recording says: its place in the file, and how it went.
#ifndef FE_REPLAY_PLAYER_H
#define FE_REPLAY_PLAYER_H
#include "api/check.h"
#include "core/memory.h"
#include "recording/recorder.h"
#include "replay/op_in.h"

// ---- file -----------------------------------------------------------------------------------------------------------
// The bytes that a player was fed, as chunks: whole ones, whose sums are right.

typedef struct fe__fed_chunk {
    uint32_t type, flags;
    int64_t step, size; // bytes of content
    unsigned char *content;
    int64_t capacity;
} fe__fed_chunk;

enum { FE__FILE_SENTENCE = 160 };

typedef struct fe__file {
    fe__memory *memory;
    uint32_t library, results, flags; // of the header; library 0: none yet
    fe__fed_chunk *chunks;
    int32_t chunk_count, chunk_capacity;
    int32_t keyframes, notes;
    int64_t bytes; // of header and whole chunks
    // the piece that is not whole yet
    unsigned char header[FE__RECORDING_HEADER];
    int32_t header_size; // bytes of it so far
    unsigned char *content;
    int64_t content_size;     // bytes of it so far
    int32_t content_capacity; // bytes
    int64_t owed;             // bytes that were taken of a feed that found no memory
    // why nothing more is taken
    fe_result refused;
    char sentence[FE__FILE_SENTENCE];
} fe__file;

// FE_OK; FE_ERROR_MEMORY: the next call comes with the same bytes
fe_result fe__file_feed(fe__file *file, const unsigned char *bytes, int64_t size);
void fe__file_free(fe__file *file);
// The content of an asset: the bytes of fe_asset_save. NULL: not there
const unsigned char *fe__file_find_asset(const fe__file *file, const uint64_t *key, int64_t *out_size);

// ---- player ---------------------------------------------------------------------------------------------------------

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

// ---- play -----------------------------------------------------------------------------------------------------------
// A player goes on, from call to call and from step to step.

// FE_OK, FE_END, FE_ERROR_DIVERGED (the first time), FE_ERROR_DATA, FE_ERROR_MEMORY, FE_ERROR_STATE; sentences are set
fe_result fe__player_step(const char *function, fe_player *player);
fe_result fe__player_seek(const char *function, fe_player *player, int64_t step);

// ---- player world ---------------------------------------------------------------------------------------------------
// The world of a player, and the assets in it.

// The world becomes what the keyframe says; made, where there is none
fe_result fe__player_restore(const char *function, fe_player *player, const fe__fed_chunk *keyframe);
// The content of a recorded handle is this from here on
fe_result fe__player_name(const char *function, fe_player *player, fe_asset recorded, const uint64_t *key);
void fe__player_close_world(fe_player *player);
fe_asset fe__player_asset(const fe_player *player, fe_asset recorded); // the own one, 0: none
// What the recorded filter answered
int32_t fe__player_answer(void *user, const fe_filter_pair *pair);

// ---- divergence -----------------------------------------------------------------------------------------------------
// A replay beside its recording.

// FE_OK, or FE_ERROR_DIVERGED for the first time that something is told
fe_result fe__player_differs(const char *function, fe_player *player, const fe_divergence *what, const char *format,
                             ...) FE_PRINTF_LIKE(4, 5);
// The step that was just made, beside what is told of it: the rest of the call
fe_result fe__player_compare_step(const char *function, fe_player *player, int32_t flags);
fe_result fe__player_compare_keyframe(const char *function, fe_player *player, const fe__fed_chunk *keyframe);

#endif
