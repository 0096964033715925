// format.c - see format.h. Eight lanes of the step of core/bytes.h side by side, whose multiplications do not wait for
// each other; then the lanes one after another, and the size.
#include "snapshot/format.h"

#include "collision/form/form.h"
#include "core/bytes.h"
#include "core/id_pool.h"
#include "snapshot/rows.h"
#include "world/contact.h"
#include "world/encounter.h"
#include "world/joint.h"

#include <float.h>

// ---- numbers --------------------------------------------------------------------------------------------------------
// Numbers of one kind to bytes and back, and whether they are within their range: for the straight code
// that format.c makes of its lists. All arguments but addresses are constants there.

#define FE__STRAIGHT static inline __attribute__((always_inline))

FE__STRAIGHT void fe__swap_numbers(unsigned char *out, const unsigned char *in, size_t size, fe__field_kind kind)
{
    const size_t width = fe__kind_size((int32_t)kind);
    for (size_t at = 0; at < size; at += width)
        for (size_t k = 0; k < width; ++k) out[at + k] = in[at + width - 1 - k];
}

FE__STRAIGHT unsigned char *fe__put_numbers(unsigned char *out, const void *in, size_t size, fe__field_kind kind)
{
    const fe_handle world = (fe_handle)FE_ID_LAST_NUMBER << FE_ID_NUMBER_SHIFT;
    if (kind == FE__NAME) {
        for (size_t at = 0; at < size; at += sizeof world) {
            fe_handle handle;
            memcpy(&handle, (const unsigned char *)in + at, sizeof handle);
            fe__put_u64(out + at, handle & ~world);
        }
    } else if (FE_IS_LITTLE_ENDIAN)
        memcpy(out, in, size);
    else
        fe__swap_numbers(out, in, size, kind);
    return out + size;
}

FE__STRAIGHT const unsigned char *fe__take_numbers(const unsigned char *in, void *out, size_t size, fe__field_kind kind,
                                                   fe_handle number)
{
    if (kind == FE__NAME) {
        for (size_t at = 0; at < size; at += sizeof number) {
            const unsigned char *from = in + at;
            fe_handle handle = fe__take_u64(&from);
            if (handle) handle |= number;
            memcpy((unsigned char *)out + at, &handle, sizeof handle);
        }
    } else if (FE_IS_LITTLE_ENDIAN)
        memcpy(out, in, size);
    else
        fe__swap_numbers(out, in, size, kind);
    return in + size;
}

// ---- ranges: the highest bit of what is returned tells a doubt ------------------------------------------------------
enum { FE__EXPONENT = 0x7f800000, FE__EXPONENT_STEP = 0x00800000, FE__MAGNITUDE = 0x7fffffff };

// A whole number from 0 to `high`
FE__STRAIGHT uint32_t fe__doubt_whole(uint32_t bits, float high)
{
    const fe__float_word x = {.bits = bits};
    float held = x.value >= 0.0f && x.value <= high ? x.value : 0.5f;
    return (uint32_t)((float)(int32_t)held != held) << 31;
}

FE__STRAIGHT uint32_t fe__doubt_float(uint32_t bits, fe__range_number range)
{
    const fe__float_word high = {.value = (float)fe__ranges[range].high};
    switch (range) {
    case FE__RANGE_FINITE:
        return (bits & FE__EXPONENT) + FE__EXPONENT_STEP;
    case FE__RANGE_UNIT:
    case FE__RANGE_SPEED:
    case FE__RANGE_PLACE:
        return high.bits - (bits & FE__MAGNITUDE);
    case FE__RANGE_LOCKS:
    case FE__RANGE_COUNT:
        return fe__doubt_whole(bits, high.value);
    default: // from 0 on: of positive floats the bits rise with the value
        return bits | (high.bits - bits);
    }
}

FE__STRAIGHT uint32_t fe__doubt_int(int32_t x, fe__range_number range)
{
    return ((uint32_t)x - (uint32_t)(int32_t)fe__ranges[range].low) |
           ((uint32_t)(int32_t)fe__ranges[range].high - (uint32_t)x);
}

FE__STRAIGHT uint32_t fe__doubt_number(const unsigned char *in, fe__field_kind kind, fe__range_number range)
{
    switch (kind) {
    case FE__U8:
        return fe__doubt_int(fe__take_u8(&in), range);
    case FE__U16:
        return fe__doubt_int(fe__take_u16(&in), range);
    case FE__I16:
        return fe__doubt_int((int16_t)fe__take_u16(&in), range);
    case FE__I32:
        return fe__doubt_int(fe__take_i32(&in), range);
    case FE__F32:
        return fe__doubt_float(fe__take_u32(&in), range);
    case FE__F64:
        return (uint32_t)(((fe__take_u64(&in) >> 32) & 0x7ff00000u) + 0x00100000u);
    default:
        return 1u << 31;
    }
}

