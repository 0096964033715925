"""The forms of MJCF: their classes of defaults, frames, sizes and masses. mjcf.py makes bodies of them."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Set, Tuple

from .errors import FeatherError, SceneError
from .frames import NO_TURN, ORIGIN, Y_TO_Z, Frame, Triple, Turn, about, from_z, inside, multiply, normalized, of_axes
from .mjcf_save import LETTERS, WORLD
from .robot_mass import DENSITY, Geom, volume_of
from .robot_mesh import ELLIPSOID_POINTS, Triangles, ellipsoid, find_file, mass_of, read_mesh, scaled
from .robot_xml import Element, Reader, row
from .scene import LEAST_LENGTH, Scene
from .scene_records import SceneMesh, SceneShape

GRAVITY: Triple = (0.0, 0.0, -9.81)
DEFAULTS = {"geom", "mesh", "joint", "motor", "position", "velocity"}
FORMS = ("sphere", "capsule", "cylinder", "box", "ellipsoid", "plane", "mesh", "hfield", "sdf")
# solver settings of MuJoCo's own soft constraints, which no scene has
SOFT = (
    "solref",
    "solimp",
    "solreflimit",
    "solimplimit",
    "solreffriction",
    "solimpfriction",
    "margin",
    "gap",
    "priority",
)
# of <compiler>: what no scene has a place for
LEFT_OUT = ("alignfree", "exactmeshinertia")
TRUTH = ("true", "false")


@dataclass
class Compiler:
    """How a file writes angles and places, and where masses come from."""

    degrees: bool = True
    sequence: str = "xyz"
    is_global: bool = False  # every place and turn is the world's
    inertia_from_geom: str = "auto"
    groups: Tuple[float, float] = (0.0, math.inf)  # of geoms that have mass
    least_mass: float = 0.0
    least_inertia: float = 0.0
    total_mass: float = 0.0  # 0: as it comes
    balance: bool = False
    auto_limits: bool = True
    mesh_folder: str = ""
    strip_path: bool = False


@dataclass
class Model:
    """What the files of one model share: the scene, its names, where the bodies stand."""

    scene: Scene
    frames: Dict[str, Frame] = field(default_factory=lambda: {WORLD: Frame()})
    names: Dict[str, Set[str]] = field(
        default_factory=lambda: {"body": {WORLD}, "joint": set(), "actuator": set(), "mesh": set()}
    )
    told: Set[str] = field(default_factory=set)
    lost_mass: float = 0.0  # kg, of bodies that became parts of kinematic ones: the total has them
    files: int = 0


class GeomReader(Reader):
    """Reads the geoms of one file, whose names get a prefix and a suffix where another file attaches it."""

    def __init__(
        self, file: str, strict: bool, path: Optional[str], folders: Sequence[Any], model: Model, prefix: str, suffix: str
    ):
        super().__init__(file, strict, model.scene.warnings)
        self.path, self.folders, self.model, self.scene = path, folders, model, model.scene
        self.prefix, self.suffix, self.told = prefix, suffix, model.told
        self.assets: Dict[str, Element] = {}  # meshes; those that geoms have are read
        self.meshes: Dict[str, Optional[SceneMesh]] = {}  # None: it is not there
        self.masses: Dict[str, Any] = {}  # of meshes
        self.compiler = Compiler()
        self.classes: Dict[str, Dict[str, Dict[str, str]]] = {"main": {}}

    def full(self, name: str) -> str:
        """A name of this file, as the scene has it."""
        return f"{self.prefix}{name}{self.suffix}"

    def some_numbers(self, element: Element, name: str, least: int, most: int) -> List[float]:
        """An attribute of at least so many numbers."""
        count = len(self.need(element, name).split(None, most))
        return self.numbers(element, name, min(max(count, least), most))

    # ---- settings

    def read_compiler(self, element: Element) -> None:
        """How the file is to be read."""
        had, given = self.compiler, element.attributes

        def is_true(name: str, had: bool) -> bool:
            return self.choice(element, name, TRUTH, "true" if had else "false") == "true"

        had.is_global = self.choice(element, "coordinate", ("local", "global"), "local") == "global" or had.is_global
        had.degrees = self.choice(element, "angle", ("degree", "radian"), "degree" if had.degrees else "radian") == "degree"
        had.sequence = given.get("eulerseq", had.sequence)
        if len(had.sequence) != 3 or set(had.sequence.lower()) - set(LETTERS):
            raise self.fail(element, f"eulerseq: three of x, y, z, X, Y, Z are needed, not {had.sequence[:60]!r}")
        had.inertia_from_geom = self.choice(element, "inertiafromgeom", (*TRUTH, "auto"), had.inertia_from_geom)
        had.mesh_folder = given.get("meshdir", given.get("assetdir", had.mesh_folder))
        had.strip_path, had.auto_limits = is_true("strippath", had.strip_path), is_true("autolimits", had.auto_limits)
        had.balance = is_true("balanceinertia", had.balance)
        least, most = self.numbers(element, "inertiagrouprange", 2, had.groups)
        had.groups = least, most
        had.least_mass = self.number(element, "boundmass", had.least_mass)
        had.least_inertia = self.number(element, "boundinertia", had.least_inertia)
        had.total_mass = self.number(element, "settotalmass", had.total_mass)
        for name in LEFT_OUT:
            if given.get(name, "false") != "false":
                self.warn(element, "attribute", f"{name} is left out")

    def read_default(self, element: Element, parent: Optional[str]) -> None:
        """A class and those within it."""
        name = element.attributes.get("class", "main" if parent is None else "")
        if not name:
            raise self.fail(element, "class is missing")
        kinds = self.classes.setdefault(name, {})
        for kind, values in self.classes[parent].items() if parent is not None and parent != name else ():
            kinds[kind] = {**values, **kinds.get(kind, {})}
        for child in element.children:
            if child.tag in DEFAULTS:
                kinds.setdefault(child.tag, {}).update(child.attributes)
        for child in element.children:
            if child.tag == "default":
                self.read_default(child, name)

    def with_defaults(self, element: Element, child_class: Optional[str]) -> Element:
        """With the attributes of its class."""
        name = element.attributes.get("class", child_class or "main")
        if name not in self.classes:
            raise self.fail(element, f"there is no class {name[:60]!r}")
        own = {**self.classes[name].get(element.tag, {}), **element.attributes}
        made = Element(element.tag, own, element.line, element.file)
        for soft in SOFT:
            if soft in own:
                self.tell_once(element, "attribute", f"{soft} is left out")
        return made

    # ---- frames

    def angle(self, value: float) -> float:
        """In rad."""
        return math.radians(value) if self.compiler.degrees else value

    def turn(self, element: Element) -> Turn:
        """Its rotation, in one of five ways."""
        found = [name for name in ("quat", "axisangle", "xyaxes", "zaxis", "euler") if name in element.attributes]
        if not found:
            return NO_TURN
        if len(found) > 1:
            raise self.fail(element, f"one rotation is needed, not {' and '.join(found)}")
        if found[0] == "euler":
            return self.euler(self.numbers(element, "euler", 3))
        v = self.numbers(element, found[0], {"quat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3}[found[0]])
        directions = {"quat": [v], "axisangle": [v[:3]], "xyaxes": [v[:3], v[3:]], "zaxis": [v]}[found[0]]
        if not all(math.hypot(*direction) > 1e-9 for direction in directions):
            raise self.fail(element, f"{found[0]}: a direction is needed")
        if found[0] == "quat":
            w, x, y, z = normalized(v)
            return x, y, z, w
        if found[0] == "axisangle":
            return about(v[:3], self.angle(v[3]))
        if found[0] == "zaxis":
            return from_z(v)
        try:
            return of_axes(v[:3], v[3:])
        except ZeroDivisionError:
            raise self.fail(element, "xyaxes: two directions are needed") from None

    def euler(self, angles: Sequence[float]) -> Turn:
        """Small letters are axes that turn along, capital ones stand."""
        turn = NO_TURN
        for letter, angle in zip(self.compiler.sequence, angles):
            one = about([float(letter.lower() == other) for other in LETTERS], self.angle(angle))
            turn = multiply(turn, one) if letter.islower() else multiply(one, turn)
        return turn

    def pose(self, element: Element) -> Frame:
        """Its frame in that of its parent."""
        x, y, z = self.numbers(element, "pos", 3, ORIGIN)
        return Frame((x, y, z), self.turn(element))

    # ---- geoms

    def geom(self, element: Element, at: Frame, is_weighed: bool) -> Optional[Geom]:
        """A form, in the frame of the body. What meets nothing and is not weighed does not count."""
        kind = self.choice(element, "type", FORMS, "mesh" if "mesh" in element.attributes else "sphere")
        types = [self.number(element, name, 1) for name in ("contype", "conaffinity")]
        group = self.number(element, "group", 0.0)
        is_weighed = is_weighed and self.compiler.groups[0] <= group <= self.compiler.groups[1]
        if not is_weighed and not any(types):
            return None
        if types != [1, 1] and any(types):
            self.tell_once(element, "attribute", "contype and conaffinity count only where both are 0")
        density = self.number(element, "density", DENSITY)
        if density < 0 or self.number(element, "mass", 0.0) < 0:
            raise self.fail(element, "mass and density are not negative")
        if kind == "mesh":
            return self.mesh_geom(element, at, is_weighed, any(types))
        if "mesh" in element.attributes or kind in ("hfield", "sdf"):
            what = "a form that is fitted to a mesh" if "mesh" in element.attributes else kind
            self.tell_once(element, "element", f"{what} is left out, and its mass")
            return None
        frame, size = self.placed(element, kind)
        frame = at.then(frame)
        volume, shares = volume_of(kind, size)
        mass = self.number(element, "mass", density * volume) if is_weighed else 0.0
        moments = (mass * shares[0], mass * shares[1], mass * shares[2])
        return Geom(self.shape(element, kind, size, frame) if any(types) else None, mass, moments, frame)

    def mesh_geom(self, element: Element, at: Frame, is_weighed: bool, collides: bool) -> Optional[Geom]:
        """A mesh, whose mass is that of what its triangles enclose."""
        mesh = self.mesh(element)
        if mesh is None:
            return None
        frame = at.then(self.pose(element))
        shape = self.shape(element, "mesh", [], frame) if collides else None
        if shape is not None:
            shape.mesh = mesh.name
        if not is_weighed:
            return Geom(shape, 0.0, ORIGIN, frame)
        if mesh.name not in self.masses:
            try:
                self.masses[mesh.name] = mass_of(mesh.points, mesh.triangles)
            except FeatherError as error:
                raise self.fail(element, f"mesh {mesh.name!r}: {error}") from None
        if self.masses[mesh.name] is None:
            raise self.fail(element, f"mesh {mesh.name!r} encloses nothing")
        volume, centre, shares, axes = self.masses[mesh.name]
        mass = self.number(element, "mass", self.number(element, "density", DENSITY) * volume)
        moments = (mass * shares[0], mass * shares[1], mass * shares[2])
        return Geom(shape, mass, moments, frame.then(Frame(centre, axes)))

    def mesh(self, element: Element) -> Optional[SceneMesh]:
        """That of a geom, read when the first one has it."""
        name = self.need(element, "mesh")
        if name not in self.meshes:
            if name not in self.assets:
                raise self.fail(element, f"there is no mesh {name[:60]!r}")
            self.meshes[name] = self.read_asset(name, self.assets[name])
        return self.meshes[name]

    def read_asset(self, name: str, asset: Element) -> Optional[SceneMesh]:
        """A <mesh> of <asset>; None: it is not there."""
        if "file" in asset.attributes:
            plain = asset.attributes["file"]
            plain = os.path.basename(plain) if self.compiler.strip_path else plain
            file = find_file(os.path.join(self.compiler.mesh_folder, plain), self.path, self.folders)
            if file is None:
                self.warn(asset, "mesh", f"there is no file {plain[:60]!r}: it is left out, and its mass")
                return None
            try:
                points, triangles = read_mesh(file, self.numbers(asset, "scale", 3, (1, 1, 1)))
            except SceneError as error:
                self.warn(asset, "mesh", f"{error}: it is left out, and its mass")
                return None
        elif "vertex" in asset.attributes:
            points, triangles = self.own_triangles(asset)
        elif "builtin" in asset.attributes:
            self.warn(asset, "mesh", "a built-in mesh is left out, and its mass")
            return None
        else:
            raise self.fail(asset, "file or vertex is needed")
        at = self.reference(asset)
        if at != Frame():
            rows = (inside(at, Frame((points[k], points[k + 1], points[k + 2]))) for k in range(0, len(points), 3))
            points = [number for each in rows for number in each.position]
        made = SceneMesh(self.full(name), points, triangles)
        if made.name in self.model.names["mesh"]:
            raise self.fail(asset, f"a second mesh has the name {made.name[:60]!r}")
        self.model.names["mesh"].add(made.name)
        self.scene.meshes.append(made)
        return made

    def own_triangles(self, asset: Element) -> Triangles:
        """Those that the file itself has."""
        count = len(self.need(asset, "vertex").split())
        points = self.numbers(asset, "vertex", count)
        corners = self.numbers(asset, "face", len(asset.attributes.get("face", "").split()), ())
        places = range(len(points) // 3)
        if count < 12 or count % 3 or len(corners) % 3 or not all(corner in places for corner in corners):
            raise self.fail(asset, "vertex and face: three numbers each are needed, of four points at least")
        where = f"{asset.file or self.file}:{asset.line}"
        return scaled(points, [int(corner) for corner in corners], self.numbers(asset, "scale", 3, (1, 1, 1)), where)

    def reference(self, asset: Element) -> Frame:
        """Where a mesh's own frame is among its points."""
        x, y, z = self.numbers(asset, "refpos", 3, ORIGIN)
        turn = self.numbers(asset, "refquat", 4, (1, 0, 0, 0))
        if math.hypot(*turn) < 1e-9:
            raise self.fail(asset, "refquat: a direction is needed")
        w, qx, qy, qz = normalized(turn)
        return Frame((x, y, z), (qx, qy, qz, w))

    def placed(self, element: Element, kind: str) -> Tuple[Frame, List[float]]:
        """Where it is, and its sizes; along z."""
        count = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3, "plane": 0}[kind]
        if kind == "plane":
            return self.pose(element), []
        if "fromto" not in element.attributes:
            size = self.some_numbers(element, "size", count, 3)[:count]
            frame = self.pose(element)
        else:
            if count < 2:
                raise self.fail(element, f"fromto: not of a {kind}")
            ends = self.numbers(element, "fromto", 6)
            way = [b - a for a, b in zip(ends[:3], ends[3:])]
            if math.hypot(*way) < 1e-9:
                raise self.fail(element, "fromto: two places are needed")
            across = self.some_numbers(element, "size", 1, 3)[0]
            size = [across] * (count - 1) + [math.hypot(*way) / 2]
            middle = [(a + b) / 2 for a, b in zip(ends[:3], ends[3:])]
            frame = Frame((middle[0], middle[1], middle[2]), from_z([-x for x in way]))  # as MuJoCo turns it
        if min(size) <= 0:
            raise self.fail(element, "size: more than 0 is needed")
        if min(size) < LEAST_LENGTH:
            self.tell_once(element, "size", f"collides as if no half of it were under {LEAST_LENGTH} m")
        return frame, size

    def shape(self, element: Element, kind: str, size: List[float], frame: Frame) -> SceneShape:
        """What it collides with."""
        friction = self.some_numbers(element, "friction", 1, 3)[0] if "friction" in element.attributes else 1.0
        if friction < 0:
            raise self.fail(element, "friction is not negative")
        density = self.number(element, "density", DENSITY)
        made = SceneShape(kind, size, frame.position, frame.rotation, density if density > 0 else DENSITY, friction)
        if kind == "ellipsoid":
            self.tell_once(element, "hull", f"ellipsoids collide as hulls of {ELLIPSOID_POINTS} points")
            made.form, made.size, made.mesh = "mesh", [], f"ellipsoid {row(size)}"
            if made.mesh not in self.model.names["mesh"]:
                self.model.names["mesh"].add(made.mesh)
                self.scene.meshes.append(SceneMesh(made.mesh, ellipsoid(size)))
        if kind in ("capsule", "cylinder"):
            made.size = [size[1], size[0]]
        if kind in ("capsule", "cylinder", "plane"):
            made.rotation = frame.then(Frame(ORIGIN, Y_TO_Z)).rotation
        return made
