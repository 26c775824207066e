# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Walls in Python with the library against those of scripts in LAMMPS: each kind of wall, to the last bit of forces.
LSDCD_LMP names lmp-lsdcd, PYTHONPATH and LSDCD_LIBRARY the module and its library."""
import os
import re
import subprocess

import numpy as np
import pytest

import lsdcd
from facts import fact

LMP = os.environ.get("LSDCD_LMP", "")
pytestmark = pytest.mark.skipif(not os.path.exists(LMP), reason="no lmp-lsdcd (LSDCD_LMP)")


def run(lmp, folder, script):
    with open(os.path.join(folder, "in.script"), "w", encoding="utf-8") as f:
        f.write(script)
    done = subprocess.run([lmp, "-in", "in.script", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])


# Spheres of radius 0.5 and mass 1, which nothing moves, on a square at z = 0.
SQUARE = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], float)
FLOOR = lsdcd.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
X, V, OMEGA, TOUCHES = np.array([[0.3, 0.2, 0.49], [1.5, -1, 0.48]]), np.full((2, 3), 0.25), np.full((2, 3), 0.5), 5


STYLE, PLACING = "hooke/history 1000 300 20 NULL 0.5 1 mesh $floor", "scale 2 rotate 0 0.1 1 30 move 0 0 0.01"
# What is special, and the words, in which a script has files where a program has values.
WALLS = {"a style": STYLE,
         "granular": "granular hertz/material 2000 0.5 0.3 tangential mindlin NULL 1 0.5 damping tsuji "
                     "rolling sds 100 1 0.1 limit_damping mesh $floor",
         "rolling and cohesion": "hooke 1000 300 20 10 0.5 1 mesh $floor rolling cdt 0.1 cohesion sjkr 50",
         "a placement": f"{STYLE} {PLACING}",
         "motions": f"{STYLE} motion rotate 0 0 0 0 1 0 3 motion linear 0 0 1",
         "waves": f"{STYLE} motion wiggle 0 0 0.01 2 motion transrot 0 0 1 1 0 0 0 1 0 5",
         "a cosine": f"{STYLE} wiggle z 0.01 2",
         "a table": f"{STYLE} motion table $rows axis 1 0 0 0 1 0 repeat motion riggle 0 0 0 0 0 1 5 2",
         "a table of a file": f"{STYLE} motion table $file axis 1 0 0 0 1 0 linear degrees",
         "a servo": f"{STYLE} servo force z 25 vmax 0.5 limits -0.1 0.2",
         "a belt": f"{STYLE} surface_vel 1 0 0 surface_angvel 0 0 0.5 1 2 0",
         "a law of a mesh": f"{STYLE} law hooke/history 500 100 5 0 0.3 1",
         "a law of types": f"{STYLE} law types 2* hooke/history 500 100 5 0 0.3 1",
         "the search": f"{STYLE} corner sum nearest 2 grid 0.5 rmax 0.7"}
FILES = {"$floor": "floor.stl", "$rows": "lever.txt", "$file": "lever.txt"}


def in_script(words):
    return re.sub(r"[$]\w+", lambda name: FILES[name[0]], words)


def forces_by_library(wall):
    force, torque = np.zeros((2, 3)), np.zeros((2, 3))
    for k in range(TOUCHES + 1):
        force[:] = torque[:] = 0
        wall.step(X, V, OMEGA, np.full(2, 0.5), np.ones(2), force, torque, 1e-3, setup=k == 0, type=np.array([1, 2], np.int32))
    return np.hstack([force, torque])


def write_files(folder):
    with open(os.path.join(folder, "floor.stl"), "w", encoding="ascii") as f:
        f.write("solid floor\n")
        for face in ([0, 1, 2], [0, 2, 3]):
            f.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % tuple(SQUARE[k]) for k in face) +
                    "endloop\nendfacet\n")
        f.write("endsolid floor\n")
    with open(os.path.join(folder, "lever.txt"), "w", encoding="ascii") as f:
        f.write("0 0\n0.5 0.3\n1 0\n")


BEGIN = """clear
units si
atom_style sphere
atom_modify map yes sort 0 0
boundary f f f
region box block -10 10 -10 10 -10 10
create_box 2 box
""" + "".join(f"create_atoms {k + 1} single {' '.join(map(repr, x.tolist()))} units box\n" for k, x in enumerate(X)) + f"""\
set group all diameter 1
set group all mass 1
set group all omega {' '.join(map(str, OMEGA[0]))}
velocity all set {' '.join(map(str, V[0]))}
pair_style zero 1.1
pair_coeff * *
comm_modify vel yes
timestep 1e-3
"""


def forces_by_lammps(lmp, folder, walls):
    """Of each wall of these words, in one run of the program."""
    write_files(folder)
    run(lmp, folder, "".join(f"""{BEGIN}\
