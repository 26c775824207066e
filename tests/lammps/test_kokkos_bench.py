# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The beds of bench/kokkos.py: what is timed with the wall and without begins in one state,
in the order in memory that its name says, and Kokkos's copies are counted."""

import contextlib
import io
import random
import statistics
import sys

import pytest

import lmp
from facts import fact

sys.path.insert(0, str(lmp.HERE.parent.parent / "bench"))
import kokkos    # noqa: E402
import kokkos_runs as runs    # noqa: E402
from kokkos_beds import Bed    # noqa: E402
from pages import LEFT_OUT, cost, scaling    # noqa: E402
from rows import facts    # noqa: E402

pytestmark = lmp.needs_host
ATOMS = 4000
DUMP = """\
dump            start all custom 1 {file} id x y z vx vy vz
dump_modify     start format float %.17g sort off
run             0
undump          start
"""


def memory(path):
    """Rows of a dump as they come: id, place, velocity."""
    return [tuple(map(float, line.split())) for line in path.read_text().splitlines()[9:]]


def typical_distance(pairs):
    return statistics.median(sum((p - q)**2 for p, q in zip(u[1:4], w[1:4]))**0.5 for u, w in pairs)


@pytest.fixture(scope="module")
def host():
    return runs.Host(lmp.HOST, lmp.PLUGIN, "-k on -sf kk", "mpirun -np {ranks}")


@pytest.mark.parametrize("name", kokkos.CASES)
def test_states(host, folder, name):
    bed = Bed(name, ATOMS, 1, folder, million=2000)
    runs.prepare(host, bed, folder, settle=80)
    rows = {}
    for order in ("random", "sorted"):
        for wall in (bed.wall(), ""):
            text = runs.timed_script(host, bed, order, wall, 10, 1)
            at = text.index("thermo_style")
            host.run_well(text[:at] + DUMP.format(file="start.dump") + text[at:], folder)
            rows[order, bool(wall)] = memory(folder / "start.dump")
    fact(f"{name}: as many atoms as asked", len(rows["random", True]) == ATOMS)
    first = sorted(rows["random", True])
    fact(f"{name}: one state, with the wall and without, in both orders",
         all(sorted(r) == first for r in rows.values()))
    for order in ("random", "sorted"):
        fact(f"{name}, {order}: one order with the wall and without",
             rows[order, True] == rows[order, False])
    rng = random.Random(7)
    some = rows["random", True]
    apart = typical_distance([(rng.choice(some), rng.choice(some)) for _ in range(ATOMS)])
    for order, least, most in (("random", 0.9, 1.1), ("sorted", 0.0, 0.4)):
        seen = typical_distance(zip(rows[order, True], rows[order, True][1:])) / apart
        fact(f"{name}, {order}: neighbours in memory are {least} to {most} as far apart as "
             "any two", least <= seen <= most, f"{seen:.2f}")


def test_rows_of_all(host, folder):
    options = kokkos.read_options(
        ["--atoms", str(ATOMS), "--triangles", "2000", "--settle", "80", "--steps", "30",
         "--chunks", "2", "--rounds", "1", "--against", "--copies", "--bodies", "--ranks", "1 2", "--orders",
         "sorted"])
    with contextlib.redirect_stderr(io.StringIO()):
        rows = kokkos.measure(host, options, folder / "work")
    find = {(r["case"], facts(r)["ranks"]): r for r in rows}
    fact("rows of each bed, with and without, on 1 and 2 processes", all(
        (case + more, ranks) in find for case in kokkos.CASES.values()
        for more in ("", ", no wall", ", copies", ", no wall, copies") for ranks in "12"))
    fact("and of the closed box as a body, and of its floor", all(
        ("closed box" + meshes + what, "1") in find for meshes in ("", ", two meshes")
        for what in (", at rest", ", moves", ", body")))
    flat, none = find["flat floor", "1"], find["flat floor, no wall", "1"]
    fact("as many builds with the wall as without",
         facts(flat)["builds"] == facts(none)["builds"], facts(flat)["builds"])
    fact("steps and lists are those of the timed runs", facts(flat)["wall_steps"] == "62" and
         2 <= int(facts(flat)["lists"]) <= 6, f"{flat['facts']}")
    fact("LAMMPS's wall is timed on the flat floor", float(find["flat floor, wall/gran", "1"]
                                                             ["median_ms"]) > 0)
    there = find["flat floor, wall/gran/kk", "1"]
    fact("and wall/gran/kk, or a row that says why not",
         bool(there["median_ms"]) == host.flat_kk or facts(there)["result"] == "aborts")
    copies = facts(find["flat floor, copies", "1"])
    fact("copies are seen, none of them between host and device",
         int(copies["seen"]) > 0 and copies["copies"] == "0" and copies["bytes"] == "0",
         copies["seen"])
    fact("of every step but those that warm up and the last",
         int(copies["steps"]) + int(copies["list_steps"]) == 29, copies["steps"])
    without = facts(find["flat floor, no wall, copies", "1"])
    fact("the integrator joins as many steps with the wall as without",
         copies["fused"] == without["fused"], copies["fused"])
    ratio = float(flat["median_ms"]) / float(none["median_ms"])
    table = cost(rows).splitlines()
    fact("the table has what the wall adds, in per cent", any(f"| {100 * (ratio - 1):.1f} |" in line for line in table), table[2])
    fact("and a row for each bed that was run, but for those that it leaves out",
         sum(line.startswith("| CPU") for line in table) == len(kokkos.CASES) - len(LEFT_OUT), str(len(table)))
    fact("scaling has a row for each bed",
         scaling(rows).count("\n") == 1 + len(kokkos.CASES))
