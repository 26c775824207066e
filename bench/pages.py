#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Puts tables of doc/data between the markers of pages, and plots rows of doc/data for them.

usage: pages.py [--check] [--plots]

Without words it writes the tables; --plots draws the pictures too (python3-matplotlib), and --check writes nothing and
ends with 1 if a page does not hold what the rows say. A table, or words with figures, stands between <!-- NAME:begin --> and
<!-- NAME:end -->; all else of a page is written by hand. `./run bench NAME --keep` measures the rows.
"""
import argparse
import csv
import math
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOC = ROOT / "doc"
DATA = DOC / "data"
IMAGES = DOC / "img"
DEVICES = ("cpu", "cuda")


# ---- rows and cells ----------------------------------------------------------------------

def rows_of(name, delimiter=","):
    """Rows of doc/data/NAME as dicts."""
    return list(csv.DictReader((DATA / name).read_text().splitlines(), delimiter=delimiter))


def table(rows, heads, cells):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
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


def ratio(a, b):
    return float(a["median_ms"]) / float(b["median_ms"])


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


def hours(cpu, cuda):
    """Hours of 1 000 000 steps, from the time of a grain and step that two beds took with their walls."""
    core = find(cpu, case="bumpy floor", triangles=20022, spheres=20000, order="sorted", host="4Jul2026", ranks=1)
    card = find(cuda, case="closed box, granular", spheres=1000000, order="sorted", ranks=1)
    core_ns, card_ns = (1e6 * float(r["median_ms"]) / int(r["spheres"]) for r in (core, card))

    def of(grains, ns, cores=1):
        value = grains * 1e6 * ns * 1e-9 / 3600 / cores
        return f"{value:.0f}" if value >= 10 else f"{value:.1g}" if value < 0.1 else f"{value:.2g}"

    made = table((10000, 100000, 1000000, 10000000), ["grains", "one core", "4 cores", "16 cores", "one H200"],
                 lambda n: [count(n), *[of(n, core_ns, cores) for cores in (1, 4, 16)], of(n, card_ns) if n >= int(card["spheres"]) else ""])
    return (f"{made}\n\n* A grain and step, wall included: {core_ns:.0f} ns on one core ({core['device']}, `gran/hooke/history/kk` over a floor of "
            f"{count(core['triangles'])} triangles); {card_ns:.1f} ns on the H200 (`gran/hooke/history/kk`, at the wall `granular` with hertz/material, mindlin, "
            f"sds and marshall in a box of {count(card['triangles'])} triangles).")


# ---- many cores ------------------------------------------------------------------------------------

NOT_MEASURED = "*Not measured yet: `./run bench cores --keep`.*"
CORE_CASES = {"silo": "silo, 100 000 grains", "drum": "drum, 38 000", "impact": "impact, 25 000 and a ball", "mill": "mill, 30 000"}


def core_rows():
    """Rows of `./run bench cores`, each with its facts, its case and its program."""
    path = DATA / "cores_cpu.csv"
    rows = rows_of(path.name) if path.exists() else []
    return [{**r, **facts(r), "bed": r["case"].partition(", ")[0], "of": r["case"].partition(", ")[2]} for r in rows]


def ms_of(row, *names):
    """Sum of these facts, ms a step."""
    found = [float(row[name]) for name in names if row.get(name)]
    return number(f"{sum(found):.6g}") if found else ""


def cores_times(rows):
    """Where the time of a step goes with the most processes: each bed and program as it is, and at its best."""
    if not rows:
        return NOT_MEASURED
    most = max(int(r["ranks"]) for r in rows)
    chosen = []
    for bed in CORE_CASES:
        for program in ("lsdcd", "LIGGGHTS"):
            mine = [r for r in rows if (r["bed"], r["of"], r["ranks"]) == (bed, program, str(most))]
            plain = [r for r in mine if "processors" not in r["order"] and "balance none" in r["order"]][:1]
            best = sorted(mine, key=lambda r: float(r["median_ms"]))[:1]
            chosen += plain + [r for r in best if r not in plain]
    heads = ["bed", "program", "with", "a step, ms", "pairs", "lists", "communication", "wall", "rest", "largest over mean: pairs", "wall", "grains"]

    def cells(r):
        wall = ms_of(r, "wall_forces", "wall_search")
        rest = float(r["median_ms"]) - sum(float(r.get(k) or 0) for k in ("pair", "neigh", "comm", "wall_forces", "wall_search"))
        return [CORE_CASES[r["bed"]], {"lsdcd": "LSDCD"}.get(r["of"], r["of"]), r["order"], number(r["median_ms"]), ms_of(r, "pair"), ms_of(r, "neigh"),
                ms_of(r, "comm"), wall, number(f"{rest:.6g}"), short(r.get("pair_over_mean", ""), 3), short(r.get("wall_over_mean", ""), 3),
                short(r.get("grains_over_mean", ""), 3)]
    return table(chosen, heads, cells) + f"\n\n* {most} processes, {chosen[0]['device'].partition(', ')[2]}."


def cores_tried(rows):
    """What was tried with the most processes in LSDCD, ms a step by bed."""
    if not rows:
        return NOT_MEASURED
    most = max(int(r["ranks"]) for r in rows)
    mine = [r for r in rows if r["of"] == "lsdcd" and int(r["ranks"]) * int(r["threads"]) == most]
    beds = [bed for bed in CORE_CASES if any(r["bed"] == bed for r in mine)]
    orders = list(dict.fromkeys(r["order"].replace(", lists multi, all", "") for r in mine if r["bed"] in beds))

    def cells(order):    # with the lists that take less time
        times = {bed: [float(r["median_ms"]) for r in mine if r["bed"] == bed and r["order"].replace(", lists multi, all", "") == order] for bed in beds}
        return [order, *[number(f"{min(times[bed]):.6g}") if times[bed] else "" for bed in beds]]
    return table(orders, ["with", *[f"{bed}, ms" for bed in beds]], cells)


def cores_growth(rows):
    """Parallel efficiency against one process, without balance and with it."""
    if not rows:
        return NOT_MEASURED
    mine = [r for r in rows if r["of"] == "lsdcd" and r["threads"] == "1" and "processors" not in r["order"]]
    alone = {r["bed"]: float(r["median_ms"]) for r in mine if r["ranks"] == "1"}
    ranks = sorted({int(r["ranks"]) for r in mine})

    def cell(bed, n, words):
        row = next((r for r in mine if (r["bed"], r["ranks"]) == (bed, str(n)) and r["order"].startswith(words)), None)
        return f"{100 * alone[bed] / n / float(row['median_ms']):.0f} %" if row and bed in alone else ""
    ways = (("as it is", "fix balance none"), ("balanced", "fix balance shift xyz, weight neigh"))
    beds = [bed for bed in CORE_CASES if bed in alone]
    heads = ["processes", *[f"{bed}, {how}" for bed in beds for how, _ in ways]]
    return table(ranks, heads, lambda n: [str(n), *[cell(bed, n, words) if n > 1 or words.endswith("none") else "" for bed in beds for _, words in ways]])


def cores_wide(rows):
    """Lists of 27 000 grains of 10:1."""
    mine = [r for r in rows if r["bed"] == "wide"]
    if not mine:
        return NOT_MEASURED

    def how(r):
        lists = r["order"].partition("lists ")[2].partition(" threads")[0]
        return {"": "`neighbor bin`", "multi": "`neighbor multi`"}.get(lists, "`neighbor multi`, `comm_modify mode multi`")
    return table(mine, ["processes", "lists", "a step, ms", "pairs", "lists, ms", "communication", "wall"],
                 lambda r: [r["ranks"], how(r), number(r["median_ms"]), ms_of(r, "pair"), ms_of(r, "neigh"), ms_of(r, "comm"),
                            ms_of(r, "wall_forces", "wall_search")])


NO_WALL = ", no wall"
MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
BEDS = ("flat floor", "closed box", "closed box, check yes", "closed box, granular", "bumpy floor")
LEFT_OUT = ("closed box, check yes",)    # of the table for users: the bed is there with the default


def beside(rows, row, more):
    """The row of the same bed with another wall, or without."""
    return find(rows, case=row["case"] + more, order=row["order"], triangles=row["triangles"], spheres=row["spheres"],
                host=facts(row)["host"], ranks=facts(row)["ranks"])


def cost(rows):
    """What the wall adds to a step, in per cent: a line for each bed and its size, of the newest LAMMPS that was timed in sorted
    order; and what LAMMPS's own wall adds on the GPU."""
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
    own = next(o["sorted"] for b, o in beds.items() if "CPU" not in b[0] and added(o.get("sorted"), ", wall/gran/kk"))
    beds = {b: orders for b, orders in beds.items() if b[1] not in LEFT_OUT and b in newest.values()}

    def cells(bed):
        orders, r = beds[bed], next(iter(beds[bed].values()))
        share = f"{100 * int(facts(r)['touching']) / int(r['spheres']):.2g}"
        return [r["device"], facts(r)["host"], r["case"], count(r["triangles"]), count(r["spheres"]), share,
                *[added(orders.get(order)) for order in ("sorted", "random")]]

    heads = ["device", "LAMMPS", "bed", "triangles", "atoms", "at the wall, %", "adds, %, sorted", "random"]
    return (table(sorted(beds, key=lambda bed: (bed[0], bed[1], int(bed[2]), int(bed[3]), day(bed))), heads, cells) + "\n\n" +
            f"* LAMMPS's own flat walls in LAMMPS {facts(own)['host']} on the {own['device']}, {own['case']} of {count(own['spheres'])} atoms: `wall/gran` "
            f"adds {added(own, ', wall/gran')} %, `wall/gran/kk` {added(own, ', wall/gran/kk')} %, `wall/lsdcd` {added(own)} %.")


