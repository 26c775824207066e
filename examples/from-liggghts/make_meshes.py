#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the meshes and the grains of the four tutorials, as text that LIGGGHTS and LAMMPS both read.

meshGran: cascade.stl, two chutes above a cup. movingMeshGran: bucket.stl. servoWall: can.stl, plate.stl.
conveyor and transfer: belt.stl, bin.stl, gate.stl. Each has its grains in NAME.data. SI units, but for bucket.stl in mm.
"""
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options, quad, strip    # noqa: E402

DENSITY = 2500


def write_text(path, triangles):
    """LIGGGHTS takes some binary files for text."""
    with open(path, "w") as out:
        out.write(f"solid {path.stem}\n")
        for corners in triangles:
            out.write("facet normal 0 0 0\nouter loop\n" +
                      "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*c) for c in corners) +
                      "endloop\nendfacet\n")
        out.write(f"endsolid {path.stem}\n")
    print(f"{path}: {len(triangles)} facets")


def write_grains(path, grains, box, types=1):
    """`grains` are (diameter, x, y, z), all of type 1."""
    text = f"grains\n\n{len(grains)} atoms\n{types} atom types\n\n"
    text += "".join(f"{lo} {hi} {a}lo {a}hi\n" for a, (lo, hi) in zip("xyz", box)) + "\nAtoms\n\n"
    text += "".join(f"{k} 1 {d:.17g} {DENSITY} {x:.17g} {y:.17g} {z:.17g}\n"
                    for k, (d, x, y, z) in enumerate(grains, 1))
    path.write_text(text)
    print(f"{path}: {len(grains)} grains")


def jittered(dice, counts, first, spacing, diameter):
    """A grid of grains, each moved by up to a tenth of the gap to the next."""
    free = (spacing - max(diameter)) / 10
    return [(dice.choice(diameter), *(f + spacing * i + dice.uniform(-free, free) for f, i in zip(first, (i, j, k))))
            for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]


def cascade():
    """Two chutes that lean against each other's end, and a cup below; y from 0 to 0.12."""
    width = 0.12

    def ramp(x0, z0, x1, z1):
        return quad((x0, 0, z0), (x1, 0, z1), (x1, width, z1), (x0, width, z0))

    sides = [t for y in (0, width) for t in
             quad((-0.1, y, 0), (0.45, y, 0), (0.45, y, 0.75), (-0.1, y, 0.75))]
    walls = ramp(-0.02, 0.55, -0.02, 0.72) + ramp(0.45, 0.36, 0.45, 0.72) + ramp(-0.1, 0, -0.1, 0.36)
    return (sides + walls + ramp(-0.02, 0.55, 0.3, 0.42) + ramp(0.45, 0.36, 0.1, 0.2) +
            ramp(-0.1, 0, 0.2, 0) + ramp(0.2, 0, 0.2, 0.15))


def bucket(radius=150, half=130, segments=12):
    """A half pipe along y with two end plates, in mm; open towards -x."""
    arc = [(radius * math.cos(t), radius * math.sin(t)) for t in
           (math.pi * (k / segments - 0.5) for k in range(segments + 1))]
    lines = [[(x, y, z) for x, z in arc] for y in (-half, half)]
    ends = [((0, y, 0), (*a[:1], y, a[1]), (*b[:1], y, b[1])) for y in (-half, half) for a, b in zip(arc, arc[1:])]
    return strip(*lines) + ends


def can(side, height):
    low = [(0, 0), (side, 0), (side, side), (0, side), (0, 0)]
    return (quad((0, 0, 0), (side, 0, 0), (side, side, 0), (0, side, 0)) +
            strip([(*p, 0) for p in low], [(*p, height) for p in low]))


def belt():
    """Its top, at z = 0, from x = -0.5 to 0.5, with rims that move along."""
    (a, b), h = (-0.09, 0.09), 0.2
    return (quad((-0.5, a, 0), (0.5, a, 0), (0.5, b, 0), (-0.5, b, 0)) +
            [t for y in (a, b) for t in quad((-0.5, y, 0), (0.5, y, 0), (0.5, y, h), (-0.5, y, h))])


def bin_():
    """It has the wall behind the belt, too."""
    low = [(-1.3, -0.15), (-0.45, -0.15), (-0.45, 0.15), (-1.3, 0.15), (-1.3, -0.15)]
    return (quad((-1.3, -0.15, -0.5), (-0.45, -0.15, -0.5), (-0.45, 0.15, -0.5), (-1.3, 0.15, -0.5)) +
            strip([(*p, -0.5) for p in low], [(*p, -0.05) for p in low]) +
            quad((-1.3, -0.15, -0.05), (-1.3, 0.15, -0.05), (-1.3, 0.15, 0.4), (-1.3, -0.15, 0.4)) +
            quad((0.49, -0.12, 0), (0.49, 0.12, 0), (0.49, 0.12, 0.2), (0.49, -0.12, 0.2)))


def main():
    p = options(__doc__)
    p.add_argument("--start", type=int, default=1, help="random seed of the places of the grains")
    a = p.parse_args()
    out, dice = Path(a.out), random.Random(a.start)
    write_text(out / "cascade.stl", cascade())
    write_grains(out / "meshGran.data", jittered(dice, (6, 4, 5), (0.005, 0.018, 0.57), 0.028, [0.02]),
                 ((-0.15, 0.5), (-0.05, 0.17), (-0.05, 0.8)))
    write_text(out / "bucket.stl", bucket())
    write_grains(out / "movingMeshGran.data", jittered(dice, (11, 4, 5), (-0.355, -0.105, 0.035), 0.07, [0.06]),
                 ((-0.4, 0.4), (-0.15, 0.15), (0, 1)))
    side = 3 * 0.02
    write_text(out / "can.stl", can(side, 0.08))
    write_text(out / "plate.stl", quad((0.001, 0.001, 0), (side - 0.001, 0.001, 0), (side - 0.001, side - 0.001, 0),
                                       (0.001, side - 0.001, 0)))
    write_grains(out / "servoWall.data", [(0.02, 0.01 + 0.02 * i, 0.01 + 0.02 * j, 0.01 + 0.02 * k)
                                          for k in range(3) for j in range(3) for i in range(3)],
                 ((-0.02, 0.08), (-0.02, 0.08), (-0.02, 0.12)))
    write_text(out / "belt.stl", belt())
    write_text(out / "bin.stl", bin_())
    write_text(out / "gate.stl", quad((-0.51, -0.2, -0.1), (-0.51, -0.2, 0.5), (-0.51, 0.2, 0.5), (-0.51, 0.2, -0.1)))
    for name, types in ("conveyor", 1), ("transfer", 3):
        write_grains(out / f"{name}.data", jittered(dice, (8, 4, 3), (0.05, -0.06, 0.04), 0.04, [0.02, 0.03]),
                     ((-1.4, 0.6), (-0.25, 0.25), (-0.6, 0.5)), types)


if __name__ == "__main__":
    main()
