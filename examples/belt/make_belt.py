#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write belt.stl, a troughed belt along x from 0 to LENGTH, chute.stl, skirts beside it and what catches the grains
that it throws off, and section.stl, below the chute's outlet.

A belt is a sheet, flat in the middle and raised at its sides.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, quad, strip, write_stl    # noqa: E402


def rectangle(x0, x1, half, z):
    return [(x0, -half, z), (x1, -half, z), (x1, half, z), (x0, half, z)]


def main():
    p = options(__doc__)
    p.add_argument("--length", type=float, default=30)
    p.add_argument("--width", type=float, default=4, help="of the flat middle, and of each side")
    p.add_argument("--angle", type=float, default=30, help="of the sides, in degrees")
    p.add_argument("--outlet", type=float, default=6, help="a side of the chute's outlet")
    a = p.parse_args()
    c, s, w = math.cos(math.radians(a.angle)), math.sin(math.radians(a.angle)), a.width
    line = [(-w / 2 - w * c, w * s), (-w / 2, 0), (w / 2, 0), (w / 2 + w * c, w * s)]
    belt = strip([(0, y, z) for y, z in line], [(a.length, y, z) for y, z in line])

    # Skirts keep what bounces on the belt.
    edge, top = w / 2 + w * c - 0.2, 6
    skirts = [quad((0.2, y0, 0.3), (x, y1, 0.3), (x, y1, top), (0.2, y0, top))
              for y0, y1, x in ((-edge, -edge, a.length), (edge, edge, a.length), (-edge, edge, 0.2))]
    # From above: open towards the belt, upright, then a funnel.
    x0, x1, half, out = a.length + 0.5, a.length + 14, w / 2 + w * c + 1, a.outlet / 2
    top, middle = rectangle(x0, x1, half, 7), rectangle(x0, x1, half, -3)
    centre = (x0 + x1) / 2
    low = rectangle(centre - out, centre + out, out, -14)
    upright = strip(top, middle)    # its fourth side is the belt's
    funnel = strip(middle + middle[:1], low + low[:1])
    folder = Path(a.out)
    write_stl(folder / "belt.stl", belt, "belt")
    write_stl(folder / "chute.stl", sum(skirts, upright + funnel), "chute")
    # Wound so that down is forward.
    write_stl(folder / "section.stl", quad(*rectangle(x0, x1, half, -15)[::-1]), "section")


if __name__ == "__main__":
    main()
