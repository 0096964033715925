"""Recordings: what a world was, and each call that changed it since. A player makes the same calls again."""

from __future__ import annotations

import os
from threading import Lock
from types import TracebackType
from typing import TYPE_CHECKING, Any, BinaryIO, Iterator, List, NamedTuple, Optional, Type, Union

from . import _flat, records
from .errors import InvalidArgumentError
from .objects import Entity
from .store import Asset, Store
from .words import SIMD_SETS, word

if TYPE_CHECKING:
    from .world import Pool, World

Path = Union[str, "os.PathLike[str]"]

DIVERGENCES = {1: "call", 2: "step", 3: "keyframe"}
DRAIN_STEPS = 15  # between two reads of a recording that goes to a file: a quarter of a second is lost by a crash
PIECE = 1 << 20  # bytes of a file that are read at once


class Note(NamedTuple):
    """Words that somebody left in a recording, after so many steps, about a handle or 0."""

    step: int
    about: int
    text: str


class Divergence(NamedTuple):
    """The first difference between a replay and its recording: a "call", "step" or "keyframe"; see fe_divergence in
    feather.h. The body's handle is 0, field and component are "" and -1 where they are not known."""

    kind: str
    step: int
    body: int
    component: int
    field: str
    text: str


class PlayerInfo(NamedTuple):
    """Where a player is, and what it has; see fe_player_info in feather.h."""

    library: int
    flags: int
    foreign: bool
    first_step: int
    last_step: int
    step: int
    calls: int
    bytes: int
    keyframes: int
    notes: int
    has_diverged: bool


def begin(world: Any, assets: bool, fine: bool, last: bool, keyframe_steps: int, buffer_bytes: int) -> Any:
    """The capsule of a new recorder."""
    definition = _flat.recorder_def()
    definition.flags = (
        (_flat.FE_RECORD_ASSETS if assets else 0)
        | (_flat.FE_RECORD_FINE if fine else 0)
        | (_flat.FE_RECORD_LAST if last else 0)
    )
    definition.keyframe_steps = keyframe_steps
    definition.buffer_bytes = buffer_bytes
    return _flat.recorder_create(world, definition)


class Recorder:
    """A recording of a world while it grows: world.recorder() begins it, close() or losing it ends it."""

    __slots__ = ("_capsule", "_world", "_closed")

    def __init__(self, capsule: Any, world: Any):
        self._capsule = capsule
        self._world = world  # its capsule
        self._closed = False

    def read(self) -> bytes:
        """What was recorded since the last read, to be appended to a file; of a flight recorder all that it keeps. Any
        thread may read, also during a step. b"" when nothing waits. When the recording ended as there was no memory,
        or as its buffer was full and nobody read, an OutOfMemoryError or a LimitError, after all that was recorded."""
        waiting: bytes = _flat.recorder_read(self._capsule)
        return waiting

    def note(self, text: str, about: Union[Entity, Asset, None] = None) -> None:
        """Leaves words at this moment: at most 4096 bytes of UTF-8, about a body, a shape, a joint, an asset or
        nothing. A StateError when the recording has ended."""
        if about is not None and not isinstance(about, (Entity, Asset)):
            raise TypeError(f"about: a body, a shape, a joint or an asset is needed, not {type(about).__name__!r}")
        if isinstance(about, Entity) and about._capsule is not self._world:
            raise InvalidArgumentError(f"about: {about!r} belongs to another world")
        _flat.recorder_note(self._capsule, 0 if about is None else about._id, text)

    def close(self) -> None:
        """Ends the recording. What nobody read is lost. Closing again does nothing."""
        if not self._closed:
            _flat.recorder_destroy(self._capsule)
            self._closed = True

    @property
    def closed(self) -> bool:
        """True after close()."""
        return self._closed

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()


class Recording(Recorder):
    """A recording that goes to a file, while the world steps: `with world.record(path) as recording:`."""

    __slots__ = ("_file", "_failure", "_interval", "_lock", "_steps")

    def __init__(self, capsule: Any, world: Any, file: BinaryIO, interval: int):
        super().__init__(capsule, world)
        self._file = file
        self._failure: Optional[Exception] = None
        self._interval = interval
        self._lock = Lock()  # who reads first writes first
        self._steps = 0

    def _after_step(self) -> None:
        self._steps += 1
        if self._steps < self._interval or self._closed:
            return
        self._steps = 0
        self._drain()

    def _drain(self) -> None:
        """A step does not fail because somebody records: flush() and close() tell what went wrong. Nothing is written
        behind a gap."""
        with self._lock:
            if self._failure is not None:
                return
            try:
                self._file.write(_flat.recorder_read(self._capsule))
            except Exception as error:
                self._failure = error
            except BaseException:
                self._failure = OSError("the recording was interrupted: the file ends there")
                raise

    def read(self) -> bytes:
        """Nothing: what is recorded goes to the file."""
        return b""

    def flush(self) -> None:
        """Writes all that was recorded until now. What went wrong since the recording began is raised: an OSError of
        the file, a LimitError, an OutOfMemoryError."""
        self._drain()
        if self._failure is None:
            self._file.flush()
        else:
            raise self._failure

    def close(self) -> None:
        """Writes the rest and closes the file; raises what flush() would. Closing again does nothing."""
        if self._closed:
            return
        self._drain()
        super().close()
        try:
            self._file.close()
        except OSError as error:
            self._failure = self._failure or error
        if self._failure is not None:
            raise self._failure

    def __enter__(self) -> "Recording":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()


