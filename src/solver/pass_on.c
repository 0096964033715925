// pass_on.c - chains of impacts within a substep: a ball that strikes a row of balls, a break of billiards.
//
// The passes of a substep find all contacts that touch in it, and stop them together, as if they stuck. Of several
// impacts one after another they make one, which keeps momentum but not what restitution is to give back. So where
// contacts with restitution share bodies, what they gave in this substep is taken back, and the impacts happen one by
// one, in the order in which they touch: each bounces with the velocities that the others left, again and again until
// none closes (Ivanov, "On multiple impact", 1995, calls it the sequential hypothesis). No impact of two bodies gains
// energy, so none of their sequence does.
//
// A body that something else held meanwhile, as the ground holds a box that is struck from above, has got what holds it
// against the impact; without the impact it would fly off. Such bodies are known by the energy that they would have
// gained: their contacts bounce as if they were alone.
#include "solver/pass_on.h"

#include <math.h>

enum {
    ROUNDS = 64, // over the touches of a batch; what closes then is left to the next substep
    FAST = 4,    // bits beside the count of touches: of a line, in a chain with an impact above the threshold
    HELD = 8
};

// of its kinetic energy, and as a speed, m/s: what a body may have gained by rounding
#define GAINED 1e-5f
#define GAINED_SPEED 1e-3f
// and of the change of its velocity in the substep what a joint may have added: a ball on a rod has got its share of
// the blow from the pivot, 2 r^2 / (5 L^2) of it, and the joint takes it back in the next substep
#define JOINED_SHARE 0.05f

typedef struct chain {
    fe__solver *s;
    const fe__body *bodies;
    const fe__kernels *kernels;
    const fe__group *groups;
    int32_t group_count;
    unsigned char *rows;
    const fe__step_constants *c;
    fe__touch *touches;
    int32_t count;
} chain;

static const fe__group *group_of(const chain *k, int32_t lane)
{
    const fe__group *g = k->groups;
    for (int32_t count = k->group_count; count > 1;) {
        int32_t half = count / 2;
        if (g[half].lane <= lane)
            g += half, count -= half;
        else
            count = half;
    }
    return g;
}

static const fe__contact_kernels *kernels_of(const chain *k, const fe__group *g)
{
    return g->width == k->kernels->width ? k->kernels->contact : k->kernels->thin;
}

static int32_t act_on(const chain *k, const fe__touch *t, fe__touch_act act)
{
    const fe__group *g = group_of(k, t->lane);
    const fe__contact_kernels *kernels = kernels_of(k, g);
    int32_t lane = t->lane - g->lane;
    unsigned char *row = k->rows + g->offset + (int64_t)(lane / g->width) * kernels->row_size[g->kind];
    return kernels->act[g->kind](k->s, row, lane % g->width, act, k->c);
}

static void find_touches(chain *k)
{
    for (const fe__group *g = k->groups, *end = g + k->group_count; g < end; ++g)
        if (g->kind < FE__ROW_KINDS && g->kind & FE__ROW_SPECIAL)
            k->count +=
                kernels_of(k, g)->touches[g->kind](k->s, k->rows + g->offset, g->rows, g->lane, k->touches + k->count);
}

// ---- in order of time, of two at once the first lane's --------------------------------------------------------------
static int32_t is_later(const fe__touch *a, const fe__touch *b)
{
    return a->when > b->when || (a->when == b->when && a->lane > b->lane);
}

static void sink_touch(fe__touch *heap, int32_t i, int32_t count)
{
    fe__touch moved = heap[i];
    for (int32_t child; (child = 2 * i + 1) < count; i = child) {
        if (child + 1 < count && is_later(heap + child + 1, heap + child)) ++child;
        if (!is_later(heap + child, &moved)) break;
        heap[i] = heap[child];
    }
    heap[i] = moved;
}

static void sort_touches(fe__touch *touches, int32_t count)
{
    for (int32_t i = count / 2 - 1; i >= 0; --i) sink_touch(touches, i, count);
    for (int32_t last = count - 1; last > 0; --last) {
        fe__touch latest = touches[0];
        touches[0] = touches[last], touches[last] = latest;
        sink_touch(touches, 0, last);
    }
}

// ---- who takes part -------------------------------------------------------------------------------------------------
static int32_t line_has(const chain *k, const fe__touch *t, uint8_t bit)
{
    return (k->s->touches_of[t->line_a] | k->s->touches_of[t->line_b]) & bit;
}

static void mark_lines(const chain *k, const fe__touch *t, uint8_t bit)
{
    if (t->line_a != FE__STATIC_LINE) k->s->touches_of[t->line_a] |= bit;
    k->s->touches_of[t->line_b] |= bit;
}

static int32_t is_marked(const chain *k, const fe__touch *t, uint8_t bit)
{
    return (t->line_a == FE__STATIC_LINE || k->s->touches_of[t->line_a] & bit) && k->s->touches_of[t->line_b] & bit;
}

