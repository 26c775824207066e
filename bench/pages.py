#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Puts tables of doc/data between the markers of pages, and plots rows of doc/data for them.

usage: pages.py [--check] [--plots]

Without words it writes the tables; --plots draws the pictures too (python3-matplotlib), and --check writes nothing and
ends with 1 if a page does not hold what the rows say. A table stands between <!-- NAME:begin --> and <!-- NAME:end -->;
all else of a page is written by hand. `./run bench NAME --keep` measures the rows.
"""
import argparse
import csv
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOC = ROOT / "doc"
DATA = DOC / "data"
IMAGES = DOC / "img"
DEVICES = ("cpu", "cuda")
OF_TESTS = ("theme", "id", "what", "backend", "precision", "relation", "answer", "ours", "tolerance", "derivation", "holds")


# ---- rows and cells ----------------------------------------------------------------------

def rows_of(name, delimiter=","):
    """Rows of doc/data/NAME as dicts. A .tsv is what tests/support/hard_case.h writes, with notes that begin with #."""
    lines = (DATA / name).read_text().splitlines()
    if name.endswith(".tsv"):
        return [dict(zip(OF_TESTS, line.split("\t"))) for line in lines if not line.startswith("# ")]
    return list(csv.DictReader(lines, delimiter=delimiter))


def table(rows, heads, cells):
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(cells(r)) + " |" for r in rows])


def find(rows, **wanted):
    """The first row with these values, in its columns or its facts, or None."""
    return next((r for r in rows if all(str({**r, **facts(r)}.get(k, "")) == str(v) for k, v in wanted.items())), None)


def facts(row):
    return dict(f.split("=", 1) for f in row.get("facts", "").split()) if row else {}


def number(text, digits=3):
    if text in ("", None):
        return ""
    value = float(text)
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 1000 else f"{value:.{digits}g}"


def count(text):
    return f"{int(text):,}".replace(",", " ")


def short(text, digits=4):
    return f"{float(text):.{digits}g}" if text else ""


def ms(row):
    """Median, and from least to most."""
    if not row:
        return ""
    if row["min_ms"] == row["max_ms"]:
        return number(row["median_ms"])
    return f"{number(row['median_ms'])} ({number(row['min_ms'])} to {number(row['max_ms'])})"


def ratio(a, b):
    return float(a["median_ms"]) / float(b["median_ms"])


def machines(rows):
    """Which machines and commits the rows of a table are from."""
    lines = []
    for device in dict.fromkeys(r["device"] for r in rows):
        mine = [r for r in rows if r["device"] == device]
        commits, repeats = (", ".join(dict.fromkeys(r[k] for r in mine)) for k in ("commit", "repeats"))
        lines.append(f"* {device}: commit {commits}; medians of {repeats} (least to most).")
    return "\n".join(lines)


# ---- tables of performance.md and library-queries.md -----------------------------------------------

def point_costs(cpu):
    """Distances of points in random order by the library, Embree and CGAL, in microseconds."""
    rows = [r for r in cpu if r["program"] == "query" and r["case"].startswith(("near, ", "far, ", "any, ")) and r["order"] == "random"]
    columns = [(way, place) for way in ("library, double", "Embree") for place in ("near", "far", "any")] + [("CGAL", "any")]

    def us(triangles, way, place):
        row = next((r for r in rows if r["case"].startswith(f"{place}, {way}") and r["triangles"] == triangles), None)
        if not row:
            return ""
        cost = float(facts(row)["ns_per_point"]) / 1e3
        return number(cost, 3 if cost >= 100 else 2)

    heads = ["triangles", *[place if way.startswith("library") else f"{way}: {place}" for way, place in columns]]
    return table(dict.fromkeys(r["triangles"] for r in rows), heads, lambda t: [count(t), *[us(t, *c) for c in columns]])


def set_up(cpu, cuda):
    """Seconds to build the grid with the cells that the fix chooses, copies included, on a core and on a GPU."""
    rows = [[r for r in each if r["program"] == "build" and r["case"] == "chosen cell"] for each in (cpu, cuda)]

    def seconds(triangles, each):
        row = find(each, triangles=triangles)
        return number(float(row["median_ms"]) / 1e3, 2) if row else ""

    heads = ["triangles", "cell", *[f"{each[0]['device']}, s" for each in rows]]
    return table(rows[0], heads, lambda r: [count(r["triangles"]), number(r["length"], 2), *[seconds(r["triangles"], each) for each in rows]])


