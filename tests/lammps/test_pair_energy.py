# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""compute lsdcd/energy: the books of energy between grains against closed forms, and the balance with a wall."""

import math
import re

import pytest

import lmp
import stl
from facts import at_most, fact
from test_energy import CAUSES, E, OTHERS, check_bounces, close, jkr_force, nothing_but

NAMES = (*(f"{c} power" for c in CAUSES), *CAUSES, *OTHERS, "work", "held", "remainder", "kinetic", "gravity", "all held", "all lost",
         "drive", "plastic power", "plastic")
COLUMNS = " ".join(["c_books", *(f"c_books[{k + 1}]" for k in range(len(NAMES)))])
OUTPUT = f"""\
compute         books all lsdcd/energy
compute         move all ke
compute         spin all erotate/sphere
thermo_style    custom step c_move c_spin {COLUMNS}
thermo_modify   format float %.17g norm no
thermo          1000000
"""
# Two grains of radius 0.5 and mass 1, the first one at the origin.
TWO = """\
create_atoms    1 single 0 0 0 units box
create_atoms    1 single {b} units box
set             group all diameter 1.0 mass 1
group           one id 1
group           two id 2
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
timestep        {dt!r}
{move}
""" + OUTPUT + "{run}\n"


def books(text):
    """All rows of thermo output."""
    return [dict(zip(("step", "ke", "spin", "balance", *NAMES), row)) for row in lmp.read_thermo(text)]


def script_of_two(law, dt, run, b, move, newton="off"):
    return lmp.head("-3 3 -3 3 -3 3", newton=newton) + TWO.format(law=law, dt=dt, run=run, b=b, move=move)


def two(folder, law, dt, run, b, move, ranks=1, newton="off"):
    """The books at the end."""
    return books(lmp.run_well(script_of_two(law, dt, run, b, move, newton), folder, ranks))[-1]


def test_bounce(folder):
    """Two grains that meet at speed 1 lose 0.75 m_e v^2/2 by damping."""
    kn, reduced, ln_e, half = 1e4, 0.5, math.log(E), 0.25
    gamma = -2 * ln_e / math.sqrt(math.pi ** 2 + ln_e ** 2) * math.sqrt(kn / reduced)
    move = "fix move all nve/sphere\nvelocity one set 0.5 0 0\nvelocity two set -0.5 0 0"

    def falls(n):
        dt = math.pi / math.sqrt(kn / reduced - gamma ** 2 / 4) / n
        return [books(text)[-1] for text in lmp.run_in_a_row(
            [script_of_two(f"law hooke {kn} NULL {gamma!r} NULL 0 0", dt, f"run {3 * n}", f"{1 + (5 + k / 8) * dt!r} 0 0", move) for k in range(8)], folder)]

    def check(n, r):
        at_most(f"{n} steps: energy that is lost, and the change of kinetic energy", abs(r["work"] - (half - r["ke"])), 1e-12)
        at_most("the balance differs by the remainder", abs(r["balance"] + r["remainder"] - half), 1e-12)
    check_bounces(falls, half, check)


# The second grain is held at an overlap d, and so is the first, but for what it is turned.
KN, OVERLAP = 1e4, 0.01
PRESS = KN * OVERLAP
BESIDE = f"{1 - OVERLAP!r} 0 0"
R = 0.5


def turned(axis, w):
    return f"fix hold two move linear 0 0 0 units box\nfix turn one move rotate 0 0 0 {axis} {2 * math.pi / w!r} units box"


