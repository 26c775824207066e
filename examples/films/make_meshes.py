#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the meshes of the films, in metres: drum.stl, a drum with lifters; valve.stl and rotor.stl, a hopper on a rotary valve;
plate.stl and bin.stl, a chute of small triangles below a bin; wheel.stl and tank.stl, a wheel with paddles below a tank.

All but the chute are extruded along y from 0 to the period of their script's box.
"""
import math
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from stl import extruded, options, quad, write_stl    # noqa: E402


def arc(radius, first, last, pieces):
    """Points (x, z) between two angles in degrees, counted from x towards z."""
    angles = [math.radians(first + (last - first) * k / pieces) for k in range(pieces + 1)]
    return [(radius * math.cos(t), radius * math.sin(t)) for t in angles]


def star(hub, tip, paddles, thickness, y0, y1):
    """A closed rotor about y: a hub from whose corners straight paddles reach out."""
    half = math.asin(thickness / 2 / hub)
    foot = hub * math.cos(half)
    ring, caps = [], []    # points (x, z); quads on the ends
    for k in range(paddles):
        middle = 2 * math.pi * k / paddles
        c, s = math.cos(middle), math.sin(middle)
        paddle = [(r * c - t * s, r * s + t * c) for r, t in
                  ((foot, -thickness / 2), (tip, -thickness / 2), (tip, thickness / 2), (foot, thickness / 2))]
        caps.append(paddle)
        between = 2 * math.pi / paddles - 2 * half
        ring += paddle + [(hub * math.cos(middle + half + between * i / 4), hub * math.sin(middle + half + between * i / 4))
                          for i in (1, 2, 3)]
    triangles = []
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1]):
        triangles += quad((x0, y0, z0), (x0, y1, z0), (x1, y1, z1), (x1, y0, z1))
    # The ends: of each paddle, and the hub as a fan.
    core = [p for p in ring if math.hypot(*p) < 1.0001 * hub]
    for y, turn in ((y0, 1), (y1, -1)):
        flat = [tuple((x, y, z) for x, z in paddle) for paddle in caps]
        for a, b, c, d in flat:
            triangles += quad(a, b, c, d) if turn > 0 else quad(d, c, b, a)
        for (x0, z0), (x1, z1) in zip(core, core[1:] + core[:1]):
            corner = ((0, y, 0), (x0, y, z0), (x1, y, z1))
            triangles.append(corner if turn > 0 else corner[::-1])
    return triangles


def tray(x0, x1, z0, z1, y0, y1):
    """A floor at z0 and walls to z1 around it, those across y only where these are not the period's ends."""
    triangles = extruded([(x0, z1), (x0, z0), (x1, z0), (x1, z1)], y0, y1)
    if y0 < 0:
        for side, turn in ((y0, 1), (y1, -1)):
            corner = [(x0, side, z0), (x0, side, z1), (x1, side, z1), (x1, side, z0)][::turn]
            triangles += quad(*corner)
    return triangles


def other_example(script, out, *words):
    subprocess.run([sys.executable, HERE.parent / script, "--out", out, *map(str, words)], check=True)


def main():
    p = options(__doc__)
    p.add_argument("--cell", type=float, default=0.005, help="edge of the squares of the chute that two triangles make")
    a = p.parse_args()
    out = Path(a.out)
    other_example("drum/make_drum.py", out, "--radius", 0.2, "--length", 0.12, "--lifters", 8, "--height", 0.025, "--width", 0.012,
                  "--segments", 240)

    # The housing leaves a quarter of the round open above, where the hopper stands, and below.
    radius, length = 0.08, 0.12
    housing = [(-0.15, 0.42), (-0.15, 0.18)] + arc(radius, 135, 225, 30), arc(radius, -45, 45, 30) + [(0.15, 0.18), (0.15, 0.42)]
    write_stl(out / "valve.stl", [t for line in housing for t in extruded(line, 0, length)], "a hopper and the housing of its valve, m")
    write_stl(out / "rotor.stl", star(0.025, radius - 0.0015, 8, 0.004, 0.0003, length - 0.0003), "rotor of a valve, m")

    # Trays catch the grains: LAMMPS 4Jul2026 on one GPU fails where grains leave the box.
    write_stl(out / "valve_tray.stl", tray(-0.19, 0.19, -0.34, 0.44, 0, length), "a tray, m")
    write_stl(out / "wheel_tray.stl", tray(-0.29, 0.34, -0.36, 0.56, 0, length), "a tray, m")
    write_stl(out / "chute_tray.stl", tray(-0.05, 0.6, -0.42, 0.34, -0.11, 0.11), "a tray, m")

    other_example("wearing-chute/make_chute.py", out, "--length", 0.42, "--width", 0.17, "--thickness", 0.012, "--slope", 38,
                  "--cell", a.cell, "--side", 0.05)
    (out / "sides.stl").rename(out / "chute_sides.stl")
    # A bin over the chute, 0.16 wide, whose floor slopes to a slot.
    y, outline = 0.08, [(0.06, 0.05), (0.085, 0.05), (0.25, 0.17), (0.25, 0.34), (0.06, 0.34)]
    parts = extruded(outline[1:4], -y, y) + extruded([outline[4], outline[0]], -y, y)
    for side in (-y, y):
        ends = [((x0, side, z0), (x1, side, z1)) for (x0, z0), (x1, z1) in zip(outline[1:], outline[2:])]
        parts += [((outline[0][0], side, outline[0][1]), *(end if side > 0 else end[::-1])) for end in ends]
    write_stl(out / "bin.stl", parts, "a bin, m")

    # A tank whose slot lies over the right half of the wheel.
    tank = [(0.035, 0.22), (-0.16, 0.34), (-0.16, 0.56)], [(0.2, 0.56), (0.2, 0.34), (0.08, 0.22)]
    write_stl(out / "tank.stl", [t for line in tank for t in extruded(line, 0, length)], "a tank, m")
    write_stl(out / "wheel.stl", star(0.1, 0.16, 16, 0.004, 0.0003, length - 0.0003), "a wheel, m")


if __name__ == "__main__":
    main()
