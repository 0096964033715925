// contact_rows.inl - TGS Soft on rows of W contacts, POINTS points each. Included by contact_solver.simd.c once per
// number of points.
//
// A contact of several points shares one normal n, and rB = rA + span with span = cA - cB. Every quantity of a point is
// then affine in rA, and the work per point is one dot product:
//
//     normal velocity   vn_i = n.(vB - vA) + (n x wB).span + (n x (wB - wA)).rA_i
//                       since n.(w x r) = (n x w).r
//     separation        s_i  = s0_i + n.(dpB - dpA) + nB.span + (nB - nA).rA_i               nX = R(dqX)^T n - n, exact
//     torque on A       sum_i rA_i x (n l_i) = (sum_i l_i rA_i) x n;  on B: that + span x (n sum l_i)
//
// A round side (sphere, capsule) is its core swelled by a radius rho: the core rotates with the body, the radius stays
// along n. Its point is core + rho n on A, core - rho n on B, so the separation gains  rhoA nA.n + rhoB nB.n: a ball
// that rolls keeps its distance.
//
// The points are solved on their impulses with the stored matrix K_ij = n.M^-1.n between points, and the bodies are
// touched once, by the sum: a step for all points at once, which treats them alike, then a Gauss-Seidel sweep for what
// is left.
//
// `kind` is a constant of each instance: FE__ROW_PAIR both sides are dynamic, else only B moves; FE__ROW_SPECIAL the
// row carries a special_row.

#define NAMED(name) FE_PASTE(name, POINTS)
#define ROW NAMED(contact_row)
#define SPECIAL_ROW NAMED(special_row)
#define MASSES NAMED(masses)
#define PASSING NAMED(passing)

typedef struct ROW {
    int32_t line_a[FE_W], line_b[FE_W];
    wide normal[3];
    // see idle.inl. A row that is put off has what is above, these, and nothing else
    wide gap;      // when the step began, m; FLT_MAX: a padding lane; -FLT_MAX: never idle, it follows or had friction
    wide open;     // no more than the gap where the bodies are now, m; -FLT_MAX: nobody looked
    wide reach;    // longest arm of the points and, of round sides, of their cores, m
    uint32_t gaps; // lanes whose gap is greater than 0, a bit each
    int32_t put_off; // 1: not prepared
    int32_t behind;  // 1: skipped when the bodies moved, with distances from before
    uint32_t lent;   // lanes of which a body shows the mass of its tree, a bit each
    wide span[3];    // centre of A - centre of B
    contact_point point[POINTS];
    wide coupling[POINTS == 1 ? 1 : 6]; // m_j K_ij for i < j: 01 02 03 12 13 23
    wide_sym inertia_b, inertia_a;      // inverse, world. A copy streams faster than a gather
    // relax only
    wide separation[POINTS + 1]; // when the step began; the last: at the centre of friction
    wide total[POINTS];          // of the impulses of the substeps so far
    wide load;                   // sum of the normal impulses at the end of the last substep
    wide start_span[3];          // when the step began
    wide found_span[3];          // when the contact was found: for separations
    wide round_a, round_b;
    // Square of |sin(angle / 2)| up to which arms and inertia of a side stay as they are. Those of lent lanes do in any
    // case: they have their mass scale there, and the share of its gap by which a loaded point closes, see stiffen.
    union {
        wide still_a, lent_scale;
    };
    union {
        wide still_b, lent_closing;
    };
    wide follows; // 1: they no longer do, see follow
    wide static_friction, dynamic_friction;
    wide centre[3];       // of friction, from A's centre
    wide tangent_mass[3]; // inverse of the 2 x 2 matrix: 11 12 22
    wide tangent_impulse[2];
    wide twist_mass, twist_impulse;
    wide twist_tangent[2]; // tangent velocity that a unit of twist adds
    wide lever[POINTS];    // |r_i - centre|
    // of lanes that follow, when the step began: points on A from A's centre, on B from B's. The last is the centre of
    // friction
    wide first_a[POINTS + 1][3], first_b[POINTS + 1][3];
} ROW;

// What makes impulses of velocities: depends on arms and inertia alone
typedef struct MASSES {
    wide point[POINTS], coupling[POINTS == 1 ? 1 : 6], tangent[3], twist, twist_tangent[2], lever[POINTS];
} MASSES;

typedef struct SPECIAL_ROW {
    ROW row;
    wide mass_a[3], mass_b[3];             // inverse, along the world's axes: 0 where locked
    wide restitution, closing;             // acceleration of the bodies towards each other along n, m/s2
    wide approach[POINTS], flight[POINTS]; // of a touch in this substep: its speed (0: none) and Q, see record_touch
    wide when;                             // the first touch, s into the substep
    // energy that the normal impulses of this substep gave to the bodies, J, see count_gain
    wide gain;
    wide rolling, spinning; // torque caps over the normal force, m
    wide_sym rolling_mass;  // inverse of IA^-1 + IB^-1
    wide spinning_mass;
    wide rolling_impulse[3];
    wide surface[3]; // velocity of B's surface against A's
    wide half_h;     // of a substep, s
} SPECIAL_ROW;

// What a relax pass changes
typedef struct PASSING {
    wide point[POINTS], tangent[2], twist;
    side a, b;
    wide3 rolling; // these of special rows
    wide gain, approach[POINTS], flight[POINTS];
} PASSING;

// ---- bodies in and out ----------------------------------------------------------------------------------------------
FE_INLINE pair NAMED(gather_pair)(const ROW *row, const fe__solver *s, int kind)
{
    side still = {w_zero3(), w_zero3(), w_set(0.0f), w_set(0.0f)};
    side a = kind & (FE__ROW_PAIR | FE__ROW_SPECIAL) ? gather_side(s, row->line_a) : still;
    return (pair){a, gather_side(s, row->line_b), load3(row->normal), load3(row->span)};
}

FE_INLINE void NAMED(scatter_pair)(const ROW *row, const fe__solver *s, const pair *p, int kind)
{
    if (kind & FE__ROW_PAIR) scatter_side(s->velocity, row->line_a, &p->a);
    scatter_side(s->velocity, row->line_b, &p->b);
}

