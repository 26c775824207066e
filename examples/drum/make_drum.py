#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write drum.stl: a drum round the y axis with lifters, open at both ends.

The outline is extruded from y = 0 to LENGTH, which is the period of the script's box.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, quad, write_stl    # noqa: E402


def outline(radius, n_lifters, height, width, segments):
    """Points (x, z) round the drum; a lifter is a bar of `width` that reaches in by `height`."""
    points = []
    half = math.asin(width / 2 / radius) if n_lifters else 0
    for k in range(max(1, n_lifters)):
        middle = 2 * math.pi * k / max(1, n_lifters)
        if n_lifters:
            c, s = math.cos(middle), math.sin(middle)
            foot = radius * math.cos(half)
            for r, t in ((foot, -width / 2), (radius - height, -width / 2),
                         (radius - height, width / 2), (foot, width / 2)):
                points.append((r * c - t * s, r * s + t * c))
        first, last = middle + half, middle + 2 * math.pi / max(1, n_lifters) - half
        pieces = max(1, round(segments * (last - first) / (2 * math.pi)))
        for i in range(1 if n_lifters else 0, pieces):
            a = first + (last - first) * i / pieces
            points.append((radius * math.cos(a), radius * math.sin(a)))
    return points


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=10)
    p.add_argument("--length", type=float, default=5)
    p.add_argument("--lifters", type=int, default=6)
    p.add_argument("--height", type=float, default=1, help="of a lifter")
    p.add_argument("--width", type=float, default=0.6, help="of a lifter")
    p.add_argument("--segments", type=int, default=96, help="round the drum")
    a = p.parse_args()
    ring = outline(a.radius, a.lifters, a.height, a.width, a.segments)
    triangles = []
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1]):
        triangles += quad((x0, 0, z0), (x1, 0, z1), (x1, a.length, z1), (x0, a.length, z0))
    write_stl(Path(a.out) / "drum.stl", triangles, "drum with lifters, in diameters of grains")


if __name__ == "__main__":
    main()
