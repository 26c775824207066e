#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs three validation cases in LIGGGHTS and Yade, too: at their plane, at a mesh of two triangles and at the slivers, and prints rows as
doc/data/validation_others.tsv has them. Debian's packages are liggghts and yade.

usage: beside_others.py [--keep] [--commit NAME]
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "lammps"), str(HERE.parent.parent / "bench")]

import lmp
import rows as bench_rows
import stl
from cases import CASES
from suite import DATA, PLANE, SLIVERS, STATE, TWO, Setting, placed, slivers, states_of, words, write_floors

KEPT = DATA / "validation_others.tsv"
NAMES = ("hertz-wall", "oblique", "spinning")
COLUMNS_OF_MESH = 150    # LIGGGHTS refuses 200, whose triangles are thinner


class LiggghtsSetting:
    """A wall of a case in LIGGGHTS: what Setting is in LAMMPS. A law is that of hertz_law(), by name."""

    is_mesh = False    # of ours: rows that only ours has are left out

    def __init__(self, wall, folder):
        self.wall, self.folder = wall, folder

    def floor(self, law, half, more=""):
        # The wall's material is type 2; rigid as 1e9 times the grain's modulus.
        rigid = 1e9 * law["young"]
        model = "model hertz tangential " + ("history" if law["friction"] else "off")
        if self.wall == PLANE:
            wall = f"fix wall all wall/gran {model} primitive type 2 zplane 0.0"
        else:
            wall = (f"fix mesh all mesh/surface file {self.wall}.stl type 2 scale {half!r}\n"
                    f"fix wall all wall/gran {model} mesh n_meshes 1 meshes mesh")
        return f"""\
fix m1 all property/global youngsModulus peratomtype {law['young']!r} {rigid!r}
fix m2 all property/global poissonsRatio peratomtype {law['nu']!r} {law['nu']!r}
fix m3 all property/global coefficientRestitution peratomtypepair 2 {' '.join([repr(float(law['e']))] * 4)}
fix m4 all property/global coefficientFriction peratomtypepair 2 {' '.join([repr(float(law['friction']))] * 4)}
pair_style gran {model}
pair_coeff * *
{wall}
"""

    def fly(self, grains, box, fixes, dt, steps, every):
        skin = 0.1 * max(g.radius for g in grains)
        (self.folder / "in.there").write_text(f"""\
units           si
atom_style      granular
atom_modify     map array
boundary        f f f
newton          off
communicate     single vel yes
hard_particles  yes
region          box block {words(box)} units box
create_box      2 box
neighbor        {skin!r} bin
neigh_modify    delay 0 every 1 check yes
{placed(grains, 'omegax {0!r} omegay {1!r} omegaz {2!r}')}{fixes}
fix             move all nve/sphere
timestep        {dt!r}
dump            state all custom {every} state.dump id {' '.join(STATE)}
dump_modify     state sort id format "%d{' %.17g' * len(STATE)}"
run             {steps}
""")
        done = subprocess.run(["liggghts", "-in", "in.there", "-log", "none"], cwd=self.folder, text=True, errors="replace", stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env=lmp.environment())
        if done.returncode:
            raise AssertionError(done.stdout[-2000:])
        return states_of(self.folder)


# What Yade runs: grains that do not meet each other, at a plane or at facets.
YADE = """\
import json
import math
from yade import *
from yade import utils
job = json.load(open("job.json"))
law, out = job["law"], open("states.json", "w")
def material(density):
    return O.materials.append(FrictMat(young=law["young"], poisson=law["nu"], density=density, frictionAngle=math.atan(law["friction"])))
still = material(1.0)
if job["facets"]:
    ids = [O.bodies.append(utils.facet(corners, material=still)) for corners in job["facets"]]
else:
    ids = [O.bodies.append(utils.wall(0, axis=2, material=still))]
grains = []
for x, radius, density, v, spin in job["grains"]:
    grains.append(O.bodies.append(utils.sphere(x, radius, material=material(density))))
    state = O.bodies[grains[-1]].state
    state.vel, state.angVel = v, spin
rows = []
def record():
    rows.append([[*O.bodies[i].state.pos, *O.bodies[i].state.vel, *O.bodies[i].state.angVel, *O.forces.f(i)] for i in grains])
O.dt = job["dt"]
O.engines = [
    ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_MindlinPhys(en=law["e"])],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    # Velocities are those of half a step before.
    PyRunner(command="record()", iterPeriod=job["every"], firstIterRun=job["every"]), NewtonIntegrator(damping=0)]
O.run(job["steps"] + 1, True)
json.dump(rows, out)
out.close()
"""


