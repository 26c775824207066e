#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write pipe.stl, a pipe along y, closed at both ends, that goes through the place where grains are
inserted, and section.stl, below it to count them."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, quad, side, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=2.5)
    p.add_argument("--length", type=float, default=42)
    p.add_argument("--segments", type=int, default=96, help="round the pipe")
    a = p.parse_args()
    ring, half, out = circle(a.radius, a.segments), a.length / 2, Path(a.out)
    pipe = side(ring, -half, half) + disc(ring, half) + disc(ring[::-1], -half)
    # From along z to along y; wound outwards.
    write_stl(out / "pipe.stl", [tuple((x, -z, y) for x, y, z in t) for t in pipe], "pipe")
    rim = [(-20, -20, -8), (-20, 20, -8), (20, 20, -8), (20, -20, -8)]
    write_stl(out / "section.stl", quad(*rim), "section")


if __name__ == "__main__":
    main()
