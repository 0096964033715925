// tree_solver.simd.c - what trees do in each pass over the joints: requests, and their results. Trees of one form lie
// side by side, a lane each; see tree_solver.h. Compiled once per SIMD set.
#include "core/simd.h"
#include "solver/tree/tree_solver.h"
#include "solver/wide_body.h"

#include <string.h>

#include "solver/tree/real.inl"
#include "solver/tree/body_lanes.inl"
#include "solver/tree/node.inl"
#include "solver/tree/read_locks.inl"
#include "solver/tree/eliminate.inl"
#include "solver/tree/damping.inl"
#include "solver/tree/warm_start.inl"
#include "solver/tree/response.inl"
#include "solver/tree/articulated_mass.inl"
#include "solver/tree/angular_speed_limit.inl"

// A light tree is left to the sweep until an impact pulls a joint's points apart by more than this: four fifths of the
// linear slop, so that the slop is kept with something to spare, m
#define OPEN 0.004f
// What is farther apart when the step begins was put there, by the user or by continuous collision: it comes together
// softly, by sweeps
#define PUT_APART (2.0f * OPEN)
// Nobody put apart what whirls. But from so wide a gap even that comes together softly, m
#define TORN 1.0f
// A rotation, rad, beyond which an elimination says nothing of where an arm leads
#define FULL_TURN 0.25

// ---- requests -------------------------------------------------------------------------------------------------------
// of the body above, without changes
FE_INLINE velocity velocity_above(const pass *t, int32_t i)
{
    const tree_node *above = above_of(t, i);
    return above ? (velocity){above->v, above->w} : read_velocity(t, &t->nodes[i].line_above);
}

// a along what the joint locks
FE_INLINE real3 locked_along(const pass *t, int32_t i, real3 a)
{
    for (int k = 0; k < 3 && !is_ball(t, i); ++k)
        if (t->links[i].form >> k & 1) a = r_sub_scaled(a, r_dot(t->nodes[i].lin[k], a), t->nodes[i].lin[k]);
    return a;
}
FE_INLINE real3 locked_about(const pass *t, int32_t i, real3 a)
{
    if (is_ball(t, i)) return r_zero3();
    for (int k = 0; k < 3; ++k)
        if (t->links[i].form >> (3 + k) & 1) a = r_sub_scaled(a, r_dot(t->nodes[i].ang[k], a), t->nodes[i].ang[k]);
    return a;
}

FE_INLINE real3 minus3(real3 a) { return (real3){-a.x, -a.y, -a.z}; }

// of the joint's points, the one below against the one above
FE_INLINE real3 parting(const tree_node *n, velocity below, velocity above)
{
    return r_sub(r_add(below.v, r_cross(below.w, n->below)), r_add(above.v, r_cross(above.w, n->above)));
}

// The joint's parts move as one
FE_INLINE void request_rest(const pass *t, int32_t i)
{
    tree_node *n = t->nodes + i;
    solution *s = n->of + SPEEDS;
    const velocity above = velocity_above(t, i), below = read_velocity(t, &n->line);
    n->v = below.v, n->w = below.w;
    s->slip = r_sub(below.w, above.w);
    s->ask_v = n->rest = locked_along(t, i, minus3(parting(n, below, above)));
    s->ask_w = locked_about(t, i, minus3(s->slip));
    clear_load(s);
}

// Of the arcs of a rotation, by its square: beyond FE__SLOW_TURN they are left to the positions, which lose energy by
// it instead of gaining it
FE_INLINE real slow_share(real square)
{
    const double slow = FE__SLOW_TURN * FE__SLOW_TURN;
    if (!r_bits(r_greater(square, r_set(slow)))) return r_set(1.0);
    return r_min(r_max(2.0 - square / slow, r_set(0.0)), r_set(1.0));
}

