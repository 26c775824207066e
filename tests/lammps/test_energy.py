# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The books of energy of a wall (keyword energy) against closed forms, and that they close."""

import math

import lmp
import stl
from facts import at_most, fact

prepare = lmp.flat_floor

CAUSES = ("damping", "slider", "rolling", "twisting", "adhesion")
OTHERS = ("lever_arms", "stiffness", "turned_springs", "inserted")
NAMES = (*(f"{c} power" for c in CAUSES), *CAUSES, *OTHERS, "work", "drive", "held", "remainder")
FIRST = 55    # column of the fix
COLUMNS = [f"f_wall[{FIRST + k}]" for k in range(len(NAMES))]

# The end of each script.
TELL = """\
timestep        {dt}
compute         move all ke
compute         spin all erotate/sphere
thermo_style    custom step c_move c_spin {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
{run}
"""

NO_HEAT_ON_GPU = "heat does not work for atoms on a GPU"

# A sphere of radius 0.5 and mass 1 above the floor, at x 0.3 off its seam.
SPHERE = lmp.head("-3 3 -3 3 -1 5") + """\
create_atoms    1 single {x} units box
set             group all diameter 1.0 mass 1
velocity        all set {v} units box
pair_style      zero 1.2
pair_coeff      * *
{move}
fix             wall all wall/lsdcd {law} mesh floor.stl energy
""" + TELL


def books(folder, law, dt, run, x="0.3 0.2 0.4", v="0 0 0", move="fix move all nve/sphere", ranks=1):
    """The last row of the run."""
    return row_of(lmp.run_well(filled(law, dt, run, x, v, move), folder, ranks))


def filled(law, dt, run, x, v, move="fix move all nve/sphere"):
    return SPHERE.format(x=x, v=v, move=move, law=law, dt=repr(dt), columns=" ".join(COLUMNS), run=run)


def row_of(text):
    row = lmp.read_thermo(text)[-1]
    return dict(zip(("step", "ke", "spin", *NAMES), row))


def close(name, value, wanted, size, tolerance):
    at_most(f"{name}: {value:.9g} is {wanted:.9g}", abs(value - wanted) / size, tolerance)


def nothing_but(book, size, *names, least=1e-12):
    """All other rows of losses are 0."""
    others = {k: book[k] for k in (*CAUSES, *OTHERS) if k not in names and abs(book[k]) > least * size}
    fact(f"nothing is lost but by {', '.join(names) or 'nothing'}", not others, others or "")


E = 0.5


def check_bounces(falls, half, check):
    """What books find of bounces with a restitution of 0.5. falls(n): the last rows of 8 with n steps a contact, each of which begins another eighth of a
    step later, as touch falls anywhere within a step; `half`: their m v^2/2; check(n, row): what else holds for each.

    The books do not find what the step has in which the sphere comes: k d (v dt - d)/2 for an overlap d there, v dt/12 k v dt on average, and e^2 of that
    as it leaves."""
    means = {}
    for n in (25, 50, 100, 200):
        rows = list(falls(n))
        means[n] = sum(r["remainder"] for r in rows) / 8 / half
        for r in rows:
            check(n, r)
            nothing_but(r, half, "damping")
        if n == 200:
            close("a bounce loses", rows[0]["damping"] / half, 1 - E ** 2, 1, 0.01)
    print("remainders over m v^2/2:", means)
    for n in (25, 50, 100):
        close(f"the remainder falls with dt^2 from {n} steps on", means[n] / means[2 * n], 4, 4, 0.1)
    at_most("at 25 steps a contact it is below k (v dt)^2/8 at both ends", abs(means[25]), 2 * (math.pi / 25) ** 2 / 4)


def test_bounce(folder):
    """A sphere that falls onto the floor at speed 1 loses 0.75 m v^2/2 by damping; contacts of linear springs last pi/w."""
    kn, ln_e = 1e4, math.log(E)
    gamma = -2 * ln_e / math.sqrt(math.pi ** 2 + ln_e ** 2) * math.sqrt(kn)    # of the velocity, over the mass

    def falls(n):
        dt = math.pi / math.sqrt(kn - gamma ** 2 / 4) / n
        return map(row_of, lmp.run_in_a_row([filled(f"hooke {kn} NULL {gamma!r} NULL 0 0", dt, f"run {3 * n}", f"0.3 0.2 {0.5 + (5 + k / 8) * dt!r}", "0 0 -1")
                                             for k in range(8)], folder))
    check_bounces(falls, 0.5, lambda n, r: at_most(f"{n} steps: energy that is lost, and the change of kinetic energy",
                                                   abs(r["work"] - (0.5 - r["ke"])), 1e-12))


def test_ways_to_leave(folder):
    """The work of a bounce is the kinetic energy that it takes, wherever lists of what is near end: without a skin, and with a group whose
    grains change, the grain that leaves the wall is near it no longer in that step."""
    law = "hooke/history 1e4 NULL 20 NULL 0.5 1"
    for name, move, of in (("a skin", "", "all"), ("no skin", "neighbor 0 bin\n", "all"), ("a dynamic group", "group near dynamic all every 1\n", "near")):
        script = SPHERE.replace("fix             wall all", f"{move}fix             wall {of}").replace("0.5 1.2", "0.5")
        for z in ("0.5", "0.5003", "0.5007"):
            text = script.format(x=f"0.3 0.2 {z}", v="0.4 0 -1", move="fix move all nve/sphere", law=law, dt="1e-3", columns=" ".join(COLUMNS), run="run 60")
            b = row_of(lmp.run_well(text, folder))
            at_most(f"{name}, {z}: work", abs(b["work"] - (0.58 - b["ke"] - b["spin"])), 1e-12)
            fact(f"{name}, {z}: it has left, and nothing was inserted", b["held"] == 0 == b["inserted"] and b["damping"] > 0.1, b)


WAYS = {"a skin": "", "lists when due": "neigh_modify delay 0 every 1 check yes\n", "lists each 20": "neigh_modify delay 0 every 20 check no\n", "no skin": "neighbor 0 bin\n", "a dynamic group": "group near dynamic all every 1\n"}


def test_fast_grain(folder):
    """A grain that slides over the end of a plate and is far from it a step later has no work that is not booked."""
    stl.write(folder / "plate.stl", stl.quad((-9, -1, 0), (1, -1, 0), (1, 1, 0), (-9, 1, 0)))
    stl.write(folder / "other.stl", stl.quad((-9, -1, 4), (1, -1, 4), (1, 1, 4), (-9, 1, 4)))
    for speed in (60, 400):
        for name, way in WAYS.items():
            for meshes in ("mesh plate.stl", "mesh plate.stl mesh other.stl"):
                script = SPHERE.replace("-3 3 -3 3 -1 5", "-9 9 -3 3 -1 5").replace("mesh floor.stl", meshes)
                script = script.replace("fix             wall all", f"{way}fix             wall {'near' if 'near' in way else 'all'}")
                # The third place is at 1.05, the second to touch at least. The arm of friction is that of slip.
                text = script.format(x=f"{1.05 - 3 * 5e-3 * speed} 0.2 0.5003", v=f"{speed} 0 -1", move="fix move all nve/sphere", law="hooke 1000 NULL 20 NULL 0.5 1",
                                     dt="5e-3", columns=" ".join(COLUMNS), run="run 5")
                b = row_of(lmp.run_well(text, folder))
                where = f"speed {speed}, {name}, {meshes}"
                # Rounded numbers of the size of the kinetic energy are subtracted.
                at_most(f"{where}: work", abs(b["work"] - (0.5 * (speed**2 + 1) - b["ke"] - b["spin"])), 1e-15 * speed**2)
                fact(f"{where}: it has left, and nothing was inserted", b["held"] == 0 == b["inserted"] and b["work"] > 1, b)


