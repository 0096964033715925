// play.c - see play.h.
#include "replay/play.h"

#include "api/check.h"
#include "record/step_op.h"
#include "replay/compare.h"
#include "replay/player_world.h"

static const fe__fed_chunk *chunk_at(const fe_player *p, int32_t i)
{
    return i >= 0 && i < p->file.chunk_count ? p->file.chunks + i : NULL;
}

static void go_to_chunk(fe_player *p, int32_t chunk)
{
    p->chunk = chunk;
    p->offset = p->idle = 0;
    p->last = (fe__last_step){0};
}

static fe_result refuse(const char *function, const fe_player *p)
{
    return fe__fail(function, FE_ERROR_DATA, "after step %lld, at byte %lld of a chunk: a call that nobody recorded so",
                    (long long)p->step, (long long)p->offset);
}

// ---- calls ---------------------------------------------------------------------------------------------------------
static fe_result tell_call(const char *function, fe_player *p, const char *name)
{
    fe_divergence what = {.type = FE_DIVERGENCE_CALL, .field = name, .component = -1, .body = p->in.handle};
    if (p->in.failed < 0)
        return fe__player_differs(function, p, &what, "after step %lld: %s fails with %s", (long long)p->step, name,
                                  fe_result_name(p->in.failed));
    return fe__player_differs(function, p, &what, "after step %lld: %s returns 0x%llx, another handle than recorded",
                              (long long)p->step, name, p->in.handle);
}

static fe_result play_name(const char *function, fe_player *p)
{
    fe_asset recorded = fe__in_u64(&p->in);
    uint64_t key[2];
    for (int k = 0; k < 2; ++k) key[k] = fe__in_u64(&p->in);
    return p->in.result != FE_OK ? p->in.result : fe__player_name(function, p, recorded, key);
}

static fe_result play_filter(fe_player *p)
{
    uint8_t is_set = fe__in_u8(&p->in);
    if (p->in.result != FE_OK) return p->in.result;
    fe_result result = fe_world_set_pair_filter(p->world, is_set ? fe__player_answer : NULL, p);
    return fe__in_compare(&p->in, result, NULL, NULL, 0);
}

static const fe__words heights_words[] = {{4, 1}, {0, 0}};
static const fe__words material_words[] = {{4, 10}, {8, 1}, {0, 0}};

