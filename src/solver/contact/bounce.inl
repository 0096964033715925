// bounce.inl - restitution. Part of contact_rows.inl, once per number of points.
//
// Relax notes what touches in a substep (record_touch) and stops it. The bounce, after relax, gives the points the
// speeds they leave with, and friction and rolling resistance what all impulses of the touch allow them, those that
// stopped it and those of the bounce.

// faster than `least`
FE_INLINE wide_mask NAMED(touched)(const SPECIAL_ROW *x, float least)
{
    wide approach = x->approach[0];
    UNROLL for (int i = 1; i < POINTS; ++i) approach = w_max(x->approach[i], approach);
    return w_greater(approach, w_set(least));
}

// neither touched nor bears anything
FE_INLINE wide_mask NAMED(may_touch)(const SPECIAL_ROW *x)
{
    wide zero = w_set(0.0f);
    wide_mask idle = w_not(w_or(NAMED(touched)(x, 0.0f), w_greater(NAMED(load_of)(&x->row), zero)));
    return w_and(idle, w_greater(x->row.point[0].mass * x->restitution, zero));
}

// Does a dynamic body of the lane have more than `least` touches in this substep?
FE_INLINE wide_mask NAMED(in_chain)(const SPECIAL_ROW *x, const fe__solver *s, wide_mask lanes, int least, int kind)
{
    _Alignas(64) float most[FE_W];
    for (int i = 0; i < FE_W; ++i) {
        uint8_t of_a = kind & FE__ROW_PAIR ? s->touches_of[x->row.line_a[i]] : 0,
                of_b = s->touches_of[x->row.line_b[i]];
        most[i] = (float)(of_a > of_b ? of_a : of_b);
    }
    return w_and(lanes, w_greater(*(wide *)most, w_set((float)least)));
}

// The touches of a body in this substep, as far as two; colours share no dynamic body.
FE_INLINE void NAMED(count_touches)(const SPECIAL_ROW *x, fe__solver *s, int kind)
{
    wide_mask lanes = NAMED(touched)(x, 0.0f);
    if (!w_any(lanes)) return;
    _Alignas(64) float is[FE_W];
    *(wide *)is = w_choose(lanes, w_set(1.0f), w_set(0.0f));
    for (int i = 0; i < FE_W; ++i) {
        if (is[i] == 0.0f) continue;
        uint8_t *of_a = s->touches_of + x->row.line_a[i], *of_b = s->touches_of + x->row.line_b[i];
        if (kind & FE__ROW_PAIR && *of_a < 2) ++*of_a;
        if (*of_b < 2) ++*of_b;
    }
}

// The speed that a touched point must leave with, at the gap s where it is now:
//     v' = min( sqrt(e^2 Q - 2 g s) + g h / 2,  sqrt(Q - 2 g s) )
// so that it flies to e^2 times the height it fell from, and never has more energy than it came with. Q: record_touch.
// A point that did not touch, faster than `least`, may go on closing its gap, as in relax.
FE_INLINE wide NAMED(bounce_speed)(const SPECIAL_ROW *x, int i, wide distance, float least, const fe__step_constants *c)
{
    wide zero = w_set(0.0f), g = x->closing, gap = w_max(distance, zero), used = 2.0f * g * gap, e = x->restitution,
         q = x->flight[i];
    wide wanted = w_sqrt(w_max(e * e * q - used, zero)) + 0.5f * c->h * g;
    return w_choose(w_greater(x->approach[i], w_set(least)), w_min(wanted, w_sqrt(w_max(q - used, zero))),
                    -(gap * c->inverse_h));
}

// What the touched contacts gave so far leaves the warm start: start takes M^-1 J^T l.
FE_INLINE void NAMED(leave_warm_start)(const SPECIAL_ROW *x, fe__solver *s, const pair *p, wide_mask touched, int kind)
{
    const ROW *row = &x->row;
    pair start = {start_side(s, row->line_a), start_side(s, row->line_b), p->normal, p->span}, was = start;
    NAMED(apply_all)(row, &start, kind);
    start.a.v = w_choose3(touched, start.a.v, was.a.v), start.a.w = w_choose3(touched, start.a.w, was.a.w);
    start.b.v = w_choose3(touched, start.b.v, was.b.v), start.b.w = w_choose3(touched, start.b.w, was.b.w);
    if (kind & FE__ROW_PAIR) scatter_side(s->start, row->line_a, &start.a);
    scatter_side(s->start, row->line_b, &start.b);
}

