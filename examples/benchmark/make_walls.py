#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write the walls of the three cases, in metres, and copy dosta.lsdcd beside them.

With --polygons: a silo and a drum of 25 sides, each cut in three ways. NAME_100.obj has 100 triangles; NAME_even.obj and NAME_slivers.obj
have --triangles on the same surface, as even as can be, and strips as long as the part.
"""
import itertools
import random
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from stl import circle, options    # noqa: E402

SIDES = 25
WALLS = {"silo_large.stl": "hopper --radius 0.1 --height 0.3 --cone 0.07 --outlet 0.03 --segments 240",
         "silo_small.stl": "hopper --radius 0.1 --height 0.3 --cone 0.08 --outlet 0.02 --segments 240",
         "drum.stl": "drum --radius 0.1 --length 0.06 --closed --segments 240",
         "box.stl": "box --width 0.1 --depth 0.06 --height 0.4",
         "plane.stl": "plane --width 0.4 --depth 0.4"}


def between(a, b, t):
    return tuple((1 - t) * p + t * q for p, q in zip(a, b))


def even(n):
    return [k / n for k in range(n + 1)]


def uneven(n, dice):
    """n + 1 fractions from 0 to 1, whose distances differ by up to a factor of 3."""
    sums = list(itertools.accumulate(dice.uniform(0.5, 1.5) for _ in range(n)))
    return [0.0] + [s / sums[-1] for s in sums]


def panel(low, high, along, up):
    """Triangles of the flat piece between the edges `low` and `high`, cut at the fractions `along` and `up`."""
    rows = [[between(between(*low, u), between(*high, u), v) for u in along] for v in up]
    return [t for one, other in zip(rows, rows[1:]) for a, b, c, d in zip(one, one[1:], other[1:], other) for t in ((a, b, c), (a, c, d))]


def sector(centre, edge, n):
    """A triangle cut into n^2 of its form."""
    rows = [[between(between(centre, edge[0], v / n), between(centre, edge[1], v / n), k / max(v, 1)) for k in range(v + 1)]
            for v in range(n + 1)]
    return [(rows[v][k], rows[v + 1][k], rows[v + 1][k + 1]) for v in range(n) for k in range(v + 1)] + \
           [(rows[v][k], rows[v + 1][k + 1], rows[v][k + 1]) for v in range(n) for k in range(v)]


def edges(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def silo(cuts, up):
    """Of the case silo, with its outlet at z = 0. `cuts`: fractions along each side; `up`: along the height of cone and bin."""
    rings = [[(*p, z) for p in circle(radius, SIDES)] for radius, z in ((0.03, 0.0), (0.1, 0.07), (0.1, 0.37))]
    return [t for low, high, heights in zip(rings, rings[1:], up) for one, other in zip(edges(low), edges(high))
            for t in panel(one, other, cuts, heights)]


def drum(cuts, up, sectors):
    """From y = 0 to 0.06. `sectors`: into how many parts the edges of a sector of an end are cut; 0: a fan at the fractions `cuts`."""
    rings = [[(x, y, z) for x, z in circle(0.1, SIDES)] for y in (0.0, 0.06)]
    triangles = [t for low, high in zip(*map(edges, rings)) for t in panel(high, low, cuts, up)]
    for ring, y, turn in ((rings[0], 0.0, 1), (rings[1], 0.06, -1)):
        for edge in edges(ring):
            rim = [between(*edge, u) for u in cuts]
            end = sector((0.0, y, 0.0), edge, sectors) if sectors else [((0.0, y, 0.0), a, b) for a, b in zip(rim, rim[1:])]
            triangles += [t[::turn] for t in end]
    return triangles


def write_obj(path, triangles):
    """With all digits: a corner that is rounded to float leaves its plane."""
    numbers = {}
    for corner in itertools.chain.from_iterable(triangles):
        numbers.setdefault(corner, len(numbers) + 1)
    with open(path, "w") as out:
        out.writelines("v {!r} {!r} {!r}\n".format(*corner) for corner in numbers)
        out.writelines("f {} {} {}\n".format(*map(numbers.get, t)) for t in triangles)
    print(f"{path}: {len(triangles)} triangles")


def main():
    p = options(__doc__)
    p.add_argument("--lsdcd", default=HERE.parents[1] / "build/bin/lsdcd", help="the tool")
    p.add_argument("--polygons", action="store_true")
    p.add_argument("--triangles", type=int, default=100000, help="of the meshes that are cut; nearly")
    a = p.parse_args()
    out, dice = Path(a.out), random.Random(1)
    out.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "dosta.lsdcd", out)
    for name, words in WALLS.items():
        subprocess.run([a.lsdcd, "generate", *words.split(), "-o", out / name], check=True, stdout=subprocess.DEVNULL)
    if not a.polygons:
        return
    one = even(1)
    # Panels are 25 mm wide, and 99 and 300 mm high; the drum's are 60 mm, and an end of it is as large as 0.87 of its shell.
    panels = a.triangles / (2 * SIDES)
    width = max(1, round((panels * 25 / 399)**0.5))
    tall = [even(max(1, round(panels / width * part))) for part in (0.25, 0.75)]
    write_obj(out / "silo_100.obj", silo(one, (one, one)))
    write_obj(out / "silo_even.obj", silo(even(width), tall))
    write_obj(out / "silo_slivers.obj", silo(uneven(round(panels / 2), dice), (one, one)))
    n = max(1, round((a.triangles / 160)**0.5))
    write_obj(out / "drum_100.obj", drum(one, one, 0))
    write_obj(out / "drum_even.obj", drum(even(n), even(max(1, round(2.2 * n))), n))
    write_obj(out / "drum_slivers.obj", drum(uneven(round(panels / 2), dice), one, 0))


if __name__ == "__main__":
    main()
