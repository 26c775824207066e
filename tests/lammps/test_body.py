# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes as rigid bodies: impacts, springs, hinges, momentum, restart, ranks; closed forms."""

import math

import lmp
import stl
import vtp
from facts import at_most, fact

BEGIN = lmp.head("{box}", modify="map array sort 0 0") + """\
{create}
""" + lmp.pairs("{pair}", "{skin}") + """\
timestep        {dt}
{move}
"""
# Columns of the fix's vector, from 1.
FORCE, POWER, CENTRE, SPEED, TURN, OMEGA, REACTION, COORDINATE, ENERGY, STOP = 1, 11, 15, 18, 21, 25, 28, 34, 35, 41


def script(fix, create, dt, box="-2 2 -2 2 -2 2", pair="zero 1.0", skin=0.1, move="fix move all nve/sphere", more="",
           every=1, columns=range(1, 36), also=""):
    shown = " ".join(f"$(f_w[{k}]:%.17g)" for k in columns)
    return (BEGIN.format(box=box, create=create, pair=pair, skin=skin, dt=dt, move=move) +
            f"fix w all wall/lsdcd {fix}\n{more}"
            f"fix out all print {every} \"$(step) {shown} {also}\" file out.txt screen no\n")


def go(folder, text, ranks=1):
    log = lmp.run_well(text, folder, ranks)
    return lmp.read_rows(folder / "out.txt"), log


def from_file(text):
    """The script with what it made read from half.bin instead."""
    return "atom_style sphere\nnewton off\ncomm_modify vel yes\nread_restart half.bin\n" + text[text.index("pair_style"):]


def same(name, row, other):
    fact(name, row == other, str([k for k, (a, b) in enumerate(zip(row, other)) if a != b]))


def sphere(x, y, z, radius, mass, velocity):
    density = mass / (4 / 3 * math.pi * radius**3)
    return (f"create_atoms 1 single {x} {y} {z} units box\n"
            f"set group all diameter {2 * radius} density {density:.17g}\n"
            f"velocity all set {velocity[0]} {velocity[1]} {velocity[2]}\n")


# A grain that touches nothing.
FAR = "create_atoms 1 single 1 1 1 units box\nset group all diameter 0.01 density 1\n"
ATOM = "$(vx[1]:%.17g) $(vy[1]:%.17g) $(vz[1]:%.17g)"


def test_impacts(folder):
    """A sphere on the middle of a cube's face: v' = (m - e M) v / (m + M), V' = (1 + e) m v / (m + M)."""
    radius, mass, speed, stiffness, e = 0.1, 1.0, 1.0, 1e6, 0.6
    stl.write(folder / "cube.stl", stl.box((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1)))
    for ratio in (1e-3, 0.1, 1, 1e3):
        body = ratio * mass
        reduced = 1 / (1 / mass + 1 / body)
        dt = 0.01 * math.sqrt(reduced / stiffness)
        moment = body * 0.2**2 / 6
        text = script(f"granular hooke {stiffness} {e} damping coeff_restitution tangential linear_nohistory 0 0 "
                      f"mesh cube.stl body mass {body} com 0 0 0 inertia {moment} {moment} {moment} 0 0 0 gravity 0 0 0",
                      sphere(0, 0, 0.2 + 2 * speed * dt, radius, mass, (0, 0, -speed)), dt, every=1000, also=ATOM)
        rows, _ = go(folder, text + "run 1000\n")
        v, big = rows[-1][-1], rows[-1][SPEED + 2]
        # The contact lasts pi sqrt(m/k) at most: 314 steps of it have an error of 1e-4. The force is cut
        # off where it would attract, which loses as little.
        at_most(f"M/m = {ratio:g}: restitution", abs((v - big) / speed - e), 0.02)
        at_most(f"M/m = {ratio:g}: velocity of the body",
                abs(big / (-(1 + e) * mass * speed / (mass + body)) - 1), 0.02)
        at_most(f"M/m = {ratio:g}: momentum", abs(mass * v + body * big + mass * speed), 1e-12)
        at_most(f"M/m = {ratio:g}: no spin", max(abs(w) for w in rows[-1][OMEGA:OMEGA + 3]), 1e-9 * speed)


