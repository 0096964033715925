"""Worlds: they make everything else, step it, and answer queries."""

from __future__ import annotations

import os
import weakref
from array import array
from types import TracebackType
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Type, TypeVar, Union, overload

from . import _flat, picture, records
from ._flat import Bounds, Vec3
from .errors import UnsupportedError
from .history import History
from .objects import Body, Joint, Shape
from .recording import DRAIN_STEPS, Path, Recorder, Recording, begin
from .records import NO_ROTATION, FilterPair, Geometry, Vector
from .state import State
from .store import Compound, Heightfield, Hull, Mesh, Store, flat_geometry
from .words import SIMD_SETS, body_type, draw_bits, fill, locks_bits, word

ALL_LAYERS = 0xFFFFFFFF
NOBODY: Tuple[Body, ...] = ()
EVENTS = ("pair", "body", "hit", "joint")
DRAWN = ("lines", "triangles", "points", "instances")
ZERO = (0.0, 0.0, 0.0)
X = (1.0, 0.0, 0.0)
Found = TypeVar("Found", Body, Shape, Joint, records.Hit, records.Overlap)


class Pool:
    """Worker threads that several worlds may share."""

    __slots__ = ("_capsule",)

    def __init__(self, workers: int):
        """1 to 64 workers; the thread that steps a world is one of them."""
        self._capsule = _flat.pool_create(workers)

    def close(self) -> None:
        """Ends the threads. A StateError while a world uses them."""
        _flat.pool_destroy(self._capsule)

    def __enter__(self) -> "Pool":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()


def _unpickle(kind: "Type[World]", data: bytes, user_data: Dict[int, Any]) -> "World":
    world = kind.load(data)
    world._user_data.update(user_data)
    return world


class _Gravity:
    """m/s2. A change wakes all dynamic bodies."""

    @overload
    def __get__(self, world: None, kind: Any) -> "_Gravity": ...

    @overload
    def __get__(self, world: "World", kind: Any) -> Vec3: ...

    def __get__(self, world: Optional["World"], kind: Any = None) -> Union[Vec3, "_Gravity"]:
        if world is None:
            return self
        gravity: Vec3 = _flat.world_get_gravity(world._capsule)
        return gravity

    def __set__(self, world: "World", value: Vector) -> None:
        _flat.world_set_gravity(world._capsule, value)


