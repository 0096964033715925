// state.c - see state.h.
#include "snapshot/state.h"

#include "world/world_memory.h"
#include "world/shape.h"

static fe__registry states = {.lock = FE_MUTEX_INITIAL};

// memory: of the block; editions: see fe__held_fill. NULL: no memory
static fe__held *take(const fe_world *world, fe__memory *memory, fe__memory *editions)
{
    int64_t size = fe__held_size(world);
    fe__held *held = fe__allocate_scratch(memory, (size_t)size);
    if (!held) return NULL;
    held->size = size;
    if (fe__held_fill(held, world, editions, NULL)) return held;
    fe__release(memory, held, (size_t)size);
    return NULL;
}

static void drop(fe__held *held, fe_store *store, fe__memory *memory)
{
    fe__held_forget_assets(held, store, memory);
    fe__release(memory, held, (size_t)held->size);
}

fe_result fe__state_create(const fe_world *world, const fe_allocator *allocator, fe_state **out_state)
{
    fe__memory memory;
    fe__memory_init(&memory, allocator);
    fe_state *state = fe__allocate(&memory, sizeof *state);
    if (!state) return FE_ERROR_MEMORY;
    state->memory = memory;
    state->store = world->store;
    state->held = take(world, &state->memory, &state->memory);
    if (!state->held) {
        memory = state->memory;
        fe__release(&memory, state, sizeof *state);
        return FE_ERROR_MEMORY;
    }
    fe__store_retain(state->store);
    fe__registry_add(&states, &state->entry);
    *out_state = state;
    return FE_OK;
}

void fe__state_destroy(fe_state *state)
{
    fe__registry_remove(&states, &state->entry);
    drop(state->held, state->store, &state->memory);
    fe__store_release(state->store);
    fe__memory memory = state->memory;
    fe__release(&memory, state, sizeof *state);
}

int32_t fe__state_lives(const fe_state *state) { return fe__registry_has(&states, &state->entry); }

// ---- clones --------------------------------------------------------------------------------------------------------
// What a player's world asks is that player
static void take_filter(fe_world *world, const fe_world *source)
{
    int32_t is_players = atomic_load_explicit(&source->owner.occupation, memory_order_relaxed) == FE__SHOWN;
    world->pair_filter = source->pair_filter, world->pair_filter_user = source->pair_filter_user;
    if (is_players && world->pair_filter) world->pair_filter = fe__accept_pair, world->pair_filter_user = NULL;
}

fe_result fe__world_create_as(const fe__held *held, const fe_world *source, const fe_world_def *def,
                              fe_world **out_world)
{
    fe_world *world;
    fe_result result = fe__world_create(def, source, &world);
    if (result != FE_OK) return result;
    result = fe__held_return(held, world);
    if (result != FE_OK) {
        fe__world_destroy(world);
        return result;
    }
    take_filter(world, source);
    *out_world = world;
    return FE_OK;
}

fe_result fe__world_clone(const fe_world *source, const fe_world_def *def, fe_world **out_world)
{
    fe__memory memory;
    fe__memory_init(&memory, def->allocator);
    fe__held *held = take(source, &memory, NULL);
    if (!held) return FE_ERROR_MEMORY;
    fe_result result = fe__world_create_as(held, source, def, out_world);
    drop(held, source->store, &memory);
    return result;
}
