# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes that a servo moves: pistons, a lever; closed forms, LAMMPS's own walls, restart, ranks."""

import math
import re

import lmp
import stl
from facts import at_most, fact

# dt is a tenth of the contact's time where it is not given: pi sqrt(m/k) for a sphere of mass pi/3
# and k = 1e4 is 0.0321, with damping a little more.
DT = 0.0032
HOOKE = "hooke 1e4 NULL 20 NULL 0.5 1"
# 4Jul2026 divides the tangential damping by the normal one.
UNDAMPED = "hooke 1e4 NULL 1e-12 NULL 0 0"
HISTORY = "hooke/history 1e4 NULL 20 NULL 0.5 1"

BEGIN = lmp.head("-8 8 -8 8 -1 16", modify="map array sort 0 0") + """\
{create}
set             group all diameter 1.0 density 2.0
""" + lmp.pairs("{pair}") + """\
fix             move all nve/sphere
"""
OUTPUTS = """\
timestep        {dt}
fix             out all print 1 "$(step) $(f_wall[1]:%.17g) $(f_wall[2]:%.17g) $(f_wall[3]:%.17g) &
$(f_wall[4]:%.17g) $(f_wall[5]:%.17g) $(f_wall[6]:%.17g) $(f_wall[7]) $(f_wall[8]:%.17g) &
$(f_wall[9]) $(f_wall[12]:%.17g) $(f_wall[13]:%.17g) $(f_wall[14]:%.17g) {more}" file out.txt screen no
"""
# Columns of it: f_ID[k] is number k.
COUNT, DEPTH, PLACE, SPEED, PUSH, MORE = 7, 8, 10, 11, 12, 13

ONE = "create_atoms 1 single 0.3 0.2 0.5 units box\n"
FLOOR = lmp.flat_walls("fix floor all wall/gran {law} zplane 0 NULL")


def wall(law, words, at=1.05, more=""):
    return f"fix wall all wall/lsdcd {law} mesh plate.stl move 0 0 {at} {words} {more}\n"


def go(folder, servo, law=HOOKE, create=ONE, floor=FLOOR, pair="zero 1.2", dt=DT, steps=2000, at=1.05,
       before="", after="", end="", more="", ranks=1, mesh="plate.stl"):
    """Runs a piston on spheres on LAMMPS's floor; rows of OUTPUTS and the log."""
    text = (BEGIN.format(create=create, pair=pair) + floor.format(law=law) + before +
            wall(law, servo, at).replace("plate.stl", mesh)
            + after + OUTPUTS.format(dt=dt, more=more) + f"run {steps}\n" + end)
    log = lmp.run_well(text, folder, ranks)
    return lmp.read_rows(folder / "out.txt"), log


def settles(name, rows, target, limit=1e-3):
    """The load comes to the target, and never strays farther from it than it did before."""
    first = next(k for k, row in enumerate(rows) if row[COUNT] > 0)
    off = [abs(row[PUSH] - target) / abs(target) for row in rows[first:]]
    at_most(f"{name}: load at the target", off[-1], limit)
    n = len(off) // 4
    quarters = [max(off[k * n:(k + 1) * n]) for k in range(4)]
    # 1e-12: rounding of a load that has settled.
    fact(f"{name}: no growing oscillation",
         all(b <= a + 1e-12 for a, b in zip(quarters, quarters[1:])),
         " ".join(f"{q:.2g}" for q in quarters))


def prepare(folder):
    stl.write(folder / "plate.stl", stl.square(6.0))
    stl.write(folder / "lever.stl", stl.square(1.5))


