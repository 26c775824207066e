# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A wall by the words of the fix: the same words make the same wall in a script and in the library, to the last bit of forces; values of the
program in words; meshes placed by a matrix; values that are refused. test_wrong_words has words that are. LSDCD_WALLS says how many random walls there are (20)."""
import os
import random
import re
import subprocess

import numpy as np
import pytest

import lsdcd
from facts import fact

LMP = os.environ.get("LSDCD_LMP", "")
needs_lmp = pytest.mark.skipif(not os.path.exists(LMP), reason="no lmp-lsdcd (LSDCD_LMP)")
WALLS = int(os.environ.get("LSDCD_WALLS", "20"))
STEPS, DT = 12, 1e-3

FLOOR = (np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0.0]]), [[0, 1, 2], [0, 2, 3]])
# A closed block, whose top is just below z = 0, so that it may be a body.
BLOCK = (np.array([[x, y, z] for z in (-1, -0.015625) for y in (-2, 2.0) for x in (-2, 2.0)]),
         [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]])
MESHES = {"floor": FLOOR, "block": BLOCK}

# Spheres of radius 0.5 and mass 1 that nothing moves: the wall comes to them.
X = np.array([[0.3, 0.2, 0.484375], [1.5, -1, 0.46875], [-1.25, 0.75, 0.5]])
V, OMEGA = np.array([[0.25, 0.5, -0.125]] * 3), np.array([[0.5, -0.25, 1]] * 3)

LAWS = ("hooke 1000 300 20 10 0.5 1", "hooke/history 1000 300 20 NULL 0.5 1", "hertz/history 2000 600 20 10 0.3 1",
        "granular hooke 1000 20 tangential linear_history 300 1 0.4 damping velocity",
        "granular hertz/material 2000 0.5 0.3 tangential mindlin NULL 1 0.5 damping tsuji rolling sds 100 1 0.1 twisting marshall limit_damping",
        "granular hertz 2000 20 tangential mindlin_rescale 1500 1 0.5 damping mass_velocity",
        "granular dmt 2000 20 0.3 5 tangential linear_nohistory 1 0.5")
MOTIONS = ("motion linear 0.1 -0.2 0.3", "motion wiggle 0 0.01 0.02 0.5", "motion rotate 0 0 0 0 1 0.25 3", "wiggle z 0.01 0.5",
           "motion transrot 0 0 0.1 1 0 0 0 1 0 5 motion linear 0.01 0 0", "motion riggle 0 0 0 0 0 1 5 2",
           "motion table lever.txt axis 1 0 0 0 1 0 repeat", "servo force z 25 vmax 0.5 limits -0.1 0.2", "servo torque y through 0 0 0 3 vmax 2",
           "surface_vel 1 0 0.5 surface_angvel 0 0 0.5 1 2 0", "shear x 0.5", "scale 1.25", "rotate 0 0.1 1 30 move 0 0 0.01", "torque_about 1 2 3",
           "law types 2* ", "")
BODIES = ("body density 2 joint hinge 0 0 0 0 1 0 motor 0.5", "body mass 3 com 0 0 0 inertia 2 2.5 3 0 0 0.1 velocity 0 0 0.5 omega 0.1 0.2 0",
          "body density 1 joint slider 0 0 1 spring 100 1 limits -0.5 0.5 load 0 0 3", "body density 1 joint ball 0 0 0 moment 0.1 0 0")
OF_WALL = ("corner sum", "grid 0.5", "rmax 0.75", "energy", "impacts 1e-3", "average 3", "wear archard 1e-3 1e3", "wear finnie 1e-6")


def random_words(pick):
    """Words of a wall of one to three meshes. Laws of types have the sub-models of the wall, with other numbers."""
    law = pick.choice(LAWS)
    words = [law]
    for k in range(pick.randint(1, 3)):
        file = pick.choice(list(MESHES))
        words += [f"mesh {file}.stl", f"name part{k}"]
        if file == "block" and pick.random() < 0.5:
            words.append(pick.choice(BODIES))
            continue
        motion = pick.choice(MOTIONS)
        words.append(motion + law.replace("1000 ", "1500 ").replace("2000 ", "2500 ").replace(" limit_damping", "") if motion.startswith("law") else motion)
    some = pick.sample(OF_WALL, pick.randint(0, 4))
    return " ".join(words + some)


def is_a_wall(words):
    """Whether its words are: one mesh is not twice at one place, nothing wears by two laws."""
    try:
        lsdcd.Wall.check(words)
    except lsdcd.Error:
        return False
    return True


def forces_by_library(words, values=None, **named):
    wall, n = lsdcd.Wall(words, values=values, **named), len(X)
    force, torque = np.zeros((n, 3)), np.zeros((n, 3))
    for k in range(STEPS + 1):
        force[:] = torque[:] = 0
        wall.step(X, V, OMEGA, np.full(n, 0.5), np.ones(n), force, torque, DT, setup=k == 0, type=np.array([1, 2, 1], np.int32))
    return np.hstack([force, torque])


def write_meshes(folder):
    for name, (vertices, faces) in MESHES.items():
        with open(os.path.join(folder, f"{name}.stl"), "w", encoding="ascii") as f:
            f.write("solid mesh\n")
            for face in faces:
                f.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.17g %.17g %.17g\n" % tuple(vertices[k]) for k in face) + "endloop\nendfacet\n")
            f.write("endsolid mesh\n")
    with open(os.path.join(folder, "lever.txt"), "w", encoding="ascii") as f:
        f.write("0 0\n0.5 0.3\n1 0\n")


BEGIN = """clear
units si
atom_style sphere
atom_modify map yes sort 0 0
boundary f f f
region box block -10 10 -10 10 -10 10
create_box 2 box
""" + "".join(f"create_atoms {t} single {' '.join(map(repr, x.tolist()))} units box\n" for t, x in zip((1, 2, 1), X)) + f"""\
set group all diameter 1
set group all mass 1
set group all omega {' '.join(map(str, OMEGA[0]))}
velocity all set {' '.join(map(str, V[0]))}
pair_style zero 1.1
pair_coeff * *
comm_modify vel yes
timestep {DT}
"""


def run(folder, script):
    with open(os.path.join(folder, "in.script"), "w", encoding="utf-8") as f:
        f.write(script)
    return subprocess.run([LMP, "-in", "in.script", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


@needs_lmp
def test_random_walls(folder, monkeypatch):
    """The same words in LAMMPS, in the library with files, and in the library with meshes of the program."""
    pick = random.Random(4711)
    walls = [words for words in (random_words(pick) for _ in range(2 * WALLS)) if is_a_wall(words)][:WALLS]
    write_meshes(folder)
    done = run(folder, "".join(f"{BEGIN}fix wall all wall/lsdcd {words} device cpu\nrun {STEPS}\n"
                               f"write_dump all custom {k}.dump id fx fy fz tqx tqy tqz modify sort id format float %.17g\n"
                               for k, words in enumerate(walls)))
    assert done.returncode == 0, done.stdout[-3000:]
    monkeypatch.chdir(folder)
    values = {name: lsdcd.Mesh(*mesh) for name, mesh in MESHES.items()} | {"lever": [[0, 0], [0.5, 0.3], [1, 0]]}
    for k, words in enumerate(walls):
        wanted = np.loadtxt(f"{k}.dump", skiprows=9, ndmin=2)[:, 1:]
        found = forces_by_library(words)
        fact(f"wall {k}: the bits of the script", (found == wanted).all(), (words, found - wanted))
        with_values = re.sub(r"(mesh|table) (\w+)[.](stl|txt)", r"\1 $\2", words)
        used = {name: value for name, value in values.items() if f"${name}" in with_values}
        found = forces_by_library(with_values, used)
        fact(f"wall {k}: with values of the program", (found == wanted).all(), (with_values, found - wanted))
    fact("forces act", sum(np.loadtxt(f"{k}.dump", skiprows=9)[:, 3].any() for k in range(len(walls))) > len(walls) / 2 > WALLS / 3)


STYLE = "hooke/history 1000 300 20 NULL 0.5 1"


PLACEMENTS = (    # the same place by words and by a matrix
    ("floor.stl scale 2 rotate 0 0 1 90 move 0.5 0 0.25", "floor.stl matrix 0 -2 0 0.5 2 0 0 0 0 0 2 0.25", 0),
    ("block.stl scale -1 1 1 side out", "block.stl matrix -1 0 0 0 0 1 0 0 0 0 1 0 side out", 0),    # a mirror
    ("floor.stl move 0 0 0.125 scale 1 1 2 rotate 1 0 0 180 move 0 0 0.375", "floor.stl move 0 0 0.125 matrix 1 0 0 0 0 1 0 0 0 0 2 0 rotate 1 0 0 180 move 0 0 0.375", 0),
    ("block.stl rotate 1 2 3 40 scale 1.5 move 0 0 0.1", "block.stl matrix $turned scale 1.5 move 0 0 0.1", 1e-10))


def rotation(axis, degrees):
    """By Rodrigues' formula, with 0 behind each row."""
    k, angle = np.array(axis) / np.linalg.norm(axis), np.radians(degrees)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.hstack([np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross, np.zeros((3, 1))])


