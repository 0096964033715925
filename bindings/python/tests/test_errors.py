"""Whatever is done with the objects: an exception with the library's sentence, never a crash, and nothing has changed."""

import gc
import math
import os
import subprocess
import sys
import threading
import time
from array import array
from typing import Any, Callable, List, Set

import numpy as np
import pytest

from feather_physics import (
    Body,
    Box,
    BusyError,
    Closest,
    FeatherError,
    Hit,
    InvalidArgumentError,
    Overlap,
    Pool,
    Shape,
    Sphere,
    StaleHandleError,
    WrongKindError,
    World,
    _flat,
    records,
)
from feather_physics.objects import Entity


def test_everything_of_a_closed_world_is_stale() -> None:
    world = World()
    body = world.create_body()
    shape = body.add_sphere(1)
    joint = world.create_ball_joint(body, world.create_body(), (0, 0, 0))
    field = world.create_heightfield([[0, 0], [0, 0]])
    world.close()
    world.close()
    uses: List[Callable[[], Any]] = [
        lambda: body.position,
        lambda: setattr(body, "position", (0, 0, 0)),
        lambda: body.add_sphere(1),
        lambda: body.destroy(),
        lambda: shape.material,
        lambda: joint.state,
        lambda: field.destroy(),
        lambda: world.step(),
        lambda: world.bodies,
        lambda: world.pair_events,
        lambda: world.hash,
        lambda: world.transforms(),
        lambda: world.raycast((0, 0, 0), (1, 0, 0)),
    ]
    for use in uses:
        with pytest.raises(StaleHandleError, match="the (world|store) is closed"):
            use()
    assert not body.is_valid and not shape.is_valid and not joint.is_valid and not field.is_valid


def test_a_body_keeps_its_world_alive() -> None:
    body = World().create_body(position=(1, 2, 3))
    gc.collect()
    assert body.position == (1, 2, 3)
    body.world.step()


def test_a_destroyed_body_is_stale(world: World) -> None:
    body = world.create_body()
    shape = body.add_sphere(1)
    body.destroy()
    with pytest.raises(StaleHandleError, match="fe_body_get_transform: body .* was destroyed"):
        body.position
    with pytest.raises(ReferenceError):
        shape.density
    body.world.create_body(user_data="kept")
    with pytest.raises(StaleHandleError, match="fe_body_destroy"):
        body.destroy()
    assert not body.is_valid and not shape.is_valid


def test_a_shape_is_no_body(world: World, ball: Body) -> None:
    with pytest.raises(WrongKindError):
        Body(world, ball.shapes[0].id).position
    with pytest.raises(TypeError):
        world.create_fixed_joint(ball, ball.shapes[0], (0, 0, 0))  # type: ignore[arg-type]


def test_objects_of_another_world_are_refused(world: World, ball: Body) -> None:
    with World(number=world.number) as other:
        foreign = other.create_body()
        field = other.create_heightfield([[0, 0], [0, 0]])
        for use in (
            lambda: world.create_fixed_joint(ball, foreign, (0, 0, 0)),
            lambda: world.ignore_collision(ball, foreign),
            lambda: world.raycast((0, 0, 0), (1, 0, 0), exclude=[foreign]),
            lambda: world.transforms(bodies=[foreign]),
            lambda: world.destroy_bodies([foreign]),
            lambda: ball.add(field),
        ):
            with pytest.raises(InvalidArgumentError, match="another (world|store)"):
                use()
        assert foreign != ball and foreign.id == ball.id


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf, 1e300])
def test_numbers_that_are_none(world: World, ball: Body, number: float) -> None:
    before = world.hash
    for use in (
        lambda: setattr(ball, "position", (number, 0, 0)),
        lambda: setattr(ball, "mass", number),
        lambda: world.step(number),
        lambda: world.create_body(position=(0, number, 0)),
        lambda: ball.add_sphere(number),
        lambda: ball.add_force((0, 0, number)),
        lambda: world.raycast((0, number, 0), (1, 0, 0)),
        lambda: world.closest_point((0, 0, 0), number),
        lambda: setattr(world, "gravity", (number, 0, 0)),
    ):
        with pytest.raises((InvalidArgumentError, OverflowError)):
            use()
    assert world.hash == before and len(world.bodies) == 1


