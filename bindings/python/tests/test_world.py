"""What a world reports and how it is set: energy, bounds, stores, pair filters, one-way floors, motors, ends that are the
world."""

import gc
import math
import weakref
from array import array
from typing import Any, List

import numpy as np
import pytest

from feather_physics import (
    Body,
    Bounds,
    Box,
    Closest,
    Filter,
    FilterPair,
    Hit,
    InvalidArgumentError,
    Material,
    Overlap,
    Plane,
    Shape,
    Sphere,
    StaleHandleError,
    StateError,
    SteppingError,
    Store,
    UnsupportedError,
    Vec3,
    World,
    records,
)

STEP = 1 / 60


def run(world: World, seconds: float) -> None:
    for _ in range(round(seconds / STEP)):
        world.step(STEP)


def test_energy_and_momentum_of_a_throw(world: World) -> None:
    body = world.create_body(position=(0, 10, 0), linear_velocity=(3, 4, 0))
    body.add_sphere(0.5)
    linear, angular = world.momentum((0, 8, 0))
    assert linear == pytest.approx((3 * body.mass, 4 * body.mass, 0))
    assert angular == pytest.approx((0, 0, -2 * 3 * body.mass)) == world.momentum(about=(0, 8, 0)).angular
    world.step(STEP)
    # E = m v^2 / 2 + m g (y - h v_y / 2)
    before, (x, y, _), (vx, vy, _) = world.energy(), body.position, body.linear_velocity
    assert before.kinetic == pytest.approx(body.mass * (vx * vx + vy * vy) / 2)
    assert before.potential == pytest.approx(body.mass * 9.81 * (y - STEP / 8 * vy / 2), rel=1e-6)
    run(world, 1)
    assert sum(world.energy()) == pytest.approx(sum(before), rel=1e-6)


def test_bounds(world: World) -> None:
    with pytest.raises(StateError):
        world.bounds
    body = world.create_body(position=(1, 2, 3))
    shape = body.add_box(0.5, 1, 1.5)
    other = world.create_body("static", position=(1e8, 0, 0)).add_sphere(1)
    assert isinstance(shape.bounds, Bounds)
    assert shape.bounds == body.bounds == ((0.5, 1, 1.5), (1.5, 3, 4.5))
    assert world.bounds.lower == pytest.approx((0.5, -1, -1)) and world.bounds.upper == pytest.approx((1e8 + 1, 3, 4.5))
    plane = world.create_body("static").add_plane()
    with pytest.raises(UnsupportedError):
        plane.bounds
    assert world.overlap_bounds((0, 0.5, 0), (2, 2, 1)) == []
    assert world.overlap_bounds((0, 0.5, 0), (2, 2, 4)) == [shape]
    assert world.overlap_bounds((-1, -2, -1), (1e9, 9, 9)) == [shape, other, plane]
    assert world.overlap_bounds((-1, -2, -1), (1e9, 9, 9), exclude=[body, plane.body]) == [other]
    with pytest.raises(TypeError):
        world.overlap_bounds((0, 0, 0), None)  # type: ignore[arg-type]


def test_overlapping_shapes_come_with_the_way_out(world: World) -> None:
    shape = world.create_body("static").add_box(1, 1, 1, material=Material(user_id=2**63 + 5))
    (found,) = world.overlap_shapes(Sphere(0.5), (0, 1.25, 0))
    assert (found.body, found.shape, found.material) == (shape.body, shape, 2**63 + 5)
    assert found.direction == pytest.approx((0, 1, 0), abs=1e-6) and found.depth == pytest.approx(0.25, abs=1e-5)
    assert world.overlap_shapes(Sphere(0.5), (0, 1.25 + found.depth + 1e-3, 0)) == []
    assert world.overlap_shapes(Sphere(0.5), (0, 1.25, 0), mask=2) == []


def test_what_is_inside_a_trigger_now(world: World, ball: Body) -> None:
    zone = world.create_body("static", position=(0, 3, 0)).add_box(1, 1, 1, trigger=True)
    assert zone.overlaps == []
    run(world, 0.5)
    assert 2 < ball.position.y < 4 and zone.overlaps == ball.shapes
    run(world, 1)
    assert zone.overlaps == []


