# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Cohesion across a gap: between two grains beside an own law in numpy, in lists of neighbours and over borders, its energy, restarts, mixed laws and what is refused."""
import math

import numpy as np
import pytest

import lmp
import scene
import reaching_oracle as oracle
from facts import at_most, fact

A, B = 0.5, 0.3
REDUCED = A * B / (A + B)
SLIP = "tangential linear_nohistory 0 0"
BOTH = 4 / 3 * math.pi * (A**3 + B**3)    # volume of the two grains
LAWS = {"capillary": ("capillary 3 20 70 1e-5", lambda: oracle.Bridge(3, (20, 70), 1e-5, 2 * REDUCED, 1)),
        "capillary/share": ("capillary/share 3 30 NULL 1e-5", lambda: oracle.Bridge(3, (30, 30), 1e-5 * BOTH, 2 * REDUCED, 1)),
        "constant": ("constant 5 0.03", lambda: oracle.Constant(5, 0.03)),
        "constant/weight": ("constant/weight 0.7 9.8 0.03", lambda: oracle.Constant(0.7 * 2 * 9.8, 0.03)),
        "linear": ("linear 100 0.03", lambda: oracle.Linear(100, 0.03))}
PAIR = """\
create_atoms    1 single -0.1 0 0 units box
create_atoms    1 single {apart!r} 0 0 units box
set             atom 1 diameter 1
set             atom 2 diameter 0.6
set             atom 1 mass 2
set             atom 2 mass 3
group           one id 1
group           two id 2
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        {skin} bin
neigh_modify    delay 0 every 1 check yes
timestep        1e-3
"""


@pytest.mark.parametrize("ranks,skin", [(1, 0.1), (1, 0.005), (2, 0.005)])
@pytest.mark.parametrize("name", LAWS)
def test_path_of_two_grains(folder, name, ranks, skin):
    """A grain is moved towards another one, through touch and rupture, and away. Forces are those of the oracle but for rounding of the overlap, which is that of places of size 1,
    times the steepest slope over the force; the skin is wider than the gap, or much narrower, and the border between two processes is in the gap."""
    words, law = LAWS[name]
    steps = 600 if lmp.QUICK else 2000
    script = lmp.head("-3 3 -3 3 -3 3") + PAIR.format(apart=A + B - 0.07, law=f"hooke 1e4 0 {SLIP} damping none cohesion {words}", skin=skin) + f"""\
variable        x equal -0.03*sin(11*step*dt)-0.025*sin(29*step*dt)-0.02*sin(67*step*dt)
variable        v equal -0.33*cos(11*step*dt)-0.725*cos(29*step*dt)-1.34*cos(67*step*dt)
fix             swing two move variable v_x NULL NULL v_v NULL NULL
fix             hold one move linear 0 0 0
dump            d all custom 1 path id x fx
dump_modify     d format float %.17g sort id
run             {steps}
"""
    lmp.run_well(script, folder, ranks)
    rows, law = lmp.read_dump(folder / "path"), law()
    d = np.array([[A + B - (rows[k][2][0] - rows[k][1][0])] for k in range(steps + 1)])
    pulls = np.array([law.go_to(each)[0] for each in d])
    wanted = 1e4 * np.maximum(d[:, 0], 0) - pulls
    found = np.array([rows[k][2][1] for k in range(steps + 1)])
    fact(f"{name}: it comes and goes, and is pulled across a gap", d.max() > 0 and np.count_nonzero(pulls == 0) > 20 and np.count_nonzero((d[:, 0] < 0) & (pulls > 0)) > 10,
         f"{d.min()} {d.max()}")
    at_most(f"{name}: difference over the largest force", np.abs(found - wanted).max() / np.abs(wanted).max(), 1e-12)


