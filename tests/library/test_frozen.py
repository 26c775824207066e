#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What scripts and programs of users rely on is still there: what tests/frozen/1.0 lists, as doc/formats.md promises. More may have come.

  test_frozen.py --keep    writes names and restart files anew, until 1.0 is out, with the environment of the test
"""
import json
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FROZEN = ROOT / "tests" / "frozen" / "1.0"
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "src" / "api")]    # for --keep

import pytest

import lsdcd
import stl
from facts import at_most, fact
from lsdcd._style_outputs import STYLE_OUTPUTS

TOOL, LMP, LIBRARY = (os.environ.get(f"LSDCD_{name}", "") for name in ("TOOL", "LMP", "LIBRARY"))

pytestmark = pytest.mark.skipif(not all(map(os.path.exists, (TOOL, LMP, LIBRARY))), reason="no lsdcd, lmp-lsdcd and liblsdcd (LSDCD_TOOL, LSDCD_LMP, LSDCD_LIBRARY)")

# A grain on a floor that wears, with all that a wall writes.
SCRIPT = """\
units           lj
atom_style      sphere
newton          off
comm_modify     vel yes
boundary        f f f
region          box block -3 3 -3 3 -1 5
create_box      1 box
create_atoms    1 single 0.3 0.2 0.51 units box
set             group all diameter 1 density 2
velocity        all set 0.1 0 -1 units box
pair_style      granular/lsdcd
pair_coeff      * * law hooke/history 1e4 NULL 20 NULL 0.5 1
timestep        1e-3
fix             move all nve/sphere
fix             wall all wall/lsdcd hooke/history 1e4 NULL 20 NULL 0.5 1 mesh floor.stl wear archard 1e-6 1 energy impacts 1e-6 &
                mesh_fields fields_*.vtp every 50 impact_spectrum spectrum_*.csv every 50
