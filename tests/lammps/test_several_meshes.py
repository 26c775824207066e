#!/usr/bin/env python3
"""Several meshes in one fix: against LAMMPS's planes, against one mesh, and against closed forms.

Both codes evaluate the same formulas in another order: 1e-12 leaves room for 10^4 operations, see
test_parity.py.
"""

import math
import re

import deck
from test_loads import read_vtp

SIDE = 3.0
LAWS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
        "hooke_history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
        "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 1"}
SMOOTH = "hooke 1e4 NULL 0 0 0 0"
FACES = {f"{'xyz'[d]}{side}": (d, (-1 if side == "lo" else 1) * SIDE)
         for d in range(3) for side in ("lo", "hi")}

SETTINGS = """\
units           lj
atom_style      sphere
atom_modify     map array
boundary        {boundary}
newton          off
comm_modify     vel yes
"""
CREATE = SETTINGS + """\
region          box block {box}
create_box      1 box
{atoms}
set             group all diameter 1.0 density 2.0
{kick}
"""
FORCES = """\
pair_style      zero 1.2
pair_coeff      * *
neighbor        0.3 bin
neigh_modify    delay 0 every 1 check yes
fix             move all nve/sphere
{walls}
timestep        {dt}
{more}
"""
DUMP = """\
dump            d all custom {every} {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify     d format float %.17g sort id
"""
# Thrown into all corners.
GAS = "lattice sc 0.4\nregion fill block -2.4 2.4 -2.4 2.4 -2.4 2.4 units box\ncreate_atoms 1 region fill"
FAST = "velocity all create 40.0 4711 loop geom\nset group all omega 2.1 -3.3 1.7"
OPEN = "-4 4 -4 4 -4 4"


def write_plate(path, axis, at, lo=(-SIDE, -SIDE), hi=(SIDE, SIDE), cells=1):
    """2 cells^2 triangles across an axis, between lo and hi along the other two."""
    def point(i, j):
        uv = [lo[k] + (hi[k] - lo[k]) * n / cells for k, n in ((0, i), (1, j))]
        uv.insert(axis, at)
        return "vertex %.17g %.17g %.17g\n" % tuple(uv)

    with open(path, "w") as stl:
        stl.write("solid plate\n")
        for i in range(cells):
            for j in range(cells):
                a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
                for t in (a + b + c, a + c + d):
                    stl.write("facet normal 0 0 1\nouter loop\n" + t + "endloop\nendfacet\n")
        stl.write("endsolid plate\n")


def six(law, more={}, common=""):
    meshes = " ".join(f"mesh {name}.stl {more.get(name, '')}" for name in FACES)
    return f"fix wall all wall/lsdcd {law} {meshes} {common}"


def planes(law, more=""):
    """`more`: of the lower plane across z."""
    walls = [f"fix {axis} all wall/gran {law} {axis}plane {-SIDE} {SIDE}" for axis in "xy"]
    return "\n".join(walls + [f"fix zlo all wall/gran {law} zplane {-SIDE} NULL {more}",
                              f"fix zhi all wall/gran {law} zplane NULL {SIDE}"])


def build(walls, name, steps, atoms=GAS, kick=FAST, dt=1e-4, every=1, more="", box=OPEN, boundary="f f f"):
    return (CREATE.format(atoms=atoms, kick=kick, box=box, boundary=boundary) +
            FORCES.format(walls=walls, dt=dt, more=more) + DUMP.format(every=every, name=name) +
            f"run {steps}\n")


def go(folder, walls, name, steps, ranks=1, **words):
    text = deck.run_well(build(walls, name, steps, **words), folder, ranks)
    return deck.read_dump(folder / name), text


def thermo(columns, every=1):
    return f"thermo_style custom step {columns}\nthermo_modify norm no format float %.17g\nthermo {every}"


def two_sided(rows):
    """How often a sphere is pushed by two sides at once, and by three."""
    push = [sum(abs(f) > 1e-3 for f in row[9:12]) for step in rows.values() for row in step.values()]
    return sum(n > 1 for n in push), sum(n > 2 for n in push)


