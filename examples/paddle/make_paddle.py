#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write drum.stl, a closed drum along y, and paddle.stl, a shaft with four flat blades on the y axis, a closed mesh.

The drum goes round the period of the script's box and has no ends; the paddle is a little shorter than the period.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import extruded, options, write_stl    # noqa: E402


def cap(outline, y):
    """A star about the axis: all corners are seen from it."""
    return [((0, y, 0), (x1, y, z1), (x2, y, z2))
            for (x1, z1), (x2, z2) in zip(outline, outline[1:] + outline[:1])]


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=7, help="of the drum")
    p.add_argument("--gap", type=float, default=1.3, help="between blades and drum")
    p.add_argument("--shaft", type=float, default=0.8, help="half of its width")
    p.add_argument("--thickness", type=float, default=0.5, help="of a blade")
    p.add_argument("--length", type=float, default=6)
    p.add_argument("--segments", type=int, default=64, help="round the drum")
    a = p.parse_args()
    turns = [2 * math.pi * k / a.segments for k in range(a.segments)]
    ring = [(a.radius * math.cos(t), a.radius * math.sin(t)) for t in turns]
    ring.append(ring[0])
    drum = extruded(ring, 0, a.length)
    s, t, tip = a.shaft, a.thickness / 2, a.radius - a.gap
    arm = [(s, -s), (s, -t), (tip, -t), (tip, t), (s, t)]    # the next corner is that of the next arm
    outline = []
    for k in range(4):
        c, d = (1, 0, -1, 0)[k], (0, 1, 0, -1)[k]
        outline += [(c * x - d * z, d * x + c * z) for x, z in arm]
    lo, hi = 0.05, a.length - 0.05
    loop = outline + outline[:1]
    side = extruded(loop, lo, hi)
    paddle = [t[::-1] for t in side] + cap(outline, lo) + [t[::-1] for t in cap(outline, hi)]
    out = Path(a.out)
    write_stl(out / "drum.stl", drum, "drum")
    write_stl(out / "paddle.stl", paddle, "paddle")


if __name__ == "__main__":
    main()
