// read_locks.inl - masses, points and axes of trees from the locks that the sweep holds, with the bodies where they are
// now. Part of tree_solver.simd.c.

// Of two rows of a joint that locked bodies leave the same direction: a square below this is rounding
#define NO_AXIS 1e-10

// ---- a lane of a node -----------------------------------------------------------------------------------------------
FE_INLINE void set_lane(real *a, int lane, double value) { ((double *)a)[lane] = value; }
FE_INLINE double get_lane(const real *a, int lane) { return ((const double *)a)[lane]; }
FE_INLINE void set_lane3(real3 *a, int lane, fe_dvec3 value)
{
    set_lane(&a->x, lane, value.x), set_lane(&a->y, lane, value.y), set_lane(&a->z, lane, value.z);
}
FE_INLINE fe_dvec3 get_lane3(const real3 *a, int lane)
{
    return (fe_dvec3){get_lane(&a->x, lane), get_lane(&a->y, lane), get_lane(&a->z, lane)};
}

static void read_lock(const pass *t, const fe__tree_place *p, int32_t k, fe__lock *out)
{
    p->lock[k].of->read(p->lock[k].part, t->job->rows + p->lock[k].row, p->lock[k].lane, out);
}

// of its moments about axes that are not locked
FE_INLINE real heaviest_of(const tree_node *n, uint32_t locks)
{
    real most = r_set(0.0);
    if (!(locks & 8)) most = r_max(most, n->inertia.xx);
    if (!(locks & 16)) most = r_max(most, n->inertia.yy);
    if (!(locks & 32)) most = r_max(most, n->inertia.zz);
    return most;
}

// ---- once a step ----------------------------------------------------------------------------------------------------
// 0 where it has none
FE_INLINE real_sym inverse_sym(const real_sym *i)
{
    const real xx = i->yy * i->zz - i->yz * i->yz, xy = i->xz * i->yz - i->xy * i->zz,
               xz = i->xy * i->yz - i->xz * i->yy;
    const real k = inverse_or_zero(i->xx * xx + i->xy * xy + i->xz * xz);
    return (real_sym){k * xx,
                      k * xy,
                      k * xz,
                      k * (i->xx * i->zz - i->xz * i->xz),
                      k * (i->xy * i->xz - i->xx * i->yz),
                      k * (i->xx * i->yy - i->xy * i->xy)};
}

// A locked direction gets some mass, which the elimination hides
static void load_masses(const pass *t, int32_t i)
{
    tree_node *n = t->nodes + i;
    const lines line = read_lines(t->solver->velocity, &n->line), in = read_lines(t->solver->inertia, &n->line);
    const real3 first = widen3(in.a), second = widen3(in.a + 3);
    real_sym inverse = n->first_inverse = (real_sym){first.x, first.y, first.z, second.x, second.y, second.z};
    if (t->locks & 8) inverse.xx = r_set(1.0);
    if (t->locks & 16) inverse.yy = r_set(1.0);
    if (t->locks & 32) inverse.zz = r_set(1.0);
    n->inverse_mass = line.a[3], n->locks = line.a[7];
    n->mass = 1.0 / r_widen(line.a[3]);
    n->inertia = n->first_inertia = inverse_sym(&inverse);
    n->heaviest = heaviest_of(n, t->locks);
}

static void load_ball(const pass *t, int32_t i, int lane)
{
    tree_node *n = t->nodes + i;
    fe__lock lock;
    read_lock(t, t->places[lane] + i, 0, &lock);
    const int32_t holds_b = t->links_of[lane][i].holds_b;
    set_lane3(&n->first_below, lane, fe__widen(holds_b ? lock.arm_b : lock.arm_a));
    set_lane3(&n->first_above, lane, fe__widen(holds_b ? lock.arm_a : lock.arm_b));
    set_lane3(&n->first_gap, lane, fe__dscale(holds_b ? 1.0 : -1.0, fe__widen(lock.gap)));
}