def test_hits_and_contacts_know_the_surface(world: World) -> None:
    ground = world.create_body("static").add_plane(material=Material(user_id=7))
    ball = world.create_body(position=(0, 0.52, 0), linear_velocity=(0, -5, 0))
    shape = ball.add_sphere(0.5, material=Material(user_id=2**64 - 1), events=("touch", "hit"))
    hit = world.raycast((3, 5, 0), (0, -10, 0))
    assert hit and hit.material == 7 and (hit.part, hit.barycentric) == (-1, (0, 0))
    assert [h.material for h in world.raycast_all((0, 5, 0), (0, -10, 0))] == [2**64 - 1, 7]
    near = ball.closest_point((0, 5, 0))
    assert near and near.material == 2**64 - 1 and near.part == -1
    world.step(STEP)
    (event,) = world.hit_events
    (contact,) = shape.contacts
    for two in (event, contact):
        assert (two.shape_a, two.shape_b, two.material_a, two.material_b) == (ground, shape, 7, 2**64 - 1)
        assert (two.part_a, two.part_b, two.triangle_a, two.triangle_b) == (-1, -1, -1, -1)
    (pair,) = world.pair_events
    assert (pair.part_a, pair.part_b, pair.triangle_a, pair.triangle_b) == (-1, -1, -1, -1)


def test_triangle_and_barycentric_coordinates_of_a_hit(world: World) -> None:
    field = world.create_heightfield([[0, 0, 0], [0, 0, 0]], cell_x=2, cell_z=2)
    world.create_body("static").add(field)
    hit = world.raycast((2.5, 1, 1.5), (0, -2, 0))
    # cell 1, above its diagonal from (0, 0) to (1, 1): its z side, triangle 2
    assert hit and hit.triangle == 2 and 0 < hit.barycentric[0] + hit.barycentric[1] < 1
    assert world.raycast_all((2.5, 1, 1.5), (0, -2, 0)) == [hit]


def test_a_hit_has_the_fields_of_the_record(world: World) -> None:
    mesh = world.create_mesh([(0, 0, 0), (0, 0, 3), (3, 0, 0)], [(0, 1, 2)], two_sided=True)
    body = world.create_body("static", position=(1, 2, 3))
    shape = body.add(mesh, material=Material(user_id=5))
    start, way = (2, 0, 4), (0, 4, 0)
    hit = world.raycast(start, way)
    packed = np.frombuffer(world.raycast_many(np.array([[*start, *way]], float)), records.HIT.dtype)[0]
    assert hit and type(hit) is Hit and type(hit.body) is Body and type(hit.shape) is Shape and type(hit.point) is Vec3
    assert (hit.body, hit.shape, hit.body.id, hit.shape.id) == (body, shape, packed["body"], packed["shape"])
    for name in ("point", "normal", "barycentric", "fraction", "depth", "part", "triangle", "material"):
        assert np.array_equal(getattr(hit, name), packed[name]), name
    assert hit.back is True and hit.started_inside is False and hit.body.world is world and hit.body.mass == 0
    assert world.raycast_all(start, way) == [hit] and repr(world.raycast_all(start, way)[0]) == repr(hit)
    near = world.closest_point(start, 9)
    assert type(near) is Closest and near[:3] == (body, shape, (2, 2, 4)) and near.distance == 2 and near.part == -1
    assert near[4:] == ((0, -1, 0), 0, -1, hit.barycentric, 5)
    (overlap,) = world.overlap_shapes(Sphere(0.5), (2, 2.25, 4))
    assert type(overlap) is Overlap and overlap[:2] == (body, shape) and overlap[4:] == (-1, 0, 5)
    assert overlap.direction == (0, 1, 0) and overlap.depth == pytest.approx(0.25)


@pytest.mark.parametrize("count", [0, 1, records.SOME - 1, records.SOME, records.SOME + 1, 3 * records.SOME])
def test_a_query_brings_all_that_it_finds(world: World, count: int) -> None:
    bodies = world.create_bodies([(0, i, 0) for i in range(count)], type="static")
    shapes = [body.add_sphere(0.25) for body in bodies]
    assert [hit.body for hit in world.raycast_all((0, -1, 0), (0, count + 1, 0))] == bodies == world.bodies
    assert [hit.shape for hit in world.sweep_all(Sphere(0.1), (0, -1, 0), (0, count + 1, 0))] == shapes
    assert world.overlap(Sphere(99), (0, 0, 0)) == bodies
    assert [(o.body, o.shape) for o in world.overlap_shapes(Sphere(99), (0, 0, 0))] == list(zip(bodies, shapes))
    assert world.overlap_bounds((-1, -1, -1), (1, count, 1)) == shapes
    assert list(world.body_ids()) == [body.id for body in bodies]


