# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The books of energy at the coats of bodies, against closed forms, and that they close."""

import math
import pathlib

import lmp
import stl
import vtp
from facts import at_most, fact
from test_energy import CAUSES, COLUMNS, E, NAMES, check_bounces, close, nothing_but

# Columns of the fix.
HEIGHT, ENERGY, DRIVE = 17, 35, 70

# A grain that touches nothing.
SCRIPT = lmp.head("-3 3 -3 3 -1 5") + """\
create_atoms    1 single 2.5 2.5 4 units box
set             group all diameter 0.01 density 1
pair_style      zero 1.2
pair_coeff      * *
fix             wall all wall/lsdcd {law} {words} energy
timestep        {dt}
thermo_style    custom step {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
{run}
"""

K, RADIUS, POINTS = 1e3, 0.05, 13    # points of a face of the cube, see test_body_coat.cpp


def prepare(folder):
    stl.write(folder / "floor.stl", stl.square(3))
    stl.write(folder / "cube.stl", stl.box((-0.2,) * 3, (0.2,) * 3))
    stl.write(folder / "small.stl", stl.box((-0.15,) * 3, (0.15,) * 3))


def rows_of(folder, law, words, dt, run, columns=(), ranks=1, script=SCRIPT):
    """All rows of thermo."""
    return rows_in(lmp.run_well(filled(law, words, dt, run, columns, script), folder, ranks), columns)


def filled(law, words, dt, run, columns=(), script=SCRIPT):
    return script.format(law=law, words=words, dt=repr(dt), run=run, columns=" ".join([*COLUMNS, *columns]))


def rows_in(out, columns=()):
    return [dict(zip(("step", *NAMES, *columns), row)) for row in lmp.read_thermo(out)]


def cube(mass, x, z, joint, more=""):
    return (f"mesh floor.stl mesh cube.stl move {x!r} 0.2 {z!r} body mass {mass} com {x!r} 0.2 {z!r} inertia 1 1 1 0 0 0 coat 0.2 {RADIUS} "
            f"joint slider {joint} {more}")


BODY = f"f_wall[{ENERGY}]"
OF_FLOOR, OF_CUBE = (f"f_wall[{mesh}][{DRIVE}]" for mesh in (1, 2))


def test_bounce(folder):
    """A cube that falls flat on its coat at speed 1 loses 0.75 m v^2/2 by damping, and the books close as those of a sphere."""
    mass = 0.64
    half = mass / 2

    def falls(n):
        dt = math.pi / math.sqrt(POINTS * K / mass) / n
        columns = (BODY, OF_FLOOR, OF_CUBE)
        texts = lmp.run_in_a_row([filled(f"granular hooke {K} {E} damping coeff_restitution tangential linear_nohistory 0 0",
                                         cube(mass, 0.1, 0.2 + RADIUS + (5 + k / 8) * dt, "0 0 1", "velocity 0 0 -1"), dt, f"run {3 * n}", columns)
                                  for k in range(8)], folder)
        return [rows_in(text, columns)[-1] for text in texts]

    def check(n, r):
        at_most(f"{n} steps: work, and what the cube loses", abs(r["work"] - (half - r[BODY])), 1e-12)
        at_most(f"{n} steps: the cube has done all of it", abs(r[OF_CUBE] - r["work"]) + abs(r[OF_FLOOR]), 1e-12)
    check_bounces(falls, half, check)


MU, DEEP = 0.3, 0.01
PRESS = POINTS * K * DEEP
LIES = 0.2 + RADIUS - DEEP


def test_body_that_slides(folder):
    """A cube that slides on its coat, held down by its joint, loses mu F s by the slider alone."""
    mass, v, dt, n = 50.0, 0.7, 1e-4, 2000
    b = rows_of(folder, f"hooke {K} NULL 0 100 {MU} 1", cube(mass, -1.0, LIES, "1 0 0", f"velocity {v} 0 0"), dt, f"run {n}", (BODY, OF_CUBE))[-1]
    force, t = MU * PRESS, n * dt
    lost = force * (v * t - 0.5 * force / mass * t * t)
    close("slider", b["slider"], lost, lost, 1e-11)
    close("what the cube loses", 0.5 * mass * v * v - b[BODY], lost, lost, 1e-11)
    close("the work of the cube is that", b[OF_CUBE], lost, lost, 1e-11)
    close("the books close", b["remainder"], 0, lost, 1e-11)
    nothing_but(b, lost, "slider", "inserted")


