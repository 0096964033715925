// chunks.h - the chunks of a recorder: room for them, their sums, and which ones go. All under the recorder's lock.
#ifndef FE_RECORD_CHUNKS_H
#define FE_RECORD_CHUNKS_H
#include "record/recorder.h"

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

#endif
