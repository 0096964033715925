"""Stores, and the assets in them: heavy data that the shapes of many worlds share."""

from __future__ import annotations

from array import array
from types import TracebackType
from typing import Any, Dict, Optional, Sequence, Tuple, Type

from . import _flat
from .errors import StaleHandleError
from .words import flat_material


class Store:
    """Holds heightfields that several worlds may share: World(store=store). Any thread may use it while worlds step.
    A world that is given none has one of its own, world.store."""

    __slots__ = ("_capsule", "_user_data")
    _capsule: Any
    _user_data: Dict[int, Any]

    def __init__(self, *, number: int = 0):
        """The number, 1 to 4095, is part of its assets' handles; 0 is the next free one."""
        definition = _flat.store_def()
        definition.number = number
        self._capsule = _flat.store_create(definition)
        self._user_data = {}

    @classmethod
    def _of(cls, world: Any) -> "Store":
        """The store that a world has of its own; `world` is its capsule."""
        made = cls.__new__(cls)
        made._capsule = _flat.world_get_store(world)
        made._user_data = {}
        return made

    def close(self) -> None:
        """Destroys the store and all its assets. A StateError while a world uses it, and for a world's own store.
        Closing again does nothing."""
        if not self.closed:
            _flat.store_destroy(self._capsule)
            self._user_data.clear()

    @property
    def closed(self) -> bool:
        """True after close(); a world's own store closes with the world."""
        try:
            _flat.store_get_bytes(self._capsule)
        except StaleHandleError:
            return True
        return False

    @property
    def bytes(self) -> int:
        """Memory of the store and its assets."""
        count: int = _flat.store_get_bytes(self._capsule)
        return count

    def __enter__(self) -> "Store":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

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
        materials: Optional[Sequence[Sequence[Any]]] = None,
    ) -> "Heightfield":
        """Terrain from rows (along z) of samples (along x), m: a sequence of rows, or a buffer of float32 of that
        shape, or a flat one with rows and columns. Holes and cell_materials are bytes, one a cell; materials are at
        most 255. body.add(heightfield) gives it to a body."""
        samples, rows, columns = _samples(heights, rows, columns)
        surfaces = None if materials is None else [flat_material(material) for material in materials]
        definition = (rows, columns, cell_x, cell_z, samples, holes, cell_materials, surfaces)
        return Heightfield(self, _flat.heightfield_create(self._capsule, definition))


class Heightfield:
    """A grid of heights that any number of shapes may share: body.add(heightfield)."""

    __slots__ = ("_store", "_id")

    def __init__(self, store: Store, id: int):
        self._store = store
        self._id = id

    @property
    def id(self) -> int:
        """The handle: an integer below 2^53."""
        return self._id

    @property
    def store(self) -> Store:
        """The store that holds it."""
        return self._store

    @property
    def user_data(self) -> Any:
        """Whatever you keep with it; None at first."""
        return self._store._user_data.get(self._id)

    @user_data.setter
    def user_data(self, value: Any) -> None:
        self._store._user_data[self._id] = value

    @property
    def is_valid(self) -> bool:
        """False once it is destroyed, or its store closed."""
        return not self._store.closed and _flat.asset_is_valid(self._store._capsule, self._id) == 1

    def get_heights(self, row: int, column: int, rows: int, columns: int, out: Any) -> Any:
        """Fills a buffer of float32 with a rectangle of samples, m, row by row."""
        _flat.heightfield_get_heights(self._store._capsule, self._id, row, column, rows, columns, out)
        return out

    def set_heights(self, row: int, column: int, rows: int, columns: int, heights: Any) -> None:
        """Changes a rectangle of samples from a buffer of float32; bodies near it wake, in every world."""
        _flat.heightfield_set_heights(self._store._capsule, self._id, row, column, rows, columns, heights)

    def destroy(self) -> None:
        """The handle dies at once, its heights with their last shape."""
        _flat.asset_destroy(self._store._capsule, self._id)
        self._store._user_data.pop(self._id, None)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Heightfield) and other._id == self._id and other._store is self._store

    def __hash__(self) -> int:
        return hash((id(self._store), self._id))

    def __repr__(self) -> str:
        return f"<Heightfield {self._id:#x}>"


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
