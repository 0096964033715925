// rows.c - rows and masses of a tree from the locks that the sweep holds, with the bodies where they are now.
#include "solver/tree/rows.h"

#include <string.h>

void fe__tree_add_row(fe__tree_rows *t, int32_t holds_b, fe_dvec3 u, fe_dvec3 ma, fe_dvec3 mb, double error)
{
    const double a[6] = {-u.x, -u.y, -u.z, -ma.x, -ma.y, -ma.z}, b[6] = {u.x, u.y, u.z, mb.x, mb.y, mb.z};
    memcpy(t->below[t->count], holds_b ? b : a, sizeof a);
    memcpy(t->above[t->count], holds_b ? a : b, sizeof a);
    if (fe__ddot(u, u) > 0.0) t->points |= 1 << t->count;
    t->error[t->count++] = error;
}

void fe__tree_hide_locked(fe__tree_rows *rows, int32_t from, int32_t below, int32_t above)
{
    for (int32_t r = from; r < rows->count && (below | above); ++r)
        for (int k = 0; k < 6; ++k) {
            if (below >> k & 1) rows->below[r][k] = 0.0;
            if (above >> k & 1) rows->above[r][k] = 0.0;
        }
}

// ---- locks ----------------------------------------------------------------------------------------------------------
// A lock in double, the bodies where they are now
typedef struct place {
    const fe__motion_line *a, *b;
    fe_dvec3 ra, rb, gap; // arms of the anchors; anchor of B - anchor of A
} place;

static fe_dvec3 turned(const fe__motion_line *motion, fe_dvec3 first)
{
    return fe__drotate(fe__quat_of(motion->rotation), first);
}

static place ends_of(const fe__solver *s, const fe__lock *l)
{
    return (place){.a = s->motion + l->line_a, .b = s->motion + l->line_b};
}

static place anchors_of(const fe__solver *s, const fe__lock *l)
{
    place p = ends_of(s, l);
    const fe_dvec3 first_a = fe__widen(l->arm_a), first_b = fe__widen(l->arm_b);
    p.ra = turned(p.a, first_a), p.rb = turned(p.b, first_b);
    const fe_dvec3 shift = fe__dsub(fe__widen(fe__quad_vector(p.b->shift)), fe__widen(fe__quad_vector(p.a->shift)));
    const fe_dvec3 swing = fe__dsub(fe__dsub(p.rb, first_b), fe__dsub(p.ra, first_a));
    p.gap = fe__dadd(fe__widen(l->gap), fe__dadd(shift, swing));
    return p;
}

static void set_arms(fe__tree_rows *t, int32_t holds_b, fe_dvec3 ra, fe_dvec3 rb)
{
    t->arm[0] = holds_b ? rb : ra, t->arm[1] = holds_b ? ra : rb;
}

static void add_pull(fe__tree_rows *t, int32_t holds_b, fe_dvec3 on_b)
{
    t->pull = fe__dadd(t->pull, fe__dscale(holds_b ? 1.0 : -1.0, on_b));
}

static void add_point(fe__tree_rows *t, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    const double error[3] = {p.gap.x, p.gap.y, p.gap.z};
    set_arms(t, holds_b, p.ra, p.rb);
    add_pull(t, holds_b, (fe_dvec3){(double)l->impulse[0], (double)l->impulse[1], (double)l->impulse[2]});
    for (int k = 0; k < 3; ++k) {
        const fe_dvec3 u = fe__tree_unit(k);
        fe__tree_add_row(t, holds_b, u, fe__dcross(p.ra, u), fe__dcross(p.rb, u), error[k]);
    }
}

// A's arm reaches to where B's anchor is along the free axes
static void add_slide(fe__tree_rows *t, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    fe_dvec3 u[3], arm = p.ra;
    for (int k = 0; k < 3; ++k) {
        u[k] = turned(p.a, fe__drotate(l->frame, fe__tree_unit(k)));
        if (!(l->keeps[k] > 0.0f)) arm = fe__dadd(arm, fe__dscale(fe__ddot(u[k], p.gap), u[k]));
    }
    set_arms(t, holds_b, arm, p.rb);
    for (int k = 0; k < 3; ++k) {
        add_pull(t, holds_b, fe__dscale((double)l->impulse[k], u[k]));
        if (l->keeps[k] > 0.0f)
            fe__tree_add_row(t, holds_b, u[k], fe__dcross(arm, u[k]), fe__dcross(p.rb, u[k]), fe__ddot(u[k], p.gap));
    }
}

static void add_hinge(fe__tree_rows *t, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = ends_of(s, l);
    const fe_dvec3 still = {0.0, 0.0, 0.0}, t1 = turned(p.a, fe__widen(l->t1)), t2 = turned(p.a, fe__widen(l->t2));
    const fe_dvec3 axis_b = turned(p.b, fe__widen(l->axis_b));
    fe__tree_add_row(t, holds_b, still, t1, t1, -fe__ddot(t2, axis_b));
    fe__tree_add_row(t, holds_b, still, t2, t2, fe__ddot(t1, axis_b));
}

static void add_fixed(fe__tree_rows *t, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = ends_of(s, l);
    const fe_quat a = fe__quat_of(p.a->rotation), b = fe__quat_of(p.b->rotation);
    const fe_quat q = fe__product(fe__product(b, l->frame), fe__conjugate(a));
    const double two = q.w < 0.0f ? -2.0 : 2.0, error[3] = {two * (double)q.x, two * (double)q.y, two * (double)q.z};
    const fe_dvec3 still = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; ++k) fe__tree_add_row(t, holds_b, still, fe__tree_unit(k), fe__tree_unit(k), error[k]);
}