def compare_with_planes(checks, folder):
    """In a corner of a box plates meet at right angles, and their forces add."""
    for name, law in LAWS.items():
        theirs = go(folder, planes(law), "a", 1500)[0]
        ours = go(folder, six(law), "b", 1500)[0]
        checks.at_most(f"{name}: six plates are six planes", deck.largest_difference(theirs, ours),
                       1e-12)
        rubs = "wiggle z 0.1 0.05"
        theirs = go(folder, planes(law, rubs), "a", 1500)[0]
        ours = go(folder, six(law, {"zlo": rubs}), "b", 1500)[0]
        checks.at_most(f"{name}: one of them wiggles", deck.largest_difference(theirs, ours), 1e-12)
    checks.fact("spheres are in edges and corners of the box", min(two_sided(ours)) > 20,
                str(two_sided(ours)))
    theirs = go(folder, planes(LAWS["hooke_history"], "shear x 2.0"), "a", 1500)[0]
    ours = go(folder, six(LAWS["hooke_history"], {"zlo": "shear x 2.0"}), "b", 1500)[0]
    checks.at_most("one of them is a belt", deck.largest_difference(theirs, ours), 1e-12)


def columns(rows, n):
    return " ".join(f"f_wall[{r}][{c}]" for r in range(1, rows + 1) for c in range(1, n + 1))


def check_outputs(checks, folder):
    """Rows of the array are of a mesh each, and the vector is their sum."""
    n = 11
    moves = {"zlo": "wiggle z 0.1 0.05 mesh_fields zlo_*.vtp every 500",
             "xhi": "torque_about 3 0 0 mesh_fields xhi_*.vtp every 500",
             "yhi": "mesh_stl yhi.stl every 300 motion linear 0 0 0.5"}
    law = LAWS["hertz_history"]
    vector = " ".join(f"f_wall[{c}]" for c in range(1, n + 1))
    text = go(folder, six(law, moves, "wear archard 1e-3 1e6 contacts"), "a", 1000,
              more=thermo(f"f_wall {vector} {columns(6, n)}", 10))[1]
    rows = deck.read_thermo(text)
    checks.fact("outputs: there are some", len(rows) > 90, str(len(rows)))
    torque_about = [0, 0, 0]
    for row in rows:
        whole, part = row[2:2 + n], [row[2 + n * (k + 1):2 + n * (k + 2)] for k in range(6)]
        for c in range(n):
            if 3 <= c < 6:
                continue
            size = sum(abs(p[c]) for p in part)
            made = max(p[c] for p in part) if c == 7 else sum(p[c] for p in part)
            checks_once(checks, f"outputs: the vector's element {c + 1} is of all rows",
                        abs(whole[c] - made) <= 1e-12 * size)
        # About the origin: mesh xhi has its torque about (3, 0, 0), from which f x is (3, 0, 0) x f.
        f = part[1][:3]
        moved = [sum(p[3 + d] for p in part) + a for d, a in enumerate((0, -3 * f[2], 3 * f[1]))]
        size = 1e-300 + sum(abs(v) for p in part for v in p[:6])
        for d in range(3):
            checks_once(checks, f"outputs: torque {'xyz'[d]} is about the origin where meshes differ",
                        abs(whole[3 + d] - moved[d]) <= 1e-12 * 3 * size)
        # The normal force of a plate is along its axis alone, outwards.
        for k, name in enumerate(FACES):
            axis, at = FACES[name]
            checks_once(checks, f"outputs: {name} is pushed outwards",
                        part[k][axis] * math.copysign(1, at) >= -1e-9 - 0.5 * abs(part[k][axis]))
        for k, name in enumerate(FACES):
            if name not in ("zlo", "yhi"):
                checks_once(checks, f"outputs: {name} rests and has no power", part[k][10] == 0)
    checks.fact("outputs: each plate was hit", all(any(row[2 + n * (k + 1) + 6] for row in rows)
                                                   for k in range(6)))
    worn = [rows[-1][2 + n * (k + 1) + 9] for k in range(6)]
    checks.fact("outputs: each plate wore", min(worn) > 0, str(worn))
    for k, name in ((0, "xhi"), (4, "zlo")):
        fields = read_vtp(folder / f"{name}_1000.vtp")
        here = sum(fields["worn_volume"])
        there = rows[-1][2 + n * (list(FACES).index(name) + 1) + 9]
        checks.at_most(f"outputs: mesh_fields of {name} have its wear",
                       abs(here / there - 1), 1e-12)
        checks.fact(f"outputs: {name} has its series", (folder / f"{name}_series.pvd").exists())
    # 900 steps of 1e-4 with 0.5 along z; in an STL in single precision.
    z = stl_heights(folder / "yhi.stl")
    checks.at_most("outputs: mesh_stl is where the mesh is", abs(max(z) - SIDE - 0.045), 1e-6)
    checks.fact("log: a block for each mesh, the law once",
                all(f"mesh {name}.stl" in text for name in FACES) and text.count("\n  contact ") == 1)


ONCE = set()


def checks_once(checks, name, holds):
    """One line for a fact of many steps: the first that fails, or one that holds."""
    if not holds and name not in ONCE:
        ONCE.add(name)
        checks.fact(name, False)


