"""The meshes of robots: STL and OBJ as points and triangles, their masses, and where files of robots say they are."""

from __future__ import annotations

import math
import os
import struct
from typing import Any, Dict, List, Optional, Sequence, Tuple

from .errors import InvalidArgumentError, UnsupportedError
from .frames import Triple, Turn, principal
from .store import Hull, Mesh, Store

MOST_BYTES, MOST_TRIANGLES = 64 << 20, 1_000_000  # of a file
MOST_HULL_VERTICES = 255  # what a hull can have
ELLIPSOID_POINTS = 64

# Points, three numbers each, and triangles, three places of points each
Triangles = Tuple[List[float], List[int]]

# ---- files


def _binary_stl(data: bytes) -> List[Triple]:
    corners: List[Triple] = []
    for *_, ax, ay, az, bx, by, bz, cx, cy, cz, _ in struct.iter_unpack("<12fH", data[84:]):
        corners += ((ax, ay, az), (bx, by, bz), (cx, cy, cz))
    return corners


def _point(words: Sequence[str], where: str) -> Triple:
    try:
        x, y, z = (float(word) for word in words[:3])
    except ValueError:
        raise InvalidArgumentError(f"{where}: three numbers are needed, not {' '.join(words)[:60]!r}") from None
    return x, y, z


def _text_stl(text: str, file: str) -> List[Triple]:
    corners: List[Triple] = []
    for line, words in enumerate(map(str.split, text.splitlines()), 1):
        if words and words[0] == "vertex":
            corners.append(_point(words[1:], f"{file}:{line}"))
    return corners


def _stl(data: bytes, file: str) -> Triangles:
    """Each triangle has corners of its own; equal ones become one point."""
    count = int.from_bytes(data[80:84], "little")
    if len(data) >= 84 and len(data) == 84 + 50 * count:
        corners = _binary_stl(data)
    else:
        corners = _text_stl(data.decode("ascii", "replace"), file)
    if not corners or len(corners) % 3:
        raise InvalidArgumentError(f"{file}: this is no STL with whole triangles")
    places: Dict[Triple, int] = {}
    triangles = [places.setdefault(corner, len(places)) for corner in corners]
    return [x for point in places for x in point], triangles


def _obj(text: str, file: str) -> Triangles:
    points: List[float] = []
    triangles: List[int] = []
    for line, words in enumerate(map(str.split, text.splitlines()), 1):
        if words and words[0] == "v":
            points += _point(words[1:], f"{file}:{line}")
        elif words and words[0] == "f":
            try:
                corners = [int(word.split("/")[0]) for word in words[1:]]
            except ValueError:
                raise InvalidArgumentError(f"{file}:{line}: a face of {words[1:5]}") from None
            count = len(points) // 3
            corners = [c - 1 if c > 0 else count + c for c in corners]  # -1: the last point so far
            if len(corners) < 3 or min(corners) < 0 or max(corners) >= count:
                raise InvalidArgumentError(f"{file}:{line}: a face of {words[1:5]}, with {count} points so far")
            for second, third in zip(corners[1:], corners[2:]):
                triangles += (corners[0], second, third)
    if not points:
        raise InvalidArgumentError(f"{file}: this is no OBJ with points")
    return points, triangles


def read_mesh(file: str, scale: Sequence[float]) -> Triangles:
    """Of an STL or an OBJ, times the scale along each axis."""
    kind = os.path.splitext(file)[1].lower()
    if kind not in (".stl", ".obj"):
        raise UnsupportedError(f"{file}: STL and OBJ are read")
    with open(file, "rb") as stream:
        data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise InvalidArgumentError(f"{file}: {MOST_BYTES} bytes are the most")
    points, triangles = _stl(data, file) if kind == ".stl" else _obj(data.decode("utf-8", "replace"), file)
    if len(triangles) > 3 * MOST_TRIANGLES:
        raise InvalidArgumentError(f"{file}: {MOST_TRIANGLES} triangles are the most")
    return scaled(points, triangles, scale, file)


def scaled(points: Sequence[float], triangles: Sequence[int], scale: Sequence[float], what: str) -> Triangles:
    """Times the scale along each axis; a mirrored mesh keeps its outside."""
    grown = [x * scale[k % 3] for k, x in enumerate(points)]
    if not all(map(math.isfinite, grown)) or 0 in scale:
        raise InvalidArgumentError(f"{what}: points and scale are finite, the scale is not 0")
    turned = list(triangles)
    if scale[0] * scale[1] * scale[2] < 0:
        turned[1::3], turned[2::3] = turned[2::3], turned[1::3]
    return grown, turned


