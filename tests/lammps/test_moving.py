# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes that move: against fix wall/gran, against one another and against closed forms.

Both codes evaluate the same formulas in another order: 1e-12 leaves room for 10^4 operations, see
test_parity.py. LSDCD_QUICK=1 takes one law.
"""

import math
import re

import numpy
import pytest

import lmp
import scene
import stl
import vtp
from facts import at_most, fact
from triangles import turn

LAWS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
        "hooke_history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
        "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 1"}
SMOOTH = "hooke 1e4 NULL 0 0 0 0"
# As fix wall/gran has them: a floor that shakes, one that slides to and fro, a belt.
OF_WALL_GRAN = {"wiggle_z": "wiggle z 0.004 0.02", "wiggle_x": "wiggle x 0.05 0.03",
                "shear_y": "shear y 2.0"}


def one_sphere(folder, name, wall, kick=1, steps=1000, dt=1e-4, style="verlet", unit="lj"):
    text = lmp.run_well(lmp.HERE / "scripts" / "in.one_sphere", folder, wall=wall, out=name, unit=unit,
                        kick=kick, dt=dt, steps=steps, style=style)
    return lmp.read_dump(folder / name), text


def lsdcd(law, more, mesh="floor.stl"):
    return f"wall/lsdcd {law} mesh {mesh} {more}"


def touching(dump):
    return sum(any(abs(f) > 0 for f in row[9:12]) for rows in dump.values() for row in rows.values())


def write_plane(path, cells=100, side=5):
    """2 cells^2 triangles at z = 0."""
    h = 2 * side / cells
    stl.write(path, stl.sheet(cells, lambda i, j: (-side + i * h, -side + j * h, 0)))


def write_drum(path, lo, hi, n=24, radius=2.0):
    """A prism round z without lids."""
    ring = [(radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n))
            for k in range(n)]
    stl.write(path, [t for a, b in zip(ring, ring[1:] + ring[:1])
                     for t in stl.quad((*a, lo), (*b, lo), (*b, hi), (*a, hi))])


NOT_KOKKOS = pytest.mark.skipif(lmp.ON_KOKKOS, reason="wall/gran/kk is another code, and there is no respa with Kokkos")


def prepare(folder):
    write_plane(folder / "plane.stl")
    scene.write_floor(folder / "bumps.stl", side=9, cells=36)
    write_drum(folder / "short.stl", 0, 4)
    write_drum(folder / "corner.stl", 0, 2, n=3)


flat_floor = pytest.fixture(lmp.flat_floor)
hilly_floor = pytest.fixture(scene.bumpy_floor)


@NOT_KOKKOS
def test_compare_with_wall_gran(folder, flat_floor):
    for law_name, law in lmp.sample(LAWS).items():
        for name, words in OF_WALL_GRAN.items():
            theirs = one_sphere(folder, "a", f"wall/gran {law} zplane 0.0 NULL {words}")[0]
            for mesh in ("floor.stl", "plane.stl"):
                ours = one_sphere(folder, "b", lsdcd(law, words, mesh))[0]
                at_most(f"{law_name}, {name}, {mesh}: as fix wall/gran, {touching(theirs)} steps "
                        "in touch", lmp.largest_difference(theirs, ours), 1e-12)
            fact(f"{law_name}, {name}: touches", touching(theirs) > 20)
        theirs = one_sphere(folder, "a", f"wall/gran {law} zplane 0.0 NULL shear x 2.0")[0]
        ours = one_sphere(folder, "b", lsdcd(law, "motion linear 2 0 0"))[0]
        at_most(f"{law_name}: motion linear along a plane is its shear",
                lmp.largest_difference(theirs, ours), 1e-12)


def test_variables(folder, flat_floor):
    """A motion by variables is the one of the same numbers."""
    text = (lmp.HERE / "scripts" / "in.one_sphere").read_text()

    def apart(variables, words, plain=""):
        """How far the sphere is from where it is with plain numbers, if any, and the log."""
        log = lmp.run_well(text.replace("fix             wall", variables + "fix             wall"), folder, wall=lsdcd(LAWS["hooke"], words),
                           out="v", unit="lj", kick=1, dt=1e-4, steps=1000, style="verlet")
        dump = lmp.read_dump(folder / "v")
        return lmp.largest_difference(one_sphere(folder, "a", lsdcd(LAWS["hooke"], plain))[0], dump) if plain else None, log

    waves = ("variable z equal 0.004*sin(2*PI*elapsed*dt/0.02)\n"
             "variable v equal 0.004*2*PI/0.02*cos(2*PI*elapsed*dt/0.02)\n")
    off, log = apart(waves, "motion variable NULL NULL v_z NULL NULL v_v", "motion wiggle 0 0 0.004 0.02")
    # The way of a step over dt is between the two speeds, but for a step in which the speed is largest, by (w dt)^2/8 of it.
    at_most("variables of place and speed are a wiggle", off, (2 * math.pi * 1e-4 / 0.02) ** 2 / 8)
    off = apart(waves, "motion variable NULL NULL v_z NULL NULL NULL", "motion wiggle 0 0 0.004 0.02")[0]
    at_most("variables of place are a wiggle", off, 1e-12)
    fact("and nothing is said of differences", "differences" not in log)
    log = apart(waves, "motion variable NULL NULL v_z NULL NULL NULL")[1]
    fact("the log says that the speed of a place alone is a difference", "velocities are differences over a step" in log)
    # The sum of 2 pi/0.8 dt has 1e3 roundings.
    axis = "motion rotate 0.1 0.2 -7 0 1 1"
    off, log = apart("variable w equal 2*PI/0.8\n", f"{axis} variable NULL v_w", f"{axis} 0.8")
    at_most("a turn by a variable of its speed", off, 1e-10)
    fact("the log says that speeds are added up", "velocities are added up" in log)
    at_most("shear by a variable", apart("variable u equal 2.0\n", "shear y v_u", "shear y 2.0")[0], 0)


RESTING = lmp.head("-3 3 -3 3 -1 9") + """\
create_atoms    1 single 0.3 0.2 2.0 units box
set             group all diameter 1.0 density 2.0
""" + lmp.pairs(skin="{skin}", neigh="{neigh}") + """\
fix             move all nve/sphere
fix             wall all wall/lsdcd {law} mesh floor.stl motion linear 0 0 {v}
timestep        0.0001
run             {steps}
print           "after $(vcm(all,z):%.10g)"
"""


def test_wall_comes(folder, flat_floor):
    """To a sphere at rest, for which LAMMPS alone would never reneighbour: it leaves with 2 V. And a sphere comes to a
    wall at rest, and leaves with V. In the last schedule LAMMPS looks in step 3000, where they are 0.6 apart, and not before
    step 6000, and they touch in step 5000."""
    for neigh, skin in (("delay 0 every 1 check yes", 0.3), ("delay 10 every 10 check no", 0.02), ("delay 3000 every 1 check yes", 0.02)):
        for v, comes, leaves in ((3.0, 0, 6), (0, -3, 3)):
            text = RESTING.format(skin=skin, neigh=neigh, law=SMOOTH, v=v, steps=6000)
            log = lmp.run_well(text.replace("fix             move", f"velocity all set 0 0 {comes}\nfix move"), folder)
            left = float(log.split("\nafter ")[1].split()[0])
            # Half a swing of pi sqrt(m/k) in 300 steps: Verlet is wrong by (1/100)^2/24, and the
            # steps that begin and end it by as much.
            at_most(f"a wall with {v} and a sphere with {comes} ({neigh}, skin {skin})", abs(left - leaves), 1e-4)


def test_wall_leaves_its_box(folder, flat_floor):
    """A floor that has come down from the top of the box bears what lies on it. The sphere is there
    where, when the mesh was placed, the box ended 1 below its centre: further than the skin of 0.02 and the
    room of 5 % that a grid for a mesh at rest has, and than a brick of its fine cells."""
    text = RESTING.format(skin=0.02, neigh="every 1", law=SMOOTH, v="-1.0", steps=6000)
    create, rest = text.split("create_atoms")[0], text.split("pair_style")[1]
    text = create + "pair_style" + rest
    text = text.replace("floor.stl", "floor.stl move 0 0 9 grid 0.06").replace("timestep        0.0001", """\
