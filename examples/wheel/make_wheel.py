#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write bed.stl, a trough along x without ends in y, and wheel.stl, a wheel with lugs about the y axis, a closed mesh."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import extruded, options, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--length", type=float, default=60, help="of the trough")
    p.add_argument("--depth", type=float, default=20, help="of the trough")
    p.add_argument("--period", type=float, default=6, help="of the script's box along y")
    p.add_argument("--radius", type=float, default=6, help="of the wheel, with its lugs")
    p.add_argument("--lug", type=float, default=0.6, help="height and thickness of a lug")
    p.add_argument("--lugs", type=int, default=18)
    a = p.parse_args()
    line = [(a.length, a.depth), (a.length, 0), (0, 0), (0, a.depth)]
    out = Path(a.out)
    write_stl(out / "bed.stl", extruded(line, 0, a.period), "bed")

    # Going round the y axis from z to x, so that faces look outwards.
    rim, outline = a.radius - a.lug, []
    for k in range(a.lugs):
        middle = 2 * math.pi * k / a.lugs
        for radius, side in ((rim, -1), (a.radius, -1), (a.radius, 1), (rim, 1)):
            turn = middle + side * math.asin(a.lug / 2 / radius)
            outline.append((radius * math.sin(turn), radius * math.cos(turn)))
        between = middle + math.pi / a.lugs
        outline.append((rim * math.sin(between), rim * math.cos(between)))
    loop = outline + outline[:1]
    lo, hi = 0.05, a.period - 0.05
    wheel = extruded(loop, lo, hi)
    for (x1, z1), (x2, z2) in zip(loop, loop[1:]):
        wheel.append(((0, lo, 0), (x2, lo, z2), (x1, lo, z1)))
        wheel.append(((0, hi, 0), (x1, hi, z1), (x2, hi, z2)))
    write_stl(out / "wheel.stl", wheel, "wheel")


if __name__ == "__main__":
    main()
