// pair_mix.c - see pair_mix.h.
#include "world/pair_mix.h"

#include "world/material.h"
#include "world/points.h"

// ---- materials -----------------------------------------------------------------------------------------------------
static float form_radius(const fe__shape *a, const fe__shape *b)
{
    return fe__maxf(fe__form_roundness(&a->form), fe__form_roundness(&b->form));
}

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

// A product of two large frictions stays within what one material may have
#define MOST_FRICTION 1e6f
static float mix_friction(int32_t combine, float a, float b)
{
    return combine == FE_COMBINE_DEFAULT ? sqrtf(a * b) : fe__minf(mix(combine, a, b), MOST_FRICTION);
}
static float mix_restitution(int32_t combine, float a, float b) { return mix(combine, a, b); }

// velocity of a shape's surface, world axes
static fe_vec3 surface_of(const fe__shape *shape) { return fe__rotate(shape->pose.rotation, shape->surface_velocity); }

void fe__pair_mix_surface(fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    fe__extra *e = fe__extra_of(world, m);
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    const fe_material *x = fe__shape_material(world, a, p->triangle), *y = fe__shape_material(world, b, p->triangle);
    int32_t friction = fe__maxi(x->friction_combine, y->friction_combine);
    m->static_friction = mix_friction(friction, x->static_friction, y->static_friction);
    m->surface.dynamic_friction = mix_friction(friction, x->dynamic_friction, y->dynamic_friction);
    if (!e) return;
    fe_vec3 surface = fe__sub(surface_of(b), surface_of(a));
    if (p->flags & FE__PAIR_FLIPPED) surface = fe__neg(surface);
    e->restitution =
        mix_restitution(fe__maxi(x->restitution_combine, y->restitution_combine), x->restitution, y->restitution);
    e->rolling = fe__maxf(x->rolling_resistance, y->rolling_resistance) * form_radius(a, b);
    e->spinning = fe__maxf(x->spinning_resistance, y->spinning_resistance);
    e->surface_velocity[0] = surface.x, e->surface_velocity[1] = surface.y, e->surface_velocity[2] = surface.z;
}

void fe__pair_mix(fe_world *world, int32_t pair)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    if (p->next_patch >= 0) fe__pair_mix(world, p->next_patch);
    p->events = (uint8_t)(world->shapes[p->shape_a].events | world->shapes[p->shape_b].events);
    world->wants_hits |= (p->events & FE_SHAPE_EVENTS_HIT) != 0;
    int32_t kind = fe__pair_kind(world, p->shape_a, p->shape_b);
    world->row_kinds |= 1u << kind;
    if (kind != m->kind && m->colour >= 0) world->solver.graph_changed = 1, ++world->solver.unbuilt;
    m->kind = kind;
    fe__pair_mix_surface(world, pair);
}
