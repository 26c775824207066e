#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write belt.stl, a troughed belt along x; belt.data, an atom at each of its vertices with the bonds between them; and
rollers.stl, the two cylinders at its ends.

Atoms of type 2 are the nodes inside, of type 3 those of the two rims along x, of type 4 those that the rollers hold. Bonds of
type 1 go along the belt, of type 2 along its rims, of type 3 across it.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import nodes    # noqa: E402
from stl import options, strip, write_stl    # noqa: E402


def section(a):
    """Points (y, z) across the belt: flat in the middle, with sides that rise."""
    slope, half, points = math.radians(a.slope), a.flat / 2, []
    for k in range(a.across + 1):
        along = a.width * (k / a.across - 0.5)
        past = math.copysign(max(abs(along) - half, 0), along)
        points.append((along - past + past * math.cos(slope), abs(past) * math.sin(slope)))
    return points


def data(a, rows):
    atoms, bonds, last = [], [], len(rows) - 1
    number = {(i, j): i * (a.across + 1) + j + 1 for i in range(len(rows)) for j in range(a.across + 1)}
    for (i, j), n in number.items():
        atoms.append((n, 4 if i in (0, last) else 3 if j in (0, a.across) else 2, rows[i][j]))
        if i < last:
            bonds.append((2 if j in (0, a.across) else 1, n, number[i + 1, j]))
        if j < a.across:
            bonds.append((3, n, number[i, j + 1]))
    half = a.span / 2
    return nodes.data("A belt whose vertices are atoms", atoms, bonds, 4, 3, a.mass, ((-half - 2, half + 8), (-8, 8), (-12, 14)))


def roller(x, radius, length, n=24):
    ring = [(x + radius * math.sin(2 * math.pi * k / n), -radius * (1 - math.cos(2 * math.pi * k / n))) for k in range(n + 1)]
    return strip([(x, -length / 2, z) for x, z in ring], [(x, length / 2, z) for x, z in ring])


def main():
    p = options(__doc__)
    p.add_argument("--span", type=float, default=40, help="between the rollers")
    p.add_argument("--pieces", type=int, default=40, help="along the span")
    p.add_argument("--width", type=float, default=10, help="across the belt, along its section")
    p.add_argument("--across", type=int, default=10, help="pieces of the width")
    p.add_argument("--flat", type=float, default=2, help="width of the flat middle")
    p.add_argument("--slope", type=float, default=35, help="of the sides, degrees")
    p.add_argument("--mass", type=float, default=0.2, help="of a node")
    a = p.parse_args()
    rows = [[(a.span * (i / a.pieces - 0.5), y, z) for y, z in section(a)] for i in range(a.pieces + 1)]
    out = Path(a.out)
    write_stl(out / "belt.stl", [t for one, other in zip(rows, rows[1:]) for t in strip(other, one)], "belt")
    (out / "belt.data").write_text(data(a, rows))
    radius = 2.0
    write_stl(out / "rollers.stl", [(tuple((x, y, z - 0.05) for x, y, z in t)) for end in (-1, 1)
                                    for t in roller(end * a.span / 2, radius, a.flat)], "rollers")


if __name__ == "__main__":
    main()
