"""What the tests of the Python package share."""

import os
import re
from pathlib import Path
from typing import Iterator, List, NamedTuple

import pytest

from feather_physics import Body, World

ROOT = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get("FEATHER_BUILD", ROOT / "build"))


class Parameter(NamedTuple):
    type: str
    name: str


class Function(NamedTuple):
    name: str
    result: str
    parameters: List[Parameter]


def header_functions() -> List[Function]:
    """What feather.h exports, but for batches, whose calls are written by hand (batch.h)."""
    text = re.sub(r"//[^\n]*|^\s*#[^\n]*", "", (ROOT / "include/feather.h").read_text(), flags=re.M)
    found = []
    for result, name, arguments in re.findall(r"FE_API\s+([\w\s*]+?)\b(fe_\w+)\(([^;]*)\);", text):
        parameters = [] if arguments.strip() == "void" else [
            Parameter(*re.match(r"\s*(.*?)(\w+)\s*$", part, re.S).groups())  # type: ignore[union-attr]
            for part in arguments.split(",")
        ]
        if not re.match(r"fe_batch_|fe_array_init$", name):
            found.append(Function(name, result.strip(), parameters))
    return found


@pytest.fixture
def world() -> Iterator[World]:
    with World() as made:
        yield made


@pytest.fixture
def ground(world: World) -> Body:
    body = world.create_body("static")
    body.add_plane()
    return body


@pytest.fixture
def ball(world: World) -> Body:
    body = world.create_body(position=(0, 5, 0))
    body.add_sphere(0.5)
    return body
