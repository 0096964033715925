// axis.inl - one degree of freedom x of a joint: limits, a drive to a position, a motor. Part of joint_solver.simd.c.
//
// The parts differ in what x and its gradient are; u is a unit vector, d = anchor of B - anchor of A:
//     X, Y, Z    x = u.d, u an axis of frame A        v = u.(vB + wB x rB - vA - wA x (rA + d))
//     DISTANCE   x = |d|, u = d / |d|                 v = u.(vB + wB x rB - vA - wA x rA)
//     TWIST, SWING_Y, SWING_Z, CONE                   v = g.(wB - wA)
// With q as in joint_solver.h, X and X' the twist axes of A and B, e the unit axis of the swing, y its angle, f = e x
// X:
//     twist      g = (X + X') / (1 + X.X') = X + ((q.x q.y + q.z q.w) Y + (q.x q.z - q.y q.w) Z) / (q.x^2 + q.w^2)
//     swing s    s' = (y e)' = e (e.w) + f (y cot y (f.w) - y (X.w)),   w = wB - wA
//     cone       C = (1 - r) / |dr/ds|, r^2 = (s.y / a)^2 + (s.z / b)^2: the distance to the ellipse, inside positive;
//                g along -dr/ds
//
// Drive: a spring and damper, implicitly: K = m w^2, C = 2 m zeta w, or as given. With c = 1 / (h (C + h K)):
//     change = -(v + h K c (x - target) + c l) / (1/m + c),   |l| <= cap h;   in the soft pass only: once a substep
// Motor: change = -m (v - speed), |l| <= cap h. Limits: as a contact, soft where overrun, met exactly where not.

typedef struct {
    wide mass, response; // 1 / K, K = g.M^-1.g
    wide x;
    wide low, high, rate, fade, rigid;
    wide drive_mass, drive_bias, drive_fade, drive_cap; // found once a substep; the cap is an impulse
    wide speed, motor_cap;
    wide drive, motor, under, over; // impulses: `over` acts downwards
    wide total;                     // of the impulses of the substeps so far
    // relax only
    wide target, stiffness, damping, in_newtons; // in_newtons > 0: not in hertz
    wide limited;                                // > 0: there is a limit
} freedom;

FE_INLINE wide impulse_of(const freedom *f) { return (f->drive + f->motor) + (f->under - f->over); }

FE_INLINE void read_freedom(freedom *f, const row_joints *r, int slot, int cone, const fe__step_constants *c)
{
    wide4 limit = AXIS_QUAD(slot, limit), drive = AXIS_QUAD(slot, drive), motor = AXIS_QUAD(slot, motor);
    wide4 impulse = AXIS_QUAD(slot, impulse), state = AXIS_QUAD(slot, state);
    wide zero = w_set(0.0f), one = w_set(1.0f), none = w_set(FE__UNLIMITED), scale = w_set(c->warm_scale);
    lane_softness lock = lock_softness(r, c), soft = softness_of(limit.z, limit.w, &lock, c);
    *f = (freedom){.x = state.x,
                   .low = cone ? zero : limit.x,
                   .high = cone ? none : limit.y,
                   .rate = soft.rate,
                   .fade = soft.fade,
                   .rigid = soft.rigid,
                   // off: no impulse
                   .drive_cap = w_choose(w_greater(drive.y + motor.z * drive.z, zero), c->h * drive.w, zero),
                   .speed = motor.x,
                   .motor_cap = c->h * motor.y,
                   .drive = scale * impulse.x,
                   .motor = scale * impulse.y,
                   .under = scale * impulse.z,
                   .over = scale * impulse.w,
                   .total = zero,
                   .target = drive.x,
                   .stiffness = drive.y,
                   .damping = drive.z,
                   .in_newtons = motor.z};
    f->limited = w_choose(w_or(w_greater(f->low, -none), w_greater(none, f->high)), one, zero);
}

