"""What a scene holds (scene.py): bodies, shapes, joints, frames and their names, as plain records."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import List, Optional

from .frames import NO_TURN, ORIGIN, Triple, Turn


@dataclass
class SceneMesh:
    """Points, m, three numbers each, and triangles, three places of points each, counterclockwise seen from outside.
    Without triangles the hull of the points counts. `file`: where it is from, and by what it was scaled, as a URDF
    has it."""

    name: str
    points: List[float]
    triangles: List[int] = field(default_factory=list)
    file: str = ""
    scale: Triple = (1.0, 1.0, 1.0)


@dataclass
class SceneShape:
    """A form on a body: "box" (half extents), "sphere" (radius), "capsule", "cylinder" (half height, radius; along Y),
    "plane" (no size, Y is up), on static bodies, or "mesh": one of the scene's, by name, whose triangles count on static
    bodies, its hull on others."""

    form: str
    size: List[float]
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN
    density: float = 1000.0
    friction: Optional[float] = None
    mesh: str = ""


@dataclass
class SceneBody:
    """A body and where it is. Without a mass that of its shapes counts. Inertia: principal moments, kg m2, about the
    centre, and their axes."""

    name: str
    type: str = "dynamic"
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN
    mass: Optional[float] = None
    centre: Triple = ORIGIN
    inertia: Triple = ORIGIN
    inertia_rotation: Turn = NO_TURN
    shapes: List[SceneShape] = field(default_factory=list)


@dataclass
class SceneFrame:
    """A named frame of a body, None is the world: a tool's, a sensor's, that of a link without mass."""

    name: str
    body: Optional[str]
    position: Triple = ORIGIN
    rotation: Turn = NO_TURN


@dataclass
class SceneFreedom:
    """One axis along or about which a "configurable" joint moves: "linear_x" ... "angular_z" of its frame; or a part of
    a "chain": "linear", "angular" or "ball", with a place and a direction of its own."""

    name: str
    axis: str
    lower: Optional[float] = None
    upper: Optional[float] = None
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    armature: float = 0.0
    position: Triple = ORIGIN
    direction: Triple = (1.0, 0.0, 0.0)
    cone: Optional[float] = None


@dataclass
class SceneJoint:
    """A joint of two bodies, None is the world: "fixed", "hinge", "slider", "ball", "planar", "configurable", "chain"
    (one joint after another, from `a` to `b`, each with axes of its own) or "free" (none). The place, the axis and the
    rotation, which is that of a configurable joint's frame, are the scene's, where the bodies stand. Limits: rad or m,
    None are none; cone: rad, of a ball; effort: N m or N, velocity: rad/s or m/s, as the file has them; damping: N m
    s/rad or N s/m; friction: N m or N; stiffness: N m/rad or N/m, of a spring that pulls to `rest`; armature: kg m2,
    what the motor's rotor adds to the inertia about the axis."""

    name: str
    type: str
    a: Optional[str]
    b: str
    position: Triple
    axis: Triple = (1.0, 0.0, 0.0)
    lower: Optional[float] = None
    upper: Optional[float] = None
    effort: Optional[float] = None
    velocity: Optional[float] = None
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    armature: float = 0.0
    cone: Optional[float] = None
    rotation: Turn = NO_TURN
    freedoms: List[SceneFreedom] = field(default_factory=list)


@dataclass
class SceneActuator:
    """A drive of a joint, or of a configurable joint's freedom, by name. A "motor" has the torque or force gear * u; a
    "position" gain * (u - q), a "velocity" gain * (u - v) for q, v = gear times coordinate and rate, times gear. u and
    the force stay within their limits, None are none. A scene keeps them; the program drives."""

    name: str
    type: str
    joint: str
    gear: float = 1.0
    gain: float = 1.0
    lower: Optional[float] = None
    upper: Optional[float] = None
    force_lower: Optional[float] = None
    force_upper: Optional[float] = None