def scale(rows):
    """Of many grains on one GPU and on several, a scene and a law after the other."""
    walls = sorted((r for r in rows if not r["case"].endswith(", no wall")), key=lambda r: (r["case"], int(r["triangles"]), int(r["spheres"])))

    def without(r):
        return find(rows, case=r["case"] + ", no wall", triangles=r["triangles"], spheres=r["spheres"])

    def line(r):
        alone, f = without(r), facts(r)
        each = int(r["spheres"]) / int(f["ranks"])
        more = 100 * (float(f["over_no_wall"]) - 1)
        scene = r["case"][0].upper() + r["case"][1:]
        return (f"* {scene}: {count(r['spheres'])} grains and {count(r['triangles'])} triangles on {f['ranks']} {r['device']}: {number(alone['median_ms'])} ms a step "
                f"without the wall, {number(r['median_ms'])} with it, {abs(more):.1f} % {'more' if more > 0 else 'less'}, "
                f"{number(each / float(r['median_ms']) / 1000)} million grain-steps a second and card; "
                f"{int(f['mib']) / 1024:.3g} GiB of a card, {int(f['mib']) * 1024**2 / each:.0f} bytes a grain; "
                f"grains made in {number(facts(alone)['make_s'])} s, the wall set up in {number(f['setup_s'])} s")

    return "\n".join(map(line, walls))


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
        return [LIGGGHTS_CASES[case_of(r)], count(r["triangles"]), number(r["median_ms"]), number(theirs["median_ms"]), f"{ratio(theirs, r):.1f}"]

    def set_up(r):
        f, g = facts(r), facts(of("LIGGGHTS", r))
        return (f"{count(r['triangles'])} triangles: {number(f['setup_s'])} s, LIGGGHTS {number(g.get('setup_s', ''))} s; "
                f"{number(f['memory_mb'])} MB, LIGGGHTS {number(g.get('memory_mb', ''))} MB")

    mine = sorted((r for r in rows if r["case"].endswith(", lsdcd") and r["order"] == "sorted"),
                  key=lambda r: (list(LIGGGHTS_CASES).index(case_of(r)), int(r["triangles"])))
    random = [ratio(*(of(program, r, "random") for program in ("LIGGGHTS", "lsdcd"))) for r in mine]
    heads = ["spheres", "triangles", "wall/lsdcd, ms", "LIGGGHTS, ms", "LIGGGHTS / wall/lsdcd"]
    return "\n".join([table(mine, heads, cells), "", f"* With spheres in random order LIGGGHTS takes {min(random):.1f} to {max(random):.1f} times as long.",
                      f"* Set-up and memory, with cells for these grains: {'. '.join(set_up(r) for r in mine if r['case'] == mine[0]['case'])}.",
                      f"* Devices: {'; '.join(dict.fromkeys(r['device'] for r in rows))}."])


