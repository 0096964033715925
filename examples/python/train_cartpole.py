"""Learns to keep a pole on a cart upright: the cross-entropy method (Rubinstein 1999) over the four weights of a linear
policy. Each of 64 worlds tries one policy at once; the best eight say where the next 64 are drawn."""

import time
from typing import Any

import numpy as np

from feather_physics.envs import VectorEnv
from feather_physics.tasks import CartPole

WORLDS, BEST, GENERATIONS = 64, 8, 12


def returns(env: VectorEnv, weights: Any, seed: int) -> Any:
    """What each world's policy earns in one episode."""
    observations, _ = env.reset(seed=seed)
    earned, running = np.zeros(env.num_envs), np.ones(env.num_envs, bool)
    while running.any():
        actions = ((observations * weights).sum(axis=1) > 0).astype(np.int64)
        observations, rewards, terminations, truncations, _ = env.step(actions)
        earned += rewards * running
        running &= ~(terminations | truncations)
    return earned


def main() -> None:
    random, start = np.random.default_rng(1), time.perf_counter()
    mean, spread = np.zeros(4), np.ones(4)
    with VectorEnv(CartPole(), WORLDS, workers=2) as env:
        for generation in range(GENERATIONS):
            weights = mean + spread * random.standard_normal((WORLDS, 4))
            earned = returns(env, weights, generation)
            best = weights[np.argsort(earned)[-BEST:]]
            mean, spread = best.mean(axis=0), best.std(axis=0) + 0.02
            print(f"generation {generation + 1:2}: mean return {earned.mean():5.1f}, best {earned.max():.0f}")
            if earned.mean() > 490:
                break
        final = returns(env, np.tile(mean, (WORLDS, 1)), 1000)
    took = time.perf_counter() - start
    print(f"the mean of the best: {final.mean():.1f} of 500 in {WORLDS} new episodes, {took:.1f} s")


if __name__ == "__main__":
    main()