def test_one_sphere(folder):
    """The piston comes down by the gap and two equal overlaps: F/k, or (F/(k sqrt(R)))^(2/3)."""
    # Loads are as exact as rounding of the overlap lets them be; 1e-3 is what is asked.
    cases = {"hooke": (HOOKE, 50 / 1e4), "undamped": (UNDAMPED, 50 / 1e4),
             "overdamped": ("hooke 1e4 NULL 140 NULL 0.5 1", 50 / 1e4),
             "hertz": ("hertz/history 1e5 NULL 50 NULL 0.5 1", (50 / (1e5 * 0.5**0.5))**(2 / 3)),
             "granular": ("granular hertz 1e5 20 tangential linear_history 1e4 1.0 0.5",
                          (50 / (1e5 * 0.5**0.5))**(2 / 3))}
    for name, (law, overlap) in cases.items():
        floor = FLOOR
        if law.startswith("granular"):
            floor = lmp.flat_walls("fix floor all wall/gran granular hertz 1e5 20 tangential linear_history 1e4 1.0 0.5 zplane 0 NULL")
        rows, log = go(folder, "servo force z -50 vmax 0.05", law, floor=floor, steps=6000)
        settles(name, rows, -50)
        at_most(f"{name}: overlap", abs(rows[-1][DEPTH] * 0.5 / overlap - 1), 1e-3)
        at_most(f"{name}: travel", abs(rows[-1][PLACE] / -(0.05 + 2 * overlap) - 1), 1e-3)
        fact(f"{name}: comes at vmax", rows[5][SPEED] == -0.05 and rows[5][COUNT] == 0)
        fact(f"{name}: the log tells of it", "servo       force z -50 vmax 0.05" in log)
    # Upwards from below, along an axis that is no unit vector.
    rows, _ = go(folder, "servo force axis 0 0 3 20 vmax 0.5", floor=lmp.flat_walls("fix lid all wall/gran {law} zplane NULL 1"),
                 at=-0.03)
    settles("from below", rows, 20)
    at_most("from below: travel", abs(rows[-1][PLACE] / (0.03 + 2 * 20 / 1e4) - 1), 1e-3)


def test_many(folder):
    """A column, and 100 spheres side by side."""
    column = "".join(f"create_atoms 1 single 0.3 0.2 {0.5 + k} units box\n" for k in range(10))
    # A column buckles: it is held in line.
    line = "fix line all setforce 0 0 NULL\n"
    rows, _ = go(folder, "servo force z -50 vmax 0.5", HOOKE, column, pair="gran/" + HOOKE, at=10.05, after=line, steps=20000)
    settles("column", rows, -50)
    # Contacts between spheres have half the overlap of the radii's sum: 50/k each of 9, and 2 of walls.
    at_most("column: travel", abs(rows[-1][PLACE] / -(0.05 + 11 * 50 / 1e4) - 1), 1e-3)
    side = "".join(f"create_atoms 1 single {-5 + 1.1 * i:.1f} {-5 + 1.1 * j:.1f} 0.5 units box\n"
                   for i in range(10) for j in range(10))
    rows, log = go(folder, "servo force z -5000 vmax 0.5", UNDAMPED, side)
    fact("100 side by side: all touch", rows[-1][COUNT] == 100)
    settles("100 side by side", rows, -5000)
    at_most("100 side by side: travel", abs(rows[-1][PLACE] / -(0.05 + 2 * 50 / 1e4) - 1), 1e-3)
    fact("nothing to warn of", "would not be stable" not in log)
    # What one undamped contact bears, 1/(k dt) = 0.031, 100 do not.
    rows, log = go(folder, "servo force z -5000 vmax 0.5 gain 0.03", UNDAMPED, side)
    settles("a gain for one contact is lowered for 100", rows, -5000)
    fact("and warned of once", log.count("would not be stable") == 1 and
         "a servo's gain of 0.03 would not be stable with 100 contacts" in log)
    # A low gain is kept: v = 1e-4 (target - load), on its way.
    rows, log = go(folder, "servo force z -50 vmax 0.5 gain 1e-4", UNDAMPED, steps=200)
    at_most("a low gain is kept", abs(rows[10][SPEED] / (-50 * 1e-4) - 1), 1e-15)


