# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A small rotating drum with lifters, full of spheres of two sizes."""

import math
import random

import numpy

import lmp
from triangles import turn

RADIUS, LENGTH, SIDES, LIFTERS, LIFT = 4.0, 6.0, 16, 4, 0.8
PERIOD, DT = 8.0, 5e-4
STIFFNESS = 2e4
# No damping along the normal, so that its force is the overlap's; the spheres damp each other.
LAW = f"hooke/history {STIFFNESS} NULL 0 60 0.5 1"


def triangles():
    """(n, 3, 3): walls, ends and lifters of a drum about the y axis."""
    half, found = LENGTH / 2, []

    def rim(k, radius, y):
        a = 2 * math.pi * k / SIDES
        return radius * math.cos(a), y, radius * math.sin(a)

    def quad(a, b, c, d):
        found.extend(((a, b, c), (a, c, d)))

    for k in range(SIDES):
        quad(rim(k, RADIUS, -half), rim(k, RADIUS, half), rim(k + 1, RADIUS, half), rim(k + 1, RADIUS, -half))
        for y in (-half, half):
            found.append(((0, y, 0), rim(k, RADIUS, y), rim(k + 1, RADIUS, y)))
    for k in range(0, SIDES, SIDES // LIFTERS):
        quad(rim(k, RADIUS, -half), rim(k, RADIUS, half), rim(k, RADIUS - LIFT, half), rim(k, RADIUS - LIFT, -half))
    return numpy.array(found)


def write_data(path, spacing=0.72):
    """Spheres on a lattice, the same whatever the number of ranks; returns how many."""
    chance, rows = random.Random(7), []
    n = int(RADIUS / spacing)
    for i in range(-n, n + 1):
        for j in range(-n, n + 1):
            for k in range(-n, n + 1):
                x, y, z = i * spacing, j * spacing, k * spacing
                if math.hypot(x, z) < RADIUS - LIFT - 0.4 and abs(y) < LENGTH / 2 - 0.4:
                    rows.append((chance.choice((0.5, 0.7)), *(c + chance.uniform(-0.01, 0.01) for c in (x, y, z))))
    with open(path, "w") as data:
        data.write(f"spheres\n\n{len(rows)} atoms\n1 atom types\n"
                   "-4.6 4.6 xlo xhi\n-3.6 3.6 ylo yhi\n-4.6 4.6 zlo zhi\n\nAtoms\n\n")
        for at, (d, x, y, z) in enumerate(rows):
            data.write(f"{at + 1} 1 {d} 2.0 {x:.17g} {y:.17g} {z:.17g}\n")
    return len(rows)


BEGIN = lmp.head(more="comm_style brick\nread_data drum.data\n") + lmp.pairs(f"gran/hooke/history {STIFFNESS} NULL 60 NULL 0.5 1", 0.1) + f"""\
timestep        {DT}
fix             move all nve/sphere
fix             pull all gravity 9.81 vector 0 0 -1
fix             wall all wall/lsdcd {LAW} mesh drum.stl motion rotate 0 0 0 0 1 0 {PERIOD} contacts
thermo_style    custom step atoms ke f_wall[1] f_wall[2] f_wall[3] f_wall[5] f_wall[7] f_wall[8]
thermo_modify   norm no format float %.17g
"""


def turned(time):
    return triangles() @ turn((0, 1, 0), 2 * math.pi * time / PERIOD).T