// Chains without an impact above the threshold stay as they are: nothing bounces in them.
static void keep_fast(chain *k)
{
    for (int32_t i = 0; i < k->count; ++i)
        if (act_on(k, k->touches + i, FE__TOUCH_FAST)) mark_lines(k, k->touches + i, FAST);
    for (int32_t more = 1; more;) {
        more = 0;
        for (int32_t i = 0; i < k->count; ++i) {
            const fe__touch *t = k->touches + i;
            if (!line_has(k, t, FAST) || is_marked(k, t, FAST)) continue;
            mark_lines(k, t, FAST);
            more = 1;
        }
    }
    int32_t kept = 0;
    for (int32_t i = 0; i < k->count; ++i)
        if (line_has(k, k->touches + i, FAST)) k->touches[kept++] = k->touches[i];
    k->count = kept;
}

// twice the kinetic energy over the mass, m2/s2
static float energy_of(const fe__solver *s, int32_t line, const float *v, const float *w)
{
    const fe__axes_line *axes = s->axes + line;
    const float *r = axes->rotation;
    fe_vec3 spin = fe__rotate_back((fe_quat){r[0], r[1], r[2], r[3]}, fe__vec3(w[0], w[1], w[2]));
    float of_spin = axes->principal[0] * spin.x * spin.x + axes->principal[1] * spin.y * spin.y +
                    axes->principal[2] * spin.z * spin.z;
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + s->velocity[line].inverse_mass * of_spin;
}

static float change_of(const fe__solver *s, int32_t line)
{
    const float *v = s->velocity[line].v, *start = s->start[line].v;
    float x = v[0] - start[0], y = v[1] - start[1], z = v[2] - start[2];
    return sqrtf(x * x + y * y + z * z);
}

static void note_changes(const chain *k)
{
    for (fe__touch *t = k->touches, *end = t + k->count; t < end; ++t)
        t->change_a = change_of(k->s, t->line_a), t->change_b = change_of(k->s, t->line_b);
}

static int32_t is_held(const chain *k, int32_t line, float change)
{
    const fe__velocity_line *now = k->s->velocity + line;
    const fe__start_line *start = k->s->start + line;
    float before = sqrtf(energy_of(k->s, line, start->v, start->w)),
          of_joint = k->bodies[k->s->body_of_line[line]].joint_count ? JOINED_SHARE * change : 0.0f,
          most = (1.0f + GAINED) * before + GAINED_SPEED + of_joint;
    return energy_of(k->s, line, now->v, now->w) > most * most;
}

// Of those from `first` on, what they gave is back where a body of theirs is held; they come first. Returns their end.
static int32_t return_held(const chain *k, int32_t first)
{
    uint8_t *marks = k->s->touches_of;
    for (int32_t i = first; i < k->count; ++i) {
        const fe__touch *t = k->touches + i;
        if (t->line_a != FE__STATIC_LINE && is_held(k, t->line_a, t->change_a)) marks[t->line_a] |= HELD;
        if (is_held(k, t->line_b, t->change_b)) marks[t->line_b] |= HELD;
    }
    for (int32_t i = first; i < k->count; ++i) {
        if (!line_has(k, k->touches + i, HELD)) continue;
        fe__touch held = k->touches[i];
        act_on(k, &held, FE__TOUCH_RETURN);
        for (int32_t to = i; to > first; --to) k->touches[to] = k->touches[to - 1];
        k->touches[first++] = held;
    }
    return first;
}

void fe__pass_on(fe__solver *s, const fe__kernels *kernels, const fe__body *bodies, const fe__batch *b,
                 unsigned char *rows, const fe__step_constants *c)
{
    if (!atomic_load_explicit(&s->chained, memory_order_relaxed)) return;
    const fe__group *groups = s->groups + b->first_group + b->joint_groups;
    chain k = {s, bodies, kernels, groups, b->group_count - b->joint_groups, rows, c, s->touches + groups->lane, 0};
    find_touches(&k);
    keep_fast(&k);
    sort_touches(k.touches, k.count);
    note_changes(&k);
    for (int32_t i = 0; i < k.count; ++i) act_on(&k, k.touches + i, FE__TOUCH_TAKE);
    int32_t free = 0;
    for (int32_t end; (end = return_held(&k, free)) > free;) free = end;
    for (int32_t i = 0; i < free; ++i) act_on(&k, k.touches + i, FE__TOUCH_BOUNCE);
    for (int32_t i = free; i < k.count; ++i) act_on(&k, k.touches + i, FE__TOUCH_FORGET);
    for (int32_t round = 0, more = free < k.count; more && round < ROUNDS; ++round) {
        more = 0;
        for (int32_t i = free; i < k.count; ++i) more |= act_on(&k, k.touches + i, FE__TOUCH_PASS_ON);
    }
}
