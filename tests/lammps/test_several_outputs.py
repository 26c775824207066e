# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What a fix of several meshes shows, writes and keeps: its array, files, restart files, servos."""

import re
import struct

import lmp
import vtp
from plates import DUMP, FACES, FORCES, LAWS, SIDE, build, go, six, thermo, write_box, write_plate
from facts import at_most, fact

PRESS = {"zhi": "servo force z -40 vmax 2", "zlo": "wiggle z 0.1 0.05",
         "xhi": "surface_vel 0 1 0 motion linear 0 0.3 0"}
TOLD = set()


def checks_once(name, holds):
    """One line for a fact of many steps: the first that fails, or one that holds."""
    if not holds and name not in TOLD:
        TOLD.add(name)
        fact(name, False)


def columns(rows, n):
    return " ".join(f"f_wall[{r}][{c}]" for r in range(1, rows + 1) for c in range(1, n + 1))


def stl_heights(path):
    data = path.read_bytes()
    n = struct.unpack_from("<I", data, 80)[0]
    return [struct.unpack_from("<12f", data, 84 + 50 * k)[5 + 3 * v] for k in range(n) for v in range(3)]


def prepare(folder):
    write_box(folder)


def test_means_and_energy(folder):
    """Rows of means are what LAMMPS averages of the mesh's row; rows of energy are of a mesh each, and the vector is their sum."""
    means, energy = range(42, 48), range(55, 73)
    averaged = "".join(f"variable v{r}_{c} equal f_wall[{r}][{c}]\n" for r in (1, 5) for c in range(1, 7)) + \
        "fix by_lammps all ave/time 1 500 500 " + " ".join(f"v_v{r}_{c}" for r in (1, 5) for c in range(1, 7)) + "\n"
    text = go(folder, six(LAWS["hertz_history"], {"zlo": "wiggle z 0.1 0.05"}, "average 500 energy"), "m", 3000, every=500, more=averaged + thermo(
        " ".join([f"f_by_lammps[{k}]" for k in range(1, 13)] + [f"f_wall[{r}][{c}]" for r in (1, 5) for c in means] +
                 [f"f_wall[{c}]" for c in energy] + [f"f_wall[{r}][{c}]" for r in range(1, 7) for c in energy]), 500))[1]
    rows, n = [row[1:] for row in lmp.read_thermo(text)[1:]], len(energy)
    # 500 numbers, added up in the same order, but by LAMMPS in another way.
    at_most("means of meshes", max(abs(a - b) for row in rows for a, b in zip(row[:12], row[12:24])), 1e-12 * max(
        abs(a) for row in rows for a in row[:12]))
    fact("both meshes were pushed", min(max(abs(row[k]) for row in rows) for k in (0, 8)) > 0, str(rows[-1][:12]))
    of_all, of_meshes = rows[-1][24:24 + n], [rows[-1][24 + n * k:24 + n * (k + 1)] for k in range(1, 7)]
    for c in range(n):
        size = sum(abs(row[c]) for row in of_meshes)
        at_most(f"energy: {c + 55} is of all rows", abs(of_all[c] - sum(row[c] for row in of_meshes)), 1e-12 * size + 1e-15 * of_all[14])
    work = [row[14] for row in of_meshes]
    fact("each mesh has its own contact work", len(set(work)) == 6 and all(work), str(work))
    for row in of_meshes:    # contact work less dissipated, other losses, drive and held
        at_most("the remainder of a mesh is that of its row", abs(row[17] - (row[14] - sum(row[5:14]) - row[16])), 1e-12 * abs(row[14]))
    fact("the mesh that moves alone drives", [k for k, row in enumerate(of_meshes) if row[15]] == [list(FACES).index("zlo")],
         str([row[15] for row in of_meshes]))