def find_file(name: str, file: Optional[str], folders: Sequence[Any]) -> Optional[str]:
    """Of a name in a file of robots: "package://robot/mesh.stl" in a folder called robot that one of `folders` holds, or
    the file itself lies within; others from the folder of the file, then from `folders`. None: it is not there."""
    near = [] if file is None else [os.path.dirname(os.path.abspath(file))]
    if name.startswith("package://"):
        rest = name[len("package://") :]
        above = list(near)
        while above and os.path.dirname(above[-1]) != above[-1]:
            above.append(os.path.dirname(above[-1]))
        places = [*map(os.fspath, folders), *above]
    else:
        rest = name[len("file://") :] if name.startswith("file://") else name
        places = [*near, *map(os.fspath, folders)]
    found = (os.path.join(place, rest) for place in places or [""])
    return next((path for path in found if os.path.isfile(path)), None)


# ---- masses


def _of_triangles(points: Sequence[float], triangles: Sequence[int]) -> Optional[Tuple[float, Triple, Triple, Turn]]:
    """By tetrahedra from the first point to each triangle (Blow and Binstock, "How to find the inertia tensor", 2004)."""
    o = points[:3]
    p = [(points[k] - o[0], points[k + 1] - o[1], points[k + 2] - o[2]) for k in range(0, len(points), 3)]
    volume, first, second = 0.0, [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for k in range(0, len(triangles), 3):
        a, b, c = (p[corner] for corner in triangles[k : k + 3])
        n = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
        part = (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) / 6
        volume += part
        s = [a[i] + b[i] + c[i] for i in range(3)]
        for i in range(3):
            first[i] += part * s[i] / 4
            for j in range(3):
                second[i][j] += part * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) / 20
    if not abs(volume) > 0:
        return None
    m = [x / volume for x in first]
    spread = [[second[i][j] / volume - m[i] * m[j] for j in range(3)] for i in range(3)]
    trace = sum(spread[i][i] for i in range(3))
    moments, turn = principal([[trace * (i == j) - spread[i][j] for j in range(3)] for i in range(3)])
    if not min(moments) > 0:
        return None
    return abs(volume), (m[0] + o[0], m[1] + o[1], m[2] + o[2]), moments, turn


def mass_of(points: Sequence[float], triangles: Sequence[int]) -> Optional[Tuple[float, Triple, Triple, Turn]]:
    """Volume, centre, moments for a mass of 1 kg, and their axes: of closed triangles, else of the hull. None: flat."""
    if triangles:
        return _of_triangles(points, triangles)
    with Store() as store:
        info = hull_of(store, points).info
    moments = tuple(x / info.volume for x in info.inertia)
    return info.volume, tuple(info.centre), moments, tuple(info.inertia_rotation)  # type: ignore[return-value]


def _rows(points: Sequence[float]) -> List[Sequence[float]]:
    return [points[k : k + 3] for k in range(0, len(points), 3)]


# ---- assets


def hull_of(store: Any, points: Sequence[float]) -> Hull:
    """What a dynamic body collides as, in a store or that of a world."""
    made: Hull = store.create_hull(_rows(points), max_vertices=MOST_HULL_VERTICES)
    return made


def mesh_of(store: Any, points: Sequence[float], triangles: Sequence[int]) -> Mesh:
    """What a static body collides as."""
    made: Mesh = store.create_mesh(_rows(points), triangles)
    return made


def ellipsoid(radii: Sequence[float]) -> List[float]:
    """Points of an ellipsoid, evenly round it (a spiral by the golden angle), and its six ends."""
    points: List[float] = []
    turn = math.pi * (3 - math.sqrt(5))
    count = ELLIPSOID_POINTS - 6
    for k in range(count):
        z = 1 - (2 * k + 1) / count
        r = math.sqrt(1 - z * z)
        points += (radii[0] * r * math.cos(turn * k), radii[1] * r * math.sin(turn * k), radii[2] * z)
    for k in range(3):
        for sign in (-1, 1):
            points += [sign * radii[k] * (j == k) for j in range(3)]
    return points
