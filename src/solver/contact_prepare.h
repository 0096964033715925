// contact_prepare.h - contacts to rows at the beginning of a step, impulses back at its end. Part of contact_rows.h, once per number of
// points.
//
// Contacts come from the whole of memory, in the order of the colours: those of the next row are asked for while this one is computed.

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
    wide least = kind & FE__ROW_SPECIAL ? RIGID * (p->a.inverse_mass + p->b.inverse_mass) : w_set(0.0f);
    return w_choose(w_greater(k, least), inverse_or_zero(k), w_set(0.0f));
}

// fills the points, returns the friction centre: the mean of the points weighted by how close they are
FE_INLINE wide3 NAMED(prepare_points)(ROW *row, const fe__contact *m, const int32_t *index, const pair *p, wide points,
                                      const fe__step_constants *c, int kind)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), sum = zero, linear = NAMED(linear_response)(row, p, p->normal, p->normal, one, kind);
    wide4 impulse = w_gather(m->normal_impulse, CONTACT_STRIDE, index), separation = w_gather(m->separation, CONTACT_STRIDE, index);
    wide impulses[FE__POINTS] = {impulse.x, impulse.y, impulse.z, impulse.w};
    wide separations[FE__POINTS] = {separation.x, separation.y, separation.z, separation.w};
    wide3 weighted = w_zero3();
    arm arms[POINTS];
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        point_row *q = row->point + i;
        wide3 r = w_xyz(w_gather(m->point[i], CONTACT_STRIDE, index));
        wide_mask there = w_greater(points, w_set((float)i));
        arms[i] = NAMED(arm_of)(row, r, p->span, p->normal, kind);
        store3(q->r, r);
        q->separation = separations[i];
        q->mass = w_choose(there, NAMED(mass_along)(p, linear + angular_response(arms + i, arms + i, kind), kind), zero);
        q->impulse = impulses[i] * c->warm_scale;
        q->total = zero;
        UNROLL for (int j = 0; j < i; ++j) row->coupling[coupling_of[j][i]] =
            q->mass * (linear + angular_response(arms + j, arms + i, kind));
        wide weight = w_choose(there, w_clamp(2.0f - q->separation * (1.0f / c->speculative), w_set(LEAST_WEIGHT), one), zero);
        sum = sum + weight;
        weighted = w_add_scaled(weighted, weight, r);
    }
    return w_scale(inverse_or_zero(sum), weighted);
}

// Inverse of the 2 x 2 matrix of the tangents. Where locks leave one direction u to slide in, it is k u u^T up to rounding, whose inverse
// would fill the friction cone with noise across u: the pseudo-inverse, itself over the square of its trace, knows u only.
FE_INLINE void NAMED(invert_tangents)(ROW *row, const pair *p, wide k11, wide k12, wide k22, int kind)
{
    wide det = k11 * k22 - k12 * k12, inverse = inverse_or_zero(det), trace = k11 + k22;
    row->tangent_mass[0] = inverse * k22;
    row->tangent_mass[1] = -(inverse * k12);
    row->tangent_mass[2] = inverse * k11;
    if (!(kind & FE__ROW_SPECIAL)) return;
    wide over_trace = NAMED(mass_along)(p, trace, kind);
    wide_mask two_ways = w_greater(det, ONE_WAY * trace * trace);
    row->tangent_mass[0] = w_choose(two_ways, row->tangent_mass[0], over_trace * k11 * over_trace);
    row->tangent_mass[1] = w_choose(two_ways, row->tangent_mass[1], over_trace * k12 * over_trace);
    row->tangent_mass[2] = w_choose(two_ways, row->tangent_mass[2], over_trace * k22 * over_trace);
}

