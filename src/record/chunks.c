// chunks.c - see chunks.h.
#include "record/chunks.h"

#include "core/bytes.h"
#include "core/hash.h"
#include "record/op_write.h"
#include "state/format.h"
#include "state/sum.h"

#include <string.h>

const unsigned char fe__recording_magic[8] = {'F', 'E', 'A', 'R', 'E', 'C', 'O', 0x1A};

enum { OPS_BYTES = 1 << 16 }; // content of a chunk of calls, unless one call needs more

static uint64_t header_sum(const unsigned char *bytes, int64_t words)
{
    fe__hash h = fe__hash_begin();
    for (int64_t i = 0; i < words; ++i) fe__hash_u64(&h, fe__take_u64(&bytes));
    return fe__hash_end(&h);
}

uint64_t fe__recording_sum(const unsigned char *header) { return header_sum(header, FE__RECORDING_SUM_AT / 8); }

uint64_t fe__chunk_sum(const unsigned char *header, const unsigned char *content)
{
    const unsigned char *at = header + 8, *step = header + 24;
    int64_t size = (int64_t)fe__take_u64(&at);
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, header_sum(header, 2));
    fe__hash_u64(&h, fe__take_u64(&step));
    fe__hash_u64(&h, fe__sum_of(content, fe__padded(size)));
    return fe__hash_end(&h);
}

// ---- memory --------------------------------------------------------------------------------------------------------
static void give_back(fe_recorder *r, fe__chunk *chunk)
{
    fe__release(&r->memory, chunk, sizeof *chunk + (size_t)chunk->capacity);
}

// A spent one that is large enough; others go
static fe__chunk *take_spent(fe_recorder *r, int64_t capacity)
{
    fe__chunk *found = NULL;
    while (r->spent) {
        fe__chunk *chunk = r->spent;
        r->spent = chunk->next;
        if (!found && chunk->capacity >= capacity && chunk->capacity <= 2 * capacity)
            found = chunk;
        else
            give_back(r, chunk);
    }
    return found;
}

static fe__chunk *allocate(fe_recorder *r, int64_t capacity)
{
    fe__chunk *chunk = take_spent(r, capacity);
    if (chunk) return chunk;
    chunk = fe__allocate_scratch(&r->memory, sizeof *chunk + (size_t)capacity);
    if (chunk) chunk->capacity = capacity;
    return chunk;
}

// ---- what no longer fits -------------------------------------------------------------------------------------------
static int32_t is_named(const fe_recorder *r, const fe__chunk *chunk)
{
    const unsigned char *at = chunk->bytes + FE__CHUNK_HEADER;
    fe__asset_key key;
    key.words[0] = fe__take_u64(&at), key.words[1] = fe__take_u64(&at);
    for (int32_t i = 0; i < r->content_count; ++i)
        if (fe__keys_are_same(r->contents[i].key, key)) return 1;
    return 0;
}

// Forgets the contents that were last named before the step.
static void forget_contents(fe_recorder *r, int64_t step)
{
    int32_t old = 0;
    while (old < r->content_count && r->contents[old].named < step) ++old;
    if (old == 0) return;
    r->content_count -= old;
    memmove(r->contents, r->contents + old, (size_t)r->content_count * sizeof *r->contents);
}

// Drops all chunks but the header, contents that are named, and what is behind the first `keyframes` keyframes.
static void forget_chunks(fe_recorder *r, int32_t keyframes)
{
    fe__chunk **at = &r->first, *last = NULL;
    int32_t seen = 0;
    while (*at) {
        fe__chunk *chunk = *at;
        seen += chunk->type == FE__CHUNK_KEYFRAME;
        int32_t goes = chunk->type == FE__CHUNK_ASSET ? !is_named(r, chunk) : seen > 0 && seen <= keyframes;
        if (goes) {
            *at = chunk->next;
            r->waiting -= chunk->size;
            chunk->next = r->spent;
            r->spent = chunk;
            continue;
        }
        last = chunk;
        at = &chunk->next;
    }
    r->last = last;
}

static int64_t step_of_keyframe(const fe_recorder *r, int32_t number)
{
    for (const fe__chunk *chunk = r->first; chunk; chunk = chunk->next) {
        const unsigned char *at = chunk->bytes + 24;
        if (chunk->type == FE__CHUNK_KEYFRAME && number-- == 0) return (int64_t)fe__take_u64(&at);
    }
    return r->step;
}

// Drops the first keyframe, what follows it up to the next one, and contents that nothing later names.
static void forget_oldest(fe_recorder *r)
{
    forget_contents(r, step_of_keyframe(r, 1));
    forget_chunks(r, 1);
    r->keyframes -= 1;
}

