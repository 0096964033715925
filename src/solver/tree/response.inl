// response.inl - what the links of a tree make of forces on them: the masses that contacts push. Part of
// tree_solver.simd.c.
//
// A contact of a link pushes the whole tree. With G the response of the tree's velocities v to impulses on the links
// that contacts touch, impulses l that were found with inverse masses D instead give the energy
//     v.l + l.G l / 2  <=  v.l + l.D l / 2 = what the contacts know of
// as long as D - G has no negative eigenvalue: then passes that take energy by D take it by G too. The masses of the
// bodies alone are such a D, as no joint makes a body lighter; but with a wheel of 2 kg under a cart of 1000 each pass
// takes a five-hundredth of what comes down. Another is a multiple of the sizes of G's own blocks,
//     D = c A,   A_i = |G_ii|,   c the largest eigenvalue of A^-1/2 G A^-1/2
// i: translations, rotations of a touched link. c is 1 for one block, never above their number, found by powers (R. von
// Mises). Powers come from below, but what a pass takes is -l.D l + l.G l / 2 where it meets its contacts: at least
// half of c will do. Bodies that the tree makes little heavier, a cart with a load on it, keep their own masses; as
// (a + b)^2 <= 2 a^2 + 2 b^2, both kinds at once count as half as heavy.
//
// Contacts know bodies by one inverse mass and a tensor of their own for rotations. So |G_ii| of a translation is a
// number, a share of the body's own inverse mass, and that of a rotation is G_ii itself: a wheel spins about its axle
// as easily as ever, and a contact at the end of its width lifts the cart, not the wheel alone. What G_ii does not let
// rotate gets some of the body's own inverse inertia I^-1,
//     A_i = k (G_ii + e tr G_ii / tr I^-1 I^-1)
// as contacts keep A for the step, while its axes turn. An axle that leaves its place by an angle f shows g f^2 of its
// own response g across itself; with (a + b)^2 <= (1 + d) a^2 + (1 + 1/d) b^2 and 1 + d = FOR_TURNS, e = 4 f^2 will do.
//
// What c A is more than G, passes take longer. k weighs rotations against translations: the larger it is, the less c
// knows of them, and the more of a wheel's width counts.

// A tree lends where a touched link gets less than this share of its own inverse mass: what others lose is worth it
#define LENDS 0.5
// Links that are heavier by the tree: A is at most this share
#define HEAVIER 0.75
// What G may grow by while bodies turn within the step, and what powers may have missed
#define FOR_TURNS 1.25
// e, at least: of turns of 0.03 rad, and far above the rounding of what contacts leave in velocities
#define EVEN 1e-3
// k
#define ROTATIONS 12.0
// What is said beside a whole number is less than 1
#define MOST_PART 0.9375
#define POWERS 8
// With more touched links than these their masses stay their own: G takes time with each
#define MOST_TOUCHED 16

FE_INLINE real r_abs(real a) { return r_max(a, -a); }

// ---- who is touched -------------------------------------------------------------------------------------------------
// lanes
static int32_t touched_in(const pass *t, int32_t i)
{
    int32_t lanes = 0;
    for (int lane = 0; lane < t->job->count; ++lane) {
        const fe__body *body = t->of[lane]->bodies + t->links_of[lane][i].body;
        lanes |= (body->colours[0] | body->colours[1]) != 0 ? 1 << lane : 0;
    }
    return lanes;
}

// Returns the lanes in which links are, at most MOST_TOUCHED of them
static int32_t find_touched(const pass *t)
{
    int32_t count[LANES] = {0}, lanes = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        t->nodes[i].touched = touched_in(t, i), t->nodes[i].heavier = 0;
        for (int lane = 0; lane < LANES; ++lane) count[lane] += t->nodes[i].touched >> lane & 1;
    }
    for (int lane = 0; lane < LANES; ++lane) lanes |= (count[lane] > 0 && count[lane] <= MOST_TOUCHED) << lane;
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].touched &= lanes;
    return lanes;
}

