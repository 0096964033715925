"""Sweeps: equal to a loop whatever runs them, with workers that die, errors that name their parameter, and resuming."""

import logging
import os
import signal
import sqlite3
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any, List, Tuple

import pytest
import sweep_tasks as tasks

import feather_physics.sweeping as sweeping
from feather_physics import (
    BusyError,
    DataError,
    InvalidArgumentError,
    StateError,
    SweepError,
    UnsupportedError,
    sweep,
)

ANGLES = [0.1 * i for i in range(40)]


def alive(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


@pytest.fixture(scope="module")
def serial() -> List[int]:
    """What a loop gives that knows nothing of sweeps."""
    return [tasks.drop(tasks.make_world(), angle) for angle in ANGLES]


def test_the_serial_run_is_the_loop(serial: List[int]) -> None:
    assert sweep(tasks.drop, ANGLES, world=tasks.make_world()) == serial
    assert len(set(serial)) == len(serial)
    assert sweep(tasks.square, range(100)) == [(x, x * x) for x in range(100)]
    assert sweep(tasks.square, []) == []
    assert sweep(tasks.square, iter([3, 1, 2])) == [(3, 9), (1, 1), (2, 4)]


@pytest.mark.parametrize("chunk", [1, 7, 50, None])
def test_processes_give_what_the_loop_gives(serial: List[int], chunk: Any) -> None:
    assert sweep(tasks.drop, ANGLES, world=tasks.make_world(), executor=2, chunk=chunk) == serial


def test_executors_of_the_caller_give_the_same_and_stay_open(serial: List[int]) -> None:
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as processes, ThreadPoolExecutor(2) as threads:
        for executor in (processes, threads, processes):
            assert sweep(tasks.drop, ANGLES, world=tasks.make_world(), executor=executor, chunk=3) == serial


def test_each_parameter_has_a_world_of_its_own() -> None:
    world = tasks.make_world()
    bodies = world.counters.bodies
    assert sweep(tasks.add_to, range(9), world=world) == [(bodies + 1, x) for x in range(9)]
    assert world.counters.bodies == bodies


@pytest.mark.parametrize("executor", [None, 2])
@pytest.mark.parametrize("chunk", [1, 4])
def test_the_first_parameter_that_fails_is_named(executor: Any, chunk: int) -> None:
    with pytest.raises(SweepError, match=r"^sweep: parameter 5, 5: ZeroDivisionError: integer division") as caught:
        sweep(tasks.fail_from_five, range(9), executor=executor, chunk=chunk)
    assert (caught.value.index, caught.value.parameter) == (5, 5)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    assert "in fail_from_five" in caught.value.traceback


@pytest.mark.parametrize("executor", [None, 2])
def test_errors_can_stand_among_the_results(executor: Any) -> None:
    found = sweep(tasks.nan_at_three, range(6), world=tasks.make_world(), executor=executor, on_error="record")
    assert found[:3] + found[4:] == [0, 1, 2, 4, 5]
    assert isinstance(found[3], SweepError) and found[3].index == 3
    assert isinstance(found[3].__cause__, InvalidArgumentError)


def test_what_cannot_be_pickled_is_named() -> None:
    with pytest.raises(SweepError, match="parameter 2, 2: TypeError: cannot pickle '_thread.lock'"):
        sweep(tasks.give_back_a_lock, range(4))
    with pytest.raises(SweepError, match="parameter 0, 0: FeatherError: HardError: 0 and 2"):
        sweep(tasks.fail_hard, range(4))
    with pytest.raises(InvalidArgumentError, match="top of a module"):
        sweep(lambda x: x, range(4), executor=2)


def test_what_may_pass_is_tried_again_and_what_repeats_is_not(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    parameters = [(str(tmp_path), x) for x in range(6)]
    with caplog.at_level(logging.WARNING):
        assert sweep(tasks.fail_twice, parameters) == list(range(6))
    assert [len((tmp_path / str(x)).read_text()) for x in range(6)] == [1, 1, 1, 3, 1, 1]
    assert caplog.text.count("parameter 3 runs again after OSError: the network is down") == 2
    (tmp_path / "3").unlink()
    with pytest.raises(SweepError, match="parameter 3, .*OSError"):
        sweep(tasks.fail_twice, parameters, retries=1)
    with pytest.raises(SweepError, match="parameter 0, "):
        sweep(tasks.bad_argument, [(str(tmp_path), 9)])
    assert (tmp_path / "9").read_text() == "."


@pytest.mark.parametrize("chunk", [1, 8, None])
def test_a_worker_that_is_killed_changes_nothing(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, capsys: pytest.CaptureFixture[str], chunk: Any
) -> None:
    parameters = [(str(tmp_path), x) for x in range(40)]
    with caplog.at_level(logging.WARNING):
        found = sweep(tasks.die_once, parameters, world=tasks.make_world(), executor=2, chunk=chunk, progress=True)
    assert (tmp_path / "died").exists()
    assert found == [tasks.drop(tasks.make_world(), x) for x in range(40)]
    assert "a worker was lost while it had" in caplog.text
    assert capsys.readouterr().err.endswith("100 % 40/40\n")


def test_the_parameter_that_kills_its_workers_is_found() -> None:
    with pytest.raises(SweepError, match="^sweep: parameter 6, 6: it killed its worker$"):
        sweep(tasks.die_always, range(10), executor=2, chunk=5, retries=0)
    found = sweep(tasks.die_always, range(10), executor=2, chunk=5, retries=1, on_error="record")
    assert [x for x in found if isinstance(x, int)] == [0, 1, 2, 3, 4, 5, 7, 8, 9]
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:
        with pytest.raises(StateError, match="make a new one"):
            sweep(tasks.die_always, range(10), executor=executor)


def test_another_build_at_a_worker_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = sweeping.fingerprint()._replace(version="9.9.9")
    monkeypatch.setattr(sweeping, "fingerprint", lambda: wrong)
    with pytest.raises(UnsupportedError, match="the client 9.9.9"):
        sweep(tasks.square, range(4), executor=2)
    assert sweep(tasks.square, range(2)) == [(0, 0), (1, 1)]


def test_a_second_run_resumes(tmp_path: Path) -> None:
    file = tmp_path / "sweep.db"
    with pytest.raises(SweepError, match="parameter 7"):
        sweep(tasks.note, [(str(tmp_path), x, 7) for x in range(10)], resume=file)
    with pytest.raises(DataError, match="is of another sweep: its parameters differs"):
        sweep(tasks.note, [(str(tmp_path), x, -1) for x in range(10)], resume=file)
    with pytest.raises(DataError, match="its number of parameters differs"):
        sweep(tasks.note, [], resume=file)
    with pytest.raises(DataError, match="its function differs"):
        sweep(tasks.square, [(str(tmp_path), x, 7) for x in range(10)], resume=file)
    with pytest.raises(DataError, match="its world differs"):
        sweep(tasks.note, [(str(tmp_path), x, 7) for x in range(10)], resume=file, world=tasks.make_world())
    calls: List[Tuple[int, int]] = []
    found = sweep(
        tasks.note, [(str(tmp_path), x, 7) for x in range(10)], resume=file, on_error="record", executor=2,
        progress=lambda done, total: calls.append((done, total)),
    )
    assert found[:7] + found[8:] == [{"x": [x] * 3} for x in range(10) if x != 7]
    assert calls[0] == (7, 10) and calls[-1] == (10, 10)
    ran = (tmp_path / "ran").read_text().split()
    assert sorted(ran) == sorted([str(x) for x in range(10)] + ["7"])


def test_files_that_are_none_of_a_sweep_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "text"
    file.write_text("This is no file of a sweep, and long enough for one to look for its head. " * 20)
    with pytest.raises(DataError, match="no file of a sweep"):
        sweep(tasks.square, range(3), resume=file)
    held = sqlite3.connect(tmp_path / "held.db")
    held.execute("BEGIN EXCLUSIVE")
    with pytest.raises(BusyError, match="in use by another process"):
        sweep(tasks.square, range(3), resume=tmp_path / "held.db")
    held.close()


def test_a_client_that_is_killed_leaves_a_file_to_go_on_with_and_no_process(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(
        "import sweep_tasks as tasks\nfrom feather_physics import sweep\nif __name__ == '__main__':\n"
        f"    sweep(tasks.tell_process, [({str(tmp_path)!r}, x) for x in range(9)], executor=2, chunk=1)\n"
    )
    environment = {**os.environ, "PYTHONPATH": f"{Path(tasks.__file__).parent}:{os.environ['PYTHONPATH']}"}
    client = subprocess.Popen([sys.executable, script], env=environment)
    try:
        deadline = time.monotonic() + 20
        while len(found := list(tmp_path.glob("*.pid"))) < 2:
            assert time.monotonic() < deadline
            time.sleep(0.05)
    finally:
        client.send_signal(signal.SIGKILL)
        client.wait()
    while any(alive(int(path.stem)) for path in found):
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.mark.parametrize(
    "arguments, text",
    [
        ({"executor": 0}, "executor=0"),
        ({"executor": True}, "executor=True"),
        ({"executor": "cloud"}, "executor='cloud'"),
        ({"chunk": 0}, "chunk=0"),
        ({"retries": -1}, "retries=-1"),
        ({"on_error": "ignore"}, "on_error='ignore'"),
    ],
)
def test_wrong_arguments_are_named(arguments: Any, text: str) -> None:
    with pytest.raises(InvalidArgumentError, match=text):
        sweep(tasks.square, range(3), **arguments)


def test_an_executor_that_is_shut_down_says_so() -> None:
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.raises(RuntimeError, match="shutdown"):
        sweep(tasks.square, range(3), executor=executor)
