"""Random calls with random values of every type: no crash, no hang, no exception but those for wrong arguments. FUZZ_SECONDS=60 for a full run."""

import math
import os
import random
import time
from array import array
from typing import Any, Callable, List

from conftest import header_functions
from test_flat import python_arguments

from feather_physics import Body, Box, Capsule, FeatherError, Material, Part, Plane, Pool, Quat, Sphere, Vec3, World, _flat

SECONDS = float(os.environ.get("FUZZ_SECONDS", "2"))
ALLOWED = (FeatherError, TypeError, ValueError, OverflowError, AttributeError, BufferError, MemoryError, NotImplementedError)  # the last: Python's own memoryviews


class Values:
    """Values of every type, among them handles and worlds that live, lived, or never did."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.kept: List[Any] = []

    def keep(self, value: Any) -> None:
        items = value if isinstance(value, (list, tuple)) else [value]
        for item in items[:4]:
            if item is not None and not isinstance(item, (float, bool)):
                self.kept.append(item)
        if len(self.kept) > 60:
            del self.kept[self.random.randrange(len(self.kept))]

    def number(self) -> Any:
        r = self.random
        return r.choice([0, 1, -1, 2, 0.5, r.uniform(-3, 3), r.random(), 1e9, 1e-9, 1e300, -1e30, math.nan, math.inf, 2**31, 2**64, True])

    def vector(self, count: int = 3) -> Any:
        r = self.random
        if r.random() < 0.7:
            return tuple(r.uniform(-2, 2) for _ in range(count))
        return r.choice([tuple, list])(self.number() for _ in range(r.choice([count, count, 3, 4, 0, 7])))

    def buffer(self) -> Any:
        r = self.random
        code = r.choice("QqfdBi")
        made = array(code, bytes(array(code).itemsize * r.choice([0, 1, 2, 6, 7, 12, 14, 18, 40, 72])))
        handles = [v for v in self.kept if isinstance(v, int) and 0 <= v < 2**63]
        for i in range(len(made)):
            if code in "Qq" and handles:
                made[i] = r.choice(handles)
            elif code in "fd":
                made[i] = r.uniform(-2, 2)
        return r.choice([made, made, memoryview(made), bytes(made)])

    def any(self) -> Any:
        r = self.random
        kind = r.random()
        if kind < 0.45 and self.kept:
            return r.choice(self.kept)
        if kind < 0.6:
            return self.number()
        if kind < 0.75:
            return self.vector(r.choice([3, 3, 4]))
        if kind < 0.85:
            return self.buffer()
        return r.choice([
            None, "", "dynamic", "static", "hit", b"abc", [], {}, object(), Sphere(0.5), Box(1, 1, 1), Capsule(1, 0.5), Plane(), Material(),
            (self.vector(), self.vector(4)), (1, 1, self.buffer()), (2, 2, 1.0, 1.0, array("f", bytes(16)), None, None, None),
            Vec3((1, 2, 3)), Quat((0, 0, 0, 1)), range(3), int, lambda: 1, [_flat.compound_part()],
            [Part(Sphere(0.5), self.vector()), {"geometry": r.choice(self.kept or [None]), "density": self.number()}],
        ])  # fmt: skip


def attempt(call: Callable[..., Any], *arguments: Any) -> Any:
    try:
        return call(*arguments)
    except ALLOWED:
        return None


def test_random_calls_of_the_flat_module() -> None:
    functions = [
        (f.name[3:], getattr(_flat, f.name[3:]), python_arguments(f))
        for f in header_functions()
        if hasattr(_flat, f.name[3:]) and f.name != "fe_pool_create"
    ]
    functions += [(name, getattr(_flat, name), 0) for name in dir(_flat) if name.endswith(("_def", "compound_part"))]
    end = time.process_time() + SECONDS / 2
    seed = 0
    calls = good = 0
    while time.process_time() < end or calls <= 1000:
        seed += 1
        values = Values(seed)
        world = _flat.world_create(None)
        values.kept += [world, world, world]
        for _ in range(3):
            body = _flat.body_create(world, None)
            values.keep([body, _flat.shape_create(world, body, None, _flat.geometry_sphere(0.5))])
        for _ in range(300):
            name, function, count = values.random.choice(functions)
            if name == "world_destroy" and values.random.random() < 0.9:
                continue
            first = world if values.random.random() < 0.85 else values.any()
            wanted = count if values.random.random() < 0.95 else values.random.randrange(6)
            arguments = [first, *(values.any() for _ in range(wanted))]
            result = attempt(function, *arguments[:wanted])
            calls += 1
            if result is not None:
                good += 1
                values.keep(result)
                # fields of whatever came out
                if type(result).__module__ == "_flat" or "def" in name:
                    for field in [f for f in dir(result) if not f.startswith("_")][:6]:
                        attempt(setattr, result, field, values.any())
            if values.random.random() < 0.1:
                attempt(_flat.world_step, world, 1 / 60)
    assert good > calls / 50 and calls > 300


def test_random_calls_of_the_package() -> None:
    end = time.process_time() + SECONDS / 2
    seed = 1000
    calls = good = 0
    while time.process_time() < end or calls <= 1000:
        seed += 1
        values = Values(seed)
        worlds = [World(), World(pool=Pool(2)) if seed % 4 == 0 else World()]
        values.kept += worlds
        for world in worlds:
            body = world.create_body()
            values.keep([body, body.add(Box(1, 1, 1)), world.create_heightfield([[0, 0], [0, 0]])])
            values.keep(world.create_compound([Part(Sphere(0.5)), Part(Box(1, 1, 1), (1, 0, 0))]))
            values.keep(world.create_ball_joint(body, world.create_body(), (0, 0, 0)))
        for _ in range(300):
            target = values.random.choice([v for v in values.kept if isinstance(v, (World, Body)) or hasattr(v, "world")])
            names = [n for n in dir(type(target)) if not n.startswith("_")]
            name = values.random.choice(names)
            if name == "record":  # it writes files of any name
                continue
            if name == "close" and values.random.random() < 0.9:
                continue
            calls += 1
            member = attempt(getattr, target, name)
            if callable(member):
                result = attempt(member, *[values.any() for _ in range(values.random.choice([0, 0, 1, 2, 3, 4]))])
            else:
                attempt(setattr, target, name, values.any())
                result = member
            if result is not None:
                good += 1
                values.keep(result)
        for world in worlds:
            if not world.closed:
                attempt(world.step)
    assert good > calls / 50 and calls > 300
