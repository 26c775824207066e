#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs validation cases (doc/validation.md) and prints what they saw beside what is expected, with the tolerance and its reason.

usage: validate.py [--list] [--minutes] [--keep] [--tsv] [--jobs N] [--commit NAME] [CASE ...]

Without names it runs the cases of seconds, or with --minutes those of minutes, and in a LAMMPS of 2Aug2023 or later those of heat, too. --keep also puts the rows into doc/data and the
table into the page; of named cases these rows alone. It ends with 1 if a number is out of its tolerance, or if two cuts of a plane give other bits. LSDCD_LMP names another lmp-lsdcd than that of
build/; LSDCD_ON_HOST, LSDCD_HOST and the others of tests/lammps/lmp.py another LAMMPS, as one with Kokkos.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "lammps"), str(HERE.parent.parent / "bench")]

import rows as bench_rows
from cases import CASES
from impacts import curves
from suite import AT_WALLS, BED_CURVES, CURVES, KEPT, MINUTES, SECONDS, Point, as_table, run_case


def measure(name):
    """The rows of a case, the points of its curves, and the seconds that it took."""
    begin, points = time.monotonic(), []
    with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
        return run_case(name, pathlib.Path(folder), points=points), points, time.monotonic() - begin


def said_of(row):
    seen = {f"{row.seen[w]:.7g}" for w in row.seen}
    values = seen.pop() if len(seen) == 1 else ", ".join(f"{w} {row.seen[w]:.7g}" for w in AT_WALLS if w in row.seen)
    verdict = "ok" if row.holds() and row.same_at_both_cuts() else "OUT" if not row.holds() else "CUTS DIFFER"
    return [verdict, row.quantity, f"{row.expected:.7g} {'' if row.unit == '1' else row.unit}".strip(), values, f"{row.largest_deviation():.1e}",
            f"{row.tolerance:.1e}"]


def show(case, rows, seconds):
    """Prints the table of a case, and below it where numbers are from and why a tolerance is what it is."""
    walls = [w for w in AT_WALLS if w in case.walls]
    print(f"\n{case.name}: {case.title} ({', '.join(walls)}; {seconds:.1f} s)")
    lines = [["", "quantity", "expected", "seen", "deviation", "tolerance"], *map(said_of, rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    for line in lines:
        print("  " + "  ".join(word.ljust(width) for word, width in zip(line, widths)).rstrip())
    for what, words in (("expected", dict.fromkeys(r.source for r in rows)), ("tolerance", dict.fromkeys(r.reason for r in rows))):
        for each in words:
            print(f"  {what}: {each}")


def keep(rows, points, names, commit):
    """Puts the rows of these cases into doc/data, with the curves of those that have some, and the tables into the page."""
    for takes, path in KEPT.items():
        all_names = [case.name for case in CASES.values() if case.takes == takes]
        its = [name for name in all_names if name in names]
        if not its:
            continue
        columns, *new = as_table([r for r in rows if r.case in its]).splitlines()
        old = [] if its == all_names or not path.exists() else path.read_text().splitlines()
        measured = f"# commit {commit}, {bench_rows.cpu()}" if not old else f"{old[0]}, {', '.join(its)} at {commit}"
        lines = [line for line in old[2:] if line.split("\t")[0] not in its] + new
        lines.sort(key=lambda line: all_names.index(line.split("\t")[0]))
        path.write_text("\n".join([measured, columns, *lines]) + "\n")
        if takes == SECONDS:
            with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
                keep_points(CURVES, [Point(*point) for point in curves(pathlib.Path(folder))], commit)
    if points:
        keep_points(BED_CURVES, points, commit)
    subprocess.run([sys.executable, str(HERE.parent.parent / "bench" / "pages.py")], check=True)


def keep_points(path, points, commit):
    """Puts these points into the file, in place of those that it has of the same curves."""
    own = {p.curve for p in points}
    old = [row for row in csv.DictReader(path.read_text().splitlines()) if row["curve"] not in own] if path.exists() else []
    path.write_text(bench_rows.as_csv(old + [dict(curve=p.curve, x=f"{p.x:g}", value=f"{p.value:.6g}", commit=commit) for p in points]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="print names and titles of the cases")
    parser.add_argument("--minutes", action="store_true", help="run the cases that take minutes")
    parser.add_argument("--keep", action="store_true", help="put the rows into doc/data, and the table into doc/validation.md")
    parser.add_argument("--tsv", action="store_true", help="print rows as doc/data has them")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many cases at once")
    parser.add_argument("--commit", default=bench_rows.commit())
    parser.add_argument("names", nargs="*", metavar="CASE")
    args = parser.parse_args()
    if args.list:
        print("\n".join(f"{case.name:16} {case.takes:8} {case.title}" for case in CASES.values()))
        return 0
    unknown = [name for name in args.names if name not in CASES]
    if unknown:
        parser.error(f"no case '{unknown[0]}'; --list names them")
    begin, rows, points, bad = time.monotonic(), [], [], 0
    with concurrent.futures.ProcessPoolExecutor(args.jobs) as pool:
        names = args.names or [case.name for case in CASES.values() if (case.takes == MINUTES) == args.minutes and case.runs_here()]
        for name, (its, curve, seconds) in zip(names, pool.map(measure, names)):
            rows += its
            points += curve
            bad += sum(not (r.holds() and r.same_at_both_cuts()) for r in its)
            if not args.tsv:
                show(CASES[name], its, seconds)
    if args.tsv:
        print(as_table(rows), end="")
    else:
        print(f"\n{len(rows)} numbers of {len(names)} cases: {bad or 'none'} out of tolerance or other at another cut ({time.monotonic() - begin:.0f} s)")
    if args.keep:
        keep(rows, points, names, args.commit)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