// Impulse on B, its opposite on A; its moment about A's centre. About B's centre the moment is greater by span x
// impulse.
FE_INLINE void NAMED(apply)(const ROW *row, pair *p, wide3 impulse, wide3 moment, int kind)
{
    const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
    wide3 moment_b = w_add(moment, w_cross(p->span, impulse));
    p->b.v = kind & FE__ROW_SPECIAL ? w_add(p->b.v, w_times(load3(x->mass_b), impulse))
                                    : w_add_scaled(p->b.v, p->b.inverse_mass, impulse);
    p->b.w = w_add(p->b.w, w_mul(&row->inertia_b, moment_b));
    if (!(kind & FE__ROW_PAIR)) return;
    p->a.v = kind & FE__ROW_SPECIAL ? w_sub(p->a.v, w_times(load3(x->mass_a), impulse))
                                    : w_sub_scaled(p->a.v, p->a.inverse_mass, impulse);
    p->a.w = w_sub(p->a.w, w_mul(&row->inertia_a, moment));
}

// a pure torque on B, its opposite on A
FE_INLINE void NAMED(apply_torque)(const ROW *row, pair *p, wide3 torque, int kind)
{
    p->b.w = w_add(p->b.w, w_mul(&row->inertia_b, torque));
    if (kind & FE__ROW_PAIR) p->a.w = w_sub(p->a.w, w_mul(&row->inertia_a, torque));
}

// ---- normals --------------------------------------------------------------------------------------------------------
FE_INLINE motion NAMED(motion_of)(const ROW *row, const fe__solver *s, int kind)
{
    wide zero = w_set(0.0f);
    motion m = {.rotation_a = {zero, zero, zero, w_set(1.0f)}};
    wide4 a, b;
    gather_line(s->motion, row->line_b, &b, &m.rotation_b);
    m.shift = w_xyz(b);
    if (!(kind & (FE__ROW_PAIR | FE__ROW_SPECIAL))) return m;
    gather_line(s->motion, row->line_a, &a, &m.rotation_a);
    m.shift = w_sub(m.shift, w_xyz(a));
    return m;
}

// after the bodies moved, of lanes whose arms are those of the step's start
FE_INLINE void NAMED(find_distances)(ROW *row, const pair *p, const motion *m, int kind)
{
    wide3 nb = w_turn_back(m->rotation_b, p->normal), na = w_zero3();
    wide constant =
        w_dot(p->normal, m->shift) + w_dot(nb, load3(row->found_span)) + row->round_b * w_dot(nb, p->normal);
    if (kind & (FE__ROW_PAIR | FE__ROW_SPECIAL)) {
        na = w_turn_back(m->rotation_a, p->normal);
        constant = constant + row->round_a * w_dot(na, p->normal);
    }
    affine change = {constant, w_sub(nb, na)};
    UNROLL for (int i = 0; i < POINTS; ++i) row->point[i].distance =
        row->separation[i] + at(&change, load3(row->point[i].r));
}

FE_INLINE affine NAMED(normal_velocity)(const pair *p)
{
    wide3 spin = w_cross(p->normal, p->b.w);
    return (affine){w_dot(p->normal, w_sub(p->b.v, p->a.v)) + w_dot(spin, p->span),
                    w_cross(p->normal, w_sub(p->b.w, p->a.w))};
}

// More than one point: rows of four hold contacts of one too, whose results are those of the row of one
FE_INLINE wide_mask NAMED(has_many)(const ROW *row)
{
    return POINTS > 1 ? w_greater(row->point[POINTS > 1].mass, w_set(0.0f)) : no_lane();
}

// A point without impulse, or one that only pushes an overlap apart and is struck, is about to touch: note its speed u,
// its time, and the energy of its flight, exact for the discrete motion v += h g, x += h v:
//     Q = u (u - g h) + 2 g s  before the bodies moved in this substep,   u (u + g h) + 2 g s  after
// (s: the gap, g: the acceleration that closes it). Only what is faster than the threshold bounces; of the others a
// chain of impacts knows (impact_chain.c). The points of a face that lands flat touch together: what rounding leaves
// for the next substep does too, or the face would bounce off one corner after another.
FE_INLINE void NAMED(record_touch)(SPECIAL_ROW *x, int i, wide impulse, wide vn, wide distance,
                                   const fe__step_constants *c, int moved)
{
    wide zero = w_set(0.0f), u = -vn, gap = w_max(distance, zero), g = x->closing;
    wide flight = (moved ? u * (u + c->h * g) : u * (u - c->h * g)) + 2.0f * g * gap;
    // as the impulse is computed, so that none is given to a point that is not noted
    wide_mask closes = w_greater(zero, vn + w_max(distance * c->inverse_h, zero));
    wide_mask nearly = w_greater(u, w_max(w_set(c->threshold), (gap - TOUCHING) * c->inverse_h));
    closes = w_or(closes, w_and(nearly, NAMED(has_many)(&x->row)));
    wide_mask touches = w_and(closes, w_greater(x->row.point[i].mass * x->restitution, zero));
    wide_mask pressed = w_greater(impulse, zero);
    if (moved) pressed = w_and(pressed, w_or(w_greater(x->row.load, zero), w_greater(w_set(c->threshold), u)));
    touches = w_and(touches, w_not(pressed));
    if (moved) touches = w_and(touches, w_not(w_greater(x->approach[i], w_set(c->threshold))));
    x->approach[i] = w_choose(touches, u, moved ? x->approach[i] : zero);
    x->flight[i] = w_choose(touches, w_max(flight, zero), x->flight[i]);
    if (!moved) x->when = w_choose(touches, w_min(x->when, gap / u), x->when);
}

// What changes d of the other points take from the request of point j: scale_j sum_i m_j K_ij d_i. The stored m_j K_ij,
// i < j, stand for m_i K_ij too.
FE_INLINE wide NAMED(lost_at)(const ROW *row, const wide *scale, const wide *d, int j)
{
    wide sum = w_set(0.0f);
    UNROLL for (int i = 0; i < POINTS; ++i) if (i != j) sum = sum + row->coupling[coupling_of[i][j]] * d[i];
    return scale ? scale[j] * sum : sum;
}

// All points at once, each by the same share of its request, e_i = wish_i - l_i:  d = a e,  a = e.e / e.(M e),  M_ij =
// m_j K_ij. A step of steepest descent, and what it knows nothing of is the order of the points: a box that lands flat
// gets four equal impulses and does not rotate, where a sweep alone gives the first point the most.
FE_INLINE void NAMED(predict_points)(ROW *row, wide *request, const wide *scale)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), square = zero, along = zero, d[POINTS];
    UNROLL for (int i = 0; i < POINTS; ++i) d[i] = request[i] - row->point[i].impulse;
    UNROLL for (int j = 0; j < POINTS; ++j)
    {
        square = square + d[j] * d[j];
        along = along + d[j] * (d[j] + NAMED(lost_at)(row, scale, d, j));
    }
    wide share = w_choose(w_greater(along, 0.5f * square), square / along, one);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        wide before = row->point[i].impulse;
        row->point[i].impulse = w_max(before + share * d[i], zero);
        d[i] = row->point[i].impulse - before;
    }
    UNROLL for (int j = 0; j < POINTS; ++j) request[j] = request[j] - NAMED(lost_at)(row, scale, d, j);
}

