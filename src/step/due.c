// due.c - see due.h. Two bounds of how near the bodies of a deferred pair may come: that of deferral.h, which adds up
// what each of them moved, and where it does not decide one of their motion against each other, for bodies that fall
// side by side. Only a pair that may get points is looked at: all others take no row, and no memory is reserved for it.
#include "step/due.h"

#include "step/narrow.h"
#include "world/pair_list.h"
#include "world/pose.h"
#include "world/proxies.h"

enum { PAIRS_IN_BLOCK = 256, FETCHED_AHEAD = 24 };

// |sin(angle / 2)| of a rotation since then
static float turned(const fe__body *body, const float *then)
{
    fe_quat q = fe__product(fe__rotation_of(body), fe__conjugate(fe__quat_of(then)));
    return sqrtf(q.x * q.x + q.y * q.y + q.z * q.z);
}

// How far points of A and B may have moved against each other since the pair was looked at, m
static float moved_since_found(const fe__contact *m, const fe__body *a, const fe__body *b)
{
    fe_dvec3 span = fe__dsub(fe__centre_of(a), fe__centre_of(b));
    fe_dvec3 then = fe__dadd(fe__widen(fe__quad_vector(m->found_span)), fe__widen(fe__quad_vector(m->found_low)));
    float rotated = b->reach * turned(b, m->found_b);
    if (a->type != FE_BODY_STATIC) rotated += a->reach * turned(a, m->found_a); // a plane has no reach
    return fe__length(fe__narrow(fe__dsub(span, then))) + 2.0f * rotated;
}

// Their gap now, m: of the balls around them, or what is left of the gap when the pair was looked at
static float gap_now(const fe_world *w, const fe__contact *m, const fe__body *a, const fe__body *b)
{
    float left = m->surface.tolerance - moved_since_found(m, a, b);
    if (a->type == FE_BODY_STATIC) return left;
    fe_vec3 span = fe__narrow(fe__dsub(fe__centre_of(a), fe__centre_of(b)));
    return fe__maxf(left, fe__length(span) - a->reach - b->reach - w->tuning.speculative_distance);
}

static float fall_of(const fe_world *w, float dt) { return fe__length(w->gravity) * dt * dt; }

static float rim_speed(const fe__body *body)
{
    return body->type == FE_BODY_STATIC ? 0.0f : fe__length(fe__quad_vector(body->spin)) * body->reach;
}

// How far they may come against each other in this step, as narrow.c predicts them, m
static float moves_ahead(const fe_world *w, const fe__body *a, const fe__body *b, float dt)
{
    fe_vec3 closing = fe__sub(fe__quad_vector(b->velocity), fe__quad_vector(a->velocity));
    float speed = fe__length(closing) + rim_speed(a) + rim_speed(b);
    return fe__minf(speed, a->speed + b->speed) * dt + fall_of(w, dt);
}

// Along one of the world's axes their boxes are apart and stay so in this step. *gap: by how much they are, m
static int32_t boxes_stay_apart(const fe_world *w, const fe__pair *p, float dt, float *gap)
{
    const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b;
    if ((x->flags | y->flags) & FE__SHAPE_IN_PLANES) return 0;
    const fe__body *a = w->bodies + p->body_a, *b = w->bodies + p->body_b;
    fe__bounds of_a = fe__shape_bounds(w, p->shape_a, 0.0f), of_b = fe__shape_bounds(w, p->shape_b, 0.0f);
    fe_dvec3 above = fe__dsub(of_b.low, of_a.high), below = fe__dsub(of_a.low, of_b.high);
    const float gaps[2][3] = {{(float)above.x, (float)above.y, (float)above.z},
                              {(float)below.x, (float)below.y, (float)below.z}};
    const float rounding = 1e-5f; // m
    float turns = (rim_speed(a) + rim_speed(b)) * dt + fall_of(w, dt) + w->tuning.speculative_distance + rounding;
    int32_t apart = 0;
    for (int k = 0; k < 3; ++k) {
        float opens = (b->velocity[k] - a->velocity[k]) * dt;
        for (int side = 0; side < 2; ++side, opens = -opens) {
            apart |= gaps[side][k] + fe__minf(opens, 0.0f) > turns;
            *gap = fe__maxf(*gap, gaps[side][k] - w->tuning.speculative_distance);
        }
    }
    return apart;
}

// Stays deferred until its bodies may have moved by what is left of the gap. A pair whose boxes parted is looked at,
// and ends
static int32_t stays_apart(fe_world *w, int32_t place, int32_t pair, float dt)
{
    const fe__contact *m = w->contacts + pair;
    const fe__body *a = w->bodies + m->body_a, *b = w->bodies + m->body_b;
    const float rounding = 1e-5f * (1.0f + a->reach + b->reach + m->surface.tolerance); // m
    float left = gap_now(w, m, a, b) - rounding;
    if (fe__boxes_part(w, w->pairs + pair)) return 0;
    if (!(left > moves_ahead(w, a, b, dt)) && !boxes_stay_apart(w, w->pairs + pair, dt, &left)) return 0;
    fe__defer(w->deferrals + place, w->odometers, m->body_a, m->body_b, left - rounding, m->longest_arm);
    return 1;
}

static void find_in_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    (void)worker;
    int32_t due[PAIRS_IN_BLOCK], waiting = 0;
    for (int32_t start = first; start < end; start += PAIRS_IN_BLOCK) {
        int32_t stop = fe__mini(end, start + PAIRS_IN_BLOCK), count = 0;
        for (int32_t i = start; i < stop; ++i) {
            __builtin_prefetch(w->deferrals + fe__mini(i + FETCHED_AHEAD, end - 1));
            if (w->awake_pairs[i] >= 0) continue;
            ++waiting;
            if (!fe__stays_deferred(w->deferrals + i, w->odometers, step->dt)) {
                fe__fetch(w->contacts + ~w->awake_pairs[i], sizeof *w->contacts);
                due[count++] = i;
            }
        }
        int32_t left = 0;
        for (int32_t i = 0; i < count; ++i) {
            int32_t place = due[i], pair = ~w->awake_pairs[place];
            if (stays_apart(w, place, pair, step->dt)) continue;
            due[left++] = w->awake_pairs[place] = pair;
        }
        int32_t at = atomic_fetch_add_explicit(&s->due_count, left, memory_order_relaxed);
        for (int32_t i = 0; i < left; ++i) s->busy[at + i] = due[i];
        waiting -= left;
    }
    atomic_fetch_add_explicit(&s->waiting_count, waiting, memory_order_relaxed);
}

int32_t fe__find_due(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->due_count, 0);
    atomic_store(&s->waiting_count, 0);
    // with heightfields none waits, see collide_stage.c
    if (w->field_pair_count || !atomic_load(&s->some_deferred)) return 1;
    if (!FE_RESERVE(&w->memory, s->busy, s->busy_capacity, w->awake_pair_count)) return 0;
    fe__parallel_for(&w->workers, w->awake_pair_count, PAIRS_IN_BLOCK, find_in_block, step);
    return 1;
}
