// pairs.c - the life of pairs: birth, mixed materials, places in lists and in the constraint graph, death with the exit it owes.
#include "world/world.h"

#include "core/hash.h"

#include <assert.h>
#include <string.h>

int32_t fe__reserve_pairs(fe_world *world, int32_t extra)
{
    fe__memory *memory = &world->memory;
    int64_t limit = (int64_t)world->pair_limit + extra;
    return FE_RESERVE(memory, world->contacts, world->contact_capacity, limit) &&
           FE_RESERVE(memory, world->pairs, world->pair_capacity, limit) &&
           FE_RESERVE(memory, world->extras, world->extra_capacity, limit) &&
           FE_RESERVE(memory, world->pair_serials, world->serial_capacity, 2 * limit) &&
           FE_RESERVE(memory, world->awake_pairs, world->awake_pair_capacity, limit) &&
           FE_RESERVE(memory, world->waits, world->wait_capacity, limit) && fe__pair_set_reserve(&world->pair_set, memory, extra);
}

// ---- lists ---------------------------------------------------------------------------------------------------------------------------
static fe__link *link_of(fe_world *world, int32_t pair, int32_t body)
{
    return &world->pairs[pair].links[world->pairs[pair].body_a == body ? 0 : 1];
}

int32_t fe__next_pair(const fe_world *world, int32_t pair, int32_t body)
{
    return world->pairs[pair].links[world->pairs[pair].body_a == body ? 0 : 1].next;
}

static void add_to_list(fe_world *world, int32_t pair, int32_t index)
{
    fe__body *body = world->bodies + index;
    *link_of(world, pair, index) = (fe__link){body->first_contact, -1};
    if (body->first_contact >= 0) link_of(world, body->first_contact, index)->previous = pair;
    body->first_contact = pair;
}

static void remove_from_list(fe_world *world, int32_t pair, int32_t index)
{
    fe__body *body = world->bodies + index;
    fe__link link = *link_of(world, pair, index);
    if (link.previous >= 0)
        link_of(world, link.previous, index)->next = link.next;
    else
        body->first_contact = link.next;
    if (link.next >= 0) link_of(world, link.next, index)->previous = link.previous;
}

int32_t fe__is_field_pair(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    return world->shapes[shape_a].form.type == FE_GEOMETRY_HEIGHTFIELD || world->shapes[shape_b].form.type == FE_GEOMETRY_HEIGHTFIELD;
}

static int32_t is_with_static(const fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    return world->bodies[p->body_a].type == FE_BODY_STATIC || world->bodies[p->body_b].type == FE_BODY_STATIC;
}

// Contacts count as many as the pair may have
static void add_to_body(fe_world *world, int32_t pair, int32_t index)
{
    fe__body *body = world->bodies + index;
    add_to_list(world, pair, index);
    body->contact_count += world->pairs[pair].next_patch >= 0 ? FE__PATCHES : 1;
    body->static_pairs += is_with_static(world, pair);
    if (body->type == FE_BODY_DYNAMIC) world->most_contacts = fe__maxi(world->most_contacts, body->contact_count);
}

static void remove_from_body(fe_world *world, int32_t pair, int32_t index)
{
    remove_from_list(world, pair, index);
    world->bodies[index].contact_count -= world->pairs[pair].next_patch >= 0 ? FE__PATCHES : 1;
    world->bodies[index].static_pairs -= is_with_static(world, pair);
}

void fe__pair_awaken(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].awake_index >= 0) return;
    world->pairs[pair].awake_index = world->awake_pair_count;
    world->awake_pairs[world->awake_pair_count++] = pair;
}

void fe__pair_retire(fe_world *world, int32_t pair)
{
    int32_t place = world->pairs[pair].awake_index;
    if (place < 0) return;
    int32_t last = --world->awake_pair_count;
    world->awake_pairs[place] = world->awake_pairs[last];
    world->waits[place] = world->waits[last];
    world->pairs[fe__pair_of(world->awake_pairs[place])].awake_index = place;
    world->pairs[pair].awake_index = -1;
}

static void end_wait(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].awake_index >= 0) world->awake_pairs[world->pairs[pair].awake_index] = pair;
}

void fe__pair_look_once(fe_world *world, int32_t pair)
{
    if (world->pairs[pair].flags & FE__PAIR_PATCH) return; // looked at with its head
    world->pairs[pair].flags |= FE__PAIR_ONCE;
    fe__pair_awaken(world, pair);
    end_wait(world, pair);
}

void fe__body_end_waits(fe_world *world, int32_t body)
{
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) end_wait(world, pair);
}

