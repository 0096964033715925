"""What the tests of the Python package share."""

import json
import os
import re
import subprocess
from pathlib import Path
from typing import Any, Callable, Iterator, List, NamedTuple

import pytest

from feather_physics import Body, World

ROOT = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get("FEATHER_BUILD", ROOT / "build"))

# what MuJoCo must be told of URDF: no link is merged with another one, moments that no body has are balanced
FOR_REFEREE = '<mujoco><compiler fusestatic="false" discardvisual="true" strippath="false" balanceinertia="true"/></mujoco>'


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
        parameters = (
            []
            if arguments.strip() == "void"
            else [
                Parameter(*re.match(r"\s*(.*?)(\w+)\s*$", part, re.S).groups())  # type: ignore[union-attr]
                for part in arguments.split(",")
            ]
        )
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


@pytest.fixture(scope="session")
def referee(tmp_path_factory: Any) -> Callable[..., Any]:
    folder = tmp_path_factory.mktemp("referee")
    program = folder / "referee"
    made = subprocess.run(
        [os.environ.get("CC", "cc"), "-w", ROOT / "tests/robots/referee.c", "-lmujoco", "-lm", "-o", program],
        capture_output=True,
    )
    if made.returncode != 0:
        if os.environ.get("CI") == "true":
            pytest.fail(f"libmujoco is missing (tools/deps.sh python): {made.stderr.decode()}")
        pytest.skip("NOT TESTED beside MuJoCo: libmujoco-dev is not installed")

    def ask(models: List[Any], *seconds: str) -> Any:
        """Of texts, or of files."""
        paths = []
        for i, model in enumerate(models):
            paths.append(model if isinstance(model, Path) else folder / f"{i}.xml")
            if not isinstance(model, Path):
                paths[-1].write_text(model.replace("</robot>", FOR_REFEREE + "</robot>"))
        done = subprocess.run([program, *seconds, *paths], capture_output=True, text=True, cwd=folder)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return ask
