#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the meshes of the tutorial, as CAD exports them: STL files in millimetres.

part.stl, a hopper, has the flaws that repair mends: two facets are there twice, three are wound against
the others, and one strip is 0.02 mm away from its neighbours. plate.stl closes the outlet and shows
where the mass flow is counted. tube.stl and floor.stl are for the angle of repose.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, quad, side, strip, write_stl    # noqa: E402

RADIUS, OUTLET, CONE, HEIGHT, SEGMENTS = 50, 12, 50, 120, 48
SIDES, RINGS = 24, 5    # of the hopper: facets of three grain diameters and less, for the picture of its stress


def ring(radius, z):
    points = circle(radius, SIDES)
    return [(*p, z) for p in points + points[:1]]


def main():
    p = options(__doc__)
    a = p.parse_args()
    out = Path(a.out)
    cone = [ring(OUTLET + (RADIUS - OUTLET) * k / RINGS, CONE * k / RINGS) for k in range(RINGS + 1)]
    cylinder = [ring(RADIUS, CONE + (HEIGHT - CONE) * k / RINGS) for k in range(RINGS + 1)]
    # Inwards, where the grains are.
    facets = [t[::-1] for rings in (cone, cylinder) for a, b in zip(rings, rings[1:]) for t in strip(a, b)]
    for k in (10, 90, 170):
        facets[k] = facets[k][::-1]
    for k in (20, len(facets) - 20):
        facets[k] = tuple((x, y, z + 0.02) for x, y, z in facets[k])
    facets += [facets[5], facets[150]]
    write_stl(out / "part.stl", facets, "hopper, millimetres")
    write_stl(out / "plate.stl", [t[::-1] for t in disc(circle(OUTLET + 1, SEGMENTS), 0)],
              "plate at the outlet, facing down, millimetres")
    write_stl(out / "tube.stl", side(circle(25, SEGMENTS), 0, 80), "tube, millimetres")
    write_stl(out / "floor.stl", quad((-120, -120, 0), (120, -120, 0), (120, 120, 0), (-120, 120, 0)),
              "floor, millimetres")


if __name__ == "__main__":
    main()
