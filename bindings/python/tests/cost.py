"""What a call costs from Python: the flat module, the package's objects, and ctypes on the same library, ns a call; the best of some rounds.

PYTHONPATH=build/python python3 bindings/python/tests/cost.py [build folder]
"""

import ctypes
import sys
import timeit
from array import array
from typing import Any, Callable

from feather_physics import World, _flat

CALLS, ROUNDS = 100_000, 7


def cost(name: str, call: Callable[[], Any], calls: int = CALLS, items: int = 1) -> float:
    """Without the cost of the lambda around the call."""
    empty = min(timeit.repeat(lambda: None, number=calls, repeat=ROUNDS))
    spent = (min(timeit.repeat(call, number=calls, repeat=ROUNDS)) - empty) / calls / items * 1e9
    print(f"{name} {spent:.1f}")
    return spent


def main() -> None:
    folder = sys.argv[1] if len(sys.argv) > 1 else "build"
    with World() as world:
        body = world.create_body()
        body.add_sphere(0.5)
        w, b = world._capsule, body.id
        ray, down, still = (0.0, 9.0, 0.0), (0.0, -20.0, 0.0), (0.0, 0.0, 0.0)
        is_valid, position, mass, set_velocity = _flat.body_is_valid, _flat.body_get_position, _flat.body_get_mass, _flat.body_set_linear_velocity
        cost("flat_is_valid", lambda: is_valid(w, b))
        cost("flat_get_mass", lambda: mass(w, b))
        cost("flat_get_position", lambda: position(w, b))
        cost("flat_set_velocity", lambda: set_velocity(w, b, still))
        cost("flat_raycast", lambda: _flat.world_raycast(w, ray, down, None, world), CALLS // 10)
        cost("body.position", lambda: body.position)
        cost("body.mass", lambda: body.mass)
        cost("world.raycast", lambda: world.raycast(ray, down), CALLS // 10)
        other = world.create_body()
        cost("world.raycast_excluding_one", lambda: world.raycast(ray, down, exclude=other), CALLS // 10)
        world.create_bodies([still] * 9998)
        ids, bodies, out = world.body_ids(), world.bodies, array("f", bytes(28 * 10_000))
        cost("bulk_10000_transforms", lambda: world.transforms(out, bodies=ids), 100, 10_000)
        cost("bulk_10000_transforms_of_a_list_of_Body", lambda: world.transforms(out, bodies=bodies), 100, 10_000)

    library = ctypes.CDLL(f"{folder}/libfeather.so")
    pointer, handle = ctypes.c_void_p(), ctypes.c_ulonglong()
    library.fe_world_create(None, ctypes.byref(pointer))
    library.fe_body_create(pointer, None, ctypes.byref(handle))
    library.fe_body_is_valid.argtypes = (ctypes.c_void_p, ctypes.c_ulonglong)
    library.fe_body_get_transform.argtypes = (ctypes.c_void_p, ctypes.c_ulonglong, ctypes.c_void_p)
    native, number, transform = pointer.value, handle.value, (ctypes.c_double * 5)()
    place = ctypes.byref(transform)
    cost("ctypes_is_valid", lambda: library.fe_body_is_valid(native, number))
    cost("ctypes_get_transform", lambda: (library.fe_body_get_transform(native, number, place), transform[0], transform[1], transform[2]))


main()
