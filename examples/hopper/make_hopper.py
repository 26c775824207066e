#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write hopper.stl, a round bin with a round hole in its flat floor, gate.stl, the plate that
closes it from below, and section.stl, a larger plate to count the grains that fall through.

The floor is at z = 0.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import box, circle, options, quad, side, strip, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--outlet", type=float, default=7, help="diameter of the hole")
    p.add_argument("--radius", type=float, default=8)
    p.add_argument("--height", type=float, default=28)
    p.add_argument("--segments", type=int, default=64, help="round the bin")
    a = p.parse_args()
    bin_, hole = circle(a.radius, a.segments), circle(a.outlet / 2, a.segments)
    floor = strip([(*p, 0) for p in hole + hole[:1]], [(*p, 0) for p in bin_ + bin_[:1]])
    out, half, r = Path(a.out), a.outlet / 2 + 1, a.radius
    write_stl(out / "hopper.stl", floor + side(bin_, 0, a.height), "bin")
    write_stl(out / "gate.stl", box((-half, -half, -0.6), (half, half, -0.1)), "gate")
    # Wound so that down is forward.
    write_stl(out / "section.stl", quad((-r, -r, -2), (-r, r, -2), (r, r, -2), (r, -r, -2)), "section")


if __name__ == "__main__":
    main()
