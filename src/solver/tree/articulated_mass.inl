// articulated_mass.inl - contacts see the masses of a tree, and the tree takes what they gave. Part of
// tree_solver.simd.c.
//
// While contacts are solved, the lines of touched links hold what the tree answers there instead of their own inverse
// masses (response.inl). What a contact changes of a velocity by them is an impulse all the same, l = D^-1 dv. With the
// body's own mass it is the change of the body alone, M^-1 l, from which the tree is solved. So it is for `start`, from
// which they take what no warm start shall repeat.

// lock_bits are whole numbers. What a line says beside them, 1/c, tells the rows two things. Its inertia stays as it is
// while the body turns: D^-1 of a D that some rows have turned, and others not, would make much of what is little, as D
// is far from round. And the softness is that of D/c, see stiffen.

static void write_inertia(const pass *t, const tree_node *n, int32_t lanes, const half *inverse)
{
    lines l = read_lines(t->solver->inertia, &n->line);
    for (int k = 0; k < 6; ++k) l.a[k] = inverse[k];
    write_lines(t->solver->inertia, &n->line, lanes, &l);
}

// From here on contacts change the velocities
static void lend(const pass *t)
{
    t->head->lent = t->head->lends;
    for (int32_t i = 0; i < t->count && t->head->lent; ++i) {
        tree_node *n = t->nodes + i;
        const int32_t lanes = n->touched & t->head->lent;
        if (!lanes) continue;
        lines v = n->held = read_lines(t->solver->velocity, &n->line);
        lines start = n->held_start = read_lines(t->solver->start, &n->line);
        v.a[3] = start.a[3] = narrow(n->light / n->mass);
        v.a[7] += n->part;
        write_lines(t->solver->velocity, &n->line, lanes, &v);
        write_lines(t->solver->start, &n->line, lanes, &start);
        write_inertia(t, n, lanes, n->seen);
    }
}

FE_INLINE void return_inertia(const pass *t, const tree_node *n, int32_t lanes)
{
    const real_sym *i = &n->first_inverse;
    const half own[6] = {narrow(i->xx), narrow(i->xy), narrow(i->xz), narrow(i->yy), narrow(i->yz), narrow(i->zz)};
    write_inertia(t, n, lanes, own);
}

// held + M^-1 D^-1 (now - held). Returns the lanes in which it is not held
FE_INLINE int32_t take_line(const tree_node *n, void *of, const lines *held, int32_t lanes)
{
    const lines now = read_lines(of, &n->line);
    const real3 v = widen3(held->a), w = widen3(held->a + 4);
    const real3 dv = r_sub(widen3(now.a), v), dw = r_sub(widen3(now.a + 4), w);
    lines own = *held;
    narrow3(own.a, r_add_scaled(v, 1.0 / n->light, dv));
    narrow3(own.a + 4, r_add(w, spin_of(n, r_mul_sym(&n->resists, dw))));
    write_lines(of, &n->line, lanes, &own);
    const real3 none = r_zero3();
    real most = none.x;
    most = r_max(r_max(most, r_abs(dv.x)), r_max(r_abs(dv.y), r_abs(dv.z)));
    most = r_max(r_max(most, r_abs(dw.x)), r_max(r_abs(dw.y), r_abs(dw.z)));
    return r_bits(r_greater(most, none.x)) & lanes;
}

// Velocities and masses are the bodies' own again. Returns the lanes in which contacts changed a velocity
static int32_t take_back(const pass *t)
{
    int32_t struck = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const int32_t lanes = n->touched & t->head->lent;
        if (!lanes) continue;
        return_inertia(t, n, lanes);
        struck |= take_line(n, t->solver->velocity, &n->held, lanes);
        take_line(n, t->solver->start, &n->held_start, lanes);
    }
    t->head->lent = 0;
    return struck;
}
