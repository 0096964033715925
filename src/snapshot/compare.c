// compare.c - see compare.h. Links to a slot that a snapshot does not have lead nowhere: what is told is told by what
// is there, and nothing is refused that a restore would refuse.
#include "snapshot/compare.h"

#include "core/sort.h"
#include "world/joint.h"
#include "world/joint_parts.h"
#include "world/contact.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// ---- entries: what has a serial, and where its rows are -------------------------------------------------------------
enum { ROW, SECOND_ROW, THIRD_ROW, FOURTH_ROW, ROWS }; // of an entry: in the tables of its kind, -1: none

typedef struct entry {
    uint64_t key[2];
    fe_handle handle[2];
    int32_t rows[ROWS];
    int32_t type; // of a joint
} entry;

enum { BODIES, SHAPES, JOINTS, PAIRS, KINDS };

typedef struct side {
    const fe__snapshot *snapshot;
    fe__memory *memory;
    entry *entries[KINDS];
    int32_t counts[KINDS];
    int32_t *shape_rows; // of each slot of shapes, -1: none
} side;

static size_t sort_room(int32_t count) { return 2 * sizeof(fe__sort_item) * (size_t)count; }

static void sort_by(entry *entries, fe__sort_item *items, int32_t count, int32_t part)
{
    for (int32_t i = 0; i < count; ++i) items[i].key = entries[items[i].value].key[part];
    fe__sort_keys(items, count, items + count);
}

// By the first key, then by the second
static int32_t sort_entries(side *s, int32_t kind)
{
    int32_t count = s->counts[kind];
    if (count == 0) return 1;
    size_t size = sizeof(entry) * (size_t)count;
    fe__sort_item *items = fe__allocate_scratch(s->memory, sort_room(count));
    entry *sorted = fe__allocate_scratch(s->memory, size);
    for (int32_t i = 0; i < count && items && sorted; ++i) items[i] = (fe__sort_item){0, i, 0};
    if (items && sorted) {
        sort_by(s->entries[kind], items, count, 1);
        sort_by(s->entries[kind], items, count, 0);
        for (int32_t i = 0; i < count; ++i) sorted[i] = s->entries[kind][items[i].value];
        memcpy(s->entries[kind], sorted, size);
    }
    int32_t done = items && sorted;
    fe__release(s->memory, items, sort_room(count));
    fe__release(s->memory, sorted, size);
    return done;
}

static entry *open_entries(side *s, int32_t kind, fe__table_number table)
{
    int32_t count = s->counts[kind] = fe__rows_of(s->snapshot, table);
    s->entries[kind] = fe__allocate(s->memory, sizeof(entry) * (size_t)(count + 1));
    for (int32_t i = 0; i < count && s->entries[kind]; ++i)
        s->entries[kind][i].rows[ROW] = i, s->entries[kind][i].rows[SECOND_ROW] = s->entries[kind][i].rows[THIRD_ROW] =
                                               s->entries[kind][i].rows[FOURTH_ROW] = -1;
    return s->entries[kind];
}

// The slots in use, in their order, are those of the rows
static int32_t next_used(const fe__snapshot *s, fe__table_number slots, int32_t slot, fe__id_slot *out)
{
    for (++slot; slot < fe__rows_of(s, slots); ++slot) {
        fe__take_row(s, slots, slot, out);
        if (out->next == FE_ID_ALIVE || (out->next == FE_ID_HIDDEN && slots == FE__TABLE_SHAPE_SLOTS)) break;
    }
    return slot;
}

static fe_handle handle_of(const fe__snapshot *s, fe__kind kind, fe__id_slot slot, int32_t place)
{
    return slot.next == FE_ID_ALIVE ? fe__id_make((int32_t)kind, s->number, slot.generation, place) : 0;
}

static int32_t open_bodies(side *s)
{
    entry *e = open_entries(s, BODIES, FE__TABLE_BODIES);
    for (int32_t i = 0, slot = -1; e && i < s->counts[BODIES]; ++i) {
        fe__id_slot id = {0};
        fe__body body;
        slot = next_used(s->snapshot, FE__TABLE_BODY_SLOTS, slot, &id);
        fe__take_row(s->snapshot, FE__TABLE_BODIES, i, &body);
        e[i].key[0] = body.serial;
        e[i].handle[0] = handle_of(s->snapshot, FE_KIND_BODY, id, slot);
    }
    return e != NULL;
}

