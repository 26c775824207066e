# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Ellipsoids at a bumpy floor that turns, in a tray that rests: balls go as spheres do, and a run is the same on any number of
processes that continue it from a restart file. One that comes down leaves as a closed form has it. Under
the LAMMPS of hosts/build_host.sh superellipsoids, too, beside LAMMPS's own contact of two grains, of which one is so large
that it is a plane."""

import math
import re
import subprocess

import numpy
import pytest

import lmp
import scene
import stl
from facts import at_most, fact
from pages import ROOT, Page

FIRST, SECOND = 350, 150
LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
DUMP = "x y z vx vy vz {} fx fy fz tqx tqy tqz f_wall[1]"


def head(box, style, types=1):
    return lmp.head(box, style=style, modify="map array sort 40 1.5", types=types)


FLOOR_BOX = "-6 6 -6 6 -1.5 8"
CREATE = """\
lattice         sc 0.6
region          fill block -4 4 -4 4 1.0 1.4 units box
create_atoms    1 region fill
"""
SPHERES = "set group all diameter 1.0\nset group all density 2.0\n"
BALLS = "set group all shape 1 1 1\nset group all density 2.0\n"
WITH_BLOCK = "set group all block {} {}\n"
# The mass first: LAMMPS 4Jul2026 makes the inertia of superellipsoids of it when it sets their shape.
ELLIPSOIDS = "set group all mass 0.9\nset group all shape 1.4 0.9 0.7\nset group all quat/random 7331\n"
START = "velocity all create 4.0 4711 loop geom\nvelocity all set NULL NULL -2.0 sum yes\n"


def forces(integrator, law=LAW, more=""):
    return lmp.pairs("zero 1.5") + f"""\
fix             move all {integrator}
fix             pull all gravity 8.0 vector 0.5 0.2 -1.0
fix             wall all wall/lsdcd {law} mesh floor.stl motion rotate 0 0 0 0 0 1 20 mesh tray.stl contacts {more}
timestep        0.001
"""


def dump(name, spin):
    return f"""\
dump            {name} all custom 50 {name} id {DUMP.format(spin)}
dump_modify     {name} sort id format float %.17g
"""


def write_meshes(folder):
    scene.write_floor(folder / "floor.stl", side=8.5, cells=30)
    tray = []
    for a, b in (((-5, -5), (5, -5)), ((5, -5), (5, 5)), ((5, 5), (-5, 5)), ((-5, 5), (-5, -5))):
        tray += stl.quad((*a, -1), (*b, -1), (*b, 8), (*a, 8))
    stl.write(folder / "tray.stl", tray)


def go(folder, name, style, atoms, integrator, spin):
    lmp.run_well(head(FLOOR_BOX, style) + CREATE + atoms + START + forces(integrator) +
                 f"run {FIRST}\nwrite_restart {name}.restart\n" + dump(name, spin) + f"run {SECOND}\n", folder)
    return lmp.read_dump(folder / name)


def proceed(folder, restart, name, ranks, style="ellipsoid"):
    lmp.run_well(head("", style) + f"read_restart {restart}\n" + forces("nve/asphere") +
                 dump(name, "angmomx angmomy angmomz") + f"run {SECOND}\n", folder, ranks)
    return lmp.read_dump(folder / name)


def prepare(folder):
    write_meshes(folder)


def test_impact(folder):
    """Half-axes 2, 1, 1, mass 1, long axis at 45 degrees, speed 1, no friction."""
    stl.write(folder / "plane.stl", stl.square(6))
    text = lmp.run_well(head("-6 6 -6 6 -1 8", "ellipsoid") + """\
create_atoms    1 single 0 0 1.5811398
set             atom 1 shape 4 2 2
set             atom 1 quat 0 1 0 45
set             atom 1 mass 1
velocity        all set 0 0 -1
pair_style      zero 4.1
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd hooke 1e8 NULL 0 NULL 0 0 mesh plane.stl
variable        v equal vcm(all,z)
compute         spin all property/atom angmomy
compute         sum all reduce sum c_spin
variable        l equal c_sum
timestep        5e-7
thermo_style    custom step v_v v_l
thermo          2000
thermo_modify   format float %.17g
run             2000
""", folder)
    _, v, spin = lmp.read_thermo(text)[-1]
    at_most("impact: velocity upwards", abs(v - 0.052632), 5e-5)
    # The inertia about y is 1/5 m (2^2 + 1^2) = 1.
    at_most("impact: angular velocity", abs(abs(spin) - 0.998614), 1e-4)


def test_timestep(folder):
    """The warning has the contact time of a rod (5, 1, 1) that meets a plane where its arm is longest, or at most 0.3 less."""
    stl.write(folder / "plane.stl", stl.square(9))
    text = lmp.run_well(head("-9 9 -9 9 -1 9", "ellipsoid") + """\
