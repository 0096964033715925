// tree.c - what a tree does in each pass over the joints: requests, and their results.
#include "solver/tree/tree.h"

#include "solver/tree/damping.h"
#include "solver/tree/eliminate.h"
#include "solver/tree/rows.h"
#include "solver/tree/warm_start.h"

#include <string.h>

// A light tree is left to the sweep until an impact pulls a joint's points apart by more than this: four fifths of the
// linear slop, so that the slop is kept with something to spare, m
#define OPEN 0.004f
// What is farther apart when the step begins was put there, by the user or by continuous collision: it comes together
// softly, by sweeps
#define PUT_APART (2.0f * OPEN)
// A rotation, rad, beyond which rows say nothing of where an arm leads
#define FULL_TURN 0.25

// ---- requests -------------------------------------------------------------------------------------------------------
static void widen(const fe__velocity_line *line, double out[6])
{
    for (int k = 0; k < 3; ++k) out[k] = (double)line->v[k], out[3 + k] = (double)line->w[k];
}

// J v = 0
static void request_rest(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        double vb[6], va[6];
        widen(fe__tree_below(t, i), vb), widen(fe__tree_above(t, i), va);
        for (int32_t r = 0; r < n->rows.count; ++r) {
            const double *b = n->rows.below[r], *a = n->rows.above[r];
            double sum = 0.0;
            for (int k = 0; k < 3; ++k) {
                sum -= b[k] * vb[k] + b[3 + k] * vb[3 + k];
                sum -= a[k] * va[k] + a[3 + k] * va[3 + k];
            }
            n->request[r] = sum;
        }
    }
}

typedef struct velocity {
    fe_dvec3 v, w;
} velocity;

// with the change at hand
static velocity changed(const fe__velocity_line *line, const double *change)
{
    static const double none[6] = {0};
    const double *u = change ? change : none;
    return (velocity){{(double)line->v[0] + u[0], (double)line->v[1] + u[1], (double)line->v[2] + u[2]},
                      {(double)line->w[0] + u[3], (double)line->w[1] + u[4], (double)line->w[2] + u[5]}};
}

// Of the arcs of a rotation, by its square: beyond FE__SLOW_TURN they are left to the positions, which lose energy by
// it instead of gaining it
static double slow_share(double square)
{
    return fe__mind(fe__maxd(2.0 - square / (FE__SLOW_TURN * FE__SLOW_TURN), 0.0), 1.0);
}

// A point on an arm r leaves its tangent while the body turns: by integrate_positions' Q = Cayley(h w) it goes on by
//     (Q - 1) r - h w x r = 2/(1 + u^2) (u x r + u x (u x r)) - 2 u x r,   u = h w / 2
// The rotation about the arm itself leaves the point alone.
static fe_dvec3 leave_tangent(fe_dvec3 r, fe_dvec3 w, double h)
{
    double square = fe__ddot(r, r), along = square > 0.0 ? fe__ddot(w, r) / square : 0.0;
    fe_dvec3 u = fe__dscale(0.5 * h, fe__dadd(w, fe__dscale(-along, r))), a = fe__dcross(u, r);
    double k = 2.0 / (1.0 + fe__ddot(u, u));
    return fe__dscale(slow_share(4.0 * fe__ddot(u, u)),
                      fe__dadd(fe__dscale(k - 2.0, a), fe__dscale(k, fe__dcross(u, a))));
}

// A rod grows by the square of what its ends move across it
static double leave_rod(const fe__tree_rows *rows, const velocity *below, const velocity *above, double h)
{
    fe_dvec3 u = fe__tree_vector(rows->below[0]);
    fe_dvec3 v = fe__dsub(fe__dadd(below->v, fe__dcross(below->w, rows->arm[0])),
                          fe__dadd(above->v, fe__dcross(above->w, rows->arm[1])));
    // angle squared
    double along = fe__ddot(v, u), turn = h * h * (fe__ddot(v, v) - along * along) / (rows->rod * rows->rod);
    return slow_share(turn) * 0.5 * turn * rows->rod;
}