def test_off_centre(folder):
    """Elastic, without friction, 0.05 beside the middle of the cube of side 0.2, M = m: 0.842105 m v."""
    stl.write(folder / "cube.stl", stl.box((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1)))
    errors = []
    for stiffness in (1e6, 1e8):
        dt = 0.01 * math.sqrt(0.4 / stiffness)
        text = script(f"hooke {stiffness} NULL 0 NULL 0 0 mesh cube.stl body density 125 gravity 0 0 0",
                      sphere(0.05, 0, 0.2 + 2 * dt, 0.1, 1, (0, 0, -1)), dt, every=1000, also=ATOM)
        rows, _ = go(folder, text + "run 1000\n")
        row = rows[-1]
        errors.append(abs(-row[SPEED + 2] / 0.842105 - 1))
        overlap = math.sqrt(0.4 / stiffness)
        at_most(f"off centre, k = {stiffness:g}: impulse", errors[-1], 5 * overlap / 0.2)
        spin = 0.05 * -row[SPEED + 2] / (0.2**2 / 6)    # J 0.05 / I, with M = 1
        at_most(f"off centre, k = {stiffness:g}: spin", abs(row[OMEGA + 1] / spin - 1), 5 * overlap / 0.2)
        energy = row[ENERGY] + 0.5 * row[-1]**2
        at_most(f"off centre, k = {stiffness:g}: energy", abs(energy / 0.5 - 1), 1e-3)


def test_hinge(folder):
    """A flap under fix gravity: its period, and the weights that the hinge bears."""
    side, thick, g = 0.2, 0.002, 9.81
    stl.write(folder / "flap.stl", stl.box((-thick / 2, -side / 2, -side), (thick / 2, side / 2, 0)))
    inertia = side**2 / 3 + thick**2 / 12    # over the mass
    law = "hooke 1e3 NULL 0 NULL 0 0 mesh flap.stl body density 1000 joint hinge 0 0 0 0 1 0 "
    more = f"fix g all gravity {g} vector 0 0 -1\n"
    dt = 5e-4
    start = 0.02
    rows, _ = go(folder, script(law + f"omega 0 {start} 0", FAR, dt, move="", more=more) + "run 3000\n")
    period = 2 * math.pi * math.sqrt(inertia / (g * side / 2))
    swing = start * period / (2 * math.pi)
    off = max(abs(r[COORDINATE] - swing * math.sin(2 * math.pi * r[0] * dt / period)) for r in rows)
    at_most("hinge: swings by the closed form", off / swing, 1e-3)
    # From the bottom with the speed of a release at 90 degrees.
    fast = math.sqrt(g * side / inertia)
    rows, _ = go(folder, script(law + f"omega 0 {fast:.17g} 0", FAR, dt, move="", more=more) + "run 500\n")
    mass = side * side * thick * 1000
    at_most("hinge: 2.5 weights at the bottom", abs(rows[0][REACTION + 2] / (mass * g) - 2.5), 1e-4)
    at_most("hinge: comes to 90 degrees", abs(max(r[COORDINATE] for r in rows) / (math.pi / 2) - 1), 1e-4)
    potential = [r[ENERGY] + mass * g * r[CENTRE + 2] for r in rows]
    at_most("hinge: energy", (max(potential) - min(potential)) / (mass * g * side), 1e-4)