def test_slip(folder):
    """A grain that is turned where it touches another slips by s = R w t: mu F s by the slider, less what the spring holds. Friction
    has a shorter arm with granular, and half of the overlap is a row."""
    mu, kt, w, dt, n = 0.3, 4e3, 1.4, 1e-4, 4000
    granular = f"hooke {KN} 20 damping mass_velocity tangential"
    limit, dashpot = mu * PRESS, 10 * R * w
    # The force of the dashpot, where friction reaches its limit and where the spring ends; arms of the force and of slip. With
    # LIGGGHTS's friction the spring alone reaches the limit.
    for law, viscous, reached, end, arm, of_slip in (
            (f"law hooke/history {KN} {kt} 20 10 {mu} 1", dashpot / 2, limit - dashpot / 2, limit - dashpot / 2, R, R),
            (f"{granular} linear_history {kt} 1 {mu}", dashpot, limit - dashpot, limit - dashpot, R - OVERLAP / 2, R),
            (f"{granular} linear_history_slip {kt} 1 {mu}", dashpot, limit - dashpot, limit, R - OVERLAP / 2, R),
            (f"{granular} linear_history_liggghts {kt} 1 {mu}", 9.9 * R * w, limit, limit, R - OVERLAP / 2, R - OVERLAP / 2)):
        b = two(folder, law, dt, f"run {n}\nrun {n}", BESIDE, turned("0 0 1", w))
        lost, first = limit * of_slip * w * dt * 2 * n, reached / kt
        # The step in which the first part of the way ends may be a step off.
        close(f"{law}: slider", b["slider"], lost - limit * end / kt, lost, 1 / (2 * n))
        close(f"{law}: power of the slider", b["slider power"], limit * of_slip * w, lost / dt / n, 1e-9)
        friction = lost - limit * first + kt * first ** 2 / 2 + viscous * first
        close(f"{law}: work, which is of the torque", b["work"], friction * arm / of_slip, lost, 1 / (2 * n))
        close(f"{law}: lever arms", b["lever_arms"], friction * (arm / of_slip - 1), lost, 1e-6)
        close(f"{law}: the books close", b["remainder"], 0, lost, 1e-11)


def test_rolling_and_twisting(folder):
    """A grain that is turned where it touches another: mu F R_e angle by rolling, R_e = R/2, and mu F angle by twisting, less what the
    springs hold."""
    w, dt, n = 2.0, 1e-4, 5000
    angle = w * dt * n
    reduced = R / 2
    law = f"hooke {KN} 20 damping mass_velocity tangential linear_history 0 0 0 rolling {{rolling}} twisting {{twisting}}"
    for model, row, moment, k, dashpot in (
            ("sds 5e3 0.1 0.2", "rolling", 0.2 * PRESS * reduced, 5e3 * reduced ** 2, 0.1 * reduced ** 2),
            ("cdt 0.2", "rolling", 0.2 * PRESS * reduced, 0, 0), ("sds 30 0.1 0.02", "twisting", 0.02 * PRESS, 30, 0.1)):
        axis = "0 0 1" if row == "rolling" else "1 0 0"
        words = law.format(rolling=model if row == "rolling" else "none", twisting=model if row == "twisting" else "none")
        b = two(folder, words, dt, f"run {n}", BESIDE, turned(axis, w))
        # The spring takes the first part of the angle, beside the dashpot; their sum is limited. It holds k first^2/2.
        first = (moment - dashpot * w) / k if k else 0
        lost = moment * angle
        close(f"{model}: loss of {row}", b[row], k * first ** 2 / 2 + dashpot * w * first + moment * (angle - first) - k * first ** 2 / 2, lost,
              2e-4)
        close(f"{model}: power", b[f"{row} power"], moment * w, moment * w, 1e-9)
        close(f"{model}: the books close", b["remainder"], 0, lost, 1e-11)
        nothing_but(b, lost, row, "inserted")


def test_springs_that_only_make_up_for_a_dashpot(folder):
    """Two grains that meet aslant, with an overlap of 1e-17 in the first step: rows do not exceed their energy, and slider and stiffness converge, as
    those of a wall do (test_energy.py)."""
    move = "fix move all nve/sphere\nvelocity one set 0.5 0.5 0\nvelocity two set -0.5 -0.5 0"
    for law in ("hertz 1e5 5 damping velocity tangential mindlin 1e5 1 0.2", "law hertz/history 1e5 1e5 20 40 0.2 0"):
        rows = [[two(folder, law, dt, f"run {round(0.08 / dt)}", f"{1 + n * dt - less!r} 0 0", move) for n, less in ((3.3, 0), (3.7, 0), (4, 2e-16))]
                for dt in (1e-4, 5e-5, 2.5e-5)]
        for b in (b for of in rows for b in of):
            at_most(f"{law}: no row exceeds the energy", max(abs(b[n]) for n in ("slider", "stiffness", "damping")), 0.5)
            fact(f"{law}: the slider gains nothing", b["slider"] > 0, b)
        for name in ("slider", "stiffness"):
            means = [sum(b[name] for b in of) / len(of) for of in rows]
            # A contact has 300 steps of 5e-5, and a step's part of its work may be in the one row or in the other.
            at_most(f"{law}: {name} at the two smallest timesteps", abs(means[-1] - means[-2]), 1 / 300)


