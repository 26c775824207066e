#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write a screw feeder, tube.stl and screw.stl, and grains.lammps, 49 grains in its first quarter.

Triangles are no larger than a grain, as fix surface/local asks for. The screw turns in the tube, both along y.
"""
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, strip, write_stl    # noqa: E402

RADIUS, BLADE, PITCH, LENGTH = 1.8, 1.6, 2.0, 16.0
ROUND, ALONG = 64, 100    # triangles of the tube: 2 ROUND ALONG


def ring(radius, y):
    turns = [2 * math.pi * k / ROUND for k in range(ROUND + 1)]
    return [(radius * math.sin(t), y, radius * math.cos(t)) for t in turns[:-1]] + [(0.0, y, radius)]


def tube():
    """Open at both ends of the box."""
    rings = [ring(RADIUS, LENGTH * k / ALONG) for k in range(ALONG + 1)]
    return [t for a, b in zip(rings, rings[1:]) for t in strip(a, b)]


def screw():
    """A blade without a shaft, from one end nearly to the other."""
    steps = range(round(ROUND / 2 * (LENGTH - 1) / PITCH) + 1)

    def line(radius):
        turn = 4 * math.pi / ROUND
        return [(radius * math.sin(turn * k), 0.5 + PITCH * turn * k / (2 * math.pi), radius * math.cos(turn * k)) for k in steps]

    lines = [line(BLADE * k / 4 + 0.05) for k in range(4)] + [line(BLADE)]
    return [t for a, b in zip(lines, lines[1:]) for t in strip(a, b)]


def grains(dice):
    """Diameters 0.3 to 0.5, each in the middle between two turns of the blade, apart from each other."""
    found = []
    while len(found) < 49:
        d, r, t, y = dice.uniform(0.3, 0.5), dice.uniform(0.4, 1.4), dice.uniform(-math.pi, math.pi), dice.uniform(1.0, 6.0)
        x, z = r * math.sin(t), r * math.cos(t)
        phase = (y - 0.5) / PITCH - t / (2 * math.pi)
        if abs(phase - math.floor(phase) - 0.5) < 0.1 and all(
                math.dist((x, y, z), other[1:]) > (d + other[0]) / 2 for other in found):
            found.append((d, x, y, z))
    return found


def main():
    a = options(__doc__).parse_args()
    out = Path(a.out)
    write_stl(out / "tube.stl", tube(), "tube")
    write_stl(out / "screw.stl", screw(), "screw")
    (out / "grains.lammps").write_text("".join(
        f"create_atoms 1 single {x:.6f} {y:.6f} {z:.6f} units box\nset atom {k} diameter {d:.6f} density 1\n"
        for k, (d, x, y, z) in enumerate(grains(random.Random(1)), 1)))


if __name__ == "__main__":
    main()
