// file.h - the bytes that a player was fed, as chunks: whole ones, whose sums are right.
#ifndef FE_REPLAY_FILE_H
#define FE_REPLAY_FILE_H
#include "core/memory.h"
#include "record/format.h"

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

#endif