def test_loop_of_jkr(folder):
    """Grains that are pressed together and pulled apart: both steps of the adhesion sum to the integral of the force from the pull-off
    to the touch. The force jumps there, where a step counts by dt/2."""
    young, nu, gamma, reduced = 1e6, 0.25, 50.0, R / 2
    modulus = young / (2 * (1 - nu ** 2))
    let_go = -(3 * math.pi ** 2 * gamma ** 2 * reduced / (16 * modulus ** 2)) ** (1 / 3)
    n = 4000
    integral = sum(jkr_force(let_go * (k + 0.5) / n, modulus, gamma, reduced) for k in range(n)) * let_go / n
    v = 0.05
    for dt in (2e-4, 1e-4):
        steps = round(0.06 / v / dt)
        b = two(folder, f"jkr {young} 0 {nu} {gamma} damping velocity tangential linear_nohistory 0 0", dt,
                f"run {steps}\nunfix move\nfix move two move linear {v} 0 0 units box\nrun {3 * steps}", "1.03 0 0",
                f"fix hold one move linear 0 0 0 units box\nfix move two move linear {-v} 0 0 units box")
        close(f"dt {dt}: adhesion", b["adhesion"], integral, integral, 1e-5)
        nothing_but(b, integral, "adhesion")
        at_most(f"dt {dt}: remainder", abs(b["remainder"]), 3 * math.pi * gamma * reduced * v * dt)    # both jumps, at most half of each
    fact("nothing is held at the end", b["held"] == 0, b["held"])


# ---- many grains -------------------------------------------------------------------------

# Grains of two sizes that fly about in a periodic box. The seed is of their velocities and spins.
CLOUD = """\
lattice         sc 0.6575
region          all block 0 4.59 0 4.59 0 4.59 units box
create_atoms    1 region all basis 1 1
set             group all diameter 1.0
set             group all type/fraction 2 0.4 871
set             type 2 diameter 0.8
set             group all density 2
velocity        all create 30 4711 dist gaussian loop geom
set             group all omega 1 -2 3
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.06 bin
neigh_modify    delay 0 every 1 check yes
timestep        {dt!r}
fix             move all nve/sphere
""" + OUTPUT + "{run}\n"
CLOUD_HEAD = lmp.head("0 4.6 0 4.6 0 4.6", boundary="p p p", types=2)
PLAIN = "tangential linear_history 4e4 1 0.4"
CLOUD_LAWS = (
    "law hooke 1e5 NULL 10 NULL 0.4 1", "law hooke/history 1e5 NULL 10 NULL 0.4 1 rolling epsd2 0.1 cohesion sjkr 300",
    "law hertz/history 3e5 NULL 10 NULL 0.4 1",
    f"hooke 1e5 10 damping mass_velocity {PLAIN} rolling sds 1e3 1 0.1 twisting sds 300 0.2 0.02",
    "hertz/material 5e5 0.3 0.3 tangential mindlin NULL 1 0.4 damping tsuji rolling sds 1e3 1 0.1 twisting marshall",
    "hertz/material 5e5 0.3 0.3 tangential mindlin_rescale/force NULL 1 0.4 damping coeff_restitution limit_damping",
    "hertz/material 5e5 0.3 0.3 tangential mindlin_liggghts NULL 1 0.4 damping tsuji rolling epsd 0.1 0.1",
    f"jkr 5e5 5 0.3 30 {PLAIN} damping viscoelastic",
    f"hysteretic 1e5 0.7 {PLAIN} rolling epsd2 0.1", f"eepa 4e5 0.8 0.5 30 1.5 2 0 {PLAIN} rolling sds 1e3 1 0.1",
    f"hooke 1e5 10 {PLAIN} rolling epsd2 0.1 cohesion capillary 3 20 60 1e-4", f"hysteretic 1e5 0.7 {PLAIN} cohesion linear 1e3 0.01")


