// idle.inl - rows of contacts that carry nothing. Part of contact_rows.inl, once per number of points.
//
// A third of a pile's contacts, and nine tenths of a loose stack's, are gaps that nobody closes. Such a contact has no
// impulse, and its gap stays open for a substep at the speeds of its bodies:
//
//     gap + h n.(vB - vA) > h reach (|wA| + |wB|)
//     gap >= gap0 + n.shift - 2 reach (|sin(angleA / 2)| + |sin(angleB / 2)|)          since the step began
//
// `reach`: the longest arm of the pair's points and, of round sides, of their cores, which are what rotates.
//
// Then vn + s / h > 0 at each point, the passes request less than no impulse of each, and change nothing: a row of
// none but such contacts is skipped. It is not even prepared until a pass finds something to do. IDLE_ERROR keeps the
// bound above what rounding does to the requests, so that skipping and solving give the same bits, and who is beside
// whom in a row does not show. What the passes add of nothing, +0 or -0, changes no velocity, as none is -0
// (bodies.simd.c).
//
// Special rows are never skipped: they note touches, and a chain of impacts asks them, prepared, for what may still
// touch in the substep. Nor are those with static bodies: they bear loads, nearly all.

FE_INLINE int NAMED(can_idle)(int kind) { return kind & FE__ROW_PAIR && !(kind & FE__ROW_SPECIAL); }

// of the points that there are, the least separation; a padding lane has none
FE_INLINE wide NAMED(least_gap)(wide4 separation, wide points)
{
    wide none = w_set(FLT_MAX), s[FE__POINTS] = {separation.x, separation.y, separation.z, separation.w};
    wide least = none;
    UNROLL for (int i = 0; i < POINTS; ++i) least =
        w_min(w_choose(w_greater(points, w_set((float)i)), s[i], none), least);
    return least;
}

// Lanes that have an impulse
FE_INLINE wide_mask NAMED(loaded)(const ROW *row)
{
    return row->put_off ? no_lane() : w_greater(NAMED(load_of)(row), w_set(0.0f));
}

// Or had one when the last substep ended: relax has that to note
FE_INLINE wide_mask NAMED(loaded_lately)(const ROW *row)
{
    return row->put_off ? no_lane() : w_greater(NAMED(load_of)(row) + row->load, w_set(0.0f));
}

// no more than where the bodies' motion brought the points; (2 |a| + 2 |b| + |c|)^2 <= 12 (a^2 + b^2) + 3 c^2
FE_INLINE wide NAMED(gap_after)(const ROW *row, const motion *m)
{
    wide turned = sine_square(m->rotation_a) + sine_square(m->rotation_b), reach = row->reach;
    wide shift = IDLE_ERROR * IDLE_ERROR * w_dot(m->shift, m->shift);
    wide most = w_sqrt(12.0f * (reach * reach * turned) + 3.0f * shift);
    return row->gap + w_dot(load3(row->normal), m->shift) - (most + IDLE_ERROR * reach);
}

// Lanes whose gap of now stays open for a substep; (|a| + |b| + |c| + |d|)^2 <= 4 (a^2 + b^2 + c^2 + d^2)
FE_INLINE wide_mask NAMED(stays_open)(const pair *p, wide gap, wide reach, const fe__step_constants *c)
{
    wide spin = w_dot(p->a.w, p->a.w) + w_dot(p->b.w, p->b.w), speed = w_dot(p->a.v, p->a.v) + w_dot(p->b.v, p->b.v);
    wide left = (1.0f - IDLE_ERROR) * gap + c->h * w_dot(p->normal, w_sub(p->b.v, p->a.v));
    wide most = 4.0f * c->h * c->h * (reach * reach * spin + IDLE_ERROR * IDLE_ERROR * speed);
    return w_and(w_greater(left, w_set(0.0f)), w_greater(left * left, most));
}

// In the soft pass: the bodies are where the last relax pass looked
static __attribute__((noinline)) int NAMED(open_now)(const ROW *row, const fe__solver *s, const fe__step_constants *c,
                                                     int kind)
{
    pair p = NAMED(gather_pair)(row, s, kind);
    return !w_any(w_not(NAMED(stays_open)(&p, row->open, row->reach, c)));
}

// after each change of a gap
FE_INLINE void NAMED(note_gaps)(ROW *row) { row->gaps = w_bits(w_greater(row->gap, w_set(0.0f))); }

// Every lane has a gap when the step begins: others bear something soon, and nobody need ask again
FE_INLINE int NAMED(may_idle)(const ROW *row, int kind)
{
    return NAMED(can_idle)(kind) && row->gaps == w_bits(every_lane());
}

FE_INLINE int NAMED(idle_now)(const ROW *row, const fe__solver *s, const fe__step_constants *c, int kind)
{
    return !w_any(NAMED(loaded)(row)) && NAMED(open_now)(row, s, c, kind);
}

// In the relax pass, after the bodies moved
static __attribute__((noinline)) int NAMED(open_after)(ROW *row, const fe__solver *s, const fe__step_constants *c,
                                                       int kind)
{
    pair p = NAMED(gather_pair)(row, s, kind);
    motion m = NAMED(motion_of)(row, s, kind);
    row->open = NAMED(gap_after)(row, &m);
    row->behind = !w_any(w_not(NAMED(stays_open)(&p, row->open, row->reach, c)));
    return row->behind;
}

FE_INLINE int NAMED(idle_after)(ROW *row, const fe__solver *s, const fe__step_constants *c, int kind)
{
    if (!w_any(NAMED(loaded_lately)(row))) return NAMED(open_after)(row, s, c, kind);
    row->open = w_set(-FLT_MAX);
    row->behind = 0;
    return 0;
}

// Of the lanes that would follow: those that a row of idle contacts would skip do not begin to
static __attribute__((noinline)) wide_mask NAMED(but_idle)(const ROW *row, const fe__solver *s, wide_mask moving,
                                                           const fe__step_constants *c, int kind)
{
    wide_mask fresh = w_not(w_or(NAMED(loaded_lately)(row), w_greater(row->follows, w_set(0.0f))));
    if (!w_any(w_and(fresh, moving))) return moving;
    pair p = NAMED(gather_pair)(row, s, kind);
    motion m = NAMED(motion_of)(row, s, kind);
    wide_mask idle = NAMED(stays_open)(&p, NAMED(gap_after)(row, &m), row->reach, c);
    return w_and(moving, w_not(w_and(fresh, idle)));
}
