"""A scene as data: bodies, shapes, joints and their names, read from a file of robots (urdf.py, mjcf.py), kept as JSON,
and built in any number of worlds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

from ._flat import Quat, Vec3
from .errors import DegenerateError, InvalidArgumentError, SceneError, UnsupportedError
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
from .records import Box, Capsule, Cylinder, MassData, Material, Plane, Sphere
from .robot_mesh import hull_of, mesh_of
from .robot_xml import SceneWarning
from .scene_json import check, fill, json_of
from .scene_records import (
    SceneActuator,
    SceneBody,
    SceneFrame,
    SceneFreedom,
    SceneJoint,
    SceneMesh,
    SceneShape,
)
from .store import Hull, Mesh
from .world import World

# What a world takes at least (the ranges of feather.h): m, kg, kg m2. A scene may hold less, and is built with these
LEAST_LENGTH, LEAST_MASS, LEAST_INERTIA = 1e-3, 1e-9, 1e-18
FORMS: Dict[str, Any] = {"box": Box, "sphere": Sphere, "capsule": Capsule, "cylinder": Cylinder, "plane": Plane}
LINK_SHARE = 0.001  # of a body's mass, that each link of a chain between it and its parent carries

@dataclass
class Built:
    """What a scene became in a world: `bodies` and `joints` by name, those of a chain by the names of its freedoms;
    `assets` of its store, by the name of the mesh and whether they are triangles; `links`: the bodies within chains;
    `frames`: of which body, None is the world, and where on it."""

    bodies: Dict[str, Body] = field(default_factory=dict)
    joints: Dict[str, Joint] = field(default_factory=dict)
    assets: Dict[Tuple[str, bool], Union[Hull, Mesh]] = field(default_factory=dict)
    links: List[Body] = field(default_factory=list)
    frames: Dict[str, Tuple[Optional[Body], Frame]] = field(default_factory=dict)

    def frame(self, name: str) -> Frame:
        """The pose that a frame or a body has now, in the world."""
        if name in self.frames:
            body, at = self.frames[name]
        elif name in self.bodies:
            body, at = self.bodies[name], Frame()
        else:
            raise SceneError(f"frame: there is no frame or body {name!r}")
        return at if body is None else _pose(body).then(at)


def _pose(body: Body) -> Frame:
    return Frame(tuple(body.position), tuple(body.rotation))  # type: ignore[arg-type]


@dataclass
class Scene:
    """Bodies, joints, frames and meshes with names; pairs of bodies that do not collide; the gravity that the file asks
    for, m/s2. `warnings`: what the file has and the scene has not, as (file, line, kind, sentence)."""

    name: str = ""
    bodies: List[SceneBody] = field(default_factory=list)
    joints: List[SceneJoint] = field(default_factory=list)
    actuators: List[SceneActuator] = field(default_factory=list)
    meshes: List[SceneMesh] = field(default_factory=list)
    excluded: List[Tuple[str, str]] = field(default_factory=list)
    gravity: Optional[Triple] = None
    warnings: List[SceneWarning] = field(default_factory=list)
    frames: List[SceneFrame] = field(default_factory=list)

    def frame(self, name: str) -> Frame:
        """The pose of a frame or a body where the scene's bodies stand."""
        named = next((one for one in self.frames if one.name == name), SceneFrame(name, name))
        if named.body is None:
            return Frame(named.position, named.rotation)
        for body in self.bodies:
            if body.name == named.body:
                return Frame(body.position, body.rotation).then(Frame(named.position, named.rotation))
        raise SceneError(f"frame: there is no frame or body {named.body!r}")

    # ---- into a world

    def build(
        self, world: World, position: Sequence[float] = ORIGIN, rotation: Sequence[float] = NO_TURN, **shape: Any
    ) -> Built:
        """Makes its bodies and joints in a world, moved and turned; nothing remains of it when something is refused.
        Further options are those of Body.add(), for all shapes: group=-1, layer... Gravity stays the world's."""
        check(self)
        built, at = Built(), Frame(tuple(position), normalized(rotation))  # type: ignore[arg-type]
        what = ""
        try:
            for body in self.bodies:
                what = f"body {body.name!r}"
                built.bodies[body.name] = self._make_body(world, body, built, at, shape)
            for a, b in self.excluded:
                world.ignore_collision(built.bodies[a], built.bodies[b], True)
            for joint in self.joints:
                what = f"joint {joint.name!r}"
                _make_joints(world, joint, built, at, self.bodies)
        except BaseException as error:
            world.destroy_bodies([*built.bodies.values(), *built.links])  # their joints go with them
            for asset in built.assets.values():
                asset.destroy()
            if isinstance(error, (InvalidArgumentError, DegenerateError, UnsupportedError)):
                raise SceneError(f"build: {what}: {error}") from None
            raise
        for frame in self.frames:
            held, own = built.bodies.get(frame.body or ""), Frame(frame.position, frame.rotation)
            built.frames[frame.name] = held, own if held is not None else at.then(own)
        return built

    def _make_body(self, world: World, body: SceneBody, built: Built, at: Frame, options: Any) -> Body:
        place = at.then(Frame(body.position, body.rotation))
        made = world.create_body(body.type, position=place.position, rotation=place.rotation)
        try:
            for shape in body.shapes:
                settings: Dict[str, Any] = {
                    "position": shape.position,
                    "rotation": normalized(shape.rotation),
                    "density": shape.density,
                    **options,
                }
                if shape.friction is not None:
                    settings["material"] = Material(static_friction=shape.friction, dynamic_friction=shape.friction)
                is_mesh = shape.form == "mesh"
                size = [max(x, LEAST_LENGTH) for x in shape.size]
                form = (
                    self._asset(world, shape.mesh, body.type != "dynamic", built) if is_mesh else FORMS[shape.form](*size)
                )
                made.add(form, **settings)
            if body.mass is not None and body.type == "dynamic":
                moments, axes = _inertia(body, self.joints)
                _set_mass(made, body.mass, body.centre, moments, axes)
        except BaseException:
            made.destroy()
            raise
        return made

    def _asset(self, world: World, name: str, is_static: bool, built: Built) -> Union[Hull, Mesh]:
        mesh = next(mesh for mesh in self.meshes if mesh.name == name)
        key = (name, is_static and bool(mesh.triangles))
        if key not in built.assets:
            built.assets[key] = mesh_of(world, mesh.points, mesh.triangles) if key[1] else hull_of(world, mesh.points)
        return built.assets[key]

    # ---- JSON

    def to_json(self) -> str:
        """As text, in which every number is exact."""
        return json_of(self)

    @classmethod
    def from_json(cls, text: str) -> "Scene":
        """What to_json() wrote. A SceneError names what is wrong; of a newer format it is a VersionError too."""
        made = cls()
        fill(made, text)
        return made


