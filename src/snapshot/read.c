// read.c - see read.h.
#include "snapshot/read.h"

#include "core/bytes.h"
#include "snapshot/delta.h"
#include "snapshot/format.h"

#include <float.h>
#include <stdarg.h>
#include <stdio.h>

int32_t fe__snapshot_refuse(fe__snapshot *s, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(s->sentence, sizeof s->sentence, format, arguments);
    va_end(arguments);
    s->result = FE_ERROR_DATA;
    return 0;
}

int32_t fe__snapshot_fail(fe__snapshot *s, fe_result result)
{
    s->result = result;
    return 0;
}

// ---- header --------------------------------------------------------------------------------------------------------
static int32_t read_header(fe__snapshot *s)
{
    const unsigned char *at = s->bytes + sizeof fe__snapshot_magic;
    if (s->size < FE__SNAPSHOT_HEADER)
        return fe__snapshot_refuse(s, "there are %lld bytes, a header has %d", (long long)s->size, FE__SNAPSHOT_HEADER);
    if (fe__is_delta(s->bytes, s->size))
        return fe__snapshot_refuse(s, "these are a difference: restore them with their base, and save the world");
    if (memcmp(s->bytes, fe__snapshot_magic, sizeof fe__snapshot_magic))
        return fe__snapshot_refuse(s, "these are no bytes of fe_world_save");
    uint32_t major = fe__take_u16(&at);
    (void)fe__take_u16(&at);
    if (major == 0) return fe__snapshot_refuse(s, "byte %d: 0 is no format", FE__AT_MAJOR);
    if (major != FE__SNAPSHOT_MAJOR) {
        fe__snapshot_refuse(s, "format %u is of a %s", (unsigned)major,
                            major > FE__SNAPSHOT_MAJOR ? "newer library" : "library before 1.0");
        return fe__snapshot_fail(s, FE_ERROR_VERSION);
    }
    s->results = fe__take_u32(&at), s->version = fe__take_u32(&at);
    s->number = (int32_t)fe__take_u32(&at);
    uint64_t size = fe__take_u64(&at);
    if (size != (uint64_t)s->size || s->size % 8)
        return fe__snapshot_refuse(s, "byte %d: there are %lld bytes, fe_world_save wrote %llu", FE__AT_SIZE,
                                   (long long)s->size, (unsigned long long)size);
    if (s->number < 1 || s->number > FE_ID_LAST_NUMBER)
        return fe__snapshot_refuse(s, "byte %d: the world's number is %ld, must be 1..%d", FE__AT_NUMBER,
                                   (long)s->number, FE_ID_LAST_NUMBER);
    return 1;
}

// ---- numbers -------------------------------------------------------------------------------------------------------
static double number_at(const fe__field *field, const unsigned char *at)
{
    switch ((fe__field_kind)field->kind) {
    case FE__U8:
        return fe__take_u8(&at);
    case FE__U16:
        return fe__take_u16(&at);
    case FE__I16:
        return (int16_t)fe__take_u16(&at);
    case FE__U32:
        return fe__take_u32(&at);
    case FE__I32:
        return fe__take_i32(&at);
    case FE__F32:
        return (double)fe__take_float(&at);
    default:
        break;
    }
    union {
        uint64_t bits;
        double value;
    } word = {fe__take_u64(&at)};
    return word.value; // of doubles alone: what else has 64 bits may be anything
}

static int32_t is_whole(double x) { return x == (double)(int64_t)x; }

// A NaN is within nothing
static int32_t is_within(const fe__field *field, const unsigned char *at)
{
    const fe__range *range = fe__ranges + field->range;
    double x = number_at(field, at);
    if (!__builtin_isfinite(x)) return 0;
    int32_t must_be_whole = field->range == FE__RANGE_LOCKS || field->range == FE__RANGE_COUNT;
    double high = field->kind == FE__F64 ? DBL_MAX : range->high;
    return x >= (field->kind == FE__F64 ? -DBL_MAX : range->low) && x <= high && (!must_be_whole || is_whole(x));
}

