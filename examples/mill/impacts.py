#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.mill, and draw where on the lifters and the shell balls hit, and how hard: impacts.png; and how often balls hit the mill and each other with
which energy: spectra.png.

Checks that energies of triangles, and of bins, add up to what the fix and the compute say.
"""
import csv
import math
import shutil
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "erosion")]
import runs    # noqa: E402
from wear import read_vtp    # noqa: E402

FIELDS = {"impact_energy": "energy of impacts, W/m²", "dissipated_energy": "dissipated energy, W/m²"}
LIFTERS = 8


def strips(fields, seconds):
    """Of each strip of the inner surface that lies along the axis: its two ends in the section, and power per area by name. All lifters count as
    one, so that each strip has the mean over the eight that lie alike, which are turned to the top."""
    corners = fields["points"].reshape(-1, 3)[fields["connectivity"].reshape(-1, 3)]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    found = {}
    for triangle, area, *energies in zip(corners[:, :, ::2], areas, *(fields[name] for name in FIELDS)):
        a, b = sorted({tuple(np.round(x, 6)) for x in triangle})    # both triangles of a strip have these
        middle = math.atan2(a[1] + b[1], a[0] + b[0]) - math.pi / 2
        turn = -round(middle / (2 * math.pi / LIFTERS)) * 2 * math.pi / LIFTERS
        c, s = math.cos(turn), math.sin(turn)
        ends = tuple(sorted((round(c * x - s * z, 4), round(s * x + c * z, 4)) for x, z in (a, b)))
        found[ends] = found.get(ends, 0) + np.array([area, *energies])
    if len(found) * LIFTERS * 2 != len(corners):
        raise SystemExit(f"{len(corners)} triangles make {len(found)} strips of a lifter")
    return [(ends, dict(zip(FIELDS, sums[1:] / sums[0] / seconds))) for ends, sums in found.items()]


def draw(found, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    figure, panels = plt.subplots(1, len(FIELDS), figsize=(9, 2.6), layout="constrained", sharey=True)
    for axes, (name, title) in zip(panels, FIELDS.items()):
        lines = axes.add_collection(LineCollection([1e3 * np.array(ends) for ends, _ in found], array=np.array([of[name] for _, of in found]),
                                                   cmap="inferno", linewidths=7, capstyle="butt"))
        lines.set_clim(0)
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.set_facecolor("0.9")
        axes.set_title(title, fontsize=13)
        axes.set_xlabel("mm; the mill turns to the right" if axes is panels[0] else "mm", fontsize=12)
        figure.colorbar(lines, ax=axes, shrink=0.8)
    figure.savefig(path, dpi=100)
    print(path)


def read_spectrum(path):
    """Rows of a file of impact_spectrum, by name."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in ("energy_from", "energy_to", "impacts", "energy")}


def draw_spectra(of, seconds, path):
    """Impacts per second, and their power, in bins of equal ratio. `of`: spectra by name."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, panels = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
    for axes, (column, title) in zip(panels, (("impacts", "impacts a second"), ("energy", "their power, W"))):
        for name, rows in of.items():
            axes.stairs(rows[column] / seconds, np.append(rows["energy_from"], rows["energy_to"][-1]), label=name, linewidth=1.6)
        axes.set_xscale("log")
        axes.set_title(title, fontsize=13)
        axes.set_xlabel("energy of an impact, J", fontsize=12)
    panels[0].set_yscale("log")
    panels[0].legend(loc="lower center")
    figure.savefig(path, dpi=100)
    print(path)


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--turns", type=float, default=2)
    a = p.parse_args()
    a.work.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "mill.stl", a.work)
    row = runs.run_script(a, HERE / "in.mill", steps=50, turns=a.turns, fields="impacts.vtp")
    fields = read_vtp(a.work / "impacts.vtp")
    for name, told in (("impact_energy", row["impact_energy"]), ("dissipated_energy", row["at_walls"])):
        if abs(math.fsum(fields[name]) - told) > 1e-10 * told:
            raise SystemExit(f"triangles have {math.fsum(fields[name])} J of {name}, and the mesh has {told} J")
    spectra = {name: read_spectrum(a.work / file) for name, file in (("between balls", "balls.csv"), ("on the mill", "liner.csv"))}
    for rows, told in zip(spectra.values(), (row["hit_energy"], row["impact_energy"])):
        if abs(math.fsum(rows["energy"]) - told) > 1e-10 * told:
            raise SystemExit(f"bins have {math.fsum(rows['energy'])} J of impacts, and {told} J are told")
    draw(strips(fields, row["seconds"]), a.work / "impacts.png")
    draw_spectra(spectra, row["seconds"], a.work / "spectra.png")


if __name__ == "__main__":
    main()
