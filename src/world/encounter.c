// encounter.c - see encounter.h.
#include "world/encounter.h"

#include "world/contact.h"

int32_t fe__reserve_encounters(fe_world *world, int32_t extra)
{
    if (!world->part_count) return 1;
    return fe__pair_set_reserve(&world->encounter_set, &world->memory, extra) &&
           fe__record_pool_reserve(&world->encounters, &world->memory, extra) == FE_OK;
}

static fe__encounter *encounter_at(const fe_world *world, int32_t index)
{
    return fe__record(&world->encounters, index);
}

static int32_t index_of(const fe_world *world, const fe__encounter *e)
{
    return (int32_t)(e - (const fe__encounter *)fe__record(&world->encounters, 0));
}

fe__encounter *fe__find_encounter(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    int32_t index = fe__pair_set_find(&world->encounter_set, fe__whole_shape(world->shapes, shape_a),
                                      fe__whole_shape(world->shapes, shape_b));
    return index >= 0 ? encounter_at(world, index) : NULL;
}

// ---- list of the encounters to report -------------------------------------------------------------------------------

void fe__encounter_note(fe_world *world, fe__encounter *e)
{
    if (e->listed) return;
    int32_t index = index_of(world, e);
    e->listed = 1;
    e->previous = 0;
    e->next = world->first_changed;
    if (e->next) encounter_at(world, e->next)->previous = index;
    world->first_changed = index;
}

void fe__encounter_reported(fe_world *world, fe__encounter *e)
{
    if (!e->listed) return;
    if (e->previous)
        encounter_at(world, e->previous)->next = e->next;
    else
        world->first_changed = e->next;
    if (e->next) encounter_at(world, e->next)->previous = e->previous;
    e->listed = e->next = e->previous = 0;
}

// ---- pairs ----------------------------------------------------------------------------------------------------------

// Another pair that touches, from the shorter list of the two bodies
static int32_t find_lead(const fe_world *world, const fe__encounter *e)
{
    int32_t a = world->shapes[e->shape_a].body, b = world->shapes[e->shape_b].body,
            body = world->bodies[a].contact_count < world->bodies[b].contact_count ? a : b;
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = world->pairs + pair;
        if (!(p->flags & FE__PAIR_PATCH) && p->flags & FE__PAIR_TOUCHING &&
            fe__is_of_whole(world, p->shape_a, e->shape_a) && fe__is_of_whole(world, p->shape_b, e->shape_b))
            return pair;
    }
    return 0;
}

void fe__encounter_touch(fe_world *world, int32_t pair, int32_t touches)
{
    fe__encounter *e = fe__encounter_of(world, pair);
    fe__pair *p = world->pairs + pair;
    p->flags = touches ? p->flags | FE__PAIR_TOUCHING : p->flags & ~(uint32_t)FE__PAIR_TOUCHING;
    e->touching += touches ? 1 : -1;
    if (touches && !e->lead) e->lead = pair;
    if (!touches && e->lead == pair) e->lead = e->touching ? find_lead(world, e) : 0;
    fe__encounter_note(world, e);
}

void fe__encounter_hold(fe_world *world, int32_t pair, int32_t holds)
{
    fe__encounter_of(world, pair)->held += holds ? 1 : -1;
}

void fe__encounter_pass(fe_world *world, int32_t pair, int32_t passes)
{
    fe__encounter_of(world, pair)->passing += passes ? 1 : -1;
}

void fe__encounter_gain(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    fe__encounter *e = fe__encounter_of(world, pair);
    if (!e) {
        int32_t index = fe__record_pool_take(&world->encounters);
        e = encounter_at(world, index);
        e->shape_a = fe__whole_shape(world->shapes, p->shape_a);
        e->shape_b = fe__whole_shape(world->shapes, p->shape_b);
        e->denied = (p->flags & FE__PAIR_DENIED) != 0;
        fe__pair_set_insert(&world->encounter_set, e->shape_a, e->shape_b, index);
        ++world->encounter_count;
    }
    ++e->pairs;
    ++world->part_pair_count;
}

int32_t fe__encounter_lose(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].flags & FE__PAIR_TOUCHING) fe__encounter_touch(world, pair, 0);
    if (world->pairs[pair].flags & FE__PAIR_PASSING) fe__encounter_pass(world, pair, 0);
    fe__encounter *e = fe__encounter_of(world, pair);
    int32_t owes = e->entered;
    --world->part_pair_count;
    if (--e->pairs > 0) return 0;
    fe__encounter_reported(world, e);
    fe__pair_set_remove(&world->encounter_set, e->shape_a, e->shape_b);
    fe__record_pool_return(&world->encounters, index_of(world, e));
    --world->encounter_count;
    return owes;
}
