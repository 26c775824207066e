# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Hard cases as curves, beside LIGGGHTS or another rule: `./run bench hard-curves`.

*fold*: a sphere goes over a concave fold of 5 degrees, always as deep in the nearest face; its force over that on a face, against the
place of its centre in radii. *bowl*: grains roll in a bowl and in the same bowl cut into other triangles, examples/retriangulated; the
largest distance between the two runs in diameters, against the step. *shift*: the same with one bowl, where the start is moved by
1e-12 m, which is how far round-off grows. *grain*: an ellipsoid of 5:1:1 stands upright in a fold of 20 degrees a side and goes along the
face on which its contact ends, 0.3 of its least radius of curvature deep in it; its force over that on this face alone, against the way to the
end in that radius, beside the rule that shares by what impulses do (doc/notes/corners.md).
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

OURS, THEIRS, IMPULSES = "LSDCD", "LIGGGHTS 3.8", "by impulses"
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


GRAIN = """\
units           lj
atom_style      ellipsoid
atom_modify     map array
boundary        f f f
region          box block -9 9 -9 9 -9 9
create_box      1 box
create_atoms    1 single {x:.17g} 0 {z:.17g}
set             atom 1 mass 1
set             atom 1 shape {width} {width} {length}
pair_style      zero 1
pair_coeff      * *
fix             m all nve/asphere
fix             w all wall/lsdcd hooke 1 NULL 0 NULL 0 0 mesh valley.off
run             0
print           "pushed $(f_w[1]:%.17g) $(f_w[3]:%.17g)" file pushed.txt
"""


def grain(work, count):
    half, angle, deep, reach = (1, 5), math.radians(20), 0.3, 0.5    # half-axes along x and z
    rho, sine, cosine = half[0]**2 / half[1], math.sin(angle), math.cos(angle)
    rise = 9 * math.tan(angle)
    (work.work / "valley.off").write_text(
        "OFF\n6 4 0\n" + "".join(f"{x} {y} {rise * abs(x) / 9:.17g}\n" for y in (-9, 9) for x in (-9, 0, 9)) +
        "3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n")
    # The faces rise to the right and to the left: their support planes touch at (side * at, -low).
    height = math.hypot(half[0] * sine, half[1] * cosine)
    at, low = half[0]**2 * sine / height, half[1]**2 * cosine / height
    ending = deep * rho
    end = -at + ending * sine    # where the foot on the right face is in the fold
    for k in range(count):
        way = reach * (1 - 2 * k / (count - 1))
        x = end + way * rho
        z = (height - ending + sine * x) / cosine
        (work.work / "in.grain").write_text(GRAIN.format(x=x, z=z, width=2 * half[0], length=2 * half[1]))
        subprocess.run([work.lmp, "-in", "in.grain", "-log", "none"], cwd=work.work, check=True, stdout=subprocess.DEVNULL)
        pushed = [float(v) for v in (work.work / "pushed.txt").read_text().split()[1:]]
        yield "grain", OURS, way, math.hypot(*pushed) / ending
        # Of each face: its overlap, if its foot is on it, and its force by the rule for two contacts.
        overlap = {side: height - (cosine * z - side * sine * x) for side in (1, -1)}
        overlap = {side: d for side, d in overlap.items() if d > 0 and side * (x + side * (at - d * sine)) > 0}
        turn = low * sine - at * cosine    # arm x normal, opposite for the two; m/I = 5 / (1 + 25)
        inertia = turn**2 * 5 / (half[0]**2 + half[1]**2)
        like = (cosine**2 - sine**2 - inertia) / (1 + inertia) if len(overlap) == 2 else 0
        like = max(like, 0)
        bears = {side: (d - like * overlap.get(-side, 0)) / (1 - like**2) for side, d in overlap.items()}
        yield "grain", IMPULSES, way, math.hypot(sum(side * l for side, l in bears.items()) * sine, sum(bears.values()) * cosine) / ending


def measure(options, folder):
    if not shutil.which("liggghts"):
        raise SystemExit("hard-curves needs LIGGGHTS: Debian's package is liggghts")
    work = argparse.Namespace(lmp=os.path.abspath(options.lmp), work=folder)
    found = [*fold(work, 5 if options.quick else 41), *grain(work, 6 if options.quick else 82), *(() if options.quick else bowl(work))]
    return [{"curve": curve, "wall": wall, "x": f"{x:.6g}", "value": f"{value:.6g}", "commit": options.commit}
            for curve, wall, x, value in found]


if __name__ == "__main__":
    bench("hard-curves", __doc__, measure)
