// shape.c - the life of shapes and of the parts of compounds.
//
// Called by the API layer with checked arguments, between steps. A change ends pairs where it must, and marks what the
// next step has to look at again.
#include "world/shape.h"

#include "world/asset_users.h"
#include "world/body.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/mass.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <string.h>

// ---- parts ----------------------------------------------------------------------------------------------------------

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

static const fe__compound *compound_of(const fe_world *world, const fe__form *form)
{
    return &fe__store_asset(world->store, form->field)->compound;
}

int32_t fe__part_count(const fe_world *world, const fe__form *form)
{
    return fe__form_is_of_parts(form) ? compound_of(world, form)->count : 0;
}

// Notes whether the shape's frame is the body's.
static void note_centred(fe__shape *shape)
{
    fe_vec3 p = shape->local_position;
    fe_quat q = shape->local_rotation;
    int32_t is_centred =
        p.x == 0.0f && p.y == 0.0f && p.z == 0.0f && q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 1.0f;
    shape->flags &= ~(uint32_t)FE__SHAPE_CENTRED;
    if (is_centred) shape->flags |= FE__SHAPE_CENTRED;
}

// Turns a vector from the frame of the whole into that of the part.
static fe_vec3 turn_back(const fe__compound_part *part, fe_vec3 v)
{
    fe_quat q = part->rotation;
    return q.x == 0.0f && q.y == 0.0f && q.z == 0.0f ? v : fe__rotate_back(q, v);
}

// Gives a part all that is set on the whole.
static void follow(fe__shape *shape, const fe__shape *whole, const fe__compound_part *part)
{
    const uint32_t shared = FE__SHAPE_TRIGGER | FE__SHAPE_JUDGED | FE__SHAPE_ONE_WAY;
    shape->flags = (shape->flags & ~shared) | (whole->flags & shared);
    shape->layer = whole->layer, shape->mask = whole->mask, shape->group = whole->group;
    shape->events = whole->events;
    shape->user_data = whole->user_data;
    shape->density = part->density >= 0.0f ? part->density : whole->density;
    shape->material = part->own_material ? part->material : whole->material;
    shape->surface_velocity = turn_back(part, whole->surface_velocity);
    shape->one_way = turn_back(part, whole->one_way);
    shape->local_position = part->position;
    shape->local_rotation = part->rotation;
    // a part of a compound in the body's frame stands as a shape in that frame would, bit for bit
    if (!(whole->flags & FE__SHAPE_CENTRED)) {
        fe__pose frame = {fe__widen(whole->local_position), whole->local_rotation};
        fe__pose placed = fe__compose(&frame, part->position, part->rotation);
        shape->local_position = fe__narrow(placed.position);
        shape->local_rotation = placed.rotation;
    }
    note_centred(shape);
}

void fe__parts_follow(fe_world *world, int32_t whole)
{
    const fe__shape *shape = &world->shapes[whole];
    if (!fe__form_is_of_parts(&shape->form)) return;
    const fe__compound_part *parts = compound_of(world, &shape->form)->parts;
    for (int32_t i = fe__next_of_whole(world, whole, whole); i >= 0; i = fe__next_of_whole(world, whole, i))
        follow(&world->shapes[i], shape, parts + fe__part_of_serial(world->shapes[i].serial));
}

void fe__parts_create(fe_world *world, int32_t whole)
{
    const fe__shape *compound_shape = &world->shapes[whole];
    const fe__compound *compound = compound_of(world, &compound_shape->form);
    for (int32_t number = 0, last = whole; number < compound->count; ++number) {
        int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->shape_ids));
        fe__id_pool_hide(&world->shape_ids, index);
        fe__shape *shape = &world->shapes[index];
        uint32_t listed = shape->flags & FE__SHAPE_MOVED;
        memset(shape, 0, sizeof *shape);
        shape->flags = listed;
        shape->form = compound->parts[number].form;
        shape->body = compound_shape->body;
        shape->body_serial = compound_shape->body_serial;
        shape->serial = compound_shape->serial + (uint64_t)number + 1;
        shape->parent = whole;
        follow(shape, compound_shape, compound->parts + number);
        fe__shape_list(world, index, last);
        fe__shape_place(world, index);
        last = index;
    }
    world->part_count += compound->count;
}

// ---- creation and destruction ---------------------------------------------------------------------------------------

