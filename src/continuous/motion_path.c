// motion_path.c - see motion_path.h. Input: the lines of motion and trails that the solver left.
#include "continuous/motion_path.h"

#include "world/body.h"
#include "world/contact.h"

static const fe__shift no_shift = {.rotation = {0.0f, 0.0f, 0.0f, 1.0f}};

// q and -q are the same rotation: returns the one with w >= 0.
static fe_quat forwards(fe_quat q) { return q.w < 0.0f ? (fe_quat){-q.x, -q.y, -q.z, -q.w} : q; }

static fe__shift shift_of(const fe__motion_line *motion)
{
    return (fe__shift){fe__widen(fe__quad_vector(motion->shift)), forwards(fe__quat_of(motion->rotation))};
}

static int32_t moves(const fe__body *body) { return body->awake_index >= 0 && body->line >= 0; }

int32_t fe__path_legs(const fe__step *step, int32_t body)
{
    const fe__body *b = step->world->bodies + body;
    int32_t stride = fe__trail_stride(step->constants.substeps),
            trail = moves(b) && step->world->solver.trail_count[b->line] != FE__NO_TRAIL;
    return trail ? (step->constants.substeps + stride - 1) / stride : 1;
}

double fe__path_time(const fe__step *step, int32_t body, int32_t leg)
{
    int32_t legs = fe__path_legs(step, body), stride = fe__trail_stride(step->constants.substeps);
    return leg >= legs ? 1.0 : (double)(leg * stride) / (double)step->constants.substeps;
}

fe__shift fe__path_place(const fe__step *step, int32_t body, int32_t leg)
{
    const fe__solver *s = &step->world->solver;
    int32_t line = step->world->bodies[body].line;
    if (leg == 0) return no_shift;
    return shift_of(leg == fe__path_legs(step, body) ? s->motion + line : s->trail[s->trail_of[line]] + leg - 1);
}

fe__shift fe__shift_between(const fe__shift *a, const fe__shift *b, double t)
{
    if (t <= 0.0) return *a;
    if (t >= 1.0) return *b;
    fe_quat p = a->rotation, q = b->rotation;
    float v = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0.0f ? -(float)t : (float)t, u = 1.0f - (float)t;
    fe_quat rotation = {u * p.x + v * q.x, u * p.y + v * q.y, u * p.z + v * q.z, u * p.w + v * q.w};
    return (fe__shift){fe__dadd(a->centre, fe__dscale(t, fe__dsub(b->centre, a->centre))),
                       forwards(fe__normalized(rotation))};
}

fe__shift fe__path_at(const fe__step *step, int32_t body, double time)
{
    if (!moves(step->world->bodies + body)) return no_shift;
    int32_t legs = fe__path_legs(step, body), leg = 0;
    while (leg + 1 < legs && fe__path_time(step, body, leg + 1) <= time) ++leg;
    double begin = fe__path_time(step, body, leg), t = (time - begin) / (fe__path_time(step, body, leg + 1) - begin);
    fe__shift a = fe__path_place(step, body, leg), b = fe__path_place(step, body, leg + 1);
    return fe__shift_between(&a, &b, t);
}

static int32_t is_still(fe_quat q) { return q.x == 0.0f && q.y == 0.0f && q.z == 0.0f; }

fe__motion fe__motion_of_shifts(const fe__body *body, const fe__shift *from, const fe__shift *to, fe_dvec3 base)
{
    fe__motion m = {fe__dadd(fe__dsub(fe__centre_of(body), base), from->centre), fe__rotation_of(body),
                    fe__dsub(to->centre, from->centre), fe__identity()};
    if (!is_still(from->rotation)) m.rotation = fe__normalized(fe__product(from->rotation, m.rotation));
    if (!is_still(from->rotation) || !is_still(to->rotation))
        m.angular_displacement = forwards(fe__normalized(fe__product(to->rotation, fe__conjugate(from->rotation))));
    return m;
}

