#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""With `cache FILE` the next start reads the grid, and nothing else changes.

Numbers are compared as printed with 17 digits: to the last bit.
"""

import os
import re
import subprocess
import sys

import lmp
import scene

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
TOTALS = ("thermo_style custom step ke f_wall f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] f_wall[6] "
          "f_wall[7] f_wall[8] f_wall[9]\nthermo_modify format float %.17g norm no\nthermo 50\n")
RUN = "run 300\n"
# Some spheres grow in the middle: the grid is made again.
GROWTH = "run 100\nset type 2 diameter 1.2\nrun 100\n"


def text_of(words, run=RUN):
    return scene.SETTINGS + "read_data start.data\n" + scene.forces(LAW, mesh="mesh floor.stl " + words) + \
        TOTALS + run


class Run:
    def __init__(self, output):
        self.output = output
        self.rows = lmp.read_thermo(output)
        self.warnings = [line for line in output.split("\n") if "WARNING: Fix " in line and "cache" in line]
        self.read = output.count("not built now, read from cache")
        self.written = output.count("written to cache")


def go(folder, words, ranks=1, run=RUN, env=None):
    return Run(lmp.run_well(text_of(words, run), folder, ranks, env=env))


def box_changes(checks, folder):
    """The grid is rebuilt for the box in many steps, then for larger spheres."""
    text = lmp.SMALL_BOX.replace("f f f", "p p f", 1).format(atoms="create_atoms 1 single 0 0 0.6 units box") + \
        "fix squeeze all deform 1 x erate -0.05\nthermo 50\n" + \
        f"fix wall all wall/lsdcd {LAW} mesh floor.stl cache box periodic\ntimestep 0.001\n" + \
        "run 20\nset group all diameter 1.1\nrun 20\n"
    output = lmp.run_well(text, folder)
    times = [int(n) for n in re.findall(r"the grid was rebuilt (\d+) times", output)]
    files = sorted(p.name for p in folder.glob("box*"))
    checks.fact("a box that changes: grids are rebuilt often", len(times) == 2 and min(times) > 5, str(times))
    checks.fact("a box that changes: files of the first grid and of that for larger spheres alone",
                files == ["box", "box.2"], " ".join(files))


def main():
    checks, folder = lmp.Checks(), lmp.scratch()
    scene.write_floor(folder / "floor.stl")
    lmp.run_well(scene.CREATE + "write_data start.data\n", folder)
    cache = folder / "cache"

    def same(name, run, plain, read=0, written=0, warnings=0):
        checks.fact(f"{name}: same numbers", run.rows == plain.rows and len(run.rows) > 2)
        checks.fact(f"{name}: {read} read, {written} written",
                    (run.read, run.written) == (read, written), f"{run.read}, {run.written}")
        checks.fact(f"{name}: {warnings} warnings", len(run.warnings) == warnings, str(run.warnings))
        checks.fact(f"{name}: nothing else is left",
                    not [p for p in folder.iterdir() if ".part-" in p.name])

    for ranks in (1, 2):
        where = f"{ranks} ranks"
        plain = go(folder, "", ranks)
        checks.fact(f"{where}: spheres touch", max(row[9] for row in plain.rows) > 20)
        same(f"{where}, cache none", go(folder, "cache none", ranks), plain)
        same(f"{where}, first start", go(folder, "cache cache", ranks), plain, written=1)
        same(f"{where}, second start", go(folder, "cache cache", ranks), plain, read=1)

        good = cache.read_bytes()
        bad = bytearray(good)
        bad[len(bad) // 2] ^= 16
        for name, damage in (("a bit flipped", bytes(bad)), ("half a file", good[:len(good) // 2])):
            cache.write_bytes(damage)
            run = go(folder, "cache cache", ranks)
            same(f"{where}, {name}", run, plain, written=1, warnings=1)
            checks.fact(f"{where}, {name}: told", "is damaged" in run.warnings[0])
            checks.fact(f"{where}, {name}: replaced", cache.read_bytes()[64:] == good[64:] or
                        go(folder, "cache cache", ranks).read == 1)

        for words, told in (("grid 0.3", "belongs to other settings"), ("move 0 0 1e-9", "belongs to another mesh")):
            run = go(folder, f"{words} cache cache", ranks)
            same(f"{where}, {words}", run, go(folder, words, ranks), written=1, warnings=1)
            checks.fact(f"{where}, {words}: told", told in run.warnings[0], run.warnings[0])
            same(f"{where}, {words} again", go(folder, f"{words} cache cache", ranks),
                 go(folder, words, ranks), read=1)
        cache.unlink()

        run = go(folder, "cache no/such/cache", ranks)
        same(f"{where}, no folder", run, plain, warnings=1)
        checks.fact(f"{where}, no folder: told", "No such file or directory" in run.warnings[0])

        stl = (folder / "floor.stl").read_bytes()
        run = go(folder, "cache floor.stl", ranks)
        same(f"{where}, a file of the user's", run, plain, warnings=1)
        checks.fact(f"{where}, a file of the user's is kept", (folder / "floor.stl").read_bytes() == stl)

        # Larger spheres: the second grid has a file of its own.
        plain = go(folder, "", ranks, run=GROWTH)
        same(f"{where}, growing", go(folder, "cache cache", ranks, run=GROWTH), plain, written=2)
        same(f"{where}, growing again", go(folder, "cache cache", ranks, run=GROWTH), plain, read=2)
        (folder / "cache.2").unlink()
        same(f"{where}, growing, one file gone", go(folder, "cache cache", ranks, run=GROWTH), plain,
             read=1, written=1)
        for name in ("cache", "cache.2"):
            (folder / name).unlink()

    box_changes(checks, folder)

    # Nodes that share no memory, and maybe no files.
    two_nodes = os.environ.get("LSDCD_TWO_NODES")
    if two_nodes:
        env = {"LD_PRELOAD": two_nodes}
        for ranks in (2, 4):
            plain = go(folder, "", ranks)
            same(f"{ranks} ranks on two nodes, first start",
                 go(folder, "cache cache", ranks, env=env), plain, written=1)
            same(f"{ranks} ranks on two nodes, second start",
                 go(folder, "cache cache", ranks, env=env), plain, read=1)
            cache.write_bytes(cache.read_bytes()[:-1])
            same(f"{ranks} ranks on two nodes, damage", go(folder, "cache cache", ranks, env=env),
                 plain, written=1, warnings=1)
            cache.unlink()

    # Several runs at once leave one good file, and each has the right numbers.
    plain = go(folder, "")
    (folder / "in.once").write_text(text_of("cache cache"))
    for turn in range(3):
        runs = [subprocess.Popen([lmp.LMP, "-in", "in.once", "-log", "none", "-nocite"], cwd=folder,
                                 env=lmp.environment(), stdout=subprocess.PIPE, text=True)
                for _ in range(3)]
        done = [Run(run.communicate(timeout=300)[0]) for run in runs]
        checks.fact(f"at once, turn {turn}: same numbers", all(run.rows == plain.rows for run in done))
        checks.fact(f"at once, turn {turn}: no warnings", not any(run.warnings for run in done))
        same(f"after them, turn {turn}", go(folder, "cache cache"), plain, read=1)
        cache.unlink()
    checks.done(folder)


if __name__ == "__main__":
    probe = lmp.scratch()
    scene.write_floor(probe / "floor.stl", cells=1)
    refused = lmp.run(scene.CREATE + f"fix w all wall/lsdcd {LAW} mesh floor.stl cache c\n", probe).stdout
    if "this build has no grid cache" in refused:
        print("skipped: the build has no grid cache")
        sys.exit(77)
    main()
