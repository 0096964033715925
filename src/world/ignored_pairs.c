// ignored_pairs.c - pairs of bodies that ignore each other, see filter.h.
#include "world/filter.h"

#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/proxies.h"
#include "world/sleep.h"

static fe__ignore *ignore_at(const fe_world *world, int32_t index) { return fe__record(&world->ignores, index); }

static fe__link *link_of(const fe_world *world, int32_t index, int32_t body)
{
    fe__ignore *record = ignore_at(world, index);
    return &record->links[record->body[0] != body];
}

static void add_to_list(fe_world *world, int32_t index, int32_t body)
{
    fe__body *b = &world->bodies[body];
    *link_of(world, index, body) = (fe__link){b->first_ignored, 0};
    if (b->first_ignored) link_of(world, b->first_ignored, body)->previous = index;
    b->first_ignored = index;
    b->flags |= FE__BODY_IGNORES;
}

static void remove_from_list(fe_world *world, int32_t index, int32_t body)
{
    fe__body *b = &world->bodies[body];
    fe__link link = *link_of(world, index, body);
    if (link.previous)
        link_of(world, link.previous, body)->next = link.next;
    else
        b->first_ignored = link.next;
    if (link.next) link_of(world, link.next, body)->previous = link.previous;
    if (!b->first_ignored) b->flags &= ~(uint32_t)FE__BODY_IGNORES;
}

static void forget(fe_world *world, int32_t index)
{
    const fe__ignore *record = ignore_at(world, index);
    fe__pair_set_remove(&world->ignored, record->body[0], record->body[1]);
    remove_from_list(world, index, record->body[0]);
    remove_from_list(world, index, record->body[1]);
    fe__record_pool_return(&world->ignores, index);
}

fe_result fe__ignore_collision(fe_world *world, int32_t a, int32_t b, int32_t ignore)
{
    int32_t known = fe__pair_set_find(&world->ignored, a, b);
    if ((known >= 0) == ignore) return FE_OK;
    if (!ignore) {
        forget(world, known);
        for (int32_t i = world->bodies[a].first_shape; i >= 0; i = world->shapes[i].next)
            fe__shape_mark_moved(world, i);
        return FE_OK;
    }
    fe_result reserved = fe__record_pool_reserve(&world->ignores, &world->memory, 1);
    if (reserved != FE_OK) return reserved;
    if (!fe__pair_set_reserve(&world->ignored, &world->memory, 1)) return FE_ERROR_MEMORY;
    fe__body_disturb(world, a);
    fe__body_disturb(world, b);
    int32_t index = fe__record_pool_take(&world->ignores);
    fe__ignore *record = ignore_at(world, index);
    record->body[0] = a, record->body[1] = b;
    add_to_list(world, index, a);
    add_to_list(world, index, b);
    fe__pair_set_insert(&world->ignored, a, b, index);
    fe__body_refilter(world, a);
    return FE_OK;
}

void fe__body_ignore_none(fe_world *world, int32_t body)
{
    while (world->bodies[body].first_ignored) forget(world, world->bodies[body].first_ignored);
}
