// response.inl - what the links of a tree make of forces on them: the masses that contacts push. Part of tree.simd.c.
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
// Contacts know bodies by one inverse mass and one inverse inertia. So D is given in shares of a body's own. Rotations
// are counted as y = L^T w / sqrt(m), I = L L^T, in which a body alone answers y = torque / m.

// A tree lends where a touched link gets less than this share of its own inverse mass: what others lose is worth it
#define LENDS 0.5
// Links that are heavier by the tree: A is at most this share
#define HEAVIER 0.125
// What G may grow by while bodies turn within the step, and what powers may have missed
#define FOR_TURNS 1.25
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

// L, lower triangle
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

// Velocities of a touched link
FE_INLINE six answer_of(const tree_node *n)
{
    const real3 v = centre_change(n, PLACES), w = n->of[PLACES].change_w;
    const real_sym l = n->root;
    const real k = n->per_root_mass;
    return (six){
        {v.x, v.y, v.z, k * (l.xx * w.x + l.xy * w.y + l.xz * w.z), k * (l.yy * w.y + l.yz * w.z), k * (l.zz * w.z)}};
}

FE_INLINE void clear_loads(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) clear_load(t->nodes[i].of + PLACES);
}

// a load on the centre, which is at -below
FE_INLINE void load_link(tree_node *n, const six *a)
{
    const real3 f = {a->a[0], a->a[1], a->a[2]};
    const real_sym l = n->root;
    const real3 y = {l.xx * a->a[3], l.xy * a->a[3] + l.yy * a->a[4], l.xz * a->a[3] + l.yz * a->a[4] + l.zz * a->a[5]};
    n->of[PLACES].load_v = f;
    n->of[PLACES].load_w = r_add_scaled(r_cross(f, n->below), n->per_root_mass, y);
}

// |A| of a symmetric block by the sums of its rows
FE_INLINE real size_of(const six *g, int first)
{
    real most = r_set(0.0);
    for (int r = first; r < first + 3; ++r)
        most = r_max(most, r_abs(g[first].a[r]) + r_abs(g[first + 1].a[r]) + r_abs(g[first + 2].a[r]));
    return most;
}

// A of a link, in the given lanes
static void find_sizes(const pass *t, int32_t i, int32_t lanes)
{
    tree_node *n = t->nodes + i;
    six own[6];
    n->root = root_of(&n->inertia), n->per_root_mass = 1.0 / r_sqrt(n->mass);
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
    n->light = r_max(least, n->mass * size_of(own, 0));
    n->spins = r_max(least, n->mass * size_of(own, 3));
    n->heavier = r_bits(r_greater(r_set(HEAVIER), n->light)) & lanes;
}

// Numbers that no symmetry of a machine has, to begin with: -1..1
FE_INLINE double irregular(int32_t i)
{
    const double golden = 0.618033988749895, at = golden * (double)(i + 1);
    return 2.0 * (at - (double)(int32_t)at) - 1.0;
}

// k A^-1/2 x, and 0 in lanes whose link keeps its own mass
FE_INLINE six scaled(const tree_node *n, real k, six x)
{
    const real by = r_choose(r_mask(n->heavier), k, r_set(0.0));
    const real shift = by * r_sqrt(n->mass / n->light), spin = by * r_sqrt(n->mass / n->spins);
    for (int j = 0; j < 6; ++j) x.a[j] *= j < 3 ? shift : spin;
    return x;
}

// x = A^-1/2 G A^-1/2 x / size, of the links that are heavier. Returns its square
static real raise_power(const pass *t, real size)
{
    real square = r_set(DBL_MIN);
    clear_loads(t);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->heavier) continue;
        const six load = scaled(n, 1.0 / size, n->x);
        load_link(n, &load);
    }
    meet_requests(t, PLACES);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->heavier) continue;
        n->x = scaled(n, r_set(1.0), answer_of(n));
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
// `others`: lanes in which some links keep their own masses; `factor`: c
static int32_t scale_shares(const pass *t, int32_t others, real factor)
{
    const real both = r_choose(r_mask(others), r_set(2.0), r_set(1.0));
    int32_t lanes = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->touched) continue;
        const real_mask heavier = r_mask(n->heavier);
        n->light = both * r_choose(heavier, factor * n->light, r_set(1.0));
        n->spins = both * r_choose(heavier, factor * n->spins, r_set(1.0));
        lanes |= r_bits(r_greater(r_set(LENDS), n->light)) & n->touched;
    }
    return lanes;
}

// Shares of all touched links. Returns the lanes in which one of them is small
static int32_t find_shares(const pass *t)
{
    int32_t heavier = 0, others = 0;
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].of[PLACES].ask_v = t->nodes[i].of[PLACES].ask_w = r_zero3();
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        if (!n->touched) continue;
        const int32_t lanes = r_bits(r_greater(r_set(HEAVIER), own_share(t, i))) & n->touched;
        n->light = n->spins = r_set(1.0);
        if (lanes) find_sizes(t, i, lanes);
        heavier |= n->heavier, others |= n->touched & ~n->heavier;
    }
    if (!heavier) return 0;
    const real factor = FOR_TURNS * r_max(largest_factor(t), r_set(1.0));
    return scale_shares(t, others, factor);
}
