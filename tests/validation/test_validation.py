# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The cases of ./run validate: each number is within its tolerance, the same at both cuts of a plane to the bit, and that of doc/validation.md.
For cases of minutes
LSDCD_VALIDATION_WALL is the only wall to run at, and with LSDCD_QUICK a case may have some of its numbers."""

import os

import pytest

import lmp
import suite
from cases import CASES
from facts import at_most, fact

ONLY = os.environ.get("LSDCD_VALIDATION_WALL")


@pytest.mark.parametrize("name", CASES)
def test_case(name, folder):
    if not CASES[name].runs_here():
        pytest.skip("fix heat/flow is of LAMMPS 2Aug2023")
    kept = {row["quantity"]: row for row in suite.kept_rows() if row["case"] == name}
    rows = suite.run_case(name, folder, ONLY)
    seen = [r.quantity for r in rows]
    some = lmp.QUICK and CASES[name].takes == suite.MINUTES
    fact("the page has these numbers", seen and [q for q in kept if q in seen or not some] == seen, f"{set(kept) ^ set(seen)}; ./run validate --keep")
    for r in rows:
        for wall in r.seen:
            at_most(f"{r.quantity}, {wall}: {r.seen[wall]:.9g} is {r.expected:.9g}", r.deviation(wall), r.tolerance)
        fact(f"{r.quantity}: the same bits at two triangles and at slivers", r.same_at_both_cuts(), r.seen)
        if r.quantity in kept:
            compare(r, kept[r.quantity])


def compare(row, kept):
    """States that the page has what a run sees, to 1e-6 or half of the tolerance: other processors and versions of LAMMPS round otherwise.
    Beds grow round-off: theirs are as near as the tolerance."""
    limit = row.tolerance * (1 if row.absolute else abs(row.expected))
    near = limit if CASES[row.case].takes == suite.MINUTES else max(0.5 * limit, 1e-6 * abs(row.expected))
    words = {w: kept[w] for w in suite.AT_WALLS if kept[w] and ONLY in (None, w)}
    fact(f"{row.quantity}: the page has the same walls", words.keys() == row.seen.keys(), f"{list(words)}, {list(row.seen)}")
    for name, value in {**words, "expected": kept["expected"]}.items():
        now = row.expected if name == "expected" else row.seen.get(name, row.expected)
        at_most(f"{row.quantity}, {name}: the page has {value}, a run {now:.9g}", abs(float(value) - now), near)
    told = float(kept["tolerance"])
    at_most(f"{row.quantity}: the page's tolerance", abs(told - row.tolerance), 0.06 * told)


def test_all_rows_of_the_page():
    cases = list(dict.fromkeys(row["case"] for row in suite.kept_rows()))
    fact("the page has all cases and no other", cases == list(CASES), f"{cases}")
    fact("all of its numbers hold", all(row["holds"] == "yes" for row in suite.kept_rows()))
