// lend.inl - contacts see the masses of a tree, and the tree takes what they gave. Part of tree.simd.c.
//
// While contacts are solved, the lines of touched links hold shares of their inverse masses (response.inl). What a
// contact changes of a velocity by them is an impulse all the same: over the share it is the change of the body alone,
// from which the tree is solved. So it is for `start`, from which they take what no warm start shall repeat.

// In the given lanes
static void write_masses(const pass *t, const tree_node *n, line_names line, int32_t lanes, int lent)
{
    const real one = r_set(1.0), light = lent ? n->light : one, spins = lent ? n->spins : one;
    const real_sym *i = &n->first_inverse;
    const half mass[1] = {narrow(light / n->mass)};
    const half inertia[6] = {narrow(spins * i->xx), narrow(spins * i->xy), narrow(spins * i->xz),
                             narrow(spins * i->yy), narrow(spins * i->yz), narrow(spins * i->zz)};
    write_lines(t->solver->velocity, line.at, lanes, 3, 1, mass);
    write_lines(t->solver->start, line.at, lanes, 3, 1, mass);
    write_lines(t->solver->inertia, line.at, lanes, 0, 6, inertia);
}

// From here on contacts change the velocities
static void lend(const pass *t)
{
    t->head->lent = t->head->lends;
    for (int32_t i = 0; i < t->count && t->head->lent; ++i) {
        tree_node *n = t->nodes + i;
        const int32_t lanes = n->touched & t->head->lent;
        const line_names line = line_of(t, i);
        if (!lanes) continue;
        const lines now = read_lines(t->solver->velocity, line.at), start = read_lines(t->solver->start, line.at);
        memcpy(n->held, now.a, sizeof n->held), memcpy(n->held_start, start.a, sizeof n->held_start);
        write_masses(t, n, line, lanes, 1);
    }
}

// held + (now - held) / share
FE_INLINE void take_line(void *lines_of, line_names line, const half *held, int32_t lanes, real light, real spins)
{
    const lines now = read_lines(lines_of, line.at);
    for (int k = 0; k < 7; ++k) {
        const real was = r_widen(held[k]), share = k < 3 ? light : spins;
        const half own[1] = {narrow(was + (r_widen(now.a[k]) - was) / share)};
        if (k != 3) write_lines(lines_of, line.at, lanes, k, 1, own);
    }
}

FE_INLINE int32_t has_changed(const pass *t, const tree_node *n, line_names line)
{
    const lines now = read_lines(t->solver->velocity, line.at);
    real most = r_set(0.0);
    for (int k = 0; k < 7; ++k) most = r_max(most, r_abs(r_widen(now.a[k]) - r_widen(n->held[k])));
    return r_bits(r_greater(most, r_set(0.0)));
}

// Velocities and masses are the bodies' own again. Returns the lanes in which contacts changed a velocity
static int32_t take_back(const pass *t)
{
    int32_t struck = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const int32_t lanes = n->touched & t->head->lent;
        const line_names line = line_of(t, i);
        if (!lanes) continue;
        write_masses(t, n, line, lanes, 0);
        struck |= has_changed(t, n, line) & lanes;
        take_line(t->solver->velocity, line, n->held, lanes, n->light, n->spins);
        take_line(t->solver->start, line, n->held_start, lanes, n->light, n->spins);
    }
    t->head->lent = 0;
    return struck;
}
