// lock_lanes.inl - how the trees reach a lane of the sweep's rows, see tree/lock.h. Part of joint_solver.simd.c.

// Other lanes of a row may be of trees that other workers solve meanwhile: of an impulse a lane is read and written
// alone, not as (*a)[i], for which clang loads and stores all of them
FE_INLINE float *lane_at(wide *a, int32_t i) { return (float *)(void *)a + i; }
FE_INLINE float impulse_lane(const wide *a, int32_t i) { return ((const float *)(const void *)a)[i]; }
FE_INLINE fe_vec3 lane_of(const wide *a, int32_t i) { return fe__vec3(a[0][i], a[1][i], a[2][i]); }
FE_INLINE fe_quat quat_lane(const wide *a, int32_t i) { return (fe_quat){a[0][i], a[1][i], a[2][i], a[3][i]}; }

// ---- from a lane ----------------------------------------------------------------------------------------------------
// what rows of anchors have alike
#define READ_ANCHORS(row)                            \
    do {                                             \
        out->arm_a = lane_of((row)->first_arm_a, i); \
        out->arm_b = lane_of((row)->first_arm_b, i); \
        out->gap = lane_of((row)->first_gap, i);     \
    } while (0)
#define READ_ENDS(row) (out->line_a = (row)->line.a[i], out->line_b = (row)->line.b[i])

static void read_point(const point_row *row, int32_t i, fe__lock *out)
{
    READ_ENDS(row);
    READ_ANCHORS(row);
    for (int k = 0; k < 3; ++k) out->impulse[k] = impulse_lane(row->impulse + k, i);
}

static void read_slide(const slide_row *row, int32_t i, fe__lock *out)
{
    READ_ENDS(row);
    READ_ANCHORS(row);
    out->frame = quat_lane(row->first_frame, i);
    for (int k = 0; k < 3; ++k) out->keeps[k] = row->keep[k][i], out->impulse[k] = impulse_lane(row->impulse + k, i);
}

static void read_hinge(const hinge_row *row, int32_t i, fe__lock *out)
{
    READ_ENDS(row);
    out->t1 = lane_of(row->first_t1, i), out->t2 = lane_of(row->first_t2, i),
    out->axis_b = lane_of(row->first_axis_b, i);
}

static void read_fixed(const fixed_row *row, int32_t i, fe__lock *out)
{
    READ_ENDS(row);
    out->frame = quat_lane(row->first, i);
}

static void read_distance(const linear_row *row, int32_t i, fe__lock *out)
{
    READ_ENDS(row);
    READ_ANCHORS(row);
    out->frame = quat_lane(row->first_frame, i);
    out->length = row->f.low[i], out->impulse[0] = impulse_lane(&row->f.under, i);
}

static void read_lock(int32_t part, const void *row, int32_t lane, fe__lock *out_lock)
{
    switch (part) {
    case FE__PART_POINT:
        read_point(row, lane, out_lock);
        break;
    case FE__PART_SLIDE:
        read_slide(row, lane, out_lock);
        break;
    case FE__PART_HINGE:
        read_hinge(row, lane, out_lock);
        break;
    case FE__PART_FIXED:
        read_fixed(row, lane, out_lock);
        break;
    default:
        read_distance(row, lane, out_lock);
    }
}

// ---- to a lane ------------------------------------------------------------------------------------------------------
FE_INLINE fe_dvec3 wide_lane(const wide *a, int32_t i) { return fe__widen(lane_of(a, i)); }
FE_INLINE void add_lane(wide *to, int32_t i, double a) { *lane_at(to, i) += (float)a; }
FE_INLINE void add_lane3(wide *to, int32_t i, fe_dvec3 a)
{
    add_lane(to, i, a.x), add_lane(to + 1, i, a.y), add_lane(to + 2, i, a.z);
}

static int32_t add_slide(slide_row *row, int32_t i, const double *l, int32_t total)
{
    int32_t taken = 0;
    for (int k = 0; k < 3; ++k) {
        if (!(row->keep[k][i] > 0.0f)) continue;
        add_lane(row->impulse + k, i, l[taken]);
        if (total) add_lane3(row->total, i, fe__dscale(l[taken], wide_lane(row->u[k], i)));
        ++taken;
    }
    return taken;
}

static int32_t add_hinge(hinge_row *row, int32_t i, const double *l, int32_t total)
{
    add_lane(row->impulse, i, l[0]), add_lane(row->impulse + 1, i, l[1]);
    if (total)
        add_lane3(row->total, i,
                  fe__dadd(fe__dscale(l[0], wide_lane(row->t1, i)), fe__dscale(l[1], wide_lane(row->t2, i))));
    return 2;
}

static int32_t add_three(wide *impulse, wide *sum, int32_t i, const double *l, int32_t total)
{
    const fe_dvec3 a = {l[0], l[1], l[2]};
    add_lane3(impulse, i, a);
    if (total) add_lane3(sum, i, a);
    return 3;
}

