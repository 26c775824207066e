#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.screw at several speeds; print and plot what it carries: flow.png, screw_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--speeds", type=float, nargs="+", default=[0.1, 0.2, 0.4, 0.6, 0.8, 1.0])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_screw.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.screw",
                            [{"speed": w, "picture": f"screw_{w:g}.png"} for w in a.speeds])
    runs.print_table(["speed", "Froude number", "mass flow", "of a pitch a turn", "torque on the screw"],
                     [[f"{r['speed']:g}", f"{6 * r['speed']**2:.3g}", f"{r['flow']:.2f}",
                       f"{r['of_a_pitch']:.3f}", f"{r['torque']:.0f}"] for r in rows])
    with runs.plot(a.work / "flow.png", "speed (radians per time)", "mass flow") as axes:
        axes.plot(a.speeds, [r["flow"] for r in rows], "o", label="measured")
        axes.plot(a.speeds, [r["flow"] / r["of_a_pitch"] for r in rows], "-", label="a pitch a turn")
        axes.legend()


if __name__ == "__main__":
    main()