def test_belts(folder):
    """A cube that is held on a belt, and one whose own belt runs on the floor: the work of the belt is mu F v t, and counts with the floor, which the
    points touch. The cube, which does not move, does none."""
    v, dt, n = 0.8, 1e-4, 2000
    words = cube(50.0, 0.1, LIES, "0 0 1", "spring 1e9 0 0")
    for name, text in (("belt", words.replace("floor.stl", f"floor.stl surface_vel {v} 0 0")), ("crawler", words + f" surface_vel {v} 0 0")):
        b = rows_of(folder, f"hooke {K} NULL 0 100 {MU} 1", text, dt, f"run {n}", (OF_FLOOR, OF_CUBE))[-1]
        lost = MU * PRESS * v * dt * n
        gives_way = POINTS * K / 1e9
        close(f"{name}: slider", b["slider"], lost, lost, 2 * gives_way)
        close(f"{name}: work of the belt", b[OF_FLOOR], lost, lost, 2 * gives_way)
        close(f"{name}: work of the cube", b[OF_CUBE], 0, lost, 2 * gives_way)
        close(f"{name}: the books close", b["remainder"], 0, lost, 1e-9)


# ---- two bodies --------------------------------------------------------------------------

LAW = "granular hooke 1e4 10 damping mass_velocity tangential linear_history 5e3 1 0.3 rolling sds 30 0.01 0.05 twisting sds 5 0.001 0.01"
CONTACT = math.pi / math.sqrt(4e4 / 0.5)    # of four points with half of a body
SEEN = tuple(f"f_wall[{mesh}][{k}]" for mesh in (2, 3) for k in (ENERGY, HEIGHT, DRIVE))
MASSES = (1.0, 0.6)


def two(shift=0.0, slower=0.0):
    """Two cubes with coats, spinning, of which one falls on the other as that falls on the floor."""
    return ("mesh floor.stl "
            "mesh cube.stl rotate 1 2 3 20 move 0 0 0.5 body mass 1 com 0 0 0.5 inertia 0.03 0.035 0.04 0 0 0 "
            f"coat 0.08 0.06 gravity 0 0 -10 velocity 0.3 0.1 {slower - 1!r} omega 1 2 0.5 "
            f"mesh small.stl rotate 3 1 2 40 move {0.2 + shift!r} 0.1 1.05 body mass 0.6 com {0.2 + shift!r} 0.1 1.05 inertia 0.01 0.011 0.012 0 0 0 "
            "coat 0.08 0.06 gravity 0 0 -10 velocity -0.2 0.2 -2 omega -1 0.5 3")


def test_two_bodies(folder):
    """Bodies that hit, slide, roll and twist on a floor and on each other: what each loses is its work on contacts, and the rows have it, but for a
    remainder which falls with dt^2, as both do. Contacts of points begin anywhere within a step, so that the remainder is the root mean square of falls that
    differ: of e contacts each with a part of k d (v dt - d)/2, it is dt^2 times a number that falls alone decide."""
    falls, of_bodies, of_rows = 8, {}, {}
    for n in (25, 50, 100, 200):
        dt = CONTACT / n
        of_bodies[n] = of_rows[n] = 0
        for k in range(falls):
            a, b = rows_of(folder, LAW, two(0.01 * k, 0.03 * (k * 5 % falls)), dt, f"run {round(0.3 / dt)}", SEEN)
            fact(f"{n} steps: all causes dissipate", all(b[c] > 1e-3 for c in ("damping", "slider", "rolling", "twisting")), b)
            for mesh, mass in zip((2, 3), MASSES):
                energy, height, drive = (f"f_wall[{mesh}][{c}]" for c in (ENERGY, HEIGHT, DRIVE))
                lost = a[energy] - b[energy] + 10 * mass * (a[height] - b[height])
                of_bodies[n] += abs(lost - b[drive]) / b["work"] / falls
            of_rows[n] += (b["remainder"] / b["work"]) ** 2 / falls
            at_most("a floor at rest does no work", abs(b["drive"] - b["work"]) / b["work"], 1e-12)
        of_rows[n] **= 0.5
    print("what bodies lose less their work, and remainder, over the work:", of_bodies, of_rows)
    for n in (25, 50, 100):
        close(f"bodies: it falls with dt^2 from {n} steps on", of_bodies[n] / of_bodies[2 * n], 4, 4, 0.1)
    for n, remainder in of_rows.items():
        at_most(f"rows: remainder at {n} steps, which falls with dt^2", remainder, 1.5e-3 * (25 / n) ** 2)