run             50
"""
# Restart files of LAMMPS 29Sep2021, one of each style that keeps something, and what goes on from it: LAMMPS reads those of its own version alone.
VERSION = "29 Sep 2021"
BOX = SCRIPT[:SCRIPT.index("create_atoms")]
AFTER = "timestep        1e-3\nfix             move all nve/sphere\n"
TWO = """\
create_atoms    1 single 0 0 0.49 units box
create_atoms    1 single 0.99 0 0.49 units box
set             group all diameter 1 density 2
velocity        all set 0 0.2 -0.1 units box
set             atom 2 omega 0 0 3
"""
NO_PAIRS = "pair_style      zero 1.2\npair_coeff      * *\n"
STYLES = {    # atoms, what acts, numbers that are printed
    "wall": (TWO, NO_PAIRS + "fix             it all wall/lsdcd hooke/history 1e4 NULL 20 NULL 0.5 1 mesh floor.stl motion linear 0.1 0 0 wear archard 1e-6 1\n",
             "f_it[1] f_it[2] f_it[3] f_it[10] fy[1]"),
    "pair": (TWO, "pair_style      granular/lsdcd\npair_coeff      * * law hooke/history 1e4 NULL 20 NULL 0.5 1\n", "fx[1] fy[1] fx[2]"),
    "massflow": (TWO, NO_PAIRS + "fix             it all massflow/lsdcd mesh floor.stl move 0 0 0.4895\n", "f_it[1] f_it[2] f_it[3] f_it[4]"),
    "insert": ("region          top block -2 2 -2 2 2 4 units box\n", NO_PAIRS +
               "fix             it all insert/lsdcd region top numberrate 400 diam range 0.2 0.3 dens 1 seed 7\n", "f_it[1] f_it[2] mass(all) xcm(all,x)"),
}
# Of commands that print JSON, words that need no more than a cube of side 1 and two points.
JSON = {"inspect": "cube.stl", "repair": "cube.stl -o new.stl", "convert": "cube.stl -o new.off", "generate": "box --width 1 --depth 1 --height 1 -o box.stl",
        "grid": "cube.stl --radius 0.1", "distance": "cube.stl points.csv --radius 1 -o distances.csv", "collide": "cube.stl cube.stl --pose 0.5 0 0 -o pairs.csv",
        "material": "glass.lsdcd glass", "timestep": "--young 5e6 --poisson 0.25 --density 2500 --radius 0.002 --speed 1", "shape": "2 2 10 --density 1",
        "clump": "cube.stl --spheres 2", "effects": "", "check": "--seconds 0"}
# Words, and how the program ends.
CODES = {"inspect cube.stl": 0, "--version": 0, "inspect nowhere.stl": 1, "inspect": 2, "inspect cube.stl --colour red": 2, "repair open.stl -o mended.stl": 3}
OPEN = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [0, 0, 1]]


def tool(folder, words):
    return subprocess.run([TOOL, *words.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def header(path):
    return path.read_text().split("\n", 1)[0].split(",")


def of_the_tool(folder):
    """Commands and their options, keys of JSON, columns, exit codes."""
    tool(folder, "generate box --width 1 --depth 1 --height 1 -o cube.stl")
    stl.write(folder / "open.stl", OPEN)
    (folder / "points.csv").write_text("0.5,0.5,1.25\n9,9,9\n")
    said = tool(folder, "--help").stdout.split("Subcommands:")[1]
    found = {f"options of lsdcd {command}": sorted(set(re.findall(r"--[a-z][a-z-]+", tool(folder, f"{command} --help").stdout)))
             for command in re.findall(r"^  ([a-z]+)  ", said, re.M)}
    for command, words in JSON.items():
        done = tool(folder, f"{command} {words} --json")
        answer = json.loads(done.stdout)
        found[f"keys of lsdcd {command} --json"] = sorted(answer) if isinstance(answer, dict) else sorted(answer[0])
    for name in ("distances", "pairs"):
        found[f"columns of {name}.csv"] = header(folder / f"{name}.csv")
    found["exit codes of lsdcd"] = [f"{words}: {tool(folder, words).returncode}" for words in CODES]
    return found


def of_a_run(folder):
    """Names in the files that a run writes."""
    stl.write(folder / "floor.stl", stl.square(3))
    (folder / "in.script").write_text(SCRIPT)
    done = subprocess.run([LMP, "-in", "in.script", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])
    vtp = (folder / "fields_50.vtp").read_bytes().decode("latin-1")
    return {"arrays of mesh_fields": sorted(set(re.findall(r'<DataArray [^>]*Name="(\w+)"', vtp))), "columns of impact_spectrum": header(folder / "spectrum_50.csv")}


def of_the_library():
    said = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], capture_output=True, text=True, check=True).stdout
    return {"functions of liblsdcd": sorted({line.split()[-1].split("@")[0] for line in said.splitlines()} - {"LSDCD_0"}),
            "keywords of a wall": list(lsdcd.KEYWORDS), "numbers of a wall": list(lsdcd.OUTPUTS),
            **{f"elements of {style}": [row[0] for row in rows] for style, rows in STYLE_OUTPUTS.items()}}


def go_on(folder, style, begin, end):
    """The numbers of a style after a step from a restart file, or from the begin where that is None, and whether LAMMPS is of the kept version."""
    atoms, acts, numbers = STYLES[style]
    words = numbers.split()
    head = BOX.replace("newton ", "atom_modify     map array\nnewton ") + atoms
    if begin:
        head = f"newton          off\nread_restart    {begin}\ncomm_modify     vel yes\n" + (atoms if atoms.startswith("region") else "")
    variables = "".join(f"variable        n{k} equal {word}\n" for k, word in enumerate(words))
    printed = " ".join(f"$(v_n{k}:%.15g)" for k in range(len(words)))
    (folder / "in.style").write_text(f'{head}{acts}{AFTER}{variables}thermo          1000000\n{end}run             1\nprint           "numbers {printed}"\n')
    done = subprocess.run([LMP, "-in", "in.style", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(f"{style}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return [float(word) for word in re.search(r"^numbers (.*)$", done.stdout, re.M)[1].split()], VERSION in done.stdout


# Of these the place counts, too: the number of an element, or the column.
IN_ORDER = ("elements", "columns")


def seen(folder):
    return {**of_the_library(), **of_the_tool(folder), **of_a_run(folder)}


def test_names(folder):
    """All names that are kept are there, and the numbers of a style and columns of a file at their places."""
    now = seen(folder)
    for what, names in json.loads((FROZEN / "names.json").read_text()).items():
        there = now.get(what, [])
        if what.startswith(IN_ORDER):
            fact(what, there[:len(names)] == names, f"{names} became {there}")
        else:
            fact(what, set(names) <= set(there), f"gone: {[name for name in names if name not in there]}")


def test_program(folder):
    """A program in C that the kept header has compiled runs with the library of today."""
    stl.write(folder / "around.stl", stl.box((-1,) * 3, (1,) * 3))
    library = pathlib.Path(LIBRARY)
    subprocess.run([os.environ.get("LSDCD_C", "cc"), "-std=c99", "-Wall", "-Wextra", "-Werror", "-I", FROZEN, FROZEN / "distances.c", "-o", folder / "distances", library],
                   check=True)
    done = subprocess.run([folder / "distances", "around.stl"], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "LD_LIBRARY_PATH": str(library.parent)})
    # The middle of a cube is 1 from its faces, and nothing is nearer than the cutoff of 1; the second point is 0.25 above the top.
    fact("and has the distances", done.returncode == 0 and done.stdout == "inf 0.25\n", done.stdout + done.stderr)


@pytest.mark.parametrize("style", STYLES)
def test_restart(folder, style):
    """A run goes on from a kept restart file as the run that wrote it did."""
    stl.write(folder / "floor.stl", stl.square(3))
    wanted = json.loads((FROZEN / "restart.json").read_text())[style]
    if VERSION not in subprocess.run([LMP, "-h"], capture_output=True, text=True, check=False).stdout:
        pytest.skip(f"this LAMMPS does not read restart files of {VERSION}")
    numbers, _ = go_on(folder, style, FROZEN / f"{style}.restart", "")
    for now, then in zip(numbers, wanted):
        at_most(f"{style}: {now:.15g} is {then:.15g}", abs(now - then), 1e-9 * max(map(abs, wanted)))    # other processors round otherwise


def keep_restarts(folder):
    stl.write(folder / "floor.stl", stl.square(3))
    kept = {}
    for style in STYLES:
        kept[style], right = go_on(folder, style, None, f"run             10\nwrite_restart    {FROZEN / style}.restart\n")
        if not right:
            sys.exit(f"restart files are those of LAMMPS {VERSION}")
    (FROZEN / "restart.json").write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    import tempfile
    if sys.argv[1:] != ["--keep"]:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as made:
        (FROZEN / "names.json").write_text(json.dumps(seen(pathlib.Path(made)), indent=1) + "\n")
        keep_restarts(pathlib.Path(made))
