#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write chute.stl in millimetres: a steep slope that an arc turns to a flat one, between two sides."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, strip, write_stl    # noqa: E402


def profile(a):
    """Points (x, z) along the chute, `edge` apart: down the slope, round the arc, out."""
    steep, flat = math.radians(a.steep), math.radians(a.flat)
    lengths = (a.slope, a.radius * (steep - flat), a.out_length)
    x, z, points = 0.0, 0.0, [(0.0, 0.0)]
    for k, length in enumerate(lengths):
        pieces = round(length / a.edge)
        for i in range(pieces):
            angle = (steep, steep + (flat - steep) * (i + 0.5) / pieces, flat)[k]
            x, z = x + length / pieces * math.cos(angle), z - length / pieces * math.sin(angle)
            points.append((x, z))
    return points


def main():
    p = options(__doc__)
    p.add_argument("--slope", type=float, default=120, help="length of the steep part")
    p.add_argument("--steep", type=float, default=60, help="degrees below the horizontal")
    p.add_argument("--radius", type=float, default=60, help="of the arc")
    p.add_argument("--flat", type=float, default=15, help="degrees below the horizontal")
    p.add_argument("--out-length", type=float, default=60, help="of the flat part")
    p.add_argument("--width", type=float, default=40)
    p.add_argument("--side", type=float, default=25, help="height of the sides")
    p.add_argument("--edge", type=float, default=4, help="of the facets")
    a = p.parse_args()
    line, half, across = profile(a), a.width / 2, round(a.width / a.edge)
    rows = [[(x, -half + a.width * k / across, z) for x, z in line] for k in range(across + 1)]
    facets = [t for row, following in zip(rows, rows[1:]) for t in strip(row, following)]
    for row in (rows[0], rows[-1]):
        facets += strip(row, [(x, y, z + a.side) for x, y, z in row])
    write_stl(Path(a.out) / "chute.stl", facets, "chute, millimetres")


if __name__ == "__main__":
    main()