FE_INLINE void NAMED(prepare_friction)(ROW *row, const pair *p, wide3 centre, wide4 impulse, wide3 t1, wide3 t2,
                                       const fe__step_constants *c, int kind)
{
    wide zero = w_set(0.0f), one = w_set(1.0f);
    arm m1 = NAMED(arm_of)(row, centre, p->span, t1, kind), m2 = NAMED(arm_of)(row, centre, p->span, t2, kind);
    wide k11 = NAMED(linear_response)(row, p, t1, t1, one, kind) + angular_response(&m1, &m1, kind);
    wide k22 = NAMED(linear_response)(row, p, t2, t2, one, kind) + angular_response(&m2, &m2, kind);
    wide k12 = NAMED(linear_response)(row, p, t1, t2, zero, kind) + angular_response(&m1, &m2, kind);
    NAMED(invert_tangents)(row, p, k11, k12, k22, kind);
    arm spin = {p->normal, p->normal, w_zero3(), w_mul(&row->inertia_b, p->normal)};
    if (kind & FE__ROW_PAIR) spin.spin_a = w_mul(&row->inertia_a, p->normal);
    row->tangent_impulse[0] = w_dot(w_xyz(impulse), t1) * c->warm_scale;
    row->tangent_impulse[1] = w_dot(w_xyz(impulse), t2) * c->warm_scale;
    row->twist_mass = inverse_or_zero(angular_response(&spin, &spin, kind));
    row->twist_impulse = impulse.w * c->warm_scale;
    row->twist_tangent[0] = angular_response(&m1, &spin, kind);
    row->twist_tangent[1] = angular_response(&m2, &spin, kind);
    store3(row->centre, centre);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        wide3 d = w_sub(load3(row->point[i].r), centre);
        row->lever[i] = w_sqrt(w_dot(d, d));
    }
}

FE_INLINE void NAMED(warm_start)(const ROW *row, pair *p, wide3 t1, wide3 t2, int kind)
{
    wide3 moment = w_zero3();
    UNROLL for (int i = 0; i < POINTS; ++i) moment = w_add_scaled(moment, row->point[i].impulse, load3(row->point[i].r));
    wide3 friction = w_add_scaled(w_scale(row->tangent_impulse[0], t1), row->tangent_impulse[1], t2);
    moment = w_add(w_cross(moment, p->normal), w_cross(load3(row->centre), friction));
    moment = w_add_scaled(moment, row->twist_impulse, p->normal);
    NAMED(apply)(row, p, w_add_scaled(friction, NAMED(load_of)(row), p->normal), moment, kind);
    if (kind & FE__ROW_SPECIAL) NAMED(apply_torque)(row, p, load3(((const SPECIAL_ROW *)row)->rolling_impulse), kind);
}

// Scalar, a lane at a time: special rows are few
FE_INLINE void NAMED(prepare_special)(SPECIAL_ROW *x, const fe__solver *s, const fe__extra *extras, const int32_t *index,
                                      const fe__step_constants *c)
{
    for (int i = 0; i < FE_W; ++i) {
        const fe__extra *e = extras + index[i];
        const float *a = s->velocity[x->row.line_a[i]], *b = s->velocity[x->row.line_b[i]];
        int locks_a = (int)a[7], locks_b = (int)b[7];
        for (int k = 0; k < 3; ++k) {
            x->mass_a[k][i] = locks_a >> k & 1 ? 0.0f : a[3];
            x->mass_b[k][i] = locks_b >> k & 1 ? 0.0f : b[3];
            x->rolling_impulse[k][i] = e->rolling_impulse[k] * c->warm_scale;
            x->surface[k][i] = e->surface_velocity[k];
        }
        x->restitution[i] = e->restitution;
        x->rolling[i] = e->rolling;
        x->spinning[i] = e->spinning;
    }
}

// A locked rotation has no inverse inertia: a little of the trace keeps the sum invertible, and what is locked does not spin anyway
FE_INLINE void NAMED(prepare_rolling)(SPECIAL_ROW *x, const fe__solver *s, const pair *p, int kind)
{
    wide_sym k = x->row.inertia_b;
    if (kind & FE__ROW_PAIR) {
        const wide_sym *a = &x->row.inertia_a;
        k = (wide_sym){k.xx + a->xx, k.xy + a->xy, k.xz + a->xz, k.yy + a->yy, k.yz + a->yz, k.zz + a->zz};
    }
    x->spinning_mass = inverse_or_zero(w_dot(p->normal, w_mul(&k, p->normal)));
    wide some = REGULAR * (k.xx + k.yy + k.zz);
    k.xx = k.xx + some, k.yy = k.yy + some, k.zz = k.zz + some;
    x->rolling_mass = inverse_sym(&k);
    wide3 pull = w_sub(w_xyz(gather_low(s->drive, x->row.line_a)), w_xyz(gather_low(s->drive, x->row.line_b)));
    x->closing = w_dot(p->normal, pull);
    UNROLL for (int i = 0; i < POINTS; ++i) x->approach[i] = x->flight[i] = w_set(0.0f);
}