// Nothing of the touched lanes is left to warm-start. `was`: what `total` already has, and `part` of the change came to
// pass.
FE_INLINE void NAMED(forget_touched)(SPECIAL_ROW *x, const PASSING *was, wide part, wide_mask touched)
{
    ROW *row = &x->row;
    wide zero = w_set(0.0f);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        contact_point *q = row->point + i;
        row->total[i] = row->total[i] + w_choose(touched, part * (q->impulse - was->point[i]), zero);
        q->impulse = w_choose(touched, zero, q->impulse);
        x->approach[i] = w_choose(touched, zero, x->approach[i]);
    }
    for (int i = 0; i < 2; ++i) row->tangent_impulse[i] = w_choose(touched, zero, row->tangent_impulse[i]);
    for (int i = 0; i < 3; ++i) x->rolling_impulse[i] = w_choose(touched, zero, x->rolling_impulse[i]);
    row->twist_impulse = w_choose(touched, zero, row->twist_impulse);
    row->load = w_choose(touched, zero, row->load);
}

FE_INLINE void NAMED(bounce_points)(ROW *row, pair *p, const wide *target, int kind)
{
    affine velocity = NAMED(normal_velocity)(p);
    wide request[POINTS], sum;
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        const contact_point *q = row->point + i;
        request[i] = q->impulse - q->mass * (at(&velocity, load3(q->r)) - target[i]);
    }
    wide3 moment = NAMED(sweep_points)(row, request, 0, row->lent != 0, &sum);
    NAMED(apply)(row, p, w_scale(sum, p->normal), w_cross(moment, p->normal), kind);
}

// Did the last sweep change as much of the impulses of the lanes that they need another one?
FE_INLINE int NAMED(settles)(const ROW *row, const wide *points, const wide *tangent, wide_mask lanes)
{
    wide change = w_abs(row->tangent_impulse[0] - tangent[0]) + w_abs(row->tangent_impulse[1] - tangent[1]);
    UNROLL for (int i = 0; i < POINTS; ++i) change = change + w_abs(row->point[i].impulse - points[i]);
    return w_any(w_and(lanes, w_greater(change, BOUNCE_SETTLED * NAMED(load_of)(row)))) != 0;
}

// Friction rotates the bodies and the points turn them back, until both are as they must be: each sweep looks at the
// bodies anew. Of a lane `alone` sweeps end when it has settled.
FE_INLINE void NAMED(sweep_bounce)(SPECIAL_ROW *x, pair *p, const wide *target, wide_mask lanes, int alone, int kind)
{
    ROW *row = &x->row;
    for (int sweep = 1, more = 1; sweep < BOUNCE_SWEEPS && more; ++sweep) {
        wide points[POINTS], tangent[2] = {row->tangent_impulse[0], row->tangent_impulse[1]};
        UNROLL for (int i = 0; i < POINTS; ++i) points[i] = row->point[i].impulse;
        NAMED(bounce_points)(row, p, target, kind);
        NAMED(solve_rolling)(x, p, kind);
        NAMED(solve_friction)(row, p, w_set(1.0f), kind);
        if (alone) more = NAMED(settles)(row, points, tangent, lanes);
    }
    NAMED(bounce_points)(row, p, target, kind);
}

FE_INLINE wide NAMED(power_of)(const wrench *w, const pair *p)
{
    wide3 moment_b = w_add(w->moment, w_cross(p->span, w->impulse));
    return w_dot(w->impulse, w_sub(p->b.v, p->a.v)) + w_dot(moment_b, p->b.w) - w_dot(w->moment, p->a.w);
}

// The part of a bounce, 1 and less, with which the row's impulses of this substep gain no energy: gain + part b +
// part^2 a <= 0, of the works of its change
//     b = change . speed before,   a = half of change . (speed after - before)
// and what the normal ones change in the discrete flight, see gain_of.
FE_INLINE wide NAMED(part_without_gain)(const SPECIAL_ROW *x, const wrench *change, wide flight, const pair *was,
                                        const pair *is)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), first = NAMED(power_of)(change, was), b = first + flight,
         a = 0.5f * (NAMED(power_of)(change, is) - first);
    wide root = w_sqrt(w_max(b * b - 4.0f * a * x->gain, zero));
    wide part = w_clamp((root - b) * w_inverse_or_zero(2.0f * a), zero, one);
    return w_choose(w_greater(x->gain + a + b, zero), part, one);
}

// The given lanes touched, at points that are faster than `least`; or one of a chain `alone`, at any speed.
FE_SMALL FE_INLINE void NAMED(bounce_lanes)(SPECIAL_ROW *x, fe__solver *s, wide_mask touched, int alone,
                                            const fe__step_constants *c, int kind)
{
    float least = alone ? 0.0f : c->threshold;
    ROW *row = &x->row;
    pair p = NAMED(gather_pair)(row, s, kind), before = p;
    PASSING was = NAMED(passing_of)(row, &p, kind);
    NAMED(leave_warm_start)(x, s, &p, touched, kind);
    wide target[POINTS], load = NAMED(load_of)(row);
    UNROLL for (int i = 0; i < POINTS; ++i) target[i] = NAMED(bounce_speed)(x, i, row->point[i].distance, least, c);
    wrench given = NAMED(wrench_of)(row, p.normal, kind);
    NAMED(sweep_bounce)(x, &p, target, touched, alone, kind);
    wrench all = NAMED(wrench_of)(row, p.normal, kind);
    wrench change = {w_sub(all.impulse, given.impulse), w_sub(all.moment, given.moment)};
    wide flight = (load - NAMED(load_of)(row)) * (0.5f * c->h * x->closing);
    wide part = NAMED(part_without_gain)(x, &change, flight, &before, &p);
    p.a = blend(part, &before.a, &p.a), p.b = blend(part, &before.b, &p.b);
    NAMED(keep_others)(row, &p, &was, touched, kind);
    NAMED(forget_touched)(x, &was, part, touched);
    if (kind & FE__ROW_PAIR) add_change(s, row->line_a, &before.a, &p.a, touched);
    add_change(s, row->line_b, &before.b, &p.b, touched);
}

