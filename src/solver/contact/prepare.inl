// prepare.inl - contacts to rows at the beginning of a step, impulses back at its end. Part of contact_rows.inl, once
// per number of points.
//
// Contacts come from the whole of memory, in the order of the colours: those of the next row are fetched while this one
// is computed.

// Fills the points, returns the friction centre. Along n it lies where those points are that touch: friction at a
// height over them would have an arm about the edge on which a body stands. In the plane of the contact it is the mean
// of all that are near. Twist and tangents together say the same wherever there the centre is, and it stays where it is
// while the points of what rocks come to bear and cease to.
FE_INLINE wide3 NAMED(prepare_points)(ROW *row, const row_contacts *r, wide3 n, wide4 separation, wide count,
                                      const fe__step_constants *c)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), least = w_set(LEAST_WEIGHT), near = zero, touching = zero, apart = zero,
         height = zero;
    wide4 impulse = POINTS_QUAD(normal_impulse);
    wide impulses[FE__POINTS] = {impulse.x, impulse.y, impulse.z, impulse.w};
    wide separations[FE__POINTS] = {separation.x, separation.y, separation.z, separation.w};
    wide3 sum = w_zero3();
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        contact_point *to = row->point + i;
        wide3 arm = w_xyz(w_gather_from(r->points, point_offset(i)));
        wide_mask there = w_greater(count, w_set((float)i));
        store3(to->r, arm);
        to->distance = row->separation[i] = separations[i];
        to->mass = w_choose(there, one, zero);
        to->impulse = impulses[i] * c->contact_warm_scale;
        row->total[i] = zero;
        wide share = separations[i] * (1.0f / c->speculative);
        wide is_near = w_choose(there, w_clamp(2.0f - share, least, one), zero),
             touches = w_choose(there, w_clamp(1.0f - TOUCHES * share, least, one), zero);
        near = near + is_near, touching = touching + touches;
        sum = w_add_scaled(sum, is_near, arm);
        height = height + touches * w_dot(n, arm);
        apart = apart + touches * separations[i];
    }
    wide inverse = w_inverse_or_zero(touching);
    wide3 centre = w_scale(w_inverse_or_zero(near), sum);
    row->separation[POINTS] = inverse * apart;
    return POINTS == 1 ? centre : w_add_scaled(centre, inverse * height - w_dot(n, centre), n);
}

FE_INLINE void NAMED(prepare_friction)(ROW *row, wide4 impulse, wide3 t1, wide3 t2, const fe__step_constants *c)
{
    row->tangent_impulse[0] = w_dot(w_xyz(impulse), t1) * c->contact_warm_scale;
    row->tangent_impulse[1] = w_dot(w_xyz(impulse), t2) * c->contact_warm_scale;
    row->twist_impulse = impulse.w * c->contact_warm_scale;
}

// The rotation of a side of isotropic inertia, whose points are as far from its centre as they are round, changes
// nothing
FE_INLINE wide NAMED(still_angle)(const wide_sym *i, wide reach, int kind)
{
    wide spread = w_abs(i->xx - i->yy) + w_abs(i->yy - i->zz) + w_abs(i->xy) + w_abs(i->xz) + w_abs(i->yz);
    wide_mask shows = w_or(w_greater(spread, ROUND_INERTIA * (i->xx + i->yy + i->zz)),
                           w_greater(reach, w_set(FROZEN_SHIFT * FROZEN_SHIFT)));
    // a bounce is to gain no energy: no rotation is too small
    return w_choose(shows, w_set(kind & FE__ROW_SPECIAL ? 0.0f : 0.25f * FROZEN_ROTATION * FROZEN_ROTATION),
                    w_set(FLT_MAX));
}

FE_INLINE void NAMED(prepare_following)(ROW *row, wide3 n, int kind)
{
    wide reach_a = w_set(0.0f), reach_b = reach_a;
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        wide3 r = load3(row->point[i].r), a = w_sub_scaled(r, row->round_a, n);
        wide3 b = w_add_scaled(w_add(r, load3(row->found_span)), row->round_b, n);
        wide there = row->point[i].mass;
        reach_a = w_max(there * w_dot(a, a), reach_a), reach_b = w_max(there * w_dot(b, b), reach_b);
    }
    const wide_sym none = {0};
    row->still_a = NAMED(still_angle)(kind & FE__ROW_PAIR ? &row->inertia_a : &none, reach_a, kind);
    row->still_b = NAMED(still_angle)(&row->inertia_b, reach_b, kind);
    row->follows = w_set(0.0f);
}

