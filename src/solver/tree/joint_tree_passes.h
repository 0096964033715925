// joint_tree_passes.h - what a tree does in each pass over the joints: wishes, and what comes of them. Part of joint.simd.c.

// ---- wishes ---------------------------------------------------------------------------------------------------------------------------
// J v = 0
static void wish_still(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const fe__velocity_line *below = below_of(t, i), *above = above_of(t, i);
        for (int r = 0; r < n->rows.count; ++r) {
            const double *b = n->rows.below[r], *a = n->rows.above[r];
            n->wish[r] = 0.0;
            for (int k = 0; k < 3; ++k) {
                n->wish[r] -= b[k] * (double)below->v[k] + b[3 + k] * (double)below->w[k];
                n->wish[r] -= a[k] * (double)above->v[k] + a[3 + k] * (double)above->w[k];
            }
        }
    }
}

typedef struct {
    fe_dvec3 v, w;
} motion_of_body;

// with the change at hand
static motion_of_body moving(const fe__velocity_line *line, const double *change)
{
    static const double none[6] = {0};
    const double *u = change ? change : none;
    return (motion_of_body){{(double)line->v[0] + u[0], (double)line->v[1] + u[1], (double)line->v[2] + u[2]},
                            {(double)line->w[0] + u[3], (double)line->w[1] + u[4], (double)line->w[2] + u[5]}};
}

// Of what a turn does to arcs, by its square: beyond SLOW_TURN it is left to the positions, which lose energy by it instead of gaining it
static double slow_share(double square) { return fe__mind(fe__maxd(2.0 - square / (SLOW_TURN * SLOW_TURN), 0.0), 1.0); }

// A point on an arm r leaves its tangent while the body turns: by integrate_positions' Q = Cayley(h w) it goes on by
//     (Q - 1) r - h w x r = 2/(1 + u^2) (u x r + u x (u x r)) - 2 u x r,   u = h w / 2
// The turn about the arm itself leaves the point alone.
static fe_dvec3 leave_tangent(fe_dvec3 r, fe_dvec3 w, double h)
{
    double square = fe__ddot(r, r), along = square > 0.0 ? fe__ddot(w, r) / square : 0.0;
    fe_dvec3 u = fe__dscale(0.5 * h, fe__dadd(w, fe__dscale(-along, r))), a = fe__dcross(u, r);
    double k = 2.0 / (1.0 + fe__ddot(u, u));
    return fe__dscale(slow_share(4.0 * fe__ddot(u, u)), fe__dadd(fe__dscale(k - 2.0, a), fe__dscale(k, fe__dcross(u, a))));
}

// A rod grows by the square of what its ends move across it
static double leave_rod(const tree_rows *rows, const motion_of_body *below, const motion_of_body *above, double h)
{
    fe_dvec3 u = vec_of(rows->below[0]);
    fe_dvec3 v = fe__dsub(fe__dadd(below->v, fe__dcross(below->w, rows->arm[0])), fe__dadd(above->v, fe__dcross(above->w, rows->arm[1])));
    double along = fe__ddot(v, u), turn = h * h * (fe__ddot(v, v) - along * along) / (rows->rod * rows->rod); // angle squared
    return slow_share(turn) * 0.5 * turn * rows->rod;
}

// Velocities with which the points meet after the substep, on the arcs of the velocities at hand
static void wish_on_arcs(const tree_job *t)
{
    wish_still(t);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        motion_of_body below = moving(below_of(t, i), n->change),
                       above = moving(above_of(t, i), parent_of(t, i) ? parent_of(t, i)->change : NULL);
        fe_dvec3 off_below = leave_tangent(n->rows.arm[0], below.w, t->h), off_above = leave_tangent(n->rows.arm[1], above.w, t->h);
        for (int r = 0; r < n->locks; ++r)
            n->wish[r] -= (fe__ddot(vec_of(n->rows.below[r]), off_below) + fe__ddot(vec_of(n->rows.above[r]), off_above)) / t->h;
        if (n->rows.rod > 0.0) n->wish[0] -= leave_rod(&n->rows, &below, &above, t->h) / t->h;
    }
}

// Positions are put right at once, as far as a quarter of a turn of the arms takes them; what is farther apart follows as fast as the
// softness of a lock says, by `share` of it. Returns the largest gap, m.
#define FULL_TURN 0.25 // rad

static double wish_closed(const tree_job *t, double share)
{
    double widest = 0.0;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        double arm = sqrt(fe__maxd(fe__ddot(n->rows.arm[0], n->rows.arm[0]), fe__ddot(n->rows.arm[1], n->rows.arm[1])));
        double gap = 0.0;
        arm = fe__maxd(arm, n->rows.rod);
        for (int r = 0; r < n->rows.count; ++r) {
            int point = n->rows.points >> r & 1;
            double error = n->rows.error[r], most = fe__maxd(FULL_TURN * (point ? arm : 1.0), share * fe__absd(error));
            n->wish[r] = fe__mind(fe__maxd(-error, -most), most);
            gap += point ? error * error : 0.0;
        }
        widest = fe__maxd(widest, gap);
    }
    return sqrt(widest);
}

// ---- what comes of them ---------------------------------------------------------------------------------------------------------------
// no warm start shall repeat what calms
static void forget_calm(const tree_job *t, int32_t i)
{
    const tree_node *n = t->nodes + i, *parent = parent_of(t, i);
    const double *l = n->impulse + n->locks;
    if (n->rows.count == n->locks) return;
    fe_dvec3 below = fe__dscale(t->links[i].holds_b ? 1.0 : -1.0, vec_of(l));
    add_spin(t->s->start[t->places[i].line].w, n->turn, below);
    if (parent) add_spin(t->s->start[t->places[i].parent_line].w, parent->turn, fe__dscale(-1.0, below));
}

