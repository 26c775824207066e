# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Rows and tables of kokkos.py."""
import os
import pathlib
import re

import performance
from effects import table
from hard_cases import write_whole
from performance import as_csv, count, facts, ms

CASES = {"flat": "flat floor", "box": "closed box", "checked": "closed box, check yes",
         "granular": "closed box, granular", "million": "bumpy floor"}
LEFT_OUT = ("closed box, check yes",)    # of the table for users: the bed is there with the default
MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
ORDERS = ("random", "sorted")
COPIES = ", copies"
NO_WALL = ", no wall"


# ---- rows --------------------------------------------------------------------------------

def kept(device, folder):
    return os.path.join(folder, f"kokkos_{device}.csv")


def read_rows(device, folder=performance.DATA):
    path = kept(device, folder)
    return performance.parse(pathlib.Path(path).read_text()) if os.path.exists(path) else []


def key(row):
    return (*performance.key(row), facts(row)["host"], facts(row)["ranks"])


def keep(rows, device, folder):
    """A row takes the place of the one under its key."""
    fresh = {key(r): r for r in rows}
    old = [fresh.pop(key(r), r) for r in read_rows(device, folder)]
    write_whole(kept(device, folder), as_csv(old + list(fresh.values())))


# ---- tables ------------------------------------------------------------------------------

def find(rows, **wanted):
    for row in rows:
        if all(str({**row, **facts(row)}.get(k, "")) == str(v) for k, v in wanted.items()):
            return row
    return None


def ratio_of(a, b):
    return float(a["median_ms"]) / float(b["median_ms"])


def beside(rows, row, more):
    """The row of the same bed with another wall, or without."""
    return find(rows, case=row["case"] + more, triangles=row["triangles"], spheres=row["spheres"],
                order=row["order"], host=facts(row)["host"], ranks=facts(row)["ranks"])


def walls(rows):
    return [r for r in rows if r["case"] in CASES.values()]


def cost_table(on_cpu, on_gpu):
    """What the wall adds to a step, in per cent: a line for each bed and its size. Of several LAMMPS the newest that was
    timed in sorted order, and those in which LAMMPS's own wall was timed on the GPU."""
    rows = on_gpu + on_cpu
    beds = {}
    for r in walls(rows):
        if facts(r)["ranks"] == "1":
            beds.setdefault((r["device"], r["case"], r["triangles"], r["spheres"], facts(r)["host"]), {})[r["order"]] = r

    def added(r, more=""):
        with_wall = beside(rows, r, more) if r and more else r
        if not with_wall or not with_wall["median_ms"]:
            return ""
        return f"{100 * (ratio_of(with_wall, beside(rows, r, NO_WALL)) - 1):.1f}"

    def day(bed):
        number = re.match(r"(\d+)([A-Z][a-z]+)(\d+)", bed[4]).groups()
        return int(number[2]), MONTHS.index(number[1]), int(number[0])

    newest = {}
    for bed in sorted((b for b in beds if "sorted" in beds[b]), key=day):
        newest[bed[:4]] = bed
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


def scaling_table(rows):
    mine = []
    for r in walls(rows):
        f, ranks = facts(r), int(facts(r)["ranks"])
        one = find(rows, case=r["case"], triangles=r["triangles"], order=r["order"],
                   spheres=int(r["spheres"]) // ranks, host=f["host"], ranks=1)
        if ranks > 1 and one:
            mine.append((r, one))
    if not mine:
        return "No rows are kept yet."

    def cells(pair):
        r, one = pair
        without, one_without = (beside(rows, x, NO_WALL) for x in pair)
        with_wall, no_wall = ratio_of(one, r), ratio_of(one_without, without)
        return [r["case"], count(one["spheres"]), facts(r)["ranks"], r["order"], r["device"],
                facts(r)["host"], ms(r), ms(without), f"{with_wall:.2f}", f"{no_wall:.2f}",
                f"{with_wall / no_wall:.3f}"]

    heads = ["bed", "atoms per process", "processes", "order", "device", "LAMMPS",
             "with the wall, ms", "without, ms", "efficiency with", "without", "ratio"]
    return table(mine, heads, cells)


def parts(on_cpu, on_gpu):
    """The generated parts of the document, with their markers."""
    text = {"cost": cost_table(on_cpu, on_gpu),
            "kokkos-scaling": scaling_table(on_gpu)}
    return performance.between_markers(text)


def write_document(folder=performance.DATA):
    performance.write_parts(parts(read_rows("cpu", folder), read_rows("cuda", folder)))
