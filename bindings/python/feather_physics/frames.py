"""Rotations, frames and inertias, as files of robots and scenes have them: quaternions are x, y, z, w."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import List, Sequence, Tuple

Triple = Tuple[float, float, float]
Turn = Tuple[float, float, float, float]
NO_TURN: Turn = (0.0, 0.0, 0.0, 1.0)
ORIGIN: Triple = (0.0, 0.0, 0.0)
HALF_TURN = 0.5**0.5
Y_TO_Z: Turn = (HALF_TURN, 0.0, 0.0, HALF_TURN)  # the cylinders of robots stand along z, ours along y
Z_TO_Y: Turn = (-HALF_TURN, 0.0, 0.0, HALF_TURN)


def multiply(a: Sequence[float], b: Sequence[float]) -> Turn:
    """First b, then a."""
    (ax, ay, az, aw), (bx, by, bz, bw) = a, b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Sequence[float], v: Sequence[float]) -> Triple:
    """v turned by q."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def normalized(v: Sequence[float]) -> Tuple[float, ...]:
    """Of length 1."""
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def add(a: Sequence[float], b: Sequence[float]) -> Triple:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def turn_of(roll: float, pitch: float, yaw: float) -> Turn:
    """About x, then y, then z, all fixed axes."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2), math.cos(a / 2)) for a in (roll, pitch, yaw))
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def angles_of(q: Sequence[float]) -> Triple:
    """Roll, pitch, yaw."""
    x, y, z, w = q
    pitch = 2 * (w * y - z * x)
    if abs(pitch) > 1 - 1e-14:  # straight up or down: roll and yaw are one turn
        return 0.0, math.copysign(math.pi / 2, pitch), math.copysign(2, -pitch) * math.atan2(x, w)
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    return roll, math.asin(pitch), math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def principal(matrix: Sequence[Sequence[float]]) -> Tuple[Triple, Turn]:
    """Moments and axes of a symmetric matrix, by Jacobi's rotations (Golub and Van Loan, Matrix Computations, 8.5)."""
    a, q = [list(row) for row in matrix], NO_TURN
    scale = max(abs(x) for row in a for x in row)
    for _ in range(60):
        i, k = max(((0, 1), (0, 2), (1, 2)), key=lambda p: abs(a[p[0]][p[1]]))
        if abs(a[i][k]) <= 1e-17 * scale:
            break
        half = 0.5 * math.atan2(2 * a[i][k], a[k][k] - a[i][i])
        if abs(half) > math.pi / 4:  # the smaller of the two turns that do it
            half -= math.copysign(math.pi / 2, half)
        c, s = math.cos(half), math.sin(half)
        r = [[float(m == n) for n in range(3)] for m in range(3)]
        r[i][i] = r[k][k] = c
        r[i][k], r[k][i] = s, -s
        a = [[sum(r[l][m] * a[l][n] for l in range(3)) for n in range(3)] for m in range(3)]
        a = [[sum(a[m][l] * r[l][n] for l in range(3)) for n in range(3)] for m in range(3)]
        axis = 3 - i - k  # the columns of r are the new axes: a turn about the third
        sign = 1.0 if (i, k) == (0, 2) else -1.0
        part = [0.0, 0.0, 0.0, math.cos(half / 2)]
        part[axis] = sign * math.sin(half / 2)
        q = multiply(q, part)
    return (a[0][0], a[1][1], a[2][2]), normalized(q)  # type: ignore[return-value]


def matrix_of(inertia: Sequence[float], q: Sequence[float]) -> List[List[float]]:
    """The matrix of principal moments and their axes."""
    axes = [rotate(q, [float(m == n) for n in range(3)]) for m in range(3)]
    return [[sum(inertia[k] * axes[k][m] * axes[k][n] for k in range(3)) for n in range(3)] for m in range(3)]


@dataclass
class Frame:
    """Where something is and how it is turned."""

    position: Triple = ORIGIN
    rotation: Turn = NO_TURN

    def then(self, other: "Frame") -> "Frame":
        """The other, which is given in this one."""
        turn = normalized(multiply(self.rotation, other.rotation))
        return Frame(add(self.position, rotate(self.rotation, other.position)), turn)  # type: ignore[arg-type]


def inside(outer: Frame, inner: Frame) -> Frame:
    """The inner frame, as seen from the outer one."""
    x, y, z, w = outer.rotation
    back: Turn = (-x, -y, -z, w)
    way = add(inner.position, [-c for c in outer.position])
    return Frame(rotate(back, way), normalized(multiply(back, inner.rotation)))  # type: ignore[arg-type]


# ---- directions


def about(axis: Sequence[float], angle: float) -> Turn:
    """By an angle, rad, about an axis."""
    x, y, z = normalized(axis)
    s = math.sin(angle / 2)
    return x * s, y * s, z * s, math.cos(angle / 2)


def cross(a: Sequence[float], b: Sequence[float]) -> Triple:
    """Square to both."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def from_z(direction: Sequence[float]) -> Turn:
    """The smallest turn that takes z there."""
    x, y, z = normalized(direction)
    if z < -1 + 1e-12:
        return 1.0, 0.0, 0.0, 0.0
    return normalized((-y, x, 0.0, 1 + z))  # type: ignore[return-value]


def of_axes(x: Sequence[float], y: Sequence[float]) -> Turn:
    """The turn that takes x there and y as near to its direction as it may."""
    a = normalized(x)
    along = sum(p * q for p, q in zip(a, y))
    b = normalized([q - along * p for p, q in zip(a, y)])
    # the columns of the matrix are a, b and a x b; from them by the largest of four (Shepperd 1978)
    c = cross(a, b)
    trace = a[0] + b[1] + c[2]
    options = [trace, a[0], b[1], c[2]]
    largest = options.index(max(options))
    if largest == 0:
        q = [b[2] - c[1], c[0] - a[2], a[1] - b[0], 1 + trace]
    elif largest == 1:
        q = [1 + 2 * a[0] - trace, a[1] + b[0], c[0] + a[2], b[2] - c[1]]
    elif largest == 2:
        q = [a[1] + b[0], 1 + 2 * b[1] - trace, b[2] + c[1], c[0] - a[2]]
    else:
        q = [c[0] + a[2], b[2] + c[1], 1 + 2 * c[2] - trace, a[1] - b[0]]
    return normalized(q)  # type: ignore[return-value]
