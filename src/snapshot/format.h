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
#ifndef FE_SNAPSHOT_FORMAT_H
#define FE_SNAPSHOT_FORMAT_H
#include "feather.h"
#include "world/contact.h"
#include "world/joint.h"
#include "world/world.h"

#include <stddef.h>
#include <stdint.h>

// ---- field ----------------------------------------------------------------------------------------------------------
// What a record consists of, one line a field: the one description that writing, reading, checking and
// comparing snapshots share.
//
// A field is `count` numbers of one kind, side by side. In a snapshot the fields of a record stand one behind another,
// little-endian. Each number is within its range when it is read; what a number means beside others is checked where
// the record is built again.

typedef enum fe__field_kind {
    FE__U8,
    FE__U16,
    FE__I16,
    FE__U32,
    FE__I32,
    FE__F32,
    FE__U64,
    FE__I64,
    FE__F64,
    FE__NAME, // a handle: the world's number is not written, and put in when it is read
    FE__FIELD_KINDS
} fe__field_kind;

typedef enum fe__range_number {
    FE__RANGE_ANY,     // all bits mean something
    FE__RANGE_GROWING, // those of a counter or a bound, which tells of what was, not of what is
    FE__RANGE_FINITE,
    FE__RANGE_POSITIVE, // or 0
    FE__RANGE_SPEED,    // m/s, rad/s: what ends a step is below it
    FE__RANGE_SWIFT,    // m/s, of the fastest point of a body
    FE__RANGE_PLACE,    // m, in a body's frame
    FE__RANGE_LENGTH,   // m, of a body, or 0
    FE__RANGE_UNIT,     // of a unit vector, but for its rounding
    FE__RANGE_SECONDS,
    FE__RANGE_BOOL,
    FE__RANGE_LINK, // an index, or -1
    FE__RANGE_INDEX,
    FE__RANGE_LOCKS, // fe__body.lock_bits
    FE__RANGE_COUNT, // of points
    FE__RANGE_BODY_KIND,
    FE__RANGE_FORM_KIND,
    FE__RANGE_COLOUR, // of a contact, -1: none
    FE__RANGE_JOINT_COLOUR,
    FE__RANGE_ROW_KIND,
    FE__RANGE_JOINT_KIND,
    FE__RANGE_SUBSTEPS,
    FE__RANGE_EVENT_KIND,
    FE__RANGE_LEFT_OUT,
    FE__RANGE_GENERATION,
    FE__RANGE_SLOT_STATE, // fe__id_slot.next
    FE__RANGES
} fe__range_number;

typedef struct fe__range {
    double low, high;
} fe__range;
extern const fe__range fe__ranges[FE__RANGES];

typedef struct fe__field {
    const char *name;
    uint32_t offset; // in the record, bytes
    uint8_t kind;    // fe__field_kind
    uint8_t range;   // fe__range_number
    uint16_t count;
} fe__field;

static inline uint32_t fe__kind_size(int32_t kind)
{
    static const uint8_t sizes[FE__FIELD_KINDS] = {1, 2, 2, 4, 4, 4, 8, 8, 8, 8};
    return sizes[kind];
}
static inline uint32_t fe__field_size(const fe__field *field) { return field->count * fe__kind_size(field->kind); }

// The types behind the kinds, for the lists below
#define FE__TYPE_U8 uint8_t
#define FE__TYPE_U16 uint16_t
#define FE__TYPE_I16 int16_t
#define FE__TYPE_U32 uint32_t
#define FE__TYPE_I32 int32_t
#define FE__TYPE_F32 float
#define FE__TYPE_U64 uint64_t
#define FE__TYPE_I64 int64_t
#define FE__TYPE_F64 double
#define FE__TYPE_NAME fe_handle

