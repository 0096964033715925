// wide.inl - what rows of joints share: bodies in and out, records in and out, softness. Part of joint_solver.simd.c.
//
// Arms and axes rotate with their bodies in every substep (frozen ones gain energy: a chain explodes). All that follows
// from positions is found once per substep, in relax, and serves the next solve too, which reads no motion.
//
// From the second substep the warm start is what the bodies carry, v - start (bodies.simd.c): J_old^T l of the impulse
// l that a joint held when its arms turned. It should be J_new^T l. Relax moves `start` by the difference, -M^-1 (J_new
// - J_old)^T l, so that every warm start is complete before the first constraint of the next substep is solved.

typedef struct {
    int32_t a[FE_W], b[FE_W];
} line_pair;

typedef struct {
    side a, b;
} ends;

enum { BOTH_SIDES = FE__MOVES_A | FE__MOVES_B };

// ---- bodies ---------------------------------------------------------------------------------------------------------
FE_INLINE ends gather_ends(const fe__solver *s, const line_pair *line)
{
    return (ends){gather_side(s, line->a), gather_side(s, line->b)};
}

// what does not move is never written: all workers read it
FE_INLINE void scatter_ends(void *lines, const line_pair *line, const ends *e, int sides)
{
    if (sides & FE__MOVES_A) scatter_side(lines, line->a, &e->a);
    if (sides & FE__MOVES_B) scatter_side(lines, line->b, &e->b);
}

FE_INLINE wide3 minus(wide3 a) { return (wide3){-a.x, -a.y, -a.z}; }

// K - [r] I [r]: the rotation that an impulse at the arm r causes adds to the response of its point
FE_INLINE wide_sym add_arm(wide_sym k, const wide_sym *i, wide3 r)
{
    wide t00 = r.y * i->xz - r.z * i->xy, t01 = r.y * i->yz - r.z * i->yy, t02 = r.y * i->zz - r.z * i->yz;
    wide t10 = r.z * i->xx - r.x * i->xz, t11 = r.z * i->xy - r.x * i->yz, t12 = r.z * i->xz - r.x * i->zz;
    wide t20 = r.x * i->xy - r.y * i->xx, t21 = r.x * i->yy - r.y * i->xy;
    k.xx = k.xx + (t02 * r.y - t01 * r.z);
    k.xy = k.xy + (t00 * r.z - t02 * r.x);
    k.xz = k.xz + (t01 * r.x - t00 * r.y);
    k.yy = k.yy + (t10 * r.z - t12 * r.x);
    k.yz = k.yz + (t11 * r.x - t10 * r.y);
    k.zz = k.zz + (t21 * r.x - t20 * r.y);
    return k;
}

// velocity of B's point against A's
FE_INLINE wide3 speed_between(const ends *e, wide3 ra, wide3 rb)
{
    return w_sub(w_add(e->b.v, w_cross(e->b.w, rb)), w_add(e->a.v, w_cross(e->a.w, ra)));
}

// ---- a vector that rotates with a body ------------------------------------------------------------------------------
FE_INLINE wide3 rotate_with(const fe__solver *s, const int32_t *line, wide3 first)
{
    return w_turn(gather_high(s->motion, line), first);
}

// anchors, by their arms from the centres, in world axes
typedef struct {
    wide3 ra, rb, gap; // gap: anchor of B - anchor of A
} anchors;

FE_INLINE anchors anchors_now(const fe__solver *s, const line_pair *line, const anchors *first)
{
    wide4 pa, pb, qa, qb;
    gather_line(s->motion, line->a, &pa, &qa), gather_line(s->motion, line->b, &pb, &qb);
    wide3 ta = w_turn(qa, first->ra), tb = w_turn(qb, first->rb);
    return (anchors){w_add(first->ra, ta), w_add(first->rb, tb),
                     w_add(first->gap, w_add(w_sub(w_xyz(pb), w_xyz(pa)), w_sub(tb, ta)))};
}

// ---- records --------------------------------------------------------------------------------------------------------

// The joints of a row, and where their records are.
// Padding lanes stand for the first lane's joint, on lines of their own that nothing moves; they are never stored.
typedef struct {
    const fe__records *of[FE_W];
    int32_t index[FE_W];
    void *joint[FE_W], *body_a[FE_W], *body_b[FE_W], *frame[FE_W], *axes[FE_W], *reaction[FE_W];
    int32_t real; // lanes before the padding
} row_joints;