def test_forces_on_fast_grains(folder):
    """Grains that go up to twice their radius in a step touch a wall at the same places whatever lists there are, with and without books."""
    stl.write(folder / "plate.stl", stl.sheet(5, lambda i, j: (-4 + 1.6 * i, -4 + 1.6 * j, 0.3 * (i % 2) * (j % 2))))
    places = {}
    for name, way in WAYS.items():
        for energy in ("", " energy"):
            lmp.run_well(lmp.head("-4 4 -4 4 -1 9") + f"""\
create_atoms 1 random 200 4711 NULL
set group all diameter 0.5 mass 1
velocity all create 1e4 8177 loop geom
pair_style zero 1.2
pair_coeff * *
{way}fix move all nve/sphere
fix box all wall/reflect xlo EDGE xhi EDGE ylo EDGE yhi EDGE zlo EDGE zhi EDGE
fix wall {'near' if 'near' in way else 'all'} wall/lsdcd hooke/history 1e5 NULL 20 NULL 0.5 1 mesh plate.stl{energy}
timestep 1e-3
dump d all custom 200 out id x y z vx vy vz fx fy fz omegax omegay omegaz
dump_modify d format float %.17g sort id
run 200
""", folder)
            places[name + energy] = lmp.read_dump(folder / "out")
    first = places.pop("no skin")
    fact("grains turn", sum(row[9] != 0 for row in first[200].values()) > 20, "")
    for name, there in places.items():
        at_most(name, lmp.largest_difference(first, there), 0)


def test_many_setups(folder):
    """A grain that slips, rolls and twists as it bounces on a slope: what it holds does not change where a run begins anew, so that nothing
    is inserted, and books of 40 runs close as those of one."""
    move = "fix move all nve/sphere\nset group all omega 3 -20 8\nfix g all gravity 50 vector 0.4 0 -1"
    for law in ("hooke/history 1e4 4e3 60 NULL 0.3 1 rolling epsd2 0.2", "granular hooke 1e4 60 damping mass_velocity tangential linear_history 4e3 1 0.3 "
                "rolling sds 1e3 0.1 0.02 twisting sds 30 0.1 0.002", "granular hertz 1e5 60 damping mass_velocity tangential mindlin_rescale/force 1e5 1 0.3 "
                "rolling epsd 0.2 0.1", "granular hertz 1e5 60 damping mass_velocity tangential linear_history_liggghts 4e3 1 0.3"):
        one, many = (books(folder, law, 2e-4, run, v="3 0 -1", x="0.3 0.2 0.51", move=move) for run in ("run 2000", "run 50\n" * 40))
        lost = sum(one[c] for c in CAUSES)
        close(f"{law}: inserted", many["inserted"], one["inserted"], lost, 1e-12)
        at_most(f"{law}: remainders", max(abs(b["remainder"]) for b in (one, many)) / lost, 1e-3)


@lmp.of_host
def test_friction_heat(folder):
    """The heat that fix heat/flow adds up in grains that hop along a belt and into a paddle is the share of what sliders lose, over runs with
    a setup and without, behind a restart and on 2 processes."""
    stl.write(folder / "belt.stl", stl.sheet(5, lambda i, j: (-4 + 1.6 * i, -4 + 1.6 * j, 0)))
    stl.write(folder / "paddle.stl", stl.quad((-2, 0, 0), (2, 0, 0), (2, 0, 2), (-2, 0, 2)))
    heats = "fix heats all property/atom temperature heatflow ghost yes\n"
    head = lmp.head("-4 4 -4 4 -1 6") + heats + """\
lattice         sc 0.5
region          fill block -2.5 2.5 -2.5 2.5 0.6 2 units box
create_atoms    1 region fill
set             group all diameter 1 mass 2 temperature 1
velocity        all create 8 11 loop geom
velocity        all set NULL NULL -12 sum yes
"""
    rest = lmp.pairs() + """\
fix             move all nve/sphere
fix             sides all wall/reflect xlo -3.4 xhi 3.4 ylo -3.4 yhi 3.4 units box
fix             wall all wall/lsdcd granular hertz/material 5e5 0.3 0.3 tangential mindlin NULL 1 0.4 damping tsuji heat area 0 energy friction_heat 0.6 &
                mesh belt.stl temperature 1 surface_vel 3 0 0 mesh paddle.stl temperature 1 motion rotate 0 0 0 0 0 1 1
fix             flow all heat/flow constant 1.5
timestep        4e-5
compute         warmth all property/atom temperature
variable        gained atom 1.5*mass*(c_warmth-1)
compute         heat all reduce sum v_gained
thermo_style    custom step c_heat f_wall[61]
thermo_modify   format float %.17g norm no
thermo          100000
"""
    if lmp.ON_GPU:
        return lmp.refused("heat on a GPU", head + rest + "run 1\n", folder, NO_HEAT_ON_GPU)
    for ranks in (1, 2):
        lmp.run_well(head + rest + "run 1100\nrun 300 pre no\nwrite_restart half.restart\n", folder, ranks)
        again = "newton off\nread_restart half.restart\ncomm_modify vel yes\n" + heats + rest + "run 600\nrun 300\n"
        heat, lost = lmp.read_thermo(lmp.run_well(again, folder, ranks))[-1][1:]
        fact(f"{ranks}: grains slide", lost > 1, lost)
        close(f"{ranks}: heat over 0.6 of what sliders lose", heat / (0.6 * lost), 1, 1, 1e-11)    # temperatures near 1 are rounded


def test_respa(folder):
    """Velocities are not the same in a whole step of respa, so that its work is not that of the books."""
    text = SPHERE.format(x=DOWN, v="0 0 0", move="fix move all nve/sphere", law="hooke 1e4 NULL 20 NULL 0 0", dt="1e-4", columns=" ".join(COLUMNS),
                         run="run_style respa 2 2 pair 1\nrun 1")
    lmp.refused("respa", text, folder, "use run_style verlet, or leave out energy")


HELD = "fix move all move linear {v} units box"
KN, OVERLAP = 1e4, 0.01
PRESS = KN * OVERLAP
DOWN = "0.3 0.2 0.49"


def test_block_that_slides(folder):
    """mu F s, by the slider alone, once the spring is stretched: what it holds is k h^2/2 with k h = mu F."""
    mu, kt, v, dt, n = 0.3, 4e3, 0.7, 1e-4, 4000
    granular = f"granular hooke {KN} 20 damping mass_velocity tangential"
    # What the dashpot takes of the limit where it limits the sum: the mass is 1.
    for law, dashpot in ((f"hooke/history {KN} {kt} 20 10 {mu} 1", 10 * v), (f"{granular} linear_history {kt} 1 {mu}", 20 * v),
                         (f"{granular} linear_history_slip {kt} 1 {mu}", 0), (f"{granular} linear_history_liggghts {kt} 1 {mu}", 0)):
        b = books(folder, law, dt, f"run {n}\nrun {n}", x=DOWN, move=HELD.format(v=f"{v} 0 0"))
        lost = mu * PRESS * v * dt * 2 * n
        # The first part of the way stretches the spring; the step in which it ends may be a step off.
        close(f"{law}: slider", b["slider"], lost - mu * PRESS * (mu * PRESS - dashpot) / kt, lost, 1 / (2 * n))
        close(f"{law}: power of the slider", b["slider power"], mu * PRESS * v, mu * PRESS * v, 1e-9)
        at_most(f"{law}: power of damping", abs(b["damping power"]), 1e-9 * mu * PRESS * v)
        close(f"{law}: the books close", b["remainder"], 0, lost, 1e-11)


def test_from_slip_to_rolling(folder):
    """A sphere that slides and comes to roll keeps 5/7 of its energy."""
    v, mu, g = 1.0, 0.3, 100.0
    b = books(folder, f"hooke/history {KN} 1e4 0 100 {mu} 1", 2e-5, "run 4000", x=f"-1 0.2 {0.5 - g / KN!r}", v=f"{v} 0 0",
              move=f"fix move all nve/sphere\nfix g all gravity {g} vector 0 0 -1")
    half = 0.5 * v * v
    close("energy that is left", b["ke"] + b["spin"], 5 / 7 * half, half, 1e-3)
    close("loss", b["slider"] + b["damping"], 2 / 7 * half, half, 1e-3)
    at_most("the books close", abs(b["remainder"]) / half, 1e-11)
    nothing_but(b, half, "slider", "damping", "inserted")


