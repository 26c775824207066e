#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Measures what settings buy and cost, and writes the first part of doc/accuracy.md.

usage: tradeoff.py [--build DIR] [--device cpu|cuda|auto] [--write-only] [--rows-to DIR]

Runs `lsdcd tradeoff` on the vessel of examples/vessel and on a cylinder of 1e4 triangles.
Rows are kept in doc/data, those of the GPU in files of their own; the document and the
plots are made from what is kept there. --rows-to DIR leaves the rows in DIR and writes
nothing else: for a GPU elsewhere, as
  tradeoff.py --device cuda --rows-to DIR        (then copy DIR/*.csv to doc/data)
"""
import argparse
import csv
import os
import subprocess
import sys

from accuracy import gpu_is_there, step_row
from hard_cases import ROOT, put_between

sys.path.insert(0, os.path.join(ROOT, "src", "tool"))
import plot_tradeoff    # noqa: E402

DOCUMENT = os.path.join(ROOT, "doc", "accuracy.md")
DATA = os.path.join(ROOT, "doc", "data")
PLOT = os.path.join(ROOT, "doc", "img", "tradeoff_{}.png")
BEGIN, END = "<!-- tradeoff:begin -->", "<!-- tradeoff:end -->"
DEVICES = ("cpu", "cuda")
MESHES = {
    "vessel": ["--scale", "0.001", "--radius", "0.00135", "0.0014", "0.00145", "0.0015", "0.00155"],
    "cylinder": ["--radius", "0.2", "0.4", "0.6", "0.8", "1"],
}


def mesh_file(mesh, build):
    if mesh == "vessel":
        return os.path.join(ROOT, "examples", "vessel", "vessel.stl")
    path = os.path.join(build, "bench", "cylinder.stl")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    subprocess.run([sys.executable, os.path.join(ROOT, "examples", "cylinder", "make_cylinder.py"),
                    path, "--radius", "50", "--length", "100", "--segments", "100", "--rings", "50"],
                   check=True, stdout=subprocess.DEVNULL)
    return path


def kept(mesh, device, folder=DATA):
    return os.path.join(folder, f"tradeoff_{mesh}_{device}.csv")


def run(mesh, device, build, folder, seconds):
    print(f"running lsdcd tradeoff on the {mesh}, {device} ...", flush=True)
    done = subprocess.run([os.path.join(build, "bin", "lsdcd"), "tradeoff", mesh_file(mesh, build),
                           *MESHES[mesh], "--device", device, "--seconds", str(seconds),
                           "--csv", kept(mesh, device, folder), "--plot", "none"],
                          stdout=subprocess.DEVNULL)
    return done.returncode == 0


def rows_of(mesh):
    rows = []
    for device in DEVICES:
        if os.path.exists(kept(mesh, device)):
            rows += plot_tradeoff.read(kept(mesh, device))
    return rows


# ---- the document -------------------------------------------------------------------------

def percent(share):
    share = float(share)
    return "none" if share == 0 else f"{100 * share:.2g} %"


def error(value):
    value = float(value)
    return "0" if value < 1e-12 else f"{value:.0f}" if value >= 1 else f"{value:.1g}"


def find(rows, kind, **wanted):
    for row in rows:
        if row["kind"] == kind and all(row[k] == v for k, v in wanted.items()):
            return row
    return None


def has_queries(rows):
    """Rows of earlier days have no times of queries."""
    return any(row["status_ns"] for row in rows)


def line(rows, name, **wanted):
    """A row of a table, or nothing where the setting was not measured on the CPU."""
    row, gpu = find(rows, "cpu", **wanted), find(rows, "cuda", **wanted)
    if row is None:
        return ""

    def ns(row, column):
        return f"{row[column]:.3g}" if row and row[column] else "-"

    cells = [name, percent(row["missed"]), error(row["force_mean"]), error(row["force_largest"]),
             error(row["bounce_drift"]), error(row["roll_drift"]), f"{row['ns_per_sphere']:.0f}", ns(gpu, "ns_per_sphere")]
    if has_queries(rows):
        cells += [ns(row, "status_ns"), ns(gpu, "status_ns")]
    return "| " + " | ".join(cells + [f"{row['bytes'] / 1e6:.3g}"]) + " |\n"


def head(rows):
    cells = ["setting", "missed contacts", "force error, mean", "largest", "energy drift: bouncing", "rolling",
             "ns a step, CPU core", "GPU"] + ["ns a query, CPU core", "GPU"] * has_queries(rows) + ["MB"]
    return "| " + " | ".join(cells) + " |\n|" + " --- |" * len(cells) + "\n"


def lengths(rows):
    return sorted({row["grid"] for row in rows}, key=float)


def standard(rows):
    return next(row for row in rows if row["default"] == "1")


def first_screen(rows):
    default = standard(rows)["grid"]
    base = dict(grid=default, corner="blend", precision="double")
    out = head(rows) + line(rows, "**nothing** (the default)", **base, nearest="all")
    for length in lengths(rows):
        if length != default:
            times = float(length) / float(default)
            out += line(rows, f"`grid` {times:.2g} times the default", **{**base, "grid": length},
                        nearest="all")
    for precision in ("mixed", "single"):
        out += line(rows, f"`precision {precision}`", **{**base, "precision": precision},
                    nearest="all")
    out += line(rows, "`corner sum`", **{**base, "corner": "sum"}, nearest="all")
    for n in ("8", "4", "3", "2", "1"):
        out += line(rows, f"`nearest {n}`", **base, nearest=n)
    return out


def machines(rows):
    out = []
    for device in DEVICES:
        of = [r for r in rows if r["kind"] == device]
        if not of:
            out.append(f"* {device.upper()}: not run yet.")
            continue
        r = of[0]
        out.append(f"* {device.upper()}: {r['device']}, commit {r['commit']}, {r['spheres']} spheres "
                   f"in {r['order']} order, the quickest of {r['repeats']}, seed {r['seed']}.")
    return "\n".join(out)


TEXT = """{begin}

## Which setting?

**Leave it alone.** The default misses nothing, its forces are exact, and no other is faster on a CPU by more than noise.
`nearest N`, the paper's method, is for studies.

![Missed contacts and error against the time of a query](img/paper_question.png)

What N buys where both search cells: the query asks whether each sphere touches the wall, and the number at a point is N.
With 10 000 and 100 000 triangles complete lists (*all*) take at most twice the time of N = 1. With 1 000 000 N = 1 is 7.6 times
as fast, and misses 2.4 % of the contacts. A step does not search: it reads lists of the wall, and takes less time than the
quickest of these queries (hertz/history, cells of 0.2, spheres in place, no choice anew). The step is of commit {step_commit}; the queries are of the one [below](#the-papers-study-repeated). The paper's points are of its Table 2.

What the other settings do to the vessel of `examples/vessel`
({triangles} triangles, grains of {least} to {largest} m):

{first}
Times are per sphere beside the wall (in it or within reach). A *step* of `nearest N` searches cells; with *all* it
reads lists of the wall that were made before and hold. So steps of `nearest N` and of *all* are not the same work. A
*query*, which asks whether a sphere touches the wall, searches cells with both: what N saves in time is seen
[there](#against-the-mesh).
Read it so:

* **`grid`** never changes an answer. It is for memory and for the time of a set-up: a step reads each
  sphere's list of the wall, and no cells.
* **`precision mixed`, `single`:** no contact is missed, forces are good to six digits on the
  mean and to three at the worst, energy is kept as well. They gain nothing here: a CPU takes more than
  twice the time, and an H200 is as fast in doubles. They are for GPUs whose doubles are slow; none
  of these was measured.
* **`corner sum`** takes the same contacts and time, but counts shallow folds twice: see the
  drift of a rolling sphere. It is for comparing with walls that do so.
* **`nearest N`** misses contacts, the more the smaller N and the larger spheres are against
  triangles and cells; a missed contact is an error of 1 for its sphere, and
  `f_ID[9]` counts the spheres for which one may be missing. Spheres sink in and are thrown
  out: drifts of 1 and more. It saves no time either: it searches cells in each step, since what it
  misses depends on the cell, where `all` reads a list. It saves the memory of complete lists, and
  repeats the paper (below).

`lsdcd tradeoff wall.stl --radius R --below 1e-3` makes the whole table and this picture for your own mesh, and prints the
words for an input script: the fastest setting with missed contacts and errors of forces below 1e-3.

![Error of forces against time and memory, vessel](img/tradeoff_vessel.png)

Missed contacts: contacts deeper than 1e-4 of a radius that `nearest all` in double precision
finds, and the setting does not. Force errors are against the same, of spheres at rest: mean,
the sum of all errors over the sum of all forces; largest, of one sphere, relative to its
force or to that of an overlap of 1 % of its radius, whichever is larger. Drift: energy that a
sphere bouncing ten times without friction, or rolling five radii without slip or damping, gains
or loses relative to the energy of its motion; median of {moving} spheres on random faces and
sides, each pulled along the normal of its face. One that leaves the wall counts with what it had
gained or lost until then, one that goes through the wall 1. About 2e-4 of the bouncing drift is the
integrator's. Spheres are uniform in the band within reach of the
wall, none deeper in it than half its radius. CPU times are those of one core with its
caches filled by other work; GPU times those of a GPU beside a CPU host, whose copies are in them.

{runs}

## A cylinder

Radius 50, length 100, {cylinder_triangles} triangles, spheres of radius {cylinder_least} to
{cylinder_largest}; sides are smooth, triangles as large as the spheres.

{cylinder}
![Error of forces against time and memory, cylinder](img/tradeoff_cylinder.png)

{cylinder_runs}

Rows of every setting, `corner sum` and the front among them, are in `doc/data/tradeoff_*.csv`.
{end}"""


def write_document(vessel, cylinder):
    v, c = vessel[0], cylinder[0]
    part = TEXT.format(
        begin=BEGIN, end=END, triangles=v["triangles"], least=v["least_radius"],
        largest=v["largest_radius"], moving=v["moving"], first=first_screen(vessel),
        runs=machines(vessel), cylinder_triangles=c["triangles"],
        cylinder_least=c["least_radius"], cylinder_largest=c["largest_radius"],
        cylinder=first_screen(cylinder), cylinder_runs=machines(cylinder), step_commit=step_row()["commit"])
    put_between(DOCUMENT, BEGIN, END, part)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="DIR",
                        help="where bin/ is")
    parser.add_argument("--device", default="auto", choices=("cpu", "cuda", "auto"),
                        help="auto: the CPU, and a GPU where there is one")
    parser.add_argument("--seconds", type=float, default=240, help="for each mesh and device (240)")
    parser.add_argument("--write-only", action="store_true",
                        help="run nothing; write from the rows in doc/data")
    parser.add_argument("--rows-to", metavar="DIR", help="leave the rows there, write nothing else")
    args = parser.parse_args(arguments)
    if not args.write_only:
        devices = [args.device]
        if args.device == "auto":
            devices = DEVICES if gpu_is_there() else ("cpu",)
        os.makedirs(args.rows_to or DATA, exist_ok=True)
        for device in devices:
            for mesh in MESHES:
                if not run(mesh, device, args.build, args.rows_to or DATA, args.seconds):
                    return 1
        if args.rows_to:
            return 0
    rows = {mesh: rows_of(mesh) for mesh in MESHES}
    if not all(rows.values()):
        print("rows are missing in doc/data; run without --write-only", file=sys.stderr)
        return 1
    for mesh in MESHES:
        plot_tradeoff.draw(rows[mesh], PLOT.format(mesh))
        print(PLOT.format(mesh))
    write_document(rows["vessel"], rows["cylinder"])
    print(DOCUMENT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
