// contact_solver.simd.c - the contact solver: rows of W contacts, of 4 points or of one. Compiled once per SIMD set;
// see core/simd.h.
//
// TGS Soft after E. Catto, "Soft Constraints" (GDC 2011) and Solver2D (2024): in each substep a soft pass, then
// positions, then a relax pass with friction. The first warm start is part of prepare; the later ones are carried by
// the bodies (bodies.simd.c).
#include "core/simd.h"
#include "solver/solver.h"
#include "solver/wide_body.h"

#include <float.h>

#if FE_WASM
#define UNROLL // small, as FE_INLINE says
#else
#define UNROLL _Pragma("GCC unroll 8")
#endif

// a gap up to which a loaded point is soft as if it touched, m. Of a face that just touches, rounding would otherwise
// make some points soft and others rigid, and a box that landed flat would rotate
#define TOUCHING 1e-4f
// in which the points of a contact reach the speeds of their bounce: each leaves a third of the last one's error
#define BOUNCE_SWEEPS 8
// of the impulses of an impact of a chain: sweeps end when they change less
#define BOUNCE_SETTLED 1e-2f
// of the points of a chain of impacts, m/s: what closes more slowly is left to the next substep
#define CLOSING 1e-2f
// What the bodies may shift against each other, m, and rotate, rad, within a step while a contact's arms and inertia
// stay those of its start
#define FROZEN_SHIFT 5e-4f
#define FROZEN_ROTATION 5e-3f
// a rotation within the step, rad, up to which effective masses stay: they only decide how fast the sweeps converge
#define FROZEN_MASS 0.02f
// Of speeds, shifts and arms: far above what rounding does to what a point requests
#define IDLE_ERROR 1e-5f
// Relative spread of the principal moments below which an inertia is isotropic
#define ROUND_INERTIA 1e-4f
// A sticking contact may exceed its static friction by this factor before it slides. A force above the contact that
// comes at once rotates the body until the normals balance its moment, a substep later; friction then makes good what
// was lost: at most 1.25 times the force. A sliding contact requests more from a hundredth of a m/s on.
#define BREAKAWAY 1.3f
// Of a change of the impulses of a lent link, the share that the points must answer by
#define LEAST_ALONG 1e-5f
// The share of the speed of what a light link bears that a pass over one of its contacts changes, at least, where the
// contact is as stiff as for the whole load
#define LEAST_FOLLOWED 0.03f
// The most that s of `slide` may be, where the slip all but vanishes: so that its products stay finite
#define MOST_PART 1e6f
// A change of friction in a pass, of the load and as a speed, m/s, from which on the row runs again, and how often at
// most. Of what lands, the share of its friction: it keeps what is wrong then. What is set down, with a load that is
// new but for a quarter, is rocked by what is wrong.
#define UNSETTLED 0.1f
#define UNSETTLED_SPEED 0.005f
#define UNSETTLED_LANDING 0.02f
#define UNSETTLED_SET_DOWN 0.02f
#define UNSETTLED_SET_DOWN_SPEED 0.001f
#define SET_DOWN 0.75f
#define SETTLING 12
// The greatest share of the rest that a run of a row leaves: a cube's is 0.6, and parts of bodies that are held
// elsewhere too are stretched by 4 at most.
#define MOST_SHARE 0.75f
// An impact: this share of the load came within a substep, and stopped more than c->impact, m/s
#define IMPACT_SHARE (1.0f / 3.0f)

typedef struct {
    wide r[3];     // from A's centre (from B's when A is static: then span is 0)
    wide distance; // separation where the bodies are now: they move only before relax
    wide mass;     // m_i = 1 / K_ii, 0 for a point that is not there
    wide impulse;
} contact_point;

typedef struct {
    side a, b;
    wide3 normal, span;
} pair; // what a pass over a row holds in registers

// of the bodies since the step began
typedef struct {
    wide3 shift; // of B's centre against A's
    wide4 rotation_a, rotation_b;
} motion;

// impulses of a contact together: on B, with their moment about A's centre
typedef struct {
    wide3 impulse, moment;
} wrench;

// a quantity of a point: constant + slope . rA
typedef struct {
    wide constant;
    wide3 slope;
} affine;

FE_INLINE wide at(const affine *f, wide3 r) { return f->constant + w_dot(f->slope, r); }

FE_INLINE wide_mask no_lane(void) { return w_greater(w_set(0.0f), w_set(0.0f)); }
FE_INLINE wide_mask every_lane(void) { return w_not(no_lane()); }

