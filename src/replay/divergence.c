// divergence.c - see player.h: steps, traces of bodies, keyframes.
#include "replay/player.h"

#include "recording/recorder.h"
#include "snapshot/write.h"
#include "world/world.h"

#include <stdarg.h>
#include <stdio.h>

fe_result fe__player_differs(const char *function, fe_player *p, const fe_divergence *what, const char *format, ...)
{
    if (p->has_diverged) return FE_OK;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(p->text, sizeof p->text, format, arguments);
    va_end(arguments);
    p->has_diverged = 1;
    p->divergence = *what;
    p->divergence.struct_size = sizeof p->divergence;
    p->divergence.text = p->text;
    p->divergence.step = p->step;
    if (!p->divergence.field) p->divergence.field = "";
    return fe__fail(function, FE_ERROR_DIVERGED, "%s", p->text);
}

// ---- traces --------------------------------------------------------------------------------------------------------
typedef struct trace_field {
    const char *name;
    int32_t first, count; // bytes
} trace_field;

// Velocities first: a pose that differs follows from one
static const trace_field fields[] = {{"linear velocity", FE__TRACE_VELOCITY, 3},
                                     {"angular velocity", FE__TRACE_SPIN, 3},
                                     {"position", FE__TRACE_POSITION, 3},
                                     {"rotation", FE__TRACE_ROTATION, 4},
                                     {"pending forces", FE__TRACE_FORCES, 1},
                                     {"sleep timer", FE__TRACE_SLEEP, 1},
                                     {"contacts", FE__TRACE_CONTACTS, 1}};

static const char *const axes[] = {"x", "y", "z", "w"};

static fe_result tell_field(const char *function, fe_player *p, int32_t body, const trace_field *field,
                            int32_t component)
{
    fe_divergence what = {.type = FE_DIVERGENCE_STEP, .field = field->name, .component = component};
    what.body = fe__body_handle(p->world, body);
    return fe__player_differs(function, p, &what, "step %lld: %s%s%s of body 0x%llx differs from the recorded one",
                              (long long)p->step, field->name, component < 0 ? "" : ".",
                              component < 0 ? "" : axes[component], what.body);
}

static int32_t is_awake(const fe_world *w, int64_t slot)
{
    for (int32_t i = 0; i < w->awake_body_count; ++i)
        if (w->awake_bodies[i] == slot) return 1;
    return 0;
}

static fe_result compare_trace(const char *function, fe_player *p, int64_t slot, const uint8_t *then)
{
    uint8_t now[FE__TRACE];
    if (!is_awake(p->world, slot)) {
        fe_divergence what = {.type = FE_DIVERGENCE_STEP, .field = "awake", .component = -1};
        return fe__player_differs(function, p, &what, "step %lld: the body in slot %lld is not awake, as recorded",
                                  (long long)p->step, (long long)slot);
    }
    fe__trace_of(p->world, (int32_t)slot, now);
    for (size_t f = 0; f < sizeof fields / sizeof *fields; ++f)
        for (int32_t k = 0; k < fields[f].count; ++k)
            if (now[fields[f].first + k] != then[fields[f].first + k])
                return tell_field(function, p, (int32_t)slot, fields + f, fields[f].count > 1 ? k : -1);
    return FE_OK;
}

// A hash is compared before them: while that is the same, they are passed over
static fe_result compare_traces(const char *function, fe_player *p, int32_t differs)
{
    fe__op_in *in = &p->in;
    int64_t count = (int64_t)fe__in_varint(in), slot = 0;
    fe_result result = FE_OK;
    for (int64_t i = 0; i < count && in->result == FE_OK; ++i) {
        slot += fe__in_signed(in);
        const unsigned char *then = fe__in_bytes(in, FE__TRACE);
        if (then && differs && result == FE_OK) result = compare_trace(function, p, slot, then);
    }
    return result;
}

// ---- steps ---------------------------------------------------------------------------------------------------------
typedef struct told_step {
    uint64_t hash, deep;
    int32_t awake, pairs, linked;
} told_step;

