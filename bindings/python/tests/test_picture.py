"""Pictures of worlds, looked at with matplotlib's reader of PNG."""

import io
import json
import re
import subprocess
import sys
from base64 import b64decode
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from feather_physics import InvalidArgumentError, StaleHandleError, World


def pixels(png: bytes) -> "np.ndarray[Any, Any]":
    """Rows of red, green, blue, 0..1."""
    image = pytest.importorskip("matplotlib.image")
    return np.asarray(image.imread(io.BytesIO(png), format="png"))[..., :3]


def orange(rgb: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]":
    """Where awake bodies are seen: more red than blue by far."""
    return rgb[..., 0] > rgb[..., 2] + 0.2


def build(world: World) -> None:
    world.create_body("static").add_plane()
    for i in range(12):
        world.create_body(position=(3.0 * i, 0.5, 0)).add_box(0.5, 0.5, 0.5)


def test_all_that_moves_is_in_the_picture(world: World) -> None:
    build(world)
    seen = orange(pixels(world.picture(320, 180)))
    assert seen.shape == (180, 320)
    assert 0.01 < seen.mean() < 0.5
    edges = np.concatenate([seen[0], seen[-1], seen[:, 0], seen[:, -1]])
    assert not edges.any()


def test_what_fell_far_off_is_left_out(world: World) -> None:
    build(world)
    before = orange(pixels(world.picture(320, 180))).mean()
    world.create_body(position=(0, -90000, 0)).add_box(0.5, 0.5, 0.5)
    assert orange(pixels(world.picture(320, 180))).mean() > 0.5 * before


def test_an_eye_and_a_target(world: World) -> None:
    build(world)
    near = orange(pixels(world.picture(64, 64, eye=(0, 1, 4), target=(0, 0.5, 0))))
    assert near[32, 32] and not near[0, 0]
    away = orange(pixels(world.picture(64, 64, eye=(0, 1, 4), target=(0, 1, 20))))
    assert not away.any()


def test_the_same_world_gives_the_same_bytes(world: World) -> None:
    build(world)
    first = world.picture(100, 60)
    with World(workers=2) as other:
        build(other)
        assert other.picture(100, 60) == first
    assert world.picture(100, 60, direction=(1, 1, 0)) != first


def test_lines_are_seen_too(world: World) -> None:
    build(world)
    for _ in range(3):
        world.step(1 / 60)
    assert world.picture(parts=("shapes", "contacts")) != world.picture()


def test_empty_worlds_have_pictures(world: World) -> None:
    assert pixels(world.picture(16, 16)).shape == (16, 16, 3)
    world.create_body("static").add_plane()
    world.create_body()
    assert pixels(world.picture(16, 16)).shape == (16, 16, 3)


def test_what_is_wrong_is_refused(world: World) -> None:
    for width, height in ((15, 100), (100, 4097), (-1, 100)):
        with pytest.raises(InvalidArgumentError, match="pixels"):
            world.picture(width, height)
    with pytest.raises(InvalidArgumentError, match="both"):
        world.picture(eye=(1, 2, 3))
    with pytest.raises(InvalidArgumentError, match="above"):
        world.picture(eye=(1, 2, 3), target=(1, 0, 3))
    with pytest.raises(InvalidArgumentError, match="direction"):
        world.picture(direction=(0, 0, 0))
    with pytest.raises(InvalidArgumentError, match="finite"):
        world.picture(direction=(float("nan"), 0, 1))
    with pytest.raises(InvalidArgumentError, match="parts"):
        world.picture(parts=("shape",))
    with pytest.raises(TypeError):
        world.picture("100")  # type: ignore[arg-type]
    world.close()
    with pytest.raises(StaleHandleError):
        world.picture()


def test_a_notebook_shows_the_picture(world: World) -> None:
    build(world)
    html = world._repr_html_()
    assert html.startswith("<img ") and "World of 13 bodies" in html
    assert b64decode(html.split("base64,")[1].split('"')[0]) == world.picture()
    world.close()
    assert world._repr_html_() == "World, closed"


def test_a_cell_of_a_notebook_shows_the_picture(tmp_path: Path) -> None:
    """As Jupyter runs it: the last value of a cell is shown."""
    for module, package in (("nbformat", "python3-nbformat"), ("nbconvert", "jupyter-nbconvert"), ("ipykernel", "python3-ipykernel")):
        if find_spec(module) is None:
            pytest.skip(f"a notebook needs {package}")
    code = "from feather_physics import World\nworld = World()\nworld.create_body().add_sphere(1)\nworld"
    cell = {"cell_type": "code", "id": "a", "execution_count": None, "metadata": {}, "outputs": [], "source": code}
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python"}}
    (tmp_path / "ball.ipynb").write_text(json.dumps({"cells": [cell], "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}))
    command = [sys.executable, "-m", "nbconvert", "--execute", "--to", "html", "ball.ipynb"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=120)
    page = (tmp_path / "ball.html").read_text()
    assert re.search('<img alt="World of 1 bodies"[^>]* src="data:image/png;base64,', page)
