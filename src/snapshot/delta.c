// delta.c - see delta.h. The difference is made in the room where the snapshot stands, from its front on, behind what
// is read.
#include "snapshot/delta.h"

#include "core/bytes.h"
#include "snapshot/format.h"

#include <string.h>

static const unsigned char magic[8] = {'F', 'E', 'A', 'D', 'E', 'L', 'T', 0x1A};

// Places in the header
enum { AT_NUMBER = 12, AT_BASE = 16, AT_SIZE = 32, AT_RUNS = 40, AT_SUM = 48 };
enum { WORD = 4, WIDE = 8, BITS = 7, MORE = 1 << BITS };

static uint64_t sum_of_base(const unsigned char *base)
{
    const unsigned char *at = base + FE__AT_SUM;
    return fe__take_u64(&at);
}

static uint64_t sum_of_all(const unsigned char *bytes, int64_t runs)
{
    return fe__join_sums(fe__sum_of(bytes, AT_SUM), fe__sum_of(bytes + FE__DELTA_HEADER, runs));
}

// ---- writing -------------------------------------------------------------------------------------------------------
typedef struct run { // words
    int64_t skipped, same, changed, added;
} run;

typedef struct writer {
    unsigned char *at;
    const unsigned char *now, *base; // what is read next. Words that a run holds stand before `now`
    run run;
    int32_t is_full;
} writer;

static unsigned char *put_number(unsigned char *at, uint64_t x)
{
    for (; x >= MORE; x >>= BITS) *at++ = (unsigned char)(x | MORE);
    *at++ = (unsigned char)x;
    return at;
}

static uint32_t word_of(const unsigned char *at) { return fe__take_u32(&at); }

static void end_run(writer *w)
{
    enum { MOST_OF_COUNTS = 40, MOST_OF_WORD = 5 }; // bytes
    const run r = w->run;
    int64_t words = r.changed + r.added;
    w->run = (run){0};
    if (words + r.same == 0) return;
    w->is_full |= w->now - w->at < MOST_OF_COUNTS + MOST_OF_WORD * words;
    if (w->is_full) return;
    uint64_t more = r.skipped || r.added;
    unsigned char *at = put_number(put_number(w->at, 2 * (uint64_t)r.same + more), (uint64_t)r.changed);
    if (more) at = put_number(put_number(at, (uint64_t)r.skipped), (uint64_t)r.added);
    const unsigned char *now = w->now - WORD * words, *base = w->base - WORD * r.changed;
    for (int64_t i = 0; i < r.changed; ++i) at = put_number(at, word_of(now + WORD * i) ^ word_of(base + WORD * i));
    for (int64_t i = r.changed; i < words; ++i) at = put_number(at, word_of(now + WORD * i));
    w->at = at;
}

static void add_same(writer *w, int64_t bytes)
{
    if (bytes == 0) return;
    if (w->run.changed || w->run.added) end_run(w);
    w->run.same += bytes / WORD;
    w->now += bytes, w->base += bytes;
}

static void add_changed(writer *w, int64_t bytes)
{
    if (bytes == 0) return;
    if (w->run.added) end_run(w);
    w->run.changed += bytes / WORD;
    w->now += bytes, w->base += bytes;
}

static void add_added(writer *w, int64_t bytes)
{
    w->run.added += bytes / WORD;
    w->now += bytes;
}

static void add_skipped(writer *w, int64_t bytes)
{
    if (bytes == 0) return;
    if (w->run.same || w->run.changed || w->run.added) end_run(w);
    w->run.skipped += bytes / WORD;
    w->base += bytes;
}

static int64_t count_same(const unsigned char *now, const unsigned char *base, int64_t size)
{
    int64_t at = 0;
    while (at + WIDE <= size && memcmp(now + at, base + at, WIDE) == 0) at += WIDE;
    return at + WORD <= size && memcmp(now + at, base + at, WORD) == 0 ? at + WORD : at;
}