// from its centre to an anchor, world axes
FE_INLINE fe_dvec3 arm_of(const fe__body *body, const float *arm)
{
    return fe__drotate(fe__quat_of(body->rotation), fe__widen(fe__quad_vector(arm)));
}

FE_INLINE fe_dvec3 centre_of(const fe__body *body)
{
    return (fe_dvec3){body->centre[0], body->centre[1], body->centre[2]};
}

// Of a rope, whose joints have no rows
FE_INLINE void load_record(const pass *t, int32_t i, int lane)
{
    tree_node *n = t->nodes + i;
    const int32_t b = t->links_of[lane][i].holds_b;
    const fe__joint *j = t->of[lane]->joints.joints + t->links_of[lane][i].joint;
    const fe__body *below = t->of[lane]->bodies + (b ? j->body_b : j->body_a),
                   *above = t->of[lane]->bodies + (b ? j->body_a : j->body_b);
    const fe_dvec3 from = arm_of(below, b ? j->arm_b : j->arm_a), to = arm_of(above, b ? j->arm_a : j->arm_b);
    set_lane3(&n->first_below, lane, from);
    set_lane3(&n->first_above, lane, to);
    set_lane3(&n->first_gap, lane, fe__dadd(fe__dsub(centre_of(below), centre_of(above)), fe__dsub(from, to)));
    set_lane3(&n->pull, lane,
              fe__dscale((b ? 1.0 : -1.0) * t->job->warm_scale, fe__widen(fe__quad_vector(j->impulse))));
}

static void load_lane(const pass *t, int32_t i, int lane)
{
    tree_node *n = t->nodes + i;
    const fe__tree_place *p = t->places[lane] + i;
    n->line.at[lane] = p->line, n->line_above.at[lane] = p->parent_line;
    set_lane(&n->side, lane, t->links_of[lane][i].holds_b ? 1.0 : -1.0);
    if (!is_ball(t, i)) return;
    if (t->kind == FE__TREE_ROPE) {
        load_record(t, i, lane);
        return;
    }
    const fe__lock_lanes *of = p->lock[0].of;
    n->point[lane] = p->lock[0].row + (of->point_impulse + p->lock[0].lane) * (int64_t)sizeof(float);
    n->width[lane] = of->width, n->sum[lane] = of->point_sum;
    load_ball(t, i, lane);
}

// In the given lanes: inertia as when the step began
static void face_first(const pass *t, int32_t lanes)
{
    const real_mask these = r_mask(lanes);
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        n->principal = r_choose_mat(these, (real_mat){unit3(0), unit3(1), unit3(2)}, n->principal);
        n->inertia = r_turn_sym(&n->principal, &n->first_inertia);
        n->heaviest = heaviest_of(n, t->locks);
    }
}

static void load_bundle(const pass *t)
{
    if (t->head->loaded) return;
    t->head->loaded = 1;
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        n->pull = n->total = n->given_v = n->given_w = r_zero3();
        for (int lane = 0; lane < LANES; ++lane) load_lane(t, i, lane);
        load_masses(t, i);
        n->rod = r_set(0.0);
        n->principal = (real_mat){unit3(0), unit3(1), unit3(2)};
        n->of[PLACES].slip = r_zero3();
    }
}

// ---- ball joints ----------------------------------------------------------------------------------------------------
typedef struct pose {
    real_mat turn;
    real3 shift;
    real angle; // sin^2 of half of it
} pose;

FE_INLINE pose pose_of(const pass *t, const line_names *line)
{
    const lines l = read_lines(t->solver->motion, line);
    const real3 v = widen3(l.a + 4);
    return (pose){r_matrix(v.x, v.y, v.z, r_widen(l.a[7])), widen3(l.a), r_dot(v, v)};
}

