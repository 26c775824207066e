# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Grains as LIGGGHTS's program computes them: one that hits a wall obliquely, with spins about all axes, one that is pressed to it and rolls on,
and two of different size that hit each other."""
import itertools
import math
import shutil
import subprocess

import pytest

import lmp
from facts import at_most

pytestmark = pytest.mark.skipif(not shutil.which("liggghts"), reason="LIGGGHTS is not installed (Debian's package is liggghts)")

YOUNG, NU, E, MU, MU_ROLL, DAMPING, STIFFNESS, COHESION = 5e6, 0.3, 0.6, 0.4, 0.15, 0.3, 4.0, 2e4
RADIUS, DENSITY, SPEED = 0.005, 2500.0, 1.0
MODULUS, SHEAR = YOUNG / (2 * (1 - NU**2)), YOUNG / (4 * (2 - NU) * (1 + NU))


def mass(radius):
    return DENSITY * 4 / 3 * math.pi * radius**3


def hooke(radius, m):
    """The stiffness of LIGGGHTS's `hooke`: as that of a hertz contact at its deepest, at this speed. Of effective numbers."""
    return 16 / 15 * math.sqrt(radius) * MODULUS * (15 * m * SPEED**2 / (16 * math.sqrt(radius) * MODULUS))**0.2


SMALL = 0.003
KN = {"wall": hooke(RADIUS, mass(RADIUS)), "pair": hooke(1 / (1 / RADIUS + 1 / SMALL), 1 / (1 / mass(RADIUS) + 1 / mass(SMALL)))}

PROPERTIES = f"""\
fix m1 all property/global youngsModulus peratomtype {YOUNG}
fix m2 all property/global poissonsRatio peratomtype {NU}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {E}
fix m4 all property/global coefficientFriction peratomtypepair 1 {{mu}}
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 {MU_ROLL}
fix m6 all property/global coefficientRollingViscousDamping peratomtypepair 1 {DAMPING}
fix m7 all property/global rollingStiffness scalar {STIFFNESS}
fix m8 all property/global cohesionEnergyDensity peratomtypepair 1 {COHESION}
fix m9 all property/global characteristicVelocity scalar {SPEED}
"""
NORMALS = {"hertz": f"hertz/material {YOUNG} {E} {NU}", "hooke": f"hooke {{kn!r}} {E}"}
TANGENTIALS = {"hertz history": "mindlin_liggghts NULL NULL {mu}", "hooke history": "linear_history_liggghts {kn!r} 1 {mu}",
               "hertz no_history": f"linear_nohistory_liggghts {2 * math.sqrt(SHEAR / MODULUS)!r} {{mu}}",
               "hooke no_history": "linear_nohistory_liggghts 1 {mu}"}
ROLLINGS = {"": "", "cdt": f"cdt {MU_ROLL}", "epsd2": f"epsd2 {MU_ROLL}", "epsd": f"epsd {MU_ROLL} {DAMPING}",
            "epsd3": f"epsd3 {MU_ROLL} {DAMPING} {STIFFNESS}"}

