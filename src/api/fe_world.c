// fe_world.c - the API of pools: workers that worlds share.
#include "api/fe_world.h"

#include "api/check.h"
#include "core/fp_state.h"
#include "feather.h"
#include "recording/recorder.h"
#include "snapshot/history.h"
#include "step/stages.h"
#include "world/hash.h"
#include "world/filter.h"
#include "world/mass.h"
#include "world/proxies.h"
#include "world/shape.h"
#include "world/sleep.h"
#include "world/world.h"
#include "world/world_memory.h"

// ---- pool -----------------------------------------------------------------------------------------------------------

fe_result fe_pool_create(int32_t worker_count, fe_pool **out_pool)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(out_pool);
    FE_CHECK_INT(worker_count, 1, FE_MAX_WORKERS);
    fe_pool *pool = fe__pool_create(worker_count);
    if (!pool) return fe__fail(function, FE_ERROR_MEMORY, "no memory or no threads for %d workers", (int)worker_count);
    *out_pool = pool;
    return FE_OK;
}

fe_result fe_pool_destroy(fe_pool *pool)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(pool);
    int32_t users;
    fe_result result = fe__pool_try_destroy(pool, &users);
    if (result == FE_ERROR_STATE)
        return fe__fail(function, result, "the pool still serves %d worlds, destroy them first", (int)users);
    if (result == FE_ERROR_STALE) return fe__fail(function, result, "the pool is gone already");
    return FE_OK;
}

// ---- library --------------------------------------------------------------------------------------------------------
// These functions belong to no world.

uint32_t fe_version(void)
{
    return (uint32_t)FE_VERSION_MAJOR << 16 | (uint32_t)FE_VERSION_MINOR << 8 | (uint32_t)FE_VERSION_PATCH;
}

// ---- material -------------------------------------------------------------------------------------------------------
// The API of materials.

void fe_material_init(fe_material *material)
{
    if (material) *material = fe__default_material();
}

// ---- measure --------------------------------------------------------------------------------------------------------
// The API of what a world amounts to: energy, momentum, bounds, the stiffness in use.

// ---- energy and momentum -------------------------------------------------------------------------------------------

FE_DEFINE_EMPTY_INIT(fe_energy_init, fe_energy, energy)

fe_result fe_world_get_energy(const fe_world *world, fe_energy *out_energy)
{
    FE_READ(world);
    FE_CHECK_STRUCT_SIZE(out_energy);
    fe_energy energy = {.struct_size = sizeof energy};
    fe__fp_state fp = fe__fp_enter();
    fe__world_energy(world, &energy.kinetic, &energy.potential);
    fe__fp_leave(fp);
    fe__write_struct(out_energy, &energy, sizeof energy);
    return FE_OK;
}

fe_result fe_world_get_momentum(const fe_world *world, const fe_dvec3 *about, fe_dvec3 *out_linear,
                                fe_dvec3 *out_angular)
{
    FE_READ(world);
    FE_CHECK_DVEC3(about, FE_MAX_POSITION);
    FE_CHECK_POINTER(out_linear);
    FE_CHECK_POINTER(out_angular);
    fe__fp_state fp = fe__fp_enter();
    fe__world_momentum(world, *about, out_linear, out_angular);
    fe__fp_leave(fp);
    return FE_OK;
}

// ---- stiffness -----------------------------------------------------------------------------------------------------

fe_result fe_world_get_hertz(const fe_world *world, float dt, float *out_contact_hertz, float *out_joint_hertz)
{
    FE_READ(world);
    FE_CHECK_FLOAT(dt, 0.0f, FE_MAX_DT);
    FE_CHECK_POINTER(out_contact_hertz);
    FE_CHECK_POINTER(out_joint_hertz);
    *out_contact_hertz = world->tuning.contact_hertz;
    *out_joint_hertz = world->tuning.joint_hertz;
    if (fe__counted_dt(dt) == 0.0f) return FE_OK;
    fe__fp_state fp = fe__fp_enter();
    float rate = 1.0f / (dt / (float)world->substeps);
    *out_contact_hertz = fe__minf(*out_contact_hertz, FE__MOST_CONTACT_HERTZ * rate);
    *out_joint_hertz = fe__minf(*out_joint_hertz, FE__MOST_JOINT_HERTZ * rate);
    fe__fp_leave(fp);
    return FE_OK;
}

