// warm_start.c - heavy trees that turn fast begin a substep without the impulses of the last.
//
// A warm start guesses that a lock pulls as it did. Where it turns by much within a substep that is wrong, and after an
// impact by far: relax turns J^T l with the arms, so that a light link on a long arm begins with velocities of the
// order of l M^-1 l, of ten thousand times the energy that the tree has. The tree takes them back along J exactly, but
// limits, contacts and the sweep itself have seen them, and make motion of them. The tree needs no guess: with u = M^-1
// J^T l it solves J (v + u) = request, from which any part of v that J^T spans drops out. So `start`, which the next
// warm start is v less of (bodies.simd.c), takes all that the locks gave:
//     start += M^-1 J^T l,   l = 0
// All locks of the tree or none: one that is kept pulls at links whose others no longer balance it.
#include "solver/tree/warm_start.h"

static int32_t turns_fast(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe_dvec3 turn = fe__dscale(t->h, fe__widen(fe__quad_vector(fe__tree_below(t, i)->w)));
        if (fe__ddot(turn, turn) > FE__SLOW_TURN * FE__SLOW_TURN) return 1;
    }
    return 0;
}

// M^-1 J^T l of one side to where its body started from
static void give_start(const fe__tree_node *n, const double turn[6], fe__start_line *start, double inverse_mass,
                       double (*rows)[6], const double *l)
{
    double sum[6] = {0};
    for (int32_t r = 0; r < n->locks; ++r)
        for (int k = 0; k < 6; ++k) sum[k] += l[r] * rows[r][k];
    for (int k = 0; k < 3; ++k) start->v[k] = (float)((double)start->v[k] + inverse_mass * sum[k]);
    fe__tree_add_spin(start->w, turn, fe__tree_vector(sum + 3));
}

// The rows are those of the pose that relax turned the sweep's to. No pulls are left that a jerk would be measured
// against.
void fe__tree_forget_locks(const fe__tree_job *t)
{
    if (!turns_fast(t)) return;
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        const fe__tree_node *parent = fe__tree_parent(t, i);
        const fe__tree_place *p = t->places + i;
        fe__start_line *start = t->solver->start;
        double l[FE__TREE_ROWS] = {0};
        for (int32_t k = 0, first = 0; k < p->locks; ++k)
            first += t->lanes->take(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, l + first);
        give_start(n, n->inverse_inertia, start + p->line, (double)fe__tree_below(t, i)->inverse_mass, n->rows.below,
                   l);
        if (parent)
            give_start(n, parent->inverse_inertia, start + p->parent_line, (double)fe__tree_above(t, i)->inverse_mass,
                       n->rows.above, l);
        n->rows.pull = (fe_dvec3){0.0, 0.0, 0.0};
    }
}
