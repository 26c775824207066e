# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix insert/lsdcd: how much comes, where, and that it depends on neither restarts nor the number of processes.

All grains of a case have one velocity, so that none that was put clear of the others is in their way later: the
last dump shows every overlap that there ever was.
"""

import math
import re
import resource

import numpy
import pytest

import lmp
import stl
import vtp
from facts import at_most, fact
from triangles import closest_on_triangle

RATE, DENSITY, SPEED = 0.05, 2.0, 1.0
SIZES = {0.1: 0.5, 0.16: 0.3, 0.2: 0.2}    # shares of mass
END = lmp.pairs("zero 0.1", 0.05) + "fix             move all nve/sphere\n"
DUMP = "dump d all custom {} grains id radius mass x y z vx vy vz\ndump_modify d sort id format float %.17g\n"


def mass(diameter):
    return math.pi / 6 * diameter ** 3 * DENSITY


def last(dump):
    return dump[max(dump)]


def overlaps(grains, edges=None):
    """Pairs of grains nearer than their radii; with periodic edges, also with images."""
    found, rows = [], list(grains.values())
    steps = range(-1, 2) if edges else (0,)
    shifts = [[sum(n * e[k] for n, e in zip((i, j, m), edges or ((0,) * 3,) * 3)) for k in range(3)]
              for i in steps for j in steps for m in steps]
    for i, a in enumerate(rows):
        for b in rows[:i]:
            for s in shifts:
                if math.dist(a[2:5], [x + y for x, y in zip(b[2:5], s)]) < (a[0] + b[0]) * (1 - 1e-12):
                    found.append((a, b))
    return found


SIZE_WORDS = f"diam mass {len(SIZES)} " + " ".join(f"{d} {share}" for d, share in SIZES.items()) + f" dens {DENSITY}"
FACE = lmp.head("-1 1 -1 1 -9 3", types=2) + END + "timestep 0.008\n"
INLET = f"fix in all insert/lsdcd mesh inlet.stl move 0.1 -0.1 0 massrate {RATE} {SIZE_WORDS} type 2 vel normal {SPEED} seed 11\n"


def test_face(folder):
    """10 time units through a square of side 1 with normal -z, at z = 2."""
    stl.write(folder / "inlet.stl", [t[::-1] for t in stl.square(0.5, 2)])
    thermo = "thermo 1\nthermo_style custom step time atoms f_in[1] f_in[2] f_in[3]\nthermo_modify format float %.17g norm no\n"
    text = FACE + INLET + thermo + DUMP.format(1250) + "run 1250\n"
    out = lmp.run_well(text, folder)
    rows = lmp.read_thermo(out)
    # A grain comes when the rate has reached it, and is of the largest size at most.
    behind = [RATE * row[1] - row[4] for row in rows]
    fact("what is in is the rate times the time to within a grain, in every step",
         len(rows) == 1251 and rows[-1][5] == 0 and -1e-9 < min(behind) and max(behind) < mass(0.2),
         f"{min(behind)} {max(behind)} {rows[-1]}")
    there = lmp.read_dump(folder / "grains")
    grains = last(there)
    fact("the fix's sums are those of the grains",
         len(grains) == rows[-1][3] and abs(sum(g[1] for g in grains.values()) - rows[-1][4]) < 1e-9)
    # Of n grains, a size has a number about n p with the variance n p (1 - p); 4.5 deviations: 1 in 1e5.
    number = {d: share / mass(d) for d, share in SIZES.items()}
    total, n = sum(number.values()), len(grains)
    off = max(abs(sum(abs(2 * g[0] - d) < 1e-12 for g in grains.values()) - n * p / total) /
              math.sqrt(n * p / total * (1 - p / total)) for d, p in number.items())
    fact("sizes have their shares of the mass", off < 4.5 and n > 200, f"{off} of {n}")
    fact("no grain overlaps another", not overlaps(grains), str(overlaps(grains)[:1]))
    # In x and y a radius off the edges of the face; the velocity is along its normal.
    wrong = [g for g in grains.values() if max(abs(g[2] - 0.1), abs(g[3] + 0.1)) > 0.5 - g[0] + 1e-7 or g[5:] != [0, 0, -SPEED]]
    fact("grains come through the face, along its normal", not wrong, str(wrong[:1]))
    fact("neighbour lists are for the largest grain to come", "ghost atom cutoff = 0.15" in out or
         "ghost atom cutoff = 0.25" in out)
    for ranks in (2, 4):
        lmp.run_well(text, folder, ranks)
        fact(f"the same grains, with the same IDs, on {ranks} ranks", lmp.read_dump(folder / "grains") == there)
    lmp.run_well(FACE + INLET + "run 586\nwrite_restart half.restart\n", folder)
    lmp.run_well(lmp.head() + "read_restart half.restart\n" + END + "timestep 0.008\n" + INLET + DUMP.format(1250) + "run 664\n",
                 folder, 2)
    fact("after a restart in the middle the same grains, to the last bit",
         last(lmp.read_dump(folder / "grains")) == grains)
    lmp.run_well(FACE + INLET + DUMP.format(1250) + "run 250\nrun 336\nrun 664\n", folder)
    fact("in three runs the same", last(lmp.read_dump(folder / "grains")) == grains)
    rows = lmp.read_thermo(lmp.run_well(FACE + INLET + thermo + "fix dt all dt/reset 50 0.001 0.01 0.004 units box\nrun 500\n",
                                        folder))
    behind = [RATE * row[1] - row[4] for row in rows]
    fact("with a timestep that changes in the run it follows the time, too", 1.5 < rows[-1][1] < 3 and
         -1e-9 < min(behind) and max(behind) < mass(0.2), f"{min(behind)} {max(behind)} {rows[-1]}")


def test_radii(folder):
    """LAMMPS makes neighbour lists for grains that come into an empty box."""
    text = FACE.replace("zero 0.1", "gran/hooke 100 NULL 1 NULL 0 0") + INLET + "run 1\n"
    out = lmp.run_well(text, folder)
    fact("a granular pair style knows the largest radius before the first grain is there",
         "ghost atom cutoff = 0.25" in out)


TILTED = lmp.head("0 2 0 1.5 0 1.2 0.7 0.3 -0.4", "p p p") + END + "timestep 0.001\n"
EDGES = ((2, 0, 0), (0.7, 1.5, 0), (0.3, -0.4, 1.2))


def test_periodic(folder):
    """A region in a tilted periodic box, filled at once and dense enough that faces matter."""
    text = TILTED + "region fill block INF INF INF INF INF INF units box\n" + \
        "fix in all insert/lsdcd region fill number 150 diam range 0.2 0.3 dens 1 3 attempts 2000\n" + \
        DUMP.format(1) + "run 1\n"
    lmp.run_well(text, folder)
    there = lmp.read_dump(folder / "grains")
    grains = last(there)
    fact("a tilted periodic box: no overlap across faces", len(grains) == 150 and not overlaps(grains, EDGES),
         f"{len(grains)} {overlaps(grains, EDGES)[:1]}")
    dense = [g[1] / (4 / 3 * math.pi * g[0] ** 3) for g in grains.values()]
    fact("sizes and densities are in their ranges",
         all(0.1 <= g[0] <= 0.15 for g in grains.values()) and 1 <= min(dense) < 1.2 and 2.8 < max(dense) <= 3)
    lmp.run_well(text, folder, 4)
    fact("and the same on 4 ranks", lmp.read_dump(folder / "grains") == there)


VESSEL = lmp.head("-2 2 -2 2 -2 2") + END + "timestep 0.01\nregion fill block -1.2 1.2 -1.2 1.2 -1.2 1.2 units box\n"
WALL = "hooke/history 100 NULL 1 NULL 0.5 1 "
FILL = "fix in all insert/lsdcd region fill numberrate 1000 diam range 0.1 0.2 dens 1 number 300 "


def test_wall(folder):
    """A cube in a larger region: grains are inside or outside of it, and touch it from neither side."""
    stl.write(folder / "cube.stl", stl.box((-1,) * 3, (1,) * 3))
    thermo = "thermo 1\nthermo_style custom step f_in[1] f_in[6] f_wall[7] f_wall[8]\nthermo_modify norm no\n"
    # The wall moves as its grains do: what it touches, it was put into.
    for name, motion, velocity in (("at rest", "", ""), ("that moves", "motion linear 0.5 0 0", "vel 0.5 0 0")):
        rows = lmp.read_thermo(lmp.run_well(VESSEL + f"fix wall all wall/lsdcd {WALL} mesh cube.stl {motion}\n" + FILL +
                                            velocity + "\n" + thermo + DUMP.format(40) + "run 40\n", folder))
        gap = []
        for g in last(lmp.read_dump(folder / "grains")).values():
            x = [abs(g[2] - (0.2 if motion else 0)), abs(g[3]), abs(g[4])]
            out = math.sqrt(sum(max(c - 1, 0) ** 2 for c in x))    # distance from the cube's surface
            gap.append((out if out > 0 else 1 - max(x)) - g[0])
        fact(f"clear of a wall {name}", rows[-1][1] == 300 and rows[-1][2] > 10 and min(gap) > -1e-9 and
             all(row[3] == 0 and row[4] == 0 for row in rows) and min(gap) < 0.02, f"{min(gap)} {rows[-1]}")
    check_brought(folder)
    rows = lmp.read_thermo(lmp.run_well(VESSEL + f"fix wall all wall/lsdcd {WALL} mesh cube.stl\n" + FILL + "wall none\n" +
                                        thermo + "run 2\n", folder))
    fact("wall none leaves it out of sight", rows[-1][3] > 0, str(rows[-1]))


def test_image_of_a_wall(folder):
    """A plate below the upper end of a periodic box keeps grains off its image, 0.05 below the lower end."""
    stl.write(folder / "plate.stl", stl.square(1.9, 1.95))
    text = VESSEL.replace("f f f", "p p p").replace("-1.2 1.2 units", "-2 -1.8 units")
    out = lmp.run_well(text + f"fix wall all wall/lsdcd {WALL} mesh plate.stl\n" + FILL + "\n" + DUMP.format(20) + "run 20\n", folder)
    gaps = [g[4] + 2.05 - g[0] for g in last(lmp.read_dump(folder / "grains")).values()]
    fact("grains are clear of the image of a wall", len(gaps) > 5 and -1e-9 < min(gaps) < 0.03, f"{len(gaps)} {min(gaps)} {out[-300:]}")


def check_brought(folder):
    """The cube again, which comes from afar and goes on while there are grains: by atoms that are its nodes, and as a heavy body."""
    corners = "".join(f"create_atoms 2 single {x} {y} {z} units box\n" for x in (-7, -5) for y in (-1, 1) for z in (-1, 1))
    text = VESSEL.replace("block -2 2", "block -8 2").replace("create_box      1", "create_box      2") + corners + \
        "set type 2 diameter 1e-3 density 1\ngroup nodes type 2\ngroup grains type 1\nunfix move\n" \
        "fix go nodes move linear 3.5 0 0 units box\n" \
        "fix wall grains wall/lsdcd hooke 1 NULL 0 NULL 0 0 mesh cube.stl move -6 0 0 {}\nrun 167\n" + \
        FILL.replace("in all", "in grains") + "\n" + DUMP.format(1) + "dump_modify d thresh mass > 1e-6\nrun 6\n"
    for name, words, place in (("whose nodes move", "nodes nodes", lambda step: 0.035 * step),
                               ("that is a body", "body density 1e9 gravity 4 0 0", lambda step: 2 * (0.01 * step)**2)):
        lmp.run_well(text.format(words), folder, 2)
        seen, gap = set(), []
        for step, grains in sorted(lmp.read_dump(folder / "grains").items()):
            for tag in grains.keys() - seen:
                x = [abs(grains[tag][2] + 6 - place(step)), abs(grains[tag][3]), abs(grains[tag][4])]
                out = math.sqrt(sum(max(c - 1, 0) ** 2 for c in x))
                gap.append((out if out > 0 else 1 - max(x)) - grains[tag][0])
            seen |= grains.keys()
        # Grains that it hits push the body of 8e9 by less than 1e-9.
        fact(f"clear of a wall {name}", len(gap) > 40 and -2e-9 < min(gap) < 0.03, f"{len(gap)} {min(gap)}")


def test_worn(folder):
    """A sheet that a ball wears down while grains come from below, at rest: clear of the shape that it has then."""
    stl.write(folder / "sheet.stl", stl.sheet(6, lambda i, j: (i / 3 - 1, j / 3 - 1, 0)))
    lmp.run_well(VESSEL.replace("fix             move all nve/sphere\n", "").replace("timestep 0.01", "timestep 0.001") + """\