def test_archard_and_the_slider(folder):
    """Archard's V = K/H F_n s has the way that the slider has: it is K/(H mu) times what that loses where friction is limited by mu F_n, and the same
    without books. A sphere on a belt slips until it rolls; one that sticks to a belt that swings by less than friction holds wears nothing."""
    mu, g = 0.3, 100.0
    per_work = 1e-3 / 50
    hertz, deep = "granular hertz 1e6 50 damping velocity tangential", (g / (1e6 * math.sqrt(0.5))) ** (2 / 3)
    slow = f"fix move all nve/sphere\nfix g all gravity {g} vector 0 0 -1"
    # It begins where its weight is borne. With LAMMPS's friction a dashpot would lose along the way of the spring, too, in the slider's row.
    for law, z in ((f"hooke/history {KN} 1e4 60 0 {mu} 1", 0.5 - g / KN), (f"{hertz} mindlin 1e6 0 {mu}", 0.5 - deep),
                   (f"{hertz} mindlin_liggghts 1e6 0.2 {mu}", 0.5 - deep)):
        both = []
        for words in ("energy", ""):
            columns = [*COLUMNS, "f_wall[10]"] if words else ["f_wall[10]"]
            script = SPHERE.replace("mesh floor.stl energy", f"mesh floor.stl wear archard 1e-3 50 {words} surface_vel 1 0 0")
            rows = lmp.read_thermo(lmp.run_well(script.format(x=f"-1 0.2 {z!r}", v="0 0 0", law=law, dt="2e-5", columns=" ".join(columns),
                                                             move=slow, run="run 1000\nrun 500"), folder))
            both.append(rows[-1])
        slider, worn = dict(zip(("step", "ke", "spin", *NAMES), both[0]))["slider"], both[0][-1]
        fact(f"{law}: it slides", slider > 0.05, slider)
        # The first step has the mean of no force and all of it with the slider, and all of it with wear: half of one of some 500 steps of slip.
        close(f"{law}: times mu H/K the slider's", worn * mu / per_work, slider, slider, 2e-3)
        close(f"{law}: without books", both[1][-1], worn, worn, 1e-12)
    # Swung by 1e-5: a spring of 1e4 holds 0.1 of the 30 that friction does.
    script = SPHERE.replace("mesh floor.stl energy", "mesh floor.stl wear archard 1e-3 50 energy motion wiggle 1e-5 0 0 0.02")
    row = lmp.read_thermo(lmp.run_well(script.format(x=f"0.3 0.2 {0.5 - g / KN!r}", v="0 0 0", law=f"hooke/history {KN} 1e4 60 0 {mu} 1", dt="2e-5",
                                                     columns="f_wall[10]", move=slow, run="run 4000"), folder))[-1]
    fact("what sticks wears nothing", row[3] == 0, row)


def test_rolling_and_twisting(folder):
    """A sphere that is turned where it lies: mu F R angle by rolling, mu F angle by twisting, less what the springs hold."""
    w, dt, n = 2.0, 1e-4, 5000
    angle = w * dt * n
    law = f"granular hooke {KN} 20 damping mass_velocity tangential linear_history 0 0 0 rolling {{rolling}} twisting {{twisting}}"
    half = 0.495 / 0.49    # LIGGGHTS turns its springs faster: (R - d/2)/(R - d)
    for model, row, moment, k, dashpot, faster in (
            ("sds 5e3 0.1 0.2", "rolling", 0.2 * PRESS * 0.5, 5e3 * 0.25, 0.1 * 0.25, 1), ("cdt 0.2", "rolling", 0.2 * PRESS * 0.5, 0, 0, 1),
            ("epsd 0.2 0.1", "rolling", 0.2 * PRESS * 0.5, 225, 0.2 * math.sqrt(1.4 * 0.25 * 225), half),
            ("sds 30 0.1 0.02", "twisting", 0.02 * PRESS, 30, 0.1, 1)):
        axis = "1 0 0" if row == "rolling" else "0 0 1"
        words = law.format(rolling=model if row == "rolling" else "none", twisting=model if row == "twisting" else "none")
        b = books(folder, words, dt, f"run {n}", x=DOWN, move=f"fix move all move rotate 0.3 0.2 0.49 {axis} {2 * math.pi / w!r} units box")
        # The spring takes the first part of the angle, beside the dashpot; sds limits their sum. It holds k first^2/2.
        held = moment - (dashpot * w if faster == 1 else 0)
        first = held / k if k else 0
        spring = k * first ** 2 / 2
        wanted = (spring + dashpot * faster * w * first) / faster - spring + moment * (angle - first / faster)
        lost = moment * angle
        close(f"{model}: loss of {row} and lever arms", b[row] + b["lever_arms"], wanted, lost, 2e-4)
        close(f"{model}: power", b[f"{row} power"], moment * w * faster, moment * w, 1e-9)
        close(f"{model}: the books close", b["remainder"], 0, lost, 1e-11)
        nothing_but(b, lost, row, "inserted", *(["lever_arms"] if faster > 1 else []))


def jkr_force(d, modulus, gamma, r):
    """The elastic force of JKR's contact at an overlap, by bisection for the contact radius, of the branch that holds."""
    def overlap(a):
        return a * a / r - 2 * math.sqrt(math.pi * gamma * a / modulus)
    lo = (math.pi * gamma * r * r / (4 * modulus)) ** (1 / 3)    # where the overlap is least
    hi = 10 * r
    for _ in range(200):
        mid = (lo + hi) / 2
        lo, hi = (mid, hi) if overlap(mid) < d else (lo, mid)
    a = (lo + hi) / 2
    return 4 * modulus * a ** 3 / (3 * r) - 4 * math.sqrt(math.pi * gamma * modulus * a ** 3)


def test_loop_of_jkr(folder):
    """A sphere that is pressed to the wall and pulled off: both steps of the adhesion sum to the integral of the force from the
    pull-off to the touch. The force jumps there, where a step counts by dt/2."""
    young, nu, gamma, r = 1e6, 0.25, 50.0, 0.5
    modulus = young / (2 * (1 - nu ** 2))
    let_go = -(3 * math.pi ** 2 * gamma ** 2 * r / (16 * modulus ** 2)) ** (1 / 3)
    n = 4000
    at = [let_go * (k + 0.5) / n for k in range(n)]
    integral = -sum(jkr_force(d, modulus, gamma, r) for d in at) * -let_go / n    # work to pull off
    errors = []
    for dt in (2e-4, 1e-4):
        v = 0.05
        steps = round(0.06 / v / dt)
        b = books(folder, f"granular jkr {young} 0 {nu} {gamma} damping velocity tangential linear_nohistory 0 0", dt,
                  f"run {steps}\nunfix move\nfix move all move linear 0 0 {v} units box\nrun {3 * steps}", x="0.3 0.2 0.53",
                  move=HELD.format(v=f"0 0 {-v}"))
        close(f"dt {dt}: adhesion", b["adhesion"], integral, integral, 1e-5)
        nothing_but(b, integral, "adhesion")
        jump = 3 * math.pi * gamma * r * v * dt    # both jumps, at most half of that each
        at_most(f"dt {dt}: remainder", abs(b["remainder"]), jump)
        errors.append(b["remainder"])
    fact("held at the end", b["held"] == 0, b["held"])


def test_stiffness(folder):
    """A spring that is stretched by h and then unloaded: with mindlin its stiffness falls with the contact radius, and the energy
    (k1 - k2) h^2/2 is lost; mindlin/force keeps the force, so that (1/k2 - 1/k1) F^2/2 comes from nowhere."""
    k_t, r, h = 3e4, 0.5, 1e-4
    deep, shallow = 0.01, 0.005
    k1, k2 = (k_t * math.sqrt(r * d) for d in (deep, shallow))
    force = k1 * h
    dt, n = 1e-5, 1000
    for word, wanted in (("mindlin", (k1 - k2) * h * h / 2), ("mindlin/force", (1 / k1 - 1 / k2) * force ** 2 / 2)):
        b = books(folder, f"granular hertz 1e6 0 damping velocity tangential {word} {k_t} 0 100", dt,
                  f"run {n}\nunfix move\nfix move all move linear 0 0 {(deep - shallow) / dt / n!r} units box\nrun {n}", x=f"0.3 0.2 {r - deep!r}",
                  move=HELD.format(v=f"{h / dt / n!r} 0 0"))
        close(f"{word}: stiffness", b["stiffness"], wanted, abs(wanted), 1e-6)
        nothing_but(b, abs(wanted), "stiffness", "inserted", least=1e-9)
        # Of the elastic force F = k d^1.5, whose energy is 2.83, the trapezoid leaves dt^2 F'' v^2/12 = F''/F (change of d)^2/n^2/12.
        at_most(f"{word}: the books close", abs(b["remainder"]) / (0.4 * 1e6 * math.sqrt(r * deep) * deep ** 2), 1e-7)