create_atoms    1 single 0 0 6
set             atom 1 shape 10 2 2
set             atom 1 mass 1
pair_style      zero 11
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd hooke 100 NULL 0 NULL 0 0 mesh plane.stl
timestep        1
run             0
""", folder)
    # The longest arm of an ellipse is the difference of its half-axes.
    mass = 1 / (1 + (5 - 1)**2 / (0.2 * (5**2 + 1**2)))
    said = float(re.search(r"a tenth of the shortest contact time (\S+):", text)[1])
    share = said / (math.pi * math.sqrt(mass / 100))
    fact("timestep: the contact time of a rod", 0.7 < share <= 1, str(share))


def test_balls(folder):
    spheres = go(folder, "spheres", "sphere", SPHERES, "nve/sphere", "omegax omegay omegaz")
    balls = go(folder, "balls", "ellipsoid", BALLS, "nve/asphere", "angmomx angmomy angmomz")
    inertia = 0.4 * (2.0 * math.pi / 6) * 0.5**2
    for rows in balls.values():
        for row in rows.values():
            row[6:9] = [number / inertia for number in row[6:9]]
    touching = sum(row[-1] > 0 for row in spheres[FIRST].values())
    fact("balls: some touch", touching > 20, str(touching))
    # 500 steps of contacts that part neighbouring paths: a factor of 1e5 on 1e-15 at most.
    at_most("balls: they go as spheres do", lmp.largest_difference(spheres, balls), 1e-10)


def test_ellipsoids(folder):
    one = go(folder, "one", "ellipsoid", ELLIPSOIDS, "nve/asphere", "angmomx angmomy angmomz")
    touching = sum(row[-1] > 0 for row in one[FIRST].values())
    fact("ellipsoids: some touch where it breaks", touching > 20, str(touching))
    for ranks in (1, 2, 4):
        at_most(f"ellipsoids: continued from a restart file on {ranks} ranks",
                lmp.largest_difference(one, proceed(folder, "one.restart", f"again{ranks}", ranks)), 0)


def test_folds(folder):
    """Rods and discs come down into pits, where contacts share, fade and have couples. The run goes on from a restart file as it went, also
    with longer neighbour lists and on any number of processes."""
    def pit(i, j):
        return i - 6.5, j - 6.5, 0.5 * math.sin(1.9 * i) + 0.4 * math.cos(2.3 * j + i)

    tray = [stl.quad((*a, -2), (*b, -2), (*b, 8), (*a, 8))
            for a, b in (((-5, -5), (5, -5)), ((5, -5), (5, 5)), ((5, 5), (-5, 5)), ((-5, 5), (-5, -5)))]
    stl.write(folder / "pits.stl", stl.sheet(13, pit) + sum(tray, []))
    grains = ELLIPSOIDS + "set group all type/fraction 2 0.5 991\nset type 1 shape 1.6 0.6 0.6\nset type 2 shape 1.2 1.2 0.7\n"
    wall = lmp.pairs("zero 1.7") + """\
