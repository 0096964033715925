// wide_body.h - bodies in and out of wide kernels: lines gathered by the lanes of a row.
#ifndef FE_SOLVER_WIDE_BODY_H
#define FE_SOLVER_WIDE_BODY_H
#include "core/simd.h"
#include "solver/solver.h"

// One body a lane. inverse_mass and locks ride in the spare lanes of v and w, and are written back as read.
typedef struct {
    wide3 v, w;
    wide inverse_mass, locks;
} side;

FE_INLINE wide3 load3(const wide *p) { return (wide3){p[0], p[1], p[2]}; }
FE_INLINE void store3(wide *p, wide3 a) { p[0] = a.x, p[1] = a.y, p[2] = a.z; }
FE_INLINE wide3 w_times(wide3 a, wide3 b) { return (wide3){a.x * b.x, a.y * b.y, a.z * b.z}; }

// `lines`: of any kind, two quads each
FE_INLINE wide4 gather_low(const void *lines, const int32_t *index) { return w_gather(lines, FE__LINE, index); }
FE_INLINE wide4 gather_high(const void *lines, const int32_t *index)
{
    return w_gather((const float *)lines + 4, FE__LINE, index);
}
FE_INLINE void scatter_high(void *lines, const int32_t *index, wide4 high)
{
    w_scatter((float *)lines + 4, FE__LINE, index, high);
}

FE_INLINE void gather_line(const void *lines, const int32_t *index, wide4 *low, wide4 *high)
{
    w_gather_both(lines, FE__LINE, index, low, high);
}

// of what is positive
FE_INLINE wide w_fraction(wide a)
{
    typedef int32_t whole __attribute__((vector_size(4 * FE_W)));
    return a - __builtin_convertvector(__builtin_convertvector(a, whole), wide);
}

FE_INLINE side side_of(wide4 v, wide4 w) { return (side){w_xyz(v), w_xyz(w), v.w, w.w}; }
FE_INLINE side gather_lines(const void *lines, const int32_t *index)
{
    wide4 low, high;
    gather_line(lines, index, &low, &high);
    return side_of(low, high);
}
FE_INLINE side gather_side(const fe__solver *s, const int32_t *index) { return gather_lines(s->velocity, index); }
FE_INLINE side start_side(const fe__solver *s, const int32_t *index) { return gather_lines(s->start, index); }

FE_INLINE void scatter_side(void *lines, const int32_t *index, const side *b)
{
    w_scatter_both(lines, FE__LINE, index, w_with(b->v, b->inverse_mass), w_with(b->w, b->locks));
}

FE_INLINE wide_sym gather_inertia(const fe__solver *s, const int32_t *index)
{
    wide4 low, high;
    gather_line(s->inertia, index, &low, &high);
    return (wide_sym){low.x, low.y, low.z, low.w, high.x, high.y};
}

// sin^2 of half the angle from which on a body's rotation within the step counts for the inertia that joints see: 0.02
// rad. Joints of one body see the same, as what they give it is given again by its warm start.
#define FE__ROTATED 1e-4f

// The inverse inertia of bodies that turned by q since the step began: R I^-1 R^T, row i of R being R^T e_i = e_i +
// (R^T e_i - e_i). What a lock leaves of it is kept as it was.
FE_INLINE wide_sym turned_inertia(const fe__solver *s, const int32_t *index, wide4 q, wide locks)
{
    wide_sym i = gather_inertia(s, index);
    wide zero = w_set(0.0f), one = w_set(1.0f);
    wide3 x = {one, zero, zero}, y = {zero, one, zero}, z = {zero, zero, one};
    q = w_with(w_flush3(w_xyz(q), w_set(FE__LEAST_LEAN)), q.w);
    x = w_add(x, w_turn_back(q, x)), y = w_add(y, w_turn_back(q, y)), z = w_add(z, w_turn_back(q, z));
    wide3 ix = w_mul(&i, x), iy = w_mul(&i, y), iz = w_mul(&i, z);
    wide_mask locked = w_greater(locks, zero);
    return (wide_sym){w_choose(locked, i.xx, w_dot(x, ix)), w_choose(locked, i.xy, w_dot(x, iy)),
                      w_choose(locked, i.xz, w_dot(x, iz)), w_choose(locked, i.yy, w_dot(y, iy)),
                      w_choose(locked, i.yz, w_dot(y, iz)), w_choose(locked, i.zz, w_dot(z, iz))};
}

// in the given lanes: what bodies got and no warm start shall repeat, to velocity and start alike
FE_INLINE void add_change(const fe__solver *s, const int32_t *index, const side *before, const side *after,
                          wide_mask lanes)
{
    side start = start_side(s, index), now = *before;
    start.v = w_choose3(lanes, w_add(start.v, w_sub(after->v, before->v)), start.v);
    start.w = w_choose3(lanes, w_add(start.w, w_sub(after->w, before->w)), start.w);
    now.v = w_choose3(lanes, after->v, now.v), now.w = w_choose3(lanes, after->w, now.w);
    scatter_side(s->start, index, &start);
    scatter_side(s->velocity, index, &now);
}

// Other workers may be at the same bodies, with the same mark
static inline void mark_stretched_ends(fe__solver *s, int32_t line_a, int32_t line_b)
{
    float mark = (float)FE__STRETCHED;
    if (line_a != FE__STATIC_LINE) __atomic_store(&s->inertia[line_a].mark, &mark, __ATOMIC_RELAXED);
    if (line_b != FE__STATIC_LINE) __atomic_store(&s->inertia[line_b].mark, &mark, __ATOMIC_RELAXED);
    atomic_store_explicit(&s->strained, 1, memory_order_relaxed);
}

#endif
