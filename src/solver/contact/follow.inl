// follow.inl - effective masses of a row, and arms and inertia that follow the bodies within a step. Part of
// contact_rows.inl, once per number of points.
//
// Impulses keep the angular momentum of two bodies only while they act at one point of space, and their energy only
// with the inertia of where the bodies are. So each substep, after the bodies moved, points and inertia are set anew,
// in lanes whose bodies rotate or shift enough to show. Arms rotate within the step only, from those it began with, see
// contact_solver.h.

FE_INLINE arm NAMED(arm_of)(const ROW *row, wide3 r, wide3 span, wide3 direction, int kind)
{
    arm m = {w_zero3(), w_cross(w_add(r, span), direction), w_zero3(), w_zero3()};
    m.spin_b = w_mul(&row->inertia_b, m.b);
    if (kind & FE__ROW_PAIR) {
        m.a = w_cross(r, direction);
        m.spin_a = w_mul(&row->inertia_a, m.a);
    }
    return m;
}

// u . (MA^-1 + MB^-1) v of the centres of mass
FE_INLINE wide NAMED(linear_response)(const ROW *row, const pair *p, wide3 u, wide3 v, wide uv, int kind)
{
    const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
    if (kind & FE__ROW_SPECIAL) return w_dot(u, w_times(w_add(load3(x->mass_a), load3(x->mass_b)), v));
    return (kind & FE__ROW_PAIR ? p->a.inverse_mass + p->b.inverse_mass : p->b.inverse_mass) * uv;
}

// 1 / k. Where locks leave nothing to move, k is 0 or what rounding left of it: then 0
FE_INLINE wide NAMED(mass_along)(const pair *p, wide k, int kind)
{
    wide least = kind & FE__ROW_SPECIAL ? LEAST_RESPONSE * (p->a.inverse_mass + p->b.inverse_mass) : w_set(0.0f);
    return w_choose(w_greater(k, least), w_inverse_or_zero(k), w_set(0.0f));
}

// Inverse of the 2 x 2 matrix of the tangents. Where locks leave one direction u to slide in, it is k u u^T up to
// rounding, whose inverse would fill the friction cone with noise across u: the pseudo-inverse, itself over the square
// of its trace, knows u only.
FE_INLINE void NAMED(invert_tangents)(MASSES *out, const pair *p, wide k11, wide k12, wide k22, int kind)
{
    wide det = k11 * k22 - k12 * k12, inverse = w_inverse_or_zero(det), trace = k11 + k22;
    out->tangent[0] = inverse * k22;
    out->tangent[1] = -(inverse * k12);
    out->tangent[2] = inverse * k11;
    if (!(kind & FE__ROW_SPECIAL)) return;
    wide over_trace = NAMED(mass_along)(p, trace, kind);
    wide_mask two_ways = w_greater(det, ONE_WAY * trace * trace);
    out->tangent[0] = w_choose(two_ways, out->tangent[0], over_trace * k11 * over_trace);
    out->tangent[1] = w_choose(two_ways, out->tangent[1], over_trace * k12 * over_trace);
    out->tangent[2] = w_choose(two_ways, out->tangent[2], over_trace * k22 * over_trace);
}

FE_INLINE void NAMED(find_friction_masses)(const ROW *row, const pair *p, int kind, MASSES *out)
{
    wide zero = w_set(0.0f), one = w_set(1.0f);
    wide3 t1, t2, centre = load3(row->centre);
    tangents(p->normal, &t1, &t2);
    arm m1 = NAMED(arm_of)(row, centre, p->span, t1, kind), m2 = NAMED(arm_of)(row, centre, p->span, t2, kind);
    wide k11 = NAMED(linear_response)(row, p, t1, t1, one, kind) + angular_response(&m1, &m1, kind);
    wide k22 = NAMED(linear_response)(row, p, t2, t2, one, kind) + angular_response(&m2, &m2, kind);
    wide k12 = NAMED(linear_response)(row, p, t1, t2, zero, kind) + angular_response(&m1, &m2, kind);
    k12 = w_flush(k12, FE__LEAST_LEAN * (k11 + k22));
    NAMED(invert_tangents)(out, p, k11, k12, k22, kind);
    arm spin = {p->normal, p->normal, w_zero3(), w_mul(&row->inertia_b, p->normal)};
    if (kind & FE__ROW_PAIR) spin.spin_a = w_mul(&row->inertia_a, p->normal);
    out->twist = w_inverse_or_zero(angular_response(&spin, &spin, kind));
    out->twist_tangent[0] = angular_response(&m1, &spin, kind);
    out->twist_tangent[1] = angular_response(&m2, &spin, kind);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        wide3 d = w_sub(load3(row->point[i].r), centre);
        out->lever[i] = w_sqrt(w_dot(d, d));
    }
}

