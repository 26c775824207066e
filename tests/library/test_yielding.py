# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Contacts that yield, at a wall: random paths beside an own law in numpy, and what becomes of a plastic overlap over seams and folds."""
import math
import os

import numpy as np
import pytest

import lsdcd
import yielding_oracle as oracle
from facts import at_most, fact
from test_contact_losses import Grains, sheet

R = 0.5
CIRCLE = oracle.circle_at_wall(R)
N = 1000 if os.environ.get("LSDCD_QUICK") else 10000
PLAIN = "tangential linear_nohistory 0 0"
LAWS = {"hysteretic": ("hysteretic 1e4 0.5", lambda n: oracle.Hysteretic(1e4, 0.5, n)),
        "hysteretic/size": ("hysteretic/size 2e4 0.3", lambda n: oracle.Hysteretic(2 * 2e4 * R, 0.3, n)),
        "hysteretic/edem": ("hysteretic/edem 2e4 0.8", lambda n: oracle.Hysteretic(5 * 2e4 * R, 0.8, n)),
        "eepa of n 1": ("eepa 1e4 1 0.6 30 1 1 -0.2", lambda n: oracle.Eepa(1e4, 0.6, 30, 1, 1, -0.2, CIRCLE, n)),
        "eepa of n 1.5": ("eepa 1e5 1 0.75 40 1.5 1.5 0", lambda n: oracle.Eepa(1e5, 0.75, 40, 1.5, 1.5, 0, CIRCLE, n)),
        "eepa of chi 3.5": ("eepa 1e5 1 0.75 40 1.5 3.5 -0.1", lambda n: oracle.Eepa(1e5, 0.75, 40, 1.5, 3.5, -0.1, CIRCLE, n)),
        "lepa": ("lepa 1e4 0 5e4 1e4 0.05", lambda n: oracle.Lepa(1e4, 5e4, 1e4, 0.05, R, n)),
        "thornton": ("thornton 1e6 0 0.3 5e4", lambda n: oracle.Thornton(1e6 / (2 * (1 - 0.3**2)), 5e4, R, n))}


def wall(law, mesh, more=""):
    return lsdcd.Wall(f"granular {law} {PLAIN} damping none mesh $part {more}", part=mesh)


@pytest.mark.parametrize("cells", [1, 7])
@pytest.mark.parametrize("name", LAWS)
def test_random_paths(name, cells):
    """10 000 spheres (1000 in the tests of every day) are moved up and down at a plane of two triangles, and at one of many, where they also move along it. Forces are those of the
    oracle but for rounding of the overlap, which is that of places of size 1, times the steepest slope."""
    words, law = LAWS[name]
    rng = np.random.default_rng(4711)
    grains = Grains(np.zeros((N, 3)), radius=R, dt=1e-3)
    its, mine = wall(words, lsdcd.Mesh(*sheet(cells))), law(N)
    depth, largest, worst = np.full(N, 0.0), 0.0, 0.0
    for _ in range(40):
        # Steps of all sizes, also beyond the depth that was reached, never to where the contact ends.
        depth = np.clip(depth + rng.choice([-1, 1], N) * 10**rng.uniform(-5, -2, N), 1e-6, 0.03)
        grains.x[:, :2] = rng.uniform(-2, 2, (N, 2)) if cells == 1 else np.clip(grains.x[:, :2] + rng.uniform(-0.02, 0.02, (N, 2)), -2, 2)
        grains.x[:, 2] = R - depth
        grains.push(its)
        wanted = mine.go_to(R - grains.x[:, 2])
        largest = max(largest, np.abs(wanted).max())
        worst = max(worst, np.abs(grains.force[:, 2] - wanted).max())
    at_most(f"{name}, {cells} cells: difference over the largest force", worst / largest, 1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_seams(name):
    """A sphere that is pressed, lifted a little, and moved over a thousand seams of a plane has the same force to the last bit."""
    grains = Grains([[-2.4, 0.011, R - 0.01]], radius=R, dt=1e-3)
    its = wall(LAWS[name][0], lsdcd.Mesh(*sheet(500)))
    grains.push(its)
    grains.x[0, 2] = R - 0.0095
    grains.push(its)
    pressed = grains.force[0, 2]
    same = True
    for x in np.linspace(-2.4, 2.4, 1203):
        grains.x[0, 0] = x
        grains.push(its)
        same = same and grains.force[0, 2] == pressed
    fact(f"{name}: the force is that of before, {pressed}", same and abs(pressed) > 0, grains.force[0, 2])


def drum(flats, radius=1.0, half=0.5):
    """The inside of a prism, whose flats lie on the circle of the radius."""
    at = [(radius / math.cos(math.pi / flats) * np.array([math.cos(a), math.sin(a)])) for a in (2 * np.arange(flats) + 1) * math.pi / flats]
    vertices = [(x, y, z) for z in (-half, half) for x, y in at]
    return lsdcd.Mesh(np.array(vertices, float), [f for k in range(flats) for f in (
        (k, k + flats, (k + 1) % flats), ((k + 1) % flats, k + flats, (k + 1) % flats + flats))])


def rolled(flats, e, depth, corner, r=0.05, steps=400):
    """What a sphere that goes around in a drum from a flat to the next one, as deep as this below each, loses, over one loading."""
    k1, half_pitch = 1e4, math.pi / flats
    grains = Grains([[1 - r + depth, 0, 0]], radius=r, mass=1, dt=1e-3)
    its = wall(f"hysteretic {k1} {e}", drum(flats), f"energy corner {corner}")
    # Fine where both flats are touched.
    width = min(0.99 * half_pitch, 1.2 * depth / half_pitch)
    for angle in (0, *(half_pitch + np.linspace(-width, width, steps)), 2 * half_pitch):
        reach = (1 - r + depth) / math.cos(min(angle, 2 * half_pitch - angle))
        x = reach * np.array([math.cos(angle), math.sin(angle), 0])
        grains.v[0] = (x - grains.x[0]) / grains.dt
        grains.x[0] = x
        grains.push(its)
    return its.totals().dissipated_plastic / ((1 - e**2) * k1 * depth**2 / 2)


def test_folds_that_blend():
    """The weights of blend bring a contact to the next flat with nearly its whole overlap: up to 22.5 degrees its memory survives, whatever the overlap."""
    for flats in (16, 64, 1024):
        for depth in (1e-3, 1e-5):
            at_most(f"{flats} flats, overlap {depth}: loadings that a fold costs", abs(rolled(flats, 0.5, depth, "blend")), 1e-9)
    lost = rolled(8, 0.5, 1e-4, "blend")
    fact(f"a fold of 45 degrees costs some of a loading: {lost:.3g}", 0.01 < lost < 0.1)


def test_folds_that_sum():
    """A part of the next flat is touched at d - r phi^2/2 first, to which a plastic overlap heals: it survives where phi < e sqrt(2 d/r)."""
    e, r = 0.5, 0.05
    for flats in (16, 64, 256, 1024):
        for depth in (1e-3, 1e-4, 1e-5):
            survives = 2 * math.pi / flats < e * math.sqrt(2 * depth / r)
            at_most(f"{flats} flats, overlap {depth}: loadings that a fold costs, beside {1 - survives}",
                    abs(rolled(flats, e, depth, "sum", r) - (not survives)), 1e-3)
