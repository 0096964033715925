// contact.c - see contact.h.
#include "world/contact.h"

#include <assert.h>

// ---- lists ----------------------------------------------------------------------------------------------------------

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

void fe__body_end_deferrals(fe_world *world, int32_t body)
{
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        end_deferral(world, pair);
        // a pair without points measured its gap from the centre as it was
        if (!(world->contacts[pair].point_count > 0.0f)) world->contacts[pair].surface.tolerance = 0.0f;
    }
}

// ---- mixed materials ------------------------------------------------------------------------------------------------

static int32_t has_extra(const fe_world *world, const fe__shape *shape)
{
    if (fe__form_is_field(&shape->form) && fe__store_parent(world->store, shape->form.field)->special) return 1;
    const fe_material *m = &shape->material;
    fe_vec3 s = shape->surface_velocity;
    return m->restitution > 0.0f || m->rolling_resistance > 0.0f || m->spinning_resistance > 0.0f || s.x != 0.0f ||
           s.y != 0.0f || s.z != 0.0f;
}

int32_t fe__pair_kind(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    const fe__shape *x = world->shapes + shape_a, *y = world->shapes + shape_b;
    const fe__body *a = world->bodies + x->body, *b = world->bodies + y->body;
    int32_t kind = a->type == FE_BODY_DYNAMIC && b->type == FE_BODY_DYNAMIC ? FE__ROW_PAIR : 0;
    int32_t kinematic = a->type == FE_BODY_KINEMATIC || b->type == FE_BODY_KINEMATIC;
    if (fe__form_is_ball(&x->form) || fe__form_is_ball(&y->form)) kind |= FE__ROW_SINGLE;
    if (a->locked || b->locked || kinematic || has_extra(world, x) || has_extra(world, y)) kind |= FE__ROW_SPECIAL;
    return kind;
}

static float mix(int32_t combine, float a, float b)
{
    switch (combine) {
    case FE_COMBINE_AVERAGE:
        return 0.5f * (a + b);
    case FE_COMBINE_MINIMUM:
        return fe__minf(a, b);
    case FE_COMBINE_MULTIPLY:
        return a * b;
    default:
        return fe__maxf(a, b);
    }
}

static float mix_friction(int32_t combine, float a, float b)
{
    const float most = 1e6f; // a product of two large frictions stays within what one material may have
    return combine == FE_COMBINE_DEFAULT ? sqrtf(a * b) : fe__minf(mix(combine, a, b), most);
}

// Velocity of a shape's surface, world axes
static fe_vec3 surface_velocity_of(const fe__shape *shape)
{
    return fe__rotate(shape->pose.rotation, shape->surface_velocity);
}

void fe__pair_mix_surface(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    fe__extra *extra = fe__extra_of(world, contact);
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    const fe_material *x = fe__shape_material(world, a, p->triangle), *y = fe__shape_material(world, b, p->triangle);
    int32_t friction = fe__maxi(x->friction_combine, y->friction_combine);
    contact->static_friction = mix_friction(friction, x->static_friction, y->static_friction);
    contact->surface.dynamic_friction = mix_friction(friction, x->dynamic_friction, y->dynamic_friction);
    if (!extra) return;
    fe_vec3 velocity = fe__sub(surface_velocity_of(b), surface_velocity_of(a));
    if (p->flags & FE__PAIR_FLIPPED) velocity = fe__neg(velocity);
    float radius = fe__maxf(fe__form_roundness(&a->form), fe__form_roundness(&b->form));
    int32_t restitution = fe__maxi(x->restitution_combine, y->restitution_combine);
    extra->restitution = mix(restitution, x->restitution, y->restitution);
    extra->rolling = fe__maxf(x->rolling_resistance, y->rolling_resistance) * radius;
    extra->spinning = fe__maxf(x->spinning_resistance, y->spinning_resistance);
    extra->surface_velocity[0] = velocity.x, extra->surface_velocity[1] = velocity.y,
    extra->surface_velocity[2] = velocity.z;
}

void fe__pair_mix(fe_world *world, int32_t pair)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    if (p->next_patch >= 0) fe__pair_mix(world, p->next_patch);
    p->events = (uint8_t)(world->shapes[p->shape_a].events | world->shapes[p->shape_b].events);
    world->wants_hits |= (p->events & FE_SHAPE_EVENTS_HIT) != 0;
    int32_t kind = fe__pair_kind(world, p->shape_a, p->shape_b);
    world->row_kinds |= 1u << kind;
    if (kind != contact->kind && contact->colour >= 0) world->solver.graph_changed = 1, ++world->solver.unbuilt;
    contact->kind = kind;
    fe__pair_mix_surface(world, pair);
}

// ---- points ---------------------------------------------------------------------------------------------------------

int32_t fe__points_reserve(fe_world *world, int64_t more, int32_t with_extras)
{
    fe__memory *memory = &world->memory;
    int64_t need = atomic_load(&world->point_count) + more;
    int32_t ordered = world->point_order_capacity, had_extras = world->extra_capacity > 0;
    if (!FE_RESERVE(memory, world->points, world->point_capacity, need) ||
        !FE_RESERVE(memory, world->features, world->feature_capacity, need) ||
        !FE_RESERVE(memory, world->point_serials, world->point_serial_capacity, 2 * need) ||
        !FE_RESERVE(memory, world->point_order, world->point_order_capacity, need))
        return 0;
    for (int32_t i = ordered; i < world->point_order_capacity; ++i) world->point_order[i] = i;
    if (!with_extras) return 1;
    if (!FE_RESERVE(memory, world->extras, world->extra_capacity, world->point_capacity)) return 0;
    // the first special row of a world: all extras are mixed before any is read
    for (int32_t i = 1; i < world->pair_limit && !had_extras; ++i)
        if (!(world->pairs[i].flags & FE__PAIR_FREE)) fe__pair_mix_surface(world, i);
    return 1;
}

void fe__points_take(fe_world *world, int32_t pair)
{
    int32_t place = atomic_fetch_add_explicit(&world->point_count, 1, memory_order_relaxed);
    assert(place < world->point_order_capacity);
    int32_t points = world->contacts[pair].points = world->point_order[place];
    world->points[points] = (fe__points){.twist_impulse = 0.0f};
    world->features[points] = (fe__features){.approach = 0.0f};
    for (int32_t side = 0; side < 2; ++side)
        world->point_serials[2 * points + side] = fe__pair_serial(world, pair, side);
    if (points >= world->extra_capacity) return;
    world->extras[points] = (fe__extra){.restitution = 0.0f};
    if (fe__extra_of(world, world->contacts + pair)) fe__pair_mix_surface(world, pair);
}

void fe__points_release(fe_world *world, int32_t pair)
{
    fe__contact *contact = world->contacts + pair;
    if (!contact->points) return;
    int32_t last = atomic_load_explicit(&world->point_count, memory_order_relaxed) - 1;
    atomic_store_explicit(&world->point_count, last, memory_order_relaxed);
    world->point_order[last] = contact->points;
    contact->points = 0;
    world->pairs[pair].left_out = 0;
}
