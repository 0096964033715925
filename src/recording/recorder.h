// recorder.h - a recording while it grows: chunks that wait to be read, and what the next ones are written with.
//
// The thread that uses the world writes, any thread reads: the lock is held for each call that is noted and for each
// read, never in a step. Memory is asked for by the writer alone. When there is none, or no room, the recording ends;
// the calls of the world go on as if nobody had recorded.
//
// With FE_RECORD_LAST chunks are not given away: keyframes and what follows them go, oldest first, as room is needed,
// and with them the contents of assets that nothing names any more.
#ifndef FE_RECORDING_RECORDER_H
#define FE_RECORDING_RECORDER_H
#include "core/mutex.h"
#include "store/asset_key.h"
#include "world/world.h"

#include <stdint.h>

// ---- format ---------------------------------------------------------------------------------------------------------
// The bytes of a recording. All numbers are little-endian.
//
//   header   0  magic (8 bytes) | major, minor (2 each) | results (4) | version of the library (4) | flags (4)
//           24  0 (8) | sum of the 32 bytes before (8)
//   chunk       type (4) | flags (4) | bytes of its content (8) | sum (8) | step (8) | content, padded with zeros to 8
//
// Chunks are only ever appended. The sum is that of the content, joined with the other four numbers, so that each byte
// counts. `step` is how many steps the recording had seen when the chunk began: it grows by one with each step, and no
// restore sets it back.
//
//   KEYF     number of assets (4) | is there a pair filter? (4) | handle (8), key (16) of each | a snapshot. With
//   FE__CHUNK_JUMP the world
//            became this; without, it was this already
//   ASST     key (16) | the bytes of fe_asset_save
//   OPS      calls, one after another: number (1), arguments (ops.h). What is written shorter because of what stood
//            before it, does so within its chunk: any chunk can be read alone
//   NOTE     handle (8) | text
//
// A reader passes over chunks that it does not know. Minor versions append: calls, chunks, and fields behind others.

enum {
    FE__RECORDING_MAJOR = 1,
    FE__RECORDING_MINOR = 0,
    FE__RECORDING_HEADER = 40,
    FE__RECORDING_SUM_AT = 32,
    FE__CHUNK_HEADER = 32,
    FE__ASSET_ENTRY = 24, // bytes: handle and key
    FE__KEYFRAME_FRONT = 8,
    FE__ASSET_KEY = 16,
    FE__NOTE_FRONT = 8
};

// Four letters each
enum {
    FE__CHUNK_KEYFRAME = 'K' | 'E' << 8 | 'Y' << 16 | 'F' << 24,
    FE__CHUNK_ASSET = 'A' | 'S' << 8 | 'S' << 16 | 'T' << 24,
    FE__CHUNK_OPS = 'O' | 'P' << 8 | 'S' << 16 | ' ' << 24,
    FE__CHUNK_NOTE = 'N' | 'O' << 8 | 'T' << 16 | 'E' << 24
};

// Flags of a chunk
enum { FE__CHUNK_DEFLATED = 1, FE__CHUNK_JUMP = 2 };

// Calls that tools/ops does not number, and what is no call
enum {
    FE__OP_IDLE = 0,      // how many steps (a varint), like the last one, in which nobody was awake
    FE__OP_STEP = 1,      // fe_world_step, see recorder.h
    FE__OP_ASSET = 2,     // handle (8), key (16): from here on the handle is of that content
    FE__OP_FILTER = 3,    // is there one? (1)
    FE__OP_HEIGHTS = 4,   // asset (8), row, column, rows, columns (4 each), heights
    FE__OP_MATERIALS = 5, // asset (8), count (4), materials
    FE__OP_MOST = 255
};

extern const unsigned char fe__recording_magic[8];

// The sum in a chunk's header; `content` padded
uint64_t fe__chunk_sum(const unsigned char *header, const unsigned char *content);
uint64_t fe__recording_sum(const unsigned char *header);

// ---- recorder -------------------------------------------------------------------------------------------------------

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

// ---- recording ------------------------------------------------------------------------------------------------------
// A recording from its first keyframe to its end, and who reads it.

// A recorder that has written its first keyframe. NULL: *out_result is FE_ERROR_MEMORY or FE_ERROR_LIMIT
fe_recorder *fe__recorder_create(fe_world *world, uint32_t flags, int32_t keyframe_steps, int64_t capacity,
                                 fe_result *out_result);