fix             move all nve/asphere
fix             pull all gravity 8.0 vector 0.5 0.2 -1.0
fix             wall all wall/lsdcd hooke/history 1e3 NULL 40 NULL 0.4 1 mesh pits.stl contacts
timestep        0.001
"""
    # Velocities are made once: the sums by which LAMMPS scales them depend on the number of processes.
    lmp.run_well(head("-6 6 -6 6 -3 9", "ellipsoid", types=2) + CREATE + grains + START + wall + "run 0\nwrite_restart start\n", folder)

    def go_on(name, restart, ranks=1, more=""):
        lmp.run_well(head("", "ellipsoid", types=2) + f"read_restart {restart}\n" + wall + more + dump(name, "angmomx angmomy angmomz") +
                     "run 300\n", folder, ranks)
        return lmp.read_dump(folder / name)

    one = go_on("one", "start", more="run 500\nwrite_restart later\n")
    several = sum(row[-1] > 1 for rows in one.values() for row in rows.values())
    fact("folds: many grains have several contacts", several > 50, str(several))
    for ranks in (1, 2, 4):
        at_most(f"folds: continued from a restart file on {ranks} ranks", lmp.largest_difference(one, go_on("again", "later", ranks)), 0)
        more = "neighbor 1.5 bin\n" if ranks == 1 else ""
        at_most(f"folds: from the start, {'with longer lists' if more else f'on {ranks} ranks'}",
                lmp.largest_difference(one, go_on("again", "start", ranks, more + "run 500\n")), 0)


def contacts_of(folder, name):
    """The rows of each_contact, by atom: mesh, force, point, overlap."""
    rows = {}
    for line in (folder / name).read_text().split("ENTRIES")[-1].splitlines()[1:]:
        atom, *row = map(float, line.split())
        rows.setdefault(atom, []).append(row)
    return {atom: sorted(of_atom) for atom, of_atom in rows.items()}


@pytest.mark.parametrize("exponents", [None, pytest.param("4 8", marks=lmp.of_host)])
def test_each_contact(folder, exponents):
    """Without friction and damping a contact that is the only one of its grain bears kn times its overlap."""
    style = "ellipsoid superellipsoid" if exponents else "ellipsoid"
    atoms = ELLIPSOIDS + (WITH_BLOCK.format(*exponents.split()) if exponents else "")
    wall = forces("nve/asphere", "hooke/history 1e3 NULL 0 NULL 0 1", "each_contact")
    columns = " ".join(f"f_wall[{k}]" for k in range(1, 10))
    last = "".join(f"""\
dump            {{name}}{kind} all {kind} 20 {{name}}.{kind} {what}
dump_modify     {{name}}{kind} format float %.17g
""" for kind, what in (("local", columns), ("custom", "id f_wall[1] f_wall[2] f_wall[3] f_wall[4]"))) + "run 20\n"
    lmp.run_well(head(FLOOR_BOX, style) + CREATE + atoms + START + wall +
                 "run 280\nwrite_restart each.restart\n" + last.format(name="one"), folder)
    found, bears = contacts_of(folder, "one.local"), lmp.read_dump(folder / "one.custom")[300]
    alone = [rows[0] for rows in found.values() if len(rows) == 1]
    fact("each contact: many grains have one, and some have more", 10 < len(alone) < len(found), str(len(found)))
    # The foot and the support of the grain are rounded, at sizes of 1 and 8.
    at_most("each contact: the force is kn times the overlap",
            max(abs(math.hypot(*row[1:4]) - 1e3 * row[7]) for row in alone), 1e3 * 1e-13)
    fact("each contact: all of each grain are there", {i: len(rows) for i, rows in found.items()} ==
         {i: row[0] for i, row in bears.items() if row[0] > 0}, str(len(found)))
    at_most("each contact: the forces add up to that on the grain",
            max(abs(sum(row[1 + k] for row in rows) - bears[i][1 + k]) / max(map(abs, bears[i][1:4] + [1]))
                for i, rows in found.items() for k in range(3)), 1e-12)
    for ranks in (1, 2, 4):
        lmp.run_well(head("", style) + "read_restart each.restart\n" + wall + last.format(name=f"on{ranks}"), folder, ranks)
        fact(f"each contact: continued from a restart file the same on {ranks} ranks",
             contacts_of(folder, f"on{ranks}.local") == found, "")


def test_periodic(folder):
    """An ellipsoid on the face of a periodic box, and where the waves that it rolls on go on."""
    def waves(name, first, last):
        n = 12    # squares of half a unit in a period
        def at(i, j):
            return i / 2 - 3, j / 2 - 3, -0.25 * math.cos(2 * math.pi * (i % n) / n) + 0.2 * math.cos(4 * math.pi * (j % n) / n)
        squares = [stl.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(first, last) for j in range(first, last)]
        stl.write(folder / name, sum(squares, []))

    waves("period.stl", 0, 12)
    waves("periods.stl", -12, 24)
    paths = []
    for mesh, edge, side in (("period.stl", "p", 3), ("periods.stl", "f", 9)):
        lmp.run_well(lmp.head(f"-{side} {side} -{side} {side} -6 6", f"{edge} {edge} f", "ellipsoid") + f"""\
