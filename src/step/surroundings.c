// surroundings.c - see surroundings.h.
#include "step/surroundings.h"

#include "world/pair_list.h"

int32_t fe__is_static_solid(const fe_world *w, const fe__shape *shape)
{
    return fe__form_is_solid(&shape->form) && w->bodies[shape->body].type == FE_BODY_STATIC &&
           !(shape->flags & FE__SHAPE_TRIGGER);
}

static fe__mat3 axes_of(const fe__view *v, const fe__shape *shape)
{
    fe__mat3 r = fe__matrix(shape->pose.rotation);
    return (fe__mat3){fe__mul_transposed(&v->rotation, r.x), fe__mul_transposed(&v->rotation, r.y),
                      fe__mul_transposed(&v->rotation, r.z)};
}

static fe__solid place_solid(const fe__view *v, const fe__shape *shape)
{
    return (fe__solid){&shape->form,
                       fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(shape->pose.position, v->origin))),
                       axes_of(v, shape)};
}

static fe__neighbour place_ground(const fe_world *w, const fe__view *v, const fe__shape *shape)
{
    return (fe__neighbour){fe__store_ground(w->store, &shape->form),
                           fe__drotate_back(shape->pose.rotation, fe__dsub(v->origin, shape->pose.position)),
                           axes_of(v, shape)};
}

void fe__find_surroundings(const fe_world *w, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe__surroundings *found)
{
    found->ground_count = found->solid_count = 0;
    for (int32_t pair = w->bodies[other->body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, other->body)) {
        const fe__pair *p = w->pairs + pair;
        const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b, *near = x == other ? y : x;
        if (p->flags & FE__PAIR_PATCH || near == self || (x != other && y != other)) continue;
        if (p->next_patch >= 0) {
            if (found->ground_count < FE__NEIGHBOURS) found->grounds[found->ground_count++] = place_ground(w, v, near);
        } else if (found->solid_count < FE__NEAR_SOLIDS && fe__is_static_solid(w, near))
            found->solids[found->solid_count++] = place_solid(v, near);
    }
}
