"""Bodies, shapes and joints: a world and a handle. The world makes them; two that name the same thing are equal."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Callable, Generic, Iterable, List, Optional, Sequence, Tuple, TypeVar, Union
from typing import overload

from . import _flat, records
from ._flat import Bounds, Quat, Transform, Vec3
from .records import BODY_TYPES, JOINT_TYPES, NO_ROTATION, Box, Capsule, Cone, Cylinder, Filter, Geometry, Material
from .records import Plane, Sphere, Vector
from .store import flat_geometry, geometry_of
from .words import (
    DOFS,
    EVENT_BITS,
    axes_text,
    body_type,
    events_bits,
    fields_of,
    fill,
    flat_material,
    locks_bits,
    material_of,
    word,
)

if TYPE_CHECKING:
    from .world import World

Value = TypeVar("Value")
Given = TypeVar("Given")
Pose = Tuple[Vector, Vector]
"""A position and a rotation: a Transform, or any two sequences of numbers."""


class Attribute(Generic[Value, Given]):
    """A property that a pair of flat functions reads and writes. It reads as Value; what is Given may be set."""

    def __init__(self, get: Callable[..., Any], set: Optional[Callable[..., Any]], doc: str):
        self._get, self._set, self.__doc__ = get, set, doc

    @overload
    def __get__(self, owner: None, kind: Any) -> "Attribute[Value, Given]": ...

    @overload
    def __get__(self, owner: "Entity", kind: Any) -> Value: ...

    def __get__(self, owner: Optional["Entity"], kind: Any = None) -> Union[Value, "Attribute[Value, Given]"]:
        if owner is None:
            return self
        value: Value = self._get(owner._capsule, owner._id)
        return value

    def __set__(self, owner: "Entity", value: Given) -> None:
        if self._set is None:
            raise AttributeError("this cannot be set")
        self._set(owner._capsule, owner._id, value)


class Switch(Attribute[bool, bool]):
    """A property that is 0 or 1 in C."""

    @overload
    def __get__(self, owner: None, kind: Any) -> "Attribute[bool, bool]": ...

    @overload
    def __get__(self, owner: "Entity", kind: Any) -> bool: ...

    def __get__(self, owner: Optional["Entity"], kind: Any = None) -> Union[bool, "Attribute[bool, bool]"]:
        return self if owner is None else self._get(owner._capsule, owner._id) != 0

    def __set__(self, owner: "Entity", value: bool) -> None:
        if self._set is None:
            raise AttributeError("this cannot be set")
        self._set(owner._capsule, owner._id, 1 if value else 0)


class Entity:
    """A world and a handle in it."""

    __slots__ = ("_world", "_capsule", "_id")
    _world: "World"
    _capsule: Any
    _id: int

    def __init__(self, world: "World", id: int):
        self._world = world
        self._capsule = world._capsule
        self._id = id

    @property
    def id(self) -> int:
        """The handle: an integer below 2^53, equal in equal runs."""
        return self._id

    @property
    def world(self) -> "World":
        """The world it belongs to."""
        return self._world

    @property
    def user_data(self) -> Any:
        """Whatever you keep with it; None at first. (`tag` is the integer that the library keeps.)"""
        return self._world._user_data.get(self._id)

    @user_data.setter
    def user_data(self, value: Any) -> None:
        self._world._user_data[self._id] = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Entity) and other._id == self._id and other._world is self._world

    def __hash__(self) -> int:
        return hash((id(self._world), self._id))

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._id:#x}>"


class Body(Entity):
    """A rigid body. Positions are m in world space, velocities m/s and rad/s."""

    __slots__ = ()

    position: Attribute[Vec3, Vector] = Attribute(
        _flat.body_get_position,
        _flat.body_set_position,
        "Of the body's origin, m. Setting it moves the body at once, through whatever is between.",
    )
    rotation: Attribute[Quat, Vector] = Attribute(
        _flat.body_get_rotation, _flat.body_set_rotation, "x, y, z, w; any length but zero."
    )
    transform: Attribute[Transform, Pose] = Attribute(
        _flat.body_get_transform, _flat.body_set_transform, "Position and rotation."
    )
    linear_velocity: Attribute[Vec3, Vector] = Attribute(
        _flat.body_get_linear_velocity, _flat.body_set_linear_velocity, "Of the centre of mass, m/s."
    )
    angular_velocity: Attribute[Vec3, Vector] = Attribute(
        _flat.body_get_angular_velocity, _flat.body_set_angular_velocity, "rad/s, world axes."
    )
    centre: Attribute[Vec3, Vec3] = Attribute(_flat.body_get_centre, None, "Centre of mass, m, world space.")
    bounds: Attribute[Bounds, Bounds] = Attribute(
        _flat.body_get_bounds, None, "The box around its shapes, m, world space."
    )
    mass: Attribute[float, float] = Attribute(_flat.body_get_mass, _flat.body_set_mass, "kg; 0 when it is not dynamic.")
    gravity_scale: Attribute[float, float] = Attribute(
        _flat.body_get_gravity_scale, _flat.body_set_gravity_scale, "Factor of the world's gravity."
    )
    sleep_threshold: Attribute[float, float] = Attribute(
        _flat.body_get_sleep_threshold,
        _flat.body_set_sleep_threshold,
        "It may sleep when its fastest point is slower, m/s.",
    )
    tag: Attribute[int, int] = Attribute(
        _flat.body_get_user_data, _flat.body_set_user_data, "An integer of yours below 2^64, kept by the library."
    )
    awake = Switch(_flat.body_get_awake, _flat.body_set_awake, "False: asleep. Static bodies are never awake.")
    sleep_allowed = Switch(_flat.body_get_sleep_allowed, _flat.body_set_sleep_allowed, "May it sleep?")
    enabled = Switch(
        _flat.body_get_enabled, _flat.body_set_enabled, "False: neither moves, nor collides, nor is seen by queries."
    )
    bullet = Switch(_flat.body_get_bullet, _flat.body_set_bullet, "Stopped by moving bodies too when it is fast.")

    @property
    def type(self) -> str:
        """ "static", "kinematic" or "dynamic"."""
        return BODY_TYPES[_flat.body_get_type(self._capsule, self._id)]

    @type.setter
    def type(self, value: str) -> None:
        _flat.body_set_type(self._capsule, self._id, body_type(value))

    @property
    def is_valid(self) -> bool:
        """False once it is destroyed, or its world closed."""
        return not self._world.closed and _flat.body_is_valid(self._capsule, self._id) == 1

    @property
    def damping(self) -> Tuple[float, float]:
        """Linear and angular, 1/s."""
        linear, angular = _flat.body_get_damping(self._capsule, self._id)
        return linear, angular

    @damping.setter
    def damping(self, value: Sequence[float]) -> None:
        linear, angular = value
        _flat.body_set_damping(self._capsule, self._id, linear, angular)

    @property
    def locks(self) -> Tuple[str, str]:
        """World axes along and about which it cannot move: ("y", "xz") keeps its height and lets it rotate about y
        only."""
        linear, angular = _flat.body_get_locks(self._capsule, self._id)
        return axes_text(linear), axes_text(angular)

    @locks.setter
    def locks(self, value: Sequence[str]) -> None:
        _flat.body_set_locks(self._capsule, self._id, *locks_bits(value))

    @property
    def filter(self) -> Filter:
        """Layer, mask and group of all its shapes. A StateError when it has none, or when they differ."""
        return Filter(*_flat.body_get_filter(self._capsule, self._id))

    @filter.setter
    def filter(self, value: Sequence[int]) -> None:
        _flat.body_set_filter(self._capsule, self._id, *Filter(*value))

    @property
    def mass_data(self) -> records.MassData:
        """Mass, centre and inertia that the solver uses. Setting it overrides what the shapes give, until
        reset_mass()."""
        return records.copy_record(records.MassData, _flat.body_get_mass_data(self._capsule, self._id))

    @mass_data.setter
    def mass_data(self, value: records.MassData) -> None:
        flat = _flat.mass_data()
        flat.mass, flat.centre, flat.inertia, flat.inertia_rotation = value
        _flat.body_set_mass_data(self._capsule, self._id, flat)

    def reset_mass(self) -> None:
        """Mass and inertia from the shapes and their densities again."""
        _flat.body_reset_mass(self._capsule, self._id)

    @property
    def shapes(self) -> List["Shape"]:
        """In the order of creation."""
        return self._world._list(Shape, records.read_handles(_flat.body_get_shapes, self._capsule, self._id))

    @property
    def joints(self) -> List["Joint"]:
        """In the order of creation."""
        return self._world._list(Joint, records.read_handles(_flat.body_get_joints, self._capsule, self._id))

    @property
    def contacts(self) -> List[records.Contact]:
        """What it touches or nearly touches, triggers not counted."""
        return self._world._contacts(_flat.body_get_contacts, self._id)

    # ---- forces ----

    def add_force(self, force: Vector, point: Optional[Vector] = None) -> None:
        """N, world axes, during all of the next step; at the centre of mass, or at a point of the world, m."""
        if point is None:
            _flat.body_add_force(self._capsule, self._id, force)
        else:
            _flat.body_add_force_at(self._capsule, self._id, force, point)

    def add_torque(self, torque: Vector) -> None:
        """N m, world axes, during all of the next step."""
        _flat.body_add_torque(self._capsule, self._id, torque)

    def add_impulse(self, impulse: Vector, point: Optional[Vector] = None) -> None:
        """N s: changes the velocity at once; at the centre of mass, or at a point of the world, m."""
        if point is None:
            _flat.body_add_impulse(self._capsule, self._id, impulse)
        else:
            _flat.body_add_impulse_at(self._capsule, self._id, impulse, point)

    def add_angular_impulse(self, impulse: Vector) -> None:
        """N m s."""
        _flat.body_add_angular_impulse(self._capsule, self._id, impulse)

    def velocity_at(self, point: Vector) -> Vec3:
        """Of the material point that is now at `point`, m/s."""
        velocity: Vec3 = _flat.body_get_point_velocity(self._capsule, self._id, point)
        return velocity

    def move_to(self, position: Vector, rotation: Vector = NO_ROTATION, seconds: float = 1 / 60) -> None:
        """Gives a kinematic body the velocities that bring it there in `seconds`."""
        _flat.body_set_target(self._capsule, self._id, (position, rotation), seconds)

    # ---- shapes ----

    def add(
        self,
        geometry: Geometry,
        *,
        density: Optional[float] = None,
        position: Vector = (0.0, 0.0, 0.0),
        rotation: Vector = NO_ROTATION,
        material: Optional[Material] = None,
        friction: Optional[float] = None,
        restitution: Optional[float] = None,
        layer: int = 1,
        mask: int = 0xFFFFFFFF,
        group: int = 0,
        trigger: bool = False,
        events: Iterable[str] = ("touch",),
        pair_filter: bool = False,
        one_way: Optional[Vector] = None,
        surface_velocity: Vector = (0.0, 0.0, 0.0),
        tag: int = 0,
    ) -> "Shape":
        """Gives the body a shape. Position and rotation are its frame in the body's space. `friction` sets both
        static and dynamic friction. `one_way` is a direction in the shape's frame: the shape holds back only what
        comes against it."""
        definition = _flat.shape_def()
        if density is not None:
            definition.density = density
        definition.frame = (position, rotation)
        surface = Material() if material is None else Material(*material)
        if friction is not None:
            surface = surface._replace(static_friction=friction, dynamic_friction=friction)
        if restitution is not None:
            surface = surface._replace(restitution=restitution)
        definition.material = flat_material(surface)
        definition.layer = layer
        definition.mask = mask
        definition.group = group
        definition.trigger = 1 if trigger else 0
        definition.events = events_bits(events)
        definition.pair_filter = 1 if pair_filter else 0
        if one_way is not None:
            definition.one_way, definition.one_way_direction = 1, one_way
        definition.surface_velocity = surface_velocity
        definition.user_data = tag
        shape = _flat.shape_create(self._capsule, self._id, definition, flat_geometry(self._world.store, geometry))
        return Shape(self._world, shape)

    def add_sphere(self, radius: float, **options: Any) -> "Shape":
        """A ball; for the options see add()."""
        return self.add(Sphere(radius), **options)

    def add_capsule(self, half_height: float, radius: float, **options: Any) -> "Shape":
        """A rod with round ends along local Y; for the options see add()."""
        return self.add(Capsule(half_height, radius), **options)

    def add_box(self, half_x: float, half_y: float, half_z: float, **options: Any) -> "Shape":
        """A box by half its edges; for the options see add()."""
        return self.add(Box(half_x, half_y, half_z), **options)

    def add_cylinder(self, half_height: float, radius: float, **options: Any) -> "Shape":
        """A cylinder along local Y; for the options see add()."""
        return self.add(Cylinder(half_height, radius), **options)

    def add_cone(self, half_height: float, radius: float, **options: Any) -> "Shape":
        """A cone along local Y, its tip at +half_height; for the options see add()."""
        return self.add(Cone(half_height, radius), **options)

    def add_plane(self, normal: Vector = (0.0, 1.0, 0.0), distance: float = 0.0, **options: Any) -> "Shape":
        """The half space normal . p <= distance, for static bodies; for the options see add()."""
        return self.add(Plane(normal, distance), **options)

    # ---- queries ----

    def raycast(self, origin: Vector, translation: Vector) -> Optional[records.Hit]:
        """Where a segment meets this body, whatever its layers."""
        hit: Optional[records.Hit] = _flat.body_raycast(self._capsule, self._id, origin, translation, self._world)
        return hit

    def closest_point(self, point: Vector) -> Optional[records.Closest]:
        """Of its surface; None for a body without shapes."""
        found: Optional[records.Closest] = _flat.body_closest_point(self._capsule, self._id, point, self._world)
        return found

    def destroy(self) -> None:
        """Destroys its shapes and joints too; what it touched gets its exit with the next step."""
        self._world._forget(self)
        _flat.body_destroy(self._capsule, self._id)


class Shape(Entity):
    """A form on a body, with material and filters."""

    __slots__ = ()

    density: Attribute[float, float] = Attribute(_flat.shape_get_density, _flat.shape_set_density, "kg/m3.")
    surface_velocity: Attribute[Vec3, Vector] = Attribute(
        _flat.shape_get_surface_velocity, _flat.shape_set_surface_velocity, "Of a conveyor belt, m/s, shape frame."
    )
    tag: Attribute[int, int] = Attribute(
        _flat.shape_get_user_data, _flat.shape_set_user_data, "An integer of yours below 2^64, kept by the library."
    )
    frame: Attribute[Transform, Pose] = Attribute(
        _flat.shape_get_frame, _flat.shape_set_frame, "Position, m, and rotation in the body's space."
    )
    bounds: Attribute[Bounds, Bounds] = Attribute(
        _flat.shape_get_bounds, None, "The box around it, m, world space. An UnsupportedError for a plane."
    )
    trigger = Switch(
        _flat.shape_get_trigger, _flat.shape_set_trigger, "True: reports what touches it and pushes nothing."
    )
    pair_filter = Switch(
        _flat.shape_get_pair_filter, _flat.shape_set_pair_filter, "Does the world's pair filter judge its new pairs?"
    )

    @property
    def is_valid(self) -> bool:
        """False once it is destroyed, or its world closed."""
        return not self._world.closed and _flat.shape_is_valid(self._capsule, self._id) == 1

    @property
    def body(self) -> Body:
        """The body it belongs to."""
        return Body(self._world, _flat.shape_get_body(self._capsule, self._id))

    @property
    def geometry(self) -> Geometry:
        """Its form: a Sphere, Capsule, Box, Cylinder, Cone, Plane, Hull, Mesh, Heightfield or Compound; a hull or a
        mesh with another scale than 1 is a Scaled."""
        return geometry_of(self._world.store, _flat.shape_get_geometry(self._capsule, self._id))

    @geometry.setter
    def geometry(self, value: Geometry) -> None:
        _flat.shape_set_geometry(self._capsule, self._id, flat_geometry(self._world.store, value))

    @property
    def material(self) -> Material:
        """Friction, restitution, resistance to rolling and spinning, and a number of yours."""
        return material_of(_flat.shape_get_material(self._capsule, self._id))

    @material.setter
    def material(self, value: Sequence[Any]) -> None:
        _flat.shape_set_material(self._capsule, self._id, flat_material(value))

    @property
    def filter(self) -> Filter:
        """Its layer (one bit), the mask of layers it collides with, its group."""
        return Filter(*_flat.shape_get_filter(self._capsule, self._id))

    @filter.setter
    def filter(self, value: Sequence[int]) -> None:
        _flat.shape_set_filter(self._capsule, self._id, *Filter(*value))

    @property
    def one_way(self) -> Optional[Vec3]:
        """The direction, in the shape's frame, of a floor to jump through: it holds back only what comes against it.
        None: it holds back everything."""
        enabled, direction = _flat.shape_get_one_way(self._capsule, self._id)
        return direction if enabled else None

    @one_way.setter
    def one_way(self, value: Optional[Vector]) -> None:
        _flat.shape_set_one_way(self._capsule, self._id, 0 if value is None else 1, value)

    @property
    def events(self) -> Tuple[str, ...]:
        """What it reports: any of "touch", "stay", "hit"."""
        bits = _flat.shape_get_events(self._capsule, self._id)
        return tuple(name for name, bit in EVENT_BITS.items() if bits & bit)

    @events.setter
    def events(self, value: Iterable[str]) -> None:
        _flat.shape_set_events(self._capsule, self._id, events_bits(value))

    @property
    def contacts(self) -> List[records.Contact]:
        """What it touches or nearly touches."""
        return self._world._contacts(_flat.shape_get_contacts, self._id)

    @property
    def overlaps(self) -> List["Shape"]:
        """Shapes that touched it at the end of the last step: who is inside a trigger now. In the order of
        creation."""
        return self._world._list(Shape, records.read_handles(_flat.shape_get_overlaps, self._capsule, self._id))

    def raycast(self, origin: Vector, translation: Vector) -> Optional[records.Hit]:
        """Where a segment meets this shape, whatever its layer."""
        hit: Optional[records.Hit] = _flat.shape_raycast(self._capsule, self._id, origin, translation, self._world)
        return hit

    def closest_point(self, point: Vector) -> Optional[records.Closest]:
        """Of its surface."""
        found: Optional[records.Closest] = _flat.shape_closest_point(self._capsule, self._id, point, self._world)
        return found

    def destroy(self) -> None:
        """Its body's mass follows."""
        _flat.shape_destroy(self._capsule, self._id)
        self._world._user_data.pop(self._id, None)


