#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws the rows of `lsdcd tradeoff`: error against time and against memory.

usage: plot_tradeoff.py ROWS.csv PICTURE.png

Needs python3-matplotlib.
"""
import csv
import os
import sys

FLOOR = 1e-17    # where errors of 0 are drawn
COLOURS = {"all": "black", "1": "#d62728", "2": "#ff7f0e", "3": "#bcbd22", "4": "#2ca02c",
           "8": "#17becf"}
MARKERS = {"double": "o", "mixed": "s", "single": "^"}


def shown(error):
    return max(error, FLOOR)


def panel(axes, rows, key, scale, label):
    from matplotlib.ticker import FuncFormatter, LogLocator
    for row in rows:
        axes.plot(row[key] * scale, shown(row["force_mean"]), MARKERS[row["precision"]],
                  color=COLOURS.get(row["nearest"], "grey"), markersize=5,
                  markerfacecolor="none" if row["corner"] == "sum" else None, alpha=0.75)
    for row in rows:
        if row["default"] == "1":
            axes.plot(row[key] * scale, shown(row["force_mean"]), "*", color="gold", markersize=18,
                      markeredgecolor="black", zorder=5)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.xaxis.set_minor_formatter(FuncFormatter(lambda x, _: ""))
    axes.set_xlabel(label)
    axes.grid(alpha=0.3)


def front(axes, rows):
    steps = sorted((r["ns_per_sphere"], shown(r["force_mean"])) for r in rows if r["front"] == "1")
    if steps:
        axes.step([s[0] for s in steps], [s[1] for s in steps], where="post", color="grey",
                  linewidth=1, zorder=0)


def draw(rows, picture):
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        sys.exit("plot_tradeoff.py: matplotlib is missing (Debian: python3-matplotlib)")
    kinds = [k for k in ("cpu", "cuda") if any(r["kind"] == k for r in rows)]
    figure, axes = plt.subplots(1, len(kinds) + 1, figsize=(4.6 * (len(kinds) + 1), 4.4),
                                sharey=True, squeeze=False)
    axes = axes[0]
    for at, kind in zip(axes, kinds):
        of_kind = [r for r in rows if r["kind"] == kind]
        panel(at, of_kind, "ns_per_sphere", 1, "ns per sphere and step")
        front(at, of_kind)
        at.set_title({"cpu": "one core of the CPU", "cuda": of_kind[0]["device"]}[kind], fontsize=9)
    panel(axes[-1], [r for r in rows if r["kind"] == kinds[0]], "bytes", 1e-6, "grid, MB")
    axes[-1].set_title("memory", fontsize=9)
    axes[0].set_ylabel("mean error of forces (0 at the bottom)")
    for name, colour in COLOURS.items():
        if any(r["nearest"] == name for r in rows):
            axes[-1].plot([], [], "o", color=colour, label="nearest " + name)
    for name, marker in MARKERS.items():
        axes[-1].plot([], [], marker, color="grey", label="precision " + name)
    axes[-1].plot([], [], "o", color="grey", markerfacecolor="none", label="corner sum")
    axes[-1].plot([], [], "*", color="gold", markeredgecolor="black", markersize=12,
                  label="the default")
    axes[-1].plot([], [], "-", color="grey", label="front")
    axes[-1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
    first = rows[0]
    figure.suptitle(f"{first['mesh']}, {first['triangles']} triangles, radii "
                    f"{first['least_radius']} to {first['largest_radius']}", fontsize=10)
    figure.tight_layout()
    figure.savefig(picture + ".part", dpi=110, format="png")
    os.replace(picture + ".part", picture)


def read(path):
    with open(path, newline="") as f:
        rows = list(csv.DictReader(f))
    for row in rows:
        for key in ("ns_per_sphere", "status_ns", "bytes", "force_mean"):
            row[key] = float(row.get(key, 0))    # rows of earlier days have no status_ns
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
