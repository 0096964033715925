// joint_wide.h - what rows of joints share: bodies in and out, records in and out, softness. Part of joint.simd.c.
//
// Arms and axes turn with their bodies in every substep (frozen ones gain energy: a chain explodes). All that follows from positions is
// found once per substep, in relax, and serves the next solve too, which reads no motion.
//
// From the second substep the warm start is what the bodies carry, v - start (bodies.simd.c): J_old^T l of the impulse l that a joint held
// when its arms turned. It should be J_new^T l. Relax moves `start` by the difference, -M^-1 (J_new - J_old)^T l, so that every warm start
// is complete before the first constraint of the next substep is solved.

typedef struct {
    int32_t a[FE_W], b[FE_W];
} line_pair;

typedef struct {
    side a, b;
} ends;

enum {
    JOINT_STRIDE = sizeof(fe__joint) / sizeof(float),
    FRAME_STRIDE = sizeof(fe__joint_frame) / sizeof(float),
    REACTION_STRIDE = sizeof(fe__joint_reaction) / sizeof(float),
    AXES_STRIDE = sizeof(fe__joint_axes) / sizeof(float),
    BODY_STRIDE = sizeof(fe__body) / sizeof(float),
    BOTH_SIDES = FE__MOVES_A | FE__MOVES_B
};

// ---- bodies
// ------------------------------------------------------------------------------------------------------------------------------
FE_INLINE ends gather_ends(const fe__solver *s, const line_pair *line) { return (ends){gather_side(s, line->a), gather_side(s, line->b)}; }

// what does not move is never written: all workers read it
FE_INLINE void scatter_ends(float (*lines)[FE__LINE], const line_pair *line, const ends *e, int sides)
{
    if (sides & FE__MOVES_A) scatter_side(lines, line->a, &e->a);
    if (sides & FE__MOVES_B) scatter_side(lines, line->b, &e->b);
}

FE_INLINE wide3 minus(wide3 a) { return (wide3){-a.x, -a.y, -a.z}; }

// of what is positive; of a denormal the quotient may be infinite
FE_INLINE wide inverse_or_zero(wide a) { return w_choose(w_greater(a, w_set(FLT_MIN)), 1.0f / a, w_set(0.0f)); }

// inverse of a symmetric positive matrix by cofactors; zero where it is singular
FE_INLINE wide_sym inverse_sym(const wide_sym *m)
{
    wide cxx = m->yy * m->zz - m->yz * m->yz, cxy = m->xz * m->yz - m->xy * m->zz, cxz = m->xy * m->yz - m->xz * m->yy;
    wide k = inverse_or_zero(m->xx * cxx + m->xy * cxy + m->xz * cxz);
    return (wide_sym){k * cxx,
                      k * cxy,
                      k * cxz,
                      k * (m->xx * m->zz - m->xz * m->xz),
                      k * (m->xy * m->xz - m->xx * m->yz),
                      k * (m->xx * m->yy - m->xy * m->xy)};
}

// K - [r] I [r]: what an impulse at the arm r turns adds to the response of its point
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

// ---- a vector that turns with a body
// -----------------------------------------------------------------------------------------------------
FE_INLINE wide3 turn_of(const fe__solver *s, const int32_t *line, wide3 first) { return w_turn(gather_high(s->motion, line), first); }

// anchors, by their arms from the centres, in world axes
typedef struct {
    wide3 ra, rb, gap; // gap: anchor of B - anchor of A
} anchors;

FE_INLINE anchors anchors_now(const fe__solver *s, const line_pair *line, const anchors *first)
{
    wide3 pa = w_xyz(gather_low(s->motion, line->a)), pb = w_xyz(gather_low(s->motion, line->b));
    wide3 ta = turn_of(s, line->a, first->ra), tb = turn_of(s, line->b, first->rb);
    return (anchors){w_add(first->ra, ta), w_add(first->rb, tb), w_add(first->gap, w_add(w_sub(pb, pa), w_sub(tb, ta)))};
}

