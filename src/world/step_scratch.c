// step_scratch.c - see step_scratch.h.
#include "world/step_scratch.h"

int32_t fe__open_step_scratch(fe_world *world)
{
    if (world->scratch) return 1;
    world->scratch = fe__allocate(world->step_memory, sizeof *world->scratch);
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1); // who knows what the world was
    return world->scratch != NULL;
}

void fe__step_scratch_free(fe__step_scratch *s, fe__memory *memory)
{
    if (!s) return;
    FE_FREE(memory, s->candidates, s->candidate_capacity);
    FE_FREE(memory, s->moved_bits, s->moved_words);
    FE_FREE(memory, s->crowd, s->crowd_capacity);
    FE_FREE(memory, s->favourites, s->favourite_capacity);
    FE_FREE(memory, s->is_buried, s->is_buried_capacity);
    FE_FREE(memory, s->buried, s->buried_capacity);
    FE_FREE(memory, s->results, s->result_capacity);
    FE_FREE(memory, s->busy, s->busy_capacity);
    FE_FREE(memory, s->left, s->left_capacity);
    FE_FREE(memory, s->boxes, s->box_capacity);
    FE_FREE(memory, s->chased, s->chased_capacity);
    FE_FREE(memory, s->chases, s->chase_capacity);
    FE_FREE(memory, s->island_timers, s->island_capacity);
    fe__release(memory, s, sizeof *s);
}