create_atoms    1 single 2.9 0.1 0.9
set             atom 1 mass 1
set             atom 1 shape 2 1 1.6
set             atom 1 quat 1 2 0.5 40
velocity        all set 1.0 0.3 -1
""" + lmp.pairs("zero 2.0") + f"""\
fix             move all nve/asphere
fix             pull all gravity 8 vector 0 0 -1
fix             wall all wall/lsdcd hooke/history 1e3 NULL 20 NULL 0.5 1 mesh {mesh} contacts
timestep        1e-3
dump            out all custom 20 out id xu yu z vx vy vz angmomx angmomy angmomz f_wall[1]
dump_modify     out format float %.17g
run             1000
""", folder)
        paths.append(lmp.read_dump(folder / "out"))
    beyond = sum(rows[1][0] > 3 and rows[1][-1] > 0 for rows in paths[0].values())
    fact("a periodic box: it touches on both sides of a face", beyond > 3 and paths[0][0][1][0] < 3, str(beyond))
    # Places beyond the face are rounded otherwise; a few bounces part them by a factor of 1e3 at most.
    at_most("a periodic box: it goes as on three periods", lmp.largest_difference(*paths), 1e-11)


def test_between_plates(folder):
    """A rod turns between two plates: one end touches below, then the other one above, so that both contacts turn it alike with normals that are opposite,
    or nearly so. Nothing of a spring goes from one to the other: without friction the rod goes as with a law that has no spring, and with friction it does
    not gain energy."""
    def go_between(law, tilt):
        low, high = 0.6 - 3 * tilt, 0.6 + 3 * tilt
        upper = stl.quad((-3, -3, low), (-3, 3, low), (3, 3, high), (3, -3, high))
        stl.write(folder / "slit.stl", stl.square(3, -0.6) + upper)
        rows = lmp.read_thermo(lmp.run_well(head("-3 3 -3 3 -3 3", "ellipsoid") + f"""\
create_atoms    1 single 0 0 -0.002 units box
set             atom 1 mass 1
set             atom 1 shape 2 0.4 0.4
set             atom 1 quat 0 1 0 20
set             atom 1 angmom 0 0.4 0
pair_style      zero 2.2
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd {law} mesh slit.stl
compute         turn all erotate/asphere
compute         each all property/atom angmomy
compute         spin all reduce sum c_each
variable        z equal z[1]
timestep        1e-4
thermo_style    custom step pe ke c_turn v_z c_spin
thermo_modify   format float %.17g norm no
thermo          500
run             5000
""", folder))
        fact(f"between plates, {law}, {tilt}: all are numbers", rows[-1][0] == 5000 and all(map(math.isfinite, sum(rows, []))), str(rows[-1]))
        return rows

    hertz = "granular hertz 1e5 0 damping velocity tangential"
    laws = ("hooke 1e4 NULL 0 NULL 0 1", "hooke/history 1e4 7e3 0 0 {mu} 1"), (f"{hertz} linear_nohistory 0 0", hertz + " mindlin 7e4 0 {mu}")
    for plain, spring in laws:
        for tilt in (0, 1e-9):
            without, smooth, rough = (go_between(law, tilt) for law in (plain, spring.format(mu=0), spring.format(mu=0.5)))
            name = f"between plates, {spring}, {tilt}"
            fact(f"{name}: it is turned back", without[-1][5] < -0.3, str(without[-1]))
            at_most(f"{name}: without friction it goes as without a spring", max(abs(u - v) for a, b in zip(without, smooth) for u, v in zip(a, b)), 1e-12)
            first, last = (sum(row[1:4]) for row in (rough[0], rough[-1]))
            fact(f"{name}: with friction it gains nothing", 0 < last <= first, str(rough))


def test_rerun(folder):
    """LAMMPS reads no orientation from a dump: the grains would lie as they did before."""
    stl.write(folder / "plane.stl", stl.square(6))
    lmp.refused("a rerun with ellipsoids", head("-6 6 -6 6 -6 6", "ellipsoid") + """\