def test_work(folder):
    """Without losses the work of the piston is what the contacts and the spheres hold."""
    side = "".join(f"create_atoms 1 single {-5 + 1.1 * i:.1f} {-5 + 1.1 * j:.1f} 0.5 units box\n"
                   for i in range(10) for j in range(10))
    # A hundredth of the contact's time, so that Verlet's energy is right to (omega dt)^2/8 = 1.2e-4 of
    # what moves; the trapezoid of linear forces is exact, but for the step in which contacts begin:
    # vmax dt = 5e-4 * 0.32 of 10 in k dz dz / 2, 1e-4. Together below 1e-3.
    rows, _ = go(folder, "servo force z -5000 vmax 0.5", UNDAMPED, side, dt=0.00032, steps=6000,
                 floor="fix floor all wall/lsdcd {law} mesh plate.stl\ncompute ke all ke\n",
                 more="$(f_wall+f_floor+c_ke*count(all)^0:%.17g)")
    done = sum(0.5 * (a[PUSH] + b[PUSH]) * (b[PLACE] - a[PLACE]) for a, b in zip(rows, rows[1:]))
    most = max(row[MORE] for row in rows)
    at_most("work of the piston", abs(done - rows[-1][MORE]) / most, 1e-3)
    # F^2/(2 k) in each of 200.
    at_most("is what the springs hold", abs(rows[-1][MORE] / (100 * 50**2 / 1e4) - 1), 1e-2)


def test_lever(folder):
    """A plate hinged at (-1, 0, 1.02), about y, pressed on a sphere in line with z: 1.3 from it."""
    target, k = 30.0, 1e4
    rows, _ = go(folder, f"servo torque y through -1 0 1.02 {target} vmax 0.3",
                 "hooke 1e4 NULL 20 NULL 0 0", at=1.02,
                 after="fix line all setforce 0 0 NULL\nvariable z equal z[1]\n", more="$(v_z:%.17g)",
                 steps=6000, mesh="lever.stl")
    settles("lever", rows, target)
    last = rows[-1]
    turn, x, z = last[PLACE], 1.3, last[MORE] - 1.02    # of the centre, from the hinge
    # Right-handed about y: what is at +x goes down. The plate's force is square to it, at this arm.
    arm = x * math.cos(turn) - z * math.sin(turn)
    fact("the lever has turned down", 0.01 < turn < 0.1, f"{turn:.4g}")
    at_most("the floor bears the torque over the arm",
            abs(k * (0.5 - last[MORE]) / (target / arm * math.cos(turn)) - 1), 1e-3)
    below = -(x * math.sin(turn) + z * math.cos(turn))    # of the centre, from the plate
    at_most("and the plate", abs(k * (0.5 - below) / (target / arm) - 1), 1e-3)
    # f_wall[4..6] is about the origin: T = about the hinge + hinge x F.
    hinge = -1 * 0 + 1.02 * last[1] - (-1) * last[3]
    at_most("the load is the torque about the hinge", abs(-(last[5] - hinge) / last[PUSH] - 1), 1e-12)


def test_ramp(folder):
    """A load that grows at the rate q: behind by q over gain x stiffness of the two contacts."""
    rate, dt = 40.0, 0.001
    rows, _ = go(folder, "servo force z v_load vmax 0.5", dt=dt, steps=4000, at=1.0,
                 before=f"variable load equal -10-{rate}*step*dt\n", more="$(v_load:%.17g)")
    # gain = 1/2 of 1/(k dt + 2 c), c = 20 m; two contacts in series are k/2.
    behind = 4 * rate * (dt + 2 * 20 * (math.pi / 3) / 1e4)
    off = rows[-1][PUSH] - rows[-1][MORE]
    # The load is of the step before: rate dt = 0.04, 5 % of it; and the speed damps, 2 c/k rate/2, 2 %.
    at_most("a ramp is followed", abs(off / behind - 1), 0.1)
    at_most("to 1e-2 of the load", abs(off / rows[-1][MORE]), 1e-2)
    # The load as a function of its own place: a spring of 500 before the piston.
    rows, _ = go(folder, "servo force z v_load vmax 0.5",
                 before="variable load equal -50-500*f_wall[12]\n", steps=6000)
    # 50 - 500 s = k (s - 0.05)/2
    s = (50 + 0.05 * 1e4 / 2) / (1e4 / 2 + 500)
    at_most("a spring before the piston", abs(rows[-1][PLACE] / -s - 1), 1e-3)


