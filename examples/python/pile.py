"""A pile of balls and boxes, drawn to pile.png with matplotlib. The poses of all bodies come in one call.

python3 pile.py [picture]
"""

import sys

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse, Polygon

from feather_physics import World

COUNT = 120
picture = sys.argv[1] if len(sys.argv) > 1 else "pile.png"

with World(workers=2) as world:
    world.create_body("static").add_plane()
    for side in (-4, 4):
        world.create_body("static").add_plane(normal=(-side / 4, 0, 0), distance=-4)
    # locked to the plane of the picture: along z, and about x and y
    bodies = world.create_bodies([(i % 8 - 3.5 + i % 3 * 0.1, 1 + i // 8, 0) for i in range(COUNT)], locks=("z", "xy"))
    for i, body in enumerate(bodies):
        body.add_sphere(0.4) if i % 2 else body.add_box(0.45, 0.3, 0.3)
    for _ in range(300):
        world.step()

    poses = np.zeros((COUNT, 7), np.float32)
    world.transforms(poses, bodies=bodies)
    speed = np.linalg.norm(np.asarray(world.velocities(bodies=bodies))[:, :3], axis=1)
    print(f"{COUNT} bodies, the highest at {poses[:, 1].max():.2f} m, the fastest at {speed.max():.3f} m/s")

figure = Figure(figsize=(6, 6))
axes = Axes(figure, (0.1, 0.1, 0.85, 0.85))
figure.add_axes(axes)
corners = np.array([[-0.45, -0.3], [0.45, -0.3], [0.45, 0.3], [-0.45, 0.3]])
for i, (x, y, _, _, _, qz, qw) in enumerate(poses):
    if i % 2:
        axes.add_patch(Ellipse((x, y), 0.8, 0.8, facecolor="tab:blue", edgecolor="black"))
    else:
        angle = 2 * np.arctan2(qz, qw)
        rotation = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        axes.add_patch(Polygon(corners @ rotation + [x, y], facecolor="tab:orange", edgecolor="black"))
axes.plot([-4, -4, 4, 4], [12, 0, 0, 12], color="black")
axes.set_aspect("equal")
figure.savefig(picture, dpi=100)
print(f"drawn to {picture}")
