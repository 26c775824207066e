#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.mixer at several speeds; print and plot how mixed the colours are: mixing.png, mixer_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--speeds", type=float, nargs="+", default=[0.1, 0.2, 0.3, 0.4])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_mixer.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.mixer", [{"speed": w, "out": f"mixing_{w:g}.txt",
                                                    "picture": f"mixer_{w:g}.png", "turns": 5}
                                                   for w in a.speeds])
    curves = [[[float(x) for x in line.split()] for line in (a.work / f"mixing_{w:g}.txt").open()
               if line[0] != "#"] for w in a.speeds]
    turns = range(1, 6)
    runs.print_table(["speed", "Froude number", *(f"{n} turn{'s'[:n > 1]}" for n in turns), "power"],
                     [[f"{r['speed']:g}", f"{6 * r['speed']**2:.3g}",
                       *(f"{min(curve, key=lambda row: abs(row[0] - n))[1]:.2f}" for n in turns),
                       f"{r['power']:.0f}"] for r, curve in zip(rows, curves)])
    with runs.plot(a.work / "mixing.png", "turns of the blades", "unlike neighbours / random") as axes:
        for w, curve in zip(a.speeds, curves):
            axes.plot(*zip(*curve), label=f"speed {w:g}")
        axes.legend()


if __name__ == "__main__":
    main()