def test_belt(folder):
    """A sphere that is held on a belt: the belt's work is mu F v t, and the slider has it."""
    mu, v, dt, n = 0.4, 0.8, 1e-4, 3000
    b = books(folder, f"hooke {KN} NULL 0 1e6 {mu} 1", dt, f"run {n}", x=DOWN, move=HELD.format(v="0 0 0"))
    nothing_but(b, 1, "inserted")
    text = SPHERE.replace("floor.stl energy", f"floor.stl surface_vel {v} 0 0 energy")
    b = row_of(lmp.run_well(text.format(x=DOWN, v="0 0 0", move=HELD.format(v="0 0 0"), law=f"hooke {KN} NULL 0 1e6 {mu} 1", dt=dt,
                                        columns=" ".join(COLUMNS), run=f"run {n}"), folder))
    lost = mu * PRESS * v * dt * n
    # A setup keeps its forces, so that the first step is whole.
    close("slider", b["slider"], lost, lost, 1e-9)
    close("work of the belt", b["drive"], lost, lost, 1e-9)
    close("the books close", b["remainder"], 0, lost, 1e-11)


RIDE = lmp.head("-3 3 -3 3 -1 5") + """\
create_atoms    1 single {x} units box
set             group all diameter 1.0 mass 1
pair_style      zero 1.2
pair_coeff      * *
fix             move all {move}
{words}
fix             wall all wall/lsdcd {law} mesh floor.stl {motion} energy
{after}
""" + TELL
LIFT, PERIOD = 0.002, 0.25    # at most 1.3 of gravity's 10: the grain stays on the floor
SHAKES = {
    "wiggle": f"motion wiggle 0 0 {LIFT} {PERIOD}",
    "a table": "motion table lift.txt",
    "straight rows": "motion table lift.txt linear",
    "places": "motion variable NULL NULL v_z NULL NULL NULL",
    "velocities": "motion variable NULL NULL NULL NULL NULL v_vz",
    "both": "motion variable NULL NULL v_z NULL NULL v_vz",
}


def ride(folder, motion, law, dt, n, x="0.3 0.2 0.499", move="nve/sphere", after="fix down all gravity 10 vector 0 0 -1"):
    """The last row of n steps of a grain on a floor that moves, and what the grain has gained: with its velocities of whole steps the half kick of a force F
    is in them, whose energy (dt F)^2/8 the work of whole steps does not have. `after`: what acts after the wall."""
    words = f"""\
variable        z equal {LIFT}*sin({2 * math.pi / PERIOD!r}*step*{dt!r})
variable        vz equal {LIFT * 2 * math.pi / PERIOD!r}*cos({2 * math.pi / PERIOD!r}*step*{dt!r})
variable        speed equal 0.2*step*{dt!r}
variable        high equal z[1]
variable        push equal fx[1]^2+fy[1]^2+fz[1]^2
"""
    columns = " ".join((*COLUMNS, "v_high", "v_push"))
    text = lmp.run_well(RIDE.format(x=x, move=move, words=words, law=law, motion=motion, after=after, dt=repr(dt), columns=columns, run=f"run {n}"), folder)
    row, (high, push) = row_of(text), lmp.read_thermo(text)[-1][-2:]
    return row, row["ke"] + row["spin"] - dt ** 2 * push / 8 + 10 * (high - float(x.split()[2])) + row["held"] + row["inserted"]


def test_walls_that_shake(folder):
    """The work of a floor whose speed varies is the energy that a grain on it gains, where nothing is lost: its velocity in a step is the way
    that it goes in it, over dt. So the work of a linear spring is exact, whatever dt is."""
    rows = "".join(f"{k * PERIOD / 40!r} 0 0 {LIFT * math.sin(2 * math.pi * k / 40)!r}\n" for k in range(60))
    (folder / "lift.txt").write_text(rows)
    for name, motion in SHAKES.items():
        for n in (25, 100):
            dt = 2 * math.pi / 100 / n
            b, gained = ride(folder, motion, "hooke 1e4 NULL 0 NULL 0 0", dt, round(0.2 / dt))
            fact(f"{name}, {n} steps a swing: the floor has worked", abs(b["drive"]) > 1e-3, b)
            at_most(f"{name}, {n}: work of the floor over what the grain has gained",
                    abs(b["drive"] - gained) / abs(b["drive"]), 1e-10)
            at_most(f"{name}, {n}: remainder", abs(b["remainder"]) / abs(b["drive"]), 1e-10)


def test_wall_that_riggles(folder):
    """A floor that turns to and fro below a grain: the way of a point of it is the mean velocity of the step up to dt^2."""
    errors = []
    for n in (25, 50, 100, 200):
        dt = 2 * math.pi / 100 / n
        b, gained = ride(folder, "motion riggle -1 0 0 0 1 0 0.1 0.25", "hooke 1e4 NULL 0 NULL 0 0", dt, round(0.2 / dt))
        fact("the floor has worked", abs(b["drive"]) > 1e-3, b)
        errors.append((b["drive"] - gained) / b["drive"])
    print("errors of the work:", errors)
    for one, other in zip(errors, errors[1:]):
        fact("it falls with dt^2", 3.8 < one / other < 4.2, errors)


def test_belt_that_speeds_up(folder):
    """A grain that does not turn hangs on a belt by the spring of friction, and the belt speeds up at 0.2 from rest: x'' = w^2 (a t^2/2 - x), so that
    the belt has worked m a^2 (t^2/2 - t sin(w t)/w + (1 - cos(w t))/w^2)."""
    a, k, t = 0.2, 400.0, 0.4
    w = math.sqrt(k)
    wanted = a * a * (t * t / 2 - t * math.sin(w * t) / w + (1 - math.cos(w * t)) / w ** 2)
    errors = []
    for n in (20, 40, 80):
        b, _ = ride(folder, "surface_vel v_speed 0 0", f"hooke/history 1e4 {k} 0 0 100 0", t / n / 4, 4 * n, x="0.3 0.2 0.49", move="nve",
                    after="fix high all setforce NULL NULL 0")
        errors.append(b["drive"] - wanted)
    print("errors of the work:", errors, wanted)
    for one, other in zip(errors, errors[1:]):
        fact("they fall with dt^2", 3.8 < one / other < 4.2, errors)
    at_most("at 80 steps", abs(errors[-1]) / wanted, 1e-3)


# ---- springs of a stiffness that goes to 0 -----------------------------------------------

def aslant(folder, law, dt, z):
    """The last row of one bounce of a ball that comes aslant."""
    return books(folder, law, dt, f"run {round(0.08 / dt)}", x=f"0.3 0.2 {z!r}", v="1 0 -1")


def test_springs_that_only_make_up_for_a_dashpot(folder):
    """As the overlap goes to 0, so does the stiffness of mindlin, and LAMMPS's form leaves its spring what the dashpot is beyond the limit: F^2/2k
    would have no bound. Rows of slider and stiffness converge, for whatever the overlap of the first step is."""
    for law in ("granular hertz 1e5 5 damping velocity tangential mindlin 1e5 1 0.2", "granular hertz 1e5 0.5 damping tsuji tangential mindlin 1e5 1 0.2",
                "hertz/history 1e5 1e5 20 40 0.2 0"):
        rows = {}
        for dt in (2e-4, 1e-4, 5e-5, 2.5e-5):
            # The last fall of each touches by as little as a double can.
            touches = [0.5 + (3 + k / 4) * dt for k in range(4)] + [0.5 + 4 * dt - 1e-16]
            rows[dt] = [aslant(folder, law, dt, z) for z in touches]
            for b in rows[dt]:
                at_most(f"{law}, {dt}: no row exceeds the energy", max(abs(b[n]) for n in ("slider", "stiffness", "damping")), 1)
                fact(f"{law}, {dt}: the slider gains nothing", b["slider"] > 0, b)
        for name in ("slider", "stiffness"):
            means = [sum(b[name] for b in of) / len(of) for of in rows.values()]
            spread = max(b[name] for b in rows[2.5e-5]) - min(b[name] for b in rows[2.5e-5])
            print(law, name, means, spread)
            # Where a contact begins to slide or to stick, a step's part of its work is in the one row or in the other: a contact has 300 steps of 5e-5.
            at_most(f"{law}: {name} at the two smallest timesteps", abs(means[-1] - means[-2]), 1 / 300)


