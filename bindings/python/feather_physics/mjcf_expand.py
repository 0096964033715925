"""What MJCF writes short, written out before it is read: files that <include> names, <replicate>, cables of
<composite>. Elements become other elements; mjcf.py never sees these."""

from __future__ import annotations

import math
from typing import Any, Callable, Dict, List, Optional, Sequence, Set, Tuple

from .frames import Frame, multiply, normalized, rotate
from .robot_mesh import find_file
from .robot_xml import Element, Reader, parse, read_file, row

MOST_INCLUDED = 100
MOST_ELEMENTS = 200_000  # that replicas and cables may make
SUFFIX = "suffix"  # an attribute of our own: what replicas add to the names of an attached model
REFERRING = ("contact", "equality", "actuator")
MOST_POINTS = 500  # of a cable: each of its bodies hangs within the one before
CABLE_FORMS = ("capsule", "cylinder", "box")


def include(reader: Reader, root: Element, path: Optional[str], folders: Sequence[Any]) -> None:
    """The children of the files that <include> names take its place."""
    waiting, count = [root], 0
    while waiting:
        element = waiting.pop()
        for i in reversed([i for i, child in enumerate(element.children) if child.tag == "include"]):
            child = element.children[i]
            count += 1
            if count > MOST_INCLUDED:
                raise reader.fail(child, f"{MOST_INCLUDED} files are the most")
            element.children[i : i + 1] = read_model(reader, child, path, folders).children
            waiting.append(element)
        waiting += element.children


def read_model(reader: Reader, element: Element, path: Optional[str], folders: Sequence[Any]) -> Element:
    """The root of the file that an element names."""
    name = reader.need(element, "file")
    file = find_file(name, path, folders)
    if file is None:
        why = "a text includes no files but those in `folders`" if path is None else f"there is no file {name!r}"
        raise reader.fail(element, why)
    try:
        text = read_file(file)
    except OSError as error:
        raise reader.fail(element, f"{name!r}: {error.strerror}") from None
    return parse(text, file)