// Triggers see sleepers, and a static body that comes to a sleeper wakes it. Bodies that are created asleep stay so, whatever they touch.
static int32_t concerns_sleepers(const fe_world *world, const fe__pair *p)
{
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    int32_t dynamic_a = world->bodies[p->body_a].type == FE_BODY_DYNAMIC, dynamic_b = world->bodies[p->body_b].type == FE_BODY_DYNAMIC;
    const fe__shape *sleeper = dynamic_a ? a : b;
    return p->flags & FE__PAIR_SENSOR || (dynamic_a != dynamic_b && !(sleeper->flags & FE__SHAPE_MOVED));
}

// ---- materials ------------------------------------------------------------------------------------------------------------------------
static float form_radius(const fe__shape *a, const fe__shape *b) { return fe__maxf(a->form.radius, b->form.radius); }

static int32_t has_extra(const fe_world *world, const fe__shape *shape)
{
    if (shape->form.type == FE_GEOMETRY_HEIGHTFIELD && world->assets[shape->form.field].special) return 1;
    const fe_material *m = &shape->material;
    fe_vec3 s = shape->surface_velocity;
    return m->restitution > 0.0f || m->rolling_resistance > 0.0f || m->spinning_resistance > 0.0f || s.x != 0.0f || s.y != 0.0f ||
           s.z != 0.0f;
}

int32_t fe__pair_kind(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    const fe__shape *x = world->shapes + shape_a, *y = world->shapes + shape_b;
    const fe__body *a = world->bodies + x->body, *b = world->bodies + y->body;
    int32_t kind = a->type == FE_BODY_DYNAMIC && b->type == FE_BODY_DYNAMIC ? FE__ROW_PAIR : 0;
    int32_t kinematic = a->type == FE_BODY_KINEMATIC || b->type == FE_BODY_KINEMATIC;
    if (x->form.type == FE_GEOMETRY_SPHERE || y->form.type == FE_GEOMETRY_SPHERE) kind |= FE__ROW_SINGLE;
    if (a->locked || b->locked || kinematic || has_extra(world, x) || has_extra(world, y)) kind |= FE__ROW_SPECIAL;
    return kind;
}

// velocity of a shape's surface, world axes
static fe_vec3 surface_of(const fe__shape *shape) { return fe__rotate(shape->pose.rotation, shape->surface_velocity); }

void fe__pair_mix_surface(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    fe__extra *e = world->extras + pair;
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    int32_t cell = p->triangle >= 0 ? p->triangle / 2 : -1;
    const fe_material *x = fe__shape_material(world, a, cell), *y = fe__shape_material(world, b, cell);
    fe_vec3 surface = fe__sub(surface_of(b), surface_of(a));
    if (p->flags & FE__PAIR_FLIPPED) surface = fe__neg(surface);
    m->static_friction = sqrtf(x->static_friction * y->static_friction);
    m->surface.dynamic_friction = sqrtf(x->dynamic_friction * y->dynamic_friction);
    e->restitution = fe__maxf(x->restitution, y->restitution);
    e->rolling = fe__maxf(x->rolling_resistance, y->rolling_resistance) * form_radius(a, b);
    e->spinning = fe__maxf(x->spinning_resistance, y->spinning_resistance);
    e->surface_velocity[0] = surface.x, e->surface_velocity[1] = surface.y, e->surface_velocity[2] = surface.z;
}

void fe__pair_mix(fe_world *world, int32_t pair)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    if (p->next_patch >= 0) fe__pair_mix(world, p->next_patch);
    fe__pair_mix_surface(world, pair);
    p->events = world->shapes[p->shape_a].events | world->shapes[p->shape_b].events;
    world->wants_hits |= (p->events & FE_EVENTS_HIT) != 0;
    int32_t kind = fe__pair_kind(world, p->shape_a, p->shape_b);
    world->row_kinds |= 1u << kind;
    if (kind == m->kind) return;
    m->kind = kind;
    if (m->colour >= 0) world->solver.graph_changed = 1;
}

// ---- the constraint graph -------------------------------------------------------------------------------------------------------------
static int32_t first_colour(uint64_t used_low, uint64_t used_high, int32_t first, int32_t end)
{
    for (int32_t word = first / 64; word <= (end - 1) / 64; ++word) {
        uint64_t free = ~(word ? used_high : used_low);
        if (word == first / 64) free &= UINT64_MAX << first % 64;
        if (!free) continue;
        int32_t colour = 64 * word + __builtin_ctzll(free);
        if (colour < end) return colour;
    }
    return FE__OVERFLOW_COLOUR;
}

