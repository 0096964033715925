// warm_start.inl - impulses to the rows of the locks and back; heavy trees that turn fast begin a substep without those
// of the last. Part of tree_solver.simd.c.
//
// A warm start guesses that a lock pulls as it did. Where it turns by much within a substep that is wrong, and after an
// impact by far: relax turns J^T l with the arms, so that a light link on a long arm begins with velocities of the
// order of l M^-1 l, of ten thousand times the energy that the tree has. The tree takes them back along J exactly, but
// limits, contacts and the sweep itself have seen them, and make motion of them. The tree needs no guess: with u = M^-1
// J^T l it solves J (v + u) = request, from which any part of v that J^T spans drops out. So `start`, which the next
// warm start is v less of (bodies.simd.c), takes all that the locks gave:
//     start += M^-1 J^T l,   l = 0
// All locks of the tree or none: one that is kept pulls at links whose others no longer balance it.
//
// A short tree forgets in every substep. Velocities are floats, so that v less `start` holds a rounding of v, which
// would push the body again and again, where the tree lets it: n substeps would make n^1.5 roundings of one. Nothing
// takes that from a mechanism of locks alone. What else bears on a body is far more than a rounding.

// ---- between the impulse of a joint on B, in world axes, and those of a lock's rows ---------------------------------
typedef struct wrench {
    fe_dvec3 v, w;
} wrench;

// the axes of a lock's rows, and how many: those of world axes are the unit ones
static int32_t row_axes(const pass *t, int32_t i, int lane, int32_t part, fe_dvec3 *axis)
{
    const tree_node *n = t->nodes + i;
    const int32_t form = t->links[i].form;
    int32_t count = 0;
    if (part == FE__PART_DISTANCE) axis[count++] = get_lane3(n->lin, lane);
    if (part == FE__PART_HINGE)
        axis[count++] = get_lane3(n->ang + 1, lane), axis[count++] = get_lane3(n->ang + 2, lane);
    for (int k = 0; k < 3 && part == FE__PART_SLIDE; ++k)
        if (!(form >> k & 1)) axis[count++] = get_lane3(n->lin + k, lane);
    for (int k = 0; k < 3 && (part == FE__PART_POINT || part == FE__PART_FIXED); ++k) axis[count++] = unit(k);
    return count;
}

static int32_t is_rotation(int32_t part) { return part == FE__PART_HINGE || part == FE__PART_FIXED; }

// with `total` the impulses count in the sums over the step
static void add_impulses(const pass *t, int32_t i, int lane, int32_t total)
{
    const tree_node *n = t->nodes + i;
    const fe__tree_place *p = t->places[lane] + i;
    const double sign = t->links_of[lane][i].holds_b ? 1.0 : -1.0;
    const wrench on_b = {fe__dscale(sign, get_lane3(&n->impulse_v, lane)),
                         fe__dscale(sign, get_lane3(&n->impulse_w, lane))};
    for (int32_t k = 0; k < p->locks; ++k) {
        double l[3];
        fe_dvec3 axis[3];
        const int32_t count = row_axes(t, i, lane, p->lock[k].part, axis);
        for (int32_t r = 0; r < count; ++r)
            l[r] = 0.0 + fe__ddot(axis[r], is_rotation(p->lock[k].part) ? on_b.w : on_b.v);
        p->lock[k].of->add(p->lock[k].part, t->job->rows + p->lock[k].row, p->lock[k].lane, l, total);
    }
}

// what the rows hold on the body below, which hold nothing afterwards
static wrench take_impulses(const pass *t, int32_t i, int lane)
{
    const fe__tree_place *p = t->places[lane] + i;
    const double sign = t->links_of[lane][i].holds_b ? 1.0 : -1.0;
    wrench sum = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    for (int32_t k = 0; k < p->locks; ++k) {
        double l[3];
        fe_dvec3 axis[3];
        const int32_t count = row_axes(t, i, lane, p->lock[k].part, axis);
        fe_dvec3 *to = is_rotation(p->lock[k].part) ? &sum.w : &sum.v;
        p->lock[k].of->take(p->lock[k].part, t->job->rows + p->lock[k].row, p->lock[k].lane, l);
        for (int32_t r = 0; r < count; ++r) *to = fe__dadd(*to, fe__dscale(sign * l[r], axis[r]));
    }
    return sum;
}

// ---- of a ball joint, all lanes at once -----------------------------------------------------------------------------
static void add_to_point(const pass *t, const tree_node *n, int32_t lanes, int32_t total)
{
    half l[3];
    narrow3(l, r_scale(n->side, n->impulse_v));
    for (int lane = 0; lane < LANES; ++lane) {
        if (!(lanes >> lane & 1)) continue;
        float *at = point_of(t, n, lane);
        const int32_t width = n->width[lane], sum = n->sum[lane];
        for (int k = 0; k < 3; ++k) at[k * width] += l[k][lane];
        for (int k = 0; k < 3 && total; ++k) at[sum + k * width] += l[k][lane];
    }
}

