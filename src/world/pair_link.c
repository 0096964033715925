// pair_link.c - see pair_link.h.
#include "world/pair_link.h"

#include "solver/graph/colour.h"
#include "world/pair_list.h"

// A patch stands before its head in the bodies' lists, so that who walks them may destroy heads on the way.
static void enter_lists(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_add_to_list(world, patch, p->body_a);
    fe__pair_add_to_list(world, patch, p->body_b);
    if (world->pairs[p->head].awake_index >= 0) fe__pair_awaken(world, patch);
}

// A body that comes upon one so many times lighter strains it: its impact is not to find the island unprepared, see
// solve.c
#define UNEVEN 10.0f

static void note_uneven(fe__body *a, fe__body *b)
{
    float of_a = a->inverse_mass, of_b = b->inverse_mass; // 1/kg
    if (of_a > UNEVEN * of_b) a->flags |= FE__BODY_STRAINED;
    if (of_b > UNEVEN * of_a) b->flags |= FE__BODY_STRAINED;
}

static void note_colour(fe_world *world, const fe__contact *m)
{
    if (m->colour < FE__PAIR_COLOURS)
        world->pair_colours = fe__maxi(world->pair_colours, m->colour + 1);
    else if (m->colour != FE__OVERFLOW_COLOUR)
        world->static_colours = fe__maxi(world->static_colours, m->colour - FE__PAIR_COLOURS + 1);
}

void fe__pair_link(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    fe__colour_contact(world->bodies, m);
    if (m->kind & FE__ROW_PAIR) note_uneven(world->bodies + m->body_a, world->bodies + m->body_b);
    world->pairs[pair].flags |= FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    ++world->linked_count;
    note_colour(world, m);
    if (world->pairs[pair].awake_index >= 0) ++world->awake_linked_count, ++world->solver.unbuilt;
    if (world->pairs[pair].flags & FE__PAIR_PATCH) enter_lists(world, pair);
}

void fe__pair_forget_impulses(fe_world *world, int32_t pair)
{
    fe__contact_forget_impulses(world->contacts + pair);
    for (int k = 0; k < 3; ++k) world->extras[pair].rolling_impulse[k] = 0.0f;
}

void fe__pair_unlink(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    if (m->colour < 0) return;
    fe__uncolour_contact(world->bodies, m);
    fe__pair_forget_impulses(world, pair);
    world->pairs[pair].flags &= ~(uint32_t)FE__PAIR_LINKED;
    if (world->pairs[pair].awake_index >= 0) --world->awake_linked_count;
    world->solver.graph_changed = 1;
    --world->linked_count;
}

void fe__patch_leave(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_retire(world, patch);
    fe__pair_remove_from_list(world, patch, p->body_a);
    fe__pair_remove_from_list(world, patch, p->body_b);
}