def test_outputs(folder):
    """Rows of the array are of a mesh each, and the vector is their sum."""
    n = 11
    moves = {"zlo": "wiggle z 0.1 0.05 mesh_fields zlo_*.vtp every 1500",
             "xhi": "torque_about 3 0 0 mesh_fields xhi_*.vtp every 1500",
             "yhi": "mesh_stl there.stl every 2900 motion linear 0 0 0.5"}
    law = LAWS["hertz_history"]
    vector = " ".join(f"f_wall[{c}]" for c in range(1, n + 1))
    text = go(folder, six(law, moves, "wear archard 1e-3 1e6 contacts"), "a", 3000, every=500,
              more=thermo(f"f_wall {vector} {columns(6, n)}", 10))[1]
    rows = lmp.read_thermo(text)
    fact("outputs: there are some", len(rows) > 90, str(len(rows)))
    for row in rows:
        whole, part = row[2:2 + n], [row[2 + n * (k + 1):2 + n * (k + 2)] for k in range(6)]
        for c in range(n):
            if 3 <= c < 6:
                continue
            size = sum(abs(p[c]) for p in part)
            made = max(p[c] for p in part) if c == 7 else sum(p[c] for p in part)
            checks_once(f"outputs: the vector's element {c + 1} is of all rows",
                        abs(whole[c] - made) <= 1e-12 * size)
        # About the origin: mesh xhi has its torque about (3, 0, 0), from which f x is (3, 0, 0) x f.
        f = part[1][:3]
        moved = [sum(p[3 + d] for p in part) + a for d, a in enumerate((0, -3 * f[2], 3 * f[1]))]
        size = 1e-300 + sum(abs(v) for p in part for v in p[:6])
        for d in range(3):
            checks_once(f"outputs: torque {'xyz'[d]} is about the origin where meshes differ",
                        abs(whole[3 + d] - moved[d]) <= 1e-12 * 3 * size)
        for k, name in enumerate(FACES):
            if name not in ("zlo", "yhi"):
                checks_once(f"outputs: {name} rests and has no power", part[k][10] == 0)
    fact("outputs: each plate was hit", all(any(row[2 + n * (k + 1) + 6] for row in rows)
                                            for k in range(6)))
    worn = [rows[-1][2 + n * (k + 1) + 9] for k in range(6)]
    fact("outputs: each plate wore", min(worn) > 0, str(worn))
    for k, name in ((0, "xhi"), (4, "zlo")):
        fields = vtp.read(folder / f"{name}_3000.vtp")
        here = sum(fields["worn_volume"])
        there = rows[-1][2 + n * (list(FACES).index(name) + 1) + 9]
        at_most(f"outputs: mesh_fields of {name} have its wear",
                abs(here / there - 1), 1e-12)
        fact(f"outputs: {name} has its series", (folder / f"{name}_series.pvd").exists())
    # 2900 steps of 1e-4 with 0.5 along z; in an STL in single precision.
    z = stl_heights(folder / "there.stl")
    at_most("outputs: mesh_stl is where the mesh is", abs(max(z) - SIDE - 0.145), 1e-6)
    fact("log: a block for each mesh, the law once",
         all(f"mesh {name}.stl" in text for name in FACES) and text.count("\n  contact ") == 1)


def test_rows(folder):
    """No sphere touches two plates that face each other: two fixes of one mesh each are the same."""
    law, n = LAWS["hertz_history"], 11
    one, two = "mesh xlo.stl", "mesh xhi.stl wiggle x 0.02 0.1 torque_about 3 0 0"
    # The second mesh's factor, and its own hardness in a fix of its own.
    wear, harder, factor = "wear archard 1e-3 1e6", "wear archard 1e-3 4e6", "wear_factor 0.25"
    vectors = " ".join(f"f_{name}[{c}]" for name in "ab" for c in range(1, n + 1))
    apart = go(folder, f"fix a all wall/lsdcd {law} {one} {wear}\nfix b all wall/lsdcd {law} {two} {harder}", "a",
               1200, every=1200, more=thermo(f"f_a f_b {vectors}", 10))[1]
    joined = go(folder, f"fix wall all wall/lsdcd {law} {wear} {one} {two} {factor}", "a", 1200, every=1200,
                more=thermo(f"f_wall f_wall[7] {columns(2, n)}", 10))[1]
    fact("log: a mesh's own wear", joined.count("\n  wear        0.25 times as fast\n") == 1)
    apart, joined = ([row[1:] for row in lmp.read_thermo(text)] for text in (apart, joined))
    apart = [[row[0] + row[1], row[8] + row[8 + n], *row[2:]] for row in apart]
    worst = {}
    for c in range(2 + 2 * n):
        size = max(abs(row[c]) for row in apart)
        off = max(abs(u[c] - v[c]) for u, v in zip(apart, joined))
        name = "sums" if c < 2 else f"row {1 + (c - 2) // n}"
        worst[name] = max(worst.get(name, 0), off / size if size else off)
    for name, off in worst.items():
        # Impacts on a moving plate part neighbouring paths by a factor of ten each, of two or three.
        at_most(f"rows: {name} as of two fixes", off, 1e-12)


