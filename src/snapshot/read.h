// read.h - bytes that may be a snapshot: header and sums, sections, and each number within its range. What the numbers
// mean beside each other is checked where the world is built (restore.h).
#ifndef FE_SNAPSHOT_READ_H
#define FE_SNAPSHOT_READ_H
#include "snapshot/format.h"

enum { FE__SENTENCE = 200 };

typedef struct fe__snapshot_view { // a table
    const unsigned char *content;  // its rows
    int32_t rows;
    int32_t section; // offset of its header in the bytes
} fe__snapshot_view;

typedef struct fe__snapshot {
    const unsigned char *bytes;
    int64_t size;
    uint32_t results, version;
    int32_t number;
    fe__snapshot_view tables[FE__TABLES];
    int64_t assets_at; // of the first section with an asset, 0: none
    int32_t asset_count;
    fe_result result; // FE_OK, or why it was refused
    char sentence[FE__SENTENCE];
} fe__snapshot;

// 0: refused, with a sentence
int32_t fe__snapshot_open(fe__snapshot *snapshot, const void *bytes, int64_t size);
// Its sections and how many rows each table has, and no more: neither sums nor numbers are looked at. 0: refused
int32_t fe__snapshot_outline(fe__snapshot *snapshot, const void *bytes, int64_t size);
// Keeps the sentence, returns 0
int32_t fe__snapshot_refuse(fe__snapshot *snapshot, const char *format, ...) __attribute__((format(printf, 2, 3)));
int32_t fe__snapshot_fail(fe__snapshot *snapshot, fe_result result); // memory or a limit: no sentence; returns 0

// The bytes of a row
static inline const unsigned char *fe__row_at(const fe__snapshot *snapshot, fe__table_number table, int32_t row)
{
    return snapshot->tables[table].content + (int64_t)row * fe__tables[table].row_size;
}
// The state of row `row`, into a record of that table: other members stay as they are
void fe__take_row(const fe__snapshot *snapshot, fe__table_number table, int32_t row, void *record);
static inline int32_t fe__rows_of(const fe__snapshot *snapshot, fe__table_number table)
{
    return snapshot->tables[table].rows;
}
// The entry of a list
int32_t fe__listed_slot(const fe__snapshot *snapshot, fe__table_number table, int32_t row);

// The next section with an asset: *at from snapshot->assets_at. NULL: no more
const unsigned char *fe__next_asset_bytes(const fe__snapshot *snapshot, int64_t *at, int64_t *out_size);

#endif
