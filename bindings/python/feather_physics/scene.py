"""A scene as data: bodies, shapes, joints and their names, read from a file of robots (urdf.py, mjcf.py), kept as JSON,
and built in any number of worlds."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

from ._flat import Quat, Vec3
from .errors import InvalidArgumentError, VersionError
from .frames import (
    NO_TURN,
    ORIGIN,
    Frame,
    Triple,
    Turn,
    add,
    inside,
    matrix_of,
    multiply,
    normalized,
    principal,
    rotate,
)
from .objects import Body, Joint
from .records import Box, Capsule, Cylinder, Geometry, MassData, Material, Plane, Sphere
from .robot_mesh import hull_of, mesh_of
from .store import Hull, Mesh
from .world import World

FORMAT = "feather-scene"
VERSION = 1

# ---- records


@dataclass
class SceneMesh:
    """Points, m, three numbers each, and triangles, three places of points each, counterclockwise seen from outside.
    Without triangles the hull of the points counts. `file`: where it is from, and by what it was scaled, as a URDF
    has it."""

    name: str
    points: List[float]
    triangles: List[int] = field(default_factory=list)
    file: str = ""
    scale: Triple = (1.0, 1.0, 1.0)


@dataclass
class SceneShape:
    """A form on a body: "box" (half extents), "sphere" (radius), "capsule", "cylinder" (half height, radius; along Y),
    "plane" (no size, Y is up), on static bodies, or "mesh": one of the scene's, by name, whose triangles count on static
    bodies, its hull on others."""

    form: str
    size: List[float]
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN
    density: float = 1000.0
    friction: Optional[float] = None
    mesh: str = ""

    def geometry(self) -> Geometry:
        """What Body.add() takes, but for a mesh."""
        if self.form == "box":
            return Box(*self.size)
        if self.form == "sphere":
            return Sphere(*self.size)
        if self.form == "capsule":
            return Capsule(*self.size)
        if self.form == "cylinder":
            return Cylinder(*self.size)
        if self.form == "plane":
            return Plane()
        raise InvalidArgumentError(f"form: box, sphere, capsule, cylinder or plane is needed, not {self.form!r}")


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
class SceneFreedom:
    """One axis along or about which a "configurable" joint moves: "linear_x" ... "angular_z" of its frame."""

    name: str
    axis: str
    lower: Optional[float] = None
    upper: Optional[float] = None
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    armature: float = 0.0


@dataclass
class SceneJoint:
    """A joint of two bodies, None is the world: "fixed", "hinge", "slider", "ball", "planar", "configurable" or "free"
    (none). The place, the axis and the rotation, which is that of a configurable joint's frame, are the scene's, where
    the bodies stand. Limits: rad or m, None are none; cone: rad, of a ball; effort: N m or N, velocity: rad/s or m/s,
    as the file has them; damping: N m s/rad or N s/m; friction: N m or N; stiffness: N m/rad or N/m, of a spring that
    pulls to `rest`; armature: kg m2, what the motor's rotor adds to the inertia about the axis."""

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
    stiffness: float = 0.0
    rest: float = 0.0
    armature: float = 0.0
    cone: Optional[float] = None
    rotation: Turn = NO_TURN
    freedoms: List[SceneFreedom] = field(default_factory=list)


@dataclass
class SceneActuator:
    """A drive of a joint, or of a configurable joint's freedom, by name. A "motor" has the torque or force gear * u; a
    "position" gain * (u - q), a "velocity" gain * (u - v) for q, v = gear times coordinate and rate, times gear. u and
    the force stay within their limits, None are none. A scene keeps them; the program drives."""

    name: str
    type: str
    joint: str
    gear: float = 1.0
    gain: float = 1.0
    lower: Optional[float] = None
    upper: Optional[float] = None
    force_lower: Optional[float] = None
    force_upper: Optional[float] = None


class Built:
    """What a scene became in a world: `bodies` and `joints` by name; `assets` of its store, by the name of the mesh and
    whether they are triangles."""

    def __init__(self) -> None:
        self.bodies: Dict[str, Body] = {}  # by name
        self.joints: Dict[str, Joint] = {}  # by name
        self.assets: Dict[Tuple[str, bool], Union[Hull, Mesh]] = {}  # by mesh, and whether they are triangles


