// eliminate.inl - freedoms eliminated from the leaves upwards and met from the root downwards, see node.inl. Part of
// tree_solver.simd.c.

// ---- masses ---------------------------------------------------------------------------------------------------------
// of a body alone, at a point on the arm r from its centre: [[m, m [r]], [-m [r], I - m [r][r]]]
FE_INLINE mass mass_at(real m, const real_sym *inertia, real3 r)
{
    const real zero = r_set(0.0);
    const real3 s = r_scale(m, r);
    mass p;
    p.a = (real_sym){m, zero, zero, m, zero, m};
    p.b = (real_mat){{zero, -s.z, s.y}, {s.z, zero, -s.x}, {-s.y, s.x, zero}};
    const real xx = s.x * r.x, yy = s.y * r.y, zz = s.z * r.z;
    p.d = (real_sym){inertia->xx + (yy + zz), inertia->xy - s.x * r.y, inertia->xz - s.x * r.z,
                     inertia->yy + (xx + zz), inertia->yz - s.y * r.z, inertia->zz + (xx + yy)};
    return p;
}

FE_INLINE void add_sym(real_sym *a, const real_sym *b)
{
    a->xx += b->xx, a->xy += b->xy, a->xz += b->xz, a->yy += b->yy, a->yz += b->yz, a->zz += b->zz;
}

// a -= x y^T, which is symmetric
FE_INLINE void take_outer(real_sym *a, real3 x, real3 y)
{
    a->xx -= x.x * y.x, a->xy -= x.x * y.y, a->xz -= x.x * y.z;
    a->yy -= x.y * y.y, a->yz -= x.y * y.z, a->zz -= x.z * y.z;
}

FE_INLINE real3 column_x(const real_mat *m) { return (real3){m->x.x, m->y.x, m->z.x}; }
FE_INLINE real3 column_y(const real_mat *m) { return (real3){m->x.y, m->y.y, m->z.y}; }
FE_INLINE real3 column_z(const real_mat *m) { return (real3){m->x.z, m->y.z, m->z.z}; }

// To a point from which c lies at d: b + a X = b - a [d], whose rows are b + d x a; d + [d] b' + ([d] b)^T
// `only_a`: b and d are zero
FE_INLINE void hang_mass(mass *to, const mass *p, real3 d, int only_a)
{
    const real_sym *a = &p->a;
    const real3 ax = {a->xx, a->xy, a->xz}, ay = {a->xy, a->yy, a->yz}, az = {a->xz, a->yz, a->zz};
    real_mat n = {r_cross(d, ax), r_cross(d, ay), r_cross(d, az)};
    if (!only_a) {
        const real3 x = r_cross(d, column_x(&p->b)), y = r_cross(d, column_y(&p->b)), z = r_cross(d, column_z(&p->b));
        n.x = r_add(n.x, p->b.x), n.y = r_add(n.y, p->b.y), n.z = r_add(n.z, p->b.z);
        to->d.xx += p->d.xx + x.x, to->d.xy += p->d.xy + x.y, to->d.xz += p->d.xz + x.z;
        to->d.yy += p->d.yy + y.y, to->d.yz += p->d.yz + y.z, to->d.zz += p->d.zz + z.z;
    }
    add_sym(&to->a, a);
    to->b.x = r_add(to->b.x, n.x), to->b.y = r_add(to->b.y, n.y), to->b.z = r_add(to->b.z, n.z);
    to->d.xx += d.y * n.z.x - d.z * n.y.x, to->d.xy += d.y * n.z.y - d.z * n.y.y;
    to->d.xz += d.y * n.z.z - d.z * n.y.z, to->d.yy += d.z * n.x.y - d.x * n.z.y;
    to->d.yz += d.z * n.x.z - d.x * n.z.z, to->d.zz += d.x * n.y.z - d.y * n.x.z;
}

// What bodies have locked has no mass, so that no freedom gives there
static void hide_locked(mass *p, uint32_t locks)
{
    const real zero = r_set(0.0);
    if (locks & 1) p->a.xx = p->a.xy = p->a.xz = zero, p->b.x = r_zero3();
    if (locks & 2) p->a.xy = p->a.yy = p->a.yz = zero, p->b.y = r_zero3();
    if (locks & 4) p->a.xz = p->a.yz = p->a.zz = zero, p->b.z = r_zero3();
    if (locks & 8) p->d.xx = p->d.xy = p->d.xz = p->b.x.x = p->b.y.x = p->b.z.x = zero;
    if (locks & 16) p->d.xy = p->d.yy = p->d.yz = p->b.x.y = p->b.y.y = p->b.z.y = zero;
    if (locks & 32) p->d.xz = p->d.yz = p->d.zz = p->b.x.z = p->b.y.z = p->b.z.z = zero;
}

