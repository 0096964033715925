"""Environments: Gymnasium's vector interface as its documentation has it, tasks that controllers solve, golden hashes."""

from typing import Any, Callable, Dict, List

import numpy as np
import pytest

from feather_physics import InvalidArgumentError, StateError, UnsupportedError, WorldsError
from feather_physics.envs import Draws, VectorEnv
from feather_physics.spaces import AutoresetMode, Box, Discrete, MultiDiscrete, batch
from feather_physics.tasks import TASKS, BallOnPlate, CartPole, Push, Ragdoll

FALL = np.array([0, 1, 0])  # CartPole that is always pushed to one side ends within some 10 steps


# ---- spaces


def test_spaces_hold_what_they_sample() -> None:
    box = Box(np.array([-1, -np.inf], np.float32), np.array([1, 2], np.float32))
    for space in (box, Discrete(3), batch(box, 4), batch(Discrete(3), 4)):
        space.seed(5)
        samples = [space.sample() for _ in range(50)]
        assert all(space.contains(sample) for sample in samples)
        space.seed(5)
        assert all(np.array_equal(space.sample(), sample) for sample in samples)
        assert repr(space)
    assert batch(box, 4).shape == (4, 2) and batch(box, 4).dtype == np.float32
    assert batch(Discrete(3), 4) == MultiDiscrete([3, 3, 3, 3])
    assert not box.contains(np.array([0.0, 3.0], np.float32)) and not Discrete(3).contains(np.int64(3))
    assert box == Box(box.low, box.high) and box != batch(box, 2) and Discrete(3) != Discrete(4)


def test_draws_are_those_of_the_episode() -> None:
    first = Draws(7, 3, 2).uniform(-1, 1, 5)
    assert (first == Draws(7, 3, 2).uniform(-1, 1, 5)).all() and (np.abs(first) < 1).all()
    others = [Draws(8, 3, 2), Draws(7, 4, 2), Draws(7, 3, 3)]
    assert all((first != other.uniform(-1, 1, 5)).all() for other in others)
    integers = Draws(1, 0, 0).integers(6, 6000)
    counts = np.bincount(integers, minlength=6)
    assert counts.sum() == 6000 and (np.abs(counts - 1000) < 5 * np.sqrt(1000)).all()
    # Philox4x64-10 and 53 bits: the same numbers on every machine, with every NumPy
    assert Draws(1, 2, 3).integers(1000, 4).tolist() == DRAWN


DRAWN = [63, 707, 277, 536]


# ---- the interface


def test_the_interface_is_gymnasium_s() -> None:
    with VectorEnv(CartPole(), 5) as env:
        assert env.num_envs == 5 and env.unwrapped is env and env.spec is None
        assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
        assert env.single_observation_space.shape == (4,) and env.single_action_space == Discrete(2)
        assert env.observation_space.shape == (5, 4) and env.action_space == MultiDiscrete([2] * 5)
        with pytest.raises(StateError, match="reset"):
            env.step(np.zeros(5, np.int64))
        observations, infos = env.reset(seed=1)
        assert env.observation_space.contains(observations) and observations.dtype == np.float32 and infos == {}
        kept = observations.copy()
        again = env.step(env.action_space.sample())
        assert (observations == kept).all()  # what was returned stays what it was
        observations, rewards, terminations, truncations, infos = again
        assert env.observation_space.contains(observations) and rewards.shape == (5,) and rewards.dtype == np.float64
        for flags in (terminations, truncations):
            assert flags.shape == (5,) and flags.dtype == bool
        with pytest.raises(InvalidArgumentError, match="shape"):
            env.step(np.zeros(4, np.int64))
        with pytest.raises(InvalidArgumentError, match="seed"):
            env.reset(seed=-1)
        first, _ = env.reset(seed=1)
        assert (first == kept).all()
        second, _ = env.reset()
        assert (second != kept).any()  # the next episode of the same seed
    assert env.closed
    env.close()
    with pytest.raises(InvalidArgumentError, match="autoreset"):
        VectorEnv(CartPole(), 2, autoreset="never")
    unseeded = [VectorEnv(CartPole(), 1).reset()[0] for _ in range(2)]
    assert (unseeded[0] != unseeded[1]).any()