FE__STRAIGHT uint32_t fe__doubt_numbers(const unsigned char *in, size_t size, fe__field_kind kind,
                                        fe__range_number range)
{
    uint32_t doubts = 0;
    if (range == FE__RANGE_ANY || range == FE__RANGE_GROWING) return 0;
    for (size_t at = 0; at < size; at += fe__kind_size((int32_t)kind)) doubts |= fe__doubt_number(in + at, kind, range);
    return doubts;
}

// ---- sum ------------------------------------------------------------------------------------------------------------

enum { WORD = 8 };

static inline uint64_t word_at(const unsigned char *at)
{
    uint64_t word;
    if (!FE_IS_LITTLE_ENDIAN) return fe__take_u64(&at);
    memcpy(&word, at, sizeof word);
    return word;
}

static inline uint64_t step(uint64_t state, uint64_t word)
{
    state = (state ^ word) * FE_HASH_FACTOR;
    return state ^ state >> 32;
}

void fe__sum_lines(fe__sum *sum, const unsigned char *bytes, int64_t size)
{
    uint64_t *l = sum->lanes; // in registers meanwhile, as an array would not be
    uint64_t a = l[0], b = l[1], c = l[2], d = l[3], e = l[4], f = l[5], g = l[6], h = l[7];
    for (const unsigned char *at = bytes, *end = bytes + size; at < end; at += FE__SUM_LINE) {
        a = step(a, word_at(at)), b = step(b, word_at(at + WORD));
        c = step(c, word_at(at + 2 * WORD)), d = step(d, word_at(at + 3 * WORD));
        e = step(e, word_at(at + 4 * WORD)), f = step(f, word_at(at + 5 * WORD));
        g = step(g, word_at(at + 6 * WORD)), h = step(h, word_at(at + 7 * WORD));
    }
    l[0] = a, l[1] = b, l[2] = c, l[3] = d, l[4] = e, l[5] = f, l[6] = g, l[7] = h;
    sum->size += size;
}

uint64_t fe__sum_end(fe__sum *sum, const unsigned char *bytes, int64_t size)
{
    int64_t lines = size / FE__SUM_LINE * FE__SUM_LINE;
    fe__sum_lines(sum, bytes, lines);
    for (int64_t at = lines, k = 0; at < size; at += WORD, ++k)
        sum->lanes[k] = step(sum->lanes[k], word_at(bytes + at));
    fe__hash all = fe__hash_begin();
    for (int k = 0; k < FE__SUM_LANES; ++k) fe__hash_u64(&all, sum->lanes[k]);
    fe__hash_u64(&all, (uint64_t)(sum->size + size - lines));
    return fe__hash_end(&all);
}

// ---- tables ---------------------------------------------------------------------------------------------------------
// The one table of fields: what of each record is state, and what is made anew.
//
// Whoever adds a member to a record adds a line here: the assertion behind each list counts bytes.

// m. Parts of a compound of a body lie within FE_MAX_LOCAL thrice, and are FE_MAX_LENGTH long: less than this by far.
// Its square, and its product with a speed, stay inside a float.
#define FARTHEST_IN_BODY (100.0 * (double)FE_MAX_LOCAL)