@needs_lmp
def test_matrix(folder, monkeypatch):
    """A mesh is where words, a matrix in words and a matrix of the program put it, in a script and in the library. Rotations that round are off by some bits
    of a coordinate of 8, so that forces of a stiffness of 2000, and damping forces that turn by so much, are within 1e-10."""
    write_meshes(folder)
    turned = rotation((1, 2, 3), 40)
    in_words = " ".join("%.17g" % number for number in turned.ravel())
    walls = [f"{STYLE} mesh {words.replace('$turned', in_words)}" for pair in PLACEMENTS for words in pair[:2]]
    done = run(folder, "".join(f"{BEGIN}fix wall all wall/lsdcd {words}\nrun {STEPS}\n"
                               f"write_dump all custom {k}.dump id fx fy fz tqx tqy tqz modify sort id format float %.17g\n" for k, words in enumerate(walls)))
    assert done.returncode == 0, done.stdout[-3000:]
    monkeypatch.chdir(folder)
    for k, words in enumerate(walls):
        wanted = np.loadtxt(f"{k}.dump", skiprows=9, ndmin=2)[:, 1:]
        fact(f"wall {k}: the bits of the script", (forces_by_library(words) == wanted).all() and wanted.any(), words)
    for by_words, by_matrix, tolerance in PLACEMENTS:
        wanted = forces_by_library(f"{STYLE} mesh {by_words}")
        for value in (turned, turned.ravel().tolist()):
            found = forces_by_library(f"{STYLE} mesh {by_matrix}", {"turned": value} if "$turned" in by_matrix else None)
            fact(f"{by_matrix}: as by {by_words}", abs(found - wanted).max() <= tolerance, abs(found - wanted).max())