def stl_heights(path):
    import struct
    data = path.read_bytes()
    n = struct.unpack_from("<I", data, 80)[0]
    return [struct.unpack_from("<12f", data, 84 + 50 * k)[5 + 3 * v] for k in range(n) for v in range(3)]


PRESS = {"zhi": "servo force z -40 vmax 2", "zlo": "wiggle z 0.1 0.05",
         "xhi": "surface_vel 0 1 0 motion linear 0 0.3 0"}


def check_servo(checks, folder):
    text = go(folder, six(LAWS["hooke_history"], PRESS), "a", 400,
              more=thermo("f_wall[12] f_wall[13] f_wall[14] " + " ".join(
                  f"f_wall[{k}][{c}]" for k in (1, 6) for c in (12, 13, 14)) + " f_wall[6][3]", 10))[1]
    rows = deck.read_thermo(text)
    checks.fact("servo: its columns are those of the mesh that has it",
                all(row[1:4] == row[7:10] and row[4:7] == [0, 0, 0] for row in rows) and
                any(row[1] for row in rows))
    checks.fact("servo: its push is the force on its mesh", all(row[9] == -row[10] or row[9] == row[10] == 0
                                                                for row in rows))
    both = dict(PRESS, yhi="servo force y -40 vmax 2")
    rows = deck.read_thermo(go(folder, six(LAWS["hooke_history"], both), "a", 50,
                               more=thermo("f_wall[12] f_wall[4][12] f_wall[6][12]"))[1])
    checks.fact("servo: of two the vector has none, and the array both",
                all(row[1] == 0 for row in rows) and rows[-1][2] < 0 and rows[-1][3] < 0)


def proceed(folder, walls, restart, name, steps, ranks=1):
    text = deck.run_well(SETTINGS.format(boundary="f f f") + f"read_restart {restart}\n" +
                         FORCES.format(walls=walls, dt=1e-4, more="") +
                         DUMP.format(every=20, name=name) + f"run {steps}\n", folder, ranks)
    return deck.read_dump(folder / name), text


def check_restart(checks, folder):
    law = "hooke/history 1e4 NULL 5 NULL 0.5 1"
    walls = six(law, PRESS, "wear archard 1e-3 1e6")
    for ranks in (1, 2):
        begin = build(walls, "a", 600, every=20).replace("dump  ", "#dump  ").replace("dump_modify", "#")
        deck.run_well(begin + "write_restart half.restart\n" + DUMP.format(every=20, name="two") +
                      "run 600\n", folder, ranks)
        two = deck.read_dump(folder / "two")
        again, text = proceed(folder, walls, "half.restart", "continued", 600, ranks)
        checks.at_most(f"restart on {ranks}: the same bits", deck.largest_difference(two, again), 0)
        checks.fact(f"restart on {ranks}: nothing is warned of", "WARNING: Fix wall" not in text,
                    "".join(re.findall("WARNING: Fix wall.*", text)))
    fewer = walls.replace(f"mesh zhi.stl {PRESS['zhi']}", "")
    text = proceed(folder, fewer, "half.restart", "c", 10)[1]
    checks.fact("restart: fewer meshes are told of", "written with 6 meshes and this fix has 5: "
                "springs, motion, loads and wear of those after mesh 5 are not carried over" in text)
    text = proceed(folder, walls + " mesh zlo.stl move 0 0 -0.5", "half.restart", "c", 10)[1]
    checks.fact("restart: so are more", "written with 6 meshes and this fix has 7: those after mesh "
                "6 begin anew" in text)
    write_plate(folder / "fine.stl", 1, SIDE, cells=2)
    text = proceed(folder, walls.replace("yhi.stl", "fine.stl"), "half.restart", "c", 10)[1]
    checks.fact("restart: another mesh is named", "mesh 4 'fine.stl': springs, motion, loads and wear "
                "begin anew" in text)


def check_ranks(checks, folder):
    law = LAWS["hertz_history"]
    runs = [go(folder, six(law, PRESS), f"r{ranks}", 600, ranks, every=100,
               more=thermo(columns(6, 9), 100)) for ranks in (1, 2, 4)]
    for ranks, run in ((2, runs[1]), (4, runs[2])):
        # Without a pair style nothing but the servo tells one sphere of another: sums over
        # processes part by rounding, which contacts of 600 steps multiply by 1e3 at most.
        checks.at_most(f"{ranks} processes", deck.largest_difference(runs[0][0], run[0]), 1e-10)
        one, many = deck.read_thermo(runs[0][1])[-1], deck.read_thermo(run[1])[-1]
        size = max(abs(v) for v in one)
        checks.at_most(f"{ranks} processes: array", max(abs(u - v) for u, v in zip(one, many)) / size,
                       1e-9)


