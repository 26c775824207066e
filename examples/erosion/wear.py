#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run in.erosion, and draw wear and normal stress of the chute by colour: wear.png.

Checks that the forces of chute.vtp add up to what the fix says the chute bears.
"""
import base64
import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


KINDS = {"Float64": np.float64, "Int64": np.int64, "Int32": np.int32}


def read_vtp(path):
    """Arrays by name, of a file of mesh_fields: base64 after its size in 8 bytes."""
    arrays = re.findall(r'<DataArray type="(\w+)" Name="(\w+)"[^>]*>([^<]*)<', path.read_text())
    return {name: np.frombuffer(base64.b64decode(text)[8:], KINDS[kind]) for kind, name, text in arrays}


def draw(fields, path):
    """Floor and far side of the chute, seen from in front and above; one panel a field."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection

    corners = 1e3 * fields["points"].reshape(-1, 3)[fields["connectivity"].reshape(-1, 3)]
    shown = corners[:, :, 1].mean(axis=1) > corners[:, :, 1].min() + 1e-6    # without the near side
    x, y, z = np.moveaxis(corners[shown], 2, 0)
    flat = np.stack([x + 0.5 * y, z + 0.5 * y], axis=2)
    figure, panels = plt.subplots(1, 2, figsize=(9, 4.8), layout="constrained", sharey=True)
    for axes, name, factor, title in ((panels[0], "worn_depth", 1e9, "worn depth, nm"),
                                      (panels[1], "normal_stress", 1, "normal stress, Pa")):
        value = factor * fields[name][shown]
        drawn = axes.add_collection(PolyCollection(flat, array=value, cmap="viridis", edgecolors="face", linewidths=0.3))
        drawn.set_clim(0, np.quantile(value, 0.99))
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.set_title(title, fontsize=14)    # a label of the bar would stand between both panels
        axes.set_xlabel("along the chute, mm", fontsize=14)
        axes.tick_params(labelsize=13)
        bar = figure.colorbar(drawn, ax=axes, extend="max", shrink=0.8)
        bar.ax.tick_params(labelsize=13)
    panels[0].set_ylabel("height, mm", fontsize=14)
    figure.savefig(path, dpi=100)
    print(path)


def main():
    a = runs.options(__doc__, HERE).parse_args()
    runs.make_meshes(HERE / "make_chute.py", a.work)
    told = runs.run_script(a, HERE / "in.erosion")
    fields = read_vtp(a.work / "chute.vtp")
    push = fields["force"].reshape(-1, 3)[:, 2].sum()
    print(f"the chute bears {told['push']:g} N along z, the sum over its triangles is {push:g} N")
    # The fix's number has six digits; its window is the file's.
    if abs(push / told["push"] - 1) > 1e-5:
        raise SystemExit("the sums differ")
    draw(fields, a.work / "wear.png")


if __name__ == "__main__":
    main()