@dataclass
class Scene:
    """Bodies, joints and meshes with names; pairs of bodies that do not collide; the gravity that the file asks for, m/s2.
    `warnings`: what the file has and the scene has not, with the file and the line."""

    name: str = ""
    bodies: List[SceneBody] = field(default_factory=list)
    joints: List[SceneJoint] = field(default_factory=list)
    actuators: List[SceneActuator] = field(default_factory=list)
    meshes: List[SceneMesh] = field(default_factory=list)
    excluded: List[Tuple[str, str]] = field(default_factory=list)
    gravity: Optional[Triple] = None
    warnings: List[str] = field(default_factory=list)

    # ---- into a world

    def build(
        self, world: World, position: Sequence[float] = ORIGIN, rotation: Sequence[float] = NO_TURN, **shape: Any
    ) -> Built:
        """Makes its bodies and joints in a world, moved and turned; nothing remains of it when something is refused.
        Further options are those of Body.add(), for all shapes: group=-1, layer... Gravity stays the world's."""
        built = Built()
        try:
            for body in self.bodies:
                built.bodies[body.name] = self._make_body(world, body, built, position, rotation, shape)
            for a, b in self.excluded:
                for name in (a, b):
                    if name not in built.bodies:
                        raise InvalidArgumentError(f"build: excluded: there is no body {name!r}")
                world.ignore_collision(built.bodies[a], built.bodies[b], True)
            for joint in self.joints:
                if joint.type != "free":
                    built.joints[joint.name] = _make_joint(world, joint, built, position, rotation)
        except BaseException:
            world.destroy_bodies(list(built.bodies.values()))  # their joints go with them
            for asset in built.assets.values():
                asset.destroy()
            raise
        return built

    def _make_body(
        self,
        world: World,
        body: SceneBody,
        built: Built,
        position: Sequence[float],
        rotation: Sequence[float],
        options: Any,
    ) -> Body:
        place, turn = add(position, rotate(rotation, body.position)), normalized(multiply(rotation, body.rotation))
        made = world.create_body(body.type, position=place, rotation=turn)
        try:
            for shape in body.shapes:
                settings: Dict[str, Any] = {
                    "position": shape.position,
                    "rotation": shape.rotation,
                    "density": shape.density,
                    **options,
                }
                if shape.friction is not None:
                    settings["material"] = Material(static_friction=shape.friction, dynamic_friction=shape.friction)
                is_mesh = shape.form == "mesh"
                form = self._asset(world, shape.mesh, body.type == "static", built) if is_mesh else shape.geometry()
                made.add(form, **settings)
            if body.mass is not None and body.type == "dynamic":
                moments, axes = _inertia(body, self.joints)
                made.mass_data = MassData(body.mass, Vec3(body.centre), Vec3(moments), Quat(axes))
        except BaseException:
            made.destroy()
            raise
        return made

    def _asset(self, world: World, name: str, is_static: bool, built: Built) -> Union[Hull, Mesh]:
        mesh = next((mesh for mesh in self.meshes if mesh.name == name), None)
        if mesh is None:
            raise InvalidArgumentError(f"build: there is no mesh {name!r}")
        key = (name, is_static and bool(mesh.triangles))
        if key not in built.assets:
            built.assets[key] = mesh_of(world, mesh.points, mesh.triangles) if key[1] else hull_of(world, mesh.points)
        return built.assets[key]

    # ---- JSON

    def to_json(self) -> str:
        """As text, in which every number is exact."""
        record: Dict[str, Any] = {"format": FORMAT, "version": VERSION, "name": self.name}
        record["bodies"] = [asdict(body) for body in self.bodies]
        record["joints"] = [asdict(joint) for joint in self.joints]
        record["meshes"] = [asdict(mesh) for mesh in self.meshes]
        record["actuators"] = [asdict(actuator) for actuator in self.actuators]
        record["excluded"], record["gravity"] = self.excluded, self.gravity
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
            body.shapes = [
                _record(SceneShape, shape, f"shapes of {body.name}") for shape in _list(body.shapes, "shapes")
            ]
            scene.bodies.append(body)
        for item in _list(record.get("joints"), "joints"):
            joint = _record(SceneJoint, item, "joints")
            freedoms = f"freedoms of {joint.name}"
            joint.freedoms = [_record(SceneFreedom, each, freedoms) for each in _list(joint.freedoms, freedoms)]
            scene.joints.append(joint)
        scene.actuators = [
            _record(SceneActuator, item, "actuators") for item in _list(record.get("actuators", []), "actuators")
        ]
        scene.meshes = [_mesh(item) for item in _list(record.get("meshes", []), "meshes")]
        for pair in _list(record.get("excluded", []), "excluded"):
            if not isinstance(pair, list) or len(pair) != 2 or not all(isinstance(name, str) for name in pair):
                raise InvalidArgumentError(f"from_json: excluded: two names are needed, not {pair!r}")
            scene.excluded.append((pair[0], pair[1]))
        gravity = record.get("gravity")
        if gravity is not None:
            if not isinstance(gravity, list) or len(gravity) != 3 or not all(map(_number, gravity)):
                raise InvalidArgumentError(f"from_json: gravity is {gravity!r}")
            scene.gravity = (float(gravity[0]), float(gravity[1]), float(gravity[2]))
        return scene