// in the given lanes: what a point on the body below got, and gets no more
static real3 take_from_point(const pass *t, const tree_node *n, int32_t lanes)
{
    const real3 l = r_choose3(r_mask(lanes), impulse_of_point(t, n), r_zero3());
    for (int lane = 0; lane < LANES; ++lane)
        for (int k = 0; k < 3 && lanes >> lane & 1; ++k) point_of(t, n, lane)[k * n->width[lane]] = 0.0f;
    return l;
}

// ---- fast trees -----------------------------------------------------------------------------------------------------
// Of a velocity: what is less is rounding, of which a sweep, a tree and a contact each leave 6e-8
#define ROUNDING 2e-6

// `start`, or the velocity itself where they differ by no more than rounding
FE_INLINE real3 settled(real3 start, real3 velocity)
{
    half v[3];
    narrow3(v, velocity);
    const real3 now = widen3(v), left = r_sub(now, start);
    return r_choose3(r_greater(r_dot(left, left), ROUNDING * ROUNDING * r_dot(now, now)), start, now);
}

FE_INLINE real3 unlocked3(real3 v, uint32_t locks)
{
    const real zero = r_set(0.0);
    return (real3){locks & 1 ? zero : v.x, locks & 2 ? zero : v.y, locks & 4 ? zero : v.z};
}

// The points are those of the pose that relax turned the sweep's to. No pulls are left that a jerk would be measured
// against.
static void forget_locks(const pass *t, int32_t lanes)
{
    if (!lanes) return;
    const real_mask these = r_mask(lanes);
    for (int32_t i = 0; i < t->count; ++i) clear_load(t->nodes[i].of + SPEEDS);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i, *above = above_of(t, i);
        real3 v = r_zero3(), w = v;
        if (is_ball(t, i)) v = take_from_point(t, n, lanes);
        for (int lane = 0; lane < LANES && !is_ball(t, i); ++lane) {
            if (!(lanes >> lane & 1)) continue;
            const wrench given = take_impulses(t, i, lane);
            set_lane3(&v, lane, given.v), set_lane3(&w, lane, given.w);
        }
        solution *s = n->of + SPEEDS;
        s->load_v = r_add(s->load_v, v), s->load_w = r_add(s->load_w, r_add(w, r_cross(n->below, v)));
        n->pull = r_choose3(these, r_zero3(), n->pull);
        if (!above) continue;
        s = above->of + SPEEDS;
        s->load_v = r_sub(s->load_v, v), s->load_w = r_sub(s->load_w, r_add(w, r_cross(n->above, v)));
    }
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const velocity now = changed(n);
        lines start = read_lines(t->solver->start, &n->line);
        const real3 by = unlocked3(r_scale(1.0 / n->mass, n->of[SPEEDS].load_v), t->locks),
                    spin = spin_of(n, n->of[SPEEDS].load_w);
        narrow3(start.a, settled(r_add(widen3(start.a), by), now.v));
        narrow3(start.a + 4, settled(r_add(widen3(start.a + 4), spin), now.w));
        write_lines(t->solver->start, &n->line, lanes, &start);
    }
}

// ---- ropes ----------------------------------------------------------------------------------------------------------
// No row holds what their joints bear, and no limit or motor pulls at their bodies: all that the locks give is what the
// solutions change of the velocities. Nodes add that up over a substep, and `start` takes it at its end.
FE_INLINE void keep_rope(tree_node *n, int32_t lanes)
{
    put3(&n->pull, lanes, r_add(n->pull, n->impulse_v));
    put3(&n->given_v, lanes, r_add(n->given_v, centre_change(n, SPEEDS)));
    put3(&n->given_w, lanes, r_add(n->given_w, n->of[SPEEDS].change_w));
}

// Those of the last step told what tension to expect, and nothing more
static void drop_pulls(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].pull = r_zero3();
}

FE_INLINE void forget_rope(const pass *t, tree_node *n, int32_t lanes)
{
    const velocity now = changed(n);
    lines start = read_lines(t->solver->start, &n->line);
    narrow3(start.a, settled(r_add(widen3(start.a), n->given_v), now.v));
    narrow3(start.a + 4, settled(r_add(widen3(start.a + 4), n->given_w), now.w));
    write_lines(t->solver->start, &n->line, lanes & t->lanes, &start);
    put3(&n->total, lanes, r_add(n->total, n->pull)), put3(&n->last, lanes, n->pull);
    put3(&n->pull, lanes, r_zero3()), put3(&n->given_v, lanes, r_zero3()), put3(&n->given_w, lanes, r_zero3());
}