create_atoms    1 single 0 0 0.95
set             atom 1 shape 1 1 2
set             atom 1 mass 1
pair_style      zero 2.0
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd hooke 1e4 NULL 0 NULL 0 0 mesh plane.stl
dump            out all custom 1 out id type x y z vx vy vz
run             1
undump          out
set             atom 1 quat 1 0 0 90
rerun           out dump x y z vx vy vz
""", folder, "a rerun has no orientations of ellipsoids, because no dump gives them back")


def test_body(folder):
    """An ellipsoid hits a free cube beside its middle, with friction: momentum and angular momentum of both stay."""
    stl.write(folder / "cube.stl", stl.box((-1,) * 3, (1,) * 3))
    mass = 2    # of the cube, with the inertia 1 about each axis
    shown = "x[1] y[1] z[1] vx[1] vy[1] vz[1] " + " ".join(f"C_spin[1][{k}]" for k in (1, 2, 3))
    shown += "".join(f" f_wall[{k}]" for k in (15, 16, 17, 18, 19, 20, 25, 26, 27))    # centre, velocity, angular velocity
    lmp.run_well(head("-6 6 -6 6 -6 6", "ellipsoid") + f"""\
create_atoms    1 single -0.4 0.3 1.6
set             atom 1 shape 1.0 0.5 0.5
set             atom 1 mass 1
set             atom 1 quat 1 1 0 30
velocity        all set 0.4 0.1 -1
pair_style      zero 2.0
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd hooke/history 1e4 7e3 5 0 0.5 1 mesh cube.stl body mass {mass} com 0 0 0 inertia 1 1 1 0 0 0 gravity 0 0 0
compute         spin all property/atom angmomx angmomy angmomz
timestep        5e-4
fix             out all print 100 "{' '.join(f'$({word}:%.17g)' for word in shown.split())}" file out.txt screen no
run             2000
""", folder)
    rows = lmp.read_rows(folder / "out.txt")

    def books(row):
        x, v, spin, at, speed, omega = (row[k:k + 3] for k in range(0, 18, 3))
        of_grain, of_cube = numpy.cross(x, v), numpy.cross(at, speed)
        return [v[k] + mass * speed[k] for k in range(3)] + [of_grain[k] + spin[k] + mass * of_cube[k] + omega[k] for k in range(3)]

    fact("a free cube: the ellipsoid turns it", max(map(abs, rows[-1][15:])) > 0.05, str(rows[-1][15:]))
    off = max(abs(u - v) for row in rows for u, v in zip(books(row), books(rows[0])))
    at_most("a free cube: momentum and angular momentum stay", off, 1e-12)


def test_hybrid(folder):
    """A sphere, a ball and an ellipsoid, each 0.01 in a plane; a region and a flow go by their centres."""
    stl.write(folder / "plane.stl", stl.square(6))
    stl.write(folder / "gate.stl", stl.square(6, 0.4))
    lo, hi = [stl.square(5, z) for z in (0.4, 5)]
    sides = [stl.quad((*a, 0.4), (*b, 0.4), (*b, 5), (*a, 5))
             for a, b in (((-5, -5), (5, -5)), ((5, -5), (5, 5)), ((5, 5), (-5, 5)), ((-5, 5), (-5, -5)))]
    stl.write(folder / "upper.stl", [t[::-1] for t in lo] + hi + sum(sides, []))
    text = lmp.run_well(head(FLOOR_BOX, "hybrid sphere ellipsoid") + """\
