"""Compounds: one form of several parts, whose places hits, contacts and events tell."""

import math
from typing import Any, Callable, List

import numpy as np
import pytest

from feather_physics import (
    Body,
    Box,
    Capsule,
    Compound,
    Cylinder,
    InvalidArgumentError,
    Material,
    Part,
    Plane,
    Scaled,
    Sphere,
    StaleHandleError,
    Store,
    UnsupportedError,
    World,
    WrongKindError,
    _flat,
    records,
)

CUBE = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
ICE = Material(0.0, 0.0, user_id=5)
HALF_TURN = (0.0, 1.0, 0.0, 0.0)  # about y


def dumbbell(world: World) -> Compound:
    """Two balls of 0.5 m at x = -1 and 1, and a rod between them; the second ball is of ice, and heavy."""
    return world.create_compound([
        Part(Sphere(0.5), (-1, 0, 0)),
        {"geometry": Sphere(0.5), "position": (1, 0, 0), "density": 3000, "material": ICE, "tag": 2**63},
        Part(Cylinder(0.5, 0.1), rotation=(0, 0, math.sqrt(0.5), math.sqrt(0.5))),
    ])


def test_parts_are_read_back_as_they_were_given(world: World) -> None:
    hull = world.create_hull(CUBE)
    mesh = world.create_mesh([(-1, 0, -1), (1, 0, -1), (-1, 0, 1), (1, 0, 1)], [(0, 2, 3), (0, 3, 1)])
    field = world.create_heightfield([[0, 0], [0, 0]])
    parts = [
        Part(Sphere(0.5), (-1, 2, 3)),
        Part(Box(1, 2, 0.5), rotation=(0, 4, 0, 0), density=0, material=ICE, tag=2**64 - 1),
        Part(Capsule(1, 0.5), density=250),
        Part(hull),
        Part(Scaled(hull, (2, -1, 1))),
        Part(mesh),
        Part(field),
    ]
    compound = world.create_compound(iter(parts))
    assert isinstance(compound, Compound) and compound.store is world.store and compound.is_valid
    assert compound.parts == [parts[0], parts[1]._replace(rotation=HALF_TURN), *parts[2:]]
    assert compound.part(4).geometry == Scaled(hull, (2, -1, 1)) and compound.part(1).density == 0
    compound.user_data = "kept"
    assert world.create_body("static").add(compound).geometry.user_data == "kept"  # type: ignore[union-attr]


def test_info_and_mass_are_those_of_the_parts(world: World) -> None:
    compound = dumbbell(world)
    assert compound.info.part_count == 3 and compound.info.bytes > 0
    assert compound.info.lower == pytest.approx((-1.5, -0.5, -0.5), abs=1e-6)
    assert compound.info.upper == pytest.approx((1.5, 0.5, 0.5), abs=1e-6)
    body = world.create_body()
    shape = body.add(compound, density=1000)
    ball, rod = math.pi / 6, math.pi * 0.01  # m3
    assert body.mass == pytest.approx(1000 * (ball + rod) + 3000 * ball, rel=1e-5)
    assert body.centre.x == pytest.approx(2000 * ball / body.mass, rel=1e-5)
    shape.density = 2000  # that of the second ball is its own
    assert body.mass == pytest.approx(2000 * (ball + rod) + 3000 * ball, rel=1e-5)
    assert shape.geometry == compound and body.shapes == [shape]
    shape.geometry = Sphere(0.5)
    assert body.mass == pytest.approx(2000 * ball, rel=1e-5)
    shape.geometry = compound
    assert shape.geometry == compound