static int32_t open_shapes(side *s)
{
    entry *e = open_entries(s, SHAPES, FE__TABLE_SHAPES);
    int32_t slots = fe__rows_of(s->snapshot, FE__TABLE_SHAPE_SLOTS);
    s->shape_rows = fe__allocate(s->memory, sizeof *s->shape_rows * (size_t)(slots + 1));
    if (!e || !s->shape_rows) return 0;
    for (int32_t i = 0; i < slots; ++i) s->shape_rows[i] = -1;
    for (int32_t i = 0, slot = -1; i < s->counts[SHAPES]; ++i) {
        fe__id_slot id = {0};
        fe__shape shape;
        slot = next_used(s->snapshot, FE__TABLE_SHAPE_SLOTS, slot, &id);
        fe__take_row(s->snapshot, FE__TABLE_SHAPES, i, &shape);
        e[i].key[0] = shape.serial;
        int32_t named = id.next == FE_ID_HIDDEN ? shape.parent : slot; // a part goes by its compound
        if (named != slot && named >= 0 && named < slots) fe__take_row(s->snapshot, FE__TABLE_SHAPE_SLOTS, named, &id);
        e[i].handle[0] = handle_of(s->snapshot, FE_KIND_SHAPE, id, named);
        if (slot < slots) s->shape_rows[slot] = i;
    }
    return 1;
}

// What a type has beyond others stands in a table of its own, as many rows as there are joints of that type
static fe__table_number settings_of(int32_t type) { return (fe__table_number)(FE__TABLE_DISTANCE_JOINTS + type - 1); }

static int32_t has_axes(const side *s, int32_t type, int32_t row)
{
    fe__joint_any def;
    fe__joint_plan plan;
    uint32_t words[FE__SETTINGS_WORDS] = {0};
    memset(&def, 0, sizeof def);
    if (row >= fe__rows_of(s->snapshot, settings_of(type))) return 0;
    fe__take_row(s->snapshot, settings_of(type), row, words);
    memcpy((unsigned char *)&def + FE__JOINT_FRONT, words, sizeof words);
    fe__joint_make_plan(type, &def, &plan);
    return fe__joint_needs_axes(&plan);
}

static int32_t open_joints(side *s)
{
    const fe__snapshot *in = s->snapshot;
    entry *e = open_entries(s, JOINTS, FE__TABLE_JOINTS);
    int32_t taken[FE__JOINT_TYPES] = {0}, axes = 0;
    for (int32_t i = 0, slot = -1; e && i < s->counts[JOINTS]; ++i) {
        fe__id_slot id = {0};
        fe__joint_record joint;
        fe__joint_frame frame = {.serial = 0};
        slot = next_used(in, FE__TABLE_JOINT_SLOTS, slot, &id);
        fe__take_row(in, FE__TABLE_JOINTS, i, &joint);
        if (i < fe__rows_of(in, FE__TABLE_JOINT_FRAMES)) fe__take_row(in, FE__TABLE_JOINT_FRAMES, i, &frame);
        e[i].key[0] = frame.serial;
        e[i].handle[0] = handle_of(in, FE_KIND_JOINT, id, slot);
        e[i].type = joint.type;
        e[i].rows[SECOND_ROW] = taken[joint.type]++;
        if (has_axes(s, joint.type, e[i].rows[SECOND_ROW])) e[i].rows[THIRD_ROW] = axes++;
    }
    return e != NULL;
}

// ---- pairs: rows are those of the slots that are neither free nor owed ----------------------------------------------
static void mark(const side *s, fe__table_number table, int32_t *row_of, int32_t limit)
{
    fe__owed_row row; // begins as an entry of a list does
    for (int32_t i = 0; i < fe__rows_of(s->snapshot, table); ++i) {
        fe__take_row(s->snapshot, table, i, &row);
        if (row.slot < limit) row_of[row.slot] = -1;
    }
}

static void name_pair(const side *s, entry *e, int32_t row)
{
    fe__pair pair;
    fe__take_row(s->snapshot, FE__TABLE_PAIRS, row, &pair);
    const int32_t shapes[2] = {pair.shape_a, pair.shape_b};
    for (int k = 0; k < 2; ++k) {
        int32_t known = shapes[k] < fe__rows_of(s->snapshot, FE__TABLE_SHAPE_SLOTS) ? s->shape_rows[shapes[k]] : -1;
        if (known < 0) continue;
        e->key[k] = s->entries[SHAPES][known].key[0];
        e->handle[k] = s->entries[SHAPES][known].handle[0];
    }
    e->key[1] |= (uint64_t)(pair.flags >> FE__PAIR_NUMBER_SHIFT) << FE__PATCH_SHIFT;
}

