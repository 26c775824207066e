# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Scalar, vector, contacts array and picture of the fix, from step 0 on."""

import math

import lmp
import stl
from facts import fact

HEAD = lmp.head("-3 3 -3 3 -1 5", types=2)
SPHERES = "set group all diameter 1.0 density 2.0\n"
TAIL = """\
pair_style      zero 1.2
pair_coeff      * *
fix             move all nve/sphere
fix             wall {group} wall/lsdcd {law} mesh {mesh} {more}
timestep        1e-4
thermo_style    custom step f_wall f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] f_wall[6] &
                f_wall[7] f_wall[8] f_wall[9] pe
thermo_modify   format float %.17g norm no
dump            d all custom 1 contacts id fx fy fz tqx tqy tqz {columns}
dump_modify     d format float %.17g sort id
{extra}
run             {steps}
"""
CONTACTS = " ".join(f"f_wall[{k}]" for k in range(1, 9))
TWO = """\
create_atoms    1 single 1.0 0.5 0.49 units box
create_atoms    2 single -1.0 0.25 0.45 units box
""" + SPHERES


def go(folder, atoms=TWO, law="hooke 1e4 NULL 0 NULL 0 0", group="all", more="contacts", steps=0,
       extra="", columns=CONTACTS, ranks=1,
       mesh="floor.stl"):
    text = lmp.run_well(HEAD + atoms + TAIL.format(law=law, group=group, more=more, steps=steps,
                                                   extra=extra, columns=columns,
                                                   mesh=mesh), folder, ranks)
    return lmp.read_thermo(text), lmp.read_dump(folder / "contacts"), text


def close(a, b):
    return math.isclose(a, b, rel_tol=1e-13, abs_tol=1e-13)    # a few roundings


prepare = lmp.flat_floor


def test_in_commands(folder):
    """How the manual says that commands read the array: overlaps 0.01 and 0.05, kn 1e4."""
    letter = lmp.column()
    _, _, text = go(folder, extra=f"""\
variable        push atom {letter}_wall[4]
compute         sum all reduce sum v_push
compute         same all reduce sum f_wall[4]
fix             h all ave/histo 1 1 1 0 1000 2 v_push mode vector
thermo_style    custom step c_sum c_same f_h[1] f_h[2] f_h[3] f_h[4]
thermo_modify   format float %.17g norm no""", steps=1)
    row = lmp.read_thermo(text)[0]
    fact(f"an atom-style variable reads a column as {letter}_ID[4]", close(row[1], 600), str(row[1]))
    fact("compute reduce reads a column as f_ID[4]", close(row[2], 600), str(row[2]))
    last = lmp.read_thermo(text)[-1]    # both, none outside, least, most; after a step of 1e-4
    fact("fix ave/histo reads the variable", last[3:5] == [2, 0] and
         abs(last[5] - 100) < 0.1 and abs(last[6] - 500) < 0.1, str(last[3:]))


def test_in_minimization(folder):
    """After a run in which both spheres touch. In a minimization the wall does not act."""
    columns = " ".join(f"f_wall[{k}]" for k in range(1, 12))
    rows, _, text = go(folder, extra=f"""\
fix_modify      wall energy yes virial yes
compute         push all pressure NULL virial
thermo_style    custom step pe c_push f_wall {columns}
run             1
min_style       cg
minimize        0 0 2 2
write_dump      all custom minimized id {CONTACTS} modify sort id
""")
    rows_in = next(iter(lmp.read_dump(folder / "minimized").values()))
    there = lmp.read_thermo(text.split("Minimization stats")[0])
    fact("before and after a minimization there are energy, virial and vector",
         all(row[1] > 0 and row[2] > 0 and row[8] < 0 for row in rows), str(rows[0]))
    fact("in a minimization they are 0", len(there) > 0 and not any(any(row[1:]) for row in there),
         str(there))
    fact("in a minimization rows of contacts are 0",
         not any(any(row) for row in rows_in.values()), str(rows_in))


def local_rows(path):
    """The rows of the last snapshot of a dump local: atom, mesh, force, point, overlap."""
    rows = path.read_text().split("ITEM: ENTRIES")[-1].splitlines()[1:]
    return sorted([float(word) for word in row.split()] for row in rows)