FE_INLINE wide sine_square(wide4 q) { return w_dot(w_xyz(q), w_xyz(q)); } // of half the angle

FE_INLINE wide_sym choose_sym(wide_mask lanes, const wide_sym *yes, const wide_sym *no)
{
    return (wide_sym){w_choose(lanes, yes->xx, no->xx), w_choose(lanes, yes->xy, no->xy),
                      w_choose(lanes, yes->xz, no->xz), w_choose(lanes, yes->yy, no->yy),
                      w_choose(lanes, yes->yz, no->yz), w_choose(lanes, yes->zz, no->zz)};
}

FE_INLINE side choose_side(wide_mask lanes, side yes, side no)
{
    no.v = w_choose3(lanes, yes.v, no.v), no.w = w_choose3(lanes, yes.w, no.w);
    return no;
}

// a part of the change from one to the other
FE_INLINE side blend(wide part, const side *from, const side *to)
{
    side b = *to;
    b.v = w_add_scaled(from->v, part, w_sub(to->v, from->v));
    b.w = w_add_scaled(from->w, part, w_sub(to->w, from->w));
    return b;
}

static const int coupling_of[FE__POINTS][FE__POINTS] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

// Two unit vectors that make a basis with n (Duff et al., "Building an Orthonormal Basis, Revisited", 2017). They flip
// where n.z changes sign, so they live no longer than a step.
FE_INLINE void tangents(wide3 n, wide3 *t1, wide3 *t2)
{
    wide one = w_set(1.0f);
    wide sign = w_choose(w_greater(w_set(0.0f), n.z), -one, one);
    wide a = -one / (sign + n.z), b = n.x * n.y * a;
    *t1 = (wide3){one + sign * n.x * n.x * a, sign * b, -(sign * n.x)};
    *t2 = (wide3){b, sign + n.y * n.y * a, -n.y};
}

// angular arms of a unit impulse at a point, and the spin they cause
typedef struct {
    wide3 a, b, spin_a, spin_b;
} arm;

FE_INLINE wide angular_response(const arm *m, const arm *n, int kind)
{
    wide b = w_dot(m->b, n->spin_b);
    return kind & FE__ROW_PAIR ? w_dot(m->a, n->spin_a) + b : b;
}

// Where the records of a row's contacts are
typedef struct {
    void *contact[FE_W], *points[FE_W];
} row_contacts;

FE_INLINE const fe__contact *contact_of(const fe__records *of, const fe__lane *lane)
{
    return of[lane->home].contacts + lane->contact;
}
FE_INLINE fe__points *points_of(const fe__records *of, const fe__lane *lane)
{
    return of[lane->home].points + lane->points;
}

FE_INLINE row_contacts name_contacts(const fe__records *of, const fe__lane *lane)
{
    row_contacts r;
    for (int i = 0; i < FE_W; ++i) {
        r.contact[i] = (void *)(uintptr_t)contact_of(of, lane + i);
        r.points[i] = points_of(of, lane + i);
    }
    return r;
}

#define CONTACT_QUAD(field) w_gather_from(r->contact, offsetof(fe__contact, field))
FE_INLINE size_t point_offset(int i) { return offsetof(fe__points, point) + (size_t)i * sizeof(fe__contact_arm); }
#define POINTS_QUAD(field) w_gather_from(r->points, offsetof(fe__points, field))

// A point counts for the height of the friction centre by how much nearer it is than a quarter of the speculative
// distance: friction acts where the bodies touch, not at a corner that stands off. Those farther off still count a
// little: the weights never all vanish
#define TOUCHES 4.0f
#define LEAST_WEIGHT 1e-10f
// ratio of the lesser to the greater eigenvalue below which a tangent matrix has one: far above rounding, far below
// what a shape can have
#define ONE_WAY 1e-5f
// of the bodies' inverse masses: a smaller response is that of a direction within 1e-5 of a locked one
#define LEAST_RESPONSE 1e-10f
// of the trace of a rolling mass, added to its diagonal
#define REGULAR 1e-6f

// what a row is made of
FE_INLINE void prefetch_contact(const fe__records *of, const fe__lane *lane)
{
    __builtin_prefetch(contact_of(of, lane));
    fe__fetch(points_of(of, lane), sizeof(fe__points));
}

// FE__AHEAD, by a contact's tolerance
FE_INLINE wide_mask found_ahead(wide tolerance)
{
    return w_and(w_greater(w_set(0.0f), tolerance), w_greater(tolerance, w_set(0.5f * FE__FOLLOWS)));
}