create_atoms    1 single -2 0.3 0.49
create_atoms    1 single 2 0.3 0.49
create_atoms    1 single 0 3 0.29
set             group all diameter 1
set             group all density 2
set             atom 2 shape 1 1 1
set             atom 3 shape 1.4 0.9 0.6
velocity        all set 0 0 0.2
pair_style      zero 1.5
pair_coeff      * *
fix             move all nve
fix             wall all wall/lsdcd hooke 1e4 NULL 0 NULL 0 0 mesh plane.stl
fix             flow all massflow/lsdcd mesh gate.stl
region          upper mesh/lsdcd upper.stl
variable        above equal count(all,upper)
compute         push all reduce min fz
compute         most all reduce max fz
timestep        0.001
thermo_style    custom step c_push c_most v_above f_flow[1]
thermo          800
thermo_modify   format float %.17g
run             800
""", folder)
    rows = lmp.read_thermo(text)
    at_most("hybrid: each has the push of its overlap", max(abs(rows[0][k] - 100) for k in (1, 2)), 1e-9)
    fact("hybrid: a region has atoms by their centres", [row[3] for row in rows] == [2, 3], str(rows))
    fact("hybrid: a flow counts the centre that passes", rows[-1][4] == 1, str(rows))


@lmp.of_host
def test_superellipsoids(folder):
    style, spin = "ellipsoid superellipsoid", "angmomx angmomy angmomz"
    plain = go(folder, "plain", "ellipsoid", ELLIPSOIDS, "nve/asphere", spin)
    twos = go(folder, "twos", style, ELLIPSOIDS + WITH_BLOCK.format(2, 2), "nve/asphere", spin)
    at_most("exponents of 2: they go as ellipsoids do", lmp.largest_difference(plain, twos), 1e-10)
    tablets = go(folder, "tablets", style, ELLIPSOIDS + WITH_BLOCK.format(4, 8), "nve/asphere", spin)
    touching = sum(row[-1] > 0 for row in tablets[FIRST].values())
    fact("exponents of 4 and 8: some touch where it breaks", touching > 20, str(touching))
    at_most("exponents of 4 and 8: continued from a restart file",
            lmp.largest_difference(tablets, proceed(folder, "tablets.restart", "again", 1, style)), 0)


def grain_on(folder, floor, law, grain, run):
    """One grain above z = 0: a mesh (floor 0), or a ball of that radius. Rows of x, v, angular momentum and force."""
    stl.write(folder / "plane.stl", stl.square(9))
    ball = f"create_atoms 2 single 0 0 -{floor}\n"
    lmp.run_well(head(f"-9 9 -9 9 -{1.5 * floor + 1} 9", "ellipsoid superellipsoid", types=2) + f"""\
create_atoms    1 single {grain["at"]}
{ball if floor else ""}
group           grain type 1
set             type 1 mass 1
set             type 1 shape {grain["shape"]}
set             type 1 block {grain["block"]}
set             type 1 quat 1 2 0.5 {grain.get("angle", 0)}
set             type 2 mass 1e18
set             type 2 shape {2 * floor} {2 * floor} {2 * floor}
set             type 2 block {grain.get("floor", "2 2")}
velocity        grain set 0.3 0.1 -1
pair_style      granular/superellipsoid
pair_coeff      * * {law}
neighbor        0.5 nsq
neigh_modify    delay 0 every 1 check yes
fix             move grain nve/asphere
{"" if floor else f"fix wall grain wall/lsdcd granular {law} mesh plane.stl"}
timestep        4e-5
dump            out grain custom 50 out id x y z vx vy vz angmomx angmomy angmomz fx fy fz
dump_modify     out format float %.17g
run             {run}
""", folder)
    return [rows[1] for _, rows in sorted(lmp.read_dump(folder / "out").items())]


@lmp.of_host
@pytest.mark.parametrize("law", ["hooke 1e5 30 tangential linear_history 7e4 0.5 0.4 damping mass_velocity",
                                 "hertz 1e5 30 tangential linear_history 7e4 0.5 0.4 damping viscoelastic"])
def test_beside_their_contact(folder, law):
    """It comes down obliquely, slips and leaves. Beside a ball of radius R a plane lacks a sag and a curvature of 1/R: what
    is apart falls as 1/R, by the same laws of force, friction and damping."""
    grain = {"at": "0.2 0.1 0.8", "shape": "1.4 0.9 0.7", "block": "4 8", "angle": 25}
    name = law.split()[0]
    mesh = grain_on(folder, 0, law, grain, 5000)
    fact(f"{name}: it leaves", mesh[-1][5] > 0.5 and mesh[-1][11] == 0, str(mesh[-1]))
    apart = []
    for floor in (1e5, 1e6):
        rows = grain_on(folder, floor, law, grain, 5000)
        apart.append(max(abs(u - v) for one, other in zip(mesh, rows) for u, v in zip(one[:9], other[:9])))
    # The sag of 1/R x 2^2 / 2 times the rate sqrt(k / m) = 316 of the contact.
    at_most(f"{name}: beside a ball of radius 1e6", apart[1], 2e-6 * 316)
    fact(f"{name}: what is apart falls as 1/R", 7 < apart[0] / apart[1] < 14, str(apart))


@lmp.of_host
def test_flat_side_is_finite(folder):
    """A flat side on a flat side under hertz has no radius of curvature; the wall's contact radius is at most that around the grain."""
    grain = {"at": "0 0 0.69", "shape": "1.4 1.4 1.4", "block": "4 4", "floor": "4 4"}
    law = "hertz 1e5 30 tangential linear_history 7e4 0.5 0.4"
    theirs = grain_on(folder, 20, law, grain, 0)[0][11]
    fact("a flat side: the force of two grains is not finite in LAMMPS 4Jul2026", not math.isfinite(theirs), str(theirs))
    around = 0.7 * 3**(1 / 4)    # the corner (x, x, x) of 3 (x / 0.7)^4 = 1
    at_most("a flat side: force of the wall", abs(grain_on(folder, 0, law, grain, 0)[0][11] / ((1e5 * 0.01 + 30 * 1) * around) - 1), 1e-10)


