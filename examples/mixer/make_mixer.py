#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write trough.stl, two half drums along y that meet below their axes, and blade.stl, a shaft with two flat blades.

Both are extruded from y = 0 to LENGTH, which is the period of the script's box. The shaft is the y
axis: the script moves it to the axes of the half drums, at x = +-AXES.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import extruded, options, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=6, help="of a half drum")
    p.add_argument("--axes", type=float, default=5, help="of the half drums: their x")
    p.add_argument("--gap", type=float, default=1.2, help="between blades and drum")
    p.add_argument("--shaft", type=float, default=0.8, help="half of its width")
    p.add_argument("--thickness", type=float, default=0.6, help="of a blade")
    p.add_argument("--height", type=float, default=10, help="of the walls, above the axes")
    p.add_argument("--length", type=float, default=6)
    p.add_argument("--segments", type=int, default=32, help="round a half drum")
    a = p.parse_args()
    r, n = a.radius, a.segments
    inner = math.pi - math.acos(a.axes / r)    # where the half drums meet
    turns = [inner * k / n for k in range(n + 1)]
    half = [(-a.axes - r * math.cos(t), -r * math.sin(t)) for t in turns]
    line = half + [(-x, z) for x, z in half[-2::-1]]
    line = [(line[0][0], a.height)] + line + [(line[-1][0], a.height)]
    s, t, tip = a.shaft, a.thickness / 2, r - a.gap
    cross = [(-tip, -t), (-s, -t), (-s, -s), (s, -s), (s, -t), (tip, -t),
             (tip, t), (s, t), (s, s), (-s, s), (-s, t), (-tip, t)]
    out = Path(a.out)
    write_stl(out / "trough.stl", extruded(line, 0, a.length), "trough")
    write_stl(out / "blade.stl", extruded(cross + cross[:1], 0, a.length), "blade")


if __name__ == "__main__":
    main()