// a point whose mass is 0 is not there
FE_INLINE void NAMED(find_masses)(const ROW *row, const pair *p, int kind, MASSES *out)
{
    wide zero = w_set(0.0f), linear = NAMED(linear_response)(row, p, p->normal, p->normal, w_set(1.0f), kind);
    arm arms[POINTS];
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        const contact_point *q = row->point + i;
        arms[i] = NAMED(arm_of)(row, load3(q->r), p->span, p->normal, kind);
        wide mass = NAMED(mass_along)(p, linear + angular_response(arms + i, arms + i, kind), kind);
        out->point[i] = w_choose(w_greater(q->mass, zero), mass, zero);
        UNROLL for (int j = 0; j < i; ++j) out->coupling[coupling_of[j][i]] =
            out->point[i] * (linear + angular_response(arms + j, arms + i, kind));
    }
    NAMED(find_friction_masses)(row, p, kind, out);
}

FE_INLINE void NAMED(store_masses)(ROW *row, const MASSES *m, wide_mask lanes)
{
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        row->point[i].mass = w_choose(lanes, m->point[i], row->point[i].mass);
        row->lever[i] = w_choose(lanes, m->lever[i], row->lever[i]);
    }
    UNROLL for (int i = 0; i < (POINTS == 1 ? 0 : 6); ++i) row->coupling[i] =
        w_choose(lanes, m->coupling[i], row->coupling[i]);
    UNROLL for (int i = 0; i < 3; ++i) row->tangent_mass[i] = w_choose(lanes, m->tangent[i], row->tangent_mass[i]);
    UNROLL for (int i = 0; i < 2; ++i) row->twist_tangent[i] =
        w_choose(lanes, m->twist_tangent[i], row->twist_tangent[i]);
    row->twist_mass = w_choose(lanes, m->twist, row->twist_mass);
}

// A locked rotation has no inverse inertia: a little of the trace keeps the sum invertible, and what is locked does not
// spin anyway
FE_INLINE void NAMED(find_rolling_masses)(SPECIAL_ROW *x, const pair *p, wide_mask lanes, int kind)
{
    wide_sym k = x->row.inertia_b;
    if (kind & FE__ROW_PAIR) {
        const wide_sym *a = &x->row.inertia_a;
        k = (wide_sym){k.xx + a->xx, k.xy + a->xy, k.xz + a->xz, k.yy + a->yy, k.yz + a->yz, k.zz + a->zz};
    }
    x->spinning_mass = w_choose(lanes, w_inverse_or_zero(w_dot(p->normal, w_mul(&k, p->normal))), x->spinning_mass);
    wide some = REGULAR * (k.xx + k.yy + k.zz);
    k.xx = k.xx + some, k.yy = k.yy + some, k.zz = k.zz + some;
    wide_sym inverse = w_inverse_sym(&k);
    x->rolling_mass = choose_sym(lanes, &inverse, &x->rolling_mass);
}

// ---- all impulses of a contact --------------------------------------------------------------------------------------
FE_INLINE wide3 NAMED(friction_impulse)(const ROW *row, wide3 normal)
{
    wide3 t1, t2;
    tangents(normal, &t1, &t2);
    return w_add_scaled(w_scale(row->tangent_impulse[0], t1), row->tangent_impulse[1], t2);
}

