"""URDF, the format of ROS for robots (http://wiki.ros.org/urdf/XML), read into a Scene and written from one."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Set, Tuple

from .errors import InvalidArgumentError, SceneError
from .frames import (
    ORIGIN,
    Y_TO_Z,
    Frame,
    from_z,
    inside,
    multiply,
    normalized,
    principal,
    rotate,
    turn_of,
)
from .robot_mass import balanced, fuse, is_sound, of_ball
from .robot_mesh import find_file, read_mesh
from .robot_xml import Element, Reader, parse, read_source, row
from .scene import LEAST_LENGTH, LEAST_MASS, Scene
from .scene_records import SceneBody, SceneFrame, SceneJoint, SceneMesh, SceneShape
from .urdf_save import save_urdf as save_urdf  # with load_urdf

JOINTS = {
    "fixed": "fixed",
    "revolute": "hinge",
    "continuous": "hinge",
    "prismatic": "slider",
    "planar": "planar",
    "floating": "free",
    "spherical": "ball",  # PyBullet's
}
# what says nothing about motion
SILENT = {"visual", "material"}
FIELDS = {
    "robot": {"link", "joint", "mujoco"},
    "link": {"inertial", "collision"},
    "inertial": {"origin", "mass", "inertia"},
    "collision": {"origin", "geometry"},
    "geometry": {"box", "sphere", "cylinder", "capsule", "mesh", "plane"},
    "joint": {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"},
    "mujoco": {"compiler"},
}
MOST_WAY = 1e5  # m, of a slider with limits
QUIET = {"joint": {"calibration", "safety_controller"}}  # of the robot's drives, not of its motion


@dataclass
class Compiler:
    """What MuJoCo's own element in a file of ROS asks for. Visuals never count here, whatever discardvisual says."""

    balance: bool = False
    fuse: bool = False
    strip_path: bool = False
    mesh_folder: str = ""


@dataclass
class Link:
    """A body and where it is in the file; the joints that hang on it, with their frames in it."""

    body: SceneBody
    element: Element
    children: List[Tuple[SceneJoint, Frame, Element]] = field(default_factory=list)
    frame: Frame = field(default_factory=Frame)  # in the scene
    holder: Optional[SceneBody] = None  # itself, or that which has its shapes and its frame


