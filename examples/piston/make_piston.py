#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write die.stl, a round cup open at the top, and piston.stl, a short cylinder that fits into it.

The floor of the cup is at z = 0, and so is the face of the piston: the script moves it up.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, side, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=7)
    p.add_argument("--height", type=float, default=14)
    p.add_argument("--gap", type=float, default=0.1, help="between piston and cup")
    p.add_argument("--segments", type=int, default=64, help="round the cup")
    a = p.parse_args()
    cup, rod = circle(a.radius, a.segments), circle(a.radius - a.gap, a.segments)
    out = Path(a.out)
    write_stl(out / "die.stl", disc(cup, 0) + side(cup, 0, a.height), "die")
    write_stl(out / "piston.stl", disc(rod, 0) + side(rod, 0, 1) + disc(rod, 1), "piston")


if __name__ == "__main__":
    main()
