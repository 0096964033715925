// slide.inl - SLIDE: the anchors stay together along some axes u of frame A; and every point that is not plain. Part of
// joint_solver.simd.c.
//
//     C_i = u_i.d,   v_i = u_i.(vB + wB x rB - vA - wA x (rA + f)),   K_ij = u_i.K u_j
// for locked i, j; f: d along the free axes
// A free axis has 1 in the diagonal of K and requests nothing. The impulse rotates with frame A: relax corrects its
// warm start in v and w.
typedef struct {
    line_pair line;
    wide u[3][3];  // axes of frame A, world
    wide arm_a[3]; // rA + f
    wide arm_b[3];
    wide error[3];             // C
    wide_sym mass;             // K^-1, frame A
    wide impulse[3];           // frame A
    wide mass_a[3], mass_b[3]; // inverse, along the world's axes: 0 where locked
    wide_sym inertia_a, inertia_b;
    wide rate, fade, rigid, shaped;
    wide total[3]; // world, of the impulses of the substeps so far
    wide keep[3];  // 1 for a locked axis, 0 for a free one
    wide locked;   // > 0: a body has locks
    wide unlocked; // inverse mass, if no body were locked
    wide first_frame[4];
    wide first_arm_a[3], first_arm_b[3], first_gap[3];
} slide_row;

FE_INLINE wide3 in_frame(const slide_row *row, wide3 a)
{
    return (wide3){w_dot(load3(row->u[0]), a), w_dot(load3(row->u[1]), a), w_dot(load3(row->u[2]), a)};
}
FE_INLINE wide3 to_world(const slide_row *row, wide3 a)
{
    return w_add_scaled(w_add_scaled(w_scale(a.x, load3(row->u[0])), a.y, load3(row->u[1])), a.z, load3(row->u[2]));
}

FE_INLINE wide_sym slide_mass(const slide_row *row, wide3 ra, wide3 rb)
{
    wide zero = w_set(0.0f), one = w_set(1.0f);
    wide3 m = w_add(load3(row->mass_a), load3(row->mass_b)), keep = load3(row->keep);
    wide_sym k = {m.x, zero, zero, m.y, zero, m.z};
    k = add_arm(k, &row->inertia_a, ra);
    k = add_arm(k, &row->inertia_b, rb);
    k = give_locked(k, m, row->unlocked);
    wide3 x = in_frame(row, w_mul(&k, load3(row->u[0]))), y = in_frame(row, w_mul(&k, load3(row->u[1]))),
          z = in_frame(row, w_mul(&k, load3(row->u[2])));
    wide_sym f = {keep.x * x.x, keep.x * keep.y * x.y, keep.x * keep.z * x.z,
                  keep.y * y.y, keep.y * keep.z * y.z, keep.z * z.z};
    f = give(f, trace(&k), w_greater(row->locked, zero));
    // a free axis counts as much as the others, so that the inverse keeps its digits; times 0 in the end
    wide scale = w_max(f.xx, w_max(f.yy, f.zz));
    f.xx = f.xx + (one - keep.x) * scale, f.yy = f.yy + (one - keep.y) * scale, f.zz = f.zz + (one - keep.z) * scale;
    f = inverse_scaled(&f);
    f.xx = keep.x * f.xx, f.yy = keep.y * f.yy, f.zz = keep.z * f.zz;
    return f;
}

// The gap along the free axes. (With the errors of the locked ones in it too, the arm would feed wide gaps: nets of
// 1000:1 explode.)
FE_INLINE wide3 free_displacement(const slide_row *row, wide3 gap)
{
    wide3 free = in_frame(row, gap), keep = load3(row->keep);
    return to_world(row, (wide3){(1.0f - keep.x) * free.x, (1.0f - keep.y) * free.y, (1.0f - keep.z) * free.z});
}

FE_INLINE void place_slide(slide_row *row, const fe__solver *s)
{
    const anchors first = {load3(row->first_arm_a), load3(row->first_arm_b), load3(row->first_gap)};
    anchors now = anchors_now(s, &row->line, &first);
    wide4 q = frame_now(s, row->line.a, row->first_frame);
    for (int k = 0; k < 3; ++k) store3(row->u[k], frame_axis(q, k));
    wide3 arm = w_add(now.ra, free_displacement(row, now.gap));
    store3(row->arm_a, arm), store3(row->arm_b, now.rb);
    store3(row->error, w_times(load3(row->keep), in_frame(row, now.gap)));
    row->mass = slide_mass(row, arm, now.rb);
}

FE_INLINE void apply_slide(const slide_row *row, ends *e, wide3 impulse)
{
    e->a.v = w_sub(e->a.v, w_times(load3(row->mass_a), impulse));
    e->a.w = w_sub(e->a.w, w_mul(&row->inertia_a, w_cross(load3(row->arm_a), impulse)));
    e->b.v = w_add(e->b.v, w_times(load3(row->mass_b), impulse));
    e->b.w = w_add(e->b.w, w_mul(&row->inertia_b, w_cross(load3(row->arm_b), impulse)));
}

