"""Batches of worlds: equal to a loop, with arrays that NumPy shares."""

import copy
import gc
from typing import Any, List

import numpy as np
import pytest

from feather_physics import (
    Body,
    FeatherError,
    InvalidArgumentError,
    Joint,
    Pool,
    StaleHandleError,
    StateError,
    Store,
    UnsupportedError,
    World,
    Worlds,
    WorldsError,
    _flat,
)

COUNT = 9


def build(world: World) -> List[Body]:
    world.create_body("static").add_plane()
    bodies = [world.create_body(position=(0.1 * i, 0.5 + 1.1 * i, 0)) for i in range(4)]
    for body in bodies:
        body.add_box(0.5, 0.5, 0.5)
    return bodies


def hinge(world: World) -> Joint:
    arm = world.create_body(position=(10, 3, 0))
    arm.add_box(0.5, 0.1, 0.1)
    return world.create_hinge_joint(None, arm, (9.5, 3, 0), (0, 0, 1), motor_max=1000.0, spring_hertz=2.0)


@pytest.mark.parametrize("workers, block, simd", [(1, 0, "auto"), (2, 1, "plain"), (3, 4, "auto")])
def test_a_batch_is_a_loop(world: World, workers: int, block: int, simd: str) -> None:
    bodies = build(world)
    alone = [world.clone() for _ in range(COUNT)]
    rng = np.random.default_rng(1)
    with Worlds(world, COUNT, workers=workers, block=block, simd=simd) as worlds:
        assert len(worlds) == COUNT and list(worlds.hashes()) == [world.hash] * COUNT
        forces = np.asarray(worlds.input("force", bodies))
        poses = np.asarray(worlds.output("transform", bodies))
        assert forces.shape == (COUNT, 4, 6) and poses.shape == (COUNT, 4, 7)
        for step in range(10):
            forces[:] = rng.uniform(-900, 900, forces.shape)
            mask = rng.integers(0, 2, COUNT).astype(np.uint8)
            worlds.step(steps=1 + step % 2, mask=mask)
            for i in np.flatnonzero(mask):
                for _ in range(1 + step % 2):
                    alone[i].add_forces([alone[i].bodies[k + 1] for k in range(4)], forces[i])
                    alone[i].step()
                assert (np.asarray(alone[i].transforms())[1:] == poses[i]).all()
            assert list(worlds.hashes()) == [one.hash for one in alone]
        worlds.reset(mask)
        assert [h == world.hash for h in worlds.hashes()] == [bool(m) for m in mask]


def test_arrays_are_shared_and_outlive_the_batch(world: World) -> None:
    bodies = build(world)
    mine = np.zeros((COUNT, 1, 7), np.float64)
    worlds = Worlds(world, COUNT)
    assert worlds.output("transform", bodies[:1], mine) is mine
    view = worlds.output("velocity", bodies[3:])
    shared = np.asarray(view)
    worlds.step()
    assert (mine[:, 0, 6] != 0).all() and shared[0, 0, 1] < 0
    assert np.shares_memory(shared, np.asarray(view))
    assert np.from_dlpack(shared).__array_interface__["data"][0] == shared.__array_interface__["data"][0]
    buffer = bytearray(4 * COUNT)
    worlds.output("awake", bodies[:1], memoryview(buffer).cast("f", (COUNT, 1, 1)))
    with pytest.raises(BufferError):
        buffer.append(0)  # it is bound, and stays where it is
    worlds.unbind()
    worlds.step()
    before = mine.copy()
    worlds.close()
    gc.collect()
    assert (mine == before).all() and shared[0, 0, 1] < 0
    buffer.append(0)
    with pytest.raises(StaleHandleError):
        worlds.step()
    with pytest.raises(StaleHandleError):
        worlds.close()


def test_bound_arrays_are_held_whoever_bound_them(world: World) -> None:
    bodies = build(world)
    worlds = Worlds(world, COUNT)
    data = bytearray(4 * COUNT * len(bodies) * 7)
    transforms = worlds._array("transform", bodies, memoryview(data).cast("f"), None, (0.0, 0.0, 0.0))
    _flat.batch_bind(worlds._capsule, [], [transforms])
    del transforms
    with pytest.raises(BufferError):
        data.clear()
    worlds.step()
    assert any(data)
    worlds.unbind()
    data.clear()
    other = copy.copy(worlds)  # the same batch
    bound = other.output("transform", bodies).obj
    del other
    gc.collect()
    with pytest.raises(BufferError):
        bound.clear()
    worlds.close()
    bound.clear()