@pytest.mark.parametrize("group,touches", [(1, True), (-1, False), (0, False)])
def test_groups_decide_before_layers(world: World, group: int, touches: bool) -> None:
    ground = world.create_body("static")
    ground.add_plane(layer=2, mask=0, group=group)
    ball = world.create_body(position=(0, 0.4, 0))
    ball.add_sphere(0.5, mask=1, group=group)
    world.step(STEP)
    assert bool(ball.contacts) == touches
    ball.filter = Filter(1, 0xFFFFFFFF)
    ground.filter = (2, 0xFFFFFFFF, 0)  # type: ignore[assignment]
    world.step(STEP)
    assert ball.contacts and ball.filter == (1, 0xFFFFFFFF, 0)


def test_bodies_without_shapes_have_no_filter(world: World) -> None:
    body = world.create_body()
    with pytest.raises(StateError):
        body.filter
    with pytest.raises(StateError):
        body.filter = Filter()


def friction_of(a: Material, b: Material) -> float:
    """The acceleration of a box on a slide, m/s2: the friction of the pair times g, while it slides."""
    with World() as world:
        world.create_body("static").add_plane(material=a)
        box = world.create_body(position=(0, 0.5, 0), linear_velocity=(20, 0, 0), locks=("", "xyz"))
        box.add_box(0.5, 0.5, 0.5, material=b)
        run(world, 0.25)
        speed = box.linear_velocity.x
        run(world, 0.25)
        return (speed - box.linear_velocity.x) / 0.25


def test_materials_combine_as_they_say() -> None:
    for mode, friction in (("default", 0.4), ("average", 0.5), ("minimum", 0.2), ("multiply", 0.16), ("maximum", 0.8)):
        rough = Material(0.8, 0.8, friction_combine=mode)
        assert friction_of(rough, Material(0.2, 0.2)) == pytest.approx(9.81 * friction, rel=0.02), mode
    with pytest.raises(InvalidArgumentError, match="friction_combine: one of default, average"):
        World().create_body().add_sphere(1, material=Material(friction_combine="worst"))


def test_a_floor_to_jump_through(world: World) -> None:
    floor = world.create_body("static", position=(0, 1, 0)).add_box(5, 0.1, 5, one_way=(0, 2, 0))
    assert floor.one_way == (0, 2, 0)
    ball = world.create_body(position=(0, 0, 0), linear_velocity=(0, 9, 0))
    ball.add_sphere(0.25)
    run(world, 3)
    assert ball.position.y == pytest.approx(1.35, abs=0.01)
    floor.one_way = None
    assert floor.one_way is None
    ball.position, ball.linear_velocity = (0, 0, 0), (0, 9, 0)
    run(world, 0.5)
    assert ball.position.y < 1


# ---- pair filters ------------------------------------------------------------------------------------------------


def two_balls(world: World) -> List[Body]:
    world.create_body("static", tag=5).add_plane(pair_filter=True, tag=2**64 - 1)
    balls = world.create_bodies([(0, 0.52, 0), (3, 0.52, 0)])
    for ball in balls:
        ball.add_sphere(0.5)
    return balls


def test_a_pair_filter_decides(world: World) -> None:
    balls = two_balls(world)
    seen: List[FilterPair] = []

    def filter(pair: FilterPair) -> bool:
        seen.append(pair)
        return pair.body_b == balls[0]

    world.set_pair_filter(filter)
    run(world, 1)
    assert balls[0].position.y > 0.4 and balls[1].position.y < 0
    assert [pair.body_b for pair in seen] == balls
    first = seen[0]
    assert (first.body_tag_a, first.shape_tag_a, first.body_tag_b) == (5, 2**64 - 1, 0)
    assert first.shape_b == balls[0].shapes[0] and first.body_a.shapes == [first.shape_a]
    world.set_pair_filter(None)
    balls[1].position = (3, 0.6, 0)
    run(world, 1)
    assert balls[1].position.y > 0.4 and len(seen) == 2