def test_motor(folder):
    """A motor with a variable, and a damper: I w' = T - c w, exactly for a constant T."""
    stl.write(folder / "rotor.stl", stl.box((-0.3, -0.1, -0.1), (0.3, 0.1, 0.1)))
    inertia, torque, damping, dt = 2.0, 0.7, 0.4, 0.01
    law = f"hooke 1e3 NULL 0 NULL 0 0 mesh rotor.stl body mass 3 com 0 0 0 inertia 1 1.5 {inertia} 0 0 0 " \
          f"joint hinge 0 0 0 0 0 2 spring 0 {damping} motor v_torque"
    torque_is = f"variable torque equal {torque}\nfix w"
    # Another timestep later, between two runs and in one.
    rows, _ = go(folder, script(law, FAR, dt, move="", also="$(time:%.17g)").replace("fix w", torque_is, 1) +
                 "run 100\ntimestep 0.002\nrun 100\nfix less all dt/reset 50 0.001 0.0011 1 units box\nrun 200\n")
    off = max(abs(r[OMEGA + 2] - torque / damping * (1 - math.exp(-damping * r[-1] / inertia))) for r in rows)
    at_most("motor and damper with another timestep", off, 1e-12)
    fact("the timestep changed in a run", abs(rows[-1][-1] - (1 + 0.2 + 0.1 + 0.165)) < 0.06,
         f"time {rows[-1][-1]:.6g}")


def test_stops(folder):
    """A flap that a motor holds at its stop, and a sphere that hits it there: outputs as of a mesh at rest, and the stop's torque."""
    side, thick, torque, upper, dt, radius = 0.2, 0.02, 5.0, 0.3, 1e-3, 0.05
    stl.write(folder / "flap.stl", stl.box((-thick / 2, -side / 2, -side), (thick / 2, side / 2, 0)))
    law = "granular hooke 1e4 0.3 damping coeff_restitution tangential linear_nohistory 0 0 mesh flap.stl "
    body = f"body density 100 joint hinge 0 0 0 0 1 0 motor {torque} limits 0 {upper} gravity 0 0 0"
    rows, _ = go(folder, script(law + body, FAR, dt, move="", columns=range(1, 42)) +
                 "run 200\nfix_modify w body motor 0 limits 0 1\nrun 200\n")
    held, loose = [r for r in rows if r[0] == 200]
    for name, row in (("held", held), ("let go", loose), ("200 steps later", rows[-1])):
        fact(f"stop: at rest, {name}", row[COORDINATE] == upper and not any(row[OMEGA:OMEGA + 3]) and row[ENERGY] == 0)
    at_most("stop: it bears the motor", abs(held[STOP] + torque), 1e-14)
    fact("stop: it bears nothing more", loose[STOP] == 0 and not any(held[36:41]))

    hit = sphere(-thick / 2 - radius - 1e-4, 0, -0.7 * side, radius, 1, (1, 0, 0))
    speeds = []
    for fix in (law, law + body.replace(f"0 {upper}", "0 1").replace(f"motor {torque}", "motor -100")):
        rows, _ = go(folder, script(fix, hit, 1e-4, columns=(POWER,), also=ATOM) + "run 400\n")
        speeds.append([r[-3] for r in rows])
        fact("stop: no power", not any(r[1] for r in rows))
    fact("stop: a sphere rebounds as from a mesh at rest", speeds[0] == speeds[1] and speeds[0][-1] < -0.2,
         f"{speeds[0][-1]}, {speeds[1][-1]}")


def crowd(cells=3, apart=0.5):
    """Spheres of diameter 0.3 on a grid about the origin, with any velocities, whose sum is 0."""
    at = [apart * (k - (cells - 1) / 2) for k in range(cells)]
    create = "".join(f"create_atoms 1 single {x + 0.02 * z} {y} {z + 0.03 * x} units box\n" for x in at for y in at for z in at)
    return create + "set group all diameter 0.3 density 4\nvelocity all create 0.05 4711 loop geom\n"


COLLIDE = "hooke/history 1e4 3e3 0 0 0.3 0"
BOOKS = """\
variable px equal "vcm(all,x) * mass(all)"
variable py equal "vcm(all,y) * mass(all)"
variable pz equal "vcm(all,z) * mass(all)"
"""
BOOK = "$(v_px:%.17g) $(v_py:%.17g) $(v_pz:%.17g)"


