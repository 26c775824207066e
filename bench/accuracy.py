#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Repeats the paper's study and writes doc/paper.md.

usage: accuracy.py [--build DIR] [--spheres N] [--rows-only | --write-only] [--commit NAME]

Runs `lsdcd accuracy` on the CPU and, where there is a GPU, with CUDA. Rows go to
DIR/bench/accuracy_DEVICE.csv and are kept in doc/data, so that the documents have those of
a device on a machine without it too. Certificates are from doc/data/certificates.csv, rows of
test_oracle_query (LSDCD_QUERY_CSV).
"""
import argparse
import csv
import os
import subprocess
import sys

from hard_cases import ROOT, commit, put_between, write_whole

DOCUMENT = os.path.join(ROOT, "doc", "paper.md")
QUESTION = os.path.join(ROOT, "doc", "img", "paper_question.png")
DATA = os.path.join(ROOT, "doc", "data")
CERTIFICATES = os.path.join(DATA, "certificates.csv")
BEGIN, END = "<!-- paper:begin -->", "<!-- paper:end -->"
DEVICES = ("cpu", "cuda")


def kept(device):
    return os.path.join(DATA, f"accuracy_{device}.csv")


def read_rows(path):
    if not os.path.exists(path):
        return []
    with open(path, newline="") as f:
        return list(csv.DictReader(f))


# What is run on each device: tables, share of the spheres, further words. The tables that
# the CPU makes with fewer try many meshes, and are the same on both.
RUNS = {
    "cpu": [(["table2", "figure9", "figure10"], 1, ["--repeats", "3"]),
            (["tessellation", "one-triangle", "formula5", "mesh"], 0.1, ["--repeats", "1"])],
    "cuda": [(["all"], 1, ["--most-spheres", "6e7", "--most-triangles", "1e6"]),
             (["table2", "figure9"], 1, ["--order", "sorted", "--most-spheres", "6e7"])],
}


def run(build, device, spheres, built):
    """Makes the rows of one device in the build folder and keeps them in doc/data."""
    path = os.path.join(build, "bench", f"accuracy_{device}.csv")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    env = dict(os.environ)
    env.setdefault("OMP_NUM_THREADS", str(os.cpu_count() or 1))
    lines = []
    for tables, share, words in RUNS[device]:
        command = [os.path.join(build, "bin", "lsdcd"), "accuracy", *tables, "--device", device,
                   "--spheres", f"{spheres * share:g}", "--commit", built, "--csv", path, *words]
        print(" ".join(command), flush=True)
        if subprocess.run(command, env=env).returncode != 0:
            return False
        with open(path) as f:
            rows = f.readlines()
        lines += rows if not lines else rows[1:]
    write_whole(path, "".join(lines))
    write_whole(kept(device), "".join(lines))
    return True


# ---- tables ------------------------------------------------------------------------------

def markdown(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(r) + " |" for r in rows])


def of_table(rows, table, order="random"):
    return [r for r in rows if r["table"] == table and r["order"] == order]


def short(text, digits=4):
    return f"{float(text):.{digits}g}" if text else ""


def count(text):
    n = float(text)
    exponent = len(str(int(n))) - 1
    return f"{n / 10 ** exponent:g}e{exponent}" if n >= 1000 else f"{n:g}"


def difference(row):
    return f"{float(row['accuracy']) - float(row['paper_accuracy']):+.1e}"


def matching(rows, row, keys=("length", "lists", "spheres")):
    """The row of another run with the same set-up, or None."""
    for other in rows:
        if all(other[k] == row[k] for k in keys):
            return other
    return None


def ms(row):
    return short(row["query_ms"]) if row else ""


def device_name(row):
    return row["device"].replace("CUDA, ", "")


TEXT = """{begin}
LSDCD began with a paper: Yong et al., *Parallel GPU-based collision detection of irregular vessel wall for massive particles*
(2017). It lays a grid over the wall, and lists in each cell only the N triangles that are nearest to the centre of the cell. How large must N
be? This page repeats the paper's study, and adds finer meshes. LSDCD itself lists everything that a sphere can touch, so that you need
this page only if you use `nearest N`, or read the paper.

**Result: on the paper's cylinder two triangles are enough. On finer meshes they are not.**

![Missed contacts and error against the time of a query](img/paper_question.png)

The number beside each point is N, the number of triangles listed in a cell; *all* is the default. Left: the cylinder of the paper, on
which LSDCD makes no error with N = 2, N = 3 and *all*. Right: finer cylinders. Points below the break of the axis have no error. The
time is that of a query, which asks for 10 000 000 spheres whether they touch the wall. With 1 000 000 triangles N = 1
is {faster} times as fast as *all*, and misses {missed_finer} % of the contacts. The black line is the step of a simulation. It is faster than
every query, because it does not search the cells: each sphere near the wall keeps a list of its own. The GPU is an H200; queries are of commit
{query_commit}, the step of {step_commit}. The paper's points are from its Table 2, a Tesla K40.

