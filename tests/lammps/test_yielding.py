# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Contacts that yield: between two grains beside an own law in numpy, impacts at walls and between grains, restarts, mixed laws and what is refused."""
import math

import numpy as np
import pytest

import lmp
import scene
import stl
import yielding_oracle as oracle
from facts import at_most, fact

A, B = 0.5, 0.3
REDUCED = A * B / (A + B)
SLIP = "tangential linear_nohistory 0 0"
LAWS = {"hysteretic": ("hysteretic 1e4 0.5", lambda: oracle.Hysteretic(1e4, 0.5, 1)),
        "hysteretic/size": ("hysteretic/size 4e4 0.7", lambda: oracle.Hysteretic(2 * 4e4 * REDUCED, 0.7, 1)),
        "hysteretic/edem": ("hysteretic/edem 4e4 0.3", lambda: oracle.Hysteretic(5 * 4e4 * REDUCED, 0.3, 1)),
        "eepa": ("eepa 1e5 1 0.6 30 1.5 2.5 -0.2", lambda: oracle.Eepa(1e5, 0.6, 30, 1.5, 2.5, -0.2, oracle.circle_of_spheres(A, B), 1)),
        "lepa": ("lepa 1e4 0 5e4 1e4 0.05", lambda: oracle.Lepa(1e4, 5e4, 1e4, 0.05, 2 * REDUCED, 1)),
        "thornton": ("thornton 1e6 0 0.3 5e4", lambda: oracle.Thornton(1e6 / (2 * (1 - 0.3**2)), 5e4, REDUCED, 1))}
PAIR = """\
create_atoms    1 single 0 0 0 units box
create_atoms    1 single {apart!r} 0 0 units box
set             atom 1 diameter 1
set             atom 2 diameter 0.6
set             group all mass 1
group           one id 1
group           two id 2
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
timestep        1e-3
"""


@pytest.mark.parametrize("name", LAWS)
def test_path_of_two_grains(folder, name):
    """A grain is moved towards another one and away, by swings that are no multiples of each other. Forces are those of the oracle but for rounding of
    the overlap, which is that of places of size 1, times the steepest slope over the force."""
    words, law = LAWS[name]
    steps = 400 if lmp.QUICK else 2000
    script = lmp.head("-3 3 -3 3 -3 3") + PAIR.format(apart=A + B - 0.02, law=f"{words} {SLIP} damping none") + f"""\
variable        x equal 0.008*sin(11*step*dt)+0.006*sin(29*step*dt)+0.004*sin(67*step*dt)
variable        v equal 0.088*cos(11*step*dt)+0.174*cos(29*step*dt)+0.268*cos(67*step*dt)
fix             swing two move variable v_x NULL NULL v_v NULL NULL
fix             hold one move linear 0 0 0
dump            d all custom 1 path id x fx
dump_modify     d format float %.17g sort id
run             {steps}
"""
    lmp.run_well(script, folder)
    rows, law = lmp.read_dump(folder / "path"), law()
    # The setup of the run is before the first step: its force is that of a loading, and it moves nothing.
    d = np.array([[A + B - (rows[k][2][0] - rows[k][1][0])] for k in range(1, steps + 1)])
    wanted = np.array([law.go_to(each)[0] for each in d])
    found = np.array([rows[k][2][1] for k in range(1, steps + 1)])
    fact(f"{name}: it goes up and down", np.ptp(d) > 0.02 and d.min() > 0, f"{d.min()} {d.max()}")
    at_most(f"{name}: difference over the largest force", np.abs(found - wanted).max() / np.abs(wanted).max(), 1e-12)


@pytest.mark.parametrize("cells", [1, 40])
@pytest.mark.parametrize("e", [0.9, 0.5])
def test_impact_at_a_wall(folder, e, cells):
    """A sphere that falls on a plane, cut coarsely or finely, comes back with e, and what it lost is plastic: (1 - e^2) m v^2/2. With 200 steps in half
    a period of unloading e is wrong by 1.1e-5 at 0.5 and 6e-6 at 0.9 (a prototype), and the books by 1.9e-5 of the energy at most."""
    stl.write(folder / "floor.stl", stl.sheet(cells, lambda i, j: (6 * i / cells - 3, 6 * j / cells - 3, 0)))
    k1 = 1e4
    dt = e * math.pi / math.sqrt(k1) / 200
    text = lmp.run_well(lmp.head("-3 3 -3 3 -1 5") + f"""\
create_atoms    1 single 0.2 0.1 {0.5 + 1.3 * dt!r} units box
set             group all diameter 1 mass 1
velocity        all set 0.3 0 -1
{lmp.pairs()}fix m all nve/sphere
fix w all wall/lsdcd granular hysteretic {k1} {e} tangential linear_history {k1} 0 0.5 mesh floor.stl energy
timestep {dt!r}
thermo_style custom step vz f_w[76] f_w[77] f_w[72]
thermo_modify format float %.17g
thermo 1000
run 1000
""".replace("step vz", "step f_w[1]").replace("thermo_style custom step f_w[1]", "variable vz equal vz[1]\nthermo_style custom step v_vz"), folder)
    _, vz, power, lost, remainder = lmp.read_thermo(text)[-1]
    at_most(f"e {e}, {cells}: restitution", abs(vz / e - 1), 2e-5)
    at_most(f"e {e}, {cells}: what yielding has lost", abs(lost / ((1 - e**2) / 2) - 1), 1e-4)
    at_most(f"e {e}, {cells}: remainder", abs(remainder / 0.5), 2e-5)
    fact(f"e {e}, {cells}: nothing yields when it has left", power == 0, power)