NO_WALL = ", no wall"
MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
BEDS = ("flat floor", "closed box", "closed box, check yes", "closed box, granular", "bumpy floor")
LEFT_OUT = ("closed box, check yes",)    # of the table for users: the bed is there with the default


def beside(rows, row, more):
    """The row of the same bed with another wall, or without."""
    return find(rows, case=row["case"] + more, order=row["order"], triangles=row["triangles"], spheres=row["spheres"],
                host=facts(row)["host"], ranks=facts(row)["ranks"])


def cost(rows):
    """What the wall adds to a step, in per cent: a line for each bed and its size. Of several LAMMPS the newest that was
    timed in sorted order, and those in which LAMMPS's own wall was timed on the GPU."""
    beds = {}
    for r in rows:
        if r["case"] in BEDS and facts(r)["ranks"] == "1":
            beds.setdefault((r["device"], r["case"], r["triangles"], r["spheres"], facts(r)["host"]), {})[r["order"]] = r

    def added(r, more=""):
        with_wall = beside(rows, r, more) if r and more else r
        if not with_wall or not with_wall["median_ms"]:
            return ""
        return f"{100 * (ratio(with_wall, beside(rows, r, NO_WALL)) - 1):.1f}"

    def day(bed):
        parts = re.match(r"(\d+)([A-Z][a-z]+)(\d+)", bed[4]).groups()
        return int(parts[2]), MONTHS.index(parts[1]), int(parts[0])

    newest = {bed[:4]: bed for bed in sorted((b for b in beds if "sorted" in beds[b]), key=day)}
    beds = {b: orders for b, orders in beds.items()
            if b[1] not in LEFT_OUT and (b in newest.values() or added(orders.get("sorted"), ", wall/gran/kk"))}
    used = [r for b in sorted(beds) for r in beds[b].values()]
    commits = {name: ", ".join(dict.fromkeys(r["commit"] for r in used if r["device"] == name))
               for name in dict.fromkeys(r["device"] for r in used)}

    def cells(bed):
        orders, r = beds[bed], next(iter(beds[bed].values()))
        share = f"{100 * int(facts(r)['touching']) / int(r['spheres']):.2g}"
        return [r["device"], facts(r)["host"], r["case"], count(r["triangles"]), count(r["spheres"]), share,
                *[added(orders.get(order)) for order in ("sorted", "random")],
                *[added(orders.get("sorted"), ", " + style) for style in ("wall/gran", "wall/gran/kk")]]

    heads = ["device", "LAMMPS", "bed", "triangles", "atoms", "at the wall, %", "wall/lsdcd adds, %, sorted", "random",
             "wall/gran, %, sorted", "wall/gran/kk, %, sorted"]
    return (table(sorted(beds, key=lambda bed: (bed[0], bed[1], int(bed[2]), int(bed[3]), day(bed))), heads, cells) + "\n\n" +
            "\n".join(f"* {name}: commit {commit}." for name, commit in commits.items()))


