"""What a failed call raises. The text is the library's sentence: function, argument, value, legal range."""

from __future__ import annotations

from . import _flat


class FeatherError(RuntimeError):
    """A call failed; nothing has changed."""


class InvalidArgumentError(FeatherError, ValueError):
    """NaN, infinity, or a value out of its range (FE_ERROR_ARGUMENT)."""


class StaleHandleError(FeatherError, ReferenceError):
    """The body, shape, joint or asset was destroyed, or its world is closed (FE_ERROR_STALE)."""


class WrongKindError(FeatherError, TypeError):
    """The handle of a shape where that of a body is asked (FE_ERROR_KIND)."""


class SteppingError(FeatherError):
    """The world is in a step: a pair filter may not use it, and its heights may not change (FE_ERROR_STEPPING)."""


class OutOfMemoryError(FeatherError, MemoryError):
    """There was no memory; the world is as it was (FE_ERROR_MEMORY)."""


class LimitError(FeatherError):
    """More than a world or an array can hold (FE_ERROR_LIMIT)."""


class UnsupportedError(FeatherError):
    """This processor, form or kind of body cannot (FE_ERROR_UNSUPPORTED)."""


class StateError(FeatherError):
    """Not now: the pool still has worlds, the body is not kinematic... (FE_ERROR_STATE)."""


class BusyError(FeatherError):
    """Another thread is inside the world (FE_ERROR_BUSY)."""


class DegenerateError(FeatherError, ValueError):
    """Flat or empty input of a builder (FE_ERROR_DEGENERATE)."""


class DataError(FeatherError, ValueError):
    """Cut, altered or foreign bytes (FE_ERROR_DATA)."""


class VersionError(FeatherError):
    """Bytes of a newer format (FE_ERROR_VERSION)."""


class DivergedError(FeatherError):
    """A replay went another way than its recording (FE_ERROR_DIVERGED)."""


class SceneError(InvalidArgumentError):
    """What is wrong in a file of a robot, in a mesh of it, or in a scene, with the file and the line. Readers, writers
    and Scene.build() raise nothing else for what they are given."""


class UnsupportedSceneError(SceneError, UnsupportedError):
    """It is right, and no scene has it."""


class SceneVersionError(SceneError, VersionError):
    """A scene of a newer format."""


# ordered by the negative of fe_result
_flat.set_error_classes(
    (
        FeatherError,
        InvalidArgumentError,
        StaleHandleError,
        WrongKindError,
        SteppingError,
        OutOfMemoryError,
        LimitError,
        UnsupportedError,
        StateError,
        BusyError,
        DegenerateError,
        DataError,
        VersionError,
        DivergedError,
    )
)
