# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the benchmark programs, keeps their rows and writes the tables and plots of doc/performance.md and doc/library.md.

Programs print rows of one format (bench.h). They are kept in doc/data/performance_DEVICE.csv,
so that the document has those of a device on a machine without it too; a row replaces the one
of the same program, case, sizes and order, others stay.
"""
import csv
import io
import os
import subprocess

from effects import has_gpu, table
from hard_cases import ROOT, commit, put_between, write_whole
from performance_plots import plot_build, plot_query

DOCUMENT = os.path.join(ROOT, "doc", "performance.md")
ELSEWHERE = {"point-costs": os.path.join(ROOT, "doc", "library.md")}
DATA = os.path.join(ROOT, "doc", "data")
DEVICES = ("cpu", "cuda")
PROGRAMS = ("query", "build", "step", "cache")
KEY = ("program", "case", "triangles", "spheres", "length", "order")

# Yong et al. 2017, Table 2 and figure 9, a K40. Its N = all tries every triangle, as no query here does.


# ---- rows --------------------------------------------------------------------------------

def kept(device, folder=DATA):
    return os.path.join(folder, f"performance_{device}.csv")


def parse(text):
    return list(csv.DictReader(io.StringIO(text)))


def read_rows(device, folder=DATA):
    path = kept(device, folder)
    if not os.path.exists(path):
        return []
    with open(path, newline="") as f:
        return parse(f.read())


def key(row):
    return tuple(row[k] for k in KEY)


def replaced(old, new):
    """Rows of old, each in place of what new has under its key, then what only new has."""
    fresh = {key(r): r for r in new}
    rows = [fresh.pop(key(r), r) for r in old] + list(fresh.values())
    return sorted(rows, key=lambda r: PROGRAMS.index(r["program"]))    # stable


def as_csv(rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def facts(row):
    return dict(f.split("=", 1) for f in row["facts"].split()) if row else {}


def measure(build, device, programs, words, named, folder):
    """Runs programs on a device and keeps their rows in a folder. False where one failed."""
    env = dict(os.environ)
    env.setdefault("OMP_NUM_THREADS", str(os.cpu_count() or 1))
    for program in programs:
        if program == "cache" and device == "cuda":
            continue    # the same whatever device builds
        command = [os.path.join(build, "bin", "bench_" + program), "--device", device,
                   "--commit", named, *words]
        print(" ".join(command), flush=True)
        done = subprocess.run(command, env=env, stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            return False
        print(done.stdout, flush=True)
        rows = replaced(read_rows(device, folder), parse(done.stdout))
        write_whole(kept(device, folder), as_csv(rows))
    return True


# ---- cells of tables ---------------------------------------------------------------------

def number(text, digits=3):
    if text in ("", None):
        return ""
    value = float(text)
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 1000 else f"{value:.{digits}g}"


def count(text):
    return f"{int(text):,}".replace(",", " ")


def ms(row):
    """Median, and from least to most."""
    if not row:
        return ""
    if row["min_ms"] == row["max_ms"]:
        return number(row["median_ms"])
    return f"{number(row['median_ms'])} ({number(row['min_ms'])} to {number(row['max_ms'])})"


def find(rows, **wanted):
    """The first row with these values, or None; length is compared as a number."""
    for row in rows:
        if all(abs(float(row[k]) - v) < 1e-9 if k == "length" else row[k] == v
               for k, v in wanted.items()):
            return row
    return None


def of(rows, program, test=lambda case: True):
    return [r for r in rows if r["program"] == program and test(r["case"])]


# ---- tables ------------------------------------------------------------------------------

def near_and_far(cpu):
    return of(cpu, "query", lambda case: case.startswith(("near, ", "far, ", "any, ")))


def point_costs(cpu):
    """Distances of points in random order by the library, Embree and CGAL, in microseconds."""
    rows = [r for r in near_and_far(cpu) if r["order"] == "random"]
    columns = [(way, place) for way in ("library, double", "Embree") for place in ("near", "far", "any")] + [("CGAL", "any")]

    def us(triangles, way, place):
        row = next((r for r in rows if r["case"].startswith(f"{place}, {way}") and r["triangles"] == triangles), None)
        if not row:
            return ""
        cost = float(facts(row)["ns_per_point"]) / 1e3
        return number(cost, 3 if cost >= 100 else 2)

    heads = ["triangles", *[place if way.startswith("library") else f"{way}: {place}" for way, place in columns]]
    return table(dict.fromkeys(r["triangles"] for r in rows), heads, lambda t: [count(t), *[us(t, *c) for c in columns]])


def parts(cpu):
    """The generated parts of the document, with their markers."""
    return between_markers({"point-costs": point_costs(cpu)})


def between_markers(text):
    return {name: f"{begin(name)}\n{table_}\n{end(name)}" for name, table_ in text.items()}


def begin(name):
    return f"<!-- {name}:begin -->"


def end(name):
    return f"<!-- {name}:end -->"


def write_parts(found):
    for name, text in found.items():
        document = ELSEWHERE.get(name, DOCUMENT)
        put_between(document, begin(name), end(name), text)
        print("wrote", name, "in", os.path.relpath(document, ROOT))


def write_document():
    cpu, cuda = read_rows("cpu"), read_rows("cuda")
    write_parts(parts(cpu))
    plot_query(cpu, cuda)
    plot_build(cpu, cuda)


def main(args, programs, words):
    """`./run bench` of these programs; further words are theirs."""
    if args.write_only:
        write_document()
        return 0
    folder = args.rows_to or (os.path.join(args.build, "bench") if args.quick else DATA)
    os.makedirs(folder, exist_ok=True)
    named = args.commit or commit()
    for device in DEVICES:
        if args.only not in (None, device):
            continue
        if device == "cuda" and args.only is None and not has_gpu():
            continue
        if not measure(args.build, device, programs, words + ["--quick"] * args.quick, named,
                       folder):
            return 1
        print("rows are in", kept(device, folder))
    if folder == DATA:
        write_document()
    return 0
