"""400 worlds on Dask's workers: where does a ball that is thrown into a wall of boxes come to rest?

    python3 sweep_dask.py                         two worker processes on this machine
    python3 sweep_dask.py tcp://192.168.0.7:8786  the workers of a scheduler, which must have the same feather_physics

The results are those of a loop, bit for bit, whatever the workers.
"""

import math
import sys
from typing import Any, Tuple

from feather_physics import World, sweep

THROWS = [(2 * math.pi * i / 400, 8 + i % 5) for i in range(400)]  # where from, rad; m/s


def wall() -> World:
    world = World()
    world.create_body("static").add_plane()
    for i in range(12):
        world.create_body(position=(0.9 * (i % 4) - 1.35, 0.4 + 0.8 * (i // 4), 0)).add_box(0.4, 0.4, 0.4)
    return world


def throw(world: World, parameter: Tuple[float, float]) -> Tuple[float, float, int]:
    """x and z of the ball after a second, and the world's hash."""
    angle, speed = parameter
    x, z = math.cos(angle), math.sin(angle)
    ball = world.create_body(position=(4 * x, 1, 4 * z))
    ball.add_sphere(0.3)
    ball.linear_velocity = (-speed * x, 1, -speed * z)
    for _ in range(60):
        world.step()
    return ball.position.x, ball.position.z, world.hash


def main() -> None:
    if len(sys.argv) > 1:
        found = sweep(throw, THROWS, world=wall(), executor=sys.argv[1], progress=True)
    else:
        import distributed

        dask: Any = distributed  # it has no types
        cluster = dask.LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None)
        with cluster, dask.Client(cluster) as client:
            found = sweep(throw, THROWS, world=wall(), executor=client, progress=True)
    far = max(range(len(found)), key=lambda i: math.hypot(*found[i][:2]))
    print(f"the throw that ends farthest: {far}, {math.hypot(*found[far][:2]):.2f} m from the middle")
    if found != sweep(throw, THROWS, world=wall()):
        sys.exit("these are NOT the results of a loop")
    print("the results are those of a loop")


if __name__ == "__main__":
    main()
