#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.hopper with several outlets; print and plot the flow beside Beverloo's: flow.png, hopper_*.png.

Beverloo's flow is 0.58 rho sqrt(g) (D - 1.4 d)^2.5, so that flow^0.4 is a straight line over D. The
line through the measured flows gives a number in the place of 0.58, and one in that of 1.4.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--outlets", type=float, nargs="+", default=[5, 6, 7, 8])
    a = p.parse_args()
    cases = []
    for outlet in a.outlets:
        folder = a.work / f"outlet_{outlet:g}"
        runs.make_meshes(HERE / "make_hopper.py", folder, "--outlet", outlet)
        cases.append({"outlet": outlet, "dir": folder, "picture": f"hopper_{outlet:g}.png"})
    rows = runs.run_scripts(a, HERE / "in.hopper", cases)
    runs.print_table(["outlet", "flow", "Beverloo", "ratio"],
                     [[f"{r['outlet']:g}", f"{r['flow']:.1f}", f"{r['beverloo']:.1f}",
                       f"{r['ratio']:.2f}"] for r in rows])
    import numpy as np
    outlets = np.array(a.outlets)
    slope, at_zero = np.polyfit(outlets, [(r["flow"] / r["bulk_density"])**0.4 for r in rows], 1)
    print(f"line: {slope**2.5:.2f} rho sqrt(g) (D - {-at_zero / slope:.2f} d)^2.5")
    with runs.plot(a.work / "flow.png", "outlet / grain", "flow$^{2/5}$") as axes:
        axes.plot(outlets, [r["flow"]**0.4 for r in rows], "o", label="measured")
        axes.plot(outlets, [r["beverloo"]**0.4 for r in rows], "-", label="Beverloo")
        axes.legend()


if __name__ == "__main__":
    main()
