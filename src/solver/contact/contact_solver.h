// contact_solver.h - what the solver knows of a pair.
//
// Every pair has a contact: two cache lines of quads that say where the bodies were when it was looked at, and how far
// they may move. Two thirds of a heap's pairs are near misses and have no more. Points and impulses are a record of
// their own, two more lines, which a pair has from its first points until they are gone. The wide kernels gather quads
// of both.
//
// The narrow phase fills contact and points; recycling (recycle.simd.c) updates the separations while the pair moves
// little; prepare turns them into a lane of a row; store brings the impulses back. Side A is the static or kinematic
// body where there is one. Arms and normal stay as the narrow phase found them, from step to step: arms that rotated
// since let a pyramid of 100 rows buckle out of its plane after 300 steps.
#ifndef FE_SOLVER_CONTACT_CONTACT_SOLVER_H
#define FE_SOLVER_CONTACT_CONTACT_SOLVER_H
#include "core/math.h"

enum { FE__POINTS = 4 };
// While a gap of this closes, m, the features of two shapes change little
#define FE__TURNS_LITTLE 0.005f
// How far a pair without points may go before it is looked at, whatever its gap: m, and a share of the longest arm
#define FE__MOST_AWAY 0.25f
#define FE__AWAY_SHARE 0.5f
#define FE__FOLLOWS (-1e15f)
// found ahead of time, at the poses of the touch: good for one step. Its square is 0
#define FE__AHEAD (-1e-30f)

typedef struct fe__surface {
    float dynamic_friction;
    float radius_a, radius_b; // of the round sides, m; without points: arms that turns act on
    float tolerance;          // how far the pair may move, m; FE__FOLLOWS: as far as its head; FE__AHEAD
} fe__surface;

typedef struct fe__contact_arm {
    float arm[3];     // world, m: from A's centre, from B's when A is static
    float separation; // m
} fe__contact_arm;

typedef struct fe__contact {
    // read by prepare: a line
    _Alignas(64) float normal[3]; // unit, from A to B, world; without points: of a plane between, or 0
    float point_count;            // a whole number
    float span[3];                // centre of A - centre of B, m, for torques on B; 0 when A is static
    float static_friction;
    fe__surface surface;
    float found_span[3]; // centre of A - centre of B when found, m
    float longest_arm;   // of the points and of round sides' cores, m; without points: of the bodies
    // the bodies' rotations when found; found ahead of time (it may not move): the rotations from there
    float found_a[4], found_b[4];
    float found_low[3];     // what found_span left of the double difference, m
    int32_t points;         // record of the points; 0: it has none, and record 0 is zeros
    int32_t body_a, body_b; // records, a static body's too
    int32_t kind;           // FE__ROW_* of the row it goes to
    int32_t colour;         // -1: not in the graph
} fe__contact;
_Static_assert(sizeof(fe__contact) == 128, "a contact is two cache lines");
FE__IS_QUAD(fe__contact, normal, point_count);
FE__IS_QUAD(fe__contact, span, static_friction);
FE__IS_QUAD(fe__contact, found_span, longest_arm);
FE__IS_QUAD(fe__contact, found_low, points);
_Static_assert(offsetof(fe__contact, surface) % 16 == 0 && sizeof(fe__surface) == 16, "a surface is a quad");
_Static_assert(offsetof(fe__contact, found_a) == 64, "what recycling adds is the second line");

typedef struct fe__points {
    // now: read by prepare, written by store
    _Alignas(64) float separation[FE__POINTS]; // m, when the step begins
    float normal_impulse[FE__POINTS];          // N s
    float friction_impulse[3];                 // on B, world (a tangent basis may flip between steps)
    float twist_impulse;                       // about the normal, N m s
    float total_impulse[FE__POINTS];           // along the normal over the whole step, N s
    fe__contact_arm point[FE__POINTS];         // as found
} fe__points;
_Static_assert(sizeof(fe__points) == 128, "points are two cache lines");
FE__IS_QUAD(fe__points, friction_impulse, twist_impulse);
_Static_assert(offsetof(fe__points, point) == 64 && sizeof(fe__contact_arm) == 16, "points are quads");

static inline float fe__most_away(const fe__contact *m)
{
    return fe__maxf(m->surface.tolerance, fe__minf(FE__MOST_AWAY, FE__AWAY_SHARE * m->longest_arm));
}

static inline void fe__points_forget_impulses(fe__points *q)
{
    for (int k = 0; k < FE__POINTS; ++k) q->normal_impulse[k] = q->total_impulse[k] = 0.0f;
    for (int k = 0; k < 3; ++k) q->friction_impulse[k] = 0.0f;
    q->twist_impulse = 0.0f;
}

// What a special row needs beyond them, by record of the points
typedef struct fe__extra {
    float restitution;
    float rolling;             // resistance times radius, m
    float spinning;            // m
    float surface_velocity[3]; // of B's surface against A's, world, m/s
    float rolling_impulse[3];  // on B, world, N m s
} fe__extra;

#endif