// Up to two words that are the same: one alone is shorter as a changed one
static int64_t count_changed(const unsigned char *now, const unsigned char *base, int64_t size)
{
    int64_t at = 0;
    for (; at < size; at += WORD)
        if (memcmp(now + at, base + at, WORD) == 0 &&
            (at + WIDE > size || memcmp(now + at + WORD, base + at + WORD, WORD) == 0))
            break;
    return at;
}

static void take_both(writer *w, int64_t size)
{
    const unsigned char *end = w->now + size;
    while (w->now < end) {
        add_same(w, count_same(w->now, w->base, end - w->now));
        add_changed(w, count_changed(w->now, w->base, end - w->now));
    }
}

static void take_in_place(writer *w, int64_t now_size, int64_t base_size)
{
    take_both(w, now_size < base_size ? now_size : base_size);
    if (now_size > base_size) add_added(w, now_size - base_size);
    if (base_size > now_size) add_skipped(w, base_size - now_size);
}

// ---- rows: beside those of the same body, shape or pair ------------------------------------------------------------
typedef struct keyed {
    fe__table_number first, last; // tables, of whose rows the first has the key
    const char *field;            // where that begins
    int32_t size;                 // bytes of it
} keyed;

static const keyed keys[] = {
    {FE__TABLE_BODIES, FE__TABLE_DRIFTS, "serial", 8},     {FE__TABLE_SHAPES, FE__TABLE_FORMS, "serial", 8},
    {FE__TABLE_PAIRS, FE__TABLE_FOUND, "shape_a", 8}, // and shape_b
    {FE__TABLE_TOUCHING, FE__TABLE_EXTRAS, "slot", 4},     {FE__TABLE_AWAKE_PAIRS, FE__TABLE_AWAKE_PAIRS, "slot", 4},
    {FE__TABLE_DEFERRALS, FE__TABLE_DEFERRALS, "slot", 4},
};

typedef struct aligned {
    const unsigned char *now, *base; // keys of the first rows
    int32_t now_rows, base_rows, row_size, size;
} aligned;

static int32_t offset_of(const fe__table *table, const char *name)
{
    int32_t offset = 0;
    for (const fe__field *f = table->fields; strcmp(f->name, name); ++f) offset += (int32_t)fe__field_size(f);
    return offset;
}

// 0: rows go by their places
static int32_t align(const fe__snapshot *now, const fe__snapshot *base, fe__table_number table, aligned *out)
{
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        const keyed *k = keys + i;
        if (table < k->first || table > k->last) continue;
        int32_t offset = offset_of(fe__tables + k->first, k->field);
        const fe__snapshot_view *a = now->tables + k->first, *b = base->tables + k->first;
        *out = (aligned){
            a->content + offset, b->content + offset, a->rows, b->rows, fe__tables[k->first].row_size, k->size};
        return now->tables[table].rows == a->rows && base->tables[table].rows == b->rows;
    }
    return 0;
}

static int32_t is_same_key(const aligned *a, int64_t now, int64_t base)
{
    return memcmp(a->now + now * a->row_size, a->base + base * a->row_size, (size_t)a->size) == 0;
}

enum { WINDOW = 32 }; // rows that may be gone, or new, at once

static int32_t comes_later(const aligned *a, int64_t now, int64_t base)
{
    if (base == a->base_rows) return 1;
    for (int64_t i = now + 1; i < a->now_rows && i <= now + WINDOW; ++i)
        if (is_same_key(a, i, base)) return 1;
    return 0;
}

// A row that neither has is taken for one that was replaced
static void take_rows(writer *w, const aligned *a, int64_t row_size)
{
    int64_t i = 0, j = 0;
    while (i < a->now_rows) {
        int64_t n = 0, gone = 0;
        while (i + n < a->now_rows && j + n < a->base_rows && is_same_key(a, i + n, j + n)) ++n;
        take_both(w, n * row_size);
        i += n, j += n;
        if (i == a->now_rows) break;
        while (gone < WINDOW && j + gone < a->base_rows && !is_same_key(a, i, j + gone)) ++gone;
        int64_t is_gone = gone < WINDOW && j + gone < a->base_rows, is_new = is_gone || comes_later(a, i, j);
        int64_t skipped = is_gone ? gone : !is_new && j < a->base_rows;
        add_skipped(w, skipped * row_size);
        j += skipped;
        if (is_gone) continue;
        add_added(w, row_size);
        ++i;
    }
    add_skipped(w, (a->base_rows - j) * row_size);
}

