#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.clumps with grains of one to four spheres; print the heaps, and draw them: clumps_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    a = runs.options(__doc__, HERE).parse_args()
    runs.make_meshes(HERE / "make_clumps.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.clumps",
                            [{"spheres": n, "dir": a.work, "picture": f"clumps_{n}.png"} for n in (1, 2, 3, 4)])
    runs.print_table(["spheres of a grain", "angle", "height", "mean distance from the axis"],
                     [[f"{r['spheres']:g}", f"{r['angle']:.0f}", f"{r['height']:.1f}", f"{r['distance']:.1f}"]
                      for r in rows])


if __name__ == "__main__":
    main()