def test_such_a_spring_in_a_restart(folder):
    """A contact whose spring is no store of energy is saved as that: rows go on to the last bit."""
    law = "granular hertz 1e5 5 damping velocity tangential mindlin 1e5 1 0.2"
    words = dict(law=law, dt="1e-4", columns=" ".join(COLUMNS))
    begin = SPHERE.format(x="0.3 0.2 0.50035", v="1 0 -1", move="fix move all nve/sphere", run="run 6\nwrite_restart half.restart\nrun 0\nrun 300", **words)
    whole = row_of(lmp.run_well(begin, folder))
    rest = "newton off\nread_restart half.restart\ncomm_modify vel yes\npair_style zero 1.2\npair_coeff * *\nfix move all nve/sphere\n" + \
        f"fix wall all wall/lsdcd {law} mesh floor.stl energy\n" + TELL.format(run="run 300", dt="1e-4", columns=words["columns"])
    again = row_of(lmp.run_well(rest, folder))
    fact("the slider has lost", whole["slider"] > 0.1, whole)
    fact("rows are the same", whole == again, {k: (whole[k], again[k]) for k in whole if whole[k] != again[k]})


@lmp.of_host
def test_heat_of_a_slider(folder):
    """A ball that touches by 1e-17 becomes warmer by what its slider loses, about 0.13 of 1, though its spring has no stiffness in that step."""
    text = SPHERE.replace("create_atoms", "fix heats all property/atom temperature heatflow ghost yes\ncreate_atoms").replace("mass 1\n", "mass 1 temperature 1\n")
    text = text.replace("floor.stl energy", "floor.stl temperature 1 energy friction_heat 1\nfix flow all heat/flow constant 1\n"
                        "compute T all property/atom temperature\ncompute hot all reduce max c_T")
    text = text.replace("custom step", "custom step c_hot")
    for dt in (5e-5, 2.5e-5, 1.25e-5):
        script = text.format(x="0.3 0.2 0.501", v="1 0 -1", move="fix move all nve/sphere", dt=repr(dt), columns=" ".join(COLUMNS),
                             run=f"run {round(0.08 / dt)}", law="granular hertz 1e5 5 damping velocity tangential mindlin 1e5 1 0.2 heat area 0")
        if lmp.ON_GPU:
            return lmp.refused("heat on a GPU", script, folder, NO_HEAT_ON_GPU)
        hot = [row[1] for row in lmp.read_thermo(lmp.run_well(script, folder))]
        fact(f"{dt}: it has become warmer", 1.1 < hot[-1] < 1.2, hot[-1])


# ---- bodies, servos, several meshes ------------------------------------------------------

BODY = "body mass {mass} com 0 0 0 inertia 1 1 1 0 0 0 joint slider {axis} {more}"
KINETIC = "f_wall[35]"    # of the body


def with_body(folder, law, dt, run, words, x=DOWN, v="0 0 0", move="fix move all nve/sphere", script=SPHERE):
    """The last row, with the kinetic energy of the body, `body`."""
    text = script.replace("mesh floor.stl energy", f"mesh floor.stl {words} energy")
    text = text.format(x=x, v=v, move=move, law=law, dt=repr(dt), columns=" ".join([*COLUMNS, KINETIC]), run=run)
    row = lmp.read_thermo(lmp.run_well(text, folder))[-1]
    return dict(zip(("step", "ke", "spin", *NAMES, "body"), row))


def test_body_that_is_braked(folder):
    """A plate that slides below a sphere which presses it down, held by its slider: it loses mu F s."""
    mu, v, mass, dt, n = 0.3, 0.7, 500.0, 1e-4, 4000
    words = BODY.format(mass=mass, axis="1 0 0", more=f"velocity {v} 0 0")
    b = with_body(folder, f"hooke {KN} NULL 0 1e3 {mu} 1", dt, f"run {n}", words, move=HELD.format(v="0 0 0"))
    half, force, t = 0.5 * mass * v * v, mu * PRESS, dt * n
    way = v * t - 0.5 * force / mass * t * t
    close("loss", b["slider"], force * way, force * way, 1e-9)
    close("what the body loses", half - b["body"], force * way, half, 1e-9)
    close("the work of the mesh is that", b["drive"], half - b["body"], half, 1e-9)
    close("the books close", b["remainder"], 0, force * way, 1e-11)
    nothing_but(b, half, "slider", "inserted")


def test_bounce_off_a_body(folder):
    """A sphere of mass 1 that hits a plate of mass 3, with a restitution of 0.5: (1 - e^2) m_e v^2/2 is lost, with m_e = 3/4."""
    kn, ln_e, mass = 1e4, math.log(E), 0.75
    gamma = -2 * ln_e / math.sqrt(math.pi ** 2 + ln_e ** 2) * math.sqrt(kn / mass)
    half, means = 0.5 * mass, {}
    for n in (50, 100):
        dt = math.pi / math.sqrt(kn / mass - gamma ** 2 / 4) / n
        # The damping of hooke is times the mass of the contact.
        rows = [with_body(folder, f"hooke {kn} NULL {gamma!r} NULL 0 0", dt, f"run {3 * n}", BODY.format(mass=3, axis="0 0 1", more=""),
                          x=f"0.3 0.2 {0.5 + (5 + k / 8) * dt!r}", v="0 0 -1") for k in range(8)]
        means[n] = sum(r["remainder"] for r in rows) / 8 / half
        for r in rows:
            at_most(f"{n}: energy that is lost, and the change of kinetic energy", abs(r["work"] + r["body"] + r["ke"] - 0.5), 1e-12)
            nothing_but(r, half, "damping")
        close("the bounce loses", sum(r["damping"] for r in rows) / 8 / half, 1 - E ** 2, 1, 0.03)
    close("the remainder falls with dt^2", means[50] / means[100], 4, 4, 0.1)


def cask(spacing, half, pairs, wall):
    """Grains in a cask, cask.stl: a cubic lattice from -half to half. `pairs`: lines of these; `wall`: words of the mesh's wall."""
    return lmp.head("-2 2 -2 2 -2 2") + f"""\
lattice         sc {spacing}
region          in block {-half} {half} {-half} {half} {-half} {half} units box
create_atoms    1 region in
set             group all diameter 0.2 mass 1
""" + pairs + f"""\
fix             move all nve/sphere
fix             g all gravity 1 vector 0 0 -1
fix             wall all wall/lsdcd {wall} energy
"""


CASK = cask(20, 0.7, "velocity        all create 2.0 4711\n" + lmp.pairs("zero 0.3"), "{law} mesh cask.stl {words}") + TELL
CASK_LAW = "granular hooke 1e4 5 damping mass_velocity tangential linear_history 5e3 1 0.4 rolling sds 50 0.1 0.05 twisting sds 5 0 0.01"


def test_body_with_a_motor(folder):
    """A closed cask that a motor turns with grains inside: the motor's work is the cask's energy and what it gives to the grains."""
    torque, remainders = 30.0, []
    stl.write(folder / "cask.stl", stl.box((-1, -1, -1), (1, 1, 1), 3))
    for per_contact in (50, 100):
        dt = math.pi / math.sqrt(1e4) / per_contact
        b = lmp.read_thermo(lmp.run_well(CASK.format(
            law=CASK_LAW, dt=repr(dt), run=f"run {round(1.5 / dt)}", columns=" ".join([*COLUMNS, KINETIC, "f_wall[34]"]),
            words=f"body mass 50 com 0 0 0 inertia 30 30 30 0 0 0 joint hinge 0 0 0 0 1 0 motor {torque}"), folder))[-1]
        b = dict(zip(("step", "ke", "spin", *NAMES, "body", "angle"), b))
        motor = torque * b["angle"]
        fact("it has turned the grains", b["drive"] > 0.05 * motor and b["slider"] > 0 and b["rolling"] > 0, b)
        close("the motor's work", b["body"] + b["drive"], motor, motor, 1e-4)
        remainders.append(b["remainder"] / b["drive"])
    at_most("the remainder", abs(remainders[1]), 1e-3)


def test_servo(folder):
    """A plate that a servo presses on a sphere that is held: the servo's work is what the contact holds and loses."""
    b = with_body(folder, f"hooke {KN} NULL 20 NULL 0 0", 1e-4, "run 20000", "servo force z 50 vmax 0.05",
                  x="0.3 0.2 0.51", move=HELD.format(v="0 0 0"))
    held = 50 ** 2 / KN / 2
    close("it presses", b["held"], held, held, 1e-3)
    close("the servo's work", b["drive"], b["held"] + b["damping"], held, 1e-4)
    at_most("the books close", abs(b["remainder"]) / held, 1e-4)


