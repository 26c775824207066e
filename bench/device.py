# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Which device is faster for a LAMMPS without Kokkos: `./run bench device`.

Spheres of diameter 1 lie in a layer on a wavy floor of 20 000 triangles, one core a process; hooke/history among
spheres and at the wall. The whole step with `device cpu` and with `device cuda`, in turn, for numbers of spheres and of
processes that share the GPU: what `device auto` is decided by (src/wall/device_choice.cpp).
"""
import math

import rows
from kokkos_beds import LAW, sheet
from lammps import Program, bench
from stl import write_stl

SCRIPT = """\
units           lj
atom_style      sphere
boundary        p p f
newton          off
comm_modify     vel yes
processors      * * 1
region          box block 0 {side} 0 {side} -1 3
create_box      1 box
lattice         sc 1 origin 0.5 0.5 0.48
region          bed block 0 {side} 0 {side} 0 1
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


def least_ms(options, folder, device, side, ranks):
    steps = max(20, min(300, 3000000 // (side * side)))
    plugin = f"plugin load {options.plugin}" if options.plugin else ""
    run = Program(options.lmp).run(SCRIPT.format(side=side, law=LAW, plugin=plugin, device=device, steps=steps), folder, ranks)
    return f"{min(run.step_ms()[1:]):.4g}"


def measure(options, folder):
    found = []
    for ranks in options.ranks:
        for side in options.sides:
            if side * side < 50 * ranks:
                continue
            wavy = sheet(lambda x, y: 0.05 * math.sin(x / 3) * math.cos(y / 3), (side + 4, side + 4), 100, 100)
            write_stl(folder / "floor.stl", wavy, "a wavy floor")
            found.append({"processes": ranks, "spheres_near_the_wall_in_one": side * side // ranks,
                          **{f"{device}_ms": least_ms(options, folder, device, side, ranks) for device in options.devices},
                          "gpu": rows.gpu(), "cpu": rows.cpu(), "commit": options.commit})
            rows.say(", ".join(map(str, found[-1].values())))
    return found


if __name__ == "__main__":
    bench("device", __doc__, measure, quick={"sides": [10], "ranks": [1]}, words=[
        ("--plugin", dict(metavar="FILE", help="lsdcdplugin.so for it")),
        ("--devices", dict(nargs="+", choices=("cpu", "cuda"), default=("cpu", "cuda"))),
        ("--sides", dict(type=int, nargs="+", default=[10, 30, 100, 316, 1000], metavar="N",
                         help="spheres along x and y (default: %(default)s)")),
        ("--ranks", dict(type=int, nargs="+", default=[1, 2, 4, 8, 16], metavar="N",
                         help="processes on one GPU (default: %(default)s)"))])