@pytest.mark.parametrize("where", ["wall", "grains"])
@pytest.mark.parametrize("name", ["capillary 0.3 20 NULL 1e-6", "constant 2 0.02", "linear 100 0.02"])
def test_books_of_a_bounce(folder, name, where):
    """A grain comes, bounces and goes. A bridge loses the work of its pull from touch to rupture, and the others nothing. A pull that jumps does so within a step, so the
    remainder is at most twice its jump times the path of a step, beside a part that falls with the square."""
    r = 0.5
    reduced = r if where == "wall" else r / 2
    bridge = oracle.Bridge(0.3, (20, 20), 1e-6, 2 * reduced, 1)
    s = np.linspace(0, bridge.rupture, 20001)
    p = s / 2 * np.sqrt(2 * reduced / 1e-6)
    pull = bridge.at_touch / (1 + 2.1 * p + 10 * p**2)
    work = np.sum((pull[1:] + pull[:-1]) / 2) * (s[1] - s[0])
    jump, wanted = (bridge.at_touch + pull[-1], work) if "capillary" in name else (2 * 2, 0) if "constant" in name else (0, 0)
    mass = 1 if where == "wall" else 2
    dt = math.pi / math.sqrt(1e4 * (1 if where == "wall" else 1)) / 100
    lmp.flat_floor(folder)
    for phase in range(2 if lmp.QUICK else 50):
        start = 0.03 + phase / 50 * dt
        law = f"hooke 1e4 0 {SLIP} damping none cohesion {name}"
        if where == "wall":
            script = lmp.head("-3 3 -3 3 -1 5") + f"""\
create_atoms    1 single 0.2 0.1 {r + start!r} units box
set             group all diameter 1 mass 1
velocity        all set 0 0 -1
{lmp.pairs()}fix m all nve/sphere
fix w all wall/lsdcd granular {law} mesh floor.stl energy
variable        v equal vz[1]
thermo_style    custom step v_v f_w[64] f_w[72]
"""
        else:
            script = lmp.head("-3 3 -3 3 -3 3") + f"""\
create_atoms    1 single 0 0 0 units box
create_atoms    1 single {2 * r + start!r} 0 0 units box
set             group all diameter 1 mass {mass}
set             atom 1 vx 0.5
set             atom 2 vx -0.5
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
fix             m all nve/sphere
compute         books all lsdcd/energy
variable        v equal vx[2]-vx[1]
thermo_style    custom step v_v c_books[10] c_books[17]
"""
        text = lmp.run_well(script + f"thermo_modify norm no format float %.17g\ntimestep {dt!r}\nrun {int(0.1 / dt) + 100}\n", folder)
        _, v, adhesion, remainder = lmp.read_thermo(text)[-1]
        at_most(f"{name}, {where}, phase {phase}: what adhesion has lost", abs(adhesion - wanted), 1e-6 * work)
        at_most(f"{name}, {where}, phase {phase}: remainder", abs(remainder), 2 * jump * dt + 4e-4 * 0.5)
        at_most(f"{name}, {where}, phase {phase}: speed", abs(v * v / 2 - (0.5 - wanted)), 2 * jump * dt + 1e-3 * 0.5)


WET = "hysteretic 1e4 0.6 tangential linear_history 4e3 0 0.4 rolling epsd2 0.1 cohesion capillary 3 20 60 1e-4"


def test_restart_and_processes(folder):
    """A restart in the middle of contacts and bridges goes on to the last bit on as many processes, at a wall and between grains, and as without on more."""
    scene.bumpy_floor(folder)

    def script(make, run):
        forces = scene.forces(f"granular {WET}").replace(lmp.pairs("zero 1.2"), f"pair_style granular/lsdcd\npair_coeff * * {WET}\n"
                                                         "neighbor 0.3 bin\nneigh_modify delay 0 every 1 check yes\n")
        return make + forces.replace("timestep        0.001", "timestep        0.0005") + scene.dump("out", 600) + run
    both = "run 600\nwrite_restart half\nrun 600\n"
    lmp.run_well(script(scene.CREATE, both), folder)
    whole = lmp.read_dump(folder / "out")[1200]
    touching = sum(row[9] > 0 for row in whole.values())
    fact(f"grains touch the wall: {touching}", touching >= 3)
    for ranks in (1, 2):
        if ranks > 1:
            lmp.run_well(script(scene.CREATE, both), folder, ranks)
            at_most(f"{ranks} processes", lmp.largest_difference({1200: whole}, {1200: lmp.read_dump(folder / 'out')[1200]}), 1e-6)
        here = lmp.read_dump(folder / "out")[1200]
        lmp.run_well(script(scene.SETTINGS + "read_restart half\n", "run 600\n"), folder, ranks)
        at_most(f"continued on {ranks}", lmp.largest_difference({1200: here}, {1200: lmp.read_dump(folder / 'out')[1200]}), 0 if ranks == 1 else 1e-9)