// A point on an arm r leaves its tangent while the body turns: by integrate_positions' Q = Cayley(h w) it goes on by
//     (Q - 1) r - h w x r = 2/(1 + u^2) (u x r + u x (u x r)) - 2 u x r,   u = h w / 2
// The rotation about the arm itself leaves the point alone: u is at right angles to r, and with a = u x r that is
//     -2 a^2 / (r^2 + a^2) (a + r)
FE_INLINE real3 leave_tangent(real3 r, real3 w, real h)
{
    const real3 a = r_scale(0.5 * h, r_cross(w, r));
    const real turn = r_dot(a, a), arm = r_max(r_dot(r, r), r_set(DBL_MIN)), share = slow_share(4.0 * (turn / arm));
    return r_scale(share * (-2.0 * turn / (arm + turn)), r_add(a, r));
}

// A rod grows by the square of what its ends move across it
FE_INLINE real leave_rod(const tree_node *n, velocity below, velocity above, real h)
{
    const real3 u = n->lin[0];
    const real3 v = parting(n, below, above);
    const real along = r_dot(v, u), length = r_max(n->rod, r_set(DBL_MIN));
    // angle squared
    const real turn = h * h * (r_dot(v, v) - along * along) / (length * length);
    return r_choose(r_greater(n->rod, r_set(0.0)), slow_share(turn) * 0.5 * turn * n->rod, r_set(0.0));
}

FE_INLINE int32_t is_rod(const pass *t, int32_t i) { return t->links[i].form & FE__TREE_ROD; }

// Velocities with which the points meet after the substep, on the arcs of these
FE_INLINE void request_arcs(const pass *t, int32_t i, velocity below, velocity above, real rate)
{
    tree_node *n = t->nodes + i;
    const real3 off = r_sub(leave_tangent(n->below, below.w, t->h), leave_tangent(n->above, above.w, t->h));
    real3 ask = r_sub_scaled(n->rest, rate, locked_along(t, i, off));
    if (is_rod(t, i)) ask = r_sub_scaled(ask, rate * n->side * leave_rod(n, below, above, t->h), n->lin[0]);
    n->of[SPEEDS].ask_v = ask;
}

// At most so much of an error at once; what is more follows at that rate
FE_INLINE real share_of(real3 error, real most, double rate)
{
    const real square = r_dot(error, error);
    const real_mask far = r_greater(square, most * most);
    if (!r_bits(far)) return r_set(1.0);
    return r_choose(far, r_max(most / r_sqrt(square), r_set(rate)), r_set(1.0));
}

// Positions are put right at once, as far as FULL_TURN of the arms takes them; what is farther apart follows as fast as
// the softness of a lock says. Returns the lanes in which the gap is wide.
FE_INLINE int32_t request_closed(const pass *t, int32_t i)
{
    tree_node *n = t->nodes + i;
    solution *s = n->of + PLACES;
    const real arm = r_max(r_sqrt(r_max(r_dot(n->below, n->below), r_dot(n->above, n->above))), n->rod);
    s->ask_v = r_scale(-share_of(n->gap, FULL_TURN * arm, t->rate), n->gap);
    s->ask_w = r_zero3();
    if (!is_ball(t, i)) s->ask_w = r_scale(-share_of(n->swing, r_set(FULL_TURN), t->rate), n->swing);
    clear_load(s);
    return r_bits(r_greater(r_dot(n->gap, n->gap), r_set((double)OPEN * (double)OPEN)));
}

// ---- results --------------------------------------------------------------------------------------------------------
// to velocities and rows; with `total` the impulses count in the sums over the step. Returns the lanes in which a body
// turns fast.
static int32_t apply(const pass *t, int32_t lanes, int32_t total)
{
    const int32_t kept = lanes | (ALL_LANES & ~t->lanes);
    int32_t fast = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const velocity now = changed(n);
        const real3 turn = r_scale(t->h, now.w);
        lines l = {.a = {[3] = n->inverse_mass, [7] = n->locks}};
        narrow3(l.a, now.v), narrow3(l.a + 4, now.w);
        write_lines(t->solver->velocity, &n->line, lanes, &l);
        fast |= r_bits(r_greater(r_dot(turn, turn), r_set(FE__SLOW_TURN * FE__SLOW_TURN)));
        if (t->kind == FE__TREE_ROPE) {
            keep_rope(n, kept);
            if (total) forget_rope(t, n, kept);
            continue;
        }
        forget_damping(t, i, lanes);
        if (is_ball(t, i)) add_to_point(t, n, lanes, total);
        for (int lane = 0; lane < LANES && !is_ball(t, i); ++lane)
            if (lanes >> lane & 1) add_impulses(t, i, lane, total);
    }
    return fast & lanes;
}