// ---- ball joints ----------------------------------------------------------------------------------------------------
// All three rotations at once, D + k = L g^-1 L^T with ones on L's diagonal: free[i].v holds g L^-1 B^T row by row, w
// below the diagonal L. They are counted from rest instead of from the body above: w = (D + k)^-1 (p_w - B^T x_v + k
// (x_w - slip)). What is left is a mass of the point alone, and, with E = (D + k)^-1 and B as it was,
//     a' = a - B E B^T,  b' = k B E,  d' = k - k E k
static void eliminate_ball(tree_node *n)
{
    const real3 bx = column_x(&n->p.b), by = column_y(&n->p.b), bz = column_z(&n->p.b);
    const real_sym *d = &n->p.d;
    freedom *f = n->free;
    f[0].g = inverse_or_zero(d->xx + n->damping);
    f[1].w.x = f[0].g * d->xy, f[2].w.x = f[0].g * d->xz;
    const real3 second = r_sub_scaled(by, f[1].w.x, bx);
    f[1].g = inverse_or_zero(d->yy + n->damping - f[1].w.x * d->xy);
    const real below = d->yz - f[2].w.x * d->xy;
    f[2].w.y = f[1].g * below;
    const real3 third = r_sub_scaled(r_sub_scaled(bz, f[2].w.x, bx), f[2].w.y, second);
    f[2].g = inverse_or_zero(d->zz + n->damping - f[2].w.x * d->xz - f[2].w.y * below);
    f[0].v = r_scale(f[0].g, bx), f[1].v = r_scale(f[1].g, second), f[2].v = r_scale(f[2].g, third);
    take_outer(&n->p.a, f[0].v, bx), take_outer(&n->p.a, f[1].v, second), take_outer(&n->p.a, f[2].v, third);
}

