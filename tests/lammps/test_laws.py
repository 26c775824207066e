# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Numbers of the contact law by mesh and by atom type: against LAMMPS's planes, fixes of their own, and
closed forms. Tolerances are those of test_several_meshes.py, where not said otherwise. LSDCD_QUICK=1 takes one law for numbers by mesh.
"""

import math

import lmp
import stl
from plates import DUMP, FACES, FORCES, LAWS, SIDE, go, planes, six, write_box, write_plate
from facts import at_most, fact

# Other numbers of the same styles.
OTHERS = {"hooke": "hooke 4e4 NULL 90 NULL 0.1 1",
          "hooke_history": "hooke/history 4e4 2e4 90 NULL 0.1 1",
          "hertz_history": "hertz/history 3e5 NULL 900 NULL 0.1 1"}
STILL = {"kick": "", "dt": 1e-9}


def prepare(folder):
    write_box(folder)
    write_halves(folder)


def test_by_mesh(folder):
    for name, law in lmp.sample(LAWS).items():
        other = OTHERS[name]
        theirs = go(folder, planes(law).replace(f"{law} zplane {-SIDE}", f"{other} zplane {-SIDE}"), "a",
                    1500, every=50)[0]
        ours = go(folder, six(law, {"zlo": f"law {other}"}), "b", 1500, every=50)[0]
        at_most(f"{name}: a plate with its own numbers is such a plane",
                lmp.largest_difference(theirs, ours), 1e-12)
    same = go(folder, six(law), "c", 1500, every=50)[0]
    differ = go(folder, six(law, {"zlo": f"law {other}"}), "b", 1500, every=50)[0]
    fact("the numbers matter", lmp.largest_difference(same, differ) > 1e-3)


def grains():
    """The gas of plates.py, every other grain of type 2."""
    from plates import FAST, GAS
    lines = [line.replace("create_atoms 1", f"create_atoms {1 + k % 2}") for k, line in enumerate(GAS.split("\n"))]
    return {"types": 2, "atoms": "\n".join(lines), "kick": FAST + "\ngroup one type 1\ngroup two type 2"}


def test_by_type(folder):
    """Each type has its numbers with each mesh; groups with fixes of their own are the oracle."""
    on_floor = {"hooke_history": "hooke/history 7e4 NULL 10 NULL 0.9 1",
                "hertz_history": "hertz/history 7e5 NULL 100 NULL 0.9 1"}
    for name in ("hooke_history", "hertz_history"):
        law, other, floor = LAWS[name], OTHERS[name], on_floor[name]
        one = six(law, {face: f"law types 2 {other}" for face in FACES}
                  | {"zlo": f"law types 2* {other} law {floor}"})
        two = six(law, {"zlo": f"law {floor}"}).replace("wall all", "a one") + "\n" + \
            six(other).replace("wall all", "b two")
        for ranks in (1, 2) if name == "hertz_history" else (1,):
            ours = go(folder, one, "a", 1000, every=50, ranks=ranks, **grains())[0]
            theirs = go(folder, two, "b", 1000, every=50, ranks=ranks, **grains())[0]
            at_most(f"{name}, {ranks} ranks: types are groups with fixes of their own",
                    lmp.largest_difference(theirs, ours), 1e-12)
    single = go(folder, f"fix w all wall/lsdcd {law} mesh zlo.stl law types 2 {other}", "a", 1000, every=50,
                **grains())[0]
    apart = go(folder, f"fix a one wall/lsdcd {law} mesh zlo.stl\nfix b two wall/lsdcd {other} mesh zlo.stl",
               "b", 1000, every=50, **grains())[0]
    at_most("types with one mesh", lmp.largest_difference(apart, single), 1e-12)


def test_with_adhesion(folder):
    """Cutoffs differ by mesh and type."""
    law = "granular jkr 1e5 0 0.3 {} damping velocity tangential mindlin NULL 0 0.5 rolling sds 1e3 0 0.1"
    weak, strong = law.format("5"), law.format("60")
    one = six(weak, {"zlo": f"law {strong}", "xlo": f"law types 2 {strong}"})
    ones = " ".join(f"mesh {name}.stl" for name in FACES if name != "zlo")
    twos = " ".join(f"mesh {name}.stl" for name in FACES if name not in ("zlo", "xlo"))
    two = "\n".join([f"fix a all wall/lsdcd {strong} mesh zlo.stl", f"fix b one wall/lsdcd {weak} {ones}",
                     f"fix c two wall/lsdcd {weak} {twos}", f"fix d two wall/lsdcd {strong} mesh xlo.stl"])
    ours = go(folder, one, "a", 1000, every=50, **grains())[0]
    theirs = go(folder, two, "b", 1000, every=50, **grains())[0]
    at_most("jkr: meshes and types are fixes of their own", lmp.largest_difference(theirs, ours), 1e-12)


def write_halves(folder):
    write_plate(folder / "left.stl", 2, 0.0, (-SIDE, -SIDE), (0.0, SIDE))
    write_plate(folder / "right.stl", 2, 0.0, (0.0, -SIDE), (SIDE, SIDE))


def test_at_the_seam(folder):
    """A sphere stands on one of the two plates that meet at x = 0: k (R - h) with that plate's k."""
    halves = "mesh left.stl mesh right.stl law"
    roll = {"atoms": "create_atoms 1 single -0.02 0.11 0.499 units box", "kick": "velocity all set 4.0 0 0"}
    for name, style in (("hooke", "hooke {} NULL 0 0 0 0"), ("hooke/history", "hooke/history {} 0 0 0 0 0")):
        path = go(folder, f"fix w all wall/lsdcd {style.format(1e4)} {halves} {style.format(3e4)}", "a", 100,
                  **roll)[0]
        off = max(abs(row[1][11] - (1e4 if row[1][0] < 0 else 3e4) * max(0.5 - row[1][2], 0))
                  for row in path.values())
        fact(f"seam, {name}: it crosses", path[0][1][0] < -0.01 and path[100][1][0] > 0.01)
        # k times the rounding of R - h, of order 1.
        at_most(f"seam, {name}: the numbers are those of the plate below", off, 3e4 * 1e-12)
    # A spring of length s is carried over: the force before is kt s, and after it the other kt's.
    style = "hooke/history 1e4 {} 0 0 1e4 0"
    path = go(folder, f"fix w all wall/lsdcd {style.format(1e3)} {halves} {style.format(2e3)}", "a", 120,
              atoms="create_atoms 1 single -0.00101 0.11 0.499 units box", kick="velocity all set 1.0 0 0",
              dt=2e-5)[0]
    at = next(step for step in path if path[step][1][0] > 0)
    springs = [-path[at - 1][1][9] / 1e3, -path[at][1][9] / 2e3]
    slip = 2e-5 * 1.0
    fact("seam: there is a spring", springs[0] > 5e-4, f"{springs}")
    at_most("seam: it is carried over", abs(springs[1] - springs[0]), 1.01 * slip)


