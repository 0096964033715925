"""Rocks, which are convex hulls, roll down a valley, which is a mesh of triangles."""

from random import Random

from feather_physics import World

CELLS = 16


def height(x: int, z: int) -> float:
    """A bowl with bumps, m."""
    return (x * x + z * z) / 16 + (x * 5 + z * 7) % 4 / 8


draw = Random(1).uniform
middle = CELLS // 2
places = range(-middle, middle + 1)
vertices = [(x, height(x, z), z) for z in places for x in places]
triangles = []
for row in range(CELLS):
    for column in range(CELLS):
        a = row * (CELLS + 1) + column
        b, c, d = a + 1, a + CELLS + 1, a + CELLS + 2
        triangles += [(a, c, d), (a, d, b)]  # counterclockwise seen from above: only that side counts

with World() as world:
    world.create_body("static").add(world.create_mesh(vertices, triangles))
    kinds = []
    for _ in range(3):
        kind = world.create_hull([(draw(-0.6, 0.6), draw(-0.4, 0.4), draw(-0.5, 0.5)) for _ in range(24)])
        info = kind.info
        print(f"a rock of {info.vertex_count} vertices and {info.face_count} faces, {info.volume:.3f} m3")
        kinds.append(kind)
    rocks = []
    for i in range(24):
        rock = world.create_body(position=(5 - 2 * (i % 6), 8 + 0.5 * i, 4 - 2.5 * (i // 6)))
        rock.add(kinds[i % 3])
        rocks.append(rock)
    for _ in range(360):
        world.step()
    hit = world.raycast((7.25, 20, 0.5), (0, -30, 0))
    if hit:
        print(f"triangle {hit.triangle} of the valley at {hit.point.y:.3f} m")
    print(f"the lowest rock lies at {min(rock.position.y for rock in rocks):.2f} m")
