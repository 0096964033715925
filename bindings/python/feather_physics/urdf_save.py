"""Scenes written as URDF."""

from __future__ import annotations

from typing import Dict, Set

from .errors import UnsupportedSceneError
from .frames import ORIGIN, Z_TO_Y, Frame, angles_of, inside, matrix_of, rotate
from .robot_xml import escaped, row
from .scene import Scene
from .scene_json import check
from .scene_records import SceneBody, SceneJoint, SceneMesh, SceneShape

WRITTEN = {"fixed": "fixed", "slider": "prismatic", "planar": "planar", "free": "floating"}


def _origin(frame: Frame, indent: str) -> str:
    return f'{indent}<origin xyz="{row(frame.position)}" rpy="{row(angles_of(frame.rotation))}"/>\n'


def _mesh(body: SceneBody, shape: SceneShape, meshes: Dict[str, SceneMesh]) -> str:
    mesh = meshes.get(shape.mesh)
    if mesh is None or not mesh.file:
        raise UnsupportedSceneError(
            f"save_urdf: body {body.name}: URDF has meshes in files alone, {shape.mesh!r} is of none"
        )
    scale = "" if mesh.scale == (1, 1, 1) else f' scale="{row(mesh.scale)}"'
    return f'<mesh filename="{escaped(mesh.file)}"{scale}/>'


def _link(body: SceneBody, meshes: Dict[str, SceneMesh]) -> str:
    text = f'  <link name="{escaped(body.name)}">\n'
    if body.mass is not None:
        m = matrix_of(body.inertia, body.inertia_rotation)
        parts = {"ixx": m[0][0], "ixy": m[0][1], "ixz": m[0][2], "iyy": m[1][1], "iyz": m[1][2], "izz": m[2][2]}
        tensor = " ".join(f'{name}="{value!r}"' for name, value in parts.items())
        text += f"    <inertial>\n{_origin(Frame(body.centre), '      ')}"
        text += f'      <mass value="{body.mass!r}"/>\n      <inertia {tensor}/>\n    </inertial>\n'
    for shape in body.shapes:
        frame = Frame(shape.position, shape.rotation)
        if shape.form in ("capsule", "cylinder"):
            frame = frame.then(Frame(ORIGIN, Z_TO_Y))
            form = f'<{shape.form} radius="{shape.size[1]!r}" length="{2 * shape.size[0]!r}"/>'
        elif shape.form == "sphere":
            form = f'<sphere radius="{shape.size[0]!r}"/>'
        elif shape.form == "plane":
            frame = frame.then(Frame(ORIGIN, Z_TO_Y))
            form = '<plane normal="0 0 1"/>'
        elif shape.form == "mesh":
            form = _mesh(body, shape, meshes)
        else:
            form = f'<box size="{row([2 * x for x in shape.size])}"/>'
        text += f"    <collision>\n{_origin(frame, '      ')}      <geometry>{form}</geometry>\n    </collision>\n"
    return text + "  </link>\n"


def _joint(joint: SceneJoint, frames: Dict[str, Frame]) -> str:
    kind = WRITTEN.get(joint.type) or ("continuous" if joint.lower is None else "revolute")
    if kind == "prismatic" and joint.lower is None:
        raise UnsupportedSceneError(f"save_urdf: joint {joint.name}: URDF has no slider without limits")
    if joint.a is None:
        raise UnsupportedSceneError(f"save_urdf: joint {joint.name}: URDF has no joints with the world")
    child = frames[joint.b]
    if max(abs(x - y) for x, y in zip(joint.position, child.position)) > 1e-9:
        raise UnsupportedSceneError(f"save_urdf: joint {joint.name}: URDF has joints at the origin of the child alone")
    text = f'  <joint name="{escaped(joint.name)}" type="{kind}">\n'
    text += _origin(inside(frames[joint.a], child), "    ")
    text += f'    <parent link="{escaped(joint.a)}"/>\n    <child link="{escaped(joint.b)}"/>\n'
    x, y, z, w = child.rotation
    text += f'    <axis xyz="{row(rotate((-x, -y, -z, w), joint.axis))}"/>\n'
    if kind in ("revolute", "prismatic") or joint.effort is not None or joint.velocity is not None:
        lower, upper = (0.0, 0.0) if joint.lower is None or joint.upper is None else (joint.lower, joint.upper)
        limits = f' lower="{lower!r}" upper="{upper!r}"' if kind in ("revolute", "prismatic") else ""
        text += f'    <limit{limits} effort="{joint.effort or 0.0!r}" velocity="{joint.velocity or 0.0!r}"/>\n'
    if joint.damping or joint.friction:
        text += f'    <dynamics damping="{joint.damping!r}" friction="{joint.friction!r}"/>\n'
    return text + "  </joint>\n"


def _fixed(name: str, parent: str, child: str, at: Frame) -> str:
    text = f'  <joint name="{escaped(name)}" type="fixed">\n{_origin(at, "    ")}'
    return text + f'    <parent link="{escaped(parent)}"/>\n    <child link="{escaped(child)}"/>\n  </joint>\n'


def _frames(scene: Scene, joint_names: Set[str]) -> str:
    """Links without mass, each fixed to its body."""
    text, bodies = "", {body.name for body in scene.bodies}
    for frame in scene.frames:
        name = f"{frame.name}_fixed"
        if frame.body is None or frame.name in bodies or name in joint_names:
            raise UnsupportedSceneError(
                f"save_urdf: frame {frame.name}: URDF has frames of bodies alone, with names that no body has"
            )
        text += f'  <link name="{escaped(frame.name)}"/>\n'
        text += _fixed(name, frame.body, frame.name, Frame(frame.position, frame.rotation))
    return text


def save_urdf(scene: Scene) -> str:
    """The text of a scene that is one tree; loading it gives the scene again, up to rounding. Its meshes stay in their
    files. What URDF has not is a SceneError."""
    check(scene)
    meshes = {mesh.name: mesh for mesh in scene.meshes}
    places = {body.name: Frame(body.position, body.rotation) for body in scene.bodies}
    for joint in scene.joints:
        if joint.type not in WRITTEN and joint.type != "hinge":
            raise UnsupportedSceneError(f"save_urdf: joint {joint.name}: URDF has no {joint.type!r}")
    links = "".join(_link(body, meshes) for body in scene.bodies)
    joints = "".join(_joint(joint, places) for joint in scene.joints)
    frames = _frames(scene, {joint.name for joint in scene.joints})
    return f'<?xml version="1.0"?>\n<robot name="{escaped(scene.name)}">\n{links}{joints}{frames}</robot>\n'
