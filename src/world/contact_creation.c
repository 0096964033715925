// contact_creation.c - the life of pairs: they are created and destroyed, linked into the constraint graph and
// unlinked.
//
// Called by the step's stages, and between steps by changes of bodies and shapes. A pair that ends while it touches
// owes an exit event, which the next step reports.
#include "world/contact_creation.h"

#include "collision/manifold/collide.h"
#include "solver/graph/graph.h"
#include "world/contact.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/world.h"

#include <string.h>

// ---- creation -------------------------------------------------------------------------------------------------------

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

// Enters or leaves the list of a body. `sign`: 1 or -1
static void count_at_body(fe_world *world, int32_t pair, int32_t index, int32_t sign)
{
    fe__body *body = world->bodies + index;
    const fe__pair *p = world->pairs + pair;
    int32_t is_with_static =
        world->bodies[p->body_a].type == FE_BODY_STATIC || world->bodies[p->body_b].type == FE_BODY_STATIC;
    if (sign > 0)
        fe__pair_add_to_list(world, pair, index);
    else
        fe__pair_remove_from_list(world, pair, index);
    body->contact_count += sign * (p->next_patch >= 0 ? FE__PATCHES : 1); // as many as the pair may have
    body->static_pairs += sign * is_with_static;
}

uint32_t fe__pair_nature(const fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number)
{
    const fe__shape *a = world->shapes + shape_a, *b = world->shapes + shape_b;
    // the solver's A is the body that is not dynamic, or else the body of fe__collide's A (see collide.h)
    int32_t swapped = fe__collide_swaps(&a->form, &b->form);
    int32_t a_is_dynamic = world->bodies[a->body].type == FE_BODY_DYNAMIC,
            b_is_dynamic = world->bodies[b->body].type == FE_BODY_DYNAMIC;
    int32_t flipped = a_is_dynamic != b_is_dynamic ? a_is_dynamic : swapped;
    uint32_t flags = (uint32_t)number << FE__PAIR_NUMBER_SHIFT;
    if (swapped) flags |= FE__PAIR_SWAPPED;
    if (flipped) flags |= FE__PAIR_FLIPPED;
    if ((a->flags | b->flags) & FE__SHAPE_TRIGGER) flags |= FE__PAIR_SENSOR;
    if (a->parent >= 0 || b->parent >= 0) flags |= FE__PAIR_OF_PARTS;
    return number ? flags | FE__PAIR_PATCH : flags;
}

// A record in no list. `number`: 0, or that of a patch
static int32_t create_record(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number)
{
    int32_t pair = world->first_free_pair;
    if (pair >= 0)
        world->first_free_pair = world->pairs[pair].links[0].next;
    else
        pair = world->pair_limit++;
    fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    memset(p, 0, sizeof *p);
    memset(contact, 0, sizeof *contact);
    p->shape_a = shape_a, p->shape_b = shape_b;
    p->body_a = world->shapes[shape_a].body, p->body_b = world->shapes[shape_b].body;
    p->flags = fe__pair_nature(world, shape_a, shape_b, number);
    p->awake_index = p->axis = p->next_patch = p->head = p->triangle = -1;
    contact->colour = contact->kind = -1;
    contact->body_a = p->flags & FE__PAIR_FLIPPED ? p->body_b : p->body_a;
    contact->body_b = p->flags & FE__PAIR_FLIPPED ? p->body_a : p->body_b;
    return pair;
}