// The points of a row without weights: A = K + (1 / w - 1 / m) of its diagonal, w_i = scale_i m_i: what they answer to
// impulses, with the softness
typedef struct NAMED(answers) {
    wide k[POINTS][POINTS], weight[POINTS];
} NAMED(answers);

FE_INLINE void NAMED(find_answers)(const ROW *row, const wide *scale, NAMED(answers) * out)
{
    UNROLL for (int j = 0; j < POINTS; ++j)
    {
        wide inverse = w_inverse_or_zero(row->point[j].mass);
        out->weight[j] = scale ? scale[j] * row->point[j].mass : row->point[j].mass;
        out->k[j][j] = w_inverse_or_zero(out->weight[j]);
        UNROLL for (int i = 0; i < j; ++i) out->k[i][j] = out->k[j][i] =
            inverse * row->coupling[coupling_of[i][j]] *
            w_choose(w_greater(row->point[i].mass, w_set(0.0f)), w_set(1.0f), w_set(0.0f));
    }
}

FE_INLINE wide NAMED(answer)(const NAMED(answers) * a, const wide *d, int j)
{
    wide sum = a->k[j][0] * d[0];
    UNROLL for (int i = 1; i < POINTS; ++i) sum = sum + a->k[j][i] * d[i];
    return sum;
}

FE_INLINE wide NAMED(product)(const wide *a, const wide *b)
{
    wide sum = a[0] * b[0];
    UNROLL for (int i = 1; i < POINTS; ++i) sum = sum + a[i] * b[i];
    return sum;
}

// Of a link that shows the mass of its tree. A wheel with a flat side spins about its axle as easily as ever, and lifts
// the cart: a step of steepest descent does one or the other. Conjugate gradients (M. Hestenes and E. Stiefel, 1952) do
// all three that the points of a plane can ask for. What they leave above 0 is gone to as far as it takes energy.
static __attribute__((noinline)) void NAMED(predict_lent)(ROW *row, wide *request, const wide *scale)
{
    NAMED(answers) a;
    wide zero = w_set(0.0f), wish[POINTS], r[POINTS], z[POINTS], d[POINTS], by[POINTS], to[POINTS];
    wide_mask lent = lanes_of(row->lent);
    NAMED(find_answers)(row, scale, &a);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        to[i] = zero, z[i] = d[i] = request[i] - row->point[i].impulse;
        r[i] = wish[i] = a.k[i][i] * d[i];
    }
    wide square = NAMED(product)(r, z);
    for (int step = 0; step < FE__POINTS - 1; ++step) {
        wide size = zero;
        UNROLL for (int j = 0; j < POINTS; ++j) by[j] = NAMED(answer)(&a, d, j), size = size + a.k[j][j] * d[j] * d[j];
        wide along = NAMED(product)(d, by);
        wide share = w_choose(w_greater(along, LEAST_ALONG * size), square / along, zero);
        UNROLL for (int i = 0; i < POINTS; ++i)
        {
            to[i] = to[i] + share * d[i], r[i] = r[i] - share * by[i];
            z[i] = a.weight[i] * r[i];
        }
        wide left = NAMED(product)(r, z), next = left * w_inverse_or_zero(square);
        UNROLL for (int i = 0; i < POINTS; ++i) d[i] = z[i] + next * d[i];
        square = left;
    }
    UNROLL for (int i = 0; i < POINTS; ++i) d[i] = w_max(row->point[i].impulse + to[i], zero) - row->point[i].impulse;
    UNROLL for (int j = 0; j < POINTS; ++j) by[j] = NAMED(answer)(&a, d, j);
    wide share = w_clamp(NAMED(product)(d, wish) * w_inverse_or_zero(NAMED(product)(d, by)), zero, w_set(1.0f));
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        contact_point *q = row->point + i;
        q->impulse = w_choose(lent, w_max(q->impulse + share * d[i], zero), q->impulse);
        request[i] = w_choose(lent, request[i] - a.weight[i] * share * (by[i] - a.k[i][i] * d[i]), request[i]);
    }
}

static __attribute__((noinline)) void NAMED(predict_mixed)(ROW *row, wide *request, const wide *scale)
{
    wide_mask lent = lanes_of(row->lent);
    wide asked[POINTS], before[POINTS];
    UNROLL for (int i = 0; i < POINTS; ++i) asked[i] = request[i], before[i] = row->point[i].impulse;
    NAMED(predict_points)(row, request, scale);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        row->point[i].impulse = w_choose(lent, before[i], row->point[i].impulse);
        request[i] = w_choose(lent, asked[i], request[i]);
    }
    NAMED(predict_lent)(row, request, scale);
}

// Runs the points against each other on their impulses. request[i] is the new impulse of point i before max(., 0); a
// change d at point i lowers request[j] by scale_j m_j K_ij d. Returns the sum of the changes and their moment about
// A's centre.
FE_INLINE wide3 NAMED(sweep_points)(ROW *row, wide *request, const wide *scale, int lent, wide *out_sum)
{
    wide zero = w_set(0.0f), sum = zero, first[POINTS];
    wide3 moment = w_zero3();
    UNROLL for (int i = 0; i < POINTS; ++i) first[i] = row->point[i].impulse;
    if (POINTS > 1 && lent)
        NAMED(predict_mixed)(row, request, scale);
    else if (POINTS > 1)
        NAMED(predict_points)(row, request, scale);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        contact_point *q = row->point + i;
        wide impulse = w_max(request[i], zero), change = impulse - q->impulse;
        q->impulse = impulse;
        UNROLL for (int j = i + 1; j < POINTS; ++j)
        {
            wide k = row->coupling[coupling_of[i][j]];
            request[j] = request[j] - (scale ? scale[j] * k : k) * change;
        }
        change = impulse - first[i];
        sum = sum + change;
        moment = w_add_scaled(moment, change, load3(q->r));
    }
    *out_sum = sum;
    return moment;
}