static void write_freedom(const row_joints *r, const freedom *f, int slot, const fe__step_constants *c)
{
    wide zero = w_set(0.0f), stored = stored_of(c);
    wide4 impulses = {stored * f->drive, stored * f->motor, stored * f->under, stored * f->over};
    put_lanes(r->axes, axis_offset(slot) + offsetof(fe__joint_axis, impulse.drive), r->real, impulses);
    put_lanes(r->axes, axis_offset(slot) + offsetof(fe__joint_axis, state.x), r->real,
              (wide4){f->x, w_set(mean_of(c)) * f->total, zero, zero});
}

FE_INLINE void aim_drive(freedom *f, wide error, const fe__step_constants *c)
{
    wide omega = 2.0f * FE_PI * f->stiffness, zero = w_set(0.0f);
    wide_mask newtons = w_greater(f->in_newtons, zero);
    wide k = w_choose(newtons, f->stiffness, f->mass * omega * omega),
         damp = w_choose(newtons, f->damping, 2.0f * f->mass * f->damping * omega);
    wide soft = c->h * (damp + c->h * k);
    f->drive_fade = w_inverse_or_zero(soft);
    f->drive_mass = w_choose(w_greater(f->drive_fade, zero), 1.0f / (f->response + f->drive_fade), zero);
    f->drive_bias = c->h * k * f->drive_fade * error;
}

// x is known: mass and drive from the new gradient. A response no greater than `least` is none
FE_INLINE void aim(freedom *f, wide response, wide least, int part, const fe__step_constants *c)
{
    f->response = w_choose(w_greater(response, least), response, w_set(0.0f));
    f->mass = w_inverse_or_zero(f->response);
    wide error = f->x - f->target;
    // a twist without limits takes the shorter direction
    if (part == FE__PART_TWIST)
        error =
            w_choose(w_greater(f->limited, w_set(0.0f)), error, error - 2.0f * FE_PI * w_round(error * (0.5f / FE_PI)));
    aim_drive(f, error, c);
}

// one limit: gap >= 0 inside, v its velocity. `lock`: both limits in one, in both directions
FE_INLINE wide limit_impulse(const freedom *f, wide impulse, wide gap, wide v, wide_mask lock,
                             const fe__step_constants *c, int soft)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), request;
    if (soft) {
        wide_mask apart = w_and(w_greater(gap, zero), w_not(lock));
        wide fade = w_choose(apart, zero, f->fade), bias = w_choose(apart, gap * c->inverse_h, f->rate * gap);
        request = (impulse - fade * impulse) - f->mass * ((one - fade) * v + bias);
    } else {
        wide_mask spring = w_and(w_greater(one, f->rigid), w_or(lock, w_not(w_greater(gap, zero))));
        request =
            w_choose(spring, impulse, impulse - f->mass * (v + w_choose(lock, zero, w_max(gap, zero) * c->inverse_h)));
    }
    return w_choose(lock, request, w_max(request, zero));
}

// the change of the whole impulse
FE_INLINE wide solve_freedom(freedom *f, wide v, const fe__step_constants *c, int soft)
{
    wide before = impulse_of(f);
    if (soft) {
        wide drive = w_clamp(f->drive - f->drive_mass * (v + f->drive_bias + f->drive_fade * f->drive), -f->drive_cap,
                             f->drive_cap);
        v = v + f->response * (drive - f->drive);
        f->drive = drive;
    }
    wide motor = w_clamp(f->motor - f->mass * (v - f->speed), -f->motor_cap, f->motor_cap);
    v = v + f->response * (motor - f->motor);
    f->motor = motor;
    wide_mask lock = w_not(w_greater(f->high, f->low));
    wide under = limit_impulse(f, f->under, f->x - f->low, v, lock, c, soft);
    v = v + f->response * (under - f->under);
    f->under = under;
    f->over = w_choose(lock, w_set(0.0f), limit_impulse(f, f->over, f->high - f->x, -v, lock, c, soft));
    return impulse_of(f) - before;
}

