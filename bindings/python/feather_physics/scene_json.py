"""Scenes as JSON, and what every scene must be, whoever made it: a reader, from_json(), a program."""

from __future__ import annotations

import json
import math
from array import array
from dataclasses import asdict, fields
from typing import Any, Dict, List, Set

from . import scene_records as s
from .errors import SceneError, SceneVersionError

FORMAT = "feather-scene"
VERSION = 1
MOST = 1e18  # of a number's magnitude, as in the files of robots

TEXTS = {"name", "type", "form", "b", "mesh", "file", "joint"}  # and the axis of a freedom
MAY_LACK_TEXTS = {"a", "body"}
LISTS = {"shapes", "freedoms", "points", "triangles"}
LENGTHS = {"scale": 3, "position": 3, "rotation": 4, "centre": 3, "inertia": 3, "inertia_rotation": 4, "axis": 3}
LENGTHS["direction"] = 3
DIRECTIONS = {"rotation", "inertia_rotation", "axis", "direction"}
MAY_LACK = {"mass", "lower", "upper", "effort", "velocity", "cone", "force_lower", "force_upper"}
SIZES = {"box": 3, "sphere": 1, "capsule": 2, "cylinder": 2, "plane": 0, "mesh": 0}
BODIES = ("static", "kinematic", "dynamic")
JOINTS = ("fixed", "hinge", "slider", "ball", "planar", "configurable", "chain", "free")
PARTS = ("linear", "angular", "ball")
AXES = [f"{kind}_{letter}" for kind in ("linear", "angular") for letter in "xyz"]


def _number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= MOST


def _short(value: Any) -> str:
    return repr(value)[:60]


def _is_good(kind: Any, name: str, value: Any) -> bool:
    """Is the value one that a record's field may have?"""
    if name in TEXTS or (kind is s.SceneFreedom and name == "axis"):
        return isinstance(value, str)
    if name in MAY_LACK_TEXTS:
        return value is None or isinstance(value, str)
    if name in LENGTHS or name == "size":
        good = isinstance(value, (list, tuple)) and all(map(_number, value))
        good = good and len(value) == LENGTHS.get(name, len(value))
        return good and (name not in DIRECTIONS or math.hypot(*value) > 1e-9)
    if name in LISTS:
        return isinstance(value, list)
    may_lack = name in MAY_LACK or (kind is s.SceneShape and name == "friction")
    return _number(value) or (value is None and may_lack)


def _check_record(record: Any, what: str) -> None:
    for one in fields(record):
        value = getattr(record, one.name)
        if not _is_good(type(record), one.name, value):
            raise SceneError(f"{what}: {one.name} is {_short(value)}")


# ---- what a scene must be


def _check_names(records: Any, what: str) -> Set[str]:
    found: Set[str] = set()
    for record in records:
        if record.name in found:
            raise SceneError(f"{what}: two have the name {_short(record.name)}")
        found.add(record.name)
    return found


def _one_of(value: str, choices: Any, what: str) -> None:
    if value not in choices:
        raise SceneError(f"{what}: one of {', '.join(choices)} is needed, not {_short(value)}")


def _there_is(name: Any, names: Set[str], kind: str, what: str) -> None:
    if name not in names:
        raise SceneError(f"{what}: there is no {kind} {_short(name)}")


def _array(kind: str, values: Any) -> Any:
    """Numbers of one kind; None where they are none."""
    try:
        return array(kind, values)
    except (TypeError, OverflowError):
        return None


