# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Spheres on meshes that move, against closed forms: a period-one orbit on a floor that shakes, a straight
path over a floor that turns, and a pitch a turn in a screw."""

import math

import pytest

import lmp
import stl
from facts import at_most, fact

SCENE = """\
units           lj
atom_style      sphere
boundary        f f f
newton          off
comm_modify     vel yes
region          box block {box}
create_box      1 box
create_atoms    1 single {at} units box
set             atom 1 diameter 1.0 density 2.0
velocity        all set {v}
pair_style      zero 1.2
pair_coeff      * *
neighbor        0.3 bin
neigh_modify    delay 0 every 1 check yes
fix             move all nve/sphere
fix             pull all gravity 10.0 vector {down}
timestep        {dt!r}
{walls}
"""
MASS, G, RADIUS = 2 * math.pi / 6, 10, 0.5


def sheet(one, other):
    """Between two lines of as many points."""
    return [t for corners in zip(one, one[1:], other[1:], other) for t in stl.quad(*corners)]


@pytest.fixture(scope="module")
def folder(folder):
    (folder / "floor.stl").write_bytes((lmp.HERE / "scripts" / "floor.stl").read_bytes())
    return folder


def test_orbit_on_a_shaking_floor(folder):
    """A sphere that leaves and comes back with g T/2 has to be given (1 - e)/(1 + e) of that by the floor
    in each impact. It is stable where the floor rises and slows down: there its speed
    A w cos(phase) is that."""
    period, e, k, bounces = 1.0, 0.6, 1e6, 10
    w = 2 * math.pi / period
    amplitude = G / w**2    # between the bounds of stability, 0.79 and 1.32 of this for e = 0.6
    phase = math.acos(math.pi * G * (1 - e) / (amplitude * w**2 * (1 + e)))
    # e = exp(-gamma t/2) for a contact of t = pi/sqrt(k/m - gamma^2/4). Damping that begins within a
    # step changes e by gamma dt, which 400 steps a contact make 0.3 %.
    decay = -math.log(e) / math.pi
    gamma = 2 * decay * math.sqrt(k / MASS / (1 + decay**2))
    contact = -2 * math.log(e) / gamma
    steps = math.ceil(period / contact * 400)
    begin = round(phase / w / period * steps)    # on the orbit, just in touch
    dt = period / steps
    floor = amplitude * math.sin(w * begin * dt)
    text = SCENE.format(
        box="-3 3 -3 3 -2 9", at=f"0.31 0.22 {floor + RADIUS!r}", v=f"0 0 {G * period / 2!r}", down="0 0 -1",
        dt=dt, walls=f"""\
fix             wall all wall/lsdcd hooke {k!r} NULL {gamma!r} 0 0 0 mesh floor.stl motion wiggle 0 0 {amplitude!r} {period}
fix             still all setforce 0 0 0
velocity        all set 0 0 0
run             {begin}
unfix           still
velocity        all set 0 0 {G * period / 2!r}
variable        touch equal f_wall[7]
variable        when equal f_wall[7]*(step%{steps})*dt
run             {steps - begin}
fix             phase all ave/time 1 {steps} {steps} v_touch v_when file phases.txt
run             {bounces * steps}
""")
    lmp.run_well(text, folder)
    rows = [[float(x) for x in line.split()] for line in (folder / "phases.txt").open() if line[0] != "#"]
    fact(f"a shaking floor: {bounces} periods", len(rows) == bounces, str(len(rows)))
    lasts = [row[1] * period for row in rows]
    # Gravity and the floor's own acceleration lengthen the contact in the order of contact/period, 0.3 %;
    # it begins and ends within a step, 0.5 %.
    at_most("one impact in each", max(abs(t / contact - 1) for t in lasts), 0.02)
    middle = [w * row[2] / row[1] for row in rows if row[1]]
    # Within the contact the phase goes on by w contact, and with it what the floor gives.
    at_most("at the phase of the closed form", max(abs(p - phase) for p in middle), w * contact)
    at_most("and stays there", max(abs(p - middle[-1]) for p in middle[-5:]), w * contact)


def test_straight_over_a_turning_floor(folder):
    """Without friction a floor that leans and turns about its normal, along which gravity pulls, gives
    nothing along it: x = x0 + v t, whatever edges pass below."""
    lean = math.radians(30)
    e1, e2, n = (1, 0, 0), (0, math.cos(lean), math.sin(lean)), (0, -math.sin(lean), math.cos(lean))
    level = RADIUS - MASS * G / 1e5

    def words(a, b, c):
        return " ".join(repr(a * u + b * v + c * w) for u, v, w in zip(e1, e2, n))

    def along(x):
        return [sum(p * q for p, q in zip(x, e)) for e in (e1, e2, n)]

    text = SCENE.format(
        box="-9 9 -9 9 -9 9", at=words(-3.1, 0.7, level), v=words(2, -0.3, 0), down=words(0, 0, -1), dt=1e-4,
        walls=f"""\