MIXED = [("capillary 1 0 NULL 1e-4", "capillary 4 90 NULL 4e-4", "capillary 2 0 90 2e-4"), ("capillary/share 1 20 NULL 1e-4", "capillary/share 4 70 NULL 4e-4", "capillary/share 2 20 70 2e-4"),
         ("constant 1 0.02", "constant 4 0.08", "constant 2 0.04"), ("linear 100 0.02", "linear 400 0.08", "linear 160 0.04")]


@pytest.mark.parametrize("own,other,mixed", MIXED)
def test_mixed_laws(folder, own, other, mixed):
    """Two types without a law together have the geometric mean of each number but K, which is in series, and the angle of each."""
    def force(law):
        normal = f"hooke 1e4 0 {SLIP} damping none cohesion"
        coeffs = f"1 1 {normal} {own}\npair_coeff 2 2 {normal} {other}" + (f"\npair_coeff 1 2 {normal} {law}" if law else "")
        script = lmp.head("-3 3 -3 3 -3 3", types=2) + PAIR.format(apart=A + B - 0.1 - 0.001, law=coeffs, skin=0.1).replace("* *", "") + """\
set atom 2 type 2
fix hold one move linear 0 0 0
fix lift two move linear 0.5 0 0
variable f equal fx[2]
thermo_style custom step v_f
thermo_modify format float %.17g
thermo 10
run 40
"""
        return [row[1] for row in lmp.read_thermo(lmp.run_well(script, folder))]
    found, wanted = force(""), force(mixed)
    fact(f"{own} and {other}: it pulls across a gap", sum(f < 0 for f in wanted) >= 3, wanted)
    at_most(f"{own} and {other}", max(abs(f - w) for f, w in zip(found, wanted)) / max(map(abs, wanted)), 1e-14)


REFUSED = [("beside jkr", "granular jkr 1e5 1 0.3 0.1 tangential linear_nohistory 0 0 cohesion constant 1 0.1", "'jkr' acts beyond touch itself"),
           ("K above the spring", f"granular hooke 1e3 0 {SLIP} damping none cohesion linear 2e3 0.1", "K = 2000 of 'linear' is not below 1000"),
           ("an obtuse angle", f"granular hooke 1e3 0 {SLIP} damping none cohesion capillary 1 120 NULL 1e-3", "120"),
           ("no volume", f"granular hooke 1e3 0 {SLIP} damping none cohesion capillary 1 20 NULL 0", "V")]


@pytest.mark.parametrize("name,law,says", REFUSED, ids=[row[0] for row in REFUSED])
def test_refused(folder, name, law, says):
    lmp.flat_floor(folder)
    script = lmp.head("-3 3 -3 3 -1 5") + "create_atoms 1 single 0 0 2\nset group all diameter 1 mass 1\n"
    lmp.refused(f"{name}, at a wall", f"{script}{lmp.pairs()}fix w all wall/lsdcd {law} mesh floor.stl\n", folder, says)
    lmp.refused(f"{name}, between grains", f"{script}pair_style granular/lsdcd\npair_coeff * * {law.removeprefix('granular ')}\nrun 0\n", folder, says)


def test_refused_beside_a_classic_style(folder):
    lmp.flat_floor(folder)
    script = lmp.head("-3 3 -3 3 -1 5") + "create_atoms 1 single 0 0 2\nset group all diameter 1 mass 1\n"
    style = "hooke 1e3 NULL 10 NULL 0 1"
    for words in (f"{lmp.pairs()}fix w all wall/lsdcd {style} mesh floor.stl cohesion constant 1 0.1\n", f"pair_style granular/lsdcd\npair_coeff * * law {style} cohesion constant 1 0.1\nrun 0\n"):
        lmp.refused("beside a classic style", script + words, folder, "acts beyond touch")