create_atoms 1 single 0.3 0 0.195 units box
set group all diameter 0.4 density 1
group ball id 1
fix wall all wall/lsdcd hooke 2000 0 0 0 0 0 mesh sheet.stl wear archard 1 1000 deform every 10 factor 6 mesh_fields worn_*.vtp every 10
variable dx equal 0.3*cos(30*step*dt)-0.3
variable dy equal 0.3*sin(30*step*dt)
variable dz equal -0.3*step*dt
variable vx equal -9*sin(30*step*dt)
variable vy equal 9*cos(30*step*dt)
variable vz equal -0.3
fix go ball move variable v_dx v_dy v_dz v_vx v_vy v_vz units box
region below block -0.7 0.7 -0.7 0.7 -0.4 -0.06 units box
fix in all insert/lsdcd region below numberrate 100 diam one 0.1 dens 1 seed 3
""" + DUMP.format(10) + "run 500\n", folder)
    seen, gap, lowest = {1}, [], 0
    for step, grains in sorted(lmp.read_dump(folder / "grains").items()):
        new = grains.keys() - seen
        seen |= new
        if not new:
            continue
        worn = vtp.read(folder / f"worn_{step}.vtp")
        triangles = numpy.reshape(worn["points"], (-1, 3))[numpy.reshape(worn["connectivity"], (-1, 3))]
        lowest = triangles[..., 2].min()
        came = numpy.array([grains[tag] for tag in new])
        gap += list(numpy.min([closest_on_triangle(came[:, 2:5], *t)[1] for t in triangles], axis=0) - came[:, 0])
    fact("clear of a wall that wear has moved", len(gap) > 20 and lowest < -0.1 and -1e-9 < min(gap) < 0.05,
         f"{len(gap)} {lowest} {min(gap)}")


# Ghosts of atoms across the corner, where new atoms come in LAMMPS's arrays.
MARKED = lmp.head("-3 3 -3 3 -3 3", "p p p") + END + '''\
fix             prop all property/atom {properties} ghost yes
create_atoms    1 single 2.9 2.9 -2.8
create_atoms    1 single -2.9 -2.9 -2.8
set             group all diameter 0.1 density 1
{marks}
comm_modify     cutoff 1
timestep        0.001
region          up block -2 2 -2 2 1 2
fix             in all insert/lsdcd region up number 3 diam one 0.05 dens 1 {words}
dump            d all custom 3 grains id {columns}
run             3
'''


def test_properties(folder):
    """Values of fix property/atom, of which LAMMPS sets none for new atoms, are those of no ghost."""
    marks = "\n".join(f"set atom {k} mol {6 + k} charge 0.5 i_mark {4 + k} d_level 2.5" for k in (1, 2))
    text = MARKED.format(properties="mol q i_mark d_level", marks=marks, words="", columns="mol q i_mark d_level")
    for ranks in (1, 2):
        lmp.run_well(text, folder, ranks)
        grains = last(lmp.read_dump(folder / "grains"))
        fact(f"inserted grains have none, {ranks} ranks", len(grains) == 5 and all(
            list(grains[k]) == [0, 0, 0, 0] for k in (3, 4, 5)), str(grains))


@lmp.of_host
def test_temperature(folder):
    """Grains come with the temperature that is given, and it has to be."""
    marks = "set group all temperature 350"
    for words, said in (("", "give that of the grains by 'temperature T'"), ("temperature 290", "")):
        text = MARKED.format(properties="temperature heatflow", marks=marks + "\ncompute t all property/atom temperature heatflow", words=words,
                             columns="c_t[1] c_t[2]")
        if said:
            lmp.refused("without it", text, folder, said)
            continue
        lmp.run_well(text, folder, 2)
        grains = last(lmp.read_dump(folder / "grains"))
        fact("inserted grains have it", [grains[k][0] for k in (1, 3, 4, 5)] == [350, 290, 290, 290] and grains[3][1] == 0, str(grains))
    lmp.refused("of atoms that have none", MARKED.format(properties="mol", marks="", words="temperature 290", columns="mol"), folder,
                "'temperature' is given, and atoms have none")


def test_timestep(folder):
    """The rate is one per time in a run without setup, too, whose timestep is another one."""
    text = lmp.head("0 4 0 4 0 4", "f f f") + END + """timestep 0.001