@pytest.mark.parametrize("value", [None, "abc", b"abcd", object(), [], [1, 2], (1, 2, "x"), {}, 5, [None] * 3, np.zeros(2)])
def test_values_of_other_types(world: World, ball: Body, value: Any) -> None:
    for use in (
        lambda: setattr(ball, "position", value),
        lambda: setattr(ball, "transform", value),
        lambda: setattr(ball, "linear_velocity", value),
        lambda: world.raycast(value, (0, 1, 0)),
        lambda: world.create_body(position=value),
        lambda: ball.add(value),
        lambda: world.create_fixed_joint(ball, ball if value is None else value, (0, 0, 0)),  # None is the world
        lambda: world.step(value),  # 5 s are too many
        lambda: setattr(ball, "type", value),
    ):
        with pytest.raises((TypeError, ValueError)):
            use()


def test_numbers_as_numpy_has_them(world: World, ball: Body) -> None:
    ball.position = np.array([1, 2, 3])  # type: ignore[assignment]
    ball.linear_velocity = np.float32([4, 5, 6])  # type: ignore[assignment]
    ball.mass = np.float32(2)  # type: ignore[assignment]
    assert ball.position == (1, 2, 3) and ball.linear_velocity == (4, 5, 6) and ball.mass == 2


def test_unknown_words_tell_the_known_ones(world: World, ball: Body) -> None:
    with pytest.raises(ValueError, match="static, kinematic, dynamic"):
        world.create_body("fluid")
    with pytest.raises(TypeError, match="colour"):
        world.create_body(colour=1)
    with pytest.raises(ValueError, match="touch, stay, hit"):
        ball.add_sphere(1, events="smell")
    with pytest.raises(ValueError):
        ball.locks = ("w", "")
    with pytest.raises(AttributeError):
        ball.centre = (0, 0, 0)  # type: ignore[assignment]


def test_flat_functions_refuse_what_is_no_world() -> None:
    for wrong in (None, 5, "world", Pool(1)._capsule, object()):
        with pytest.raises((TypeError, ValueError)):
            _flat.world_step(wrong, 0.1)
    for handle in (-1, 2**64, 1.5, None, "1"):
        with World() as world, pytest.raises((TypeError, OverflowError)):
            _flat.body_get_position(world._capsule, handle)


def test_bodies_that_are_none_of_this_world(world: World, ball: Body) -> None:
    shape, out, unmade = ball.shapes[0], array("f", bytes(28)), Body.__new__(Body)
    with World() as other:
        stranger = other.create_body()
        uses: List[Callable[[Any], Any]] = [
            lambda body: world.raycast((0, 0, 0), (0, 1, 0), exclude=[body]),
            lambda body: world.transforms(out, bodies=[body]),
            lambda body: world.set_velocities((body,), array("f", bytes(24))),
            lambda body: world.destroy_bodies([ball, body]),
            lambda body: world.create_ball_joint(ball, body, (0, 0, 0)),
        ]
        for use in uses:
            with pytest.raises(InvalidArgumentError, match=f"^<Body {stranger.id:#x}> belongs to another world$"):
                use(stranger)
            with pytest.raises(TypeError, match="^a Body is needed, not 'Shape'$"):
                use(shape)
            with pytest.raises(TypeError, match="^a Body is needed, not 'array'$"):
                use(out)
            with pytest.raises(AttributeError, match="no world"):
                use(unmade)
    with pytest.raises(TypeError, match="^a Joint is needed, not 'Body'$"):
        world.joint_coordinates([ball])
    assert ball.is_valid


@pytest.mark.parametrize("id", [-1, 2**63, 2**64, -(2**200)])
def test_integers_that_are_no_handles(world: World, ball: Body, id: int) -> None:
    for use in (lambda body: world.is_ignored(ball, body), lambda body: world.transforms(bodies=[body])):
        with pytest.raises(OverflowError):
            use(Body(world, id))


def test_a_hit_holds_its_world_and_lets_it_go(world: World, ball: Body) -> None:
    held = sys.getrefcount(world), sys.getrefcount(world._capsule), sys.getrefcount(Body), sys.getrefcount(Hit)
    for _ in range(100):
        hit = world.raycast((0, 9, 0), (0, -20, 0), exclude=[])
        assert hit and hit.body == ball and world.raycast_all((0, 9, 0), (0, -20, 0)) == [hit]
        assert world.closest_point((0, 9, 0), 99) and world.overlap_shapes(Sphere(9), (0, 0, 0)) and world.bodies
    assert sys.getrefcount(world) == held[0] + 2
    del hit
    assert held == (sys.getrefcount(world), sys.getrefcount(world._capsule), sys.getrefcount(Body), sys.getrefcount(Hit))


