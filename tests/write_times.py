#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Writes where the minutes of the last `./run test all` went into doc/notes/times.md.

usage: write_times.py

Reads what that left in build/: seconds of its stages (times.txt) and of each test (junit.xml).
"""
import collections
import os
import pathlib
import re
import subprocess
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "doc" / "notes" / "times.md"
BEGIN, END = "<!-- times:begin -->", "<!-- times:end -->"
FOLDERS = {"all": "release", "sanitize": "sanitizers"}
# The first pattern that matches the name of a test names its row.
TESTS = [("demo on trixie and sid", r"lammps\.demo_"), ("Debian packages", r"package|lammps\.compile_hosts"),
         ("`/kk`", r"lammps\.kokkos_"), ("input scripts and examples", r"lammps\."), ("the tool", r"tool\."),
         ("the library", r"library"), ("benchmarks", r"bench\."), ("CGAL", r"cgal|bad_meshes"), ("unit and physics", r".")]


def row_of(name, rows):
    return next((row for row, pattern in rows if re.search(pattern, name)), None)


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "| " + " | ".join("---" for _ in heads) + " |"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def tests_of(folder):
    """[(seconds, name)] of the tests that ran."""
    path = ROOT / "build" / folder / "junit.xml"
    if not path.exists():
        return []
    return [(float(case.get("time")), case.get("name")) for case in xml.parse(path).iter("testcase")
            if case.get("status") in ("run", "fail")]


def groups(rows):
    """One row of a table for each of `rows`: its name, and in each folder how many tests and their seconds."""
    sums = collections.defaultdict(lambda: [0, 0.0])
    for folder in FOLDERS:
        for seconds, name in tests_of(folder):
            key = row_of(name, rows)
            if key:
                sums[key, folder][0] += 1
                sums[key, folder][1] += seconds
    for row, _ in rows:
        cells = [f"{sums[row, f][0]}, {sums[row, f][1]:.0f} s" if sums[row, f][0] else "" for f in FOLDERS]
        if any(cells):
            yield [row, *cells]


def main():
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], stdout=subprocess.PIPE, text=True,
                            check=True).stdout.strip()
    stages = [line.rsplit(None, 2)[:2] for line in (ROOT / "build" / "times.txt").read_text().splitlines()]
    slowest = sorted((seconds, name, FOLDERS[f]) for f in FOLDERS for seconds, name in tests_of(f))[:-11:-1]
    text = "\n\n".join([
        BEGIN, f"`./run test all` at {commit} on {os.cpu_count()} cores; written by `tests/write_times.py`.",
        table(["stage", "seconds"], stages),
        "Tests, and the sum of their seconds with others beside them:",
        table(["tests", *FOLDERS.values()], groups(TESTS)),
        "The slowest tests:",
        table(["test", "seconds", "build"], [(f"`{name}`", f"{seconds:.0f}", of) for seconds, name, of in slowest]), END])
    page = DOCUMENT.read_text()
    begin, end = page.index(BEGIN), page.index(END) + len(END)
    part = DOCUMENT.with_suffix(".part")
    part.write_text(page[:begin] + text + page[end:])
    part.replace(DOCUMENT)


if __name__ == "__main__":
    main()
