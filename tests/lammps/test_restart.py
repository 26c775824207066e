# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A run continued from a restart file in mid-slide equals the unbroken one.

LAMMPS evaluates forces once more where a run begins, with velocities of the full
step; damping sees the difference, so a run in two pieces is compared with the same
two pieces through a file (equal to the last bit), and a run in one piece only
without damping (equal but for rounding of the repeated evaluation).
"""

import re
import struct

import pytest

import lmp
import scene
from facts import at_most, fact

LAWS = {"hooke_history": "hooke/history 1e4 NULL 120 NULL 0.4 1",
        "hertz_history": "hertz/history 1e5 NULL 1500 NULL 0.4 1",
        "granular": scene.GRANULAR,
        "yielding": scene.YIELDING,
        "mindlin_slip": "granular hooke 1e4 120 damping mass_velocity tangential mindlin_slip 2e4 0.6 0.4",
        "hooke": "hooke 1e4 NULL 120 NULL 0.4 1"}
UNDAMPED = "hooke/history 1e4 NULL 0 NULL 0.4 0"
UNDAMPED_SIDES = "hooke 1e4 NULL 1e-300 NULL 0 0"    # 0 is not a number to LAMMPS 4Jul2026
FIRST, SECOND = 700, 400


# On two processes the first one has a sphere in the air, and the other one those on the floor.
FEW = scene.SETTINGS + f"""\
processors      * 1 1
region          box {scene.BOX}
create_box      1 box
create_atoms    1 single -4 0 7 units box
""" + "".join(f"create_atoms 1 single {x} {y} 0.6 units box\n" for x in (1, 3) for y in (-2, 0, 2)) + """\
set             group all diameter 1.0 density 2.0
velocity        all set 0.5 0.3 0
"""


def write(law, folder, ranks=1, name="two", create=scene.CREATE, **more):
    lmp.run_well(create + scene.forces(law, **more) + f"run {FIRST}\nwrite_restart {name}.restart\n" +
                 scene.dump(name, 50) + f"run {SECOND}\n", folder, ranks)
    return lmp.read_dump(folder / name)


def proceed(law, folder, ranks=1, restart="two.restart", name="continued", steps=SECOND, **more):
    text = lmp.run_well(scene.SETTINGS + f"read_restart {restart}\n" + scene.forces(law, **more) +
                        scene.dump(name, 50) + f"run {steps}\n", folder, ranks)
    return lmp.read_dump(folder / name), text


def told(law, folder, restart="two.restart"):
    """What is said where a run goes on."""
    return proceed(law, folder, restart=restart, steps=0)[1]


prepare = scene.bumpy_floor


def test_rows(folder):
    """Rows of restart data are as wide as the atom with most contacts on any process needs."""
    law = LAWS["hooke_history"]
    two = write(law, folder, 2, "few", FEW)
    touching = {atom for atom, row in two[FIRST].items() if row[9] > 0}
    fact("rows: only the second process has contacts", touching and 1 not in touching, str(touching))
    for ranks in (1, 2):
        continued = proceed(law, folder, ranks, "few.restart")[0]
        at_most(f"rows: written so on 2 ranks, read on {ranks}",
                lmp.largest_difference(two, continued), 0)


def test_kinds(folder):
    """Springs go on where their numbers are what they were."""
    def law(tangential):
        return f"granular hertz 1e5 700 tangential {tangential} 1e4 0.6 0.4"

    write(law("mindlin/force"), folder, name="kind", create=FEW)
    text = told(law("mindlin"), folder, "kind.restart")
    fact("kinds: a force is not taken for a displacement", "6 atoms lose their springs: the restart "
         "file was written with a different contact law" in text)
    write(law("mindlin"), folder, name="kind", create=FEW)
    text = told(law("linear_history"), folder, "kind.restart")
    fact("kinds: a displacement is one in any law", "lose their springs" not in text)


def test_meshes(folder):
    """A mesh is that of the file where all of it is, however often it has as many triangles."""
    law = LAWS["hooke_history"]
    write(law, folder, name="mesh", create=FEW)
    scene.write_floor(folder / "floor.stl", side=6.49)
    text = told(law, folder, "mesh.restart")
    fact("meshes: springs of another one with as many triangles are dropped", "6 atoms lose their "
         "springs: the restart file was written with a different mesh" in text)
    scene.write_floor(folder / "floor.stl")


STATES = {    # fix: what another ID begins without
    "wall": "springs, motion, loads and wear",
    "in": "what was inserted",
    "flow": "what has passed",
}


def test_unusable_data(folder):
    """Data of a later version, and damaged ones, are refused by the fix that they are of, with what to do. Behind the mark are the
    version and a checksum."""
    fixes = scene.forces(LAWS["hooke_history"]) + "region air block -5 5 -5 5 5 7 units box\n" + \
        "fix in all insert/lsdcd region air diam one 0.5 dens 1 number 5\nfix flow all massflow/lsdcd mesh floor.stl move 0 0 3\n"
    lmp.run_well(FEW + fixes + "run 10\nwrite_restart good.restart\n", folder)
    good = (folder / "good.restart").read_bytes()
    marks = [m.start() for m in re.finditer(re.escape(struct.pack("<d", -0x4c5344434453)), good)]
    fact("each fix has data", len(marks) == len(STATES), str(marks))
    for (fix, without), at in zip(STATES.items(), marks):
        for number, says in ((1, "are of a later version"), (2, "are damaged")):
            place = at + 8 * number
            (folder / "bad.restart").write_bytes(good[:place] + struct.pack("<d", 99) + good[place + 8:])
            lmp.refused(f"{fix}: {says}", scene.SETTINGS + "read_restart bad.restart\n" + fixes + "run 0\n", folder, f"Fix {fix} ",
                        f"the restart file cannot be used: the data of the", says, f"give the fix another ID to begin without {without}")


def test_damaged_rows(folder):
    """Rows of atoms have no checksum: LAMMPS packs them. What a row says of its sizes is believed only where it fits in what was read,
    and is what the fix can have written. The rows of a sphere on the floor are [9, one spring, seven numbers] and [2, its marks]."""
    fixes = scene.forces(LAWS["hooke_history"]) + "fix flow all massflow/lsdcd mesh floor.stl move 0 0 3 count once\n"
    lmp.run_well(FEW + fixes + "run 300\nwrite_restart good.restart\n", folder)
    good = (folder / "good.restart").read_bytes()
    at = good.find(struct.pack("<2d", 9, 1))
    fact("a sphere has a spring in the file", at > 0 and good[at + 72:at + 80] == struct.pack("<d", 2))
    springs, marks = "Fix wall wall/lsdcd: the springs of atom", "Fix flow massflow/lsdcd: the marks of atom"
    nan = float("nan")
    for number, value, says in (
            *((0, size, springs) for size in (0, -9, 8, 9.5, 1e9, -1e300, nan)), (0, 10, marks),
            *((1, count, springs) for count in (0, -1, 2, 1.5, 1e300, nan)), (2, -1, springs), (2, 0.5, springs), (2, 1e300, springs),
            (5, nan, springs), (9, 3, marks), (9, nan, marks), (10, 4, marks), (10, -1, marks), (10, 0.5, marks), (10, nan, marks)):
        place = at + 8 * number
        (folder / "bad.restart").write_bytes(good[:place] + struct.pack("<d", value) + good[place + 8:])
        lmp.refused(f"number {number} of a row is {value}", scene.SETTINGS + "read_restart bad.restart\n" + fixes + "run 0\n", folder,
                    says, "in the restart file are damaged: give the fix another ID to begin without")


@pytest.mark.parametrize("name", LAWS)
def test_continued(folder, name):
    two = write(LAWS[name], folder)
    touching = sum(row[9] > 0 for row in two[FIRST].values())
    fact("spheres touch where it breaks", touching > 20, str(touching))
    continued, text = proceed(LAWS[name], folder)
    at_most("continued as in one input", lmp.largest_difference(two, continued), 0)
    # LAMMPS says so when it hands restart data to a fix.
    fact("springs in the file only where there are any", ("Resetting peratom fix info" in text) == (name != "hooke"))


def test_other_ranks_laws_and_meshes(folder):
    law = LAWS["hooke_history"]
    two = write(law, folder)
    for ranks in (2, 4):
        at_most(f"written on 1 rank, read on {ranks}",
                lmp.largest_difference(two, proceed(law, folder, ranks)[0]), 0)
    spread = write(law, folder, 4, "spread")
    at_most("written on 4 ranks, read on 1",
            lmp.largest_difference(spread, proceed(law, folder, 1, "spread.restart")[0]), 0)

    text = told(LAWS["hooke"], folder)
    fact("springs in the file do not disturb a style without them", "ERROR" not in text)

    text = told(scene.GRANULAR, folder)
    fact("another law: what it does not know is dropped with a warning",
         "lose their springs: the restart file was written with a different contact law" in text)

    # Springs of another mesh are dropped with a warning, not followed.
    scene.write_floor(folder / "floor.stl", cells=4)
    text = told(law, folder)
    fact("another mesh: springs are dropped with a warning", "lose their springs" in text)
    scene.write_floor(folder / "floor.stl")


def test_undamped(folder):
    """Settled with damping, then without it: in one piece, and in two through a file."""
    write(LAWS["hooke_history"], folder)
    begin = scene.SETTINGS + "read_restart two.restart\n" + scene.forces(UNDAMPED, sides=UNDAMPED_SIDES)
    lmp.run_well(begin + scene.dump("one", 50) + f"run {FIRST + SECOND}\n", folder)
    # With the same dump: LAMMPS 4Jul2026 with Kokkos rounds a step without output otherwise.
    lmp.run_well(begin + scene.dump("first", 50) + f"run {FIRST}\nwrite_restart later.restart\n",
                 folder)
    continued = proceed(UNDAMPED, folder, restart="later.restart", sides=UNDAMPED_SIDES)[0]
    one = {s: rows for s, rows in lmp.read_dump(folder / "one").items() if s >= 2 * FIRST}
    touching = sum(row[9] > 0 for row in one[2 * FIRST].values())
    fact("undamped: spheres touch where it breaks", touching > 20, str(touching))
    # 400 steps of contacts that part neighbouring paths: a factor of 1e2 on 1e-16 at most, and ten times as much.
    at_most("undamped: continued as unbroken", lmp.largest_difference(one, continued), 1e-13)