// Velocities with which the points meet after the substep, on the arcs of the velocities at hand
static void request_arcs(const fe__tree_job *t)
{
    request_rest(t);
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        velocity below = changed(fe__tree_below(t, i), n->change),
                 above = changed(fe__tree_above(t, i), fe__tree_parent(t, i) ? fe__tree_parent(t, i)->change : NULL);
        fe_dvec3 off_below = leave_tangent(n->rows.arm[0], below.w, t->h),
                 off_above = leave_tangent(n->rows.arm[1], above.w, t->h);
        for (int32_t r = 0; r < n->locks; ++r) {
            const fe_dvec3 b = fe__tree_vector(n->rows.below[r]), a = fe__tree_vector(n->rows.above[r]);
            n->request[r] -= (fe__ddot(b, off_below) + fe__ddot(a, off_above)) / t->h;
        }
        if (n->rows.rod > 0.0) n->request[0] -= leave_rod(&n->rows, &below, &above, t->h) / t->h;
    }
}

// Positions are put right at once, as far as FULL_TURN of the arms takes them; what is farther apart follows as fast as
// the softness of a lock says. Returns the largest gap, m.
static double request_closed(const fe__tree_job *t)
{
    double widest = 0.0;
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        double arm = sqrt(fe__maxd(fe__ddot(n->rows.arm[0], n->rows.arm[0]), fe__ddot(n->rows.arm[1], n->rows.arm[1])));
        double gap = 0.0;
        arm = fe__maxd(arm, n->rows.rod);
        for (int32_t r = 0; r < n->rows.count; ++r) {
            int32_t point = n->rows.points >> r & 1;
            double error = n->rows.error[r],
                   most = fe__maxd(FULL_TURN * (point ? arm : 1.0), t->rate * fe__absd(error));
            n->request[r] = fe__mind(fe__maxd(-error, -most), most);
            gap += point ? error * error : 0.0;
        }
        widest = fe__maxd(widest, gap);
    }
    return sqrt(widest);
}

// ---- results --------------------------------------------------------------------------------------------------------
// to velocities and rows; with `total` the impulses count in the sums over the step
static void apply(const fe__tree_job *t, int32_t total)
{
    for (int32_t i = 0; i < t->count; ++i) {
        const fe__tree_node *n = t->nodes + i;
        const fe__tree_place *p = t->places + i;
        fe__velocity_line *line = t->solver->velocity + p->line;
        for (int k = 0; k < 3; ++k) {
            line->v[k] = (float)((double)line->v[k] + n->change[k]);
            line->w[k] = (float)((double)line->w[k] + n->change[3 + k]);
        }
        fe__tree_forget_damping(t, i);
        for (int32_t k = 0, first = 0; k < p->locks; ++k)
            first +=
                t->lanes->add(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, n->impulse + first, total);
    }
}

// dp += u, dq = normalize(dq + (w, 0) dq / 2), as a whole no farther than FULL_TURN
static void move(const fe__tree_job *t)
{
    double farthest = FULL_TURN * FULL_TURN;
    for (int32_t i = 0; i < t->count; ++i) {
        const fe_dvec3 turn = fe__tree_vector(t->nodes[i].change + 3);
        farthest = fe__maxd(farthest, fe__ddot(turn, turn));
    }
    double scale = FULL_TURN / sqrt(farthest);
    for (int32_t i = 0; i < t->count; ++i) {
        fe__motion_line *line = t->solver->motion + t->places[i].line;
        float *q = line->rotation;
        const double *u = t->nodes[i].change, w = (double)q[3];
        fe_dvec3 half = fe__dscale(0.5 * scale, fe__tree_vector(u + 3)), v = {(double)q[0], (double)q[1], (double)q[2]};
        fe_dvec3 b = fe__dadd(fe__dadd(v, fe__dscale(w, half)), fe__dcross(half, v));
        double a = w - fe__ddot(half, v), k = 1.0 / sqrt(a * a + fe__ddot(b, b));
        for (int c = 0; c < 3; ++c) line->shift[c] = (float)((double)line->shift[c] + scale * u[c]);
        q[0] = (float)(k * b.x), q[1] = (float)(k * b.y), q[2] = (float)(k * b.z), q[3] = (float)(k * a);
    }
}

