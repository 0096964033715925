// body_lanes.inl - bodies' lines of eight floats, and what point locks bear, in and out of lanes. Part of
// tree_solver.simd.c.

typedef struct lines {
    half a[FE__LINE]; // member k of the lines of all lanes
} lines;

typedef struct line_names {
    _Alignas(4 * LANES) int32_t at[LANES];
} line_names;

// ---- transposes, one for each width -------------------------------------------------------------------------------
#define LINE_OF(i) (at + (intptr_t)line->at[i] * FE__LINE)
#if FE_W == 16
#define TWO_LINES(k)                                                                                \
    (wide) _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(*(const octet *)LINE_OF(k))), \
                              (__m256d)(*(const octet *)LINE_OF(4 + (k))), 1)
FE_INLINE lines read_lines(const void *from, const line_names *line)
{
    const float *at = from;
    // members k of the first and of the second quad, of four lines, then of the other four
    const wide4 r = w_transpose(TWO_LINES(0), TWO_LINES(1), TWO_LINES(2), TWO_LINES(3));
    const wide part[4] = {r.x, r.y, r.z, r.w};
    lines l;
    for (int k = 0; k < 4; ++k) {
        const wide both = W_QUADS(part[k], part[k], 0, 2, 1, 3);
        l.a[k] = (half)_mm512_castps512_ps256(both), l.a[4 + k] = (half)_mm512_extractf64x4_pd((__m512d)both, 1);
    }
    return l;
}

FE_INLINE void write_lines(void *to, const line_names *line, int32_t lanes, const lines *l)
{
    float *at = to;
    wide part[4];
    for (int k = 0; k < 4; ++k) {
        const wide both =
            (wide)_mm512_insertf64x4((__m512d)_mm512_castps256_ps512((__m256)l->a[k]), (__m256d)l->a[4 + k], 1);
        part[k] = W_QUADS(both, both, 0, 2, 1, 3);
    }
    const wide4 r = w_transpose(part[0], part[1], part[2], part[3]);
    const wide pair[4] = {r.x, r.y, r.z, r.w};
    for (int k = 0; k < 4; ++k) {
        if (lanes >> k & 1) *(octet *)LINE_OF(k) = (octet)_mm512_castps512_ps256(pair[k]);
        if (lanes >> (4 + k) & 1) *(octet *)LINE_OF(4 + k) = (octet)_mm512_extractf64x4_pd((__m512d)pair[k], 1);
    }
}
#undef TWO_LINES
#else
// the same quad of the lines of all lanes: its four members
FE_INLINE void turn_quads(const quad *q, half *member)
{
#if FE_W == 8
    const quad low = __builtin_shufflevector(q[0], q[1], 0, 4, 1, 5),
               high = __builtin_shufflevector(q[0], q[1], 2, 6, 3, 7);
    const quad low2 = __builtin_shufflevector(q[2], q[3], 0, 4, 1, 5),
               high2 = __builtin_shufflevector(q[2], q[3], 2, 6, 3, 7);
    member[0] = (half)__builtin_shufflevector(low, low2, 0, 1, 4, 5);
    member[1] = (half)__builtin_shufflevector(low, low2, 2, 3, 6, 7);
    member[2] = (half)__builtin_shufflevector(high, high2, 0, 1, 4, 5);
    member[3] = (half)__builtin_shufflevector(high, high2, 2, 3, 6, 7);
#else
    for (int k = 0; k < 4; ++k) member[k] = (half){q[0][k], q[1][k]};
#endif
}

FE_INLINE lines read_lines(const void *from, const line_names *line)
{
    const float *at = from;
    quad low[LANES], high[LANES];
    lines l;
    for (int i = 0; i < LANES; ++i) low[i] = *(const quad *)LINE_OF(i), high[i] = *(const quad *)(LINE_OF(i) + 4);
    turn_quads(low, l.a), turn_quads(high, l.a + 4);
    return l;
}

FE_INLINE void write_lines(void *to, const line_names *line, int32_t lanes, const lines *l)
{
    float *at = to;
    quad low[LANES], high[LANES];
#if FE_W == 8
    half back[8]; // a transpose is its own inverse
    turn_quads((const quad *)l->a, back), turn_quads((const quad *)(l->a + 4), back + 4);
    for (int i = 0; i < LANES; ++i) low[i] = (quad)back[i], high[i] = (quad)back[4 + i];
#else
    for (int i = 0; i < LANES; ++i) {
        low[i] = (quad){l->a[0][i], l->a[1][i], l->a[2][i], l->a[3][i]};
        high[i] = (quad){l->a[4][i], l->a[5][i], l->a[6][i], l->a[7][i]};
    }
#endif
    for (int i = 0; i < LANES; ++i)
        if (lanes >> i & 1) *(quad *)LINE_OF(i) = low[i], *(quad *)(LINE_OF(i) + 4) = high[i];
}
#endif
#undef LINE_OF

FE_INLINE real3 widen3(const half *a) { return (real3){r_widen(a[0]), r_widen(a[1]), r_widen(a[2])}; }
// b of what may be -0 is not: whether a freedom is looked at that gives nothing, nobody shall see
FE_INLINE half narrow(real a) { return __builtin_convertvector(a, half) + 0.0f; }
FE_INLINE void narrow3(half *to, real3 a) { to[0] = narrow(a.x), to[1] = narrow(a.y), to[2] = narrow(a.z); }
