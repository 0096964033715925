"""The last frames of a world, in memory, for rollback: world.history() makes one."""

from typing import Any, Callable, Dict

from . import _flat, records


class History:
    """The last frames of a world, to go back to: keep each before its step. It ends with close() or with the world."""

    __slots__ = ("_capsule", "_after_restore")

    def __init__(self, capsule: Any, after_restore: Callable[[], None]):
        self._capsule = capsule
        self._after_restore = after_restore

    def keep(self, frame: int) -> None:
        """Keeps the world as it is, under a number above the last one kept. The oldest frames go when there are too
        many, or too many bytes."""
        _flat.history_keep(self._capsule, frame)

    def restore(self, frame: int) -> None:
        """Puts the world back to the frame; those after it go. A StaleHandleError when it is not kept, or no longer.
        Objects of what was made since are not to be kept, as after world.restore()."""
        _flat.history_restore(self._capsule, frame)
        self._after_restore()

    @property
    def frames(self) -> Dict[int, int]:
        """The numbers that are kept, the oldest first, each with the bytes that it adds to the one before."""
        return dict(records.read_all(_flat.history_get_frames, records.HISTORY_FRAME, self._capsule))  # type: ignore

    def close(self) -> None:
        """Gives its memory back. Calls of a closed history are a StaleHandleError."""
        _flat.history_destroy(self._capsule)
