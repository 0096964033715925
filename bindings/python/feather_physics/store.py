"""Stores, and the assets in them: heavy data that the shapes of many worlds share."""

from __future__ import annotations

from array import array
from types import TracebackType
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Type, Union

from . import _flat
from ._flat import Vec3
from .errors import InvalidArgumentError, StaleHandleError
from .records import HULL_FACE, Box, Capsule, CompoundInfo, Cone, Cylinder, Geometry, HullFace, HullInfo, MeshEdge
from .records import MeshInfo, MeshTriangle, Part, Plane, Scaled, Sphere, copy_record, read_all
from .words import flat_material, material_of


class Store:
    """Holds heightfields, hulls, meshes and compounds that several worlds may share: World(store=store). Any thread may
    use it while worlds step. A world that is given none has one of its own, world.store."""

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

    def create_hull(self, points: Any, *, max_vertices: int = 64, tolerance: float = 0.0) -> "Hull":
        """The convex hull of points, m: a sequence of them, or a buffer of float32, such as an array of NumPy.
        body.add(hull) gives it to a body. Flat points are a DegenerateError."""
        return Hull(self, _flat.hull_create(self._capsule, (_places(points), max_vertices, tolerance)))

    def create_mesh(
        self,
        vertices: Any,
        triangles: Any,
        *,
        two_sided: bool = False,
        strict: bool = False,
        weld_distance: float = 0.0,
        edge_angle: float = 0.035,
        triangle_materials: Any = None,
        materials: Optional[Sequence[Sequence[Any]]] = None,
        triangle_data: Any = None,
    ) -> "Mesh":
        """Triangles, for static and kinematic bodies: body.add(mesh). Vertices, m, are a sequence of points or a buffer
        of float32; triangles three vertices each, counterclockwise seen from the side that counts, a sequence or a
        buffer of 2 or 4 byte integers. Triangle_materials are bytes, one a triangle; materials at most 255;
        triangle_data one integer of 32 bits a triangle. See fe_mesh_def in feather.h."""
        indices, index_type = _indices(triangles)
        flags = (_flat.FE_MESH_TWO_SIDED if two_sided else 0) | (_flat.FE_MESH_STRICT if strict else 0)
        surfaces = None if materials is None else [flat_material(material) for material in materials]
        data = None if triangle_data is None else _words(triangle_data)
        definition = (_places(vertices), indices, index_type, flags, weld_distance, edge_angle, triangle_materials)
        return Mesh(self, _flat.mesh_create(self._capsule, (*definition, surfaces, data)))

    def create_compound(self, parts: Iterable[Union[Part, Mapping[str, Any]]]) -> "Compound":
        """One form of several, each a Part or a dictionary of its fields: create_compound([Part(Box(1, 0.1, 1)),
        {"geometry": Sphere(0.2), "position": (0, 0.3, 0)}]). Hits, contacts and events tell the place of the part.
        Assets among the parts are of this store, and live as long as the compound."""
        return Compound(self, _flat.compound_create(self._capsule, [self._flat_part(part) for part in parts]))

    def load(self, data: Any) -> "Asset":
        """The heightfield, hull, mesh or compound of which asset.save() made these bytes, in less time than it was made:
        cook when a game is built, load when it starts. Bytes from anywhere may be given: what is accepted
        is sound, the rest a DataError or a VersionError that tells what is wrong with it."""
        return self._asset(_flat.asset_load(self._capsule, data))

    def _asset(self, id: int) -> "Asset":
        kind = _flat.asset_get_type(self._capsule, id)
        if kind == _flat.FE_GEOMETRY_HULL:
            return Hull(self, id)
        if kind == _flat.FE_GEOMETRY_COMPOUND:
            return Compound(self, id)
        return Mesh(self, id) if kind == _flat.FE_GEOMETRY_MESH else Heightfield(self, id)

    def _flat_part(self, part: Union[Part, Mapping[str, Any]]) -> Any:
        if not isinstance(part, Part):
            if not isinstance(part, Mapping):
                raise TypeError(f"parts: a Part or a dictionary of its fields is needed, not {type(part).__name__!r}")
            part = Part(**part)
        flat = _flat.compound_part()
        flat.geometry = flat_geometry(self, part.geometry)
        flat.frame = (part.position, part.rotation)
        if part.density is not None:
            flat.density = part.density
        if part.material is not None:
            flat.own_material, flat.material = 1, flat_material(part.material)
        flat.user_data = part.tag
        return flat