def test_fields_are_read_and_written(world: World) -> None:
    bodies, joint = build(world), hinge(world)
    with Worlds(world, COUNT) as worlds:
        speeds = np.arange(COUNT, dtype=np.float32).reshape(COUNT, 1, 1)
        worlds.write("joint_speed", [joint], speeds)
        worlds.write("joint_target", [joint], 0.1 * speeds)
        gravity = np.zeros((COUNT, 1, 3))
        gravity[:, 0, 1] = -np.arange(COUNT)
        worlds.write("gravity", None, gravity)
        worlds.step(steps=5)
        found = np.asarray(worlds.read("joint", [joint]))
        assert (np.diff(found[:, 0, 1]) > 0).all()  # the faster the motor, the faster the arm
        assert (np.asarray(worlds.read("gravity"))[:, 0] == gravity[:, 0].astype(np.float32)).all()
        assert np.asarray(worlds.read("reaction", [joint])).shape == (COUNT, 1, 6)
        assert (np.asarray(worlds.read("awake", bodies)) == 1).all()
        near = np.asarray(worlds.read("transform", bodies[:2], relative_to=bodies[0]))
        assert np.allclose(near[:, 0, :3], 0, atol=1e-6) and np.allclose(near[:, 0, 6], 1)
        flat = worlds.read("awake", bodies, np.zeros(4 * COUNT, np.float32))
        assert (flat == 1).all()
        far = np.asarray(worlds.read("transform", bodies[:1], np.zeros((COUNT, 1, 7)), origin=(100, 0, 0)))
        assert (far[:, 0, 0] < -90).all()


def test_a_world_of_the_batch_takes_all_other_calls(world: World) -> None:
    bodies = build(world)
    bodies[0].user_data = "first"
    with Worlds(world, COUNT) as worlds:
        one = worlds[2]
        assert one is worlds[2] and one is worlds[2 - COUNT] and len(list(worlds)) == COUNT
        mine = next(body for body in one.bodies if body.id == bodies[0].id)
        assert mine.user_data == "first" and mine.position == bodies[0].position and mine != bodies[0]
        x, y, z = mine.position
        mine.position = (x, y + 50, z)
        assert one.raycast((x, y + 60, z), (0, -20, 0)).body == mine  # type: ignore[union-attr]
        assert worlds[1].raycast((x, y + 60, z), (0, -20, 0)) is None
        alone = one.clone()
        worlds.step(steps=5)
        for _ in range(5):
            alone.step()
        assert one.hash == alone.hash == worlds.hashes()[2] != worlds.hashes()[1]
        one.step()  # on its own, too
        assert one.hash != alone.hash
        one.restore(alone.save())
        assert one.hash == alone.hash
        for wrong in (COUNT, -COUNT - 1):
            with pytest.raises(IndexError):
                worlds[wrong]
        for call in (one.close, lambda: one.recorder(), lambda: one.set_pair_filter(lambda pair: True)):
            with pytest.raises(FeatherError):
                call()
        other = worlds[0]
        del other
        assert not one.closed
    assert one.closed
    with pytest.raises(StaleHandleError):
        one.step()
    with pytest.raises(StaleHandleError):
        mine.position
    worlds = Worlds(world, 2)
    kept = worlds[1]
    del worlds
    gc.collect()
    kept.step()  # it keeps the batch


def test_a_store_that_was_asked_for_ends_with_the_batch() -> None:
    world = World()
    worlds = Worlds(world, 2)
    store = worlds[0].store  # of a world that nobody has any more
    gc.collect()
    world.close()
    hull = store.create_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert not store.closed and hull.is_valid
    worlds.close()
    assert store.closed and not hull.is_valid
    with pytest.raises(StaleHandleError):
        store.create_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])


def test_capsules_of_worlds_end_with_the_batch(world: World) -> None:
    worlds = Worlds(world, 2)
    capsule = _flat.batch_get_world(worlds._capsule, 0)
    _flat.keep(capsule, None)
    _flat.world_step(capsule, 0.01)
    worlds.close()
    for call in (lambda: _flat.world_step(capsule, 0.01), lambda: _flat.world_get_store(capsule), lambda: _flat.world_destroy(capsule)):
        with pytest.raises(StaleHandleError):
            call()


