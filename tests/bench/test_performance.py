#!/usr/bin/env python3
"""The benchmark driver keeps rows by program, case, sizes and order, doc/performance.md holds what
the rows that are kept say, and every program prints rows of the one format."""

import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = os.environ["LSDCD_BUILD"]
sys.path.insert(0, str(ROOT / "bench"))
import floor  # noqa: E402
import kokkos_tables  # noqa: E402
import liggghts  # noqa: E402
import mesh_size  # noqa: E402
import performance  # noqa: E402

failed = 0


def fact(name, holds, detail=""):
    global failed
    print(f"{'PASS' if holds else 'FAIL'} {name}{': ' + detail if detail else ''}")
    failed += not holds


def row(program, case, median, order="random"):
    r = dict.fromkeys(performance.KEY, "1")
    return dict(r, program=program, case=case, order=order, median_ms=median)


def test_rows():
    old = [row("query", "a", "1"), row("query", "a", "2", "sorted"), row("step", "b", "3")]
    new = [row("query", "a", "9", "sorted"), row("build", "c", "4")]
    got = [(r["program"], r["case"], r["order"], r["median_ms"])
           for r in performance.replaced(old, new)]
    fact("a row replaces the one of its program, case, sizes and order, and others stay",
         got == [("query", "a", "random", "1"), ("query", "a", "sorted", "9"),
                 ("build", "c", "random", "4"), ("step", "b", "random", "3")], str(got))
    fact("rows come back from the file as they were",
         performance.parse(performance.as_csv(old)) == old)


def test_document():
    text = pathlib.Path(performance.DOCUMENT).read_text() + pathlib.Path(performance.NOTES).read_text()
    found = {}
    for tables in (performance, kokkos_tables):
        found.update(tables.parts(tables.read_rows("cpu"), tables.read_rows("cuda")))
    for tables in (liggghts, floor, mesh_size):
        found.update(tables.kept_parts())
    stale = [name for name, part in found.items() if part not in text]
    fact("the documents hold what their rows say", not stale,
         f"./run bench --write-only, of these tables: {', '.join(stale)}" if stale else "")


def test_programs():
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, str(ROOT / "bench" / "run.py"), "--build", BUILD,
                               "--only", "cpu", "--quick", "--rows-to", folder, "--commit", "x",
                               "query", "build", "step", "--spheres", "1000", "--repeats", "1",
                               "--most-triangles", "200"],
                              env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        fact("a quick run ends well", done.returncode == 0, done.stdout[-500:] * done.returncode)
        rows = performance.read_rows("cpu", folder)
        fact("and every program's rows are kept", {r["program"] for r in rows} ==
             {"query", "build", "step"}, str(len(rows)))
        bad = [r for r in rows if not float(r["min_ms"]) <= float(r["median_ms"]) <=
               float(r["max_ms"]) or not float(r["copy_gb_s"]) > 0 or r["commit"] != "x"]
        fact("with times, a copy's speed and the commit", rows and not bad, str(bad[:1]))
        with_bytes = [r for r in rows if r["bytes"]]
        off = [r for r in with_bytes if abs(float(r["floor_ms"]) * float(r["copy_gb_s"]) * 1e6 /
                                            float(r["bytes"]) - 1) > 1e-3]    # digits printed
        fact("the floor is the bytes over that speed", with_bytes and not off, str(off[:1]))
        found = performance.parts(rows, [])
        fact("tables are made of them", all("| " in found[k] for k in ("status", "build", "step")))
        wrong = subprocess.run([os.path.join(BUILD, "bin", "bench_query"), "--spheres", "none"],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        fact("a word that makes no sense ends a program with a line that says so",
             wrong.returncode == 2 and "--spheres" in wrong.stdout, wrong.stdout)


test_rows()
test_document()
test_programs()
sys.exit(1 if failed else 0)
