"""A gun that hits at once: a ray finds the target, an impulse pushes it. The shooter's own body does not count."""

from math import cos, sin

from feather_physics import World

with World() as world:
    world.create_body("static").add_plane()
    shooter = world.create_body("static", position=(0, 1, 0), user_data="shooter")
    shooter.add_capsule(0.5, 0.4)
    for i in range(8):
        can = world.create_body(position=(6 * cos(i * 0.3 - 1), 0.3, 6 * sin(i * 0.3 - 1)), user_data=f"can {i}")
        can.add_capsule(0.1, 0.2, density=100)

    for step in range(240):
        if step % 20 == 10:
            angle = step / 240 * 2.4 - 1
            aim = 50 * cos(angle), -5.0, 50 * sin(angle)
            hit = world.raycast((0, 1, 0), aim, exclude=shooter)
            if hit and hit.body.type == "dynamic":
                hit.body.add_impulse((aim[0] * 0.2, 5, aim[2] * 0.2), hit.point)
                print(f"{step / 60:4.2f} s  {hit.body.user_data} hit at {hit.fraction * 50:5.2f} m")
            else:
                print(f"{step / 60:4.2f} s  missed")
        world.step()
