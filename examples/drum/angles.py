#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.drum at several speeds; print and plot how steep the bed is: angles.png, drum_*.png.

The angle is that of the line from the axis to the grains' centre of mass, which is square to the
surface of a bed that is flat. Beside it: the torque on the drum, and what gravity's torque on the
grains is, which in the mean must be the same.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--speeds", type=float, nargs="+", default=[0.05, 0.1, 0.15, 0.2, 0.25])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_drum.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.drum",
                            [{"speed": w, "picture": f"drum_{w:g}.png"} for w in a.speeds])
    runs.print_table(["speed", "Froude number", "angle, degrees", "torque on the drum", "of gravity"],
                     [[f"{r['speed']:g}", f"{10 * r['speed']**2:.3g}", f"{r['angle']:.1f}",
                       f"{r['torque']:.0f}", f"{r['weight_times_lean']:.0f}"] for r in rows])
    with runs.plot(a.work / "angles.png", "Froude number, (angular speed)$^2$ x radius / gravity",
                   "angle of the bed (degrees)") as axes:
        axes.plot([10 * r["speed"]**2 for r in rows], [r["angle"] for r in rows], "o-")


if __name__ == "__main__":
    main()
