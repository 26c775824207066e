# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the benchmark programs, keeps their rows and writes the tables of doc/performance.md; those
that show how a measurement works, not what a wall costs, are in doc/notes/performance.md.

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
NOTES = os.path.join(ROOT, "doc", "notes", "performance.md")
ELSEWHERE = dict.fromkeys(["kokkos-cpu", "kokkos-cuda", "kokkos-copies", "status", "distance", "build", "step", "in_place",
                           "cache", "near-and-far", "tree", "calls", "mesh-size"], NOTES)
ELSEWHERE["point-costs"] = os.path.join(ROOT, "doc", "library.md")
DATA = os.path.join(ROOT, "doc", "data")
DEVICES = ("cpu", "cuda")
PROGRAMS = ("query", "build", "step", "cache")
KEY = ("program", "case", "triangles", "spheres", "length", "order")

# Yong et al. 2017, Table 2 and figure 9, a K40. Its N = all tries every triangle, as no query here does.
PAPER_MS = {("10000000", "N = 1"): 362, ("10000000", "N = 2"): 565, ("10000000", "N = 3"): 937,
            ("60000000", "N = 2"): 3488}


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


def cells_of(row):
    return [ms(row), number(row["floor_ms"]) if row else "", number(row["ratio"]) if row else ""]


def find(rows, **wanted):
    """The first row with these values, or None; length is compared as a number."""
    for row in rows:
        if all(abs(float(row[k]) - v) < 1e-9 if k == "length" else row[k] == v
               for k, v in wanted.items()):
            return row
    return None


def same(rows, row):
    return find(rows, **{k: row[k] for k in KEY if k != "length"}, length=float(row["length"]))


def which(mine, others):
    """Which rows of a table are one machine's, where others have been made on another."""
    for column in ("spheres", "triangles"):
        values = {r[column] for r in mine}
        if others and values.isdisjoint(r[column] for r in others):
            return f", rows of {', '.join(count(v) for v in sorted(values, key=int))} {column}"
    return ""


def machines(rows_of):
    """Which machines and commits the rows of a table are from."""
    lines = []
    for device, rows in rows_of.items():
        if not rows:
            lines.append(f"* {device.upper()}: no rows are kept yet.")
        for name in dict.fromkeys(r["device"] for r in rows):
            mine = [r for r in rows if r["device"] == name]
            others = [r for r in rows if r["device"] != name]
            commits = ", ".join(dict.fromkeys(r["commit"] for r in mine))
            speeds = [float(r["copy_gb_s"]) for r in mine]
            repeats = ", ".join(dict.fromkeys(r["repeats"] for r in mine if r["repeats"] != "1"))
            lines.append(f"* {name}{which(mine, others)}: commit {commits}, {mine[0]['compiler']}; medians of "
                         f"{repeats} (least to most); copying {min(speeds):.4g} to {max(speeds):.4g} GB/s, "
                         "read and written.")
    return "\n".join(lines)


def of(rows, program, test=lambda case: True):
    return [r for r in rows if r["program"] == program and test(r["case"])]


def union(cpu, cuda):
    """One row for each key of both, the order of the longer list."""
    first, second = (cuda, cpu) if len(cuda) > len(cpu) else (cpu, cuda)
    return first + [r for r in second if not same(first, r)]


# ---- tables ------------------------------------------------------------------------------

def status_table(cpu, cuda):
    def is_status(case):
        return case.startswith("status")

    cpu, cuda = of(cpu, "query", is_status), of(cuda, "query", is_status)

    def cells(r):
        lists, kind = r["case"].split(", ")[1:3]
        return [count(r["spheres"]), lists, kind, r["order"], *cells_of(same(cuda, r)),
                number(PAPER_MS.get((r["spheres"], lists), "")), *cells_of(same(cpu, r))]

    heads = ["spheres", "lists", "numbers", "order", "CUDA, ms", "floor", "ratio",
             "the paper's K40", "CPU, ms", "floor", "ratio"]
    return table(union(cpu, cuda), heads, cells) + "\n\n" + machines({"cpu": cpu, "cuda": cuda})