def test_two_bodies(folder, steps=5000):
    """A free cube in a free box, with spheres between that touch both at a time: the momentum of all."""
    stl.write(folder / "outer.stl", stl.box((-1.0,) * 3, (1.0,) * 3, 2))
    stl.write(folder / "inner.stl", stl.box((-0.6,) * 3, (0.6,) * 3, 2))
    masses = (5.0, 1.5)
    words = [f"mesh {name}.stl body mass {m} com 0 0 0 inertia 1 1 1 0 0 0" for name, m in zip(("outer", "inner"), masses)]
    # In the gap of 0.4: the first sphere is squeezed from the start, and touches both.
    create = "".join(f"create_atoms 1 single {x} {y} 0.8 units box\n" for x in (-0.3, 0.3) for y in (-0.3, 0.3))
    create += ("set group all diameter 0.3 density 4\nset atom 1 diameter 0.402\nvelocity all create 0.05 4711 loop geom\n")
    shown = " ".join(f"$(f_w[{k}][{c}]:%.17g)" for k in (1, 2) for c in range(SPEED, SPEED + 3))
    for ranks in (1, 2):
        text = script(f"{COLLIDE} {' '.join(words)}", create, 5e-4, box="-3 3 -3 3 -3 3",
                      pair="gran/hooke 1e4 0 0 0 0 0", more=BOOKS, every=100, columns=(FORCE,), also=f"{BOOK} {shown}")
        rows, _ = go(folder, text + f"run {steps}\n", ranks)
        sums = [[r[2 + k] + sum(m * r[5 + 3 * b + k] for b, m in enumerate(masses)) for k in range(3)] for r in rows]
        size = max(m * abs(r[5 + 3 * b + k]) for r in rows for b, m in enumerate(masses) for k in range(3))
        off = max(abs(a - b) for s in sums for a, b in zip(s, sums[0]))
        at_most(f"two bodies, {ranks} processes: momentum in {steps} steps", off / size, 1e-12)
        fact(f"two bodies, {ranks} processes: both are hit", all(
            max(abs(r[5 + 3 * b + 2]) for r in rows) > 1e-3 for b in (0, 1)))


def test_coats(folder):
    """A cube with a coat on a floor: its height at rest, any number of processes, restart, and changes between runs."""
    stl.write(folder / "floor.stl", stl.square(1))
    stl.write(folder / "cube.stl", stl.box((-0.2,) * 3, (0.2,) * 3))
    stiffness, radius, mass, g, points = 1e3, 0.05, 0.64, 9.81, 13    # points of a face: see test_body_coat.cpp

    def fix(law, more, height=0.2 + radius + 1e-3):
        return (f"{law} mesh floor.stl mesh cube.stl move 0.1 0.2 {height} body density 10 coat 0.2 {radius} "
                f"gravity 0 0 -{g} {more}")

    text = script(fix(f"hooke {stiffness} NULL 50 NULL 0 0", ""), FAR, 1e-3, move="")
    rows, log = go(folder, text + "run 1000\n")
    sinks = mass * g / (points * stiffness)
    at_most("coat: height at rest", abs(rows[-1][CENTRE + 2] - (0.2 + radius - sinks)), 1e-8)
    at_most("coat: level", max(abs(q) for q in rows[-1][TURN + 1:TURN + 4]), 1e-12)
    at_most("coat: forces on floor and cube cancel", abs(rows[-1][FORCE + 2]), 1e-12)
    fact("coat: the log tells points and errors", "points at most 0.2 apart, of radius 0.05" in log)
    law = f"hooke/history {stiffness} 300 0 0 0.5 0"
    text = script(fix(law, "velocity 0.6 0.1 0 omega 0.2 0.1 0.3"), FAR, 5e-4, move="")
    whole, _ = go(folder, text + "run 400\n")
    for ranks in (2, 4):
        rows, _ = go(folder, text + "run 400\n", ranks)
        fact(f"coat: the same bits on {ranks} processes", rows == whole)
    go(folder, text + "run 200\nwrite_restart half.bin\n")
    after, _ = go(folder, from_file(text) + "run 200\n")
    same("coat: it goes on from a restart file", after[-1], whole[-1])

    text = script(fix(law, "", 0.9), FAR, 1e-3, move="")
    rows, _ = go(folder, text + "run 100\nfix_modify w mesh 2 body joint slider 0 0 2 load 0 0 12.5568 motor 0.64\nrun 100\n")
    before, after = [r for r in rows if r[0] == 100]
    fact("fix_modify body: it does not jump", before[CENTRE:SPEED + 3] == after[CENTRE:SPEED + 3])
    # The load bears its weight of 6.2784 twice; the motor adds 1: acceleration g + 1.
    speed = -g * 0.1 + (g + 1) * 0.1
    at_most("fix_modify body: the new load and motor act", abs(rows[-1][SPEED + 2] - speed), 1e-4)
    held = script(fix("hooke 1000 NULL 0 NULL 0 0", "joint slider 0 0 1 spring 100 0 0.1 velocity 0 0 1"), FAR, 1e-3, move="")
    again, whole = (go(folder, held + "run 50\n" + words + "run 50\n")[0] for words in ("fix_modify w mesh 2 body joint slider 0 0 1\n", ""))
    same("fix_modify body: the joint that it has keeps its spring", again[-1], whole[-1])
    for words, says in (("density 3", "is not a keyword of a body, or cannot change"), ("spring 1 1", "hinge or slider"),
                        ("", "nothing is given to change")):
        lmp.refused(f"fix_modify body {words}", text + f"fix_modify w mesh 2 body {words}\n", folder, says)
    lmp.refused("fix_modify body of a mesh that is none", text + "fix_modify w mesh 1 body load 0 0 1\n", folder, "is not a body")