region          a block 0 4 0 4 0 4
fix             in all insert/lsdcd region a numberrate 1000 diam one 0.1 dens 1
run             50
timestep        0.01
run             20 pre {}
print           "inserted $(f_in[1])"
"""
    for setup in ("yes", "no"):
        said = lmp.run_well(text.format(setup), folder)
        fact(f"pre {setup}: grains of 0.05 + 0.2 of time", "\ninserted 250\n" in said, said[-300:])
        fact(f"pre {setup}: the second run tells its own", said.count("grains of mass") == 2, said[-2000:])


def test_ids_of_gone_grains(folder):
    """No grain gets the ID of one that has gone, so that files of passages tell them apart; nor after a restart."""
    stl.write(folder / "gate.stl", [t[::-1] for t in stl.square(2, 1)])
    begin = lmp.head("-2 2 -2 2 0 4") + "create_atoms 1 single 1.9 1.9 3.9\nset group all diameter 0.1 density 1\n"
    fixes = END + """timestep 0.01
region          top block -1 1 -1 1 2 3
fix             in all insert/lsdcd region top numberrate 2 diam one 0.1 dens 1 vel 0 0 -5
fix             out all massflow/lsdcd mesh gate.stl delete yes file rows.txt
"""
    def ids():
        return [row[2] for row in lmp.read_rows(folder / "rows.txt")]
    lmp.run_well(begin + fixes + "run 400\n", folder)
    whole = ids()
    fact("each has an ID of its own", len(whole) > 5 and whole == list(range(2, 2 + len(whole))), str(whole))
    lmp.run_well(begin + fixes + "run 200\nwrite_restart half\n", folder)
    lmp.run_well("atom_modify map array\nread_restart half\ncomm_modify vel yes\n" + fixes + "run 200\n", folder)
    fact("and goes on after a restart", ids() == whole, str(ids()))


@pytest.mark.skipif(lmp.ON_KOKKOS, reason="there is no respa with Kokkos")
def test_levels_of_respa(folder):
    """Grains that come in a step of respa have no force yet, though an atom that was pushed has left its place to them."""
    text = lmp.head("0 4 0 4 0 4", "f f f") + "create_atoms 1 single 2 2 0.1\nset group all diameter 0.1 density 1\ngroup first id 1\n" + END + """timestep 0.001
