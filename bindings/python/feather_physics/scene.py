"""A scene as data: bodies, shapes, joints and their names, read from a file of robots (urdf.py), kept as JSON, and built
in any number of worlds."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Dict, List, Optional, Sequence, Tuple

from ._flat import Quat, Vec3
from .errors import InvalidArgumentError, VersionError
from .objects import Body, Joint
from .records import Box, Capsule, Cylinder, Geometry, MassData, Material, Sphere
from .world import World

Triple = Tuple[float, float, float]
Turn = Tuple[float, float, float, float]
FORMAT = "feather-scene"
VERSION = 1
NO_TURN: Turn = (0.0, 0.0, 0.0, 1.0)
ORIGIN: Triple = (0.0, 0.0, 0.0)

# ---- rotations as x, y, z, w


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
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def normalized(v: Sequence[float]) -> Tuple[float, ...]:
    """Of length 1."""
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def add(a: Sequence[float], b: Sequence[float]) -> Triple:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


# ---- records


@dataclass
class SceneShape:
    """A form on a body: "box" (half extents), "sphere" (radius), "capsule", "cylinder" (half height, radius; along Y)."""

    form: str
    size: List[float]
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN
    density: float = 1000.0
    friction: Optional[float] = None

    def geometry(self) -> Geometry:
        """What Body.add() takes."""
        if self.form == "box":
            return Box(*self.size)
        if self.form == "sphere":
            return Sphere(*self.size)
        if self.form == "capsule":
            return Capsule(*self.size)
        if self.form == "cylinder":
            return Cylinder(*self.size)
        raise InvalidArgumentError(f"form: box, sphere, capsule or cylinder is needed, not {self.form!r}")


@dataclass
class SceneBody:
    """A body and where it is. Without a mass that of its shapes counts. Inertia: principal moments, kg m2, about the
    centre, and their axes."""

    name: str
    type: str = "dynamic"
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN
    mass: Optional[float] = None
    centre: Triple = ORIGIN
    inertia: Triple = ORIGIN
    inertia_rotation: Turn = NO_TURN
    shapes: List[SceneShape] = field(default_factory=list)


@dataclass
class SceneJoint:
    """A joint of two bodies, None is the world: "fixed", "hinge", "slider", "planar" or "free" (none). The place and the
    axis are the scene's, where the bodies stand. Limits: rad or m, None are none; effort: N m or N, velocity: rad/s or
    m/s, as the file has them; damping: N m s/rad or N s/m; friction: N m or N."""

    name: str
    type: str
    a: Optional[str]
    b: str
    position: Triple
    axis: Triple = (1.0, 0.0, 0.0)
    lower: Optional[float] = None
    upper: Optional[float] = None
    effort: Optional[float] = None
    velocity: Optional[float] = None
    damping: float = 0.0
    friction: float = 0.0


class Built:
    """What a scene became in a world: `bodies` and `joints` by name."""

    def __init__(self) -> None:
        self.bodies: Dict[str, Body] = {}
        self.joints: Dict[str, Joint] = {}


@dataclass
class Scene:
    """Bodies and joints with names. `warnings`: what the file has and the scene has not, with the file and the line."""

    name: str = ""
    bodies: List[SceneBody] = field(default_factory=list)
    joints: List[SceneJoint] = field(default_factory=list)
    warnings: List[str] = field(default_factory=list)

    # ---- into a world

    def build(
        self, world: World, position: Sequence[float] = ORIGIN, rotation: Sequence[float] = NO_TURN, **shape: Any
    ) -> Built:
        """Makes its bodies and joints in a world, moved and turned; nothing remains of it when something is refused.
        Further options are those of Body.add(), for all shapes: group=-1, layer..."""
        built = Built()
        try:
            for body in self.bodies:
                built.bodies[body.name] = _make_body(world, body, position, rotation, shape)
            for joint in self.joints:
                if joint.type != "free":
                    built.joints[joint.name] = _make_joint(world, joint, built, position, rotation)
        except BaseException:
            world.destroy_bodies(list(built.bodies.values()))  # their joints go with them
            raise
        return built

    # ---- JSON

    def to_json(self) -> str:
        """As text, in which every number is exact."""
        record: Dict[str, Any] = {"format": FORMAT, "version": VERSION, "name": self.name}
        record["bodies"] = [asdict(body) for body in self.bodies]
        record["joints"] = [asdict(joint) for joint in self.joints]
        return json.dumps(record, indent=1, allow_nan=False)

    @classmethod
    def from_json(cls, text: str) -> "Scene":
        """What to_json() wrote. An InvalidArgumentError names what is wrong, a VersionError a newer format."""
        try:
            record = json.loads(text)
        except ValueError as error:
            raise InvalidArgumentError(f"from_json: {error}") from None
        if not isinstance(record, dict) or record.get("format") != FORMAT:
            raise InvalidArgumentError("from_json: this is no scene")
        if record.get("version") != VERSION:
            raise VersionError(f"from_json: version {record.get('version')}, {VERSION} is known")
        scene = cls(_text(record.get("name", ""), "name"))
        for item in _list(record.get("bodies"), "bodies"):
            body = _record(SceneBody, item, "bodies")
            body.shapes = [_record(SceneShape, shape, f"shapes of {body.name}") for shape in _list(body.shapes, "shapes")]
            scene.bodies.append(body)
        scene.joints = [_record(SceneJoint, item, "joints") for item in _list(record.get("joints"), "joints")]
        return scene


def _list(value: Any, what: str) -> List[Any]:
    if not isinstance(value, list):
        raise InvalidArgumentError(f"from_json: {what}: a list is needed")
    return value


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise InvalidArgumentError(f"from_json: {what}: a text is needed")
    return value


TEXTS = {"name", "type", "form", "b"}
LENGTHS = {"position": 3, "rotation": 4, "centre": 3, "inertia": 3, "inertia_rotation": 4, "axis": 3}
MAY_LACK = {"mass", "friction", "lower", "upper", "effort", "velocity"}


def _number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _record(kind: Any, item: Any, what: str) -> Any:
    known = {each.name for each in fields(kind)}
    if not isinstance(item, dict) or set(item) - known:
        raise InvalidArgumentError(f"from_json: {what}: {sorted(set(item) - known) if isinstance(item, dict) else item!r}")
    for name, value in item.items():
        if name in TEXTS:
            good = isinstance(value, str)
        elif name == "a":
            good = value is None or isinstance(value, str)
        elif name in LENGTHS or name == "size":
            good = isinstance(value, list) and all(map(_number, value)) and len(value) == LENGTHS.get(name, len(value))
        elif name == "shapes":
            good = True
        else:
            good = _number(value) or (value is None and name in MAY_LACK)
        if not good:
            raise InvalidArgumentError(f"from_json: {what}: {name} is {value!r}")
        if name in LENGTHS:
            item[name] = tuple(float(x) for x in value)
    try:
        return kind(**item)
    except TypeError as error:
        raise InvalidArgumentError(f"from_json: {what}: {error}") from None


# ---- bodies and joints in a world


def _make_body(world: World, body: SceneBody, position: Sequence[float], rotation: Sequence[float], options: Any) -> Body:
    place, turn = add(position, rotate(rotation, body.position)), normalized(multiply(rotation, body.rotation))
    made = world.create_body(body.type, position=place, rotation=turn)
    try:
        for shape in body.shapes:
            settings: Dict[str, Any] = {"position": shape.position, "rotation": shape.rotation, "density": shape.density, **options}
            if shape.friction is not None:
                settings["material"] = Material(static_friction=shape.friction, dynamic_friction=shape.friction)
            made.add(shape.geometry(), **settings)
        if body.mass is not None and body.type == "dynamic":
            axes = Quat(body.inertia_rotation)
            made.mass_data = MassData(body.mass, Vec3(body.centre), Vec3(body.inertia), axes)
    except BaseException:
        made.destroy()
        raise
    return made


JOINT_AXES = {"hinge": "angular_x", "slider": "linear_x"}


def _make_joint(
    world: World, joint: SceneJoint, built: Built, position: Sequence[float], rotation: Sequence[float]
) -> Joint:
    for name in (joint.a, joint.b):
        if name is not None and name not in built.bodies:
            raise InvalidArgumentError(f"build: joint {joint.name}: there is no body {name!r}")
    a = None if joint.a is None else built.bodies[joint.a]
    b = built.bodies[joint.b]
    place, axis = add(position, rotate(rotation, joint.position)), rotate(rotation, joint.axis)
    if joint.type == "fixed":
        return world.create_fixed_joint(a, b, place)
    if joint.type == "planar":  # along both axes across `axis`, and about it
        free = {"motion": "free"}
        return world.create_configurable_joint(a, b, place, axis, linear_y=free, linear_z=free, angular_x=free)
    if joint.type not in JOINT_AXES:
        raise InvalidArgumentError(f"build: joint {joint.name}: type {joint.type!r} is not known")
    limits = {} if joint.lower is None or joint.upper is None else {"lower": joint.lower, "upper": joint.upper}
    friction = {"motor_max": joint.friction} if joint.friction > 0 else {}  # of a motor that stands
    if joint.type == "hinge" and not joint.damping:
        return world.create_hinge_joint(a, b, place, axis, limit_enabled=1 if limits else 0, **limits, **friction)
    one: Dict[str, Any] = {"motion": "limited" if limits else "free", **limits, **friction}
    if joint.damping > 0:
        one.update(spring="stiffness", spring_damping=joint.damping)
    return world.create_configurable_joint(a, b, place, axis, **{JOINT_AXES[joint.type]: one})