static void take_table(writer *w, const fe__snapshot *now, const fe__snapshot *base, fe__table_number table)
{
    const fe__snapshot_view *a = now->tables + table, *b = base->tables + table;
    int64_t row = fe__tables[table].row_size, front = FE__SECTION_HEADER + FE__SECTION_ROWS;
    int64_t now_size = a->rows * row, base_size = b->rows * row;
    aligned rows;
    take_both(w, front);
    if (align(now, base, table, &rows))
        take_rows(w, &rows, row);
    else
        take_in_place(w, now_size, base_size);
    take_in_place(w, fe__padded(now_size) - now_size, fe__padded(base_size) - base_size);
}

static int64_t close(writer *w, unsigned char *room, int64_t size, uint32_t number, const fe__snapshot *base)
{
    unsigned char *runs = room + FE__DELTA_HEADER;
    int64_t written = w->at - runs, padded = fe__padded(written);
    memset(w->at, 0, (size_t)(padded - written));
    unsigned char *at = fe__put_bytes(room, magic, sizeof magic);
    at = fe__put_u32(fe__put_u16(fe__put_u16(at, FE__DELTA_MAJOR), 0), number);
    at = fe__put_u64(fe__put_u64(at, (uint64_t)base->size), sum_of_base(base->bytes));
    at = fe__put_u64(fe__put_u64(at, (uint64_t)size), (uint64_t)padded);
    fe__put_u64(at, sum_of_all(room, padded));
    return FE__DELTA_HEADER + padded;
}

int64_t fe__delta_write(unsigned char *room, int64_t size, const fe__snapshot *base)
{
    fe__snapshot now;
    const unsigned char *bytes = room + fe__delta_room(size) - size;
    if (!fe__snapshot_outline(&now, bytes, size)) return 0;
    writer w = {.at = room + FE__DELTA_HEADER, .now = bytes, .base = base->bytes};
    uint32_t number = word_of(bytes + FE__AT_NUMBER);
    take_both(&w, FE__SNAPSHOT_HEADER);
    for (int32_t i = 0; i < FE__TABLES && !w.is_full; ++i) take_table(&w, &now, base, (fe__table_number)i);
    if (!w.is_full) take_in_place(&w, bytes + size - w.now, base->bytes + base->size - w.base);
    end_run(&w);
    return w.is_full ? 0 : close(&w, room, size, number, base);
}

// ---- reading -------------------------------------------------------------------------------------------------------
int32_t fe__is_delta(const void *bytes, int64_t size)
{
    return size >= (int64_t)sizeof magic && memcmp(bytes, magic, sizeof magic) == 0;
}

