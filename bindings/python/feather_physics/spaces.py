"""What an action or an observation may be: gymnasium's Box, Discrete and MultiDiscrete where it is installed, else the
same in small. Needs NumPy."""

from __future__ import annotations

from enum import Enum
from importlib import import_module
from typing import Any, Optional, Sequence, Tuple

import numpy as np


def _gymnasium(module: str) -> Any:
    """The module, or None."""
    try:
        return import_module(f"gymnasium.{module}")
    except ImportError:
        return None


class OwnAutoresetMode(Enum):
    """When a world whose episode has ended begins anew."""

    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class _Space:
    shape: Tuple[int, ...]
    dtype: Any

    def __init__(self, shape: Sequence[int], dtype: Any, seed: Optional[int]):
        self.shape, self.dtype = tuple(shape), np.dtype(dtype)
        self.seed(seed)

    def seed(self, seed: Optional[int] = None) -> None:
        """Begins the numbers of sample() anew."""
        self.np_random = np.random.default_rng(seed)


class OwnBox(_Space):
    """Arrays of numbers between low and high."""

    def __init__(
        self, low: Any, high: Any, shape: Optional[Sequence[int]] = None, dtype: Any = np.float32, seed: Any = None
    ):
        super().__init__(np.shape(low) if shape is None else shape, dtype, seed)
        self.low = np.array(np.broadcast_to(low, self.shape), self.dtype)
        self.high = np.array(np.broadcast_to(high, self.shape), self.dtype)

    def sample(self) -> Any:
        """One of them, at random."""
        low, high = np.nan_to_num(self.low, neginf=-1e6), np.nan_to_num(self.high, posinf=1e6)
        return self.np_random.uniform(low, high).astype(self.dtype)

    def contains(self, x: Any) -> bool:
        """Is it one of them, in form and range?"""
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all((x >= self.low) & (x <= self.high)))

    def __eq__(self, other: Any) -> bool:
        same = isinstance(other, OwnBox) and self.shape == other.shape
        return same and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high)

    def __repr__(self) -> str:
        return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


class OwnDiscrete(_Space):
    """One of n integers, from start on."""

    def __init__(self, n: int, seed: Any = None, start: int = 0):
        super().__init__((), np.int64, seed)
        self.n, self.start = np.int64(n), np.int64(start)

    def sample(self) -> Any:
        """One of them, at random."""
        return self.start + self.np_random.integers(self.n)

    def contains(self, x: Any) -> bool:
        """Is it one of them, in form and range?"""
        x = np.asarray(x)
        return x.shape == () and x.dtype.kind in "iu" and bool(self.start <= x < self.start + self.n)

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, OwnDiscrete) and (self.n, self.start) == (other.n, other.start)

    def __repr__(self) -> str:
        return f"Discrete({self.n})"


class OwnMultiDiscrete(_Space):
    """An array of integers, each below its own n."""

    def __init__(self, nvec: Any, dtype: Any = np.int64, seed: Any = None):
        self.nvec = np.array(nvec, dtype)
        super().__init__(self.nvec.shape, dtype, seed)

    def sample(self) -> Any:
        """One of them, at random."""
        return self.np_random.integers(self.nvec, dtype=self.dtype)

    def contains(self, x: Any) -> bool:
        """Is it one of them, in form and range?"""
        x = np.asarray(x)
        return x.shape == self.shape and x.dtype.kind in "iu" and bool(np.all((x >= 0) & (x < self.nvec)))

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, OwnMultiDiscrete) and np.array_equal(self.nvec, other.nvec)

    def __repr__(self) -> str:
        return f"MultiDiscrete({self.nvec})"


_SPACES, _VECTOR = _gymnasium("spaces"), _gymnasium("vector")
Box: Any = _SPACES.Box if _SPACES else OwnBox
Discrete: Any = _SPACES.Discrete if _SPACES else OwnDiscrete
MultiDiscrete: Any = _SPACES.MultiDiscrete if _SPACES else OwnMultiDiscrete
AutoresetMode: Any = getattr(_VECTOR, "AutoresetMode", OwnAutoresetMode)


def batch(space: Any, count: int) -> Any:
    """The space of so many of them: arrays with one row each."""
    if isinstance(space, Discrete):
        return MultiDiscrete(np.full(count, space.n, np.int64))
    tile = (count,) + (1,) * len(space.shape)
    return Box(np.tile(space.low, tile), np.tile(space.high, tile), dtype=space.dtype)
