// idle.inl - contacts that carry nothing. Part of rows.inl, once per number of points.
//
// Half of a loose pile's contacts are gaps that nobody closes. A contact is idle in a pass when it carries no impulse
// and its gap stays open for a substep at the speeds of its bodies:
//
//     gap + h n.(vB - vA) > h reach (|wA| + |wB|)
//     gap >= gap0 + n.shift - 2 reach (|sin(angleA / 2)| + |sin(angleB / 2)|)          since the step began
//
// Then vn + s / h > 0 at each point, and both passes request less than no impulse. So an idle contact is left as it is,
// to the bit, whoever is beside it in the row. A row of none but idle contacts costs no more than that look at its
// bodies; until another look finds something to do, it is not even prepared.
//
// Special rows are never idle: they note touches.

FE_INLINE wide_mask NAMED(padding)(const ROW *row) { return w_not(w_greater(w_set(FLT_MAX), row->gap)); }

// of the points that there are, the least separation; a padding lane has none
FE_INLINE wide NAMED(least_gap)(wide4 separation, wide points)
{
    wide none = w_set(FLT_MAX), s[FE__POINTS] = {separation.x, separation.y, separation.z, separation.w};
    wide least = none;
    UNROLL for (int i = 0; i < POINTS; ++i) least =
        w_min(w_choose(w_greater(points, w_set((float)i)), s[i], none), least);
    return least;
}

FE_INLINE wide_mask NAMED(carries_nothing)(const ROW *row)
{
    if (row->put_off) return every_lane();
    return w_not(w_greater(NAMED(load_of)(row), w_set(0.0f)));
}

// at the speeds of the bodies, within a substep
FE_INLINE wide_mask NAMED(stays_open)(const ROW *row, const pair *p, const fe__step_constants *c)
{
    // (|wA| + |wB|)^2 <= 2 (wA^2 + wB^2)
    wide left = row->open + c->h * w_dot(p->normal, w_sub(p->b.v, p->a.v)), arm = c->h * row->reach;
    wide turns = 2.0f * arm * arm * (w_dot(p->a.w, p->a.w) + w_dot(p->b.w, p->b.w));
    return w_and(w_greater(left, w_set(0.0f)), w_greater(left * left, turns));
}

// in the soft pass: the bodies are where the last relax pass found them
FE_INLINE wide_mask NAMED(idle_now)(const ROW *row, const pair *p, const fe__step_constants *c)
{
    wide_mask idle = NAMED(carries_nothing)(row);
    return w_any(idle) ? w_and(idle, NAMED(stays_open)(row, p, c)) : idle;
}

// In the relax pass, after the bodies moved. What carried something at the end of the last substep is not idle: its
// load is to be known, and its gap holds for no soft pass.
FE_INLINE wide_mask NAMED(idle_after)(ROW *row, const pair *p, const motion *m, const fe__step_constants *c)
{
    wide_mask idle = NAMED(carries_nothing)(row);
    if (!row->put_off) idle = w_and(idle, w_not(w_greater(row->load, w_set(0.0f))));
    if (!w_any(idle)) {
        row->open = w_set(-FLT_MAX);
        return idle;
    }
    // (2 |a| + 2 |b|)^2 <= 8 (a^2 + b^2)
    wide turned = w_sqrt(8.0f * (sine_square(m->rotation_a) + sine_square(m->rotation_b)));
    wide gap = row->gap + w_dot(p->normal, m->shift) - row->reach * turned;
    row->open = w_choose(idle, gap, w_set(-FLT_MAX));
    return w_and(idle, NAMED(stays_open)(row, p, c));
}

// idle lanes as before the pass, whose bodies are not scattered yet
FE_INLINE void NAMED(leave_idle)(ROW *row, const fe__solver *s, pair *p, wide_mask idle, int kind)
{
    wide zero = w_set(0.0f);
    pair was = NAMED(gather_pair)(row, s, kind);
    p->a = choose_side(idle, was.a, p->a), p->b = choose_side(idle, was.b, p->b);
    UNROLL for (int i = 0; i < POINTS; ++i) row->point[i].impulse = w_choose(idle, zero, row->point[i].impulse);
}
