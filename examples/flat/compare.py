#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix wall/gran zplane against fix wall/lsdcd on flat meshes of 2 and 20 000 triangles.

Prints tables; writes the divergence plot. Needs build/bin/lmp-lsdcd, numpy and matplotlib.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from make_floor import floor                                                      # noqa: E402
from stl import write_stl                                                         # noqa: E402
from trajectories import (DIAMETER, LAWS, ROOT, distance, largest_difference,     # noqa: E402
                          mesh, read_dump, read_thermo, run_script)

PLANE = {"wall": "wall/gran", "at": "zplane 0 NULL"}


def single(work, floors):
    print("One sphere, 3000 steps: plane against mesh")
    print(f"{'law':16s}{'triangles':>10s}  {'largest |dF|/max|F|':>20s}  {'largest |dx|/diameter':>21s}")
    for name, law in LAWS.items():
        tag = name.replace("/", "-")
        run_script(HERE / "in.single", work / f"single-{tag}-plane", law=law, **PLANE)
        _, plane = read_dump(work / f"single-{tag}-plane/dump.txt")
        for n, path in floors.items():
            folder = work / f"single-{tag}-{n}"
            run_script(HERE / "in.single", folder, law=law, **mesh(path))
            _, ours = read_dump(folder / "dump.txt")
            d_force, d_place = largest_difference(plane, ours)
            print(f"{name:16s}{n:10d}  {d_force:20.2e}  {d_place:21.2e}")


def bed(work, path, n, plot):
    runs = {"plane, 1 process": (1, PLANE), "plane, 2 processes": (2, PLANE),
            "mesh, 1 process": (1, mesh(path, "periodic")), "mesh, 2 processes": (2, mesh(path, "periodic"))}
    data, thermo = {}, {}
    for name, (ranks, wall) in runs.items():
        folder = work / ("bed-" + name.replace(", ", "-").replace(" ", "-"))
        run_script(HERE / "in.bed", folder, ranks=ranks, **wall)
        steps, data[name] = read_dump(folder / "dump.txt")
        thermo[name] = read_thermo(folder / "log.lammps")

    time = steps * 1e-5
    pairs = {f"plane: 1 process against 2": ("plane, 1 process", "plane, 2 processes"),
             f"plane against mesh of {n} triangles": ("plane, 1 process", "mesh, 1 process"),
             f"mesh: 1 process against 2": ("mesh, 1 process", "mesh, 2 processes")}
    apart = {label: distance(data[a], data[b]) for label, (a, b) in pairs.items()}
    print(f"\n1000 spheres, {steps[-1]} steps: largest |dx|/diameter between two runs")
    marks = [np.argmin(abs(time - t)) for t in np.linspace(0, time[-1], 7)[1:]]
    print(f"{'time':40s}" + "".join(f"{time[m]:10.3f}" for m in marks))
    for label, curve in apart.items():
        print(f"{label:40s}" + "".join(f"{curve[m]:10.1e}" for m in marks))

    print("\nThe settled bed: mean over the last quarter (standard deviation)")
    print(f"{'run':24s}{'mean height / diameter':>30s}{'lowest z / radius':>24s}{'kinetic energy per grain, J':>34s}")
    for name, rows in thermo.items():
        last = slice(3 * len(rows["Step"]) // 4, None)
        height, low, ke = rows["c_height"][last] / DIAMETER, rows["v_lowest"][last] / (DIAMETER / 2), rows["KinEng"][last]
        print(f"{name:24s}{height.mean():18.6f} ({height.std():.1e}){low.mean():14.6f} ({low.std():.0e})"
              f"{ke.mean():22.2e} ({ke.std():.0e})")

    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(6.4, 4), constrained_layout=True)
    for (label, curve), style in zip(apart.items(), ("k-", "r-", "b--")):
        axes.semilogy(time, np.maximum(curve, 1e-17), style, label=label, lw=1.3)
    axes.set(xlabel="time, s", ylabel="largest distance between two runs / diameter",
             title="1000 colliding spheres: round-off grows in both codes")
    axes.legend(loc="lower right")
    axes.grid(alpha=0.3)
    figure.savefig(plot, dpi=110)
    print(f"\nwrote {plot}")


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--work", default=ROOT / "build/examples/flat", help="folder for the runs")
    p.add_argument("--plot", default=ROOT / "build/examples/divergence.png")
    p.add_argument("--only", choices=("single", "bed"))
    arg = p.parse_args()
    work = Path(arg.work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    floors = {}
    for cells in (1, 100):
        path = work / f"floor{cells}.stl"
        write_stl(path, floor(0.064, cells), "flat floor")
        floors[2 * cells * cells] = path
    if arg.only != "bed":
        single(work, floors)
    if arg.only != "single":
        bed(work, floors[20000], 20000, arg.plot)


if __name__ == "__main__":
    main()
