// write.c - see write.h. A table is written in blocks of rows: their records are found, then copied.
#include "snapshot/write.h"

#include "core/bytes.h"
#include "snapshot/rows.h"
#include "snapshot/format.h"
#include "store/asset_bytes.h"

#include <string.h>

const unsigned char fe__snapshot_magic[8] = {'F', 'E', 'A', 'S', 'N', 'A', 'P', 0x1A};

uint64_t fe__header_sum(const unsigned char *header)
{
    fe__hash hash = fe__hash_begin();
    const unsigned char *at = header;
    fe__hash_u64(&hash, fe__take_u64(&at));
    fe__hash_u64(&hash, fe__take_u64(&at));
    fe__hash_u64(&hash, fe__take_u32(&at)); // the number follows
    at = header + FE__AT_SIZE;
    fe__hash_u64(&hash, fe__take_u64(&at));
    at = header + FE__AT_SECTIONS;
    fe__hash_u64(&hash, fe__take_u64(&at));
    return fe__hash_end(&hash);
}

// ---- sections ------------------------------------------------------------------------------------------------------
typedef struct writer {
    unsigned char *at;
    uint64_t sum; // of the sections so far
    uint32_t sections;
} writer;

// What it holds is written behind its header, and padded
static void close_section(writer *w, uint32_t type, int64_t size, uint64_t sum)
{
    unsigned char *at = fe__put_u16(fe__put_u16(fe__put_u32(w->at, type), 1), 0);
    fe__put_u64(fe__put_u64(at, (uint64_t)size), sum);
    w->at += FE__SECTION_HEADER + size;
    w->sum = fe__join_sums(w->sum, sum);
    ++w->sections;
}

static int64_t pad(unsigned char *content, int64_t size)
{
    int64_t whole = fe__padded(size);
    memset(content + size, 0, (size_t)(whole - size));
    return whole;
}

// ---- tables, those with the same rows together ----------------------------------------------------------------------
typedef struct rows_writer {
    const fe__table *table;
    unsigned char *content, *at; // of the section; of the next row
    int32_t rows;
    fe__sum sum; // of whole lines, as they are written: they are still near
} rows_writer;

static void put_block(rows_writer *r, const fe__rows_block *block, int32_t rows)
{
    r->table->put(block, rows, r->at);
    r->at += (int64_t)rows * r->table->row_size;
    int64_t lines = (r->at - r->content - r->sum.size) / FE__SUM_LINE * FE__SUM_LINE;
    fe__sum_lines(&r->sum, r->content + r->sum.size, lines);
}

static unsigned char *open_rows(rows_writer *r, const fe_world *world, const fe__table *table, unsigned char *header)
{
    *r = (rows_writer){.table = table, .content = header + FE__SECTION_HEADER, .rows = table->count(world)};
    r->at = fe__put_u64(r->content, (uint64_t)r->rows);
    return header + fe__section_size(table, r->rows);
}

static void close_rows(writer *w, rows_writer *r)
{
    int64_t size = pad(r->content, r->at - r->content), summed = r->sum.size;
    uint64_t sum = fe__sum_end(&r->sum, r->content + summed, size - summed);
    close_section(w, (uint32_t)(r->table - fe__tables), size, sum);
}

// The table and those beside it. Returns the table behind them
static int32_t write_tables(writer *w, const fe_world *world, int32_t first)
{
    enum { MOST = 4 };
    rows_writer writers[MOST];
    fe__rows_block block;
    unsigned char *at = w->at;
    int32_t count = 0;
    do at = open_rows(writers + count, world, fe__tables + first + count, at);
    while (++count < MOST && first + count < FE__TABLES && fe__tables[first + count].is_beside);
    for (int32_t row = 0, place = -1; row < writers->rows; row += FE__BLOCK) {
        int32_t rows = fe__mini(writers->rows - row, FE__BLOCK);
        place = writers->table->gather(world, place, rows, &block);
        put_block(writers, &block, rows);
        for (rows_writer *r = writers + 1; r < writers + count; ++r) {
            if (r->rows == 0) continue;
            r->table->find(world, rows, &block);
            put_block(r, &block, rows);
        }
    }
    for (int32_t i = 0; i < count; ++i) close_rows(w, writers + i);
    return first + count;
}

// ---- contents of assets ---------------------------------------------------------------------------------------------
// The asset at a place in the table of uses, unless an earlier one there is of the same
static const fe__asset *asset_to_write(const fe_world *world, int32_t place)
{
    const fe__asset *asset = fe__store_parent(world->store, world->uses[place].asset);
    for (int32_t i = 0; i < place; ++i)
        if (fe__store_parent(world->store, world->uses[i].asset) == asset) return NULL;
    return asset;
}

static int64_t assets_size(const fe_world *world)
{
    int64_t size = 0;
    for (int32_t i = 0; i < world->use_count; ++i) {
        const fe__asset *asset = asset_to_write(world, i);
        if (asset) size += FE__SECTION_HEADER + fe__asset_bytes(world->store, asset);
    }
    return size;
}

// By the slots of their first users: the order of the store's own numbers is no state
static void write_assets(writer *w, const fe_world *world)
{
    for (int32_t row = 0, shape = -1; row < world->use_count; ++row) {
        shape = fe__next_asset_user(world, shape);
        const fe__asset *asset = fe__store_parent(world->store, world->shapes[shape].form.field);
        int32_t is_first = 1;
        for (int32_t i = 0, other = -1; i < row && is_first; ++i) {
            other = fe__next_asset_user(world, other);
            is_first = fe__store_parent(world->store, world->shapes[other].form.field) != asset;
        }
        if (!is_first) continue;
        int64_t size = fe__asset_bytes(world->store, asset);
        fe__asset_write(world->store, asset, w->at + FE__SECTION_HEADER);
        fe__asset_seal(w->at + FE__SECTION_HEADER, size);
        size = pad(w->at + FE__SECTION_HEADER, size);
        close_section(w, FE__SECTION_ASSET, size, fe__sum_of(w->at + FE__SECTION_HEADER, size));
    }
}

// ---- the whole -----------------------------------------------------------------------------------------------------
int64_t fe__snapshot_size(const fe_world *world, int32_t with_assets)
{
    int64_t size = FE__SNAPSHOT_HEADER;
    for (int32_t i = 0; i < FE__TABLES; ++i) size += fe__section_size(fe__tables + i, fe__tables[i].count(world));
    return with_assets ? size + assets_size(world) : size;
}

static void write_header(const writer *w, unsigned char *out, int32_t number)
{
    unsigned char *at = fe__put_bytes(out, fe__snapshot_magic, sizeof fe__snapshot_magic);
    at = fe__put_u16(fe__put_u16(at, FE__SNAPSHOT_MAJOR), FE__SNAPSHOT_MINOR);
    at = fe__put_u32(fe__put_u32(at, FE__RESULTS), FE_VERSION_MAJOR << 16 | FE_VERSION_MINOR << 8 | FE_VERSION_PATCH);
    at = fe__put_u64(fe__put_u32(at, (uint32_t)number), (uint64_t)(w->at - out));
    fe__put_u32(fe__put_u32(at + sizeof(uint64_t), w->sections), 0);
    fe__put_u64(at, fe__join_sums(w->sum, fe__header_sum(out)));
}

void fe__snapshot_write(const fe_world *world, int32_t with_assets, unsigned char *out)
{
    writer w = {.at = out + FE__SNAPSHOT_HEADER};
    for (int32_t i = 0; i < FE__TABLES;) i = write_tables(&w, world, i);
    if (with_assets) write_assets(&w, world);
    write_header(&w, out, world->number);
}
