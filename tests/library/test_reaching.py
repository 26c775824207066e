# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Cohesion across a gap, at a wall: the table of a bridge's forces, random paths beside an own law in numpy, and what becomes of a bridge over seams."""
import math
import os

import numpy as np
import pytest

import lsdcd
import reaching_oracle as oracle
import yielding_oracle
from facts import at_most, fact
from test_contact_losses import Grains, sheet

R, MASS = 0.5, 2.0
N = 1000 if os.environ.get("LSDCD_QUICK") else 10000
PLAIN = "tangential linear_nohistory 0 0"
PULLS = {"capillary": ("capillary 3 20 70 1e-4", lambda n: oracle.Bridge(3, (20, 70), 1e-4, 2 * R, n)),
         "capillary/share": ("capillary/share 3 30 NULL 1e-4", lambda n: oracle.Bridge(3, (30, 30), 1e-4 * 4 / 3 * math.pi * R**3, 2 * R, n)),
         "constant": ("constant 5 0.03", lambda n: oracle.Constant(5, 0.03)),
         "constant/weight": ("constant/weight 0.7 9.8 0.03", lambda n: oracle.Constant(0.7 * MASS * 9.8, 0.03)),
         "linear": ("linear 100 0.03", lambda n: oracle.Linear(100, 0.03))}


class Hooke:
    def __init__(self, k):
        self.k = k

    def go_to(self, d):
        return self.k * d


NORMALS = {"hooke": ("hooke 1e4 0", lambda n: Hooke(1e4)),
           "hysteretic": ("hysteretic 1e4 0.5", lambda n: yielding_oracle.Hysteretic(1e4, 0.5, n))}


def wall(law, mesh, more=""):
    return lsdcd.Wall(f"granular {law} mesh $part {more}", part=mesh)


# Willett's short form between two spheres of 1 mm, R' = 1 mm: what a sphere of 0.5 mm has at a wall. Volume over R'^3, degrees, rupture, and
# forces at a tenth, half and all of the gap of rupture (a table that was made apart from both programs, of six digits).
TABLE = [(1e-4, 0, 4.663133e-5, (2.22496e-4, 2.65508e-5, 7.50750e-6)), (1e-3, 0, 1.010000e-4, (2.84453e-4, 4.99744e-5, 1.51523e-5)),
         (1e-2, 0, 2.200851e-4, (3.34562e-4, 8.72869e-5, 2.93374e-5)), (1e-4, math.degrees(0.3491), 5.477083e-5, (1.82835e-4, 1.87894e-5, 5.20021e-6))]


@pytest.mark.parametrize("cells", [1, 7])
@pytest.mark.parametrize("volume,theta,rupture,forces", TABLE)
def test_table(volume, theta, rupture, forces, cells):
    """Numbers of the table have six digits: 1e-6 but for its last digit, which is 5e-6 of the least one."""
    r = 5e-4
    vertices, faces = sheet(cells, 5e-3)
    its = wall(f"hooke 1e3 0 {PLAIN} damping none cohesion capillary 0.072 {theta!r} NULL {volume * 1e-9!r}", lsdcd.Mesh(vertices, faces))
    grains = Grains([[1e-4, 2e-4, r - 1e-9]], radius=r, dt=1e-6)

    def force(gap):
        grains.x[0, 2] = r + gap
        grains.push(its)
        return grains.force[0, 2]
    force(-1e-9)
    for part, wanted in zip((0.1, 0.5, 1 - 1e-6), forces):
        found = -force(part * rupture)
        at_most(f"V {volume}, {theta:.3g} degrees, {part:.3g} of the gap: force {found:.6g}", abs(found / wanted - 1), 6e-6)
    fact("it ruptures", force(rupture * (1 + 1e-6)) == 0 and force(0.5 * rupture) == 0, grains.force)