// A keyframe may take the place of all others
static int32_t make_room(fe_recorder *r, uint32_t type, int64_t size)
{
    int32_t least = type == FE__CHUNK_KEYFRAME ? 0 : 1;
    while (r->waiting + size > r->capacity) {
        if (!(r->flags & FE_RECORD_LAST) || r->keyframes <= least) return 0;
        forget_oldest(r);
    }
    return 1;
}

// ---- chunks --------------------------------------------------------------------------------------------------------
fe__chunk *fe__chunk_begin(fe_recorder *r, uint32_t type, int64_t content)
{
    int64_t size = FE__CHUNK_HEADER + fe__padded(content);
    if (!make_room(r, type, size)) {
        fe__recording_fails(r, FE_ERROR_LIMIT);
        return NULL;
    }
    fe__chunk *chunk = allocate(r, size);
    if (!chunk) {
        fe__recording_fails(r, FE_ERROR_MEMORY);
        return NULL;
    }
    chunk->type = type;
    chunk->next = NULL;
    chunk->size = size;
    r->waiting += size;
    return chunk;
}

void fe__chunk_close(fe_recorder *r, fe__chunk *chunk, int64_t content, uint32_t flags, int64_t step)
{
    int64_t size = FE__CHUNK_HEADER + fe__padded(content);
    unsigned char *out = fe__chunk_content(chunk);
    memset(out + content, 0, (size_t)(fe__padded(content) - content));
    unsigned char *at = fe__put_u64(fe__put_u32(fe__put_u32(chunk->bytes, chunk->type), flags), (uint64_t)content);
    fe__put_u64(at + sizeof(uint64_t), (uint64_t)step);
    fe__put_u64(at, fe__chunk_sum(chunk->bytes, out));
    r->waiting += size - chunk->size;
    chunk->size = size;
    if (r->last)
        r->last->next = chunk;
    else
        r->first = chunk;
    r->last = chunk;
    r->keyframes += chunk->type == FE__CHUNK_KEYFRAME;
}

void fe__chunks_free(fe_recorder *r)
{
    if (r->open) r->open->next = r->first, r->first = r->open, r->open = NULL;
    for (fe__chunk *chunk; (chunk = r->first) != NULL;) r->first = chunk->next, give_back(r, chunk);
    while (r->spent) {
        fe__chunk *chunk = r->spent;
        r->spent = chunk->next;
        give_back(r, chunk);
    }
    r->last = NULL;
}

// ---- chunks of calls -----------------------------------------------------------------------------------------------
enum { IDLE_BYTES = 1 + FE__VARINT }; // there is always room for it

static void write_idle(fe_recorder *r)
{
    if (r->idle == 0) return;
    unsigned char *end = fe__put_varint(fe__put_u8(r->at, FE__OP_IDLE), (uint64_t)r->idle);
    r->at = end;
    r->idle = 0;
}

void fe__close_open_chunk(fe_recorder *r)
{
    if (!r->open) return;
    write_idle(r);
    fe__chunk *chunk = r->open;
    r->open = NULL;
    fe__chunk_close(r, chunk, r->at - fe__chunk_content(chunk), 0, r->open_since);
}

// Whatever a chunk takes of the room while it is open, it gives back what it did not need when it is closed
static int32_t open_for(fe_recorder *r, int64_t need)
{
    if (r->open && r->at + need > r->open->bytes + r->open->capacity) fe__close_open_chunk(r);
    if (r->open) return 1;
    int64_t most = r->capacity / 8 < OPS_BYTES ? r->capacity / 8 : OPS_BYTES;
    fe__chunk *chunk = fe__chunk_begin(r, FE__CHUNK_OPS, need > most ? need : most);
    if (!chunk) return 0;
    r->open = chunk;
    r->at = fe__chunk_content(chunk);
    r->open_since = r->step;
    r->open_time = 0.0;
    r->before = (fe__last_step){0};
    return 1;
}

unsigned char *fe__op_begin(fe_recorder *r, int32_t number, int64_t most)
{
    fe__mutex_lock(&r->lock);
    int64_t need = 1 + most + 2 * IDLE_BYTES + 8; // of a run before it and after it, and padding
    if (r->end != FE_OK || r->has_gap || !open_for(r, need)) {
        if (r->flags & FE_RECORD_LAST && r->end == FE_ERROR_LIMIT) r->has_gap = 1, r->end = FE_OK;
        fe__mutex_unlock(&r->lock);
        return NULL;
    }
    write_idle(r);
    r->has_called |= number != FE__OP_STEP;
    return fe__put_u8(r->at, (uint8_t)number);
}

void fe__op_end(fe_recorder *r, unsigned char *at)
{
    r->since_keyframe += at - r->at;
    r->at = at;
    fe__mutex_unlock(&r->lock);
}
