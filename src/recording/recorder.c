// recorder.c - see recorder.h.
#include "recording/recorder.h"

#include "core/bytes.h"
#include "recording/op_write.h"
#include "snapshot/format.h"
#include "world/contact.h"
#include "world/hash.h"
#include "world/world.h"

#include <string.h>

// ---- recording ------------------------------------------------------------------------------------------------------

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

// ---- chunks ---------------------------------------------------------------------------------------------------------

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

// ---- step -----------------------------------------------------------------------------------------------------------

// ---- answers -------------------------------------------------------------------------------------------------------
static int32_t listen(void *user, const fe_filter_pair *pair)
{
    fe_recorder *r = user;
    int32_t answer = r->filter(r->filter_user, pair);
    if (r->answer_count >= 0 && FE_RESERVE(&r->memory, r->answers, r->answer_capacity, r->answer_count + 1))
        r->answers[r->answer_count++] = answer != 0;
    else
        r->answer_count = -1;
    return answer;
}

void fe__record_step_begin(fe_recorder *r)
{
    fe_world *w = r->world;
    r->answer_count = 0;
    r->filter = w->pair_filter;
    r->filter_user = w->pair_filter_user;
    if (r->filter) w->pair_filter = listen, w->pair_filter_user = r;
}

static unsigned char *put_answers(unsigned char *at, const fe_recorder *r)
{
    at = fe__put_varint(at, (uint64_t)r->answer_count);
    for (int32_t i = 0; i < r->answer_count; i += 8) {
        uint8_t bits = 0;
        for (int32_t k = 0; k < 8 && i + k < r->answer_count; ++k) bits |= (uint8_t)(r->answers[i + k] << k);
        *at++ = bits;
    }
    return at;
}

// ---- traces --------------------------------------------------------------------------------------------------------
static unsigned char *put_traces(unsigned char *at, const fe_world *w)
{
    at = fe__put_varint(at, (uint64_t)w->awake_body_count);
    for (int32_t i = 0, before = 0; i < w->awake_body_count; before = w->awake_bodies[i++]) {
        at = fe__put_signed(at, (int64_t)w->awake_bodies[i] - before);
        fe__trace_of(w, w->awake_bodies[i], at);
        at += FE__TRACE;
    }
    return at;
}

// ---- the step ------------------------------------------------------------------------------------------------------
static int32_t is_idle(const fe_recorder *r, float dt)
{
    const fe_world *w = r->world;
    const fe__last_step *b = &r->before;
    return r->open && !r->has_gap && w->awake_body_count == 0 && b->awake == 0 && b->dt == dt && dt > 0.0f &&
           b->pairs == w->pair_count && b->linked == w->linked_count && r->answer_count == 0;
}

static unsigned char *put_step(fe_recorder *r, unsigned char *at, float dt, uint64_t hash)
{
    const fe_world *w = r->world;
    fe__last_step *b = &r->before;
    int32_t flags = (b->dt == dt ? 0 : FE__STEP_HAS_DT) |
                    ((r->step + 1) % FE__STEPS_BETWEEN_DEEP || !w->awake_body_count ? 0 : FE__STEP_IS_DEEP) |
                    (r->answer_count ? FE__STEP_HAS_ANSWERS : 0) |
                    (r->flags & FE_RECORD_FINE ? FE__STEP_HAS_TRACES : 0);
    at = fe__put_u8(at, (uint8_t)flags);
    if (flags & FE__STEP_HAS_DT) at = fe__put_float(at, dt);
    at = fe__put_u64(at, hash);
    at = fe__put_signed(at, (int64_t)w->awake_body_count - b->awake);
    at = fe__put_signed(at, (int64_t)w->pair_count - b->pairs);
    at = fe__put_signed(at, (int64_t)w->linked_count - b->linked);
    if (flags & FE__STEP_IS_DEEP) at = fe__put_u64(at, fe__deep_hash(w));
    if (flags & FE__STEP_HAS_ANSWERS) at = put_answers(at, r);
    if (flags & FE__STEP_HAS_TRACES) at = put_traces(at, w);
    *b = (fe__last_step){dt, w->awake_body_count, w->pair_count, w->linked_count};
    return at;
}

static void record_step(fe_recorder *r, float dt)
{
    enum { FRONT = 1 + 4 + 8 + 3 * FE__VARINT + 8 + 2 * FE__VARINT }; // bytes but for arrays
    const fe_world *w = r->world;
    int64_t traces = r->flags & FE_RECORD_FINE ? (int64_t)w->awake_body_count * (FE__TRACE + FE__VARINT) : 0;
    uint64_t hash = fe__awake_hash(w); // before the lock: nobody waits for it
    unsigned char *at = fe__op_begin(r, FE__OP_STEP, FRONT + r->answer_count + traces);
    if (!at) {
        r->step += r->has_gap;
        return;
    }
    at = put_step(r, at, dt, hash);
    r->step += 1;
    r->open_time += (double)dt;
    r->busy_steps += w->awake_body_count > 0 || r->has_called;
    r->has_called = 0;
    fe__op_end(r, at);
}

