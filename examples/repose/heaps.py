#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.repose with several coefficients of rolling friction and cohesion; print the heaps, and draw them: repose_*.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402

CASES = [(0, 0), (0.1, 0), (0.3, 0), (0.1, 500), (0.1, 2000)]


def main():
    a = runs.options(__doc__, HERE).parse_args()
    runs.make_meshes(HERE / "make_repose.py", a.work)
    rows = runs.run_scripts(a, HERE / "in.repose",
                            [{"rolling": rolling, "cohesion": cohesion, "dir": a.work, "picture": f"repose_{rolling}_{cohesion}.png"}
                             for rolling, cohesion in CASES])
    runs.print_table(["rolling", "cohesion", "angle", "height", "mean distance from the axis"],
                     [[f"{r['rolling']:g}", f"{r['cohesion']:g}", f"{r['angle']:.0f}", f"{r['height']:.1f}", f"{r['distance']:.1f}"]
                      for r in rows])


if __name__ == "__main__":
    main()
