# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Two hard cases as curves, beside LIGGGHTS: `./run bench hard-curves`.

*fold*: a sphere goes over a concave fold of 5 degrees, always as deep in the nearest face; its force over that on a face, against the
place of its centre in radii. *bowl*: grains roll in a bowl and in the same bowl cut into other triangles, examples/retriangulated; the
largest distance between the two runs in diameters, against the step. *shift*: the same with one bowl, where the start is moved by
1e-12 m, which is how far round-off grows.
"""
import argparse
import math
import os
import shutil
import subprocess
import sys

import rows
from lammps import bench

EXAMPLES = rows.ROOT / "examples"
sys.path[:0] = [str(EXAMPLES / "retriangulated"), str(EXAMPLES / "from-liggghts")]    # both have a compare.py
import compare    # noqa: E402
import traps      # noqa: E402

OURS, THEIRS = "LSDCD", "LIGGGHTS 3.8"
DEPTH, SLOPE, REACH = 0.01, math.radians(2.5), 0.25    # overlap and farthest place in radii; of each face


def fold(work, count):
    programs = traps.Programs(work)
    traps.write_meshes(work.work)
    flat = f"0.013 0.007 {(1 - DEPTH) * traps.R}"
    wall = f"fix w all wall/lsdcd {traps.EXACT} mesh "
    face = {OURS: programs.ours(flat, wall + "floor.stl\n", traps.FORCE)[0],
            THEIRS: programs.theirs(flat, traps.ONE_MESH.replace("FILE", "floor.stl"), traps.FORCE)[0]}
    for k in range(count):
        x = REACH * (2 * k / (count - 1) - 1)
        at = f"{x * traps.R:.17g} 0.007 {traps.R * ((1 - DEPTH) / math.cos(SLOPE) + abs(x) * math.tan(SLOPE)):.17g}"
        yield "fold", OURS, x, programs.ours(at, wall + "fold.stl\n", traps.FORCE)[0] / face[OURS]
        yield "fold", THEIRS, x, programs.theirs(at, traps.ONE_MESH.replace("FILE", "fold.stl"), traps.FORCE)[0] / face[THEIRS]


def bowl(work):
    subprocess.run([sys.executable, EXAMPLES / "retriangulated" / "make_walls.py", "--out", work.work], check=True, stdout=sys.stderr)
    for name, wall in (("fix wall/lsdcd", OURS), ("LIGGGHTS 3.8", THEIRS)):
        steps, one = compare.places(work, name, "bowl")
        for curve, other in (("bowl", ("recut",)), ("shift", ("bowl", "moved"))):
            apart = compare.apart(one, compare.places(work, name, *other)[1]).max(axis=1)
            yield from ((curve, wall, step, value) for step, value in zip(steps, apart))


def measure(options, folder):
    if not shutil.which("liggghts"):
        raise SystemExit("hard-curves needs LIGGGHTS: Debian's package is liggghts")
    work = argparse.Namespace(lmp=os.path.abspath(options.lmp), work=folder)
    found = [*fold(work, 5 if options.quick else 41), *(() if options.quick else bowl(work))]
    return [{"curve": curve, "wall": wall, "x": f"{x:.6g}", "value": f"{value:.6g}", "commit": options.commit}
            for curve, wall, x, value in found]


if __name__ == "__main__":
    bench("hard-curves", __doc__, measure)
