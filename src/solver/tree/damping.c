// damping.c - light links under great tension.
//
// A force f that pulls at an arm r holds a body like a spring of k = r.f about its centre (geometric stiffness:
// Tournier et al., "Stable Constrained Dynamics", SIGGRAPH 2015). A light link under a heavy load swings on it at
// sqrt(k / I), faster than a substep can follow, and with forces that keep their direction through the substep it gains
// energy: the chain tears itself apart. Implicit Euler would damp such a spring by c = h k. We damp the rotation of
// neighbours against each other by as much, with three more rows of compliance G = 1 / (h c). Their impulses come in
// pairs, so that momentum stays; as one body, the links swing on undamped. Only the part of k counts by which a link
// swings faster than the substep, h^2 k > I: slower links stay as they are.
#include "solver/tree/damping.h"

#include "solver/tree/rows.h"

// h^2 k of the joint at one of its ends, 0: below, kg m2
static double tension_of(const fe__tree_node *n, int end, double h)
{
    double along = fe__ddot(n->rows.arm[end], n->rows.pull);
    along = end == 0 ? along : -along;
    return along > 0.0 ? h * along : 0.0;
}

static void find_tensions(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].tension = 0.0;
    for (int32_t i = 0; i < t->count; ++i) {
        t->nodes[i].tension += tension_of(t->nodes + i, 0, t->h);
        if (fe__tree_parent(t, i)) fe__tree_parent(t, i)->tension += tension_of(t->nodes + i, 1, t->h);
    }
}

// share of the body's tension that is more than it can follow
static double excess_of(const fe__tree_node *n)
{
    return n->tension > n->inertia ? 1.0 - n->inertia / n->tension : 0.0;
}

void fe__tree_add_damping(const fe__tree_job *t)
{
    const fe_dvec3 still = {0.0, 0.0, 0.0};
    find_tensions(t);
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        n->expected = n->tension;
        n->damping = tension_of(n, 0, t->h) * excess_of(n);
        if (fe__tree_parent(t, i)) n->damping += tension_of(n, 1, t->h) * excess_of(fe__tree_parent(t, i));
        for (int k = 0; k < 3 && n->damping > 0.0; ++k) {
            n->least[n->rows.count] = 0.0;
            fe__tree_add_row(&n->rows, t->links[i].holds_b, still, fe__tree_unit(k), fe__tree_unit(k), 0.0);
        }
        fe__tree_hide_locked(&n->rows, n->locks, (int32_t)fe__tree_below(t, i)->lock_bits,
                             (int32_t)fe__tree_above(t, i)->lock_bits);
    }
}

void fe__tree_add_pulls(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i;
        for (int32_t r = 0; r < n->locks; ++r)
            n->rows.pull = fe__dadd(n->rows.pull, fe__dscale(n->impulse[r], fe__tree_vector(n->rows.below[r])));
    }
}

int32_t fe__tree_is_jerked(const fe__tree_job *t)
{
    int32_t jerked = 0;
    fe__tree_add_pulls(t);
    find_tensions(t);
    for (int32_t i = 0; i < t->count; ++i) {
        const fe__tree_node *n = t->nodes + i;
        jerked |= n->tension > n->inertia && n->tension > 2.0 * n->expected;
    }
    return jerked;
}

void fe__tree_forget_damping(const fe__tree_job *t, int32_t i)
{
    const fe__tree_node *n = t->nodes + i, *parent = fe__tree_parent(t, i);
    const double *l = n->impulse + n->locks;
    if (n->rows.count == n->locks) return;
    fe_dvec3 below = fe__dscale(t->links[i].holds_b ? 1.0 : -1.0, fe__tree_vector(l));
    fe__tree_add_spin(t->solver->start[t->places[i].line].w, n->inverse_inertia, below);
    if (parent)
        fe__tree_add_spin(t->solver->start[t->places[i].parent_line].w, parent->inverse_inertia,
                          fe__dscale(-1.0, below));
}