# ---- tables of effects.md ------------------------------------------------------------------

def noise(rows):
    """Differences up to this (ns) are noise: none is below 3, nor below what an effect seems to save, for it saves nothing."""
    return max(3, math.ceil(-min(float(r["over_ns"]) for r in rows if r["over"])))


def stands_out(rows, row):
    """Whether each round with the effect took longer than each without."""
    without = find(rows, name=row["over"]) if row and row["over"] else None
    return bool(without) and float(row["min_ns"]) > float(without["max_ns"])


def is_in_place(cuda):
    """Whether the spheres were in the memory of the GPU."""
    return cuda[0]["device"].endswith(", in place")


def costs(cpu, cuda, pairs):
    first, on_gpu, of_pairs = cpu[0], cuda[0], pairs[0]
    card = on_gpu["device"].replace("CUDA, ", "").replace(", in place", "")
    how = (" of many steps, with the spheres in its memory: no sphere and no contact is copied. `energy` waits for its sums in each step; `each_contact` is without bringing "
           "contacts to the CPU, which a run does in each step; `heat` is for hosts that have temperatures on a GPU, which LAMMPS has not"
           if is_in_place(cuda) else ", with the copies to and from it")
    told = (f"The CPU's times are of {first['contacts']} contacts on one core, the least of {first['repeats']} rounds "
            f"({first['compiler']}); differences below {noise(cpu)} ns are noise. The GPU's are of {on_gpu['contacts']} contacts on an "
            f"{card}, the least and the largest of {on_gpu['repeats']} rounds{how}. Differences are of the least, and are in bold where each round "
            f"with the effect took longer than each without. Those of pairs are of "
            f"{of_pairs['contacts']} contacts between grains on one core, the least of {of_pairs['repeats']}.")

    def ns(row):
        return short(row["min_ns"], 3) if row else ""

    def over(row):
        return f"{float(row['over_ns']):+.1f}" if row and row["over"] else ""

    def ns_on_gpu(row):
        return " to ".join(dict.fromkeys(short(row[most], 3) for most in ("min_ns", "max_ns"))) if row else ""

    def over_on_gpu(row):
        more = f"{float(row['over_ns']):+.{3 if is_in_place(cuda) else 1}f}" if row and row["over"] else ""
        return f"**{more}**" if stands_out(cuda, row) else more

    def words(row):
        return f"`{row['words']}`" if row else ""

    def cells(r):
        g = find(cuda, name=r["name"])
        without = re.sub(r"(,| \.\.\.).*`", "`", words(find(cpu, name=r["over"])))    # of several words the first
        pair = find(pairs, name=r["name"])
        return [words(r), ns(r), over(r), ns_on_gpu(g), over_on_gpu(g), ns(pair), over(pair), without, r["bytes_per_contact"],
                pair["bytes_per_pair"] if pair else ""]

    heads = ["turned on by", "CPU, ns", "more than without", "GPU, ns", "more than without", "pair, ns", "more than without",
             "without is", "B/contact", "B/pair"]
    shown = [k for k, head in enumerate(heads) if "without" not in head]    # a combination is over none
    alone = [r for r in cpu if r["over"] or r["name"] == "hooke"]
    several = [r for r in cpu if r not in alone]
    return "\n\n".join([told, table(alone, heads, cells), "Common combinations:",
                        table(several, [heads[k] for k in shown], lambda r: [cells(r)[k] for k in shown]), sums_of_costs(cpu, pairs)])