// Arms and axes rotated: start takes what that changes in the effect of the impulse. `impulse` and the arms are those
// of before, in world axes.
FE_INLINE void correct_start_slide(const slide_row *row, const fe__solver *s, wide3 impulse, wide3 arm_a, wide3 arm_b,
                                   int sides)
{
    ends start = {start_side(s, row->line.a), start_side(s, row->line.b)};
    wide3 now = to_world(row, load3(row->impulse)), change = w_sub(now, impulse);
    wide3 moment_a = w_add(w_cross(w_sub(load3(row->arm_a), arm_a), now), w_cross(arm_a, change));
    wide3 moment_b = w_add(w_cross(w_sub(load3(row->arm_b), arm_b), now), w_cross(arm_b, change));
    start.a.v = w_add(start.a.v, w_times(load3(row->mass_a), change)),
    start.a.w = w_add(start.a.w, w_mul(&row->inertia_a, moment_a));
    start.b.v = w_sub(start.b.v, w_times(load3(row->mass_b), change)),
    start.b.w = w_sub(start.b.w, w_mul(&row->inertia_b, moment_b));
    scatter_ends(s->start, &row->line, &start, sides);
}

// which axes are locked, lane by lane: all of a point
FE_INLINE wide3 locked_axes(const row_joints *r)
{
    _Alignas(64) float keep[3][FE_W];
    for (int i = 0; i < FE_W; ++i) {
        const fe__joint_frame *f = r->frame[i];
        int locked = f->parts >> FE__PART_POINT & 1 ? FE__LOCK_X | FE__LOCK_Y | FE__LOCK_Z : f->locked;
        for (int k = 0; k < 3; ++k) keep[k][i] = locked >> k & 1 ? 1.0f : 0.0f;
    }
    return (wide3){*(wide *)keep[0], *(wide *)keep[1], *(wide *)keep[2]};
}

FE_SMALL static void prepare_slide(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                   int32_t count, int32_t sides, const fe__step_constants *c)
{
    slide_row *row = rows;
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints named = joints_of(of, lanes, &row->line, i + 1 < count), *r = &named;
        find_frames(r);
        anchors first = first_anchors(r, sides);
        lane_softness soft = lock_softness(r, c);
        row->rate = soft.rate, row->fade = soft.fade, row->rigid = soft.rigid;
        store3(row->first_arm_a, first.ra), store3(row->first_arm_b, first.rb), store3(row->first_gap, first.gap);
        store4(row->first_frame, first_frame(r->body_a, FRAME_QUAD(frame_a)));
        row->inertia_a = gather_inertia(s, row->line.a), row->inertia_b = gather_inertia(s, row->line.b);
        row->shaped = shape_of(s, &row->line);
        ends e = gather_ends(s, &row->line);
        store3(row->mass_a, free_mass(&e.a)), store3(row->mass_b, free_mass(&e.b)), store3(row->keep, locked_axes(r));
        row->locked = e.a.locks + e.b.locks, row->unlocked = e.a.inverse_mass + e.b.inverse_mass;
        store3(row->impulse, w_scale(w_set(c->warm_scale), w_times(load3(row->keep), w_xyz(JOINT_QUAD(impulse)))));
        store3(row->total, w_zero3());
        place_slide(row, s);
        apply_slide(row, &e, to_world(row, load3(row->impulse)));
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

FE_INLINE void change_slide(slide_row *row, ends *e, wide3 change)
{
    change = w_times(load3(row->keep), change);
    store3(row->impulse, w_add(load3(row->impulse), change));
    apply_slide(row, e, to_world(row, change));
}

static void solve_slide(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (slide_row *row = rows, *end = row + count; row < end; ++row) {
        ends e = gather_ends(s, &row->line);
        wide3 speed = w_times(load3(row->keep), in_frame(row, speed_between(&e, load3(row->arm_a), load3(row->arm_b))));
        wide3 request = w_add_scaled(w_scale(1.0f - row->fade, speed), row->rate, load3(row->error));
        change_slide(row, &e, minus(w_add_scaled(w_mul(&row->mass, request), row->fade, load3(row->impulse))));
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

static void relax_slide(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c)
{
    (void)c;
    for (slide_row *row = rows, *end = row + count; row < end; ++row) {
        wide3 impulse = to_world(row, load3(row->impulse)), arm_a = load3(row->arm_a), arm_b = load3(row->arm_b);
        FOLLOW_INERTIA(row, w_cross(arm_a, impulse), w_cross(arm_b, impulse));
        place_slide(row, s);
        correct_start_slide(row, s, impulse, arm_a, arm_b, sides);
        ends e = gather_ends(s, &row->line);
        wide3 speed = w_times(load3(row->keep), in_frame(row, speed_between(&e, load3(row->arm_a), load3(row->arm_b))));
        change_slide(row, &e, w_scale(-row->rigid, w_mul(&row->mass, speed)));
        store3(row->total, w_add(load3(row->total), to_world(row, load3(row->impulse))));
        scatter_ends(s->velocity, &row->line, &e, sides);
    }
}

FE_SMALL static void store_slide(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows,
                                 int32_t count, const fe__step_constants *c)
{
    const slide_row *row = rows;
    wide zero = w_set(0.0f), mean = w_set(mean_of(c)), stored = stored_of(c);
    for (int32_t i = 0; i < count; ++i, ++row, lanes += FE_W) {
        row_joints r = name_joints(of, lanes);
        find_reactions(&r);
        put_lanes(r.joint, offsetof(fe__joint, impulse), r.real, w_with(w_scale(stored, load3(row->impulse)), zero));
        find_stretch(s, lanes, load3(row->error), c);
        put_lanes(r.reaction, offsetof(fe__joint_reaction, force), r.real,
                  w_with(w_scale(mean, load3(row->total)), zero));
    }
}
