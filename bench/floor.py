# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A mesh floor against a flat plane: `./run bench floor`.

9 801 spheres of diameter 1 rest on a floor in one layer; hooke/history, no contacts between
spheres, one core. The whole step with the floor of 2, 200 and 20 000 triangles over the whole step
of the same script with LAMMPS's own `wall/gran ... zplane`. *Large triangle added*: one more
triangle, as large as the box, above the spheres and out of their reach.
"""
import os
import random
import statistics
import sys

import lammps_runs
import rows

sys.path.insert(0, str(rows.ROOT / "examples"))
from stl import write_stl    # noqa: E402

SIDE = 99    # spheres along x and y
SPACING, GRAVITY, STIFFNESS, DT = 1.01, 1.0, 4000.0, 1e-3
HALF = 51.0
CELLS = {2: 1, 200: 10, 20000: 100}    # of the floor along x and y
PLANE, LARGE = "wall/gran zplane", ", large triangle added"
LAW = f"hooke/history {STIFFNESS} NULL 100 NULL 0.5 1"

SCRIPT = """\
units           lj
atom_style      sphere
atom_modify     map array sort {sort}
boundary        f f f
newton          off
comm_modify     vel yes cutoff 2
read_data       spheres.data
pair_style      none
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
timestep        {dt}
fix             move all nve/sphere
fix             pull all gravity {gravity} vector 0 0 -1
fix             wall all {wall}
compute         force all reduce sum fz
thermo_style    custom step atoms c_force
thermo          100000000
run             {warm}
"""


def write_spheres(path):
    """Each has sunk in by its weight, so that all are at rest; in the order of a shuffled script."""
    z = 0.5 - GRAVITY / STIFFNESS
    places = [(SPACING * (i - SIDE // 2), SPACING * (j - SIDE // 2)) for i in range(SIDE)
              for j in range(SIDE)]
    random.Random(3).shuffle(places)
    path.write_text(f"spheres\n\n{len(places)} atoms\n1 atom types\n\n{-HALF} {HALF} xlo xhi\n"
                    f"{-HALF} {HALF} ylo yhi\n-1 22 zlo zhi\n\nAtoms\n\n" +
                    "".join(f"{k} 1 1 1.90985931710274 {x:.15g} {y:.15g} {z!r}\n"    # mass 1
                            for k, (x, y) in enumerate(places, 1)))


def floor(n, large):
    step = 2 * HALF / n
    xs = [-HALF + step * i for i in range(n + 1)]
    triangles = []
    for x0, x1 in zip(xs, xs[1:]):
        for y0, y1 in zip(xs, xs[1:]):
            a, b, c, d = (x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)
            triangles += [(a, b, c), (a, c, d)]
    return triangles + [((-HALF, -HALF, 20.0), (HALF, -HALF, 20.0), (HALF, HALF, 20.0))] * large


def measure(options, folder):
    write_spheres(folder / "spheres.data")
    walls = {PLANE: (2, f"wall/gran {LAW} zplane 0 NULL")}
    for triangles in options.triangles:
        for large in (False, True):
            name = f"floor{triangles}{'-large' * large}.stl"
            write_stl(folder / name, floor(CELLS[triangles], large), "a floor")
            walls[f"floor {triangles}" + LARGE * large] = (triangles + large, f"wall/lsdcd {LAW} mesh {name}")
    found = []
    for order, sort in (("random", "0 0"), ("sorted", "1000 2.0")):
        times = {name: [] for name in walls}
        for _ in range(options.repeats):    # in turn, so that other load meets all
            for name, (_, wall) in walls.items():
                script = SCRIPT.format(sort=sort, dt=DT, gravity=GRAVITY, wall=wall, warm=options.steps // 2)
                run = lammps_runs.Run(os.path.abspath(options.lmp), script + f"run {options.steps}\n" * options.chunks, folder)
                times[name] += run.step_ms()[1:]
        plane = statistics.median(times[PLANE])
        for name, (triangles, _) in walls.items():
            found.append(rows.timed("floor", name, options.commit, triangles, SIDE * SIDE, order, times[name],
                                    steps=options.steps,
                                    over_plane=f"{statistics.median(times[name]) / plane:.4g}"))
    return found


def main():
    p = lammps_runs.parser("floor", __doc__)
    p.add_argument("--triangles", type=int, nargs="+", choices=CELLS, default=list(CELLS))
    p.add_argument("--steps", type=int, default=1000, metavar="N", help="timed as one (default 1000)")
    p.add_argument("--chunks", type=int, default=3, metavar="N", help="of these in a run (default 3)")
    p.add_argument("--repeats", type=int, default=3, metavar="N", help="of each run (default 3)")
    options = p.parse_args()
    if options.quick:
        options.steps, options.repeats = 50, 1
    with lammps_runs.work_folder(options.scripts_to) as folder:
        print(rows.as_csv(measure(options, folder)), end="")


if __name__ == "__main__":
    main()
