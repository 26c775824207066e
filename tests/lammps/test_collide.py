# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""compute lsdcd/collide: cubes of four atoms, driven by fix move and fix rigid, through a floor of one
large triangle. How many of a cube's 12 triangles have corners on both sides of the floor's plane is
counted from the atoms as they are dumped, by a linear map in place of the compute's rotation.
"""
import math

import pytest

import lmp
from facts import fact
import numpy as np
import stl
from triangles import turn

HALF = 0.5    # of a cube
CUBE = np.array(stl.box((-HALF,) * 3, (HALF,) * 3))
CORNERS = 0.3 * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])    # its atoms
FLOOR = [[(-40, -40, 0), (40, -40, 0), (0, 60, 0)]]

SETTINGS = lmp.head(comm="vel yes cutoff 2.5")
FORCES = """\
pair_style      zero 0.5
pair_coeff      * *
neighbor        0.3 bin
timestep        0.01
group           dust id 1
group           cubes subtract all dust
"""
THERMO = """\
thermo          5
thermo_style    custom step c_c c_c[1] c_c[2] c_c[3] {more}
dump            atoms cubes custom 5 atoms id xu yu zu
dump_modify     atoms format float %.17g sort id
"""
RIGID = "fix go cubes rigid/nve molecule"
RIGID_SMALL = "fix go cubes rigid/nve/small molecule"
OF_RIGID = () if lmp.ON_HOST else (RIGID, RIGID_SMALL)    # which other hosts have not
# Axes off the bodies' centres, so that these swing as they turn.
BY_MOVE = "".join(f"group one{k} molecule {k}\nfix go{k} one{k} move rotate {words}\n" for k, words in
                  ((1, "-3 1.6 1 1 0.2 0.1 2.1"), (2, "0.5 -1 0.6 0.3 1 0 1.7"), (3, "2 -0.3 0.4 0 1 0.3 2.9")))
STEP, COLLIDING, PAIRS, BODIES, UNCERTAIN, FIRST = range(6)


def write_data(path, cubes, box=6.0):
    """An atom that no mesh jumps over, and cubes: (centre, turn, velocity, angular velocity), a molecule each."""
    atoms, velocities, molecules = ["1 1 0.8 1.0 5.5 5.5 5.5"], ["1 0 0 0 0 0 0"], ["1 0"]
    for molecule, (centre, r, v, w) in enumerate(cubes, 1):
        for corner in CORNERS:
            off = r @ corner
            x, u, number = np.array(centre) + off, np.array(v) + np.cross(w, off), len(atoms) + 1
            atoms.append("{} 1 0.2 1.0 {!r} {!r} {!r}".format(number, *map(float, x)))
            molecules.append(f"{number} {molecule}")
            velocities.append("{} {!r} {!r} {!r} 0 0 0".format(number, *map(float, u)))
    with open(path, "w") as data:
        data.write(f"cubes\n\n{len(atoms)} atoms\n1 atom types\n" +
                   "".join(f"{-box} {box} {d}lo {d}hi\n" for d in "xyz") +
                   "\nAtoms # sphere\n\n" + "\n".join(atoms) +
                   "\n\nVelocities\n\n" + "\n".join(velocities) +
                   "\n\nMolecules\n\n" + "\n".join(molecules) + "\n")


def pairs_of(atoms, normal, through):
    """Triangles of one cube with corners on both sides of a plane."""
    x = np.array(atoms)
    centre = x.mean(axis=0)
    matrix = (x - centre).T @ np.linalg.pinv(CORNERS.T)
    height = (CUBE @ matrix.T + centre - through) @ normal
    assert np.abs(height).min() > 1e-9, "a corner is on the plane: choose other numbers"
    return int(((height.min(axis=1) < 0) & (height.max(axis=1) > 0)).sum())


def compare(name, folder, text, plane, ranks, cubes):
    """Each row of the last run against the dump; plane(time): normal and a point."""
    rows = {int(r[STEP]): r for r in lmp.read_thermo(lmp.run_well(text, folder, ranks))}
    steps, wrong, seen = lmp.read_dump(folder / "atoms"), [], set()
    for step, atoms in steps.items():
        normal, through = plane(0.01 * step)
        each = [pairs_of([atoms[2 + 4 * k + i] for i in range(4)], normal, through) for k in range(cubes)]
        expected = [step, sum(n > 0 for n in each), sum(each), cubes, 0, *each]
        if step not in rows or rows[step][:len(expected)] != expected:
            wrong.append((expected, rows.get(step)))
        seen.update(each)
    fact(f"{name}, {ranks} rank{'s' * (ranks > 1)}",
         not wrong and len(steps) > 10 and 0 in seen and len(seen) > 2, str(wrong[:2]))
    return rows


WALL = "fix wall dust wall/lsdcd hooke 1e4 NULL 20 0 0 0 mesh floor.stl"


def begin(boundary="f f f"):
    return SETTINGS.replace("f f f", boundary) + f"fix mol all property/atom mol ghost yes\nread_data cubes.data fix mol NULL Molecules\n" + FORCES


def prepare(folder):
    stl.write(folder / "floor.stl", FLOOR)


RANKS = pytest.mark.parametrize("ranks", (1, 3))


@RANKS
def test_moved(folder, ranks):
    """One body that fix move swings about an axis; its mesh is where the atoms are at first."""
    tilt = turn([1, 2, 3], 0.7)
    write_data(folder / "cubes.data", [([0.3, -0.2, 1.9], tilt, [0, 0, 0], [0, 0, 0])])
    stl.write(folder / "tilted.stl", CUBE @ tilt.T + [0.3, -0.2, 1.9])
    text = begin() + WALL + """
