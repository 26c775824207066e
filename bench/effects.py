#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Measures what every effect of a wall costs and writes the tables of doc/effects.md.

usage: effects.py [--build DIR] [--write-only] [--only cpu|cuda|bodies]

Runs bench_effects on one core and, where there is a GPU, with CUDA, and bench_rigid on one core. Rows are kept in
doc/data/effects_DEVICE.csv and effects_bodies_cpu.csv, so that the document has those of a device on a machine without
it too.
--write-only makes the tables and the plot from what is kept.
"""
import argparse
import csv
import os
import re
import subprocess
import sys

from hard_cases import ROOT, commit, write_whole

DOCUMENT = os.path.join(ROOT, "doc", "effects.md")
PLOT = os.path.join(ROOT, "doc", "img", "effects.png")
DEVICES = {"cpu": ["5000", "401"], "cuda": ["200000", "31"]}    # spheres, repeats
OF_RIGID = ["5000", "61"]    # spheres, rounds of 100 steps
NOISE = 3    # ns; doc/effects.md says so
BEGIN, END = "<!-- costs:begin -->", "<!-- costs:end -->"
OF_BODIES = "<!-- bodies:begin -->", "<!-- bodies:end -->"


def kept(device):
    return os.path.join(ROOT, "doc", "data", f"effects_{device}.csv")


def rows_of(device):
    if not os.path.exists(kept(device)):
        return {}
    with open(kept(device), newline="") as f:
        return {row["name"]: row for row in csv.DictReader(f, delimiter=";")}


def has_gpu():
    try:
        return subprocess.run(["nvidia-smi", "-L"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def measure(build, device):
    command = [os.path.join(build, "bin", "bench_effects"), device, *DEVICES[device], commit()]
    print(" ".join(command), flush=True)
    threads = "1" if device == "cpu" else str(os.cpu_count() or 1)
    done = subprocess.run(command, env=dict(os.environ, OMP_NUM_THREADS=threads), stdout=subprocess.PIPE, text=True)
    if done.returncode == 0:
        write_whole(kept(device), done.stdout)
    return done.returncode == 0


def measure_bodies(build):
    command = [os.path.join(build, "bin", "bench_rigid"), *OF_RIGID, commit()]
    print(" ".join(command), flush=True)
    done = subprocess.run(command, env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=subprocess.PIPE, text=True)
    if done.returncode == 0:
        write_whole(kept("bodies_cpu"), done.stdout)
    return done.returncode == 0


def ns(row, column):
    return f"{float(row[column]):.3g}" if row else ""


def over(row):
    return f"{float(row['over_ns']):+.1f}" if row and row["over"] else ""


def table(rows, heads, cells):
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(cells(r)) + " |" for r in rows])


def tables(cpu, cuda):
    first = next(iter(cpu.values()))
    facts = (f"The CPU's times are the least of {first['repeats']} rounds with {first['contacts']} contacts on one core "
             f"(commit {first['commit']}, {first['compiler']}).")
    if cuda:
        g = next(iter(cuda.values()))
        facts += (f" The GPU's are the least of {g['repeats']} rounds with {g['contacts']} contacts on an "
                  f"{g['device'].replace('CUDA, ', '')} (commit {g['commit']}). They include the copies to and from it and "
                  "the host's part of a step.")
    else:
        facts += " No rows of a GPU are kept yet."
    alone = [r for r in cpu.values() if r["over"] or r["name"] == "hooke"]
    several = [r for r in cpu.values() if not r["over"] and r["name"] != "hooke"]

    def cells(r):
        g = cuda.get(r["name"])
        return [r["name"], f"`{r['words']}`", ns(r, "min_ns"), over(r), ns(g, "min_ns"), over(g),
                r["over"], r["bytes_per_atom"], r["bytes_per_contact"]]

    heads = ["effect", "turned on by", "CPU, ns", "more than without", "GPU, ns",
             "more than without", "without is", "B/atom", "B/contact"]
    kept = [k for k, head in enumerate(heads) if "without" not in head]    # a combination is over none
    return "\n\n".join([facts, "This table has each effect alone:", table(alone, heads, cells), "This one has common combinations:",
                        table(several, [heads[k] for k in kept], lambda r: [cells(r)[k] for k in kept])])


def table_of_bodies(rows):
    first = next(iter(rows.values()))
    facts = f"One core, commit {first['commit']}, {first['compiler']}, least of {first['repeats']} rounds."

    def whole(number):
        return f"{number:.0f}" if number >= 100 else f"{number:.3g}"

    def cells(r):    # bytes are for each body, and for each contact of a coat
        least, stored = float(r["min_ns"]), int(r["saved_bytes"])
        return [r["name"], f"`{r['words']}`", whole(least) if least else "",
                "+" + whole(float(r["over_ns"])) if r["over"] else "", r["over"],
                str(stored) if stored and (r["each"] == "1" or not least) else ""]

    return facts + "\n\n" + table(list(rows.values()), ["what", "words", "ns", "more than without", "without is",
                                                        "B in restart files"], cells)


def plot(cpu, cuda):
    """What each effect adds on the CPU, the largest first; what it adds on the GPU is noise but for those that are named."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = sorted((name for name, row in cpu.items() if row["over"]), key=lambda name: float(cpu[name]["over_ns"]))
    values = [float(cpu[name]["over_ns"]) for name in names]
    figure, axis = plt.subplots(figsize=(8, 9))
    axis.barh(range(len(names)), values, color="#0072B2")
    axis.axvspan(-NOISE, NOISE, color="0.85", zorder=0)
    axis.axvline(0, color="black", linewidth=0.8)
    for at, value in enumerate(values):
        if value > NOISE:
            axis.text(value + 0.8, at, f"{value:.0f}", va="center", fontsize=13)
    axis.text(NOISE + 0.8, 0, "grey: noise", va="center", fontsize=13, color="0.35")
    axis.set_yticks(range(len(names)), names, fontsize=13)
    axis.tick_params(axis="x", labelsize=13)
    axis.set_xlabel("added for each contact and step, ns", fontsize=14)
    axis.set_title("On a CPU core", fontsize=14)
    axis.set_xlim(right=1.08 * max(values))    # room for the number of the longest bar
    axis.grid(True, axis="x", alpha=0.3)
    seen = [f"{name} {float(row['over_ns']):.0f} ns" for name, row in cuda.items()
            if row["over"] and float(row["over_ns"]) > NOISE]
    if cuda:
        axis.text(0.97, 0.06, "On the GPU: " + ("; ".join(seen) or "all are noise") + ";\nall others are within the noise",
                  transform=axis.transAxes, ha="right", fontsize=13)
    figure.tight_layout()
    part = PLOT + ".part.png"
    figure.savefig(part, dpi=90)
    os.replace(part, PLOT)


def write_document():
    cpu, cuda = rows_of("cpu"), rows_of("cuda")
    with open(DOCUMENT) as f:
        text = f.read()
    for begin, end, made in ((BEGIN, END, tables(cpu, cuda)), (*OF_BODIES, table_of_bodies(rows_of("bodies_cpu")))):
        text = re.sub(f"{begin}.*{end}", lambda _: f"{begin}\n{made}\n{end}", text, flags=re.S)
    write_whole(DOCUMENT, text)
    plot(cpu, cuda)
    print("wrote", os.path.relpath(DOCUMENT, ROOT), "and", os.path.relpath(PLOT, ROOT))


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", metavar="DIR")
    parser.add_argument("--write-only", action="store_true")
    parser.add_argument("--only", choices=[*DEVICES, "bodies"])
    args = parser.parse_args(arguments)
    if not args.write_only:
        for device in DEVICES:
            if args.only not in (None, device) or (device == "cuda" and not has_gpu()):
                continue
            if not measure(args.build, device):
                return 1
        if args.only in (None, "bodies") and not measure_bodies(args.build):
            return 1
    write_document()
    return 0


if __name__ == "__main__":
    sys.exit(main())