class World:
    """Everything that can touch each other. `with World() as world:` closes it at the end; so does losing it and all
    that is in it."""

    __slots__ = ("_capsule", "_closed", "_store", "_has_own_store", "_user_data", "_pair_filter", "_recording", "_is_of_batch", "__weakref__")

    def __init__(
        self,
        *,
        gravity: Vector = (0.0, -9.81, 0.0),
        workers: int = 1,
        substeps: int = 8,
        simd: str = "auto",
        number: int = 0,
        pool: Optional[Pool] = None,
        store: Optional[Store] = None,
        tag: int = 0,
    ):
        """Gravity is m/s2. Workers, 1 to 64, are threads of its own unless a pool is given; results do not depend on
        them. The number, 1 to 4095, is part of the handles: worlds whose handles must agree need the same one; 0 is
        the next of a counter. The store holds heightfields, hulls and meshes; without one the world has its own."""
        definition = _flat.world_def()
        definition.gravity = gravity
        definition.worker_count = workers
        definition.substeps = substeps
        definition.simd = word(SIMD_SETS, simd, "simd")
        definition.number = number
        definition.user_data = tag
        if pool is not None:
            definition.pool = pool._capsule
        if store is not None:
            definition.store = store._capsule
        self._begin(_flat.world_create(definition), pool, store)

    def _begin(self, capsule: Any, pool: Any, store: Optional[Store]) -> None:
        self._capsule = capsule
        _flat.keep(self._capsule, (pool and pool._capsule, store and store._capsule))
        self._closed = False
        self._has_own_store = store is None
        self._store = Store._of(self._capsule) if store is None else store
        self._user_data: Dict[int, Any] = {}
        self._pair_filter: Optional[Callable[[FilterPair], Any]] = None
        self._recording: Optional[Recording] = None
        self._is_of_batch = False

    @classmethod
    def _of_player(cls, capsule: Any, store: Optional[Store]) -> "World":
        world = cls.__new__(cls)
        world._begin(capsule, None, store)
        return world

    @classmethod
    def _of_batch(cls, capsule: Any, batch: Any, source: "World") -> "World":
        """One of the worlds of a Worlds, which it keeps."""
        world = cls.__new__(cls)
        world._begin(capsule, batch, None if source._has_own_store else source._store)
        world._user_data = dict(source._user_data)
        world._is_of_batch = True
        return world

    def close(self) -> None:
        """Destroys the world and all in it: whatever was in it is stale afterwards. Closing again does nothing."""
        if not self._closed:
            _flat.world_destroy(self._capsule)
            self._closed = True
            self._user_data.clear()
            self._pair_filter = None
            if self._recording is not None:
                self._recording.close()

    def save(self, *, assets: bool = False, base: Optional[bytes] = None) -> bytes:
        """The whole world as bytes: the same on every machine, whatever the workers. What World.load() makes of them
        goes on bit for bit. With assets their contents are inside, else their keys alone. With a base, which save()
        gave without one, what differs from it alone: restore() needs the same base."""
        options = _flat.save_options()
        options.flags = (_flat.FE_SAVE_ASSETS if assets else 0) | (_flat.FE_SAVE_DIFF if base is not None else 0)
        if base is not None:
            options.set_base(base)
        saved: bytes = _flat.world_save(self._capsule, options)
        return saved

    def restore(self, data: Any, *, base: Optional[bytes] = None) -> bool:
        """Makes the world the saved one, of whichever world the bytes are. An error changes nothing. Handles of what
        was made since are stale, and may be given again to something else: objects of such things are not to be kept.
        Base: what the bytes were saved against, if they are a difference. False: another library saved it whose results
        differ, so that it goes on, but not bit for bit."""
        options = None
        if base is not None:
            options = _flat.restore_options()
            options.set_base(base)
        same: bool = _flat.world_restore(self._capsule, options, data)
        self._forget_ended()
        return same

    def _forget_ended(self) -> None:
        valid = (_flat.body_is_valid, _flat.shape_is_valid, _flat.joint_is_valid)
        kept = [id for id in self._user_data if any(is_valid(self._capsule, id) for is_valid in valid)]
        self._user_data = {id: self._user_data[id] for id in kept}

    def clone(self, *, workers: int = 1, simd: str = "auto", pool: Optional[Pool] = None) -> "World":
        """A second world like this one: both go on bit for bit, and share a store. Handles name the same things in
        both. It has the pair filter and the user data, each body's the same object."""
        definition = _flat.world_def()
        definition.worker_count = workers
        definition.simd = word(SIMD_SETS, simd, "simd")
        if pool is not None:
            definition.pool = pool._capsule
        made = type(self).__new__(type(self))
        made._begin(_flat.world_clone(self._capsule, definition), pool, None if self._has_own_store else self._store)
        made._store._user_data = self._store._user_data
        made._user_data = dict(self._user_data)
        made.set_pair_filter(self._pair_filter)
        return made

    def state(self) -> State:
        """What the world is now, in memory, in some microseconds: set_state() goes back to it, this world, a clone or
        any that uses the same store."""
        return State(_flat.state_create(self._capsule), None if self._has_own_store else self._store)

    def set_state(self, state: State) -> None:
        """The world becomes what the state is of. A StateError when that is of another store. Objects of what was made
        since are not to be kept, as after restore()."""
        if not isinstance(state, State):
            raise TypeError(f"a State is needed, not a {type(state).__name__}")
        _flat.world_set_state(self._capsule, state._capsule)
        self._forget_ended()

    def history(self, *, frames: int = 16, bytes: int = 0) -> History:
        """Keeps the last frames in memory, to go back to one of them at once: for rollback. Bytes: what all of them may
        hold together, 0: as much as they need."""
        definition = _flat.history_def()
        definition.frames = frames
        definition.bytes = bytes
        return History(_flat.history_create(self._capsule, definition), self._forget_ended)

    def recorder(
        self,
        *,
        assets: bool = True,
        fine: bool = False,
        last: bool = False,
        keyframe_steps: int = 600,
        buffer_bytes: int = 64 << 20,
    ) -> Recorder:
        """Begins a recording of each call that changes the world from here on, to be read as bytes. Assets: their
        contents are inside. Fine: who diverges is named at once. Last: a flight recorder, which keeps what fits into
        its buffer. A snapshot stands at first and after so many steps that moved something, 0: at first only. A
        StateError when the world is recorded already."""
        return Recorder(begin(self._capsule, assets, fine, last, keyframe_steps, buffer_bytes), self._capsule)

    def record(
        self,
        path: Path,
        *,
        assets: bool = True,
        fine: bool = False,
        keyframe_steps: int = 600,
        buffer_bytes: int = 64 << 20,
    ) -> Recording:
        """A recording that goes to a file, as recorder() begins it: `with world.record("run.feather"):`. The file
        grows with the steps, each 15 of them or, fine, each one, and has all of it at the end, whatever is raised."""
        name = os.fspath(path)
        capsule = begin(self._capsule, assets, fine, False, keyframe_steps, buffer_bytes)
        try:
            file = open(name, "wb")  # a file that was there stays, when the world cannot be recorded
        except BaseException:
            _flat.recorder_destroy(capsule)
            raise
        self._recording = Recording(capsule, self._capsule, file, 1 if fine else DRAIN_STEPS)
        return self._recording

    @classmethod
    def load(
        cls,
        data: Any,
        *,
        workers: int = 1,
        simd: str = "auto",
        number: int = 0,
        pool: Optional[Pool] = None,
        store: Optional[Store] = None,
    ) -> "World":
        """A new world from bytes of save(). All but what is given here is the saved world's; so is the number of its
        handles, unless one is given. Assets that are not inside are looked for in the store."""
        definition, options = _flat.world_def(), _flat.restore_options()
        definition.worker_count = workers
        definition.simd = word(SIMD_SETS, simd, "simd")
        definition.number = number
        options.new_number = number != 0
        if pool is not None:
            definition.pool = pool._capsule
        if store is not None:
            definition.store = store._capsule
        world = cls.__new__(cls)
        world._begin(_flat.world_load(definition, options, data), pool, store)
        return world

    def __reduce__(self) -> Tuple[Any, ...]:
        """pickle and copy.deepcopy: the world with its assets and the user data; of one worker, without a filter."""
        return _unpickle, (type(self), self.save(assets=True), self._user_data)

    @property
    def closed(self) -> bool:
        """True after close()."""
        return self._closed

    def __enter__(self) -> "World":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<World, closed>" if self._closed else f"<World of {self.counters.bodies} bodies>"

    # ---- the world itself ----

    def step(self, dt: float = 1 / 60) -> None:
        """Moves the world on by dt seconds, 0 to 1. Other Python threads run meanwhile. What the pair filter raised
        is raised at the end."""
        try:
            _flat.world_step(self._capsule, dt)
        finally:
            if self._recording is not None:
                self._recording._after_step()

    gravity = _Gravity()

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
        """An integer of yours below 2^64, kept by the library."""
        tag: int = _flat.world_get_user_data(self._capsule)
        return tag

    @tag.setter
    def tag(self, value: int) -> None:
        _flat.world_set_user_data(self._capsule, value)

    @property
    def number(self) -> int:
        """The number in this world's handles, 1 to 4095."""
        number: int = _flat.world_get_number(self._capsule)
        return number

    @property
    def store(self) -> Store:
        """What holds its heightfields, hulls, meshes and compounds: the one it was given, or its own."""
        return self._store

    @property
    def tuning(self) -> records.Tuning:
        """How the solver behaves. Set it with world.tuning = world.tuning._replace(contact_hertz=40)."""
        return records.copy_record(records.Tuning, _flat.world_get_tuning(self._capsule))

    @tuning.setter
    def tuning(self, value: records.Tuning) -> None:
        flat = _flat.world_tuning()
        fill(flat, records.Tuning(*value)._asdict())
        _flat.world_set_tuning(self._capsule, flat)

    def hertz(self, dt: float = 1 / 60) -> records.Hertz:
        """The stiffness that a step of dt seconds would really use: the tuning's, limited by the substep rate."""
        return records.Hertz(*_flat.world_get_hertz(self._capsule, dt))

    @property
    def bounds(self) -> Bounds:
        """The box around all shapes but planes, m. A StateError when there is none."""
        bounds: Bounds = _flat.world_get_bounds(self._capsule)
        return bounds

    def energy(self) -> records.Energy:
        """Of all enabled dynamic bodies, J: what a free flight keeps to rounding."""
        return records.copy_record(records.Energy, _flat.world_get_energy(self._capsule))

    def momentum(self, about: Vector = ZERO) -> records.Momentum:
        """Of all enabled dynamic bodies; the angular one about a point of the world, m."""
        return records.Momentum(*_flat.world_get_momentum(self._capsule, about))

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
        """64 bits over poses, velocities, contacts and events: equal for equal runs, on every machine and with every
        number of workers."""
        value: int = _flat.world_hash(self._capsule)
        return value

    def optimize(self) -> None:
        """Rebalances the trees that serve the queries; worth a call after a level is loaded."""
        _flat.world_optimize(self._capsule)

    def ignore_collision(self, a: Body, b: Body, ignore: bool = True) -> None:
        """While ignored, two bodies never collide."""
        _flat.world_ignore_collision(self._capsule, self._body(a), self._body(b), 1 if ignore else 0)

    def is_ignored(self, a: Body, b: Body) -> bool:
        """Does ignore_collision() keep the two apart?"""
        ignored: int = _flat.world_get_ignored(self._capsule, self._body(a), self._body(b))
        return ignored != 0

    def set_pair_filter(self, filter: Optional[Callable[[FilterPair], Any]]) -> None:
        """Sets a function that judges new pairs of shapes, when one of them asks for it: body.add(...,
        pair_filter=True). step() calls it once for each pair whose bounds begin to meet; it returns whether the two
        may collide. It may not use the world. When it raises, the rest of the step lets all pairs collide; step()
        raises the exception at its end. None: no filter."""
        if self._is_of_batch:
            raise UnsupportedError("set_pair_filter: the world is one of a batch, which steps without Python")
        if filter is not None and not callable(filter):
            raise TypeError(f"filter: a callable is needed, not {type(filter).__name__!r}")
        _flat.world_set_pair_filter(self._capsule, None if filter is None else _judge(weakref.ref(self)))
        self._pair_filter = filter

    # ---- bodies ----

    def create_body(
        self,
        type: str = "dynamic",
        *,
        position: Vector = ZERO,
        rotation: Vector = NO_ROTATION,
        linear_velocity: Vector = ZERO,
        angular_velocity: Vector = ZERO,
        damping: Sequence[float] = (0.0, 0.0),
        locks: Sequence[str] = ("", ""),
        user_data: Any = None,
        **fields: Any,
    ) -> Body:
        """A "static", "kinematic" or "dynamic" body. Further fields are those of fe_body_def: gravity_scale, bullet,
        awake, tag..."""
        velocities = linear_velocity, angular_velocity
        definition = _body_def(type, position, rotation, velocities, damping, locks, fields)
        body = Body(self, _flat.body_create(self._capsule, definition))
        if user_data is not None:
            body.user_data = user_data
        return body

    def create_bodies(
        self, positions: Iterable[Vector], type: str = "dynamic", *, rotation: Vector = NO_ROTATION, **fields: Any
    ) -> List[Body]:
        """A body at each position, all or none; the fields as in create_body()."""
        locks, damping = fields.pop("locks", ("", "")), fields.pop("damping", (0.0, 0.0))
        velocities = fields.pop("linear_velocity", ZERO), fields.pop("angular_velocity", ZERO)
        definitions = [
            _body_def(type, position, rotation, velocities, damping, locks, fields) for position in positions
        ]
        ids = array("Q", bytes(8 * len(definitions)))
        _flat.body_create_many(self._capsule, definitions, ids)
        return self._list(Body, ids)

    def destroy_bodies(self, bodies: Any) -> None:
        """All or none: one that is stale or given twice, and none is destroyed."""
        ids = self._ids(bodies)
        _flat.body_destroy_many(self._capsule, ids)
        for id in memoryview(ids).cast("B").cast("Q") if self._user_data else ():
            self._user_data.pop(id, None)

    @property
    def bodies(self) -> List[Body]:
        """All, in the order of creation."""
        return self._list(Body, self.body_ids())

    def body_ids(self) -> "array[int]":
        """The handles of all bodies, in the order of creation: what the bulk calls take."""
        return records.read_handles(_flat.world_get_bodies, self._capsule)

    @property
    def joints(self) -> List[Joint]:
        """All, in the order of creation."""
        return self._list(Joint, records.read_handles(_flat.world_get_joints, self._capsule))

    def create_heightfield(self, heights: Any, **options: Any) -> Heightfield:
        """Terrain in this world's store, see Store.create_heightfield()."""
        return self._store.create_heightfield(heights, **options)

    def create_hull(self, points: Any, **options: Any) -> Hull:
        """A convex hull in this world's store, see Store.create_hull()."""
        return self._store.create_hull(points, **options)

    def create_mesh(self, vertices: Any, triangles: Any, **options: Any) -> Mesh:
        """Triangles in this world's store, see Store.create_mesh()."""
        return self._store.create_mesh(vertices, triangles, **options)

    def create_compound(self, parts: Iterable[Union[records.Part, Mapping[str, Any]]]) -> Compound:
        """One form of several in this world's store, see Store.create_compound()."""
        return self._store.create_compound(parts)

    # ---- joints: an end of None is the world; further fields are those of the definitions in feather.h ----

    def create_distance_joint(
        self, a: Optional[Body], b: Optional[Body], point_a: Vector, point_b: Vector, **fields: Any
    ) -> Joint:
        """A rod between two points of the world, as long as they are apart now; lower=0 makes it a rope."""
        return self._joint("distance", _flat.distance_joint_def_at, a, b, (point_a, point_b), fields)

    def create_ball_joint(
        self, a: Optional[Body], b: Optional[Body], point: Vector, axis: Vector = X, **fields: Any
    ) -> Joint:
        """Two points stay together; swing and twist are about an axis of the world."""
        return self._joint("ball", _flat.ball_joint_def_at, a, b, (point, axis), fields)

    def create_hinge_joint(
        self, a: Optional[Body], b: Optional[Body], point: Vector, axis: Vector, **fields: Any
    ) -> Joint:
        """B rotates against A about an axis of the world."""
        return self._joint("hinge", _flat.hinge_joint_def_at, a, b, (point, axis), fields)

    def create_fixed_joint(self, a: Optional[Body], b: Optional[Body], point: Vector, **fields: Any) -> Joint:
        """Nothing moves."""
        return self._joint("fixed", _flat.fixed_joint_def_at, a, b, (point,), fields)

    def create_configurable_joint(
        self, a: Optional[Body], b: Optional[Body], point: Vector, axis: Vector = X, **fields: Any
    ) -> Joint:
        """Six axes: linear_x={"motion": "limited", "lower": -1, "upper": 1}, angular_y={"motion": "free"}...; those
        not named are locked."""
        return self._joint("configurable", _flat.configurable_joint_def_at, a, b, (point, axis), fields)

    def create_rope_joint(
        self,
        a: Optional[Body],
        b: Optional[Body],
        point_a: Vector,
        point_b: Vector,
        max_length: float,
        **fields: Any,
    ) -> Joint:
        """Two points come no farther from each other than max_length, m."""
        return self._joint("distance", _flat.rope_joint_def_at, a, b, (point_a, point_b, max_length), fields)

    def create_slider_joint(
        self, a: Optional[Body], b: Optional[Body], point: Vector, axis: Vector, **fields: Any
    ) -> Joint:
        """B slides along an axis and does not rotate; limits, spring and motor are those of linear_x."""
        return self._joint("configurable", _flat.slider_joint_def_at, a, b, (point, axis), fields)

    def create_wheel_joint(
        self,
        chassis: Optional[Body],
        wheel: Optional[Body],
        point: Vector,
        axle: Vector,
        up: Vector,
        hertz: float,
        damping_ratio: float,
        travel: float,
        **fields: Any,
    ) -> Joint:
        """A wheel with suspension: angular_x is its motor and brake, angular_z steers, linear_z is the suspension."""
        where = (point, axle, up, hertz, damping_ratio, travel)
        return self._joint("configurable", _flat.wheel_joint_def_at, chassis, wheel, where, fields)

    def create_motor_joint(
        self,
        a: Optional[Body],
        b: Optional[Body],
        hertz: float,
        damping_ratio: float,
        max_force: float,
        max_torque: float,
        **fields: Any,
    ) -> Joint:
        """Pulls and rotates B towards a pose relative to A, at first where it is; set_target() moves it."""
        where = (hertz, damping_ratio, max_force, max_torque)
        return self._joint("configurable", _flat.motor_joint_def_at, a, b, where, fields)

    def _joint(
        self,
        kind: str,
        place: Callable[..., Any],
        a: Optional[Body],
        b: Optional[Body],
        where: Tuple[Any, ...],
        fields: Dict[str, Any],
    ) -> Joint:
        definition = getattr(_flat, kind + "_joint_def")()
        place(self._capsule, definition, *(0 if end is None else self._body(end) for end in (a, b)), *where)
        fill(definition, fields)
        return Joint(self, getattr(_flat, kind + "_joint_create")(self._capsule, definition))

    # ---- queries: `mask` says which layers count, `exclude` which bodies do not ----

    def raycast(
        self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = NOBODY
    ) -> Optional[records.Hit]:
        """The first body on the segment from origin to origin + translation, or None."""
        filter = self._filter(mask, triggers, exclude)
        hit: Optional[records.Hit] = _flat.world_raycast(self._capsule, origin, translation, filter, self)
        return hit

    def raycast_any(
        self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = NOBODY
    ) -> bool:
        """Is anything on the segment?"""
        found: bool = _flat.world_raycast_any(self._capsule, origin, translation, self._filter(mask, triggers, exclude))
        return found

    def raycast_all(
        self, origin: Vector, translation: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = NOBODY
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
        turn: Optional[Vector] = None,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> Optional[records.Hit]:
        """What a moving form touches first, or None: any but a Plane, Mesh or Heightfield. It turns by the length of
        `turn` (rad) about its direction, at a constant rate; see fe_world_sweep_turning in feather.h."""
        flat, start, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        hit: Optional[records.Hit]
        if turn is None:
            hit = _flat.world_sweep(self._capsule, flat, start, translation, filter, self)
        else:
            hit = _flat.world_sweep_turning(self._capsule, flat, start, translation, turn, filter, self)
        return hit

    def sweep_any(
        self,
        geometry: Geometry,
        position: Vector,
        translation: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        turn: Optional[Vector] = None,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> bool:
        """Does it touch anything?"""
        flat, start, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        found: bool
        if turn is None:
            found = _flat.world_sweep_any(self._capsule, flat, start, translation, filter)
        else:
            found = _flat.world_sweep_turning_any(self._capsule, flat, start, translation, turn, filter)
        return found

    def sweep_all(
        self,
        geometry: Geometry,
        position: Vector,
        translation: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        turn: Optional[Vector] = None,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> List[records.Hit]:
        """Every body that it touches on its motion, nearest first."""
        flat, start, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        if turn is None:
            return self._hits(_flat.world_sweep_all, flat, start, translation, filter)
        return self._hits(_flat.world_sweep_turning_all, flat, start, translation, turn, filter)

    def overlap(
        self,
        geometry: Geometry,
        position: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> List[Body]:
        """The bodies that a form overlaps, any but a Plane, Mesh or Heightfield, in the order of creation."""
        flat, at, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        return self._list(Body, records.read_handles(_flat.world_overlap, self._capsule, flat, at, filter))

    def overlap_any(
        self,
        geometry: Geometry,
        position: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> bool:
        """Does it overlap anything?"""
        flat, at, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        found: bool = _flat.world_overlap_any(self._capsule, flat, at, filter)
        return found

    def overlap_shapes(
        self,
        geometry: Geometry,
        position: Vector,
        *,
        rotation: Vector = NO_ROTATION,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> List[records.Overlap]:
        """The shapes that it overlaps, with direction and depth: to move a character out. In the order of
        creation."""
        flat, at, filter = self._form(geometry), (position, rotation), self._filter(mask, triggers, exclude)
        read, record = _flat.world_overlap_shapes, records.OVERLAP
        return self._list(records.Overlap, records.read_found(read, record, self._capsule, flat, at, filter))

    def overlap_bounds(
        self, lower: Vector, upper: Vector, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = NOBODY
    ) -> List[Shape]:
        """The shapes whose bounds meet an axis-aligned box, in the order of creation."""
        filter = self._filter(mask, triggers, exclude)
        return self._list(Shape, records.read_handles(_flat.world_overlap_bounds, self._capsule, (lower, upper), filter))

    def closest_point(
        self, point: Vector, max_distance: float, *, mask: int = ALL_LAYERS, triggers: bool = False, exclude: Any = NOBODY
    ) -> Optional[records.Closest]:
        """The point of all surfaces that is closest to a point, or None within max_distance, m."""
        filter = self._filter(mask, triggers, exclude)
        found: Optional[records.Closest] = _flat.world_closest_point(self._capsule, point, max_distance, filter, self)
        return found

    def raycast_many(
        self,
        rays: Any,
        out: Any = None,
        *,
        spread: bool = True,
        mask: int = ALL_LAYERS,
        triggers: bool = False,
        exclude: Any = NOBODY,
    ) -> Any:
        """raycast() for a buffer of rays (6 doubles each: origin, translation), over the world's workers when
        `spread`. Fills a buffer of hits (see records.HIT) and returns it; of a miss the body is 0 and the fraction
        1."""
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
        exclude: Any = NOBODY,
    ) -> Any:
        """sweep() of one geometry for a buffer of paths (64 bytes each, see records.PATH), like raycast_many()."""
        if out is None:
            out = bytearray(memoryview(paths).nbytes // records.PATH.size * records.HIT.size)
        flat, filter = self._form(geometry), self._filter(mask, triggers, exclude)
        _flat.world_sweep_many(self._capsule, flat, paths, filter, 1 if spread else 0, out)
        return out

    # ---- events of the last step, in an order that does not depend on the workers ----

    @property
    def pair_events(self) -> List[records.PairEvent]:
        """Shapes that began, went on, or ceased to touch."""
        found = records.read_all(_flat.world_get_pair_events, records.PAIR_EVENT, self._capsule)
        return [records.PairEvent(records.EVENT_KINDS[e[4]], *self._ends(e), e[5] != 0, *e[6:10]) for e in found]

    @property
    def body_events(self) -> List[records.BodyEvent]:
        """Bodies that fell asleep or woke."""
        found = records.read_all(_flat.world_get_body_events, records.BODY_EVENT, self._capsule)
        return [records.BodyEvent(records.EVENT_KINDS[kind], Body(self, body)) for body, kind in found]

    @property
    def hit_events(self) -> List[records.HitEvent]:
        """Impacts of shapes that asked for them with events=("hit",)."""
        found = records.read_all(_flat.world_get_hit_events, records.HIT_EVENT, self._capsule)
        return [
            records.HitEvent(*self._ends(e), Vec3(e[6:9]), Vec3(e[9:12]), e[12], e[13], e[4], e[5], *e[14:18])
            for e in found
        ]

    @property
    def joint_events(self) -> List[records.JointEvent]:
        """Joints that broke."""
        found = records.read_all(_flat.world_get_joint_events, records.JOINT_EVENT, self._capsule)
        return [
            records.JointEvent(
                Joint(self, joint), self._end(a), self._end(b), tag, records.JOINT_TYPES[type], Vec3(v[:3]), Vec3(v[3:])
            )
            for joint, a, b, tag, kind, type, *v in found
        ]

    def read_events(self, kind: str, out: Any = None) -> int:
        """Fills a buffer with the packed events "pair", "body", "hit" or "joint" (see records.PAIR_EVENT...) and
        returns how many there are."""
        read: Callable[..., int] = (
            _flat.world_get_pair_events,
            _flat.world_get_body_events,
            _flat.world_get_hit_events,
            _flat.world_get_joint_events,
        )[word(EVENTS, kind, "kind")]
        return read(self._capsule, out)

    # ---- bulk: buffers in, buffers out. Bodies are a buffer of handles (see body_ids) or a sequence of Body ----

    def transforms(self, out: Any = None, *, bodies: Any = None, origin: Vector = ZERO) -> Any:
        """Position relative to an origin and rotation, 7 float32 a body: x y z, x y z w; of all bodies unless some
        are given. Fills `out`, any buffer of float32 (a NumPy array of shape (n, 7) for example), or makes a
        memoryview of that shape."""
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

    # ---- many joints, along the free axis of each. Joints are a sequence of Joint or a buffer of handles ----

    def joint_coordinates(self, joints: Any, out: Any = None) -> Any:
        """Angle, translation or length, rad or m, and its rate, 2 float32 a joint, like transforms(). A ball or fixed
        joint has no free axis: 0, 0."""
        ids = self._joint_ids(joints)
        if out is None:
            out = _floats(ids, 2)
        _flat.world_get_joint_coordinates(self._capsule, ids, out)
        return out

    def joint_reactions(self, joints: Any, out: Any = None) -> Any:
        """Force, N, and torque, N m, that hold each joint, 6 float32 a joint, like transforms()."""
        ids = self._joint_ids(joints)
        if out is None:
            out = _floats(ids, 6)
        _flat.world_get_joint_reactions(self._capsule, ids, out)
        return out

    def set_joint_targets(self, joints: Any, targets: Any) -> None:
        """Targets of the springs, rad or m, from a buffer of a float32 a joint. All or none."""
        _flat.world_set_joint_targets(self._capsule, self._joint_ids(joints), targets)

    def set_joint_motor_speeds(self, joints: Any, speeds: Any) -> None:
        """Speeds of the motors, rad/s or m/s, from a buffer of a float32 a joint. All or none."""
        _flat.world_set_joint_motor_speeds(self._capsule, self._joint_ids(joints), speeds)

    def add_joint_forces(self, joints: Any, forces: Any) -> None:
        """A torque about the axis on B, N m, or a force along it, N, and the opposite on A, during the next step, from a
        buffer of a float32 a joint. All or none."""
        _flat.world_add_joint_forces(self._capsule, self._joint_ids(joints), forces)

    def exact_transforms(self, out: Any = None, *, bodies: Any = None) -> Any:
        """Position as 3 doubles and rotation as 4 floats, 40 bytes a body (see records.TRANSFORM): fills `out` or
        makes a bytearray."""
        ids = self.body_ids() if bodies is None else self._ids(bodies)
        if out is None:
            out = bytearray(memoryview(ids).nbytes // 8 * records.TRANSFORM.size)
        _flat.world_get_transforms(self._capsule, ids, out)
        return out

    def set_transforms(self, bodies: Any, transforms: Any) -> None:
        """Moves bodies at once; 40 bytes a body as in exact_transforms()."""
        _flat.world_set_transforms(self._capsule, self._ids(bodies), transforms)

    def moved(self) -> Tuple["array[int]", bytearray]:
        """The handles of the bodies that the last step moved, and where they are now (see records.TRANSFORM)."""
        count = _flat.world_get_moved(self._capsule, None, None)
        ids, transforms = array("Q", bytes(8 * count)), bytearray(count * records.TRANSFORM.size)
        _flat.world_get_moved(self._capsule, ids, transforms)
        return ids, transforms

    # ---- drawing: what there is to see, as packed vertices. Options are the fields of fe_draw_options: parts=("shapes",
    # "contacts"...), origin, lower, upper, only=a body, scale, segments ----

    def draw_lines(self, **options: Any) -> bytearray:
        """Two vertices a line, see records.DRAW_VERTEX: numpy.frombuffer(world.draw_lines(), np.float32).reshape(-1, 6)
        has x, y, z in its first three columns."""
        return self._draw(_flat.world_draw_lines, records.DRAW_VERTEX, options)

    def draw_triangles(self, **options: Any) -> bytearray:
        """Three vertices a triangle, counterclockwise seen from outside."""
        return self._draw(_flat.world_draw_triangles, records.DRAW_VERTEX, options)

    def draw_points(self, **options: Any) -> bytearray:
        """A vertex a point."""
        return self._draw(_flat.world_draw_points, records.DRAW_VERTEX, options)

    def draw_instances(self, **options: Any) -> bytearray:
        """Shapes as forms and poses, see records.DRAW_INSTANCE."""
        return self._draw(_flat.world_draw_instances, records.DRAW_INSTANCE, options)

    def draw_into(self, kind: str, out: Any, **options: Any) -> int:
        """Fills a buffer with "lines", "triangles", "points" or "instances", as far as it goes, and returns how many
        records there are. A NumPy array of records.DRAW_VERTEX.dtype will do, or of DRAW_INSTANCE.dtype; None asks for
        the number only."""
        draw: Callable[..., int] = (
            _flat.world_draw_lines,
            _flat.world_draw_triangles,
            _flat.world_draw_points,
            _flat.world_draw_instances,
        )[word(DRAWN, kind, "kind")]
        return draw(self._capsule, self._draw_options(options), out)

    def picture(
        self,
        width: int = 800,
        height: int = 450,
        *,
        eye: Optional[Vector] = None,
        target: Optional[Vector] = None,
        direction: Vector = picture.FROM,
        parts: Iterable[str] = ("shapes",),
    ) -> bytes:
        """A PNG of the world, drawn without a GPU: Path("pile.png").write_bytes(world.picture()). All that may move is in
        it, seen from `direction` (from the bodies to the eye, y is up); or what is seen from `eye` towards `target`, m.
        `parts` as for draw_lines(): ("shapes", "joints", "contacts") shows lines too. The same world gives the same
        bytes on every machine. Other Python threads run meanwhile."""
        return picture.take(self._capsule, width, height, eye, target, direction, parts)

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        if self._closed:
            return "World, closed"
        return picture.html(self.picture(), f"World of {self.counters.bodies} bodies")

    # ---- within the package ----

    def _form(self, geometry: Geometry) -> Any:
        return flat_geometry(self._store, geometry)

    def _draw(self, draw: Callable[..., int], record: records.Packed, options: Dict[str, Any]) -> bytearray:
        given = self._draw_options(options)
        out = bytearray(draw(self._capsule, given, None) * record.size)
        draw(self._capsule, given, out)
        return out

    def _draw_options(self, fields: Dict[str, Any]) -> Any:
        options = _flat.draw_options()
        if "parts" in fields:
            fields["parts"] = draw_bits(fields["parts"])
        if fields.get("only") is not None:
            fields["only"] = self._body(fields["only"])
        else:
            fields.pop("only", None)
        fill(options, fields)
        return options

    def _body(self, body: Body) -> int:
        handle: int = _flat.handle_of(self, body, Body)
        return handle

    def _ids(self, bodies: Any) -> Any:
        if isinstance(bodies, (list, tuple)):
            return _flat.handles_of(self, bodies, Body)
        return bodies

    def _joint_ids(self, joints: Any) -> Any:
        if isinstance(joints, (list, tuple)):
            return _flat.handles_of(self, joints, Joint)
        return joints

    def _filter(self, mask: int, triggers: bool, exclude: Any) -> Optional[Tuple[int, int, Any]]:
        if exclude is NOBODY and mask == ALL_LAYERS and not triggers:
            return None
        if isinstance(exclude, Body):
            exclude = (exclude,)
        return mask, 1 if triggers else 0, self._ids(exclude) if len(exclude) else None

    def _end(self, id: int) -> Optional[Body]:
        return Body(self, id) if id else None

    def _ends(self, ids: Sequence[int]) -> Tuple[Body, Body, Shape, Shape]:
        return Body(self, ids[0]), Body(self, ids[1]), Shape(self, ids[2]), Shape(self, ids[3])

    def _hits(self, read: Callable[..., int], *arguments: Any) -> List[records.Hit]:
        return self._list(records.Hit, records.read_found(read, records.HIT, self._capsule, *arguments))

    def _list(self, kind: Type[Found], packed: Any) -> List[Found]:
        found: List[Found] = _flat.list_of(kind, self, self._capsule, packed)
        return found

    def _contacts(self, read: Callable[..., int], id: int) -> List[records.Contact]:
        return [_contact(self, c) for c in records.read_all(read, records.CONTACT, self._capsule, id)]

    def _forget(self, body: Body) -> None:
        if self._user_data and body.is_valid:
            for entity in (body, *body.shapes, *body.joints):
                self._user_data.pop(entity._id, None)


def _judge(home: "weakref.ref[World]") -> Callable[[Any], Any]:
    """What the library calls for a new pair. It holds no world: the world holds it, out of the sight of Python's
    cycles."""

    def judge(flat: Any) -> Any:
        world = home()
        if world is None or world._pair_filter is None:
            return True
        ends = world._ends((flat.body_a, flat.body_b, flat.shape_a, flat.shape_b))
        tags = flat.body_user_data_a, flat.body_user_data_b, flat.shape_user_data_a, flat.shape_user_data_b
        return world._pair_filter(FilterPair(*ends, *tags))

    return judge


def _contact(world: World, c: Tuple[Any, ...]) -> records.Contact:
    points = (c[10 + 7 * i : 17 + 7 * i] for i in range(c[9]))
    return records.Contact(
        *world._ends(c),
        Vec3(c[6:9]),
        tuple(records.ContactPoint(Vec3(p[:3]), *p[3:]) for p in points),
        Vec3(c[38:41]),
        c[41],
        *c[4:6],
        *c[42:46],
    )


def _body_def(
    type: str,
    position: Vector,
    rotation: Vector,
    velocities: Tuple[Vector, Vector],
    damping: Sequence[float],
    locks: Sequence[str],
    fields: Dict[str, Any],
) -> Any:
    definition = _flat.body_def()
    definition.type = body_type(type)
    definition.transform = (position, rotation)
    definition.linear_velocity, definition.angular_velocity = velocities
    definition.linear_damping, definition.angular_damping = damping
    definition.linear_locks, definition.angular_locks = locks_bits(locks)
    fill(definition, fields)
    return definition


def _floats(ids: Any, width: int) -> memoryview:
    count = memoryview(ids).nbytes // 8
    return memoryview(bytearray(4 * width * max(count, 1))).cast("f", (max(count, 1), width))[:count]
