# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Clumps, bodies of overlapping spheres that fix rigid/small moves, at a mesh: against LAMMPS's plane, balances of
momentum and closed forms.
"""

import math
import os
import re

import command
import lmp
import stl
from facts import at_most, fact
from triangles import cube

R, DENSITY, G = 0.5, 2.0, 10.0
MASS = DENSITY * 4 / 3 * math.pi * R**3    # of a sphere
SIDE = 8.0
LAW = "hooke/history 1e5 NULL 150 NULL 0.5 1"
HALVES = "mesh left.stl mesh right.stl"

# Places of the spheres of a clump about the centre of mass.
CLUMPS = {"pair": [(0.35, 0, 0), (-0.35, 0, 0)],
          "axle": [(0, 0.35, 0), (0, -0.35, 0)],
          "three": [(0.4 * math.cos(a), 0.4 * math.sin(a), 0) for a in (0, 2 * math.pi / 3, 4 * math.pi / 3)],
          "four": [(0.2 * x, 0.2 * y, 0.2 * z) for x, y, z in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]}

SETTINGS = lmp.head(modify="map array sort 40 1.5", comm="vel yes cutoff 3.0")
# Bodies come after the forces on their spheres: else the first half step of a run lacks these.
FORCES = lmp.pairs(neigh="delay 0 every 1 check yes exclude molecule/intra all") + """\
fix             pull all gravity {gravity}
fix             wall all {wall}
fix             bodies all rigid/small molecule
timestep        {dt}
variable        p equal mass(all)*vcm(all,{along})
thermo_style    custom step v_p {force} {more}
thermo_modify   norm no format float %.17g
thermo          {thermo}
"""
DUMP = """\
dump            {name} all custom {every} {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify     {name} format float %.17g sort id
"""
DOWN = f"{G} vector 0 0 -1"


def write_parts(folder):
    for name, places in CLUMPS.items():
        rows = {"Coords": [" ".join(map(repr, map(float, p))) for p in places], "Types": ["1"] * len(places),
                "Diameters": [str(2 * R)] * len(places)}
        (folder / f"{name}.mol").write_text(f"{name}\n\n{len(places)} atoms\n" + "".join(
            f"\n{title}\n\n" + "".join(f"{i} {row}\n" for i, row in enumerate(lines, 1))
            for title, lines in rows.items()))
    write_floor(folder / "left.stl", -SIDE, 0)
    write_floor(folder / "right.stl", 0, SIDE)
    write_floor(folder / "whole.stl", -SIDE, SIDE)


def write_floor(path, lo, hi, cells=7):
    """Across z = 0, of 2 cells^2 triangles."""
    stl.write(path, stl.sheet(cells, lambda i, j: (lo + (hi - lo) * i / cells, SIDE * (2 * j / cells - 1), 0)))


def create(clumps, kick):
    """`clumps`: (name, place, how it is turned)."""
    return (SETTINGS + f"region box block {-SIDE} {SIDE} {-SIDE} {SIDE} -1 6\ncreate_box 1 box\n" +
            "fix number all property/atom mol ghost yes\n" +
            "".join(f"molecule {name} {name}.mol\n" for name in CLUMPS) +
            "".join(f"create_atoms 0 single {x!r} {y!r} {z!r} mol {name} 4711 rotate {turn} units box\n"
                    for name, (x, y, z), turn in clumps) + f"set group all density {DENSITY}\n{kick}\n")


def forces(wall, gravity=DOWN, dt=1e-4, along="z", force="f_wall[3]", more="", thermo=1000):
    return FORCES.format(wall=wall, gravity=gravity, dt=dt, along=along, force=force, more=more, thermo=thermo)


def ours(meshes=HALVES, law=LAW, more=""):
    return f"wall/lsdcd {law} {meshes} {more}"


FEW = [(("pair", "three", "four")[(i + j) % 3], (2.1 * i - 2.9, 2.3 * j - 3.3, 0.95), f"{40 * i + 25 * j} 1 0.{i} 0.{j}")
       for i in range(4) for j in range(4)]
# Each sphere its own velocity, of which the body takes what it can have.
THROWN = "velocity all create 1.0 4711 loop geom\nvelocity all set NULL NULL -2.0 sum yes"


def go(folder, name, clumps, kick, steps, wall, ranks=1, every=50, flags=lmp.FLAGS, **words):
    text = lmp.run_well(create(clumps, kick) + forces(wall, **words) + DUMP.format(name=name, every=every) +
                        f"run {steps}\n", folder, ranks, flags=flags)
    return lmp.read_dump(folder / name), lmp.read_thermo(text)


def prepare(folder):
    write_parts(folder)


def test_among_others(folder):
    """Two meshes of 196 triangles are LAMMPS's plane, which takes the mass of the body, too."""
    steps = 4000
    theirs = go(folder, "plane", FEW, THROWN, steps, f"wall/gran {LAW} zplane 0 NULL", force="")[0]
    one, rows = go(folder, "one", FEW, THROWN, steps, ours(), thermo=1)
    touching = [step for step, atoms in one.items() if sum(row[2] < R for row in atoms.values()) > 8]
    fact("clumps lie on the floor", len(touching) > 10 and steps in touching, str(len(touching)))
    # Heights of 0.5 are rounded to 1e-16, overlaps are 1e-4: forces are off by 1e-12 of theirs, and tumbling parts
    # neighbouring paths by a factor of 1e2 at most.
    at_most("clumps on two meshes: as on LAMMPS's plane", lmp.largest_difference(theirs, one), 1e-10)
    two = go(folder, "two", FEW, THROWN, steps, ours(), ranks=2)[0]
    at_most("2 processes: as 1", lmp.largest_difference(one, two), 1e-10)
    whole = go(folder, "whole", FEW, THROWN, steps, ours("mesh whole.stl"))[0]
    at_most("one mesh: as two", lmp.largest_difference(one, whole), 1e-10)
    # Velocity Verlet: each force acts for a step, the first and the last one for half of it. 4000 sums of numbers
    # of the size of the weight, each rounded to 1e-16 of it.
    mass = MASS * len(one[0])
    impulse = 1e-4 * math.fsum(row[2] for row in rows[1:-1]) + 0.5e-4 * (rows[0][2] + rows[-1][2])
    time = steps * 1e-4
    at_most("the floor bears the weight, but for what the clumps gain in momentum",
            abs(-impulse - mass * G * time + rows[0][1] - rows[-1][1]) / (mass * G * time), 1e-12)


def test_restart(folder):
    """In two pieces through a file, and without one. The bodies are found again in both, from atoms in another order."""
    first, second = 2500, 1500
    begin = create(FEW, THROWN) + forces(ours())
    # The dump begins in the second piece, with the step that both repeat.
    lmp.run_well(begin + f"run {first}\nwrite_restart clumps.restart\n" + DUMP.format(name="two", every=50) +
                 f"run {second}\n", folder)
    two = lmp.read_dump(folder / "two")
    fact("restart: spheres touch where it breaks", sum(row[2] < R for row in two[first].values()) > 8)
    for ranks in (1, 2):
        lmp.run_well(SETTINGS + "read_restart clumps.restart\nfix number all property/atom mol ghost yes\n" +
                     forces(ours()) + DUMP.format(name="again", every=50) + f"run {second}\n", folder, ranks)
        at_most(f"restart on {ranks}: as without",
                lmp.largest_difference(two, lmp.read_dump(folder / "again")), 1e-10)


def test_masses_are_asked_for(folder):
    """With new lists alone, and with Kokkos no step brings places of atoms to the CPU for them."""
    said = []
    for steps in (100, 200):
        text = create(FEW, THROWN) + forces(ours()) + "neigh_modify delay 0 every 10 check no\n" + f"run {steps}\n"
        out = lmp.run_well(text, folder, env={"LD_PRELOAD": os.environ["LSDCD_ASKED_OF_HOST"]})
        masses, places = map(int, re.search(r"asked for masses (\d+), for places (\d+)", out).groups())
        fact(f"{steps} steps: masses", masses == 1 + steps // 10, str(masses))
        said.append(places)
    fact("places", said[0] == said[1], str(said))


def test_fix_set(folder):
    """Fix set makes a grain denser that falls beside a body: its dashpot has the mass of the step before, whatever lists there are."""
    for every in (1, 5):
        for lists in (1, 1000):
            text = create([("pair", (-4, -4, 0.4), "0 1 0 0")], "") + f"""\
create_atoms 1 single 2 2 0.49
group body molecule 1
group free subtract all body
set group free diameter 1 density 1
velocity free set 0 0 -0.1
neigh_modify delay 0 every {lists} check no exclude molecule/intra all
pair_style zero 1.2
pair_coeff * *
fix stiff body rigid/small molecule
fix move free nve/noforce
fix wall free {ours("mesh whole.stl", "granular hooke 1000 50 tangential linear_nohistory 0 0 damping mass_velocity")}
{lmp.set_in_run(every, 3, 3, density="1+0.1*step")}timestep 1e-4
thermo 1
thermo_style custom step f_wall[3]
thermo_modify norm no format float %.17g
run 12
"""
            for step, force in lmp.read_thermo(lmp.run_well(text, folder))[1:]:
                mass = (1 + 0.1 * ((step - 1) // every * every)) * 4 / 3 * math.pi * R**3
                push = 1000 * (0.01 + 0.1e-4 * step) + 50 * 0.1 * mass
                # Heights of 0.5 are rounded to 1e-16, and 1000 times that is 1e-14 of the push.
                at_most(f"set each {every}, lists each {lists}, step {step:g}", abs(force / -push - 1), 1e-12)


def test_rebound(folder):
    """A pair that falls flat has two springs and two dashpots of its own mass M: M z'' = -2 k z - 2 M gamma z', and
    rebounds with exp(-gamma pi/omega), omega^2 = 2 k/M - gamma^2. The dashpots see the velocity half a step late, and
    the contact begins and ends within a step: each changes the exponent by gamma dt or less."""
    gamma, k, dt = 10.0, 1e4, 1e-5
    path = go(folder, "path", [("pair", (0.2, 0.1, R + 0.001), "0 0 0 1")], "velocity all set 0 0 -1", 3600,
              ours(law=f"hooke {k} 0 {gamma} 0 0 0"), gravity="0 vector 0 0 -1", dt=dt, every=3600)[0]
    expected = math.exp(-gamma * math.pi / math.sqrt(2 * k / (2 * MASS) - gamma**2))
    at_most("a pair that falls flat: damped by the mass of the body",
            abs(path[3600][1][5] / expected - 1), 3 * gamma * dt)


def test_slide(folder):
    """All spheres of a flat clump slide, with mu times what the floor pushes: the change of v along x is mu times that
    of v + g t along z, to rounding, on a floor at rest and on one that is drawn away."""
    mu, steps = 0.1, 3000
    at = [("three", (-1.0, 0.1, R - 3 * MASS * G / 3e5), "0 0 0 1")]
    law = f"hooke 1e5 0 40 1e4 {mu} 1"
    for name, kick, motion, sign in (("slides", "velocity all set 5 0 0", "", -1),
                                     ("is drawn along", "", "motion linear 5 0 0", 1)):
        meshes = " ".join(f"{mesh} {motion}" for mesh in ("mesh left.stl", "mesh right.stl"))
        path = go(folder, "path", at, kick, steps, ours(meshes, law))[0]
        v0, v = ([sum(row[k] for row in path[step].values()) / 3 for k in (3, 4, 5)] for step in (0, steps))
        gained = mu * (G * steps * 1e-4 + v[2] - v0[2])
        at_most(f"a clump that {name}: mu times the push", abs((v[0] - v0[0]) * sign / gained - 1), 1e-11)
        fact(f"a clump that {name}: over the seam", path[0][1][0] < 0 < path[steps][1][0] or sign > 0)


def test_roll(folder):
    """Two spheres on an axle roll down a slope as one does, with 5/7 g sin. Torques act at R: v + 2/5 R omega is that
    of gravity to rounding. The slip is what the springs still swing: less than their stretch F/(M w^2) times w, with
    F = 2/7 M g sin and w^2 = 2 k_t (1 + 5/2)/M."""
    sine, steps = 0.5, 6000
    law = "hooke/history 1e5 1e5 40 40 0.9 1"
    at = [("axle", (-0.5, 0.1, R - 2 * MASS * G * math.sqrt(1 - sine**2) / 2e5), "0 0 0 1")]
    path = go(folder, "path", at, "", steps, ours(law=law),
              gravity=f"{G} vector {sine} 0 {-math.sqrt(1 - sine**2)!r}")[0]
    v, omega = path[steps][1][3], path[steps][1][7]
    along = G * sine * steps * 1e-4
    fact("an axle rolls over the seam", path[0][1][0] < -0.4 and path[steps][1][0] > 0.1, str(path[steps][1][0]))
    at_most("an axle that rolls: gravity turns and drives it", abs((v + 0.4 * R * omega) / along - 1), 1e-11)
    stiff = math.sqrt(2 * 1e5 * 3.5 / (2 * MASS))
    slip = 2 / 7 * G * sine / stiff
    at_most("an axle that rolls: does not slip", abs(v - R * omega), slip)
    at_most("an axle that rolls: 5/7 g sin", abs(v - 5 / 7 * along), 2 / 7 * slip)


def test_lifted(folder):
    """What moves with a mesh sees one at rest (Galilei), here up and along x, whose places are rounded otherwise."""
    steps = 2500
    rest = go(folder, "rest", FEW, THROWN, steps, ours("mesh whole.stl"))[0]
    kick = THROWN + "\nvelocity all set 1.5 NULL 0.75 sum yes"
    moved = go(folder, "moved", FEW, kick, steps, ours("mesh whole.stl motion linear 1.5 0 0.75"))[0]
    for step, atoms in moved.items():
        for row in atoms.values():
            for k, v in ((0, 1.5), (2, 0.75)):
                row[k] -= v * step * 1e-4
                row[k + 3] -= v
    # Places of 4 are rounded to 4e-16, overlaps are 1e-4: forces are off by 4e-12, as above.
    at_most("a mesh that moves: as at rest", lmp.largest_difference(rest, moved), 1e-10)


@lmp.of_kokkos
def test_massflow_of_kokkos_is_refused(folder):
    lmp.refused("clumps", create(FEW, THROWN) + forces(ours()) + "fix m all massflow/lsdcd mesh whole.stl clumps yes\nrun 1\n", folder,
                "clumps are counted on a CPU alone")


@lmp.of_kokkos
def test_doubtful_pairs_of_kokkos(folder):
    """LAMMPS's own pairs of grains for Kokkos have the masses of spheres."""
    text = create(FEW, THROWN) + forces(ours()) + "pair_style gran/hooke/history/kk 1e5 NULL 150 NULL 0.5 1\npair_coeff * *\nrun 1\n"
    said = " ".join(lmp.run_well(text, folder).split())
    fact("pairs that damp spheres are told of", "damps spheres of the bodies of fix bodies by the masses of the spheres" in said, said[-600:])


def test_massflow(folder):
    """Clumps that tumble through a plane count once each, with all of their mass, when their first atom passes, as its path has it; all
    their atoms go at once, on any number of processes, and in a run that goes on from a file."""
    steps, height = 480, 0.5
    plane = f"mesh whole.stl rotate 1 0 0 180 move 0 0 {height}"
    fix = f"fix m all massflow/lsdcd {plane} clumps yes"
    shown = "thermo_style custom step atoms f_m[1] f_m[2] f_m[7] f_m[8]\nthermo_modify norm no format float %.17g\n"

    def rows(words, ranks, steps, begin, more=""):
        return lmp.read_thermo(lmp.run_well(begin + f"{fix} {words}\n{shown}thermo 20\n" + more + f"run {steps}\n", folder, ranks))

    def forces_alone():
        return re.sub("fix +wall .*\n", "", forces("none", dt=5e-4, force="step"))

    begin = create(FEW, THROWN) + forces_alone()
    seen = rows("", 1, steps, begin, DUMP.format(name="path", every=1))
    path, first, members = lmp.read_dump(folder / "path"), {}, {}
    at = 1
    for number, (name, _, _) in enumerate(FEW):
        first[number], members[number] = at, len(CLUMPS[name])
        at += len(CLUMPS[name])
    wrong = []
    for step, atoms, forward, mass, _, _ in seen:
        passed = [k for k in first if path[int(step)][first[k]][2] < height]
        expected = MASS * sum(members[k] for k in passed)
        if forward != len(passed) or abs(mass - expected) > 1e-12 * (1 + expected) or atoms != len(path[0]):
            wrong.append((step, forward, mass, len(passed), expected))
    fact("clumps that passed: number and mass", not wrong and any(0 < row[2] < len(FEW) for row in seen),
         str(wrong[:1]))
    each = "neigh_modify every 1 check no\n"
    for ranks in (1, 2):
        wrong = []
        whole = rows("delete yes", ranks, steps, begin + each)
        for step, atoms, forward, mass, gone, gone_mass in whole:
            passed = [k for k in first if path[int(step)][first[k]][2] < height]
            before = [k for k in first if path[max(int(step) - 1, 0)][first[k]][2] < height]
            n, m = sum(members[k] for k in before), MASS * sum(members[k] for k in before)
            if (forward, gone, atoms) != (len(passed), len(before), len(path[0]) - n) or abs(gone_mass - m) > 1e-12 * (1 + m):
                wrong.append((step, atoms, forward, gone, gone_mass, len(passed), len(before), n, m))
        fact(f"{ranks} processes: all atoms of a clump go at once", not wrong, str(wrong[:1]))
    half = next(step for step in range(steps) if 2 * sum(path[step][id_][2] < height for id_ in first.values()) > len(FEW))
    lmp.run_well(begin + f"{fix} delete yes\n{each}run {half}\nwrite_restart mid.restart\n", folder, 2)
    again = rows("delete yes", 1, steps - half, SETTINGS + "read_restart mid.restart\nfix number all property/atom mol ghost yes\n" +
                 forces_alone() + each)
    fact("restart: the same counts", 0 < again[0][2] < again[-1][2] and [again[-1][k] for k in (1, 2, 4)] == [whole[-1][k] for k in (1, 2, 4)],
         f"{again[0]} {again[-1]} {whole[-1]}")
    at_most("restart: the same masses", max(abs(again[-1][k] / whole[-1][k] - 1) for k in (3, 5)), 1e-12)


BODY = """\
{head}fix             number all property/atom mol ghost yes
molecule        clump clump.mol
{create}
{pairs}
fix             bodies all rigid/small molecule {more}
{deposit}
compute         body all rigid/local bodies mass inertiax inertiay inertiaz quatw quati quatj quatk x y z
dump            body all local 1 body {columns}
dump_modify     body format float %.17g
thermo_style    custom step
timestep        1e-6
run             {steps}
"""


def read_body(folder, **words):
    """Mass, moments, quaternion and place of the one body, and the principal moments in rising order with their axes."""
    words = {"create": "", "deposit": "", "more": "", "steps": 1, **words}
    lmp.run_well(BODY.format(head=lmp.head("-9 9 -9 9 -9 9", comm="vel yes cutoff 5.0"), columns=" ".join(f"c_body[{k + 1}]" for k in range(11)),
                             pairs=lmp.pairs(neigh="exclude molecule/intra all"), **words), folder)
    mass, *numbers = map(float, (folder / "body").read_text().split("\n")[-2].split())
    w, i, j, k = numbers[3:7]
    axes = [(w * w + i * i - j * j - k * k, 2 * (i * j + w * k), 2 * (i * k - w * j)),
            (2 * (i * j - w * k), w * w - i * i + j * j - k * k, 2 * (j * k + w * i)),
            (2 * (i * k + w * j), 2 * (j * k - w * i), w * w - i * i - j * j + k * k)]
    return mass, sorted(zip(numbers[:3], axes))


def has_inertia_of(clump, name, body):
    """All is written to the last digit; moments come of LAMMPS's Jacobi rotations, which end at 1e-8 and less."""
    at_most(f"{name}: its mass", abs(body[0] / clump["mass"] - 1), 1e-12)
    at_most(f"{name}: its principal moments", max(abs(is_[0] / moment - 1) for is_, moment in zip(body[1], clump["principal_moments"])), 1e-7)


def test_made_from_spheres(folder):
    """A body of fix deposit has the mass and inertia of the union that lsdcd clump printed, about the axes that it printed: no two
    products of inertia are the same, so that their order in the file matters. It is turned about z by an angle that is not known."""
    (folder / "spheres.txt").write_text("0 0 0 1\n1 0.2 0 0.9\n1.2 1 0.3 0.7\n0.5 0.5 0.9 0.8\n")
    clump = command.told(folder, "clump", "--list", "spheres.txt", "--density", 3, "-o", "clump.mol")
    body = read_body(folder, more="mol clump", steps=3, create="region slab block -1 1 -1 1 -1 1",
                     deposit="fix dep all deposit 1 0 1 4711 region slab mol clump rigid bodies near 0.1 orient 0 0 1")
    has_inertia_of(clump, "a clump of fix deposit", body)
    at_most("a clump of fix deposit: heights of its axes",
            max(abs(abs(is_[1][2]) - abs(axis[2])) for is_, axis in zip(body[1], clump["principal_axes"])), 1e-7)


def test_made_from_a_mesh(folder):
    """The masses of the atoms alone have the mass, inertia and axes of the clump: LAMMPS sums these at each run."""
    stl.write(folder / "part.stl", cube())
    turned = "0.8 -0.36 0.48 0 0.6 0.48 -0.64 0 0 0.8 0.6 0"
    clump = command.told(folder, "clump", "part.stl", "--scale", 1.3, 1.2, 1, "--matrix", *turned.split(), "--spheres", 40, "--density", 3,
                         "-o", "clump.mol")
    body = read_body(folder, create="create_atoms 0 single 0 0 0 mol clump 4711 rotate 0 0 0 1")
    has_inertia_of(clump, "a clump of create_atoms", body)
    # Along the axis, to the square of the angle.
    at_most("a clump of create_atoms: its axes",
            max(1 - abs(sum(a * b for a, b in zip(is_[1], axis))) for is_, axis in zip(body[1], clump["principal_axes"])), 1e-9)


@lmp.of_kokkos
def test_beside_plain(folder):
    """wall/lsdcd/kk and the plain fix in the LAMMPS with Kokkos, whose fix rigid/small has one form only."""
    moving = "mesh left.stl motion linear 0 1.5 0 mesh right.stl motion wiggle 0 0 0.05 0.5"
    for name, meshes in (("at rest", HALVES), ("that moves", moving)):
        plain = go(folder, "plain", FEW, THROWN, 2500, ours(meshes), flags=())[0]
        kokkos = go(folder, "kokkos", FEW, THROWN, 2500, ours(meshes).replace("lsdcd", "lsdcd/kk"))[0]
        fact(f"a wall {name}: clumps touch it", any(row[12] for row in plain[2500].values()))
        # As among_others: other fixes may round in their own way with Kokkos.
        at_most(f"wall/lsdcd/kk {name}: as the plain fix", lmp.largest_difference(plain, kokkos), 1e-10)