def test_queries_tell_the_part(world: World) -> None:
    shape = world.create_body("static").add(dumbbell(world), material=Material(user_id=9))
    for x, part, material in ((-1, 0, 9), (1, 1, 5), (0, 2, 9)):
        hit = world.raycast((x, 5, 0), (0, -10, 0))
        assert hit and (hit.shape, hit.part, hit.material, hit.triangle) == (shape, part, material, -1)
        sweep = world.sweep(Sphere(0.05), (x, 5, 0), (0, -10, 0))
        assert sweep and (sweep.shape, sweep.part, sweep.material) == (shape, part, material)
        closest = world.closest_point((x, 1, 0), 2)
        assert closest and (closest.shape, closest.part, closest.material) == (shape, part, material)
        one = shape.raycast((x, 5, 0), (0, -10, 0))
        assert one == hit and shape.body.raycast((x, 5, 0), (0, -10, 0)) == hit
        assert shape.closest_point((x, 1, 0)) == closest
    assert {hit.part for hit in world.raycast_all((-5, 0, 0), (10, 0, 0))} <= {0, 1, 2}
    (deep,) = world.overlap_shapes(Sphere(0.25), (1, 0.5, 0))
    assert (deep.shape, deep.part, deep.material) == (shape, 1, 5)
    assert world.overlap(Box(2, 2, 2), (0, 0, 0)) == [shape.body] and not world.raycast((0, 5, 0.3), (0, -10, 0))
    rays = np.array([[x, 5, 0, 0, -10, 0] for x in (-1, 1, 0, 9)], float)
    hits = np.frombuffer(world.raycast_many(rays), records.HIT.dtype)
    assert hits["part"][:3].tolist() == [0, 1, 2] and hits["body"][3] == 0
    many = np.frombuffer(world.raycast_many(rays), records.HIT.dtype)["shape"][:3]
    assert set(many.tolist()) == {shape.id}


def test_events_and_contacts_tell_the_part(world: World, ground: Body) -> None:
    body = world.create_body(position=(0, 0.51, 0))
    shape = body.add(dumbbell(world), density=3000, events=("touch", "stay", "hit"))
    body.linear_velocity = (0, -4, 0)
    touched: List[Any] = []
    hits: List[Any] = []
    for _ in range(30):
        world.step()
        touched += world.pair_events
        hits += world.hit_events
    assert touched[0].kind == "enter" and touched[0].part_a == -1 and touched[0].part_b in (0, 1)
    assert [e.kind for e in touched].count("enter") == 1 and {e.shape_b for e in touched} == {shape}
    assert hits and all(e.part_a == -1 and e.part_b in (0, 1) for e in hits)
    assert {(c.part_a, c.part_b, c.shape_b) for c in body.contacts} == {(-1, 0, shape), (-1, 1, shape)}
    assert {c.part_b: c.material_b for c in shape.contacts} == {0: 0, 1: 5}
    packed = bytearray(8 * records.PAIR_EVENT.size)
    count = world.read_events("pair", packed)
    events = np.frombuffer(packed, records.PAIR_EVENT.dtype)[:count]
    assert count == 1 and events["part_a"][0] == -1 and events["part_b"][0] in (0, 1)
    body.position = (0, 5, 0)
    world.step()
    assert [(e.kind, e.part_a, e.part_b) for e in world.pair_events] == [("exit", -1, -1)]


def test_a_compound_moves_as_single_shapes_do() -> None:
    def run(give: Callable[[Body, List[Part]], Any]) -> bytes:
        with World() as world:
            world.create_body("static").add_plane()
            hull = world.create_hull(CUBE)
            parts = [
                Part(Box(1, 0.05, 0.6), (0, 0.4, 0), density=600),
                Part(Cylinder(0.35, 0.05), (-0.9, 0, -0.5)),
                Part(Sphere(0.35), (0.9, 0, 0), material=ICE),
                Part(Scaled(hull, (0.4, 0.4, 0.4)), (0.9, 0, 0.5), (0, 0.1, 0, 1)),
            ]
            for i in range(4):
                give(world.create_body(position=(0.1 * i, 1 + 2 * i, 0), rotation=(0.1, 0.2, 0.3, 1)), parts)
            for _ in range(100):
                world.step()
            return bytes(world.exact_transforms())

    def singly(body: Body, parts: List[Part]) -> None:
        for part in parts:
            body.add(
                part.geometry, position=part.position, rotation=part.rotation, density=part.density, material=part.material
            )

    assert run(lambda body, parts: body.add(body.world.create_compound(parts))) == run(singly)


def test_a_compound_lives_as_long_as_its_shapes() -> None:
    with Store() as store:
        hull = store.create_hull(CUBE)
        compound = store.create_compound([Part(hull), Part(Sphere(0.5), (0, 1, 0))])
        hull.destroy()
        worlds = [World(store=store), World(store=store)]
        shapes = [world.create_body().add(compound) for world in worlds]
        compound.destroy()
        assert not compound.is_valid
        for shape in shapes:
            hit = shape.raycast((0, 0.1, 5), (0, 0, -10))
            assert hit and hit.part == 0
        for use in (lambda: compound.info, lambda: compound.part(0), lambda: shapes[0].body.add(compound)):
            with pytest.raises(StaleHandleError):
                use()
        for world in worlds:
            world.close()