def cloud(folder, law, dt, run, ranks=1, newton="off", head=CLOUD_HEAD):
    script = head.replace("newton          off", f"newton          {newton}") + CLOUD.format(law=law, dt=dt, run=run)
    return books(lmp.run_well(script, folder, ranks))


@pytest.mark.parametrize("law", CLOUD_LAWS)
def test_laws(folder, law):
    """The balance of grains that collide differs from that at the beginning by the remainder, and this falls with dt^2."""
    remainders = []
    for dt in (4e-5, 2e-5):
        first, last = cloud(folder, law, dt, f"run {round(0.04 / dt)}")
        at_most("kinetic energy is LAMMPS's", abs(last["kinetic"] - last["ke"] - last["spin"]) / last["kinetic"], 1e-12)
        lost = first["kinetic"] - last["kinetic"]
        # Kinetic energy at full steps is off by F^2 dt^2/(8 m), a part (w dt)^2/4 of what 30 open contacts hold.
        held = 30 * 0.25 * 3e5 * dt ** 2
        at_most("balance and remainder", abs(last["balance"] + last["remainder"] - first["balance"]) / last["held"], held)
        remainders.append(last["remainder"] / lost)
    print(remainders)
    at_most("remainder over the energy that is lost", max(map(abs, remainders)), 2e-4)
    # Where jkr jumps it is of first order, and the sum of many jumps of any sign.
    if not law.startswith("jkr"):
        at_most("a half of the timestep has a quarter of it", abs(remainders[1]), abs(remainders[0]) / 2.5)


def same(name, book, wanted, tolerance=1e-12):
    size = abs(wanted["kinetic"])
    for key in ("balance", *NAMES):
        if "power" not in key:
            close(f"{name}: {key}", book[key], wanted[key], size, tolerance)


# Sums in another order differ by rounding, which a collision multiplies; there are a few in this time.
TOLERANCE = 1e-9


@pytest.mark.parametrize("law", (CLOUD_LAWS[1], CLOUD_LAWS[3], CLOUD_LAWS[7], CLOUD_LAWS[9]))
def test_processes_and_restart(folder, law):
    """With newton on and off, on 1 and 4 processes, and after a restart in the middle the books are the same. Lists are made anew as grains
    move, and grains go to other processes."""
    run = "run {n}\nrun {n}".format(n=300)
    whole = cloud(folder, law, 4e-5, run)[-1]
    fact("there is something to compare", whole["slider"] > 0 and whole["held"] > 0, whole)
    for newton in ("off", "on"):
        for ranks in (1, 4):
            same(f"newton {newton}, {ranks} processes", cloud(folder, law, 4e-5, run, ranks, newton)[-1], whole, TOLERANCE)
    cloud(folder, law, 4e-5, "run 300\nwrite_restart half.restart")
    again = CLOUD[CLOUD.index("pair_style"):].format(law=law, dt=4e-5, run="run 300")
    for ranks in (1, 4):
        text = lmp.run_well("newton off\nread_restart half.restart\ncomm_modify vel yes\n" + again, folder, ranks)
        same(f"restarted on {ranks}", books(text)[-1], whole, TOLERANCE)


def test_grains_that_change_places(folder):
    """Two grains that slip and roll on each other go to another process one after the other, so that the pair is seen from its other side:
    forces that it has kept change sign."""
    law = f"hooke {KN} 20 damping mass_velocity tangential linear_history 4e3 1 0.3 rolling sds 1e3 0.1 0.2 twisting sds 30 0.1 0.02"
    dt, n, rows = 1e-4, 180, []
    move = ("fix move all nve/sphere\nneigh_modify every 1 check no\nvelocity one set 1 1 0\nvelocity two set 1 -1 0.3\n"
            "set group one omega 3 -2 1\nset group two omega 1 2 4")
    script = lmp.head("-3 3 -3 3 -3 3", newton="{newton}") + "processors * 1 1\n" + TWO.format(law=law, dt=dt, run=f"run {n}", b="-0.012 1 0", move=move)
    script = script.replace("single 0 0 0", "single -0.01 0 0").replace("processors * 1 1\n", "").replace("region ", "processors * 1 1\nregion ", 1)
    for newton in ("off", "on"):
        for ranks in (1, 2):
            rows.append(books(lmp.run_well(script.replace("{newton}", newton), folder, ranks))[-1])
            same(f"newton {newton}, {ranks} processes", rows[-1], rows[0])
    fact("they slip and roll, and touch still", rows[0]["slider"] > 0 and rows[0]["rolling"] > 0 and rows[0]["held"] > 0, rows[0])


