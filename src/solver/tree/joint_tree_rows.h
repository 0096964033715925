// joint_tree_rows.h - a lane of the sweep's rows as rows of a tree, and impulses back. Part of joint.simd.c.
//
// What a lock of two bodies says of their velocities (v, w), those of the body below a joint and of the one above it.

enum { TREE_LOCKS = 6, TREE_ROWS = TREE_LOCKS + 3 }; // three more calm a joint, see joint_tree_calm.h

FE_INLINE fe_dvec3 lane3(const wide *a, int32_t i) { return (fe_dvec3){(double)a[0][i], (double)a[1][i], (double)a[2][i]}; }
FE_INLINE fe_dvec3 vec_of(const double *a) { return (fe_dvec3){a[0], a[1], a[2]}; }
FE_INLINE fe_dvec3 unit(int k) { return (fe_dvec3){k == 0, k == 1, k == 2}; }

typedef struct {
    double below[TREE_ROWS][6], above[TREE_ROWS][6]; // J of the body below the joint, of the other one: along v, w
    double error[TREE_ROWS];                         // m, rad
    fe_dvec3 arm[2];                                 // of the joint's point from the centres of the body below, above, m
    fe_dvec3 pull;                                   // impulse on the body below at that point, N s
    int32_t count;
    int32_t points; // bits of the rows that hold points
    double rod;     // length of a distance joint, m; else 0
} tree_rows;

// B's velocity along u and its spin along mb, less A's
static void add_row(tree_rows *t, int holds_b, fe_dvec3 u, fe_dvec3 ma, fe_dvec3 mb, double error)
{
    const double a[6] = {-u.x, -u.y, -u.z, -ma.x, -ma.y, -ma.z}, b[6] = {u.x, u.y, u.z, mb.x, mb.y, mb.z};
    memcpy(t->below[t->count], holds_b ? b : a, sizeof a);
    memcpy(t->above[t->count], holds_b ? a : b, sizeof a);
    if (fe__ddot(u, u) > 0.0) t->points |= 1 << t->count;
    t->error[t->count++] = error;
}

static void set_arms(tree_rows *t, int holds_b, fe_dvec3 ra, fe_dvec3 rb) { t->arm[0] = holds_b ? rb : ra, t->arm[1] = holds_b ? ra : rb; }
static void add_pull(tree_rows *t, int holds_b, fe_dvec3 on_b) { t->pull = fe__dadd(t->pull, fe__dscale(holds_b ? 1.0 : -1.0, on_b)); }

static fe_quat motion_quat(const fe__motion_line *m) { return (fe_quat){m->rotation[0], m->rotation[1], m->rotation[2], m->rotation[3]}; }
// a vector of the body's, turned as far as the body has in this step
static fe_dvec3 turned_lane(const fe__motion_line *motion, fe_dvec3 a) { return fe__drotate(motion_quat(motion), a); }

// anchors, by their arms from the centres, now; gap: anchor of B - anchor of A
typedef struct {
    fe_dvec3 ra, rb, gap;
} lane_anchors;

static lane_anchors place_anchors(const wide *first_a, const wide *first_b, const wide *first_gap, const line_pair *line, int32_t i,
                                  const fe__solver *s)
{
    const fe__motion_line *ma = s->motion + line->a[i], *mb = s->motion + line->b[i];
    fe_dvec3 fa = lane3(first_a, i), fb = lane3(first_b, i), ra = turned_lane(ma, fa), rb = turned_lane(mb, fb);
    fe_dvec3 way = fe__dsub(fe__widen(fe__quad_vector(mb->shift)), fe__widen(fe__quad_vector(ma->shift)));
    fe_dvec3 turn = fe__dsub(fe__dsub(rb, fb), fe__dsub(ra, fa));
    return (lane_anchors){ra, rb, fe__dadd(lane3(first_gap, i), fe__dadd(way, turn))};
}

