#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.wheel at several torques; print and plot how much the wheel slips: slip.png, wheel_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--torques", type=float, nargs="+", default=[600, 700, 800, 900, 1000])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_wheel.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.wheel", [{"torque": t, "out": f"wheel_{t:g}.txt", "picture": f"wheel_{t:g}.png"}
                                                   for t in a.torques])
    runs.print_table(["torque", "speed", "slip", "pull", "pull times speed over torque times turning"],
                     [[f"{r['torque']:g}", f"{r['speed']:.2f}", f"{r['slip']:.2f}", f"{r['pull']:.1f}", f"{r['useful']:.3f}"]
                      for r in rows])
    with runs.plot(a.work / "slip.png", "torque of the motor", "slip") as axes:
        axes.plot(a.torques, [r["slip"] for r in rows], "o")


if __name__ == "__main__":
    main()
