// pair_list.c - see pair_list.h.
#include "world/pair_list.h"

// ---- of a body -----------------------------------------------------------------------------------------------------
// ---- lists ---------------------------------------------------------------------------------------------------------
static fe__link *link_of(fe_world *world, int32_t pair, int32_t body)
{
    return &world->pairs[pair].links[world->pairs[pair].body_a == body ? 0 : 1];
}

void fe__pair_add_to_list(fe_world *world, int32_t pair, int32_t index)
{
    fe__body *body = world->bodies + index;
    *link_of(world, pair, index) = (fe__link){body->first_contact, -1};
    if (body->first_contact >= 0) link_of(world, body->first_contact, index)->previous = pair;
    body->first_contact = pair;
}

void fe__pair_remove_from_list(fe_world *world, int32_t pair, int32_t index)
{
    fe__body *body = world->bodies + index;
    fe__link link = *link_of(world, pair, index);
    if (link.previous >= 0)
        link_of(world, link.previous, index)->next = link.next;
    else
        body->first_contact = link.next;
    if (link.next >= 0) link_of(world, link.next, index)->previous = link.previous;
}

// ---- of the awake --------------------------------------------------------------------------------------------------
void fe__pair_awaken(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].awake_index >= 0) return;
    world->pairs[pair].awake_index = world->awake_pair_count;
    world->awake_pairs[world->awake_pair_count++] = pair;
    if (world->pairs[pair].flags & FE__PAIR_LINKED) ++world->awake_linked_count, ++world->solver.unbuilt;
}

void fe__pair_retire(fe_world *world, int32_t pair)
{
    int32_t place = world->pairs[pair].awake_index;
    if (place < 0) return;
    if (world->pairs[pair].flags & FE__PAIR_LINKED) --world->awake_linked_count;
    int32_t last = --world->awake_pair_count;
    world->awake_pairs[place] = world->awake_pairs[last];
    world->deferrals[place] = world->deferrals[last];
    world->pairs[fe__pair_of(world->awake_pairs[place])].awake_index = place;
    world->pairs[pair].awake_index = -1;
}

static void end_deferral(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].awake_index >= 0) world->awake_pairs[world->pairs[pair].awake_index] = pair;
}

void fe__pair_look_once(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].flags & FE__PAIR_PATCH) return; // looked at with its head
    world->pairs[pair].flags |= FE__PAIR_ONCE;
    fe__pair_awaken(world, pair);
    end_deferral(world, pair);
}

// Without points: a gap was measured from the centre as it was
void fe__body_end_deferrals(fe_world *world, int32_t body)
{
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        end_deferral(world, pair);
        if (!(world->contacts[pair].point_count > 0.0f)) world->contacts[pair].surface.tolerance = 0.0f;
    }
}
