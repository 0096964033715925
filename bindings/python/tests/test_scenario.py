"""The scene that every language plays ends in the same hash and the same numbers of events as in C."""

import os
import subprocess
import sys

import pytest
from conftest import BUILD, ROOT


@pytest.mark.parametrize("workers", ["1", "3"])
def test_python_plays_the_scenario_as_c_does(workers: str) -> None:
    subprocess.run([os.environ.get("MAKE", "make"), "-s", f"BUILD={BUILD}", str(BUILD / "feather-scenario")], cwd=ROOT, check=True)
    wanted = subprocess.run([BUILD / "feather-scenario", "1"], capture_output=True, text=True, check=True).stdout
    script = ROOT / "bindings/python/tests/scenario.py"
    told = subprocess.run([sys.executable, script, workers], capture_output=True, text=True, check=True).stdout
    assert told == wanted and told.startswith("hash ")