// Scalar, a lane at a time: special rows are few. The world that a padding lane names may have no extras at all
FE_INLINE void NAMED(prepare_special)(SPECIAL_ROW *x, const fe__solver *s, const fe__records *of, const fe__lane *lanes,
                                      const fe__step_constants *c)
{
    static const fe__extra none = {.restitution = 0.0f};
    for (int i = 0; i < FE_W; ++i) {
        const fe__extra *e = lanes[i].points ? of[lanes[i].home].extras + lanes[i].points : &none;
        const fe__velocity_line *a = s->velocity + x->row.line_a[i], *b = s->velocity + x->row.line_b[i];
        int locks_a = (int)a->lock_bits, locks_b = (int)b->lock_bits;
        for (int k = 0; k < 3; ++k) {
            x->mass_a[k][i] = locks_a >> k & 1 ? 0.0f : a->inverse_mass;
            x->mass_b[k][i] = locks_b >> k & 1 ? 0.0f : b->inverse_mass;
            x->rolling_impulse[k][i] = e->rolling_impulse[k] * c->contact_warm_scale;
            x->surface[k][i] = e->surface_velocity[k];
        }
        x->restitution[i] = e->restitution;
        x->rolling[i] = e->rolling;
        x->spinning[i] = e->spinning;
    }
}

FE_INLINE void NAMED(prepare_rolling)(SPECIAL_ROW *x, const fe__solver *s, const pair *p, const fe__step_constants *c,
                                      int kind)
{
    NAMED(find_rolling_masses)(x, p, every_lane(), kind);
    wide3 pull = w_sub(w_xyz(gather_low(s->drive, x->row.line_a)), w_xyz(gather_low(s->drive, x->row.line_b)));
    x->closing = w_dot(p->normal, pull);
    x->gain = w_set(0.0f);
    x->half_h = w_set(0.5f * c->h);
    UNROLL for (int i = 0; i < POINTS; ++i) x->approach[i] = x->flight[i] = w_set(0.0f);
}

// The span between the arms as found. Those of a static A count from B's centre, with no span between them; a special
// row holds static and kinematic A's.
FE_INLINE wide3 NAMED(span_found)(const ROW *row, wide3 span, int kind)
{
    if (!(kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))) return w_zero3();
    return w_choose3(NAMED(static_lanes)(row), w_zero3(), span);
}

FE_INLINE void NAMED(prepare_gap)(ROW *row, wide4 separation, wide points, wide reach)
{
    row->gap = row->open = NAMED(least_gap)(separation, points);
    row->reach = reach;
}

// Friction may come without a load, from other points, now gone. Relax takes it back where none follows
FE_INLINE void NAMED(note_friction)(ROW *row, wide4 friction)
{
    row->gap = row->open = w_choose(any_nonzero(friction), w_set(-FLT_MAX), row->gap);
    NAMED(note_gaps)(row);
}

// The inverse mass with which a body counts for the softness: of what a tree lends (tree/articulated_mass.inl) the part
// that lock_bits say
FE_INLINE wide NAMED(soft_mass)(const side *b)
{
    wide part = w_fraction(b->locks);
    return b->inverse_mass * w_choose(w_greater(part, w_set(0.0f)), part, w_set(1.0f));
}

// The mass that equal impulses at all points push: 1 / K,  K = sum K_ij / n^2
FE_INLINE wide NAMED(mass_of_all)(const ROW *row)
{
    wide sum = w_set(0.0f), count = sum, one = w_set(1.0f);
    UNROLL for (int j = 0; j < POINTS; ++j)
    {
        wide mass = row->point[j].mass, response = w_inverse_or_zero(mass), others = w_set(0.0f);
        UNROLL for (int i = 0; i < j; ++i) others = others + w_choose(w_greater(row->point[i].mass, w_set(0.0f)),
                                                                      row->coupling[coupling_of[i][j]], w_set(0.0f));
        count = count + w_choose(w_greater(mass, w_set(0.0f)), one, w_set(0.0f));
        sum = sum + response * (one + 2.0f * others);
    }
    return count * count * w_inverse_or_zero(sum);
}

