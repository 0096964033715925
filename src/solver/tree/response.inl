// response.inl - what a force on a link of a tree does to it, with all that it is joined to: the mass that contacts
// push. Part of tree.simd.c.
//
// From the root downwards (K. Kreutz-Delgado et al., "Recursive Formulation of Operational Space Control", 1991): the
// response G of a link at its point to a force there, with that of the link above at this point, X G_above X^T,
//     G = prod (1 - s g U^T) X G_above X^T prod (1 - s g U^T)^T + s g s^T of each freedom
// A contact knows one inverse mass and one inverse inertia of a body: shares of its own, at least as large as G says.
// What it changes of a velocity by them is an impulse all the same: divided by the shares it is the change of the body
// alone, from which the tree begins.

// a += k (x y^T + y x^T) / 2 of what is symmetric
FE_INLINE void add_both(real_sym *a, real k, real3 x, real3 y)
{
    a->xx += k * x.x * y.x, a->yy += k * x.y * y.y, a->zz += k * x.z * y.z;
    a->xy += 0.5 * k * (x.x * y.y + x.y * y.x), a->xz += 0.5 * k * (x.x * y.z + x.z * y.x);
    a->yz += 0.5 * k * (x.y * y.z + x.z * y.y);
}

// b += k x y^T
FE_INLINE void add_outer(real_mat *b, real k, real3 x, real3 y)
{
    b->x = r_add_scaled(b->x, k * x.x, y), b->y = r_add_scaled(b->y, k * x.y, y), b->z = r_add_scaled(b->z, k * x.z, y);
}

// From the point of the link above, from which c lies at d: v_c = v - d x w
FE_INLINE void response_at(tree_node *n, const tree_node *from, real3 d)
{
    const real_sym *w = &from->give_w;
    const real3 wx = {w->xx, w->xy, w->xz}, wy = {w->xy, w->yy, w->yz}, wz = {w->xz, w->yz, w->zz};
    n->give_w = *w;
    // rows of -[d] w: of a matrix with columns w., column by column -d x w.
    const real3 cx = r_cross(wx, d), cy = r_cross(wy, d), cz = r_cross(wz, d); // columns of -[d] W
    const real_mat *b = &from->give_b;
    n->give_b = (real_mat){{b->x.x + cx.x, b->x.y + cy.x, b->x.z + cz.x},
                           {b->y.x + cx.y, b->y.y + cy.y, b->y.z + cz.y},
                           {b->z.x + cx.z, b->z.y + cy.z, b->z.z + cz.z}};
    // A + B [d] + (B [d])^T - [d] W [d], B [d] by rows b x d; (-[d] W) [d] likewise
    const real3 fx = r_cross(b->x, d), fy = r_cross(b->y, d), fz = r_cross(b->z, d);
    const real3 gx = r_cross((real3){cx.x, cy.x, cz.x}, d), gy = r_cross((real3){cx.y, cy.y, cz.y}, d),
                gz = r_cross((real3){cx.z, cy.z, cz.z}, d);
    n->give_v = (real_sym){from->give_v.xx + 2.0 * fx.x + gx.x,  from->give_v.xy + fx.y + fy.x + gx.y,
                           from->give_v.xz + fx.z + fz.x + gx.z, from->give_v.yy + 2.0 * fy.y + gy.y,
                           from->give_v.yz + fy.z + fz.y + gy.z, from->give_v.zz + 2.0 * fz.z + gz.z};
}

// G' = (1 - s g U^T) G (1 - s g U^T)^T + g s s^T = G - g (s y^T + y s^T) + (g^2 U.y + g) s s^T,  y = G U
FE_INLINE void give_freedom(tree_node *n, int k)
{
    const freedom *f = n->free + k;
    const real3 s = axis_of(n, k), zero = r_zero3(), sv = k < 3 ? s : zero, sw = k < 3 ? zero : s;
    const real3 yv = r_add(r_mul_sym(&n->give_v, f->v), r_mul(&n->give_b, f->w));
    const real3 yw = r_add(r_mul_transposed(&n->give_b, f->v), r_mul_sym(&n->give_w, f->w));
    const real own = f->g * f->g * (r_dot(f->v, yv) + r_dot(f->w, yw)) + f->g;
    add_both(&n->give_v, -2.0 * f->g, sv, yv), add_both(&n->give_v, own, sv, sv);
    add_both(&n->give_w, -2.0 * f->g, sw, yw), add_both(&n->give_w, own, sw, sw);
    add_outer(&n->give_b, -f->g, sv, yw), add_outer(&n->give_b, -f->g, yv, sw), add_outer(&n->give_b, own, sv, sw);
}

