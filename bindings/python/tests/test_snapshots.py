"""Worlds as bytes: saved, restored, loaded, copied."""

import copy
import pickle
import random
from typing import Optional

import pytest

from feather_physics import (
    Box,
    DataError,
    InvalidArgumentError,
    LimitError,
    Part,
    Sphere,
    StaleHandleError,
    StateError,
    Store,
    World,
    compare_snapshots,
    snapshot_assets,
    snapshot_info,
)

DT = 1 / 60


def pile(store: Optional[Store] = None) -> World:
    world = World(store=store)
    ground = world.create_body("static")
    ground.add(world.create_heightfield([[0.2 * ((9 * i + 7 * k) % 3) for k in range(9)] for i in range(9)]))
    for i in range(20):
        body = world.create_body(position=(2 + 0.3 * (i % 5), 2 + 0.7 * i, 4 - 0.2 * (i % 3)))
        if i % 3 == 0:
            body.add_box(0.3, 0.2, 0.4)
        elif i % 3 == 1:
            body.add_sphere(0.3)
        else:
            body.add_capsule(0.2, 0.3)
    return world


def play(world: World, steps: int) -> int:
    for _ in range(steps):
        world.step(DT)
    return world.hash


def test_a_difference_goes_with_its_base() -> None:
    store = Store()
    world = pile(store)
    play(world, 40)
    base = world.save()
    play(world, 1)
    whole, diff = world.save(), world.save(base=base)
    assert len(diff) < len(whole) // 2
    play(world, 5)
    assert world.restore(diff, base=base) is True and world.save() == whole
    assert len(world.save(base=whole)) <= 64
    twin = World(store=store)
    assert twin.restore(diff, base=base) is True and twin.save() == whole
    assert twin.restore(whole, base=base) is True
    for bad in (None, whole, base[:-8], diff, b""):
        with pytest.raises(DataError):
            world.restore(diff, base=bad)
    with pytest.raises(DataError):
        world.save(base=diff)
    with pytest.raises(DataError):
        snapshot_info(diff)
    assert world.save() == whole


def test_a_restored_world_goes_on_bit_for_bit() -> None:
    world = pile()
    play(world, 40)
    saved = world.save()
    assert world.save() == saved and len(saved) > 1000
    expected = play(world, 60)
    assert world.restore(saved) is True and world.save() == saved
    assert play(world, 60) == expected
    assert world.restore(bytearray(saved)) is True and world.restore(memoryview(saved)) is True
    assert play(world, 60) == expected


def test_a_loaded_world_goes_on_bit_for_bit() -> None:
    store = Store()
    world = pile(store)
    play(world, 40)
    bare, whole = world.save(), world.save(assets=True)
    expected = play(world, 60)
    for workers in (1, 2, 3):
        assert play(World.load(bare, workers=workers, store=store), 60) == expected
        assert play(World.load(whole, workers=workers, simd="plain"), 60) == expected
    with pytest.raises(StateError, match="asset"):
        World.load(bare)
    numbered = World.load(whole, number=77)
    assert numbered.number == 77 and World.load(whole).number == world.number
    assert all(body._id != other._id for body, other in zip(numbered.bodies, world.bodies))


def test_what_was_made_since_is_stale_and_what_was_there_is_valid() -> None:
    world = pile()
    first = world.bodies[3]
    first.user_data = "kept"
    saved = world.save()
    late = world.create_body()
    late.user_data = "dropped"
    first.destroy()
    assert not first.is_valid and late.is_valid
    world.restore(saved)
    assert first.is_valid and not late.is_valid
    assert "dropped" not in world._user_data.values()


def test_copies_and_pickles() -> None:
    world = pile()
    play(world, 30)
    world.bodies[2].user_data = {"name": "box"}
    twins = [copy.deepcopy(world), pickle.loads(pickle.dumps(world))]
    expected = play(world, 30)
    for twin in twins:
        assert twin.bodies[2].user_data == {"name": "box"} and twin.bodies[2].user_data is not world.bodies[2].user_data
        assert play(twin, 30) == expected
    world.set_pair_filter(lambda pair: True)
    with pytest.raises(StateError, match="filter"):
        copy.deepcopy(world)