const fe__range fe__ranges[FE__RANGES] = {
    [FE__RANGE_ANY] = {0.0, 0.0},
    [FE__RANGE_GROWING] = {0.0, 0.0},
    [FE__RANGE_FINITE] = {-(double)FLT_MAX, (double)FLT_MAX},
    [FE__RANGE_POSITIVE] = {0.0, (double)FLT_MAX},
    [FE__RANGE_SPEED] = {-(double)FE_MOST_SPEED, (double)FE_MOST_SPEED},
    [FE__RANGE_SWIFT] = {0.0, FARTHEST_IN_BODY * 4.0 * (double)FE_MOST_SPEED},
    [FE__RANGE_PLACE] = {-FARTHEST_IN_BODY, FARTHEST_IN_BODY},
    [FE__RANGE_LENGTH] = {0.0, FARTHEST_IN_BODY},
    [FE__RANGE_UNIT] = {-1.001, 1.001},
    [FE__RANGE_SECONDS] = {0.0, 1e9},
    [FE__RANGE_BOOL] = {0.0, 1.0},
    [FE__RANGE_LINK] = {-1.0, INT32_MAX - 1},
    [FE__RANGE_INDEX] = {0.0, INT32_MAX - 1},
    [FE__RANGE_LOCKS] = {0.0, 63.0},
    [FE__RANGE_COUNT] = {0.0, FE__POINTS},
    [FE__RANGE_BODY_KIND] = {FE_BODY_STATIC, FE_BODY_DYNAMIC},
    [FE__RANGE_FORM_KIND] = {0.0, FE__FORM_TYPES - 1},
    [FE__RANGE_COLOUR] = {-1.0, FE__OVERFLOW_COLOUR},
    [FE__RANGE_JOINT_COLOUR] = {-1.0, FE__JOINT_OVERFLOW},
    [FE__RANGE_ROW_KIND] = {-1.0, FE__ROW_KINDS - 1},
    [FE__RANGE_JOINT_KIND] = {1.0, FE__JOINT_TYPES - 1},
    [FE__RANGE_SUBSTEPS] = {1.0, 64.0},
    [FE__RANGE_EVENT_KIND] = {0.0, 255.0},
    [FE__RANGE_LEFT_OUT] = {FE_LEFT_NONE, FE_LEFT_REST},
    [FE__RANGE_GENERATION] = {1.0, FE_ID_LAST_GENERATION},
    [FE__RANGE_SLOT_STATE] = {FE_ID_HIDDEN, FE_ID_MAX_SLOTS},
};

// clang-format off
// ---- the world -----------------------------------------------------------------------------------------------------
#define WORLD(T, S, R, P) \
    S(T, user_data, U64, ANY) S(T, next_serial, U64, GROWING) S(T, step_number, I64, ANY) S(T, gravity, F32, FINITE) \
    S(T, substeps, I32, SUBSTEPS) S(T, last_h, F32, POSITIVE) S(T, last_dt, F32, POSITIVE) \
    S(T, row_kinds, U32, GROWING) \
    S(T, pair_limit, I32, INDEX) S(T, pair_colours, I32, INDEX) S(T, static_colours, I32, INDEX) \
    S(T, has_extras, I32, BOOL) S(T, has_filter, I32, BOOL) S(T, joint_row_kinds, U32, GROWING) \
    S(T, most_joints, I32, INDEX) S(T, ignore_limit, I32, INDEX) S(T, encounter_limit, I32, INDEX) \
    S(T, free_slots, I32, SLOT_STATE) P(4) \
    R(T, tuning.struct_size) S(T, tuning.contact_hertz, F32, FINITE) S(T, tuning.contact_damping_ratio, F32, FINITE) \
    S(T, tuning.contact_push_speed, F32, FINITE) S(T, tuning.joint_hertz, F32, FINITE) \
    S(T, tuning.joint_damping_ratio, F32, FINITE) S(T, tuning.restitution_threshold, F32, FINITE) \
    S(T, tuning.hit_event_threshold, F32, FINITE) S(T, tuning.sleep_time, F32, FINITE) \
    S(T, tuning.speculative_distance, F32, FINITE) S(T, tuning.max_linear_speed, F32, FINITE) \
    S(T, tuning.sleep_enabled, I32, BOOL) S(T, tuning.continuous_enabled, I32, BOOL) \
    S(T, tuning.warm_start_enabled, I32, BOOL)

#define SLOT(T, S, R, P) S(T, generation, I32, GENERATION) S(T, next, I32, SLOT_STATE)

// ---- bodies --------------------------------------------------------------------------------------------------------
// Lists of what is created in an order follow from serials. Of pairs and of ignored bodies the order is kept: what is
// freed in it is given again in it
#define BODY(T, S, R, P) \
    R(T, centre_high) R(T, centre_low) /* of centre */ \
    S(T, speed, F32, SWIFT) S(T, rotation, F32, UNIT) S(T, local_centre, F32, PLACE) S(T, reach, F32, LENGTH) \
    S(T, velocity, F32, SPEED) S(T, inverse_mass, F32, POSITIVE) S(T, spin, F32, SPEED) S(T, lock_bits, F32, LOCKS) \
    S(T, force, F32, FINITE) S(T, linear_damping, F32, POSITIVE) S(T, torque, F32, FINITE) \
    S(T, angular_damping, F32, POSITIVE) S(T, inertia, F32, POSITIVE) S(T, mass, F32, POSITIVE) \
    S(T, inertia_axes, F32, UNIT) S(T, gravity_scale, F32, FINITE) S(T, thickness, F32, POSITIVE) \
    S(T, sleep_threshold, F32, POSITIVE) S(T, sleep_timer, F32, SECONDS) \
    R(T, line) /* of the graph */ R(T, awake_index) S(T, island, I32, LINK) \
    S(T, type, I32, BODY_KIND) S(T, flags, U32, ANY) P(4) S(T, centre, F64, FINITE) S(T, origin, F64, FINITE) \
    R(T, colours) /* of its contacts */ S(T, drawn, U32, ANY) R(T, joint_colours) R(T, joint_count) P(4) \
    S(T, serial, U64, ANY) S(T, first_contact, I32, LINK) R(T, contact_count) R(T, static_pairs) \
    R(T, coming_contacts) /* within a step */ R(T, first_shape) R(T, last_shape) R(T, shape_count) \
    R(T, first_joint) R(T, last_joint) R(T, joint_total) S(T, first_ignored, I32, INDEX) R(T, locked) \
    S(T, moved_step, I64, ANY) S(T, user_data, U64, ANY) R(T, order_next) R(T, order_previous) P(8) \
    S(T, relaxed, F32, FINITE)