static void apply(const tree_job *t, int total)
{
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const fe__tree_place *p = t->places + i;
        fe__velocity_line *line = t->s->velocity + p->line;
        for (int k = 0; k < 3; ++k) {
            line->v[k] = (float)((double)line->v[k] + n->change[k]);
            line->w[k] = (float)((double)line->w[k] + n->change[3 + k]);
        }
        forget_calm(t, i);
        for (int32_t k = 0, first = 0; k < p->locks; ++k)
            first += write_lock(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, n->impulse + first, total);
    }
}

// dp += u, dq = normalize(dq + (w, 0) dq / 2). As a whole no farther than FULL_TURN: rows know no more of where a turn leads
static void move(const tree_job *t)
{
    double farthest = FULL_TURN * FULL_TURN;
    for (int32_t i = 0; i < t->count; ++i)
        farthest = fe__maxd(farthest, fe__ddot(vec_of(t->nodes[i].change + 3), vec_of(t->nodes[i].change + 3)));
    double scale = FULL_TURN / sqrt(farthest);
    for (int32_t i = 0; i < t->count; ++i) {
        fe__motion_line *line = t->s->motion + t->places[i].line;
        float *q = line->rotation;
        const double *u = t->nodes[i].change, w = (double)q[3];
        fe_dvec3 half = fe__dscale(0.5 * scale, vec_of(u + 3)), v = {(double)q[0], (double)q[1], (double)q[2]};
        fe_dvec3 b = fe__dadd(fe__dadd(v, fe__dscale(w, half)), fe__dcross(half, v));
        double a = w - fe__ddot(half, v), k = 1.0 / sqrt(a * a + fe__ddot(b, b));
        for (int c = 0; c < 3; ++c) line->shift[c] = (float)((double)line->shift[c] + scale * u[c]);
        q[0] = (float)(k * b.x), q[1] = (float)(k * b.y), q[2] = (float)(k * b.z), q[3] = (float)(k * a);
    }
}

// ---- the passes -----------------------------------------------------------------------------------------------------------------------
static void reduce_tree(const tree_job *t)
{
    read_tree(t);
    calm_tree(t);
    eliminate(t);
}

// From here to the end of the step a light tree is solved
static void engage(const tree_job *t)
{
    if (t->nodes->state == SOLVED) return;
    t->nodes->state = SOLVED;
    atomic_fetch_add_explicit(&t->s->engaged, 1, memory_order_relaxed);
}

static void prepare_tree(fe__solver *s, const fe__joints *joints, int32_t tree, unsigned char *rows, int64_t nodes,
                         const fe__step_constants *c)
{
    tree_job t = tree_of(s, joints, tree, rows, nodes, c);
    t.nodes->state = joints->forest.trees[tree].heavy ? SOLVED : is_open(&t, PUT_APART) ? SWEPT : READY;
    if (t.nodes->state == SOLVED) reduce_tree(&t);
}

// The first solution tells the arcs, the second follows them
static void follow_arcs(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) memset(t->nodes[i].change, 0, sizeof t->nodes[i].change);
    for (int k = 0; k < 2; ++k) {
        wish_on_arcs(t);
        meet(t);
    }
}

static void follow_locks(const tree_job *t)
{
    wish_still(t);
    meet(t);
}

static void calm_jerk(const tree_job *t)
{
    read_tree(t);
    add_pulls(t);
    calm_tree(t);
    eliminate(t);
}

static void solve_tree(fe__solver *s, const fe__joints *joints, int32_t tree, unsigned char *rows, int64_t nodes,
                       const fe__step_constants *c)
{
    tree_job t = tree_of(s, joints, tree, rows, nodes, c);
    if (t.nodes->state != SOLVED) return;
    follow_arcs(&t);
    if (is_jerked(&t)) {
        calm_jerk(&t);
        follow_locks(&t);
    }
    apply(&t, 0);
}

// Contacts come after the joints in a pass and know nothing of them: what was struck or pinched flies off, unless its tree ends the pass.
static void follow_tree(fe__solver *s, const fe__joints *joints, int32_t tree, unsigned char *rows, int64_t nodes,
                        const fe__step_constants *c)
{
    tree_job t = tree_of(s, joints, tree, rows, nodes, c);
    if (t.nodes->state == SWEPT || !will_open(&t)) return;
    if (t.nodes->state == READY) reduce_tree(&t);
    engage(&t);
    solve_tree(s, joints, tree, rows, nodes, c);
}

// The way is closed as the rows see it, and again where that was a wide one, which turns them
static void close_points(const tree_job *t, const fe__step_constants *c)
{
    enum { MOST_CLOSINGS = 8 };
    for (int32_t k = 0; k < MOST_CLOSINGS; ++k) {
        double widest = wish_closed(t, (double)(c->h * c->joint.bias_rate));
        meet(t);
        move(t);
        if (widest <= (double)OPEN) return;
        reduce_tree(t);
    }
}

static void relax_tree(fe__solver *s, const fe__joints *joints, int32_t tree, unsigned char *rows, int64_t nodes,
                       const fe__step_constants *c)
{
    tree_job t = tree_of(s, joints, tree, rows, nodes, c);
    if (t.nodes->state == SWEPT || (t.nodes->state == READY && !is_open(&t, OPEN))) return;
    engage(&t);
    reduce_tree(&t);
    follow_locks(&t);
    if (is_jerked(&t)) {
        calm_jerk(&t);
        follow_locks(&t);
    }
    apply(&t, 1);
    if (joints->forest.trees[tree].heavy) forget_locks(&t);
    close_points(&t, c);
}
