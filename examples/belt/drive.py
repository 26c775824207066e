#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.belt at several speeds; print and plot the force that drives the belt: force.png, belt_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--speeds", type=float, nargs="+", default=[1, 1.5, 2, 2.5, 3])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_belt.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.belt",
                            [{"speed": u, "picture": f"belt_{u:g}.png"} for u in a.speeds])
    runs.print_table(["speed", "flow onto the belt", "out of the chute", "force on the belt", "of flow x speed"],
                     [[f"{r['speed']:g}", f"{r['in']:.2f}", f"{r['out']:.2f}", f"{r['force']:.1f}",
                       f"{r['of_flow_times_speed']:.3f}"] for r in rows])
    with runs.plot(a.work / "force.png", "speed of the belt", "force on the belt") as axes:
        axes.plot(a.speeds, [r["force"] for r in rows], "o", label="measured")
        axes.plot(a.speeds, [r["force"] / r["of_flow_times_speed"] for r in rows], "-",
                  label="flow x speed")
        axes.legend()


if __name__ == "__main__":
    main()
