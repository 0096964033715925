// field.h - what a record consists of, one line a field: the one description that writing, reading, checking and
// comparing snapshots share.
//
// A field is `count` numbers of one kind, side by side. In a snapshot the fields of a record stand one behind another,
// little-endian. Each number is within its range when it is read; what a number means beside others is checked where
// the record is built again.
#ifndef FE_STATE_FIELD_H
#define FE_STATE_FIELD_H
#include "feather.h"

#include <stddef.h>
#include <stdint.h>

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

#endif
