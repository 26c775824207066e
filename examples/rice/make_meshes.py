#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the meshes of in.rice: hopper.stl, a round bin that narrows to an outlet at z = 0, gate.stl, the plate that closes it,
plate.stl, a round plate with a rim below, for the heap, and section.stl, which counts the grains that fall; and drum.stl of in.rice-drum.

Lengths are metres.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import box, circle, disc, extruded, options, quad, side, strip, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--outlet", type=float, default=0.018, help="diameter")
    p.add_argument("--radius", type=float, default=0.014, help="of the bin")
    p.add_argument("--slope", type=float, default=45, help="of the cone, in degrees")
    p.add_argument("--height", type=float, default=0.07, help="of the bin above the cone")
    p.add_argument("--plate", type=float, default=0.016, help="radius of the plate")
    p.add_argument("--rim", type=float, default=0.0025, help="height of its rim")
    p.add_argument("--drop", type=float, default=0.025, help="of the plate below the outlet")
    p.add_argument("--segments", type=int, default=48, help="round the bin")
    p.add_argument("--drum", type=float, default=0.06, help="radius of the drum")
    p.add_argument("--length", type=float, default=0.02, help="of the drum, which has no ends")
    a = p.parse_args()
    out, outlet, ring = Path(a.out), circle(a.outlet / 2, a.segments), circle(a.radius, a.segments)
    top = (a.radius - a.outlet / 2) * math.tan(math.radians(a.slope))
    cone = strip([(*p, 0) for p in outlet + outlet[:1]], [(*p, top) for p in ring + ring[:1]])
    write_stl(out / "hopper.stl", cone + side(ring, top, top + a.height), "hopper, in metres")
    half = a.outlet / 2 + 0.001
    write_stl(out / "gate.stl", box((-half, -half, -0.0012), (half, half, -0.0002)), "gate, in metres")
    plate = circle(a.plate, a.segments)
    write_stl(out / "plate.stl", disc(plate, -a.drop) + side(plate, -a.drop, a.rim - a.drop), "plate, in metres")
    r = a.radius
    # Wound so that down is forward.
    write_stl(out / "section.stl", quad((-r, -r, -0.003), (-r, r, -0.003), (r, r, -0.003), (r, -r, -0.003)), "section, in metres")
    drum = circle(a.drum, 96)
    write_stl(out / "drum.stl", extruded(drum + drum[:1], 0, a.length), "drum, in metres")


if __name__ == "__main__":
    main()
