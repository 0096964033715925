// table.h - the tables of a snapshot: which records there are, in which order they stand, and of what they consist.
//
// A table is a section of the format: as many rows as records, in each the fields one behind another. Rows are in the
// order of the records' slots, so that the same state gives the same bytes whatever was allocated, and by whom. Of some
// tables the rows are those of the table before, in the same places: they are written together.
#ifndef FE_STATE_TABLE_H
#define FE_STATE_TABLE_H
#include "state/field.h"
#include "world/world.h"

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

// What a deferred pair waits for (deferral.h): by how far its bodies turned since, so that where odometers began is no
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

#endif
