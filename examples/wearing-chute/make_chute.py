#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write plate.stl, a closed plate of small triangles that slopes down along x, and sides.stl, two walls along it.

Its upper face goes through the origin.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, quad, write_stl    # noqa: E402


def plate(n_along, n_across, point):
    """Triangles, wound outwards; point(i, j, 0) is on the upper face, point(i, j, 1) on the lower one."""
    triangles = []
    for i in range(n_along):
        for j in range(n_across):
            ring = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            triangles += quad(*(point(*p, 0) for p in ring)) + quad(*(point(*p, 1) for p in ring[::-1]))
    rim = [((i, 0), (i + 1, 0)) for i in range(n_along)] + [((n_along, j), (n_along, j + 1)) for j in range(n_across)]
    rim += [((i + 1, n_across), (i, n_across)) for i in range(n_along)] + [((0, j + 1), (0, j)) for j in range(n_across)]
    for a, b in rim:
        triangles += quad(point(*a, 1), point(*b, 1), point(*b, 0), point(*a, 0))
    return triangles


def main():
    p = options(__doc__)
    p.add_argument("--length", type=float, default=24, help="along the slope")
    p.add_argument("--width", type=float, default=9)
    p.add_argument("--thickness", type=float, default=0.8)
    p.add_argument("--slope", type=float, default=35, help="degrees")
    p.add_argument("--cell", type=float, default=0.75, help="edge of the squares that two triangles make")
    p.add_argument("--side", type=float, default=3, help="height of the sides")
    a = p.parse_args()
    cosine, sine = math.cos(math.radians(a.slope)), math.sin(math.radians(a.slope))

    def place(along, across, up):
        return (along * cosine + up * sine, across, -along * sine + up * cosine)
    n_along, n_across = round(a.length / a.cell), round(a.width / a.cell)
    out = Path(a.out)
    write_stl(out / "plate.stl", plate(n_along, n_across, lambda i, j, low: place(
        a.length * i / n_along, a.width * (j / n_across - 0.5), -a.thickness * low)), "plate")
    sides = []
    for y in (-a.width / 2, a.width / 2):
        sides += quad(*(place(along, y, up) for along, up in ((0, -a.thickness), (a.length, -a.thickness), (a.length, a.side), (0, a.side))))
    write_stl(out / "sides.stl", sides, "sides")


if __name__ == "__main__":
    main()