def test_limits(folder):
    rows, log = go(folder, "servo force z -50 vmax 0.5 limits -0.055 0", steps=3000,
                   end="fix_modify wall servo force z 5 vmax 0.5 limits -0.055 0\nrun 1000\n")
    told = [line for line in log.split("\n") if "the servo is at its limit" in line]
    stop = rows[3000]
    fact("it stops at its limit", stop[PLACE] == -0.055 and stop[SPEED] == 0)
    # 0.005 shared by two contacts of 1e4.
    at_most("where it pushes with k overlap/2", abs(stop[PUSH] / -25 - 1), 1e-3)
    fact("the log says so once a servo", len(told) == 2 and "-0.055" in told[0] and
         "instead of -50" in told[0] and "limit 0 at" in told[1], str(told))
    fact("and it comes back with another target, to the other limit", rows[-1][PLACE] == 0)
    fact("never past them", all(-0.055 <= row[PLACE] <= 0 for row in rows))


BED = """\
region          fill block -2.25 2.25 -2.25 2.25 0.6 5.6 units box
lattice         sc 0.75
create_atoms    1 region fill
"""


def bed(law, servo, top=6.2):
    """Spheres in a box of LAMMPS's walls under a piston. Contacts of spheres keep no springs."""
    return (BEGIN.format(create=BED, pair="gran/" + HOOKE)
            .replace("set             group all diameter 1.0 density 2.0",
                     "variable size atom 0.9+0.2*random(0,1,9)\nset group all diameter v_size\n"
                     "set group all density 2.0\n"
                     "velocity all create 1.0 4711 loop geom")
            .replace("atom_modify     map array sort 0 0", "atom_modify     map array")
            + lmp.flat_walls(f"fix floor all wall/gran {law} zplane 0 NULL\n"
                             "fix sides all wall/gran hooke 1e4 NULL 20 NULL 0 0 xplane -2.7 2.7\n"
                             "fix sides2 all wall/gran hooke 1e4 NULL 20 NULL 0 0 yplane -2.7 2.7")
            + "fix pull all gravity 8.0 vector 0 0 -1\n" + wall(law, servo, top))