@pytest.mark.parametrize("cells", [1, 7])
@pytest.mark.parametrize("normal", NORMALS)
@pytest.mark.parametrize("name", PULLS)
def test_random_paths(name, normal, cells):
    """10 000 spheres (1000 in the tests of every day) are moved up and down through touch and rupture, at a plane of two triangles, and at one of many, where they also move along
    it. Forces are those of the oracle but for rounding of the overlap, which is that of places of size 1, times the steepest slope. No path comes as near to touch or rupture as that."""
    words, pull = PULLS[name]
    of_normal, law = NORMALS[normal]
    rng = np.random.default_rng(4711)
    grains = Grains(np.zeros((N, 3)), radius=R, mass=MASS, dt=1e-3)
    its = wall(f"{of_normal} {PLAIN} damping none cohesion {words}", lsdcd.Mesh(*sheet(cells)))
    mine, push = pull(N), law(N)
    depth, largest, worst, across = np.full(N, -0.05), 0.0, 0.0, 0
    for _ in range(40):
        depth = np.clip(depth + rng.choice([-1, 1], N) * 10**rng.uniform(-3, -1, N), -0.08, 0.03)
        grains.x[:, :2] = rng.uniform(-2, 2, (N, 2)) if cells == 1 else np.clip(grains.x[:, :2] + rng.uniform(-0.02, 0.02, (N, 2)), -2, 2)
        grains.x[:, 2] = R - depth
        grains.push(its)
        d = R - grains.x[:, 2]
        pulled = mine.go_to(d)
        across += np.count_nonzero((d < 0) & (pulled > 0))
        wanted = np.where(d > 0, push.go_to(np.maximum(d, 0)), 0) - pulled
        largest = max(largest, np.abs(wanted).max())
        worst = max(worst, np.abs(grains.force[:, 2] - wanted).max())
    fact(f"many are pulled across a gap: {across}", across > N)
    at_most(f"{name}, {normal}, {cells} cells: difference over the largest force", worst / largest, 1e-12)


@pytest.mark.parametrize("name", ["capillary 3 20 70 1e-4", "linear 100 0.03"])
def test_seams(name):
    """A sphere that a plane of 500 x 500 cells pulls across a gap has the same force to the last bit over a thousand seams."""
    grains = Grains([[-2.4, 0.011, R - 1e-3]], radius=R, dt=1e-3)
    its = wall(f"hooke 1e4 0 {PLAIN} damping none cohesion {name}", lsdcd.Mesh(*sheet(500)))
    grains.push(its)
    grains.x[0, 2] = R + 0.01
    grains.push(its)
    pulled = grains.force[0, 2]
    same = True
    for x in np.linspace(-2.4, 2.4, 1203):
        grains.x[0, 0] = x
        grains.push(its)
        same = same and grains.force[0, 2] == pulled
    fact(f"{name}: the force is that of before, {pulled}", same and pulled < 0, grains.force[0, 2])


def test_nothing_else_acts_across_a_gap():
    """A sphere that slides, rolls and twists in a bridge feels the pull alone, and its springs begin anew where it touches again."""
    law = "hooke 1e4 0.9 damping coeff_restitution tangential linear_history 3e3 1 0.5 rolling epsd2 0.2 twisting sds 30 1 0.1 cohesion capillary 3 0 NULL 1e-4"
    grains = Grains([[0, 0, R - 1e-3]], v=[0.3, 0.1, 0], omega=[2, 3, 4], radius=R, dt=1e-3)
    its = wall(law, lsdcd.Mesh(*sheet(7)))
    for k in range(3):
        grains.x[0, 0] = 1e-3 * k
        grains.push(its)
    touching = np.append(grains.force[0, :2], grains.torque[0])
    fact("friction and torques act at touch", np.all(np.abs(touching) > 0), touching)
    grains.x[0, 2] = R + 1e-3
    grains.push(its)
    fact("across the gap the pull is alone", not np.append(grains.force[0, :2], grains.torque[0]).any() and grains.force[0, 2] < 0, grains.force)
    again = wall(law, lsdcd.Mesh(*sheet(7)))
    fresh = Grains(grains.x, v=grains.v, omega=grains.omega, radius=R, dt=1e-3)
    for g, w in ((grains, its), (fresh, again)):
        g.x[0, 2] = R - 1e-3
        g.push(w)
    fact("springs begin anew", np.array_equal(grains.force, fresh.force) and np.array_equal(grains.torque, fresh.torque), grains.force - fresh.force)