FE_INLINE wide NAMED(load_of)(const ROW *row)
{
    wide load = row->point[0].impulse;
    UNROLL for (int i = 1; i < POINTS; ++i) load = load + row->point[i].impulse;
    return load;
}

// Lanes in which passes are too slow for a loaded point to close its gap at once, see stiffen
FE_INLINE wide_mask NAMED(eased)(const ROW *row, int i)
{
    return w_and(lanes_of(row->lent), w_greater(row->point[i].impulse, w_set(0.0f)));
}

// The impulses that the points request while the others keep theirs, before max(., 0). `scale`: weights of their
// velocities. Soft:   l' = max(ms l - m (ms vn + bias), 0);   bias = ms s / h where the gap s > 0, the spring's
// otherwise, which keeps ms = 1 - is of the impulse. Relax, and wherever there is a gap (for a loaded point, of more
// than TOUCHING): l' = max(l - m (vn + max(s / h, 0)), 0)
FE_INLINE void NAMED(requests)(ROW *row, const fe__step_constants *c, const pair *p, int kind, int soft, int lent,
                               wide *request, wide *scale)
{
    const fe__softness *k = kind & FE__ROW_PAIR ? &c->between_dynamic : &c->against_static;
    wide zero = w_set(0.0f), one = w_set(1.0f), slowest = w_set(-c->bias_speed);
    wide soft_scale = w_set(k->mass_scale);
    if (lent) soft_scale = w_choose(lanes_of(row->lent), row->lent_scale, soft_scale);
    wide rate = soft_scale * k->bias_rate;
    affine velocity = NAMED(normal_velocity)(p);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        const contact_point *q = row->point + i;
        wide3 r = load3(q->r);
        wide vn = at(&velocity, r), distance = q->distance, ahead = distance * c->inverse_h;
        if (lent) ahead = w_choose(NAMED(eased)(row, i), row->lent_closing * ahead, ahead);
        if (kind & FE__ROW_SPECIAL) NAMED(record_touch)((SPECIAL_ROW *)row, i, q->impulse, vn, distance, c, !soft);
        if (!soft) {
            request[i] = q->impulse - q->mass * (vn + w_max(ahead, zero));
            continue;
        }
        wide_mask apart = w_greater(distance, w_choose(w_greater(q->impulse, zero), w_set(TOUCHING), zero));
        if (lent) apart = w_and(apart, w_not(NAMED(eased)(row, i)));
        scale[i] = w_choose(apart, one, soft_scale);
        wide bias = w_choose(w_greater(distance, zero), scale[i] * ahead, w_max(rate * distance, slowest));
        request[i] = scale[i] * q->impulse - q->mass * (scale[i] * vn + bias);
    }
}

FE_INLINE wide NAMED(push_points)(ROW *row, const fe__step_constants *c, pair *p, int kind, int soft, int lent)
{
    wide request[POINTS], scale[POINTS], sum;
    NAMED(requests)(row, c, p, kind, soft, lent, request, scale);
    wide3 moment = NAMED(sweep_points)(row, request, soft ? scale : 0, lent, &sum);
    NAMED(apply)(row, p, w_scale(sum, p->normal), w_cross(moment, p->normal), kind);
    return sum;
}

FE_SMALL static __attribute__((noinline)) wide NAMED(push_lent_points)(ROW *row, const fe__step_constants *c, pair *p,
                                                                       int kind, int soft)
{
    return NAMED(push_points)(row, c, p, kind, soft, 1);
}

// Returns by how much the load changed. Lent rows are few: they get a copy of the pair, as what another function writes
// is no longer kept in registers
FE_INLINE wide NAMED(apply_normals)(ROW *row, const fe__step_constants *c, pair *p, int kind, int soft)
{
    if (!row->lent) return NAMED(push_points)(row, c, p, kind, soft, 0);
    pair copy = *p;
    wide sum = NAMED(push_lent_points)(row, c, &copy, kind, soft);
    *p = copy;
    return sum;
}

// The energy that changes of the normal impulses give: the work at the mean of the speeds before and after, and what
// they change in the discrete flight, whose energy is v^2/2 - g x + h g v / 2 of the closing acceleration g: an impulse
// before the bodies move shifts them too.
FE_INLINE wide NAMED(gain_of)(const SPECIAL_ROW *x, const wide *before, const affine *was, const affine *is,
                              wide flight)
{
    wide gain = w_set(0.0f);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        const contact_point *q = x->row.point + i;
        wide3 r = load3(q->r);
        gain = gain + (q->impulse - before[i]) * (0.5f * (at(was, r) + at(is, r)) + flight);
    }
    return gain;
}

FE_INLINE wide NAMED(solve_normals)(ROW *row, const fe__step_constants *c, pair *p, int kind, int soft)
{
    SPECIAL_ROW *x = (SPECIAL_ROW *)row;
    wide before[POINTS];
    affine was = NAMED(normal_velocity)(p);
    UNROLL for (int i = 0; i < POINTS; ++i) before[i] = row->point[i].impulse;
    if (kind & FE__ROW_SPECIAL && soft) x->when = w_set(c->h);
    wide change = NAMED(apply_normals)(row, c, p, kind, soft);
    if (!(kind & FE__ROW_SPECIAL)) return change;
    affine is = NAMED(normal_velocity)(p);
    wide gain = NAMED(gain_of)(x, before, &was, &is, (soft ? 0.5f : -0.5f) * c->h * x->closing);
    x->gain = soft ? gain : x->gain + gain;
    return change;
}

// ---- friction -------------------------------------------------------------------------------------------------------

// What surfaces add to the slip: the velocity of a belt, and a correction where a kinematic A rotates. A's velocity is
// to be that of the middle of the substep, which led from pose to pose,
//     wA x r - h/2 wA x (wA x r)         r: to B's centre
// and not that of its end. What rides on A would get the next substep's velocity half a substep early, and creep
// inwards by w^2 r h / 2.
FE_INLINE wide3 NAMED(surface_slip)(const SPECIAL_ROW *x, const pair *p, int kind)
{
    wide3 surface = load3(x->surface);
    if (kind & FE__ROW_PAIR) return surface;
    return w_sub_scaled(surface, x->half_h, w_cross(p->a.w, w_cross(p->a.w, p->span)));
}