FE_INLINE row_joints name_joints(const fe__records *of, const fe__lane *lanes)
{
    row_joints r;
    r.real = 0;
    for (int i = 0; i < FE_W; ++i) {
        const fe__lane *lane = lanes[i].contact ? lanes + i : lanes;
        r.of[i] = of + lane->home, r.index[i] = lane->contact;
        r.joint[i] = r.of[i]->joints.joints + lane->contact;
        r.real += lanes[i].contact != 0;
    }
    return r;
}

FE_INLINE row_joints joints_of(const fe__records *of, const fe__lane *lanes, line_pair *line, int32_t prefetch)
{
    row_joints r = name_joints(of, lanes);
    for (int i = 0; i < FE_W; ++i) {
        const fe__lane *next = lanes + FE_W + i;
        if (prefetch) __builtin_prefetch(of[next->home].joints.joints + next->contact);
        line->a[i] = lanes[i].line_a, line->b[i] = lanes[i].line_b;
        const fe__joint *joint = r.joint[i];
        r.body_a[i] = r.of[i]->bodies + joint->body_a, r.body_b[i] = r.of[i]->bodies + joint->body_b;
    }
    return r;
}

FE_INLINE void find_frames(row_joints *r)
{
    for (int i = 0; i < FE_W; ++i) r->frame[i] = r->of[i]->joints.frames + r->index[i];
}

FE_INLINE void find_axes(row_joints *r)
{
    for (int i = 0; i < FE_W; ++i) r->axes[i] = r->of[i]->joints.axes + r->of[i]->joints.frames[r->index[i]].axes;
}

FE_INLINE void find_reactions(row_joints *r)
{
    for (int i = 0; i < FE_W; ++i) r->reaction[i] = r->of[i]->joints.reactions + r->index[i];
}

FE_INLINE size_t axis_offset(int slot)
{
    return offsetof(fe__joint_axes, axis) + (size_t)slot * sizeof(fe__joint_axis);
}

#define JOINT_QUAD(field) w_gather_from(r->joint, offsetof(fe__joint, field))
#define FRAME_QUAD(field) w_gather_from(r->frame, offsetof(fe__joint_frame, field))
#define AXES_QUAD(field) w_gather_from(r->axes, offsetof(fe__joint_axes, field))
#define AXIS_QUAD(slot, field) w_gather_from(r->axes, axis_offset(slot) + offsetof(fe__joint_axis, field))
#define BODY_QUAD(field, body) w_gather_from(body, offsetof(fe__body, field))

// to those that are no padding
static void put_lanes(void *const *at, size_t offset, int32_t real, wide4 a)
{
    _Alignas(64) float lane[FE_W][4];
    w_scatter(lane[0], 4, w_in_order, a);
    for (int i = 0; i < real; ++i) *(quad *)(void *)((char *)at[i] + offset) = *(const quad *)lane[i];
}

FE_INLINE wide3 turned(wide4 q, wide3 a) { return w_add(a, w_turn(q, a)); }

// The gap of joints with something that is not dynamic, whose anchor may be far from its centre: in double.
static wide3 gap_in_double(const row_joints *r)
{
    _Alignas(64) float gap[3][FE_W];
    for (int i = 0; i < FE_W; ++i) {
        fe_vec3 d = fe__narrow(fe__joint_gap(r->joint[i], r->of[i]->bodies));
        gap[0][i] = d.x, gap[1][i] = d.y, gap[2][i] = d.z;
    }
    return (wide3){*(wide *)gap[0], *(wide *)gap[1], *(wide *)gap[2]};
}

FE_INLINE anchors first_anchors(const row_joints *r, int sides)
{
    wide4 qa = BODY_QUAD(rotation, r->body_a), qb = BODY_QUAD(rotation, r->body_b);
    anchors f = {turned(qa, w_xyz(JOINT_QUAD(arm_a))), turned(qb, w_xyz(JOINT_QUAD(arm_b))), w_zero3()};
    if (sides != BOTH_SIDES) {
        f.gap = gap_in_double(r);
        return f;
    }
    wide3 high = w_sub(w_xyz(BODY_QUAD(centre_high, r->body_b)), w_xyz(BODY_QUAD(centre_high, r->body_a)));
    wide3 low = w_sub(w_xyz(BODY_QUAD(centre_low, r->body_b)), w_xyz(BODY_QUAD(centre_low, r->body_a)));
    f.gap = w_add(w_add(high, w_sub(f.rb, f.ra)), low);
    return f;
}

