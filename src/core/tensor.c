// tensor.c - see tensor.h.
#include "core/tensor.h"

enum { JACOBI_SWEEPS = 12 }; // converges quadratically: 5 or 6 are used

// One Jacobi rotation in the plane (p, q) that zeroes a[p][q]; `v` collects the rotations, its columns become the axes.
// Golub and Van Loan, Matrix Computations, 8.5
static void rotate_plane(fe__tensor *a, fe__tensor *v, int p, int q)
{
    double apq = a->m[p][q];
    if (apq == 0.0) return;
    double tau = (a->m[q][q] - a->m[p][p]) / (2.0 * apq);
    double t = (tau >= 0.0 ? 1.0 : -1.0) / (fe__absd(tau) + sqrt(1.0 + tau * tau));
    double c = 1.0 / sqrt(1.0 + t * t), s = t * c;
    for (int k = 0; k < 3; ++k) {
        double x = a->m[k][p], y = a->m[k][q];
        a->m[k][p] = c * x - s * y, a->m[k][q] = s * x + c * y;
    }
    for (int k = 0; k < 3; ++k) {
        double x = a->m[p][k], y = a->m[q][k];
        a->m[p][k] = c * x - s * y, a->m[q][k] = s * x + c * y;
        x = v->m[k][p], y = v->m[k][q];
        v->m[k][p] = c * x - s * y, v->m[k][q] = s * x + c * y;
    }
    a->m[p][q] = a->m[q][p] = 0.0;
}

fe__tensor fe__tensor_diagonalise(fe__tensor *a)
{
    fe__tensor axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    // products of inertia at the rounding of the sums are none: symmetric bodies keep the axes they were built on
    double none = 1e-14 * (a->m[0][0] + a->m[1][1] + a->m[2][2]);
    for (int sweep = 0; sweep < JACOBI_SWEEPS; ++sweep) {
        double off = fe__absd(a->m[0][1]) + fe__absd(a->m[0][2]) + fe__absd(a->m[1][2]);
        if (off <= none) break;
        rotate_plane(a, &axes, 0, 1);
        rotate_plane(a, &axes, 0, 2);
        rotate_plane(a, &axes, 1, 2);
    }
    return axes;
}

// The quaternion of a rotation matrix, from its largest component so that nothing cancels (Shepperd 1978). Jacobi's
// product of rotations is one.
fe_quat fe__tensor_rotation(const fe__tensor *r)
{
    double trace = r->m[0][0] + r->m[1][1] + r->m[2][2], q[4];
    int k = r->m[0][0] > r->m[1][1] ? 0 : 1;
    if (r->m[2][2] > r->m[k][k]) k = 2;
    if (trace >= r->m[k][k]) {
        q[3] = 0.5 * sqrt(1.0 + trace);
        double scale = 0.25 / q[3];
        q[0] = scale * (r->m[2][1] - r->m[1][2]), q[1] = scale * (r->m[0][2] - r->m[2][0]),
        q[2] = scale * (r->m[1][0] - r->m[0][1]);
    } else {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        q[k] = 0.5 * sqrt(1.0 + r->m[k][k] - r->m[i][i] - r->m[j][j]);
        double scale = 0.25 / q[k];
        q[i] = scale * (r->m[i][k] + r->m[k][i]), q[j] = scale * (r->m[j][k] + r->m[k][j]),
        q[3] = scale * (r->m[j][i] - r->m[i][j]);
    }
    return (fe_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
}