def scaling(rows):
    pairs = []
    for r in rows:
        ranks = int(facts(r)["ranks"])
        if r["case"] in BEDS and ranks > 1:
            one = find(rows, case=r["case"], triangles=r["triangles"], order=r["order"],
                       spheres=int(r["spheres"]) // ranks, host=facts(r)["host"], ranks=1)
            pairs += [(r, one)] if one else []

    def cells(pair):
        r, one = pair
        without, one_without = (beside(rows, x, NO_WALL) for x in pair)
        with_wall, no_wall = ratio(one, r), ratio(one_without, without)
        return [r["case"], count(one["spheres"]), facts(r)["ranks"], r["order"], r["device"], facts(r)["host"], ms(r),
                ms(without), f"{with_wall:.2f}", f"{no_wall:.2f}", f"{with_wall / no_wall:.3f}"]

    return table(pairs, ["bed", "atoms per process", "processes", "order", "device", "LAMMPS", "with the wall, ms",
                         "without, ms", "efficiency with", "without", "ratio"], cells)


LIGGGHTS_CASES = {"at the wall": "all at the wall, fixed", "turning": "all at the wall, fixed; the cylinder turns",
                  "in bulk": "in bulk, moving", "in bulk late": "in bulk, moving; `neigh_modify delay 10`",
                  "in bulk unchecked": "in bulk, moving; `neigh_modify every 20 check no`"}


def liggghts(rows):
    def case_of(r):
        return r["case"].rsplit(", ", 1)[0]

    def of(program, like, order="sorted"):
        return find(rows, case=f"{case_of(like)}, {program}", triangles=like["triangles"], order=order)

    def cells(r):
        theirs = of("LIGGGHTS", r)
        pairs = ((r, theirs), [of(program, r, "random") for program in ("lsdcd", "LIGGGHTS")])
        return [LIGGGHTS_CASES[case_of(r)], count(r["triangles"]), number(r["median_ms"]),
                number(theirs["median_ms"] if theirs else ""), *[f"{ratio(b, a):.1f}" if a and b else "" for a, b in pairs]]

    def set_up(r):
        f, g = facts(r), facts(of("LIGGGHTS", r))
        return (f"{count(r['triangles'])} triangles: {number(f['setup_s'])} s, LIGGGHTS {number(g.get('setup_s', ''))} s; "
                f"{number(f['memory_mb'])} MB, LIGGGHTS {number(g.get('memory_mb', ''))} MB")

    mine = sorted((r for r in rows if r["case"].endswith(", lsdcd") and r["order"] == "sorted"),
                  key=lambda r: (list(LIGGGHTS_CASES).index(case_of(r)), int(r["triangles"])))
    heads = ["spheres", "triangles", "wall/lsdcd, ms", "LIGGGHTS, ms", "LIGGGHTS / wall/lsdcd", "the same, random order"]
    return "\n".join([table(mine, heads, cells), "",
                      f"* Set-up and memory: {'. '.join(set_up(r) for r in mine if r['case'] == mine[0]['case'])}.",
                      machines(rows)])


def floor(rows):
    large = ", large triangle added"

    def cells(r):
        plane = find(rows, case="wall/gran zplane", order=r["order"])
        return [count(r["case"].split()[1]), number(plane["median_ms"]), number(r["median_ms"]), facts(r)["over_plane"],
                facts(find(rows, case=r["case"] + large, order=r["order"]))["over_plane"]]

    mine = [r for r in rows if r["case"].startswith("floor") and not r["case"].endswith(large) and r["order"] == "sorted"]
    return table(mine, ["triangles", "flat plane, ms", "mesh, ms", "mesh / plane", "large triangle added / plane"],
                 cells) + "\n\n" + machines(rows)


# ---- tables of effects.md ------------------------------------------------------------------

def costs(cpu, cuda):
    first, on_gpu = cpu[0], cuda[0]
    told = (f"The CPU's times are the least of {first['repeats']} rounds with {first['contacts']} contacts on one core "
            f"(commit {first['commit']}, {first['compiler']}). The GPU's are the least of {on_gpu['repeats']} rounds with "
            f"{on_gpu['contacts']} contacts on an {on_gpu['device'].replace('CUDA, ', '')} (commit {on_gpu['commit']}). "
            "They include the copies to and from it and the host's part of a step.")

    def ns(row):
        return short(row["min_ns"], 3) if row else ""

    def over(row):
        return f"{float(row['over_ns']):+.1f}" if row and row["over"] else ""

    def cells(r):
        g = find(cuda, name=r["name"])
        return [r["name"], f"`{r['words']}`", ns(r), over(r), ns(g), over(g), r["over"], r["bytes_per_atom"], r["bytes_per_contact"]]

    heads = ["effect", "turned on by", "CPU, ns", "more than without", "GPU, ns", "more than without", "without is", "B/atom",
             "B/contact"]
    shown = [k for k, head in enumerate(heads) if "without" not in head]    # a combination is over none
    alone = [r for r in cpu if r["over"] or r["name"] == "hooke"]
    several = [r for r in cpu if r not in alone]
    return "\n\n".join([told, "This table has each effect alone:", table(alone, heads, cells), "This one has common combinations:",
                        table(several, [heads[k] for k in shown], lambda r: [cells(r)[k] for k in shown])])


def bodies(rows):
    def whole(value):
        return f"{value:.0f}" if value >= 100 else f"{value:.3g}"

    def cells(r):    # bytes are for each body, and for each contact of a coat
        least, stored = float(r["min_ns"]), int(r["saved_bytes"])
        return [r["name"], f"`{r['words']}`", whole(least) if least else "", "+" + whole(float(r["over_ns"])) if r["over"] else "",
                r["over"], str(stored) if stored and (r["each"] == "1" or not least) else ""]

    return (f"One core, commit {rows[0]['commit']}, {rows[0]['compiler']}, least of {rows[0]['repeats']} rounds.\n\n" +
            table(rows, ["what", "words", "ns", "more than without", "without is", "B in restart files"], cells))


# ---- the table of hard-cases.md ------------------------------------------------------------

# Theme of the rows: its title on the page; what its lines of the table are called, and which numbers they hold.
HARD_CASES = {
    "Seams of a plane": ("Seams of a plane", [
        ("normal force, one plane", r"^(?!.*(1e-7|4e-7)).*F/F0 - 1"), ("force along it", r"^(?!.*(1e-7|4e-7)).*Ft"),
        ("normal force, gaps and steps of 1e-7", r"F/F0 - 1"), ("force along it, the same", r"Ft")]),
    "Convex edges, corners and tips": ("Convex edges, corners and tips", [
        ("contacts", "contacts"), ("direction after a drop / speed", "mirrored"), ("force / F", "F/F0")]),
    "Nearly flat": ("Shallow folds", [("change of force / that of one wall", r"\|dF\|"), ("sum of two or three walls", r"F/")]),
    "Funnels and cones": ("Funnels and cones", [
        ("jump of the force / F", "of a step"), ("the same, a plane moved by 2e-12 R", "moved"), ("energy, bouncing", "bounces")]),
    "Drum": ("A drum of flat segments", [
        ("force / that of the polygon", "F_polygon"), ("roughness", "rms"), ("energy, sliding, 1/s", "sliding"),
        ("energy lost by rolling, beyond the polygon", "polygon's own"), ("beyond a smooth drum", "smooth cylinder's"),
        ("the same with `corner sum`", "corner sum")]),
    "History": ("Springs across seams", [
        ("same bits after a break", "difference"), ("jump of the spring", "jump"), ("friction, round a drum of segments", "drum"),
        ("friction below its limit", "kt|two springs"), ("friction at its limit", "mu F_n")]),
    "Rolling": ("Rolling", [
        ("lift and drift / R", "lift|drift aside"), ("contacts on a tip", "contacts"), ("energy over a tip", "energy"),
        ("slip to roll", "^slip"), ("acceleration", "acceleration")]),
    "Bouncing": ("Bouncing", [
        ("heights in a train", "height"), ("way to the side / R", "way"), ("slip", "^gross"), ("restitution, stick", "^(restit|stick)")]),
    "Belt": ("A moving belt", [("speed", "speed over"), ("time, way", "time|way")]),
    "Energy": ("Energy", [("energy, 1e6 steps", "billiard"), ("bed: energy, weight, moment", "drum")]),
    "Time step": ("Time step", [
        ("`corner sum`: growth", "corner sum"), ("swing below the limit", "excursion"), ("growth above it", "growth")]),
    "Fast and thin": ("Fast spheres, thin walls", [
        ("speed or step that passes", "goes through|unseen"), ("spheres lost, `side both`", ">="), ("spheres lost, `side in`", "lost"),
        ("plate of 1e-3 R", "plate")]),
    "Bad meshes, against exact arithmetic": ("Bad meshes", [
        ("missed", "missed"), ("contacts", "most"), ("distance / its tolerance, past tips", "tips"),
        ("distance, force / R", r"exact\||F - k d"), ("length of normals", r"\|n\|")]),
    "Random meshes and spheres": ("Random meshes and spheres", [
        ("distance / its tolerance", "/ tolerance"), ("missed, doubled, wrong", "=")]),
}


def used(row):
    """The share of its tolerance that a number takes; more than 1 fails."""
    ours, answer, tolerance = (float(row[k]) for k in ("ours", "answer", "tolerance"))
    if row["relation"] == "<=":
        return ours / answer
    if row["relation"] == ">=":
        return answer / ours
    off = abs(ours - answer)
    return off / tolerance if tolerance else (0 if off == 0 else math.inf)


def deviation(row):
    if row is None:
        return "not run"
    off = float(row["ours"])
    off = f"{abs(off - float(row['answer'])) if row['relation'] == '=' else off:.2g}"
    return off if row["holds"] == "holds" else f"**{off} FAILS**"


def allowed(row):
    if row["relation"] == ">=":
        return f"at least {float(row['answer']):.2g}"
    return f"{float(row['tolerance' if row['relation'] == '=' else 'answer']):.2g}"


def group_of(row):
    """The line of the table that holds a number; what no pattern knows has one of its own."""
    for name, pattern in HARD_CASES[row["theme"]][1]:
        if re.search(pattern, row["what"]) or re.search(pattern, row["relation"]):
            return name
    return row["what"].rsplit(": ", 1)[-1]


def hard_cases(cpu, cuda):
    """A line for each kind of number: the one that is nearest to its tolerance."""
    known = {(r["theme"], r["id"], r["what"]) for r in cpu}
    groups = {}
    for r in cpu + cuda:
        if (r["theme"], r["id"], r["what"]) in known:
            at = groups.setdefault((r["theme"], group_of(r)), {})
            at.setdefault((r["id"], r["what"]), {}).setdefault(r["backend"], r)
    order, above, lines = list(HARD_CASES), "", []
    for (theme, name), cases in sorted(groups.items(), key=lambda g: order.index(g[0][0])):
        worst = max(cases.values(), key=lambda case: max(used(r) for r in case.values()))
        on_cpu, on_cuda = deviation(worst.get("cpu")), deviation(worst.get("cuda"))
        result = on_cpu if on_cpu == on_cuda else f"{on_cpu} (CPU)" if on_cuda == "not run" else f"{on_cpu}; {on_cuda}"
        title = HARD_CASES[theme][0]
        cells = ["" if title == above else title, name, str(len(cases)), result, allowed(next(iter(worst.values())))]
        above = title
        lines.append([c.replace("|", "\\|") for c in cells])
    return table(lines, ["case", "number", "of them", "result", "allowed"], lambda cells: cells)


# ---- tables of accuracy.md and notes/paper.md ----------------------------------------------------

def settings(rows):
    """What settings buy and cost, a line each: those that were measured on the CPU."""
    def percent(share):
        return "none" if float(share) == 0 else f"{100 * float(share):.2g} %"

    def error(value):
        value = float(value)
        return "0" if value < 1e-12 else f"{value:.0f}" if value >= 1 else f"{value:.1g}"

    shares = {}    # of the default length of cells, by which a GPU's cells are compared with a CPU's
    for device in DEVICES:
        mine = [r for r in rows if r["kind"] == device]
        default = float(find(mine, default=1)["grid"])
        for r in mine:
            shares.setdefault(f"{float(r['grid']) / default:.2g}", {})[device] = r["grid"]
    at_default = shares.pop("1")
    base = dict(corner="blend", nearest="all")
    lines = [("**nothing** (the default)", at_default, base)]
    lines += [(f"`grid` {s} times the default", at, base) for s, at in sorted(shares.items()) if set(at) == set(DEVICES)]
    lines += [("`corner sum`", at_default, {**base, "corner": "sum"})]
    lines += [(f"`nearest {n}`", at_default, {**base, "nearest": n}) for n in (8, 3, 2, 1)]

    def cells(line):
        name, at, wanted = line
        cpu, gpu = (find(rows, kind=device, grid=at[device], **wanted) for device in DEVICES)
        return [name, percent(cpu["missed"]), error(cpu["force_mean"]), error(cpu["force_largest"]), error(cpu["bounce_drift"]),
                error(cpu["roll_drift"]), f"{float(cpu['ns_per_sphere']):.0f}", short(gpu["ns_per_sphere"], 3),
                short(cpu["status_ns"], 3), short(gpu["status_ns"], 3), f"{float(cpu['bytes']) / 1e6:.3g}"]

    heads = ["setting", "missed contacts", "force error, mean", "largest", "energy drift: bouncing", "rolling",
             "ns a step, CPU core", "GPU", "ns a query, CPU core", "GPU", "MB"]
    return table(lines, heads, cells)


def of_study(rows, name):
    return [r for r in rows if r["table"] == name and r["order"] == "random"]


def paper_cylinder(cpu, cuda):
    """The paper's table 2 at L = 0.2."""
    cpu, cuda = ([r for r in of_study(rows, "table2") if r["length"] == "0.2"] for rows in (cpu, cuda))

    def query_ms(rows, like):
        return short(find(rows, lists=like["lists"], spheres=like["spheres"])["query_ms"])

    def cells(r):
        name = r["lists"].replace("complete", "all, the default").replace("every triangle", "every triangle tried")
        paper = r["lists"] != "complete"
        return [name, f"{float(r['accuracy']):.6f}", r["paper_accuracy"] * paper, f"{abs(float(r['error_percent'])):.4f}",
                f"{float(r['paper_error_percent']):.4f}" * paper, r["missed"], query_ms(cuda, r), query_ms(cpu, r),
                short(r["paper_query_ms"], 6) * paper]

    return table(cuda, ["N", "accuracy", "in the paper", "error, %", "in the paper", "missed contacts", "ms, GPU", "ms, CPU",
                        "ms, in the paper"], cells)


def finer_cylinders(rows):
    """Missed contacts and time by N, two columns for each mesh."""
    rows = of_study(rows, "mesh")
    meshes = sorted({r["triangles"] for r in rows}, key=int)[1:]

    def cells(lists):
        found = [find(rows, triangles=m, lists=lists) for m in meshes]
        return [lists.replace("complete", "all")] + [
            cell for r in found for cell in (short(100 * int(r["missed"]) / int(r["touching"]), 2) or "0", short(r["query_ms"]))]

    heads = ["N"] + [head for m in meshes for head in (count(m) + " triangles, %", "ms")]
    return table(dict.fromkeys(r["lists"] for r in rows), heads, cells)


# ---- pages ---------------------------------------------------------------------------------

def tables():
    """Page: name of the markers: table."""
    cpu, cuda = (rows_of(f"performance_{device}.csv") for device in DEVICES)
    kokkos_cpu, kokkos_cuda = (rows_of(f"kokkos_{device}.csv") for device in DEVICES)
    study = [rows_of(f"accuracy_{device}.csv") for device in DEVICES]
    return {
        "performance.md": {"cost": cost(kokkos_cuda + kokkos_cpu), "set-up": set_up(cpu, cuda),
                           "liggghts": liggghts(rows_of("liggghts_cpu.csv"))},
        "notes/performance.md": {"kokkos-scaling": scaling(kokkos_cuda), "floor": floor(rows_of("floor_cpu.csv"))},
        "library-queries.md": {"point-costs": point_costs(cpu)},
        "effects.md": {"costs": costs(*(rows_of(f"effects_{device}.csv", ";") for device in DEVICES))},
        "notes/effects.md": {"bodies": bodies(rows_of("effects_bodies_cpu.csv", ";"))},
        "notes/hard-cases.md": {"numbers": hard_cases(*(rows_of(f"hard_cases_{device}.tsv") for device in DEVICES))},
        "accuracy.md": {"settings": settings([r for d in DEVICES for r in rows_of(f"tradeoff_vessel_{d}.csv")])},
        "notes/paper.md": {"paper-cylinder": paper_cylinder(*study), "finer-cylinders": finer_cylinders(study[1])},
    }


def replaced(text, name, made):
    """The text of a page with this table between its markers."""
    begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->"
    if begin not in text or end not in text:
        raise SystemExit(f"a page lacks the markers {begin.strip()} and {end}")
    before, _, rest = text.partition(begin)
    return before + begin + made + "\n" + end + rest.partition(end)[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; 1 if a page is stale")
    parser.add_argument("--plots", action="store_true", help="draw the pictures, too")
    args = parser.parse_args()
    stale = []
    for page, made in tables().items():
        old = text = (DOC / page).read_text()
        for name, each in made.items():
            changed = replaced(text, name, each)
            stale += [f"{page}: {name}"] * (changed != text)
            text = changed
        if text != old and not args.check:
            (DOC / page).write_text(text)
    print("\n".join(f"{'stale' if args.check else 'wrote'} {name}" for name in stale) or "all tables are those of doc/data")
    if args.plots:
        sys.path.insert(0, str(pathlib.Path(__file__).parent))
        import plots
        plots.draw_all()
    return 1 if args.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
