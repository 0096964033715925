"""The masses of robots: what forms weigh, what a body of several weighs, and moments that a body can have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

from .frames import ORIGIN, Frame, Triple, matrix_of, principal
from .scene_records import SceneBody, SceneShape

DENSITY = 1000.0  # kg/m3, where a file gives none


@dataclass
class Geom:
    """A form of a body, in the body's frame. It counts for the mass though it may meet nothing."""

    shape: Optional[SceneShape]
    mass: float
    moments: Triple  # about its centre, along its own axes
    frame: Frame


def volume_of(kind: str, size: Sequence[float]) -> Tuple[float, Tuple[float, float, float]]:
    """Volume, and moments of inertia for a mass of 1 kg, of a form along z."""
    if kind == "plane":
        return 0.0, ORIGIN
    if kind == "sphere":
        r = size[0]
        return 4 / 3 * math.pi * r**3, (0.4 * r * r, 0.4 * r * r, 0.4 * r * r)
    if kind in ("box", "ellipsoid"):
        x, y, z = (s * s for s in size)
        volume, share = (8.0, 1 / 3) if kind == "box" else (4 / 3 * math.pi, 1 / 5)
        return volume * size[0] * size[1] * size[2], (share * (y + z), share * (x + z), share * (x + y))
    r, h = size
    cylinder = math.pi * r * r * 2 * h
    across, along = (3 * r * r + 4 * h * h) / 12, r * r / 2
    if kind == "cylinder":
        return cylinder, (across, across, along)
    balls = 4 / 3 * math.pi * r**3  # two halves, each with its centre 3/8 r outside of the line's end
    volume = cylinder + balls
    part, rest = cylinder / volume, balls / volume
    across = part * across + rest * (0.4 * r * r + h * h + 0.75 * h * r)
    return volume, (across, across, part * along + rest * 0.4 * r * r)


def combine(body: SceneBody, geoms: List[Geom]) -> None:
    """Mass, centre and inertia of a body from its geoms."""
    if not geoms:
        return
    mass = sum(geom.mass for geom in geoms)
    body.centre = tuple(sum(g.mass * g.frame.position[k] for g in geoms) / mass for k in range(3))  # type: ignore[assignment]
    tensor = [[0.0] * 3 for _ in range(3)]
    for geom in geoms:
        own = matrix_of(geom.moments, geom.frame.rotation)
        d = [p - c for p, c in zip(geom.frame.position, body.centre)]
        for m in range(3):
            for n in range(3):  # Steiner's theorem
                tensor[m][n] += own[m][n] + geom.mass * (sum(x * x for x in d) * (m == n) - d[m] * d[n])
    body.mass = mass
    body.inertia, body.inertia_rotation = principal(tensor)


# ---- moments that a body can have


def is_sound(moments: Sequence[float]) -> bool:
    """Each is above 0, and not by rounding alone; none is above the sum of the others (A + B >= C), up to the digits that
    files are written with."""
    return min(moments) > 1e-12 * max(moments) > 0 and 2 * max(moments) <= sum(moments) * (1 + 1e-6)


def of_ball(mass: float) -> Triple:
    """The moments of a ball of water."""
    radius = (3 * mass / (4 * math.pi * DENSITY)) ** (1 / 3)
    return (0.4 * mass * radius**2,) * 3


def balanced(moments: Sequence[float], mass: float) -> Triple:
    """Sound ones instead, as MuJoCo has them: what is below 0 counts as 0, and where one is above the sum of the others,
    each becomes their mean. A rod's 0 becomes a millionth, and a point gets the moments of a ball."""
    least = [max(x, 0.0) for x in moments]
    if 2 * max(least) > sum(least) * (1 + 1e-6):
        least = [sum(least) / 3] * 3
    if max(least) == 0:
        return of_ball(mass)
    return tuple(max(x, 1e-6 * max(least)) for x in least)  # type: ignore[return-value]


def fuse(body: SceneBody, part: SceneBody, at: Frame) -> None:
    """Adds to a body the mass of one that is fixed to it, at a frame of it."""
    geoms = [
        Geom(None, one.mass, one.inertia, frame.then(Frame(one.centre, one.inertia_rotation)))
        for one, frame in ((body, Frame()), (part, at))
        if one.mass is not None
    ]
    combine(body, geoms)