fe__motion fe__path_motion(const fe__step *step, int32_t body, double from, double until, fe_dvec3 base)
{
    fe__shift a = fe__path_at(step, body, from), b = fe__path_at(step, body, until);
    return fe__motion_of_shifts(step->world->bodies + body, &a, &b, base);
}

fe__mobile fe__mobile_of_shape(const fe__step *step, const fe__shape *shape, const fe__motion *motion)
{
    fe_dvec3 centre = fe__widen(fe__quad_vector(step->world->bodies[shape->body].local_centre));
    return (fe__mobile){&shape->form, fe__dsub(fe__widen(shape->local_position), centre), shape->local_rotation,
                        *motion};
}

float fe__path_length(const fe__step *step, int32_t body)
{
    const fe__body *b = step->world->bodies + body;
    if (!moves(b)) return 0.0f;
    fe__shift end = shift_of(step->world->solver.motion + b->line);
    fe_quat q = end.rotation;
    float half_sine = sqrtf(q.x * q.x + q.y * q.y + q.z * q.z); // an angle is no more than pi times it
    return (float)sqrt(fe__ddot(end.centre, end.centre)) + FE_PI * half_sine * b->reach;
}

// ---- energy ---------------------------------------------------------------------------------------------------------

static float energy_of(const fe__body *b, fe_quat rotation, const float *v, const float *w)
{
    fe_quat axes = fe__product(rotation, fe__quat_of(b->inertia_axes));
    fe_vec3 spin = fe__rotate_back(fe__normalized(axes), fe__quad_vector(w));
    return 0.5f * (b->mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + b->inertia[0] * spin.x * spin.x +
                   b->inertia[1] * spin.y * spin.y + b->inertia[2] * spin.z * spin.z);
}

// 1: something static pushed the body, and nothing else did.
static int32_t is_pushed_by_static_only(const fe_world *w, int32_t body)
{
    const fe__body *b = w->bodies + body;
    int32_t is_pushed = 0;
    for (int32_t k = 0; k < 3; ++k)
        if (b->force[k] != 0.0f || b->torque[k] != 0.0f) return 0;
    if (b->first_joint || !b->static_pairs) return 0;
    for (int32_t i = b->first_contact; i >= 0; i = fe__next_pair(w, i, body)) {
        const fe__contact *contact = w->contacts + i;
        if (!(w->pairs[i].flags & FE__PAIR_LINKED)) continue;
        if (w->bodies[contact->body_a].type != FE_BODY_STATIC) return 0;
        const fe__extra *extra = fe__extra_of(w, contact);
        const float *belt = extra ? extra->surface_velocity : NULL;
        if (belt && (belt[0] != 0.0f || belt[1] != 0.0f || belt[2] != 0.0f)) return 0;
        for (int32_t k = 0; k < FE__POINTS; ++k) is_pushed |= fe__points_of(w, contact)->total_impulse[k] > 0.0f;
    }
    return is_pushed;
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
    const float rounding = 1e-5f; // share of the energy that float arithmetic may add in a step
    if (!is_pushed_by_static_only(w, body)) return;
    fe__velocity_line *velocity = w->solver.velocity + b->line;
    const fe__motion_line *motion = w->solver.motion + b->line;
    fe_quat before = fe__quat_of(b->rotation);
    fe_quat after = fe__product(fe__quat_of(motion->rotation), before);
    float weight = b->mass * b->gravity_scale, h = step->constants.h;
    // the discrete fall is half a substep ahead: v . h g / 2 belongs to the height
    float work = weight * fe__dot(w->gravity, fe__quad_vector(motion->shift));
    work -=
        0.5f * weight * h * fe__dot(w->gravity, fe__sub(fe__quad_vector(velocity->v), fe__quad_vector(b->velocity)));
    float most = energy_of(b, before, b->velocity, b->spin) * (1.0f + rounding) + fe__maxf(work, 0.0f);
    float now = energy_of(b, after, velocity->v, velocity->w);
    if (!(now > most)) return;
    float k = sqrtf(most / now);
    for (int32_t i = 0; i < 3; ++i) velocity->v[i] *= k, velocity->w[i] *= k;
}