def test_wrong_parts_are_named_and_leave_nothing(world: World) -> None:
    refuse(world)
    before = world.store.bytes
    refuse(world)
    assert world.store.bytes == before


def refuse(world: World) -> None:
    ball = Part(Sphere(0.5))
    for change, text in (
        ({"density": -2}, r"parts\[1\]: .*density"),
        ({"density": math.nan}, r"parts\[1\]: .*density"),
        ({"position": (0, math.inf, 0)}, r"parts\[1\]: .*position.y"),
        ({"rotation": (0, 0, 0, 0)}, r"parts\[1\]: .*rotation"),
        ({"material": Material(-1)}, r"parts\[1\]: .*static_friction"),
        ({"geometry": Sphere(-1)}, r"parts\[1\]: .*radius"),
    ):
        with pytest.raises(InvalidArgumentError, match=text):
            world.create_compound([ball, ball._replace(**change)])  # type: ignore[arg-type]
    compound = world.create_compound([ball])
    for geometry, text in ((Plane(), "plane"), (compound, "compound")):
        with pytest.raises(UnsupportedError, match=rf"parts\[1\]: .*{text}"):
            world.create_compound([ball, Part(geometry)])
    with pytest.raises(InvalidArgumentError, match="count"):
        world.create_compound([])
    with pytest.raises(InvalidArgumentError, match="count"):
        world.create_compound([ball] * 65536)
    with pytest.raises(TypeError, match="a Part or a dictionary of its fields is needed, not 'Sphere'"):
        world.create_compound([Sphere(0.5)])  # type: ignore[list-item]
    with pytest.raises(TypeError, match="colour"):
        world.create_compound([{"geometry": Sphere(0.5), "colour": 3}])
    with pytest.raises(TypeError, match="geometry"):
        world.create_compound([{"position": (0, 0, 0)}])
    with pytest.raises(TypeError, match="a geometry is needed, not 'float'"):
        world.create_compound([Part(0.5)])  # type: ignore[arg-type]
    with pytest.raises(OverflowError, match="user_data"):
        world.create_compound([ball._replace(tag=-1)])
    with World() as other, pytest.raises(InvalidArgumentError, match="another store"):
        world.create_compound([Part(other.create_hull(CUBE))])
    hull = world.create_hull(CUBE)
    hull.destroy()
    with pytest.raises(StaleHandleError):
        world.create_compound([Part(hull)])
    compound.destroy()


def test_a_compound_is_saved_with_the_assets_of_its_parts(world: World) -> None:
    hull = world.create_hull(CUBE)
    compound = world.create_compound([Part(Sphere(0.5), tag=7), Part(hull, position=(1, 0, 0), density=5.0)])
    saved = compound.save()
    with World() as other:
        loaded = other.store.load(saved)
        assert isinstance(loaded, Compound) and loaded.save() == saved and loaded.key == compound.key
        assert loaded.parts[0].tag == 7 and loaded.parts[1].density == 5.0
        other.create_body().add(loaded)
        other.step(1 / 60)


def test_what_a_compound_cannot(world: World) -> None:
    body = world.create_body()
    compound = world.create_compound([Part(Sphere(0.5))])
    mesh = world.create_mesh([(-1, 0, -1), (1, 0, -1), (-1, 0, 1)], [(0, 2, 1)])
    with pytest.raises(UnsupportedError, match="compound"):
        body.add(Scaled(compound, (2, 2, 2)))  # type: ignore[arg-type]
    with pytest.raises(UnsupportedError):
        body.add(world.create_compound([Part(Sphere(0.5)), Part(mesh)]))
    with pytest.raises(InvalidArgumentError, match="part"):
        compound.part(1)
    with pytest.raises(InvalidArgumentError, match="part"):
        compound.part(-1)
    for flat in (_flat.compound_get_info, lambda *given: _flat.compound_get_part(*given, 0)):
        with pytest.raises(WrongKindError):
            flat(world.store._capsule, mesh.id)
    assert body.shapes == []


def test_the_geometry_of_a_flat_part_outlives_it() -> None:
    geometry = _flat.compound_part().geometry
    geometry.radius = 2
    part = _flat.compound_part()
    part.geometry = geometry
    del geometry
    assert part.geometry.radius == 2 and part.density == -1
    for wrong in (part, [part, None], 5, None):
        with pytest.raises(TypeError):
            _flat.compound_create(_flat.store_create(None), wrong)
