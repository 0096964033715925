"""Scenes written as MJCF."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence

from .errors import UnsupportedSceneError
from .frames import ORIGIN, Z_TO_Y, Frame, inside, rotate
from .robot_xml import escaped, row
from .scene import Scene
from .scene_json import check
from .scene_records import SceneActuator, SceneBody, SceneJoint, SceneMesh, SceneShape

LETTERS = "xyz"
WORLD = "world"


def _quat(q: Sequence[float]) -> str:
    x, y, z, w = q
    return row((w, x, y, z))


def _pose(frame: Frame) -> str:
    return f'pos="{row(frame.position)}" quat="{_quat(frame.rotation)}"'


def _geom(shape: SceneShape, indent: str) -> str:
    frame, size = Frame(shape.position, shape.rotation), shape.size
    if shape.form in ("capsule", "cylinder", "plane"):
        frame = frame.then(Frame(ORIGIN, Z_TO_Y))
        size = [size[1], size[0]] if size else [0.0, 0.0, 1.0]
    friction = 1.0 if shape.friction is None else shape.friction
    if shape.form == "mesh":
        form = f'type="mesh" mesh="{escaped(shape.mesh)}"'
    else:
        form = f'type="{shape.form}" size="{row(size)}"'
    return f'{indent}<geom {form} {_pose(frame)} density="{shape.density!r}" friction="{friction!r}"/>\n'


def _freedom(one: Any, kind: str, frame: Frame, place: Sequence[float], axis: Sequence[float], indent: str) -> str:
    at = inside(frame, Frame((place[0], place[1], place[2])))
    x, y, z, w = frame.rotation
    text = f'{indent}<joint name="{escaped(one.name)}" type="{kind}" pos="{row(at.position)}"'
    text += f' axis="{row(rotate((-x, -y, -z, w), axis))}"' if kind != "ball" else ""
    limits = (one.lower, one.upper) if kind != "ball" else (0.0, one.cone)
    if limits[0] is None or limits[1] is None:
        text += ' limited="false"'
    else:
        text += f' limited="true" range="{row(limits)}"'
    for name, value in (
        ("damping", one.damping),
        ("frictionloss", one.friction),
        ("stiffness", one.stiffness),
        ("springref", one.rest),
        ("armature", one.armature),
    ):
        if value:
            text += f' {name}="{value!r}"'
    return text + "/>\n"


def _joints(joint: SceneJoint, frame: Frame, indent: str) -> str:
    if joint.type == "free":
        return f'{indent}<freejoint name="{escaped(joint.name)}"/>\n'
    if joint.type == "fixed":
        return ""
    if joint.type in ("hinge", "slider", "ball"):
        kind = "slide" if joint.type == "slider" else joint.type
        return _freedom(joint, kind, frame, joint.position, joint.axis, indent)
    if joint.type == "chain":
        kinds = {"linear": "slide", "angular": "hinge", "ball": "ball"}
        return "".join(_freedom(one, kinds[one.axis], frame, one.position, one.direction, indent) for one in joint.freedoms)
    if joint.type != "configurable":
        raise UnsupportedSceneError(f"save_mjcf: joint {joint.name}: MJCF has no {joint.type!r}")
    text = ""
    for one in joint.freedoms:
        axis = rotate(joint.rotation, [float(one.axis.endswith(letter)) for letter in LETTERS])
        text += _freedom(
            one, "slide" if one.axis.startswith("linear") else "hinge", frame, joint.position, axis, indent
        )
    return text


class _Writer:
    """A scene as a tree: of the joints of a body the first is the one that it hangs on."""

    def __init__(self, scene: Scene):
        self.scene = scene
        self.hangs: Dict[str, SceneJoint] = {}
        self.loops: List[SceneJoint] = []
        self.within: Dict[Optional[str], List[SceneBody]] = {}
        for joint in scene.joints:
            if joint.b in self.hangs:
                self.loops.append(joint)
            else:
                self.hangs[joint.b] = joint
        for body in scene.bodies:
            joint_of = self.hangs.get(body.name)
            self.within.setdefault(joint_of.a if joint_of else None, []).append(body)

    def body(self, body: SceneBody, outer: Frame, indent: str) -> str:
        """A body and those within it."""
        frame = Frame(body.position, body.rotation)
        joint = self.hangs.get(body.name)
        mocap = ' mocap="true"' if body.type == "kinematic" else ""
        if mocap and joint is not None:
            raise UnsupportedSceneError(f"save_mjcf: body {body.name}: in MJCF no joint moves a kinematic body")
        text = f'{indent}<body name="{escaped(body.name)}" {_pose(inside(outer, frame))}{mocap}>\n'
        if body.type == "dynamic" and body.mass is None:
            raise UnsupportedSceneError(f"save_mjcf: body {body.name}: a mass is needed")
        if body.mass is not None:
            at = Frame(body.centre, body.inertia_rotation)
            text += f'{indent}  <inertial {_pose(at)} mass="{body.mass!r}" diaginertia="{row(body.inertia)}"/>\n'
        if body.type == "dynamic" and joint is None:
            text += f"{indent}  <freejoint/>\n"
        if joint is not None:
            text += _joints(joint, frame, indent + "  ")
        text += "".join(_geom(shape, indent + "  ") for shape in body.shapes)
        text += self.sites(body.name, indent + "  ")
        text += "".join(self.body(other, frame, indent + "  ") for other in self.within.get(body.name, ()))
        return text + f"{indent}</body>\n"

    def sites(self, body: Optional[str], indent: str) -> str:
        """The frames of a body."""
        own = (frame for frame in self.scene.frames if frame.body == body)
        return "".join(
            f'{indent}<site name="{escaped(one.name)}" {_pose(Frame(one.position, one.rotation))}/>\n' for one in own
        )

    def loop(self, joint: SceneJoint) -> str:
        """A joint that closes a loop."""
        names = f'body1="{escaped(joint.b)}"' + (f' body2="{escaped(joint.a)}"' if joint.a is not None else "")
        if joint.type == "fixed":
            return f'    <weld name="{escaped(joint.name)}" {names}/>\n'
        if joint.type != "ball":
            raise UnsupportedSceneError(f"save_mjcf: joint {joint.name}: MJCF closes loops by balls and welds alone")
        body = next(body for body in self.scene.bodies if body.name == joint.b)
        at = inside(Frame(body.position, body.rotation), Frame(joint.position))
        return f'    <connect name="{escaped(joint.name)}" {names} anchor="{row(at.position)}"/>\n'

    def text(self) -> str:
        """All of it."""
        scene, world = self.scene, self.sites(None, "    ") + self.sites(WORLD, "    ")
        for body in self.within.get(None, ()):
            if body.name == WORLD and body.type == "static":
                world += "".join(_geom(shape, "    ") for shape in body.shapes)
                world += "".join(self.body(other, Frame(), "    ") for other in self.within.get(WORLD, ()))
            else:
                world += self.body(body, Frame(), "    ")
        text = f'<mujoco model="{escaped(scene.name)}">\n  <compiler angle="radian" autolimits="true"/>\n'
        if scene.gravity is not None:
            text += f'  <option gravity="{row(scene.gravity)}"/>\n'
        meshes = "".join(map(_mesh, scene.meshes))
        text += f"  <asset>\n{meshes}  </asset>\n" if meshes else ""
        text += f"  <worldbody>\n{world}  </worldbody>\n"
        excluded = "".join(f'    <exclude body1="{escaped(a)}" body2="{escaped(b)}"/>\n' for a, b in scene.excluded)
        loops = "".join(map(self.loop, self.loops))
        actuators = "".join(map(_actuator, scene.actuators))
        for tag, inner in (("contact", excluded), ("equality", loops), ("actuator", actuators)):
            if inner:
                text += f"  <{tag}>\n{inner}  </{tag}>\n"
        return text + "</mujoco>\n"


def _mesh(mesh: SceneMesh) -> str:
    faces = f' face="{" ".join(map(str, mesh.triangles))}"' if mesh.triangles else ""
    return f'    <mesh name="{escaped(mesh.name)}" vertex="{row(mesh.points)}"{faces}/>\n'


def _actuator(one: SceneActuator) -> str:
    text = f'    <{one.type} name="{escaped(one.name)}" joint="{escaped(one.joint)}" gear="{one.gear!r}"'
    if one.type != "motor":
        text += f' {"kp" if one.type == "position" else "kv"}="{one.gain!r}"'
    if one.lower is not None and one.upper is not None:
        text += f' ctrllimited="true" ctrlrange="{row((one.lower, one.upper))}"'
    if one.force_lower is not None and one.force_upper is not None:
        text += f' forcelimited="true" forcerange="{row((one.force_lower, one.force_upper))}"'
    return text + "/>\n"


def save_mjcf(scene: Scene) -> str:
    """The text of a scene whose bodies have masses. Loading it gives the scene again, up to rounding; effort and
    velocity of joints have no place in it. What MJCF has not is a SceneError."""
    check(scene)
    try:
        return _Writer(scene).text()
    except RecursionError:
        raise UnsupportedSceneError("save_mjcf: too many bodies hang on one another") from None
