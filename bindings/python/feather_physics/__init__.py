"""Feather: 3D rigid-body physics, the same bits on every machine.

    with World(gravity=(0, -9.81, 0)) as world:
        world.create_body("static").add_plane()
        ball = world.create_body(position=(0, 5, 0))
        ball.add_sphere(0.5)
        for _ in range(60):
            world.step(1 / 60)
        print(ball.position.y)

Metres, kilograms, seconds, radians; right-handed axes; rotations are x, y, z, w. Different worlds may be used by
different threads at once. One world may be read by several threads at once, or written by one. include/feather.h
describes everything in full: fields and functions have its names.
"""

from . import _flat
from ._flat import Bounds, Quat, Transform, Vec3
from .errors import (
    BusyError,
    DataError,
    DegenerateError,
    DivergedError,
    FeatherError,
    InvalidArgumentError,
    LimitError,
    OutOfMemoryError,
    SceneError,
    StaleHandleError,
    StateError,
    SteppingError,
    UnsupportedError,
    VersionError,
    WrongKindError,
)
from .history import History
from .objects import Body, Joint, Shape
from .recording import Divergence, Note, Player, PlayerInfo, Recorder, Recording
from .records import (
    BodyEvent,
    Box,
    Capsule,
    Closest,
    CompoundInfo,
    Cone,
    Contact,
    ContactPoint,
    Counters,
    Cylinder,
    Difference,
    Energy,
    Filter,
    FilterPair,
    Geometry,
    Hertz,
    Hit,
    HitEvent,
    HullFace,
    HullInfo,
    JointEvent,
    JointState,
    MassData,
    Material,
    MeshEdge,
    MeshInfo,
    MeshTriangle,
    Momentum,
    Overlap,
    Packed,
    PairEvent,
    Part,
    Plane,
    Profile,
    Scaled,
    SnapshotInfo,
    Sphere,
    Tuning,
    Vector,
)
from .snapshot import compare_snapshots, snapshot_assets, snapshot_info
from .state import State
from .store import Asset, Compound, Heightfield, Hull, Mesh, Store
from .sweeping import SweepError, sweep
from .worlds import Worlds, WorldsError
from .world import Pool, World

__all__ = [
    "Asset",
    "Body",
    "BodyEvent",
    "Bounds",
    "Box",
    "BusyError",
    "Capsule",
    "Closest",
    "Compound",
    "CompoundInfo",
    "Cone",
    "Contact",
    "ContactPoint",
    "Counters",
    "Cylinder",
    "DataError",
    "DegenerateError",
    "Difference",
    "Divergence",
    "DivergedError",
    "Energy",
    "FeatherError",
    "Filter",
    "FilterPair",
    "Geometry",
    "Heightfield",
    "Hertz",
    "History",
    "Hit",
    "HitEvent",
    "Hull",
    "HullFace",
    "HullInfo",
    "InvalidArgumentError",
    "Joint",
    "JointEvent",
    "JointState",
    "LimitError",
    "MassData",
    "Material",
    "Mesh",
    "MeshEdge",
    "MeshInfo",
    "MeshTriangle",
    "Momentum",
    "Note",
    "OutOfMemoryError",
    "Overlap",
    "Packed",
    "PairEvent",
    "Part",
    "Plane",
    "Player",
    "PlayerInfo",
    "Pool",
    "Profile",
    "Quat",
    "Recorder",
    "Recording",
    "Scaled",
    "SceneError",
    "Shape",
    "SnapshotInfo",
    "Sphere",
    "StaleHandleError",
    "StateError",
    "SteppingError",
    "State",
    "Store",
    "SweepError",
    "Transform",
    "Tuning",
    "UnsupportedError",
    "Vec3",
    "Vector",
    "VersionError",
    "World",
    "Worlds",
    "WorldsError",
    "WrongKindError",
    "compare_snapshots",
    "snapshot_assets",
    "snapshot_info",
    "sweep",
]
__version__ = ".".join(str(_flat.version() >> shift & 0xFF) for shift in (16, 8, 0))