// Of the impulses l within Coulomb's cone, |l| <= c, those of a contact that slides dissipate most (J. Moreau, 1988):
//     u' = u + K (l - l0) = -k l,  |l| = c        they oppose the slip u' that is left
//     l = -(K + k)^-1 (u - K l0)                  l0: the impulse before, with which the slip is u
// k = |u'| / c is not known before u' is, but |u| / c is nearly the same, and the same for what slides on from pass to
// pass. With M = K^-1 and s = c / |u| tr M, the direction of l is that of
//     s (l0 - M u) + adj(M) l0 / tr M - u det M / tr M
// The first term alone, l0 - M u, would stop the slip. Cut off at the cone it leads a body that rotates more easily one
// way than the other from its line.
static __attribute__((noinline)) void NAMED(slide)(const ROW *row, wide v1, wide v2, wide stick, wide_mask beyond,
                                                   wide *l1, wide *l2)
{
    const wide *m = row->tangent_mass, *l0 = row->tangent_impulse;
    wide slide = row->dynamic_friction * NAMED(load_of)(row), square = *l1 * *l1 + *l2 * *l2;
    wide most = w_choose(w_greater(square, BREAKAWAY * BREAKAWAY * stick * stick), slide, stick);
    wide per_trace = w_inverse_or_zero(m[0] + m[2]), n0 = per_trace * m[0], n1 = per_trace * m[1];
    wide part = w_min(most * per_trace / w_sqrt(v1 * v1 + v2 * v2), w_set(MOST_PART)), u = n0 * m[2] - n1 * m[1];
    wide w1 = part * *l1 + ((1.0f - n0) * l0[0] - n1 * l0[1] - u * v1);
    wide w2 = part * *l2 + (n0 * l0[1] - n1 * l0[0] - u * v2);
    wide scale = most / w_sqrt(w_max(w1 * w1 + w2 * w2, w_set(FLT_MIN)));
    *l1 = w_choose(beyond, scale * w1, *l1);
    *l2 = w_choose(beyond, scale * w2, *l2);
}

// Twist about n, |l| <= mu sum lever_i l_i; then the two tangents at the friction centre as one block, |l| <= mu sum
// l_i. Twist reaches the tangents through twist_tangent, so that both are applied to the bodies at once. A contact
// sticks up to the static friction; one that would need much more slides, with the dynamic one. What the tangents
// request is taken `stretch` times. Returns by how much they changed, m/s.
FE_INLINE wide NAMED(solve_friction)(ROW *row, pair *p, wide stretch, int kind)
{
    wide3 t1, t2, ra = load3(row->centre), rb = w_add(ra, p->span);
    tangents(p->normal, &t1, &t2);
    wide load = NAMED(load_of)(row), twisted = w_set(0.0f);
    if (POINTS > 1) {
        wide twist_load = row->lever[0] * row->point[0].impulse;
        UNROLL for (int i = 1; i < POINTS; ++i) twist_load = twist_load + row->lever[i] * row->point[i].impulse;
        wide twist = row->twist_impulse - row->twist_mass * w_dot(p->normal, w_sub(p->b.w, p->a.w));
        wide slide = row->dynamic_friction * twist_load, stick = row->static_friction * twist_load;
        twist = w_choose(w_greater(w_abs(twist), stick), w_clamp(twist, -slide, slide), twist);
        twist = w_flush(twist, w_set(FE__LEAST_TWIST));
        twisted = twist - row->twist_impulse;
        row->twist_impulse = twist;
    }
    wide3 slip = w_sub(w_add(p->b.v, w_cross(p->b.w, rb)), w_add(p->a.v, w_cross(p->a.w, ra)));
    if (kind & FE__ROW_SPECIAL) slip = w_add(slip, NAMED(surface_slip)((const SPECIAL_ROW *)row, p, kind));
    wide v1 = w_dot(t1, slip) + row->twist_tangent[0] * twisted, v2 = w_dot(t2, slip) + row->twist_tangent[1] * twisted;
    const wide *m = row->tangent_mass;
    wide least = w_set(FE__LEAST_IMPULSE),
         l1 = w_flush(row->tangent_impulse[0] - stretch * (m[0] * v1 + m[1] * v2), least),
         l2 = w_flush(row->tangent_impulse[1] - stretch * (m[1] * v1 + m[2] * v2), least);
    wide_mask bears = w_greater(load, w_set(0.0f)); // else none, however little was requested
    wide stick = row->static_friction * load, square = l1 * l1 + l2 * l2;
    wide_mask beyond = w_greater(square, stick * stick);
    if (w_any(w_and(beyond, bears))) {
        wide s1 = l1, s2 = l2; // l1 and l2 stay in registers
        NAMED(slide)(row, v1, v2, stick, beyond, &s1, &s2);
        l1 = s1, l2 = s2;
    }
    l1 = w_choose(bears, l1, w_set(0.0f));
    l2 = w_choose(bears, l2, w_set(0.0f));
    wide d1 = l1 - row->tangent_impulse[0], d2 = l2 - row->tangent_impulse[1];
    wide3 impulse = w_add_scaled(w_scale(d1, t1), d2, t2);
    row->tangent_impulse[0] = l1;
    row->tangent_impulse[1] = l2;
    NAMED(apply)(row, p, impulse, w_add_scaled(w_cross(ra, impulse), twisted, p->normal), kind);
    return (p->a.inverse_mass + p->b.inverse_mass) * (w_abs(d1) + w_abs(d2));
}

// Rolling resistance: a torque in the tangent plane against the relative spin, at most rolling * load. Spinning
// resistance: the same about n.
FE_INLINE void NAMED(solve_rolling)(SPECIAL_ROW *x, pair *p, int kind)
{
    wide load = NAMED(load_of)(&x->row), one = w_set(1.0f);
    wide3 n = p->normal, relative = w_sub(p->b.w, p->a.w), before = load3(x->rolling_impulse);
    wide along = w_dot(n, before), turning = w_dot(n, relative), cap = x->spinning * load;
    wide spin = w_clamp(along - x->spinning_mass * turning, -cap, cap);
    wide3 roll = w_sub_scaled(before, along, n);
    roll = w_sub(roll, w_mul(&x->rolling_mass, w_sub_scaled(relative, turning, n)));
    roll = w_sub_scaled(roll, w_dot(n, roll), n);
    wide most = x->rolling * load, square = w_dot(roll, roll);
    roll = w_scale(w_choose(w_greater(square, most * most), most / w_sqrt(square), one), roll);
    wide3 after = w_flush3(w_add_scaled(roll, spin, n), w_set(FE__LEAST_TWIST));
    store3(x->rolling_impulse, after);
    NAMED(apply_torque)(&x->row, p, w_sub(after, before), kind);
}