// ---- records
// ------------------------------------------------------------------------------------------------------------------------------ The joints
// of a row. Padding lanes stand for the first lane's joint, on lines of their own that nothing moves; they are never stored.
typedef struct {
    int32_t joint[FE_W], body_a[FE_W], body_b[FE_W], axes[FE_W];
    int32_t real; // lanes before the padding
} row_joints;

FE_INLINE row_joints joints_of(const fe__joints *joints, const fe__lane *lanes, line_pair *line, int32_t prefetch)
{
    row_joints r = {.real = 0};
    for (int i = 0; i < FE_W; ++i) {
        if (prefetch) __builtin_prefetch(joints->joints + lanes[FE_W + i].contact);
        r.joint[i] = lanes[i].contact ? lanes[i].contact : lanes[0].contact;
        r.real += lanes[i].contact != 0;
        line->a[i] = lanes[i].line_a, line->b[i] = lanes[i].line_b;
        r.body_a[i] = joints->joints[r.joint[i]].body_a, r.body_b[i] = joints->joints[r.joint[i]].body_b;
    }
    return r;
}

#define JOINT_QUAD(field) w_gather(joints->joints->field, JOINT_STRIDE, r->joint)
#define FRAME_QUAD(field) w_gather(joints->frames->field, FRAME_STRIDE, r->joint)
#define AXES_QUAD(field) w_gather(joints->axes->field, AXES_STRIDE, r->axes)
#define BODY_QUAD(field, body) w_gather(bodies->field, BODY_STRIDE, body)

static void put_lanes(float *base, int stride, const int32_t *index, int32_t real, wide4 a)
{
    static const int32_t in_order[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    if (real == FE_W) {
        w_scatter(base, stride, index, a);
        return;
    }
    _Alignas(64) float lane[FE_W][4];
    w_scatter(lane[0], 4, in_order, a);
    for (int i = 0; i < real; ++i) *(quad *)(base + (intptr_t)index[i] * stride) = *(const quad *)lane[i];
}

FE_INLINE wide3 turned(wide4 q, wide3 a) { return w_add(a, w_turn(q, a)); }

// The gap of joints with something that is not dynamic, whose anchor may be far from its centre: in double.
static wide3 gap_in_double(const fe__joints *joints, const fe__body *bodies, const row_joints *r)
{
    _Alignas(64) float gap[3][FE_W];
    for (int i = 0; i < FE_W; ++i) {
        fe_vec3 d = fe__narrow(fe__joint_gap(joints->joints + r->joint[i], bodies));
        gap[0][i] = d.x, gap[1][i] = d.y, gap[2][i] = d.z;
    }
    return (wide3){*(wide *)gap[0], *(wide *)gap[1], *(wide *)gap[2]};
}

FE_INLINE anchors first_anchors(const fe__joints *joints, const fe__body *bodies, const row_joints *r, int sides)
{
    wide4 qa = BODY_QUAD(rotation, r->body_a), qb = BODY_QUAD(rotation, r->body_b);
    anchors f = {turned(qa, w_xyz(JOINT_QUAD(arm_a))), turned(qb, w_xyz(JOINT_QUAD(arm_b))), w_zero3()};
    if (sides != BOTH_SIDES) {
        f.gap = gap_in_double(joints, bodies, r);
        return f;
    }
    wide3 high = w_sub(w_xyz(BODY_QUAD(centre_high, r->body_b)), w_xyz(BODY_QUAD(centre_high, r->body_a)));
    wide3 low = w_sub(w_xyz(BODY_QUAD(centre_low, r->body_b)), w_xyz(BODY_QUAD(centre_low, r->body_a)));
    f.gap = w_add(w_add(high, w_sub(f.rb, f.ra)), low);
    return f;
}

// from the sum of a step's impulses to the mean force
FE_INLINE float mean_of(const fe__step_constants *c) { return c->inverse_h / (float)c->substeps; }
