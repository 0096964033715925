// workroom.c - see workroom.h.
#include "world/workroom.h"

#include "solver/graph/graph.h"
#include "world/step_scratch.h"

// The solver's memory changes hands; what it knows of a world stays with that
static void exchange(fe__solver *mine, fe__solver *of_world)
{
    int32_t burdened = of_world->burdened;
    fe__solver lent = *mine;
    *mine = *of_world;
    *of_world = lent;
    of_world->burdened = burdened;
}

static void forget_graph(fe_world *world)
{
    fe__graph_forget(&world->solver);
    world->solver.unbuilt = world->awake_linked_count;
}

void fe__workroom_lend(fe__workroom *room, fe_world *world)
{
    fe__step_scratch_free(world->scratch, world->step_memory);
    fe__solver_destroy(&world->solver, world->step_memory);
    exchange(&room->solver, &world->solver);
    forget_graph(world);
    world->step_memory = room->memory;
    world->scratch = room->scratch, room->scratch = NULL;
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1);
}

void fe__workroom_take_back(fe__workroom *room, fe_world *world)
{
    room->scratch = world->scratch, world->scratch = NULL;
    exchange(&room->solver, &world->solver);
    forget_graph(world);
    world->step_memory = &world->memory;
}

void fe__workroom_free(fe__workroom *room)
{
    fe__step_scratch_free(room->scratch, room->memory);
    fe__solver_destroy(&room->solver, room->memory);
    room->scratch = NULL;
}
