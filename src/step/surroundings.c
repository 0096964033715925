// surroundings.c - see surroundings.h.
#include "step/surroundings.h"

#include "collision/form/hull_form.h"
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

// ---- the nearest ---------------------------------------------------------------------------------------------------
static float beyond(float x, float low, float high) { return fe__maxf(fe__maxf(low - x, x - high), 0.0f); }

// of a point from a box, m2
static float distance_from(fe_vec3 low, fe_vec3 high, fe_vec3 p)
{
    fe_vec3 away = {beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)};
    return fe__dot(away, away);
}

static float distance_of_solid(const fe__solid *s, fe_vec3 centre)
{
    const fe__form *f = s->form;
    fe_vec3 p = fe__mul_transposed(&s->axes, fe__sub(centre, s->centre));
    if (!fe__form_is_hull(f)) return distance_from(fe__neg(f->half), f->half, p);
    return distance_from(fe__add_scaled(f->offset, f->scale, f->hull->low),
                         fe__add_scaled(f->offset, f->scale, f->hull->high), p);
}

static float distance_of_ground(const fe__neighbour *n, fe_vec3 centre)
{
    fe__bounds box = fe__ground_bounds(&n->ground);
    fe_dvec3 p = fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, centre)));
    return distance_from(fe__narrow(fe__dsub(box.low, p)), fe__narrow(fe__dsub(box.high, p)),
                         (fe_vec3){0.0f, 0.0f, 0.0f});
}

// Where the next one goes among at most `most`, of which the farthest makes room. -1: it is no nearer
static int32_t place_for(float distance, float *distances, int32_t *count, int32_t most)
{
    int32_t place = *count;
    if (*count < most)
        ++*count;
    else {
        place = 0;
        for (int32_t i = 1; i < most; ++i)
            if (distances[i] > distances[place]) place = i;
        if (distance >= distances[place]) return -1;
    }
    distances[place] = distance;
    return place;
}

// How far off is what may hold a body up? What is round is held from as far beyond its lowest point as the rim that it
// touches lies on this side. m2
static float farthest_that_holds(const fe__form *form)
{
    const float wide = 2.0f;
    float reach = wide * fe__form_reach(form, fe__form_middle(form));
    return reach * reach;
}

void fe__find_surroundings(const fe_world *w, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found)
{
    float most = -1.0f; // m2, asked for once something is there: of a hull that is a walk of its vertices
    float grounds[FE__NEIGHBOURS], solids[FE__NEAR_SOLIDS]; // their distances, m2
    found->ground_count = found->solid_count = 0;
    for (int32_t pair = w->bodies[other->body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, other->body)) {
        const fe__pair *p = w->pairs + pair;
        const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b, *near = x == other ? y : x;
        if (p->flags & FE__PAIR_PATCH || near == self || (x != other && y != other)) continue;
        int32_t is_ground = p->next_patch >= 0;
        if (!is_ground && !fe__is_static_solid(w, near)) continue;
        if (most < 0.0f) most = farthest_that_holds(&other->form);
        if (is_ground) {
            fe__neighbour n = place_ground(w, v, near);
            float distance = distance_of_ground(&n, centre);
            int32_t place = distance > most ? -1 : place_for(distance, grounds, &found->ground_count, FE__NEIGHBOURS);
            if (place >= 0) found->grounds[place] = n;
        } else {
            fe__solid s = place_solid(v, near);
            float distance = distance_of_solid(&s, centre);
            int32_t place = distance > most ? -1 : place_for(distance, solids, &found->solid_count, FE__NEAR_SOLIDS);
            if (place >= 0) found->solids[place] = s;
        }
    }
}
