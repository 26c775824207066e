#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws the rows of `lsdcd tradeoff`: errors against time and memory.

usage: plot_tradeoff.py ROWS.csv PICTURE.png

Needs python3-matplotlib.
"""
import csv
import os
import sys

ZERO, BREAK = 1e-9, 3e-8    # where errors of 0, and of rounding, are drawn, and the break of the axis above them
# Settings with a name: what differs from the default, marker, colour. All others are grey dots.
NAMED = [("the default", {}, "*", "#000000"), ("nearest 8", {"nearest": "8"}, "D", "#009E73"),
         ("nearest 4", {"nearest": "4"}, "v", "#CC79A7"), ("nearest 1", {"nearest": "1"}, "X", "#E69F00")]
SETTING = ("grid", "nearest", "corner")


def shown(error):
    return max(error, ZERO)


def panel(axes, rows, key, scale, label):
    """Errors against one column, of rows of one device. The axis is broken between the errors and 0."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter
    default = next((r for r in rows if r["default"] == "1"), None)
    named = [{**{k: default[k] for k in SETTING}, **other} for _, other, _, _ in NAMED] if default else []
    axes.plot([r[key] * scale for r in rows], [shown(r["force_mean"]) for r in rows], "o", color="#999999",
              markersize=4, linestyle="none", zorder=1)
    for (name, _, marker, colour), wanted in zip(NAMED, named):
        row = next((r for r in rows if all(r[k] == v for k, v in wanted.items())), None)
        if row:
            axes.plot(row[key] * scale, shown(row["force_mean"]), marker, color=colour, label=name, linestyle="none",
                      markersize=18 if marker == "*" else 10, markeredgecolor="white", zorder=3)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(ZERO / 4, 4)
    axes.plot([0, 1], [BREAK, BREAK], marker=[(-1, -0.6), (1, 0.6)], markersize=11, linestyle="none", color="k", clip_on=False,
              transform=axes.get_yaxis_transform())
    axes.yaxis.set_major_locator(FixedLocator([ZERO, 1e-6, 1e-4, 1e-2, 1]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: "0" if y <= ZERO else f"{y:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 1.5, 2, 3, 5, 7)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(label, fontsize=14)
    axes.tick_params(labelsize=12)
    axes.grid(alpha=0.3)


def draw(rows, picture):
    """Error against time on the CPU and on a GPU; where one of them was measured, against time and memory."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        sys.exit("plot_tradeoff.py: matplotlib is missing (Debian: python3-matplotlib)")
    kinds = [k for k in ("cpu", "cuda") if any(r["kind"] == k for r in rows)]
    figure, axes = plt.subplots(1, 2, figsize=(11, 5.6), sharey=True)
    for at, kind in zip(axes, kinds):
        its = [r for r in rows if r["kind"] == kind]
        panel(at, its, "ns_per_sphere", 1, "time of a step per sphere near the wall, ns")
        at.set_title({"cpu": "one core of the CPU", "cuda": its[0]["device"].replace("CUDA, ", "")}[kind], fontsize=13)
    if len(kinds) == 1:
        panel(axes[1], [r for r in rows if r["kind"] == kinds[0]], "bytes", 1e-6, "memory of the grid, MB")
        axes[1].set_title("memory", fontsize=13)
    axes[0].set_ylabel("mean error of a force / mean force", fontsize=14)
    axes[0].plot([], [], "o", color="#999999", markersize=4, linestyle="none", label="all settings")
    first = rows[0]
    figure.suptitle(f"{first['mesh']}, {first['triangles']} triangles, radii "
                    f"{first['least_radius']} to {first['largest_radius']}", fontsize=13)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=4, fontsize=14)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(picture + ".part", dpi=100, format="png")
    os.replace(picture + ".part", picture)


def read(path):
    with open(path, newline="") as f:
        rows = list(csv.DictReader(f))
    for row in rows:
        for key in ("ns_per_sphere", "status_ns", "bytes", "force_mean"):
            row[key] = float(row[key])
    return rows


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rows = read(sys.argv[1])
    if not rows:
        sys.exit(f"plot_tradeoff.py: {sys.argv[1]} has no rows")
    draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()