timestep        0.01
run             900
timestep        0.0001
create_atoms    1 single 0.3 0.2 2.0 units box
set             group all diameter 2.0 density 0.25
velocity        all set 0 0 -5""")
    left = float(lmp.run_well(text, folder).split("\nafter ")[1].split()[0])
    # Of the elastic bounce, at 4 to the floor's 1; Verlet as above.
    at_most("a wall that has left the place where it was pushes", abs(left - 3), 1e-4)


MOVES = "motion wiggle 0.05 0 0.1 0.31 motion rotate 0.5 0.2 0 0 0.1 1 1.7"
LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"


def touches(what, dump):
    near = sum(row[9] > 0 for rows in dump.values() for row in rows.values())
    fact(f"spheres touch {what}", near > 30, str(near))


def test_ranks_and_restart(folder, hilly_floor):
    def go(name, ranks=1, moves=MOVES, between="", start="read_data start.data\n", first="run 500\n", second=300):
        text = lmp.run_well("variable w equal 1+step*0.001\n" + scene.SETTINGS + start + scene.forces(LAW, mesh=f"mesh floor.stl {moves}") +
                            first + between + scene.dump(name, 25) + f"run {second}\n", folder, ranks)
        return lmp.read_dump(folder / name), text

    def proceed(ranks=1, moves=MOVES, second=300):
        return go("c", ranks, moves, start="read_restart two.restart\n", first="", second=second)

    # The order of create_atoms and the sums of velocity depend on the ranks.
    lmp.run_well(scene.CREATE + "write_data start.data\n", folder)
    two = go("two", between="write_restart two.restart\n")[0]
    touches("the moving floor", two)
    for ranks in (2, 4):
        at_most(f"{ranks} ranks as one", lmp.largest_difference(two, go("r", ranks)[0]), 0)
    for ranks in (1, 2, 4):
        continued, text = proceed(ranks)
        at_most(f"continued in mid-motion on {ranks}", lmp.largest_difference(two, continued), 0)
        fact("without a warning", "was written with the motion" not in text)
    text = proceed(moves="motion linear 0 0 0.01", second=0)[1]
    fact("another motion is told",
         "was written with the motion 'wiggle 0.05 0 0.1 0.31, rotate 0.5 0.2 0 0 0.1 1 1.7'"
         in text and "'linear 0 0 0.01', which begins where the mesh was" in text)
    fact("none at all is told", "has none: the mesh stays where the mesh was" in proceed(moves="", second=0)[1])
    # The number of a step does not matter.
    reset = go("reset", between="reset_timestep 10000\n")[0]
    renamed = {step - 10000 + 500: rows for step, rows in reset.items()}
    at_most("reset_timestep moves nothing", lmp.largest_difference(two, renamed), 0)

    # Rows of a table, in the middle of one of them, and an angle that is added up.
    (folder / "arm.txt").write_text("0 0 0 0 0 0 0\n0.11 0.05 0 0.1 0.02 0.01 0\n0.31 0 0 0 0 0 0\n")
    rows = "motion table arm.txt repeat motion rotate 0.5 0.2 0 0 0.1 1 variable NULL v_w"
    two = go("rows", moves=rows, between="write_restart two.restart\n")[0]
    touches("a floor that follows a table", two)
    at_most("a table on 2 ranks as on one", lmp.largest_difference(two, go("r", 2, rows)[0]), 0)
    (folder / "arm.txt").rename(folder / "renamed.txt")
    for ranks in (1, 2):
        continued, text = proceed(ranks, rows.replace("arm", "renamed"))
        at_most(f"continued in a table on {ranks}", lmp.largest_difference(two, continued), 0)
        fact("without a warning of the table", "was written with the motion" not in text)
    (folder / "arm.txt").write_text("0 0 0 0 0 0 0\n0.11 0.05 0 0.1 0.02 0.02 0\n0.31 0 0 0 0 0 0\n")
    fact("other rows are told", "was written with the motion 'table arm.txt repeat, rotate 0.5 0.2 0 0 0.1 1 "
         "variable NULL v_w' and this fix has 'table arm.txt repeat, " in proceed(moves=rows, second=0)[1])


def test_searches(folder, hilly_floor):
    """However near atoms are chosen and contacts are found: the same bits."""

    def go(name, more="", run="run 600\n", neigh="delay 0 every 1 check yes"):
        text = scene.CREATE + scene.forces(LAW, mesh=f"mesh floor.stl {MOVES} {more}")
        text = text.replace("delay 0 every 1 check yes", neigh)
        lmp.run_well(text + scene.dump(name, 50) + run, folder)
        return lmp.read_dump(folder / name)

    plain = go("plain")
    touches("the moving floor", plain)
    for name, words in (("a grid for larger spheres", {"more": "rmax 0.7 grid 0.3"}),
                        ("choices by the engine", {"neigh": "delay 10 every 10 check no"}),
                        ("looks by the engine and by LAMMPS", {"neigh": "delay 10 every 1 check yes"}),
                        ("two runs without setup", {"run": "run 300 post no\nrun 300 pre no\n"})):
        at_most(f"{name}: as plain", lmp.largest_difference(plain, go("other", **words)), 0)
    # fix wall/gran under respa, with time of the outer step.
    if not lmp.ON_KOKKOS:
        lmp.flat_floor(folder, "flat.stl")
        law, words = LAWS["hooke_history"], OF_WALL_GRAN["wiggle_z"]
        respa = {"style": "respa 2 2 pair 2", "dt": 2e-4, "steps": 600}
        theirs = one_sphere(folder, "a", f"wall/gran {law} zplane 0.0 NULL {words}", **respa)[0]
        ours = one_sphere(folder, "b", lsdcd(law, words, "flat.stl"), **respa)[0]
        at_most("respa: as fix wall/gran", lmp.largest_difference(theirs, ours), 1e-12)


# A sphere that is 0.06 above the floor, with a skin of 0.1, and has fallen 0.01 k^2 after k steps: LAMMPS looks at the beginning of
# the third step, in which it goes from 0.04 to 0.09.
FALLS_UNDER_RESPA = lmp.SMALL_BOX.format(atoms="create_atoms 1 single 0.31 0.22 0.56 units box") + """\
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
fix             pull all gravity 2e4 vector 0 0 -1
fix             wall all {wall}
timestep        1e-3
run_style       respa 2 2 pair 2
dump            d all custom 1 {out} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify     d format float %.17g
run             4
"""


@NOT_KOKKOS
def test_respa_moves_on(folder, flat_floor):
    """Under respa spheres move on after LAMMPS has looked how far they are, so that the wall looks itself."""
    law = LAWS["hooke_history"]
    lmp.run_well(FALLS_UNDER_RESPA.format(wall=f"wall/gran {law} zplane 0.0 NULL", out="theirs"), folder)
    lmp.run_well(FALLS_UNDER_RESPA.format(wall=lsdcd(law, ""), out="ours"), folder)
    theirs, ours = lmp.read_dump(folder / "theirs"), lmp.read_dump(folder / "ours")
    fact("touches in the third step", theirs[3][1][2] < 0.5)
    at_most("respa, a sphere that is accelerated: as fix wall/gran", lmp.largest_difference(theirs, ours), 1e-12)


def places(folder, name):
    return vtp.read(folder / name)["points"]


def test_stopped(folder, hilly_floor):
    """Where the mesh is, by its file of fields, through fix_modify and timesteps."""
    text = scene.CREATE + scene.forces(LAW, mesh="mesh floor.stl mesh_fields f_*.vtp every 100 " +
                                       "motion rotate 0 0 0 0 0 1 0.4")
    log = lmp.run_well(text + "run 100\nfix_modify wall motion none\nrun 100\n"
                       "fix_modify wall motion linear 0 0 1 motion rotate 0 0 0 0 0 1 0.8 energy yes\n"
                       "run 100\ntimestep 0.002\nrun 100\nreset_timestep 10000\nrun 100\n", folder)
    p = [numpy.reshape(places(folder, f"f_{k}.vtp"), (-1, 3)) for k in (100, 200, 300, 400, 10100)]

    def moved(points, turns, rise):
        return points @ turn((0, 0, 1), 2 * math.pi * turns).T + (0, 0, rise)

    def apart(a, b):
        return numpy.abs(a - b).max()

    fact("a quarter turn was made", apart(p[0], moved(p[0], 0.25, 0)) > 1)
    at_most("motion none: it stays where it is", apart(p[0], p[1]), 0)
    # Rounding of places of size 9, and of a phase.
    at_most("a new motion begins there", apart(p[2], moved(p[1], 0.125, 0.1)), 1e-13)
    at_most("a longer timestep goes on from there", apart(p[3], moved(p[2], 0.25, 0.2)), 1e-13)
    at_most("reset_timestep, too", apart(p[4], moved(p[3], 0.25, 0.2)), 1e-13)
    fact("the log tells of the changes", "motion none" in log and
         "motion linear 0 0 1, rotate 0 0 0 0 0 1 0.8; corners" in log)
    soft = "hooke 1e-9 NULL 0 NULL 0 0"    # spheres do not notice
    # dump image draws what stands there: a quarter turn, and the same mesh placed so.
    pictures = []
    for name, words in (("moved", "motion rotate 0 0 0 0 0 1 0.4"), ("placed", "rotate 0 0 1 90"),
                        ("unmoved", "")):
        lmp.run_well(scene.CREATE + scene.forces(soft, mesh=f"mesh corner.stl {words}") + "run 100\n"
                     f"write_dump all image {name}.ppm type type fix wall type 0.2 0 size 200 200 "
                     "view 20 30\n", folder)
        pictures.append((folder / f"{name}.ppm").read_bytes())
    fact("dump image draws the mesh where it is", pictures[0] == pictures[1])
    fact("which is elsewhere", pictures[0] != pictures[2])
    # From a fix that had no motion: another engine, with the springs of the old one.
    still = scene.CREATE + scene.forces(LAW, mesh="mesh floor.stl") + "run 500\n"
    dumps = []
    for name, words in (("still", ""), ("begun", "fix_modify wall motion linear 1e-300 0 0\n")):
        lmp.run_well(still + words + scene.dump(name, 50) + "run 200\n", folder)
        dumps.append(lmp.read_dump(folder / name))
    at_most("motion may be given later, and springs stay", lmp.largest_difference(*dumps), 1e-12)


DRUM = lmp.head("-3 3 -3 3 {lo} {hi}", boundary="f f {bc}") + """\
create_atoms    1 single 0.7 -1.3 0.2 units box
create_atoms    1 single -0.5 -1.2 3.8 units box
set             group all diameter 1.0 density 2.0
velocity        all set 0 0 0.5
""" + lmp.pairs() + """\
fix             move all nve/sphere
fix             wall all wall/lsdcd {law} mesh {mesh} {motion}
fix             pull all gravity 8.0 vector 0 -1 0
timestep        0.001
dump            d all custom 20 {out} id xu yu zu vx vy vz omegax omegay omegaz fx fy fz
dump_modify     d format float %.17g sort id
run             {steps}
"""


def test_periodic_drum(folder):
    """A drum that turns about the periodic axis is as a long one."""
    write_drum(folder / "short.stl", 0, 4)
    write_drum(folder / "long.stl", -8, 12)
    dumps = []
    for name, bc, lo, hi in (("short", "p", 0, 4), ("long", "f", -8, 12)):
        lmp.run_well(DRUM.format(bc=bc, lo=lo, hi=hi, law=LAW, mesh=name + ".stl", out=name, steps=1500,
                                 motion="motion rotate 0 0 0 0 0 1 2"), folder)
        dumps.append(lmp.read_dump(folder / name))
    fact("spheres are in touch with the drum", touching(dumps[0]) > 50)
    fact("and are carried up", max(row[1] for row in dumps[0][1500].values()) > -1.2)
    # Spheres wrap once: places are rounded at 4 more; 1500 steps over edges grow that by 1e4.
    at_most("a periodic drum as a long one", lmp.largest_difference(*dumps), 1e-9)


def test_between_faces(folder):
    """A round drum turns between periodic faces that the corners of its bounds would reach: 2 to a vertex, and the
    sphere's radius 0.25 and the skin 0.3 to keep away. In it nothing is felt of them."""
    def drum(half, bc="p p", mesh="short.stl", motion="motion rotate 0 0 0 0 0 1 2", steps=1500, end=""):
        text = DRUM.replace("box block -3 3 -3 3", f"box block -3 3 -{half} {half}" if bc == "f p" else
                            f"box block -{half} {half} -{half} {half}").replace("f f {bc}", bc + " p")
        return text.replace("diameter 1.0", "diameter 0.5").format(
            lo=0, hi=4, law=LAW, mesh=mesh, out=bc[0], steps=steps, motion=motion) + end

    for bc in ("p p", "f f"):
        lmp.run_well(drum(2.6, bc), folder)
    dumps = [lmp.read_dump(folder / name) for name in "pf"]
    fact("a drum between periodic faces: spheres touch it", touching(dumps[0]) > 50)
    at_most("they move as without these", lmp.largest_difference(*dumps), 0)
    lmp.run_well(drum(2.6, steps=30, end="fix_modify wall motion none\nrun 1\n"), folder, 2)
    lmp.refused("too near to them", drum(2.54), folder, "reaches the periodic face in x at step 0", ranks=2)
    # A prism of three sides, its corners 1.73 up and down and 2 once it has turned.
    lmp.refused("one that will be", drum(2.54, "f p", "corner.stl"), folder, "will reach the periodic face in y")
    # Finite variables that add up to more than a number can be, then turned: 0 times that.
    big = "motion variable NULL v_big NULL NULL NULL NULL "
    lmp.refused("what is nowhere", "variable big equal 1e308\n" + drum(2.6, motion=2 * big + "motion rotate 0 0 0 0 0 1 2"), folder,
                "reaches the periodic face in x")