def test_what_a_pair_filter_raises_is_raised_by_the_step(world: World) -> None:
    balls = two_balls(world)
    calls: List[FilterPair] = []

    def filter(pair: FilterPair) -> bool:
        calls.append(pair)
        raise KeyError(len(calls))

    world.set_pair_filter(filter)
    with pytest.raises(KeyError, match="1"):
        world.step(STEP)
    assert len(calls) == 1
    world.set_pair_filter(None)
    run(world, 1)
    assert all(ball.position.y > 0.4 for ball in balls)  # the step went on, and let them collide


def test_a_pair_filter_may_not_use_the_world(world: World) -> None:
    balls = two_balls(world)
    uses = [
        lambda: balls[0].position,
        lambda: world.create_body(),
        lambda: world.step(STEP),
        lambda: world.close(),
        lambda: world.set_pair_filter(None),
    ]
    refused: List[Any] = []

    def filter(pair: FilterPair) -> bool:
        for use in uses:
            with pytest.raises(SteppingError):
                use()
            refused.append(use)
        return True

    world.set_pair_filter(filter)
    world.step(STEP)
    assert refused == uses * 2 and not world.closed


def test_a_pair_filter_that_returns_nonsense(world: World) -> None:
    class Odd:
        def __bool__(self) -> bool:
            raise ArithmeticError("neither")

    two_balls(world)
    world.set_pair_filter(lambda pair: Odd())
    with pytest.raises(ArithmeticError, match="neither"):
        world.step(STEP)
    for wrong in (5, "x"):
        with pytest.raises(TypeError):
            world.set_pair_filter(wrong)  # type: ignore[arg-type]


def test_a_pair_filter_keeps_no_world_alive() -> None:
    world = World()
    home = weakref.ref(world)
    world.set_pair_filter(lambda pair: world.closed)
    del world
    gc.collect()
    assert home() is None


# ---- stores and numbers ------------------------------------------------------------------------------------------


def test_worlds_share_a_store() -> None:
    with Store(number=9) as store:
        field = store.create_heightfield([[0, 0], [0, 0]], cell_x=4, cell_z=4)
        worlds = [World(store=store), World(store=store)]
        for world in worlds:
            assert world.store is store
            shape = world.create_body("static").add(field, position=(-2, 0, -2))
            assert shape.geometry == field
        field.set_heights(0, 0, 2, 2, array("f", [1, 1, 1, 1]))
        for world in worlds:
            hit = world.raycast((0, 5, 0), (0, -10, 0))
            assert hit and hit.point.y == pytest.approx(1)
        assert store.bytes > 0 and field.store is store
        with pytest.raises(StateError):
            store.close()
        foreign = World().create_heightfield([[0, 0], [0, 0]])
        with pytest.raises(InvalidArgumentError, match="another store"):
            worlds[0].create_body("static").add(foreign)
        for world in worlds:
            world.close()
        assert field.is_valid
    assert store.closed and not field.is_valid
    with pytest.raises(StaleHandleError):
        store.bytes
    with pytest.raises(StaleHandleError):
        World(store=store)
    store.close()


def test_a_world_keeps_the_store_it_was_given() -> None:
    world = World(store=Store())
    gc.collect()
    world.create_body("static").add(world.create_heightfield([[0, 0], [0, 0]]))
    world.step()
    world.close()


def test_a_store_of_a_world_goes_with_it() -> None:
    world = World()
    store = world.store
    field = store.create_heightfield([[0, 0], [0, 0]])
    with pytest.raises(StateError):
        store.close()
    field.user_data = "hills"
    assert not store.closed and field.user_data == "hills"
    del world
    gc.collect()
    assert field.is_valid  # it keeps the world
    store = World().store
    gc.collect()
    assert store.bytes > 0
    closed = World()
    store = closed.store
    closed.close()
    assert store.closed


def test_handles_of_worlds_with_one_number_agree() -> None:
    a, b, c = World(number=77), World(number=77), World()
    assert (a.number, b.number) == (77, 77) and c.number != 77
    assert a.create_body().id == b.create_body().id != c.create_body().id
    assert a.hash == b.hash == c.hash
    with pytest.raises(InvalidArgumentError):
        World(number=4096)


# ---- joints ------------------------------------------------------------------------------------------------------


