# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Which device is faster for a LAMMPS without Kokkos: `./run bench device`.

Spheres of diameter 1 lie in layers on a wavy floor of 20 000 triangles, one core a process; hooke/history among
spheres and at the wall. The whole step with `device cpu` and with `device cuda`, in turn, for numbers of spheres and of
processes that share the GPU: what `device auto` is decided by (src/wall/device_choice.cpp).
"""
import math
import os
import re
import subprocess
import sys

import lammps_runs
import rows

sys.path.insert(0, str(rows.ROOT / "examples"))
from stl import write_stl    # noqa: E402

LAW = "hooke/history 4000 NULL 100 NULL 0.5 1"
CELLS = 100    # of the floor, along x and y
SCRIPT = """\
units           lj
atom_style      sphere
boundary        p p f
newton          off
comm_modify     vel yes
processors      * * 1
region          box block 0 {side} 0 {side} -1 {top}
create_box      1 box
lattice         sc 1 origin 0.5 0.5 0.48
region          bed block 0 {side} 0 {side} 0 {layers}
create_atoms    1 region bed
set             group all diameter 1
set             group all density 1.9098593    # mass 1
pair_style      gran/{law}
pair_coeff      * *
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
velocity        all create 0.001 87287 loop geom
fix             move all nve/sphere
fix             pull all gravity 1 vector 0 0 -1
{plugin}
fix             wall all wall/lsdcd {law} mesh floor.stl periodic device {device}
timestep        5e-4
thermo          100000000
run             20
run             {steps}
run             {steps}
run             {steps}
"""
DEVICES = ("cpu", "cuda")


def write_floor(path, side):
    def point(i, j):
        x, y = ((side + 4) * k / CELLS - 2 for k in (i, j))
        return x, y, 0.05 * math.sin(x / 3) * math.cos(y / 3)

    corners = [[point(i, j) for j in range(CELLS + 1)] for i in range(CELLS + 1)]
    write_stl(path, [t for i in range(CELLS) for j in range(CELLS)
                     for a, b, c, d in [(corners[i][j], corners[i + 1][j], corners[i + 1][j + 1], corners[i][j + 1])]
                     for t in ((a, b, c), (a, c, d))], "a wavy floor")


def step_ms(options, folder, device, side, ranks):
    """The least of three timed runs."""
    steps = max(20, min(300, 3000000 // (side * side * options.layers)))
    plugin = f"plugin load {options.plugin}" if options.plugin else ""
    (folder / "in.device").write_text(SCRIPT.format(side=side, top=options.layers + 2, layers=options.layers,
                                                    law=LAW, plugin=plugin, device=device, steps=steps))
    command = [options.lmp, "-in", "in.device", "-log", "none", "-nocite"]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks)] + command
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={"OMP_NUM_THREADS": "1", **os.environ})
    loops = re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", done.stdout, re.M)[1:]
    if done.returncode != 0 or len(loops) != 3:
        raise SystemExit(f"{options.lmp} failed:\n{done.stdout[-3000:]}")
    return min(1e3 * float(t) / int(n) for t, n in loops)


def main():
    p = lammps_runs.parser("device", __doc__)
    p.add_argument("--plugin", metavar="FILE", help="lsdcdplugin.so for it")
    p.add_argument("--sides", type=int, nargs="+", default=[10, 30, 100, 316, 1000], metavar="N",
                   help="spheres along x and y (default: %(default)s)")
    p.add_argument("--layers", type=int, default=1, metavar="N", help="of spheres (default 1)")
    p.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16], metavar="N",
                   help="processes on one GPU (default: %(default)s)")
    options = p.parse_args()
    options.lmp = os.path.abspath(options.lmp)
    print("processes,layers,spheres_near_the_wall_in_one,cpu_ms,cuda_ms,gpu,cpu,commit")
    with lammps_runs.work_folder(options.scripts_to) as folder:
        for ranks in options.ranks:
            for side in options.sides:
                if side * side < 50 * ranks:
                    continue
                write_floor(folder / "floor.stl", side)
                ms = [step_ms(options, folder, device, side, ranks) for device in DEVICES]
                print(f"{ranks},{options.layers},{side * side // ranks},{ms[0]:.4g},{ms[1]:.4g},{rows.gpu()},{rows.cpu()},"
                      f"{options.commit}", flush=True)


if __name__ == "__main__":
    main()