def test_processes_and_restart(folder):
    """All rows have the same bits on 1 and 4 processes and after a restart in the middle of contacts."""
    dt = CONTACT / 100
    half = 900

    def last(run, ranks=1, script=SCRIPT):
        return rows_of(folder, LAW, two(), dt, run, SEEN, ranks, script)[-1]
    whole = last(f"run {half}\nrun {half}")
    fact("4 processes", last(f"run {half}\nrun {half}", 4) == whole)
    middle = last(f"run {half}\nwrite_restart half.restart")
    fact("contacts are open where it is written", middle["held"] > 1e-3 and abs(whole["held"] - middle["held"]) > 1e-3, middle)
    lines = SCRIPT.splitlines(keepends=True)
    first = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    again = "atom_modify map array\nread_restart half.restart\ncomm_modify vel yes\n" + "".join(lines[first:])
    for ranks in (1, 4):
        fact(f"restarted on {ranks}", last(f"run {half}", ranks, again) == whole)


def test_triangles(folder):
    """Triangles of a mesh that points touch have what their contacts dissipate, in all as of the mesh, on 1 and 4 processes. No contact of a coat is an
    impact."""
    dt = CONTACT / 100
    names = ("floor", "cube", "small")
    words = two() + " impacts 1e-6"
    for name in names:
        words = words.replace(f"{name}.stl", f"{name}.stl mesh_fields {name}_*.vtp every 1000")
    columns = [f"f_wall[{mesh}][{60 + c}]" for mesh in (1, 2, 3) for c in range(5)]
    found = []
    for ranks in (1, 4):
        b = rows_of(folder, LAW, words, dt, "run 2000", [*columns, "f_wall[73]"], ranks)[-1]
        of = [vtp.read(pathlib.Path(folder) / f"{name}_2000.vtp")["dissipated_energy"] for name in names]
        for k, name in enumerate(names):
            lost = sum(b[c] for c in columns[5 * k:5 * k + 5])
            fact(f"{name}: it is touched", lost > 1e-3, lost)
            at_most(f"{name}: by triangle as of the mesh", abs(math.fsum(of[k]) - lost) / lost, 1e-12)
        at_most("rows of meshes add up", abs(sum(b[c] for c in columns) - sum(b[c] for c in CAUSES)) / b["work"], 1e-12)
        fact("no impacts", b["f_wall[73]"] == 0)
        found.append(of)
    # Threads add up in another order.
    at_most("the same on 4 processes", max(abs(x - y) for a, b in zip(*found) for x, y in zip(a, b)) / max(map(max, found[0])), 1e-12)


def test_wear_below_a_coat(folder):
    """A sphere that spins on a floor wears it, and the floor sinks below a cube on its coat, too: what it takes from their contacts is their weights
    times their depths, and the cube has lost what its work says."""
    weight, mass = 100.0, 20.0
    script = SCRIPT.replace("create_atoms    1 single 2.5 2.5 4 units box\nset             group all diameter 0.01 density 1",
                            f"create_atoms 1 single 0.5 -0.4 {0.5 - weight / 1e4!r} units box\nset group all diameter 1 mass 1\nset group all omega 0 20 0")
    script = script.replace("timestep", "variable z equal xcm(all,z)\nfix move all nve/sphere\nfix fall all gravity 100 vector 0 0 -1\ntimestep", 1)
    at = 0.2 + RADIUS - 10 * mass / (POINTS * 1e4)
    words = (f"mesh floor.stl mesh cube.stl move 1.5 -1 {at!r} body mass {mass} com 1.5 -1 {at!r} inertia 1 1 1 0 0 0 coat 0.2 {RADIUS} "
             "joint slider 0 0 1 gravity 0 0 -10 wear_factor 0 wear archard 0.02 50 deform every 10")
    a, b = rows_of(folder, "hooke 1e4 NULL 20 NULL 0 0", words, 1e-3, "run 500", ("f_wall[75]", "v_z", f"f_wall[2][{HEIGHT}]", OF_CUBE, BODY), script=script)
    sunk, of_cube = a["v_z"] - b["v_z"], a[f"f_wall[2][{HEIGHT}]"] - b[f"f_wall[2][{HEIGHT}]"]
    fact("both sink", sunk > 1e-3 and of_cube > 1e-3, (sunk, of_cube))
    taken = weight * sunk + 10 * mass * of_cube
    close("what wear takes", b["f_wall[75]"], taken, taken, 0.02)
    at_most("the cube has lost its height, but for (F dt)^2/8m", abs(b[OF_CUBE] - 10 * mass * of_cube + b[BODY]), (10 * mass * 1e-3) ** 2 / 8 / mass)
    at_most("the books close", abs(b["remainder"]) / taken, 1e-4)