// dp += u, dq = normalize(dq + (w, 0) dq / 2), as a whole no farther than FULL_TURN
static void move(const pass *t, int32_t lanes)
{
    real farthest = r_set(FULL_TURN * FULL_TURN);
    for (int32_t i = 0; i < t->count; ++i) {
        const real3 turn = t->nodes[i].of[PLACES].change_w;
        farthest = r_max(farthest, r_dot(turn, turn));
    }
    const real scale = FULL_TURN / r_sqrt(farthest);
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        lines l = read_lines(t->solver->motion, &n->line);
        const real3 v = widen3(l.a + 4), half_turn = r_scale(0.5 * scale, n->of[PLACES].change_w);
        const real w = r_widen(l.a[7]);
        const real3 b = r_add(r_add_scaled(v, w, half_turn), r_cross(half_turn, v));
        const real a = w - r_dot(half_turn, v), k = 1.0 / r_sqrt(a * a + r_dot(b, b));
        narrow3(l.a, r_add_scaled(widen3(l.a), scale, centre_change(n, PLACES)));
        narrow3(l.a + 4, r_scale(k, b)), l.a[7] = narrow(k * a);
        write_lines(t->solver->motion, &n->line, lanes, &l);
    }
}

// ---- solutions ------------------------------------------------------------------------------------------------------
// Passes go from link to link, and do at each all that can be done there: nodes are large, and each waits for the one
// before it.

FE_INLINE int32_t reduce_lanes(const pass *t, int32_t lanes, int32_t apart, int solves)
{
    const real_mask these = r_mask(lanes);
    int32_t wide_open = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        read_node(t, i, lanes, apart);
        lay_masses(t, i);
        add_tension(t, i, t->nodes[i].pull);
        if (!solves) continue;
        request_rest(t, i);
        wide_open |= request_closed(t, i);
    }
    for (int32_t i = t->count - 1; i >= 0; --i) {
        add_damping(t, i, t->nodes[i].pull, these);
        eliminate_joint(t, i);
        if (solves) hand_up(t, i, SPEEDS), hand_up(t, i, PLACES);
    }
    return wide_open;
}

// In the given lanes. What others have stays as it is, bit for bit: it is eliminated again to the same matrices. With
// `solves`, both solutions are requested and handed up. Returns the lanes in which a gap is wide.
FE_INLINE int32_t reduce(const pass *t, int32_t lanes, int solves)
{
    load_bundle(t);
    const int32_t with_idle = lanes | (ALL_LANES & ~t->lanes);
    return with_idle == ALL_LANES ? reduce_lanes(t, ALL_LANES, lanes, solves)
                                  : reduce_lanes(t, with_idle, lanes, solves);
}

// The first solution shows the arcs, the second follows them
static void follow_arcs(const pass *t)
{
    const real rate = 1.0 / t->h;
    for (int32_t i = 0; i < t->count; ++i) {
        request_rest(t, i);
        request_arcs(t, i, (velocity){t->nodes[i].v, t->nodes[i].w}, velocity_above(t, i), rate);
    }
    for (int32_t i = t->count - 1; i >= 0; --i) hand_up(t, i, SPEEDS);
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *above = above_of(t, i);
        hand_down(t, i, SPEEDS, 0);
        request_arcs(t, i, changed(t->nodes + i), above ? changed(above) : velocity_above(t, i), rate);
        clear_load(t->nodes[i].of + SPEEDS);
    }
    for (int32_t i = t->count - 1; i >= 0; --i) hand_up(t, i, SPEEDS);
    for (int32_t i = 0; i < t->count; ++i) {
        hand_down(t, i, SPEEDS, 1);
        add_tension(t, i, pull_now(t->nodes + i));
    }
}