void fe__recorder_destroy(fe_recorder *recorder); // the world's, or of no world
// The world ends, or its recorder: what is there can be read
void fe__recorder_detach(fe_recorder *recorder, fe_result end);
// As many whole chunks as the capacity takes; with FE_RECORD_LAST all of them, or none. From any thread
fe_result fe__recorder_read(fe_recorder *recorder, unsigned char *out, int64_t capacity, int64_t *out_size);
fe_result fe__recorder_note(fe_recorder *recorder, fe_handle about, const char *text);

// ---- chunks ---------------------------------------------------------------------------------------------------------
// The chunks of a recorder: room for them, their sums, and which ones go. All under the recorder's lock.

// The writer's: a chunk for so many bytes of content, not listed yet, counted as waiting. NULL: the recording has ended
fe__chunk *fe__chunk_begin(fe_recorder *recorder, uint32_t type, int64_t content);
// Its content is written: header, sum, and to the others
void fe__chunk_close(fe_recorder *recorder, fe__chunk *chunk, int64_t content, uint32_t flags, int64_t step);
void fe__close_open_chunk(fe_recorder *recorder); // that of calls, if there is one
void fe__chunks_free(fe_recorder *recorder);      // all

// ---- calls, without the lock ---------------------------------------------------------------------------------------
// Room for a call and so many bytes of arguments; the lock is held until fe__op_end. NULL: the recording has ended
unsigned char *fe__op_begin(fe_recorder *recorder, int32_t number, int64_t most);
void fe__op_end(fe_recorder *recorder, unsigned char *at);

static inline unsigned char *fe__chunk_content(fe__chunk *chunk) { return chunk->bytes + FE__CHUNK_HEADER; }
static inline void fe__recording_fails(fe_recorder *recorder, fe_result why)
{
    if (recorder->end == FE_OK) recorder->end = why;
}

// ---- step -----------------------------------------------------------------------------------------------------------
// Steps in a recording. In one of them the recorder listens to the pair filter, in its place.

void fe__record_step_begin(fe_recorder *recorder);
void fe__record_step_end(fe_recorder *recorder, float dt, fe_result result);
void fe__record_filter(fe_recorder *recorder); // another one, or none

// ---- step op --------------------------------------------------------------------------------------------------------
// What is told of a step, so that a replay knows at once when it goes another way.
//
//   number (1) | bits of what follows (1) | dt (4), unless that of the step before | the hash of awake bodies (8) |
//   awake bodies, pairs, contacts, as differences (varints) | the deep hash (8), every 64th step |
//   answers of the pair filter: how many (varint), a bit each |
//   traces, with FE_RECORD_FINE: how many (varint); difference of slots (varint), bytes (16) of each
//
// A hash is a sum over bodies: in whatever order they are listed.

enum { FE__STEP_HAS_DT = 1, FE__STEP_IS_DEEP = 2, FE__STEP_HAS_ANSWERS = 4, FE__STEP_HAS_TRACES = 8 };
enum { FE__STEPS_BETWEEN_DEEP = 64 };

// A byte for each number of a body, in this order
enum {
    FE__TRACE_POSITION = 0,
    FE__TRACE_ROTATION = 3,
    FE__TRACE_VELOCITY = 7,
    FE__TRACE_SPIN = 10,
    FE__TRACE_FORCES = 13,   // pending force and torque
    FE__TRACE_SLEEP = 14,    // timer, flags
    FE__TRACE_CONTACTS = 15, // of its contacts: points and impulses
    FE__TRACE = 16
};

uint64_t fe__awake_hash(const fe_world *world); // poses and velocities
// What the step left besides: contacts and joints of who is awake, forces, timers, events
uint64_t fe__deep_hash(const fe_world *world);
void fe__trace_of(const fe_world *world, int32_t body, uint8_t *out_trace);

// ---- keyframe -------------------------------------------------------------------------------------------------------
// The whole state in a recording, and the assets that it and the calls rest on.

// FE__CHUNK_JUMP: the world became this
void fe__record_keyframe(fe_recorder *recorder, uint32_t flags);
void fe__record_jump(fe_recorder *recorder);
// Of a step that was noted: is a keyframe due?
void fe__record_due_keyframe(fe_recorder *recorder);
// A shape is given a form of an asset
void fe__record_form(fe_recorder *recorder, const fe__form *form);
// Edits, under the store's lock: of every world that uses the asset, after the edit
void fe__record_heights(fe_store *store, int32_t asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                        const float *heights);
void fe__record_materials(fe_store *store, int32_t asset);

#endif
