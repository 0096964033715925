// ahead.c - see ahead.h.
#include "step/ahead.h"

#include "collision/cast/toi.h"
#include "world/pair_list.h"
#include "world/pairs.h"
#include "world/pose.h"

// What a body would go into something fixed before it touches the other, as a share of its thickness, up to which its
// motion stays the same
#define SHALLOW 0.25

static fe__mobile mobile_of(const fe_world *world, int32_t shape, float dt, fe_dvec3 base)
{
    const fe__shape *s = world->shapes + shape;
    const fe__body *body = world->bodies + s->body;
    fe_dvec3 centre;
    fe_quat rotation;
    fe__advance(world, body, dt, &centre, &rotation);
    fe__motion m = {fe__dsub(fe__centre_of(body), base), fe__rotation_of(body), fe__dsub(centre, fe__centre_of(body)),
                    fe__identity()};
    fe_quat q = m.angular_displacement;
    if (body->awake_index >= 0) q = fe__normalized(fe__product(rotation, fe__conjugate(m.rotation)));
    m.angular_displacement = q.w < 0.0f ? (fe_quat){-q.x, -q.y, -q.z, -q.w} : q;
    return (fe__mobile){&s->form,
                        fe__dsub(fe__widen(s->local_position), fe__widen(fe__quad_vector(body->local_centre))),
                        s->local_rotation, m};
}

static fe__meeting meeting_of(const fe_world *world, int32_t pair, float dt, double limit, fe__mobile *a, fe__mobile *b,
                              fe__impact *impact)
{
    const fe__pair *p = world->pairs + pair;
    const fe__body *near = world->bodies + (world->bodies[p->body_a].type == FE_BODY_DYNAMIC ? p->body_a : p->body_b);
    *a = mobile_of(world, p->shape_a, dt, fe__centre_of(near)),
    *b = mobile_of(world, p->shape_b, dt, fe__centre_of(near));
    return fe__time_of_impact(a, b, limit, impact);
}

int32_t fe__pair_meets_ahead(const fe_world *world, int32_t pair, float dt)
{
    fe__mobile a, b;
    fe__impact impact;
    return meeting_of(world, pair, dt, 1.0, &a, &b, &impact) != FE_MEET_NEVER;
}

// sine of half the angle until the touch above which a contact says nothing of the bodies as they are now
#define TURNED 0.25f

static int32_t turns_far(const fe__motion *m, double time)
{
    fe_quat q = m->angular_displacement;
    return (float)time * sqrtf(q.x * q.x + q.y * q.y + q.z * q.z) > TURNED;
}

// Does a body meet something that does not give way before that time?
static int32_t is_turned_away(const fe_world *world, int32_t body, int32_t pair, float dt, double time)
{
    if (world->bodies[body].type != FE_BODY_DYNAMIC) return 0;
    for (int32_t i = world->bodies[body].first_contact; i >= 0; i = fe__next_pair(world, i, body)) {
        const fe__pair *p = world->pairs + i;
        int32_t other = p->body_a == body ? p->body_b : p->body_a;
        if (i == pair || p->flags & (FE__PAIR_SENSOR | FE__PAIR_DENIED | FE__PAIR_PASSING) ||
            world->bodies[other].type == FE_BODY_DYNAMIC || fe__is_field_pair(world, p->shape_a, p->shape_b))
            continue;
        fe__mobile a, b;
        fe__impact before;
        if (meeting_of(world, i, dt, time, &a, &b, &before) == FE_MEET_NEVER || before.overlap) continue;
        double closing = fe__ddot(before.normal, fe__dsub(a.motion.translation, b.motion.translation));
        if (closing * (time - before.s) > SHALLOW * (double)world->bodies[body].thickness) return 1;
    }
    return 0;
}

int32_t fe__pair_touches_ahead(const fe_world *world, int32_t pair, float dt, fe__places *out_touch)
{
    const fe__pair *p = world->pairs + pair;
    const fe__contact *m = world->contacts + pair;
    fe__mobile a, b;
    fe__impact impact;
    if (meeting_of(world, pair, dt, 1.0, &a, &b, &impact) == FE_MEET_NEVER) return 0;
    double time = impact.s;
    if (turns_far(&a.motion, time) || turns_far(&b.motion, time)) return 0;
    if (is_turned_away(world, p->body_a, pair, dt, time) || is_turned_away(world, p->body_b, pair, dt, time)) return 0;
    int32_t swapped = m->body_a != p->body_a;
    const fe__motion *first = swapped ? &b.motion : &a.motion, *second = swapped ? &a.motion : &b.motion;
    const fe__body *body_a = world->bodies + m->body_a, *body_b = world->bodies + m->body_b;
    *out_touch = (fe__places){fe__dadd(fe__centre_of(body_a), fe__dscale(time, first->translation)),
                              fe__dadd(fe__centre_of(body_b), fe__dscale(time, second->translation)),
                              fe__motion_at(first, time).rotation, fe__motion_at(second, time).rotation};
    return 1;
}
