# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A mesh against fix wall/gran/region of the same shape, on one core: `./run bench region`.

*Floor*: 9 801 spheres lie on a plane and move, as in `./run bench floor`; the mesh has 2 triangles. *Cylinder*: 20 000
spheres of radii 0.35 to 1 overlap the inside of a closed cylinder (radius 50, height 100) and are fixed; the mesh has 19 968
triangles. Spheres are in random order, without contacts between them. *Force*: that of a sphere of diameter 1 at rest on a shape
over that on a plane.

Times are those of the CPU, by LAMMPS's own share of it, so that other load of the machine counts less. The wall's part of a
step is the step with the wall less the step without, in the same process.
"""
import math
import os
import re
import statistics

import lammps_runs
import floor
import liggghts
import rows

LAW = floor.LAW
SPHERES, TRIANGLES = 20000, 19968
NONE, REGION, MESH = "no wall", "wall/gran/region", "wall/lsdcd"
CYLINDER = """\
units           lj
atom_style      sphere
atom_modify     map array sort 0 0
boundary        f f f
newton          off
comm_modify     vel yes cutoff 2.5
read_data       still.data
pair_style      none
neighbor        0.2 bin
neigh_modify    delay 0 every 1 check yes
timestep        1e-3
"""
SHAPES = {"floor": "plane 0 0 0 0 0 1", "cylinder": "cylinder z 0 0 50 0 100"}


def cpu_ms(output):
    """ms of CPU per step of each run that has steps."""
    loops = re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps.*?^(\S+)% CPU use", output, re.M | re.S)
    return [1e3 * float(t) * float(p) / 100 / int(n) for t, n, p in loops if int(n) > 0]


def start(case):
    if case == "cylinder":
        return CYLINDER
    text = floor.SCRIPT.format(sort="0 0", dt=floor.DT, gravity=floor.GRAVITY, wall="WALL", warm=0)
    return text[:text.index("fix             wall")]


def script(case, wall, steps, chunks):
    runs = f"thermo 100000000\nrun {max(5, steps // 2)}\n" + f"run {steps}\n" * chunks
    if wall == REGION:
        fix = f"region shape {SHAPES[case]} units box\nfix wall all wall/gran/region {LAW} region shape\n"
    else:
        fix = f"fix wall all wall/lsdcd {LAW} mesh {case}.stl log brief\n" if wall == MESH else ""
    if not fix:
        fix = "fix wall all setforce NULL NULL 0\n" if case == "floor" else ""
    return (start(case) + fix + "compute pull all reduce sum fx fy fz\nthermo_style custom step c_pull[1] c_pull[2] c_pull[3]\n" +
            runs)


def measure(options, folder):
    executable = os.path.abspath(options.lmp)
    floor.write_spheres(folder / "spheres.data")
    floor.write_stl(folder / "floor.stl", floor.floor(1, False), "a floor")
    n_round, n_along = liggghts.MESHES[TRIANGLES]
    floor.write_stl(folder / "cylinder.stl", liggghts.closed_cylinder(n_round, n_along), "closed cylinder")
    plane = (folder / "spheres.data").read_text()
    liggghts.write_spheres(folder, "at the wall", "random", SPHERES, n_round)
    (folder / "spheres.data").write_text(plane)
    found = []
    for case, spheres, triangles in (("floor", floor.SIDE ** 2, 2), ("cylinder", SPHERES, TRIANGLES)):
        times = {w: [] for w in (NONE, REGION, MESH)}
        for _ in range(options.repeats):    # in turn, so that other load meets all
            for wall, mine in times.items():
                mine += cpu_ms(lammps_runs.Run(executable, script(case, wall, options.steps, options.chunks), folder).output)[1:]
        plain = statistics.median(times[NONE])
        for wall in (REGION, MESH):
            parts = [t - plain for t in times[wall]]
            found.append(rows.timed("region", f"{case}, {wall}", options.commit, triangles if wall == MESH else 0, spheres, "random",
                                    parts, steps=options.steps, whole_ms=f"{statistics.median(times[wall]):.4g}",
                                    no_wall_ms=f"{plain:.4g}"))
    return found


# ---- forces of one sphere of diameter 1 at rest, over that on a plane ----------------------------------------------

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


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def sheet(rise):
    """Two halves that meet at x = 0 and rise to the sides."""
    return (quad((0, -4, 0), (4, -4, 4 * rise), (4, 4, 4 * rise), (0, 4, 0)) +
            quad((-4, -4, 4 * rise), (0, -4, 0), (0, 4, 0), (-4, 4, 4 * rise)))


def forces(options, folder):
    floor.write_stl(folder / "flat.stl", sheet(0.0), "flat")
    floor.write_stl(folder / "fold.stl", sheet(TILT), "fold")
    n, side = 2048, []
    ring = [(2 * math.cos(2 * math.pi * k / n), 2 * math.sin(2 * math.pi * k / n)) for k in range(n)] * 2
    for a, b in zip(ring[:n], ring[1:n + 1]):
        side += quad((*a, -4.0), (*b, -4.0), (*b, 4.0), (*a, 4.0))
    floor.write_stl(folder / "side.stl", side, "side")

    def one(at, law, wall):
        run = lammps_runs.Run(os.path.abspath(options.lmp), ONE.format(at=at, wall=wall.replace("LAW", law)), folder)
        return float(re.search(r"^FORCE (\S+)", run.output, re.M)[1])

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
            found.append(rows.timed("region", f"force, {what}, {name}", options.commit, 0, 1, "", [],
                                    over_plane=f"{one(at, law, wall) / plane:.3f}"))
    return found


def main():
    p = lammps_runs.parser("region", __doc__)
    p.add_argument("--steps", type=int, default=400, metavar="N", help="timed as one (default 400)")
    p.add_argument("--chunks", type=int, default=3, metavar="N", help="of these in a run (default 3)")
    p.add_argument("--repeats", type=int, default=3, metavar="N", help="of each run (default 3)")
    options = p.parse_args()
    if options.quick:
        options.steps, options.repeats = 20, 1
    with lammps_runs.work_folder(options.scripts_to) as folder:
        print(rows.as_csv(measure(options, folder) + forces(options, folder)), end="")


if __name__ == "__main__":
    main()