// What goes taut is damped for what it bears now, and solved again. Others ask for what they asked, and get it.
// Returns the lanes in which something did.
static int32_t damp_jerk(const pass *t, int32_t lanes)
{
    lanes &= jerked(t);
    if (!lanes) return 0;
    const real_mask these = r_mask(lanes);
    for (int32_t i = 0; i < t->count; ++i) {
        solution *s = t->nodes[i].of + SPEEDS;
        lay_masses(t, i);
        s->ask_v = r_choose3(these, t->nodes[i].rest, s->ask_v);
        clear_load(s);
    }
    for (int32_t i = t->count - 1; i >= 0; --i) {
        add_damping(t, i, pull_now(t->nodes + i), these);
        eliminate_joint(t, i);
    }
    meet_requests(t, SPEEDS);
    return lanes;
}

// Gaps are closed again where one was wide, as the joints now see them: closing it turned the joints
static void close_gaps(const pass *t, int32_t lanes, int32_t wide_open)
{
    enum { MOST_CLOSINGS = 8 };
    move(t, lanes);
    for (int32_t k = 1; k < MOST_CLOSINGS; ++k) {
        lanes &= wide_open;
        if (!lanes) return;
        wide_open = reduce(t, lanes, 0);
        for (int32_t i = 0; i < t->count; ++i) wide_open |= request_closed(t, i);
        meet_requests(t, PLACES);
        move(t, lanes);
    }
}

// Velocities along the locks as they are after the motion, and positions that close them: both of the same matrices
static void meet_locks(const pass *t, int32_t lanes)
{
    const int32_t wide_open = reduce(t, t->head->loaded ? lanes : ALL_LANES, 1);
    for (int32_t i = 0; i < t->count; ++i) {
        hand_down(t, i, SPEEDS, 1);
        hand_down(t, i, PLACES, 0);
        add_tension(t, i, pull_now(t->nodes + i));
    }
    if (damp_jerk(t, lanes)) { // the matrices are others
        for (int32_t i = 0; i < t->count; ++i) clear_load(t->nodes[i].of + PLACES);
        meet_requests(t, PLACES);
    }
    const int32_t fast = apply(t, lanes, 1);
    if (t->kind == FE__TREE_SHORT || t->kind == FE__TREE_HEAVY)
        forget_locks(t, t->kind == FE__TREE_SHORT ? lanes : fast);
    calm(t, fast);
    close_gaps(t, lanes, wide_open);
}

// ---- passes ---------------------------------------------------------------------------------------------------------
static pass pass_of(const fe__tree_job *job)
{
    const fe__forest *f = &job->of[job->trees->home].joints.forest;
    const fe__joint_tree *first = f->trees + job->trees->tree;
    pass t = {.job = job,
              .solver = job->solver,
              .links = f->links + first->first,
              .count = first->count,
              .kind = first->kind,
              .locks = first->locks,
              .lanes = (1 << job->count) - 1,
              .head = (bundle *)(void *)job->nodes,
              .nodes = (tree_node *)(void *)(job->nodes + sizeof(bundle)),
              .h = r_set(job->h),
              .rate = job->rate};
    for (int lane = 0; lane < LANES; ++lane) {
        const fe__tree_name *tree = job->trees + (lane < job->count ? lane : 0);
        const fe__records *of = t.of[lane] = job->of + tree->home;
        const int32_t at = of->joints.forest.trees[tree->tree].first;
        t.places[lane] = job->solver->places + of->first_place + at, t.links_of[lane] = of->joints.forest.links + at;
    }
    return t;
}

// the lanes in a state
static int32_t lanes_in(const pass *t, tree_state state)
{
    int32_t lanes = 0;
    for (int lane = 0; lane < LANES; ++lane) lanes |= (t->head->state[lane] == (int32_t)state) << lane;
    return lanes & t->lanes;
}