def test_books_that_come_and_go(folder):
    """Grains move to the bit as without the compute; it may come and go between runs, and before and after a restart."""
    law = CLOUD_LAWS[3]
    dump = "write_dump all custom {name} id x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g"
    script = CLOUD_HEAD + CLOUD.replace(OUTPUT, "").format(law=law, dt=4e-5, run="run 300\n{between}\nrun 200\n{after}\nrun 200\n" +
                                                          dump.format(name="{name}"))
    lmp.run_well(script.format(between=OUTPUT, after="thermo_style one\nuncompute books", name="with.txt"), folder)
    lmp.run_well(script.format(between="", after="", name="without.txt"), folder)
    fact("grains move as without", (folder / "with.txt").read_bytes() == (folder / "without.txt").read_bytes())
    first, last = books(lmp.run_well(script.format(between=OUTPUT, after="", name="on.txt").replace("run 200\nwrite", "write"), folder))
    fact("contacts that are there at the begin bring what they hold", first["inserted"] == -first["held"] != 0, first)
    at_most("remainder", abs(last["remainder"]) / last["kinetic"], 1e-4)
    # A restart file of a run without books, read with them, and the other way round.
    rest = CLOUD[CLOUD.index("pair_style"):].format(law=law, dt=4e-5, run="run 200\n" + dump)
    begin = CLOUD_HEAD + CLOUD.format(law=law, dt=4e-5, run="run 300\nwrite_restart half.restart")
    read = "newton off\nread_restart half.restart\ncomm_modify vel yes\n"
    for first in (True, False):
        lmp.run_well(begin if first else begin.replace(OUTPUT, ""), folder)
        for then in (True, False):
            lmp.run_well(read + (rest if then else rest.replace(OUTPUT, "")).format(name=f"{first}{then}.txt"), folder)
            fact(f"restarted, {first} and {then}", (folder / f"{first}{then}.txt").read_bytes() == (folder / "TrueTrue.txt").read_bytes())


def test_many_setups(folder):
    """What grains hold does not change where a run begins anew: nothing is inserted, and books of 20 runs close as those of one."""
    for law in CLOUD_LAWS[1:]:
        one, many = (cloud(folder, law, 4e-5, run)[-1] for run in ("run 1000", "run 50\n" * 20))
        lost = sum(one[c] for c in CAUSES if c != "adhesion")
        close(f"{law}: inserted", many["inserted"], one["inserted"], lost, 1e-12)
        at_most(f"{law}: remainders", max(abs(b["remainder"]) for b in (one, many)) / lost, 2e-3)


def test_grains_that_come_and_go(folder):
    """What a contact holds that is deleted with its grain is lost; what one holds that begins in overlap was there before."""
    law, held = f"law hooke {KN} NULL 0 NULL 0 0", KN * OVERLAP ** 2 / 2
    deleted = two(folder, law, 1e-4, "run 10\ngroup gone id 2\ndelete_atoms group gone compress no\nrun 10", BESIDE,
                  "fix move all move linear 0 0 0 units box")
    close("inserted at the begin, and deleted", deleted["inserted"], 0, held, 1e-12)
    fact("nothing is held", deleted["held"] == 0, deleted["held"])
    added = two(folder, law, 1e-4, "fix come all deposit 1 1 1 7 region point\nrun 10", "2 0 0",
                "region point block 0.99 0.991 0 0 0 0 units box\nfix move all move linear 0 0 0 units box")
    close("added", added["inserted"], -added["held"], held, 1e-12)
    fact("it holds something", 0 < added["held"] <= held, added["held"])


