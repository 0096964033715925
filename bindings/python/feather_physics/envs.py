"""Worlds as environments to learn in: VectorEnv steps as many as there are with one call, by arrays, as Gymnasium's
vector interface does. Gymnasium is not needed, NumPy is. Tasks are in tasks.py.

    env = VectorEnv(CartPole(), 1024, workers=4)
    observations, _ = env.reset(seed=1)
    observations, rewards, terminations, truncations, infos = env.step(env.action_space.sample())
"""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from .errors import InvalidArgumentError, StateError
from .objects import Body
from .spaces import AutoresetMode, batch
from .world import World
from .worlds import Worlds

MODES = {"next_step": AutoresetMode.NEXT_STEP, "same_step": AutoresetMode.SAME_STEP, "disabled": AutoresetMode.DISABLED}
UNIT = 2.0**-53  # of 53 random bits


class Draws:
    """Random numbers of one episode: they depend on its seed, its world and its number alone. So an episode is the same
    with any number of worlds and workers, on every machine: Philox (Salmon et al. 2011) is integers, and so is this."""

    def __init__(self, seed: int, world: int, episode: int):
        self._bits = np.random.Philox(key=[seed, world], counter=[0, 0, 0, episode])

    def uniform(self, low: float, high: float, count: int) -> Any:
        """So many numbers between low and high."""
        return low + (high - low) * ((self._bits.random_raw(count) >> np.uint64(11)) * UNIT)

    def integers(self, n: int, count: int) -> Any:
        """So many integers from 0 on, below n < 2^32."""
        high = self._bits.random_raw(count) >> np.uint64(32)
        return ((high * np.uint64(n)) >> np.uint64(32)).astype(np.int64)


class Task:
    """What there is to learn. A subclass sets these, and has the methods below; tasks.py shows how."""

    dt: float = 1 / 60  # s, of a step of the world
    steps: int = 1  # of the world for each action
    limit: int = 1000  # actions, after which an episode is cut short (truncated)
    observation_space: Any  # of one world: see feather_physics.spaces
    action_space: Any  # of one world

    def build(self) -> World:
        """The world that all are clones of."""
        raise NotImplementedError

    def bind(self, env: "VectorEnv") -> None:
        """Asks for the arrays that act() and observe() need, by env.input() and env.output()."""
        raise NotImplementedError

    def begin(self, env: "VectorEnv", which: Any, draws: Sequence[Draws]) -> None:
        """Puts worlds (indices), which are as build() made them, to the begin of an episode, by env.write()."""

    def act(self, actions: Any) -> None:
        """Fills the inputs."""
        raise NotImplementedError

    def observe(self) -> Any:
        """Of the outputs, a row of float32 for each world."""
        raise NotImplementedError

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        """Rewards, and which episodes have ended (terminated), of the outputs."""
        raise NotImplementedError