fix             wall all wall/lsdcd hooke/history 1e5 NULL 0 NULL 0 0 mesh table.stl rotate 1 0 0 30 &
                motion rotate {words(0.5, 0.3, 0)} {words(0, 0, 1)} 0.7
dump            d all custom 1000 path id x y z omegax omegay omegaz
dump_modify     d format float %.17g
run             30000
""")
    cells = 60
    lines = [[(-9 + 18 * i / cells, -9 + 18 * j / cells, 0) for j in range(cells + 1)]
             for i in range(cells + 1)]
    stl.write(folder / "table.stl", [t for a, b in zip(lines, lines[1:]) for t in sheet(a, b)])
    lmp.run_well(text, folder)
    path = lmp.read_dump(folder / "path")
    off = [[abs(p - q) for p, q in zip(along(row[1][:3]), (-3.1 + 2 * step * 1e-4, 0.7 - 0.3 * step * 1e-4, level))]
           for step, row in path.items()]
    # Places of size 9 are rounded to 2e-15, and with them normals, on triangles of size 0.3, to 1e-14: of
    # a force of 10, for a time of 3, if all had the same sign 5e-13; ten times that for what a path is off
    # by its own rounding.
    at_most("a floor that turns: the path is straight", max(max(o[:2]) for o in off), 5e-12)
    at_most("it keeps its height", max(o[2] for o in off), 5e-12)
    at_most("and it does not spin", max(abs(w) for row in path.values() for w in row[1][3:6]), 0)


def test_pitch_a_turn(folder):
    """A helix that has made a turn is one that went on by its pitch, facets and all. Gravity leans a
    frictionless sphere against the blade; damping takes out how it began, and leaves small jumps over
    edges that are the same in each turn."""
    pitch, period, turns = 3.0, 4.0, 3

    def helix(r):
        return [(r * math.sin(math.pi * k / 20), pitch * k / 40, r * math.cos(math.pi * k / 20))
                for k in range(-120, 241)]

    stl.write(folder / "blade.stl", sheet(helix(0.5), helix(4.0)))
    # A groove along y below the axis, its sides square to each other.
    groove = [[(x, y, -4 + abs(x)) for x in (-3, 0, 3)] for y in (-12, 20)]
    stl.write(folder / "groove.stl", sheet(*groove))
    law = "hooke 1e5 NULL 400 0 0 0"
    text = SCENE.format(
        box="-9 9 -9 20 -9 9", at=f"0 {0.75 * pitch!r} {-4 + RADIUS * math.sqrt(2)!r}", v="0 0 0", down="0 -0.5 -1",
        dt=1e-4, walls=f"""\
fix             groove all wall/lsdcd {law} mesh groove.stl
fix             wall all wall/lsdcd {law} mesh blade.stl motion rotate 0 0 0 0 -1 0 {period}
variable        turn equal round({period}/dt)
dump            d all custom ${{turn}} path id x y z vy
dump_modify     d format float %.17g
variable        all equal {turns + 1}*${{turn}}
run             ${{all}}
""")
    lmp.run_well(text, folder)
    path = lmp.read_dump(folder / "path")
    y = [rows[1][1] for step, rows in sorted(path.items())][1:]
    # Its bounces on the blade end in the first turn, and swings with e^(-gamma t/2) in a hundredth of one.
    # Places of size 10 are rounded to 2e-15; the damping carries on what 1e4 steps make of that.
    for n, (a, b) in enumerate(zip(y, y[1:])):
        at_most(f"a screw carries by its pitch in turn {n + 2}", abs(b - a - pitch), 2e-11)
