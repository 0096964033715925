// contact_creation.c - the life of pairs: birth, and death with the exit it owes.
#include "world/contact_creation.h"

#include "collision/manifold/collide.h"
#include "solver/graph/graph.h"
#include "world/contact.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/world.h"

#include <string.h>

// ---- pairs ----------------------------------------------------------------------------------------------------------

int32_t fe__reserve_pairs(fe_world *world, int32_t extra)
{
    fe__memory *memory = &world->memory;
    int64_t limit = (int64_t)world->pair_limit + extra;
    return FE_RESERVE(memory, world->contacts, world->contact_capacity, limit) &&
           FE_RESERVE(memory, world->pairs, world->pair_capacity, limit) &&
           FE_RESERVE(memory, world->awake_pairs, world->awake_pair_capacity, limit) &&
           FE_RESERVE(memory, world->deferrals, world->deferral_capacity, limit) &&
           fe__pair_set_reserve(&world->pair_set, memory, extra) && fe__reserve_encounters(world, extra);
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
    fe__pair_add_to_list(world, pair, index);
    body->contact_count += world->pairs[pair].next_patch >= 0 ? FE__PATCHES : 1;
    body->static_pairs += is_with_static(world, pair);
}

static void remove_from_body(fe_world *world, int32_t pair, int32_t index)
{
    fe__pair_remove_from_list(world, pair, index);
    world->bodies[index].contact_count -= world->pairs[pair].next_patch >= 0 ? FE__PATCHES : 1;
    world->bodies[index].static_pairs -= is_with_static(world, pair);
}

// Triggers see sleepers, and a static body that comes to a sleeper wakes it. Bodies that are created asleep stay so,
// whatever they touch.
static int32_t concerns_sleepers(const fe_world *world, const fe__pair *p)
{
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    int32_t dynamic_a = world->bodies[p->body_a].type == FE_BODY_DYNAMIC,
            dynamic_b = world->bodies[p->body_b].type == FE_BODY_DYNAMIC;
    const fe__shape *sleeper = dynamic_a ? a : b;
    return p->flags & FE__PAIR_SENSOR || (dynamic_a != dynamic_b && !(sleeper->flags & FE__SHAPE_MOVED));
}

// ---- birth ---------------------------------------------------------------------------------------------------------
// Which shape is fe__collide's A (see collide.h), and which body is the solver's A: the one that is not dynamic, else
// that shape's.
static uint32_t sides(const fe_world *world, const fe__shape *a, const fe__shape *b)
{
    int32_t swapped = fe__collide_swaps(&a->form, &b->form);
    int32_t dynamic_a = world->bodies[a->body].type == FE_BODY_DYNAMIC,
            dynamic_b = world->bodies[b->body].type == FE_BODY_DYNAMIC;
    int32_t flipped = dynamic_a != dynamic_b ? dynamic_a : swapped;
    return (swapped ? (uint32_t)FE__PAIR_SWAPPED : 0u) | (flipped ? (uint32_t)FE__PAIR_FLIPPED : 0u);
}

// What a pair is by its shapes and its number alone
uint32_t fe__pair_nature(const fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number)
{
    const fe__shape *a = world->shapes + shape_a, *b = world->shapes + shape_b;
    uint32_t flags = sides(world, a, b) | (uint32_t)number << FE__PAIR_NUMBER_SHIFT;
    if ((a->flags | b->flags) & FE__SHAPE_TRIGGER) flags |= FE__PAIR_SENSOR;
    if (a->parent >= 0 || b->parent >= 0) flags |= FE__PAIR_OF_PARTS;
    return number ? flags | FE__PAIR_PATCH : flags;
}

static int32_t take_slot(fe_world *world)
{
    if (world->first_free_pair < 0) return world->pair_limit++;
    int32_t pair = world->first_free_pair;
    world->first_free_pair = world->pairs[pair].links[0].next;
    return pair;
}

// A record of its own, in no list
static int32_t create_record(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number)
{
    int32_t pair = take_slot(world);
    const fe__shape *a = world->shapes + shape_a, *b = world->shapes + shape_b;
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    memset(p, 0, sizeof *p);
    memset(m, 0, sizeof *m);
    p->shape_a = shape_a, p->shape_b = shape_b;
    p->body_a = a->body, p->body_b = b->body;
    p->flags = fe__pair_nature(world, shape_a, shape_b, number);
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

int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t denied)
{
    int32_t pair = create_record(world, shape_a, shape_b, 0);
    if (denied)
        world->pairs[pair].flags |= FE__PAIR_DENIED;
    else if (fe__is_field_pair(world, shape_a, shape_b))
        create_patches(world, pair);
    const fe__pair *p = world->pairs + pair;
    fe__pair_mix(world, pair);
    add_to_body(world, pair, p->body_a);
    add_to_body(world, pair, p->body_b);
    fe__pair_set_insert(&world->pair_set, shape_a, shape_b, pair);
    if (p->flags & FE__PAIR_OF_PARTS) fe__encounter_gain(world, pair);
    if (world->bodies[p->body_a].awake_index >= 0 || world->bodies[p->body_b].awake_index >= 0)
        fe__pair_awaken(world, pair);
    else if (concerns_sleepers(world, p))
        fe__pair_look_once(world, pair);
    ++world->pair_count;
    world->trigger_pair_count += (p->flags & FE__PAIR_SENSOR) != 0;
    return pair;
}