// what the rows hold
FE_INLINE real3 impulse_of_point(const pass *t, const tree_node *n)
{
    half l[3];
    for (int k = 0; k < 3; ++k) {
#define LANE(i) point_of(t, n, i)[k * n->width[i]]
        l[k] = (half)PER_LANE_(LANE);
#undef LANE
    }
    return r_scale(n->side, widen3(l));
}

FE_INLINE void read_ball(const pass *t, int32_t i, int32_t lanes)
{
    tree_node *n = t->nodes + i, *above = above_of(t, i);
    const pose at = above ? (pose){above->turn, above->shift, r_set(0.0)} : pose_of(t, &n->line_above);
    const real3 below = r_mul(&n->turn, n->first_below), to = r_mul(&at.turn, n->first_above);
    const real3 swing = r_sub(r_sub(below, n->first_below), r_sub(to, n->first_above));
    const real3 gap = r_add(n->first_gap, r_add(r_sub(n->shift, at.shift), swing));
    put3(&n->below, lanes, below), put3(&n->above, lanes, to);
    put3(&n->gap, lanes, gap);
    if (t->kind != FE__TREE_ROPE) put3(&n->pull, lanes, impulse_of_point(t, n));
}

// ---- other joints ---------------------------------------------------------------------------------------------------
// One lane: what there is to say of it differs from kind to kind
typedef struct axes {
    fe_dvec3 below, above, gap, swing, pull;
    fe_dvec3 lin[3], ang[3];
    double rod;
} axes;

typedef struct place {
    const fe__motion_line *a, *b;
    fe_dvec3 ra, rb, gap; // arms of the anchors; anchor of B - anchor of A
} place;

static fe_dvec3 turned(const fe__motion_line *motion, fe_dvec3 first)
{
    return fe__drotate(fe__quat_of(motion->rotation), first);
}

static place anchors_of(const fe__solver *s, const fe__lock *l)
{
    place p = {.a = s->motion + l->line_a, .b = s->motion + l->line_b};
    const fe_dvec3 first_a = fe__widen(l->arm_a), first_b = fe__widen(l->arm_b);
    p.ra = turned(p.a, first_a), p.rb = turned(p.b, first_b);
    const fe_dvec3 shift = fe__dsub(fe__widen(fe__quad_vector(p.b->shift)), fe__widen(fe__quad_vector(p.a->shift)));
    const fe_dvec3 swing = fe__dsub(fe__dsub(p.rb, first_b), fe__dsub(p.ra, first_a));
    p.gap = fe__dadd(fe__widen(l->gap), fe__dadd(shift, swing));
    return p;
}

static fe_dvec3 unit(int k) { return (fe_dvec3){k == 0, k == 1, k == 2}; }

static void set_arms(axes *a, int32_t holds_b, fe_dvec3 ra, fe_dvec3 rb)
{
    a->below = holds_b ? rb : ra, a->above = holds_b ? ra : rb;
}

static void read_point(axes *a, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    set_arms(a, holds_b, p.ra, p.rb);
    a->gap = p.gap;
    a->pull = (fe_dvec3){(double)l->impulse[0], (double)l->impulse[1], (double)l->impulse[2]};
}

// A's arm reaches to where B's anchor is along the free axes
static void read_slide(axes *a, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    fe_dvec3 arm = p.ra;
    for (int k = 0; k < 3; ++k) {
        const fe_dvec3 u = a->lin[k] = turned(p.a, fe__drotate(l->frame, unit(k)));
        if (l->keeps[k] > 0.0f)
            a->gap = fe__dadd(a->gap, fe__dscale(fe__ddot(u, p.gap), u));
        else
            arm = fe__dadd(arm, fe__dscale(fe__ddot(u, p.gap), u));
        a->pull = fe__dadd(a->pull, fe__dscale((double)l->impulse[k], u));
    }
    set_arms(a, holds_b, arm, p.rb);
}

