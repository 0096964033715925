"""What the tests of robots share."""

import json
import math
from typing import Any, Dict, List

import numpy as np

from feather_physics.frames import matrix_of, multiply, rotate
from feather_physics.scene import Scene, SceneBody


def in_world(body: SceneBody) -> np.ndarray:
    """The inertia about the centre, along the axes of the world."""
    return np.array(matrix_of(body.inertia, multiply(body.rotation, body.inertia_rotation)))


def compare_bodies(mine: Dict[str, SceneBody], wanted: List[Any]) -> int:
    """Frames, masses, centres and inertias beside the referee's; how many bodies with a mass."""
    count = 0
    for theirs in wanted:
        body = mine[theirs["name"]]
        assert np.allclose(body.position, theirs["position"], rtol=0, atol=1e-5), body.name
        w, x, y, z = theirs["rotation"]
        assert abs(abs(np.dot(body.rotation, (x, y, z, w))) - 1) < 1e-10, body.name
        if body.type == "static" or body.mass is None:
            continue
        count += 1
        centre = np.add(body.position, rotate(body.rotation, body.centre))
        axes = np.array(theirs["axes"]).reshape(3, 3)
        tensor = axes @ np.diag(theirs["inertia"]) @ axes.T
        assert abs(body.mass - theirs["mass"]) < 1e-5 * max(1, body.mass), body.name
        assert np.allclose(centre, theirs["centre"], rtol=0, atol=1e-5), body.name
        assert np.allclose(in_world(body), tensor, rtol=0, atol=1e-5 * np.abs(tensor).max()), body.name
    return count


def near(a: Any, b: Any) -> bool:
    """Equal but for rounding."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(near(a[k], b[k]) for k in a)
    if isinstance(a, list):
        return len(a) == len(b) and all(map(near, a, b))
    return math.isclose(a, b, rel_tol=0, abs_tol=1e-11) if isinstance(a, float) and isinstance(b, float) else a == b


def plain(scene: Scene) -> Any:
    """As records in which nothing stands twice: bodies, meshes and principal axes may stand in another order, a turn has
    two quaternions."""
    record = json.loads(scene.to_json())
    for kind in ("bodies", "joints", "meshes", "frames"):
        record[kind].sort(key=lambda one: one["name"])
    for body in record["bodies"]:
        q = multiply(body["rotation"], body.pop("inertia_rotation"))
        body["tensor"] = matrix_of(body.pop("inertia"), q)
        for held in (body, *body["shapes"]):
            held["matrix"] = matrix_of((1, 2, 3), held.pop("rotation"))
    for turned in (*record["joints"], *record["frames"]):
        turned["matrix"] = matrix_of((1, 2, 3), turned.pop("rotation"))
    return record
