// shapes.c - the life of shapes, and their places in the broad phase.
//
// Called by the API layer with checked arguments, between steps; the step uses the bounds. A shape of a static body lives in the static
// tree, one of a moving body in the moving tree, planes in a list; a shape of a disabled body in none. A new place is noted in
// world->moved, from which the next step finds new pairs.
#include "world/world.h"

#include <string.h>

// A box in a tree is larger than its shape by the speculative distance (what touches must have a pair) and a share of its size, so that a
// body may move a while before its tree changes: larger ones move further before it matters.
#define FAT_SHARE 0.12 // of the largest half extent
#define FAT_MOST 0.05  // m
// It also reaches where the body will be after so many steps at its velocity: what it meets in the next step must have a pair before.
#define STEPS_AHEAD 2.0f
#define FIRST_DT (1.0f / 60.0f) // s, before the first step has told

// ---- bounds ---------------------------------------------------------------------------------------------------------------------

static fe__bounds grown(fe__bounds b, double margin)
{
    return (fe__bounds){{b.low.x - margin, b.low.y - margin, b.low.z - margin}, {b.high.x + margin, b.high.y + margin, b.high.z + margin}};
}

fe__bounds fe__shape_bounds(const fe_world *world, int32_t index, float margin)
{
    const fe__shape *shape = &world->shapes[index];
    return grown(fe__form_bounds(&shape->form, &shape->pose), (double)margin);
}

static fe__bounds swept(const fe_world *world, int32_t index, fe__bounds b, float steps)
{
    const fe__body *body = &world->bodies[world->shapes[index].body];
    double dt = (double)(steps * (world->last_dt > 0.0f ? world->last_dt : FIRST_DT));
    fe_dvec3 way = fe__dscale(dt, fe__widen(fe__vec3(body->velocity[0], body->velocity[1], body->velocity[2])));
    b.low = fe__dadd(b.low, (fe_dvec3){fe__mind(way.x, 0.0), fe__mind(way.y, 0.0), fe__mind(way.z, 0.0)});
    b.high = fe__dadd(b.high, (fe_dvec3){fe__maxd(way.x, 0.0), fe__maxd(way.y, 0.0), fe__maxd(way.z, 0.0)});
    return b;
}

fe__bounds fe__shape_reach_bounds(const fe_world *world, int32_t index)
{
    return swept(world, index, fe__shape_bounds(world, index, world->tuning.speculative_distance), 1.0f);
}

fe__bounds fe__shape_fat_bounds(const fe_world *world, int32_t index)
{
    fe__bounds b = fe__shape_bounds(world, index, 0.0f);
    fe_dvec3 size = fe__dsub(b.high, b.low);
    double half = 0.5 * fe__maxd(fe__maxd(size.x, size.y), size.z);
    b = swept(world, index, b, STEPS_AHEAD);
    return grown(b, (double)world->tuning.speculative_distance + fe__mind(FAT_MOST, FAT_SHARE * half));
}

// ---- broad phase ----------------------------------------------------------------------------------------------------------------

int32_t fe__reserve_proxies(fe_world *world, int32_t extra)
{
    fe__memory *memory = &world->memory;
    int32_t limit = world->shape_capacity;
    return FE_RESERVE(memory, world->moved, world->moved_capacity, limit) &&
           FE_RESERVE(memory, world->planes, world->plane_capacity, (int64_t)world->plane_count + extra) &&
           fe__tree_reserve(&world->static_tree, memory, limit, extra) && fe__tree_reserve(&world->moving_tree, memory, limit, extra);
}

static fe__tree *tree_of(fe_world *world, const fe__shape *shape)
{
    return world->bodies[shape->body].type == FE_BODY_STATIC ? &world->static_tree : &world->moving_tree;
}

void fe__shape_mark_moved(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_MOVED || !(shape->flags & (FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES))) return;
    shape->flags |= FE__SHAPE_MOVED;
    world->moved[world->moved_count++] = index;
}

void fe__shape_enter(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->form.type == FE_GEOMETRY_PLANE) {
        shape->flags |= FE__SHAPE_IN_PLANES;
        world->planes[world->plane_count++] = index;
    } else {
        fe__bounds fat = fe__shape_fat_bounds(world, index);
        shape->flags |= FE__SHAPE_IN_TREE;
        fe__tree_insert(tree_of(world, shape), index, &fat);
    }
    fe__shape_mark_moved(world, index);
}

// FE__SHAPE_MOVED stays: the list still names the slot, and whoever gets it next is in the list already.
void fe__shape_leave(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_IN_TREE) fe__tree_remove(tree_of(world, shape), index);
    if (shape->flags & FE__SHAPE_IN_PLANES) {
        int32_t place = 0;
        while (world->planes[place] != index) ++place;
        world->planes[place] = world->planes[--world->plane_count];
    }
    shape->flags &= ~(uint32_t)(FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES);
}