// After relax, for contacts that touched in this substep, and share no body with another touch.
FE_INLINE void NAMED(bounce_row)(SPECIAL_ROW *x, fe__solver *s, const fe__step_constants *c, int kind)
{
    wide_mask touched = NAMED(touched)(x, c->threshold);
    if (!w_any(touched)) return;
    wide_mask chained = NAMED(in_chain)(x, s, touched, 1, kind);
    if (w_any(chained)) atomic_store_explicit(&s->chained, 1, memory_order_relaxed);
    touched = w_and(touched, w_not(chained));
    if (w_any(touched)) NAMED(bounce_lanes)(x, s, touched, 0, c, kind);
}

// ---- impacts of a chain, one by one: see impact_chain.c
// ------------------------------------------------------------------ What the contact gave in this substep leaves the
// velocities of its bodies, or returns.
FE_SMALL FE_INLINE void NAMED(take_back)(const SPECIAL_ROW *x, fe__solver *s, wide_mask lanes, float sign, int kind)
{
    const ROW *row = &x->row;
    pair p = NAMED(gather_pair)(row, s, kind), before = p;
    wrench all = NAMED(wrench_of)(row, p.normal, kind);
    NAMED(apply)(row, &p, w_scale(w_set(sign), all.impulse), w_scale(w_set(sign), all.moment), kind);
    p.a = choose_side(lanes, p.a, before.a), p.b = choose_side(lanes, p.b, before.b);
    NAMED(scatter_pair)(row, s, &p, kind);
}

FE_INLINE void NAMED(forget_given)(SPECIAL_ROW *x, wide_mask lanes)
{
    PASSING none;
    wide zero = w_set(0.0f);
    UNROLL for (int i = 0; i < POINTS; ++i) none.point[i] = zero;
    NAMED(forget_touched)(x, &none, w_set(-1.0f), lanes);
    x->gain = w_choose(lanes, zero, x->gain);
}

// Points that close: at once, whatever their speed. Returns whether there are any.
FE_INLINE int32_t NAMED(pass_on)(SPECIAL_ROW *x, fe__solver *s, wide_mask lanes, const fe__step_constants *c, int kind)
{
    pair p = NAMED(gather_pair)(&x->row, s, kind);
    affine velocity = NAMED(normal_velocity)(&p);
    wide zero = w_set(0.0f), g = x->closing;
    wide_mask any = no_lane();
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        const contact_point *q = x->row.point + i;
        wide gap = w_max(q->distance, zero), u = -at(&velocity, load3(q->r));
        wide_mask closes = w_and(lanes, w_greater(u - gap * c->inverse_h, w_set(CLOSING)));
        closes = w_and(closes, w_greater(q->mass, zero));
        x->approach[i] = w_choose(lanes, w_choose(closes, u, zero), x->approach[i]);
        x->flight[i] = w_choose(lanes, w_max(u * (u - c->h * g) + 2.0f * g * gap, zero), x->flight[i]);
        any = w_or(any, closes);
    }
    if (!w_any(any)) return 0;
    NAMED(bounce_lanes)(x, s, lanes, 1, c, kind);
    return 1;
}

FE_INLINE int32_t NAMED(act)(fe__solver *s, SPECIAL_ROW *x, wide_mask lanes, fe__touch_act act,
                             const fe__step_constants *c, int kind)
{
    switch (act) {
    case FE__TOUCH_TAKE:
        NAMED(take_back)(x, s, lanes, -1.0f, kind);
        return 1;
    case FE__TOUCH_RETURN:
        NAMED(take_back)(x, s, lanes, 1.0f, kind);
        return 1;
    case FE__TOUCH_FORGET:
        NAMED(forget_given)(x, lanes);
        return 1;
    case FE__TOUCH_PASS_ON:
        return NAMED(pass_on)(x, s, lanes, c, kind);
    case FE__TOUCH_BOUNCE:
        lanes = w_and(lanes, NAMED(touched)(x, c->threshold));
        if (w_any(lanes)) NAMED(bounce_lanes)(x, s, lanes, 0, c, kind);
        return 1;
    }
    return 0;
}