static fe_result tell_step(const char *function, fe_player *p, const told_step *then, const told_step *now)
{
    fe_divergence what = {.type = FE_DIVERGENCE_STEP, .component = -1};
    if (then->awake != now->awake) {
        what.field = "awake bodies";
        return fe__player_differs(function, p, &what, "step %lld: %d bodies are awake, %d were when it was recorded",
                                  (long long)p->step, (int)now->awake, (int)then->awake);
    }
    if (then->pairs != now->pairs || then->linked != now->linked) {
        what.field = "pairs";
        return fe__player_differs(function, p, &what,
                                  "step %lld: %d pairs, %d of them touch; there were %d and %d when it was recorded",
                                  (long long)p->step, (int)now->pairs, (int)now->linked, (int)then->pairs,
                                  (int)then->linked);
    }
    if (p->answered != p->answer_count) {
        what.field = "pair filter";
        return fe__player_differs(function, p, &what,
                                  "step %lld: the pair filter was asked %lld times, %lld when it was recorded",
                                  (long long)p->step, (long long)p->answered, (long long)p->answer_count);
    }
    if (then->hash == now->hash) what.field = "contacts, joints, forces or events";
    return fe__player_differs(function, p, &what, "step %lld: %s of awake bodies differ from the recorded ones",
                              (long long)p->step, what.field ? what.field : "poses or velocities");
}

static int32_t is_same(const told_step *a, const told_step *b)
{
    return a->hash == b->hash && a->deep == b->deep && a->awake == b->awake && a->pairs == b->pairs &&
           a->linked == b->linked;
}

// As a 32-bit sum: what hostile bytes add up to is no overflow
static int32_t add(int32_t a, int64_t b) { return (int32_t)(uint32_t)((uint64_t)a + (uint64_t)b); }

fe_result fe__player_compare_step(const char *function, fe_player *p, int32_t flags)
{
    fe__op_in *in = &p->in;
    const fe_world *w = p->world;
    told_step now = {fe__awake_hash(w), 0, w->awake_body_count, w->pair_count, w->linked_count}, then = {0};
    then.hash = fe__in_u64(in);
    then.awake = add(p->last.awake, fe__in_signed(in));
    then.pairs = add(p->last.pairs, fe__in_signed(in));
    then.linked = add(p->last.linked, fe__in_signed(in));
    p->last = (fe__last_step){p->last.dt, then.awake, then.pairs, then.linked};
    if (flags & FE__STEP_IS_DEEP) then.deep = fe__in_u64(in), now.deep = fe__deep_hash(w);
    if (flags & FE__STEP_HAS_ANSWERS) fe__in_bytes(in, (int64_t)(fe__in_varint(in) + 7) / 8);
    int32_t differs = !is_same(&then, &now) || p->answered != p->answer_count;
    fe_result result = flags & FE__STEP_HAS_TRACES ? compare_traces(function, p, differs) : FE_OK;
    if (in->result != FE_OK) return in->result;
    return differs && result == FE_OK ? tell_step(function, p, &then, &now) : result;
}

// ---- keyframes -----------------------------------------------------------------------------------------------------
typedef struct section {
    uint32_t type;
    const unsigned char *bytes; // with the header
    int64_t size;
} section;

static int32_t next_section(const unsigned char *bytes, int64_t size, int64_t *at, section *out)
{
    if (size - *at < FE__SECTION_HEADER) return 0;
    const unsigned char *type = bytes + *at, *length = type + 8;
    out->bytes = type;
    out->type = fe__take_u32(&type);
    out->size = (int64_t)fe__take_u64(&length);
    if (out->size < 0 || out->size > size - *at - FE__SECTION_HEADER) return 0;
    out->size += FE__SECTION_HEADER;
    *at += out->size;
    return 1;
}

// Where in a row of the table the field of the record at that offset stands
static int64_t place_in_row(const fe__table *table, size_t offset)
{
    int64_t at = 0;
    for (const fe__field *field = table->fields; field->offset != offset; ++field) at += fe__field_size(field);
    return at;
}

