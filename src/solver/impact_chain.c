// impact_chain.c - chains of impacts within a substep: a ball that strikes a row of balls, a break of billiards.
//
// The passes of a substep find all contacts that touch in it, and stop them together, as if they stuck. Of several
// impacts one after another they make one, which keeps momentum but not what restitution is to give back. So where
// contacts with restitution share bodies, what they gave in this substep is taken back, and the impacts happen one by
// one, in the order in which they touch: each bounces with the velocities that the others left, again and again until
// none closes (Ivanov, "On multiple impact", 1995, calls it the sequential hypothesis). No impact of two bodies gains
// energy, so none of their sequence does. What the passes have not reached yet, the next contacts of a chain's bodies,
// takes part too: a column that falls would be pressed into itself.
//
// A body that something else held meanwhile, as the ground holds a box that is struck from above, has got what holds it
// against the impact; without the impact it would fly off. Such bodies are known by the energy that they would have
// gained: their contacts bounce as if they were alone.
#include "solver/solve.h"

#include <math.h>

enum {
    IMPACTS = 32, // of each touch at most; what closes then is left to the next substep
    // marks of a line, beside the count of its touches: of a chain with an impact above the threshold; held
    FAST = FE__TOUCHES_CHAINED,
    HELD = 2 * FAST,
    // of a touch: it is in the list; it stays as it is
    LISTED = 1,
    OUT = 2
};

// of its kinetic energy, and as a speed, m/s: what a body may have gained by rounding
#define GAINED 1e-5f
#define GAINED_SPEED 1e-3f
// and of the change of its velocity in the substep what a joint may have added: a ball on a rod has got its share of
// the blow from the pivot, 2 r^2 / (5 L^2) of it, and the joint takes it back in the next substep
#define JOINED_SHARE 0.05f

typedef struct chain {
    fe__solver *s;
    const fe__records *of; // by home
    const fe__kernels *kernels;
    const fe__group *groups;
    int32_t group_count;
    unsigned char *rows;
    const fe__step_constants *c;
    fe__touch *touches;
    int32_t count, touched; // of them these touched, the others are near
    int32_t first, listed;  // of a list of touches, a ring: touches[(first + i) % count].listed
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
    return fe__contact_kernels_of(k->kernels, g->width);
}

static int32_t row_end(const chain *k, int32_t lane)
{
    const fe__group *g = group_of(k, lane);
    return lane - (lane - g->lane) % g->width + g->width;
}

// On `lanes` of the row of the given lane, the first bit is that lane itself
static int32_t act_on(const chain *k, int32_t lane, uint32_t lanes, fe__touch_act act)
{
    const fe__group *g = group_of(k, lane);
    const fe__contact_kernels *kernels = kernels_of(k, g);
    int32_t row = (lane - g->lane) / g->width;
    return kernels->act[g->kind](k->s, k->rows + g->offset + (int64_t)row * kernels->row_size[g->kind],
                                 lanes << (lane - g->lane) % g->width, act, k->c);
}

// On those that touched and have these flags, row by row: the lanes of a row share no body.
static void act_on_all(const chain *k, int32_t flags, fe__touch_act act)
{
    for (int32_t i = 0, first; (first = i) < k->touched;) {
        int32_t lane = k->touches[first].lane, row = row_end(k, lane);
        uint32_t lanes = 0;
        for (; i < k->touched && k->touches[i].lane < row; ++i)
            if (k->touches[i].flags == flags) lanes |= 1u << (k->touches[i].lane - lane);
        if (lanes) act_on(k, lane, lanes, act);
    }
}

// `near`: those that did not touch, of bodies in a chain
static void find_touches(chain *k, int32_t near)
{
    for (const fe__group *g = k->groups, *end = g + k->group_count; g < end; ++g)
        if (g->kind < FE__ROW_KINDS && g->kind & FE__ROW_SPECIAL)
            k->count += kernels_of(k, g)->touches[g->kind](k->s, k->rows + g->offset, g->rows, g->lane, near, k->c,
                                                           k->touches + k->count);
}

// ---- in order of time, of two at once in that of the pairs' creation ------------------------------------------------
// Of what two worlds have at once, either comes first: they share no body
static const uint64_t *serials_of(const chain *k, const fe__touch *t)
{
    const fe__lane *lane = k->s->lanes + t->lane;
    return k->of[lane->home].serials + 2 * (int64_t)lane->points;
}

// Lanes tell nothing: which of a group's contacts is where depends on when the graph was built.
static int32_t is_younger(const chain *k, const fe__touch *p, const fe__touch *q)
{
    const uint64_t *a = serials_of(k, p), *b = serials_of(k, q);
    return a[0] > b[0] || (a[0] == b[0] && a[1] > b[1]);
}