## The paper's cylinder

The cylinder has radius 50 and height 100, and is cut into {triangles} triangles. {spheres} spheres lie uniformly in a cube around it, with
radii uniform in (0, 1]. L is the length of a cell. *Accuracy* is the share of spheres whose status, touching or not, is that of the true cylinder
(the paper's formula 6). *Error* is the loss against exact distances to all triangles (formula 7). Accuracy stays below 1 even with
exact distances, because a cylinder of flat triangles is not round. At L = 0.2, of {touching} contacts:

{short}

The times are those of a query alone, the median of {repeats} ({cpu_repeats} on the CPU), with spheres in random order, in double precision and
without copies. The paper does not say whether its times include copies.

{runs}

## Finer cylinders

With L = 0.4, the same N misses more contacts on a finer mesh, and complete lists take longer. The table has missed contacts in per cent, and ms
on the GPU:

{finer}

## What else came out

- **Which cylinder.** The paper does not say how many triangles its cylinder has. With 39 segments, in the cube that just holds it, our accuracy
  with all triangles differs from the paper's best by {best}; the sampling error is {sampling:.0e}. No other choice agrees for N = 2 and 3 as well.
- **N = 1.** The paper's accuracies for N = 1 are 0.9630 at L = 0.2 and 0.3. A program that never finds a contact scores the same,
  {never}. The method itself reaches {one}. We tried {faults} possible faults, and none gives all four of the paper's numbers.
- **N = 2.** With N = 2 the paper loses 7.5e-5 to 2.1e-4 of all spheres. This does not come from the method, which misses {missed}
  of {touching} contacts.
- **Number of spheres.** It does not change the accuracy. From 1e6 spheres on, the time grows with their number: 6e7 spheres take {nine} ms
  here and {nine_paper} ms in the paper.
- **Length of a cell.** From L = 0.18 to 1 our accuracy falls by {by_length:.0e}; the paper's falls by 1e-4 up to 0.5. At L = 0.5 our grid takes
  {build} s on the GPU and {build_cpu} s on the CPU. The paper's takes 9 s, because it tries every triangle for every cell.
- **Inside a triangle.** The paper's test, its formula (5), is wrong in triangles with an obtuse angle. On a cylinder of such triangles it
  misses {leaked} % of the contacts. Our test is exact.
- **Certificates.** `nearest N` says for each result whether it is certainly exact. No result that was called certain was wrong when compared
  with another program, on five meshes with {oracle} spheres each (`tests/unit/test_oracle_query.cpp`; {oracle_device}, commit {oracle_commit}).

`./run bench accuracy` writes this from `doc/data/accuracy_*.csv` and `doc/data/certificates.csv`; do not edit between the markers.
{end}"""


def runs_of(rows_of):
    lines = []
    for device in DEVICES:
        rows = rows_of[device]
        if rows:
            r = rows[0]
            commits = ", ".join(dict.fromkeys(x["commit"] for x in rows))
            lines.append(f"- {device.upper()}: {device_name(r)}, commit {commits}, {r['repeats']} repeats.")
        else:
            lines.append(f"- {device.upper()}: not run yet.")
    return "\n".join(lines)


def short_table(cpu, cuda):
    """Table 2 at L = 0.2."""
    on_cpu, on_cuda = ([r for r in of_table(rows, "table2") if r["length"] == "0.2"] for rows in (cpu, cuda))
    cells = []
    for r in on_cuda or on_cpu:
        name = r["lists"].replace("complete", "all, the default").replace("every triangle", "every triangle tried")
        paper = r["lists"] != "complete"
        cells.append([name, f"{float(r['accuracy']):.6f}", r["paper_accuracy"] * paper, f"{abs(float(r['error_percent'])):.4f}",
                      f"{float(r['paper_error_percent']):.4f}" * paper, r["missed"], ms(matching(on_cuda, r)),
                      ms(matching(on_cpu, r)), short(r["paper_query_ms"], 6) * paper])
    return markdown(["N", "accuracy", "in the paper", "error, %", "in the paper", "missed contacts", "ms, GPU", "ms, CPU",
                     "ms, in the paper"], cells)


def finer_table(rows):
    """Missed contacts and time by N, a column for each mesh."""
    rows = of_table(rows, "mesh")
    meshes = sorted({r["triangles"] for r in rows}, key=int)[1:]
    cells = []
    for lists in dict.fromkeys(r["lists"] for r in rows):
        found = [next(r for r in rows if r["triangles"] == m and r["lists"] == lists) for m in meshes]
        cells.append([lists.replace("complete", "all")] + [
            cell for r in found for cell in (short(str(100 * int(r["missed"]) / int(r["touching"])), 2), ms(r))])
    return markdown(["N"] + [cell for m in meshes for cell in (f"{int(m):,}".replace(",", " ") + " triangles, %", "ms")], cells)


def write_document(rows_of):
    cpu, cuda = rows_of["cpu"], rows_of["cuda"]
    rows = cuda or cpu
    main = of_table(rows, "table2")
    two, one = (next(r for r in main if r["lists"] == n and r["length"] == "0.2") for n in ("2", "1"))
    accuracy = float(main[0]["best"])
    tried = of_table(rows, "tessellation")[0]["spheres"]
    best = next(r for r in of_table(rows, "tessellation") if r["note"].startswith("39 ") and r["cube"] == "100")
    nine, ten = of_table(rows, "figure9")[-1], of_table(rows, "figure10")
    half = {name: next(r for r in of_table(of, "figure10") if r["length"] == "0.5") for name, of in (("cpu", cpu), ("gpu", rows))}
    leak = max(of_table(rows, "formula5"), key=lambda r: float(r["missed"]) / float(r["touching"]))
    oracle = read_rows(CERTIFICATES)
    wrong = sum(int(r["certified_" + k]) for r in oracle for k in ("missed", "false", "wrong"))
    if wrong:
        raise SystemExit(f"{CERTIFICATES}: {wrong} certified answers are wrong, the text says none")
    finest = [r for r in of_table(cuda, "mesh") if r["triangles"] == "1000000"]
    single, every = (next(r for r in finest if r["lists"] == n) for n in ("1", "complete"))
    put_between(DOCUMENT, BEGIN, END, TEXT.format(
        begin=BEGIN, end=END, triangles=two["triangles"], spheres=count(two["spheres"]), runs=runs_of(rows_of),
        sampling=(accuracy * (1 - accuracy) * (1 / float(tried) + 1e-7)) ** 0.5,
        never=f"{float(main[0]['never']):.6f}", missed=two["missed"], touching=two["touching"],
        faster=f"{float(every['query_ms']) / float(single['query_ms']):.1f}", query_commit=single["commit"],
        missed_finer=f"{100 * float(single['missed']) / float(single['touching']):.1f}", step_commit=step_row()["commit"],
        short=short_table(cpu, cuda), finer=finer_table(rows), repeats=main[0]["repeats"], cpu_repeats=cpu[0]["repeats"],
        best=difference(best), one=f"{float(one['accuracy']):.6f}",
        faults=len({r["note"] for r in of_table(rows, "one-triangle")}) - 1, nine=ms(nine), nine_paper=short(nine["paper_query_ms"], 4),
        by_length=float(ten[0]["accuracy"]) - float(ten[-1]["accuracy"]), build=short(half["gpu"]["build_s"], 2),
        build_cpu=short(half["cpu"]["build_s"], 2), leaked=f"{100 * float(leak['missed']) / float(leak['touching']):.0f}",
        oracle=count(oracle[0]["spheres"]) if oracle else "?", oracle_device=oracle[0]["device"] if oracle else "?",
        oracle_commit=oracle[0]["commit"] if oracle else "?"))


# ---- plot --------------------------------------------------------------------------------

def draw_question(rows, steps):
    """Errors against the time of a query: those of the paper and ours, and what shorter lists miss. Below the break of an
    axis are the measurements without any error."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 2, figsize=(12, 6.4), sharex="col", height_ratios=(5, 1), gridspec_kw={"hspace": 0.06})
    blue, red, green, black = "#0072B2", "#D55E00", "#009E73", "black"

    def point(column, x, y, look, words="", away=(8, 6), **more):
        at = axes[0 if y > 0 else 1][column]
        at.plot(x, y if y > 0 else 0, look, markersize=9, **more)
        if words:
            at.annotate(words, (x, y if y > 0 else 0), away, textcoords="offset points", fontsize=14, color=more["color"])

    for r in of_table(rows, "table2"):
        if r["length"] != "0.2":
            continue
        every = r["lists"] == "every triangle"
        words = {"every triangle": "every triangle", "complete": "all", "1": "N = 1"}.get(r["lists"], r["lists"])
        if r["lists"] != "complete":
            point(0, float(r["paper_query_ms"]), float(r["paper_error_percent"]), "s", words, (-106, 8) if every else (8, 6),
                  color=black, fillstyle="none")
        if r["lists"] in ("1", "complete"):
            point(0, float(r["query_ms"]), max(0.0, float(r["error_percent"])), "o", words, color=blue)
    axes[0][0].text(5e2, 12, "the paper, on a K40", fontsize=14, ha="center")
    axes[0][0].text(0.17, 8e-4, "LSDCD, on an H200", fontsize=14, color=blue)
    for triangles, look, colour in (("10000", "o", blue), ("100000", "s", red), ("1000000", "^", green)):
        its = [(r["lists"], float(r["query_ms"]), 100 * float(r["missed"]) / float(r["touching"]))
               for r in of_table(rows, "mesh") if r["triangles"] == triangles]
        above = [(x, y) for _, x, y in its if y > 0]
        axes[0][1].plot(*zip(*above), color=colour, linewidth=1)
        axes[0][1].plot([], [], look + "-", color=colour, label=f"{int(triangles):,} triangles".replace(",", " "))
        for lists, x, y in its:
            point(1, x, y, look, "all" if lists == "complete" else "" if y <= 0 else "N = 1" if lists == "1" and triangles == "10000"
                  else lists, (-9, 9) if y <= 0 else (8, 2), color=colour)
    for column, least, title, error in ((0, 3e-5, "The paper's cylinder of 156 triangles, cells of 0.2", "error, % (formula 7)"),
                                        (1, 1e-4, "Finer cylinders, cells of 0.4, on an H200", "missed contacts, %")):
        high, low = axes[0][column], axes[1][column]
        high.set(xscale="log", yscale="log", ylim=(least, 50))
        high.set_title(title, fontsize=14)
        high.set_ylabel(error, fontsize=14)
        low.set(ylim=(-0.5, 1.2), xscale="log")
        low.set_yticks([0], ["0"])
        low.set_xlabel("time for 10 000 000 spheres, ms", fontsize=14)
        high.spines.bottom.set_visible(False)
        low.spines.top.set_visible(False)
        high.tick_params(bottom=False, which="both")
        broken = dict(marker=[(-1, -0.6), (1, 0.6)], markersize=11, linestyle="none", color="k", mec="k", clip_on=False)
        high.plot([0, 1], [0, 0], transform=high.transAxes, **broken)
        low.plot([0, 1], [1, 1], transform=low.transAxes, **broken)
        for a in (high, low):
            a.grid(True, alpha=0.3)
            a.tick_params(labelsize=13)
    axes[0][0].set_xlim(0.1, 2e5)
    axes[0][1].set_xlim(0.1, 2.6)
    axes[0][1].legend(loc="upper right", fontsize=14)
    axes[1][1].set_xticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"])
    axes[1][1].minorticks_off()
    own = float(steps["median_ms"])
    for a in (axes[0][1], axes[1][1]):
        a.axvline(own, color=black, linewidth=1)
    axes[0][1].annotate("a step of the wall,\n10 000 triangles", (own, 2e-4), (-4, 0), textcoords="offset points", fontsize=13, ha="right",
                        rotation=90, va="bottom")
    figure.subplots_adjust(left=0.08, right=0.99, top=0.94, bottom=0.1, wspace=0.2)
    figure.savefig(QUESTION + ".part", dpi=90, format="png")
    os.replace(QUESTION + ".part", QUESTION)


def step_row():
    """A step that reads lists of the wall, on the same spheres, nothing copied."""
    rows = read_rows(os.path.join(DATA, "performance_cuda.csv"))
    return next(r for r in rows if r["case"] == "hertz/history, in place" and r["triangles"] == "10000" and
                r["spheres"] == "10000000" and r["order"] == "random")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="DIR",
                        help="where bin/ is")
    parser.add_argument("--spheres", default=1e7, type=float, metavar="N", help="per measurement (1e7)")
    parser.add_argument("--rows-only", action="store_true",
                        help="only run CUDA and keep its rows (on a machine lent for that)")
    parser.add_argument("--commit", default=commit(), metavar="NAME",
                        help="what was built, where git does not know")
    parser.add_argument("--write-only", action="store_true",
                        help="run nothing; write from the rows in doc/data")
    args = parser.parse_args(arguments)
    if args.rows_only:
        return 0 if run(args.build, "cuda", args.spheres, args.commit) else 1
    if not args.write_only:
        for device in DEVICES:
            if (device == "cpu" or gpu_is_there()) and not run(args.build, device, args.spheres, args.commit):
                return 1
    rows_of = {device: read_rows(kept(device)) for device in DEVICES}
    if not any(rows_of.values()):
        print("no rows in doc/data; run without --write-only", file=sys.stderr)
        return 1
    if rows_of["cuda"]:
        draw_question(rows_of["cuda"], step_row())
    write_document(rows_of)
    print(DOCUMENT)
    return 0


def gpu_is_there():
    try:
        return subprocess.run(["nvidia-smi", "-L"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


if __name__ == "__main__":
    sys.exit(main())
