"""The meshes of robots: STL and OBJ as points and triangles, their masses, and where files of robots say they are."""

from __future__ import annotations

import io
import math
import os
import struct
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from .errors import DegenerateError, SceneError
from .frames import Triple, Turn, principal, rotate
from .robot_dae import read_dae
from .robot_xml import read_file
from .store import Hull, Mesh, Store

MOST_BYTES, MOST_TRIANGLES = 64 << 20, 1_000_000  # of a file
MOST_NUMBERS = 3 * 3 * MOST_TRIANGLES  # of its points, were none shared
MOST_CORNERS = 10_000  # of a face
MOST_HULL_VERTICES = 255  # what a hull can have
LEAST_THICKNESS = 0.001  # m
ELLIPSOID_POINTS = 64

# Points, three numbers each, and triangles, three places of points each
Triangles = Tuple[List[float], List[int]]

# ---- files. What they hold counts while they are read, and no message repeats it: a name in a robot's file may lead to
# any file


def _crowded(file: str) -> SceneError:
    return SceneError(f"{file}: {MOST_TRIANGLES} triangles are the most")


def _binary_stl(data: bytes, count: int, file: str) -> Triangles:
    """Each triangle has corners of its own; equal ones become one point."""
    if count > MOST_TRIANGLES:
        raise _crowded(file)
    places: Dict[bytes, int] = {}
    place = places.setdefault
    triangles: List[int] = []
    for at in range(96, 84 + 50 * count, 50):  # 12 bytes each: after the normal the corners
        triangles += (
            place(data[at : at + 12], len(places)),
            place(data[at + 12 : at + 24], len(places)),
            place(data[at + 24 : at + 36], len(places)),
        )
    return list(struct.unpack(f"<{3 * len(places)}f", b"".join(places))), triangles


def _point(words: Sequence[bytes], where: str) -> Triple:
    try:
        x, y, z = (float(word) for word in words[:3])
    except ValueError:
        raise SceneError(f"{where}: three numbers are needed") from None
    return x, y, z


def _text_stl(data: bytes, file: str) -> Triangles:
    places: Dict[Triple, int] = {}
    triangles: List[int] = []
    for line, text in enumerate(io.BytesIO(data), 1):
        words = text.split(None, 4)
        if words and words[0] == b"vertex":
            corner = _point(words[1:], f"{file}:{line}")
            triangles.append(places.setdefault(corner, len(places)))
            if len(triangles) > 3 * MOST_TRIANGLES:
                raise _crowded(file)
    return [x for point in places for x in point], triangles


def _stl(data: bytes, file: str) -> Triangles:
    count = int.from_bytes(data[80:84], "little")
    is_binary = len(data) >= 84 and len(data) == 84 + 50 * count
    points, triangles = _binary_stl(data, count, file) if is_binary else _text_stl(data, file)
    if not triangles or len(triangles) % 3:
        raise SceneError(f"{file}: this is no STL with whole triangles")
    return points, triangles


def _face(words: Sequence[bytes], count: int, where: str) -> List[int]:
    """The places of its corners, where there are so many points so far."""
    try:
        corners = [int(word.split(b"/", 1)[0]) for word in words]
    except ValueError:
        corners = []
    corners = [c - 1 if c > 0 else count + c for c in corners]  # -1: the last point so far
    if not 3 <= len(corners) <= MOST_CORNERS or min(corners) < 0 or max(corners) >= count:
        raise SceneError(f"{where}: a face has 3 to {MOST_CORNERS} corners, each one of the {count} points so far")
    return corners


