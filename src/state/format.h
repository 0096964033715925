// format.h - the bytes of a snapshot. All numbers are little-endian.
//
//   header    0  magic (8 bytes) | major, minor (2 each) | results (4) | version of the library (4) | number (4)
//            24  size of all (8) | sum (8) | number of sections (4) | 0 (4)
//   section      type (4) | version, flags (2 each) | size of what follows (8) | its sum (8) | rows (8) | rows...
//
// A section is padded with zeros to a multiple of 8. Sections of tables stand in the order of fe__table_number, each
// once; contents of assets follow them, where they are asked for. The header's sum is that of the sections' and of the
// header itself but for the world's number, which handles do not hold either: worlds that differ in it alone have one
// sum. Minor versions append: fields to rows, whose section gets another version, and sections that a reader may skip.
#ifndef FE_STATE_FORMAT_H
#define FE_STATE_FORMAT_H
#include "state/table.h"

enum {
    FE__SNAPSHOT_MAJOR = 3,
    FE__SNAPSHOT_MINOR = 0,
    FE__RESULTS = 1, // grows when the same calls give other bits
    FE__SNAPSHOT_HEADER = 48,
    FE__SECTION_HEADER = 24,
    FE__SECTION_ASSET = 1000, // the bytes of fe_asset_save: one section each
    FE__SECTION_MAY_SKIP = 1, // flag
    FE__SECTION_ROWS = 8      // bytes, before the rows
};

// Places in the header
enum {
    FE__AT_MAJOR = 8,
    FE__AT_RESULTS = 12,
    FE__AT_VERSION = 16,
    FE__AT_NUMBER = 20,
    FE__AT_SIZE = 24,
    FE__AT_SUM = 32,
    FE__AT_SECTIONS = 40
};

extern const unsigned char fe__snapshot_magic[8];

static inline int64_t fe__padded(int64_t size) { return (size + 7) / 8 * 8; }
// Of the section with so many rows, with its header
static inline int64_t fe__section_size(const fe__table *table, int64_t rows)
{
    return FE__SECTION_HEADER + fe__padded(FE__SECTION_ROWS + rows * table->row_size);
}
// The sum of a header whose other fields are written
uint64_t fe__header_sum(const unsigned char *header);
static inline uint64_t fe__join_sums(uint64_t sum, uint64_t section)
{
    return (sum ^ section) * UINT64_C(0x9E3779B97F4A7C15) + 1;
}

#endif