class Player:
    """A world that does what a recording says:

    with Player("run.feather") as player:
        for world in player:
            print(world.hash)
    """

    __slots__ = ("_capsule", "_closed", "_store", "_world")

    def __init__(
        self,
        recording: Any = None,
        *,
        workers: int = 1,
        simd: str = "auto",
        pool: Optional[Pool] = None,
        store: Optional[Store] = None,
    ):
        """The recording is bytes, or the path of a file; without one feed() it. Assets that it does not hold are
        looked for in the store."""
        definition = _flat.player_def()
        definition.worker_count = workers
        definition.simd = word(SIMD_SETS, simd, "simd")
        if pool is not None:
            definition.pool = pool._capsule
        if store is not None:
            definition.store = store._capsule
        self._capsule = _flat.player_create(definition)
        _flat.keep(self._capsule, (pool and pool._capsule, store and store._capsule))
        self._closed = False
        self._store = store
        self._world: Optional[World] = None
        if isinstance(recording, (str, os.PathLike)):
            with open(recording, "rb") as file:
                for piece in iter(lambda: file.read(PIECE), b""):
                    self.feed(piece)
        elif recording is not None:
            self.feed(recording)

    def feed(self, data: Any) -> None:
        """Adds bytes of a recording, in pieces of any size. A DataError for what is no recording or was altered: what
        stood before it plays."""
        _flat.player_feed(self._capsule, data)

    def step(self) -> bool:
        """Makes the recorded calls up to the end of the next step. False: there is no more yet. A DivergedError, once,
        when the world went another way: divergence tells it, and the next call goes on."""
        stepped: bool = _flat.player_step(self._capsule)
        return stepped

    def seek(self, step: int) -> bool:
        """Goes to the end of a step, forwards or backwards, as info counts them. False: the recording ends before it.
        Objects of what is not there at that step are stale, or mean something else: they are not to be kept."""
        found: bool = _flat.player_seek(self._capsule, step)
        if self._world is not None:
            self._world._forget_ended()
        return found

    def __iter__(self) -> Iterator["World"]:
        """Steps to the end, and gives the world after each."""
        while self.step():
            yield self.world

    @property
    def world(self) -> "World":
        """The world as it is now, to be read: what changes it is a StateError, also before the first step."""
        from .world import World

        capsule = _flat.player_get_world(self._capsule)
        if self._world is None:
            self._world = World._of_player(capsule, self._store)
        return self._world

    def release(self) -> "World":
        """Hands the world over: it may be changed and stepped from here on, and outlives the player. Its pair filter,
        where the recorded world had one, lets all pairs collide. A seek makes the player another world."""
        world = self.world
        _flat.player_release(self._capsule)
        self._world = None
        return world

    @property
    def info(self) -> PlayerInfo:
        """Where it is, and what it has."""
        info = records.copy_record(PlayerInfo, _flat.player_get_info(self._capsule))
        return info._replace(foreign=bool(info.foreign), has_diverged=bool(info.has_diverged))

    @property
    def notes(self) -> List[Note]:
        """The words that were left in what it was fed."""
        return [Note(*note) for note in _flat.player_get_notes(self._capsule)]

    @property
    def divergence(self) -> Optional[Divergence]:
        """The first difference between the replay and its recording; None: there was none."""
        if not _flat.player_get_info(self._capsule).has_diverged:
            return None
        kind, *rest = _flat.player_get_divergence(self._capsule)
        return Divergence(DIVERGENCES[kind], *rest)

    @property
    def closed(self) -> bool:
        """True after close()."""
        return self._closed

    def close(self) -> None:
        """Destroys it, and its world unless that was released. Closing again does nothing."""
        if not self._closed:
            _flat.player_destroy(self._capsule)
            self._closed = True
            if self._world is not None:
                self._world._closed = True
            self._world = None

    def __enter__(self) -> "Player":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()