def _obj(data: bytes, file: str) -> Triangles:
    points: List[float] = []
    triangles: List[int] = []
    for line, text in enumerate(io.BytesIO(data), 1):
        words = text.split(None, MOST_CORNERS + 1)
        if words and words[0] == b"v":
            points += _point(words[1:4], f"{file}:{line}")
        elif words and words[0] == b"f":
            corners = _face(words[1:], len(points) // 3, f"{file}:{line}")
            for second, third in zip(corners[1:], corners[2:]):
                triangles += (corners[0], second, third)
        if len(triangles) > 3 * MOST_TRIANGLES or len(points) > MOST_NUMBERS:
            raise _crowded(file)
    if not points:
        raise SceneError(f"{file}: this is no OBJ with points")
    return points, triangles


def _msh(data: bytes, file: str) -> Triangles:
    """MuJoCo's own: how many points, normals, texture coordinates and triangles; then these, the last as integers."""
    counts = struct.unpack("<4i", data[:16]) if len(data) >= 16 else (-1,) * 4
    points, normals, textures, faces = counts
    if min(counts) < 0 or len(data) != 16 + 12 * points + 12 * normals + 8 * textures + 12 * faces or points < 4:
        raise SceneError(f"{file}: this is no MSH with points")
    if faces > MOST_TRIANGLES:
        raise _crowded(file)
    triangles = list(struct.unpack(f"<{3 * faces}i", data[len(data) - 12 * faces :]))
    if triangles and not 0 <= min(triangles) <= max(triangles) < points:
        raise SceneError(f"{file}: a triangle has a corner that is none of the points")
    return list(struct.unpack_from(f"<{3 * points}f", data, 16)), triangles


def _dae(data: bytes, file: str) -> Triangles:
    return read_dae(data, file, MOST_TRIANGLES)


READERS: Dict[str, Callable[[bytes, str], Triangles]] = {".stl": _stl, ".obj": _obj, ".msh": _msh, ".dae": _dae}


def read_mesh(file: str, scale: Sequence[float]) -> Triangles:
    """Of an STL, OBJ, COLLADA or MSH file, times the scale along each axis."""
    kind = os.path.splitext(file)[1].lower()
    if kind not in READERS:
        raise SceneError(f"{file}: STL, OBJ, DAE and MSH are read")
    try:
        data = read_file(file, MOST_BYTES)
    except OSError as error:
        raise SceneError(f"{file}: {error.strerror}") from None
    if len(data) > MOST_BYTES:
        raise SceneError(f"{file}: {MOST_BYTES} bytes are the most")
    points, triangles = READERS[kind](data, file)
    return scaled(points, triangles, scale, file)


def scaled(points: Sequence[float], triangles: Sequence[int], scale: Sequence[float], what: str) -> Triangles:
    """Times the scale along each axis; a mirrored mesh keeps its outside."""
    grown = list(points)
    for k in range(3):
        if scale[k] != 1:
            grown[k::3] = [x * scale[k] for x in grown[k::3]]
    if not all(map(math.isfinite, grown)) or 0 in scale:
        raise SceneError(f"{what}: points and scale are finite, the scale is not 0")
    turned = list(triangles)
    if scale[0] * scale[1] * scale[2] < 0:
        turned[1::3], turned[2::3] = turned[2::3], turned[1::3]
    return grown, turned


def find_file(name: str, file: Optional[str], folders: Sequence[Any]) -> Optional[str]:
    """Of a name in a file of robots: "package://robot/mesh.stl" in a folder called robot that one of `folders` holds, or
    the file itself lies within; others from the folder of the file, then from `folders`. Where folders are given, it
    lies in one of them or in that of the file, links followed. A text (file is None) without folders reads no file.
    None: it is not there."""
    near = [] if file is None else [os.path.dirname(os.path.abspath(file))]
    given = [os.path.abspath(os.fspath(folder)) for folder in folders]
    if name.startswith(("package://", "model://")):
        rest = name.split("://", 1)[1]
        above = list(near)
        while above and os.path.dirname(above[-1]) != above[-1]:
            above.append(os.path.dirname(above[-1]))
        places = [*given, *above]
    else:
        rest = name[len("file://") :] if name.startswith("file://") else name
        places = [*near, *given]
    if "\0" in rest:
        return None
    for path in (os.path.join(place, rest) for place in places):
        if os.path.isfile(path) and (not given or _is_within(path, [*given, *near])):
            return path
    return None


def _is_within(path: str, folders: Sequence[str]) -> bool:
    real = os.path.realpath(path)
    return any(os.path.commonpath([real, folder]) == folder for folder in (os.path.realpath(one) for one in folders))


# ---- masses


def _of_triangles(points: Sequence[float], triangles: Sequence[int]) -> Optional[Tuple[float, Triple, Triple, Turn]]:
    """By tetrahedra from the first point to each triangle (Blow and Binstock, "How to find the inertia tensor", 2004):
    of each its volume v times the sums of x, and of x y for each pair of axes, over its corners and their sum."""
    ox, oy, oz = points[:3]
    p = [(x - ox, y - oy, z - oz) for x, y, z in zip(points[::3], points[1::3], points[2::3])]
    volume = mx = my = mz = xx = yy = zz = xy = xz = yz = 0.0
    for i, j, k in zip(triangles[::3], triangles[1::3], triangles[2::3]):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = p[i], p[j], p[k]
        v = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        sx, sy, sz = ax + bx + cx, ay + by + cy, az + bz + cz
        volume, mx, my, mz = volume + v, mx + v * sx, my + v * sy, mz + v * sz
        xx += v * (sx * sx + ax * ax + bx * bx + cx * cx)
        yy += v * (sy * sy + ay * ay + by * by + cy * cy)
        zz += v * (sz * sz + az * az + bz * bz + cz * cz)
        xy += v * (sx * sy + ax * ay + bx * by + cx * cy)
        xz += v * (sx * sz + ax * az + bx * bz + cx * cz)
        yz += v * (sy * sz + ay * az + by * bz + cy * cz)
    if not abs(volume) > 0:
        return None
    m = (mx / (4 * volume), my / (4 * volume), mz / (4 * volume))
    second = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    spread = [[second[i][j] / (20 * volume) - m[i] * m[j] for j in range(3)] for i in range(3)]
    trace = sum(spread[i][i] for i in range(3))
    moments, turn = principal([[trace * (i == j) - spread[i][j] for j in range(3)] for i in range(3)])
    if not min(moments) > 0:
        return None
    return abs(volume) / 6, (m[0] + ox, m[1] + oy, m[2] + oz), moments, turn


def mass_of(points: Sequence[float], triangles: Sequence[int]) -> Optional[Tuple[float, Triple, Triple, Turn]]:
    """Volume, centre, moments for a mass of 1 kg, and their axes: of closed triangles, else of the hull. None: flat."""
    if triangles:
        return _of_triangles(points, triangles)
    with Store() as store:
        try:
            info = store.create_hull(_rows(points), max_vertices=MOST_HULL_VERTICES).info
        except DegenerateError:
            return None
    moments = tuple(x / info.volume for x in info.inertia)
    return info.volume, tuple(info.centre), moments, tuple(info.inertia_rotation)  # type: ignore[return-value]


def _rows(points: Sequence[float]) -> List[Sequence[float]]:
    return [points[k : k + 3] for k in range(0, len(points), 3)]


# ---- assets


def hull_of(store: Any, points: Sequence[float]) -> Hull:
    """What a dynamic body collides as, in a store or that of a world. What is thinner than a hull may be, a plate or a
    rod, gets LEAST_THICKNESS."""
    try:
        made: Hull = store.create_hull(_rows(points), max_vertices=MOST_HULL_VERTICES)
    except DegenerateError:
        made = store.create_hull(_rows(_thickened(points)), max_vertices=MOST_HULL_VERTICES)
    return made


def _thickened(points: Sequence[float]) -> List[float]:
    """Along each principal axis of the points along which they are thin, each twice: half LEAST_THICKNESS to both sides."""
    rows = _rows(points)
    middle = [sum(p[k] for p in rows) / len(rows) for k in range(3)]
    spread = [[sum((p[i] - middle[i]) * (p[j] - middle[j]) for p in rows) for j in range(3)] for i in range(3)]
    _, turn = principal(spread)
    for axis in (rotate(turn, [float(i == k) for i in range(3)]) for k in range(3)):
        along = [sum(a * b for a, b in zip(axis, p)) for p in rows]
        if max(along) - min(along) < LEAST_THICKNESS:
            half = 0.5 * LEAST_THICKNESS
            rows = [[x + s * a for x, a in zip(p, axis)] for p in rows for s in (-half, half)]
    return [x for p in rows for x in p]


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