# ---- bodies and joints in a world


def _inertia(body: SceneBody, joints: Sequence[SceneJoint]) -> Tuple[Triple, Turn]:
    """Principal moments and axes, with the rotors of the joints that carry it."""
    rotors = []
    for joint in joints:
        if joint.b != body.name:
            continue
        if joint.armature > 0 and joint.type == "hinge":
            rotors.append((joint.armature, normalized(joint.axis)))
        if joint.type == "chain" and joint.freedoms[-1].axis == "angular":  # the others turn its links
            rotors.append((joint.freedoms[-1].armature, normalized(joint.freedoms[-1].direction)))
        for freedom in joint.freedoms:
            if freedom.armature > 0 and freedom.axis.startswith("angular_"):
                rotors.append((freedom.armature, rotate(joint.rotation, UNITS[freedom.axis[-1]])))
    return _with_rotors(body, rotors)


def _with_rotors(body: SceneBody, rotors: Sequence[Tuple[float, Sequence[float]]]) -> Tuple[Triple, Turn]:
    if not rotors:
        return body.inertia, body.inertia_rotation
    x, y, z, w = normalized(body.rotation)
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


def _axis(one: Any, is_slider: bool = False) -> Dict[str, Any]:
    """The settings of one axis, of a joint or a freedom. Whole turns of a spring's rest do not count."""
    limited = one.lower is not None and one.upper is not None
    settings: Dict[str, Any] = {"motion": "limited" if limited else "free"}
    if limited:
        settings.update(lower=one.lower, upper=one.upper)
    if one.friction > 0:
        settings.update(motor_max=one.friction)  # of a motor that stands
    if one.damping > 0 or one.stiffness > 0:
        settings.update(spring="stiffness", spring_damping=one.damping, spring_stiffness=one.stiffness, target=one.rest)
    if "target" in settings and abs(one.rest) > math.pi and not is_slider:
        settings["target"] = math.remainder(one.rest, 2 * math.pi)
    return settings