def test_limit_damping(folder):
    """Damping that may not pull: what it loses is still the change of the kinetic energy."""
    means = {}
    for n in (50, 100):
        dt = math.pi / math.sqrt(KN) / n
        rows = [books(folder, f"granular hooke {KN} 90 damping mass_velocity tangential linear_nohistory 0 0 limit_damping", dt, f"run {4 * n}",
                      v="0 0 -1", x=f"0.3 0.2 {0.5 + (5 + k / 8) * dt!r}") for k in range(8)]
        for r in rows:
            at_most("work, and the change of kinetic energy", abs(r["work"] - (0.5 - r["ke"])), 1e-12)
            nothing_but(r, 0.5, "damping")
        means[n] = sum(r["remainder"] for r in rows) / 8
    fact("the remainder falls with dt^2", 3 < means[50] / means[100] < 5, means)


def test_several_meshes(folder):
    """A cask of six meshes, each a side of it, and one of all sides: books are the same where one mesh hands springs to another."""
    dt = math.pi / math.sqrt(1e4) / 100
    sides = [stl.box((-1, -1, -1), (1, 1, 1), 3)[18 * k:18 * k + 18] for k in range(6)]
    for k, side in enumerate(sides):
        stl.write(folder / f"side{k}.stl", side)
    stl.write(folder / "cask.stl", sum(sides, []))
    turn = "motion rotate 0 0 0 0 1 0 2"
    scripts = CASK, CASK.replace("mesh cask.stl {words} energy", " ".join(f"mesh side{k}.stl {{words}}" for k in range(6)) + " energy")
    one, six = (row_of(lmp.run_well(script.format(law=CASK_LAW, dt=repr(dt), run=f"run {round(0.5 / dt)}", columns=" ".join(COLUMNS), words=turn), folder))
                for script in scripts)
    for name in NAMES:
        close(name, six[name], one[name], one["drive"], 1e-6)
    at_most("the books close", abs(six["remainder"]) / six["drive"], 1e-3)


def test_each_contact(folder):
    """Rows of contacts, with meshes of which one hands springs to another, and grains that go from process to process: power adds up to that of the
    meshes in each step, and energy of those that have ended, in the dump of each step, and of those that have not, to theirs."""
    for k in range(6):
        stl.write(folder / f"side{k}.stl", stl.box((-1, -1, -1), (1, 1, 1), 3)[18 * k:18 * k + 18])
    meshes = " ".join(f"mesh side{k}.stl motion rotate 0 0 0 0 1 0 2" for k in range(6))
    script = CASK.replace("mesh cask.stl {words} energy", meshes + " energy each_contact").replace(
        "compute         move", "compute rows all reduce sum " + " ".join(f"f_wall[{c}]" for c in range(10, 20)) + " inputs local" * (lmp.version() > 20220101) + "\ncompute         move")
    sums = [f"c_rows[{k + 1}]" for k in range(10)]
    run = "thermo 100\ndump ends all local 1 ends.txt f_wall[20] " + " ".join(f"f_wall[{c}]" for c in range(15, 20)) + \
        "\ndump_modify ends format float %.17g\nrun 1000\nrun 1000"
    for ranks in (1, 2):
        rows = lmp.read_thermo(lmp.run_well(script.format(law=CASK_LAW, dt="5e-4", run=run, columns=" ".join([*COLUMNS, *sums])), folder, ranks))
        for before, row in zip([None, *rows], rows):
            b = dict(zip(("step", "ke", "spin", *NAMES, *sums), row))
            if before and before[0] == row[0]:    # the second run begins, where those that have just ended have no row
                continue
            size = sum(abs(b[f"{c} power"]) for c in CAUSES) + 1e-6
            at_most(f"{ranks}, step {b['step']}: power", max(abs(b[f"{c} power"] - b[s]) for c, s in zip(CAUSES, sums)) / size, 1e-12)
        ended, n = [0.0] * 5, 0
        for line in (folder / "ends.txt").read_text().splitlines():
            words = line.split()
            if len(words) == 6 and words[0] == "1":
                n, ended = n + 1, [e + float(w) for e, w in zip(ended, words[1:])]
        fact(f"{ranks}: contacts have ended, and there are others", n > 50 and b[sums[5]] > 0, n)
        there = [row.split() for row in (folder / "ends.txt").read_text().split("ITEM: ENTRIES")[-1].splitlines()[1:]]
        lives = [e + sum(float(row[1 + k]) for row in there if row[0] == "0") for k, e in enumerate(ended)]
        at_most(f"{ranks}: energy", max(abs(b[c] - life) for c, life in zip(CAUSES, lives)) / sum(b[c] for c in CAUSES), 1e-12)


NO_TIME = lmp.head("-2 2 -2 2 -2 2") + """\
create_atoms    1 single 0.1 0.2 0.48
set             group all diameter 1 density 1
velocity        all set 1 0 0
""" + lmp.pairs() + """\
fix             move all nve/sphere
fix             wall all wall/lsdcd hooke/history 1e4 4e3 30 NULL 0.5 1 mesh floor.stl energy each_contact
compute         row all reduce sum f_wall[10] f_wall[11] f_wall[15] f_wall[16]{inputs}
thermo          1
thermo_style    custom step c_row[1] c_row[2] c_row[3] c_row[4]
thermo_modify   format float %.17g
timestep        1e-3
run             10
timestep        0
run             2
"""


def test_no_time(folder):
    """A contact has no power in a step of no time, and loses no energy."""
    stl.write(folder / "floor.stl", stl.square(1))
    rows = lmp.read_thermo(lmp.run_well(NO_TIME.format(inputs=" inputs local" * (lmp.version() > 20220101)), folder))
    before, *after = rows
    fact("it slides, and is damped", before[0] == 10 and min(map(abs, before[1:])) > 0, before)
    fact("it has no power, and loses nothing more", [row[1:] for row in after] == [[0, 0, *before[3:]]] * 2, rows)


# ---- walls that turn, nodes that move, wear ----------------------------------------------

PULL = "fix move all nve/sphere\nfix g all gravity 100 vector 0 0 -1"
REST = repr(0.5 - 100 / KN)    # of a sphere of mass 1 under that


def test_wall_that_turns(folder):
    """A sphere that slides, or rolls, down a plate which turns below it. Nothing begins or ends, so that the remainder is of the middle of a
    contact alone: the forces of two steps are to two directions of the plate, and meet the wall at two places."""
    for law, least in ((f"hooke {KN} NULL 20 NULL 0 0", 3.9), (CASK_LAW, 3.5)):
        remainders = []
        for per_contact in (50, 100, 200):
            dt = math.pi / math.sqrt(KN) / per_contact
            text = SPHERE.replace("floor.stl energy", "floor.stl motion rotate 0 0 0 0 1 0 8 energy")
            b = row_of(lmp.run_well(text.format(x=f"-0.8 0.2 {REST}", v="0 0 0", move=PULL, law=law, dt=repr(dt), columns=" ".join(COLUMNS),
                                                run=f"run {round(0.5 / dt)}"), folder))
            fact("the plate lifts it", b["drive"] > 10, b)
            remainders.append(b["remainder"] / b["drive"])
        print(law, remainders)
        for one, other in zip(remainders, remainders[1:]):
            fact("the remainder falls with dt^2", least < one / other < 4.5, remainders)
        at_most("at 100 steps a contact", abs(remainders[1]), 5e-7)


NODES = lmp.head("-3 3 -3 3 -3 3", types=2) + """\
create_atoms    1 single 0.5 -0.4 {z} units box
create_atoms    2 single -1 -1 0 units box
create_atoms    2 single  1 -1 0 units box
create_atoms    2 single  1  1 0 units box
create_atoms    2 single -1  1 0 units box
set             type 1 diameter 0.4 mass 0.8
set             type 2 diameter 0.1 mass 0.25
group           nodes type 2
group           grains type 1
velocity        nodes set 0 0 -1
velocity        grains set 0.7 0.2 0
set             type 1 omega 1.5 -0.4 2
""" + lmp.pairs("zero 1.0") + """\
timestep        {dt}
fix             m nodes nve
fix             s grains nve/sphere
fix             wall grains wall/lsdcd {law} mesh square.stl nodes nodes energy
compute         move grains ke
compute         spin grains erotate/sphere
compute         net nodes ke
thermo_style    custom step c_move c_spin c_net {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
{run}
"""