def until_one_falls(env: VectorEnv, actions: Any) -> Any:
    for _ in range(100):
        told = env.step(actions)
        if told[2].any():
            return told
    raise AssertionError("nobody falls")


def test_next_step_begins_anew_in_the_next_step() -> None:
    with VectorEnv(CartPole(), 3) as env:
        env.reset(seed=2)
        observations, rewards, terminations, _, infos = until_one_falls(env, FALL)
        ended = terminations.copy()
        assert (np.abs(observations[ended, 2]) > CartPole.lean).all() and (rewards == 1).all() and infos == {}
        observations, rewards, terminations, truncations, _ = env.step(FALL)
        assert (np.abs(observations[ended]) <= 0.051).all()  # as at the begin
        assert (rewards[ended] == 0).all() and not (terminations | truncations)[ended].any()
        assert (rewards[~ended] == 1).all()


def test_same_step_tells_what_was_last_seen() -> None:
    with VectorEnv(CartPole(), 3, autoreset="same_step") as env:
        assert env.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
        env.reset(seed=2)
        observations, rewards, terminations, _, infos = until_one_falls(env, FALL)
        assert (rewards == 1).all() and (infos["_final_obs"] == terminations).all()
        for i in range(3):
            if terminations[i]:
                assert abs(infos["final_obs"][i][2]) > CartPole.lean and abs(observations[i, 2]) < 0.06
            else:
                assert infos["final_obs"][i] is None


def test_disabled_waits_for_a_reset() -> None:
    with VectorEnv(CartPole(), 3, autoreset="disabled") as env:
        env.reset(seed=2)
        observations, _, terminations, _, _ = until_one_falls(env, FALL)
        with pytest.raises(StateError, match="ended"):
            env.step(FALL)
        renewed, _ = env.reset(options={"reset_mask": terminations})
        assert (renewed[~terminations] == observations[~terminations]).all()
        assert (np.abs(renewed[terminations]) <= 0.051).all()
        env.step(FALL)
        for mask in (np.zeros(3, bool), np.ones(2, bool), np.ones(3)):
            with pytest.raises(InvalidArgumentError, match="reset_mask"):
                env.reset(options={"reset_mask": mask})


def test_episodes_are_cut_at_their_limit() -> None:
    task = CartPole()
    task.limit = 5
    with VectorEnv(task, 2) as env:
        env.reset(seed=4)
        for step in range(12):
            _, _, terminations, truncations, _ = env.step(np.array([step % 2, 1 - step % 2]))
            assert not terminations.any() and (truncations == (step % 6 == 4)).all()


def episode(count: int, which: int, **settings: Any) -> List[int]:
    """Hashes of one world among so many, whose actions are its own."""
    with VectorEnv(Push(), count, **settings) as env:
        env.reset(seed=9)
        found = []
        own = [Draws(1, i, 0) for i in range(count)]
        for _ in range(40):
            env.step(np.array([draws.uniform(-1, 1, 2) for draws in own]))
            found.append(env.worlds.hashes()[which])
        return found


def test_an_episode_is_the_same_among_any_number() -> None:
    wanted = episode(3, 2)
    assert episode(17, 2, workers=3) == wanted and episode(5, 2, simd="plain") == wanted
    assert episode(3, 1) != wanted


def test_what_fails_is_told() -> None:
    with VectorEnv(BallOnPlate(), 3) as env:
        env.reset(seed=1)
        actions = np.zeros((3, 2))
        actions[1, 0] = np.nan
        with pytest.raises(WorldsError, match="1 of 3"):
            env.step(actions)
    with pytest.raises(InvalidArgumentError):
        VectorEnv(CartPole(), 0)


# ---- tasks


def balance(o: Any) -> Any:
    return (o[:, 2] + 0.25 * o[:, 3] + 0.03 * o[:, 0] + 0.08 * o[:, 1] > 0).astype(np.int64)


def centre(o: Any) -> Any:
    return np.stack([-2 * o[:, 1] - 1.5 * o[:, 3], 2 * o[:, 0] + 1.5 * o[:, 2]], axis=1)