def test_restart(folder):
    """In the middle of a compression, bit for bit; then with other words."""
    servo, at = "servo force z -200 vmax 2.0", "print 'at $(f_wall[12]:%.17g)'\n"
    text = bed(HISTORY, servo)
    begin = "timestep 0.002\nrun 1000\n"
    dump = ("dump d all custom 100 {0} id x y z vx vy vz v_p v_s v_l\n"
            "dump_modify d format float %.17g sort id\nrun 500\n")
    # f_wall[12] in an atom-style variable would be a column in 4Jul2026.
    names = "".join(f"variable {v}q equal f_wall[{k}]\nvariable {v} atom v_{v}q\n"
                    for v, k in (("p", 12), ("s", 13), ("l", 14)))

    def go_on(words, more="run 0\n" + at, name="r", start=lmp.run_well, ranks=1):
        rest = text[:text.index("region          box")] + f"read_restart {name}.restart\n" + text[text.index("pair_style"):]
        return start(rest.replace(servo, words) + "timestep 0.002\n" + more, folder, ranks)

    def told(log):
        return [float(x) for x in re.findall(r"^at (\S+)$", log, re.M)]

    for motion, ranks in (("motion wiggle 0.02 0 0 0.9 ", 1), ("motion wiggle 0.02 0 0 0.9 ", 2), ("", 2), ("", 1)):
        lmp.run_well(text.replace(servo, motion + servo) + names + begin + "write_restart r.restart\n" + dump.format("a"), folder, ranks)
        go_on(motion + servo, names + dump.format("b"), ranks=ranks)
        a, b = lmp.read_dump(folder / "a"), lmp.read_dump(folder / "b")
        travelled = abs(a[1500][1][6] - a[1000][1][6])
        fact(f"{motion}{ranks} ranks: the piston moves", travelled > 0.01, f"{travelled:.3g}")
        at_most(f"{motion}{ranks} ranks: continued to the bit", lmp.largest_difference(a, b), 0)

    log = go_on("servo force z -10 vmax 0.1")
    fact("another target goes on from there", "another line" not in log and told(log)[-1] < -0.1, str(told(log)))
    go_on("servo force z -10 vmax 0.1 limits -0.01 0", start=lambda rest, *_: lmp.refused(
        "narrower limits", rest, folder, "outside the limits -0.01 0"))
    log = go_on("servo force x 10 vmax 0.1")
    fact("another line is told of, and begins at 0", "with a servo along another line" in log and told(log) == [0])
    # Where it was stopped it is still, until it is told to go on; also one that a motion then took along.
    for more in ("", "fix_modify wall motion none\n"):
        first = told(lmp.run_well(text + begin + "fix_modify wall servo none\n" + more +
                                  "run 100\n" + at + "write_restart stopped.restart\n", folder))
        log = go_on(servo, f"run 200\n{at}fix_modify wall {servo}\nrun 200\n{at}", "stopped")
        then = told(log)
        fact("a servo that was stopped stays so", len(then) == 2 and first == then[:1], f"{first}, {then}")
        fact("and a warning tells of it", "the servo was stopped when" in log)
        fact("until fix_modify lets it go on", then[-1] < then[0], str(then))


def test_ranks(folder):
    """Sums over processes round in another order: 1e-16 of the load, which settles."""
    side = "".join(f"create_atoms 1 single {-5 + 1.1 * i:.1f} {-5 + 1.1 * j:.1f} {0.5 + 0.001 * (i - j)} "
                   "units box\n" for i in range(10) for j in range(10))
    first = go(folder, "servo force z -5000 vmax 0.5", HISTORY, side, steps=1000)[0]
    for n in (2, 4):
        rows = go(folder, "servo force z -5000 vmax 0.5", HISTORY, side, steps=1000, ranks=n)[0]
        apart = max(abs(a[PUSH] - b[PUSH]) for a, b in zip(first, rows)) / 5000
        at_most(f"{n} ranks as one: load", apart, 1e-12)
        apart = max(abs(a[PLACE] - b[PLACE]) for a, b in zip(first, rows))
        at_most(f"{n} ranks as one: place", apart, 1e-14)