// A list of fields is a macro of three others: S(record, member, kind, range) is state; R(record, member) is made anew
// when a snapshot is read, or scratch; P(bytes) is padding. From one list come the table, and the assertion that every
// byte of the record was thought of.
#define FE__SIZE_OF(record, member) sizeof(((record *)0)->member)
#define FE__FIELD(record, member, kind, range)                         \
    {#member, offsetof(record, member), FE__##kind, FE__RANGE_##range, \
     FE__SIZE_OF(record, member) / (sizeof(FE__TYPE_##kind))},
#define FE__NO_FIELD(...)
#define FE__STATE_SIZE(record, member, kind, range) +FE__SIZE_OF(record, member)
#define FE__ANEW_SIZE(record, member) +FE__SIZE_OF(record, member)
#define FE__PADDING(bytes) +(bytes)
// Where pointers have 8 bytes. Other machines pad otherwise, by what nobody reads
#define FE__IS_WHOLE(record, list)                                                                   \
    _Static_assert(sizeof(void *) != 8 ||                                                            \
                       0 list(record, FE__STATE_SIZE, FE__ANEW_SIZE, FE__PADDING) == sizeof(record), \
                   #record " has a byte that is neither state nor made anew")
#define FE__FIELDS(record, list)                            \
    {                                                       \
        list(record, FE__FIELD, FE__NO_FIELD, FE__NO_FIELD) \
    }

// ---- table ----------------------------------------------------------------------------------------------------------
// The tables of a snapshot: which records there are, in which order they stand, and of what they consist.
//
// A table is a section of the format: as many rows as records, in each the fields one behind another. Rows are in the
// order of the records' slots, so that the same state gives the same bytes whatever was allocated, and by whom. Of some
// tables the rows are those of the table before, in the same places: they are written together.

typedef enum fe__table_number {
    FE__TABLE_WORLD,
    FE__TABLE_BODY_SLOTS, // generations, and the stack of free slots
    FE__TABLE_SHAPE_SLOTS,
    FE__TABLE_JOINT_SLOTS,
    FE__TABLE_BODIES,
    FE__TABLE_DRIFTS,
    FE__TABLE_SHAPES,
    FE__TABLE_FORMS,
    FE__TABLE_ASSETS, // of the first user of each
    FE__TABLE_JOINTS,
    FE__TABLE_DISTANCE_JOINTS, // what a type's definition has beyond the common front
    FE__TABLE_BALL_JOINTS,
    FE__TABLE_HINGE_JOINTS,
    FE__TABLE_FIXED_JOINTS,
    FE__TABLE_CONFIGURABLE_JOINTS,
    FE__TABLE_JOINT_ANCHORS, // what the solver keeps of each
    FE__TABLE_JOINT_FRAMES,
    FE__TABLE_JOINT_REACTIONS,
    FE__TABLE_JOINT_AXES,
    FE__TABLE_PAIRS,
    FE__TABLE_FOUND,    // of each pair, what its next look needs: two of three are near misses and have no more
    FE__TABLE_PATCHES,  // of pairs with heightfields and meshes
    FE__TABLE_TOUCHING, // pairs that have points
    FE__TABLE_POINTS,
    FE__TABLE_FEATURES,
    FE__TABLE_EXTRAS,
    FE__TABLE_FREE_PAIRS, // slots, in the order in which they are given
    FE__TABLE_OWED,       // slots of ended pairs, with the exit of each
    FE__TABLE_AWAKE_BODIES,
    FE__TABLE_AWAKE_PAIRS,
    FE__TABLE_DEFERRALS, // of awake pairs
    FE__TABLE_AWAKE_JOINTS,
    FE__TABLE_PLANES,
    FE__TABLE_IGNORES,
    FE__TABLE_FREE_IGNORES,
    FE__TABLE_ENCOUNTERS,
    FE__TABLE_FREE_ENCOUNTERS,
    FE__TABLE_PAIR_EVENTS,
    FE__TABLE_BODY_EVENTS,
    FE__TABLE_HIT_EVENTS,
    FE__TABLE_JOINT_EVENTS,
    FE__TABLE_TREES, // static, moving
    FE__TABLE_STATIC_NODES,
    FE__TABLE_MOVING_NODES,
    FE__TABLES
} fe__table_number;

enum {
    FE__ROOM = 320,            // bytes, for the largest record that is made
    FE__LARGEST_RECORD = 640,  // bytes, of any table
    FE__RECORD_ALIGNMENT = 64, // bytes, of any record
    FE__BLOCK = 64             // rows that are written and checked at a time
};

// Records of a block of rows: the world's own, or made in the rooms
typedef struct fe__rows_block {
    const void *records[FE__BLOCK];
    int32_t places[FE__BLOCK]; // in the world
    _Alignas(16) unsigned char rooms[FE__BLOCK][FE__ROOM];
} fe__rows_block;

typedef struct fe__table {
    const char *name;
    const fe__field *fields;
    int32_t field_count;
    int32_t row_size;                        // bytes
    int32_t is_beside;                       // its rows, where it has any, are those of the table before
    int32_t (*count)(const fe_world *world); // rows, in constant time
    // The next rows behind a place, -1: from the first. Returns the place of the last of them
    int32_t (*gather)(const fe_world *world, int32_t place, int32_t rows, fe__rows_block *block);
    void (*find)(const fe_world *world, int32_t rows, fe__rows_block *block); // the records of its places
    void (*put)(const fe__rows_block *block, int32_t rows, unsigned char *out);
    void (*take)(const unsigned char *row, fe_handle number, void *record); // number: of the world, in its bits
    // Most numbers are within their ranges: 0 when each number of these rows is. Else some may be outside
    uint32_t (*doubt)(const unsigned char *rows, int32_t count);
} fe__table;
extern const fe__table fe__tables[FE__TABLES];

// ---- records that are made for a row -------------------------------------------------------------------------------
// The members of fe_world that are numbers, and no arrays
typedef struct fe__world_row {
    uint64_t user_data, next_serial;
    int64_t step_number;
    fe_vec3 gravity;
    int32_t substeps;
    float last_h, last_dt;
    uint32_t row_kinds;
    int32_t pair_limit, pair_colours, static_colours, has_extras, has_filter;
    uint32_t joint_row_kinds;
    int32_t most_joints, ignore_limit, encounter_limit;
    int32_t free_slots[3]; // the first of bodies, shapes, joints
    fe_world_tuning tuning;
} fe__world_row;

// An asset, by the slot of its first user, under the scale of that
typedef struct fe__asset_row {
    uint64_t key[2];
    fe_vec3 scale;
    int32_t shape, kind;
    fe_asset handle; // in its store: of several with one key, that one
} fe__asset_row;

typedef struct fe__slot_row { // an entry of a list
    int32_t slot;
} fe__slot_row;

typedef struct fe__patch_row { // what fe__pair has for patches
    int32_t slot, next_patch, head, triangle;
} fe__patch_row;

typedef struct fe__touching_row { // what fe__contact and fe__pair have for points
    int32_t slot, colour;
    float point_count, span[3];
    int32_t left_out;
} fe__touching_row;

typedef struct fe__owed_row {
    int32_t slot;
    fe__pair_event_record exit;
} fe__owed_row;

// What a deferred pair waits for (skip_test.h): by how far its bodies turned since, so that where odometers began is no
// state
typedef struct fe__deferral_row {
    int32_t slot;
    float gap, most;
    uint32_t apart[3], turned[2];
} fe__deferral_row;

typedef struct fe__ignore_row {
    int32_t slot;
    int32_t body[2];
    int32_t next[2]; // in the lists of body[0] and body[1]
} fe__ignore_row;

typedef struct fe__encounter_row {
    int32_t slot, shape_a, shape_b, lead;
    uint16_t denied, entered;
    int32_t listed;
} fe__encounter_row;

// What the caller's definition of a joint has beyond the common front: words of 32 bits
enum { FE__SETTINGS_WORDS = (sizeof(fe__joint_any) - FE__JOINT_FRONT) / sizeof(uint32_t) };

// ---- format ---------------------------------------------------------------------------------------------------------

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

// ---- sum ------------------------------------------------------------------------------------------------------------
// The checksum of a section: against accidents, at nearly the speed of memory.

enum { FE__SUM_LANES = 8, FE__SUM_LINE = 64 }; // words side by side; bytes of them

// Of bytes that come piece by piece
typedef struct fe__sum {
    uint64_t lanes[FE__SUM_LANES];
    int64_t size; // bytes so far
} fe__sum;

void fe__sum_lines(fe__sum *sum, const unsigned char *bytes, int64_t size);   // a multiple of a line
uint64_t fe__sum_end(fe__sum *sum, const unsigned char *bytes, int64_t size); // the last ones, a multiple of 8

// Of bytes, a multiple of 8
static inline uint64_t fe__sum_of(const unsigned char *bytes, int64_t size)
{
    fe__sum sum = {{0}, 0};
    return fe__sum_end(&sum, bytes, size);
}

#endif
