"""Clones of worlds, and states in memory."""

import gc
import os
import pickle
from pathlib import Path
from typing import Any

import pytest

from feather_physics import FilterPair, StaleHandleError, State, StateError, SteppingError, Store, World


def build(world: World) -> None:
    world.create_body("static").add_plane()
    for i in range(5):
        world.create_body(position=(0.1 * i, 0.5 + 1.1 * i, 0)).add_box(0.5, 0.5, 0.5)


def run(world: World, steps: int) -> int:
    for _ in range(steps):
        world.step()
    return world.hash


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_a_clone_goes_on_as_the_world_does(world: World) -> None:
    build(world)
    run(world, 20)
    with world.clone() as twin, world.clone(workers=2, simd="plain") as other:
        assert twin.hash == other.hash == world.hash
        assert [b.id for b in twin.bodies] == [b.id for b in world.bodies]
        expected = run(world, 40)
        assert run(twin, 40) == run(other, 40) == expected
        twin.bodies[-1].add_impulse((5, 0, 0))
        assert run(twin, 1) != run(world, 1)


def test_a_clone_has_the_user_data_and_the_filter(world: World) -> None:
    build(world)
    ball = world.create_body(position=(9, 0.4, 0))
    shape = ball.add_sphere(0.5, pair_filter=True)
    ball.user_data, shape.user_data = ["mine"], "its shape"
    asked = []

    def judge(pair: FilterPair) -> bool:
        asked.append(pair)
        return False

    world.set_pair_filter(judge)
    twin = world.clone()
    there = twin.bodies[-1]
    assert there.id == ball.id and there.user_data is ball.user_data
    there.user_data = "another"
    assert ball.user_data == ["mine"]
    world.close()
    run(twin, 3)
    assert asked and there.position.y < 0.4  # it falls through the ground
    twin.close()


def test_a_clone_outlives_the_world_and_its_store(world: World) -> None:
    build(world)
    hull = world.create_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    world.create_body(position=(0, 9, 0)).add(hull)
    twin = world.clone()
    expected = run(world, 30)
    world.close()
    gc.collect()
    assert run(twin, 30) == expected
    assert len(twin.create_hull([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]).vertices) == 4
    twin.close()


def test_a_state_is_gone_back_to(world: World) -> None:
    build(world)
    run(world, 10)
    state = world.state()
    first = world.hash
    expected = run(world, 30)
    late = world.create_body()
    late.user_data = 3
    world.set_state(state)
    assert world.hash == first and not late.is_valid
    assert run(world, 30) == expected
    with world.clone() as twin:
        twin.set_state(state)
        assert twin.hash == first and run(twin, 30) == expected
    state.close()
    with pytest.raises(StaleHandleError, match="the state is closed"):
        world.set_state(state)
    with pytest.raises(StaleHandleError):
        state.close()


def test_states_of_a_shared_store(world: World) -> None:
    store = Store()
    with World(store=store) as a, World(store=store) as b:
        build(a)
        state = a.state()
        b.set_state(state)
        assert run(a, 20) == run(b, 20)
        with pytest.raises(StateError, match="another store"):
            world.set_state(state)
    del a, b, store
    gc.collect()
    with pytest.raises(StateError, match="another store"):
        world.set_state(state)


def test_what_is_no_state_is_refused(world: World) -> None:
    for wrong in (None, b"state", world, 3):
        with pytest.raises(TypeError, match="State"):
            world.set_state(wrong)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="pickle"):
        pickle.dumps(world.state())
    world.close()
    with pytest.raises(StaleHandleError):
        world.clone()
    with pytest.raises(StaleHandleError):
        world.state()


def test_a_filter_may_not_set_a_state(world: World) -> None:
    build(world)
    world.create_body(position=(9, 0.4, 0)).add_sphere(0.5, pair_filter=True)
    state = world.state()
    caught: Any = []

    def judge(pair: FilterPair) -> bool:
        try:
            world.set_state(state)
        except Exception as error:
            caught.append(error)
        return True

    world.set_pair_filter(judge)
    world.step()
    assert caught and all(isinstance(error, SteppingError) for error in caught)


def test_thousands_of_states_leave_nothing_behind(world: World) -> None:
    build(world)
    run(world, 5)
    size = len(world.save())

    def make(times: int) -> None:
        for _ in range(times):
            state: State = world.state()
            world.set_state(state)
            world.clone()  # closed when nobody has it

    make(200)
    before = resident_bytes()
    make(2000)
    assert resident_bytes() - before < 2000 * size / 4  # each of them holds what a snapshot does
