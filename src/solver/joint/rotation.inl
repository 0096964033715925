// rotation.inl - HINGE, FIXED: locks of rotations; ROTATION: drive to a rotation and friction about all axes. Part of
// joint_solver.simd.c.
//
//     HINGE   t1, t2: Y and Z of A; C = (-t2.X', t1.X') with X' of B;  v = (t1.w, t2.w), w = wB - wA;  2 x 2 block
//     FIXED   C = 2 vec(QB QA^-1), world axes; v = w: dC/dt = w up to C^2. K = IA^-1 + IB^-1 in world axes
//     ROTATION  error = rotation vector of q target^-1 in frame A, rotated to the world; v = w
// Order of a hinge: these first, its point last, in blocks of their own. One soft block of five would share its
// compliance: a bending moment would open the anchors three times as far.

// ---- hinge ----------------------------------------------------------------------------------------------------------
typedef struct {
    line_pair line;
    wide t1[3], t2[3]; // now
    wide error[2];     // angle about t1, t2
    wide mass[3];      // inverse of K: 11 12 22
    wide impulse[2];
    wide_sym inertia_a, inertia_b;
    wide rate, fade, rigid, shaped;
    wide total[3];                                  // world, of the impulses of the substeps so far
    wide first_t1[3], first_t2[3], first_axis_b[3]; // when the step began
    wide locked;                                    // > 0: a body has locks
} hinge_row;

FE_INLINE void hinge_mass(hinge_row *row, wide3 t1, wide3 t2)
{
    wide_sym k = sum_sym(&row->inertia_a, &row->inertia_b);
    k = give_locked_rotations(k, row->locked);
    wide3 k1 = w_mul(&k, t1), k2 = w_mul(&k, t2);
    wide k11 = w_dot(t1, k1), k12 = w_dot(t1, k2), k22 = w_dot(t2, k2);
    wide more = w_choose(w_greater(row->locked, w_set(0.0f)), LOCKED_GIVE * trace(&k), w_set(0.0f));
    k11 = k11 + more, k22 = k22 + more;
    wide d = w_inverse_or_zero(k11 * k22 - k12 * k12);
    row->mass[0] = d * k22, row->mass[1] = -(d * k12), row->mass[2] = d * k11;
}

FE_INLINE void place_hinge(hinge_row *row, const fe__solver *s)
{
    wide3 first1 = load3(row->first_t1), first2 = load3(row->first_t2), first_b = load3(row->first_axis_b);
    wide3 t1 = w_add(first1, rotate_with(s, row->line.a, first1)),
          t2 = w_add(first2, rotate_with(s, row->line.a, first2));
    wide3 axis_b = w_add(first_b, rotate_with(s, row->line.b, first_b));
    row->error[0] = -w_dot(t2, axis_b), row->error[1] = w_dot(t1, axis_b);
    store3(row->t1, t1), store3(row->t2, t2);
    hinge_mass(row, t1, t2);
}

FE_INLINE wide3 hinge_torque(const hinge_row *row, wide l1, wide l2)
{
    return w_add_scaled(w_scale(l1, load3(row->t1)), l2, load3(row->t2));
}