// ---- bounds --------------------------------------------------------------------------------------------------------

static fe_bounds public_bounds(const fe__bounds *b) { return (fe_bounds){b->low, b->high}; }

fe_result fe_world_get_bounds(const fe_world *world, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_bounds);
    fe__bounds bounds;
    fe__fp_state fp = fe__fp_enter();
    int32_t found = fe__body_bounds(world, -1, &bounds);
    fe__fp_leave(fp);
    if (!found) return fe__fail(function, FE_ERROR_STATE, "the world has no shapes, or planes only");
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}

fe_result fe_body_get_bounds(const fe_world *world, fe_body body, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_bounds);
    if (world->bodies[index].shape_count == 0)
        return fe__fail(function, FE_ERROR_STATE, "body 0x%llx has no shapes", body);
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0; shape = world->shapes[shape].next) {
        if (!fe__form_is_unbounded(&world->shapes[shape].form)) continue;
        return fe__fail(function, FE_ERROR_UNSUPPORTED, "body 0x%llx has a plane, which has no bounds", body);
    }
    fe__bounds bounds;
    fe__fp_state fp = fe__fp_enter();
    (void)fe__body_bounds(world, index, &bounds);
    fe__fp_leave(fp);
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}

fe_result fe_shape_get_bounds(const fe_world *world, fe_shape shape, fe_bounds *out_bounds)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_bounds);
    if (fe__form_is_unbounded(&world->shapes[index].form)) {
        return fe__fail(function, FE_ERROR_UNSUPPORTED, "shape 0x%llx is a plane, which has no bounds", shape);
    }
    fe__fp_state fp = fe__fp_enter();
    fe__bounds bounds = fe__whole_bounds(world, index);
    fe__fp_leave(fp);
    *out_bounds = public_bounds(&bounds);
    return FE_OK;
}

// ---- world ----------------------------------------------------------------------------------------------------------
// The API of worlds: creation, step, settings, counters.

// ---- creation ------------------------------------------------------------------------------------------------------

static fe_world_def default_world(void)
{
    return (fe_world_def){.struct_size = sizeof(fe_world_def),
                          .worker_count = 1,
                          .gravity = {0.0f, -9.81f, 0.0f},
                          .substeps = 8};
}

