# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The benchmark driver keeps rows by program, case, sizes and order, and every program prints rows of the one format.

Comparisons with other walls and with LIGGGHTS take minutes.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = os.environ["LSDCD_BUILD"]
sys.path.insert(0, str(ROOT / "bench"))
import pages  # noqa: E402
import rows as kept  # noqa: E402
import tradeoff  # noqa: E402
from facts import fact  # noqa: E402



def row(program, case, median, order="random"):
    r = dict.fromkeys(kept.COLUMNS, "1")
    return dict(r, program=program, case=case, order=order, median_ms=median, facts="")


def test_rows():
    old = [row("query", "a", "1"), row("query", "a", "2", "sorted"), row("step", "b", "3")]
    new = [row("query", "a", "9", "sorted"), row("build", "c", "4")]
    got = [(r["program"], r["case"], r["order"], r["median_ms"]) for r in kept.replaced(old, new)]
    fact("a row replaces the one of its program, case, sizes and order, and others stay",
         got == [("query", "a", "random", "1"), ("query", "a", "sorted", "9"),
                 ("step", "b", "random", "3"), ("build", "c", "random", "4")], str(got))
    fact("rows come back from the file as they were",
         kept.parse(kept.as_csv(old)) == old)


def test_spread():
    def times(search, step, mean="0"):
        return dict(grid="1", search_ns=search, search_most_ns=search, step_ns=step, step_most_ns=step, choice_ns="9", force_mean=mean,
                    front="0", repeats="1")

    got = tradeoff.joined([[times("10", "7"), times("5", "8", "0.1")], [times("9", "30"), times("11", "6", "0.1")], [times("100", "8"), times("6", "7", "0.1")]])
    fact("of several runs the smallest and the largest time stay", [[r[k] for k in ("search_ns", "search_most_ns", "step_ns", "step_most_ns", "repeats")]
         for r in got] == [["9", "100", "7", "30", "3"], ["5", "11", "6", "8", "3"]], str(got))
    fact("a row that is slower and less exact is not on the front", [r["front"] for r in got] == ["1", "1"] and [
        r["front"] for r in tradeoff.joined([[times("10", "7"), times("5", "8", "0.1")]])] == ["1", "0"], str(got))


def test_programs():
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, str(ROOT / "bench" / "run.py"), "--build", BUILD,
                               "--only", "cpu", "--quick", "--rows-to", folder, "--commit", "x",
                               "query", "build", "step", "--spheres", "1000", "--repeats", "1",
                               "--most-triangles", "1000"],
                              env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        fact("a quick run ends well", done.returncode == 0, done.stdout[-500:] * done.returncode)
        rows = kept.read(folder, "performance")
        fact("and every program's rows are kept", {r["program"] for r in rows} ==
             {"query", "build", "step"}, str(len(rows)))
        bad = [r for r in rows if not float(r["min_ms"]) <= float(r["median_ms"]) <=
               float(r["max_ms"]) or not float(r["copy_gb_s"]) > 0 or r["commit"] != "x"]
        fact("with times, a copy's speed and the commit", rows and not bad, str(bad[:1]))
        with_bytes = [r for r in rows if r["bytes"]]
        off = [r for r in with_bytes if abs(float(r["floor_ms"]) * float(r["copy_gb_s"]) * 1e6 /
                                            float(r["bytes"]) - 1) > 1e-3]    # digits printed
        fact("the floor is the bytes over that speed", with_bytes and not off, str(off[:1]))
        fact("a table is made of them", "| 960 |" in pages.point_costs(rows))
        near_and_far(rows)
        wrong = subprocess.run([os.path.join(BUILD, "bin", "bench_query"), "--spheres", "none"],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        fact("a word that makes no sense ends a program with a line that says so",
             wrong.returncode == 2 and "--spheres" in wrong.stdout, wrong.stdout)


def near_and_far(rows):
    near, far, anywhere = ([r for r in rows if r["case"].startswith(place)] for place in ("near, ", "far, ", "any, "))
    fact("points near the mesh are all found, on one core, in both orders",
         {r["order"] for r in near} == {"random", "sorted"} and
         all(kept.facts(r)["found"] == r["spheres"] and "1 thread" in r["device"] for r in near))
    fact("without a cutoff all are found",
         anywhere and all(kept.facts(r)["found"] == r["spheres"] for r in anywhere))
    fact("of those far from it none is", far and all(kept.facts(r)["found"] == "0" for r in far))
    # In double both are right to 4e-13 of the radius and 4e-15 of the diagonal. In float a point, the corners
    # and a closest point that is found from them, all below 2, are each off by up to sqrt(3) 2^-24: 3.1e-7; a
    # distance up to 2.5 is rounded by as much again.
    radius, diagonal = 0.005 * 12**0.5, 12**0.5
    for name, limit in (("CGAL", 2 * (4e-13 * radius + 4e-15 * diagonal)), ("Embree", 6e-7)):
        its = [kept.facts(r) for r in near + far + anywhere if name in r["case"]]
        if not its:
            print(f"skipped: distances by {name} (not installed)")
            continue
        fact(f"{name} finds the same points at the same distances",
             all(f["found_by_one"] == "0" and float(f["largest_difference"]) <= limit for f in its),
             str([f["largest_difference"] for f in its]))


def test_comparisons():
    names = ["mesh-size", "tradeoff-paper"]
    if os.path.exists(os.path.join(BUILD, "bin", "lmp-lsdcd")):
        names += ["floor", "region"] + ["liggghts", "hard-curves"] * bool(shutil.which("liggghts"))
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            done = subprocess.run([sys.executable, str(ROOT / "bench" / "run.py"), "--build", BUILD,
                                   "--only", "cpu", "--quick", "--rows-to", folder, "--commit", "x", name],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            fact(f"{name} ends well", done.returncode == 0, done.stdout[-500:] * done.returncode)
        rows = kept.read(folder, "mesh-size")
        contacts = [int(kept.facts(r)["contacts"]) for r in rows]
        fact("mesh-size has the same contacts with every mesh, to a thousandth",
             rows and max(contacts) <= 1.001 * min(contacts), f"{min(contacts)} to {max(contacts)}")
        if "liggghts" in names:
            ratios = [float(kept.facts(r)["force_ratio"]) for r in kept.read(folder, "liggghts")]
            # Both laws are the same; folds of 5.6 degrees, where a sphere is at two sides, differ.
            fact("liggghts: both codes sum the same forces, to a hundredth",
                 all(abs(r - 1) < 0.01 for r in ratios), str(sorted(set(ratios))))
            curves = kept.read(folder, "hard_curves")
            # Of a face that leans by 2.5 degrees the force along z is 1 - cos = 1e-3 less.
            fact("hard-curves: over the fold the force is that of a face, to 1e-3",
                 [abs(float(r["value"]) - 1) < 1e-3 for r in curves if (r["curve"], r["wall"]) == ("fold", "LSDCD")] == 5 * [True], str(curves))