# Two plates of a floor whose rims coincide along x = 0.
def write_halves(folder):
    write_plate(folder / "left.stl", 2, 0.0, (-SIDE, -SIDE), (0.0, SIDE))
    write_plate(folder / "right.stl", 2, 0.0, (0.0, -SIDE), (SIDE, SIDE))
    write_plate(folder / "whole.stl", 2, 0.0)


HALVES = "mesh left.stl mesh right.stl"
ROLL = {"atoms": "create_atoms 1 single -0.6 0.11 0.499 units box",
        "kick": "velocity all set 5.0 0.3 0\nset group all omega 0.2 9.0 -0.3",
        "more": "fix pull all gravity 20.0 vector 0 0 -1"}


def check_seam(checks, folder):
    """The bounds are those of seams of one mesh (tests/physics/test_seams.cpp): every force is that
    of the plane to 1e-12, and so is a path that crosses once, without chaos."""
    for name, law in list(LAWS.items()) + [("smooth", SMOOTH)]:
        one = go(folder, f"fix wall all wall/lsdcd {law} mesh whole.stl", "a", 3000, **ROLL)[0]
        two = go(folder, f"fix wall all wall/lsdcd {law} {HALVES}", "b", 3000, **ROLL)[0]
        last = max(one)
        checks.fact(f"seam, {name}: it rolls over", one[0][1][0] < -0.5 and one[last][1][0] > 0.5)
        checks.at_most(f"seam, {name}: two plates are one", deck.largest_difference(one, two), 1e-11)
        moved = go(folder, f"fix wall all wall/lsdcd {law} {HALVES} motion linear 0 0 0", "b", 3000,
                   **ROLL)[0]
        checks.at_most(f"seam, {name}: one of them could move", deck.largest_difference(one, moved),
                       1e-11)
    at = {"atoms": "create_atoms 1 single 0 0.11 0.499 units box", "kick": "", "dt": 1e-9}
    force = {}
    for name, walls in {"one": f"fix wall all wall/lsdcd {SMOOTH} {HALVES}",
                        "two": f"fix wall all wall/lsdcd {SMOOTH} mesh left.stl\n"
                               f"fix other all wall/lsdcd {SMOOTH} mesh right.stl"}.items():
        force[name] = go(folder, walls, "a", 0, **at)[0][0][1][11]
    # k (R - h), with R and h of order 1 and their difference 1e-3: 1e-13 of the force.
    checks.at_most("seam: over it the force is the plane's", abs(force["one"] / (1e4 * 0.001) - 1), 1e-12)
    checks.at_most("seam: two fixes feel it twice", abs(force["two"] / (2 * 1e4 * 0.001) - 1), 1e-12)


def check_gate(checks, folder):
    """The right half slides away in its own plane."""
    away = "motion linear 3.0 0 0"
    walls = f"fix wall all wall/lsdcd {{}} {HALVES} {away}"
    # Without friction the floor's motion along itself is not felt.
    still = {"atoms": "create_atoms 1 single -0.01 0.11 0.499 units box", "kick": "",
             "more": ROLL["more"]}
    one = go(folder, f"fix wall all wall/lsdcd {SMOOTH} mesh whole.stl", "a", 2000, **still)[0]
    two = go(folder, walls.format(SMOOTH), "b", 2000, **still)[0]
    checks.at_most("gate: a smooth sphere beside its rim feels nothing",
                   deck.largest_difference(one, two), 1e-11)
    # Over the gate it is carried along: a plane of wall/gran with the same speed.
    for name, law in LAWS.items():
        on = dict(still, atoms="create_atoms 1 single 1.0 0.11 0.499 units box")
        theirs = go(folder, f"fix wall all wall/gran {law} zplane 0 NULL shear x 3.0", "a", 2000, **on)[0]
        ours = go(folder, walls.format(law), "b", 2000, **on)[0]
        checks.at_most(f"gate, {name}: what lies on it is carried along",
                       deck.largest_difference(theirs, ours), 1e-12)
    # Sliding all the while, a = mu g and R domega/dt = 5/2 mu g at a constant load. The sphere is put
    # down where its weight is its overlap, and stays there, as nothing damps or excites it.
    mass = 2.0 * math.pi / 6
    load = mass * 20.0
    sink = load / 1e4
    on = dict(still, atoms=f"create_atoms 1 single 1.0 0.11 {0.5 - sink!r} units box")
    path = go(folder, walls.format("hooke 1e4 NULL 0 1e4 0.1 1"), "b", 2000, **on)[0]
    t = 2000 * 1e-4
    checks.at_most("gate: friction gives mu g", abs(path[2000][1][3] / (0.1 * 20.0 * t) - 1), 1e-3)
    checks.at_most("gate: and turns it", abs(path[2000][1][7] / (-2.5 * 0.1 * 20.0 * t / 0.5) - 1), 1e-3)
    # When the rim passes it falls: x = 1 + a t^2/2 is met by 3 t at t = 0.349. Later it is falling freely.
    path = go(folder, walls.format("hooke 1e4 NULL 0 1e4 0.1 1"), "b", 8000, every=1000, **on)[0]
    checks.at_most("gate: it falls where the gate is gone",
                   abs((path[8000][1][5] - path[7000][1][5]) / (-20.0 * 0.1) - 1), 1e-9)


