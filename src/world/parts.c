// parts.c - see parts.h.
#include "world/parts.h"

#include "world/pose.h"

#include <string.h>

// ---- the list of the body ------------------------------------------------------------------------------------------

void fe__shape_list(fe_world *world, int32_t index, int32_t behind)
{
    fe__shape *shape = &world->shapes[index];
    fe__body *body = &world->bodies[shape->body];
    shape->previous = behind >= 0 ? behind : body->last_shape;
    shape->next = -1;
    if (shape->previous >= 0) {
        shape->next = world->shapes[shape->previous].next;
        world->shapes[shape->previous].next = index;
    } else {
        body->first_shape = index;
    }
    if (shape->next >= 0)
        world->shapes[shape->next].previous = index;
    else
        body->last_shape = index;
    body->shape_count += 1;
    world->shape_count += 1;
}

void fe__shape_unlist(fe_world *world, int32_t index)
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
}

// ---- what they take over -------------------------------------------------------------------------------------------

static const fe__compound *compound_of(const fe_world *world, const fe__form *form)
{
    return &fe__store_asset(world->store, form->field)->compound;
}

int32_t fe__part_count(const fe_world *world, const fe__form *form)
{
    return fe__form_is_of_parts(form) ? compound_of(world, form)->count : 0;
}

static int32_t is_identity(fe_vec3 p, fe_quat q)
{
    return p.x == 0.0f && p.y == 0.0f && p.z == 0.0f && q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 1.0f;
}

// A part of a compound that stands in the body's frame stands as a shape of that frame would, bit for bit.
static void place_part(fe__shape *shape, const fe__shape *whole, const fe__compound_part *part)
{
    if (whole->flags & FE__SHAPE_CENTRED) {
        shape->local_position = part->position;
        shape->local_rotation = part->rotation;
    } else {
        fe__pose frame = {fe__widen(whole->local_position), whole->local_rotation};
        fe__pose placed = fe__compose(&frame, part->position, part->rotation);
        shape->local_position = fe__narrow(placed.position);
        shape->local_rotation = placed.rotation;
    }
    shape->flags &= ~(uint32_t)FE__SHAPE_CENTRED;
    if (is_identity(shape->local_position, shape->local_rotation)) shape->flags |= FE__SHAPE_CENTRED;
}

// From the frame of the whole into that of the part
static fe_vec3 turned_back(const fe__compound_part *part, fe_vec3 v)
{
    fe_quat q = part->rotation;
    return q.x == 0.0f && q.y == 0.0f && q.z == 0.0f ? v : fe__rotate_back(q, v);
}

static void follow(fe__shape *shape, const fe__shape *whole, const fe__compound_part *part)
{
    const uint32_t shared = FE__SHAPE_TRIGGER | FE__SHAPE_JUDGED | FE__SHAPE_ONE_WAY;
    shape->flags = (shape->flags & ~shared) | (whole->flags & shared);
    shape->layer = whole->layer, shape->mask = whole->mask, shape->group = whole->group;
    shape->events = whole->events;
    shape->user_data = whole->user_data;
    shape->density = part->density >= 0.0f ? part->density : whole->density;
    shape->material = part->own_material ? part->material : whole->material;
    shape->surface_velocity = turned_back(part, whole->surface_velocity);
    shape->one_way = turned_back(part, whole->one_way);
    place_part(shape, whole, part);
}

void fe__parts_follow(fe_world *world, int32_t whole)
{
    const fe__shape *w = &world->shapes[whole];
    if (!fe__form_is_of_parts(&w->form)) return;
    const fe__compound_part *parts = compound_of(world, &w->form)->parts;
    for (int32_t i = fe__next_of_whole(world, whole, whole); i >= 0; i = fe__next_of_whole(world, whole, i))
        follow(&world->shapes[i], w, parts + fe__part_of_serial(world->shapes[i].serial));
}

// ---- life ----------------------------------------------------------------------------------------------------------

static int32_t create(fe_world *world, int32_t whole, int32_t number, const fe__compound_part *part)
{
    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->shape_ids));
    fe__id_pool_hide(&world->shape_ids, index);
    fe__shape *shape = &world->shapes[index];
    const fe__shape *w = &world->shapes[whole];
    uint32_t listed = shape->flags & FE__SHAPE_MOVED;
    memset(shape, 0, sizeof *shape);
    shape->flags = listed;
    shape->form = part->form;
    shape->body = w->body;
    shape->body_serial = w->body_serial;
    shape->serial = w->serial + (uint64_t)number + 1;
    shape->parent = whole;
    follow(shape, w, part);
    return index;
}

void fe__parts_create(fe_world *world, int32_t whole)
{
    const fe__compound *compound = compound_of(world, &world->shapes[whole].form);
    for (int32_t number = 0, last = whole; number < compound->count; ++number) {
        int32_t index = create(world, whole, number, compound->parts + number);
        fe__shape_list(world, index, last);
        fe__shape_place(world, index);
        last = index;
    }
    world->part_count += compound->count;
}