def grind(folder, **variables):
    """The numbers that examples/mill prints."""
    place = lmp.HERE.parent.parent / "examples" / "mill"
    text = lmp.run_well(place / "in.mill", folder, dir=place, timeout=3000, **variables)
    words = re.findall(r"^mill (.*)$", text, re.M)[-1].split()
    return dict(zip(words[::2], map(float, words[1::2])))


def test_ball_mill(folder):
    """Of a mill with 327 balls the books close to 1e-4 of the work of the drive at 150 steps a contact, pairs and walls together, and the
    remainder falls with dt^2. The balance of the whole differs by it. At the begin of the turn balls move alike with each timestep."""
    rows = [grind(folder, steps=n, until=0.1) for n in (50, 100, 150)]
    for a, b in zip(rows, rows[1:]):
        wanted = (b["steps"] / a["steps"]) ** 2
        close(f"the remainder falls with dt^2 from {a['steps']} steps on", a["remainder"] / b["remainder"], wanted, wanted, 0.25)
    # A turn. With /kk on a CPU its tenth above runs the same code; a GPU has it, too.
    rows += [] if lmp.QUICK or (lmp.ON_KOKKOS and not lmp.ON_GPU) else [grind(folder, steps=150)]
    for r in rows:
        print(r)
        fact("all causes dissipate", all(r[c] > 0 for c in CAUSES if c != "adhesion"), r)
        # Kinetic energy at full steps is off by (w dt)^2/4 of what open contacts hold, which is no more than a ball's share.
        at_most("the balance changes by the remainder", abs(r["change"] + r["remainder"]), (math.pi / r["steps"]) ** 2 / 4)
        if r["steps"] == 150:
            at_most("remainder over the work of the drive", abs(r["remainder"]), 1e-4)


def test_two_gravities(folder):
    """The energy in gravity is that of all fixes, each of its group: -m g x."""
    move = "fix move all nve/sphere\nfix down all gravity 3 vector 0 0 -1\nfix aside two gravity 2 vector 1 0 0"
    r = two(folder, "law hooke 1e4 NULL 0 NULL 0 0", 1e-3, "run 0", "1.5 0.25 0.5", move)
    at_most("energy in gravity", abs(r["gravity"] - (3 * 0.5 - 2 * 1.5)), 1e-14)


def test_read_as_a_step_begins(folder):
    """The balance alone is that of the whole step, though the speed of a belt reads books as the step begins."""
    stl.write(folder / "belt.stl", stl.square(3, -0.49))

    def run(reads):
        belt = f"variable speed equal 0.3+0*{reads}\nfix belt all wall/lsdcd hooke 1e4 NULL 20 NULL 0.5 1 mesh belt.stl surface_vel v_speed 0 0 energy\n"
        text = lmp.head("-3 3 -3 3 -3 3") + TWO.format(law="law hooke 1e4 NULL 20 NULL 0.5 1", dt=1e-3, b="0.98 0 0",
                                                       move="fix move all nve/sphere\nfix pull all gravity 10 vector 0 0 -1", run="") + belt
        shown = "thermo_style custom step c_books\nthermo_modify format float %.17g norm no\nthermo 1\nrun 20\n"
        return lmp.read_thermo(lmp.run_well(text + shown, folder))
    rows = run("step")
    fact("a variable that reads books changes no output", run("c_books[22]") == rows and len({row[1] for row in rows}) > 5, str(rows))


def test_refusals(folder):
    """What it does not serve is an error with a reason."""
    script = lmp.head("-3 3 -3 3 -3 3") + TWO.format(law="law hooke 1 NULL 0 NULL 0 0", dt=1e-4, run="run 1", b="2 0 0",
                                                     move="fix move all nve/sphere")
    for change, word in ((("all lsdcd/energy", "one lsdcd/energy"), "of all atoms"), (("lsdcd/energy", "lsdcd/energy all"), "'all' is not expected"),
                         (("pair_style      granular/lsdcd\npair_coeff      * * law hooke 1 NULL 0 NULL 0 0", "pair_style zero 1.2\npair_coeff * *"),
                          "pair_style granular/lsdcd"),
                         (("run 1", "run_style respa 2 2 pair 1\nrun 1"), "run_style verlet")):
        fact(f"{change} is in the script", change[0] in script)
        lmp.refused(change[1], script.replace(*change), folder, word)