int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t denied)
{
    int32_t pair = create_record(world, shape_a, shape_b, 0);
    fe__pair *p = world->pairs + pair;
    if (denied) {
        p->flags |= FE__PAIR_DENIED;
    } else if (fe__is_field_pair(world, shape_a, shape_b)) {
        for (int32_t number = FE__PATCHES - 1; number > 0; --number) {
            int32_t patch = create_record(world, shape_a, shape_b, number);
            world->pairs[patch].head = pair;
            world->pairs[patch].next_patch = p->next_patch;
            p->next_patch = patch;
        }
        ++world->field_pair_count;
    }
    fe__pair_mix(world, pair);
    count_at_body(world, pair, p->body_a, 1);
    count_at_body(world, pair, p->body_b, 1);
    fe__pair_set_insert(&world->pair_set, shape_a, shape_b, pair);
    if (p->flags & FE__PAIR_OF_PARTS) fe__encounter_gain(world, pair);
    const fe__body *a = world->bodies + p->body_a, *b = world->bodies + p->body_b;
    // Triggers see sleepers, and a static body that comes to a sleeper wakes it. Bodies that are created asleep stay
    // so, whatever they touch.
    int32_t a_is_dynamic = a->type == FE_BODY_DYNAMIC, b_is_dynamic = b->type == FE_BODY_DYNAMIC;
    const fe__shape *sleeper = world->shapes + (a_is_dynamic ? shape_a : shape_b);
    int32_t concerns_sleepers =
        p->flags & FE__PAIR_SENSOR || (a_is_dynamic != b_is_dynamic && !(sleeper->flags & FE__SHAPE_MOVED));
    if (a->awake_index >= 0 || b->awake_index >= 0)
        fe__pair_awaken(world, pair);
    else if (concerns_sleepers)
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

// ---- events ---------------------------------------------------------------------------------------------------------

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

// ---- destruction ----------------------------------------------------------------------------------------------------

void fe__pair_destroy(fe_world *world, int32_t pair)
{
    fe__pair *p = world->pairs + pair;
    int32_t touched = (p->flags & FE__PAIR_TOUCHING) != 0;
    if (p->next_patch >= 0) --world->field_pair_count;
    for (int32_t patch = p->next_patch, next; patch >= 0; patch = next) {
        next = world->pairs[patch].next_patch;
        if (world->pairs[patch].flags & FE__PAIR_LINKED) {
            fe__pair_unlink(world, patch);
            fe__patch_leave(world, patch);
        }
        fe__points_release(world, patch);
        fe__pair_release(world, patch);
    }
    fe__pair_unlink(world, pair);
    if (p->flags & FE__PAIR_OF_PARTS) touched = fe__encounter_lose(world, pair);
    fe__points_release(world, pair);
    fe__pair_retire(world, pair);
    count_at_body(world, pair, p->body_a, -1);
    count_at_body(world, pair, p->body_b, -1);
    fe__pair_set_remove(&world->pair_set, p->shape_a, p->shape_b);
    --world->pair_count;
    world->trigger_pair_count -= (p->flags & FE__PAIR_SENSOR) != 0;
    if (!(touched && p->events & FE_SHAPE_EVENTS_TOUCH)) {
        fe__pair_release(world, pair);
        return;
    }
    // An exit that is owed waits in the record of its contact: its handles may be stale when it is reported.
    _Static_assert(sizeof(fe__pair_event_record) <= sizeof(fe__contact), "an exit fits into its record");
    fe__pair_event_record owed = fe__pair_event_of(world, pair, FE_EVENT_EXIT);
    owed.triangle = -1; // the pair is no longer over a triangle, nor at a part
    owed.serial_a = fe__serial_of_whole(owed.serial_a), owed.serial_b = fe__serial_of_whole(owed.serial_b);
    memcpy(world->contacts + pair, &owed, sizeof owed);
    p->flags = FE__PAIR_FREE;
    p->links[0].next = world->first_owed;
    world->first_owed = pair;
    ++world->owed_count;
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

// ---- links ----------------------------------------------------------------------------------------------------------

// A body that falls on one so many times lighter, which lies on the ground, is stopped in many passes: the light one
// hands its impulse on and comes back at rest, so that each pass takes one part in 1 + ratio of the speed u. There are
// two passes in a substep h; until they have stopped it the body sinks by u (h / 2) (1 + ratio). From ten times the
// linear slop on that strains the light one, at once: the impact is not to find its island unprepared, see solve.c.
// Only the vertical part of u counts, because a body that is struck sideways is held by nothing and moves on.
static void note_uneven_masses(fe_world *world, const fe__contact *contact, float dt)
{
    const float uneven = 5.0f, most_sink = 0.05f; // ratio of the masses; m
    fe__body *heavy = world->bodies + contact->body_a, *light = world->bodies + contact->body_b;
    fe_vec3 n = fe__quad_vector(contact->normal); // from the heavy one to the light one
    if (heavy->inverse_mass > light->inverse_mass) {
        fe__body *lighter = heavy;
        heavy = light, light = lighter, n = fe__scale(-1.0f, n);
    }
    if (light->inverse_mass <= uneven * heavy->inverse_mass) return;
    // u, m/s: the vertical motion along the normal; without gravity all motion; 0 where the heavy one is below
    fe_vec3 v = fe__sub(fe__quad_vector(heavy->velocity), fe__quad_vector(light->velocity)), g = world->gravity;
    float square = fe__dot(g, g), down = fe__dot(n, g), u = fe__dot(n, v);
    if (square > 0.0f) u = down > 0.0f ? fe__dot(v, g) * down / square : 0.0f;
    float ratio = light->inverse_mass / heavy->inverse_mass, between_passes = 0.5f * dt / (float)world->substeps;
    if (u * between_passes * (1.0f + ratio) > most_sink) light->flags |= FE__BODY_STRAINED;
}

void fe__pair_note_colour(fe_world *world, const fe__contact *contact)
{
    int32_t colour = contact->colour, is_pair = (contact->kind & FE__ROW_PAIR) != 0;
    if (colour < 0) return;
    if (colour == FE__OVERFLOW_COLOUR) { // it found all of its kind taken
        if (is_pair)
            world->pair_colours = FE__PAIR_COLOURS;
        else
            world->static_colours = FE__STATIC_COLOURS;
    } else if (colour < FE__PAIR_COLOURS) {
        world->pair_colours = fe__maxi(world->pair_colours, colour + 1);
    } else {
        world->static_colours = fe__maxi(world->static_colours, colour - FE__PAIR_COLOURS + 1);
    }
}

// Patches are in no encounter: their head is.
static int32_t has_encounter(const fe__pair *p)
{
    return (p->flags & (FE__PAIR_OF_PARTS | FE__PAIR_PATCH)) == FE__PAIR_OF_PARTS;
}

void fe__pair_link(fe_world *world, int32_t pair, float dt)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    fe__colour_contact(world->bodies, contact);
    if (contact->kind & FE__ROW_PAIR) note_uneven_masses(world, contact, dt);
    p->flags |= FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    ++world->linked_count;
    fe__pair_note_colour(world, contact);
    if (p->awake_index >= 0) ++world->awake_linked_count, ++world->solver.unbuilt;
    if (has_encounter(p)) fe__encounter_hold(world, pair, 1);
    if (!(p->flags & FE__PAIR_PATCH)) return;
    // a patch stands before its head in the bodies' lists, so that a walk over them may destroy heads on the way
    fe__pair_add_to_list(world, pair, p->body_a);
    fe__pair_add_to_list(world, pair, p->body_b);
    if (world->pairs[p->head].awake_index >= 0) fe__pair_awaken(world, pair);
}

void fe__pair_forget_impulses(fe_world *world, int32_t pair)
{
    const fe__contact *contact = world->contacts + pair;
    if (!contact->points) return;
    fe__points_forget_impulses(fe__points_of(world, contact));
    fe__extra *extra = fe__extra_of(world, contact);
    for (int k = 0; k < 3 && extra; ++k) extra->rolling_impulse[k] = 0.0f;
}

void fe__pair_unlink(fe_world *world, int32_t pair)
{
    fe__contact *contact = world->contacts + pair;
    if (contact->colour < 0) return;
    fe__uncolour_contact(world->bodies, contact);
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