FE_INLINE PASSING NAMED(passing_of)(const ROW *row, const pair *p, int kind)
{
    const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
    PASSING was = {.tangent = {row->tangent_impulse[0], row->tangent_impulse[1]},
                   .twist = row->twist_impulse,
                   .a = p->a,
                   .b = p->b};
    UNROLL for (int i = 0; i < POINTS; ++i) was.point[i] = row->point[i].impulse;
    if (!(kind & FE__ROW_SPECIAL)) return was;
    was.rolling = load3(x->rolling_impulse), was.gain = x->gain;
    UNROLL for (int i = 0; i < POINTS; ++i) was.approach[i] = x->approach[i], was.flight[i] = x->flight[i];
    return was;
}

// the lanes beside `lanes` are as before a pass
FE_INLINE void NAMED(keep_others)(ROW *row, pair *p, const PASSING *was, wide_mask lanes, int kind)
{
    SPECIAL_ROW *x = (SPECIAL_ROW *)row;
    p->a = choose_side(lanes, p->a, was->a), p->b = choose_side(lanes, p->b, was->b);
    UNROLL for (int i = 0; i < POINTS; ++i) row->point[i].impulse =
        w_choose(lanes, row->point[i].impulse, was->point[i]);
    for (int i = 0; i < 2; ++i) row->tangent_impulse[i] = w_choose(lanes, row->tangent_impulse[i], was->tangent[i]);
    row->twist_impulse = w_choose(lanes, row->twist_impulse, was->twist);
    if (!(kind & FE__ROW_SPECIAL)) return;
    store3(x->rolling_impulse, w_choose3(lanes, load3(x->rolling_impulse), was->rolling));
    x->gain = w_choose(lanes, x->gain, was->gain);
    UNROLL for (int i = 0; i < POINTS; ++i)
    {
        x->approach[i] = w_choose(lanes, x->approach[i], was->approach[i]);
        x->flight[i] = w_choose(lanes, x->flight[i], was->flight[i]);
    }
}

// By how much the load rose: since the last substep, or by this relax pass. For a touch is stopped in two substeps: the
// first leaves it the speed that its gap allows, the next takes that, and carries the load of the first. What bears for
// longer is pressed, not struck: a joint that quarrels with it may raise its load in every relax pass. What has
// restitution bounces after relax.
FE_INLINE wide NAMED(rise_of)(const ROW *row, wide gain, int kind)
{
    const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
    wide since = NAMED(load_of)(row) - row->load, before = row->total[0];
    UNROLL for (int i = 1; i < POINTS; ++i) before = before + row->total[i];
    wide_mask lasts = w_greater(before, row->load);
    if (kind & FE__ROW_SPECIAL) lasts = w_or(lasts, w_greater(x->restitution, w_set(0.0f)));
    return w_choose(lasts, since, w_max(gain, since));
}

FE_INLINE wide_mask NAMED(is_impact)(wide load, wide rise, wide response, const fe__step_constants *c)
{
    return w_and(w_greater(rise, IMPACT_SHARE * load), w_greater(rise * response, w_set(c->impact)));
}

// Lanes whose friction changed too much by the last pass, see settle. Of impacts only those of several points, which
// may hold the body flat. `change`: m/s
FE_INLINE wide_mask NAMED(unsettled)(const ROW *row, const pair *p, wide change, wide rise, const fe__step_constants *c,
                                     int kind)
{
    const SPECIAL_ROW *x = (const SPECIAL_ROW *)row;
    wide response = p->a.inverse_mass + p->b.inverse_mass, load = NAMED(load_of)(row);
    wide friction = w_abs(row->tangent_impulse[0]) + w_abs(row->tangent_impulse[1]);
    wide_mask gentle = w_greater(w_set(c->impact), rise * response);
    wide_mask lands = w_and(NAMED(has_many)(row), NAMED(is_impact)(load, rise, response, c));
    if (kind & FE__ROW_SPECIAL) lands = w_and(lands, w_not(w_greater(x->restitution, w_set(0.0f))));
    wide_mask set_down = w_and(NAMED(has_many)(row), w_and(gentle, w_greater(rise, SET_DOWN * load)));
    wide least = w_choose(gentle, UNSETTLED * load, UNSETTLED_LANDING * friction) * response + UNSETTLED_SPEED;
    least = w_choose(set_down, UNSETTLED_SET_DOWN * load * response + UNSETTLED_SET_DOWN_SPEED, least);
    return w_and(w_or(gentle, lands), w_greater(change, least));
}

// Friction and points that run by turns approach their result by parts, each the share r of the one before it. After d0
// and d1 the rest is r d1 (1 + r + r^2 ...), so the next part, r d1, is stretched by
//     1 / (1 - r),   r = d0.d1 / d0.d0     (Aitken 1926).
// `last`: d0, then d1; 0 after a part that was stretched, which begins anew. Returns by how much the next part is to be
// stretched.
FE_INLINE wide NAMED(note_part)(const ROW *row, const wide *before, wide stretch, wide *last)
{
    wide zero = w_set(0.0f), one = w_set(1.0f);
    wide d[2] = {row->tangent_impulse[0] - before[0], row->tangent_impulse[1] - before[1]};
    wide along = last[0] * d[0] + last[1] * d[1], square = last[0] * last[0] + last[1] * last[1];
    wide share = w_clamp(along * w_inverse_or_zero(square), zero, w_set(MOST_SHARE));
    for (int i = 0; i < 2; ++i) last[i] = w_choose(w_greater(stretch, one), zero, d[i]);
    return one / (one - share);
}

// A friction that comes at once, of what is set down on a slope or pushed, rotates the body, and the less it is held
// the lower the friction grips: a cube's friction is two fifths of what it should be. The points resist that rotation
// and friction has its next part, until little is left; what is at rest, or slides on, has its friction from before.
// The same happens where several points land: a body that was left turning would leave the ground, or get friction
// again when it falls back. One point resists no rotation.
static __attribute__((noinline)) pair NAMED(settle)(ROW *row, const fe__step_constants *c, pair p, wide_mask unsettled,
                                                    wide rise, int kind)
{
    wide one = w_set(1.0f), stretch = one, response = p.a.inverse_mass + p.b.inverse_mass;
    // what lands had no friction before: the first part is that of the pass
    wide last[2] = {row->tangent_impulse[0], row->tangent_impulse[1]};
    wide_mask lands = w_greater(rise * response, w_set(c->impact));
    for (int i = 0; i < SETTLING && w_any(unsettled); ++i) {
        PASSING before = NAMED(passing_of)(row, &p, kind);
        NAMED(solve_normals)(row, c, &p, kind, 0);
        if (kind & FE__ROW_SPECIAL) NAMED(solve_rolling)((SPECIAL_ROW *)row, &p, kind);
        wide change = NAMED(solve_friction)(row, &p, stretch, kind);
        stretch = w_choose(lands, NAMED(note_part)(row, before.tangent, stretch, last), one);
        NAMED(keep_others)(row, &p, &before, unsettled, kind);
        unsettled = w_and(unsettled, NAMED(unsettled)(row, &p, change, rise, c, kind));
    }
    return p;
}