def test_each_contact(folder):
    """Atom 2 touches the floor at z = 0 and a wall that goes along x from -1.45 on at 0.1, where it is after 10 steps
    of 1e-4; atom 1 touches the floor."""
    entries = " ".join(f"f_wall[{k}]" for k in range(1, 10))
    for ranks in (1, 2):
        thermo, dump, _ = go(folder, ranks=ranks, steps=10, law="hooke 1e4 NULL 0 NULL 0.5 1", extra=f"""\
dump            l all local 10 local {entries}
dump_modify     l format float %.17g""", columns=CONTACTS + " x y z",
                             more="each_contact contacts mesh floor.stl rotate 0 1 0 90 move -1.45 0 0 motion linear 0.1 0 0")
        rows, atoms, on = local_rows(folder / "local"), dump[10], f"on {ranks} ranks"
        fact(f"each_contact {on}: a row for each", [row[:2] for row in rows] == [[1, 1], [2, 1], [2, 2]], str(rows))
        at = [atoms[row[0]][14:] for row in rows]
        feet = [[at[0][0], at[0][1], 0], [at[1][0], at[1][1], 0], [-1.45 + 0.1 * 1e-3, *at[2][1:]]]
        fact(f"each_contact {on}: points", all(
            abs(a - b) < 1e-12 for row, foot in zip(rows, feet) for a, b in zip(row[5:8], foot)), str(rows))
        overlaps = [0.5 - math.dist(x, foot) for x, foot in zip(at, feet)]
        fact(f"each_contact {on}: overlaps", all(abs(row[8] - o) < 1e-12 for row, o in zip(rows, overlaps)),
             str((rows, overlaps)))
        pushes = (rows[0][4], rows[1][4], rows[2][2])
        fact(f"each_contact {on}: normal forces are 1e4 overlaps",
             all(abs(f / (1e4 * o) - 1) < 1e-9 for f, o in zip(pushes, overlaps)), str((pushes, overlaps)))
        for i in (1, 2):
            total = [sum(row[2 + d] for row in rows if row[0] == i) for d in range(3)]
            fact(f"each_contact {on}: forces on atom {i} add up to its force in contacts", all(
                abs(a - b) < 1e-10 for a, b in zip(total, atoms[i][7:10])), str((total, atoms[i])))


def test_step_0(folder):
    for ranks in (1, 2):
        # Overlaps 0.01 and 0.05: forces 100 and 500, energies 0.5 and 12.5.
        thermo, dump, _ = go(folder, ranks=ranks)
        row, on = thermo[0], f"on {ranks} rank{'s' if ranks > 1 else ''}"
        fact(f"step 0 {on}: energy", close(row[1], 13.0), str(row[1]))
        fact(f"step 0 {on}: force on the mesh",
             row[2] == 0 and row[3] == 0 and close(row[4], -600), str(row[2:5]))
        # r x F with F = -100 z at (1, 0.5) and -500 z at (-1, 0.25)
        fact(f"step 0 {on}: torque on the mesh about the origin",
             close(row[5], -175) and close(row[6], -400) and close(row[7], 0), str(row[5:8]))
        fact(f"step 0 {on}: contacts", row[8] == 2, str(row[8]))
        fact(f"step 0 {on}: largest overlap", close(row[9], 0.1), str(row[9]))
        fact(f"step 0 {on}: all certified", row[10] == 0, str(row[10]))
        one = dump[0][2]
        fact(f"step 0 {on}: contacts array",
             one[6] == 1 and close(one[9], 500) and close(one[10], -1) and
             close(one[11], 0.25) and close(one[12], 0) and one[13] == 0.5, str(one[6:]))


def test_torque_about_a_point(folder):
    """From (1, 0.5) the one force has no arm, and the other's is (-2, -0.25)."""
    thermo, _, _ = go(folder, more="contacts torque_about 1 0.5 7")
    fact("torque_about: of a point of the box", close(thermo[0][5], 125) and
         close(thermo[0][6], -1000) and close(thermo[0][7], 0), str(thermo[0][5:8]))
    thermo, _, _ = go(folder, extra="thermo_style custom step f_wall[10] f_wall[11]")
    fact("a wall at rest without wear: no work, no volume", thermo[0][1:] == [0, 0], str(thermo[0]))


def test_group(folder):
    thermo, dump, _ = go(folder, group="some", atoms=TWO + "group some type 1\n")
    fact("group: only its spheres feel the wall",
         thermo[0][8] == 1 and dump[0][2][2] == 0, str(thermo[0][8]))


def test_dynamic_group(folder):
    """A sphere that goes through the overlap with a floor feels it in the steps in which it is in the group, and in no other."""
    move = "region right block 0 1 INF INF INF INF units box\ngroup near dynamic all region right every {}\nvariable in_group atom gmask(near)\n"
    for every in (1, 3):
        atoms = "create_atoms 1 single -0.0105 0 0.49 units box\n" + SPHERES + "velocity all set 1 0 0\n" + move.format(every)
        _, dump, _ = go(folder, group="near", atoms=atoms, columns="v_in_group f_wall[1]", law="hooke 1e-4 NULL 0 NULL 0 0",
                        extra="timestep 0.001\nfix hold all setforce 0 0 0", steps=30)
        rows = [dump[step][1] for step in sorted(dump)]
        fact(f"every {every}: where it is in the group, there is a contact", all(row[6] == row[7] for row in rows), str(rows[8:15]))
        fact(f"every {every}: it joins", [row[6] for row in rows[::15]] == [0, 1, 1], str(rows))


