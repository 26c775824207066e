#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What accuracy costs in time: rows of `lsdcd tradeoff` on a mesh.

usage: tradeoff.py vessel|paper [--device cpu|cuda] [--commit NAME] [--quick]

vessel   that of examples/vessel, of 19264 triangles
paper    the cylinder of the paper of 2017, of 156 triangles, and spheres with radii up to 1

A time is the smallest of five runs, and beside it stands the largest. On a CPU these are runs of the program, each of which goes
through all settings: so what else the machine does meanwhile falls on all of them alike. Prints CSV.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import rows

RUNS = 5
BUILD = os.environ.get("LSDCD_BUILD", str(rows.ROOT / "build"))
TOOL = os.path.join(BUILD, "bin", "lsdcd")
VESSEL = ["--scale", "0.001", "--radius", "0.00135", "0.00145", "0.00155"]
PAPER = ["--radius", *(f"{tenths / 10}" for tenths in range(1, 11))]
# Smallest and largest of a time.
SPREADS = (("search_ns", "search_most_ns"), ("step_ns", "step_most_ns"))
OF_A_RUN = {name for names in SPREADS for name in names} | {"choice_ns", "front", "repeats"}
# Of the first run alone, as they take far longer than times.
OF_THE_FIRST = {"bounce_drift", "roll_drift", "moving"}


def run(*words):
    subprocess.run([TOOL, *map(str, words)], check=True, stdout=sys.stderr)


def mesh(name, folder):
    """The mesh's file, and the words for its spheres."""
    if name == "vessel":
        return rows.ROOT / "examples" / "vessel" / "vessel.stl", VESSEL
    path = folder / "paper.stl"
    run("generate", "cylinder", "--radius", 50, "--height", 100, "--segments", 39, "-o", path)
    return path, PAPER


def front(made):
    """Marks the rows that no other beats in the time of a step or in the mean error, and equals in the other."""
    def point(r):
        return float(r["step_ns"]), float(r["force_mean"])

    for r in made:
        r["front"] = str(int(not any(o is not r and all(a <= b for a, b in zip(point(o), point(r))) and point(o) != point(r) for o in made)))


def joined(runs):
    """Rows of several runs as one: all but the times must be the same."""
    first = runs[0]
    for other in runs[1:]:
        for a, b in zip(first, other, strict=True):
            differs = [name for name in a if name not in OF_A_RUN | OF_THE_FIRST and a[name] != b[name]]
            if differs:
                raise SystemExit(f"two runs differ in {', '.join(differs)}: {a} {b}")
            for least, most in SPREADS:
                a[least] = min(a[least], b[least], key=float)
                a[most] = max(a[most], b[most], key=float)
            a["choice_ns"] = min(a["choice_ns"], b["choice_ns"], key=float)
            a["repeats"] = str(int(a["repeats"]) + int(b["repeats"]))
    front(first)
    return first


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", choices=("vessel", "paper"))
    parser.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    parser.add_argument("--commit", default=rows.commit())
    parser.add_argument("--quick", action="store_true", help="few spheres, to see that all runs")
    args = parser.parse_args()
    runs, repeats = (RUNS, 1) if args.device == "cpu" else (1, RUNS)
    few = ["--spheres", 300, "--seconds", 1] if args.quick else ["--seconds", 3600]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path, spheres = mesh(args.mesh, folder)
        made = []
        for k in range(runs):
            csv = folder / f"{k}.csv"
            moving = [] if k == 0 else ["--moving", 1]
            run("tradeoff", path, *spheres, "--device", args.device, "--repeats", repeats, *few, *moving, "--csv", csv, "--plot", "none")
            made.append([dict(r, commit=args.commit) for r in rows.parse(csv.read_text())])
    if args.quick:    # as far as the time went
        made = [r[:min(map(len, made))] for r in made]
    print(rows.as_csv(joined(made)), end="")


if __name__ == "__main__":
    main()
