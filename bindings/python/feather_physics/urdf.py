"""URDF, the format of ROS for robots (http://wiki.ros.org/urdf/XML), read into a Scene and written from one."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Optional, Sequence, Tuple

from .errors import InvalidArgumentError, UnsupportedError
from .frames import (
    ORIGIN,
    Y_TO_Z,
    Z_TO_Y,
    Frame,
    add,
    angles_of,
    inside,
    matrix_of,
    normalized,
    principal,
    rotate,
    turn_of,
)
from .robot_mesh import find_file, read_mesh
from .robot_xml import Element, Reader, escaped, parse, read_source, row
from .scene import Scene, SceneBody, SceneJoint, SceneMesh, SceneShape

JOINTS = {
    "fixed": "fixed",
    "revolute": "hinge",
    "continuous": "hinge",
    "prismatic": "slider",
    "planar": "planar",
    "floating": "free",
}
WRITTEN = {"fixed": "fixed", "slider": "prismatic", "planar": "planar", "free": "floating"}
# what says nothing about motion
SILENT = {"visual", "material"}
LOST = {"transmission", "gazebo", "sensor"}
FIELDS = {
    "robot": {"link", "joint"} | SILENT | LOST,
    "link": {"inertial", "collision"} | SILENT | LOST,
    "inertial": {"origin", "mass", "inertia"},
    "collision": {"origin", "geometry"} | SILENT,
    "geometry": {"box", "sphere", "cylinder", "capsule", "mesh"},
    "joint": {"origin", "parent", "child", "axis", "limit", "dynamics", "calibration", "safety_controller", "mimic"},
}


# ---- reading


class UrdfReader(Reader):
    """Reads one file."""

    FIELDS, LOST = FIELDS, LOST

    def __init__(self, file: str, strict: bool, inertia: str, path: Optional[str], folders: Sequence[Any]):
        super().__init__(file, strict)
        self.inertia, self.path, self.folders = inertia, path, folders
        self.meshes: Dict[str, SceneMesh] = {}
        self.hulls: List[Tuple[Element, SceneBody]] = []  # where meshes are, of bodies that may be dynamic

    def origin(self, element: Element) -> Frame:
        """Its <origin>; without one no turn and no way."""
        found = element.find("origin")
        if found is None:
            return Frame()
        x, y, z = self.numbers(found, "xyz", 3, ORIGIN)
        return Frame((x, y, z), turn_of(*self.numbers(found, "rpy", 3, ORIGIN)))

    # ---- links

    def mesh(self, form: Element) -> Optional[SceneMesh]:
        """A <mesh>, read once for each scale."""
        name, scale = self.need(form, "filename"), self.numbers(form, "scale", 3, (1, 1, 1))
        key = name if scale == [1, 1, 1] else f"{name} {row(scale)}"
        if key not in self.meshes:
            file = find_file(name, self.path, self.folders)
            if file is None:
                self.warn(form, f"there is no file {name!r}: it is left out")
                return None
            try:
                points, triangles = read_mesh(file, scale)
            except UnsupportedError as error:
                self.warn(form, f"{error}: it is left out")
                return None
            x, y, z = scale
            self.meshes[key] = SceneMesh(key, points, triangles, name, (x, y, z))
        return self.meshes[key]

    def shape(self, element: Element, body: SceneBody) -> Optional[SceneShape]:
        """A <collision>."""
        self.known(element)
        geometry = element.find("geometry")
        if geometry is None or len(geometry.children) != 1:
            raise self.fail(element, "one form in <geometry> is needed")
        self.known(geometry)
        form, frame = geometry.children[0], self.origin(element)
        if form.tag == "mesh":
            mesh = self.mesh(form)
            if mesh is None:
                return None
            self.hulls.append((form, body))
            return SceneShape("mesh", [], frame.position, frame.rotation, mesh=mesh.name)
        if form.tag == "box":
            size = [0.5 * x for x in self.numbers(form, "size", 3)]
            if min(size) <= 0:
                raise self.fail(form, "size: more than 0 is needed")
            return SceneShape("box", size, frame.position, frame.rotation)
        radius = self.positive(form, "radius")
        if form.tag == "sphere":
            return SceneShape("sphere", [radius], frame.position, frame.rotation)
        half = 0.5 * self.positive(form, "length")
        return SceneShape(form.tag, [half, radius], frame.position, frame.then(Frame(ORIGIN, Y_TO_Z)).rotation)

    def inertial(self, body: SceneBody, element: Element) -> None:
        """Mass, centre and inertia of a link."""
        self.known(element)
        mass, tensor, frame = element.find("mass"), element.find("inertia"), self.origin(element)
        if mass is None or tensor is None:
            raise self.fail(element, "mass and inertia are needed")
        body.mass, body.centre = self.positive(mass, "value"), frame.position
        xx, yy, zz = (self.number(tensor, name) for name in ("ixx", "iyy", "izz"))
        xy, xz, yz = (self.number(tensor, name, 0.0) for name in ("ixy", "ixz", "iyz"))
        moments, turn = principal([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        if min(moments) <= 0 or 2 * max(moments) > sum(moments) * (1 + 1e-6):
            raise self.fail(
                tensor, f"no body has the moments {moments}: each is above 0, none above the sum of the others"
            )
        body.inertia = moments
        body.inertia_rotation = frame.then(Frame(ORIGIN, turn)).rotation

    def link(self, element: Element) -> SceneBody:
        """A body at the origin."""
        self.known(element)
        body = SceneBody(self.need(element, "name"))
        for child in element.children:
            if child.tag == "collision":
                shape = self.shape(child, body)
                if shape is not None:
                    body.shapes.append(shape)
        inertial = element.find("inertial")
        if inertial is not None:
            self.inertial(body, inertial)
        elif self.inertia == "from_shapes" and body.shapes:
            self.warn(element, "its mass is that of its shapes, of 1000 kg/m3")
        return body

    # ---- joints

    def joint(self, element: Element) -> Tuple[SceneJoint, Frame]:
        """A joint in the frame of its parent, and that frame."""
        self.known(element)
        kind, parent, child = self.need(element, "type"), element.find("parent"), element.find("child")
        if kind not in JOINTS:
            raise self.fail(element, f"type: one of {', '.join(JOINTS)} is needed, not {kind!r}")
        if parent is None or child is None:
            raise self.fail(element, "parent and child are needed")
        mimic = element.find("mimic")
        if mimic is not None:
            raise UnsupportedError(f"{self.file}:{mimic.line}: <mimic>: no joint follows another one")
        axis = element.find("axis")
        along = (1.0, 0.0, 0.0) if axis is None else tuple(self.numbers(axis, "xyz", 3, (1, 0, 0)))
        if axis is not None and not any(along):
            raise self.fail(axis, "xyz: a direction is needed")
        made = SceneJoint(
            self.need(element, "name"),
            JOINTS[kind],
            self.need(parent, "link"),
            self.need(child, "link"),
            ORIGIN,
            normalized(along),  # type: ignore[arg-type]
        )
        self.limits(made, kind, element)
        dynamics = element.find("dynamics")
        if dynamics is not None:
            made.damping, made.friction = self.number(dynamics, "damping", 0.0), self.number(dynamics, "friction", 0.0)
            if min(made.damping, made.friction) < 0:
                raise self.fail(dynamics, "damping and friction are not negative")
        return made, self.origin(element)

    def limits(self, joint: SceneJoint, kind: str, element: Element) -> None:
        """Its <limit>."""
        limit = element.find("limit")
        if limit is None:
            if kind in ("revolute", "prismatic"):
                raise self.fail(element, "a limit is needed")
            return
        joint.effort = self.number(limit, "effort", 0.0) or None
        joint.velocity = self.number(limit, "velocity", 0.0) or None
        if kind not in ("revolute", "prismatic"):
            return
        joint.lower, joint.upper = self.number(limit, "lower", 0.0), self.number(limit, "upper", 0.0)
        if joint.lower > joint.upper:
            raise self.fail(limit, f"lower {joint.lower} is above upper {joint.upper}")
        if kind == "revolute" and max(-joint.lower, joint.upper) > math.pi:
            self.warn(limit, "beyond half a turn: the joint has no limits")
            joint.lower = joint.upper = None

    # ---- all of it

    def robot(self, root: Element, fixed_base: bool) -> Scene:
        """The tree of links, each at the place that it has when all joints are at 0."""
        if root.tag != "robot":
            raise self.fail(root, "<robot> is needed")
        self.known(root)
        bodies: Dict[str, SceneBody] = {}
        lines: Dict[str, Element] = {}
        for element in root.children:
            if element.tag == "link":
                body = self.link(element)
                if body.name in bodies:
                    raise self.fail(element, f"a second link has the name {body.name!r}")
                bodies[body.name], lines[body.name] = body, element
        children: Dict[str, List[Tuple[SceneJoint, Frame]]] = {name: [] for name in bodies}
        has_parent, names = set(), set()
        for element in root.children:
            if element.tag != "joint":
                continue
            joint, frame = self.joint(element)
            for name in (joint.a, joint.b):
                if name not in bodies:
                    raise self.fail(element, f"there is no link {name!r}")
            if joint.b in has_parent or joint.name in names:
                raise self.fail(
                    element,
                    f"{joint.b!r} has two parents"
                    if joint.b in has_parent
                    else f"a second joint has the name {joint.name!r}",
                )
            has_parent.add(joint.b), names.add(joint.name)  # type: ignore[func-returns-value]
            children[joint.a or ""].append((joint, frame))
        roots = [name for name in bodies if name not in has_parent]
        if len(roots) != 1:
            raise self.fail(root, f"one link without a parent is needed, not {len(roots)}")
        return self.tree(root, bodies, lines, children, roots[0], fixed_base)

    def tree(
        self,
        root: Element,
        bodies: Dict[str, SceneBody],
        lines: Dict[str, Element],
        children: Dict[str, List[Tuple[SceneJoint, Frame]]],
        first: str,
        fixed_base: bool,
    ) -> Scene:
        """From the base outwards."""
        scene = Scene(root.attributes.get("name", ""), warnings=self.warnings)
        base = bodies[first]
        if fixed_base or (base.mass is None and (not base.shapes or self.inertia != "from_shapes")):
            base.type = "static"
        for form, body in self.hulls:
            if body.type == "dynamic":
                self.warn(form, "collides as its hull")
        scene.meshes = list(self.meshes.values())
        waiting = [(first, Frame())]
        while waiting:
            name, frame = waiting.pop(0)
            body = bodies[name]
            body.position, body.rotation = frame.position, frame.rotation
            if body.type == "dynamic" and body.mass is None and not (self.inertia == "from_shapes" and body.shapes):
                raise self.fail(lines[name], f"{name!r} has no inertial (inertia='from_shapes' takes that of shapes)")
            scene.bodies.append(body)
            for joint, at in children[name]:
                place = frame.then(at)
                joint.position = place.position
                joint.axis = normalized(rotate(place.rotation, joint.axis))  # type: ignore[assignment]
                scene.joints.append(joint)
                waiting.append((joint.b, place))
        if len(scene.bodies) != len(bodies):
            raise self.fail(root, "joints make a circle")
        return scene


def load_urdf(
    source: Any,
    *,
    fixed_base: bool = False,
    strict: bool = False,
    inertia: str = "from_file",
    folders: Sequence[Any] = (),
) -> Scene:
    """Of a path, or of the text itself (str that begins with "<", or bytes). The first link is static with fixed_base,
    or when it has no mass. What is not exact is a warning in the scene, with strict=True an error; what is wrong is an
    InvalidArgumentError that names file, line and element. inertia="from_shapes": links without one take that of their
    shapes, at 1000 kg/m3. Meshes (STL, OBJ) are looked for beside the file and in `folders`, and what begins with
    package:// in those that hold the package, or the file itself; they collide as their hulls, on a static base as they
    are."""
    if inertia not in ("from_file", "from_shapes"):
        raise InvalidArgumentError(f"inertia: from_file or from_shapes is needed, not {inertia!r}")
    text, file = read_source(source, "urdf")
    path = None if text is source else file
    return UrdfReader(file, strict, inertia, path, folders).robot(parse(text, file), fixed_base)


# ---- writing


def _origin(frame: Frame, indent: str) -> str:
    return f'{indent}<origin xyz="{row(frame.position)}" rpy="{row(angles_of(frame.rotation))}"/>\n'


def _mesh(body: SceneBody, shape: SceneShape, meshes: Dict[str, SceneMesh]) -> str:
    mesh = meshes.get(shape.mesh)
    if mesh is None or not mesh.file:
        raise UnsupportedError(
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
        elif shape.form == "mesh":
            form = _mesh(body, shape, meshes)
        else:
            form = f'<box size="{row([2 * x for x in shape.size])}"/>'
        text += f"    <collision>\n{_origin(frame, '      ')}      <geometry>{form}</geometry>\n    </collision>\n"
    return text + "  </link>\n"


def _joint(joint: SceneJoint, frames: Dict[str, Frame]) -> str:
    kind = WRITTEN.get(joint.type) or ("continuous" if joint.lower is None else "revolute")
    if kind == "prismatic" and joint.lower is None:
        raise UnsupportedError(f"save_urdf: joint {joint.name}: URDF has no slider without limits")
    if joint.a is None:
        raise UnsupportedError(f"save_urdf: joint {joint.name}: URDF has no joints with the world")
    child = frames[joint.b]
    if max(abs(x - y) for x, y in zip(joint.position, child.position)) > 1e-9:
        raise UnsupportedError(f"save_urdf: joint {joint.name}: URDF has joints at the origin of the child alone")
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


def save_urdf(scene: Scene) -> str:
    """The text of a scene that is one tree; loading it gives the scene again, up to rounding. Its meshes stay in their
    files."""
    meshes = {mesh.name: mesh for mesh in scene.meshes}
    frames = {body.name: Frame(body.position, body.rotation) for body in scene.bodies}
    for joint in scene.joints:
        if joint.type not in WRITTEN and joint.type != "hinge":
            raise UnsupportedError(f"save_urdf: joint {joint.name}: URDF has no {joint.type!r}")
    links = "".join(_link(body, meshes) for body in scene.bodies)
    joints = "".join(_joint(joint, frames) for joint in scene.joints)
    return f'<?xml version="1.0"?>\n<robot name="{escaped(scene.name)}">\n{links}{joints}</robot>\n'