BOX = """\
units           si
atom_style      {style}
atom_modify     map array
boundary        f f f
newton          off
{velocities}
region          box block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box
create_box      1 box
neighbor        0.002 bin
{laws}
timestep        2e-6
create_atoms    1 single -0.04 0.01 0.0050005 units box
create_atoms    1 single 0.03 0.02 0.00500005 units box
create_atoms    1 single 0 0 0.05 units box
create_atoms    1 single 0.001 0.0008 0.0581 units box
set             group all diameter 0.01 density 2500
set             atom 4 diameter 0.006 density 2500
group           hits id 1
group           rolls id 2
group           large id 3
group           small id 4
velocity        hits set 0.3 -0.2 -0.8 units box
velocity        rolls set 0.02 0.05 -0.05 units box
velocity        large set {large_velocity} units box
velocity        small set {small_velocity} units box
set             atom 1 {hits}
set             atom 2 {rolls}
set             atom 3 {large}
set             atom 4 {small}
{wall}
fix             presses rolls gravity 400 vector 0 0 -1
fix             move all nve/sphere
dump            d all custom 10 {file} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify     d sort id {format}
run             1000
"""
# Contacts that yield, with what LIGGGHTS reads for them.
STIFFER, PULL, DEPTH = 4.0, 0.5, 0.004
YIELDING = f"""\
fix y1 all property/global coefficientMaxElasticStiffness peratomtypepair 1 {STIFFER}
fix y2 all property/global coefficientAdhesionStiffness peratomtypepair 1 {{pull}}
fix y3 all property/global coefficientPlasticityDepth peratomtypepair 1 {DEPTH}
fix y4 all property/global UnloadingStiffness peratomtypepair 1 {STIFFER}
fix y5 all property/global overlapExponent scalar {{n}}
fix y6 all property/global adhesionExponent scalar {{n}}
fix y7 all property/global pullOffForce peratomtypepair 1 0
fix y8 all property/global surfaceEnergy peratomtypepair 1 {{surface}}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {{e}}
"""
OBLIQUE = {"mu": MU, "large_velocity": "0.2 0.1 0.4", "small_velocity": "-0.3 0.2 -0.5"}
# Along the line of their centres, so that without friction the normal does not turn.
HEAD_ON = {"mu": 0, "large_velocity": "0.05 0.04 0.405", "small_velocity": "-0.05 -0.04 -0.405"}
FORMAT = '"%d' + " %.17g" * 15 + '"'


def there(model, folder, impact, more="", settings=""):
    (folder / "in.there").write_text(BOX.format(
        style="granular", velocities="communicate single vel yes", laws=f"{PROPERTIES.format(**impact)}{more}pair_style gran model {model}{settings}\npair_coeff * *",
        hits="omegax 40 omegay -70 omegaz 90", rolls="omegax 6 omegay -3 omegaz 20", large="omegax -30 omegay 50 omegaz 20",
        small="omegax 10 omegay 80 omegaz -60",
        wall=f"fix w all wall/gran model {model} primitive type 1 zplane 0.0{settings}", file="there.txt", format=f"format {FORMAT}", **impact))
    done = subprocess.run(["liggghts", "-in", "in.there", "-log", "none"], cwd=folder, text=True, errors="replace", stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=300)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:])
    return lmp.read_dump(folder / "there.txt")


def here(law, folder, impact, at_wall=None):
    """The dump of the same grains with this law, `at_wall` with another one at the wall."""
    lmp.flat_floor(folder)
    lmp.run_well(BOX.format(
        style="sphere", velocities="comm_modify vel yes", laws=f"pair_style granular/lsdcd\npair_coeff * * {law.format(kn=KN['pair'], mu=impact['mu'])}",
        hits="omega 40 -70 90", rolls="omega 6 -3 20", large="omega -30 50 20", small="omega 10 80 -60",
        wall=f"fix w all wall/lsdcd granular {(at_wall or law).format(kn=KN['wall'], mu=impact['mu'])} mesh floor.stl scale 0.1", file="here.txt",
        format=f"format line {FORMAT}", **impact), folder)
    return lmp.read_dump(folder / "here.txt")


