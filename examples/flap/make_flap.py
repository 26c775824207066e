#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write bin.stl, a bin along y whose floor slopes to an outlet in its front wall, and flap.stl, a closed plate that hangs
before the outlet.

The hinge is the line x = 0, z = HEIGHT; grains leave towards +x. Both are extruded along y, the period of the script's box.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import box, extruded, options, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--height", type=float, default=5, help="of the hinge over the foot of the outlet")
    p.add_argument("--depth", type=float, default=10, help="of the bin, from its front wall")
    p.add_argument("--slope", type=float, default=35, help="of its floor, degrees")
    p.add_argument("--top", type=float, default=22, help="of the bin")
    p.add_argument("--length", type=float, default=6, help="along y")
    p.add_argument("--thickness", type=float, default=0.3, help="of the flap")
    a = p.parse_args()
    rise = a.depth * math.tan(math.radians(a.slope))
    line = [(0, 0), (-a.depth, rise), (-a.depth, a.top)]
    front = [(0, a.height), (0, a.top)]
    walls = extruded(line, 0, a.length) + extruded(front, 0, a.length)
    out = Path(a.out)
    write_stl(out / "bin.stl", walls, "bin")
    # Its inner face lies on the outlet; it ends a little above the foot, and within the period.
    write_stl(out / "flap.stl", box((0, 0.05, 0.1), (a.thickness, a.length - 0.05, a.height)), "flap")


if __name__ == "__main__":
    main()
