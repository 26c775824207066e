#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run the four tutorials with fix wall/lsdcd and with LIGGGHTS, from the same grains, and print the figures side by side.

Fails where a figure is outside the bound that the table names. Without LIGGGHTS its half is skipped.
"""
import math
import os
import shutil
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from runs import environment, make_meshes, options, print_table, run_script    # noqa: E402

STARTS = {"meshGran": 6, "movingMeshGran": 6, "servoWall": 1, "conveyor": 6, "transfer": 6}
HERE_NAME, THERE_NAME = "fix wall/lsdcd", "LIGGGHTS"
# Two-sided 1e-4 points of Student's distribution for 5 degrees of freedom.
STUDENT = 11.18
# The figures, and the sizes below which a difference does not count: one grain, or a tenth of its diameter.
FIGURES = {"meshGran": {"x": 0.002, "z": 0.002}, "movingMeshGran": {"taken": 1, "z": 0.006},
           "conveyor": {"half": 0.0354, "passed": 0.0354, "x": 0.0025},
           "transfer": {"half": 0.0354, "passed": 0.0354, "x": 0.0025}}


def figures(a, program, name, start):
    """Of one run."""
    work = a.work / f"start{start}"
    if program == THERE_NAME:
        command = ["liggghts", "-in", HERE / f"in.{name}.liggghts", "-log", "none"]
        done = subprocess.run(command, cwd=work, text=True, capture_output=True, stdin=subprocess.DEVNULL)
        lines = [x for x in done.stdout.splitlines() if x.startswith(f"{name} ") and "${" not in x]
        if done.returncode or not lines:
            raise SystemExit(done.stdout[-2000:] + done.stderr[-2000:])
        words = lines[-1].split()[1:]
        return dict(zip(words[::2], map(float, words[1::2])))
    one = type("Options", (), {"lmp": a.lmp, "work": work, "flags": ""})
    return run_script(one, HERE / f"in.{name}", png=0)


def heights():
    """Closed form of the servo's plate: 27 grains of diameter 0.02 in columns of three, Hertz, each column a ninth of 30 N."""
    radius, young, gravity = 0.01, 1e7 / (2 * (1 - 0.3 ** 2)), 9.81
    weight = 2500 * 4 / 3 * math.pi * radius ** 3 * gravity

    def overlap(force, r):
        return (force / (4 / 3 * young * math.sqrt(r))) ** (2 / 3)

    load = 30 / 9
    return (6 * radius - overlap(load, radius) - overlap(load + weight, radius / 2) - overlap(load + 2 * weight, radius / 2) -
            overlap(load + 3 * weight, radius))


def checks(name, program, run):
    """(what, value, its bound) of one run: a balance or a closed form."""
    if name in ("meshGran", "conveyor", "transfer"):
        # Over N = 2000 steps the momentum changes by the forces' trapezoid sum; the load is the mean of the steps after the
        # first. The two differ by (first force - last force) / (2 N), and forces stay below ten times the weight.
        yield "load + weight + rate of momentum, N", run["load"] + run["weight"] + run["residue"], run["weight"] * 10 / 4000
    if name == "servoWall":
        yield "load - 30 N", run["load"] - 30, 0.03
        # At a load that is 0.1 % off all overlaps are 0.07 % off.
        yield "place of the plate - closed form, m", run["place"] - heights(), 7e-4 * (0.06 - heights())


def main():
    p = options(__doc__, HERE)
    p.add_argument("--only", choices=STARTS, help="one tutorial")
    p.add_argument("--program", choices=(HERE_NAME, THERE_NAME), help="one program, without the comparison")
    p.add_argument("--both", action="store_true", help="where LIGGGHTS is missing, skip all")
    a = p.parse_args()
    names = [a.only] if a.only else list(STARTS)
    programs = [a.program] if a.program else [HERE_NAME, THERE_NAME]
    if THERE_NAME in programs and not shutil.which("liggghts"):
        print("SKIPPED: LIGGGHTS (not installed; Debian's package is liggghts)")
        programs.remove(THERE_NAME)
        if a.both or not programs:
            sys.exit(77)
    for start in range(1, max(STARTS[n] for n in names) + 1):
        make_meshes(HERE / "make_meshes.py", a.work / f"start{start}", "--start", start)
    jobs = [(p, n, s) for n in names for s in range(1, STARTS[n] + 1) for p in programs]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = dict(zip(jobs, pool.map(lambda j: figures(a, *j), jobs)))
    rows, bad = [], []
    for n in names:
        for key in runs[programs[0], n, 1]:
            values = [[runs[p, n, s][key] for s in range(1, STARTS[n] + 1)] for p in programs]
            row = [n, key, *(f"{statistics.mean(v):.5g}" for v in values)]
            if len(programs) == 2 and key in FIGURES.get(n, {}):
                apart = [x - y for x, y in zip(*values)]
                mean, limit = statistics.mean(apart), STUDENT * statistics.stdev(apart) / math.sqrt(len(apart))
                limit = max(limit, FIGURES[n][key])
                row += [f"{mean:.2g}", f"{limit:.2g}"]
                if abs(mean) > limit:
                    bad.append(f"{n} {key}: means are {mean:.3g} apart, more than {limit:.3g}")
            rows.append(row + [""] * (len(programs) + 4 - len(row)))
        for p in programs:
            for s in range(1, STARTS[n] + 1):
                for what, value, bound in checks(n, p, runs[p, n, s]):
                    if abs(value) > bound:
                        bad.append(f"{n}, {p}, start {s}: {what}: {value:.3g}, more than {bound:.3g}")
    print_table(["tutorial", "figure", *programs, "difference", "bound"], rows)
    for line in bad:
        print("FAILED:", line)
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
