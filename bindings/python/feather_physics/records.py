"""The small records that forms, queries and events are made of, and how the library packs the latter."""

from __future__ import annotations

import struct
from array import array
from typing import TYPE_CHECKING, Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, TypeVar, Union

from . import _flat
from ._flat import Quat, Vec3

if TYPE_CHECKING:
    from .objects import Body, Joint, Shape
    from .store import Compound, Heightfield, Hull, Mesh

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


class Cylinder(NamedTuple):
    """A cylinder along local Y: half its height, and its radius, m."""

    half_height: float
    radius: float


class Cone(NamedTuple):
    """A cone along local Y, its tip at +half_height: half its height, and the radius of its base, m."""

    half_height: float
    radius: float


class Plane(NamedTuple):
    """The half space normal . p <= distance, for static bodies."""

    normal: Vector = (0.0, 1.0, 0.0)
    distance: float = 0.0


class Scaled(NamedTuple):
    """A hull or a mesh under a scale along the axes of its points: each number 0.001 to 1000 in magnitude, a negative
    one mirrors."""

    asset: Union["Hull", "Mesh"]
    scale: Vector


Geometry = Union[Sphere, Capsule, Box, Cylinder, Cone, Plane, Scaled, "Hull", "Mesh", "Heightfield", "Compound"]
"""The form of a shape, or of a query."""


class Material(NamedTuple):
    """A surface; see fe_material in feather.h. The combine modes say how two mix: "default" (friction: sqrt(a b),
    restitution: the larger), "average", "minimum", "multiply", "maximum"; the higher mode of the two counts. Hits and
    contacts report `user_id`, any integer of yours."""

    static_friction: float = 0.6
    dynamic_friction: float = 0.5
    restitution: float = 0.0
    rolling_resistance: float = 0.0
    spinning_resistance: float = 0.0
    friction_combine: str = "default"
    restitution_combine: str = "default"
    user_id: int = 0


class Part(NamedTuple):
    """A part of a compound: any geometry but a plane or a compound, its place in the compound's space, m, a density,
    kg/m3 (None: the shape's), a material (None: the shape's), and an integer of yours below 2^64."""

    geometry: Geometry
    position: Vector = (0.0, 0.0, 0.0)
    rotation: Vector = NO_ROTATION
    density: Optional[float] = None
    material: Optional[Material] = None
    tag: int = 0


class Filter(NamedTuple):
    """A shape's layer (one bit), the mask of layers it collides with, and its group: above 0 shapes of one group
    always collide, below 0 never."""

    layer: int = 1
    mask: int = 0xFFFFFFFF
    group: int = 0


class FilterPair(NamedTuple):
    """Two shapes that a pair filter judges; A is the one created first. The tags are those of bodies and shapes."""

    body_a: "Body"
    body_b: "Body"
    shape_a: "Shape"
    shape_b: "Shape"
    body_tag_a: int
    body_tag_b: int
    shape_tag_a: int
    shape_tag_b: int


class Energy(NamedTuple):
    """Kinetic and potential, J; see fe_world_get_energy in feather.h."""

    kinetic: float
    potential: float


class Momentum(NamedTuple):
    """Linear, N s, and angular about a point, N m s."""

    linear: Vec3
    angular: Vec3


class Hertz(NamedTuple):
    """The stiffness of contacts and of joints that a step really uses, 1/s."""

    contact: float
    joint: float


class MassData(NamedTuple):
    """Mass, kg; its centre, m, body space; principal moments, kg m2; their axes, body space."""

    mass: float
    centre: Vec3
    inertia: Vec3
    inertia_rotation: Quat


class Hit(NamedTuple):
    """
    Where a ray or a sweep meets a body; see fe_hit in feather.h. `material` is the user_id of the surface; `back`: a
    triangle of a two-sided mesh, met from behind.
    """

    body: "Body"
    shape: "Shape"
    point: Vec3
    fraction: float
    normal: Vec3
    triangle: int
    depth: float
    started_inside: bool
    part: int
    barycentric: Tuple[float, float]
    material: int
    back: bool


class Closest(NamedTuple):
    """The closest point of a surface; the distance is below 0 inside. `material` is the user_id of the surface."""

    body: "Body"
    shape: "Shape"
    point: Vec3
    distance: float
    normal: Vec3
    triangle: int
    part: int
    barycentric: Tuple[float, float]
    material: int


class Overlap(NamedTuple):
    """A shape that a geometry overlaps. A translation of the geometry by `depth`, m, along `direction` parts the two.
    `material` is the user_id of the surface."""

    body: "Body"
    shape: "Shape"
    direction: Vec3
    depth: float
    part: int
    triangle: int
    material: int


