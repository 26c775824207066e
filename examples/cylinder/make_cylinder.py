#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write a cylinder about z of N flat segments as a binary STL, open at both ends.
The polygon has the area of the circle, so that it lies as far inside as outside."""
import argparse
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import write_stl    # noqa: E402


def cylinder(radius, length, segments, rings=1, seed=1):
    """2 * segments * rings triangles, shuffled, half of them wound the other way."""
    turn = 2 * math.pi / segments
    corner = radius * math.sqrt(turn / math.sin(turn))

    def node(i, j):
        angle = turn * (i % segments)
        return (corner * math.cos(angle), corner * math.sin(angle), length * (j / rings - 0.5))

    dice = random.Random(seed)
    triangles = []
    for i in range(segments):
        for j in range(rings):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            triangles += [t[::-1] if dice.random() < 0.5 else t for t in ([a, b, c], [a, c, d])]
    dice.shuffle(triangles)
    return triangles


if __name__ == "__main__":
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("file")
    p.add_argument("--radius", type=float, default=0.02, help="length (default 0.02)")
    p.add_argument("--length", type=float, default=0.1, help="length (default 0.1)")
    p.add_argument("--segments", type=int, default=256, help="round the cylinder (default 256)")
    p.add_argument("--rings", type=int, default=1, help="along the axis (default 1)")
    arg = p.parse_args()
    write_stl(arg.file, cylinder(arg.radius, arg.length, arg.segments, arg.rings), "cylinder")