def test_minimization(folder):
    """No time passes in a minimization: springs stay, and nothing is dissipated, though grains have velocities."""
    law = "hertz/material 1e4 5 0.3 tangential mindlin NULL 1 0.4 rolling sds 300 2 0.3"
    hold = "fix move all nve/noforce\nset group one omega 0.5 0.3 0.2\n"
    shown = "write_dump all custom {} id fx fy fz tqx tqy tqz modify sort id format float %.17g\n"

    def end(more):
        text = lmp.head("-3 3 -3 3 -3 3") + TWO.format(law=law, dt=1e-4, b="0.98 0 0", move=hold, run="run 100\n" + shown.format("before") + more)
        return books(lmp.run_well(text, folder))[-1]

    moved = end("")
    stayed = end("fix still all setforce 0 0 0\nminimize 0 0 5 5\nunfix still\nrun 0\n" + shown.format("after"))
    before, after = ({0: next(iter(lmp.read_dump(folder / name).values()))} for name in ("before", "after"))
    fact("springs press", abs(before[0][1][1]) > 0.01, str(before))
    at_most("forces and torques", lmp.largest_difference(before, after), 1e-12)
    for row in (*CAUSES, *OTHERS, "remainder"):
        at_most(row, abs(stayed[row] - moved[row]), 1e-12)


def test_rerun(folder):
    """A rerun records nothing of contacts, and says so once."""
    script = lmp.head("-3 3 -3 3 -3 3") + TWO.format(law="law hooke 1e3 NULL 5 NULL 0 0", dt=1e-4, b="0.98 0 0", move="fix move all nve/sphere", run="{run}")
    lmp.run_well(script.format(run="dump all all custom 50 snapshots id type x y z vx vy vz\ndump_modify all format float %.17g\nrun 200"), folder)
    told = lmp.run_well(script.format(run="rerun snapshots dump x y z vx vy vz\nrun 10"), folder)
    fact("it is told once", told.count("a rerun has no steps, and records nothing of contacts") == 1)
    rerun, run = books(told)[-2:]
    at_most("no work in a rerun", abs(rerun["work"]) + abs(rerun["damping"]), 0)
    fact("work in the run behind it", run["damping"] > 0, str(run))


def test_discs(folder):
    """In two dimensions grains of fix nve/sphere disc turn with a moment of inertia of m r^2/2, and others with 2/5 m r^2: the kinetic energy is that of
    both, and a disc that rolls, slips and bounces between two others keeps the balance."""
    head = lmp.head("-3 3 -3 3 -0.5 0.5", "f f p").replace("boundary", "dimension 2\nboundary")
    law = "law hooke/history 1e4 NULL 0 0 0.3 0"
    spins = "set group all omega 0 0 3\nfix flat all enforce2d\nfix one one nve/sphere{}\nfix two two nve/sphere disc"
    for word, inertia in (("", 0.4), (" disc", 0.5)):
        script = head + TWO.format(law=law, dt=1e-4, run="run 100", b="1.5 0 0", move=spins.format(word))
        kinetic = books(lmp.run_well(script, folder))[-1]["kinetic"]
        at_most(f"kinetic energy of grain one{word}", abs(kinetic - 0.5 * 0.25 * 9 * (inertia + 0.5)), 1e-12)
    balance = []
    for dt in (2e-4, 1e-4):
        script = head + TWO.format(law=law, dt=dt, run=f"run {0.4 / dt:.0f}", b="1.2 0.3 0", move=spins.format(" disc") + "\nvelocity two set -1 0 0")
        rows = books(lmp.run_well(script, folder))
        fact("they slip", rows[-1]["slider"] > 0.02 and rows[-1]["held"] == 0, rows[-1])
        balance.append(abs(rows[-1]["balance"] - rows[0]["balance"]))
    # The remainder of the step in which they touch, k (v dt)^2/8 at both ends, of grains that meet at 1 and slip at 3.
    at_most("change of the balance", max(balance[0] / 4, balance[1]), 1e4 * 1e-8 / 4)
