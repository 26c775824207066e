# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd tradeoff writes its rows whole or not at all, with or without matplotlib."""

import csv
import os
import pathlib
import re
import resource
import shutil
import subprocess

from facts import fact

TOOL = os.environ["LSDCD_TOOL"]
FLOOR = pathlib.Path(__file__).resolve().parent.parent / "lammps" / "scripts" / "floor.stl"
FAST = ["--spheres", "300", "--moving", "2", "--repeats", "1", "--device", "cpu"]


def run(folder, *words, tool=TOOL):
    return subprocess.run([tool, "tradeoff", *words], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)


def rows(path):
    with open(path, newline="") as f:
        return list(csv.DictReader(f))


def test_tradeoff(folder):
    done = run(folder, str(FLOOR), "--radius", "0.4", "0.5", *FAST, "--plot", "none", "--below", "1e-12")
    fact("the rows are written", done.returncode == 0 and (folder / "tradeoff.csv").exists(),
         done.stdout[-300:])
    table = rows(folder / "tradeoff.csv")
    fact("every setting has a row", len(table) % 12 == 0 and len(table) >= 12, str(len(table)))
    fact("one is the default", [r["default"] for r in table].count("1") == 1)
    fact("some are on the front", any(r["front"] == "1" for r in table))
    fact("rows say what they are of", all(r["commit"] and r["device"] and r["order"] == "sorted" and
                                          r["triangles"] == "2" for r in table))
    fact("each time has the smallest and the largest of its runs", all(
        0 < float(r[f"{name}_ns"]) <= float(r[f"{name}_most_ns"]) for r in table for name in ("search", "step")), str(table[0]))
    fact("complete lists are kept by sphere, those of the nearest triangles are not",
         all((float(r["listed"]) > 0) == (r["nearest"] == "all") for r in table))
    fact("no plot was asked for and none is there", not list(folder.glob("*.png")))
    words = re.search(r"^below 1e-12 on the CPU: grid (\S+) nearest all$", done.stdout, re.M)
    fact("the words for a bound that rounding alone keeps are of a row with complete lists", words and
         any(r["grid"] == words[1] and float(r["force_largest"]) < 1e-12 for r in table), done.stdout[-300:])
    fact("nothing else is left", sorted(p.name for p in folder.iterdir()) == ["tradeoff.csv"])

    # The same errors from the same seed, others from another, as far as twenty seconds go.
    run(folder, str(FLOOR), "--radius", "0.4", "0.5", *FAST, "--plot", "none", "--seconds", "20", "--csv", "again.csv")
    run(folder, str(FLOOR), "--radius", "0.4", "0.5", *FAST, "--plot", "none", "--seconds", "20", "--csv", "other.csv",
        "--seed", "7")
    errors = [[r["force_largest"] for r in rows(folder / f)]
              for f in ("tradeoff.csv", "again.csv", "other.csv")]
    n = min(map(len, errors))
    fact("one seed gives one set of errors", n > 4 and errors[0][:n] == errors[1][:n] != errors[2][:n], str(n))

    try:
        import matplotlib    # noqa: F401
        has_matplotlib = True
    except ImportError:
        has_matplotlib = False
    if has_matplotlib:
        done = run(folder, str(FLOOR), "--radius", "0.5", *FAST, "--seconds", "1", "--csv", "drawn.csv")
        png = folder / "drawn.png"
        fact("the plot is drawn", done.returncode == 0 and png.exists() and
             png.read_bytes()[:4] == b"\x89PNG", done.stdout[-300:])

    # A copy of the tool without its script: as if nothing could draw.
    alone = shutil.copy(TOOL, folder / "alone")
    done = run(folder, str(FLOOR), "--radius", "0.5", *FAST, "--seconds", "1", "--csv", "alone.csv", tool=alone)
    fact("without a plot the rows are there", len(rows(folder / "alone.csv")) > 0)
    fact("and how to draw it is told", done.returncode == 1 and "python3-matplotlib" in done.stdout and
         "alone.csv" in done.stdout, done.stdout[-300:])

    done = run(folder, str(FLOOR), "--radius", "0.5", *FAST, "--plot", "none", "--memory", "0.001", "--below", "0.1")
    fact("where nothing keeps the bound it fails and says so", done.returncode == 1 and
         "no setting that was measured keeps errors below 0.1 on the CPU" in done.stdout, done.stdout[-300:])

    # Grains small beside the mesh: cells of the default length would take 10 GB. With 64 MB for a grid the program
    # takes 120 MB, and 1.8 GB where builds do not keep that. The default alone is measured, in 3 s.
    tall = str(folder / "tall.stl")
    subprocess.run([TOOL, *"generate cylinder --radius 0.5 --height 2 -o".split(), tall], stdout=subprocess.PIPE, check=True)
    done = run(folder, tall, "--radius", "1e-4", *FAST, "--plot", "none", "--memory", "64", "--seconds", "0.1", "--csv", "tall.csv")
    most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    fact("small grains keep the memory", most < 300000, f"{most} kB")
    fact("the default is measured as coarse as the memory asks for", done.returncode == 0 and
         [r["default"] for r in rows(folder / "tall.csv")].count("1") == 1 and
         all(int(r["bytes"]) <= 64 << 20 for r in rows(folder / "tall.csv")), done.stdout[-300:])
    fact("and what was left out is told", "left out: " in done.stdout and "finer than" in done.stdout
         or "for which there was no time" in done.stdout, done.stdout[-300:])

    help_text = run(folder, "--help").stdout
    fact("help explains the columns", all(w in help_text for w in ("bounce_drift", "front", "force_mean")))
