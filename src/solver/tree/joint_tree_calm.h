// joint_tree_calm.h - light links under great tension. Part of joint.simd.c.
//
// A force f that pulls at an arm r holds a body like a spring of k = r.f about its centre (geometric stiffness: Tournier et al., "Stable
// Constrained Dynamics", SIGGRAPH 2015). A light link under a heavy load swings on it at sqrt(k / I), faster than a substep can follow,
// and with forces that keep their direction through the substep it gains energy: the chain tears itself apart. What implicit Euler would
// take from such a spring, a damper c = h k, is taken from the turn of neighbours against each other, by three more rows with G = 1 / (h
// c). They push in pairs, so that momentum stays; as one body, the links swing on undamped. And only as much of k counts as lets a link
// swing faster than the substep, h^2 k > I: what is slower stays as it is.

// h^2 k of the joint at one of its ends, 0: below, kg m2
static double tension_of(const tree_node *n, int end, double h)
{
    double along = fe__ddot(n->rows.arm[end], n->rows.pull);
    along = end == 0 ? along : -along;
    return along > 0.0 ? h * along : 0.0;
}

static void find_tensions(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].tension = 0.0;
    for (int32_t i = 0; i < t->count; ++i) {
        t->nodes[i].tension += tension_of(t->nodes + i, 0, t->h);
        if (parent_of(t, i)) parent_of(t, i)->tension += tension_of(t->nodes + i, 1, t->h);
    }
}

// share of the body's tension that is more than it can follow
static double excess_of(const tree_node *n) { return n->tension > n->inertia ? 1.0 - n->inertia / n->tension : 0.0; }

static void calm_tree(const tree_job *t)
{
    const fe_dvec3 still = {0.0, 0.0, 0.0};
    find_tensions(t);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        n->expected = n->tension;
        n->calm = tension_of(n, 0, t->h) * excess_of(n);
        if (parent_of(t, i)) n->calm += tension_of(n, 1, t->h) * excess_of(parent_of(t, i));
        for (int k = 0; k < 3 && n->calm > 0.0; ++k) {
            n->least[n->rows.count] = 0.0;
            add_row(&n->rows, t->links[i].holds_b, still, unit(k), unit(k), 0.0);
        }
        hide_locked(&n->rows, n->locks, locks_of(below_of(t, i)), locks_of(above_of(t, i)));
    }
}

// what the solution at hand pulls, on top of what the rows hold
static void add_pulls(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        for (int r = 0; r < n->locks; ++r) n->rows.pull = fe__dadd(n->rows.pull, fe__dscale(n->impulse[r], vec_of(n->rows.below[r])));
    }
}

// 1: some link bears much more than what its joints were calmed for, as when a slack chain goes taut. The rows' pulls are spoilt
static int is_jerked(const tree_job *t)
{
    int jerked = 0;
    add_pulls(t);
    find_tensions(t);
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        jerked |= n->tension > n->inertia && n->tension > 2.0 * n->expected;
    }
    return jerked;
}