class Joint(Entity):
    """Ties body B to body A. The world's create_..._joint methods make joints; their fields are those of the
    definitions in feather.h."""

    __slots__ = ()

    enabled = Switch(_flat.joint_get_enabled, _flat.joint_set_enabled, "False: as if it were not there.")
    tag: Attribute[int, int] = Attribute(
        _flat.joint_get_user_data, _flat.joint_set_user_data, "An integer of yours below 2^64, kept by the library."
    )

    @property
    def is_valid(self) -> bool:
        """False once it is destroyed or broken, or its world closed."""
        return not self._world.closed and _flat.joint_is_valid(self._capsule, self._id) == 1

    @property
    def type(self) -> str:
        """ "distance", "ball", "hinge", "fixed" or "configurable"."""
        return JOINT_TYPES[_flat.joint_get_type(self._capsule, self._id)]

    @property
    def bodies(self) -> Tuple[Optional[Body], Optional[Body]]:
        """A and B; None is the world."""
        a, b = _flat.joint_get_bodies(self._capsule, self._id)
        return self._world._end(a), self._world._end(b)

    @property
    def frames(self) -> Tuple[Transform, Transform]:
        """Where the frames of A and B are, world space."""
        a, b = _flat.joint_get_frames(self._capsule, self._id)
        return a, b

    @property
    def state(self) -> records.JointState:
        """Angles, lengths, speeds, errors now."""
        return records.copy_record(records.JointState, _flat.joint_get_state(self._capsule, self._id))

    @property
    def angle(self) -> float:
        """The twist; of a hinge the angle, rad."""
        angle: float = _flat.joint_get_state(self._capsule, self._id).angle
        return angle

    @property
    def reaction(self) -> Tuple[Vec3, Vec3]:
        """Force, N, and torque, N m, on B in the last step."""
        force, torque = _flat.joint_get_reaction(self._capsule, self._id)
        return force, torque

    @property
    def definition(self) -> SimpleNamespace:
        """A copy of its definition: the fields of fe_<type>_joint_def in feather.h, `tag`, and the axes of a
        configurable joint as linear_x to angular_z."""
        return fields_of(getattr(_flat, self.type + "_joint_get")(self._capsule, self._id))

    def set(self, **fields: Any) -> None:
        """Changes fields of its definition: hinge.set(motor_speed=2, motor_max=10). Axes as in
        create_configurable_joint()."""
        kind = self.type
        definition = getattr(_flat, kind + "_joint_get")(self._capsule, self._id)
        fill(definition, fields)
        getattr(_flat, kind + "_joint_set")(self._capsule, self._id, definition)

    def set_motor_speed(self, speed: float, dof: Optional[str] = None) -> None:
        """Changes the speed of its motor alone, m/s or rad/s. A configurable joint needs the axis, "linear_x" to
        "angular_z", a ball joint an angular one."""
        _flat.joint_set_motor_speed(self._capsule, self._id, self._dof(dof), speed)

    def set_target(self, target: Union[float, Vector], dof: Optional[str] = None) -> None:
        """Changes the target of its spring alone: m or rad, of a ball joint a rotation. A configurable joint needs
        the axis."""
        if self.type == "ball":
            _flat.ball_joint_set_target(self._capsule, self._id, target)
        else:
            _flat.joint_set_target(self._capsule, self._id, self._dof(dof), target)

    def _dof(self, dof: Optional[str]) -> int:
        if dof is None:
            dof = {"distance": "linear_x", "hinge": "angular_x"}.get(self.type)
        return word(DOFS, dof, "dof")

    def destroy(self) -> None:
        """Its bodies wake, and may collide again from the next step on."""
        _flat.joint_destroy(self._capsule, self._id)
        self._world._user_data.pop(self._id, None)


# what queries find is made of these
_flat.set_classes((Entity, Body, Shape, records.Hit, records.Closest, records.Overlap))
