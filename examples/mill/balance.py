#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.mill with several timesteps; print what drives the mill, where the power goes, and how far the energy balance is from closing."""
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402

CAUSES = ("damping", "slider", "rolling", "twisting", "law")


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--steps", type=int, nargs="+", default=[50, 100, 150], help="in a contact of two balls")
    p.add_argument("--turns", type=float, default=1)
    p.add_argument("--diameter", type=float, default=0.016, help="of the balls, m; 0.0038 makes 30 000")
    p.add_argument("--csv", type=Path, help="also write the table, as energies in J, to this file")
    a = p.parse_args()
    a.work.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "mill.stl", a.work)
    rows = runs.run_scripts(a, HERE / "in.mill", [{"steps": n, "turns": a.turns, "diameter": a.diameter} for n in a.steps])
    runs.print_table(["steps a contact", "drive, W", *(f"{c}, W" for c in CAUSES), "remainder / work of the drive", "between balls"],
                     [[f"{r['steps']:g}", *(f"{r[k] / r['seconds']:.2f}" for k in ("drive", *CAUSES)), f"{r['remainder']:.1e}",
                       f"{r['between_balls']:.1e}"] for r in rows])
    if a.csv:
        a.csv.write_text("".join(",".join(words) + "\n" for words in (rows[0], *([f"{x:g}" for x in r.values()] for r in rows))))


if __name__ == "__main__":
    main()