class UrdfReader(Reader):
    """Reads one file."""

    def __init__(self, file: str, path: Optional[str], options: Dict[str, Any]):
        super().__init__(file, options["strict"])
        self.path, self.folders, self.inertia = path, options["folders"], options["inertia"]
        self.fixed_base, self.default_mass = options["fixed_base"], options["default_mass"]
        self.meshes: Dict[str, Optional[SceneMesh]] = {}  # None: it is not there
        self.links: Dict[str, Link] = {}
        self.compiler = Compiler()
        self.scene = Scene(warnings=self.warnings)

    def parts(self, element: Element) -> List[Element]:
        """The children that are read."""
        return self.known(element, FIELDS[element.tag], SILENT | QUIET.get(element.tag, set()))

    def vector(self, element: Element, name: str, usual: Sequence[float]) -> List[float]:
        """Three numbers. Commas between them count as spaces, numbers behind them are left out."""
        text = element.attributes.get(name, "")
        words = text.replace(",", " ").split()
        if len(words) > 3:
            self.tell_once(element, "attribute", f"{name}: numbers behind the third are left out")
        if "," in text:
            self.tell_once(element, "attribute", f"{name}: commas count as spaces")
        plain = Element(element.tag, {name: " ".join(words[:3])} if words else {}, element.line, element.file)
        return self.numbers(plain, name, 3, usual)

    def origin(self, element: Element) -> Frame:
        """Its <origin>; without one no turn and no way."""
        found = element.find("origin")
        if found is None:
            return Frame()
        x, y, z = self.vector(found, "xyz", ORIGIN)
        return Frame((x, y, z), turn_of(*self.vector(found, "rpy", ORIGIN)))

    def read_compiler(self, element: Element) -> None:
        """How MuJoCo is to read the file."""
        had, given = self.compiler, element.attributes
        truth = ("true", "false")
        had.balance = self.choice(element, "balanceinertia", truth, "false") == "true"
        had.fuse = self.choice(element, "fusestatic", truth, "false") == "true"
        had.strip_path = self.choice(element, "strippath", truth, "false") == "true"
        had.mesh_folder = given.get("meshdir", given.get("assetdir", ""))
        for name in sorted(set(given) - {"balanceinertia", "fusestatic", "strippath", "meshdir", "assetdir"}):
            if name not in ("discardvisual", "texturedir"):
                self.tell_once(element, "attribute", f"{name} is left out")

    # ---- links

    def mesh(self, form: Element) -> Optional[SceneMesh]:
        """A <mesh>, read once for each scale."""
        name, scale = self.need(form, "filename"), self.scale(form)
        key = name if scale == [1, 1, 1] else f"{name} {row(scale)}"
        if key not in self.meshes:
            self.meshes[key] = self.read_mesh(form, key, name, scale)
        return self.meshes[key]

    def scale(self, form: Element) -> List[float]:
        """Of a mesh: three numbers, or one for all."""
        is_one = len(form.attributes.get("scale", "").split()) == 1
        return self.numbers(form, "scale", 1) * 3 if is_one else self.vector(form, "scale", (1, 1, 1))

    def read_mesh(self, form: Element, key: str, name: str, scale: List[float]) -> Optional[SceneMesh]:
        """A mesh of a file; None: it is not there."""
        plain = os.path.basename(name) if self.compiler.strip_path else name
        places = [os.path.join(self.compiler.mesh_folder, plain), plain]
        file = next(filter(None, (find_file(place, self.path, self.folders) for place in places)), None)
        if file is None:
            self.warn(form, "mesh", f"there is no file {name!r}: it is left out")
            return None
        try:
            points, triangles = read_mesh(file, scale)
        except SceneError as error:
            self.warn(form, "mesh", f"{error}: it is left out")
            return None
        x, y, z = scale
        made = SceneMesh(key, points, triangles, name, (x, y, z))
        self.scene.meshes.append(made)
        return made

    def shape(self, element: Element) -> Optional[Tuple[SceneShape, Element]]:
        """A <collision>."""
        geometry = next((part for part in self.parts(element) if part.tag == "geometry"), None)
        if geometry is None or len(geometry.children) != 1:
            raise self.fail(element, "one form in <geometry> is needed")
        forms, frame = self.parts(geometry), self.origin(element)
        if not forms:
            return None
        form = forms[0]
        if form.tag == "mesh":
            mesh = self.mesh(form)
            if mesh is None:
                return None
            made = SceneShape("mesh", [], frame.position, frame.rotation, mesh=mesh.name)
        elif form.tag == "plane":
            normal = self.numbers(form, "normal", 3, (0, 0, 1))
            if math.hypot(*normal) < 1e-9:
                raise self.fail(form, "normal: a direction is needed")
            turn = multiply(multiply(frame.rotation, from_z(normal)), Y_TO_Z)
            made = SceneShape("plane", [], frame.position, turn)
        else:
            made = self.solid(form, frame)
        return made, form

    def solid(self, form: Element, frame: Frame) -> SceneShape:
        """A box, a ball, or what stands along z."""
        turn = frame.rotation
        if form.tag == "box":
            size = [0.5 * x for x in self.numbers(form, "size", 3)]
            if min(size) <= 0:
                raise self.fail(form, "size: more than 0 is needed")
        elif form.tag == "sphere":
            size = [self.positive(form, "radius")]
        else:
            size = [0.5 * self.positive(form, "length"), self.positive(form, "radius")]
            turn = frame.then(Frame(ORIGIN, Y_TO_Z)).rotation
        if min(size) < LEAST_LENGTH:
            self.tell_once(form, "size", f"collides as if no half of it were under {LEAST_LENGTH} m")
        return SceneShape(form.tag, size, frame.position, turn)

    def inertial(self, body: SceneBody, element: Element) -> None:
        """Mass, centre and inertia of a link; none where the mass is 0."""
        parts = {part.tag: part for part in reversed(self.parts(element))}
        if "mass" not in parts:
            raise self.fail(element, "mass and inertia are needed")
        mass, frame = self.number(parts["mass"], "value"), self.origin(element)
        if mass < 0:
            raise self.fail(parts["mass"], f"value: a mass is not negative, {mass} is")
        if mass == 0:
            return
        body.mass, body.centre = mass, frame.position
        moments, turn = (0.0, 0.0, 0.0), frame.rotation
        if "inertia" in parts:
            tensor = parts["inertia"]
            xx, yy, zz = (self.number(tensor, name) for name in ("ixx", "iyy", "izz"))
            xy, xz, yz = (self.number(tensor, name, 0.0) for name in ("ixy", "ixz", "iyz"))
            moments, own = principal([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            turn = frame.then(Frame(ORIGIN, own)).rotation
        if not is_sound(moments):
            moments = self.balance(parts.get("inertia", element), body, moments)
        body.inertia, body.inertia_rotation = moments, turn
        if mass < LEAST_MASS:
            self.warn(element, "mass", f"{body.name!r}: {mass} kg moves as {LEAST_MASS} kg")

    def balance(self, element: Element, body: SceneBody, moments: Any) -> Any:
        """What no body can have, replaced: that is what the file asks for, or a warning."""
        made = balanced(moments, body.mass or 0.0)
        if not self.compiler.balance or not sum(moments) > 0:
            told = ", ".join(f"{x:.6g}" for x in moments)
            self.warn(
                element,
                "mass",
                f"{body.name!r}: no body has the moments {told} kg m2 (each is above 0, none above the sum of the "
                f"others): {made[0]:.6g} for each",
            )
        return made

    def link(self, element: Element) -> None:
        """A body at the origin."""
        body = SceneBody(self.need(element, "name"))
        if body.name in self.links:
            raise self.fail(element, f"a second link has the name {body.name!r}")
        self.links[body.name] = Link(body, element)
        has_mass = False
        for child in self.parts(element):
            if child.tag == "inertial" and not has_mass:
                self.inertial(body, child)
                has_mass = True
        if body.mass is None and self.inertia == "from_shapes" and element.find("collision") is not None:
            self.tell_once(element, "mass", "without an inertial its mass is that of its shapes, of 1000 kg/m3")

    def shapes(self, link: Link, body: SceneBody) -> None:
        """Its forms, for the body that has them."""
        at = inside(Frame(body.position, body.rotation), link.frame)
        for child in link.element.children:
            found = self.shape(child) if child.tag == "collision" else None
            if found is None:
                continue
            shape, form = found
            if body.type == "dynamic" and shape.form == "plane":
                self.warn(form, "element", "a plane that moves is left out")
                continue
            if body.type == "dynamic" and shape.form == "mesh":
                self.tell_once(form, "hull", "meshes of bodies that move collide as their hulls")
            if at != Frame():
                frame = at.then(Frame(shape.position, shape.rotation))
                shape.position, shape.rotation = frame.position, frame.rotation
            body.shapes.append(shape)

    # ---- joints

    def joint(self, element: Element) -> Tuple[SceneJoint, Frame]:
        """A joint in the frame of its parent, and that frame."""
        self.parts(element)
        kind, parent, child = self.need(element, "type"), element.find("parent"), element.find("child")
        if kind == "spherical":
            self.tell_once(element, "joint", "spherical, which ROS has not: a ball")
        if kind not in JOINTS:
            raise self.fail(element, f"type: one of {', '.join(JOINTS)} is needed, not {kind[:60]!r}")
        if parent is None or child is None:
            raise self.fail(element, "parent and child are needed")
        name = self.need(element, "name")
        mimic, axis = element.find("mimic"), element.find("axis")
        if mimic is not None:
            self.warn(mimic, "joint", f"{name!r} moves freely: no joint follows another one")
        along: Sequence[float] = (1.0, 0.0, 0.0)
        if axis is not None and JOINTS[kind] in ("hinge", "slider", "planar"):
            along = self.vector(axis, "xyz", along)
            if math.hypot(*along) < 1e-9:
                raise self.fail(axis, "xyz: a direction is needed")
        made = SceneJoint(name, JOINTS[kind], self.need(parent, "link"), self.need(child, "link"), ORIGIN)
        made.axis = normalized(along)  # type: ignore[assignment]
        self.limits(made, kind, element)
        dynamics = element.find("dynamics")
        if dynamics is not None and kind != "fixed":
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
        if kind == "fixed":
            return
        joint.effort = self.number(limit, "effort", 0.0) or None
        joint.velocity = self.number(limit, "velocity", 0.0) or None
        if kind not in ("revolute", "continuous", "prismatic"):
            return
        lower, upper = self.number(limit, "lower", 0.0), self.number(limit, "upper", 0.0)
        most, told = (MOST_WAY, f"{MOST_WAY:.0f} m") if kind == "prismatic" else (math.pi, "half a turn")
        has_limits = lower < upper and max(-lower, upper) <= most
        if kind == "continuous":
            if has_limits:
                self.warn(limit, "limit", f"{joint.name!r} is continuous and has limits: they count, as in MuJoCo")
        elif lower >= upper:
            self.warn(limit, "limit", f"{joint.name!r}: lower {lower} is not below upper {upper}: it has no limits")
        elif not has_limits:
            self.warn(limit, "limit", f"{joint.name!r}: beyond {told}: it has no limits")
        if has_limits:
            joint.lower, joint.upper = lower, upper

    # ---- all of it

    def robot(self, root: Element) -> Scene:
        """The tree of links, each at the place that it has when all joints are at 0."""
        if root.tag != "robot":
            raise self.fail(root, "<robot> is needed")
        parts = self.parts(root)
        for element in parts:
            if element.tag == "mujoco":
                for child in self.parts(element):
                    self.read_compiler(child)
        for element in parts:
            if element.tag == "link":
                self.link(element)
        has_parent: Set[str] = set()
        names: Set[str] = set()
        for element in parts:
            if element.tag == "joint":
                self.hang(element, has_parent, names)
        roots = [name for name in self.links if name not in has_parent]
        self.scene.name = root.attributes.get("name", "")
        if not self.links:
            self.warn(root, "element", "has no links")
            return self.scene
        if len(roots) != 1:
            raise self.fail(root, f"one link without a parent is needed, not {len(roots)}")
        self.tree(root, self.links[roots[0]])
        return self.scene

    def hang(self, element: Element, has_parent: Set[str], names: Set[str]) -> None:
        """A joint on its parent."""
        joint, frame = self.joint(element)
        for name in (joint.a, joint.b):
            if name not in self.links:
                raise self.fail(element, f"there is no link {name!r}")
        if joint.b in has_parent:
            raise self.fail(element, f"{joint.b!r} has two parents")
        if joint.name in names:
            raise self.fail(element, f"a second joint has the name {joint.name!r}")
        has_parent.add(joint.b)
        names.add(joint.name)
        self.links[joint.a or ""].children.append((joint, frame, element))

    def has_mass(self, link: Link) -> bool:
        """Of its own, or of its shapes where these count."""
        from_shapes = self.inertia == "from_shapes" and link.element.find("collision") is not None
        return link.body.mass is not None or from_shapes

    def tree(self, root: Element, first: Link) -> None:
        """From the base outwards. A link without mass is a frame of what it is fixed to."""
        order, at = [first], 0
        while at < len(order):
            link = order[at]
            for joint, frame, _ in link.children:
                child = self.links[joint.b]
                child.frame = link.frame.then(frame)
                order.append(child)
            at += 1
        if len(order) != len(self.links):
            raise self.fail(root, "joints make a circle")
        for link in order:
            link.body.position, link.body.rotation = link.frame.position, link.frame.rotation
        if self.fixed_base or not self.has_mass(first):
            first.body.type = "static"
        first.holder = first.body
        self.scene.bodies.append(first.body)
        self.shapes(first, first.body)
        for link in order:
            for joint, _, element in link.children:
                self.place(link, joint, element)

    def place(self, parent: Link, joint: SceneJoint, element: Element) -> None:
        """A link, whose parent has its place."""
        link, held = self.links[joint.b], parent.holder
        assert held is not None
        is_new = link.holder is None
        if link.holder is not None:
            joint_is_needed = False  # the body of its massless parent, which has the joint already
        elif joint.type == "fixed" and (not self.has_mass(link) or self.compiler.fuse):
            joint_is_needed = False
            link.holder = held
            if held.type == "dynamic" and link.body.mass is not None:
                at = inside(Frame(held.position, held.rotation), link.frame)
                fuse(held, link.body, at)
        else:
            joint_is_needed = True
            link.holder = self.moving(link).body
        if joint_is_needed:
            joint.a, joint.b = held.name, link.holder.name
            joint.position = link.frame.position
            joint.axis = normalized(rotate(link.frame.rotation, joint.axis))  # type: ignore[assignment]
            self.scene.joints.append(joint)
            self.scene.bodies.append(link.holder)
        if link.holder is not link.body:
            at = inside(Frame(link.holder.position, link.holder.rotation), link.frame)
            self.scene.frames.append(SceneFrame(link.body.name, link.holder.name, at.position, at.rotation))
        if is_new or link.holder is link.body:
            self.shapes(link, link.holder)

    def moving(self, link: Link) -> Link:
        """Which link a joint moves: this one, or the first with a mass that is fixed to it."""
        if self.has_mass(link):
            return link
        waiting = [link]
        while waiting:
            one = waiting.pop(0)
            if self.has_mass(one):
                self.links[one.body.name].holder = one.body
                return one
            waiting += [self.links[joint.b] for joint, _, _ in one.children if joint.type == "fixed"]
        if self.default_mass is None:
            raise self.fail(
                link.element,
                f"{link.body.name!r} moves and has no inertial (default_mass= gives it a mass, inertia='from_shapes' "
                "that of its shapes)",
            )
        link.body.mass, link.body.inertia = self.default_mass, of_ball(self.default_mass)
        self.warn(link.element, "mass", f"{link.body.name!r} moves and has no inertial: {self.default_mass} kg")
        return link


def load_urdf(
    source: Any,
    *,
    fixed_base: bool = False,
    strict: bool = False,
    inertia: str = "from_file",
    folders: Sequence[Any] = (),
    default_mass: Optional[float] = None,
) -> Scene:
    """Of a path, or of the text itself (str that begins with "<", or bytes). The first link is static with fixed_base,
    or when it has no mass. A link without mass is a frame of what it is fixed to: scene.frame("tool0"). One that moves
    is an error, or gets default_mass, kg, as a ball of water. inertia="from_shapes": links without one take that of
    their shapes, at 1000 kg/m3.

    What is not exact is a warning in scene.warnings, as (file, line, kind, sentence), with strict=True an error; what is
    wrong is a SceneError that names file, line and element. Meshes (STL, OBJ, DAE) are looked for beside the file and in
    `folders`, and what begins with package:// in those that hold the package, or the file itself. Where folders are
    given, no file outside of them and of the robot's own folder is read; a text without folders reads none. Meshes
    collide as their hulls, on a static base as they are."""
    if inertia not in ("from_file", "from_shapes"):
        raise InvalidArgumentError(f"inertia: from_file or from_shapes is needed, not {inertia!r}")
    if default_mass is not None and not LEAST_MASS <= default_mass < math.inf:
        raise InvalidArgumentError(f"default_mass: at least {LEAST_MASS} kg are needed, not {default_mass}")
    text, file = read_source(source, "urdf")
    options = dict(strict=strict, folders=folders, inertia=inertia, fixed_base=fixed_base, default_mass=default_mass)
    return UrdfReader(file, None if text is source else file, options).robot(parse(text, file))