static int32_t check_row(fe__snapshot *s, const fe__table *table, int32_t row, const unsigned char *at)
{
    for (int32_t f = 0; f < table->field_count; ++f) {
        const fe__field *field = table->fields + f;
        for (uint32_t k = 0; k < field->count; ++k, at += fe__kind_size(field->kind)) {
            if (field->range == FE__RANGE_ANY || field->range == FE__RANGE_GROWING || is_within(field, at)) continue;
            return fe__snapshot_refuse(s, "byte %lld, %s, row %ld: %s is %.9g", (long long)(at - s->bytes), table->name,
                                       (long)row, field->name, number_at(field, at));
        }
    }
    return 1;
}

static int32_t check_rows(fe__snapshot *s, const fe__table *table, const fe__snapshot_view *view)
{
    for (int32_t row = 0; row < view->rows; ++row)
        if (!check_row(s, table, row, view->content + (int64_t)row * table->row_size)) return 0;
    return 1;
}

// ---- sections ------------------------------------------------------------------------------------------------------
typedef struct section {
    uint32_t type, version, flags;
    const unsigned char *content;
    int64_t size;
    uint64_t sum;
} section;

// As it is told
static section section_at(const fe__snapshot *s, int64_t at)
{
    const unsigned char *in = s->bytes + at;
    section told = {0};
    told.type = fe__take_u32(&in), told.version = fe__take_u16(&in), told.flags = fe__take_u16(&in);
    told.size = (int64_t)fe__take_u64(&in);
    told.sum = fe__take_u64(&in);
    told.content = in;
    return told;
}

static int32_t read_section(fe__snapshot *s, int64_t at, section *out)
{
    if (s->size - at < FE__SECTION_HEADER) return fe__snapshot_refuse(s, "byte %lld: a section is cut", (long long)at);
    *out = section_at(s, at);
    if (out->size % 8 == 0 && (uint64_t)out->size <= (uint64_t)(s->bytes + s->size - out->content)) return 1;
    return fe__snapshot_refuse(s, "byte %lld: section %u is cut", (long long)at, (unsigned)out->type);
}

static int32_t check_sum(fe__snapshot *s, const section *in, uint64_t sum)
{
    if (in->sum == sum) return 1;
    return fe__snapshot_refuse(s, "byte %lld: section %u was altered",
                               (long long)(in->content - FE__SECTION_HEADER - s->bytes), (unsigned)in->type);
}

static int32_t is_known(const section *in, uint32_t type)
{
    return in->type == type && in->version == 1 && in->flags == 0;
}

// The sum of a section with rows, and whether one of their numbers may be out of its range: of a block at a time, while
// it is near
static uint64_t sum_rows(const fe__table *table, const section *in, const fe__snapshot_view *view, uint32_t *out_doubts)
{
    fe__sum sum = {{0}, 0};
    const unsigned char *at = view->content;
    for (int32_t first = 0; first < view->rows; first += FE__BLOCK) {
        int32_t count = fe__mini(view->rows - first, FE__BLOCK);
        *out_doubts |= table->doubt(at, count);
        at += (int64_t)count * table->row_size;
        int64_t lines = (at - in->content - sum.size) / FE__SUM_LINE * FE__SUM_LINE;
        fe__sum_lines(&sum, in->content + sum.size, lines);
    }
    int64_t summed = sum.size;
    return fe__sum_end(&sum, in->content + summed, in->size - summed);
}

// The rows that its size has room for
static fe__snapshot_view view_of(const section *in, uint32_t number, uint64_t *out_rows)
{
    const unsigned char *at = in->content;
    uint64_t rows = *out_rows = in->size < FE__SECTION_ROWS ? UINT64_MAX : fe__take_u64(&at);
    int32_t fits =
        rows <= INT32_MAX && fe__padded(FE__SECTION_ROWS + (int64_t)rows * fe__tables[number].row_size) == in->size;
    return (fe__snapshot_view){at, fits ? (int32_t)rows : -1, (int32_t)number};
}

static int32_t check_view(fe__snapshot *s, const section *in, uint32_t number, uint64_t rows)
{
    const char *name = fe__tables[number].name;
    int64_t where = in->content - s->bytes;
    if (!is_known(in, number))
        return fe__snapshot_refuse(s, "byte %lld: section %u, version %u stands where %s must be", (long long)where,
                                   (unsigned)in->type, (unsigned)in->version, name);
    if (s->tables[number].rows >= 0) return 1;
    return fe__snapshot_refuse(s, "byte %lld: %s has %lld bytes, which are not those of %llu rows", (long long)where,
                               name, (long long)in->size, (unsigned long long)rows);
}