def sums_of_costs(cpu, pairs):
    """Why the parts of a law do not add up to the whole, by rolling and twisting at walls and between grains."""
    def added(rows):
        dry, rough, sds, marshall, mindlin = (find(rows, name=name) for name in ("dry grains", "rough grains", "rolling sds", "twisting marshall", "mindlin"))
        together = float(rough["min_ns"]) - float(dry["min_ns"])
        return (f"`rolling sds` adds {number(sds['over_ns'])} ns and `twisting marshall` {number(marshall['over_ns'])} to `tangential mindlin`, "
                f"both {number(together)} ({percent(together / float(dry['min_ns']))}) to `granular hertz, tsuji, mindlin`"), float(dry["min_ns"]) - float(mindlin["min_ns"])

    (wall, _), (pair, tsuji) = added(cpu), added(pairs)
    return ("**Rows do not add up**, because a compiled kernel has several sub-models of `granular` in it: the first that a law asks for costs most, the next little. "
            f"At a wall {wall}. Between grains {pair}: laws with a spring and `tsuji` or `viscoelastic`, and with no sub-model that few use, have faster loops of their own. Rows of one effect "
            f"have no damping, and take the loop for any law, so that `granular hertz, tsuji, mindlin` takes {number(abs(tsuji))} ns {'less' if tsuji < 0 else 'more'} "
            "than `tangential mindlin`, which has one part fewer.")


def costs_in_short(cpu, cuda):
    """The page's promise: what all but a tenth of the effects add at most."""
    def most(rows, digits):
        overs = sorted(float(r["over_ns"]) for r in rows if r["over"])
        return short(overs[math.ceil(0.9 * len(overs)) - 1], digits)
    return (f"nine of ten add at most {most(cpu, 2)} ns for each contact and step on a CPU core, and at most {most(cuda, 2)} ns on an H200"
            f"{'' if is_in_place(cuda) else ', copies included'}")


def costs_for_readme(cpu):
    """README's words for the same."""
    def over(name):
        return f"{float(find(cpu, name=name)['over_ns']):+.0f}"
    return (f"`hooke` {float(find(cpu, name='hooke')['min_ns']):.0f} ns a contact on a core; tangential spring {over('tangential spring')}, rolling (`sds`) {over('rolling sds')}, "
            f"stress map {over('loads of triangles')}, JKR {over('jkr')}")


def costs_of_bodies(rows):
    """What bodies and coats cost on a core."""
    of = {r["name"]: r for r in rows}

    def over(name):
        return float(of[name]["over_ns"])
    body, moves = (over(f"contact on a {mesh}") for mesh in ("body", "mesh that moves"))
    return (f"**A contact with a body costs {body - moves:.0f} ns more than one with a mesh that moves, and a body costs {over('step of a body') / 1e3:.2g} microseconds a step** on a core. "
            f"In this scene, of more meshes with fewer contacts than the table's, a contact with a mesh that moves takes {moves:.0f} ns more than one with a mesh at rest, and one with a "
            f"body {body:.0f}. A point of a *coat* costs {float(of['point of a coat that touches nothing']['min_ns']):.0f} ns while it touches nothing, and "
            f"{float(short(over('contact of a point of a coat'), 2)):.0f} ns more at a mesh")


# ---- accuracy.md, and what README says of it -----------------------------------------------

def tradeoff(mesh):
    """Rows of `./run bench tradeoff` by device, as far as it was measured there."""
    return {device: rows_of(f"tradeoff_{mesh}_{device}.csv") for device in DEVICES if (DATA / f"tradeoff_{mesh}_{device}.csv").exists()}


def place(device, rows):
    return "core" if device == "cpu" else rows[0]["device"].replace("CUDA, NVIDIA ", "")


def on_place(device, rows):
    return "one core" if device == "cpu" else f"an {place(device, rows)}"


def default_length(rows):
    return find(rows, default=1)["grid"]


def ns(row, name, digits=3):
    """The smallest of the runs."""
    return short(row[f"{name}_ns"], digits)


def ns_spread(row, name):
    """The smallest and the largest."""
    both = [number(row[f"{name}_{most}ns"]) for most in ("", "most_")]
    return " to ".join(dict.fromkeys(both))


def percent(share):
    return "none" if float(share) == 0 else f"{100 * float(share):.2g} %"


def error(value):
    value = float(value)
    return "0" if value < 1e-12 else f"{value:.0f}" if value >= 1 else f"{value:.1g}"


def how_long(a, b):
    """How the first time compares with the second, in words: within a tenth they are alike."""
    share = float(a) / float(b)
    if share > 1.1:
        return f"{share:.2g} times as long"
    return "as long" if share >= 0.9 else f"{100 * share:.0f} % of that time"


def setting_words(row):
    return "complete lists" if row["nearest"] == "all" else f"`nearest {row['nearest']}`"


def costs_of_settings(by_device, wanted, names):
    """A line for each setting, by the values of its columns, that was measured on every device: the smallest and the largest time."""
    def cells(line):
        name, values = line
        its = {device: find(rows, **values) for device, rows in by_device.items()}
        row = its["cpu"]
        return [name, percent(row["missed"]), error(row["force_mean"]), error(row["force_largest"]),
                *[ns_spread(r, what) for what in ("search", "step") for r in its.values()],
                f"{float(row['bytes']) / 1e6:.3g}", f"{float(row['kept_bytes']) / 1e6:.3g}"]

    heads = ["setting", "missed contacts", "force error, mean", "largest",
             *[f"{what}, {place(d, rows)}" for what in ("search", "step") for d, rows in by_device.items()], "grid, MB", "kept, MB"]
    lines = [(name, values) for name, values in zip(names, wanted) if all(find(rows, **values) for rows in by_device.values())]
    return table(lines, heads, cells)


