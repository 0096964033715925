"""Drawing into buffers of NumPy and others."""

from typing import Any

import numpy as np
import pytest

from feather_physics import InvalidArgumentError, StaleHandleError, World, records

VERTEX = np.dtype(records.DRAW_VERTEX.dtype)
INSTANCE = np.dtype(records.DRAW_INSTANCE.dtype)


def vertices(data: bytearray) -> "np.ndarray[Any, Any]":
    return np.frombuffer(data, VERTEX)


def positions(data: bytearray) -> "np.ndarray[Any, Any]":
    """x, y, z of each: a view, as a renderer would take it."""
    return np.frombuffer(data, np.float32).reshape(-1, 6)[:, :3]


def test_records_are_those_of_the_header() -> None:
    assert records.DRAW_VERTEX.size == 24 and records.DRAW_INSTANCE.size == 88


def test_a_box_as_triangles_lines_and_instance(world: World) -> None:
    box = world.create_body(position=(10, 2, 0))
    shape = box.add_box(0.5, 1, 1.5)
    triangles = vertices(world.draw_triangles())
    assert len(triangles) == 36 and (triangles["owner"] == shape.id).all()
    p = positions(world.draw_triangles()).reshape(-1, 3, 3).astype(float)
    volume = np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2])).sum() / 6
    assert volume == pytest.approx(6, rel=1e-5)
    lines = positions(world.draw_lines(parts="shapes", origin=(10, 0, 0)))
    assert len(lines) == 24 and abs(lines[:, 0]).max() == 0.5
    (instance,) = np.frombuffer(world.draw_instances(), INSTANCE)
    assert instance["body"] == box.id and instance["half_extents"].tolist() == [0.5, 1, 1.5] and instance["part"] == -1


def test_drawing_into_an_array(world: World) -> None:
    world.create_body().add_box(1, 1, 1)
    assert world.draw_into("lines", None) == 24
    out = np.zeros(30, VERTEX)
    assert world.draw_into("lines", out) == 24
    assert out[:24].tobytes() == bytes(world.draw_lines()) and not out[24:].tobytes().strip(b"\0")
    short = np.zeros(3, VERTEX)
    assert world.draw_into("lines", short) == 24 and (short == out[:3]).all()
    assert world.draw_into("instances", np.zeros(1, INSTANCE)) == 1


def test_points_of_contacts(world: World) -> None:
    world.create_body("static").add_plane()
    ball = world.create_body(position=(3, 0.5, 0))
    ball.add_sphere(0.5)
    for _ in range(10):
        world.step(1 / 60)
    (point,) = positions(world.draw_points(parts=("contacts",), only=ball))
    assert point.tolist() == pytest.approx([3, 0, 0], abs=0.01)
    assert len(world.draw_points(parts=("contacts",), lower=(4, -1, -1), upper=(5, 1, 1))) == 0


def test_what_is_wrong_is_refused(world: World) -> None:
    body = world.create_body()
    with pytest.raises(InvalidArgumentError, match="parts"):
        world.draw_lines(parts=("shape",))
    with pytest.raises(InvalidArgumentError, match="kind"):
        world.draw_into("line", None)
    with pytest.raises(InvalidArgumentError, match="segments"):
        world.draw_lines(segments=1)
    with pytest.raises(InvalidArgumentError):
        world.draw_lines(scale=float("nan"))
    with pytest.raises(TypeError):
        world.draw_lines(colour=3)
    with pytest.raises(ValueError):
        world.draw_into("lines", bytearray(23))
    body.destroy()
    with pytest.raises(StaleHandleError):
        world.draw_lines(only=body)