static void place_second_rows(const side *s, fe__table_number table, int32_t which, const int32_t *row_of,
                              int32_t limit)
{
    fe__deferral_row row; // begins as an entry of a list does
    for (int32_t i = 0; i < fe__rows_of(s->snapshot, table); ++i) {
        fe__take_row(s->snapshot, table, i, &row);
        if (row.slot < limit && row_of[row.slot] >= 0) s->entries[PAIRS][row_of[row.slot]].rows[which] = i;
    }
}

static int32_t open_pairs(side *s)
{
    const fe__snapshot *in = s->snapshot;
    entry *e = open_entries(s, PAIRS, FE__TABLE_PAIRS);
    int32_t limit = 1 + s->counts[PAIRS] + fe__rows_of(in, FE__TABLE_FREE_PAIRS) + fe__rows_of(in, FE__TABLE_OWED);
    size_t size = sizeof(int32_t) * (size_t)limit;
    int32_t *row_of = fe__allocate(s->memory, size);
    if (row_of && e) {
        mark(s, FE__TABLE_FREE_PAIRS, row_of, limit);
        mark(s, FE__TABLE_OWED, row_of, limit);
        row_of[0] = -1;
        int32_t row = 0;
        for (int32_t slot = 1; slot < limit; ++slot)
            if (row_of[slot] >= 0) row_of[slot] = row < s->counts[PAIRS] ? row++ : -1;
        for (int32_t i = 0; i < s->counts[PAIRS]; ++i) name_pair(s, e + i, i);
        place_second_rows(s, FE__TABLE_TOUCHING, SECOND_ROW, row_of, limit);
        place_second_rows(s, FE__TABLE_DEFERRALS, THIRD_ROW, row_of, limit);
        place_second_rows(s, FE__TABLE_PATCHES, FOURTH_ROW, row_of, limit);
    }
    fe__release(s->memory, row_of, size);
    return row_of && e;
}

static int32_t open_side(side *s, const fe__snapshot *snapshot, fe__memory *memory)
{
    *s = (side){.snapshot = snapshot, .memory = memory};
    int32_t done = open_bodies(s) && open_shapes(s) && open_joints(s) && open_pairs(s);
    for (int32_t kind = 0; kind < KINDS && done; ++kind) done = sort_entries(s, kind);
    return done;
}

static void close_side(side *s)
{
    for (int32_t kind = 0; kind < KINDS; ++kind)
        if (s->entries[kind]) fe__release(s->memory, s->entries[kind], sizeof(entry) * (size_t)(s->counts[kind] + 1));
    size_t slots = (size_t)fe__rows_of(s->snapshot, FE__TABLE_SHAPE_SLOTS);
    if (s->shape_rows) fe__release(s->memory, s->shape_rows, sizeof *s->shape_rows * (slots + 1));
}

// ---- one row against another
// ----------------------------------------------------------------------------------------- Two passes: first values,
// then where things lie
static int32_t is_of_pass(const fe__field *field, int32_t pass)
{
    int32_t range = field->range;
    int32_t is_place = range == FE__RANGE_LINK || range == FE__RANGE_INDEX || range == FE__RANGE_SLOT_STATE ||
                       range == FE__RANGE_GROWING;
    return is_place == pass;
}

static void write_number(char *out, size_t room, const fe__field *field, const unsigned char *at)
{
    union {
        uint8_t u8;
        uint16_t u16;
        int16_t i16;
        uint32_t u32;
        int32_t i32;
        uint64_t u64;
        int64_t i64;
        float f32;
        double f64;
    } x = {.u64 = 0};
    memcpy(&x, at, fe__kind_size(field->kind));
    switch ((fe__field_kind)field->kind) {
    case FE__U8:
        snprintf(out, room, "%u", (unsigned)x.u8);
        break;
    case FE__U16:
        snprintf(out, room, "%u", (unsigned)x.u16);
        break;
    case FE__I16:
        snprintf(out, room, "%d", (int)x.i16);
        break;
    case FE__U32: // bits
        snprintf(out, room, "0x%" PRIx32, x.u32);
        break;
    case FE__I32:
        snprintf(out, room, "%" PRId32, x.i32);
        break;
    case FE__F32:
        snprintf(out, room, "%.9g", (double)x.f32);
        break;
    case FE__I64:
        snprintf(out, room, "%" PRId64, x.i64);
        break;
    case FE__F64:
        snprintf(out, room, "%.17g", x.f64);
        break;
    default:
        snprintf(out, room, "%" PRIu64, x.u64);
    }
}