NEAREST = ("8", "4", "3", "2", "1")


def settings(by_device):
    """What settings cost and miss in cells of the default length on a CPU."""
    grid = default_length(by_device["cpu"])
    base = dict(grid=grid, corner="blend", nearest="all")
    wanted = [base, {**base, "corner": "sum"}, *({**base, "nearest": n} for n in NEAREST)]
    names = ["**nothing** (the default)", "`corner sum`", *(f"`nearest {n}`" for n in NEAREST)]
    return costs_of_settings(by_device, wanted, names)


def other_cells(by_device):
    """The same with other cells, the largest first."""
    lengths = [g for g in dict.fromkeys(r["grid"] for r in by_device["cpu"]) if g != default_length(by_device["cpu"])]
    wanted, names = [], []
    for grid in sorted(lengths, key=float, reverse=True):
        for n in ("all", "8", "4", "2", "1"):
            wanted.append(dict(grid=grid, corner="blend", nearest=n))
            names.append(f"`grid {float(grid):g}`" + (f" `nearest {n}`" if n != "all" else ""))
    return costs_of_settings(by_device, wanted, names)


def drift(by_device):
    """Energy that spheres gain or lose, in cells of the default length on a CPU."""
    rows = by_device["cpu"]
    base = dict(grid=default_length(rows), corner="blend", nearest="all")
    lines = [("**nothing** (the default)", base), ("`corner sum`", {**base, "corner": "sum"}),
             *((f"`nearest {n}`", {**base, "nearest": n}) for n in NEAREST)]

    def cells(line):
        row = find(rows, **line[1])
        return [line[0], error(row["bounce_drift"]), error(row["roll_drift"])]

    return table(lines, ["setting", "bouncing", "rolling"], cells)


def pair_of(rows, grid):
    """The default's row and that of two triangles, in the same cells."""
    return (find(rows, grid=grid, corner="blend", nearest=n) for n in ("all", "2"))


def search_against_step(by_device):
    """What an exact search costs beside one of two triangles, and what the lists that a step keeps win."""
    grid = default_length(by_device["cpu"])
    said = []
    for device, rows in by_device.items():
        exact, two = pair_of(rows, grid)
        said.append(
            f"- **On {on_place(device, rows)}** a search that keeps nothing takes {ns(two, 'search')} ns a sphere with the two nearest triangles{'' if said else ' (the least of five runs, as all times here)'}; an exact "
            f"one takes {ns(exact, 'search')} ns, {how_long(exact['search_ns'], two['search_ns'])}. A step with two triangles, which searches again, takes "
            f"{ns(two, 'step')} ns; an exact one with the lists that the default keeps {ns(exact, 'step')} ns, {how_long(exact['step_ns'], two['step_ns'])}.")
    exact, two = pair_of(by_device["cpu"], grid)
    said.append(f"- **Two triangles miss** {percent(two['missed'])} of the contacts in cells of {float(grid):g} m, and forces are off by "
                f"{percent(two['force_mean'])} on average. The default misses none.")
    return "\n".join(said + [fastest_step(device, rows) for device, rows in by_device.items()])


def fastest_step(device, rows):
    """Which steps were faster than the default's in each of their runs."""
    default = find(rows, default=1)
    faster = sorted((r for r in rows if r["corner"] == default["corner"] and float(r["step_most_ns"]) < float(default["step_ns"])),
                    key=lambda r: float(r["step_ns"]))
    where = on_place(device, rows)
    if not faster:
        return f"- **The fastest step**: on {where} no setting is faster than the default in all of its runs."
    best = faster[0]
    return (f"- **The fastest step** on {where} is that of `grid {float(best['grid']):g}` and {setting_words(best)}: {ns(best, 'step')} ns, and "
            f"{ns(default, 'step')} ns with the default. It takes {float(best['bytes']) / 1e6:.3g} MB in place of {float(default['bytes']) / 1e6:.3g} "
            f"and misses {percent(best['missed']).replace('none', 'nothing')}.")


def kept_list(by_device):
    """How long the lists are that the default keeps."""
    default = find(by_device["cpu"], default=1)
    return (f"A list that the default keeps has {float(default['listed']):.2g} entries in the mean. All lists are made in {ns(default, 'choice')} ns a sphere; "
            "a step's time has its share of that")


def time_in_short(by_device):
    """README's words for the same."""
    grid = default_length(by_device["cpu"])
    exact, two = pair_of(by_device["cpu"], grid)
    said = [f"in a [vessel](examples/vessel) of {count(exact['triangles'])} triangles two triangles for each cell miss {percent(two['missed'])} of the contacts, "
            "the default none"]
    for device, rows in by_device.items():
        exact, two = pair_of(rows, grid)
        said.append(f"on {on_place(device, rows)} a search takes {ns(two, 'search')} ns a sphere with two, {ns(exact, 'search')} if it is exact, and a step "
                    f"{ns(two, 'step')} with two, {ns(exact, 'step')} with the exact lists that the default keeps")
    return "; ".join(said)


# ---- tables of paper.md ----------------------------------------------------------------------

def of_study(rows, name):
    return [r for r in rows if r["table"] == name and r["order"] == "random"]