def test_a_list_is_seen_when_it_is_full(world: World) -> None:
    for body in world.create_bodies([(0, -2 * i, 0) for i in range(199)]):
        body.add_sphere(0.5)
    seen = 0

    def look(phase: str, information: Any) -> None:
        nonlocal seen
        for found in gc.get_objects():
            if type(found) is list and len(found) == 199:
                assert isinstance(found[198], (Body, Hit, Overlap))  # one that nobody wrote would end the process
        seen += 1

    threshold = gc.get_threshold()
    gc.callbacks.append(look)
    gc.set_threshold(50)
    try:
        kept = world.bodies, world.raycast_all((0, 9, 0), (0, -900, 0)), world.overlap_shapes(Sphere(900), (0, 0, 0))
    finally:
        gc.set_threshold(*threshold)
        gc.callbacks.remove(look)
    assert seen > 3 and [len(found) for found in kept] == [199] * 3


class Elsewhere:
    __slots__ = ("A", "_world", "_capsule", "_id")


class Half:
    __slots__ = ("A", "_world")


class Borrowed:
    __slots__ = ()
    _world, _capsule, _id = slice.start, slice.stop, slice.step


class Flags(Exception):
    __slots__ = ("_capsule", "_id")
    _world = BaseException.__suppress_context__  # a byte


@pytest.mark.parametrize("entity", [Elsewhere, Half, Borrowed, Flags, type("OfDict", (dict,), {"__slots__": ("_world", "_capsule", "_id")})])
def test_classes_that_cannot_be_made_are_refused(world: World, ball: Body, entity: type) -> None:
    with pytest.raises((TypeError, AttributeError)):
        _flat.set_classes((entity, entity, entity, Hit, Closest, Overlap))
    with pytest.raises(TypeError, match="not safe"):  # its objects have more fields than are made
        _flat.set_classes((Entity, Body, Shape, Hit, Closest, time.struct_time))
    assert world.bodies == [ball] and len(world.transforms(bodies=world.bodies)) == 1
    _flat.set_classes((Entity, Body, Shape, Hit, Closest, Overlap))


