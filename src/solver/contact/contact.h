// contact.h - what the solver knows of a touching pair.
//
// Four cache lines of quads, gathered one by one by the wide kernels. The narrow phase fills a contact; recycling (recycle.simd.c) updates
// its separations while the pair moves little; prepare turns it into a lane of a row; store brings the impulses back. Side A is the static
// or kinematic body where there is one. Arms and normal stay as the narrow phase found them, from step to step: arms that turn since let a
// pyramid of 100 rows buckle out of its plane after 300 steps.
#ifndef FE_SOLVER_CONTACT_H
#define FE_SOLVER_CONTACT_H
#include <stdint.h>

enum { FE__POINTS = 4 };
#define FE__FOLLOWS (-1e15f)
// found ahead of time, at the poses of the touch: good for one step. Its square is 0
#define FE__AHEAD (-1e-30f)

typedef struct fe__contact {
    // now: read by prepare
    _Alignas(64) float separation[FE__POINTS]; // m, when the step begins
    float normal[4];                           // unit, from A to B, world; lane 3: number of points
    float span[4];    // centre of A - centre of B, m, for torques on B; 0 when A is static; lane 3: static friction
    float surface[4]; // dynamic friction | radius of A's round side, of B's, m | how far the pair may move, m; FE__FOLLOWS: as far as its
                      // head; FE__AHEAD
    // impulses
    float normal_impulse[FE__POINTS]; // N s
    float friction_impulse[4];        // on B, world (a tangent basis may flip between steps); lane 3: twist, N m s
    float total_impulse[FE__POINTS];  // along the normal over the whole step, N s
    float found_span[4];              // centre of A - centre of B when found, m; lane 3: longest arm, m
    // as found
    float point[FE__POINTS][4];   // arm, world, m: from A's centre, from B's when A is static; lane 3: separation then
    float found_a[4], found_b[4]; // the bodies' rotations then; found ahead of time (it may not move): the turns from there
    float found_low[4];           // what found_span left of the double difference, m
    int32_t body_a, body_b;       // records, a static body's too
    int32_t kind;                 // FE__ROW_* of the row it goes to
    int32_t colour;               // -1: not in the graph
} fe__contact;
_Static_assert(sizeof(fe__contact) == 256, "a contact is four cache lines");

// What a special row needs beyond it, by contact index
typedef struct fe__extra {
    float restitution;
    float rolling;             // resistance times radius, m
    float spinning;            // m
    float surface_velocity[3]; // of B's surface against A's, world, m/s
    float rolling_impulse[3];  // on B, world, N m s
} fe__extra;

#endif