static void read_point(tree_rows *t, int holds_b, const point_row *row, int32_t i, const fe__solver *s)
{
    const lane_anchors p = place_anchors(row->first_arm_a, row->first_arm_b, row->first_gap, &row->line, i, s);
    const double error[3] = {p.gap.x, p.gap.y, p.gap.z};
    set_arms(t, holds_b, p.ra, p.rb);
    add_pull(t, holds_b, lane3(row->impulse, i));
    for (int k = 0; k < 3; ++k) add_row(t, holds_b, unit(k), fe__dcross(p.ra, unit(k)), fe__dcross(p.rb, unit(k)), error[k]);
}

static void read_slide(tree_rows *t, int holds_b, const slide_row *row, int32_t i, const fe__solver *s)
{
    const lane_anchors p = place_anchors(row->first_arm_a, row->first_arm_b, row->first_gap, &row->line, i, s);
    const fe_quat first = {row->first_frame[0][i], row->first_frame[1][i], row->first_frame[2][i], row->first_frame[3][i]};
    fe_dvec3 u[3], arm = p.ra;
    for (int k = 0; k < 3; ++k) {
        u[k] = turned_lane(s->motion + row->line.a[i], fe__drotate(first, unit(k)));
        if (!(row->keep[k][i] > 0.0f)) arm = fe__dadd(arm, fe__dscale(fe__ddot(u[k], p.gap), u[k]));
    }
    set_arms(t, holds_b, arm, p.rb);
    for (int k = 0; k < 3; ++k) {
        add_pull(t, holds_b, fe__dscale((double)row->impulse[k][i], u[k]));
        if (row->keep[k][i] > 0.0f) add_row(t, holds_b, u[k], fe__dcross(arm, u[k]), fe__dcross(p.rb, u[k]), fe__ddot(u[k], p.gap));
    }
}

static void read_hinge(tree_rows *t, int holds_b, const hinge_row *row, int32_t i, const fe__solver *s)
{
    const fe__motion_line *ma = s->motion + row->line.a[i], *mb = s->motion + row->line.b[i];
    const fe_dvec3 still = {0.0, 0.0, 0.0}, t1 = turned_lane(ma, lane3(row->first_t1, i)), t2 = turned_lane(ma, lane3(row->first_t2, i));
    const fe_dvec3 axis_b = turned_lane(mb, lane3(row->first_axis_b, i));
    add_row(t, holds_b, still, t1, t1, -fe__ddot(t2, axis_b));
    add_row(t, holds_b, still, t2, t2, fe__ddot(t1, axis_b));
}

static void read_fixed(tree_rows *t, int holds_b, const fixed_row *row, int32_t i, const fe__solver *s)
{
    const fe_quat first = {row->first[0][i], row->first[1][i], row->first[2][i], row->first[3][i]};
    const fe_quat b = motion_quat(s->motion + row->line.b[i]), a = motion_quat(s->motion + row->line.a[i]);
    const fe_quat q = fe__product(fe__product(b, first), fe__conjugate(a));
    const double two = q.w < 0.0f ? -2.0 : 2.0, error[3] = {two * (double)q.x, two * (double)q.y, two * (double)q.z};
    const fe_dvec3 still = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; ++k) add_row(t, holds_b, still, unit(k), unit(k), error[k]);
}

// The rod's length is what it is to be; two points in one place are apart along X of A
static void read_distance(tree_rows *t, int holds_b, const linear_row *row, int32_t i, const fe__solver *s)
{
    const lane_anchors p = place_anchors(row->first_arm_a, row->first_arm_b, row->first_gap, &row->line, i, s);
    const fe_quat first = {row->first_frame[0][i], row->first_frame[1][i], row->first_frame[2][i], row->first_frame[3][i]};
    const double length = sqrt(fe__ddot(p.gap, p.gap));
    const fe_dvec3 x = turned_lane(s->motion + row->line.a[i], fe__drotate(first, unit(0)));
    const fe_dvec3 u = length > 0.0 ? fe__dscale(1.0 / length, p.gap) : x;
    set_arms(t, holds_b, p.ra, p.rb);
    t->rod = length;
    add_pull(t, holds_b, fe__dscale((double)row->f.under[i], u));
    add_row(t, holds_b, u, fe__dcross(p.ra, u), fe__dcross(p.rb, u), length - (double)row->f.low[i]);
}

