# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""region mesh/lsdcd against LAMMPS's own block, at rest and moving, and clear of the wall.

A box of triangles has the block's faces without rounding, and LAMMPS moves both alike: the same atoms are
inside, also those on its faces.
"""

import math

import lmp
import stl
from facts import fact

LO, HI = (-1.25, -0.75, -1.0), (1.0, 1.5, 0.5)    # of the block
RADIUS, HALF, SIDES = 1.1, 1.3, 90                # of the cylinder about z
START = lmp.head("-3 3 -3 3 -3 3")
ATOMS = 24 ** 3 + 5000
# A lattice with atoms on the block's faces, edges and corners, and atoms at random.
CLOUD = START + """\
lattice         sc 64.0
create_atoms    1 box
create_atoms    1 random 5000 4711 box
pair_style      zero 0.1
pair_coeff      * *
set             group all diameter 0.1
fix             move all nve/sphere
timestep        0.1
"""


def prism(outline, lo, hi):
    """Closed, of a convex outline in x and y that turns left, normals out."""
    n, made = len(outline), []
    low, high = [(x, y, lo) for x, y in outline], [(x, y, hi) for x, y in outline]
    for i in range(n):
        j = (i + 1) % n
        made += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
    for i in range(1, n - 1):
        made += [(low[0], low[i + 1], low[i]), (high[0], high[i], high[i + 1])]
    return made


def write_meshes(folder):
    (x, y, z), (X, Y, Z) = LO, HI
    stl.write(folder / "box.stl", prism([(x, y), (X, y), (X, Y), (x, Y)], z, Z))
    turn = [2 * math.pi * i / SIDES for i in range(SIDES)]
    stl.write(folder / "cylinder.stl", prism([(RADIUS * math.cos(a), RADIUS * math.sin(a)) for a in turn], -HALF, HALF))
    stl.write(folder / "open.stl", prism([(x, y), (X, y), (X, Y), (x, Y)], z, Z)[:-1])
    # The block as two that overlap.
    stl.write(folder / "two.stl", prism([(x, y), (0.25, y), (0.25, Y), (x, Y)], z, Z) +
              prism([(-0.5, y), (X, y), (X, Y), (-0.5, Y)], z, Z))


def block(words=""):
    (x, y, z), (X, Y, Z) = LO, HI
    return f"block {x} {X} {y} {Y} {z} {Z} units box {words}"


def differing(text, folder, pairs):
    """For each pair of regions: the atoms of the first that are not in the second, and those that are in the first."""
    for a, b in pairs:
        text += f"group a region {a}\ngroup b region {b}\ngroup rest subtract a b\n"
        text += 'print "differ $(count(rest)) $(count(a))"\n'
        text += "group rest delete\ngroup a delete\ngroup b delete\n"
    out = lmp.run_well(text, folder)
    rows = [line.split()[1:] for line in out.split("\n") if line.startswith("differ ")]
    return [(int(float(rest)), int(float(inside))) for rest, inside in rows]


def expect_equal(folder, cases, before):
    """Rows of a name, the words of our region and LAMMPS's region, all in one script."""
    pairs = []
    for k, (_, mesh, own) in enumerate(cases):
        before += f"region mesh{k} mesh/lsdcd {mesh}\nregion own{k} {own}\n"
        pairs += [(f"mesh{k}", f"own{k}"), (f"own{k}", f"mesh{k}")]
    found = differing(before, folder, pairs)
    for k, (name, _, _) in enumerate(cases):
        ours, theirs = found[2 * k:2 * k + 2]
        fact(name, ours[0] == theirs[0] == 0 and 100 < ours[1] < ATOMS - 100, f"{ours}, {theirs}")


MOVES = "variable a equal 0.3\nvariable b equal -0.7\nvariable c equal 0.45\nvariable turn equal 0.8\n"
BY = "move v_a v_b v_c rotate v_turn 0.2 -0.1 0.3 1 2 -1"


def prepare(folder):
    write_meshes(folder)