// Two points in one place are apart along X of A
static void add_distance(fe__tree_rows *t, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    const double length = sqrt(fe__ddot(p.gap, p.gap));
    const fe_dvec3 x = turned(p.a, fe__drotate(l->frame, fe__tree_unit(0)));
    const fe_dvec3 u = length > 0.0 ? fe__dscale(1.0 / length, p.gap) : x;
    set_arms(t, holds_b, p.ra, p.rb);
    t->rod = length;
    add_pull(t, holds_b, fe__dscale((double)l->impulse[0], u));
    fe__tree_add_row(t, holds_b, u, fe__dcross(p.ra, u), fe__dcross(p.rb, u), length - (double)l->length);
}

static void add_lock(fe__tree_rows *t, int32_t holds_b, int32_t part, const fe__lock *l, const fe__solver *s)
{
    switch (part) {
    case FE__PART_POINT:
        add_point(t, holds_b, l, s);
        break;
    case FE__PART_SLIDE:
        add_slide(t, holds_b, l, s);
        break;
    case FE__PART_HINGE:
        add_hinge(t, holds_b, l, s);
        break;
    case FE__PART_FIXED:
        add_fixed(t, holds_b, l, s);
        break;
    default:
        add_distance(t, holds_b, l, s);
    }
}

// ---- masses ---------------------------------------------------------------------------------------------------------
// of a symmetric matrix xx xy xz yy yz zz, 0 where it has none
static void invert(const double i[6], double out[3][3])
{
    double xx = i[3] * i[5] - i[4] * i[4], xy = i[2] * i[4] - i[1] * i[5], xz = i[1] * i[4] - i[2] * i[3];
    double yy = i[0] * i[5] - i[2] * i[2], yz = i[1] * i[2] - i[0] * i[4], zz = i[0] * i[3] - i[1] * i[1];
    double d = i[0] * xx + i[1] * xy + i[2] * xz, k = d > 0.0 ? 1.0 / d : 0.0;
    out[0][0] = k * xx, out[1][1] = k * yy, out[2][2] = k * zz;
    out[0][1] = out[1][0] = k * xy, out[0][2] = out[2][0] = k * xz, out[1][2] = out[2][1] = k * yz;
}

static int32_t locks_of(const fe__velocity_line *line) { return (int32_t)line->lock_bits; }

// A locked direction gets some mass, but no row sees it (fe__tree_hide_locked)
static void weigh(fe__tree_node *n, const fe__velocity_line *line, const fe__sym3 *inertia)
{
    const float in[6] = {inertia->xx, inertia->xy, inertia->xz, inertia->yy, inertia->yz, inertia->zz};
    static const int diagonal[3] = {0, 3, 5};
    double inverse[6], turn[3][3], mass = 1.0 / (double)line->inverse_mass;
    for (int k = 0; k < 6; ++k) inverse[k] = n->inverse_inertia[k] = (double)in[k];
    for (int k = 0; k < 3; ++k)
        if (locks_of(line) >> (3 + k) & 1) inverse[diagonal[k]] = 1.0;
    invert(inverse, turn);
    memset(n->mass, 0, sizeof n->mass);
    for (int i = 0; i < 3; ++i) {
        n->mass[i][i] = mass;
        memcpy(n->mass[3 + i] + 3, turn[i], sizeof turn[i]);
    }
    n->inertia = 0.0;
    for (int k = 0; k < 3; ++k)
        if (!(locks_of(line) >> (3 + k) & 1)) n->inertia = fe__maxd(n->inertia, turn[k][k]);
    n->weighed = 1;
}

// Rows of which less is left are met by the others already, or see only locked directions: a share of the response of
// the body below if it were free and bore nothing. Some digits above the rounding of a row, squared; a load takes its
// ratio of masses off the response.
#define REDUNDANT 1e-10

static void find_least(fe__tree_node *n, double inverse_mass)
{
    double turn = n->inverse_inertia[0] + n->inverse_inertia[3] + n->inverse_inertia[5];
    for (int32_t r = 0; r < n->locks; ++r) {
        fe_dvec3 u = fe__tree_vector(n->rows.below[r]), m = fe__tree_vector(n->rows.below[r] + 3);
        n->least[r] = REDUNDANT * (inverse_mass * fe__ddot(u, u) + turn * fe__ddot(m, m));
    }
}

static void clear_rows(fe__tree_rows *rows)
{
    const fe_dvec3 zero = {0.0, 0.0, 0.0};
    rows->count = rows->points = 0;
    rows->rod = 0.0;
    rows->arm[0] = rows->arm[1] = rows->pull = zero;
}

static void read_link(const fe__tree_job *t, int32_t i)
{
    fe__tree_node *n = t->nodes + i, *parent = fe__tree_parent(t, i);
    const fe__tree_place *p = t->places + i;
    const int32_t holds_b = t->links[i].holds_b;
    clear_rows(&n->rows);
    for (int32_t k = 0; k < p->locks; ++k) {
        fe__lock lock;
        t->lanes->read(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, &lock);
        add_lock(&n->rows, holds_b, p->lock[k].part, &lock, t->solver);
        if (!n->weighed) weigh(n, fe__tree_below(t, i), holds_b ? &lock.inertia_b : &lock.inertia_a);
        if (parent && !parent->weighed)
            weigh(parent, fe__tree_above(t, i), holds_b ? &lock.inertia_a : &lock.inertia_b);
    }
    n->locks = n->rows.count;
    find_least(n, (double)fe__tree_below(t, i)->inverse_mass);
    fe__tree_hide_locked(&n->rows, 0, locks_of(fe__tree_below(t, i)), locks_of(fe__tree_above(t, i)));
}

void fe__tree_read(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].weighed = 0;
    for (int32_t i = 0; i < t->count; ++i) read_link(t, i);
}
