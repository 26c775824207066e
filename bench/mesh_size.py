# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A step against the size of the mesh, 1e2 to 1e7 triangles: `./run bench mesh-size`.

bench_mesh_size: spheres that all touch a closed cylinder, near lists kept; beside it the grid's
build time and memory. Words that run.py does not know go to that program. Rows are kept in doc/data/mesh-size_DEVICE.csv.
"""
import os
import subprocess

import lammps_runs
import performance
from effects import has_gpu
from hard_cases import commit
from performance import facts
from performance_plots import FONT, STYLES, label, legible, write_image

KEPT = "hertz/history, kept"


def rows_of_all():
    return {device: lammps_runs.read_rows("mesh-size", device=device) for device in performance.DEVICES}


def plot(rows_of):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    panels = [("time per contact in a step, ns", lambda r: facts(r)["ns_per_contact"]),
              ("set-up: weld and build, s", lambda r: float(facts(r)["build_ms"]) / 1e3),
              ("memory of the grid, MB", lambda r: facts(r)["grid_mb"])]
    figure, all_axes = plt.subplots(1, 3, figsize=(14, 4.8))
    for axis, (name, value) in zip(all_axes, panels):
        for device, rows in rows_of.items():
            points = sorted((float(r["triangles"]), float(value(r))) for r in rows if r["case"] == KEPT and r["order"] == "sorted")
            if points:
                axis.plot(*zip(*points), **STYLES[device])
                if axis is all_axes[0]:
                    axis.annotate(label(rows).split(",")[0], points[0], (4, 10), textcoords="offset points",
                                  color=STYLES[device]["color"], fontsize=FONT + 2)
        axis.set(xscale="log", yscale="log", xlabel="number of triangles", ylabel=name)
        legible(axis)
    figure.tight_layout()
    write_image(figure, "performance_mesh_size.png")


def main(args, words):
    """`./run bench mesh-size`; words go to bench_mesh_size (--help)."""
    if not args.write_only:
        folder = lammps_runs.rows_folder(args)
        devices = [args.only] if args.only else ["cpu"] + ["cuda"] * has_gpu()
        for device in devices:
            command = [os.path.join(args.build, "bin", "bench_mesh_size"), "--device", device, "--commit",
                       args.commit or commit(), *words, *["--quick"] * args.quick]
            print(" ".join(command), flush=True)
            done = subprocess.run(command, env={**os.environ, "OMP_NUM_THREADS": "1"},
                                  stdout=subprocess.PIPE, text=True)
            print(done.stdout, flush=True)
            if done.returncode != 0:
                return done.returncode
            lammps_runs.keep("mesh-size", performance.parse(done.stdout), folder, device)
        if folder != performance.DATA:
            return 0
    plot(rows_of_all())
    return 0