#define DRIFT(T, S, R, P) S(T, shift, F32, FINITE) S(T, turn, F32, FINITE)

// ---- shapes --------------------------------------------------------------------------------------------------------
#define SHAPE(T, S, R, P) \
    S(T, layer, U32, ANY) S(T, mask, U32, ANY) S(T, flags, U32, ANY) S(T, body, I32, INDEX) \
    R(T, pose) /* of the body's and its own */ R(T, form) /* a table of its own */ \
    S(T, local_position, F32, PLACE) S(T, local_rotation, F32, UNIT) P(4) \
    S(T, material.static_friction, F32, POSITIVE) S(T, material.dynamic_friction, F32, POSITIVE) \
    S(T, material.restitution, F32, POSITIVE) S(T, material.rolling_resistance, F32, POSITIVE) \
    S(T, material.spinning_resistance, F32, POSITIVE) S(T, material.friction_combine, I32, INDEX) \
    S(T, material.restitution_combine, I32, INDEX) R(T, material.reserved) S(T, material.user_id, U64, ANY) \
    S(T, group, I32, ANY) S(T, events, U32, ANY) S(T, density, F32, POSITIVE) S(T, arm, F32, FINITE) \
    S(T, surface_velocity, F32, FINITE) S(T, one_way, F32, FINITE) R(T, next) R(T, previous) S(T, serial, U64, ANY) \
    R(T, body_serial) S(T, user_data, U64, ANY) S(T, next_user, I32, LINK) S(T, parent, I32, LINK)

#define FORM(T, S, R, P) \
    S(T, kind, I32, FORM_KIND) S(T, radius, F32, POSITIVE) S(T, half_height, F32, POSITIVE) \
    S(T, distance, F32, FINITE) \
    S(T, half, F32, POSITIVE) S(T, normal, F32, UNIT)

#define ASSET(T, S, R, P) \
    S(T, key, U64, ANY) S(T, scale, F32, FINITE) S(T, shape, I32, INDEX) S(T, kind, I32, INDEX) P(4) \
    S(T, handle, NAME, ANY)

// ---- joints --------------------------------------------------------------------------------------------------------
// Their parts follow from their settings, as when they were made
#define JOINT(T, S, R, P) \
    S(T, type, I32, JOINT_KIND) S(T, flags, U32, ANY) S(T, body, I32, INDEX) R(T, links) R(T, order_next) \
    R(T, order_previous) R(T, awake_index) R(T, settings) R(T, shift) \
    S(T, frame[0].position, F32, FINITE) S(T, frame[0].rotation, F32, UNIT) S(T, frame[1].position, F32, FINITE) \
    S(T, frame[1].rotation, F32, UNIT) S(T, hertz, F32, POSITIVE) S(T, damping_ratio, F32, POSITIVE) \
    S(T, break_force, F32, POSITIVE) S(T, break_torque, F32, POSITIVE) S(T, user_data, U64, ANY) \
    S(T, world_origin, F64, FINITE) P(4)

#define JOINT_ANCHOR(T, S, R, P) \
    R(T, arm_a) R(T, hertz) R(T, arm_b) R(T, damping_ratio) S(T, impulse, F32, FINITE) R(T, body_a) R(T, body_b) \
    S(T, colour, I32, JOINT_COLOUR) S(T, rows, U32, ANY)

#define JOINT_FRAME(T, S, R, P) \
    R(T, frame_a) R(T, frame_b) S(T, impulse, F32, FINITE) S(T, serial, U64, ANY) R(T, axes) R(T, parts) R(T, locked)