def test_no_atoms(folder):
    thermo, dump, text = go(folder, atoms="", steps=2)
    fact("no atoms: runs, totals are zero", not any(thermo[0][1:]))


def test_atoms_that_come_later(folder):
    late = ("run 5\ncreate_atoms 1 single 0 0 0.49 units box\n" + SPHERES +
            "run 2\ncreate_atoms 1 single 2 0 0.78 units box\nset atom 2 diameter 1.6 density 2.0")
    thermo, dump, text = go(folder, atoms="", extra=late)
    fact("atoms that come later find the wall", thermo[-1][8] == 2, str(thermo[-1][8]))
    fact("a larger atom rebuilds the grid, with a line in the log",
         "grid rebuilt for radius 0.88" in text)


def test_fix_modify_energy(folder):
    thermo, _, _ = go(folder, extra="fix_modify wall energy yes")
    fact("fix_modify energy adds the elastic energy", close(thermo[0][11], 13.0),
         str(thermo[0][11]))


def test_means(folder):
    """LAMMPS averages f_wall[1] to f_wall[6] itself, over the same steps."""
    thermo, _, _ = go(folder, law="hertz/history 1e5 NULL 0 NULL 0.5 0", more="contacts average 20",
                      atoms="create_atoms 1 single 0.3 0 0.51 units box\n" + SPHERES + "velocity all set 0.3 0 -1.0\n",
                      extra="fix by_lammps all ave/time 1 20 20 " + " ".join(f"f_wall[{k}]" for k in range(1, 7)) +
                            "\nthermo_style custom step " + " ".join(f"f_by_lammps[{k}] f_wall[{k + 41}]" for k in range(1, 7)) +
                            "\nthermo 20\nthermo_modify format float %.17g norm no", steps=200)
    off = max(abs(row[k] - row[k + 1]) for row in thermo[1:] for k in range(1, 13, 2))
    fact("means are those that LAMMPS makes of the force and torque of each step",
         len(thermo) == 11 and max(abs(row[5]) for row in thermo) > 10 and off < 1e-10, f"{off} {thermo[-1]}")


def test_warnings(folder):
    # Dropped at speed 10 the sphere sinks v sqrt(m/k) = 0.1, a fifth of its radius.
    fast = "create_atoms 1 single 0 0 0.51 units box\n" + SPHERES + "velocity all set 0 0 -10\n"
    _, _, text = go(folder, atoms=fast, steps=400)
    fact("a large overlap is warned of once", text.count("sank into the wall by") == 1)
    fact("hooke stores nothing per atom", "nothing stored, exchanged or restarted" in
         go(folder, more="", columns="")[2])


def test_side(folder):
    """A centre 0.1 below the bottom of the cube: inside it belongs 0.6 higher, outside 0.4 lower."""
    low = "create_atoms 1 single 0.3 0.1 -0.1 units box\n" + SPHERES
    for inward in (False, True):
        stl.write(folder / "cube.stl", [t[::-1] if inward else t for t in stl.box((-2, -2, 0), (2, 2, 4))])
        for side, force in (("in", 6000), ("out", -4000)):
            thermo, _, text = go(folder, atoms=low, mesh="cube.stl", more=f"side {side} contacts")
            fact(f"side {side}: a centre past the wall is asked about",
                 ("centre is past the wall" in text) == (side == "in"))
            fact(f"side {side}, wound {'in' if inward else 'out'}wards: back to its side",
                 close(thermo[0][4], -force), str(thermo[0][4]))