fix             go cubes move rotate 0.3 2.3 1.9 1 0.2 0 5.3
compute         c cubes lsdcd/collide wall mesh tilted.stl
""" + THERMO.format(more="c_c[1][2]") + "fix avg all ave/time 5 1 5 c_c c_c[1] file avg.txt\nrun 400\n"
    rows = compare("a body that fix move drives through the floor", folder, text,
                   lambda t: (np.array([0, 0, 1.0]), np.zeros(3)), ranks, 1)
    lines = [list(map(float, line.split())) for line in (folder / "avg.txt").read_text().split("\n")
             if line and not line.startswith("#")]
    fact("fix ave/time reads it", len(lines) == len(rows) and
         all(row[1:] == rows[int(row[0])][COLLIDING:PAIRS + 1] for row in lines))


def three_cubes():
    """They spin and fall, one through the box's face; not turned at first, where the mesh is."""
    return [([-3, 0.1, 1.5], np.eye(3), [0.0, 0.0, -0.7], [1.0, 2.0, 0.5]),
            ([0, 0.2, 0.9], turn([1, 1, 0], 1.0), [0.1, 0.0, -0.3], [0.0, -3.0, 1.0]),
            ([3, -0.3, 1.2], turn([0, 1, 2], 2.0), [1.0, 0.0, -0.5], [2.0, 0.0, 0.0])]


@RANKS
@pytest.mark.parametrize("drive", (BY_MOVE, *OF_RIGID))
def test_three(folder, ranks, drive):
    write_data(folder / "cubes.data", three_cubes())
    stl.write(folder / "cube.stl", CUBE)
    text = begin("p p f") + WALL + f"""
{drive}
compute         c cubes lsdcd/collide wall mesh cube.stl move -3 0.1 1.5 bodies molecule grid 0.4 log brief
""" + THERMO.format(more="c_c[1][2] c_c[2][2] c_c[3][2] c_c[3][1]") + "run 300\n"
    rows = compare(f"three bodies, {drive.splitlines()[-1].split(' ', 2)[2][:24]}", folder, text,
                   lambda t: (np.array([0, 0, 1.0]), np.zeros(3)), ranks, 3)
    fact("rows have molecules", all(row[FIRST + 3] == 3 for row in rows.values()))


