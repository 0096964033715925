#!/usr/bin/env python3
"""Draws the table of index.mjs: how many times Feather's step each engine takes, scene by scene.

node index.mjs | ./plot.py ../../docs/plots/web.svg
Needs matplotlib.
"""

import re
import sys

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

NAMES = {"feather": "Feather", "rapier": "Rapier", "havok": "Havok", "jolt": "Jolt", "physx": "PhysX"}
COLOURS = {"feather": "#1b6ca8", "rapier": "#c0672b", "havok": "#7a9e3a", "jolt": "#8d6cab", "physx": "#777777"}
MOST = 10.0  # times Feather's; longer bars end there and say their number


def read(lines: list[str]) -> tuple[list[str], dict[str, list[float]]]:
    """The names of the scenes, and each engine's ratios."""
    rows = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in lines if line.startswith("|")]
    scenes = rows[0][1:-1]
    ratios = {row[0]: [float(re.findall(r"\(([\d.]+)\)", cell)[0]) for cell in row[1:-1]] for row in rows[2:]}
    return scenes, {name: ratios[name] for name in NAMES if name in ratios}


def draw(scenes: list[str], ratios: dict[str, list[float]]) -> Figure:
    figure = Figure(figsize=(8, 5.5))
    axes = Axes(figure, (0.13, 0.1, 0.84, 0.8))
    figure.add_axes(axes)
    height = 0.8 / len(ratios)
    for k, (name, of) in enumerate(ratios.items()):
        places = [i + k * height for i in range(len(scenes))]
        axes.barh(places, [min(r, MOST) for r in of], height * 0.9, label=NAMES[name], color=COLOURS[name])
        for place, ratio in zip(places, of):
            axes.text(min(ratio, MOST) + 0.05, place, f"{ratio:.1f}", va="center", fontsize=7)
    axes.set_yticks([i + 0.4 - height / 2 for i in range(len(scenes))], scenes)
    axes.invert_yaxis()
    axes.set_xlim(0, MOST + 0.8)
    axes.set_title("Processor time of a step in node, as multiples of Feather's at 4 substeps", fontsize=10)
    axes.legend(loc="lower right", fontsize=8)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    matplotlib.rcParams.update(
        {"svg.hashsalt": "feather", "svg.fonttype": "none"}
    )  # the same small file of the same table
    draw(*read(sys.stdin.readlines())).savefig(sys.argv[1], metadata={"Date": None})