// Two points in one place are apart along X of A
static void read_distance(axes *a, int32_t holds_b, const fe__lock *l, const fe__solver *s)
{
    const place p = anchors_of(s, l);
    const double length = sqrt(fe__ddot(p.gap, p.gap));
    const fe_dvec3 x = turned(p.a, fe__drotate(l->frame, unit(0)));
    const fe_dvec3 u = length > 0.0 ? fe__dscale(1.0 / length, p.gap) : x;
    const int least = fe__absd(u.x) < fe__absd(u.y) ? (fe__absd(u.x) < fe__absd(u.z) ? 0 : 2)
                                                    : (fe__absd(u.y) < fe__absd(u.z) ? 1 : 2);
    const fe_dvec3 across = fe__dcross(u, unit(least));
    a->lin[0] = u;
    a->lin[1] = fe__dscale(1.0 / sqrt(fe__ddot(across, across)), across);
    a->lin[2] = fe__dcross(u, a->lin[1]);
    a->rod = length;
    a->gap = fe__dscale(length - (double)l->length, u);
    a->pull = fe__dscale((double)l->impulse[0], u);
    set_arms(a, holds_b, p.ra, p.rb);
}

// the free axis first
static void read_hinge(axes *a, const fe__lock *l, const fe__solver *s)
{
    const fe__motion_line *first = s->motion + l->line_a, *second = s->motion + l->line_b;
    const fe_dvec3 t1 = turned(first, fe__widen(l->t1)), t2 = turned(first, fe__widen(l->t2)),
                   axis_b = turned(second, fe__widen(l->axis_b));
    a->ang[0] = fe__dcross(t1, t2), a->ang[1] = t1, a->ang[2] = t2;
    a->swing = fe__dadd(fe__dscale(-fe__ddot(t2, axis_b), t1), fe__dscale(fe__ddot(t1, axis_b), t2));
}

static void read_fixed(axes *a, const fe__lock *l, const fe__solver *s)
{
    const fe_quat first = fe__quat_of(s->motion[l->line_a].rotation),
                  second = fe__quat_of(s->motion[l->line_b].rotation);
    const fe_quat q = fe__product(fe__product(second, l->frame), fe__conjugate(first));
    const double two = q.w < 0.0f ? -2.0 : 2.0;
    a->swing = (fe_dvec3){two * (double)q.x, two * (double)q.y, two * (double)q.z};
}

static void read_part(axes *a, int32_t holds_b, int32_t part, const fe__lock *l, const fe__solver *s)
{
    switch (part) {
    case FE__PART_POINT:
        read_point(a, holds_b, l, s);
        break;
    case FE__PART_SLIDE:
        read_slide(a, holds_b, l, s);
        break;
    case FE__PART_HINGE:
        read_hinge(a, l, s);
        break;
    case FE__PART_FIXED:
        read_fixed(a, l, s);
        break;
    default:
        read_distance(a, holds_b, l, s);
    }
}

// ---- locked bodies --------------------------------------------------------------------------------------------------
// The part of v along what is not locked: bits x y z
static fe_dvec3 unlocked(fe_dvec3 v, uint32_t locks)
{
    return (fe_dvec3){locks & 1 ? 0.0 : v.x, locks & 2 ? 0.0 : v.y, locks & 4 ? 0.0 : v.z};
}

// v less its part in the span of the first `count` of `basis`, of unit length; 0: nothing is left
static int32_t add_axis(fe_dvec3 *basis, int32_t count, fe_dvec3 v)
{
    for (int32_t k = 0; k < count; ++k) v = fe__dadd(v, fe__dscale(-fe__ddot(basis[k], v), basis[k]));
    const double square = fe__ddot(v, v);
    if (!(square > NO_AXIS) || count == 3) return 0;
    basis[count] = fe__dscale(1.0 / sqrt(square), v);
    return 1;
}