#define REACTION(T, S, R, P) S(T, force, F32, FINITE) S(T, torque, F32, FINITE)

#define ONE_AXIS(T, S, R, i) \
    R(T, axis[i].limit) R(T, axis[i].drive) R(T, axis[i].motor) S(T, axis[i].impulse, F32, FINITE) \
    S(T, axis[i].state.x, F32, FINITE) S(T, axis[i].state.force, F32, FINITE) R(T, axis[i].state.zero)
#define AXES(T, S, R, P) \
    ONE_AXIS(T, S, R, 0) ONE_AXIS(T, S, R, 1) ONE_AXIS(T, S, R, 2) ONE_AXIS(T, S, R, 3) ONE_AXIS(T, S, R, 4) \
    ONE_AXIS(T, S, R, 5) \
    R(T, rotation.target) R(T, rotation.drive) R(T, rotation.motor) S(T, rotation.impulse, F32, FINITE) \
    S(T, rotation.motor_impulse, F32, FINITE) S(T, rotation.torque, F32, FINITE)

// ---- pairs ---------------------------------------------------------------------------------------------------------
#define PAIR(T, S, R, P) \
    S(T, shape_a, I32, INDEX) S(T, shape_b, I32, INDEX) R(T, body_a) R(T, body_b) \
    S(T, links[0].next, I32, LINK) R(T, links[0].previous) S(T, links[1].next, I32, LINK) R(T, links[1].previous) \
    S(T, flags, U32, ANY) R(T, events) /* of its shapes */ R(T, left_out) /* with the points */ \
    R(T, result) /* within a step */ \
    R(T, next_patch) /* a table of its own */ R(T, awake_index) S(T, axis, I32, LINK) \
    S(T, axis_separation, F32, FINITE) R(T, head) R(T, triangle)

#define FOUND(T, S, R, P) \
    S(T, normal, F32, FINITE) R(T, point_count) R(T, span) /* with the points */ S(T, static_friction, F32, POSITIVE) \
    S(T, surface, F32, FINITE) S(T, found_span, F32, FINITE) S(T, longest_arm, F32, FINITE) \
    S(T, found_a, F32, FINITE) S(T, found_b, F32, FINITE) S(T, found_low, F32, FINITE) R(T, points) R(T, body_a) \
    R(T, body_b) R(T, kind) /* of its shapes */ R(T, colour)

#define PATCH(T, S, R, P) \
    S(T, slot, I32, INDEX) S(T, next_patch, I32, LINK) S(T, head, I32, LINK) S(T, triangle, I32, LINK)

#define TOUCHING(T, S, R, P) \
    S(T, slot, I32, INDEX) S(T, colour, I32, COLOUR) S(T, point_count, F32, COUNT) S(T, span, F32, FINITE) \
    S(T, left_out, I32, LEFT_OUT)

#define POINTS(T, S, R, P) \
    S(T, separation, F32, FINITE) S(T, normal_impulse, F32, FINITE) S(T, friction_impulse, F32, FINITE) \
    S(T, twist_impulse, F32, FINITE) S(T, total_impulse, F32, FINITE) S(T, point, F32, FINITE)

#define FEATURES(T, S, R, P) S(T, ids, U32, ANY) S(T, approach, F32, FINITE)

#define EXTRA(T, S, R, P) \
    S(T, restitution, F32, POSITIVE) S(T, rolling, F32, POSITIVE) S(T, spinning, F32, POSITIVE) \
    S(T, surface_velocity, F32, FINITE) S(T, rolling_impulse, F32, FINITE)

#define LISTED(T, S, R, P) S(T, slot, I32, INDEX)

#define DEFERRAL(T, S, R, P) \
    S(T, slot, I32, INDEX) S(T, gap, F32, FINITE) S(T, most, F32, FINITE) S(T, apart, U32, ANY) S(T, turned, U32, ANY)

#define IGNORE(T, S, R, P) S(T, slot, I32, INDEX) S(T, body, I32, INDEX) S(T, next, I32, INDEX)

#define ENCOUNTER(T, S, R, P) \
    S(T, slot, I32, INDEX) S(T, shape_a, I32, INDEX) S(T, shape_b, I32, INDEX) S(T, lead, I32, INDEX) \
    S(T, denied, U16, BOOL) S(T, entered, U16, BOOL) S(T, listed, I32, BOOL)