def milliseconds(row):
    return number(row["query_ms"], 3 if float(row["query_ms"]) >= 100 else 2) if row else ""


def when(rows):
    """Where and when rows were measured; of several commits and days, all of them."""
    days = dict.fromkeys(f"{r['commit']}, {r['date']}" for r in rows)
    return f"{rows[0]['device'].replace('CUDA, ', '')} ({'; '.join(days)})"


def paper_table2(cpu, cuda):
    """The paper's Table 2 beside ours."""
    ours, on_gpu = (of_study(rows, "table2") for rows in (cpu, cuda))

    def cells(r):
        every = r["lists"] == "every triangle"
        card = find(on_gpu, length=r["length"], lists=r["lists"])
        return ["all, each tried" if every else "all that count" if r["lists"] == "complete" else r["lists"], r["length"],
                r["paper_accuracy"], f"{float(r['accuracy']):.6f}", short(r["paper_error_percent"], 3), short(r["error_percent"], 2),
                count(r["missed"]), number(r["paper_query_ms"]), milliseconds(r), milliseconds(card)]

    heads = ["triangles of a cell", "cell", "accuracy: paper", "ours", "error, %: paper", "ours", "ours missed", "ms: paper, K40", "ours, CPU", "ours, GPU"]
    one = ours[0]
    told = (f"* {count(one['spheres'])} spheres, of which {count(one['touching'])} touch; a cylinder of {count(one['triangles'])} triangles. "
            f"CPU: {when(ours)}. GPU: {when(on_gpu)}. The best accuracy, that of every triangle tried, is 0.994025 in the paper and {float(one['best']):.6f} here; "
            f"a program that never finds a contact has {float(one['never']):.6f}.")
    return table(sorted(ours, key=lambda r: (r["lists"] == "every triangle", r["lists"], float(r["length"]))), heads, cells) + "\n\n" + told


def paper_figures(cpu, cuda):
    """Figures 9 to 12 in numbers: the paper's, of its text and its Table 2, beside ours."""
    many, lengths = ({device: of_study(rows, name) for device, rows in (("cpu", cpu), ("cuda", cuda))} for name in ("figure9", "figure10"))

    def of_spheres(r):
        theirs, core = number(r["paper_query_ms"]), find(many["cpu"], spheres=r["spheres"])
        return [count(r["spheres"]), short(r["paper_accuracy"], 6), f"{float(r['accuracy']):.6f}", theirs, milliseconds(core), milliseconds(r)]

    def of_length(r):
        core, theirs = find(lengths["cpu"], length=r["length"]), find(of_study(cuda, "table2"), length=r["length"], lists="2")
        return [r["length"], short(r["paper_accuracy"], 6), f"{float(r['accuracy']):.6f}", short(r["paper_build_s"]), short(core["build_s"], 2),
                short(r["build_s"], 2), number(theirs["paper_query_ms"]) if theirs else "", milliseconds(core), milliseconds(r)]

    first = table(many["cuda"], ["spheres (figure 9)", "accuracy: paper", "ours", "ms: paper, K40", "ours, CPU", "ours, GPU"], of_spheres)
    second = table(lengths["cuda"], ["cell (figures 10 to 12)", "accuracy: paper", "ours", "grid, s: paper, K40 and GTX480", "ours, CPU", "ours, GPU",
                                     "ms: paper, K40", "ours, CPU", "ours, GPU"], of_length)
    told = f"* CPU: {when(many['cpu'] + lengths['cpu'])}. GPU: {when(many['cuda'] + lengths['cuda'])}."
    return f"{first}\n\n{second}\n\n{told}"


def paper_formula5(rows):
    """What the paper's formula (5) makes of contacts, on meshes with and without obtuse triangles, which the note names."""
    its = [r for r in of_study(rows, "formula5") if r["inside"] == "formula (5)"]

    def cells(name):
        two, every = (find(its, note=name, lists=lists) for lists in ("2", "every triangle"))
        return [name.replace(", formula (5)", "").replace("cylinder, ", ""), count(two["touching"]),
                *[count(r[what]) for r in (two, every) for what in ("missed", "false")]]

    heads = ["mesh", "contacts", "two triangles: missed", "found where there is none", "each triangle tried: missed", "found where there is none"]
    return table(dict.fromkeys(r["note"] for r in its), heads, cells) + f"\n\n* {count(its[0]['spheres'])} spheres, {when(its)}."


def of_radius(row):
    """The length of a cell of a trade-off."""
    return f"{float(row['grid']) / float(row['largest_radius']):.2g} R"


