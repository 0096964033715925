"""Thousands of independent runs of one function, here or on many machines: sweep().

It hands out chunks of parameters to an executor (sweep_executors.py), whose workers run them (sweep_worker.py), and
keeps what is finished (sweep_store.py).
"""

from __future__ import annotations

import collections
import logging
import math
import os
import pickle
import reprlib
import sys
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from dataclasses import dataclass
from typing import Any, Callable, Deque, Dict, Iterable, List, Optional, Union

from .errors import FeatherError, InvalidArgumentError, StateError, UnsupportedError
from .sweep_executors import Runner, runner_for
from .sweep_store import Results, identity
from .sweep_worker import Chunk, Report, comes_again, fingerprint, load_error
from .world import World

LOG = logging.getLogger("feather_physics.sweep")
SECONDS_A_TASK = 0.0022  # what Dask's scheduler takes for one
TASKS_A_WORKER = 2  # one that runs, one that is there when it ends


class SweepError(FeatherError):
    """The function failed for a parameter. `index` and `parameter` tell which, `traceback` where; __cause__ is what it
    raised, if it did not take its worker along."""

    index: int = -1
    parameter: Any = None
    traceback: str = ""


def _error(place: int, parameter: Any, why: str, cause: Optional[Exception] = None, told: str = "") -> SweepError:
    error = SweepError(f"sweep: parameter {place}, {reprlib.repr(parameter)}: {why}")
    error.index, error.parameter, error.traceback, error.__cause__ = place, parameter, told, cause
    return error


def _span(places: List[int]) -> str:
    return f"parameter {places[0]}" if len(places) == 1 else f"parameters {places[0]} to {places[-1]}"


class TextBar:
    """A line on stderr, written anew when its percent change."""

    def __init__(self) -> None:
        self._percent = -1

    def __call__(self, done: int, total: int) -> None:
        percent = 100 * done // total if total else 100
        if percent != self._percent:
            self._percent = percent
            filled = percent * 40 // 100
            end = "\n" if done == total else ""
            bar = "#" * filled + "." * (40 - filled)
            print(f"\r[{bar}] {percent:3d} % {done}/{total}", end=end, file=sys.stderr, flush=True)


@dataclass
class _Task:
    places: List[int]
    is_alone: bool = False  # nothing else runs meanwhile: a worker that dies dies of it


