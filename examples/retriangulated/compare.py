#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run the same grains on the same surface in other triangles, with fix wall/lsdcd and with LIGGGHTS.

Prints how far apart they end, and draws it against the step: retriangulated.png. Fails where the walls of
fix wall/lsdcd differ by more than round-off, or those of LIGGGHTS by less than a tenth of a diameter.
"""
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from make_walls import DIAMETER, MOVED                   # noqa: E402
from runs import environment, make_meshes, options       # noqa: E402
from trajectories import read_dump                       # noqa: E402

WALLS = {"cut in three": "cut", "shuffled": "shuffled", "some flipped": "flipped", "all of these": "recut"}
SCRIPTS = {"fix wall/lsdcd": "in.retriangulated", "LIGGGHTS 3.8": "in.liggghts"}
STEPS = 3000
ULP = 2.0 ** -50    # m: between neighbouring doubles from 4 to 8, the largest coordinates


def places(a, name, wall, grains="grains"):
    """Steps, and places[step, grain, axis]."""
    program = shutil.which("liggghts") if name.startswith("LIGGGHTS") else Path(a.lmp).resolve()
    dump = a.work / f"{SCRIPTS[name]}-{wall}-{grains}.txt"
    command = [program, "-in", HERE / SCRIPTS[name], "-log", "none", "-var", "wall", f"{wall}.stl",
               "-var", "grains", f"{grains}.data", "-var", "dump", dump.name, "-var", "steps", str(STEPS)]
    with environment() as env:
        done = subprocess.run(command, cwd=a.work, env=env, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(done.stdout[-2000:])
    steps, data = read_dump(dump)
    if steps[-1] != STEPS or not np.isfinite(data).all():
        raise SystemExit(f"{dump}: steps are missing, or a place is no number")
    return steps, data


def apart(one, other):
    """Distances in diameters: [step, grain]."""
    return np.linalg.norm(one - other, axis=2) / DIAMETER


def measure(a, name):
    """Prints the table's rows of a program; steps and curves for the plot, and the largest growth of a shift."""
    steps, bowl = places(a, name, "bowl")
    moved = apart(bowl, places(a, name, "bowl", "moved")[1])
    cases = {case: apart(bowl, places(a, name, wall)[1]) for case, wall in WALLS.items()}
    cases["same triangles, start moved"] = moved
    for case, curve in cases.items():
        print(f"| {name} | {case} | {np.median(curve[-1]):.1e} | {curve[-1].max():.1e} "
              f"| {np.sum(curve[-1] > 1e-9)} of {curve.shape[1]} |")
    return steps, cases, moved.max() * DIAMETER / MOVED


def check(name, cases, growth):
    largest = cases["all of these"].max()
    print(f"{name}: a shift of the start grows {growth:.0f} times at most")
    if name.startswith("LIGGGHTS"):
        if largest < 0.1:
            raise SystemExit(f"{name}: the walls are {largest:.1e} diameters apart, and README says that they differ")
        return
    # Each step may round a coordinate by an ulp, at worst always to the same side, and each of these
    # shifts grows at most as a shift at the start does, which the run with moved grains shows.
    bound = STEPS * ULP * growth / DIAMETER
    print(f"so round-off may be up to {bound:.1e} diameters")
    largest = max(cases[case].max() for case in WALLS)
    if largest > bound:
        raise SystemExit(f"{name}: the walls are {largest:.1e} diameters apart: more than round-off")


def draw(told, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for (name, (steps, cases, _)), colour in zip(told.items(), ("#0072b2", "#d55e00")):
        for case, style, label in (("all of these", "-", f"{name}, other triangles"),
                                   ("same triangles, start moved", ":", f"{name}, start moved by 1e-12 m")):
            axes.semilogy(steps, np.maximum(cases[case].max(axis=1), 1e-16), style, color=colour, lw=1.8, label=label)
    axes.set_xlabel("step", fontsize=12)
    axes.set_ylabel("largest distance / diameter of a grain", fontsize=12)
    axes.set_xlim(0, STEPS)
    axes.grid(alpha=0.3)
    axes.legend(loc="lower center", bbox_to_anchor=(0.46, 1.01), ncol=2, fontsize=9.5, frameon=False)
    figure.savefig(path, dpi=110)
    print(path)


def main():
    p = options(__doc__, HERE)
    p.add_argument("--rain", type=int, default=1, help="random seed of the grains")
    p.add_argument("--only", choices=SCRIPTS, help="one program, without the plot")
    a = p.parse_args()
    names = [a.only] if a.only else list(SCRIPTS)
    if "LIGGGHTS 3.8" in names and not shutil.which("liggghts"):
        print("SKIPPED: LIGGGHTS (not installed; Debian's package is liggghts)")
        names.remove("LIGGGHTS 3.8")
        if a.only:
            sys.exit(77)
    make_meshes(HERE / "make_walls.py", a.work, "--rain", a.rain)
    print("\n| program | wall | median of the grains | largest | above 1e-9 |\n"
          "| --- | --- | --- | --- | --- |")
    told = {name: measure(a, name) for name in names}
    print()
    for name, (_, cases, growth) in told.items():
        check(name, cases, growth)
    if not a.only:
        draw(told, a.work / "retriangulated.png")


if __name__ == "__main__":
    main()