// Axes of which bodies have some locked: freedoms are what is at right angles to all that is kept, among what is not
// locked. There are never more of them than before. `free`: bits of the axes; a freedom that is none has no axis.
static void fit_axes(fe_dvec3 axis[3], fe_dvec3 *error, uint32_t free, uint32_t locks)
{
    fe_dvec3 basis[3], left = {0.0, 0.0, 0.0};
    int32_t kept = 0, all;
    for (int k = 0; k < 3; ++k)
        if (!(free >> k & 1)) kept += add_axis(basis, kept, unlocked(axis[k], locks));
    all = kept;
    for (int k = 0; k < 3; ++k) all += add_axis(basis, all, unlocked(unit(k), locks));
    for (int32_t k = 0; k < kept; ++k) left = fe__dadd(left, fe__dscale(fe__ddot(basis[k], *error), basis[k]));
    for (int k = 0; k < 3; ++k) {
        if (!(free >> k & 1)) continue;
        axis[k] = kept < all ? basis[kept] : (fe_dvec3){0.0, 0.0, 0.0};
        kept += kept < all;
    }
    *error = left;
}

static void put_axes(const pass *t, int32_t i, int lane, const axes *a)
{
    tree_node *n = t->nodes + i;
    const double sign = t->links_of[lane][i].holds_b ? 1.0 : -1.0;
    set_lane3(&n->below, lane, a->below), set_lane3(&n->above, lane, a->above);
    set_lane3(&n->gap, lane, fe__dscale(sign, a->gap)), set_lane3(&n->swing, lane, fe__dscale(sign, a->swing));
    set_lane3(&n->pull, lane, fe__dscale(sign, a->pull));
    set_lane(&n->rod, lane, a->rod);
    for (int k = 0; k < 3; ++k) set_lane3(n->lin + k, lane, a->lin[k]), set_lane3(n->ang + k, lane, a->ang[k]);
}

static void read_joint(const pass *t, int32_t i, int lane)
{
    const uint32_t form = (uint32_t)t->links[i].form;
    const fe__tree_place *p = t->places[lane] + i;
    axes a;
    memset(&a, 0, sizeof a);
    for (int k = 0; k < 3; ++k) a.lin[k] = a.ang[k] = unit(k);
    for (int32_t k = 0; k < p->locks; ++k) {
        fe__lock lock;
        read_lock(t, p, k, &lock);
        read_part(&a, t->links_of[lane][i].holds_b, p->lock[k].part, &lock, t->solver);
    }
    if (t->locks) {
        fit_axes(a.lin, &a.gap, form & 7, t->locks & 7);
        fit_axes(a.ang, &a.swing, form >> 3 & 7, t->locks >> 3 & 7);
    }
    put_axes(t, i, lane, &a);
}

// ---- all of them ----------------------------------------------------------------------------------------------------
// In the given lanes; others keep what they have. `apart`: of them, those in which other joints than balls are read,
// one by one
FE_INLINE void read_node(const pass *t, int32_t i, int32_t lanes, int32_t apart)
{
    const real_mask these = r_mask(lanes);
    tree_node *n = t->nodes + i;
    const pose at = pose_of(t, &n->line);
    const real_mask turned_far = r_both(these, r_greater(at.angle, r_set((double)FE__ROTATED)));
    put3(&n->turn.x, lanes, at.turn.x), put3(&n->turn.y, lanes, at.turn.y), put3(&n->turn.z, lanes, at.turn.z);
    put3(&n->shift, lanes, at.shift);
    if (r_bits(turned_far)) {
        n->principal = r_choose_mat(turned_far, at.turn, n->principal);
        n->inertia = r_turn_sym(&n->principal, &n->first_inertia);
        n->heaviest = heaviest_of(n, t->locks);
    }
    if (is_ball(t, i)) read_ball(t, i, lanes);
    for (int lane = 0; lane < LANES && !is_ball(t, i); ++lane)
        if (apart >> lane & 1) read_joint(t, i, lane);
}
