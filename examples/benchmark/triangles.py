#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The forces of the same silo and the same drum of 25 sides, cut into 100 and into many triangles, on one state of grains.

At rest there are the forces of their overlaps, which may differ by 1e-10 of the largest: corners are rounded to 1.4e-17 m, and overlaps are
1e-7 m. When grains have moved for 20 steps there are damping and friction. The damping of a contact that has just begun goes with the root
of the root of its overlap, so these may differ by 1e-8. Otherwise the program fails.
"""
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402

LIMITS = 1e-10, 1e-8    # at rest, after 20 steps
LAW = {"silo": "m1 on steel", "drum": "m1 types 2 m2 on steel"}
MOVE = {"silo": "move 0 0 -0.0554222", "drum": "move 0 -0.03 0"}


def lammps(a, script, **variables):
    words = [w for name, value in variables.items() for w in ("-var", name, str(value))]
    with runs.environment() as env:
        done = subprocess.run([Path(a.lmp).resolve(), "-in", HERE / script, "-log", "none", *words], cwd=a.work, env=env, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(done.stdout[-2000:])


def forces(path):
    """Of each step of a dump: grains x (force, torque)."""
    return [np.array([line.split() for line in frame.split("ITEM: TIMESTEP")[0].splitlines()[1:]], float)
            for frame in path.read_text().split("ITEM: ATOMS")[1:]]


def difference(one, other):
    """The largest of a force and of a torque, in parts of the largest."""
    parts = (one[:, :3], other[:, :3]), (one[:, 3:], other[:, 3:])
    return max(np.abs(a - b).max() / max(np.linalg.norm(a, axis=1).max(), 1e-300) for a, b in parts)


def main():
    p = runs.options(__doc__, HERE)
    p.add_argument("--triangles", type=int, default=100000)
    p.add_argument("--grains", type=int, default=25000, help="in the silo; in the drum as many, of which a fifth is large")
    p.add_argument("--seconds", type=float, default=0.6, help="for which grains fall, at most until they are at rest")
    a = p.parse_args()
    runs.make_meshes(HERE / "make_walls.py", a.work, "--polygons", "--triangles", a.triangles, "--lsdcd", Path(a.lmp).resolve().with_name("lsdcd"))
    count = {"silo": {"grains": a.grains}, "drum": {"small": a.grains - a.grains // 5, "large": a.grains // 5}}
    rows, wrong = [], False
    for case in LAW:
        bed = f"{case}_bed.data"
        lammps(a, f"in.fill_{case}", dir=a.work, wall=f"{case}_100.obj", longest=a.seconds, out=bed, **count[case])
        found = {}
        for cut in ("100", "even", "slivers"):
            lammps(a, "in.forces", dir=a.work, bed=bed, law=LAW[case], wall=f"{case}_{cut}.obj {MOVE[case]}", out=f"{case}_{cut}.txt")
            found[cut] = forces(a.work / f"{case}_{cut}.txt")
        touching = int((np.linalg.norm(found["100"][1], axis=1) > 0).sum())
        for cut in ("even", "slivers"):
            away = [difference(*pair) for pair in zip(found["100"], found[cut])]
            wrong = wrong or any(x > limit for x, limit in zip(away, LIMITS))
            rows.append([case, cut, str(touching), *(f"{x:.1e}" for x in away)])
    runs.print_table(["case", "triangles", "grains at the wall", "at rest", "after 20 steps"], rows)
    if wrong:
        raise SystemExit("forces differ by more than {:g} at rest, or {:g} after 20 steps".format(*LIMITS))


if __name__ == "__main__":
    main()