def largest_difference(a, b):
    """Of two dumps, by atom: of places, velocities, spins, forces and torques, each relative to the largest component."""
    largest = {}
    for atom in a[0]:
        size, apart = [0.0] * 5, [0.0] * 5
        for step, rows in a.items():
            for k, (u, v) in enumerate(zip(rows[atom], b[step][atom])):
                size[k // 3] = max(size[k // 3], abs(u))
                apart[k // 3] = max(apart[k // 3], abs(u - v))
        largest[atom] = max(d / s if s else d for d, s in zip(apart, size))
    return largest


@pytest.mark.parametrize("rolling", ROLLINGS)
def test_paths(folder, rolling):
    # LIGGGHTS keeps the torque of epsd beside the spring of friction, and has no epsd without one.
    frictions = ["history"] if rolling.startswith("epsd") else ["history", "no_history"]
    for normal, tangential, cohesion in itertools.product(NORMALS, frictions, ("", "sjkr")):
        model = f"{normal} tangential {tangential}" + (f" cohesion {cohesion}" if cohesion else "") + \
            (f" rolling_friction {rolling}" if rolling else "")
        law = f"{NORMALS[normal]} damping coeff_restitution tangential {TANGENTIALS[f'{normal} {tangential}']}" + \
            (f" rolling {ROLLINGS[rolling]}" if rolling else "") + (f" cohesion sjkr {COHESION}" if cohesion else "")
        # Both compute in double: 1000 steps add up roundings of 1e-16.
        apart = largest_difference(there(model, folder, OBLIQUE), here(law, folder, OBLIQUE))
        at_most(f"{model}: at a wall", max(apart[1], apart[2]), 1e-12)
        # LIGGGHTS does not turn the torque of epsd with the normal, which turns by 0.1 in these impacts.
        at_most(f"{model}: two grains", max(apart[3], apart[4]), 3e-3 if rolling.startswith("epsd") else 1e-12)
        if rolling.startswith("epsd"):
            apart = largest_difference(there(model, folder, HEAD_ON), here(law, folder, HEAD_ON))
            at_most(f"{model}: two grains whose normal does not turn", max(apart[3], apart[4]), 1e-12)


def hysteresis(at, pull):
    """lepa for hooke/hysteresis: the depth counts twice between grains."""
    kn, m = KN[at], {"wall": mass(RADIUS), "pair": 1 / (1 / mass(RADIUS) + 1 / mass(SMALL))}[at]
    eta = -2 * math.log(E) / math.hypot(math.log(E), math.pi) * math.sqrt(kn * m)
    return (f"lepa {kn!r} {eta!r} {STIFFER * kn!r} {pull * kn!r} {DEPTH / (2 if at == 'pair' else 1)} damping velocity "
            f"tangential linear_history_liggghts {kn!r} 1 {{mu}}")


@pytest.mark.parametrize("impact, pull", [(OBLIQUE, 0.0), ({**OBLIQUE, "mu": 0}, PULL)], ids=["friction", "pull"])
def test_hysteresis(folder, impact, pull):
    more = YIELDING.format(pull=pull, n=1, surface=0, e=E)
    apart = largest_difference(there("hooke/hysteresis tangential history", folder, impact, more),
                               here(hysteresis("pair", pull), folder, impact, hysteresis("wall", pull)))
    at_most("at a wall", max(apart[1], apart[2]), 1e-12)
    at_most("two grains", max(apart[3], apart[4]), 1e-12)


def edinburgh(radius, n, e, surface):
    """eepa for edinburgh, whose friction has the stiffness 2 E* sqrt(R d) with n = 1 and 8 G* sqrt(R d) with 1.5."""
    k1 = 2 * MODULUS * radius if n == 1 else 4 / 3 * MODULUS * math.sqrt(radius)
    return (f"eepa {k1!r} {e} {1 - 1 / STIFFER} {surface} {n} {n} 0 damping coeff_restitution "
            f"tangential mindlin_liggghts {2 * MODULUS if n == 1 else 8 * SHEAR!r} 1 {{mu}}")


@pytest.mark.parametrize("n, e, limit", [(1, E, "off"), (1, 1, "on"), (1.5, 1, "on")])
def test_edinburgh(folder, n, e, limit):
    small = 1 / (1 / RADIUS + 1 / SMALL)
    for surface, impact in ((0, OBLIQUE), (20, {**OBLIQUE, "mu": 0})):
        more = YIELDING.format(pull=0, n=n, surface=surface, e=e)
        # It has no adhesion at walls: there the circle in which the surfaces cut is that of a second sphere of radius 0.
        apart = largest_difference(there("edinburgh tangential history", folder, impact, more, f" limitForce {limit}"),
                                   here(edinburgh(small, n, e, surface), folder, impact, edinburgh(RADIUS, n, e, 0)))
        at_most(f"at a wall, surface energy {surface}", max(apart[1], apart[2]), 1e-12)
        at_most(f"two grains that part, surface energy {surface}", max(apart[3], apart[4]), 1e-12)
