# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The plots of doc/performance.md."""
import os

from hard_cases import ROOT

IMAGES = os.path.join(ROOT, "doc", "img")
# By colour and by marker, so that a print in grey or a colour-blind reader tells them apart.
STYLES = {"cpu": dict(color="#0072B2", marker="o"), "cuda": dict(color="#D55E00", marker="^")}
FONT = 14


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


def at_end(axis, points, words, colour, above=0):
    """The name of a curve, at its last point."""
    axis.annotate(words, points[-1], (-4, 8 + above), textcoords="offset points", ha="right", color=colour, fontsize=FONT)


def plot_query(cpu, cuda):
    """Time of a distance by the size of the mesh, on a CPU core and on a GPU."""
    case = "distance, complete, float"
    figure, axis = axes()
    for device, rows in (("cpu", cpu), ("cuda", cuda)):
        for name in dict.fromkeys(r["device"] for r in rows if r["case"] == case):
            its = [r for r in rows if r["device"] == name]
            for order, style in (("random", "-"), ("sorted", "--")):
                points = [(x, float(r["median_ms"]) * 1e6 / float(r["spheres"])) for x, r in curve(its, "query", case, order)]
                if len(points) < 2:    # one mesh is a point and no curve
                    continue
                axis.plot(*zip(*points), linestyle=style, **STYLES[device])
                below = 0 if order == "random" else -34 if device == "cpu" else -62    # clear of the curves
                at_end(axis, points, f"{label(its).split(',')[0]}, {order} order", STYLES[device]["color"], below)
    axis.set_ylim(3e-3, 200)
    axis.set_ylabel("time per sphere, ns")
    axis.set_title("Distance to the wall up to 1 radius, in float")
    finish(figure, axis, "performance_query.png")


def plot_build(cpu, cuda):
    figure, axis = axes()
    for device, rows in (("cpu", cpu), ("cuda", cuda)):
        for case, style, name in (("given cell, without copies", "-", "grid"),
                                  ("given cell, brute force", ":", "brute force")):
            points = [(x, float(r["median_ms"]) / 1e3) for x, r in curve(rows, "build", case)]
            if points:
                guessed = ["estimated" in r["facts"] for _, r in curve(rows, "build", case)]
                guess = " (estimated)" if all(guessed) else " (partly)" if any(guessed) else ""
                axis.plot(*zip(*points), linestyle=style, **STYLES[device])
                at_end(axis, points, f"{name}, {label(rows).split(',')[0]}{guess}", STYLES[device]["color"])
    axis.set_ylim(1e-3, 1e8)
    axis.set_ylabel("build time, s")
    axis.set_title("Building a grid of cells of 0.2 for spheres of radius 1")
    finish(figure, axis, "performance_build.png")


def finish(figure, axis, name):
    legible(axis)
    figure.tight_layout()
    write_image(figure, name)