// A gradient that jumps (a twist at 180 degrees of swing, a distance through zero) has no use for its old impulse
#define JUMP 0.25f // of the square of its length
FE_INLINE wide_mask forget_jump(freedom *f, wide3 before, wide3 after)
{
    wide3 change = w_sub(after, before);
    wide_mask jumps = w_greater(w_dot(change, change), JUMP * w_dot(before, before));
    wide zero = w_set(0.0f);
    f->drive = w_choose(jumps, zero, f->drive), f->motor = w_choose(jumps, zero, f->motor);
    f->under = w_choose(jumps, zero, f->under), f->over = w_choose(jumps, zero, f->over);
    return jumps;
}

// ---- linear ---------------------------------------------------------------------------------------------------------
typedef struct {
    line_pair line;
    wide u[3];
    wide moment_a[3], moment_b[3]; // of u at the anchors
    wide spin_a[3], spin_b[3];     // the rotation rates that u causes
    wide mass_a[3], mass_b[3];     // inverse, along the world's axes: 0 where locked
    freedom f;
    wide unlocked; // inverse masses, locks aside
    wide shaped;
    wide_sym inertia_a, inertia_b;
    wide first_frame[4]; // A's
    wide first_arm_a[3], first_arm_b[3], first_gap[3];
} linear_row;

FE_INLINE void place_linear(linear_row *row, const fe__solver *s, int part, const fe__step_constants *c)
{
    const anchors first = {load3(row->first_arm_a), load3(row->first_arm_b), load3(row->first_gap)};
    anchors now = anchors_now(s, &row->line, &first);
    wide3 u, arm = now.ra;
    if (part == FE__PART_DISTANCE) {
        wide length = w_sqrt(w_dot(now.gap, now.gap));
        wide_mask apart = w_greater(length, w_set(0.0f));
        u = w_choose3(apart, w_scale(1.0f / length, now.gap),
                      frame_axis(frame_now(s, row->line.a, row->first_frame), 0));
        row->f.x = length;
    } else {
        u = frame_axis(frame_now(s, row->line.a, row->first_frame), part - FE__PART_X);
        row->f.x = w_dot(u, now.gap);
        arm = w_add(arm, now.gap);
    }
    wide3 ma = w_cross(arm, u), mb = w_cross(now.rb, u), sa = w_mul(&row->inertia_a, ma),
          sb = w_mul(&row->inertia_b, mb);
    wide linear = w_dot(u, w_times(w_add(load3(row->mass_a), load3(row->mass_b)), u));
    store3(row->u, u), store3(row->moment_a, ma), store3(row->moment_b, mb), store3(row->spin_a, sa),
        store3(row->spin_b, sb);
    aim(&row->f, linear + (w_dot(ma, sa) + w_dot(mb, sb)), LOCKED_RESPONSE * row->unlocked, part, c);
}

FE_INLINE void apply_linear(const linear_row *row, ends *e, wide impulse)
{
    wide3 l = w_scale(impulse, load3(row->u));
    e->a.v = w_sub(e->a.v, w_times(load3(row->mass_a), l)), e->a.w = w_sub_scaled(e->a.w, impulse, load3(row->spin_a));
    e->b.v = w_add(e->b.v, w_times(load3(row->mass_b), l)), e->b.w = w_add_scaled(e->b.w, impulse, load3(row->spin_b));
}

// The row rotated: start takes what that changes in the effect of its impulse
FE_INLINE void correct_start_linear(const linear_row *row, const fe__solver *s, wide l, wide_mask jumps, wide3 u,
                                    wide3 spin_a, wide3 spin_b, int sides)
{
    ends start = {start_side(s, row->line.a), start_side(s, row->line.b)};
    wide3 change = w_scale(l, w_sub(w_choose3(jumps, w_zero3(), load3(row->u)), u));
    start.a.v = w_add(start.a.v, w_times(load3(row->mass_a), change)),
    start.b.v = w_sub(start.b.v, w_times(load3(row->mass_b), change));
    start.a.w = w_add_scaled(start.a.w, l, w_sub(w_choose3(jumps, w_zero3(), load3(row->spin_a)), spin_a));
    start.b.w = w_sub_scaled(start.b.w, l, w_sub(w_choose3(jumps, w_zero3(), load3(row->spin_b)), spin_b));
    scatter_ends(s->start, &row->line, &start, sides);
}