@RANKS
def test_moving_wall(folder, ranks):
    """The floor turns about y, then sinks as well."""
    write_data(folder / "cubes.data", three_cubes())
    stl.write(folder / "cube.stl", CUBE)
    drive = BY_MOVE if lmp.ON_HOST else RIGID
    text = begin() + WALL + f""" motion rotate 0 0 0 0 1 0 8 motion linear 0 0 -0.2
{drive}
compute         c cubes lsdcd/collide wall mesh cube.stl move -3 0.1 1.5 bodies molecule grid 0.4
""" + THERMO.format(more="c_c[1][2] c_c[2][2] c_c[3][2]") + "run 200\n"
    compare("bodies and a wall that moves", folder, text,
            lambda t: (turn([0, 1, 0], 2 * math.pi * t / 8) @ [0, 0, 1.0], np.array([0, 0, -0.2 * t])), ranks, 3)


@RANKS
def test_read_as_a_step_begins(folder, ranks):
    """Outputs are of the whole step, though the floor's motion reads the compute as the step begins: it rises into a cube at rest."""
    write_data(folder / "cubes.data", [([0.3, -0.2, 0.8], turn([1, 2, 3], 0.7), [0, 0, 0], [0, 0, 0])])
    stl.write(folder / "cube.stl", CUBE @ turn([1, 2, 3], 0.7).T + [0.3, -0.2, 0.8])
    moving = WALL + " motion variable NULL NULL v_z NULL NULL v_vz\n"
    text = begin() + "variable z equal 2*step*dt+0*{reads}\nvariable vz equal 2.0\n" + moving + "compute c cubes lsdcd/collide wall mesh cube.stl\n" + \
        "thermo_style custom step c_c c_c[1] c_c[1][2]\nthermo 1\nrun 60\n"
    rows = [lmp.read_thermo(lmp.run_well(text.replace("{reads}", reads), folder, ranks)) for reads in ("step", "c_c")]
    fact(f"{ranks} ranks: a variable that reads pairs changes no output", rows[0] == rows[1] and len({row[2] for row in rows[0]}) > 3, str(rows[0][::10]))


@RANKS
def test_image(folder, ranks):
    """A plate near the upper face in x meets the image of a body at the lower one; where that face is
    not periodic it meets nothing."""
    write_data(folder / "cubes.data", [([-5.7, 0, 0], np.eye(3), [0, 0, 0], [0, 0, 0])])
    stl.write(folder / "cube.stl", CUBE)
    stl.write(folder / "floor.stl", [[(5.9, -3, -3), (5.9, 3, -3), (5.9, 0, 4)]])
    for boundary, expected in (("p f f", [1, 8]), ("f f f", [0, 0])):
        text = begin(boundary) + WALL + """
compute         c cubes lsdcd/collide wall mesh cube.stl move -5.7 0 0
thermo_style    custom step c_c c_c[1]
run             0
"""
        rows = lmp.read_thermo(lmp.run_well(text, folder, ranks))
        fact(f"an image across a face, {boundary}, {ranks} ranks", rows[-1][1:] == expected, str(rows))
    stl.write(folder / "floor.stl", FLOOR)


def test_several(folder):
    """Pairs of all meshes of a wall; between runs atoms may be put elsewhere."""
    write_data(folder / "cubes.data", [([0, 0, 0.2], np.eye(3), [0, 0, 0], [0, 0, 0])])
    stl.write(folder / "cube.stl", CUBE)
    text = begin() + WALL + """ mesh floor.stl move 0 0 0.4 mesh floor.stl move 0 0 2
compute         c cubes lsdcd/collide wall mesh cube.stl move 0 0 0.2 grid 0.3
thermo_style    custom step c_c c_c[1]
run             0
displace_atoms  cubes move 0 0 1.6
run             0
displace_atoms  cubes move 0 0 2.3
run             0
"""
    done = lmp.run_well(text, folder)
    rows = [line.split() for line in done.split("\n") if line.split()[:1] == ["0"] and len(line.split()) == 3]
    # 4 upright sides of 2 triangles in each of two floors, then in one, then in none.
    fact("several meshes, and runs", [r[1:] for r in rows] == [["1", "16"], ["1", "8"], ["0", "0"]], str(rows))