// ---- solutions ------------------------------------------------------------------------------------------------------
static void reduce(const fe__tree_job *t)
{
    fe__tree_read(t);
    fe__tree_add_damping(t);
    fe__tree_eliminate(t);
}

// The first solution shows the arcs, the second follows them
static void follow_arcs(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) memset(t->nodes[i].change, 0, sizeof t->nodes[i].change);
    for (int k = 0; k < 2; ++k) {
        request_arcs(t);
        fe__tree_substitute(t);
    }
}

static void follow_locks(const fe__tree_job *t)
{
    request_rest(t);
    fe__tree_substitute(t);
}

// What goes taut is damped for what it bears now, and solved again
static void damp_jerk(const fe__tree_job *t)
{
    if (!fe__tree_is_jerked(t)) return;
    fe__tree_read(t);
    fe__tree_add_pulls(t);
    fe__tree_add_damping(t);
    fe__tree_eliminate(t);
    follow_locks(t);
}

// The gaps are closed as the rows see them, and again where one was wide: closing it turned the rows
static void close_gaps(const fe__tree_job *t)
{
    enum { MOST_CLOSINGS = 8 };
    for (int32_t k = 0; k < MOST_CLOSINGS; ++k) {
        double widest = request_closed(t);
        fe__tree_substitute(t);
        move(t);
        if (widest <= (double)OPEN) return;
        reduce(t);
    }
}

// ---- passes ---------------------------------------------------------------------------------------------------------
int64_t fe__tree_bytes(int32_t links) { return (int64_t)sizeof(fe__tree_node) * links; }

fe__tree_job fe__tree_job_of(fe__solver *s, const fe__lock_lanes *lanes, const fe__joints *joints, int32_t tree,
                             unsigned char *rows, int64_t nodes, const fe__step_constants *c)
{
    const fe__joint_tree *t = joints->forest.trees + tree;
    return (fe__tree_job){.solver = s,
                          .lanes = lanes,
                          .links = joints->forest.links + t->first,
                          .places = s->places + t->first,
                          .count = t->count,
                          .heavy = t->heavy,
                          .rows = rows,
                          .nodes = (fe__tree_node *)(void *)(rows + nodes),
                          .h = (double)c->h,
                          .rate = (double)(c->h * c->joint.bias_rate)};
}

// From here to the end of the step a light tree is solved
static void engage(const fe__tree_job *t)
{
    if (t->nodes->state == FE__TREE_SOLVED) return;
    t->nodes->state = FE__TREE_SOLVED;
    atomic_fetch_add_explicit(&t->solver->engaged, 1, memory_order_relaxed);
}

static int32_t is_open(const fe__tree_job *t, float gap)
{
    return t->lanes->is_open(t->places, t->count, t->rows, gap);
}

// by the velocities as they are
static int32_t will_open(const fe__tree_job *t)
{
    return t->lanes->opens(t->solver, t->links, t->places, t->count, t->rows, OPEN / (float)t->h);
}

void fe__tree_prepare(const fe__tree_job *t)
{
    t->nodes->state = t->heavy ? FE__TREE_SOLVED : is_open(t, PUT_APART) ? FE__TREE_SWEPT : FE__TREE_READY;
    if (t->nodes->state == FE__TREE_SOLVED) reduce(t);
}

void fe__tree_solve(const fe__tree_job *t)
{
    if (t->nodes->state != FE__TREE_SOLVED) return;
    follow_arcs(t);
    damp_jerk(t);
    apply(t, 0);
}

void fe__tree_follow(const fe__tree_job *t)
{
    if (t->nodes->state == FE__TREE_SWEPT || !will_open(t)) return;
    if (t->nodes->state == FE__TREE_READY) reduce(t);
    engage(t);
    fe__tree_solve(t);
}

void fe__tree_relax(const fe__tree_job *t)
{
    if (t->nodes->state == FE__TREE_SWEPT || (t->nodes->state == FE__TREE_READY && !is_open(t, OPEN))) return;
    engage(t);
    reduce(t);
    follow_locks(t);
    damp_jerk(t);
    apply(t, 1);
    if (t->heavy) fe__tree_forget_locks(t);
    close_gaps(t);
}
