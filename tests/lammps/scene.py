# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Spheres that slide, stick, hop and cross seams on a rough floor in tilted gravity."""

import math

import lmp
import stl

BOX = "block -6 6 -6 6 -1.5 8"


def floor_height(x, y):
    """Of the nodes; between them the floor is a little lower or higher."""
    return 0.15 * math.sin(x) * math.cos(y)


def write_floor(path, side=6.5, cells=26):
    """A bumpy sheet of 2 x cells^2 triangles, so that spheres roll over edges both ways."""
    step = 2 * side / cells

    def point(i, j):
        x, y = -side + i * step, -side + j * step
        return x, y, floor_height(x, y)

    stl.write(path, stl.sheet(cells, point))


def bumpy_floor(folder):
    write_floor(folder / "floor.stl")


# Everything that a contact can keep from step to step: spring, radius, rolling, twist,
# and adhesion past touch.
GRANULAR = ("granular jkr 1e5 700 0.3 0.3 tangential mindlin_rescale/force NULL 0.6 0.4 "
            "rolling sds 2e3 5 0.1 twisting marshall")
# That, of a contact that yields.
YIELDING = ("granular eepa 1e5 0.8 0.6 100 1.5 2.5 -0.1 tangential linear_history 4e3 0.6 0.4 "
            "rolling sds 2e3 5 0.1 twisting sds 30 1 0.1")

SETTINGS = lmp.head(modify="map array sort 40 1.5")

# Sizes differ, so that exchange sees springs of some and none of others.
CREATE = SETTINGS + f"""\
region          box {BOX}
create_box      2 box
lattice         sc 0.6
region          fill block -5 5 -5 5 1.0 1.4 units box
create_atoms    1 region fill
set             group all type/fraction 2 0.4 771
set             type 1 diameter 1.0
set             type 2 diameter 0.7
set             group all density 2.0
velocity        all create 4.0 4711 loop geom
velocity        all set NULL NULL -2.0 sum yes
"""


# Pairs that keep springs, and what takes these away before LAMMPS deletes the pair style.
SPRINGS_OF_PAIRS = CREATE + """\
pair_style      granular/lsdcd
pair_coeff      * * hooke 1e4 0 tangential linear_history 3e3 0 0.5
fix             1 all nve/sphere
run             5
"""
WITHOUT_SPRINGS = ("plugin clear", "plugin unload fix SPRINGS/LSDCD\nplugin unload pair granular/lsdcd", "unfix SPRINGS_LSDCD_0\npair_style none")


SIDES = (("sides", "xplane", -6, 6), ("sides2", "yplane", -6, 6), ("lid", "zplane", -1.5, 8))


def forces(law, mesh="mesh floor.stl", pair=False, more="", sides="hooke 1e4 NULL 20 NULL 0.1 1"):
    pair_style = "gran/hooke 2e4 NULL 20 NULL 0.5 1" if pair else "zero 1.2"
    box = "".join(f"fix {name} all wall/gran {sides} {plane} {lo} {hi}\n" for name, plane, lo, hi in SIDES)
    if lmp.DEVICE_MOVES:
        box = "".join(f"fix {name} all wall/reflect {plane[0]}lo {lo} {plane[0]}hi {hi} units box\n" for name, plane, lo, hi in SIDES)
    return lmp.pairs(pair_style) + f"""\
fix             move all nve/sphere
fix             pull all gravity 8.0 vector 0.5 0.2 -1.0
fix             wall all wall/lsdcd {law} {mesh} contacts
{lmp.flat_walls(box)}timestep        0.001
{more}
"""


def dump(name, every, first=0):
    return f"""\
dump            {name} all custom {every} {name} id x y z vx vy vz omegax omegay omegaz &
                f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] f_wall[6] f_wall[7]
dump_modify     {name} format float %.17g sort id
"""