static int32_t read_table(fe__snapshot *s, const section *in, uint32_t number)
{
    const fe__table *table = fe__tables + number;
    fe__snapshot_view *view = s->tables + number;
    uint32_t doubts = 0;
    uint64_t rows;
    *view = view_of(in, number, &rows);
    return check_sum(s, in, sum_rows(table, in, view, &doubts)) && check_view(s, in, number, rows) &&
           (!doubts || check_rows(s, table, view));
}

static int32_t read_sections(fe__snapshot *s)
{
    const unsigned char *header = s->bytes + FE__AT_SUM;
    uint64_t told = fe__take_u64(&header), sum = 0;
    uint32_t count = fe__take_u32(&header);
    int64_t at = FE__SNAPSHOT_HEADER;
    if (count < FE__TABLES)
        return fe__snapshot_refuse(s, "byte %d: %u sections are too few", FE__AT_SECTIONS, (unsigned)count);
    for (uint32_t i = 0; i < count; ++i) {
        section in = {0};
        if (!read_section(s, at, &in)) return 0;
        if (i < FE__TABLES ? !read_table(s, &in, i) : !check_sum(s, &in, fe__sum_of(in.content, in.size))) return 0;
        if (i >= FE__TABLES && is_known(&in, FE__SECTION_ASSET)) {
            if (!s->asset_count++) s->assets_at = at;
        } else if (i >= FE__TABLES && !(in.flags & FE__SECTION_MAY_SKIP))
            return fe__snapshot_refuse(s, "byte %lld: section %u is unknown", (long long)at, (unsigned)in.type);
        sum = fe__join_sums(sum, in.sum);
        at = in.content - s->bytes + in.size;
    }
    if (at != s->size) return fe__snapshot_refuse(s, "byte %lld: something stands behind the sections", (long long)at);
    if (told != fe__join_sums(sum, fe__header_sum(s->bytes)))
        return fe__snapshot_refuse(s, "byte %d: the sum is not that of the bytes: they were altered", FE__AT_SUM);
    return 1;
}

int32_t fe__snapshot_outline(fe__snapshot *s, const void *bytes, int64_t size)
{
    *s = (fe__snapshot){.bytes = bytes, .size = size};
    if (!read_header(s)) return 0;
    int64_t at = FE__SNAPSHOT_HEADER;
    for (uint32_t i = 0; i < FE__TABLES; ++i) {
        section in = {0};
        uint64_t rows;
        if (!read_section(s, at, &in)) return 0;
        s->tables[i] = view_of(&in, i, &rows);
        if (!check_view(s, &in, i, rows)) return 0;
        at = in.content - s->bytes + in.size;
    }
    return 1;
}

int32_t fe__snapshot_open(fe__snapshot *s, const void *bytes, int64_t size)
{
    *s = (fe__snapshot){.bytes = bytes, .size = size};
    return read_header(s) && read_sections(s);
}

// ---- rows ----------------------------------------------------------------------------------------------------------
void fe__take_row(const fe__snapshot *s, fe__table_number number, int32_t row, void *record)
{
    const fe__table *table = fe__tables + number;
    fe_handle bits = (fe_handle)(uint32_t)s->number << FE_ID_NUMBER_SHIFT;
    table->take(s->tables[number].content + (int64_t)row * table->row_size, bits, record);
}

int32_t fe__listed_slot(const fe__snapshot *s, fe__table_number number, int32_t row)
{
    fe__slot_row entry;
    fe__take_row(s, number, row, &entry);
    return entry.slot;
}

const unsigned char *fe__next_asset_bytes(const fe__snapshot *s, int64_t *at, int64_t *out_size)
{
    while (*at && *at < s->size) {
        section in = section_at(s, *at);
        *at = in.content - s->bytes + in.size;
        *out_size = in.size;
        if (is_known(&in, FE__SECTION_ASSET)) return in.content;
    }
    return NULL;
}
