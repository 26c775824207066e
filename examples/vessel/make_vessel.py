#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the spallation-target vessel as STL files in millimetres.

The vessel is turned on a lathe about z: a cylinder, a converging cone and an
outlet tube with rounded knuckles between them, and a beam pipe with a round end
hanging in it (vessel.stl), open at the top and at the bottom. outlet.stl is the
plate that closes the tube until the script takes it away. Walls have no thickness.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, write_stl    # noqa: E402


def arguments():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=50, help="inner radius of the cylinder")
    p.add_argument("--height", type=float, default=100, help="height of the cylinder")
    p.add_argument("--cone", type=float, default=50, help="height of the cone")
    p.add_argument("--tube-radius", type=float, default=15, help="inner radius of the outlet tube")
    p.add_argument("--tube", type=float, default=30, help="length of the outlet tube; it ends at z = 0")
    p.add_argument("--knuckle", type=float, default=12, help="radius of the two roundings")
    p.add_argument("--pipe-radius", type=float, default=12, help="outer radius of the beam pipe")
    p.add_argument("--pipe-depth", type=float, default=70, help="how far it reaches down from the rim")
    p.add_argument("--segments", type=int, default=160, help="facets round the vessel")
    p.add_argument("--edge", type=float, default=4.5, help="longest facet edge along the profile")
    return p.parse_args()


def rounded(corner, before, after, radius):
    """The arc of `radius` that replaces a corner of a polyline, as (r, z) points."""
    def unit(a, b):
        d = math.dist(a, b)
        return ((b[0] - a[0]) / d, (b[1] - a[1]) / d)
    u, w = unit(corner, before), unit(corner, after)
    half = math.acos(u[0] * w[0] + u[1] * w[1]) / 2
    tangent = radius / math.tan(half)
    bisector = unit((0, 0), (u[0] + w[0], u[1] + w[1]))
    centre = [corner[k] + bisector[k] * radius / math.sin(half) for k in (0, 1)]
    first = [corner[k] + u[k] * tangent for k in (0, 1)]
    last = [corner[k] + w[k] * tangent for k in (0, 1)]
    start = math.atan2(first[1] - centre[1], first[0] - centre[0])
    sweep = math.atan2(last[1] - centre[1], last[0] - centre[0]) - start
    sweep = (sweep + math.pi) % (2 * math.pi) - math.pi
    steps = 6
    return [(centre[0] + radius * math.cos(start + sweep * i / steps),
             centre[1] + radius * math.sin(start + sweep * i / steps)) for i in range(steps + 1)]


def subdivided(points, edge):
    """The polyline with points added so that no piece is longer than `edge`."""
    out = [points[0]]
    for a, b in zip(points, points[1:]):
        pieces = max(1, math.ceil(math.dist(a, b) / edge - 1e-9))
        out += [(a[0] + (b[0] - a[0]) * i / pieces, a[1] + (b[1] - a[1]) * i / pieces)
                for i in range(1, pieces + 1)]
    return out


def turned(profile, segments):
    """Facets of the surface that a profile of (r, z) points sweeps about z."""
    def point(r, z, j):
        angle = 2 * math.pi * (j % segments) / segments
        return (r * math.cos(angle), r * math.sin(angle), z)
    facets = []
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        for j in range(segments):
            a, b = point(r0, z0, j), point(r0, z0, j + 1)
            c, d = point(r1, z1, j + 1), point(r1, z1, j)
            if r0 > 0:
                facets.append((a, b, c))
            if r1 > 0:
                facets.append((a, c, d))
    return facets


def profiles(arg):
    """Corners (r, z) of the vessel, from below, and of the beam pipe."""
    z_cone = arg.tube
    z_cylinder = arg.tube + arg.cone
    z_rim = z_cylinder + arg.height

    corners = [(arg.tube_radius, 0), (arg.tube_radius, z_cone), (arg.radius, z_cylinder),
               (arg.radius, z_rim)]
    profile = [corners[0]]
    for i in (1, 2):
        profile += rounded(corners[i], corners[i - 1], corners[i + 1], arg.knuckle)
    profile.append(corners[3])

    quarter = [math.pi / 2 * i / 8 for i in range(9)]
    pipe = [(arg.pipe_radius * math.sin(q),
             z_rim - arg.pipe_depth + arg.pipe_radius * (1 - math.cos(q))) for q in quarter]
    pipe[0] = (0.0, pipe[0][1])
    pipe.append((arg.pipe_radius, z_rim))
    return profile, pipe


def main():
    arg = arguments()
    profile, pipe = profiles(arg)
    write_stl(Path(arg.out) / "vessel.stl",
              turned(subdivided(profile, arg.edge), arg.segments)
              + turned(subdivided(pipe, arg.edge), arg.segments * 2 // 5),
              "spallation-target vessel, millimetres")

    plate = 1.25 * arg.tube_radius
    rim = [(plate * math.cos(math.pi / 4 * j), plate * math.sin(math.pi / 4 * j), 0.0)
           for j in range(8)]
    write_stl(Path(arg.out) / "outlet.stl", [((0.0, 0.0, 0.0), rim[j], rim[(j + 1) % 8]) for j in range(8)],
              "plate that closes the outlet, millimetres")


if __name__ == "__main__":
    main()
