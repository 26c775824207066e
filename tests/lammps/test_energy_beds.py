# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Beds of grains whose books of energy close as those of a ball mill do: below a screw that a motor turns, on a membrane of nodes, in a cask that wears. Of
the work of the drive the remainder of pairs and walls together is below 1e-4 at 150 steps in a contact of two grains, and below (150/steps)^2 times
that."""

import math

import lmp
import stl
from facts import at_most, fact
from test_energy import CASK_LAW, CAUSES, COLUMNS, MASS, MILL_K, MILL_LAW, NAMES, cask, close

END = """\
compute         books all lsdcd/energy
timestep        {dt}
thermo_style    custom step c_books[17] {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
run             {steps}
"""
STEPS = (50, 150)    # in a contact


def closes(folder, script, contact, seconds, columns=(), **words):
    """The last row of the shortest timestep. With the longest one the books also close where 4 processes go on from a restart file of the middle; the
    quick suite leaves this out."""
    def last(name, n, part=1.0, ranks=1, text=script):
        dt = contact / n
        out = lmp.run_well(text.format(dt=repr(dt), steps=round(part * seconds / dt), columns=" ".join([*COLUMNS, *columns]), **words), folder, ranks,
                           timeout=3000)
        b = dict(zip(("step", "pairs", *NAMES, *columns), lmp.read_thermo(out)[-1]))
        missing = abs(b["remainder"] + b["pairs"]) / abs(b["drive"])
        fact(f"{name}, {n} steps: all causes dissipate", all(b[c] > 0 for c in CAUSES if c != "adhesion"), b)
        at_most(f"{name}, {n} steps: remainder over the work of the drive", missing, 1e-4 * (150 / n) ** 2)
        return b
    long, short = STEPS
    half = round(seconds * long / contact / 2)
    last("one process", long, text=script.replace("run ", f"restart {half} half.*\nrun "))
    if not lmp.QUICK:
        again = f"newton off\nread_restart half.{half}\ncomm_modify vel yes\n" + script[script.index("pair_style"):]
        last("restarted on 4 processes", long, 0.5, 4, again)
    return last("one process", short)


SCREW_LAW = "hooke 5000 0.6 damping coeff_restitution tangential linear_history_slip 1400 1 0.4 rolling sds 160 0 0.01 twisting sds 10 0 0.006"
SCREW = """\
units           lj
atom_style      sphere
newton          off
boundary        f p f
region          box block -7 7 0 20 -7 7
create_box      1 box
lattice         sc 0.7
region          fill cylinder y 0 0 5.3 0.5 19 units box
region          shaft cylinder y 0 0 2.2 0 20 side out units box
region          lower block INF INF INF INF INF 2.0 units box
region          free intersect 3 fill shaft lower
create_atoms    1 region free
variable        blade atom abs((y/10-atan2(x,z)/(2*PI)+2)%1-0.5)>0.35
group           blade variable blade
delete_atoms    group blade compress yes
set             group all diameter 1 density 1
comm_modify     vel yes
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.3 bin
neigh_modify    every 1 delay 0 check yes
fix             fall all gravity 1.0 vector 0 0 -1
fix             move all nve/sphere
fix             wall all wall/lsdcd granular {law} periodic mesh {dir}/tube.stl &
                mesh {dir}/screw.stl body mass 200 com 0 10 0 inertia 1500 1500 1500 0 0 0 joint hinge 0 0 0 0 1 0 motor -200 energy
""" + END


def test_screw(folder):
    """A screw that a motor turns in its tube: the motor's work is the energy of the screw and what it gives to the grains."""
    angle, kinetic = "f_wall[34]", "f_wall[35]"
    contact = math.sqrt(math.pi / 6 / 2 / 5000 * (math.pi ** 2 + math.log(0.6) ** 2))
    b = closes(folder, SCREW, contact, 8, (angle, kinetic), law=SCREW_LAW, dir=lmp.HERE.parent.parent / "examples" / "screw")
    motor = -200 * b[angle]
    close("the motor's work", b[kinetic] + b["drive"], motor, motor, 1e-6)


CELLS = 8
NODES = [-0.1 + 0.2 * i / CELLS for i in range(CELLS + 1)]
MEMBRANE = """\
units           si
atom_style      sphere
boundary        f f f
newton          off
comm_modify     vel yes
region          box block -0.2 0.2 -0.2 0.2 -0.1 0.4
create_box      2 box
lattice         sc 0.02
region          in block -0.07 0.07 -0.07 0.07 0.02 0.1 units box
create_atoms    1 region in
displace_atoms  all random 0.0015 0.0015 0.0015 4711 units box
""" + "".join(f"create_atoms    2 single {x!r} {y!r} 0 units box\n" for x in NODES for y in NODES) + """\
set             type 1 diameter 0.016 density 7800
set             type 2 diameter 0.001 mass 0.02
group           grains type 1
group           nodes type 2
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.004 bin
neigh_modify    delay 0 every 1 check yes exclude type 1 2 exclude type 2 2
fix             move grains nve/sphere
variable        dz atom 0.006*sin(60*step*dt)*cos(15*x)
variable        vz atom 0.36*cos(60*step*dt)*cos(15*x)
variable        no equal 0
fix             shake nodes move variable v_no v_no v_dz v_no v_no v_vz
fix             g grains gravity 9.81 vector 0 0 -1
fix             wall grains wall/lsdcd granular {law} mesh box.stl mesh membrane.stl nodes nodes energy
""" + END


def test_membrane(folder):
    """Balls in a box, on a membrane whose nodes make a standing wave."""
    stl.write(folder / "membrane.stl", stl.sheet(CELLS, lambda i, j: (NODES[i], NODES[j], 0)))
    stl.write(folder / "box.stl", stl.box((-0.09, -0.09, -0.09), (0.09, 0.09, 0.3)))
    closes(folder, MEMBRANE, math.pi * math.sqrt(MASS / 2 / MILL_K), 0.4, law=MILL_LAW.replace("granular ", ""))


CASK = cask(60, 0.6, lmp.pairs("granular/lsdcd", 0.05, coeff="{law}"), "granular {law} mesh cask.stl motion rotate 0 0 0 0 1 0 8 "
            "wear archard 1.3e-2 50 deform every 10") + END


def test_cask_that_wears(folder):
    """A closed cask that turns and wears: what its surface takes from contacts as it goes back is a part of the work of its drive that counts."""
    wear = "f_wall[75]"
    stl.write(folder / "cask.stl", stl.box((-1, -1, -1), (1, 1, 1), 6))
    b = closes(folder, CASK, math.pi / math.sqrt(2e4), 2, (wear,), law=CASK_LAW.replace("granular ", ""))
    fact("wear takes more than 1 % of it", b[wear] > 0.01 * b["drive"], b[wear] / b["drive"])