class PairEvent(NamedTuple):
    """Two shapes began ("enter"), went on ("stay") or ceased ("exit") to touch."""

    kind: str
    body_a: "Body"
    body_b: "Body"
    shape_a: "Shape"
    shape_b: "Shape"
    is_trigger: bool
    part_a: int
    part_b: int
    triangle_a: int
    triangle_b: int


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
    material_a: int
    material_b: int
    part_a: int
    part_b: int
    triangle_a: int
    triangle_b: int


class JointEvent(NamedTuple):
    """A joint broke: it is gone. Force, N, and torque, N m, are the reaction that broke it. A body of None is the
    world."""

    joint: "Joint"
    body_a: Optional["Body"]
    body_b: Optional["Body"]
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
    material_a: int
    material_b: int
    part_a: int
    part_b: int
    triangle_a: int
    triangle_b: int


class SnapshotInfo(NamedTuple):
    """What a snapshot says of itself; see fe_snapshot_info in feather.h. `foreign`: made by a library whose results
    differ from this one's. `inside`: so many of the assets are in the bytes."""

    library: int
    foreign: bool
    number: int
    step: int
    bodies: int
    shapes: int
    joints: int
    assets: int
    inside: int
    filter: bool


class Difference(NamedTuple):
    """Where two snapshots first differ; see fe_difference in feather.h. `a` and `b` are the values as text."""

    kind: str
    field: str
    index: int  # type: ignore[assignment]
    element: int
    handle: int
    other: int
    a: str
    b: str


class HullInfo(NamedTuple):
    """What a hull is; see fe_hull_info in feather.h. The inertia is that of a density of 1 kg/m3."""

    vertex_count: int
    edge_count: int
    face_count: int
    volume: float
    area: float
    centre: Vec3
    inertia: Vec3
    inertia_rotation: Quat
    lower: Vec3
    upper: Vec3
    thickness: float
    inner_radius: float
    tolerance: float
    error: float
    bytes: int


class HullFace(NamedTuple):
    """A face of a hull: vertices, counterclockwise seen from outside, the outward normal, and its plane's distance."""

    corners: Tuple[int, ...]
    normal: Vec3
    distance: float


class MeshInfo(NamedTuple):
    """What a mesh is; see fe_mesh_info in feather.h. A closed mesh that is wound inside out has a negative volume."""

    triangle_count: int
    degenerate_triangles: int
    duplicate_triangles: int
    vertex_count: int
    open_edges: int
    crowded_edges: int
    flipped_edges: int
    tree_height: int
    material_count: int
    lower: Vec3
    upper: Vec3
    area: float
    volume: float
    bytes: int


class MeshEdge(NamedTuple):
    """An edge of a triangle: do bodies touch it, does the surface bend outwards there, has it no neighbour?"""

    felt: bool
    convex: bool
    open: bool


class MeshTriangle(NamedTuple):
    """A triangle of a mesh: corners, m; edges from corner 0 to 1, 1 to 2, 2 to 0; the place of its material, -1: the
    shape's; your number."""

    corners: Tuple[Vec3, Vec3, Vec3]
    edges: Tuple[MeshEdge, MeshEdge, MeshEdge]
    material: int
    data: int


class CompoundInfo(NamedTuple):
    """What a compound is: how many parts, their bounds, m, in its own space, and bytes of memory without their
    assets."""

    part_count: int
    lower: Vec3
    upper: Vec3
    bytes: int


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
    sleep_enabled: bool
    continuous_enabled: bool
    warm_start_enabled: bool


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
    contacts_left_out: int


Record = TypeVar("Record", bound=Tuple[Any, ...])


def copy_record(kind: Callable[..., Record], flat: Any) -> Record:
    """A tuple of the fields that a flat record has under the same names."""
    values = ((name, getattr(flat, name)) for name in kind._fields)  # type: ignore[attr-defined]
    return kind(*[value != 0 if name.endswith("_enabled") else value for name, value in values])


# ---- packed records ----------------------------------------------------------------------------------------------