def test_spring(folder):
    """It keeps its rest over runs: the second begins where the block turns round, and the third where it is midway."""
    stl.write(folder / "block.stl", stl.box((-0.1,) * 3, (0.1,) * 3))
    dt, rate, speed = 1e-3, 2 * math.pi, 0.5
    law = "hooke 1e3 NULL 0 NULL 0 0 mesh block.stl body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 gravity 0 0 0 "
    text = script(law + f"joint slider 1 0 0 spring {rate**2:.17g} 0 velocity {speed} 0 0", FAR, dt, move="")
    rows, _ = go(folder, text + "run 250\nrun 125\nrun 625\n")
    # Leapfrog's phase is off by (rate dt)^2 / 24 of it, 1e-5 in the whole period.
    off = max(abs(r[COORDINATE] - speed / rate * math.sin(rate * r[0] * dt)) for r in rows)
    at_most("a spring keeps its rest over runs", off / (speed / rate), 1e-4)


def test_damped(folder):
    """Where damping acts, the set-up of a run computes forces by the velocities of the whole step, the run by those of half a
    step: in LAMMPS's own walls and pairs, too. So a run that is cut is not the same to the last bit, but by how much is known."""
    stl.write(folder / "cube.stl", stl.box((-0.75,) * 3, (0.75,) * 3, 2))
    words = "hooke/history 1e4 3e3 50 25 0.3 1 mesh cube.stl body density 2 load 0.1 0.2 0.3 moment 0 0.1 0.2"
    text = script(words, crowd(4, 0.35).replace("0.05 4711", "1 4711"), 5e-4, box="-5 5 -5 5 -5 5")
    whole, _ = go(folder, text + "run 300\n")
    cut, _ = go(folder, text + "run 150\nrun 150 pre no\n")
    fact("damped: run 150 and run 150 without a set-up are run 300", whole[-1] == cut[-1])

    # A body on a sphere that stays: the force of the set-up is off by c a dt / 2, and half a step of it acts, which
    # changes the velocity by (c / M) a dt^2 / 4.
    mass, stiffness, gamma, g, radius = 1.0, 1e3, 4.0, 9.81, 0.1
    stl.write(folder / "block.stl", stl.box((-0.1,) * 3, (0.1,) * 3))
    held = sphere(0, 0, -0.1 - radius, radius, 1e9, (0, 0, 0))
    law = (f"hooke {stiffness} NULL {gamma} NULL 0 0 mesh block.stl body mass {mass} com 0 0 0 inertia 1 1 1 0 0 0 "
           f"gravity 0 0 -{g} joint slider 0 0 1")
    for dt, steps in ((2e-3, 20), (1e-3, 40)):
        text = script(law, held, dt, move="")
        whole, _ = go(folder, text + f"run {steps + 1}\n")
        go(folder, text + f"run {steps}\nwrite_restart half.bin\n")
        after, _ = go(folder, from_file(text) + "run 1\n")
        v = [r[SPEED + 2] for r in whole]
        acceleration = (v[-1] - v[-3]) / (2 * dt)
        # The next order has dt gamma / 2 of it, and as much from the change of the acceleration.
        at_most(f"damped: a restart changes the velocity as the page says, dt = {dt:g}",
                abs((v[-1] - after[-1][SPEED + 2]) / (gamma * acceleration * dt**2 / 4) - 1), 0.05)


