"""Bulk calls on every kind of buffer."""

from array import array
from typing import Any, Callable

import numpy as np
import pytest

from feather_physics import InvalidArgumentError, Sphere, StaleHandleError, World, records

COUNT = 50


@pytest.fixture
def many(world: World) -> World:
    world.create_bodies([(i, 2 * i, 0) for i in range(COUNT)], gravity_scale=0.0)
    return world


@pytest.mark.parametrize(
    "make",
    [
        lambda n: np.zeros((n, 7), np.float32),
        lambda n: array("f", bytes(28 * n)),
        lambda n: bytearray(28 * n),
        lambda n: memoryview(bytearray(28 * n)).cast("f", (n, 7)),
    ],
    ids=["numpy", "array", "bytearray", "memoryview"],
)
def test_transforms_fill_any_buffer(many: World, make: Callable[[int], Any]) -> None:
    out = make(COUNT)
    assert many.transforms(out, origin=(1, 0, 0)) is out
    found = np.frombuffer(memoryview(out).cast("B"), np.float32).reshape(-1, 7)
    assert (found[:, 0] == np.arange(COUNT) - 1).all() and (found[:, 1] == 2 * np.arange(COUNT)).all() and (found[:, 6] == 1).all()


def test_what_is_made_when_no_buffer_is_given(many: World) -> None:
    view = many.transforms()
    assert view.shape == (COUNT, 7) and np.asarray(view)[3, 1] == 6
    assert many.velocities(bodies=many.bodies[:2]).shape == (2, 6)
    with World() as empty:
        assert empty.transforms().tolist() == [] and empty.moved() == (array("Q"), bytearray())


def test_velocities_and_forces(many: World) -> None:
    ids = many.body_ids()
    wanted = np.tile(np.float32([1, 2, 3, 0, 0, 0]), (COUNT, 1))
    many.set_velocities(ids, wanted)
    assert (np.asarray(many.velocities(bodies=ids)) == wanted).all()
    many.add_forces(ids, np.tile(np.float32([60, 0, 0, 0, 0, 0]), (COUNT, 1)))
    many.step()
    assert np.allclose(np.asarray(many.velocities())[:, 0], 2, atol=1e-5)  # 60 N on 1 kg for 1/60 s
    moved, poses = many.moved()
    assert moved == ids and len(poses) == 40 * COUNT


def test_many_joints_are_driven_at_once(world: World) -> None:
    post = world.create_body("static")
    arms = [world.create_body(position=(1, 2 * i, 0)) for i in range(3)]
    for arm in arms:
        arm.add_box(0.5, 0.1, 0.1)
    hinges = [
        world.create_hinge_joint(post, arm, (0, 2 * i, 0), (0, 0, 1), motor_max=1e6, spring_hertz=1.0)
        for i, arm in enumerate(arms)
    ]
    ids = np.array([hinge.id for hinge in hinges], np.uint64)
    world.set_joint_motor_speeds(hinges, np.float32([1, 2, 3]))
    world.set_joint_targets(ids, array("f", [0.1, 0.2, 0.3]))
    world.add_joint_forces(ids, np.float32([1, 1, 1]))
    assert [hinge.definition.target for hinge in hinges] == pytest.approx([0.1, 0.2, 0.3])
    world.step()
    found = np.asarray(world.joint_coordinates(hinges))
    assert found.shape == (3, 2) and (found[:, 0] > 0).all() and (np.diff(found[:, 1]) > 0).all()
    out = np.zeros((3, 6), np.float32)
    assert world.joint_reactions(ids, out) is out
    force, torque = hinges[2].reaction
    assert out[2].tolist() == [*force, *torque]
    with pytest.raises(InvalidArgumentError, match=r"values\[1\]"):
        world.set_joint_targets(hinges, np.float32([0, np.nan, 0]))
    with pytest.raises(TypeError, match="values"):
        world.set_joint_targets(hinges, np.float64([0, 0, 0]))
    with pytest.raises(ValueError):
        world.set_joint_motor_speeds(hinges, np.float32([0, 0]))
    hinges[1].destroy()
    with pytest.raises(StaleHandleError):
        world.joint_coordinates(ids)


def test_exact_transforms_keep_their_doubles(many: World) -> None:
    kind = np.dtype(records.TRANSFORM.dtype)
    ids = many.body_ids()
    poses = np.zeros(COUNT, kind)
    poses["position"][:, 0] = 1e8 + np.arange(COUNT) / 1024
    poses["rotation"][:, 3] = 1
    many.set_transforms(ids, poses)
    assert (np.frombuffer(many.exact_transforms(), kind)["position"] == poses["position"]).all()
    assert many.exact_transforms(np.zeros(COUNT, kind), bodies=many.bodies)["position"][1, 0] == poses["position"][1, 0]


def test_many_rays_and_sweeps(world: World) -> None:
    world.create_body("static").add_plane()
    rays = np.array([[x, 1, 0, 0, -2, 0] for x in range(10)] + [[0, 1, 0, 0, 1, 0]], float)
    hits = np.frombuffer(world.raycast_many(rays), records.HIT.dtype)
    assert (hits["fraction"] == [0.5] * 10 + [1]).all() and hits["body"][-1] == 0
    paths = b"".join(records.PATH.pack(x, 1, 0, 0, 0, 0, 1, 0, -2, 0) for x in range(10))
    found = np.frombuffer(world.sweep_many(Sphere(0.5), paths, spread=False), records.HIT.dtype)
    assert np.allclose(found["fraction"], 0.25, atol=1e-4)


def test_events_as_records(world: World) -> None:
    world.create_body("static").add_plane()
    world.create_body(position=(0, 0.5, 0)).add_sphere(0.5)
    world.step()
    buffer = bytearray(records.PAIR_EVENT.size)
    assert world.read_events("pair") == 1 == world.read_events("pair", buffer)
    assert records.PAIR_EVENT.unpack(buffer)[4] == 1
    assert world.read_events("body") == world.read_events("hit") == world.read_events("joint") == 0