// from the sum of a step's impulses to the mean force
FE_INLINE float mean_of(const fe__step_constants *c) { return c->inverse_h / (float)c->substeps; }

// Stored impulses are those of the world's substeps
FE_INLINE wide stored_of(const fe__step_constants *c) { return w_set((float)c->division); }

// Joints of a row that are open too wide mark their bodies
static __attribute__((noinline)) void mark_stretched(fe__solver *s, const fe__lane *lanes, wide_mask open)
{
    _Alignas(64) float is[FE_W];
    *(wide *)is = w_choose(open, w_set(1.0f), w_set(0.0f));
    for (int i = 0; i < FE_W; ++i)
        if (is[i] != 0.0f && lanes[i].contact) mark_stretched_ends(s, lanes[i].line_a, lanes[i].line_b);
}

FE_INLINE void find_stretch(fe__solver *s, const fe__lane *lanes, wide3 gap, const fe__step_constants *c)
{
    wide_mask open = w_greater(w_dot(gap, gap), w_set(c->open));
    if (w_any(open)) mark_stretched(s, lanes, open);
}

// ---- softness -------------------------------------------------------------------------------------------------------

// change = -m ((1 - fade) v + rate C) - fade l. With w = 2 pi hertz:  fade = 1 / (1 + h w (2 zeta + h w)),  rate = h
// w^2 fade A stiffness of its own is a spring, which swings: the relax pass leaves it alone. The world's is a lock that
// gives. Between them, from half of the stiffness that the substeps allow (w h = pi / 4: eight substeps to a period, of
// which the implicit step damps half of critical anyway), a spring takes a growing share of the relax pass, and all of
// it at the most stiff: rows that fight over long arms, and see each other only once a substep, otherwise gain energy.
typedef struct {
    wide rate, fade;
    wide rigid; // the share of the relax pass: 1 for a lock, 0 for a spring
} lane_softness;

// hertz 0: as `otherwise`
FE_INLINE lane_softness softness_of(wide hertz, wide ratio, const lane_softness *otherwise, const fe__step_constants *c)
{
    wide omega = 2.0f * FE_PI * w_min(hertz, w_set(c->joint_hertz));
    wide fade = 1.0f / (1.0f + c->h * omega * (2.0f * ratio + c->h * omega));
    wide rigid = w_clamp(hertz * (2.0f / c->joint_hertz) - 1.0f, w_set(0.0f), w_set(1.0f));
    wide_mask own = w_greater(hertz, w_set(0.0f));
    return (lane_softness){w_choose(own, c->h * omega * omega * fade, otherwise->rate),
                           w_choose(own, fade, otherwise->fade), w_choose(own, rigid, otherwise->rigid)};
}

// of a joint's locks
FE_INLINE lane_softness lock_softness(const row_joints *r, const fe__step_constants *c)
{
    lane_softness world = {w_set(c->joint.mass_scale * c->joint.bias_rate), w_set(c->joint.impulse_scale), w_set(1.0f)};
    return softness_of(JOINT_QUAD(arm_a).w, JOINT_QUAD(arm_b).w, &world, c);
}

// the same for any size
FE_INLINE wide_sym inverse_scaled(const wide_sym *m)
{
    wide k = w_inverse_or_zero(m->xx + m->yy + m->zz);
    wide_sym i = {k * m->xx, k * m->xy, k * m->xz, k * m->yy, k * m->yz, k * m->zz};
    i = w_inverse_sym(&i);
    return (wide_sym){k * i.xx, k * i.xy, k * i.xz, k * i.yy, k * i.yz, k * i.zz};
}

FE_INLINE wide trace(const wide_sym *k) { return k->xx + k->yy + k->zz; }

// Locked bodies may leave a matrix without an inverse: then what cannot move gives a little, as a share of what can.
// Others keep theirs.
#define LOCKED_GIVE 1e-4f
FE_INLINE wide_sym give(wide_sym k, wide all, wide_mask locked)
{
    wide more = w_choose(locked, LOCKED_GIVE * all, w_set(0.0f));
    k.xx = k.xx + more, k.yy = k.yy + more, k.zz = k.zz + more;
    return k;
}
// Of the response of all axes: a smaller one is what rounding left of a locked direction
#define LOCKED_RESPONSE 1e-6f

