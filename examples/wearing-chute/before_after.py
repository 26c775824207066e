#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.wearing-chute, and draw the chute before and after, and its section: chute.png."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def read_stl(path):
    """Corners of a binary STL, [facet, corner, axis]."""
    row = np.dtype([("numbers", "<f4", (4, 3)), ("more", "<u2")])
    return np.fromfile(path, row, offset=84)["numbers"][:, 1:].astype(float)


def turned(corners, slope=35):
    """Along the chute, across it, and up from its upper face."""
    cosine, sine = np.cos(np.radians(slope)), np.sin(np.radians(slope))
    x, y, z = np.moveaxis(corners, 2, 0)
    return np.stack([x * cosine - z * sine, y, x * sine + z * cosine], axis=2)


def draw_solid(axes, corners, colours):
    """Seen from in front and above; what is nearer is drawn later."""
    along, across, up = np.moveaxis(corners, 2, 0)
    flat = np.stack([along + 0.45 * across, up + 0.6 * across], axis=2)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    order = np.argsort((-across + 0.5 * up).mean(axis=1))
    order = order[(normal @ (0.36, -0.48, 0.8))[order] > 0]
    shade = 0.35 + 0.65 * np.clip(normal @ (-0.55, -0.25, 0.8), 0, 1)
    colours = np.array(colours)
    colours[:, :3] *= shade[:, None]
    from matplotlib.collections import PolyCollection
    axes.add_collection(PolyCollection(flat[order], facecolors=colours[order], edgecolors=colours[order], linewidths=0.3))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def draw(before, after, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    before, after = turned(before), turned(after)
    gone = np.linalg.norm(after - before, axis=2).mean(axis=1)
    figure, panels = plt.subplots(3, 1, figsize=(7.2, 7.2), layout="constrained", height_ratios=(1, 1, 0.7))
    draw_solid(panels[0], before, np.full((len(gone), 4), (0.85, 0.87, 0.9, 1)))
    colours = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, gone.max()), "YlOrRd")
    draw_solid(panels[1], after, colours.to_rgba(gone))
    bar = figure.colorbar(colours, ax=panels[1], shrink=0.7, pad=0.01)
    bar.set_label("worn off, d", fontsize=12)
    for axes, title in zip(panels, ("before", "after", "section in the middle; heights are drawn 6 times as large")):
        axes.set_title(title, fontsize=14)
    middle = np.abs(before[:, :, 1]) < 1e-4
    for corners, colour, name in ((before, "#7A8088", "before"), (after, "#D55E00", "after")):
        for k in range(3):
            both = middle[:, k] & middle[:, (k + 1) % 3]
            for a, b in corners[both][:, [k, (k + 1) % 3]]:
                panels[2].plot((a[0], b[0]), (a[2], b[2]), color=colour, linewidth=2)
        panels[2].text(5, {"before": 0.06, "after": -0.6}[name], name, color=colour, fontsize=12)
    panels[2].set_aspect(6)
    panels[2].set_ylim(-0.9, 0.3)
    panels[2].set_xlabel("along the chute, diameters d of a grain", fontsize=12)
    panels[2].set_ylabel("height, d", fontsize=12)
    figure.savefig(path, dpi=80, bbox_inches="tight")
    print(path)


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--draw-only", action="store_true", help="draw what is in --work")
    a = p.parse_args()
    if not a.draw_only:
        runs.make_meshes(HERE / "make_chute.py", a.work)
        told = runs.run_script(a, HERE / "in.wearing-chute")
        print(f"removed {told['removed']:g}, held back {told['held_back']:g}")
    draw(read_stl(a.work / "plate.stl"), read_stl(a.work / "worn.stl"), a.work / "chute.png")


if __name__ == "__main__":
    main()