def test_nodes(folder):
    """A sphere that spins and is met off the centre by a square of four free nodes, which folds: what the sphere and the nodes lose in all
    is what the rows have, to rounding. Nodes give all the work of the mesh. The remainder falls with dt^2 while the contact lasts."""
    stl.write(folder / "square.stl", stl.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)))
    names = ("step", "ke", "spin", "net", *NAMES)
    lossy = "granular hooke 1e3 5 damping mass_velocity tangential linear_history 300 1 0.3 "
    for law in ("hooke 1e3 NULL 0 NULL 0 0", lossy, lossy + "rolling sds 5 0.01 0.05 twisting sds 1 0.001 0.01"):
        remainders = []
        for n in (50, 100, 200):
            for z, run in (("-0.21", 3 * n), ("-0.19", round(0.6 * n))):
                text = lmp.run_well(NODES.format(z=z, dt=repr(math.pi / math.sqrt(1e3 / 0.44) / n), law=law, columns=" ".join(COLUMNS), run=f"run {run}"), folder)
                rows = lmp.read_thermo(text)
                a, b = (dict(zip(names, row)) for row in (rows[0], rows[-1]))
                if z == "-0.19":    # from the begin of the run in overlap on
                    remainders.append(b["remainder"])
                    continue
                fact("nodes lose some, and the sphere is gone", b["drive"] > 0.1 and b["held"] == 0, b)
                lost = a["ke"] + a["spin"] - b["ke"] - b["spin"]
                at_most(f"{law}: work less that of the mesh is what the sphere loses", abs(lost - b["work"] + b["drive"]), 1e-12)
                at_most(f"{law}: work of the mesh is what its nodes lose", abs(a["net"] - b["net"] - b["drive"]), 1e-12)
                # Of an overlap d in the first step k d (v dt - d)/2, and as much as it ends.
                at_most(f"{law}: remainder at {n} over k (v dt)^2/4", abs(b["remainder"]) / (math.pi ** 2 * 0.44 / n ** 2 / 4), 1)
        print(law, remainders)
        for one, other in zip(remainders, remainders[1:]):
            fact("the remainder falls with dt^2", 3.5 < one / other < 4.5, remainders)
    fact("rolling and twisting lose some, and their torque on nodes", b["rolling"] > 1e-5 and b["twisting"] > 1e-5 and abs(b["lever_arms"]) > 1e-7, b)


def test_nodes_as_one_mesh(folder):
    """Nodes that all move alike are a mesh with a motion: all rows are the same."""
    stl.write(folder / "square.stl", stl.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)))
    law = "granular hooke 1e3 5 damping mass_velocity tangential linear_history 300 1 0.3 rolling sds 5 0.01 0.05 twisting sds 1 0.001 0.01"
    nodes = NODES.replace("fix             m nodes nve", "fix m nodes move linear 0.3 0 -1 units box")
    both = [dict(zip(("step", "ke", "spin", "net", *NAMES), lmp.read_thermo(lmp.run_well(script.format(
        z="-0.21", dt="1e-3", law=law, columns=" ".join(COLUMNS), run="run 150"), folder))[-1]))
        for script in (nodes, nodes.replace("nodes nodes energy", "motion linear 0.3 0 -1 energy"))]
    fact("it is hit", both[0]["drive"] > 0.1, both[0])
    for name in NAMES:
        close(name, both[0][name], both[1][name], both[1]["drive"], 1e-11)


def test_wear_that_moves_the_mesh(folder):
    """A sphere of weight 100 that wears the floor: what the floor takes from its contact as it goes back is in a row of its own. One that slides climbs
    out of its own groove, and pays by its speed; one that spins on the spot sinks, and the row is its weight times the depth."""
    stl.write(folder / "cut.stl", stl.sheet(12, lambda i, j: (-3 + 6 * i / 12, -3 + 6 * j / 12, 0)))
    script = SPHERE.replace("{columns}", "{columns} f_wall[75] v_z").replace("timestep", "variable z equal xcm(all,z)\ntimestep", 1)
    for x, v, spin, wears in (("-0.8 0.2", "1 0.3 0", "0 0 0", 1e-3), ("0.1 0.2", "0 0 0", "0 2 0", 1e-4)):
        for per_contact in (50, 100, 200):
            dt = math.pi / math.sqrt(KN) / per_contact
            text = script.replace("floor.stl energy", f"cut.stl wear archard {wears} 50 deform every {per_contact // 5} energy")
            row = lmp.read_thermo(lmp.run_well(text.format(
                x=f"{x} {REST}", v=v, move=f"{PULL}\nset group all omega {spin}", law=f"hooke {KN} NULL 20 NULL 0 0", dt=repr(dt),
                columns=" ".join(COLUMNS), run=f"run {round(1 / dt)}"), folder))[-1]
            b = dict(zip(("step", "ke", "spin", *NAMES, "wear", "z"), row))
            sunk, before = float(REST) - b["z"], 0.545 if v[0] == "1" else 0
            close("what wear takes", b["wear"], 100 * sunk - (b["ke"] - before) - (b["held"] - 0.5) - b["damping"], b["wear"], 1e-3)
            if spin != "0 0 0":
                close("its weight times the depth", b["wear"], 100 * sunk, b["wear"], 0.01)
            fact("it wears", b["wear"] > 0.01, b)
            # The force jumps where wear has bent the floor at an edge, by the angle.
            at_most(f"remainder at {per_contact}", abs(b["remainder"]) / b["wear"], 1e-4 * (100 / per_contact) ** 2)
            nothing_but(b, b["wear"], "damping", "inserted")


def test_nodes_and_wear_on_processes(folder):
    """On 4 processes, and after a restart in the middle of a contact, all rows are the same."""
    stl.write(folder / "square.stl", stl.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)))
    stl.write(folder / "cut.stl", stl.sheet(12, lambda i, j: (-3 + 6 * i / 12, -3 + 6 * j / 12, 0)))
    law = "granular hooke 1e3 5 damping mass_velocity tangential linear_history 300 1 0.3 rolling sds 5 0.01 0.05 twisting sds 1 0.001 0.01"
    nodes = NODES.format(z="-0.21", dt="1e-3", law=law, columns=" ".join(COLUMNS), run="{run}"), 30
    wear = SPHERE.replace("floor.stl energy", "cut.stl wear archard 1e-3 50 deform every 10 energy").replace("{columns}", "{columns} f_wall[75]").format(
        x=f"-0.8 0.2 {REST}", v="1 0.3 0", move=PULL, law=f"hooke/history {KN} 3e3 20 10 0.05 1", dt="1e-3", columns=" ".join(COLUMNS), run="{run}"), 205
    for script, half in (nodes, wear):
        def last(text, ranks=1):
            return lmp.read_thermo(lmp.run_well(text, folder, ranks))[-1][1:]
        whole = last(script.replace("{run}", f"run {half}\nrun {half}"))
        four = last(script.replace("{run}", f"run {half}\nrun {half}"), 4)
        last(script.replace("{run}", f"run {half}\nwrite_restart half.restart"))
        lines = script.splitlines(keepends=True)
        first = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
        again = "atom_modify map array\nread_restart half.restart\ncomm_modify vel yes\n" + "".join(lines[first:])
        fact("it works", whole[-1] != 0 and max(map(abs, whole)) > 0.1, whole)
        for name, row in (("4 processes", four), ("restarted on 1", last(again.replace("{run}", f"run {half}"))),
                          ("restarted on 4", last(again.replace("{run}", f"run {half}"), 4))):
            at_most(name, max(abs(a - b) for a, b in zip(row, whole)), 1e-11)


# ---- ellipsoids --------------------------------------------------------------------------

GRAIN = lmp.head("-3 3 -3 3 -1 5", style="ellipsoid") + """\
create_atoms    1 single {x} units box
set             group all mass 1
set             group all shape 1.4 0.9 0.8
set             group all mass 1
set             group all quat {quat}
set             group all angmom {spin}
velocity        all set {v} units box
pair_style      zero 1.8
pair_coeff      * *
fix             move all nve/asphere
fix             wall all wall/lsdcd {law} mesh {mesh} energy
""" + TELL.replace("erotate/sphere", "erotate/asphere")


