// energy.c - see energy.h.
#include "continuous/energy.h"

#include "world/pair_list.h"
#include "world/points.h"
#include "world/pose.h"

// of the energy: what float arithmetic may add in a step
#define ENERGY_ROUNDING 1e-5f

static float energy_of(const fe__body *b, fe_quat rotation, const float *v, const float *w)
{
    fe_quat axes = fe__product(rotation, fe__quat_of(b->inertia_axes));
    fe_vec3 spin = fe__rotate_back(fe__normalized(axes), fe__quad_vector(w));
    return 0.5f * (b->mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + b->inertia[0] * spin.x * spin.x +
                   b->inertia[1] * spin.y * spin.y + b->inertia[2] * spin.z * spin.z);
}

static int32_t is_driven(const fe__body *b)
{
    for (int32_t k = 0; k < 3; ++k)
        if (b->force[k] != 0.0f || b->torque[k] != 0.0f) return 1;
    return b->first_joint != 0;
}

static int32_t slips(const fe__extra *e)
{
    return e->surface_velocity[0] != 0.0f || e->surface_velocity[1] != 0.0f || e->surface_velocity[2] != 0.0f;
}

// 1: something static pushed it, and nothing else did
static int32_t is_pushed_by_static_only(const fe_world *w, int32_t body)
{
    int32_t pushed = 0;
    if (!w->bodies[body].static_pairs) return 0;
    for (int32_t i = w->bodies[body].first_contact; i >= 0; i = fe__next_pair(w, i, body)) {
        const fe__pair *p = w->pairs + i;
        const fe__contact *m = w->contacts + i;
        if (!(p->flags & FE__PAIR_LINKED)) continue;
        const fe__extra *e = fe__extra_of(w, m);
        if (w->bodies[m->body_a].type != FE_BODY_STATIC || (e && slips(e))) return 0;
        for (int32_t k = 0; k < FE__POINTS; ++k) pushed |= fe__points_of(w, m)->total_impulse[k] > 0.0f;
    }
    return pushed;
}

void fe__give_back(const fe_world *w, const fe__body *body, fe_vec3 change, float *velocity)
{
    float square = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
    float left = square + 2.0f * body->gravity_scale * fe__dot(w->gravity, change);
    float k = square > 0.0f ? sqrtf(fe__maxf(left, 0.0f) / square) : 1.0f;
    for (int32_t i = 0; i < 3; ++i) velocity[i] *= k;
}

void fe__limit_energy(const fe__step *step, int32_t body)
{
    const fe_world *w = step->world;
    const fe__body *b = w->bodies + body;
    if (is_driven(b) || !is_pushed_by_static_only(w, body)) return;
    fe__velocity_line *velocity = w->solver.velocity + b->line;
    const fe__motion_line *motion = w->solver.motion + b->line;
    fe_quat before = {b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]};
    fe_quat after = fe__product(fe__quat_of(motion->rotation), before);
    float weight = b->mass * b->gravity_scale, h = step->constants.h;
    // of the discrete fall: v . h g / 2 belongs to the height
    float work = weight * fe__dot(w->gravity, fe__quad_vector(motion->shift));
    work -=
        0.5f * weight * h * fe__dot(w->gravity, fe__sub(fe__quad_vector(velocity->v), fe__quad_vector(b->velocity)));
    float most = energy_of(b, before, b->velocity, b->spin) * (1.0f + ENERGY_ROUNDING) + fe__maxf(work, 0.0f);
    float now = energy_of(b, after, velocity->v, velocity->w);
    if (!(now > most)) return;
    float k = sqrtf(most / now);
    for (int32_t i = 0; i < 3; ++i) velocity->v[i] *= k, velocity->w[i] *= k;
}