// their moment on B about A's centre
FE_INLINE wide3 NAMED(moment_of)(const ROW *row, wide3 normal, wide3 friction, int kind)
{
    wide3 moment = w_zero3();
    UNROLL for (int i = 0; i < POINTS; ++i) moment =
        w_add_scaled(moment, row->point[i].impulse, load3(row->point[i].r));
    moment = w_add(w_cross(moment, normal), w_cross(load3(row->centre), friction));
    moment = w_add_scaled(moment, row->twist_impulse, normal);
    return kind & FE__ROW_SPECIAL ? w_add(moment, load3(((const SPECIAL_ROW *)row)->rolling_impulse)) : moment;
}

FE_INLINE wrench NAMED(wrench_of)(const ROW *row, wide3 normal, int kind)
{
    wide3 friction = NAMED(friction_impulse)(row, normal);
    return (wrench){w_add_scaled(friction, NAMED(load_of)(row), normal), NAMED(moment_of)(row, normal, friction, kind)};
}

FE_INLINE void NAMED(apply_all)(const ROW *row, pair *p, int kind)
{
    wrench all = NAMED(wrench_of)(row, p->normal, kind);
    NAMED(apply)(row, p, all.impulse, all.moment, kind);
}

// ---- points ---------------------------------------------------------------------------------------------------------
// The one point of space at which two surfaces touch. A round side takes it along when it rolls over a flat one. Of two
// alike each has it on its own side, and it is between: of flat ones in the inverse ratio of the squares of its arms,
// as what slides over something larger takes it along. Weight of B's: all of it where A is static, whose arms count
// from B's centre.
FE_INLINE wide NAMED(weight_of_b)(const ROW *row, wide_mask is_static, int kind)
{
    wide zero = w_set(0.0f), one = w_set(1.0f);
    if (!(kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))) return one;
    wide_mask a = w_greater(row->round_a, zero), b = w_greater(row->round_b, zero);
    wide3 arm_a = load3(row->first_a[POINTS]), arm_b = load3(row->first_b[POINTS]);
    wide square = w_dot(arm_a, arm_a);
    wide between = w_choose(a, w_set(0.5f), square * w_inverse_or_zero(square + w_dot(arm_b, arm_b)));
    wide weight = w_choose(w_and(b, w_not(a)), one, w_choose(w_and(a, w_not(b)), zero, between));
    return w_choose(is_static, one, weight);
}

// Lanes whose arms count from B's centre. A kinematic body that sleeps reads the line of static ones, but its arms
// count from its own centre, as those of any body that may move: only a static A has no span.
FE_INLINE wide_mask NAMED(static_lanes)(const ROW *row)
{
    _Alignas(64) float is_static[FE_W];
    for (int i = 0; i < FE_W; ++i) is_static[i] = row->line_a[i] == FE__STATIC_LINE ? 1.0f : 0.0f;
    wide3 span = load3(row->start_span);
    return w_and(w_greater(*(const wide *)is_static, w_set(0.0f)), w_not(w_greater(w_dot(span, span), w_set(0.0f))));
}

// Lanes that begin to follow keep where their points were: found midway between the surfaces, on both of them. What A's
// and B's slid since then stays between them.
FE_INLINE void NAMED(begin_to_follow)(ROW *row, const wide *apart, wide_mask lanes, int kind)
{
    wide zero = w_set(0.0f);
    wide_mask fresh = w_and(lanes, w_not(w_greater(row->follows, zero)));
    if (!w_any(fresh)) return;
    // other lanes hold what was never written: denormals too
    wide_mask kept = w_greater(row->follows, zero);
    row->follows = w_choose(fresh, w_set(1.0f), row->follows);
    if (NAMED(can_idle)(kind)) {
        row->gap = w_choose(fresh, w_set(-FLT_MAX), row->gap);
        NAMED(note_gaps)(row);
    }
    wide3 n = load3(row->normal);
    UNROLL for (int i = 0; i <= POINTS; ++i)
    {
        wide3 r = load3(i < POINTS ? row->point[i].r : row->centre);
        wide half = 0.5f * apart[i];
        wide3 a = w_sub_scaled(r, half, n), b = w_add_scaled(w_add(r, load3(row->found_span)), half, n);
        store3(row->first_b[i], w_choose3(fresh, b, w_choose3(kept, load3(row->first_b[i]), w_zero3())));
        if (kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))
            store3(row->first_a[i], w_choose3(fresh, a, w_choose3(kept, load3(row->first_a[i]), w_zero3())));
    }
}

