#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write an uneven bowl, bowl.stl, the same surface in other triangles, and the grains above it.

cut.stl: each triangle is cut in three; shuffled.stl: in random order; flipped.stl: half of them are wound
the other way; recut.stl: all three. moved.data has the grains of grains.data, moved along x by 1e-12 m.
"""
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import options    # noqa: E402

SIDE, DIAMETER, DENSITY, MOVED = 10, 0.3, 2500, 1e-12    # SI units


def bowl(seed=1):
    """200 triangles; coordinates of nodes are multiples of 1/16 along x and y, of 1/256 along z."""
    dice = random.Random(seed)

    def node(i, j):
        x, y = (k - SIDE // 2 + dice.randint(-4, 4) / 16 for k in (i, j))
        return x, y, round(256 * (x * x + y * y) / 16) / 256

    nodes = [[node(i, j) for j in range(SIDE + 1)] for i in range(SIDE + 1)]
    triangles = []
    for i in range(SIDE):
        for j in range(SIDE):
            a, b, c, d = nodes[i][j], nodes[i + 1][j], nodes[i + 1][j + 1], nodes[i][j + 1]
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def cut_in_three(triangles):
    """Each at (2 a + b + c) / 4: a float can hold that exactly, so the point is in the triangle's plane."""
    thirds = []
    for a, b, c in triangles:
        p = tuple((2 * u + v + w) / 4 for u, v, w in zip(a, b, c))
        thirds += [(a, b, p), (b, c, p), (c, a, p)]
    return thirds


def shuffle(triangles, seed=2):
    return random.Random(seed).sample(triangles, len(triangles))


def flip_some(triangles, seed=3):
    dice = random.Random(seed)
    return [t[::-1] if dice.random() < 0.5 else t for t in triangles]


def write_wall(path, triangles):
    """As text, because LIGGGHTS takes some binary files for text, and with all digits, so that coordinates are exact."""
    with open(path, "w") as out:
        out.write("solid wall\n")
        for corners in triangles:
            out.write("facet normal 0 0 0\nouter loop\n" +
                      "".join("vertex {:.17g} {:.17g} {:.17g}\n".format(*c) for c in corners) +
                      "endloop\nendfacet\n")
        out.write("endsolid wall\n")
    print(f"{path}: {len(triangles)} triangles")


def grains(rain):
    """144 grains, each with its place and velocity, less than 1 above the bowl; `rain` is a random seed."""
    dice = random.Random(rain)
    rows = []
    for i in range(12):
        for j in range(12):
            x, y = (0.6 * (k - 5.5) + dice.uniform(-0.1, 0.1) for k in (i, j))
            z = (x * x + y * y) / 16 + dice.uniform(0.3, 0.9)
            rows.append(((x, y, z), (dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-2, 0))))
    return rows


def write_grains(path, rows, moved=0.0):
    """A data file that both programs read; `moved` is added to x."""
    half = SIDE / 2 + 1
    with open(path, "w") as out:
        out.write(f"grains\n\n{len(rows)} atoms\n1 atom types\n\n{-half} {half} xlo xhi\n{-half} {half} ylo yhi\n"
                  "-1 6 zlo zhi\n\nAtoms\n\n")
        for k, ((x, y, z), _) in enumerate(rows, 1):
            out.write(f"{k} 1 {DIAMETER} {DENSITY} {x + moved:.17g} {y:.17g} {z:.17g}\n")
        out.write("\nVelocities\n\n")
        for k, (_, v) in enumerate(rows, 1):
            out.write("{} {:.17g} {:.17g} {:.17g} 0 0 0\n".format(k, *v))
    print(f"{path}: {len(rows)} grains")


def main():
    p = options(__doc__)
    p.add_argument("--rain", type=int, default=1, help="random seed of the grains")
    a = p.parse_args()
    out, wall = Path(a.out), bowl()
    write_wall(out / "bowl.stl", wall)
    write_wall(out / "cut.stl", cut_in_three(wall))
    write_wall(out / "shuffled.stl", shuffle(wall))
    write_wall(out / "flipped.stl", flip_some(wall))
    write_wall(out / "recut.stl", flip_some(shuffle(cut_in_three(wall))))
    write_grains(out / "grains.data", grains(a.rain))
    write_grains(out / "moved.data", grains(a.rain), MOVED)


if __name__ == "__main__":
    main()
