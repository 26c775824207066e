#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs three validation cases in LIGGGHTS, too: at its plane, at a mesh of two triangles and at the slivers, and prints rows as doc/data/validation_liggghts.tsv
has them. Debian's package is liggghts.

usage: beside_liggghts.py [--keep]
"""
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

KEPT = DATA / "validation_liggghts.tsv"
NAMES = ("hertz-wall", "oblique", "spinning")
COLUMNS_OF_MESH = 150    # LIGGGHTS refuses 200, whose triangles are thinner
COLUMNS = ("case", "quantity", "unit", "expected", "tolerance", "LSDCD", "plane", "two", "slivers")


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


def rows_of(name, folder):
    write_floors(folder)
    stl.write(folder / "slivers.stl", slivers(COLUMNS_OF_MESH))
    seen = {}
    for column, setting in (("LSDCD", Setting(SLIVERS, folder)), *((w.replace(PLANE, "plane"), LiggghtsSetting(w, folder)) for w in (PLANE, TWO, SLIVERS))):
        for s in CASES[name].function(setting):
            row = seen.setdefault(s.quantity, dict(case=CASES[name].title, quantity=s.quantity, unit=s.unit, expected=f"{s.expected:.9g}", tolerance=f"{s.tolerance:.2g}"))
            row[column] = f"{s.seen:.9g}"
    return [row for row in seen.values() if len(row) == len(COLUMNS)]


def main():
    lines = ["\t".join(COLUMNS)]
    with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
        for name in NAMES:
            lines += ["\t".join(row[c] for c in COLUMNS) for row in rows_of(name, pathlib.Path(folder))]
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if "--keep" in sys.argv[1:]:
        KEPT.write_text(f"# commit {bench_rows.commit()}, {bench_rows.cpu()}\n" + text)
        subprocess.run([sys.executable, str(HERE.parent.parent / "bench" / "pages.py")], check=True)


if __name__ == "__main__":
    main()