// A soft point bears m w^2 for each metre that it is deep, m what it knows of the bodies' masses. Where that is a
// tree's, it is less than what stands on the point: as much less as keeps the passes stable. There the stiffness is
// that of the mass mu that the tree has at the body's centre,
//     (1 - ms) / ms = m / mu a3 / (a2 a3)
// which passes follow as long as they change the speed of mu by a thirtieth, by the points of this contact alone.
static __attribute__((noinline)) void NAMED(stiffen)(ROW *row, const pair *p, const fe__softness *k, wide_mask lent)
{
    wide mass = row->point[0].mass;
    UNROLL for (int i = 1; i < POINTS; ++i) mass = w_max(mass, row->point[i].mass);
    wide response = NAMED(soft_mass)(&p->a) + NAMED(soft_mass)(&p->b);
    row->lent = bits_of(lent);
    wide share = NAMED(mass_of_all)(row) * response;
    wide part = mass * response + w_max(1.0f - share * (1.0f / LEAST_FOLLOWED), w_set(0.0f));
    row->lent_closing = w_choose(lent, w_min(2.0f * share, w_set(1.0f)), row->still_b);
    wide scale = 1.0f / (1.0f + part * (k->impulse_scale / k->mass_scale));
    row->lent_scale = w_choose(lent, w_max(scale, w_set(k->mass_scale)), row->still_a);
}

FE_INLINE void NAMED(find_softness)(ROW *row, const pair *p, const fe__step_constants *c, int kind)
{
    const fe__softness *k = kind & FE__ROW_PAIR ? &c->between_dynamic : &c->against_static;
    wide zero = w_set(0.0f);
    wide_mask lent = w_greater(w_fraction(p->b.locks), zero);
    if (kind & FE__ROW_PAIR) lent = w_or(lent, w_greater(w_fraction(p->a.locks), zero));
    row->lent = 0;
    if (w_any(lent)) NAMED(stiffen)(row, p, k, lent);
}

FE_INLINE void NAMED(prepare_row)(ROW *row, const fe__lane *lane, fe__solver *s, const fe__records *of,
                                  const fe__step_constants *c, int kind)
{
    const row_contacts named = name_contacts(of, lane), *r = &named;
    for (int i = 0; i < FE_W; ++i) {
        row->line_a[i] = lane[i].line_a;
        row->line_b[i] = lane[i].line_b;
    }
    row->inertia_b = gather_inertia(s, row->line_b);
    if (kind & FE__ROW_PAIR) row->inertia_a = gather_inertia(s, row->line_a);
    wide4 normal = CONTACT_QUAD(normal), span = CONTACT_QUAD(span);
    wide4 surface = CONTACT_QUAD(surface);
    row->static_friction = span.w;
    row->dynamic_friction = surface.x;
    row->round_a = surface.y;
    row->round_b = surface.z;
    store3(row->normal, w_xyz(normal));
    store3(row->span, w_xyz(span));
    store3(row->start_span, w_xyz(span));
    wide4 found = CONTACT_QUAD(found_span);
    store3(row->found_span, NAMED(span_found)(row, w_xyz(found), kind));
    if (kind & FE__ROW_SPECIAL) NAMED(prepare_special)((SPECIAL_ROW *)row, s, of, lane, c);

    pair p = NAMED(gather_pair)(row, s, kind);
    wide3 t1, t2;
    tangents(p.normal, &t1, &t2);
    wide4 separation = POINTS_QUAD(separation);
    store3(row->centre, NAMED(prepare_points)(row, r, p.normal, separation, normal.w, c));
    if (NAMED(can_idle)(kind)) NAMED(prepare_gap)(row, separation, normal.w, found.w);
    row->put_off = row->behind = 0;
    wide4 friction = POINTS_QUAD(friction_impulse);
    NAMED(prepare_friction)(row, friction, t1, t2, c);
    if (NAMED(can_idle)(kind)) NAMED(note_friction)(row, friction);
    NAMED(prepare_following)(row, p.normal, kind);
    wide_mask ahead = found_ahead(surface.w);
    if (w_any(ahead)) NAMED(place_ahead)(row, r, ahead, kind);
    MASSES masses;
    NAMED(find_masses)(row, &p, kind, &masses);
    NAMED(store_masses)(row, &masses, every_lane());
    NAMED(find_softness)(row, &p, c, kind);
    if (kind & FE__ROW_SPECIAL) NAMED(prepare_rolling)((SPECIAL_ROW *)row, s, &p, c, kind);
    row->load = NAMED(load_of)(row);
    NAMED(apply_all)(row, &p, kind);
    NAMED(scatter_pair)(row, s, &p, kind);
}