def _list(value: Any, what: str) -> List[Any]:
    if not isinstance(value, list):
        raise InvalidArgumentError(f"from_json: {what}: a list is needed")
    return value


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise InvalidArgumentError(f"from_json: {what}: a text is needed")
    return value


TEXTS = {"name", "type", "form", "b", "mesh", "file"}  # and the axis of a freedom, the joint of an actuator
LISTS = {"shapes", "freedoms", "points", "triangles"}
LENGTHS = {"scale": 3, "position": 3, "rotation": 4, "centre": 3, "inertia": 3, "inertia_rotation": 4, "axis": 3}
MAY_LACK = {"mass", "friction", "lower", "upper", "effort", "velocity", "cone", "force_lower", "force_upper"}


def _number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _record(kind: Any, item: Any, what: str) -> Any:
    known = {each.name for each in fields(kind)}
    if not isinstance(item, dict) or set(item) - known:
        raise InvalidArgumentError(
            f"from_json: {what}: {sorted(set(item) - known) if isinstance(item, dict) else item!r}"
        )
    for name, value in item.items():
        is_text = name in TEXTS or (kind, name) in ((SceneFreedom, "axis"), (SceneActuator, "joint"))
        if is_text:
            good = isinstance(value, str)
        elif name == "a":
            good = value is None or isinstance(value, str)
        elif name in LENGTHS or name == "size":
            good = isinstance(value, list) and all(map(_number, value)) and len(value) == LENGTHS.get(name, len(value))
        elif name in LISTS:
            good = True
        else:
            good = _number(value) or (value is None and name in MAY_LACK)
        if not good:
            raise InvalidArgumentError(f"from_json: {what}: {name} is {value!r}")
        if name in LENGTHS and not is_text:
            item[name] = tuple(float(x) for x in value)
    try:
        return kind(**item)
    except TypeError as error:
        raise InvalidArgumentError(f"from_json: {what}: {error}") from None


