#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.rice with spheres, rice and tablets of the same volume; print the flow out of the hopper and the angle of the heap.

--lmp is a LAMMPS with superellipsoids, which finds the plugin by LAMMPS_PLUGIN_PATH.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--grains", nargs="+", default=["sphere", "rice", "tablet"])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_meshes.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.rice", [{"grain": grain} for grain in a.grains])
    runs.print_table(["grain", "flow, g/s", "angle of the heap"],
                     [[grain, f"{1000 * row['flow']:.1f}", f"{row['angle']:.1f} degrees"] for grain, row in zip(a.grains, rows)])


if __name__ == "__main__":
    main()
