"""What a world was, in memory, to set worlds back to: world.state() makes one."""

from typing import Any

from . import _flat


class State:
    """A world as it was. It never changes, belongs to no world, and can be given to many: world.set_state(state). It
    ends with close(), or when nobody has it. It is no bytes: what is to be pickled, or to go to another process, is
    the world itself, or world.save()."""

    __slots__ = ("_capsule", "_kept")

    def __init__(self, capsule: Any, kept: Any):
        self._capsule = capsule
        self._kept = kept  # the store of its assets

    def __reduce__(self) -> Any:
        raise TypeError("a State is no bytes: pickle the world, or world.save()")

    def close(self) -> None:
        """Gives its memory back. What uses it afterwards is a StaleHandleError."""
        _flat.state_destroy(self._capsule)
        self._kept = None