// lanes
static int32_t find_touched_trees(const pass *t)
{
    int32_t lanes = 0;
    for (int32_t i = 0; i < t->count; ++i) lanes |= touched_in(t, i);
    return lanes;
}

// ---- responses ------------------------------------------------------------------------------------------------------
// What the freedoms of its own joint alone let a body's centre give, in shares of its inverse mass: no more than G does
FE_INLINE real own_share(const pass *t, int32_t i)
{
    const tree_node *n = t->nodes + i;
    real most = r_set(0.0);
    for (int k = 0; k < 3 && is_ball(t, i); ++k) {
        const real3 by = r_cross(ball_back(n->free, unit3(k)), n->below);
        most = r_max(most, n->free[k].g * r_dot(by, by));
    }
    for (int k = 0; k < FREEDOMS && !is_ball(t, i); ++k) {
        if (!(t->links[i].form >> k & 1)) continue;
        const real3 s = axis_of(n, k), by = k < 3 ? s : r_cross(s, n->below);
        return n->mass * n->free[k].g * r_dot(by, by);
    }
    return n->mass * most;
}

// L of L L^T, lower triangle
FE_INLINE real_sym root_of(const real_sym *i)
{
    const real zero = r_set(0.0);
    real_sym l;
    l.xx = r_sqrt(r_max(i->xx, zero));
    l.xy = i->xy * inverse_or_zero(l.xx), l.xz = i->xz * inverse_or_zero(l.xx);
    l.yy = r_sqrt(r_max(i->yy - l.xy * l.xy, zero));
    l.yz = (i->yz - l.xy * l.xz) * inverse_or_zero(l.yy);
    l.zz = r_sqrt(r_max(i->zz - l.xz * l.xz - l.yz * l.yz, zero));
    return l;
}

// L^-1 a, and L^-T a
FE_INLINE real3 solve_root(const real_sym *l, real3 a)
{
    const real x = a.x * inverse_or_zero(l->xx), y = (a.y - l->xy * x) * inverse_or_zero(l->yy);
    return (real3){x, y, (a.z - l->xz * x - l->yz * y) * inverse_or_zero(l->zz)};
}
FE_INLINE real3 solve_root_back(const real_sym *l, real3 a)
{
    const real z = a.z * inverse_or_zero(l->zz), y = (a.y - l->yz * z) * inverse_or_zero(l->yy);
    return (real3){(a.x - l->xy * y - l->xz * z) * inverse_or_zero(l->xx), y, z};
}

// Velocities of a touched link
FE_INLINE six answer_of(const tree_node *n)
{
    const real3 v = centre_change(n, PLACES), w = n->of[PLACES].change_w;
    return (six){{v.x, v.y, v.z, w.x, w.y, w.z}};
}

FE_INLINE void clear_loads(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) clear_load(t->nodes[i].of + PLACES);
}

// a load on the centre, which is at -below
FE_INLINE void load_link(tree_node *n, const six *a)
{
    const real3 f = {a->a[0], a->a[1], a->a[2]}, torque = {a->a[3], a->a[4], a->a[5]};
    n->of[PLACES].load_v = f;
    n->of[PLACES].load_w = r_add(r_cross(f, n->below), torque);
}

// |A| of a symmetric block by the sums of its rows
FE_INLINE real size_of(const six *g)
{
    real most = r_set(0.0);
    for (int r = 0; r < 3; ++r) most = r_max(most, r_abs(g[0].a[r]) + r_abs(g[1].a[r]) + r_abs(g[2].a[r]));
    return most;
}

FE_INLINE real trace_of(const real_sym *m) { return m->xx + m->yy + m->zz; }

