"""An arm from a file of ROS picks a cube up and puts it down elsewhere. Its joints are driven by springs: a scene is
data, so stiffness is set before it is built, and each step moves the springs' targets."""

import math
import pathlib
from array import array
from typing import Tuple

from feather_physics import Material, World
from feather_physics.urdf import load_urdf

ARM = pathlib.Path(__file__).parent / "arm.urdf"
STIFFNESS = {"turn": 800, "shoulder": 2000, "elbow": 1500, "wrist": 300, "left": 4000, "right": 4000}  # N m/rad, N/m
JOINTS = list(STIFFNESS)
UPPER, FORE, HAND = 0.4, 0.3, 0.13  # m: shoulder to elbow, to wrist, to the middle of the fingers
SHOULDER = 0.2  # m above the ground
OPEN, CLOSED = 0.03, 0.01  # m, of each finger; the cube of 40 mm stops them at 12.5
HERTZ, REST = 240, 60  # 1/s; steps


def reach(x: float, y: float, z: float, fingers: float) -> Tuple[float, ...]:
    """The joints that bring the fingers there, pointing down (two sides and the angle between them)."""
    out, up = math.hypot(x, y), z + HAND - SHOULDER
    elbow = math.acos((out * out + up * up - UPPER**2 - FORE**2) / (2 * UPPER * FORE))
    shoulder = math.atan2(out, up) - math.atan2(FORE * math.sin(elbow), UPPER + FORE * math.cos(elbow))
    return math.atan2(y, x), shoulder, elbow, math.pi - shoulder - elbow, fingers, fingers


def main() -> None:
    scene = load_urdf(ARM, fixed_base=True)
    for joint in scene.joints:
        joint.stiffness, joint.damping = STIFFNESS[joint.name], 0.03 * STIFFNESS[joint.name]
    with World(gravity=(0, 0, -9.81)) as world:
        rubber = Material(static_friction=1.0, dynamic_friction=1.0)
        world.create_body("static").add_plane(normal=(0, 0, 1), material=rubber)
        cube = world.create_body(position=(0.4, 0, 0.02))
        cube.add_box(0.02, 0.02, 0.02, density=300, material=rubber)
        arm = scene.build(world, group=-1, material=rubber)
        joints = [arm.joints[name] for name in JOINTS]
        now: Tuple[float, ...] = (0.0,) * len(joints)

        def move(seconds: float, *target: float) -> None:
            """From where the targets are to others, at an even rate; then the arm comes to rest."""
            nonlocal now
            steps = round(seconds * HERTZ)
            for i in range(steps + REST):
                part = min(1.0, (i + 1) / steps)
                world.set_joint_targets(joints, array("f", (a + (b - a) * part for a, b in zip(now, target))))
                world.step(1 / HERTZ)
            now = target

        move(2.0, *reach(0.4, 0.0, 0.15, OPEN))
        move(1.0, *reach(0.4, 0.0, 0.02, OPEN))
        move(0.5, *reach(0.4, 0.0, 0.02, CLOSED))
        move(1.0, *reach(0.4, 0.0, 0.15, CLOSED))
        print(f"the cube hangs at {cube.position.z:.2f} m")
        move(2.0, *reach(0.1, 0.35, 0.15, CLOSED))
        move(1.0, *reach(0.1, 0.35, 0.02, CLOSED))
        move(0.5, *reach(0.1, 0.35, 0.02, OPEN))
        move(1.0, *reach(0.1, 0.35, 0.15, OPEN))
        x, y, z = cube.position
        print(f"the cube lies at {x:.2f}, {y:.2f}, {z:.2f} m; {0.1:.2f}, {0.35:.2f}, {0.02:.2f} was asked for")


if __name__ == "__main__":
    main()
