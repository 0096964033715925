// step_scratch.c - see step_scratch.h.
#include "world/step_scratch.h"

int32_t fe__open_step_scratch(fe_world *world)
{
    if (!world->scratch) world->scratch = fe__allocate(&world->memory, sizeof *world->scratch);
    return world->scratch != NULL;
}

void fe__step_scratch_destroy(fe_world *w)
{
    fe__step_scratch *s = w->scratch;
    fe__memory *memory = &w->memory;
    if (!s) return;
    FE_FREE(memory, s->candidates, s->candidate_capacity);
    FE_FREE(memory, s->moved_bits, s->moved_words);
    FE_FREE(memory, s->crowd, s->crowd_capacity);
    FE_FREE(memory, s->favourites, s->favourite_capacity);
    FE_FREE(memory, s->results, s->result_capacity);
    FE_FREE(memory, s->busy, s->busy_capacity);
    FE_FREE(memory, s->left, s->left_capacity);
    FE_FREE(memory, s->boxes, s->box_capacity);
    FE_FREE(memory, s->chased, s->chased_capacity);
    FE_FREE(memory, s->chases, s->chase_capacity);
    FE_FREE(memory, s->island_timers, s->island_capacity);
    fe__release(memory, s, sizeof *s);
    w->scratch = NULL;
}