@lmp.of_host
def test_script_of_the_page(folder):
    """As it stands, but for the place of the plugin, and for 1 m/s downwards, so that the lowest layer is back from the bottom after a
    tenth of the steps."""
    page = Page("doc/shaped_grains.rst")
    script = next(block.text for block in page.blocks if re.search("^atom_style +ellipsoid superellipsoid", block.text, re.M))
    tool = lmp.pathlib.Path(lmp.LMP).parent / "lsdcd"
    command = re.search(r"`lsdcd (generate cylinder [^`]*)`", page.text)[1]
    subprocess.run([tool, *command.split()], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    faster = "velocity all set NULL NULL -1 units box\nvariable moment equal f_wall[3]*dt\nfix push all ave/time 1 1000 1000 v_moment\nrun 1000"
    script = re.sub(r"^plugin .*", "", re.sub(r"^run .*", faster, script, flags=re.M), flags=re.M)
    text = lmp.run_well(script + "\nprint 'here $(atoms) $(bound(all,zmin)) $(bound(all,xmax)) $(f_push*1000) $(mass(all))'\n", folder)
    atoms = int(re.search(r"Created (\d+) atoms", text)[1])
    left, lowest, widest, push, mass = map(float, re.findall(r"^here (.*)", text, re.M)[-1].split())
    fact("the page's tablets stay in their can", atoms > 300 and left == atoms and lowest > 0 and widest < 0.02, f"{lowest} {widest}")
    # The bottom has stopped at least the lowest layer, of eight.
    fact("... and its bottom has stopped some", -push > mass / 8, f"{push} {mass}")


@lmp.of_host
@pytest.mark.parametrize("grain", ["rice", "tablet", "sphere"])
def test_examples(folder, grain):
    """The hopper and the drum of examples/rice, with fewer grains and steps: some come to the wall, none is lost, and all is finite."""
    for script, words in (("in.rice", "number 100 fill 0.08 begin 0.0122 flow 0.0004 end 0.0004"),
                          ("in.rice-drum", "number 200 fill 0.045 begin 0.001 measure 0.005")):
        place = ROOT / "examples" / "rice"
        set_ = "".join(f"variable {name} index {value}\n" for name, value in zip(words.split()[::2], words.split()[1::2]))
        text = lmp.run_well(f"variable dir index {place}\nvariable grain index {grain}\n{set_}" + (place / script).read_text(), folder)
        line = re.search(rf"^{script[3:]} grains (\d+) (.*)", text, re.M)
        fact(f"{script} of {grain}: it prints its numbers", line and int(line[1]) >= 100 and "nan" not in line[2], str(line and line[0]))
        rows = [row.split() for row in re.findall(r"^ +\d+(?: +[-+.e\d]+){8,} *$", text, re.M)]
        fact(f"{script} of {grain}: no grain is lost, and some touch the wall", {row[2] for row in rows} == {line[1]} and
             int(rows[-1][-2]) > 0, str(rows[-1]))