class VectorEnv:
    """So many worlds of a task, of Gymnasium's vector interface: https://gymnasium.farama.org/api/vector/

    autoreset says when a world whose episode has ended begins anew: "next_step" (in the next step, whose action does
    not count for it), "same_step" (at once; info["final_obs"] has what was last seen), "disabled" (by
    reset(options={"reset_mask": mask}), before it is stepped again)."""

    spec = None  # Gymnasium's, of registered environments
    render_mode = None  # pictures are world.picture()'s

    def __init__(
        self, task: Task, num_envs: int = 1, *, workers: int = 1, simd: str = "auto", autoreset: str = "next_step"
    ):
        if autoreset not in MODES:
            raise InvalidArgumentError(f"autoreset: one of {', '.join(MODES)} is needed, not {autoreset!r}")
        self.task = task  # what is learnt
        self.num_envs = num_envs  # worlds
        self.metadata: Dict[str, Any] = {"autoreset_mode": MODES[autoreset], "render_modes": []}  # Gymnasium's
        self.single_observation_space = task.observation_space  # of one world
        self.single_action_space = task.action_space  # of one world
        self.observation_space = batch(task.observation_space, num_envs)  # of all: a row each
        self.action_space = batch(task.action_space, num_envs)  # of all: a row each
        self.world = task.build()  # the one that all are clones of
        self.worlds = Worlds(self.world, num_envs, workers=workers, simd=simd)  # the clones
        self.closed = False  # True after close()
        self._mode = MODES[autoreset]
        self._outputs: List[Tuple[str, Optional[Sequence[Any]], Any, Optional[Body]]] = []
        self._seed: Optional[int] = None
        self._episodes = np.zeros(num_envs, np.int64)
        self._ages = np.zeros(num_envs, np.int64)
        self._ended = np.zeros(num_envs, bool)
        task.bind(self)

    # ---- for tasks

    def input(self, field: str, items: Optional[Sequence[Any]] = None) -> Any:
        """An array of float64 (worlds, items, numbers) that each step reads, see Worlds.input()."""
        out = np.asarray(self.worlds.array(field, items, double=True))
        return np.asarray(self.worlds.input(field, items, out))

    def output(self, field: str, items: Optional[Sequence[Any]] = None, relative_to: Optional[Body] = None) -> Any:
        """An array of float32 that is filled by each step and each reset, see Worlds.output()."""
        out = np.asarray(self.worlds.output(field, items, relative_to=relative_to))
        self._outputs.append((field, items, out, relative_to))
        return out

    def write(self, field: str, items: Optional[Sequence[Any]], which: Any, rows: Any) -> None:
        """Writes a field of some worlds (indices): rows of shape (len(which), items, numbers)."""
        values = np.asarray(self.worlds.array(field, items, double=True))
        values[which] = rows
        mask = np.zeros(self.num_envs, np.uint8)
        mask[which] = 1
        self.worlds.write(field, items, values, mask=mask)

    # ---- Gymnasium's interface

    def reset(
        self, *, seed: Union[int, None] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[Any, Dict[str, Any]]:
        """All worlds, or those of options["reset_mask"], begin an episode. A seed begins their episodes anew; without
        one the next ones follow."""
        mask = (options or {}).get("reset_mask")
        which = np.arange(self.num_envs) if mask is None else np.flatnonzero(self._checked(mask))
        if seed is not None:
            if not 0 <= seed < 2**64:
                raise InvalidArgumentError(f"seed: 0 to 2^64 - 1 is needed, not {seed}")
            self._seed = seed
            self._episodes[which] = 0
        if self._seed is None:
            self._seed = int(np.random.SeedSequence().generate_state(1, np.uint64)[0])
        self._begin(which)
        return self.task.observe(), {}

    def step(self, actions: Any) -> Tuple[Any, Any, Any, Any, Dict[str, Any]]:
        """Observations, rewards, terminations, truncations, infos."""
        if self._seed is None:
            raise StateError("step: reset() comes first")
        actions = np.asarray(actions)
        if actions.shape != self.action_space.shape:
            raise InvalidArgumentError(f"actions: shape {self.action_space.shape} is needed, not {actions.shape}")
        renewed = self._ended.copy()
        if self._mode is AutoresetMode.DISABLED and renewed.any():
            raise StateError(f"step: the episode of world {int(np.argmax(renewed))} has ended; reset it")
        self.task.act(actions)
        going = ~renewed
        self.worlds.step(self.task.dt, self.task.steps, going.astype(np.uint8) if renewed.any() else None)
        if renewed.any():
            self._begin(np.flatnonzero(renewed))
        self._ages[going] += 1
        rewards, ended = self.task.judge(actions)
        rewards = np.where(going, rewards, 0.0)
        terminations = ended & going
        truncations = (self._ages >= self.task.limit) & going & ~terminations
        self._ended = terminations | truncations
        observations = self.task.observe()
        infos: Dict[str, Any] = {}
        if self._mode is AutoresetMode.SAME_STEP and self._ended.any():
            infos = self._final(observations)
            self._begin(np.flatnonzero(self._ended))
            observations = self.task.observe()
        return observations, rewards, terminations, truncations, infos

    def _final(self, observations: Any) -> Dict[str, Any]:
        seen = np.full(self.num_envs, None, object)
        for i in np.flatnonzero(self._ended):
            seen[i] = observations[i].copy()
        ended = self._ended.copy()
        return {"final_obs": seen, "_final_obs": ended, "final_info": {}, "_final_info": ended.copy()}

    def _checked(self, mask: Any) -> Any:
        given = np.asarray(mask)
        if given.dtype != bool or given.shape != (self.num_envs,) or not given.any():
            raise InvalidArgumentError(f"reset_mask: {self.num_envs} booleans are needed, and one of them true")
        return given

    def _begin(self, which: Any) -> None:
        mask = np.zeros(self.num_envs, np.uint8)
        mask[which] = 1
        self.worlds.reset(mask)
        seed = self._seed or 0
        self.task.begin(self, which, [Draws(seed, int(i), int(self._episodes[i])) for i in which])
        self._episodes[which] += 1
        self._ages[which] = 0
        self._ended[which] = False
        for field, items, out, relative_to in self._outputs:
            self.worlds.read(field, items, out, relative_to=relative_to)

    def close(self) -> None:
        """Destroys the worlds. Closing again does nothing."""
        if not self.closed:
            self.worlds.close()
            self.world.close()
            self.closed = True

    @property
    def unwrapped(self) -> "VectorEnv":
        """Itself."""
        return self

    def __enter__(self) -> "VectorEnv":
        return self

    def __exit__(self, *error: Any) -> None:
        self.close()