class Asset:
    """What any number of shapes may share: a heightfield, a hull, a mesh or a compound of a store."""

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

    def save(self) -> bytes:
        """The asset as bytes, the same on every machine, for store.load(): of a compound with the assets of its
        parts."""
        saved: bytes = _flat.asset_save(self._store._capsule, self._id)
        return saved

    @property
    def key(self) -> str:
        """What the asset is known by outside its store: 32 hexadecimal digits, equal where the content is."""
        key: str = _flat.asset_get_key(self._store._capsule, self._id)
        return key

    def destroy(self) -> None:
        """The handle dies at once, what it names with its last shape."""
        _flat.asset_destroy(self._store._capsule, self._id)
        self._store._user_data.pop(self._id, None)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Asset) and other._id == self._id and other._store is self._store

    def __hash__(self) -> int:
        return hash((id(self._store), self._id))

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._id:#x}>"


class Heightfield(Asset):
    """A grid of heights that any number of shapes may share: body.add(heightfield)."""

    __slots__ = ()

    def get_heights(self, row: int, column: int, rows: int, columns: int, out: Any) -> Any:
        """Fills a buffer of float32 with a rectangle of samples, m, row by row."""
        _flat.heightfield_get_heights(self._store._capsule, self._id, row, column, rows, columns, out)
        return out

    def set_heights(self, row: int, column: int, rows: int, columns: int, heights: Any) -> None:
        """Changes a rectangle of samples from a buffer of float32; bodies near it wake, in every world."""
        _flat.heightfield_set_heights(self._store._capsule, self._id, row, column, rows, columns, heights)


class Hull(Asset):
    """A convex hull that any number of shapes may share: body.add(hull)."""

    __slots__ = ()

    @property
    def info(self) -> HullInfo:
        """Volume, centre, inertia, bounds, how many vertices and faces."""
        return copy_record(HullInfo, _flat.hull_get_info(self._store._capsule, self._id))

    @property
    def vertices(self) -> List[Vec3]:
        """Points of those it was made of, m."""
        count = _flat.hull_get_vertices(self._store._capsule, self._id, None)
        places = array("f", bytes(12 * count))
        _flat.hull_get_vertices(self._store._capsule, self._id, places)
        return [Vec3(places[3 * i : 3 * i + 3].tolist()) for i in range(count)]

    @property
    def faces(self) -> List[HullFace]:
        """Convex polygons, to draw: a fan of triangles from the first corner of each."""
        corners = array("i", bytes(4 * _flat.hull_get_corners(self._store._capsule, self._id, None)))
        _flat.hull_get_corners(self._store._capsule, self._id, corners)
        packed = read_all(_flat.hull_get_faces, HULL_FACE, self._store._capsule, self._id)
        return [
            HullFace(tuple(corners[first : first + count]), Vec3((x, y, z)), distance)
            for first, count, x, y, z, distance in packed
        ]


class Mesh(Asset):
    """Triangles that any number of shapes of static and kinematic bodies may share: body.add(mesh)."""

    __slots__ = ()

    @property
    def info(self) -> MeshInfo:
        """Area, volume, bounds, how many triangles, and what was wrong with them."""
        return copy_record(MeshInfo, _flat.mesh_get_info(self._store._capsule, self._id))

    def triangle(self, number: int) -> Optional[MeshTriangle]:
        """A triangle by its number in what the mesh was made of; None for one that was dropped."""
        flat = _flat.mesh_get_triangle(self._store._capsule, self._id, number)
        if not flat.kept:
            return None
        edges = [MeshEdge(bits & 1 != 0, bits & 2 != 0, bits & 4 != 0) for bits in flat.edges]
        return MeshTriangle(flat.corners, (edges[0], edges[1], edges[2]), flat.material, flat.data)

    def set_materials(self, materials: Sequence[Sequence[Any]]) -> None:
        """New materials of a mesh that has some, as many as before; what touches it wakes, in every world."""
        _flat.mesh_set_materials(self._store._capsule, self._id, [flat_material(material) for material in materials])


class Compound(Asset):
    """One form of several parts, for any number of shapes: body.add(compound)."""

    __slots__ = ()

    @property
    def info(self) -> CompoundInfo:
        """How many parts, their bounds, memory."""
        return copy_record(CompoundInfo, _flat.compound_get_info(self._store._capsule, self._id))

    @property
    def parts(self) -> List[Part]:
        """All parts, as they were given; rotations have length 1."""
        return [self.part(number) for number in range(self.info.part_count)]

    def part(self, number: int) -> Part:
        """A part by its place, as hits, contacts and events tell it."""
        flat = _flat.compound_get_part(self._store._capsule, self._id, number)
        density = None if flat.density == -1 else flat.density
        material = material_of(flat.material) if flat.own_material else None
        position, rotation = flat.frame
        return Part(geometry_of(self._store, flat.geometry), position, rotation, density, material, flat.user_data)