def write_half_fold(path, side):
    """A plate from the line x = 0, z = 0 up, at 5 degrees."""
    slope = math.tan(math.radians(5))
    up = side * SIDE, SIDE * slope
    stl.write(path, stl.quad((0, -SIDE, 0), (up[0], -SIDE, up[1]), (up[0], SIDE, up[1]), (0, SIDE, 0)))


def test_in_a_fold(folder):
    """Over the fold of two plates both carry the same share; each has its own stiffness."""
    write_half_fold(folder / "up_left.stl", -1)
    write_half_fold(folder / "up_right.stl", 1)
    law = "hooke {} NULL 0 0 0 0"
    where = {"atoms": "create_atoms 1 single 0 0.11 0.501 units box", "box": "-4 4 -4 4 -4 4", **STILL}
    force = {}
    for left, right in ((1e4, 1e4), (1e4, 3e4)):
        force[right] = go(folder, f"fix w all wall/lsdcd {law.format(left)} mesh up_left.stl mesh up_right.stl "
                          f"law {law.format(right)}", "a", 0, **where)[0][0][1][9:12]
    both = force[1e4][2]
    fact("fold: it is felt", both > 1, f"{both}")
    # Each half is (both/2) (tan a, 1) at a stiffness of 1e4; rounding as above, of overlaps of 1e-3.
    across = (1 - 3) * both / 2 * math.tan(math.radians(5))
    at_most("fold: along the axis", abs(force[3e4][2] / (2 * both) - 1), 1e-11)
    at_most("fold: across", abs(force[3e4][0] / across - 1), 1e-11)


def test_checks_of_timestep(folder):
    """The stiffest contact that a sphere can have counts: 1e-3 resolves 1e3, not 1e7."""
    words = {"atoms": "create_atoms 1 single 0 0 1 units box", "types": 2, "kick": "", "dt": 1e-3}
    soft, stiff = "hooke 1e3 NULL 0 0 0 0", "hooke 1e7 NULL 0 0 0 0"
    for name, more, warned in (("no other law", "", False), ("the mesh's", f"law {stiff}", True),
                               ("type 1's", f"law types 1 {stiff}", True),
                               ("that of a type of no atom", f"law types 2 {stiff}", False)):
        text = go(folder, f"fix w all wall/lsdcd {soft} mesh zlo.stl {more}", "a", 0, **words)[1]
        fact(f"timestep: {name}", ("more than a tenth of the shortest contact time" in text) == warned)


def test_restart(folder):
    law, other = LAWS["hertz_history"], OTHERS["hertz_history"]
    walls = six(law, {"zlo": f"law {other}", "xlo": f"law types 2 {other}"})
    more = "run 700\nwrite_restart half"
    words = grains()
    whole = go(folder, walls, "a", 600, every=20, more=more, **words)[0]
    again = lmp.head() + "read_restart half\n" + FORCES.format(walls=walls, dt=1e-4, more="") + DUMP.format(every=20, name="b") + "run 600\n"
    text = lmp.run_well(again, folder)
    half = lmp.read_dump(folder / "b")
    fact("restart: the same bits", half == {s: whole[s] for s in half} and len(half) == 31)
    fact("restart: nothing is dropped", "springs" not in "".join(
        line for line in text.split("\n") if "WARNING" in line))