def test_worlds_differ_in_mass_and_friction(world: World) -> None:
    world.create_body("static").add_plane()
    box = world.create_body(position=(0, 0.5, 0))
    shape = box.add_box(0.5, 0.5, 0.5)
    with Worlds(world, COUNT) as worlds:
        masses = 1 + np.arange(COUNT, dtype=np.float32).reshape(COUNT, 1, 1)
        worlds.write("mass", [box], masses)
        worlds.write("friction", [shape], np.tile(np.float32(0.1) * masses, (1, 1, 2)))
        assert (np.asarray(worlds.read("mass", [box])) == masses).all()
        felt = worlds.output("contact_force", [box])
        worlds.step(steps=120)
        assert np.allclose(np.asarray(felt)[:, 0, 1], 9.81 * masses[:, 0, 0], rtol=1e-2)
        assert np.asarray(worlds.read("friction", [shape])).shape == (COUNT, 1, 2)
        with pytest.raises(TypeError, match="Shape"):
            worlds.read("friction", [box])


def test_worlds_that_fail_are_told_and_the_others_go_on(world: World) -> None:
    bodies = build(world)
    with Worlds(world, COUNT) as worlds:
        before = worlds.hashes()
        forces = np.asarray(worlds.input("force", bodies))
        forces[3, 2, 1] = np.nan
        with pytest.raises(WorldsError, match=r"1 of 9 worlds failed: .*world 3, array 0, item 2"):
            worlds.step()
        assert list(worlds.results) == [0, 0, 0, -1, 0, 0, 0, 0, 0]
        assert [a == b for a, b in zip(worlds.hashes(), before)] == [i == 3 for i in range(COUNT)]


def test_states_of_clones_are_gone_back_to(world: World) -> None:
    build(world)
    with world.clone() as other, Worlds(world, COUNT, workers=2) as worlds:
        for _ in range(10):
            other.step()
        state = other.state()
        worlds.step(steps=3)
        worlds.reset(states=[state if i % 2 else None for i in range(COUNT)])
        assert list(worlds.hashes()) == [other.hash if i % 2 else world.hash for i in range(COUNT)]
        with pytest.raises(ValueError, match="states"):
            worlds.reset(states=[state])
        with World() as foreign:
            with pytest.raises(StateError, match="another store"):
                worlds.reset(states=[foreign.state()] * COUNT)
        state.close()
        with pytest.raises(StaleHandleError):
            worlds.reset(states=[state] * COUNT)


def test_a_pool_and_a_store_live_as_long_as_the_batch() -> None:
    pool, store = Pool(2), Store()
    world = World(store=store)
    bodies = build(world)
    worlds = Worlds(world, COUNT, pool=pool)
    world.close()
    del pool, store, world
    gc.collect()
    worlds.step(steps=3)
    assert len(set(worlds.hashes())) == 1
    assert (np.asarray(worlds.read("transform", bodies))[:, 3, 1] > 3).all()  # they name those of each world
    del worlds
    gc.collect()


def test_wrong_arguments_are_named(world: World) -> None:
    bodies, joint = build(world), hinge(world)
    for count in (0, -1, 1 << 21):
        with pytest.raises(InvalidArgumentError):
            Worlds(world, count)
    with Worlds(world, COUNT) as worlds:
        wrong: Any
        for field, items, out, error in (
            ("pose", bodies, None, InvalidArgumentError),
            ("transform", None, None, InvalidArgumentError),
            ("gravity", bodies, None, InvalidArgumentError),
            ("transform", [joint], None, TypeError),
            ("transform", bodies, np.zeros((COUNT, 4, 6), np.float32), InvalidArgumentError),
            ("transform", bodies, np.zeros((COUNT, 7, 4), np.float32), InvalidArgumentError),
            ("transform", bodies, [1.0, 2.0], TypeError),
            ("transform", bodies, np.zeros((COUNT, 4, 7), np.int32), TypeError),
            ("transform", bodies, np.asfortranarray(np.zeros((COUNT, 4, 7), np.float32)), BufferError),
            ("force", bodies, None, InvalidArgumentError),
        ):
            with pytest.raises(error):
                worlds.output(field, items, out)  # type: ignore[arg-type]
        with pytest.raises(InvalidArgumentError):
            worlds.input("awake", bodies)
        for wrong in (np.zeros(COUNT - 1, np.uint8), np.zeros(COUNT, np.int32)):
            with pytest.raises(ValueError, match="mask"):
                worlds.step(mask=wrong)
        with pytest.raises(InvalidArgumentError):
            worlds.step(dt=float("nan"))
        with pytest.raises(InvalidArgumentError):
            worlds.step(steps=0)
        bodies[0].destroy()
        with pytest.raises(StaleHandleError):
            worlds.output("transform", [bodies[0], Body(world, 12345)])
    world.set_pair_filter(lambda pair: True)
    with pytest.raises(UnsupportedError, match="pair filter"):
        Worlds(world, 2)