def test_cache(folder):
    """Each mesh keeps its grid in a file of its own."""
    walls = six(LAWS["hooke"], {"xlo": "cache xlo.grid", "zhi": "cache zhi.grid"})
    done = lmp.run(build(walls, "a", 10), folder)
    if "'cache'" in done.stdout:
        print("SKIP cache:", re.search("ERROR.*'cache'.*", done.stdout).group())
        return
    fact("cache: two are written", done.stdout.count("written to cache") == 2)
    text = go(folder, walls, "a", 10)[1]
    fact("cache: and read", text.count("not built now, read from cache") == 2 and
         "mesh 6 'zhi.stl': grid for radius" in text)


def test_column(folder):
    """How an atom-style variable gets at a column of the contacts array beside the other array."""
    more = ("fix push all ave/atom 1 1 1 f_wall[4]\nvariable p atom f_push\ncompute p all reduce sum v_p\n" +
            thermo("c_p f_wall[3]", 10))
    rows = lmp.read_thermo(go(folder, six(LAWS["hooke"], common="contacts"), "a", 2000, every=500, more=more)[1])
    pushed = [row for row in rows if row[2]]
    fact("contacts: some push", len(pushed) > 10)
    at_most("contacts: fix ave/atom has their column",
            max(abs(row[1] + row[2]) for row in rows) / max(abs(row[2]) for row in rows), 1e-12)


def test_servo(folder):
    text = go(folder, six(LAWS["hooke_history"], PRESS), "a", 400,
              more=thermo("f_wall[12] f_wall[13] f_wall[14] " + " ".join(
                  f"f_wall[{k}][{c}]" for k in (1, 6) for c in (12, 13, 14)) + " f_wall[6][3]", 10))[1]
    rows = lmp.read_thermo(text)
    fact("servo: its columns are those of the mesh that has it",
         all(row[1:4] == row[7:10] and row[4:7] == [0, 0, 0] for row in rows) and
         any(row[1] for row in rows))
    fact("servo: its push is the force on its mesh", all(row[9] == -row[10] or row[9] == row[10] == 0
                                                         for row in rows))
    both = dict(PRESS, yhi="servo force y -40 vmax 2")
    rows = lmp.read_thermo(go(folder, six(LAWS["hooke_history"], both), "a", 50,
                              more=thermo("f_wall[12] f_wall[4][12] f_wall[6][12]"))[1])
    fact("servo: of two the vector has none, and the array both",
         all(row[1] == 0 for row in rows) and rows[-1][2] < 0 and rows[-1][3] < 0)


def proceed(folder, walls, restart, name, steps, ranks=1):
    text = lmp.run_well(lmp.head() + f"read_restart {restart}\n" +
                        FORCES.format(walls=walls, dt=1e-4, more="") +
                        DUMP.format(every=20, name=name) + f"run {steps}\n", folder, ranks)
    return lmp.read_dump(folder / name), text


