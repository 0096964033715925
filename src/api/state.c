// state.c - the API of states in memory, and of clones.
#include "state/state.h"
#include "api/record.h"
#include "api/world.h"
#include "core/fp_state.h"

fe_result fe_state_create(const fe_world *world, const fe_allocator *allocator, fe_state **out_state)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_state);
    fe_allocator copy = {.struct_size = sizeof copy};
    if (allocator) FE_TRY(fe__read_allocator(function, allocator, &copy));
    return fe__report(function, fe__state_create(world, allocator ? &copy : NULL, out_state));
}

static fe_result check_state(const char *function, const fe_state *state)
{
    FE_CHECK_POINTER(state);
    return fe__state_lives(state) ? FE_OK : fe__fail(function, FE_ERROR_STALE, "the state is gone");
}

fe_result fe_state_destroy(fe_state *state)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_TRY(check_state(function, state));
    fe__state_destroy(state);
    return FE_OK;
}

fe_result fe_world_set_state(fe_world *world, const fe_state *state)
{
    FE_WRITE_ALONE(world);
    FE_TRY(check_state(function, state));
    if (state->store != world->store)
        return fe__fail(function, FE_ERROR_STATE, "the state is of a world that uses another store than this one");
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__held_return(state->held, world);
    fe__fp_leave(fp);
    if (result == FE_OK && world->recorder) fe__record_jump(world->recorder);
    return fe__report_return(function, result);
}

fe_result fe_world_clone(const fe_world *source, const fe_world_def *def, fe_world **out_world)
{
    const char *function = __func__;
    FE_CHECK_POINTER(source);
    FE_READ_AS(function, source);
    FE_CHECK_POINTER(out_world);
    fe__whole_def whole;
    FE_TRY(fe__read_world_def(function, def, &whole));
    if (whole.def.store && whole.def.store != source->store)
        return fe__fail(function, FE_ERROR_ARGUMENT, "store is another one than the source's, which a clone shares");
    fe_world *world;
    FE_TRY(fe__report_creation(function, &whole.def, fe__world_clone(source, &whole.def, &world)));
    *out_world = world;
    fe__owner_leave(&world->owner);
    return FE_OK;
}