// Where the bodies' motion brought point i; returns by how much B's point went from A's along the normal.
FE_INLINE wide NAMED(move_point)(ROW *row, const motion *m, wide3 n, wide3 span, wide weight, int i, wide_mask lanes,
                                 int kind)
{
    wide *r = i < POINTS ? row->point[i].r : row->centre;
    wide3 b = load3(row->first_b[i]), by = w_turn(m->rotation_b, w_add_scaled(b, row->round_b, n));
    wide apart = w_dot(n, w_add(m->shift, by));
    wide3 place = w_add(b, by);
    if (kind & (FE__ROW_PAIR | FE__ROW_SPECIAL)) {
        wide3 a = load3(row->first_a[i]), turned = w_turn(m->rotation_a, w_sub_scaled(a, row->round_a, n));
        wide3 slid = w_sub(load3(row->start_span), load3(row->found_span));
        apart = apart - w_dot(n, turned);
        a = w_add(a, turned), place = w_add(w_sub(place, span), slid);
        place = w_add_scaled(a, weight, w_sub(place, a));
    }
    store3(r, w_choose3(lanes, place, load3(r)));
    return apart;
}

FE_INLINE void NAMED(move_points)(ROW *row, const motion *m, wide3 n, wide_mask lanes, int kind)
{
    wide_mask is_static = kind & FE__ROW_SPECIAL ? NAMED(static_lanes)(row) : no_lane();
    wide weight = NAMED(weight_of_b)(row, is_static, kind);
    wide3 span = w_zero3();
    if (kind & (FE__ROW_PAIR | FE__ROW_SPECIAL)) {
        span = load3(row->start_span);
        span = w_choose3(is_static, span, w_sub(span, m->shift));
        store3(row->span, w_choose3(lanes, span, load3(row->span)));
    }
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        wide distance = row->separation[i] + NAMED(move_point)(row, m, n, span, weight, i, lanes, kind);
        row->point[i].distance = w_choose(lanes, distance, row->point[i].distance);
    }
    NAMED(move_point)(row, m, n, span, weight, POINTS, lanes, kind);
}

// A contact found ahead of time: its points are those of the touch, and found_a, found_b the rotations from there to
// where the bodies are. Until then its points on A and on B are apart.
FE_SMALL static __attribute__((noinline)) void NAMED(place_ahead)(ROW *row, const row_contacts *r, wide_mask lanes,
                                                                  int kind)
{
    wide zero = w_set(0.0f);
    wide3 n = load3(row->normal), span = load3(row->found_span);
    motion back = {w_zero3(), CONTACT_QUAD(found_a), CONTACT_QUAD(found_b)};
    wide apart[POINTS + 1];
    UNROLL for (int i = 0; i < POINTS; ++i) apart[i] = w_gather_from(r->points, point_offset(i)).w;
    apart[POINTS] = apart[0];
    NAMED(begin_to_follow)(row, apart, lanes, kind);
    UNROLL for (int i = 0; i <= POINTS; ++i)
    {
        wide3 a = load3(row->first_a[i]), b = load3(row->first_b[i]);
        b = w_add(b, w_turn(back.rotation_b, w_add_scaled(b, row->round_b, n)));
        store3(row->first_b[i], w_choose3(lanes, b, load3(row->first_b[i])));
        if (!(kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))) continue;
        a = w_add(a, w_turn(back.rotation_a, w_sub_scaled(a, row->round_a, n)));
        store3(row->first_a[i], w_choose3(lanes, a, load3(row->first_a[i])));
    }
    store3(row->found_span, w_choose3(lanes, load3(row->start_span), span));
    motion still = {w_zero3(), {zero, zero, zero, w_set(1.0f)}, {zero, zero, zero, w_set(1.0f)}};
    NAMED(move_points)(row, &still, n, lanes, kind);
}