def grain(folder, per_contact, seconds, law, mesh="floor.stl", x="0.3 0.2 0.403", quat="0 1 0 10", spin="0.1 0.2 0.1", v="0.3 0.1 -0.2"):
    """The first row and the last one."""
    dt = math.pi / math.sqrt(KN) / per_contact
    rows = lmp.read_thermo(lmp.run_well(GRAIN.format(x=x, quat=quat, spin=spin, v=v, law=law, mesh=mesh, dt=repr(dt), columns=" ".join(COLUMNS),
                                                     run=f"run {round(seconds / dt)}"), folder))
    return [dict(zip(("step", "ke", "spin", *NAMES), row)) for row in (rows[0], rows[-1])]


def test_ellipsoids(folder):
    """An ellipsoid that begins in overlap, on a floor, on one that turns, and in a fold, where the contacts that share have couples: while it
    touches the remainder falls with dt^2. With hertz the curvature changes as it rolls, which is stiffness. One that falls down loses what is in the rows,
    where nve/asphere turns it to dt^3."""
    c, s = 3 * math.cos(math.radians(25)), 3 * math.sin(math.radians(25))
    stl.write(folder / "fold.stl", stl.quad((0, -3, 0), (c, -3, s), (c, 3, s), (0, 3, 0)) + stl.quad((-c, -3, s), (0, -3, 0), (0, 3, 0), (-c, 3, s)))
    free, lossy = f"hooke {KN} NULL 0 NULL 0 0", f"hooke/history {KN} 3e3 20 10 0.3 1"
    hertz = "granular hertz 1e5 10 damping velocity tangential linear_history 3e3 1 0.3"
    in_fold = {"mesh": "fold.stl", "x": "0.02 0.2 0.49", "quat": "0 0 1 20", "spin": "0.05 0.05 0.2", "v": "0.1 0.1 0"}
    for name, seconds, of in (("free", 0.015, {"law": free}), ("lossy", 0.015, {"law": lossy}), ("hertz", 0.015, {"law": hertz}),
                              ("turning", 0.008, {"law": lossy, "mesh": "floor.stl motion rotate 0 0 0 0.2 1 0.3 3"}),
                              ("fold", 0.008, {"law": free, **in_fold}), ("lossy fold", 0.008, {"law": lossy, **in_fold})):
        rows = [grain(folder, n, seconds, **of)[1] for n in (50, 100, 200)]
        found = [abs(r["remainder"] / r["work"]) for r in rows]
        print(name, found)
        fact(f"{name}: it touches", all(r["held"] > 0.01 for r in rows), rows)
        at_most(f"{name}: remainder over the work at 100 steps a contact", found[1], 2e-4)
        for one, other in zip(found, found[1:]):
            # The work is of a time to a step; a remainder of 1e-8 is of two that nearly cancel.
            fact(f"{name}: it falls with dt^2", one > 3.1 * other or other < 1e-8, found)
        others = {"free": ["inserted"], "hertz": ["inserted", "damping", "slider", "stiffness", "turned_springs"]}
        if name in others:
            nothing_but(rows[-1], rows[-1]["held"], *others[name])
        if name == "hertz":
            fact("the curvature changes", rows[-1]["stiffness"] > 5e-4, rows[-1])
    for n in (50, 100):
        a, b = grain(folder, n, 0.5, lossy, x="0.3 0.2 0.7", quat="0 1 0 30", v="0.3 0.1 -1")
        lost = a["ke"] + a["spin"] - b["ke"] - b["spin"]
        fact("it leaves", b["held"] == 0 and lost > 0.1, b)
        at_most("work is what it loses", abs(lost - b["work"]), 3e-9 * (50 / n) ** 2)
        at_most("remainder over k (v dt)^2/4", abs(b["remainder"]) / (math.pi ** 2 / n ** 2 / 4), 1)


# ---- a ball mill -------------------------------------------------------------------------

def mill(name, radius=0.15, length=0.06, lifters=8, height=0.02, sides=48):
    """A drum about y, open at periodic faces, with lifters inside: its profile in x, z drawn along y."""
    profile = []
    for k in range(sides):
        a = 2 * math.pi * k / sides
        inward = height if k % (sides // lifters) == 0 else 0
        for r, da in ((radius, -0.05), (radius - inward, -0.03), (radius - inward, 0.03), (radius, 0.05)) if inward else ((radius, 0),):
            profile.append((r * math.cos(a + da), r * math.sin(a + da)))
    triangles = []
    for (x, z), (u, w) in zip(profile, profile[1:] + profile[:1]):
        triangles += stl.quad((x, 0, z), (x, length, z), (u, length, w), (u, 0, w))
    stl.write(name, triangles)


MILL = """\
units           si
atom_style      sphere
atom_modify     map array
boundary        f p f
newton          off
comm_modify     vel yes
region          box block -0.16 0.16 0 0.06 -0.16 0.16
create_box      1 box
lattice         sc 0.02
region          in cylinder y 0 0 0.115 EDGE EDGE units box
create_atoms    1 region in
displace_atoms  all random 0.0015 0.0015 0.0015 4711 units box
set             group all diameter 0.016 density 7800
pair_style      granular/lsdcd
pair_coeff      * * {of_pairs}
neighbor        0.004 bin
neigh_modify    delay 0 every 1 check yes
fix             move all nve/sphere
fix             g all gravity 9.81 vector 0 0 -1
fix             wall all wall/lsdcd {law} mesh mill.stl motion rotate 0 0 0 0 1 0 1.2 periodic energy
""" + TELL
MASS = 7800 * 4 / 3 * math.pi * 0.008 ** 3
MILL_K = 3e4
MILL_LAW = f"granular hooke {MILL_K} 20 damping mass_velocity tangential linear_history {MILL_K * 2 / 7} 1 0.4 rolling sds 1e3 0.1 0.01 twisting sds 0.02 0 1e-4"


def grind(folder, per_contact, seconds, ranks=1):
    """The last row. Contacts of two balls are the shortest."""
    mill(folder / "mill.stl")
    dt = math.pi * math.sqrt(MASS / 2 / MILL_K) / per_contact
    return row_of(lmp.run_well(MILL.format(law=MILL_LAW, of_pairs=MILL_LAW.replace("granular ", ""), dt=repr(dt), columns=" ".join(COLUMNS),
                                           run=f"run {round(seconds / dt)}"), folder, ranks, timeout=3000))


def test_ball_mill(folder):
    """The books of its walls close to 1e-4 of the work of the drive at 150 steps a contact."""
    wall = grind(folder, 150, 0.25 if lmp.QUICK else 1.0)
    print(wall)
    drive = wall["drive"]
    fact("the drive works", drive > 0, drive)
    fact("all causes dissipate", all(wall[c] > 0 for c in ("damping", "slider", "rolling", "twisting")), wall)
    at_most("remainder", abs(wall["remainder"]) / drive, 1e-4)


# ---- processes and restart ---------------------------------------------------------------

ALONE = MILL[:MILL.index("pair_style")] + "pair_style zero 0.02\npair_coeff * *\n" + MILL[MILL.index("neighbor "):]


def roll(folder, steps, run, ranks=1, script=ALONE, law=MILL_LAW):
    dt = math.pi * math.sqrt(MASS / MILL_K) / 50
    return row_of(lmp.run_well(script.format(law=law, dt=repr(dt), columns=" ".join(COLUMNS), run=run.format(n=steps)), folder, ranks))


def same(name, book, wanted):
    size = wanted["work"]
    for key in NAMES:
        close(f"{name}: {key}", book[key], wanted[key], size, 1e-12)


def test_processes_and_restart(folder):
    """Spheres that do not feel each other, in a mill: books are the same on 1 and 4 processes, and after a restart in the middle, where
    half of the work of a step is of forces from before it."""
    mill(folder / "mill.stl")
    steps = 1000
    whole = roll(folder, steps, "run {n}\nrun {n}")
    fact("there is something to compare", whole["slider"] > 0 and whole["held"] > 0, whole)
    at_most("the remainder", abs(whole["remainder"]) / whole["drive"], 1e-3)
    same("4 processes", roll(folder, steps, "run {n}\nrun {n}", 4), whole)
    roll(folder, steps, "run {n}\nwrite_restart half.restart")
    lines = ALONE.splitlines(keepends=True)
    first = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    again = "read_restart half.restart\ncomm_modify vel yes\n" + "".join(lines[first:])
    for ranks in (1, 4):
        same(f"restarted on {ranks}", roll(folder, steps, "run {n}", ranks, again), whole)