def distance_table(cpu, cuda):
    def is_distance(case):
        return case.startswith("distance")

    cpu, cuda = of(cpu, "query", is_distance), of(cuda, "query", is_distance)

    def cells(r):
        kind = r["case"].split(", ")[2]
        return [count(r["triangles"]), kind, r["order"], *cells_of(same(cuda, r)), *cells_of(same(cpu, r))]

    heads = ["triangles", "numbers", "order", "CUDA, ms", "floor", "ratio", "CPU, ms", "floor", "ratio"]
    return table(union(cpu, cuda), heads, cells) + "\n\n" + machines({"cpu": cpu, "cuda": cuda})


def near_and_far(cpu):
    return of(cpu, "query", lambda case: case.startswith(("near, ", "far, ", "any, ")))


def near_and_far_tables(cpu):
    """Distances on one core by the library and by others, near the mesh and far from it; and set-up."""
    rows = near_and_far(cpu)
    ways = {"library, double": "library, double", "library, float": "library, float",
            "Embree, float": "Embree", "CGAL, double, no radius": "CGAL"}

    def of_way(r, start):
        place = r["case"].split(", ")[0]
        return next((x for x in rows if x["case"].startswith(f"{place}, {start}") and
                     x["triangles"] == r["triangles"] and x["order"] == r["order"]), None)

    def ns(row):
        if not row:
            return ""
        return number(float(row["median_ms"]) * 1e6 / float(row["spheres"]))

    def cells(r):
        embree = of_way(r, "Embree")
        ratio = number(float(facts(embree)["ns_per_point"]) / float(facts(r)["ns_per_point"])) if embree else ""
        return [r["case"].split(",")[0], count(r["triangles"]), r["order"],
                *[ns(of_way(r, start)) for start in ways.values()], ratio]

    def set_up(r):
        found = [facts(of_way(r, start)) for start in ways.values()]
        return [count(r["triangles"]), *[cell for way, f in zip(ways, found) for cell in
                                         [number(f.get("setup_s", ""))] +
                                         [number(f.get("grid_mb", ""))] * way.startswith("library")]]

    mine = [r for r in rows if r["case"].endswith("library, double")]
    once = [r for r in mine if r["case"].startswith("near") and r["order"] == "random"]
    names = ", ".join(dict.fromkeys(r["case"].split(", ")[1] for r in rows if "library" not in r["case"]))
    heads = [head for way in ways for head in
             [way.replace(", no radius", "") + ", s"] + ["grid, MB"] * way.startswith("library")]
    return (table(mine, ["points", "triangles", "order", *[way + ", ns" for way in ways], "Embree / library"], cells) +
            "\n\nSet-up, once for a mesh:\n\n" + table(once, ["triangles", *heads], set_up) +
            f"\n\n* {names}.\n" + machines({"cpu": rows}))


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


def tree_table(cuda):
    """Distances by the tree on a GPU."""
    def cells(r):
        return [r["case"].split(",")[0], count(r["triangles"]), count(r["spheres"]), r["order"], ms(r),
                number(facts(r)["ns_per_point"])]

    rows = of(cuda, "query", lambda case: case.endswith(", tree"))
    return table(rows, ["points", "triangles", "how many", "order", "ms", "ns a point"], cells) + "\n\n" + machines({"cuda": rows})


def calls_table(cpu):
    """What calls of the library cost by how many points they have."""
    rows = of(cpu, "query", lambda case: case.startswith("call"))

    def ns(case, points):
        row = find(rows, case=case, spheres=points)
        return number(1e6 * float(row["median_ms"])) if row else ""

    def cells(r):
        return [count(r["spheres"]), ns("call, near", r["spheres"]), ns("call, far", r["spheres"])]

    text = table([r for r in rows if r["case"] == "call, near"], ["points in a call", "near, ns", "far, ns"], cells)
    poses = [f"\n\n{r['case'].removeprefix('call, ').capitalize()}: {number(1e6 * float(r['median_ms']))} ns."
             for r in rows if "pose" in r["case"]]
    return text + "".join(poses) + "\n\n" + machines({"cpu": rows})


