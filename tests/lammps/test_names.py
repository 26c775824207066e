# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Numbers of fixes and computes under their names: `fix_modify ID names PREFIX NAME ...`."""

import re

import pytest

import lmp
import stl
from facts import fact

PAGES = lmp.HERE.parent.parent / "doc"

# A floor, a lid that a motion carries and that is called `lid`, and a paddle, which is a body: all that a wall may count.
TABLE = lmp.head("-3 3 -3 3 -1 5", types=2) + """\
lattice         sc 0.75 origin 0.5 0.5 0.4
region          heap block -2 2 -2 2 0.4 1.6 units box
create_atoms    1 region heap
set             group all diameter 1.0 density 2.0
set             atom 3*5 type 2
velocity        all create 0.5 4711
""" + lmp.pairs("granular/lsdcd", 0.3, coeff="hooke 1000 20 tangential linear_history 300 1 0.4 damping velocity") + """\
fix             move all nve/sphere
fix             fall all gravity 10 vector 0 0 -1
fix             w all wall/lsdcd granular hooke 1000 20 tangential linear_history 300 1 0.4 damping velocity mesh floor.stl &
                mesh lid.stl name lid motion linear 0 0 -0.5 mesh paddle.stl body density 1 joint hinge 0 0 0 0 0 1 wear archard 1e-5 1 energy &
                impacts 0.01 average 5
timestep        0.001
"""


def rows_of(page, first):
    """[(element, names)] of a page's table whose first row begins with `first`: 'scalar' is element 0."""
    text = (PAGES / f"{page}.rst").read_text(encoding="utf-8")
    begin = text.index(first)
    found = []
    for line in text[begin:].split("\n\n")[0].splitlines():
        row = re.match(r'\s*(scalar|\d+(?:-\d+)?), (?:"([^"]*)"|([^,]*)),', line)
        at = 0 if row[1] == "scalar" else int(row[1].split("-")[0])
        found += [(at + k if at else 0, name) for k, name in enumerate((row[2] or row[3]).split(", "))]
    return found


WALL = rows_of("wall_output", '1-3, "force_x')


def meshes(folder):
    stl.write(folder / "floor.stl", stl.sheet(2, lambda i, j: (-3 + 3 * i, -3 + 3 * j, 0)))
    stl.write(folder / "lid.stl", stl.sheet(2, lambda i, j: (-3 + 3 * i, -3 + 3 * j, 2)))
    stl.write(folder / "paddle.stl", stl.box((-0.1, -2.5, 0.1), (0.1, 2.5, 0.9)))


def both(folder, text, pairs, ranks=1):
    """Pairs of what a reference and a variable are after 300 steps, by the variable's name. In thermo output all digits of a variable are seen."""
    columns = " ".join(f"{reference} v_{variable}" for variable, reference in pairs)
    row = lmp.read_thermo(lmp.run_well(f"{text}thermo_style custom step {columns}\nthermo_modify format float %.17g norm no\nrun 300\n", folder, ranks))[-1]
    return {variable: tuple(row[1 + 2 * k:3 + 2 * k]) for k, (variable, _) in enumerate(pairs)}


@pytest.mark.parametrize("ranks", (1, 2))
def test_wall(folder, ranks):
    """All numbers of a wall, and all of two of its meshes, are the elements of the page's table, and most are not 0."""
    meshes(folder)
    have = [(at, name) for at, name in WALL if not 12 <= at <= 14 and not 36 <= at <= 40 and at < 75]
    pairs = [(f"w_{name}", f"f_w[{at}]" if at else "f_w") for at, name in have]
    pairs += [(f"lid_{name}", f"f_w[2][{at}]") for at, name in have if at]
    seen = both(folder, TABLE + "fix_modify w names w all\nfix_modify w mesh lid names lid all\n", pairs, ranks)
    fact("each is the element of the page", len(seen) == len(pairs) and all(a == b for a, b in seen.values()),
         [name for name, (a, b) in seen.items() if a != b])
    fact("and many are not 0", sum(a != 0 for a, _ in seen.values()) > 60, seen)


def test_asked_for(folder):
    """Only those are made that are asked for."""
    meshes(folder)
    out = lmp.run_well(TABLE + 'fix_modify w names mill power force_z\nprint "$(is_defined(variable,mill_power)) '
                       '$(is_defined(variable,mill_force_z)) $(is_defined(variable,mill_force_x)) end"\n', folder)
    fact("two of them", "1 1 0 end" in out, out[-300:])


def test_go_with_the_fix(folder):
    meshes(folder)
    out = lmp.run_well(TABLE + 'fix_modify w names w all\nunfix w\nprint "$(is_defined(variable,w_power)) end"\n', folder)
    fact("the variables go with the fix", "0 end" in out, out[-300:])
    out = lmp.run_well(TABLE + 'fix_modify w names w all\nclear\nprint "$(is_defined(variable,w_power)) end"\n', folder)
    fact("and with clear", "0 end" in out, out[-300:])


