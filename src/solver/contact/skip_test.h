// skip_test.h - deferred pairs: awake, without points and events, whose bodies cannot have met since they were last
// looked at.
//
// Most pairs of a heap are near misses. Recycling computes exactly how far the bodies of a pair moved against each
// other, from six cache lines that lie anywhere. A bound of it needs one line beside the list of awake pairs and a
// small table of bodies:
//
//   gap now  >= gap then + n . (shift of B - shift of A) - 2 (arm A |sin(turn A / 2)| + arm B |sin(turn B / 2)|)
//   closing  <= max(n . (vA - vB), 0) + |wA| arm A + |wB| arm B                in the step that comes
//
// where a body's arm is the pair's own: what turns about its centre, a ball, closes nothing by it. Without a normal n
// both arms are the longer one of the bodies' reaches, and the whole motion counts, that since then times sqrt 3 as in
// recycle.simd.c. Where the bound does not decide, the exact test does, so that no result depends on it. While a pair
// is deferred, no stage reads more of it. skip_test.simd.c has the bound.
#ifndef FE_SOLVER_CONTACT_SKIP_TEST_H
#define FE_SOLVER_CONTACT_SKIP_TEST_H
#include "solver/solver_body.h"
#include "solver/contact/contact_solver.h"

#define FE__TICKS 4194304.0f // in 1 m, or 1 of a sine
#define FE__MOST_TRAVEL \
    128.0f // m in a step, and of a gap: four of them are 2^31 ticks. Who leaps farther ends the wait

// Where a body is and how it moves. Ticks are modulo 2^32: only differences count
typedef struct fe__odometer {
    _Alignas(32) uint32_t at[3]; // of its centre of mass, ticks
    uint32_t turned;             // sum of |sin(angle / 2)| of its rotations since it was made, ticks
    float velocity[3];           // of the centre of mass, m/s
    float spin;                  // |angular velocity|, rad/s
} fe__odometer;
_Static_assert(sizeof(fe__odometer) == 32, "half a cache line");
FE__IS_QUAD(fe__odometer, at, turned);
FE__IS_QUAD(fe__odometer, velocity, spin);

// By place in the list of awake pairs. Bodies and normal are the contact's
typedef struct fe__deferral {
    _Alignas(64) float normal[3]; // from A to B, or 0
    float gap;                    // m, when the pair was last looked at
    uint32_t apart[3];            // centre of B - centre of A, then, ticks
    float most;                   // m that the centres may move against each other from then on, in any direction
    uint32_t turned_a, turned_b;  // then
    float arm_a, arm_b;           // of the rotations, m
    int32_t body_a, body_b, spare[2];
} fe__deferral;
_Static_assert(sizeof(fe__deferral) == 64, "a deferral is a cache line");
FE__IS_QUAD(fe__deferral, normal, gap);
FE__IS_QUAD(fe__deferral, apart, most);
FE__IS_QUAD(fe__deferral, turned_a, arm_b);

// An entry of that list is the pair, or ~pair while it is deferred
static inline int32_t fe__pair_of(int32_t entry) { return entry ^ entry >> 31; }

static inline uint32_t fe__ticks(double x) { return (uint32_t)(int64_t)((double)FE__TICKS * x); }

static inline void fe__odometer_place(fe__odometer *o, const double *centre)
{
    const double far = 1e12; // m: ticks of more fit no integer, and floats tell nothing there
    if (fe__absd(centre[0]) + fe__absd(centre[1]) + fe__absd(centre[2]) < far) {
        o->at[0] = fe__ticks(centre[0]), o->at[1] = fe__ticks(centre[1]), o->at[2] = fe__ticks(centre[2]);
        return;
    }
    for (int k = 0; k < 3; ++k) o->at[k] = fe__ticks(fe__maxd(fe__mind(centre[k], far), -far));
}

// rounded up, by more than a rotation loses in its rounding
static inline void fe__odometer_turn(fe__odometer *o, float half_sine)
{
    o->turned += (uint32_t)(FE__TICKS * fe__minf(half_sine, FE__MOST_TRAVEL)) + 1;
}

static inline int32_t fe__has_direction(const float *n) { return n[0] != 0.0f || n[1] != 0.0f || n[2] != 0.0f; }

// Copies what a deferral has of its contact, which has no points.
static inline void fe__deferral_aim(fe__deferral *p, const fe__contact *m)
{
    int32_t has_direction = fe__has_direction(m->normal);
    for (int k = 0; k < 3; ++k) p->normal[k] = m->normal[k];
    p->arm_a = has_direction ? m->surface.radius_a : m->longest_arm;
    p->arm_b = has_direction ? m->surface.radius_b : m->longest_arm;
    p->body_a = m->body_a, p->body_b = m->body_b;
}

// From now on: of a contact without points, whose gap is `gap`, m
static inline void fe__defer(fe__deferral *p, const fe__odometer *odometers, const fe__body *bodies,
                             const fe__contact *m, float gap)
{
    const fe__odometer *a = odometers + m->body_a, *b = odometers + m->body_b;
    const double *at_a = bodies[m->body_a].centre, *at_b = bodies[m->body_b].centre;
    float square = 0.0f; // of the shift since the contact was found, m2
    for (int k = 0; k < 3; ++k) {
        float shift = (float)(at_b[k] - at_a[k] + (double)m->found_span[k]);
        square += shift * shift;
        p->apart[k] = b->at[k] - a->at[k];
    }
    fe__deferral_aim(p, m);
    // of the exact test, m: it must come to the same
    const float rounding = 1e-5f * (1.0f + fe__maxf(p->arm_a, p->arm_b) + gap);
    p->gap = fe__minf(FE__MOST_TRAVEL, gap - rounding);
    p->turned_a = a->turned, p->turned_b = b->turned;
    p->most = fe__minf(FE__MOST_TRAVEL, fe__most_away(m) - sqrtf(square) - rounding);
}

#endif
