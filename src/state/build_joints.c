// build_joints.c - joints out of a snapshot: what they are made of follows from their settings, as when they were
// created; impulses, wound twists, reactions and colours are read.
#include "state/build.h"

#include "core/array_sort.h"
#include "world/anchor.h"
#include "world/joint_list.h"
#include "world/joint_parts.h"
#include "world/joints.h"

#include <string.h>

// The table of a type's settings
static fe__table_number settings_table(int32_t type)
{
    return (fe__table_number)(FE__TABLE_DISTANCE_JOINTS + type - 1);
}
_Static_assert(FE_JOINT_DISTANCE == 1 && FE_JOINT_BALL == 2 && FE_JOINT_HINGE == 3 && FE_JOINT_FIXED == 4 &&
                   FE_JOINT_CONFIGURABLE == 5,
               "tables of settings are in the order of the types");

static int32_t reserve_joints(fe__build *b, int32_t slots)
{
    fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    int32_t limit = 1 + slots, done = FE_RESERVE(memory, w->joints.joints, w->joint_capacity[0], limit) &&
                                      FE_RESERVE(memory, w->joints.frames, w->joint_capacity[1], limit) &&
                                      FE_RESERVE(memory, w->joints.reactions, w->joint_capacity[2], limit) &&
                                      FE_RESERVE(memory, w->joint_records, w->joint_capacity[3], limit) &&
                                      FE_RESERVE(memory, w->awake_joints, w->awake_joint_capacity, limit);
    if (!done) return fe__lack_memory(b);
    fe_result result = fe__record_pool_reserve(&w->joint_axes, memory, fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES));
    w->joints.axes = (fe__joint_axes *)(void *)w->joint_axes.records;
    for (int32_t type = 1; type < FE__JOINT_TYPES && result == FE_OK; ++type)
        result =
            fe__record_pool_reserve(w->joint_settings + type, memory, fe__rows_of(b->snapshot, settings_table(type)));
    return result == FE_OK || fe__snapshot_fail(b->snapshot, result);
}

static int32_t check_ends(fe__build *b, const fe__joint_record *r, int32_t joint)
{
    fe_world *w = b->world;
    int32_t hidden = 0;
    for (int k = 0; k < 2; ++k) {
        int32_t body = r->body[k];
        int32_t state = body < w->body_ids.slot_count ? w->body_ids.slots[body].next : FE_ID_NONE;
        if (state == FE_ID_HIDDEN && !hidden++ && !fe__is_anchor(w, body))
            fe__anchor_open(w, body, r->world_origin);
        else if (state != FE_ID_ALIVE)
            return fe__snapshot_refuse(b->snapshot, "joint %d: there is no body %d", (int)joint, (int)body);
    }
    return r->body[0] != r->body[1] || fe__snapshot_refuse(b->snapshot, "joint %d: both ends are one", (int)joint);
}

// ---- one joint -----------------------------------------------------------------------------------------------------
typedef struct rows_taken {
    int32_t settings[FE__JOINT_TYPES];
    int32_t axes;
} rows_taken;

static int32_t take_settings(fe__build *b, fe__joint_record *r, int32_t joint, rows_taken *taken)
{
    fe__record_pool *pool = b->world->joint_settings + r->type;
    int32_t row = taken->settings[r->type]++;
    if (row >= fe__rows_of(b->snapshot, settings_table(r->type)))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its settings are not there", (int)joint);
    uint32_t words[FE__SETTINGS_WORDS];
    fe__take_row(b->snapshot, settings_table(r->type), row, words);
    r->settings = fe__record_pool_take(pool);
    memcpy(fe__record(pool, r->settings), words, (size_t)pool->size);
    return 1;
}

static int32_t take_state(fe__build *b, int32_t joint, int32_t row, rows_taken *taken)
{
    fe_world *w = b->world;
    fe__joint_frame *frame = w->joints.frames + joint;
    fe__take_row(b->snapshot, FE__TABLE_JOINT_ANCHORS, row, w->joints.joints + joint);
    fe__take_row(b->snapshot, FE__TABLE_JOINT_FRAMES, row, frame);
    fe__take_row(b->snapshot, FE__TABLE_JOINT_REACTIONS, row, w->joints.reactions + joint);
    if (frame->axes) fe__take_row(b->snapshot, FE__TABLE_JOINT_AXES, taken->axes++, w->joints.axes + frame->axes);
    if (frame->serial == 0 || frame->serial >= w->next_serial)
        return fe__snapshot_refuse(b->snapshot, "joint %d: its serial is %llu", (int)joint,
                                   (unsigned long long)frame->serial);
    return 1;
}