static void take_colour(fe__body *body, int32_t colour) { body->colours[colour / 64] |= UINT64_C(1) << colour % 64; }
static void return_colour(fe__body *body, int32_t colour) { body->colours[colour / 64] &= ~(UINT64_C(1) << colour % 64); }

// A patch stands before its head in the bodies' lists, so that who walks them may destroy heads on the way.
static void enter_lists(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    add_to_list(world, patch, p->body_a);
    add_to_list(world, patch, p->body_b);
    if (world->pairs[p->head].awake_index >= 0) fe__pair_awaken(world, patch);
}

// A body that comes upon one so many times lighter strains it: its impact is not to find the island unprepared, see solve.c
#define UNEVEN 10.0f

static void note_uneven(fe__body *a, fe__body *b)
{
    float of_a = a->inverse_mass, of_b = b->inverse_mass; // 1/kg
    if (of_a > UNEVEN * of_b) a->flags |= FE__BODY_STRAINED;
    if (of_b > UNEVEN * of_a) b->flags |= FE__BODY_STRAINED;
}

// Contacts of a pile come in an order, left before right. The first free colour would be another name for it: the solver would take left
// before right everywhere, and what a sweep gets wrong would add up (the top of 100 rows went 0.15 m aside). So it is drawn which of a
// colour and its mate (0 and 1, 2 and 3, ...) is taken; layers still follow each other as their colours come. The draw hangs on the
// meetings of the two bodies and of those that they met, not on serials, which strangers shift.
static int32_t draw_colour(fe__body *a, fe__body *b)
{
    uint64_t used[2] = {a->colours[0] | b->colours[0], a->colours[1] | b->colours[1]};
    uint64_t mixed = (((uint64_t)a->drawn << 32 | b->drawn) + 1) * FE_HASH_FACTOR;
    a->drawn = b->drawn = (uint32_t)(mixed >> 32);
    int32_t colour = first_colour(used[0], used[1], 0, FE__PAIR_COLOURS), mate = colour ^ 1;
    if (colour == FE__OVERFLOW_COLOUR || used[mate / 64] >> mate % 64 & 1) return colour;
    return a->drawn >> 31 ? mate : colour;
}

// A body's contacts have different colours, so contacts of one colour share no dynamic body
void fe__pair_link(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    assert(m->colour < 0);
    fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    int32_t both = m->kind & FE__ROW_PAIR;
    m->colour =
        both ? draw_colour(a, b) : first_colour(b->colours[0], b->colours[1], FE__PAIR_COLOURS, FE__PAIR_COLOURS + FE__STATIC_COLOURS);
    if (m->colour != FE__OVERFLOW_COLOUR) {
        take_colour(b, m->colour);
        if (both) take_colour(a, m->colour);
    }
    if (both) note_uneven(a, b);
    world->pairs[pair].flags |= FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    ++world->linked_count;
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
    if (m->colour != FE__OVERFLOW_COLOUR) {
        return_colour(world->bodies + m->body_b, m->colour);
        if (m->kind & FE__ROW_PAIR) return_colour(world->bodies + m->body_a, m->colour);
    }
    m->colour = -1;
    fe__pair_forget_impulses(world, pair);
    world->pairs[pair].flags &= ~(uint32_t)FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    --world->linked_count;
}

void fe__patch_leave(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_retire(world, patch);
    remove_from_list(world, patch, p->body_a);
    remove_from_list(world, patch, p->body_b);
}

// ---- birth and death ------------------------------------------------------------------------------------------------------------------
static float half_size(const fe__form *form) { return fe__maxf(fe__maxf(form->half.x, form->half.y), form->half.z); }

// Which shape is fe__collide's A (see collide.h), and which body is the solver's A: the one that is not dynamic, else that shape's.
static uint32_t sides(const fe_world *world, const fe__shape *a, const fe__shape *b)
{
    int32_t swapped = a->form.type != b->form.type ? a->form.type < b->form.type : half_size(&a->form) < half_size(&b->form);
    int32_t dynamic_a = world->bodies[a->body].type == FE_BODY_DYNAMIC, dynamic_b = world->bodies[b->body].type == FE_BODY_DYNAMIC;
    int32_t flipped = dynamic_a != dynamic_b ? dynamic_a : swapped;
    return (swapped ? (uint32_t)FE__PAIR_SWAPPED : 0u) | (flipped ? (uint32_t)FE__PAIR_FLIPPED : 0u);
}

static int32_t take_slot(fe_world *world)
{
    if (world->first_free_pair < 0) return world->pair_limit++;
    int32_t pair = world->first_free_pair;
    world->first_free_pair = world->pairs[pair].links[0].next;
    return pair;
}