FE_INLINE wide linear_speed(const linear_row *row, const ends *e)
{
    return w_dot(load3(row->u), w_sub(e->b.v, e->a.v)) +
           (w_dot(load3(row->moment_b), e->b.w) - w_dot(load3(row->moment_a), e->a.w));
}

FE_SMALL FE_INLINE void prepare_linear(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                       int32_t count, int32_t sides, const fe__step_constants *c, int part, int slot)
{
    linear_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        find_axes(r);
        anchors first = first_anchors(r, sides);
        store3(row->first_arm_a, first.ra), store3(row->first_arm_b, first.rb), store3(row->first_gap, first.gap);
        store4(row->first_frame, first_frame(r->body_a, FRAME_QUAD(frame_a)));
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        ends e = gather_ends(s, &row->line);
        store3(row->mass_a, free_mass(&e.a)), store3(row->mass_b, free_mass(&e.b));
        row->unlocked = e.a.inverse_mass + e.b.inverse_mass;
        read_freedom(&row->f, r, slot, 0, c);
        place_linear(row, s, part, c);
        apply_linear(row, &e, impulse_of(&row->f));
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

static void solve_linear(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    for (linear_row *row = rows, *end = row + count; row < end; ++row) {
        ends e = gather_ends(s, &row->line);
        apply_linear(row, &e, solve_freedom(&row->f, linear_speed(row, &e), c, 1));
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

FE_INLINE void relax_linear(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c,
                            int part)
{
    for (linear_row *row = rows, *end = row + count; row < end; ++row) {
        wide3 u = load3(row->u), spin_a = load3(row->spin_a), spin_b = load3(row->spin_b);
        wide l = impulse_of(&row->f);
        FOLLOW_INERTIA(row, w_zero3(), w_zero3()); // correct_start_linear sees the change of the spins
        place_linear(row, s, part, c);
        correct_start_linear(row, s, l, forget_jump(&row->f, u, load3(row->u)), u, spin_a, spin_b, sides);
        ends e = gather_ends(s, &row->line);
        apply_linear(row, &e, solve_freedom(&row->f, linear_speed(row, &e), c, 0));
        row->f.total = row->f.total + impulse_of(&row->f);
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL FE_INLINE void store_linear(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                     int32_t count, const fe__step_constants *c, int slot)
{
    (void)s;
    const linear_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_axes(&r);
        write_freedom(&r, &row->f, slot, c);
    }
}

// ---- angular --------------------------------------------------------------------------------------------------------
typedef struct {
    line_pair line;
    wide g[3];                 // gradient, world
    wide spin_a[3], spin_b[3]; // the rotation rates that a unit impulse causes
    freedom f;
    wide_sym inertia_a, inertia_b;
    wide shaped;
    wide cone[2];                // half angles
    wide first_a[4], first_b[4]; // frames
} angular_row;

// the swing of q: its angle about the unit vector (0, y, z)
typedef struct {
    wide y, z, angle, angle_cot;
} swing;

// A swing of 180 degrees, where y cot y is infinite, is kept away from by this cosine of half the angle
#define LEAST_COSINE 0.02f
// below this cosine of half the swing (168 degrees) the twist is undefined: it is left alone
#define TWIST_DEFINED 0.1f

FE_INLINE swing swing_of(wide4 q)
{
    wide zero = w_set(0.0f), one = w_set(1.0f), tiny = w_set(1e-12f);
    wide n = w_sqrt(q.w * q.w + q.x * q.x), sine = w_sqrt(q.y * q.y + q.z * q.z);
    wide_mask defined = w_greater(n, tiny); // else a swing of 180 degrees: the twist before it is undefined
    wide y = w_choose(defined, q.w * q.y - q.x * q.z, q.y), z = w_choose(defined, q.w * q.z + q.x * q.y, q.z),
         length = w_sqrt(y * y + z * z);
    wide_mask swings = w_greater(length, tiny);
    wide angle = 2.0f * w_atan2(sine, n), least = w_max(n, w_set(LEAST_COSINE));
    wide over_sine = w_choose(w_greater(sine, w_set(1e-4f)), angle / (2.0f * sine * least), one);
    return (swing){w_choose(swings, y / length, one), w_choose(swings, z / length, zero), angle,
                   over_sine * (n * n - sine * sine)};
}

// gradient of a swing coordinate with slopes along e and f
FE_INLINE wide3 swing_gradient(const swing *s, wide along_e, wide along_f)
{
    return (wide3){-(along_f * s->angle), along_e * s->y + along_f * s->angle_cot * s->z,
                   along_e * s->z - along_f * s->angle_cot * s->y};
}

FE_INLINE wide3 cone_gradient(angular_row *row, const swing *s)
{
    wide ya = s->y / row->cone[0], zb = s->z / row->cone[1], reach = s->angle * w_sqrt(ya * ya + zb * zb);
    wide y = ya / row->cone[0], z = zb / row->cone[1], k = 1.0f / w_sqrt(y * y + z * z),
         over = w_sqrt(ya * ya + zb * zb);
    // |dr/ds| = sqrt(y^2 + z^2) / over
    row->f.x = (1.0f - reach) * over * k;
    return swing_gradient(s, -(k * (y * s->y + z * s->z)), -(k * (y * s->z - z * s->y)));
}

FE_INLINE wide3 twist_gradient(freedom *f, wide4 q)
{
    wide n2 = q.x * q.x + q.w * q.w, twist = 2.0f * w_atan2(q.x, q.w);
    wide_mask defined = w_greater(n2, w_set(TWIST_DEFINED * TWIST_DEFINED));
    wide k = w_choose(defined, 1.0f / n2, w_set(0.0f));
    wide wound = twist + 2.0f * FE_PI * w_round((f->x - twist) * (0.5f / FE_PI));
    f->x = w_choose(w_and(defined, w_greater(f->limited, w_set(0.0f))), wound, twist);
    return (wide3){k * n2, k * (q.x * q.y + q.z * q.w), k * (q.x * q.z - q.y * q.w)};
}

FE_INLINE void place_angular(angular_row *row, const fe__solver *s, int part, const fe__step_constants *c)
{
    wide4 qa = frame_now(s, row->line.a, row->first_a),
          q = positive(w_product(w_conjugate(qa), frame_now(s, row->line.b, row->first_b)));
    wide3 g;
    if (part == FE__PART_TWIST)
        g = twist_gradient(&row->f, q);
    else {
        swing w = swing_of(q);
        if (part == FE__PART_CONE)
            g = cone_gradient(row, &w);
        else {
            int is_y = part == FE__PART_SWING_Y;
            row->f.x = w.angle * (is_y ? w.y : w.z);
            g = is_y ? swing_gradient(&w, w.y, w.z) : swing_gradient(&w, w.z, -w.y);
        }
    }
    g = turned(qa, g);
    wide3 sa = w_mul(&row->inertia_a, g), sb = w_mul(&row->inertia_b, g);
    store3(row->g, g), store3(row->spin_a, sa), store3(row->spin_b, sb);
    aim(&row->f, w_dot(g, w_add(sa, sb)), LOCKED_RESPONSE * (trace(&row->inertia_a) + trace(&row->inertia_b)), part, c);
}

FE_INLINE void apply_angular(const angular_row *row, spins *e, wide impulse)
{
    e->a = w_sub_scaled(e->a, impulse, load3(row->spin_a));
    e->b = w_add_scaled(e->b, impulse, load3(row->spin_b));
}

FE_SMALL FE_INLINE void prepare_angular(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                        int32_t count, int32_t sides, const fe__step_constants *c, int part, int slot)
{
    angular_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        find_axes(r);
        store4(row->first_a, first_frame(r->body_a, FRAME_QUAD(frame_a)));
        store4(row->first_b, first_frame(r->body_b, FRAME_QUAD(frame_b)));
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        read_freedom(&row->f, r, slot, part == FE__PART_CONE, c);
        wide4 limit = AXIS_QUAD(slot, limit);
        row->cone[0] = limit.x, row->cone[1] = limit.y;
        place_angular(row, s, part, c);
        spins e = gather_spins(s->velocity, &row->line);
        apply_angular(row, &e, impulse_of(&row->f));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

static void solve_angular(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    for (angular_row *row = rows, *end = row + count; row < end; ++row) {
        spins e = gather_spins(s->velocity, &row->line);
        apply_angular(row, &e, solve_freedom(&row->f, w_dot(load3(row->g), w_sub(e.b, e.a)), c, 1));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_INLINE void relax_angular(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c,
                             int part)
{
    for (angular_row *row = rows, *end = row + count; row < end; ++row) {
        FOLLOW_INERTIA(row, w_zero3(), w_zero3());
        spins start = gather_spins(s->start, &row->line), e = gather_spins(s->velocity, &row->line);
        wide3 spin_a = load3(row->spin_a), spin_b = load3(row->spin_b);
        wide3 g = load3(row->g);
        wide l = impulse_of(&row->f);
        place_angular(row, s, part, c);
        wide_mask jumps = forget_jump(&row->f, g, load3(row->g));
        // the row rotated: start takes what that changes in the effect of l
        start.a = w_add_scaled(start.a, l, w_sub(w_choose3(jumps, w_zero3(), load3(row->spin_a)), spin_a));
        start.b = w_sub_scaled(start.b, l, w_sub(w_choose3(jumps, w_zero3(), load3(row->spin_b)), spin_b));
        scatter_spins(s->start, &row->line, &start, sides);
        apply_angular(row, &e, solve_freedom(&row->f, w_dot(load3(row->g), w_sub(e.b, e.a)), c, 0));
        row->f.total = row->f.total + impulse_of(&row->f);
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL FE_INLINE void store_angular(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                      int32_t count, const fe__step_constants *c, int slot)
{
    (void)s;
    const angular_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_axes(&r);
        write_freedom(&r, &row->f, slot, c);
    }
}

// ---- the kernels of each part ---------------------------------------------------------------------------------------
#define AXIS_INSTANCE(name, form, part, slot)                                                                          \
    static void prepare_##name(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count, \
                               int32_t sides, const fe__step_constants *c)                                             \
    {                                                                                                                  \
        prepare_##form(s, of, lanes, rows, count, sides, c, part, slot);                                               \
    }                                                                                                                  \
    static void relax_##name(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)     \
    {                                                                                                                  \
        relax_##form(s, rows, count, sides, c, part);                                                                  \
    }                                                                                                                  \
    static void store_##name(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,            \
                             int32_t count, const fe__step_constants *c)                                               \
    {                                                                                                                  \
        store_##form(s, of, lanes, rows, count, c, slot);                                                              \
    }

AXIS_INSTANCE(x, linear, FE__PART_X, FE__AXIS_LINEAR)
AXIS_INSTANCE(y, linear, FE__PART_Y, FE__AXIS_LINEAR + 1)
AXIS_INSTANCE(z, linear, FE__PART_Z, FE__AXIS_LINEAR + 2)
AXIS_INSTANCE(distance, linear, FE__PART_DISTANCE, FE__AXIS_LINEAR)
AXIS_INSTANCE(twist, angular, FE__PART_TWIST, FE__AXIS_TWIST)
AXIS_INSTANCE(swing_y, angular, FE__PART_SWING_Y, FE__AXIS_SWING)
AXIS_INSTANCE(swing_z, angular, FE__PART_SWING_Z, FE__AXIS_SWING + 1)
AXIS_INSTANCE(cone, angular, FE__PART_CONE, FE__AXIS_SWING)

#undef AXIS_INSTANCE