def test_refused(folder):
    write_plane(folder / "plate.stl", 2, 1.0)

    def drum(motion, bc="p", mesh="short.stl", steps=1, lo=0, hi=4):
        return DRUM.format(bc=bc, lo=lo, hi=hi, law=LAW, mesh=mesh, out="x", steps=steps, motion=motion)

    lmp.refused("the periodic face in z", drum("motion rotate 0 0 0 1 0 0 2"), folder, "reaches the periodic face in z at step 0")
    lmp.refused("linear along z", drum("motion linear 0 0 1"), folder, "reaches the periodic face in z")
    # What a motion does not allow is not advised.
    for words, advised in (("", True), ("motion rotate 0 0 0 0 0 1 2", True), ("motion linear 0 0 1", False)):
        done = lmp.run(drum(words, mesh="short.stl move 0 0 0.5", steps=0), folder)
        fact(f"past a periodic face, {words or 'at rest'}: periodic is {'' if advised else 'not '}advised",
             ("Add the keyword periodic" in done.stdout) == advised == (done.returncode == 0))
    # In the middle of the box, moving to its face: when it is there; turning: before.
    # Without gravity, or the spheres fall out of the box. Of the 2 to the face 0.5 and the skin 0.3 are kept free: 1.2 at 0.5.
    plate = "plate.stl move 0 0 2"
    lmp.refused("a mesh that moves to a periodic face", drum("motion linear 0 0 0.5", mesh=plate, steps=3000)
                .replace("gravity 8.0", "gravity 0.0"), folder, "reaches the periodic face in z at step 24")
    lmp.refused("one that will, before", drum("motion rotate 0 0 2 1 0 0 10", mesh=plate, lo=1, hi=3)
                .replace("3.8 units", "2.8 units").replace("0.2 units", "1.8 units"), folder, "will reach the periodic face in z:")
    for words, says in (("motion linear 1 0", "the value of Vz is missing"),
                        ("motion none motion linear 1 0 0", "none stops all motion"),
                        ("motion variable v_d NULL NULL NULL NULL NULL", "there is no variable 'd'")):
        lmp.refused(f"fix_modify {words}", drum("", "f") + f"fix_modify wall {words}\nrun 1\n", folder, says)
    lmp.refused("a variable of another style", "variable d atom x\n" + drum("motion variable v_d NULL NULL NULL NULL NULL", "f"), folder,
                "'d', which the wall reads, is not of style equal")