def check_modify(checks, folder):
    """fix_modify stops one mesh and starts another."""
    walls = six(LAWS["hooke"], {"zlo": "motion linear 0 0 1.0"})
    text = build(walls, "a", 100, every=100)
    text += "fix_modify wall mesh 5 motion none mesh 6 motion linear 0 0 -1.0\n"
    done = deck.run_well(text + "run 100\n", folder)
    checks.fact("fix_modify mesh 5: is named in the log",
                "mesh 5 'zlo.stl': motion none" in done and "mesh 6 'zhi.stl': motion linear" in done)
    one = build(f"fix wall all wall/lsdcd {LAWS['hooke']} mesh zlo.stl", "a", 1)
    checks.fact("fix_modify mesh 1 of one mesh",
                "motion linear" in deck.run_well(one + "fix_modify wall mesh 1 motion linear 0 0 1\nrun 1\n",
                                                 folder))


def check_periodic(checks, folder):
    """A floor that repeats at rest, and a paddle that moves above it, away from the faces."""
    write_plate(folder / "paddle.stl", 0, 0.0, (-1.0, 0.2), (1.0, 2.0))
    box, law = "-3 3 -3 3 -1 5", LAWS["hooke_history"]
    where = {"box": box, "boundary": "p p f", "kick": "velocity all set 8 5 -4",
             "atoms": "create_atoms 1 single -2.0 0.11 1.0 units box\n"
                      "create_atoms 1 single 2.0 2.2 1.2 units box"}
    floor = "mesh zlo.stl move 0 0 3"
    theirs = go(folder, f"fix wall all wall/gran {law} zplane 0 NULL", "a", 4000, **where)[0]
    ours = go(folder, f"fix wall all wall/lsdcd {law} {floor} mesh paddle.stl move 0 0 2.0 "
                      "motion rotate 0 0 0 0 0 1 0.8", "b", 4000, **where)[0]
    hit = [step for step in ours if max(abs(ours[step][1][k] - theirs[step][1][k]) for k in range(3)) > 1e-9]
    checks.fact("periodic: the paddle hits", bool(hit))
    before = {s: rows for s, rows in ours.items() if not hit or s < hit[0] - 200}
    checks.fact("periodic: spheres cross before it", any(
        abs(before[s][1][0] - before[s - 1][1][0]) > 1 for s in before if s - 1 in before) or len(before) > 300)
    theirs = {s: theirs[s] for s in before}
    checks.at_most("periodic: and roll on the floor until then", deck.largest_difference(theirs, before),
                   1e-12)


def check_pictures(checks, folder):
    text = build(six(LAWS["hooke"], {"zlo": "wiggle z 0.1 0.05"}), "a", 20, every=20) + (
        "dump i all image 10 a.*.ppm type type fix wall 1 0.05 0\nrun 20\n")
    done = deck.run(text, folder)
    if "dump image" in done.stdout and "ERROR" in done.stdout:
        print("SKIP pictures: this LAMMPS writes none")
        return
    # A plate of two triangles has four open edges.
    checks.fact("dump image draws all meshes", "draws the mesh as 24 lines" in done.stdout)


def main():
    checks, folder = deck.Checks(), deck.scratch()
    for name, (axis, at) in FACES.items():
        write_plate(folder / f"{name}.stl", axis, at)
    write_halves(folder)
    compare_with_planes(checks, folder)
    check_outputs(checks, folder)
    check_servo(checks, folder)
    check_restart(checks, folder)
    check_ranks(checks, folder)
    check_modify(checks, folder)
    check_pictures(checks, folder)
    check_periodic(checks, folder)
    check_seam(checks, folder)
    check_gate(checks, folder)
    checks.done(folder)


if __name__ == "__main__":
    main()
