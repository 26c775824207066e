#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run fix wall/lsdcd beside fix surface/global and fix surface/local of LAMMPS 4Jul2026 (package GRANSURF).

Prints the time of a screw feeder, the force of a grain over seams, and the energy of a ball that slides in a tube of flat
sides. Times are those of one core's CPU. Without --gransurf only fix wall/lsdcd runs. Fails where it does not carry the grains
along with the blade, or where a seam doubles a force.
"""
import math
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from runs import environment, make_meshes, options, print_table    # noqa: E402
from make_feeder import PITCH                                      # noqa: E402
from stl import quad, strip, write_stl                             # noqa: E402

LSDCD, GLOBAL, LOCAL = "fix wall/lsdcd", "fix surface/global", "fix surface/local"
R, OVERLAP = 0.5, 0.001
TUBE, SIDES = 5.0, 64

START = """\
units           lj
atom_style      {style}
atom_modify     map array
boundary        f f f
newton          {newton}
comm_modify     vel yes cutoff 6
region          box block -8 8 -8 8 -8 8
create_box      {types} box
create_atoms    1 single {at} units box
set             atom 1 diameter 1 density 1
{pair}
neighbor        0.3 bin
timestep        0.0005
group           ball type 1
fix             move ball nve/sphere
{wall}
"""


def run(program, text, folder):
    script = folder / "in.compare"
    script.write_text(text)
    with environment() as env:
        done = subprocess.run([Path(program).resolve(), "-in", script.name, "-log", "none"], cwd=folder, env=env, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if done.returncode < 0:
        return None    # a crash
    if done.returncode:
        raise SystemExit(text + done.stdout[-2000:])
    return done.stdout


def feeder(a):
    """CPU seconds of the steps, and how far the grains have come."""
    rows = []
    for name, program, script, words in ((LSDCD, a.lmp, "in.feeder", ""), (GLOBAL, a.gransurf, "in.feeder", "global"),
                                         (LOCAL, a.gransurf, "in.feeder.local", "")):
        if program is None:
            continue
        text = (HERE / script).read_text()
        if words:
            text = f"variable wall index {words}\n" + text
        out = run(program, f"variable steps index {a.steps}\n" + text, a.work)
        if out is None:
            rows.append([name, "crashes", "", ""])
            continue
        seconds, share = re.search(r"^Loop time of (\S+) on \d+ procs.*?^(\S+)% CPU use", out, re.M | re.S).groups()
        left, place = re.search(r"^feeder grains (\S+) place (\S+)", out, re.M).groups()
        # A grain cannot be farther than a pitch from where four turns of the blade have taken it.
        if name == LSDCD and a.steps == 80000 and (left != "49" or abs(float(place) - 3.532 - 4 * PITCH) > PITCH):
            raise SystemExit(f"the screw has brought {left} grains to {place}")
        rows.append([name, f"{float(seconds) * float(share) / 100:.2f}", left, f"{float(place):.3f}"])
    return rows


def wall(name, files, law, flat=""):
    """Style, number of types, pair style and fix."""
    if name == LOCAL:
        fix = "fix w all surface/local " + " ".join(f"input stl 2 {k} {f}" for k, f in enumerate(files, 1)) + flat
        return dict(style="hybrid tri sphere 1", newton="on", types=2, wall=fix,
                    pair=f"pair_style hybrid granular surf/granular\npair_coeff 1 1 granular {law}\n"
                         f"pair_coeff 1 2 surf/granular {law}\npair_coeff 2 2 none")
    inputs = " ".join(f"input stl 1 {k} {f}" for k, f in enumerate(files, 1))
    fix = (f"fix w all surface/global {inputs} model * * granular {law}{flat}" if name == GLOBAL else
           f"fix w all wall/lsdcd granular {law} log brief " + " ".join(f"mesh {f}" for f in files))
    return dict(style="sphere", newton="off", types=1, pair="pair_style zero 1.2\npair_coeff * *", wall=fix)


def force(a, name, files, at, flat=""):
    """On a ball at rest, over that on the middle of a face."""
    text = START.format(at=at, **wall(name, files, "hooke 1e4 0 tangential linear_nohistory 0 0 damping velocity", flat))
    out = run(a.lmp if name == LSDCD else a.gransurf,
              text + "compute z ball reduce sum fz\nthermo_style custom step c_z\ntimestep 1e-7\nrun 1\nvariable z equal c_z\n"
              "print \"FORCE ${z}\"\n", a.work)
    return float(re.search(r"^FORCE (\S+)", out, re.M)[1]) / (1e4 * OVERLAP)


def seams(a):
    centre = R - OVERLAP
    fold = centre / math.cos(math.radians(2.5))
    ridge = centre
    rows = []
    for what, files, at in (("an edge of two triangles in one plane", ["floor.stl"], f"0 0 {centre}"),
                            ("an edge that meets two T-junctions", ["tee.stl"], f"0 0.4 {centre}"),
                            ("the seam of two meshes in one plane", ["left.stl", "right.stl"], f"0 0.4 {centre}"),
                            ("a fold of 5 degrees, from inside", ["fold.stl"], f"0 0.4 {fold}"),
                            ("a fold of 5 degrees, from outside", ["ridge.stl"], f"0 0.4 {ridge}"),
                            ("a free edge", ["left.stl"], f"0 0.4 {centre}"),
                            ("a corner of three faces, along z", ["corner.stl"], f"{centre - 4} {centre - 4} {centre}")):
        found = [force(a, n, files, at) for n in a.names]
        # The blended sides of the fold push with 1 / cos(2.5 degrees) in all, 1.00095.
        if abs(found[0] - 1) > 1.1e-3:
            raise SystemExit(f"{what}: the force is {found[0]} of that on a face")
        rows.append([what, *(f"{f:.3f}" for f in found)])
    return rows


def rolling(a):
    """A ball that slides without friction and damping from one side of the tube to the other, eight times: the largest and the
    last kinetic and potential energy, over that of the start. Elastic energy is less than 1e-3 of it."""
    h = TUBE - R - 1e-4
    at = f"{h * math.sin(0.6)} 0.1 {-h * math.cos(0.6)}"
    rows = []
    for name, flat in ((LSDCD, ""),) if not a.gransurf else ((LSDCD, ""), (GLOBAL, ""), (GLOBAL, " flat 10"), (LOCAL, ""), (LOCAL, " flat 10")):
        text = START.format(at=at, **wall(name, ["tube64.stl"], "hooke 1e5 0 tangential linear_nohistory 0 0 damping velocity", flat))
        out = run(a.lmp if name == LSDCD else a.gransurf,
                  text + "fix g ball gravity 1 vector 0 0 -1\ncompute k ball ke\nvariable m equal mass(ball)\n"
                  f"variable e equal c_k+v_m*(xcm(ball,z)+{h})\nthermo_style custom step v_e\nthermo_modify norm no format "
                  "float %.10g lost ignore\nthermo 50\nrun 60000\n", a.work)
        e = [float(x) for x in re.findall(r"^ *\d+ +([-+.\de]+) *$", out[out.index("Step"):], re.M)]
        rows.append([name + flat.replace(" ", ", ", 1), f"{max(e) / e[0]:.4f}", f"{e[-1] / e[0]:.4f}"])
    return rows


def write_meshes(folder):
    h, rise = 4.0, 4 * math.tan(math.radians(2.5))
    left, right = [quad((x0, -h, 0), (x1, -h, 0), (x1, h, 0), (x0, h, 0)) for x0, x1 in ((-h, 0), (0, h))]
    pieces = [t for y0, y1 in ((-h, -1), (-1, 1), (1, h)) for t in quad((0, y0, 0), (h, y0, 0), (h, y1, 0), (0, y1, 0))]

    def bent(z):
        return (quad((0, -h, 0), (h, -h, z), (h, h, z), (0, h, 0)) + quad((-h, -h, z), (0, -h, 0), (0, h, 0), (-h, h, z)))

    corner = (quad((-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)) + quad((-h, -h, 0), (-h, h, 0), (-h, h, h), (-h, -h, h)) +
              quad((-h, -h, 0), (-h, -h, h), (h, -h, h), (h, -h, 0)))
    ring = [(TUBE / math.cos(math.pi / SIDES) * math.sin(2 * math.pi * (k + 0.5) / SIDES), y,
             TUBE / math.cos(math.pi / SIDES) * math.cos(2 * math.pi * (k + 0.5) / SIDES)) for y in (-1, 1) for k in range(SIDES)]
    ring = [ring[:SIDES] + ring[:1], ring[SIDES:] + ring[SIDES:SIDES + 1]]
    for name, triangles in (("floor", quad((-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0))), ("left", left), ("right", right),
                            ("tee", left + pieces), ("fold", bent(rise)), ("ridge", bent(-rise)), ("corner", corner),
                            ("tube64", strip(*ring))):
        write_stl(folder / f"{name}.stl", triangles, name)


def main():
    p = options(__doc__, HERE)
    p.add_argument("--gransurf", metavar="FILE", help="a LAMMPS 4Jul2026 with the package GRANSURF")
    p.add_argument("--steps", type=int, default=80000, help="of the feeder (default 80000)")
    p.add_argument("--only", choices=("feeder", "seams", "rolling"))
    a = p.parse_args()
    a.names = (LSDCD, GLOBAL, LOCAL) if a.gransurf else (LSDCD,)
    make_meshes(HERE / "make_feeder.py", a.work)
    write_meshes(a.work)
    for name, part, titles in (("feeder", feeder, ["wall", "CPU, s", "grains left", "mean place along the tube"]),
                               ("seams", seams, ["force over ... / on a face", *a.names]),
                               ("rolling", rolling, ["wall", "largest energy", "last energy"])):
        if a.only in (None, name):
            print()
            print_table(titles, part(a))


if __name__ == "__main__":
    main()
