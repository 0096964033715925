// recording.c - see recording.h.
#include "record/recording.h"

#include "record/chunks.h"
#include "record/keyframe.h"

#include "core/bytes.h"
#include "state/format.h"

static int32_t write_header(fe_recorder *r)
{
    fe__chunk *chunk = fe__allocate(&r->memory, sizeof *chunk + FE__RECORDING_HEADER);
    if (!chunk) return 0;
    chunk->capacity = chunk->size = FE__RECORDING_HEADER;
    unsigned char *at = fe__put_bytes(chunk->bytes, fe__recording_magic, sizeof fe__recording_magic);
    at = fe__put_u16(fe__put_u16(at, FE__RECORDING_MAJOR), FE__RECORDING_MINOR);
    at = fe__put_u32(at, FE__RESULTS);
    at = fe__put_u32(at, FE_VERSION_MAJOR << 16 | FE_VERSION_MINOR << 8 | FE_VERSION_PATCH);
    at = fe__put_u64(fe__put_u32(at, r->flags), 0);
    fe__put_u64(at, fe__recording_sum(chunk->bytes));
    r->first = r->last = chunk;
    r->waiting = chunk->size;
    return 1;
}

fe_recorder *fe__recorder_create(fe_world *world, uint32_t flags, int32_t keyframe_steps, int64_t capacity,
                                 fe_result *out_result)
{
    // Memory of its own, by the world's allocator: it outlives the world, and the world's measures do not know it
    fe__memory memory = {.allocator = world->memory.allocator, .guard = world->memory.guard};
    *out_result = FE_ERROR_MEMORY;
    fe_recorder *r = fe__allocate(&memory, sizeof *r);
    if (!r) return NULL;
    r->memory = memory;
    fe__mutex_init(&r->lock);
    r->flags = flags;
    r->keyframe_steps = keyframe_steps;
    r->capacity = capacity;
    r->world = world;
    r->step = world->step_number;
    if (!write_header(r)) fe__recording_fails(r, FE_ERROR_MEMORY);
    fe__record_keyframe(r, 0);
    *out_result = r->end;
    if (r->end == FE_OK) {
        world->recorder = r;
        return r;
    }
    r->world = NULL;
    fe__recorder_destroy(r);
    return NULL;
}

void fe__recorder_detach(fe_recorder *r, fe_result end)
{
    fe__mutex_lock(&r->lock);
    fe__recording_fails(r, end);
    fe__close_open_chunk(r);
    r->world->recorder = NULL;
    r->world = NULL;
    r->memory.guard = NULL; // it is the store's
    fe__mutex_unlock(&r->lock);
}

void fe__recorder_destroy(fe_recorder *r)
{
    if (r->world) fe__recorder_detach(r, FE_END);
    fe__memory memory = r->memory;
    fe__chunks_free(r);
    FE_FREE(&r->memory, r->answers, r->answer_capacity);
    FE_FREE(&r->memory, r->assets, r->asset_capacity);
    FE_FREE(&r->memory, r->contents, r->content_capacity);
    fe__mutex_free(&r->lock);
    fe__release(&memory, r, sizeof *r);
}

// ---- reading -------------------------------------------------------------------------------------------------------
static fe_result read_all(const fe_recorder *r, unsigned char *out, int64_t capacity, int64_t *out_size)
{
    *out_size = r->waiting;
    if (capacity < r->waiting) return FE_ERROR_LIMIT;
    for (const fe__chunk *chunk = r->first; chunk; chunk = chunk->next)
        out = fe__put_bytes(out, chunk->bytes, chunk->size);
    return FE_OK;
}

static fe_result read_some(fe_recorder *r, unsigned char *out, int64_t capacity, int64_t *out_size)
{
    *out_size = 0;
    if (!r->first) return r->end;
    if (r->first->size > capacity) {
        *out_size = r->first->size;
        return FE_ERROR_LIMIT;
    }
    while (r->first && r->first->size <= capacity - *out_size) {
        fe__chunk *chunk = r->first;
        r->first = chunk->next;
        if (!r->first) r->last = NULL;
        out = fe__put_bytes(out, chunk->bytes, chunk->size);
        *out_size += chunk->size;
        r->waiting -= chunk->size;
        chunk->next = r->spent;
        r->spent = chunk;
    }
    return FE_OK;
}

fe_result fe__recorder_read(fe_recorder *r, unsigned char *out, int64_t capacity, int64_t *out_size)
{
    fe__mutex_lock(&r->lock);
    fe_result result = FE_OK;
    fe__close_open_chunk(r);
    if (!out && (r->first || r->end == FE_OK))
        *out_size = r->waiting;
    else
        result =
            r->flags & FE_RECORD_LAST ? read_all(r, out, capacity, out_size) : read_some(r, out, capacity, out_size);
    fe__mutex_unlock(&r->lock);
    return result;
}

// ---- notes ---------------------------------------------------------------------------------------------------------
fe_result fe__recorder_note(fe_recorder *r, fe_handle about, const char *text)
{
    int64_t length = (int64_t)strlen(text), size = FE__NOTE_FRONT + length;
    fe__mutex_lock(&r->lock);
    fe_result result = r->end == FE_OK ? FE_OK : FE_ERROR_STATE;
    if (result == FE_OK) {
        fe__close_open_chunk(r);
        fe__chunk *chunk = fe__chunk_begin(r, FE__CHUNK_NOTE, size);
        if (chunk) {
            fe__put_bytes(fe__put_u64(fe__chunk_content(chunk), about), (const uint8_t *)text, length);
            fe__chunk_close(r, chunk, size, 0, r->step);
        }
        if (r->end != FE_OK) result = r->end;
    }
    fe__mutex_unlock(&r->lock);
    return result;
}