// ---- events --------------------------------------------------------------------------------------------------------
#define PAIR_EVENT(T, S, R, P, e) \
    S(T, e serial_a, U64, ANY) S(T, e serial_b, U64, ANY) S(T, e body_a, NAME, ANY) S(T, e body_b, NAME, ANY) \
    S(T, e shape_a, NAME, ANY) S(T, e shape_b, NAME, ANY) S(T, e kind, I16, EVENT_KIND) S(T, e is_trigger, U8, BOOL) \
    S(T, e field_a, U8, BOOL) S(T, e triangle, I32, LINK)
#define PLAIN_PAIR_EVENT(T, S, R, P) PAIR_EVENT(T, S, R, P, )
#define OWED(T, S, R, P) S(T, slot, I32, INDEX) P(4) PAIR_EVENT(T, S, R, P, exit.)

#define BODY_EVENT(T, S, R, P) \
    S(T, serial, U64, ANY) S(T, event.body, NAME, ANY) S(T, event.kind, I32, EVENT_KIND) R(T, event.reserved)

#define HIT_EVENT(T, S, R, P) \
    S(T, serial_a, U64, ANY) S(T, serial_b, U64, ANY) S(T, event.body_a, NAME, ANY) S(T, event.body_b, NAME, ANY) \
    S(T, event.shape_a, NAME, ANY) S(T, event.shape_b, NAME, ANY) S(T, event.material_a, U64, ANY) \
    S(T, event.material_b, U64, ANY) S(T, event.point, F64, FINITE) S(T, event.normal, F32, FINITE) \
    S(T, event.speed, F32, FINITE) S(T, event.impulse, F32, FINITE) S(T, event.part_a, I32, LINK) \
    S(T, event.part_b, I32, LINK) S(T, event.triangle_a, I32, LINK) S(T, event.triangle_b, I32, LINK) \
    R(T, event.reserved)

#define JOINT_EVENT(T, S, R, P) \
    S(T, serial, U64, ANY) S(T, event.joint, NAME, ANY) S(T, event.body_a, NAME, ANY) S(T, event.body_b, NAME, ANY) \
    S(T, event.user_data, U64, ANY) S(T, event.kind, I32, EVENT_KIND) S(T, event.type, I32, JOINT_KIND) \
    S(T, event.force, F32, FINITE) S(T, event.torque, F32, FINITE)

// ---- trees ---------------------------------------------------------------------------------------------------------
#define TREE(T, S, R, P) \
    R(T, kernels) R(T, nodes) S(T, node_count, I32, INDEX) S(T, node_capacity, I32, INDEX) S(T, dead, I32, INDEX) \
    P(4) R(T, slot) R(T, slot_capacity) S(T, proxy_count, I32, INDEX) S(T, promised, I32, INDEX) \
    S(T, depth, I32, INDEX) \
    S(T, built_cost, F32, POSITIVE) P(4) S(T, origin, F64, FINITE)

#define NODE(T, S, R, P) \
    S(T, box, F32, ANY) S(T, child, I32, ANY) S(T, parent, I32, LINK) S(T, lane, I32, INDEX) R(T, spare)
// clang-format on

