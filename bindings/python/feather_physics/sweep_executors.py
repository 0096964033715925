"""What runs a sweep's chunks: this process, processes of its own, or an executor of the standard library's kind, which
Dask, joblib and MPI have too. Each is imported only when it is asked for."""

from __future__ import annotations

import hashlib
import importlib
import multiprocessing
import os
import pickle
import sys
import threading
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from typing import Any, Callable, Optional

from .errors import InvalidArgumentError, UnsupportedError
from .sweep_worker import Chunk, run_chunk


class Runner:
    """An executor, and how to end it, make it anew and count its workers."""

    is_here = False  # in the process of the caller: a library is equal to itself

    def __init__(self, executor: Executor, world: Optional[bytes]) -> None:
        self.executor = executor
        self._world = world

    def submit(self, chunk: Chunk) -> "Future[Any]":
        """Gives some parameters to a worker."""
        return self.executor.submit(run_chunk, chunk, self._world)

    def worker_count(self) -> int:
        """How many run at once, as far as the executor says."""
        for name in ("num_workers", "_max_workers"):
            count = getattr(self.executor, name, None)
            if isinstance(count, int) and count > 0:
                return count
        return os.cpu_count() or 1

    def renew(self) -> bool:
        """After a worker was lost with its pool. False: this executor is its owner's, who must make another."""
        return False

    def close(self) -> None:
        """What the caller made stays the caller's."""


class _Here(Executor):
    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        future: "Future[Any]" = Future()
        future.set_result(fn(*args, **kwargs))
        return future


class _Serial(Runner):
    is_here = True

    def worker_count(self) -> int:
        return 1


def _end_with_the_parent() -> None:
    """In a worker. A worker waits for its next task in a pipe, and would not see that its parent was killed."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait_for(process: multiprocessing.process.BaseProcess) -> None:
        process.join()
        os._exit(1)

    threading.Thread(target=wait_for, args=(parent,), daemon=True).start()


class _Own(Runner):
    """An executor that the sweep makes, and makes again."""

    def __init__(self, make: Callable[[], Executor], world: Optional[bytes], can_renew: bool = True) -> None:
        super().__init__(make(), world)
        self._make, self._can_renew = make, can_renew

    def renew(self) -> bool:
        if self._can_renew:
            self.executor.shutdown()
            self.executor = self._make()
        return self._can_renew

    def close(self) -> None:
        self.executor.shutdown(wait=True, cancel_futures=True)


def _keep(world: bytes) -> bytes:
    return world


class _Dask(Runner):
    """The world is the result of a task: it travels once a worker, and is made again when all who had it are lost."""

    def __init__(self, client: Any, world: Optional[bytes], retries: int, is_own: bool) -> None:
        super().__init__(client.get_executor(pure=False, retries=retries), world)
        self._client, self._is_own = client, is_own
        if world is not None:
            self._world = client.submit(_keep, world, key=f"feather-world-{hashlib.sha256(world).hexdigest()}")

    def worker_count(self) -> int:
        return sum(self._client.nthreads().values()) or 1  # clusters grow and shrink

    def close(self) -> None:
        self.executor.shutdown(wait=False)
        self._world = None
        if self._is_own:
            self._client.close()


def _import(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise UnsupportedError(f"sweep: {name} is not there; install {package}") from error


class _Joblib(Runner):
    """The workers of joblib's own backend, which all that uses joblib in this process shares: none ends them."""

    def __init__(self, world: Optional[bytes]) -> None:
        self._count = _import("joblib", "joblib (Debian: python3-joblib)").cpu_count()
        try:
            self._loky = importlib.import_module("joblib.externals.loky")
        except ImportError:
            self._loky = importlib.import_module("loky")
        super().__init__(self._pool(), world)

    def _pool(self) -> Executor:
        """The one there is, or a new one where a worker was lost."""
        executor: Executor = self._loky.get_reusable_executor(max_workers=self._count)
        return executor

    def worker_count(self) -> int:
        return int(self._count)

    def renew(self) -> bool:
        self.executor = self._pool()
        return True


def _processes(count: int, function: Callable[..., Any], world: Optional[bytes]) -> Runner:
    if count < 1:
        raise InvalidArgumentError(f"sweep: executor={count}; a number of processes is 1 or more")
    try:
        pickle.dumps(function)
    except Exception as error:
        raise InvalidArgumentError(
            f"sweep: processes cannot get {function!r}: {error}; it must stand at the top of a module"
        ) from error
    context = multiprocessing.get_context("spawn")
    return _Own(lambda: ProcessPoolExecutor(count, mp_context=context, initializer=_end_with_the_parent), world)


def runner_for(executor: Any, function: Callable[..., Any], world: Optional[bytes], retries: int) -> Runner:
    """The runner of what sweep() was given as its executor."""
    if executor is None:
        return _Serial(_Here(), world)
    if isinstance(executor, int) and not isinstance(executor, bool):
        return _processes(executor, function, world)
    if isinstance(executor, Executor):
        return Runner(executor, world)
    distributed: Any = sys.modules.get("distributed")
    if distributed is not None and isinstance(executor, distributed.Client):
        return _Dask(executor, world, retries, is_own=False)
    if isinstance(executor, str) and "://" in executor:
        distributed = _import("distributed", "Dask's distributed (Debian: python3-distributed)")
        return _Dask(distributed.Client(executor), world, retries, is_own=True)
    if executor == "joblib":
        return _Joblib(world)
    if executor == "mpi":
        futures = _import("mpi4py.futures", "mpi4py (Debian: python3-mpi4py)")
        return _Own(futures.MPIPoolExecutor, world, can_renew=False)
    raise InvalidArgumentError(
        f"sweep: executor={executor!r}; it is None, a number of processes, an executor of concurrent.futures, "
        'a Client of Dask or the address of its scheduler ("tcp://host:8786"), "joblib" or "mpi"'
    )
