"""The scene that every language plays, see tests/bindings/scenario.c: prints the same two lines.

python3 scenario.py [workers]
"""

import sys
from array import array
from collections import Counter
from typing import List, Tuple

from feather_physics import Body, Box, Capsule, Heightfield, Sphere, World

BODIES, STEPS, SAMPLES = 300, 600, 17


def place(i: int) -> Tuple[float, float, float]:
    return i % 10 * 1.5 - 6.75, 2.0 + i // 60 * 1.5, i // 10 % 6 * 1.5 - 3.75


def add_terrain(world: World) -> Heightfield:
    heights = [[(row * 7 + column * 3) % 5 * 0.125 for column in range(SAMPLES)] for row in range(SAMPLES)]
    terrain = world.create_heightfield(heights, cell_x=2, cell_z=2)
    world.create_body("static").add(terrain, position=(-16, 0, -16))
    return terrain


def add_joint(world: World, bodies: List[Body], i: int) -> None:
    """Ties body i to its neighbour i + 1, in the middle between the two."""
    a, b, (x, y, z) = bodies[i], bodies[i + 1], place(i)
    middle = (x + 0.75, y, z)
    if i % 10 == 0:
        world.create_ball_joint(a, b, middle, (1, 0, 0))
    elif i % 10 == 4:
        world.create_hinge_joint(a, b, middle, (0, 0, 1), limit_enabled=True, lower=-0.5, upper=0.5)
    elif i % 10 == 7:
        world.create_distance_joint(a, b, place(i), place(i + 1))
    elif i % 10 == 2:
        world.create_fixed_joint(a, b, middle, break_force=8192)


def act(world: World, terrain: Heightfield, bodies: List[Body], step: int, told: "Counter[str]") -> None:
    """What a player would do: shoot, lift, dig, remove."""
    if step % 10 == 0:
        hit = world.raycast((step // 10 % 16 - 7.5, 20, 0.25), (0, -40, 0))
        if hit and hit.body.type == "dynamic":
            told["rays"] += 1
            hit.body.add_impulse((0, 512, 64), hit.point)
        told["overlaps"] += len(world.overlap(Sphere(3), (0, 1, 0)))
    if step == 200:
        terrain.set_heights(7, 7, 3, 3, array("f", [1, 1, 1, 1, 2, 1, 1, 1, 1]))
    if step == 400:
        for body in bodies[60:70]:
            body.destroy()


def main() -> None:
    told: "Counter[str]" = Counter()
    with World(workers=int(sys.argv[1]) if len(sys.argv) > 1 else 1) as world:
        terrain = add_terrain(world)
        forms = (Sphere(0.5), Box(0.5, 0.375, 0.5), Capsule(0.25, 0.375))
        bodies = []
        for i in range(BODIES):
            body = world.create_body(position=place(i))
            body.add(forms[i % 3], events=("touch", "hit") if i % 5 == 0 else ("touch",))
            bodies.append(body)
        world.create_body("kinematic", position=(-10, 1, 0), linear_velocity=(0.5, 0, 0)).add_box(0.5, 1, 4)
        for i in range(BODIES - 1):
            add_joint(world, bodies, i)
        for step in range(STEPS):
            act(world, terrain, bodies, step, told)
            world.step(1 / 60)
            told.update(event.kind for event in world.pair_events)
            told.update(event.kind for event in world.body_events)
            told["hit"] += len(world.hit_events)
            told["break"] += len(world.joint_events)
        print(f"hash {world.hash:016x}")
    print(" ".join(f"{name} {told[name]}" for name in ("enter", "exit", "hit", "sleep", "wake", "break", "rays", "overlaps")))


main()
