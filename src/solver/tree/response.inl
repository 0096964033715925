// response.inl - what the links of a tree make of forces on them: the masses that contacts push. Part of tree.simd.c.
//
// A contact of a link pushes the whole tree. With G the response of the tree's velocities to forces on the links that
// contacts touch, impulses l that were found with masses D^-1 instead give the energy
//     v.l + l.G l / 2  <=  v.l + l.D l / 2 = what the contacts know of
// as long as D - G has no negative eigenvalue: then passes that take energy by D take it by G too. The masses of the
// bodies alone are such a D, as no joint makes a body lighter; but with a wheel of 2 kg under a cart of 1000 each pass
// takes a five-hundredth of what comes down. Sums of the norms of G's blocks are another (Gershgorin):
//     D_i = sum_j |G_ij|              i, j: translations, rotations of a touched link
// Contacts know bodies by one inverse mass and one inverse inertia. So D is given in shares of a body's own. Rotations
// are counted as y = L^T w / sqrt(m), I = L L^T, in which a body alone answers y = (torque) / m.

// A tree lends where a touched link takes part with less than this of its own inverse mass
#define LENDS 0.125
// For what bodies turn within the step
#define FOR_TURNS 1.25
// With more touched links than these their masses stay their own: G takes time with each
#define MOST_TOUCHED 16

FE_INLINE real r_abs(real a) { return r_max(a, -a); }

// ---- who is touched -------------------------------------------------------------------------------------------------
// lanes
static int32_t touched_in(const pass *t, int32_t i)
{
    int32_t lanes = 0;
    for (int lane = 0; lane < t->job->count; ++lane) {
        const fe__body *body = t->job->bodies + t->links_of[lane][i].body;
        lanes |= (body->colours[0] | body->colours[1]) != 0 ? 1 << lane : 0;
    }
    return lanes;
}

// The links that are, in any lane: at most so many of them. Returns how many there are
static int32_t find_touched(const pass *t, int32_t *touched)
{
    int32_t count = 0;
    for (int32_t i = 0; i < t->count; ++i) {
        t->nodes[i].touched = touched_in(t, i);
        if (t->nodes[i].touched && count++ < MOST_TOUCHED) touched[count - 1] = i;
    }
    return count;
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
    real_sym l;
    l.xx = r_sqrt(i->xx), l.xy = i->xy / l.xx, l.xz = i->xz / l.xx;
    l.yy = r_sqrt(i->yy - l.xy * l.xy), l.yz = (i->yz - l.xy * l.xz) / l.yy;
    l.zz = r_sqrt(i->zz - l.xz * l.xz - l.yz * l.yz);
    return l;
}

typedef struct six {
    real a[6];
} six;

// Velocities of a touched link
FE_INLINE six answer_of(const tree_node *n)
{
    const real3 v = centre_change(n), w = n->change_w;
    const real_sym l = n->root;
    const real k = n->per_root_mass;
    return (six){
        {v.x, v.y, v.z, k * (l.xx * w.x + l.xy * w.y + l.xz * w.z), k * (l.yy * w.y + l.yz * w.z), k * (l.zz * w.z)}};
}

// A unit load k on link i: its changes are those of the whole tree
static void push(const pass *t, int32_t i, int k)
{
    tree_node *n = t->nodes + i;
    const real_sym l = n->root;
    const real zero = r_set(0.0);
    for (int32_t j = 0; j < t->count; ++j) t->nodes[j].load_v = t->nodes[j].load_w = r_zero3();
    if (k < 3) {
        n->load_v = unit3(k), n->load_w = r_cross(unit3(k), n->below); // the centre is at -below
    } else {
        const real3 column[3] = {{l.xx, l.xy, l.xz}, {zero, l.yy, l.yz}, {zero, zero, l.zz}};
        n->load_w = r_scale(n->per_root_mass, column[k - 3]);
    }
    pass_up(t);
    hand_down(t);
}

// |A| of a symmetric block by the sums of its rows
FE_INLINE real size_of(const six *g, int first)
{
    real most = r_set(0.0);
    for (int r = first; r < first + 3; ++r)
        most = r_max(most, r_abs(g[first].a[r]) + r_abs(g[first + 1].a[r]) + r_abs(g[first + 2].a[r]));
    return most;
}

FE_INLINE real square_of(const real *a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

// The blocks of a column of G. |G_ij| by Frobenius
static void add_answers(const pass *t, const int32_t *touched, int32_t count, int32_t q)
{
    six own[6];
    real square[MOST_TOUCHED][4];
    for (int k = 0; k < 6; ++k) {
        push(t, touched[q], k);
        own[k] = answer_of(t->nodes + touched[q]);
        for (int32_t p = 0; p < count; ++p) {
            const six a = answer_of(t->nodes + touched[p]);
            real *to = square[p] + (k < 3 ? 0 : 2);
            for (int half_of = 0; half_of < 2; ++half_of) {
                const real s = square_of(a.a + 3 * half_of);
                to[half_of] = k % 3 ? to[half_of] + s : s;
            }
        }
    }
    const real_mask there = r_mask(t->nodes[touched[q]].touched);
    for (int32_t p = 0; p < count; ++p) {
        tree_node *n = t->nodes + touched[p];
        const real spin = r_sqrt(square[p][1]) + (p == q ? size_of(own, 3) : r_sqrt(square[p][3])),
                   shift = r_sqrt(square[p][2]) + (p == q ? size_of(own, 0) : r_sqrt(square[p][0]));
        n->light += r_choose(there, n->mass * shift, r_set(0.0));
        n->spins += r_choose(there, n->mass * spin, r_set(0.0));
    }
}

// ---- shares ---------------------------------------------------------------------------------------------------------
static void clear_shares(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        n->light = n->spins = r_set(0.0);
        n->ask_v = n->ask_w = n->slip = r_zero3();
    }
}

// lanes in which a touched link may take part with less than LENDS
static int32_t may_lend(const pass *t, const int32_t *touched, int32_t count)
{
    int32_t lanes = 0;
    for (int32_t p = 0; p < count; ++p)
        lanes |= r_bits(r_greater(r_set(LENDS), own_share(t, touched[p]))) & t->nodes[touched[p]].touched;
    return lanes;
}

// Shares of all touched links. Returns the lanes in which one of them is small
static int32_t find_shares(const pass *t, const int32_t *touched, int32_t count)
{
    int32_t lanes = 0;
    clear_shares(t);
    for (int32_t p = 0; p < count; ++p) {
        tree_node *n = t->nodes + touched[p];
        n->root = root_of(&n->inertia), n->per_root_mass = 1.0 / r_sqrt(n->mass);
    }
    for (int32_t q = 0; q < count; ++q) add_answers(t, touched, count, q);
    for (int32_t p = 0; p < count; ++p) {
        tree_node *n = t->nodes + touched[p];
        n->light = r_max(FOR_TURNS * n->light, r_set(FLT_EPSILON));
        n->spins = r_max(FOR_TURNS * n->spins, r_set(FLT_EPSILON));
        lanes |= r_bits(r_greater(r_set(LENDS), n->light)) & n->touched;
    }
    return lanes;
}