class Packed:
    """How the library packs a record. `dtype` is what numpy.dtype() takes. The rest is as in struct.Struct."""

    __slots__ = ("format", "size", "dtype", "pack", "unpack", "iter_unpack")

    def __init__(self, fields: str):
        """Fields as "name:format", padding as "name:20x"; a name may stand for a record: "points:4*CONTACT_POINT"."""
        names: List[str] = []
        formats: List[Any] = []
        offsets: List[int] = []
        self.format = "="  # as of struct
        for name, code in (field.split(":") for field in fields.split()):
            count, _, inner = code.partition("*")
            record: Optional[Packed] = globals()[inner] if inner else None
            if not code.endswith("x"):
                names.append(name)
                offsets.append(struct.calcsize(self.format))
                formats.append((record.dtype, (int(count),)) if record else _numpy_format(code))
            self.format += record.format[1:] * int(count) if record else code
        packed = struct.Struct(self.format)
        self.size = packed.size  # bytes of a record
        self.pack = packed.pack  # values to bytes
        self.unpack = packed.unpack  # bytes of one record to its values
        self.iter_unpack = packed.iter_unpack  # bytes of many to an iterator of their values
        # what numpy.dtype() takes
        self.dtype: Dict[str, Any] = {"names": names, "formats": formats, "offsets": offsets, "itemsize": self.size}


def _numpy_format(code: str) -> Any:
    kind = {"Q": "<u8", "q": "<i8", "I": "<u4", "i": "<i4", "f": "<f4", "d": "<f8"}[code[-1]]
    return (kind, (int(code[:-1]),)) if code[:-1] else kind


_PAIR = "body_a:Q body_b:Q shape_a:Q shape_b:Q"
_PARTS = "part_a:i part_b:i triangle_a:i triangle_b:i"
_SURFACES = "material_a:Q material_b:Q"

TRANSFORM = Packed("position:3d rotation:4f")
RAY = Packed("origin:3d translation:3d")
PATH = Packed("position:3d rotation:4f translation:3d")
HIT = Packed(
    "body:Q shape:Q point:3d fraction:d material:Q normal:3f depth:f part:i triangle:i barycentric:2f flags:I "
    "reserved:20x"
)
OVERLAP = Packed("body:Q shape:Q material:Q direction:3f depth:f part:i triangle:i reserved:16x")
PAIR_EVENT = Packed(f"{_PAIR} kind:i is_trigger:i {_PARTS} reserved:16x")
BODY_EVENT = Packed("body:Q kind:i reserved:4x")
HIT_EVENT = Packed(f"{_PAIR} {_SURFACES} point:3d normal:3f speed:f impulse:f {_PARTS} reserved:20x")
JOINT_EVENT = Packed("joint:Q body_a:Q body_b:Q user_data:Q kind:i type:i force:3f torque:3f")
HULL_FACE = Packed("first:i count:i normal:3f distance:f reserved:8x")
CONTACT_POINT = Packed("point:3d separation:f normal_impulse:f total_impulse:f id:I")
CONTACT = Packed(
    f"{_PAIR} {_SURFACES} normal:3f point_count:i points:4*CONTACT_POINT friction_impulse:3f twist_impulse:f {_PARTS} "
    "reserved:16x"
)

ASSET_KEY = Packed("words:2Q")
HISTORY_FRAME = Packed("frame:q bytes:q")
DRAW_VERTEX = Packed("x:f y:f z:f rgba:I owner:Q")
DRAW_INSTANCE = Packed(
    "type:i rgba:I shape:Q body:Q asset:Q position:3f rotation:4f half_extents:3f part:i reserved:12x"
)

EVENT_KINDS = {1: "enter", 2: "stay", 3: "exit", 4: "sleep", 5: "wake", 6: "break"}
BODY_TYPES = ("static", "kinematic", "dynamic")
JOINT_TYPES = {1: "distance", 2: "ball", 3: "hinge", 4: "fixed", 5: "configurable"}


def read_all(read: Callable[..., int], record: Packed, *arguments: Any) -> List[Tuple[Any, ...]]:
    """All records that `read` has to give, as plain tuples."""
    count = read(*arguments, None)
    if count == 0:
        return []
    buffer = bytearray(count * record.size)
    read(*arguments, buffer)
    return list(record.iter_unpack(buffer))


SOME = 16
"""As many as most queries find: with room for them the search is made once, not to count first."""


def read_found(read: Callable[..., int], record: Packed, *arguments: Any) -> bytearray:
    """All records that a query has to give, as they are packed."""
    buffer = bytearray(SOME * record.size)
    count = read(*arguments, buffer)
    if count > SOME:
        buffer = bytearray(count * record.size)
        read(*arguments, buffer)
    elif count < SOME:
        del buffer[count * record.size :]
    return buffer


def read_handles(read: Callable[..., int], *arguments: Any) -> "array[int]":
    """All handles that `read` has to give."""
    handles = array("Q", bytes(8 * SOME))
    count = read(*arguments, handles)
    if count > SOME:
        handles = array("Q", bytes(8 * count))
        read(*arguments, handles)
    elif count < SOME:
        del handles[count:]
    return handles