// Entries of the list before it turns
static int32_t is_later(const chain *k, int32_t a, int32_t b)
{
    const fe__touch *p = k->touches + k->touches[a].listed, *q = k->touches + k->touches[b].listed;
    return p->when > q->when || (p->when == q->when && is_younger(k, p, q));
}

static void swap_listed(const chain *k, int32_t a, int32_t b)
{
    int32_t listed = k->touches[a].listed;
    k->touches[a].listed = k->touches[b].listed, k->touches[b].listed = listed;
}

static void sink_touch(const chain *k, int32_t first, int32_t i, int32_t count)
{
    for (int32_t child; (child = 2 * i + 1) < count; i = child) {
        if (child + 1 < count && is_later(k, first + child + 1, first + child)) ++child;
        if (!is_later(k, first + child, first + i)) return;
        swap_listed(k, first + i, first + child);
    }
}

static void sort_listed(const chain *k, int32_t first, int32_t count)
{
    for (int32_t i = count / 2 - 1; i >= 0; --i) sink_touch(k, first, i, count);
    for (int32_t last = count - 1; last > 0; --last) {
        swap_listed(k, first, first + last);
        sink_touch(k, first, 0, last);
    }
}

// ---- touches of a line that may be listed, each in both lines' ------------------------------------------------------
static fe__touch_link *link_of(const chain *k, int32_t i, int32_t line)
{
    return k->touches[i].link + (k->touches[i].line[1] == line);
}

// as the last, before the first: the list is a ring
static void link_touch(const chain *k, int32_t i)
{
    for (int side = 0; side < 2; ++side) {
        int32_t line = k->touches[i].line[side], *first = k->s->touch_of + line;
        if (line == FE__STATIC_LINE) continue;
        if (*first == FE__NO_TOUCH) *first = k->touches[i].link[side].previous = i;
        int32_t last = link_of(k, *first, line)->previous;
        k->touches[i].link[side] = (fe__touch_link){*first, last};
        link_of(k, last, line)->next = link_of(k, *first, line)->previous = i;
    }
}

static void unlink_touch(const chain *k, int32_t i)
{
    for (int side = 0; side < 2; ++side) {
        int32_t line = k->touches[i].line[side], *first = k->s->touch_of + line;
        if (line == FE__STATIC_LINE) continue;
        fe__touch_link l = k->touches[i].link[side];
        link_of(k, l.previous, line)->next = l.next;
        link_of(k, l.next, line)->previous = l.previous;
        if (*first == i) *first = l.next == i ? FE__NO_TOUCH : l.next;
    }
}

// Those of the first `count` that are not out
static void link_touches(chain *k, int32_t count)
{
    for (int32_t i = 0; i < k->count; ++i)
        for (int side = 0; side < 2; ++side) {
            int32_t line = k->touches[i].line[side];
            if (line != FE__STATIC_LINE) k->s->touch_of[line] = FE__NO_TOUCH;
        }
    for (int32_t i = 0; i < count; ++i)
        if (!k->touches[i].flags) link_touch(k, i);
    k->first = k->listed = 0;
}

static void list_touch(chain *k, int32_t i)
{
    unlink_touch(k, i);
    k->touches[i].flags = LISTED;
    k->touches[(k->first + k->listed++) % k->count].listed = i;
}

static fe__touch *listed_touch(const chain *k, int32_t i)
{
    return k->touches + k->touches[(k->first + i) % k->count].listed;
}

static void list_line(chain *k, int32_t line)
{
    if (line == FE__STATIC_LINE) return;
    while (k->s->touch_of[line] != FE__NO_TOUCH) list_touch(k, k->s->touch_of[line]);
}

static int32_t line_has(const chain *k, const fe__touch *t, uint8_t mark)
{
    return (k->s->touches_of[t->line[0]] | k->s->touches_of[t->line[1]]) & mark;
}

static void mark_line(const chain *k, int32_t line, uint8_t mark)
{
    if (line != FE__STATIC_LINE) k->s->touches_of[line] |= mark;
}