def test_block(folder):
    expect_equal(folder, [
        ("a box has the atoms of a block", "box.stl", block()),
        ("side out", "box.stl side out", block("side out")),
        ("moved", "box.stl move v_a NULL v_c", block("move v_a NULL v_c")),
        ("moved and turned", f"box.stl {BY}", block(BY)),
        ("moved and turned, side out", f"box.stl side out {BY}", block(f"side out {BY}")),
        ("two boxes that overlap are their union", "two.stl", block()),
        ("placed by the words of the mesh", "box.stl scale 2 move 0.5 0.25 0 scale 0.5 move -0.25 -0.125 0", block()),
        # gap: the block without its rim, and what is farther from it
        ("gap", "box.stl gap 0.2", "block -1.05 0.8 -0.55 1.3 -0.8 0.3 units box"),
    ], CLOUD + MOVES)
    scaled = "lattice sc 0.125\nregion half block -0.625 0.5 -0.375 0.75 -0.5 0.25 units lattice\n"
    expect_equal(folder, [("units lattice", "box.stl scale 0.5 units lattice", "intersect 2 half half"),
                          ("gap in units lattice", "box.stl scale 0.5 gap 0.1 units lattice", "block -1.05 0.8 -0.55 1.3 -0.8 0.3 units box")],
                 CLOUD + scaled)


def test_commands(folder):
    """What takes a region, with ours and with LAMMPS's."""
    results = []
    for region in ("mesh/lsdcd box.stl", block()):
        text = CLOUD + f"region r {region}\n" + """\
set             group all density 2.0
variable        one atom 1
compute         sum all reduce/region r sum v_one x
dump            d all custom 1 dump id x y z
dump_modify     d region r sort id format float %.17g
thermo_style    custom step c_sum[1] c_sum[2]
run             0
delete_atoms    region r
fix             in all deposit 50 1 1 4711 region r near 0.1 units box
run             60
print           "left $(atoms)"
"""
        out = lmp.run_well(text, folder)
        results.append((lmp.read_dump(folder / "dump"), [line for line in out.split("\n") if line.startswith("left")]))
    fact("compute reduce/region, dump, delete_atoms and fix deposit give what they give with a block",
         results[0] == results[1] and len(results[0][0][0]) > 100, str(results[0][1]) + str(results[1][1]))


FILL = START + """\
region          fill mesh/lsdcd cylinder.stl scale 2 {gap}
create_atoms    1 random 1000 4711 fill
set             group all diameter 0.2
set             group all density 1.0
pair_style      zero 1.0
pair_coeff      * *
fix             move all nve/sphere
timestep        1e-5
fix             wall all wall/lsdcd hooke 1e4 NULL 0 NULL 0 0 mesh cylinder.stl scale 2
dump            d all custom 1 dump id x y z
dump_modify     d sort id format float %.17g
thermo_style    custom step atoms f_wall[7] f_wall[8]
run             0
"""


def test_gap(folder):
    atoms = {}
    for ranks in (1, 2, 4):
        last = lmp.read_thermo(lmp.run_well(FILL.format(gap="gap 0.1"), folder, ranks))[-1]
        atoms[ranks] = sorted(lmp.read_dump(folder / "dump")[0].values())
        fact(f"with a gap of a radius no grain touches the wall, {ranks} ranks",
             last[1] == 1000 and last[2] == last[3] == 0, str(last))
    fact("1, 2 and 4 ranks make the same grains", atoms[1] == atoms[2] == atoms[4])
    last = lmp.read_thermo(lmp.run_well(FILL.format(gap=""), folder))[-1]
    fact("without it some do", last[2] > 0, str(last))


def test_scale(folder):
    told = "WARNING: Region part mesh/lsdcd: the mesh is far larger than the box: it spans", "add scale 0.001"
    region = "region part mesh/lsdcd box.stl {}\ngroup part region part\nrun 0\nrun 0\n"
    text = lmp.run_well(CLOUD + region.format("scale 1000"), folder, 2)
    found = [line for line in text.split("\n") if all(words in line for words in told)]
    fact("a mesh in other units is told once, with its scale", len(found) == 1, text[-600:])
    text = lmp.run_well(CLOUD + region.format(""), folder)
    fact("a mesh of the script's units is not", "WARNING: Region" not in text)