void fe_world_def_init(fe_world_def *def, uint32_t struct_size)
{
    fe_world_def defaults = default_world();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

fe_result fe__read_tasks(const char *function, const fe_task_system *tasks, fe_task_system *copy)
{
    FE_READ_STRUCT(tasks, copy);
    FE_CHECK_POINTER(copy->run);
    FE_CHECK_INT(copy->worker_count, 1, FE_MAX_WORKERS);
    return FE_OK;
}

fe_result fe__read_world_def(const char *function, const fe_world_def *def, fe__whole_def *whole)
{
    fe_world_def *full = &whole->def;
    *whole = (fe__whole_def){.def = default_world()};
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_INT(full->worker_count, 1, FE_MAX_WORKERS);
    FE_CHECK_VEC3(&full->gravity, FE_MAX_SPEED);
    FE_CHECK_INT(full->substeps, 1, FE_MAX_SUBSTEPS);
    FE_CHECK_INT(full->simd, FE_SIMD_AUTO, FE_SIMD_WASM);
    FE_CHECK_INT(full->number, 0, FE_ID_LAST_NUMBER);
    if (full->allocator) {
        FE_TRY(fe__read_allocator(function, full->allocator, &whole->allocator));
        full->allocator = &whole->allocator;
    }
    if (full->tasks) {
        FE_TRY(fe__read_tasks(function, full->tasks, &whole->tasks));
        full->tasks = &whole->tasks;
    }
    return FE_OK;
}

fe_result fe__report_creation(const char *function, const fe_world_def *def, fe_result result)
{
    if (result == FE_ERROR_UNSUPPORTED) {
        return fe__fail(function, result, "simd is %d, a set that this CPU or this build does not have",
                        (int)def->simd);
    }
    if (result == FE_ERROR_STALE) {
        const char *gone = def->pool && !fe__pool_lives(def->pool) ? "pool" : "store";
        return fe__fail(function, result, "%s was destroyed before the world was created", gone);
    }
    if (result == FE_ERROR_ARGUMENT)
        return fe__fail(function, result, "store is another world's own; give both one of fe_store_create");
    return fe__report(function, result);
}

fe_result fe__create_world(const char *function, const fe_world_def *def, fe_world **out_world)
{
    FE_CHECK_POINTER(out_world);
    fe__whole_def whole;
    FE_TRY(fe__read_world_def(function, def, &whole));
    return fe__report_creation(function, &whole.def, fe__world_create(&whole.def, NULL, out_world));
}

fe_result fe_world_create(const fe_world_def *def, fe_world **out_world)
{
    fe_world *world;
    FE_TRY(fe__create_world(__func__, def, out_world ? &world : NULL));
    *out_world = world;
    fe__owner_leave(&world->owner);
    return FE_OK;
}

fe_result fe_world_destroy(fe_world *world)
{
    FE_WRITE(world);
    if (world->batch)
        return fe__fail(function, FE_ERROR_STATE, "the world is one of a batch: it goes with fe_batch_destroy");
    if (!fe__owner_be_alone(inside, FE__CLOSING)) {
        return fe__refuse_writer(function);
    }
    inside = NULL; // its word goes with it
    if (world->recorder) fe__recorder_detach(world->recorder, FE_END);
    fe__histories_end(world);
    fe__world_destroy(world);
    return FE_OK;
}

// ---- the step ------------------------------------------------------------------------------------------------------

fe_result fe_world_step(fe_world *world, float dt)
{
    FE_WRITE(world);
    FE_CHECK_FLOAT(dt, 0.0f, FE_MAX_DT);
    if (!fe__owner_be_alone(inside, FE__STEP)) {
        return fe__refuse_writer(function);
    }
    if (world->recorder) fe__record_step_begin(world->recorder);
    inside->entries -= (uint64_t)fe__world_rests(world); // nothing is written then
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__world_step(world, fe__counted_dt(dt));
    if (world->recorder) fe__record_step_end(world->recorder, dt, result);
    fe__fp_leave(fp);
    return fe__report(function, result);
}

// ---- settings ------------------------------------------------------------------------------------------------------

fe_result fe_world_set_gravity(fe_world *world, const fe_vec3 *gravity)
{
    FE_WRITE(world);
    FE_CHECK_VEC3(gravity, FE_MAX_SPEED);
    fe__world_set_gravity(world, *gravity);
    FE_RECORD(world_set_gravity, gravity);
    return FE_OK;
}

fe_result fe_world_get_gravity(const fe_world *world, fe_vec3 *out_gravity)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_gravity);
    *out_gravity = world->gravity;
    return FE_OK;
}

fe_result fe_world_set_substeps(fe_world *world, int32_t substeps)
{
    FE_WRITE(world);
    FE_CHECK_INT(substeps, 1, FE_MAX_SUBSTEPS);
    world->substeps = substeps;
    FE_RECORD(world_set_substeps, substeps);
    return FE_OK;
}

fe_result fe_world_get_substeps(const fe_world *world, int32_t *out_substeps)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_substeps);
    *out_substeps = world->substeps;
    return FE_OK;
}

fe_result fe_world_set_user_data(fe_world *world, uint64_t user_data)
{
    FE_WRITE(world);
    world->user_data = user_data;
    FE_RECORD(world_set_user_data, user_data);
    return FE_OK;
}

fe_result fe_world_get_number(const fe_world *world, uint32_t *out_number)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_number);
    *out_number = (uint32_t)world->number;
    return FE_OK;
}