// `records`: how many are to be made
static fe_result reserve_shapes(fe_world *world, int32_t body, const fe__form *form, int32_t records)
{
    int32_t proxies = fe__maxi(fe__part_count(world, form), 1);
    fe_result ids = fe__id_pool_reserve(&world->shape_ids, &world->memory, records);
    if (ids != FE_OK) return ids;
    int64_t need = (int64_t)world->shape_ids.slot_count + fe__maxi(records - world->shape_ids.free_count, 0);
    if (!FE_RESERVE(&world->memory, world->shapes, world->shape_capacity, need)) return FE_ERROR_MEMORY;
    if (!fe__reserve_asset_use(world, form)) return FE_ERROR_MEMORY;
    return fe__reserve_proxies(world, world->bodies[body].type, proxies) ? FE_OK : FE_ERROR_MEMORY;
}

static void set_local_pose(fe__shape *shape, fe_vec3 position, fe_quat rotation)
{
    shape->local_position = position;
    shape->local_rotation = fe__unit_rotation(rotation);
    note_centred(shape);
}

// A pair may be found and hit within one step: the step must know before that hits are asked for.
static void note_events(fe_world *world, uint32_t events)
{
    if (events & FE_SHAPE_EVENTS_HIT) world->wants_hits = 1;
}

static void create_parts(fe_world *world, int32_t index)
{
    fe__parts_create(world, index);
    for (int32_t i = index; (i = fe__next_of_whole(world, index, i)) >= 0;) fe__shape_take_asset(world, i);
}

// The last part goes first: it is the first in the list of the users of its asset.
static void destroy_parts(fe_world *world, int32_t index)
{
    int32_t last = index;
    for (int32_t i = index; (i = fe__next_of_whole(world, index, i)) >= 0;) last = i;
    while (last != index) {
        int32_t part = last;
        last = world->shapes[part].previous;
        fe__shape_unlist(world, part);
        fe__shape_forget(world, part);
    }
}

static void enter(fe_world *world, int32_t index)
{
    for (int32_t i = index; i >= 0; i = fe__next_of_whole(world, index, i)) fe__shape_enter(world, i);
}

static void leave(fe_world *world, int32_t index)
{
    for (int32_t i = index; i >= 0; i = fe__next_of_whole(world, index, i)) fe__shape_leave(world, i);
}

static void mark_moved(fe_world *world, int32_t index)
{
    for (int32_t i = index; i >= 0; i = fe__next_of_whole(world, index, i)) fe__shape_mark_moved(world, i);
}

// A sleeping body goes on sleeping: a level may be built asleep.
int32_t fe__shape_create(fe_world *world, int32_t body, const fe_shape_def *def, const fe__form *form)
{
    fe_result reserved = reserve_shapes(world, body, form, 1 + fe__part_count(world, form));
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
    shape->serial = world->next_serial++ << FE__PART_BITS;
    shape->parent = -1;
    shape->body_serial = world->bodies[body].serial;
    set_local_pose(shape, def->frame.position, def->frame.rotation);
    fe__shape_list(world, index, -1);
    fe__shape_take_asset(world, index);
    fe__shape_place(world, index);
    if (fe__form_is_of_parts(form)) create_parts(world, index);
    fe__body_gain_shape(world, body, index);
    if (world->bodies[body].flags & FE__BODY_ENABLED) enter(world, index);
    note_events(world, def->events);
    return index;
}

// Destroys the shape's pairs that have one of the flags; 0: all of them.
static void drop_pairs(fe_world *world, int32_t index, uint32_t flags)
{
    int32_t body = world->shapes[index].body;
    for (int32_t pair = world->bodies[body].first_contact, next; pair >= 0; pair = next) {
        next = fe__next_pair(world, pair, body);
        const fe__pair *p = &world->pairs[pair];
        if (p->flags & FE__PAIR_PATCH || (flags && !(p->flags & flags))) continue;
        if (fe__is_of_whole(world, p->shape_a, index) || fe__is_of_whole(world, p->shape_b, index))
            fe__pair_destroy(world, pair);
    }
}

void fe__shape_destroy(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    fe__body_disturb(world, body);
    drop_pairs(world, index, 0);
    leave(world, index);
    destroy_parts(world, index);
    fe__shape_unlist(world, index);
    fe__shape_forget(world, index);
    fe__body_sizes_changed(world, body);
}

void fe__shape_forget(fe_world *world, int32_t index)
{
    int32_t is_part = world->shapes[index].parent >= 0;
    fe__shape_release_asset(world, index);
    if (is_part) fe__id_pool_show(&world->shape_ids, index);
    fe__id_pool_release(&world->shape_ids, index);
    world->shape_count -= 1;
    world->part_count -= is_part;
}

// ---- changes --------------------------------------------------------------------------------------------------------

// The shape's pairs end and are found anew: a manifold of the old form means nothing on the new one.
static void begin_change(fe_world *world, int32_t index)
{
    fe__body_disturb(world, world->shapes[index].body);
    drop_pairs(world, index, 0);
    leave(world, index);
}

