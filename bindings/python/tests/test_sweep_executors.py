"""Sweeps on Dask, joblib and MPI: results are those of a loop, also when a worker is killed."""

import os
import re
import re
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any, Iterator, List

import pytest
import sweep_tasks as tasks

from feather_physics import SweepError, UnsupportedError, sweep

ANGLES = [0.1 * i for i in range(40)]
EXAMPLE = Path(__file__).resolve().parents[3] / "examples/python/sweep_dask.py"
ENVIRONMENT = {**os.environ, "PYTHONPATH": f"{Path(tasks.__file__).parent}:{EXAMPLE.parent}:{os.environ.get('PYTHONPATH', '')}"}


def need(module: str, package: str) -> None:
    if find_spec(module) is None:
        if os.environ.get("CI") == "true":
            pytest.fail(f"{package} is not installed (tools/deps.sh python)")
        pytest.skip(f"NOT TESTED: {package} is not installed")


def processes_of(words: str) -> List[int]:
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            line = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            state = (folder / "stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if words in line and state not in "ZX":
            found.append(int(folder.name))
    return found


def end_of(processes: List[int], seconds: float = 20) -> List[int]:
    """Those of them that are still there after a while."""
    deadline = time.monotonic() + seconds
    while (left := [p for p in processes if Path(f"/proc/{p}").exists()]) and time.monotonic() < deadline:
        time.sleep(0.1)
    return left


@pytest.fixture(scope="module")
def serial() -> List[int]:
    return [tasks.drop(tasks.make_world(), angle) for angle in ANGLES]


# ---- joblib ----------------------------------------------------------------------------------------------------------
def run_script(tmp_path: Path, text: str, front: List[str]) -> str:
    script = tmp_path / "script.py"
    script.write_text("import sweep_tasks as tasks\nfrom feather_physics import sweep\n" + text)
    done = subprocess.run([*front, sys.executable, *(["-m", "mpi4py.futures"] if front else []), str(script)],
                          env=ENVIRONMENT, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_joblib_gives_what_the_loop_gives(tmp_path: Path, serial: List[int]) -> None:
    need("joblib", "python3-joblib")
    told = run_script(
        tmp_path,
        "if __name__ == '__main__':\n"
        f"    for chunk in (None, 3):\n        print(sweep(tasks.drop, {ANGLES!r}, world=tasks.make_world(), executor='joblib', chunk=chunk))\n"
        f"    found = sweep(tasks.die_once, [({str(tmp_path)!r}, x) for x in range(40)], world=tasks.make_world(), executor='joblib')\n"
        "    print(found == [tasks.drop(tasks.make_world(), x) for x in range(40)])\n",
        [],
    )
    assert told.splitlines() == [repr(serial), repr(serial), "True"] and (tmp_path / "died").exists()


# ---- MPI -------------------------------------------------------------------------------------------------------------
def test_mpi_gives_what_the_loop_gives(tmp_path: Path, serial: List[int]) -> None:
    need("mpi4py", "python3-mpi4py")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.fail("openmpi-bin is not installed (tools/deps.sh python)")
    told = run_script(
        tmp_path,
        f"if __name__ == '__main__':\n    print(sweep(tasks.drop, {ANGLES!r}, world=tasks.make_world(), executor='mpi'))\n",
        [mpiexec, "--allow-run-as-root", "--oversubscribe", "--mca", "btl", "self,vader", "-n", "3"],
    )
    assert told.splitlines() == [repr(serial)]


# ---- Dask ------------------------------------------------------------------------------------------------------------
@contextmanager
def scheduler_with_two_workers(folder: Path) -> Iterator[str]:
    """A scheduler and two workers, each a process of its own as on a cluster; its address."""
    told = open(folder / "scheduler.txt", "w+")
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    started = [subprocess.Popen(command, env=ENVIRONMENT, stdout=told, stderr=told, cwd=folder)]
    try:
        deadline = time.monotonic() + 60
        while not (found := re.search(r"Scheduler at:\s+(tcp://[\d.:]+)", (folder / "scheduler.txt").read_text())):
            assert time.monotonic() < deadline, (folder / "scheduler.txt").read_text()
            time.sleep(0.1)
        for i in range(2):
            command = [sys.executable, "-m", "distributed.cli.dask_worker", found.group(1), "--nthreads", "1", "--nworkers", "1",
                       "--no-dashboard", "--host", "127.0.0.1", "--local-directory", str(folder / f"worker-{i}")]
            started.append(subprocess.Popen(command, env=ENVIRONMENT, stdout=told, stderr=told, cwd=folder))
        yield found.group(1)
    finally:
        for process in reversed(started):
            process.terminate()
        for process in started:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
        told.close()


def example() -> Any:
    sys.path.insert(0, str(EXAMPLE.parent))
    spec = spec_from_file_location("sweep_dask", EXAMPLE)
    assert spec and spec.loader
    module = module_from_spec(spec)
    sys.modules["sweep_dask"] = module  # as the workers import it
    spec.loader.exec_module(module)
    return module


def test_the_example_runs_on_a_local_cluster(tmp_path: Path) -> None:
    need("distributed", "python3-distributed")
    done = subprocess.run([sys.executable, EXAMPLE], env=ENVIRONMENT, capture_output=True, text=True, timeout=180, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "the results are those of a loop" in done.stdout and "100 % 400/400" in done.stderr


def test_a_scheduler_whose_worker_is_killed_gives_what_the_loop_gives(tmp_path: Path) -> None:
    """400 worlds, in a client of its own, as a user's would be. The nanny of the worker that is killed starts another."""
    need("distributed", "python3-distributed")
    throws = example()
    expected = sweep(throws.throw, throws.THROWS, world=throws.wall())
    script = tmp_path / "client.py"
    script.write_text(
        "import os, signal, sys\nfrom sweep_dask import THROWS, throw, wall\nfrom distributed import Client\n"
        "from feather_physics import sweep\nkilled = []\n"
        "def kill_one(done, total):\n"
        "    if done > 40 and not killed:\n"
        "        with Client(sys.argv[1]) as client:\n"
        "            killed.append(next(iter(client.run(os.getpid).values())))\n"
        "        os.kill(killed[0], signal.SIGKILL)\n"
        "    print(done, total, file=sys.stderr)\n"
        "found = sweep(throw, THROWS, world=wall(), executor=sys.argv[1], chunk=8, progress=kill_one)\n"
        "with Client(sys.argv[1]) as client:\n"
        "    client.wait_for_workers(2, timeout=60)\n"  # the nanny takes its time
        "    print(killed[0], *client.run(os.getpid).values())\n"
        "print(repr(found))\n"
    )
    with scheduler_with_two_workers(tmp_path) as address:
        done = subprocess.run([sys.executable, script, address], env=ENVIRONMENT, capture_output=True, text=True, timeout=240)
        assert done.returncode == 0, done.stderr
        told, found = done.stdout.splitlines()
        assert found == repr(expected)
        bar = [line for line in done.stderr.splitlines() if re.fullmatch(r"\d+ \d+", line)]  # dask logs beside it
        assert bar[-1] == "400 400"
        killed, *workers = map(int, told.split())
        assert len(workers) == 2 and killed not in workers and not Path(f"/proc/{killed}").exists()
        started = [*workers, *processes_of(address)]
        assert len(started) > 2  # with their nannies
    assert end_of(started) == []


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # Debian's distributed and its tornado
def test_errors_come_back_from_dask(tmp_path: Path) -> None:
    need("distributed", "python3-distributed")
    with scheduler_with_two_workers(tmp_path) as address:
        with pytest.raises(SweepError, match=r"^sweep: parameter 5, 5: ZeroDivisionError"):
            sweep(tasks.fail_from_five, range(9), executor=address)


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "joblib", None)
    with pytest.raises(UnsupportedError, match="python3-joblib"):
        sweep(tasks.square, range(3), executor="joblib")