@needs_lmp
@pytest.mark.parametrize("words, says", (("motion caller", "in 'motion', caller is for a program that calls the library"), ("shapes", "'shapes' is not a keyword here")))
def test_words_of_programs_alone(folder, words, says):
    write_meshes(folder)
    done = run(folder, f"{BEGIN}fix wall all wall/lsdcd {STYLE} mesh floor.stl {words}\n")
    fact("a script is told", done.returncode != 0 and f"ERROR: Fix wall wall/lsdcd: {says}" in done.stdout, done.stdout[-400:])


MESH = lsdcd.Mesh(*FLOOR)


def test_a_word_of_programs_behind_a_material():
    for words in ("glass on aluminium shapes mesh $floor", "glass shapes mesh $floor material aluminium"):
        lsdcd.Wall.check(f"granular material glass.lsdcd {words}", floor=MESH)


@pytest.mark.parametrize("words, values, says", (
    (f"{STYLE} mesh $flor", {"floor": MESH}, r"'\$flor': there is no value of this name: the nearest is 'floor'"),
    (f"{STYLE} mesh $floor", {"floor": MESH, "lid": MESH}, r"the value 'lid' is given, and no word is \$lid"),
    (f"{STYLE} mesh x$floor", {"floor": MESH}, r"'x\$floor': \$NAME is a word of its own"),
    (f"{STYLE} mesh $floor", {"floor": [[0, 0], [1, 1]]}, r"in 'mesh', \$floor is no mesh: make one of the numbers"),
    (f"{STYLE} mesh $floor", {"floor": [1, 2, 3]}, r"in 'mesh', \$floor is numbers: make a mesh of them"),
    ("hooke/history $law mesh $floor", {"floor": MESH, "law": [1000, 500, 20, None, 0.5]}, r"not 'mesh' \(behind \$law, number 5\)"),
    ("hooke/history $law", {"law": [1000, 500, 20, None]}, r"is missing \(behind \$law, number 4\)"),
    (f"{STYLE} mesh $floor motoin linear 0 0 1", {"floor": MESH}, "'motoin' is not a keyword; the nearest is 'motion'$"),
    (f"{STYLE} mesh floor.stl cache $floor", {"floor": MESH}, r"'\$floor' is a mesh or rows, which stand behind 'mesh', 'motion table' or 'matrix' alone"),
    (f"{STYLE} mesh $floor weld 0.1", {"floor": MESH}, r"in 'weld', the mesh \$floor was welded when it was made"),
    (f"{STYLE} mesh $floor motion table $floor", {"floor": MESH}, r"in 'motion', \$floor has no rows"),
    (f"{STYLE} mesh $floor motion table $rows", {"floor": MESH, "rows": [[0, 0, 0, 0], [0, 1, 1, 1]]}, r"in 'motion', row 2 of \$rows: .*times must ascend"),
    (f"{STYLE} mesh $floor nodes group", {"floor": MESH}, "in 'nodes', a program has no groups of atoms: write nodes caller"),
    (f"{STYLE} mesh $floor contacts", {"floor": MESH}, "'contacts' is a keyword of scripts: write each_contact"),
    (f"{STYLE} mesh $floor shapes shapes", {"floor": MESH}, "in 'shapes', the keyword is given twice"),
    (f"{STYLE} mesh $floor motion caller motion linear 0 0 1", {"floor": MESH}, "in 'motion', the poses of the program alone move such a mesh"),
    (f"{STYLE} mesh $floor mesh_stl $file every 5", {"floor": MESH, "file": "a.obj"}, "a.obj"),
    (f"{STYLE} mesh floor", {"floor": MESH}, r"no word is \$floor: a value stands behind a \$, and 'floor' is none"),
    (f"{STYLE} mesh $floor mesh $floor move 0 0 1", {"floor": MESH}, "same name 'floor': give one of them another by the keyword name"),
    (f"{STYLE} mesh $floor mesh $floor name lid", {"floor": MESH}, "in 'mesh', of mesh 2 'lid': it is that of mesh 1 'floor' at the same place"),
    ("hooke/history $law mesh $floor", {"floor": MESH, "law": []}, "the value 'law' has no numbers"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": np.eye(4)}, r"in 'matrix', \$m has 4 rows of 4 numbers: give three rows of four"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": np.eye(3)}, r"in 'matrix', \$m has 3 rows of 3 numbers: give three rows of four"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": np.eye(4).ravel()}, r"in 'matrix', the number '0' \(\$m, number 13\) is one more than expected: "
     "a matrix has three rows of four"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": np.eye(3).ravel()}, "in 'matrix', the value of m32 is missing"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": [[1, 2, 3, 4], [2, 4, 6, 8], [0, 0, 1, 0]]},
     "in 'matrix', the determinant of the rows 1 2 3, 2 4 6, 0 0 1 is 0, so that it would make the mesh flat: give three rows that lie in no plane"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": [1, 0, 0, None, 0, 1, 0, 0, 0, 0, 1, 0]}, r"tx must be a number, not 'NULL' \(\$m, number 4\)"),
    (f"{STYLE} mesh $floor matrix $m", {"floor": MESH, "m": [[1, 0, 0, None], [0, 1, 0, 0], [0, 0, 1, 0]]}, "the value 'm': number 4 is nan, not finite"),
    (f"{STYLE} mesh $floor matrix $floor", {"floor": MESH}, r"m11 must be a number, not '\$floor'"),
    (f"{STYLE} mesh $floor scale $s", {"floor": MESH, "s": [1, 2, 3, 4]}, r"'4' \(\$s, number 4\) is not a keyword"),
    (f"{STYLE} mesh $floor corner $s", {"floor": MESH, "s": 3}, "'3' is not one of its values"),
    (f"{STYLE} mesh $floor motion $s", {"floor": MESH, "s": 3}, r"Syntax: motion caller \| linear Vx Vy Vz"),
    (f"{STYLE} mesh $floor nodes", {"floor": MESH}, "Syntax: nodes caller"), (f"{STYLE} mesh $floor node", {"floor": MESH}, "the nearest is 'nodes caller'"),
    ("hooke/history $law mesh $floor", {"floor": MESH, "law": [1000, float("inf"), 20, None, 0.5, 1]}, "the value 'law': number 2 is inf, not finite")))
