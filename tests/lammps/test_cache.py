# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""With `cache FILE` the next start reads the grid, and nothing else changes.

Numbers are compared as printed with 17 digits: to the last bit.
"""

import os
import re

import pytest

import lmp
import scene
from facts import fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
TOTALS = ("thermo_style custom step ke f_wall f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] f_wall[6] "
          "f_wall[7] f_wall[8] f_wall[9]\nthermo_modify format float %.17g norm no\nthermo 10\n")
RUN = "run 100\n"
# Some spheres grow in the middle: the grid is made again.
GROWTH = "run 20\nset type 2 diameter 1.2\nrun 20\n"


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


def prepare(folder):
    scene.write_floor(folder / "floor.stl")
    if "this build has no grid cache" in lmp.run(scene.CREATE + f"fix w all wall/lsdcd {LAW} mesh floor.stl cache c\n", folder).stdout:
        pytest.skip("the build has no grid cache")
    lmp.run_well(scene.CREATE + scene.forces(LAW) + "run 200\nwrite_data start.data nocoeff\n", folder)


def test_box_changes(folder):
    """The grid is rebuilt for the box in many steps, then for larger spheres."""
    text = lmp.SMALL_BOX.replace("f f f", "p p f", 1).format(atoms="create_atoms 1 single 0 0 0.6 units box") + \
        "fix squeeze all deform 1 x erate -0.05\nthermo 50\n" + \
        f"fix wall all wall/lsdcd {LAW} mesh floor.stl cache box periodic\ntimestep 0.001\n" + \
        "run 10\nset group all diameter 1.1\nrun 10\n"
    output = lmp.run_well(text, folder)
    times = [int(n) for n in re.findall(r"the grid was rebuilt (\d+) times", output)]
    files = sorted(p.name for p in folder.glob("box*"))
    fact("a box that changes: grids are rebuilt often", len(times) == 2 and min(times) > 5, str(times))
    fact("a box that changes: files of the first grid and of that for larger spheres alone",
         files == ["box", "box.2"], " ".join(files))


def same(folder, name, run, plain, read=0, written=0, warnings=0):
    fact(f"{name}: same numbers", run.rows == plain.rows and len(run.rows) > 2)
    fact(f"{name}: {read} read, {written} written",
         (run.read, run.written) == (read, written), f"{run.read}, {run.written}")
    fact(f"{name}: {warnings} warnings", len(run.warnings) == warnings, str(run.warnings))
    fact(f"{name}: nothing else is left",
         not [p for p in folder.iterdir() if ".part-" in p.name])


@pytest.mark.parametrize("ranks", (1, 2))
def test_start(folder, ranks):
    cache = folder / "cache"

    where = f"{ranks} ranks"
    plain = go(folder, "", ranks)
    fact(f"{where}: spheres touch", max(row[9] for row in plain.rows) > 20)
    if ranks == 1:
        same(folder, "cache none", go(folder, "cache none"), plain)
    same(folder, f"{where}, first start", go(folder, "cache cache", ranks), plain, written=1)
    same(folder, f"{where}, second start", go(folder, "cache cache", ranks), plain, read=1)

    good = cache.read_bytes()
    bad = bytearray(good)
    bad[len(bad) // 2] ^= 16
    for name, damage in (("a bit flipped", bytes(bad)), ("half a file", good[:len(good) // 2]))[:3 - ranks]:
        cache.write_bytes(damage)
        run = go(folder, "cache cache", ranks)
        same(folder, f"{where}, {name}", run, plain, written=1, warnings=1)
        fact(f"{where}, {name}: told", "is damaged" in run.warnings[0])
        fact(f"{where}, {name}: replaced", cache.read_bytes()[64:] == good[64:] or
             go(folder, "cache cache", ranks).read == 1)

    # One process reads and tells, whatever the file is: several have seen one that is damaged.
    for words, told in (("grid 0.3", "belongs to different settings"), ("move 0 0 1e-9", "belongs to a different mesh"))[2 * ranks - 2:]:
        run = go(folder, f"{words} cache cache", ranks)
        same(folder, f"{where}, {words}", run, go(folder, words, ranks), written=1, warnings=1)
        fact(f"{where}, {words}: told", told in run.warnings[0], run.warnings[0])
        same(folder, f"{where}, {words} again", go(folder, f"{words} cache cache", ranks),
             go(folder, words, ranks), read=1)
    cache.unlink()

    run = go(folder, "cache no/such/cache", ranks)
    same(folder, f"{where}, no folder", run, plain, warnings=1)
    fact(f"{where}, no folder: told", "No such file or directory" in run.warnings[0])

    stl = (folder / "floor.stl").read_bytes()
    run = go(folder, "cache floor.stl", ranks)
    same(folder, f"{where}, a file of the user's", run, plain, warnings=1)
    fact(f"{where}, a file of the user's is kept", (folder / "floor.stl").read_bytes() == stl)

    # Larger spheres: the second grid has a file of its own.
    plain = go(folder, "", ranks, run=GROWTH)
    same(folder, f"{where}, growing", go(folder, "cache cache", ranks, run=GROWTH), plain, written=2)
    same(folder, f"{where}, growing again", go(folder, "cache cache", ranks, run=GROWTH), plain, read=2)
    (folder / "cache.2").unlink()
    same(folder, f"{where}, growing, one file gone", go(folder, "cache cache", ranks, run=GROWTH), plain,
         read=1, written=1)
    for name in ("cache", "cache.2"):
        (folder / name).unlink()


@pytest.mark.skipif("LSDCD_TWO_NODES" not in os.environ, reason="no LSDCD_TWO_NODES")
def test_two_nodes(folder):
    """Nodes that share no memory, and maybe no files."""
    cache, env = folder / "cache", {"LD_PRELOAD": os.environ["LSDCD_TWO_NODES"]}
    for ranks in (2, 4):
        plain = go(folder, "", ranks)
        same(folder, f"{ranks} ranks on two nodes, first start",
             go(folder, "cache cache", ranks, env=env), plain, written=1)
        same(folder, f"{ranks} ranks on two nodes, second start",
             go(folder, "cache cache", ranks, env=env), plain, read=1)
        cache.write_bytes(cache.read_bytes()[:-1])
        same(folder, f"{ranks} ranks on two nodes, damage", go(folder, "cache cache", ranks, env=env),
             plain, written=1, warnings=1)
        cache.unlink()
