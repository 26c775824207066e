#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write screw.stl, a shaft along y with a right-handed blade, and tube.stl, the tube round it.

Both are TURNS pitches long, from y = 0, which is the period of the script's box.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, strip, write_stl    # noqa: E402


def helix(radius, pitch, turns, segments):
    """Points (x, y, z) that advance along y by `pitch` per right-handed turn about y."""
    steps = range(round(segments * turns) + 1)
    return [(radius * math.sin(2 * math.pi * k / segments), pitch * k / segments,
             radius * math.cos(2 * math.pi * k / segments)) for k in steps]


def tube(radius, length, segments):
    ends = [[(x, y, z) for x, _, z in helix(radius, 0, 1, segments)] for y in (0, length)]
    return strip(*ends)


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=6, help="of the tube")
    p.add_argument("--gap", type=float, default=0.25, help="between blade and tube")
    p.add_argument("--shaft", type=float, default=1.5, help="its radius")
    p.add_argument("--pitch", type=float, default=10)
    p.add_argument("--turns", type=int, default=2)
    p.add_argument("--segments", type=int, default=48, help="round the tube")
    a = p.parse_args()
    lines = [helix(r, a.pitch, a.turns, a.segments)
             for r in (a.shaft, (a.shaft + a.radius - a.gap) / 2, a.radius - a.gap)]
    blade = strip(lines[0], lines[1]) + strip(lines[1], lines[2])
    length, out = a.pitch * a.turns, Path(a.out)
    write_stl(out / "screw.stl", blade + tube(a.shaft, length, a.segments), "screw")
    write_stl(out / "tube.stl", tube(a.radius, length, a.segments), "tube")
    write_stl(out / "section.stl", [((-9, 5, -9), (-9, 5, 9), (9, 5, 9)),
                                    ((-9, 5, -9), (9, 5, 9), (9, 5, -9))], "section")


if __name__ == "__main__":
    main()
