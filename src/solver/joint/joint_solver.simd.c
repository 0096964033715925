// joint_solver.simd.c - the joint solver: rows of W joints' parts, a kind of row for each kind of part. Compiled once
// per SIMD set; see core/simd.h.
//
// After E. Catto, "Soft Constraints" (GDC 2011), as the contacts: in each substep a soft pass, then positions, then a
// relax pass. The first warm start is part of prepare; the later ones are carried by the bodies.
#include "core/simd.h"
#include "solver/joint/joint_solver.h"
#include "solver/solver.h"
#include "solver/wide_body.h"

#include <float.h>
#include <stddef.h>

#include "solver/joint/wide.inl"
#include "solver/joint/axis.inl"
#include "solver/joint/point.inl"
#include "solver/joint/slide.inl"
#include "solver/joint/rotation.inl"
#include "solver/joint/lock_lanes.inl"

#define KERNELS(name, form)                                                          \
    {                                                                                \
        sizeof(form##_row), prepare_##name, solve_##form, relax_##name, store_##name \
    }

#define LOCKS                                                                                                 \
    {                                                                                                         \
        FE_W, offsetof(point_row, impulse) / sizeof(float),                                                   \
            (offsetof(point_row, total) - offsetof(point_row, impulse)) / sizeof(float), read_lock, add_lock, \
            take_lock, forbidden_gap, forbidden_speed                                                         \
    }

const fe__joint_kernels FE_NAME(fe__joint_kernels) = {.of =
                                                          {
                                                              [FE__PART_X] = KERNELS(x, linear),
                                                              [FE__PART_Y] = KERNELS(y, linear),
                                                              [FE__PART_Z] = KERNELS(z, linear),
                                                              [FE__PART_DISTANCE] = KERNELS(distance, linear),
                                                              [FE__PART_TWIST] = KERNELS(twist, angular),
                                                              [FE__PART_SWING_Y] = KERNELS(swing_y, angular),
                                                              [FE__PART_SWING_Z] = KERNELS(swing_z, angular),
                                                              [FE__PART_CONE] = KERNELS(cone, angular),
                                                              [FE__PART_ROTATION] = KERNELS(rotation, rotation),
                                                              [FE__PART_HINGE] = KERNELS(hinge, hinge),
                                                              [FE__PART_FIXED] = KERNELS(fixed, fixed),
                                                              [FE__PART_SLIDE] = KERNELS(slide, slide),
                                                              [FE__PART_POINT] = KERNELS(point, point),
                                                          },
                                                      .locks = LOCKS};