def pixels(folder, draw, flags, mesh):
    """{(column, row from below): red, green, blue} of what a picture from above shows of a mesh alone: of no atom, box or axis. `flags`: the diameter of
    lines, or 1 for filled triangles, and 0."""
    go(folder, more=f"contacts {draw}", mesh=mesh, extra="group none empty\n" +
       f"dump pic none image 1 wall.*.ppm type type fix wall type {flags} view 0 0 up 0 1 0 size 200 200 zoom 4 box no 0 axes no 0 0\n")
    head, rgb = (folder / "wall.0.ppm").read_bytes().split(b"\n255\n", 1)
    words = [w for line in head.split(b"\n") if not line.startswith(b"#") for w in line.split()]    # a LAMMPS of 2026 signs it
    assert (words, len(rgb)) == ([b"P6", b"200", b"200"], 3 * 200 * 200)
    return {(k % 200, 199 - k // 200): tuple(rgb[3 * k:3 * k + 3]) for k in range(200 * 200) if max(rgb[3 * k:3 * k + 3]) > 0}


def spans(some):
    """First and last columns, first and last rows."""
    return [f(p[k] for p in some) for k in (0, 1) for f in (min, max)]


def test_what_pictures_show(folder):
    """A plate seen from above, as faces, as edges and cut: which pixels it covers. A corner may be a pixel off."""
    stl.write(folder / "plate.stl", stl.sheet(8, lambda i, j: (i / 4 - 1, j / 4 - 1, 0)))
    whole = pixels(folder, "draw faces 2", "1 0", "plate.stl")
    left, right, low, high = spans(whole)
    width, height = right - left + 1, high - low + 1
    # LAMMPS leaves out pixels between triangles.
    fact("a square is a square, filled", abs(width - height) <= 1 and width > 30 and len(whole) >= 0.9 * width * height, f"{spans(whole)} {len(whole)}")
    fact("in the colour of type 2, which is green", all(green > max(red, blue) for red, green, blue in whole.values()), str(set(whole.values())))
    small = pixels(folder, "draw faces 2", "1 0", "plate.stl scale 0.5 move 0.5 -0.25 0")
    there = [left + 0.5 * width, left + width, low + height / 8, low + 0.625 * height]
    fact("half as large, moved by half its first half-width and down by a quarter of it", all(
        abs(a - b) <= 1.5 for a, b in zip(spans(small), there)), f"{spans(small)} {there}")
    cut = pixels(folder, "draw faces 2 cut 1 0 0 0", "1 0", "plate.stl")
    fact("cut 1 0 0 0 leaves the half with x < 0", abs(spans(cut)[1] - (left + right) / 2) <= 1.5 and spans(cut)[0] == left and cut.keys() <= whole.keys(), f"{spans(cut)}")
    lines = pixels(folder, "draw edges", "0.05 0", "plate.stl")
    thick = 0.05 / 2 * width
    fact("the edges of a plate are its rim: lines of that diameter, and nothing in between", all(
        abs(a - b) <= 1.5 + thick / 2 for a, b in zip(spans(lines), spans(whole))) and not any(
            left + 2 * thick + 2 < x < right - 2 * thick - 2 and low + 2 * thick + 2 < y < high - 2 * thick - 2 for x, y in lines) and
        {x for x, y in lines if abs(y - low) <= thick + 2} >= set(range(left + 1, right)), f"{spans(lines)} {len(lines)}")
    cuts = pixels(folder, "draw contours", "0.05 0", "plate.stl")
    row = round(low + 0.3 * height)
    at = [x for x in range(200) if (x, row) in cuts]
    fact("contours are nine lines along y and one along x: here the nine", all(
        min(abs(x - (left + (k + 0.5) / 9 * width)) for k in range(9)) <= 1.5 + thick / 2 for x in at) and all(
            min(abs(x - (left + (k + 0.5) / 9 * width)) for x in at) <= 1.5 for k in range(9)), f"{at}")


def test_place(folder):
    """Where a moving mesh is: what was at 0 0 0, and its rotation, of one mesh and of a row of several."""
    columns = " ".join(f"f_wall[{k}]" for k in range(48, 55))
    turned, o, t = 2 * math.pi * 0.3 / 4, (1, 0, 0), 0.3
    at = (o[0] - math.cos(turned) * o[0], -math.sin(turned) * o[0], 0)
    for motion, place, turn in (("linear 0.5 0 -0.25", (0.5 * t, 0, -0.25 * t), (1, 0, 0, 0)),
                                ("rotate 1 0 0 0 0 2 4", at, (math.cos(turned / 2), 0, 0, math.sin(turned / 2)))):
        form = "thermo_style custom step {}\nthermo_modify format float %.17g norm no\ntimestep 1e-3"
        row = go(folder, more=f"motion {motion}", columns="", steps=300, extra=form.format(columns))[0][-1]
        fact(f"place and rotation by {motion}", all(abs(a - b) <= 1e-13 for a, b in zip(row[1:], [*place, *turn])), str(row))
        row = go(folder, more=f"mesh floor.stl motion {motion}", columns="", steps=300, extra="".join(
            f"variable p{k} equal f_wall[2][{k}]\nvariable q{k} equal f_wall[1][{k}]\n" for k in range(48, 55)) +
            form.format(" ".join(f"v_{x}{k}" for x in "pq" for k in range(48, 55)) + " " + columns))[0][-1]
        fact(f"... of the second of two meshes, by {motion}", all(abs(a - b) <= 1e-13 for a, b in zip(row[1:], [
            *place, *turn, 0, 0, 0, 1, 0, 0, 0, *place, *turn])), str(row))
