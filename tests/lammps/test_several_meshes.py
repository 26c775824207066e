# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Several meshes in one fix: against LAMMPS's planes, against one mesh, and against closed forms.

Both codes evaluate the same formulas in another order: 1e-12 leaves room for 10^4 operations, see
test_parity.py. LSDCD_QUICK=1 takes one law.
"""

import lmp
from plates import LAWS, SIDE, SMOOTH, go, planes, six, write_box, write_plate
from facts import at_most, fact


def among_sides(dump):
    """How often a sphere touches two sides at once, and three."""
    near = [sum(abs(x) > SIDE - 0.5 for x in row[:3]) for rows in dump.values() for row in rows.values()]
    return sum(n > 1 for n in near), sum(n > 2 for n in near)


def prepare(folder):
    write_box(folder)
    write_halves(folder)


def test_compare_with_planes(folder):
    """In a corner of a box plates meet at right angles, and their forces add."""
    for name, law in lmp.sample(LAWS).items():
        theirs = go(folder, planes(law), "a", 3000, every=50)[0]
        ours = go(folder, six(law), "b", 3000, every=50)[0]
        at_most(f"{name}: six plates are six planes", lmp.largest_difference(theirs, ours),
                1e-12)
        rubs = "wiggle z 0.02 0.1"
        theirs = go(folder, planes(law, rubs), "a", 3000, every=20)[0]
        ours = go(folder, six(law, {"zlo": rubs}), "b", 3000, every=20)[0]
        at_most(f"{name}: one of them wiggles", lmp.largest_difference(theirs, ours), 1e-12)
    edges, corners = among_sides(ours)
    fact("spheres are in edges and corners of the box", edges > 20 and corners > 0,
         f"{edges}, {corners} times")
    theirs = go(folder, planes(LAWS["hooke_history"], "shear x 2.0"), "a", 3000, every=50)[0]
    ours = go(folder, six(LAWS["hooke_history"], {"zlo": "shear x 2.0"}), "b", 3000, every=50)[0]
    at_most("one of them is a belt", lmp.largest_difference(theirs, ours), 1e-12)


# Two plates of a floor whose rims coincide along x = 0.
def write_halves(folder):
    write_plate(folder / "left.stl", 2, 0.0, (-SIDE, -SIDE), (0.0, SIDE))
    write_plate(folder / "right.stl", 2, 0.0, (0.0, -SIDE), (SIDE, SIDE))
    write_plate(folder / "whole.stl", 2, 0.0)


HALVES = "mesh left.stl mesh right.stl"
ROLL = {"atoms": "create_atoms 1 single -0.6 0.11 0.499 units box",
        "kick": "velocity all set 5.0 0.3 0\nset group all omega 0.2 9.0 -0.3",
        "more": "fix pull all gravity 20.0 vector 0 0 -1"}


def test_corner_sum_at_a_seam(folder):
    """A sphere beside the common rim of two plates: with corner sum both push, which the log tells of."""
    beside = {"atoms": "create_atoms 1 single 1e-6 0.11 0.499 units box", "kick": "", "dt": 1e-9}
    # Beside the rim its overlap is less by x^2/(2 h), 1e-12 of 1e-3.
    for words, times in ((f"{HALVES} corner sum", 2), ("mesh whole.stl corner sum", 1), (HALVES, 1)):
        dump, text = go(folder, f"fix wall all wall/lsdcd {SMOOTH} {words}", "b", 0, **beside)
        at_most(f"{words}: {times} times the force", abs(dump[0][1][11] / (times * 1e4 * 0.001) - 1), 1e-8)
        fact(f"{words}: warned of {times - 1} times",
             text.count("with corner sum both meshes push a sphere over a seam") == times - 1)


def test_gate(folder):
    """The right half slides away in its own plane."""
    away = "motion linear 3.0 0 0"
    walls = f"fix wall all wall/lsdcd {{}} {HALVES} {away}"
    # Without friction the floor's motion along itself is not felt.
    still = {"atoms": "create_atoms 1 single -0.01 0.11 0.499 units box", "kick": "",
             "more": ROLL["more"]}
    one = go(folder, f"fix wall all wall/lsdcd {SMOOTH} mesh whole.stl", "a", 2000, **still)[0]
    two = go(folder, walls.format(SMOOTH), "b", 2000, **still)[0]
    at_most("gate: a smooth sphere beside its rim feels nothing",
            lmp.largest_difference(one, two), 1e-11)
    # Over the gate it is carried along: a plane of wall/gran with the same speed.
    for name, law in lmp.sample(LAWS).items():
        on = dict(still, atoms="create_atoms 1 single 1.0 0.11 0.499 units box")
        theirs = go(folder, lmp.flat_walls(f"fix wall all wall/gran {law} zplane 0 NULL shear x 3.0"), "a", 2000, **on)[0]
        ours = go(folder, walls.format(law), "b", 2000, **on)[0]
        at_most(f"gate, {name}: what lies on it is carried along",
                lmp.largest_difference(theirs, ours), 1e-12)


def test_periodic(folder):
    """A floor that repeats at rest, and a paddle that moves above it, away from the faces."""
    write_plate(folder / "paddle.stl", 0, 0.0, (-1.0, 0.2), (1.0, 2.0))
    box, law = "-3 3 -3 3 -1 5", LAWS["hooke_history"]
    where = {"box": box, "boundary": "p p f", "kick": "velocity all set 8 0 -4",
             "atoms": "create_atoms 1 single 2.0 0.11 1.0 units box\n"
                      "create_atoms 1 single 2.0 2.2 1.2 units box"}
    floor = "mesh zlo.stl move 0 0 3"
    theirs = go(folder, lmp.flat_walls(f"fix wall all wall/gran {law} zplane 0 NULL"), "a", 5500, **where)[0]
    ours = go(folder, f"fix wall all wall/lsdcd {law} {floor} mesh paddle.stl "
                      "motion rotate 0 0 0 0 0 1 0.8", "b", 5500, **where)[0]
    hit = [step for step in ours if max(abs(ours[step][1][k] - theirs[step][1][k]) for k in range(3)) > 1e-9]
    fact("periodic: the paddle hits", bool(hit))
    before = {s: rows for s, rows in ours.items() if not hit or s < hit[0] - 200}
    fact("periodic: spheres cross before it",
         any(abs(before[s][1][0] - before[s - 1][1][0]) > 1 for s in before if s - 1 in before))
    theirs = {s: theirs[s] for s in before}
    at_most("periodic: and roll on the floor until then", lmp.largest_difference(theirs, before),
            1e-12)


def test_types_change_in_a_run(folder):
    """A grain that fix set gives another type has the law of that type in the next step, whatever lists there are, and so has one of the
    command set in a run that has no setup."""
    lmp.flat_floor(folder)
    for every in (1, 1000):
        for steps in (1, 5):
            text = lmp.head("-3 3 -3 3 -1 5", types=2) + f"""\