class Expander:
    """Writes out what is below one root. `turn_of`: the rotation of three angles, as the file's compiler has them."""

    def __init__(self, reader: Reader, root: Element, turn_of: Callable[[Sequence[float]], Any]):
        self.reader, self.root, self.turn_of = reader, root, turn_of
        self.made = 0

    def all(self) -> None:
        """Of the whole file."""
        for element in list(self.root.children):
            if element.tag == "worldbody":
                self.expand(element)

    def expand(self, element: Element) -> None:
        """What is innermost comes first, and so do its suffixes."""
        made: List[Element] = []
        for child in element.children:
            self.expand(child)
            if child.tag == "replicate":
                made += self.replicas(child)
            elif child.tag == "attach" and "model" not in child.attributes:
                made.append(self.own(child))
            elif child.tag == "composite" and child.attributes.get("type") == "cable":
                made += self.cable(child)
            else:
                made.append(child)
        element.children = made

    def count(self, element: Element, more: int) -> None:
        """So many elements more: not without end."""
        self.made += more
        if self.made > MOST_ELEMENTS:
            raise self.reader.fail(element, f"it makes more than {MOST_ELEMENTS} elements")

    # ---- replicas

    def replicas(self, element: Element) -> List[Element]:
        """A <frame> for each, turned by so many times the angles; each stands an offset beside the one before, along
        the axes of that one."""
        reader = self.reader
        times = reader.number(element, "count")
        if not 1 <= times <= MOST_ELEMENTS or times != int(times):
            raise reader.fail(element, "count: a whole number from 1 is needed")
        offset, angles = reader.numbers(element, "offset", 3, (0, 0, 0)), reader.numbers(element, "euler", 3, (0, 0, 0))
        self.count(element, int(times) * sum(1 for _ in _below(element)))
        names = {one.attributes["name"] for one in _below(element) if "name" in one.attributes}
        suffixes = [f"{element.attributes.get('sep', '')}{i:0{len(str(int(times)))}}" for i in range(int(times))]
        self.refer(names, [("", suffix) for suffix in suffixes])
        made, at = [], Frame()
        for i, suffix in enumerate(suffixes):
            turn = self.turn_of([i * angle for angle in angles])
            frame = _frame(Frame(at.position, turn), element)
            if "childclass" in element.attributes:
                frame.attributes["childclass"] = element.attributes["childclass"]
            for child in element.children:
                copy = child.copy()
                for one in [copy, *_below(copy)]:
                    if "name" in one.attributes:
                        one.attributes["name"] += suffix
                    if one.tag == "attach":
                        one.attributes[SUFFIX] = one.attributes.get(SUFFIX, "") + suffix
                frame.children.append(copy)
            made.append(frame)
            at = Frame(at.position, turn).then(Frame((offset[0], offset[1], offset[2])))
        return made

    def refer(self, names: Set[str], around: List[Tuple[str, str]]) -> None:
        """What refers to something replicated is replicated with it: of each a prefix and a suffix."""
        for section in (one for one in self.root.children if one.tag in REFERRING):
            made: List[Element] = []
            for child in section.children:
                own = {key for key, value in child.attributes.items() if key != "name" and value in names}
                own |= {"name"} if own and "name" in child.attributes else set()
                self.count(child, len(around) if own else 0)
                for prefix, suffix in around if own else [("", "")]:
                    copy = child.copy() if own else child
                    for key in own:
                        copy.attributes[key] = f"{prefix}{copy.attributes[key]}{suffix}"
                    made.append(copy)
            section.children = made

    def own(self, element: Element) -> Element:
        """A copy of a body or a frame of the same file, whose names get a prefix."""
        reader = self.reader
        kind = "frame" if "frame" in element.attributes else "body"
        name, prefix = reader.need(element, kind), reader.need(element, "prefix")
        for section in (one for one in self.root.children if one.tag == "worldbody"):
            for one in _below(section):
                if one.tag == kind and one.attributes.get("name") == name:
                    self.count(element, sum(1 for _ in _below(one)))
                    made: Element = one.copy()
                    names = set()
                    for each in [made, *_below(made)]:
                        if "name" in each.attributes:
                            names.add(each.attributes["name"])
                            each.attributes["name"] = prefix + each.attributes["name"]
                    self.refer(names, [("", ""), (prefix, "")])
                    return made
        raise reader.fail(element, f"there is no {kind} {name[:60]!r}")

    # ---- cables

    def cable(self, element: Element) -> List[Element]:
        """A chain of bodies, each with a form along x, that hang on one another by balls."""
        reader, given = self.reader, element.attributes
        points = self.course(element)
        geom, joint, prefix = element.find("geom"), element.find("joint"), given.get("prefix", "")
        if geom is None or geom.attributes.get("type", "sphere") not in CABLE_FORMS:
            raise reader.fail(element, f"a geom is needed: one of {', '.join(CABLE_FORMS)}")
        if any(child.tag == "plugin" for child in element.children):
            reader.tell_once(element, "joint", "a cable bends and twists freely: its stiffness is left out")
        initial = reader.choice(element, "initial", ("free", "ball", "none", "fixed"), "ball")
        offset = reader.numbers(element, "offset", 3, (0, 0, 0))
        start = [a + b for a, b in zip(points[0], offset)]
        last, turn = len(points) - 2, (0.0, 0.0, 0.0, 1.0)
        names = [f"{prefix}B_{ {0: 'first', last: 'last'}.get(i, i) }" for i in range(last + 1)]
        outer: List[Element] = []
        inside, length = outer, 0.0
        for i, name in enumerate(names):
            way = [b - a for a, b in zip(points[i], points[i + 1])]
            before, turn = turn, _carried(turn, way)
            x, y, z, w = before
            at = Frame((start[0], start[1], start[2]), turn)
            if i > 0:
                at = Frame((length, 0.0, 0.0), multiply((-x, -y, -z, w), turn))
            body = _frame(at, element, "body", name)
            length = math.hypot(*way)
            body.children.append(self.segment(geom, length, f"{prefix}G{i}"))
            self.hang(body, joint, "free" if i == 0 and initial == "free" else "ball" if i or initial == "ball" else "none")
            inside.append(body)
            inside = body.children
        self.exclude(element, names)
        self.count(element, 4 * len(names))
        return outer

    def course(self, element: Element) -> List[List[float]]:
        """The points along a cable: given, or of its curve."""
        reader = self.reader
        if "vertex" in element.attributes:
            flat = _several(reader, element, "vertex")
            points = [flat[k : k + 3] for k in range(0, len(flat) - 2, 3)]
        else:
            count = int(_several(reader, element, "count")[0])
            size = [*_several(reader, element, "size"), 0.0, 0.0][:3]
            if not 2 <= count <= MOST_POINTS:
                raise reader.fail(element, f"count: 2 to {MOST_POINTS} points are needed")
            forms: Dict[str, Callable[[float], float]] = {
                "s": lambda s: s * size[0],
                "cos(s)": lambda s: size[1] * math.cos(math.pi * s * size[2]),
                "sin(s)": lambda s: size[1] * math.sin(math.pi * s * size[2]),
                "0": lambda s: 0.0,
            }
            curve = [*element.attributes.get("curve", "s").split(), "0", "0"][:3]
            if not set(curve) <= set(forms):
                raise reader.fail(element, f"curve: of {', '.join(forms)}")
            points = [[forms[form](i / (count - 1)) for form in curve] for i in range(count)]
            quat = reader.numbers(element, "quat", 4, (1, 0, 0, 0))
            if math.hypot(*quat) < 1e-9:
                raise reader.fail(element, "quat: a direction is needed")
            w, x, y, z = normalized(quat)
            points = [list(rotate((x, y, z, w), point)) for point in points]
        if not 2 <= len(points) <= MOST_POINTS or any(math.dist(a, b) < 1e-9 for a, b in zip(points, points[1:])):
            raise reader.fail(element, f"a cable has 2 to {MOST_POINTS} points, none at the place of the one before")
        return points

    def segment(self, geom: Element, length: float, name: str) -> Element:
        """The form of one body, along its x."""
        made = geom.copy()
        made.attributes["name"] = name
        if made.attributes["type"] == "box":
            size = _several(self.reader, geom, "size")
            made.attributes["pos"], made.attributes["size"] = row((length / 2, 0, 0)), row([length / 2, *size[1:]])
        else:
            made.attributes["fromto"] = row((0, 0, 0, length, 0, 0))
        return made

    def hang(self, body: Element, joint: Optional[Element], kind: str) -> None:
        """The joint of one body."""
        name = "J_" + body.attributes["name"].rsplit("B_", 1)[-1]
        name = body.attributes["name"].rsplit("B_", 1)[0] + name
        if kind == "free":
            body.children.append(Element("freejoint", {"name": name}, body.line, body.file))
        elif kind == "ball":
            own = {} if joint is None else {key: value for key, value in joint.attributes.items() if key != "kind"}
            body.children.append(Element("joint", {**own, "type": "ball", "name": name}, body.line, body.file))

    def exclude(self, element: Element, names: List[str]) -> None:
        """Neighbours do not collide."""
        section = Element("contact", {}, element.line, element.file)
        for a, b in zip(names, names[1:]):
            section.children.append(Element("exclude", {"body1": a, "body2": b}, element.line, element.file))
        self.root.children.append(section)