fix             push first addforce 0 0 -5
fix             pull all gravity 10 vector 0 0 -1
region          top block 0 4 0 4 3 4
fix             in all insert/lsdcd region top numberrate 50 diam one 0.1 dens 1 vel 0 0 -1
thermo_modify   lost ignore
{}
dump            d all custom 1 grains id vz
dump_modify     d sort id format float %.17g
run             60
"""
    v = []
    for style in ("", *(f"run_style respa {levels}\nfix_modify push respa 1" for levels in ("2 2 pair 2", "3 2 2 pair 1"))):
        lmp.run_well(text.format(style), folder)
        v.append(last(lmp.read_dump(folder / "grains")))
    fact("the pushed atom has gone, and grains have come", sorted(v[0]) == [1, 2, 3], str(v[0]))
    for levels in v[1:]:
        at_most("velocities are those without levels", max(abs(levels[k][0] - v[0][k][0]) for k in v[0]), 1e-13)


def test_seeds(folder):
    """Two fixes draw the same numbers where they have one seed, and then the later one warns."""
    text = lmp.head("0 4 0 4 0 4", "f f f") + END + """timestep 0.001
region          a block 0 4 0 4 0 4
fix             one all insert/lsdcd region a number 50 diam one 0.1 dens 1 jitter 1 {}
fix             two all insert/lsdcd region a number 50 diam one 0.1 dens 1 jitter 1 {}
dump            d all custom 1 grains id vx vy vz
run             1
"""
    for seeds, same in ((("", ""), True), (("seed 5", "seed 5"), True), (("", "seed 5"), False)):
        said = lmp.run_well(text.format(*seeds), folder)
        v = last(lmp.read_dump(folder / "grains"))
        fact(f"{seeds}: velocities are {'those' if same else 'others'}", len(v) == 100 and same == all(v[k] == v[50 + k] for k in range(1, 51)))
        fact(f"{seeds}: {'warned' if same else 'not warned'}", same == ("Fix two insert/lsdcd: fix one has the same seed" in " ".join(said.split())))


@lmp.of_kokkos
def test_kokkos(folder):
    """Beside wall/lsdcd/kk and without Kokkos in the same LAMMPS. Grains keep clear of a cube that moves, and are put
    across a plane at z = 0.3, which must push them at once."""
    stl.write(folder / "cube.stl", stl.box((-1,) * 3, (1,) * 3))
    stl.write(folder / "plane.stl", stl.square(2, 0.3))
    soft = WALL.replace("100", "1")    # nothing is thrown out
    text = VESSEL + f"fix shown all wall/lsdcd {soft} mesh cube.stl motion linear 0.5 0 0\n" + \
        f"fix hidden all wall/lsdcd {soft} mesh plane.stl contacts\n" + FILL + "wall shown\n" + \
        DUMP.replace("vz\n", "vz f_hidden[7]\n").format(1) + "run 40\n"

    def grains_of(script, *args, **words):
        lmp.run_well(script, folder, *args, **words)
        steps = lmp.read_dump(folder / "grains")
        del steps[0]    # without grains
        return steps

    plain = grains_of(text, flags=())
    for ranks in (1, 2):
        kokkos = grains_of(text.replace("wall/lsdcd", "wall/lsdcd/kk"), ranks)
        # Kokkos's integrator may round in its own way: 1e-16 a step.
        at_most(f"the same grains on {ranks} ranks with Kokkos", lmp.largest_difference(plain, kokkos), 1e-13)
    seen, fresh, wrong = set(), 0, []
    for step, grains in kokkos.items():
        for i, g in grains.items():
            touches = abs(g[4] - 0.3) < g[0]
            fresh += touches and i not in seen
            wrong += [(step, i)] * (touches != (g[8] > 0))
        seen.update(grains)
    fact("a grain is felt by a wall in the step in which it comes", fresh > 10 and not wrong,
         f"{fresh} {wrong[:3]}")


def test_debt(folder):
    """A region with room for few grains: what finds no place stays due, and comes when there is room."""
    fill = "fix in all insert/lsdcd region fill number 40 diam one 0.9 dens 1 {}\n"
    row = 'print "row $(f_in[1]) $(f_in[2]) $(f_in[3]) $(f_in[4])"\n'
    more = f"run 100\n{row}group gone region half\ndelete_atoms group gone compress no\nrun 200\n{row}"
    text = VESSEL + "region half block INF INF INF INF INF 0 units box\n"
    out = lmp.run_well(text + fill.format("vel 0.02 0.01 0 attempts 100") + more, folder)
    rows = [[float(w) for w in line.split()[1:]] for line in out.split("\n") if line.startswith("row ")]
    one = math.pi / 6 * 0.9 ** 3
    fact("inserted and owed are what is due", len(rows) == 2 and rows[0][2] > 5 and all(
        row[0] + row[2] == 40 and abs(row[1] + row[3] - 40 * one) < 1e-3 for row in rows), str(rows))
    fact("what was owed comes when there is room", rows[1][0] > rows[0][0], str(rows))
    fact("the log says why", "21 grains of mass 8.01577 are due and have found no place; of " in out and " met grains" in out and
         re.search(r"at the end, \d+ grains of mass \S+ are due and have found no place", out) is not None)
    fill = fill.replace("one 0.9", "range 0.6 0.9")
    lmp.run_well(text + fill.format("attempts 3") + DUMP.format(100) + "run 100\n", folder)
    whole = last(lmp.read_dump(folder / "grains"))
    lmp.run_well(text + fill.format("attempts 3") + "run 33\nwrite_restart owed.restart\n", folder)
    lmp.run_well(lmp.head() + "read_restart owed.restart\n" + END + VESSEL.split(END)[1] + fill.format("attempts 3") +
                 DUMP.format(100) + "run 67\n", folder, 2)
    fact("a restart with owed grains gives the same", last(lmp.read_dump(folder / "grains")) == whole and
         len(whole) < 40, str(len(whole)))


def rotation(q):
    """Matrix of a quaternion w x y z, whose columns are the axes of the grain."""
    w, x, y, z = q
    return numpy.array([[1 - 2*(y*y + z*z), 2*(x*y - z*w), 2*(x*z + y*w)], [2*(x*y + z*w), 1 - 2*(x*x + z*z), 2*(y*z - x*w)],
                        [2*(x*z - y*w), 2*(y*z + x*w), 1 - 2*(x*x + y*y)]])


def least_gap(grains):
    """Of ellipsoids, rows of half-axes, quaternion and centre: the least distance of two, from below. Between two grains that do not
    overlap is a plane; n.(difference of the centres) - h(n) - h(n), with h(n) = |A n| the support function, says how far they are off
    it. Steps go towards the nearest difference of their points (Gilbert 1966)."""
    half, at = grains[:, :3], grains[:, 7:10]
    turn = numpy.array([rotation(q) for q in grains[:, 3:7]])
    square = numpy.einsum("nik,nk,njk->nij", turn, half**2, turn)    # h(n)^2 = n.square n
    reach, cells = 2 * half.max(), {}
    for i, key in enumerate(map(tuple, numpy.floor(at / reach).astype(int))):
        cells.setdefault(key, []).append(i)
    pairs = [(i, j) for key, here in cells.items() for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
             for j in cells.get((key[0] + dx, key[1] + dy, key[2] + dz), ()) for i in here if i < j and
             math.dist(at[i], at[j]) < max(half[i]) + max(half[j])]
    a, b = numpy.array(pairs).T
    between, least = at[b] - at[a], numpy.full(len(a), -numpy.inf)
    nearest = between.copy()
    left = numpy.arange(len(a))
    for _ in range(20000):
        n = nearest[left] / numpy.linalg.norm(nearest[left], axis=1)[:, None]
        corner = between[left]
        for of in (a, b):
            across = numpy.einsum("nij,nj->ni", square[of[left]], n)
            corner = corner - across / numpy.sqrt((n * across).sum(1))[:, None]
        least[left] = numpy.maximum(least[left], (corner * n).sum(1))
        side = corner - nearest[left]
        nearest[left] += numpy.clip(-(nearest[left] * side).sum(1) / (side**2).sum(1), 0, 1)[:, None] * side
        left = left[least[left] < -1e-7 * reach]
        if not len(left):
            break
    return least.min() / reach, len(pairs)


SHAPES = lmp.head("0 12 0 12 {}", "p p f", style="ellipsoid") + lmp.pairs("zero 0.5", 0.1) + \
    "fix             move all nve/asphere\ntimestep        0.01\n"
OF_SHAPES = "dump            d all custom {} grains id c_g[*] mass x y z vz\ndump_modify     d sort id format float %.17g\n"
COMPUTE = "compute         g all property/atom shapex shapey shapez quatw quati quatj quatk\n"
TABLETS = "shape 0.3 0.3 0.16 spread 0.8 1.2 massfraction 0.6 shape 0.5 0.2 0.2 massfraction 0.4"


def shapes_of(dump):
    """Rows of the last step: half-axes, quaternion, centre, mass, vz."""
    return numpy.array([[*(x / 2 for x in g[:3]), *g[3:7], *g[8:11], g[7], g[11]] for g in last(dump).values()])


@pytest.mark.skipif(lmp.ON_KOKKOS, reason="ellipsoids come on a CPU alone")
def test_shapes(folder):
    """Grains of two shapes rain through a flat region, at a rate of mass: the amount, their shapes, clear of each other, on
    processes and over a restart."""
    rate, n_steps = 40, 150 if lmp.QUICK else 600
    text = SHAPES.format("-60 3") + "region          rain block 0 12 0 12 1 2\n{}" + COMPUTE + \
        "fix             in all insert/lsdcd region rain " + TABLETS + f" dens 2 massrate {rate} vel 0 0 -5\n" + OF_SHAPES.format(n_steps)
    out = lmp.run_well(text.format("") + f"thermo_style custom step f_in[1] f_in[2] f_in[3]\nrun {n_steps}\n", folder)
    there = lmp.read_dump(folder / "grains")
    grains = shapes_of(there)
    rod = grains[:, 0] / grains[:, 1] > 2
    volume = 4 / 3 * math.pi * grains[:, :3].prod(1)
    at_most("masses are those of ellipsoids", abs(grains[:, 10] / (2 * volume) - 1).max(), 1e-12)
    # A sum of 12 digits in the table, and of grains each of which waits for all of its mass.
    behind = rate * n_steps * 0.01 - grains[:, 10].sum()
    fact("what is in is the rate times the time to within a grain", -1e-9 < behind < grains[:, 10].max(), str(behind))
    fact("none is late", lmp.read_thermo(out)[-1][3] == 0)
    factor = grains[~rod, 0] / 0.15
    fact("tablets have their proportions and sizes", abs(grains[~rod, 2] / grains[~rod, 0] - 0.16 / 0.3).max() < 1e-12 and
         0.8 <= factor.min() < 0.81 and 1.19 < factor.max() <= 1.2)
    # The numbers are binomial, with shares of the mass over the mean masses; the mean cube of the factor is (0.8 + 1.2) (0.8^2 + 1.2^2) / 4.
    shares = numpy.array([0.6 / (0.3 * 0.3 * 0.16 * 1.04), 0.4 / (0.5 * 0.2 * 0.2)])
    share, n = shares[1] / shares.sum(), len(grains)
    at_most("shapes have their shares of the mass, in standard deviations", abs(rod.sum() - n * share) / math.sqrt(n * share * (1 - share)), 4.5)
    gap, pairs = least_gap(grains)
    fact("none overlaps another one", gap >= -1e-6 and pairs > 500, f"{gap} of {pairs} pairs, {n} grains")
    lmp.run_well(text.format("") + f"run {n_steps}\n", folder, 4)
    fact("the same grains, with the same IDs, on 4 ranks", lmp.read_dump(folder / "grains") == there)
    lmp.run_well(text.format("") + f"run {n_steps // 3}\nwrite_restart shapes.restart\n", folder)
    again = re.sub("region +box.*\n.*\n", "read_restart shapes.restart\n", text.format(""))
    lmp.run_well(again + f"run {n_steps - n_steps // 3}\n", folder, 2)
    fact("after a restart the same, to the last bit", last(lmp.read_dump(folder / "grains")) == last(there))


@pytest.mark.skipif(lmp.ON_KOKKOS, reason="ellipsoids come on a CPU alone")
def test_shapes_fill(folder):
    """Tablets that are given one turn fill a box between walls: clear of the walls, nearer than the spheres around them."""
    stl.write(folder / "cube.stl", stl.box((1, 1, 1), (3, 3, 3)))
    text = SHAPES.format("0 12") + f"fix wall all wall/lsdcd {WALL} mesh cube.stl\nregion fill block 1 3 1 3 1 3\n" + COMPUTE + \
        "fix in all insert/lsdcd region fill shape 0.6 0.6 0.32 orient 1 0 0 90 dens 1 number 25\n" + OF_SHAPES.format(1) + "run 1\n"
    lmp.run_well(text, folder)
    grains = shapes_of(lmp.read_dump(folder / "grains"))
    # Their least axis is along y.
    reach = numpy.array([0.3, 0.16, 0.3])
    off = numpy.minimum(grains[:, 7:10] - 1, 3 - grains[:, 7:10]) - reach
    fact("clear of the walls by their shape", len(grains) == 25 and -1e-9 < off.min() and off[:, 1].min() < 0.1, f"{len(grains)} {off.min(0)}")
    at_most("turned as given", abs(abs(grains[:, 3:7] @ [math.sqrt(0.5), math.sqrt(0.5), 0, 0]) - 1).max(), 1e-12)
    gap, pairs = least_gap(grains)
    fact("clear of each other", gap >= -1e-6 and pairs > 15, f"{gap} {pairs}")


@pytest.mark.skipif(lmp.ON_KOKKOS, reason="ellipsoids come on a CPU alone")
def test_shapes_that_touch_as_spheres(folder):
    """In a style that is also of spheres a grain has the diameter of the sphere of its volume, and is clear of others by that, too."""
    text = SHAPES.format("0 12").replace("style      ellipsoid", "style      hybrid sphere ellipsoid") + "region fill block 1 3 1 3 1 3\n" + \
        COMPUTE.replace("quatk", "quatk radius") + "fix in all insert/lsdcd region fill shape 0.6 0.6 0.32 dens 1 number 40\n" + \
        "dump d all custom 1 grains id c_g[8] x y z\ndump_modify d format float %.17g\nrun 1\n"
    lmp.run_well(text, folder)
    grains = list(last(lmp.read_dump(folder / "grains")).values())
    at_most("the radius", max(abs(g[0] - (0.3 * 0.3 * 0.16)**(1 / 3)) for g in grains), 1e-14)
    near = min(math.dist(a[1:], b[1:]) for i, a in enumerate(grains) for b in grains[:i]) - 2 * grains[0][0]
    fact("spheres do not overlap", len(grains) == 40 and near >= 0, str(near))


STREAM = """\
fix             move all nve/sphere
pair_style      zero 0.3
pair_coeff      * *
timestep        0.01
region          v block -2 2 -2 2 0 2 units box
fix             in all insert/lsdcd region v dens 2 {}
"""


def test_other_plan(folder):
    """After 2 time units with 20 grains, or 40, a restart with other words or other steps; then 1 time unit, which brings
    20 grains at the rate of 20."""
    one = math.pi / 6 * 0.2 ** 3 * 2
    grains, small = "diam one 0.2", "diam one 0.1"    # of an eighth of the mass
    text, wanted = "", []
    for name, words, cases in (
            ("a total of 20", f"{grains} numberrate 20 number 20", (
                ("60", f"{grains} numberrate 20 number 60", "", 40), ("none", f"{grains} numberrate 20", "", 40),
                ("30", f"{grains} numberrate 20 number 30", "", 30), ("10", f"{grains} numberrate 20 number 10", "", 20),
                ("60 by mass", f"{grains} massrate {20 * one} number 60", "", 40))),
            ("a mass of 20.5 grains", f"{grains} massrate {20 * one} mass {20.5 * one}", (
                ("that mass in small grains", f"{small} massrate {20 * one} mass {20.5 * one}", "", 24),)),
            ("no total", f"{grains} numberrate 20", (
                ("no total", f"{grains} numberrate 20", "", 60),
                ("no total, from step 0", f"{grains} numberrate 20", "reset_timestep 0", 60),
                ("no total, from step 10000", f"{grains} numberrate 20", "reset_timestep 10000", 60)))):
        text += "clear\n" + lmp.head("-3 3 -3 3 -20 3") + STREAM.format(words) + "run 200\nwrite_restart other.restart\n"
        for other, new_words, before, count in cases:
            text += f"clear\nread_restart other.restart\n{before}\n{STREAM.format(new_words)}run 100\n" + \
                'print "row $(f_in[1]) $(f_in[3])"\n'
            wanted.append((f"{name}, after a restart {other}", count))
    out = lmp.run_well(text, folder)
    rows = [line.split()[1:] for line in out.split("\n") if line.startswith("row ")]
    fact("all restarts run", len(rows) == len(wanted), f"{len(rows)} of {len(wanted)}")
    for (name, count), row in zip(wanted, rows):
        fact(name, [float(w) for w in row] == [count, 0], f"{row}, {count}")
    fact("a total below what is in is warned of", "20 grains of mass 0.167552 have been inserted, which is more than the total "
         "of this fix: it inserts no more" in out)


def test_recovers(folder):
    """What is in the inlet at the start keeps grains out for ten steps. They come when it is gone, at a rate that is
    a third of what the inlet takes; above that the log has a remedy."""
    stl.write(folder / "unit.stl", stl.quad((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)))
    spots = "".join(f"create_atoms 1 single {x} {y} 0 units box\n" for x in (0.2, 0.5, 0.8) for y in (0.2, 0.5, 0.8)) + \
        "set group all diameter 0.29 density 2\nvelocity all set 0 0 -5\n"
    text = lmp.head("-1 2 -1 2 -60 2") + spots + END + "timestep 0.01\n" + \
        "fix in all insert/lsdcd mesh unit.stl numberrate {} diam one 0.2 dens 2 vel normal 5\nthermo 10\n" + \
        "thermo_style custom step f_in[1] f_in[3]\nthermo_modify norm no\n"
    rows = lmp.read_thermo(lmp.run_well(text.format(150) + DUMP.format(200) + "run 200\n", folder))
    fact("a fast inlet recovers from grains without a place", len(rows) == 21 and
         all(row[1:] == [1.5 * row[0], 0] for row in rows[2:]), str(rows[2:4] + rows[-1:]))
    there = lmp.read_dump(folder / "grains")
    fact("none overlaps", not overlaps(last(there)))
    for ranks in (2, 4):
        lmp.run_well(text.format(150) + DUMP.format(200) + "run 200\n", folder, ranks)
        fact(f"the same grains, with the same IDs, on {ranks} ranks", lmp.read_dump(folder / "grains") == there)
    wall = f"fix wall all wall/lsdcd {WALL} mesh unit.stl\n"
    out = lmp.run_well(text.format(1500) + "run 30\nclear\n" + text.replace(spots, "").format(150) +
                       wall.replace("unit.stl", "unit.stl motion linear 0 0 -1e-9") + "run 3\n", folder)
    fact("where the rate is too high the log says so", " grains. Grains are in the way, because they leave more slowly "
         "than the rate brings others: give a larger mesh, more depth, a higher velocity or a smaller rate. A little can "
         "also be gained by more attempts than " in out)
    fact("where a wall that moves is in the way, too",
         "Walls are in the way: move the mesh away from them, or name by wall ID" in out)
    fails = lmp.run(text.replace(spots, "").format(150) + wall + "run 3\n", folder, 2)
    fact("a grain that fits nowhere beside a wall at rest is an error", fails.returncode != 0 and
         "of 100000 places on unit.stl none is clear of the walls for a grain of diameter 0.2, even without other grains, "
         "so it would hold back all that come after it: give smaller grains in 'diam'" in fails.stdout)


def test_huge(folder):
    """1e9 grains are due at once, of which some 2000 have room, in 1.5 GB of addresses."""
    text = lmp.head("-3 3 -3 3 -20 3") + STREAM.format("number 1000000000 diam one 0.2") + 'run 3\nprint "row $(f_in[1]+f_in[3]) $(f_in[1])"\n'
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (1536000000, before[1]))
    out = lmp.run(text, folder).stdout
    resource.setrlimit(resource.RLIMIT_AS, before)
    row = [line.split()[1:] for line in out.split("\n") if line.startswith("row ")]
    fact("a huge amount needs no huge memory", row and row[0][0] == "1000000000" and float(row[0][1]) > 1000, str(row))
    fact("what does not fit in is told with a remedy", "They do not fit in: give a larger region, fewer or smaller grains, "
         "or more attempts than 1000 for each grain" in out)


def test_ends(folder):
    """The fix comes and goes with the one that tells its radius."""
    again = INLET.replace("fix in ", "fix two ").replace("seed 11", "seed 12")
    out = lmp.run_well(FACE + INLET + again + "run 100\ninfo fixes\nunfix in\nrun 10\n" + INLET + "run 100\ninfo fixes\n"
                       "plugin unload fix insert/lsdcd\ninfo fixes\nrun 10\n", folder)
    counts = [part.split("Loop time")[0].count("= pour") for part in out.split("Fix information:")[1:]]
    fact("it leaves nothing behind", counts == [2, 2, 0], str(counts))


@lmp.of_kokkos
def test_kokkos_named_in_full(folder):
    """A fix whose style is written with /kk is taken up from a restart file by the one without."""
    text = "suffix off\n" + lmp.head("0 1 0 1 0 1", style="sphere/kk", units="si") + lmp.pairs("zero 0.06", skin=0.01) + """\
region          in block 0.2 0.8 0.2 0.8 0.2 0.8 units box
run_style       verlet/kk
fix             move all nve/sphere/kk
fix             in all insert/lsdcdFORM region in diam one 0.05 dens 1000 numberrate 500 number 80
timestep        1e-3
thermo_style    custom step atoms
"""
    lmp.run_well(text.replace("FORM", "/kk") + "run 100\nwrite_restart grains.restart\n", folder)
    again = re.sub("region +box.*\n.*\n", "read_restart grains.restart\n", text)
    output = lmp.run_well(again.replace("FORM", "") + "run 100\n", folder)
    fact("taken up", "Unused restart file" not in output, output[-600:])
    fact("no more than 80 are inserted", lmp.read_thermo(output)[-1][1] == 80, str(lmp.read_thermo(output)))