// f^2 of a tensor G that turns with w in time t: its change E = t ([w] G - G [w]) has the square 2 f^2 g^2 where g
// stands out of it, and is nothing where it turns about its own axis
FE_INLINE real turn_within(const real_sym *g, real3 w, double t)
{
    const real3 x = r_cross(w, (real3){g->xx, g->xy, g->xz}), y = r_cross(w, (real3){g->xy, g->yy, g->yz}),
                z = r_cross(w, (real3){g->xz, g->yz, g->zz});
    // [w] G has these columns, and - G [w] is its transpose
    const real xx = 2.0 * x.x, yy = 2.0 * y.y, zz = 2.0 * z.z, xy = x.y + y.x, xz = x.z + z.x, yz = y.z + z.y;
    const real square = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz), size = trace_of(g);
    return 0.5 * t * t * square * inverse_or_zero(size * size);
}

// a + k b
FE_INLINE real_sym mix_sym(const real_sym *a, real k, const real_sym *b)
{
    return (real_sym){a->xx + k * b->xx, a->xy + k * b->xy, a->xz + k * b->xz,
                      a->yy + k * b->yy, a->yz + k * b->yz, a->zz + k * b->zz};
}

// A of a link, in the given lanes
static void find_sizes(const pass *t, int32_t i, int32_t lanes)
{
    tree_node *n = t->nodes + i;
    six own[6];
    for (int k = 0; k < 6; ++k) {
        six unit_load = {{r_set(0.0)}};
        unit_load.a[k] = r_set(1.0);
        clear_loads(t);
        load_link(n, &unit_load);
        meet_requests(t, PLACES);
        own[k] = answer_of(n);
    }
    // what is locked answers nothing, but no link is heavier than all of them
    real total = r_set(0.0);
    for (int32_t k = 0; k < t->count; ++k) total += t->nodes[k].mass;
    const real least = n->mass / total;
    n->light = r_max(least, n->mass * size_of(own));
    n->gives = r_max(least, n->mass * (1.0 / 3.0) * (own[0].a[0] + own[1].a[1] + own[2].a[2]));
    n->heavier = r_bits(r_greater(r_set(HEAVIER), n->light)) & lanes;
    const real_sym g = {own[3].a[3], own[3].a[4], own[3].a[5], own[4].a[4], own[4].a[5], own[5].a[5]};
    const real share = r_max(least, trace_of(&g) * inverse_or_zero(trace_of(&n->first_inverse)));
    const real even = EVEN + 4.0 * turn_within(&g, read_velocity(t, &n->line).w, 1.0 / t->job->mean);
    const real_sym turns = mix_sym(&g, even * share, &n->first_inverse), none = {0};
    n->turns = mix_sym(&none, r_set(ROTATIONS), &turns);
    n->root = root_of(&n->turns);
}

// Numbers that no symmetry of a machine has, to begin with: -1..1
FE_INLINE double irregular(int32_t i)
{
    const double golden = 0.618033988749895, at = golden * (double)(i + 1);
    return 2.0 * (at - (double)(int32_t)at) - 1.0;
}

// A^-1/2 of an answer, and its transpose of a load; 0 in lanes whose link keeps its own mass
FE_INLINE six scaled(const tree_node *n, real k, const six *x, int as_load)
{
    const real by = r_choose(r_mask(n->heavier), k, r_set(0.0)), shift = by * r_sqrt(n->mass / n->light);
    const real3 w = {x->a[3], x->a[4], x->a[5]};
    const real3 turn = r_scale(by, as_load ? solve_root_back(&n->root, w) : solve_root(&n->root, w));
    return (six){{shift * x->a[0], shift * x->a[1], shift * x->a[2], turn.x, turn.y, turn.z}};
}