// A record of its own, in no list. Patches have numbers from 1, which make their serials theirs alone.
static int32_t create_record(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number)
{
    enum { NUMBER_SHIFT = 56 };
    int32_t pair = take_slot(world);
    const fe__shape *a = world->shapes + shape_a, *b = world->shapes + shape_b;
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    memset(p, 0, sizeof *p);
    memset(m, 0, sizeof *m);
    memset(world->extras + pair, 0, sizeof *world->extras);
    p->shape_a = shape_a, p->shape_b = shape_b;
    p->body_a = a->body, p->body_b = b->body;
    world->pair_serials[2 * pair] = a->serial;
    world->pair_serials[2 * pair + 1] = b->serial | (uint64_t)number << NUMBER_SHIFT;
    p->flags = sides(world, a, b);
    if ((a->flags | b->flags) & FE__SHAPE_TRIGGER) p->flags |= FE__PAIR_SENSOR;
    if (number) p->flags |= FE__PAIR_PATCH;
    p->awake_index = p->axis = p->next_patch = p->head = p->triangle = -1;
    m->colour = m->kind = -1;
    m->body_a = p->flags & FE__PAIR_FLIPPED ? p->body_b : p->body_a;
    m->body_b = p->flags & FE__PAIR_FLIPPED ? p->body_a : p->body_b;
    return pair;
}

static void create_patches(fe_world *world, int32_t head)
{
    for (int32_t number = FE__PATCHES - 1; number > 0; --number) {
        int32_t patch = create_record(world, world->pairs[head].shape_a, world->pairs[head].shape_b, number);
        world->pairs[patch].head = head;
        world->pairs[patch].next_patch = world->pairs[head].next_patch;
        world->pairs[head].next_patch = patch;
    }
    ++world->field_pair_count;
}

int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b)
{
    int32_t pair = create_record(world, shape_a, shape_b, 0);
    if (fe__is_field_pair(world, shape_a, shape_b)) create_patches(world, pair);
    const fe__pair *p = world->pairs + pair;
    fe__pair_mix(world, pair);
    add_to_body(world, pair, p->body_a);
    add_to_body(world, pair, p->body_b);
    fe__pair_set_insert(&world->pair_set, shape_a, shape_b, pair);
    if (world->bodies[p->body_a].awake_index >= 0 || world->bodies[p->body_b].awake_index >= 0)
        fe__pair_awaken(world, pair);
    else if (concerns_sleepers(world, p))
        fe__pair_look_once(world, pair);
    ++world->pair_count;
    return pair;
}

void fe__pair_release(fe_world *world, int32_t pair)
{
    world->pairs[pair].flags = 0;
    world->pairs[pair].links[0].next = world->first_free_pair;
    world->first_free_pair = pair;
}

static void destroy_patches(fe_world *world, int32_t head)
{
    if (world->pairs[head].next_patch < 0) return;
    for (int32_t patch = world->pairs[head].next_patch, next; patch >= 0; patch = next) {
        next = world->pairs[patch].next_patch;
        if (world->pairs[patch].flags & FE__PAIR_LINKED) {
            fe__pair_unlink(world, patch);
            fe__patch_leave(world, patch);
        }
        fe__pair_release(world, patch);
    }
    --world->field_pair_count;
}

void fe__pair_destroy(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    destroy_patches(world, pair);
    fe__pair_unlink(world, pair);
    fe__pair_retire(world, pair);
    remove_from_body(world, pair, p->body_a);
    remove_from_body(world, pair, p->body_b);
    fe__pair_set_remove(&world->pair_set, p->shape_a, p->shape_b);
    --world->pair_count;
    if (p->flags & FE__PAIR_TOUCHING && p->events & FE_EVENTS_TOUCH)
        fe__owe_exit(world, pair);
    else
        fe__pair_release(world, pair);
}

void fe__body_drop_pairs(fe_world *world, int32_t body)
{
    for (int32_t pair; (pair = world->bodies[body].first_contact) >= 0;)
        fe__pair_destroy(world, world->pairs[pair].flags & FE__PAIR_PATCH ? world->pairs[pair].head : pair);
}

void fe__body_refilter(fe_world *world, int32_t body)
{
    for (int32_t pair = world->bodies[body].first_contact, next; pair >= 0; pair = next) {
        next = fe__next_pair(world, pair, body);
        if (world->pairs[pair].flags & FE__PAIR_PATCH) continue;
        if (!fe__may_collide(world, world->pairs[pair].shape_a, world->pairs[pair].shape_b)) fe__pair_destroy(world, pair);
    }
}
