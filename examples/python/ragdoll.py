"""A ragdoll falls down a slope: capsules tied by ball joints with cones and by hinges with limits."""

from math import pi
from typing import List

from feather_physics import Body, Joint, Vector, World

UP, DOWN, SIDEWAYS = (0, 1, 0), (0, -1, 0), (1, 0, 0)
HEIGHT = 3.0


def add_limb(world: World, x: float, y: float, half_height: float, radius: float) -> Body:
    body = world.create_body(position=(x, HEIGHT + y, 0), damping=(0.0, 0.1))
    body.add_capsule(half_height, radius, friction=0.8)
    return body


def tie(world: World, a: Body, b: Body, x: float, y: float, axis: Vector, cone_y: float, cone_z: float) -> Joint:
    """A ball joint at x, y: B swings about the axis, within a cone."""
    return world.create_ball_joint(a, b, (x, HEIGHT + y, 0), axis, cone_enabled=True, cone_y=cone_y, cone_z=cone_z)


def bend(world: World, a: Body, b: Body, x: float, y: float, lower: float, upper: float) -> Joint:
    """A hinge at x, y: an elbow or a knee."""
    return world.create_hinge_joint(a, b, (x, HEIGHT + y, 0), SIDEWAYS, limit_enabled=True, lower=lower, upper=upper)


def add_side(world: World, chest: Body, pelvis: Body, side: int) -> List[Joint]:
    """An arm and a leg; side is -1 or 1."""
    arm, leg = side * 0.26, side * 0.1
    upper_arm, fore_arm = add_limb(world, arm, 0.35, 0.12, 0.05), add_limb(world, arm, -0.02, 0.12, 0.045)
    thigh, shin = add_limb(world, leg, -0.35, 0.16, 0.07), add_limb(world, leg, -0.8, 0.16, 0.06)
    return [
        tie(world, chest, upper_arm, arm, 0.52, DOWN, 1.5, 1.5),
        bend(world, upper_arm, fore_arm, arm, 0.17, -2.4, 0),
        tie(world, pelvis, thigh, leg, -0.12, DOWN, pi / 3, pi / 4),
        bend(world, thigh, shin, leg, -0.58, 0, 2.4),
    ]


with World() as world:
    world.create_body("static").add_plane(normal=(0.2, 1, 0))

    pelvis = add_limb(world, 0, 0, 0.05, 0.15)
    chest = add_limb(world, 0, 0.4, 0.12, 0.17)
    head = add_limb(world, 0, 0.8, 0.04, 0.11)
    joints = [tie(world, pelvis, chest, 0, 0.2, UP, 0.4, 0.4), tie(world, chest, head, 0, 0.65, UP, 0.7, 0.7)]
    for side in (-1, 1):
        joints += add_side(world, chest, pelvis, side)

    for step in range(241):
        if step % 60 == 0:
            apart = 1000 * max(joint.state.linear_error for joint in joints)
            x, y, z = head.position
            print(f"{step / 60:3.1f} s  head at {x:5.2f} {y:5.2f} {z:5.2f} m, joints apart by at most {apart:4.2f} mm")
        world.step()