fix wall all wall/lsdcd {words} device cpu
run {TOUCHES}
write_dump all custom {k}.dump id fx fy fz tqx tqy tqz modify sort id format float %.17g
""" for k, words in enumerate(walls)))
    return [np.loadtxt(os.path.join(folder, f"{k}.dump"), skiprows=9)[:, 1:] for k in range(len(walls))]


def test_bits_of_a_script(folder):
    values = {"floor": FLOOR, "rows": [[0, 0], [0.5, 0.3], [1, 0]], "file": folder / "lever.txt"}
    for (name, words), wanted in zip(WALLS.items(), forces_by_lammps(LMP, str(folder), [*map(in_script, WALLS.values())])):
        found = forces_by_library(lsdcd.Wall(words, values={k: value for k, value in values.items() if f"${k}" in words.split()}))
        fact(f"{name}: the bits of the script", (found == wanted).all() and wanted[:, 2].any(), found - wanted)


# Keywords that the wall of test_numbers_by_name() does not have.
WITHOUT = ("body_", "removed_", "held_back_", "couple_", "lost_wear", "dissipated_power_plastic", "dissipated_plastic")


def test_numbers_by_name(folder):
    """Each number that a wall has is the same in a script and in the library, by its name, of the wall and of one of its meshes."""
    names = [name for name in lsdcd.OUTPUTS if not name.startswith(WITHOUT)]
    words = f"""{STYLE} name floor motion rotate 0 0 0 0 0 1 3 mesh $floor name lid move 0 0 0.95 servo force z -5 vmax 0.5 &
                wear archard 1e-3 1e3 energy impacts 1e-3 average 2"""
    wall = lsdcd.Wall(words, floor=FLOOR)
    force, torque = np.zeros((2, 3)), np.zeros((2, 3))
    for k in range(TOUCHES + 1):
        wall.step(X, V, OMEGA, np.full(2, 0.5), np.ones(2), force, torque, 1e-3, setup=k == 0)
    write_files(folder)
    of_lid = [name for name in names if name != "elastic_energy"]
    columns = " ".join([f"v_w_{name}" for name in names] + [f"v_lid_{name}" for name in of_lid])
    run(LMP, folder, BEGIN + f"""\
fix w all wall/lsdcd {in_script(words)} device cpu
fix_modify w names w all
fix_modify w mesh lid names lid all
log numbers.log
thermo_style custom step {columns}
thermo_modify format float %.17g norm no
run {TOUCHES}
""")
    with open(os.path.join(folder, "numbers.log"), encoding="utf-8") as f:
        rows = [line.split() for line in f if line.split()[:1] == [str(TOUCHES)]]
    wanted = [float(word) for word in rows[-1][1:]]
    given, of_mesh = wall.outputs(" ".join(names)), wall.outputs(" ".join(of_lid), "lid")
    found = [given[name] for name in names] + [of_mesh[name] for name in of_lid]
    fact("the same numbers", len(wanted) == len(found) > 80 and wanted == found, [
        (name, a, b) for name, a, b in zip(columns.split(), wanted, found) if a != b])
    fact("of which many are not 0", sum(x != 0 for x in found) > 40, found)
    with pytest.raises(lsdcd.Error, match="there is no number 'forse_z': the nearest is 'force_z'"):
        wall.outputs("power forse_z")
