# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The plots of doc/performance.md."""
import math
import os

from hard_cases import ROOT

IMAGES = os.path.join(ROOT, "doc", "img")
COLOURS = {"cpu": "tab:blue", "cuda": "tab:green"}


def axes():
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axis = plt.subplots(figsize=(7, 5.6))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("number of triangles")
    axis.grid(True, which="major", alpha=0.3)
    return figure, axis


def save(figure, axis, name):
    # Below the axes: inside, it would cover a curve.
    figure.legend(*axis.get_legend_handles_labels(), loc="lower center", ncol=2, fontsize=8)
    figure.tight_layout(rect=(0, 0.035 * math.ceil(len(axis.get_lines()) / 2) + 0.01, 1, 1))
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
        axis.set_title(label(its), fontsize=12)
        axis.grid(True, which="major", alpha=0.3)
        for item in (axis.xaxis.label, axis.yaxis.label):
            item.set_fontsize(12)
    figure.suptitle("Distance to the wall up to 1 radius, in float; 7 % of the spheres are that near", fontsize=12)
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="lower center", ncol=3, fontsize=12)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    write_image(figure, "performance_query.png")


def plot_build(cpu, cuda):
    figure, axis = axes()
    for device, rows in (("cpu", cpu), ("cuda", cuda)):
        for case, style, name in (("given cell, without copies", "o-", "grid"),
                                  ("given cell, brute force", "o:", "brute force")):
            points = [(x, float(r["median_ms"])) for x, r in curve(rows, "build", case)]
            if points:
                axis.plot(*zip(*points), style, color=COLOURS[device],
                          label=f"{name}, {label(rows)}")
    axis.set_ylabel("build time, ms")
    axis.set_title("Building a grid of cells of 0.2 for spheres of radius 1")
    save(figure, axis, "performance_build.png")
