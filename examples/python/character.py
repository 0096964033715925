"""A character walks over hills: a capsule that sweeps move, no rigid body. It slides on walls and stays on ground."""

from math import sin
from typing import Tuple

from feather_physics import Capsule, World

HALF_HEIGHT, RADIUS, SKIN, STEP_DOWN = 0.5, 0.4, 0.01, 0.4
FORM = Capsule(HALF_HEIGHT, RADIUS)
Point = Tuple[float, float, float]


def plus(a: Point, b: Point, scale: float = 1.0) -> Point:
    return a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]


def slide(world: World, position: Point, motion: Point) -> Point:
    """Moves along `motion`; after a hit the rest of it goes on along the surface."""
    for _ in range(4):
        hit = world.sweep(FORM, position, motion)
        if hit is None:
            return plus(position, motion)
        x, y, z = hit.normal
        position = plus(plus(position, motion, hit.fraction), (x, y, z), SKIN)
        rest = plus((0, 0, 0), motion, 1 - hit.fraction)
        into = rest[0] * x + rest[1] * y + rest[2] * z
        motion = plus(rest, (x, y, z), -into)
    return position


with World() as world:
    size = 41
    hills = [[0.5 * sin(column * 0.5) * sin(row * 0.4) for column in range(size)] for row in range(size)]
    world.create_body("static").add(world.create_heightfield(hills), position=(-20, 0, -20))
    world.create_body("static", position=(4, 1, 0)).add_box(0.5, 2, 2)  # a wall in the way

    position: Point = (0.0, 3.0, 0.0)
    for step in range(240):
        position = slide(world, position, (2 / 60, 0, 1 / 60))  # 2 m/s along x, 1 m/s along z
        ground = world.sweep(FORM, position, (0, -STEP_DOWN, 0))
        position = plus(position, (0, -STEP_DOWN, 0), ground.fraction if ground else 1.0)
        if ground:
            position = plus(position, tuple(ground.normal), SKIN)  # type: ignore[arg-type]
        if step % 40 == 0:
            x, y, z = position
            print(f"{step / 60:4.2f} s  at {x:6.2f} {y:6.2f} {z:6.2f} m  {'on the ground' if ground else 'falling'}")