fe_result fe_world_get_user_data(const fe_world *world, uint64_t *out_user_data)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_user_data);
    *out_user_data = world->user_data;
    return FE_OK;
}

void fe_world_tuning_init(fe_world_tuning *tuning, uint32_t struct_size)
{
    fe_world_tuning defaults = fe__default_tuning();
    fe__init_struct(tuning, &defaults, sizeof defaults, struct_size);
}

fe_result fe__check_tuning(const char *function, const fe_world_tuning *copy)
{
    FE_CHECK_FLOAT(copy->contact_hertz, FE_LEAST_VALUE, FE_MAX_VALUE);
    FE_CHECK_FLOAT(copy->contact_damping_ratio, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(copy->contact_push_speed, 0.0f, FE_MAX_SPEED);
    FE_CHECK_FLOAT(copy->joint_hertz, FE_LEAST_VALUE, FE_MAX_VALUE);
    FE_CHECK_FLOAT(copy->joint_damping_ratio, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(copy->restitution_threshold, 0.0f, FE_MAX_SPEED);
    FE_CHECK_FLOAT(copy->hit_event_threshold, 0.0f, FE_MAX_SPEED);
    FE_CHECK_FLOAT(copy->sleep_time, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(copy->speculative_distance, 0.001f, 0.1f);
    FE_CHECK_FLOAT(copy->max_linear_speed, FE_LEAST_VALUE, FE_MAX_SPEED);
    FE_CHECK_BOOL(copy->sleep_enabled);
    FE_CHECK_BOOL(copy->continuous_enabled);
    FE_CHECK_BOOL(copy->warm_start_enabled);
    return FE_OK;
}

// The boxes of the broad phase reach as far as contacts do.
static void renew_boxes(fe_world *world)
{
    for (int32_t body = world->first_body; body >= 0; body = world->bodies[body].order_next) {
        for (int32_t shape = world->bodies[body].first_shape; shape >= 0; shape = world->shapes[shape].next)
            fe__shape_touch(world, shape);
    }
}

fe_result fe_world_set_tuning(fe_world *world, const fe_world_tuning *tuning)
{
    FE_WRITE_ALONE(world);
    fe_world_tuning copy = world->tuning;
    FE_READ_STRUCT(tuning, &copy);
    FE_TRY(fe__check_tuning(function, &copy));
    int32_t same_reach = copy.speculative_distance == world->tuning.speculative_distance;
    if (copy.joint_hertz != world->tuning.joint_hertz)
        world->joints.forest.changed = world->solver.graph_changed = 1; // what is a spring
    int32_t wakes = world->tuning.sleep_enabled && !copy.sleep_enabled;
    world->tuning = copy;
    if (wakes) fe__world_wake_all(world);
    if (!same_reach) {
        fe__fp_state fp = fe__fp_enter();
        renew_boxes(world);
        fe__fp_leave(fp);
    }
    FE_RECORD(world_set_tuning, tuning);
    return FE_OK;
}

fe_result fe_world_get_tuning(const fe_world *world, fe_world_tuning *out_tuning)
{
    FE_READ(world);
    FE_CHECK_STRUCT_SIZE(out_tuning);
    fe__write_struct(out_tuning, &world->tuning, sizeof world->tuning);
    return FE_OK;
}

fe_result fe_world_ignore_collision(fe_world *world, fe_body a, fe_body b, int32_t ignore)
{
    FE_WRITE_ALONE(world);
    FE_FIND_BODY(index_a, a);
    FE_FIND_BODY(index_b, b);
    FE_CHECK_BOOL(ignore);
    if (a == b) return fe__fail(function, FE_ERROR_ARGUMENT, "a and b are the same body 0x%llx", a);
    FE_TRY(fe__report(function, fe__ignore_collision(world, index_a, index_b, ignore)));
    FE_RECORD(world_ignore_collision, a, b, ignore);
    return FE_OK;
}

fe_result fe_world_set_pair_filter(fe_world *world, fe_pair_filter filter, void *user)
{
    FE_WRITE_ALONE(world);
    world->pair_filter = filter;
    world->pair_filter_user = user;
    fe__world_judge_anew(world);
    if (world->recorder) fe__record_filter(world->recorder);
    return FE_OK;
}

fe_result fe_world_get_ignored(const fe_world *world, fe_body a, fe_body b, int32_t *out_ignored)
{
    FE_READ(world);
    FE_FIND_BODY(index_a, a);
    FE_FIND_BODY(index_b, b);
    FE_CHECK_POINTER(out_ignored);
    if (a == b) return fe__fail(function, FE_ERROR_ARGUMENT, "a and b are the same body 0x%llx", a);
    *out_ignored = fe__pair_set_find(&world->ignored, index_a, index_b) >= 0;
    return FE_OK;
}

fe_result fe_world_optimize(fe_world *world)
{
    FE_WRITE_ALONE(world);
    fe__fp_state fp = fe__fp_enter();
    fe__tree *trees[] = {&world->static_tree, &world->moving_tree};
    int32_t built = fe__trees_rebuild(trees, 2, &world->memory, 1);
    fe__fp_leave(fp);
    FE_TRY(built ? FE_OK : fe__report(function, FE_ERROR_MEMORY));
    if (world->recorder) fe__record_world_optimize(world->recorder);
    return FE_OK;
}

// ---- the defaults of what is read into, and of what the host gives -------------------------------------------------

FE_DEFINE_EMPTY_INIT(fe_allocator_init, fe_allocator, allocator)
FE_DEFINE_EMPTY_INIT(fe_profile_init, fe_profile, profile)
FE_DEFINE_EMPTY_INIT(fe_counters_init, fe_counters, counters)

void fe_task_system_init(fe_task_system *tasks, uint32_t struct_size)
{
    fe_task_system defaults = {.struct_size = sizeof defaults, .worker_count = 1};
    fe__init_struct(tasks, &defaults, sizeof defaults, struct_size);
}

// ---- measures ------------------------------------------------------------------------------------------------------

fe_result fe_world_get_profile(const fe_world *world, fe_profile *out_profile)
{
    FE_READ(world);
    FE_CHECK_STRUCT_SIZE(out_profile);
    fe__write_struct(out_profile, &world->profile, sizeof world->profile);
    return FE_OK;
}

// The step's own counts are its last ones; what calls between steps change is counted now.
fe_result fe_world_get_counters(const fe_world *world, fe_counters *out_counters)
{
    FE_READ(world);
    FE_CHECK_STRUCT_SIZE(out_counters);
    fe_counters c = world->counters;
    c.bodies = world->body_count;
    c.shapes = world->shape_count - world->part_count;
    c.joints = world->joint_count;
    c.awake_bodies = world->awake_body_count;
    c.pairs = world->pair_count - world->part_pair_count + world->encounter_count;
    c.contacts = world->linked_count;
    c.simd = world->simd;
    c.simd_width = world->kernels->width;
    c.workers = world->workers.count;
    c.bytes = world->memory.bytes;
    c.allocations = world->memory.allocations;
    fe__write_struct(out_counters, &c, sizeof c);
    return FE_OK;
}

fe_result fe_world_hash(const fe_world *world, uint32_t *out_words)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_words);
    uint64_t hash = fe__world_hash(world);
    out_words[0] = (uint32_t)hash;
    out_words[1] = (uint32_t)(hash >> 32);
    return FE_OK;
}

int32_t fe_world_get_bodies(const fe_world *world, fe_body *out_bodies, int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_ARRAY(out_bodies, capacity);
    int32_t count = 0;
    for (int32_t body = world->first_body; body >= 0 && count < capacity; body = world->bodies[body].order_next) {
        out_bodies[count++] = fe__body_handle(world, body);
    }
    return world->body_count;
}

fe_result fe_world_get_store(const fe_world *world, fe_store **out_store)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_store);
    *out_store = world->store;
    return FE_OK;
}