def test_an_end_that_is_the_world(world: World) -> None:
    far = 1e7
    ball = world.create_body(position=(far + 1, 0, 0))
    ball.add_sphere(0.25)
    joint = world.create_ball_joint(None, ball, (far, 0, 0))
    assert joint.bodies == (None, ball) and joint.definition.world_origin.x == pytest.approx(far, abs=10)
    # a pendulum of l = 1 m that falls from the horizontal: a quarter of its period is 1.854 sqrt(l / g) = 0.592 s
    run(world, 0.6)
    assert math.dist(ball.position, (far, 0, 0)) == pytest.approx(1, abs=1e-3) and ball.position.y < -0.99
    with pytest.raises(InvalidArgumentError):
        world.create_fixed_joint(None, None, (0, 0, 0))
    joint.destroy()
    fixed = world.create_fixed_joint(ball, None, ball.position, break_force=1)
    world.step(STEP)
    (event,) = world.joint_events
    assert event.joint == fixed and (event.body_a, event.body_b) == (ball, None)


def test_motors_and_targets_change_alone(world: World) -> None:
    world.gravity = (0, 0, 0)
    a, b = world.create_body("static"), world.create_body()
    b.add_box(0.25, 0.25, 0.25)
    hinge = world.create_hinge_joint(a, b, (0, 0, 0), (0, 0, 1), motor_max=1e6)
    hinge.set_motor_speed(1.5)
    assert hinge.definition.motor_speed == 1.5 and hinge.definition.motor_max == 1e6
    run(world, 0.5)
    assert hinge.state.angular_velocity.x == pytest.approx(1.5, rel=1e-3)
    hinge.set(motor_max=0, spring_hertz=2)
    hinge.set_target(0.25)
    run(world, 3)
    assert hinge.angle == pytest.approx(0.25, abs=1e-3)
    hinge.destroy()
    slider = world.create_slider_joint(a, b, b.position, (1, 0, 0), linear_x={"motion": "free", "motor_max": 1e6})
    slider.set_motor_speed(-2, "linear_x")
    assert slider.definition.linear_x.motor_speed == -2
    with pytest.raises(InvalidArgumentError, match="dof: one of linear_x"):
        slider.set_motor_speed(1)
    slider.destroy()
    ball = world.create_ball_joint(a, b, (0, 0, 0), spring_hertz=2)
    ball.set_target((0, 0, 1, 1))
    assert ball.definition.target == (0, 0, 1, 1)
    ball.set_motor_speed(2, "angular_z")
    assert ball.definition.motor_velocity == (0, 0, 2)
    ball.destroy()
    fixed = world.create_fixed_joint(a, b, (0, 0, 0))
    for change in (fixed.set_motor_speed, fixed.set_target):
        with pytest.raises(StateError):
            change(1, "angular_x")


# ---- settings ----------------------------------------------------------------------------------------------------


def test_hertz_that_a_step_uses(world: World) -> None:
    world.tuning = world.tuning._replace(contact_hertz=1000, joint_hertz=1000)
    assert world.hertz(0) == (1000, 1000)
    assert world.hertz(STEP) == pytest.approx((480 / 8, 480 * 0.225), rel=1e-5)  # of a substep rate of 480 Hz


def test_nobody_sleeps_where_sleep_is_off(world: World, ground: Body) -> None:
    world.tuning = world.tuning._replace(sleep_enabled=False)
    ball = world.create_body(position=(0, 0.5, 0))
    ball.add_sphere(0.5)
    run(world, 2)
    assert ball.awake
    world.tuning = world.tuning._replace(sleep_enabled=True)
    run(world, 2)
    assert not ball.awake


def test_options_that_there_are_none_of(world: World, ball: Body) -> None:
    for use in (
        lambda: setattr(world, "gravty", (0, 0, 0)),
        lambda: setattr(ball, "positon", (0, 0, 0)),
        lambda: setattr(world.store, "number", 5),
    ):
        with pytest.raises(AttributeError):
            use()
    for use in (
        lambda: setattr(world, "tuning", (30,)),
        lambda: setattr(ball, "locks", "xz"),
        lambda: world.create_body(locks="xz"),
        lambda: world.create_hinge_joint(None, ball, (0, 0, 0), (0, 0, 1), min_angle=1),
        lambda: world.create_slider_joint(None, ball, (0, 0, 0), (0, 0, 1), linear_x={"low": 1}),
        lambda: ball.add(Box(1, 1, 1), frictoin=1),  # type: ignore[call-arg]
    ):
        with pytest.raises(TypeError):
            use()
    assert isinstance(ball.shapes[0].frame.position, Vec3) and Plane() == ((0, 1, 0), 0)
