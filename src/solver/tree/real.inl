// real.inl - trees side by side: a lane each, in doubles. Part of tree_solver.simd.c.
//
// A chain may bear a million times its own mass, so its matrices need doubles: half as many lanes as there are floats.
// What core/simd.h says of lanes holds here: each operation is IEEE and acts on each lane alone, and min and max are
//     r_min(a, b) = a < b ? a : b       r_max(a, b) = a > b ? a : b

enum { LANES = FE_W / 2, ALL_LANES = (1 << LANES) - 1 };
typedef double real __attribute__((vector_size(8 * LANES)));
typedef float half __attribute__((vector_size(4 * LANES)));

// ---- one section per machine ----------------------------------------------------------------------------------------
#if FE_X86 && FE_W == 16
typedef __mmask8 real_mask;
FE_INLINE real r_min(real a, real b) { return _mm512_min_pd(a, b); }
FE_INLINE real r_max(real a, real b) { return _mm512_max_pd(a, b); }
FE_INLINE real r_sqrt(real a) { return _mm512_sqrt_pd(a); }
FE_INLINE real_mask r_greater(real a, real b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
FE_INLINE real r_choose(real_mask m, real yes, real no) { return _mm512_mask_blend_pd(m, no, yes); }
FE_INLINE int32_t r_bits(real_mask m) { return (int32_t)m; }
FE_INLINE real_mask r_mask(int32_t bits) { return (real_mask)bits; }
#elif FE_X86 && FE_W == 8
typedef int64_t real_mask __attribute__((vector_size(8 * LANES)));
FE_INLINE real r_min(real a, real b) { return _mm256_min_pd(a, b); }
FE_INLINE real r_max(real a, real b) { return _mm256_max_pd(a, b); }
FE_INLINE real r_sqrt(real a) { return _mm256_sqrt_pd(a); }
FE_INLINE real_mask r_greater(real a, real b) { return (real_mask)_mm256_cmp_pd(a, b, _CMP_GT_OQ); }
FE_INLINE real r_choose(real_mask m, real yes, real no) { return _mm256_blendv_pd(no, yes, (real)m); }
FE_INLINE int32_t r_bits(real_mask m) { return _mm256_movemask_pd((real)m); }
FE_INLINE real_mask r_mask(int32_t bits)
{
    return (real_mask){-(bits & 1), -(bits >> 1 & 1), -(bits >> 2 & 1), -(bits >> 3 & 1)};
}
#else
typedef int64_t real_mask __attribute__((vector_size(8 * LANES)));
FE_INLINE real_mask r_greater(real a, real b) { return a > b; }
FE_INLINE real r_choose(real_mask m, real yes, real no) { return (real)((m & (real_mask)yes) | (~m & (real_mask)no)); }
FE_INLINE real r_min(real a, real b) { return r_choose(a < b, a, b); }
FE_INLINE real r_max(real a, real b) { return r_choose(a > b, a, b); }
FE_INLINE real r_sqrt(real a)
{
    for (int i = 0; i < LANES; ++i) a[i] = __builtin_sqrt(a[i]);
    return a;
}
FE_INLINE int32_t r_bits(real_mask m) { return (int32_t)((m[0] & 1) | (m[1] & 2)); }
FE_INLINE real_mask r_mask(int32_t bits) { return (real_mask){-(bits & 1), -(bits >> 1 & 1)}; }
#endif

FE_INLINE real_mask r_both(real_mask a, real_mask b) { return (real_mask)(a & b); }

// a value for each lane: PER_LANE(a[i]) names its lane i
#if FE_W == 16
#define PER_LANE_(E)                                   \
    {                                                  \
        E(0), E(1), E(2), E(3), E(4), E(5), E(6), E(7) \
    }
#elif FE_W == 8
#define PER_LANE_(E)           \
    {                          \
        E(0), E(1), E(2), E(3) \
    }
#else
#define PER_LANE_(E) \
    {                \
        E(0), E(1)   \
    }
#endif

// ---- the same at every width ----------------------------------------------------------------------------------------
typedef struct real3 {
    real x, y, z;
} real3;
typedef struct real_sym {
    real xx, xy, xz, yy, yz, zz;
} real_sym;
typedef struct real_mat {
    real3 x, y, z; // rows
} real_mat;

FE_INLINE real r_set(double a) { return a - (real){0}; }
FE_INLINE real inverse_or_zero(real a) { return r_choose(r_greater(a, r_set(0.0)), 1.0 / a, r_set(0.0)); }
FE_INLINE real3 r_zero3(void) { return (real3){r_set(0.0), r_set(0.0), r_set(0.0)}; }
FE_INLINE real3 unit3(int k) { return (real3){r_set(k == 0), r_set(k == 1), r_set(k == 2)}; }
FE_INLINE real3 r_add(real3 a, real3 b) { return (real3){a.x + b.x, a.y + b.y, a.z + b.z}; }
FE_INLINE real3 r_sub(real3 a, real3 b) { return (real3){a.x - b.x, a.y - b.y, a.z - b.z}; }
FE_INLINE real3 r_scale(real s, real3 a) { return (real3){s * a.x, s * a.y, s * a.z}; }
FE_INLINE real3 r_add_scaled(real3 a, real s, real3 b) { return (real3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
FE_INLINE real3 r_sub_scaled(real3 a, real s, real3 b) { return (real3){a.x - s * b.x, a.y - s * b.y, a.z - s * b.z}; }
FE_INLINE real r_dot(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FE_INLINE real3 r_cross(real3 a, real3 b)
{
    return (real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
FE_INLINE real3 r_choose3(real_mask m, real3 yes, real3 no)
{
    return (real3){r_choose(m, yes.x, no.x), r_choose(m, yes.y, no.y), r_choose(m, yes.z, no.z)};
}
FE_INLINE real_mat r_choose_mat(real_mask m, real_mat yes, real_mat no)
{
    return (real_mat){r_choose3(m, yes.x, no.x), r_choose3(m, yes.y, no.y), r_choose3(m, yes.z, no.z)};
}
FE_INLINE real3 r_mul_sym(const real_sym *m, real3 a)
{
    return (real3){m->xx * a.x + m->xy * a.y + m->xz * a.z, m->xy * a.x + m->yy * a.y + m->yz * a.z,
                   m->xz * a.x + m->yz * a.y + m->zz * a.z};
}
FE_INLINE real3 r_mul(const real_mat *m, real3 a) { return (real3){r_dot(m->x, a), r_dot(m->y, a), r_dot(m->z, a)}; }
FE_INLINE real3 r_mul_transposed(const real_mat *m, real3 a)
{
    return r_add_scaled(r_add_scaled(r_scale(a.x, m->x), a.y, m->y), a.z, m->z);
}
// in the given lanes
FE_INLINE void put3(real3 *to, int32_t lanes, real3 a)
{
    *to = lanes == ALL_LANES ? a : r_choose3(r_mask(lanes), a, *to);
}
// R S R^T
FE_INLINE real_sym r_turn_sym(const real_mat *r, const real_sym *s)
{
    real3 x = r_mul_sym(s, r->x), y = r_mul_sym(s, r->y), z = r_mul_sym(s, r->z);
    return (real_sym){r_dot(r->x, x), r_dot(r->x, y), r_dot(r->x, z), r_dot(r->y, y), r_dot(r->y, z), r_dot(r->z, z)};
}
// of a quaternion of about unit length
FE_INLINE real_mat r_matrix(real x, real y, real z, real w)
{
    real k = 2.0 / (x * x + y * y + z * z + w * w);
    real sx = k * x, sy = k * y, sz = k * z;
    real xx = sx * x, yy = sy * y, zz = sz * z, xy = sx * y, xz = sx * z, yz = sy * z, wx = sx * w, wy = sy * w,
         wz = sz * w;
    return (real_mat){{1.0 - (yy + zz), xy - wz, xz + wy},
                      {xy + wz, 1.0 - (xx + zz), yz - wx},
                      {xz - wy, yz + wx, 1.0 - (xx + yy)}};
}
FE_INLINE real r_widen(half a) { return __builtin_convertvector(a, real); }
