// pace.h - how fine the substeps of an island are.
#ifndef FE_SOLVER_PACE_H
#define FE_SOLVER_PACE_H
#include "solver/solver.h"

// A pass hands an impulse on by a body or so. Where that is too slow substeps are finer: in islands of bodies that bear
// many times their weight, which have more relax passes too, and are strained; in islands whose joints open wide, which
// are stretched. Joined bodies press each other with the forces of their joints, which is no strain.
//
// The pace of an island, by the flags of all its bodies.
static inline int32_t fe__pace_of(uint32_t flags, int32_t has_joints)
{
    if (has_joints) return flags & FE__BODY_STRETCHED ? FE__STRETCHED : FE__USUAL;
    return flags & FE__BODY_STRAINED ? FE__STRAINED : FE__USUAL;
}

#endif