def herd(o: Any) -> Any:
    """Goes behind the box, seen from the goal, and pushes."""
    to_goal = o[:, 8:10] - o[:, 2:4]
    distance = np.linalg.norm(to_goal, axis=1, keepdims=True)
    ahead = to_goal / np.maximum(distance, 1e-6)
    side = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    from_box = o[:, 0:2] - o[:, 2:4]
    along = (from_box * ahead).sum(axis=1, keepdims=True)
    across = (from_box * side).sum(axis=1, keepdims=True)
    push = ahead * np.minimum(1, 2 * distance + 0.15) - 4 * side * across
    line_up = -ahead * np.where(along > -0.45, 0.7, 0) - side * np.clip(6 * across, -1, 1)
    go_round = np.where(np.abs(across) < 0.5, 0.8 * side * np.where(across >= 0, 1.0, -1.0), -ahead)
    is_behind = along < -0.2
    return np.clip(np.where(is_behind, np.where(np.abs(across) < 0.05, push, line_up), go_round), -1, 1)


def stand(o: Any) -> Any:
    actions = np.zeros((len(o), 10))
    actions[:, [5, 9]] = -(2 * o[:, 1:2] + 0.5 * o[:, 3:4])  # ankles, by lean and speed to the front
    return actions


def play(task: Any, control: Callable[[Any], Any], steps: int, count: int = 16) -> Any:
    """First ends (steps where none), and the last observations"""
    ends = np.full(count, steps)
    with VectorEnv(task, count) as env:
        observations, _ = env.reset(seed=3)
        for step in range(steps):
            observations, _, terminations, _, _ = env.step(control(observations))
            ends = np.where(terminations & (ends == steps), step, ends)
    return ends, observations


def test_a_linear_controller_keeps_the_pole_upright() -> None:
    ends, _ = play(CartPole(), balance, 499)
    assert (ends == 499).all()
    ends, _ = play(CartPole(), lambda o: np.ones(len(o), np.int64), 499)
    assert (ends < 30).all()  # and no controller does not


def test_the_ball_comes_to_the_middle() -> None:
    ends, observations = play(BallOnPlate(), centre, 599)
    assert (ends == 599).all() and (np.hypot(observations[:, 0], observations[:, 1]) < 0.02).all()


def test_the_box_comes_to_its_goal() -> None:
    ends, _ = play(Push(), herd, 599)
    assert (ends < 599).all()


def test_the_ragdoll_stands() -> None:
    ends, observations = play(Ragdoll(), stand, 300)
    assert (ends == 300).all() and (observations[:, 0] > 1.2).all()


GOLDEN: Dict[str, int] = {
    "BallOnPlate": 0x55C0A4A697736B6C,
    "CartPole": 0xE02C34B0EBD55290,
    "Push": 0x2C7E19237C4AD85E,
    "Ragdoll": 0xF731C85DF99A0097,
    "Walker": 0xA18D43F37A52F4BF,
}


@pytest.mark.parametrize("name", sorted(TASKS))
@pytest.mark.parametrize("workers, simd", [(1, "auto"), (2, "plain")])
def test_random_steps_have_golden_hashes(name: str, workers: int, simd: str) -> None:
    with VectorEnv(TASKS[name](), 3, workers=workers, simd=simd) as env:
        observations, _ = env.reset(seed=11)
        assert env.observation_space.contains(observations)
        draws = Draws(12, 0, 0)
        for _ in range(1000):
            if isinstance(env.single_action_space, Discrete):
                actions = draws.integers(int(env.single_action_space.n), 3)
            else:
                actions = draws.uniform(-1, 1, 3 * env.single_action_space.shape[0]).reshape(env.action_space.shape)
            observations = env.step(actions)[0]
            assert np.isfinite(observations).all()
        first, second, third = env.worlds.hashes()
        assert first ^ second ^ third == GOLDEN[name], f"{name}: 0x{first ^ second ^ third:016x}"


def test_a_world_with_a_filter_is_no_template() -> None:
    class Filtered(CartPole):
        def build(self) -> Any:
            world = super().build()
            world.set_pair_filter(lambda pair: True)
            return world

    with pytest.raises(UnsupportedError, match="filter"):
        VectorEnv(Filtered(), 2)
