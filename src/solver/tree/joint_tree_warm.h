// joint_tree_warm.h - heavy trees that turn fast begin a substep without the impulses of the last. Part of joint.simd.c.
//
// A warm start guesses that a lock pulls as it did. Where it turns by much within a substep that is wrong, and after an impact by far:
// relax turns J^T l with the arms, so that a light link on a long arm begins with velocities of the order of l M^-1 l, of ten thousand
// times the energy that the tree has. The tree takes them back along J exactly, but limits, contacts and what the sweep does first have
// seen them, and make motion of them. The tree itself needs no guess: with u = M^-1 J^T l it solves J (v + u) = wish, from which any part
// of v that J^T spans drops out. So `start`, which the next warm start is v less of (bodies.simd.c), takes all that the locks gave:
//     start += M^-1 J^T l,   l = 0
// All locks of the tree or none: one that is kept pulls at links whose others no longer answer it.

static int take_lanes(wide *impulse, int32_t i, int count, double *l)
{
    for (int k = 0; k < count; ++k) {
        l[k] = (double)impulse[k][i];
        impulse[k][i] = 0.0f;
    }
    return count;
}

static int take_slide(slide_row *row, int32_t i, double *l)
{
    int taken = 0;
    for (int k = 0; k < 3; ++k)
        if (row->keep[k][i] > 0.0f) taken += take_lanes(row->impulse + k, i, 1, l + taken);
    return taken;
}

// the impulses of a lock in l, in the order of its rows, and none in the lane; how many
static int take_lock(int32_t part, void *row, int32_t lane, double *l)
{
    switch (part) {
    case FE__PART_POINT:
        return take_lanes(((point_row *)row)->impulse, lane, 3, l);
    case FE__PART_FIXED:
        return take_lanes(((fixed_row *)row)->impulse, lane, 3, l);
    case FE__PART_SLIDE:
        return take_slide(row, lane, l);
    case FE__PART_HINGE:
        return take_lanes(((hinge_row *)row)->impulse, lane, 2, l);
    default:
        return take_lanes(&((linear_row *)row)->f.under, lane, 1, l);
    }
}

static int turns_fast(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe_dvec3 turn = fe__dscale(t->h, fe__widen(fe__quad_vector(below_of(t, i)->w)));
        if (fe__ddot(turn, turn) > SLOW_TURN * SLOW_TURN) return 1;
    }
    return 0;
}

// J^T l of one side to where its body started from
static void owe_side(const tree_node *n, const double turn[6], fe__start_line *start, double inverse_mass, double (*rows)[6],
                     const double *l)
{
    double sum[6] = {0};
    for (int r = 0; r < n->locks; ++r)
        for (int k = 0; k < 6; ++k) sum[k] += l[r] * rows[r][k];
    for (int k = 0; k < 3; ++k) start->v[k] = (float)((double)start->v[k] + inverse_mass * sum[k]);
    add_spin(start->w, turn, vec_of(sum + 3));
}

// The rows are those of the pose that relax turned the sweep's to. No pulls are left that a jerk would be measured against (is_jerked)
static void forget_locks(const tree_job *t)
{
    if (!turns_fast(t)) return;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const fe__tree_place *p = t->places + i;
        double l[TREE_ROWS] = {0};
        for (int32_t k = 0, first = 0; k < p->locks; ++k)
            first += take_lock(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, l + first);
        owe_side(n, n->turn, t->s->start + p->line, (double)below_of(t, i)->inverse_mass, n->rows.below, l);
        if (parent_of(t, i))
            owe_side(n, parent_of(t, i)->turn, t->s->start + p->parent_line, (double)above_of(t, i)->inverse_mass, n->rows.above, l);
        n->rows.pull = (fe_dvec3){0.0, 0.0, 0.0};
    }
}
