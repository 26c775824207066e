#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write a flat floor at z = 0 as an ugly binary STL: nodes moved about in the
plane, triangles in random order, half of them wound the other way."""
import argparse
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import write_stl    # noqa: E402


def floor(side, cells, seed=1):
    """2 * cells^2 triangles over a square of `side` centred on the origin."""
    dice = random.Random(seed)
    step = side / cells

    def node(i, j):
        inside = 0 < i < cells and 0 < j < cells
        jitter = [dice.uniform(-0.3, 0.3) * step if inside else 0.0 for _ in (0, 1)]
        return (i * step - side / 2 + jitter[0], j * step - side / 2 + jitter[1], 0.0)

    nodes = {(i, j): node(i, j) for i in range(cells + 1) for j in range(cells + 1)}
    triangles = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = (nodes[k] for k in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            pair = [[a, b, c], [a, c, d]] if dice.random() < 0.5 else [[a, b, d], [b, c, d]]
            triangles += [t[::-1] if dice.random() < 0.5 else t for t in pair]
    dice.shuffle(triangles)
    return triangles


if __name__ == "__main__":
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("file")
    p.add_argument("--side", type=float, default=0.2, help="length (default 0.2)")
    p.add_argument("--cells", type=int, default=100, help="along a side (default 100: 20 000 triangles)")
    arg = p.parse_args()
    write_stl(arg.file, floor(arg.side, arg.cells), "flat floor")