FE_INLINE real_mat damped_b(const tree_node *n)
{
    const freedom *f = n->free;
    const real l10 = -f[1].w.x, l21 = -f[2].w.y, l20 = f[1].w.x * f[2].w.y - f[2].w.x; // L^-1
    const real3 x = r_scale(n->damping, r_add_scaled(r_add_scaled(f[0].v, l10, f[1].v), l20, f[2].v));
    const real3 y = r_scale(n->damping, r_add_scaled(f[1].v, l21, f[2].v)), z = r_scale(n->damping, f[2].v);
    return (real_mat){{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
}

FE_INLINE real_sym damped_d(const tree_node *n)
{
    const freedom *f = n->free;
    const real k = n->damping, l10 = -f[1].w.x, l21 = -f[2].w.y, l20 = f[1].w.x * f[2].w.y - f[2].w.x;
    const real g0 = f[0].g, g1 = f[1].g, g2 = f[2].g;
    return (real_sym){k - k * k * (g0 + g1 * l10 * l10 + g2 * l20 * l20),
                      -k * k * (g1 * l10 + g2 * l20 * l21),
                      -k * k * (g2 * l20),
                      k - k * k * (g1 + g2 * l21 * l21),
                      -k * k * (g2 * l21),
                      k - k * k * g2};
}

// L^-T
FE_INLINE real3 ball_back(const freedom *f, real3 t)
{
    t.y -= f[2].w.y * t.z;
    t.x -= f[1].w.x * t.y + f[2].w.x * t.z;
    return t;
}
FE_INLINE real3 ball_forward(const freedom *f, real3 t)
{
    t.y -= f[1].w.x * t.x;
    t.z -= f[2].w.x * t.x + f[2].w.y * t.y;
    return t;
}
FE_INLINE real3 ball_gives(const freedom *f, real3 x)
{
    return (real3){r_dot(f[0].v, x), r_dot(f[1].v, x), r_dot(f[2].v, x)};
}

FE_INLINE int32_t is_damped(const tree_node *n) { return r_bits(r_greater(n->damping, r_set(0.0))); }

// ---- others ---------------------------------------------------------------------------------------------------------
// freedom k: 0..2 along, 3..5 about
FE_INLINE real3 axis_of(const tree_node *n, int k) { return k < 3 ? n->lin[k] : n->ang[k - 3]; }

static void eliminate_freedom(tree_node *n, int k)
{
    const real3 s = axis_of(n, k);
    freedom *f = n->free + k;
    mass *p = &n->p;
    f->v = k < 3 ? r_mul_sym(&p->a, s) : r_mul(&p->b, s);
    f->w = k < 3 ? r_mul_transposed(&p->b, s) : r_mul_sym(&p->d, s);
    f->g = inverse_or_zero(k < 3 ? r_dot(s, f->v) : r_dot(s, f->w) + n->damping);
    const real3 v = r_scale(f->g, f->v), w = r_scale(f->g, f->w);
    take_outer(&p->a, v, f->v), take_outer(&p->d, w, f->w);
    p->b.x = r_sub_scaled(p->b.x, v.x, f->w);
    p->b.y = r_sub_scaled(p->b.y, v.y, f->w);
    p->b.z = r_sub_scaled(p->b.z, v.z, f->w);
}

// ---- from the leaves upwards ----------------------------------------------------------------------------------------
static void eliminate_joint(const pass *t, int32_t i)
{
    tree_node *n = t->nodes + i, *above = above_of(t, i);
    if (t->locks) hide_locked(&n->p, t->locks);
    if (is_ball(t, i)) {
        eliminate_ball(n);
        const int32_t damped = is_damped(n);
        if (damped) n->p.b = damped_b(n), n->p.d = damped_d(n);
        if (above) hang_mass(&above->p, &n->p, n->from_above, !damped);
        return;
    }
    for (int k = 0; k < FREEDOMS; ++k)
        if (t->links[i].form >> k & 1) eliminate_freedom(n, k);
    if (above) hang_mass(&above->p, &n->p, n->from_above, 0);
}

// the bodies alone
FE_INLINE void lay_masses(const pass *t, int32_t i)
{
    tree_node *n = t->nodes + i;
    const tree_node *above = above_of(t, i);
    n->p = mass_at(n->mass, &n->inertia, n->below);
    if (above) n->from_above = r_sub(n->above, above->below);
}

// ---- requests up ----------------------------------------------------------------------------------------------------
// what a joint passes on of a load
typedef struct load {
    real3 v, w;
} load;

FE_INLINE void clear_load(solution *s) { s->load_v = s->load_w = r_zero3(); }

FE_INLINE load ball_up(const tree_node *n, solution *s)
{
    const freedom *f = n->free;
    const int32_t damped = is_damped(n);
    real3 z = s->load_w;
    if (damped) z = r_sub_scaled(z, n->damping, s->slip);
    z = ball_forward(f, z);
    s->e[0] = f[0].g * z.x, s->e[1] = f[1].g * z.y, s->e[2] = f[2].g * z.z;
    s->load_v = r_sub_scaled(r_sub_scaled(r_sub_scaled(s->load_v, z.x, f[0].v), z.y, f[1].v), z.z, f[2].v);
    load out = {r_sub(s->load_v, r_mul_sym(&n->p.a, s->ask_v)), r_zero3()};
    if (damped) {
        const real3 e = {s->e[0], s->e[1], s->e[2]};
        out.w = r_scale(n->damping, r_add(ball_back(f, r_sub(e, ball_gives(f, s->ask_v))), s->slip));
    }
    return out;
}

FE_INLINE load joint_up(const tree_node *n, int32_t form, solution *s)
{
    const mass *p = &n->p;
    for (int k = 0; k < FREEDOMS; ++k) {
        if (!(form >> k & 1)) continue;
        const freedom *f = n->free + k;
        const real3 a = axis_of(n, k);
        s->e[k] = f->g * (k < 3 ? r_dot(a, s->load_v) : r_dot(a, s->load_w) - n->damping * r_dot(a, s->slip));
        s->load_v = r_sub_scaled(s->load_v, s->e[k], f->v), s->load_w = r_sub_scaled(s->load_w, s->e[k], f->w);
    }
    return (load){r_sub(s->load_v, r_add(r_mul_sym(&p->a, s->ask_v), r_mul(&p->b, s->ask_w))),
                  r_sub(s->load_w, r_add(r_mul_transposed(&p->b, s->ask_v), r_mul_sym(&p->d, s->ask_w)))};
}

// `which`: the solution
FE_INLINE void hand_up(const pass *t, int32_t i, int which)
{
    tree_node *n = t->nodes + i, *above = above_of(t, i);
    solution *s = n->of + which;
    const load l = is_ball(t, i) ? ball_up(n, s) : joint_up(n, t->links[i].form, s);
    if (!above) return;
    solution *to = above->of + which;
    to->load_v = r_add(to->load_v, l.v);
    to->load_w = r_add(to->load_w, r_add(l.w, r_cross(n->from_above, l.v)));
}

// ---- changes down ---------------------------------------------------------------------------------------------------
// `bears`: the impulse is wanted
FE_INLINE void ball_down(tree_node *n, solution *s, real3 xv, real3 xw, int bears)
{
    const freedom *f = n->free;
    const real3 gives = ball_gives(f, xv);
    real3 q = {s->e[0] - gives.x, s->e[1] - gives.y, s->e[2] - gives.z};
    const int32_t damped = is_damped(n);
    if (damped) {
        const real3 held = ball_forward(f, r_scale(n->damping, xw));
        q.x += f[0].g * held.x, q.y += f[1].g * held.y, q.z += f[2].g * held.z;
    }
    s->change_v = xv;
    s->change_w = ball_back(f, q);
    if (!bears) return;
    n->impulse_v = r_sub(r_mul_sym(&n->p.a, xv), s->load_v);
    n->impulse_w = r_zero3();
    if (damped) {
        n->impulse_v = r_add(n->impulse_v, r_mul(&n->p.b, xw));
        n->impulse_w = r_scale(-n->damping, r_add(r_sub(s->change_w, xw), s->slip));
    }
}

FE_INLINE void joint_down(tree_node *n, int32_t form, solution *s, real3 xv, real3 xw, int bears)
{
    const mass *p = &n->p;
    if (bears) {
        n->impulse_v = r_sub(r_add(r_mul_sym(&p->a, xv), r_mul(&p->b, xw)), s->load_v);
        n->impulse_w = r_sub(r_add(r_mul_transposed(&p->b, xv), r_mul_sym(&p->d, xw)), s->load_w);
    }
    for (int k = FREEDOMS - 1; k >= 0; --k) {
        if (!(form >> k & 1)) continue;
        const freedom *f = n->free + k;
        const real q = s->e[k] - f->g * (r_dot(f->v, xv) + r_dot(f->w, xw));
        if (k < 3)
            xv = r_add_scaled(xv, q, n->lin[k]);
        else
            xw = r_add_scaled(xw, q, n->ang[k - 3]);
    }
    s->change_v = xv, s->change_w = xw;
}

FE_INLINE void hand_down(const pass *t, int32_t i, int which, int bears)
{
    tree_node *n = t->nodes + i;
    const tree_node *above = above_of(t, i);
    solution *s = n->of + which;
    real3 xv = s->ask_v, xw = s->ask_w;
    if (above) {
        const solution *from = above->of + which;
        xv = r_add(xv, r_add(from->change_v, r_cross(from->change_w, n->from_above)));
        xw = r_add(xw, from->change_w);
    }
    if (is_ball(t, i))
        ball_down(n, s, xv, xw, bears);
    else
        joint_down(n, t->links[i].form, s, xv, xw, bears);
}

// of the centre of a body
FE_INLINE real3 centre_change(const tree_node *n, int which)
{
    return r_sub(n->of[which].change_v, r_cross(n->of[which].change_w, n->below));
}

static void meet_requests(const pass *t, int which)
{
    for (int32_t i = t->count - 1; i >= 0; --i) hand_up(t, i, which);
    for (int32_t i = 0; i < t->count; ++i) hand_down(t, i, which, which == SPEEDS);
}

typedef struct velocity {
    real3 v, w;
} velocity;

FE_INLINE velocity read_velocity(const pass *t, const line_names *line)
{
    const lines l = read_lines(t->solver->velocity, line);
    return (velocity){widen3(l.a), widen3(l.a + 4)};
}

FE_INLINE velocity changed(const tree_node *n)
{
    return (velocity){r_add(n->v, centre_change(n, SPEEDS)), r_add(n->w, n->of[SPEEDS].change_w)};
}
