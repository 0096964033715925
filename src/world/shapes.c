// shapes.c - the life of shapes.
//
// Called by the API layer with checked arguments, between steps.
#include "world/shapes.h"

#include "world/asset_users.h"
#include "world/mass.h"
#include "world/pair_list.h"
#include "world/pair_mix.h"
#include "world/pairs.h"
#include "world/pose.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <string.h>

// ---- birth and death -----------------------------------------------------------------------------------------------

static fe_result reserve_shape(fe_world *world, int32_t body, const fe__form *form)
{
    fe_result ids = fe__id_pool_reserve(&world->shape_ids, &world->memory, 1);
    if (ids != FE_OK) return ids;
    int64_t need = (int64_t)world->shape_ids.slot_count + (world->shape_ids.free_count ? 0 : 1);
    if (!FE_RESERVE(&world->memory, world->shapes, world->shape_capacity, need)) return FE_ERROR_MEMORY;
    if (!fe__reserve_asset_use(world, form)) return FE_ERROR_MEMORY;
    return fe__reserve_proxies(world, world->bodies[body].type, 1) ? FE_OK : FE_ERROR_MEMORY;
}

static void append_to_body(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    fe__body *body = &world->bodies[shape->body];
    shape->next = -1;
    shape->previous = body->last_shape;
    if (body->last_shape >= 0)
        world->shapes[body->last_shape].next = index;
    else
        body->first_shape = index;
    body->last_shape = index;
    body->shape_count += 1;
    world->shape_count += 1;
}

static void remove_from_body(fe_world *world, int32_t index)
{
    const fe__shape *shape = &world->shapes[index];
    fe__body *body = &world->bodies[shape->body];
    if (shape->previous >= 0)
        world->shapes[shape->previous].next = shape->next;
    else
        body->first_shape = shape->next;
    if (shape->next >= 0)
        world->shapes[shape->next].previous = shape->previous;
    else
        body->last_shape = shape->previous;
    body->shape_count -= 1;
    world->shape_count -= 1;
}

static void set_local_pose(fe__shape *shape, fe_vec3 position, fe_quat rotation)
{
    fe_quat q = fe__unit_rotation(rotation);
    int32_t centred = position.x == 0.0f && position.y == 0.0f && position.z == 0.0f && q.x == 0.0f && q.y == 0.0f &&
                      q.z == 0.0f && q.w == 1.0f;
    shape->local_position = position;
    shape->local_rotation = q;
    shape->flags &= ~(uint32_t)FE__SHAPE_CENTRED;
    if (centred) shape->flags |= FE__SHAPE_CENTRED;
}

// A pair may be found and hit within one step: the step must know before that hits are asked for.
static void note_events(fe_world *world, uint32_t events)
{
    if (events & FE_SHAPE_EVENTS_HIT) world->wants_hits = 1;
}

// A sleeping body goes on sleeping: a level may be built asleep.
int32_t fe__shape_create(fe_world *world, int32_t body, const fe_shape_def *def, const fe__form *form)
{
    fe_result reserved = reserve_shape(world, body, form);
    if (reserved != FE_OK) return reserved;
    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->shape_ids));
    fe__shape *shape = &world->shapes[index];
    uint32_t listed = shape->flags & FE__SHAPE_MOVED;
    memset(shape, 0, sizeof *shape);
    shape->flags = listed | (def->trigger ? FE__SHAPE_TRIGGER : 0u) | (def->pair_filter ? FE__SHAPE_JUDGED : 0u) |
                   (def->one_way ? FE__SHAPE_ONE_WAY : 0u);
    shape->form = *form;
    shape->density = def->density;
    shape->material = def->material;
    shape->layer = def->layer;
    shape->group = def->group;
    shape->mask = def->mask;
    shape->events = def->events;
    shape->surface_velocity = def->surface_velocity;
    shape->one_way = def->one_way_direction;
    shape->user_data = def->user_data;
    shape->body = body;
    shape->serial = world->next_serial++;
    shape->body_serial = world->bodies[body].serial;
    set_local_pose(shape, def->frame.position, def->frame.rotation);
    append_to_body(world, index);
    fe__shape_take_asset(world, index);
    fe__body_gain_shape(world, body, index);
    fe__shape_place(world, index);
    if (world->bodies[body].flags & FE__BODY_ENABLED) fe__shape_enter(world, index);
    note_events(world, def->events);
    return index;
}

static void drop_pairs(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    for (int32_t pair = world->bodies[body].first_contact, next; pair >= 0; pair = next) {
        next = fe__next_pair(world, pair, body);
        const fe__pair *p = &world->pairs[pair];
        if (p->flags & FE__PAIR_PATCH) continue;
        if (p->shape_a == index || p->shape_b == index) fe__pair_destroy(world, pair);
    }
}

// The pair filter judges them anew
static void drop_denied(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    for (int32_t pair = world->bodies[body].first_contact, next; pair >= 0; pair = next) {
        next = fe__next_pair(world, pair, body);
        const fe__pair *p = &world->pairs[pair];
        if (p->flags & FE__PAIR_DENIED && (p->shape_a == index || p->shape_b == index)) fe__pair_destroy(world, pair);
    }
}