def test_values_refused(words, values, says):
    with pytest.raises(lsdcd.Error, match=says):
        lsdcd.Wall(words, values=values)


def test_value_with_the_name_of_an_argument():
    """It is an argument where it is not in `values`, and the error says so."""
    words = f"{STYLE} mesh $floor motion linear 0 0 $time"
    says = r"'\$time': there is no value of this name.*; 'time' is an argument of Wall\(\), so that its value goes into `values`: values={'time': ...}"
    with pytest.raises(lsdcd.Error, match=says) as refused:
        lsdcd.Wall(words, floor=MESH, time=2)
    fact("with the code", refused.value.code == "argument")
    wall = lsdcd.Wall(words, floor=MESH, values={"time": 2})
    with pytest.raises(lsdcd.Error, match=r"'units' is an argument of Wall.check\(\), so that"):
        lsdcd.Wall.check(words.replace("time", "units"), floor=MESH, units="si")
    with pytest.raises(lsdcd.Error, match=r"'values' is an argument of Wall.change\(\), so that"):
        wall.change("motion linear 0 0 $values")
    with pytest.raises(lsdcd.Error) as refused:
        lsdcd.Wall(words.replace("time", "tame"), floor=MESH)
    fact("of another name it does not", "argument" not in str(refused.value), refused.value)


