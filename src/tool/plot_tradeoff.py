#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws the rows of `lsdcd tradeoff`: errors against the time of a search and of a step, and against memory.

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


PANELS = (("search_ns", 1, "a search that keeps nothing, ns a sphere"), ("step_ns", 1, "a step with what it keeps, ns a sphere"),
          ("bytes", 1e-6, "memory of the grid, MB"))


def draw(rows, picture):
    """A row of panels for the CPU and for a GPU, as far as they were measured."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        sys.exit("plot_tradeoff.py: matplotlib is missing (Debian: python3-matplotlib)")
    kinds = [k for k in ("cpu", "cuda") if any(r["kind"] == k for r in rows)]
    height = 4.6 * len(kinds) + 1
    figure, all_axes = plt.subplots(len(kinds), len(PANELS), figsize=(15, height), sharey=True, squeeze=False)
    for axes, kind in zip(all_axes, kinds):
        its = [r for r in rows if r["kind"] == kind]
        for at, (key, scale, label) in zip(axes, PANELS):
            panel(at, its, key, scale, label)
        axes[0].set_ylabel("mean error of a force / mean force", fontsize=14)
        axes[1].set_title({"cpu": "one core of the CPU", "cuda": its[0]["device"].replace("CUDA, ", "")}[kind], fontsize=13)
    first = all_axes[0][0]
    first.plot([], [], "o", color="#999999", markersize=4, linestyle="none", label="all settings")
    figure.suptitle(f"{rows[0]['mesh']}, {rows[0]['triangles']} triangles, radii "
                    f"{rows[0]['least_radius']} to {rows[0]['largest_radius']}", fontsize=13)
    figure.legend(*first.get_legend_handles_labels(), loc="lower center", ncol=5, fontsize=14)
    figure.tight_layout(rect=(0, 0.6 / height, 1, 1))
    figure.savefig(picture + ".part", dpi=100, format="png")
    os.replace(picture + ".part", picture)


def read(path):
    with open(path, newline="") as f:
        rows = list(csv.DictReader(f))
    for row in rows:
        for key in ("search_ns", "step_ns", "bytes", "force_mean"):
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