def bounce_of_eepa():
    """At speed 1 of a mass of 1 with k1 1e4, k2 2.5e4 and the surface energy 30: energy less what is held at the deepest place, plus the way back along
    the adhesive branch."""
    k2, deepest, plastic = 2.5e4, 0.01, 0.006
    pull = 1.5 * math.pi * 30 * math.sqrt(plastic * (1 - plastic))
    turn = plastic - pull / k2
    return math.sqrt(1 - 2 * (0.5 - k2 / 2 * (deepest - plastic) ** 2 + pull ** 2 / (2 * k2) + pull * turn / 2))


def bounce_of_lepa():
    """Likewise with k1 1e4, kp 5e4, kc 1e4 and phi 0.05: k2 is that of the overlap 0.01."""
    k2 = 1e4 + 4e4 * 0.01 / (5 / 4 * 0.05)
    return math.sqrt(1 - (k2 - 1e4) * 2e4 / (1e4 * (k2 + 1e4)))


@pytest.mark.parametrize("law,e,steepest", [("eepa 1e4 1 0.6 30 1 1 0", bounce_of_eepa(), 2.5e4), ("lepa 1e4 0 5e4 1e4 0.05", bounce_of_lepa(), 5e4)])
def test_adhesive_bounce(folder, law, e, steepest):
    """A sphere pulls itself off a wall along the adhesive branch. With 200 steps in half a period of unloading e and the loss are off by 2.3e-5, the books by
    1.3e-5 of the energy; with twice as many by a quarter."""
    lmp.flat_floor(folder)
    for steps, of_e, of_books in ((200, 5e-5, 2e-5), (400, 1.3e-5, 5e-6)):
        dt = math.pi / math.sqrt(steepest) / steps
        for phase in (0, 0.25, 0.5, 0.75):
            text = lmp.run_well(lmp.head("-3 3 -3 3 -1 5") + f"""\
create_atoms    1 single 0.2 0.1 {0.5 + (1 + phase) * dt!r} units box
set             group all diameter 1 mass 1
velocity        all set 0 0 -1
{lmp.pairs()}fix m all nve/sphere
fix w all wall/lsdcd granular {law} {SLIP} damping none mesh floor.stl energy
timestep        {dt!r}
variable        vz equal vz[1]
thermo_style    custom step v_vz f_w[77] f_w[72]
thermo_modify   format float %.17g
run             {6 * steps}
""", folder)
            _, vz, lost, remainder = lmp.read_thermo(text)[-1]
            at_most(f"{law}, {steps} steps, phase {phase}: restitution", abs(vz / e - 1), of_e)
            at_most(f"{law}, {steps} steps, phase {phase}: what it has lost", abs(lost / ((1 - e**2) / 2) - 1), of_e)
            at_most(f"{law}, {steps} steps, phase {phase}: remainder", abs(remainder / 0.5), of_books)