class _Sweep:
    """What is finished, what runs, and what is still to do. Places are those of the parameters."""

    def __init__(
        self, function: Callable[..., Any], parameters: List[Any], chunk: Optional[int], retries: int, stops: bool
    ) -> None:
        self.function, self.parameters, self.chunk = function, parameters, chunk
        self.retries, self.stops = retries, stops
        self.results: Dict[int, Any] = {}
        self.errors: Dict[int, SweepError] = {}
        self.fresh: Deque[int] = collections.deque()
        self.again: List[_Task] = []
        self.failures: Dict[int, int] = collections.defaultdict(int)
        self.losses: Dict[int, int] = collections.defaultdict(int)
        self.seconds, self.measured = 0.0, 0
        self.store: Optional[Results] = None
        self.tell: Callable[[int, int], Any] = lambda done, total: None

    # ---- what runs next

    def size(self, workers: int) -> int:
        """C workers share W core-seconds, a task costs o: tasks of sqrt(2 o W) s lose least to the scheduler and to
        the wait for the last one. The last chunks are smaller, so that all workers end together."""
        if self.chunk is not None:
            return self.chunk
        if self.measured == 0:
            return 1
        mean = max(self.seconds / self.measured, 1e-6)
        best = math.sqrt(2 * SECONDS_A_TASK * mean * len(self.parameters)) / mean
        return max(1, min(int(best), len(self.fresh) // (2 * workers)))

    def next_task(self, running: List[_Task], workers: int) -> Optional[_Task]:
        if len(running) >= TASKS_A_WORKER * workers or any(task.is_alone for task in running):
            return None
        first_error = min(self.errors) if self.errors and self.stops else len(self.parameters)
        self.again = [task for task in self.again if task.places[0] < first_error]
        for i, task in enumerate(self.again):
            if not task.is_alone or not running:
                return self.again.pop(i)
        if self.fresh and first_error == len(self.parameters) and not self.again:
            return _Task([self.fresh.popleft() for _ in range(min(self.size(workers), len(self.fresh)))])
        return None

    # ---- what has ended

    def take(self, task: _Task, future: "Future[Any]") -> bool:
        """True: a worker was lost."""
        if future.cancelled():
            raise StateError(f"sweep: the executor dropped {_span(task.places)}; it or its scheduler has ended")
        error = future.exception()
        if error is None:
            self.report(future.result())
        elif isinstance(error, BrokenExecutor) or type(error).__name__ == "KilledWorker":  # the latter is Dask's
            self.lose(task)
            return isinstance(error, BrokenExecutor)
        elif isinstance(error, CancelledError):
            raise StateError(f"sweep: the executor dropped {_span(task.places)}: {error}") from error
        else:
            why = f"{type(error).__name__}: {error}"
            raise FeatherError(f"sweep: a worker could not run {_span(task.places)}: {why}") from error
        return False

    def report(self, report: Union[Report, UnsupportedError]) -> None:
        if isinstance(report, UnsupportedError):
            raise report
        finished = [(outcome.place, outcome.data) for outcome in report.outcomes if outcome.succeeded]
        if self.store is not None and finished:
            self.store.add(finished)
        for place, data in finished:
            self.results[place] = pickle.loads(data)
        for outcome in report.outcomes:
            if not outcome.succeeded:
                self.fail(outcome.place, *load_error(outcome.data))
        self.seconds += report.seconds
        self.measured += len(report.outcomes)
        self.tell(len(self.results) + len(self.errors), len(self.parameters))

    def fail(self, place: int, error: Exception, told: str) -> None:
        self.failures[place] += 1
        if not comes_again(error) and self.failures[place] <= self.retries:
            LOG.warning("sweep: parameter %d runs again after %s: %s", place, type(error).__name__, error)
            self.again.append(_Task([place]))
        else:
            self.errors[place] = _error(place, self.parameters[place], f"{type(error).__name__}: {error}", error, told)

    def lose(self, task: _Task) -> None:
        """A pool that breaks does not tell who broke it. What ran then runs again, the second time alone, and is halved
        until one parameter is left."""
        LOG.warning("sweep: a worker was lost while it had %s", _span(task.places))
        for place in task.places:
            self.losses[place] += 1
        half = len(task.places) // 2
        if not task.is_alone:
            self.again.append(_Task(task.places, max(self.losses[place] for place in task.places) > 1))
        elif half:
            self.again += [_Task(task.places[:half], True), _Task(task.places[half:], True)]
        else:
            place = task.places[0]
            self.failures[place] += 1
            if self.failures[place] <= self.retries:
                self.again.append(task)
            else:
                self.errors[place] = _error(place, self.parameters[place], "it killed its worker")
                self.tell(len(self.results) + len(self.errors), len(self.parameters))

    # ---- all of it

    def chunk_of(self, task: _Task, runner: Runner) -> Chunk:
        parameters = [self.parameters[place] for place in task.places]
        return Chunk(self.function, task.places, parameters, None if runner.is_here else fingerprint(), self.stops)

    def run(self, runner: Runner) -> None:
        running: Dict["Future[Any]", _Task] = {}
        while True:
            is_broken = False
            while not is_broken:
                task = self.next_task(list(running.values()), runner.worker_count())
                if task is None:
                    break
                try:
                    running[runner.submit(self.chunk_of(task, runner))] = task
                except BrokenExecutor:
                    self.again.insert(0, task)
                    is_broken = True
            if not running and not is_broken:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done if running else ():
                is_broken |= self.take(running.pop(future), future)
            if is_broken:
                for future in wait(running).done if running else ():  # they broke with it
                    self.take(running.pop(future), future)
                if not runner.renew():
                    raise StateError("sweep: the executor broke when it lost a worker; make a new one, and use resume=")


def _check(chunk: Any, retries: Any, on_error: Any) -> None:
    if chunk is not None and (not isinstance(chunk, int) or chunk < 1):
        raise InvalidArgumentError(f"sweep: chunk={chunk!r}; it is 1 or more parameters a task, or None")
    if not isinstance(retries, int) or retries < 0:
        raise InvalidArgumentError(f"sweep: retries={retries!r}; it is 0 or more")
    if on_error not in ("raise", "record"):
        raise InvalidArgumentError(f'sweep: on_error={on_error!r}; it is "raise" or "record"')


def sweep(
    function: Callable[..., Any],
    parameters: Iterable[Any],
    *,
    world: Optional[World] = None,
    executor: Any = None,
    chunk: Optional[int] = None,
    retries: int = 2,
    resume: Optional[Union[str, "os.PathLike[str]"]] = None,
    progress: Union[None, bool, Callable[[int, int], Any]] = None,
    on_error: str = "raise",
) -> List[Any]:
    """[function(parameter) for parameter in parameters], or function(world, parameter) with a copy of `world` for each,
    run by others. Results are in the order of parameters, and equal to those of a serial run.

    executor: None, this process; a number of processes; an executor of concurrent.futures; a Client of Dask, or the
        address of its scheduler; "joblib"; "mpi".
    chunk: parameters a task. None: chosen by their measured time.
    retries: how often a parameter runs again that raised an OSError or a MemoryError, or killed its worker.
    resume: a file that keeps finished results. A second run with the same function, world and parameters goes on.
    progress: True, a bar on stderr; None, that where stderr is a terminal; or a function of (done, total).
    on_error: "raise", the SweepError of the first parameter that failed; "record", it stands in its result's place.
    """
    _check(chunk, retries, on_error)
    todo, made = list(parameters), _data_of(world)
    state = _Sweep(function, todo, chunk, retries, on_error == "raise")
    if callable(progress):
        state.tell = progress
    elif progress or (progress is None and sys.stderr.isatty()):
        state.tell = TextBar()
    store = None if resume is None else Results(resume, identity(function, todo, made))
    try:
        state.store = store
        state.results.update(store.read() if store is not None else ())
        state.fresh.extend(place for place in range(len(todo)) if place not in state.results)
        state.tell(len(state.results), len(todo))
        if state.fresh:
            _run(state, runner_for(executor, function, made, retries))
    finally:
        if store is not None:
            store.close()
    if state.errors and on_error == "raise":
        raise state.errors[min(state.errors)]
    return [state.results[place] if place in state.results else state.errors[place] for place in range(len(todo))]


def _run(state: _Sweep, runner: Runner) -> None:
    try:
        state.run(runner)
    finally:
        runner.close()


def _data_of(world: Optional[World]) -> Optional[bytes]:
    return None if world is None else pickle.dumps(world)
