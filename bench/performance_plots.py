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
    figure, axis = axes()
    for device, rows in (("cpu", cpu), ("cuda", cuda)):
        names = dict.fromkeys(r["device"] for r in rows if r["case"] == "distance, complete, float")
        for k, name in enumerate(names):    # a curve a machine
            its = [r for r in rows if r["device"] == name]
            colour = COLOURS[device] if k == 0 else f"C{4 + k}"
            for order, style in (("random", "o-"), ("sorted", "s--")):
                points = [(x, float(r["median_ms"]) * 1e6 / float(r["spheres"]),
                           float(r["floor_ms"]) * 1e6 / float(r["spheres"]))
                          for x, r in curve(its, "query", "distance, complete, float", order)]
                if not points:
                    continue
                x, y, floor = zip(*points)
                axis.plot(x, y, style, color=colour, label=f"{label(its)}, {order}")
                if order == "random":
                    axis.plot(x, floor, ":" if len(x) > 1 else "_", color=colour,
                              label=f"{label(its)}, bytes at copy speed")
    axis.set_ylabel("time per sphere, ns")
    axis.set_title("Distance to the wall up to 1 sphere radius, in float;\n7 % of the spheres are that near")
    save(figure, axis, "performance_query.png")


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