def test_heap(folder):
    """A heap in a can around a block, under a lid: when and in which order spheres are chosen changes no bit of the loads on bodies."""
    stl.write(folder / "can.stl", [t[::-1] for t in stl.box((-2, -2, -2), (2, 2, 4))])
    stl.write(folder / "block.stl", stl.box((-0.6, -0.5, -1.4), (0.5, 0.6, -1.0)))
    stl.write(folder / "lid.stl", stl.box((-1.9, -1.9, 2.5), (1.9, 1.9, 2.7)))
    create = ("lattice sc 0.485\nregion heap block -1.72 1.72 -1.72 1.72 -0.8 2.2 units box\ncreate_atoms 1 region heap\n"
              "displace_atoms all random 0.03 0.03 0.03 4711 units box\nvariable d atom 0.3+0.06*random(0,1,4713)\n"
              "set group all diameter v_d density 100\nvelocity all create 3 4712 loop geom\nset group all omega 0 0 0\n")
    meshes = ("mesh can.stl mesh block.stl body density 60 load 4.8 0.609 -5.2 coat 0.08 0.06 "
              "mesh lid.stl body density 60 joint slider 0 0 1")
    damped, undamped = (
        script(law, create, 1e-3, box="-4 4 -4 4 -4 6", every=100,
               move="fix move all nve/sphere\nfix g all gravity 4 vector 0 0 -1")
        for law in ("granular hooke 4000 0.7 tangential linear_history 1200 1 0.4 damping coeff_restitution " + meshes,
                    "granular hooke 4000 0 tangential linear_history 1200 0 0.4 damping velocity " + meshes.replace("coat 0.08 0.06 ", "")))
    atoms = "write_dump all custom {} id x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g\n"

    def same_atoms(what, name, other):
        fact(f"heap: {what}", (folder / name).read_text() == (folder / other).read_text())
    go(folder, damped + "run 1500\n" + atoms.format("whole"))
    go(folder, damped + "run 300\n" + 120 * "run 10 pre no\n" + atoms.format("cut"))
    same_atoms("with damping, runs without a set-up are one run to the last bit", "cut", "whole")
    go(folder, undamped + "run 400\nwrite_restart half.bin\nrun 1100\n" + atoms.format("whole"))
    go(folder, from_file(undamped) + "run 1100\n" + atoms.format("continued"))
    same_atoms("without damping, a run goes on from a restart file to the last bit", "continued", "whole")