static int32_t compare_fields(const fe__table *table, int32_t pass, const unsigned char *a, const unsigned char *b,
                              fe_difference *out)
{
    for (int32_t f = 0; f < table->field_count; ++f) {
        const fe__field *field = table->fields + f;
        uint32_t size = fe__kind_size(field->kind);
        const unsigned char *x = a + field->offset, *y = b + field->offset;
        if (!is_of_pass(field, pass) || memcmp(x, y, fe__field_size(field)) == 0) continue;
        int32_t k = 0;
        for (; memcmp(x, y, size) == 0; x += size, y += size) ++k;
        out->element = k;
        snprintf(out->field, sizeof out->field, "%s", field->name);
        write_number(out->a, sizeof out->a, field, x);
        write_number(out->b, sizeof out->b, field, y);
        return 1;
    }
    return 0;
}

typedef struct comparison {
    side a, b;
    int32_t pass;
    fe_difference *out;
} comparison;

static int32_t tell_missing(const comparison *c, const char *field, int32_t in_a)
{
    snprintf(c->out->field, sizeof c->out->field, "%s", field);
    snprintf(c->out->a, sizeof c->out->a, "%s", in_a ? "yes" : "no");
    snprintf(c->out->b, sizeof c->out->b, "%s", in_a ? "no" : "yes");
    return 1;
}

// Rows beyond those of the table are not there
static int32_t compare_rows(const comparison *c, fe__table_number table, int32_t row_a, int32_t row_b)
{
    _Alignas(FE__RECORD_ALIGNMENT) unsigned char a[FE__LARGEST_RECORD], b[FE__LARGEST_RECORD];
    int32_t in_a = row_a >= 0 && row_a < fe__rows_of(c->a.snapshot, table);
    int32_t in_b = row_b >= 0 && row_b < fe__rows_of(c->b.snapshot, table);
    if (in_a != in_b) return tell_missing(c, fe__tables[table].name, in_a);
    if (!in_a) return 0;
    const unsigned char *bytes_a = fe__row_at(c->a.snapshot, table, row_a);
    if (memcmp(bytes_a, fe__row_at(c->b.snapshot, table, row_b), (size_t)fe__tables[table].row_size) == 0) return 0;
    fe__take_row(c->a.snapshot, table, row_a, a);
    fe__take_row(c->b.snapshot, table, row_b, b);
    return compare_fields(fe__tables + table, c->pass, a, b, c->out);
}

// ---- kinds ----------------------------------------------------------------------------------------------------------
typedef struct kind_tables {
    const char *name;
    struct {
        int32_t table, which; // which of an entry's rows
    } tables[8];
    int32_t count;
} kind_tables;

enum { OF_TYPE = -1 }; // the table of a joint's type

static const kind_tables kinds[KINDS] = {
    [BODIES] = {"body", {{FE__TABLE_BODIES, ROW}, {FE__TABLE_DRIFTS, ROW}}, 2},
    [SHAPES] = {"shape", {{FE__TABLE_SHAPES, ROW}, {FE__TABLE_FORMS, ROW}}, 2},
    [JOINTS] = {"joint",
                {{FE__TABLE_JOINTS, ROW},
                 {OF_TYPE, SECOND_ROW},
                 {FE__TABLE_JOINT_ANCHORS, ROW},
                 {FE__TABLE_JOINT_FRAMES, ROW},
                 {FE__TABLE_JOINT_REACTIONS, ROW},
                 {FE__TABLE_JOINT_AXES, THIRD_ROW}},
                6},
    [PAIRS] = {"pair",
               {{FE__TABLE_PAIRS, ROW},
                {FE__TABLE_FOUND, ROW},
                {FE__TABLE_TOUCHING, SECOND_ROW},
                {FE__TABLE_POINTS, SECOND_ROW},
                {FE__TABLE_FEATURES, SECOND_ROW},
                {FE__TABLE_EXTRAS, SECOND_ROW},
                {FE__TABLE_DEFERRALS, THIRD_ROW},
                {FE__TABLE_PATCHES, FOURTH_ROW}},
               8},
};