#include "solver/contact/idle.inl"

#include "solver/contact/follow.inl"

#include "solver/contact/bounce.inl"

// ---- impacts --------------------------------------------------------------------------------------------------------
// What a substep carries to the next is a guess of its impulses. Those of an impact, of a load that rose by a third of
// it at once, are over: the next soft pass takes back its normal part, but friction, which only relax solves, would act
// twice, on bodies that rotated on, and give them energy. So it is carried only as it was before, until the load has
// lasted for a substep.
FE_SMALL static __attribute__((noinline)) void NAMED(leave_friction)(ROW *row, const fe__solver *s, wide load,
                                                                     wide rise, wide_mask rose, int kind)
{
    SPECIAL_ROW *x = (SPECIAL_ROW *)row;
    wide3 n = load3(row->normal), centre = load3(row->centre);
    wide part = w_choose(rose, w_min(rise / load, w_set(1.0f)), w_set(0.0f)), keep = 1.0f - part;
    wide3 friction = w_scale(part, NAMED(friction_impulse)(row, n));
    wide3 moment = w_add_scaled(w_cross(centre, friction), part * row->twist_impulse, n);
    if (kind & FE__ROW_SPECIAL) moment = w_add_scaled(moment, part, load3(x->rolling_impulse));
    pair start = {start_side(s, row->line_a), start_side(s, row->line_b), n, load3(row->span)}, was = start;
    NAMED(apply)(row, &start, friction, moment, kind);
    start.a = choose_side(rose, start.a, was.a), start.b = choose_side(rose, start.b, was.b);
    if (kind & FE__ROW_PAIR) scatter_side(s->start, row->line_a, &start.a);
    scatter_side(s->start, row->line_b, &start.b);
    for (int i = 0; i < 2; ++i) row->tangent_impulse[i] = keep * row->tangent_impulse[i];
    for (int i = 0; i < 3 && kind & FE__ROW_SPECIAL; ++i) x->rolling_impulse[i] = keep * x->rolling_impulse[i];
    row->twist_impulse = keep * row->twist_impulse;
}

// ---- strain ---------------------------------------------------------------------------------------------------------
// Does the row bear so much that it strains its island? What bears for a part of the step does not count: the last
// substep's load, times their number, and that of the whole step are both to be large.
FE_INLINE void NAMED(find_strain)(const ROW *row, fe__solver *s, wide speed, wide response, const fe__step_constants *c)
{
    wide total = row->total[0];
    UNROLL for (int i = 1; i < POINTS; ++i) total = total + row->total[i];
    wide lasting = w_min((float)c->substeps * speed, total * response);
    wide_mask strained = w_greater(lasting, w_set(c->strain));
    if (w_any(strained)) mark_strained(s, row->line_b, strained);
}

// ---- passes over the rows -------------------------------------------------------------------------------------------
FE_INLINE ROW *NAMED(row_at)(void *rows, int32_t i, int kind)
{
    return kind & FE__ROW_SPECIAL ? &((SPECIAL_ROW *)rows)[i].row : (ROW *)rows + i;
}

#include "solver/contact/prepare.inl"

FE_INLINE int NAMED(is_late)(const ROW *row) { return row->put_off || row->behind; }

// the row, prepared, with distances from where the bodies are
FE_SMALL static __attribute__((noinline)) void NAMED(catch_up)(ROW *row, fe__solver *s, const fe__records *of,
                                                               const fe__lane *lanes, const fe__step_constants *c,
                                                               int kind)
{
    int32_t behind = row->behind;
    wide open = row->open;
    if (row->put_off) NAMED(prepare_row)(row, lanes, s, of, c, kind);
    row->behind = 0, row->open = open;
    if (!behind) return;
    pair p = NAMED(gather_pair)(row, s, kind);
    motion m = NAMED(motion_of)(row, s, kind);
    NAMED(find_distances)(row, &p, &m, kind);
}

FE_INLINE void NAMED(solve)(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                            const fe__step_constants *c, int kind)
{
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        ROW *row = NAMED(row_at)(rows, i, kind);
        if (NAMED(may_idle)(row, kind)) {
            if (NAMED(idle_now)(row, s, c, kind)) continue;
            if (NAMED(is_late)(row)) NAMED(catch_up)(row, s, of, lanes, c, kind);
        }
        pair p = NAMED(gather_pair)(row, s, kind);
        NAMED(solve_normals)(row, c, &p, kind, 1);
        NAMED(scatter_pair)(row, s, &p, kind);
    }
}

// what the substep did
FE_INLINE void NAMED(note_load)(ROW *row, fe__solver *s, const pair *p, wide gain, const fe__step_constants *c,
                                int kind)
{
    wide load = NAMED(load_of)(row), response = p->a.inverse_mass + p->b.inverse_mass;
    wide rise = NAMED(rise_of)(row, gain, kind); // with the totals of before
    UNROLL for (int j = 0; j < POINTS; ++j) row->total[j] = row->total[j] + row->point[j].impulse;
    wide_mask rose = NAMED(is_impact)(load, rise, response, c);
    if (kind & FE__ROW_SPECIAL) rose = w_and(rose, w_not(NAMED(touched)((SPECIAL_ROW *)row, c->threshold)));
    if (w_any(rose)) NAMED(leave_friction)(row, s, load, rise, rose, kind);
    row->load = load;
    if (kind & FE__ROW_SPECIAL) NAMED(count_touches)((SPECIAL_ROW *)row, s, kind);
    if (c->finds_strain) NAMED(find_strain)(row, s, load * response, response, c);
}