def test_files(folder):
    """mesh_stl, mesh_fields and dump image have the body where it is, with the force of a sphere that presses on it."""
    half, radius, speed, dt, overlap, stiffness = 0.2, 0.1, 0.5, 1e-3, 1e-3, 1e4
    stl.write(folder / "cube.stl", stl.box((-half,) * 3, (half,) * 3))
    create = sphere(0, 0, half + radius - overlap, radius, 1, (0, 0, 0))
    law = f"hooke {stiffness} NULL 0 NULL 0 0 mesh cube.stl "
    body = (f"body mass 50 com 0 0 0 inertia 1 1 1 0 0 0 gravity 0 0 0 joint slider 1 0 0 velocity {speed} 0 0 "
            "mesh_stl s_*.stl every 50 mesh_fields f_*.vtp every 50")
    picture = "write_dump all image {}.ppm type type fix w type 0.02 0 size 200 200 view 60 30\n"
    go(folder, script(law + body, create, dt, move="") + "run 100\n" + picture.format("moved"))
    whole = stl.points(folder / "s_100.stl")
    way = [speed * 100 * dt, 0, 0]
    # Corners are at +-half, in float.
    at_most("files: mesh_stl has the body where it is",
            max(abs(abs(a - way[k % 3]) - half) for k, a in enumerate(whole)), 1e-7)
    fields = vtp.read(folder / "f_100.vtp")
    at_most("files: so has mesh_fields", abs(max(fields["points"][::3]) - half - way[0]), 1e-14)
    pushed = sum(fields["force"][2::3])
    at_most("files: and the force of the sphere", abs(pushed / (-stiffness * overlap) - 1), 1e-12)
    for name, place in (("placed", f"move {way[0]} 0 0"), ("unmoved", "")):
        go(folder, script(law + place, create, dt, move="", columns=(FORCE,)) + "run 0\n" + picture.format(name))
    pictures = [(folder / f"{name}.ppm").read_bytes() for name in ("moved", "placed", "unmoved")]
    fact("files: dump image draws it there", pictures[0] == pictures[1] != pictures[2])


def test_restart(folder):
    """Runs that are cut in two, and go on from a restart file, in mid-swing: the same bits."""
    stl.write(folder / "cube.stl", stl.box((-0.75,) * 3, (0.75,) * 3, 2))
    for joint in ("free", "hinge 0.1 0.2 -0.3 1 2 3", "slider 1 2 2", "planar 1 1 0", "ball 0.1 -0.2 0.5"):
        words = f"{COLLIDE} mesh cube.stl body density 2 joint {joint} load 0.1 0.2 0.3 moment 0 0.1 0.2"
        if joint.split()[0] in ("hinge", "slider"):
            words += " spring 20 0.5 0.1 limits -1 1 motor 0.2"
        # Without damping the set-up of a run computes the forces that the last step had.
        text = script(words, crowd(4, 0.35).replace("0.05 4711", "1 4711"), 5e-4, box="-5 5 -5 5 -5 5")
        whole, _ = go(folder, text + "run 300\n")
        cut, _ = go(folder, text + "run 150\nwrite_restart half.bin\nrun 150\n")
        same(f"{joint}: run 150 and run 150 are run 300", cut[-1], whole[-1])
        after, _ = go(folder, from_file(text) + "run 150\n")
        same(f"{joint}: it goes on from a restart file", after[-1], whole[-1])
        if "limits" not in words:
            continue
        # The coordinate has left 0: one of these has it, and neither has 0.
        narrow = [from_file(text).replace("limits -1 1", limits) + "run 150\n" for limits in ("limits -1 -1e-9", "limits 1e-9 1")]
        done = [lmp.run(one, folder) for one in narrow]
        holds = [one.returncode == 0 for one in done]
        fact(f"{joint}: limits without 0 that hold the coordinate go on, and others are refused", sorted(holds) == [False, True] and
             "do not contain" in done[holds.index(False)].stdout.replace("\n", " "), done[0].stdout[-300:])
        after, _ = go(folder, narrow[holds.index(True)])
        fact(f"{joint}: with such limits the bits are the same", after[-1] == whole[-1])


