# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Torque about chosen points, and work of a wall that moves, against closed forms."""

import math

import numpy

import lmp
from facts import at_most, fact
from test_moving import write_drum, write_plane
from triangles import turn

SCRIPT = lmp.SMALL_BOX + """\
fix             wall all wall/lsdcd {wall} contacts
timestep        {dt}
{more}
thermo_style    custom step f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] f_wall[6] f_wall[11]
thermo_modify   norm no format float %.17g
thermo          1
dump            d all custom 1 spheres id x y z vx vy vz tqx tqy tqz f_wall[2] f_wall[3] f_wall[4]
dump_modify     d format float %.17g sort id
run             {steps}
"""
ONE = "create_atoms 1 single 0.2 0.1 0.51 units box"
TWO = "create_atoms 1 single 0.7 -1.35 0.2 units box\ncreate_atoms 1 single -0.5 -1.35 3.8 units box"
LAW = "hooke/history 1e4 NULL 5 NULL 0.5 1 mesh drum.stl rolling epsd2 0.1"
PULL = "fix pull all gravity 8.0 vector 0 -1 0"


def go(folder, wall, dt, steps, atoms=TWO, more=PULL, ranks=1):
    text = lmp.run_well(SCRIPT.format(wall=wall, dt=dt, steps=steps, atoms=atoms, more=more), folder, ranks)
    return lmp.read_thermo(text), lmp.read_dump(folder / "spheres")


def torque_about(rows, point):
    """On the mesh; gravity has no torque on a sphere, so that tq is the wall's."""
    rows = numpy.array(list(rows.values()))
    return -(numpy.cross(rows[:, :3] - point, rows[:, 9:12]) + rows[:, 6:9]).sum(axis=0)


def test_piston(folder):
    """It hits a sphere at rest without friction, which leaves at twice its speed."""
    write_plane(folder / "plane.stl", 2, 2.0)
    speed, dt, mass, kn = 0.8, 1e-5, 2 * math.pi / 6, 1e4
    rows, spheres = go(folder, f"hooke {kn} NULL 0 0 0 0 mesh plane.stl motion linear 0 0 {speed}", dt, 6000,
                       atoms=ONE, more="")
    last = spheres[6000][1]
    # Velocity Verlet is off by (omega dt)^2 = kn/m dt^2 of 1e-6, and so is the time of contact.
    at_most("the sphere leaves at twice the speed", abs(last[5] / (2 * speed) - 1), 1e-6)
    work = sum(row[7] for row in rows) * dt
    at_most("work of the piston is the energy of the sphere",
            abs(work / (mass * (2 * speed)**2 / 2) - 1), 1e-6)
    fact("force times velocity in every step", all(row[7] == -row[3] * speed for row in rows))


def test_drum(folder):
    """It turns about an axis that moves; torque is asked for about a point of the axis, of the drum,
    and of the box."""
    write_drum(folder / "drum.stl", 0, 4)
    period, start, speed = 2.0, numpy.array((0.1, -0.2, 0.5)), numpy.array((0.05, -0.1, 0.2))
    rate = 2 * math.pi / period
    dt, steps = 1e-4, 1500
    motion = " motion transrot {} {} {} {} {} {} 0 0 1 {} ".format(*speed, *start, period)
    still = (0.4, 0.3, -2.0)
    for about, point in (("{} {} {}".format(*still), lambda t: still),
                         ("mesh {} {} {}".format(*start), lambda t: start + speed * t),
                         ("mesh", lambda t: start + speed * t - turn((0, 0, 1), rate * t) @ start)):
        rows, spheres = go(folder, LAW + motion + "torque_about " + about, dt, steps)
        off, size, torque, power = 0, 0, 0, 0
        for row in rows:
            t, here = row[0] * dt, spheres[int(row[0])]
            expected = torque_about(here, point(t))
            off = max(off, *abs(row[4:7] - expected))
            size = max(size, *abs(expected))
            works = -numpy.dot(row[1:4], speed) - rate * torque_about(here, start + speed * t)[2]
            torque, power = max(torque, abs(row[7] - works)), max(power, abs(works))
        # Sums of a few products of numbers up to 3 times as large.
        at_most(f"torque about {about}", off / size, 1e-13)
        at_most("power is F v + T w about the axis", torque / power, 1e-13)
    two, _ = go(folder, LAW + motion + "torque_about mesh", dt, steps, ranks=2)
    # Sums over processes in another order.
    at_most("the same on 2 ranks", max(abs(a[7] - b[7]) for a, b in zip(rows, two)) / power, 1e-12)
