// damping.inl - light links under great tension. Part of tree_solver.simd.c.
//
// A force f that pulls at an arm r holds a body like a spring of k = r.f about its centre (geometric stiffness:
// Tournier et al., "Stable Constrained Dynamics", SIGGRAPH 2015). A light link under a heavy load swings on it at
// sqrt(k / I), faster than a substep can follow, and with forces that keep their direction through the substep it gains
// energy: the chain tears itself apart. Implicit Euler would damp such a spring by c = h k. We damp the rotation of
// neighbours against each other by as much. Their impulses come in pairs, so that momentum stays; as one body, the
// links swing on undamped. Only the part of k counts by which a link swings faster than the substep, h^2 k > I: slower
// links stay as they are.

// h^2 k of the joint at one of its ends, 0: below, kg m2
FE_INLINE real tension_of(const tree_node *n, real3 pull, int end, real h)
{
    const real along = end == 0 ? r_dot(n->below, pull) : -r_dot(n->above, pull);
    return r_max(along, r_set(0.0)) * h;
}

// what the locks bore before, with the solution at hand on top of it
FE_INLINE real3 pull_now(const tree_node *n) { return r_add(n->pull, n->impulse_v); }

// From the root downwards, so that the bodies above have their own already
FE_INLINE void add_tension(const pass *t, int32_t i, real3 pull)
{
    tree_node *n = t->nodes + i, *above = above_of(t, i);
    n->tension = 0.0 + tension_of(n, pull, 0, t->h);
    if (above) above->tension += tension_of(n, pull, 1, t->h);
}

// share of the body's tension that is more than it can follow
FE_INLINE real excess_of(const tree_node *n)
{
    const real_mask more = r_greater(n->tension, n->heaviest);
    if (!r_bits(more)) return r_set(0.0);
    return r_choose(more, 1.0 - n->heaviest / n->tension, r_set(0.0));
}

// For these pulls and tensions. In the given lanes
FE_INLINE void add_damping(const pass *t, int32_t i, real3 pull, real_mask lanes)
{
    tree_node *n = t->nodes + i, *above = above_of(t, i);
    real damping = tension_of(n, pull, 0, t->h) * excess_of(n);
    if (above) damping += tension_of(n, pull, 1, t->h) * excess_of(above);
    n->expected = r_choose(lanes, n->tension, n->expected);
    n->damping = r_choose(lanes, damping, n->damping);
}

// The lanes in which some link bears much more than what its joints were damped for, as when a slack chain goes taut
static int32_t jerked(const pass *t)
{
    int32_t lanes = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        lanes |= r_bits(r_greater(n->tension, n->heaviest)) & r_bits(r_greater(n->tension, 2.0 * n->expected));
    }
    return lanes;
}

// I^-1 l of a body
FE_INLINE real3 spin_of(const tree_node *n, real3 l)
{
    return r_mul(&n->principal, r_mul_sym(&n->first_inverse, r_mul_transposed(&n->principal, l)));
}

// to `start`, in the given lanes
FE_INLINE void add_spin(const pass *t, const tree_node *n, int32_t lanes, real3 l)
{
    lines start = read_lines(t->solver->start, &n->line);
    narrow3(start.a + 4, r_add(widen3(start.a + 4), spin_of(n, l)));
    write_lines(t->solver->start, &n->line, lanes, &start);
}

// Damping leaves the warm start: `start` takes what it gave
static void forget_damping(const pass *t, int32_t i, int32_t lanes)
{
    const tree_node *n = t->nodes + i, *above = above_of(t, i);
    lanes &= is_damped(n);
    if (!lanes) return;
    real3 given = n->impulse_w;
    if (!is_ball(t, i)) {
        given = r_zero3();
        for (int k = 0; k < 3; ++k)
            if (t->links[i].form >> (3 + k) & 1) given = r_add_scaled(given, r_dot(n->ang[k], n->impulse_w), n->ang[k]);
    }
    add_spin(t, n, lanes, given);
    if (above) add_spin(t, above, lanes, r_scale(r_set(-1.0), given));
}
