#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.screen at several strengths; print and plot what share passes: passed.png, screen_*.png.

The amplitude stays; the frequency grows as the root of the strength.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402

SIZES = ("0.6", "0.8", "0.95", "1.1")


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--strengths", type=float, nargs="+", default=[0, 1, 2, 3, 4, 6, 8])
    a = p.parse_args()
    runs.make_meshes(HERE / "make_screen.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.screen",
                            [{"strength": g, "picture": f"screen_{g:g}.png"} for g in a.strengths])
    runs.print_table(["acceleration over gravity", *(f"size {s}" for s in SIZES)],
                     [[f"{r['strength']:g}", *(f"{100 * r['passed_' + s]:.0f} %" for s in SIZES)]
                      for r in rows])
    with runs.plot(a.work / "passed.png", "largest acceleration / gravity", "share that passed") as axes:
        for s in SIZES:
            axes.plot(a.strengths, [r["passed_" + s] for r in rows], "o-", label=f"{s} apertures")
        axes.legend()


if __name__ == "__main__":
    main()