# ---- forms -------------------------------------------------------------------------------------------------------


def flat_geometry(store: Store, geometry: Geometry) -> Any:
    """A geometry as the flat functions take it; its asset is of this store."""
    if isinstance(geometry, Sphere):
        return _flat.geometry_sphere(geometry.radius)
    if isinstance(geometry, Capsule):
        return _flat.geometry_capsule(geometry.half_height, geometry.radius)
    if isinstance(geometry, Box):
        return _flat.geometry_box(*geometry)
    if isinstance(geometry, Plane):
        x, y, z = geometry.normal
        return _flat.geometry_plane(x, y, z, geometry.distance)
    if isinstance(geometry, Cylinder):
        return _flat.geometry_cylinder(geometry.half_height, geometry.radius)
    if isinstance(geometry, Cone):
        return _flat.geometry_cone(geometry.half_height, geometry.radius)
    if isinstance(geometry, Scaled):
        if not isinstance(geometry.asset, Asset):
            raise TypeError(f"a hull or a mesh is needed, not {type(geometry.asset).__name__!r}")
        scaled = flat_geometry(store, geometry.asset)
        x, y, z = geometry.scale
        _flat.geometry_set_scale(scaled, x, y, z)
        return scaled
    if not isinstance(geometry, Asset):
        raise TypeError(f"a geometry is needed, not {type(geometry).__name__!r}")
    if geometry._store is not store:
        raise InvalidArgumentError(f"{geometry!r} belongs to another store than the one it is used with")
    if isinstance(geometry, Hull):
        return _flat.geometry_hull(geometry._id)
    if isinstance(geometry, Mesh):
        return _flat.geometry_mesh(geometry._id)
    if isinstance(geometry, Compound):
        return _flat.geometry_compound(geometry._id)
    return _flat.geometry_heightfield(geometry._id)


def geometry_of(store: Store, flat: Any) -> Geometry:
    """The reverse of flat_geometry."""
    if flat.type == _flat.FE_GEOMETRY_SPHERE:
        return Sphere(flat.radius)
    if flat.type == _flat.FE_GEOMETRY_CAPSULE:
        return Capsule(flat.half_height, flat.radius)
    if flat.type == _flat.FE_GEOMETRY_BOX:
        return Box(*flat.half_extents)
    if flat.type == _flat.FE_GEOMETRY_PLANE:
        return Plane(flat.normal, flat.distance)
    if flat.type == _flat.FE_GEOMETRY_CYLINDER:
        return Cylinder(flat.half_height, flat.radius)
    if flat.type == _flat.FE_GEOMETRY_CONE:
        return Cone(flat.half_height, flat.radius)
    if flat.type == _flat.FE_GEOMETRY_HEIGHTFIELD:
        return Heightfield(store, flat.asset)
    if flat.type == _flat.FE_GEOMETRY_COMPOUND:
        return Compound(store, flat.asset)
    is_hull = flat.type == _flat.FE_GEOMETRY_HULL
    asset: Union[Hull, Mesh] = Hull(store, flat.asset) if is_hull else Mesh(store, flat.asset)
    return asset if flat.scale == (1, 1, 1) else Scaled(asset, flat.scale)


# ---- numbers that go in ------------------------------------------------------------------------------------------


def _places(points: Any) -> Any:
    """x y z each: a buffer of float32, or a sequence of points or of numbers."""
    try:
        view = memoryview(points)
        if view.format == "f":
            return points
        points = view.tolist()
    except TypeError:
        pass
    return array("f", _flattened(points))


def _indices(triangles: Any) -> Tuple[Any, int]:
    """Three vertices each, and fe_index_type: a buffer of 2 or 4 byte integers, or a sequence."""
    try:
        view = memoryview(triangles)
        if view.format in ("H", "I", "i", "L", "l") and view.itemsize in (2, 4):
            return triangles, 1 if view.itemsize == 2 else 0
        triangles = view.tolist()
    except TypeError:
        pass
    return array("I", _flattened(triangles)), 0


def _words(numbers: Any) -> Any:
    """Integers of 32 bits: a buffer of such, or a sequence."""
    try:
        if memoryview(numbers).itemsize == 4:
            return numbers
    except TypeError:
        pass
    return array("I", numbers)


def _flattened(items: Any) -> List[Any]:
    flat: List[Any] = []
    for item in items:
        if isinstance(item, (int, float)):
            flat.append(item)
        else:
            flat.extend(item)
    return flat


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