@pytest.mark.parametrize("words, says", (
    ("names w forse_z", "in 'names', there is no number 'forse_z': the nearest is 'force_z'"),
    ("names w servo_push", "the wall needs 'servo' for it"),
    ("names w power power", "'power' stands twice"),
    ("names w", "PREFIX and NAME are missing"),
    ("names w-1 power", "the prefix 'w-1' cannot begin the name of a variable"),
    ("names taken power", "there is a variable 'taken_power' already"),
    ("names taken force_z power", "there is a variable 'taken_power' already"),
    ("mesh lit names w power", "or its name, not 'lit': the nearest is 'lid'"),
    ("mesh 4 names w power", "from 1 to 3, or its name, not '4'"),
    ("mesh 2 names w elastic_energy", "'elastic_energy' is of all meshes together"),
    ("mesh lid", "motion ..., servo ..., body ... or names ... must follow")))
def test_refused(folder, words, says):
    meshes(folder)
    lmp.refused(words, TABLE + "variable taken_power equal 1\nfix_modify w " + words + "\n", folder, says)


@pytest.mark.parametrize("name, says", (("2", "the name of a mesh is no number"), ("lid", "meshes 2 and 3 have the same name 'lid'")))
def test_name_refused(folder, name, says):
    meshes(folder)
    lmp.refused(name, TABLE.replace("mesh paddle.stl", f"mesh paddle.stl name {name}"), folder, says)


def test_named_mesh_is_changed(folder):
    """A motion by the mesh's name, or its file's, is that by its number."""
    meshes(folder)
    ends = []
    for mesh in ("2", "lid"):
        out = lmp.run_well(TABLE + f'fix_modify w mesh {mesh} motion linear 0 0 1\nrun 100\nprint "END $(f_w[2][50]:%.17g)"\n', folder)
        ends.append(re.search(r"^END (\S+)$", out, re.M)[1])
    fact("the same place", ends[0] == ends[1] and float(ends[0]) > 0, ends)


def test_energy(folder):
    """Those of compute lsdcd/energy, with its scalar."""
    meshes(folder)
    pairs = [(f"all_{name}", f"c_books[{at}]" if at else "c_books") for at, name in rows_of("compute_lsdcd_energy", '1-5, "dissipated_power_damping')]
    seen = both(folder, TABLE + "compute books all lsdcd/energy names all all\n", pairs)
    fact("each is the element of the page", len(seen) == 25 and all(a == b for a, b in seen.values()), seen)
    lmp.refused("another word", TABLE + "compute books all lsdcd/energy name b all\n", folder, "compute ID all lsdcd/energy [names PREFIX NAME ...]")


def test_massflow(folder):
    meshes(folder)
    script = TABLE + "fix through all massflow/lsdcd mesh floor.stl move 0 0 1.5\nfix_modify through names flow all\nfix_modify through type 2 names two all\n"
    table = rows_of("fix_massflow_lsdcd", "1, forward,")
    pairs = [(f"flow_{name}", f"f_through[{at}]") for at, name in table] + [(f"two_{name}", f"f_through[2][{at}]") for at, name in table[:4]]
    seen = both(folder, script, pairs)
    fact("each is the element of the page", len(seen) == 12 and all(a == b for a, b in seen.values()), seen)
    fact("something has passed", seen["flow_forward"][0] + seen["flow_backward"][0] > 0, seen)
    lmp.refused("a type that there is not", script + "fix_modify through type 3 names x all\n", folder, "from 1 to 2")
    lmp.refused("a number that there is not", script + "fix_modify through names x mass\n", folder, "there is no number 'mass'")


def test_insertion(folder):
    meshes(folder)
    script = TABLE + "region free block -2 2 -2 2 3.2 4 units box\nfix in all insert/lsdcd region free diam one 0.5 dens 2 numberrate 50 number 20 seed 7\n" \
        "fix_modify in names in all\n"
    pairs = [(f"in_{name}", f"f_in[{at}]") for at, name in rows_of("fix_insert_lsdcd", "1, inserted,")]
    seen = both(folder, script, pairs)
    fact("each is the element of the page", len(seen) == 7 and all(a == b for a, b in seen.values()) and seen["in_inserted"][0] > 0, seen)


def test_collide(folder):
    meshes(folder)
    script = TABLE.replace("fix             move all nve/sphere\n", "") + "compute hit all lsdcd/collide w mesh paddle.stl move 0 0 -0.5 names hit all\n"
    pairs = [(f"hit_{name}", f"c_hit[{at}]" if at else "c_hit") for at, name in rows_of("compute_lsdcd_collide", "1, pairs,")[:4]]
    seen = both(folder, script, pairs)
    fact("each is the element of the page", len(seen) == 4 and all(a == b for a, b in seen.values()), seen)