def paper_misses(cuda, vessel):
    """Of the contacts that an exact search finds, how many N triangles miss: on the paper's cylinder, on finer ones, and on a vessel; and the time of
    the exact search over that of two triangles."""
    def share(missed, n):
        return "none" if missed == 0 else f"{missed} of {count(n)}" if missed < 100 else f"{100 * missed / int(n):.2g} %"

    kinds = ("1", "2", "3", "8")
    lines, radius = [], float(of_study(cuda, "mesh")[0]["largest_radius"])
    for table_name, length in (("table2", "0.2"), ("mesh", "0.4")):
        rows = [r for r in of_study(cuda, table_name) if r["length"] == length]
        for triangles in dict.fromkeys(r["triangles"] for r in rows):
            its = {r["lists"]: r for r in rows if r["triangles"] == triangles}
            every = its["complete"]
            name = "the paper's cylinder" if int(triangles) < 1000 else "a cylinder"
            lines.append([f"{name}, cells of {float(length) / radius:.2g} R", count(triangles),
                          *[share(int(its[n]["missed"]), its[n]["touching"]) if n in its else "" for n in kinds], milliseconds(its["2"]), milliseconds(every)])
    for grid in sorted({r["grid"] for r in vessel}, key=float):
        its = {n: find(vessel, grid=grid, corner="blend", nearest=n) for n in kinds}
        lines.append([f"a [vessel](../examples/vessel), cells of {of_radius(its['1'])}", count(its["1"]["triangles"]),
                      *[share(round(float(r["missed"]) * int(r["contacts"])), r["contacts"]) for r in its.values()], *["[accuracy](accuracy.md)"] * 2])
    heads = ["wall", "triangles", *[f"missed with {n}" for n in kinds], "search, ms: 2", "all"]
    mesh = of_study(cuda, "table2") + of_study(cuda, "mesh")
    return table(lines, heads, lambda line: line) + f"\n\n* R is the largest radius. {count(mesh[0]['spheres'])} spheres at the cylinders, {when(mesh)}."


def two_triangles(cuda, vessel):
    """README's sentence on what the paper's default misses."""
    of_paper = find(of_study(cuda, "table2"), length="0.2", lists="2")
    fine, *_, coarse = sorted((r for r in vessel if r["corner"] == "blend" and r["nearest"] == "2"), key=lambda r: float(r["grid"]))
    missed = [f"{100 * float(r['missed']):.2g} % in cells of {of_radius(r)}" for r in (fine, coarse)]
    return (f"The paper's default is two triangles a cell (`nearest 2`). On its own cylinder of {count(of_paper['triangles'])} triangles they miss {of_paper['missed']} of "
            f"{count(of_paper['touching'])} contacts;\non a [vessel](examples/vessel) of {count(fine['triangles'])} triangles and grains of the radius R they miss {missed[0]}, and {missed[1]} "
            "([more](doc/paper.md#what-two-triangles-miss)).\nLSDCD's default misses none.")


# ---- tables of validation.md ---------------------------------------------------------------

WALLS = ("LAMMPS", "two", "slivers")


def validation_rows(name="validation_cpu.tsv"):
    lines = (DATA / name).read_text().splitlines()
    return list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t"))


def validation_cases(rows):
    """A table for each case, and under it where its numbers are from and why its tolerances are what they are, by letters."""
    made = []
    for title in dict.fromkeys(r["title"] for r in rows):
        its = [r for r in rows if r["title"] == title]
        notes = {}
        for r in its:
            notes.setdefault((r["source"], r["reason"]), chr(ord("a") + len(notes)))

        def cells(r):
            unit = "" if r["unit"] == "1" else " " + r["unit"]
            seen = {w: f"{float(r[w]):.6g}" for w in WALLS if r[w]}
            values = next(iter(seen.values())) if len(set(seen.values())) == 1 else "; ".join(f"{w} {v}" for w, v in seen.items())
            return [r["quantity"], f"{float(r['expected']):.6g}{unit}", values, ", ".join(seen), r["deviation"], f"{r['tolerance']} ({notes[r['source'], r['reason']]})"]

        told = [f"- ({letter}) Expected: {source}. Tolerance: {reason}." for (source, reason), letter in notes.items()]
        made.append(f"### {title}\n\n" + table(its, ["quantity", "expected", "seen", "walls", "deviation", "tolerance"], cells) + "\n\n" + "\n".join(told))
    return "\n\n".join(made)


def validation_others(rows):
    """What LIGGGHTS and Yade see in three of the cases."""
    def cells(r):
        told = []
        for code in ("LIGGGHTS", "Yade"):
            seen = {w: f"{float(r[f'{code}, {w}']):.6g}" for w in ("plane", "two", "slivers")}
            told.append(seen["plane"] if len(set(seen.values())) == 1 else "; ".join(f"{w} {v}" for w, v in seen.items()))
        return [r["case"].partition(" (")[2].rstrip(")"), r["quantity"], f"{float(r['expected']):.6g}{'' if r['unit'] == '1' else ' ' + r['unit']}", f"{float(r['LSDCD']):.6g}", *told]
    return table(rows, ["case", "quantity", "expected", "LSDCD", "LIGGGHTS 3.8", "Yade 2023.02a"], cells)


def validation_plate(rows):
    """Forces on a plate over depth: mean and spread of packings, and how far cuts of its mesh are apart."""
    by = {}
    for r in rows:
        forces = [float(r["tip"]), float(r["shaft"])]
        by.setdefault(float(r["depth"]), {}).setdefault(r["cut"], []).append([*forces, sum(forces)])

    def cells(depth):
        cuts = [list(zip(*packings)) for packings in by[depth].values()]    # cut, part, packing
        told = [f"{statistics.fmean(values):.3g} ± {statistics.stdev(values):.2g}" for values in cuts[0]]
        apart = max(abs(a - b) for each in zip(*cuts) for values in zip(*each) for a in values for b in values)
        return [f"{1000 * depth:g}", *told, f"{apart:.2g}" if apart else "same digits"]
    return table(list(by), ["depth, mm", "tip, N", "shaft, N", "both, N", "cuts differ by, N"], cells)