def test_values_of_python(folder):
    """Numbers of numpy's types, NULL, text with blanks, words over lines; a mesh is called by its value."""
    law = np.array([1000, 300, 20, np.nan, 0.5, 1], np.float32)
    by_text = forces_by_library(f"{STYLE} mesh $floor", floor=MESH)
    by_value = forces_by_library("""hooke/history $law    # numbers
                                 mesh $floor &
                                 mesh_stl $file every 1000""", floor=MESH, law=law.tolist(), file=str(folder / "a file.stl"))
    fact("the same", (by_text == by_value).all() and by_text[:, 2].any(), by_text - by_value)
    fact("as float32", (forces_by_library("hooke/history $law mesh $floor", floor=MESH, law=law) == by_text).all())
    for law in ({"kn": 1}, True, 10**400, ["a"]):
        with pytest.raises(TypeError, match="law is .*: give a Mesh, numbers"):
            lsdcd.Wall("hooke $law mesh $floor", floor=MESH, law=law)
    with pytest.raises(ValueError, match="mesh is 'flor': no mesh is called 'flor': the nearest is 'floor'"):
        lsdcd.Wall(f"{STYLE} mesh $floor", floor=MESH).pose("flor")


def test_inputs_and_changes():
    """v_NAME is what set_input() says, in each step; a step before that is refused; words of fix_modify change a mesh."""
    wall, n = lsdcd.Wall(f"{STYLE} mesh $floor surface_vel v_speed 0 0 mesh $lid move 0 0 5", floor=MESH, lid=MESH), len(X)
    force, torque = np.zeros((n, 3)), np.zeros((n, 3))

    def step():
        force[:] = torque[:] = 0
        wall.step(X, V, OMEGA, np.full(n, 0.5), np.ones(n), force, torque, DT)
        return force.copy()
    with pytest.raises(lsdcd.Error, match="v_speed has no value"):
        step()
    with pytest.raises(lsdcd.Error, match="the wall reads no v_sped: the nearest is 'speed'"):
        wall.set_input("sped", 1)
    with pytest.raises(lsdcd.Error, match="the wall reads no v_v_speed: the name is without v_"):
        wall.set_input("v_speed", 1)
    wall.set_input("speed", 3)
    by_input = step()
    fact("as the number", (by_input == forces_of_one_step(f"{STYLE} mesh $floor surface_vel 3 0 0")).all(), by_input)
    wall.set_input("speed", -3)
    fact("another one in the next step", step()[0, 0] < by_input[0, 0])
    wall.change("mesh lid motion linear 0 0 -1")
    for _ in range(10):
        step()
    fact("the lid moves", abs(wall.pose("lid")[2, 3] + 10 * DT) < 1e-15, wall.pose("lid"))
    for words, says in (("mesh ild motion none", "not 'ild': the nearest is 'lid'"), ("", "nothing is given to change"),
                        ("mesh lid motion linear 0 0", "in 'motion'"), ("corner sum", "'corner' is not expected: write"),
                        ("motion none", "which of the 2 meshes. Write mesh NAME motion"), ("mesh 1 motion none", "NAME is the name of a mesh, not '1'"),
                        ("mesh lid names", "motion ..., servo ..., or body ... must follow, not 'names'"),
                        ("mesh lid motion caller", "say motion caller when the wall is made"),
                        ("mesh lid motion none servo none", "'servo' is not expected behind the change")):
        with pytest.raises(lsdcd.Error, match=says):
            wall.change(words)
    before = wall.pose("lid")[2, 3]
    step()
    fact("a change that was refused has not stopped it", wall.pose("lid")[2, 3] < before)


