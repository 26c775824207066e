#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Repeats the paper's study and writes doc/paper.md and a part of doc/notes/accuracy.md.

usage: accuracy.py [--build DIR] [--spheres N] [--rows-only | --write-only] [--commit NAME]

Runs `lsdcd accuracy` on the CPU and, where there is a GPU, with CUDA. Rows go to
DIR/bench/accuracy_DEVICE.csv and are kept in doc/data, so that the documents have those of
a device on a machine without it too. The table of certificates is from
doc/data/certificates.csv, rows of test_oracle_query (LSDCD_QUERY_CSV).
"""
import argparse
import csv
import os
import subprocess
import sys

from hard_cases import ROOT, commit, put_between, write_whole

DOCUMENT = os.path.join(ROOT, "doc", "paper.md")
PLOT = os.path.join(ROOT, "doc", "img", "accuracy_paper.png")
QUESTION = os.path.join(ROOT, "doc", "img", "paper_question.png")
DATA = os.path.join(ROOT, "doc", "data")
TABLES = os.path.join(ROOT, "doc", "notes", "accuracy.md")
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


def table_two(cpu, cuda):
    base = of_table(cuda, "table2") or of_table(cpu, "table2")
    on_cpu, on_cuda = of_table(cpu, "table2"), of_table(cuda, "table2")
    sorted_ = of_table(cuda, "table2", "sorted")
    cells = []
    for r in base:
        cells.append([r["lists"].replace("complete", "all: complete lists")
                      .replace("every triangle", "all: every triangle tried"),
                      r["length"], f"{float(r['accuracy']):.6f}", r["paper_accuracy"],
                      difference(r), f"{float(r['error_percent']):.4f}",
                      f"{float(r['paper_error_percent']):.4f}", r["missed"], r["false"],
                      f"{float(r['certified']):.6f}", ms(matching(on_cuda, r)),
                      ms(matching(sorted_, r)), ms(matching(on_cpu, r)),
                      "" if r["lists"] == "complete" else short(r["paper_query_ms"], 6)])
    return markdown(["N", "L", "accuracy", "paper", "ours - paper", "error %", "paper", "missed",
                     "false", "certified", "ms, GPU", "ms, GPU, sorted", "ms, CPU",
                     "ms, paper (K40)"], cells)


def tessellation(rows):
    rows = of_table(rows, "tessellation")
    cubes = sorted({r["cube"] for r in rows}, key=float)
    cells = {}
    for r in rows:
        segments = r["note"].split()[0]
        cells.setdefault(int(segments), {})[r["cube"]] = difference(r)
    never = {r["cube"]: r["never"] for r in rows}
    body = [[str(s)] + [cells[s].get(c, "") for c in cubes] for s in sorted(cells)]
    body.append(["no contact ever, accuracy"] + [f"{float(never[c]):.6f}" for c in cubes])
    return markdown(["segments"] + [f"cube {c}" for c in cubes], body)


def one_triangle(rows):
    rows = of_table(rows, "one-triangle")
    lengths = sorted({r["length"] for r in rows}, key=float)
    by_guess, paper = {}, {}
    for r in rows:
        by_guess.setdefault(r["note"], {})[r["length"]] = f"{float(r['accuracy']):.6f}"
        paper[r["length"]] = r["paper_accuracy"]
    body = [["**the paper**"] + [paper[x] for x in lengths]]
    body += [[guess] + [cells.get(x, "") for x in lengths] for guess, cells in by_guess.items()]
    return markdown(["what the run did"] + [f"L = {x}" for x in lengths], body)


def figure_nine(cpu, cuda):
    runs = [("GPU", of_table(cuda, "figure9")), ("GPU, sorted", of_table(cuda, "figure9", "sorted")),
            ("CPU", of_table(cpu, "figure9"))]
    longest = max((r for _, r in runs), key=len)
    cells = []
    for r in longest:
        cells.append([count(r["spheres"]), f"{float(r['accuracy']):.6f}", r["paper_accuracy"][:5]] +
                     [ms(matching(rows, r)) for _, rows in runs] + [short(r["paper_query_ms"], 6)])
    return markdown(["spheres", "accuracy", "paper"] + [f"ms, {name}" for name, _ in runs] +
                    ["ms, paper (K40)"], cells)


def figure_ten(cpu, cuda):
    on_cpu, on_cuda = of_table(cpu, "figure10"), of_table(cuda, "figure10")
    cells = []
    for r in on_cuda or on_cpu:
        c, g = matching(on_cpu, r), matching(on_cuda, r)
        cells.append([r["length"], f"{float(r['accuracy']):.6f}", r["paper_accuracy"],
                      f"{float(r['error_percent']):.4f}",
                      f"{float(r['paper_error_percent']):.4f}" if r["paper_error_percent"] else "",
                      short(g["build_s"], 3) if g else "", short(c["build_s"], 3) if c else "",
                      short(r["paper_build_s"]), ms(g), ms(c),
                      f"{float(r['grid_bytes']) / 1e6:.0f}"])
    return markdown(["L", "accuracy", "paper", "error %", "paper", "grid s, GPU", "grid s, CPU",
                     "grid s, paper", "query ms, GPU", "query ms, CPU", "grid MB"], cells)


def mesh(cpu, cuda):
    rows = max((of_table(cuda, "mesh"), of_table(cpu, "mesh")), key=len)
    cells = []
    for r in rows:
        share = int(r["missed"]) / int(r["touching"])
        keys = ("triangles", "lists", "spheres")
        cells.append([r["triangles"], r["lists"], r["touching"], r["missed"], short(str(share), 2),
                      r["false"], short(r["largest_overlap_error"], 2),
                      short(r["median_force_error"], 2), short(r["mean_force_error"], 2),
                      f"{float(r['certified']):.5f}", short(r["entries"], 3),
                      f"{float(r['grid_bytes']) / 1e6:.0f}",
                      ms(matching(of_table(cuda, "mesh"), r, keys)),
                      ms(matching(of_table(cpu, "mesh"), r, keys))])
    return markdown(["triangles", "N", "touching", "missed", "share", "false", "largest error",
                     "median", "mean", "certified", "entries read", "grid MB", "ms, GPU", "ms, CPU"],
                    cells)


def formula_five(rows):
    cells = []
    for r in of_table(rows, "formula5"):
        cells.append([r["shape"], r["triangles"], r["inside"],
                      r["lists"].replace("every triangle", "all"), f"{float(r['accuracy']):.6f}",
                      r["touching"], r["missed"], r["false"], short(r["largest_overlap_error"], 2),
                      short(r["median_force_error"], 2), short(r["mean_force_error"], 2)])
    return markdown(["mesh", "triangles", "inside test", "N", "accuracy", "touching", "leaked",
                     "false", "largest error", "median", "mean"], cells)


def certificates(rows):
    cells = []
    for r in rows:
        if r["lists"] not in ("complete", "1", "2", "4", "8"):
            continue
        cells.append([r["mesh"], r["triangles"], r["lists"], short(r["length"]), count(r["spheres"]),
                      r["near"], f"{float(r['certified']):.7f}", f"{float(r['certified_of_near']):.6f}",
                      r["missed"], r["false"], r["wrong"],
                      str(sum(int(r["certified_" + k]) for k in ("missed", "false", "wrong")))])
    return markdown(["mesh", "triangles", "lists", "L", "spheres", "near", "certified",
                     "of the near", "missed", "false", "wrong distance", "certified and wrong"],
                    cells)


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

Each point has its [table](notes/accuracy.md).

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

LONG = """{begin}
## The paper's study

