// step.c - see step.h.
#include "record/step.h"

#include "record/chunks.h"
#include "record/keyframe.h"
#include "record/op_write.h"
#include "record/step_op.h"
#include "world/handles.h"

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