def _set_mass(made: Body, mass: float, centre: Sequence[float], moments: Sequence[float], axes: Sequence[float]) -> None:
    """At least what a world takes."""
    made.mass_data = MassData(
        max(mass, LEAST_MASS),
        Vec3(centre),
        Vec3([max(x, LEAST_INERTIA) for x in moments]),
        Quat(normalized(axes)),
    )


def _make_ball(
    world: World, joint: SceneJoint, a: Optional[Body], b: Body, place: Triple, axis: Triple
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
    axes: Dict[str, Any] = {one.axis: _axis(one, one.axis.startswith("linear")) for one in joint.freedoms}
    frames: Dict[str, Any] = {}
    for name, body in (("frame_a", a), ("frame_b", b)):
        if body is None:
            frames[name] = (ORIGIN, turn)  # its world_origin is the place
        else:
            frame = inside(_pose(body), Frame(place, turn))
            frames[name] = (frame.position, frame.rotation)
    return world.create_configurable_joint(a, b, place, **frames, **axes)


def _make_joint(world: World, joint: SceneJoint, a: Optional[Body], b: Body, at: Frame) -> Joint:
    place = add(at.position, rotate(at.rotation, joint.position))
    axis: Triple = rotate(at.rotation, normalized(joint.axis))
    if joint.type == "fixed":
        return world.create_fixed_joint(a, b, place)
    if joint.type == "ball":
        return _make_ball(world, joint, a, b, place, axis)
    if joint.type == "configurable":
        turn: Turn = normalized(multiply(at.rotation, joint.rotation))  # type: ignore[assignment]
        return _make_configurable(world, joint, a, b, place, turn)
    if joint.type == "planar":  # along both axes across `axis`, and about it
        free = {"motion": "free"}
        return world.create_configurable_joint(a, b, place, axis, linear_y=free, linear_z=free, angular_x=free)
    one = _axis(joint, joint.type == "slider")
    if joint.type == "hinge" and "spring" not in one:
        limited = one.pop("motion") == "limited"
        return world.create_hinge_joint(a, b, place, axis, limit_enabled=limited, **one)
    return world.create_configurable_joint(a, b, place, axis, **{JOINT_AXES[joint.type]: one})


def _make_joints(world: World, joint: SceneJoint, built: Built, at: Frame, bodies: Sequence[SceneBody]) -> None:
    a = None if joint.a is None else built.bodies[joint.a]
    b = built.bodies[joint.b]
    if joint.type == "chain":
        _make_chain(world, joint, built, at, next(body for body in bodies if body.name == joint.b))
    elif joint.type != "free":
        built.joints[joint.name] = _make_joint(world, joint, a, b, at)


PARTS = {"linear": "slider", "angular": "hinge", "ball": "ball"}


def _make_chain(world: World, joint: SceneJoint, built: Built, at: Frame, body: SceneBody) -> None:
    """Joints whose axes are askew move one after another. Between two of them is a link where the body is, with a share
    of its mass: all of them together weigh what the body does, about the same centre, with the same inertia."""
    before, last = None if joint.a is None else built.bodies[joint.a], built.bodies[joint.b]
    if before is not None:
        world.ignore_collision(before, last, True)
    data, count = last.mass_data, len(joint.freedoms) - 1
    for i, one in enumerate(joint.freedoms):
        after = last
        if i < count:
            after = world.create_body("dynamic", position=last.position, rotation=last.rotation)
            built.links.append(after)
            moments: Triple = tuple(LINK_SHARE * x for x in data.inertia)  # type: ignore[assignment]
            own: Turn = tuple(data.inertia_rotation)  # type: ignore[assignment]
            link = SceneBody("", rotation=body.rotation, inertia=moments, inertia_rotation=own)
            rotor = [(one.armature, normalized(one.direction))] if one.axis == "angular" and one.armature > 0 else []
            _set_mass(after, LINK_SHARE * data.mass, data.centre, *_with_rotors(link, rotor))
        part = SceneJoint(one.name, PARTS[one.axis], None, "", one.position, one.direction, one.lower, one.upper)
        part.damping, part.friction, part.stiffness, part.rest = one.damping, one.friction, one.stiffness, one.rest
        part.cone = one.cone
        built.joints[one.name] = _make_joint(world, part, before, after, at)
        before = after
    share = 1 - LINK_SHARE * count
    _set_mass(last, share * data.mass, data.centre, [share * x for x in data.inertia], data.inertia_rotation)