def _check_mesh(mesh: Any, front: str = "") -> None:
    """Points and the places of corners among them. Each build asks: so not one by one."""
    name = _short(mesh.name)[1:-1]
    points, corners = _array("d", mesh.points), _array("q", mesh.triangles)
    if not points or len(points) % 3 or not (-MOST <= min(points) <= max(points) <= MOST and sum(points) <= MOST**2):
        raise SceneError(f"{front}points of {name}: three numbers each are needed")
    if corners is None or len(corners) % 3 or (corners and not 0 <= min(corners) <= max(corners) < len(points) // 3):
        raise SceneError(f"{front}triangles of {name}: three places of points each are needed")


def _check_body(body: Any, meshes: Set[str]) -> None:
    what = f"body {_short(body.name)}"
    _check_record(body, what)
    _one_of(body.type, BODIES, f"{what}: type")
    if body.mass is not None and body.type == "dynamic" and not (body.mass > 0 and min(body.inertia) > 0):
        raise SceneError(f"{what}: mass and inertia are above 0")
    for shape in body.shapes:
        _check_record(shape, f"{what}: a shape")
        _one_of(shape.form, SIZES, f"{what}: form")
        if len(shape.size) != SIZES[shape.form] or not all(x > 0 for x in shape.size):
            raise SceneError(f"{what}: size of a {shape.form}: {SIZES[shape.form]} numbers above 0 are needed")
        if shape.form == "mesh":
            _there_is(shape.mesh, meshes, "mesh", what)


def _check_limits(one: Any, what: str) -> None:
    if (one.lower is None) != (one.upper is None) or (one.lower is not None and one.lower > one.upper):
        raise SceneError(f"{what}: lower and upper are two numbers in this order, or none")
    if min(one.damping, one.friction, one.stiffness, one.armature) < 0:
        raise SceneError(f"{what}: damping, friction, stiffness and armature are not negative")


def _check_joint(joint: Any, bodies: Set[str]) -> None:
    what = f"joint {_short(joint.name)}"
    _check_record(joint, what)
    _one_of(joint.type, JOINTS, f"{what}: type")
    _check_limits(joint, what)
    for name in (joint.a, joint.b):
        if name is not None:
            _there_is(name, bodies, "body", what)
    for freedom in joint.freedoms:
        told = f"{what}: freedoms: {_short(freedom.name)}"
        _check_record(freedom, told)
        _check_limits(freedom, told)
        _one_of(freedom.axis, PARTS if joint.type == "chain" else AXES, f"{told}: axis")
    axes = [freedom.axis for freedom in joint.freedoms]
    if joint.type == "chain" and not axes:
        raise SceneError(f"{what}: a chain has freedoms")
    if joint.type == "configurable" and len(set(axes)) < len(axes):
        raise SceneError(f"{what}: two freedoms have one axis")


def check(scene: Any) -> None:
    """Whether it can be built, but for the ranges that a world has. A SceneError names what is wrong."""
    for mesh in scene.meshes:
        _check_record(mesh, f"mesh {_short(mesh.name)}")
        _check_mesh(mesh)
    for named, kind in ((scene.bodies, "bodies"), (scene.joints, "joints"), (scene.frames, "frames")):
        for record in named:
            if not isinstance(record.name, str):
                raise SceneError(f"{kind}: name is {_short(record.name)}")
    bodies, meshes = _check_names(scene.bodies, "bodies"), _check_names(scene.meshes, "meshes")
    _check_names(scene.joints, "joints")
    _check_names(scene.frames, "frames")
    for body in scene.bodies:
        _check_body(body, meshes)
    for joint in scene.joints:
        _check_joint(joint, bodies)
    for actuator in scene.actuators:
        _check_record(actuator, f"actuator {_short(actuator.name)}")
    for frame in scene.frames:
        _check_record(frame, f"frame {_short(frame.name)}")
        if frame.body is not None:
            _there_is(frame.body, bodies, "body", f"frame {_short(frame.name)}")
    for pair in scene.excluded:
        if not isinstance(pair, (list, tuple)) or len(pair) != 2 or pair[0] == pair[1]:
            raise SceneError(f"excluded: two names are needed, not {_short(pair)}")
        for name in pair:
            if not isinstance(name, str):
                raise SceneError(f"excluded: two names are needed, not {_short(pair)}")
            _there_is(name, bodies, "body", "excluded")


# ---- JSON


def json_of(scene: Any) -> str:
    """As text, in which every number is exact."""
    record: Dict[str, Any] = {"format": FORMAT, "version": VERSION, "name": scene.name}
    for kind in ("bodies", "joints", "meshes", "actuators", "frames"):
        record[kind] = [asdict(one) for one in getattr(scene, kind)]
    record["excluded"], record["gravity"] = scene.excluded, scene.gravity
    try:
        return json.dumps(record, indent=1, allow_nan=False)
    except (ValueError, TypeError) as error:
        raise SceneError(f"to_json: {error}") from None


def _list(value: Any, what: str) -> List[Any]:
    if not isinstance(value, list):
        raise SceneError(f"from_json: {what}: a list is needed")
    return value


def _record(kind: Any, item: Any, what: str) -> Any:
    known = {each.name for each in fields(kind)}
    if not isinstance(item, dict) or set(item) - known:
        raise SceneError(
            f"from_json: {what}: {sorted(set(item) - known)[:9] if isinstance(item, dict) else _short(item)}"
        )
    for name, value in item.items():
        if not _is_good(kind, name, value):
            raise SceneError(f"from_json: {what}: {name} is {_short(value)}")
        if name in LENGTHS and not isinstance(value, str):
            item[name] = tuple(float(x) for x in value)
    try:
        return kind(**item)
    except TypeError as error:
        raise SceneError(f"from_json: {what}: {error}") from None


def _mesh(item: Any) -> Any:
    mesh = _record(s.SceneMesh, item, "meshes")
    _check_mesh(mesh, "from_json: ")
    return mesh


def _parsed(text: str) -> Dict[str, Any]:
    try:
        record = json.loads(text)
    except RecursionError:
        raise SceneError("from_json: too many lists in one another") from None
    except ValueError as error:
        raise SceneError(f"from_json: {error}") from None
    if not isinstance(record, dict) or record.get("format") != FORMAT:
        raise SceneError("from_json: this is no scene")
    if record.get("version") != VERSION:
        raise SceneVersionError(f"from_json: version {_short(record.get('version'))}, {VERSION} is known")
    return record


def fill(made: Any, text: str) -> None:
    """An empty scene gets what json_of() wrote."""
    record = _parsed(text)
    made.name = record.get("name", "")
    if not isinstance(made.name, str):
        raise SceneError("from_json: name: a text is needed")
    for item in _list(record.get("bodies"), "bodies"):
        body = _record(s.SceneBody, item, "bodies")
        body.shapes = [_record(s.SceneShape, shape, f"shapes of {body.name}") for shape in body.shapes]
        made.bodies.append(body)
    for item in _list(record.get("joints"), "joints"):
        joint = _record(s.SceneJoint, item, "joints")
        joint.freedoms = [_record(s.SceneFreedom, each, f"freedoms of {joint.name}") for each in joint.freedoms]
        made.joints.append(joint)
    for kind, name in ((s.SceneActuator, "actuators"), (s.SceneFrame, "frames")):
        setattr(made, name, [_record(kind, item, name) for item in _list(record.get(name, []), name)])
    made.meshes = [_mesh(item) for item in _list(record.get("meshes", []), "meshes")]
    for pair in _list(record.get("excluded", []), "excluded"):
        if not isinstance(pair, list) or len(pair) != 2 or not all(isinstance(name, str) for name in pair):
            raise SceneError(f"from_json: excluded: two names are needed, not {_short(pair)}")
        made.excluded.append((pair[0], pair[1]))
    gravity = record.get("gravity")
    if gravity is not None:
        if not isinstance(gravity, list) or len(gravity) != 3 or not all(map(_number, gravity)):
            raise SceneError(f"from_json: gravity is {_short(gravity)}")
        made.gravity = (float(gravity[0]), float(gravity[1]), float(gravity[2]))
