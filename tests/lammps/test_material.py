# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""`granular material ...` is the granular style with the material's numbers.

The numbers are worked out here once more, from the values in the file and the formulas of
contact mechanics; scripts with the words that the log shows must then give the same bits.
"""

import pathlib
import re
import subprocess

import lmp
import stl
from facts import at_most, fact

FILE = """\
units si
material glass
  youngs_modulus 70e6 Pa # soft, so that steps are long
  poissons_ratio 0.22 1
  surface_energy 0.5 J/m2
  thermal_conductivity 1.7 W/m/K
material steel
  youngs_modulus 210e6 Pa
  poissons_ratio 0.3 1
pair glass glass
  restitution 0.9 1
  sliding_friction 0.3 1
  rolling_friction 0.02 1
pair steel glass
  restitution 0.7 1
  sliding_friction 0.4 1
"""

def scene(wall):
    """A grain of 2 mm that hops, slides and rolls for 20 ms."""
    return lmp.head("-0.02 0.02 -0.02 0.02 -0.01 0.02", units="si") + f"""\
create_atoms    1 single 0.001 0.0003 0.00101 units box
set             group all diameter 0.002 density 2500
velocity        all set 0.2 0.05 -0.1
set             group all omega 20 -90 30
pair_style      zero 0.003
pair_coeff      * *
neighbor        0.001 bin
fix             move all nve/sphere
fix             pull all gravity 9.81 vector 0.1 0 -1
fix             wall all wall/lsdcd {wall}
timestep        1e-6
dump            out all custom 100 out id x y z vx vy vz omegax omegay omegaz
dump_modify     out format float %.17g
run             20000
"""


def run(folder, wall, ranks=1, env=None):
    """The motion, and the words of the style that the log shows."""
    text = lmp.run_well(scene(wall), folder, ranks=ranks, env=env)
    return lmp.read_dump(folder / "out"), re.search(r"^  contact     (granular .*)", text, re.M)[1], text


def prepare(folder):
    (folder / "grains.lsdcd").write_text(FILE)
    stl.write(folder / "floor.stl", stl.square(0.015))


def test_same_bits(folder):
    words = "granular material grains.lsdcd glass damping tsuji rolling sds 100 1e-3 NULL"
    numbers = ("granular hertz/material 70e6 0.9 0.22 damping tsuji rolling sds 100 1e-3 0.02 "
               "tangential mindlin NULL 1 0.3")
    filled, plain = run(folder, f"{words} mesh floor.stl")[0], run(folder, f"{numbers} mesh floor.stl")[0]
    fact("a material moves as its numbers written out", filled == plain)
    turns = filled[20000][1][6:9]
    fact("the grain was turned by friction", turns != filled[0][1][6:9], str(turns))


def test_places(folder):
    elsewhere = folder / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "mine.lsdcd").write_text(FILE.replace("0.9", "0.8"))
    for variable in ("LSDCD_POTENTIALS", "LAMMPS_POTENTIALS"):
        words = run(folder, "granular material mine.lsdcd glass mesh floor.stl",
                    env={variable: f"/nowhere:{elsewhere}"})[1]
        fact(f"a file in ${variable} is found", words.split()[3] == "0.8")
    words = run(folder, "granular material alumina.lsdcd alumina on glass with sliding_friction 0.2 "
                "mesh floor.stl")[1]
    fact("the project's own files are found by name", words.split()[3] == "0.98")


def test_ranks(folder):
    wall = "granular material grains.lsdcd glass on steel mesh floor.stl"
    one, words, _ = run(folder, wall)
    two, same, _ = run(folder, wall, ranks=2)
    fact("2 processes: the same words and motion", words == same and one == two)


TWO_GRAINS = lmp.head("-0.01 0.01 -0.01 0.01 -0.01 0.01", units="si") + """\
create_atoms    1 single 0.00101 0 0 units box
create_atoms    1 single -0.00101 0 0 units box
set             group all diameter 0.002 density 2500
velocity        all ramp vx 0.5 -0.5 x -0.00101 0.00101 units box
pair_style      granular
pair_coeff      * * {words}
neighbor        0.001 bin
fix             move all nve/sphere
timestep        1e-7
dump            out all custom 10000 out id vx
dump_modify     out format float %.17g sort id
run             10000
"""


def test_grains(folder):
    """The words that the tool prints for grains on one another, in the LAMMPS that is there: they
    part with the file's restitution. Its number is rounded to 1e-6; steps are a 1000th of a
    contact, and force jumps at its ends."""
    tool = pathlib.Path(lmp.LMP).parent / "lsdcd"
    text = subprocess.run([tool, "material", "grains.lsdcd", "glass"], cwd=folder, text=True, check=True,
                          stdout=subprocess.PIPE).stdout
    words = re.search(r"pair_coeff \* \* (.*)", text)[1]
    lmp.run_well(TWO_GRAINS.format(words=words), folder)
    before, after = (lmp.read_dump(folder / "out")[step][1][0] for step in (0, 10000))
    at_most("grains on one another: restitution of pair_style granular", abs(-after / before - 0.9), 1e-3)
