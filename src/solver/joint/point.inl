// point.inl - POINT: the anchors of two bodies stay together. Three rows, one block. Part of joint_solver.simd.c.
//
//     v = vB + wB x rB - vA - wA x rA,   K = (1/mA + 1/mB) 1 - [rA] IA^-1 [rA] - [rB] IB^-1 [rB]
//     soft   change = -(K^-1 (mass_scale v + mass_scale bias_rate gap) + impulse_scale l)   (Catto, Soft Constraints,
//     GDC 2011) relax  change = -K^-1 v

// 45 W floats, 180 bytes a joint; solve reads up to `total`
typedef struct {
    line_pair line;
    wide arm_a[3], arm_b[3]; // now: turned with the bodies after each substep
    wide gap[3];             // now: anchor of B - anchor of A
    wide_sym mass;           // K^-1
    wide impulse[3];
    wide_sym inertia_a, inertia_b;                     // inverse, world
    wide shaped;                                       // see shape_of
    wide total[3];                                     // of the impulses of the substeps so far
    wide first_arm_a[3], first_arm_b[3], first_gap[3]; // when the step began
} point_row;

FE_INLINE wide_sym point_mass(const point_row *row, wide linear, wide3 ra, wide3 rb)
{
    wide zero = w_set(0.0f);
    wide_sym k = {linear, zero, zero, linear, zero, linear};
    k = add_arm(k, &row->inertia_a, ra);
    k = add_arm(k, &row->inertia_b, rb);
    return w_inverse_sym(&k);
}

FE_INLINE void apply_point(const point_row *row, ends *e, wide3 ra, wide3 rb, wide3 impulse)
{
    e->a.v = w_sub_scaled(e->a.v, e->a.inverse_mass, impulse);
    e->a.w = w_sub(e->a.w, w_mul(&row->inertia_a, w_cross(ra, impulse)));
    e->b.v = w_add_scaled(e->b.v, e->b.inverse_mass, impulse);
    e->b.w = w_add(e->b.w, w_mul(&row->inertia_b, w_cross(rb, impulse)));
}

// The arms rotated: start takes what that changes in the effect of the impulse
FE_INLINE void correct_start_point(const point_row *row, const fe__solver *s, wide3 ra, wide3 rb, int sides)
{
    wide3 impulse = load3(row->impulse);
    if (sides & FE__MOVES_A) {
        wide4 w = gather_high(s->start, row->line.a);
        wide3 change = w_mul(&row->inertia_a, w_cross(w_sub(ra, load3(row->arm_a)), impulse));
        scatter_high(s->start, row->line.a, w_with(w_add(w_xyz(w), change), w.w));
    }
    if (sides & FE__MOVES_B) {
        wide4 w = gather_high(s->start, row->line.b);
        wide3 change = w_mul(&row->inertia_b, w_cross(w_sub(rb, load3(row->arm_b)), impulse));
        scatter_high(s->start, row->line.b, w_with(w_sub(w_xyz(w), change), w.w));
    }
}

static void prepare_point(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                          int32_t sides, const fe__step_constants *c)
{
    point_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        const row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        anchors first = first_anchors(r, sides);
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        ends e = gather_ends(s, &row->line);
        row->mass = point_mass(row, e.a.inverse_mass + e.b.inverse_mass, first.ra, first.rb);
        wide3 impulse = w_scale(w_set(c->warm_scale), w_xyz(JOINT_QUAD(impulse)));
        store3(row->impulse, impulse), store3(row->total, w_zero3());
        store3(row->arm_a, first.ra), store3(row->arm_b, first.rb), store3(row->gap, first.gap);
        store3(row->first_arm_a, first.ra), store3(row->first_arm_b, first.rb), store3(row->first_gap, first.gap);
        apply_point(row, &e, first.ra, first.rb, impulse);
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

static void solve_point(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    const fe__softness *soft = &c->joint;
    wide rate = w_set(soft->mass_scale * soft->bias_rate), mass_scale = w_set(soft->mass_scale),
         fade = w_set(soft->impulse_scale);
    for (point_row *row = rows, *end = row + count; row < end; ++row) {
        ends e = gather_ends(s, &row->line);
        wide3 ra = load3(row->arm_a), rb = load3(row->arm_b), impulse = load3(row->impulse);
        wide3 request = w_add_scaled(w_scale(mass_scale, speed_between(&e, ra, rb)), rate, load3(row->gap));
        wide3 change = minus(w_add_scaled(w_mul(&row->mass, request), fade, impulse));
        store3(row->impulse, w_add(impulse, change));
        apply_point(row, &e, ra, rb, change);
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

static void relax_point(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (point_row *row = rows, *end = row + count; row < end; ++row) {
        const anchors first = {load3(row->first_arm_a), load3(row->first_arm_b), load3(row->first_gap)};
        anchors now = anchors_now(s, &row->line, &first);
        wide3 old = load3(row->impulse);
        FOLLOW_INERTIA(row, w_cross(load3(row->arm_a), old), w_cross(load3(row->arm_b), old));
        correct_start_point(row, s, now.ra, now.rb, sides);
        store3(row->arm_a, now.ra), store3(row->arm_b, now.rb), store3(row->gap, now.gap);
        ends e = gather_ends(s, &row->line);
        wide_sym mass = row->mass = point_mass(row, e.a.inverse_mass + e.b.inverse_mass, now.ra, now.rb);
        wide3 change = minus(w_mul(&mass, speed_between(&e, now.ra, now.rb))),
              impulse = w_add(load3(row->impulse), change);
        store3(row->impulse, impulse);
        store3(row->total, w_add(load3(row->total), impulse));
        apply_point(row, &e, now.ra, now.rb, change);
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

static void store_point(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows, int32_t count,
                        const fe__step_constants *c)
{
    const point_row *row = rows;
    wide zero = w_set(0.0f), mean = w_set(mean_of(c)), stored = stored_of(c);
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_reactions(&r);
        put_lanes(r.joint, offsetof(fe__joint, impulse), r.real, w_with(w_scale(stored, load3(row->impulse)), zero));
        find_stretch(s, lanes, load3(row->gap), c);
        put_lanes(r.reaction, offsetof(fe__joint_reaction, force), r.real,
                  w_with(w_scale(mean, load3(row->total)), zero));
    }
}
