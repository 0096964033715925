"""Worlds: they make everything else, step it, and answer queries."""

from __future__ import annotations

from array import array
from types import TracebackType
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Type, Union

from . import _flat, records
from ._flat import Vec3
from .objects import Body, Heightfield, Joint, Shape, axes_bits, body_type, fill, flat_geometry, handle_of, word
from .records import NO_ROTATION, Geometry, Material, Vector

ALL_LAYERS = 0xFFFFFFFF
SIMD_SETS = {"auto": 0, "plain": 1, "sse2": 2, "avx2": 3, "avx512": 4, "neon": 5}


class Pool:
    """Worker threads that several worlds may share."""

    __slots__ = ("_capsule",)

    def __init__(self, workers: int):
        self._capsule = _flat.pool_create(workers)

    def close(self) -> None:
        """Ends the threads. A StateError while a world uses them."""
        _flat.pool_destroy(self._capsule)


class World:
    """Everything that can touch each other. `with World() as world:` closes it at the end; so does losing it and all that is in it."""

    def __init__(
        self,
        *,
        gravity: Vector = (0.0, -9.81, 0.0),
        workers: int = 1,
        substeps: int = 8,
        simd: str = "auto",
        pool: Optional[Pool] = None,
        tag: int = 0,
    ):
        """Gravity is m/s2; workers, 1 to 64, are threads of its own unless a pool is given; the results do not depend on them."""
        desc = _flat.world_def()
        desc.gravity = gravity
        desc.worker_count = workers
        desc.substeps = substeps
        desc.simd = word(SIMD_SETS, simd, "simd")
        desc.user_data = tag
        if pool is not None:
            desc.pool = pool._capsule
        self._capsule = _flat.world_create(desc)
        if pool is not None:
            _flat.world_keep(self._capsule, pool._capsule)
        self._closed = False
        self._user_data: Dict[int, Any] = {}

    def close(self) -> None:
        """Destroys the world and all in it: whatever was in it is stale afterwards. Closing again does nothing."""
        if not self._closed:
            _flat.world_destroy(self._capsule)
            self._closed = True
            self._user_data.clear()

    @property
    def closed(self) -> bool:
        """True after close()."""
        return self._closed

    def __enter__(self) -> "World":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<World, closed>" if self._closed else f"<World of {self.counters.bodies} bodies>"

    # ---- the world itself ----

    def step(self, dt: float = 1 / 60) -> None:
        """Moves the world on by dt seconds, 0 to 1. Other Python threads run meanwhile."""
        _flat.world_step(self._capsule, dt)

    @property
    def gravity(self) -> Union[Vec3, Vector]:
        """m/s2. A change wakes all dynamic bodies."""
        gravity: Vec3 = _flat.world_get_gravity(self._capsule)
        return gravity

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        _flat.world_set_gravity(self._capsule, value)

    @property
    def substeps(self) -> int:
        """1 to 64 parts of each step."""
        substeps: int = _flat.world_get_substeps(self._capsule)
        return substeps

    @substeps.setter
    def substeps(self, value: int) -> None:
        _flat.world_set_substeps(self._capsule, value)

    @property
    def tag(self) -> int:
        """The integer given to World()."""
        tag: int = _flat.world_get_user_data(self._capsule)
        return tag

    @property
    def tuning(self) -> records.Tuning:
        """How the solver behaves. Set it with world.tuning = world.tuning._replace(contact_hertz=40)."""
        return records.copy_record(records.Tuning, _flat.world_get_tuning(self._capsule))

    @tuning.setter
    def tuning(self, value: records.Tuning) -> None:
        flat = _flat.world_tuning()
        for name, number in zip(records.Tuning._fields, value):
            setattr(flat, name, number)
        _flat.world_set_tuning(self._capsule, flat)

    @property
    def profile(self) -> records.Profile:
        """Where the last step's time went, ms."""
        return records.copy_record(records.Profile, _flat.world_get_profile(self._capsule))

    @property
    def counters(self) -> records.Counters:
        """How much there is of everything."""
        return records.copy_record(records.Counters, _flat.world_get_counters(self._capsule))

    @property
    def hash(self) -> int:
        """64 bits over poses, velocities, contacts and events: equal for equal runs, on every machine and with every number of workers."""
        value: int = _flat.world_hash(self._capsule)
        return value

    def sync_queries(self) -> None:
        """Rebalances the trees that serve the queries; worth a call after a level is loaded."""
        _flat.world_sync_queries(self._capsule)

    def ignore_collision(self, a: Body, b: Body, ignore: bool = True) -> None:
        """While ignored, two bodies never collide."""
        _flat.world_ignore_collision(self._capsule, self._body(a), self._body(b), 1 if ignore else 0)

    # ---- bodies ----

    def create_body(
        self,
        type: str = "dynamic",
        *,
        position: Vector = (0.0, 0.0, 0.0),
        rotation: Vector = NO_ROTATION,
        linear_velocity: Vector = (0.0, 0.0, 0.0),
        angular_velocity: Vector = (0.0, 0.0, 0.0),
        damping: Sequence[float] = (0.0, 0.0),
        locks: Sequence[str] = ("", ""),
        user_data: Any = None,
        **fields: Any,
    ) -> Body:
        """A "static", "kinematic" or "dynamic" body. Further fields are those of fe_body_def: gravity_scale, bullet, awake, tag..."""
        body = Body(self, _flat.body_create(self._capsule, _body_def(type, position, rotation, linear_velocity, angular_velocity, damping, locks, fields)))
        if user_data is not None:
            body.user_data = user_data
        return body

    def create_bodies(self, positions: Iterable[Vector], type: str = "dynamic", *, rotation: Vector = NO_ROTATION, **fields: Any) -> List[Body]:
        """A body at each position, all or none; the fields as in create_body()."""
        nothing = (0.0, 0.0, 0.0)
        locks, damping = fields.pop("locks", ("", "")), fields.pop("damping", (0.0, 0.0))
        descs = [_body_def(type, position, rotation, nothing, nothing, damping, locks, fields) for position in positions]
        ids = array("Q", bytes(8 * len(descs)))
        _flat.body_create_many(self._capsule, descs, ids)
        return [Body(self, id) for id in ids]

    def destroy_bodies(self, bodies: Any) -> None:
        """All or none: one that is stale or given twice, and none is destroyed."""
        ids = self._ids(bodies)
        _flat.body_destroy_many(self._capsule, ids)
        for id in memoryview(ids).tolist() if self._user_data else ():
            self._user_data.pop(id, None)

    @property
    def bodies(self) -> List[Body]:
        """All, in the order of creation."""
        return [Body(self, id) for id in self.body_ids()]

    def body_ids(self) -> "array[int]":
        """The handles of all bodies, in the order of creation: what the bulk calls take."""
        return records.read_handles(_flat.world_get_bodies, self._capsule)

    @property
    def joints(self) -> List[Joint]:
        """All, in the order of creation."""
        return [Joint(self, id) for id in records.read_handles(_flat.world_get_joints, self._capsule)]

    def create_heightfield(
        self,
        heights: Any,
        *,
        rows: Optional[int] = None,
        columns: Optional[int] = None,
        cell_x: float = 1.0,
        cell_z: float = 1.0,
        holes: Any = None,
        cell_materials: Any = None,
        materials: Optional[Sequence[Sequence[float]]] = None,
    ) -> Heightfield:
        """Terrain from rows (along z) of samples (along x), m: a sequence of rows, or a buffer of float32 of that shape, or a flat one with rows and
        columns. Holes and cell_materials are bytes, one a cell. body.add(heightfield) gives it to a body."""
        samples, rows, columns = _samples(heights, rows, columns)
        desc = (rows, columns, cell_x, cell_z, samples, holes, cell_materials, materials)
        return Heightfield(self, _flat.heightfield_create(self._capsule, desc))

    # ---- joints: further fields are those of the definitions in feather.h ----

    def create_distance(self, a: Body, b: Body, point_a: Vector, point_b: Vector, **fields: Any) -> Joint:
        """A rod between two points of the world, as long as they are apart now; min_length=0 makes it a rope."""
        return self._joint("distance", _flat.distance_def_at, a, b, (point_a, point_b), fields)

    def create_ball(self, a: Body, b: Body, point: Vector, axis: Vector = (1.0, 0.0, 0.0), **fields: Any) -> Joint:
        """Two points stay together; swing and twist are about an axis of the world."""
        return self._joint("ball", _flat.ball_def_at, a, b, (point, axis), fields)

    def create_hinge(self, a: Body, b: Body, point: Vector, axis: Vector, **fields: Any) -> Joint:
        """B turns against A about an axis of the world."""
        return self._joint("hinge", _flat.hinge_def_at, a, b, (point, axis), fields)

    def create_fixed(self, a: Body, b: Body, point: Vector, **fields: Any) -> Joint:
        """Nothing moves."""
        return self._joint("fixed", _flat.fixed_def_at, a, b, (point,), fields)

    def create_configurable(self, a: Body, b: Body, point: Vector, axis: Vector = (1.0, 0.0, 0.0), **fields: Any) -> Joint:
        """Six axes: along_x={"mode": "limited", "low": -1, "high": 1}, about_y={"mode": "free"}...; those not named are locked."""
        return self._joint("configurable", _flat.configurable_def_at, a, b, (point, axis), fields)

    def create_rope(self, a: Body, b: Body, point_a: Vector, point_b: Vector, max_length: float, **fields: Any) -> Joint:
        """Two points come no farther from each other than max_length, m."""
        return self._joint("distance", _flat.rope_def_at, a, b, (point_a, point_b, max_length), fields)

    def create_slider(self, a: Body, b: Body, point: Vector, axis: Vector, **fields: Any) -> Joint:
        """B slides along an axis and does not turn; range, spring and motor are those of along_x."""
        return self._joint("configurable", _flat.slider_def_at, a, b, (point, axis), fields)

    def create_wheel(
        self, chassis: Body, wheel: Body, point: Vector, axle: Vector, up: Vector, hertz: float, damping_ratio: float, travel: float, **fields: Any
    ) -> Joint:
        """A wheel with suspension: about_x is its motor and brake, about_z steers."""
        return self._joint("configurable", _flat.wheel_def_at, chassis, wheel, (point, axle, up, hertz, damping_ratio, travel), fields)

    def create_motor(
        self, a: Body, b: Body, hertz: float, damping_ratio: float, max_force: float, max_torque: float, **fields: Any
    ) -> Joint:
        """Pulls and turns B towards a pose relative to A."""
        return self._joint("configurable", _flat.motor_def_at, a, b, (hertz, damping_ratio, max_force, max_torque), fields)

    def _joint(self, kind: str, place: Callable[..., Any], a: Body, b: Body, where: Tuple[Any, ...], fields: Dict[str, Any]) -> Joint:
        desc = getattr(_flat, kind + "_def")()
        place(self._capsule, desc, self._body(a), self._body(b), *where)
        fill(desc, fields)
        return Joint(self, getattr(_flat, kind + "_create")(self._capsule, desc))

    # ---- queries: `mask` says which layers count, `exclude` which bodies do not ----

    def raycast(
        self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = ()
    ) -> Optional[records.Hit]:
        """The first body on the segment from origin to origin + translation, or None."""
        return self._hit(_flat.world_raycast(self._capsule, origin, translation, self._filter(mask, triggers, exclude)))

    def raycast_any(self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = ()) -> bool:
        """Is anything on the segment?"""
        found: bool = _flat.world_raycast_any(self._capsule, origin, translation, self._filter(mask, triggers, exclude))
        return found

    def raycast_all(
        self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = ()
    ) -> List[records.Hit]:
        """Every body on the segment, nearest first."""
        return self._hits(_flat.world_raycast_all, origin, translation, self._filter(mask, triggers, exclude))

    def sweep(
        self,
        geometry: Geometry,
        position: Vector,
        translation: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> Optional[records.Hit]:
        """What a Sphere, Capsule or Box that moves without turning touches first, or None."""
        start = (position, rotation)
        flat = flat_geometry(self, geometry)
        return self._hit(_flat.world_sweep(self._capsule, flat, start, translation, self._filter(mask, triggers, exclude)))

    def sweep_any(
        self,
        geometry: Geometry,
        position: Vector,
        translation: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> bool:
        """Does it touch anything?"""
        start = (position, rotation)
        flat = flat_geometry(self, geometry)
        found: bool = _flat.world_sweep_any(self._capsule, flat, start, translation, self._filter(mask, triggers, exclude))
        return found

    def sweep_all(
        self,
        geometry: Geometry,
        position: Vector,
        translation: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> List[records.Hit]:
        """Every body that it touches on its way, nearest first."""
        flat = flat_geometry(self, geometry)
        return self._hits(_flat.world_sweep_all, flat, (position, rotation), translation, self._filter(mask, triggers, exclude))

    def overlap(
        self,
        geometry: Geometry,
        position: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> List[Body]:
        """The bodies that a Sphere, Capsule or Box overlaps, in the order of creation."""
        flat = flat_geometry(self, geometry)
        at = (position, rotation)
        ids = records.read_handles(_flat.world_overlap, self._capsule, flat, at, self._filter(mask, triggers, exclude))
        return [Body(self, id) for id in ids]

    def overlap_any(
        self,
        geometry: Geometry,
        position: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> bool:
        """Does it overlap anything?"""
        flat = flat_geometry(self, geometry)
        found: bool = _flat.world_overlap_any(self._capsule, flat, (position, rotation), self._filter(mask, triggers, exclude))
        return found

    def closest_point(
        self, point: Vector, max_distance: float, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = ()
    ) -> Optional[records.Closest]:
        """The point of all surfaces that is closest to a point, or None within max_distance, m."""
        return self._closest(_flat.world_closest_point(self._capsule, point, max_distance, self._filter(mask, triggers, exclude)))

    def raycast_many(
        self, rays: Any, out: Any = None, *, spread: bool = True, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = ()
    ) -> Any:
        """raycast() for a buffer of rays (6 doubles each: origin, translation), over the world's workers when `spread`. Fills a buffer of hits (72
        bytes each, see records.HIT) and returns it; of a miss the body is 0 and the fraction 1."""
        if out is None:
            out = bytearray(memoryview(rays).nbytes // records.RAY.size * records.HIT.size)
        _flat.world_raycast_many(self._capsule, rays, self._filter(mask, triggers, exclude), 1 if spread else 0, out)
        return out

    def sweep_many(
        self,
        geometry: Geometry,
        paths: Any,
        out: Any = None,
        *,
        spread: bool = True,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = (),
    ) -> Any:
        """sweep() of one geometry for a buffer of paths (64 bytes each, see records.PATH), like raycast_many()."""
        if out is None:
            out = bytearray(memoryview(paths).nbytes // records.PATH.size * records.HIT.size)
        flat = flat_geometry(self, geometry)
        _flat.world_sweep_many(self._capsule, flat, paths, self._filter(mask, triggers, exclude), 1 if spread else 0, out)
        return out

    # ---- events of the last step, in an order that does not depend on the workers ----

    @property
    def pair_events(self) -> List[records.PairEvent]:
        """Shapes that began, went on, or ceased to touch."""
        return [
            records.PairEvent(records.EVENT_KINDS[kind], Body(self, a), Body(self, b), Shape(self, shape_a), Shape(self, shape_b), trigger != 0)
            for a, b, shape_a, shape_b, kind, trigger in records.read_all(_flat.world_get_pair_events, records.PAIR_EVENT, self._capsule)
        ]

    @property
    def body_events(self) -> List[records.BodyEvent]:
        """Bodies that fell asleep or woke."""
        found = records.read_all(_flat.world_get_body_events, records.BODY_EVENT, self._capsule)
        return [records.BodyEvent(records.EVENT_KINDS[kind], Body(self, body)) for body, kind, _ in found]

    @property
    def hit_events(self) -> List[records.HitEvent]:
        """Impacts of shapes that asked for them with events=("hit",)."""
        return [
            records.HitEvent(
                Body(self, e[0]), Body(self, e[1]), Shape(self, e[2]), Shape(self, e[3]), Vec3(e[4:7]), Vec3(e[7:10]), e[10], e[11]
            )
            for e in records.read_all(_flat.world_get_hit_events, records.HIT_EVENT, self._capsule)
        ]

    @property
    def joint_events(self) -> List[records.JointEvent]:
        """Joints that broke."""
        return [
            records.JointEvent(
                Joint(self, e[0]), Body(self, e[1]), Body(self, e[2]), e[3], records.JOINT_TYPES[e[5]], Vec3(e[6:9]), Vec3(e[9:12])
            )
            for e in records.read_all(_flat.world_get_joint_events, records.JOINT_EVENT, self._capsule)
        ]

    def read_events(self, kind: str, out: Any = None) -> int:
        """Fills a buffer with the packed events "pair", "body", "hit" or "joint" (see records.PAIR_EVENT...) and returns how many there are."""
        read = word({"pair": 0, "body": 1, "hit": 2, "joint": 3}, kind, "kind")
        functions = (_flat.world_get_pair_events, _flat.world_get_body_events, _flat.world_get_hit_events, _flat.world_get_joint_events)
        count: int = functions[read](self._capsule, out)
        return count

    # ---- bulk: buffers in, buffers out. Bodies are a buffer of handles (see body_ids) or a sequence of Body ----

    def transforms(self, out: Any = None, *, bodies: Any = None, origin: Vector = (0.0, 0.0, 0.0)) -> Any:
        """Position relative to an origin and rotation, 7 float32 a body: x y z, x y z w; of all bodies unless some are given. Fills `out`, any buffer
        of float32 (a NumPy array of shape (n, 7) for example), or makes a memoryview of that shape."""
        ids = self.body_ids() if bodies is None else self._ids(bodies)
        if out is None:
            out = _floats(ids, 7)
        _flat.world_get_transforms_f32(self._capsule, ids, origin, out)
        return out

    def velocities(self, out: Any = None, *, bodies: Any = None) -> Any:
        """Linear and angular velocity, 6 float32 a body, like transforms()."""
        ids = self.body_ids() if bodies is None else self._ids(bodies)
        if out is None:
            out = _floats(ids, 6)
        _flat.world_get_velocities(self._capsule, ids, out)
        return out

    def set_velocities(self, bodies: Any, velocities: Any) -> None:
        """Linear and angular velocity from a buffer of 6 float32 a body."""
        _flat.world_set_velocities(self._capsule, self._ids(bodies), velocities)

    def add_forces(self, bodies: Any, forces: Any) -> None:
        """Force, N, at the centre, and torque, N m, from a buffer of 6 float32 a body, during the next step."""
        _flat.world_add_forces(self._capsule, self._ids(bodies), forces)

    def exact_transforms(self, out: Any = None, *, bodies: Any = None) -> Any:
        """Position as 3 doubles and rotation as 4 floats, 40 bytes a body (see records.TRANSFORM): fills `out` or makes a bytearray."""
        ids = self.body_ids() if bodies is None else self._ids(bodies)
        if out is None:
            out = bytearray(memoryview(ids).nbytes // 8 * records.TRANSFORM.size)
        _flat.world_get_transforms(self._capsule, ids, out)
        return out

    def set_transforms(self, bodies: Any, transforms: Any) -> None:
        """Moves bodies at once; 40 bytes a body as in exact_transforms()."""
        _flat.world_set_transforms(self._capsule, self._ids(bodies), transforms)

    def moved(self) -> Tuple["array[int]", bytearray]:
        """The handles of the bodies that the last step moved, and where they are now (40 bytes a body, see records.TRANSFORM)."""
        count = _flat.world_get_moved(self._capsule, None, None)
        ids, transforms = array("Q", bytes(8 * count)), bytearray(count * records.TRANSFORM.size)
        _flat.world_get_moved(self._capsule, ids, transforms)
        return ids, transforms

    # ---- within the package ----

    def _body(self, body: Body) -> int:
        return handle_of(self, body, Body)

    def _ids(self, bodies: Any) -> Any:
        if isinstance(bodies, (list, tuple)):
            return array("Q", [handle_of(self, body, Body) for body in bodies])
        return bodies

    def _filter(self, mask: int, triggers: bool, exclude: Any) -> Optional[Tuple[int, int, Any]]:
        if mask == ALL_LAYERS and not triggers and exclude == ():
            return None
        if isinstance(exclude, Body):
            exclude = (exclude,)
        return mask, 1 if triggers else 0, self._ids(exclude) if len(exclude) else None

    def _hit(self, flat: Any) -> Optional[records.Hit]:
        if flat is None:
            return None
        return records.Hit(
            Body(self, flat.body), Shape(self, flat.shape), flat.point, flat.fraction, flat.normal, flat.triangle, flat.depth, flat.flags & 1 != 0
        )

    def _hits(self, read: Callable[..., int], *arguments: Any) -> List[records.Hit]:
        return [
            records.Hit(Body(self, h[0]), Shape(self, h[1]), Vec3(h[2:5]), h[5], Vec3(h[6:9]), h[9], h[10], h[11] & 1 != 0)
            for h in records.read_all(read, records.HIT, self._capsule, *arguments)
        ]

    def _closest(self, flat: Any) -> Optional[records.Closest]:
        if flat is None:
            return None
        return records.Closest(Body(self, flat.body), Shape(self, flat.shape), flat.point, flat.distance, flat.normal, flat.triangle)

    def _contacts(self, read: Callable[..., int], id: int) -> List[records.Contact]:
        return [_contact(self, c) for c in records.read_all(read, records.CONTACT, self._capsule, id)]

    def _forget(self, body: Body) -> None:
        if self._user_data:
            for entity in (body, *body.shapes, *body.joints):
                self._user_data.pop(entity._id, None)


def _contact(world: World, c: Tuple[Any, ...]) -> records.Contact:
    points = (c[8 + 7 * i : 15 + 7 * i] for i in range(c[7]))
    return records.Contact(
        Body(world, c[0]),
        Body(world, c[1]),
        Shape(world, c[2]),
        Shape(world, c[3]),
        Vec3(c[4:7]),
        tuple(records.ContactPoint(Vec3(p[:3]), *p[3:]) for p in points),
        Vec3(c[36:39]),
        c[39],
        c[40],
    )


def _body_def(
    type: str,
    position: Vector,
    rotation: Vector,
    linear_velocity: Vector,
    angular_velocity: Vector,
    damping: Sequence[float],
    locks: Sequence[str],
    fields: Dict[str, Any],
) -> Any:
    desc = _flat.body_def()
    desc.type = body_type(type)
    desc.transform = (position, rotation)
    desc.linear_velocity = linear_velocity
    desc.angular_velocity = angular_velocity
    desc.linear_damping, desc.angular_damping = damping
    linear, angular = locks
    desc.linear_locks, desc.angular_locks = axes_bits(linear), axes_bits(angular)
    fill(desc, fields)
    return desc


def _floats(ids: Any, width: int) -> memoryview:
    count = memoryview(ids).nbytes // 8
    return memoryview(bytearray(4 * width * max(count, 1))).cast("f", (max(count, 1), width))[:count]


def _samples(heights: Any, rows: Optional[int], columns: Optional[int]) -> Tuple[Any, int, int]:
    view: Optional[memoryview]
    try:
        view = memoryview(heights)
        if view.format != "f":
            heights = view.tolist()
            view = None
    except TypeError:
        view = None
    if view is not None and view.ndim == 2 and view.shape is not None:
        return heights, view.shape[0], view.shape[1]
    if view is None:
        if rows is None or columns is None:
            heights = [list(row) for row in heights]
            rows, columns = len(heights), len(heights[0]) if heights else 0
            if any(len(row) != columns for row in heights):
                raise ValueError("heights: the rows are not of one length")
            heights = [height for row in heights for height in row]
        return array("f", heights), rows, columns
    if rows is None or columns is None:
        raise ValueError("heights: a flat buffer needs rows and columns")
    return heights, rows, columns