static int32_t add_distance(linear_row *row, int32_t i, const double *l, int32_t total)
{
    add_lane(&row->f.under, i, l[0]);
    if (total) add_lane(&row->f.total, i, l[0]);
    return 1;
}

static int32_t add_lock(int32_t part, void *row, int32_t lane, const double *impulse, int32_t total)
{
    switch (part) {
    case FE__PART_POINT:
        return add_three(((point_row *)row)->impulse, ((point_row *)row)->total, lane, impulse, total);
    case FE__PART_FIXED:
        return add_three(((fixed_row *)row)->impulse, ((fixed_row *)row)->total, lane, impulse, total);
    case FE__PART_SLIDE:
        return add_slide(row, lane, impulse, total);
    case FE__PART_HINGE:
        return add_hinge(row, lane, impulse, total);
    default:
        return add_distance(row, lane, impulse, total);
    }
}

static int32_t take_lanes(wide *impulse, int32_t i, int32_t count, double *l)
{
    for (int32_t k = 0; k < count; ++k) {
        float *at = lane_at(impulse + k, i);
        l[k] = (double)*at;
        *at = 0.0f;
    }
    return count;
}

static int32_t take_slide(slide_row *row, int32_t i, double *l)
{
    int32_t taken = 0;
    for (int k = 0; k < 3; ++k)
        if (row->keep[k][i] > 0.0f) taken += take_lanes(row->impulse + k, i, 1, l + taken);
    return taken;
}

static int32_t take_lock(int32_t part, void *row, int32_t lane, double *impulse)
{
    switch (part) {
    case FE__PART_POINT:
        return take_lanes(((point_row *)row)->impulse, lane, 3, impulse);
    case FE__PART_FIXED:
        return take_lanes(((fixed_row *)row)->impulse, lane, 3, impulse);
    case FE__PART_SLIDE:
        return take_slide(row, lane, impulse);
    case FE__PART_HINGE:
        return take_lanes(((hinge_row *)row)->impulse, lane, 2, impulse);
    default:
        return take_lanes(&((linear_row *)row)->f.under, lane, 1, impulse);
    }
}

// ---- is a lock open? ------------------------------------------------------------------------------------------------
// Evaluated for each lock of light trees in every pass, so in floats.
FE_INLINE fe_vec3 speed_at(const fe__velocity_line *line, fe_vec3 arm)
{
    return fe__add(fe__quad_vector(line->v), fe__cross(fe__quad_vector(line->w), arm));
}

// the part of d along the locked axes
static fe_vec3 locked_part(const slide_row *row, int32_t i, fe_vec3 d)
{
    return fe__vec3(row->keep[0][i] * fe__dot(lane_of(row->u[0], i), d),
                    row->keep[1][i] * fe__dot(lane_of(row->u[1], i), d),
                    row->keep[2][i] * fe__dot(lane_of(row->u[2], i), d));
}

static float rod_speed(const linear_row *row, int32_t i, const fe__velocity_line *a, const fe__velocity_line *b)
{
    float speed = fe__dot(lane_of(row->u, i), fe__sub(fe__quad_vector(b->v), fe__quad_vector(a->v)));
    speed += fe__dot(lane_of(row->moment_b, i), fe__quad_vector(b->w));
    return speed - fe__dot(lane_of(row->moment_a, i), fe__quad_vector(a->w));
}

// Of B's point against A's along what the lock forbids, squared
static float forbidden_speed(int32_t part, const void *row, int32_t i, const fe__velocity_line *a,
                             const fe__velocity_line *b)
{
    const point_row *point = row;
    const slide_row *slide = row;
    fe_vec3 v = {0.0f, 0.0f, 0.0f};
    if (part == FE__PART_POINT)
        v = fe__sub(speed_at(b, lane_of(point->arm_b, i)), speed_at(a, lane_of(point->arm_a, i)));
    if (part == FE__PART_DISTANCE) v.x = rod_speed(row, i, a, b);
    if (part == FE__PART_SLIDE)
        v = locked_part(slide, i,
                        fe__sub(speed_at(b, lane_of(slide->arm_b, i)), speed_at(a, lane_of(slide->arm_a, i))));
    return fe__dot(v, v);
}

// how far they are apart along it, squared
static float forbidden_gap(int32_t part, const void *row, int32_t i)
{
    const linear_row *rod = row;
    fe_vec3 gap = {0.0f, 0.0f, 0.0f};
    if (part == FE__PART_POINT) gap = lane_of(((const point_row *)row)->gap, i);
    if (part == FE__PART_SLIDE) gap = lane_of(((const slide_row *)row)->error, i);
    if (part == FE__PART_DISTANCE) gap.x = rod->f.x[i] - rod->f.low[i];
    return fe__dot(gap, gap);
}