FE_INLINE void NAMED(relax)(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                            const fe__step_constants *c, int kind)
{
    for (int32_t i = 0; i < count; ++i, lanes += FE_W) {
        ROW *row = NAMED(row_at)(rows, i, kind);
        if (NAMED(may_idle)(row, kind)) {
            if (NAMED(idle_after)(row, s, c, kind)) continue;
            if (NAMED(is_late)(row)) NAMED(catch_up)(row, s, of, lanes, c, kind);
        }
        pair p = NAMED(gather_pair)(row, s, kind);
        motion m = NAMED(motion_of)(row, s, kind);
        NAMED(find_distances)(row, &p, &m, kind);
        wide_mask moving = NAMED(moving)(row, &m, kind);
        if (w_any(moving) && NAMED(can_idle)(kind)) moving = NAMED(but_idle)(row, s, moving, c, kind);
        if (w_any(moving)) {
            motion moved = m;
            NAMED(follow)(row, s, &moved, moving, kind);
            p.span = load3(row->span);
        }
        wide gain = NAMED(solve_normals)(row, c, &p, kind, 0);
        if (kind & FE__ROW_SPECIAL) NAMED(solve_rolling)((SPECIAL_ROW *)row, &p, kind);
        wide change = NAMED(solve_friction)(row, &p, w_set(1.0f), kind);
        if (w_any(w_greater(change, w_set(UNSETTLED_SET_DOWN_SPEED)))) {
            wide rise = NAMED(rise_of)(row, gain, kind);
            wide_mask unsettled = NAMED(unsettled)(row, &p, change, rise, c, kind);
            if (w_any(unsettled)) p = NAMED(settle)(row, c, p, unsettled, rise, kind);
        }
        NAMED(scatter_pair)(row, s, &p, kind);
        if (!c->more) NAMED(note_load)(row, s, &p, gain, c, kind);
    }
}

FE_INLINE void NAMED(bounce)(fe__solver *s, void *rows, int32_t count, const fe__step_constants *c, int kind)
{
    for (int32_t i = 0; i < count; ++i) NAMED(bounce_row)((SPECIAL_ROW *)rows + i, s, c, kind);
}

// The touches of rows that share a body with another touch, see impact_chain.c; or what is `near`: without impulse, of
// a body in a chain. `lane`: of the first row. Returns how many
FE_INLINE int32_t NAMED(touches)(const fe__solver *s, const void *rows, int32_t count, int32_t lane, int32_t near,
                                 const fe__step_constants *c, fe__touch *out, int kind)
{
    int32_t found = 0;
    for (int32_t i = 0; i < count; ++i, lane += FE_W) {
        const SPECIAL_ROW *x = (const SPECIAL_ROW *)rows + i;
        wide_mask lanes = near ? NAMED(may_touch)(x) : NAMED(touched)(x, 0.0f);
        if (!w_any(lanes)) continue;
        lanes = NAMED(in_chain)(x, s, lanes, near ? FE__TOUCHES_CHAINED - 1 : 1, kind);
        wide zero = w_set(0.0f), one = w_set(1.0f);
        _Alignas(64) float is[FE_W], when[FE_W], fast[FE_W];
        *(wide *)is = w_choose(lanes, one, zero);
        *(wide *)when = x->when;
        *(wide *)fast = w_choose(NAMED(touched)(x, c->threshold), one, zero);
        for (int k = 0; k < FE_W; ++k)
            if (is[k] != 0.0f)
                out[found++] =
                    (fe__touch){.when = when[k],
                                .fast = fast[k] != 0.0f,
                                .lane = lane + k,
                                .line = {kind & FE__ROW_PAIR ? x->row.line_a[k] : FE__STATIC_LINE, x->row.line_b[k]}};
    }
    return found;
}

// ---- the kernels of each kind ---------------------------------------------------------------------------------------
#define INSTANCE(kind_name, kind)                                                                                    \
    static void NAMED(prepare_##kind_name)(fe__solver * s, const fe__records *of, const fe__lane *lanes, void *rows, \
                                           int32_t count, const fe__step_constants *c)                               \
    {                                                                                                                \
        NAMED(prepare)(s, of, lanes, rows, count, c, kind);                                                          \
    }                                                                                                                \
    static void NAMED(solve_##kind_name)(fe__solver * s, const fe__records *of, const fe__lane *lanes, void *rows,   \
                                         int32_t count, const fe__step_constants *c)                                 \
    {                                                                                                                \
        NAMED(solve)(s, of, lanes, rows, count, c, kind);                                                            \
    }                                                                                                                \
    static void NAMED(relax_##kind_name)(fe__solver * s, const fe__records *of, const fe__lane *lanes, void *rows,   \
                                         int32_t count, const fe__step_constants *c)                                 \
    {                                                                                                                \
        NAMED(relax)(s, of, lanes, rows, count, c, kind);                                                            \
    }                                                                                                                \
    static void NAMED(bounce_##kind_name)(fe__solver * s, void *rows, int32_t count, const fe__step_constants *c)    \
    {                                                                                                                \
        if ((kind)&FE__ROW_SPECIAL) NAMED(bounce)(s, rows, count, c, kind);                                          \
    }                                                                                                                \
    static int32_t NAMED(touches_##kind_name)(const fe__solver *s, const void *rows, int32_t count, int32_t lane,    \
                                              int32_t near, const fe__step_constants *c, fe__touch *out)             \
    {                                                                                                                \
        return (kind)&FE__ROW_SPECIAL ? NAMED(touches)(s, rows, count, lane, near, c, out, kind) : 0;                \
    }                                                                                                                \
    static int32_t NAMED(act_##kind_name)(fe__solver * s, void *row, uint32_t lanes, fe__touch_act act,              \
                                          const fe__step_constants *c)                                               \
    {                                                                                                                \
        return (kind)&FE__ROW_SPECIAL ? NAMED(act)(s, row, lanes_of(lanes), act, c, kind) : 0;                       \
    }                                                                                                                \
    static int32_t NAMED(store_##kind_name)(const fe__records *of, const fe__lane *lanes, const void *rows,          \
                                            int32_t count)                                                           \
    {                                                                                                                \
        return NAMED(store)(of, lanes, rows, count, kind);                                                           \
    }

INSTANCE(fixed, 0)
INSTANCE(pair, FE__ROW_PAIR)
INSTANCE(fixed_special, FE__ROW_SPECIAL)
INSTANCE(pair_special, FE__ROW_PAIR | FE__ROW_SPECIAL)

#undef INSTANCE
#undef SPECIAL_ROW
#undef MASSES
#undef PASSING
#undef ROW
#undef NAMED
#undef POINTS