Definitions are in [the paper's study](../paper.md). *Missed* and *false* count against the triangles themselves, the
wall that a simulation sees; *certified* is the share of answers that the list vouches for. {triangles} triangles, {spheres}
spheres, cube {cube}, seed {seed}, unless a table says otherwise.

{runs}

Times are of the query alone (median of the repeats), status only, everything on the device, geometry in double; copies are in the CSV.
CPU times are of a machine that also did other work: upper bounds. Spheres are in random order, or sorted along a Z-curve where a
column says so. Times of the paper are of a Tesla K40; it does not say whether its copies are in them. Its *all* tries every triangle,
and its time stands beside ours that does so.

![Accuracy and time of the paper's set-up](../img/accuracy_paper.png)

### Table 2: triangles per cell

{table2}

### Which cylinder the paper had

It does not say how many triangles its cylinder has, nor how far the cube that "just wraps" wall and particles reaches. Accuracy with
exact distances to all triangles, less the paper's best of 0.994025:

{tessellation}

{tried} spheres each: draws of so many and the paper's differ by {sampling:.0e} (one sigma). 39 segments in the cube of side 100
(exactly the cylinder's box) and 40 segments in the cubes that also hold the spheres' radii give the paper's best to within that. Only
the first holds for N = 2 and 3 too (within 2e-4 at every L, table 2), and its *never* is the paper's row N = 1. It is the one used here.

### One triangle per cell

The paper's values at L = 0.2 and 0.3 are, within the sampling error of 6e-5, what *no contact ever found* scores in the cube of side
100: {never} with {spheres} spheres. Those at L = 0.4 and 0.5 lie below that, so that in these runs false contacts outnumber true ones.
Guesses that were tried on {tried} spheres, none of which gives all four:

{one_triangle}

This suggests that those runs hardly found contacts; why cannot be told from the numbers.

### Figure 9: number of spheres (N = 2, L = 0.2)

{figure9}

### Figures 10 to 12: cell length, and two devices (N = 2)

{figure10}

The paper makes its grid by trying every triangle for every cell, ours does not: those seconds compare methods, not devices. The paper
prints a smaller error for L = 0.179 (0.0015 %) than its own accuracy there gives by formula (7) (0.018 %).

### Finer cylinders

Cells of 0.4, exact inside test; a list cut off can only lose contacts. Errors are of the overlap, thus of a Hooke force on the nearest
point of the wall: the largest over the largest radius, median and mean over the overlap itself, of the spheres that touch (a missed
contact counts as 1). *Entries read* is the mean over spheres that read any.

{mesh}

### What the paper's inside test costs

Formula (5) takes points over a triangle's sides for inside, and in triangles with an obtuse angle points inside for outside. Leaked:
spheres that touch and are not seen. Errors as above.

{formula5}

On right and acute triangles that share their planes, as those of the cylinder, it happens to do no harm; any mesh with obtuse
triangles leaks. It is not offered outside this study.
{certificates}{end}"""

CERTIFIED = """
### Certificates against an oracle that shares no code

Uniform spheres in the box of five meshes, radii uniform in (0, 1], against coarse bins and another distance in double
(`tests/unit/test_oracle_query.cpp`). An answer is wrong from 1e-12 of the mesh's diagonal. {device}, commit {commit}; random
order, one run. **No certified answer was wrong.** N = 3, 5, 6 and 7 are in `doc/data/certificates.csv`.

{table}

"""


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


def write_documents(rows_of):
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
    certified = ""
    if oracle:
        certified = CERTIFIED.format(device=oracle[0]["device"], commit=oracle[0]["commit"],
                                     table=certificates(oracle))
    wrong = sum(int(r["certified_" + k]) for r in oracle for k in ("missed", "false", "wrong"))
    if wrong:
        raise SystemExit(f"{CERTIFICATES}: {wrong} certified answers are wrong, the text says none")
    known = dict(
        begin=BEGIN, end=END, triangles=two["triangles"], spheres=count(two["spheres"]),
        cube=two["cube"], seed=two["seed"], runs=runs_of(rows_of),
        sampling=(accuracy * (1 - accuracy) * (1 / float(tried) + 1e-7)) ** 0.5,
        tried=count(tried), never=f"{float(main[0]['never']):.6f}", missed=two["missed"], touching=two["touching"])
    finest = [r for r in of_table(cuda, "mesh") if r["triangles"] == "1000000"]
    single, every = (next(r for r in finest if r["lists"] == n) for n in ("1", "complete"))
    put_between(DOCUMENT, BEGIN, END, TEXT.format(
        faster=f"{float(every['query_ms']) / float(single['query_ms']):.1f}", query_commit=single["commit"],
        missed_finer=f"{100 * float(single['missed']) / float(single['touching']):.1f}", step_commit=step_row()["commit"],
        short=short_table(cpu, cuda), finer=finer_table(rows), repeats=main[0]["repeats"], cpu_repeats=cpu[0]["repeats"],
        best=difference(best), one=f"{float(one['accuracy']):.6f}",
        faults=len({r["note"] for r in of_table(rows, "one-triangle")}) - 1, nine=ms(nine), nine_paper=short(nine["paper_query_ms"], 4),
        by_length=float(ten[0]["accuracy"]) - float(ten[-1]["accuracy"]), build=short(half["gpu"]["build_s"], 2),
        build_cpu=short(half["cpu"]["build_s"], 2), leaked=f"{100 * float(leak['missed']) / float(leak['touching']):.0f}",
        oracle=count(oracle[0]["spheres"]) if oracle else "?", oracle_device=oracle[0]["device"] if oracle else "?",
        oracle_commit=oracle[0]["commit"] if oracle else "?", **known))
    put_between(TABLES, BEGIN, END, LONG.format(
        table2=table_two(cpu, cuda), tessellation=tessellation(rows), one_triangle=one_triangle(rows),
        figure9=figure_nine(cpu, cuda), figure10=figure_ten(cpu, cuda), formula5=formula_five(rows), mesh=mesh(cpu, cuda),
        certificates=certified, **known))


# ---- plot --------------------------------------------------------------------------------

def numbers(rows, x, y):
    pairs = [(float(r[x]), float(r[y])) for r in rows if r[y]]
    return [p[0] for p in pairs], [p[1] for p in pairs]


def draw(rows_of):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.6))
    (time, by_count), (by_length, build) = axes
    paper_style = dict(color="black", marker="s", linestyle="none", fillstyle="none",
                       label="paper (Tesla K40)")
    styles = {"cpu": dict(color="#0072B2", marker="o"), "cuda": dict(color="#D55E00", marker="^")}
    ours = dict(color="#0072B2", marker="o", label="ours")
    for device in DEVICES:
        rows = rows_of[device]
        if not rows:
            continue
        name = device_name(rows[0])
        for order, line in (("random", "-"), ("sorted", "--")):
            nine = of_table(rows, "figure9", order)
            if nine:
                time.plot(*numbers(nine, "spheres", "query_ms"), linestyle=line, label=f"{name}, {order}", **styles[device])
        ten = of_table(rows, "figure10")
        build.plot(*numbers(ten, "length", "build_s"), label=name, **styles[device])
    rows = rows_of["cuda"] or rows_of["cpu"]
    nine, ten = of_table(rows, "figure9"), of_table(rows, "figure10")
    time.plot(*numbers(nine, "spheres", "paper_query_ms"), **paper_style)
    time.set(xscale="log", yscale="log", xlabel="number of spheres", ylabel="query time, ms",
             title="N = 2, L = 0.2 (figure 9)")
    by_count.plot(*numbers(nine, "spheres", "accuracy"), **ours)
    by_count.plot(*numbers(nine, "spheres", "paper_accuracy"), **paper_style)
    by_count.set(xscale="log", xlabel="number of spheres", ylabel="accuracy, equation (6)", ylim=(0.985, 1.0),
                 title="N = 2, L = 0.2 (figure 9)")
    by_length.plot(*numbers(ten, "length", "accuracy"), **ours)
    by_length.plot(*numbers(ten, "length", "paper_accuracy"), **paper_style)
    by_length.set(xlabel="cell length L (radii up to 1)", ylabel="accuracy, equation (6)", ylim=(0.9935, 0.9943),
                  title="N = 2 (figure 10)")
    by_length.ticklabel_format(useOffset=False)
    build.plot(*numbers(ten, "length", "paper_build_s"), **paper_style)
    build.set(yscale="log", xlabel="cell length L (radii up to 1)", ylabel="build time, s",
              title="Preprocessing, N = 2 (figures 10 and 11)")
    for a in axes.flat:
        a.grid(True, alpha=0.3)
        a.tick_params(labelsize=11)
        for item in (a.title, a.xaxis.label, a.yaxis.label):
            item.set_fontsize(13)
    time.set_ylim(top=3e5)    # room for the legend
    for a, at in ((time, "upper left"), (by_count, "upper right"), (by_length, "upper right"), (build, "upper right")):
        a.legend(fontsize=11, loc=at)
    figure.suptitle(f"The paper's cylinder: {nine[0]['triangles']} triangles, radii up to 1", fontsize=14)
    figure.tight_layout()
    os.makedirs(os.path.dirname(PLOT), exist_ok=True)
    figure.savefig(PLOT + ".part", dpi=110, format="png")
    os.replace(PLOT + ".part", PLOT)


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
    draw(rows_of)
    if rows_of["cuda"]:
        draw_question(rows_of["cuda"], step_row())
    write_documents(rows_of)
    print(DOCUMENT)
    print(TABLES)
    print(PLOT)
    return 0


def gpu_is_there():
    try:
        return subprocess.run(["nvidia-smi", "-L"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


if __name__ == "__main__":
    sys.exit(main())