// Of the arms as found. Those of a static A are counted from B's centre: no span between them. A special row has static and kinematic A's
FE_INLINE wide3 NAMED(span_found)(const ROW *row, const fe__contact *m, const int32_t *index, int kind)
{
    if (!(kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))) return w_zero3();
    wide3 span = w_xyz(w_gather(m->found_span, CONTACT_STRIDE, index));
    _Alignas(64) float is_static[FE_W];
    for (int i = 0; i < FE_W; ++i) is_static[i] = row->line_a[i] == FE__STATIC_LINE ? 1.0f : 0.0f;
    return w_choose3(w_greater(*(const wide *)is_static, w_set(0.0f)), w_zero3(), span);
}

FE_INLINE void NAMED(prepare_row)(ROW *row, const fe__lane *lane, fe__solver *s, const fe__contact *m, const fe__extra *extras,
                                  const fe__step_constants *c, int kind)
{
    _Alignas(64) int32_t index[FE_W];
    for (int i = 0; i < FE_W; ++i) {
        index[i] = lane[i].contact;
        row->line_a[i] = lane[i].line_a;
        row->line_b[i] = lane[i].line_b;
    }
    row->inertia_b = gather_inertia(s, row->line_b);
    if (kind & FE__ROW_PAIR) row->inertia_a = gather_inertia(s, row->line_a);
    wide4 normal = w_gather(m->normal, CONTACT_STRIDE, index), span = w_gather(m->span, CONTACT_STRIDE, index);
    wide4 surface = w_gather(m->surface, CONTACT_STRIDE, index);
    row->static_friction = span.w;
    row->dynamic_friction = surface.x;
    row->round_a = surface.y;
    row->round_b = surface.z;
    store3(row->normal, w_xyz(normal));
    store3(row->span, w_xyz(span));
    store3(row->first_span, NAMED(span_found)(row, m, index, kind));
    store3(row->shift, w_zero3());
    if (kind & FE__ROW_SPECIAL) NAMED(prepare_special)((SPECIAL_ROW *)row, s, extras, index, c);

    pair p = NAMED(gather_pair)(row, s, kind);
    wide3 t1, t2;
    tangents(p.normal, &t1, &t2);
    wide3 centre = NAMED(prepare_points)(row, m, index, &p, normal.w, c, kind);
    NAMED(prepare_friction)(row, &p, centre, w_gather(m->friction_impulse, CONTACT_STRIDE, index), t1, t2, c, kind);
    if (kind & FE__ROW_SPECIAL) NAMED(prepare_rolling)((SPECIAL_ROW *)row, s, &p, kind);
    NAMED(warm_start)(row, &p, t1, t2, kind);
    NAMED(scatter_pair)(row, s, &p, kind);
}

FE_INLINE void NAMED(prepare)(fe__solver *s, fe__contact *contacts, const fe__extra *extras, const fe__lane *lanes, void *rows,
                              int32_t count, const fe__step_constants *c, int kind)
{
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        for (int j = 0; j < FE_W && i + 1 < count; ++j) prefetch_contact(contacts + lanes[FE_W + j].contact);
        NAMED(prepare_row)(NAMED(row_at)(rows, i, kind), lanes, s, contacts, extras, c, kind);
    }
}

FE_INLINE void NAMED(store)(fe__contact *contacts, fe__extra *extras, const fe__lane *lanes, const void *rows, int32_t count, int kind)
{
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        const ROW *row = NAMED(row_at)((void *)(uintptr_t)rows, i, kind);
        const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
        wide impulse[FE__POINTS] = {0}, total[FE__POINTS] = {0};
        _Alignas(64) int32_t index[FE_W];
        for (int j = 0; j < FE_W; ++j) index[j] = lanes[j].contact;
        for (int j = 0; j < FE_W && i + 4 < count; ++j) __builtin_prefetch(contacts[lanes[4 * FE_W + j].contact].normal_impulse, 1);
        UNROLL for (int j = 0; j < POINTS; ++j) impulse[j] = row->point[j].impulse, total[j] = row->point[j].total;
        wide3 friction = NAMED(friction_impulse)(row, load3(row->normal));
        store_lanes(contacts, index, (wide4){impulse[0], impulse[1], impulse[2], impulse[3]}, w_with(friction, row->twist_impulse),
                    (wide4){total[0], total[1], total[2], total[3]});
        for (int j = 0; j < FE_W && kind & FE__ROW_SPECIAL; ++j)
            for (int k = 0; k < 3 && index[j]; ++k) extras[index[j]].rolling_impulse[k] = x->rolling_impulse[k][j];
    }
}