// ---- what the lists become ------------------------------------------------------------------------------------------
#define PUT(T, member, kind, range) out = fe__put_numbers(out, &r->member, sizeof r->member, FE__##kind);
#define TAKE(T, member, kind, range) in = fe__take_numbers(in, &r->member, sizeof r->member, FE__##kind, number);
#define DOUBT(T, member, kind, range) \
    doubts |= fe__doubt_numbers(in, sizeof r->member, FE__##kind, FE__RANGE_##range), in += sizeof r->member;
#define DEFINE(name, record, list)                                                         \
    static const fe__field name[] = FE__FIELDS(record, list);                              \
    _Static_assert(sizeof(record) <= FE__LARGEST_RECORD, "there is room for each record"); \
    _Static_assert(_Alignof(record) <= FE__RECORD_ALIGNMENT, "it lies as it must");        \
    FE__IS_WHOLE(record, list);                                                            \
    enum { name##_size = 0 list(record, FE__STATE_SIZE, FE__NO_FIELD, FE__NO_FIELD) };     \
    static void put_##name(const fe__rows_block *block, int32_t rows, unsigned char *out)  \
    {                                                                                      \
        for (int32_t i = 0; i < rows; ++i) {                                               \
            const record *r = block->records[i];                                           \
            list(record, PUT, FE__NO_FIELD, FE__NO_FIELD)                                  \
        }                                                                                  \
    }                                                                                      \
    static void take_##name(const unsigned char *in, fe_handle number, void *room)         \
    {                                                                                      \
        record *r = room;                                                                  \
        list(record, TAKE, FE__NO_FIELD, FE__NO_FIELD)(void) in, (void)number;             \
    }                                                                                      \
    static uint32_t doubt_##name(const unsigned char *in, int32_t rows)                    \
    {                                                                                      \
        const record *r = NULL;                                                            \
        uint32_t doubts = 0;                                                               \
        for (int32_t i = 0; i < rows; ++i) {                                               \
            list(record, DOUBT, FE__NO_FIELD, FE__NO_FIELD)                                \
        }                                                                                  \
        (void)r;                                                                           \
        return doubts >> 31;                                                               \
    }                                                                                      \
    _Static_assert(name##_size > 0 && name##_size % 4 == 0, #name " are whole words, as differences need")

DEFINE(world_fields, fe__world_row, WORLD);
DEFINE(slot_fields, fe__id_slot, SLOT);
DEFINE(body_fields, fe__body, BODY);
DEFINE(drift_fields, fe__drift, DRIFT);
DEFINE(shape_fields, fe__shape, SHAPE);
DEFINE(form_fields, fe__form_numbers, FORM);
DEFINE(asset_fields, fe__asset_row, ASSET);
DEFINE(joint_fields, fe__joint_record, JOINT);
DEFINE(anchor_fields, fe__joint, JOINT_ANCHOR);
DEFINE(frame_fields, fe__joint_frame, JOINT_FRAME);
DEFINE(reaction_fields, fe__joint_reaction, REACTION);
DEFINE(axes_fields, fe__joint_axes, AXES);
DEFINE(pair_fields, fe__pair, PAIR);
DEFINE(found_fields, fe__contact, FOUND);
DEFINE(patch_fields, fe__patch_row, PATCH);
DEFINE(touching_fields, fe__touching_row, TOUCHING);
DEFINE(points_fields, fe__points, POINTS);
DEFINE(feature_fields, fe__features, FEATURES);
DEFINE(extra_fields, fe__extra, EXTRA);
DEFINE(listed_fields, fe__slot_row, LISTED);
DEFINE(owed_fields, fe__owed_row, OWED);
DEFINE(deferral_fields, fe__deferral_row, DEFERRAL);
DEFINE(ignore_fields, fe__ignore_row, IGNORE);
DEFINE(encounter_fields, fe__encounter_row, ENCOUNTER);
DEFINE(pair_event_fields, fe__pair_event_record, PLAIN_PAIR_EVENT);
DEFINE(body_event_fields, fe__body_event_record, BODY_EVENT);
DEFINE(hit_event_fields, fe__hit_event_record, HIT_EVENT);
DEFINE(joint_event_fields, fe__joint_event_record, JOINT_EVENT);
DEFINE(tree_fields, fe__tree, TREE);
DEFINE(node_fields, fe__tree_node, NODE);

// Of each type of joint, the words behind the front
#define SETTINGS(name, def)                                                                                     \
    enum { name##_size = sizeof(def) - FE__JOINT_FRONT };                                                       \
    static const fe__field name[] = {                                                                           \
        {"setting", 0, FE__U32, FE__RANGE_ANY, (uint16_t)(name##_size / sizeof(uint32_t))}};                    \
    static void put_##name(const fe__rows_block *block, int32_t rows, unsigned char *out)                       \
    {                                                                                                           \
        for (int32_t i = 0; i < rows; ++i) out = fe__put_numbers(out, block->records[i], name##_size, FE__U32); \
    }                                                                                                           \
    static void take_##name(const unsigned char *in, fe_handle number, void *record)                            \
    {                                                                                                           \
        (void)fe__take_numbers(in, record, name##_size, FE__U32, number);                                       \
    }                                                                                                           \
    static uint32_t doubt_##name(const unsigned char *in, int32_t rows) { return (void)in, (void)rows, 0; }
SETTINGS(distance_fields, fe_distance_joint_def)
SETTINGS(ball_fields, fe_ball_joint_def)
SETTINGS(hinge_fields, fe_hinge_joint_def)
SETTINGS(fixed_fields, fe_fixed_joint_def)
SETTINGS(configurable_fields, fe_configurable_joint_def)

#define ROWS(name, fields, rows, is_beside)                                                          \
    {                                                                                                \
        name, fields, sizeof(fields) / sizeof *(fields), fields##_size, is_beside, fe__count_##rows, \
            fe__gather_##rows, fe__find_##rows, put_##fields, take_##fields, doubt_##fields          \
    }
#define TABLE(name, fields, rows) ROWS(name, fields, rows, 0)
#define BESIDE(name, fields, rows) ROWS(name, fields, rows, 1)

const fe__table fe__tables[FE__TABLES] = {
    [FE__TABLE_WORLD] = TABLE("world", world_fields, world),
    [FE__TABLE_BODY_SLOTS] = TABLE("body slots", slot_fields, body_slots),
    [FE__TABLE_SHAPE_SLOTS] = TABLE("shape slots", slot_fields, shape_slots),
    [FE__TABLE_JOINT_SLOTS] = TABLE("joint slots", slot_fields, joint_slots),
    [FE__TABLE_BODIES] = TABLE("bodies", body_fields, bodies),
    [FE__TABLE_DRIFTS] = BESIDE("drifts", drift_fields, drifts),
    [FE__TABLE_SHAPES] = TABLE("shapes", shape_fields, shapes),
    [FE__TABLE_FORMS] = BESIDE("forms", form_fields, forms),
    [FE__TABLE_ASSETS] = TABLE("assets", asset_fields, assets),
    [FE__TABLE_JOINTS] = TABLE("joints", joint_fields, joints),
    [FE__TABLE_DISTANCE_JOINTS] = TABLE("distance joints", distance_fields, distance_joints),
    [FE__TABLE_BALL_JOINTS] = TABLE("ball joints", ball_fields, ball_joints),
    [FE__TABLE_HINGE_JOINTS] = TABLE("hinge joints", hinge_fields, hinge_joints),
    [FE__TABLE_FIXED_JOINTS] = TABLE("fixed joints", fixed_fields, fixed_joints),
    [FE__TABLE_CONFIGURABLE_JOINTS] = TABLE("configurable joints", configurable_fields, configurable_joints),
    [FE__TABLE_JOINT_ANCHORS] = TABLE("joint anchors", anchor_fields, joint_anchors),
    [FE__TABLE_JOINT_FRAMES] = BESIDE("joint frames", frame_fields, joint_frames),
    [FE__TABLE_JOINT_REACTIONS] = BESIDE("joint reactions", reaction_fields, joint_reactions),
    [FE__TABLE_JOINT_AXES] = TABLE("joint axes", axes_fields, joint_axes),
    [FE__TABLE_PAIRS] = TABLE("pairs", pair_fields, pairs),
    [FE__TABLE_FOUND] = BESIDE("contacts", found_fields, found),
    [FE__TABLE_PATCHES] = TABLE("patches", patch_fields, patches),
    [FE__TABLE_TOUCHING] = TABLE("touching pairs", touching_fields, touching),
    [FE__TABLE_POINTS] = BESIDE("points", points_fields, points),
    [FE__TABLE_FEATURES] = BESIDE("features", feature_fields, features),
    [FE__TABLE_EXTRAS] = BESIDE("extras", extra_fields, extras),
    [FE__TABLE_FREE_PAIRS] = TABLE("free pairs", listed_fields, free_pairs),
    [FE__TABLE_OWED] = TABLE("owed exits", owed_fields, owed),
    [FE__TABLE_AWAKE_BODIES] = TABLE("awake bodies", listed_fields, awake_bodies),
    [FE__TABLE_AWAKE_PAIRS] = TABLE("awake pairs", listed_fields, awake_pairs),
    [FE__TABLE_DEFERRALS] = TABLE("deferred pairs", deferral_fields, deferrals),
    [FE__TABLE_AWAKE_JOINTS] = TABLE("awake joints", listed_fields, awake_joints),
    [FE__TABLE_PLANES] = TABLE("planes", listed_fields, planes),
    [FE__TABLE_IGNORES] = TABLE("ignored pairs", ignore_fields, ignores),
    [FE__TABLE_FREE_IGNORES] = TABLE("free ignored pairs", listed_fields, free_ignores),
    [FE__TABLE_ENCOUNTERS] = TABLE("encounters", encounter_fields, encounters),
    [FE__TABLE_FREE_ENCOUNTERS] = TABLE("free encounters", listed_fields, free_encounters),
    [FE__TABLE_PAIR_EVENTS] = TABLE("pair events", pair_event_fields, pair_events),
    [FE__TABLE_BODY_EVENTS] = TABLE("body events", body_event_fields, body_events),
    [FE__TABLE_HIT_EVENTS] = TABLE("hit events", hit_event_fields, hit_events),
    [FE__TABLE_JOINT_EVENTS] = TABLE("joint events", joint_event_fields, joint_events),
    [FE__TABLE_TREES] = TABLE("trees", tree_fields, trees),
    [FE__TABLE_STATIC_NODES] = TABLE("nodes of the static tree", node_fields, static_nodes),
    [FE__TABLE_MOVING_NODES] = TABLE("nodes of the moving tree", node_fields, moving_nodes),
};