int64_t fe__delta_open(fe__snapshot *s, const void *bytes, int64_t size, const void *base, int64_t base_size)
{
    enum { GROWTH = 4 }; // bytes that one of the difference may become
    const unsigned char *at = (const unsigned char *)bytes + sizeof magic;
    if (size < FE__DELTA_HEADER) return fe__snapshot_refuse(s, "the difference is cut");
    uint32_t major = fe__take_u16(&at);
    if (major == 0) return fe__snapshot_refuse(s, "there is no format 0 of a difference");
    if (major > FE__DELTA_MAJOR) {
        fe__snapshot_refuse(s, "format %u of a difference is of a newer library", (unsigned)major);
        return fe__snapshot_fail(s, FE_ERROR_VERSION);
    }
    at = (const unsigned char *)bytes + AT_BASE;
    uint64_t of_size = fe__take_u64(&at), of_sum = fe__take_u64(&at), whole = fe__take_u64(&at),
             runs = fe__take_u64(&at), sum = fe__take_u64(&at);
    if (runs != (uint64_t)(size - FE__DELTA_HEADER) || runs % 8)
        return fe__snapshot_refuse(s, "byte %d: %lld bytes follow, fe_world_save wrote %llu", AT_RUNS,
                                   (long long)(size - FE__DELTA_HEADER), (unsigned long long)runs);
    if (sum != sum_of_all(bytes, (int64_t)runs)) return fe__snapshot_refuse(s, "the difference was altered");
    if (!base || fe__is_delta(base, base_size))
        return fe__snapshot_refuse(s, "a difference needs the whole snapshot it was saved against: base");
    if (of_size != (uint64_t)base_size || base_size < FE__SNAPSHOT_HEADER || of_sum != sum_of_base(base))
        return fe__snapshot_refuse(s, "byte %d: the difference is to another base", AT_BASE);
    uint64_t most = of_size + GROWTH * runs;
    if (whole % 8 || whole < FE__SNAPSHOT_HEADER || whole > most)
        return fe__snapshot_refuse(s, "byte %d: %llu bytes come of no such difference", AT_SIZE,
                                   (unsigned long long)whole);
    if (whole > PTRDIFF_MAX) return fe__snapshot_fail(s, FE_ERROR_MEMORY);
    return (int64_t)whole;
}

typedef struct reader {
    const unsigned char *at, *end, *base, *base_end;
    unsigned char *out, *out_end;
    int32_t is_sound;
} reader;

static uint64_t take_number(reader *r)
{
    enum { MOST = 56 }; // bits before the last byte
    uint64_t x = 0;
    for (int32_t shift = 0; shift <= MOST && r->at < r->end; shift += BITS) {
        unsigned char byte = *r->at++;
        x |= (uint64_t)(byte & (MORE - 1)) << shift;
        if (!(byte & MORE)) return x;
    }
    r->is_sound = 0;
    return 0;
}

static uint32_t take_word(reader *r)
{
    uint64_t word = take_number(r);
    r->is_sound &= word <= UINT32_MAX;
    return (uint32_t)word;
}

// Words that are to come fit
static int32_t fit(const unsigned char *at, const unsigned char *end, uint64_t words)
{
    return words <= (uint64_t)(end - at) / WORD;
}

static void take_run(reader *r)
{
    uint64_t same = take_number(r), changed = take_number(r), more = same & 1;
    uint64_t skipped = more ? take_number(r) : 0, added = more ? take_number(r) : 0;
    same >>= 1;
    r->is_sound &= fit(r->base, r->base_end, skipped) && same + changed + added > 0;
    if (!r->is_sound) return;
    r->base += WORD * skipped;
    r->is_sound = same <= INT64_MAX / 4 && changed <= INT64_MAX / 4 && added <= INT64_MAX / 4 &&
                  fit(r->base, r->base_end, same + changed) && fit(r->out, r->out_end, same + changed + added);
    if (!r->is_sound) return;
    memcpy(r->out, r->base, (size_t)(WORD * same));
    r->out += WORD * same, r->base += WORD * same;
    for (; changed && r->is_sound; --changed, r->base += WORD)
        r->out = fe__put_u32(r->out, take_word(r) ^ word_of(r->base));
    for (; added && r->is_sound; --added) r->out = fe__put_u32(r->out, take_word(r));
}

int32_t fe__delta_apply(fe__snapshot *s, const void *bytes, int64_t size, const void *base, int64_t base_size,
                        unsigned char *out, int64_t out_size)
{
    const unsigned char *first = bytes, *from = base;
    reader r = {first + FE__DELTA_HEADER, first + size, from, from + base_size, out, out + out_size, 1};
    while (r.is_sound && r.out < r.out_end) take_run(&r);
    for (; r.at < r.end; ++r.at) r.is_sound &= *r.at == 0;
    // no sum counts the world's number: a base of the same state may have another
    fe__put_u32(out + FE__AT_NUMBER, word_of(first + AT_NUMBER));
    return r.is_sound ||
           fe__snapshot_refuse(s, "the runs of the difference do not make %lld bytes", (long long)out_size);
}
