// arrays.c - see arrays.h.
#include "world/arrays.h"

#include <string.h>

#define AT(member) offsetof(fe_world, member)
#define SIZE(member) sizeof(*((fe_world *)0)->member)
#define ARRAY(elements, room, count)                            \
    {                                                           \
        AT(elements), AT(room), SIZE(elements), AT(count), 0, 0 \
    }
// All of it: a table whose empty places count, too
#define WHOLE(elements, room) ARRAY(elements, room, room)
#define SLOTS(pool) ARRAY(pool.slots, pool.capacity, pool.slot_count)
#define RECORDS(pool)                                                            \
    {                                                                            \
        AT(pool.records), AT(pool.capacity), 1, AT(pool.limit), AT(pool.size), 0 \
    }
#define JOINTS(elements, room)                                                 \
    {                                                                          \
        AT(elements), AT(room), SIZE(elements), AT(joint_ids.slot_count), 0, 1 \
    }

const fe__array fe__arrays[FE__ARRAYS] = {
    SLOTS(body_ids),
    ARRAY(bodies, body_capacity, body_ids.slot_count),
    ARRAY(odometers, odometer_capacity, body_ids.slot_count),
    ARRAY(drifts, drift_capacity, body_ids.slot_count),
    SLOTS(shape_ids),
    ARRAY(shapes, shape_capacity, shape_ids.slot_count),
    ARRAY(uses, use_capacity, use_count),

    ARRAY(contacts, contact_capacity, pair_limit),
    ARRAY(pairs, pair_capacity, pair_limit),
    WHOLE(points, point_capacity),
    WHOLE(features, feature_capacity),
    WHOLE(point_serials, point_serial_capacity),
    WHOLE(extras, extra_capacity),
    WHOLE(point_order, point_order_capacity),
    WHOLE(pair_set.entries, pair_set.capacity),
    WHOLE(encounter_set.entries, encounter_set.capacity),
    RECORDS(encounters),
    WHOLE(ignored.entries, ignored.capacity),
    RECORDS(ignores),

    SLOTS(joint_ids),
    JOINTS(joints.joints, joint_capacity[0]),
    JOINTS(joints.frames, joint_capacity[1]),
    JOINTS(joints.reactions, joint_capacity[2]),
    JOINTS(joint_records, joint_capacity[3]),
    RECORDS(joint_axes),
    RECORDS(joint_settings[FE_JOINT_DISTANCE]),
    RECORDS(joint_settings[FE_JOINT_BALL]),
    RECORDS(joint_settings[FE_JOINT_HINGE]),
    RECORDS(joint_settings[FE_JOINT_FIXED]),
    RECORDS(joint_settings[FE_JOINT_CONFIGURABLE]),

    ARRAY(awake_bodies, awake_body_capacity, awake_body_count),
    ARRAY(awake_pairs, awake_pair_capacity, awake_pair_count),
    ARRAY(deferrals, deferral_capacity, awake_pair_count),
    ARRAY(awake_joints, awake_joint_capacity, awake_joint_count),

    ARRAY(static_tree.nodes, static_tree.node_capacity, static_tree.node_count),
    WHOLE(static_tree.slot, static_tree.slot_capacity),
    ARRAY(moving_tree.nodes, moving_tree.node_capacity, moving_tree.node_count),
    WHOLE(moving_tree.slot, moving_tree.slot_capacity),
    ARRAY(planes, plane_capacity, plane_count),
    ARRAY(moved, moved_capacity, moved_count),

    ARRAY(pair_events, pair_event_capacity, pair_event_count),
    ARRAY(body_events, body_event_capacity, body_event_count),
    ARRAY(disturbed, disturbed_capacity, disturbed_count),
    ARRAY(hit_events, hit_event_capacity, hit_event_count),
    ARRAY(joint_events, joint_event_capacity, joint_event_count),
};

#define RANGE(from, to)                                \
    {                                                  \
        AT(from), AT(to) + sizeof(((fe_world *)0)->to) \
    }
const fe__members fe__state_members[FE__MEMBERS] = {
    RANGE(user_data, number),           RANGE(gravity, tuning),
    RANGE(body_ids, shape_capacity),    RANGE(uses, use_capacity),
    RANGE(next_serial, swiftest),       RANGE(pair_set, joints.most),
    RANGE(joint_records, joint_events), RANGE(joint_event_count, joint_event_capacity),
    RANGE(step_number, last_dt),
};

// A pointer of any type, as bytes: a T* may not be accessed as a void*
void *fe__array_get(const fe_world *world, const fe__array *array)
{
    void *elements;
    memcpy(&elements, (const unsigned char *)world + array->pointer, sizeof elements);
    return elements;
}

void fe__array_set(fe_world *world, const fe__array *array, void *elements)
{
    memcpy((unsigned char *)world + array->pointer, &elements, sizeof elements);
}

int64_t fe__array_capacity(const fe_world *world, const fe__array *array)
{
    return fe__int_at(world, array->capacity) * (int64_t)array->size;
}

int64_t fe__array_used(const fe_world *world, const fe__array *array)
{
    int64_t count = fe__int_at(world, array->used), capacity = fe__array_capacity(world, array);
    int64_t each = array->each ? fe__int_at(world, array->each) : 1;
    int64_t used = (count * each + array->more) * (int64_t)array->size;
    return used < capacity ? used : capacity; // record 0 counts before there is memory for it
}

void fe__arrays_free(fe_world *world)
{
    for (int32_t i = 0; i < FE__ARRAYS; ++i) {
        const fe__array *array = fe__arrays + i;
        fe__release(&world->memory, fe__array_get(world, array), (size_t)fe__array_capacity(world, array));
        fe__array_set(world, array, NULL);
        const int32_t none = 0;
        memcpy((unsigned char *)world + array->capacity, &none, sizeof none);
    }
}
