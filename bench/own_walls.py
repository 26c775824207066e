# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A mesh beside LAMMPS's own walls, on one core: `./run bench floor` and `./run bench region`.

*floor*: 9 801 spheres of diameter 1 rest on a floor in one layer; hooke/history, no contacts between spheres. The whole step with the
floor of 2, 200 and 20 000 triangles over the whole step of the same script with `wall/gran ... zplane`. *Large triangle added*: one more
triangle, as large as the box, above the spheres and out of their reach.

*region*: the wall's part of a step, which is the step with the wall less the step without, beside `wall/gran/region` of the same shape:
the floor above, and 20 000 spheres of radii 0.35 to 1, fixed, that overlap the inside of a closed cylinder (radius 50, height 100) of
19 968 triangles. Times are those of the CPU, by LAMMPS's own share of it, so that other load of the machine counts less. *Force*: that of
a sphere of diameter 1 at rest on a shape over that on a plane.
"""
import math
import random
import re
import statistics
import sys

import liggghts
from lammps import Program, bench, in_turn
from rows import timed
from stl import circle, quad, side, write_stl

SIDE = 99    # spheres along x and y
SPACING, GRAVITY, STIFFNESS, DT = 1.01, 1.0, 4000.0, 1e-3
HALF = 51.0
CELLS = {2: 1, 200: 10, 20000: 100}    # of the floor along x and y
PLANE, LARGE = "wall/gran zplane", ", large triangle added"
NONE, REGION, MESH = "no wall", "wall/gran/region", "wall/lsdcd"
LAW = f"hooke/history {STIFFNESS} NULL 100 NULL 0.5 1"
IN_CYLINDER, TRIANGLES = 20000, 19968

START = """\
units           lj
atom_style      sphere
atom_modify     map array sort {sort}
boundary        f f f
newton          off
comm_modify     vel yes cutoff 2.5
read_data       {spheres}
pair_style      none
neighbor        {skin} bin
neigh_modify    delay 0 every 1 check yes
timestep        1e-3
{fixes}
thermo          100000000
"""
ON_FLOOR = f"fix move all nve/sphere\nfix pull all gravity {GRAVITY} vector 0 0 -1"
PULL = "compute pull all reduce sum fx fy fz\nthermo_style custom step c_pull[1] c_pull[2] c_pull[3]\n"


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


def floor(n, large=False):
    xs = [-HALF + 2 * HALF / n * i for i in range(n + 1)]
    triangles = [t for x0, x1 in zip(xs, xs[1:]) for y0, y1 in zip(xs, xs[1:])
                 for t in quad((x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0))]
    return triangles + [((-HALF, -HALF, 20.0), (HALF, -HALF, 20.0), (HALF, HALF, 20.0))] * large


def runs(options):
    return f"run {options.steps // 2}\n" + f"run {options.steps}\n" * options.chunks


def measure_floor(options, folder):
    lmp = Program(options.lmp)
    write_spheres(folder / "spheres.data")
    walls = {PLANE: (2, f"wall/gran {LAW} zplane 0 NULL")}
    for triangles in options.triangles:
        for large in (False, True):
            name = f"floor{triangles}{'-large' * large}.stl"
            write_stl(folder / name, floor(CELLS[triangles], large), "a floor")
            walls[f"floor {triangles}" + LARGE * large] = (triangles + large, f"wall/lsdcd {LAW} mesh {name}")
    found = []
    for order, sort in (("random", "0 0"), ("sorted", "1000 2.0")):
        start = START.format(sort=sort, spheres="spheres.data", skin=0.1, fixes=ON_FLOOR)
        times = in_turn(options.repeats, walls, lambda name: lmp.run(
            f"{start}fix wall all {walls[name][1]}\n{PULL}{runs(options)}", folder).step_ms()[1:])
        plane = statistics.median(times[PLANE])
        for name, ms in times.items():
            found.append(timed("floor", name, options.commit, walls[name][0], SIDE * SIDE, order, ms, steps=options.steps,
                               over_plane=f"{statistics.median(ms) / plane:.4g}"))
    return found


# ---- regions ---------------------------------------------------------------------------------------

def cpu_ms(output):
    """ms of CPU per step of each run that has steps."""
    loops = re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps.*?^(\S+)% CPU use", output, re.M | re.S)
    return [1e3 * float(t) * float(p) / 100 / int(n) for t, n, p in loops if int(n) > 0]


def region_wall(case, wall):
    shape = {"floor": "plane 0 0 0 0 0 1", "cylinder": "cylinder z 0 0 50 0 100"}[case]
    if wall == REGION:
        return f"region shape {shape} units box\nfix wall all wall/gran/region {LAW} region shape\n"
    if wall == MESH:
        return f"fix wall all wall/lsdcd {LAW} mesh {case}.stl log brief\n"
    return "fix wall all setforce NULL NULL 0\n" * (case == "floor")    # so that none falls


def measure_region(options, folder):
    lmp = Program(options.lmp)
    write_spheres(folder / "spheres.data")
    write_stl(folder / "floor.stl", floor(1), "a floor")
    n_round, n_along = liggghts.MESHES[TRIANGLES]
    write_stl(folder / "cylinder.stl", liggghts.closed_cylinder(n_round, n_along), "closed cylinder")
    liggghts.write_spheres(folder, "at the wall", "random", IN_CYLINDER, n_round)
    found = []
    for case, spheres, triangles, start in (
            ("floor", SIDE ** 2, 2, START.format(sort="0 0", spheres="spheres.data", skin=0.1, fixes=ON_FLOOR)),
            ("cylinder", IN_CYLINDER, TRIANGLES, START.format(sort="0 0", spheres="still.data", skin=0.2, fixes=""))):
        times = in_turn(options.repeats, (NONE, REGION, MESH), lambda wall: cpu_ms(
            lmp.run(start + region_wall(case, wall) + PULL + runs(options), folder).output)[1:])
        plain = statistics.median(times[NONE])
        for wall in (REGION, MESH):
            found.append(timed("region", f"{case}, {wall}", options.commit, triangles if wall == MESH else 0, spheres, "random",
                               [t - plain for t in times[wall]], steps=options.steps,
                               whole_ms=f"{statistics.median(times[wall]):.4g}", no_wall_ms=f"{plain:.4g}"))
    return found + forces(lmp, options, folder)


# Of one sphere of diameter 1 at rest.
ONE = """\
units           lj
atom_style      sphere
boundary        f f f
newton          off
comm_modify     vel yes
region          box block -8 8 -8 8 -8 8
create_box      1 box
create_atoms    1 single {at} units box
set             group all diameter 1 density 1
pair_style      none
{wall}
compute         f all reduce sum fx fy fz
thermo_style    custom c_f[1] c_f[2] c_f[3]
thermo_modify   norm no
run             0
variable        f equal sqrt(c_f[1]^2+c_f[2]^2+c_f[3]^2)
print           "FORCE ${{f}}"
"""
HOOKE, HERTZ = "hooke/history 1e4 NULL 0 NULL 0 1", "hertz/history 1e4 NULL 0 NULL 0 1"
TILT = math.tan(math.radians(2.5))


def sheet(rise):
    """Two halves that meet at x = 0 and rise to the sides."""
    return (quad((0, -4, 0), (4, -4, 4 * rise), (4, 4, 4 * rise), (0, 4, 0)) +
            quad((-4, -4, 4 * rise), (0, -4, 0), (0, 4, 0), (-4, 4, 4 * rise)))


def forces(lmp, options, folder):
    write_stl(folder / "flat.stl", sheet(0.0), "flat")
    write_stl(folder / "fold.stl", sheet(TILT), "fold")
    write_stl(folder / "side.stl", side(circle(2, 2048), -4.0, 4.0), "side")

    def one(at, law, wall):
        output = lmp.run(ONE.format(at=at, wall=wall.replace("LAW", law)), folder).output
        return float(re.search(r"^FORCE (\S+)", output, re.M)[1])

    flat = "region r block -4 4 -4 4 0 4\nfix w all wall/gran/region LAW region r"
    found = []
    for what, at, law, region, mesh in (
            ("two blocks in a union, over their seam", "0 0.4 0.499", HOOKE,
             "region a block -4 0 -4 4 0 4\nregion b block 0 4 -4 4 0 4\nregion r union 2 a b", "flat.stl"),
            ("two planes in an intersect, over their fold of 5 degrees", f"0 0.4 {0.499 / math.cos(math.radians(2.5))}", HOOKE,
             f"region a plane 0 0 0 {-TILT} 0 1\nregion b plane 0 0 0 {TILT} 0 1\nregion r intersect 2 a b", "fold.stl"),
            ("inside of a cylinder of diameter 4, Hertz", "1.501 0 0", HERTZ, "region r cylinder z 0 0 2 -4 4", "side.stl")):
        plane = one("1.3 0.4 0.499", law, flat)
        walls = {REGION: f"{region}\nfix w all wall/gran/region LAW region r", MESH: f"fix w all wall/lsdcd LAW mesh {mesh}"}
        for name, wall in walls.items():
            found.append(timed("region", f"force, {what}, {name}", options.commit, 0, 1, "", [],
                               over_plane=f"{one(at, law, wall) / plane:.3f}"))
    return found


def main():
    if sys.argv.pop(1) == "floor":
        bench("floor", __doc__, measure_floor, steps=1000, quick={"steps": 50, "repeats": 1},
              words=[("--triangles", dict(type=int, nargs="+", choices=CELLS, default=list(CELLS)))])
    else:
        bench("region", __doc__, measure_region, steps=400, quick={"steps": 20, "repeats": 1})


if __name__ == "__main__":
    main()