void fe__shape_destroy(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    fe__body_disturb(world, body);
    drop_pairs(world, index);
    fe__shape_leave(world, index);
    remove_from_body(world, index);
    fe__shape_release_asset(world, index);
    fe__id_pool_release(&world->shape_ids, index);
    fe__body_sizes_changed(world, body);
}

// ---- change --------------------------------------------------------------------------------------------------------

static void exchange_asset(fe_world *world, int32_t index, const fe__form *before)
{
    fe__shape *shape = &world->shapes[index];
    fe__form now = shape->form;
    if (fe__form_has_asset(before) && fe__form_has_asset(&now) && before->field == now.field) return;
    shape->form = *before;
    fe__shape_release_asset(world, index);
    shape->form = now;
    fe__shape_take_asset(world, index);
}

// The shape's pairs end and are found anew: a manifold of the old form means nothing on the new one.
static void change(fe_world *world, int32_t index, const fe__form *form, fe_vec3 position, fe_quat rotation)
{
    fe__shape *shape = &world->shapes[index];
    int32_t body = shape->body;
    fe__body_disturb(world, body);
    drop_pairs(world, index);
    fe__shape_leave(world, index);
    fe__form before = shape->form;
    shape->form = *form;
    if (fe__form_has_asset(&before) || fe__form_has_asset(form)) exchange_asset(world, index, &before);
    set_local_pose(shape, position, rotation);
    fe__body_sizes_changed(world, body);
    fe__shape_place(world, index);
    if (world->bodies[body].flags & FE__BODY_ENABLED) fe__shape_enter(world, index);
}

fe_result fe__shape_set_form(fe_world *world, int32_t index, const fe__form *form)
{
    const fe__shape *shape = &world->shapes[index];
    if (!fe__reserve_asset_use(world, form)) return FE_ERROR_MEMORY;
    if (!fe__reserve_proxies(world, world->bodies[shape->body].type, 1)) return FE_ERROR_MEMORY;
    change(world, index, form, shape->local_position, shape->local_rotation);
    return FE_OK;
}

void fe__shape_set_local_pose(fe_world *world, int32_t index, fe_vec3 position, fe_quat rotation)
{
    fe__form form = world->shapes[index].form;
    change(world, index, &form, position, rotation);
}

// Pairs that the new filter forbids end now, their exits come with the next step; those that it allows are found by the
// next step.
void fe__shape_set_filter(fe_world *world, int32_t index, uint32_t layer, uint32_t mask, int32_t group)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->layer == layer && shape->mask == mask && shape->group == group) return;
    fe__body_disturb(world, shape->body);
    shape->layer = layer;
    shape->mask = mask;
    shape->group = group;
    fe__body_refilter(world, shape->body);
    drop_denied(world, index);
    fe__shape_mark_moved(world, index);
}

void fe__world_judge_anew(fe_world *world)
{
    for (int32_t pair = 1; pair < world->pair_limit; ++pair) {
        const fe__pair *p = &world->pairs[pair];
        if (!(p->flags & FE__PAIR_DENIED)) continue;
        fe__shape_mark_moved(world, p->shape_a);
        fe__shape_mark_moved(world, p->shape_b);
        fe__pair_destroy(world, pair);
    }
}

// Every pair of the shape is found anew
static void renew(fe_world *world, int32_t index)
{
    fe__body_disturb(world, world->shapes[index].body);
    drop_pairs(world, index);
    fe__shape_mark_moved(world, index);
}

void fe__shape_set_judged(fe_world *world, int32_t index, int32_t judged)
{
    fe__shape *shape = &world->shapes[index];
    if (judged == ((shape->flags & FE__SHAPE_JUDGED) != 0)) return;
    shape->flags ^= FE__SHAPE_JUDGED;
    renew(world, index);
}

void fe__shape_set_one_way(fe_world *world, int32_t index, int32_t one_way, const fe_vec3 *direction)
{
    fe__shape *shape = &world->shapes[index];
    if (direction) shape->one_way = *direction;
    shape->flags = one_way ? shape->flags | FE__SHAPE_ONE_WAY : shape->flags & ~(uint32_t)FE__SHAPE_ONE_WAY;
    renew(world, index);
}

void fe__shape_set_trigger(fe_world *world, int32_t index, int32_t trigger)
{
    fe__shape *shape = &world->shapes[index];
    if (trigger == ((shape->flags & FE__SHAPE_TRIGGER) != 0)) return;
    fe__body_disturb(world, shape->body);
    drop_pairs(world, index);
    shape->flags ^= FE__SHAPE_TRIGGER;
    fe__shape_mark_moved(world, index);
}

void fe__shape_material_changed(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    note_events(world, world->shapes[index].events);
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = &world->pairs[pair];
        if (p->shape_a == index || p->shape_b == index) fe__pair_mix(world, pair);
    }
}
