#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Which rolling friction gives the measured angle of repose? Runs in.repose at several, and plots.

A small heap is steeper or flatter by chance. So each rolling friction has several heaps, whose grains have other
random diameters and velocities, and the mean angle counts. The angle is that of a line through the heap's surface: the top of the highest grain in each ring between
a fifth and four fifths of the heap's radius, which 95 % of the grains are within.
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402

ROLLING = (0.05, 0.1, 0.2, 0.4)
FIRST_SEED = 7


def angle_of(path):
    """Degrees, of a dump of id x y z radius."""
    rows = np.array(path.read_text().split("ITEM: ATOMS")[1].split("\n", 1)[1].split(), float).reshape(-1, 5)
    from_axis, top = np.hypot(rows[:, 1], rows[:, 2]), rows[:, 3] + rows[:, 4]
    edge = np.quantile(from_axis, 0.95)
    rings = np.linspace(0.2 * edge, 0.8 * edge, 9)
    inside = [(from_axis >= lo) & (from_axis < hi) for lo, hi in zip(rings, rings[1:])]
    heights = [top[ring].max() for ring in inside]
    slope = np.polyfit(0.5 * (rings[1:] + rings[:-1]), heights, 1)[0]
    return np.degrees(np.arctan(-slope))


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--measured", type=float, default=15, help="degrees")
    p.add_argument("--seeds", type=int, default=3, help="heaps for each rolling friction (default: %(default)s)")
    a = p.parse_args()
    runs.make_meshes(HERE / "make_meshes.py", a.work)
    seeds = range(FIRST_SEED, FIRST_SEED + a.seeds)
    runs.run_scripts(a, HERE / "in.repose", [{"rolling": r, "seed": s} for r in ROLLING for s in seeds])
    heaps = np.array([[angle_of(a.work / f"heap_{r}_{s}.dump") for s in seeds] for r in ROLLING])
    angles, lowest, highest = heaps.mean(axis=1), heaps.min(axis=1), heaps.max(axis=1)
    runs.print_table(("rolling friction", "angle of repose, degrees", "lowest", "highest"),
                     [(f"{r}", *(f"{x:.1f}" for x in row)) for r, *row in zip(ROLLING, angles, lowest, highest)])
    if not min(angles) <= a.measured <= max(angles):
        raise SystemExit(f"no rolling friction of {ROLLING} gives {a.measured} degrees")
    chosen = np.interp(a.measured, *zip(*sorted(zip(angles, ROLLING))))
    print(f"calibrated: rolling friction {chosen:.3f} for {a.measured:g} degrees")
    with runs.plot(a.work / "repose.png", "rolling friction", "angle of repose, degrees") as axes:
        axes.errorbar(ROLLING, angles, (angles - lowest, highest - angles), fmt="o-", capsize=3, color="#0072B2",
                      label=f"mean, lowest and highest of {a.seeds} heaps" if a.seeds > 1 else "simulated")
        axes.axhline(a.measured, color="#D55E00", linestyle="--", label="measured")
        axes.plot([chosen], [a.measured], "s", color="#D55E00", zorder=3, label=f"calibrated: {chosen:.3f}")
        axes.legend(loc="lower right")


if __name__ == "__main__":
    main()
