"""A box falls on the ground: the smallest whole program."""

from feather_physics import World

with World(gravity=(0, -9.81, 0)) as world:
    world.create_body("static").add_plane()  # the ground: y <= 0
    box = world.create_body(position=(0, 4, 0))
    box.add_box(0.5, 0.5, 0.5)  # a cube of 1 m
    for step in range(91):
        if step % 15 == 0:
            print(f"{step / 60:4.2f} s  y = {box.position.y:6.4f} m")
        world.step(1 / 60)