def test_other_wall(folder):
    """Half of a square, and the half across its diagonal: as many triangles and vertices, the same area and
    bounds. The cube stands in the first one, 4 upright sides of 2 triangles, and clear of the other."""
    a, b, c, d = (-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)
    write_data(folder / "cubes.data", [([-1.5, -1.5, 0.2], np.eye(3), [0, 0, 0], [0, 0, 0])])
    stl.write(folder / "cube.stl", CUBE)
    stl.write(folder / "half.stl", [(a, b, d)])
    stl.write(folder / "other.stl", [(c, d, b)])
    compute = "compute c cubes lsdcd/collide wall mesh cube.stl move -1.5 -1.5 0.2\n"
    first = begin() + WALL.replace("floor", "half") + "\n" + compute + "thermo_style custom step c_c[1]\nrun 0\n"
    again = "unfix wall\n" + WALL.replace("floor", "{}") + "\n"

    def pairs(text):
        return lmp.read_thermo(lmp.run_well(first + text + "run 0\n", folder))[-1][1]

    lmp.refused("a wall with another mesh of the same size", first + again.format("other") + "run 0\n", folder,
                "fix wall has different meshes than when the compute was defined", ranks=2)
    worn = again.format("half").replace("mesh half.stl", "mesh half.stl wear archard 1 50 deform every 10")
    for name, text in (("made again", first + worn), ("from the beginning", first.replace(compute, worn + compute))):
        lmp.refused(f"a wall that wear moves, {name}", text + "run 0\n", folder,
                    "has a mesh that wear moves (deform), and bodies collide with rigid")
    fact("the compute defined again sees that mesh",
         pairs(again.format("other") + "thermo_style one\nuncompute c\n" + compute +
               "thermo_style custom step c_c[1]\n") == 0)
    fact("the same wall made again is the same", pairs(again.format("half")) == 8)


def test_restart(folder):
    """With the places of its atoms in a file a body is found wherever it is: after a restart, too."""
    write_data(folder / "cubes.data", three_cubes())
    stl.write(folder / "cube.stl", CUBE)
    (folder / "atoms.txt").write_text("# where cube.stl is\n" + "".join("{!r} {!r} {!r}\n".format(*map(float, p)) for p in CORNERS))
    after = WALL + """
""" + BY_MOVE.replace("group one", "group two").replace(" one", " two") + """
compute         c cubes lsdcd/collide wall mesh cube.stl bodies molecule grid 0.4 atoms atoms.txt
""" + THERMO.format(more="c_c[1][2] c_c[2][2] c_c[3][2]")
    first = begin("p p f") + after + "run 100\nwrite_restart half.restart\nundump atoms\n"
    told = "assumes that the mesh is where the body of molecule 1 is now, in step 0"
    fact("bodies whose atoms are in a file: now does not matter", told not in lmp.run_well(first, folder))
    here = lmp.run_well(first.replace(" atoms atoms.txt", ""), folder)
    fact("without it the log says what it assumes", here.count(told) == 1)
    rows = compare("bodies whose atoms are in a file", folder, first,
                   lambda t: (np.array([0, 0, 1.0]), np.zeros(3)), 1, 3)
    again = SETTINGS.replace("atom_style      sphere\n", "") + """read_restart half.restart
fix mol all property/atom mol ghost yes
pair_style      zero 0.5
pair_coeff      * *
""" + WALL + """
compute         c cubes lsdcd/collide wall mesh cube.stl bodies molecule grid 0.4 atoms atoms.txt
thermo_style    custom step c_c c_c[1] c_c[2] c_c[3] c_c[1][2] c_c[2][2] c_c[3][2]
run             0
"""
    last = lmp.read_thermo(lmp.run_well(again, folder, 2))
    fact("and where a restart file has them", last == [rows[100]] and rows[100][PAIRS] > 0, str((last, rows[100])))
