"""What a worker of a sweep does: it runs a chunk of parameters, and hands back a pickle for each. Chunks come from
sweeping.py, which reads what they return."""

from __future__ import annotations

import functools
import importlib
import pickle
import time
import traceback
from dataclasses import dataclass
from typing import Any, Callable, List, NamedTuple, Optional, Tuple, Union

from . import _flat
from .errors import FeatherError, UnsupportedError
from .world import World


class Fingerprint(NamedTuple):
    """What a worker and its client must have in common, for equal bits."""

    version: str
    golden: int  # the hash of a world in which most of the engine has worked


class Outcome(NamedTuple):
    """What became of one parameter."""

    place: int
    succeeded: bool
    data: bytes  # the pickle of the result, or of the exception and its traceback


class Report(NamedTuple):
    """What a worker returns of a chunk, and how long it took."""

    seconds: float
    outcomes: List[Outcome]


@dataclass
class Chunk:
    """No tuple or list: Dask would look for tasks and futures in it."""

    function: Callable[..., Any]
    places: List[int]
    parameters: List[Any]
    fingerprint: Optional[Fingerprint]  # None: the client's own process
    stops: bool  # at the first error that would come again


@functools.lru_cache(None)
def fingerprint() -> Fingerprint:
    """Of this process's library: its version, and the hash of a small scene."""
    version = ".".join(str(_flat.version() >> shift & 0xFF) for shift in (16, 8, 0))
    with World(number=1) as world:
        world.create_body("static").add_plane()
        for i in range(12):
            at = (0.3 * (i % 3), 0.6 + 0.7 * (i // 3), 0.1 * i)
            body = world.create_body(position=at, angular_velocity=(i, 1, 0))
            (body.add_box, body.add_capsule, body.add_cylinder)[i % 3](*(0.3, 0.2, 0.25)[: 3 if i % 3 == 0 else 2])
            if i % 4 == 3:
                world.create_hinge_joint(None, body, body.position, (0, 0, 1))
        for _ in range(60):
            world.step(1 / 60)
        return Fingerprint(version, world.hash)


def dump(value: Any) -> bytes:
    """By pickle. By cloudpickle where a class of the caller's script is none of this process: Dask sent it by value."""
    try:
        return pickle.dumps(value)
    except (pickle.PicklingError, AttributeError, TypeError):
        try:
            cloudpickle: Any = importlib.import_module("cloudpickle")
        except ImportError:
            cloudpickle = None
        if cloudpickle is None:
            raise
        data: bytes = cloudpickle.dumps(value)
        return data


def dump_error(error: Exception) -> bytes:
    """Some exceptions cannot be pickled, or not be read again: these travel as their text."""
    told = "".join(traceback.format_exception(type(error), error, error.__traceback__))
    try:
        data = dump((error, told))
        pickle.loads(data)
        return data
    except Exception:
        return pickle.dumps((FeatherError(f"{type(error).__name__}: {error}"), told))


def comes_again(error: Exception) -> bool:
    """A step that failed fails again with the same bits. A lack of memory, a file or a network may not."""
    return not isinstance(error, (OSError, MemoryError))


def run_one(function: Callable[..., Any], world: Optional[bytes], parameter: Any) -> bytes:
    """The pickle of a result."""
    if world is None:
        return dump(function(parameter))
    return dump(function(pickle.loads(world), parameter))


def run_chunk(chunk: Chunk, world: Optional[bytes]) -> Union[Report, UnsupportedError]:
    """Each parameter with a world of its own, whatever ran before it."""
    if chunk.fingerprint is not None and chunk.fingerprint != fingerprint():
        return UnsupportedError(
            f"sweep: a worker has Feather {fingerprint().version} with golden hash {fingerprint().golden:016x}, "
            f"the client {chunk.fingerprint.version} with {chunk.fingerprint.golden:016x}; install the same on both"
        )
    outcomes: List[Outcome] = []
    start = time.perf_counter()
    for place, parameter in zip(chunk.places, chunk.parameters):
        try:
            outcomes.append(Outcome(place, True, run_one(chunk.function, world, parameter)))
        except Exception as error:
            outcomes.append(Outcome(place, False, dump_error(error)))
            if chunk.stops and comes_again(error):
                break
    return Report(time.perf_counter() - start, outcomes)


def load_error(data: bytes) -> Tuple[Exception, str]:
    """What dump_error() made: the error, and its traceback as text."""
    error, told = pickle.loads(data)
    return error, told
