#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Measure where LIGGGHTS and fix wall/lsdcd differ for the same words: one sphere, one wall, one number each.

Prints the numbers of doc/from-liggghts.md.
"""
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from converter.geometry import read_stl        # noqa: E402
from make_meshes import write_text             # noqa: E402
from runs import environment, options, print_table    # noqa: E402
from stl import quad                           # noqa: E402

R, SIDE = 0.01, 0.18    # of the sphere, of the floor
MASS = 2500 * 4 / 3 * math.pi * R ** 3

COMMON = """\
units           si
atom_style      {style}
atom_modify     map array
boundary        f f f
newton          off
{ghosts}
region          box block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box
create_box      1 box
create_atoms    1 single {at} units box
set             group all diameter {d} density 2500
neighbor        0.005 bin
neigh_modify    delay 0
timestep        1e-5
fix             move all nve/sphere
"""
THEIRS = """\
fix             m1 all property/global youngsModulus peratomtype 1e7
fix             m2 all property/global poissonsRatio peratomtype 0.3
fix             m3 all property/global coefficientRestitution peratomtypepair 1 0.7
fix             m4 all property/global coefficientFriction peratomtypepair 1 0.5
fix             m5 all property/global characteristicVelocity scalar 2
fix             m6 all property/global k_finnie peratomtypepair 1 1e-10
pair_style      gran model {normal} tangential history
pair_coeff      * *
"""


class Programs:
    def __init__(self, a):
        self.a = a

    def run(self, program, text):
        script = self.a.work / "in.trap"
        script.write_text(text)
        with environment() as env:
            done = subprocess.run([program, "-in", script.name, "-log", "none"], cwd=self.a.work, env=env, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        found = re.findall(r"^TRAP (.+)$", done.stdout, re.M)
        if done.returncode or not found:
            raise SystemExit(text + done.stdout[-2000:])
        return [float(w) for w in found[-1].split()]

    def theirs(self, at, walls, end, normal="hertz", d=2 * R):
        start = COMMON.format(style="granular", ghosts="communicate single vel yes", at=at, d=d)
        wall = f"fix wall all wall/gran model {normal} tangential history mesh "
        return self.run("liggghts", start + THEIRS.format(normal=normal) + walls.replace("WALL", wall) + end)

    def ours(self, at, wall, end, d=2 * R):
        start = COMMON.format(style="sphere", ghosts="comm_modify vel yes", at=at, d=d)
        return self.run(Path(self.a.lmp).resolve(), start + "pair_style zero 0.05\npair_coeff * *\n" + wall + end)


LAW = "granular hertz/material 1e7 0.7 0.3 tangential mindlin_slip NULL 0.9075 0.5 damping "
EXACT = LAW + "coeff_restitution"
DROP = "velocity all set 0 0 -1\nrun 3000\nvariable v equal vcm(all,z)\nprint \"TRAP ${v}\"\n"
ONE_MESH = "fix m all mesh/surface file FILE type 1\nWALL n_meshes 1 meshes m\n"


def rebound(p):
    """Of a sphere that hits a floor at 1 m/s."""
    at = "0.013 0.007 0.012"
    rows = [("coefficientRestitution 0.7: rebound", p.theirs(at, ONE_MESH.replace("FILE", "floor.stl"), DROP)[0],
             "damping coeff_restitution", p.ours(at, f"fix w all wall/lsdcd {EXACT} mesh floor.stl\n", DROP)[0])]
    for words in ("tsuji", "viscoelastic"):
        rows.append(("", None, f"damping {words}", p.ours(at, f"fix w all wall/lsdcd {LAW}{words} mesh floor.stl\n", DROP)[0]))
    return rows


def finnie(p):
    """Volume of one impact at 45 degrees, per K and energy of the sphere."""
    at, hit = "0.03 -0.03 0.012", "velocity all set 1 0 -1\nrun 3000\n"
    p.theirs(at, "fix m all mesh/surface/stress file floor.stl type 1 wear finnie\nWALL n_meshes 1 meshes m\n",
             "dump d all mesh/vtk 3000 wear*.vtk wear\n" + hit + "print \"TRAP 0\"\n")
    text = (p.a.work / "wear3000.vtk").read_text()
    depth = [float(x) for x in re.search(r"^wear 1 2 double\n(.*)", text, re.M)[1].split()]
    ours = p.ours(at, f"fix w all wall/lsdcd {EXACT} wear finnie 1e-10 mesh floor.stl\n",
                  hit + "variable v equal f_w[10]\nprint \"TRAP $(v_v:%.17g)\"\n")[0]
    unit = 1e-10 * MASS * 2 / 2
    return [("wear finnie, K = 1e-10: volume / (K m v^2 / 2)", sum(depth) * SIDE * SIDE / 2 / unit, "wear finnie 1e-10",
             ours / unit)]


def belt(p):
    """Speed that a sphere gains on a belt of 5 m/s, on which it falls at 1 m/s and slips to the end."""
    at, end = "-0.05 0.007 0.0102", "velocity all set 0 0 -1\nrun 1200\nvariable v equal vcm(all,x)\nprint \"TRAP ${v}\"\n"
    there = p.theirs(at, ONE_MESH.replace("FILE type 1", "floor.stl type 1 surface_vel 5 0 0"), end)[0]
    rows = []
    for model in ("mindlin_slip", "mindlin"):
        law = EXACT.replace("mindlin_slip", model)
        rows.append(("speed that a sphere gains on a belt, m/s", there, f"tangential {model}",
                     p.ours(at, f"fix w all wall/lsdcd {law} mesh floor.stl surface_vel 5 0 0\n", end)[0]))
    return rows


def hooke(p):
    """Force over overlap of spheres at rest."""
    rows = []
    for d in (2 * R, 4 * R):
        overlap = 0.01 * d / 2
        at = f"0.013 0.007 {d / 2 - overlap}"
        t = p.theirs(at, ONE_MESH.replace("FILE", "floor.stl"), FORCE, "hooke", d)[0] / overlap
        rows.append((f"model hooke: stiffness for a diameter of {d:g} m, N/m", t, "", None))
    return rows


FORCE = ("compute f all reduce sum fz\nthermo_style custom step c_f\nrun 0\nvariable f equal c_f\n"
         "print \"TRAP ${f}\"\n")


def seams(p):
    """Force of a sphere at rest over a seam, divided by that over the middle of a face."""
    rows, overlap = [], 0.01 * R
    flat = f"0.00 0.00 {R - overlap}"

    def forces(at, there, here):
        return p.theirs(at, there, FORCE)[0], p.ours(at, f"fix w all wall/lsdcd {EXACT} {here}\n", FORCE)[0]

    one = forces("0.013 0.007" + flat[9:], ONE_MESH.replace("FILE", "floor.stl"), "mesh floor.stl")
    slope = math.radians(2.5)
    fold = f"0 0.007 {(R - overlap) / math.cos(slope)}"
    two = ("fix m all mesh/surface file left.stl type 1\nfix n all mesh/surface file right.stl type 1\n"
           "WALL n_meshes 2 meshes m n\n")
    for what, at, there, here in (
            ("one flat mesh, over an edge", flat, ONE_MESH.replace("FILE", "floor.stl"), "mesh floor.stl"),
            ("one flat mesh, over a T-junction", flat, ONE_MESH.replace("FILE", "tee.stl"), "mesh tee.stl"),
            ("two flat meshes, over the seam between them", flat, two, "mesh left.stl mesh right.stl"),
            ("a fold of 5 degrees, over its edge", fold, ONE_MESH.replace("FILE", "fold.stl"), "mesh fold.stl"),
            ("the same with curvature 6", fold, ONE_MESH.replace("FILE type 1", "fold.stl type 1 curvature 6"), "mesh fold.stl")):
        t, o = forces(at, there, here)
        rows.append((f"{what}: force / force on a face", t / one[0], here.replace(" mesh", ", mesh"), o / one[1]))
    return rows


def motions(p):
    """Where the corner (0, 0, 0) of a mesh is after a quarter of a turn about z, which also goes 0.05 m along x."""
    rows = []
    turn = "rotate origin 0. 0. 0. axis 0. 0. 1. period 0.04", "rotate 0 0 0 0 0 1 0.04"
    go = "linear 5. 0. 0.", "linear 5 0 0"
    for first, second, names in ((turn, go, "rotate, then linear"), (go, turn, "linear, then rotate")):
        p.theirs("-0.05 -0.05 0.05", ONE_MESH.replace("FILE", "corner.stl") + f"fix a all move/mesh mesh m {first[0]}\n"
                 f"fix b all move/mesh mesh m {second[0]}\n", "dump d all mesh/stl 1000 where*.stl\nrun 1000\nprint \"TRAP 0\"\n")
        there = re.findall(r"vertex (\S+) (\S+)", (p.a.work / "where1000.stl").read_text())[0]
        p.ours("-0.05 -0.05 0.05", f"fix w all wall/lsdcd {EXACT} mesh corner.stl motion {first[1]} motion {second[1]} "
               "mesh_stl here*.stl every 1000\n", "run 1000\nprint \"TRAP 0\"\n")
        here = read_stl(p.a.work / "here1000.stl")[0][0]
        for axis in range(2):
            rows.append((f"{names}: {'xy'[axis]}, m", float(there[axis]), "motion, motion in the same order", here[axis]))
    return rows


def measure(p):
    for part in (rebound, belt, finnie, hooke, seams, motions):
        yield from part(p)


def write_meshes(folder):
    h, rise = SIDE / 2, SIDE / 2 * math.tan(math.radians(2.5))
    left, right = [quad((x0, -h, 0), (x1, -h, 0), (x1, h, 0), (x0, h, 0)) for x0, x1 in ((-h, 0), (0, h))]
    halves = quad((0, -h, 0), (h, -h, 0), (h, 0, 0), (0, 0, 0)) + quad((0, 0, 0), (h, 0, 0), (h, h, 0), (0, h, 0))
    for name, triangles in (
            ("floor", quad((-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0))), ("left", left), ("right", right),
            ("tee", left + halves), ("corner", [((0, 0, 0), (0.01, 0, 0), (0, 0.01, 0))]),
            ("fold", quad((0, -h, 0), (h, -h, rise), (h, h, rise), (0, h, 0)) +
             quad((-h, -h, rise), (0, -h, 0), (0, h, 0), (-h, h, rise)))):
        write_text(folder / f"{name}.stl", triangles)


def main():
    p = options(__doc__, HERE)
    a = p.parse_args()
    if not shutil.which("liggghts"):
        print("SKIPPED: LIGGGHTS (not installed; Debian's package is liggghts)")
        sys.exit(77)
    a.work.mkdir(parents=True, exist_ok=True)
    write_meshes(a.work)
    print_table(["what", "LIGGGHTS 3.8", "words here", "fix wall/lsdcd"],
                [[what, "" if there is None else f"{there:.4g}", words, "" if here is None else f"{here:.4g}"]
                 for what, there, words, here in measure(Programs(a))])


if __name__ == "__main__":
    main()
