# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The plots of doc/performance.md."""
import math
import os

from hard_cases import ROOT

IMAGES = os.path.join(ROOT, "doc", "img")
# By colour and by marker, so that a print in grey or a colour-blind reader tells them apart.
STYLES = {"cpu": dict(color="#0072B2", marker="o"), "cuda": dict(color="#D55E00", marker="^")}
FONT = 13


def axes():
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axis = plt.subplots(figsize=(8, 6))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("number of triangles")
    return figure, axis


def legible(axis):
    """Read at half the size, too."""
    axis.grid(True, which="major", alpha=0.3)
    axis.tick_params(labelsize=FONT - 1)
    for item in (axis.title, axis.xaxis.label, axis.yaxis.label):
        item.set_fontsize(FONT)


def save(figure, axis, name):
    # Below the axes: inside, it would cover a curve.
    legible(axis)
    figure.legend(*axis.get_legend_handles_labels(), loc="lower center", ncol=2, fontsize=FONT - 1)
    figure.tight_layout(rect=(0, 0.045 * math.ceil(len(axis.get_lines()) / 2) + 0.02, 1, 1))
    write_image(figure, name)


def write_image(figure, name):
    path = os.path.join(IMAGES, name)
    part = path + ".part.png"
    figure.savefig(part, dpi=110, metadata={"Software": None})
    os.replace(part, path)


def label(rows):
    return rows[0]["device"].replace("CUDA, ", "")


def curve(rows, program, case, order=""):
    return sorted((float(r["triangles"]), r) for r in rows
                  if r["program"] == program and r["case"] == case and r["order"] == order)


def plot_query(cpu, cuda):
    """Time of a distance by the size of the mesh: a panel for each processor."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    case = "distance, complete, float"
    machines = [[r for r in rows if r["device"] == name] for rows in (cpu, cuda)
                for name in dict.fromkeys(r["device"] for r in rows if r["case"] == case)]
    # One mesh is a point and no curve: such a machine has no panel.
    machines = [its for its in machines if len(curve(its, "query", case, "random")) > 1]
    figure, panels = plt.subplots(1, len(machines), figsize=(5.2 * len(machines), 4.8), squeeze=False)
    for axis, its in zip(panels[0], machines):
        for order, style, colour in (("random", "o-", "#0072B2"), ("sorted", "s--", "#D55E00")):
            points = [(x, float(r["median_ms"]) * 1e6 / float(r["spheres"]),
                       float(r["floor_ms"]) * 1e6 / float(r["spheres"]))
                      for x, r in curve(its, "query", case, order)]
            x, y, floor = zip(*points)
            axis.plot(x, y, style, color=colour, label=f"{order} order")
        axis.plot(x, floor, ":", color="black", label="bytes at copy speed")
        axis.set(xscale="log", yscale="log", xlabel="number of triangles", ylabel="time per sphere, ns")
        axis.set_title(label(its))
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
        axis.yaxis.set_minor_formatter(NullFormatter())
        legible(axis)
    figure.suptitle("Distance to the wall up to 1 radius, in float; 7 % of the spheres are that near", fontsize=FONT)
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="lower center", ncol=3, fontsize=FONT)
    figure.tight_layout(rect=(0, 0.09, 1, 1))
    write_image(figure, "performance_query.png")


def plot_build(cpu, cuda):
    figure, axis = axes()
    for device, rows in (("cpu", cpu), ("cuda", cuda)):
        for case, style, name in (("given cell, without copies", "-", "grid"),
                                  ("given cell, brute force", ":", "brute force")):
            points = [(x, float(r["median_ms"]) / 1e3) for x, r in curve(rows, "build", case)]
            if points:
                guessed = ["estimated" in r["facts"] for _, r in curve(rows, "build", case)]
                guess = ", estimated" if all(guessed) else ", partly estimated" if any(guessed) else ""
                axis.plot(*zip(*points), linestyle=style, label=f"{name}{guess}, {label(rows).split(',')[0]}", **STYLES[device])
    axis.set_ylabel("build time, s")
    axis.set_title("Building a grid of cells of 0.2 for spheres of radius 1")
    save(figure, axis, "performance_build.png")