class YadeSetting:
    """A wall of a case in Yade."""

    is_mesh = False

    def __init__(self, wall, folder):
        self.wall, self.folder = wall, folder

    def floor(self, law, half, more=""):
        # Yade's mean of two shear moduli is right for like materials alone: a rigid wall is one of the grain's with twice the modulus. And it
        # takes a wall for a sphere of the grain's radius, so that R* is R/2 and the modulus for the same force sqrt(2) times that.
        self.law, self.facets = dict(law, young=2 * math.sqrt(2) * law["young"]), []
        if self.wall != PLANE:
            floor = stl.square(1.0) if self.wall == TWO else slivers(COLUMNS_OF_MESH)
            self.facets = [[[half * c for c in p] for p in triangle] for triangle in floor]
        return ""

    def fly(self, grains, box, fixes, dt, steps, every):
        job = dict(law=self.law, facets=self.facets, dt=dt, steps=steps, every=every, grains=[[g.x, g.radius, g.density, g.v, g.spin] for g in grains])
        (self.folder / "job.json").write_text(json.dumps(job))
        (self.folder / "run.py").write_text(YADE)
        done = subprocess.run(["yade", "-n", "-x", "-j1", "run.py"], cwd=self.folder, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode:
            raise AssertionError(done.stdout[-2000:])
        rows = json.loads((self.folder / "states.json").read_text())
        return {every * (k + 1): [dict(zip(STATE, grain)) for grain in row] for k, row in enumerate(rows)}


OTHERS = {"LIGGGHTS": LiggghtsSetting, "Yade": YadeSetting}
WALLS = {"plane": PLANE, "two": TWO, "slivers": SLIVERS}
COLUMNS = ("case", "quantity", "unit", "expected", "tolerance", "LSDCD", *(f"{code}, {wall}" for code in OTHERS for wall in WALLS))


def rows_of(name, folder):
    write_floors(folder)
    stl.write(folder / "slivers.stl", slivers(COLUMNS_OF_MESH))
    seen = {}
    for column, setting in (("LSDCD", Setting(SLIVERS, folder)), *((f"{code}, {word}", there(wall, folder)) for code, there in OTHERS.items() for word, wall in WALLS.items())):
        for s in CASES[name].function(setting):
            row = seen.setdefault(s.quantity, dict(case=CASES[name].title, quantity=s.quantity, unit=s.unit, expected=f"{s.expected:.9g}", tolerance=f"{s.tolerance:.2g}"))
            row[column] = f"{s.seen:.9g}"
    return [row for row in seen.values() if len(row) == len(COLUMNS)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", action="store_true", help="put the rows into doc/data, and the table into doc/validation.md")
    parser.add_argument("--commit", default=bench_rows.commit())
    args = parser.parse_args()
    lines = ["\t".join(COLUMNS)]
    for name in NAMES:
        with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
            lines += ["\t".join(row[c] for c in COLUMNS) for row in rows_of(name, pathlib.Path(folder))]
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if args.keep:
        KEPT.write_text(f"# commit {args.commit}, {bench_rows.cpu()}\n" + text)
        subprocess.run([sys.executable, str(HERE.parent.parent / "bench" / "pages.py")], check=True)


if __name__ == "__main__":
    main()