def test_restart(folder):
    law = "hooke/history 1e5 NULL 20 NULL 0.5 1"
    walls = six(law, PRESS, "wear archard 1e-3 1e6")
    for ranks in (1, 2):
        begin = build(walls, "a", 600, every=20).replace("dump  ", "#dump  ").replace("dump_modify", "#")
        lmp.run_well(begin + "write_restart half.restart\n" + DUMP.format(every=20, name="two") +
                     "run 600\n", folder, ranks)
        two = lmp.read_dump(folder / "two")
        again, text = proceed(folder, walls, "half.restart", "continued", 600, ranks)
        at_most(f"restart on {ranks}: the same bits", lmp.largest_difference(two, again), 0)
        fact(f"restart on {ranks}: nothing is warned of", not re.search("WARNING: Fix wall.*restart", text),
             "".join(re.findall("WARNING: Fix wall.*restart.*", text)))
    fewer = walls.replace(f"mesh zhi.stl {PRESS['zhi']}", "")
    text = proceed(folder, fewer, "half.restart", "c", 10)[1]
    fact("restart: fewer meshes are told of", "written with 6 meshes and this fix has 5: "
         "springs, motion, loads and wear of those after mesh 5 are not carried over" in text)
    text = proceed(folder, walls + " mesh zlo.stl move 0 0 -0.5", "half.restart", "c", 10)[1]
    fact("restart: so are more", "written with 6 meshes and this fix has 7: those after mesh "
         "6 start without springs" in text)
    write_plate(folder / "fine.stl", 1, SIDE, cells=2)
    text = proceed(folder, walls.replace("yhi.stl", "fine.stl"), "half.restart", "c", 10)[1]
    fact("restart: another mesh is named", "mesh 4 'fine.stl': springs, motion, loads and wear "
         "start from zero" in text)
    text = proceed(folder, walls.replace("yhi.stl", "yhi.stl move 0 1e-3 0"), "half.restart", "c", 10)[1]
    fact("restart: another one with as many triangles, too", "mesh 4 'yhi.stl': springs, motion, loads "
         "and wear start from zero" in text)


def test_ranks(folder):
    law = LAWS["hertz_history"]
    runs = [go(folder, six(law, PRESS), f"r{ranks}", 600, ranks, every=100,
               more=thermo(columns(6, 9), 100)) for ranks in (1, 2, 4)]
    for ranks, run in ((2, runs[1]), (4, runs[2])):
        # Without a pair style nothing but the servo tells one sphere of another: sums over
        # processes part by rounding, which contacts of 600 steps multiply by 1e3 at most.
        at_most(f"{ranks} processes", lmp.largest_difference(runs[0][0], run[0]), 1e-10)
        one, many = lmp.read_thermo(runs[0][1])[-1], lmp.read_thermo(run[1])[-1]
        size = max(abs(v) for v in one)
        at_most(f"{ranks} processes: array", max(abs(u - v) for u, v in zip(one, many)) / size,
                1e-9)


def test_modify(folder):
    """fix_modify stops one mesh and starts another."""
    walls = six(LAWS["hooke"], {"zlo": "motion linear 0 0 1.0"})
    text = build(walls, "a", 100, every=100)
    text += "fix_modify wall mesh 5 motion none mesh 6 motion linear 0 0 -1.0\n"
    done = lmp.run_well(text + "run 100\n", folder)
    fact("fix_modify mesh 5: is named in the log",
         "mesh 5 'zlo.stl': motion none" in done and "mesh 6 'zhi.stl': motion linear" in done)
    one = build(f"fix wall all wall/lsdcd {LAWS['hooke']} mesh zlo.stl", "a", 1)
    fact("fix_modify mesh 1 of one mesh",
         "motion linear" in lmp.run_well(one + "fix_modify wall mesh 1 motion linear 0 0 1\nrun 1\n",
                                         folder))


def test_pictures(folder):
    text = build(six(LAWS["hooke"], {"zlo": "wiggle z 0.1 0.05"}), "a", 20, every=20)
    done = lmp.run_well(text + "dump i all image 10 a.*.ppm type type fix wall type 0.05 0\nrun 20\n",
                        folder)
    # A plate of two triangles has four open edges.
    fact("dump image draws all meshes", "draws the mesh as 24 lines" in done)
