#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Where fix wall/gran of a LAMMPS gives other forces than fix wall/lsdcd, law by law.

usage: differences.py [--lmp PROGRAM]

One sphere hits a floor at a grazing angle, with spin: once the plane of fix wall/gran, once a mesh of two triangles. A
row has the largest difference of the forces, as a part of the largest force, that of the spins, and the sphere's speed
after the impact. PROGRAM is the LAMMPS whose plane is looked at, any that you have; without it that is
build/bin/lmp-lsdcd, which always runs the mesh. doc/other-walls.md has the table of several versions.
"""
import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from make_floor import floor                                                      # noqa: E402
from trajectories import ROOT, largest_difference, read_dump, run_script    # noqa: E402
from stl import write_stl                                                         # noqa: E402

HERE = Path(__file__).resolve().parent
CLASSIC = "2000 600 1700 900 0.3 1"
HERTZ = "granular hertz 8e6 20 tangential mindlin 6e6 1 0.3"
MATERIAL = "granular hertz/material 1e7 20 0.25 tangential mindlin NULL 1 0.3"
HOOKE = "granular hooke 2000 1700 tangential linear_history 600 1 0.3 damping mass_velocity"
LAWS = {
    "hooke": f"hooke {CLASSIC}",
    "hooke/history": f"hooke/history {CLASSIC}",
    "hertz/history": "hertz/history 8e6 2e6 1e7 5e6 0.3 1",
    "hertz/history, without slip": "hertz/history 8e6 2e6 1e7 5e6 100 1",
    "hooke/history, gamma_n 0": "hooke/history 2000 600 0 0 0.3 1",
    "granular hooke": HOOKE,
    "granular hertz": HERTZ,
    "granular hertz/material": MATERIAL.replace("NULL", "6e6"),
    "granular dmt": MATERIAL.replace("hertz/material", "dmt").replace("NULL", "6e6").replace("0.25 ", "0.25 0.05 "),
    "granular jkr": MATERIAL.replace("hertz/material", "jkr").replace("NULL", "6e6").replace("0.25 ", "0.25 0.05 "),
    "damping velocity": HOOKE.replace("1700", "0.05").replace("mass_velocity", "velocity"),
    "damping tsuji": HERTZ.replace("20", "0.5") + " damping tsuji",
    "damping coeff_restitution": HERTZ.replace("20", "0.5") + " damping coeff_restitution",
    "tangential linear_nohistory": HOOKE.replace("linear_history 600", "linear_nohistory"),
    "tangential mindlin NULL": MATERIAL.replace("1e7", "8e6"),
    "tangential mindlin/force": HERTZ.replace("mindlin", "mindlin/force"),
    "tangential mindlin_rescale": HERTZ.replace("mindlin", "mindlin_rescale"),
    "rolling sds": HOOKE + " rolling sds 200 10 0.1",
    "twisting sds": HOOKE + " twisting sds 1e-4 1e-6 0.1",
    "twisting marshall with linear_history": HOOKE + " twisting marshall",
    "twisting marshall with mindlin": HERTZ + " twisting marshall",
}


def version_of(program):
    text = subprocess.run([program, "-h"], stdin=subprocess.DEVNULL, capture_output=True, text=True).stdout
    match = re.search(r"Simulator - (.*)$", text, re.M)
    return match[1] if match else "an unknown version"


def compare(work, floor_file, name, law, programs):
    """The row of a law, or why there is none."""
    folder = work / re.sub(r"\W+", "-", name)
    walls = {"plane": ("wall/gran", "zplane 0 NULL"), "mesh": ("wall/lsdcd", f"mesh {floor_file}")}
    data = {}
    for at, (wall, where) in walls.items():
        os.environ["LSDCD_LMP"] = programs[at]
        try:
            run_script(HERE / "in.single", folder / at, law=law, wall=wall, at=where, steps=600)
        except SystemExit as error:
            reason = re.search(r"ERROR[^:]*: (.*)", str(error))
            return f"{at}: {reason[1] if reason else error}"
        data[at] = read_dump(folder / at / "dump.txt")[1]
    if not np.isfinite(data["plane"]).all():
        return "plane: not a number"
    force, _ = largest_difference(data["mesh"], data["plane"])
    spin = np.abs(data["mesh"][:, :, 9:] - data["plane"][:, :, 9:]).max() / np.abs(data["mesh"][:, :, 9:]).max()
    speed = {at: np.linalg.norm(rows[-1, 0, 6:9]) for at, rows in data.items()}
    return f"{force:10.1e}{spin:12.1e}{speed['plane']:14.5f}{speed['mesh']:12.5f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ours = os.environ.get("LSDCD_LMP", str(ROOT / "build/bin/lmp-lsdcd"))
    parser.add_argument("--lmp", default=ours, help="the LAMMPS whose fix wall/gran is looked at")
    parser.add_argument("--work", default=ROOT / "build/examples/differences", help="folder for the runs")
    arguments = parser.parse_args()
    programs = {"plane": str(Path(arguments.lmp).resolve()), "mesh": str(Path(ours).resolve())}
    work = Path(arguments.work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    write_stl(work / "floor.stl", floor(0.064, 1), "flat floor")

    print(f"LAMMPS {version_of(arguments.lmp)}")
    print(f"{'law':38s}{'dF/max F':>10s}{'domega/max':>12s}{'speed, plane':>14s}{'mesh, m/s':>12s}")
    for name, law in LAWS.items():
        print(f"{name:38s}{compare(work, work / 'floor.stl', name, law, programs)}", flush=True)


if __name__ == "__main__":
    main()
