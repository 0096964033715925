"""What the tests of sweeps run in other processes: they import it, and need no pytest for that."""

import math
import os
import signal
import threading
import time
from pathlib import Path
from typing import Any, Dict, List, Tuple

from feather_physics import InvalidArgumentError, World


def make_world() -> World:
    """A ball that a test drops on six boxes."""
    world = World(number=1)
    world.create_body("static").add_plane()
    for i in range(6):
        world.create_body(position=(0.1 * i, 0.5 + 1.05 * i, 0)).add_box(0.5, 0.5, 0.5)
    return world


def drop(world: World, angle: float) -> int:
    """Of a fresh copy: the hash after 20 steps."""
    ball = world.create_body(position=(3 * math.cos(angle), 2, 3 * math.sin(angle)))
    ball.add_sphere(0.4)
    ball.linear_velocity = (-6 * math.cos(angle), 0, -6 * math.sin(angle))
    for _ in range(20):
        world.step(1 / 60)
    return world.hash


def square(x: int) -> Tuple[int, int]:
    return x, x * x


def add_to(world: World, x: float) -> Tuple[int, float]:
    """Counts bodies: a world that others used would have more."""
    world.create_body(position=(x, 5, 0))
    return world.counters.bodies, x


def fail_from_five(x: int) -> int:
    if x >= 5:
        time.sleep(0.02 * (9 - x))  # later parameters fail sooner
        return x // 0
    return x


def nan_at_three(world: World, x: int) -> float:
    world.create_body(position=(math.nan if x == 3 else x, 0, 0))
    return x


class HardError(Exception):
    """Cannot be made from its args, as unpickling tries."""

    def __init__(self, first: int, second: int) -> None:
        super().__init__(f"{first} and {second}")


def fail_hard(x: int) -> int:
    raise HardError(x, 2)


def give_back_a_lock(x: int) -> Any:
    return threading.Lock() if x == 2 else x


def fail_twice(parameter: Tuple[str, int]) -> int:
    """Its file counts: the third time it succeeds."""
    folder, x = parameter
    with open(Path(folder) / str(x), "a") as file:
        file.write(".")
    if x == 3 and len((Path(folder) / str(x)).read_text()) < 3:
        raise OSError("the network is down")
    return x


def bad_argument(parameter: Tuple[str, int]) -> int:
    with open(Path(parameter[0]) / str(parameter[1]), "a") as file:
        file.write(".")
    raise InvalidArgumentError("no")


def die_once(world: World, parameter: Tuple[str, int]) -> int:
    """The first process that has 17 ends by SIGKILL."""
    folder, x = parameter
    if x == 17:
        try:
            os.open(Path(folder) / "died", os.O_CREAT | os.O_EXCL)
        except FileExistsError:
            pass
        else:
            os.kill(os.getpid(), signal.SIGKILL)
    return drop(world, x)


def die_always(x: int) -> int:
    if x == 6:
        os.kill(os.getpid(), signal.SIGKILL)
    return x


def note(parameter: Tuple[str, int, int]) -> Dict[str, List[int]]:
    """Tells that it ran, and raises at a place."""
    folder, x, stop = parameter
    with open(Path(folder) / "ran", "a") as file:
        file.write(f"{x} ")
    if x == stop:
        raise ValueError("stop")
    return {"x": [x] * 3}


def tell_process(parameter: Tuple[str, int]) -> int:
    """Its process into a file, then a long sleep."""
    (Path(parameter[0]) / f"{os.getpid()}.pid").touch()
    time.sleep(30)
    return 0
