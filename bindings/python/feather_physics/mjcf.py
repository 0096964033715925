"""MJCF, the format of MuJoCo for models (https://mujoco.readthedocs.io/en/stable/XMLreference.html), read into a Scene
and written from one."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Optional, Sequence, Set, Tuple

from .errors import FeatherError, InvalidArgumentError, UnsupportedError
from .frames import (
    NO_TURN,
    ORIGIN,
    Y_TO_Z,
    Frame,
    Triple,
    Turn,
    about,
    cross,
    from_z,
    inside,
    multiply,
    normalized,
    of_axes,
    principal,
    rotate,
)
from .mjcf_geom import Geom, combine, volume_of
from .mjcf_save import LETTERS, WORLD
from .mjcf_save import save_mjcf as save_mjcf  # with load_mjcf, as in urdf
from .robot_mesh import ELLIPSOID_POINTS, Triangles, ellipsoid, find_file, mass_of, read_mesh, scaled
from .robot_xml import Element, Reader, parse, read_source, row
from .scene import Scene, SceneActuator, SceneBody, SceneFreedom, SceneJoint, SceneMesh, SceneShape

GRAVITY: Triple = (0.0, 0.0, -9.81)
DENSITY = 1000.0  # kg/m3, where a file gives none
MOST_INCLUDED = 100
# what says nothing about motion
SILENT = {"visual", "statistic", "size", "custom", "sensor", "site", "camera", "light"}
UNSUPPORTED = {"composite", "replicate", "attach"}
LOST = {"tendon", "keyframe", "pair", "plugin", "extension", "deformable", "skin", "flexcomp"}
DEFAULTS = {"geom", "mesh", "joint", "motor", "position", "velocity"}
ACTUATORS = {"motor", "position", "velocity"}
OTHER_ACTUATORS = {"general", "intvelocity", "damper", "cylinder", "muscle", "adhesion"}
FIELDS = {
    "mujoco": {"compiler", "option", "default", "asset", "worldbody", "contact", "equality", "actuator", "include"}
    | SILENT
    | LOST,
    "worldbody": {"body", "geom", "frame"} | SILENT,
    "body": {"inertial", "joint", "freejoint", "geom", "body", "frame"} | SILENT | LOST,
    "frame": {"joint", "freejoint", "geom", "body", "frame"} | SILENT,
    "contact": {"exclude"} | LOST,
    "equality": {"connect", "weld", "joint", "tendon", "distance", "flex"},
    "actuator": ACTUATORS | OTHER_ACTUATORS | LOST,
}
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
JOINTS = {"hinge": "hinge", "slide": "slider", "ball": "ball", "free": "free"}


@dataclass
class Compiler:
    """How a file writes angles, and where masses come from."""

    degrees: bool = True
    sequence: str = "xyz"
    inertia_from_geom: str = "auto"
    auto_limits: bool = True
    mesh_folder: str = ""
    strip_path: bool = False


@dataclass
class Place:
    """Whose children are read: the body (None: the world's own), its frame, and the class of those that name none."""

    parent: Optional[SceneBody]
    frame: Frame = field(default_factory=Frame)
    child_class: Optional[str] = None


class MjcfReader(Reader):
    """Reads one file."""

    FIELDS, LOST = FIELDS, LOST

    def __init__(self, file: str, strict: bool, path: Optional[str], folders: Sequence[Any]):
        super().__init__(file, strict)
        self.path, self.folders = path, folders
        self.meshes: Dict[str, Element] = {}  # of <asset>; those that geoms have are read
        self.compiler = Compiler()
        self.classes: Dict[str, Dict[str, Dict[str, str]]] = {"main": {}}
        self.scene = Scene(gravity=GRAVITY, warnings=self.warnings)
        self.frames: Dict[str, Frame] = {WORLD: Frame()}
        self.names: Dict[str, Set[str]] = {"body": {WORLD}, "joint": set(), "actuator": set()}
        self.lines: Dict[str, Element] = {}
        self.told: Set[str] = set()
        self.lacking: Set[str] = set()  # meshes

    def tell_once(self, element: Element, text: str) -> None:
        """What many elements have."""
        if text not in self.told:
            self.told.add(text)
            self.warn(element, text)

    def name(self, element: Element, kind: str, usual: str) -> str:
        """Its name, which is the only one of its kind."""
        name = element.attributes.get("name", usual)
        if name in self.names[kind]:
            raise self.fail(element, f"a second {kind} has the name {name!r}")
        self.names[kind].add(name)
        return name

    def choice(self, element: Element, name: str, choices: Sequence[str], usual: str) -> str:
        """One of several words."""
        found = element.attributes.get(name, usual)
        if found not in choices:
            raise self.fail(element, f"{name}: one of {', '.join(choices)} is needed, not {found!r}")
        return found

    def some_numbers(self, element: Element, name: str, least: int, most: int) -> List[float]:
        """An attribute of at least so many numbers."""
        count = len(self.need(element, name).split())
        return self.numbers(element, name, min(max(count, least), most))

    # ---- settings

    def include(self, root: Element, folder: Optional[str]) -> None:
        """The files that <include> names take its place."""
        waiting, count = [root], 0
        while waiting:
            element = waiting.pop()
            for i in reversed([i for i, child in enumerate(element.children) if child.tag == "include"]):
                child = element.children[i]
                count += 1
                if folder is None or count > MOST_INCLUDED:
                    raise self.fail(
                        child, "a text includes no files" if folder is None else f"{MOST_INCLUDED} files are the most"
                    )
                file = os.path.join(folder, self.need(child, "file"))
                if not os.path.isfile(file):
                    raise self.fail(child, f"there is no file {file!r}")
                text, _ = read_source(os.fspath(file), "")
                element.children[i : i + 1] = parse(text, file).children
                waiting.append(element)
            waiting += element.children

    def settings(self, root: Element) -> None:
        """<compiler>, <default>, <option>."""
        for element in root.children:
            if element.tag == "compiler":
                self.read_compiler(element)
            elif element.tag == "default":
                self.read_default(element, None)
            elif element.tag == "option" and "gravity" in element.attributes:
                x, y, z = self.numbers(element, "gravity", 3)
                self.scene.gravity = (x, y, z)

    def read_compiler(self, element: Element) -> None:
        """How the file is to be read."""
        had, truth = self.compiler, ("true", "false")
        if self.choice(element, "coordinate", ("local", "global"), "local") == "global":
            raise UnsupportedError(f"{self.file}:{element.line}: <compiler>: coordinates of the world are not read")
        had.degrees = (
            self.choice(element, "angle", ("degree", "radian"), "degree" if had.degrees else "radian") == "degree"
        )
        had.sequence = element.attributes.get("eulerseq", had.sequence)
        if len(had.sequence) != 3 or set(had.sequence.lower()) - set(LETTERS):
            raise self.fail(element, f"eulerseq: three of x, y, z, X, Y, Z are needed, not {had.sequence!r}")
        had.inertia_from_geom = self.choice(element, "inertiafromgeom", (*truth, "auto"), had.inertia_from_geom)
        had.mesh_folder = element.attributes.get("meshdir", element.attributes.get("assetdir", had.mesh_folder))
        had.strip_path = self.choice(element, "strippath", truth, "true" if had.strip_path else "false") == "true"
        had.auto_limits = self.choice(element, "autolimits", truth, "true" if had.auto_limits else "false") == "true"
        for name in ("boundmass", "boundinertia", "settotalmass", "balanceinertia", "inertiagrouprange", "fusestatic"):
            if element.attributes.get(name, "false") not in ("false", "0", "-1"):
                self.warn(element, f"{name} is left out")

    def read_default(self, element: Element, parent: Optional[str]) -> None:
        """A class and those within it."""
        name = element.attributes.get("class", "main" if parent is None else "")
        if not name:
            raise self.fail(element, "class is missing")
        kinds = self.classes.setdefault(name, {})
        for kind, values in self.classes[parent].items() if parent is not None else ():
            kinds.setdefault(kind, {}).update(values)
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
            raise self.fail(element, f"there is no class {name!r}")
        made = Element(element.tag, {**self.classes[name].get(element.tag, {}), **element.attributes}, element.line)
        for soft in SOFT:
            if soft in made.attributes:
                self.tell_once(element, f"{soft} is left out")
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

    def geom(self, element: Element, at: Frame) -> Optional[Geom]:
        """A form, in the frame of the body."""
        kinds = ("sphere", "capsule", "cylinder", "box", "ellipsoid", "plane", "mesh", "hfield", "sdf")
        kind = self.choice(element, "type", kinds, "sphere")
        if kind == "mesh":
            return self.mesh_geom(element, at)
        if "mesh" in element.attributes or kind in ("hfield", "sdf"):
            what = "forms that are fitted to a mesh" if "mesh" in element.attributes else f"{kind}s"
            self.warn(element, f"{what} are left out, and their mass")
            return None
        frame, size = self.placed(element, kind)
        frame = at.then(frame)
        density = self.number(element, "density", DENSITY)
        volume, shares = volume_of(kind, size)
        mass = self.number(element, "mass", density * volume)
        if mass < 0 or density < 0:
            raise self.fail(element, "mass and density are not negative")
        moments = tuple(mass * share for share in shares)
        return Geom(self.shape(element, kind, size, frame, density), mass, moments, frame)  # type: ignore[arg-type]

    def mesh_geom(self, element: Element, at: Frame) -> Optional[Geom]:
        """A mesh, whose mass is that of what its triangles enclose."""
        mesh = self.mesh(element)
        if mesh is None:
            return None
        frame, density = at.then(self.pose(element)), self.number(element, "density", DENSITY)
        try:
            found = mass_of(mesh.points, mesh.triangles)
        except FeatherError as error:
            raise self.fail(element, f"mesh {mesh.name!r}: {error}") from None
        if found is None:
            raise self.fail(element, f"mesh {mesh.name!r} encloses nothing")
        volume, centre, shares, axes = found
        mass = self.number(element, "mass", density * volume)
        if mass < 0 or density < 0:
            raise self.fail(element, "mass and density are not negative")
        shape = self.shape(element, "mesh", [], frame, density)
        if shape is not None:
            shape.mesh = mesh.name
        moments = (mass * shares[0], mass * shares[1], mass * shares[2])
        return Geom(shape, mass, moments, frame.then(Frame(centre, axes)))

    def mesh(self, element: Element) -> Optional[SceneMesh]:
        """That of a geom, read when the first one has it."""
        name = self.need(element, "mesh")
        known = next((mesh for mesh in self.scene.meshes if mesh.name == name), None)
        if known is not None or name in self.lacking:
            return known
        if name not in self.meshes:
            raise self.fail(element, f"there is no mesh {name!r}")
        asset = self.meshes[name]
        try:
            points, triangles = self.triangles(asset)
        except (UnsupportedError, FileNotFoundError) as error:
            self.warn(asset, f"{error}: it is left out, and its mass")
            self.lacking.add(name)
            return None
        at = self.reference(asset)
        if at != Frame():
            rows = (inside(at, Frame((points[k], points[k + 1], points[k + 2]))) for k in range(0, len(points), 3))
            points = [number for each in rows for number in each.position]
        made = SceneMesh(name, points, triangles)
        self.scene.meshes.append(made)
        return made

    def reference(self, asset: Element) -> Frame:
        """Where a mesh's own frame is among its points."""
        x, y, z = self.numbers(asset, "refpos", 3, ORIGIN)
        turn = self.numbers(asset, "refquat", 4, (1, 0, 0, 0))
        if math.hypot(*turn) < 1e-9:
            raise self.fail(asset, "refquat: a direction is needed")
        w, qx, qy, qz = normalized(turn)
        return Frame((x, y, z), (qx, qy, qz, w))

    def triangles(self, asset: Element) -> Triangles:
        """Of a <mesh> of <asset>."""
        scale = self.numbers(asset, "scale", 3, (1, 1, 1))
        if "file" not in asset.attributes:
            count = len(self.need(asset, "vertex").split())
            points = self.numbers(asset, "vertex", count)
            corners = self.numbers(asset, "face", len(asset.attributes.get("face", "").split()), ())
            places = range(len(points) // 3)
            if count < 12 or count % 3 or len(corners) % 3 or not all(corner in places for corner in corners):
                raise self.fail(asset, "vertex and face: three numbers each are needed, of four points at least")
            return scaled(points, [int(corner) for corner in corners], scale, f"{self.file}:{asset.line}")
        name = asset.attributes["file"]
        name = os.path.basename(name) if self.compiler.strip_path else name
        file = find_file(os.path.join(self.compiler.mesh_folder, name), self.path, self.folders)
        if file is None:
            raise FileNotFoundError(f"there is no file {name!r}")
        return read_mesh(file, scale)

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
            frame = Frame((middle[0], middle[1], middle[2]), from_z(way))
        if min(size) <= 0:
            raise self.fail(element, "size: more than 0 is needed")
        return frame, size

    def shape(
        self, element: Element, kind: str, size: List[float], frame: Frame, density: float
    ) -> Optional[SceneShape]:
        """What it collides with."""
        types = [self.number(element, name, 1) for name in ("contype", "conaffinity")]
        if types != [1, 1] and any(types):
            self.tell_once(element, "contype and conaffinity count only where both are 0")
        if not any(types):
            return None
        friction = self.some_numbers(element, "friction", 1, 3)[0] if "friction" in element.attributes else 1.0
        if friction < 0:
            raise self.fail(element, "friction is not negative")
        made = SceneShape(kind, size, frame.position, frame.rotation, density if density > 0 else DENSITY, friction)
        if kind == "ellipsoid":
            self.tell_once(element, f"ellipsoids collide as hulls of {ELLIPSOID_POINTS} points")
            made.form, made.size, made.mesh = "mesh", [], f"ellipsoid {row(size)}"
            if made.mesh not in {mesh.name for mesh in self.scene.meshes}:
                self.scene.meshes.append(SceneMesh(made.mesh, ellipsoid(size)))
        if kind in ("capsule", "cylinder"):
            made.size = [size[1], size[0]]
        if kind in ("capsule", "cylinder", "plane"):
            made.rotation = frame.then(Frame(ORIGIN, Y_TO_Z)).rotation
        return made

    def inertial(self, element: Element) -> Tuple[float, Frame, Triple]:
        """Mass, centre and principal axes, moments."""
        mass, frame = self.positive(element, "mass"), self.pose(element)
        if "fullinertia" in element.attributes:
            xx, yy, zz, xy, xz, yz = self.numbers(element, "fullinertia", 6)
            moments, turn = principal([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            frame = frame.then(Frame(ORIGIN, turn))
        else:
            x, y, z = self.numbers(element, "diaginertia", 3)
            moments = (x, y, z)
        if min(moments) <= 0 or 2 * max(moments) > sum(moments) * (1 + 1e-6):
            raise self.fail(
                element, f"no body has the moments {moments}: each is above 0, none above the sum of the others"
            )
        return mass, frame, moments

    # ---- joints

    def limits(self, element: Element, factor: float) -> Tuple[Optional[float], Optional[float]]:
        """Its range, times a factor, as seen from where it stands."""
        limited = self.choice(element, "limited", ("true", "false", "auto"), "auto")
        if limited == "false" or (
            limited == "auto" and not (self.compiler.auto_limits and "range" in element.attributes)
        ):
            return None, None
        lower, upper = self.numbers(element, "range", 2)
        if lower > upper:
            raise self.fail(element, f"range: {lower} is above {upper}")
        stands = self.number(element, "ref", 0.0)
        return (lower - stands) * factor, (upper - stands) * factor

    def moving(self, element: Element, name: str, axis: str, sign: float) -> SceneFreedom:
        """What a hinge or a slide does about or along an axis, or the other way round (sign -1)."""
        is_hinge = axis.startswith("angular")
        factor = sign * (self.angle(1.0) if is_hinge else 1.0)
        lower, upper = self.limits(element, factor)
        if lower is not None and upper is not None:
            lower, upper = min(lower, upper), max(lower, upper)
        if is_hinge and lower is not None and upper is not None and max(-lower, upper) > math.pi:
            self.warn(element, "beyond half a turn: the joint has no limits")
            lower = upper = None
        made = SceneFreedom(name, axis, lower, upper)
        made.damping, made.friction = self.number(element, "damping", 0.0), self.number(element, "frictionloss", 0.0)
        made.stiffness, made.armature = self.number(element, "stiffness", 0.0), self.number(element, "armature", 0.0)
        if min(made.damping, made.friction, made.stiffness, made.armature) < 0:
            raise self.fail(element, "damping, frictionloss, stiffness and armature are not negative")
        made.rest = (self.number(element, "springref", 0.0) - self.number(element, "ref", 0.0)) * factor
        if made.armature > 0:
            told = "counts as inertia of the body about the axis" if is_hinge else "of a slide is left out"
            self.tell_once(element, f"armature {told}")
        return made

    def direction(self, element: Element) -> Triple:
        """Its axis in the frame of the body."""
        axis = self.numbers(element, "axis", 3, (0, 0, 1))
        if math.hypot(*axis) < 1e-9:
            raise self.fail(element, "axis: a direction is needed")
        return normalized(axis)  # type: ignore[return-value]

    def joint(self, elements: List[Tuple[Element, Frame]], body: SceneBody, parent: Optional[str]) -> SceneJoint:
        """What a body hangs on."""
        kinds = ["free" if e.tag == "freejoint" else self.choice(e, "type", list(JOINTS), "hinge") for e, _ in elements]
        names = [self.name(e, "joint", f"{body.name}_joint{i or ''}") for i, (e, _) in enumerate(elements)]
        first, at = elements[0]
        frame = Frame(body.position, body.rotation)
        x, y, z = self.numbers(first, "pos", 3, ORIGIN)
        place = frame.then(at.then(Frame((x, y, z)))).position
        made = SceneJoint(names[0], JOINTS[kinds[0]], parent, body.name, place)
        if "free" in kinds:
            if len(kinds) > 1 or parent is not None:
                raise self.fail(first, "a free joint is the only one of a body of the world")
            made.position = body.position
            return made
        if "ball" in kinds:
            if len(kinds) > 1:
                raise UnsupportedError(f"{self.file}:{first.line}: <{first.tag}>: a ball and other joints on one body")
            return self.ball(first, made)
        axes = [rotate(frame.then(at).rotation, self.direction(element)) for element, at in elements]
        if len(kinds) > 1:
            return self.configurable(elements, kinds, names, axes, frame, made)
        made.axis = axes[0]
        one = self.moving(first, names[0], "linear_x" if kinds[0] == "slide" else "angular_x", 1.0)
        for name in ("lower", "upper", "damping", "friction", "stiffness", "rest", "armature"):
            setattr(made, name, getattr(one, name))
        return made

    def ball(self, element: Element, made: SceneJoint) -> SceneJoint:
        """A ball; its range is the angle to the rest position."""
        one = self.moving(
            Element(element.tag, {**element.attributes, "limited": "false"}, element.line), "", "angular_x", 1.0
        )
        made.damping, made.friction, made.stiffness = one.damping, one.friction, one.stiffness
        _, upper = self.limits(element, self.angle(1.0))
        if upper is not None:
            self.warn(element, "the range of a ball is taken as a cone about its axis")
            if not 0.01 <= upper <= math.pi:
                raise self.fail(element, f"range: 0.01 to pi is needed, not {upper}")
            made.cone = upper
        return made

    def configurable(
        self,
        elements: List[Tuple[Element, Frame]],
        kinds: List[str],
        names: List[str],
        axes: List[Triple],
        frame: Frame,
        made: SceneJoint,
    ) -> SceneJoint:
        """Several joints on a body, as one: along axes that are square to one another."""
        turn, letters = self.letters(elements[0][0], axes)
        made.type, made.rotation = "configurable", turn
        for (element, at), kind, name, (letter, sign) in zip(elements, kinds, names, letters):
            axis = f"{'linear' if kind == 'slide' else 'angular'}_{letter}"
            if any(axis == other.axis for other in made.freedoms):
                raise UnsupportedError(f"{self.file}:{element.line}: <{element.tag}>: a second joint about one axis")
            made.freedoms.append(self.moving(element, name, axis, sign))
            x, y, z = self.numbers(element, "pos", 3, ORIGIN)
            apart = math.dist(made.position, frame.then(at.then(Frame((x, y, z)))).position)
            if kind == "hinge" and apart > 1e-9:
                self.warn(element, f"its axis is moved by {apart:.3g} m, to that of {names[0]!r}")
        if sum(kind == "hinge" for kind in kinds) > 1:
            self.tell_once(
                elements[0][0], "several hinges of a body are one joint: their angles are those of its frame"
            )
        return made

    def letters(self, element: Element, axes: List[Triple]) -> Tuple[Turn, List[Tuple[str, float]]]:
        """A frame whose axes, or their opposites, the given ones are, and which."""
        known: List[Triple] = []
        found: List[Tuple[str, float]] = []
        for axis in axes:
            along = [sum(a * b for a, b in zip(axis, other)) for other in known]
            match = next((i for i, cosine in enumerate(along) if abs(cosine) > 1 - 1e-6), None)
            if match is None:
                if any(abs(cosine) > 1e-3 for cosine in along):
                    raise UnsupportedError(
                        f"{self.file}:{element.line}: <{element.tag}>: joints of a body that are askew"
                    )
                match, along = len(known), [*along, 1.0]
                known.append(axis)
                if len(known) == 2:
                    known.append(cross(known[0], axis))  # the third is known then
                    match = 1
            found.append((LETTERS[match], math.copysign(1.0, along[match])))
        second = known[1] if len(known) > 1 else rotate(from_z(known[0]), (1.0, 0.0, 0.0))
        return of_axes(known[0], second), found

    # ---- bodies

    def parts(
        self, element: Element, at: Frame, child_class: Optional[str]
    ) -> Iterator[Tuple[Element, Frame, Optional[str]]]:
        """The children of a body, those in its <frame>s too, with their frame and class."""
        for child in element.children:
            if child.tag in UNSUPPORTED:
                raise UnsupportedError(f"{self.file}:{child.line}: <{child.tag}>: is not read")
        self.known(element)
        for child in element.children:
            if child.tag == "frame":
                yield from self.parts(child, at.then(self.pose(child)), child.attributes.get("childclass", child_class))
            elif child.tag not in SILENT | LOST:
                yield child, at, child_class

    def body(self, element: Element, at: Frame, place: Place) -> None:
        """A body and those that hang on it."""
        child_class = element.attributes.get("childclass", place.child_class)
        frame = place.frame.then(at).then(self.pose(element))
        body = SceneBody(
            self.name(element, "body", f"body{len(self.names['body'])}"), "static", frame.position, frame.rotation
        )
        self.lines[body.name] = element
        joints, geoms, within = [], [], []
        inertial = None
        for child, inner, inner_class in self.parts(element, Frame(), child_class):
            if child.tag == "geom":
                geoms.append(self.geom(self.with_defaults(child, inner_class), inner))
            elif child.tag in ("joint", "freejoint"):
                joints.append((self.with_defaults(child, inner_class) if child.tag == "joint" else child, inner))
            elif child.tag == "inertial":
                inertial = child
            else:
                within.append((child, inner, inner_class))
        if joints or (place.parent is not None and place.parent.type == "dynamic"):
            body.type = "dynamic"
        self.weigh(body, inertial, [geom for geom in geoms if geom])
        parent = None if place.parent is None or place.parent.name == WORLD else place.parent.name
        own = self.placed_body(element, body, joints, place.parent, parent)
        for child, inner, inner_class in within:
            self.body(child, inner, Place(own, frame, inner_class))

    def placed_body(
        self,
        element: Element,
        body: SceneBody,
        joints: List[Tuple[Element, Frame]],
        holder: Optional[SceneBody],
        parent: Optional[str],
    ) -> Optional[SceneBody]:
        """The body in the scene with its joint, or that which it is a part of."""
        if body.type == "dynamic" and body.mass is None:
            if joints or holder is None:
                raise self.fail(element, f"{body.name!r} moves and has no mass")
            to = inside(Frame(holder.position, holder.rotation), Frame(body.position, body.rotation))
            for shape in body.shapes:  # massless: a part of what it is fixed to
                frame = to.then(Frame(shape.position, shape.rotation))
                shape.position, shape.rotation = frame.position, frame.rotation
                holder.shapes.append(shape)
            self.frames[body.name] = Frame(body.position, body.rotation)
            return holder
        self.scene.bodies.append(body)
        if joints:
            self.scene.joints.append(self.joint(joints, body, parent))
        elif body.type == "dynamic":
            name = self.name(Element("joint", {}, element.line), "joint", f"{body.name}_weld")
            self.scene.joints.append(SceneJoint(name, "fixed", parent, body.name, body.position))
        return body

    def weigh(self, body: SceneBody, inertial: Optional[Element], geoms: List[Geom]) -> None:
        """Its shapes and its mass."""
        body.shapes = [geom.shape for geom in geoms if geom.shape is not None]
        if body.type != "static" and any(shape.form == "plane" for shape in body.shapes):
            raise self.fail(self.lines[body.name], f"{body.name!r} moves and has a plane")
        mode = self.compiler.inertia_from_geom
        if inertial is not None and mode != "true":
            body.mass, frame, body.inertia = self.inertial(inertial)
            body.centre, body.inertia_rotation = frame.position, frame.rotation
        elif mode != "false" and body.type != "static":
            combine(body, [geom for geom in geoms if geom.mass > 0])

    # ---- all of it

    def model(self, root: Element, folder: Optional[str]) -> Scene:
        """The scene."""
        if root.tag != "mujoco":
            raise self.fail(root, "<mujoco> is needed")
        self.include(root, folder)
        self.known(root)
        self.settings(root)
        self.scene.name = root.attributes.get("model", "")
        self.assets(root)
        world = SceneBody(WORLD, "static")
        for element in root.children:
            if element.tag != "worldbody":
                continue
            for child, at, child_class in self.parts(element, Frame(), element.attributes.get("childclass")):
                if child.tag == "body":
                    self.body(child, at, Place(world, Frame(), child_class))
                else:
                    geom = self.geom(self.with_defaults(child, child_class), at)
                    world.shapes += [geom.shape] if geom and geom.shape else []
        if world.shapes:
            self.scene.bodies.insert(0, world)
        for element in root.children:
            if element.tag in ("contact", "equality", "actuator"):
                self.known(element)
                for child in element.children:
                    getattr(self, element.tag)(child)
        return self.scene

    def assets(self, root: Element) -> None:
        """<asset>: the meshes by name."""
        for element in root.children:
            for child in element.children if element.tag == "asset" else ():
                if child.tag == "mesh":
                    made = self.with_defaults(child, None)
                    usual = os.path.splitext(os.path.basename(made.attributes.get("file", "")))[0]
                    self.meshes[made.attributes.get("name", usual)] = made

    def body_named(self, element: Element, name: str) -> Optional[str]:
        """A body of the scene; None: the world."""
        found = self.need(element, name)
        if found == WORLD:
            return None
        if found not in {body.name for body in self.scene.bodies}:
            raise self.fail(element, f"there is no body {found!r}")
        return found

    def contact(self, element: Element) -> None:
        """<exclude>."""
        if element.tag == "exclude":
            pair = [self.body_named(element, name) or WORLD for name in ("body1", "body2")]
            if WORLD not in pair or self.scene.bodies[0].name == WORLD:
                self.scene.excluded.append((pair[0], pair[1]))

    def equality(self, element: Element) -> None:
        """<connect> and <weld>."""
        if element.tag not in ("connect", "weld") or "body1" not in element.attributes:
            self.warn(element, "is left out")
            return
        if self.choice(element, "active", ("true", "false"), "true") == "false":
            self.warn(element, "is not active: it is left out")
            return
        first = self.body_named(element, "body1")
        second = self.body_named(element, "body2") if "body2" in element.attributes else None
        if "relpose" in element.attributes:
            self.warn(element, "relpose is left out: the bodies are held as they stand")
        at = next((Frame(b.position, b.rotation) for b in self.scene.bodies if b.name == first), Frame())
        name = self.name(element, "joint", f"equality{len(self.names['joint'])}")
        if element.tag == "connect":
            x, y, z = self.numbers(element, "anchor", 3)
            at = at.then(Frame((x, y, z)))
        if first is None:
            first, second = second, first
        if first is None or first == second:
            raise self.fail(element, "two bodies are needed")
        kind = "ball" if element.tag == "connect" else "fixed"
        self.scene.joints.append(SceneJoint(name, kind, second, first, at.position))

    def actuator(self, element: Element) -> None:
        """<motor>, <position>, <velocity> of a joint."""
        if element.tag in LOST:
            return
        made = self.with_defaults(element, None)
        if element.tag not in ACTUATORS or "joint" not in made.attributes:
            self.warn(element, "is left out: motor, position and velocity of a joint are read")
            return
        joint = made.attributes["joint"]
        if joint not in self.names["joint"]:
            raise self.fail(element, f"there is no joint {joint!r}")
        actuator = SceneActuator(
            self.name(element, "actuator", f"actuator{len(self.names['actuator'])}"), element.tag, joint
        )
        if "gear" in made.attributes:
            actuator.gear = self.some_numbers(made, "gear", 1, 6)[0]
        actuator.gain = self.number(made, {"position": "kp", "velocity": "kv"}.get(element.tag, "gain"), 1.0)
        for limited, name, lower, upper in (
            ("ctrllimited", "ctrlrange", "lower", "upper"),
            ("forcelimited", "forcerange", "force_lower", "force_upper"),
        ):
            given = self.choice(made, limited, ("true", "false", "auto"), "auto")
            if given == "true" or (given == "auto" and self.compiler.auto_limits and name in made.attributes):
                least, most = self.numbers(made, name, 2)
                setattr(actuator, lower, least), setattr(actuator, upper, most)  # type: ignore[func-returns-value]
        self.scene.actuators.append(actuator)


def load_mjcf(source: Any, *, strict: bool = False, folders: Sequence[Any] = ()) -> Scene:
    """Of a path, or of the text itself (str that begins with "<", or bytes). What is not exact is a warning in the
    scene, with strict=True an error. What is wrong is an InvalidArgumentError that names file, line and element; what
    no scene has is an UnsupportedError. Meshes (STL, OBJ) are looked for beside the file and in `folders`; they collide
    as their hulls, on static bodies as they are."""
    text, file = read_source(source, "mjcf")
    path = None if text is source else file
    folder = None if path is None else os.path.dirname(path)
    return MjcfReader(file, strict, path, folders).model(parse(text, file), folder)