// ---- within the step ------------------------------------------------------------------------------------------------
// A point of a light wheel that bears a heavy load stays below its axle: beside it, a load of N would turn a wheel of
// radius r and moment I away at a rate of sqrt(N r / I), beyond that of the substeps.
FE_INLINE wide_mask NAMED(moving)(const ROW *row, const motion *m, int kind)
{
    wide_mask moving = w_greater(sine_square(m->rotation_b), row->still_b);
    if (kind & (FE__ROW_PAIR | FE__ROW_SPECIAL)) {
        moving = w_or(moving, w_greater(sine_square(m->rotation_a), row->still_a));
        moving = w_or(moving, w_greater(w_dot(m->shift, m->shift), w_set(FROZEN_SHIFT * FROZEN_SHIFT)));
    }
    if (row->lent) moving = w_and(moving, w_not(lanes_of(row->lent)));
    return w_or(moving, w_greater(row->follows, w_set(0.0f)));
}

// The warm start that the bodies carry is v - start: what changed in it without an impulse, `change` on B, is taken
// from start.
FE_INLINE void NAMED(correct_start)(const fe__solver *s, const int32_t *line, wide3 change, wide_mask lanes)
{
    wide4 w = gather_high(s->start, line);
    wide3 corrected = w_sub(w_xyz(w), change);
    scatter_high(s->start, line, w_with(w_choose3(lanes, corrected, w_xyz(w)), w.w));
}

// Points, span, inertia and masses of the given lanes to where the bodies are. The warm start holds M^-1 J^T l of the
// old ones.
static __attribute__((noinline)) void NAMED(follow)(ROW *row, const fe__solver *s, const motion *m, wide_mask lanes,
                                                    int kind)
{
    pair p = NAMED(gather_pair)(row, s, kind);
    wide3 friction = NAMED(friction_impulse)(row, p.normal),
          impulse = w_add_scaled(friction, NAMED(load_of)(row), p.normal);
    wide3 moment = NAMED(moment_of)(row, p.normal, friction, kind), change_a = w_zero3();
    if (kind & FE__ROW_PAIR) change_a = w_mul(&row->inertia_a, moment);
    wide3 change_b = w_mul(&row->inertia_b, w_add(moment, w_cross(p.span, impulse)));
    NAMED(begin_to_follow)(row, row->separation, lanes, kind);
    NAMED(move_points)(row, m, p.normal, lanes, kind);
    p.span = load3(row->span);
    moment = NAMED(moment_of)(row, p.normal, friction, kind);
    wide_sym b = turned_inertia(s, row->line_b, m->rotation_b, p.b.locks);
    row->inertia_b = choose_sym(lanes, &b, &row->inertia_b);
    NAMED(correct_start)
    (s, row->line_b, w_sub(w_mul(&row->inertia_b, w_add(moment, w_cross(p.span, impulse))), change_b), lanes);
    if (kind & FE__ROW_PAIR) {
        wide_sym a = turned_inertia(s, row->line_a, m->rotation_a, p.a.locks);
        row->inertia_a = choose_sym(lanes, &a, &row->inertia_a);
        NAMED(correct_start)(s, row->line_a, w_sub(change_a, w_mul(&row->inertia_a, moment)), lanes);
    }
    wide most = w_set(0.25f * FROZEN_MASS * FROZEN_MASS),
         angle = w_max(sine_square(m->rotation_a), sine_square(m->rotation_b));
    wide_mask stale = w_and(lanes, w_greater(angle, most));
    if (!w_any(stale)) return;
    MASSES masses;
    NAMED(find_masses)(row, &p, kind, &masses);
    NAMED(store_masses)(row, &masses, stale);
    if (kind & FE__ROW_SPECIAL) NAMED(find_rolling_masses)((SPECIAL_ROW *)row, &p, stale, kind);
}