def test_changes(folder):
    """What a body does not go with ends with a sentence."""
    stl.write(folder / "cube.stl", stl.box((-0.4,) * 3, (0.4,) * 3))
    stl.write(folder / "open.stl", stl.quad((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)))
    fix = "hooke 1e3 NULL 0 NULL 0 0 mesh cube.stl body density 1 "

    def refused(name, text, *says):
        lmp.refused(name, text, folder, *says)

    plain = script(fix, FAR, 1e-3)
    refused("minimise", plain + "minimize 0 0 10 10\n", "does not move in a minimization")
    refused("respa", plain + "run_style respa 2 2 pair 1\nrun 1\n", "run_style verlet only")
    refused("open mesh", script(fix.replace("cube", "open"), FAR, 1e-3), "4 open edges")
    refused("motion", script(fix + "motion linear 1 0 0", FAR, 1e-3), "leave out its motion")
    refused("servo", script(fix + "servo force z 1 vmax 1", FAR, 1e-3), "leave out its motion")
    refused("fix_modify motion", plain + "fix_modify w motion linear 1 0 0\n", "cannot have a motion")
    refused("two fixes gravity", plain + "fix g1 all gravity 1 vector 0 0 1\nfix g2 all gravity 1 vector 0 1 0\nrun 0\n",
            "several fixes gravity")
    refused("a spring without a coordinate", script(fix + "joint ball 0 0 0 spring 1 1", FAR, 1e-3), "hinge or slider")
    refused("a velocity beside the joint", script(fix + "joint slider 1 0 0 velocity 0 1 0", FAR, 1e-3), "does not allow")
    refused("moments that no body has", script(
        "hooke 1e3 NULL 0 NULL 0 0 mesh cube.stl body mass 1 com 0 0 0 inertia 1 1 3 0 0 0", FAR, 1e-3), "no body has")
    refused("rerun", plain + "dump d all custom 1 d.txt id x y z vx vy vz\nrun 1\nrerun d.txt dump x y z\n", "in a rerun")
    # At 1.01 of 2 / sqrt(K / m). Outputs ask for the body before its next step looks at the timestep.
    refused("an error that an output finds", script(
        fix.replace("density 1", "mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1 spring 4e4 0 velocity 0 0 1"),
        FAR, 0.0101) + "thermo_style custom step f_w[34]\nthermo 1\nrun 20\n",
        "ERROR: Fix w wall/lsdcd: the timestep 0.0101 is not below 0.01", "Last ", ": run 20")
    refused("two dimensions", plain.replace("boundary        f f f", "dimension 2\nboundary        f f p").replace(
        "-2 2 -2 2 -2 2", "-2 2 -2 2 -0.1 0.1").replace("single 1 1 1", "single 1 1 0"), "plane z = 0")
    refused("a periodic face", plain.replace("boundary        f f f", "boundary        p f f").replace(
        "density 1 \n", "density 1 velocity 1 0 0\n") + "run 3000\n", "the periodic face in x")
    # Without its coat this body would be the same across the face.
    stl.write(folder / "floor.stl", stl.quad((-1, -0.41, -1), (1, -0.41, -1), (1, 0.41, -1), (-1, 0.41, -1)))
    coat = script(fix + "joint slider 0 0 1 mesh floor.stl", FAR.replace("1 1 1", "1 0 1"), 1e-3, box="-2 2 -0.41 0.41 -2 2").replace(
        "boundary        f f f", "boundary        f p f") + "run 1\n"
    lmp.run_well(coat, folder)
    refused("a coat at a periodic face", coat.replace("slider 0 0 1", "slider 0 0 1 coat 0.1 0.075"),
            "the coat of the body comes to the periodic face in y", "leave the coat out, make the boundary fixed")
    corners = "".join(f"create_atoms 1 single {x} {y} -1 units box\n" for x in (-1, 1) for y in (-0.41, 0.41))
    coat = script(fix + "coat 0.1 0.075 mesh floor.stl nodes all", corners + "set group all diameter 0.01 density 1\n", 1e-3)
    refused("a coat beside nodes", coat, "its coat cannot feel meshes whose nodes move")