@pytest.mark.parametrize("name", ["hysteretic 1e4 0.6 tangential linear_history 4e3 0 0.4 rolling epsd2 0.1", scene.YIELDING.removeprefix("granular ")])
def test_restart_and_processes(folder, name):
    """A restart in the middle of contacts goes on to the last bit on as many processes, at a wall and between grains, and as without on more."""
    scene.bumpy_floor(folder)

    def script(make, run):
        forces = scene.forces(f"granular {name}").replace(lmp.pairs("zero 1.2"), f"pair_style granular/lsdcd\npair_coeff * * {name}\n"
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


@pytest.mark.parametrize("law", ["hysteretic 1e4 0.5", "eepa 1e4 1 0.6 30 1 1 0", "lepa 1e4 0 5e4 1e4 0.05", "thornton 1e6 0 0.3 5e4"])
def test_put_into_overlap(folder, law):
    """A grain that is put into overlap has yielded to there: its first steps lose nothing by yielding, and what it is pressed deeper does."""
    lmp.flat_floor(folder)
    at_wall = lmp.head("-3 3 -3 3 -1 5") + f"""\
create_atoms    1 single 0.2 0.1 0.48 units box
set             group all diameter 1 mass 1
{lmp.pairs()}fix w all wall/lsdcd granular {law} {SLIP} damping none mesh floor.stl energy
thermo_style    custom step f_w[77]
"""
    between = lmp.head("-3 3 -3 3 -3 3") + PAIR.format(apart=A + B - 0.02, law=f"{law} {SLIP} damping none") + """\
compute         books all lsdcd/energy
thermo_style    custom step c_books[24]
"""
    press = {"wall": "fix m all move linear 0 0 {v}\n", "grains": "fix h one move linear 0 0 0\nfix m two move linear {v} 0 0\n"}
    for where, script in (("wall", at_wall), ("grains", between)):
        lost = []
        for v in (0, -0.5):
            text = script + "thermo_modify norm no format float %.17g\ntimestep 1e-3\n" + press[where].format(v=v) + "run 20\n"
            lost.append(lmp.read_thermo(lmp.run_well(text, folder))[-1][1])
        fact(f"{law}, {where}: nothing is lost where it lies: {lost[0]}, and something as it is pressed: {lost[1]:.3g}", lost[0] == 0 and lost[1] > 1e-3)


def test_mixed_laws(folder):
    """Two types without a law together have k1 in series, the lesser Y, and the geometric mean of e; n and chi must be equal."""
    def force(own, other, mixed):
        law = f"1 1 {own} {SLIP}\npair_coeff 2 2 {other} {SLIP}" + (f"\npair_coeff 1 2 {mixed} {SLIP}" if mixed else "")
        script = lmp.head("-3 3 -3 3 -3 3", types=2) + PAIR.format(apart=A + B - 0.02, law=law).replace("* *", "") + """\
set atom 2 type 2
fix hold one move linear 0 0 0
fix lift two move linear 0.5 0 0
variable f equal fx[2]
thermo_style custom step v_f
thermo_modify format float %.17g
run 10
"""
        return lmp.read_thermo(lmp.run_well(script, folder))[-1][1]
    for own, other, mixed in (("hysteretic 1e4 0.4", "hysteretic 4e4 0.9", "hysteretic 1.6e4 0.6"),
                              ("hysteretic/size 1e4 0.4", "hysteretic/size 4e4 0.9", "hysteretic/size 1.6e4 0.6"),
                              ("hysteretic/edem 1e4 0.4", "hysteretic/edem 4e4 0.9", "hysteretic/edem 1e4 0.6"),
                              ("eepa 1e4 1 0.4 10 1 1 -0.1", "eepa 4e4 1 0.9 40 1 1 -0.4", "eepa 1.6e4 1 0.6 20 1 1 -0.2")):
        found, wanted = force(own, other, ""), force(own, other, mixed)
        fact(f"{own} and {other}: something acts", abs(wanted) > 10, wanted)
        at_most(f"{own} and {other}", abs(found / wanted - 1), 1e-14)
    law = f"1 1 eepa 1e4 1 0.5 10 1 1 0 {SLIP}\npair_coeff 2 2 eepa 1e4 1 0.5 10 1.5 1.5 0 {SLIP}"
    lmp.refused("of another n", lmp.head("-3 3 -3 3 -3 3", types=2) + PAIR.format(apart=1, law=law).replace("* *", "") + "set atom 2 type 2\nrun 0\n",
                folder, "cannot be mixed, as n is 1 and 1.5", "pair_coeff")


REFUSED = [("a damping beside e", "hysteretic 1e4 0.5 damping velocity", "leave the damping out, or write 'damping none'"),
           ("e above 1", "hysteretic 1e4 1.5", "1.5"), ("another n", "eepa 1e4 1 0.5 10 1.2 1 0", "n = 1.2, which must be 1 or 1.5"),
           ("another chi", "eepa 1e4 1 0.5 10 1 1.25 0", "chi = 1.25, which must be a multiple of 0.5"),
           ("a pull-off force that pushes", "eepa 1e4 1 0.5 10 1 1 3", "3"), ("tsuji", "eepa 1e4 1 0.5 10 1 1 0 damping tsuji", "coeff_restitution"),
           ("kp below k1", "lepa 1e4 0 5e3 0 0.1", "kp = 5000 is below k1 = 10000"),
           ("limited adhesion", "lepa 1e4 0 5e4 1e3 0.1 limit_damping", "leave limit_damping out"),
           ("a restitution of thornton", "thornton 1e6 0.5 0.3 1e4 damping tsuji", "take another one")]


@pytest.mark.parametrize("name,law,says", REFUSED, ids=[row[0] for row in REFUSED])
def test_refused(folder, name, law, says):
    lmp.flat_floor(folder)
    normal, *rest = law.split(" damping ")
    words = f"{normal} {SLIP}" if "limit_damping" not in law else law.replace(" limit_damping", f" {SLIP} limit_damping")
    words += f" damping {rest[0]}" if rest else ""
    script = lmp.head("-3 3 -3 3 -1 5") + "create_atoms 1 single 0 0 2\nset group all diameter 1 mass 1\n"
    lmp.refused(f"{name}, at a wall", f"{script}{lmp.pairs()}fix w all wall/lsdcd granular {words} mesh floor.stl\n", folder, says)
    lmp.refused(f"{name}, between grains", f"{script}pair_style granular/lsdcd\npair_coeff * * {words}\nrun 0\n", folder, says)