// What begins the step with an impulse, or ended the last one after it had one, is prepared in any case
FE_INLINE int NAMED(may_wait)(const row_contacts *r)
{
    if (w_any(any_nonzero(POINTS_QUAD(normal_impulse)))) return 0;
    if (w_any(any_nonzero(POINTS_QUAD(friction_impulse)))) return 0;
    if (w_any(any_nonzero(POINTS_QUAD(total_impulse)))) return 0;
    return !w_any(found_ahead(CONTACT_QUAD(surface).w));
}

// Loose contacts come last in a group: where the first is none, few rows are idle
FE_INLINE int NAMED(begins_loose)(const fe__points *q)
{
    const float *impulse = q->normal_impulse;
    return q->separation[0] > 0.0f && !(impulse[0] + impulse[1] + impulse[2] + impulse[3] > 0.0f);
}

// A row that may stay idle gets what tells so, and is prepared by the first pass in which it is not
static __attribute__((noinline)) int NAMED(put_off)(ROW *row, const fe__lane *lane, const fe__solver *s,
                                                    const fe__records *of, const fe__step_constants *c, int kind)
{
    const row_contacts named = name_contacts(of, lane), *r = &named;
    if (!NAMED(may_wait)(r)) return 0;
    for (int i = 0; i < FE_W; ++i) row->line_a[i] = lane[i].line_a, row->line_b[i] = lane[i].line_b;
    wide4 normal = CONTACT_QUAD(normal);
    store3(row->normal, w_xyz(normal));
    NAMED(prepare_gap)(row, POINTS_QUAD(separation), normal.w, CONTACT_QUAD(found_span).w);
    row->put_off = 1, row->behind = 0;
    NAMED(note_gaps)(row);
    return NAMED(may_idle)(row, kind) && NAMED(idle_now)(row, s, c, kind);
}

FE_INLINE void NAMED(prepare)(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                              const fe__step_constants *c, int kind)
{
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        ROW *row = NAMED(row_at)(rows, i, kind);
        for (int j = 0; j < FE_W && i + 1 < count; ++j) prefetch_contact(of, lanes + FE_W + j);
        if (!NAMED(can_idle)(kind) || !NAMED(begins_loose)(points_of(of, lanes)) ||
            !NAMED(put_off)(row, lanes, s, of, c, kind))
            NAMED(prepare_row)(row, lanes, s, of, c, kind);
    }
}

// Returns how many rows have loose lanes beside others: with a gap, and without a load in this step. What was put off
// to the end is all zeros already
FE_INLINE int32_t NAMED(store)(const fe__records *of, const fe__lane *lanes, const void *rows, int32_t count, int kind)
{
    int32_t mixed = 0;
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        const ROW *row = NAMED(row_at)((void *)(uintptr_t)rows, i, kind);
        const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
        if (NAMED(can_idle)(kind) && row->put_off) continue;
        wide zero = w_set(0.0f), impulse[FE__POINTS] = {0}, total[FE__POINTS] = {0}, sum = zero;
        for (int j = 0; j < FE_W && i + 4 < count; ++j) __builtin_prefetch(points_of(of, lanes + 4 * FE_W + j), 1);
        UNROLL for (int j = 0; j < POINTS; ++j)
        {
            impulse[j] = row->point[j].impulse, total[j] = row->total[j];
            sum = sum + total[j];
        }
        if (NAMED(can_idle)(kind) && row->gaps) {
            wide_mask loose = w_and(w_not(w_greater(sum, zero)), w_greater(row->gap, zero));
            mixed += w_any(w_not(loose)) && w_any(w_and(loose, w_greater(w_set(FLT_MAX), row->gap)));
        }
        // of -0 and +0 the latter: what was put off has it
        wide4 friction = w_with(NAMED(friction_impulse)(row, load3(row->normal)), row->twist_impulse);
        friction = (wide4){friction.x + zero, friction.y + zero, friction.z + zero, friction.w + zero};
        store_lanes(of, lanes, (wide4){impulse[0], impulse[1], impulse[2], impulse[3]}, friction,
                    (wide4){total[0], total[1], total[2], total[3]});
        for (int j = 0; j < FE_W && kind & FE__ROW_SPECIAL; ++j) {
            if (!lanes[j].points) continue;
            fe__extra *e = of[lanes[j].home].extras + lanes[j].points;
            for (int k = 0; k < 3; ++k) e->rolling_impulse[k] = x->rolling_impulse[k][j];
        }
    }
    return mixed;
}