static int32_t name_entry(const comparison *c, const kind_tables *kind, const entry *e)
{
    c->out->handle = e->handle[0], c->out->other = e->handle[1];
    snprintf(c->out->kind, sizeof c->out->kind, "%s", kind->name);
    return 1;
}

static int32_t compare_entries(const comparison *c, const kind_tables *kind, const entry *a, const entry *b)
{
    for (int32_t i = 0; i < kind->count; ++i) {
        int32_t table = kind->tables[i].table, which = kind->tables[i].which;
        if (table == OF_TYPE && a->type != b->type) continue; // told in the first pass
        if (table == OF_TYPE) table = (int32_t)settings_of(a->type);
        if (compare_rows(c, (fe__table_number)table, a->rows[which], b->rows[which])) return name_entry(c, kind, a);
    }
    return 0;
}

static int32_t order_of(const entry *a, const entry *b)
{
    for (int k = 0; k < 2; ++k)
        if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
    return 0;
}

static int32_t compare_kind(const comparison *c, int32_t kind)
{
    int32_t i = 0, j = 0, count_a = c->a.counts[kind], count_b = c->b.counts[kind];
    while (i < count_a || j < count_b) {
        const entry *a = c->a.entries[kind] + i, *b = c->b.entries[kind] + j;
        int32_t order = i == count_a ? 1 : j == count_b ? -1 : order_of(a, b);
        if (order) {
            tell_missing(c, "there", order < 0);
            return name_entry(c, kinds + kind, order < 0 ? a : b);
        }
        if (compare_entries(c, kinds + kind, a, b)) return 1;
        ++i, ++j;
    }
    return 0;
}

// ---- lists: row by row
// -----------------------------------------------------------------------------------------------
static int32_t compare_list(const comparison *c, fe__table_number table)
{
    int32_t count_a = fe__rows_of(c->a.snapshot, table), count_b = fe__rows_of(c->b.snapshot, table);
    for (int32_t i = 0; i < count_a || i < count_b; ++i) {
        int32_t differs =
            i >= count_a || i >= count_b ? tell_missing(c, "there", i < count_a) : compare_rows(c, table, i, i);
        if (!differs) continue;
        c->out->index = i;
        snprintf(c->out->kind, sizeof c->out->kind, "%s", fe__tables[table].name);
        return 1;
    }
    return 0;
}

// What the next step does depends on these; entries of theirs that are slots come in the second pass alone
static const fe__table_number lists[] = {FE__TABLE_ASSETS,      FE__TABLE_IGNORES,      FE__TABLE_ENCOUNTERS,
                                         FE__TABLE_OWED,        FE__TABLE_PAIR_EVENTS,  FE__TABLE_BODY_EVENTS,
                                         FE__TABLE_HIT_EVENTS,  FE__TABLE_JOINT_EVENTS, FE__TABLE_AWAKE_BODIES,
                                         FE__TABLE_AWAKE_PAIRS, FE__TABLE_AWAKE_JOINTS, FE__TABLE_PLANES,
                                         FE__TABLE_BODY_SLOTS,  FE__TABLE_SHAPE_SLOTS,  FE__TABLE_JOINT_SLOTS,
                                         FE__TABLE_FREE_PAIRS,  FE__TABLE_FREE_IGNORES, FE__TABLE_FREE_ENCOUNTERS};

static int32_t compare_pass(comparison *c, int32_t pass)
{
    c->pass = pass;
    if (compare_list(c, FE__TABLE_WORLD)) return 1;
    for (int32_t kind = 0; kind < KINDS; ++kind)
        if (compare_kind(c, kind)) return 1;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i)
        if (compare_list(c, lists[i])) return 1;
    return 0;
}

int32_t fe__snapshot_compare(const fe__snapshot *a, const fe__snapshot *b, fe__memory *memory, fe_difference *out)
{
    comparison c = {.out = out};
    *out = (fe_difference){.index = 0};
    int32_t opened = open_side(&c.a, a, memory) & open_side(&c.b, b, memory);
    int32_t found = opened ? compare_pass(&c, 0) || compare_pass(&c, 1) : FE_ERROR_MEMORY;
    close_side(&c.a);
    close_side(&c.b);
    return found;
}