// But for the lists of who has an asset: two of one content are one in a world that began at a keyframe. Both have the
// size of what this library writes
static int32_t shapes_are_same(const section *a, const section *b)
{
    const fe__table *table = fe__tables + FE__TABLE_SHAPES;
    const unsigned char *x = a->bytes + FE__SECTION_HEADER, *y = b->bytes + FE__SECTION_HEADER, *rows = x;
    int64_t count = (int64_t)fe__take_u64(&rows), list = place_in_row(table, offsetof(fe__shape, next_user));
    int64_t after = list + (int64_t)sizeof((fe__shape *)0)->next_user;
    if (memcmp(x, y, FE__SECTION_ROWS) != 0) return 0;
    x += FE__SECTION_ROWS, y += FE__SECTION_ROWS;
    for (int64_t i = 0; i < count; ++i, x += table->row_size, y += table->row_size) {
        if (memcmp(x, y, (size_t)list) != 0) return 0;
        if (memcmp(x + after, y + after, (size_t)(table->row_size - after)) != 0) return 0;
    }
    return 1;
}

static int32_t are_same(const section *a, const section *b)
{
    if (a->size != b->size) return 0;
    return a->type == FE__TABLE_SHAPES ? shapes_are_same(a, b) : memcmp(a->bytes, b->bytes, (size_t)a->size) == 0;
}

// The first section that differs, but for the assets', which name the handles of a store; NULL: none
static const char *first_difference(const unsigned char *a, int64_t a_size, const unsigned char *b, int64_t b_size)
{
    if (a_size < FE__SNAPSHOT_HEADER || b_size < FE__SNAPSHOT_HEADER) return "header";
    int64_t at_a = FE__SNAPSHOT_HEADER, at_b = FE__SNAPSHOT_HEADER;
    section x, y;
    while (next_section(a, a_size, &at_a, &x)) {
        if (!next_section(b, b_size, &at_b, &y) || x.type != y.type) return "sections";
        if (x.type == FE__TABLE_ASSETS) continue;
        if (!are_same(&x, &y)) return x.type < FE__TABLES ? fe__tables[x.type].name : "sections";
    }
    return NULL;
}

static const unsigned char *state_of(const fe__fed_chunk *keyframe, int64_t *out_size)
{
    const unsigned char *at = keyframe->content;
    int64_t front = FE__KEYFRAME_FRONT + (int64_t)FE__ASSET_ENTRY * fe__take_u32(&at);
    *out_size = keyframe->size - front;
    return *out_size < 0 ? NULL : keyframe->content + front;
}

// Of another version they say the same in other bytes
static int32_t is_same_format(const unsigned char *a, const unsigned char *b)
{
    return memcmp(a, b, FE__AT_NUMBER) == 0;
}

fe_result fe__player_compare_keyframe(const char *function, fe_player *p, const fe__fed_chunk *keyframe)
{
    int64_t then_size;
    const unsigned char *then = state_of(keyframe, &then_size);
    if (!then) return FE_ERROR_DATA;
    fe__store_lock(p->world->store);
    int64_t size = fe__snapshot_size(p->world, 0);
    fe__store_unlock(p->world->store);
    unsigned char *now = fe__allocate_scratch(&p->memory, (size_t)size);
    if (!now) return FE_ERROR_MEMORY;
    fe__store_lock(p->world->store);
    fe__snapshot_write(p->world, 0, now);
    fe__store_unlock(p->world->store);
    const char *where = then_size >= FE__SNAPSHOT_HEADER && !is_same_format(now, then)
                            ? NULL
                            : first_difference(now, size, then, then_size);
    fe__release(&p->memory, now, (size_t)size);
    if (!where) return FE_OK;
    fe_divergence what = {.type = FE_DIVERGENCE_KEYFRAME, .field = where, .component = -1};
    return fe__player_differs(function, p, &what, "step %lld: the state differs from the keyframe, first in its %s",
                              (long long)p->step, where);
}