FE_SMALL static void prepare_hinge(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                   int32_t count, int32_t sides, const fe__step_constants *c)
{
    hinge_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        wide4 qa = first_frame(r->body_a, FRAME_QUAD(frame_a)), qb = first_frame(r->body_b, FRAME_QUAD(frame_b));
        wide4 impulse = FRAME_QUAD(impulse);
        lane_softness soft = lock_softness(r, c);
        row->rate = soft.rate, row->fade = soft.fade, row->rigid = soft.rigid;
        store3(row->first_t1, frame_axis(qa, 1)), store3(row->first_t2, frame_axis(qa, 2)),
            store3(row->first_axis_b, frame_axis(qb, 0));
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        spins e = gather_spins(s->velocity, &row->line);
        row->locked = e.locks_a + e.locks_b;
        row->impulse[0] = c->warm_scale * impulse.x, row->impulse[1] = c->warm_scale * impulse.y;
        store3(row->total, w_zero3());
        place_hinge(row, s);
        twist_ends(&e, &row->inertia_a, &row->inertia_b, hinge_torque(row, row->impulse[0], row->impulse[1]));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

// request: the velocity to lose; fade: the share of the impulse given back
FE_INLINE void change_hinge(hinge_row *row, spins *e, wide request1, wide request2, wide fade)
{
    wide l1 = -(row->mass[0] * request1 + row->mass[1] * request2 + fade * row->impulse[0]);
    wide l2 = -(row->mass[1] * request1 + row->mass[2] * request2 + fade * row->impulse[1]);
    row->impulse[0] = row->impulse[0] + l1, row->impulse[1] = row->impulse[1] + l2;
    twist_ends(e, &row->inertia_a, &row->inertia_b, hinge_torque(row, l1, l2));
}

static void solve_hinge(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (hinge_row *row = rows, *end = row + count; row < end; ++row) {
        spins e = gather_spins(s->velocity, &row->line);
        wide3 spin = w_sub(e.b, e.a);
        wide scale = 1.0f - row->fade, request1 = scale * w_dot(load3(row->t1), spin) + row->rate * row->error[0];
        change_hinge(row, &e, request1, scale * w_dot(load3(row->t2), spin) + row->rate * row->error[1], row->fade);
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

static void relax_hinge(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (hinge_row *row = rows, *end = row + count; row < end; ++row) {
        wide3 t1 = load3(row->t1), t2 = load3(row->t2), torque = hinge_torque(row, row->impulse[0], row->impulse[1]);
        FOLLOW_INERTIA(row, torque, torque);
        place_hinge(row, s);
        wide3 change = w_add_scaled(w_scale(row->impulse[0], w_sub(load3(row->t1), t1)), row->impulse[1],
                                    w_sub(load3(row->t2), t2));
        spins start = gather_spins(s->start, &row->line), e = gather_spins(s->velocity, &row->line);
        twist_ends(&start, &row->inertia_a, &row->inertia_b, minus(change));
        scatter_spins(s->start, &row->line, &start, sides);
        wide3 spin = w_sub(e.b, e.a);
        change_hinge(row, &e, row->rigid * w_dot(load3(row->t1), spin), row->rigid * w_dot(load3(row->t2), spin),
                     w_set(0.0f));
        store3(row->total, w_add(load3(row->total), hinge_torque(row, row->impulse[0], row->impulse[1])));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL static void store_hinge(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                 int32_t count, const fe__step_constants *c)
{
    (void)s;
    const hinge_row *row = rows;
    wide zero = w_set(0.0f), mean = w_set(mean_of(c)), stored = stored_of(c);
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_frames(&r);
        find_reactions(&r);
        put_lanes(r.frame, offsetof(fe__joint_frame, impulse), r.real,
                  (wide4){stored * row->impulse[0], stored * row->impulse[1], zero, zero});
        put_lanes(r.reaction, offsetof(fe__joint_reaction, torque), r.real,
                  w_with(w_scale(mean, load3(row->total)), zero));
    }
}

// ---- fixed ----------------------------------------------------------------------------------------------------------
typedef struct {
    line_pair line;
    wide error[3];
    wide_sym mass;   // (IA^-1 + IB^-1)^-1
    wide impulse[3]; // world
    wide_sym inertia_a, inertia_b;
    wide rate, fade, rigid, shaped;
    wide total[3];
    wide first[4]; // QB QA^-1 when the step began
    wide locked;   // > 0: a body has locks
} fixed_row;

FE_INLINE wide_sym rotation_mass(const wide_sym *a, const wide_sym *b, wide locked)
{
    wide_sym k = sum_sym(a, b);
    k = give_locked_rotations(k, locked);
    k = give(k, trace(&k), w_greater(locked, w_set(0.0f)));
    return inverse_scaled(&k);
}

FE_INLINE void place_fixed(fixed_row *row, const fe__solver *s)
{
    row->mass = rotation_mass(&row->inertia_a, &row->inertia_b, row->locked);
    wide4 qa = gather_high(s->motion, row->line.a), qb = gather_high(s->motion, row->line.b);
    wide4 q = positive(w_product(w_product(qb, load4(row->first)), w_conjugate(qa)));
    store3(row->error, w_scale(w_set(2.0f), w_xyz(q)));
}

FE_SMALL static void prepare_fixed(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                   int32_t count, int32_t sides, const fe__step_constants *c)
{
    fixed_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        wide4 qa = first_frame(r->body_a, FRAME_QUAD(frame_a)), qb = first_frame(r->body_b, FRAME_QUAD(frame_b));
        lane_softness soft = lock_softness(r, c);
        row->rate = soft.rate, row->fade = soft.fade, row->rigid = soft.rigid;
        store4(row->first, w_product(qb, w_conjugate(qa)));
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        spins e = gather_spins(s->velocity, &row->line);
        row->locked = e.locks_a + e.locks_b;
        store3(row->impulse, w_scale(w_set(c->warm_scale), w_xyz(FRAME_QUAD(impulse)))), store3(row->total, w_zero3());
        place_fixed(row, s);
        twist_ends(&e, &row->inertia_a, &row->inertia_b, load3(row->impulse));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

static void solve_fixed(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (fixed_row *row = rows, *end = row + count; row < end; ++row) {
        spins e = gather_spins(s->velocity, &row->line);
        wide3 request = w_add_scaled(w_scale(1.0f - row->fade, w_sub(e.b, e.a)), row->rate, load3(row->error)),
              impulse = load3(row->impulse);
        wide3 change = minus(w_add_scaled(w_mul(&row->mass, request), row->fade, impulse));
        store3(row->impulse, w_add(impulse, change));
        twist_ends(&e, &row->inertia_a, &row->inertia_b, change);
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

static void relax_fixed(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (fixed_row *row = rows, *end = row + count; row < end; ++row) {
        FOLLOW_INERTIA(row, load3(row->impulse), load3(row->impulse));
        place_fixed(row, s);
        spins e = gather_spins(s->velocity, &row->line);
        wide3 change = w_scale(-row->rigid, w_mul(&row->mass, w_sub(e.b, e.a))),
              impulse = w_add(load3(row->impulse), change);
        store3(row->impulse, impulse);
        store3(row->total, w_add(load3(row->total), impulse));
        twist_ends(&e, &row->inertia_a, &row->inertia_b, change);
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL static void store_fixed(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                 int32_t count, const fe__step_constants *c)
{
    (void)s;
    const fixed_row *row = rows;
    wide zero = w_set(0.0f), mean = w_set(mean_of(c)), stored = stored_of(c);
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_frames(&r);
        find_reactions(&r);
        put_lanes(r.frame, offsetof(fe__joint_frame, impulse), r.real,
                  w_with(w_scale(stored, load3(row->impulse)), zero));
        put_lanes(r.reaction, offsetof(fe__joint_reaction, torque), r.real,
                  w_with(w_scale(mean, load3(row->total)), zero));
    }
}

// ---- rotation -------------------------------------------------------------------------------------------------------

// With K isotropic and given, or M w^2 with M = (IA^-1 + IB^-1)^-1, the drive is
//     change = -(S (v + bias error + inner l) + outer l),   |l| <= cap h
// given: c = 1 / (h (C + h K)), S = (M^-1 + c)^-1, bias = h K c, inner = c;   hertz: S = (1 - fade) M, bias = rate / (1
// - fade), outer = fade
typedef struct {
    line_pair line;
    wide error[3]; // world
    wide_sym drive_mass, mass;
    wide bias, inner, outer, drive_cap;
    wide impulse[3], motor_impulse[3];  // world
    wide velocity[3];                   // wanted of B against A, world
    wide motor_cap, least_mass, shaped; // least_mass: the least effective mass about any axis
    wide_sym inertia_a, inertia_b;
    wide total[3];
    wide first_a[4], first_b[4];
    wide target[4];
    wide motor[3]; // frame A
    wide drive[4]; // as in fe__joint_rotation
    wide locked;   // > 0: a body has locks
} rotation_row;

FE_INLINE wide3 rotation_vector(wide4 q)
{
    wide3 u = w_xyz(q);
    wide sine = w_sqrt(w_dot(u, u));
    wide k = w_choose(w_greater(sine, w_set(1e-6f)), 2.0f * w_atan2(sine, q.w) / sine, w_set(2.0f));
    return w_scale(k, u);
}

FE_INLINE void place_rotation(rotation_row *row, const fe__solver *s)
{
    wide4 qa = frame_now(s, row->line.a, row->first_a),
          q = w_product(w_conjugate(qa), frame_now(s, row->line.b, row->first_b));
    store3(row->error, turned(qa, rotation_vector(positive(w_product(q, w_conjugate(load4(row->target)))))));
    store3(row->velocity, turned(qa, load3(row->motor)));
}

FE_INLINE void aim_rotation(rotation_row *row, const fe__step_constants *c)
{
    wide4 drive = load4(row->drive);
    wide zero = w_set(0.0f), one = w_set(1.0f), omega = 2.0f * FE_PI * drive.x;
    wide_mask newtons = w_greater(drive.w, zero), on;
    wide_sym k = sum_sym(&row->inertia_a, &row->inertia_b);
    row->least_mass = w_inverse_or_zero(trace(&k));
    k = give(k, trace(&k), w_greater(row->locked, zero));
    row->mass = inverse_scaled(&k);
    wide fade = 1.0f / (1.0f + c->h * omega * (2.0f * drive.y + c->h * omega));
    wide given = w_inverse_or_zero(c->h * (drive.y + c->h * drive.x)), stiff = one - fade;
    on = w_greater(w_choose(newtons, given, omega), zero);
    wide more = w_choose(newtons, given, zero), scale = w_choose(on, w_choose(newtons, one, stiff), zero);
    k.xx = k.xx + more, k.yy = k.yy + more, k.zz = k.zz + more;
    wide_sym m = inverse_scaled(&k);
    row->drive_mass = (wide_sym){scale * m.xx, scale * m.xy, scale * m.xz, scale * m.yy, scale * m.yz, scale * m.zz};
    row->bias = w_choose(newtons, c->h * drive.x * given, c->h * omega * omega * fade * w_inverse_or_zero(stiff));
    row->inner = more;
    row->outer = w_choose(on, w_choose(newtons, zero, fade), one); // what is off forgets its impulse
    row->drive_cap = c->h * drive.z;
}

// no longer than most
FE_INLINE wide3 shortened(wide3 a, wide most)
{
    wide square = w_dot(a, a);
    return w_scale(w_choose(w_greater(square, most * most), most / w_sqrt(square), w_set(1.0f)), a);
}

FE_SMALL static void prepare_rotation(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                      int32_t count, int32_t sides, const fe__step_constants *c)
{
    rotation_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        find_axes(r);
        wide4 motor = AXES_QUAD(rotation.motor);
        wide scale = w_set(c->warm_scale);
        store4(row->first_a, first_frame(r->body_a, FRAME_QUAD(frame_a)));
        store4(row->first_b, first_frame(r->body_b, FRAME_QUAD(frame_b)));
        store4(row->target, AXES_QUAD(rotation.target)), store3(row->motor, w_xyz(motor));
        row->motor_cap = c->h * motor.w;
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        spins e = gather_spins(s->velocity, &row->line);
        row->locked = e.locks_a + e.locks_b;
        store4(row->drive, AXES_QUAD(rotation.drive));
        aim_rotation(row, c);
        store3(row->impulse, w_scale(scale, w_xyz(AXES_QUAD(rotation.impulse))));
        store3(row->motor_impulse, w_scale(scale, w_xyz(AXES_QUAD(rotation.motor_impulse)))),
            store3(row->total, w_zero3());
        place_rotation(row, s);
        twist_ends(&e, &row->inertia_a, &row->inertia_b, w_add(load3(row->impulse), load3(row->motor_impulse)));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_INLINE void drive_rotation(rotation_row *row, spins *e)
{
    wide3 impulse = load3(row->impulse), request = w_add_scaled(w_sub(e->b, e->a), row->bias, load3(row->error));
    request = w_mul(&row->drive_mass, w_add_scaled(request, row->inner, impulse));
    wide3 after = shortened(w_sub_scaled(w_sub(impulse, request), row->outer, impulse), row->drive_cap);
    twist_ends(e, &row->inertia_a, &row->inertia_b, w_sub(after, impulse));
    store3(row->impulse, after);
}

FE_INLINE void run_motor(rotation_row *row, spins *e)
{
    wide3 impulse = load3(row->motor_impulse), over = w_sub(w_sub(e->b, e->a), load3(row->velocity));
    wide3 after = w_sub(impulse, w_mul(&row->mass, over));
    // A motor that is too weak acts along the missing velocity, not along the torque that a skew inertia would need
    wide_mask weak = w_greater(w_dot(after, after), row->motor_cap * row->motor_cap);
    after = w_choose3(weak, shortened(w_sub_scaled(impulse, row->least_mass, over), row->motor_cap), after);
    twist_ends(e, &row->inertia_a, &row->inertia_b, w_sub(after, impulse));
    store3(row->motor_impulse, after);
}

static void solve_rotation(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (rotation_row *row = rows, *end = row + count; row < end; ++row) {
        spins e = gather_spins(s->velocity, &row->line);
        drive_rotation(row, &e);
        run_motor(row, &e);
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

static void relax_rotation(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    for (rotation_row *row = rows, *end = row + count; row < end; ++row) {
        wide3 torque = w_add(load3(row->impulse), load3(row->motor_impulse));
        FOLLOW_INERTIA(row, torque, torque);
        aim_rotation(row, c);
        place_rotation(row, s);
        spins e = gather_spins(s->velocity, &row->line);
        run_motor(row, &e);
        store3(row->total, w_add(load3(row->total), w_add(load3(row->impulse), load3(row->motor_impulse))));
        scatter_spins(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL static void store_rotation(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                    int32_t count, const fe__step_constants *c)
{
    (void)s;
    const rotation_row *row = rows;
    wide zero = w_set(0.0f), mean = w_set(mean_of(c)), stored = stored_of(c);
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_axes(&r);
        put_lanes(r.axes, offsetof(fe__joint_axes, rotation.impulse), r.real,
                  w_with(w_scale(stored, load3(row->impulse)), zero));
        put_lanes(r.axes, offsetof(fe__joint_axes, rotation.motor_impulse), r.real,
                  w_with(w_scale(stored, load3(row->motor_impulse)), zero));
        put_lanes(r.axes, offsetof(fe__joint_axes, rotation.torque), r.real,
                  w_with(w_scale(mean, load3(row->total)), zero));
    }
}