// Where bodies are locked, only rotations respond along some axes: little in one pose, nothing in the next. Stiffness
// goes by K^-1, so that a gap opened where the point gives would be a hundred times the energy where it does not:
// linkages of locked bodies flew apart. So a locked axis responds by a share of what all others do, in proportion to
// the part of the inverse mass that is locked.
#define LOCKED_SHARE 0.1f
FE_INLINE wide_sym give_locked(wide_sym k, wide3 mass, wide unlocked)
{
    wide more = LOCKED_SHARE * trace(&k) * w_inverse_or_zero(unlocked);
    k.xx = k.xx + more * (unlocked - mass.x), k.yy = k.yy + more * (unlocked - mass.y),
    k.zz = k.zz + more * (unlocked - mass.z);
    return k;
}

// likewise about an axis whose rotation is locked at both ends
FE_INLINE wide_sym give_locked_rotations(wide_sym k, wide locked)
{
    const wide zero = w_set(0.0f), all = trace(&k), share = w_choose(w_greater(locked, zero), LOCKED_SHARE * all, zero),
               least = LOCKED_RESPONSE * all;
    k.xx = k.xx + w_choose(w_greater(k.xx, least), zero, share);
    k.yy = k.yy + w_choose(w_greater(k.yy, least), zero, share);
    k.zz = k.zz + w_choose(w_greater(k.zz, least), zero, share);
    return k;
}

FE_INLINE wide_sym sum_sym(const wide_sym *a, const wide_sym *b)
{
    return (wide_sym){a->xx + b->xx, a->xy + b->xy, a->xz + b->xz, a->yy + b->yy, a->yz + b->yz, a->zz + b->zz};
}

// ---- rotations ------------------------------------------------------------------------------------------------------
FE_INLINE wide4 load4(const wide *p) { return (wide4){p[0], p[1], p[2], p[3]}; }
FE_INLINE void store4(wide *p, wide4 a) { p[0] = a.x, p[1] = a.y, p[2] = a.z, p[3] = a.w; }
FE_INLINE wide4 first_frame(void *const *body, wide4 frame) { return w_product(BODY_QUAD(rotation, body), frame); }
FE_INLINE wide4 frame_now(const fe__solver *s, const int32_t *line, const wide *first)
{
    return w_product(gather_high(s->motion, line), load4(first));
}

// the same rotation with w >= 0
FE_INLINE wide4 positive(wide4 q)
{
    wide sign = w_choose(w_greater(w_set(0.0f), q.w), w_set(-1.0f), w_set(1.0f));
    return (wide4){sign * q.x, sign * q.y, sign * q.z, sign * q.w};
}

// The angle of (x, y) from the x axis, x >= 0: from -pi/2 to pi/2, error below 2e-7. atan(t) = t + t^3 P(t^2) for |t|
// <= tan(pi/8), P by Remez exchange with a relative error of 7e-10; beyond it around pi/4.
FE_INLINE wide w_atan2(wide y, wide x)
{
    wide one = w_set(1.0f), height = w_abs(y);
    wide_mask steep = w_greater(height, x);
    wide t = w_choose(steep, x, height) / w_max(w_choose(steep, height, x), w_set(FLT_MIN));
    wide_mask far = w_greater(t, w_set(0.41421356f));
    wide u = w_choose(far, (t - one) / (t + one), t), z = u * u;
    wide p = -0.0607850988f * z + 0.105939222f;
    p = p * z - 0.142435472f;
    p = p * z + 0.199984722f;
    p = p * z - 0.333333152f;
    wide a = u + u * z * p;
    a = w_choose(far, a + 0.25f * FE_PI, a);
    a = w_choose(steep, 0.5f * FE_PI - a, a);
    return w_choose(w_greater(w_set(0.0f), y), -a, a);
}

// nearest whole number, for |a| < 2^22: adding 1.5 * 2^23 leaves no bits for a fraction
FE_INLINE wide w_round(wide a)
{
    wide magic = w_set(12582912.0f);
    return (a + magic) - magic;
}

