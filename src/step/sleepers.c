// sleepers.c - whether a contact wakes a sleeping body.
//
// A pair has points from the speculative distance on. A body that is awake may close its gap only as it moves along the
// normal: by its velocity, its spin, gravity and forces, and by what pushes it that way. A body that is held by joints,
// or touched by other bodies that may move, is pushed in ways that the solver alone knows: it wakes the bodies that it
// comes near.
#include "step/stages.h"

#include "world/contact.h"
#include "world/contact_creation.h"

#include <float.h>

static int32_t is_asleep(const fe__body *body) { return body->type == FE_BODY_DYNAMIC && body->awake_index < 0; }

// Returns the normal, from the body to the other one of the contact.
static fe_vec3 towards_other(const fe__contact *contact, int32_t body)
{
    fe_vec3 n = fe__quad_vector(contact->normal);
    return contact->body_a == body ? n : fe__neg(n);
}

// 1: the two miss each other, if each moves as it does now.
static int32_t passes_by(const fe__step *step, int32_t pair, int32_t mover)
{
    const float alike = 1.05f, rounding = 2e-5f; // share of the way; m
    const fe_world *world = step->world;
    const fe__contact *contact = world->contacts + pair;
    const fe__points *points = fe__points_of(world, contact);
    const fe__body *body = world->bodies + mover;
    // the normal of a manifold of poses to come says nothing of the gap now
    int32_t is_of_now = contact->surface.tolerance != FE__AHEAD;
    float gap = FLT_MAX;
    for (int32_t i = 0; i < (int32_t)contact->point_count; ++i) gap = fe__minf(gap, points->separation[i]);
    if (is_of_now) { // while a gap along the normal stays open, they cannot touch
        fe_vec3 n = towards_other(contact, mover), turning = fe__cross(n, fe__quad_vector(body->spin));
        float speed = fe__dot(n, fe__quad_vector(body->velocity)) + body->reach * fe__length(turning), gain = 0.0f;
        if (body->type == FE_BODY_DYNAMIC)
            gain = body->gravity_scale * fe__dot(n, world->gravity) +
                   body->inverse_mass * fe__dot(n, fe__quad_vector(body->force));
        float way =
            step->dt * (fe__maxf(speed, 0.0f) + step->dt * fe__maxf(gain, 0.0f)); // the most that a free body moves
        if (gap > alike * way + rounding) return 1;
    }
    if (fe__is_field_pair(world, world->pairs[pair].shape_a, world->pairs[pair].shape_b)) {
        // a body under static ground that has risen touches it, and meets none of its triangles
        int32_t lies_under = body->type == FE_BODY_STATIC && is_of_now && gap <= 0.0f;
        return !lies_under && !fe__predicts_field_meeting(world, pair, step->dt);
    }
    return !fe__predicts_meeting(world, pair, step->dt);
}

// 1: whatever else the body is near does not push it along the direction.
static int32_t is_free_along(const fe__step *step, int32_t mover, fe_vec3 direction)
{
    const float lean = 0.02f; // sine
    const fe_world *world = step->world;
    const fe__body *body = world->bodies + mover;
    fe_vec3 torque = fe__quad_vector(body->torque);
    if (body->joint_total || fe__dot(torque, torque) > 0.0f) return 0;
    float fall_speed = 2.0f * step->fall / step->dt; // that gravity gives in two steps
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, mover)) {
        const fe__contact *contact = world->contacts + pair;
        if (!(contact->point_count > 0.0f) || world->pairs[pair].flags & FE__PAIR_SENSOR) continue;
        const fe__body *other = world->bodies + (contact->body_a == mover ? contact->body_b : contact->body_a);
        if (is_asleep(other) && passes_by(step, pair, mover)) continue;
        fe_vec3 v = fe__quad_vector(other->velocity), spin = fe__quad_vector(other->spin);
        if (other->type == FE_BODY_DYNAMIC || fe__dot(v, v) + fe__dot(spin, spin) > 0.0f) return 0;
        // A body that stands still pushes along its normal. It only holds up a body that does not move into it any
        // faster than gravity makes it.
        fe_vec3 towards = towards_other(contact, mover);
        int32_t only_holds = fe__dot(towards, fe__quad_vector(body->velocity)) <= fall_speed;
        if (fe__dot(towards, direction) < -lean && !only_holds) return 0;
    }
    return 1;
}

int32_t fe__pair_lets_sleep(const fe__step *step, int32_t pair)
{
    const fe_world *world = step->world;
    const fe__contact *contact = world->contacts + pair;
    int32_t a_sleeps = is_asleep(world->bodies + contact->body_a),
            b_sleeps = is_asleep(world->bodies + contact->body_b);
    if (a_sleeps == b_sleeps) return 0;
    int32_t mover = a_sleeps ? contact->body_b : contact->body_a;
    if (!passes_by(step, pair, mover)) return 0;
    return world->bodies[mover].type != FE_BODY_DYNAMIC || is_free_along(step, mover, towards_other(contact, mover));
}