static void end_change(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    fe__body_sizes_changed(world, body);
    for (int32_t i = index; i >= 0; i = fe__next_of_whole(world, index, i)) fe__shape_place(world, i);
    if (world->bodies[body].flags & FE__BODY_ENABLED) enter(world, index);
}

fe_result fe__shape_set_form(fe_world *world, int32_t index, const fe__form *form)
{
    fe_result reserved = reserve_shapes(world, world->shapes[index].body, form, fe__part_count(world, form));
    if (reserved != FE_OK) return reserved;
    begin_change(world, index);
    destroy_parts(world, index);
    // an asset that stays is not released, so that its list of users stays too
    fe__form *own = &world->shapes[index].form;
    int32_t has_same_asset = fe__form_has_asset(own) && fe__form_has_asset(form) && own->field == form->field;
    if (!has_same_asset) fe__shape_release_asset(world, index);
    *own = *form;
    if (!has_same_asset) fe__shape_take_asset(world, index);
    if (fe__form_is_of_parts(form)) create_parts(world, index);
    end_change(world, index);
    return FE_OK;
}

void fe__shape_set_local_pose(fe_world *world, int32_t index, fe_vec3 position, fe_quat rotation)
{
    begin_change(world, index);
    set_local_pose(&world->shapes[index], position, rotation);
    fe__parts_follow(world, index);
    end_change(world, index);
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
    fe__parts_follow(world, index);
    fe__body_refilter(world, shape->body);
    drop_pairs(world, index, FE__PAIR_DENIED); // the pair filter judges them anew
    mark_moved(world, index);
}

int32_t fe__accept_pair(void *user, const fe_filter_pair *pair)
{
    (void)user, (void)pair;
    return 1;
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

// Ends every pair of the shape; the next step finds them anew.
static void renew_pairs(fe_world *world, int32_t index)
{
    fe__body_disturb(world, world->shapes[index].body);
    drop_pairs(world, index, 0);
    fe__parts_follow(world, index);
    mark_moved(world, index);
}

void fe__shape_set_judged(fe_world *world, int32_t index, int32_t judged)
{
    fe__shape *shape = &world->shapes[index];
    if (judged == ((shape->flags & FE__SHAPE_JUDGED) != 0)) return;
    shape->flags ^= FE__SHAPE_JUDGED;
    renew_pairs(world, index);
}

void fe__shape_set_one_way(fe_world *world, int32_t index, int32_t one_way, const fe_vec3 *direction)
{
    fe__shape *shape = &world->shapes[index];
    if (direction) shape->one_way = *direction;
    shape->flags = one_way ? shape->flags | FE__SHAPE_ONE_WAY : shape->flags & ~(uint32_t)FE__SHAPE_ONE_WAY;
    renew_pairs(world, index);
}

void fe__shape_set_trigger(fe_world *world, int32_t index, int32_t trigger)
{
    fe__shape *shape = &world->shapes[index];
    if (trigger == ((shape->flags & FE__SHAPE_TRIGGER) != 0)) return;
    shape->flags ^= FE__SHAPE_TRIGGER;
    renew_pairs(world, index);
}

void fe__shape_set_density(fe_world *world, int32_t index, float density)
{
    world->shapes[index].density = density;
    fe__parts_follow(world, index);
    fe__body_disturb(world, world->shapes[index].body);
    fe__body_densities_changed(world, world->shapes[index].body);
}

// A body that rests by friction may start to slide, one that lies on a belt to move.
static void renew_surface(fe_world *world, int32_t index)
{
    fe__parts_follow(world, index);
    fe__body_disturb(world, world->shapes[index].body);
    fe__shape_material_changed(world, index);
}

void fe__shape_set_material(fe_world *world, int32_t index, const fe_material *material)
{
    world->shapes[index].material = *material;
    renew_surface(world, index);
}

void fe__shape_set_surface_velocity(fe_world *world, int32_t index, fe_vec3 velocity)
{
    world->shapes[index].surface_velocity = velocity;
    renew_surface(world, index);
}

void fe__shape_set_events(fe_world *world, int32_t index, uint32_t events)
{
    world->shapes[index].events = events;
    fe__parts_follow(world, index);
    fe__shape_material_changed(world, index);
}

void fe__shape_material_changed(fe_world *world, int32_t index)
{
    int32_t body = world->shapes[index].body;
    note_events(world, world->shapes[index].events);
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = &world->pairs[pair];
        if (fe__is_of_whole(world, p->shape_a, index) || fe__is_of_whole(world, p->shape_b, index))
            fe__pair_mix(world, pair);
    }
}
