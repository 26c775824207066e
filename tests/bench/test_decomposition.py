# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The vessel that bench/decomposition.py cuts: its volume and area in closed form, and who has what."""
import math
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench"))
import decomposition as d    # noqa: E402
from facts import fact    # noqa: E402


def near(name, a, b, most):
    fact(name, abs(a - b) <= most * abs(b), f"{a:.6g}, {b:.6g}")


def test_vessel():
    # A cone of height 2 from radius 1 to 3, and in it a pipe of radius 0.5.
    cone, pipe = np.array([[1., 0.], [3., 2.]]), np.array([[.5, 0.], [.5, 2.]])
    # The trapezoidal rule with 200 000 steps.
    near("the volume of a cone less its pipe", d.volume(cone, pipe), math.pi * 2 * ((1 + 3 + 9) / 3 - 0.25), 1e-9)
    dice = np.random.default_rng(1)
    points, area = d.on_walls(dice, 200000, (cone, pipe))
    near("the area of both", area, math.pi * 4 * math.sqrt(8) + math.pi * 2, 1e-12)
    r, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    on_cone, on_pipe = np.abs(r - 1 - z) < 1e-12, np.abs(r - .5) < 1e-12
    fact("points are on one or the other", bool(np.all(on_cone | on_pipe)))
    # Four standard deviations of a mean of 1.7e5 heights, each of 0.56.
    near("they are spread by area: the mean height on the cone", z[on_cone].mean(), (1 * 2 + 8 / 3) / (2 + 2), 5e-3)
    filled = d.inside(dice, 20000, cone, pipe)
    r = np.hypot(filled[:, 0], filled[:, 1])
    fact("grains are between the walls", bool(np.all((r < 1 + filled[:, 2]) & (r > .5))))

    fact("bricks have the least surface", d.grid_of(8, (1, 1, 8)) == (1, 1, 8) and d.grid_of(8, (1, 1, 1)) == (2, 2, 2))
    for p in (5, 8):
        counts, touching, boxes = d.rcb(p, filled, points)
        fact(f"rcb gives each of {p} as many grains", counts.sum() == 20000 and counts.max() - counts.min() <= 3, list(counts))
        own = [np.all((points >= b[0]) & (points < b[1]), axis=1).sum() for b in boxes]
        # Points beyond all grains belong to a part at the edge, and to no box.
        fact("and each point at the wall to one", touching.sum() == len(points) and np.all(touching >= own))
        sides = boxes[:, 1] - boxes[:, 0]
        near("boxes fill the whole", np.prod(sides, axis=1).sum(), np.prod(filled.max(axis=0) - filled.min(axis=0)), 1e-12)
    counts, touching, boxes = d.bricks(8, filled, points)
    inside = [np.all((filled >= b[0]) & (filled < b[1]), axis=1).sum() for b in boxes]
    fact("a brick has the grains that are in its box", bool(np.all(np.abs(counts - inside) <= 2)), list(counts - inside))
    cube = d.bricks(27, dice.uniform(0, 1, (1000, 3)), points)[2]
    fact("of 27 bricks of a cube the middle one has 26 neighbours, and one at a corner 7",
         (d.neighbours(cube)[13], d.neighbours(cube)[0]) == (26, 7), list(d.neighbours(cube)))