def test_what_a_snapshot_says_of_itself() -> None:
    world = pile()
    play(world, 7)
    info = snapshot_info(world.save(assets=True))
    assert (info.step, info.bodies, info.shapes, info.joints, info.assets, info.inside) == (7, 21, 21, 0, 1, 1)
    assert info.number == world.number and info.foreign is False and info.filter is False
    low, high = [[0.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 1.0]]
    other = World()
    field = other.create_heightfield(low)
    assert len(field.key) == 32 and field.key == World().create_heightfield(low).key
    assert field.key != other.create_heightfield(high).key
    other.create_body("static").add(field)
    assert snapshot_assets(other.save()) == [field.key] and snapshot_assets(World().save()) == []


def test_the_first_difference_is_named() -> None:
    world = pile()
    play(world, 7)
    saved = world.save()
    assert compare_snapshots(saved, world.save()) is None
    body = world.bodies[3]
    body.gravity_scale = 0.5
    found = compare_snapshots(saved, bytearray(world.save()))
    assert found is not None and (found.kind, found.field, found.element) == ("body", "gravity_scale", 0)
    assert found.handle == body.id and (found.a, found.b) == ("1", "0.5") and found.other == found.index == 0
    with pytest.raises(DataError, match="b: "):
        compare_snapshots(saved, b"")
    with pytest.raises(TypeError):
        compare_snapshots(saved, None)


def test_wrong_bytes_change_nothing() -> None:
    world = pile()
    play(world, 20)
    saved, dice = world.save(), random.Random(1)
    for wrong in (b"", b"feather", saved[:-1], saved[1:], saved + b"\0", bytes(len(saved))):
        for read in (world.restore, World.load, snapshot_info, snapshot_assets):
            with pytest.raises(DataError):
                read(wrong)
    for _ in range(200):
        wrong = bytearray(saved)
        wrong[dice.randrange(len(saved))] ^= 1 << dice.randrange(8)
        with pytest.raises((DataError, StateError)):
            world.restore(wrong)
    assert world.save() == saved
    for wrong in (None, 5, "text"):
        with pytest.raises(TypeError):
            world.restore(wrong)
    world.close()
    with pytest.raises(Exception, match="closed"):
        world.save()


def test_a_compound_is_saved_by_its_key() -> None:
    store = Store()
    world = World(store=store)
    table = store.create_compound([Part(Box(1, 0.1, 1)), {"geometry": Sphere(0.2), "position": (0, 0.3, 0)}])
    world.create_body(position=(0, 1, 0)).add(table)
    expected = World.load(world.save(), store=store)
    assert play(expected, 20) == play(world, 20)
    assert snapshot_assets(world.save()) == [table.key]
    elsewhere = World.load(world.save(assets=True))
    assert play(elsewhere, 20) == play(world, 20)


def test_a_history_goes_back_and_on() -> None:
    with pile() as world:
        history = world.history(frames=8)
        hashes = []
        for frame in range(20):
            history.keep(frame)
            hashes.append(world.hash)
            world.step(DT)
        assert list(history.frames) == list(range(12, 20))
        assert all(size > 1000 for size in history.frames.values())
        late = world.create_body(user_data="late")
        history.restore(13)
        assert not late.is_valid
        for frame in range(14, 20):
            world.step(DT)
            history.keep(frame)
            assert world.hash == hashes[frame]
        with pytest.raises(StaleHandleError):
            history.restore(11)
        with pytest.raises(InvalidArgumentError):
            history.keep(19)
        with pytest.raises(TypeError):
            history.keep("x")  # type: ignore[arg-type]
        with pytest.raises(InvalidArgumentError):
            world.history(frames=0)
        with pytest.raises(LimitError):
            world.history(bytes=10).keep(1)
        history.close()
        with pytest.raises(StaleHandleError):
            history.keep(30)
        other = world.history()
    with pytest.raises(StaleHandleError):
        other.keep(1)
