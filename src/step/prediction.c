// prediction.c - the first touch of a pair in the step to come, by times of impact along the motions as they are now.
//
// Input: bodies and shapes of a pair. The narrow phase and sleepers.c read the answers (stages.h).
#include "step/stages.h"

#include "collision/cast/toi.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/body.h"

// A shape and its motion within the step, seen from `base`.
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

// The first meeting of a pair's shapes until the share `limit` of the step. Motions are seen from a dynamic body's
// centre.
static fe__meeting meeting_of(const fe_world *world, int32_t pair, float dt, double limit, fe__mobile *a, fe__mobile *b,
                              fe__impact *impact)
{
    const fe__pair *p = world->pairs + pair;
    const fe__body *near = world->bodies + (world->bodies[p->body_a].type == FE_BODY_DYNAMIC ? p->body_a : p->body_b);
    *a = mobile_of(world, p->shape_a, dt, fe__centre_of(near)),
    *b = mobile_of(world, p->shape_b, dt, fe__centre_of(near));
    return fe__time_of_impact(a, b, limit, impact);
}

int32_t fe__predicts_meeting(const fe_world *world, int32_t pair, float dt)
{
    fe__mobile a, b;
    fe__impact impact;
    return meeting_of(world, pair, dt, 1.0, &a, &b, &impact) != FE_MEET_NEVER;
}

// ---- a surface, triangle by triangle --------------------------------------------------------------------------------

// The origin of the form of `other`, seen from where `from` is at the time s.
static fe_dvec3 seen_from(const fe__mobile *from, const fe__mobile *other, double s)
{
    fe__pose here = fe__mobile_at(from, s), there = fe__mobile_at(other, s);
    return fe__drotate_back(here.rotation, fe__dsub(there.position, here.position));
}

// Bounds the other on its way past the surface, in the surface's frame. Seen from a surface that turns by the angle t,
// the way is bent: by (t^2 r + 2 t |v|) / 8 at most from its chord, at a steady turn, where r is the distance from the
// pivot.
static fe__bounds bounds_of_way(const fe__mobile *surface, const fe__mobile *other)
{
    const double bent = 0.5; // four times 1/8: no turn between two rotations is steady
    const fe__motion *m = &surface->motion;
    fe_dvec3 from = seen_from(surface, other, 0.0), to = seen_from(surface, other, 1.0);
    fe_dvec3 between = fe__dsub(other->motion.centre, m->centre),
             way = fe__dsub(other->motion.translation, m->translation);
    fe_quat q = m->angular_displacement;
    double half_sine = sqrt((double)(q.x * q.x + q.y * q.y + q.z * q.z)), t = 4.0 * half_sine; // more than the angle
    double speed = sqrt(fe__ddot(way, way)), r = sqrt(fe__ddot(between, between)) + speed,
           wide = (double)fe__form_reach(other->form, fe__vec3(0.0f, 0.0f, 0.0f)) + FE_TOUCH +
                  bent * (t * t * r + 2.0 * t * speed);
    fe_dvec3 more = {wide, wide, wide};
    fe__bounds box = {fe__dsub(from, more), fe__dadd(from, more)}, end = {fe__dsub(to, more), fe__dadd(to, more)};
    fe__bounds_add(&box, &end);
    return box;
}

int32_t fe__predicts_field_meeting(const fe_world *world, int32_t pair, float dt)
{
    const fe__pair *p = world->pairs + pair;
    int32_t a_is_field = fe__form_is_field(&world->shapes[p->shape_a].form);
    int32_t field = a_is_field ? p->shape_a : p->shape_b, other = a_is_field ? p->shape_b : p->shape_a;
    fe_dvec3 base = fe__centre_of(world->bodies + world->shapes[other].body);
    fe__mobile surface = mobile_of(world, field, dt, base), b = mobile_of(world, other, dt, base), a = surface;
    fe__ground ground = fe__store_ground(world->store, surface.form);
    fe__bounds box = bounds_of_way(&surface, &b);
    fe_dvec3 origin = seen_from(&surface, &b, 0.0); // the origin of triangles, near the other
    a.arm = fe__dadd(surface.arm, fe__drotate(surface.rotation, origin));
    fe__form triangle;
    a.form = &triangle;
    fe__ground_walk walk;
    fe__ground_begin(&walk, &ground, &box, origin);
    while (fe__ground_next(&walk, &triangle) >= 0) {
        fe__impact impact;
        if (fe__time_of_impact(&a, &b, 1.0, &impact) != FE_MEET_NEVER) return 1;
    }
    return 0;
}

// ---- first touch ----------------------------------------------------------------------------------------------------

static int32_t turns_far(const fe__motion *m, double time)
{
    const float most = 0.25f; // sine of half the angle: beyond it a contact says nothing of the bodies as they are now
    fe_quat q = m->angular_displacement;
    return (float)time * sqrtf(q.x * q.x + q.y * q.y + q.z * q.z) > most;
}

// 1: before that time the body meets something that does not give way, and would go into it by more than a share of its
// thickness.
static int32_t is_turned_away(const fe_world *world, int32_t body, int32_t pair, float dt, double time)
{
    const double shallow = 0.25; // share of the thickness
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
        if (closing * (time - before.s) > shallow * (double)world->bodies[body].thickness) return 1;
    }
    return 0;
}

int32_t fe__predict_touch(const fe_world *world, int32_t pair, float dt, fe__places *out_touch)
{
    const fe__pair *p = world->pairs + pair;
    const fe__contact *contact = world->contacts + pair;
    fe__mobile a, b;
    fe__impact impact;
    if (meeting_of(world, pair, dt, 1.0, &a, &b, &impact) == FE_MEET_NEVER) return 0;
    double time = impact.s;
    if (turns_far(&a.motion, time) || turns_far(&b.motion, time)) return 0;
    if (is_turned_away(world, p->body_a, pair, dt, time) || is_turned_away(world, p->body_b, pair, dt, time)) return 0;
    int32_t swapped = contact->body_a != p->body_a;
    const fe__motion *first = swapped ? &b.motion : &a.motion, *second = swapped ? &a.motion : &b.motion;
    const fe__body *body_a = world->bodies + contact->body_a, *body_b = world->bodies + contact->body_b;
    *out_touch = (fe__places){fe__dadd(fe__centre_of(body_a), fe__dscale(time, first->translation)),
                              fe__dadd(fe__centre_of(body_b), fe__dscale(time, second->translation)),
                              fe__motion_at(first, time).rotation, fe__motion_at(second, time).rotation};
    return 1;
}