// From here to the end of the step these light trees are solved. Nodes that a tree beside them had read forget it.
static void engage(const pass *t, int32_t lanes)
{
    lanes &= lanes_in(t, READY);
    if (!lanes) return;
    if (t->head->loaded) face_first(t, lanes);
    for (int lane = 0; lane < LANES; ++lane) {
        if (!(lanes >> lane & 1)) continue;
        t->head->state[lane] = SOLVED;
        atomic_fetch_add_explicit(t->of[lane]->engaged, 1, memory_order_relaxed);
    }
}

static int32_t is_open(const pass *t, int lane, float gap)
{
    for (const fe__tree_place *p = t->places[lane], *end = p + t->count; p < end; ++p)
        for (int32_t k = 0; k < p->locks; ++k)
            if (p->lock[k].of->gap(p->lock[k].part, t->job->rows + p->lock[k].row, p->lock[k].lane) > gap * gap)
                return 1;
    return 0;
}

// Of trees that were solved, the lanes in which a joint's points come apart as fast as `will_open` says
static int32_t come_apart(const pass *t)
{
    const real fast = OPEN / t->h, square = fast * fast;
    int32_t lanes = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const velocity above = velocity_above(t, i), below = read_velocity(t, &n->line);
        n->v = below.v, n->w = below.w;
        const real3 along = locked_along(t, i, parting(n, below, above));
        lanes |= r_bits(r_greater(r_dot(along, along), square));
    }
    return lanes;
}

// by the velocities as they are
static int32_t will_open(const pass *t, int lane)
{
    const float speed = OPEN / (float)t->job->h;
    for (int32_t i = 0; i < t->count; ++i) {
        const fe__tree_place *p = t->places[lane] + i;
        const fe__velocity_line *below = t->solver->velocity + p->line, *above = t->solver->velocity + p->parent_line;
        const int32_t b = t->links_of[lane][i].holds_b;
        for (int32_t k = 0; k < p->locks; ++k)
            if (p->lock[k].of->speed(p->lock[k].part, t->job->rows + p->lock[k].row, p->lock[k].lane, b ? above : below,
                                     b ? below : above) > speed * speed)
                return 1;
    }
    return 0;
}

// The lanes whose links contacts see with the masses of their trees
static void find_lenders(const pass *t)
{
    if (is_root(t, 0) && find_touched(t)) t->head->lends = find_shares(t) & t->lanes;
}

// A link turns farther in a substep than an elimination follows
static int32_t whirls(const pass *t, int lane)
{
    for (int32_t i = 0; i < t->count; ++i) {
        const float *spin = t->solver->start[t->places[lane][i].line].w;
        const fe_dvec3 turn = fe__dscale(t->job->h, fe__widen(fe__vec3(spin[0], spin[1], spin[2])));
        if (fe__ddot(turn, turn) > FULL_TURN * FULL_TURN) return 1;
    }
    return 0;
}

static tree_state first_state(const pass *t, int lane)
{
    if (t->kind != FE__TREE_LIGHT) return SOLVED;
    return is_open(t, lane, whirls(t, lane) ? TORN : PUT_APART) ? SWEPT : READY;
}

static void prepare_trees(const fe__tree_job *job)
{
    const pass t = pass_of(job);
    t.head->loaded = 0;
    for (int lane = 0; lane < LANES; ++lane)
        t.head->state[lane] = lane < job->count ? (int32_t)first_state(&t, lane) : (int32_t)READY;
    t.head->lends = t.head->lent = 0;
    if (t.kind != FE__TREE_LIGHT) reduce(&t, ALL_LANES, 0);
    if (t.kind == FE__TREE_ROPE) drop_pulls(&t), t.head->touched = find_touched_trees(&t);
    if (t.kind == FE__TREE_HEAVY || t.kind == FE__TREE_SHORT) find_lenders(&t);
    lend(&t);
}

// Contacts ended their part before the first substep: what they warm-start
static void restore_trees(const fe__tree_job *job)
{
    if (!((const bundle *)(const void *)job->nodes)->lent) return;
    const pass t = pass_of(job);
    take_back(&t);
}

