# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes that move against fix wall/gran/region with a region that moves: linear, rotate, variable.

A sphere bounces in a box that moves: each wall is a plane, and both codes evaluate the same formulas
in another order. The oracle is Debian's 29Sep2021 and, with the argument `host`, LAMMPS 4Jul2026
with our plugin loaded. LSDCD_QUICK=1 takes one law for motions without a turn.

LAMMPS takes the velocity of a region from a difference over a step: places of size 2, rounded to
2e-16, give 2e-12 of a velocity of size 1, and half a dozen bounces make at most twice as much
each, 1e-10 in all.

Where LAMMPS is wrong the test says so: see host_defects().
"""

import math

import pytest

import lmp
import stl
from facts import at_most, fact

SIDE = 1.5    # half of the box
PERIOD = 3.0
POINT, UNIT = "0.3 -0.2 0.1", f"{2 / 3!r} {-2 / 3!r} {1 / 3!r}"
WAY = "variable a equal 0.4*step*dt\nvariable b equal -0.3*step*dt\nvariable c equal 0.7*step*dt"
TURN = f"variable turn equal 2*PI*step*dt/{PERIOD}"
LAWS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
        "hooke/history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
        "granular": "granular hooke 1e4 5 tangential linear_nohistory 0.5 0.5 damping mass_velocity",
        "granular, history":
            "granular hooke 1e4 5 tangential linear_history 2857 0.5 0.5 damping mass_velocity"}
SCENE = lmp.head("-9 9 -9 9 -9 9") + """\
create_atoms    1 single {at} units box
set             atom 1 diameter 1.0 density 2.0
velocity        all set {v}
set             atom 1 omega {omega}
""" + lmp.pairs() + """\
fix             move all {move}
fix             pull all gravity 8.0 vector {down}
timestep        {dt}
{variables}
{wall}
dump            d all custom {every} out id x y z vx vy vz omegax omegay omegaz tqx tqy tqz
dump_modify     d format float %.17g
run             {steps}
"""
THROWN = {"at": "0.31 -0.42 0.25", "v": "1.0 -0.7 -1.3", "omega": "2.1 -3.3 1.7", "move": "nve/sphere",
          "down": "0.3 0.2 -1.0", "every": 10, "steps": 20000, "dt": 1e-4}
# The first bounces, before what is of second order in the step grows by those that follow.
BOUNCE, HALF = dict(THROWN, steps=5000), dict(THROWN, steps=10000, every=20, dt=5e-5)


class Box:
    def __init__(self, folder):
        self.folder = folder

    def run(self, wall, variables, scene):
        lmp.run_well(SCENE.format(variables=variables, wall=wall, **scene), self.folder)
        return lmp.read_dump(self.folder / "out")

    def ours(self, law, words, variables="", scene=THROWN):
        return self.run(f"fix wall all wall/lsdcd {law} mesh box.stl {words} log brief", variables, scene)

    def theirs(self, law, words, variables, scene=THROWN):
        return self.run(f"region walls block {-SIDE} {SIDE} {-SIDE} {SIDE} {-SIDE} {SIDE} units box {words}\n"
                        f"fix wall all wall/gran/region {law} region walls", variables, scene)


def cases():
    """Name, variables, words of motion, words of the region."""
    wave = "variable a equal 0.1*sin(9*step*dt)\nvariable c equal 0.2*(1-cos(7*step*dt))"
    yield "linear", WAY, "motion linear 0.4 -0.3 0.7", "move v_a v_b v_c"
    # Without velocities of its own: both take the difference over the step.
    yield "variable", wave, "motion variable v_a NULL v_c NULL NULL NULL", "move v_a NULL v_c"


def turning():
    yield "rotate", TURN, f"motion rotate {POINT} {UNIT} {PERIOD}", f"rotate v_turn {POINT} {UNIT}"
    yield ("transrot", f"{TURN}\n{WAY}", f"motion transrot 0.4 -0.3 0.7 {POINT} {UNIT} {PERIOD}",
           f"move v_a v_b v_c rotate v_turn {POINT} {UNIT}")


@pytest.fixture(scope="module")
def box(folder):
    stl.write(folder / "box.stl", stl.box((-SIDE,) * 3, (SIDE,) * 3))
    return Box(folder)


def test_compare(box):
    for name, law in lmp.sample(LAWS).items():
        for title, variables, words, region in cases():
            theirs, ours = box.theirs(law, region, variables), box.ours(law, words, variables)
            touching = sum(any(row[9:12]) for rows in theirs.values() for row in rows.values())
            fact(f"{name}, {title}: touches", touching > 50, str(touching))
            at_most(f"{name}, {title}: as fix wall/gran/region",
                    lmp.largest_difference(theirs, ours), 1e-10)


def apart(box, law, title_words, scene):
    """Where the sphere is in ours less where it is in theirs, a list per dumped step."""
    variables, words, region = title_words
    theirs, ours = box.theirs(law, region, variables, scene), box.ours(law, words, variables, scene)
    return [[a - b for a, b in zip(ours[step][1][:3], theirs[step][1][:3])] for step in sorted(ours)]


def test_compare_turning(box):
    """Where no velocity counts both agree; where it does they differ by the half step that LAMMPS's
    wall is ahead of the sphere, and by half as much with half the step. Springs: see host_defects()."""
    def largest(rows):
        return max(abs(x) for row in rows for x in row)

    for title, *words in turning():
        at_most(f"frictionless, {title}: as fix wall/gran/region",
                largest(apart(box, "hooke 1e4 NULL 0 NULL 0 1", words, THROWN)), 1e-10)
        for name in ("hooke", "granular"):
            whole, half = (apart(box, LAWS[name], words, scene) for scene in (BOUNCE, HALF))
            fact(f"{name}, {title}: differs by a half step", largest(whole) > 1e-6)
            left = [[2 * b - a for a, b in zip(*rows)] for rows in zip(whole, half)]
            at_most(f"{name}, {title}: by half as much with half the step",
                    largest(left) / largest(whole), 0.01)


def test_host_defects(box):
    """What both versions of LAMMPS have wrong with a region that moves, and we do not."""
    # The velocity is taken with the axis as it is given, and not its direction.
    law = LAWS["hooke"]
    one, long = (box.theirs(law, f"rotate v_turn {POINT} {axis}", TURN) for axis in (UNIT, "2 -2 1"))
    fact("LAMMPS turns faster about a longer axis", lmp.largest_difference(one, long) > 0.01)
    one, long = (box.ours(law, f"motion rotate {POINT} {axis} {PERIOD}") for axis in (UNIT, "2 -2 1"))
    # Directions that are rounded differ by 1e-16.
    at_most("here only its direction counts", lmp.largest_difference(one, long), 1e-10)

    # A sphere that does not spin is carried by a turntable. Its spring, stretched by m w^2 r/k_t away
    # from the axis, has to turn with it. Where it keeps its direction in the box, the sphere has to slip by w
    # times that length for it to turn, and is ahead by 2 pi m w^2/k_t after a turn.
    w, mass = 2 * math.pi / PERIOD, 2 * math.pi / 6
    carried = {"at": f"0.6 0.0 {-SIDE + 0.499}", "v": f"0 {0.6 * w!r} 0", "omega": "0 0 0", "move": "nve",
               "down": "0 0 -1", "every": 30000, "steps": 30000, "dt": 1e-4}
    law = "hooke/history 1e4 2857 5 200 10 1"

    def ahead(dump):
        x, y = dump[30000][1][:2]
        return math.atan2(y, x)

    slip = 2 * math.pi * mass * w**2 / 2857
    theirs = ahead(box.theirs(law, "rotate v_turn 0 0 0 0 0 1", TURN, carried))
    # Its spring is stretched after the first tenth of the time, during which it slips less.
    at_most("LAMMPS: springs do not turn with the wall", abs(theirs / slip - 1), 0.1)
    ours = ahead(box.ours(law, f"motion rotate 0 0 0 0 0 1 {PERIOD}", "", carried))
    # LAMMPS's velocities of half a step shift it by w dt/2 of the stretch over r, 3e-7.
    at_most("here they do", abs(ours), slip / 1000)