// ---- who takes part -------------------------------------------------------------------------------------------------
// Chains without an impact above the threshold stay as they are: nothing bounces in them.
static void keep_fast(chain *k)
{
    link_touches(k, k->count);
    for (int32_t i = 0; i < k->count; ++i)
        if (k->touches[i].fast) list_touch(k, i);
    for (int32_t i = 0; i < k->listed; ++i)
        for (int side = 0; side < 2; ++side) {
            int32_t line = listed_touch(k, i)->line[side];
            mark_line(k, line, FAST);
            list_line(k, line);
        }
    int32_t kept = 0;
    for (int32_t i = 0; i < k->count; ++i)
        if (k->touches[i].flags) k->touches[kept++] = k->touches[i];
    k->count = k->touched = kept;
    if (kept) find_touches(k, 1);
    for (int32_t i = 0; i < k->count; ++i) k->touches[i].flags = 0;
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

static float speed_of(const float *v) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static float change_of(const fe__solver *s, int32_t line)
{
    const float *v = s->velocity[line].v, *start = s->start[line].v;
    float change[3] = {v[0] - start[0], v[1] - start[1], v[2] - start[2]};
    return speed_of(change);
}

// A joint that has turned a body with its blow has given it spin: the speed of its centre tells whether it is held.
static int32_t is_held(const chain *k, int32_t line, float change)
{
    const fe__velocity_line *now = k->s->velocity + line;
    const fe__start_line *start = k->s->start + line;
    if (fe__body_of_line(k->s, k->of, line)->joint_count)
        return speed_of(now->v) > (1.0f + GAINED) * speed_of(start->v) + GAINED_SPEED + JOINED_SHARE * change;
    float most = (1.0f + GAINED) * sqrtf(energy_of(k->s, line, start->v, start->w)) + GAINED_SPEED;
    return energy_of(k->s, line, now->v, now->w) > most * most;
}

static void take_all(const chain *k)
{
    for (fe__touch *t = k->touches, *end = t + k->touched; t < end; ++t)
        for (int side = 0; side < 2; ++side) t->change[side] = change_of(k->s, t->line[side]);
    act_on_all(k, 0, FE__TOUCH_TAKE);
}

static void list_held(chain *k, const fe__touch *t)
{
    for (int side = 0; side < 2; ++side) {
        int32_t line = t->line[side];
        if (line == FE__STATIC_LINE || k->s->touches_of[line] & HELD || !is_held(k, line, t->change[side])) continue;
        mark_line(k, line, HELD);
        list_line(k, line);
    }
}

// What the touches of held bodies gave returns, by which others may be held. Those touches are listed.
static void return_held(chain *k)
{
    link_touches(k, k->touched);
    for (int32_t i = 0; i < k->touched; ++i) list_held(k, k->touches + i);
    sort_listed(k, 0, k->listed);
    for (int32_t i = 0, end; i < k->listed; i = end) {
        end = k->listed;
        for (int32_t j = i; j < end; ++j) act_on(k, listed_touch(k, j)->lane, 1, FE__TOUCH_RETURN);
        for (int32_t j = i; j < end; ++j) list_held(k, listed_touch(k, j));
    }
}

// ---- one after another ----------------------------------------------------------------------------------------------
static void bounce_held(chain *k)
{
    act_on_all(k, LISTED, FE__TOUCH_BOUNCE);
    act_on_all(k, 0, FE__TOUCH_FORGET);
}

static void list_free(chain *k)
{
    for (int32_t i = 0; i < k->count; ++i) {
        fe__touch *t = k->touches + i;
        int32_t out = i < k->touched ? t->flags : line_has(k, t, HELD);
        t->flags = out ? OUT : 0;
    }
    link_touches(k, k->count);
    for (int32_t i = 0; i < k->touched; ++i)
        if (!k->touches[i].flags) list_touch(k, i);
    sort_listed(k, 0, k->listed);
    int32_t near = k->listed;
    for (int32_t i = k->touched; i < k->count; ++i) {
        k->touches[i].when = 0.0f; // they have none
        if (!k->touches[i].flags) list_touch(k, i);
    }
    sort_listed(k, near, k->listed - near);
}

static void bounce_free(chain *k)
{
    list_free(k);
    while (k->listed) {
        fe__touch *t = listed_touch(k, 0);
        k->first = (k->first + 1) % k->count;
        --k->listed;
        t->flags = 0;
        int32_t bounced = act_on(k, t->lane, 1, FE__TOUCH_PASS_ON);
        t->impacts += bounced;
        if (t->impacts < IMPACTS) link_touch(k, (int32_t)(t - k->touches));
        for (int side = 0; side < 2 && bounced; ++side) list_line(k, t->line[side]);
    }
}

void fe__pass_on(fe__solver *s, const fe__kernels *kernels, const fe__records *of, const fe__batch *b,
                 unsigned char *rows, const fe__step_constants *c)
{
    if (!atomic_load_explicit(&s->chained, memory_order_relaxed)) return;
    const fe__group *groups = s->groups + b->first_group + b->joint_groups;
    chain k = {.s = s,
               .of = of,
               .kernels = kernels,
               .groups = groups,
               .group_count = b->group_count - b->joint_groups,
               .rows = rows,
               .c = c,
               .touches = s->touches + groups->lane};
    find_touches(&k, 0);
    if (k.count) keep_fast(&k);
    if (!k.count) return;
    take_all(&k);
    return_held(&k);
    bounce_held(&k);
    bounce_free(&k);
}