typedef struct {
    const wide_sym *a, *b; // inverse inertia
} end_inertias;

static end_inertias read_lock(tree_rows *t, int holds_b, int32_t part, const void *row, int32_t lane, const fe__solver *s)
{
    switch (part) {
    case FE__PART_POINT:
        read_point(t, holds_b, row, lane, s);
        return (end_inertias){&((const point_row *)row)->inertia_a, &((const point_row *)row)->inertia_b};
    case FE__PART_SLIDE:
        read_slide(t, holds_b, row, lane, s);
        return (end_inertias){&((const slide_row *)row)->inertia_a, &((const slide_row *)row)->inertia_b};
    case FE__PART_HINGE:
        read_hinge(t, holds_b, row, lane, s);
        return (end_inertias){&((const hinge_row *)row)->inertia_a, &((const hinge_row *)row)->inertia_b};
    case FE__PART_FIXED:
        read_fixed(t, holds_b, row, lane, s);
        return (end_inertias){&((const fixed_row *)row)->inertia_a, &((const fixed_row *)row)->inertia_b};
    default:
        read_distance(t, holds_b, row, lane, s);
        return (end_inertias){&((const linear_row *)row)->inertia_a, &((const linear_row *)row)->inertia_b};
    }
}

// ---- impulses back to the lanes; `total`: to the sums over the step too ----------------------------------------------------------------
FE_INLINE void add_lane(wide *to, int32_t i, double a) { (*to)[i] += (float)a; }
FE_INLINE void add_lane3(wide *to, int32_t i, fe_dvec3 a) { add_lane(to, i, a.x), add_lane(to + 1, i, a.y), add_lane(to + 2, i, a.z); }

static int write_slide(slide_row *row, int32_t i, const double *l, int total)
{
    int taken = 0;
    for (int k = 0; k < 3; ++k) {
        if (!(row->keep[k][i] > 0.0f)) continue;
        add_lane(row->impulse + k, i, l[taken]);
        if (total) add_lane3(row->total, i, fe__dscale(l[taken], lane3(row->u[k], i)));
        ++taken;
    }
    return taken;
}

static int write_hinge(hinge_row *row, int32_t i, const double *l, int total)
{
    add_lane(row->impulse, i, l[0]), add_lane(row->impulse + 1, i, l[1]);
    if (total) add_lane3(row->total, i, fe__dadd(fe__dscale(l[0], lane3(row->t1, i)), fe__dscale(l[1], lane3(row->t2, i))));
    return 2;
}

static int write_three(wide *impulse, wide *sum, int32_t i, const double *l, int total)
{
    add_lane3(impulse, i, vec_of(l));
    if (total) add_lane3(sum, i, vec_of(l));
    return 3;
}

static int write_distance(linear_row *row, int32_t i, const double *l, int total)
{
    add_lane(&row->f.under, i, l[0]);
    if (total) add_lane(&row->f.total, i, l[0]);
    return 1;
}

// how many of the impulses l it took
static int write_lock(int32_t part, void *row, int32_t lane, const double *l, int total)
{
    switch (part) {
    case FE__PART_POINT:
        return write_three(((point_row *)row)->impulse, ((point_row *)row)->total, lane, l, total);
    case FE__PART_FIXED:
        return write_three(((fixed_row *)row)->impulse, ((fixed_row *)row)->total, lane, l, total);
    case FE__PART_SLIDE:
        return write_slide(row, lane, l, total);
    case FE__PART_HINGE:
        return write_hinge(row, lane, l, total);
    default:
        return write_distance(row, lane, l, total);
    }
}
