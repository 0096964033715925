// world_memory.c - the world's memory: all of it is made and given back here.
//
// Called by the API layer. A new world holds nothing but itself: its arrays grow with what it is given.
#include "world/world_memory.h"

#include "collision/cast/mesh_ray.h"
#include "solver/graph/graph.h"
#include "world/asset_users.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/joint_creation.h"

#include <string.h>

// ---- lifetime -------------------------------------------------------------------------------------------------------

fe_world_tuning fe__default_tuning(void)
{
    return (fe_world_tuning){.struct_size = sizeof(fe_world_tuning),
                             .contact_hertz = 30.0f,
                             .contact_damping_ratio = 10.0f,
                             .contact_push_speed = 3.0f,
                             .joint_hertz = 60.0f,
                             .joint_damping_ratio = 2.0f,
                             .restitution_threshold = 1.0f,
                             .hit_event_threshold = 1.0f,
                             .sleep_time = 0.5f,
                             .speculative_distance = 0.02f,
                             .max_linear_speed = 4000.0f,
                             .sleep_enabled = 1,
                             .continuous_enabled = 1,
                             .warm_start_enabled = 1};
}

fe_result fe__world_create(const fe_world_def *def, const fe_world *source, fe_world **out_world)
{
    const fe__kernels *kernels = fe__kernels_of(def->simd);
    if (!kernels) return FE_ERROR_UNSUPPORTED;
    fe__memory memory;
    fe__memory_init(&memory, def->allocator);
    fe_world *world = fe__allocate(&memory, sizeof *world);
    if (!world) return FE_ERROR_MEMORY;
    world->memory = memory;
    fe__owner_enter(&world->owner);
    world->step_memory = &world->memory;
    world->kernels = kernels;
    world->simd = kernels->simd;
    world->static_tree.kernels = world->moving_tree.kernels = fe__tree_kernels_of(kernels->simd);
    world->mesh_casts = fe__mesh_casts_of(kernels->simd);
    world->gravity = def->gravity;
    world->substeps = def->substeps;
    world->number = def->number ? (int32_t)def->number : fe__id_draw_number();
    world->user_data = def->user_data;
    world->tuning = fe__default_tuning();
    fe__id_pool_init(&world->body_ids, FE_KIND_BODY, world->number);
    fe__id_pool_init(&world->shape_ids, FE_KIND_SHAPE, world->number);
    fe__joints_init(world);
    fe__record_pool_init(&world->ignores, sizeof(fe__ignore));
    fe__record_pool_init(&world->encounters, sizeof(fe__encounter));
    world->next_serial = 1;
    world->first_body = world->last_body = world->first_free_pair = -1;
    world->pair_limit = 1; // contact 0 is no contact
    atomic_store(&world->point_count, 1);
    fe_result result = fe__workers_hire(&world->workers, def->tasks, def->pool, def->worker_count);
    if (result == FE_OK) result = fe__world_open_store(world, def, source);
    if (result != FE_OK) {
        fe__world_destroy(world);
        return result;
    }
    *out_world = world;
    return FE_OK;
}

void fe__world_free_state(fe_world *world)
{
    fe__clusters_free(&world->clusters, &world->memory);
    fe__forest_free(&world->joints.forest, &world->memory);
    fe__arrays_free(world);
}

void fe__world_destroy(fe_world *world)
{
    fe__step_scratch_free(world->scratch, world->step_memory);
    fe__solver_destroy(&world->solver, world->step_memory);
    fe__world_close_store(world);
    fe__world_free_state(world);
    fe__workers_dismiss(&world->workers);
    fe__memory memory = world->memory;
    fe__release(&memory, world, sizeof *world);
}

// ---- arrays ---------------------------------------------------------------------------------------------------------

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

// ---- step scratch ---------------------------------------------------------------------------------------------------

int32_t fe__open_step_scratch(fe_world *world)
{
    if (world->scratch) return 1;
    world->scratch = fe__allocate(world->step_memory, sizeof *world->scratch);
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1); // the world may have deferred pairs
    return world->scratch != NULL;
}

void fe__step_scratch_free(fe__step_scratch *s, fe__memory *memory)
{
    if (!s) return;
    FE_FREE(memory, s->candidates, s->candidate_capacity);
    FE_FREE(memory, s->moved_bits, s->moved_words);
    FE_FREE(memory, s->heaps, s->heap_capacity);
    FE_FREE(memory, s->ranked_pairs, s->ranked_capacity);
    FE_FREE(memory, s->is_buried, s->is_buried_capacity);
    FE_FREE(memory, s->buried, s->buried_capacity);
    FE_FREE(memory, s->results, s->result_capacity);
    FE_FREE(memory, s->active, s->active_capacity);
    FE_FREE(memory, s->left, s->left_capacity);
    FE_FREE(memory, s->boxes, s->box_capacity);
    FE_FREE(memory, s->swept, s->swept_capacity);
    FE_FREE(memory, s->sweep_ends, s->sweep_end_capacity);
    FE_FREE(memory, s->island_timers, s->island_capacity);
    fe__release(memory, s, sizeof *s);
}

// ---- workroom -------------------------------------------------------------------------------------------------------

// The solvers change places, but for `burdened`, which is state of the world. The graph is the other world's.
static void exchange_solvers(fe__workroom *room, fe_world *world)
{
    int32_t burdened = world->solver.burdened;
    fe__solver lent = room->solver;
    room->solver = world->solver;
    world->solver = lent;
    world->solver.burdened = burdened;
    fe__graph_forget(&world->solver);
    world->solver.unbuilt = world->awake_linked_count;
}

void fe__workroom_lend(fe__workroom *room, fe_world *world)
{
    fe__step_scratch_free(world->scratch, world->step_memory);
    fe__solver_destroy(&world->solver, world->step_memory);
    exchange_solvers(room, world);
    world->step_memory = room->memory;
    world->scratch = room->scratch, room->scratch = NULL;
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1);
}

void fe__workroom_take_back(fe__workroom *room, fe_world *world)
{
    room->scratch = world->scratch, world->scratch = NULL;
    exchange_solvers(room, world);
    world->step_memory = &world->memory;
}

void fe__workroom_free(fe__workroom *room)
{
    fe__step_scratch_free(room->scratch, room->memory);
    fe__solver_destroy(&room->solver, room->memory);
    room->scratch = NULL;
}