void fe__pair_release(fe_world *world, int32_t pair)
{
    world->pairs[pair].flags = FE__PAIR_FREE;
    world->pairs[pair].links[0].next = world->first_free_pair;
    world->first_free_pair = pair;
}

// ---- events --------------------------------------------------------------------------------------------------------
fe__pair_event_record fe__pair_event_of(const fe_world *world, int32_t pair, int32_t kind)
{
    const fe__pair *p = world->pairs + pair;
    return (fe__pair_event_record){.serial_a = fe__pair_serial(world, pair, 0),
                                   .serial_b = fe__pair_serial(world, pair, 1),
                                   .body_a = fe__body_handle(world, p->body_a),
                                   .body_b = fe__body_handle(world, p->body_b),
                                   .shape_a = fe__shape_handle(world, p->shape_a),
                                   .shape_b = fe__shape_handle(world, p->shape_b),
                                   .kind = (int16_t)kind,
                                   .is_trigger = (p->flags & FE__PAIR_SENSOR) != 0,
                                   .field_a = fe__form_is_field(&world->shapes[p->shape_a].form) != 0,
                                   .triangle = p->triangle};
}

// An exit that is owed waits in the record of its contact: its handles may be stale when it is reported.
_Static_assert(sizeof(fe__pair_event_record) <= sizeof(fe__contact), "an exit fits into its record");

static void owe_exit(fe_world *world, int32_t pair)
{
    fe__pair_event_record owed = fe__pair_event_of(world, pair, FE_EVENT_EXIT);
    owed.triangle = -1; // the pair is no longer over it, nor at a part
    owed.serial_a = fe__serial_of_whole(owed.serial_a), owed.serial_b = fe__serial_of_whole(owed.serial_b);
    memcpy(world->contacts + pair, &owed, sizeof owed);
    world->pairs[pair].flags = FE__PAIR_FREE;
    world->pairs[pair].links[0].next = world->first_owed;
    world->first_owed = pair;
    ++world->owed_count;
}

void fe__report_owed_exits(fe_world *world)
{
    while (world->first_owed) {
        int32_t pair = world->first_owed;
        memcpy(world->pair_events + world->pair_event_count++, world->contacts + pair, sizeof *world->pair_events);
        world->first_owed = world->pairs[pair].links[0].next;
        fe__pair_release(world, pair);
    }
    world->owed_count = 0;
}

// ---- death ---------------------------------------------------------------------------------------------------------
static void destroy_patches(fe_world *world, int32_t head)
{
    if (world->pairs[head].next_patch < 0) return;
    for (int32_t patch = world->pairs[head].next_patch, next; patch >= 0; patch = next) {
        next = world->pairs[patch].next_patch;
        if (world->pairs[patch].flags & FE__PAIR_LINKED) {
            fe__pair_unlink(world, patch);
            fe__patch_leave(world, patch);
        }
        fe__points_release(world, patch);
        fe__pair_release(world, patch);
    }
    --world->field_pair_count;
}

void fe__pair_destroy(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    int32_t touched = (p->flags & FE__PAIR_TOUCHING) != 0;
    destroy_patches(world, pair);
    fe__pair_unlink(world, pair);
    if (p->flags & FE__PAIR_OF_PARTS) touched = fe__encounter_lose(world, pair);
    fe__points_release(world, pair);
    fe__pair_retire(world, pair);
    remove_from_body(world, pair, p->body_a);
    remove_from_body(world, pair, p->body_b);
    fe__pair_set_remove(&world->pair_set, p->shape_a, p->shape_b);
    --world->pair_count;
    world->trigger_pair_count -= (p->flags & FE__PAIR_SENSOR) != 0;
    if (touched && p->events & FE_SHAPE_EVENTS_TOUCH)
        owe_exit(world, pair);
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
        if (!fe__may_collide(world, world->pairs[pair].shape_a, world->pairs[pair].shape_b))
            fe__pair_destroy(world, pair);
    }
}