def validation_lammps(rows):
    """LAMMPS's own tests with LAMMPS's styles and with ours, and under the table why those that do not pass do not."""
    notes = {}

    def cells(r):
        passes = r["passes"]
        if r["why"]:
            passes += f" ({notes.setdefault(r['why'], chr(ord('a') + len(notes)))})"
        form = [r["form"].replace("_", " "), r["off_form"], r["form_tolerance"]]
        return [r["test"], r["ours"], r["LAMMPS"], r["two"], r["slivers"], r["tolerance"], passes, *form]

    made = table(rows, ["test", "ours in it", "LAMMPS", "two", "slivers", "tolerance", "passes", "closed form", "off by", "of"], cells)
    return made + "\n\n" + "\n".join(f"- ({letter}) {why[0].upper()}{why[1:]}." for why, letter in notes.items())


def validation_lammps_in_short(rows):
    """The page's sentence on LAMMPS's own tests."""
    count = {word: sum(r["passes"] == word for r in rows) for word in dict.fromkeys(r["passes"] for r in rows)}
    ours = [r for r in rows if r["ours"]]
    return (f"Of {len(rows)} files {len(ours)} have a contact for our styles. With these {count['yes']} pass as they are, {count['but for rounding']} but for numbers as small as a "
            f"rounding, {count['its closed form']} by its closed form alone, and {sum(r['nudged'] != '' for r in rows)} does not pass")


def validation_in_short(rows):
    """The page's sentence on what holds."""
    cases, meshes = {r["case"] for r in rows}, [r for r in rows if r["two"] and r["slivers"]]
    apart = [r for r in meshes if r["two"] != r["slivers"]]
    return (f"{len(rows)} numbers of {len(cases)} cases, of which {sum(r['holds'] == 'yes' for r in rows)} are within their tolerance. {len(meshes)} were seen with two triangles and with "
            f"slivers, {len(meshes) - len(apart)} of them with the same digits")


def validation_promise(rows):
    """README's words for the same."""
    return f"{len(rows)} numbers of {len({r['case'] for r in rows})} cases against closed forms, others' curves and an experiment"


# ---- pages ---------------------------------------------------------------------------------

def tables():
    """Page: name of the markers: table."""
    cpu, cuda = (rows_of(f"performance_{device}.csv") for device in DEVICES)
    kokkos_cpu, kokkos_cuda = (rows_of(f"kokkos_{device}.csv") for device in DEVICES)
    study_cpu, study_cuda = (rows_of(f"accuracy_{device}.csv") for device in DEVICES)
    vessel = tradeoff("vessel")
    effects = [rows_of(f"effects_{device}.csv", ";") for device in DEVICES]
    cores = core_rows()
    beds = [r for r in cores if r["bed"] in CORE_CASES]
    return {
        "performance.md": {"hours": hours(kokkos_cpu, kokkos_cuda), "cost": cost(kokkos_cuda + kokkos_cpu), "set-up": set_up(cpu, cuda),
                           "cores": cores_times(beds), "cores-tried": cores_tried(beds), "cores-growth": cores_growth(beds),
                           "cores-wide": cores_wide(cores)},
        "notes/performance.md": {"scale": scale(rows_of("scale_cuda.csv")), "liggghts": liggghts(rows_of("liggghts_cpu.csv"))},
        "notes/accuracy.md": {"floor": f"{float(effects[0][0]['min_ns']):.0f} ns"},
        "library-queries.md": {"point-costs": point_costs(cpu)},
        "effects.md": {"costs-short": costs_in_short(*effects), "costs": costs(*effects, rows_of("effects_pairs_cpu.csv", ";")),
                       "bodies": costs_of_bodies(rows_of("effects_bodies_cpu.csv", ";"))},
        "accuracy.md": {"against-time": search_against_step(vessel), "settings": settings(vessel), "cells": other_cells(vessel),
                        "kept": kept_list(vessel), "drift": drift(vessel), "paper": settings(tradeoff("paper"))},
        "paper.md": {"misses": paper_misses(study_cuda, vessel["cpu"]), "table-2": paper_table2(study_cpu, study_cuda),
                     "figures": paper_figures(study_cpu, study_cuda), "formula-5": paper_formula5(study_cpu)},
        "validation.md": {"validation-short": validation_in_short(validation_rows()), "validation": validation_cases(validation_rows()),
                          "validation-minutes": validation_cases(validation_rows("validation_minutes_cpu.tsv")),
                          "validation-host": validation_cases(validation_rows("validation_host_cpu.tsv")),
                          "validation-plate": validation_plate(rows_of("validation_plate_cpu.csv")),
                          "validation-lammps-short": validation_lammps_in_short(validation_rows("validation_lammps_yaml.tsv")),
                          "validation-lammps": validation_lammps(validation_rows("validation_lammps_yaml.tsv")),
                          "validation-others": validation_others(validation_rows("validation_others.tsv"))},
        "../README.md": {"two-triangles": two_triangles(study_cuda, vessel["cpu"]), "accuracy-time": time_in_short(vessel),
                         "validation-promise": validation_promise(validation_rows()), "effects-short": costs_for_readme(effects[0])},
    }


def replaced(text, name, made):
    """The text of a page with this table between its markers, or these words where both markers stand in one line."""
    begin, end = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
    if begin not in text or end not in text:
        raise SystemExit(f"a page lacks the markers {begin} and {end}")
    before, _, rest = text.partition(begin)
    old, _, after = rest.partition(end)
    return before + begin + (f"\n{made}\n" if old.startswith("\n") else made) + end + after


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
        import plots
        plots.draw_all()
    return 1 if args.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
