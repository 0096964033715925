// joint_tree_light.h - when a light tree is solved: from the substep on in which one of its joints opens. Part of joint.simd.c.
//
// What a sweep is good enough for is left to it, until a blow or a pinch pulls a joint's points apart by more than OPEN. Asked of the
// sweep's rows for each joint in every pass, so in floats.

#define OPEN 0.004f // m, four fifths of the linear slop, so that it is kept with something to spare
// What is farther apart when the step begins was put there, by the user or by continuous collision: it comes together softly, by sweeps
#define PUT_APART (2.0f * OPEN)

FE_INLINE fe_vec3 lane_of(const wide *a, int32_t i) { return fe__vec3(a[0][i], a[1][i], a[2][i]); }
FE_INLINE fe_vec3 speed_at(const fe__velocity_line *line, fe_vec3 arm)
{
    return fe__add(fe__quad_vector(line->v), fe__cross(fe__quad_vector(line->w), arm));
}

// the part of d along the locked axes
static fe_vec3 locked_part(const slide_row *row, int32_t i, fe_vec3 d)
{
    return fe__vec3(row->keep[0][i] * fe__dot(lane_of(row->u[0], i), d), row->keep[1][i] * fe__dot(lane_of(row->u[1], i), d),
                    row->keep[2][i] * fe__dot(lane_of(row->u[2], i), d));
}

static float rod_speed(const linear_row *row, int32_t i, const fe__velocity_line *a, const fe__velocity_line *b)
{
    float speed = fe__dot(lane_of(row->u, i), fe__sub(fe__quad_vector(b->v), fe__quad_vector(a->v)));
    speed += fe__dot(lane_of(row->moment_b, i), fe__quad_vector(b->w));
    return speed - fe__dot(lane_of(row->moment_a, i), fe__quad_vector(a->w));
}

// Of B's point against A's along what the lock forbids, squared; a, b: their lines of velocities
FE_INLINE float forbidden_speed(int32_t part, const void *row, int32_t i, const fe__velocity_line *a, const fe__velocity_line *b)
{
    const point_row *point = row;
    const slide_row *slide = row;
    fe_vec3 v = {0.0f, 0.0f, 0.0f};
    if (part == FE__PART_POINT) v = fe__sub(speed_at(b, lane_of(point->arm_b, i)), speed_at(a, lane_of(point->arm_a, i)));
    if (part == FE__PART_DISTANCE) v.x = rod_speed(row, i, a, b);
    if (part == FE__PART_SLIDE)
        v = locked_part(slide, i, fe__sub(speed_at(b, lane_of(slide->arm_b, i)), speed_at(a, lane_of(slide->arm_a, i))));
    return fe__dot(v, v);
}

// how far they are apart along it, squared
FE_INLINE float forbidden_gap(int32_t part, const void *row, int32_t i)
{
    const linear_row *rod = row;
    fe_vec3 gap = {0.0f, 0.0f, 0.0f};
    if (part == FE__PART_POINT) gap = lane_of(((const point_row *)row)->gap, i);
    if (part == FE__PART_SLIDE) gap = lane_of(((const slide_row *)row)->error, i);
    if (part == FE__PART_DISTANCE) gap.x = rod->f.x[i] - rod->f.low[i];
    return fe__dot(gap, gap);
}

static int is_open(const tree_job *t, float limit)
{
    for (int32_t i = 0; i < t->count; ++i) {
        const fe__tree_place *p = t->places + i;
        for (int32_t k = 0; k < p->locks; ++k)
            if (forbidden_gap(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane) > limit * limit) return 1;
    }
    return 0;
}

// will a joint open in the substep, by the velocities as they are?
static int will_open(const tree_job *t)
{
    const float most = OPEN / (float)t->h;
    for (int32_t i = 0; i < t->count; ++i) {
        const fe__tree_place *p = t->places + i;
        const int holds_b = t->links[i].holds_b;
        const fe__velocity_line *a = holds_b ? above_of(t, i) : below_of(t, i), *b = holds_b ? below_of(t, i) : above_of(t, i);
        for (int32_t k = 0; k < p->locks; ++k)
            if (forbidden_speed(p->lock[k].part, t->rows + p->lock[k].row, p->lock[k].lane, a, b) > most * most) return 1;
    }
    return 0;
}
