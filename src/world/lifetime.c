// lifetime.c - the world's memory: all of it is made and given back here.
//
// Called by the API layer. A new world holds nothing but itself: its arrays grow with what it is given.
#include "world/lifetime.h"

#include "collision/cast/mesh_ray.h"
#include "solver/graph/graph.h"
#include "world/arrays.h"
#include "world/asset_users.h"
#include "world/encounter.h"
#include "world/forest.h"
#include "world/ignore.h"
#include "world/joints.h"
#include "world/step_scratch.h"

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
