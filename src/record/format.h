// format.h - the bytes of a recording. All numbers are little-endian.
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
#ifndef FE_RECORD_FORMAT_H
#define FE_RECORD_FORMAT_H
#include <stdint.h>

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
    FE__OP_STEP = 1,      // fe_world_step, see step_op.h
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

#endif