def _mesh(item: Any) -> SceneMesh:
    mesh: SceneMesh = _record(SceneMesh, item, "meshes")
    points, triangles = _list(mesh.points, "points"), _list(mesh.triangles, "triangles")
    if not points or len(points) % 3 or not all(map(_number, points)):
        raise InvalidArgumentError(f"from_json: points of {mesh.name}: three numbers each are needed")
    places = range(len(points) // 3)
    if len(triangles) % 3 or not all(type(corner) is int and corner in places for corner in triangles):
        raise InvalidArgumentError(f"from_json: triangles of {mesh.name}: three places of points each are needed")
    return mesh


# ---- bodies and joints in a world


def _inertia(body: SceneBody, joints: Sequence[SceneJoint]) -> Tuple[Triple, Turn]:
    """Principal moments and axes, with the rotors of the joints that carry it."""
    rotors = []
    for joint in joints:
        if joint.b != body.name:
            continue
        if joint.armature > 0 and joint.type == "hinge":
            rotors.append((joint.armature, joint.axis))
        for freedom in joint.freedoms:
            if freedom.armature > 0 and freedom.axis.startswith("angular"):
                rotors.append((freedom.armature, rotate(joint.rotation, UNITS[freedom.axis[-1]])))
    if not rotors:
        return body.inertia, body.inertia_rotation
    x, y, z, w = body.rotation
    tensor = matrix_of(body.inertia, body.inertia_rotation)
    for armature, axis in rotors:
        a = rotate((-x, -y, -z, w), axis)
        tensor = [[tensor[m][n] + armature * a[m] * a[n] for n in range(3)] for m in range(3)]
    moments, axes = principal(tensor)
    # A rotor turns about one axis alone, a body does not: none of its moments is above the sum of the others.
    missing = max(moments) * (1 + 1e-6) - (sum(moments) - max(moments))
    if missing > 0:
        low = moments.index(min(moments))
        moments = tuple(m + missing * (k == low) for k, m in enumerate(moments))  # type: ignore[assignment]
    return moments, axes


JOINT_AXES = {"hinge": "angular_x", "slider": "linear_x"}
UNITS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
AXES = [f"{kind}_{letter}" for kind in ("linear", "angular") for letter in UNITS]


def _axis(one: Any) -> Dict[str, Any]:
    """The settings of one axis, of a joint or a freedom."""
    limited = one.lower is not None and one.upper is not None
    settings: Dict[str, Any] = {"motion": "limited" if limited else "free"}
    if limited:
        settings.update(lower=one.lower, upper=one.upper)
    if one.friction > 0:
        settings.update(motor_max=one.friction)  # of a motor that stands
    if one.damping > 0 or one.stiffness > 0:
        settings.update(spring="stiffness", spring_damping=one.damping, spring_stiffness=one.stiffness, target=one.rest)
    return settings


def _make_ball(
    world: World, joint: SceneJoint, a: Optional[Body], b: Optional[Body], place: Triple, axis: Triple
) -> Joint:
    friction = {"motor_max": joint.friction} if joint.friction > 0 else {}
    if not joint.damping and not joint.stiffness:
        cone = {} if joint.cone is None else {"cone_enabled": 1, "cone_y": joint.cone, "cone_z": joint.cone}
        return world.create_ball_joint(a, b, place, axis, **cone, **friction)
    one = SceneFreedom(
        "", "", None if joint.cone is None else -joint.cone, joint.cone, joint.damping, joint.friction, joint.stiffness
    )
    about = {name: _axis(one) for name in AXES if name.startswith("angular")}
    return world.create_configurable_joint(a, b, place, axis, **about)


def _make_configurable(world: World, joint: SceneJoint, a: Optional[Body], b: Body, place: Triple, turn: Turn) -> Joint:
    axes: Dict[str, Any] = {}
    for freedom in joint.freedoms:
        if freedom.axis not in AXES or freedom.axis in axes:
            raise InvalidArgumentError(f"build: joint {joint.name}: axis {freedom.axis!r}")
        axes[freedom.axis] = _axis(freedom)
    frames: Dict[str, Any] = {}
    for name, body in (("frame_a", a), ("frame_b", b)):
        if body is None:
            frames[name] = (ORIGIN, turn)  # its world_origin is the place
        else:
            frame = inside(Frame(tuple(body.position), tuple(body.rotation)), Frame(place, turn))  # type: ignore[arg-type]
            frames[name] = (frame.position, frame.rotation)
    return world.create_configurable_joint(a, b, place, **frames, **axes)


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
    if joint.type == "ball":
        return _make_ball(world, joint, a, b, place, axis)
    if joint.type == "configurable":
        turn: Turn = normalized(multiply(rotation, joint.rotation))  # type: ignore[assignment]
        return _make_configurable(world, joint, a, b, place, turn)
    if joint.type == "planar":  # along both axes across `axis`, and about it
        free = {"motion": "free"}
        return world.create_configurable_joint(a, b, place, axis, linear_y=free, linear_z=free, angular_x=free)
    if joint.type not in JOINT_AXES:
        raise InvalidArgumentError(f"build: joint {joint.name}: type {joint.type!r} is not known")
    one = _axis(joint)
    if joint.type == "hinge" and "spring" not in one:
        limited = one.pop("motion") == "limited"
        return world.create_hinge_joint(a, b, place, axis, limit_enabled=limited, **one)
    return world.create_configurable_joint(a, b, place, axis, **{JOINT_AXES[joint.type]: one})
