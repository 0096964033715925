"""What the module allocates it frees, and it reads nothing that nobody wrote: valgrind's word."""

import os
import shutil
import subprocess
import sys
from typing import List

import pytest
from conftest import ROOT

FOREIGN = ("SWIG_Python_DestroyModule",)  # 24 bytes of SWIG's own, once, when the interpreter ends


def reports(text: str) -> List[str]:
    """Valgrind's paragraphs."""
    lines = [line.partition("== ")[2] for line in text.splitlines() if line.startswith("==")]
    return "\n".join(lines).split("\n\n")


@pytest.mark.skipif(not shutil.which("valgrind"), reason="valgrind is not installed")
def test_native_side_is_clean() -> None:
    # FEATHER_QUICK: without the physics, which take minutes there: every call that may fail, and what it says
    names = ("test_errors.py",) if os.environ.get("FEATHER_QUICK") else ("test_errors.py", "test_physics.py")
    tests = [str(ROOT / "bindings/python/tests" / name) for name in names]
    command = ["valgrind", "--error-exitcode=9", "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=none"]
    environment = {**os.environ, "PYTHONMALLOC": "malloc", "PYTHONDONTWRITEBYTECODE": "1", "FE_SIMD": "avx2"}  # it knows no AVX-512
    # valgrind runs one thread at a time, and not in turns: the threads of one test may never meet
    pytest_options = ["-q", "-p", "no:cacheprovider", "-k", "not other_threads_run"]
    done = subprocess.run([*command, sys.executable, "-m", "pytest", *pytest_options, *tests], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    ours = [report for report in reports(done.stderr) if "definitely lost in" in report and "_flat" in report and not any(f in report for f in FOREIGN)]
    assert ours == []
    assert "LEAK SUMMARY" in done.stderr
