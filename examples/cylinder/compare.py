#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix wall/gran zcylinder against fix wall/lsdcd on cylinders of N flat segments.

A mesh is another shape than the cylinder: its places differ by the sagitta, 1/N^2,
its normals by half a segment, 1/N. What it does must tend to what the cylinder does
as N grows. Needs build/bin/lmp-lsdcd and numpy.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from make_cylinder import cylinder                                                # noqa: E402
from stl import write_stl                                                         # noqa: E402
from trajectories import (DIAMETER, LAWS, ROOT, largest_difference, mesh,         # noqa: E402
                          read_dump, read_thermo, run_script)

RADIUS = 0.02
EXACT = {"wall": "wall/gran", "at": "zcylinder 0.02"}


def energy(data):
    """Of the one sphere per unit mass, with gravity along -y: motion, spin and height."""
    x, v, spin = data[:, 0, :3], data[:, 0, 6:9], data[:, 0, 9:12]
    return ((v**2).sum(1) / 2 + 0.2 * (DIAMETER / 2)**2 * (spin**2).sum(1) + 9.81 * (x[:, 1] + RADIUS))


def single(work, walls):
    print("One sphere, 30000 steps: cylinder against mesh")
    print(f"{'law':16s}{'segments':>9s}{'sagitta/diameter':>18s}{'largest |dF|/max|F|':>21s}{'largest |dx|/diameter':>23s}"
          f"{'energy left':>13s}{'cylinder':>10s}")
    for name, law in LAWS.items():
        tag = name.replace("/", "-")
        run_script(HERE / "in.single", work / f"single-{tag}-exact", law=law, **EXACT)
        _, exact = read_dump(work / f"single-{tag}-exact/dump.txt")
        for n, path in walls.items():
            folder = work / f"single-{tag}-{n}"
            run_script(HERE / "in.single", folder, law=law, **mesh(path))
            _, ours = read_dump(folder / "dump.txt")
            d_force, d_place = largest_difference(exact, ours)
            sagitta = RADIUS * (1 - np.cos(np.pi / n)) / DIAMETER
            print(f"{name:16s}{n:9d}{sagitta:18.1e}{d_force:21.2e}{d_place:23.2e}"
                  f"{energy(ours)[-1] / energy(ours)[0]:13.4f}{energy(exact)[-1] / energy(exact)[0]:10.4f}")


def bed(work, walls):
    print("\n1000 spheres in a standing cylinder: mean over the last quarter (standard deviation)")
    print(f"{'wall':20s}{'mean height / diameter':>30s}{'kinetic energy per grain, J':>34s}")
    for name, wall in {"cylinder": EXACT, **{f"{n} segments": mesh(p) for n, p in walls.items()}}.items():
        folder = work / ("bed-" + name.replace(" ", "-"))
        run_script(HERE / "in.bed", folder, **wall)
        rows = read_thermo(folder / "log.lammps")
        last = slice(3 * len(rows["Step"]) // 4, None)
        height, ke = rows["c_height"][last] / DIAMETER, rows["KinEng"][last]
        print(f"{name:20s}{height.mean():18.4f} ({height.std():.1e}){ke.mean():22.2e} ({ke.std():.0e})")


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--work", default=ROOT / "build/examples/cylinder", help="folder for the runs")
    p.add_argument("--only", choices=("single", "bed"))
    arg = p.parse_args()
    work = Path(arg.work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    walls = {}
    for n in (64, 256, 1024, 4096):
        path = work / f"cylinder{n}.stl"
        write_stl(path, cylinder(RADIUS, 0.2, n), "cylinder")
        walls[n] = path
    if arg.only != "bed":
        single(work, walls)
    if arg.only != "single":
        bed(work, walls)


if __name__ == "__main__":
    main()