def test_the_flat_module_alone_makes_no_objects() -> None:
    script = """if True:
        import importlib.util
        spec = importlib.util.spec_from_file_location("_flat", PATH)
        flat = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(flat)
        world = flat.world_create(flat.world_def())
        body = flat.body_create(world, flat.body_def())
        flat.shape_create(world, body, flat.shape_def(), flat.geometry_sphere(0.5))
        for call in (
            lambda: flat.handle_of(1, 2, int),
            lambda: flat.handles_of(1, [2], int),
            lambda: flat.list_of(int, 1, 2, b""),
            lambda: flat.list_of(None, 1, 2, b""),
            lambda: flat.world_raycast(world, (0, 9, 0), (0, -20, 0), None, None),
        ):
            try:
                call()
            except RuntimeError as error:
                assert "set_classes() comes first" in str(error)
            else:
                raise AssertionError
    """
    done = subprocess.run([sys.executable, "-c", script.replace("PATH", repr(_flat.__file__))], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_arrays_that_do_not_fit(world: World, ball: Body) -> None:
    ids = world.body_ids()
    good = array("f", bytes(28))
    assert world.transforms(good, bodies=ids) is good
    frozen = np.zeros((1, 7), np.float32)
    frozen.flags.writeable = False
    for wrong in (array("f", bytes(24)), array("d", bytes(56)), np.zeros((1, 14), np.float32)[:, ::2], frozen, bytes(28), "x", 5, array("i", bytes(28))):
        with pytest.raises((TypeError, ValueError, BufferError)):
            world.transforms(wrong, bodies=ids)
    for wrong in (array("i", bytes(8)), array("d", bytes(8)), b"1234567", 5):
        with pytest.raises((TypeError, ValueError, BufferError)):
            world.transforms(bodies=wrong)
    with pytest.raises(ValueError):
        world.set_velocities(ids, array("f", bytes(48)))
    with pytest.raises(StaleHandleError):
        world.transforms(bodies=array("Q", [5]))
    with pytest.raises(ValueError):
        world.raycast_many(bytes(47))


def test_many_are_all_or_none(world: World, ball: Body) -> None:
    with pytest.raises(FeatherError):
        world.create_bodies([(0, 0, 0), (math.nan, 0, 0)])
    with pytest.raises(FeatherError):
        world.destroy_bodies([ball, ball])
    assert len(world.bodies) == 1
    world.destroy_bodies([ball])
    assert world.bodies == [] and world.create_bodies([]) == []


def test_other_threads_run_while_it_steps() -> None:
    with World() as world:
        world.create_body("static").add_plane()
        for body in world.create_bodies([(i % 10, 1 + i // 100, i // 10 % 10) for i in range(600)]):
            body.add_sphere(0.6)
        steps, turns, refused = 60, 0, 0
        done = threading.Event()

        def step() -> None:
            for _ in range(steps):
                world.step()
            done.set()

        thread = threading.Thread(target=step)
        thread.start()
        while not done.is_set():
            turns += 1
            try:
                world.create_body()
            except BusyError:
                refused += 1
        thread.join()
        assert turns > steps and refused > 0


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="needs both threads on one processor, where they interrupt each other anywhere")
def test_other_threads_run_but_read_no_half_of_a_step() -> None:
    def scene() -> World:
        world = World()
        world.create_body("static").add_plane()
        for body in world.create_bodies([(i % 10, 1 + i // 100, i // 10 % 10) for i in range(300)]):
            body.add_sphere(0.6)
        return world

    def run(world: World, hashes: Set[int]) -> None:
        hashes.add(world.hash)
        for _ in range(40):
            world.step()
            hashes.add(world.hash)

    whole: Set[int] = set()
    run(scene(), whole)
    processors = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(processors)})
    try:
        for _ in range(10):
            world = scene()
            thread = threading.Thread(target=run, args=(world, set()))
            thread.start()
            while thread.is_alive():
                try:
                    assert world.hash in whole
                except BusyError:
                    pass
            thread.join()
    finally:
        os.sched_setaffinity(0, processors)


def test_a_world_cannot_go_while_another_thread_reads_it() -> None:
    with World() as world:
        world.create_body("static").add_plane()
        rays = np.zeros((200000, 6))
        rays[:, 1], rays[:, 4] = 5, -10
        hits = bytearray(len(rays) * records.HIT.size)
        counted: List[Any] = []
        thread = threading.Thread(target=lambda: counted.append(world.raycast_many(rays, hits, spread=False)))
        thread.start()
        refused = 0
        while thread.is_alive():
            try:
                world.create_body()
                world.close() if refused else None
            except (BusyError, StaleHandleError):
                refused += 1
        thread.join()
        assert counted == [hits]


def test_an_argument_that_closes_the_world() -> None:
    class Closing:
        def __init__(self, world: World):
            self.world = world

        def __float__(self) -> float:
            self.world.close()
            return 1.0

    calls: List[Callable[[World, Any], Any]] = [
        lambda world, number: world.step(number),
        lambda world, number: setattr(world, "gravity", (number, 0, 0)),
        lambda world, number: world.raycast((number, 0, 0), (0, 1, 0)),
        lambda world, number: setattr(world.create_body(), "linear_velocity", (0, number, 0)),
    ]
    for call in calls:
        world = World()
        with pytest.raises(StaleHandleError):
            call(world, Closing(world))


def test_nothing_leaks() -> None:
    def use() -> None:
        world = World()
        body = world.create_body(position=(0, 1, 0), user_data=object())
        body.add(Box(1, 1, 1))
        world.create_hinge_joint(body, world.create_body("static"), (0, 0, 0), (0, 0, 1))
        field = world.create_heightfield([[0, 0], [0, 0]], materials=[(1, 1, 0, 0, 0)], cell_materials=bytes(1))
        body.world.create_body("static").add(field)
        world.step()
        for wrong in (None, (1, 2), (math.nan, 0, 0), "abc"):
            for call in (lambda: setattr(body, "transform", (wrong, wrong)), lambda: world.raycast(wrong, wrong)):
                with pytest.raises((TypeError, ValueError)):
                    call()
        assert world.pair_events and body.contacts and world.transforms() and world.raycast((0, 5, 0), (0, -9, 0))
        assert world.overlap(Sphere(2), (0, 0, 0)) and world.counters and body.mass_data and body.joints[0].definition
        world.raycast((0, 5, 0), (0, -9, 0), exclude=[body])
        world.create_bodies([(0, 0, 0)] * 3)
        if len(world.bodies) % 2:
            world.close()

    growth = []
    for _ in range(4):
        gc.collect()
        before = sys.getallocatedblocks()
        for _ in range(50):
            use()
        gc.collect()
        growth.append(sys.getallocatedblocks() - before)
    # less than a block each time; the first rounds fill caches
    assert min(growth) < 50, growth


def test_a_part_keeps_the_object_that_it_is_of() -> None:
    axis = _flat.configurable_joint_def().axis(2)
    for i in range(200):  # the memory of what was freed is given out again
        _flat.configurable_joint_def().axis(2).lower = 7.0
    assert axis.lower == 0


def test_objects_have_no_methods_that_give_away_what_they_own() -> None:
    for name in ("acquire", "disown", "own", "append", "next"):
        assert not hasattr(_flat.configurable_joint_def(), name)
