// tensor.h - inertia in double: a symmetric 3 x 3 matrix, its principal moments and axes. Used for bodies, from their
// shapes, and for hulls, from their points.
#ifndef FE_CORE_TENSOR_H
#define FE_CORE_TENSOR_H
#include "core/math.h"

typedef struct fe__tensor {
    double m[3][3];
} fe__tensor;

// The principal moments are left on the diagonal of `a`. Returns the rotation whose columns are their axes: the
// identity for a tensor that is diagonal already.
fe__tensor fe__tensor_diagonalise(fe__tensor *a);
// Its quaternion, of length 1 up to the rounding of floats
fe_quat fe__tensor_rotation(const fe__tensor *r);

#endif
