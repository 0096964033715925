"""Words for the library's numbers, and definitions filled by the names of their fields."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Dict, Iterable, Sequence, Tuple

from .errors import InvalidArgumentError
from .records import BODY_TYPES, Material

EVENT_BITS = {"touch": 1, "stay": 2, "hit": 4}
COMBINES = ("default", "average", "minimum", "multiply", "maximum")
MOTIONS = ("locked", "limited", "free")
SPRINGS = ("none", "hertz", "stiffness")
DOFS = ("linear_x", "linear_y", "linear_z", "angular_x", "angular_y", "angular_z")
DRAW_PARTS = (
    "shapes",
    "contacts",
    "forces",
    "joints",
    "limits",
    "islands",
    "sleep",
    "bounds",
    "centres",
    "trees",
)
HIDDEN = ("this", "thisown", "struct_size", "of")
SIMD_SETS = ("auto", "plain", "sse2", "avx2", "avx512", "neon", "wasm")


def word(words: Sequence[str], text: Any, what: str) -> int:
    """The place of a word among those there are, or an error that names them."""
    if isinstance(text, str) and text in words:
        return words.index(text)
    raise InvalidArgumentError(f"{what}: one of {', '.join(words)} is needed, not {text!r}")


def body_type(text: Any) -> int:
    """fe_body_type of a word."""
    return word(BODY_TYPES, text, "type")


def events_bits(events: Iterable[str]) -> int:
    """fe_shape_events of words."""
    words = (events,) if isinstance(events, str) else events
    return sum({1 << word(tuple(EVENT_BITS), event, "events") for event in words})


def draw_bits(parts: Iterable[str]) -> int:
    """fe_draw_flags of words."""
    words = (parts,) if isinstance(parts, str) else parts
    return sum({1 << word(DRAW_PARTS, part, "parts") for part in words})


def axes_bits(text: str) -> int:
    """FE_AXIS_X | ... of "xyz"."""
    return sum({1 << word("xyz", letter, "axes") for letter in text})


def axes_text(bits: int) -> str:
    """The reverse of axes_bits."""
    return "".join(letter for i, letter in enumerate("xyz") if bits >> i & 1)


def locks_bits(locks: Sequence[str]) -> Tuple[int, int]:
    """Two texts of axes as bits."""
    if isinstance(locks, str):
        raise TypeError(f"locks: two texts of axes are needed, linear and angular, not {locks!r}")
    linear, angular = locks
    return axes_bits(linear), axes_bits(angular)


def flat_material(material: Sequence[Any]) -> Tuple[Any, ...]:
    """A material as the flat functions take it."""
    surface = Material(*material)
    friction = word(COMBINES, surface.friction_combine, "friction_combine")
    restitution = word(COMBINES, surface.restitution_combine, "restitution_combine")
    return (*surface[:5], friction, restitution, surface.user_id)


def material_of(flat: Tuple[Any, ...]) -> Material:
    """The reverse of flat_material."""
    return Material._make((*flat[:5], COMBINES[flat[5]], COMBINES[flat[6]], flat[7]))


# ---- definitions -------------------------------------------------------------------------------------------------


def fill(definition: Any, fields: Dict[str, Any]) -> None:
    """Sets fields of a definition by name; those of an axis from a dictionary or a namespace."""
    for name, value in fields.items():
        if name in DOFS and hasattr(definition, "axis"):
            _fill_axis(definition.axis(DOFS.index(name)), vars(value) if isinstance(value, SimpleNamespace) else value)
        else:
            _set_field(definition, "user_data" if name == "tag" else name, value)


def fields_of(definition: Any) -> SimpleNamespace:
    """A copy of the fields of a definition."""
    made = _copy(definition)
    if hasattr(definition, "axis"):
        for i, name in enumerate(DOFS):
            axis = _copy(definition.axis(i))
            axis.motion, axis.spring = MOTIONS[axis.motion], SPRINGS[axis.spring]
            setattr(made, name, axis)
    return made


def _fill_axis(axis: Any, fields: Dict[str, Any]) -> None:
    for name, value in fields.items():
        words = MOTIONS if name == "motion" else SPRINGS if name == "spring" else None
        _set_field(axis, name, word(words, value, name) if words else value)


def _copy(record: Any) -> SimpleNamespace:
    names = [name for name in dir(record) if not name.startswith("_") and name not in HIDDEN]
    values = {"tag" if name == "user_data" else name: getattr(record, name) for name in names}
    return SimpleNamespace(**{name: value for name, value in values.items() if not callable(value)})


def _set_field(record: Any, name: str, value: Any) -> None:
    if name.startswith("_") or not hasattr(record, name):
        raise TypeError(f"{type(record).__name__} has no field {name!r}")
    setattr(record, name, int(value) if isinstance(value, bool) else value)