def test_inputs_of_changes():
    """An input is there where the change is, and no step asks for one that nothing reads any more."""
    wall, n = lsdcd.Wall(f"{STYLE} mesh $floor nodes caller mesh $lid move 0 0 5", floor=MESH, lid=MESH), len(X)
    with pytest.raises(lsdcd.Error):
        wall.change("mesh floor servo force z v_push vmax 1")
    with pytest.raises(lsdcd.Error, match="the wall reads no v_push"):
        wall.set_input("push", 1)
    wall.change("mesh lid servo force z v_push vmax 1")
    wall.set_input("push", -1)
    wall.change("mesh lid servo force z v_other vmax 1")
    arrays = [X, V, OMEGA, np.full(n, 0.5), np.ones(n), np.zeros((n, 3)), np.zeros((n, 3))]
    with pytest.raises(lsdcd.Error, match="v_other has no value"):
        wall.step(*arrays, DT)
    wall.change("mesh lid servo none")
    wall.step(*arrays, DT)
    fact("the servo is gone", wall.outputs("servo_push", "lid")["servo_push"] == 0)


def test_numbers_that_a_wall_does_not_have():
    wall = lsdcd.Wall(f"{STYLE} mesh $floor", floor=MESH)
    for name, keyword in (("servo_push", "servo"), ("dissipated_slider", "energy"), ("impacts", "impacts")):
        with pytest.raises(lsdcd.Error, match=rf"there is no number '{name}': the wall needs '{keyword}' for it"):
            wall.outputs(name)


def forces_of_one_step(words):
    wall, n = lsdcd.Wall(words, floor=MESH), len(X)
    force, torque = np.zeros((n, 3)), np.zeros((n, 3))
    wall.step(X, V, OMEGA, np.full(n, 0.5), np.ones(n), force, torque, DT)
    return force


def test_nodes_of_a_file(folder, monkeypatch):
    """Of a mesh by its file nodes are the vertices of the welded mesh: forces on them are those of the same mesh as a value."""
    write_meshes(folder)
    monkeypatch.chdir(folder)
    rows = []
    for words, named in ((f"{STYLE} mesh floor.stl name floor nodes caller", {}), (f"{STYLE} mesh $floor nodes caller", {"floor": MESH})):
        wall, n = lsdcd.Wall(words, values=named), len(X)
        force, torque, nodes = np.zeros((n, 3)), np.zeros((n, 3)), wall.nodes("floor")
        wall.set_nodes("floor", nodes + (0, 0, 0.01))
        wall.step(X, V, OMEGA, np.full(n, 0.5), np.ones(n), force, torque, DT)
        of_nodes = wall.node_forces("floor")
        rows.append(np.hstack([nodes, of_nodes])[np.lexsort(nodes.T)])
    fact("the same nodes and forces", rows[0].shape == (4, 6) and (rows[0] == rows[1]).all() and rows[0][:, 5].any(), rows)


def test_saved_with_inputs():
    """A wall whose input has another name is not the same."""
    saved = lsdcd.Wall(f"{STYLE} mesh $floor surface_vel v_speed 0 0", floor=MESH).save()
    lsdcd.Wall(f"{STYLE} mesh $floor surface_vel v_speed 0 0", floor=MESH).restore(saved)
    with pytest.raises(lsdcd.Error, match="inputs of surface, pressure and temperature of meshes.0. is v_other .* and was v_speed"):
        lsdcd.Wall(f"{STYLE} mesh $floor surface_vel v_other 0 0", floor=MESH).restore(saved)
