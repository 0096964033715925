// lend.inl - contacts see the masses of a tree, and the tree takes what they gave. Part of tree.simd.c.
//
// While contacts are solved, the lines of touched links hold shares of their inverse masses (response.inl). What a
// contact changes of a velocity by them is an impulse all the same: over the share it is the change of the body alone,
// from which the tree is solved. So it is for `start`, from which they take what no warm start shall repeat.

static void write_inertia(const pass *t, const tree_node *n, int32_t lanes, real spins)
{
    const real_sym *i = &n->first_inverse;
    const real own[6] = {i->xx, i->xy, i->xz, i->yy, i->yz, i->zz};
    lines l = read_lines(t->solver->inertia, &n->line);
    for (int k = 0; k < 6; ++k) l.a[k] = narrow(spins * own[k]);
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
        write_lines(t->solver->velocity, &n->line, lanes, &v);
        write_lines(t->solver->start, &n->line, lanes, &start);
        write_inertia(t, n, lanes, n->spins);
    }
}

// held + (now - held) / share. Returns the lanes in which it is not held
FE_INLINE int32_t take_line(const tree_node *n, void *of, const lines *held, int32_t lanes)
{
    const lines now = read_lines(of, &n->line);
    lines own = *held;
    real most = r_set(0.0);
    for (int k = 0; k < FE__LINE; ++k) {
        if (k % 4 == 3) continue; // no velocity
        const real was = r_widen(held->a[k]), change = r_widen(now.a[k]) - was;
        own.a[k] = narrow(was + change / (k < 4 ? n->light : n->spins));
        most = r_max(most, r_abs(change));
    }
    write_lines(of, &n->line, lanes, &own);
    return r_bits(r_greater(most, r_set(0.0))) & lanes;
}

// Velocities and masses are the bodies' own again. Returns the lanes in which contacts changed a velocity
static int32_t take_back(const pass *t)
{
    int32_t struck = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const int32_t lanes = n->touched & t->head->lent;
        if (!lanes) continue;
        write_inertia(t, n, lanes, r_set(1.0));
        struck |= take_line(n, t->solver->velocity, &n->held, lanes);
        take_line(n, t->solver->start, &n->held_start, lanes);
    }
    t->head->lent = 0;
    return struck;
}
