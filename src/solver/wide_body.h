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

FE_INLINE wide4 gather_low(float (*lines)[FE__LINE], const int32_t *index) { return w_gather(lines[0], FE__LINE, index); }
FE_INLINE wide4 gather_high(float (*lines)[FE__LINE], const int32_t *index) { return w_gather(lines[0] + 4, FE__LINE, index); }

FE_INLINE side side_of(wide4 v, wide4 w) { return (side){w_xyz(v), w_xyz(w), v.w, w.w}; }
FE_INLINE side gather_side(const fe__solver *s, const int32_t *index) { return side_of(gather_low(s->velocity, index), gather_high(s->velocity, index)); }
FE_INLINE side start_side(const fe__solver *s, const int32_t *index) { return side_of(gather_low(s->start, index), gather_high(s->start, index)); }

FE_INLINE void scatter_side(float (*lines)[FE__LINE], const int32_t *index, const side *b)
{
    w_scatter(lines[0], FE__LINE, index, w_with(b->v, b->inverse_mass));
    w_scatter(lines[0] + 4, FE__LINE, index, w_with(b->w, b->locks));
}

FE_INLINE wide_sym gather_inertia(const fe__solver *s, const int32_t *index)
{
    wide4 low = gather_low(s->inertia, index), high = gather_high(s->inertia, index);
    return (wide_sym){low.x, low.y, low.z, low.w, high.x, high.y};
}

#endif