def build_table(cpu, cuda):
    cpu, cuda = of(cpu, "build"), of(cuda, "build")
    whole = [r for r in union(cpu, cuda) if r["case"] in ("given cell", "chosen cell")]

    def brute(rows, r):
        row = same(rows, dict(r, case=r["case"] + ", brute force"))
        if not row:
            return ""
        seconds = number(float(row["median_ms"]) / 1e3)
        return seconds + (" (estimated)" if "estimated" in facts(row) else "")

    def cells(r):
        f = facts(r)
        inner = same(cuda, dict(r, case=r["case"] + ", without copies"))
        tests = facts(same(cpu, dict(r, case=r["case"] + ", brute force")) or
                      same(cuda, dict(r, case=r["case"] + ", brute force"))).get("tests", "")
        return [count(r["triangles"]), number(r["length"]), count(f["cells"]), f["mean_list"],
                number(f["grid_mb"]), ms(same(cuda, r)), *cells_of(inner),
                *cells_of(same(cpu, r)), f["tests"], tests, brute(cuda, r), brute(cpu, r)]

    heads = ["triangles", "cell", "cells kept", "mean list", "MB", "CUDA, ms",
             "CUDA without copies, ms", "floor", "ratio", "CPU, ms", "floor", "ratio",
             "tests", "of brute force", "brute force, CUDA, s", "CPU, s"]
    return table(whole, heads, cells) + "\n\n" + machines({"cpu": cpu, "cuda": cuda})


def step_table(cpu, cuda, in_place):
    cpu, cuda = (of(rows, "step", lambda case: ("in place" in case) == in_place)
                 for rows in (cpu, cuda))

    def cells(r):
        f, g, c = facts(r), same(cuda, r), same(cpu, r)
        what = r["case"].replace(", in place", "")
        return [count(r["spheres"]), count(r["triangles"]), what, r["order"], count(f["near"]), count(f["contacts"]),
                *cells_of(g), facts(g).get("ns_per_near", ""),
                *cells_of(c), facts(c).get("ns_per_near", "")]

    heads = ["spheres", "triangles", "style", "order", "near", "contacts", "CUDA, ms", "floor", "ratio",
             "ns per near sphere", "CPU, ms", "floor", "ratio",
             "ns per near sphere"]
    return table(union(cpu, cuda), heads, cells) + "\n\n" + machines({"cpu": cpu, "cuda": cuda})


def cache_table(cpu):
    rows = of(cpu, "cache")

    def cells(r):
        write, read = same(rows, dict(r, case="write")), same(rows, dict(r, case="read"))
        return [count(r["triangles"]), number(r["length"]), number(facts(r)["block_mb"]),
                facts(write).get("file_mb", ""), ms(r), *cells_of(write), *cells_of(read)]

    heads = ["triangles", "cell", "grid, MB", "file, MB", "build, ms", "write, ms", "floor",
             "ratio", "read, ms", "floor", "ratio"]
    builds = [r for r in rows if r["case"] == "build"]
    return table(builds, heads, cells) + "\n\n" + machines({"cpu": rows})


def parts(cpu, cuda):
    """The generated parts of the document, with their markers."""
    text = {"status": status_table(cpu, cuda), "distance": distance_table(cpu, cuda),
            "near-and-far": near_and_far_tables(cpu), "tree": tree_table(cuda), "point-costs": point_costs(cpu), "calls": calls_table(cpu),
            "build": build_table(cpu, cuda),
             "step": step_table(cpu, cuda, False),
             "in_place": step_table(cpu, cuda, True), "cache": cache_table(cpu)}
    return between_markers(text)


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
    write_parts(parts(cpu, cuda))
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
