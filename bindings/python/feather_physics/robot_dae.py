"""COLLADA 1.4 and 1.5 (https://www.khronos.org/collada), of which robots' meshes have the triangles: those of all
geometries that the scene places, in metres. The up axis does not count, as for readers of ROS: a robot's file places
its meshes as they are written."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Sequence, Tuple
from xml.etree import ElementTree

from .errors import SceneError
from .frames import about, rotate
from .robot_xml import check_encoding

MOST_DEPTH, MOST_PLACED = 100, 10_000  # of nodes in one another; of geometries in a scene
MOST_READ = 15  # numbers for each triangle that a file may have: a geometry is read as often as it is placed
MOST = 1e18  # of a number's magnitude

# Rows of a matrix, the last one (0, 0, 0, 1) left out
Matrix = List[List[float]]
SAME: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
FORMS = ("triangles", "polylist", "polygons", "trifans", "tristrips")


def _times(a: Matrix, b: Matrix) -> Matrix:
    """First b, then a."""
    return [
        [sum(row[k] * b[k][j] for k in range(3)) + (row[3] if j == 3 else 0.0) for j in range(4)] for row in a
    ]


class _NoTypes(ElementTree.TreeBuilder):
    """Refuses document types, so that there are no entities."""

    def doctype(self, *_: Any) -> None:
        raise SceneError("a document type is not taken")


class _Dae:
    """One file."""

    def __init__(self, data: bytes, file: str, most: int):
        self.file, self.most = file, most
        self.points: List[float] = []
        self.triangles: List[int] = []
        self.placed = self.read = 0
        check_encoding(data, file)
        try:
            self.root = ElementTree.fromstring(data, ElementTree.XMLParser(target=_NoTypes()))
        except ElementTree.ParseError as error:
            raise SceneError(f"{file}: {error}") from None
        except SceneError as error:
            raise SceneError(f"{file}: {error}") from None
        except (LookupError, ValueError):
            raise SceneError(f"{file}: its encoding is not one of XML's") from None
        self.by_id: Dict[str, ElementTree.Element] = {}
        for element in self.root.iter():
            element.tag = element.tag.rsplit("}", 1)[-1]  # without its namespace
            self.by_id.setdefault(element.get("id", ""), element)

    def fail(self, text: str) -> SceneError:
        return SceneError(f"{self.file}: {text}")

    def to(self, reference: str) -> ElementTree.Element:
        """What "#name" names."""
        found = self.by_id.get(reference[1:]) if reference.startswith("#") else None
        if found is None:
            raise self.fail("a reference leads nowhere")
        return found

    def numbers(self, element: Any, kind: Any = float) -> List[Any]:
        try:
            found = [kind(word) for word in (element.text or "").split()] if element is not None else []
        except ValueError:
            found = [math.nan]
        if not all(-MOST <= x <= MOST for x in found):
            raise self.fail("a list has what is no finite number")
        self.read += len(found)
        if self.read > MOST_READ * self.most:
            raise self.fail(f"more than {MOST_READ * self.most} numbers in the geometries that it places")
        return found

    # ---- where geometries are

    def transform(self, node: ElementTree.Element) -> Matrix:
        """Of a node, in its parent."""
        made = SAME
        for element in node:
            x = self.numbers(element) if element.tag in ("matrix", "translate", "rotate", "scale") else []
            if len(x) == 16:
                made = _times(made, [x[0:4], x[4:8], x[8:12]])
            elif element.tag == "translate" and len(x) == 3:
                made = _times(made, [[*SAME[k][:3], x[k]] for k in range(3)])
            elif element.tag == "scale" and len(x) == 3:
                made = _times(made, [[a * x[j] if j < 3 else 0.0 for j, a in enumerate(SAME[k])] for k in range(3)])
            elif element.tag == "rotate" and len(x) == 4 and any(x[:3]):
                columns = [rotate(about(x[:3], math.radians(x[3])), SAME[k][:3]) for k in range(3)]
                made = _times(made, [[columns[j][k] for j in range(3)] + [0.0] for k in range(3)])
        return made

    def node(self, node: ElementTree.Element, at: Matrix, depth: int) -> None:
        """Its geometries and those of its children."""
        self.placed += 1
        if depth > MOST_DEPTH or self.placed > MOST_PLACED:
            raise self.fail("too many nodes, or in one another")
        at = _times(at, self.transform(node))
        for element in node:
            if element.tag == "node":
                self.node(element, at, depth + 1)
            elif element.tag == "instance_node":
                self.node(self.to(element.get("url", "")), at, depth + 1)
            elif element.tag == "instance_geometry":
                self.geometry(self.to(element.get("url", "")), at)
            elif element.tag == "instance_controller":
                skin = self.to(element.get("url", "")).find("skin")
                if skin is not None:
                    self.geometry(self.to(skin.get("source", "")), at)

    # ---- geometries

    def positions(self, mesh: ElementTree.Element) -> Tuple[str, List[float]]:
        """The name of a mesh's vertices, and where they are."""
        vertices = mesh.find("vertices")
        for each in vertices.findall("input") if vertices is not None else ():
            if each.get("semantic") == "POSITION":
                source = self.to(each.get("source", ""))
                found = self.numbers(source.find("float_array"))
                accessor = source.find("technique_common/accessor")
                stride = "3" if accessor is None else accessor.get("stride", "3")
                if stride != "3":
                    raise self.fail("positions of three numbers each are read")
                return f"#{vertices.get('id', '')}", found  # type: ignore[union-attr]
        raise self.fail("a mesh has no positions")

    def geometry(self, geometry: ElementTree.Element, at: Matrix) -> None:
        """Adds its triangles."""
        mesh = geometry.find("mesh")
        if mesh is None:
            return
        name, own = self.positions(mesh)
        first, count = len(self.points) // 3, len(own) // 3
        for k in range(0, 3 * count, 3):
            x, y, z = own[k : k + 3]
            self.points += (row[0] * x + row[1] * y + row[2] * z + row[3] for row in at)
        mirrored = sum(
            at[0][i] * (at[1][(i + 1) % 3] * at[2][(i + 2) % 3] - at[1][(i + 2) % 3] * at[2][(i + 1) % 3])
            for i in range(3)
        ) < 0
        for form in (element for element in mesh if element.tag in FORMS):
            for face in self.faces(form, name):
                if min(face) < 0 or max(face) >= count:
                    raise self.fail("a corner is none of the positions")
                if mirrored:
                    face = face[::-1]
                for second, third in zip(face[1:], face[2:]):
                    self.triangles += (first + face[0], first + second, first + third)
            if len(self.triangles) > 3 * self.most or len(self.points) > 9 * self.most:
                raise self.fail(f"{self.most} triangles are the most")

    def faces(self, form: ElementTree.Element, name: str) -> Sequence[List[int]]:
        """The places of the corners of each face."""
        inputs = form.findall("input")
        try:
            offsets = {each.get("source"): int(each.get("offset", "0")) for each in inputs}
        except ValueError:
            raise self.fail("an offset is no number") from None
        width, place = max([*offsets.values(), 0]) + 1, offsets.get(name)
        if place is None or not 0 <= min(offsets.values()) <= width <= 64:
            raise self.fail("a form has no vertices")
        rows = [self.numbers(each, int)[place::width] for each in form.findall("p")]
        if form.tag == "triangles":
            sizes, rows = [3] * sum(len(row) // 3 for row in rows), [[corner for row in rows for corner in row]]
        elif form.tag == "polylist":
            sizes = self.numbers(form.find("vcount"), int)
        elif form.tag == "tristrips":  # each second triangle is turned
            return [row[k : k + 3] if k % 2 == 0 else row[k : k + 3][::-1] for row in rows for k in range(len(row) - 2)]
        else:
            return [row for row in rows if len(row) > 2]
        found, at, row = [], 0, rows[0] if rows else []
        for size in sizes:
            if size < 0 or at + size > len(row):
                raise self.fail("a form has fewer corners than it says")
            if size > 2:
                found.append(row[at : at + size])
            at += size
        return found


def read_dae(data: bytes, file: str, most: int) -> Tuple[List[float], List[int]]:
    """Points and triangles."""
    dae = _Dae(data, file, most)
    unit = dae.root.find("asset/unit")
    try:
        metre = float(unit.get("meter", "1")) if unit is not None else 1.0
    except ValueError:
        metre = 1.0
    instance = dae.root.find("scene/instance_visual_scene")
    at = [[metre * x for x in row] for row in SAME]
    if instance is not None:
        for node in dae.to(instance.get("url", "")).findall("node"):
            dae.node(node, at, 0)
    else:
        for geometry in dae.root.iter("geometry"):
            dae.geometry(geometry, at)
    if not dae.triangles:
        raise SceneError(f"{file}: this is no COLLADA file with triangles")
    return dae.points, dae.triangles
