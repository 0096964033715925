// sleepers.c - see stages.h.
//
// A pair has points from the speculative distance on. One that is awake may close its gap only as it moves along the
// normal: by its velocity, its spin, gravity and forces, and by what pushes it that way. What is held by joints, or
// touched by other bodies that may move, is pushed in ways that the solver alone knows: it wakes whom it comes near.
#include "step/stages.h"

#include "world/contact.h"
#include "world/contact_creation.h"

#include <float.h>

static int32_t is_asleep(const fe__body *body) { return body->type == FE_BODY_DYNAMIC && body->awake_index < 0; }

static float gap_of(const fe_world *w, const fe__contact *m)
{
    const fe__points *q = fe__points_of(w, m);
    float gap = FLT_MAX;
    for (int32_t i = 0; i < (int32_t)m->point_count; ++i) gap = fe__minf(gap, q->separation[i]);
    return gap;
}

// Unit, from the body to the other of the contact
static fe_vec3 towards_other(const fe__contact *m, int32_t body)
{
    fe_vec3 n = fe__quad_vector(m->normal);
    return m->body_a == body ? n : fe__neg(n);
}

// How far a free body moves along a unit direction in the step, m, at most
static float way_along(const fe__step *step, const fe__body *body, fe_vec3 direction)
{
    fe_vec3 turning = fe__cross(direction, fe__quad_vector(body->spin));
    float speed = fe__dot(direction, fe__quad_vector(body->velocity)) + body->reach * fe__length(turning);
    float gain = body->type == FE_BODY_DYNAMIC
                     ? body->gravity_scale * fe__dot(direction, step->world->gravity) +
                           body->inverse_mass * fe__dot(direction, fe__quad_vector(body->force))
                     : 0.0f;
    return step->dt * (fe__maxf(speed, 0.0f) + step->dt * fe__maxf(gain, 0.0f));
}

// While a gap along the normal stays open, they cannot touch
static int32_t cannot_close(const fe__step *step, const fe__contact *m, int32_t mover)
{
    const float alike = 1.05f, rounding = 2e-5f; // of the way; m
    float way = way_along(step, step->world->bodies + mover, towards_other(m, mover));
    return gap_of(step->world, m) > alike * way + rounding;
}

// Do they miss each other, if each of the two moves as it does now? The normal of a manifold of poses to come says
// nothing of the gap now. What lies under ground that stands, since that rose, touches it and meets none of its
// triangles.
static int32_t passes_by(const fe__step *step, int32_t pair, int32_t mover)
{
    const fe_world *w = step->world;
    const fe__contact *m = w->contacts + pair;
    int32_t is_of_now = m->surface.tolerance != FE__AHEAD;
    if (is_of_now && cannot_close(step, m, mover)) return 1;
    if (fe__is_field_pair(w, w->pairs[pair].shape_a, w->pairs[pair].shape_b)) {
        int32_t lies_under = w->bodies[mover].type == FE_BODY_STATIC && is_of_now && gap_of(w, m) <= 0.0f;
        return !lies_under && !fe__predicts_field_meeting(w, pair, step->dt);
    }
    return !fe__predicts_meeting(w, pair, step->dt);
}

static int32_t stands(const fe__body *body)
{
    fe_vec3 v = fe__quad_vector(body->velocity), spin = fe__quad_vector(body->spin);
    return body->type != FE_BODY_DYNAMIC && !(fe__dot(v, v) + fe__dot(spin, spin) > 0.0f);
}

// What stands only holds up a body that does not move into it any faster than gravity makes it in two steps
static int32_t only_holds(const fe__step *step, const fe__body *body, fe_vec3 towards)
{
    float fall = 2.0f * step->fall / step->dt;
    return fe__dot(towards, fe__quad_vector(body->velocity)) <= fall;
}

// Does what else the body is near leave its motion along the direction alone? What stands pushes along its normal
static int32_t is_free_along(const fe__step *step, int32_t mover, fe_vec3 direction)
{
    const float lean = 0.02f; // sine
    const fe_world *w = step->world;
    const fe__body *body = w->bodies + mover;
    fe_vec3 torque = fe__quad_vector(body->torque);
    if (body->joint_total || fe__dot(torque, torque) > 0.0f) return 0;
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(w, pair, mover)) {
        const fe__contact *m = w->contacts + pair;
        if (!(m->point_count > 0.0f) || w->pairs[pair].flags & FE__PAIR_SENSOR) continue;
        const fe__body *other = w->bodies + (m->body_a == mover ? m->body_b : m->body_a);
        if (is_asleep(other) && passes_by(step, pair, mover)) continue;
        fe_vec3 towards = towards_other(m, mover);
        if (!stands(other)) return 0;
        if (fe__dot(towards, direction) < -lean && !only_holds(step, body, towards)) return 0;
    }
    return 1;
}

int32_t fe__pair_lets_sleep(const fe__step *step, int32_t pair)
{
    const fe_world *w = step->world;
    const fe__contact *m = w->contacts + pair;
    int32_t a_sleeps = is_asleep(w->bodies + m->body_a), b_sleeps = is_asleep(w->bodies + m->body_b);
    if (a_sleeps == b_sleeps) return 0;
    int32_t mover = a_sleeps ? m->body_b : m->body_a;
    if (!passes_by(step, pair, mover)) return 0;
    return w->bodies[mover].type != FE_BODY_DYNAMIC || is_free_along(step, mover, towards_other(m, mover));
}