def _several(reader: Reader, element: Element, name: str) -> List[float]:
    """An attribute of one number or more."""
    return reader.numbers(element, name, max(1, len(reader.need(element, name).split())))


def _below(element: Element) -> Any:
    waiting = list(element.children)
    while waiting:
        one = waiting.pop()
        yield one
        waiting += one.children


def _frame(at: Frame, element: Element, tag: str = "frame", name: str = "") -> Element:
    x, y, z, w = at.rotation
    made = Element(tag, {"pos": row(at.position), "quat": row((w, x, y, z))}, element.line, element.file)
    if name:
        made.attributes["name"] = name
    return made


def _carried(turn: Any, way: Sequence[float]) -> Any:
    """The turn whose x goes that way, from one before it by the smallest turn: so a cable is not twisted."""
    x, to = rotate(turn, (1.0, 0.0, 0.0)), normalized(way)
    cosine = sum(a * b for a, b in zip(x, to))
    if cosine < -1 + 1e-9:  # straight back: about its z
        return multiply(turn, (0.0, 0.0, 1.0, 0.0))
    axis = (x[1] * to[2] - x[2] * to[1], x[2] * to[0] - x[0] * to[2], x[0] * to[1] - x[1] * to[0])
    return normalized(multiply((*axis, 1 + cosine), turn))
