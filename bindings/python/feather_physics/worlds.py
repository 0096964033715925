"""Many worlds that step together: Worlds(world, 1000)."""

from __future__ import annotations

import array as arrays
import weakref
from typing import Any, Dict, List, Optional, Sequence, Tuple

from . import _flat
from .errors import FeatherError, InvalidArgumentError, UnsupportedError
from .objects import Body, Joint, Shape
from .records import Vector
from .state import State
from .words import SIMD_SETS, word
from .world import Pool, World

# name: its number, what its rows are of, numbers in a row
FIELDS: Dict[str, Tuple[int, Optional[type], int]] = {
    "transform": (1, Body, 7),  # position, rotation x y z w
    "velocity": (2, Body, 6),  # linear, angular
    "force": (3, Body, 6),  # force, torque
    "awake": (4, Body, 1),
    "joint": (5, Joint, 2),  # angle, translation or length, and its rate
    "joint_force": (6, Joint, 1),
    "joint_speed": (7, Joint, 1),
    "joint_target": (8, Joint, 1),
    "reaction": (9, Joint, 6),  # force, torque
    "gravity": (10, None, 3),
    "contact_force": (11, Body, 3),  # N, of all contacts
    "mass": (12, Body, 1),
    "friction": (13, Shape, 2),  # static, dynamic
}
ORIGIN = (0.0, 0.0, 0.0)


class WorldsError(FeatherError):
    """Some worlds failed, the others went on. `worlds.results` has a number for each: 0, or what went wrong."""