// inverse masses along the world's axes
FE_INLINE wide3 free_mass(const side *b)
{
    _Alignas(64) float mass[3][FE_W], locks[FE_W], inverse[FE_W];
    *(wide *)locks = b->locks, *(wide *)inverse = b->inverse_mass;
    for (int i = 0; i < FE_W; ++i)
        for (int k = 0; k < 3; ++k) mass[k][i] = (int)locks[i] >> k & 1 ? 0.0f : inverse[i];
    return (wide3){*(wide *)mass[0], *(wide *)mass[1], *(wide *)mass[2]};
}

FE_INLINE wide3 frame_axis(wide4 q, int k)
{
    wide3 e = w_zero3();
    if (k == 0) e.x = w_set(1.0f);
    if (k == 1) e.y = w_set(1.0f);
    if (k == 2) e.z = w_set(1.0f);
    return turned(q, e);
}

// ---- bodies that only rotate ----------------------------------------------------------------------------------------
typedef struct {
    wide3 a, b;
    wide locks_a, locks_b;
} spins;

FE_INLINE spins gather_spins(const void *lines, const line_pair *line)
{
    wide4 a = gather_high(lines, line->a), b = gather_high(lines, line->b);
    return (spins){w_xyz(a), w_xyz(b), a.w, b.w};
}

FE_INLINE void scatter_spins(void *lines, const line_pair *line, const spins *e, int sides)
{
    if (sides & FE__MOVES_A) scatter_high(lines, line->a, w_with(e->a, e->locks_a));
    if (sides & FE__MOVES_B) scatter_high(lines, line->b, w_with(e->b, e->locks_b));
}

// ---- inertia that rotates -------------------------------------------------------------------------------------------
// > 0 where a body's inertia is not that of a ball
FE_INLINE wide shape_of(const fe__solver *s, const line_pair *line)
{
    return gather_high(s->inertia, line->a).z + gather_high(s->inertia, line->b).z;
}

FE_INLINE wide_sym change_inertia(const fe__solver *s, const int32_t *line, wide_mask shaped, wide_sym *inertia)
{
    wide4 turn = gather_high(s->motion, line);
    wide_mask turns = w_and(shaped, w_greater(w_dot(w_xyz(turn), w_xyz(turn)), w_set(FE__ROTATED)));
    wide_sym was = *inertia, zero = {w_set(0), w_set(0), w_set(0), w_set(0), w_set(0), w_set(0)};
    if (!w_any(turns)) return zero;
    wide_sym now = turned_inertia(s, line, turn, gather_high(s->velocity, line).w);
    *inertia =
        (wide_sym){w_choose(turns, now.xx, was.xx), w_choose(turns, now.xy, was.xy), w_choose(turns, now.xz, was.xz),
                   w_choose(turns, now.yy, was.yy), w_choose(turns, now.yz, was.yz), w_choose(turns, now.zz, was.zz)};
    now = *inertia;
    return (wide_sym){now.xx - was.xx, now.xy - was.xy, now.xz - was.xz,
                      now.yy - was.yy, now.yz - was.yz, now.zz - was.zz};
}

// The inertias that a row copied follow the rotation of its bodies: with those of the step's beginning, a rod that
// spins in a chain gains energy. start takes what that changes in the effect of the row's moments.
static void follow_inertia(const fe__solver *s, const line_pair *line, wide shaped, wide_sym *a, wide_sym *b,
                           wide3 moment_a, wide3 moment_b, int sides)
{
    wide_mask lanes = w_greater(shaped, w_set(0.0f));
    if (!w_any(lanes)) return;
    wide_sym change_a = change_inertia(s, line->a, lanes, a), change_b = change_inertia(s, line->b, lanes, b);
    spins start = gather_spins(s->start, line);
    start.a = w_add(start.a, w_mul(&change_a, moment_a)), start.b = w_sub(start.b, w_mul(&change_b, moment_b));
    scatter_spins(s->start, line, &start, sides);
}
#define FOLLOW_INERTIA(row, moment_a, moment_b) \
    follow_inertia(s, &(row)->line, (row)->shaped, &(row)->inertia_a, &(row)->inertia_b, moment_a, moment_b, sides)

// a torque on B, its opposite on A
FE_INLINE void twist_ends(spins *e, const wide_sym *inertia_a, const wide_sym *inertia_b, wide3 torque)
{
    e->a = w_sub(e->a, w_mul(inertia_a, torque));
    e->b = w_add(e->b, w_mul(inertia_b, torque));
}
