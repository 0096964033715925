"""Feather: 3D rigid-body physics, the same bits on every machine.

    with World(gravity=(0, -9.81, 0)) as world:
        world.create_body("static").add_plane()
        ball = world.create_body(position=(0, 5, 0))
        ball.add_sphere(0.5)
        for _ in range(60):
            world.step(1 / 60)
        print(ball.position.y)

Metres, kilograms, seconds, radians; right-handed axes; rotations are x, y, z, w. Different worlds may be used by different threads at once; one world
by one thread at a time, except that several may read it. include/feather.h tells more of everything: the fields and functions have its names.
"""

from . import _flat
from ._flat import Quat, Transform, Vec3
from .errors import (
    FeatherError,
    InvalidArgumentError,
    LimitError,
    OutOfMemoryError,
    StaleHandleError,
    StateError,
    SteppingError,
    UnsupportedError,
    WrongKindError,
)
from .objects import Body, Heightfield, Joint, Shape
from .records import (
    BodyEvent,
    Box,
    Capsule,
    Closest,
    Contact,
    ContactPoint,
    Counters,
    Geometry,
    Hit,
    HitEvent,
    JointEvent,
    JointState,
    MassData,
    Material,
    PairEvent,
    Plane,
    Profile,
    Sphere,
    Tuning,
    Vector,
)
from .world import Pool, World

__all__ = [
    "Body",
    "BodyEvent",
    "Box",
    "Capsule",
    "Closest",
    "Contact",
    "ContactPoint",
    "Counters",
    "FeatherError",
    "Geometry",
    "Heightfield",
    "Hit",
    "HitEvent",
    "InvalidArgumentError",
    "Joint",
    "JointEvent",
    "JointState",
    "LimitError",
    "MassData",
    "Material",
    "OutOfMemoryError",
    "PairEvent",
    "Plane",
    "Pool",
    "Profile",
    "Quat",
    "Shape",
    "Sphere",
    "StaleHandleError",
    "StateError",
    "SteppingError",
    "Transform",
    "Tuning",
    "UnsupportedError",
    "Vec3",
    "Vector",
    "World",
    "WrongKindError",
]
__version__ = ".".join(str(_flat.version() >> shift & 0xFF) for shift in (16, 8, 0))