static void solve_lanes(const pass *t, int32_t lanes)
{
    follow_arcs(t);
    damp_jerk(t, lanes);
    apply(t, lanes, 0);
}

static void solve_trees(const fe__tree_job *job)
{
    const pass t = pass_of(job);
    const int32_t lanes = lanes_in(&t, SOLVED);
    if (lanes) solve_lanes(&t, lanes);
    lend(&t);
}

static void follow_trees(const fe__tree_job *job)
{
    const pass t = pass_of(job);
    const int32_t ready = lanes_in(&t, READY), struck = t.head->lent ? take_back(&t) : 0;
    int32_t lanes = ready | lanes_in(&t, SOLVED);
    for (int lane = 0; lane < LANES; ++lane)
        if (ready >> lane & 1 && !will_open(&t, lane)) lanes &= ~(1 << lane);
    if (t.kind == FE__TREE_ROPE) lanes &= t.head->touched; // nothing else came between
    if (lanes & ~ready) lanes &= ready | struck | come_apart(&t);
    if (!lanes) return;
    engage(&t, lanes);
    if (lanes & ready) reduce(&t, t.head->loaded ? lanes & ready : ALL_LANES, 0);
    solve_lanes(&t, lanes);
}

static void relax_trees(const fe__tree_job *job)
{
    const pass t = pass_of(job);
    const int32_t ready = lanes_in(&t, READY);
    int32_t lanes = ready | lanes_in(&t, SOLVED);
    for (int lane = 0; lane < LANES; ++lane)
        if (ready >> lane & 1 && !is_open(&t, lane, OPEN)) lanes &= ~(1 << lane);
    if (!lanes) return;
    engage(&t, lanes);
    meet_locks(&t, lanes);
    lend(&t);
}

// What contacts and their bounces gave goes through the tree
static void receive_trees(const fe__tree_job *job)
{
    if (!((const bundle *)(const void *)job->nodes)->lent) return;
    const pass t = pass_of(job);
    const int32_t lanes = take_back(&t);
    if (!lanes) return;
    for (int32_t i = 0; i < t.count; ++i) request_rest(&t, i);
    meet_requests(&t, SPEEDS);
    for (int32_t i = 0; i < t.count; ++i) add_tension(&t, i, pull_now(t.nodes + i));
    damp_jerk(&t, lanes);
    const int32_t fast = apply(&t, lanes, 1);
    forget_locks(&t, t.kind == FE__TREE_SHORT ? lanes : fast);
    calm(&t, fast);
}

FE_INLINE void put_quad(float *to, fe_dvec3 a)
{
    to[0] = (float)a.x, to[1] = (float)a.y, to[2] = (float)a.z, to[3] = 0.0f;
}

// What the store of rows does for other joints
static void store_trees(const fe__tree_job *job)
{
    const pass t = pass_of(job);
    if (t.kind != FE__TREE_ROPE) return;
    for (int32_t i = is_root(&t, 0); i < t.count; ++i) {
        const tree_node *n = t.nodes + i;
        const real3 force = r_scale(job->mean * n->side, n->total), last = r_scale(job->stored * n->side, n->last);
        const int32_t open = r_bits(r_greater(r_dot(n->gap, n->gap), r_set(job->open)));
        for (int lane = 0; lane < job->count; ++lane) {
            const int32_t joint = t.links_of[lane][i].joint;
            put_quad(t.of[lane]->joints.reactions[joint].force, get_lane3(&force, lane));
            put_quad(t.of[lane]->joints.joints[joint].impulse, get_lane3(&last, lane));
            if (open >> lane & 1) mark_stretched_ends(t.solver, n->line.at[lane], n->line_above.at[lane]);
        }
    }
}

const fe__forest_kernels FE_NAME(fe__forest_kernels) = {LANES,
                                                        (int32_t)sizeof(bundle),
                                                        (int32_t)sizeof(tree_node),
                                                        prepare_trees,
                                                        restore_trees,
                                                        solve_trees,
                                                        follow_trees,
                                                        relax_trees,
                                                        receive_trees,
                                                        store_trees};