// ---- pair link ------------------------------------------------------------------------------------------------------

// A patch stands before its head in the bodies' lists, so that who walks them may destroy heads on the way.
static void enter_lists(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_add_to_list(world, patch, p->body_a);
    fe__pair_add_to_list(world, patch, p->body_b);
    if (world->pairs[p->head].awake_index >= 0) fe__pair_awaken(world, patch);
}

// A body that falls on one so many times lighter, which lies on the ground, is stopped in many passes: the light one
// hands its impulse on and comes back at rest, so that each pass takes one part in 1 + ratio of the speed u. There are
// two passes in a substep h; until they have stopped it the body sinks by u (h / 2) (1 + ratio). From ten times the
// linear slop on that strains the light one, at once: the impact is not to find its island unprepared, see solve.c. Of
// u only what is vertical counts, as what is struck sideways is held by nothing and moves on.
#define UNEVEN 5.0f
#define MOST_SINK 0.05f // m

// m/s, of the vertical motions along the normal; without gravity of all. 0 or less: the heavy one is below
static float falling_speed(const fe__body *heavy, const fe__body *light, fe_vec3 to_light, fe_vec3 gravity)
{
    fe_vec3 v = fe__sub(fe__quad_vector(heavy->velocity), fe__quad_vector(light->velocity));
    float square = fe__dot(gravity, gravity), down = fe__dot(to_light, gravity);
    if (!(square > 0.0f)) return fe__dot(to_light, v);
    return down > 0.0f ? fe__dot(v, gravity) * down / square : 0.0f;
}

static void note_uneven(fe_world *world, const fe__contact *m, float dt)
{
    fe__body *heavy = world->bodies + m->body_a, *light = world->bodies + m->body_b;
    fe_vec3 n = fe__quad_vector(m->normal);
    if (heavy->inverse_mass > light->inverse_mass) {
        fe__body *lighter = heavy;
        heavy = light, light = lighter, n = fe__scale(-1.0f, n);
    }
    if (light->inverse_mass <= UNEVEN * heavy->inverse_mass) return;
    float ratio = light->inverse_mass / heavy->inverse_mass, between_passes = 0.5f * dt / (float)world->substeps;
    float sink = falling_speed(heavy, light, n, world->gravity) * between_passes * (1.0f + ratio);
    if (sink > MOST_SINK) light->flags |= FE__BODY_STRAINED;
}

void fe__pair_note_colour(fe_world *world, const fe__contact *m)
{
    if (m->colour < 0) return;
    if (m->colour == FE__OVERFLOW_COLOUR) // it found all of its kind taken
        *(m->kind & FE__ROW_PAIR ? &world->pair_colours : &world->static_colours) =
            m->kind & FE__ROW_PAIR ? FE__PAIR_COLOURS : FE__STATIC_COLOURS;
    else if (m->colour < FE__PAIR_COLOURS)
        world->pair_colours = fe__maxi(world->pair_colours, m->colour + 1);
    else
        world->static_colours = fe__maxi(world->static_colours, m->colour - FE__PAIR_COLOURS + 1);
}

// Patches are their head's
static int32_t has_encounter(const fe__pair *p)
{
    return (p->flags & (FE__PAIR_OF_PARTS | FE__PAIR_PATCH)) == FE__PAIR_OF_PARTS;
}

void fe__pair_link(fe_world *world, int32_t pair, float dt)
{
    fe__contact *m = world->contacts + pair;
    fe__colour_contact(world->bodies, m);
    if (m->kind & FE__ROW_PAIR) note_uneven(world, m, dt);
    world->pairs[pair].flags |= FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    ++world->linked_count;
    fe__pair_note_colour(world, m);
    if (world->pairs[pair].awake_index >= 0) ++world->awake_linked_count, ++world->solver.unbuilt;
    if (has_encounter(world->pairs + pair)) fe__encounter_hold(world, pair, 1);
    if (world->pairs[pair].flags & FE__PAIR_PATCH) enter_lists(world, pair);
}

void fe__pair_forget_impulses(fe_world *world, int32_t pair)
{
    const fe__contact *m = world->contacts + pair;
    if (!m->points) return;
    fe__points_forget_impulses(fe__points_of(world, m));
    fe__extra *e = fe__extra_of(world, m);
    for (int k = 0; k < 3 && e; ++k) e->rolling_impulse[k] = 0.0f;
}

void fe__pair_unlink(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    if (m->colour < 0) return;
    fe__uncolour_contact(world->bodies, m);
    fe__points_release(world, pair);
    world->pairs[pair].flags &= ~(uint32_t)FE__PAIR_LINKED;
    if (has_encounter(world->pairs + pair)) fe__encounter_hold(world, pair, 0);
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
