#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Keeps which tests passed on a GPU, as CI has none: doc/data/gpu_tests.csv.

    gpu_record.py --build FOLDER [--commit NAME] [words of ctest]
                     runs the tests that need a GPU (labels cuda and gpu) of a build folder there, and puts a row for each
                     into the record in place of its former one; so they may run in parts, as by -R '^test_' or -E kokkos
    gpu_record.py --check
                     whether all rows say that the test passed or was skipped, and whether the sources that a GPU
                     compiles, as they are at HEAD, are those of each row's commit

A row has the test, what it gave (passed, skipped: why, failed), its seconds, the commit, the date, and the card. Without git
the commit has to be named. RELEASING.md says when.
"""
import argparse
import csv
import datetime
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = ROOT / "doc/data/gpu_tests.csv"
COLUMNS = ("test", "result", "seconds", "commit", "date", "card")
LABELS = "^(cuda|gpu)$"
# What ctest prints when a test has ended: its name, how it ended, its seconds.
ENDED = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) [ .]*\**(\w[\w ]*?) +([\d.]+) sec")


def rows_of(path):
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        return {row["test"]: row for row in csv.DictReader(file)}


def write(path, rows):
    with path.open("w", encoding="utf-8", newline="") as file:
        out = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        out.writeheader()
        out.writerows(rows[test] for test in sorted(rows))


def result_of(case):
    """What ctest's report says of a test; of a skipped one with what it printed as the reason. What was not built has failed."""
    if case.get("status") == "run":
        return "passed"
    skipped = case.find("skipped")
    if skipped is None or "executable" in skipped.get("message", ""):
        return "failed" if skipped is None else "failed: its program is not built"
    why = re.findall(r"(?:^SKIPPED \[\d+\] \S+|^skipped:) (.*)", case.findtext("system-out") or "", re.M)
    return f"skipped: {why[-1] if why else skipped.get('message', '')}"


def run_tests(build, commit, words):
    """Runs the tests, and writes the record as each ends: a machine that is taken away takes no results along."""
    card = subprocess.run(["nvidia-smi", "--query-gpu=name", "--format=csv,noheader"], text=True, stdout=subprocess.PIPE,
                          check=True).stdout.splitlines()[0]
    rows, failed, count = rows_of(RECORD), [], 0

    def keep(test, result, seconds):
        rows[test] = {"test": test, "result": result, "seconds": f"{float(seconds):.0f}", "commit": commit,
                      "date": datetime.date.today().isoformat(), "card": card}
        write(RECORD, rows)

    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.xml"
        with subprocess.Popen(["ctest", "--test-dir", str(build), "-L", LABELS, "--output-junit", str(report), "--test-output-size-passed", "20000",
                               *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True) as ctest:
            for line in ctest.stdout:
                print(line, end="", flush=True)
                ended = ENDED.match(line)
                if ended:
                    keep(ended[1], {"Passed": "passed", "Skipped": "skipped: no reason yet"}.get(ended[2], "failed"), ended[3])
        cases = xml.etree.ElementTree.parse(report).getroot().findall("testcase") if report.exists() else []
    for case in cases:    # with the reasons why some were skipped
        keep(case.get("name"), result_of(case), case.get("time"))
        count += 1
        if result_of(case).startswith("failed"):
            failed.append(case.get("name"))
    print(f"{count} tests, {len(failed)} failed{': ' if failed else ''}{', '.join(failed)}; {RECORD.relative_to(ROOT)}")
    return not cases or bool(failed)


def on_gpu():
    """Files that a compiler reads for a GPU: sources of nvcc and of Kokkos, and what these include of ours."""
    todo = [*ROOT.glob("src/**/*.cu"), *(path for path in ROOT.glob("kokkos/*") if path.suffix in (".cpp", ".h"))]
    seen = set()
    while todo:
        path = todo.pop()
        if path in seen:
            continue
        seen.add(path)
        for name in re.findall(r'^\s*#\s*include "([^"]+)"', path.read_text(encoding="utf-8"), re.M):
            found = [folder / name for folder in (path.parent, ROOT / "src", ROOT / "kokkos") if (folder / name).is_file()]
            todo += found[:1]
    # Laws are compiled from sources that CMake writes.
    seen |= set(ROOT.glob("src/engine/step/laws/*"))
    return sorted(path.relative_to(ROOT).as_posix() for path in seen)


def faults(record=RECORD):
    """What keeps the record from showing that today's sources work on a GPU: a sentence each, none where they do."""
    rows = rows_of(record)
    if not rows:
        return [f"{record.name} has no rows"]
    said = [f"{row['test']} {row['result']} at {row['commit']}" for row in rows.values()
            if row["result"] != "passed" and not row["result"].startswith("skipped")]
    for label in ("test_", "lammps.kokkos"):
        if not any(test.startswith(label) for test in rows):
            said.append(f"no test of {label}* has run on a GPU")
    files = on_gpu()
    for commit in sorted({row["commit"] for row in rows.values()}):
        done = subprocess.run(["git", "diff", "--name-only", commit, "--", *files], cwd=ROOT, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        changed = done.stdout.splitlines()
        if done.returncode:
            said.append(f"commit {commit} is not in the history")
        elif changed:
            tests = sum(row["commit"] == commit for row in rows.values())
            said.append(f"{tests} tests ran at {commit}; since then {len(changed)} files that a GPU compiles have changed, as {changed[0]}")
    return said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--commit")
    parser.add_argument("--check", action="store_true")
    words, ctest = parser.parse_known_args()
    if words.check:
        said = faults()
        print("\n".join(said) or "the record is of today's sources")
        return bool(said)
    if not words.build:
        parser.error("--build FOLDER or --check")
    commit = words.commit or subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], cwd=ROOT, text=True, stdout=subprocess.PIPE,
                                            check=True).stdout.strip()
    return run_tests(words.build, commit, ctest)


if __name__ == "__main__":
    os.chdir(ROOT)
    sys.exit(main())
