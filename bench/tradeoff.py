#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Measures what settings buy and cost, and writes doc/accuracy.md.

usage: tradeoff.py [--build DIR] [--device cpu|cuda|auto] [--write-only] [--rows-to DIR] [--commit NAME]

Runs `lsdcd tradeoff` on the vessel of examples/vessel and on a cylinder of 1e4 triangles.
Rows are kept in doc/data, those of the GPU in files of their own; the document and its
plot are made from what is kept there. --rows-to DIR leaves the rows in DIR and writes
nothing else: for a GPU elsewhere, as
  tradeoff.py --device cuda --rows-to DIR --commit NAME    (then copy DIR/*.csv to doc/data)
"""
import argparse
import csv
import os
import subprocess
import sys

from accuracy import gpu_is_there
from hard_cases import ROOT, put_between

sys.path.insert(0, os.path.join(ROOT, "src", "tool"))
import plot_tradeoff    # noqa: E402

DOCUMENT = os.path.join(ROOT, "doc", "accuracy.md")
DATA = os.path.join(ROOT, "doc", "data")
PLOT = os.path.join(ROOT, "doc", "img", "tradeoff_vessel.png")
BEGIN, END = "<!-- tradeoff:begin -->", "<!-- tradeoff:end -->"
DEVICES = ("cpu", "cuda")
REPEATS = {"cpu": "5", "cuda": "50"}    # a GPU's steps are short, and copies vary
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


def run(mesh, device, build, folder, seconds, commit):
    print(f"running lsdcd tradeoff on the {mesh}, {device} ...", flush=True)
    done = subprocess.run([os.path.join(build, "bin", "lsdcd"), "tradeoff", mesh_file(mesh, build),
                           *MESHES[mesh], "--device", device, "--seconds", str(seconds), "--repeats", REPEATS[device],
                           "--csv", kept(mesh, device, folder), "--plot", "none"],
                          stdout=subprocess.DEVNULL)
    if done.returncode == 0 and commit:
        with open(kept(mesh, device, folder), newline="") as f:
            rows = list(csv.DictReader(f))
        with open(kept(mesh, device, folder), "w", newline="") as f:
            writer = csv.DictWriter(f, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows({**row, "commit": commit} for row in rows)
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


def line(rows, name, lengths, **wanted):
    """A row of a table, or nothing where the setting was not measured on the CPU; `lengths`: of each device's cells."""
    cpu, gpu = (find(rows, device, grid=lengths.get(device), **wanted) for device in DEVICES)
    if cpu is None:
        return ""

    def ns(row, column):
        return f"{row[column]:.3g}" if row and row[column] else "-"

    cells = [name, percent(cpu["missed"]), error(cpu["force_mean"]), error(cpu["force_largest"]),
             error(cpu["bounce_drift"]), error(cpu["roll_drift"]), f"{cpu['ns_per_sphere']:.0f}", ns(gpu, "ns_per_sphere"),
             ns(cpu, "status_ns"), ns(gpu, "status_ns"), f"{cpu['bytes'] / 1e6:.3g}"]
    return "| " + " | ".join(cells) + " |\n"


HEAD = ["setting", "missed contacts", "force error, mean", "largest", "energy drift: bouncing", "rolling",
        "ns a step, CPU core", "GPU", "ns a query, CPU core", "GPU", "MB"]


def lengths_by_share(rows):
    """By the share of the default: the length of cells of each device. A GPU's default is shorter."""
    shares = {}
    for device in DEVICES:
        of = [r for r in rows if r["kind"] == device]
        default = next((float(r["grid"]) for r in of if r["default"] == "1"), None)
        for row in of:
            shares.setdefault(f"{float(row['grid']) / default:.2g}", {})[device] = row["grid"]
    return shares


def first_screen(rows):
    shares = lengths_by_share(rows)
    default = shares.pop("1")
    base = dict(corner="blend", nearest="all")
    out = "| " + " | ".join(HEAD) + " |\n|" + " --- |" * len(HEAD) + "\n"
    out += line(rows, "**nothing** (the default)", default, **base)
    for share, lengths in sorted(shares.items()):
        if set(lengths) == set(DEVICES):
            out += line(rows, f"`grid` {share} times the default", lengths, **base)
    out += line(rows, "`corner sum`", default, **{**base, "corner": "sum"})
    for n in ("8", "3", "2", "1"):
        out += line(rows, f"`nearest {n}`", default, **{**base, "nearest": n})
    return out


def machines(rows):
    out = []
    for device in DEVICES:
        of = [r for r in rows if r["kind"] == device]
        if not of:
            out.append(f"- {device.upper()}: not run yet.")
            continue
        r = of[0]
        out.append(f"- {r['device']}: commit {r['commit']}, {r['spheres']} spheres in {r['order']} order, the quickest of "
                   f"{r['repeats']}, seed {r['seed']}.")
    return "\n".join(out)


TEXT = """{begin}
**Keep the default settings.** They miss no contact, their forces are exact, and on a CPU no other setting is faster by more than noise.
You need the rest of this page only if you want to save memory, or if you want to
know what you would lose with the method of the paper, `nearest N`.

## What the other settings do

The table compares the settings in the vessel of `examples/vessel`, which has {triangles} triangles, with grains of radii from {least} to
{largest} m:

{first}
- **`grid`** sets the length of the cells. It changes the memory and the time for building the grid, but never a result.
- **`corner sum`** adds the forces of both sides of a shallow fold in full, so that the fold is twice as stiff. You see it in the energy of
  the rolling sphere. Use it only to compare with a wall that does so.
- **`nearest N`** misses contacts. It misses more of them with a smaller N and with larger spheres. A sphere whose contact is missed sinks
  into the wall and is thrown out later. `f_ID[9]` counts the spheres for which a contact may be missing. The setting is also slower than the
  default, because it searches the cells in each step.

All steps compute in double precision. Contacts in float, which earlier builds offered, helped nobody ([figures](notes/accuracy.md#contacts-in-float)).

To measure all this for your own mesh, run `lsdcd tradeoff wall.stl --radius R --below 1e-3`. It draws a picture like the one
below, with all settings that it has tried, and prints the keywords of the fastest setting with errors below 1e-3.

![Error of forces against time, vessel](img/tradeoff_vessel.png)

How it is measured:

- *Missed* are contacts deeper than 1e-4 of a radius that the default finds and the other setting does not.
- *Force error* compares the forces on spheres at rest with those of the default. *Mean* is the sum of all errors over the sum of all forces.
  *Largest* is the error of one sphere over its force, or over the force at an overlap of 1 % of its radius if that is more.
- *Energy drift* is that of a sphere without losses that bounces ten times, or rolls five radii; the table has the median of {moving} spheres.
  About 2e-4 of the bouncing drift comes from the integrator. A sphere that goes through the wall counts 1.
- *ns* is the time per sphere near the wall. A *query* only asks whether a sphere touches. On the CPU, the caches are filled with other
  data before each step is timed, as in a real run. A step on the GPU includes copies from and to the host. `grid` differs by
  device; *MB* is the memory on the CPU.

Measured on:

{runs}

A cylinder with smooth sides gives the same picture. All rows are in
`doc/data/tradeoff_*.csv`; `./run bench accuracy` makes them.
{end}"""


def write_document(vessel):
    v = vessel[0]
    put_between(DOCUMENT, BEGIN, END, TEXT.format(
        begin=BEGIN, end=END, triangles=v["triangles"], least=v["least_radius"], largest=v["largest_radius"],
        moving=v["moving"], first=first_screen(vessel), runs=machines(vessel)))


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
    parser.add_argument("--commit", metavar="NAME", help="what was built, where git does not know")
    args = parser.parse_args(arguments)
    if not args.write_only:
        devices = [args.device]
        if args.device == "auto":
            devices = DEVICES if gpu_is_there() else ("cpu",)
        os.makedirs(args.rows_to or DATA, exist_ok=True)
        for device in devices:
            for mesh in MESHES:
                if not run(mesh, device, args.build, args.rows_to or DATA, args.seconds, args.commit):
                    return 1
        if args.rows_to:
            return 0
    rows = {mesh: rows_of(mesh) for mesh in MESHES}
    if not all(rows.values()):
        print("rows are missing in doc/data; run without --write-only", file=sys.stderr)
        return 1
    plot_tradeoff.draw(rows["vessel"], PLOT, others=False)
    write_document(rows["vessel"])
    print(DOCUMENT)
    print(PLOT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
