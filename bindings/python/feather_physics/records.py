"""The small records that forms, queries and events are made of, and how the library packs the latter."""

from __future__ import annotations

import struct
from array import array
from typing import TYPE_CHECKING, Any, Callable, List, NamedTuple, Sequence, Tuple, TypeVar, Union

from . import _flat
from ._flat import Quat, Vec3

if TYPE_CHECKING:
    from .objects import Body, Heightfield, Joint, Shape

Vector = Sequence[float]
"""Three numbers, or four for a rotation: any sequence."""

NO_ROTATION: Vector = (0.0, 0.0, 0.0, 1.0)


class Sphere(NamedTuple):
    """A ball of a radius, m."""

    radius: float


class Capsule(NamedTuple):
    """A rod with round ends along local Y: half the height of its axis, and its radius, m."""

    half_height: float
    radius: float


class Box(NamedTuple):
    """A box by half its edges, m."""

    half_x: float
    half_y: float
    half_z: float


class Plane(NamedTuple):
    """The half space normal . p <= distance, for static bodies."""

    normal: Vector = (0.0, 1.0, 0.0)
    distance: float = 0.0


Geometry = Union[Sphere, Capsule, Box, Plane, "Heightfield"]


class Material(NamedTuple):
    """How a surface grips and bounces; see fe_material in feather.h. Two mix: friction sqrt(a b), the others the larger."""

    static_friction: float = 0.6
    dynamic_friction: float = 0.5
    restitution: float = 0.0
    rolling_resistance: float = 0.0
    spinning_resistance: float = 0.0


class MassData(NamedTuple):
    """Mass, kg; its centre, m, body space; principal moments, kg m2; their axes, body space."""

    mass: float
    centre: Vec3
    inertia: Vec3
    inertia_rotation: Quat


class Hit(NamedTuple):
    """What a ray or a sweep met; see fe_hit in feather.h."""

    body: "Body"
    shape: "Shape"
    point: Vec3
    fraction: float
    normal: Vec3
    triangle: int
    depth: float
    started_inside: bool


class Closest(NamedTuple):
    """The closest point of a surface; the distance is below 0 inside."""

    body: "Body"
    shape: "Shape"
    point: Vec3
    distance: float
    normal: Vec3
    triangle: int


class PairEvent(NamedTuple):
    """Two shapes began ("enter"), went on ("stay") or ceased ("exit") to touch."""

    kind: str
    body_a: "Body"
    body_b: "Body"
    shape_a: "Shape"
    shape_b: "Shape"
    is_trigger: bool


class BodyEvent(NamedTuple):
    """A body fell asleep ("sleep") or woke ("wake")."""

    kind: str
    body: "Body"


class HitEvent(NamedTuple):
    """An impact: point, m; normal from A to B; speed of approach, m/s; impulse of the step, N s."""

    body_a: "Body"
    body_b: "Body"
    shape_a: "Shape"
    shape_b: "Shape"
    point: Vec3
    normal: Vec3
    speed: float
    impulse: float


class JointEvent(NamedTuple):
    """A joint broke: it is gone. Force, N, and torque, N m, are what broke it."""

    joint: "Joint"
    body_a: "Body"
    body_b: "Body"
    tag: int
    type: str
    force: Vec3
    torque: Vec3


class ContactPoint(NamedTuple):
    """One point of a contact; see fe_contact_point in feather.h."""

    point: Vec3
    separation: float
    normal_impulse: float
    total_impulse: float
    id: int


class Contact(NamedTuple):
    """Two shapes that touch or nearly do; the normal points from A to B."""

    body_a: "Body"
    body_b: "Body"
    shape_a: "Shape"
    shape_b: "Shape"
    normal: Vec3
    points: Tuple[ContactPoint, ...]
    friction_impulse: Vec3
    twist_impulse: float
    triangle: int


class JointState(NamedTuple):
    """How a joint stands; see fe_joint_state in feather.h."""

    angle: float
    swing_y: float
    swing_z: float
    angular_velocity: Vec3
    translation: Vec3
    linear_velocity: Vec3
    length: float
    speed: float
    linear_error: float
    angular_error: float


class Tuning(NamedTuple):
    """How the solver behaves; see fe_world_tuning in feather.h."""

    contact_hertz: float
    contact_damping_ratio: float
    contact_push_speed: float
    joint_hertz: float
    joint_damping_ratio: float
    restitution_threshold: float
    hit_event_threshold: float
    sleep_time: float
    speculative_distance: float
    max_linear_speed: float


class Profile(NamedTuple):
    """Where the last step's time went, ms."""

    step: float
    pairs: float
    collide: float
    islands: float
    solve: float
    continuous: float
    finalize: float
    events: float
    sleep: float


class Counters(NamedTuple):
    """What a world holds; see fe_counters in feather.h."""

    bodies: int
    shapes: int
    joints: int
    awake_bodies: int
    pairs: int
    contacts: int
    recycled: int
    islands: int
    colours: int
    rows: int
    rows_whole: int
    lanes: int
    simd: int
    simd_width: int
    workers: int
    bytes: int
    allocations: int
    trees: int


Record = TypeVar("Record", bound=Tuple[Any, ...])


def copy_record(kind: Callable[..., Record], flat: Any) -> Record:
    """A tuple of the fields that a flat record has under the same names."""
    return kind(*[getattr(flat, name) for name in kind._fields])  # type: ignore[attr-defined]


# ---- packed records: the formats of the structs in feather.h, padding included. Tests compare their sizes with the library's. -----------------

TRANSFORM = struct.Struct("=3d4f")
HIT = struct.Struct("=QQ3dd3fifI")
RAY = struct.Struct("=3d3d")
PATH = struct.Struct("=3d4f3d")
PAIR_EVENT = struct.Struct("=QQQQii")
BODY_EVENT = struct.Struct("=Qii")
HIT_EVENT = struct.Struct("=QQQQ3d3fffi")
JOINT_EVENT = struct.Struct("=QQQQii3f3f")
CONTACT_POINT = struct.Struct("=3dfffI")
CONTACT = struct.Struct("=QQQQ3fi" + "3dfffI" * 4 + "3ffii")

EVENT_KINDS = {1: "enter", 2: "stay", 3: "exit", 4: "sleep", 5: "wake", 6: "break"}
BODY_TYPES = ("static", "kinematic", "dynamic")
JOINT_TYPES = {1: "distance", 2: "ball", 3: "hinge", 4: "fixed", 5: "configurable"}


def read_all(read: Callable[..., int], record: struct.Struct, *arguments: Any) -> List[Tuple[Any, ...]]:
    """All records that `read` has to give, as plain tuples."""
    count = read(*arguments, None)
    if count == 0:
        return []
    buffer = bytearray(count * record.size)
    read(*arguments, buffer)
    return list(record.iter_unpack(buffer))


def read_handles(read: Callable[..., int], *arguments: Any) -> "array[int]":
    """All handles that `read` has to give."""
    handles = array("Q", bytes(8 * read(*arguments, None)))
    read(*arguments, handles)
    return handles
