"""MJCF, the format of MuJoCo for models (https://mujoco.readthedocs.io/en/stable/XMLreference.html), read into a Scene
and written from one."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Optional, Sequence, Set, Tuple, Union

from .errors import SceneError, UnsupportedSceneError
from .frames import ORIGIN, Frame, Triple, Turn, cross, from_z, inside, normalized, of_axes, principal, rotate
from .mjcf_expand import MOST_INCLUDED, SUFFIX, Expander, include, read_model
from .mjcf_geoms import GRAVITY, GeomReader, Model
from .mjcf_save import LETTERS, WORLD
from .mjcf_save import save_mjcf as save_mjcf  # with load_mjcf, as in urdf
from .robot_mass import Geom, balanced, combine, fuse, is_sound
from .robot_xml import Element, parse, read_source
from .scene import LEAST_MASS, Scene
from .scene_records import SceneActuator, SceneBody, SceneFrame, SceneFreedom, SceneJoint

# what says nothing about motion
SILENT = {"visual", "statistic", "size", "custom", "sensor", "camera", "light", "material", "texture"}
SILENT |= {"extension", "default", "option", "compiler", "asset", "contact", "equality", "actuator", "worldbody"}
ACTUATORS = {"motor", "position", "velocity"}
SECTIONS = {"compiler", "option", "default", "asset", "worldbody", "contact", "equality", "actuator"}
BODY = {"inertial", "joint", "freejoint", "geom", "body", "frame", "attach", "site"}
FIELDS = {"worldbody": {"body", "geom", "frame", "attach", "site"}, "body": BODY, "frame": BODY - {"inertial"}}
FIELDS["asset"], FIELDS["contact"], FIELDS["equality"] = {"mesh", "model"}, {"exclude"}, {"connect", "weld"}
FIELDS["actuator"] = ACTUATORS
JOINTS = {"hinge": "hinge", "slide": "slider", "ball": "ball", "free": "free"}


@dataclass
class Place:
    """Whose children are read: the body (None: the world's own), its frame, and the class of those that name none."""

    parent: Optional[SceneBody]
    frame: Frame = field(default_factory=Frame)
    child_class: Optional[str] = None


class MjcfReader(GeomReader):
    """Reads one file."""

    models: Dict[str, Element]  # files to attach, by name
    sites: List[SceneFrame]
    massless: Dict[str, Element]  # bodies that move, until one that is fixed to them has a mass
    written: Set[str]  # names that the file has

    def name(self, element: Element, kind: str, usual: str) -> str:
        """Its name, which is the only one of its kind. Without one, the usual one or what follows it."""
        names = self.model.names[kind]
        if "name" in element.attributes:
            name = self.full(element.attributes["name"])
            if name in names:
                raise self.fail(element, f"a second {kind} has the name {name[:60]!r}")
        else:
            name, count = usual, len(names)
            while name in names or name in self.written:
                name, count = f"{usual}{count}", count + 1
        names.add(name)
        return name

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
            self.warn(element, "limit", "beyond half a turn: the joint has no limits")
            lower = upper = None
        made = SceneFreedom(name, axis, lower, upper)
        made.damping, made.friction = self.number(element, "damping", 0.0), self.number(element, "frictionloss", 0.0)
        made.stiffness, made.armature = self.number(element, "stiffness", 0.0), self.number(element, "armature", 0.0)
        if min(made.damping, made.friction, made.stiffness, made.armature) < 0:
            raise self.fail(element, "damping, frictionloss, stiffness and armature are not negative")
        made.rest = (self.number(element, "springref", 0.0) - self.number(element, "ref", 0.0)) * factor
        if is_hinge and abs(made.rest) > math.pi and made.stiffness > 0:
            self.tell_once(element, "limit", "springref beyond half a turn: whole turns do not count")
        if made.armature > 0:
            told = "counts as inertia of the body about the axis" if is_hinge else "of a slide is left out"
            self.tell_once(element, "joint", f"armature {told}")
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
        place = frame.then(at.then(self.place_of(first))).position
        made = SceneJoint(names[0], JOINTS[kinds[0]], parent, body.name, place)
        if "free" in kinds:
            if len(kinds) > 1 or parent is not None:
                raise self.fail(first, "a free joint is the only one of a body of the world")
            made.position = body.position
            return made
        if kinds == ["ball"]:
            self.ball(first, made)
            return made
        axes = [rotate(frame.then(at).rotation, self.direction(element)) for element, at in elements]
        if len(kinds) > 1:
            letters = None if "ball" in kinds else self.letters(axes)
            pairs = [(k, letter) for k, (letter, _) in zip(kinds, letters[1])] if letters else []
            if letters is None or len(set(pairs)) < len(pairs):
                return self.chain(elements, kinds, names, axes, frame, made)
            return self.configurable(elements, kinds, names, letters, frame, made)
        made.axis = axes[0]
        one = self.moving(first, names[0], "linear_x" if kinds[0] == "slide" else "angular_x", 1.0)
        for name in ("lower", "upper", "damping", "friction", "stiffness", "rest", "armature"):
            setattr(made, name, getattr(one, name))
        return made

    def is_fixed(self, element: Element) -> bool:
        """Of a type that PyBullet knows: it moves nothing."""
        if element.attributes.get("type") != "fixed":
            return False
        self.tell_once(element, "element", "of type fixed is left out")
        return True

    def place_of(self, element: Element) -> Frame:
        """Its pos."""
        x, y, z = self.numbers(element, "pos", 3, ORIGIN)
        return Frame((x, y, z))

    def ball(self, element: Element, made: Union[SceneJoint, SceneFreedom]) -> None:
        """A ball; its range is the angle to the rest position."""
        own = {**element.attributes, "limited": "false"}
        one = self.moving(Element(element.tag, own, element.line, element.file), "", "angular_x", 1.0)
        made.damping, made.friction, made.stiffness = one.damping, one.friction, one.stiffness
        _, upper = self.limits(element, self.angle(1.0))
        if upper is not None:
            self.tell_once(element, "joint", "the range of a ball is taken as a cone about its axis")
            if not 0.01 <= upper <= math.pi:
                raise self.fail(element, f"range: 0.01 to pi is needed, not {upper}")
            made.cone = upper

    def chain(
        self,
        elements: List[Tuple[Element, Frame]],
        kinds: List[str],
        names: List[str],
        axes: List[Triple],
        frame: Frame,
        made: SceneJoint,
    ) -> SceneJoint:
        """Several joints of a body, whose axes are askew, one after another."""
        made.type, made.axis = "chain", (1.0, 0.0, 0.0)
        for (element, at), kind, name, axis in zip(elements, kinds, names, axes):
            if kind == "ball":
                one = SceneFreedom(name, "ball")
                self.ball(element, one)
            else:
                one = self.moving(element, name, "linear_x" if kind == "slide" else "angular_x", 1.0)
                one.axis = one.axis[:-2]
            one.position, one.direction = frame.then(at.then(self.place_of(element))).position, axis
            made.freedoms.append(one)
        return made

    def configurable(
        self,
        elements: List[Tuple[Element, Frame]],
        kinds: List[str],
        names: List[str],
        letters: Tuple[Turn, List[Tuple[str, float]]],
        frame: Frame,
        made: SceneJoint,
    ) -> SceneJoint:
        """Several joints on a body, as one: along axes that are square to one another."""
        made.type, made.rotation = "configurable", letters[0]
        for (element, at), kind, name, (letter, sign) in zip(elements, kinds, names, letters[1]):
            axis = f"{'linear' if kind == 'slide' else 'angular'}_{letter}"
            made.freedoms.append(self.moving(element, name, axis, sign))
            apart = math.dist(made.position, frame.then(at.then(self.place_of(element))).position)
            if kind == "hinge" and apart > 1e-9:
                self.warn(element, "joint", f"its axis is moved by {apart:.3g} m, to that of {names[0]!r}")
        if sum(kind == "hinge" for kind in kinds) > 1:
            told = "several hinges of a body are one joint: their angles are those of its frame"
            self.tell_once(elements[0][0], "joint", told)
        return made

    def letters(self, axes: List[Triple]) -> Optional[Tuple[Turn, List[Tuple[str, float]]]]:
        """A frame whose axes, or their opposites, the given ones are, and which. None: they are askew."""
        known: List[Triple] = []
        found: List[Tuple[str, float]] = []
        for axis in axes:
            along = [sum(a * b for a, b in zip(axis, other)) for other in known]
            match = next((i for i, cosine in enumerate(along) if abs(cosine) > 1 - 1e-6), None)
            if match is None:
                if any(abs(cosine) > 1e-3 for cosine in along):
                    return None
                match, along = len(known), [*along, 1.0]
                known.append(axis)
                if len(known) == 2:
                    known.append(cross(known[0], axis))  # the third is known then
                    match = 1
            found.append((LETTERS[match], math.copysign(1.0, along[match])))
        second = known[1] if len(known) > 1 else rotate(from_z(known[0]), (1.0, 0.0, 0.0))
        return of_axes(known[0], second), found

    # ---- masses

    def inertial(self, element: Element, at: Frame) -> Optional[Tuple[float, Frame, Triple]]:
        """Mass, centre and principal axes, moments; None: no mass."""
        mass, frame = self.number(element, "mass"), at.then(self.pose(element))
        if mass < 0:
            raise self.fail(element, f"mass: it is not negative, {mass} is")
        if mass == 0:
            return None
        if "fullinertia" in element.attributes:
            xx, yy, zz, xy, xz, yz = self.numbers(element, "fullinertia", 6)
            moments, turn = principal([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            frame = frame.then(Frame(ORIGIN, turn))
        else:
            x, y, z = self.numbers(element, "diaginertia", 3)
            moments = (x, y, z)
        if not is_sound(moments):
            told = f"no body has the moments {moments}: each is above 0, none above the sum of the others"
            if min(moments) < 0 or (2 * max(moments) > sum(moments) * (1 + 1e-6) and not self.compiler.balance):
                raise self.fail(element, f"{told} (balanceinertia makes them so)")
            moments = balanced(moments, mass)
            if not self.compiler.balance:
                self.warn(element, "mass", f"{told}: {', '.join(f'{x:.6g}' for x in moments)}")
        return mass, frame, moments

    def weigh(self, body: SceneBody, inertial: Optional[Tuple[Element, Frame]], geoms: List[Geom]) -> None:
        """Its shapes and its mass."""
        body.shapes = [geom.shape for geom in geoms if geom.shape is not None]
        if inertial is not None and self.compiler.inertia_from_geom != "true":
            found = self.inertial(*inertial)
            if found is not None:
                body.mass, frame, body.inertia = found
                body.centre, body.inertia_rotation = frame.position, frame.rotation
        else:
            combine(body, [geom for geom in geoms if geom.mass > 0])
        if body.mass is not None:
            body.mass = max(body.mass, self.compiler.least_mass)
            x, y, z = (max(moment, self.compiler.least_inertia) for moment in body.inertia)
            body.inertia = x, y, z

    def is_weighed(self, body: SceneBody, inertial: Any) -> bool:
        """Does the mass of its geoms count?"""
        mode = self.compiler.inertia_from_geom
        if body.type != "dynamic" and self.compiler.total_mass <= 0:
            return False
        return mode == "true" or (mode == "auto" and inertial is None)

    def set_total(self) -> None:
        """All masses times one number, so that they are the total that the file asks for."""
        heavy = [body for body in self.scene.bodies if body.mass is not None]
        total = sum(body.mass or 0.0 for body in heavy) + self.model.lost_mass
        if self.compiler.total_mass <= 0 or not total > 0:
            return
        share = self.compiler.total_mass / total
        for body in heavy:
            body.mass = share * (body.mass or 0.0)
            x, y, z = body.inertia
            body.inertia = share * x, share * y, share * z

    # ---- bodies

    def parts(
        self, element: Element, at: Frame, child_class: Optional[str]
    ) -> Iterator[Tuple[Element, Frame, Optional[str]]]:
        """The children of a body, those in its <frame>s too, with their frame and class."""
        for child in self.known(element, FIELDS[element.tag], SILENT):
            if child.tag == "frame":
                yield from self.parts(child, at.then(self.pose(child)), child.attributes.get("childclass", child_class))
            else:
                yield child, at, child_class

    def body(self, element: Element, at: Frame, place: Place) -> None:
        """A body and those that hang on it."""
        child_class = element.attributes.get("childclass", place.child_class)
        is_free = self.compiler.is_global and not {"pos", "quat", "euler", "axisangle"} & set(element.attributes)
        frame = self.of_geoms(element, child_class) if is_free else place.frame.then(at).then(self.pose(element))
        name = self.name(element, "body", f"body{len(self.model.names['body'])}")
        body = SceneBody(name, "static", frame.position, frame.rotation)
        # where all places are the world's, the body's own frame is taken back
        origin = inside(frame, Frame()) if self.compiler.is_global else Frame()
        inner = list(self.parts(element, origin, child_class))
        joints = [
            (self.with_defaults(child, own) if child.tag == "joint" else child, to)
            for child, to, own in inner
            if child.tag in ("joint", "freejoint") and not self.is_fixed(child)
        ]
        holder = place.parent
        if joints or (holder is not None and holder.type == "dynamic"):
            body.type = "dynamic"
        elif self.choice(element, "mocap", ("true", "false"), "false") == "true":
            body.type = "kinematic"
        inertial = next(((child, to) for child, to, _ in inner if child.tag == "inertial"), None)
        weighed = self.is_weighed(body, inertial)
        geoms = [
            self.geom(self.with_defaults(child, own), to, weighed) for child, to, own in inner if child.tag == "geom"
        ]
        self.weigh(body, inertial, [geom for geom in geoms if geom])
        self.model.frames[body.name] = frame
        own_body = self.placed_body(element, body, joints, holder)
        for child, to, own_class in inner:
            within = Place(own_body, frame, own_class)
            if child.tag == "body":
                self.body(child, to, within)
            elif child.tag == "attach":
                self.attach(child, to, within)
            elif child.tag == "site":
                self.site(child, to, within)
        if body.name in self.massless:
            raise self.fail(element, f"{body.name!r} moves and has no mass, nor has a body that is fixed to it")

    def of_geoms(self, element: Element, child_class: Optional[str]) -> Frame:
        """Where places are the world's, a body without one has that of its mass."""
        body = SceneBody("")
        inner = list(self.parts(element, Frame(), child_class))
        found = [self.geom(self.with_defaults(child, own), to, True) for child, to, own in inner if child.tag == "geom"]
        geoms = [geom for geom in found if geom is not None and geom.mass > 0]
        combine(body, geoms)
        return Frame(body.centre, geoms[0].frame.rotation if len(geoms) == 1 else body.inertia_rotation)

    def placed_body(
        self, element: Element, body: SceneBody, joints: List[Tuple[Element, Frame]], holder: Optional[SceneBody]
    ) -> Optional[SceneBody]:
        """The body in the scene with its joint, or that which it is a part of: what has no mass, or hangs on a body that
        the program moves."""
        is_massless = body.type == "dynamic" and body.mass is None
        takes = holder is not None and (is_massless or holder.type == "kinematic" or holder.name in self.massless)
        if holder is not None and not joints and takes:
            to = inside(Frame(holder.position, holder.rotation), Frame(body.position, body.rotation))
            for shape in body.shapes:
                frame = to.then(Frame(shape.position, shape.rotation))
                shape.position, shape.rotation = frame.position, frame.rotation
                holder.shapes.append(shape)
            if holder.type == "kinematic":
                self.model.lost_mass += body.mass or 0.0
            if holder.name in self.massless and body.mass is not None:
                fuse(holder, body, to)
                del self.massless[holder.name]
            self.scene.frames.append(SceneFrame(body.name, holder.name, to.position, to.rotation))
            return holder
        if body.type == "dynamic" and any(shape.form == "plane" for shape in body.shapes):
            raise self.fail(element, f"{body.name!r} moves and has a plane")
        if body.mass is not None and body.mass < LEAST_MASS:
            self.warn(element, "mass", f"{body.name!r}: {body.mass:.3g} kg moves as {LEAST_MASS} kg")
        if is_massless:
            self.massless[body.name] = element
        parent = None if holder is None or holder.name == WORLD else holder.name
        self.scene.bodies.append(body)
        if joints:
            self.scene.joints.append(self.joint(joints, body, parent))
        elif body.type == "dynamic":
            name = self.name(Element("joint", {}, element.line), "joint", f"{body.name}_weld")
            self.scene.joints.append(SceneJoint(name, "fixed", parent, body.name, body.position))
        return body

    def site(self, element: Element, at: Frame, place: Place) -> None:
        """A frame of the body, where no body or other site has its name."""
        name = self.full(element.attributes.get("name", ""))
        if "name" not in element.attributes or name in self.model.names["frame"]:
            return
        self.model.names["frame"].add(name)
        holder = place.parent
        try:
            frame = place.frame.then(at).then(self.site_pose(self.with_defaults(element, place.child_class)))
        except SceneError:
            if self.strict:
                raise
            return  # of a site nothing depends
        held = None if holder is None or holder.name == WORLD else holder.name
        if held is not None and holder is not None:
            frame = inside(Frame(holder.position, holder.rotation), frame)
        self.sites.append(SceneFrame(name, held, frame.position, frame.rotation))

    def site_pose(self, element: Element) -> Frame:
        """In the middle of its ends, or as others."""
        if "fromto" not in element.attributes:
            return self.pose(element)
        ends = self.numbers(element, "fromto", 6)
        way = [b - a for a, b in zip(ends[:3], ends[3:])]
        if math.hypot(*way) < 1e-9:
            raise self.fail(element, "fromto: two places are needed")
        x, y, z = ((a + b) / 2 for a, b in zip(ends[:3], ends[3:]))
        return Frame((x, y, z), from_z(way))

    def attach(self, element: Element, at: Frame, place: Place) -> None:
        """A body of another file, or all of its bodies, with that file's settings; its names get a prefix."""
        name = element.attributes.get("model")
        if name not in self.models:
            raise self.fail(element, "model: a <model> of <asset> is needed", UnsupportedSceneError)
        self.model.files += 1
        if self.model.files > MOST_INCLUDED:
            raise self.fail(element, f"{MOST_INCLUDED} files are the most")
        root = read_model(self, self.models[name], self.path, self.folders)
        file = root.file
        prefix, suffix = self.prefix + element.attributes.get("prefix", ""), element.attributes.get(SUFFIX, "") + self.suffix
        path = None if self.path is None and not self.folders else file
        child = MjcfReader(file, self.strict, path, self.folders, self.model, prefix, suffix)
        child.open(root)
        wanted = element.attributes.get("body")
        found = 0
        for section in root.children:
            for one, to, own in child.parts(section, Frame(), None) if section.tag == "worldbody" else ():
                within = Place(place.parent, place.frame, own)
                if one.tag == "attach" and wanted is None:
                    child.attach(one, at.then(to), within)
                found += child.attached(one, wanted, at.then(to), within)
        if wanted is not None and not found:
            raise self.fail(element, f"there is no body {wanted[:60]!r} in {file}")
        child.sections(root, is_attached=True)

    def attached(self, element: Element, wanted: Optional[str], at: Frame, place: Place) -> int:
        """How many bodies were read: this one, or that which is wanted, within it."""
        if wanted is None or element.attributes.get("name") == wanted:
            if element.tag == "body":
                self.body(element, at, place)
            return element.tag == "body"
        inner = self.parts(element, at, None) if element.tag in ("body", "frame") else ()
        return sum(self.attached(one, wanted, at, place) for one, _, _ in inner if one.tag == "body")

    # ---- all of it

    def open(self, root: Element) -> None:
        """Reads what the rest of a file depends on."""
        if root.tag not in ("mujoco", "mujocoinclude"):
            raise self.fail(root, "<mujoco> is needed")
        include(self, root, self.path, self.folders)
        self.models, self.sites, self.massless = {}, [], {}
        sections = self.known(root, SECTIONS, SILENT)
        for element in sections:
            if element.tag == "compiler":
                self.read_compiler(element)
            elif element.tag == "default":
                self.read_default(element, None)
        Expander(self, root, self.euler).all()
        self.written = set(_names(root))
        for element in sections:
            for child in self.known(element, FIELDS["asset"], SILENT | {"hfield"}) if element.tag == "asset" else ():
                if child.tag == "mesh":
                    made = self.with_defaults(child, None)
                    usual = os.path.splitext(os.path.basename(made.attributes.get("file", "")))[0]
                    self.assets[made.attributes.get("name", usual)] = made
                elif "name" in child.attributes:
                    self.models[child.attributes["name"]] = child
                else:
                    root_of = read_model(self, child, self.path, self.folders)
                    self.models[root_of.attributes.get("model", "")] = child

    def read(self, root: Element) -> Scene:
        """The scene."""
        self.open(root)
        self.scene.name = root.attributes.get("model", "")
        world = SceneBody(WORLD, "static")
        for element in root.children:
            if element.tag == "option" and "gravity" in element.attributes:
                x, y, z = self.numbers(element, "gravity", 3)
                self.scene.gravity = (x, y, z)
            elif element.tag == "worldbody":
                self.read_world(element, world)
        if world.shapes:
            self.scene.bodies.insert(0, world)
        self.sections(root)
        self.set_total()
        return self.scene

    def read_world(self, element: Element, world: SceneBody) -> None:
        """<worldbody>."""
        for child, at, child_class in self.parts(element, Frame(), element.attributes.get("childclass")):
            place = Place(world, Frame(), child_class)
            if child.tag == "body":
                self.body(child, at, place)
            elif child.tag == "attach":
                self.attach(child, at, place)
            elif child.tag == "site":
                self.site(child, at, place)
            elif child.tag == "geom":
                geom = self.geom(self.with_defaults(child, child_class), at, False)
                world.shapes += [geom.shape] if geom and geom.shape else []
            else:
                self.tell_once(child, "element", "is left out in <worldbody>")

    def sections(self, root: Element, is_attached: bool = False) -> None:
        """What refers to bodies and joints. Of an attached file what refers to those that were not attached is none."""
        for element in root.children:
            if element.tag in ("contact", "equality", "actuator"):
                for child in self.known(element, FIELDS[element.tag], SILENT):
                    if not is_attached or self.is_whole(child):
                        getattr(self, element.tag)(child)
        taken = {frame.name for frame in self.scene.frames} | {body.name for body in self.scene.bodies}
        self.scene.frames += [site for site in self.sites if site.name not in taken]

    def is_whole(self, element: Element) -> bool:
        """Is all there that it refers to?"""
        given, names = element.attributes, self.model.names
        bodies = [given[key] for key in ("body1", "body2") if given.get(key, WORLD) != WORLD]
        joints = [given["joint"]] if "joint" in given else []
        return all(self.full(x) in names["body"] for x in bodies) and all(self.full(x) in names["joint"] for x in joints)

    def body_named(self, element: Element, name: str) -> Optional[str]:
        """A body of the scene; None: the world. A frame stands for the body that has it."""
        given = self.need(element, name)
        if given == WORLD:
            return None
        found = self.full(given)
        found = next((frame.body or "" for frame in self.scene.frames if frame.name == found), found)
        if found not in {body.name for body in self.scene.bodies}:
            raise self.fail(element, f"there is no body {found[:60]!r}")
        return found

    def contact(self, element: Element) -> None:
        """<exclude>."""
        a, b = (self.body_named(element, name) or WORLD for name in ("body1", "body2"))
        if a != b and (WORLD not in (a, b) or self.scene.bodies[0].name == WORLD):
            self.scene.excluded.append((a, b))

    def equality(self, element: Element) -> None:
        """<connect> and <weld>."""
        if "body1" not in element.attributes:
            self.tell_once(element, "element", "of sites is left out")
            return
        if self.choice(element, "active", ("true", "false"), "true") == "false":
            self.tell_once(element, "element", "that is not active is left out")
            return
        first = self.body_named(element, "body1")
        second = self.body_named(element, "body2") if "body2" in element.attributes else None
        if "relpose" in element.attributes:
            self.tell_once(element, "attribute", "relpose is left out: the bodies are held as they stand")
        name = self.name(element, "joint", f"equality{len(self.model.names['joint'])}")
        at = self.model.frames.get(self.full(element.attributes["body1"]), Frame())
        if element.tag == "connect":
            x, y, z = self.numbers(element, "anchor", 3)
            at = (Frame() if self.compiler.is_global else at).then(Frame((x, y, z)))
        moving = {body.name for body in self.scene.bodies if body.type == "dynamic"}
        if first not in moving:
            first, second = second, first
        if first is None or first == second:
            raise self.fail(element, "two bodies are needed")
        if element.tag == "weld":
            at = next(Frame(body.position) for body in self.scene.bodies if body.name == first)
        kind = "ball" if element.tag == "connect" else "fixed"
        self.scene.joints.append(SceneJoint(name, kind, second, first, at.position))

    def actuator(self, element: Element) -> None:
        """<motor>, <position>, <velocity> of a joint."""
        made = self.with_defaults(element, None)
        if "joint" not in made.attributes:
            self.tell_once(element, "element", "is left out: motor, position and velocity of a joint are read")
            return
        joint = self.full(made.attributes["joint"])
        if joint not in self.model.names["joint"]:
            raise self.fail(element, f"there is no joint {joint[:60]!r}")
        name = self.name(element, "actuator", f"actuator{len(self.model.names['actuator'])}")
        actuator = SceneActuator(name, element.tag, joint)
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


def _names(root: Element) -> Iterator[str]:
    waiting = [root]
    while waiting:
        element = waiting.pop()
        if "name" in element.attributes:
            yield element.attributes["name"]
        waiting += element.children


def load_mjcf(source: Any, *, strict: bool = False, folders: Sequence[Any] = ()) -> Scene:
    """Of a path, or of the text itself (str that begins with "<", or bytes). What is not exact is a warning in
    scene.warnings, as (file, line, kind, sentence), with strict=True an error. What is wrong, or what no scene has, is a
    SceneError that names file, line and element. Meshes (STL, OBJ, DAE, MSH) and included files are looked for beside
    the file and in `folders`. Where folders are given, no file outside of them and of the model's own folder is read; a
    text without folders reads none. Meshes collide as their hulls, on static bodies as they are."""
    text, file = read_source(source, "mjcf")
    model = Model(Scene(gravity=GRAVITY))
    model.names["frame"] = set()
    try:
        return MjcfReader(file, strict, None if text is source else file, folders, model, "", "").read(parse(text, file))
    except RecursionError:
        raise SceneError(f"{file}: too many bodies or frames in one another") from None
