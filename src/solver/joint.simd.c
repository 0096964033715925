// joint.simd.c - the joint solver: rows of W joints' parts, a kind of row for each kind of part. Compiled once per SIMD set; see
// core/simd.h.
//
// After E. Catto, "Soft Constraints" (GDC 2011), as the contacts: in each substep a soft pass, then positions, then a rigid one. The first
// warm start is part of prepare; the later ones are carried by the bodies.
#include "core/simd.h"
#include "solver/joint.h"
#include "solver/solver.h"
#include "solver/wide_body.h"

#include <float.h>

#include "solver/joint_wide.h"
#include "solver/joint_point.h"

#define KERNELS(name, row)                                                    \
    {                                                                         \
        sizeof(row), prepare_##name, solve_##name, relax_##name, store_##name \
    }

const fe__joint_kernels FE_NAME(fe__joint_kernels) = {{
    [FE__PART_POINT] = KERNELS(point, point_row),
}};