// x = A^-1/2 G A^-T/2 x / size, of the links that are heavier. Returns its square
static real raise_power(const pass *t, real size)
{
    real square = r_set(DBL_MIN);
    clear_loads(t);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->heavier) continue;
        const six load = scaled(n, 1.0 / size, &n->x, 1);
        load_link(n, &load);
    }
    meet_requests(t, PLACES);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->heavier) continue;
        const six answer = answer_of(n);
        n->x = scaled(n, r_set(1.0), &answer, 0);
        for (int k = 0; k < 6; ++k) square += n->x.a[k] * n->x.a[k];
    }
    return square;
}

// c
static real largest_factor(const pass *t)
{
    real size = r_set(1.0);
    for (int32_t i = 0; i < t->count; ++i)
        for (int k = 0; k < 6 && t->nodes[i].heavier; ++k) t->nodes[i].x.a[k] = r_set(irregular(6 * i + k));
    for (int power = 0; power < POWERS; ++power) size = r_sqrt(raise_power(t, size));
    return size;
}

// ---- shares ---------------------------------------------------------------------------------------------------------
FE_INLINE real_sym choose_sym(real_mask m, const real_sym *yes, const real_sym *no)
{
    return (real_sym){r_choose(m, yes->xx, no->xx), r_choose(m, yes->xy, no->xy), r_choose(m, yes->xz, no->xz),
                      r_choose(m, yes->yy, no->yy), r_choose(m, yes->yz, no->yz), r_choose(m, yes->zz, no->zz)};
}

// What contacts see of a rotation, as the floats that they get, and its inverse
static void set_turns(const pass *t, tree_node *n, real scale, const real_sym *of)
{
    const real k[6] = {of->xx, of->xy, of->xz, of->yy, of->yz, of->zz};
    real seen[6];
    for (int j = 0; j < 6; ++j) n->seen[j] = narrow(scale * k[j]), seen[j] = r_widen(n->seen[j]);
    real_sym all = {seen[0], seen[1], seen[2], seen[3], seen[4], seen[5]};
    if (t->locks & 8) all.xx = r_set(1.0);
    if (t->locks & 16) all.yy = r_set(1.0);
    if (t->locks & 32) all.zz = r_set(1.0);
    n->resists = inverse_sym(&all);
}

// `others`: lanes in which some links keep their own masses; `factor`: c. Where D would be no less than the masses of
// the bodies, these are shown, and what the tree answers for the stiffness alone.
static void scale_shares(const pass *t, int32_t others, real factor)
{
    const real both = r_choose(r_mask(others), r_set(2.0), r_set(1.0)), one = r_set(1.0);
    real least = r_set(2.0);
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        if (n->touched) least = r_min(least, r_choose(r_mask(n->heavier), both * factor * n->light, one));
    }
    const real_mask lends = r_greater(r_set(LENDS), least);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->touched) continue;
        const real_mask heavier = r_both(r_mask(n->heavier), lends);
        const real_sym turns = choose_sym(heavier, &n->turns, &n->first_inverse);
        const real scale = r_choose(lends, both, one) * r_choose(heavier, factor, one), gives = n->gives;
        n->light = scale * r_choose(heavier, n->light, one);
        n->part = narrow(r_min(r_choose(r_mask(n->heavier), gives, one) / n->light, r_set(MOST_PART)));
        set_turns(t, n, scale, &turns);
    }
}

// Shares of all touched links. Returns the lanes in which one of them is heavier by the tree
static int32_t find_shares(const pass *t)
{
    int32_t heavier = 0, others = 0;
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].of[PLACES].ask_v = t->nodes[i].of[PLACES].ask_w = r_zero3();
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->touched) continue;
        const int32_t lanes = r_bits(r_greater(r_set(HEAVIER), own_share(t, i))) & n->touched;
        n->light = r_set(1.0), n->turns = n->first_inverse;
        if (lanes) find_sizes(t, i, lanes);
        heavier |= n->heavier, others |= n->touched & ~n->heavier;
    }
    if (!heavier) return 0;
    const real factor = FOR_TURNS * r_max(largest_factor(t), r_set(1.0));
    scale_shares(t, others, factor);
    return heavier;
}