class Worlds:
    """So many worlds, clones of one, which stays the caller's: its bodies and joints name those of each of them. They
    step together, each on one worker, bit for bit as they would alone, whatever the workers."""

    __slots__ = ("_capsule", "_count", "_world", "_pool", "_bound", "_views", "results", "__weakref__")

    def __init__(
        self,
        world: World,
        count: int,
        *,
        workers: int = 1,
        block: int = 0,
        simd: str = "auto",
        pool: Optional[Pool] = None,
    ):
        """Workers, 1 to 64, are threads of its own unless a pool is given. Block: worlds that a worker takes at once,
        0: chosen."""
        if world._pair_filter is not None:
            raise UnsupportedError(
                "Worlds: the world has a pair filter, which is a function of one world; clone() takes it along"
            )
        kept = (pool and pool._capsule, None if world._has_own_store else world._store._capsule)
        self._capsule = _flat.batch_create(
            world._capsule, count, workers, block, word(SIMD_SETS, simd, "simd"), pool and pool._capsule, kept
        )
        self._count, self._world, self._pool = count, world, pool
        self._bound: Tuple[List[Any], List[Any]] = ([], [])
        self._views: "weakref.WeakValueDictionary[int, World]" = weakref.WeakValueDictionary()
        self.results = arrays.array("i", bytes(4 * count))  # of the last call, a world each: 0, or its error

    def __len__(self) -> int:
        """How many worlds there are."""
        return self._count

    def __getitem__(self, index: int) -> World:
        """One of the worlds, for all calls but close(), record() and set_pair_filter(). It ends with close() of this."""
        place = index + self._count if index < 0 else index
        if not 0 <= place < self._count:
            raise IndexError(f"worlds[{index}]: there are {self._count}")
        found = self._views.get(place)
        if found is None:
            found = World._of_batch(_flat.batch_get_world(self._capsule, place), self, self._world)
            self._views[place] = found
        return found

    def __repr__(self) -> str:
        return f"<Worlds, {self._count}>"

    def close(self) -> None:
        """Destroys the worlds. What uses them afterwards is a StaleHandleError; arrays stay what they are."""
        _flat.batch_destroy(self._capsule)
        self._bound = ([], [])
        for view in list(self._views.values()):
            view._closed = True
        self._views.clear()

    def __enter__(self) -> "Worlds":
        return self

    def __exit__(self, *error: Any) -> None:
        self.close()

    # ---- arrays: of float32 or float64, of shape (worlds, items, numbers in a row)

    def array(self, field: str, items: Optional[Sequence[Any]] = None, *, double: bool = False) -> memoryview:
        """Zeros for a field: a memoryview, which numpy.asarray, torch.frombuffer and others take without a copy."""
        _, _, width = _field(field)
        shape = self._count, 1 if items is None else len(items), width
        size = shape[0] * shape[1] * shape[2] * (8 if double else 4)
        return memoryview(bytearray(size)).cast("d" if double else "f", shape)

    def input(self, field: str, items: Optional[Sequence[Any]] = None, out: Any = None) -> Any:
        """An array that each step() reads before it steps: `out`, any C-contiguous buffer of that shape, or a new one.
        Fields: transform, velocity, force of bodies; joint_force, joint_speed, joint_target of joints; gravity."""
        return self._bind(0, field, items, out, None, ORIGIN)

    def output(
        self,
        field: str,
        items: Optional[Sequence[Any]] = None,
        out: Any = None,
        *,
        relative_to: Optional[Body] = None,
        origin: Vector = ORIGIN,
    ) -> Any:
        """An array that each step() fills when it has stepped. Fields: transform, velocity, awake of bodies; joint,
        reaction of joints; gravity. In the frame of a body where one is given."""
        return self._bind(1, field, items, out, relative_to, origin)

    def unbind(self) -> None:
        """No step reads or fills an array any more."""
        _flat.batch_bind(self._capsule, (), ())
        self._bound = ([], [])

    def _bind(
        self,
        side: int,
        field: str,
        items: Optional[Sequence[Any]],
        out: Any,
        relative_to: Optional[Body],
        origin: Vector,
    ) -> Any:
        made = self.array(field, items) if out is None else out
        bound = list(self._bound[0]), list(self._bound[1])
        bound[side].append(self._array(field, items, memoryview(made), relative_to, origin))
        _flat.batch_bind(self._capsule, *bound)
        self._bound = bound
        return made

    def read(
        self,
        field: str,
        items: Optional[Sequence[Any]] = None,
        out: Any = None,
        *,
        relative_to: Optional[Body] = None,
        origin: Vector = ORIGIN,
    ) -> Any:
        """Fills an array from a field of all worlds, now."""
        made = self.array(field, items) if out is None else out
        given = self._array(field, items, made, relative_to, origin)
        self._judge(_flat.batch_read(self._capsule, given, self.results))
        return made

    def write(self, field: str, items: Optional[Sequence[Any]], values: Any, *, mask: Any = None) -> None:
        """Writes a field of all worlds, or of those in a mask, from an array, now: of each world all rows or none."""
        given = self._array(field, items, values, None, ORIGIN)
        self._judge(_flat.batch_write(self._capsule, given, mask, self.results))

    def _array(
        self, field: str, items: Optional[Sequence[Any]], data: Any, relative_to: Optional[Body], origin: Vector
    ) -> Tuple[Any, ...]:
        number, kind, width = _field(field)
        if (kind is None) != (items is None):
            raise InvalidArgumentError(f"{field}: " + ("it has no items" if kind is None else "of which items?"))
        ids = None if kind is None or items is None else _flat.handles_of(self._world, items, kind)
        frame = 0 if relative_to is None else _flat.handle_of(self._world, relative_to, Body)
        shape, given = (self._count, 1 if items is None else len(items), width), memoryview(data)
        if given.ndim != 1 and given.shape != shape:  # as many numbers in another order would be taken for others
            raise InvalidArgumentError(f"{field}: an array of shape {shape} is needed, not {given.shape}")
        return number, ids, frame, origin, data

    # ---- all of them

    def step(self, dt: float = 1 / 60, steps: int = 1, mask: Any = None) -> None:
        """Steps all worlds, or those whose byte in the mask is not 0; the inputs hold in all the steps. Other Python
        threads run meanwhile. A WorldsError when some fail: each stands after its last whole step, the others go on."""
        self._judge(_flat.batch_step(self._capsule, dt, steps, mask, self.results))

    def reset(self, mask: Any = None, states: Optional[Sequence[Optional[State]]] = None) -> None:
        """Worlds become what the first world was when they were made, or a state each; None: the beginning."""
        given = None if states is None else [None if state is None else state._capsule for state in states]
        self._judge(_flat.batch_reset(self._capsule, mask, given, self.results))

    def hashes(self) -> "arrays.array[int]":
        """world.hash of each."""
        out = arrays.array("Q", bytes(8 * self._count))
        _flat.batch_hash(self._capsule, out)
        return out

    def _judge(self, failed: int) -> None:
        if failed:
            raise WorldsError(f"{failed} of {self._count} worlds failed: {_flat.last_error()}")


def _field(name: str) -> Tuple[int, Optional[type], int]:
    if name not in FIELDS:
        raise InvalidArgumentError(f"field: one of {', '.join(FIELDS)} is needed, not {name!r}")
    return FIELDS[name]