static fe_result play_heights(fe_player *p)
{
    fe__op_in *in = &p->in;
    fe_asset asset = fe__player_asset(p, fe__in_u64(in));
    int32_t row = fe__in_i32(in), column = fe__in_i32(in), rows = fe__in_count(in), columns = fe__in_count(in);
    if (in->result == FE_OK && (int64_t)rows * columns > (in->end - in->at) / 4) in->result = FE_ERROR_DATA;
    float *heights = fe__in_array(in, 0, rows * (in->result == FE_OK ? columns : 0), sizeof *heights, heights_words);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_heightfield_set_heights(p->world->store, asset, row, column, rows, columns, heights);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_materials(fe_player *p)
{
    fe__op_in *in = &p->in;
    fe_asset asset = fe__player_asset(p, fe__in_u64(in));
    int32_t count = fe__in_count(in);
    fe_material *materials = fe__in_array(in, 0, count, sizeof *materials, material_words);
    if (in->result != FE_OK) return in->result;
    return fe__in_compare(in, fe_mesh_set_materials(p->world->store, asset, materials, 0, count), NULL, NULL, 0);
}

static fe_result play_call(const char *function, fe_player *p, int32_t number, const char **out_name)
{
    switch (number) {
    case FE__OP_ASSET:
        return play_name(function, p);
    case FE__OP_FILTER:
        *out_name = "fe_world_set_pair_filter";
        return play_filter(p);
    case FE__OP_HEIGHTS:
        *out_name = "fe_heightfield_set_heights";
        return play_heights(p);
    case FE__OP_MATERIALS:
        *out_name = "fe_mesh_set_materials";
        return play_materials(p);
    default: {
        const fe__op_call *call = fe__op_call_of(number);
        if (!call) return FE_ERROR_DATA;
        *out_name = call->name;
        return call->play(&p->in);
    }
    }
}

// ---- steps ---------------------------------------------------------------------------------------------------------
// Answers stand behind the hashes: the numbers before them are passed over
static void find_answers(fe_player *p, int32_t flags)
{
    fe__op_in ahead = p->in;
    p->answer_count = p->answered = 0;
    if (!(flags & FE__STEP_HAS_ANSWERS)) return;
    fe__in_u64(&ahead);
    for (int i = 0; i < 3; ++i) fe__in_signed(&ahead);
    if (flags & FE__STEP_IS_DEEP) fe__in_u64(&ahead);
    uint64_t count = fe__in_varint(&ahead);
    if (count > INT32_MAX || !fe__in_bytes(&ahead, (int64_t)(count + 7) / 8)) {
        p->in.result = FE_ERROR_DATA;
        return;
    }
    p->answers = ahead.at - (count + 7) / 8;
    p->answer_count = (int64_t)count;
}

static fe_result make_step(const char *function, fe_player *p, float dt)
{
    fe_result result = fe_world_step(p->world, dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->in.failed = result;
    p->step += 1;
    if (result == FE_OK) return FE_OK;
    fe_result told = tell_call(function, p, "fe_world_step");
    return told == FE_OK ? FE_END : told; // nothing to compare
}

static fe_result play_step(const char *function, fe_player *p)
{
    fe__op_in *in = &p->in;
    int32_t flags = fe__in_u8(in);
    float dt = flags & FE__STEP_HAS_DT ? fe__in_float(in) : p->last.dt;
    find_answers(p, flags);
    if (in->result != FE_OK) return in->result;
    fe_result result = make_step(function, p, dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->last.dt = dt;
    fe_result compared = fe__player_compare_step(function, p, flags);
    return result == FE_OK || compared == FE_ERROR_DATA ? compared : result == FE_END ? FE_OK : result;
}

static fe_result play_idle(const char *function, fe_player *p)
{
    p->answer_count = p->answered = 0;
    fe_result result = make_step(function, p, p->last.dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->idle -= 1;
    const fe_world *w = p->world;
    if (result != FE_OK) return result == FE_END ? FE_OK : result;
    if (w->awake_body_count == 0 && w->pair_count == p->last.pairs && w->linked_count == p->last.linked) return FE_OK;
    fe_divergence what = {.type = FE_DIVERGENCE_STEP, .field = "awake bodies", .component = -1};
    return fe__player_differs(function, p, &what, "step %lld: %d bodies are awake, nobody was when it was recorded",
                              (long long)p->step, (int)w->awake_body_count);
}

// ---- from call to call ---------------------------------------------------------------------------------------------
// One call of a chunk. *out_stepped: it was a step
static fe_result play_one(const char *function, fe_player *p, const fe__fed_chunk *c, int32_t *out_stepped)
{
    fe__op_in *in = &p->in;
    in->at = c->content + p->offset, in->end = c->content + c->size;
    in->world = p->world, in->result = FE_OK, in->failed = FE_OK, in->handle = 0;
    in->assets = p->assets, in->asset_count = p->asset_count;
    const char *name = "";
    int32_t number = fe__in_u8(in);
    fe_result result;
    if (number == FE__OP_IDLE) {
        uint64_t count = fe__in_varint(in);
        result = count > 0 && count <= INT32_MAX ? in->result : FE_ERROR_DATA;
        if (result == FE_OK) p->idle = (int64_t)count;
    } else if (number == FE__OP_STEP) {
        *out_stepped = 1;
        result = play_step(function, p);
    } else {
        result = play_call(function, p, number, &name);
        if (result == FE_ERROR_DIVERGED) result = tell_call(function, p, name);
    }
    if (result == FE_ERROR_DATA) return refuse(function, p);
    if (result == FE_OK || result == FE_ERROR_DIVERGED) {
        p->calls += number != FE__OP_IDLE && number != FE__OP_ASSET;
        p->offset = in->at - c->content;
    }
    return result;
}

// The end of an idle run counts as a call of its own, each step of it
static fe_result play_chunk(const char *function, fe_player *p, const fe__fed_chunk *c, int32_t *out_stepped)
{
    if (p->idle > 0) {
        *out_stepped = 1;
        fe_result result = play_idle(function, p);
        p->calls += result != FE_ERROR_MEMORY;
        return result;
    }
    if (p->offset < c->size) return play_one(function, p, c, out_stepped);
    go_to_chunk(p, p->chunk + 1);
    return FE_OK;
}

static fe_result play_keyframe(const char *function, fe_player *p, const fe__fed_chunk *c)
{
    fe_result result =
        c->flags & FE__CHUNK_JUMP ? fe__player_restore(function, p, c) : fe__player_compare_keyframe(function, p, c);
    if (result == FE_OK && c->flags & FE__CHUNK_JUMP) p->step = c->step;
    if (result == FE_OK || result == FE_ERROR_DIVERGED) go_to_chunk(p, p->chunk + 1);
    return result;
}

static fe_result begin_at(const char *function, fe_player *p, int32_t keyframe)
{
    const fe__fed_chunk *c = chunk_at(p, keyframe);
    FE_TRY(fe__player_restore(function, p, c));
    go_to_chunk(p, keyframe + 1);
    p->step = c->step;
    return FE_OK;
}

static int32_t first_keyframe(const fe_player *p)
{
    for (int32_t i = 0; i < p->file.chunk_count; ++i)
        if (p->file.chunks[i].type == FE__CHUNK_KEYFRAME) return i;
    return -1;
}

fe_result fe__player_step(const char *function, fe_player *p)
{
    if (!p->is_open) {
        int32_t first = first_keyframe(p);
        if (first < 0) return FE_END;
        FE_TRY(begin_at(function, p, first));
        p->is_open = 1;
    }
    if (!p->world) return fe__fail(function, FE_ERROR_STATE, "the world was handed over: seek to make another one");
    for (int32_t stepped = 0; !stepped;) {
        const fe__fed_chunk *c = chunk_at(p, p->chunk);
        if (!c) return FE_END;
        if (c->type == FE__CHUNK_OPS)
            FE_TRY(play_chunk(function, p, c, &stepped));
        else if (c->type == FE__CHUNK_KEYFRAME)
            FE_TRY(play_keyframe(function, p, c));
        else
            go_to_chunk(p, p->chunk + 1);
    }
    return FE_OK;
}

// ---- to a step -----------------------------------------------------------------------------------------------------
// The last keyframe from which the end of that step can be reached: a jump at it comes after that
static int32_t keyframe_before(const fe_player *p, int64_t step)
{
    int32_t first = first_keyframe(p), found = -1;
    for (int32_t i = first; i >= 0 && i < p->file.chunk_count; ++i) {
        const fe__fed_chunk *c = p->file.chunks + i;
        if (c->type != FE__CHUNK_KEYFRAME) continue;
        if (c->step > step) break;
        if (c->step < step || !(c->flags & FE__CHUNK_JUMP) || i == first) found = i;
    }
    return found;
}

fe_result fe__player_seek(const char *function, fe_player *p, int64_t step)
{
    int32_t keyframe = keyframe_before(p, step);
    if (keyframe < 0) {
        int32_t first = first_keyframe(p);
        if (first < 0) return FE_END;
        return fe__fail(function, FE_ERROR_ARGUMENT, "step is %lld, the recording begins at %lld", (long long)step,
                        (long long)chunk_at(p, first)->step);
    }
    int32_t is_ahead = p->is_open && p->world && p->step <= step && p->chunk > keyframe;
    if (!is_ahead) {
        FE_TRY(begin_at(function, p, keyframe));
        p->is_open = 1;
    }
    fe_result result = FE_OK;
    while (p->step < step && (result == FE_OK || result == FE_ERROR_DIVERGED)) {
        fe_result stepped = fe__player_step(function, p);
        result = stepped == FE_OK ? result : stepped;
    }
    return result;
}
