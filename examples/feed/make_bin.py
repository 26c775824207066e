#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write bin.stl, a round bin that is open at its top, and inlet.stl, a disc above it whose normal points down."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, side, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=4)
    p.add_argument("--height", type=float, default=8)
    p.add_argument("--inlet", type=float, default=2.5, help="its radius")
    p.add_argument("--segments", type=int, default=48)
    a = p.parse_args()
    ring, out = circle(a.radius, a.segments), Path(a.out)
    write_stl(out / "bin.stl", side(ring, 0, a.height) + disc(ring[::-1], 0), "bin")
    write_stl(out / "inlet.stl", disc(circle(a.inlet, a.segments)[::-1], a.height), "inlet")


if __name__ == "__main__":
    main()