create_atoms 1 single 0.3 0.2 0.49
set group all diameter 1 density 1
pair_style zero 1.2
pair_coeff * *
neigh_modify delay 0 every {every} check no
{lmp.set_in_run(steps, 1, 1, type="1+(step>=5)")}fix i all nve/noforce
fix w all wall/lsdcd hooke 1000 NULL 0 NULL 0 1 mesh floor.stl law types 2 hooke 2000 NULL 0 NULL 0 1
timestep 1e-4
thermo 1
thermo_style custom step f_w[3]
run 12
"""
            first = lmp.read_thermo(lmp.run_well(text, folder))
            second = lmp.read_thermo(lmp.run_well(text + "unfix change\nset group all type 1\nrun 3 pre no\n", folder))[1:]
            fact("all steps", len(first) == 13 and len(second) == 3, str((first, second)))
            for step, force in first + second:
                # Fix set acts at the end of step 5.
                stiffness = 2000 if 5 < step <= 12 else 1000
                at_most(f"lists each {every}, set each {steps}, step {step:g}", abs(force + stiffness * 0.01), 1e-10)


def test_radii_change_in_a_run(folder):
    """A grain that fix set makes wider touches the wall in the next step, whatever lists there are, and however far it was away."""
    lmp.flat_floor(folder)
    for every in (1, 1000):
        for steps in (1, 5):
            text = lmp.head("-3 3 -3 3 -1 5") + f"""\
create_atoms 1 single 0.3 0.2 0.6
set group all diameter 0.2 density 1
pair_style zero 1.2
pair_coeff * *
neigh_modify delay 0 every {every} check no
{lmp.set_in_run(steps, 1, 1, diameter="0.2+0.1*step")}fix i all nve/noforce
fix w all wall/lsdcd hooke 1000 NULL 0 NULL 0 1 mesh floor.stl
timestep 1e-4
thermo 1
thermo_style custom step f_w[3]
run 16
"""
            rows = lmp.read_thermo(lmp.run_well(text, folder))
            fact("all steps", len(rows) == 17, str(rows))
            for step, force in rows[1:]:
                # Fix set acts at the end of a step.
                overlap = max(0, 0.1 + 0.05 * ((step - 1) // steps * steps) - 0.6)
                at_most(f"lists each {every}, set each {steps}, step {step:g}", abs(force + 1000 * overlap), 1e-10)