static int32_t take_joint(fe__build *b, int32_t joint, int32_t row, rows_taken *taken)
{
    fe_world *w = b->world;
    fe__joint_record *r = w->joint_records + joint;
    fe__take_row(b->snapshot, FE__TABLE_JOINTS, row, r);
    r->awake_index = -1;
    if (r->flags & ~(uint32_t)(FE__JOINT_ENABLED | FE__JOINT_COLLIDES))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its flags are 0x%x", (int)joint, (unsigned)r->flags);
    if (!check_ends(b, r, joint) || !take_settings(b, r, joint, taken)) return 0;
    w->joints.joints[joint].body_a = r->body[0], w->joints.joints[joint].body_b = r->body[1];
    w->joints.joints[joint].colour = -1;
    fe__joint_any def;
    fe__joint_plan plan;
    memset(&def, 0, sizeof def);
    fe__joint_describe(w, joint, &def);
    fe__joint_make_plan(r->type, &def, &plan);
    if (fe__joint_needs_axes(&plan) && taken->axes >= fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its axes are not there", (int)joint);
    fe__joint_fill(w, joint, &plan);
    w->breakable_count += r->break_force > 0.0f || r->break_torque > 0.0f;
    return take_state(b, joint, row, taken);
}

// ---- lists ---------------------------------------------------------------------------------------------------------
// Joint i has slot i - 1
static int32_t list_joint(fe__build *b, int32_t slot)
{
    fe_world *w = b->world;
    int32_t joint = slot + 1;
    const fe__joint_record *r = w->joint_records + joint;
    fe__joint_add_to_body(w, joint, r->body[0]);
    fe__joint_add_to_body(w, joint, r->body[1]);
    fe__joint_append_to_order(w, joint);
    int32_t linked = w->joints.joints[joint].colour >= 0;
    if (linked == fe__joint_acts(w, joint) && (!linked || fe__joint_relink(&w->joints, w->bodies, joint))) return 1;
    return fe__snapshot_refuse(b->snapshot, "joint %d: colour %d and rows 0x%x are not what it may have", (int)joint,
                               (int)w->joints.joints[joint].colour, (unsigned)w->joints.joints[joint].rows);
}

static uint64_t serial_of_joint(const fe_world *w, int32_t slot) { return w->joints.frames[slot + 1].serial; }

// ---- all -----------------------------------------------------------------------------------------------------------
static int32_t check_rows(fe__build *b, int32_t rows)
{
    fe__snapshot *s = b->snapshot;
    if (rows == b->world->joint_ids.alive_count && rows == fe__rows_of(s, FE__TABLE_JOINT_ANCHORS) &&
        rows == fe__rows_of(s, FE__TABLE_JOINT_FRAMES) && rows == fe__rows_of(s, FE__TABLE_JOINT_REACTIONS))
        return 1;
    return fe__snapshot_refuse(s, "joints: %d rows, %d slots in use", (int)rows, (int)b->world->joint_ids.alive_count);
}

static int32_t check_all_taken(fe__build *b, const rows_taken *taken)
{
    int32_t all = taken->axes == fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES);
    for (int32_t type = 1; type < FE__JOINT_TYPES; ++type)
        all &= taken->settings[type] == fe__rows_of(b->snapshot, settings_table(type));
    if (!all) return fe__snapshot_refuse(b->snapshot, "joints: there are settings or axes of none");
    for (int32_t slot = 0; slot < b->world->body_ids.slot_count; ++slot)
        if (b->world->body_ids.slots[slot].next == FE_ID_HIDDEN && !fe__is_anchor(b->world, slot))
            return fe__snapshot_refuse(b->snapshot, "body slots: %d is hidden, but no joint's", (int)slot);
    return 1;
}

int32_t fe__build_joints(fe__build *b)
{
    fe_world *w = b->world;
    int32_t slots = w->joint_ids.slot_count, rows = fe__rows_of(b->snapshot, FE__TABLE_JOINTS);
    rows_taken taken = {{0}, 0};
    if (!check_rows(b, rows) || !reserve_joints(b, slots)) return 0;
    for (int32_t slot = 0, next = 0; slot < slots; ++slot)
        if (w->joint_ids.slots[slot].next == FE_ID_ALIVE && !take_joint(b, slot + 1, next++, &taken)) return 0;
    return check_all_taken(b, &taken) &&
           fe__build_order(b, &(fe__ordered){"joints", &w->joint_ids, 0, serial_of_joint, list_joint}, rows);
}
