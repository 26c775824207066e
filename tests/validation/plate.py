#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Drives a plate into beds of grains: five packings, each with the plate's mesh cut three ways, and forces on its tip and its shaft over depth.
There is no expected number: cuts are compared with the spread of packings.

usage: plate.py [--keep] [--packings N] [--jobs N] [--commit NAME]

Prints means and spreads, and with --keep puts the rows into doc/data and the table into doc/validation.md. LSDCD_LMP names another lmp-lsdcd than that of build/.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "lammps"), str(HERE.parent.parent / "bench")]

import lmp
import rows as bench_rows
import stl
from beds import cut
from suite import DATA

KEPT = DATA / "validation_plate_cpu.csv"
D, DEPTH, THICK, SPEED, DT = 4e-3, 32e-3, 8e-3, 0.2, 2e-5
CUTS = ("two", "slivers", "cells")

LAWS = """\
variable        law string "tangential mindlin NULL 1.0 0.5 damping coeff_restitution"
pair_style      granular/lsdcd
pair_coeff      * * hertz/material 5e6 0.6 0.3 ${{law}}
neighbor        5e-4 bin
neigh_modify    delay 0 every 1 check yes
timestep        2e-5
fix             gravity all gravity/lsdcd 9.81 vector 0 0 -1
fix             move all nve/sphere
fix             floor all wall/lsdcd granular hertz/material 5e6 0.6 0.3 ${{law}} mesh floor.stl periodic log brief
"""

# Two layers of grains deep in y, periodic there and in x.
PACK = lmp.head(f"-0.048 0.048 0 {DEPTH} -0.005 0.2", "p p f", units="si") + """\
lattice         sc 4.6e-3
region          fill block INF INF INF INF 0.003 0.105 units box
create_atoms    1 region fill
variable        size atom 4e-3*(0.9+0.2*random(0,1,{seed}))
set             group all diameter v_size
set             group all density 2500
displace_atoms  all random 2e-4 2e-4 0 {seed} units box
""" + LAWS + """\
run             20000
write_restart   bed.restart
"""

DRIVE = """\
read_restart    bed.restart
reset_timestep  0
comm_modify     vel yes
""" + LAWS + """\
variable        level equal $(2*xcm(all,z))
fix             plate all wall/lsdcd granular hertz/material 5e6 0.6 0.3 ${{law}} periodic log brief &
                mesh tip_{cut}.stl move 0 0 $(v_level+0.008) motion linear 0 0 -{speed} &
                mesh shaft_{cut}.stl move 0 0 $(v_level+0.008) motion linear 0 0 -{speed}
fix_modify      plate mesh 1 names tip force_z
fix_modify      plate mesh 2 names shaft force_z
fix_modify      floor names floor force_z
compute         touch all contact/atom
compute         mean_touch all reduce ave c_touch
variable        borne equal -(v_tip_force_z+v_shaft_force_z+v_floor_force_z)/(9.81*mass(all))
thermo_style    custom step c_mean_touch
fix             forces all ave/time 1 50 50 v_tip_force_z v_shaft_force_z file forces_{cut}.txt
fix             borne all ave/time 1 {steps} {steps} v_borne
variable        start equal $(vcm(all,z))
run             {steps}
print           "plate atoms $(atoms) level $(v_level:%.9g) borne $(f_borne-(vcm(all,z)-v_start)/({steps}*dt*9.81):%.9g) coordination $(c_mean_touch:%.6g)"
"""


def write_meshes(folder):
    """The floor, and tip and shaft at each cut; z = 0 is the tip."""
    half, high = THICK / 2, 0.06

    def strip(p, q):    # between two points (x, z), over the depth of the bed
        return stl.quad((p[0], 0, p[1]), (q[0], 0, q[1]), (q[0], DEPTH, q[1]), (p[0], DEPTH, p[1]))

    def cells(p, q, rows):    # the same of triangles of a quarter of a grain
        columns = round(DEPTH / 1e-3)

        def point(i, j):
            return (p[0] + (q[0] - p[0]) * i / rows, DEPTH * j / columns, p[1] + (q[1] - p[1]) * i / rows)
        return [t for i in range(rows) for j in range(columns) for t in stl.quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1))]

    stl.write(folder / "floor.stl", strip((-0.048, 0), (0.048, 0)))
    parts = {"tip": [((-half, 0), (half, 0))], "shaft": [((-half, high), (-half, 0)), ((half, 0), (half, high))]}
    for part, lines in parts.items():
        whole = [t for p, q in lines for t in strip(p, q)]
        small = [t for p, q in lines for t in cells(p, q, 8 if part == "tip" else 60)]
        for name, triangles in zip(CUTS, (whole, cut(whole, 60), small)):
            stl.write(folder / f"{part}_{name}.stl", triangles)


def drive(seed):
    """Rows of one packing, at each cut: depth of the tip below the bed's level, m, and forces on tip and shaft, N, upwards; means over 2 mm."""
    steps, rows = round(0.032 / SPEED / DT), []
    with tempfile.TemporaryDirectory(prefix="lsdcd-") as name:
        folder = pathlib.Path(name)
        write_meshes(folder)
        lmp.run_well(PACK.format(seed=seed), folder, timeout=3000)
        for mesh in CUTS:
            said = lmp.run_well(DRIVE.format(cut=mesh, steps=steps, speed=SPEED), folder, timeout=3000)
            print(f"packing {seed}, {mesh}: " + re.search(r"^plate atoms .*", said, re.M)[0], file=sys.stderr, flush=True)
            out = lmp.read_rows(folder / f"forces_{mesh}.txt")
            for k in range(1, 13):
                # Steps whose mean depth is k times 2 mm: the tip begins 8 mm above the level.
                its = [r for r in out if abs((r[0] - 25) * DT * SPEED - 8e-3 - 2e-3 * k) < 1e-3]
                means = [sum(r[column] for r in its) / len(its) for column in (1, 2)]
                rows.append(dict(packing=seed, cut=mesh, depth=f"{2e-3 * k:g}", tip=f"{means[0]:.5g}", shaft=f"{means[1]:.5g}"))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", action="store_true", help="put the rows into doc/data, and the table into doc/validation.md")
    parser.add_argument("--packings", type=int, default=5)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--commit", default=bench_rows.commit())
    args = parser.parse_args()
    with concurrent.futures.ProcessPoolExecutor(args.jobs) as pool:
        rows = [dict(row, commit=args.commit) for rows in pool.map(drive, range(1, args.packings + 1)) for row in rows]
    print(bench_rows.as_csv(rows), end="")
    if args.keep:
        KEPT.write_text(bench_rows.as_csv(rows))
        subprocess.run([sys.executable, str(HERE.parent.parent / "bench" / "pages.py")], check=True)


if __name__ == "__main__":
    main()
