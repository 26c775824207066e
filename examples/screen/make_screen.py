#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write screen.stl, a sheet with N x N square apertures of size 1, frame.stl, four walls that stand
on it, and section.stl, a sheet below it to count what passes.

The screen is at z = 0; the script's box is as wide as the frame and a margin.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, quad, side, strip, write_stl    # noqa: E402


def square(x, y, half):
    return [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


def main():
    p = options(__doc__)
    p.add_argument("--n", type=int, default=9, help="apertures along a side")
    p.add_argument("--bar", type=float, default=0.4, help="between apertures of size 1")
    p.add_argument("--height", type=float, default=20)
    a = p.parse_args()
    pitch, screen = 1 + a.bar, []
    for i in range(a.n):
        for j in range(a.n):
            x, y = (i - (a.n - 1) / 2) * pitch, (j - (a.n - 1) / 2) * pitch
            rings = [[(*q, 0) for q in square(x, y, half)] for half in (0.5, pitch / 2)]
            screen += strip(*(ring + ring[:1] for ring in rings))
    out, half = Path(a.out), a.n * pitch / 2
    write_stl(out / "screen.stl", screen, "screen")
    write_stl(out / "frame.stl", side(square(0, 0, half), -4, a.height), "frame")
    # Wound so that down is forward.
    write_stl(out / "section.stl", quad(*[(*q, -1.5) for q in square(0, 0, half)][::-1]), "section")


if __name__ == "__main__":
    main()