def test_no_numbers(folder):
    """Variables that are finite until step 4, and then are not: on several processes all end."""
    bad = {"nan": "exp(1000*(step>4))-exp(1000*(step>4))", "inf": "exp(1000*(step>4))-1"}
    cases = [("motion variable v_d NULL NULL NULL NULL NULL", "nan", 2),
             ("motion variable v_d NULL NULL NULL NULL NULL", "inf", 1),
             ("motion variable v_z NULL NULL v_d NULL NULL", "nan", 1),
             ("surface_vel 0 v_d 0", "nan", 1), ("surface_angvel 0 0 v_d", "nan", 1),
             ("servo force z v_d vmax 1", "nan", 2)]
    for words, value, ranks in cases:
        text = DRUM.replace("fix             wall", f"variable d equal {bad[value]}\nvariable z equal 0\n"
                            "fix             wall")
        done = lmp.run(text.format(bc="f", lo=0, hi=4, law=LAW, mesh="short.stl", out="x", steps=9,
                                   motion=words), folder, ranks)
        errors = [line for line in done.stdout.split("\n") if line.startswith("ERROR")]
        # The sign of a nan that inf - inf gives differs between processors.
        said = re.search(rf"Fix wall wall/lsdcd: variable 'd', which the wall reads, is -?{value} in step 5:",
                         errors[0] if errors else "")
        fact(f"{words}: {value} stops {ranks} rank{'s' * (ranks > 1)} in its step",
             done.returncode != 0 and len(errors) == 1 and said, str(errors) if errors else "it runs on")