// v = A (f - F^T t), w = D^-1 t - F v,  F = D^-1 B^T:  -A F^T beside A, D^-1 + F A F^T below
FE_INLINE void give_ball(tree_node *n)
{
    const freedom *f = n->free;
    const real one = r_set(1.0);
    real3 column[3];
    const real3 rows[3] = {{f[0].v.x, f[1].v.x, f[2].v.x},
                           {f[0].v.y, f[1].v.y, f[2].v.y},
                           {f[0].v.z, f[1].v.z, f[2].v.z}};
    for (int k = 0; k < 3; ++k) column[k] = ball_back(f, rows[k]); // of F
    const real_mat turn = {{column[0].x, column[1].x, column[2].x},
                           {column[0].y, column[1].y, column[2].y},
                           {column[0].z, column[1].z, column[2].z}};
    const real_sym *a = &n->give_v;
    const real3 ax = r_mul_sym(a, turn.x), ay = r_mul_sym(a, turn.y), az = r_mul_sym(a, turn.z); // columns of A F^T
    n->give_b = (real_mat){{-ax.x, -ay.x, -az.x}, {-ax.y, -ay.y, -az.y}, {-ax.z, -ay.z, -az.z}};
    n->give_w = (real_sym){r_dot(turn.x, ax), r_dot(turn.x, ay), r_dot(turn.x, az),
                           r_dot(turn.y, ay), r_dot(turn.y, az), r_dot(turn.z, az)};
    for (int k = 0; k < 3; ++k) {
        real3 e = ball_forward(f, unit3(k));
        e = ball_back(f, (real3){f[0].g * e.x, f[1].g * e.y, f[2].g * e.z});
        if (k == 0) n->give_w.xx += e.x, n->give_w.xy += e.y, n->give_w.xz += e.z;
        if (k == 1) n->give_w.yy += e.y, n->give_w.yz += e.z;
        if (k == 2) n->give_w.zz += e.z;
    }
    (void)one;
}

FE_INLINE real r_abs(real a) { return r_max(a, -a); }

// Shares no smaller than the largest response of the centre, by the sums of rows; of rotations by the trace of I G
FE_INLINE void find_shares(tree_node *n)
{
    tree_node centre;
    response_at(&centre, n, r_scale(r_set(-1.0), n->below));
    const real_sym *a = &centre.give_v, *w = &n->give_w, *i = &n->inertia;
    const real x = r_abs(a->xx) + r_abs(a->xy) + r_abs(a->xz), y = r_abs(a->xy) + r_abs(a->yy) + r_abs(a->yz),
               z = r_abs(a->xz) + r_abs(a->yz) + r_abs(a->zz), one = r_set(1.0), least = r_set(1e-6);
    const real turn =
        i->xx * w->xx + i->yy * w->yy + i->zz * w->zz + 2.0 * (i->xy * w->xy + i->xz * w->xz + i->yz * w->yz);
    n->light = r_max(least, r_min(one, n->mass * r_max(x, r_max(y, z))));
    n->spins = r_max(least, r_min(one, turn));
}

static void find_responses(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const tree_node *above = above_of(t, i);
        memset(&n->give_v, 0, sizeof n->give_v), memset(&n->give_b, 0, sizeof n->give_b);
        memset(&n->give_w, 0, sizeof n->give_w);
        if (above) response_at(n, above, n->from_above);
        if (is_ball(t, i)) give_ball(n);
        for (int k = FREEDOMS - 1; k >= 0 && !is_ball(t, i); --k)
            if (t->links[i].form >> k & 1) give_freedom(n, k);
        find_shares(n);
    }
}
