#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.piston; plot the stress on the bed against its strain: stress.png, piston.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    a = runs.options(__doc__, HERE).parse_args()
    runs.make_meshes(HERE / "make_piston.py", a.work)
    runs.run_scripts(a, HERE / "in.piston", [{}])
    rows = [[float(x) for x in row.split()] for row in (a.work / "stress.txt").read_text().split("\n")
            if row and row[0] != "#"]
    with runs.plot(a.work / "stress.png", "strain (%)", "stress under the piston") as axes:
        axes.plot([100 * r[0] for r in rows], [r[1] for r in rows])


if __name__ == "__main__":
    main()
