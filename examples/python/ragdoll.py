"""A ragdoll falls down a slope: capsules tied by ball joints with cones and by hinges with limits."""

from math import pi

from feather_physics import Body, World

DOWN = (0, -1, 0)


def limb(world: World, x: float, y: float, half_height: float, radius: float) -> Body:
    body = world.create_body(position=(x, y, 0), damping=(0.0, 0.1))
    body.add_capsule(half_height, radius, friction=0.8)
    return body


with World() as world:
    world.create_body("static").add_plane(normal=(0.2, 1, 0))

    height = 3.0
    pelvis, chest, head = (limb(world, 0, height + y, h, r) for y, h, r in ((0, 0.05, 0.15), (0.4, 0.12, 0.17), (0.8, 0.04, 0.11)))
    joints = [
        world.create_ball_joint(pelvis, chest, (0, height + 0.2, 0), (0, 1, 0), cone_enabled=True, cone_y=0.4, cone_z=0.4),
        world.create_ball_joint(chest, head, (0, height + 0.65, 0), (0, 1, 0), cone_enabled=True, cone_y=0.7, cone_z=0.7),
    ]
    for side in (-1, 1):
        upper_arm, fore_arm = limb(world, side * 0.26, height + 0.35, 0.12, 0.05), limb(world, side * 0.26, height - 0.02, 0.12, 0.045)
        thigh, shin = limb(world, side * 0.1, height - 0.35, 0.16, 0.07), limb(world, side * 0.1, height - 0.8, 0.16, 0.06)
        joints += [
            world.create_ball_joint(chest, upper_arm, (side * 0.26, height + 0.52, 0), DOWN, cone_enabled=True, cone_y=1.5, cone_z=1.5),
            world.create_hinge_joint(upper_arm, fore_arm, (side * 0.26, height + 0.17, 0), (1, 0, 0), limit_enabled=True, lower=-2.4, upper=0),
            world.create_ball_joint(pelvis, thigh, (side * 0.1, height - 0.12, 0), DOWN, cone_enabled=True, cone_y=pi / 3, cone_z=pi / 4),
            world.create_hinge_joint(thigh, shin, (side * 0.1, height - 0.58, 0), (1, 0, 0), limit_enabled=True, lower=0, upper=2.4),
        ]

    for step in range(241):
        if step % 60 == 0:
            apart = max(joint.state.linear_error for joint in joints)
            x, y, z = head.position
            print(f"{step / 60:3.1f} s  head at {x:5.2f} {y:5.2f} {z:5.2f} m, joints apart by at most {1000 * apart:4.2f} mm")
        world.step()
