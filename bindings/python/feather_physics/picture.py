"""Pictures of worlds, without a GPU."""

from __future__ import annotations

import math
from base64 import b64encode
from typing import Any, Iterable, Optional

from . import _flat
from .errors import InvalidArgumentError
from .records import Vector
from .words import draw_bits

FROM = (0.6, 0.45, 1.0)  # the eye looks a little down, and a little along


def _slanted(name: str, x: float, y: float, z: float) -> None:
    """y is up: a picture needs to know which way its lower edge runs."""
    if not all(map(math.isfinite, (x, y, z))):
        raise InvalidArgumentError(f"{name}: a number that is not finite")
    if x * x + z * z <= 1e-12 * y * y:
        raise InvalidArgumentError(f"{name}: the eye must not be at the target, above it or below it")


def take(
    capsule: Any,
    width: int,
    height: int,
    eye: Optional[Vector],
    target: Optional[Vector],
    direction: Vector,
    parts: Iterable[str],
) -> bytes:
    """A PNG of a world, from an eye to a target, or of the whole of it from a direction."""
    if (eye is None) != (target is None):
        raise InvalidArgumentError("eye and target: both or none")
    if eye is None or target is None:
        _slanted("direction", *direction)
    else:
        _slanted("eye", *(a - b for a, b in zip(eye, target)))
    png: bytes = _flat.picture(capsule, width, height, draw_bits(parts), eye, target, direction)
    return png


def html(png: bytes, text: str) -> str:
    """An element that holds the picture itself."""
    return f'<img alt="{text}" title="{text}" src="data:image/png;base64,{b64encode(png).decode()}">'