// A chunk holds a second at most: who reads along is not kept waiting
static void note_step(fe_recorder *r, float dt)
{
    const double most = 1.0; // s
    fe__mutex_lock(&r->lock);
    int32_t idle = r->end == FE_OK && is_idle(r, dt);
    if (idle) r->idle += 1, r->step += 1;
    fe__mutex_unlock(&r->lock);
    if (idle) return;
    record_step(r, dt);
    fe__mutex_lock(&r->lock);
    if (r->open && r->open_time >= most) fe__close_open_chunk(r);
    fe__mutex_unlock(&r->lock);
    fe__record_due_keyframe(r);
}

void fe__record_step_end(fe_recorder *r, float dt, fe_result result)
{
    fe_world *w = r->world;
    w->pair_filter = r->filter;
    w->pair_filter_user = r->filter_user;
    if (result != FE_OK) return;
    if (r->answer_count < 0) {
        fe__mutex_lock(&r->lock);
        fe__recording_fails(r, FE_ERROR_MEMORY);
        fe__mutex_unlock(&r->lock);
    }
    if (r->end == FE_OK) note_step(r, dt);
}

void fe__record_filter(fe_recorder *r)
{
    unsigned char *at = fe__op_begin(r, FE__OP_FILTER, 1);
    if (at) fe__op_end(r, fe__put_u8(at, r->world->pair_filter != NULL));
}

// ---- step op --------------------------------------------------------------------------------------------------------

// Position and velocity side by side: the multiplications of one need not wait for those of the other
static uint64_t hash_of(const fe__body *b)
{
    fe__hash pose = fe__hash_begin(), motion = fe__hash_begin();
    fe__hash_u64(&pose, b->serial);
    for (int k = 0; k < 3; ++k) fe__hash_double(&pose, b->origin[k]);
    fe__hash_floats2(&motion, b->rotation[0], b->rotation[1]);
    fe__hash_floats2(&motion, b->rotation[2], b->rotation[3]);
    fe__hash_floats2(&motion, b->velocity[0], b->velocity[1]);
    fe__hash_floats2(&motion, b->velocity[2], b->spin[0]);
    fe__hash_floats2(&motion, b->spin[1], b->spin[2]);
    fe__hash_u64(&pose, motion.state);
    return pose.state;
}

uint64_t fe__awake_hash(const fe_world *w)
{
    uint64_t sum = 0;
    for (int32_t i = 0; i < w->awake_body_count; ++i) sum += hash_of(w->bodies + w->awake_bodies[i]);
    return sum;
}

static uint64_t rest_of(const fe__body *b)
{
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, b->serial);
    fe__hash_float(&h, b->sleep_timer);
    for (int k = 0; k < 3; ++k) fe__hash_floats2(&h, b->force[k], b->torque[k]);
    return h.state;
}

uint64_t fe__deep_hash(const fe_world *w)
{
    uint64_t sum = fe__hash_of_events(w);
    for (int32_t i = 0; i < w->awake_body_count; ++i) sum += rest_of(w->bodies + w->awake_bodies[i]);
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        int32_t pair = w->awake_pairs[i]; // deferred ones are below 0
        if (pair >= 0 && w->pairs[pair].flags & FE__PAIR_LINKED) sum += fe__hash_of_contact(w, pair);
    }
    for (int32_t i = 0; i < w->awake_joint_count; ++i) sum += fe__hash_of_impulses(w, w->awake_joints[i]);
    return sum;
}

// ---- traces --------------------------------------------------------------------------------------------------------
// The factor is odd: the next float, or double, always has another byte
static uint8_t byte_of(uint64_t bits) { return (uint8_t)(bits * FE_HASH_FACTOR >> 56); }

void fe__trace_of(const fe_world *w, int32_t body, uint8_t *t)
{
    const fe__body *b = w->bodies + body;
    for (int k = 0; k < 3; ++k) {
        t[FE__TRACE_POSITION + k] = byte_of(fe__double_bits(b->origin[k]));
        t[FE__TRACE_VELOCITY + k] = byte_of(fe__float_bits(b->velocity[k]));
        t[FE__TRACE_SPIN + k] = byte_of(fe__float_bits(b->spin[k]));
    }
    for (int k = 0; k < 4; ++k) t[FE__TRACE_ROTATION + k] = byte_of(fe__float_bits(b->rotation[k]));
    fe__hash forces = fe__hash_begin(), sleep = fe__hash_begin();
    for (int k = 0; k < 3; ++k) fe__hash_floats2(&forces, b->force[k], b->torque[k]);
    fe__hash_float(&sleep, b->sleep_timer);
    uint64_t contacts = 0;
    for (int32_t pair = b->first_contact; pair >= 0; pair = fe__next_pair(w, pair, body))
        if (w->pairs[pair].flags & FE__PAIR_LINKED) contacts += fe__hash_of_contact(w, pair);
    t[FE__TRACE_FORCES] = byte_of(forces.state);
    t[FE__TRACE_SLEEP] = byte_of(sleep.state);
    t[FE__TRACE_CONTACTS] = byte_of(contacts);
}