FE_INLINE wide_mask any_nonzero(wide4 a)
{
    return w_greater(w_abs(a.x) + w_abs(a.y) + (w_abs(a.z) + w_abs(a.w)), w_set(0.0f));
}

// Of B, which is always dynamic and in no other row of the colour
static __attribute__((noinline)) void mark_strained(fe__solver *s, const int32_t *line, wide_mask lanes)
{
    _Alignas(64) float is[FE_W];
    *(wide *)is = w_choose(lanes, w_set(1.0f), w_set(0.0f));
    for (int i = 0; i < FE_W; ++i)
        if (is[i] != 0.0f) s->inertia[line[i]].mark = (float)FE__STRAINED;
    atomic_store_explicit(&s->strained, 1, memory_order_relaxed);
}

// Lanes of record 0 are padding: it stays zero and is written by nobody
FE_INLINE void store_lanes(const fe__records *of, const fe__lane *lanes, wide4 normal, wide4 friction, wide4 total)
{
    _Alignas(64) float n[FE_W][4], f[FE_W][4], t[FE_W][4];
    w_scatter(n[0], 4, w_in_order, normal);
    w_scatter(f[0], 4, w_in_order, friction);
    w_scatter(t[0], 4, w_in_order, total);
    for (int i = 0; i < FE_W; ++i) {
        if (!lanes[i].points) continue;
        fe__points *q = points_of(of, lanes + i);
        *(quad *)q->normal_impulse = *(const quad *)n[i];
        *(quad *)q->friction_impulse = *(const quad *)f[i];
        *(quad *)q->total_impulse = *(const quad *)t[i];
    }
}

FE_INLINE wide_mask lanes_of(uint32_t bits)
{
    _Alignas(64) float is[FE_W];
    for (int i = 0; i < FE_W; ++i) is[i] = bits >> i & 1 ? 1.0f : 0.0f;
    return w_greater(*(wide *)is, w_set(0.0f));
}

static uint32_t bits_of(wide_mask lanes)
{
    _Alignas(64) float is[FE_W];
    uint32_t bits = 0;
    *(wide *)is = w_choose(lanes, w_set(1.0f), w_set(0.0f));
    for (int i = 0; i < FE_W; ++i) bits |= (uint32_t)(is[i] != 0.0f) << i;
    return bits;
}

#define POINTS 4
#include "solver/contact/contact_rows.inl"
#define POINTS 1
#include "solver/contact/contact_rows.inl"

#define OF_KINDS(verb)                                                                                                \
    {                                                                                                                 \
        [0] = verb##_fixed_4, [FE__ROW_PAIR] = verb##_pair_4, [FE__ROW_SPECIAL] = verb##_fixed_special_4,             \
        [FE__ROW_PAIR | FE__ROW_SPECIAL] = verb##_pair_special_4, [FE__ROW_SINGLE] = verb##_fixed_1,                  \
        [FE__ROW_SINGLE | FE__ROW_PAIR] = verb##_pair_1, [FE__ROW_SINGLE | FE__ROW_SPECIAL] = verb##_fixed_special_1, \
        [FE__ROW_SINGLE | FE__ROW_PAIR | FE__ROW_SPECIAL] = verb##_pair_special_1                                     \
    }

const fe__contact_kernels FE_NAME(fe__contact_kernels) = {
    .row_size = {[0] = sizeof(contact_row_4),
                 [FE__ROW_PAIR] = sizeof(contact_row_4),
                 [FE__ROW_SPECIAL] = sizeof(special_row_4),
                 [FE__ROW_PAIR | FE__ROW_SPECIAL] = sizeof(special_row_4),
                 [FE__ROW_SINGLE] = sizeof(contact_row_1),
                 [FE__ROW_SINGLE | FE__ROW_PAIR] = sizeof(contact_row_1),
                 [FE__ROW_SINGLE | FE__ROW_SPECIAL] = sizeof(special_row_1),
                 [FE__ROW_SINGLE | FE__ROW_PAIR | FE__ROW_SPECIAL] = sizeof(special_row_1)},
    .prepare = OF_KINDS(prepare),
    .solve = OF_KINDS(solve),
    .relax = OF_KINDS(relax),
    .bounce = OF_KINDS(bounce),
    .touches = OF_KINDS(touches),
    .act = OF_KINDS(act),
    .store = OF_KINDS(store),
};