def test_modified(folder):
    rows, log = go(folder, "servo force z -50 vmax 0.5", steps=2000,
                   end="fix_modify wall servo none\nrun 500\n"
                   "fix_modify wall servo force z -80 vmax 0.5\nrun 2000\n"
                   "fix_modify wall servo none motion linear 0.1 0 0\nrun 100\n"
                   "fix_modify wall motion none\n"
                   "fix_modify wall servo torque z 0 vmax 1\nrun 10\n")
    at = {int(row[0]): row for row in reversed(rows)}    # the end of one run, not where the next begins
    fact("servo none: it stays", at[2000][PLACE] == at[2500][PLACE] and at[2500][SPEED] == 0)
    at_most("another target: load", abs(at[4500][PUSH] / -80 - 1), 1e-3)
    at_most("another target: the place goes on", abs(at[4500][PLACE] / -(0.05 + 2 * 80 / 1e4) - 1), 1e-3)
    at_most("a motion begins where it stays", abs(at[4600][3] / 80 - 1), 1e-3)
    fact("the log tells of each", "servo force z -80 vmax 0.5" in log and "servo none" in log)
    # With a mesh at rest at first: another engine.
    text = (BEGIN.format(create=ONE, pair="zero 1.2") + FLOOR.format(law=HISTORY) + wall(HISTORY, "") +
            f"timestep {DT}\nrun 10\nfix_modify wall servo force z -50 vmax 0.5\n" +
            OUTPUTS.format(dt=DT, more="") + "run 2000\n")
    lmp.run_well(text, folder)
    settles("given later", lmp.read_rows(folder / "out.txt"), -50)
    # Beside a motion along the axis, which it takes back, and wear, whose output comes first.
    text = (BEGIN.format(create=ONE, pair="zero 1.2") + FLOOR.format(law=HOOKE) +
            wall(HOOKE, "motion linear 0.2 0 -0.1 servo force z -50 vmax 0.5 wear archard 1e-9 1") +
            f"timestep {DT}\nrun 1500\n" +
            "print 'ends $(f_wall[10]:%.6g) $(f_wall[12]:%.6g) $(f_wall[13]:%.6g) $(f_wall[14]:%.6g)'\n")
    words = [line for line in lmp.run_well(text, folder).split("\n") if line.startswith("ends ")][0].split()
    worn, place, speed, push = (float(w) for w in words[1:])
    fact("beside a motion: wear comes first", 0 < worn < 1e-6, words[1])
    at_most("it takes the motion's speed back", abs(speed / 0.1 - 1), 1e-3)
    # v = gain (target - push) must be 0.1: behind by 0.1/gain, gain = 1/2 of 1/(k dt + 2 c).
    behind = 0.1 * 2 * (1e4 * DT + 2 * 20 * math.pi / 3)
    at_most("with the error that its speed needs", abs((push + 50 + behind) / 50), 1e-3)
    at_most("and the mesh stays", abs((place - 0.1 * 1500 * DT) / (-0.05 + 2 * push / 1e4) - 1), 1e-3)


def test_refused(folder):
    text = BEGIN.format(create=ONE, pair="zero 1.2") + FLOOR.format(law=HOOKE)
    run, good = "run 0\n", wall(HOOKE, "servo force z -50 vmax 0.5")
    for name, words, says in (
            ("a variable that there is not", wall(HOOKE, "servo force z v_no vmax 1") + run, "there is no variable 'no'"),
            ("two of one word", wall(HOOKE, "servo force z 1 vmax 1 vmax 2"), "vmax is given twice"),
            ("through of a force", wall(HOOKE, "servo force z through 0 0 0 1 vmax 1"), "through is for servo torque only"),
            ("too many numbers", wall(HOOKE, "servo force z 1 2 vmax 1"), "'2' is one more than expected"),
            ("words of LIGGGHTS", wall(HOOKE, "vel_max 1"), "the keywords are servo force|torque"),
            ("limits behind it", good + "run 50\nfix_modify wall servo force z 1 vmax 1 limits -1e-6 0\n", "outside the limits"),
            ("fix_modify without a word", good + "fix_modify wall servo\n", "its value is missing"),
            ("another line beside a motion", wall(HOOKE, "motion linear 1 0 0 servo force z 1 vmax 1") +
             "fix_modify wall servo force x 1 vmax 1\n", "stop that motion first")):
        lmp.refused(name, text + words, folder, says)
    lmp.refused("along a periodic axis, at its face", text.replace("boundary        f f f", "boundary f f p")
                .replace("fix floor all wall/gran", "#") + wall(HOOKE, "servo force z -50 vmax 0.5", at=-0.9) + run, folder,
                "reaches the periodic face in z at step 0")