void fe__shape_touch(fe_world *world, int32_t index)
{
    const fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_IN_TREE) {
        fe__bounds fat = fe__shape_fat_bounds(world, index);
        fe__tree_move(tree_of(world, shape), &index, &fat, 1);
    }
    fe__shape_mark_moved(world, index);
}

void fe__body_stretch_boxes(fe_world *world, int32_t index)
{
    for (int32_t i = world->bodies[index].first_shape; i >= 0; i = world->shapes[i].next) {
        fe__bounds reach = fe__shape_reach_bounds(world, i);
        int32_t in_tree = world->shapes[i].flags & FE__SHAPE_IN_TREE;
        if (in_tree && !fe__tree_holds(tree_of(world, &world->shapes[i]), i, &reach)) fe__shape_touch(world, i);
    }
}

// ---- birth and death ------------------------------------------------------------------------------------------------------------

static fe_result reserve_shape(fe_world *world)
{
    fe_result ids = fe__id_pool_reserve(&world->shape_ids, &world->memory, 1);
    if (ids != FE_OK) return ids;
    int64_t need = (int64_t)world->shape_ids.slot_count + (world->shape_ids.free_count ? 0 : 1);
    if (!FE_RESERVE(&world->memory, world->shapes, world->shape_capacity, need)) return FE_ERROR_MEMORY;
    return fe__reserve_proxies(world, 1) ? FE_OK : FE_ERROR_MEMORY;
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
    int32_t centred =
        position.x == 0.0f && position.y == 0.0f && position.z == 0.0f && q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 1.0f;
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
    fe_result reserved = reserve_shape(world);
    if (reserved != FE_OK) return reserved;
    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->shape_ids));
    fe__shape *shape = &world->shapes[index];
    uint32_t listed = shape->flags & FE__SHAPE_MOVED;
    memset(shape, 0, sizeof *shape);
    shape->flags = listed | (def->trigger ? FE__SHAPE_TRIGGER : 0u);
    shape->form = *form;
    shape->density = def->density;
    shape->material = def->material;
    shape->layer = def->layer;
    shape->mask = def->mask;
    shape->events = def->events;
    shape->surface_velocity = def->surface_velocity;
    shape->user_data = def->user_data;
    shape->body = body;
    shape->serial = world->next_serial++;
    shape->body_serial = world->bodies[body].serial;
    set_local_pose(shape, def->local_position, def->local_rotation);
    append_to_body(world, index);
    fe__shape_take_asset(world, index);
    fe__body_update_mass(world, body);
    fe__body_place(world, body);
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

void fe__shape_destroy(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    fe__body_disturb(world, body);
    drop_pairs(world, index);
    fe__shape_leave(world, index);
    remove_from_body(world, index);
    fe__shape_release_asset(world, index);
    fe__id_pool_release(&world->shape_ids, index);
    fe__body_update_mass(world, body);
}

// ---- change ---------------------------------------------------------------------------------------------------------------------

static void exchange_asset(fe_world *world, int32_t index, const fe__form *before)
{
    fe__shape *shape = &world->shapes[index];
    fe__form now = shape->form;
    if (before->type == now.type && before->field == now.field) return;
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
    if (before.type == FE_GEOMETRY_HEIGHTFIELD || form->type == FE_GEOMETRY_HEIGHTFIELD) exchange_asset(world, index, &before);
    set_local_pose(shape, position, rotation);
    fe__body_update_mass(world, body);
    fe__body_place(world, body);
    if (world->bodies[body].flags & FE__BODY_ENABLED) fe__shape_enter(world, index);
}

fe_result fe__shape_set_form(fe_world *world, int32_t index, const fe__form *form)
{
    if (!fe__reserve_proxies(world, 1)) return FE_ERROR_MEMORY;
    const fe__shape *shape = &world->shapes[index];
    change(world, index, form, shape->local_position, shape->local_rotation);
    return FE_OK;
}

void fe__shape_set_local_pose(fe_world *world, int32_t index, fe_vec3 position, fe_quat rotation)
{
    fe__form form = world->shapes[index].form;
    change(world, index, &form, position, rotation);
}

// Pairs that the new filter forbids end now, their exits come with the next step; those that it allows are found by the next step.
void fe__shape_set_filter(fe_world *world, int32_t index, uint32_t layer, uint32_t mask)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->layer == layer && shape->mask == mask) return;
    fe__body_disturb(world, shape->body);
    shape->layer = layer;
    shape->mask = mask;
    fe__body_refilter(world, shape->body);
    fe__shape_mark_moved(world, index);
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

fe_handle fe__shape_handle(const fe_world *world, int32_t shape) { return fe__id_pool_handle(&world->shape_ids, shape); }
