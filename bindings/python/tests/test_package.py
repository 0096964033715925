"""The package as users have it: its types, its examples, its documents, and an installation without the build tree."""

import os
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Dict, List

import pytest
from conftest import BUILD, ROOT

EXAMPLES = sorted((ROOT / "examples/python").glob("*.py"))


def run(command: List[object], folder: Path, environment: Dict[str, str]) -> str:
    done = subprocess.run([str(part) for part in command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.skipif(not shutil.which("mypy"), reason="mypy is not installed")
def test_types_are_right(tmp_path: Path) -> None:
    environment = {**os.environ, "MYPYPATH": str(ROOT / "bindings/python")}
    checked = [ROOT / "bindings/python/feather_physics", ROOT / "bindings/python/tests/scenario.py"]
    checked += [path for path in EXAMPLES if path.name != "pile.py"]  # matplotlib has no types
    run(["mypy", "--strict", "--cache-dir", tmp_path, "--python-executable", sys.executable, *checked], ROOT, environment)
    right = tmp_path / "right.py"
    right.write_text(
        "import feather_physics as f\nw = f.World()\nw.gravity = (0, 0, 0)\nb = w.create_body()\nb.position = (1, 2, 3)\n"
        "b.transform = ((0, 0, 0), (0, 0, 0, 1))\nb.linear_velocity = [1, 2, 3]\n"
        "y: float = w.gravity.y + b.position.x + b.linear_velocity.x + b.transform.position.y + b.rotation.w\n"
    )
    run(["mypy", "--strict", right], tmp_path, environment)
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import feather_physics as f\nf.World().create_body().position.colour\nf.World().raycast(5, (1, 2, 3))\n")
    done = subprocess.run(["mypy", "--strict", wrong], capture_output=True, text=True, env=environment)
    assert done.stdout.count("error:") == 2, done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(example: Path, tmp_path: Path) -> None:
    if example.stem == "sweep_dask" and find_spec("distributed") is None and os.environ.get("CI") != "true":
        pytest.skip("NOT TESTED: python3-distributed is not installed")
    assert run([sys.executable, example], tmp_path, dict(os.environ))
    if example.stem == "pile":
        assert (tmp_path / "pile.png").read_bytes().startswith(b"\x89PNG")


def test_what_the_documentation_shows_runs(tmp_path: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    assert len(blocks) >= 3
    for block in blocks:
        run([sys.executable, "-c", block], tmp_path, dict(os.environ))


def test_the_program_of_readme_prints_what_it_says(tmp_path: Path) -> None:
    run([ROOT / "tests/consumers/readme", BUILD, "python"], tmp_path, dict(os.environ))


def test_the_table_of_the_documentation_has_every_function() -> None:
    from conftest import header_functions

    text = (ROOT / "docs/python.md").read_text()
    missing = [f.name for f in header_functions() if not re.search(rf"`{f.name}`", text)]
    assert missing == []


def test_installation_of_the_documentation_runs_without_the_build_tree(tmp_path: Path) -> None:
    """A copy of the sources; the core is the one that is built already (FEATHER_ARCHIVE), all else as it is written."""
    copy = tmp_path / "feather"
    for name in ("include", "src", "bindings", "examples", "tools/picture"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info", "obj", "bin"))
    for name in ("Makefile", "setup.py", "pyproject.toml", "LICENSE"):
        shutil.copy(ROOT / name, copy / name)
    (copy / "docs").mkdir()
    shutil.copy(ROOT / "docs/python.md", copy / "docs/python.md")
    found = re.search(r"## Install.*?```sh\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    assert found
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["PATH"] = f"{Path(sys.executable).parent}:{environment['PATH']}"
    environment["FEATHER_ARCHIVE"] = str(BUILD / "libfeather.a")
    told = run(["bash", "-ec", found.group(1)], copy, environment)
    assert "1.50 s  y = 0.4999 m" in told
    # the source tree gone, the package still works
    (tmp_path / "elsewhere").mkdir()
    shutil.move(str(copy / "env"), str(tmp_path / "env"))
    shutil.copy(copy / "examples/python/hello.py", tmp_path / "elsewhere/hello.py")
    shutil.rmtree(copy)
    library = next((tmp_path / "env").glob("lib/python*/site-packages"))
    environment["PYTHONPATH"] = str(library)
    assert "1.50 s" in run([sys.executable, "hello.py"], tmp_path / "elsewhere", environment)
